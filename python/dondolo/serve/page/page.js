// The page: what the answers of the server become.
import { chart, standalone } from "./chart.js";
import { draw, expand, fieldOf, markWrong } from "./form.js";
import { sentenceFor, sentenceOf } from "./refusals.js";
import { changed, post, state, whenTold } from "./state.js";
import { drawing, trace } from "./wall.js";
import { labelOf, language, learn, make, num, probability, sig, speak, t, the } from "./words.js";

const title = /** @type {HTMLInputElement} */ (the("title"));
/** @type {Record<string, string>} */
const UNITS = { pga: "g", pgv: "m/s", arias: "m/s", cav: "m/s", pgd: "m", hi: "m" };
const unitOf = (im) => (im.startsWith("sa") ? "g" : UNITS[im] || "");
const nameOf = (im) => {
  const unit = unitOf(im),
    name = im.startsWith("sa") ? im.replace("sa", "Sa") : im.toUpperCase();
  return unit ? `${name} [${unit}]` : name;
};
const still = matchMedia("(prefers-reduced-motion: reduce)");
let begun = {},
  film = null,
  making = null;

async function begin() {
  try {
    begun = await fetch("begin").then((response) => response.json());
  } catch {
    the("notice").hidden = false;
    the("notice").textContent = t("no_answer");
    return;
  }
  Object.assign(state, {
    settings: begun.settings,
    properties: begun.properties,
    auto: !("levels" in (begun.settings.stripes || {})),
  });
  learn(begun.words);
  speak(begun.lang);
  expand();
  words();
  draw();
  changed();
}

// Everything that does not depend on the answer
function words() {
  state.settings.job ??= { task: "stripes" };
  const { job } = state.settings;
  title.value = job.title || "";
  title.placeholder = t("untitled");
  title.setAttribute("aria-label", t("case_title"));
  document.title = `${job.title || t("untitled")} · dondolo`;
  the("wall-title").textContent = t("motion");
  the("case-title").textContent = t("case_file");
  const file = make("input", {
    type: "file",
    accept: ".nml,text/plain",
    onchange: () => {
      if (file.files?.[0]) file.files[0].arrayBuffer().then((bytes) => open(decoded(bytes)));
      file.value = "";
    },
  });
  const document_ = (kind, name, ending) =>
    make(
      "button",
      { type: "button", "data-kind": kind, onclick: () => makeDocument(kind, `${t(name)}.${ending}`) },
      ending === "docx" ? "Word" : t(kind),
    );
  the("actions").replaceChildren(
    make("label", { class: "file" }, t("open"), file),
    make("button", { type: "button", onclick: () => isWhole() && save(state.answer.text, `${slug()}.nml`) }, t("save")),
    ...begun.documents.map((kind) =>
      document_(
        kind,
        kind === "report" ? "file_report" : "file_relazione",
        kind === "relazione_word" ? "docx" : "html",
      ),
    ),
    make("button", { type: "button", onclick: saveFigure }, t("figure")),
    make(
      "button",
      {
        type: "button",
        lang: language() === "it" ? "en" : "it",
        onclick: () => {
          speak(language() === "it" ? "en" : "it");
          words();
          draw();
          changed();
        },
      },
      t("other_language"),
    ),
  );
  the("actions")
    .querySelector("[data-kind=relazione_word]")
    ?.setAttribute("aria-label", `${t("relazione")}, Word`);
  the("footer").replaceChildren(
    `dondolo ${begun.version} · ${t("records", { n: begun.records.length, name: begun.catalogue })} · ${t("local")}`,
  );
  filmForm();
}
title.addEventListener("input", () => {
  const { value } = title;
  if (value) state.settings.job.title = value;
  else delete state.settings.job.title;
  document.title = `${value || t("untitled")} · dondolo`;
  changed(true);
});
// The title as the name of a file, without accents
const slug = () =>
  (state.settings.job.title || "")
    .normalize("NFD")
    .replace(/[\u0300-\u036f]/g, "")
    .toLowerCase()
    .replace(/[^a-z0-9]+/g, "_")
    .replace(/^_|_$/g, "") || t("file_case");
