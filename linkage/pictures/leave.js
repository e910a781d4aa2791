/* ---- what was found leaves the page, and what is pasted sets it; designs kept beside each other; units ---- */

/* Return what this design has set beside the class's own defaults: names with values [SI], points with two. */
function settings() {
  const values = new Map(Object.entries(data.beside)), plain = new Map();
  dims.forEach(({ name, value }, i) => { if (present[i] !== (data.defaults[name] ?? value)) values.set(name, present[i]); });
  const now = (name) => (byName.has(name) ? present[byName.get(name)] : data.beside[name] ?? data.defaults[name]);
  for (const [name, value] of values) {
    const point = /\.[xy]$/.test(name) ? name.slice(0, -2) : "", pair = point && [now(`${point}.x`), now(`${point}.y`)];
    if (pair && pair.every(isNumber)) plain.set(point, pair); else plain.set(name, value);
  }
  return [...plain];
}
/* A number as it is copied: to what matters; a pressure or an angle in the unit that is shown, as `measured` writes it, of a point both. */
const figure = (value) => String(Number(value.toPrecision(7)));
function figures([name, given], measured) {
  const { unit = "", factor } = dims[byName.get(name)] ?? {}, typeable = unit.replace("\u00b2", "2");
  return /^(bar|MPa|psi|kgf\/cm2|deg)$/.test(typeable) ? measured(figure(given / factor), typeable) : given.length ? given.map(figure) : figure(given);
}
function asPython() {
  const units = new Set(), inUnit = (number, shown) => { const unit = shown.replace("/", "_"); units.add(unit); return `${number} * ${unit}`; }, isPlain = ([name]) => !name.includes(".");
  const value = (each) => { const text = figures(each, inUnit); return text.map ? `(${text.join(", ")})` : text; }, found = settings();
  const dotted = found.filter((each) => !isPlain(each)).map((each) => `"${each[0]}": ${value(each)}`);
  const made = [...found.filter(isPlain).map((each) => `${each[0]}=${value(each)}`), ...(dotted.length ? [`**{${dotted.join(", ")}}`] : [])].join(", ");
  const from = [units.size ? `from linkage.units import ${[...units].join(", ")}\n` : "", data.module ? `from ${data.module} import ${data.class}\n` : ""].join("");
  return `${from}${from && "\n"}machine = ${data.class}(${made})${found.length ? "" : "  # unchanged"}\n`;
}
const asToml = () => {
  const lines = settings().map((each) => { const text = figures(each, (number, unit) => `"${number} ${unit}"`); return `${each[0].includes(".") ? `"${each[0]}"` : each[0]} = ${text.map ? `[${text.join(", ")}]` : text}`; });
  return [`machine = "${data.machine}"`, "", "[set]", ...(lines.length ? lines : ["# unchanged"])].join("\n") + "\n";
};
const asOptions = () => settings().map((each) => `--set ${each[0]}=${figures(each, (number, unit) => number + unit)}`).join(" ") || "# unchanged";
for (const [form, text] of Object.entries({ python: asPython, toml: asToml, options: asOptions })) on(byId(`as-${form}`), "click", (event) => { byId("text").value = text(); copied(text(), event.currentTarget.firstChild); });

