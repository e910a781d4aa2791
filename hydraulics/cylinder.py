"""The size of a hydraulic cylinder: areas, thrust, pressure, oil. Every pressure in this file is gauge [Pa].

    thrust                    works = "piston": +    works = "rod": -
    <--[====|-----]======-->  pressure left of |     pressure right of |, on the annulus around the rod

Positive thrust pushes the ends apart. A cylinder that works with its rod side pulls: its thrust is negative. One that works
with "both" pushes with the piston and pulls with the annulus, as the load requires.

    >>> from linkage.units import bar, kN, mm
    >>> size = CylinderSize(bore=63 * mm, rod=40 * mm, count=2)
    >>> print(f"{size.thrust(100 * bar) / kN:.2f} kN, {size.pressure_for(50 * kN) / bar:.1f} bar")
    62.34 kN, 80.2 bar
    >>> print(size.sized_for(80 * kN, 100 * bar))
    2 cylinders 80/40 mm, piston side
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass, replace
from math import pi
from typing import Literal, TypeAlias, final

import numpy as np
from numpy.typing import ArrayLike

from linkage.errors import DefinitionError, cited, known_name
from linkage.frozen import keep_own, refuses_changes
from linkage.units import kN, mm

from .inputs import Array, in_metres, one_number, pose_values, positive

# Standard cylinder bores and piston rods.
#
# Source: ISO 3320 (metric series of bores and rods, and the ratios of the two areas), as makers' catalogues reproduce it.

BORES_MM = (
    8, 10, 12, 16, 20, 25, 32, 40, 50, 63, 80, 90, 100, 110, 125, 140, 160, 180, 200, 220, 250, 280, 320, 360, 400, 450, 500,
)  # fmt: skip
RODS_MM = (
    4, 5, 6, 8, 10, 12, 14, 16, 18, 20, 22, 25, 28, 32, 36, 40, 45, 50, 56, 63, 70, 80, 90, 100, 110, 125, 140, 160, 180, 200,
    220, 250, 280, 320, 360,
)  # fmt: skip
RATIOS = (1.06, 5.0)
"""The least and the largest ratio of piston area to annulus in the standard's series."""

SAME = 1.0 + 1e-9


def standard_bores() -> tuple[float, ...]:
    """Return the bores of ISO 3320 [m], ascending."""
    return tuple(bore * mm for bore in BORES_MM)


def standard_rods(bore: float) -> tuple[float, ...]:
    """Return the rods of ISO 3320 [m], ascending, that suit a bore [m]: piston area 1.06 to 5 times the annulus.

    DefinitionError for a bore not above zero.
    """
    in_metres(positive(one_number(bore, "Bore"), "Bore"), "Bore")
    return tuple(rod * mm for rod in RODS_MM if is_pair(bore, rod * mm))


def is_pair(bore: float, rod: float) -> bool:
    """Return whether a rod suits a bore [m]: piston area 1.06 to 5 times the annulus, the ratios of ISO 3320."""
    return rod < bore and RATIOS[0] <= bore**2 / (bore**2 - rod**2) <= RATIOS[1]


def next_bore(bore: float) -> float:
    """Return the smallest standard bore [m] above a bore [m]; DefinitionError where there is none."""
    return _next(bore, standard_bores(), "bore")


def next_rod(rod: float) -> float:
    """Return the smallest standard rod [m] above a rod [m]; DefinitionError where there is none."""
    return _next(rod, tuple(rod * mm for rod in RODS_MM), "rod")


def _next(size: float, series: tuple[float, ...], what: str) -> float:
    positive(one_number(size, what.capitalize()), what.capitalize())
    larger = [standard for standard in series if standard > size * SAME]
    if not larger:
        raise DefinitionError(
            f"No standard {what} of ISO 3320 is above {size / mm:.6g} mm, the largest is {series[-1] / mm:.0f} mm; "
            "use more cylinders or a higher pressure."
        )
    return larger[0]


