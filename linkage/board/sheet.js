/* ---- the sheet: the drawing in the marks of the live page, its view, its grid, and what is chosen on it ---- */

/* What is shown: the drawing, where its points stand [m], its drives' values, poses of the play, paths, the task, and what is picked. */
const shownNow = { drawing: null, places: {}, values: {}, run: [], trails: {}, targets: null, loose: [], picked: null, pending: [], aim: null, cursor: null, hover: "" };
let lengthUnit = "mm", showsGrid = true;
data.length = { factor: LENGTHS.mm, unit: "mm" };
const lengthText = (value, digits = 5) => shown(value, data.length, digits);
const angleText = (value, digits = 4) => shown(value, { factor: PI / 180, unit: "deg" }, digits);

/* The directions in which a support may stand below its pin; the first is the one that is taken where nothing is in its way. */
const SUPPORTS = [-PI / 2, PI / 2, PI, 0];
function supportWay(name) {
  const { drawing, places: at } = shownNow, near = [...Object.values(drawing.links), ...Object.values(drawing.drives).map(({ ends }) => ends)].filter((points) => points.includes(name)).flat();
  const ways = near.filter((each) => each !== name).map((each) => atan2(at[each][1] - at[name][1], at[each][0] - at[name][0]));
  const free = (way) => ways.reduce((least, each) => min(least, acos(cos(each - way))), PI);
  return SUPPORTS.find((way) => free(way) > 0.7) ?? SUPPORTS[0];
}
/* Fill the scene, and the rows of values that its marks read, from the drawing. */
function staged() {
  const { drawing, run } = shownNow, names = Object.keys(drawing.points), index = Object.fromEntries(names.map((each, i) => [each, i]));
  const links = Object.values(drawing.links), slides = Object.values(drawing.slides), rams = Object.entries(drawing.drives).filter(([, { kind }]) => kind === "cylinder");
  const count = (name) => links.filter((points) => points.includes(name)).length;
  const isDot = (name) => count(name) === 1 && ![...drawing.fixed, ...slides.map(({ point }) => point), ...rams.flatMap(([, { ends }]) => ends)].includes(name);
  Object.assign(scene, {
    names, labels: names.map(() => [15, -15]),
    bodies: links.map((points, k) => ({ points: points.map((each) => index[each]), colour: k % 10 })),
    tracks: slides.map(({ point, along }, k) => ({ riders: [index[point]], fixed: isNumber(along), line: [0, 1, 2, 3].map((row) => 2 * names.length + 4 * k + row) })),
    pins: names.filter((each) => !isDot(each)).map((each) => index[each]), dots: names.filter(isDot).map((each) => index[each]),
    grounds: drawing.fixed.map((each) => ({ point: index[each], way: supportWay(each) })),
  });
  rows.points = names.map((_, i) => [2 * i, 2 * i + 1]);
  data.cylinders = rams.map(([name, { ends: [P, Q], start, end }]) => {
    const closed = model.closedLength(drawing, name);
    return { P: index[P], Q: index[Q], aside: 0, drawn: 1, range: [closed + min(start, end), closed + max(start, end)] };
  });
  const all = run.length ? run : [shownNow.places];
  base = now = { values: valuesAt(all), reached: all.map((_, i) => i) };
}
/* Return the rows of values at some poses: places of points, then each slide's line. */
function valuesAt(poses) {
  const { drawing } = shownNow, found = Object.keys(drawing.points).flatMap((name) => [0, 1].map((axis) => poses.map((at) => at[name][axis])));
  for (const { point, along } of Object.values(drawing.slides)) {
    const lines = poses.map((at) => {
      if (isNumber(along)) return [...drawing.points[point], cos(along), Math.sin(along)];
      const [P, Q] = along.map((each) => at[each]), long = apart(P, Q) || 1;
      return [...P, (Q[0] - P[0]) / long, (Q[1] - P[1]) / long];
    });
    found.push(...[0, 1, 2, 3].map((row) => lines.map((line) => line[row])));
  }
  return found;
}
/* Draw everything anew, once before the next picture of the screen. */
let isDue = false;
function redraw() {
  if (!isDue) requestAnimationFrame(drawnAnew);
  isDue = true;
}
function drawnAnew() {
  isDue = false;
  const box = sheet.getBoundingClientRect();
  sheetWide = box.width || 600; sheetTall = box.height || 400; unit0 = 7; edition += 1;
  staged();
  parts = drawn({ first: gridded, over: marked });
  posed();
}
/* Move what is drawn to where its points stand. */
function posed() {
  if (isDue) return;
  pose = { values: valuesAt([shownNow.places]) };
  const at = scene.names.map((each) => px(...shownNow.places[each]));
  arrows = [];
  for (const part of parts) part(at);
}

