const { strokes } = data, factorOf = (unit) => data.measures[unit]?.[0] ?? 1;
/* How far the slider of a stroke goes, from low to high over all that is declared; and a place held within it. */
const reachOf = ({ start, end, reach }) => reach ?? [min(start, end), max(start, end)];
const within = (value, each) => { const [low, high] = reachOf(each); return min(max(value, low), high); };
/* The questions of the verdicts, asked of the present design over all that the machine runs when the hand rests: coarsely while it holds something. */
const asking = judging(engine, data.judge, data.joints.map(({ row }) => row)), DRAGGING = 9, STILL = 17, REST = 130;
/* The paths that a machine declares run as strokes of their own, unless the page is of a path. */
if (!strokes.some((each) => each.path && each.over === undefined)) for (const [over, { shape, name, places: ways, time, courses }] of asking.spans().entries()) {
  if (shape === "path" && name && ways[0].length > 1 && !strokes.some((each) => each.over === over)) strokes.push({ name, start: time ? time[0] : 1, end: time ? time[1] : ways[0].length, at: time ? time[0] : 1, unit: time ? "s" : "", factor: 1, turn: time ? 1 : 0, path: { ...ways }, over, time, courses });
}
/* A column has a row of the program in each load case in which it differs; that of the path that runs is shown. */
const rowNow = (row) => { const found = row[caseNow()] ?? row; return found >= 0 ? found : undefined; };
const columns = data.columns.map(([name, unit, row, ru, values]) => ({ name, unit, factor: factorOf(unit), ru, get values() { return values?.[caseNow()]; }, get row() { return rowNow(row); } }));
/* The situation that is shown: of the place that was gone to, else of the path that runs. */
let acting = -1;
const caseNow = () => (acting < 0 ? (data.situationOf[strokes[runs].over] ?? 0) : acting);
const actingIn = (name) => { const k = data.cases.findIndex((each, k) => each === name && data.timeOf[k] === data.timeOf[caseNow()]); return k === caseNow() ? -1 : k; };
const caseSaid = (name) => (language === "ru" && data.casesRu[name]) || name;
const caseTitle = (name) => (data.cases.some(Boolean) ? caseSaid(name) || say("own loads") : "");
for (const each of [...data.cylinders, ...data.arrows]) for (const name of ["pressure", "most", "x", "y", "couple", "atX", "atY"]) if (each[name]?.length) {
  const row = each[name];
  Object.defineProperty(each, name, { get: () => rowNow(row) });
}
/* A dimension as it comes: its name, value, least and greatest [SI], unit, whether it is a length, and where it stands. */
const dims = data.dims.map(([name, value, ends, unit, positive, where, sizes = []]) => ({ name, value, low: ends[0] ?? value - ends, high: ends[1] ?? value + ends, unit, factor: factorOf(unit), positive, where, sizes }));

/* ---- the state, and what follows from it ---- */

const byName = new Map(dims.map((each, i) => [each.name, i])), order = engine.d.map((name) => byName.get(name)), COUNT = data.count;
const original = dims.map((each) => each.value), firstStand = () => strokes.map((each) => each.at);
/* The design and the strokes as they are, which stroke runs, and what else is chosen. */
let present = [...original], stands = firstStand(), runs = data.run, showsForces = false;
let chosen = [...data.shown], column = data.column, second = -1;

const vector = (design) => order.map((i) => design[i]);
/* Lay the paths where a design has their places. */
function laid(design) {
  const ways = strokes.filter((each) => each.over !== undefined), spans = ways.length ? asking.spans(vector(design)) : [];
  for (const each of ways) each.path = { ...spans[each.over].places };
}
function sweep(design, at, run) {
  laid(design);
  const { start, end, courses } = strokes[run];
  const along = Float64Array.from({ length: COUNT }, (_, i) => (i === COUNT - 1 ? end : start + ((end - start) * i) / (COUNT - 1)));
  const poses = Array.from(along, (value) => followed(at.map((stands, k) => (k === run ? value : stands)), run));
  const found = engine.sweep(vector(design), own.map((_, k) => Float64Array.from(poses, (pose) => pose[k])), courses && ratesAt(strokes[run], [...along]));
  return { ...found, along, reached: [...along.keys()].filter((i) => found.reason[i] === 0) };
}
/* Along a path all strokes that it drives follow the place on it, in straight lines from one of its places to the next. */
const own = strokes.filter((each) => !each.path);
function followed(at, run = runs) {
  const { path, start, end, courses } = strokes[run], found = [...at];
  if (courses) { atInstant(strokes[run], at[run]).forEach(([value], k) => { found[k] = value; }); return found; }
  for (const k in path) {
    const u = ((at[run] - start) / (end - start)) * (path[k].length - 1), i = min(max(floor(u), 0), path[k].length - 2);
    found[k] = path[k][i] + (path[k][i + 1] - path[k][i]) * (u - i);
  }
  return found;
}
function single(design, at) {
  laid(design);
  const found = engine.sweep(vector(design), followed(at).slice(0, own.length).map((value) => [value]), strokes[runs].courses && ratesAt(strokes[runs], [at[runs]]));
  if (!isChanged()) found.values.push(...(data.judge.delivered ?? []).map((list) => [valueAt(list, at[runs])]));
  return found;
}
/* Return a value at a place of the running stroke, between two of a list of values at even steps; NaN where there is none. */
function valueAt(list, place) {
  const { start, end } = strokes[runs], last = list.length - 1, where = min(max(((place - start) / (end - start)) * last, 0), last), i = min(floor(where), last - 1), t = where - i;
  const a = list[i] ?? NaN, b = list[i + 1] ?? NaN;
  return t === 0 ? a : t === 1 ? b : a + (b - a) * t;
}
/* A value of a stroke as a place of it is read: to 0.1 mm or 0.01 degrees, lengths below 1 mm to three figures, an instant to four. */
const standing = ({ start, end, factor, unit, base, path }, value) => fixed(value / factor, path ? places(max(abs(start), abs(end)) / factor, 4) : base in LENGTHS && abs(value) > 1e-7 && abs(value) < 1e-3 ? places(abs(value) / factor, 3) : max(round(log10(1e4 * factor)), 0)) + unitText(unit);
const titled = (each) => (each.name === "along the path" ? say("place") : each.name);
const isChanged = () => dims.some((each, i) => present[i] !== each.value);
const isDriven = (k) => k === runs || k in (strokes[runs].path || {});
const isMoved = () => runs !== data.run || own.some((each, k) => !isDriven(k) && stands[k] !== each.at);
/* Let another stroke, or the place on the path, run from where the machine stands. */
function runsOn(run) { stands = followed(stands); runs = run; acting = -1; }

