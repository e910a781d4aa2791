/* Of an `Over` in time the value, the rate and the acceleration of each stroke at an instant: at a break those of the phase that begins there. */
const atInstant = ({ time: [, stop], courses }, t) => courses.map(([breaks, phases, last]) => {
  const n = phases.length, end = breaks[n], stands = t < breaks[0] || t > end || (t === end && end < stop);
  let i = 0, v = 0, r = 0, a = 0;
  while (i < n - 1 && t >= breaks[i + 1]) i++;
  const x = Math.min(Math.max(t, breaks[0]), end) - breaks[i];
  for (let k = phases[i].length; k--;) { a = a * x + r; r = r * x + v; v = v * x + phases[i][k]; }
  return [t >= end ? last : v, stands ? 0 : r, stands ? 0 : 2 * a];
});
/* The rates and behind them the accelerations of all strokes at some instants, as the engine takes them. */
const ratesAt = (over, times) => {
  const states = times.map((t) => atInstant(over, t));
  return [1, 2].flatMap((order) => over.courses.map((_, k) => states.map((each) => each[k][order])));
};
/* A path in time is looked at in so many spans: the instant of a place on it, and the strokes at its places. */
const SPANS = 64;
const timeAt = ({ time: [begin, end] }, u = 0) => (u === SPANS ? end : begin + ((end - begin) * u) / SPANS);
const inPlaces = (over) => ({ ...over, places: over.courses.map((_, k) => Array.from({ length: SPANS + 1 }, (_, u) => atInstant(over, timeAt(over, u))[k][0])) });
/* Places, and those on both sides of the breaks, in their order. */
const withBreaks = ({ courses, time: [begin, end] }, evenly) => {
  const breaks = [...new Set(courses.flatMap(([own]) => own))].flatMap((t) => [-1e-9, 0, 1e-9].map((off) => [SPANS * ((t - begin) / (end - begin) + off)]));
  return [...evenly, ...breaks.filter(([u]) => u > 0 && u < SPANS)].sort(([a], [b]) => a - b);
};
