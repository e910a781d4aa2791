"""Rigid bodies: bars with round ends, plates with round corners."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Polygon

from . import style
from .part import Part, added
from .scene import Places
from .shapes import rounded
from .style import Look


class BodyPart(Part):
    """A body as the line around its outermost points, filled."""

    def __init__(self, ax: Axes, points: tuple[str, ...], radius: float, colour: str, look: Look) -> None:
        plate = len(points) > 2
        self.points, self.radius = points, radius
        fill, edge = look.colour(colour), look.colour(style.mixed(colour, style.INK, 0.65))
        level = look.level + (0.0 if plate else 0.2)
        nowhere = np.zeros((1, 2))
        self.face = added(ax, Polygon(nowhere, facecolor=fill, edgecolor="none", alpha=0.55 if plate else 1.0, zorder=level))
        self.edge = added(ax, Polygon(nowhere, fill=False, edgecolor=edge, linewidth=style.OUTLINE, zorder=level + 0.1))
        self.artists = (self.face, self.edge)

    def move(self, at: Places) -> None:
        outline = rounded(np.array([at[name] for name in self.points]), self.radius)
        self.face.set_xy(outline)
        self.edge.set_xy(outline)
