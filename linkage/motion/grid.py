"""Designs and strokes as a grid of poses: its shapes, the inputs of the program on it, and how angles go on over it."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping, Sequence
from functools import cached_property
from hashlib import blake2b
from math import prod
from types import MappingProxyType
from typing import Any, NamedTuple, Protocol, Self, TypeAlias, TypeVar, cast

import numpy as np

from ..assembly import NONE_SOLVED, GroupSolution, solve_groups, with_angles
from ..errors import DefinitionError
from ..frozen import FrozenDict, immutable, read_only
from ..loads import Poses
from ..plan import ArrayReading, Mask, Plan
from ..program import QUICKEST, FloatArray, Kernel, Level, Node, Result, RunOptions, ancestors, interpret
from ..vectors import Numbers
from .instants import Instants

Made = TypeVar("Made")


class Grid:
    """Designs times strokes. Arrays are component-first, designs before strokes.

    `strokes` are arrays of one shape; with `per_design` this begins with that of the designs, or with ones in its place, and each
    design has strokes of its own.
    `joining` says how angles are made continuous. `rate_inputs` are the rates and accelerations of strokes by the names of their
    inputs, shaped as the strokes; without them nothing moves.
    """

    def __init__(
        self,
        plan: Plan,
        designs: Mapping[str, Numbers],
        strokes: Mapping[str, FloatArray],
        *,
        per_design: bool = False,
        joining: Joining | None = None,
        rate_inputs: Mapping[str, FloatArray] = MappingProxyType({}),
    ) -> None:
        self.plan, self.per_design = plan, per_design
        self.designs: FrozenDict[str, Any] = designs if type(designs) is FrozenDict else FrozenDict(designs)
        self.strokes: FrozenDict[str, FloatArray] = FrozenDict({name: read_only(value) for name, value in strokes.items()})
        self._is_plain = self.designs.is_of_floats
        self._varying = () if self._is_plain else tuple([name for name, value in self.designs.items() if varies(value)])
        arrays = [np.shape(self.designs[name]) for name in self._varying]
        try:
            self.design_shape = np.broadcast_shapes(*arrays) if arrays else ()
        except ValueError:
            shapes = ", ".join(map(str, arrays))
            raise DefinitionError(f"{plan.title}: the shapes of the design arrays do not fit each other: {shapes}.") from None
        if per_design:  # arrays begin with the shape of the designs
            own = self.design_shape
            try:
                full = {name: np.broadcast_to(value, (*own, *value.shape[len(own) :])) for name, value in strokes.items()}
            except ValueError:
                name, value = next(iter(strokes.items()))
                what = f"the strokes of each design begin with the shape of the designs, {own}; {name} has the shape {value.shape}"
                remedy = "Strokes that all designs share are given without per_design=True"
                raise DefinitionError(f"{plan.title}: {what}. {remedy}.") from None
            self.strokes = FrozenDict({name: read_only(value) for name, value in full.items()})
        shape: tuple[int, ...] = ()
        for value in self.strokes.values():
            shape = value.shape
        self.stroke_shape = shape[len(self.design_shape) :] if per_design else shape
        self.shape = (*self.design_shape, *self.stroke_shape)
        self.size = prod(self.design_shape), prod(self.stroke_shape)  # the number of designs and of poses of each
        self.joins_itself, self.joining = joining is None, joining or joined_by_stroke
        self._angles: dict[Kernel, FloatArray] = {}
        self.rate_inputs = FrozenDict({name: read_only(np.broadcast_to(value, shape)) for name, value in rate_inputs.items()})
        self._of_poses = FrozenDict({**self.strokes, **self.rate_inputs}) if rate_inputs else self.strokes
        self._is_pose = self._is_plain and not plan.solved and all([value.size == 1 for value in self.strokes.values()])

    @cached_property
    def flat_strokes(self) -> dict[str, FloatArray]:
        """The strokes as a kernel takes them: (n,), or (m, n) where each design has its own."""
        return self._flat_of(self.strokes)

    def _flat_of(self, values: Mapping[str, FloatArray]) -> dict[str, FloatArray]:
        """Return numbers of the poses as a kernel takes them."""
        return {name: value.reshape(self.size) if self.per_design else value.reshape(-1) for name, value in values.items()}

    @cached_property
    def flat_designs(self) -> dict[str, Any]:
        """The dimensions as a kernel takes them: floats, or arrays (m,)."""
        shape = self.design_shape
        if self._is_plain:
            return self.designs
        given, varying = self.designs.items(), self._varying
        return {name: np.broadcast_to(value, shape).ravel() if name in varying else float(value) for name, value in given}

    @cached_property
    def flat(self) -> dict[str, Any]:
        """The inputs as a kernel takes them: designs (m,), poses (n,) or (m, n)."""
        return {**self.unsolved, **self.solved.inputs} if self.plan.solved else self.unsolved

    @cached_property
    def unsolved(self) -> dict[str, Any]:
        """The same without what is solved by iteration."""
        return {**(self.designs if self._is_plain else self.flat_designs), **self._flat_of(self._of_poses)}

    @cached_property
    def solved(self) -> GroupSolution:
        """The pins of groups and the references of followed angles, shape (m, n)."""
        if not self.plan.solved:
            return NONE_SOLVED
        groups = NONE_SOLVED
        if self.plan.groups:
            groups = self._each() if self.per_design else solve_groups(self.plan, self.flat_designs, self.flat_strokes)
        return with_angles(groups, self.plan, self.flat_designs, self.flat_strokes)

    @property
    def crossed(self) -> FloatArray:
        """The number, from 1 on, of a group whose pins reach a pose only through a change point; 0 where none does."""
        return np.asarray(self.full(self.solved.crossed[None].astype(float))[0])

    def _each(self) -> GroupSolution:
        """Return the pins of groups where each design has strokes of its own: followed design by design."""
        m, n = self.size
        found = [
            solve_groups(
                self.plan,
                {name: value[place : place + 1] if varies(value) else value for name, value in self.flat_designs.items()},
                {name: value[place] for name, value in self.flat_strokes.items()},
            )
            for place in range(m)
        ]
        inputs = {name: np.concatenate([np.broadcast_to(each.inputs[name], (1, n)) for each in found]) for name in found[0].inputs}
        return GroupSolution(inputs, np.concatenate([np.broadcast_to(each.crossed, (1, n)) for each in found]))

    @cached_property
    def inputs(self) -> dict[str, Any]:
        """The inputs shaped to broadcast against results: designs first, strokes last."""
        tail = (1,) * len(self.stroke_shape)
        designs = self.designs.items()
        shaped = {
            name: np.reshape(value, np.shape(value) + tail) if name in self._varying else np.float64(value) for name, value in designs
        }
        solved = {name: self.full(value[None])[0] for name, value in self.solved.inputs.items()}
        found = {**shaped, **self._of_poses, **solved}
        return FrozenDict({name: read_only(value) if isinstance(value, np.ndarray) else value for name, value in found.items()})

    def run(self, kernel: Kernel) -> tuple[FloatArray, bool]:
        """Return a kernel's values on the grid, shape (outputs, ...), and whether all its guards are above zero everywhere.

        One pose of one design goes straight to the program in floats: there the way through arrays would cost more than the pose.
        """
        if self._is_pose:
            row, count = kernel.floats.pose_values(self.designs, self._of_poses), len(kernel.plan.outputs)
            values = np.array(row[:count])
            return values.reshape((count, *self.shape)) if self.shape else values, all([guard > 0.0 for guard in row[count:]])
        result = self.kernel_result(kernel)
        return self.full(result.values), result.is_clear

    def kernel_result(self, kernel: Kernel, out: FloatArray | None = None, way: RunOptions = QUICKEST) -> Result:
        """Return a kernel's result here, shape (outputs, m, n); pins and references are solved only for one that reads them."""
        reads_solved = not self.plan.solved_names.isdisjoint(kernel.plan.input_names[1])
        return kernel(self.flat if reads_solved else self.unsolved, out, way, self.size)

    def kernel_values(self, kernel: Kernel, way: RunOptions = QUICKEST) -> FloatArray:
        """Return a kernel's values here, shape (outputs, ...)."""
        return self.full(self.kernel_result(kernel, way=way).values)

    def full(self, values: FloatArray) -> FloatArray:
        """Return a kernel's values in the grid's shape."""
        if values.shape[1:] != self.size:
            values = np.broadcast_to(values, (len(values), *self.size))
        return values.reshape(len(values), *self.shape)

    def inputs_at(self, mask: Mask) -> dict[str, FloatArray]:
        """Return the inputs at some poses, shape (n,); one number where all have it."""
        return {name: np.broadcast_to(value, self.shape)[mask] if value.ndim else value for name, value in self.inputs.items()}

    def read_at(self, mask: Mask) -> ArrayReading:
        """Return the eager reading of some poses."""
        with np.errstate(all="ignore"):
            return self.plan.read(self.inputs_at(mask))

    # -- angles --------------------------------------------------------------------------------------------

    def angles(self, kernel: Kernel) -> FloatArray:
        """Return the angles of a kernel here [rad], without jumps; kept."""
        if kernel not in self._angles:
            self._angles[kernel] = self.joining(self, self.kernel_values(kernel), kernel)
        return self._angles[kernel]