/* ---- grid and view ---- */

const gridStep = () => (showsGrid ? meshes() / 5 : 10 ** floor(log10(2 / zoom / data.length.factor)) * data.length.factor);
const onGrid = ([x, y]) => [x, y].map((value) => Number((round(value / gridStep()) * gridStep()).toFixed(9)));
function gridded() {
  if (!showsGrid) return [];
  meshed(meshes() / 5, "mesh fine");
  meshed(meshes(), "mesh");
  const text = say("grid {step}", { step: lengthText(meshes(), 3) });
  draw(sheet, "text", { x: 10, y: sheetTall - 10, class: "halo" }).textContent = text;
  const [x, y] = px(0, 0);
  draw(sheet, "path", { class: "cursor", d: `M${x - 9} ${y}h18M${x} ${y - 9}v18` });
  return [];
}
/* See the sheet closer by a factor, about a spot that stays [px]. */
function nearer(by, [x, y] = [0.5 * sheetWide, 0.5 * sheetTall]) {
  const k = min(max(zoom * by, 1), 1e5) / zoom;
  zoom *= k; left0 = x + k * (left0 - x); top0 = y + k * (top0 - y);
}
/* See the whole drawing, with the poses of its play; of an empty sheet about a metre. */
function whole() {
  const box = sheet.getBoundingClientRect(), wide = box.width || 600, tall = box.height || 400;
  const all = [shownNow.places, ...shownNow.run].flatMap((each) => Object.values(each)), edge = min(80, 0.16 * min(wide, tall));
  const [left, right, bottom, top] = all.length ? [0, 1].flatMap((axis) => [all.reduce((a, each) => min(a, each[axis]), Infinity), all.reduce((a, each) => max(a, each[axis]), -Infinity)]) : [-0.2, 1, -0.2, 0.6];
  zoom = min((wide - 2 * edge) / max(right - left, 0.05), (tall - 2 * edge) / max(top - bottom, 0.05));
  left0 = 0.5 * wide - 0.5 * (left + right) * zoom; top0 = 0.5 * tall + 0.5 * (bottom + top) * zoom;
}

/* ---- what is under a spot ---- */

/* Return the nearest pin within some px of a spot, or undefined. */
function pinAt(spot, within = 14) {
  const far = (name) => apart(px(...shownNow.places[name]), spot), near = Object.keys(shownNow.places).filter((each) => far(each) <= within);
  return near.sort((a, b) => far(a) - far(b))[0];
}
/* Return the distance of a spot from a line between two others [px]. */
function offLine([x, y], [a, b], [c, d]) {
  const long = (c - a) ** 2 + (d - b) ** 2 || 1, t = min(max(((x - a) * (c - a) + (y - b) * (d - b)) / long, 0), 1);
  return hypot(x - a - t * (c - a), y - b - t * (d - b));
}
/* Return what stands under a spot, as its kind and its name: a pin, a drive, a link; null where nothing does. */
function thingAt(spot, within = 14) {
  const { drawing, places: at } = shownNow, pin = pinAt(spot, within);
  if (pin) return { kind: "points", name: pin };
  const hit = (points) => {
    const ring = points.map((each) => px(...at[each])), around = ring.length > 2 ? hull(ring) : ring;
    if (around.some((a, i) => offLine(spot, a, around[(i + 1) % around.length]) < 10)) return true;
    const side = (a, b) => (b[0] - a[0]) * (spot[1] - a[1]) - (b[1] - a[1]) * (spot[0] - a[0]);
    return around.length > 2 && around.every((a, i) => side(a, around[(i + 1) % around.length]) > 0);
  };
  const drive = Object.entries(drawing.drives).find(([, { kind, ends }]) => kind === "cylinder" && hit(ends));
  if (drive) return { kind: "drives", name: drive[0] };
  const link = Object.entries(drawing.links).sort(([, a], [, b]) => a.length - b.length).find(([, points]) => hit(points));
  return link ? { kind: "links", name: link[0] } : null;
}

