"""What may vary: a search's space of ranges, steps, choices and rows of a catalogue, and the box of settings of a study."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from functools import cached_property
from itertools import product
from math import prod
from statistics import median
from typing import Any, TypeGuard

import numpy as np

from ..errors import (
    AssemblyError,
    DefinitionError,
    cited,
    ensure,
    is_listed,
    is_whole,
    known_name,
    one_word,
    require,
    require_one_design,
    require_type,
    require_whole,
    unfit,
    unknown,
)
from ..frozen import immutable, record
from ..loads import ForceElement
from ..mechanism import Mechanism, require_mechanism
from ..motion.measures import Constraint, least
from ..motion.regions import Disc, Region, inside_region, region_of
from ..plan import Plan, Reading, plan_measure, require_kind
from ..quantities import is_number, label
from ..surroundings import Outline
from ..units import amount_or_float, show, shown_number, unit_sign
from ..vectors import FloatArray, Index, Side
from .designs import DesignValues, check_once
from .variants import ENDING, is_side, sided_step

MOST_COMBINATIONS = 100_000
NARROWEST = 1e-12
"""Of the size of its ends: a range that is no wider holds one value."""
FAR = 20.0
"""Times the largest length of a machine, or of the other ranges: a range that is wider was given in another unit."""
APART = 200.0
"""Times the largest length of a machine: a range that ends so far away, and leaves out today's value, was given in another unit."""


@record
class Around:
    """So far up and down from a dimension's present value; of a point `round`, so far in any direction."""

    by: float
    step: float | None = None
    is_round: bool = False


def around(by: float | None = None, step: float | None = None, *, radius: float | None = None) -> Around:
    """Return the range of so much up and down about the present value, of a point in both directions: `vary={"M": around(60 * mm)}`.

    `radius` in the place of it is a circle about where a point stands now: `around(radius=60 * mm)`.

    Parameters
    ----------
    by : float, optional
        The half range [SI].
    step : float, optional
        The step [SI].
    radius : float, optional
        The radius of a circle about a point [m].

    Returns
    -------
    Around
        The range.
    """
    if (by is None) == (radius is None) or (radius is not None and step is not None):
        raise DefinitionError("around: say how far, around(60 * mm), with or without a step, or a circle, around(radius=60 * mm).")
    by, is_round = (by, False) if radius is None else (radius, True)
    for value, what in ((by, "a distance or an angle"), (step, "a step")):
        if value is not None and (not is_number(value) or value <= 0.0):
            raise DefinitionError(f"around({cited(by)}{'' if step is None else f', {cited(step)}'}): {what} above zero is expected.")
    assert by is not None
    return Around(by, step, is_round)


TRIED = 1 << 15
"""Places of the box that are tried at the most for one inside a region."""


@record
class Varied:
    """A dimension that varies between two values [SI], in steps where `step` is given; `sign` that of its spelling."""

    name: str
    owner: str
    sign: float
    low: float
    high: float
    step: float | None
    unit: str

    @property
    def span(self) -> float:
        """High less low."""
        return self.high - self.low

    @property
    def steps(self) -> int:
        """How many steps the range has; one of a range without."""
        return 1 if self.step is None else int(np.floor(self.span / self.step + 1e-9)) + 1

    def stepped(self, value: float) -> tuple[float, ...]:
        """Return the one or two steps about a value."""
        if self.step is None:
            return (value,)
        place = (value - self.low) / self.step
        last = self.steps - 1
        near = {int(np.clip(part, 0, last)) for part in (np.floor(place + 1e-9), np.ceil(place - 1e-9))}
        return tuple(self.low + self.step * each for each in sorted(near))

    def show(self, value: float) -> str:
        """Return a value with its unit."""
        return show(value, self.unit)


@immutable
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
    def varies(self) -> bool:
        """Whether the point is one that a search places."""
        return self.places != (None, None)

    def positions(self, values: FloatArray) -> FloatArray:
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
    spellings, places = machine.plan.table.spellings, {each.owner: place for place, each in enumerate(variables)}
    if f"{point}.x" not in spellings or f"{point}.y" not in spellings:  # a point that moves, or that follows others
        return PointRegion(point, region, (None, None), (1.0, 1.0), (0.0, 0.0))
    (x, way), (y, other) = (spellings[f"{point}.{axis}"] for axis in "xy")
    signs = [sign * variables[places[owner]].sign if owner in places else 1.0 for owner, sign in ((x, way), (y, other))]
    fixed = way * float(machine.dimensions[x]), other * float(machine.dimensions[y])
    return PointRegion(point, region, (places.get(x), places.get(y)), (signs[0], signs[1]), fixed)


