"""Quantities of designs at poses: with exact derivatives for a search, in one call of the program; at the poses of one motion for a study.

Outputs and requests are in one kernel, functions of a motion beside them.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import field, replace
from functools import cached_property
from itertools import pairwise
from math import prod
from typing import Any, TypeAlias

import numpy as np

from ..errors import AssemblyError, DefinitionError, UntracedError, cited, ensure, errors_of, unwarned
from ..frozen import immutable
from ..mechanism import Mechanism
from ..motion import Grid, Motion, NodeRequest, Request, at_values, each_at_its_stroke, evaluate_grid, stroke_display_unit
from ..motion.evaluation import BulkProgram, Evaluation
from ..motion.functions import evaluate_bound
from ..motion.grid import JoinedTo, angles_of
from ..motion.measures import At, Integral, Leaf, Measure, Worst, bound_quantity, constant_part, operation, strokes_behind, traced, words_of
from ..motion.requests import Trait, may_be_unlimited, slope
from ..motion.search import corners
from ..numeric.line import Index
from ..numeric.quadrature import PANELS, gauss, quadrature
from ..plan import Mask, Plan
from ..program import FloatArray, Kernel, Level, Node, RunOptions
from ..quantities import Quantity
from ..quantities.quantity import stands_for
from ..units import show
from ..vectors import Numbers
from .designs import DesignValues
from .space import check_one_design

DIFFERENCE = 6e-6
"""Of a variable's span: the step of a central difference, where nothing better is to be had."""


@immutable
class Samples:
    """Quantities at poses: `values` (k, m, n), the `margins` of the loops (r, m, n), and whether a pose is `reached` (m, n).

    `lost` (k, m) are those without a value of a design: at a pose that is reached they have none, or a divisor in them changes its sign.
    Of one design, where they are asked for, also the derivatives by p inputs: of the values (k, p, n), and of the margins (r, p, n).
    """

    values: FloatArray
    margins: FloatArray
    reached: Mask
    lost: Mask
    value_slopes: FloatArray | None = None
    margin_slopes: FloatArray | None = None


class SampleProgram:
    """Requests and derivatives of some of them as one kernel, so that a look at a design is one call.

    `angles` are those along which any of its numbers goes on from pose to pose. `slopes` are the derivatives alone with their own angles,
    for poses at which the requests have to be looked at closely; None where there are no derivatives. `may_fail` says whether a request may
    be without a value though no guard reports it.
    """

    def __init__(self, plan: Plan, requests: tuple[Request, ...], sloped: Sequence[Request], owners: tuple[str, ...]) -> None:
        bulk = BulkProgram.compiled_on(plan, requests)  # on a plan that is not traced yet
        own, self.requests, self.may_fail = bulk.kernel, requests, bulk.may_fail
        following = [node for each in requests if Trait.FOLLOWS_ANGLES in each.traits for node in each.nodes(plan)]
        shares = [node for each in sloped for node in slope(each, owners).nodes(plan)] if owners else []
        self.rows, self.kernel = len(own.outputs), Kernel([*own.outputs, *shares], own.guards)
        self.angles = angles_of(plan, [*following, *shares])
        self.slopes = (Kernel(shares), angles_of(plan, shares)) if shares else None

    def __call__(self, grid: Grid) -> tuple[FloatArray, FloatArray]:
        """Return the requests (rows, ...) over a grid, NaN where they have no value, and the derivatives (shares, ...) of one design."""
        found = grid.kernel_result(self.kernel)
        is_told = found.is_clear and not (self.may_fail and not np.isfinite(found.values[: self.rows]).all())
        if is_told and self.angles.angles:  # none goes on past half a turn
            angles = grid.kernel_values(self.angles.kernel)
            is_told = bool(np.isfinite(angles).all()) and np.array_equal(grid.joining(grid, angles, self.angles.kernel), angles)
        if is_told:
            values = grid.full(found.values)
            return values[: self.rows], values[self.rows :]
        with unwarned(), np.errstate(all="ignore"):
            values = np.array([np.broadcast_to(each, grid.shape) for each in evaluate_bound(Evaluation(grid, self.requests), None, "nan")])
            if self.slopes is None:
                return values, np.zeros((0, *grid.shape))
            kernel, followed = self.slopes
            continued = followed.continued(grid)
            return values, grid.kernel_values(kernel) if continued is None else continued


