// The wall to scale, what it carries and what holds it, and its motion.
import { num, safe, t } from "./words.js";

// SVG of the wall; blocks: where it is now, at rest if left out
export function drawing(wall, blocks) {
  if (!wall) return `<p class="hint">${t("no_shape")}</p>`;
  const h = wall.height, reach = Math.max(2.2 * wall.thickness, 0.34 * h, ...wall.rest.flat().map(([x]) => -1.15 * x)), x0 = -reach, x1 = wall.thickness + 1.15 * reach, scale = 300 / (1.22 * h), w = (x1 - x0) * scale, tall = 1.22 * h * scale;
  const X = (x) => +((x - x0) * scale).toFixed(1), Y = (y) => +((1.12 * h - y) * scale).toFixed(1);
  const shape = (points) => points.map(([x, y]) => `${X(x)},${Y(y)}`).join(" ");
  const upright = (x, y, text) => `<text class="small halo" transform="rotate(-90 ${x.toFixed(1)} ${y.toFixed(1)})" x="${x.toFixed(1)}" y="${(y + 4).toFixed(1)}" text-anchor="middle">${safe(text)}</text>`;
  const out = [`<line class="ground" x1="${X(x0)}" x2="${X(x1)}" y1="${Y(0)}" y2="${Y(0)}"/>`];
  // The transverse wall that it cannot rock into, and as far as it goes the building that moves it
  if (wall.kind === "one_sided") {
    const rows = Math.round((Y(0) - Y(h)) / 11), wide = X(0) - X(x0) - 1.5, rise = Math.min(wide, 22);
    for (let i = 0; i <= rows; i++) { const y = Y(h) + (i * (Y(0) - Y(h))) / rows, x = X(0) - 1.5, run = Math.min(rise, y - Y(h)); if (run > 0) out.push(`<line class="hatch" x1="${x - run}" y1="${(y - run).toFixed(1)}" x2="${x}" y2="${y.toFixed(1)}"/>`); }
    if (wall.building > 0) { const top = Math.min(wall.building, h); out.push(`<rect class="behind" x="${X(x0)}" y="${Y(top)}" width="${wide - rise}" height="${Y(0) - Y(top)}"/>`, upright((X(x0) + X(0) - rise) / 2, Y(0.5 * top), t("building"))); }
    else out.push(upright(X(0) - rise - 8, Y(0.5 * h), t("transverse")));
  }
  if (wall.kind === "two_block") out.push(`<rect class="behind" x="${X(x0)}" y="${Y(1.035 * h)}" width="${X(0) - X(x0)}" height="${Y(h) - Y(1.035 * h)}"/><rect class="behind" x="${X(wall.thickness)}" y="${Y(1.035 * h)}" width="${X(x1) - X(wall.thickness)}" height="${Y(h) - Y(1.035 * h)}"/>`);
  for (const [x, y, height, diameter] of wall.ties) { const half = 0.5 * Math.max(height, diameter, 0.035 * h); out.push(`<line class="tie" x1="${X(x0)}" x2="${X(x)}" y1="${Y(y)}" y2="${Y(y)}"/><line class="plate" x1="${X(x) + 2}" x2="${X(x) + 2}" y1="${Y(y - half)}" y2="${Y(y + half)}"/>`); }
  for (const block of blocks ? wall.rest : wall.leaning) out.push(`<polygon class="ghost" points="${shape(block)}"/>`);
  for (const block of blocks || wall.rest) out.push(`<polygon class="body" points="${shape(block)}"/>`);
  if (!blocks) for (const [x, y] of wall.hinges) out.push(`<circle class="hinge" cx="${X(x)}" cy="${Y(y)}" r="3.4"/>`);
  const arrow = (xa, ya, xb, yb) => { const a = Math.atan2(yb - ya, xb - xa), p = (d) => `${(xb - 8 * Math.cos(a + d)).toFixed(1)},${(yb - 8 * Math.sin(a + d)).toFixed(1)}`; return `<line class="force" x1="${xa}" y1="${ya}" x2="${xb}" y2="${yb}"/><polygon class="force-head" points="${xb},${yb} ${p(0.42)} ${p(-0.42)}"/>`; };
  const kn = (force) => `${num(force / 1e3, force < 1e4 ? 1 : 0)} ${wall.kind === "corner" ? "kN" : "kN/m"}`;
  for (const [x, y, force] of wall.loads) if (force > 0) out.push(arrow(X(x), Y(y) - 26, X(x), Y(y)), `<text class="small halo" x="${X(wall.thickness) + 6}" y="${Y(y) - 12}">${kn(force)}</text>`);
  for (const [x, y, force] of wall.thrusts) if (force > 0) out.push(arrow(X(x) - 34, Y(y), X(x), Y(y)), `<text class="small halo" x="${X(x) - 38}" y="${Y(y) + 4}" text-anchor="end">${kn(force)}</text>`);
  if (wall.overburden[0] > 0) { const x = X(wall.thickness / 2 + wall.overburden[1]); out.push(arrow(x, Y(h) - 26, x, Y(h)), `<text class="small halo" x="${x + 8}" y="${Y(h) - 14}">${kn(wall.overburden[0])}</text>`); }
  const xd = X(x1) - 16;
  out.push(`<path class="axis" d="M${xd} ${Y(0)}V${Y(h)}m-4 0h8m-8 ${Y(0) - Y(h)}h8" fill="none"/><text class="small halo" x="${xd - 6}" y="${(Y(0) + Y(h)) / 2}" text-anchor="end">${num(h, 2)} m</text><text class="small" x="${X(wall.thickness / 2)}" y="${Y(0) + 16}" text-anchor="middle">${num(wall.thickness, 2)} m</text>`);
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${w.toFixed(0)} ${(tall + 10).toFixed(0)}" role="img" aria-label="${safe(t("wall_alt"))}">${out.join("")}</svg>`;
}

// Trace of rotation over capacity with the present instant
export function trace(motion, at) {
  const w = 260, h = 74, [time, ratio] = motion.trace, first = time[0], last = time[time.length - 1], top = Math.max(1.05, ...ratio), low = Math.min(0, ...ratio);
  const X = (x) => +(4 + ((w - 8) * (x - first)) / (last - first)).toFixed(1), Y = (y) => +(6 + ((h - 22) * (top - y)) / (top - low)).toFixed(1);
  return `<svg viewBox="0 0 ${w} ${h}" role="img" aria-label="${safe(t("rotation"))}"><line class="grid" x1="4" x2="${w - 4}" y1="${Y(0)}" y2="${Y(0)}"/><line class="limit" x1="4" x2="${w - 4}" y1="${Y(1)}" y2="${Y(1)}"/><path class="trace" d="${time.map((x, i) => `${i ? "L" : "M"}${X(x)} ${Y(Math.min(ratio[i], top))}`).join("")}"/><circle class="now" cx="${X(motion.instants[at])}" cy="${Y(motion.ratio[at])}" r="3.6"/><text class="small" x="4" y="${h - 3}">${safe(t("rotation"))}</text><text class="small" x="${w - 4}" y="${h - 3}" text-anchor="end">${num(motion.instants[at], 1)} s</text></svg>`;
}
