"""The speed of forces and of their gradients: the three-point hitch with an implement, in nanoseconds of processor time per pose.

`python -m tests.benchmarks.bench_forces [ROUNDS]`. A drive's force and a pin force as requests, against driving_force and
pin_forces; their gradients by ten lengths, exact and by central differences of designs. All cases run in turn, round after
round; the median of the rounds is printed, and what it is of the first case of its kind.

Then what a designer asks for, of the hitch and of an excavator with three cylinders along a path of its strokes: the forces of all
joints with their result objects, frictionless and with friction at every pin, a drive's force, a cylinder's thrust, and the
verdicts on a lift. Each is asked of a motion that has not been asked before; its positions are not counted.
"""

from __future__ import annotations

import statistics
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from hydraulics import Cylinder, LiftCircuit, lift_verdicts
from linkage import (
    LEFT,
    RIGHT,
    Dyad,
    Ground,
    Mechanism,
    Motion,
    OnLink,
    PinFriction,
    Stroke,
    Weight,
    deg,
    drive_force,
    driving_force,
    mm,
    pin_force,
    pin_forces,
)
from linkage.program import FloatArray, fixed_backend
from linkage.program.numba_backend import is_there
from linkage.units import MPa, litre, minute
from mechanisms.three_point_hitch import ThreePointHitch
from tests.benchmarks.bench_kernel import machine

POSES, ROUNDS = 10**6, 5
LENGTHS = ["OB", "OC", "BC", "ED", "CD", "EF", "MK", "FK", "FG", "L0"]
STEP = 1e-6  # of a length, m


class Hitch(ThreePointHitch):
    """The hitch with an implement."""

    load = Weight("G", mass=1200.0)


class Excavator(Mechanism):
    """Boom OBCD, arm CEFHJ and bucket FLG on three cylinders, the bucket through the links JK and KL."""

    S1, S2, S3 = Stroke(0.0, 0.9), Stroke(0.0, 1.0), Stroke(0.0, 0.7)
    O, A = Ground(0.0, 1.9), Ground(0.55, 1.45)
    B = Dyad(A, O, AB=1.7 + S1, OB=2.2, side=RIGHT)
    C = OnLink(O, B, OC=5.2, BOC=-8 * deg)
    D = OnLink(O, B, OD=2.7, BOD=14 * deg)
    E = Dyad(D, C, DE=2.2 + S2, CE=0.75, side=LEFT)
    F = OnLink(C, E, CF=2.6, ECF=150 * deg)
    H = OnLink(C, E, CH=0.55, ECH=-120 * deg)
    J = OnLink(C, E, CJ=2.2, ECJ=152 * deg)
    K = Dyad(H, J, HK=1.85 + S3, JK=0.55, side=LEFT)
    L = Dyad(K, F, KL=0.6, FL=0.45, side=LEFT)
    G = OnLink(F, L, FG=0.8, LFG=60 * deg)

    load = Weight(G, mass=900)
    lift = Cylinder(A, B, bore=120 * mm, rod=85 * mm, count=2)
    crowd = Cylinder(D, E, bore=130 * mm, rod=90 * mm, works="both")
    curl = Cylinder(H, K, bore=110 * mm, rod=75 * mm, works="both")
    circuit = LiftCircuit(lift, pressure=30 * MPa, flow=200 * litre / minute)


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


ASKED = {"drive force": drive_force(), "pin force": pin_force("C", "CD", "x")}
BY_HAND: dict[str, tuple[str, Callable[[Hitch, FloatArray], FloatArray]]] = {
    "drive force": ("at() and driving_force", lambda hitch, stroke: driving_force(hitch.at(S=stroke))),
    "pin force": ("at() and pin_forces, all joints", lambda hitch, stroke: pin_forces(hitch.at(S=stroke)).force("C", on="CD")[0]),
}


