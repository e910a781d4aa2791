/* A drawing as text: Python, TOML, the board's file and an address, and the way back. Nothing here knows the page.

   Python and TOML are letter by letter what `MachineSketch.to_python` and `to_toml` write, once `model.lacking` has nothing to say.
     writers.python(drawing), writers.toml(drawing), writers.file(drawing), writers.address(drawing)
     writers.opened(text)    { drawing, wrong } from the text of a file or of an address, whatever stands before its "board:1." */
const writers = (() => {
  const { abs, sqrt } = Math, DEGREE = 0.017453292519943295, MILLIMETRE = 0.001, WIDTH = 120, ADDRESS = "board:1.";

  /* ---- numbers as Python writes them ---- */

  /* Return a number with all its digits. */
  function number(value) {
    const [digits, power] = value.toExponential().split("e"), exponent = Number(power);
    if (value !== 0 && (exponent < -4 || exponent >= 16)) return `${digits}e${exponent < 0 ? "-" : "+"}${String(abs(exponent)).padStart(2, "0")}`;
    return Number.isInteger(value) ? `${value}.0` : /e/.test(value) ? value.toFixed(25).replace(/0+$/, "") : String(value);
  }
  /* Return a number in up to nine digits, without zeros at the end. */
  function short(value) {
    const [digits, power] = value.toExponential(8).split("e"), exponent = Number(power), bare = (text) => (text.includes(".") ? text.replace(/\.?0+$/, "") : text);
    return exponent < -4 || exponent >= 9 ? `${bare(digits)}e${exponent < 0 ? "-" : "+"}${String(abs(exponent)).padStart(2, "0")}` : bare(value.toFixed(8 - exponent));
  }
  /* Return a value as text in a unit where that is short and reads back as the same, else as it is. */
  function inUnit(value, name, size) {
    const text = short(value / size);
    return value !== 0 && Number(text) * size === value ? `${text} ${name}` : value;
  }
  const degrees = (value) => (abs(value) < 1e9 ? inUnit(value, "deg", DEGREE) : value);
  /* Return a number without the last digits that are noise. */
  function noiseless(value) { const found = Number(value.toPrecision(15)); return abs(found - value) <= 1e-15 * abs(value) ? found : value; }
  /* Return the distance of two points to the last bit: a square root, put right by what its square misses (Dekker's products). */
  function distance([a, b], [c, d]) {
    const x = c - a, y = d - b, split = (value) => { const far = 134217729 * value, high = far - (far - value); return [high, value - high]; };
    const squared = (value) => { const [high, low] = split(value), product = value * value; return [product, high * high - product + 2 * high * low + low * low]; };
    const [p, q] = squared(x), [r, s] = squared(y), sum = p + r, part = sum - p, rest = p - (sum - part) + (r - part) + q + s, root = sqrt(sum), [u, v] = squared(root);
    return root === 0 ? 0 : root + (sum - u + (rest - v)) / (2 * root);
  }

  /* ---- the tables of a machine's file ---- */

  /* Return the sections of a drawing in their order, each with its members by name. */
  function tables({ points, fixed, links, slides, drives, weights, lengths }) {
    const of = Object.entries, found = { strokes: {}, drawn: {}, ground: {}, points: {}, pins: {}, links: {}, guides: {}, slides: {}, hydraulics: {}, loads: {} };
    const given = (names) => Object.fromEntries(names.flatMap((P) => names.filter((Q) => Q !== P && Object.hasOwn(lengths, P + Q)).map((Q) => [P + Q, lengths[P + Q]])));
    const cranks = of(drives).filter(([, each]) => each.kind === "crank"), cylinders = of(drives).filter(([, each]) => each.kind !== "crank"), isTurned = (names) => cranks.some(([, { ends }]) => names.length === 2 && ends.every((each) => names.includes(each)));
    found.drawn.sketch = {};
    for (const [name, { start, end, drawn }] of of(drives)) { found.strokes[name] = [start, end]; found.drawn.sketch[name] = drawn; }
    for (const name of fixed) found.ground[name] = points[name];
    for (const [name, { ends: [O, A] }] of cranks) found.points[A] = { Crank: O, at: points[A], ...given([O, A]), angle: name };
    for (const [name, place] of of(points)) if (!fixed.includes(name) && !found.points[name]) found.pins[name] = { at: place };
    for (const [name, all] of of(links)) if (!all.every((each) => fixed.includes(each)) && !isTurned(all)) found.links[name] = { points: all.join(" "), ...given(all) };
    for (const [name, { ends: [P, Q], start, end, drawn }] of cylinders) {
      const isGiven = Object.hasOwn(lengths, P + Q), closed = isGiven ? lengths[P + Q] : noiseless(distance(points[P], points[Q]) - drawn);
      found.links[`rod_${name}`] = { points: `${P} ${Q}`, [P + Q]: !isGiven && Math.min(start, end) <= 0 ? name : `${number(closed)} + ${name}` };
    }
    for (const [name, { point, along }] of of(slides)) {
      found.guides[`line_${name}`] = Array.isArray(along) ? { from: along[0], to: along[1] } : { from: points[point], angle: inUnit(along, "deg", DEGREE) };
      found.slides[name] = { point, guide: `line_${name}` };
    }
    for (const [name, { ends, bore, rod }] of cylinders) if (bore) found.hydraulics[`cylinder_${name}`] = { Cylinder: ends, bore, rod };
    for (const [name, { point, mass }] of of(weights)) found.loads[name] = { Weight: point, mass };
    return Object.fromEntries(of(found).filter(([, table]) => Object.keys(table).length));
  }

  /* ---- Python ---- */

  const quoted = (text) => `"${text}"`, at = (place) => `(${place.map(number).join(", ")})`;
  const MEMBERS = {
    points: ({ Crank, at: place, ...words }) => `Crank(${[Crank, `at=${at(place)}`, ...worded(words)].join(", ")})`,
    pins: (table) => `Pin(at=${at(table.at)})`,
    links: ({ points, ...words }) => `Link(${[quoted(points), ...worded(words)].join(", ")})`,
    guides: ({ from, to, ...words }) => `Guide(${[Array.isArray(from) ? at(from) : quoted(from), ...(to ? [quoted(to)] : []), ...worded(words)].join(", ")})`,
    slides: ({ point, guide }) => `Slide(${quoted(point)}, ${guide})`,
    hydraulics: ({ Cylinder, ...words }) => `Cylinder(${[...Cylinder, ...worded(words)].join(", ")})`,
    loads: ({ Weight, ...words }) => `Weight(${[Weight, ...worded(words)].join(", ")})`,
  };
  const worded = (table) => Object.entries(table).map(([name, value]) => `${name}=${typeof value === "string" ? value.replace(" deg", " * deg") : number(value)}`);
  function python(drawing) {
    const found = tables(drawing), { name } = drawing, lines = found.hydraulics ? ["from hydraulics import Cylinder"] : [];
    lines.push("from linkage import *", "", "", `class ${name}(Mechanism):`, `    """${name}, as it is drawn."""`, ...drawing.notes.map((note) => `    # ${note}`), "");
    for (const [stroke, { kind, start, end }] of Object.entries(drawing.drives)) {
      const high = kind === "crank" ? inUnit(end, "deg", DEGREE) : end;
      lines.push(`    ${stroke} = Stroke(${number(start)}, ${typeof high === "string" ? high.replace(" ", " * ") : number(high)})`);
    }
    lines.push(`    sketch = drawn(${worded(found.drawn.sketch).join(", ")})`, "", ...Object.entries(found.ground || {}).map(([each, place]) => `    ${each} = Ground${at(place)}`));
    for (const [section, member] of Object.entries(MEMBERS)) for (const [each, table] of Object.entries(found[section] || {})) lines.push(`    ${each} = ${member(table)}`);
    return `${lines.join("\n")}\n`;
  }

  /* ---- TOML ---- */

  const text = (value) => JSON.stringify(value).replaceAll("\x7f", "\\u007f"), key = (name) => (/^[A-Za-z0-9_-]+$/.test(name) ? name : text(name));
  function inline(value) {
    if (Array.isArray(value)) return `[${value.map(inline).join(", ")}]`;
    if (typeof value === "string") return text(value);
    return typeof value === "number" ? number(value) : `{ ${Object.entries(value).map(([name, each]) => `${key(name)} = ${inline(each)}`).join(", ")} }`;
  }
  function toml(drawing) {
    const found = tables(drawing), doc = drawing.notes.join(" ").trimStart(), head = [`name = ${text(drawing.name)}`, ...(doc ? [`doc = ${text(doc)}`] : [])];
    for (const [name, { kind }] of Object.entries(drawing.drives)) if (kind === "crank") {
      found.strokes[name] = found.strokes[name].map(degrees);
      found.drawn.sketch[name] = degrees(found.drawn.sketch[name]);
    }
    for (const each of Object.values(found.hydraulics || {})) for (const size of ["bore", "rod"]) each[size] = inUnit(each[size], "mm", MILLIMETRE);
    return `${[head.join("\n"), ...Object.entries(found).map(([name, table]) => section(name, table))].join("\n\n")}\n`;
  }
  /* Return a section: a line for each member where all fit, else a table for each. */
  function section(name, table) {
    const members = Object.entries(table), lines = members.map(([each, value]) => `${key(each)} = ${inline(value)}`), isTables = members.every(([, value]) => typeof value === "object" && !Array.isArray(value));
    if (!isTables || lines.every((line) => [...line].length <= WIDTH)) return [`[${name}]`, ...lines].join("\n");
    return members.map(([each, value]) => [`[${name}.${key(each)}]`, ...Object.entries(value).map(([part, inner]) => `${key(part)} = ${inline(inner)}`)].join("\n")).join("\n\n");
  }

  /* ---- the board's own file and address ---- */

  const file = (drawing) => `${JSON.stringify(drawing, null, 1)}\n`;
  function address(drawing) {
    const full = Object.fromEntries(Object.entries(drawing).filter(([, each]) => typeof each !== "object" || Object.keys(each).length));
    const letters = btoa(Array.from(new TextEncoder().encode(JSON.stringify({ points: {}, ...full })), (each) => String.fromCharCode(each)).join(""));
    return `${ADDRESS}${letters.replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "")}`;
  }
  function opened(given) {
    const place = given.lastIndexOf(ADDRESS);
    if (place < 0 || given.trimStart().startsWith("{")) return model.read(given);
    try {
      const letters = atob(given.slice(place + ADDRESS.length).trim().replaceAll("-", "+").replaceAll("_", "/"));
      return model.read(new TextDecoder().decode(Uint8Array.from(letters, (each) => each.charCodeAt(0))));
    } catch { return model.read(""); }
  }

  return { python, toml, file, address, opened };
})();
