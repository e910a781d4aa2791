/* ---- verdicts: of the delivered design in its own words, of a changed one by the same questions; and what is out of bounds at this pose ---- */

const limitText = ([, text, , ru]) => (language === "ru" && ru) || text;
const strokeText = (value) => { const stroke = strokes[runs]; return `${titled(stroke)} = ${shown(value, stroke, 4)}`; };
const standText = (each, value) => `${each.name} = ${standing(each, value)}`;
const placeText = (at) => own.map((each, k) => standText(each, at[k])).join(", ");
const ruled = ({ rule, ru }) => (language === "ru" && ru) || rule;
const questions = data.judge.questions, byKey = new Map(questions.map((each, q) => [each.key, q]));
/* Angles of links of which less is in line [rad], and below which textbooks advise against a loop that carries load. */
const IN_LINE = 1e-3, POOR = (40 * PI) / 180;
let known = { key: "" };
function asked(n) {
  const design = vector(present), key = `${n} ${design.join()}`;
  if (known.key !== key) known = { key, ...asking.ask(design, n, n === STILL) };
  return known;
}

/* ---- in words ---- */

const caseWords = (name) => (name && name !== "plain" ? say("in the case {case}", { case: caseSaid(name) }) : say("under its own loads"));
function situationText(each) {
  const words = [];
  if (each.direction) {
    const direction = each.direction === "extending" ? say("extending") : each.direction === "retracting" ? say("retracting") : say("at rest");
    words.push(each.drive ? say("{direction} {drive}", { direction, drive: each.drive }) : direction);
  }
  if (each.side) words.push(each.side === "piston" ? say("on the piston side") : say("on the rod side"));
  if (each.case) words.push(caseWords(each.case));
  if (each.name) words.push(say("over {over}", { over: each.name }));
  if (each.strokes) words.push(say("at {place}", { place: placeText(each.strokes) }));
  return words.join(", ");
}
/* Four figures, and as many more as tell it from a limit that is missed; of a number without a unit no more than three decimals, as in Python. */
const size = (value, unit, missed = value) => {
  const figures = unit.figures ?? 4, told = (each, more = figures) => shown(unit.unit || more > figures ? each : round(1e3 * each) / 1e3, unit, more);
  return isNumber(value) ? [figures, 5, 6, 7, 8, 9, 10, 11, 12].map((more) => told(value, more)).find((text) => value === missed || text !== told(missed)) ?? told(value) : say("without bounds");
};
/* The number that tells a rule: the condition's own, of a share without a unit the one that its sentence says. */
const unitOf = ({ unit, constraints }, { c }) => constraints[c]?.unit ?? unit;
const ruleNumber = (question, each) => (!question.unit.unit && isNumber(each.says?.value) ? size(each.says.value, question.saysUnit) : size(each.value, unitOf(question, each), each.kept === false ? each.limit : undefined));
function answerText(question, each) {
  const { rule, words, fails, saysUnit } = question, unit = unitOf(question, each);
  if (each.unknown) return say("as delivered: with these sizes the page does not follow it");
  if (each.ok === null) return say("says nothing: no place is left to judge");
  if (!(abs(each.value) >= 0) || (each.kept === false && each.margin >= 0)) return say("it has no value at places that were looked at");
  const limit = size(each.limit, unit), missed = each.kept ? undefined : each.limit, told = each.says && isNumber(each.says.value) ? each.says : each;
  const text = ((each.kept ? words : fails?.[each.symbol]) || [])[language === "ru" ? 1 : 0];
  if (text && (!each.says || told === each.says)) {
    const value = each.says ? size(told.value, saysUnit) : size(each.value, unit, missed), beyond = size(abs(each.value - each.limit), unit);
    const filled = { value, share: value, place: situationText(told), limit, force: beyond, much: beyond, missing: beyond };
    return text.replace(/^; /, "").replace(/\{(\w+)\}/g, (_, name) => filled[name]);
  }
  const given = { value: size(each.value, unit, missed), place: situationText(each), limit };
  const plain = each.symbol === "<=" ? say("greatest {value}, {place}; not above {limit}", given) : say("least {value}, {place}; not below {limit}", given);
  return data.limits[rule] ? `${plain} (${limitText(data.limits[rule])})` : plain;
}
/* How much of its limit is used, 1 where it is met exactly, 1e6 where it is on the wrong side of it; not a number where there is no such share. */
const shareOf = ({ isLength }, each) => (each.share !== undefined ? max(each.share, 0) : (isLength && each.kept) || each.limit === 0 || !(abs(each.value) >= 0) ? NaN : min(each.used, 1e6) || NaN);
/* The delivered verdicts in the language and the units chosen. */
function delivered() {
  const inUnits = data.verdictsIn[system];
  return data.verdicts.map(([state, rule, text, ru, russian], i) => {
    const [english, other] = (inUnits && inUnits[i]) || [text, russian || text], [member, key, isOfPoses, share] = data.facts[i] || ["", "", 0];
    const isFollowed = state === 2 || byKey.has(key) || rule === "assembly" || rule === "dead points";
    return { state, key, rule: (language === "ru" && ru) || rule, text: (language === "ru" && other) || english, member, isFollowed, isOfPoses, share };
  });
}

