// What is wrong with a case, in words: the library's sentence, or in another language the meaning of its code with the
// value and its bounds.
// What has no code keeps the library's sentence, which is better than none.
import { fieldOf, heightOf, inWords, thicknessOf } from "./form.js";
import { state } from "./state.js";
import { choiceOf, labelOf, language, num, refusal, t } from "./words.js";

// Heights and depths must lie within the wall.
/** @type {[RegExp, string][]} */
const WITHIN = [
  [/_(height|bottom|top)$/, "within height"],
  [/_depth$/, "within depth"],
];
const HUGE = 1e300;

// What a number may be by the table of properties, as the field shows numbers; empty where it keeps to that
function bounds({ low, high, bounds: kind }, value, shown) {
  const isLow = value < low || (kind === "positive" && value <= 0),
    isHigh = value > high || (kind === "less" && value >= high);
  if (!isLow && !isHigh) return "";
  if (kind === "positive" && high > HUGE) return refusal("positive");
  const from = kind === "positive" ? refusal("more than 0") : low > -HUGE ? refusal("at least", { x: shown(low) }) : "",
    to = high < HUGE ? refusal(kind === "less" ? "less than" : "at most", { x: shown(high) }) : "";
  return refusal("must be", { what: [from, to].filter(Boolean).join(refusal("and")) });
}
function words({ code, variable, group, line, message }, isFile) {
  const where = isFile && line ? refusal("line", { line }) : "";
  const meaning = refusal(code);
  if (!meaning) {
    const what = group ? refusal("group", { group }) : refusal("request");
    return `${what}${where}: ${message.replace(/^case\.nml: /, "")}`;
  }
  if (!variable) return `${meaning}${where}`;
  const size = {
    get h() {
      return num(heightOf());
    },
    get t() {
      return num(thicknessOf());
    },
  };
  const said = refusal(`${code}.${variable}`, size);
  // Of a group as a whole
  if (variable in state.properties) return `&${variable}: ${said ?? meaning}${where}`;
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
  const within = code === "out_of_range" && WITHIN.find(([name]) => name.test(variable))?.[1];
  const allowed =
    code === "out_of_range" && property
      ? values
          .filter((x) => typeof x === "number")
          .map((x) => bounds(property, x, shown))
          .find(Boolean)
      : code === "not_a_word" && property?.choices.length
        ? refusal("one of", { choices: property.choices.join(", ") })
        : "";
  const sentence = allowed || said || (within && refusal(within, size)) || meaning;
  return `${labelOf(variable)} (${variable})${value}: ${sentence}${where}`;
}

// The sentence of a refusal: what the server answered, or that it did not; lines are those of a file that was opened.
export function sentenceOf(answer, isFile = false) {
  if (!answer?.error) return t("no_answer");
  if (language() === "en") return answer.error.replace(/^case\.nml: /, "");
  return answer.errors?.length
    ? answer.errors.map((one) => words(one, isFile)).join(". ")
    : `${refusal("request")}: ${answer.error}`;
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
