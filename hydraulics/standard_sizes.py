"""Standard sizes of cylinders by ISO 3320 and NFPA T3.6.7, their areas, thrust, pressure, oil. Every pressure in this file is gauge [Pa].

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

A catalogue of single-stage cylinders, row by row, is for a search to choose from.

    >>> rows = catalogue(bores=[80 * mm], rods=[45 * mm, 50 * mm], strokes=[250 * mm], dead=(120 * mm, 1.5))
    >>> rows[0]
    CatalogueRow(bore=0.08, rod=0.045, stroke=0.25, closed=0.49)
    >>> print(*rows, sep="; ")
    cylinder 80/45 x 250 mm, 490 mm closed; cylinder 80/50 x 250 mm, 490 mm closed
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable, Sequence
from dataclasses import replace
from itertools import product
from math import pi
from typing import Literal, NamedTuple, TypeAlias, get_args

import numpy as np
from numpy.typing import ArrayLike

from linkage.errors import DefinitionError, cited, ensure, known_name, require
from linkage.frozen import keep_own, record
from linkage.language import said, with_and
from linkage.units import inch, mm, show, shown_in, shown_number, unit_sign
from linkage.verdict import Remark, Verdict

from .inputs import Array, all_finite, in_metres, not_negative, one_design, one_number, pose_values, positive, stroke_in_metres

# Standard cylinder bores and piston rods.
#
# Source: ISO 3320 (metric series of bores and rods, and the ratios of the two areas), NFPA T3.6.7 (inch series of square-head cylinders),
# as makers' catalogues reproduce them.


@record
class Series:
    """A standard's series of bores and rods [m], ascending, and the least and the greatest ratio of piston area to annulus of its pairs."""

    name: str
    bores: tuple[float, ...]
    rods: tuple[float, ...]
    ratios: tuple[float, float]

    def is_pair(self, bore: float, rod: float) -> bool:
        """Return whether a rod suits a bore [m] by the ratio of their areas."""
        return rod < bore and self.ratios[0] <= bore**2 / (bore**2 - rod**2) <= self.ratios[1]

    def beside(self, size: float, name: str) -> tuple[float, ...]:
        """Return the sizes [m] next to one that is not of the series, of its "bores" or "rods"; empty where it is of it."""
        listed: tuple[float, ...] = getattr(self, name)
        if any(abs(size - each) < SAME_SIZE for each in listed):
            return ()
        return (*[each for each in listed if each < size][-1:], *[each for each in listed if each > size][:1])

    def rods_for(self, bore: float) -> tuple[float, ...]:
        """Return the rods [m] that suit a bore [m]."""
        return tuple(rod for rod in self.rods if self.is_pair(bore, rod))


METRIC = Series(
    "ISO 3320",
    tuple(each * mm for each in (
        8, 10, 12, 16, 20, 25, 32, 40, 50, 63, 80, 90, 100, 110, 125, 140, 160, 180, 200, 220, 250, 280, 320, 360, 400, 450, 500,
    )),
    tuple(each * mm for each in (
        4, 5, 6, 8, 10, 12, 14, 16, 18, 20, 22, 25, 28, 32, 36, 40, 45, 50, 56, 63, 70, 80, 90, 100, 110, 125, 140, 160, 180, 200,
        220, 250, 280, 320, 360,
    )),
    (1.06, 5.0),
)  # fmt: skip
INCH = Series(
    "NFPA T3.6.7",
    tuple(each * inch for each in (1.0, 1.125, 1.5, 2.0, 2.5, 3.25, 4.0, 5.0, 6.0, 7.0, 8.0, 10.0, 12.0, 14.0)),
    tuple(each * inch for each in (0.5, 0.625, 1.0, 1.375, 1.75, 2.0, 2.5, 3.0, 3.5, 4.0, 4.5, 5.0, 5.5, 7.0, 8.0, 10.0)),
    (1.028, 2.05),
)
SAME_SIZE = 1e-9  # m: a size that is met to rounding is of a series
SAME = 1.0 + 1e-9