/* Where places are lost, `assembly` fails; the other rules are kept or not over those that are left. What fails counts so everywhere. */
const goneOf = ({ lost }) => lost.filter((each) => each.share && !each.allowed);
const isKept = (answers, { ok, kept }) => (goneOf(answers).length && ok === false ? kept : ok);
const failing = (answers) => answers.found.filter((each) => isKept(answers, each) === false).length + (goneOf(answers).length ? 1 : 0);

/* ---- what is said: rows with the member they are of, whether they are kept, and the share of their limit ---- */

function verdicts(n = STILL) {
  const found = [], add = (ok, rule, text, more) => found.push({ ok, rule, text, member: "", share: NaN, ...more }), changed = isChanged(), answers = asked(n);
  assembled(answers, goneOf(answers), changed, add);
  if (changed) for (const text of deadPoints()) add(true, say("dead points"), text);
  if (changed) tight(answers, add);
  if (data.task) add(null, say("task"), missWords());
  for (const each of delivered()) {
    const q = byKey.get(each.key), ok = [false, true][each.state];
    if (!changed) add(ok, each.state === 2 ? "" : each.rule, each.text, { member: each.member, share: each.share ?? NaN, open: each.state === 3, q });
    else if (!each.isFollowed) add(null, each.rule, each.text, { stale: true, open: true });
  }
  const told = new Set(data.facts.map(([, key]) => key));
  for (const [q, question] of questions.entries()) if (changed || !(question.member || told.has(question.key))) {
    const each = answers.found[q];
    add(isKept(answers, each), ruled(question), answerText(question, each), { member: question.member, share: shareOf(question, each), open: each.ok === null, q });
  }
  for (const each of data.cylinders) cylinder(each, changed, add);
  return found;
}
/* Whether it is assembled over what the curve shows; of a changed design over all that it runs. */
function assembled(answers, gone, changed, add) {
  const all = now.reached.length === COUNT, stroke = strokes[runs], deepest = gone.reduce((a, b) => (b.share > a.share ? b : a), gone[0]);
  if (!all) {
    const lost = [...now.along.keys()].filter((i) => now.reason[i]), worst = lost.reduce((a, b) => (now.missing[b] > (now.missing[a] || 0) ? b : a), lost[0]);
    const spans = stretches(lost).map(([a, b]) => say("{from} to {to}", { from: shown(now.along[a], stroke, 4), to: shown(now.along[b], stroke, 4) })).join(", ");
    add(false, say("assembly"), why(now, worst, say("not assembled at {stroke} = {spans}", { stroke: titled(stroke), spans })));
    for (const text of ends(lost)) add(null, say("dead point"), text);
  } else if (deepest && changed) {
    const what = say("{share} of the places looked at are lost, deepest at {place}", { share: `${fixed(100 * deepest.share, 1)}\u2009%`, place: placeText(deepest.strokes) });
    add(false, say("assembly"), why({ reason: [deepest.reason], missing: [deepest.missing] }, 0, what));
  } else if (changed) add(true, say("assembly"), say("it is assembled wherever it runs"));
}
/* The least transmission angle over all that the machine runs, where it is poor. */
function tight(answers, add) {
  const least = answers.least.filter(Boolean).reduce((a, b) => (a && a.value <= b.value ? a : b), null);
  if (!least || least.value >= POOR) return;
  const words = { poor: "40\u00b0", angle: `${fixed((least.value * 180) / PI, 1)}\u00b0`, joint: scene.names[data.joints[least.k].point] ?? data.joints[least.k].point, place: situationText({ ...least, name: answers.least.length > 1 ? least.name : "" }) };
  add(null, "", say("The least transmission angle is {angle}, of {joint} {place}: below {poor} pin forces and play grow.", words));
}
/* Return for each stroke the nearest places beyond the ends of all that runs at which the motion ends, in words; up to one length beyond all that is declared, or a turn. */
function deadPoints() {
  const lists = asking.spans(vector(present)).map(({ places, ends }) => places || ends);
  return own.flatMap((stroke, k) => {
    const [a, b] = reachOf(stroke), past = stroke.base === "deg" ? max(PI - 0.5 * (b - a), 0) : b - a;
    const found = [-1, 1].flatMap((sign) => lists.flatMap((list) => {
      const low = min(...list[k]), high = max(...list[k]);
      return high > low || own.length < 2 ? reachEnd(list.map(([each]) => each), k, sign < 0 ? low : high, sign, sign < 0 ? low - a + past : b - high + past) : [];
    }).sort(([one], [other]) => one - other).slice(0, 1));
    return found.length ? [say("none within the stroke; the nearest: {places}", { places: found.map(([, text]) => text).join("; ") })] : [];
  });
}
/* Return how far beyond a value of a stroke the motion ends within a size, and where in words; nothing where it does not. */
function reachEnd(start, k, from, sign, size) {
  const at = (value) => engine.sweep(vector(present), start.map((each, j) => [j === k ? value : each]));
  let good = 0, bad = 0;
  for (let i = 1; i <= 16 && !bad; i++) { const away = (size * i) / 16; if (at(from + sign * away).reason[0] === 0) good = away; else bad = away; }
  if (!bad) return [];
  [good, bad] = halved(good, bad, (away) => at(from + sign * away).reason[0] === 0, 30);
  const reason = at(from + sign * bad).reason[0], step = reason > 0 ? engine.steps[reason - 1] : "", stroke = own[k];
  return good ? [[good, say("of {step} at {where}, {away} beyond it", { step: data.steps[step] || step, where: standText(stroke, from + sign * good), away: shown(good, stroke, 3) })]] : [];
}
function stretches(list) {
  const found = [];
  for (const i of list) { const last = found[found.length - 1]; if (last && last[1] === i - 1) last[1] = i; else found.push([i, i]); }
  return found;
}
/* Return where the reach ends within the stroke, by bisection between the poses. */
function ends(lost) {
  const told = [];
  for (const [a, b] of stretches(lost)) for (const [inside, outside] of [[a - 1, a], [b + 1, b]]) {
    if (inside < 0 || inside >= COUNT || told.length > 3) continue;
    const [good] = halved(now.along[inside], now.along[outside], (value) => single(present, stands.map((each, j) => (j === runs ? value : each))).reason[0] === 0, 20);
    const k = now.reason[outside], step = k > 0 ? engine.steps[k - 1] : "";
    told.push(say("of {step} at {where}, where the reach ends", { step: data.steps[step] || step, where: strokeText(good) }));
  }
  return told;
}
/* Return the least and the greatest of some values with their strokes, a parabola laid through the poses next to them. */
function extremes(values) {
  let low = -1, high = -1;
  for (const i of now.reached) if (isNumber(values[i])) { if (low < 0 || values[i] < values[low]) low = i; if (high < 0 || values[i] > values[high]) high = i; }
  if (low < 0) return null;
  const peak = (i) => {
    const a = values[i - 1], b = values[i], c = values[i + 1], bend = a - 2 * b + c;
    if (!isNumber(a) || !isNumber(c) || !bend) return { value: b, at: now.along[i] };
    const t = (0.5 * (a - c)) / bend;
    return abs(t) > 1 ? { value: b, at: now.along[i] } : { value: b - 0.25 * (a - c) * t, at: now.along[i] + t * (now.along[1] - now.along[0]) };
  };
  return { low: peak(low), high: peak(high) };
}
/* What no verdict says of a cylinder over the curve: how far apart its pins stand, where no length is declared, and what it needs. */
function cylinder(each, changed, add) {
  const lengths = new Float64Array(COUNT).fill(NaN), more = { member: data.groups[each.name] ? each.name : "" };
  for (const i of now.reached) lengths[i] = apart(spot(now, each.P, i), spot(now, each.Q, i));
  const ext = extremes(lengths);
  if (!ext) return;
  if (!each.sized && ext.high.value - ext.low.value > 1e-6) add(null, each.name, say("pins {low} to {high} apart", { low: shown(ext.low.value, data.length, 5), high: shown(ext.high.value, data.length, 5) }), more);
  if (changed && each.beside && ext.high.value - ext.low.value > 1e-6) {
    const slopes = now.reached.slice(1).map((i) => lengths[i] - lengths[i - 1]), k = slopes.findIndex((slope, i) => i && slope * slopes[i - 1] < 0);
    if (k > 0) add(null, each.name, say("its length stands still at about {where}, where its thrust moves nothing", { where: strokeText(now.along[now.reached[k]] + (0.5 * (slopes[k - 1] + slopes[k]) * (now.along[1] - now.along[0])) / (slopes[k - 1] - slopes[k])) }), more);
  }
  const pressed = each.pressure === undefined ? null : extremes(now.values[each.pressure]), before = base.values[each.pressure] || [];
  if (pressed && each.most === undefined && pressed.high.value > 0) add(null, each.name, say("needs up to {pressure} at {where}", { pressure: shown(pressed.high.value, data.pressureUnit, 4), where: strokeText(pressed.high.at) }), more);
  else if (!pressed && now.reached.length && [...before].some(isNumber)) add(false, each.name, say("has no pressure with these sizes; is the rod thinner than the bore?"), more);
}

