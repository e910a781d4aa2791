"""The duty of a grapple and its materials, checked in words; and the design problem (2.95). Pressures are gauge [Pa].

Bore, stroke and the place of E come from their lists; OC is all that is left free. Every combination is looked at over its range of OC,
all designs at once; from the best of each of the most promising ones `optimise` goes on to the optimum with its conditions.

>>> from linkage.units import mm
>>> print(Duty.at_breast_height(440 * mm, 1.25))
stems of 100 to 550 mm, 4 bores from 50 mm, 10 strokes from 100 mm
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import product
from math import inf
from typing import Any, ClassVar, TypeAlias

import numpy as np

from hydraulics import CylinderSize, reserve
from hydraulics.inputs import efficient, in_pascals, one_number, positive
from linkage import DefinitionError, MPa, Stroke, StudyError, at, deg, least, mm, most, optimise, ratio, ref, x, y
from linkage.errors import ensure, is_listed, one_word, require, require_type
from linkage.frozen import record
from linkage.motion import Request
from linkage.program import FloatArray
from linkage.quantities import Quantity, quantity
from linkage.study import Optimum

from ..paper import hold_numbers
from .machine import Grapple, InnerGrapple

Moment: TypeAlias = "Callable[[Quantity, Quantity], Quantity | float]"
"""What a stem needs about the hinge [N m], of its diameter [m] and the arm of its push on the lever [m]: quantities."""

LENGTHS = ("D_0", "d_0", "hinge_gap", "bush", "dead")
RIGHT_ANGLE = 90 * deg
SHARE: Request = reserve("lift")
"""M_g / M_1: the cylinder's reserve, available over required."""
ARM_TO_SPARE: Request = abs(ratio("EC")) - (ref("bush") + ref("rod") / 2)
"""The distance of the cylinder's line from the hinge beyond bush and rod [m]. (2.93)"""


def assumed_moment(D: Quantity, arm: Quantity) -> Quantity:
    """Return the assumed law of M_1 [N m]: a push of 6 kN + 40 kN/m2 D**2 on the lever. The source's own (fig. 2.24) is not at hand.

    Parameters
    ----------
    D : Quantity
        The stem's diameter [m].
    arm : Quantity
        The lever [m].

    Returns
    -------
    Quantity
        The moment.
    """
    return (6000.0 + 40000.0 * D**2) * arm