def chosen_series() -> Series:
    """Return the series that sizes are offered of: that of inches where lengths are shown in inches, else the metric one."""
    return INCH if shown_in("mm") == "in" else METRIC


def series_of(bore: float, rod: float) -> Series:
    """Return the series that a bore and a rod [m] are looked up in: the chosen one, unless it has neither and the other has one of them."""
    chosen = chosen_series()
    other = METRIC if chosen is INCH else INCH
    had = {each.name: sum(not each.beside(size, name) for size, name in ((bore, "bores"), (rod, "rods"))) for each in (chosen, other)}
    return other if had[other.name] > had[chosen.name] else chosen


def standard_verdict(name: str, bore: float, rod: float) -> Verdict:
    """Return whether a bore and a rod [m] are a pair of ISO 3320 or NFPA T3.6.7; if not, the sizes next to them."""
    series = series_of(bore, rod)
    beside, rods = [series.beside(bore, "bores"), series.beside(rod, "rods")], series.rods_for(bore)
    says = said("bore {bore} and rod {rod}", bore=show(bore, "mm", 4), rod=show(rod, "mm", 4))
    if not any(beside) and any(abs(each - rod) < SAME_SIZE for each in rods):
        return Verdict("standard size", True, said("{says} are a pair of {series}.", says=says, series=series.name))
    faults = []
    if beside[0]:
        faults.append(said("the bore is not of {series}, next to it: {near}", series=series.name, near=_listed(beside[0])))
    if beside[1]:
        faults.append(said("the rod is not of {series}, next to it: {near}", series=series.name, near=_listed(beside[1])))
    if not faults:
        faults = [said("this rod does not suit this bore; it may have {rods}", rods=_listed(rods))]
    return Remark(f"{name}: {'; '.join([says, *faults])}.")


def _listed(values: Iterable[float]) -> str:
    return f"{with_and(shown_number(value, 'mm', 4) for value in values)} {unit_sign('mm')}"


def standard_bores() -> tuple[float, ...]:
    """Return the standard bores [m], ascending: of ISO 3320, of NFPA T3.6.7 where the system of units has inches.

    Returns
    -------
    tuple of float
        The bores [m].
    """
    return chosen_series().bores


def standard_rods(bore: float) -> tuple[float, ...]:
    """Return the standard rods [m], ascending, that suit a bore [m], of the series that `standard_bores` is of.

    By ISO 3320 the piston's area is 1.06 to 5 times the annulus. DefinitionError for a bore not above zero.

    Parameters
    ----------
    bore : float
        The bore [m].

    Returns
    -------
    tuple of float
        The rods [m].

    Raises
    ------
    DefinitionError
        A bore not above zero.
    """
    in_metres(positive(one_number(bore, "Bore"), "Bore"), "Bore")
    return chosen_series().rods_for(bore)


def next_bore(bore: float) -> float:
    """Return the smallest standard bore [m] above a bore [m]; DefinitionError where there is none.

    Parameters
    ----------
    bore : float
        The bore [m].

    Returns
    -------
    float
        The standard bore [m].

    Raises
    ------
    DefinitionError
        No standard bore is larger.
    """
    return _next(bore, standard_bores(), "bore")


def next_rod(rod: float) -> float:
    """Return the smallest standard rod [m] above a rod [m]; DefinitionError where there is none.

    Parameters
    ----------
    rod : float
        The rod [m].

    Returns
    -------
    float
        The standard rod [m].

    Raises
    ------
    DefinitionError
        No standard rod is larger.
    """
    return _next(rod, chosen_series().rods, "rod")


