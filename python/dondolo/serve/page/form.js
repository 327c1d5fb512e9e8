// The form: rows of sliders made of the table of properties.
import { changed, letGo, state } from "./state.js";
import { choiceOf, labelOf, language, make, num, read, t, the } from "./words.js";

// How a number is shown: least, largest, step, factor on what the case has, unit, digits
/** @type {Record<string, [number, number, number, number, string, number]>} */
const FIELDS = {
  height: [0.5, 15, 0.05, 1, "m", 2],
  thickness: [0.1, 1.2, 0.01, 1, "m", 2],
  density: [1000, 2600, 10, 1, "kg/m³", 0],
  length: [1, 12, 0.05, 1, "m", 2],
  end_thrust: [1, 120, 0.5, 1e-3, "kN/m", 1],
  hinge_x: [0.2, 12, 0.05, 1, "m", 2],
  push: [0, 5, 0.05, 1e-3, "kN/m", 2],
  push_x: [0.1, 12, 0.05, 1, "m", 2],
  hinge: [0.3, 0.9, 0.01, 1, "", 2],
  overburden: [0, 60, 0.5, 1e-3, "kN/m", 1],
  overburden_inertia: [0, 1, 0.05, 1, "", 2],
  eccentricity: [-20, 20, 0.5, 100, "cm", 1],
  compressive_strength: [0.3, 6, 0.1, 1e-6, "MPa", 1],
  hinge_depth: [0, 10, 0.1, 100, "cm", 1],
  restitution_factor: [0.7, 1.1, 0.01, 1, "", 2],
  restitution_value: [0.5, 0.99, 0.01, 1, "", 2],
  section_height: [0.5, 6, 0.05, 1, "m", 2],
  section_thickness: [0.1, 1.2, 0.01, 1, "m", 2],
  load: [0, 60, 0.5, 1e-3, "kN/m", 1],
  load_height: [0, 15, 0.05, 1, "m", 2],
  load_depth: [0, 1, 0.01, 1, "m", 2],
  thrust: [0, 10, 0.1, 1e-3, "kN/m", 1],
  thrust_height: [0, 15, 0.05, 1, "m", 2],
  thrust_depth: [0, 1, 0.01, 1, "m", 2],
  tie_height: [0.2, 15, 0.05, 1, "m", 2],
  tie_bar: [8, 40, 1, 1e3, "mm", 0],
  tie_spacing: [0.5, 8, 0.1, 1, "m", 1],
  tie_length: [1, 20, 0.5, 1, "m", 1],
  tie_strength: [100, 500, 5, 1e-6, "MPa", 0],
  tie_area: [0, 4, 0.01, 1e4, "cm²/m", 2],
  tie_strain: [0.2, 10, 0.1, 100, "%", 1],
  tie_preload: [0, 150, 5, 1e-6, "MPa", 0],
  tie_depth: [0, 1, 0.01, 1, "m", 2],
  tie_modulus: [70, 220, 1, 1e-9, "GPa", 0],
  tie_plate_width: [10, 80, 1, 100, "cm", 0],
  tie_plate_height: [10, 80, 1, 100, "cm", 0],
  tie_plate_diameter: [10, 80, 1, 100, "cm", 0],
  tie_plate_thickness: [5, 50, 1, 1e3, "mm", 0],
  tie_anchor_force: [1, 60, 0.5, 1e-3, "kN/m", 1],
  masonry_compression: [0.5, 6, 0.1, 1e-6, "MPa", 1],
  masonry_shear: [0.01, 0.2, 0.005, 1e-6, "MPa", 3],
  masonry_tension: [0.01, 0.3, 0.005, 1e-6, "MPa", 3],
  period: [0.05, 1.5, 0.01, 1, "s", 2],
  damping: [1, 20, 0.5, 100, "%", 1],
  storeys: [1, 8, 1, 1, "", 0],
  level: [0, 25, 0.25, 1, "m", 2],
  level_top: [0, 25, 0.25, 1, "m", 2],
  building_height: [2, 30, 0.25, 1, "m", 2],
  ag: [0.02, 0.45, 0.005, 1, "g", 3],
  f0: [2.2, 3.2, 0.01, 1, "", 2],
  tc_star: [0.15, 0.6, 0.01, 1, "s", 2],
  behaviour: [1, 2, 0.05, 1, "", 2],
  knowledge_factor: [1, 1.35, 0.01, 1, "", 2],
  friction: [0.2, 1, 0.05, 1, "", 2],
  building_period: [0.05, 3, 0.01, 1, "s", 2],
  building_damping: [1, 30, 0.5, 100, "%", 1],
  latitude: [36, 47.5, 0.0001, 1, "°", 4],
  longitude: [6.5, 18.6, 0.0001, 1, "°", 4],
  nominal_life: [10, 100, 5, 1, "", 0],
};
// Parts of a wall: what the names of their lists begin with, and what a new one has
const PARTS = {
  sections: { word: "section", owners: ["one_sided", "free_standing"] },
  loads: { word: "load", owners: ["one_sided", "free_standing"] },
  thrusts: { word: "thrust", owners: ["one_sided", "free_standing"] },
  ties: { word: "tie", owners: ["one_sided"] },
  pushes: { word: "push", owners: ["horizontal"] },
};
const WALL = [
  "height",
  "length",
  "thickness",
  "density",
  "hinge",
  "overburden",
  "overburden_inertia",
  "eccentricity",
  "end_thrust",
  "compressive_strength",
];
const BUILDING = ["period", "damping", "storeys", "level", "level_top", "building_height"];
// Circolare 7/2019, Table C8.5.I: E of masonry, least and greatest [MPa]; proposed is the range from its mean to half
// of it
/** @type {[string, number, number][]} */
const MASONRY = [
  ["irregular_stone", 690, 1050],
  ["rough_stone", 1020, 1440],
  ["split_stone", 1500, 1980],
  ["irregular_soft", 900, 1260],
  ["regular_soft", 1200, 1620],
  ["squared_stone", 2400, 3300],
  ["solid_bricks", 1200, 1800],
  ["perforated_bricks", 3500, 5600],
];
// What gives the hazard of the site: its values, or its place
const VALUES = { ag: [0.2], f0: [2.5], tc_star: [0.35] },
  PLACE = { latitude: 42.3498, longitude: 13.3999, nominal_life: 50 };
