"""Paths of points: a dotted curve, an arrow for the direction."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes

from ..program import FloatArray
from . import style

CLOSED = 1e-6
"""A path whose ends are so near to each other, compared with its length, is closed."""


def trace(ax: Axes, path: FloatArray, label: str = "") -> None:
    """Draw the path of a point, shape (2, n) [m], from its first pose to its last; gaps where it is not reached."""
    ax.plot(*path, color=style.ACCENT, linewidth=1.6, linestyle=(0, (0.1, 1.9)), dash_capstyle="round", zorder=7.0, label=label or None)
    arrow = on_its_way(path)
    if arrow is not None:
        tail, head = arrow
        ax.annotate(
            "", tuple(head), xytext=tuple(tail), zorder=7.2,
            arrowprops={"arrowstyle": "-|>", "color": style.ACCENT, "linewidth": 0, "mutation_scale": 16, "shrinkA": 0, "shrinkB": 0},
        )  # fmt: skip


def on_its_way(path: FloatArray) -> tuple[FloatArray, FloatArray] | None:
    """Return two neighbouring points in the middle of a path's length, or None where it has none.

    Of a closed path they stand before it: there the middle pose is drawn, and a slider turns back.
    """
    steps = np.hypot(*np.diff(path))
    steps = np.where(np.isfinite(steps), steps, 0.0)
    if not steps.sum() > 0.0:
        return None
    is_closed = bool(np.hypot(*(path[:, -1] - path[:, 0])) < CLOSED * steps.sum())
    middle = int(np.searchsorted(np.cumsum(steps), (0.3 if is_closed else 0.5) * steps.sum()))
    while not steps[middle] > 0.0:
        middle += 1
    return path[:, middle], path[:, middle + 1]
