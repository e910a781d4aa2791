"""Pins on the frame: a triangle on hatched ground."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.patches import Polygon

from ..program import FloatArray
from . import style
from .style import Look

HEIGHT, HALF, HATCH = 3.2, 1.9, 0.9
"""The triangle's height, half its base, and the depth of the hatching, in sizes."""


def ground(ax: Axes, pin: FloatArray, way: float, size: float, look: Look) -> None:
    """Draw the frame under a pin, on the side of a direction [rad]. It never moves."""
    corners, lines = support(pin, way, size)
    colour = look.colour(style.INK)
    level = look.level - 0.5
    fill = look.colour(style.ROD)
    ax.add_patch(Polygon(corners, facecolor=fill, edgecolor=colour, linewidth=style.OUTLINE, joinstyle="round", zorder=level))
    ax.add_collection(LineCollection(list(lines), colors=colour, linewidths=style.THIN, zorder=level), autolim=False)


def support(pin: FloatArray, way: float, size: float) -> tuple[FloatArray, FloatArray]:
    """Return the triangle, shape (3, 2), and the base line with its hatches, shape (n, 2, 2) [m]."""
    down, across = np.array([np.cos(way), np.sin(way)]), np.array([-np.sin(way), np.cos(way)])

    def place(along: float, aside: float) -> FloatArray:
        return np.asarray(pin + size * (along * down + aside * across))

    lines = [(place(HEIGHT, -1.4 * HALF), place(HEIGHT, 1.4 * HALF))]
    for aside in np.linspace(-1.4 * HALF, 1.4 * HALF - HATCH, 6):
        lines.append((place(HEIGHT, aside + HATCH), place(HEIGHT + HATCH, aside)))
    return np.array([pin, place(HEIGHT, HALF), place(HEIGHT, -HALF)]), np.array(lines)
