/* ---- by hand: what is seen of the sheet, joints that are led, lengths that follow, what was done, measured and read ---- */

/* How much closer than the whole the sheet is seen, and what it is moved by [px]. */
const seen = { k: 1, x: 0, y: 0 };
function closer() {
  zoom *= seen.k; left0 = seen.k * left0 + seen.x; top0 = seen.k * top0 + seen.y;
  unit0 *= seen.k > 1 ? seen.k ** 0.5 : seen.k;
}
function whole() { Object.assign(seen, { k: 1, x: 0, y: 0 }); }
/* See the sheet closer by a factor, about a place that stays [px]. */
function nearer(by, [x, y] = [0.5 * sheetWide, 0.5 * sheetTall]) {
  const k = min(max(seen.k * by, 0.2), 60), f = k / seen.k;
  Object.assign(seen, { k, x: x + f * (seen.x - x), y: y + f * (seen.y - y) });
  soon("fit");
}
on(sheet, "wheel", (event) => {
  if (!event.ctrlKey && !event.metaKey) return;
  event.preventDefault();
  nearer(Math.exp(-0.002 * event.deltaY * (event.deltaMode ? 30 : 1)), spotOf(event));
});
/* One finger or the mouse moves the sheet where nothing is gripped; two fingers move it and see it closer. */
const pinched = new Map();
on(sheet, "pointerdown", (event) => {
  if (gripped) return;
  if (measuring) { measure(spotOf(event)); return; }
  if (event.pointerType === "touch" && !pinched.size && !event.isPrimary) return;
  pinched.set(event.pointerId, spotOf(event));
  if (event.pointerType !== "touch" || pinched.size > 1) sheet.setPointerCapture(event.pointerId);
});
on(sheet, "pointermove", (event) => {
  if (!pinched.has(event.pointerId)) return;
  const was = [...pinched.values()], far = () => { const [a, b] = [...pinched.values()]; return b ? apart(a, b) : 0; };
  const wide = far(), from = centroid(was);
  pinched.set(event.pointerId, spotOf(event));
  if (event.pointerType === "touch" && pinched.size < 2) return;
  const to = centroid([...pinched.values()]);
  seen.x += to[0] - from[0]; seen.y += to[1] - from[1];
  if (wide > 0) nearer(far() / wide, to);
  soon("fit");
});
for (const end of ["pointerup", "pointercancel", "lostpointercapture"]) on(sheet, end, (event) => pinched.delete(event.pointerId));
on(sheet, "dblclick", () => { whole(); soon("fit"); });
on(byId("nearer"), "click", () => nearer(1.4));
on(byId("farther"), "click", () => nearer(1 / 1.4));
on(byId("whole"), "click", () => { whole(); soon("fit"); });

/* A grid of round lengths, on which pins then stand when they are dragged; without it on whole millimetres. */
let showsGrid = false;
function snapped(value) { const step = showsGrid ? meshes() / 5 : 1e-3; return tidy(round(value / step) * step, 9); }
const tidy = (value, digits) => Number(value.toFixed(digits));
function gridded() {
  if (!showsGrid) return [];
  const step = meshes();
  meshed(step, "mesh");
  draw(sheet, "text", { x: sheetWide - 52, y: 20, class: "halo", anchor: "end" }).textContent = say("grid {step}", { step: shown(step, data.length, 3) });
  return [];
}
on(byId("grid"), "click", () => { showsGrid = !showsGrid; byId("grid").setAttribute("aria-pressed", String(showsGrid)); soon("fit"); });

/* ---- joints that are led, and lengths that follow ---- */

