/* How a drawing moves: bars, plates, slides and drives as constraints, followed from the drawn pose. Nothing here knows the page.

   Every answer is a pose that closes; no link is ever stretched. Lengths in m, strokes in m or rad, places as { name: [x, y] }.
     solver.mobility(drawing)             { freedom, drives, redundant, loose: [names], singular, words }
     solver.run(drawing, { phi: 1.2 })    as far as it goes towards these strokes, the other drives held:
                                          { points, strokes, stopped, short }; `stopped` is "" or a sentence
     solver.drag(drawing, "T", [x, y])    the same, with a point led to a place or as near as links and strokes bring it
     solver.sweep(drawing, "phi", 91)     { values, poses: [points or null], stops: [{ value, stopped, short }] } over the stroke of a drive
   `short` is null or { part, name, gap }: the link or drive that would have to be longer by so much [m], shorter where it is below zero.
   Take a pose over by `model.posed(drawing, answer.points, answer.strokes)`. The page may give `solver.show`, how a length [m] is said. */
const solver = (() => {
  const { abs, atan2, cos, hypot, max, min, round, sin, sqrt, PI } = Math;
  /* Pivots below RANK of the first are none; a way ends where the clearance falls below TOUCH; CLOSED is what closes, of the size. */
  const RANK = 1e-9, TOUCH = 1e-6, CLOSED = 1e-11, STRONG = 1e3, TURN = 2 * PI;
  const own = { show: (metres) => `${Number((1e3 * metres).toPrecision(3))}\u2009mm` };

  /* ---- constraints ---- */

  /* Each row is { part, name, put(at, value) }; `put` gives what is missed [m] and its slopes as point, by x, by y, point ... */
  const unit = (P, axis, Q) => (at) => [at[2 * P + axis] - at[2 * Q + axis], axis ? [P, 0, 1, Q, 0, -1] : [P, 1, 0, Q, -1, 0]];
  const bar = (P, Q, length) => (at, value) => {
    const d = max(length + value, 1e-300), x = at[2 * Q] - at[2 * P], y = at[2 * Q + 1] - at[2 * P + 1], wide = hypot(x, y) || 1e-300;
    return [wide - d, [Q, x / wide, y / wide, P, -x / wide, -y / wide]];
  };
  const rigid = (P, Q, X, a, b, axis) => (at) => {
    const x = at[2 * Q] - at[2 * P], y = at[2 * Q + 1] - at[2 * P + 1], off = at[2 * X + axis] - at[2 * P + axis];
    return axis ? [off - a * y - b * x, [X, 0, 1, Q, -b, -a, P, b, a - 1]] : [off - a * x + b * y, [X, 1, 0, Q, -a, b, P, a - 1, -b]];
  };
  const onLine = (X, x, y, angle) => (at) => [cos(angle) * (at[2 * X + 1] - y) - sin(angle) * (at[2 * X] - x), [X, -sin(angle), cos(angle)]];
  const onBody = (X, P, Q, wide) => (at) => {
    const x = (at[2 * Q] - at[2 * P]) / wide, y = (at[2 * Q + 1] - at[2 * P + 1]) / wide, u = at[2 * X] - at[2 * P], v = at[2 * X + 1] - at[2 * P + 1];
    return [x * v - y * u, [X, -y, x, Q, v / wide, -u / wide, P, y - v / wide, u / wide - x]];
  };
  const turned = (O, A, angle) => (at, value) => {
    const c = cos(angle + value), s = sin(angle + value);
    return [c * (at[2 * A + 1] - at[2 * O + 1]) - s * (at[2 * A] - at[2 * O]), [A, -s, c, O, s, -c]];
  };
  const pairsOf = (all) => all.flatMap((A, k) => all.slice(k + 1).map((B) => [A, B]));
  /* Return a drawing as unknowns and rows, with the rows of some of its drives; points that nothing holds are left where they are. */
  function build(drawing, driven) {
    const { points, fixed, links, slides, drives } = drawing, names = Object.keys(points), index = Object.fromEntries(names.map((name, k) => [name, k]));
    const start = Float64Array.from(Object.values(points).flat()), rows = [], size = model.size(drawing) || 1;
    const bodies = Object.entries(links).map(([name, all]) => ["links", name, all]);
    for (const [name, { kind, ends }] of Object.entries(drives)) if (kind === "crank" && !Object.values(links).some((all) => ends.every((each) => all.includes(each)))) bodies.push(["drives", name, ends]);
    for (const [part, name, all] of bodies) {
      const put = (each) => rows.push({ part, name, put: each });
      const [P, Q] = pairsOf(all).reduce((best, pair) => (model.far(drawing, ...pair) > model.far(drawing, ...best) ? pair : best)), wide = model.far(drawing, P, Q);
      if (wide > 0) put(bar(index[P], index[Q], wide));
      for (const X of all.filter((each) => each !== P && (wide === 0 || each !== Q))) for (const axis of [0, 1]) {
        const [x, y] = [0, 1].map((k) => (points[Q][k] - points[P][k]) / (wide || 1)), [u, v] = [0, 1].map((k) => (points[X][k] - points[P][k]) / (wide || 1));
        put(wide === 0 ? unit(index[X], axis, index[P]) : rigid(index[P], index[Q], index[X], x * u + y * v, x * v - y * u, axis));
      }
    }
    for (const [name, { point, along }] of Object.entries(slides)) {
      const X = index[point], ends = Array.isArray(along) ? along.map((each) => index[each]) : null;
      rows.push({ part: "slides", name, put: ends ? onBody(X, ...ends, model.far(drawing, ...along) || 1) : onLine(X, ...points[point], along) });
    }
    for (const name of driven) rows.push(driveRow(drawing, index, name));
    const groups = rows.map((row) => row.put(start, 0)[1].filter((_, k) => k % 3 === 0)), held = new Set(groups.flat());
    const free = neighbourly(groups, names.map((_, k) => k)).filter((k) => held.has(k) && !fixed.includes(names[k])), columns = new Map(free.map((k, column) => [k, 2 * column]));
    return { drawing, names, index, start, size, columns, free, n: 2 * free.length, rows: rows.filter((_, row) => groups[row].some((k) => columns.has(k))) };
  }
  /* Return points in an order in which those of a row stand near each other. */
  function neighbourly(groups, all) {
    const order = new Set();
    for (const begin of all) for (const point of order.add(begin)) for (const group of groups) if (group.includes(point)) group.forEach((each) => order.add(each));
    return [...order];
  }
  function driveRow({ drives, points }, index, name) {
    const { kind, ends, drawn } = drives[name], [P, Q] = ends.map((each) => index[each]), [x, y] = [0, 1].map((k) => points[ends[1]][k] - points[ends[0]][k]);
    return { part: "drives", name, drive: name, put: kind === "crank" ? turned(P, Q, atan2(y, x) - drawn) : bar(P, Q, hypot(x, y) - drawn) };
  }
  /* Return what the rows miss and their slopes at places and values of drives. */
  const missed = ({ rows }, at, values) => rows.map((row) => row.put(at, row.drive ? values[row.drive] : 0));
  const worst = (found) => found.reduce((most, [miss]) => max(most, abs(miss)), 0);
  const dense = ({ columns, n }, found) => found.map(([, slopes]) => {
    const row = new Float64Array(n);
    for (let k = 0; k < slopes.length; k += 3) { const column = columns.get(slopes[k]); if (column !== undefined) { row[column] += slopes[k + 1]; row[column + 1] += slopes[k + 2]; } }
    return row;
  });

  /* ---- equations ---- */

  /* Return the row and the column of the next pivot: the largest of its row and column; the largest of all where that is small. */
  function pivotAt(rows, order, rank, first) {
    const n = order.length;
    let i = rank, j = rank, most = 0, before = -1;
    while (most > before) {
      before = most;
      for (let r = rank; r < rows.length; r++) if (abs(rows[r][order[j]]) > most) { most = abs(rows[r][order[j]]); i = r; }
      for (let c = rank; c < n; c++) if (abs(rows[i][order[c]]) > most) { most = abs(rows[i][order[c]]); j = c; }
    }
    if (most > 0.01 * first && most > 0) return [i, j, most];
    for (let r = rank; r < rows.length; r++) for (let c = rank; c < n; c++) if (abs(rows[r][order[c]]) > most) { most = abs(rows[r][order[c]]); i = r; j = c; }
    return [i, j, most];
  }
  /* Bring a matrix to steps: its rank, the sign of its determinant, and a basis of what it leaves free. */
  function eliminated(matrix, n) {
    const rows = matrix.map((row) => row.slice()), order = [...Array(n).keys()];
    let rank = 0, first = 0, sign = 1;
    for (; rank < min(rows.length, n); rank++) {
      const [i, j, most] = pivotAt(rows, order, rank, first);
      first ||= most;
      if (most <= RANK * first || !most) break;
      if ((i === rank) !== (j === rank)) sign = -sign;
      [rows[rank], rows[i]] = [rows[i], rows[rank]];
      [order[rank], order[j]] = [order[j], order[rank]];
      const pivot = rows[rank], column = order[rank];
      if (pivot[column] < 0) sign = -sign;
      for (let r = rank + 1; r < rows.length; r++) {
        const row = rows[r], factor = row[column] / pivot[column];
        if (factor) for (let c = 0; c < n; c++) row[c] -= factor * pivot[c];
      }
    }
    const basis = order.slice(rank).map((column) => {
      const vector = new Float64Array(n);
      vector[column] = 1;
      for (let r = rank - 1; r >= 0; r--) {
        let sum = rows[r][column];
        for (let k = r + 1; k < rank; k++) sum += rows[r][order[k]] * vector[order[k]];
        vector[order[r]] = -sum / rows[r][order[r]];
      }
      return vector;
    });
    return { rank, sign, basis };
  }
  /* Return the normal equations of rows, each times its weight, with damping: Cholesky's factor within its envelope, and the right side. */
  function factored({ columns, n }, found, weights, damping) {
    const factor = new Float64Array(n * n), right = new Float64Array(n), begins = Int32Array.from({ length: n }, (_, i) => i), place = [], slope = [];
    found.forEach(([miss, slopes], row) => {
      const w = weights ? weights[row] ** 2 : 1;
      let count = 0;
      for (let k = 0; k < slopes.length; k += 3) {
        const column = columns.get(slopes[k]);
        if (column !== undefined) for (const axis of [0, 1]) { place[count] = column + axis; slope[count++] = slopes[k + 1 + axis]; }
      }
      for (let a = 0; a < count; a++) {
        const i = place[a];
        right[i] -= w * slope[a] * miss;
        for (let b = 0; b < count; b++) { const j = place[b]; factor[i * n + j] += w * slope[a] * slope[b]; if (j < begins[i]) begins[i] = j; }
      }
    });
    for (let i = 0; i < n; i++) {
      factor[i * n + i] += damping;
      for (let j = begins[i]; j <= i; j++) {
        let sum = factor[i * n + j];
        for (let k = max(begins[i], begins[j]); k < j; k++) sum -= factor[i * n + k] * factor[j * n + k];
        factor[i * n + j] = i === j ? sqrt(max(sum, damping * 1e-3)) : sum / factor[j * n + j];
      }
    }
    return { factor, right, begins, n };
  }
  function solved({ factor, begins, n }, right) {
    for (let i = 0; i < n; i++) {
      for (let k = begins[i]; k < i; k++) right[i] -= factor[i * n + k] * right[k];
      right[i] /= factor[i * n + i];
    }
    for (let i = n - 1; i >= 0; i--) {
      right[i] /= factor[i * n + i];
      for (let k = begins[i]; k < i; k++) right[k] -= factor[i * n + k] * right[i];
    }
    return right;
  }
  /* Return the change of the unknowns that makes rows, each times its weight, least, with damping. */
  function leastChange(system, found, weights, damping) { const made = factored(system, found, weights, damping); return solved(made, made.right); }
  /* Return the least singular value of the slopes, by inverse iteration: how far from singular a pose is that nothing leaves loose. */
  function clearance(system, found) {
    const made = factored(system, found, null, 1e-15);
    let vector = Float64Array.from({ length: made.n }, (_, k) => 1 + ((k * 7) % 11) / 11), long = norm(vector);
    for (let turn = 0; turn < 6; turn++) { vector = solved(made, vector.map((each) => each / long)); long = norm(vector); }
    return 1 / sqrt(long);
  }
  function moved({ free }, at, change, share = 1) {
    const next = at.slice();
    free.forEach((point, k) => { next[2 * point] += share * change[2 * k]; next[2 * point + 1] += share * change[2 * k + 1]; });
    return next;
  }
  const norm = (vector) => sqrt(vector.reduce((sum, each) => sum + each * each, 0)), hypotOf = (a, b) => norm(a.map((each, k) => each - b[k]));
  const most = (change) => change.reduce((found, each) => max(found, abs(each)), 0);
  /* Return the pose that Newton's method comes to from near it, null where it does not come straight to one. */
  function closed(system, from, values, ratio = 0.25) {
    let at = from, before = Infinity;
    for (let turn = 0; turn < 12; turn++) {
      const found = missed(system, at, values), change = leastChange(system, found, null, 1e-14), step = most(change);
      if (!(step < Infinity) || (turn && step > max(ratio * before, 1e-13 * system.size))) return worst(found) <= CLOSED * system.size ? at : null;
      at = moved(system, at, change);
      if (step <= 1e-12 * system.size) return worst(missed(system, at, values)) <= CLOSED * system.size ? at : null;
      before = step;
    }
    return null;
  }
  /* Return the pose at which the rows, each times its weight, are least. */
  function levelled(system, from, values, weights) {
    const cost = (found) => found.reduce((sum, [miss], k) => sum + (weights[k] * miss) ** 2, 0);
    let at = from, found = missed(system, at, values), damping = 1e-3;
    for (let turn = 0; turn < 120 && damping < 1e12; turn++) {
      const change = leastChange(system, found, weights, damping), next = moved(system, at, change), there = missed(system, next, values);
      if (cost(there) < cost(found)) {
        at = next; found = there; damping = max(damping / 5, 1e-9);
        if (most(change) < 1e-9 * system.size) break;
      } else damping *= 6;
    }
    return at;
  }

  /* ---- along the drives ---- */

  /* Follow a pose from values of the drives to others. A step is taken where Newton's method contracts fast, the determinant keeps its sign and
     the clearance from singular poses does not fall below half. So steps grow small where branches cross or end, and no step leaps to another. */
  function follow(system, from, values, wanted) {
    const { n, size } = system, between = (t) => Object.fromEntries(Object.keys(values).map((name) => [name, values[name] + t * ((wanted[name] ?? values[name]) - values[name])]));
    let here = closed(system, from, values);
    if (!here) return { at: from, values, done: false, goesOn: false };
    const isWhole = eliminated(dense(system, missed(system, here, values)), n).rank === n;
    const state = (at, t) => {
      const found = isWhole ? missed(system, at, between(t)) : [];
      return { at, t, clear: isWhole ? clearance(system, found) : 1, sign: isWhole && found.length === n ? eliminated(dense(system, found), n).sign : 1 };
    };
    here = state(here, 0);
    const far = Object.keys(values).map((name) => abs((wanted[name] ?? values[name]) - values[name]) / (system.drawing.drives[name].kind === "crank" ? 0.2 : 0.1 * size));
    const largest = 1 / max(1, ...far), passed = [here];
    for (let h = largest, turn = 0; here.t < 1 && turn < 3000; turn++) {
      const t = min(here.t + h, 1), ahead = missed(system, here.at, between(t)), change = leastChange(system, ahead, null, 1e-14);
      const at = most(change) < 0.1 * size ? closed(system, moved(system, here.at, change), between(t)) : null, next = at && state(at, t);
      const isNear = next && hypotOf(next.at, here.at) < 2 * hypotOf(moved(system, here.at, change), here.at) + 1e-9 * size;
      const isOn = isNear && next.clear >= 0.5 * here.clear && next.sign === here.sign;
      if (isOn && next.clear > TOUCH) { passed.push(here = next); h = min(1.6 * h, largest); } else if (h < 1e-13 || (isOn && next.clear <= TOUCH)) break; else h *= 0.5;
    }
    const done = here.t === 1, back = done ? undefined : passed.findLast((each) => hypotOf(each.at, here.at) > 1e-3 * size);
    return { at: here.at, values: between(here.t), done, goesOn: back !== undefined && goesOn(system, here, back, between(2 * here.t - back.t)) };
  }
  /* Return whether a way goes smoothly on beyond a singular pose, as where two ways cross; at a dead point there is none. */
  function goesOn(system, here, back, values) {
    const ahead = here.at.map((each, k) => 2 * each - back.at[k]), next = closed(system, ahead, values, 0.9);
    return next !== null && hypotOf(next, ahead) < 0.3 * hypotOf(here.at, back.at);
  }
  const placesOf = ({ names }, at) => Object.fromEntries(names.map((name, k) => [name, [at[2 * k], at[2 * k + 1]]]));
  const drawnStrokes = ({ drives }) => Object.fromEntries(Object.entries(drives).map(([name, each]) => [name, each.drawn]));
  /* Return the pose at which some rows miss least while all others hold; null where these do not hold from there. */
  function relaxed(system, from, values, given) {
    const hard = { ...system, rows: system.rows.filter((_, k) => !given.has(k)) }, weights = system.rows.map((_, k) => (given.has(k) ? 1 : STRONG));
    const cost = (at) => missed(system, at, values).reduce((sum, [miss], k) => sum + (given.has(k) ? miss * miss : 0), 0);
    let at = closed(hard, from, values, 0.9);
    for (let turn = 0, damping = 1e-3; at && turn < 100 && damping < 1e9; turn++) {
      const next = closed(hard, moved(system, at, leastChange(system, missed(system, at, values), weights, damping)), values, 0.9), before = cost(at), after = next ? cost(next) : Infinity;
      if (after < before) {
        at = next; damping = max(damping / 4, 1e-6);
        if (before - after < 1e-10 * before) break;
      } else damping *= 5;
    }
    return at;
  }
  /* Return which link or drive would have to give way for rows to be met that cannot be, and by how much. Others give way only where one is not enough. */
  function shortest(system, at, values, among) {
    const strong = system.rows.map((row) => (row.part === "links" ? 1 : STRONG)), given = new Set(), same = (k, j) => system.rows[k].part === system.rows[j].part && system.rows[k].name === system.rows[j].name;
    const level = levelled(system, at, values, strong), found = missed(system, level, values);
    let places = null, chosen = -1;
    for (let turn = 0; turn < 4 && !places; turn++) {
      const next = among.filter((k) => !given.has(k)).reduce((best, k) => (best < 0 || abs(found[k][0]) > abs(found[best][0]) ? k : best), -1);
      if (next < 0) break;
      if (chosen < 0) chosen = next;
      among.forEach((k) => { if (same(k, next)) given.add(k); });
      places = relaxed(system, level, values, given);
    }
    if (chosen < 0) return null;
    places ||= level;
    const { part, name } = system.rows[chosen], ends = part === "links" ? system.drawing.links[name] : [], span = (all, P, Q) => hypot(all[2 * P] - all[2 * Q], all[2 * P + 1] - all[2 * Q + 1]);
    const pairs = pairsOf(ends.map((each) => system.index[each])), stretches = pairs.map((pair) => span(places, ...pair) - span(system.start, ...pair));
    const gap = pairs.length ? stretches.reduce((best, each) => (abs(each) > abs(best) ? each : best), 0) : missed(system, places, values)[chosen][0];
    return abs(gap) > 1e-9 * system.size ? { part, name, gap } : null;
  }
  const rowsOf = (system, part) => system.rows.map((_, k) => k).filter((k) => system.rows[k].part === part);
  function saidShort({ name, gap }) {
    return gap > 0 ? say("{name} is {gap} too short", { name, gap: own.show(gap) }) : say("{name} is {gap} too long", { name, gap: own.show(-gap) });
  }
  /* Return why a way ended, { stopped, short }. */
  function ended(system, reached, wanted) {
    const short = reached.goesOn ? null : shortest(system, reached.at, { ...reached.values, ...wanted }, rowsOf(system, "links"));
    return { stopped: short ? saidShort(short) : say("two ways go on from here: no drive says which"), short };
  }
  function run(drawing, wanted) {
    const system = build(drawing, Object.keys(drawing.drives)), reached = follow(system, system.start, drawnStrokes(drawing), wanted);
    return { points: placesOf(system, reached.at), strokes: reached.values, ...(reached.done ? { stopped: "", short: null } : ended(system, reached, wanted)) };
  }
  /* Return the poses over the stroke of a drive at even values, from the drawn pose to both ends; null beyond where it stops. */
  function sweep(drawing, drive, count = 91) {
    const { start, end, drawn } = drawing.drives[drive], values = Array.from({ length: count }, (_, k) => start + (k * (end - start)) / max(count - 1, 1));
    const system = build(drawing, Object.keys(drawing.drives)), poses = values.map(() => null), stops = [], order = values.map((_, k) => k).sort((a, b) => values[a] - values[b]);
    for (const side of [order.filter((k) => values[k] >= drawn), order.filter((k) => values[k] < drawn).reverse()]) {
      let reached = { at: system.start, values: drawnStrokes(drawing), done: true };
      for (const k of side) {
        reached = follow(system, reached.at, reached.values, { [drive]: values[k] });
        if (!reached.done) { stops.push({ value: reached.values[drive], ...ended(system, reached, { [drive]: values[k] }) }); break; }
        poses[k] = placesOf(system, reached.at);
      }
    }
    return { values, poses, stops };
  }

  /* ---- by hand ---- */

  /* Return the stroke of a drive at places, a crank's next to a value that it had. */
  function strokeAt({ drawing, index, start }, name, at, before) {
    const { kind, ends, drawn } = drawing.drives[name], [P, Q] = ends.map((each) => index[each]), arm = (places) => [places[2 * Q] - places[2 * P], places[2 * Q + 1] - places[2 * P + 1]];
    if (kind === "cylinder") return drawn + hypot(...arm(at)) - hypot(...arm(start));
    const angle = (places) => { const [x, y] = arm(places); return atan2(y, x); }, value = drawn + angle(at) - angle(start);
    return value + TURN * round((before - value) / TURN);
  }
  /* Return the end of a stroke that a value is beyond; null where it is within, and for a crank that goes all the way round. */
  function endOf({ kind, start, end }, value) {
    if (kind === "crank" && abs(end - start) >= TURN - 1e-9) return null;
    const low = min(start, end), high = max(start, end), slack = 1e-12 * (high - low);
    return value < low - slack ? low : value > high + slack ? high : null;
  }
  /* Return which drive at its end keeps a point from where the links let it come nearest to its goal, and by how much; null where none does. */
  function heldBack(pinned, at, values) {
    const open = { ...pinned, rows: pinned.rows.filter((row) => !row.drive) }, places = relaxed(open, at, values, new Set(rowsOf(open, "goal"))), { drives } = pinned.drawing;
    const beyond = ({ part, name, drive }, gap) => drive && gap * (2 * values[name] - drives[name].start - drives[name].end) > 0 ? [{ part, name, gap }] : [];
    const [found] = places ? missed(pinned, places, values).flatMap(([gap], k) => beyond(pinned.rows[k], gap)).sort((a, b) => abs(b.gap) - abs(a.gap)) : [];
    return found && abs(found.gap) > 1e-6 * pinned.size ? found : null;
  }
  function drag(drawing, point, goal) {
    const { drives, fixed } = drawing, system = build(drawing, []), X = system.index[point], held = {};
    const answer = (at, strokes, stopped = "", short = null) => ({ points: placesOf(system, at), strokes, stopped, short });
    let at = system.start, strokes = drawnStrokes(drawing), reach = 0.05 * system.size;
    if (fixed.includes(point)) return answer(at, strokes, say("{name} is fixed", { name: point }));
    if (!system.columns.has(X)) { at[2 * X] = goal[0]; at[2 * X + 1] = goal[1]; return answer(at, strokes); }
    const off = (places) => [goal[0] - places[2 * X], goal[1] - places[2 * X + 1]], away = (places) => hypot(...off(places));
    for (let turn = 0; turn < 200 && away(at) > 1e-10 * system.size && reach > 1e-6 * system.size; turn++) {
      const part = min(1, reach / away(at)), rows = missed(system, at, strokes), pull = off(at).map((each, axis) => [-part * each, [X, 1 - axis, axis]]);
      const change = leastChange(system, [...rows, ...pull], [...rows.map(() => STRONG), 1, 1], 1e-5);
      let next = closed(system, moved(system, at, change), strokes), there = {};
      for (const name of next ? Object.keys(drives) : []) {
        there[name] = strokeAt(system, name, next, strokes[name]);
        const end = endOf(drives[name], there[name]);
        if (end === null || name in held || endOf(drives[name], strokes[name]) !== null) continue;
        held[name] = end;
        system.rows.push(driveRow(drawing, system.index, name));
        next = closed(system, moved(system, at, change, 0), { ...strokes, [name]: end }, 0.9);
        if (!next) { system.rows.pop(); delete held[name]; break; }
        there = {};
        for (const each of Object.keys(drives)) there[each] = each in held ? held[each] : strokeAt(system, each, next, strokes[each]);
        break;
      }
      const isNearer = next && away(next) < (1 - 1e-5) * away(at);
      if (next && (isNearer || Object.keys(held).some((name) => strokes[name] !== held[name]))) { at = next; strokes = { ...there, ...held }; reach = min(1.5 * reach, 0.05 * system.size); } else reach *= 0.4;
    }
    if (away(at) <= 1e-6 * system.size) return answer(at, strokes);
    const pins = goal.map((each, axis) => ({ part: "goal", name: point, put: (places) => [places[2 * X + axis] - each, [X, 1 - axis, axis]] }));
    const pinned = { ...system, rows: [...system.rows, ...pins] }, short = heldBack(pinned, at, strokes) || shortest(pinned, at, strokes, rowsOf(pinned, "links"));
    return answer(at, strokes, short ? saidShort(short) : say("{name} ends here", { name: point }), short);
  }

  /* ---- what is loose ---- */

  /* Count the freedom by the rank of the constraints at the drawn pose, and tell what still moves while the drives are held. */
  function mobility(drawing) {
    const drives = Object.keys(drawing.drives), locked = build(drawing, drives), open = { ...locked, rows: locked.rows.filter((row) => !row.drive) };
    const values = drawnStrokes(drawing), rankOf = (system) => eliminated(dense(system, missed(system, system.start, values)), system.n);
    const without = rankOf(open), held = rankOf(locked), lasting = held.basis.filter((vector) => staysFree(locked, vector, values));
    const loose = locked.free.filter((_, k) => lasting.some((vector) => hypot(vector[2 * k], vector[2 * k + 1]) > 1e-7)).map((k) => locked.names[k]);
    const found = { freedom: locked.n - without.rank, drives: drives.length, redundant: open.rows.length - without.rank, loose, singular: lasting.length < held.basis.length };
    return { ...found, blocked: held.rank - without.rank < drives.length && !found.singular, words: locked.n ? saidMobility(found, held.rank - without.rank) : say("nothing moves yet") };
  }
  /* Return whether what is free at first stays so on the way, and is no matter of this one pose. */
  function staysFree(system, vector, values) {
    const share = (1e-3 * system.size) / most(vector), next = closed(system, moved(system, system.start, vector, share), values, 0.9);
    return next !== null && hypotOf(next, system.start) > 0.5 * share * norm(vector);
  }
  function saidMobility({ freedom, drives, redundant, loose, singular }, driven) {
    if (singular) return say("drawn in a singular pose: it may go on in two ways from here. Draw it a little aside");
    if (freedom && !drives) return say("a freedom of {freedom} and no drive: a crank or a cylinder drives it", { freedom });
    if (loose.length) return say("loose: {names}. A link, a fixed point, a slide or a drive holds them", { names: loose.join(", ") });
    if (freedom === 0) return say("it does not move: it has a link or a fixed point too many");
    if (driven < drives) return say("its drives are in each other's way: {drives} for a freedom of {freedom}", { drives, freedom });
    if (redundant) return say("it moves as its drives say. Conditions more than needed: {redundant}; Python may refuse them", { redundant });
    return say("it moves as its drives say");
  }
  return Object.assign(own, { mobility, run, drag, sweep });
})();