class Sampling:
    """Some quantities of a plan, together, at poses of designs.

    `owners` are the inputs they are differentiated by: design variables, and strokes.
    """

    def __init__(self, plan: Plan, quantities: Sequence[object], owners: Sequence[str]) -> None:
        self.plan, self.quantities, self.owners = plan, tuple(quantities), tuple(owners)
        bound = [(place, traced(plan, quantity)) for place, quantity in enumerate(self.quantities)]
        self._traced = {place: request for place, request in bound if request is not None}
        self._eager = [place for place, request in bound if request is None]
        self._divisors: list[tuple[int, Request]] = []
        for place in self._traced:
            found = [traced(plan, each) for each in divisors_of(plan, self.quantities[place])]
            self._divisors += [(place, each) for each in found if each is not None]
        self._programs: dict[tuple[bool, bool], SampleProgram] = {}

    def at(self, grid: Grid, *, margins: bool = False, slopes: bool = False) -> Samples:
        """Return the quantities over a grid, NaN where they have no value; with the margins, and of one design the derivatives."""
        (m, n), k, p = grid.size, len(self.quantities), len(self.owners)
        loops = loop_margins(self.plan) if margins else []  # before anything else is read, which may have triangles of its own
        first = len(loops) + 1
        found, shares = self._program(loops, slopes=slopes)(grid)
        found = found.reshape(len(found), m, n)
        values = np.full((k, m, n), np.nan)
        values[[*self._traced]] = found[first : first + len(self._traced)]
        if self._eager:
            with unwarned(), np.errstate(all="ignore"):
                motion = motion_of(grid)
                values[self._eager] = [eager(motion, self.quantities[place]).reshape(m, n) for place in self._eager]
        reached = np.isfinite(found[len(loops)])
        whole = values if reached.all() else np.where(reached, values, np.nan)
        empty: Mask = np.asarray(np.isnan(whole) & reached)  # no value where there is a pose, though something limits it there
        lost: Mask = np.asarray(empty.any(axis=2))
        for place in np.flatnonzero(lost.any(axis=1)).tolist():
            lost[place] = (empty[place] & ~nothing_limits(motion_of(grid), self.quantities[place]).reshape(m, n)).any(axis=1)
        for (place, _), each in zip(self._divisors, found[first + len(self._traced) :], strict=True):  # both signs, or zero somewhere
            low, high = (np.where(reached, each, end) for end in (np.inf, -np.inf))
            lost[place] |= (np.fmin.reduce(low, axis=-1, initial=np.inf) <= 0.0) & (np.fmax.reduce(high, axis=-1, initial=-np.inf) >= 0.0)
        samples = Samples(whole, found[: len(loops)], reached, lost)
        if not slopes:
            return samples
        by_owner = shares.reshape(len(loops) + len(self._traced), p, n)
        value_slopes = np.zeros((k, p, n))
        value_slopes[[*self._traced]] = by_owner[: len(self._traced)]
        for place in self._eager:
            with unwarned(), np.errstate(all="ignore"):
                value_slopes[place] = self._differences(grid, self.quantities[place])
        return replace(samples, value_slopes=value_slopes, margin_slopes=by_owner[len(self._traced) :])

    def _program(self, loops: Sequence[Request], *, slopes: bool) -> SampleProgram:
        """Return the program of the margins, of whether all has a place, of the quantities and of their divisors."""
        asked = bool(loops), slopes
        if asked not in self._programs:
            requests = (*loops, all_placed(), *self._traced.values(), *(each for _, each in self._divisors))
            sloped = [*self._traced.values(), *loops] if slopes else []
            key = "samples", tuple(each.key for each in requests), len(sloped), self.owners
            self._programs[asked] = self.plan.made(key, lambda plan: SampleProgram(plan, requests, sloped, self.owners))
        return self._programs[asked]

    def _differences(self, grid: Grid, quantity: object) -> FloatArray:
        """Return the central differences of a quantity that is not traced, shape (p, n)."""
        found = np.zeros((len(self.owners), grid.size[1]))
        for row, owner in enumerate(self.owners):
            given = grid.strokes if owner in grid.strokes else grid.designs
            step = DIFFERENCE * max(float(np.max(np.abs(given[owner]))), 0.01)
            ends = []
            for sign in (1.0, -1.0):
                moved = {owner: np.asarray(given[owner]) + sign * step}
                designs = dict(grid.designs) | (moved if given is grid.designs else {})
                strokes = dict(grid.strokes) | (moved if given is grid.strokes else {})
                near = Grid(grid.plan, designs, strokes, per_design=grid.per_design)
                ends.append(eager(motion_of(near), quantity).reshape(-1))
            found[row] = (ends[0] - ends[1]) / (2.0 * step)
        return found


