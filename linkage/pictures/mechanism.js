/* What every page has: its data, words and numbers, light and dark, and the mechanism, drawn at a pose. */
const data = JSON.parse(await unpacked("data"));
const byId = (id) => document.getElementById(id);
const css = (name) => `var(--${name})`;
const { scene } = data, { abs, acos, atan2, ceil, cos, floor, hypot, log10, max, min, round, sin, PI } = Math;
const isNumber = Number.isFinite, root = document.documentElement;
const on = (element, event, act) => element.addEventListener(event, act);
const make = (kind, given) => Object.assign(document.createElement(kind), given);
const rows = data.rows;

/* ---- words and numbers ---- */

let language = data.language;
/* Return a sentence in the language chosen; where it is called it has the sentence as a literal, which is translated. */
function say(text, given) {
  const said = data.words[language][text];
  return given ? said.replace(/\{(\w+)\}/g, (_, name) => given[name]) : said;
}
const minus = (text) => (/^-[0.]*$/.test(text) ? text.slice(1) : text).replace("-", "\u2212");
/* Return a number with its digits grouped, never in powers of ten; halves go to the even digit, as in Python. */
function fixed(value, decimals) {
  if (!isNumber(value)) return "\u2013";
  const n = value * 10 ** decimals, isHalf = Number.isInteger(value * 2 ** (decimals + 1)) && abs(n % 1) === 0.5;
  const [whole, part] = (isHalf ? (2 * round(n / 2)) / 10 ** decimals : value).toFixed(decimals).split(".");
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
const LENGTHS = { mm: 1e-3, cm: 0.01, m: 1, in: 0.0254, ft: 0.3048 }, MEASURES = [LENGTHS, { deg: PI / 180, rad: 1 }, { kg: 1, t: 1000 }];
/* Return the value [SI] of a text that is typed for a thing: a plain number is in its unit, one with a unit of its measure in that; NaN for anything else. */
function typed(text, { factor, unit }, plainly = factor) {
  const kinds = data.measures, alike = Object.keys(kinds ?? {}).filter((each) => kinds[unit] && kinds[each][1] === kinds[unit][1]).map((each) => [each, kinds[each][0]]);
  const units = { ...MEASURES.find((each) => unit in each), ...Object.fromEntries(alike), [unit]: factor, "": plainly }, plain = text.trim().replace(/\u2212/g, "-").replace(/(\d)\s(?=\d{3})/g, "$1");
  const [, number, name] = /^([-+]?(?:\d+[.,]?\d*|[.,]\d+)(?:e[-+]?\d+)?)\s*(\D.*|)$/i.exec(plain) ?? [], raised = name?.replace("_", "/").replace("2", "\u00b2").replace("3", "\u00b3"), known = Object.keys(units).find((each) => [name, raised].includes(each) || signed(each) === name);
  return known === undefined ? NaN : Number((Number(number.replace(",", ".")) * units[known]).toPrecision(14));
}
/* Say all that stands in the page in the language chosen. */
function labelled() {
  root.lang = language;
  for (const each of document.querySelectorAll("[data-say]")) each.textContent = say(each.dataset.say);
  for (const each of document.querySelectorAll("[data-tip]")) each.title = say(each.dataset.tip);
  for (const each of document.querySelectorAll("[data-name]")) each.setAttribute("aria-label", say(each.dataset.name));
  byId("look").setAttribute("aria-label", say("Light or dark"));
  byId("language").textContent = language === "ru" ? "EN" : "RU";
  byId("language").lang = language === "ru" ? "en" : "ru";
}
let chosenLook = false;
function look(which) { root.dataset.look = which; }
const night = window.matchMedia("(prefers-color-scheme: dark)");
on(night, "change", () => { if (!chosenLook) look(night.matches ? "dark" : "light"); });

/* ---- the drawing: each part is made once and returns how it moves ---- */

/* The rows of values over all poses, of the present and of the delivered design, and at the present pose. */
let base, now, pose, before = null;
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
/* Return the place on the sheet [m] of a spot [px]. */
const placeAt = ([x, y]) => [(x - left0) / zoom, (top0 - y) / zoom];
/* Return where an event is on the sheet [px]. */
function spotOf(event) {
  const box = sheet.getBoundingClientRect();
  return [event.clientX - box.left, event.clientY - box.top];
}
const centroid = (points) => [0, 1].map((k) => points.reduce((sum, each) => sum + each[k], 0) / points.length);
/* Return the distance of a grid's lines [m]: round in the unit that is shown, some 45 px. */
function meshes() {
  const rough = 45 / zoom / data.length.factor, power = 10 ** floor(log10(rough));
  return [1, 2, 5, 10].map((k) => k * power).find((k) => k >= rough) * data.length.factor;
}
/* Draw the lines of a grid that stand so far apart [m]. */
function meshed(step, kind) {
  const lines = [], [low, high] = [placeAt([0, sheetTall]), placeAt([sheetWide, 0])];
  for (let i = ceil(low[0] / step); i * step <= high[0]; i++) lines.push([px(i * step, 0)[0], 0], [px(i * step, 0)[0], sheetTall], null);
  for (let i = ceil(low[1] / step); i * step <= high[1]; i++) lines.push([0, px(0, i * step)[1]], [sheetWide, px(0, i * step)[1]], null);
  draw(sheet, "path", { class: kind, d: broken(lines) });
}
const spot = (found, point, i) => { const [x, y] = rows.points[point]; return [found.values[x][i], found.values[y][i]]; };
let parts = [], edition = 0;

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
  return (at) => { const text = pairs(cornersOf({ points, shares }, at)); set(outer, { points: text }); set(inner, { points: text }); };
}
/* The corners of a body at a pose: of its form where it has one, else the outermost of its points. */
function cornersOf({ points, shares }, at) {
  if (shares) return shares.map((row) => [0, 1].map((axis) => row.reduce((sum, share, k) => sum + share * at[points[k]][axis], 0)));
  return points.length > 2 ? hull(points.map((i) => at[i])) : points.map((i) => at[i]);
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
function linework({ on: [P, Q], lines, hatched, slide }, ink = "ink", thin = 0.8) {
  const group = draw(sheet, "g", { stroke: css(ink), join: "round", cap: "round" }), flip = (rows) => rows.map(([x, y]) => [x * zoom, -y * zoom]);
  const [from, least, most] = slide || [0, 0, 0], out = (length) => min(max(length / zoom - from, least), most), tubes = [];
  const held = slide && data.cylinders.find((each) => each.P === P && each.Q === Q && each.pressure !== undefined);
  const drawn = lines.map(({ rows, fill, closed, bold }) => {
    const line = draw(group, closed ? "polygon" : "polyline", { fill: fill ? css(fill) : "none", w: (bold ? 1.5 : thin) * EDGE });
    if (held && fill === "barrel") tubes.push(line);
    const put = (length) => set(line, { points: pairs(rows.map(([along, across, share = 0, slides = 0]) => [share * length + (along + slides * out(length)) * zoom, -across * zoom])) });
    put(0);
    return rows[0].length > 2 && put;
  }).filter(Boolean);
  if (hatched) draw(group, "path", { w: 0.7, fill: "none", d: broken(lines.flatMap(({ rows, closed }) => hatches(flip(closed ? [...rows, rows[0]] : rows), P === undefined))) });
  return (at) => {
    const [x, y] = P === undefined ? px(0, 0) : at[P], beyond = Q === undefined ? [x + 1, y] : at[Q];
    for (const put of drawn) put(apart([x, y], beyond));
    for (const tube of tubes) set(tube, { fill: barrelColour(held) });
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
function ram(each) {
  const { P, Q, aside } = each, group = draw(sheet, "g", { w: 0.8 * EDGE, join: "round", stroke: css("ink") }), off = aside * unit0;
  const parts = ["eye", "barrel", "rod", "piston", "cap"].map((name) => draw(group, "rect", { fill: css(name === "barrel" || name === "rod" ? name : "piston") }));
  const [eye, barrel, shaft, piston, cap] = parts, put = (rect, from, to) => set(rect, { x: from, width: max(to - from, 0) });
  let low, high, u, least, mouth, seen;
  return (at) => {
    if (seen !== edition) {
      seen = edition; [low, high] = each.range ? each.range.map((length) => length * zoom) : span(P, Q); u = min(unit0, 0.12 * low); least = 2 * u;
      mouth = min(max(least + high - low + 1.5 * u, 0.68 * low), max(0.68 * low, low - 1.2 * u));
      [0.62, 1.3, 0.42, 1.12, 1.5].forEach((half, i) => set(parts[i], { y: -off - half * u, height: 2 * half * u }));
      put(eye, 0, 1.4 * u); put(barrel, 1.4 * u, mouth); put(cap, mouth - 0.35 * u, mouth + 0.35 * u);
    }
    const length = apart(at[P], at[Q]), place = min(max(length - low + least, least), mouth - 0.9 * u);
    put(shaft, place, max(length, place)); put(piston, place - 0.45 * u, place + 0.45 * u);
    set(barrel, { fill: barrelColour(each) });
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
  const lines = [["ink", EDGE], ["paper", -EDGE]].map(([ink, more]) => draw(sheet, "line", { cap: "round", w: 1.4 * unit0 + more, stroke: css(ink) })), ends = track(each);
  return () => { const [a, b] = ends(); for (const line of lines) set(line, { x1: a[0], y1: a[1], x2: b[0], y2: b[1] }); };
}
/* A fixed rail: its line under the blocks and its hatches, below the track, above where a pin stands on it. */
function rail(each) {
  const [path, heavy] = [1, 1.8].map((w) => draw(sheet, "path", { class: "line", w, stroke: css("ink") })), ends = track(each);
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
  const u = unit0, group = draw(sheet, "g", { w: EDGE, join: "round", fill: css("rod"), stroke: css("ink") }), lines = [[3.2 * u, -2.66 * u], [3.2 * u, 2.66 * u], null];
  for (let i = 0; i < 6; i++) { const v = -2.66 + (i * 4.42) / 5; lines.push([3.2 * u, (v + 0.9) * u], [4.1 * u, v * u], null); }
  draw(group, "polygon", { points: pairs([[0, 0], [3.2 * u, 1.9 * u], [3.2 * u, -1.9 * u]]) });
  draw(group, "path", { d: broken(lines), w: 1 });
  return (at) => set(group, { transform: `translate(${at[point][0]} ${at[point][1]}) rotate(${(-way * 180) / PI})` });
}
function name(index) {
  const made = label(index, "name-of", NAME_FONT, 14, css("ink")), first = scene.labels[index];
  return (at) => Object.assign(made, { said: scene.letters && !(phone.matches && scene.letters[index]) ? scene.letters[index] : scene.names[index], anchor: at[index], way: first, first, near: 0.5 * unit0 });
}
const scale = { most: 0 };
/* The colour of a cylinder's barrel at the present pose. */
const barrelColour = ({ pressure, most }) => (pressure === undefined ? css("barrel") : heat(pose.values[pressure][0], pose.values[most] ? pose.values[most][0] : scale.most));
/* The colour of a barrel at a pressure: from the barrel's own through amber to red. */
function heat(value, most) {
  const share = min(max(value / most, 0), 1) || 0, mix = (a, b, t) => `color-mix(in oklab, ${css(b)} ${(100 * t).toFixed(1)}%, ${css(a)})`;
  return share < 0.5 ? mix("barrel", "warm", 2 * share) : mix("warm", "hot", 2 * share - 1);
}
/* Choose the scale so that the delivered and the present design have room over the whole stroke. */
function fit(grow, under = 0) {
  const box = sheet.getBoundingClientRect();
  sheetWide = box.width || 600; sheetTall = box.height || 400; foot = under;
  let [left, right, bottom, top] = grow && before ? before : scene.box;
  for (const found of [base, now]) for (const i of found.reached) for (let p = 0; p < scene.names.length; p++) {
    const [x, y] = spot(found, p, i);
    left = min(left, x); right = max(right, x); bottom = min(bottom, y); top = max(top, y);
  }
  before = [left, right, bottom, top];
  const wide = right - left || 1e-3, high = top - bottom || 1e-3, pad = min(32, 0.07 * min(sheetWide, sheetTall));
  for (let turn = 0, margin = pad; turn < 2; turn++) {
    zoom = min((sheetWide - 2 * margin) / wide, (sheetTall - under - 2 * margin) / high);
    unit0 = max(scene.size * zoom, 3.4);
    margin = max(pad, 4.4 * unit0);
  }
  left0 = 0.5 * sheetWide - 0.5 * (left + right) * zoom;
  top0 = 0.5 * (sheetTall - under) + 0.5 * (bottom + top) * zoom;
}
/* Draw everything anew: after a change of the design or of the sheet; with what lies at the bottom, under the bodies, and on top. */
function drawn({ first = () => [], under = () => [], over = () => [] }) {
  sheet.replaceChildren();
  texts = []; boxes = [];
  set(sheet, { viewBox: `0 0 ${sheetWide} ${sheetTall}` });
  const isPlate = (each) => (each.shares || each.points).length > 2, plates = scene.bodies.filter(isPlate), bars = scene.bodies.filter((each) => !isPlate(each));
  const loads = (pinned) => scene.loads.filter((each) => scene.pins.includes(each.on[0]) === pinned).map((each) => linework(each, "ink", 0.9));
  const blocks = (fixed) => scene.tracks.filter((each) => each.fixed === fixed).flatMap((each) => each.riders.map((rider) => block(each, rider)));
  return [
    ...first(), ...scene.around.map((each) => linework(each, "muted", 0.9)), ...scene.grounds.map(ground), ...scene.tracks.filter((each) => each.fixed).map(rail), ...under(),
    ...scene.contours.map((each) => linework(each)), ...plates.map(body), ...blocks(true), ...bars.map(body),
    ...scene.tracks.filter((each) => !each.fixed).map(slot), ...blocks(false), ...scene.stays.map(stay), ...data.cylinders.filter((each) => each.drawn).map(ram), ...scene.straights.map((each) => linework(each)), ...loads(true),
    ...scene.pins.map((i) => circle(i, 0.5 * unit0, "paper", "ink", 1.3 * EDGE)), ...scene.dots.map((i) => circle(i, 0.48 * unit0, "ink", "paper", 1)), ...loads(false), ...over(), placed,
  ];
}
/* The points' names; where these are letters with primes, what they mean stands in lines at the top of the sheet, but on a phone. */
function named() {
  const lines = [[]], most = (sheetWide - 24) / 7;
  for (const each of (!phone.matches && scene.legend) || []) {
    if (lines[lines.length - 1].join("  ").length + each.length + 3 > most) lines.push([]);
    lines[lines.length - 1].push(each);
  }
  lines.forEach((each, i) => {
    const text = each.join("\u2003");
    draw(sheet, "text", { x: 12, y: 20 + 16 * i, class: "letters halo" }).textContent = text;
    if (text) boxes.push([12, 8 + 16 * i, 12 + 7 * text.length, 24 + 16 * i]);
  });
  return scene.names.map((_, i) => name(i));
}
