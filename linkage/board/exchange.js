/* ---- out and in ---- */

const FORMS = {
  python: () => [writers.python(shownNow.drawing), `${fileName()}.py`],
  toml: () => [writers.toml(shownNow.drawing), `${fileName()}.toml`],
  link: () => [`${location.href.split("#")[0]}#${writers.address(shownNow.drawing)}`, `${fileName()}_address.txt`],
  file: () => [writers.file(shownNow.drawing), `${fileName()}.json`],
  task: () => [taskText(), `${fileName()}_task.toml`],
};
const fileName = () => shownNow.drawing.name.toLowerCase();
/* Show the machine as a text, and the commands that go on from there. */
function out(which = form) {
  form = which;
  for (const each of document.querySelectorAll("[data-form]")) each.setAttribute("aria-pressed", String(each.dataset.form === form));
  const wrong = form === "file" ? [] : model.lacking(shownNow.drawing), name = fileName();
  let text = "";
  try { text = !wrong.length || form === "link" ? FORMS[form]()[0] : ""; } catch (error) { text = `# ${error.message}`; }
  byId("text").value = text || (wrong.length ? say("Not yet a machine: {wrong}", { wrong: wrong.join("; ") }) : say("Press the pin whose path is a task."));
  byId("copy-text").disabled = byId("hand").disabled = !text;
  const file = form === "file" ? `${name}.json` : form === "toml" ? `${name}.toml` : `${name}.py`;
  const lines = form === "task" ? [`hydrolinkage synthesise ${name}_task.toml --page found.html`] : [`hydrolinkage show ${file}`, `hydrolinkage page ${file} -o ${name}.html`, `hydrolinkage report ${file} -o ${name}_report.html`];
  byId("commands").replaceChildren(...lines.map((each) => {
    const row = make("div"), copy = button(say("Copy"), () => copied(each, copy));
    copy.setAttribute("aria-label", `${say("Copy")} ${each}`);
    row.append(make("code", { textContent: each }), copy);
    return row;
  }));
}
/* The task of a synthesis: the point, the places it is to pass, and how far its lengths may go. */
function taskText() {
  const { drawing } = shownNow;
  if (!targets?.places.length) return "";
  const free = Object.values(drawing.links).flatMap((points) => points.slice(1).map((each) => [points[0], each])).filter((pair) => !pair.every((each) => drawing.fixed.includes(each)));
  const number = (value) => String(Number((1000 * value).toPrecision(6)));
  const lines = [`machine = "${fileName()}.toml"`, "", "[synthesis]", `path = { of = "${targets.point}", points = [${targets.places.map((at) => `[${at.join(", ")}]`).join(", ")}] }`, "starts = 8", "", "[synthesis.vary]"];
  for (const [P, Q] of free) { const long = model.far(drawing, P, Q); lines.push(`${P}${Q} = "${number(0.5 * long)} to ${number(2 * long)} mm"`); }
  for (const [P, Q, ...others] of Object.values(drawing.links)) for (const X of others) {
    const way = (to) => atan2(...[1, 0].map((axis) => drawing.points[to][axis] - drawing.points[P][axis])), turn = round((((way(X) - way(Q)) / PI) * 180 + 540) % 360 - 180);
    lines.push(`${Q}${P}${X} = "${turn - 45} to ${turn + 45} deg"`);
  }
  return `${lines.join("\n")}\n`;
}
/* Give what a form has to the browser as a file. */
function saved(which) { const [text, name] = FORMS[which](); handed(name, "text/plain", text); }
function save() { saved("file"); tell(say("Saved as {name}", { name: `${fileName()}.json` })); }
/* Open what a text holds: a file of the board or a link; what is wrong with it is said, and the sheet stays. */
function opened(text) {
  const { drawing, wrong } = writers.opened(text);
  if (!drawing) { tell(`${wrong[0]} ${say("Python, TOML and files of other programs are opened by: hydrolinkage board FILE")}`, true); return false; }
  shownNow.picked = null; shownNow.pending = [];
  commit(drawing, say("{name} is open", { name: drawing.name }));
  whole(); redraw();
  return true;
}
/* Open a file that was chosen or dropped. */
async function openedFile(file) {
  if (file && file.size <= model.MOST.bytes) opened(await file.text()); else if (file) tell(say("This file is too large for a drawing."), true);
}
on(byId("file"), "change", async ({ target }) => { await openedFile(target.files[0]); target.value = ""; });
on(byId("take"), "click", () => { if (opened(byId("text-in").value)) byId("text-in").value = ""; });
on(sheet, "dragover", (event) => event.preventDefault());
on(sheet, "drop", (event) => { event.preventDefault(); openedFile(event.dataTransfer.files[0]); });