def places_inside(title: str, each: PointRegion, variables: Sequence[Varied], count: int, seed: int) -> FloatArray:
    """Return places in a region, evenly spread, (k, 2), as many as `count` if there are; DefinitionError for none."""
    low, high = (np.array(end) for end in each.region.bounding_box)
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
    ensure(len(found), f"{title}: regions={{{each.point!r}: ...}}: nothing of it lies in the ranges of vary=; widen one of them.")
    return found


@immutable
class Space:
    """The variables, and the choices: for each, the dimensions it sets and their rows; and the regions in which points may stand."""

    variables: tuple[Varied, ...]
    choices: tuple[tuple[tuple[tuple[str, float], ...], tuple[tuple[float, ...], ...]], ...]
    names: tuple[tuple[str, ...], ...]
    regions: tuple[PointRegion, ...] = ()

    @classmethod
    def of(cls, machine: Mechanism, vary: Any, regions: object = None) -> Space:
        """Return the space of `vary` and `regions`; DefinitionError for an unknown dimension, an empty range, or anything else."""
        title, spellings = machine.plan.title, machine.plan.table.spellings
        require(isinstance(vary, Mapping) and vary, f"{title}: vary", vary, 'a dictionary is expected, such as vary={"OB": (0.27, 0.33)}')
        variables: list[Varied] = []
        choices, names = [], []
        circles: dict[str, float] = {}
        about: list[str] = []
        for name, given in vary.items():
            parts = name if isinstance(name, tuple) else (name,)
            sided = [sided_step(machine, part) for part in parts]
            for part, step in zip(parts, sided, strict=True):
                if not step:
                    known_dimension(machine, part)
            about += coordinates(machine.plan, parts) if isinstance(given, Around) else []
            for part in parts if isinstance(given, Around) and given.is_round else ():
                expected = f"{part} is no fixed point that varies; write around(60 * mm) of a dimension"
                ensure(f"{part}.x" in spellings, f"{title}: {part}=around(radius=...): {expected}.")
                circles[part] = given.by
            if not any(sided) and (isinstance(given, Around) or (isinstance(given, tuple) and len(parts) == 1 and len(given) in (2, 3))):
                variables += ranged(machine, parts, given)
            else:
                spelled = [(part, 1.0) if is_side(part) else spellings[part] for part in coordinates(machine.plan, parts)]
                owners = tuple((owner, float(sign)) for owner, sign in spelled)
                rows = rows_of(title, parts, given, owners)
                choices.append((owners, tuple(tuple(map(float, row)) for row in rows)))
                for place, part in enumerate(coordinates(machine.plan, parts)):
                    require_kind(machine.plan, part, [row[place] for row in rows], f"{title}: vary: {part}")
                names.append(tuple(coordinates(machine.plan, parts)))
        check_unit_of_ranges(machine, variables, about)
        check_once(machine, {part: None for name in vary for part in (name if isinstance(name, tuple) else (name,))})
        found = cls(tuple(variables), tuple(choices), tuple(names), point_regions(machine, regions, circles, variables))
        if found.count > MOST_COMBINATIONS:
            raise DefinitionError(f"{title}: {found.count} combinations of choices are too many; {MOST_COMBINATIONS} are the most.")
        for owners, rows in found.choices:
            for row in rows:
                machine.replaced(**{owner: sign * value for (owner, sign), value in zip(owners, row, strict=True) if not is_side(owner)})
        for each in variables:
            for end in (each.low, each.high):
                machine.replaced(**{each.name: end})
        return found

    @property
    def conditions(self) -> list[Constraint]:
        """The regions as conditions."""
        return [least(inside_region(each.point, each.region)) >= 0.0 for each in self.regions]

    def drawn(self, unit: FloatArray, title: str, seed: int) -> FloatArray:
        """Return unit coordinates (m, n) of designs whose points stand in their regions: those outside are drawn anew, evenly over them.

        DefinitionError where a region and the ranges of the variables have no point in common.
        """
        if not self.regions:
            return unit
        found = np.array(self.values(unit))
        for number, each in enumerate(self.regions):
            out = np.flatnonzero(each.region.depths(each.positions(found)) < 0.0) if each.varies else np.zeros(0, int)
            if len(out):
                places = places_inside(title, each, self.variables, len(out), seed + number)
                each.put(found, out, places[np.arange(len(out)) % len(places)])
        return self.unit(found)

    def within(self, values: FloatArray) -> FloatArray:
        """Return unit coordinates of values (m, n), within 0 and 1, points at the nearest places of their regions."""
        found = np.array(values)
        for each in self.regions:
            if each.varies:
                each.put(found, slice(None), each.region.nearest(each.positions(found)))
        return self.unit(found)

    @property
    def count(self) -> int:
        """How many combinations of choices there are."""
        return prod(len(rows) for _, rows in self.choices)

    def combinations(self) -> Iterator[tuple[int, ...]]:
        """Yield every combination of choices, by the numbers of their rows."""
        return product(*(range(len(rows)) for _, rows in self.choices))

    def _set_by(self, combination: Sequence[int]) -> Iterator[tuple[str, float]]:
        """Yield the settings of a combination, dimensions [SI] by their owners and sides by their names."""
        for (owners, rows), row in zip(self.choices, combination, strict=True):
            for (owner, sign), value in zip(owners, rows[row], strict=True):
                yield owner, sign * value

    def chosen(self, combination: Sequence[int]) -> dict[str, float]:
        """Return the dimensions [SI] of a combination, by their owners."""
        return {owner: value for owner, value in self._set_by(combination) if not is_side(owner)}

    def sides(self, combination: Sequence[int]) -> dict[str, Side]:
        """Return the sides of steps in a combination, by the steps' names."""
        return {owner.removesuffix(ENDING): Side(int(value)) for owner, value in self._set_by(combination) if is_side(owner)}

    def words(self, combination: Sequence[int], plan: Plan) -> str:
        """Return a combination in words."""
        return ", ".join(
            f"{name} = {Side(int(value)) if is_side(name) else show(value, unit_of(plan, name))}"
            for names, (_, rows), row in zip(self.names, self.choices, combination, strict=True)
            for name, value in zip(names, rows[row], strict=True)
        )

    @cached_property
    def _lows_and_spans(self) -> FloatArray:
        return np.array([(each.low, each.span) for each in self.variables]).reshape(-1, 2).T

    def values(self, unit: FloatArray) -> FloatArray:
        """Return values (..., n) of the variables from unit coordinates (..., n)."""
        low, span = self._lows_and_spans
        return np.asarray(low + np.asarray(unit) * span)

    def unit(self, values: FloatArray) -> FloatArray:
        """Return unit coordinates of values (..., n), within 0 and 1."""
        low, span = self._lows_and_spans
        return np.asarray(np.clip((np.asarray(values) - low) / np.where(span > 0.0, span, 1.0), 0.0, 1.0))

    def dimensions_at(self, unit: FloatArray) -> DesignValues:
        """Return dimensions by owner from unit coordinates, (n,) or (m, n)."""
        values = self.values(unit)
        return {each.owner: each.sign * values[..., place] for place, each in enumerate(self.variables)}

    def present(self, machine: Mechanism) -> FloatArray:
        """Return the variables' present values (n,)."""
        return np.array([each.sign * float(machine.dimensions[each.owner]) for each in self.variables])


