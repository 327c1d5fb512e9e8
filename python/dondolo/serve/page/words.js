// Words of the page, English and Italian, and numbers as the language writes them.
const WORDS = {
  open: ["Open case…", "Apri caso…"], save: ["Case (.nml)", "Caso (.nml)"], report: ["Report", "Rapporto"],
  relazione: ["Calculation report", "Relazione di calcolo"], figure: ["Figure (SVG)", "Figura (SVG)"], other_language: ["Italiano", "English"],
  title: ["Title of the case", "Titolo del caso"], untitled: ["Untitled wall", "Parete senza titolo"],
  mechanism: ["Mechanism", "Meccanismo"], one_sided: ["overturns outwards", "ribaltamento semplice"], free_standing: ["free on both sides", "libera sui due lati"],
  two_block: ["bends between floors", "flessione verticale"], tabulated: ["given by a table", "data da una tabella"],
  wall: ["Wall", "Parete"], sections: ["Storeys", "Piani"], loads: ["Loads", "Carichi"], thrusts: ["Thrusts", "Spinte"], ties: ["Ties", "Catene"], building: ["Building", "Edificio"],
  site: ["Site, NTC 2018", "Sito, NTC 2018"], analysis: ["Records and levels", "Accelerogrammi e livelli"], others: ["Other properties", "Altre proprietà"],
  section: ["Storey {n}", "Piano {n}"], load: ["Load {n}", "Carico {n}"], thrust: ["Thrust {n}", "Spinta {n}"], tie: ["Tie {n}", "Catena {n}"],
  add_sections: ["split into storeys", "dividi in piani"], more_sections: ["+ storey", "+ piano"], add_loads: ["+ load", "+ carico"], add_thrusts: ["+ thrust", "+ spinta"], add_ties: ["+ tie", "+ catena"],
  add_plates: ["+ plates", "+ capochiave"], add_building: ["put it on a building", "colloca su un edificio"], add_site: ["check by NTC 2018", "verifica NTC 2018"], remove: ["remove", "togli"],
  add_property: ["Add a property…", "Aggiungi una proprietà…"], building_hint: ["Only a wall on the ground with nothing behind it needs none: without a building, one that leans on a floor or roof is unconservative.", "Non serve solo per una parete a terra senza nulla alle spalle: senza edificio, una parete appoggiata a un solaio o a un tetto è a sfavore di sicurezza."],
  auto: ["Levels chosen for the wall", "Livelli scelti per la parete"], levels: ["Levels", "Livelli"], polarity: ["Direction", "Verso"], im: ["Intensity measure", "Misura d’intensità"],
  both: ["both ways", "nei due versi"], as_recorded: ["as recorded", "come registrato"], reversed: ["reversed", "invertito"],
  all: ["moved and lifted", "spinta e sollevata"], load_inertia: ["Mass of the loads", "Massa dei carichi"], none: ["stays with the building", "resta all’edificio"], vertical: ["is lifted", "è sollevata"],
  theta: ["Median θ", "Mediana θ"], beta: ["Dispersion β", "Dispersione β"], trigger: ["Starts to rock", "Innesco"], at_site: ["P at the site", "P al sito"], level_site: ["a_g S = {x} g", "a_g S = {x} g"], greatest: ["with ties up to {x} g", "con catene fino a {x} g"],
  interval: ["95 %: {a}–{b}", "95 %: {a}–{b}"], collapse: ["Probability of collapse", "Probabilità di crollo"], curve_title: ["Probability of collapse against {im}", "Probabilità di crollo in funzione di {im}"],
  linear: ["linear", "lineare"], nonlinear: ["nonlinear", "non lineare"], capacity: ["{method} {state} {x}", "{method} {state} {x}"],
  check_title: ["NTC 2018, local mechanism", "NTC 2018, meccanismo locale"], method: ["Check", "Verifica"], capacity_head: ["Capacity a_g S [g]", "Capacità a_g S [g]"], demand_head: ["Demand [g]", "Domanda [g]"], outcome: ["Outcome", "Esito"],
  verified: ["satisfied", "soddisfatta"], with_anchors: ["satisfied, if the anchors of its ties are", "soddisfatta, se lo sono gli ancoraggi delle catene"], not_verified: ["not satisfied", "non soddisfatta"], not_applicable: ["not applicable", "non applicabile"],
  check_why: ["A check can fail although collapse is improbable: its capacity is a share of the wall’s, by the code’s factors.", "Una verifica può non essere soddisfatta anche se il crollo è improbabile: la sua capacità è una quota di quella della parete, per i coefficienti della norma."],
  pin: ["Keep as B", "Fissa come B"], unpin: ["Remove B", "Togli B"], back: ["Return to B", "Torna a B"], was: ["B", "B"],
  better: ["θ of A is {x} of B (95 %: {a}–{b}), same records", "θ di A è {x} di B (95 %: {a}–{b}), stessi accelerogrammi"], fan: ["{what} {low} and {high}: θ {x} to {y} g", "{what} {low} e {high}: θ da {x} a {y} g"], fan_button: ["Uncertainty of {what}", "Incertezza di {what}"],
  draft: ["draft: half of the records", "bozza: metà degli accelerogrammi"], histories: ["{n} histories in {ms} ms", "{n} analisi in {ms} ms"],
  refused: ["This wall has no curve.", "Questa parete non ha curva."], no_answer: ["The server does not answer: is dondolo serve still running?", "Il server non risponde: dondolo serve è ancora attivo?"],
  motion: ["The wall", "La parete"], record: ["Record", "Accelerogramma"], pga: ["PGA", "PGA"], play: ["Play", "Avvia"], stop: ["Stop", "Ferma"], falls: ["falls", "crolla"], stands: ["stands, up to {x} of its capacity", "resta in piedi, fino a {x} della capacità"], no_shape: ["A wall that is given by a table has no shape.", "Una parete data da una tabella non ha forma."],
  rotation: ["rotation / capacity", "rotazione / capacità"], case_file: ["Case file", "File del caso"], making: ["being made…", "in preparazione…"],
  synthetic: ["Synthetic accelerograms: for a study use recorded ones, dondolo serve --records CATALOGUE.", "Accelerogrammi sintetici: per uno studio usarne di registrati, dondolo serve --records CATALOGO."], records: ["{n} accelerograms of {name}", "{n} accelerogrammi di {name}"], local: ["this computer only", "solo su questo computer"],
  opened_records: ["Opened. The records are those of the page, {name}.", "Aperto. Gli accelerogrammi sono quelli della pagina, {name}."], said: ["Median {x} {unit}", "Mediana {x} {unit}"], no_curve: ["No curve", "Nessuna curva"],
  wall_alt: ["The wall at rest and at half of its capacity, to scale", "La parete a riposo e a metà della capacità, in scala"], per_m: ["per metre of wall", "al metro di parete"],
  // Properties
  name: ["Name", "Nome"], height: ["Height", "Altezza"], thickness: ["Thickness", "Spessore"], density: ["Density", "Densità"], hinge: ["Hinge, of the height", "Cerniera, quota relativa"], overburden: ["Load on top", "Carico in sommità"], overburden_inertia: ["… share that is lifted", "… quota sollevata"], eccentricity: ["… off the centreline", "… eccentricità"],
  compressive_strength: ["Compressive strength", "Resistenza a compressione"], hinge_depth: ["Depth of the hinge", "Arretramento della cerniera"], restitution_factor: ["Factor on restitution", "Fattore sulla restituzione"], restitution_value: ["Restitution e", "Restituzione e"],
  section_height: ["Height", "Altezza"], section_thickness: ["Thickness", "Spessore"], load_height: ["… height", "… quota"], load_depth: ["… behind the outer face", "… dal filo esterno"], load_value: ["Load", "Carico"], thrust_value: ["Thrust", "Spinta"], thrust_height: ["… height", "… quota"], thrust_depth: ["… behind the outer face", "… dal filo esterno"],
  tie_height: ["Height", "Quota"], tie_bar: ["Bar diameter", "Diametro"], tie_spacing: ["Spacing", "Interasse"], tie_length: ["Free length", "Lunghezza libera"], tie_strength: ["Yield stress", "Snervamento"], tie_area: ["Section per metre", "Sezione al metro"], tie_strain: ["Strain at break", "Deformazione ultima"], tie_preload: ["Preload", "Pretensione"], tie_depth: ["… behind the outer face", "… dal filo esterno"], tie_modulus: ["Modulus", "Modulo elastico"],
  tie_plate_width: ["Plate width", "Larghezza della piastra"], tie_plate_height: ["Plate height", "Altezza della piastra"], tie_plate_thickness: ["Plate thickness", "Spessore della piastra"], tie_plate_diameter: ["Plate diameter", "Diametro della piastra"], tie_anchor_force: ["Anchor force", "Resistenza dell’ancoraggio"],
  masonry_compression: ["Masonry, compression", "Muratura, compressione"], masonry_shear: ["Masonry, shear", "Muratura, taglio"], masonry_tension: ["Masonry, tension", "Muratura, trazione"],
  period: ["Period", "Periodo"], damping: ["Damping", "Smorzamento"], storeys: ["Storeys", "Piani"], level: ["Level of the base", "Quota della base"], level_top: ["Level of the top", "Quota della sommità"], building_height: ["Height of the building", "Altezza dell’edificio"],
  ag: ["a_g", "a_g"], f0: ["F₀", "F₀"], tc_star: ["T*c", "T*c"], soil: ["Soil", "Suolo"], topography: ["Topography", "Topografia"], knowledge_factor: ["Confidence factor FC", "Fattore di confidenza FC"], behaviour: ["Behaviour factor q", "Fattore di comportamento q"],
};
let place = 0;

