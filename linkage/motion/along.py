"""Poses looked at again between those of a motion: each design at strokes of its own."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from math import prod
from typing import Any, Self

import numpy as np

from ..assembly import NONE_SOLVED, Solved, solve_groups, with_angles
from ..plan import Plan
from ..program import FloatArray, Kernel
from ..quantities import Angle, Reference
from .grid import varies
from .motion import Motion
from .outputs import OutputReading
from .peaks import Index
from .unwrap import unwrapped


class Along(Motion):
    """The poses of some designs at strokes (...) [SI], or with `own` at strokes (*designs, ...) of each its own; NaN out of reach.

    `tangent` says how the strokes go on along a path, in arrays like these. Angles lie within 180 deg of those of `like`, poses of
    the same designs, at its places `near`, an array like the strokes; without it they are continued in the order of the poses.
    """

    def __init__(
        self,
        plan: Plan,
        designs: Mapping[str, Any],
        strokes: Mapping[str, FloatArray],
        *,
        own: bool = False,
        tangent: Mapping[str, FloatArray] | None = None,
        like: Along | None = None,
        near: Index | None = None,
    ) -> None:
        self._own, self._tangent, self._like, self._near = own, tangent, like, near
        self._angles: dict[Kernel, FloatArray] = {}
        super().__init__(plan, designs, strokes, "nan")

    def _stroke_shape(self) -> tuple[int, ...]:
        return super()._stroke_shape()[len(self.design_shape) if self._own else 0 :]

    @property
    def tangent(self) -> Mapping[str, FloatArray] | None:
        return self._tangent

    def moved(self, strokes: Mapping[str, Any]) -> Self:
        """Return the same designs at other strokes [SI], each at its own where the arrays begin with the designs; NaN out of reach."""
        arrays = np.broadcast_arrays(*(np.asarray(strokes[name], float) for name in self.strokes))
        own = self._own and arrays[0].shape[: len(self.design_shape)] == self.design_shape
        return type(self)(self.plan, self.designs, dict(zip(self.strokes, arrays, strict=True)), own=own)

    # -- each design at its own --------------------------------------------------------------------------

    @cached_property
    def flat(self) -> dict[str, Any]:
        return super().flat | ({name: value.reshape(self.size) for name, value in self.strokes.items()} if self._own else {})

    @cached_property
    def solved(self) -> Solved:
        """The pins of groups, shape (m, n); where each design stands at strokes of its own they are followed design by design."""
        if not (self._own and self.plan.solved):
            return super().solved
        m, n = self.size
        shape = self.design_shape
        every = {name: np.broadcast_to(value, shape).ravel() if varies(value) else value for name, value in self.designs.items()}
        strokes = {name: value.reshape(m, n) for name, value in self.strokes.items()}
        return with_angles(self._grouped(m, n) if self.plan.groups else NONE_SOLVED, self.plan, every, strokes)

    def _grouped(self, m: int, n: int) -> Solved:
        """Return the pins of groups of m designs at n strokes of each its own."""
        found = []
        for place in range(m):
            designs = {name: np.broadcast_to(value, self.design_shape).ravel()[place : place + 1] if varies(value) else value
                       for name, value in self.designs.items()}  # fmt: skip
            found.append(solve_groups(self.plan, designs, {name: value.reshape(m, n)[place] for name, value in self.strokes.items()}))
        inputs = {name: np.concatenate([np.broadcast_to(each.inputs[name], (1, n)) for each in found]) for name in found[0].inputs}
        return Solved(inputs, np.concatenate([np.broadcast_to(each.crossed, (1, n)) for each in found]))

    # -- angles ------------------------------------------------------------------------------------------

    def joined(self, angles: FloatArray, kernel: Kernel) -> FloatArray:
        """Return the angles that a kernel gives [rad], within 180 deg of the other poses'."""
        if self._like is None:
            return np.array([self.in_order(angle) for angle in angles])
        return self.nearest(angles, self._like.angles(kernel))

    def angles(self, kernel: Kernel) -> FloatArray:
        """Return the angles of a kernel here [rad], without jumps; kept."""
        if kernel not in self._angles:
            self._angles[kernel] = self.joined(self.full(kernel(self.flat).values), kernel)
        return self._angles[kernel]

    def in_order(self, angle: FloatArray) -> FloatArray:
        """Return an angle [rad] without jumps in the order of the poses."""
        return unwrapped(angle, [np.empty(self.stroke_shape)] * 2)  # two: a single one would be sorted by its values

    def nearest(self, angle: FloatArray, known: FloatArray) -> FloatArray:
        """Return angles here (..., *designs, poses) [rad] turned to within 180 deg of those known at the other poses."""
        if self._like is None or self._near is None:
            return angle
        front = known.shape[: known.ndim - len(self._like.stroke_shape)]
        near = np.broadcast_to(self._near, self.shape).reshape(*self.design_shape, prod(self.stroke_shape))
        near = np.broadcast_to(near, (*front, near.shape[-1]))
        others = np.take_along_axis(known.reshape(*front, -1), near, axis=-1).reshape(angle.shape)
        return np.asarray(angle + 2.0 * np.pi * np.nan_to_num(np.round((others - angle) / (2.0 * np.pi))))

    @cached_property
    def _outputs(self) -> OutputReading:
        return AlongReading(self, self._like)


class AlongReading(OutputReading):
    """A reading of the outputs whose angles are continued as those of the poses are."""

    def __init__(self, motion: Along, like: Along | None) -> None:
        super().__init__(motion)
        self._motion, self._like = motion, like
        self.axes = [] if like else [np.empty(motion.stroke_shape)] * 2

    def value(self, quantity: Reference) -> Any:
        found, member = super().value(quantity), self.members[quantity] if isinstance(quantity, str) else quantity
        if self._like is None or not isinstance(member, Angle) or str(member) in self.inputs:
            return found
        return self._motion.nearest(np.broadcast_to(found, self.shape), np.broadcast_to(self._like.value(member), self._like.shape))