const SITE = [
  ...Object.keys(VALUES),
  ...Object.keys(PLACE),
  "use_class",
  "soil",
  "topography",
  "knowledge_factor",
  "behaviour",
  "ultimate_state",
  "friction",
];
// What a pushover analysis gives of the building for each limit state
const STATES = ["SLD", "SLV", "SLC"],
  DAMAGED = ["building_period", "building_damping"];
const KINDS = {
  one_sided: '<path d="M4 27h22M7 27V6h4v21M15 27 19 7l5 1-4 19z"/>',
  free_standing: '<path d="M4 27h22M13 27V8h5v19M8 10a9 9 0 0 0-3 5m17-5a9 9 0 0 1 3 5"/>',
  two_block: '<path d="M4 27h22M4 4h22M13 27l5-11-5-12m-4 23 5-11-5-12M9 27h4M9 4h4"/>',
  horizontal: '<path d="M3 4v14h4V4M23 4v14h4V4M7 13l8 5 8-5M7 18l8 6 8-6"/>',
};
// What a wall has that bends horizontally, before it is given
const BAND = { length: 5, end_thrust: 25e3, compressive_strength: 1.5e6, sides: 1, restitution_value: 0.7 };
// What the form had before another kind of wall, or of hazard, was chosen
/** @type {Record<string, any>} */
const kept = {};
/** @type {Record<string, any>} */
const keptSite = { values: VALUES, place: PLACE };

const wall = () => state.settings.wall;
const isPart = (name, word) => name === word || name.startsWith(`${word}_`);
const lists = (word) =>
  Object.keys(wall()).filter((name) => isPart(name, word) && state.properties.wall[name]?.kind === "list");
const partCount = (word) => Math.max(0, ...lists(word).map((name) => [].concat(wall()[name]).length));
export const fieldOf = (name) => FIELDS[name];