def varies(value: Any) -> bool:
    """Return whether a dimension differs from design to design."""
    return type(value) is not float and np.ndim(value) > 0


class MotionLike(Poses, Protocol):
    """A motion as limits, conditions and requests read it, which `Motion` itself imports; see `Motion`."""

    plan: Plan
    _grid: Grid
    _design_shape: tuple[int, ...]
    _instants: Instants | None
    unreachable: str
    _kept: dict[Hashable, Any]

    @property
    def reached(self) -> Mask: ...
    @property
    def designs(self) -> FrozenDict[str, Any]: ...
    @property
    def strokes(self) -> Mapping[str, FloatArray]: ...
    @property
    def _reading(self) -> ArrayReading: ...
    @property
    def _joints(self) -> tuple[str, ...]: ...
    @property
    def _loop_sines(self) -> Mapping[str, Any]: ...
    def __getitem__(self, name: Any) -> FloatArray: ...
    def _requested(self, request: Any) -> FloatArray: ...
    def _finite(self, values: FloatArray, excused: Mask, what: str) -> FloatArray: ...
    def moved(self, strokes: Mapping[str, Any]) -> Self: ...
    def transmission_angle(self, point: str) -> FloatArray: ...


# How angles are made continuous over a grid.

Joining: TypeAlias = Callable[[Grid, FloatArray, Kernel], FloatArray]
"""How angles (k, ...) [rad] that a kernel gives on a grid are made continuous."""