@record
class Duty:
    """The stems, the wrap angles and the possible drives of the lever; every number as in `Grapple`.

    Parameters
    ----------
    D_0, d_0 : float, optional
        The largest and the smallest stem [m].
    alpha, beta : float, optional
        The wrap angles [rad].
    hinge_gap : float, optional
        The gap of the hinge off the largest stem [m].
    opening : float, optional
        The opening angle over the one that lets the stem go.
    bush : float, optional
        The radius of the hinge's bush [m].
    dead, dead_bores : float, optional
        The closed length of the cylinder beyond its stroke is dead + dead_bores bore [m].
    pressure : float, optional
        The pressure [Pa gauge].
    efficiency : float, optional
        The cylinder's efficiency.
    cylinders : sequence of tuple of float, optional
        Bores and rods [m].
    strokes : sequence of float, optional
        Standard strokes [m].
    box : tuple of float, optional
        The room for the pin E: left, right, low, high [m] (2.89).
    moment : callable, optional
        `moment(D, arm)` gives M_1 [N m].
    inner : bool, optional
        Whether the cylinder is at the inner hinge, where its rod side works.

    Raises
    ------
    DefinitionError
        A number cannot be.
    """

    D_0: float = 550 * mm
    d_0: float = 100 * mm
    alpha: float = 55 * deg
    beta: float = 5 * deg
    hinge_gap: float = 85 * mm
    opening: float = 1.3
    bush: float = 25 * mm
    dead: float = 120 * mm
    dead_bores: float = 1.6
    pressure: float = 20 * MPa
    efficiency: float = 0.95
    cylinders: Sequence[tuple[float, float]] = ((0.050, 0.028), (0.063, 0.036), (0.070, 0.040), (0.080, 0.045))
    strokes: Sequence[float] = (0.10, 0.125, 0.14, 0.16, 0.18, 0.20, 0.22, 0.25, 0.28, 0.32)
    box: tuple[float, float, float, float] = (-0.15, 0.15, 0.30, 0.62)
    moment: Moment = assumed_moment
    inner: bool = False
    in_machine: ClassVar[tuple[str, ...]] = ("D_0", "d_0", "alpha", "beta", "hinge_gap", "opening", "bush", "dead", "dead_bores")

    def __post_init__(self) -> None:
        hold_numbers(self, LENGTHS)
        said = f"the smallest stem d_0 = {self.d_0 / mm:.4g} mm is not below the largest, D_0 = {self.D_0 / mm:.4g} mm"
        ensure(self.d_0 < self.D_0, f"Duty: {said}; exchange them.")
        said = f"alpha = {self.alpha / deg:.4g} deg: the lever wraps the largest stem by more than 0 and less than 90 deg"
        ensure(0.0 < self.alpha < RIGHT_ANGLE, f"Duty: {said}; 52 to 57 deg is the best (Shimkovich).")
        if not -RIGHT_ANGLE < self.beta < RIGHT_ANGLE:
            raise DefinitionError(f"Duty: beta = {self.beta / deg:.4g} deg lies between -90 and 90 deg; 0 is a lever end below the stem.")
        said = f"opening = {self.opening:.4g}: a lever that opens by less than the release angle keeps the stem"
        ensure(self.opening >= 1.0, f"Duty: {said}; 1.2 to 1.4 (2.81).")
        in_pascals(positive(self.pressure, "pressure"), "pressure")
        efficient(self.efficiency, "efficiency")
        rows = [*map(numbers_of, self.cylinders)] if is_listed(self.cylinders) else []
        expected = "rows of bore and rod [m] are expected, such as [(0.05, 0.028)]"
        require(rows and all(len(row) == 2 for row in rows), "Duty: cylinders", self.cylinders, expected)
        for bore, rod in rows:
            CylinderSize(bore, rod)
        strokes, box = sorted(numbers_of(self.strokes)), numbers_of(self.box)
        expected = "standard strokes [m] above zero are expected, such as [0.2, 0.25]"
        require(strokes and 0.0 < strokes[0] <= strokes[-1] < inf, "Duty: strokes", self.strokes, expected)
        expected = "left, right, low and high [m] are expected, such as (-0.15, 0.15, 0.3, 0.62)"
        require(len(box) == 4 and box[0] < box[1] and box[2] < box[3], "Duty: box", self.box, expected)
        for name, found in (("cylinders", map(tuple, rows)), ("strokes", strokes), ("box", box)):
            object.__setattr__(self, name, tuple(found))
        require(callable(self.moment), "moment", self.moment, "a function of the diameter and the arm is expected, as assumed_moment")

    @classmethod
    def at_breast_height(cls, diameter: float, q_0: float, **others: Any) -> Duty:
        """Return the duty for trees of a diameter at breast height (2.67).

        Parameters
        ----------
        diameter : float
            The diameter [m].
        q_0 : float
            How many times as thick the stem is where it is gripped.
        **others : object
            The other numbers of a duty.

        Returns
        -------
        Duty
            The duty.
        """
        positive(one_number(q_0, "q_0"), "q_0")
        return cls(D_0=q_0 * one_number(diameter, "diameter"), **others)

    def __str__(self) -> str:
        bore, stroke = self.cylinders[0][0], self.strokes[0]
        stems = f"stems of {self.d_0 / mm:.4g} to {self.D_0 / mm:.4g} mm"
        return f"{stems}, {len(self.cylinders)} bores from {bore / mm:.4g} mm, {len(self.strokes)} strokes from {stroke / mm:.4g} mm"


def numbers_of(given: Any) -> list[float]:
    """Return numbers [SI]; none for anything else."""
    try:
        return [float(each) for each in given]
    except (TypeError, ValueError):
        return []


def grapple_for(duty: Duty, **design: float) -> Grapple:
    """Return the machine of a duty: a class with the range of theta and the M_1 that it needs.

    Parameters
    ----------
    duty : Duty
        The duty.
    **design : float
        A design of it, dimensions by name [SI].

    Returns
    -------
    Grapple
        The machine.
    """
    base: type[Grapple] = InnerGrapple if duty.inner else Grapple
    layout = {name: getattr(duty, name) for name in duty.in_machine}
    given = {**layout, "circuit.pressure": duty.pressure, "circuit.mechanical_efficiency": duty.efficiency}
    start, end = lever_range(base, layout)
    title = base.__name__ if (start, end) == lever_range(base, {}) and duty.moment is assumed_moment else f"{base.__name__}ForDuty"
    moment = quantity(duty.moment(ref("D"), ref("arm")))
    made: type[Grapple] = type(title, (base,), {"__doc__": base.__doc__, "theta": Stroke(start, end), "M_1": moment})
    return made(**{**given, **design})