def known_dimension(machine: Mechanism, name: object) -> None:
    """Raise DefinitionError for anything but a dimension of a machine."""
    if not isinstance(name, str):
        raise unknown("Dimension", name, machine.plan.table.names(), where=machine.plan.title)
    title = machine.plan.title
    if name in machine.plan.strokes:
        raise DefinitionError(f"{title}: {name} is a stroke and no dimension; say over={{{name!r}: (low, high)}} for its range.")
    element, _, parameter = name.partition(".")
    member = machine.plan.members.get(element)
    if name not in machine and isinstance(member, ForceElement) and parameter in member.parameters:
        what = member.given(parameter)
        if what is not None:
            raise DefinitionError(f"{title}: {name} follows {label(what)}; vary what it follows.")
    _ = machine[name]  # raises for a name that is none, or that follows others


def coordinates(plan: Plan, names: Sequence[str]) -> list[str]:
    """Return names, those of points by their two coordinates."""
    return [part for name in names for part in ([name] if name in plan.table.spellings or is_side(name) else [f"{name}.x", f"{name}.y"])]


def ranged(machine: Mechanism, names: Sequence[str], given: Around | tuple[Any, ...]) -> list[Varied]:
    """Return the variables of a range; DefinitionError for anything else."""
    plan, found = machine.plan, []
    for name in coordinates(plan, names):
        owner, sign = plan.table.spellings[name]
        require_kind(plan, name, [given.by, given.step] if isinstance(given, Around) else given, f"{plan.title}: vary: {name}")
        if isinstance(given, Around):
            now = float(sign * machine.dimensions[owner])
            low, high, step = now - given.by, now + given.by, given.step
        elif name not in names:
            said = f'write around(60 * mm), or ranges of its coordinates, "{name}": (low, high)'
            raise DefinitionError(f"{plan.title}: {names[0]}={cited(given)}: {names[0]} is a point; {said}, or a list of positions.")
        else:
            low, high, step = (*given, None)[:3]
        ends, what = (low, high) if step is None else (low, high, step), f"{plan.title}: {name}"
        are_numbers = all(map(is_number, ends))
        is_wide = not are_numbers or high - low > max(NARROWEST * max(abs(low), abs(high)), 1e-30)
        require(is_wide, what, given, "is no range; a range goes from its lower to its higher end; for one value set it")
        said = "write (low, high) or (low, high, step) in SI, the step above zero and within them, a list of choices, or around(...)"
        require(are_numbers and (step is None or 0.0 < step <= high - low), what, given, f"is no range; {said}")
        found.append(Varied(name, owner, float(sign), float(low), float(high), None if step is None else float(step), unit_of(plan, name)))
    return found


