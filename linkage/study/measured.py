"""Quantities of many designs at the poses of one motion: outputs and requests in one kernel, functions of a motion beside them."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import field
from functools import cached_property
from itertools import pairwise
from math import prod
from typing import Any, TypeAlias

import numpy as np

from ..errors import AssemblyError, DefinitionError, UntracedError, cited, ensure, errors_of, unwarned
from ..frozen import immutable
from ..mechanism import Mechanism
from ..motion import Grid, Motion, Request, at_values, each_at_its_stroke, evaluate_grid, stroke_display_unit
from ..motion.grid import JoinedTo
from ..motion.measures import At, Integral, Leaf, Measure, bound_quantity, strokes_behind, traced, words_of
from ..motion.requests import may_be_unlimited
from ..numeric.line import Index
from ..numeric.quadrature import PANELS, gauss, quadrature
from ..plan import Mask, Plan
from ..program import FloatArray, RunOptions
from ..quantities import Quantity
from ..units import show
from .checks import check_one_design

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
        found = evaluate_grid(self.grid_at(machine, poses), requests, None, way, "nan")
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
        total: float | FloatArray = fold_start(leaf)
        for column in self.values(machine, leaf.quantity, way).T:
            total = fold(leaf, total, column)
        return np.asarray(total)

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
        moving = [value for value in self.stroke_values.values() if np.ptp(value) > 0.0]
        turns = [*range(self.pose_count)] if moving else [0, self.pose_count - 1]
        if len(moving) == 1:  # the first pose, those at which the way turns, and the last
            changes = np.diff(moving[0])
            steps = np.flatnonzero(changes)
            signs = np.sign(changes[steps])
            turns = [0, *steps[1:][signs[1:] != signs[:-1]].tolist(), self.pose_count - 1]
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


# What a measure takes of its quantity, pose by pose.


def check_no_worst(leaf: Leaf) -> None:
    """Raise DefinitionError for a leaf that is over another stroke."""
    what = "a study of tolerances looks at the strokes it is given"
    ensure(not leaf.worst_over, f"{leaf}: {what}; take most(...) over a grid of both strokes.")


def fold_start(leaf: Leaf) -> float:
    """Return the start value of an extreme before the first pose; DefinitionError for one over another stroke."""
    check_no_worst(leaf)
    return np.inf if leaf.sense < 0.0 else -np.inf


def fold(leaf: Leaf, total: Any, values: FloatArray) -> FloatArray:
    """Return an extreme after one more pose; NaN where one of them has no value."""
    best = np.minimum if leaf.sense < 0.0 else np.maximum
    return np.asarray(best(total, values, out=total if isinstance(total, np.ndarray) else None))
