"""A cylinder between two points of a mechanism: declared like them, checked against its stroke. Pressures are gauge [Pa].

    >>> from linkage.units import bar, kN, mm
    >>> lift = Cylinder("A", "B", bore=110 * mm, rod=60 * mm, count=2)
    >>> print(f"{lift.thrust(160 * bar) / kN:.1f} kN; {lift.pressure_for(200 * kN) / bar:.1f} bar")
    304.1 kN; 105.2 bar
    >>> print(lift.standard())
    FAIL standard size: bore 110 mm and rod 60 mm; the rod is not of ISO 3320, next to it are 56 and 63 mm.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, ClassVar, Literal, final

import numpy as np
from numpy.typing import ArrayLike

from linkage.errors import DefinitionError, unknown
from linkage.loads import ForceElement, Load, Poses
from linkage.quantities import Reference, label, name_of
from linkage.units import mm

from .buckling import Buckling
from .cylinder import CylinderSize
from .inputs import Array, positive
from .settings import follows, number_set
from .sizes import BORES_MM, RODS_MM, standard_rods
from .verdict import Verdict


@final
@dataclass(frozen=True, eq=False)
class Cylinder(ForceElement):
    """`count` equal cylinders side by side between A and B: `lift = Cylinder(A, B, bore=110 * mm, rod=60 * mm, count=2)`.

    In a class bore and rod [m] are the design variables `lift.bore` and `lift.rod`. `works` is the side the pressure acts
    on. `closed` is the distance of its pins drawn in, `stroke` how far it comes out [m]; `mounting` and `safety` are for
    buckling. Its thrust is what the statics look for, so that it puts no load of its own on the mechanism.
    """

    A: Reference
    B: Reference
    bore: Any
    rod: Any
    count: int = 1
    works: Literal["piston", "rod"] = "piston"
    stroke: float | None = None
    closed: float | None = None
    mounting: str = "pin-pin"
    safety: float = 3.5
    places: ClassVar[tuple[str, ...]] = ("A", "B")
    parameters: ClassVar[Mapping[str, str]] = MappingProxyType({"bore": "mm", "rod": "mm"})

    def __post_init__(self) -> None:
        super().__post_init__()
        bore, rod = (2.0, 1.0) if self._follows else (self.bore, self.rod)
        CylinderSize(bore, rod, self.count, self.works)
        Buckling(1.0, self.mounting, self.safety)
        for value, what in ((self.stroke, "Stroke of the cylinder"), (self.closed, "Closed length of the cylinder")):
            if value is not None:
                positive(value, what)

    def loads(self, motion: Poses) -> list[Load]:
        return []

    def cylinders(self) -> tuple[tuple[str, str], ...]:
        return ((name_of(self.A), name_of(self.B)),)

    # -- its size ------------------------------------------------------------------------------------------

    @property
    def size(self) -> CylinderSize:
        """The size as it is written here; DefinitionError where a bore or rod follows something else."""
        if self._follows:
            raise DefinitionError(f"{self}: its size follows the design; ask for sized(motion).")
        return CylinderSize(self.bore, self.rod, self.count, self.works)

    @property
    def _follows(self) -> bool:
        """Whether bore or rod follow a quantity of the class."""
        return follows(self.bore, self.rod)

    def sized(self, motion: Poses) -> CylinderSize:
        """Return the size that a motion's designs have; bore and rod [m] broadcast against the motion."""
        bore, rod = number_set(self, motion, "bore"), number_set(self, motion, "rod")
        return CylinderSize(bore[()], rod[()], self.count, self.works)

    def thrust(self, pressure: ArrayLike, back: ArrayLike = 0.0) -> Array:
        """Return the thrust [N] at a pressure, with `back` pressure on the other side: `CylinderSize.thrust`."""
        return self.size.thrust(pressure, back)

    def pressure_for(self, thrust: ArrayLike, back: ArrayLike = 0.0) -> Array:
        """Return the pressure [Pa] that gives a thrust [N]: `CylinderSize.pressure_for`."""
        return self.size.pressure_for(thrust, back)

    def offers(self, thrust: float, pressure: float, length: float | None = None) -> list[CylinderSize]:
        """Return the standard sizes (ISO 3320) that give a thrust [N] at a pressure: the smallest bore, each rod that suits.

        With a `length` between the pins [m] only rods that do not buckle under a positive thrust. DefinitionError where no bore is enough.
        """
        thin = CylinderSize(self.size.bore, min(self.size.rod, RODS_MM[0] * mm), self.count, self.works)
        bore = float(thin.sized_for(thrust, pressure).bore)
        sizes = [CylinderSize(bore, rod, self.count, self.works) for rod in standard_rods(bore)]
        enough = [size for size in sizes if size.area * pressure >= abs(thrust)]
        push = max(thrust, 0.0) / self.count
        return [size for size in enough if length is None or Buckling(float(size.rod), self.mounting, self.safety).allowed(length) >= push]

    # -- checks --------------------------------------------------------------------------------------------

    def checks(self, motion: Poses, thrust: ArrayLike | None = None) -> list[Verdict]:
        """Return what can be said of it over a motion of one design: length, standard size, and buckling under a thrust [N]."""
        return [*self.fits(motion), self.standard(motion), *([] if thrust is None else [self.buckling(motion, thrust)])]

    def fits(self, motion: Poses) -> list[Verdict]:
        """Return whether its closed and its open length serve the motion; nothing where neither is given.

        With the stroke alone it is compared with the travel: largest less least distance of its pins.
        """
        length = motion.distance(self.A, self.B)
        if not np.any(np.isfinite(length)):
            raise DefinitionError(f"{self}: no pose of this motion can be assembled, so that there is no length to check.")
        low, high = float(np.nanmin(length)), float(np.nanmax(length))
        if self.closed is not None:
            return [self._reaches(low, high, self.closed, self.closed + self.stroke if self.stroke is not None else np.inf)]
        return [] if self.stroke is None else [self._travels(high - low, self.stroke)]

    def _reaches(self, low: float, high: float, closed: float, opened: float) -> Verdict:
        out = f" and {opened / mm:.1f} mm open" if np.isfinite(opened) else ""
        faults = []
        if closed > low + TOLERANCE:
            faults.append(f"it is {(closed - low) / mm:.1f} mm too long closed: take one with a shorter closed length")
        if opened < high - TOLERANCE:
            faults.append(f"{(high - opened) / mm:.1f} mm are missing open: take a longer stroke")
        says = f"{self._pins} goes from {low / mm:.1f} to {high / mm:.1f} mm, the cylinder is {closed / mm:.1f} mm long closed{out}"
        return Verdict("length", not faults, f"{'; '.join([says, *faults])}.")

    def _travels(self, travel: float, stroke: float) -> Verdict:
        says = f"{self._pins} changes by {travel / mm:.1f} mm, the stroke is {stroke / mm:.1f} mm"
        short = travel > stroke + TOLERANCE
        missing = f"; {(travel - stroke) / mm:.1f} mm are missing: take a longer stroke"
        return Verdict("length", not short, f"{says}{missing if short else ''}.")

    def standard(self, motion: Poses | None = None) -> Verdict:
        """Return whether bore and rod are of ISO 3320; where not, what is next to them."""
        size = one_size(self.size if motion is None else self.sized(motion))
        faults = [text for text in (_near(size.bore, BORES_MM, "bore"), _near(size.rod, RODS_MM, "rod")) if text]
        suits = any(abs(rod - size.rod) < 1e-9 for rod in standard_rods(size.bore))
        if not faults and not suits:
            faults = [f"this rod does not suit this bore; it may have {_listed(rod / mm for rod in standard_rods(size.bore))} mm"]
        says = f"bore {size.bore / mm:.4g} mm and rod {size.rod / mm:.4g} mm"
        return Verdict("standard size", not faults, f"{'; '.join([says, *faults]) if faults else f'{says} are a pair of ISO 3320'}.")

    def buckling(self, motion: Poses, thrust: ArrayLike) -> Verdict:
        """Return whether a rod buckles under the thrust [N] of all cylinders over the motion, one design."""
        size = one_size(self.sized(motion))
        return Buckling(size.rod, self.mounting, self.safety).check(motion.distance(self.A, self.B), np.asarray(thrust) / self.count)

    @property
    def _pins(self) -> str:
        return "".join(label(end) for end in (self.A, self.B))