FEWER = {"drive force": 5, "pin force": 50}
"""How many times fewer poses the forces as arrays are worked out over."""


def requested(kind: str, backend: str, stroke: FloatArray) -> list[Case]:
    """Return the cases of a request on one back end."""
    hitch, asked = Hitch(), ASKED[kind]
    motion = hitch.at(S=stroke)

    def values() -> Any:
        return hitch.evaluate([asked], S=stroke, backend=backend)[0]

    def slopes() -> Any:
        with fixed_backend(backend):
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


# -- what a designer asks for --------------------------------------------------------------------------------


@dataclass(frozen=True)
class Question:
    """What is asked of a motion: of which machine, its name, over how many poses, and the call."""

    machine: Mechanism
    name: str
    poses: int
    ask: Callable[[Motion], Any]

    def motion(self) -> Motion:
        """Return a motion that has not been asked anything: along all strokes at once."""
        strokes = self.machine.strokes
        motion = self.machine.at(**{name: np.linspace(each.start, each.end, self.poses) for name, each in strokes.items()})
        assert motion.reached.all()
        return motion


def everything(motion: Motion, rubbing: bool = False) -> Any:
    """Return all that `pin_forces` gives, with every joint's force."""
    loads: list[Any] = list(motion.plan.of_kind(Weight).values())
    if rubbing:
        loads += [PinFriction(point, radius=25 * mm, coefficient=0.1) for point in pins(motion)]
    found = pin_forces(motion, loads, direction="extending" if rubbing else "frictionless")
    return [joint.force for joint in found.joints], found


def pins(motion: Motion) -> list[str]:
    """Return the points that are joints."""
    plan = motion.plan
    on = [set(body.points) for body in plan.links] + [{bar.P, bar.Q} for bar in plan.cylinders]
    return [name for name in plan.points if sum(name in each for each in on) > 1]


def questions(poses: int) -> list[Question]:
    """Return all questions; the verdicts over a few poses, between which they look themselves."""
    found = []
    for design in (Hitch(), Excavator()):
        lift, circuit = design.plan.members["lift"], design.plan.members["circuit"]
        drive = next(iter(design.strokes))
        found += [
            Question(design, "pin_forces, all joints", poses, everything),
            Question(design, "pin_forces, friction at every pin", poses, lambda motion: everything(motion, True)),
            Question(design, "driving_force", poses, lambda motion, drive=drive: driving_force(motion, drive=drive)),
            Question(design, "cylinder.thrust", poses, lambda motion, lift=lift: lift.thrust(motion)),
            Question(design, "lift_verdicts", 11, lambda motion, circuit=circuit: lift_verdicts(circuit, motion)),
        ]
    return found


def answered(rounds: int, poses: int) -> list[tuple[Question, float]]:
    """Return the questions with their median time [ns per pose], asked in turn round after round; the first round warms up."""
    asked, times = questions(poses), dict[int, list[float]]()
    for turn in range(rounds + 1):
        for place, question in enumerate(asked):
            motion = question.motion()
            start = time.process_time_ns()
            question.ask(motion)
            if turn:
                times.setdefault(place, []).append((time.process_time_ns() - start) / question.poses)
    return [(question, statistics.median(times[place])) for place, question in enumerate(asked)]


def answers(found: list[tuple[Question, float]]) -> str:
    """Return the times as text, in ns or us a pose."""
    lines = []
    for question, each in found:
        spent = f"{each:8.1f} ns" if each < 1e3 else f"{each / 1e3:8.2f} us"
        lines.append(f"  {type(question.machine).__name__:10s} {question.name:36s} {question.poses:8d} poses  {spent} a pose")
    return "\n".join(lines)


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
    print(answers(answered(rounds, POSES // 20)))
    print("apart, of the largest: " + ", ".join(f"{kind} {each:.0e}" for kind, each in apart.items()))


if __name__ == "__main__":
    main(*map(int, sys.argv[1:2]))
