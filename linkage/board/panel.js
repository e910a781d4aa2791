/* ---- the panel: what is selected, by its numbers ---- */

function field(label, value, take, given = {}) {
  const row = make("label"), input = make("input", { type: "text", value, autocomplete: "off", spellcheck: false, ...given });
  row.append(make("span", { textContent: label }), input);
  on(input, "change", () => {
    const fault = take(input.type === "checkbox" ? input.checked : input.value);
    input.classList.toggle("bad", Boolean(fault));
    if (fault || byId("message").classList.contains("bad")) tell(fault || "", Boolean(fault));
  });
  return row;
}
function sized(label, value, thing, take, least = -Infinity) {
  return field(label, value === undefined ? "" : shown(value, thing, 8), (text) => {
    const found = value === undefined && !text.trim() ? 0 : typed(text, thing);
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
/* The rod of the catalogue for a bore that is next to 0.55 of it; without one half of the bore. */
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
/* Say how far a cylinder is out, and where its stroke does not reach what is drawn. */
function reach({ start, end }, out) {
  const short = Math.min(start, end) - out, long = out - Math.max(start, end), said = make("p", { className: short > 1e-9 || long > 1e-9 ? "bad" : "" });
  said.textContent = short > 1e-9 ? say("drawn {length} shorter than closed", { length: lengthText(short) }) : long > 1e-9 ? say("drawn {length} longer than its stroke goes", { length: lengthText(long) }) : say("drawn {length} out", { length: lengthText(out) });
  return said;
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
      sized(say("Closed length"), model.closedLength(current(), name), data.length, (value) => { commit(model.measured(model.set(current(), "drives", name, { drawn: model.far(current(), ...each.ends) - value }), ...each.ends)); }, 1e-4),
      offered(sized(say("Stroke"), each.end - each.start, data.length, (value) => change({ end: each.start + value }), 1e-4), data.sizes.strokes),
      reach(each, shownNow.values[name]),
    ];
  },
  weights(name) {
    return [sized(say("Mass"), shownNow.drawing.weights[name].mass, { factor: 1, unit: "kg" }, (mass) => { commit(model.set(current(), "weights", name, { mass })); }, 0)];
  },
};
const kindsNamed = () => ({ points: say("Pin"), links: say("Link"), slides: say("Slide"), drives: say("Drive"), weights: say("Weight") });
function panel() {
  const { drawing, picked } = shownNow, reached = () => [...document.querySelectorAll("#fields input, #fields button")], focus = reached().indexOf(document.activeElement);
  byId("what").textContent = picked ? `${kindsNamed()[picked.kind]} ${picked.name}` : say("Nothing selected");
  const buttons = picked && line(button(say("Delete"), remove, "Delete"), ...(picked.kind === "points" || picked.kind === "links" || picked.kind === "drives" ? [button(say("Duplicate"), duplicate, "Control+D")] : []));
  const begun = Object.keys(drawing.points).length ? [note(say("Press a pin, a link or a cylinder on the sheet to see and type its numbers."))] : [
    note(say("Begin with Crank: press where its pivot is to stand, then where its pin is. Then Bar, from pin to pin. Fix what stands on the frame.")), line(button(say("Or an example"), example))];
  byId("fields").replaceChildren(...(picked ? [nameField(), ...FIELDS[picked.kind](picked.name), buttons, ...relatives()] : begun));
  byId("parts").replaceChildren(...model.PARTS.flatMap((kind) => Object.keys(drawing[kind]).map((name) => {
    const one = button(name, () => pick(kind, name));
    one.title = kindsNamed()[kind];
    one.setAttribute("aria-pressed", String(picked?.kind === kind && picked.name === name));
    return one;
  })));
  reached()[focus]?.focus();
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
  commit(model.measured(model.posed(from, points), P, Q), say("{label} is {length}", { label: P + Q, length: lengthText(value) }));
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