const clean = (x) => Number(x.toPrecision(12));
const get = (group, name, place) => {
  const value = state.settings[group]?.[name];
  return Array.isArray(value) ? value[place ?? 0] : value;
};
function put(group, name, place, value) {
  const old = state.settings[group][name];
  if (Array.isArray(old)) {
    const next = [...old];
    next[place ?? 0] = value;
    state.settings[group][name] = next;
  } else state.settings[group][name] = value;
}

// A value that stands for all parts is given to each of them.
export function expand() {
  for (const { word } of Object.values(PARTS)) {
    const count = partCount(word);
    for (const name of lists(word)) {
      const values = [].concat(wall()[name]);
      wall()[name] = values.length === count ? values : Array(count).fill(values[0]);
    }
  }
  for (const group of ["building", "check"])
    for (const [name, value] of Object.entries(state.settings[group] || {}))
      if (state.properties[group][name]?.kind === "list" && !Array.isArray(value))
        state.settings[group][name] = [value];
  for (const name of DAMAGED) {
    const values = state.settings.check?.[name];
    if (values?.length === 1) state.settings.check[name] = Array(STATES.length).fill(values[0]);
  }
}

export const inWords = (unit) => (unit === "year" ? t(unit) : unit);
// The meaning of a property, with its value as the case has it: the field beside may have another unit.
function tip(group, name, place) {
  const { unit: given, meaning } = state.properties[group][name],
    unit = inWords(given),
    value = get(group, name, place),
    as =
      typeof value === "number"
        ? `\n${t("in_case", { name, value: value + (unit ? ` [${unit}]` : "") })}`
        : ` (${name}${unit ? `, ${unit}` : ""})`;
  return meaning[language()] + as;
}

