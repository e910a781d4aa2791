/* ---- the tools: what the pointer, the keyboard and the panel do to the drawing ---- */

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
/* Take a new drawing, with what changes beside it, as one thing done, and say what happened. */
function commit(next, text, change) {
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
  const ends = values.filter((_, k) => poses[k]), last = byId("live").lastElementChild;
  if (stops.length && last && ends.length) last.textContent += `; ${say("{name} goes from {from} to {to}: {why}", { name: driver, from: shown(ends[0], unit, 4), to: shown(ends.at(-1), unit, 4), why: stops[0].stopped })}`;
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
    on(text, "change", () => { play(""); const value = numberOf(text.value, driveUnit(each)); if (isNumber(value)) driven(name, value); strokesShown(true); });
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

/* ---- numbers as they are typed ---- */

/* Return the value [SI] of a text: a plain number is in the unit shown, one with a unit in that; NaN for anything else. */
function numberOf(text, { factor, unit }) {
  const FACTORS = unit === "deg" ? { "": factor, "\u00b0": PI / 180, deg: PI / 180, rad: 1 } : unit === "kg" ? { "": 1, kg: 1, t: 1000 } : { "": factor, mm: 1e-3, cm: 0.01, m: 1, in: 0.0254, ft: 0.3048 };
  const [, number, name] = /^([-+]?(?:\d+[.,]?\d*|[.,]\d+)(?:e[-+]?\d+)?)\s*([^\s\d]*)$/i.exec(text.replace(/\u2212/g, "-").replace(/[\u202f\u2009\u00a0]/g, " ").replace(/(\d) (?=\d{3})/g, "$1").trim()) ?? [];
  if (number === undefined) return NaN;
  const known = Object.keys(FACTORS).find((each) => each === name || signed(each) === name);
  return known === undefined ? NaN : Number((Number(number.replace(",", ".")) * FACTORS[known]).toPrecision(14));
}

/* ---- the panel: what is selected, by its numbers ---- */

function field(label, value, take, given = {}) {
  const row = make("label"), input = make("input", { type: "text", value, autocomplete: "off", spellcheck: false, ...given });
  row.append(make("span", { textContent: label }), input);
  on(input, "change", () => {
    const fault = take(input.type === "checkbox" ? input.checked : input.value);
    input.classList.toggle("bad", Boolean(fault));
    if (fault) tell(fault, true);
  });
  return row;
}
function sized(label, value, thing, take, least = -Infinity) {
  return field(label, value === undefined ? "" : shown(value, thing, 8), (text) => {
    const found = value === undefined && !text.trim() ? 0 : numberOf(text, thing);
    return isNumber(found) && found >= least && abs(found) < 1e6 ? take(found) : say("{text} is no {label}; give a number such as {example}", { text, label, example: shown(value || 0.1, thing, 4) });
  });
}
/* Offer the catalogue's sizes in a field. */
let lists = 0;
function offered(row, sizes) {
  const list = make("datalist", { id: `sizes${(lists += 1)}` });
  list.append(...[...new Set(sizes)].map((each) => make("option", { value: lengthText(each) })));
  row.querySelector("input").setAttribute("list", list.id);
  row.append(list);
  return row;
}
/* The rod of the catalogue that is next to half of a bore, else that half. */
const rodFor = (bore) => data.sizes.pairs.filter(([each]) => abs(each - bore) < 1e-6).map(([, rod]) => rod).sort((a, b) => abs(a - 0.55 * bore) - abs(b - 0.55 * bore))[0] || 0.5 * bore;
function nameField() {
  const { kind, name } = shownNow.picked;
  return field(say("Name"), name, (text) => {
    const to = text.trim();
    if (to === name) return "";
    const fault = model.nameFault(shownNow.drawing, to);
    if (fault) return fault;
    shownNow.picked = { kind, name: to };
    if (driver === name) driver = to;
    commit(model.rename(current(), kind, name, to), say("{name} is now {to}", { name, to }), () => {
      if (kind === "points" && trails.delete(name)) trails.add(to);
      if (kind === "points" && targets?.point === name) targets.point = to;
    });
    return "";
  }, { maxLength: 40 });
}
function button(text, act, key = "") {
  const made = make("button", { type: "button", textContent: text });
  if (key) made.setAttribute("aria-keyshortcuts", key);
  on(made, "click", act);
  return made;
}
function line(...buttons) { const row = make("div", { className: "row" }); row.append(...buttons); return row; }
const note = (text) => make("p", { textContent: text });
/* Return what hangs on a point, and the points of another part, as buttons that select it. */
function relatives() {
  const { drawing, picked: { kind, name } } = shownNow;
  const found = kind === "points" ? ["links", "slides", "drives", "weights"].flatMap((part) => Object.keys(drawing[part]).filter((each) => pointsOf({ kind: part, name: each }).includes(name)).map((each) => [part, each])) : pointsOf(shownNow.picked).map((each) => ["points", each]);
  return found.length ? [line(...found.map(([part, each]) => button(each, () => pick(part, each))))] : [];
}
const FIELDS = {
  points(name) {
    const { drawing } = shownNow, put = (axis) => (value) => { const at = [...shownNow.places[name]]; at[axis] = value; return moved(name, at); };
    return [
      sized("x", shownNow.places[name][0], data.length, put(0)), sized("y", shownNow.places[name][1], data.length, put(1)),
      field(say("Fixed"), "", (isFixed) => { commit(model.fix(current(), name, isFixed)); }, { type: "checkbox", checked: drawing.fixed.includes(name) }),
      field(say("Path"), "", () => traced(name), { type: "checkbox", checked: trails.has(name) }),
    ];
  },
  links(name) {
    const points = shownNow.drawing.links[name], sides = points.length === 2 ? [points] : points.map((each, i) => [each, points[(i + 1) % points.length]]);
    return sides.map(([P, Q]) => sized(P + Q, model.far(current(), P, Q), data.length, (value) => stretched(P, Q, value), 1e-6));
  },
  slides(name) {
    const { along } = shownNow.drawing.slides[name];
    return isNumber(along) ? [sized(say("Angle"), along, { factor: PI / 180, unit: "deg" }, (value) => { commit(model.set(current(), "slides", name, { along: value })); })] : [note(say("on the line {names}", { names: along.join(" ") }))];
  },
  drives(name) {
    const each = shownNow.drawing.drives[name], unit = driveUnit(each), change = (values) => { commit(model.set(current(), "drives", name, values)); };
    const end = (key, label) => sized(label, each[key], unit, (value) => (value === each[key === "start" ? "end" : "start"] ? say("both ends of the stroke are the same") : change({ [key]: value })));
    if (each.kind === "crank") return [end("start", say("from")), end("end", say("to"))];
    const rods = data.sizes.pairs.filter(([bore]) => !each.bore || abs(bore - each.bore) < 1e-6);
    const bores = [offered(sized(say("Bore"), each.bore, data.length, (bore) => (bore > 0 ? change({ bore, rod: each.rod < bore ? each.rod : rodFor(bore) }) : change({ bore: undefined, rod: undefined })), 0), data.sizes.pairs.map(([bore]) => bore))];
    if (each.bore) bores.push(offered(sized(say("Rod"), each.rod, data.length, (rod) => (rod < each.bore ? change({ rod }) : say("the rod is thinner than its bore")), 1e-4), rods.map(([, rod]) => rod)));
    return [
      ...bores,
      sized(say("Closed length"), model.closedLength(current(), name), data.length, (value) => change({ drawn: model.far(current(), ...each.ends) - value }), 1e-4),
      offered(sized(say("Stroke"), each.end - each.start, data.length, (value) => change({ end: each.start + value }), 1e-4), data.sizes.strokes),
      note(say("drawn {length} out", { length: lengthText(shownNow.values[name]) })),
    ];
  },
  weights(name) {
    return [sized(say("Mass"), shownNow.drawing.weights[name].mass, { factor: 1, unit: "kg" }, (mass) => { commit(model.set(current(), "weights", name, { mass })); }, 0)];
  },
};
const kindsNamed = () => ({ points: say("Pin"), links: say("Link"), slides: say("Slide"), drives: say("Drive"), weights: say("Weight") });
function panel() {
  const { drawing, picked } = shownNow, focus = document.activeElement?.closest("#fields") ? [...document.querySelectorAll("#fields input, #fields select, #fields button")].indexOf(document.activeElement) : -1;
  byId("what").textContent = picked ? `${kindsNamed()[picked.kind]} ${picked.name}` : say("Nothing selected");
  const buttons = picked && line(button(say("Delete"), remove, "Delete"), ...(picked.kind === "points" || picked.kind === "links" || picked.kind === "drives" ? [button(say("Duplicate"), duplicate, "Control+D")] : []));
  const begun = Object.keys(drawing.points).length ? [note(say("Press a pin, a link or a cylinder on the sheet to see and type its numbers."))] : [
    note(say("Begin with Crank: press where its pivot is to stand, then where its pin is. Then Bar, from pin to pin. Fix what stands on the frame.")), line(button(say("Or an example"), example))];
  byId("fields").replaceChildren(...(picked ? [nameField(), ...FIELDS[picked.kind](picked.name), buttons, ...relatives()] : begun));
  byId("parts").replaceChildren(...["points", "links", "slides", "drives", "weights"].flatMap((kind) => Object.keys(drawing[kind]).map((name) => {
    const one = button(name, () => pick(kind, name));
    one.title = kindsNamed()[kind];
    one.setAttribute("aria-pressed", String(picked?.kind === kind && picked.name === name));
    return one;
  })));
  if (focus >= 0) [...document.querySelectorAll("#fields input, #fields select, #fields button")][focus]?.focus();
}
function pick(kind, name) {
  shownNow.picked = kind ? { kind, name } : null;
  panel(); redraw();
  if (kind) tell(say("{kind} {name} selected", { kind: kindsNamed()[kind], name }));
}
/* Put a point elsewhere; the lengths that meet there follow. */
function moved(name, [x, y]) {
  commit(model.movePoint(current(), name, x, y), say("{name} stands at {x}, {y}", { name, x: lengthText(x), y: lengthText(y) }));
  return "";
}
/* Give two points of a link another distance, as if a cylinder stood there; all other lengths and the drives stay. */
function stretched(P, Q, value) {
  const from = current(), [moving, still] = from.fixed.includes(Q) ? [P, Q] : [Q, P];
  if (from.fixed.includes(moving)) return say("{P} and {Q} are fixed; their coordinates say how far apart they are", { P, Q });
  let trial = structuredClone(from);
  for (const [name, points] of Object.entries(from.links)) if (points.includes(P) && points.includes(Q)) {
    const others = points.filter((each) => each !== moving), beside = others.find((each) => each !== still);
    delete trial.links[name];
    if (others.length > 1) trial = model.link(model.link(trial, others), [moving, beside]);
  }
  for (const [name, { kind, ends }] of Object.entries(from.drives)) if (kind === "crank" && ends.includes(P) && ends.includes(Q)) {
    const [[x, y], [u, v]] = [still, moving].map((each) => from.points[each]);
    delete trial.drives[name];
    trial = model.slide(trial, moving, atan2(v - y, u - x));
  }
  const name = model.freeName(trial, "length"), { points, stopped } = solver.run(model.cylinder(trial, P, Q, {}, name), { [name]: value - model.far(from, P, Q) });
  if (stopped) return stopped;
  commit(model.posed(from, points), say("{label} is {length}", { label: P + Q, length: lengthText(value) }));
  return "";
}
function remove() {
  const { picked } = shownNow;
  if (!picked) return;
  shownNow.picked = null;
  commit(model.remove(current(), picked.kind, picked.name), say("{name} deleted", { name: picked.name }));
}
function duplicate() {
  const { picked } = shownNow;
  if (!picked) return;
  const points = pointsOf(picked), step = meshes(), from = current(), next = model.duplicate(from, points, step, -step);
  const name = added(from.points, next.points);
  shownNow.picked = { kind: "points", name };
  commit(next, say("{names} duplicated", { names: points.join(", ") }));
}
function traced(name) {
  commit(current(), "", () => { if (!trails.delete(name)) trails.add(name); });
  tell(trails.has(name) ? (driver ? say("The path of {name} is drawn", { name }) : say("The path of {name} is drawn as soon as something drives it", { name })) : say("No path of {name}", { name }));
}
/* A four-bar to begin with. */
function example() {
  let next = model.empty(shownNow.drawing.name);
  for (const [name, x, y] of [["O", 0, 0], ["A", 0.1, 0.05], ["B", 0.4, 0.3], ["C", 0.5, 0], ["P", 0.2, 0.35]]) next = model.addPoint(next, name, x, y);
  next = model.fix(model.fix(next, "O"), "C");
  for (const points of [["A", "B", "P"], ["B", "C"]]) next = model.link(next, points);
  shownNow.picked = null;
  commit(model.crank(next, "O", "A"), say("A four-bar: drag its pins, play it, change it"), () => { trails = new Set(["P"]); });
  whole(); redraw();
}

/* ---- the tools on the sheet ---- */

/* Return a drawing with a pin at a place where none is under it, and the pin's name. */
function pinOf(drawing, name, [x, y]) {
  if (name) return [drawing, name];
  const free = model.freeName(drawing);
  return [model.addPoint(drawing, free, x, y), free];
}
/* Do with two ends what a tool does, the second of which may be made; it is selected. */
function between(kind, act, text) {
  return (name, place) => {
    const { pending } = shownNow;
    if (!pending.length) { wait(name, place); return; }
    if (name === pending[0]) { pendingIs([]); tell(say("Cancelled")); return; }
    const [pinned, other] = pinOf(current(), name, place), next = act(pinned, pending[0], other), made = added(pinned[kind], next[kind]);
    shownNow.pending = [];
    if (made) shownNow.picked = { kind, name: made };
    commit(next, text(pending[0], other));
    hint();
  };
}
function pendingIs(names) { shownNow.pending = names; hint(); redraw(); }
/* Make the pin under the pointer, or the one that is there, the first end. */
function wait(name, place) {
  const [next, first] = pinOf(current(), name, place);
  shownNow.pending = [...shownNow.pending, first];
  if (next !== current() && !name) commit(next, say("Pin {name}", { name: first }));
  pendingIs(shownNow.pending);
}
const TOOLS = {
  move(name, place, spot) {
    const thing = name ? { kind: "points", name } : thingAt(spot);
    pick(thing?.kind, thing?.name);
  },
  pin(name, place) {
    if (name) { pick("points", name); return; }
    const [next, made] = pinOf(current(), name, place);
    shownNow.picked = { kind: "points", name: made };
    commit(next, say("Pin {name}", { name: made }));
  },
  bar: between("links", (drawing, P, Q) => (Object.values(drawing.links).some((each) => each.includes(P) && each.includes(Q)) ? drawing : model.link(drawing, [P, Q])), (P, Q) => say("Bar {P} {Q}", { P, Q })),
  plate(name, place) {
    const { pending } = shownNow;
    if (name && pending.includes(name)) { plated(); return; }
    wait(name, place);
  },
  fix(name, place) {
    const [next, made] = pinOf(current(), name, place), isFixed = !next.fixed.includes(made);
    shownNow.picked = { kind: "points", name: made };
    commit(model.fix(next, made, isFixed), isFixed ? say("{name} is fixed", { name: made }) : say("{name} is free", { name: made }));
  },
  slide(name, place) {
    const { pending } = shownNow, [rider, P] = pending;
    if (!rider) { wait(name, place); return; }
    if (P) {
      if (!name || pending.includes(name)) { tell(say("Press another pin of the link that guides {name}", { name: rider }), true); return; }
      sliding(rider, [P, name]);
    } else if (name && name !== rider && Object.values(shownNow.drawing.links).some((points) => points.includes(name) && !points.includes(rider))) pendingIs([rider, name]);
    else { const [x, y] = shownNow.places[rider]; sliding(rider, name === rider ? 0 : straight(atan2(place[1] - y, place[0] - x))); }
  },
  crank: between("drives", (drawing, P, Q) => model.crank(drawing, P, Q), (P, Q) => say("Crank {P} {Q}", { P, Q })),
  cylinder: between("drives", (drawing, P, Q) => model.cylinder(drawing, P, Q, cylinderOf(drawing, P, Q)), (P, Q) => say("Cylinder {P} {Q}", { P, Q })),
  weight(name) {
    if (!name) { tell(say("Press a pin; a weight hangs on one"), true); return; }
    const found = Object.entries(shownNow.drawing.weights).find(([, { point }]) => point === name);
    if (found) { pick("weights", found[0]); return; }
    const next = model.weight(current(), name, 100), made = added(shownNow.drawing.weights, next.weights);
    shownNow.picked = { kind: "weights", name: made };
    commit(next, say("100 kg on {name}", { name }));
  },
  path(name) { if (name) traced(name); else tell(say("Press a pin"), true); },
  target(name, place) {
    const [point] = shownNow.pending, places = [...(targets?.places || []), place];
    if (!point) { if (name) { targets = null; pendingIs([name]); } else tell(say("Press a pin"), true); return; }
    form = "task";
    commit(current(), say("{name} is to pass {count} places", { name: point, count: places.length }), () => { targets = { point, places }; });
  },
};
/* A direction in steps of 5 degrees. */
const straight = (way) => (round((way * 36) / PI) * PI) / 36;
function sliding(rider, along) {
  const next = model.slide(current(), rider, along), name = added(shownNow.drawing.slides, next.slides);
  shownNow.pending = [];
  shownNow.picked = { kind: "slides", name };
  commit(next, isNumber(along) ? say("{name} slides at {angle}", { name: rider, angle: angleText(along) }) : say("{name} slides on the line {names}", { name: rider, names: along.join(" ") }));
  hint();
}
function plated() {
  const { pending } = shownNow;
  shownNow.pending = [];
  if (pending.length > 1) {
    const next = model.link(current(), pending);
    shownNow.picked = { kind: "links", name: added(shownNow.drawing.links, next.links) };
    commit(next, say("Plate {names}", { names: pending.join(" ") }));
  } else redraw();
  hint();
}
/* Return the sizes of a new cylinder: as drawn it is drawn in; its stroke is of the catalogue, about half of what that leaves room for. */
function cylinderOf(drawing, P, Q) {
  const long = model.far(drawing, P, Q), stroke = data.sizes.strokes.filter((each) => each <= 0.6 * long).pop() || 0.5 * long;
  return { closed: long, stroke };
}
function choose(name) {
  if (tool === "plate" && shownNow.pending.length > 2) plated();
  tool = name;
  sheet.dataset.tool = tool;
  for (const each of document.querySelectorAll("[data-tool]")) if (each !== sheet) each.setAttribute("aria-pressed", String(each.dataset.tool === tool));
  pendingIs([]);
}
/* Do at a spot what the tool does there. */
function press(spot, within) {
  play("");
  const name = pinAt(spot, within);
  TOOLS[tool](name, name ? shownNow.places[name] : onGrid(placeAt(spot)), spot);
}

/* ---- the pointer: press, drag, two fingers, wheel ---- */

const fingers = new Map(), TWO_ENDS = ["bar", "crank", "cylinder"];
let held = null;
on(sheet, "pointerdown", (event) => {
  if (event.button > 1) return;
  const spot = spotOf(event), within = event.pointerType === "touch" ? 24 : 14;
  fingers.set(event.pointerId, spot);
  sheet.setPointerCapture(event.pointerId);
  shownNow.cursor = null;
  if (fingers.size > 1) { held = null; return; }
  held = { spot, within, name: tool === "move" && event.button === 0 ? pinAt(spot, within) : "", isPan: event.button === 1, far: false, from: current(), reshapes: event.shiftKey || byId("reshape").getAttribute("aria-pressed") === "true" };
});
on(sheet, "pointermove", (event) => {
  const spot = spotOf(event);
  if (!fingers.has(event.pointerId)) {
    const name = pinAt(spot), isAiming = shownNow.pending.length && TWO_ENDS.includes(tool);
    if (isAiming) shownNow.aim = onGrid(placeAt(spot));
    if (isAiming || name !== shownNow.hover) redraw();
    shownNow.hover = name;
    return;
  }
  const was = [...fingers.values()], middle = (list) => [0, 1].map((k) => list.reduce((sum, each) => sum + each[k], 0) / list.length);
  fingers.set(event.pointerId, spot);
  const all = [...fingers.values()], [from, to] = [middle(was), middle(all)];
  if (held && !held.far && apart(spot, held.spot) < 6) return;
  if (held) held.far = true;
  if (held?.name) { lead(held, spot); return; }
  if (held && !held.isPan && TWO_ENDS.includes(tool)) {
    if (!shownNow.pending.length) press(held.spot, held.within);
    shownNow.aim = onGrid(placeAt(spot)); redraw();
    return;
  }
  left0 += to[0] - from[0]; top0 += to[1] - from[1];
  if (all.length > 1) nearer(apart(all[0], all[1]) / (apart(was[0], was[1]) || 1), to);
  redraw();
});
/* Lead a pin: a joint takes the machine along as far as it goes, one that is fixed, loose or reshaped takes its lengths along. */
function lead(held, spot) {
  const to = placeAt(spot), { name } = held;
  play("");
  const isOwn = held.reshapes || held.from.fixed.includes(name) || !pointsJoined(held.from, name);
  if (isOwn) {
    const [x, y] = onGrid(to), next = model.movePoint(held.from, name, x, y);
    Object.assign(shownNow, { drawing: next, places: structuredClone(next.points) });
    held.next = next;
    redraw();
    return;
  }
  held.led = true;
  const { stopped, ...found } = solver.drag(current(), name, to);
  taken(found);
  if (stopped && apart(px(...shownNow.places[name]), spot) > 30) tell(stopped, true);
}
const pointsJoined = (drawing, name) => [...Object.values(drawing.links), ...Object.values(drawing.slides).map(({ point }) => [point]), ...Object.values(drawing.drives).map(({ ends }) => ends)].some((points) => points.includes(name));
on(sheet, "pointerup", (event) => {
  const spot = spotOf(event);
  if (!fingers.delete(event.pointerId) || !held) return;
  const { next, led, far, from, within } = held, name = held.name;
  const isLine = far && !name && !held.isPan && TWO_ENDS.includes(tool);
  held = null;
  shownNow.aim = null;
  if (next) { shownNow.drawing = from; shownNow.picked = { kind: "points", name }; commit(next, say("{name} stands at {x}, {y}", { name, x: lengthText(next.points[name][0]), y: lengthText(next.points[name][1]) })); }
  else if (led) { shownNow.picked = { kind: "points", name }; commit(current()); }
  else if (!far || isLine) press(spot, within);
});
on(sheet, "pointercancel", (event) => { fingers.delete(event.pointerId); if (held?.next) stands(held.from); held = null; });
on(sheet, "wheel", (event) => { event.preventDefault(); nearer(Math.exp(-0.0015 * event.deltaY * (event.deltaMode ? 30 : 1)), spotOf(event)); redraw(); }, { passive: false });
on(sheet, "dblclick", () => { if (tool === "plate") plated(); });

/* ---- the keyboard ---- */

/* Move the cursor by steps of the grid, and the view with it. */
function step(dx, dy, by) {
  const from = shownNow.cursor || onGrid(placeAt([0.5 * sheetWide, 0.5 * sheetTall])), size = gridStep() * by;
  shownNow.cursor = shownNow.cursor ? onGrid([from[0] + dx * size, from[1] + dy * size]) : from;
  const [x, y] = px(...shownNow.cursor), edge = 30;
  left0 += x < edge ? edge - x : x > sheetWide - edge ? sheetWide - edge - x : 0;
  top0 += y < edge ? edge - y : y > sheetTall - edge ? sheetTall - edge - y : 0;
  redraw();
  const name = pinAt(px(...shownNow.cursor), 8);
  tell([name, `${lengthText(shownNow.cursor[0])}, ${lengthText(shownNow.cursor[1])}`].filter(Boolean).join(": "));
}
/* Move the cursor to the next or the last pin. */
function hop(by) {
  const names = Object.keys(shownNow.places), here = shownNow.cursor && pinAt(px(...shownNow.cursor), 3);
  if (!names.length) return;
  const name = names[(names.indexOf(here) + (here ? by : by > 0 ? 1 : 0) + names.length) % names.length];
  shownNow.cursor = [...shownNow.places[name]];
  redraw();
  tell(`${name}: ${lengthText(shownNow.cursor[0])}, ${lengthText(shownNow.cursor[1])}`);
}
function escaped() {
  if (shownNow.pending.length) pendingIs([]);
  else if (tool !== "move") choose("move");
  else pick(null);
}
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
const KEYS = {
  Delete: remove, Backspace: remove, Escape: escaped, ".": () => hop(1), ",": () => hop(-1),
  "+": () => { nearer(1.25); redraw(); }, "=": () => { nearer(1.25); redraw(); }, "-": () => { nearer(0.8); redraw(); }, 0: () => { whole(); redraw(); },
  " ": () => { if (driver) play(driver); }, g: () => byId("grid").click(), r: () => byId("reshape").click(),
};
const CONTROL = { z: () => undo(), y: () => redo(), s: () => save(), o: () => byId("file").click(), d: duplicate };
on(document, "keydown", (event) => {
  const { target, key } = event, isTyping = target.closest("textarea, select, input:not([type=checkbox]):not([type=range])"), low = key.toLowerCase();
  if ((event.ctrlKey || event.metaKey) && !event.altKey) {
    if (!(low in CONTROL) || (isTyping && low === "z" && target.matches("textarea"))) return;
    event.preventDefault();
    if (low === "z" && event.shiftKey) redo(); else CONTROL[low]();
    return;
  }
  if (isTyping || event.altKey) { if (key === "Escape" && isTyping) sheet.focus(); return; }
  if (target === sheet && key in ARROWS) { event.preventDefault(); step(...ARROWS[key], event.shiftKey ? 10 : 1); return; }
  if (target === sheet && key === "Enter") {
    event.preventDefault();
    if (tool === "plate" && shownNow.pending.length > 2 && pinAt(px(...shownNow.cursor), 8) === shownNow.pending.at(-1)) plated();
    else if (shownNow.cursor) press(px(...shownNow.cursor), 8);
    return;
  }
  const chosen = document.querySelector(`button[data-tool][aria-keyshortcuts="${CSS.escape(key.toUpperCase())}"]`), act = chosen ? () => { choose(chosen.dataset.tool); sheet.focus(); } : KEYS[key] || KEYS[low];
  if (!act || (key === " " && target.matches("button, input"))) return;
  event.preventDefault();
  act();
});

/* ---- out and in ---- */

const FORMS = {
  python: () => [writers.python(shownNow.drawing), `${fileName()}.py`],
  toml: () => [writers.toml(shownNow.drawing), `${fileName()}.toml`],
  link: () => [`${location.href.split("#")[0]}#${writers.address(shownNow.drawing)}`, `${fileName()}_address.txt`],
  file: () => [writers.file(shownNow.drawing), `${fileName()}.json`],
  task: () => [taskText(), `${fileName()}_task.toml`],
};
const fileName = () => shownNow.drawing.name.toLowerCase();
/* Show the machine as a text, and the commands that go on from there. */
function out(which = form) {
  form = which;
  for (const each of document.querySelectorAll("[data-form]")) each.setAttribute("aria-pressed", String(each.dataset.form === form));
  const wrong = form === "file" ? [] : model.lacking(shownNow.drawing), name = fileName();
  const isReady = !wrong.length && Object.keys(shownNow.drawing.points).length > 0;
  let text = "";
  try { text = isReady || form === "file" || form === "link" ? FORMS[form]()[0] : ""; } catch (error) { text = `# ${error.message}`; }
  byId("text").value = text || say("Not yet a machine: {wrong}", { wrong: wrong.join("; ") });
  byId("copy-text").disabled = byId("hand").disabled = !text;
  const file = form === "file" ? `${name}.json` : form === "toml" ? `${name}.toml` : `${name}.py`;
  const lines = form === "task" ? [`hydrolinkage synthesise ${name}_task.toml --page found.html`] : [`hydrolinkage show ${file}`, `hydrolinkage page ${file} -o ${name}.html`, `hydrolinkage report ${file} -o ${name}_report.html`];
  byId("commands").replaceChildren(...lines.map((each) => {
    const row = make("div"), copy = button(say("Copy"), () => copied(each, copy));
    copy.setAttribute("aria-label", `${say("Copy")} ${each}`);
    row.append(make("code", { textContent: each }), copy);
    return row;
  }));
}
/* The task of a synthesis: the point, the places it is to pass, and how far its lengths may go. */
function taskText() {
  const { drawing } = shownNow;
  if (!targets?.places.length) return "";
  const free = Object.values(drawing.links).flatMap((points) => points.slice(1).map((each) => [points[0], each])).filter((pair) => !pair.every((each) => drawing.fixed.includes(each)));
  const number = (value) => String(Number((1000 * value).toPrecision(6)));
  const lines = [`machine = "${fileName()}.toml"`, "", "[synthesis]", `path = { of = "${targets.point}", points = [${targets.places.map((at) => `[${at.join(", ")}]`).join(", ")}] }`, "starts = 8", "", "[synthesis.vary]"];
  for (const [P, Q] of free) { const long = model.far(drawing, P, Q); lines.push(`${P}${Q} = "${number(0.5 * long)} to ${number(2 * long)} mm"`); }
  for (const [P, Q, ...others] of Object.values(drawing.links)) for (const X of others) {
    const way = (to) => atan2(...[1, 0].map((axis) => drawing.points[to][axis] - drawing.points[P][axis])), turn = round((((way(X) - way(Q)) / PI) * 180 + 540) % 360 - 180);
    lines.push(`${Q}${P}${X} = "${turn - 45} to ${turn + 45} deg"`);
  }
  return `${lines.join("\n")}\n`;
}
async function copied(text, word) {
  try { await navigator.clipboard.writeText(text); } catch {
    const area = make("textarea", { value: text });
    document.body.append(area); area.select(); document.execCommand("copy"); area.remove();
  }
  tell(say("Copied"));
  word.focus();
}
function handed(text, name) {
  const link = make("a", { href: URL.createObjectURL(new Blob([text], { type: "text/plain" })), download: name });
  document.body.append(link); link.click(); link.remove();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}
function save() { handed(...FORMS.file()); tell(say("Saved as {name}", { name: `${fileName()}.json` })); }
/* Open what a text holds: a file of the board or a link; what is wrong with it is said, and the sheet stays. */
function opened(text) {
  const { drawing, wrong } = writers.opened(text);
  if (!drawing) { tell(wrong[0] || say("This is no drawing of the board."), true); return false; }
  shownNow.picked = null; shownNow.pending = [];
  commit(drawing, say("{name} is open", { name: drawing.name }));
  whole(); redraw();
  return true;
}
on(byId("file"), "change", async ({ target }) => {
  const [file] = target.files;
  if (file && file.size <= model.MOST.bytes) opened(await file.text()); else if (file) tell(say("This file is too large for a drawing."), true);
  target.value = "";
});
on(byId("take"), "click", () => { if (opened(byId("text-in").value)) byId("text-in").value = ""; });
on(sheet, "dragover", (event) => event.preventDefault());
on(sheet, "drop", async (event) => { event.preventDefault(); const [file] = event.dataTransfer.files; if (file && file.size <= model.MOST.bytes) opened(await file.text()); });

/* ---- buttons ---- */

for (const each of document.querySelectorAll("button[data-tool]")) on(each, "click", () => choose(each.dataset.tool));
for (const each of document.querySelectorAll("[data-form]")) on(each, "click", () => out(each.dataset.form));
on(byId("undo"), "click", undo); on(byId("redo"), "click", redo);
on(byId("nearer"), "click", () => { nearer(1.25); redraw(); }); on(byId("farther"), "click", () => { nearer(0.8); redraw(); });
on(byId("whole"), "click", () => { whole(); redraw(); });
on(byId("grid"), "click", () => { showsGrid = !showsGrid; byId("grid").setAttribute("aria-pressed", String(showsGrid)); keep(); redraw(); });
on(byId("reshape"), "click", () => { const isOn = byId("reshape").getAttribute("aria-pressed") !== "true"; byId("reshape").setAttribute("aria-pressed", String(isOn)); tell(isOn ? say("Lengths follow the pin that is led") : say("Lengths stay; the machine follows")); });
on(byId("fresh"), "click", () => { if (Object.keys(shownNow.drawing.points).length) { shownNow.picked = null; commit(model.empty(), say("An empty sheet"), () => { trails = new Set(); targets = null; }); } whole(); redraw(); });
on(byId("open"), "click", () => byId("file").click()); on(byId("save"), "click", save);
on(byId("copy-text"), "click", () => copied(byId("text").value, byId("copy-text")));
on(byId("hand"), "click", () => handed(...FORMS[form]()));
on(byId("title"), "change", ({ target }) => {
  const fault = model.nameFault(model.empty(), target.value.trim());
  if (fault) { tell(fault, true); target.value = shownNow.drawing.name; } else commit({ ...structuredClone(current()), name: target.value.trim() });
});
on(byId("units"), "change", ({ target }) => { unit(target.value); keep(); stands(shownNow.drawing); });
function unit(name) { lengthUnit = has(unitsOf, name) ? name : "mm"; data.length = { factor: unitsOf[lengthUnit], unit: lengthUnit }; byId("units").value = lengthUnit; }
on(byId("language"), "click", () => { language = language === "ru" ? "en" : "ru"; speak(); });
on(byId("look"), "click", () => { look(root.dataset.look === "dark" ? "light" : "dark"); chosenLook = true; });
function speak() { labelled(); hint(); stands(shownNow.drawing); }

/* ---- begin ---- */

solver.show = (metres) => lengthText(metres, 3);
look(night.matches ? "dark" : "light");
const visit = kept(), linked = location.hash.length > 1 ? writers.opened(location.href) : null;
if (visit) { trails = new Set(visit.trails); ({ targets, showsGrid } = visit); unit(visit.unit); byId("grid").setAttribute("aria-pressed", String(showsGrid)); }
shownNow.drawing = linked?.drawing || visit?.drawing || model.read(delivered).drawing || model.empty();
shownNow.places = structuredClone(shownNow.drawing.points);
whole(); choose("move"); speak();
if (linked && !linked.drawing) tell(linked.wrong[0], true);
new ResizeObserver(() => redraw()).observe(sheet);

/* For tests: what is shown. */
window.hydrolinkage = { model, solver, writers, state: () => structuredClone({ ...shownNow, parts: null }), current, px, gridStep };