def _next(size: float, series: tuple[float, ...], what: str) -> float:
    positive(in_metres(one_number(size, what.capitalize()), what.capitalize()), what.capitalize())
    larger = [standard for standard in series if standard > size * SAME]
    if not larger:
        raise DefinitionError(
            f"No standard {what} of {chosen_series().name} is above {show(size, 'mm')}, the largest is {show(series[-1], 'mm', 4)}; "
            "use more cylinders or a higher pressure."
        )
    return larger[0]


Works: TypeAlias = Literal["piston", "rod", "both", "regenerative"]
"""What a cylinder works with: a side, both on lines of their own, or both on one line, which pushes with the area of the rod."""
MOST = 10_000
"""More cylinders side by side than any machine has."""


class RamSize(ABC):
    """The base of sizes: the areas of `count` equal rams side by side, and values that follow from them. They may be arrays."""

    count: int
    works: Works

    @property
    @abstractmethod
    def push_area(self) -> float | Array:
        """The area that pushes the ends apart: all pistons, m2."""

    @property
    @abstractmethod
    def pull_area(self) -> float | Array:
        """The area that pulls the ends together: all annuli, m2; none for a single-acting ram."""

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
        forward = pose_values(pressure, "Cylinder pressure", "pressure") * self.area
        return np.asarray(self.sense * (forward - pose_values(back, "Back pressure", "pressure") * self.back_area))[()]

    def pressure_for(self, thrust: ArrayLike, back: ArrayLike = 0.0) -> Array:
        """Return the pressure at which all cylinders together give a thrust [N] against a `back` pressure; they broadcast.

        Negative where the load drives the cylinder: this side is empty and the other one holds. Of both sides it is that in the
        piston side where it pushes, that in the rod side where it pulls. NaN and errors as `thrust`.
        """
        force, against = pose_values(thrust, "Thrust", ""), pose_values(back, "Back pressure", "pressure")
        if self.works == "both":
            pushing = (force + against * self.pull_area) / self.push_area
            return np.where(force < 0.0, (against * self.push_area - force) / self.pull_area, pushing)[()]
        return np.asarray((self.sense * force + against * self.back_area) / self.area)[()]

    def behind(self, force: Array) -> Array:
        """Return the pressure on the other side that gives a force, not below zero [N]; infinite where there is none."""
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.where(force > 0.0, force / self.back_area, 0.0 * force)[()]

    def oil(self, travel: ArrayLike) -> Array:
        """Return the oil [m3] that the working side of all cylinders takes in over a travel [m] in its direction, same shape.

        Of both sides a travel outwards (positive) fills the piston side, one inwards the rod side.
        """
        way = pose_values(travel, "Travel", "length")
        return np.where(way < 0.0, -way * self.pull_area, way * self.push_area)[()] if self.works == "both" else (way * self.area)[()]

    def speed(self, flow: ArrayLike) -> Array:
        """Return the speed [m/s] in the working direction (of both sides: outwards) at a flow [m3/s] into all cylinders, same shape."""
        return np.asarray(pose_values(flow, "Flow", "flow") / self.area)[()]


