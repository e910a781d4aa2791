"""A search's problem: the measures of designs over their stroke, with exact derivatives, as numbers that a solver takes.

The stroke is looked at at samples, each of which is one smooth row of the problem: `least(q) >= 2` is `q - 2 >= 0` at each of them.
Where the worst pose of a solution lies between the samples it is added to them (an exchange method for semi-infinite programs).
Source: R. Hettich, K. O. Kortanek, Semi-infinite programming, SIAM Review 35 (1993) 380-429.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from functools import cached_property
from math import prod
from typing import Any, TypeAlias

import numpy as np

from ..errors import DefinitionError, StudyError, cited, ensure, is_listed, known_name, require_type, unwarned
from ..frozen import immutable
from ..mechanism import Mechanism
from ..motion import Constraint, Grid, Leaf, Measure, Motion, Over, Request
from ..motion.grid import JoinedTo, joined_in_order, varies
from ..motion.judge import Domain, SearchRow
from ..motion.measures import At, CombinedMeasure, FixedNumber, Integral, Least, Most, Worst, check_kinds, strokes_behind, traced, words_of
from ..motion.strokes import check_magnitude
from ..numeric.quadrature import PANELS, Quadrature, gauss, quadrature
from ..plan import Mask, require_kind
from ..program import Enclosure, FloatArray, Node, enclosures
from ..quantities import Quantity, is_number
from ..vectors import Numbers
from .checkpoint import measure_text
from .designs import DesignValues
from .measured import Samples, Sampling, divisors_of, with_values
from .space import Space
from .variants import Range, on_sides, variant

SAMPLES = {0: 1, 1: 49, 2: 17, 3: 9, 4: 5}
COARSE = {0: 1, 1: 17, 2: 7, 3: 5, 4: 3}
NEAR_TOP, TOPS, ZOOMS = 0.05, 6, 7
"""Of the range of a leaf's values: tops that come so near to the worst are samples too; how many of them, and how often they are zoomed."""
CLOSEST = 1e-6
"""Samples are not nearer to one another, in parts of the range."""
EXACT = 1e-6
"""Of the size of a condition's terms: numbers that are smaller do not measure it, their last digits would."""
ON_THE_WAY = 33
"""Poses on the way to a single one, from where the ranges begin: an angle is continued along them."""
INNER = 65
"""Samples of the stroke over which the worst value is taken."""


ARGUMENTS = ("machine", "objectives", "constraints", "space", "sense", "over", "counts", "count")
"""What a problem is made of; its count is not sent to other processes."""
NOWHERE = Space((), (), ())
"""A space without variables: that of one design."""

End: TypeAlias = tuple[FloatArray, FloatArray | None]
"""An end of a stroke's range: a number (), or values (m,) that follow the design, with derivatives (p,) by the owners."""
Ends: TypeAlias = Mapping[str, Sequence[End]]
"""Both ends of each stroke's range."""


def end_words(end: object) -> float | str:
    """Return an end of a range as it is shown: a number, or a quantity in words."""
    return end if is_number(end) else words_of(end)


def is_still(one: Range) -> bool:
    """Return whether a stroke is held at one value."""
    return is_number(one.low) and bool(one.low == one.high)


def ranges_of(machine: Mechanism, over: object) -> dict[str, Range]:
    """Return the part of each stroke that is looked at; DefinitionError for anything else."""
    title, plan = machine.plan.title, machine.plan
    example = 'a dictionary is expected, such as over={"S": (0.0, 0.2)}'
    given = require_type(f"{title}: over", {} if over is None else over, Mapping, example)
    for name, ends in given.items():
        known_name("Stroke", name, plan.strokes, where=f"{title}: over")
        if isinstance(ends, Range):
            continue
        require_kind(plan, name, ends, f"{title}: over: {name}")
        if is_number(ends):
            continue
        if not is_listed(ends) or len(ends) != 2:
            raise DefinitionError(f"{title}: over={{{name!r}: {cited(ends)}}}: (low, high) or one value is expected, in SI.")
        for end in ends:
            if not is_number(end) and strokes_behind(plan, end):
                raise DefinitionError(f"{title}: over={{{name!r}: ...}}: {words_of(end)} depends on a stroke itself.")
    found = {}
    for name, stroke in plan.strokes.items():
        ends = given.get(name, (stroke.start, stroke.end))
        pair = (float(ends), float(ends)) if is_number(ends) else ends
        found[name] = ends if isinstance(ends, Range) else Range(*pair)
    return found