/* ---- buttons ---- */

for (const each of document.querySelectorAll("button[data-tool]")) on(each, "click", () => choose(each.dataset.tool));
for (const each of document.querySelectorAll("[data-form]")) on(each, "click", () => out(each.dataset.form));
on(byId("undo"), "click", undo); on(byId("redo"), "click", redo);
on(byId("nearer"), "click", () => { nearer(1.25); redraw(); }); on(byId("farther"), "click", () => { nearer(0.8); redraw(); });
on(byId("whole"), "click", () => { whole(); redraw(); });
on(byId("grid"), "click", () => { showsGrid = !showsGrid; byId("grid").setAttribute("aria-pressed", String(showsGrid)); keep(); redraw(); });
on(byId("reshape"), "click", () => { const isOn = byId("reshape").getAttribute("aria-pressed") !== "true"; byId("reshape").setAttribute("aria-pressed", String(isOn)); tell(isOn ? say("Lengths follow the pin that is led") : say("Lengths stay; the machine follows")); });
on(byId("fresh"), "click", () => { if (Object.keys(shownNow.drawing.points).length) { shownNow.picked = null; commit(model.empty(), say("An empty sheet")); } whole(); redraw(); });
on(byId("open"), "click", () => byId("file").click()); on(byId("save"), "click", save);
on(byId("copy-text"), "click", () => copied(byId("text").value, byId("copy-text").firstChild));
on(byId("hand"), "click", () => saved(form));
on(byId("title"), "change", ({ target }) => {
  const fault = model.nameFault(model.empty(), target.value.trim());
  if (fault) { tell(fault, true); target.value = shownNow.drawing.name; } else commit({ ...current(), name: target.value.trim() });
});
on(byId("units"), "change", ({ target }) => { unit(target.value); keep(); stands(shownNow.drawing); });
function unit(name) { lengthUnit = [...byId("units").options].some(({ value }) => value === name) ? name : "mm"; data.length = { factor: LENGTHS[lengthUnit], unit: lengthUnit }; byId("units").value = lengthUnit; }
on(byId("language"), "click", () => { language = language === "ru" ? "en" : "ru"; speak(); });
on(byId("look"), "click", () => { look(root.dataset.look === "dark" ? "light" : "dark"); chosenLook = true; });
function speak() { labelled(); hint(); stands(shownNow.drawing); }

/* ---- begin ---- */

solver.show = (metres) => lengthText(metres, 3);
look(night.matches ? "dark" : "light");
const visit = kept(), first = model.read(delivered);
if (visit) { trails = new Set(visit.trails); ({ targets, showsGrid } = visit); unit(visit.unit); byId("grid").setAttribute("aria-pressed", String(showsGrid)); }
shownNow.drawing = visit?.drawing || first.drawing || model.empty();
shownNow.places = structuredClone(shownNow.drawing.points);
whole(); choose("move"); speak();
if (data.drawing && !visit && !first.drawing) tell(first.wrong[0], true);
/* Open the drawing in the page's address, once: what is done to it later stays when the page is loaded again. */
function linked() { if (location.hash.length > 1 && opened(location.href)) location.replace("#"); }
on(window, "hashchange", linked);
linked();
new ResizeObserver(() => redraw()).observe(sheet);

/* For tests: what is shown. */
window.hydrolinkage = { model, solver, writers, state: () => structuredClone(shownNow), current, px, gridStep };
