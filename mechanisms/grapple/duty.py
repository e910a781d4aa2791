"""What a grapple has to do and what it may be made of: stems, hinge, cylinders, room; checked in words. Pressures are gauge [Pa].

>>> from linkage.units import mm
>>> print(Duty.at_breast_height(440 * mm, 1.25))
stems of 100 to 550 mm, 4 bores from 50 mm, 10 strokes from 100 mm
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields
from math import inf
from typing import Any, ClassVar, TypeAlias, final

from hydraulics.cylinder import CylinderSize
from hydraulics.inputs import efficient, in_pascals, one_number, positive
from linkage import DefinitionError, Stroke, ref
from linkage.checks import require
from linkage.frozen import refuses_changes
from linkage.quantities import Quantity, quantity
from linkage.units import MPa, deg, mm

from .machine import Grapple, InnerGrapple

Moment: TypeAlias = "Callable[[Quantity, Quantity], Quantity | float]"
"""What a stem needs about the hinge [N m], of its diameter [m] and the arm of its push on the lever [m]: quantities."""

LENGTHS = ("D_0", "d_0", "hinge_gap", "bush", "dead")
RIGHT_ANGLE = 90 * deg


def assumed_moment(D: Quantity, arm: Quantity) -> Quantity:
    """Return the assumed law of M_1 [N m]: a push of 6 kN + 40 kN/m2 D**2 on the lever. The source's own (fig. 2.24) is not at hand."""
    return (6000.0 + 40000.0 * D**2) * arm


@final
@refuses_changes
@dataclass(frozen=True)
class Duty:
    """The stems [m], the wrap angles [rad] and what the lever may be driven by; every number as in `Grapple`.

    `cylinders` are bores and rods [m], `strokes` standard strokes [m]; `box` is the room for the pin E: left, right, low, high [m] (2.89).
    `moment` gives M_1; `inner` puts the cylinder at the inner hinge, where its rod side works. DefinitionError for what cannot be.
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
        numbers = [each.name for each in fields(self) if isinstance(each.default, float)]
        for name in numbers:
            object.__setattr__(self, name, one_number(getattr(self, name), name))
        for name in LENGTHS:
            positive(getattr(self, name), name)
        self._check_stems()
        in_pascals(positive(self.pressure, "pressure"), "pressure")
        efficient(self.efficiency, "efficiency")
        try:
            rows = [numbers_of(row) for row in self.cylinders]
        except TypeError:  # nothing that has rows
            rows = []
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
        """Return the duty for trees of a diameter at breast height [m], the stem q_0 times as thick where it is gripped. (2.67)"""
        positive(one_number(q_0, "q_0"), "q_0")
        return cls(D_0=q_0 * one_number(diameter, "diameter"), **others)

    def __str__(self) -> str:
        bore, stroke = self.cylinders[0][0], self.strokes[0]
        stems = f"stems of {self.d_0 / mm:.4g} to {self.D_0 / mm:.4g} mm"
        return f"{stems}, {len(self.cylinders)} bores from {bore / mm:.4g} mm, {len(self.strokes)} strokes from {stroke / mm:.4g} mm"

    def _check_stems(self) -> None:
        """Raise DefinitionError for stems and angles that no lever holds."""
        if self.d_0 >= self.D_0:
            said = f"the smallest stem d_0 = {self.d_0 / mm:.4g} mm is not below the largest, D_0 = {self.D_0 / mm:.4g} mm"
            raise DefinitionError(f"Duty: {said}; exchange them.")
        if not 0.0 < self.alpha < RIGHT_ANGLE:
            said = f"alpha = {self.alpha / deg:.4g} deg: the lever wraps the largest stem by more than 0 and less than 90 deg"
            raise DefinitionError(f"Duty: {said}; 52 to 57 deg is the best (Shimkovich).")
        if not -RIGHT_ANGLE < self.beta < RIGHT_ANGLE:
            raise DefinitionError(f"Duty: beta = {self.beta / deg:.4g} deg lies between -90 and 90 deg; 0 is a lever end below the stem.")
        if self.opening < 1.0:
            said = f"opening = {self.opening:.4g}: a lever that opens by less than the release angle keeps the stem"
            raise DefinitionError(f"Duty: {said}; 1.2 to 1.4 (2.81).")


def numbers_of(given: Any) -> list[float]:
    """Return numbers [SI]; none for anything else."""
    try:
        return [float(each) for each in given]
    except (TypeError, ValueError):
        return []


def grapple_for(duty: Duty, **design: float) -> Grapple:
    """Return the machine of a duty: a class with the range of theta and the M_1 that it needs, and a `design` of it [SI]."""
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
