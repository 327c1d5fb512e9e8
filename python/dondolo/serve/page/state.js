// The case on the page and what is asked for it. The groups of the case are all there is: the server answers for them
// alone.
import { language } from "./words.js";

/** @typedef {{ group: string, name: string, place: number | null, share: number }} Fan A property that is varied */
/**
 * Groups of the case and of one that it is compared with, the server's answers to them, and its table of properties
 * @type {{
 *   settings: Record<string, any>, auto: boolean, answer: any, isNewest: boolean, version: number,
 *   b: Record<string, any> | null, bAuto: boolean, bAnswer: any, fan: Fan | null,
 *   properties: Record<string, Record<string, any>>, record: number, pga: number,
 * }}
 */
export const state = {
  settings: {},
  auto: true,
  answer: null,
  isNewest: false,
  version: 0,
  b: null,
  bAuto: true,
  bAnswer: null,
  fan: null,
  properties: {},
  record: 0,
  pga: 0.5,
};

// Last answers took so long that a drag is drawn with half of the records [ms]
const SLOW = 60;
// Pause after which a drag is over [ms]
const PAUSE = 180;
// A question that has taken so long is given up for a newer one; a draft is waited for, so that curves are seen while
// dragging [ms]
const LATE = 300;
/** @type {{ draft: boolean, since: number, given: AbortController } | null} */
let flying = null;
/** @type {(what: "waiting" | "answer" | "refused", error?: any) => void} */
let told = () => {};
/** @type {ReturnType<typeof setTimeout> | undefined} */
let later;
let waits = false,
  dragging = false,
  slow = 0;

export const whenTold = (f) => {
  told = f;
};

/**
 * The answer of the server
 * @param {string} path
 * @param {object} body
 * @param {AbortSignal} [signal]
 * @returns {Promise<any>}
 */
export async function post(path, body, signal) {
  const response = await fetch(path, {
    method: "POST",
    headers: { "content-type": "application/json" },
    body: JSON.stringify(body),
    signal,
  });
  if (path === "document" && response.ok) return response.blob();
  const answer = await response.json().catch(() => ({ error: String(response.status) }));
  if (!response.ok) throw Object.assign(new Error(answer.error), { answer });
  return answer;
}

// Something has changed: ask for the curve of the newest state; one question at a time, the newest one waits.
export function changed(moving = false) {
  state.version += 1;
  state.isNewest = false;
  if (flying && !flying.draft && performance.now() - flying.since > LATE) {
    slow = performance.now() - flying.since;
    flying.given.abort();
  }
  dragging = moving && slow > SLOW;
  clearTimeout(later);
  if (moving)
    later = setTimeout(() => {
      dragging = false;
      if (!flying && (state.answer === null || state.answer.draft)) ask();
    }, PAUSE);
  told("waiting");
  ask();
}

// A slider was let go. Its last step has asked already: only the whole answer may be missing, after a draft.
export function letGo() {
  dragging = false;
  clearTimeout(later);
  if (!flying && (state.answer === null || state.answer.draft)) ask();
}

async function ask() {
  if (flying) {
    waits = true;
    return;
  }
  do {
    waits = false;
    const version = state.version,
      draft = dragging;
    flying = { draft, since: performance.now(), given: new AbortController() };
    /** @type {Record<string, unknown>} */
    const body = { settings: state.settings, auto: state.auto, lang: language(), draft };
    if (state.b && !draft) body.b = state.b;
    if (state.fan && !draft) body.fan = state.fan;
    try {
      const answer = await post("curve", body, flying.given.signal);
      if (!draft) slow = answer.ms;
      state.answer = answer;
      state.isNewest = version === state.version;
      told("answer");
      // The drag was over before its draft was there.
      if (draft && !dragging) waits = true;
    } catch (error) {
      // The refusal of a state that has passed is nothing to read: the answer to the newest one follows.
      if (version !== state.version) continue;
      state.answer = null;
      told("refused", error);
    }
  } while (waits);
  flying = null;
}