/* Return why a pose cannot be had. */
function why(found, i, what) {
  const k = found.reason[i], step = k > 0 ? engine.steps[k - 1] : (found.at && found.at[i]) || "";
  const name = data.steps[step] || step, missing = found.missing[i];
  if (k === -1) return say("{what}: a change point, where two branches cross", { what });
  if (missing > 0) return say("{what}: {step} is {gap} short", { what, step: name, gap: shown(missing, data.length, 3) });
  return say("{what}: {step} cannot be placed", { what, step: name });
}
/* Return the last values where something holds and where it does not, by halving `n` times. */
function halved(good, bad, holds, n) {
  for (; n > 0; n--) { const t = 0.5 * (good + bad); if (holds(t)) good = t; else bad = t; }
  return [good, bad];
}
/* Move part of the state as far towards what is asked as can be assembled; say why where that is not all the way. */
function moved(design, at, what) {
  const asked = single(design, at);
  if (asked.reason[0] === 0) { present = design; stands = at; warn(""); return true; }
  const from = present, stood = stands, between = (a, b, t) => a.map((value, i) => (value === b[i] ? value : value + (b[i] - value) * t));
  const trial = (t) => [between(from, design, t), between(stood, at, t)], [most] = halved(0, 1, (t) => single(...trial(t)).reason[0] === 0, 24);
  if (most > 0) [present, stands] = trial(most);
  warn(why(asked, 0, say("{what} stops here", { what })));
  return false;
}
/* Set all that is asked; where that cannot be assembled, one after the other, and say what stays as it is. */
function taken(design, at) {
  const asked = single(design, at), left = [], lists = asked.reason[0] === 0 ? [design, at] : [[...present], [...stands]];
  for (const [k, [wanted, all]] of [[design, dims], [at, strokes]].entries()) for (const [i, value] of wanted.entries()) {
    const before = lists[k][i];
    lists[k][i] = value;
    if (value !== before && single(...lists).reason[0] !== 0) { lists[k][i] = before; left.push(all[i].name); }
  }
  moved(...lists, "");
  if (left.length) warn(why(asked, 0, say("{names} stays as it is", { names: left.join(", ") })));
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
  return found === base || !(isChanged() || (isMoved() && !strokes[runs].courses)) ? each.values : null;
}

/* ---- what is drawn of the present state beside the mechanism ---- */

