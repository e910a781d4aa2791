/* ---- begin ---- */

look(night.matches ? "dark" : "light");
begin();
let first = (base = now = sweep(present, stands, runs));
strokeSliders();
const restored = recall();
speak();
noted();
frame(0);
new ResizeObserver(() => soon("fit")).observe(sheet);
new ResizeObserver(() => soon("curve")).observe(plot);
play(!restored && !window.matchMedia("(prefers-reduced-motion: reduce)").matches);

/* For tests and for pages around this one: read and set what is shown. */
window.hydrolinkage = {
  engine, data, timing,
  state: () => ({ design: Object.fromEntries(dims.map((each, i) => [each.name, present[i]])), at: Object.fromEntries(followed(stands).map((value, k) => [strokes[k].name, value])), playing, language, column, second, forces: showsForces }),
  set: ({ design = {}, at = {} }) => {
    const ok = moved(dims.map((each, i) => design[each.name] ?? present[i]), strokes.map((each, k) => at[each.name] ?? stands[k]), "set");
    render(new Set(["design"]));
    return ok;
  },
  points: () => Object.fromEntries(scene.names.map((each, p) => [each, spot(pose, p, 0)])),
  sweep: () => ({ along: [...now.along], values: now.values.map((each) => [...each]), reason: [...now.reason] }),
  play, verdicts, here: atPose,
};