# Where there is no value.


GOES_THROUGH = ("add", "subtract", "multiply", "divide", "negative", "absolute", "power", "sqrt", "hypot")
"""The functions that grow without bounds where a part of them does."""


def divisors_of(plan: Plan, quantity: object) -> tuple[Any, ...]:
    """Return the divisors of a quantity and of its parts; where one passes zero the quantity has no bounds."""
    sign, parts = operation(stands_for(plan.members, quantity))
    if sign not in GOES_THROUGH:
        return ()
    found = [each for part in (parts if sign != "power" else parts[:1]) for each in divisors_of(plan, part)]
    if sign == "divide":
        found += zero_factors(plan, parts[1])
    if sign == "power" and isinstance(power := constant_part(parts[1]), float) and power < 0.0:
        found += zero_factors(plan, parts[0])
    return tuple(found)


def zero_factors(plan: Plan, divisor: object) -> list[object]:
    """Return the factors of a divisor, each of which makes it zero, without the sizes and powers about them."""
    sign, parts = operation(stands_for(plan.members, divisor))
    if sign in ("absolute", "power", "sqrt", "negative"):
        return zero_factors(plan, parts[0])
    if sign == "multiply":
        return [each for part in parts for each in zero_factors(plan, part)]
    return [divisor] if isinstance(divisor, (str, Quantity, Request)) and constant_part(divisor) is None else []


def no_value(plan: Plan, leaf: Leaf) -> str:
    """Return in words that a leaf has no value of some design, and why."""
    divisors = () if leaf.worst_over else divisors_of(plan, leaf.bare_quantity)
    if not divisors:
        return f"{leaf} has no value at some poses"
    why = f"it is divided by {', '.join(map(words_of, divisors))}, and where it passes zero within the stroke, it grows without bounds"
    return f"{leaf} has no value: {why}"


# How far the links are from being too short or too long to meet.


def loop_margins(plan: Plan) -> list[NodeRequest]:
    """Return requests above zero where each loop of moving links is assembled: a squared sine, or a length [m]."""

    def margin(place: int) -> NodeRequest:
        def nodes(plan: Plan) -> tuple[Node, ...]:
            loop = plan.trace.loops[place]
            return (loop.terms[0] / loop.terms[2] if loop.kind == "links" else loop.terms[0],)

        return NodeRequest(
            text=f"margin {place}", key=("margin", place), nodes_of=nodes, names_of=lambda plan: plan.reaches(plan.trace.loops[place].step)
        )

    loops = [place for place, loop in enumerate(plan.trace.loops) if loop.kind in ("links", "length")]
    return [margin(place) for place in loops if plan.trace.loops[place].terms[0].level is not Level.CONSTANT]


