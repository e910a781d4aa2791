/* Questions of a design over all that the machine runs: on a grid, then by stencils about the worst; no more poses than `most` in all.
   What has no value counts as Python's judge counts it: lost, unlimited, outside, or nothing left. */
const judging = (engine, { overs: all, questions, most, travel, near }, watched = []) => {
  const given = all.map((over) => (over.courses ? inPlaces(over) : over));
  const { abs, max, min, floor } = Math, isNumber = Number.isFinite, MET = 1e-9, TIE = 1e-9;
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
    const { shape, ends, places, courses } = overs[o];
    if (courses) return atInstant(overs[o], timeAt(overs[o], u[0])).map(([value]) => value);
    if (shape === "box") { const found = ends.map(([a]) => a); axes[o].forEach(([, , k], j) => { found[k] = u[j]; }); return found; }
    const i = shape === "path" ? min(floor(u[0] || 0), max(places[0].length - 2, 0)) : u[0], t = shape === "path" ? (u[0] || 0) - i : 0;
    return places.map((p) => (t === 0 ? p[i] : t === 1 ? p[i + 1] : p[i] + (p[i + 1] - p[i]) * t));
  };
  const steps = (o, n) => axes[o].map(([a, b]) => (overs[o].shape === "path" ? (n - 1) * (b - a) : n - 1));
  const size = (n) => overs.reduce((sum, over, o) => sum + (over.shape === "poses" ? over.places[0].length : steps(o, n).reduce((count, each) => count * (each + 1), 1)), 0);
  const grid = (o, n) => {
    if (overs[o].shape === "poses") return overs[o].places[0].slice(0, most).map((_, i) => [i]);
    const counts = steps(o, n);
    const evenly = axes[o].reduce((list, [a, b], j) => list.flatMap((u) => Array.from({ length: counts[j] + 1 }, (_, i) => [...u, i === counts[j] ? b : a + ((b - a) * i) / counts[j]])), [[]]);
    return overs[o].courses ? withBreaks(overs[o], evenly) : evenly;
  };
  const fixedBy = (piece, { values }) => ({ score: values[piece.row][0] * piece.sense, u: [], lawless: 0, unlimited: 0, unknown: 0 });
  /* The worst of a piece among some poses. */
  const worstOf = (piece, found, known = { score: -Infinity, u: null, lawless: 0, unlimited: 0, unknown: 0 }) => {
    const { list, asked, values } = found, result = { ...known };
    if (!values[piece.row]) return { ...result, unknown: 1 };
    for (let i = 0; i < list.length; i++) {
      if (!asked[i]) continue;
      const v = values[piece.row][i], free = Number.isNaN(v) ? values[piece.gaps][i] <= 0 : piece.reciprocal && v <= 0;
      if (values[piece.assumed]?.[i] < 0) result.unknown++;
      else if (free) result.unlimited++;
      else if (Number.isNaN(v)) result.lawless++;
      else if (result.u === null || piece.sense * v > result.score + TIE * abs(result.score)) { result.score = piece.sense * v; result.u = list[i]; }
    }
    return result;
  };
  const valueOf = (piece, { score, u }) => (u === null ? NaN : piece.reciprocal ? (score > 0 ? 1 / score : NaN) : piece.stays ? max(score, 0) : piece.sense * score);
  /* How far a limit is used, 1 where it is met exactly; of a limit 0 nothing where it is kept, else infinite, as without any bound. */
  const usedOf = (value, limit, symbol, fails) => (!limit || symbol === "==" ? (fails ? Infinity : 0) : (symbol === "<=") === limit > 0 ? max(value / limit, 0) : value / limit > 0 ? limit / value : Infinity);
  const used = (each) => (typeof each === "number" ? [] : Array.isArray(each) ? [...used(each[1]), ...used(each[2])] : [each.leaf]);
  /* What is decided of a question over some overs, by the worst of its pieces; what ties is told of the first. Where measures count as
     `whole`, those pieces count that no other one beats in the same situation. */
  const decided = (q, worsts, among, lost) => {
    const { leaves, constraints, says, share } = questions[q], found = [];
    const measure = (each, chosen) => (typeof each === "number" ? each : Array.isArray(each) ? operations[each[0]](measure(each[1], chosen), measure(each[2], chosen)) : valueOf(leaves[each.leaf].pieces[chosen[each.leaf]], worsts[each.leaf][chosen[each.leaf]]));
    const isBeaten = (l, one, k) => leaves[l].pieces.some((each, j) => ["over", "case", "direction", "drive"].every((name) => each[name] === one[name]) && (worsts[l][j].score > worsts[l][k].score || (worsts[l][j].score === worsts[l][k].score && j < k)));
    for (const [c, { symbol, left, right, whole }] of constraints.entries()) for (const o of among) {
      const own = [...new Set([...used(left), ...used(right)])], isOpen = (l, piece, k) => leaves[l].at || (piece.over === o && !(whole && isBeaten(l, piece, k)));
      for (const combo of own.reduce((list, l) => list.flatMap((each) => leaves[l].pieces.flatMap((piece, k) => (isOpen(l, piece, k) ? [{ ...each, [l]: k }] : []))), [{}])) {
        const pieces = own.map((l) => leaves[l].pieces[combo[l]]), parts = own.map((l) => worsts[l][combo[l]]);
        const cases = new Set(pieces.map((each) => each.case).filter(Boolean)), ways = new Set(pieces.filter((each) => each.direction).map((each) => `${each.direction} ${each.drive}`));
        if (cases.size > 1 || ways.size > 1) continue;
        const a = measure(left, combo), b = measure(right, combo), size = max(isNumber(a) ? abs(a) : 0, isNumber(b) ? abs(b) : 0), close = MET * size;
        const apart = symbol === ">=" ? a - b : symbol === "<=" ? b - a : 1e3 * close - abs(a - b);
        const first = pieces.findIndex((each, k) => !leaves[own[k]].at), chief = max(first, 0), sum = (name) => max(...parts.map((each) => each[name]));
        found.push({ value: a, limit: b, symbol, c, size, margin: apart < 0 && apart >= -close ? 0 : apart, used: usedOf(a, b, symbol, apart < -close), over: o, leaf: own[chief], piece: combo[own[chief]], at: pieces[chief], u: first < 0 ? null : parts[first].u, lawless: sum("lawless"), unlimited: sum("unlimited"), unknown: sum("unknown") });
      }
    }
    const known = found.filter((each) => !Number.isNaN(each.margin)), lawless = found.some((each) => each.lawless && !overs[each.over].lost);
    if (found.some((each) => each.unknown)) return { ok: null, unknown: true };
    const gone = found.some((each) => lost && lost[each.over].share && !overs[each.over].lost);
    if (!known.length) return { ok: lawless || gone || found.some((each) => each.lawless) ? false : null, kept: lawless ? false : null, value: NaN };
    const areAlike = new Set(constraints.map((each) => each.unit?.unit)).size === 1, least = known.reduce((a, b) => ((areAlike || a.c === b.c ? b.margin < a.margin : b.used > a.used * (1 + TIE)) ? b : a));
    const worst = known.find((each) => (areAlike || each.c === least.c) && each.margin <= least.margin + TIE * least.size) ?? least;
    const kept = worst.margin >= 0 && !lawless, several = (name) => new Set(found.map((each) => (each.at && each.at[name]) || "")).size > 1;
    /* Where it stands in words, of a place of one of its pieces. */
    const stood = (at, o, u) => {
      const sides = new Set(found.filter((each) => each.at && at && each.at.direction === at.direction).map((each) => each.at.side)).size > 1;
      return { strokes: u === null ? null : strokesAt(o, u), case: (several("case") && at.case) || "", direction: (several("direction") && at.direction) || "", drive: (new Set(found.map((each) => each.at && each.at.drive).filter(Boolean)).size > 1 && at.drive) || "", side: (sides && at.side) || "", name: overs.length > 1 ? overs[o].name : "" };
    };
    /* Another measure of the same question, of the worst pieces of its leaves, and where the first of these stands. */
    const beside = (tree) => {
      const chosen = {}, own = [...new Set(used(tree))];
      for (const l of own) chosen[l] = worsts[l].reduce((best, each, k) => ((leaves[l].at || among.includes(leaves[l].pieces[k].over)) && (best < 0 || each.score > worsts[l][best].score + TIE * abs(each.score)) ? k : best), -1);
      const l = own.find((each) => !leaves[each].at), piece = leaves[l].pieces[chosen[l]];
      return { value: measure(tree, chosen), ...stood(piece, piece.over, worsts[l][chosen[l]].u) };
    };
    return { ...worst, ok: kept && !gone, kept, ...stood(worst.at, worst.over, worst.u), ...(says ? { says: beside(says) } : {}), ...(share ? { share: beside(share).value } : {}) };
  };
  /* Whether an Over looks at a pose: in its box, or no stroke farther than a part of its travel from a leg, a place or a held value; and its conditions hold. */
  const covers = (o, at, values) => {
    const { shape, ends, places, only } = overs[o], wide = travel.map((each) => near * each);
    if (!only.every((row) => values[row][0] >= 0)) return false;
    if (shape === "box") return ends.every(([a, b], k) => { const air = b > a ? 1e-9 * travel[k] : wide[k]; return at[k] >= a - air && at[k] <= b + air; });
    const count = places[0].length, legs = shape === "path" && count > 1 ? count - 1 : count;
    for (let i = 0; i < legs; i++) {
      let low = 0, high = 1;
      for (let k = 0; k < at.length; k++) {
        const a = places[k][i], step = legs < count ? places[k][i + 1] - a : 0, air = wide[k] / abs(step);
        if (step === 0) { if (abs(at[k] - a) > wide[k]) high = -1; } else { low = max(low, (at[k] - a) / step - air); high = min(high, (at[k] - a) / step + air); }
      }
      if (low <= high) return true;
    }
    return false;
  };
  /* What the questions say of one pose, which `found` is of: over the overs that look at it, over all where none does. A path in time looks
     at it only while it runs; forces over it are known at its rates alone. */
  const here = (at, found, running) => {
    const every = overs.map((_, o) => o), open = every.filter((o) => !overs[o].courses || o === running), own = open.filter((o) => covers(o, at, found.values));
    const among = own.length ? own : open.length ? open : every;
    const one = { list: [[]], asked: [true], values: found.values };
    return { covered: own.length > 0, among, found: questions.map(({ leaves }, q) => decided(q, leaves.map(({ at: fixed, pieces }) => pieces.map((piece) => (fixed ? fixedBy(piece, found) : worstOf(piece.timed && piece.over !== running ? {} : piece, one)))), among, null)).map((each) => ({ ...each, strokes: null, name: "" })) };
  };
  const ask = (vector, wanted, refines) => {
    laid(vector);
    let n = wanted, count = 0;
    while (n > 2 && size(n) > most) n--;
    const look = (o, list) => {
      count += list.length;
      const over = overs[o], at = list.map((u) => strokesAt(o, u));
      const found = engine.sweep(vector, (over.places || over.ends).map((_, k) => at.map((p) => p[k])), over.courses && ratesAt(over, list.map(([u]) => timeAt(over, u))));
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
    const first = strokesAt(0, seen[0].list[0]), one = engine.sweep(vector, first.map((value) => [value]));
    const worsts = questions.map(({ leaves }) => leaves.map(({ at, pieces }) => pieces.map((piece) => (at ? fixedBy(piece, one) : worstOf(piece, seen[piece.over])))));
    const every = overs.map((_, o) => o), judged = (q) => decided(q, worsts[q], every, lost);
    const found = questions.map((_, q) => judged(q));
    for (let round = 0; refines && round < 12; round++) for (const [q, each] of found.entries()) {
      if (!each.u || !axes[each.over].length || overs[each.over].shape === "poses" || count + 3 ** axes[each.over].length > most) continue;
      const counts = steps(each.over, n), list = axes[each.over].reduce((all, [a, b], j) => all.flatMap((u) => [-1, 0, 1].map((sign) => [...u, min(max(each.u[j] + (sign * (b - a)) / counts[j] / 2 ** (round + 1), a), b)])), [[]]);
      const piece = questions[q].leaves[each.leaf].pieces[each.piece], before = worsts[q][each.leaf][each.piece];
      worsts[q][each.leaf][each.piece] = { ...worstOf(piece, look(each.over, list), before), lawless: before.lawless, unlimited: before.unlimited, unknown: before.unknown };
      found[q] = judged(q);
    }
    /* The least of each row that is watched, over every Over. */
    const least = seen.map(({ values, list, asked }, o) => {
      let best = null;
      for (const [k, row] of watched.entries()) for (let i = 0; i < list.length; i++) if (asked[i] && values[row][i] < (best ? best.value : Infinity)) best = { value: values[row][i], k, i };
      return best && { ...best, strokes: strokesAt(o, list[best.i]), name: overs[o].name };
    });
    return { n, count, lost, least, found };
  };
  return { ask, here, size, spans, laid };
};
