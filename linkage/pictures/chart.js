/* ---- the cells ---- */

const chart = byId("chart"), across = data.x.length, count = data.load.length, told = () => data.said[language];
/* The pose of each cell among those of the cells that are reached; -1 for none. */
const poses = ((n) => data.load.map((load) => (load === null ? -1 : n++)))(0);
const loadText = (load) => (load === null ? "" : isNumber(load) ? fixed(load / data.loads.factor, data.loads.digits) : load);
const withUnit = (text) => `${text}\u2009${told().unit}`;
const lengthText = (value) => fixed(value / data.lengths.factor, data.lengths.digits);
const coloured = data.letters.filter((letter) => letter);
const colour = (limiter) => (data.letters[limiter] ? `color-mix(in srgb, ${css(`body${coloured.indexOf(data.letters[limiter]) % 10}`)} var(--share), var(--paper))` : "");
const child = (parent, kind, text = "") => { const found = make(kind); found.textContent = text; return parent.appendChild(found); };
const best = data.load.reduce((most, load, i) => (isNumber(load) && !(load <= data.load[most]) ? i : most), max(poses.findIndex((each) => each >= 0), 0));
let cell = best, cells = [], heads = [];

/* Write the chart as it is printed. */
function written() {
  chart.replaceChildren();
  const head = child(chart, "thead"), top = child(head, "tr"), row = child(head, "tr"), body = child(chart, "tbody");
  Object.assign(child(top, "th", told().down), { className: "axis", rowSpan: 2 });
  Object.assign(child(top, "th", told().across), { className: "axis", colSpan: across });
  heads = data.x.map((x) => Object.assign(child(row, "th", lengthText(x)), { scope: "col" }));
  cells = []; heads.push(...data.y.map((y, k) => {
    const line = child(body, "tr"), label = Object.assign(child(line, "th", lengthText(y)), { scope: "row" });
    for (let n = 0; n < across; n++) {
      const i = k * across + n, each = child(line, "td", loadText(data.load[i])), letter = data.letters[data.limiter[i]];
      each.id = `cell${i}`; each.style.background = colour(data.limiter[i]);
      if (letter) child(each, "sup", letter);
      cells.push(each);
    }
    return label;
  }));
  byId("limiters").replaceChildren(...data.letters.map((letter, k) => [letter, k]).filter(([letter]) => letter).map(([letter, k]) => {
    const item = make("li");
    child(item, "span", letter).className = "chip";
    item.firstChild.style.background = colour(k);
    item.append(`${told().limiters[k]} (${data.counts[k]})`);
    return item;
  }));
  byId("terms").replaceChildren(...told().terms.map((text) => make("li", { textContent: text })));
}

/* Write all that the cell says that is pointed at. */
function detailed() {
  const i = cell, limiter = data.limiter[i], load = data.load[i], words = told(), unit = unitText(data.lengths.unit);
  byId("place").textContent = `x = ${lengthText(data.x[i % across])}${unit}, y = ${lengthText(data.y[floor(i / across)])}${unit}`;
  byId("load").replaceChildren();
  child(byId("load"), "b", load === null ? words.limiters[limiter] : withUnit(loadText(load)));
  if (data.letters[limiter]) byId("load").append(say("limited by {name}", { name: words.limiters[limiter] }));
  byId("why").textContent = words.why[i];
  const row = (parent, texts, least) => { const line = child(parent, "tr"); if (least) line.className = "least"; return [line, ...texts.map((text) => child(line, "td", text))]; };
  const [of, values] = ["of", "strokes"].map((id) => { const body = byId(id).querySelector("tbody"); body.replaceChildren(); byId(id).hidden = load === null; return body; });
  if (load === null) return;
  for (const [k, each] of Object.entries(data.of)) {
    const [, name] = row(of, ["", withUnit(loadText(each[i]))], Number(k) === limiter);
    const chip = child(name, "span", data.letters[k]);
    chip.className = "chip"; chip.style.background = colour(k);
    name.append(words.limiters[k]);
  }
  for (const each of data.strokes) {
    const value = each.values[poses[i]], [line] = row(values, [each.name, shown(value, each, 4)]), place = child(line, "td"), range = child(place, "div"), mark = child(range, "i");
    place.className = "range-of"; range.className = "range"; range.title = `${shown(each.start, each, 4)} \u2026 ${shown(each.end, each, 4)}`;
    mark.style.left = `${(100 * (value - each.start)) / (each.end - each.start)}%`;
  }
}

