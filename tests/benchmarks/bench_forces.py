"""The speed of forces and of their gradients: the three-point hitch with an implement, in nanoseconds of processor time per pose.

`python -m tests.benchmarks.bench_forces [ROUNDS]`. A thrust and a pin force as requests, against driving_force and
pin_forces; their gradients by ten lengths, exact and by central differences of designs. All cases run in turn, round after
round; the median of the rounds is printed, and what it is of the first case of its kind.
"""

from __future__ import annotations

import statistics
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from linkage import Weight, drive_force, driving_force, pin_force, pin_forces
from linkage.program import FloatArray, pinned
from linkage.program.fused import is_there
from mechanisms.three_point_hitch import ThreePointHitch
from tests.benchmarks.bench_kernel import machine

POSES, ROUNDS = 10**6, 5
LENGTHS = ["OB", "OC", "BC", "ED", "CD", "EF", "MK", "FK", "FG", "L0"]
STEP = 1e-6  # of a length, m


class Hitch(ThreePointHitch):
    """The hitch with an implement."""

    load = Weight("G", mass=1200.0)


@dataclass(frozen=True)
class Case:
    """What is timed: of which kind, its name, how many poses it takes, and the call."""

    kind: str
    name: str
    poses: int
    run: Callable[[], Any]


def by_differences(request: Callable[[Hitch], FloatArray]) -> FloatArray:
    """Return the derivatives of a force by the lengths: two more designs a length."""
    found = [[request(Hitch(**{name: Hitch()[name] + sign * STEP})) for sign in (1.0, -1.0)] for name in LENGTHS]
    return np.array([(up - down) / (2.0 * STEP) for up, down in found])


ASKED = {"thrust": drive_force(), "pin force": pin_force("C", "CD", "x")}
BY_HAND: dict[str, tuple[str, Callable[[Hitch, FloatArray], FloatArray]]] = {
    "thrust": ("at() and driving_force", lambda hitch, stroke: driving_force(hitch.at(S=stroke))),
    "pin force": ("at() and pin_forces, all joints", lambda hitch, stroke: pin_forces(hitch.at(S=stroke)).force("C", on="CD")[0]),
}


FEWER = {"thrust": 5, "pin force": 50}
"""How many times fewer poses the forces as arrays are worked out over."""


def requested(kind: str, backend: str, stroke: FloatArray) -> list[Case]:
    """Return the cases of a request on one back end."""
    hitch, asked = Hitch(), ASKED[kind]
    motion = hitch.at(S=stroke)

    def values() -> Any:
        return hitch.evaluate([asked], S=stroke, backend=backend)[0]

    def slopes() -> Any:
        with pinned(backend):
            return motion.gradient(asked, LENGTHS)

    return [
        Case(kind, f"evaluate, {backend}", stroke.size, values),
        Case(f"{kind} by ten lengths", f"gradient, {backend}", stroke.size, slopes),
    ]


def worked_out(kind: str, stroke: FloatArray) -> list[Case]:
    """Return the cases of a force as arrays."""
    name, force = BY_HAND[kind]
    return [
        Case(kind, name, stroke.size, lambda: force(Hitch(), stroke)),
        Case(f"{kind} by ten lengths", f"{name}, 20 designs", stroke.size, lambda: by_differences(lambda hitch: force(hitch, stroke))),
    ]


def cases(poses: int) -> list[Case]:
    """Return all cases: requests over so many poses, with Numba where it is installed, and forces as arrays over fewer."""
    long = np.linspace(0.0, 0.25, poses)
    backends = ("numpy", "numba") if is_there() else ("numpy",)
    fast = [case for kind in ASKED for backend in backends for case in requested(kind, backend, long)]
    slow = [case for kind, share in FEWER.items() for case in worked_out(kind, np.linspace(0.0, 0.25, max(poses // share, 2)))]
    return sorted([*fast, *slow], key=lambda case: case.kind)


def measured(rounds: int, poses: int) -> tuple[list[tuple[Case, float]], dict[str, float]]:
    """Return the cases with their median time [ns per pose], and how far the results of a kind are apart, of the largest."""
    all_cases, times = cases(poses), dict[int, list[float]]()
    results = [np.asarray(case.run()) for case in all_cases]
    for _ in range(rounds):
        for place, case in enumerate(all_cases):
            start = time.process_time_ns()
            case.run()
            times.setdefault(place, []).append((time.process_time_ns() - start) / case.poses)
    apart: dict[str, float] = {}
    for case, values in zip(all_cases, results, strict=True):
        first = next(other for each, other in zip(all_cases, results, strict=True) if each.kind == case.kind)
        ends = (..., [0, -1])  # the strokes that all cases have
        apart[case.kind] = max(apart.get(case.kind, 0.0), float(np.abs(values[ends] - first[ends]).max() / np.abs(first).max()))
    return [(case, statistics.median(times[place])) for place, case in enumerate(all_cases)], apart


def table(found: list[tuple[Case, float]]) -> str:
    """Return the times as text, each with how many times the first of its kind it takes."""
    lines = []
    for case, each in found:
        first = next(time for other, time in found if other.kind == case.kind)
        lines.append(f"  {case.kind:26s} {case.name:58s} {each:10.1f} ns  {each / first:8.1f} x")
    return "\n".join(lines)


def main(rounds: int = ROUNDS) -> None:
    print(machine())
    found, apart = measured(rounds, POSES)
    print(table(found))
    print("apart, of the largest: " + ", ".join(f"{kind} {each:.0e}" for kind, each in apart.items()))


if __name__ == "__main__":
    main(*map(int, sys.argv[1:2]))
