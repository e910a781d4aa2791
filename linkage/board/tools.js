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
  if (!name) commit(next, say("Pin {name}", { name: first }));
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
  if (fingers.size > 1) { letGo(); return; }
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
  const was = [...fingers.values()];
  fingers.set(event.pointerId, spot);
  const all = [...fingers.values()], [from, to] = [centroid(was), centroid(all)];
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
/* Leave what is led where it was; of a machine that moved the pose stays. */
function letGo() {
  if (held?.next) stands(held.from);
  held = null;
}
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
on(sheet, "pointercancel", (event) => { fingers.delete(event.pointerId); letGo(); });
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
  "+": () => byId("nearer").click(), "=": () => byId("nearer").click(), "-": () => byId("farther").click(), 0: () => byId("whole").click(),
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
    const { cursor, pending } = shownNow;
    if (tool === "plate" && pending.length > 2 && (!cursor || pinAt(px(...cursor), 8) === pending.at(-1))) plated();
    else if (cursor) press(px(...cursor), 8);
    return;
  }
  const chosen = document.querySelector(`button[data-tool][aria-keyshortcuts="${CSS.escape(key.toUpperCase())}"]`), act = chosen ? () => { choose(chosen.dataset.tool); sheet.focus(); } : KEYS[key] || KEYS[low];
  if (!act || (key === " " && target.matches("button, input"))) return;
  event.preventDefault();
  act();
});
