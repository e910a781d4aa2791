(async () => {
const data = JSON.parse(await unpacked("data"));
const byId = (id) => document.getElementById(id);
const css = (name) => `var(--${name})`;
const { scene, strokes, units } = data, { abs, acos, atan2, ceil, cos, floor, hypot, log10, max, min, round, PI } = Math;
const isNumber = Number.isFinite, root = document.documentElement;
const on = (element, event, act) => element.addEventListener(event, act);
const make = (kind, given) => Object.assign(document.createElement(kind), given);
/* A dimension as it comes: its name, value, least and greatest [SI], unit, whether it is a length, and where it stands. */
const columns = data.columns.map(([name, unit, row, ru, values, why]) => ({ name, unit, factor: units[unit], row: row < 0 ? undefined : row, ru, values, why }));
const dims = data.dims.map(([name, value, ends, unit, positive, where]) => ({ name, value, low: ends[0] ?? value - ends, high: ends[1] ?? value + ends, unit, factor: units[unit], positive, where }));
const rows = data.rows;

/* ---- words and numbers ---- */

let language = data.language;
/* Return a sentence in the language chosen; all that are said here stand in browser_words.py. */
function say(text, given) {
  const said = data.words[language]?.[text] ?? text;
  return given ? said.replace(/\{(\w+)\}/g, (_, name) => given[name]) : said;
}
const minus = (text) => (/^-[0.]*$/.test(text) ? text.slice(1) : text).replace("-", "\u2212");
/* Return a number with its digits grouped, never in powers of ten. */
function fixed(value, decimals) {
  if (!isNumber(value)) return "\u2013";
  const [whole, part] = value.toFixed(decimals).split(".");
  const grouped = whole.replace(/^-/, "").length > 4 ? whole.replace(/\B(?=(\d{3})+$)/g, "\u202f") : whole;
  return minus(part ? `${grouped}.${part}` : grouped);
}
const places = (size, digits) => min(max(digits - 1 - floor(log10(size || 1)), 0), 9);
/* Return a number with the digits that it has, up to so many. */
function short(value, digits = 6) {
  const text = fixed(value, places(abs(value), digits));
  return text.includes(".") ? minus(text.replace("\u2212", "-").replace(/\.?0+$/, "")) : text;
}
const signed = (unit) => (unit === "deg" ? "\u00b0" : (language === "ru" && data.signs[unit]) || unit);
const unitText = (unit) => (unit === "deg" ? "\u00b0" : unit ? `\u2009${signed(unit)}` : "");
const shown = (value, thing, digits) => short(value / thing.factor, digits) + unitText(thing.unit);

/* ---- the state, and what follows from it ---- */

const byName = new Map(dims.map((each, i) => [each.name, i]));
const order = engine.d.map((name) => byName.get(name));
const COUNT = data.count;
const original = dims.map((each) => each.value), firstStand = () => strokes.map((each) => each.at);
/* The design and the strokes as they are, which stroke runs, and what else is chosen. */
let present = [...original], stands = firstStand(), runs = data.run, showsForces = false;
let chosen = [...data.shown], column = data.column, second = -1;
let base, now, pose, before = null;

const vector = (design) => order.map((i) => design[i]);
function sweep(design, at, run) {
  const { start, end } = strokes[run];
  const along = Float64Array.from({ length: COUNT }, (_, i) => (i === COUNT - 1 ? end : start + ((end - start) * i) / (COUNT - 1)));
  const found = engine.sweep(vector(design), at.map((value, k) => (k === run ? along : new Float64Array(COUNT).fill(value))));
  return { ...found, along, reached: [...along.keys()].filter((i) => found.reason[i] === 0) };
}
const single = (design, at) => engine.sweep(vector(design), at.map((value) => [value]));
const isChanged = () => dims.some((each, i) => present[i] !== each.value);
const isMoved = () => runs !== data.run || strokes.some((each, k) => k !== runs && stands[k] !== each.at);

/* Return why a pose cannot be had. */
function why(found, i, what) {
  const k = found.reason[i], step = k > 0 ? engine.steps[k - 1] : (found.at && found.at[i]) || "";
  const name = data.steps[step] || step, missing = found.missing[i];
  if (k === -1) return say("{what}: a change point, where two branches cross", { what });
  if (missing > 0) return say("{what}: {step} is {gap} short", { what, step: name, gap: shown(missing, data.length, 3) });
  return say("{what}: {step} cannot be placed", { what, step: name });
}
/* Move part of the state as far towards what is asked as can be assembled; say why where that is not all the way. */
function moved(design, at, what) {
  const asked = single(design, at);
  if (asked.reason[0] === 0) { present = design; stands = at; warn(""); return true; }
  const from = present, stood = stands, between = (a, b, t) => a.map((value, i) => (value === b[i] ? value : value + (b[i] - value) * t));
  let low = 0, high = 1, best = null;
  for (let i = 0; i < 24; i++) {
    const t = 0.5 * (low + high), trial = [between(from, design, t), between(stood, at, t)];
    if (single(...trial).reason[0] === 0) { low = t; best = trial; } else high = t;
  }
  if (best) [present, stands] = best;
  warn(why(asked, 0, say("{what} stops here", { what })));
  return false;
}
let fading;
function warn(text) {
  byId("message").textContent = text;
  clearTimeout(fading);
  if (text) fading = setTimeout(() => { byId("message").textContent = ""; }, 6000);
}

/* Return a row's values over the stroke; those of one that cannot be followed only while nothing was changed. */
function series(each, found) {
  if (!each) return null;
  if (each.row !== undefined) return found.values[each.row];
  return found === base || !(isChanged() || isMoved()) ? each.values : null;
}
const live = (each) => each && (each.row !== undefined || !(isChanged() || isMoved()));

/* ---- the drawing: each part is made once and returns how it moves ---- */

const SVG = "http://www.w3.org/2000/svg";
function draw(parent, kind, attributes) { const element = document.createElementNS(SVG, kind); set(element, attributes); return parent.appendChild(element); }
const LONG = { w: "stroke-width", join: "stroke-linejoin", cap: "stroke-linecap", dash: "stroke-dasharray", anchor: "text-anchor" };
function set(element, attributes) { for (const name in attributes) element.setAttribute(LONG[name] || name, attributes[name]); }
const pairs = (points) => points.map((p) => `${p[0].toFixed(2)},${p[1].toFixed(2)}`).join(" ");
/* Return a curve as a path, broken where there is no value. */
function broken(points) {
  let pen = "M", text = "";
  for (const p of points) { if (!p) { pen = "M"; continue; } text += `${pen}${p[0].toFixed(1)} ${p[1].toFixed(1)}`; pen = "L"; }
  return text;
}
const sheet = byId("mechanism"), EDGE = 1.3;
let zoom = 1, left0 = 0, top0 = 0, sheetWide = 0, sheetTall = 0, unit0 = 1;
const px = (x, y) => [left0 + zoom * x, top0 - zoom * y];
const spot = (found, point, i) => { const [x, y] = rows.points[point]; return [found.values[x][i], found.values[y][i]]; };
let parts = [], gripped = null, edition = 0;

/* Return the outermost of some points, counter-clockwise (A. M. Andrew, monotone chain). */
function hull(points) {
  const sorted = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  const chain = (list) => {
    const found = [];
    for (const p of list) {
      while (found.length > 1 && turn(found[found.length - 2], found[found.length - 1], p) <= 1e-6) found.pop();
      found.push(p);
    }
    return found.slice(0, -1);
  };
  const turn = (a, b, c) => (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  const around = [...chain(sorted), ...chain(sorted.reverse())];
  return around.length ? around : [points[0]];
}
const turned = (P, Q) => `translate(${P[0].toFixed(2)} ${P[1].toFixed(2)}) rotate(${((atan2(Q[1] - P[1], Q[0] - P[0]) * 180) / PI).toFixed(3)})`;
const apart = (P, Q) => hypot(Q[0] - P[0], Q[1] - P[1]);

function body({ points, shares, colour }) {
  const plate = (shares || points).length > 2, group = draw(sheet, "g", { opacity: plate ? 0.72 : 1 }), r = unit0;
  const own = css(`body${colour}`), edge = `color-mix(in srgb, ${own} 40%, var(--ink))`;
  const outer = draw(group, "polygon", { w: 2 * r + 2 * EDGE, join: "round", fill: edge, stroke: edge });
  const inner = draw(group, "polygon", { w: 2 * r, join: "round", fill: own, stroke: own });
  const corner = (at, row) => [0, 1].map((axis) => row.reduce((sum, share, k) => sum + share * at[points[k]][axis], 0));
  return (at) => {
    const around = shares ? shares.map((row) => corner(at, row)) : points.map((i) => at[i]), text = pairs(plate && !shares ? hull(around) : around);
    set(outer, { points: text }); set(inner, { points: text });
  };
}
/* Short lines on the right of a line, those in sight of one that stands fixed. */
function hatches(line, fixed) {
  const found = [], size = 0.9 * unit0;
  for (let i = 1; i < line.length; i++) {
    const [a, b] = [line[i - 1], line[i]], long = apart(a, b), d = [(b[0] - a[0]) / long, (b[1] - a[1]) / long];
    const from = fixed && long > 4e3 ? max(0, -left0 - a[0]) : 0, to = fixed ? min(long, from + 4e3) : long;
    for (let s = from; s < to - size; s += 1.6 * size) found.push([a[0] + (s + size) * d[0], a[1] + (s + size) * d[1]], [a[0] + s * d[0] - size * d[1], a[1] + s * d[1] + size * d[0]], null);
  }
  return found;
}
/* What some points carry, or nothing does: lines, each place a way along and across, and a share of the length where it stretches. */
function linework({ on: [P, Q], lines, hatched }, ink = "ink", thin = 0.8) {
  const group = draw(sheet, "g", { stroke: css(ink), join: "round", cap: "round" }), flip = (rows) => rows.map(([x, y]) => [x * zoom, -y * zoom]);
  const drawn = lines.map(({ rows, fill, closed, bold }) => {
    const line = draw(group, closed ? "polygon" : "polyline", { fill: fill ? css(fill) : "none", w: (bold ? 1.5 : thin) * EDGE });
    const put = (length) => set(line, { points: pairs(rows.map(([along, across, share = 0]) => [share * length + along * zoom, -across * zoom])) });
    put(0);
    return rows[0].length > 2 && put;
  }).filter(Boolean);
  if (hatched) draw(group, "path", { w: 0.7, fill: "none", d: broken(lines.flatMap(({ rows, closed }) => hatches(flip(closed ? [...rows, rows[0]] : rows), P === undefined))) });
  return (at) => {
    const [x, y] = P === undefined ? px(0, 0) : at[P], beyond = Q === undefined ? [x + 1, y] : at[Q];
    for (const put of drawn) put(apart([x, y], beyond));
    set(group, { transform: turned([x, y], beyond) });
  };
}
/* The greatest and least distance of two points over the stroke [px]. */
function span(P, Q) {
  let low = Infinity, high = 0;
  for (const found of [now, base]) for (const i of found.reached) {
    const length = zoom * apart(spot(found, P, i), spot(found, Q, i));
    low = min(low, length); high = max(high, length);
  }
  return [low, high];
}
function ram({ P, Q, aside, pressure, most }) {
  const group = draw(sheet, "g", { w: 0.8 * EDGE, join: "round", stroke: css("ink") }), off = aside * unit0;
  const parts = ["eye", "barrel", "rod", "piston", "cap"].map((name) => draw(group, "rect", { fill: css(name === "barrel" || name === "rod" ? name : "piston") }));
  const [eye, barrel, shaft, piston, cap] = parts, put = (rect, from, to) => set(rect, { x: from, width: max(to - from, 0) });
  let low, high, u, least, mouth, seen;
  return (at) => {
    if (seen !== edition) {
      seen = edition; [low, high] = span(P, Q); u = min(unit0, 0.12 * low); least = 2 * u;
      mouth = min(max(least + high - low + 1.5 * u, 0.68 * low), max(0.68 * low, low - 1.2 * u));
      [0.62, 1.3, 0.42, 1.12, 1.5].forEach((half, i) => set(parts[i], { y: -off - half * u, height: 2 * half * u }));
      put(eye, 0, 1.4 * u); put(barrel, 1.4 * u, mouth); put(cap, mouth - 0.35 * u, mouth + 0.35 * u);
    }
    const length = apart(at[P], at[Q]), place = min(max(length - low + least, least), mouth - 0.9 * u);
    put(shaft, place, max(length, place)); put(piston, place - 0.45 * u, place + 0.45 * u);
    if (pressure !== undefined) set(barrel, { fill: heat(pose.values[pressure][0], pose.values[most] ? pose.values[most][0] : scale.most) });
    set(group, { transform: turned(at[P], at[Q]) });
  };
}
/* Where a track's ends stand: as far as its riders travel over the stroke, and a margin. */
function track(each) {
  let low, high, seen;
  return () => {
    if (seen !== edition) {
      seen = edition; low = Infinity; high = -Infinity;
      for (const found of [now, base]) for (const i of found.reached) {
        const [o, d] = lineOf(each, found, i);
        for (const rider of each.riders) { const p = spot(found, rider, i), s = (p[0] - o[0]) * d[0] + (p[1] - o[1]) * d[1]; low = min(low, s); high = max(high, s); }
      }
      if (!(low <= high)) low = high = 0;
    }
    const pad = (3.2 * unit0) / zoom, [o, d] = lineOf(each, pose, 0);
    return [low - pad, high + pad].map((s) => px(o[0] + s * d[0], o[1] + s * d[1]));
  };
}
function lineOf(each, found, i) { const [a, b, c, d] = each.line.map((row) => found.values[row][i]); return [[a, b], [c, d]]; }
function slot(each) {
  const outer = draw(sheet, "line", { cap: "round", w: 1.4 * unit0 + EDGE }), ends = track(each);
  const inner = draw(sheet, "line", { cap: "round", w: 1.4 * unit0 - EDGE });
  set(outer, { stroke: css("ink") }); set(inner, { stroke: css("paper") });
  return () => { const [a, b] = ends(); for (const line of [outer, inner]) set(line, { x1: a[0], y1: a[1], x2: b[0], y2: b[1] }); };
}
/* A fixed rail: its line under the blocks and its hatches, below the track, above where a pin stands on it. */
function rail(each) {
  const path = draw(sheet, "path", { class: "line", w: 1 }), heavy = draw(sheet, "path", { class: "line", w: 1.8 }), ends = track(each);
  for (const each of [path, heavy]) set(each, { stroke: css("ink") });
  return (at) => {
    const [a, b] = ends(), long = apart(a, b), u = unit0, d = [(b[0] - a[0]) / long, (b[1] - a[1]) / long];
    let n = [-d[1], d[0]];
    if (n[1] < -1e-6 || (abs(n[1]) <= 1e-6 && n[0] < 0)) n = [-n[0], -n[1]];
    const crowded = scene.grounds.some(({ point }) => {
      const s = (at[point][0] - a[0]) * d[0] + (at[point][1] - a[1]) * d[1], h = (at[point][0] - a[0]) * n[0] + (at[point][1] - a[1]) * n[1];
      return s > -2 * u && s < long + 2 * u && h > -u && h < 4 * u;
    });
    if (crowded) n = [-n[0], -n[1]];
    const from = [a[0] + 1.25 * u * n[0], a[1] + 1.25 * u * n[1]], hatch = 0.9 * u, on = (s, h) => [from[0] + s * d[0] + h * n[0], from[1] + s * d[1] + h * n[1]];
    const lines = [];
    for (let s = 0; s < long - hatch; s += 1.1 * hatch) lines.push(on(s + hatch, 0), on(s, hatch), null);
    set(path, { d: broken(lines) }); set(heavy, { d: broken([on(0, 0), on(long, 0)]) });
  };
}
function block(each, rider) {
  const long = 2.1 * unit0, wide = (each.fixed ? 1.25 : 0.7) * unit0;
  const rect = draw(sheet, "rect", { x: -long, y: -wide, width: 2 * long, height: 2 * wide, w: EDGE, fill: css("rule"), stroke: css("ink") });
  return (at) => { const [, d] = lineOf(each, pose, 0); set(rect, { transform: turned(at[rider], [at[rider][0] + d[0], at[rider][1] - d[1]]) }); };
}
function circle(index, radius, fill, stroke, width) {
  const element = draw(sheet, "circle", { r: radius, w: width, fill: css(fill), stroke: css(stroke) });
  return (at) => set(element, { cx: at[index][0], cy: at[index][1] });
}
function stay([P, X]) {
  const line = draw(sheet, "line", { w: EDGE, dash: "7 4", stroke: css("muted") });
  return (at) => set(line, { x1: at[P][0], y1: at[P][1], x2: at[X][0], y2: at[X][1] });
}
function ground({ point, way }) {
  const u = unit0, group = draw(sheet, "g", { w: EDGE, join: "round" }), lines = [[3.2 * u, -2.66 * u], [3.2 * u, 2.66 * u], null];
  for (let i = 0; i < 6; i++) { const v = -2.66 + (i * 4.42) / 5; lines.push([3.2 * u, (v + 0.9) * u], [4.1 * u, v * u], null); }
  set(group, { fill: css("rod"), stroke: css("ink") });
  draw(group, "polygon", { points: pairs([[0, 0], [3.2 * u, 1.9 * u], [3.2 * u, -1.9 * u]]) });
  draw(group, "path", { d: broken(lines), w: 1 });
  return (at) => set(group, { transform: `translate(${at[point][0]} ${at[point][1]}) rotate(${(-way * 180) / PI})` });
}
/* A ground pin that can be dragged: its two coordinates are dimensions. */
function grip({ point, x, y }) {
  const element = draw(sheet, "circle", { r: max(22, 2 * unit0), class: "grip" }), name = scene.names[point];
  draw(element, "title", {}).textContent = say("Drag {name}", { name });
  element.dataset.pin = name;
  on(element, "pointerdown", (event) => {
    event.preventDefault();
    const box = sheet.getBoundingClientRect(), start = [event.clientX - box.left, event.clientY - box.top];
    gripped = { id: event.pointerId, x, y, name, from: [present[x], present[y]], start };
    sheet.setPointerCapture(event.pointerId);
  });
  return (at) => set(element, { cx: at[point][0], cy: at[point][1] });
}
on(sheet, "pointermove", (event) => {
  if (!gripped || event.pointerId !== gripped.id) return;
  const box = sheet.getBoundingClientRect(), snap = (value) => round(value * 1e3) / 1e3;
  gripped.to = [gripped.from[0] + (event.clientX - box.left - gripped.start[0]) / zoom, gripped.from[1] - (event.clientY - box.top - gripped.start[1]) / zoom].map(snap);
  soon("drag");
});
function dragged() {
  const design = [...present];
  [design[gripped.x], design[gripped.y]] = gripped.to;
  gripped.to = null;
  if (moved(design, stands, gripped.name)) warn("");
  byId("message").textContent ||= "";
}
for (const end of ["pointerup", "pointercancel"]) on(sheet, end, (event) => {
  if (!gripped || event.pointerId !== gripped.id) return;
  if (gripped.to) dragged();
  const { x, y } = gripped;
  gripped = null;
  for (const i of [x, y]) if (!chosen.includes(i)) { chosen.push(i); }
  listSizes(); soon("fit"); remember();
});
function name(index) {
  const text = draw(sheet, "text", { class: "name-of" }), [dx, dy] = scene.labels[index];
  text.textContent = scene.names[index];
  return (at) => set(text, { x: min(max(at[index][0] + dx, 8), sheetWide - 8), y: min(max(at[index][1] + dy, 10), sheetTall - 10) });
}
/* An arrow: a force at a point, in the scale in which the greatest is a sixth of the sheet. */
function arrow({ point, x, y, load }) {
  const line = draw(sheet, "path", { w: 2.2, join: "round", fill: css(load ? "accent" : "other"), stroke: css(load ? "accent" : "other") });
  return (at) => {
    const k = pull.scale, f = [pose.values[x][0] * k, -pose.values[y][0] * k], long = hypot(...f), head = min(9, 0.5 * long);
    if (!showsForces || !(long > 1)) { set(line, { d: "" }); return; }
    const d = [f[0] / long, f[1] / long], tip = [at[point][0] + f[0], at[point][1] + f[1]], neck = [tip[0] - head * d[0], tip[1] - head * d[1]], w = 0.38 * head;
    set(line, { d: broken([at[point], neck, [neck[0] - w * d[1], neck[1] + w * d[0]], tip, [neck[0] + w * d[1], neck[1] - w * d[0]], neck]) });
  };
}
const pull = { scale: 0, most: 0 };
function pullScale() {
  pull.most = 0;
  for (const { x, y } of data.arrows) for (const i of now.reached) pull.most = max(pull.most, hypot(now.values[x][i], now.values[y][i]) || 0);
  pull.scale = pull.most ? min(sheetWide, sheetTall) / 4.5 / pull.most : 0;
}
const scale = { most: 0 };
/* The colour of a barrel at a pressure: from the barrel's own through amber to red. */
function heat(value, most) {
  const share = min(max(value / most, 0), 1) || 0, mix = (a, b, t) => `color-mix(in oklab, ${css(b)} ${(100 * t).toFixed(1)}%, ${css(a)})`;
  return share < 0.5 ? mix("barrel", "warm", 2 * share) : mix("warm", "hot", 2 * share - 1);
}
function pressureScale() {
  scale.most = 0;
  for (const each of data.cylinders) if (each.pressure !== undefined) for (const found of [now, base]) for (const i of found.reached) {
    scale.most = max(scale.most, (each.most !== undefined && found.values[each.most][i]) || found.values[each.pressure][i] || 0);
  }
}
let keys, told0 = "";
function legend() {
  const bottom = sheetTall - 12, told = [scale.most, showsForces && pull.most, sheetWide, bottom, language].join(), group = keys;
  if (told === told0 && group.firstChild) return;
  told0 = told;
  group.replaceChildren();
  if (scale.most > 0) {
    const bar = min(110, 0.3 * sheetWide);
    for (let i = 0; i < 22; i++) draw(group, "rect", { x: 12 + (i * bar) / 22, y: bottom - 8, width: bar / 22 + 0.5, height: 9, fill: heat((i + 0.5) / 22, 1) });
    const unit = data.pressureUnit, top = short(scale.most / unit.factor, 3);
    draw(group, "text", { x: 12, y: bottom - 13, class: "halo" }).textContent = "0";
    draw(group, "text", { x: 12 + bar, y: bottom - 13, class: "halo", anchor: "end" }).textContent = top + unitText(unit.unit);
  }
  if (showsForces && pull.most) {
    const text = say("longest arrow {force}", { force: shown(pull.most, data.force, 3) });
    draw(group, "text", { x: sheetWide - 12, y: bottom, class: "halo", anchor: "end" }).textContent = text;
  }
}

/* Choose the scale so that the delivered and the present design have room over the whole stroke. */
function fit(grow) {
  const box = sheet.getBoundingClientRect();
  sheetWide = box.width || 600; sheetTall = box.height || 400;
  const under = showsForces || data.cylinders.some((each) => each.pressure !== undefined) ? 24 : 0;
  let [left, right, bottom, top] = grow && before ? before : scene.box;
  for (const found of [base, now]) for (const i of found.reached) for (let p = 0; p < scene.names.length; p++) {
    const [x, y] = spot(found, p, i);
    left = min(left, x); right = max(right, x); bottom = min(bottom, y); top = max(top, y);
  }
  before = [left, right, bottom, top];
  const wide = right - left || 1e-3, high = top - bottom || 1e-3, pad = min(46, 0.11 * min(sheetWide, sheetTall));
  for (let turn = 0, margin = pad; turn < 2; turn++) {
    zoom = min((sheetWide - 2 * margin) / wide, (sheetTall - under - 2 * margin) / high);
    unit0 = max(scene.size * zoom, 3.4);
    margin = max(pad, 4.4 * unit0);
  }
  left0 = 0.5 * sheetWide - 0.5 * (left + right) * zoom;
  top0 = 0.5 * (sheetTall - under) + 0.5 * (bottom + top) * zoom;
}
/* Draw everything anew: after a change of the design or of the sheet. */
function build() {
  sheet.replaceChildren();
  set(sheet, { viewBox: `0 0 ${sheetWide} ${sheetTall}` });
  const ghost = draw(sheet, "path", { class: "line", w: 2, dash: "2 5", stroke: css("muted") });
  const still = [...scene.around.map((each) => linework(each, "muted", 0.9)), ghostly(ghost), ...scene.grounds.map(ground), ...scene.tracks.filter((each) => each.fixed).map(rail)];
  const paths = data.paths.map((point) => {
    const line = draw(sheet, "path", { class: "line", w: 2.2, dash: "0.1 4.6", stroke: css("accent") });
    let seen;
    return () => { if (seen !== edition) { seen = edition; set(line, { d: broken([...now.along.keys()].map((i) => (now.reason[i] ? null : px(...spot(now, point, i))))) }); } };
  });
  const isPlate = (each) => (each.shares || each.points).length > 2, plates = scene.bodies.filter(isPlate), bars = scene.bodies.filter((each) => !isPlate(each));
  const loads = (pinned) => scene.loads.filter((each) => scene.pins.includes(each.on[0]) === pinned).map((each) => linework(each, "ink", 0.9));
  const blocks = (fixed) => scene.tracks.filter((each) => each.fixed === fixed).flatMap((each) => each.riders.map((rider) => block(each, rider)));
  parts = [
    ...still, ...paths, ...scene.contours.map((each) => linework(each)), ...plates.map(body), ...blocks(true), ...bars.map(body),
    ...scene.tracks.filter((each) => !each.fixed).map(slot), ...blocks(false), ...scene.stays.map(stay), ...data.cylinders.filter((each) => each.drawn).map(ram), ...scene.straights.map((each) => linework(each)), ...loads(true),
    ...scene.pins.map((i) => circle(i, 0.5 * unit0, "paper", "ink", 1.3 * EDGE)), ...scene.dots.map((i) => circle(i, 0.48 * unit0, "ink", "paper", 1)), ...loads(false),
    ...data.arrows.map(arrow), ...scene.names.map((_, i) => name(i)), ...data.grips.map(grip),
  ];
  keys = draw(sheet, "g", {});
}
/* The delivered design at the same stroke, as a faint outline, where the design has changed. */
function ghostly(path) {
  return () => {
    if (!isChanged()) { set(path, { d: "" }); return; }
    const found = single(original, stands), lines = [];
    if (found.reason[0] === 0) for (const { points } of [...scene.bodies, ...data.cylinders.map(({ P, Q }) => ({ points: [P, Q] }))]) {
      const around = points.map((p) => px(...spot(found, p, 0))), ring = around.length > 2 ? hull(around) : around;
      lines.push(...ring, ...(ring.length > 2 ? [ring[0]] : []), null);
    }
    set(path, { d: broken(lines) });
  };
}

/* ---- the curve ---- */

const plot = byId("curve");
let chart = null;
function ticks(low, high, count, turning) {
  const rough = (high - low) / count, power = 10 ** floor(log10(rough));
  const step = (turning ? [15, 30, 45, 60, 90, 180, 360] : [1, 2, 2.5, 5, 10].map((each) => each * power)).find((each) => each >= rough) || 720;
  const found = [];
  for (let i = ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; i++) found.push(i * step);
  const decimals = min(max(0, -floor(log10(step) + 1e-9) + (/^2\.?5/.test((step / power).toString()) ? 1 : 0)), 9);
  return found.map((value) => [value, fixed(value, decimals)]);
}
const finite = (values) => Array.from(values || []).filter(isNumber);
/* Return a column's values in its unit, rounding noise as zero. */
function inUnit(each, found) {
  const values = series(each, found);
  if (!values) return null;
  const most = max(...finite(values).map(abs), 0), noise = max(1e-9 * most, 1e-9 * each.factor);
  return Array.from(values, (value) => (value === null || !isNumber(value) ? NaN : abs(value) < noise ? 0 : value / each.factor));
}
function range(lists, limit) {
  const all = lists.flatMap((list) => finite(list));
  let low = min(...all), high = max(...all);
  if (!all.length) [low, high] = [0, 1];
  let air = 0.09 * (high - low);
  if (air <= 1e-9 * max(abs(low), abs(high))) air = 0.1 * max(abs(low), abs(high)) || 1;
  low -= air; high += air;
  if (limit) { const more = 0.13 * (high - low); low = min(low, limit[0] - more); high = max(high, limit[0] + more); }
  return [low, high];
}
function plotted() {
  const box = plot.getBoundingClientRect(), W = box.width || 400, H = box.height || 200, one = columns[column], two = columns[second];
  plot.replaceChildren();
  set(plot, { viewBox: `0 0 ${W} ${H}` });
  const stroke = strokes[runs], given = one && data.limits[one.name], limit = given ? [given[0] / one.factor, limitText(given), given[2]] : null;
  const values = inUnit(one, now), others = two ? inUnit(two, now) : null, was = isChanged() || isMoved() ? inUnit(one, base) : null;
  const same = two && two.unit === one.unit, T = 10, B = 40;
  const [low, high] = range([values, isMoved() ? null : was, same ? others : null], limit), [low2, high2] = same ? [low, high] : range([others]);
  const left = ticks(low, high, H < 180 ? 4 : 6), right = two && !same ? ticks(low2, high2, H < 180 ? 4 : 6) : [];
  const L = 14 + 7.2 * max(...left.map((each) => each[1].length), 2), R = right.length ? 14 + 7.2 * max(...right.map((each) => each[1].length)) : 12;
  const along = Array.from(now.along, (value) => value / stroke.factor), least = min(...along), most = max(...along);
  const x = (s) => L + ((s - least) / (most - least || 1)) * (W - L - R), y = (v) => H - B - ((v - low) / (high - low || 1)) * (H - T - B), y2 = (v) => H - B - ((v - low2) / (high2 - low2 || 1)) * (H - T - B);
  const write = (a, b, text, more) => { draw(plot, "text", { x: a, y: b, ...more }).textContent = text; };
  const line = (list, up, colour, width, more) => {
    const path = draw(plot, "path", { class: "line", w: width, d: broken(list.map((v, i) => (isNumber(v) ? [x(along[i]), up(v)] : null))), ...more, stroke: css(colour) });
    return path;
  };
  const rule = (x1, y1, x2, y2, colour, more) => draw(plot, "line", { x1, y1, x2, y2, stroke: css(colour), ...more });
  if (limit) {
    const at = y(limit[0]), above = limit[2] !== "below", shade = draw(plot, "rect", { x: L, width: W - L - R, y: above ? T : at, height: max(above ? at - T : H - B - at, 0), opacity: 0.13 });
    set(shade, { fill: css("accent") });
  }
  for (const [v, text] of left) { rule(L, y(v), W - R, y(v), "grid"); write(L - 6, y(v) + 4, text, { anchor: "end" }); }
  for (const [v, text] of right) write(W - R + 6, y2(v) + 4, text, {});
  for (const [s, text] of ticks(least, most, max(3, floor((W - L - R) / 62)), stroke.unit === "deg" && most - least >= 90)) {
    rule(x(s), T, x(s), H - B, "grid"); write(x(s), H - B + 15, text, { anchor: x(s) > W - R - 10 ? "end" : "middle" });
  }
  rule(L, T, L, H - B, "rule"); rule(L, H - B, W - R, H - B, "rule");
  const compares = was && !isMoved();
  write(compares ? L : 0.5 * (L + W - R), H - 6, `${stroke.name}, ${signed(stroke.unit)}`, { anchor: compares ? "start" : "middle" });
  if (compares) line(was, y, "muted", 2, { dash: "3 4" });
  if (others) line(others, same ? y : y2, "other", 2.2, {});
  chart = { one, two, values, others, along, x, y, y2: same ? y : y2 };
  if (values) {
    line(values, y, "curve", 2.6, {});
    if (limit) {
      const fails = (v) => (limit[2] === "below" ? v < limit[0] : v > limit[0]);
      line(values.map((v) => (fails(v) ? v : NaN)), y, "accent", 3.2, {});
      for (let i = 1; i < values.length; i++) {
        const a = values[i - 1] - limit[0], b = values[i] - limit[0];
        if (a * b < 0) { const dot = draw(plot, "circle", { r: 4, cx: x(along[i - 1] - (a * (along[i] - along[i - 1])) / (b - a)), cy: y(limit[0]) }); set(dot, { fill: css("accent") }); }
      }
    }
  }
  if (limit) {
    const at = y(limit[0]), late = values && abs(values[values.length - 1] - limit[0]) >= abs(values[0] - limit[0]);
    rule(L, at, W - R, at, "accent", { dash: "7 4", w: 1.5 });
    write(late ? W - R - 5 : L + 5, at + (limit[2] === "below" ? 15 : -6), limit[1], { class: "note halo", anchor: late ? "end" : "start" });
  }
  const reason = one && one.row === undefined && one.why ? one.why : "";
  if (!values && one) write(L + 8, T + 18, say("as delivered only: this column is not followed in the page"), { class: "note halo" });
  byId("column").title = reason;
  if (compares) write(W - R, H - 6, say("dashed: as delivered"), { anchor: "end" });
  chart.second = draw(plot, "circle", { r: 4.5, w: 2, fill: css("other"), stroke: css("paper") });
  chart.marker = draw(plot, "circle", { r: 6, w: 2, fill: css("curve"), stroke: css("paper") });
}
/* Return a list's value at the present stroke, between two poses; NaN where there is none. */
function between(list) {
  const { start, end } = strokes[runs], where = min(max(((stands[runs] - start) / (end - start)) * (COUNT - 1), 0), COUNT - 1);
  const i = min(floor(where), COUNT - 2), t = where - i;
  return !list ? NaN : t === 0 ? list[i] : list[i] + (list[i + 1] - list[i]) * t;
}
function mark(each, list, up, dot, out) {
  const value = between(list), there = isNumber(value);
  set(dot, { visibility: there ? "visible" : "hidden" });
  if (there) set(dot, { cx: chart.x(stands[runs] / strokes[runs].factor), cy: up(value) });
  byId(out).textContent = each ? (there ? fixed(value, places(max(...finite(list).map(abs), 0), 4)) + unitText(each.unit) : "\u2013") : "";
}

/* ---- verdicts ---- */

const strokeText = (value) => { const stroke = strokes[runs]; return `${stroke.name} = ${shown(value, stroke, 4)}`; };
const mm = (value) => fixed(value / data.length.factor, data.length.factor > 0.01 ? 2 : 1) + unitText(data.length.unit);
/* Return the least and the greatest of some values with their strokes, a parabola laid through the poses next to them. */
function extremes(values) {
  let low = -1, high = -1;
  for (const i of now.reached) if (isNumber(values[i])) { if (low < 0 || values[i] < values[low]) low = i; if (high < 0 || values[i] > values[high]) high = i; }
  if (low < 0) return null;
  const peak = (i) => {
    const a = values[i - 1], b = values[i], c = values[i + 1], bend = a - 2 * b + c;
    if (!isNumber(a) || !isNumber(c) || !bend) return { value: b, at: now.along[i] };
    const t = (0.5 * (a - c)) / bend;
    return abs(t) > 1 ? { value: b, at: now.along[i] } : { value: b - 0.25 * (a - c) * t, at: now.along[i] + t * (now.along[1] - now.along[0]) };
  };
  return { low: peak(low), high: peak(high) };
}
/* The questions of the verdicts, asked of the present design over all that the machine runs: coarsely while it changes, finer when it is still. */
const asking = judging(engine, data.judge), DRAGGING = 9, STILL = 17;
let known = { key: "" };
function asked(n) {
  const design = vector(present), key = `${n} ${design.join()}`;
  if (known.key !== key) known = { key, ...asking.ask(design, n, n === STILL) };
  return known;
}
const placeText = (at) => strokes.map((each, k) => `${each.name} = ${shown(at[k], each, 4)}`).join(", ");
function situationText(each) {
  const words = [];
  if (each.direction) {
    const direction = each.direction === "extending" ? say("extending") : each.direction === "retracting" ? say("retracting") : say("at rest");
    words.push(each.drive ? say("{direction} {drive}", { direction, drive: each.drive }) : direction);
  }
  if (each.side) words.push(each.side === "piston" ? say("on the piston side") : say("on the rod side"));
  if (each.case) words.push(say("in the case {case}", { case: each.case }));
  if (each.name) words.push(say("over {over}", { over: each.name }));
  if (each.strokes) words.push(say("at {place}", { place: placeText(each.strokes) }));
  return words.join(", ");
}
function answerText({ rule, unit }, each) {
  if (each.unknown) return say("as delivered: with these sizes the page does not follow it");
  if (each.ok === null) return say("says nothing: no place is left to judge");
  if (!(abs(each.value) >= 0) || (each.kept === false && each.margin >= 0)) return say("it has no value at places that were looked at");
  const size = (value) => (isNumber(value) ? shown(value, unit, 4) : say("without bounds")), words = { value: size(each.value), place: situationText(each), limit: size(each.limit) };
  const text = each.symbol === "<=" ? say("greatest {value}, {place}; not above {limit}", words) : say("least {value}, {place}; not below {limit}", words);
  return data.limits[rule] ? `${text} (${limitText(data.limits[rule])})` : text;
}
function verdicts(n = STILL) {
  const found = [], add = (ok, rule, text, more) => found.push({ ok, rule, text, ...more }), all = now.reached.length === COUNT, stroke = strokes[runs];
  const from = shown(now.along[0], stroke, 4), to = shown(now.along[COUNT - 1], stroke, 4), answers = asked(n);
  const gone = answers.lost.filter((each) => each.share && !each.allowed), deepest = gone.reduce((a, b) => (b.share > a.share ? b : a), gone[0]);
  if (!all) {
    const lost = [...now.along.keys()].filter((i) => now.reason[i]), worst = lost.reduce((a, b) => (now.missing[b] > (now.missing[a] || 0) ? b : a), lost[0]);
    const spans = stretches(lost).map(([a, b]) => say("{from} to {to}", { from: shown(now.along[a], stroke, 4), to: shown(now.along[b], stroke, 4) })).join(", ");
    add(false, say("assembly"), why(now, worst, say("not assembled at {stroke} = {spans}", { stroke: stroke.name, spans })));
    for (const text of ends(lost)) add(null, say("dead point"), text);
  } else if (deepest) {
    const what = say("{share} of the places looked at are lost, deepest at {place}", { share: `${fixed(100 * deepest.share, 1)}\u2009%`, place: placeText(deepest.strokes) });
    add(false, say("assembly"), why({ reason: [deepest.reason], missing: [deepest.missing] }, 0, what));
  } else add(true, say("assembly"), say("assembled over the whole stroke, {stroke} from {from} to {to}", { stroke: stroke.name, from, to }));
  const far = all ? beyond() : null;
  if (far) add(null, say("dead point"), say("the nearest is of {step} at {where}, {away} beyond the stroke", far));
  let tight = null;
  for (const { point, row } of data.joints) { const ext = extremes(now.values[row]); if (ext && (!tight || ext.low.value < tight.value)) tight = { ...ext.low, point }; }
  if (tight) add(null, say("transmission"), say("least angle {angle}, of {joint} at {where}", { joint: tight.point, angle: `${fixed((tight.value * 180) / PI, 1)}\u00b0`, where: strokeText(tight.at) }));
  const questions = data.judge.questions, named = ({ rule, ru }) => (language === "ru" && ru) || rule;
  for (const [q, question] of questions.entries()) {
    const each = answers.found[q];
    add(gone.length && each.ok === false ? each.kept : each.ok, named(question), answerText(question, each), { open: each.ok === null });
  }
  for (const each of data.cylinders) cylinder(each, add);
  if (isChanged()) {
    const live = new Set([...questions.map(({ rule }) => rule), "assembly", "dead points"]);
    for (const [state, rule, , ruled] of data.verdicts) if (state !== 2 && !live.has(rule)) add(null, (language === "ru" && ruled) || rule, say("as delivered: the page does not follow it"), { open: true });
  }
  add(null, "", say("looked at {n} values a stroke, {count} poses", { n: answers.n, count: answers.count }));
  return found;
}
/* Return the nearest place beyond the ends of the running stroke at which the motion ends: of which step, where, how far away; null for none within a stroke's length. */
function beyond() {
  const { start, end } = strokes[runs], size = abs(end - start), reached = (value) => single(present, stands.map((each, k) => (k === runs ? value : each)));
  let best = null;
  for (const [from, sign] of [[min(start, end), -1], [max(start, end), 1]]) {
    let good = 0, bad = 0;
    for (let i = 1; i <= 16 && !bad; i++) { const away = (size * i) / 16; if (reached(from + sign * away).reason[0] === 0) good = away; else bad = away; }
    if (!bad || (best && good > best.away)) continue;
    for (let i = 0; i < 30; i++) { const middle = 0.5 * (good + bad); if (reached(from + sign * middle).reason[0] === 0) good = middle; else bad = middle; }
    const last = reached(from + sign * bad), k = last.reason[0], step = k > 0 ? engine.steps[k - 1] : "";
    if (!best || good < best.away) best = { away: good, at: from + sign * good, step };
  }
  return best && { step: data.steps[best.step] || best.step, where: strokeText(best.at), away: shown(best.away, strokes[runs], 3) };
}
function stretches(list) {
  const found = [];
  for (const i of list) { const last = found[found.length - 1]; if (last && last[1] === i - 1) last[1] = i; else found.push([i, i]); }
  return found;
}
/* Return where the reach ends within the stroke, by bisection between the poses. */
function ends(lost) {
  const said = [];
  for (const [a, b] of stretches(lost)) for (const [inside, outside] of [[a - 1, a], [b + 1, b]]) {
    if (inside < 0 || inside >= COUNT || said.length > 3) continue;
    let good = now.along[inside], bad = now.along[outside];
    for (let i = 0; i < 20; i++) { const middle = 0.5 * (good + bad), at = [...stands]; at[runs] = middle; if (single(present, at).reason[0] === 0) good = middle; else bad = middle; }
    const k = now.reason[outside], step = k > 0 ? engine.steps[k - 1] : "";
    said.push(say("of {step} at {where}, where the reach ends", { step: data.steps[step] || step, where: strokeText(good) }));
  }
  return said;
}
const limitText = ([, text, , ru]) => (language === "ru" && ru) || text;
function cylinder(each, add) {
  const lengths = new Float64Array(COUNT).fill(NaN);
  for (const i of now.reached) lengths[i] = apart(spot(now, each.P, i), spot(now, each.Q, i));
  const ext = extremes(lengths), at = (row) => (row === undefined ? NaN : pose.values[row][0]);
  if (!ext) return;
  const fits = data.judge.questions.some(({ rule }) => rule === "length" || rule === `length ${each.name}`);
  const closed = at(each.closed), stroke = at(each.stroke), words = { low: mm(ext.low.value), high: mm(ext.high.value), closed: mm(closed), open: mm(closed + stroke), stroke: mm(stroke), travel: mm(ext.high.value - ext.low.value) };
  if (fits) { /* its length is one of the questions */ } else if (closed > 0) {
    const inside = closed - ext.low.value, outside = ext.high.value - closed - stroke, faults = [];
    if (inside > 1e-6) faults.push(say("{gap} too long closed", { gap: mm(inside) }));
    if (outside > 1e-6) faults.push(say("{gap} missing open", { gap: mm(outside) }));
    const text = stroke > 0 ? say("pins {low} to {high} apart; the cylinder is {closed} closed, {open} open", words) : say("pins {low} to {high} apart; the cylinder is {closed} closed", words);
    add(!faults.length, each.name, [text, ...faults].join("; "));
  } else if (stroke > 0) {
    const gap = ext.high.value - ext.low.value - stroke;
    add(gap <= 1e-6, each.name, [say("travels {travel}, its stroke is {stroke}", words), ...(gap > 1e-6 ? [say("{gap} missing", { gap: mm(gap) })] : [])].join("; "));
  } else if (ext.high.value - ext.low.value > 1e-6) add(null, each.name, say("pins {low} to {high} apart", words));
  if (each.beside && ext.high.value - ext.low.value > 1e-6) {
    const slopes = now.reached.slice(1).map((i) => lengths[i] - lengths[i - 1]), k = slopes.findIndex((slope, i) => i && slope * slopes[i - 1] < 0);
    if (k > 0) add(null, each.name, say("its length stands still at about {where}, where its thrust moves nothing", { where: strokeText(now.along[now.reached[k]]) }));
  }
  const pressed = each.pressure === undefined ? null : extremes(now.values[each.pressure]);
  const asked = base.values[each.pressure] || [];
  if (pressed && each.most === undefined) add(null, each.name, say("needs up to {pressure} at {where}", { pressure: shown(pressed.high.value, data.pressureUnit, 4), where: strokeText(pressed.high.at) }));
  else if (!pressed && now.reached.length && [...asked].some(isNumber)) add(false, each.name, say("has no pressure with these sizes; is the rod thinner than the bore?"));
}
let toldBefore = "";
function judge(n = STILL) {
  const found = verdicts(n), key = JSON.stringify([language, found]);
  byId("delivered").className = `${data.verdicts.length ? "" : "none"}${isChanged() ? " stale" : ""}`;
  if (key === toldBefore) return;
  toldBefore = key;
  list(byId("live"), found);
  count(found);
}
/* The badge: of the delivered design all delivered verdicts, of a changed one the live ones and how many are as delivered. */
function count(found) {
  const states = data.verdicts.filter(([state]) => state !== 2), changed = isChanged(), badge = byId("badge");
  const named = (state, rule, ruled) => (language === "ru" && ruled) || rule, live = found.filter((each) => each.ok === false).map((each) => each.rule);
  const told = changed ? [] : states.filter(([state]) => state === 0).map(([state, rule, , ruled]) => named(state, rule, ruled));
  const fails = [...new Set([...told, ...live])], open = changed ? found.filter((each) => each.open).length : states.filter(([state]) => state === 3).length;
  badge.dataset.fails = fails.length; badge.dataset.open = open;
  const counts = { count: fails.length, open, ok: states.length - told.length - open, all: states.length };
  if (fails.length === 1) badge.textContent = `\u2715 ${fails[0]}: ${say("does not hold")}`;
  else if (fails.length) badge.textContent = say("{count} verdicts fail", counts);
  else if (changed) badge.textContent = open ? say("the live verdicts hold; as delivered or silent: {open}", counts) : say("all live verdicts hold");
  else badge.textContent = open ? say("{ok} of {all} verdicts hold; silent: {open}", counts) : states.length ? say("{ok} of {all} verdicts hold", counts) : say("all live verdicts hold");
}
function list(parent, found) {
  parent.replaceChildren(...found.map(({ ok, rule, text }) => {
    const item = make("li");
    if (ok === true || ok === false) item.className = ok ? "ok" : "bad";
    if (rule) { const bold = make("b"); bold.textContent = `${rule}: `; item.append(bold); }
    item.append(text);
    return item;
  }));
}

/* ---- controls ---- */

const sizeRows = new Map();
function strokeSliders() {
  byId("strokes").replaceChildren(...strokes.map((each, k) => {
    const row = make("label"), slider = make("input"), out = make("output"), label = make("span");
    row.className = "stroke"; label.textContent = each.name;
    Object.assign(slider, { type: "range", min: 0, max: 1000, step: "any" });
    slider.setAttribute("aria-label", each.name);
    slider.dataset.stroke = each.name;
    on(slider, "input", () => {
      if (k === runs) play(false);
      const at = [...stands];
      at[k] = Number(slider.value) >= 1000 ? each.end : each.start + ((each.end - each.start) * Number(slider.value)) / 1000;
      moved(present, at, each.name);
      if (k === runs) clock = phaseNow();
      soon(k === runs ? "pose" : "sweep"); remember();
    });
    row.append(label, slider, out);
    each.slider = slider; each.out = out;
    return row;
  }));
}
const nice = (each) => { const wide = (each.high - each.low) / each.factor / 400, power = 10 ** floor(log10(wide)); return [1, 2, 5, 10].map((k) => k * power).find((k) => k >= wide) * each.factor; };
const LENGTHS = { mm: 1e-3, cm: 1e-2, m: 1, in: 0.0254, ft: 0.3048 };
/* Return the value [SI] that is typed for a dimension, without a unit in its own, a length in others too; not a number for anything else. */
function typed(text, each) {
  const plain = text.trim().replace(/\u2212/g, "-").replace(/[\u202f\u2009\s](?=\d)/g, "").replace(",", ".");
  const [, number, unit] = /^([-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?)\s*(\D*)$/i.exec(plain) ?? [];
  if (!unit || unit === each.unit || unit === signed(each.unit)) return number === undefined ? NaN : Number(number) * each.factor;
  return Number(number) * ((each.unit in LENGTHS && LENGTHS[unit]) || NaN);
}
const unexpected = (each) => (each.unit ? "{name} = {text}: a number in {unit} is expected" : "{name} = {text}: a number is expected");
function listSizes() {
  const parent = byId("dimensions");
  sizeRows.clear();
  parent.replaceChildren(...chosen.map((i) => {
    const each = dims[i], row = make("div"), label = make("span"), slide = make("div"), slider = make("input");
    const mark = make("i"), box = make("input"), unit = make("span"), drop = make("button");
    row.className = "size"; label.className = "name"; slide.className = "slide"; unit.className = "unit"; drop.className = "drop";
    label.textContent = each.name; label.title = each.where || each.name;
    Object.assign(slider, { type: "range", min: 0, max: 1000, step: "any" });
    slider.setAttribute("aria-label", each.name); slider.dataset.size = each.name;
    mark.style.left = `calc(8px + (100% - 16px) * ${((each.value - each.low) / (each.high - each.low)).toFixed(4)})`;
    Object.assign(box, { type: "text", inputMode: "decimal", autocomplete: "off", spellcheck: false });
    box.setAttribute("aria-label", `${each.name}, ${each.unit}`);
    unit.textContent = signed(each.unit);
    Object.assign(drop, { type: "button", textContent: "\u00d7", title: say("Hide {name}", { name: each.name }) });
    drop.setAttribute("aria-label", drop.title);
    on(slider, "input", () => {
      const step = nice(each), raw = each.low + ((each.high - each.low) * Number(slider.value)) / 1000, value = round(raw / step) * step;
      put(i, abs(raw - each.value) < 0.006 * (each.high - each.low) ? each.value : min(max(value, each.low), each.high));
    });
    on(box, "change", () => {
      const value = typed(box.value, each), wrong = !isNumber(value) ? unexpected(each) : each.positive && !(value > 0) ? "{name} = {text}: a number above zero is expected" : "";
      if (!wrong) return put(i, value, true);
      warn(say(wrong, { name: each.name, text: box.value, unit: signed(each.unit) }));
      box.dataset.value = "";
      soon("size");
    });
    on(label, "dblclick", () => put(i, each.value));
    on(drop, "click", () => { chosen = chosen.filter((other) => other !== i); listSizes(); remember(); });
    slide.append(slider, mark); row.append(label, slide, box, unit, drop);
    sizeRows.set(i, { row, slider, box });
    return row;
  }));
  const add = byId("add"), first = make("option");
  first.value = ""; first.textContent = say("Add a dimension …");
  add.replaceChildren(first, ...dims.map((each, i) => [each, i]).filter(([, i]) => !chosen.includes(i)).map(([each, i]) => option(each.name, i)));
  showSizes();
}
function option(text, value) { const found = make("option"); found.textContent = text; found.value = value; return found; }
function put(i, value, exact) {
  const design = [...present];
  design[i] = value;
  moved(design, stands, dims[i].name);
  soon("design"); remember();
}
function showSizes() {
  for (const [i, { row, slider, box }] of sizeRows) {
    const each = dims[i], value = present[i];
    slider.value = String((1000 * (value - each.low)) / (each.high - each.low));
    slider.setAttribute("aria-valuetext", shown(value, each));
    if (document.activeElement !== box || box.dataset.value !== String(value)) { box.value = short(value / each.factor, 7); box.dataset.value = String(value); }
    row.classList.toggle("changed", value !== each.value);
  }
}
on(byId("add"), "change", (event) => { if (event.target.value !== "") { chosen.push(Number(event.target.value)); listSizes(); remember(); } });
const called = (each) => (language === "ru" && each.ru) || each.name;
const heading = (each) => (each.unit ? `${called(each)}, ${signed(each.unit)}` : called(each));
function choosers() {
  const all = columns.map((each, i) => option(heading(each) + (each.row === undefined ? " *" : ""), i));
  byId("column").replaceChildren(...all); byId("column").value = String(column);
  byId("second").replaceChildren(option("\u2013", -1), ...all.map((each) => each.cloneNode(true))); byId("second").value = String(second);
  byId("run").replaceChildren(...strokes.map((each, k) => option(each.name, k))); byId("run").value = String(runs);
  byId("runs").hidden = strokes.length < 2;
  byId("runs").style.display = strokes.length < 2 ? "none" : "";
  byId("forces").style.display = data.arrows.length ? "" : "none";
  byId("forces").setAttribute("aria-pressed", String(showsForces));
}
on(byId("column"), "change", (event) => { column = Number(event.target.value); soon("curve"); remember(); });
on(byId("second"), "change", (event) => { second = Number(event.target.value); soon("curve"); remember(); });
on(byId("run"), "change", (event) => { runs = Number(event.target.value); clock = phaseNow(); soon("design"); remember(); });
on(byId("forces"), "click", () => { showsForces = !showsForces; choosers(); soon("fit"); remember(); });
on(byId("reset"), "click", () => { present = [...original]; stands = firstStand(); runs = data.run; begin(); chosen = [...data.shown]; column = data.column; second = -1; play(false); warn(""); listSizes(); choosers(); soon("fit"); remember(); });
on(byId("copy"), "click", async () => {
  const link = `${location.href.split("#")[0]}#${told()}`;
  try { await navigator.clipboard.writeText(link); } catch {
    const area = make("textarea"); area.value = link; document.body.append(area); area.select(); document.execCommand("copy"); area.remove();
  }
  byId("copy").firstChild.textContent = say("Copied");
  setTimeout(() => { byId("copy").firstChild.textContent = say("Copy link"); }, 1500);
});
on(byId("language"), "click", () => { language = language === "ru" ? "en" : "ru"; speak(); remember(); });
on(byId("look"), "click", () => { look(root.dataset.look === "dark" ? "light" : "dark"); chosenLook = true; remember(); });
let chosenLook = false;
function look(which) { root.dataset.look = which; }
const night = window.matchMedia("(prefers-color-scheme: dark)");
on(night, "change", () => { if (!chosenLook) look(night.matches ? "dark" : "light"); });
function speak() {
  root.lang = language;
  for (const each of document.querySelectorAll("[data-say]")) each.textContent = say(each.dataset.say);
  for (const each of document.querySelectorAll("[data-tip]")) each.title = say(each.dataset.tip);
  for (const each of document.querySelectorAll("[data-name]")) each.setAttribute("aria-label", say(each.dataset.name));
  byId("look").setAttribute("aria-label", say("Light or dark"));
  byId("play").setAttribute("aria-label", playing ? say("Pause") : say("Play"));
  byId("language").textContent = language === "ru" ? "EN" : "RU";
  byId("language").lang = language === "ru" ? "en" : "ru";
  toldBefore = "";
  list(byId("told"), data.verdicts.map(([ok, rule, text, ruled, ru]) => (language === "ru" ? { ok: [false, true][ok], rule: ruled || rule, text: ru || text } : { ok: [false, true][ok], rule, text })));
  listSizes(); choosers(); soon("fit");
}

/* ---- a link that restores the state ---- */

function told() {
  const said = new URLSearchParams();
  strokes.forEach((each, k) => said.set(`s.${each.name}`, String(stands[k])));
  dims.forEach((each, i) => { if (present[i] !== each.value) said.set(`d.${each.name}`, String(present[i])); });
  if (runs !== data.run) said.set("run", strokes[runs].name);
  if (column !== data.column) said.set("column", columns[column].name);
  if (second >= 0) said.set("with", columns[second].name);
  if (String(chosen) !== String(data.shown)) said.set("show", chosen.map((i) => dims[i].name).join(" "));
  if (showsForces) said.set("forces", "1");
  if (language !== data.language) said.set("language", language);
  if (chosenLook) said.set("look", root.dataset.look);
  return said.toString();
}
let writing;
function remember() {
  clearTimeout(writing);
  writing = setTimeout(() => { if (!playing) try { history.replaceState(null, "", `#${told()}`); } catch { /* a page in a frame has no address of its own */ } }, 250);
}
function recall() {
  const said = new URLSearchParams(location.hash.slice(1)), index = (list, name) => list.findIndex((each) => each.name === name);
  const number = (text, fallback) => (text !== null && text.trim() && isNumber(Number(text)) ? Number(text) : fallback);
  if (![...said.keys()].length || location.hash === "#verdicts") return false;
  const at = strokes.map((each) => min(max(number(said.get(`s.${each.name}`), each.at), min(each.start, each.end)), max(each.start, each.end)));
  const design = dims.map((each) => { const value = number(said.get(`d.${each.name}`), each.value); return each.positive && !(value > 0) ? each.value : value; });
  runs = index(strokes, said.get("run")) < 0 ? data.run : index(strokes, said.get("run"));
  showsForces = said.get("forces") === "1";
  column = index(columns, said.get("column")) < 0 ? data.column : index(columns, said.get("column"));
  second = index(columns, said.get("with"));
  if (said.has("show")) chosen = said.get("show").split(" ").map((each) => byName.get(each)).filter((i) => i !== undefined);
  if (["en", "ru"].includes(said.get("language"))) language = said.get("language");
  if (["light", "dark"].includes(said.get("look"))) { look(said.get("look")); chosenLook = true; }
  present = [...original]; stands = firstStand();
  begin();
  moved(design, at, say("The link"));
  return true;
}
on(window, "hashchange", () => { if (location.hash !== "#verdicts" && recall()) { play(false); speak(); soon("design"); } });

/* ---- one frame at a time ---- */

const PERIOD = 5; /* seconds for there and back, or once round */
let playing = false, clock = 0, last = null, waiting = false, todo = new Set(), judgedAt = 0, later;
const timing = { frames: 0, total: 0, most: 0 };
/* The stretch of the running stroke that is played: the reached part that the present pose lies in. */
function stretch() {
  const { start, end } = strokes[runs], list = stretches(now.reached), where = ((stands[runs] - start) / (end - start)) * (COUNT - 1);
  const found = list.find(([a, b]) => where >= a - 1 && where <= b + 1) || list[0] || [0, 0];
  return [now.along[found[0]], now.along[found[1]]];
}
const isTurn = () => strokes[runs].turn && now.reached.length === COUNT;
function phaseNow() {
  const [low, high] = now ? stretch() : [0, 1], share = min(max((stands[runs] - low) / (high - low || 1), 0), 1);
  return isTurn() ? share : acos(1 - 2 * share) / (2 * PI);
}
function soon(what) { todo.add(what); if (!waiting) { waiting = true; requestAnimationFrame(frame); } }
function frame(time) {
  waiting = false;
  const began = performance.now();
  if (playing) {
    clock = (clock + ((time - (last ?? time)) / 1000 / PERIOD) * Number(byId("speed").value)) % 1;
    last = time;
    const [low, high] = stretch(), share = isTurn() ? clock : 0.5 - 0.5 * cos(2 * PI * clock), at = [...stands];
    at[runs] = low + (high - low) * share;
    if (single(present, at).reason[0] === 0) stands = at;
  }
  const work = todo;
  todo = new Set();
  if (work.has("drag") && gripped && gripped.to) { dragged(); work.add("design"); }
  render(work);
  if (playing || work.size) { const took = performance.now() - began; timing.frames++; timing.total += took; timing.most = max(timing.most, took); timing.last = took; }
  if (playing) soon("pose");
}
function render(work) {
  const anew = ["design", "sweep"].some((each) => work.has(each)), sized = work.has("fit");
  if (anew || sized || !now) now = sweep(present, stands, runs);
  if (isMoved() && (anew || sized)) base = sweep(original, stands, runs); else if (anew || sized || !base) base = first;
  pose = single(present, stands);
  if (anew || sized) { edition++; const was = [zoom, left0, top0].join(); if (!gripped) fit(!sized); pullScale(); pressureScale(); if (sized || !parts.length || was !== [zoom, left0, top0].join()) build(); legend(); }
  if (anew || sized || work.has("curve")) plotted();
  const at = scene.names.map((_, p) => px(...spot(pose, p, 0)));
  for (const part of parts) part(at);
  mark(chart.one, chart.values, chart.y, chart.marker, "value");
  mark(chart.two, chart.others, chart.y2, chart.second, "other");
  strokes.forEach((each, k) => {
    each.slider.value = String((1000 * (stands[k] - each.start)) / (each.end - each.start));
    const text = fixed(stands[k] / each.factor, places(max(abs(each.start), abs(each.end)) / each.factor, 4)) + unitText(each.unit);
    each.out.textContent = text; each.slider.setAttribute("aria-valuetext", text);
  });
  if (anew || sized || work.has("size")) showSizes();
  if (anew || sized) { clearTimeout(later); const idle = performance.now() - judgedAt; judgedAt = performance.now(); if (idle > 120 && anew && toldBefore) judge(DRAGGING); else if (!toldBefore) judge(); later = setTimeout(() => { judgedAt = performance.now(); judge(); }, 130); }
}
function play(on) {
  playing = on;
  byId("play").setAttribute("aria-pressed", String(on));
  byId("play").setAttribute("aria-label", on ? say("Pause") : say("Play"));
  set(byId("sign"), { d: on ? "M6 4h4v16H6zM14 4h4v16h-4z" : "M7 4l13 8-13 8z" });
  if (on) { last = null; if (now) clock = phaseNow(); soon("pose"); } else remember();
}
on(byId("play"), "click", () => play(!playing));
on(document, "keydown", (event) => {
  if (event.altKey || event.ctrlKey || event.metaKey || /^(INPUT|SELECT|TEXTAREA)$/.test(event.target.tagName)) return;
  const steps = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1, Home: -COUNT, End: COUNT };
  if (event.key === " " && event.target.tagName !== "BUTTON") { event.preventDefault(); play(!playing); }
  else if (event.key in steps) {
    event.preventDefault();
    const { slider } = strokes[runs];
    slider.value = String(min(max(Number(slider.value) + (1000 * steps[event.key]) / (COUNT - 1), 0), 1000));
    slider.dispatchEvent(new Event("input"));
  }
});
/* Stand at the first pose that can be had where the delivered one cannot. */
function begin() {
  if (single(present, stands).reason[0] === 0) return;
  const found = sweep(present, stands, runs);
  if (found.reached.length) stands[runs] = found.along[found.reached[0]];
}

look(night.matches ? "dark" : "light");
begin();
let first = (base = now = sweep(present, stands, runs));
strokeSliders();
const restored = recall();
speak();
frame(0);
new ResizeObserver(() => soon("fit")).observe(sheet);
new ResizeObserver(() => soon("curve")).observe(plot);
play(!restored && !window.matchMedia("(prefers-reduced-motion: reduce)").matches);

/* For tests and for pages around this one: read and set what is shown. */
window.hydrolinkage = {
  engine, data, timing,
  state: () => ({ design: Object.fromEntries(dims.map((each, i) => [each.name, present[i]])), at: Object.fromEntries(strokes.map((each, k) => [each.name, stands[k]])), playing, language, column, second, forces: showsForces }),
  set: ({ design = {}, at = {} }) => {
    const ok = moved(dims.map((each, i) => design[each.name] ?? present[i]), strokes.map((each, k) => at[each.name] ?? stands[k]), "set");
    render(new Set(["design"]));
    return ok;
  },
  points: () => Object.fromEntries(scene.names.map((each, p) => [each, spot(pose, p, 0)])),
  sweep: () => ({ along: [...now.along], values: now.values.map((each) => [...each]), reason: [...now.reason] }),
  play, verdicts,
};
})();
