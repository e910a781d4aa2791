/* ---- the drawing now: edits, undo, what survives a closed tab ---- */

const STORE = `hydrolinkage board ${location.pathname}`, MOST_UNDO = 300, delivered = JSON.stringify(data.drawing);
for (const word of data.reserved) model.reserved.add(word);
let done = [], undone = [], tool = "move", form = "python", trails = new Set(), targets = null, driver = "";
/* Return the drawing in the pose that is shown. */
function current() {
  const { drawing, places, values } = shownNow;
  return isMoved() ? model.posed(drawing, places, values) : drawing;
}
const has = Object.hasOwn;
/* Return the name that a table has beside those of another one. */
const added = (before, after) => Object.keys(after).find((each) => !has(before, each));
const isMoved = () => Object.keys(shownNow.values).some((name) => shownNow.values[name] !== shownNow.drawing.drives[name].drawn) || Object.entries(shownNow.places).some(([name, [x, y]]) => x !== shownNow.drawing.points[name][0] || y !== shownNow.drawing.points[name][1]);
const snapshot = () => ({ drawing: shownNow.drawing, trails: [...trails], targets: structuredClone(targets) });
/* Take a new drawing, with what changes beside it, as one thing done, and say what happened. One that could not be opened again is refused. */
function commit(next, text, change) {
  const [wrong] = model.check(next);
  if (wrong) { stands(current()); tell(wrong, true); return; }
  done.push(snapshot());
  if (done.length > MOST_UNDO) done.shift();
  undone = [];
  change?.();
  stands(next);
  if (text) tell(text);
}
/* Go back or forth by one thing done. */
function back(from, to, text) {
  if (!from.length) return;
  play("");
  to.push(snapshot());
  const was = from.pop();
  shownNow.pending = []; trails = new Set(was.trails); ({ targets } = was);
  stands(was.drawing);
  tell(text);
}
const undo = () => back(done, undone, say("Undone")), redo = () => back(undone, done, say("Done again"));
/* Show a drawing as it is drawn, and all that follows from it. */
function stands(drawing) {
  Object.assign(shownNow, { drawing, places: structuredClone(drawing.points), values: Object.fromEntries(Object.entries(drawing.drives).map(([name, each]) => [name, each.drawn])) });
  const { picked } = shownNow;
  if (picked && !has(drawing[picked.kind], picked.name)) shownNow.picked = null;
  shownNow.pending = shownNow.pending.filter((each) => has(drawing.points, each));
  if (!has(drawing.drives, driver)) [driver = ""] = Object.keys(drawing.drives);
  trails = new Set([...trails].filter((each) => has(drawing.points, each)));
  if (targets && !has(drawing.points, targets.point)) targets = null;
  shownNow.targets = targets;
  shownNow.run = []; shownNow.trails = {};
  live(); strokeRows(); panel(); out(); keep(); soonRun();
  byId("undo").disabled = !done.length; byId("redo").disabled = !undone.length;
  if (document.activeElement !== byId("title")) byId("title").value = drawing.name;
  redraw();
}
function keep() {
  try { localStorage.setItem(STORE, JSON.stringify({ delivered, drawing: shownNow.drawing, trails: [...trails], targets, lengthUnit, showsGrid })); } catch { /* no storage here: the work can still be saved as a file */ }
}
/* Return what the last visit left, where it was of the same delivered drawing and nothing is wrong with it. */
function kept() {
  try {
    const found = JSON.parse(localStorage.getItem(STORE)), { drawing } = model.read(JSON.stringify(found.drawing));
    if (found.delivered !== delivered || !drawing) return null;
    const isTask = model.size({ points: found.targets?.places || [] }) < model.MOST.metres && typeof found.targets?.point === "string";
    return { drawing, trails: [found.trails].flat().filter((each) => has(drawing.points, each)), targets: isTask ? found.targets : null, unit: String(found.lengthUnit), showsGrid: found.showsGrid !== false };
  } catch { return null; }
}

/* ---- what is said ---- */

let fading;
function tell(text, isBad = false) {
  const box = byId("message");
  box.textContent = text; box.classList.toggle("bad", isBad);
  clearTimeout(fading);
  fading = setTimeout(() => { box.textContent = ""; }, 7000);
}
/* The line under the sheet: what the tool waits for. */
function hint() {
  const { pending } = shownNow, [first] = pending, name = first || "";
  const texts = {
    move: say("Press a part to select it; drag a pin: the machine follows. With Shift, or Reshape, its lengths change."),
    pin: say("Press where a pin is to stand."),
    bar: first ? say("From {name}: press the other end.", { name }) : say("Press both ends of the bar; on the empty sheet a pin is made."),
    plate: first ? say("{names}: press more corners; to finish, {name} again or Enter.", { names: pending.join(", "), name }) : say("Press the corners of the plate, one after the other."),
    fix: say("Press the pins that stand on the frame; again, and they are free."),
    slide: pending.length === 2 ? say("{name} slides on a line through {other}: press the other pin of that link.", { name, other: pending[1] }) : first ? say("{name} slides: press where its line goes, or {name} again for a level one, or a pin of the link that guides it.", { name }) : say("Press the pin that slides."),
    crank: first ? say("{name} is the pivot: press the pin that turns about it.", { name }) : say("Press the fixed pivot, then the pin that turns."),
    cylinder: first ? say("From {name}: press the other end.", { name }) : say("Press both ends of the cylinder."),
    weight: say("Press the pin that carries the weight."),
    path: say("Press pins whose paths are to be drawn."),
    target: first ? say("Press the places that {name} is to pass, in order; Escape ends it.", { name }) : say("Press the pin whose path is a task."),
  };
  byId("hint").textContent = texts[tool];
}
/* The live line: how freely it moves, what is loose, what Python would refuse. */
function live() {
  const { drawing } = shownNow, box = byId("live"), [wrong = ""] = model.lacking(drawing), isDrawn = Object.keys(drawing.links).length + Object.keys(drawing.slides).length + Object.keys(drawing.drives).length > 0;
  if (!isDrawn) { shownNow.loose = []; box.replaceChildren(); return; }
  const { freedom, drives, loose, words, singular } = solver.mobility(drawing);
  shownNow.loose = loose;
  box.replaceChildren(say("Mobility {freedom}, drives: {drives}", { freedom, drives }), make("span", { textContent: [words, wrong].filter(Boolean).join("; ") }));
  box.classList.toggle("bad", drives > 0 && (singular || freedom !== drives || Boolean(wrong)));
}

