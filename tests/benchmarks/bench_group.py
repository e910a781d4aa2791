"""The speed of a class III group: a Stephenson III linkage driven at its far link, against `scipy.optimize.fsolve` in a loop.

`python -m tests.benchmarks.bench_group [ROUNDS]`. All find the pins A, B and D at every pose; fsolve starts each pose
at the last one's solution, and is written in two ways: as one writes it, with the links as NumPy vectors, and as fast as
it goes, on plain floats with the exact Jacobian. fsolve is timed on 2000 poses and scaled to 100000. All run in turn, round
after round, on processor time; the medians are printed.
"""

from __future__ import annotations

import statistics
import sys
import time
from collections.abc import Callable
from typing import Any

import numpy as np
from scipy.optimize import fsolve

from linkage.program import FloatArray
from mechanisms.classics.stephenson_three import StephensonThreeFar

POSES, TIMED, ROUNDS = 100_000, 2_000, 5
FAR = StephensonThreeFar()
ROD, CRANK, ROCKER, AB, AD = (FAR[name] for name in ("DF", "OA", "CB", "AB", "AD"))
C, E, EF = FAR["C"], FAR["E"], FAR["EF"]
COS, SIN = np.cos(FAR["BAD"]) * AD / AB, np.sin(FAR["BAD"]) * AD / AB
SHAPE = np.array([[COS, -SIN], [SIN, COS]])


def strokes(count: int) -> FloatArray:
    return np.linspace(*(float(np.radians(end)) for end in (66.0, 84.0)), count)


def residuals(u: Any, fx: float, fy: float) -> list[float]:
    """Return the group's six equations: three lengths, one of the coupler, and its point D."""
    ax, ay, bx, by, dx, dy = u
    ux, uy = bx - ax, by - ay
    return [
        ax * ax + ay * ay - CRANK**2,
        (bx - C[0]) ** 2 + (by - C[1]) ** 2 - ROCKER**2,
        ux * ux + uy * uy - AB**2,
        (dx - fx) ** 2 + (dy - fy) ** 2 - ROD**2,
        dx - ax - COS * ux + SIN * uy,
        dy - ay - SIN * ux - COS * uy,
    ]


def jacobian(u: Any, fx: float, fy: float) -> list[list[float]]:
    ax, ay, bx, by, dx, dy = u
    ux, uy = bx - ax, by - ay
    return [
        [2 * ax, 2 * ay, 0.0, 0.0, 0.0, 0.0],
        [0.0, 0.0, 2 * (bx - C[0]), 2 * (by - C[1]), 0.0, 0.0],
        [-2 * ux, -2 * uy, 2 * ux, 2 * uy, 0.0, 0.0],
        [0.0, 0.0, 0.0, 0.0, 2 * (dx - fx), 2 * (dy - fy)],
        [COS - 1.0, -SIN, -COS, SIN, 1.0, 0.0],
        [SIN, COS - 1.0, -SIN, -COS, 0.0, 1.0],
    ]


def as_written(u: FloatArray, F: FloatArray) -> FloatArray:
    """Return the same six equations on vectors."""
    A, B, D = u.reshape(3, 2)
    lengths = [np.linalg.norm(A) - CRANK, np.linalg.norm(B - C) - ROCKER, np.linalg.norm(B - A) - AB, np.linalg.norm(D - F) - ROD]
    return np.concatenate([lengths, D - A - SHAPE @ (B - A)])


def by_vectors(psi: FloatArray, start: Any) -> FloatArray:
    """Return the pins, shape (6, poses), one pose after the other, as one writes it."""
    found, u = np.empty((6, len(psi))), np.array(start, float)
    for pose, angle in enumerate(psi):
        u = fsolve(as_written, u, args=(E + EF * np.array([np.cos(angle), np.sin(angle)]),))
        found[:, pose] = u
    return found


def by_floats(psi: FloatArray, start: Any) -> FloatArray:
    """Return the pins, shape (6, poses), one pose after the other, on floats with the exact Jacobian."""
    found, u = np.empty((6, len(psi))), np.array(start, float)
    for pose, (fx, fy) in enumerate(zip(E[0] + EF * np.cos(psi), E[1] + EF * np.sin(psi), strict=True)):
        u = fsolve(residuals, u, args=(fx, fy), fprime=jacobian)
        found[:, pose] = u
    return found


def by_framework(psi: FloatArray) -> FloatArray:
    motion = FAR.at(psi=psi)
    return np.concatenate([motion["A"], motion["B"], motion["D"]])


def timed(run: Callable[[], Any]) -> float:
    """Return the processor time of a call [s]."""
    start = time.process_time()
    run()
    return time.process_time() - start


def measured(rounds: int = ROUNDS, poses: int = POSES, sample: int = TIMED) -> tuple[list[float], float]:
    """Return the times of a pose [s], by the framework, by fsolve as written and by fsolve on floats, and how far apart they are [m]."""
    psi, few = strokes(poses), strokes(sample)
    ours = by_framework(few)
    start = ours[:, 0]
    apart = max(float(np.abs(ours - other(few, start)).max()) for other in (by_vectors, by_floats))
    runs: list[tuple[Callable[[], Any], int]] = [
        (lambda: by_framework(psi), poses),
        (lambda: by_vectors(few, start), sample),
        (lambda: by_floats(few, start), sample),
    ]
    table = [[timed(run) / count for run, count in runs] for _ in range(rounds)]
    return [statistics.median(column) for column in zip(*table, strict=True)], apart


def main(arguments: list[str]) -> None:
    """Print the times, their ratios and the agreement."""
    (ours, written, floats), apart = measured(int(arguments[0]) if arguments else ROUNDS)
    print(f"Stephenson III driven at its far link, {POSES} poses in one call: {ours * 1e6:8.3g} us a pose")
    print(f"fsolve in a loop on vectors ({TIMED} poses, scaled):              {written * 1e6:8.3g} us a pose, {written / ours:.0f} times")
    print(f"fsolve on floats with the Jacobian ({TIMED} poses, scaled):       {floats * 1e6:8.3g} us a pose, {floats / ours:.0f} times")
    print(f"the pins differ by at most {apart:.1e} m")


if __name__ == "__main__":
    main(sys.argv[1:])
