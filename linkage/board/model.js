/* The drawing of the board as plain data, and what is done to it. Nothing here knows the page.

   A drawing is what `MachineSketch` is in Python, as JSON, in m, rad and kg:
     { board: 1, name: "Loader",
       points: { O: [0, 0], A: [0.1, 0] }, fixed: ["O"], links: { arm: ["O", "A"] },
       slides: { slide_A: { point: "A", along: 0.5 or ["P", "Q"] } },
       drives: { phi: { kind: "crank", ends: ["O", "A"], start: 0, end: 6.28, drawn: 0 },
                 S: { kind: "cylinder", ends: ["P", "Q"], start: 0, end: 0.4, drawn: 0.1, bore: 0.063, rod: 0.036 } },
       weights: { weight_A: { point: "A", mass: 200 } }, lengths: {}, notes: [] }
   `drawn` is the stroke at which it is drawn: a cylinder is (its drawn length - drawn) long where its stroke is 0, its closed length.
   Bore and rod are given both or not at all. `lengths` are those that a file gives in place of the coordinates.

   Each operation returns a new drawing and leaves the old one as it was, so that undo is a list of drawings. An operation expects a
   drawing that `check` has nothing against, names that are there, and a new name that `nameFault` has nothing against.
   The page defines `say(text, values)`, and gives `model.reserved` the words that no member may be called. */