function save(content, name) {
  const url = URL.createObjectURL(content instanceof Blob ? content : new Blob([content], { type: "text/plain" }));
  make("a", { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 10e3);
}
// UTF-8, or UTF-16 with a byte order mark, as every reader of cases takes it
function decoded(bytes) {
  const mark = new Uint8Array(bytes.slice(0, 2)).join();
  return new TextDecoder({ "255,254": "utf-16le", "254,255": "utf-16be" }[mark] || "utf-8").decode(bytes);
}
async function open(text) {
  try {
    const { settings } = await post("open", { text });
    Object.assign(state, {
      settings,
      auto: !("levels" in (settings.stripes || {})),
      fan: null,
      b: null,
      bAnswer: null,
    });
    expand();
    words();
    draw();
    changed();
    say(t("opened_records", { name: begun.catalogue }));
  } catch (error) {
    refuse(error, true);
  }
}
async function makeDocument(kind, name) {
  if (making || !isWhole()) return;
  const button = /** @type {HTMLButtonElement} */ (the("actions").querySelector(`[data-kind=${kind}]`)),
    before = button.textContent;
  making = kind;
  button.disabled = true;
  button.textContent = t("making");
  const settings = { ...state.settings, stripes: { ...state.settings.stripes, levels: state.answer.levels } };
  try {
    save(await post("document", { kind, settings, lang: language() }), `${slug()}_${name}`);
  } catch (error) {
    refuse(error, true);
  }
  making = null;
  button.disabled = false;
  button.textContent = before;
}
function saveFigure() {
  const svg = the("chart").querySelector("svg");
  if (svg && isWhole()) save(new Blob([standalone(svg.outerHTML)], { type: "image/svg+xml" }), `${slug()}.svg`);
}
const say = (text) => {
  the("said").textContent = text;
};

function refuse(error, isAside = false) {
  const errors = error.answer?.errors || [];
  the("notice").hidden = false;
  the("notice").replaceChildren(
    ...(isAside ? [] : [make("strong", {}, t("refused")), " "]),
    sentenceOf(error.answer, isAside),
  );
  if (isAside) return;
  markWrong(errors);
  // Nothing of another wall stays.
  the("numbers").replaceChildren();
  the("warnings").replaceChildren();
  the("check").replaceChildren();
  the("under").replaceChildren();
  the("text").textContent = "";
  the("chart").replaceChildren();
  the("wall").replaceChildren();
  stopFilm();
  the("film").hidden = true;
}

// How the library's verdict on a check looks: what is information has no colour, nor what is neither satisfied nor
// failed, nor what rigid blocks satisfy where the strip bends.
const lookOf = ([, , verdict, required], isBent) =>
  (required && { verified: isBent ? "" : "good", "not verified": "bad" }[verdict]) || "";

function number(key, value, unit, more, kind = "") {
  return make(
    "div",
    { class: kind },
    make("dt", {}, t(key)),
    make("dd", {}, value, unit ? make("small", {}, ` ${unit}`) : ""),
    more ? make("dd", { class: "more" }, more) : "",
  );
}
function show() {
  const a = state.answer,
    unit = unitOf(a.im),
    fitted = "theta" in a;
  the("notice").hidden = fitted;
  the("notice").textContent = fitted ? "" : a.sentence;
  markWrong([]);
  the("numbers").className = "numbers";
  the("numbers").replaceChildren(
    number(
      "theta",
      fitted ? sig(a.theta) : "–",
      unit,
      a.interval ? t("interval", { a: sig(a.interval[0]), b: sig(a.interval[1]) }) : "",
      "main",
    ),
    number("beta", fitted ? num(a.beta, 3) : "–", "", fitted && a.status !== "ok" ? a.sentence : ""),
    number(
      "trigger",
      num(a.trigger, 3),
      "g",
      a.greatest > 1.0001 * a.trigger ? t("greatest", { x: num(a.greatest, 3) }) : "",
    ),
    ...(a.check && "probability" in a.check
      ? [number("at_site", probability(a.check.probability), "", t("level_site", { x: num(a.check.pga, 3) }))]
      : []),
  );
  /** @type {{ x: number, label: string, kind: string }[]} */
  const marks = [];
  if (a.check?.capacities && a.im === "pga") {
    marks.push({ x: a.check.pga, label: t("level_site", { x: num(a.check.pga, 3) }), kind: "" });
    const verdicts = new Map(a.check.verdicts.map((one) => [one[0] + one[1], one]));
    for (const [method, limit, x] of a.check.capacities)
      if (limit === "SLV")
        marks.push({
          x,
          label: t("capacity", { method: t(method), state: limit, x: num(x, 3) }),
          kind: lookOf(verdicts.get(method + limit), a.check.is_bent),
        });
  }
  the("chart").classList.remove("old");
  the("film").hidden = false;
  const b = state.bAnswer && state.bAnswer.im === a.im ? state.bAnswer : null;
  the("chart").innerHTML = chart(a, b, {
    width: the("chart").clientWidth || 640,
    im: nameOf(a.im),
    marks,
    fan: a.fan || [],
  });
  under(a, unit);
  the("warnings").replaceChildren(
    ...[
      ...(a.leans ? [t("no_building")] : []),
      ...(a.unchecked.length ? [t("anchors", { n: a.unchecked.map((n) => t("tie_n", { n })).join(", ") })] : []),
      ...a.warnings.filter(({ code }) => code !== "note").map(({ sentence }) => sentence),
      ...(begun.synthetic ? [t("synthetic")] : []),
    ].map((sentence) => make("li", {}, sentence)),
  );
  check(a.check);
  if (film === null) the("wall").innerHTML = drawing(a.wall);
  the("text").textContent = a.text;
  if (!a.draft && state.isNewest) say(fitted ? t("said", { x: sig(a.theta), unit }) : t("no_curve"));
}
function under(a, _unit) {
  /** @type {HTMLElement[]} */
  const rows = [
    make(
      "button",
      {
        type: "button",
        class: "small",
        onclick: () => {
          state.b = structuredClone({ ...state.settings, stripes: { ...state.settings.stripes, levels: a.levels } });
          state.bAnswer = a;
          state.bAuto = state.auto;
          changed();
        },
      },
      t("pin"),
    ),
  ];
  const other = state.b;
  if (other)
    rows.push(
      make(
        "button",
        {
          type: "button",
          class: "small",
          onclick: () => {
            const auto = state.bAuto;
            state.settings = structuredClone(other);
            if (auto) delete state.settings.stripes.levels;
            state.auto = auto;
            state.fan = null;
            words();
            draw();
            changed();
          },
        },
        t("back"),
      ),
      make(
        "button",
        {
          type: "button",
          class: "small",
          onclick: () => {
            state.b = state.bAnswer = null;
            changed();
          },
        },
        t("unpin"),
      ),
    );
  rows.push(
    make("span", { class: "said" }, a.draft ? t("draft") : t("histories", { n: a.histories, ms: num(a.ms, 0) })),
  );
  if (state.b && a.comparison && !a.draft)
    rows.push(
      make(
        "div",
        { class: "compare" },
        t(a.comparison.unchecked ? "better_if" : "better", {
          x: `${num(100 * a.comparison.ratio, 0)} %`,
          a: num(100 * a.comparison.interval[0], 0),
          b: num(100 * a.comparison.interval[1], 0),
        }),
      ),
    );
  if (state.fan && a.fan) {
    const [low, high] = a.fan,
      { group, name, place } = state.fan,
      field = fieldOf(name),
      given = state.settings[group][name],
      value = [].concat(given)[place ?? 0];
    const refused = a.fan.find((one) => one.refused),
      other = ({ factor }) => ({
        ...state.settings,
        [group]: {
          ...state.settings[group],
          [name]: Array.isArray(given) ? given.with(place ?? 0, factor * value) : factor * value,
        },
      });
    const shown = (one) =>
      field ? `${num(one.factor * value * field[3], field[5])} ${field[4]}` : sig(one.factor * value);
    rows.push(
      make(
        "div",
        { class: "compare" },
        refused
          ? `${labelOf(state.fan.name)} ${shown(refused)}: ${sentenceFor(other(refused), refused.refused)}`
          : t("fan", {
              what: labelOf(state.fan.name),
              low: shown(low),
              high: shown(high),
              x: low.theta ? sig(Math.min(low.theta, high.theta ?? low.theta)) : "–",
              y: high.theta ? sig(Math.max(high.theta, low.theta ?? high.theta)) : "–",
            }),
      ),
    );
  }
  the("under").replaceChildren(...rows);
}
function check(found) {
  if (!found) {
    the("check").replaceChildren();
    return;
  }
  if (found.refused) {
    the("check").replaceChildren(make("p", { class: "hint" }, sentenceOf(found.refused)));
    return;
  }
  const lines = new Map(found.lines.map((one) => [`${one.method} ${one.limit_state}`, one]));
  const amount = (x, unit) => (x === null ? "–" : unit === "m" ? `${num(100 * x, 2)} cm` : `${num(x, 3)} m/s²`);
  const chance = (p) =>
    p === null
      ? "–"
      : probability(p[0]) +
        (p[1] === null || probability(p[2]) === probability(p[0])
          ? ""
          : ` (${probability(p[1])}–${probability(p[2])})`);
  const hasCurve = found.lines.some((one) => one.at_site !== null);
  const rows = found.verdicts.map((one) => {
    const [method, limit, verdict, required] = one,
      line = lines.get(`${method} ${limit}`),
      look = lookOf(one, found.is_bent);
    const numbers = [
      amount(line.capacity, line.unit),
      amount(line.demand, line.unit),
      line.ratio === null ? "–" : num(line.ratio, 2),
      line.allowed_pga === null ? "–" : num(line.allowed_pga, 3),
    ];
    return make(
      "tr",
      {},
      make("th", { scope: "row" }, `${t(method)} ${limit}`),
      ...numbers.map((x) => make("td", { class: "n" }, x)),
      make(
        "td",
        { class: look },
        (look === "good" ? "✓ " : look === "bad" ? "✗ " : "") +
          t(`verdict.${verdict}`) +
          (found.is_bent && verdict === "verified" ? t("if_rigid") : "") +
          (required ? "" : t("information")),
      ),
      ...(hasCurve ? [line.at_allowed, line.at_site].map((p) => make("td", { class: "n" }, chance(p))) : []),
    );
  });
  const heads = [
    "method",
    "withstands",
    "asked",
    "over",
    "capacity_head",
    "outcome",
    ...(hasCurve ? ["chance_allowed", "chance_site"] : []),
  ].map((key) => make("th", { scope: "col", class: ["method", "outcome"].includes(key) ? "" : "n" }, t(key)));
  const failed = rows.some((row) => row.querySelector(".bad")) && found.probability < 0.01;
  the("check").replaceChildren(
    make(
      "div",
      { class: "scroll" },
      make(
        "table",
        {},
        make("caption", {}, `${t("check_title")}, α₀ = ${num(found.alpha_0, 3)}`),
        make("thead", {}, make("tr", {}, ...heads)),
        make("tbody", {}, ...rows),
      ),
    ),
    ...(found.hazard ?? []).map(([name, ag, f0, tc, years]) =>
      make(
        "p",
        { class: "hint" },
        t("hazard", { state: name, ag: num(ag, 3), f0: num(f0, 3), tc: num(tc, 3), years: num(years, 0) }),
      ),
    ),
    failed ? make("p", { class: "hint" }, t("check_why")) : "",
    ...found.notes.map((note) => make("p", { class: "hint" }, note.replace(/^alpha_0/, "α₀"))),
  );
}

// The motion under one record, whose peak is between these [g]
const LEAST = 0.05,
  GREATEST = 2.5;
function filmForm() {
  const record = make(
    "select",
    {
      id: "record",
      onchange: () => {
        state.record = Number(record.value);
        stopFilm();
        show_();
      },
    },
    ...begun.records.map((name, i) => make("option", { value: i, selected: i === state.record }, name)),
  );
  const out = make("span", { class: "unit" }, `${num(state.pga, 2)} g`);
  const range = make("input", {
    type: "range",
    id: "pga",
    min: LEAST,
    max: GREATEST,
    step: 0.05,
    value: state.pga,
    oninput: () => {
      state.pga = Number(range.value);
      out.textContent = `${num(state.pga, 2)} g`;
      paint();
      stopFilm();
      show_();
    },
  });
  const paint = () =>
    range.style.setProperty("--part", `${(100 * (Number(range.value) - LEAST)) / (GREATEST - LEAST)}%`);
  paint();
  const button = make(
    "button",
    { type: "button", id: "play", class: "first", onclick: () => (film ? endFilm() : play()) },
    t("play"),
  );
  the("film").replaceChildren(
    make(
      "div",
      { class: "film" },
      make("label", { for: "record" }, t("record")),
      record,
      make("div", { class: "row" }, make("label", { for: "pga" }, t("pga")), out, range),
      make("div", { class: "buttons" }, button, make("span", { id: "outcome", role: "status" })),
      make("div", { id: "trace" }),
    ),
  );
}
const show_ = () => {
  if (state.answer) the("wall").innerHTML = drawing(state.answer.wall);
};
function endFilm() {
  stopFilm();
  show_();
}
function stopFilm() {
  if (film) cancelAnimationFrame(film.frame);
  film = null;
  const button = document.getElementById("play");
  if (button) {
    button.textContent = t("play");
    the("outcome").textContent = "";
    the("trace").replaceChildren();
  }
}
async function play() {
  if (!state.answer || !state.isNewest) return;
  const version = state.version,
    settings = { ...state.settings, stripes: { ...state.settings.stripes, levels: state.answer.levels } };
  try {
    const motion = await post("motion", { settings, record: state.record, pga: state.pga, lang: language() });
    if (version !== state.version) return;
    film = { motion, frame: 0 };
    the("play").textContent = t("stop");
    const outcome = () => {
      the("outcome").textContent = motion.collapsed ? t("falls") : t("stands", { x: `${num(100 * motion.edp, 0)} %` });
      the("outcome").className = motion.collapsed ? "bad" : "good";
    };
    const paint = (i) => {
      the("wall").innerHTML = drawing(state.answer.wall, motion.frames[i]);
      the("trace").innerHTML = trace(motion, i);
    };
    if (still.matches) {
      paint(motion.peak);
      outcome();
      return;
    }
    const span = motion.instants[motion.instants.length - 1] - motion.instants[0],
      speed = Math.max(1, span / 12),
      start = performance.now();
    const tick = (now) => {
      const i = Math.min(
        motion.instants.length - 1,
        Math.max(0, Math.floor((((now - start) / 1e3) * speed * (motion.instants.length - 1)) / span)),
      );
      paint(i);
      if (i < motion.instants.length - 1) film.frame = requestAnimationFrame(tick);
      else {
        outcome();
        the("play").textContent = t("stop");
      }
    };
    film.frame = requestAnimationFrame(tick);
  } catch (error) {
    refuse(error, true);
  }
}

// Whether the page has the whole answer to what its sliders say: what is saved must be of them.
const isWhole = () => state.answer !== null && state.isNewest && !state.answer.draft;

let fade = 0;
whenTold((what, error) => {
  if (what === "waiting") {
    if (film) {
      stopFilm();
    }
    // Numbers of the wall before are hidden at once; its curve fades if the answer is late.
    document.body.classList.add("stale");
    fade ||= setTimeout(() => {
      the("chart").classList.add("old");
      the("wall").classList.add("old");
    }, 250);
    return;
  }
  clearTimeout(fade);
  fade = 0;
  document.body.classList.toggle("stale", what === "answer" && !state.isNewest);
  if (what === "refused") refuse(error);
  else {
    the("wall").classList.remove("old");
    show();
  }
  window.dispatchEvent(new CustomEvent("painted"));
});
let width = 0;
new ResizeObserver(() => {
  if (Math.abs(the("chart").clientWidth - width) > 8) {
    width = the("chart").clientWidth;
    if (state.answer) show();
  }
}).observe(the("chart"));
begin();