let serial = 0;
function row(group, name, place) {
  const property = state.properties[group][name],
    field = FIELDS[name],
    id = `f${serial++}`;
  if (property.choices.length || property.kind === "logical") return choice(group, name);
  if (
    !field ||
    (place === undefined && Array.isArray(state.settings[group][name]) && state.settings[group][name].length > 1)
  )
    return plainRow(group, name);
  const [low, high, step, factor, unit, digits] = field,
    value = get(group, name, place) * factor;
  const range = make("input", {
    type: "range",
    id: `${id}r`,
    min: Math.min(low, value),
    max: Math.max(high, value),
    step,
    "aria-label": `${labelOf(name)}${place === undefined ? "" : ` ${place + 1}`}${unit ? `, ${unit}` : ""}`,
    tabindex: 0,
  });
  const box = make("input", { type: "text", id, inputmode: "decimal", autocomplete: "off" }),
    label = make("label", { for: id }, labelOf(name));
  const fill = (x) => {
    const least = Number(range.min);
    label.title = box.title = tip(group, name, place);
    range.value = String(x);
    range.style.setProperty("--part", `${(100 * (x - least)) / (Number(range.max) - least)}%`);
    range.setAttribute("aria-valuetext", `${num(x, digits)} ${unit}`);
  };
  const exact = Math.abs(clean(value) - Number(value.toFixed(digits))) < 1e-9 * Math.max(1, Math.abs(value));
  box.value = exact ? num(value, digits) : num(value);
  range.addEventListener("input", () => {
    const x = Number(range.value);
    box.value = num(x, digits);
    put(group, name, place, clean(x / factor));
    fill(x);
    element.classList.remove("wrong");
    changed(true);
  });
  range.addEventListener("change", letGo);
  box.addEventListener("change", () => {
    const x = read(box.value),
      isWrong = Number.isNaN(x);
    element.classList.toggle("wrong", isWrong);
    if (isWrong) return;
    if (x < Number(range.min)) range.min = String(x);
    if (x > Number(range.max)) range.max = String(x);
    box.value = num(x);
    put(group, name, place, clean(x / factor));
    fill(x);
    changed(false);
  });
  const isFan = () =>
    state.fan && state.fan.group === group && state.fan.name === name && (state.fan.place ?? 0) === (place ?? 0);
  const share = () => (isFan() ? (state.fan?.share ?? 0) : 0);
  const part = isFan() ? `±${100 * share()} %` : "±";
  const fan = make(
    "button",
    {
      class: "small",
      type: "button",
      "aria-pressed": String(Boolean(isFan())),
      "aria-label": `${part} ${t("fan_button", { what: labelOf(name) })}`,
      title: t("fan_button", { what: labelOf(name) }),
      onclick: () => {
        const next = share() === 0.2 ? 0 : share() === 0.1 ? 0.2 : 0.1;
        state.fan = next ? { group, name, place: place ?? null, share: next } : null;
        draw();
        changed(false);
        focusOn(`[data-key="${element.dataset.key}"] button`);
      },
    },
    part,
  );
  const element = make(
    "div",
    { class: "row", "data-key": `${group}.${name}.${place ?? ""}`, "data-name": `${group}.${name}` },
    label,
    make("span", { class: "value" }, box, make("span", { class: "unit" }, unit), fan),
    range,
  );
  fill(value);
  return element;
}
function choice(group, name) {
  const id = `f${serial++}`,
    { kind, choices, default: usual } = state.properties[group][name],
    isFlag = kind === "logical";
  const now = String(state.settings[group][name] ?? usual.replaceAll(/['.]/g, ""));
  const select = make(
    "select",
    {
      id,
      title: tip(group, name),
      onchange: () => {
        state.settings[group][name] = isFlag ? select.value === "true" : select.value;
        changed(false);
      },
    },
    ...(isFlag ? ["true", "false"] : choices).map((word) =>
      make("option", { value: word, selected: word === now }, choiceOf(isFlag ? "logical" : name, word)),
    ),
  );
  return make(
    "div",
    { class: "row one", "data-name": `${group}.${name}` },
    make("label", { for: id, title: tip(group, name) }, labelOf(name)),
    select,
  );
}
// Any other property, as the case has it
function plainRow(group, name) {
  const id = `f${serial++}`,
    { kind, unit } = state.properties[group][name],
    value = state.settings[group][name];
  const box = make("input", {
    type: "text",
    id,
    title: tip(group, name),
    autocomplete: "off",
    value: []
      .concat(value)
      .map((x) => (typeof x === "number" ? num(x) : x))
      .join("; "),
  });
  box.addEventListener("change", () => {
    const words = box.value
      .split(";")
      .map((word) => word.trim())
      .filter(Boolean);
    const values = ["text", "words"].includes(kind) ? words : words.map(read);
    element.classList.toggle("wrong", !values.length || values.some(Number.isNaN));
    if (element.classList.contains("wrong")) return;
    state.settings[group][name] = kind === "list" || values.length > 1 ? values : values[0];
    changed(false);
  });
  const element = make(
    "div",
    { class: "row", "data-name": `${group}.${name}` },
    make("label", { for: id, title: tip(group, name) }, labelOf(name)),
    make(
      "span",
      { class: "value" },
      box,
      make("span", { class: "unit" }, inWords(unit)),
      make(
        "button",
        {
          class: "small",
          type: "button",
          "aria-label": `${t("remove")} ${labelOf(name)}`,
          onclick: () => {
            delete state.settings[group][name];
            again();
          },
        },
        "×",
      ),
    ),
  );
  return element;
}
const focusOn = (selector) => {
  const element = document.querySelector(selector);
  if (element instanceof HTMLElement) element.focus();
};
const again = () => {
  draw();
  changed(false);
};

function addPart(kind) {
  const { word } = PARTS[kind],
    count = partCount(word),
    w = wall(),
    top = heightOf(),
    t0 = thicknessOf();
  const last = (name, value) => (count ? (w[name]?.[count - 1] ?? value) : value);
  const fresh = {
    section: {
      section_height: last("section_height", clean(top / 2)),
      section_thickness: last("section_thickness", t0),
    },
    load: { load: 10e3, load_height: top, load_depth: clean(Math.min(0.2, t0 / 2)) },
    thrust: { thrust: 500, thrust_height: top },
    tie: { tie_height: clean(Math.max(0.2, top - 0.3)), tie_bar: 0.016, tie_spacing: 2, tie_length: 6 },
    push: { push: 300, push_x: clean(top / 2) },
  }[word];
  if (word === "section" && !count) {
    w.section_height = [clean(top / 2)];
    w.section_thickness = [t0];
    delete w.height;
    delete w.thickness;
    addPart(kind);
    return;
  }
  const names = count ? lists(word) : Object.keys(fresh);
  for (const name of names) w[name] = [...(w[name] || []), fresh[name] ?? w[name][count - 1]];
  if (word === "load" && !("load_inertia" in w) && !("load_lifted" in w)) w.load_inertia = "both";
  again();
}
function removePart(kind, place) {
  const { word } = PARTS[kind],
    w = wall();
  if (word === "section" && partCount(word) === 1) {
    w.height = w.section_height[0];
    w.thickness = w.section_thickness[0];
  }
  for (const name of lists(word)) {
    w[name] = w[name].filter((_, i) => i !== place);
    if (!w[name].length) delete w[name];
  }
  if (!partCount(word))
    for (const name of Object.keys(w))
      if (isPart(name, word) || (word === "tie" && name.startsWith("masonry_"))) delete w[name];
  state.fan = null;
  again();
}
export const heightOf = () =>
  wall().height ?? wall().length ?? clean((wall().section_height || [3]).reduce((a, b) => a + b, 0));
export const thicknessOf = () => wall().thickness ?? wall().section_thickness?.[0] ?? 0.3;

function changeKind(kind) {
  const old = wall(),
    next = kept[kind] ? { ...kept[kind] } : { mechanism: kind };
  kept[old.mechanism] = { ...old };
  if (kind === "horizontal" && !kept[kind]) Object.assign(next, BAND);
  if (!("section_height" in next)) {
    if (kind !== "horizontal") next.height = heightOf();
    next.thickness = thicknessOf();
  }
  for (const name of ["density", "name"])
    if (name in old) next[name] = old[name];
    else delete next[name];
  state.settings.wall = next;
  state.fan = null;
  again();
}
// Young's modulus of a free element, by its masonry
function modulus() {
  const w = wall(),
    id = `f${serial++}`,
    range = ([, low, high]) => [0.25e6 * (low + high), 0.5e6 * (low + high)];
  const now =
    MASONRY.find((one) => String(range(one)) === String(w.young_modulus))?.[0] ??
    ("young_modulus" in w ? "own_modulus" : "no_modulus");
  const words = [
    "no_modulus",
    ...("young_modulus" in w && now === "own_modulus" ? ["own_modulus"] : []),
    ...MASONRY.map(([name]) => name),
  ];
  const select = make(
    "select",
    {
      id,
      title: tip("wall", "young_modulus"),
      onchange: () => {
        const found = MASONRY.find(([name]) => name === select.value);
        if (found) w.young_modulus = range(found);
        else if (select.value === "no_modulus") delete w.young_modulus;
        again();
      },
    },
    ...words.map((word) => make("option", { value: word, selected: word === now }, t(word))),
  );
  return make(
    "div",
    { class: "row one", "data-name": "wall.masonry" },
    make("label", { for: id, title: tip("wall", "young_modulus") }, t("free_modulus")),
    select,
  );
}
// Period and damping of the building in each limit state: those of the worst state unless they are given
function damagedBuilding(shown) {
  const { building, check } = state.settings,
    has = DAMAGED.some((name) => name in check);
  if (!building && !has) return [];
  const first = Math.max(...[].concat(building?.period ?? 0.3)),
    damping = [].concat(building?.damping ?? 0.05)[0];
  const rows = !has
    ? [make("p", { class: "hint" }, t("damaged_hint"))]
    : STATES.map((name, place) =>
        make(
          "div",
          { class: "part" },
          make("div", { class: "head" }, t("building_at", { state: name })),
          ...DAMAGED.filter((each) => each in check).map((each) => row("check", each, place)),
        ),
      );
  for (const name of DAMAGED) shown.add(`check.${name}`);
  return [
    ...rows,
    make(
      "div",
      { class: "adds" },
      make(
        "button",
        {
          class: "small",
          type: "button",
          onclick: () => {
            if (has) for (const name of DAMAGED) delete check[name];
            else
              Object.assign(check, { building_period: Array(3).fill(first), building_damping: Array(3).fill(damping) });
            state.fan = null;
            again();
          },
        },
        t(has ? "remove_damaged" : "add_damaged"),
      ),
    ),
  ];
}
function group(name, isOpen, count, ...rows) {
  return make(
    "details",
    { class: "group", open: isOpen, "data-group": name },
    make("summary", {}, t(name), count ? make("span", { class: "count" }, ` (${count})`) : null),
    ...rows,
  );
}
const opened = {};

export function draw() {
  const form = the("form"),
    w = wall(),
    shown = new Set(["job.task", "job.title", "job.output", "wall.mechanism"]);
  for (const element of form.querySelectorAll("details")) opened[element.dataset.group ?? ""] = element.open;
  const rows = (of, names, place) =>
    names
      .filter((name) => {
        const is = state.settings[of] && name in state.settings[of];
        if (is) shown.add(`${of}.${name}`);
        return is;
      })
      .map((name) => row(of, name, place));
  const kinds = make(
    "div",
    { class: "kinds", role: "radiogroup", "aria-label": labelOf("mechanism") },
    ...Object.keys(KINDS).map((kind) => {
      const input = make("input", {
        type: "radio",
        name: "kind",
        value: kind,
        checked: w.mechanism === kind,
        onchange: () => {
          changeKind(kind);
          focusOn(`input[value=${kind}]`);
        },
      });
      const icon = make("span");
      icon.innerHTML = `<svg viewBox="0 0 30 30" aria-hidden="true">${KINDS[kind]}</svg>`;
      return make("label", {}, input, icon.firstChild, t(kind));
    }),
  );
  const defaults = { density: 1800, overburden: 0, eccentricity: 0 };
  for (const [name, value] of Object.entries(defaults))
    if (!(name in w) && state.properties.wall[name].owners.includes(w.mechanism)) w[name] = value;
  if (w.mechanism === "two_block" && w.overburden > 0 && !("overburden_inertia" in w)) w.overburden_inertia = 0;
  /** @type {HTMLElement[]} */
  const parts = [
    make(
      "fieldset",
      {},
      make("legend", {}, t("wall")),
      kinds,
      ...rows("wall", WALL),
      ...(state.properties.wall.young_modulus.owners.includes(w.mechanism) ? [modulus()] : []),
    ),
  ];
  for (const [kind, { word, owners }] of Object.entries(PARTS)) {
    if (!owners.includes(w.mechanism)) continue;
    const count = partCount(word),
      names = lists(word),
      body = [];
    for (let i = 0; i < count; i++)
      body.push(
        make(
          "div",
          { class: "part" },
          make(
            "div",
            { class: "head" },
            t(word, { n: i + 1 }),
            make(
              "button",
              {
                class: "small",
                type: "button",
                "aria-label": `${t("remove")}: ${t(word, { n: i + 1 })}`,
                onclick: () => removePart(kind, i),
              },
              t("remove"),
            ),
          ),
          ...names.map((name) => {
            shown.add(`wall.${name}`);
            return row("wall", name, i);
          }),
        ),
      );
    if (word === "load" && count && typeof w.load_inertia === "string" && !w.load_inertia.includes(","))
      body.push(...rows("wall", ["load_inertia"]));
    if (word === "tie" && count)
      body.push(...rows("wall", ["masonry_compression", "masonry_shear", "masonry_tension"]));
    const adds = [
      make(
        "button",
        {
          class: "small",
          type: "button",
          onclick: () => {
            opened[kind] = true;
            addPart(kind);
          },
        },
        t(kind === "sections" && count ? "more_sections" : `add_${kind}`),
      ),
    ];
    if (
      word === "tie" &&
      count &&
      !("tie_plate_width" in w) &&
      !("tie_plate_diameter" in w) &&
      !("tie_anchor_force" in w)
    )
      adds.push(
        make(
          "button",
          {
            class: "small",
            type: "button",
            onclick: () => {
              Object.assign(w, {
                tie_plate_width: Array(count).fill(0.3),
                tie_plate_height: Array(count).fill(0.3),
                tie_plate_thickness: Array(count).fill(0.02),
                masonry_compression: 2e6,
                masonry_shear: 4e4,
                masonry_tension: 5e4,
              });
              again();
            },
          },
          t("add_plates"),
        ),
      );
    // A change is seen beside the wall before it, which must be kept first.
    if (word === "tie" && !count) body.push(make("p", { class: "hint" }, t("pin_hint")));
    parts.push(group(kind, opened[kind] ?? count > 0, count, ...body, make("div", { class: "adds" }, ...adds)));
  }
  const hasBuilding = "building" in state.settings,
    top = heightOf();
  parts.push(
    group(
      "building",
      opened.building ?? hasBuilding,
      0,
      ...(hasBuilding
        ? [
            ...rows("building", BUILDING),
            make(
              "div",
              { class: "adds" },
              make(
                "button",
                {
                  class: "small",
                  type: "button",
                  onclick: () => {
                    delete state.settings.building;
                    again();
                  },
                },
                t("remove"),
              ),
            ),
          ]
        : [
            make("p", { class: "hint" }, t("building_hint")),
            make(
              "div",
              { class: "adds" },
              make(
                "button",
                {
                  class: "small",
                  type: "button",
                  onclick: () => {
                    opened.building = true;
                    state.settings.building = {
                      period: [0.3],
                      damping: [0.05],
                      storeys: 2,
                      level: 0,
                      building_height: Math.max(6, top),
                    };
                    again();
                  },
                },
                t("add_building"),
              ),
            ),
          ]),
    ),
  );
  const site = "check" in state.settings;
  if (site)
    for (const [name, value] of Object.entries({
      use_class: "II",
      soil: "A",
      topography: "T1",
      knowledge_factor: 1.35,
      behaviour: 2,
      ultimate_state: "SLV",
    }))
      state.settings.check[name] ??= value;
  const siteRows = site ? rows("check", SITE) : [],
    byPlace = site && "latitude" in state.settings.check;
  const other = make(
    "button",
    {
      class: "small",
      type: "button",
      onclick: () => {
        const { ag, f0, tc_star, latitude, longitude, nominal_life, reference_life, exceedance, ...rest } =
          state.settings.check;
        keptSite[byPlace ? "place" : "values"] = Object.fromEntries(
          Object.entries(
            byPlace ? { latitude, longitude, nominal_life } : { ag, f0, tc_star, reference_life, exceedance },
          ).filter(([, value]) => value !== undefined),
        );
        state.settings.check = { ...(byPlace ? keptSite.values : keptSite.place), ...rest };
        state.fan = null;
        again();
      },
    },
    t(byPlace ? "by_values" : "by_place"),
  );
  parts.push(
    group(
      "site",
      opened.site ?? site,
      0,
      ...siteRows,
      ...(site ? damagedBuilding(shown) : []),
      make(
        "div",
        { class: "adds" },
        make(
          "button",
          {
            class: "small",
            type: "button",
            onclick: () => {
              if (site) delete state.settings.check;
              else state.settings.check = { ...VALUES, soil: "B" };
              opened.site = true;
              again();
            },
          },
          t(site ? "remove" : "add_site"),
        ),
        site ? other : "",
      ),
    ),
  );
  parts.push(analysis(shown));
  parts.push(others(shown));
  form.replaceChildren(...parts);
}
function analysis(shown) {
  state.settings.records ??= {};
  state.settings.stripes ??= {};
  const { records, stripes } = state.settings;
  for (const name of [
    "records.polarity",
    "records.catalogue",
    "stripes.im",
    "stripes.levels",
    "stripes.first",
    "stripes.last",
    "stripes.count",
  ])
    shown.add(name);
  records.polarity ??= "as_recorded";
  stripes.im ??= "pga";
  const auto = make("input", {
    type: "checkbox",
    id: "auto",
    checked: state.auto,
    onchange: () => {
      state.auto = auto.checked;
      if (!state.auto && state.answer) stripes.levels = state.answer.levels;
      again();
    },
  });
  const body = [
    choice("records", "polarity"),
    plainIm(),
    make("div", { class: "row one" }, make("label", { for: "auto" }, t("auto")), auto),
  ];
  if (!state.auto) body.push(plainRow("stripes", "levels"));
  return group("analysis", opened.analysis ?? !state.auto, 0, ...body);
}
function plainIm() {
  const choices = ["pga", "pgv", "sa(0.2)", "sa(0.5)", "sa(1)", "saavg(0.2:2)", "arias", "cav", "hi"],
    now = state.settings.stripes.im;
  const select = make(
    "select",
    {
      id: "im",
      onchange: () => {
        state.settings.stripes.im = select.value;
        state.auto = true;
        again();
      },
    },
    ...[...new Set([now, ...choices])].map((word) => make("option", { value: word, selected: word === now }, word)),
  );
  return make(
    "div",
    { class: "row one", "data-name": "stripes.im" },
    make("label", { for: "im", title: tip("stripes", "im") }, labelOf("im")),
    select,
  );
}
// What the case has besides, and a list of what it may have: nothing of a case is out of sight.
function others(shown) {
  const rest = [],
    may = [];
  for (const [of, table] of Object.entries(state.properties))
    for (const [name, { owners }] of Object.entries(table)) {
      const isHere = state.settings[of] && name in state.settings[of];
      if (isHere && !shown.has(`${of}.${name}`)) rest.push([of, name]);
      if (
        !isHere &&
        !shown.has(`${of}.${name}`) &&
        of !== "job" &&
        of in
          {
            wall: 1,
            solver: 1,
            records: 1,
            ...("building" in state.settings && { building: 1 }),
            ...("check" in state.settings && { check: 1 }),
          } &&
        (!owners.length || owners.includes(state.settings.wall.mechanism) || owners.includes("stripes"))
      )
        may.push([of, name]);
    }
  const select = make(
    "select",
    {
      "aria-label": t("add_property"),
      onchange: () => {
        const [of, name] = select.value.split("."),
          { kind, choices, low, default: usual } = state.properties[of][name],
          plain = usual.replaceAll("'", "");
        const number =
          Number.isFinite(Number(plain)) && plain !== ""
            ? Number(plain)
            : FIELDS[name]
              ? clean((FIELDS[name][0] + FIELDS[name][1]) / 2 / FIELDS[name][3])
              : Math.max(1, low > 0 ? low : 1);
        if (name === "top_displacement") delete state.settings.building.period;
        state.settings[of] ??= {};
        state.settings[of][name] = choices.length
          ? choices[0]
          : kind === "logical"
            ? true
            : kind === "text"
              ? plain || "wall"
              : kind === "list"
                ? Array(
                    Math.max(
                      1,
                      ...Object.values(PARTS)
                        .filter(({ word }) => isPart(name, word))
                        .map(({ word }) => partCount(word)),
                    ),
                  ).fill(number)
                : number;
        opened.others = true;
        again();
      },
    },
    make("option", { value: "" }, t("add_property")),
    ...may.map(([of, name]) =>
      make(
        "option",
        { value: `${of}.${name}`, title: tip(of, name) },
        `${labelOf(name)}${of === "wall" ? "" : ` (&${of})`}`,
      ),
    ),
  );
  return group(
    "others",
    opened.others ?? rest.length > 0,
    rest.length,
    ...rest.map(([of, name]) => row(of, name)),
    make("div", { class: "adds" }, select),
  );
}
// Mark the row that an error names
export function markWrong(errors) {
  for (const element of document.querySelectorAll(".row.wrong")) element.classList.remove("wrong");
  for (const { group: of, variable: name } of errors)
    if (name)
      document.querySelector(of ? `[data-name="${of}.${name}"]` : `[data-name$=".${name}"]`)?.classList.add("wrong");
}
