// What is wrong with a case, in words: the library's sentence, or in Italian the meaning of its code with the value and
// its bounds.
// What has no code keeps the library's sentence, which is better than none.
import { fieldOf, heightOf, inWords, thicknessOf } from "./form.js";
import { state } from "./state.js";
import { choiceOf, labelOf, language, num, t } from "./words.js";

// What each code means; {allowed} is what the table of properties allows
const CODES = {
  unknown_name: "nome sconosciuto",
  not_given: "va assegnato insieme agli altri dati",
  not_together: "non ammesso insieme agli altri dati",
  wrong_type: "valore di un tipo non ammesso",
  wrong_length: "numero di valori sbagliato",
  out_of_range: "valore non ammesso con gli altri dati",
  not_increasing: "i valori devono crescere",
  not_a_number: "deve essere un numero, con il punto decimale e senza unità",
  not_numbers: "devono essere numeri",
  not_an_integer: "deve essere un numero intero",
  not_a_flag: "deve essere .true. o .false.",
  not_a_string: "testo non ammesso",
  not_a_word: "parola non ammessa",
  not_a_probability: "deve stare tra 0 e 1",
  no_such_file: "file inesistente",
  not_at_rest: "senza terremoto la parete cade, o è trattenuta per sempre",
};
// The same of a variable, where more can be said; {h} and {t} are height and thickness of the wall [m]
const OWN = {
  "not_at_rest.thrust": "la parete non sta in piedi a riposo: le spinte superano quanto i pesi trattengono",
  "not_at_rest.overburden": "la parete non sta in piedi a riposo: il carico in sommità la piega",
  "not_at_rest.moment":
    "il momento deve essere positivo alla rotazione 0, altrimenti la parete non sta in piedi a riposo",
  "not_at_rest.spring": "le molle trattengono la parete a ogni rotazione: non c’è capacità",
  "not_at_rest.thrust_decay":
    "oltre la rotazione a cui cade la parete è di nuovo trattenuta: due posizioni di equilibrio non sono previste",
  "out_of_range.task": "la pagina mostra una sola parete, task = 'stripes': eseguire questo caso con dondolo",
  "out_of_range.mechanism":
    "la pagina mostra pareti di uno o due blocchi: eseguire le catene di corpi rigidi con dondolo",
  "not_given.weight": "per la verifica cinematica la tabella richiede weight, displacement e travel",
  "out_of_range.tie_height":
    "deve stare sopra la cerniera e non oltre la sommità, {h} m, e almeno mezzo capochiave all’interno",
  "out_of_range.tie_depth": "deve stare tra le facce della parete, da 0 a {t} m, o fino a 10 cm all’esterno",
  "out_of_range.tie_preload": "deve essere minore dello snervamento, e di quanto regge l’ancoraggio",
  "out_of_range.tie_strain": "deve superare la deformazione di snervamento",
  "out_of_range.tie_bar": "deve essere minore del capochiave",
  "out_of_range.tie_spacing": "deve superare la larghezza del capochiave",
  "out_of_range.tie_leaf": "deve essere al più lo spessore della parete",
  "out_of_range.level": "deve essere al più l’altezza dell’edificio",
  "out_of_range.level_top": "deve stare tra la quota della base e l’altezza dell’edificio",
  "out_of_range.eccentricity": "deve stare entro la metà dello spessore, {t} m, da ogni parte",
  "out_of_range.bearing_distance": "deve stare tra 0 e lo spessore, {t} m",
  "out_of_range.hinge_depth": "la cerniera deve restare davanti al baricentro della parete e ai carichi",
  "out_of_range.compressive_strength":
    "troppo bassa: la cerniera deve restare davanti al baricentro della parete e ai carichi",
  "out_of_range.elastic_period":
    "troppo lungo per questa parete: i giunti si aprirebbero oltre un quarto della capacità, o si richiuderebbero",
  "out_of_range.edge_radius": "deve essere minore della quota del baricentro",
  "out_of_range.hinge_inertia": "deve essere almeno quella della massa nel suo baricentro",
  "out_of_range.levels": "i livelli devono essere positivi, e nessuno deve portare un accelerogramma oltre ogni misura",
  "out_of_range.period": "il moto del piano avrebbe troppi campioni",
  "out_of_range.load_depth": "deve stare tra le facce della parete, dietro la cerniera e fino a {t} m",
  "out_of_range.section_offset": "il baricentro della parete deve restare dietro la cerniera",
  "not_given.check": "manca il sito: la relazione è delle verifiche NTC 2018 della parete (Sito, NTC 2018)",
  "not_given.load_inertia": "va assegnato con i carichi: none, vertical o both",
  "not_given.tie_area": "va assegnata la sezione al metro, o diametro e interasse",
  "not_given.overburden_inertia": "va assegnata con il carico in sommità, da 0 (forza) a 1 (massa sollevata)",
  "not_given.participation": "va assegnata, oppure piani, quota della base e altezza dell’edificio",
  "not_given.levels": "i livelli vanno assegnati",
  "not_together.vertical":
    "il catalogo degli accelerogrammi non ha componenti verticali (colonna vertical), o il caso non le prende",
  "not_together.restitution": "non vale per questo meccanismo con una massa in sommità: usare impulse",
  "wrong_length.hinge_level": "una parete ha una sola cerniera; una facciata con più cerniere è una popolazione",
  "out_of_range.latitude":
    "il punto è fuori dal reticolo di pericolosità (D.M. 14-1-2008, allegato B, tabella 1), che ha la terraferma " +
    "e la Sicilia senza Sardegna, isole toscane, ponziane, Tremiti, Eolie, Egadi, Ustica, Pantelleria, Lampedusa " +
    "e Linosa: assegnare ag, f0 e tc_star",
  "not_given.nominal_life": "va assegnata con latitudine e longitudine",
  "not_together.nominal_life": "vale solo con latitudine e longitudine; assegnare reference_life",
};
// Heights and depths must lie within the wall.
/** @type {[RegExp, string][]} */
const WITHIN = [
  [/_(height|bottom|top)$/, "deve stare tra 0 e l’altezza della parete, {h} m"],
  [/_depth$/, "deve stare tra le facce della parete, da 0 a {t} m"],
];
const HUGE = 1e300;