/* ---- marks over the machine ---- */

function marked() {
  const { drawing, picked, pending, loose, aim, cursor } = shownNow, index = scene.names, found = [];
  const ring = (name, radius, kind) => { const i = index.indexOf(name), mark = draw(sheet, "circle", { r: radius, class: kind }); if (i >= 0) found.push((at) => set(mark, { cx: at[i][0], cy: at[i][1] })); };
  const line = (points, kind) => { const mark = draw(sheet, "polyline", { class: kind }), at0 = points.map((each) => index.indexOf(each)); found.push((at) => set(mark, { points: pairs(at0.map((i) => at[i])) })); };
  for (const [name, { kind, ends: [P, Q] }] of Object.entries(drawing.drives)) if (kind === "crank") found.push(turning(index.indexOf(P), index.indexOf(Q), name));
  for (const { point, mass } of Object.values(drawing.weights)) found.push(weighed(index.indexOf(point), mass));
  for (const name of loose) ring(name, 13, "loose");
  const of = picked && drawing[picked.kind]?.[picked.name];
  if (of) for (const name of pointsOf(picked)) ring(name, 12, "picked");
  if (of && picked.kind !== "points") line(pointsOf(picked), "picked");
  if (shownNow.hover) ring(shownNow.hover, 12, "picked under");
  for (const name of pending) ring(name, 16, "picked waiting");
  if (pending.length && aim) {
    const mark = draw(sheet, "polyline", { class: "picked waiting" });
    found.push((at) => set(mark, { points: pairs([...pending.map((each) => at[index.indexOf(each)]), px(...aim)]) }));
  }
  for (const [point, trail] of Object.entries(shownNow.trails)) {
    draw(sheet, "path", { class: "traced", d: broken(trail.map((each) => each && px(...each))) }).dataset.point = point;
  }
  (shownNow.targets?.places || []).forEach((each, i) => {
    const [x, y] = px(...each);
    draw(sheet, "circle", { class: "target", r: 6, cx: x, cy: y });
    draw(sheet, "text", { class: "halo", x: x + 9, y: y - 7 }).textContent = String(i + 1);
  });
  if (cursor) { const [x, y] = px(...cursor); draw(sheet, "path", { class: "cursor", d: `M${x - 14} ${y}h28M${x} ${y - 14}v28` }); draw(sheet, "circle", { class: "cursor", r: 7, cx: x, cy: y }); }
  found.push(...named());
  return found;
}
/* Return the points of what is picked. */
function pointsOf({ kind, name }) {
  const of = shownNow.drawing[kind][name];
  if (kind === "points") return [name];
  if (kind === "slides") return [of.point, ...(isNumber(of.along) ? [] : of.along)];
  return kind === "weights" ? [of.point] : of.ends || of;
}
/* The arrow of a crank about its pivot. */
function turning(P, Q, name) {
  const mark = draw(sheet, "path", { class: "turning" }), text = draw(sheet, "text", { class: "halo note" });
  text.textContent = name;
  return (at) => {
    const begin = atan2(at[Q][1] - at[P][1], at[Q][0] - at[P][0]), r = 22, around = (a, far = r) => [at[P][0] + far * cos(a), at[P][1] + far * Math.sin(a)];
    const arc = [0, 1, 2, 3, 4, 5, 6, 7, 8].map((k) => around(begin - 0.35 - 0.2 * k)), tip = arc[8];
    set(mark, { d: broken([...arc, null, around(begin - 1.72, r + 5), tip, around(begin - 1.68, r - 6)]) });
    arrows.push([arc[0], arc[4]], [arc[4], tip]);
    const [x, y] = around(begin - 1.15, r + 14);
    set(text, { x, y, anchor: "middle" });
  };
}
/* A weight that hangs on a point. */
function weighed(P, mass) {
  const group = draw(sheet, "g", { stroke: css("ink"), fill: css("ink"), w: 1.2 });
  draw(group, "path", { d: "M0 8V24", fill: "none" });
  draw(group, "path", { d: "M-9 24h18l4 16h-26z" });
  const text = draw(group, "text", { x: 18, y: 37, class: "halo", stroke: "none" });
  text.textContent = `${short(mass)}\u2009${signed("kg")}`;
  return (at) => set(group, { transform: `translate(${at[P][0].toFixed(2)} ${at[P][1].toFixed(2)})` });
}
