"""Regions in which a search's points may stand: drawn from, returned to, and kept as conditions."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import final

import numpy as np

from ..checks import require_type
from ..errors import DefinitionError, known_name
from ..mechanism import Mechanism
from ..motion.measures import Constraint, least
from ..motion.regions import Disc, Region, inside_region, region_of
from ..numeric.line import Index
from ..plan import Reading
from ..program import FloatArray
from ..surroundings import Outline
from .box import unit_points
from .varied import Varied

TRIED = 1 << 15
"""Places of the box that are tried at the most for one inside a region."""


@final
@dataclass(frozen=True, eq=False)
class PointRegion:
    """The region of a point. Of a fixed point that varies `places` are its variables, x and y, None for one that does not vary.

    `signs` (2,) are those of the coordinates in these, `fixed` (2,) what stands for the others [m].
    """

    point: str
    region: Region
    places: tuple[int | None, int | None]
    signs: tuple[float, float]
    fixed: tuple[float, float]

    @property
    def as_condition(self) -> Constraint:
        """The condition that it is."""
        return least(inside_region(self.point, self.region)) >= 0.0

    @property
    def varies(self) -> bool:
        """Whether the point is one that a search places."""
        return self.places != (None, None)

    def of(self, values: FloatArray) -> FloatArray:
        """Return where the point stands (m, 2) by the variables' values (m, n)."""
        columns = [
            np.full(len(values), fixed) if place is None else sign * values[:, place]
            for place, sign, fixed in zip(self.places, self.signs, self.fixed, strict=True)
        ]
        return np.stack(columns, axis=1)

    def put(self, values: FloatArray, rows: Index | slice, where: FloatArray) -> None:
        """Put the point of some rows of values (m, n) where it is to stand, (k, 2)."""
        for column, (place, sign) in enumerate(zip(self.places, self.signs, strict=True)):
            if place is not None:
                values[rows, place] = sign * where[:, column]


def point_regions(machine: Mechanism, given: object, circles: Mapping[str, float], variables: Sequence[Varied]) -> tuple[PointRegion, ...]:
    """Return the regions that are given, and circles about where points stand now, by their radius; DefinitionError for anything else."""
    title, plan = machine.plan.title, machine.plan
    expected = 'a region for each point is expected, regions={"C": [(0, 0), (0.4, 0), (0.4, 0.3)]}'
    regions = require_type(f"{title}: regions", {} if given is None else given, Mapping, expected)
    reading = Reading(plan.members, plan.table.lengths, machine.dimensions)
    found = []
    for point, shapes in regions.items():
        known_name("Point", point, plan.points, where=f"{title}: regions")
        where = f"{title}: regions={{{point!r}: ...}}"
        region = region_of(shapes, where, plan.of_kind(Outline), lambda each: float(reading.value(each)))
        found.append(point_region(machine, point, region, variables))
    for point, radius in circles.items():
        x, y = (sign * float(machine.dimensions[owner]) for owner, sign in (plan.table.spellings[f"{point}.{axis}"] for axis in "xy"))
        found.append(point_region(machine, point, Region((Disc(x, y, radius),), ()), variables))
    return tuple(found)


def point_region(machine: Mechanism, point: str, region: Region, variables: Sequence[Varied]) -> PointRegion:
    """Return the region of a point; DefinitionError where it does not vary and stands outside."""
    spellings = machine.plan.table.spellings
    places: list[int | None] = [None, None]
    signs, fixed = [1.0, 1.0], [0.0, 0.0]
    if f"{point}.x" not in spellings or f"{point}.y" not in spellings:  # a point that moves, or that follows others
        return PointRegion(point, region, (None, None), (1.0, 1.0), (0.0, 0.0))
    for column, axis in enumerate("xy"):
        owner, sign = spellings[f"{point}.{axis}"]
        fixed[column] = sign * float(machine.dimensions[owner])
        for place, each in enumerate(variables):
            if each.owner == owner:
                places[column], signs[column] = place, float(sign) * each.sign
    return PointRegion(point, region, (places[0], places[1]), (signs[0], signs[1]), (fixed[0], fixed[1]))


def drawn_inside(title: str, regions: Sequence[PointRegion], variables: Sequence[Varied], values: FloatArray, seed: int) -> FloatArray:
    """Return designs (m, n) whose points stand in their regions: those outside are drawn anew, evenly over the region.

    DefinitionError where a region and the ranges of the variables have no point in common.
    """
    found = np.array(values)
    for number, each in enumerate(regions):
        out = np.flatnonzero(each.region.depths(each.of(found)) < 0.0) if each.varies else np.zeros(0, int)
        if len(out):
            places = places_inside(title, each, variables, len(out), seed + number)
            each.put(found, out, places[np.arange(len(out)) % len(places)])
    return found


def places_inside(title: str, each: PointRegion, variables: Sequence[Varied], count: int, seed: int) -> FloatArray:
    """Return places in a region, evenly spread, (k, 2), as many as `count` if there are; DefinitionError for none."""
    low, high = (np.array(end) for end in each.region.box)
    for column, (place, sign) in enumerate(zip(each.places, each.signs, strict=True)):
        ends = [each.fixed[column]] * 2 if place is None else sorted(sign * end for end in (variables[place].low, variables[place].high))
        low[column], high[column] = max(low[column], ends[0]), min(high[column], ends[1])
    found: FloatArray = np.zeros((0, 2))
    tried = 1 << max(count - 1, 63).bit_length()
    while np.all(low <= high) and tried <= TRIED:
        places = low + (high - low) * unit_points(tried, 2, "sobol", seed)
        found = places[each.region.depths(places) >= 0.0]
        if len(found) >= count:
            return np.asarray(found[:count])
        tried *= 2
    if not len(found):
        raise DefinitionError(f"{title}: regions={{{each.point!r}: ...}}: nothing of it lies in the ranges of vary=; widen one of them.")
    return found


def put_inside(regions: Sequence[PointRegion], values: FloatArray) -> FloatArray:
    """Return designs (m, n) whose points outside of their regions stand at the nearest places in them."""
    found = np.array(values)
    for each in regions:
        if each.varies:
            each.put(found, slice(None), each.region.nearest(each.of(found)))
    return found