def is_named(reference: Reference) -> bool:
    """Return whether a reference to a cylinder goes by its name in a class."""
    return isinstance(reference, str) or bool(reference.name)


def the_cylinder(motion: Poses, reference: Reference) -> Cylinder:
    """Return the cylinder a reference stands for, as the motion's class has it; DefinitionError where there is none."""
    if is_named(reference):
        return found_in(motion.plan.members, reference, motion.plan.title)
    return _cylinder(reference, "The circuit")


def found_in(members: Mapping[str, Any], reference: Reference, where: str) -> Cylinder:
    """Return the cylinder a reference stands for in a class; DefinitionError where there is none."""
    name = name_of(reference)
    if name in members:
        return _cylinder(members[name], where)
    if isinstance(reference, str):
        raise unknown("Cylinder", name, (each for each, member in members.items() if isinstance(member, Cylinder)), where=where)
    return _cylinder(reference, where)


def _cylinder(found: Any, where: str) -> Cylinder:
    if not isinstance(found, Cylinder):
        raise DefinitionError(f"{where}: {found} is no Cylinder; name one.")
    return found


TOLERANCE = 1e-9  # m: a length that is met to rounding is met


@dataclass(frozen=True)
class OneSize:
    """A bore and a rod [m] of one design."""

    bore: float
    rod: float


def one_size(size: CylinderSize) -> OneSize:
    """Return the bore and rod of one design; DefinitionError for a batch."""
    if np.size(size.bore) != 1 or np.size(size.rod) != 1:
        raise DefinitionError("Cylinder sizes are judged for one design at a time; this motion has several.")
    return OneSize(float(np.ravel(size.bore)[0]), float(np.ravel(size.rod)[0]))


def _near(value: float, series: tuple[int, ...], what: str) -> str:
    """Return what stands beside a size [m] that is not of a series [mm]; empty where it is of it."""
    if any(abs(value / mm - each) < 1e-6 for each in series):
        return ""
    below, above = [each for each in series if each * mm < value][-1:], [each for each in series if each * mm > value][:1]
    return f"the {what} is not of ISO 3320, next to it {'are' if below and above else 'is'} {_listed([*below, *above])} mm"


def _listed(values: Any) -> str:
    return " and ".join(f"{value:.0f}" for value in values)
