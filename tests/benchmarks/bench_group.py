"""The speed of a class III group: a Stephenson III linkage driven at its far link, against `scipy.optimize.fsolve` in a loop.

`python -m tests.benchmarks.bench_group [ROUNDS]`. Both find the pins A, B and D at every pose; fsolve starts each pose
at the last one's solution, with the exact Jacobian. It is timed on 2000 poses and scaled to 100000. Both run in turn, round
after round, on processor time; the median ratio is printed.
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


def by_fsolve(psi: FloatArray, start: Any) -> FloatArray:
    """Return the pins, shape (6, poses), one pose after the other."""
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


def measured(rounds: int = ROUNDS, poses: int = POSES, sample: int = TIMED) -> tuple[float, float, float]:
    """Return the time of a pose by the framework and by fsolve [s], and the largest difference of the two [m]."""
    psi, few = strokes(poses), strokes(sample)
    start = by_framework(few[:1])[:, 0]
    apart = float(np.abs(by_framework(few) - by_fsolve(few, start)).max())
    pairs = [(timed(lambda: by_framework(psi)) / poses, timed(lambda: by_fsolve(few, start)) / sample) for _ in range(rounds)]
    ours, theirs = (statistics.median(column) for column in zip(*pairs, strict=True))
    return ours, theirs, apart


def main(arguments: list[str]) -> None:
    """Print the times, their ratio and the agreement."""
    ours, theirs, apart = measured(int(arguments[0]) if arguments else ROUNDS)
    print(f"Stephenson III driven at its far link, {POSES} poses in one call: {ours * 1e6:.3g} us a pose")
    print(f"scipy.optimize.fsolve in a loop, timed on {TIMED} poses:        {theirs * 1e6:.3g} us a pose")
    print(f"ratio {theirs / ours:.0f}; the pins differ by at most {apart:.1e} m")


if __name__ == "__main__":
    main(sys.argv[1:])
