"""What follows from directions: nodes worked out again where an angle is continued past half a turn along the stroke."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
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
            raw = to_rounding(raw, at_end, self.kernel.plan.outputs, grid.inputs_at(at_end))
        joined = grid.joined(raw, self.kernel)
        if not np.any((joined != raw) & np.isfinite(joined)):
            return None
        known: dict[Node, Any] = dict(zip(self.angles, joined, strict=True))
        found = np.array([np.broadcast_to(each, grid.shape) for each in interpret(self.nodes, grid.inputs, known)], float)
        if at_end.any():
            there = {angle: values[at_end] for angle, values in zip(self.angles, joined, strict=True)}
            found = to_rounding(found, at_end, self.nodes, grid.inputs_at(at_end), there)
        return found


def to_rounding(
    values: FloatArray, at_end: Mask, nodes: Sequence[Node], inputs: Mapping[str, Any], known: Mapping[Node, Any] | None = None
) -> FloatArray:
    """Return the values (nodes, ...) of some nodes with those put right of the poses `at_end`, which stand at a dead point to rounding.

    `inputs` and the values that are `known` are those of these poses, floats or (n,).
    """
    found = np.array(values)
    for row, value in enumerate(interpret(nodes, inputs, known, clipped=True)):
        found[row, at_end] = value
    return found


def angles_of(plan: Plan, nodes: Sequence[Node]) -> Angles:
    """Return nodes of a plan's program with the moving angles behind them."""
    behind = set(ancestors(nodes))
    angles = tuple(angle for angle in dict.fromkeys(plan.trace.angles) if angle in behind and angle.level is Level.POSE)
    return Angles(tuple(nodes), angles, Kernel(angles))