def all_placed() -> NodeRequest:
    """Return a number that is finite where every point has a place."""

    def nodes(plan: Plan) -> tuple[Node, ...]:
        whole = plan.trace.graph.constant(0.0)
        for name in plan.moving:
            for node in plan.nodes(name):
                whole = whole + node
        return (whole,)

    return NodeRequest(text="all places", key="placed", nodes_of=nodes, names_of=lambda plan: plan.reaches(*plan.moving))


def with_values(designs: Mapping[str, Numbers], changed: Mapping[str, Any]) -> DesignValues:
    """Return dimensions with some of them changed; numbers as floats, and arrays of one number as such."""
    return dict(designs) | {name: float(value) if np.ndim(value) == 0 else np.asarray(value, float) for name, value in changed.items()}


QuantityLike: TypeAlias = str | Quantity | Request | Callable[[Motion], FloatArray]
"""A named output, a quantity, a request, or a function of a motion that returns a number for each pose, NaN where it has none."""
Measured: TypeAlias = QuantityLike | Measure
"""The same, or a measure such as `most("tilt")`; the function may return one number for each design: `np.ptp(motion["tilt"], axis=-1)`."""


def number_bound(plan: Plan, quantity: object) -> Request | None:
    """Return a quantity bound to a plan as nodes of its program; None without one: a measure, a function of a motion.

    DefinitionError for anything but a quantity, and for a point, which has two coordinates.
    """
    if isinstance(quantity, (str, Quantity, Request)):
        return traced(plan, quantity)
    if isinstance(quantity, type) or not (isinstance(quantity, Measure) or callable(quantity)):
        what = f"{plan.title}: {cited(quantity)} is no output, quantity, request, measure or function of a motion"
        raise DefinitionError(f"{what}; give one, such as 'tilt' or drive_force().")
    return None


def traced_number(plan: Plan, quantity: object) -> Request:
    """Return a quantity bound to a plan; DefinitionError for one without a gradient in the program."""
    found = number_bound(plan, quantity)
    if found is None:
        if isinstance(quantity, Request):
            bound_quantity(plan, quantity).nodes(plan)  # which says why, such as the friction that has no program
        what = f"{plan.title}: {words_of(quantity)} is no part of the program, so that its gradient is not known"
        raise DefinitionError(f"{what}; give an output, a quantity or a request.")
    return found


def measured_title(plan: Plan, quantity: object) -> str:
    """Return a quantity in words; DefinitionError for anything else."""
    found = number_bound(plan, quantity)
    return str(quantity) if isinstance(quantity, Measure) else words_of(quantity) if found is None else found.sentence