def check_unit_of_ranges(machine: Mechanism, variables: Sequence[Varied], about: Collection[str]) -> None:
    """Raise DefinitionError for a range of lengths that is far wider than the machine and the other ranges of its lengths.

    A range `about` a present value has no size to compare, nor has a range of coordinates, which may be any about zero.
    """
    plan, size = machine.plan, size_of_machine(machine)
    lengths = [each for each in variables if plan_measure(plan, each.owner) == "length"]
    free = [each for each in lengths if each.name not in about and plan.table.entries[each.owner].kind != "coordinate"]
    sizes = {each.name: each.high for each in free if each.low >= 0.0}
    for each in lengths:
        others = [high for name, high in sizes.items() if name != each.name]
        now, far = each.sign * float(machine.dimensions[each.owner]), max(abs(each.low), abs(each.high))
        if each.high - each.low > FAR * max(size, median(others) if len(others) > 1 else 0.0) or (
            far > APART * size and not each.low <= now <= each.high
        ):
            wide = f"{each.name} would range from {each.low:.6g} to {each.high:.6g} m, far more than the machine is large"
            raise DefinitionError(f"{plan.title}: {wide}; lengths are in m, write 60 * mm if these are millimetres.")


def size_of_machine(machine: Mechanism) -> float:
    """Return the largest length or coordinate of a machine [m]."""
    lengths = [name for name in machine.dimensions if plan_measure(machine.plan, name) == "length"]
    return max((abs(float(machine.dimensions[name])) for name in lengths), default=1.0) or 1.0


def rows_of(title: str, names: Sequence[str], given: object, owners: Sequence[tuple[str, float]]) -> tuple[tuple[float, ...], ...]:
    """Return the rows of choices, a side as its number; DefinitionError for anything else."""
    width, what = len(owners), f"{title}: {', '.join(names)}"
    said = "write a range (low, high), a list of choices such as [0.28, 0.30], or for several names at once a list of rows"
    listed: Any = given
    require(isinstance(given, (list, tuple, range, np.ndarray)) and len(given) > 0, what, given, said)
    rows = []
    for each in listed:
        row = list(each) if isinstance(each, (list, tuple, np.ndarray)) else [each]
        for place, (owner, _) in enumerate(owners if len(row) == width else ()):
            if is_side(owner):
                side = Side.parse(row[place])
                ensure(side is not None, f"{owner}: {cited(row[place])} is no side; write a list of them, [LEFT, RIGHT].")
                row[place] = side
        many = f"{width} numbers are" if width > 1 else "a number is"
        ensure(len(row) == width and all(is_number(value) for value in row), f"{what}: {cited(each)} is no choice; {many} expected.")
        rows.append(tuple(row))
    return tuple(rows)


