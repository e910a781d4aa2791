"""Published tasks of path synthesis with a four-bar: the least error found, its rivals, and the processor time of the whole call.

Run by `python -m tests.benchmarks.bench_synthesis [--seeds N] [--peers FOLDER] [P1 ...]`. Errors are sums of squared distances [mm^2] at
full turns, judged by `places`, written apart from the package; "read" is the best among the designs that could be read. Both branches are
searched, as one call each, from several seeds. With `--peers` pylinkage is installed into an environment of its own there, and its particle
swarm at its defaults is given the same 18 points.
"""

import argparse
import json
import subprocess
from pathlib import Path
from time import process_time

import numpy as np

from linkage import PathTask, distance, mm, synthesise
from linkage import least as lowest
from linkage import most as highest
from linkage.motion.measures import FixedNumber
from linkage.study.problem import Problem
from linkage.study.space import Space
from linkage.synthesis.fit import Fit, Timing
from mechanisms.classics.jansen import Jansen
from tests.benchmarks.peer import environment
from tests.linkage.synthesis import synthesis_tasks as papers
from tests.linkage.synthesis.synthesis_tasks import Bar, OtherBar, box, places

SWARM = Path(__file__).with_name("peer_swarm.py")
SWARM_BOX = 2.0
"""Of the swarm's lengths and pivots [mm]: where it does best. In the papers' box of 50 mm its errors are a hundred times as large."""


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


def jansen(seed, limit=900):
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
    problem = Problem(bar, [FixedNumber(0.0)], [], space)
    rows = PathTask([(0.0, 0.0), (0.01, 0.0)], of="P").rows(bar)
    fit = Fit(problem, rows, Timing.of(problem, "phi", False, 2))
    unit = np.random.default_rng(0).random((1_000_000, fit.n))
    fit.swept(unit[:1024], 64)
    begun = process_time()
    turning = sum(int(fit.swept(part, 64)[1].all(axis=1).sum()) for part in np.array_split(unit, 62))
    return process_time() - begun, turning


def swarm(folder, runs=3):
    """Print what pylinkage's swarm and a synthesis from four starts come to on the 18 points: medians of errors [mm^2] and of times [s]."""
    most, turn = SWARM_BOX, 2.0 * np.pi
    low, high = [-most] * 4 + [0.01] * 3 + [1e-3, -np.pi, 0.0], [most] * 8 + [np.pi, turn]
    asked = json.dumps({"compiled": False, "points": papers.EIGHTEEN, "low": low, "high": high}) + "\n"
    theirs, ours = [], []
    with subprocess.Popen([environment(folder), SWARM], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as peer:
        solved("P3", starts=4)  # what only a first call takes
        for seed in range(runs):
            peer.stdin.write(asked)
            peer.stdin.flush()
            answer = json.loads(peer.stdout.readline())
            theirs.append((bar_error(answer["numbers"], papers.EIGHTEEN), answer["seconds"]))
            found, seconds = solved("P3", starts=4, seed=seed)
            ours.append((judged(found.solutions[0], papers.EIGHTEEN), seconds))
    (error, seconds), (least, short) = np.median(theirs, axis=0), np.median(ours, axis=0)
    print(f"P3 by pylinkage's swarm: {error:.3g} in {seconds:.2f} s; by 4 starts {least:.6g} in {short:.3f} s: ", end="")
    print(f"{seconds / short:.0f} times less time, {error / least:.1f} times less error")


def bar_error(numbers, points):
    """Return the error [mm^2] of a swarm's numbers by the formulas in complex numbers."""
    names = [*(f"{point}.{axis}" for point in "OC" for axis in "xy"), "OA", "AB", "CB", "AP"]
    bar = Bar(**{name: value * mm for name, value in zip(names, numbers[:8], strict=True)}, BAP=numbers[8])
    phi = numbers[9] + np.arange(len(points)) * 2.0 * np.pi / len(points)
    return float(np.sum((places(bar, phi) - np.transpose(points) * mm) ** 2)) / mm**2


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("tasks", nargs="*", help="P1 to P7, all by default")
    parser.add_argument("--seeds", type=int, default=3, help="how many seeds are searched from")
    parser.add_argument("--peers", type=Path, help="the folder of an environment with pylinkage")
    options = parser.parse_args()
    if options.peers:
        swarm(options.peers)
    if not options.tasks:
        print("a million four-bars: {:.2f} s of a processor, {} turn fully".format(*million()))
        legs = np.array([jansen(seed) for seed in range(9)])
        print(f"Jansen's leg: median RMSE {np.median(legs[:, 0]):.3g}, {legs[:, 1].max():.0f} designs at the most")
    for name in options.tasks or TASKS:
        for kind in (Bar, OtherBar):
            times, best = [], []
            for seed in range(options.seeds):
                found, seconds = solved(name, kind, seed=seed)
                times.append(seconds)
                best.append(min((judged(each, TASKS[name][0]) for each in found.solutions), default=np.inf))
            errors = f"{min(best):.6g}, median {np.median(best):.6g}, read {TASKS[name][-1]:.6g}"
            print(f"{name} {kind.__name__}: {errors}; median {np.median(times):.2f} s of a processor", flush=True)


if __name__ == "__main__":
    main()