/* ---- it moves ---- */

/* Bring a drive to a value, or as near as it goes, and say what stops it. */
function driven(name, value) {
  driver = name;
  return taken(solver.run(current(), { [name]: value }));
}
/* Show a pose that the solver found, and say what stopped it. */
function taken({ points, strokes, stopped }) {
  Object.assign(shownNow, { places: points, values: strokes });
  posed(); strokesShown();
  if (stopped) tell(stopped, true);
  return !stopped;
}
let playing = "", sense = 1, clock = 0;
function play(name) {
  playing = name === playing ? "" : name;
  clock = 0;
  if (playing) requestAnimationFrame(frame);
  for (const each of document.querySelectorAll("[data-play]")) {
    const isOn = each.dataset.play === playing;
    each.setAttribute("aria-pressed", String(isOn));
    set(each.querySelector("path"), { d: isOn ? "M6 5h4v14H6zM14 5h4v14h-4z" : "M7 4v16l13-8z" });
  }
}
function frame(time) {
  const each = shownNow.drawing.drives[playing];
  if (!each) return;
  const passed = clock ? min(time - clock, 60) / 1000 : 0, [low, high] = [min(each.start, each.end), max(each.start, each.end)];
  clock = time;
  const turns = each.kind === "crank" && high - low > 2 * PI - 1e-9, value = shownNow.values[playing] + (sense * passed * (high - low)) / 4;
  if (turns && value > high) { shownNow.values[playing] -= high - low; driven(playing, value - (high - low)); } else if (!driven(playing, min(max(value, low), high)) || value <= low || value >= high) sense = value <= low ? 1 : value >= high ? -1 : -sense;
  requestAnimationFrame(frame);
}
/* Soon after a change, go through the stroke: for paths, and for how long rails are. */
let waiting;
function soonRun() { clearTimeout(waiting); waiting = setTimeout(wholeRun, 150); }
function wholeRun() {
  const { drawing } = shownNow;
  if (!driver || playing) return;
  const { poses, stops, values } = solver.sweep(drawing, driver, max(31, min(91, round(1200 / scene.names.length)))), unit = driveUnit(drawing.drives[driver]);
  shownNow.run = poses.filter(Boolean);
  shownNow.trails = Object.fromEntries([...trails].map((point) => [point, poses.map((at) => at && at[point])]));
  const ends = [...values.filter((_, k) => poses[k]), ...stops.map(({ value }) => value)], last = byId("live").lastElementChild;
  if (stops.length && last) last.textContent += `; ${say("{name} goes from {from} to {to}: {why}", { name: driver, from: shown(min(...ends), unit, 4), to: shown(max(...ends), unit, 4), why: stops[0].stopped })}`;
  redraw();
}

/* ---- strokes: a slider, a number and a button each ---- */

const driveUnit = (each) => (each.kind === "crank" ? { factor: PI / 180, unit: "deg" } : data.length);
function strokeRows() {
  const box = byId("strokes");
  box.replaceChildren(...Object.entries(shownNow.drawing.drives).map(([name, each]) => {
    const row = make("div", { className: "stroke" }), button = make("button", { type: "button", title: say("Play {name}", { name }) });
    button.dataset.play = name;
    button.setAttribute("aria-label", say("Play {name}", { name })); button.setAttribute("aria-pressed", "false"); button.setAttribute("aria-keyshortcuts", "Space");
    const sign = draw(button, "svg", { viewBox: "0 0 24 24", "aria-hidden": "true" });
    draw(sign, "path", { d: "M7 4v16l13-8z" });
    const slider = make("input", { type: "range", min: "0", max: "1000" }), text = make("input", { type: "text", autocomplete: "off" });
    for (const one of [slider, text]) { one.dataset.drive = name; one.setAttribute("aria-label", name); }
    on(button, "click", () => { driver = name; play(name); });
    on(slider, "input", () => { play(""); driven(name, each.start + (slider.value / 1000) * (each.end - each.start)); });
    on(text, "change", () => { play(""); const value = typed(text.value, driveUnit(each)); if (isNumber(value)) driven(name, value); strokesShown(true); });
    row.append(button, make("span", { textContent: name }), slider, text);
    return row;
  }));
  strokesShown(true);
}
function strokesShown(isAll = false) {
  for (const one of document.querySelectorAll("[data-drive]")) {
    const name = one.dataset.drive, each = shownNow.drawing.drives[name], value = shownNow.values[name];
    if (one.type === "range") one.value = String((1000 * (value - each.start)) / (each.end - each.start));
    else if (isAll || one !== document.activeElement) one.value = shown(value, driveUnit(each), 4);
  }
}