# A box of settings: ranges of dimensions, and places to choose from.


@immutable
class Box:
    """Settings to look at: ranges of values, times choices.

    Parameters
    ----------
    ranges : mapping of str to tuple of float
        From low to high [SI] by name.
    choices : sequence of mapping, optional
        Each a mapping of names to values; one without names by default.
    """

    ranges: Mapping[str, tuple[float, float]]
    choices: Sequence[Mapping[str, Any]] = ({},)

    @classmethod
    def of(cls, machine: Mechanism, vary: Mapping[str, Any]) -> Box:
        """Return the box that `dict(MK=(0.80, 0.96), M=[(0.22, 1.05), (0.22, 0.95)])` means.

        Parameters
        ----------
        machine : Mechanism
            The machine.
        vary : mapping of str to object
            By name a pair, which is a range, or a list of choices [SI].

        Returns
        -------
        Box
            The settings.

        Raises
        ------
        DefinitionError
            A dimension is not known, a range is the wrong way round, or it is anything else.
        """
        require_mechanism(machine)
        if not isinstance(vary, Mapping):
            raise unfit(f"{machine.plan.title}: vary", vary, "a dictionary of ranges and choices by name is expected")
        for name in vary:
            if not isinstance(name, str):
                raise unknown("Dimension", name, machine.plan.table.names(), where=machine.plan.title)
        ranges = {name: range_of(name, value) for name, value in vary.items() if isinstance(value, tuple)}
        lists = {name: value for name, value in vary.items() if name not in ranges}
        for name, given in lists.items():
            expected = "write a range (low, high) or a list of choices such as [(0.22, 1.05), (0.22, 0.95)]"
            require(isinstance(given, (list, range)) and given, name, given, expected)
            for each in given:
                what = f"{name}: {cited(each)} is no choice; write a number, or the two coordinates (x, y) of a point."
                ensure(is_number(each) or is_pair(each), what)
        box = cls(ranges, [dict(zip(lists, each, strict=True)) for each in product(*lists.values())])
        for settings in (*box.choices, *({name: end} for name, pair in ranges.items() for end in pair)):
            machine.replaced(**settings)
        check_once(machine, vary)
        return box

    def settings(self, unit: FloatArray, choice: Index) -> DesignValues:
        """Return settings by name, from coordinates in parts of the ranges.

        Parameters
        ----------
        unit : array (m, k)
            The coordinates between 0 and 1.
        choice : array of int (m,)
            The number of the choice.

        Returns
        -------
        mapping of str to array (m,)
            The settings [SI].
        """
        low, high = np.array([*self.ranges.values()], float).reshape(-1, 2).T
        values = np.where(unit == 1.0, high, low + unit * (high - low))  # the far end to its last digit
        found: DesignValues = dict(zip(self.ranges, values.T, strict=True))
        for name in self.choices[0]:
            table = np.array([each[name] for each in self.choices], float)[np.asarray(choice)]
            found[name] = tuple(table.T) if table.ndim == 2 else table
        return found

    def sample(self, count: int, *, method: str = "sobol", seed: int = 0) -> DesignValues:
        """Return settings by name, spread evenly over the ranges and choices: the designs of a survey. They are the same for the same seed.

        Parameters
        ----------
        count : int
            How many; a Sobol sequence is evenest for a power of two.
        method : {"sobol", "latin", "random"}, optional
            A scrambled Sobol sequence, the default, a Latin hypercube, or pseudo-random numbers.
        seed : int, optional
            The seed, 0 by default.

        Returns
        -------
        mapping of str to array (count,)
            The settings [SI].
        """
        many = len(self.choices) > 1
        unit = unit_points(count, len(self.ranges) + many, method, seed)
        choice = (unit[:, -1] * len(self.choices)).astype(int) if many else np.zeros(count, int)
        return self.settings(unit[:, : len(self.ranges)], choice)


def setting_words(plan: Plan, settings: Mapping[str, Any], place: int) -> str:
    """Return one of some settings (m,) in words: `MK = 800 mm, M = (220, 950) mm`; a point's is a pair."""
    words = []
    for name, value in settings.items():
        if isinstance(value, tuple):
            words.append(f"{name} = ({', '.join(shown_number(float(part[place]), 'mm') for part in value)}) {unit_sign('mm')}")
        else:
            words.append(f"{name} = {show(float(value[place]), unit_of(plan, name))}")
    return ", ".join(words)


