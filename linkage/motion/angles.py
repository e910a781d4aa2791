"""What follows from directions: nodes worked out again where an angle is continued past half a turn along the stroke."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..plan import Plan
from ..program import QUICKEST, FloatArray, Kernel, Level, Node, Way, ancestors, interpret
from .grid import Grid


@dataclass(frozen=True, eq=False)
class Angles:
    """Some nodes, the moving angles behind them, and the kernel of these."""

    nodes: tuple[Node, ...]
    angles: tuple[Node, ...]
    kernel: Kernel

    def continued(self, grid: Grid, way: Way = QUICKEST) -> FloatArray | None:
        """Return the nodes' values, shape (nodes, ...), with angles that do not jump; None where none of them does."""
        if not self.angles:
            return None
        raw = grid.full(self.kernel(grid.flat, way=way).values)
        joined = grid.joined(raw, self.kernel)
        if not np.any((joined != raw) & np.isfinite(joined)):
            return None
        known: dict[Node, Any] = dict(zip(self.angles, joined, strict=True))
        return np.array([np.broadcast_to(each, grid.shape) for each in interpret(self.nodes, grid.inputs, known)], float)


def angles_of(plan: Plan, nodes: Sequence[Node]) -> Angles:
    """Return nodes of a plan's program with the moving angles behind them."""
    behind = set(ancestors(nodes))
    angles = tuple(angle for angle in dict.fromkeys(plan.trace.angles) if angle in behind and angle.level is Level.POSE)
    return Angles(tuple(nodes), angles, Kernel(angles))
