/* ---- texts on the sheet: names and values stand where they cover neither pins, arrows nor each other, by the rule of printed pictures ---- */

/* How far off a text may stand, in halves of its height; from the place LED on a line leads to what it is of. Costs are in covered cells of the sheet. */
const FAR_OUT = [1, 1.8, 3, 4.5, 7, 10, 14, 19, 25, 33], LED = 3, WAYS = 16, CELL = 4, NAME_FONT = 'italic 14px "DejaVu Sans", Verdana, sans-serif', FORCE_FONT = '12px system-ui, "DejaVu Sans", sans-serif', CLEAR = 1.5, COVERED_TEXT = 400, OFF_SHEET = 900, LEADING = 10, CROSSED_TEXT = 40, ON_PIN = 8, ON_ARROW = 4, STRAY = 150;
let texts = [], arrows = [], boxes = [], foot = 0;
/* The points that are touched: on a phone theirs alone are told. */
let touched = [];
const phone = window.matchMedia("(max-width: 599px)");
const isTold = (point) => !phone.matches || !byId("forces") || touched.includes(point);
const ruler = make("canvas").getContext("2d"), widths = new Map();
function wideOf(said, font) {
  const key = font + said;
  if (!widths.has(key)) { ruler.font = font; widths.set(key, ruler.measureText(said).width); }
  return widths.get(key);
}
/* Make a text of a point and the line that leads to it. It says nothing until it has `said`, and stands about its `anchor`, best on along `way`. */
function label(point, kind, font, tall, ink) {
  const leader = draw(sheet, "line", { w: 0.8 }), text = draw(sheet, "text", { class: kind });
  leader.style.stroke = text.style.fill = ink;
  const made = { point, leader, text, font, tall, said: "", chosen: -1, cost: 0 };
  texts.push(made);
  return made;
}
/* What each cell of the sheet has of the machine, as sums from its upper left corner: edges of bodies, cylinders, pins, arrows. */
function covered(at) {
  const wide = ceil(sheetWide / CELL) + 1, tall = ceil(sheetTall / CELL) + 1, sums = new Float32Array(wide * tall);
  const dot = ([x, y], worth) => { const i = ceil(x / CELL), j = ceil(y / CELL); if (i > 0 && j > 0 && i < wide && j < tall) sums[j * wide + i] += worth; };
  const line = (a, b, worth) => { const n = min(ceil(apart(a, b) / CELL), 500); for (let k = 0; k <= n; k++) dot([a[0] + ((b[0] - a[0]) * k) / n || a[0], a[1] + ((b[1] - a[1]) * k) / n || a[1]], worth); };
  for (const each of scene.bodies) { const ring = cornersOf(each, at); ring.forEach((a, k) => line(a, ring[(k + 1) % ring.length], 1)); }
  for (const [P, Q] of [...data.cylinders.map(({ P, Q }) => [P, Q]), ...scene.straights.map(({ on: ends }) => ends)]) if (Q !== undefined) {
    const long = apart(at[P], at[Q]) / unit0 || 1, [u, v] = [(at[P][1] - at[Q][1]) / long, (at[Q][0] - at[P][0]) / long];
    for (const side of [-1, 0, 1]) line([at[P][0] + side * u, at[P][1] + side * v], [at[Q][0] + side * u, at[Q][1] + side * v], 2);
  }
  for (const { on: [P, Q], lines } of scene.loads) {
    const [x, y] = P === undefined ? px(0, 0) : at[P], turn = Q === undefined ? 0 : atan2(at[Q][1] - y, at[Q][0] - x), [c, s] = [zoom * cos(turn), zoom * Math.sin(turn)];
    for (const { rows } of lines) rows.forEach(([a, b], k) => { if (k) line(...[rows[k - 1], [a, b]].map(([along, across]) => [x + c * along + s * across, y + s * along - c * across]), 2); });
  }
  for (const { point, way } of scene.grounds) for (const far of [2, 3.6]) dot([at[point][0] + far * unit0 * cos(way), at[point][1] - far * unit0 * Math.sin(way)], ON_ARROW);
  for (const i of [...scene.pins, ...scene.dots]) for (const [x, y] of [[0, 0], [1, 0], [-1, 0], [0, 1], [0, -1]]) dot([at[i][0] + 0.5 * x * unit0, at[i][1] + 0.5 * y * unit0], ON_PIN);
  for (const [a, b] of arrows) line(a, b, ON_ARROW);
  for (let j = 1; j < tall; j++) for (let i = 1; i < wide; i++) sums[j * wide + i] += sums[j * wide + i - 1] + sums[(j - 1) * wide + i] - sums[(j - 1) * wide + i - 1];
  const index = (x, y) => min(max(floor(y / CELL), 0), tall - 1) * wide + min(max(floor(x / CELL), 0), wide - 1);
  return ([left, top, right, bottom]) => sums[index(right + CELL, bottom + CELL)] - sums[index(left, bottom + CELL)] - sums[index(right + CELL, top)] + sums[index(left, top)];
}
const meet = (a, b) => a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3];
/* Whether a line goes through a box (Liang and Barsky, 1984). */
function crosses([[x, y], [u, v]], [left, top, right, bottom]) {
  let low = 0, high = 1;
  for (const [step, room] of [[x - u, x - left], [u - x, right - x], [y - v, y - top], [v - y, bottom - y]]) {
    if (step === 0) { if (room < 0) return false; } else if (step < 0) low = max(low, room / step); else high = min(high, room / step);
  }
  return low < high;
}
const nearestIn = ([left, top, right, bottom], [x, y]) => [min(max(x, left), right), min(max(y, top), bottom)];
/* The places a text may take, the best first: those near along its way, then turned from it, then farther off. */
function spotsOf(each) {
  const { said, font, tall, way, first, anchor: [x, y], near = 0 } = each, half = [0.5 * wideOf(said, font) + CLEAR, 0.5 * tall + CLEAR], begin = atan2(way[1], way[0]);
  return (k) => {
    let dx = first && first[0], dy = first && first[1];
    if (!first || k) {
      const n = k - (first ? 1 : 0), turn = n % WAYS, a = begin + ((turn % 2 ? 1 : -1) * ceil(turn / 2) * 2 * PI) / WAYS, far = near + 0.5 * tall * FAR_OUT[floor(n / WAYS)];
      dx = far * cos(a) + half[0] * min(max(1.4142 * cos(a), -1), 1); dy = far * Math.sin(a) + half[1] * min(max(1.4142 * Math.sin(a), -1), 1);
    }
    return [x + dx - half[0], y + dy - half[1], x + dx + half[0], y + dy + half[1]];
  };
}
/* Put every text where it costs least, other texts above all. One that stood well stays where it is beside its point; one without a free place is not shown. */
function placed(at) {
  const cells = covered(at), done = [], inside = [2, 2, sheetWide - 2, sheetTall - foot - 2], pins = [...scene.pins, ...scene.dots];
  for (const each of texts) {
    const isOff = !each.said || !isTold(each.point) || !meet([...each.anchor, ...each.anchor], [-1, -1, sheetWide + 1, sheetTall + 1]);
    if (!isOff) {
      const spot = spotsOf(each), count = FAR_OUT.length * WAYS + (each.first ? 1 : 0), led = LED * WAYS + (each.first ? 1 : 0);
      const lead = (k, box) => (k >= led ? [nearestIn(box, each.anchor), each.anchor] : null);
      const costOf = (k, most) => {
        const box = spot(k), line = lead(k, box);
        let cost = 0.04 * k + (line ? LEADING : 0);
        if (cost >= most) return cost;
        cost += cells(box);
        for (const other of boxes) if (meet(box, other)) cost += COVERED_TEXT;
        for (const other of done) {
          if (meet(box, other.box)) cost += COVERED_TEXT;
          if ((line && crosses(line, other.box)) || (other.line && crosses(other.line, box))) cost += CROSSED_TEXT;
        }
        if (box[0] < inside[0] || box[1] < inside[1] || box[2] > inside[2] || box[3] > inside[3]) cost += OFF_SHEET;
        if (each.first && cost < most) {
          const own = apart(nearestIn(box, each.anchor), each.anchor);
          for (const i of pins) if (i !== each.point && apart(at[i], each.anchor) > unit0 && 1.05 * own > apart(nearestIn(box, at[i]), at[i])) cost += STRAY;
        }
        return cost;
      };
      let cost = each.chosen < 0 ? Infinity : costOf(each.chosen, Infinity);
      if (!(cost <= each.cost + 2)) {
        for (let k = 0; k < count && 0.04 * k < cost; k++) { const found = costOf(k, cost); if (found < cost) { cost = found; each.chosen = k; } }
        each.cost = cost;
      }
      each.box = spot(each.chosen); each.line = lead(each.chosen, each.box);
      each.free = cost < COVERED_TEXT;
      if (each.free) done.push(each);
    }
    const isShown = !isOff && each.free, line = (isShown && each.line) || [[0, 0], [0, 0]];
    for (const one of [each.text, each.leader]) set(one, { visibility: isShown ? "visible" : "hidden" });
    if (each.text.textContent !== each.said) each.text.textContent = each.said;
    if (isShown) set(each.text, { x: 0.5 * (each.box[0] + each.box[2]), y: 0.5 * (each.box[1] + each.box[3]) });
    set(each.leader, { x1: line[0][0], y1: line[0][1], x2: line[1][0], y2: line[1][1] });
  }
}