Works: TypeAlias = Literal["piston", "rod", "both", "regenerative"]
"""What a cylinder works with: a side, both on lines of their own, or both on one line, which pushes with the area of the rod."""
MOST = 10_000
"""More cylinders side by side than any machine has."""

SIDES = ("piston", "rod", "both", "regenerative")


class RamSize(ABC):
    """The base of sizes: the areas of `count` equal rams side by side, and what follows from them. They may be arrays."""

    count: int
    works: Works

    @property
    @abstractmethod
    def push_area(self) -> float | Array:
        """The area that pushes the ends apart: all pistons, m2."""

    @property
    @abstractmethod
    def pull_area(self) -> float | Array:
        """The area that pulls the ends together: all annuli, m2; none for what is single acting."""

    @abstractmethod
    def with_bore(self, bore: float) -> RamSize:
        """Return the same with another bore [m]."""

    @property
    def area(self) -> float | Array:
        """The area the pressure acts on, all cylinders, m2; of both sides that which pushes."""
        return self.pull_area if self.works == "rod" else self.outward_area

    @property
    def back_area(self) -> float | Array:
        """The area on the other side of the pistons, all cylinders, m2; none where both are on one line."""
        return self.push_area if self.works == "rod" else self.inward_area

    @property
    def outward_area(self) -> float | Array:
        """The area that the line pushes the ends apart with: all pistons, or all rods where both sides are on one line, m2."""
        return self.push_area - self.pull_area if self.works == "regenerative" else self.push_area

    @property
    def inward_area(self) -> float | Array:
        """The area that a line of its own pulls the ends together with: all annuli, none where both sides are on one line, m2."""
        return 0.0 * self.pull_area if self.works == "regenerative" else self.pull_area

    @property
    def sense(self) -> int:
        """+1 where the working side pushes the ends apart, -1 where it pulls them together."""
        return -1 if self.works == "rod" else 1

    def thrust(self, pressure: ArrayLike, back: ArrayLike = 0.0) -> Array:
        """Return the thrust [N] of all cylinders at a pressure, with `back` pressure on the other side; the two broadcast.

        Of both sides it is the push; `-size.pull_area * pressure` is the pull.

        Seal friction may be taken off the pressure, so a negative one is not refused. NaN in an array stays NaN.
        DefinitionError for a lone NaN or an infinite pressure.
        """
        forward = pose_values(pressure, "Cylinder pressure") * self.area
        thrust: Array = self.sense * (forward - pose_values(back, "Back pressure") * self.back_area)
        return thrust[()]

    def pressure_for(self, thrust: ArrayLike, back: ArrayLike = 0.0) -> Array:
        """Return the pressure at which all cylinders together give a thrust [N] against a `back` pressure; they broadcast.

        Negative where the load drives the cylinder: this side is empty and the other one holds. Of both sides it is that in the
        piston side where it pushes, that in the rod side where it pulls. NaN and errors as `thrust`.
        """
        force, against = pose_values(thrust, "Thrust"), pose_values(back, "Back pressure")
        if self.works == "both":
            pushing: Array = (force + against * self.pull_area) / self.push_area
            return np.where(force < 0.0, (against * self.push_area - force) / self.pull_area, pushing)[()]
        pressure: Array = (self.sense * force + against * self.back_area) / self.area
        return pressure[()]

    def behind(self, force: Array) -> Array:
        """Return the pressure on the other side that gives a force, not below zero [N]; infinite where there is none."""
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.where(force > 0.0, force / self.back_area, 0.0)[()]

    def oil(self, travel: ArrayLike) -> Array:
        """Return the oil [m3] that the working side of all cylinders takes in over a travel [m] in its direction, same shape.

        Of both sides a travel outwards (positive) fills the piston side, one inwards the rod side.
        """
        way = pose_values(travel, "Travel")
        oil: Array = np.where(way < 0.0, -way * self.pull_area, way * self.push_area) if self.works == "both" else way * self.area
        return oil[()]

    def speed(self, flow: ArrayLike) -> Array:
        """Return the speed [m/s] in the working direction (of both sides: outwards) at a flow [m3/s] into all cylinders, same shape."""
        speed: Array = pose_values(flow, "Flow") / self.area
        return speed[()]


