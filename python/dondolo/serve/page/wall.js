// The wall to scale, what it carries and what holds it, and its motion.
import { num, picture, safe, t, tag } from "./words.js";

// A force from a point to another
function arrow(xa, ya, xb, yb) {
  const a = Math.atan2(yb - ya, xb - xa),
    p = (d) => `${(xb - 8 * Math.cos(a + d)).toFixed(1)},${(yb - 8 * Math.sin(a + d)).toFixed(1)}`;
  const head = tag("polygon", { class: "force-head", points: `${xb},${yb} ${p(0.42)} ${p(-0.42)}` });
  return tag("line", { class: "force", x1: xa, y1: ya, x2: xb, y2: yb }) + head;
}

// SVG of a wall that bends horizontally, in its plan: outwards is down, the transverse walls are behind its ends
function plan(wall, blocks) {
  const { length, thickness } = wall,
    ends = 0.12 * length,
    behind = 0.26 * length,
    out = Math.max(0.15 * length, ...wall.leaning.flat().map(([, y]) => 1.25 * y)),
    scale = 250 / length,
    left = ends + 64 / scale;
  const X = (x) => +((x + left) * scale).toFixed(1),
    Y = (y) => +((y + thickness + behind) * scale + 4).toFixed(1),
    below = Y(out) + 6;
  const shape = (points) => points.map(([x, y]) => `${X(x)},${Y(y)}`).join(" ");
  const label = (x, y, text, more = {}) => tag("text", { class: "small halo", x, y, ...more }, text);
  const kn = (force) => `${num(force / 1e3, force < 1e4 ? 2 : 0)} kN/m`;
  const parts = [-ends, length].map((x) =>
    tag("rect", { class: "behind", x: X(x), y: Y(-thickness - behind), width: ends * scale, height: Y(0) - 4 }),
  );
  parts.push(label(X(0.5 * length), Y(-thickness - behind) + 12, t("transverse_walls"), { "text-anchor": "middle" }));
  const ghosts = blocks ? wall.rest : wall.leaning;
  for (const block of ghosts) parts.push(`<polygon class="ghost" points="${shape(block)}"/>`);
  for (const block of blocks || wall.rest) parts.push(`<polygon class="body" points="${shape(block)}"/>`);
  const joints = blocks ? [] : wall.hinges;
  for (const [x, y] of joints) parts.push(`<circle class="hinge" cx="${X(x)}" cy="${Y(y)}" r="3.4"/>`);
  const level = Y(wall.hinges[0][1]);
  parts.push(
    arrow(X(-ends) - 34, level, X(-ends), level),
    arrow(X(length + ends) + 34, level, X(length + ends), level),
    label(X(-ends) - 4, level - 8, kn(wall.thrust), { "text-anchor": "end" }),
  );
  for (const [place, force] of wall.pushes)
    if (force > 0)
      parts.push(
        arrow(X(place), Y(-thickness) - 30, X(place), Y(-thickness)),
        label(X(place) + 5, Y(-thickness) - 16, kn(force)),
      );
  parts.push(
    tag("path", {
      class: "axis",
      d: `M${X(0)} ${below}H${X(length)}M${X(0)} ${below - 4}v8M${X(length)} ${below - 4}v8`,
    }),
    label(X(0.5 * length), below + 16, `${num(length, 2)} m`, { "text-anchor": "middle" }),
    label(X(length) + 6, Y(0) + 16, `${num(thickness, 2)} m`),
  );
  return picture((2 * X(0) + length * scale).toFixed(0), (below + 24).toFixed(0), t("wall_alt"), parts);
}

