"""A Monte Carlo of a million designs of the mower's lift over 21 strokes: the drive's force alone, and reserve, pressure, a pin and a path.

`python -m tests.benchmarks.bench_tolerances [--designs N] [--threads N] [--backend numpy|numba]`. By the clock, and of the processors.
"""

from __future__ import annotations

import argparse
import time
from typing import Any

from hydraulics import pressure, reserve
from linkage import deg, drive_force, kgf, kgf_cm2, least, mm, most, pin_force, x, y
from linkage.study import MonteCarlo, monte_carlo
from mechanisms.mower_lift import MowerLift

TOLERANCES = {"OB": 0.1 * mm, "OG": 1.0 * mm, "BOG": 0.1 * deg, "A": 0.1 * mm, "O": 0.1 * mm, "weight": 20.0 * kgf}
TASKS: dict[str, tuple[list[Any], list[Any]]] = {
    "drive's force": ([drive_force()], []),
    "reserve, pressure, pin and path": (
        [reserve("lift"), pressure("lift"), pin_force("O"), x("G"), y("G")],
        [least(reserve("lift")) >= 0.95, most(pressure("lift")) <= 170 * kgf_cm2],
    ),
}


def timed(task: str, designs: int, threads: int, backend: str) -> tuple[MonteCarlo, float, float]:
    """Return a study, and what it took by the clock and of the processors [s]; kernels are made before."""
    of, conditions = TASKS[task]
    options: dict[str, Any] = {"subject_to": conditions, "backend": backend}
    monte_carlo(MowerLift(), of, TOLERANCES, count=64, **options)
    clock, processor = time.perf_counter(), time.process_time()
    found = monte_carlo(MowerLift(), of, TOLERANCES, count=designs, threads=threads, **options)
    return found, time.perf_counter() - clock, time.process_time() - processor


def main() -> None:
    """Print what each task takes."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--designs", type=int, default=1_000_000)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--backend", default="numpy")
    given = parser.parse_args()
    for task in TASKS:
        found, clock, processor = timed(task, given.designs, given.threads, given.backend)
        good = f", {found.yield_rate:.1%} good" if found.conditions else ""
        print(f"{task:<34} {clock:6.2f} s by the clock, {processor:6.2f} s of {given.threads} processors{good}")


if __name__ == "__main__":
    main()
