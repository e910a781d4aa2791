"""What follows from directions: nodes worked out again where an angle is continued past half a turn along the stroke."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..plan import Plan
from ..program import QUICKEST, FloatArray, Kernel, Level, Node, Way, ancestors, interpret
from .grid import Grid
from .reach import Mask


@dataclass(frozen=True, eq=False)
class Angles:
    """Some nodes, the moving angles behind them, and the kernel of these."""

    nodes: tuple[Node, ...]
    angles: tuple[Node, ...]
    kernel: Kernel

    def continued(self, grid: Grid, reached: Mask | None = None, way: Way = QUICKEST) -> FloatArray | None:
        """Return the nodes' values, shape (nodes, ...), with angles that do not jump; None where none of them does.

        `reached` are the poses that have a place, of which some may stand at a dead point to rounding.
        """
        if not self.angles:
            return None
        raw = grid.full(self.kernel(grid.flat, way=way).values)
        at_end = np.zeros(grid.shape, bool) if reached is None else reached & ~np.isfinite(raw).all(axis=0)
        if at_end.any():
            raw = to_rounding(self.kernel, grid, at_end, raw)
        joined = grid.joined(raw, self.kernel)
        if not np.any((joined != raw) & np.isfinite(joined)):
            return None
        known: dict[Node, Any] = dict(zip(self.angles, joined, strict=True))
        found = np.array([np.broadcast_to(each, grid.shape) for each in interpret(self.nodes, grid.inputs, known)], float)
        if at_end.any():
            there = {angle: values[at_end] for angle, values in zip(self.angles, joined, strict=True)}
            for row, value in enumerate(interpret(self.nodes, grid.inputs_at(at_end), there, clipped=True)):
                found[row, at_end] = value
        return found


def to_rounding(kernel: Kernel, grid: Grid, at_end: Mask, values: FloatArray) -> FloatArray:
    """Return the values (outputs, ...) of a kernel with those of poses put right that stand at a dead point to rounding."""
    found = np.array(values)
    for row, value in enumerate(interpret(kernel.plan.outputs, grid.inputs_at(at_end), clipped=True)):
        found[row, at_end] = value
    return found


def angles_of(plan: Plan, nodes: Sequence[Node]) -> Angles:
    """Return nodes of a plan's program with the moving angles behind them."""
    behind = set(ancestors(nodes))
    angles = tuple(angle for angle in dict.fromkeys(plan.trace.angles) if angle in behind and angle.level is Level.POSE)
    return Angles(tuple(nodes), angles, Kernel(angles))