// SVG of the wall; blocks: where it is now, at rest if left out
export function drawing(wall, blocks) {
  if (!wall) return `<p class="hint">${t("no_shape")}</p>`;
  if (wall.kind === "horizontal") return plan(wall, blocks);
  const h = wall.height,
    reach = Math.max(2.2 * wall.thickness, 0.34 * h, ...wall.rest.flat().map(([x]) => -1.15 * x)),
    x0 = -reach,
    x1 = wall.thickness + 1.15 * reach,
    scale = 300 / (1.22 * h),
    w = (x1 - x0) * scale,
    tall = 1.22 * h * scale;
  const X = (x) => +((x - x0) * scale).toFixed(1),
    Y = (y) => +((1.12 * h - y) * scale).toFixed(1);
  const shape = (points) => points.map(([x, y]) => `${X(x)},${Y(y)}`).join(" ");
  const label = (x, y, text, more = {}) => tag("text", { class: "small halo", x, y, ...more }, text);
  const upright = (x, y, text) => {
    const [a, b] = [x.toFixed(1), y.toFixed(1)],
      turned = { class: "small halo", transform: `rotate(-90 ${a} ${b})`, x: a, y: (y + 4).toFixed(1) };
    return tag("text", { ...turned, "text-anchor": "middle" }, safe(text));
  };
  const behind = (x, y, width, height) => tag("rect", { class: "behind", x, y, width, height });
  const out = [`<line class="ground" x1="${X(x0)}" x2="${X(x1)}" y1="${Y(0)}" y2="${Y(0)}"/>`];
  // The transverse wall that it cannot rock into, and as far as it goes the building that moves it
  if (wall.kind === "one_sided") {
    const rows = Math.round((Y(0) - Y(h)) / 11),
      wide = X(0) - X(x0) - 1.5,
      rise = Math.min(wide, 22);
    for (let i = 0; i <= rows; i++) {
      const y = Y(h) + (i * (Y(0) - Y(h))) / rows,
        x = X(0) - 1.5,
        run = Math.min(rise, y - Y(h));
      if (run > 0)
        out.push(`<line class="hatch" x1="${x - run}" y1="${(y - run).toFixed(1)}" x2="${x}" y2="${y.toFixed(1)}"/>`);
    }
    if (wall.building > 0) {
      const top = Math.min(wall.building, h);
      out.push(
        behind(X(x0), Y(top), wide - rise, Y(0) - Y(top)),
        upright((X(x0) + X(0) - rise) / 2, Y(0.5 * top), t("building")),
      );
    } else out.push(upright(X(0) - rise - 8, Y(0.5 * h), t("transverse")));
  }
  if (wall.kind === "two_block")
    for (const [left, right] of [
      [X(x0), X(0)],
      [X(wall.thickness), X(x1)],
    ])
      out.push(behind(left, Y(1.035 * h), right - left, Y(h) - Y(1.035 * h)));
  for (const [x, y, height, diameter] of wall.ties) {
    const half = 0.5 * Math.max(height, diameter, 0.035 * h);
    out.push(
      tag("line", { class: "tie", x1: X(x0), x2: X(x), y1: Y(y), y2: Y(y) }),
      tag("line", { class: "plate", x1: X(x) + 2, x2: X(x) + 2, y1: Y(y - half), y2: Y(y + half) }),
    );
  }
  for (const block of blocks ? wall.rest : wall.leaning) out.push(`<polygon class="ghost" points="${shape(block)}"/>`);
  for (const block of blocks || wall.rest) out.push(`<polygon class="body" points="${shape(block)}"/>`);
  if (!blocks) for (const [x, y] of wall.hinges) out.push(`<circle class="hinge" cx="${X(x)}" cy="${Y(y)}" r="3.4"/>`);
  const kn = (force) => `${num(force / 1e3, force < 1e4 ? 1 : 0)} ${wall.kind === "corner" ? "kN" : "kN/m"}`;
  for (const [x, y, force] of wall.loads)
    if (force > 0) out.push(arrow(X(x), Y(y) - 26, X(x), Y(y)), label(X(wall.thickness) + 6, Y(y) - 12, kn(force)));
  for (const [x, y, force] of wall.thrusts)
    if (force > 0)
      out.push(arrow(X(x) - 34, Y(y), X(x), Y(y)), label(X(x) - 38, Y(y) + 4, kn(force), { "text-anchor": "end" }));
  if (wall.overburden[0] > 0) {
    const x = X(wall.thickness / 2 + wall.overburden[1]);
    out.push(arrow(x, Y(h) - 26, x, Y(h)), label(x + 8, Y(h) - 14, kn(wall.overburden[0])));
  }
  const xd = X(x1) - 16,
    below = { x: X(wall.thickness / 2), y: Y(0) + 16 };
  out.push(
    tag("path", { class: "axis", d: `M${xd} ${Y(0)}V${Y(h)}m-4 0h8m-8 ${Y(0) - Y(h)}h8`, fill: "none" }),
    label(xd - 6, (Y(0) + Y(h)) / 2, `${num(h, 2)} m`, { "text-anchor": "end" }),
    tag("text", { class: "small", ...below, "text-anchor": "middle" }, `${num(wall.thickness, 2)} m`),
  );
  return picture(w.toFixed(0), (tall + 10).toFixed(0), t("wall_alt"), out);
}

// Trace of rotation over capacity with the present instant
export function trace(motion, at) {
  const w = 260,
    h = 74,
    [time, ratio] = motion.trace,
    first = time[0],
    last = time[time.length - 1],
    top = Math.max(1.05, ...ratio),
    low = Math.min(0, ...ratio);
  const X = (x) => +(4 + ((w - 8) * (x - first)) / (last - first)).toFixed(1),
    Y = (y) => +(6 + ((h - 22) * (top - y)) / (top - low)).toFixed(1);
  const points = time.map((x, i) => `${i ? "L" : "M"}${X(x)} ${Y(Math.min(ratio[i], top))}`);
  const across = (name, y) => tag("line", { class: name, x1: 4, x2: w - 4, y1: Y(y), y2: Y(y) });
  const parts = [
    across("grid", 0),
    across("limit", 1),
    tag("path", { class: "trace", d: points.join("") }),
    tag("circle", { class: "now", cx: X(motion.instants[at]), cy: Y(motion.ratio[at]), r: 3.6 }),
    tag("text", { class: "small", x: 4, y: h - 3 }, safe(t("rotation"))),
    tag("text", { class: "small", x: w - 4, y: h - 3, "text-anchor": "end" }, `${num(motion.instants[at], 1)} s`),
  ];
  return picture(w, h, t("rotation"), parts);
}
