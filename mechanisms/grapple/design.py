"""The design problem (2.95): bore, stroke and the place of E from their lists, and OC, which is all that is left free.

Every combination is looked at over its range of OC, all designs at once; from the best of each of the most promising ones `optimise`
goes on to the optimum with its conditions.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product
from typing import Any, final

import numpy as np

from hydraulics import reserve
from linkage import StudyError, at, least, most, optimise, ratio, ref, x, y
from linkage.checks import require_type
from linkage.errors import one_word
from linkage.frozen import refuses_changes
from linkage.motion import Request
from linkage.program import FloatArray
from linkage.study import Optimum
from linkage.units import mm

from .duty import Duty, grapple_for
from .machine import Grapple

OBJECTIVES = ("even", "arm")
"""The least greatest M_g / M_1 of (2.95); the greatest arm at the largest stem, for the least cylinder (step 6)."""
LONGEST = 120 * mm
"""How far OC is looked at beyond the shortest at which E has a place."""
PLACES = np.concatenate([np.linspace(1e-6, 2e-3, 21), np.linspace(3e-3, LONGEST, 118)])
PROMISING = 3
ROOM = 2.0 * mm
"""How far beyond the OC that the grid shows the optimum is sought."""


@final
@refuses_changes
@dataclass(frozen=True)
class Combination:
    """A cylinder, a stroke and a place of E with which OC from `low` to `high` [m] keeps all conditions; `rho` is the best OC looked at.

    `value` is the objective there: M_g / M_1 or the arm [m].
    """

    bore: float
    rod: float
    S: float
    side_E: float
    rho: float
    value: float
    low: float
    high: float

    def __str__(self) -> str:
        side = "left" if self.side_E > 0.0 else "right"
        size = f"{self.bore / mm:.4g}/{self.rod / mm:.4g} mm, stroke {self.S / mm:.4g} mm, E on the {side}"
        return f"{size}: OC {self.low / mm:.1f} to {self.high / mm:.1f} mm, {self.value:.4g} at {self.rho / mm:.1f} mm"


def share_of() -> Request:
    """Return the request for M_g / M_1: the cylinder's reserve, which is what its pump gives over what the stem needs."""
    share: Request = reserve("lift")
    return share


def arm_to_spare() -> Request:
    """Return the request for what the cylinder's line keeps off the hinge beyond bush and rod [m]. (2.93)"""
    spare: Request = abs(ratio("EC")) - (ref("bush") + ref("rod") / 2)
    return spare


def feasible(duty: Duty, objective: str = "even", machine: Grapple | None = None) -> list[Combination]:
    """Return the combinations that keep every condition of (2.95) somewhere, the best first, as a grid of OC of 1 mm shows them.

    `machine` is one of the duty, where there is one already.
    """
    one_word("objective", objective, OBJECTIVES)
    made, found = machine or grapple_for(duty), []
    for (bore, rod), S, side in product(duty.cylinders, duty.strokes, (-1.0, 1.0)):
        rho = shortest(made, S) + PLACES
        spare, value = looked_at(duty, made.replaced(bore=bore, rod=rod, S=S, side_E=side, rho=rho), objective)
        good = np.flatnonzero(spare >= 0.0)
        if good.size:
            best = good[np.argmin(value[good] if objective == "even" else -value[good])]
            place, worth, low, high = (float(each) for each in (rho[best], value[best], rho[good[0]], rho[good[-1]]))
            found.append(Combination(bore, rod, S, side, place, worth, low, high))
    return sorted(found, key=lambda each: (each.value,) if objective == "even" else (each.bore, -each.value))


def shortest(machine: Grapple, S: float) -> float:
    """Return the OC with which the ends of the way of C are as far apart as a stroke [m]: E has a place from there on."""
    stroke = machine.strokes["theta"]
    return float(S / (2.0 * np.sin(0.5 * abs(stroke.end - stroke.start))))


def looked_at(duty: Duty, designs: Grapple, objective: str) -> tuple[FloatArray, FloatArray]:
    """Return what is to spare of the scarcest condition and the objective of designs, shape (designs,), at some poses."""
    stroke = designs.strokes["theta"]
    stems, way = np.linspace(0.0, stroke.end, 21), np.linspace(stroke.start, stroke.end, 13)
    share, arm = designs.evaluate([share_of(), abs(ratio("EC"))], theta=stems, unreachable="nan")
    room, E = designs.evaluate([arm_to_spare(), "E"], theta=way, unreachable="nan")
    left, right, low, high = duty.box
    (x_E, y_E) = E[..., 0]
    sides = [share.min(axis=-1) - 1.0, room.min(axis=-1), x_E - left, right - x_E, y_E - low, high - y_E]
    return np.min(sides, axis=0), share.max(axis=-1) if objective == "even" else arm[..., 0]


def conditions(duty: Duty, machine: Grapple) -> list[Any]:
    """Return the conditions of (2.95) for `optimise` over the stems; the arm has one peak, so that the open end stands for the rest."""
    left, right, low, high = duty.box
    spare, share = arm_to_spare(), share_of()
    place = {name: at(coordinate("E"), theta=0.0) for name, coordinate in (("x", x), ("y", y))}
    return [
        least(share) >= 1.0, least(spare) >= 0.0, at(spare, theta=machine.strokes["theta"].start) >= 0.0,
        place["x"] >= left, place["x"] <= right, place["y"] >= low, place["y"] <= high,
    ]  # fmt: skip


def design(duty: Duty, objective: str = "even", combinations: Sequence[Combination] | None = None) -> Optimum:
    """Return the best design of a duty: the least greatest M_g / M_1, or ("arm") of the least bore the greatest arm at D_0.

    `combinations` are those searched on, by default the three most promising ones of `feasible`. StudyError where none is good.
    """
    one_word("objective", objective, OBJECTIVES)
    machine = grapple_for(duty)
    chosen = feasible(duty, objective, machine)[:PROMISING] if combinations is None else list(combinations)
    if not chosen:
        sizes = f"{len(duty.cylinders)} cylinders and {len(duty.strokes)} strokes"
        raise StudyError(f"No combination of {sizes} keeps every condition; give greater bores, other strokes, more room for E.")
    if objective == "arm":
        chosen = [each for each in chosen if each.bore == min(one.bore for one in chosen)]
    found = [searched(duty, machine, objective, each) for each in chosen]
    return min(found, key=lambda each: each.value) if objective == "even" else max(found, key=lambda each: each.value)


def searched(duty: Duty, machine: Grapple, objective: str, start: Combination) -> Optimum:
    """Return the optimum of one combination, from its best design on the grid."""
    require_type("", start, Combination, "is no combination; give some of feasible(duty)")
    begun = machine.replaced(bore=start.bore, rod=start.rod, S=start.S, side_E=start.side_E, rho=start.rho)
    greatest, arm = most(share_of()), at(abs(ratio("EC")), theta=0.0)
    least_rho = max(start.low - ROOM, shortest(machine, start.S) + PLACES[0])
    found = optimise(
        begun, minimise=greatest if objective == "even" else None, maximise=arm if objective == "arm" else None,
        vary={"rho": (float(least_rho), start.high + ROOM)}, subject_to=conditions(duty, machine),
        over={"theta": (0.0, machine.strokes["theta"].end)}, case="plain", method="local",
    )  # fmt: skip
    assert isinstance(found, Optimum)
    return found