def range_of(name: str, given: object) -> tuple[float, float]:
    """Return a range; DefinitionError unless it is (low, high)."""
    if not is_pair(given) or given[0] > given[1]:
        raise unfit(name, given, "is no range; write (low, high) in SI, or a list [first, second] of choices")
    return amount_or_float(given[0]), amount_or_float(given[1])


def is_pair(given: object) -> TypeGuard[Sequence[float]]:
    """Return whether something is two numbers."""
    return is_listed(given) and len(given) == 2 and all(map(is_number, given))


MOST_SETTINGS = 1 << 30
"""Designs of one sample."""

METHODS = ("sobol", "latin", "random")


def unit_points(count: int, k: int, method: str, seed: int) -> FloatArray:
    """Return points (count, k) spread evenly over [0, 1), the same for the same seed.

    By a scrambled Sobol sequence, evenest where count is a power of two, a Latin hypercube, or pseudo-random numbers.
    """
    require_whole("count", count, "a whole number of designs is expected, at least 1", least=1)
    require(count <= MOST_SETTINGS, "count", count, "so many designs do not fit into memory; ask for fewer")
    one_word("method", method, METHODS)
    require_whole("seed", seed, "a whole number is expected, at least 0", least=0)
    if not k:
        return np.empty((count, 0))
    from scipy.stats import qmc

    random = np.random.default_rng(seed)
    if method == "random":
        return np.asarray(random.random((k, count)).T)
    if method == "latin":  # every coordinate has one point in each of count equal intervals
        return np.asarray(qmc.LatinHypercube(k, seed=random).random(count))
    engine: Any = qmc.Sobol(k, seed=random)
    power = int(count).bit_length() - 1
    return np.concatenate([engine.random_base2(power), engine.random(int(count) - (1 << power))])


# Checks of a study's machine, and of its dimensions.


def unit_of(plan: Plan, name: str) -> str:
    """Return the unit a dimension is shown in: its own, mm for lengths, deg for angles, "" where nothing says, as of a side."""
    if is_side(name):
        return ""
    found = plan.table.entries[plan.table.spellings[name][0]]
    return found.unit or {"length": "mm", "coordinate": "mm", "angle": "deg"}.get(found.kind, "")


def check_one_design(machine: Mechanism) -> None:
    """Raise DefinitionError for a batch of designs, and for anything but a mechanism."""
    require_one_design(require_mechanism(machine).dimensions, f"{type(machine).__name__}: a study starts from one design")


def check_in_count(title: str, what: str, number: object, count: int) -> None:
    """Raise DefinitionError for anything but the number of one of some designs or curves, from 0 on."""
    fits = is_whole(number) and 0 <= number < count
    ensure(fits, f"{title}: there is no {what} {cited(number)}; numbers go from 0 to {count - 1}.")


def check_vary(machine: Mechanism, what: str, over: object) -> None:
    """Raise DefinitionError where the designs of a study, or strokes, are given as `over`."""
    if over is None:
        return
    remedy = "name its strokes, such as S=[0.0, 0.1]" if what == "zone" else "let measure(machine) say at which strokes it looks"
    expected = f"a {what} varies designs, vary=, and has no over=; {remedy}"
    if isinstance(over, Mapping) and any(name in machine for name in over):
        expected = "dimensions are varied by vary=, strokes run by over=; write vary="
    raise unfit(f"{machine.plan.title}: {what}(over", over, expected)


WHOLE_POSES = {1: 101, 2: 25, 3: 13, 4: 8, 5: 6, 6: 5}
"""Poses of each stroke at which a machine is looked at that is to be assembled over all of them."""


def why_not_assembled(machine: Mechanism) -> str:
    """Return why a machine cannot be assembled over the box of its whole strokes, in one line; "" for one that can."""
    count = WHOLE_POSES.get(len(machine.strokes), 3)
    axes = [np.linspace(each.start, each.end, count) for each in machine.strokes.values()]
    try:
        at: dict[str, Any] = dict(zip(machine.strokes, np.meshgrid(*axes, indexing="ij"), strict=True))
        machine.at(**at)
    except AssemblyError as error:
        return " ".join(str(error).split())
    return ""