// What a number may be by the table of properties, as the field shows numbers; empty where it keeps to that
function bounds({ low, high, bounds: kind }, value, shown) {
  const isLow = value < low || (kind === "positive" && value <= 0),
    isHigh = value > high || (kind === "less" && value >= high);
  if (!isLow && !isHigh) return "";
  if (kind === "positive" && high > HUGE) return "deve essere positivo";
  const from = kind === "positive" ? "maggiore di 0" : low > -HUGE ? `almeno ${shown(low)}` : "",
    to = high < HUGE ? `${kind === "less" ? "minore di" : "al più"} ${shown(high)}` : "";
  return `deve essere ${[from, to].filter(Boolean).join(" e ")}`;
}
function words({ code, variable, group, line, message }, isFile) {
  const where = isFile && line ? ` (riga ${line})` : "";
  if (!CODES[code])
    return (
      (group ? `Il gruppo &${group} del caso non è ammesso` : "Richiesta non riuscita") +
      `${where}: ${message.replace(/^case\.nml: /, "")}`
    );
  if (!variable) return `${CODES[code]}${where}`;
  // Of a group as a whole
  if (variable in state.properties) return `&${variable}: ${OWN[`${code}.${variable}`] ?? CODES[code]}${where}`;
  const property =
    state.properties[group]?.[variable] ??
    Object.values(state.properties)
      .map((table) => table[variable])
      .find(Boolean);
  const field = fieldOf(variable),
    values = [].concat(state.settings[group]?.[variable] ?? []),
    factor = field?.[3] ?? 1,
    unit = field ? field[4] : inWords(property?.unit ?? "");
  const shown = (x) => num(x * factor) + (unit ? ` ${unit}` : "");
  const value = values.length
    ? ` = ${values.map((x) => (typeof x === "number" ? shown(x) : choiceOf(variable, x))).join("; ")}`
    : "";
  const own =
    OWN[`${code}.${variable}`] ?? (code === "out_of_range" && WITHIN.find(([name]) => name.test(variable))?.[1]);
  const allowed =
    code === "out_of_range" && property
      ? values
          .filter((x) => typeof x === "number")
          .map((x) => bounds(property, x, shown))
          .find(Boolean)
      : code === "not_a_word" && property?.choices.length
        ? `deve essere una tra ${property.choices.join(", ")}`
        : "";
  const size = (name) => num(name === "h" ? heightOf() : thicknessOf());
  const sentence = (allowed || own || CODES[code]).replace(/\{(\w)\}/g, (_, name) => size(name));
  return `${labelOf(variable)} (${variable})${value}: ${sentence}${where}`;
}

// The sentence of a refusal: what the server answered, or that it did not; lines are those of a file that was opened.
export function sentenceOf(answer, isFile = false) {
  if (!answer?.error) return t("no_answer");
  if (language() === "en") return answer.error.replace(/^case\.nml: /, "");
  return answer.errors?.length
    ? answer.errors.map((one) => words(one, isFile)).join(". ")
    : `Richiesta non riuscita: ${answer.error}`;
}

// The same of another state than that of the sliders
export function sentenceFor(settings, answer) {
  const own = state.settings;
  state.settings = settings;
  try {
    return sentenceOf(answer);
  } finally {
    state.settings = own;
  }
}
