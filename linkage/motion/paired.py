"""One pose for each design: what a search over settings asks for."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from typing import Any

import numpy as np

from ..assembly import Solved, solve_groups
from ..frozen import FrozenDict, read_only
from ..plan import Plan
from ..program import FloatArray, Kernel
from ..quantities import Angle, Reference
from .motion import Motion
from .outputs import OutputReading


class Paired(Motion):
    """The poses of m designs, each at a stroke of its own; a position has the shape (2, m), what is out of reach is NaN.

    `designs` and `strokes` are floats or arrays (m,) [SI]. There is no stroke along which angles could be followed: they lie
    within 180 deg of those of the poses `at` (m,) of another motion, `like`, or of zero.
    """

    def __init__(
        self, plan: Plan, designs: Mapping[str, Any], strokes: Mapping[str, Any], like: Motion | None = None, at: Any = slice(None)
    ) -> None:
        self._like, self._at = like, at
        size = np.broadcast_shapes((1,), *(np.shape(value) for value in (*designs.values(), *strokes.values())))
        self._each = {name: np.broadcast_to(np.asarray(value, float), size) for name, value in strokes.items()}
        full = {name: np.broadcast_to(np.asarray(value, float), size) for name, value in designs.items()}
        super().__init__(plan, full, {name: np.zeros(()) for name in strokes}, "nan")
        self.strokes = FrozenDict({name: read_only(value) for name, value in self._each.items()})

    @cached_property
    def flat(self) -> dict[str, Any]:
        """The inputs as a kernel takes them: designs (m,), one pose of each (m, 1)."""
        return {**self.designs} | {name: value[:, None] for name, value in self._each.items()} | dict(self.solved.inputs)

    @cached_property
    def solved(self) -> Solved:
        """The pins of groups, shape (m, 1), found design by design."""
        if not self.plan.groups:
            return Solved({}, np.zeros((1, 1), bool))
        found = [solve_groups(self.plan, *self._of(place)) for place in range(self.design_shape[0])]
        inputs = {name: np.concatenate([np.broadcast_to(each.inputs[name], (1, 1)) for each in found]) for name in found[0].inputs}
        return Solved(inputs, np.concatenate([np.broadcast_to(each.crossed, (1, 1)) for each in found]))

    def _of(self, place: int) -> tuple[dict[str, FloatArray], dict[str, FloatArray]]:
        """Return one design and its stroke, as arrays (1,)."""
        of = slice(place, place + 1)
        return {name: value[of] for name, value in self.designs.items()}, {name: value[of] for name, value in self._each.items()}

    @cached_property
    def inputs(self) -> dict[str, Any]:
        """The inputs, shape (m,)."""
        return {**self.designs} | self._each | {name: self.full(value[None])[0] for name, value in self.solved.inputs.items()}

    def joined(self, angles: FloatArray, kernel: Kernel) -> FloatArray:
        """Return the angles that a kernel gives [rad], within 180 deg of the other motion's: there is no stroke to continue them along."""
        if self._like is None:
            return angles
        others = self._like.joined(self._like.full(kernel(self._like.flat).values), kernel)[:, self._at]
        return angles + 2.0 * np.pi * np.nan_to_num(np.round((others - angles) / (2.0 * np.pi)))

    @cached_property
    def _outputs(self) -> OutputReading:
        return PairedReading(self, self._like, self._at)


class PairedReading(OutputReading):
    """A reading of the outputs whose angles are within 180 deg of another motion's."""

    def __init__(self, motion: Paired, like: Motion | None, at: Any) -> None:
        super().__init__(motion)
        self.axes, self._like, self._at = [], like, at

    def value(self, quantity: Reference) -> Any:
        found, member = super().value(quantity), self.members[quantity] if isinstance(quantity, str) else quantity
        if self._like is None or not isinstance(member, Angle):
            return found
        turns = np.round((self._like.value(member)[self._at] - found) / (2.0 * np.pi))
        return found + 2.0 * np.pi * np.nan_to_num(turns)
