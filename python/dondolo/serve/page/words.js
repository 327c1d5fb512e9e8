// Words of the page in English, those of other languages as the server sends them, and numbers as the language writes
// them.
const WORDS = {
  open: "Open case…",
  save: "Case (.nml)",
  report: "Report",
  relazione: "Calculation report",
  figure: "Figure (SVG)",
  other_language: "Italiano",
  case_title: "Title of the case",
  untitled: "Untitled wall",
  one_sided: "overturns outwards",
  free_standing: "free on both sides",
  two_block: "bends between floors",
  horizontal: "bends horizontally",
  corner: "corner overturns",
  wall: "Wall",
  sections: "Storeys",
  loads: "Loads",
  thrusts: "Thrusts",
  ties: "Ties",
  pushes: "Pushes",
  building: "Building",
  site: "Site, NTC 2018",
  analysis: "Records and levels",
  others: "Other properties",
  section: "Storey {n}",
  load: "Load {n}",
  thrust: "Thrust {n}",
  tie: "Tie {n}",
  push: "Push {n}",
  add_sections: "split into storeys",
  more_sections: "+ storey",
  add_loads: "+ load",
  add_thrusts: "+ thrust",
  add_ties: "+ tie",
  add_pushes: "+ push",
  add_plates: "+ plates",
  add_building: "put it on a building",
  add_damaged: "+ building at the limit states",
  remove_damaged: "the worst building again",
  building_at: "building at {state}",
  add_site: "check by NTC 2018",
  by_place: "by coordinates",
  by_values: "by a_g, F₀, T*c",
  hazard: "{state}: a_g {ag} g, F₀ {f0}, T*c {tc} s, T_R {years} years",
  remove: "remove",
  add_property: "Add a property…",
  damaged_hint:
    "SLV and SLC have the worst building between T₁ and 2 T₁ (C8.7.1.2.1.4); values of a pushover analysis can" +
    " be given instead.",
  building_hint:
    "Only a wall on the ground with nothing behind it needs none: without a building, one that leans on a floor" +
    " or roof is unconservative.",
  auto: "Levels chosen for the wall",
  "polarity.both": "both ways",
  "polarity.as_recorded": "as recorded",
  "polarity.reversed": "reversed",
  "load_inertia.both": "moved and lifted",
  "load_inertia.none": "stays with the building",
  "load_inertia.vertical": "is lifted",
  "hinge_at.storeys": "every storey",
  "restitution.default": "as is usual",
  "restitution.sorrentino": "Sorrentino",
  "restitution.impulse": "impulse",
  "bearing.inner": "inner face",
  "bearing.outer": "outer face",
  "bearing.centre": "centre",
  "vertical.none": "none",
  "vertical.recorded": "recorded",
  "states.separate": "separate",
  "states.ordinal": "one dispersion",
  "engine.auto": "automatic",
  "code.ntc2018": "NTC 2018",
  "logical.true": "yes",
  "logical.false": "no",
  theta: "Median θ",
  beta: "Dispersion β",
  trigger: "Starts to rock",
  at_site: "P at the site",
  level_site: "a_g S = {x} g",
  greatest: "with ties up to {x} g",
  interval: "95 %: {a}–{b}",
  collapse: "Probability of collapse",
  curve_title: "Probability of collapse against {im}",
  linear: "linear",
  nonlinear: "nonlinear",
  capacity: "{method} {state} {x}",
  check_title: "NTC 2018, local mechanism",
  method: "Check",
  capacity_head: "Allowed a_g S [g]",
  withstands: "Capacity",
  asked: "Demand",
  over: "Capacity / demand",
  chance_allowed: "P(collapse) where allowed (95 %)",
  chance_site: "P(collapse) at the site (95 %)",
  outcome: "Outcome",
  "verdict.verified": "satisfied",
  information: " (information)",
  "verdict.verified if no hinge slides": "satisfied, if no hinge slides",
  if_rigid: ", if the strip does not bend",
  "verdict.verified if its ties are": "satisfied, if the anchors of its ties are",
  "verdict.not verified": "not satisfied",
  "verdict.not applicable": "not applicable",
  check_why:
    "A check can fail although collapse is improbable: its capacity is a share of the wall’s, by the code’s" +
    " factors.",
  pin: "Keep as B, to compare",
  pin_hint: "What a tie buys: keep the wall as B below the curve, then add the tie.",
  unpin: "Remove B",
  back: "Return to B",
  better: "θ of A is {x} of B (95 %: {a}–{b}), same records",
  better_if: "If the anchors of the ties hold, which is not checked, θ of A is {x} of B (95 %: {a}–{b}), same records",
  no_building: "Without a building: unconservative for a wall that a floor or a roof holds, or that stands on one.",
  anchors:
    "The anchors of {n} are not checked, and the curve takes them to hold: give their plates or the force at" +
    " which they give way.",
  fan: "{what} {low} and {high}: θ {x} to {y} g",
  fan_button: "Uncertainty of {what}",
  draft: "draft: half of the records",
  histories: "{n} histories in {ms} ms",
  refused: "This wall has no curve.",
  no_answer: "The server does not answer: is dondolo serve still running?",
  motion: "The wall",
  record: "Record",
  pga: "PGA",
  play: "Play",
  stop: "Stop",
  falls: "falls",
  stands: "stands, up to {x} of its capacity",
  no_shape: "A wall that is given by a table has no shape.",
  rotation: "rotation / capacity",
  case_file: "Case file",
  making: "being made…",
  synthetic: "Synthetic accelerograms: a study needs recorded ones, dondolo serve --records CATALOGUE.",
  records: "{n} accelerograms of {name}",
  local: "this computer only",
  opened_records: "Opened. The records are those of the page, {name}.",
  said: "Median {x} {unit}",
  no_curve: "No curve",
  wall_alt: "The wall at rest and at half of its capacity, to scale",
  tie_n: "tie {n}",
  transverse: "transverse wall",
  transverse_walls: "transverse walls",
  in_case: "in the case: {name} = {value}",
  free_modulus: "Free element, E by masonry",
  no_modulus: "not given",
  own_modulus: "as in the case",
  irregular_stone: "Irregular stone, pebbles",
  rough_stone: "Roughly cut stone",
  split_stone: "Split stone, well laid",
  irregular_soft: "Irregular soft stone",
  regular_soft: "Regular soft stone",
  squared_stone: "Squared stone blocks",
  solid_bricks: "Solid bricks, lime mortar",
  perforated_bricks: "Perforated bricks, cement mortar",
  file_case: "case",
  file_report: "report",
  file_relazione: "calculation_report",
  year: "year",
};
// Names of the properties of a case
const LABELS = {
  title: "Title",
  threads: "Threads",
  spreadsheet_safe: "Safe for spreadsheets",
  histories: "Table of histories",
  task: "Task",
  output: "Results",
  name: "Name",
  mechanism: "Mechanism",
  height: "Height",
  thickness: "Thickness",
  density: "Density",
  section_height: "Height",
  section_thickness: "Thickness",
  section_fill: "Share of masonry",
  section_offset: "Set back by",
  section_base_width: "Width at the bottom",
  section_top_width: "Width at the top",
  leaves: "Leaves",
  hinge_level: "Levels of hinges",
  hinge_at: "Hinges at",
  mass: "Mass",
  centroid_depth: "Centroid, depth",
  centroid_height: "Centroid, height",
  hinge_inertia: "Inertia about the hinge",
  hinge_depth: "Depth of the hinge",
  compressive_strength: "Compressive strength",
  stress_block: "Stress block",
  young_modulus: "Young’s modulus",
  free: "Free element",
  edge_radius: "Radius of the edge",
  load: "Load",
  load_depth: "… behind the outer face",
  load_height: "… height",
  load_inertia: "Mass of the loads",
  load_lifted: "… share lifted",
  load_pushed: "… share pushed",
  load_seat: "… loses its seat after",
  inertia_mass: "Masses pushed",
  inertia_depth: "… behind the outer face",
  inertia_height: "… height",
  inertia_x: "… x",
  thrust: "Thrust",
  thrust_depth: "… behind the outer face",
  thrust_height: "… height",
  thrust_decay: "… decays over",
  load_total: "Load in all",
  load_x: "… x",
  thrust_total: "Thrust in all",
  thrust_x: "… x",
  spring: "Springs",
  spring_depth: "Springs, depth",
  spring_height: "Springs, height",
  distributed_spring: "Distributed springs",
  distributed_spring_depth: "Distributed springs, depth",
  distributed_spring_bottom: "Distributed springs, from height",
  distributed_spring_top: "Distributed springs, to height",
  tie_height: "Height",
  tie_depth: "… behind the outer face",
  tie_area: "Section per metre",
  tie_bar: "Bar diameter",
  tie_spacing: "Spacing",
  tie_length: "Free length",
  tie_modulus: "Modulus",
  tie_strength: "Yield stress",
  tie_preload: "Preload",
  tie_strain: "Strain at break",
  tie_anchor_force: "Anchor force",
  tie_anchor_total: "Anchor force in all",
  tie_plate_width: "Plate width",
  tie_plate_height: "Plate height",
  tie_plate_diameter: "Plate diameter",
  tie_plate_thickness: "Plate thickness",
  tie_leaf: "Masonry under the plate",
  tie_compression: "Stress at the plate",
  masonry_compression: "Masonry, compression",
  masonry_shear: "Masonry, shear",
  masonry_tension: "Masonry, tension",
  masonry_friction: "Masonry, friction",
  masonry_knowledge_factor: "Masonry, FC",
  bearing_factor: "Factor under a plate",
  interlock_overlap: "Interlocking, overlap",
  interlock_course: "Interlocking, course",
  interlock_thickness: "Transverse walls, thickness",
  interlock_spacing: "Transverse walls, spacing",
  interlock_friction: "Interlocking, friction",
  facade_length: "Length of the facade",
  wedge_thickness: "Wedges, thickness",
  wedge_angle: "Wedges, angle",
  wedge_bottom: "Wedges, from height",
  wedge_top: "Wedges, to height",
  wedge_length: "Wedges, greatest length",
  elevation_x: "Elevation, x",
  elevation_z: "Elevation, height",
  opening_x: "Openings, x",
  opening_z: "Openings, height above the base",
  opening_width: "Openings, width",
  opening_height: "Openings, height",
  axis_x: "Axis, x of two points",
  axis_z: "Axis, height of these points",
  half_gable: "Half of a gable",
  wing_angle: "Wings, angle",
  wing_length: "Wings, greatest length",
  length: "Length",
  end_thrust: "Thrust at the ends",
  hinge_x: "Hinge, from the first end",
  push: "Force",
  push_x: "From the first end",
  hinge: "Hinge, of the height",
  hinge_range: "Hinges, from and to",
  elastic_period: "Elastic period",
  elastic_damping: "Elastic damping",
  restitution: "Restitution",
  restitution_value: "Restitution e",
  restitution_factor: "Factor on restitution",
  base_level: "Level of the base",
  restitution_sd: "Scatter of restitution",
  restitution_seed: "Seed of the scatter",
  overburden: "Load on top",
  overburden_inertia: "… share that is lifted",
  eccentricity: "… off the centreline",
  bearing: "… bears at",
  bearing_distance: "… distance from the face",
  table: "Table",
  rotation: "Rotations",
  inertia: "Inertia J",
  lever: "Lever L",
  moment: "Moment G − Q",
  vertical_lever: "Lever S",
  travel: "Displacement d",
  weighted_lever: "Weights times levers",
  weight: "Weights",
  displacement: "Displacements of the weights",
  sides: "Sides",
  top_share: "Share of the top",
  top_tilt: "Tilt of the top",
  bodies: "File of the bodies",
  joints: "File of the joints",
  actions: "File of the actions",
  ties: "File of ties",
  driver: "Driving body",
  gravity_share: "Part of gravity",
  body_table: "Bodies",
  joint_table: "Joints",
  action_table: "Actions",
  tie_table: "Ties",
  period: "Period",
  damping: "Damping",
  participation: "Participation",
  storeys: "Storeys",
  level: "Level of the base",
  level_top: "Level of the top",
  building_height: "Height of the building",
  top_displacement: "Displacement of the top",
  participation_top: "Participation at the top",
  diaphragm_period: "Floor above, period",
  diaphragm_damping: "Floor above, damping",
  diaphragm_participation: "Floor above, participation",
  refine: "Parts of a step",
  catalogue: "Catalogue",
  polarity: "Direction",
  vertical: "Vertical motion",
  vertical_factor: "Vertical factor",
  im: "Intensity measure",
  levels: "Levels",
  first: "First level",
  last: "Last level",
  count: "Number of levels",
  edp_thresholds: "Damage states",
  states: "Their curves",
  engine: "Engine",
  rtol: "Relative error",
  atol: "Absolute error",
  edp_limit: "Collapse at rotation / capacity",
  estimate_error: "Estimate errors",
  certify: "Certify",
  gravity: "Gravity",
  code: "Code",
  ag: "a_g",
  f0: "F₀",
  tc_star: "T*c",
  soil: "Soil",
  topography: "Topography",
  knowledge_factor: "Confidence factor FC",
  behaviour: "Behaviour factor q",
  reference_life: "Reference period V_R",
  exceedance: "Probabilities P_VR",
  latitude: "Latitude (WGS84)",
  longitude: "Longitude (WGS84)",
  nominal_life: "Nominal life V_N",
  use_class: "Class of use",
  ultimate_state: "Ultimate state",
  friction: "Friction at the hinges",
  building_period: "Building, T₁ by limit state",
  building_damping: "Building, damping by limit state",
};
let spoken = "en";
/** @type {Record<string, Record<string, Record<string, string>>>} */
let catalogues = {};

