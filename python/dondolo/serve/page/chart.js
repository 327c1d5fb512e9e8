// The curve with its band and stripes, drawn by hand: what is on the page is the figure that can be downloaded.
import { num, picture, safe, t, tag } from "./words.js";

// The first of some multiples of a power of ten that is not less than x
const above = (x, ...multiples) => {
  const power = 10 ** Math.floor(Math.log10(x));
  return multiples.map((k) => k * power).find((k) => k >= x * 0.9999) ?? NaN;
};
const nice = (x) => above(x, 1, 1.25, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10);
const step = (last, count) => above(last / count, 1, 2, 2.5, 5, 10);
const digits = (x) =>
  Math.max(
    0,
    Math.min(4, Math.ceil(-Math.log10(x) - 1e-9)) +
      (Math.abs((x * 10 ** Math.ceil(-Math.log10(x))) % 1) > 1e-6 ? 1 : 0),
  );

/**
 * SVG of curve A, perhaps with B, fan and marks
 * @param {any} a
 * @param {any} b
 * @param {{ width: number, im: string, marks?: { x: number, label: string, kind: string }[], fan?: any[] }} how
 */
export function chart(a, b, { width, im, marks = [], fan = [] }) {
  // Labels of marks have rows of their own above the curves.
  const left = 60,
    right = 14,
    top = 12 + 15 * marks.length,
    bottom = 44,
    w = Math.max(300, Math.min(900, width)),
    h = Math.round(Math.max(230, Math.min(430, w * 0.56)) + 15 * marks.length);
  const curves = [...(b?.p ? [[b, "b"]] : []), ...(a ? [[a, "a"]] : [])];
  const last = nice(
    Math.max(
      ...curves.map(([c]) => (c.x ? c.x[c.x.length - 1] : c.stripes[0][c.stripes[0].length - 1])),
      ...marks.map(({ x }) => 1.05 * x),
    ),
  );
  const X = (x) => +(left + ((w - left - right) * x) / last).toFixed(2),
    Y = (p) => +(top + (h - top - bottom) * (1 - p)).toFixed(2);
  const path = (x, p) => x.map((one, i) => `${i ? "L" : "M"}${X(Math.min(one, last))} ${Y(p[i])}`).join("");
  const out = [];
  for (let p = 0; p <= 10; p += 2)
    out.push(
      tag("line", { class: p ? "grid" : "axis", x1: left, x2: w - right, y1: Y(p / 10), y2: Y(p / 10) }),
      tag("text", { class: "tick", x: left - 7, y: Y(p / 10) + 4, "text-anchor": "end" }, num(p / 10, 1)),
    );
  const by = step(last, w < 480 ? 4 : 8);
  for (let i = 0; i * by <= last * 1.0001; i++)
    out.push(
      tag("line", { class: "axis", x1: X(i * by), x2: X(i * by), y1: Y(0), y2: Y(0) + 4 }),
      tag("text", { class: "tick", x: X(i * by), y: Y(0) + 18, "text-anchor": "middle" }, num(i * by, digits(by))),
    );
  out.push(`<text class="tick" x="${(left + w - right) / 2}" y="${h - 6}" text-anchor="middle">${safe(im)}</text>`);
  const half = (Y(0) + Y(1)) / 2,
    upright = { class: "tick", transform: `rotate(-90 13 ${half})`, x: 13, y: half + 4, "text-anchor": "middle" };
  out.push(tag("text", upright, safe(t("collapse"))));
  for (const [c, of] of curves)
    if (c.band)
      out.push(
        `<path class="band ${of}" d="${path(c.x, c.band[0])}${path(c.x, c.band[1])
          .slice(1)
          .split("L")
          .reverse()
          .reduce((d, one) => `${d}L${one}`, "")}Z"/>`,
      );
  for (const one of fan) if (one.p) out.push(`<path class="line fan" d="${path(one.x, one.p)}"/>`);
  // In this order no line crosses a label that reads away from it.
  const flipped = ({ x }) => X(x) > w * 0.62,
    ordered = [
      ...marks.filter((one) => !flipped(one)).sort((one, other) => one.x - other.x),
      ...marks.filter(flipped).sort((one, other) => other.x - one.x),
    ];
  ordered.forEach(({ x, label, kind }, i) => {
    const flips = flipped({ x }),
      y = 12 + 15 * i;
    const beside = { x: X(x) + (flips ? -5 : 5), y, "text-anchor": flips ? "end" : "start" };
    out.push(
      tag("line", { class: `mark-line ${kind}`, x1: X(x), x2: X(x), y1: y - 9, y2: Y(0) }),
      tag("text", { class: `tick halo ${kind}`, ...beside }, safe(label)),
    );
  });
  for (const [c, of] of curves) {
    if (c.p) out.push(`<path class="line ${of}" d="${path(c.x, c.p)}"/>`);
    const [levels, collapses, histories] = c.stripes;
    levels.forEach((level, i) => {
      if (level <= last)
        out.push(`<circle class="dot ${of}" cx="${X(level)}" cy="${Y(collapses[i] / histories[i])}" r="3.6"/>`);
    });
    if (c.p && curves.length > 1) {
      const x = X(c.theta) + (of === "a" ? 10 : -10),
        anchor = of === "a" ? "start" : "end";
      out.push(tag("text", { class: `halo ${of}`, x, y: Y(0.5) + 5, "text-anchor": anchor }, of.toUpperCase()));
    }
  }
  const title = a?.p ? `${t("curve_title", { im })}. θ = ${num(a.theta, 3)}, β = ${num(a.beta, 3)}` : t("no_curve");
  return picture(w, h, title, out);
}

// The same as a file of its own: the style goes with it.
export function standalone(svg) {
  const style = getComputedStyle(document.documentElement),
    value = (name) => style.getPropertyValue(name);
  const rules = [...document.styleSheets[0].cssRules]
    .filter((rule) => rule instanceof CSSStyleRule && rule.selectorText.startsWith("svg"))
    .map((rule) => rule.cssText.replaceAll("svg ", "").replace(/var\((--[\w-]+)\)/g, (_, name) => value(name)))
    .join("\n");
  const ground = tag("rect", { width: "100%", height: "100%", fill: value("--panel") });
  return svg.replace(">", `><style>text{font-family:system-ui,sans-serif}${rules}</style>${ground}`);
}
