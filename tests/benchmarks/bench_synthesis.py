"""Published tasks of path synthesis with a four-bar: the least error found, its rivals, and the processor time of the whole call.

Run by `python -m tests.benchmarks.bench_synthesis`, with the names of tasks for some. Errors are sums of squared distances [mm^2] at full
turns, judged by `places`, written apart from the package; the designs beside them are the best that could be read. Both branches are
searched, as one call each.
"""

import sys
from time import process_time

import numpy as np

from linkage import PathTask, distance, mm, synthesise
from linkage import least as lowest
from linkage import most as highest
from linkage.motion.measures import Given
from linkage.study.problem import Problem
from linkage.study.space import Space
from linkage.synthesis.fit import Fit, Timing
from mechanisms.classics.jansen import Jansen
from tests.linkage.synthesis import synthesis_tasks as papers
from tests.linkage.synthesis.synthesis_tasks import Bar, OtherBar, box, places

BEST = 1e-5
"""Of the least error: answers that differ by less reach it."""


def own_box(most, least=0.01 * mm):
    """Return the papers' box, the coupler's point within its coordinates' ranges too, and how far apart the fixed points are to stand."""
    vary = box(most, least) | {"AP": (1e-3 * mm, most)} | {f"C.{axis}": (-2.0 * most, 2.0 * most) for axis in "xy"}
    apart = distance("O", "C")
    return vary, [lowest(apart) >= least, highest(apart) <= most]


TASKS = {
    "P1": (papers.LINE, None, False, *own_box(60 * mm, 5 * mm), 1.31e-11),
    "P2": (papers.FIVE, papers.FIVE_AT, True, box(50 * mm, held=True) | {"AP": (1e-3 * mm, 50 * mm)}, (), 1.284e-6),
    "P3": (papers.EIGHTEEN, None, "steps", box(50 * mm) | {"AP": (1e-3 * mm, 50 * mm)}, (), 0.00915266),
    "P4": (papers.ARC, papers.ARC_AT, True, *own_box(50 * mm, 5 * mm), 2.58036),
    "P5": (papers.ELLIPSE, None, False, *own_box(80 * mm, 5 * mm), 4.01992e-4),
    "P6": (papers.TWELVE, None, False, box(60 * mm), (), 1.494e-4),
    "P7": (papers.TWENTY_FIVE, None, False, box(60 * mm), (), 0.03873),
}  # fmt: skip
"""Points [mm], strokes, timing, box, conditions, and the least error read."""


def solved(name, kind=Bar, **options):
    """Return what a synthesis finds for a task, and the processor time it takes [s]."""
    points, at, timed, vary, held, _ = TASKS[name]
    begun = process_time()
    task = PathTask(np.array(points) * mm, of="P", at=at)
    found = synthesise(kind(), path=task, vary=vary, timed=timed, subject_to=held, **options)
    return found, process_time() - begun


def judged(answer, points):
    """Return an answer's error [mm^2] by the formulas in complex numbers; infinite where it does not close all the way round."""
    if not np.isfinite(places(answer.machine, np.linspace(0.0, 2 * np.pi, 5001))).all():
        return np.inf
    return float(np.sum((places(answer.machine, answer.strokes) - np.transpose(points) * mm) ** 2)) / mm**2


def jansen(seed, limit=1000):
    """Return the RMSE of a leg found for Jansen's own foot path, in his units of 10 mm, and how many designs were looked at."""
    known, at = Jansen(), np.arange(180) * 2.0 * np.pi / 180
    vary = {name: (0.6 * known[name], 1.4 * known[name]) for name in known.dimensions if "." not in name}
    vary |= {"B.x": (-0.53, -0.23), "B.y": (-0.15, 0.0)}
    random = np.random.default_rng(seed)
    start = Jansen(**{name: random.uniform(*ends) for name, ends in vary.items()})
    task = PathTask(known.at(phi=at)["F"].T, of="F", at=at)
    found = synthesise(start, path=task, vary=vary, limit=limit, starts=2, seed=seed)
    return found.error**0.5 / len(at) ** 0.5 / (10 * mm), found.evaluations


def million():
    """Return the processor time of a million four-bars at 64 poses each [s], and how many of them turn fully."""
    bar, space = Bar(), Space.of(Bar(), box(50 * mm))
    problem = Problem(bar, [Given(0.0)], [], space)
    rows = PathTask([(0.0, 0.0), (0.01, 0.0)], of="P").rows(bar)
    fit = Fit(problem, rows, Timing.of(problem, "phi", False, 2))
    unit = np.random.default_rng(0).random((1_000_000, fit.n))
    fit.swept(unit[:1024], 64)
    begun = process_time()
    turning = sum(int(fit.swept(part, 64)[1].all(axis=1).sum()) for part in np.array_split(unit, 62))
    return process_time() - begun, turning


def main():
    if not sys.argv[1:]:
        print("a million four-bars: {:.2f} s of a processor, {} turn fully".format(*million()))
        legs = np.array([jansen(seed) for seed in range(9)])
        print(f"Jansen's leg: median RMSE {np.median(legs[:, 0]):.3g}, {legs[:, 1].max():.0f} designs at the most")
    for name in sys.argv[1:] or TASKS:
        for kind in (Bar, OtherBar):
            found, seconds = solved(name, kind)
            errors = [judged(each, TASKS[name][0]) for each in found.solutions]
            best = f"{min(errors):.6g}" if errors else "none"
            print(f"{name} {kind.__name__}: {best} of {len(errors)} answers, read {TASKS[name][-1]:.6g}; {seconds:.2f} s of a processor")


if __name__ == "__main__":
    main()