@dataclass(eq=False)
class PoseSet:
    """Poses at which some quantities are looked at: the parts of each stroke's range (0 to 1) along the axes, or single poses.

    `singles` are the strokes [SI] of single poses, all of which are looked at together; `weights` are an integral's; `inner` names a last
    axis over which the worst is taken.
    """

    axes: dict[str, FloatArray]
    singles: list[Mapping[str, float]] = field(default_factory=list)
    weights: FloatArray | None = None
    inner: str = ""
    quantities: dict[object, object] = field(default_factory=dict)
    alone: bool = False
    """Whether its single pose is kept apart from others."""

    def __post_init__(self) -> None:
        if self.inner:
            self.axes[self.inner] = np.linspace(0.0, 1.0, INNER)

    def place(self, quantity: object) -> int:
        """Return the number of a quantity, entered where it is new."""
        key = quantity if isinstance(quantity, str) else id(quantity)
        self.quantities.setdefault(key, quantity)
        return [*self.quantities].index(key)

    @property
    def parts(self) -> dict[str, FloatArray]:
        """The part of each stroke's range at every pose, in the shape of the axes; those of no axis are single poses."""
        return dict(zip(self.axes, np.meshgrid(*self.axes.values(), indexing="ij"), strict=True))

    @property
    def outer(self) -> list[str]:
        """The strokes of the axes, but for the last one over which the worst is taken."""
        return [name for name in self.axes if name != self.inner]

    def copied(self, counts: Mapping[int, int] | None) -> PoseSet:
        """Return the same poses, whose axes may change apart from these; with `counts` as they are before any is added."""
        axes, weights = dict(self.axes), self.weights
        if counts is not None:
            places = np.linspace(0.0, 1.0, counts.get(len(self.outer), 3))
            if weights is not None:
                places, weights = gauss(np.linspace(0.0, 1.0, PANELS + 1))
            axes = dict.fromkeys(self.outer, places)
        return replace(self, axes=axes, weights=weights)


@immutable
class Rows:
    """A leaf at its poses: values (m, n), of one design derivatives (p, n), and of which designs (m,) it is lost: without a value."""

    values: FloatArray
    slopes: FloatArray
    lost: Mask


class LeafNumbers(dict[Leaf, float]):
    """The leaves' numbers of one design; `lost` are those that have no value at a pose.

    `parts` say of extremes that are looked for between the poses where they are, in parts (0 to 1) of the strokes' ranges.
    """

    def __init__(self, numbers: Mapping[Leaf, float], lost: Iterable[Leaf] = ()) -> None:
        super().__init__(numbers)
        self.lost = {*lost}
        self.parts: dict[Leaf, Mapping[str, float]] = {}


@immutable
class Evaluated:
    """One design or several looked at: the rows of each leaf, margins (m, r), whether all is reached (m,); of one also derivatives."""

    rows: Mapping[Leaf, Rows]
    margins: FloatArray
    margin_slopes: FloatArray
    is_assembled: Mask
    reached: FloatArray

    @cached_property
    def numbers(self) -> dict[Leaf, FloatArray]:
        """The leaves' numbers (m,) at the samples; rows without a value say nothing, NaN where none has one."""
        found = {}
        with np.errstate(all="ignore"):
            for leaf, rows in self.rows.items():
                best = np.fmin if leaf.sense < 0.0 else np.fmax
                found[leaf] = np.asarray(best.reduce(rows.values, axis=1) if leaf.sense else rows.values[:, 0])
        return found

    @property
    def of_one(self) -> LeafNumbers:
        """The leaves' numbers of one design at the samples."""
        numbers = {leaf: float(values[0]) for leaf, values in self.numbers.items()}
        return LeafNumbers(numbers, [leaf for leaf, rows in self.rows.items() if rows.lost[0]])

    @property
    def leaf_sizes(self) -> dict[Leaf, float]:
        """The size of the largest of each leaf's values; zero where none has one."""
        known = {leaf: rows.values[np.isfinite(rows.values)] for leaf, rows in self.rows.items()}
        return {leaf: float(np.abs(values).max(initial=0.0)) for leaf, values in known.items()}

    def values_of(self, measure: Measure) -> FloatArray:
        """Return a measure of designs (m,) [SI], NaN where it has no value or a design is not assembled."""
        with np.errstate(all="ignore"):
            return np.where(self.lost_of(measure) | ~self.is_assembled, np.nan, measure.from_leaves(self.numbers.__getitem__))

    def lost_of(self, measure: Measure) -> Mask:
        """Return of which designs (m,) a leaf of a measure is lost."""
        return np.asarray(np.any([self.rows[leaf].lost for leaf in measure.leaves], axis=0))


class LimitReachedError(StudyError):
    """A search has looked at as many designs as it may."""


@dataclass(eq=False)
class Count:
    """How many designs a search and its parts have looked at, each look at one counted, and how many they may, None for any number."""

    designs: int = 0
    limit: int | None = None

    @property
    def is_spent(self) -> bool:
        """Whether no more designs may be looked at."""
        return self.limit is not None and self.designs >= self.limit

    def add(self, designs: int) -> None:
        """Count designs that are about to be looked at; LimitReachedError where there may be no more. The last ones may go beyond."""
        if self.is_spent:
            raise LimitReachedError(f"The limit of {self.limit} designs is reached.")
        self.designs += designs

    @contextmanager
    def without_limit(self, most: int | None = None) -> Iterator[None]:
        """Look at designs whatever the limit, as at the best one in the end; or at so many more at the `most`."""
        kept, self.limit = self.limit, None if most is None else self.designs + max(most, 1)
        try:
            yield
        finally:
            self.limit = kept


