// The curve of "In the browser" without a server: two sliders, and medians interpolated in a table.
import { chart } from "./chart.js";
import table from "./curve_table.js";
import { num, sig } from "./words.js";

// Place of a value in an axis of the table, as number of the cell and share of it, both in logarithms
/** @type {(axis: number[], value: number) => [number, number]} */
function place(axis, value) {
  let i = 0;
  while (i < axis.length - 2 && axis[i + 1] < value) i += 1;
  return [i, Math.log(value / axis[i]) / Math.log(axis[i + 1] / axis[i])];
}
/** @type {(values: number[][], at: [number, number], other: [number, number]) => number} */
function between(values, [i, u], [j, v]) {
  const row = (k) => (1 - v) * values[k][j] + v * values[k][j + 1];
  return (1 - u) * row(i) + u * row(i + 1);
}
// Distribution function of the standard normal, to 1e-7 (Abramowitz and Stegun, 26.2.17)
function normal(z) {
  const t = 1 / (1 + 0.2316419 * Math.abs(z)),
    tail =
      (Math.exp((-z * z) / 2) / Math.sqrt(2 * Math.PI)) *
      t *
      (0.31938153 + t * (-0.356563782 + t * (1.781477937 + t * (-1.821255978 + t * 1.330274429))));
  return z < 0 ? tail : 1 - tail;
}
export function curveOf(height, thickness) {
  const at = place(table.heights, height),
    other = place(table.thicknesses, thickness);
  return {
    theta: Math.exp(
      between(
        table.theta.map((row) => row.map(Math.log)),
        at,
        other,
      ),
    ),
    beta: between(table.beta, at, other),
  };
}

function begin(home) {
  const make = (tag, more = {}) => Object.assign(document.createElement(tag), more),
    sliders = [
      { name: "height", axis: table.heights, value: 6 },
      { name: "thickness", axis: table.thicknesses, value: 0.5 },
    ].map(({ name, axis, value }) => {
      const label = make("label"),
        out = make("output"),
        range = make("input", { type: "range", min: axis[0], max: axis[axis.length - 1], step: 0.01, value });
      label.append(`${name[0].toUpperCase()}${name.slice(1)} `, out, range);
      range.addEventListener("input", draw);
      return { label, out, range };
    });
  const figure = make("figure"),
    said = make("p", { className: "said" });
  said.setAttribute("role", "status");
  function draw() {
    for (const { out, range } of sliders) out.textContent = `${num(Number(range.value), 2)} m`;
    const { theta, beta } = curveOf(Number(sliders[0].range.value), Number(sliders[1].range.value)),
      x = Array.from({ length: 121 }, (_, i) => (4 * i) / 120);
    const found = {
      theta,
      beta,
      x,
      p: x.map((one) => (one ? normal(Math.log(one / theta) / beta) : 0)),
      stripes: [[], [], []],
    };
    figure.innerHTML = chart(found, null, { width: 640, im: "PGA [g]" });
    const walls = table.heights.length * table.thicknesses.length,
      error = num(100 * table.error.largest, 0);
    said.textContent =
      `θ = ${sig(theta)} g, β = ${num(beta, 2)}: interpolated in a table of ${walls} walls, not computed for this ` +
      `one (error of θ at most ${error} %). dondolo serve computes yours.`;
  }
  home.replaceChildren(...sliders.map(({ label }) => label), figure, said);
  draw();
}
for (const home of document.querySelectorAll(".interpolated-curve")) begin(home);