export const language = () => (place ? "it" : "en");
export const speak = (lang) => { place = lang === "it" ? 1 : 0; document.documentElement.lang = lang; };
export const has = (key) => key in WORDS;
export const t = (key, values = {}) => WORDS[key][place].replace(/\{(\w+)\}/g, (_, name) => values[name]);

// A number with the decimal mark of the language
export const num = (x, digits) => {
  const text = digits === undefined ? String(Number(x.toPrecision(6))) : x.toFixed(digits);
  return (place ? text.replace(".", ",") : text).replace("-", "−");
};
export const sig = (x, digits = 3) => {
  if (x === 0) return "0";
  return num(x, Math.max(0, digits - 1 - Math.floor(Math.log10(Math.abs(x)))));
};
export const probability = (p) => (p < 0.0005 ? "< " + num(0.0005, 4) : p > 0.9995 ? "> " + num(0.9995, 4) : num(p, 3));
export const read = (text) => {
  const plain = text.trim().replace("−", "-").replace(",", ".");
  return /^[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?$/i.test(plain) ? Number(plain) : NaN;
};

// Elements: make("button", {class: "small", onclick: f}, "text", child ...)
export const make = (tag, attributes = {}, ...children) => {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === undefined || value === null || value === false) continue;
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else element.setAttribute(name, value === true ? "" : value);
  }
  element.append(...children.filter((child) => child !== null && child !== undefined && child !== false));
  return element;
};
export const safe = (text) => String(text).replace(/[&<>"']/g, (c) => `&#${c.charCodeAt(0)};`);