def lever_range(base: type[Grapple], layout: dict[str, float]) -> tuple[float, float]:
    """Return the lever's angle when open and at the smallest stem [rad]. There is always a hinge: the chord lies in the largest stem."""
    opened, closing = base(**layout).evaluate(["opening_angle", "closing_angle"], theta=0.0)
    return float(opened), -float(closing)


# -- the design ------------------------------------------------------------------------------------------------

OBJECTIVES = ("even", "arm")
"""The least greatest M_g / M_1 of (2.95); the greatest arm at the largest stem, for the least cylinder (step 6)."""
LONGEST = 120 * mm
"""How far OC is looked at beyond the shortest at which E has a place."""
PLACES = np.concatenate([np.linspace(1e-6, 2e-3, 21), np.linspace(3e-3, LONGEST, 118)])
PROMISING = 3
ROOM = 2.0 * mm
"""How far beyond the OC that the grid shows the optimum is sought."""


@record
class Combination:
    """A cylinder, a stroke and a place of E, and for which OC all conditions are kept.

    Attributes
    ----------
    bore, rod, S : float
        The cylinder's diameters and its stroke [m].
    side_E, rho : float
        The place of E, and the best OC looked at [m].
    value : float
        The objective there: M_g / M_1 or the arm [m].
    low, high : float
        The range of OC that keeps all conditions [m].
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


def feasible(duty: Duty, objective: str = "even", machine: Grapple | None = None) -> list[Combination]:
    """Return the combinations that keep every condition of (2.95) somewhere, the best first, as a grid of OC of 1 mm shows them.

    Parameters
    ----------
    duty : Duty
        The duty.
    objective : {"even", "arm"}, optional
        As of `design`.
    machine : Grapple, optional
        One of the duty, where there is one already.

    Returns
    -------
    list of Combination
        The combinations.
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
    """Return the spare of the scarcest condition and the objective of designs, shape (designs,), at some poses."""
    stroke = designs.strokes["theta"]
    stems, way = np.linspace(0.0, stroke.end, 21), np.linspace(stroke.start, stroke.end, 13)
    share, arm = designs.evaluate([SHARE, abs(ratio("EC"))], theta=stems, unreachable="nan")
    room, E = designs.evaluate([ARM_TO_SPARE, "E"], theta=way, unreachable="nan")
    left, right, low, high = duty.box
    (x_E, y_E) = E[..., 0]
    sides = [share.min(axis=-1) - 1.0, room.min(axis=-1), x_E - left, right - x_E, y_E - low, high - y_E]
    return np.min(sides, axis=0), share.max(axis=-1) if objective == "even" else arm[..., 0]


def conditions(duty: Duty, machine: Grapple) -> list[Any]:
    """Return the conditions of (2.95) for `optimise` over the stems; the arm has one peak, so that the open end stands for the rest."""
    left, right, low, high = duty.box
    place = {name: at(coordinate("E"), theta=0.0) for name, coordinate in (("x", x), ("y", y))}
    return [
        least(SHARE) >= 1.0, least(ARM_TO_SPARE) >= 0.0, at(ARM_TO_SPARE, theta=machine.strokes["theta"].start) >= 0.0,
        place["x"] >= left, place["x"] <= right, place["y"] >= low, place["y"] <= high,
    ]  # fmt: skip


def design(duty: Duty, objective: str = "even", combinations: Sequence[Combination] | None = None) -> Optimum:
    """Return the best design of a duty.

    Parameters
    ----------
    duty : Duty
        The duty.
    objective : {"even", "arm"}, optional
        "even", the least greatest M_g / M_1, or "arm", of the least bore the greatest arm at D_0.
    combinations : sequence of Combination, optional
        Those searched on, by default the three most promising ones of `feasible`.

    Returns
    -------
    Optimum
        The design.

    Raises
    ------
    StudyError
        No design is good.
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
    greatest, arm = most(SHARE), at(abs(ratio("EC")), theta=0.0)
    least_rho = max(start.low - ROOM, shortest(machine, start.S) + PLACES[0])
    found = optimise(
        begun, minimise=greatest if objective == "even" else None, maximise=arm if objective == "arm" else None,
        vary={"rho": (float(least_rho), start.high + ROOM)}, subject_to=conditions(duty, machine),
        over={"theta": (0.0, machine.strokes["theta"].end)}, case="plain", method="local",
    )  # fmt: skip
    assert isinstance(found, Optimum)
    return found
