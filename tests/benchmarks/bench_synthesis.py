"""Published tasks of path synthesis with a four-bar: the least error found, its rivals, and the processor time of the whole call.

Run by `python -m tests.benchmarks.bench_synthesis`, with the names of tasks for some. Errors are sums of squared distances [mm^2] at full
turns, judged by `places`, written apart from the package; the designs beside them are the best that could be read. Both branches are
searched, as one call each.
"""

import sys
from time import process_time

import numpy as np

from linkage import PathTask, distance, least, mm, most, synthesise
from tests.linkage.study import synthesis_tasks as papers
from tests.linkage.synthesis.synthesis_tasks import Bar, OtherBar, box, places

APART = [least(distance("O", "C")) >= 5 * mm, most(distance("O", "C")) <= 50 * mm]
FAR = {"C.x": (-100 * mm, 100 * mm), "C.y": (-100 * mm, 100 * mm)}
TASKS = {
    "P1": (papers.LINE, None, False, box(60 * mm, 5 * mm), (), 1.31e-11),
    "P2": (papers.FIVE, papers.FIVE_AT, True, box(50 * mm, held=True), (), 1.284e-6),
    "P3": (papers.EIGHTEEN, None, "steps", box(50 * mm), (), 0.00915266),
    "P4": (papers.ARC, papers.ARC_AT, True, box(50 * mm, 5 * mm) | FAR, APART, 2.58036),
    "P5": (papers.ELLIPSE, None, False, box(80 * mm, 5 * mm), (), 4.01992e-4),
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


def main():
    for name in sys.argv[1:] or TASKS:
        for kind in (Bar, OtherBar):
            found, seconds = solved(name, kind)
            errors = [judged(each, TASKS[name][0]) for each in found.solutions]
            best = f"{min(errors):.6g}" if errors else "none"
            print(f"{name} {kind.__name__}: {best} of {len(errors)} answers, read {TASKS[name][-1]:.6g}; {seconds:.2f} s of a processor")


if __name__ == "__main__":
    main()