let gripped = null;
/* A pin that can be dragged: of one on the ground both coordinates are dimensions, a moving joint takes the mechanism along. */
function grip({ point, x, y }) {
  const element = draw(sheet, "circle", { r: max(22, 2 * unit0), class: "grip" }), name = scene.names[point];
  draw(element, "title", {}).textContent = x === undefined ? say("Drag {name}; with Shift the lengths that meet there follow", { name }) : say("Drag {name}", { name });
  element.dataset.pin = name;
  on(element, "pointerdown", (event) => {
    if (measuring || pinched.size) return;
    event.preventDefault(); event.stopPropagation();
    const places = scene.names.map((_, p) => spot(pose, p, 0)), from = x === undefined ? places[point] : [present[x], present[y]];
    gripped = { id: event.pointerId, point, x, y, name, from, places, start: spotOf(event), shift: event.shiftKey };
    if (x === undefined) play(false);
    sheet.setPointerCapture(event.pointerId);
  });
  return (at) => set(element, { cx: at[point][0], cy: at[point][1] });
}
/* What is touched: the pin under the finger, and those that stand on it. */
sheet.addEventListener("pointerdown", (event) => {
  const at = scene.names.map((_, p) => px(...spot(pose, p, 0))), finger = spotOf(event), far = at.map((each) => apart(each, finger)), nearest = far.indexOf(min(...far));
  touched = far[nearest] < 24 ? at.flatMap((each, p) => (apart(each, at[nearest]) < 6 ? [p] : [])) : [];
  if (phone.matches || showsForces) soon("fit");
}, true);
on(sheet, "pointermove", (event) => {
  if (!gripped || event.pointerId !== gripped.id) return;
  const [x, y] = spotOf(event);
  gripped.to = [gripped.from[0] + (x - gripped.start[0]) / zoom, gripped.from[1] - (y - gripped.start[1]) / zoom].map(snapped);
  gripped.shift = event.shiftKey;
  soon("drag");
});
function dragged() {
  const { to, x, y, point, name, shift } = gripped;
  gripped.to = null;
  if (x === undefined) return shift || !data.moving.includes(point) ? reshaped(point, to) : led(point, to);
  const design = [...present];
  [design[x], design[y]] = to;
  return moved(design, stands, name);
}
for (const end of ["pointerup", "pointercancel"]) on(sheet, end, (event) => {
  if (!gripped || event.pointerId !== gripped.id) return;
  if (gripped.to) dragged();
  const before = String(chosen);
  for (const i of [gripped.x, gripped.y, ...(gripped.changes || [])]) if (i !== undefined && !chosen.includes(i)) chosen.push(i);
  gripped = null;
  if (String(chosen) !== before) listSizes();
  clock = phaseNow();
  soon("fit"); remember();
});
/* Which body a force acts on, and from which; of a load its name. */
function actsText({ on, by, load }) {
  if (load) return on;
  return by === undefined ? `${on} ${say("from the ground")}` : `${say("on {body}", { body: on })} ${by ? say("from {body}", { body: by }) : say("from the frame")}`;
}
/* An arrow: a force at a point, in the scale in which the greatest is a sixth of the sheet, or a couple about it, counter-clockwise above zero. What is touched says on what it acts. */
function arrow(each) {
  const { point, load, by } = each, isCouple = "couple" in each, colour = css(load ? "accent" : "other"), line = draw(sheet, "path", { w: 2.2, join: "round", fill: isCouple ? "none" : colour, stroke: colour }), title = draw(line, "title", {});
  const number = label(point, "halo force", FORCE_FONT, 12, `color-mix(in srgb, ${colour} 60%, var(--ink))`);
  on(line, "pointerover", () => { title.textContent = `${number.said.split(" ")[0]} ${actsText(each)}`; });
  return (at) => {
    if (isCouple) { about(each, actsAt(each, at), line, number); return; }
    const { x, y } = each, k = pull.scale, f = [pose.values[x]?.[0] * k, -pose.values[y]?.[0] * k], long = hypot(...f), head = min(9, 0.5 * long);
    if (!showsForces || !(long > 1)) { set(line, { d: "" }); number.said = ""; return; }
    /* The ground cannot pull: there the machine tips. */
    const d = [f[0] / long, f[1] / long], tint = !load && by === undefined && f[1] > 0.5 ? css("hot") : colour, from = actsAt(each, at), tip = [from[0] + f[0], from[1] + f[1]], neck = [tip[0] - head * d[0], tip[1] - head * d[1]], w = 0.38 * head;
    set(line, { d: broken([from, neck, [neck[0] - w * d[1], neck[1] + w * d[0]], tip, [neck[0] + w * d[1], neck[1] - w * d[0]], neck]), fill: tint, stroke: tint });
    const force = shown(hypot(pose.values[x][0], pose.values[y][0]), data.force, 3);
    Object.assign(number, { said: touched.includes(point) ? `${force} ${actsText(each)}` : force, anchor: tip, way: d });
    arrows.push([from, tip]);
  };
}
function about(each, [x, y], line, number) {
  const rank = data.arrows.filter((other) => "couple" in other && other.point === each.point).indexOf(each), r = (2.6 + 1.4 * rank) * unit0;
  const size = pose.values[each.couple]?.[0], side = size < 0 ? -1 : 1, on = (t, far) => [x - side * far * sin(t), y - far * cos(t)], head = (aside) => on(1.53 - (1.3 * unit0) / r, r + aside * unit0);
  const seen = showsForces && abs(size) > 1e-9 * pull.most, turns = Array.from({ length: 23 }, (_, i) => on(0.17 * (i - 13), r));
  set(line, { d: seen ? broken([...turns, null, head(0.9), turns[22], head(-0.9)]) : "" });
  if (seen) turns.slice(1).forEach((tip, i) => arrows.push([turns[i], tip]));
  const couple = shown(abs(size), data.moment, 3);
  Object.assign(number, { said: !seen ? "" : touched.includes(each.point) ? `${couple} ${actsText(each)}` : couple, anchor: on(0, r), way: [0, -1] });
}
/* Where a load acts: at its point, or at a place of its own in a body. */
const actsAt = ({ point, atX, atY }, at) => (atX === undefined ? at[point] : px(pose.values[atX][0], pose.values[atY][0]));
const pull = { scale: 0, most: 0 };
function pullScale() {
  pull.most = 0;
  for (const { x, y } of data.arrows) for (const i of now.reached) pull.most = max(pull.most, hypot(now.values[x]?.[i], now.values[y]?.[i]) || 0);
  pull.scale = pull.most ? min(sheetWide, sheetTall) / 4.5 / pull.most : 0;
}
/* Make room for the arrows: the drawing gives way at each side by what stands over there. */
function roomForArrows() {
  for (let turn = 0; showsForces && turn < 3; turn++) {
    const tips = data.arrows.flatMap(({ point, x, y }) => now.reached.map((i) => px(...spot(now, point, i)).map((at, k) => at + ((k ? -now.values[y]?.[i] : now.values[x]?.[i]) * pull.scale || 0))));
    const [[left, wide], [top, tall]] = [sheetWide, sheetTall - foot].map((end, k) => { const list = tips.map((tip) => tip[k]), low = max(8 - min(...list), 0); return [low, 1 - (low + max(max(...list) + 8 - end, 0)) / end]; });
    const q = min(wide, tall);
    zoom *= q; left0 = q * left0 + left + 0.5 * (wide - q) * sheetWide; top0 = q * top0 + top + 0.5 * (tall - q) * (sheetTall - foot);
  }
}
function pressureScale() {
  scale.most = 0;
  for (const each of data.cylinders) if (each.pressure !== undefined) for (const found of [now, base]) for (const i of found.reached) {
    scale.most = max(scale.most, (each.most !== undefined && found.values[each.most][i]) || found.values[each.pressure][i] || 0);
  }
}
let keys, told0 = "";
function legend() {
  const bottom = sheetTall - 12, hint = !touched.length && (phone.matches || (showsForces && pull.most > 0)), told = [scale.most, showsForces && pull.most, sheetWide, bottom, language, hint].join(), group = keys;
  if (told === told0 && group.firstChild) return;
  told0 = told;
  group.replaceChildren();
  if (hint) draw(group, "text", { class: "halo", ...(phone.matches ? { x: 12, y: 20 } : { x: sheetWide - 12, y: bottom - 15, anchor: "end" }) }).textContent = say("Touch a pin for its name and its forces");
  if (scale.most > 0) {
    const bar = min(110, 0.3 * sheetWide);
    for (let i = 0; i < 22; i++) draw(group, "rect", { x: 12 + (i * bar) / 22, y: bottom - 8, width: bar / 22 + 0.5, height: 9, fill: heat((i + 0.5) / 22, 1) });
    const unit = data.pressureUnit, top = short(scale.most / unit.factor, 3);
    draw(group, "text", { x: 12, y: bottom - 13, class: "halo" }).textContent = "0";
    draw(group, "text", { x: 12 + bar, y: bottom - 13, class: "halo", anchor: "end" }).textContent = top + unitText(unit.unit);
  }
  if (showsForces && pull.most) draw(group, "text", { x: sheetWide - 12, y: bottom, class: "halo", anchor: "end" }).textContent = say("longest arrow {force}", { force: shown(pull.most, data.force, 3) });
}