/* Return what a text sets, by names, and the names that are none here: Python, TOML, --set, or a link of this page. */
function pasted(text) {
  const set = new Map(), unknown = [], wrong = [], at = new Map(), link = /(?:^|#|[?&])([sd]\.[^\s]*=.*)$/s.exec(text.trim());
  if (link) {
    for (const [key, value] of new URLSearchParams(link[1])) {
      const name = key.slice(2), number = Number(value);
      if (!/^[sd]\./.test(key)) continue;
      if (!isNumber(number) || !value.trim()) wrong.push(`${name} = ${value}`);
      else if (key[0] === "d") { if (byName.has(name)) set.set(byName.get(name), number); else unknown.push(name); }
      else if (own.some((each) => each.name === name)) at.set(own.findIndex((each) => each.name === name), number); else unknown.push(name);
    }
    return { set, at, unknown, wrong };
  }
  const NUMBER = "[-+]?(?:\\d+\\.?\\d*|\\.\\d+)(?:e[-+]?\\d+)?", UNIT = "[^\\s\\d,;\"'\\[\\](){}=+*-][^\\s,;\"'\\[\\](){}=+*]*", SIZE = `["']?[ \\t]*${NUMBER}(?:[ \\t]*\\*?[ \\t]*${UNIT})?[ \\t]*["']?`;
  const found = new RegExp(`["']?([A-Za-z_][\\w.]*)["']?\\s*[=:]\\s*(?:[\\[(]\\s*(${SIZE})\\s*,\\s*(${SIZE})\\s*,?\\s*[\\])]|(${SIZE})(?:,(${SIZE}))?(?=\\s|,|\\)|\\}|$))`, "gi");
  const put = (name, size) => {
    if (!byName.has(name)) { unknown.push(name); return; }
    const each = dims[byName.get(name)], value = typed(size.replace(/["']/g, "").replace("*", " "), each, 1);
    if (isNumber(value) && !(each.positive && !(value > 0))) set.set(byName.get(name), value); else wrong.push(`${name} = ${size.trim()}`);
  };
  for (const [, name, first, second, one, other] of text.matchAll(found)) {
    const pair = first !== undefined ? [first, second] : other !== undefined && byName.has(`${name}.x`) ? [one, other] : null;
    if (pair) { put(`${name}.x`, pair[0]); put(`${name}.y`, pair[1]); } else if (name !== "set") put(name, one);
  }
  return { set, at, unknown, wrong };
}
on(byId("take"), "click", () => {
  const { set, at, unknown, wrong } = pasted(byId("text").value), design = [...present], standing = [...stands];
  if (unknown.length || wrong.length || !(set.size || at.size)) {
    const words = { names: unknown.join(", "), values: wrong.join(", ") };
    warn(unknown.length ? say("not on this page: {names}; nothing was changed", words) : wrong.length ? say("no value: {values}; nothing was changed", words) : say("no setting was found in the text: OB=0.315, M=(0.152, 1.135), or a link"));
    return;
  }
  for (const [i, value] of set) design[i] = value;
  for (const [k, value] of at) standing[k] = within(value, strokes[k]);
  for (const i of set.keys()) if (!chosen.includes(i)) chosen.push(i);
  play(false);
  taken(design, standing);
  listSizes(); soon("design"); remember();
});

/* ---- the curve as CSV, the picture as SVG and PNG ---- */

const bare = () => data.class.replace(/\W+/g, "_");
function curveText() {
  const stroke = strokes[runs], heads = [[titled(stroke), stroke.unit], ...[columns[column], columns[second]].filter(Boolean).map((each) => [each.name, each.unit])];
  const lists = [chart.along, chart.values, chart.others].filter((list, k) => list || (k === 1 && columns[column]));
  const quoted = (cell) => (/[",\n]/.test(cell) ? `"${cell.replace(/"/g, '""')}"` : cell);
  const rows = chart.along.map((_, i) => lists.map((list) => (list && isNumber(list[i]) ? String(list[i]) : "")));
  return [heads.slice(0, lists.length).map(([name, unit]) => quoted(unit ? `${name} [${unit}]` : name)), ...rows].map((row) => row.join(",")).join("\n") + "\n";
}
on(byId("csv"), "click", () => handed(`${bare()}_${columns[column].name.replace(/\W+/g, "_")}.csv`, "text/csv", curveText()));
/* Return the sheet as a picture that stands by itself: colours and letters in the elements themselves. */
function pictured() {
  const copy = sheet.cloneNode(true), names = ["fill", "fill-opacity", "stroke", "stroke-width", "stroke-dasharray", "stroke-linecap", "stroke-linejoin", "opacity", "visibility", "font-family", "font-size", "font-style", "font-weight", "text-anchor", "dominant-baseline", "paint-order"];
  const from = [sheet, ...sheet.querySelectorAll("*")], to = [copy, ...copy.querySelectorAll("*")];
  from.forEach((each, i) => { const style = getComputedStyle(each); for (const name of names) to[i].setAttribute(name, style.getPropertyValue(name)); to[i].removeAttribute("style"); });
  for (const each of [...copy.querySelectorAll(".grip")]) each.remove();
  Object.entries({ xmlns: SVG, width: sheetWide, height: sheetTall, viewBox: `0 0 ${sheetWide} ${sheetTall}` }).forEach(([name, value]) => copy.setAttribute(name, value));
  const ground = document.createElementNS(SVG, "rect");
  set(ground, { width: sheetWide, height: sheetTall, fill: getComputedStyle(root).getPropertyValue("--paper").trim() || "#fff" });
  copy.prepend(ground);
  return new XMLSerializer().serializeToString(copy);
}
on(byId("svg"), "click", () => handed(`${bare()}.svg`, "image/svg+xml", pictured()));
on(byId("png"), "click", async () => {
  const picture = new Image(), canvas = make("canvas", { width: round(2 * sheetWide), height: round(2 * sheetTall) });
  picture.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(pictured())}`;
  await picture.decode();
  canvas.getContext("2d").drawImage(picture, 0, 0, canvas.width, canvas.height);
  canvas.toBlob((blob) => handed(`${bare()}.png`, "image/png", blob));
});

/* ---- designs beside each other ---- */

let kept = [];
on(byId("keep"), "click", () => {
  const letter = "ABCDEFGH"[[..."ABCDEFGH"].findIndex((each) => !kept.some((one) => one.letter === each))];
  if (!letter) { warn(say("eight designs are kept; drop one first")); return; }
  kept.push({ letter, design: [...present] });
  kept.sort((a, b) => (a.letter < b.letter ? -1 : 1));
  compared(); remember();
});
/* What the verdicts find of designs that do not change. */
const judged = new WeakMap();
const foundOf = (design) => judged.get(design) ?? judged.set(design, asking.ask(vector(design), STILL, true)).get(design);
/* The designs in columns: the dimensions in which they differ, the ends of the curve, and the live rules that fail in one of them. */
function compared() {
  const table = byId("kept"), head = make("tr"), all = [{ letter: say("now"), design: present }, { letter: say("delivered"), design: original }, ...kept];
  table.hidden = !kept.length;
  if (!kept.length) { table.replaceChildren(); return; }
  head.append(make("td"), ...all.map(({ letter, design }, k) => {
    const cell = make("th", { scope: "col" });
    if (k < 2) { cell.textContent = letter; return cell; }
    const take = make("button", { type: "button", textContent: letter, title: say("Show design {name}", { name: letter }) }), drop = make("button", { type: "button", className: "drop", textContent: "\u00d7", title: say("Drop design {name}", { name: letter }) });
    drop.setAttribute("aria-label", drop.title);
    on(take, "click", () => { moved([...design], stands, letter); listSizes(); soon("design"); remember(); });
    on(drop, "click", () => { kept = kept.filter((each) => each.letter !== letter); compared(); remember(); });
    cell.append(take, drop);
    return cell;
  }));
  const line = (name, cells, plain) => { const row = make("tr"), title = make("th", { scope: "row", textContent: name }); row.append(title, ...cells.map((text, k) => make("td", { textContent: text, className: !plain && text !== cells[1] ? "other" : "" }))); return row; };
  const differ = dims.map((_, i) => i).filter((i) => all.some(({ design }) => design[i] !== original[i]));
  const rows = differ.map((i) => line(`${dims[i].name}${dims[i].unit ? `, ${signed(dims[i].unit)}` : ""}`, all.map(({ design }) => short(design[i] / dims[i].factor, 6))));
  const one = columns[column], curves = all.map(({ design }) => { const found = one && one.row !== undefined ? sweep(design, stands, runs) : null; return found ? finite(found.values[one.row]).map((each) => each / one.factor) : []; });
  if (one && one.row !== undefined) {
    rows.push(line(say("least {name}", { name: heading(one) }), curves.map((list) => (list.length ? short(min(...list), 4) : "\u2013"))));
    rows.push(line(say("greatest {name}", { name: heading(one) }), curves.map((list) => (list.length ? short(max(...list), 4) : "\u2013"))));
  }
  const answers = all.map(({ design }) => (design === present ? asked(down.size ? DRAGGING : STILL) : foundOf(design)));
  asking.laid(vector(present));
  const crossed = (fails) => (fails ? "\u2715 " : "");
  if (answers.some((each) => goneOf(each).length)) rows.push(line(say("assembly"), answers.map((each) => crossed(goneOf(each).length) || "\u2713")));
  questions.forEach((each, q) => { if (answers.some((one) => isKept(one, one.found[q]) === false || one.found[q].unknown)) rows.push(line(ruled(each), answers.map((one) => (one.found[q].unknown ? "\u2013" : `${crossed(isKept(one, one.found[q]) === false)}${ruleNumber(each, one.found[q])}`)))); });
  rows.push(line(say("rules that fail, live"), answers.map((each) => String(failing(each)))));
  const top = make("thead"), body = make("tbody");
  top.append(head); body.append(...rows);
  table.replaceChildren(top, body);
}

/* ---- units: as delivered, or one of the four systems ---- */

let system = "";
const things = [...dims, ...columns, ...strokes.filter((each) => each.unit), data.length, data.force, data.pressureUnit, ...data.judge.questions.flatMap(({ unit, saysUnit }) => [unit, saysUnit])].filter(Boolean);
for (const each of things) each.base ??= each.unit;
function inSystem(name) {
  system = name in data.systems ? name : "";
  for (const each of things) {
    const [factor, measure] = data.measures[each.base] || [each.factor, ""], unit = data.systems[system]?.[measure] ?? each.base;
    each.unit = unit;
    each.factor = data.measures[unit] ? data.measures[unit][0] : factor;
  }
  byId("system").value = system;
}
on(byId("system"), "change", (event) => { inSystem(event.target.value); speak(); remember(); });