class Problem:
    """An objective to minimise, under constraints, over the designs in a space."""

    def __init__(
        self,
        machine: Mechanism,
        objectives: Sequence[Measure],
        constraints: Sequence[Constraint],
        space: Space,
        sense: float = 1.0,
        over: Mapping[str, Any] | None = None,
        counts: Mapping[int, int] = SAMPLES,
        count: Count | None = None,
    ) -> None:
        self.machine, self.plan, self.space, self.sense, self.over = machine, machine.plan, space, sense, over
        self.objectives, self.constraints = tuple(objectives), tuple(constraints)
        self.ranges = ranges_of(machine, over)
        self.counts = counts
        self.count = count or Count()
        self.leaves = tuple(dict.fromkeys(leaf for each in (*objectives, *(one.margin for one in constraints)) for leaf in each.leaves))
        check_kinds(self.plan, self.objectives, self.constraints)
        self.sets: list[PoseSet] = []
        self._of_leaf: dict[Leaf, tuple[PoseSet, int, int]] = {}
        """Where a leaf's values are: its poses, the number of its quantity there, and that of its single pose, -1 where it has all."""
        moving = tuple(name for name, one in self.ranges.items() if not is_still(one))
        for leaf in self.leaves:
            poses, single = self._poses(leaf, moving)
            self._of_leaf[leaf] = poses, poses.place(leaf.bare_quantity), single
        self.full_stroke = self._set(moving)
        self.owners = tuple(dict.fromkeys(each.owner for each in space.variables))
        self._samplings: dict[PoseSet, Sampling] = {}
        self._sizes: list[float] | None = None
        self._branches: dict[str, Problem] = {}
        self.refusal = ""
        """Why the latest design that was refused was so."""

    @property
    def poses(self) -> int:
        """At how many poses a design is looked at."""
        return sum(prod(map(len, each.axes.values())) * max(len(each.singles), 1) for each in self.sets)

    def changed(self, **other: object) -> Problem:
        """Return the same problem with some of its arguments changed, with samples of its own; it shares the count of designs."""
        return Problem(**{name: getattr(self, name) for name in ARGUMENTS} | other)

    def sampled_apart(self, counts: Mapping[int, int] | None = None, *, counted: bool = True) -> Problem:
        """Return the same problem with samples of its own, those of now or, with `counts`, as at first; its designs are counted with these.

        They are not where they are no part of the search.
        """
        found, own = object.__new__(Problem), {each: each.copied(counts) for each in self.sets}
        vars(found).update(vars(self))
        found.counts, found.sets, found.full_stroke = counts or self.counts, [*own.values()], own[self.full_stroke]
        found._of_leaf = {leaf: (own[poses], place, single) for leaf, (poses, place, single) in self._of_leaf.items()}
        found._samplings = {own[poses]: each for poses, each in self._samplings.items()}
        found._sizes, found._branches, found.refusal = None, {}, ""
        found.count = self.count if counted else Count()
        return found

    def on_branch(self, combination: Sequence[int]) -> Problem:
        """Return the problem of the machine whose steps are on the sides of a combination: itself where none is chosen."""
        sides = self.space.sides(combination)
        machine = on_sides(self.machine, sides) if sides else self.machine
        if machine is self.machine:
            return self
        known = self._branches.get(machine.plan.key)
        if known is None:
            known = self._branches[machine.plan.key] = self.changed(machine=machine)
        return known

    def __reduce__(self) -> tuple[object, ...]:
        """Return the state for pickle: the arguments of the problem, without its samples."""
        return Problem, tuple(getattr(self, name) for name in ARGUMENTS[:-1])

    @property
    def facts(self) -> str:
        """The identity of a search, as text."""
        said = [self.plan.title, self.plan, self.sense, *self.objectives, *self.constraints, self.space.variables, self.space.choices]
        ends = [(name, end_words(one.low), end_words(one.high)) for name, one in self.ranges.items()]
        exact = [repr(each) for one in (*self.objectives, *(held.margin for held in self.constraints)) for each in one.numbers]
        return "; ".join(map(str, [*said, *exact, ends, sorted(self.machine.dimensions.items())]))

    def function_texts(self) -> list[str]:
        """Return the source texts of the functions of a motion in the problem; DefinitionError for one without, such as a lambda."""
        asked = [leaf.bare_quantity for leaf in self.leaves]
        try:
            return [measure_text(each) for each in asked if callable(each) and not isinstance(each, (Quantity, Request))]
        except DefinitionError as error:
            text = "a folder cannot tell a function without source text, such as a lambda, from another one; define it by `def` in a file"
            raise DefinitionError(f"{self.plan.title}: folder=: {text}.") from error

    def value(self, numbers: Callable[[Leaf], object]) -> Any:
        """Return the objective from the leaves' numbers: of several the worst."""
        found = [each.from_leaves(numbers) for each in self.objectives]
        return found[0] if len(found) == 1 else (np.maximum if self.sense > 0.0 else np.minimum).reduce(found)

    # -- the poses ---------------------------------------------------------------------------------------

    def _poses(self, leaf: Leaf, moving: Sequence[str]) -> tuple[PoseSet, int]:
        """Return the poses of a leaf, shared with others that are looked at at the same, and which single one it is, -1 for all."""
        title, inner, strokes = self.plan.title, leaf.worst_over, ", ".join(self.plan.strokes)
        if isinstance(leaf.quantity, Worst):
            known_name("Stroke", leaf.quantity.over, self.plan.strokes, where=f"{title}: {leaf.quantity}")
        depends = strokes_behind(self.plan, leaf.bare_quantity)
        axes = tuple(name for name in moving if name in depends and name != inner)
        if isinstance(leaf, At):
            return self._single(leaf, depends, inner)
        if isinstance(leaf, Integral):
            by = leaf.by or (axes[0] if len(axes) == 1 else "")
            ensure(by in self.plan.strokes, f"{title}: {leaf}: say by which stroke, by= one of {strokes}.")
            others = [name for name in axes if name != by]
            ensure(not others, f"{title}: {leaf} depends on {', '.join(others)} too: hold it by over={{...}}, or take worst(...).")
            return self._set((by,), inner, integral=True), -1
        if not axes and not inner:
            return self._single(At(leaf.quantity, {}), (), inner)
        return self._set(axes, inner), -1

    def _single(self, leaf: At, depends: Sequence[str], inner: str) -> tuple[PoseSet, int]:
        """Return the poses of a value at one pose, and the number of that.

        Quantities of the program are looked at together at all single poses. A function of a motion has its pose for itself: it may do
        with several what it will.
        """
        for name, value in leaf.strokes.items():
            known_name("Stroke", name, self.plan.strokes, where=f"{self.plan.title}: {leaf}")
            check_magnitude(name, (float(value), float(value)), self.plan)
        held = {name: float(one.low) for name, one in self.ranges.items() if is_still(one)}
        missing = [name for name in depends if name not in leaf.strokes and name not in held and name != inner]
        ensure(not missing, f"{self.plan.title}: {leaf}: say the pose, {', '.join(f'{name}=...' for name in missing)}.")
        fixed = held | {name: float(value) for name, value in leaf.strokes.items()}
        alone = bool(inner) or traced(self.plan, leaf.quantity) is None
        for each in self.sets:
            if each.singles and each.inner == inner and each.alone is alone and (not alone or each.singles == [fixed]):
                if fixed not in each.singles:
                    each.singles.append(fixed)
                return each, -1 if inner else each.singles.index(fixed)
        self.sets.append(PoseSet({}, [fixed], inner=inner, alone=alone))
        return self.sets[-1], -1 if inner else 0

    def _set(self, names: Sequence[str], inner: str = "", *, integral: bool = False) -> PoseSet:
        """Return the poses over some strokes."""
        wanted = {*names, *([inner] if inner else [])}
        for each in self.sets:
            if each.axes.keys() == wanted and each.inner == inner and (each.weights is not None) == integral and not each.singles:
                return each
        none = np.zeros(0)
        self.sets.append(PoseSet(dict.fromkeys(names, none), weights=none if integral else None, inner=inner).copied(self.counts))
        return self.sets[-1]

    # -- looking -----------------------------------------------------------------------------------------

    def dimensions_at(self, unit: FloatArray, combination: Sequence[int]) -> DesignValues:
        """Return all dimensions of designs by unit coordinates (n,) or (m, n) and a combination of choices."""
        return with_values(self.machine.dimensions, self.space.chosen(combination) | self.space.dimensions_at(unit))

    def evaluated(self, designs: Mapping[str, Numbers], *, slopes: bool = False) -> Evaluated:
        """Return the values of designs, of a single one with derivatives by the unit coordinates.

        A design that is refused, for a charge below the gas's as an example, counts as one that cannot be assembled; `refusal` says
        why. What is refused of the machine as it is set too is a mistake in the question.
        """
        m = max((np.size(value) for value in designs.values() if varies(value)), default=1)
        self.count.add(m)
        try:
            return self._look(designs, m, slopes=slopes)
        except DefinitionError as error:
            if not self._can_be_asked:
                raise
            self.refusal = str(error)
        if m == 1:  # a design that is refused has no values, at as many rows as the machine as it is set
            own, none = self._look(self.machine.dimensions, 1, slopes=slopes), np.zeros(1, bool)
            rows = {leaf: Rows(np.full_like(each.values, np.nan), np.zeros_like(each.slopes), none) for leaf, each in own.rows.items()}
            return Evaluated(rows, np.zeros((1, 0)), own.margin_slopes[:, :0], none, np.zeros(1))
        self.count.designs -= m
        with self.count.without_limit():
            each_of = [{name: float(np.ravel(value)[k]) if np.ndim(value) else value for name, value in designs.items()} for k in range(m)]
            parts = [self.evaluated(design) for design in each_of]
        whole, reached = (np.concatenate([getattr(each, name) for each in parts]) for name in ("is_assembled", "reached"))
        of_leaves = {leaf: zip(*(vars(each.rows[leaf]).values() for each in parts), strict=True) for leaf in self.leaves}
        rows = {leaf: Rows(*map(np.concatenate, each)) for leaf, each in of_leaves.items()}
        return Evaluated(rows, np.zeros((m, 0)), np.zeros((0, 0)), whole, reached)

    @cached_property
    def _can_be_asked(self) -> bool:
        """Whether all measures have a value for the machine as it is set."""
        try:
            self._look(self.machine.dimensions, 1, slopes=False)
        except DefinitionError:
            return False
        return True

    def _look(self, designs: Mapping[str, Numbers], m: int, *, slopes: bool) -> Evaluated:
        """Return the values of m designs; DefinitionError where one of them is refused."""
        ends = self._ends(designs, slopes=slopes)
        whole, reached, margins, margin_slopes = np.ones(m, bool), np.ones(m), np.zeros((m, 0)), np.zeros((0, 0))
        found: dict[PoseSet, Samples] = {}
        for poses in self.sets:
            judged = slopes and poses is self.full_stroke
            samples = found[poses] = self._sampling(poses).at(self._grid(poses, designs, ends), margins=judged, slopes=slopes)
            whole &= samples.reached.all(axis=1)
            reached = reached if whole.all() else np.minimum(reached, samples.reached.mean(axis=1))
            if judged and samples.margin_slopes is not None:
                margins = np.moveaxis(samples.margins, 0, 1).reshape(m, samples.margins.shape[0] * samples.margins.shape[2])
                total = np.moveaxis(self._by_unit(samples.margin_slopes, poses, ends), 1, 0)
                margin_slopes = total.reshape(len(total), prod(total.shape[1:]))  # of no variable too
            if samples.value_slopes is not None:
                found[poses] = replace(samples, value_slopes=self._by_unit(samples.value_slopes, poses, ends))
        rows = {leaf: self._rows(leaf, found, ends) for leaf in self.leaves}
        return Evaluated(rows, margins, margin_slopes, whole, reached)

    def _sampling(self, poses: PoseSet) -> Sampling:
        if poses not in self._samplings:
            strokes = tuple(name for name in poses.axes if self.ranges[name].follows)
            self._samplings[poses] = Sampling(self.plan, [*poses.quantities.values()], (*self.owners, *strokes))
        return self._samplings[poses]

    @cached_property
    def _samplings_of_ends(self) -> dict[object, Sampling]:
        ends = dict.fromkeys(end for one in self.ranges.values() for end in one.follows)
        return {end: Sampling(self.plan, [end], self.owners) for end in ends}

    def _ends(self, designs: Mapping[str, Numbers], *, slopes: bool = False) -> Ends:
        """Return the two ends of each stroke's range."""
        known: dict[object, End] = {}
        strokes = {name: np.asarray(stroke.start, float) for name, stroke in self.plan.strokes.items()}
        for end, sampling in self._samplings_of_ends.items():
            samples = sampling.at(Grid(self.plan, designs, strokes), slopes=slopes)
            values = samples.values[0, :, 0]
            ensure(np.isfinite(values).all(), f"{self.plan.title}: over=: {words_of(end)} has no value of some designs.")
            known[end] = values, (None if samples.value_slopes is None else samples.value_slopes[0, :, 0])
        return {
            name: [(np.asarray(end, float), None) if is_number(end) else known[end] for end in (one.low, one.high)]
            for name, one in self.ranges.items()
        }

    def _grid(self, poses: PoseSet, designs: Mapping[str, Numbers], ends: Ends) -> Grid:
        """Return a pose set's grid."""
        follows = any(self.ranges[name].follows for name in poses.axes)
        parts = poses.parts
        shape = tuple(map(len, poses.axes.values())) or (len(poses.singles) or 1,)
        strokes = {}
        batch = np.shape(next((value for value in designs.values() if varies(value)), 0.0))
        for name, stroke in self.plan.strokes.items():
            one = self.ranges[name]
            if name in parts:
                low, high = (end.reshape(-1, *(1,) * len(shape)) if batch and end.ndim else end.reshape(()) for end, _ in ends[name])
                value = low + parts[name] * (high - low)
            else:
                rest = one.low if is_number(one.low) else stroke.start
                value = np.resize([each.get(name, rest) for each in poses.singles or ({},)], shape)
            strokes[name] = np.asarray(np.broadcast_to(value, (*batch, *shape) if follows else shape), float)
        joining: JoinedTo | None = None
        if not poses.axes and any(poses.singles):  # angles join those on the way from where the ranges begin, as a sweep gives them
            way, ways = np.linspace(0.0, 1.0, ON_THE_WAY), {}
            for name, stroke in self.plan.strokes.items():
                first = self.ranges[name].low
                start = float(first) if is_number(first) else float(stroke.start)
                ways[name] = np.array([start + way * (float(each.get(name, start)) - start) for each in poses.singles])
            last = np.arange(1, len(poses.singles) + 1) * ON_THE_WAY - 1
            joining = JoinedTo(Grid(self.plan, designs, ways, joining=joined_in_order), last)
        return Grid(self.plan, designs, strokes, per_design=follows, joining=joining)

    def _by_unit(self, slopes: FloatArray, poses: PoseSet, ends: Ends) -> FloatArray:
        """Return derivatives by the unit coordinates (k, n, poses), from those by owners and strokes (k, p, poses)."""
        strokes = [name for name in poses.axes if self.ranges[name].follows]
        total = np.array(slopes[:, : len(self.owners)])
        for row, name in enumerate(strokes):
            along = poses.parts[name].ravel()
            for (_, by), share in zip(ends[name], (1.0 - along, along), strict=True):
                if by is not None:
                    total += slopes[:, len(self.owners) + row][:, None, :] * (by[:, None] * share)
        return np.asarray(np.einsum("vo,kon->kvn", self._by_owner, total))

    @cached_property
    def _by_owner(self) -> FloatArray:
        """How the owners change with the unit coordinates, shape (n, owners)."""
        factors = np.zeros((len(self.space.variables), len(self.owners)))
        for place, each in enumerate(self.space.variables):
            factors[place, self.owners.index(each.owner)] = each.sign * each.span
        return factors

    def _rows(self, leaf: Leaf, found: Mapping[PoseSet, Samples], ends: Ends) -> Rows:
        """Return the rows of a leaf."""
        poses, place, single = self._of_leaf[leaf]
        samples = found[poses]
        values = samples.values[place]
        slopes = np.zeros((0, values.shape[1])) if samples.value_slopes is None else samples.value_slopes[place]
        if poses.inner and isinstance(leaf.quantity, Worst):
            values, slopes = worst_along(values, slopes, poses.axes[poses.inner], leaf.quantity.sense)
        if single >= 0:
            values, slopes = values[:, [single]], slopes[:, [single]]
        lost = samples.lost[place]
        if single >= 0 and len(poses.singles) > 1:
            lost = np.isnan(samples.values[place][:, single])
        if poses.weights is None:
            return Rows(values, slopes, lost)
        (low, low_moved), (high, high_moved) = ends[poses.outer[0]]  # of an integral's stroke, which may follow the design
        span = np.reshape(high - low, (-1, 1))
        mean = (values * poses.weights).sum(axis=-1, keepdims=True)
        grown = np.zeros((len(slopes), 1))
        for moved, sign in ((low_moved, -1.0), (high_moved, 1.0)):
            if moved is not None:
                grown[:, 0] += sign * (self._by_owner @ moved)
        return Rows(mean * span, (slopes * poses.weights).sum(axis=-1, keepdims=True) * float(span[0, 0]) + grown * mean[0], lost)

    def merits(self, combination: Sequence[int], unit: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return of designs (m, n) the objective, the misses in parts of the conditions' sizes, and the part reached, all (m,)."""
        values, missing, reached = self.merits_of_each(combination, unit)
        return (values.max(axis=0) if self.sense > 0.0 else values.min(axis=0)), missing, reached

    def merits_of_each(self, combination: Sequence[int], unit: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return of designs (m, n) each objective (k, m), the misses in parts of the conditions' sizes, and the part reached."""
        look = self.evaluated(self.dimensions_at(unit, combination))
        missing = self._missing(look).max(axis=0, initial=0.0)
        return np.array([look.values_of(each) for each in self.objectives]), np.where(look.is_assembled, missing, np.nan), look.reached

    def missing_of_each(self, combination: Sequence[int], unit: FloatArray) -> FloatArray:
        """Return by how much of its size designs (m, n) miss each condition, shape (conditions, m); infinite out of reach."""
        look = self.evaluated(self.dimensions_at(unit, combination))
        return np.where(look.is_assembled, self._missing(look), np.inf)

    def _missing(self, look: Evaluated) -> FloatArray:
        """Return by how much of its size each condition is missed, zero where it is kept, shape (conditions, m).

        They are measured with their size over the first designs that were looked at.
        """
        if self._sizes is None:
            known = {leaf: each[np.isfinite(each)] for leaf, each in look.numbers.items() if each.size}
            middle = {leaf: float(np.median(each)) if each.size else float("nan") for leaf, each in known.items()}
            self._sizes = [scale_among(each, look.leaf_sizes, middle) for each in self.constraints]
        found = np.zeros((len(self.constraints), *look.reached.shape))
        with np.errstate(all="ignore"):
            for row, (each, size) in enumerate(zip(self.constraints, self._sizes, strict=True)):
                found[row] = np.where(look.lost_of(each.margin), np.inf, np.maximum(missed(each, look.numbers, size), 0.0))
        return found

    def certainly(self, measure: Measure, combination: Sequence[int]) -> Enclosure | None:
        """Return between which values a measure lies whatever the variables; None where a leaf of it is taken over the stroke."""
        nodes: list[Node] = []
        for leaf in measure.leaves:
            is_taken = leaf.worst_over or strokes_behind(self.plan, leaf.bare_quantity)
            request = None if is_taken else traced(self.plan, leaf.bare_quantity)
            if request is None:
                return None
            nodes += request.nodes(self.plan)
        given = with_values(self.machine.dimensions, self.space.chosen(combination))
        inputs = {name: Enclosure(value, value) for name, value in given.items()}
        for each in self.space.variables:
            ends = each.sign * each.low, each.sign * each.high
            inputs[each.owner] = Enclosure(min(ends), max(ends))
        found = dict(zip(measure.leaves, enclosures(nodes, inputs), strict=True))
        return Enclosure.from_number(measure.from_leaves(lambda leaf: found[leaf]))

    # -- machines ----------------------------------------------------------------------------------------

    def machine_of(self, unit: FloatArray, combination: Sequence[int]) -> Mechanism:
        """Return the machine of unit coordinates (n,), on the sides of a combination."""
        machine = self.on_branch(combination).machine.replaced(
            **self.space.chosen(combination), **{name: float(each) for name, each in self.space.dimensions_at(unit).items()}
        )
        driven = [name for name, one in self.ranges.items() if one.is_travel]  # strokes of cylinders by their rows: their whole ways
        if not driven:
            return machine
        ends = self.ends(machine.dimensions)
        return variant(type(machine), travels={name: ends[name] for name in driven})(**machine.dimensions)

    def assembled(self, machine: Mechanism) -> Motion:
        """Return a machine's motion over the strokes' ranges; AssemblyError where it cannot be assembled, between the poses too."""
        ends, count = self.ends(machine.dimensions), 101 if len(self.ranges) == 1 else 25
        axes = {name: np.linspace(low, high, count) for name, (low, high) in ends.items() if low != high}
        grids = dict(zip(axes, np.meshgrid(*axes.values(), indexing="ij"), strict=True))
        at: dict[str, Any] = {name: grids.get(name, low) for name, (low, _) in ends.items()}
        return machine.at(**at)

    def along(self, machine: Mechanism, name: str, count: int) -> Motion:
        """Return a machine's motion along one stroke's range, the others in the middle of theirs, NaN where it is not reached."""
        ends = self.ends(machine.dimensions)
        at: dict[str, Any] = {stroke: 0.5 * (low + high) for stroke, (low, high) in ends.items()}
        at[name] = np.linspace(*ends[name], count)
        return machine.at(unreachable="nan", **at)

    def over_stroke(self, leaf: Leaf, design: Mapping[str, Numbers], count: int) -> tuple[str, FloatArray, FloatArray] | None:
        """Return a stroke that a leaf's quantity depends on, its values (n,) and the quantity's (n,) of a design [SI]; None for a constant.

        Over further strokes that value is taken which is the worst for the leaf, of others than an extreme the greatest.
        """
        kind = Least if leaf.sense < 0.0 else Most
        counts = {each: count if each < 2 else max(SAMPLES.get(each, 3), 33 // each) for each in range(6)}
        alone = Problem(self.machine, [kind(leaf.quantity)], [], NOWHERE, over=self.over, counts=counts)
        asked = alone.leaves[0]
        poses, *_ = alone._of_leaf[asked]
        if not poses.outer:
            return None
        name = poses.outer[0]
        axis, (low, high) = poses.axes[name], alone.ends(design)[name]
        values = alone.evaluated(design).rows[asked].values.reshape(len(axis), -1)
        with np.errstate(all="ignore"):
            worst = (np.fmin if kind is Least else np.fmax).reduce(values, axis=1)
        return name, low + axis * (high - low), worst

    # -- the whole truth ---------------------------------------------------------------------------------

    def truths(self, design: Mapping[str, Numbers]) -> LeafNumbers:
        """Return the values of all leaves of one design, between the poses too, as the judge looks for them."""
        found, ends = LeafNumbers({}), self.ends(design)
        between: dict[tuple[str, ...], list[Leaf]] = {}
        sampled: list[Leaf] = []
        for leaf in self.leaves:
            poses, *_ = self._of_leaf[leaf]
            (between.setdefault(tuple(poses.axes), []) if leaf.sense and poses.axes else sampled).append(leaf)
        if sampled:
            self.count.add(len(sampled) - 1)  # as many looks as there are numbers
            found = self.evaluated(design).of_one
        for leaf in sampled:
            if isinstance(leaf, Integral):
                low, high = ends[self._of_leaf[leaf][0].outer[0]]
                found[leaf] = float(self.panels(leaf, design).value) * (high - low)
        for names, leaves in between.items():
            box: dict[str, Any] = {name: end if name in names else end[0] for name, end in ends.items()}
            owners = [(leaf, divisor) for leaf in leaves for divisor in divisors_of(self.plan, leaf.bare_quantity)]
            asked = [*leaves, *(kind(divisor) for _, divisor in owners for kind in (Least, Most))]
            with unwarned():
                seen, _ = Domain(self.plan, design, Over(**box)).searched([SearchRow.alone(leaf) for leaf in asked])
            for leaf, each in zip(leaves, seen, strict=False):
                spans = {name: (ends[name][0], ends[name][1] - ends[name][0]) for name in names}
                found.parts[leaf] = {name: (float(each.strokes[name]) - low) / (span or 1.0) for name, (low, span) in spans.items()}
                found[leaf] = float(each.value)
                found.lost.update([leaf] if each.lawless else [])
            lows, highs = (seen[len(leaves) + end :: 2] for end in (0, 1))
            found.lost.update(leaf for (leaf, _), low, high in zip(owners, lows, highs, strict=True) if low.value <= 0.0 <= high.value)
        return found

    def tops(self, leaf: Leaf, design: Mapping[str, Numbers]) -> list[dict[str, float]]:
        """Return where between its samples a leaf of one design has tops that come near its worst value: the part of its stroke's range."""
        poses, place, _ = self._of_leaf[leaf]
        if len(poses.axes) != 1 or poses.inner:
            return []
        ((name, axis),) = poses.axes.items()
        sampling, ends = self._sampling(poses), self._ends(design)

        def values(at: FloatArray) -> FloatArray:
            found = sampling.at(self._grid(PoseSet({name: at}), design, ends)).values[place, 0]
            return np.where(np.isfinite(found), leaf.sense * found, -np.inf)

        seen = values(axis)
        band = np.ptp(seen[np.isfinite(seen)]) * NEAR_TOP if np.isfinite(seen).any() else 0.0
        inner = np.flatnonzero((seen[1:-1] >= seen[:-2]) & (seen[1:-1] >= seen[2:]) & (seen[1:-1] >= seen.max() - band)) + 1
        found = []
        for one in inner[np.argsort(-seen[inner], kind="stable")][:TOPS]:
            low, high = float(axis[one - 1]), float(axis[one + 1])
            for _ in range(ZOOMS):
                at = np.linspace(low, high, 17)
                best = int(np.argmax(values(at)))
                low, high = float(at[max(best - 1, 0)]), float(at[min(best + 1, 16)])
            found.append({name: 0.5 * (low + high)})
        return found

    def panels(self, leaf: Leaf, design: Mapping[str, Numbers]) -> Quadrature:
        """Return an integral of one design over the parts (0 to 1) of its stroke, and the panels that it takes."""
        poses, place, _ = self._of_leaf[leaf]
        (name,) = poses.outer
        sampling, ends = self._sampling(poses), self._ends(design)

        def values(places: FloatArray) -> FloatArray:
            found = sampling.at(self._grid(PoseSet({name: places}, inner=poses.inner), design, ends)).values[place]
            if poses.inner and isinstance(leaf.quantity, Worst):
                found, _ = worst_along(found, np.zeros((0, found.shape[1])), poses.axes[poses.inner], leaf.quantity.sense)
            return np.asarray(found[0])

        return quadrature(values)

    def refine(self, design: Mapping[str, Numbers]) -> bool:
        """Add the tops between the samples of one design, and look at integrals in fine panels; return whether anything is new."""
        added = False
        for leaf in self.leaves:
            for parts in self.tops(leaf, design) if leaf.sense else ():
                added = self.refined(leaf, parts) or added
            if isinstance(leaf, Integral):
                added = self.refined_panels(leaf, design) or added
        return added

    def refined_panels(self, leaf: Leaf, design: Mapping[str, Numbers]) -> bool:
        """Look at an integral in panels that are fine enough for one design; return whether they are others than before."""
        poses, *_ = self._of_leaf[leaf]
        (name,) = poses.outer
        places, weights = gauss(self.panels(leaf, design).edges)
        if len(places) <= len(poses.axes[name]):
            return False
        poses.axes[name], poses.weights = places, weights
        return True

    def refined(self, leaf: Leaf, parts: Mapping[str, float]) -> bool:
        """Add a pose between the samples to those of a leaf; return whether it is new."""
        poses, *_ = self._of_leaf[leaf]
        new = False
        for name, part in parts.items():
            axis = poses.axes[name]
            if np.abs(axis - part).min() > CLOSEST:
                poses.axes[name] = np.sort(np.append(axis, part))
                new = True
        return new

    def ends(self, design: Mapping[str, Numbers]) -> dict[str, tuple[float, float]]:
        """Return from where to where [SI] each stroke of one design is looked at."""
        found = self._ends(design)
        return {name: (float(np.ravel(low)[0]), float(np.ravel(high)[0])) for name, ((low, _), (high, _)) in found.items()}


def terms_size(measure: Measure, sizes: Mapping[Leaf, float], values: Mapping[Leaf, float]) -> float:
    """Return how large the terms of a measure are, from the sizes of its leaves over the stroke: a difference is as large as its parts."""
    if isinstance(measure, Leaf):
        return sizes[measure]
    if not isinstance(measure, CombinedMeasure):
        return abs(float(measure.from_leaves(lambda leaf: values[leaf])))
    left, right = (terms_size(side, sizes, values) for side in (measure.left, measure.right))
    if measure.symbol in ("+", "-"):
        return max(left, right)
    if measure.symbol == "*":
        return left * right
    with np.errstate(all="ignore"):
        other = abs(float(measure.right.from_leaves(lambda leaf: values[leaf])))
        return float(np.divide(left, other) if measure.symbol == "/" else np.power(left, other))


def scale_among(constraint: Constraint, sizes: Mapping[Leaf, float], values: Mapping[Leaf, float], change: float = 0.0) -> float:
    """Return the scale of a constraint's numbers: the number it is compared with, without one the size of its terms.

    `sizes` are those of the leaves over the stroke; terms whose margin has a `change` over the box are at least as large.
    """
    terms = [terms_size(side, sizes, values) for side in constraint.compared]
    size = max([each for each in terms if np.isfinite(each)] + [change])
    given = max((abs(side.value) for side in constraint.compared if isinstance(side, FixedNumber)), default=0.0)
    return (max(given, EXACT * size) if given > 0.0 else size) or 1.0


def missed(constraint: Constraint, numbers: Mapping[Leaf, Any], size: float) -> FloatArray:
    """Return by how much of its size a condition is missed by designs, from the leaves' numbers (m,); nothing where one says nothing."""
    left, right = (np.asarray(side.from_leaves(lambda leaf: numbers[leaf]), float) for side in constraint.compared)
    short = constraint.short(left, right) / size
    says_nothing = np.any([np.isnan(numbers[leaf]) for leaf in constraint.margin.leaves], axis=0)
    unlimited = np.isnan(short) & (constraint.symbol != "==") & says_nothing
    return np.where(unlimited, 0.0, np.where(np.isnan(short), np.inf, short))


def worst_along(values: FloatArray, slopes: FloatArray, marks: FloatArray, sense: float) -> tuple[FloatArray, FloatArray]:
    """Return the worst values along a last axis of samples at some marks, (m, n) from (m, n * marks), and the derivatives there.

    A peak between samples is that of the parabola through three of them.
    """
    cube = sense * values.reshape(len(values), -1, len(marks))
    filled = np.where(np.isnan(cube), -np.inf, cube)
    top = np.clip(np.argmax(filled, axis=-1), 1, len(marks) - 2)[..., None]
    a, b, c = (np.take_along_axis(cube, top + shift, axis=-1)[..., 0] for shift in (-1, 0, 1))
    before, after = (np.diff(marks)[top[..., 0] + by] for by in (-1, 0))
    with np.errstate(all="ignore"):
        rise, fall = (b - a) / before, (c - b) / after
        vertex = np.clip(-0.5 * (rise * after + fall * before) / (fall - rise), -before, after)
        shift = np.where(fall < rise, vertex, np.where(c > a, after, -before))
        shift = np.where(np.isfinite(shift), shift, 0.0)
    left, right = shift / before, shift / after
    both = before + after
    weights = np.stack([left * (shift - after) / both, (left + 1.0) * (1.0 - right), right * (shift + before) / both])
    best = sense * (weights[0] * a + weights[1] * b + weights[2] * c)
    best = np.where(np.isnan(cube).any(axis=-1), np.nan, best)
    bunch = slopes.reshape(len(slopes), cube.shape[1], len(marks))
    parts = [np.take_along_axis(bunch, np.broadcast_to(top[0] + each, (*bunch.shape[:2], 1)), axis=-1)[..., 0] for each in (-1, 0, 1)]
    return best, np.asarray(sum(weight[0] * part for weight, part in zip(weights, parts, strict=True)))