@final
@refuses_changes
@dataclass(frozen=True)
class CylinderSize(RamSize):
    """`count` equal cylinders side by side, of a bore and a rod [m]; `works` is the side the pressure acts on.

    A bore or rod may be an array over designs, for the numbers; the sentences and the offers are for one size.

    DefinitionError for a bore or rod not above zero, a rod not smaller than the bore, a count that is no positive integer.
    """

    bore: float | Array
    rod: float | Array
    count: int = 1
    works: Works = "piston"

    def __post_init__(self) -> None:
        keep_own(self)
        for value, what in ((self.bore, "Bore"), (self.rod, "Rod")):
            positive(in_metres(value, what), what)
        if np.any(np.greater_equal(self.rod, self.bore)):
            rod, bore = np.broadcast_arrays(self.rod, self.bore)
            thick = rod >= bore
            rods, bores = f"Rod {rod[thick][0] / mm:.6g} mm", f"bore {bore[thick][0] / mm:.6g} mm"
            raise DefinitionError(f"{rods} is not smaller than {bores}; exchange them or take a thinner rod.")
        count = one_number(self.count, "Count of cylinders")
        if not 1.0 <= count <= MOST or count != int(count):
            raise DefinitionError(f"Count of cylinders = {cited(self.count)}; give a whole number from 1 on.")
        known_name("Side", self.works, SIDES, where="works")

    def __str__(self) -> str:
        many = "1 cylinder" if self.count == 1 else f"{self.count} cylinders"
        side = {"both": "both sides", "regenerative": "both sides on one line"}.get(self.works, f"{self.works} side")
        return f"{many} {self.bore / mm:.4g}/{self.rod / mm:.4g} mm, {side}"

    @property
    def piston_area(self) -> float | Array:
        """Area of one piston, m2."""
        return pi / 4.0 * self.bore**2

    @property
    def rod_area(self) -> float | Array:
        """Area of the annulus around one rod, m2: what the rod side's pressure acts on."""
        return pi / 4.0 * (self.bore**2 - self.rod**2)

    @property
    def ratio(self) -> float | Array:
        """Piston area over annulus (phi of ISO 3320)."""
        return self.piston_area / self.rod_area

    @property
    def push_area(self) -> float | Array:
        return self.count * self.piston_area

    @property
    def pull_area(self) -> float | Array:
        return self.count * self.rod_area

    def with_bore(self, bore: float) -> CylinderSize:
        return CylinderSize(bore, self.rod, self.count, self.works)

    def next_size(self) -> CylinderSize:
        """Return the same with the next standard bore; DefinitionError where there is none."""
        return replace(self, bore=next_bore(float(self.bore)))

    def sized_for(self, thrust: float, pressure: float) -> CylinderSize:
        """Return the same with the smallest standard bore that gives a thrust [N] at a pressure, the rod kept.

        The thrust counts by its size. DefinitionError where no standard bore is enough, for a pressure not above zero.
        """
        force = abs(one_number(thrust, "Thrust"))
        limit = float(positive(one_number(pressure, "Pressure"), "Pressure"))
        pulls = self.works == "both" and thrust < 0.0
        for bore in standard_bores():
            size = replace(self, bore=bore) if bore > self.rod else None
            if size is not None and (size.pull_area if pulls else size.area) * limit >= force:
                return size
        raise DefinitionError(
            f"No standard bore of ISO 3320 gives {force / kN:.4g} kN with {self.count} of {self}; use more cylinders or a higher pressure."
        )