def joined_by_stroke(grid: Grid, angles: FloatArray, kernel: Kernel) -> FloatArray:
    """Return angles without jumps along the strokes, whatever the order of the poses."""
    strokes = list(grid.strokes.values()) if grid.stroke_shape else []
    return np.array([unwrapped(angle, strokes, len(grid.stroke_shape)) for angle in angles])


def joined_in_order(grid: Grid, angles: FloatArray, kernel: Kernel) -> FloatArray:
    """Return angles without jumps in the order of the poses."""
    return np.array([unwrapped(angle, [], len(grid.stroke_shape)) for angle in angles])


def not_joined(grid: Grid, angles: FloatArray, kernel: Kernel) -> FloatArray:
    """Return angles within 180 deg of zero."""
    return angles


@immutable
class JoinedTo:
    """Angles within 180 deg of those of poses that are known: of `like`, by their number `near`, an array that fits the grid's poses.

    The poses that are known belong to the same designs, or to a single one.
    """

    like: Grid
    near: Any

    def __call__(self, grid: Grid, angles: FloatArray, kernel: Kernel) -> FloatArray:
        near = np.broadcast_to(self.near, grid.shape)
        known = self.like.angles(kernel).reshape(len(angles), *self.like.design_shape, -1)
        if self.like.design_shape:
            near = np.broadcast_to(near.reshape(*grid.design_shape, -1), (len(angles), *grid.design_shape, grid.size[1]))
            others = np.take_along_axis(known, near, axis=-1).reshape(angles.shape)
        else:
            others = known[:, near]
        found: FloatArray = angles + 2.0 * np.pi * np.nan_to_num(np.round((others - angles) / (2.0 * np.pi)))
        return found


def unwrapped(angle: FloatArray, strokes: Sequence[FloatArray], axes: int) -> FloatArray:
    """Return an angle [rad] without jumps of 2 pi along its last axes, `axes` of them, those of its poses.

    Along one stroke, whose array has the shape (poses,) or (*designs, poses), poses are joined in the order of its values, whatever the
    order they stand in; of several strokes, or none, in the order they stand in. NaN is passed over.
    """
    result = np.array(angle, float)
    if result.size and result.max() - result.min() < np.pi:  # no two of them are half a turn apart
        return result
    if len(strokes) == 1 and axes == 1:
        order = np.broadcast_to(np.argsort(strokes[0], axis=-1, kind="stable"), result.shape)
        joined = _joined(np.take_along_axis(result, order, axis=-1))
        return np.take_along_axis(joined, np.argsort(order, axis=-1, kind="stable"), axis=-1)
    for axis in range(-axes, 0):
        result = np.moveaxis(_joined(np.moveaxis(result, axis, -1)), -1, axis)
    return result


