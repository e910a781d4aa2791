/* Questions of a design over all that the machine runs: on a grid, then by stencils about the worst; no more poses than `most` in all.
   What has no value counts as Python's judge counts it: lost, unlimited, outside, or nothing left. */
const judging = (engine, { overs: given, questions, most }) => {
  const { abs, max, min, floor } = Math, isNumber = Number.isFinite, MET = 1e-9;
  /* The ends and places of each `Over` as a design has them: [row, value] follows it, as the program says, and is the value as delivered. */
  const delivered = (each) => (Array.isArray(each) ? each[1] : each), every = (over, act) => (over.places || over.ends).map((list) => list.map(act));
  const follows = given.some((over) => every(over, Array.isArray).flat().some(Boolean));
  const held = (over, act) => {
    const found = every(over, act);
    return over.places ? { ...over, places: found } : { ...over, ends: found.map(([a, b]) => [min(a, b), max(a, b)]) };
  };
  const spans = (vector) => {
    if (!follows || !vector) return given.map((over) => held(over, delivered));
    const { values } = engine.sweep(vector, every(given[0], delivered).map(([value]) => [value]));
    return given.map((over) => held(over, (each) => (Array.isArray(each) && isNumber(values[each[0]][0]) ? values[each[0]][0] : delivered(each))));
  };
  let overs, axes;
  const laid = (vector) => {
    overs = spans(vector);
    axes = overs.map(({ shape, ends, places }) => (shape === "box" ? ends.flatMap(([a, b], k) => (a < b ? [[a, b, k]] : [])) : shape === "path" && places[0].length > 1 ? [[0, places[0].length - 1, 0]] : []));
  };
  laid();
  const operations = { "+": (a, b) => a + b, "-": (a, b) => a - b, "*": (a, b) => a * b, "/": (a, b) => a / b, "**": (a, b) => a ** b };
  /* The strokes at a place: of a box its running strokes, of a path the share of its legs, of poses their number. */
  const strokesAt = (o, u) => {
    const { shape, ends, places } = overs[o];
    if (shape === "box") { const found = ends.map(([a]) => a); axes[o].forEach(([, , k], j) => { found[k] = u[j]; }); return found; }
    const i = shape === "path" ? min(floor(u[0] || 0), max(places[0].length - 2, 0)) : u[0], t = shape === "path" ? (u[0] || 0) - i : 0;
    return places.map((p) => (t === 0 ? p[i] : t === 1 ? p[i + 1] : p[i] + (p[i + 1] - p[i]) * t));
  };
  const steps = (o, n) => axes[o].map(([a, b]) => (overs[o].shape === "path" ? (n - 1) * (b - a) : n - 1));
  const size = (n) => overs.reduce((sum, over, o) => sum + (over.shape === "poses" ? over.places[0].length : steps(o, n).reduce((count, each) => count * (each + 1), 1)), 0);
  const grid = (o, n) => {
    if (overs[o].shape === "poses") return overs[o].places[0].slice(0, most).map((_, i) => [i]);
    const counts = steps(o, n);
    return axes[o].reduce((list, [a, b], j) => list.flatMap((u) => Array.from({ length: counts[j] + 1 }, (_, i) => [...u, i === counts[j] ? b : a + ((b - a) * i) / counts[j]])), [[]]);
  };
  const ask = (vector, wanted, refines) => {
    laid(vector);
    let n = wanted, count = 0;
    while (n > 2 && size(n) > most) n--;
    const look = (o, list) => {
      count += list.length;
      const at = list.map((u) => strokesAt(o, u)), found = engine.sweep(vector, overs[o].places ? overs[o].places.map((_, k) => at.map((p) => p[k])) : overs[o].ends.map((_, k) => at.map((p) => p[k])));
      const asked = list.map((_, i) => found.reason[i] === 0 && overs[o].only.every((row) => found.values[row][i] >= 0));
      return { ...found, list, asked };
    };
    const seen = overs.map((_, o) => look(o, grid(o, n)));
    /* What is lost of an Over: its share, and the place where most is missing. */
    const lost = seen.map(({ reason, missing, list }, o) => {
      let worst = -1, gone = 0;
      for (let i = 0; i < list.length; i++) if (reason[i]) { gone++; if (worst < 0 || missing[i] > (missing[worst] || 0)) worst = i; }
      return { share: gone / list.length, allowed: overs[o].lost, reason: worst < 0 ? 0 : reason[worst], missing: worst < 0 ? 0 : missing[worst], strokes: worst < 0 ? null : strokesAt(o, list[worst]), over: overs[o].name };
    });
    /* The worst of a piece among some poses. */
    const worstOf = (piece, found, known = { score: -Infinity, u: null, lawless: 0, unlimited: 0, unknown: 0 }) => {
      const { list, asked, values } = found, result = { ...known };
      for (let i = 0; i < list.length; i++) {
        if (!asked[i]) continue;
        const v = values[piece.row][i], free = piece.reciprocal ? v <= 0 : Number.isNaN(v) && values[piece.gaps][i] <= 0;
        if (values[piece.assumed][i] < 0) result.unknown++;
        else if (free) result.unlimited++;
        else if (Number.isNaN(v)) result.lawless++;
        else if (piece.sense * v > result.score) { result.score = piece.sense * v; result.u = list[i]; }
      }
      return result;
    };
    const valueOf = (piece, { score, u }) => (u === null ? NaN : piece.reciprocal ? (score > 0 ? 1 / score : NaN) : piece.stays ? max(score, 0) : piece.sense * score);
    const first = strokesAt(0, seen[0].list[0]), one = engine.sweep(vector, first.map((value) => [value]));
    const worsts = questions.map(({ leaves }) => leaves.map(({ at, pieces }) => pieces.map((piece) => (at ? { score: one.values[piece.row][0] * piece.sense, u: [], lawless: 0, unlimited: 0, unknown: 0 } : worstOf(piece, seen[piece.over])))));
    const judged = (q) => {
      const { leaves, constraints } = questions[q], found = [];
      const measure = (each, chosen) => (typeof each === "number" ? each : Array.isArray(each) ? operations[each[0]](measure(each[1], chosen), measure(each[2], chosen)) : valueOf(leaves[each.leaf].pieces[chosen[each.leaf]], worsts[q][each.leaf][chosen[each.leaf]]));
      const used = (each) => (typeof each === "number" ? [] : Array.isArray(each) ? [...used(each[1]), ...used(each[2])] : [each.leaf]);
      for (const [c, { symbol, left, right }] of constraints.entries()) for (let o = 0; o < overs.length; o++) {
        const own = [...new Set([...used(left), ...used(right)])];
        let combos = [{}];
        for (const l of own) combos = combos.flatMap((combo) => leaves[l].pieces.flatMap((piece, k) => (leaves[l].at || piece.over === o ? [{ ...combo, [l]: k }] : [])));
        for (const combo of combos) {
          const pieces = own.map((l) => leaves[l].pieces[combo[l]]), parts = own.map((l) => worsts[q][l][combo[l]]);
          const cases = new Set(pieces.map((each) => each.case).filter(Boolean)), ways = new Set(pieces.filter((each) => each.direction).map((each) => `${each.direction} ${each.drive}`));
          if (cases.size > 1 || ways.size > 1) continue;
          const a = measure(left, combo), b = measure(right, combo), near = MET * max(isNumber(a) ? abs(a) : 0, isNumber(b) ? abs(b) : 0);
          const apart = symbol === ">=" ? a - b : symbol === "<=" ? b - a : 1e3 * near - abs(a - b);
          const chief = pieces.findIndex((each, k) => !leaves[own[k]].at), sum = (name) => max(...parts.map((each) => each[name]));
          found.push({ value: a, limit: b, symbol, c, margin: apart < 0 && apart >= -near ? 0 : apart, over: o, leaf: own[chief], piece: combo[own[chief]], at: pieces[chief], u: parts[chief] && parts[chief].u, lawless: sum("lawless"), unlimited: sum("unlimited"), unknown: sum("unknown") });
        }
      }
      const known = found.filter((each) => !Number.isNaN(each.margin)), unknown = found.some((each) => each.unknown), lawless = found.some((each) => each.lawless && !overs[each.over].lost);
      if (unknown) return { ok: null, unknown: true };
      const gone = found.some((each) => lost[each.over].share && !overs[each.over].lost);
      if (!known.length) return { ok: lawless || gone || found.some((each) => each.lawless) ? false : null, kept: lawless ? false : null, value: NaN };
      const worst = known.reduce((a, b) => (b.margin < a.margin ? b : a)), kept = worst.margin >= 0 && !lawless, { at } = worst;
      const several = (name) => new Set(found.map((each) => (each.at ? each.at[name] : ""))).size > 1;
      const sides = new Set(found.filter((each) => each.at && at && each.at.direction === at.direction).map((each) => each.at.side)).size > 1;
      return { ...worst, ok: kept && !gone, kept, strokes: worst.u === null ? null : strokesAt(worst.over, worst.u), case: several("case") ? at.case : "", direction: several("direction") ? at.direction : "", drive: new Set(found.map((each) => each.at && each.at.drive).filter(Boolean)).size > 1 ? at.drive : "", side: sides ? at.side : "", name: overs.length > 1 ? overs[worst.over].name : "" };
    };
    const found = questions.map((_, q) => judged(q));
    for (let round = 0; refines && round < 12; round++) for (const [q, each] of found.entries()) {
      if (!each.u || !axes[each.over].length || overs[each.over].shape === "poses" || count + 3 ** axes[each.over].length > most) continue;
      const counts = steps(each.over, n), list = axes[each.over].reduce((all, [a, b], j) => all.flatMap((u) => [-1, 0, 1].map((sign) => [...u, min(max(each.u[j] + (sign * (b - a)) / counts[j] / 2 ** (round + 1), a), b)])), [[]]);
      const piece = questions[q].leaves[each.leaf].pieces[each.piece], before = worsts[q][each.leaf][each.piece];
      worsts[q][each.leaf][each.piece] = { ...worstOf(piece, look(each.over, list), before), lawless: before.lawless, unlimited: before.unlimited, unknown: before.unknown };
      found[q] = judged(q);
    }
    return { n, count, lost, found };
  };
  return { ask, size, spans };
};