/* Return the numbers with which some residuals are least, by damped steps with differences; each number stays in its range. */
function solved(first, ranges, residuals) {
  let at = [...first], misses = residuals(at), damping = 1e-6;
  const size = (list) => (list ? list.reduce((sum, each) => sum + each * each, 0) : Infinity), least = (list) => list.reduce((a, b) => max(a, abs(b)), 0);
  for (let turn = 0; misses && turn < 40; turn++) {
    const wide = ranges.map(([low, high]) => high - low), slopes = at.map((value, k) => {
      const h = 1e-6 * wide[k] * (value + 1e-6 * wide[k] > ranges[k][1] ? -1 : 1), found = residuals(at.map((each, j) => (j === k ? each + h : each)));
      return found ? found.map((each, i) => ((each - misses[i]) / h) * wide[k]) : misses.map(() => 0);
    });
    const normal = slopes.map((a, j) => slopes.map((b, k) => a.reduce((sum, each, i) => sum + each * b[i], 0) + (j === k ? damping : 0) * (1 + a.reduce((sum, each) => sum + each * each, 0))));
    const step = engine.linear([...normal.flat(), ...slopes.map((a) => -a.reduce((sum, each, i) => sum + each * misses[i], 0))]);
    const next = at.map((value, k) => min(max(value + step[k] * wide[k], ranges[k][0]), ranges[k][1])), found = residuals(next);
    if (size(found) < size(misses)) { const done = least(next.map((each, k) => (each - at[k]) / wide[k])) < 1e-10; at = next; misses = found; damping = max(damping / 10, 1e-12); if (done) break; } else if (damping > 1e6) break; else damping *= 10;
  }
  return { at, misses };
}
/* Lead a joint to a place, or as near as the strokes bring it; what ends it is said. */
function led(point, to) {
  const runsAlong = strokes[runs].path ? [runs] : own.map((_, k) => k), ends = runsAlong.map((k) => reachOf(strokes[k]));
  const standing = (values) => { const at = [...stands]; runsAlong.forEach((k, j) => { at[k] = values[j]; }); return at; };
  const off = (values) => { const found = single(present, standing(values)); return found.reason[0] === 0 ? spot(found, point, 0).map((each, axis) => each - to[axis]) : null; };
  const { at, misses } = solved(runsAlong.map((k) => stands[k]), ends, off);
  if (!misses) return false;
  const isMet = (value, [low, high]) => min(abs(value - low), abs(value - high)) <= 1e-9 * (high - low || 1);
  const held = runsAlong.filter((k, j) => isMet(at[j], ends[j])), away = hypot(...misses);
  stands = standing(at);
  const named = held.map((k) => `${titled(strokes[k])} = ${shown(stands[k], strokes[k], 4)}`).join(", "), isShort = away > 2e-3;
  const beyond = isShort && (named ? say("{name} ends here: {strokes} is the end of the stroke, {gap} short", { name: scene.names[point], strokes: named, gap: shown(away, data.length, 3) }) : barred(point, to, runsAlong, at, ends));
  warn(beyond || "");
  return !beyond;
}
/* Return what ends a way where a step cannot be placed a little beyond; null where nothing does. */
function barred(point, to, names, at, ends) {
  const aside = (k, j, sign) => single(present, stands.map((value, i) => (i === k ? value + sign * 1e-3 * (ends[j][1] - ends[j][0]) : value)));
  for (const [j, k] of names.entries()) for (const sign of [-1, 1]) {
    const there = aside(k, j, sign), back = aside(k, j, -sign);
    if (there.reason[0] !== 0 && back.reason[0] === 0 && apart(to, spot(back, point, 0)) > apart(to, spot(single(present, stands), point, 0))) return why(there, 0, say("{what} stops here", { what: scene.names[point] }));
  }
  return null;
}
/* Change the dimensions that meet at a joint so that it stands at a place, all other joints where they are. */
function reshaped(point, to) {
  const found = data.meets[point] || [], name = scene.names[point];
  if (!found.length) { warn(say("no length of its own meets at {name}", { name })); return false; }
  const others = scene.names.map((_, p) => p).filter((p) => p !== point), before = others.map((p) => gripped.places[p]), design = (values) => { const all = [...present]; found.forEach((i, j) => { all[i] = values[j]; }); return all; };
  const off = (values) => {
    const at = single(design(values), stands);
    if (at.reason[0] !== 0) return null;
    return [...spot(at, point, 0).map((each, axis) => 10 * (each - to[axis])), ...others.flatMap((p, k) => spot(at, p, 0).map((each, axis) => each - before[k][axis]))];
  };
  const reach = scene.box[1] - scene.box[0] + scene.box[3] - scene.box[2];
  const { at, misses } = solved(found.map((i) => present[i]), found.map((i) => (dims[i].positive ? [1e-6, max(present[i], reach)] : ((wide) => [present[i] - wide, present[i] + wide])(dims[i].base in LENGTHS ? reach : PI))), off);
  if (!misses) return false;
  gripped.changes = found;
  const whole = design(at.map((value) => tidy(value, 5))), left = others.reduce((most, _, k) => max(most, hypot(misses[2 * k + 2], misses[2 * k + 3])), 0), away = 0.1 * hypot(misses[0], misses[1]);
  const ok = moved(whole, stands, name);
  if (ok && left > 1e-3) warn(say("other joints give way by {gap}: {name} has too few lengths of its own", { name, gap: shown(left, data.length, 3) }));
  else if (ok && away > 2e-3) warn(say("{name} stays {gap} short: it has too few lengths of its own", { name, gap: shown(away, data.length, 3) }));
  return ok;
}

/* ---- what was done: back and forth ---- */