def _joined(angle: FloatArray) -> FloatArray:
    """Return the angle continued along its last axis from each finite value to the next."""
    if angle.shape[-1] < 2:
        return angle
    finite = np.isfinite(angle)
    places = np.where(finite, np.arange(angle.shape[-1]), 0)
    filled = np.take_along_axis(angle, np.maximum.accumulate(places, axis=-1), axis=-1)
    filled = np.where(np.isfinite(filled), filled, np.take_along_axis(angle, np.argmax(finite, axis=-1)[..., None], axis=-1))
    steps = np.diff(filled, axis=-1)
    turns = np.cumsum(np.round(np.where(np.isfinite(steps), steps, 0.0) / (2 * np.pi)), axis=-1)
    result = np.array(angle)
    result[..., 1:] -= 2 * np.pi * turns
    return result


# What follows from directions: nodes worked out again where an angle is continued past half a turn along the stroke.


class Angles(NamedTuple):
    """Some nodes, the moving angles behind them, and the kernel of these."""

    nodes: tuple[Node, ...]
    angles: tuple[Node, ...]
    kernel: Kernel

    def continued(self, grid: Grid, reached: Mask | None = None, way: RunOptions = QUICKEST) -> FloatArray | None:
        """Return the nodes' values, shape (nodes, ...), with angles that do not jump; None where none of them does.

        `reached` are the poses that have a place, of which some may stand at a dead point to rounding.
        """
        if not self.angles:
            return None
        raw = grid.kernel_values(self.kernel, way)
        at_end = np.zeros(grid.shape, bool) if reached is None else reached & ~np.isfinite(raw).all(axis=0)
        if at_end.any():
            raw = to_rounding(raw, at_end, self.kernel.plan.outputs, grid.inputs_at(at_end))
        joined = grid.joining(grid, raw, self.kernel)
        if not np.any((joined != raw) & np.isfinite(joined)):
            return None
        known: dict[Node, Any] = dict(zip(self.angles, joined, strict=True))
        found = np.array([np.broadcast_to(each, grid.shape) for each in interpret(self.nodes, grid.inputs, known)], float)
        if at_end.any():
            there = {angle: values[at_end] for angle, values in zip(self.angles, joined, strict=True)}
            found = to_rounding(found, at_end, self.nodes, grid.inputs_at(at_end), there)
        return found


def to_rounding(
    values: FloatArray, at_end: Mask, nodes: Sequence[Node], inputs: Mapping[str, Numbers], known: Mapping[Node, Any] | None = None
) -> FloatArray:
    """Return the values (nodes, ...) of some nodes with those put right of the poses `at_end`, which stand at a dead point to rounding.

    `inputs` and the values that are `known` are those of these poses, floats or (n,).
    """
    found = np.array(values)
    for row, value in enumerate(interpret(nodes, inputs, known, clipped=True)):
        found[row, at_end] = value
    return found


def angles_behind(plan: Plan, nodes: Sequence[Node]) -> tuple[Node, ...]:
    """Return the moving angles behind nodes of a plan's program."""
    behind = set(ancestors(nodes)) if plan.trace.angles else ()
    return tuple(angle for angle in dict.fromkeys(plan.trace.angles) if angle in behind and angle.level is Level.POSE)


def angles_of(plan: Plan, nodes: Sequence[Node]) -> Angles:
    """Return nodes of a plan's program with the moving angles behind them."""
    angles = angles_behind(plan, nodes)
    return Angles(tuple(nodes), angles, Kernel(angles))


RECENT = 256
"""What was looked for of single designs of a plan, and is kept: the searches of the last ones that were asked for."""


def recalled(motion: MotionLike, what: Hashable, make: Callable[[], Made], of_places: bool = False) -> Made:
    """Return a value that depends on one design, the strokes, their courses and `what` alone, cached; of a batch made each time.

    One `of_places` depends on the dimensions alone that points are worked out from: a bore or a load changes nothing of it.

    It is taken for what `make` returns anew: nothing in it may change, and nothing in it hangs on what was asked before.
    """
    if motion._design_shape or (not motion.designs.is_of_floats and any(map(varies, motion.designs.values()))):
        return make()
    known: dict[Hashable, Any] = motion.plan.made("recent", lambda _: {})
    strokes = tuple((name, value.shape, blake2b(value.tobytes(), digest_size=16).digest()) for name, value in motion.strokes.items())
    timed = None if motion._instants is None else motion._instants.content_key  # the same strokes passed otherwise have other forces
    named, plan = motion.designs.as_floats, motion.plan
    if of_places and not plan.solved:
        named = tuple([float(motion.designs[name]) for name in plan.kernel((*plan.points,), guarded=True).plan.input_names[0]])
    key = what, tuple(motion.designs), named, strokes, timed, motion._grid.per_design
    kept = known.get(key)  # another thread may throw it away meanwhile
    if kept is not None:
        return cast(Made, kept)
    found = known[key] = make()
    for old in list(known)[:-RECENT]:
        known.pop(old, None)
    return found