@record
class CylinderSize(RamSize):
    """The size of equal cylinders side by side: areas, forces and flows without a machine.

    Parameters
    ----------
    bore, rod : float or array
        The diameters [m]. Arrays over designs give numbers; sentences and offers are for one size.
    count : int, optional
        How many cylinders there are, 1 by default.
    works : {"piston", "rod", "both", "regenerative"}, optional
        The side that the pressure acts on.

    Raises
    ------
    DefinitionError
        A bore or rod is not above zero, a rod is not smaller than the bore, or the count is no positive integer.
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
            rods, bores = f"Rod {show(rod[thick][0], 'mm')}", f"bore {show(bore[thick][0], 'mm')}"
            raise DefinitionError(f"{rods} is not smaller than {bores}; exchange them or take a thinner rod.")
        count = one_number(self.count, "Count of cylinders", "number")
        ensure(1.0 <= count <= MOST and count == int(count), f"Count of cylinders = {cited(self.count)}; give a whole number from 1 on.")
        known_name("Side", self.works, get_args(Works), where="works")

    def __str__(self) -> str:
        many = "1 cylinder" if self.count == 1 else f"{self.count} cylinders"
        side = {"both": "both sides", "regenerative": "both sides on one line"}.get(self.works, f"{self.works} side")
        bore, rod = (shown_number(float(each), "mm", 4) for each in (self.bore, self.rod))
        return f"{many} {bore}/{rod} {shown_in('mm')}, {side}"

    @property
    def piston_area(self) -> float | Array:
        """Area of one piston, m2."""
        return pi / 4.0 * self.bore**2

    @property
    def rod_area(self) -> float | Array:
        """Area of the annulus around one rod, m2, under the rod side's pressure."""
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

    @property
    def single(self) -> tuple[float, float]:
        """Bore and rod [m] of one design; DefinitionError for a batch."""
        if np.size(self.bore) != 1 or np.size(self.rod) != 1:
            raise DefinitionError("Cylinder sizes are judged for one design at a time; this motion has several.")
        return one_design(self.bore), one_design(self.rod)

    def sized_for(self, thrust: float, pressure: float) -> CylinderSize:
        """Return the same with the smallest standard bore that gives a thrust [N] at a pressure, the rod kept.

        The thrust counts by its size. DefinitionError where no standard bore is enough, for a pressure not above zero.

        Parameters
        ----------
        thrust : float
            The thrust [N].
        pressure : float
            The pressure [Pa].

        Returns
        -------
        CylinderSize
            The size.

        Raises
        ------
        DefinitionError
            No standard bore is enough, or a pressure not above zero.
        """
        force = abs(one_number(thrust, "Thrust"))
        limit = float(positive(one_number(pressure, "Pressure", "pressure"), "Pressure"))
        pulls = self.works == "both" and thrust < 0.0
        for bore in standard_bores():
            size = replace(self, bore=bore) if bore > self.rod else None
            if size is not None and (size.pull_area if pulls else size.area) * limit >= force:
                return size
        raise DefinitionError(
            f"No standard bore of {chosen_series().name} gives {show(force, 'kN', 4)} with {self.count} of {self}; "
            "use more cylinders or a higher pressure."
        )


# A catalogue of single-stage cylinders.
#
# What is standard here: the bores, the rods and the ratio of their areas (ISO 3320), and the strokes (ISO 4393). No standard says how long
# a cylinder is closed: that follows from its head, its piston, its guide and its eyes, and is the maker's; give it as a dead length.
#
# Basic series of piston strokes, mm.
#
# Source: ISO 4393, as makers' catalogues reproduce it, to 500 mm. Above it makers go on with the preferred numbers R10 (ISO 3); mobile
# cylinders are made in any stroke, so that a list of one's own is often the better one.

STROKES = tuple(each * mm for each in (25, 40, 50, 80, 100, 125, 160, 200, 250, 320, 400, 500))
LONGER = tuple(each * mm for each in (630, 800, 1000, 1250, 1600, 2000))
# Whole inches, as makers of inch cylinders stock them; no standard says them.
INCH_STROKES = tuple(each * inch for each in (1, 2, 3, 4, 5, 6, 8, 10, 12, 14, 16, 18, 20))
INCH_LONGER = tuple(each * inch for each in (24, 30, 36, 48, 60, 72))

MOST_ROWS = 1_000_000


class CatalogueRow(NamedTuple):
    """A cylinder of a catalogue.

    Attributes
    ----------
    bore, rod : float
        The diameters [m].
    stroke : float
        How far it comes out [m].
    closed : float
        The distance of its pins drawn in [m].
    """

    bore: float
    rod: float
    stroke: float
    closed: float

    def __str__(self) -> str:
        bore, rod, stroke, closed = (shown_number(each, "mm", 4) for each in self)
        return f"cylinder {bore}/{rod} x {stroke} {shown_in('mm')}, {closed} {shown_in('mm')} closed"