/* ---- the list: groups that fold, the worst first; each place in it takes the machine there ---- */

const groupName = (member) => (data.groups[member] ?? ["", ""])[language === "ru" ? 1 : 0];
/* A rule as it stands in its group: without the member's name, and not at all where the group is called so. */
function ruleIn({ rule, member }) {
  const plain = member ? rule.replace(` ${member}`, "") : rule;
  return groupName(member).toLowerCase().startsWith(`${plain.toLowerCase()} `) ? "" : plain;
}
const unfolded = new Set();
let toldBefore = "";
function judge(n = STILL) {
  const found = verdicts(n), key = JSON.stringify([language, system, isChanged(), found]);
  byId("looked").textContent = `${say("looked at {n} values a stroke, {count} poses", { n: known.n, count: known.count })}; ${judgedOver()}${data.friction ? `. ${say("Forces and thrusts are without friction; the pressure and the reserve of a cylinder are with it, while it extends.")}` : ""}${data.geared.length ? `. ${data.geared[language === "ru" ? 1 : 0].replace(/\.$/, "")}` : ""}`;
  if (key === toldBefore) return;
  toldBefore = key;
  list(found);
  count(found);
}
const weight = ({ ok, share, rule, stale }) => (stale ? -1e7 : 0) + (ok === false ? 1e6 : rule ? 0 : -1e3) + (isNumber(share) ? share : ok === false ? 1e5 : -1);
function list(found) {
  const groups = new Map(), worst = ([, rows]) => max(...rows.map(weight));
  for (const each of found) {
    const key = each.stale ? " stale" : each.member;
    groups.set(key, [...(groups.get(key) || []), each]);
  }
  const parts = [...groups].sort((a, b) => worst(b) - worst(a));
  byId("groups").replaceChildren(...parts.map(([member, rows]) => group(member, rows.sort((a, b) => weight(b) - weight(a)))));
}
/* A group: its head tells the worst; where a rule fails, those that are kept are folded below it. */
function group(member, rows) {
  const head = make("summary"), title = make("b"), [worst] = rows, kept = rows.filter(({ ok }) => ok === true), fails = rows.some(({ ok }) => ok === false);
  title.textContent = member === " stale" ? say("{n} verdicts do not follow your changes; they are as delivered", { n: rows.length }) : groupName(worst.member) || say("Machine");
  head.className = fails ? "bad" : kept.length ? "ok" : "";
  head.append(title);
  const told = kept.length && say("{n} kept", { n: kept.length });
  if (member !== " stale") {
    const rule = ruleIn(worst), text = fails ? rule : [isNumber(worst.share) && rule, told].filter(Boolean).join(" \u00b7 ");
    head.append(make("span", { textContent: text }), bar(worst));
  }
  const listed = (each) => { const items = make("ul"); items.append(...each.map(item)); return items; }, isSplit = fails && told;
  const rest = isSplit ? [folded(`${member} kept`, false, make("summary", { className: "ok", textContent: told }), listed(kept))] : [];
  return folded(member, fails || (data.task && !member), head, listed(isSplit ? rows.filter(({ ok }) => ok !== true) : rows), ...rest);
}
/* What folds, and stays as it was folded by hand. */
function folded(key, isOpen, ...content) {
  const fold = make("details");
  fold.open = unfolded.has(key) || (isOpen && !unfolded.has(`!${key}`));
  on(fold, "toggle", () => { unfolded[fold.open ? "add" : "delete"](key); unfolded[fold.open ? "delete" : "add"](`!${key}`); });
  fold.append(...content);
  return fold;
}
function item({ ok, rule: full, member, text, share, q }) {
  const row = make("li"), rule = ruleIn({ rule: full, member });
  if (ok === true || ok === false) row.className = ok ? "ok" : "bad";
  if (q !== undefined) row.id = `rule-${q}`;
  if (rule) row.append(make("b", { textContent: `${rule}: ` }));
  row.append(...withPlaces(text), bar({ share }));
  if (ok === false && q !== undefined) row.append(mending(q));
  return row;
}
/* A button that becomes those dimensions of which each alone makes a rule hold, as buttons that set them. */
function mending(q) {
  const place = make("p"), button = (textContent, act) => { const made = make("button", { type: "button", textContent }); on(made, "click", act); return made; };
  place.append(button(say("Which one dimension keeps it?"), () => {
    const found = remedies(q).map(([i, value, exact]) => button(`${dims[i].name} = ${shown(value, dims[i], 7)}${exact ? ` (${exact < value ? "\u2265" : "\u2264"} ${shown(exact, dims[i], 7)})` : ""}`, () => { chosen = [...new Set([...chosen, i])]; listSizes(); put(i, value, true); }));
    const unknown = delivered().filter(({ isFollowed }) => !isFollowed).map(({ rule }) => rule);
    place.replaceChildren(found.length ? say("It is kept with") : say("None alone, within the range of its slider."), ...found.flatMap((each) => [" ", each]));
    if (found.length && unknown.length) place.append(make("small", { textContent: say("May break what the page does not follow: {rules}", { rules: unknown.join(", ") }) }));
  }));
  return place;
}
/* The dimensions with the least changes [its place, value] that make a rule hold and let no other fail: sought with few poses, and judged as all is. Of what is made in sizes, as bores are, the next size, beyond its slider too, and the exact value beside it. */
function remedies(q) {
  const before = failing(asked(STILL)), best = new Map();
  const holds = (i, value, n = 3) => {
    const answers = asking.ask(vector(present.map((each, k) => (k === i ? value : each))), n, n === STILL);
    return answers.found[q].ok === true && failing(answers) < before;
  };
  for (const [i, each] of dims.entries()) for (const end of new Set([each.low, each.high, min(each.low, ...each.sizes), max(each.high, ...each.sizes)])) {
    const at = (t) => present[i] + (end - present[i]) * t;
    const first = [1, 0.25, 0.06].find((t) => holds(i, at(t))), [high] = halved(first, 0, (t) => holds(i, at(t)), first ? 6 : 0);
    if (high < (best.get(i)?.t ?? 2)) best.set(i, { t: high, i, at: (t) => (end < present[i] ? floor : ceil)(at(t) / nice(each)) * nice(each) });
  }
  const made = (i, value) => { const near = dims[i].sizes.filter((each) => (value > present[i] ? each >= value : each <= value)), size = (value > present[i] ? near : near.reverse()).find((each) => holds(i, each, STILL)); return size && size !== value ? [i, size, value] : [i, value]; };
  const found = [...best.values()].sort((a, b) => a.t - b.t).slice(0, 8).map(({ t, i, at }) => made(i, [1, 1.1, 1.25, 1.5, 2].map((k) => at(min(k * t, 1))).find((value) => holds(i, value, STILL))));
  asking.laid(vector(present));
  return found.filter(([, value]) => value !== undefined).slice(0, 6);
}
/* A bar of how much of its limit is used, and the share in figures. */
function bar({ share }) {
  const place = make("span", { className: share > 1 ? "share over" : "share" });
  if (!isNumber(share)) return place;
  const fill = make("i"), percent = share < 1e6 ? `${fixed(100 * share, share < 0.995 || share > 1.005 ? 0 : 1)}\u2009%` : "\u221e";
  fill.style.width = `${min(max(100 * share, 1), 100).toFixed(0)}%`;
  place.title = say("{share} of its limit is used", { share: percent });
  place.append(make("span"), percent);
  place.firstChild.append(fill);
  return place;
}
const escaped = (text) => text.replace(/[.*+?^${}()|[\]\\]/g, "\\$&");
const onePlace = `(?:${own.map(({ name }) => escaped(name)).sort((a, b) => b.length - a.length).join("|")}) = [-\u2212]?[\\d\u202f]+(?:[.,]\\d+)?[ \u2009\u00a0]?[^\\s,;:()\\d]+`;
const PLACES = own.length ? new RegExp(`(?<![\\w.])${onePlace}(?:, ${onePlace})*`, "g") : /(?!)/g;
/* Return a sentence with the places in it as buttons that take the machine there. */
function withPlaces(text) {
  const found = [];
  let from = 0;
  for (const { 0: place, index } of text.matchAll(PLACES)) {
    const said = place.replace(/\.$/, ""), at = strokesIn(said);
    if (!at) continue;
    const button = make("a", { href: "#mechanism", role: "button", className: "place", textContent: said, title: say("Take the machine there") });
    const before = text.slice(from, index), acts = data.cases.find((name) => before.includes(caseWords(name))), [, instant = ""] = before.match(/([\d\u202f]+(?:[.,]\d+)?)[ \u2009\u00a0][s\u0441] \($/) || [];
    const named = strokes.findIndex((each) => each.path && before.includes(say("over {over}", { over: each.name }))), path = instant && named < 0 ? strokes.findIndex((each) => each.courses) : named;
    on(button, "click", (event) => { event.preventDefault(); goTo(at, path, acts, instant); });
    found.push(text.slice(from, index), button);
    from = index + said.length;
  }
  return [...found, text.slice(from)];
}
/* Return the strokes of a place in words, [number, value]; null where they are none of the machine's. */
function strokesIn(text) {
  const found = text.split(/, (?=[^ ]+ = )/).map((part) => {
    const [name, value] = part.split(" = "), k = own.findIndex((each) => each.name === name), each = own[k];
    const at = each ? typed(value, each, 1) : NaN, [low, high] = each ? reachOf(each) : [];
    return isNumber(at) && abs(at - within(at, each)) < 1e-3 * (high - low) ? [k, within(at, each)] : null;
  });
  return found.every(Boolean) ? found : null;
}
/* Go to a place: along the path over which it was found, at its instant in time, in its load case, else with the strokes alone. */
function goTo(places, path, acts, instant) {
  play(false);
  if (path >= 0) runsOn(path);
  else if (strokes[runs].path || places.every(([k]) => k !== runs)) runsOn(places[0][0]);
  acting = -1; acting = actingIn(acts);
  const at = [...stands];
  if (path >= 0) at[path] = instant ? within(typed(instant, strokes[path], 1), strokes[path]) : placeOn(path, places); else for (const [k, value] of places) at[k] = value;
  moved(present, at, say("The place"));
  clock = phaseNow();
  choosers(); soon("sweep"); remember();
  sheet.scrollIntoView({ block: "nearest" });
}
/* Return where on a path its strokes come nearest to some values; 10080 parts meet its places, as long as they are few. */
function placeOn(path, places) {
  const { start, end } = strokes[path];
  let best = start, least = Infinity;
  for (let i = 0; i <= 10080; i++) {
    const u = start + ((end - start) * i) / 10080, at = followed(strokes.map(() => u), path), off = places.reduce((sum, [k, value]) => sum + abs(at[k] - value), 0);
    if (off < least) [best, least] = [u, off];
  }
  return best;
}
/* The badge: of the delivered design all delivered verdicts, of a changed one the live ones and how many are as delivered. */
function count(found) {
  const states = data.verdicts.filter(([state]) => state !== 2), changed = isChanged(), badge = byId("badge");
  const fails = [...new Set(found.filter((each) => each.ok === false).map((each) => each.rule))], open = changed ? found.filter((each) => each.open).length : states.filter(([state]) => state === 3).length;
  badge.dataset.fails = fails.length; badge.dataset.open = open;
  const counts = { count: fails.length, open, ok: states.filter(([state]) => state === 1).length, all: states.length };
  byId("verdicts").classList.toggle("changed", changed);
  if (fails.length === 1) badge.textContent = `\u2715 ${fails[0]}: ${say("does not hold")}`;
  else if (fails.length) badge.textContent = say("{count} verdicts fail", counts);
  else if (changed) badge.textContent = open ? say("the live verdicts hold; as delivered or without an answer: {open}", counts) : say("all live verdicts hold");
  else badge.textContent = open ? say("{ok} of {all} verdicts hold; without an answer: {open}", counts) : states.length ? say("{ok} of {all} verdicts hold", counts) : say("all live verdicts hold");
}

/* ---- at this pose ---- */

/* What is out of bounds where the machine stands: rules with their numbers, dead points; whether it is judged, and what is not followed. */
function atPose() {
  const at = followed(stands).slice(0, own.length), { covered, among, found } = asking.here(at, pose, strokes[runs].courses ? strokes[runs].over : -1), faults = [];
  for (const [q, each] of found.entries()) {
    const unit = unitOf(questions[q], each), isOwn = questions[q].unit.unit || !isNumber(each.says?.value), value = isNumber(each.value) ? ruleNumber(questions[q], each) : say("no value");
    if (each.ok === false) faults.push({ q, rule: ruled(questions[q]), text: value, limit: isNumber(each.limit) && isOwn ? size(each.limit, unit) : "", case: each.case === "plain" ? say("own loads") : caseSaid(each.case) });
  }
  for (const each of columns) {
    const given = data.limits[each.name], value = given && each.row !== undefined && !questions.some(({ rule }) => rule === each.name) ? pose.values[each.row][0] : NaN;
    if (given && !given[4] && (given[2] === "below" ? value < given[0] - 1e-9 * each.factor : value > given[0] + 1e-9 * each.factor)) faults.push({ rule: called(each), text: size(value, each, given[0]), limit: size(given[0], each), case: "" });
  }
  for (const { point, row } of data.joints) {
    const angle = pose.values[row][0];
    if (abs(Math.sin(angle)) < IN_LINE) faults.push({ rule: `${say("dead point")} ${point}`, text: `${fixed((angle * 180) / PI, 2)}\u00b0`, limit: "", case: "" });
  }
  const unknown = found.flatMap((each, q) => (each.unknown ? [ruled(questions[q])] : []));
  for (const { rule, isOfPoses, isFollowed } of delivered()) if (isOfPoses && !isFollowed) unknown.push(rule);
  /* The load cases in which this pose is judged, where the one that is shown is none of them. */
  const judgedIn = [...new Set(questions.flatMap(({ leaves }) => leaves.flatMap(({ pieces }) => pieces.filter(({ over }) => among.includes(over)).map((each) => each.case))))].filter(Boolean);
  const cases = judgedIn.includes(data.cases[caseNow()] || "plain") ? [] : judgedIn.map((name) => caseTitle(name === "plain" ? "" : name));
  return { faults, covered, unknown, cases, kept: found.filter((each) => each.ok === true).length };
}
let hereBefore = "";
function here() {
  const line = byId("here"), found = pose.reason[0] === 0 ? atPose() : null, key = JSON.stringify(found);
  if (key === hereBefore) return;
  hereBefore = key;
  const parts = [make("b", { textContent: say("At this pose:") })], add = (kind, textContent) => parts.push(make("span", { className: kind, textContent }));
  const link = (id, kind, text, title) => {
    const made = make("a", { href: "#verdicts", className: kind, textContent: text, title });
    on(made, "click", (event) => { event.preventDefault(); showRow(id); });
    parts.push(made);
  };
  if (found) {
    const open = found.unknown.length;
    if (!found.covered) link("looked", "beyond", say("outside what is judged"), judgedOver());
    if (!found.covered && (found.faults.length || found.kept)) add("open", say("if it were judged:"));
    for (const { q, rule, text, limit, case: acting } of found.faults) link(`rule-${q}`, "bad", `${rule} ${text}${acting ? ` (${acting})` : ""}`, limit ? say("limit {limit}", { limit }) : "");
    if (!found.faults.length && (found.kept || !open)) add(found.covered ? "ok" : "open", open ? say("{n} kept", { n: found.kept }) : say("all kept"));
    if (found.cases.length) add("beyond", say("judged here not under the loads shown, but: {cases}", { cases: found.cases.join(", ") }));
    if (open) add("open", say("{n} not followed here: {rules}", { n: open, rules: [...found.unknown.slice(0, 6), ...(open > 6 ? ["\u2026"] : [])].join(", ") }));
  }
  line.replaceChildren(...parts.flatMap((each) => [each, " "]));
}
/* Where the verdicts look: at what is declared, or in which box of strokes. */
function judgedOver() {
  const reach = (each, list) => { const [low, high] = [min(...list), max(...list)].map((value) => shown(value, each, 4)); return low === high ? low : say("{from} to {to}", { from: low, to: high }); };
  const overs = asking.spans(vector(present)).map(({ name, ends, places }) => name || own.map((each, k) => `${each.name} = ${reach(each, (ends || places)[k])}`).join(", "));
  return say("judged over {overs}", { overs: overs.join("; ") });
}
/* Unfold a row of the verdicts, such as a rule, and go to it. */
function showRow(id) {
  const row = byId(id) || byId("verdicts");
  for (let fold = row; (fold = fold.parentElement.closest("details")); ) fold.open = true;
  row.scrollIntoView({ block: "center" });
  row.classList.add("shown");
  setTimeout(() => row.classList.remove("shown"), 1500);
}