const model = (() => {
  const { abs, hypot, max, min } = Math, PARTS = ["points", "links", "slides", "drives", "weights"];
  const MOST = { entries: 200, corners: 26, joints: 600, letters: 40, metres: 1e6, bytes: 1e6 }, reserved = new Set();
  const isTable = (each) => each !== null && typeof each === "object" && !Array.isArray(each);
  const isLength = (each) => Number.isFinite(each) && abs(each) <= MOST.metres, isText = (each) => typeof each === "string";
  const has = (table, name) => isText(name) && Object.hasOwn(table, name);
  const copy = (drawing) => JSON.parse(JSON.stringify(drawing));
  const changed = (drawing, change) => { const next = copy(drawing); change(next); return next; };
  const without = (table, drop) => Object.fromEntries(Object.entries(table).filter(([name, each]) => !drop(each, name)));
  const empty = (name = "Machine") => ({ board: 1, name, points: {}, fixed: [], links: {}, slides: {}, drives: {}, weights: {}, lengths: {}, notes: [] });

  /* ---- names ---- */

  const isName = (name) => isText(name) && name.length <= MOST.letters && /^\p{L}[\p{L}\p{Nd}_]*$/u.test(name) && name.normalize("NFKC") === name && !reserved.has(name);
  /* Return the names that members have, those included which the class gets from a slide or a cylinder. */
  function names(drawing) {
    const found = PARTS.flatMap((part) => Object.keys(drawing[part]));
    for (const name of Object.keys(drawing.slides)) found.push(`line_${name}`);
    for (const [name, each] of Object.entries(drawing.drives)) if (each.kind === "cylinder") found.push(`rod_${name}`, ...(each.bore ? [`cylinder_${name}`] : []));
    return found;
  }
  /* Return the labels of the lengths and angles of some links, in both spellings. */
  function labels(links) {
    const found = [], seen = new Set(), add = (key, first, second) => { if (!seen.has(key)) { seen.add(key); found.push(first); if (first !== second) found.push(second); } };
    for (const points of links) points.forEach((A, i) => points.slice(i + 1).forEach((B) => {
      const [P, Q] = A < B ? [A, B] : [B, A];
      add(`${P} ${Q}`, P + Q, Q + P);
      for (const R of points) if (R !== P && R !== Q) add(`${R} ${P} ${Q}`, P + R + Q, Q + R + P);
    }));
    return found;
  }
  /* Return in words why a member may not have a name; "" where it may. */
  function nameFault(drawing, name) {
    if (!isName(name)) return say("{name} is no name: a letter, then letters, digits and _, and no word of Python or of a machine", { name: String(name).slice(0, MOST.letters) });
    if (names(drawing).includes(name)) return say("{name} is the name of something else already", { name });
    return labels(Object.values(drawing.links)).includes(name) ? say("{name} is the name of a length or an angle already", { name }) : "";
  }
  /* Return the next free name: of a point A, B ... Z, A2 ..., of another part its stem, then with a number. */
  function freeName(drawing, stem = "") {
    const taken = new Set(names(drawing)), lengths = new Set(stem ? [] : labels(Object.values(drawing.links)));
    const isFree = (name) => isName(name) && !lengths.has(name) && !["", "rod_", "line_", "cylinder_"].some((head) => taken.has(head + name));
    for (let number = 1; ; number++) for (const each of stem ? [stem.slice(0, MOST.letters - 6)] : "ABCDEFGHIJKLMNOPQRSTUVWXYZ") {
      const name = number === 1 ? each : `${each}${stem ? "_" : ""}${number}`;
      if (isFree(name)) return name;
    }
  }

  /* ---- what is wrong ---- */

  /* Return in words what keeps data from being a drawing; an empty list where nothing does. */
  function check(given) {
    if (!isTable(given) || given.board !== 1) return [say("This is no drawing of the board.")];
    const wrong = [], drawing = { ...empty(), ...given }, lacks = (holds, words) => { if (!holds) wrong.push(words); return holds; };
    const named = (point, where) => lacks(has(drawing.points, point), say("{where} names the point {name}, which is not there", { where, name: String(point).slice(0, MOST.letters) }));
    const listed = (list, most) => Array.isArray(list) && list.length <= most;
    for (const part of [...PARTS, "lengths"]) lacks(isTable(drawing[part]) && Object.keys(drawing[part]).length <= MOST.entries, say("a drawing has a table {part} with at most {most} entries", { part, most: MOST.entries }));
    for (const part of ["fixed", "notes"]) lacks(listed(drawing[part], MOST.entries) && drawing[part].every((each) => isText(each) && each.length <= 1000), say("a drawing has a list {part} with at most {most} texts", { part, most: MOST.entries }));
    lacks(isName(drawing.name), say("the drawing has no name that a class may have"));
    if (wrong.length) return wrong;
    const all = names(drawing);
    for (const name of PARTS.flatMap((part) => Object.keys(drawing[part]))) lacks(isName(name), nameFault(empty(), name));
    for (const name of new Set(all.filter((each, place) => all.indexOf(each) < place))) wrong.push(say("{name} is the name of something else already", { name }));
    for (const [name, place] of Object.entries(drawing.points)) lacks(listed(place, 2) && place.length === 2 && place.every(isLength), say("{name} has no two coordinates in metres", { name }));
    for (const name of drawing.fixed) named(name, say("what is fixed"));
    lacks(new Set(drawing.fixed).size === drawing.fixed.length, say("{name} names a point twice", { name: say("what is fixed") }));
    for (const [name, points] of Object.entries(drawing.links)) {
      if (!lacks(listed(points, MOST.corners) && points.length > 1, say("the link {name} has not 2 to {most} points", { name, most: MOST.corners }))) continue;
      points.forEach((each) => named(each, name));
      lacks(new Set(points).size === points.length, say("{name} names a point twice", { name }));
    }
    lacks(Object.values(drawing.links).flat().length <= MOST.joints, say("the links have more than {most} points in all", { most: MOST.joints }));
    for (const [name, each] of Object.entries(drawing.slides)) {
      const ends = isTable(each) && (Array.isArray(each.along) ? each.along : isLength(each.along) ? [] : null);
      if (!lacks(ends && [0, 2].includes(ends.length), say("{name} slides neither along two points nor at an angle", { name }))) continue;
      [each.point, ...ends].forEach((point) => named(point, name));
      lacks(new Set([each.point, ...ends]).size === 1 + ends.length, say("{name} names a point twice", { name }));
    }
    for (const [name, each] of Object.entries(drawing.drives)) {
      if (!lacks(isTable(each) && ["crank", "cylinder"].includes(each.kind) && listed(each.ends, 2) && each.ends.length === 2, say("{name} is no crank and no cylinder with two ends", { name }))) continue;
      each.ends.forEach((point) => named(point, name));
      lacks(each.ends[0] !== each.ends[1], say("{name} names a point twice", { name }));
      lacks([each.start, each.end, each.drawn].every(isLength) && each.start !== each.end, say("the stroke of {name} has no two ends and no drawn place", { name }));
      const sizes = [each.bore, each.rod].filter((size) => size !== undefined && size !== null);
      lacks(!sizes.length || (each.kind === "cylinder" && sizes.length === 2 && sizes.every(isLength) && 0 < each.rod && each.rod < each.bore), say("the rod of {name} is not thinner than its bore", { name }));
    }
    for (const [name, each] of Object.entries(drawing.weights)) if (lacks(isTable(each) && Number.isFinite(each.mass) && each.mass >= 0 && each.mass <= 1e9, say("{name} has no mass", { name }))) named(each.point, name);
    for (const [label, value] of Object.entries(drawing.lengths)) lacks(isName(label) && isLength(value) && value > 0, say("{name} is no length", { name: label.slice(0, MOST.letters) }));
    return wrong;
  }
  /* Return the drawing that a text holds and what is wrong with it, { drawing, wrong }; what a drawing does not know is left out. */
  function read(text) {
    let given = null;
    try { given = text.length <= MOST.bytes ? JSON.parse(text) : null; } catch { /* no JSON: no drawing */ }
    const wrong = check(given);
    if (wrong.length) return { drawing: null, wrong };
    const drawing = empty(), taken = (each, keys) => Object.fromEntries(keys.filter((key) => each[key] !== undefined && each[key] !== null).map((key) => [key, each[key]]));
    for (const key of Object.keys(drawing)) if (given[key] !== undefined) drawing[key] = given[key];
    const KEYS = { slides: ["point", "along"], drives: ["kind", "ends", "start", "end", "drawn", "bore", "rod"], weights: ["point", "mass"] };
    drawing.notes = drawing.notes.map((note) => note.replace(/(?! )[\p{C}\p{Z}]/gu, " "));
    for (const [part, keys] of Object.entries(KEYS)) drawing[part] = Object.fromEntries(Object.entries(drawing[part]).map(([name, each]) => [name, taken(each, keys)]));
    return { drawing, wrong };
  }
  /* Return in words what keeps a drawing from being a machine yet, beside how it is assembled. */
  function lacking(drawing) {
    const found = [], { points, fixed, links, slides, drives } = drawing, isFixed = (name) => fixed.includes(name), all = Object.values(links);
    const held = new Set([...fixed, ...all.flat(), ...Object.values(slides).map((each) => each.point), ...Object.values(drives).flatMap((each) => each.ends)]);
    if (!Object.keys(points).length) return [say("Nothing is drawn yet.")];
    if (!fixed.length && !Object.values(slides).length) found.push(say("no point is fixed"));
    for (const name of Object.keys(points)) if (!held.has(name)) found.push(say("{name} is on no link", { name }));
    if (!Object.keys(drives).length) found.push(say("nothing drives it: draw a crank or a cylinder"));
    const one = new Set(), driven = new Set();
    for (const [name, { kind, ends }] of Object.entries(drives)) {
      if (kind === "crank" && !isFixed(ends[0])) found.push(say("{name} is not fixed; the crank {drive} turns about a fixed point", { name: ends[0], drive: name }));
      if (ends.every(isFixed)) found.push(say("both ends of {name} are fixed", { name }));
      const key = kind === "crank" ? ends[1] : [...ends].sort().join(" ");
      if (driven.has(key)) found.push(say("{name} drives what another drive drives", { name }));
      driven.add(key);
    }
    for (const [name, ends] of [...Object.entries(links), ...Object.entries(drives).map(([each, drive]) => [each, drive.ends])]) {
      for (const [k, P] of ends.entries()) for (const Q of ends.slice(k + 1)) if (far(drawing, P, Q) === 0) found.push(say("{P} and {Q} of {name} stand at one place", { P, Q, name }));
    }
    for (const [name, { point, along }] of Object.entries(slides)) if (Array.isArray(along)) {
      if (far(drawing, ...along) === 0) found.push(say("{P} and {Q} of {name} stand at one place", { P: along[0], Q: along[1], name }));
      else if (abs(offLine(drawing, point, along)) > 1e-9 * size(drawing)) found.push(say("{name} is beside the line of its slide", { name: point }));
    }
    const taken = new Set(names(drawing));
    for (const label of labels(all)) { if (one.has(label) || taken.has(label)) found.push(say("{name} would be the name of two things: rename a point", { name: label })); one.add(label); }
    return [...new Set(found)];
  }

  /* ---- measures ---- */

  const far = ({ points }, P, Q) => hypot(points[Q][0] - points[P][0], points[Q][1] - points[P][1]);
  /* Return the longer side of the box around all points [m]. */
  function size({ points }) {
    const spans = [0, 1].map((axis) => Object.values(points).map((each) => each[axis]));
    return spans[0].length ? max(...spans.map((each) => max(...each) - min(...each))) : 0;
  }
  /* Return how far a point stands from the line through two others [m], to its left above zero. */
  function offLine({ points }, point, [P, Q]) {
    const [dx, dy] = [0, 1].map((axis) => points[Q][axis] - points[P][axis]);
    return (dx * (points[point][1] - points[P][1]) - dy * (points[point][0] - points[P][0])) / (hypot(dx, dy) || 1);
  }
  /* Return the closed length of a cylinder, its length where its stroke is 0 [m]. */
  const closedLength = (drawing, name) => far(drawing, ...drawing.drives[name].ends) - drawing.drives[name].drawn;

  /* ---- operations ---- */

  /* Drop the given lengths that end at a point, or at it and another one: places say them from now on. */
  function measure(drawing, point, others = Object.keys(drawing.points)) {
    drawing.lengths = without(drawing.lengths, (_, label) => others.some((each) => label === point + each || label === each + point));
  }
  const measured = (drawing, P, Q) => changed(drawing, (next) => measure(next, P, [Q]));
  const addPoint = (drawing, name, x, y) => changed(drawing, (next) => { next.points[name] = [x, y]; });
  /* Put a point elsewhere, and points that slide along it back onto their lines. A cylinder with a bore keeps its closed length and comes out
     more or less; another one keeps its stroke. */
  function movePoint(drawing, name, x, y) {
    const next = copy(drawing), moved = [name];
    next.points[name] = [x, y];
    for (const { point, along } of Object.values(next.slides)) if (Array.isArray(along) && [point, ...along].some((each) => moved.includes(each)) && far(next, ...along)) {
      const off = offLine(next, point, along), [P, Q] = along.map((each) => next.points[each]), [u, v] = next.points[point];
      next.points[point] = [u + (off * (Q[1] - P[1])) / far(next, ...along), v - (off * (Q[0] - P[0])) / far(next, ...along)];
      moved.push(point);
    }
    for (const each of moved) measure(next, each);
    for (const [each, drive] of Object.entries(next.drives)) if (drive.bore && drive.ends.some((end) => moved.includes(end))) drive.drawn = far(next, ...drive.ends) - closedLength(drawing, each);
    return next;
  }
  /* Put the whole machine into another pose: places of points, and the strokes at which it then stands; lengths stay. */
  const posed = (drawing, places, strokes = {}) => changed(drawing, (next) => {
    for (const [name, place] of Object.entries(places)) next.points[name] = [...place];
    for (const [name, value] of Object.entries(strokes)) next.drives[name].drawn = value;
  });
  const renamed = (table, from, to) => Object.fromEntries(Object.entries(table).map(([name, each]) => [name === from ? to : name, each]));
  /* Give another name: to a point everywhere, to an entry of "links", "slides", "drives" or "weights" there. */
  function rename(drawing, part, from, to) {
    return changed(drawing, (next) => {
      next[part] = renamed(next[part], from, to);
      if (part !== "points") return;
      const other = (name) => (name === from ? to : name), others = Object.keys(drawing.points);
      next.fixed = next.fixed.map(other);
      for (const [name, points] of Object.entries(drawing.links)) {
        const own = `link_${points.map(other).join("_")}`, follows = name === `link_${points.join("_")}` && !nameFault({ ...next, links: {} }, own);
        next.links = renamed(next.links, name, follows ? own : name);
        next.links[follows ? own : name] = points.map(other);
      }
      for (const each of [...Object.values(next.slides), ...Object.values(next.weights)]) each.point = other(each.point);
      for (const each of Object.values(next.slides)) if (Array.isArray(each.along)) each.along = each.along.map(other);
      for (const each of Object.values(next.drives)) each.ends = each.ends.map(other);
      for (const each of others) for (const [was, is] of [[from + each, to + each], [each + from, each + to]]) next.lengths = renamed(next.lengths, was, is);
    });
  }
  /* Take an entry away: of "points" with what hangs on it (links keep their other points while two are left). */
  function remove(drawing, part, name) {
    return changed(drawing, (next) => {
      if (part === "points") {
        measure(next, name);
        next.fixed = next.fixed.filter((each) => each !== name);
        next.links = Object.fromEntries(Object.entries(next.links).map(([key, points]) => [key, points.filter((each) => each !== name)]).filter(([, points]) => points.length > 1));
        next.slides = without(next.slides, (each) => each.point === name || (Array.isArray(each.along) && each.along.includes(name)));
        next.drives = without(next.drives, (each) => each.ends.includes(name));
        next.weights = without(next.weights, (each) => each.point === name);
      }
      delete next[part][name];
    });
  }
  /* Join points by a rigid link, a bar by two and a plate by more; under the name of a link that is there these become its points. */
  const link = (drawing, points, name = freeName(drawing, `link_${points.join("_")}`)) => changed(drawing, (next) => { next.links[name] = [...new Set(points)]; });
  const fix = (drawing, point, isFixed = true) => changed(drawing, (next) => {
    if (next.fixed.includes(point) !== isFixed) next.fixed = isFixed ? [...next.fixed, point] : next.fixed.filter((each) => each !== point);
  });
  /* Let a point slide, along two others of a body, onto whose line it is put, or on a line of the frame at an angle [rad]. */
  function slide(drawing, point, along, name = freeName(drawing, `slide_${point}`)) {
    const next = changed(drawing, (each) => { each.slides[name] = { point, along: Array.isArray(along) ? [...along] : along }; });
    return movePoint(next, point, ...drawing.points[point]);
  }
  /* Let a crank turn a point about a fixed one, one turn unless its ends are given [rad]; with a link between them where there is none. */
  function crank(drawing, pivot, point, { start = 0, end = 2 * Math.PI, drawn = 0 } = {}, name = freeName(drawing, "phi")) {
    const isJoined = Object.values(drawing.links).some((each) => each.includes(pivot) && each.includes(point)), next = fix(drawing, pivot);
    next.drives[name] = { kind: "crank", ends: [pivot, point], start, end, drawn };
    return isJoined ? next : link(next, [pivot, point]);
  }
  /* Draw a cylinder between two points: closed length and stroke [m], by default its drawn length and half of that; bore and rod [m]. */
  function cylinder(drawing, P, Q, { closed = far(drawing, P, Q), stroke = closed / 2, bore, rod } = {}, name = freeName(drawing, "S")) {
    const ends = [P, Q], drive = { kind: "cylinder", ends, start: 0, end: stroke, drawn: far(drawing, P, Q) - closed, ...(bore ? { bore, rod } : {}) };
    return changed(drawing, (next) => { next.drives[name] = drive; });
  }
  const weight = (drawing, point, mass, name = freeName(drawing, `weight_${point}`)) => changed(drawing, (next) => { next.weights[name] = { point, mass }; });
  /* Copy points, moved by (dx, dy), with the links, slides, drives and weights that are on these alone. */
  function duplicate(drawing, chosen, dx, dy) {
    const next = copy(drawing), twin = {};
    for (const name of chosen) { twin[name] = freeName(next); next.points[twin[name]] = [drawing.points[name][0] + dx, drawing.points[name][1] + dy]; }
    const within = (points) => points.every((each) => has(twin, each)), twins = (points) => points.map((each) => twin[each]);
    next.fixed.push(...twins(drawing.fixed.filter((each) => has(twin, each))));
    for (const points of Object.values(drawing.links)) if (within(points)) next.links[freeName(next, `link_${twins(points).join("_")}`)] = twins(points);
    for (const { point, along } of Object.values(drawing.slides)) {
      const ends = Array.isArray(along) ? along : [];
      if (within([point, ...ends])) next.slides[freeName(next, `slide_${twin[point]}`)] = { point: twin[point], along: ends.length ? twins(ends) : along };
    }
    for (const [name, each] of Object.entries(drawing.drives)) if (within(each.ends)) next.drives[freeName(next, name.replace(/_\d+$/, ""))] = { ...each, ends: twins(each.ends) };
    for (const { point, mass } of Object.values(drawing.weights)) if (within([point])) next.weights[freeName(next, `weight_${twin[point]}`)] = { point: twin[point], mass };
    return next;
  }
  /* Change the values of an entry of "slides", "drives" or "weights", such as { end: 0.3 }. */
  const set = (drawing, part, name, values) => changed(drawing, (next) => { Object.assign(next[part][name], values); });

  return { reserved, PARTS, MOST, empty, nameFault, freeName, check, read, lacking, far, size, closedLength, measured, addPoint, movePoint, posed, rename, remove, link, fix, slide, crank, cylinder, weight, duplicate, set };
})();
