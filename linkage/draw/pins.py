"""Points: pins as circles, others as small dots, and the thin lines of a bare construction."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Circle

from . import style
from .part import Part, added
from .scene import Places
from .style import Look


class CirclePart(Part):
    """A point as a circle."""

    def __init__(self, ax: Axes, name: str, radius: float, fill: str, edge: str, width: float, level: float) -> None:
        self.points = (name,)
        self.circle = added(ax, Circle((0, 0), radius, facecolor=fill, edgecolor=edge, linewidth=width, zorder=level))
        self.artists = (self.circle,)

    def move(self, at: Places) -> None:
        x, y = at[self.points[0]]
        self.circle.set_center((x, y))


def pin(ax: Axes, name: str, size: float, look: Look) -> CirclePart:
    """Return a joint: a circle with a light centre."""
    return CirclePart(ax, name, 0.5 * size, style.PAPER, look.colour(style.INK), 1.3 * style.OUTLINE, look.level + 0.8)


def dot(ax: Axes, name: str, size: float, look: Look) -> CirclePart:
    """Return a point that is no joint: a small filled dot."""
    return CirclePart(ax, name, 0.48 * size, look.colour(style.INK), style.PAPER, style.THIN, look.level + 0.8)


class StayPart(Part):
    """Two points that a construction joins: a thin broken line."""

    def __init__(self, ax: Axes, ends: tuple[str, str], look: Look) -> None:
        self.points = ends
        self.line = ax.add_line(Line2D([], [], color=look.colour(style.MUTED), linewidth=style.OUTLINE, dashes=(5, 3), zorder=look.level))
        self.artists = (self.line,)

    def move(self, at: Places) -> None:
        self.line.set_data(*np.array([at[name] for name in self.points]).T)
