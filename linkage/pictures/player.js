"use strict";
(() => {
const data = JSON.parse(document.getElementById("data").textContent);
const { scene, chart, reached } = data;
const byId = (id) => document.getElementById(id);
const css = (name) => `var(--${name})`;

/* Return a new SVG element in a parent. */
function draw(parent, kind, attributes) {
  const element = document.createElementNS("http://www.w3.org/2000/svg", kind);
  set(element, attributes);
  return parent.appendChild(element);
}
function set(element, attributes) {
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
}
const pairs = (points) => points.map((p) => `${p[0].toFixed(2)},${p[1].toFixed(2)}`).join(" ");

/* ---- the mechanism: each part is made once and returns how it moves ------------------------------ */

const sheet = byId("mechanism");
set(sheet, { viewBox: `0 0 ${scene.width} ${scene.height}` });
const size = scene.size;
const EDGE = 1.4;

function body({ points, shares, fill, edge }) {
  const plate = shares.length > 2;
  const group = draw(sheet, "g", { opacity: plate ? 0.72 : 1 });
  const outer = draw(group, "polygon", { fill: edge, stroke: edge, "stroke-width": 2 * size + 2 * EDGE, "stroke-linejoin": "round" });
  const inner = draw(group, "polygon", { fill, stroke: fill, "stroke-width": 2 * size, "stroke-linejoin": "round" });
  const corner = (at, row) => [0, 1].map((axis) => row.reduce((sum, share, k) => sum + share * at[points[k]][axis], 0));
  return (at) => { const text = pairs(shares.map((row) => corner(at, row))); set(outer, { points: text }); set(inner, { points: text }); };
}

function ram({ P, Q, aside, bottom, mouth, rod, least, most }) {
  const group = draw(sheet, "g", { stroke: css("ink"), "stroke-width": 0.8 * EDGE, "stroke-linejoin": "round" });
  const box = (name, fill) => {
    const half = scene.widths[name] * size, rect = draw(group, "rect", { fill: css(fill), y: -aside - half, height: 2 * half });
    return (from, to) => set(rect, { x: from, width: Math.max(to - from, 0) });
  };
  const eye = box("eye", "piston"), tube = box("barrel", "barrel"), shaft = box("rod", "rod");
  const piston = box("piston", "piston"), cap = box("cap", "piston");
  const disc = scene.thick.piston * size, lid = scene.thick.cap * size;
  eye(0, bottom); tube(bottom, mouth); cap(mouth - lid, mouth + lid);
  return (at) => {
    const dx = at[Q][0] - at[P][0], dy = at[Q][1] - at[P][1], length = Math.hypot(dx, dy);
    const place = Math.min(Math.max(length - rod, least), most);
    shaft(place, length); piston(place - disc, place + disc);
    set(group, { transform: `translate(${at[P][0]} ${at[P][1]}) rotate(${(Math.atan2(dy, dx) * 180) / Math.PI})` });
  };
}

/* A spring, a damper, a strut: lines that stretch, each place a share of the length and a way along and across. */
function straight({ P, Q, lines }) {
  const group = draw(sheet, "g", { stroke: css("ink"), "stroke-linejoin": "round", "stroke-linecap": "round" });
  const drawn = lines.map(({ rows, fill, closed, bold }) => {
    const line = draw(group, closed ? "polygon" : "polyline", { fill: fill ? css(fill) : "none", "stroke-width": (bold ? 1.5 : 0.8) * EDGE });
    return (length) => set(line, { points: pairs(rows.map(([share, along, across]) => [share * length + along, across])) });
  });
  return (at) => {
    const dx = at[Q][0] - at[P][0], dy = at[Q][1] - at[P][1], length = Math.hypot(dx, dy);
    for (const line of drawn) line(length);
    set(group, { transform: `translate(${at[P][0]} ${at[P][1]}) rotate(${(Math.atan2(dy, dx) * 180) / Math.PI})` });
  };
}

/* What some points carry, or nothing does: lines that keep their form. */
function piece({ on: [P, Q], origin, lines, hatches }, ink) {
  const group = draw(sheet, "g", { stroke: css(ink), "stroke-linejoin": "round", "stroke-linecap": "round" });
  for (const { rows, fill, closed, bold } of lines) {
    draw(group, closed ? "polygon" : "polyline", { points: pairs(rows), fill: fill ? css(fill) : "none", "stroke-width": (bold ? 1.5 : 0.9) * EDGE });
  }
  for (const [from, to] of hatches) draw(group, "line", { x1: from[0], y1: from[1], x2: to[0], y2: to[1], "stroke-width": 0.7 });
  return (at) => {
    const [x, y] = P === undefined ? origin : at[P];
    const turn = Q === undefined ? 0 : (Math.atan2(at[Q][1] - at[P][1], at[Q][0] - at[P][0]) * 180) / Math.PI;
    set(group, { transform: `translate(${x} ${y}) rotate(${turn})` });
  };
}

function slot([P, Q]) {
  const common = { "stroke-linecap": "round" }, half = scene.slide.slot * size;
  const outer = draw(sheet, "line", { ...common, stroke: css("ink"), "stroke-width": 2 * half + EDGE });
  const inner = draw(sheet, "line", { ...common, stroke: css("paper"), "stroke-width": 2 * half - EDGE });
  return (at) => { for (const line of [outer, inner]) set(line, { x1: at[P][0], y1: at[P][1], x2: at[Q][0], y2: at[Q][1] }); };
}

function block({ rider, ends: [P, Q], half }) {
  const long = scene.slide.long * size, wide = half * size;
  const rect = draw(sheet, "rect", { x: -long, y: -wide, width: 2 * long, height: 2 * wide, fill: css("rule"), stroke: css("ink"), "stroke-width": EDGE });
  return (at) => {
    const turn = (Math.atan2(at[Q][1] - at[P][1], at[Q][0] - at[P][0]) * 180) / Math.PI;
    set(rect, { transform: `translate(${at[rider][0]} ${at[rider][1]}) rotate(${turn})` });
  };
}

function circle(index, radius, fill, stroke, width) {
  const element = draw(sheet, "circle", { r: radius, fill, stroke, "stroke-width": width });
  return (at) => set(element, { cx: at[index][0], cy: at[index][1] });
}

function stay([P, X]) {
  const line = draw(sheet, "line", { stroke: css("muted"), "stroke-width": EDGE, "stroke-dasharray": "7 4" });
  return (at) => set(line, { x1: at[P][0], y1: at[P][1], x2: at[X][0], y2: at[X][1] });
}

function name(index) {
  const text = draw(sheet, "text", { class: "name" }), [dx, dy] = scene.labels[index];
  text.textContent = scene.names[index];
  return (at) => set(text, { x: at[index][0] + dx, y: at[index][1] + dy });
}

/* Return a curve as an SVG path, broken where there is no value. */
function broken(points) {
  let pen = "M";
  return points.map((p) => { if (!p) { pen = "M"; return ""; } const step = `${pen}${p[0].toFixed(1)} ${p[1].toFixed(1)}`; pen = "L"; return step; }).join("");
}

const around = scene.pieces.map((each) => piece(each, "muted"));
for (const path of scene.paths) {
  draw(sheet, "path", { class: "line", d: broken(path), stroke: css("accent"), "stroke-width": 2.2, "stroke-dasharray": "0.1 4.6" });
}
for (const { triangle, lines } of scene.grounds) {
  draw(sheet, "polygon", { points: pairs(triangle), fill: css("rod"), stroke: css("ink"), "stroke-width": EDGE, "stroke-linejoin": "round" });
  for (const [from, to] of lines) draw(sheet, "line", { x1: from[0], y1: from[1], x2: to[0], y2: to[1], stroke: css("ink"), "stroke-width": 1 });
}
for (const lines of scene.rails) {
  lines.forEach(([from, to], i) => draw(sheet, "line", { x1: from[0], y1: from[1], x2: to[0], y2: to[1], stroke: css("ink"), "stroke-width": i ? 1 : 1.8 }));
}
const plates = scene.bodies.filter((each) => each.shares.length > 2), bars = scene.bodies.filter((each) => each.shares.length <= 2);
const [onPins, beside] = [true, false].map((pinned) => scene.marks.filter((each) => scene.pins.includes(each.on[0]) === pinned));
const parts = [
  ...around, ...scene.contours.map(straight), ...plates.map(body), ...scene.blocks.filter((each) => !each.inside).map(block), ...bars.map(body),
  ...scene.slots.map(slot), ...scene.blocks.filter((each) => each.inside).map(block), ...scene.stays.map(stay), ...scene.rams.map(ram), ...scene.straights.map(straight),
  ...onPins.map((each) => piece(each, "ink")),
  ...scene.pins.map((i) => circle(i, 0.5 * size, css("paper"), css("ink"), 1.3 * EDGE)),
  ...scene.dots.map((i) => circle(i, 0.48 * size, css("ink"), css("paper"), 1)),
  ...beside.map((each) => piece(each, "ink")),
  ...scene.names.map((_, i) => name(i)),
];

/* ---- the curve -------------------------------------------------------------------------------- */

const plot = byId("curve"), W = 440, H = Math.min(Math.max(0.92 * scene.height, 340), 640), L = 56, R = 10, T = 10, B = 48;
set(plot, { viewBox: `0 0 ${W} ${H}` });
const along = chart.stroke.values, results = chart.column.values, [low, high] = chart.range;
const least = Math.min(...along), most = Math.max(...along);
const px = (s) => L + ((s - least) / (most - least || 1)) * (W - L - R);
const py = (v) => H - B - ((v - low) / (high - low || 1)) * (H - T - B);
const minus = (text) => String(text).replace("-", "\u2212");

function write(x, y, text, attributes) {
  draw(plot, "text", { x, y, class: "tick", ...attributes }).textContent = minus(text);
}
/* Return how ticks are written: all with the same number of decimals. */
const evenly = (ticks) => { const places = Math.max(...ticks.map((t) => (String(t).split(".")[1] ?? "").length)); return (t) => t.toFixed(places); };
const written = evenly(chart.ticks), strokeWritten = evenly(chart.stroke.ticks);
if (chart.limit) {
  const at = py(chart.limit.value), above = chart.limit.above;
  draw(plot, "rect", { x: L, width: W - L - R, y: above ? T : at, height: above ? at - T : H - B - at, fill: css("accent"), opacity: 0.1 });
}
for (const v of chart.ticks) {
  draw(plot, "line", { x1: L, x2: W - R, y1: py(v), y2: py(v), stroke: css("grid") });
  write(L - 8, py(v) + 4.5, written(v), { "text-anchor": "end" });
}
for (const s of chart.stroke.ticks) {
  draw(plot, "line", { x1: px(s), x2: px(s), y1: T, y2: H - B, stroke: css("grid") });
  write(px(s), H - B + 20, strokeWritten(s), { "text-anchor": px(s) > W - R - 12 ? "end" : "middle" });
}
draw(plot, "path", { d: `M${L} ${T}V${H - B}H${W - R}`, class: "line", stroke: css("rule") });
write(0.5 * (L + W - R), H - 6, `${chart.stroke.name}, ${chart.stroke.unit}`, { "text-anchor": "middle" });
const points = along.map((s, i) => (results[i] === null ? null : [px(s), py(results[i])]));
draw(plot, "path", { class: "line", d: broken(points), stroke: css("rule"), "stroke-width": 2.5 });
if (chart.limit) {
  const at = py(chart.limit.value), above = chart.limit.above;
  const far = (i) => Math.abs((results[i] ?? chart.limit.value) - chart.limit.value);
  const right = far(results.length - 1) >= far(0);
  draw(plot, "line", { x1: L, x2: W - R, y1: at, y2: at, stroke: css("accent"), "stroke-width": 1.6, "stroke-dasharray": "7 4" });
  write(right ? W - R - 6 : L + 6, at + (above ? -7 : 16), chart.limit.text, { class: "note", "text-anchor": right ? "end" : "start" });
}
const run = draw(plot, "path", { class: "line", stroke: css("curve"), "stroke-width": 3 });
const short = draw(plot, "path", { class: "line", stroke: css("accent"), "stroke-width": 3.6 });
if (chart.limit) {
  const fails = (v) => v !== null && (chart.limit.above ? v > chart.limit.value : v < chart.limit.value);
  set(short, { d: broken(points.map((p, i) => (fails(results[i]) ? p : null))) });
}
const marker = draw(plot, "circle", { r: 6.5, fill: css("curve"), stroke: css("paper"), "stroke-width": 2 });

/* ---- one pose: `place` counts poses in reach and may lie between two ------------------------------ */

const last = reached.length - 1;
const mix = (a, b, t) => a + (b - a) * t;

function show(place) {
  const i = Math.min(Math.floor(place), last), t = place - i, from = reached[i], to = reached[Math.min(i + 1, last)];
  const at = scene.poses[from].map((p, k) => [mix(p[0], scene.poses[to][k][0], t), mix(p[1], scene.poses[to][k][1], t)]);
  for (const part of parts) part(at);
  const s = mix(along[from], along[to], t), known = results[from] !== null && results[to] !== null;
  const value = known ? mix(results[from], results[to], t) : null;
  set(run, { d: broken([...points.slice(0, from + 1), value === null ? null : [px(s), py(value)]]) });
  set(marker, { visibility: value === null ? "hidden" : "visible" });
  if (value !== null) set(marker, { cx: px(s), cy: py(value) });
  const unit = chart.stroke.unit === "deg" ? "\u00b0" : ` ${chart.stroke.unit}`;
  byId("reading").textContent = minus(s.toFixed(most - least > 20 ? 0 : 2)) + unit;
  byId("value").textContent = value === null ? "\u2013" : minus(shown(value));
  slider.setAttribute("aria-valuetext", byId("reading").textContent + ", " + byId("heading").textContent + " " + byId("value").textContent);
}
function shown(value) {
  const whole = Math.max(0, Math.floor(Math.log10(Math.abs(value) || 1)) + 1);
  return value.toFixed(Math.max(0, 4 - Math.max(whole, 1)));
}

/* ---- controls ----------------------------------------------------------------------------------- */

const slider = byId("stroke"), button = byId("play"), speed = byId("speed");
const PERIOD = 5; /* seconds for there and back, or once round */
let playing = false, phase = 0, before = null;

const placed = (share) => (data.turn ? share * last : (0.5 - 0.5 * Math.cos(2 * Math.PI * share)) * last);
const phaseOf = (place) => (data.turn ? place / (last || 1) : Math.acos(1 - (2 * place) / (last || 1)) / (2 * Math.PI));

function step(now) {
  if (!playing) return;
  phase = (phase + ((now - (before ?? now)) / 1000 / PERIOD) * Number(speed.value)) % 1;
  before = now;
  const place = placed(phase);
  slider.value = String(Math.round(place));
  show(place);
  requestAnimationFrame(step);
}
function play(on) {
  playing = on;
  button.setAttribute("aria-pressed", String(on));
  byId("word").textContent = on ? "Pause" : "Play";
  set(byId("sign"), { d: on ? "M6 4h4v16H6zM14 4h4v16h-4z" : "M7 4l13 8-13 8z" });
  if (on) { before = null; requestAnimationFrame(step); }
}
button.addEventListener("click", () => play(!playing));
slider.addEventListener("input", () => { play(false); phase = phaseOf(Number(slider.value)); show(Number(slider.value)); });
document.querySelector("form").addEventListener("submit", (event) => event.preventDefault());
document.addEventListener("keydown", (event) => {
  if (event.altKey || event.ctrlKey || event.metaKey) return;
  const steps = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1, Home: -last, End: last };
  if (event.key === " " && event.target !== button && event.target !== speed) { event.preventDefault(); play(!playing); }
  else if (event.key in steps && event.target !== slider && event.target !== speed) {
    event.preventDefault();
    slider.value = String(Number(slider.value) + steps[event.key]);
    slider.dispatchEvent(new Event("input"));
  }
});

byId("held").textContent = [data.held ? `at ${data.held}` : "", data.remark].filter(Boolean).join("; ");
byId("heading").textContent = chart.column.heading;
slider.max = String(last);
show(0);
play(!window.matchMedia("(prefers-reduced-motion: reduce)").matches);
})();