def standard_strokes(longer: bool = False) -> tuple[float, ...]:
    """Return the basic strokes of ISO 4393 [m], ascending; `longer` goes on with the preferred numbers R10 to 2 m.

    Where the system of units has inches they are whole ones.

    Parameters
    ----------
    longer : bool
        Whether it continues with R10 to 2 m.

    Returns
    -------
    tuple of float
        The strokes [m].
    """
    basic, more = (INCH_STROKES, INCH_LONGER) if chosen_series() is INCH else (STROKES, LONGER)
    return (*basic, *more) if longer else basic


def catalogue(
    bores: Sequence[float] | None = None,
    rods: Sequence[float] | None = None,
    strokes: Sequence[float] | None = None,
    *,
    dead: float | tuple[float, float],
) -> list[CatalogueRow]:
    """Return the cylinders of all pairs of bore and rod, in all strokes, by bore, rod and stroke: rows that `optimise` varies.

    Without `bores` and `rods` those of ISO 3320, without `strokes` those of ISO 4393 [m]. Of the pairs it has those whose areas are in
    the ratios of that standard. Where the system of units has inches they are those of NFPA T3.6.7, with strokes of whole inches. `dead` is
    what a cylinder is longer between its pins, drawn in, than its stroke: a length [m], or (length, factor) for length + factor x bore.
    DefinitionError if no row is left, for numbers that are not above zero, or that were given in millimetres.

    Parameters
    ----------
    bores : sequence of float, optional
        The bores [m].
    rods : sequence of float, optional
        The rods [m].
    strokes : sequence of float, optional
        The strokes [m].
    dead : float or tuple of float
        The length between the pins, drawn in, less the stroke [m]; or (length, factor of the bore).

    Returns
    -------
    list of CatalogueRow
        The rows.

    Raises
    ------
    DefinitionError
        No row is left, or a number is not above zero.
    """
    parts, rows = all_finite(dead, "Dead length", "length"), []
    require(parts.shape in ((), (2,)), "Dead length", dead, "give a length [m], or (length, factor of the bore) such as (0.12, 1.5)")
    constant, factor = (float(parts), 0.0) if parts.ndim == 0 else map(float, parts)
    in_metres(not_negative(constant, "Dead length"), "Dead length")
    in_metres(not_negative(factor, "Factor of the bore"), "Factor of the bore", 100.0)
    positive(constant + factor, "Dead length")
    standard = chosen_series()
    asked = ((bores, standard.bores, "Bore"), (rods, standard.rods, "Rod"), (strokes, standard_strokes(), "Stroke"))
    sizes = [series_values(*each) for each in asked]
    if len(sizes[0]) * len(sizes[1]) * len(sizes[2]) > MOST_ROWS:
        raise DefinitionError(f"The catalogue would have more than {MOST_ROWS} rows; give fewer bores, rods or strokes.")
    pairs = [(bore, rod) for bore, rod in product(*sizes[:2]) if series_of(bore, rod).is_pair(bore, rod)]
    for (bore, rod), stroke in product(pairs, sizes[2]):
        stroke_in_metres(stroke, "Stroke", bore)
        rows.append(CatalogueRow(bore, rod, stroke, round(stroke + constant + factor * bore, 9)))
    what = f"The catalogue has no row: no rod suits a bore by the ratios of {standard.name}"
    ensure(rows, f"{what}; give others, or leave rods= out.")
    return rows


def series_values(given: Sequence[float] | None, standard: Sequence[float], what: str) -> list[float]:
    """Return sizes [m], ascending, each once: those given, else those of a standard."""
    if given is None:
        return [*standard]
    sizes = positive(given, what)
    ensure(sizes.ndim == 1, f"{what} = {cited(given)}: a list is expected, such as [{standard[-4] / mm:.6g} * mm].")
    in_metres(sizes, what) if what != "Stroke" else stroke_in_metres(sizes, what)
    return sorted({float(each) for each in sizes})