@immutable
class StudyPoses:
    """The poses that a study looks at, and quantities of many designs there: `base` is the motion of the machine as it is set.

    Angles of other designs lie within 180 deg of those of this one.
    """

    base: Motion
    _rows: dict[Integral, tuple[StudyPoses, FloatArray]] = field(default_factory=dict)

    @classmethod
    def of(cls, machine: Mechanism, strokes: Mapping[str, Any], count: int) -> StudyPoses:
        """Return the poses at strokes [SI], by default `count` of them over a single stroke, at all of which a machine can be assembled.

        Raises DefinitionError without poses, AssemblyError where the machine as it is set cannot be assembled.
        """
        check_one_design(machine)
        every = {name: np.linspace(each.start, each.end, count) for name, each in machine.strokes.items()}
        base = machine.at(**(strokes or (every if len(every) == 1 else {})))
        ensure(base.reached.size, f"{machine.plan.title}: there are no strokes to look at; give at least one value of each.")
        return cls(base)

    @property
    def pose_count(self) -> int:
        """The number of poses."""
        return self.base.reached.size

    @cached_property
    def stroke_values(self) -> dict[str, FloatArray]:
        """The strokes (n,)."""
        return {name: value.ravel() for name, value in self.base.strokes.items()}

    def words(self) -> str:
        """Return where the poses are: `S = 50 mm`, `S = 0 mm to 250 mm, 21 poses`."""
        said = []
        for name, value in self.stroke_values.items():
            unit = stroke_display_unit(self.base.plan, name, "mm")
            ends = [show(float(end), unit) for end in (value.min(), value.max())]
            said.append(f"{name} = {' to '.join(dict.fromkeys(ends))}")
        return ", ".join(said) + (f", {self.pose_count} poses" if self.pose_count > 1 else "")

    def of_requests(self, machine: Mechanism, requests: Sequence[Any], way: RunOptions, poses: slice = slice(None)) -> list[FloatArray]:
        """Return requests of m designs at n of the poses, an array (m, n) each, NaN where they have no value."""
        asked = [bound_quantity(self.base.plan, each) for each in requests]
        found = evaluate_grid(self.grid_at(machine, poses), asked, None, way, "nan")
        return [each.reshape(-1, each.shape[-1]) for each in found]

    def of_all(self, machine: Mechanism) -> Motion:
        """Return the motion of m designs at all poses, NaN out of reach."""
        base = self.base
        joining = JoinedTo(base._grid, np.arange(self.pose_count).reshape(self.base.shape))
        return Motion(base.plan, machine.dimensions, base.strokes, "nan", joining=joining)

    def of_each(self, machine: Mechanism, place: Index) -> Motion:
        """Return the motion of m designs, each at one of the poses, by its place (m,); NaN out of reach."""
        strokes = {name: value[place] for name, value in self.stroke_values.items()}
        return each_at_its_stroke(self.base.plan, machine.dimensions, strokes, self.base, place)

    def of_function(self, machine: Mechanism, quantity: Any) -> FloatArray:
        """Return the values of a function of a motion, or of a request without a program, of m designs: (m, n), or one each, (m, 1)."""
        motion = self.of_all(machine)
        if isinstance(quantity, Request):
            return eager(motion, quantity).reshape(-1, self.pose_count)
        title, what, designs = motion.plan.title, measured_title(motion.plan, quantity), motion._design_shape
        result = real_numbers(function_value(quantity, motion), f"{title}: {what}", "a number for each pose or each design is expected")
        if result.shape == motion.shape:
            return np.where(motion.reached & np.isfinite(result), result, np.nan).reshape(prod(designs), -1)
        text = f"{title}: {what} has the shape {result.shape} where {motion.shape} or {designs} is expected"
        ensure(result.shape == designs, f"{text}; return a number for each pose, or one for each design.")
        lost = ~motion.reached.reshape(prod(designs), -1).all(axis=1)
        return np.where(lost | ~np.isfinite(result.ravel()), np.nan, result.ravel())[:, None]

    def of_leaf(self, machine: Mechanism, leaf: Leaf, way: RunOptions) -> FloatArray:
        """Return the measure of a quantity over the poses, of m designs, shape (m,)."""
        if isinstance(leaf, At):
            return self.at(leaf).values(machine, leaf.quantity, way)[:, 0]
        if isinstance(leaf, Integral):
            row, weights = self.integral_poses(leaf)
            return np.asarray((row.values(machine, leaf.quantity, way) * weights).sum(axis=1))
        return np.asarray(extreme_of(leaf).reduce(self.values(machine, leaf.quantity, way), axis=1))

    def at(self, leaf: At) -> StudyPoses:
        """Return the pose of a value at one pose; DefinitionError where a stroke is not said."""
        plan = self.base.plan
        only = next(iter(self.stroke_values)) if len(self.stroke_values) == 1 else ""
        missing = [name for name in self.stroke_values if name not in leaf.strokes and name != only]
        if missing or (only and not leaf.strokes and only in strokes_behind(plan, leaf.quantity)):
            raise DefinitionError(f"{plan.title}: {leaf}: say the pose, {', '.join(f'{name}=...' for name in missing or [only])}.")
        strokes = {name: leaf.strokes.get(name, float(value[0])) for name, value in self.stroke_values.items()}
        return StudyPoses(Motion(plan, self.base.designs, at_values(strokes, plan), "raise"))

    def integral_poses(self, leaf: Integral) -> tuple[StudyPoses, FloatArray]:
        """Return the poses (n,) of an integral over a row of strokes, fine enough for the machine as it is set, and their weights [SI]."""
        if leaf in self._rows:
            return self._rows[leaf]
        check_no_worst(leaf)
        plan, designs = self.base.plan, self.base.designs
        by = leaf.by or (next(iter(self.stroke_values)) if len(self.stroke_values) == 1 else "")
        if by not in self.stroke_values or len(self.base.shape) != 1:
            names = ", ".join(self.stroke_values)
            raise DefinitionError(f"{plan.title}: {leaf}: give one row of strokes, and say by which, by= one of {names}.")
        turns = corners(np.array([value / (np.ptp(value) or 1.0) for value in self.stroke_values.values()]))
        legs = [self._leg(leaf, by, ends, max(PANELS // (len(turns) - 1), 1)) for ends in pairwise(turns)]
        strokes = {name: np.concatenate([poses[name] for poses, _ in legs]) for name in self.stroke_values}
        self._rows[leaf] = StudyPoses(Motion(plan, designs, strokes, "nan")), np.concatenate([weights for _, weights in legs])
        return self._rows[leaf]

    def _leg(self, leaf: Integral, by: str, ends: tuple[int, int], panels: int) -> tuple[dict[str, FloatArray], FloatArray]:
        """Return the strokes and weights of an integral on the straight way between two of the poses."""
        low, high = ({name: float(value[end]) for name, value in self.stroke_values.items()} for end in ends)

        def strokes(parts: FloatArray) -> dict[str, FloatArray]:
            return {name: low[name] + (high[name] - low[name]) * parts for name in low}

        def values(parts: FloatArray) -> FloatArray:
            order = np.argsort(parts)
            motion = Motion(self.base.plan, self.base.designs, strokes(parts[order]), "nan")
            return eager(motion, leaf.quantity)[np.argsort(order)]

        found = quadrature(values, np.linspace(0.0, 1.0, panels + 1))
        parts, shares = gauss(found.edges)
        return strokes(parts), shares * (np.nan if np.isinf(found.value) else high[by] - low[by])

    def values(self, machine: Mechanism, quantity: object, way: RunOptions) -> FloatArray:
        """Return a quantity of m designs at the poses, shape (m, n), or (m, 1) of one number for each design."""
        with unwarned(), np.errstate(all="ignore"):
            if isinstance(quantity, Measure):  # over the poses that are looked at
                found = quantity.from_leaves(lambda leaf: self.of_leaf(machine, leaf, way))
                shape = np.broadcast_shapes(*map(np.shape, machine.dimensions.values()))
                return np.array(np.broadcast_to(found, prod(shape))).reshape(-1, 1)
            if number_bound(self.base.plan, quantity) is not None:
                return self.of_requests(machine, [quantity], way)[0]
            return self.of_function(machine, quantity)

    def shaped(self, values: FloatArray) -> FloatArray:
        """Return values (..., n) in the shape of the strokes; numbers for each design, (..., 1), without it."""
        return values.reshape((*values.shape[:-1], *(self.base.shape if values.shape[-1] == self.pose_count else ())))

    def grid_at(self, machine: Mechanism, poses: slice = slice(None)) -> Grid:
        """Return m designs at n of the poses."""
        places = np.arange(self.pose_count)[poses]
        strokes = {name: value[poses] for name, value in self.stroke_values.items()}
        return Grid(self.base.plan, machine.dimensions, strokes, joining=JoinedTo(self.base._grid, places))


# A quantity as a motion gives it.


def function_value(quantity: Callable[[Motion], Any], motion: Motion) -> Any:
    """Return the value of a function of a motion; DefinitionError, with the line, for any error in it."""
    name = getattr(quantity, "__name__", cited(quantity))
    with errors_of(f"{motion.plan.title}: the function {name} of a motion of many settings"):
        return quantity(motion)


def real_numbers(found: Any, what: str, expected: str) -> FloatArray:
    """Return a function's values as an array of floats; DefinitionError for anything else, and complex numbers: a part would be lost."""
    with suppress(TypeError, ValueError):
        if not np.iscomplexobj(found):
            return np.asarray(found, float)
    raise DefinitionError(f"{what} gives {cited(found)}; {expected}.")


def quantity_values(motion: Motion, quantity: QuantityLike, *, endless: bool = False) -> FloatArray:
    """Return a quantity at every pose of a motion, NaN where it has no value; the study reports nearness to a dead point.

    An infinite one is none, unless it may be `endless`.
    """
    title = motion.plan.title
    if isinstance(quantity, type) or not (callable(quantity) or isinstance(quantity, (str, Quantity, Request))):
        raise DefinitionError(f"{title}: {cited(quantity)} is no output, quantity or function of a motion; give one, such as 'tilt'.")
    with unwarned(), np.errstate(all="ignore"):
        if callable(quantity):
            found = function_value(quantity, motion)
        elif isinstance(quantity, Request):
            try:  # by its program where it has one
                found = motion._requested(quantity)
            except UntracedError:
                found = motion[quantity]
        else:
            found = motion[quantity]
    what = f"{title}: {words_of(quantity)}"
    result = real_numbers(found, what, "a number for each pose is expected")
    remedy = "ask for a number such as an output, or lambda motion: motion.y('G')"
    ensure(result.shape == motion.shape, f"{what} has the shape {result.shape} where {motion.shape} is expected; {remedy}.")
    return np.where((~np.isnan(result) if endless else np.isfinite(result)) & motion.reached, result, np.nan)


def motion_of(grid: Grid) -> Motion:
    """Return the motion over a grid, NaN out of reach."""
    joining = grid.joining if isinstance(grid.joining, JoinedTo) else None
    return Motion(grid.plan, grid.designs, grid.strokes, "nan", per_design=grid.per_design, joining=joining)


def eager(motion: Motion, quantity: Any) -> FloatArray:
    """Return a quantity at every pose of a motion, NaN where it has no value."""
    if isinstance(quantity, str) and quantity not in motion.plan.members and quantity in motion.plan.table.spellings:
        owner, sign = motion.plan.table.spellings[quantity]
        return np.asarray(np.broadcast_to(sign * motion.inputs[owner], motion.shape))
    found = quantity.of(motion) if isinstance(quantity, Request) else quantity_values(motion, quantity, endless=True)
    return np.asarray(np.broadcast_to(found, motion.shape))


def nothing_limits(motion: Motion, quantity: Any) -> Mask:
    """Return the mask of poses at which nothing limits a quantity, so that it has no value there."""
    found: Any = None
    if may_be_unlimited(quantity):
        # what it would say may be refused there, or depend on more than the pose
        with suppress(AssemblyError, UntracedError), unwarned(), np.errstate(all="ignore"):
            found = quantity.unlimited(motion)
    return np.asarray(np.broadcast_to(False if found is None else found, motion.shape), bool)


# What a measure takes of its quantity at several poses.


def check_no_worst(leaf: Leaf) -> None:
    """Raise DefinitionError for a leaf that is over another stroke."""
    what = "a study of tolerances looks at the strokes it is given"
    ensure(not isinstance(leaf.quantity, Worst), f"{leaf}: {what}; take most(...) over a grid of both strokes.")


def extreme_of(leaf: Leaf) -> np.ufunc:
    """Return NumPy's function for the greatest or least value, NaN where one is; DefinitionError for one over another stroke."""
    check_no_worst(leaf)
    return np.minimum if leaf.sense < 0.0 else np.maximum