const beside = () => (showsForces || data.cylinders.some((each) => each.pressure !== undefined) ? 34 : 0);
const room = () => beside() + (data.task?.points ? 36 : 0);
function build() {
  const paths = () => data.paths.map((point) => {
    const line = draw(sheet, "path", { class: "line", w: 2.2, dash: "0.1 4.6", stroke: css("accent") });
    let seen;
    return () => { if (seen !== edition) { seen = edition; set(line, { d: broken([...now.along.keys()].map((i) => (now.reason[i] ? null : px(...spot(now, point, i))))) }); } };
  });
  const first = () => [...gridded(), ghostly(draw(sheet, "path", { class: "line", w: 2, dash: "2 5", stroke: css("muted") }))];
  parts = drawn({ first, under: paths, over: () => [...(data.task ? wanted() : []), ...named(), ...data.arrows.map(arrow), ...[...data.grips, ...data.moving.map((point) => ({ point }))].map(grip), ...measured()] });
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
/* A curve of a design as places and values in their units, with both sides of each jump between two poses, which is looked for by halving. */
function curved(values, along, each, design) {
  const { factor } = strokes[runs], known = finite(values), size = (i) => abs(values[i + 1] - values[i]) || 0, most = 0.1 * (max(...known) - min(...known));
  return values.flatMap((value, i) => {
    const here = [[along[i], value]];
    if (each.row === undefined || !(size(i) > most && size(i) > 6 * max(size(i - 1), size(i + 1)))) return here;
    let low = here[0], high = [along[i + 1], values[i + 1]];
    for (let k = 0; k < 16; k++) {
      const at = 0.5 * (low[0] + high[0]), found = single(design, stands.map((stood, j) => (j === runs ? at * factor : stood)));
      const middle = [at, found.reason[0] === 0 ? found.values[each.row][0] / each.factor : NaN];
      if (abs(middle[1] - low[1]) > abs(high[1] - middle[1])) high = middle; else low = middle;
    }
    return abs(high[1] - low[1]) > 0.5 * size(i) ? [...here, low, high] : here;
  });
}
function plotted() {
  const box = plot.getBoundingClientRect(), W = box.width || 400, H = box.height || 200, one = columns[column], two = columns[second];
  plot.replaceChildren();
  set(plot, { viewBox: `0 0 ${W} ${H}` });
  const stroke = strokes[runs], given = one && data.limits[one.name], limit = given ? [given[0] / one.factor, limitText(given), given[2]] : null;
  const values = inUnit(one, now), others = two ? inUnit(two, now) : null, was = isChanged() || isMoved() ? inUnit(one, base) : null;
  const same = two && two.unit === one.unit, T = 10, B = 40;
  const [low, high] = range([values, isMoved() ? null : was, same ? others : null, data.task ? wantedValues(one) : null], limit), [low2, high2] = same ? [low, high] : range([others]);
  const left = ticks(low, high, H < 180 ? 4 : 6), right = two && !same ? ticks(low2, high2, H < 180 ? 4 : 6) : [];
  const L = 14 + 7.2 * max(...left.map((each) => each[1].length), 2), R = right.length ? 14 + 7.2 * max(...right.map((each) => each[1].length)) : 12;
  const along = Array.from(now.along, (value) => value / stroke.factor), least = min(...along), most = max(...along);
  const x = (s) => L + ((s - least) / (most - least || 1)) * (W - L - R), y = (v) => H - B - ((v - low) / (high - low || 1)) * (H - T - B), y2 = (v) => H - B - ((v - low2) / (high2 - low2 || 1)) * (H - T - B);
  const write = (a, b, text, more) => { draw(plot, "text", { x: a, y: b, ...more }).textContent = text; };
  const line = (list, up, colour, width, more) => draw(plot, "path", { class: "line", w: width, d: broken(list.map(([s, v]) => (isNumber(v) ? [x(s), up(v)] : null))), ...more, stroke: css(colour) });
  const rule = (x1, y1, x2, y2, colour, more) => draw(plot, "line", { x1, y1, x2, y2, stroke: css(colour), ...more });
  if (limit) {
    const at = y(limit[0]), above = limit[2] !== "below";
    draw(plot, "rect", { x: L, width: W - L - R, y: above ? T : at, height: max(above ? at - T : H - B - at, 0), opacity: 0.13, fill: css("accent") });
  }
  for (const [v, text] of left) { rule(L, y(v), W - R, y(v), "grid"); write(L - 6, y(v) + 4, text, { anchor: "end" }); }
  for (const [v, text] of right) write(W - R + 6, y2(v) + 4, text, {});
  for (const [s, text] of ticks(least, most, max(3, floor((W - L - R) / 62)), stroke.unit === "deg" && most - least >= 90)) if (!stroke.path || stroke.unit || s % 1 === 0) {
    rule(x(s), T, x(s), H - B, "grid"); write(x(s), H - B + 15, stroke.path && !stroke.unit ? s : text, { anchor: x(s) > W - R - 10 ? "end" : "middle" });
  }
  rule(L, T, L, H - B, "rule"); rule(L, H - B, W - R, H - B, "rule");
  const compares = was && !isMoved();
  const along0 = stroke.unit ? signed(stroke.unit) : stroke.over === undefined ? "" : say("place"), acts = caseTitle(data.cases[caseNow()]), falls = stroke.start > stroke.end && say("it runs down");
  write(compares ? L : 0.5 * (L + W - R), H - 6, [titled(stroke), along0, falls, acts && say("load case: {case}", { case: acts })].filter(Boolean).join(", "), { anchor: compares ? "start" : "middle" });
  if (compares) line(curved(was, along, one, original), y, "muted", 2, { dash: "3 4" });
  if (others) line(curved(others, along, two, present), same ? y : y2, "other", 2.2, {});
  chart = { one, two, values, others, along, x, y, y2: same ? y : y2 };
  if (values) {
    const points = curved(values, along, one, present);
    line(points, y, "curve", 2.6, {});
    if (limit) {
      line(points.map(([s, v]) => [s, (limit[2] === "below" ? v < limit[0] : v > limit[0]) ? v : NaN]), y, "accent", 3.2, {});
      for (let i = 1; i < points.length; i++) {
        const [[from, v], [to, w]] = points.slice(i - 1, i + 1), a = v - limit[0], b = w - limit[0];
        if (a * b < 0) { const dot = draw(plot, "circle", { r: 4, cx: x(from - (a * (to - from)) / (b - a)), cy: y(limit[0]) }); set(dot, { fill: css("accent") }); }
      }
    }
  }
  if (limit) {
    const at = y(limit[0]), late = values && abs(values[values.length - 1] - limit[0]) >= abs(values[0] - limit[0]);
    rule(L, at, W - R, at, "accent", { dash: "7 4", w: 1.5 });
    write(late ? W - R - 5 : L + 5, at + (limit[2] === "below" && at + 20 < H - B ? 15 : at < T + 18 ? 15 : -6), limit[1], { class: "note halo", anchor: late ? "end" : "start" });
  }
  if (data.task) wantedOnCurve(x, y, one);
  const known = one && one.row === undefined ? say("not followed in the page: known only as delivered") : "";
  if (!values) write(L + 8, T + 18, known, { class: "note halo" });
  byId("column").title = known && `${called(one)}: ${known}`;
  if (compares) write(W - R, H - 6, say("dashed: as delivered"), { anchor: "end" });
  glass = { line: draw(plot, "line", { class: "rule", dash: "2 3", visibility: "hidden" }), text: draw(plot, "text", { class: "halo read", visibility: "hidden" }) };
  chart.second = draw(plot, "circle", { r: 4.5, w: 2, fill: css("other"), stroke: css("paper") });
  chart.marker = draw(plot, "circle", { r: 6, w: 2, fill: css("curve"), stroke: css("paper") });
}
/* A value of a curve to four figures, as rules have it; near zero to those of a thousandth of the greatest. */
const readOff = (value, list, each) => (isNumber(value) ? fixed(value, places(max(abs(value), 1e-3 * max(...finite(list).map(abs))), 4)) + unitText(each.unit) : "\u2013");
function mark(each, list, up, dot, out) {
  const value = list ? valueAt(list, stands[runs]) : NaN, { start, end } = strokes[runs], there = isNumber(value) && (stands[runs] - start) * (end - stands[runs]) >= -1e-12;
  set(dot, { visibility: there ? "visible" : "hidden" });
  if (there) set(dot, { cx: chart.x(stands[runs] / strokes[runs].factor), cy: up(value) });
  byId(out).textContent = each ? readOff(there ? value : NaN, list, each) : "";
}

/* ---- controls ---- */

function expected({ name, unit }, text) {
  return unit ? say("{name} = {text}: a number in {unit} is expected", { name, text, unit: signed(unit) }) : say("{name} = {text}: a number is expected", { name, text });
}

const sizeRows = new Map();
function strokeSliders() {
  const rows = strokes.map((each, k) => {
    const row = make("label", { className: "stroke" }), slider = make("input"), out = make("input"), label = make("span", { textContent: each.name }), [low, high] = reachOf(each);
    if (each.name === "along the path") label.dataset.say = "place";
    Object.assign(slider, { type: "range", min: 0, max: 1000, step: "any" });
    slider.setAttribute("aria-label", each.name);
    slider.dataset.stroke = each.name;
    Object.assign(out, { type: "text", inputMode: "decimal", autocomplete: "off", spellcheck: false, readOnly: each.path && !each.unit });
    out.setAttribute("aria-label", each.unit ? `${each.name}, ${each.unit}` : each.name);
    on(out, "change", () => {
      const value = typed(out.value, each);
      out.blur();
      if (isNumber(value)) put(within(value, each)); else { warn(expected(each, out.value)); soon("pose"); }
    });
    on(slider, "input", () => put(Number(slider.value) >= 1000 ? high : low + ((high - low) * Number(slider.value)) / 1000));
    const put = (value) => {
      const turns = k !== runs && (isDriven(k) || each.path);
      if (turns) { runsOn(k); choosers(); }
      if (k === runs) play(false);
      const at = [...stands];
      at[k] = value;
      moved(present, at, titled(each));
      if (k === runs) clock = phaseNow();
      soon(k === runs && !turns ? "pose" : "sweep"); remember();
    };
    row.append(label, slider, out);
    Object.assign(each, { slider, out, put });
    return row;
  });
  byId("strokes").replaceChildren(...rows.slice(own.length), ...rows.slice(0, own.length));
}
const nice = (each) => { const wide = (each.high - each.low) / each.factor / 400, power = 10 ** floor(log10(wide)); return [1, 2, 5, 10].map((k) => k * power).find((k) => k >= wide) * each.factor; };
function listSizes() {
  const parent = byId("dimensions");
  sizeRows.clear();
  parent.replaceChildren(...byPart(chosen).flatMap(([part, own]) => [...(part ? [make("h3", { textContent: part })] : []), ...own.map((i) => {
    const each = dims[i], row = make("div", { className: "size" }), slide = make("div", { className: "slide" }), slider = make("input");
    const mark = make("i"), box = make("input"), unit = make("span", { className: "unit", textContent: signed(each.unit) }), drop = make("button", { className: "drop" });
    const label = make("span", { className: "name", textContent: part ? each.name.slice(part.length + 1) : each.name, title: each.where ? `${each.name}: ${each.where}` : each.name });
    Object.assign(slider, { type: "range", min: 0, max: 1000, step: "any" });
    slider.setAttribute("aria-label", each.name); slider.dataset.size = each.name;
    mark.style.left = `calc(8px + (100% - 16px) * ${((each.value - each.low) / (each.high - each.low)).toFixed(4)})`;
    Object.assign(box, { type: "text", inputMode: "decimal", autocomplete: "off", spellcheck: false });
    box.setAttribute("aria-label", `${each.name}, ${each.unit}`);
    Object.assign(drop, { type: "button", textContent: "\u00d7", title: say("Hide {name}", { name: each.name }) });
    drop.setAttribute("aria-label", drop.title);
    on(slider, "input", () => {
      const step = nice(each), raw = each.low + ((each.high - each.low) * Number(slider.value)) / 1000, value = round(raw / step) * step;
      put(i, abs(raw - each.value) < 0.006 * (each.high - each.low) ? each.value : min(max(value, each.low), each.high));
    });
    on(box, "change", () => {
      const value = typed(box.value, each), given = { name: each.name, text: box.value };
      if (isNumber(value) && (value > 0 || !each.positive)) return put(i, value, true);
      warn(isNumber(value) ? say("{name} = {text}: a number above zero is expected", given) : expected(each, box.value));
      box.dataset.value = "";
      soon("size");
    });
    on(label, "dblclick", () => put(i, each.value));
    on(drop, "click", () => { chosen = chosen.filter((other) => other !== i); listSizes(); remember(); });
    slide.append(slider, mark); row.append(label, slide, box, unit, drop);
    sizeRows.set(i, { row, slider, box });
    return row;
  })]));
  byId("add").placeholder = say("Find a dimension …");
  byId("others").replaceChildren(...dims.filter((_, i) => !chosen.includes(i)).map((each) => make("option", { value: each.name, label: each.where || "" })));
  showSizes();
}
/* Dimensions by the part that they are of, in the order in which parts come first: [part, their places]. */
const partNames = [...new Set(scene.names.filter((each) => each.includes(".")).map((each) => each.slice(0, each.lastIndexOf("."))))].sort((a, b) => b.length - a.length);
function byPart(list) {
  const found = new Map();
  for (const i of list) {
    const part = partNames.find((each) => dims[i].name.startsWith(`${each}.`)) ?? "";
    found.set(part, [...(found.get(part) ?? []), i]);
  }
  return [...found].sort(([a], [b]) => (a !== "") - (b !== ""));
}
const option = (textContent, value) => make("option", { textContent, value });
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
/* Show the dimension that is looked for: of that name, else the first in whose name the text stands. */
on(byId("add"), "change", ({ target }) => {
  const text = target.value.trim(), others = dims.map((_, i) => i).filter((i) => !chosen.includes(i)), plain = text.toLowerCase();
  const found = others.find((i) => dims[i].name === text) ?? others.find((i) => dims[i].name.toLowerCase().includes(plain));
  if (!text) return;
  target.value = "";
  if (found === undefined) { warn(say("no other dimension is called {text}", { text })); return; }
  chosen.push(found); listSizes(); remember();
});
const called = (each) => (language === "ru" && each.ru) || each.name;
const heading = (each) => (each.unit ? `${called(each)}, ${signed(each.unit)}` : called(each));
function choosers() {
  const all = columns.map((each, i) => option(heading(each) + (each.row === undefined ? " *" : ""), i));
  byId("column").replaceChildren(...all); byId("column").value = String(column);
  byId("second").replaceChildren(option("\u2013", -1), ...all.map((each) => each.cloneNode(true))); byId("second").value = String(second);
  byId("run").replaceChildren(...strokes.map((each, k) => option(titled(each), k))); byId("run").value = String(runs);
  const cases = data.cases.map((name, k) => [name, k]).filter(([name, k]) => k === caseNow() || data.timeOf[k] === data.timeOf[caseNow()] && name !== data.cases[caseNow()]);
  byId("case").replaceChildren(...cases.map(([name, k]) => option(caseTitle(name), k))); byId("case").value = String(caseNow());
  for (const [id, count] of Object.entries({ runs: strokes.length - 1, cases: cases.length - 1, forces: data.arrows.length })) byId(id).style.display = count ? "" : "none";
  byId("forces").setAttribute("aria-pressed", String(showsForces));
  if (data.task) answersSaid();
}
on(byId("column"), "change", (event) => { column = Number(event.target.value); soon("curve"); remember(); });
on(byId("second"), "change", (event) => { second = Number(event.target.value); soon("curve"); remember(); });
on(byId("run"), "change", (event) => { runsOn(Number(event.target.value)); clock = phaseNow(); choosers(); soon("design"); remember(); });
on(byId("case"), "change", (event) => { acting = Number(event.target.value); soon("fit"); remember(); });
on(byId("forces"), "click", () => { showsForces = !showsForces; choosers(); soon("fit"); remember(); });
on(byId("reset"), "click", () => { present = [...original]; stands = firstStand(); runs = data.run; acting = -1; begin(); chosen = [...data.shown]; column = data.column; second = -1; play(false); warn(""); listSizes(); choosers(); whole(); soon("fit"); remember(); });
on(byId("copy"), "click", () => copied(`${location.href.split("#")[0]}#${told()}`, byId("copy").firstChild));
on(byId("language"), "click", () => { language = language === "ru" ? "en" : "ru"; speak(); remember(); });
on(byId("look"), "click", () => { look(root.dataset.look === "dark" ? "light" : "dark"); chosenLook = true; remember(); });
function speak() {
  labelled();
  document.querySelector("h1").textContent = document.title = language === "ru" ? data.titleRu : data.title;
  for (const name of ["undo", "redo", "nearer", "farther", "whole", "grid", "measure"]) byId(name).setAttribute("aria-label", byId(name).title);
  byId("system").replaceChildren(option(say("units as given"), ""), ...Object.keys(data.systems).map((name) => option(data.systemNames[name], name)));
  byId("system").value = system;
  byId("play").setAttribute("aria-label", playing ? say("Pause") : say("Play"));
  toldBefore = hereBefore = "";
  listSizes(); choosers(); compared(); soon("fit");
}

/* ---- a link that restores the state ---- */

function told() {
  const said = new URLSearchParams();
  followed(stands).forEach((value, k) => said.set(`s.${strokes[k].name}`, String(value)));
  dims.forEach((each, i) => { if (present[i] !== each.value || each.name in data.defaults) said.set(`d.${each.name}`, String(present[i])); });
  for (const name in data.beside) said.set(`d.${name}`, String(data.beside[name]));
  if (runs !== data.run) said.set("run", strokes[runs].name);
  if (column !== data.column) said.set("column", columns[column].name);
  if (second >= 0) said.set("with", columns[second].name);
  if (String(chosen) !== String(data.shown)) said.set("show", chosen.map((i) => dims[i].name).join(" "));
  if (showsForces) said.set("forces", "1");
  if (acting >= 0) said.set("case", data.cases[acting]);
  if (language !== data.language) said.set("language", language);
  if (chosenLook) said.set("look", root.dataset.look);
  if (system) said.set("units", system);
  for (const { letter, design } of kept) said.set(`k.${letter}`, dims.map((each, i) => (design[i] !== each.value ? `${each.name}:${design[i]}` : "")).filter(Boolean).join(" "));
  return said.toString();
}
let writing;
function remember() {
  clearTimeout(writing);
  writing = setTimeout(() => { noted(); if (!playing) try { history.replaceState(null, "", `#${told()}`); } catch { /* a page in a frame has no address of its own */ } }, 250);
}
function recall(text = location.hash.slice(1)) {
  const said = new URLSearchParams(text), index = (list, name) => list.findIndex((each) => each.name === name);
  const number = (text, fallback) => (text !== null && text.trim() && isNumber(Number(text)) ? Number(text) : fallback);
  if (![...said.keys()].some((each) => /^[sd]\./.test(each))) return false;
  const at = strokes.map((each) => within(number(said.get(`s.${each.name}`), each.at), each));
  const design = dims.map((each) => { const value = number(said.get(`d.${each.name}`), each.value); return each.positive && !(value > 0) ? each.value : value; });
  runs = index(strokes, said.get("run")) < 0 ? data.run : index(strokes, said.get("run"));
  showsForces = said.get("forces") === "1";
  acting = -1; acting = actingIn(said.get("case"));
  column = index(columns, said.get("column")) < 0 ? data.column : index(columns, said.get("column"));
  second = index(columns, said.get("with"));
  if (said.has("show")) chosen = said.get("show").split(" ").map((each) => byName.get(each)).filter((i) => i !== undefined);
  if (["en", "ru"].includes(said.get("language"))) language = said.get("language");
  if (["light", "dark"].includes(said.get("look"))) { look(said.get("look")); chosenLook = true; }
  if (said.has("units")) inSystem(said.get("units"));
  kept = [...said.keys()].filter((each) => /^k\.[A-H]$/.test(each)).map((each) => {
    const other = new Map(said.get(each).split(" ").map((pair) => pair.split(":")));
    return { letter: each.slice(2), design: dims.map(({ name, value, positive }) => { const found = number(other.get(name) ?? null, value); return positive && !(found > 0) ? value : found; }) };
  });
  present = [...original]; stands = firstStand();
  begin();
  taken(design, at);
  return true;
}
on(window, "hashchange", () => { if (recall()) { play(false); speak(); soon("design"); } });

/* ---- one frame at a time ---- */

const period = () => { const { path, unit, start, end } = strokes[runs]; return path && unit ? end - start : 5; }; /* seconds for there and back, or once round */
let playing = false, clock = 0, last = null, waiting = false, todo = new Set(), later;
let comparing, baseAt = "";
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
    clock = (clock + ((time - (last ?? time)) / 1000 / period()) * Number(byId("speed").value)) % 1;
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
  /* The delivered design along the same stroke is worked out again only where another stroke stands elsewhere. */
  const beside = isMoved() ? JSON.stringify([runs, followed(stands).map((value, k) => (isDriven(k) ? 0 : value))]) : "";
  if (beside !== baseAt || !base) { base = beside ? sweep(original, stands, runs) : first; baseAt = beside; }
  pose = single(present, stands);
  if (anew || sized) { edition++; const was = [zoom, left0, top0].join(); if (!gripped) { fit(!sized, room()); pullScale(); roomForArrows(); closer(); } pullScale(); pressureScale(); if (sized || !parts.length || was !== [zoom, left0, top0].join()) build(); legend(); }
  if (anew || sized || work.has("curve")) plotted();
  if (kept.length && (anew || work.has("curve"))) { clearTimeout(comparing); comparing = setTimeout(compared, 200); }
  const at = scene.names.map((_, p) => px(...spot(pose, p, 0)));
  arrows = [];
  for (const part of parts) part(at);
  mark(chart.one, chart.values, chart.y, chart.marker, "value");
  mark(chart.two, chart.others, chart.y2, chart.second, "other");
  followed(stands).forEach((value, k) => {
    const each = strokes[k];
    const [low, high] = reachOf(each);
    each.slider.value = String((1000 * (value - low)) / (high - low));
    const text = each.path && !each.unit ? say("place {n} of {count}", { n: short(value, 2), count: each.end }) : standing(each, value);
    if (document.activeElement !== each.out) each.out.value = text;
    each.slider.setAttribute("aria-valuetext", text);
  });
  if (anew || sized || work.has("size")) showSizes();
  if (anew || sized) { asking.laid(vector(present)); if (!toldBefore) judge(); else { clearTimeout(later); later = setTimeout(() => judge(down.size ? DRAGGING : STILL), REST); } }
  here();
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