/* What is moved with one press, however slowly, is one thing done: it is noted when nothing is pressed any more. */
let done = [], undone = [];
const down = new Set();
addEventListener("pointerdown", (event) => { noted(); down.add(event.pointerId); }, true);
for (const end of ["pointerup", "pointercancel"]) addEventListener(end, (event) => { down.delete(event.pointerId); remember(); }, true);
const state = () => JSON.stringify([present, stands, runs, chosen]);
/* Whether the present state is the last one noted; while it plays, whether the design is. */
function isNoted() {
  if (!done.length || !playing) return done[done.length - 1] === state();
  const [design, , run, sizes] = JSON.parse(done[done.length - 1]);
  return JSON.stringify([design, run, sizes]) === JSON.stringify([present, runs, chosen]);
}
function noted() {
  if (!down.size && !isNoted()) { done.push(state()); undone = []; if (done.length > 400) done.shift(); }
  keysOf();
}
function keysOf() { byId("undo").disabled = done.length < 2; byId("redo").disabled = !undone.length; }
function backAt(text) {
  [present, stands, runs, chosen] = JSON.parse(text);
  play(false); warn(""); listSizes(); choosers(); soon("design"); keysOf();
}
function undo() {
  noted();
  if (done.length > 1) { undone.push(done.pop()); backAt(done[done.length - 1]); }
}
function redo() { if (undone.length) { done.push(undone.pop()); backAt(done[done.length - 1]); } }
on(byId("undo"), "click", undo);
on(byId("redo"), "click", redo);
on(document, "keydown", (event) => {
  if (event.key === "Escape" && measuring) { marks = []; soon("fit"); }
  if (!(event.ctrlKey || event.metaKey) || event.altKey || /^(INPUT|TEXTAREA)$/.test(event.target.tagName) && event.target.type !== "range") return;
  const key = event.key.toLowerCase();
  if (key === "z" || key === "y") { event.preventDefault(); if (key === "y" || event.shiftKey) redo(); else undo(); }
});

/* ---- distances and angles: two places, or three with the angle at the second ---- */

let measuring = false, marks = [];
on(byId("measure"), "click", () => { measuring = !measuring; marks = []; byId("measure").setAttribute("aria-pressed", String(measuring)); sheet.classList.toggle("measuring", measuring); soon("fit"); });
function measure(at) {
  const near = scene.names.map((_, p) => [apart(px(...spot(pose, p, 0)), at), p]).sort((a, b) => a[0] - b[0])[0];
  if (marks.length > 2) marks = [];
  marks.push(near && near[0] < 16 ? { point: near[1] } : { x: (at[0] - left0) / zoom, y: (top0 - at[1]) / zoom });
  soon("fit");
}
const marked = ({ point, x, y }) => (point === undefined ? [x, y] : spot(pose, point, 0));
function measured() {
  if (!marks.length) return [];
  const line = draw(sheet, "path", { class: "line", w: 1.6, dash: "5 3", stroke: css("accent") }), text = draw(sheet, "text", { class: "halo note measure", anchor: "middle" });
  const dots = marks.map(() => draw(sheet, "circle", { r: 4, fill: "none", w: 1.6, stroke: css("accent") }));
  return [() => {
    const real = marks.map(marked), at = real.map((each) => px(...each));
    dots.forEach((dot, k) => set(dot, { cx: at[k][0], cy: at[k][1] }));
    set(line, { d: broken(at) });
    if (real.length < 2) { text.textContent = ""; return; }
    const said = measureText(real), middle = real.length > 2 ? at[1] : [0.5 * (at[0][0] + at[1][0]), 0.5 * (at[0][1] + at[1][1])];
    text.textContent = said;
    set(text, { x: min(max(middle[0], 60), sheetWide - 60), y: min(max(middle[1] - 10, 14), sheetTall - 6) });
  }];
}
function measureText(real) {
  if (real.length === 2) return shown(apart(...real), data.length, 5);
  const [a, b, c] = real, turn = atan2(c[1] - b[1], c[0] - b[0]) - atan2(a[1] - b[1], a[0] - b[0]), half = abs(((turn + 3 * PI) % (2 * PI)) - PI);
  return `${fixed((half * 180) / PI, 2)}\u00b0`;
}

/* ---- the curve read at the mouse; a press moves the stroke there ---- */

let glass = null;
function under(event) {
  const box = plot.getBoundingClientRect(), { along, x } = chart, at = event.clientX - box.left, a = x(along[0]), b = x(along[along.length - 1]);
  return { share: min(max((at - a) / (b - a || 1), 0), 1), at: min(max(at, min(a, b)), max(a, b)) };
}
on(plot, "pointermove", (event) => {
  if (!chart || !glass || !chart.values) return;
  const { share, at } = under(event), { values, one } = chart, stroke = strokes[runs], place = stroke.start + (stroke.end - stroke.start) * share;
  const box = plot.getBoundingClientRect(), isRight = at > 0.5 * box.width;
  set(glass.line, { x1: at, x2: at, y1: 10, y2: box.height - 40, visibility: "visible" });
  glass.text.textContent = `${titled(stroke)} = ${short(place / stroke.factor, 4) + unitText(stroke.unit)}: ${readOff(valueAt(values, place), values, one)}`;
  set(glass.text, { x: at + (isRight ? -8 : 8), y: 22, anchor: isRight ? "end" : "start", visibility: "visible" });
  if (plot.hasPointerCapture(event.pointerId)) strokeTo(share);
});
on(plot, "pointerleave", () => { if (glass) for (const each of Object.values(glass)) set(each, { visibility: "hidden" }); });
function strokeTo(share) { const each = strokes[runs]; each.put(each.start + (each.end - each.start) * share); }
on(plot, "pointerdown", (event) => { if (chart) { plot.setPointerCapture(event.pointerId); strokeTo(under(event).share); } });