/* ---- the machine in the pose of the cell ---- */

const there = [...data.values[0].keys()];
base = now = { values: data.values, reached: there };
pose = { values: data.values.map((row) => [row[max(poses[cell], 0)]]) };
/* The places of all cells, and the border of what is reached, under the machine; over it a cross at the cell's own place. */
function cellPlaces() {
  const group = draw(sheet, "g", { class: "field" });
  draw(group, "path", { class: "line", w: 1.3, stroke: css("muted"), d: broken(data.border.flatMap(([a, b, c, d]) => [px(a, b), px(c, d), null])) });
  for (let i = 0; i < count; i++) {
    const [cx, cy] = px(data.x[i % across], data.y[floor(i / across)]), is = poses[i] >= 0;
    set(draw(group, "circle", { cx, cy, r: is ? 3.4 : 1.3 }), { fill: (is && colour(data.limiter[i])) || css("rule"), stroke: is ? css("rule") : "none" });
  }
}
function cross() {
  const path = draw(sheet, "path", { class: "field line", w: 2, stroke: css("accent") });
  return () => { const [x, y] = px(data.x[cell % across], data.y[floor(cell / across)]), r = 9; set(path, { d: broken([[x - r, y], [x + r, y], null, [x, y - r], [x, y + r]]) }); };
}
function machine() {
  if (poses[cell] >= 0) pose = { values: data.values.map((row) => [row[poses[cell]]]) };
  sheet.dataset.away = poses[cell] >= 0 ? "0" : "1";
  const at = scene.names.map((_, p) => px(...spot(pose, p, 0)));
  for (const part of parts) part(at);
}
function sized() {
  edition++; fit(false);
  parts = drawn({ under: () => { cellPlaces(); return []; }, over: () => [...named(), cross()] });
  machine();
}

/* ---- what is pointed at ---- */

function point(i) {
  for (const each of [cells[cell], heads[cell % across], heads[across + floor(cell / across)]]) { each.removeAttribute("aria-selected"); delete each.dataset.here; }
  cell = i;
  cells[cell].setAttribute("aria-selected", "true");
  for (const each of [heads[cell % across], heads[across + floor(cell / across)]]) each.dataset.here = "1";
  chart.setAttribute("aria-activedescendant", cells[cell].id);
  detailed(); machine();
}
for (const event of ["pointerover", "pointerdown"]) on(chart, event, ({ target }) => {
  const i = cells.indexOf(target.closest("td"));
  if (i >= 0 && i !== cell) point(i);
});
const nearest = (list, value) => list.reduce((best, each, i) => (abs(each - value) < abs(list[best] - value) ? i : best), 0);
for (const event of ["pointermove", "pointerdown"]) on(sheet, event, ({ clientX, clientY }) => {
  const box = sheet.getBoundingClientRect(), x = (clientX - box.left - left0) / zoom, y = (top0 - clientY + box.top) / zoom;
  const i = nearest(data.y, y) * across + nearest(data.x, x);
  if (i !== cell) point(i);
});
on(document, "keydown", (event) => {
  if (event.altKey || event.ctrlKey || event.metaKey) return;
  const column = cell % across, steps = { ArrowLeft: -min(column, 1), ArrowRight: min(across - 1 - column, 1), ArrowUp: -across, ArrowDown: across, Home: -column, End: across - 1 - column };
  if (!(event.key in steps)) return;
  event.preventDefault();
  const i = cell + steps[event.key];
  if (i >= 0 && i < count) { point(i); cells[cell].scrollIntoView({ block: "nearest", inline: "nearest" }); }
});
on(byId("language"), "click", () => { language = language === "ru" ? "en" : "ru"; speak(); });
on(byId("look"), "click", () => { look(root.dataset.look === "dark" ? "light" : "dark"); chosenLook = true; });
function speak() {
  labelled();
  byId("title").textContent = document.title = told().title;
  written(); point(cell);
}

look(night.matches ? "dark" : "light");
speak(); sized();
new ResizeObserver(sized).observe(sheet);

/* For tests and for pages around this one: read and choose the cell. */
window.hydrolinkage = { data, cell: () => cell, point, points: () => Object.fromEntries(scene.names.map((each, p) => [each, spot(pose, p, 0)])) };
