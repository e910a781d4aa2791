"""Paths of points: a dotted curve, an arrow for the direction."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes

from ..program import FloatArray
from . import style


def trace(ax: Axes, path: FloatArray, label: str = "") -> None:
    """Draw the path of a point, shape (2, n) [m], from its first pose to its last; gaps where it is not reached."""
    ax.plot(*path, color=style.ACCENT, linewidth=1.6, linestyle=(0, (0.1, 1.9)), dash_capstyle="round", zorder=7.0, label=label or None)
    arrow = halfway(path)
    if arrow is not None:
        tail, head = arrow
        ax.annotate(
            "", tuple(head), xytext=tuple(tail), zorder=7.2,
            arrowprops={"arrowstyle": "-|>", "color": style.ACCENT, "linewidth": 0, "mutation_scale": 16, "shrinkA": 0, "shrinkB": 0},
        )  # fmt: skip


def halfway(path: FloatArray) -> tuple[FloatArray, FloatArray] | None:
    """Return two neighbouring points in the middle of a path's length, or None where it has none."""
    steps = np.hypot(*np.diff(path))
    steps = np.where(np.isfinite(steps), steps, 0.0)
    if not steps.sum() > 0.0:
        return None
    middle = int(np.searchsorted(np.cumsum(steps), 0.5 * steps.sum()))
    while not steps[middle] > 0.0:
        middle += 1
    return path[:, middle], path[:, middle + 1]
