"""Springs, dampers and struts between two points, and the yokes of what stands beside its pins."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Polygon

from . import style
from .outlines import Outline
from .part import Part, added
from .scene import Places, Straight
from .style import Look


class StraightPart(Part):
    """A straight element from P to Q as some lines."""

    def __init__(self, ax: Axes, straight: Straight, look: Look) -> None:
        self.straight, self.points = straight, (straight.P, straight.Q)
        self.pieces = [(line, added(ax, self._piece(line, look.level + 0.5 + 0.01 * i, look))) for i, line in enumerate(straight.lines)]
        self.artists = tuple(piece for _, piece in self.pieces)

    @staticmethod
    def _piece(line: Outline, level: float, look: Look) -> Polygon:
        return Polygon(
            np.zeros((1, 2)), closed=line.closed, fill=bool(line.fill), facecolor=look.colour(getattr(style, line.fill or "PAPER")),
            edgecolor=look.colour(style.INK), linewidth=style.OUTLINE * (1.5 if line.bold else 0.8), joinstyle="round", capstyle="round",
            zorder=level,
        )  # fmt: skip

    def move(self, at: Places) -> None:
        P, Q = at[self.straight.P], at[self.straight.Q]
        length = float(np.hypot(*(Q - P)))
        along = (Q - P) / (length or 1.0)
        turned = np.array([along, [-along[1], along[0]]])
        for line, piece in self.pieces:
            piece.set_xy(P + line.at(length) @ turned)
