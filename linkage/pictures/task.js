/* What a synthesis found: its task on the sheet and on the curve, what the present design misses of it, and the answers. */

const { task } = data, GRID = 121, STRETCHES = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 1e4, 1e5, 1e6];
const wantedCount = (task.points || task.values).length, turned0 = (value) => value - 2 * PI * round(value / (2 * PI));
let answered = 0;
/* The machine as it is, its stroke at other values. */
function posesAt(values) {
  const at = followed(stands), poses = Array.from(values, (value) => at.map((each, k) => (k === task.stroke ? value : each)));
  return engine.sweep(vector(present), own.map((_, k) => Float64Array.from(poses, (pose) => pose[k])));
}
/* How far a pose is off a wanted one: two lengths, of a body its angle as a length too, or the one value. */
function offAt(found, i, n) {
  if (task.values) {
    const off = found.values[columns[task.column].row][i] - task.values[n];
    return [task.turns ? turned0(off) : off];
  }
  const [x, y] = spot(found, task.point, i), off = [x - task.points[n][0], y - task.points[n][1]];
  if (task.angles) {
    const [u, v] = spot(found, task.second, i);
    off.push(task.long * turned0(atan2(v - y, u - x) - task.angles[n]));
  }
  return off;
}
const squaredSum = (off) => off.reduce((sum, each) => sum + each * each, 0);
/* The strokes at which an untimed task is met: from the nearest pose of a grid some steps of Gauss and Newton on. */
function nearestStrokes() {
  const { start, end } = strokes[task.stroke], wide = end - start, step = 1e-6 * abs(wide), each = [...Array(wantedCount).keys()];
  const along = Float64Array.from({ length: GRID }, (_, i) => start + (wide * i) / (GRID - 1)), grid = posesAt(along);
  const at = each.map((n) => {
    let best = 0, least = Infinity;
    for (let i = 0; i < GRID; i++) { const far = grid.reason[i] ? Infinity : squaredSum(offAt(grid, i, n)); if (far < least) { least = far; best = i; } }
    return along[best];
  });
  for (let turn = 0; turn < 5; turn++) {
    const low = posesAt(at.map((value) => value - step)), high = posesAt(at.map((value) => value + step));
    for (const n of each) {
      const a = offAt(low, n, n), b = offAt(high, n, n), slope = a.map((value, k) => (b[k] - value) / (2 * step));
      const move = a.reduce((sum, value, k) => sum - 0.5 * (value + b[k]) * slope[k], 0) / squaredSum(slope);
      const next = at[n] + min(max(move, -0.02 * abs(wide)), 0.02 * abs(wide));
      if (isNumber(next)) at[n] = strokes[task.stroke].turn ? next : min(max(next, min(start, end)), max(start, end));
    }
  }
  return at;
}
let missedOf = null, missed = null;
/* What the present design misses: the poses at the wanted points, how far each is off, their root mean square and the worst. */
function misses() {
  if (missedOf === now) return missed;
  missedOf = now;
  const at = task.timed || isAnswer(answered) ? task.answers[answered].at : nearestStrokes(), found = posesAt(at), far = at.map((_, n) => Math.sqrt(squaredSum(offAt(found, n, n))));
  const whole = far.every(isNumber) && at.every((_, n) => found.reason[n] === 0), worst = far.indexOf(max(...far));
  missed = { at, found, far, whole, worst, rms: Math.sqrt(squaredSum(far) / far.length), stretch: 0 };
  if (task.points && whole) {
    const most = max(...at.map((_, n) => hypot(...offAt(found, n, n).slice(0, 2)))) * zoom, room = 0.07 * min(sheetWide, sheetTall);
    missed.stretch = most > 1e-6 ? STRETCHES.filter((each) => each * most <= room).pop() || 1 : 0;
  }
  return missed;
}
function missWords() {
  const { whole, rms, far, worst } = misses();
  if (!whole) return say("the wanted points cannot all be looked at");
  return say("rms {rms}, at most {most} at point {worst}", { rms: shown(rms, task.unit, 4), most: shown(far[worst], task.unit, 4), worst: worst + 1 });
}
/* The wanted points with their numbers, of poses with a line along the body, and a line to where the machine comes. */
function wanted() {
  if (!task.points) return [answerShown];
  const middle = centroid(task.points), many = wantedCount > 12;
  const bars = draw(sheet, "path", { class: "line", w: 2, stroke: css("curve") }), lines = draw(sheet, "path", { class: "line", w: 1.6, stroke: css("ink") });
  const rings = task.points.map(() => draw(sheet, "circle", { r: many ? 2.6 : 4, w: 1.8, fill: css("paper"), stroke: css("curve") }));
  const texts = task.points.map((_, n) => (many && n && (n + 1) % 5 ? null : draw(sheet, "text", { class: "wanted halo", anchor: "middle" })));
  const words = [28, 12].map((above) => draw(sheet, "text", { x: 12, y: sheetTall - above - beside(), class: "halo" }));
  let seen;
  return [() => {
    answerShown();
    if (seen === now && seen.zoomed === zoom) return;
    seen = now; seen.zoomed = zoom; missedOf = null;
    const { found, whole, stretch } = misses(), places = task.points.map(([x, y]) => px(x, y)), path = [], along = [];
    places.forEach(([x, y], n) => {
      set(rings[n], { cx: x, cy: y });
      if (texts[n]) {
        const [dx, dy] = [task.points[n][0] - middle[0], middle[1] - task.points[n][1]], long = hypot(dx, dy) || 1;
        set(texts[n], { x: x + (13 * dx) / long, y: y + (13 * dy) / long + 4 });
        texts[n].textContent = n + 1;
      }
      if (task.angles) along.push([x, y], [x + zoom * task.long * cos(task.angles[n]), y - zoom * task.long * Math.sin(task.angles[n])], null);
      if (whole && stretch) { const [u, v] = offAt(found, n, n); path.push([x, y], [x + stretch * zoom * u, y - stretch * zoom * v], null); }
    });
    set(lines, { d: broken(path) }); set(bars, { d: broken(along) });
    words[0].textContent = missWords();
    words[1].textContent = stretch > 1 ? say("missed, {times} times as long", { times: fixed(stretch, 0) }) : "";
  }];
}
/* The wanted values on the curve of the function, each on the turn that is nearest, and lines to what the machine gives. */
const isFunction = (one) => task.values && one === columns[task.column] && runs === task.stroke;
function wantedValues(one) {
  if (!isFunction(one)) return null;
  const { found } = misses();
  return task.values.map((value, n) => { const given = found.values[one.row][n], off = offAt(found, n, n)[0]; return (isNumber(off) ? given - off : value) / one.factor; });
}
function wantedOnCurve(x, y, one) {
  const values = wantedValues(one);
  if (!values) return;
  const { found, at } = misses(), stroke = strokes[task.stroke];
  values.forEach((value, n) => {
    const across = x(at[n] / stroke.factor), given = found.values[one.row][n] / one.factor;
    if (isNumber(given)) draw(plot, "line", { x1: across, x2: across, y1: y(value), y2: y(given), w: 1.6, stroke: css("ink") });
    draw(plot, "circle", { cx: across, cy: y(value), r: 3.6, w: 1.8, fill: css("paper"), stroke: css("curve") });
  });
}
/* The answers to choose from; of a design that is none of them nothing is chosen. */
const pick = make("label"), chooser = make("select"), isAnswer = (k) => task.answers[k].design.every((value, i) => value === present[i]);
pick.className = "pick"; chooser.id = "answer";
pick.append(make("span"), chooser);
byId("forces").before(pick);
on(chooser, "change", () => {
  const k = Number(chooser.value);
  if (!task.answers[k]) return;
  answered = k;
  const at = [...stands];
  if (runs === task.stroke) { play(false); at[runs] = task.answers[k].at[0]; }
  moved([...task.answers[k].design], at, say("Answer"));
  soon("design"); remember();
});
function answersSaid() {
  pick.firstChild.textContent = say("Answer");
  chooser.setAttribute("aria-label", say("Answer"));
  const none = option("\u2013", -1);
  none.disabled = true;
  chooser.replaceChildren(none, ...task.answers.map((each, k) => option(`${k + 1}: ${shown(each.rms, task.unit, 3)}`, k)));
  chooser.title = say("The machines that were found, by their root mean square miss");
  answerShown();
}
function answerShown() {
  const k = isAnswer(answered) ? answered : task.answers.findIndex((_, i) => isAnswer(i));
  if (k >= 0) answered = k;
  if (chooser.value !== String(k)) chooser.value = String(k);
}