export const language = () => spoken;
export const speak = (lang) => {
  spoken = lang === "it" ? "it" : "en";
  document.documentElement.lang = lang;
};
// What the server has in other languages: of each words, labels and refusals by their keys
export const learn = (several) => {
  catalogues = several;
};
const translated = (what, key) => catalogues[spoken]?.[what][key];
export const has = (key) => key in WORDS;
// Short name of a property; one that has none is called as in the case.
export const labelOf = (name) => translated("labels", name) ?? LABELS[name] ?? name;
const wordOf = (key) => translated("words", key) ?? WORDS[key];
// A word that a property may be, as the page says it; names that the case has are left.
export const choiceOf = (name, word) => wordOf(`${name}.${word}`) ?? word;
const filled = (sentence, values) => sentence.replace(/\{(\w+)\}/g, (_, name) => values[name]);
export const t = (key, values = {}) => filled(wordOf(key), values);
// A sentence of what is wrong, by its key; none in English, which has that of the library
export const refusal = (key, values = {}) => {
  const sentence = translated("refusals", key);
  return sentence && filled(sentence, values);
};

// A number with the decimal mark of the language
export const num = (x, digits) => {
  const text = digits === undefined ? String(Number(x.toPrecision(12))) : x.toFixed(digits);
  return (spoken === "it" ? text.replace(".", ",") : text).replace("-", "−");
};
export const sig = (x, digits = 3) => {
  if (x === 0) return "0";
  return num(x, Math.max(0, digits - 1 - Math.floor(Math.log10(Math.abs(x)))));
};
export const probability = (p) => (p < 0.0005 ? `< ${num(0.0005, 4)}` : p > 0.9995 ? `> ${num(0.9995, 4)}` : num(p, 3));
export const read = (text) => {
  const plain = text.trim().replace("−", "-").replace(",", ".");
  return /^[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?$/i.test(plain) ? Number(plain) : NaN;
};

// An element that page.html has
/** @type {(id: string) => HTMLElement} */
export const the = (id) => {
  const element = document.getElementById(id);
  if (element === null) throw new Error(`no element ${id}`);
  return element;
};
// Elements: make("button", {class: "small", onclick: f}, "text", child ...)
/**
 * @template {keyof HTMLElementTagNameMap} K
 * @param {K} tag
 * @param {Record<string, any>} attributes
 * @param {(Node | string | null | undefined | false)[]} children
 * @returns {HTMLElementTagNameMap[K]}
 */
export const make = (tag, attributes = {}, ...children) => {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === undefined || value === null || value === false) continue;
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else element.setAttribute(name, value === true ? "" : value);
  }
  for (const child of children) if (child !== null && child !== undefined && child !== false) element.append(child);
  return element;
};
// An element of SVG as text: its attributes are written in their order
export const tag = (name, attributes, content) => {
  const written = Object.entries(attributes).map(([key, value]) => ` ${key}="${value}"`);
  return `<${name}${written.join("")}${content === undefined ? "/>" : `>${content}</${name}>`}`;
};
// A picture of SVG that may be a file of its own
export const picture = (w, h, title, parts) => {
  const box = { viewBox: `0 0 ${w} ${h}`, role: "img", "aria-label": safe(title) };
  return tag("svg", { xmlns: "http://www.w3.org/2000/svg", ...box }, parts.join(""));
};
export const safe = (text) => String(text).replace(/[&<>"']/g, (c) => `&#${c.charCodeAt(0)};`);
