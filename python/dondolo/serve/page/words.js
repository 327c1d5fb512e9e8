// Words of the page, English and Italian, and numbers as the language writes them.
const WORDS = {
  open: ["Open case…", "Apri caso…"],
  save: ["Case (.nml)", "Caso (.nml)"],
  report: ["Report", "Rapporto"],
  relazione: ["Calculation report", "Relazione di calcolo"],
  figure: ["Figure (SVG)", "Figura (SVG)"],
  other_language: ["Italiano", "English"],
  case_title: ["Title of the case", "Titolo del caso"],
  untitled: ["Untitled wall", "Parete senza titolo"],
  one_sided: ["overturns outwards", "ribaltamento semplice"],
  free_standing: ["free on both sides", "libera sui due lati"],
  two_block: ["bends between floors", "flessione verticale"],
  corner: ["corner overturns", "ribaltamento del cantonale"],
  wall: ["Wall", "Parete"],
  sections: ["Storeys", "Piani"],
  loads: ["Loads", "Carichi"],
  thrusts: ["Thrusts", "Spinte"],
  ties: ["Ties", "Catene"],
  building: ["Building", "Edificio"],
  site: ["Site, NTC 2018", "Sito, NTC 2018"],
  analysis: ["Records and levels", "Accelerogrammi e livelli"],
  others: ["Other properties", "Altre proprietà"],
  section: ["Storey {n}", "Piano {n}"],
  load: ["Load {n}", "Carico {n}"],
  thrust: ["Thrust {n}", "Spinta {n}"],
  tie: ["Tie {n}", "Catena {n}"],
  add_sections: ["split into storeys", "dividi in piani"],
  more_sections: ["+ storey", "+ piano"],
  add_loads: ["+ load", "+ carico"],
  add_thrusts: ["+ thrust", "+ spinta"],
  add_ties: ["+ tie", "+ catena"],
  add_plates: ["+ plates", "+ capochiave"],
  add_building: ["put it on a building", "colloca su un edificio"],
  add_damaged: ["+ building at the limit states", "+ edificio agli stati limite"],
  remove_damaged: ["the worst building again", "di nuovo l’edificio peggiore"],
  building_at: ["building at {state}", "edificio allo {state}"],
  add_site: ["check by NTC 2018", "verifica NTC 2018"],
  by_place: ["by coordinates", "da coordinate"],
  by_values: ["by a_g, F₀, T*c", "da a_g, F₀, T*c"],
  hazard: [
    "{state}: a_g {ag} g, F₀ {f0}, T*c {tc} s, T_R {years} years",
    "{state}: a_g {ag} g, F₀ {f0}, T*c {tc} s, T_R {years} anni",
  ],
  remove: ["remove", "togli"],
  add_property: ["Add a property…", "Aggiungi una proprietà…"],
  damaged_hint: [
    "SLV and SLC have the worst building between T₁ and 2 T₁ (C8.7.1.2.1.4); values of a pushover analysis can be" +
      " given instead.",
    "SLV e SLC hanno l’edificio peggiore tra T₁ e 2 T₁ (C8.7.1.2.1.4); si possono assegnare i valori di " +
      "un’analisi statica non lineare.",
  ],
  building_hint: [
    "Only a wall on the ground with nothing behind it needs none: without a building, one that leans on a floor " +
      "or roof is unconservative.",
    "Non serve solo per una parete a terra senza nulla alle spalle: senza edificio, una parete appoggiata a un " +
      "solaio o a un tetto è a sfavore di sicurezza.",
  ],
  auto: ["Levels chosen for the wall", "Livelli scelti per la parete"],
  "polarity.both": ["both ways", "nei due versi"],
  "polarity.as_recorded": ["as recorded", "come registrato"],
  "polarity.reversed": ["reversed", "invertito"],
  "load_inertia.both": ["moved and lifted", "spinta e sollevata"],
  "load_inertia.none": ["stays with the building", "resta all’edificio"],
  "load_inertia.vertical": ["is lifted", "è sollevata"],
  "hinge_at.storeys": ["every storey", "ogni piano"],
  "restitution.default": ["as is usual", "quello usuale"],
  "restitution.sorrentino": ["Sorrentino", "Sorrentino"],
  "restitution.impulse": ["impulse", "impulso"],
  "bearing.inner": ["inner face", "faccia interna"],
  "bearing.outer": ["outer face", "faccia esterna"],
  "bearing.centre": ["centre", "mezzeria"],
  "vertical.none": ["none", "nessuno"],
  "vertical.recorded": ["recorded", "registrato"],
  "states.separate": ["separate", "separate"],
  "states.ordinal": ["one dispersion", "una dispersione"],
  "engine.auto": ["automatic", "automatico"],
  "code.ntc2018": ["NTC 2018", "NTC 2018"],
  "logical.true": ["yes", "sì"],
  "logical.false": ["no", "no"],
  theta: ["Median θ", "Mediana θ"],
  beta: ["Dispersion β", "Dispersione β"],
  trigger: ["Starts to rock", "Innesco"],
  at_site: ["P at the site", "P al sito"],
  level_site: ["a_g S = {x} g", "a_g S = {x} g"],
  greatest: ["with ties up to {x} g", "con catene fino a {x} g"],
  interval: ["95 %: {a}–{b}", "95 %: {a}–{b}"],
  collapse: ["Probability of collapse", "Probabilità di crollo"],
  curve_title: ["Probability of collapse against {im}", "Probabilità di crollo in funzione di {im}"],
  linear: ["linear", "lineare"],
  nonlinear: ["nonlinear", "non lineare"],
  capacity: ["{method} {state} {x}", "{method} {state} {x}"],
  check_title: ["NTC 2018, local mechanism", "NTC 2018, meccanismo locale"],
  method: ["Check", "Verifica"],
  capacity_head: ["Allowed a_g S [g]", "a_g S ammessa [g]"],
  withstands: ["Capacity", "Capacità"],
  asked: ["Demand", "Domanda"],
  over: ["Capacity / demand", "Capacità/domanda"],
  chance_allowed: ["P(collapse) where allowed (95 %)", "P(crollo) per quella ammessa (95 %)"],
  chance_site: ["P(collapse) at the site (95 %)", "P(crollo) al sito (95 %)"],
  outcome: ["Outcome", "Esito"],
  "verdict.verified": ["satisfied", "soddisfatta"],
  information: [" (information)", " (informazione)"],
  "verdict.verified if no hinge slides": ["satisfied, if no hinge slides", "soddisfatta, se nessuna cerniera scorre"],
  if_rigid: [", if the strip does not bend", ", se la parete non si inflette"],
  "verdict.verified if its ties are": [
    "satisfied, if the anchors of its ties are",
    "soddisfatta, se lo sono gli ancoraggi delle catene",
  ],
  "verdict.not verified": ["not satisfied", "non soddisfatta"],
  "verdict.not applicable": ["not applicable", "non applicabile"],
  check_why: [
    "A check can fail although collapse is improbable: its capacity is a share of the wall’s, by the code’s factors.",
    "Una verifica può non essere soddisfatta anche se il crollo è improbabile: la sua capacità è una quota di " +
      "quella della parete, per i coefficienti della norma.",
  ],
  pin: ["Keep as B, to compare", "Fissa come B, per confronto"],
  pin_hint: [
    "What a tie buys: keep the wall as B below the curve, then add the tie.",
    "Che cosa dà una catena: sotto il grafico fissare la parete come B, poi aggiungerla.",
  ],
  unpin: ["Remove B", "Togli B"],
  back: ["Return to B", "Torna a B"],
  better: [
    "θ of A is {x} of B (95 %: {a}–{b}), same records",
    "θ di A è {x} di B (95 %: {a}–{b}), stessi accelerogrammi",
  ],
  better_if: [
    "If the anchors of the ties hold, which is not checked, θ of A is {x} of B (95 %: {a}–{b}), same records",
    "Se tengono gli ancoraggi delle catene, non verificati, θ di A è {x} di B (95 %: {a}–{b}), stessi accelerogrammi",
  ],
  no_building: [
    "Without a building: unconservative for a wall that a floor or a roof holds, or that stands on one.",
    "Senza edificio: a sfavore di sicurezza per una parete trattenuta da un solaio o un tetto, o che vi poggia.",
  ],
  anchors: [
    "The anchors of {n} are not checked, and the curve takes them to hold: give their plates or the force at " +
      "which they give way.",
    "Ancoraggi di {n} non verificati: la curva li suppone resistenti. Assegnare i capochiave o la resistenza " +
      "dell’ancoraggio.",
  ],
  fan: ["{what} {low} and {high}: θ {x} to {y} g", "{what} {low} e {high}: θ da {x} a {y} g"],
  fan_button: ["Uncertainty of {what}", "Incertezza di {what}"],
  draft: ["draft: half of the records", "bozza: metà degli accelerogrammi"],
  histories: ["{n} histories in {ms} ms", "{n} analisi in {ms} ms"],
  refused: ["This wall has no curve.", "Questa parete non ha curva."],
  no_answer: [
    "The server does not answer: is dondolo serve still running?",
    "Il server non risponde: dondolo serve è ancora attivo?",
  ],
  motion: ["The wall", "La parete"],
  record: ["Record", "Accelerogramma"],
  pga: ["PGA", "PGA"],
  play: ["Play", "Avvia"],
  stop: ["Stop", "Ferma"],
  falls: ["falls", "crolla"],
  stands: ["stands, up to {x} of its capacity", "resta in piedi, fino a {x} della capacità"],
  no_shape: ["A wall that is given by a table has no shape.", "Una parete data da una tabella non ha forma."],
  rotation: ["rotation / capacity", "rotazione / capacità"],
  case_file: ["Case file", "File del caso"],
  making: ["being made…", "in preparazione…"],
  synthetic: [
    "Synthetic accelerograms: a study needs recorded ones, dondolo serve --records CATALOGUE.",
    "Accelerogrammi sintetici: per uno studio servono registrazioni, dondolo serve --records CATALOGO.",
  ],
  records: ["{n} accelerograms of {name}", "{n} accelerogrammi di {name}"],
  local: ["this computer only", "solo su questo computer"],
  opened_records: [
    "Opened. The records are those of the page, {name}.",
    "Aperto. Gli accelerogrammi sono quelli della pagina, {name}.",
  ],
  said: ["Median {x} {unit}", "Mediana {x} {unit}"],
  no_curve: ["No curve", "Nessuna curva"],
  wall_alt: [
    "The wall at rest and at half of its capacity, to scale",
    "La parete a riposo e a metà della capacità, in scala",
  ],
  tie_n: ["tie {n}", "catena {n}"],
  transverse: ["transverse wall", "muro trasversale"],
  in_case: ["in the case: {name} = {value}", "nel caso: {name} = {value}"],
  free_modulus: ["Free element, E by masonry", "Elemento libero, E per muratura"],
  no_modulus: ["not given", "non assegnato"],
  own_modulus: ["as in the case", "come nel caso"],
  irregular_stone: ["Irregular stone, pebbles", "Pietrame disordinato, ciottoli"],
  rough_stone: ["Roughly cut stone", "Conci sbozzati"],
  split_stone: ["Split stone, well laid", "Pietre a spacco"],
  irregular_soft: ["Irregular soft stone", "Pietra tenera irregolare"],
  regular_soft: ["Regular soft stone", "Conci regolari di pietra tenera"],
  squared_stone: ["Squared stone blocks", "Blocchi lapidei squadrati"],
  solid_bricks: ["Solid bricks, lime mortar", "Mattoni pieni e calce"],
  perforated_bricks: ["Perforated bricks, cement mortar", "Semipieni e cemento"],
  file_case: ["case", "caso"],
  file_report: ["report", "rapporto"],
  file_relazione: ["calculation_report", "relazione"],
  year: ["year", "anni"],
};
// Names of the properties of a case
const LABELS = {
  title: ["Title", "Titolo"],
  threads: ["Threads", "Thread"],
  spreadsheet_safe: ["Safe for spreadsheets", "Sicuro per fogli di calcolo"],
  histories: ["Table of histories", "Tabella delle analisi"],
  task: ["Task", "Analisi"],
  output: ["Results", "Risultati"],
  name: ["Name", "Nome"],
  mechanism: ["Mechanism", "Meccanismo"],
  height: ["Height", "Altezza"],
  thickness: ["Thickness", "Spessore"],
  density: ["Density", "Densità"],
  section_height: ["Height", "Altezza"],
  section_thickness: ["Thickness", "Spessore"],
  section_fill: ["Share of masonry", "Quota di muratura"],
  section_offset: ["Set back by", "Arretramento"],
  section_base_width: ["Width at the bottom", "Larghezza alla base"],
  section_top_width: ["Width at the top", "Larghezza in sommità"],
  leaves: ["Leaves", "Paramenti"],
  hinge_level: ["Levels of hinges", "Quote delle cerniere"],
  hinge_at: ["Hinges at", "Cerniere a"],
  mass: ["Mass", "Massa"],
  centroid_depth: ["Centroid, depth", "Baricentro, dal filo esterno"],
  centroid_height: ["Centroid, height", "Baricentro, quota"],
  hinge_inertia: ["Inertia about the hinge", "Inerzia sulla cerniera"],
  hinge_depth: ["Depth of the hinge", "Arretramento della cerniera"],
  compressive_strength: ["Compressive strength", "Resistenza a compressione"],
  stress_block: ["Stress block", "Tensione sulla base"],
  young_modulus: ["Young’s modulus", "Modulo elastico"],
  free: ["Free element", "Elemento libero"],
  edge_radius: ["Radius of the edge", "Raggio dello spigolo"],
  load: ["Load", "Carico"],
  load_depth: ["… behind the outer face", "… dal filo esterno"],
  load_height: ["… height", "… quota"],
  load_inertia: ["Mass of the loads", "Massa dei carichi"],
  load_lifted: ["… share lifted", "… quota sollevata"],
  load_pushed: ["… share pushed", "… quota spinta"],
  load_seat: ["… loses its seat after", "… perde l’appoggio dopo"],
  inertia_mass: ["Masses pushed", "Masse spinte"],
  inertia_depth: ["… behind the outer face", "… dal filo esterno"],
  inertia_height: ["… height", "… quota"],
  inertia_x: ["… x", "… x"],
  thrust: ["Thrust", "Spinta"],
  thrust_depth: ["… behind the outer face", "… dal filo esterno"],
  thrust_height: ["… height", "… quota"],
  thrust_decay: ["… decays over", "… decade in"],
  load_total: ["Load in all", "Carico intero"],
  load_x: ["… x", "… x"],
  thrust_total: ["Thrust in all", "Spinta intera"],
  thrust_x: ["… x", "… x"],
  spring: ["Springs", "Molle"],
  spring_depth: ["Springs, depth", "Molle, dal filo esterno"],
  spring_height: ["Springs, height", "Molle, quota"],
  distributed_spring: ["Distributed springs", "Molle distribuite"],
  distributed_spring_depth: ["Distributed springs, depth", "Molle distribuite, dal filo esterno"],
  distributed_spring_bottom: ["Distributed springs, from height", "Molle distribuite, dalla quota"],
  distributed_spring_top: ["Distributed springs, to height", "Molle distribuite, alla quota"],
  tie_height: ["Height", "Quota"],
  tie_depth: ["… behind the outer face", "… dal filo esterno"],
  tie_area: ["Section per metre", "Sezione al metro"],
  tie_bar: ["Bar diameter", "Diametro"],
  tie_spacing: ["Spacing", "Interasse"],
  tie_length: ["Free length", "Lunghezza libera"],
  tie_modulus: ["Modulus", "Modulo elastico"],
  tie_strength: ["Yield stress", "Snervamento"],
  tie_preload: ["Preload", "Pretensione"],
  tie_strain: ["Strain at break", "Deformazione ultima"],
  tie_anchor_force: ["Anchor force", "Resistenza dell’ancoraggio"],
  tie_anchor_total: ["Anchor force in all", "Resistenza intera dell’ancoraggio"],
  tie_plate_width: ["Plate width", "Larghezza del capochiave"],
  tie_plate_height: ["Plate height", "Altezza del capochiave"],
  tie_plate_diameter: ["Plate diameter", "Diametro del capochiave"],
  tie_plate_thickness: ["Plate thickness", "Spessore del capochiave"],
  tie_leaf: ["Masonry under the plate", "Muratura sotto il capochiave"],
  tie_compression: ["Stress at the plate", "Tensione al capochiave"],
  masonry_compression: ["Masonry, compression", "Muratura, compressione"],
  masonry_shear: ["Masonry, shear", "Muratura, taglio"],
  masonry_tension: ["Masonry, tension", "Muratura, trazione"],
  masonry_friction: ["Masonry, friction", "Muratura, attrito"],
  masonry_knowledge_factor: ["Masonry, FC", "Muratura, FC"],
  bearing_factor: ["Factor under a plate", "Fattore sotto il capochiave"],
  interlock_overlap: ["Interlocking, overlap", "Ammorsamento, sovrapposizione"],
  interlock_course: ["Interlocking, course", "Ammorsamento, corso"],
  interlock_thickness: ["Transverse walls, thickness", "Muri trasversali, spessore"],
  interlock_spacing: ["Transverse walls, spacing", "Muri trasversali, interasse"],
  interlock_friction: ["Interlocking, friction", "Ammorsamento, attrito"],
  facade_length: ["Length of the facade", "Lunghezza della facciata"],
  wedge_thickness: ["Wedges, thickness", "Cunei, spessore"],
  wedge_angle: ["Wedges, angle", "Cunei, angolo"],
  wedge_bottom: ["Wedges, from height", "Cunei, dalla quota"],
  wedge_top: ["Wedges, to height", "Cunei, alla quota"],
  wedge_length: ["Wedges, greatest length", "Cunei, lunghezza massima"],
  elevation_x: ["Elevation, x", "Prospetto, x"],
  elevation_z: ["Elevation, height", "Prospetto, quota"],
  opening_x: ["Openings, x", "Aperture, x"],
  opening_z: ["Openings, height above the base", "Aperture, quota"],
  opening_width: ["Openings, width", "Aperture, larghezza"],
  opening_height: ["Openings, height", "Aperture, altezza"],
  axis_x: ["Axis, x of two points", "Asse, x di due punti"],
  axis_z: ["Axis, height of these points", "Asse, quota di questi punti"],
  half_gable: ["Half of a gable", "Mezzo timpano"],
  wing_angle: ["Wings, angle", "Ali, angolo"],
  wing_length: ["Wings, greatest length", "Ali, lunghezza massima"],
  hinge: ["Hinge, of the height", "Cerniera, quota relativa"],
  hinge_range: ["Hinges, from and to", "Cerniere, da e a"],
  elastic_period: ["Elastic period", "Periodo elastico"],
  elastic_damping: ["Elastic damping", "Smorzamento elastico"],
  restitution: ["Restitution", "Restituzione"],
  restitution_value: ["Restitution e", "Restituzione e"],
  restitution_factor: ["Factor on restitution", "Fattore sulla restituzione"],
  base_level: ["Level of the base", "Quota della base"],
  restitution_sd: ["Scatter of restitution", "Dispersione della restituzione"],
  restitution_seed: ["Seed of the scatter", "Seme della dispersione"],
  overburden: ["Load on top", "Carico in sommità"],
  overburden_inertia: ["… share that is lifted", "… quota sollevata"],
  eccentricity: ["… off the centreline", "… eccentricità"],
  bearing: ["… bears at", "… appoggia su"],
  bearing_distance: ["… distance from the face", "… distanza dalla faccia"],
  table: ["Table", "Tabella"],
  rotation: ["Rotations", "Rotazioni"],
  inertia: ["Inertia J", "Inerzia J"],
  lever: ["Lever L", "Braccio L"],
  moment: ["Moment G − Q", "Momento G − Q"],
  vertical_lever: ["Lever S", "Braccio S"],
  travel: ["Displacement d", "Spostamento d"],
  weighted_lever: ["Weights times levers", "Pesi per bracci"],
  weight: ["Weights", "Pesi"],
  displacement: ["Displacements of the weights", "Spostamenti dei pesi"],
  sides: ["Sides", "Lati"],
  top_share: ["Share of the top", "Quota della sommità"],
  top_tilt: ["Tilt of the top", "Inclinazione della sommità"],
  bodies: ["File of the bodies", "File dei corpi"],
  joints: ["File of the joints", "File dei vincoli"],
  actions: ["File of the actions", "File delle azioni"],
  ties: ["File of ties", "File delle catene"],
  driver: ["Driving body", "Corpo che guida"],
  gravity_share: ["Part of gravity", "Parte della gravità"],
  body_table: ["Bodies", "Corpi"],
  joint_table: ["Joints", "Vincoli"],
  action_table: ["Actions", "Azioni"],
  tie_table: ["Ties", "Catene"],
  period: ["Period", "Periodo"],
  damping: ["Damping", "Smorzamento"],
  participation: ["Participation", "Partecipazione"],
  storeys: ["Storeys", "Piani"],
  level: ["Level of the base", "Quota della base"],
  level_top: ["Level of the top", "Quota della sommità"],
  building_height: ["Height of the building", "Altezza dell’edificio"],
  top_displacement: ["Displacement of the top", "Spostamento della sommità"],
  participation_top: ["Participation at the top", "Partecipazione in sommità"],
  diaphragm_period: ["Floor above, period", "Solaio in sommità, periodo"],
  diaphragm_damping: ["Floor above, damping", "Solaio in sommità, smorzamento"],
  diaphragm_participation: ["Floor above, participation", "Solaio in sommità, partecipazione"],
  refine: ["Parts of a step", "Parti di un passo"],
  catalogue: ["Catalogue", "Catalogo"],
  polarity: ["Direction", "Verso"],
  vertical: ["Vertical motion", "Moto verticale"],
  vertical_factor: ["Vertical factor", "Fattore verticale"],
  im: ["Intensity measure", "Misura d’intensità"],
  levels: ["Levels", "Livelli"],
  first: ["First level", "Primo livello"],
  last: ["Last level", "Ultimo livello"],
  count: ["Number of levels", "Numero di livelli"],
  edp_thresholds: ["Damage states", "Stati di danno"],
  states: ["Their curves", "Loro curve"],
  engine: ["Engine", "Solutore"],
  rtol: ["Relative error", "Errore relativo"],
  atol: ["Absolute error", "Errore assoluto"],
  edp_limit: ["Collapse at rotation / capacity", "Collasso a rotazione / capacità"],
  estimate_error: ["Estimate errors", "Stima degli errori"],
  certify: ["Certify", "Certificazione"],
  gravity: ["Gravity", "Gravità"],
  code: ["Code", "Norma"],
  ag: ["a_g", "a_g"],
  f0: ["F₀", "F₀"],
  tc_star: ["T*c", "T*c"],
  soil: ["Soil", "Suolo"],
  topography: ["Topography", "Topografia"],
  knowledge_factor: ["Confidence factor FC", "Fattore di confidenza FC"],
  behaviour: ["Behaviour factor q", "Fattore di comportamento q"],
  reference_life: ["Reference period V_R", "Periodo di riferimento V_R"],
  exceedance: ["Probabilities P_VR", "Probabilità P_VR"],
  latitude: ["Latitude (WGS84)", "Latitudine (WGS84)"],
  longitude: ["Longitude (WGS84)", "Longitudine (WGS84)"],
  nominal_life: ["Nominal life V_N", "Vita nominale V_N"],
  use_class: ["Class of use", "Classe d’uso"],
  ultimate_state: ["Ultimate state", "Stato limite ultimo"],
  friction: ["Friction at the hinges", "Attrito alle cerniere"],
  building_period: ["Building, T₁ by limit state", "Edificio, T₁ per stato limite"],
  building_damping: ["Building, damping by limit state", "Edificio, smorzamento per stato limite"],
};
let place = 0;

export const language = () => (place ? "it" : "en");
export const speak = (lang) => {
  place = lang === "it" ? 1 : 0;
  document.documentElement.lang = lang;
};
export const has = (key) => key in WORDS;
// Short name of a property; one that has none is called as in the case.
export const labelOf = (name) => LABELS[name]?.[place] ?? name;
// A word that a property may be, as the page says it; names that the case has are left.
export const choiceOf = (name, word) => WORDS[`${name}.${word}`]?.[place] ?? word;
export const t = (key, values = {}) => WORDS[key][place].replace(/\{(\w+)\}/g, (_, name) => values[name]);

// A number with the decimal mark of the language
export const num = (x, digits) => {
  const text = digits === undefined ? String(Number(x.toPrecision(12))) : x.toFixed(digits);
  return (place ? text.replace(".", ",") : text).replace("-", "−");
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
