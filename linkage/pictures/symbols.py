"""Parts of the picture: artists made once and moved from pose to pose; ground symbols, slots and rails."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.patches import Polygon

from ..program import FloatArray
from . import style
from .labels import LED, MINOR, distance_to_box, half_of
from .layout import BASE, HATCH, hatched
from .scene import Places, Scene
from .shapes import left_of, polar
from .sheet import Keywords, haloed_beside
from .style import Look


class MovingPart(ABC):
    """Artists that follow some points. They hide where one of these is not reached."""

    points: tuple[str, ...]
    artists: Sequence[Artist]

    def update(self, at: Places) -> None:
        """Move to a pose."""
        there = all(np.isfinite(at[name]).all() for name in self.points)
        for artist in self.artists:
            artist.set_visible(there)
        if there:
            self.move(at)

    @abstractmethod
    def move(self, at: Places) -> None:
        """Move to a pose at which all points are reached."""


def polygon(ax: Axes, level: float, **options: Any) -> Polygon:
    """Return a polygon on the axes in a layer; its corners are set when it is moved."""
    patch = Polygon(np.zeros((1, 2)), zorder=level, **options)
    ax.add_patch(patch)
    return patch


def arrow_between(
    ax: Axes, start: FloatArray, end: FloatArray, colour: str, head: float, level: float, *, width: float = 1.4, clip: bool | None = None
) -> None:
    """Draw an arrow from a place to another [m], with a head of a size and a line of a width [points]."""
    look = {"arrowstyle": "-|>", "color": colour, "linewidth": width, "mutation_scale": head, "shrinkA": 0, "shrinkB": 0}
    ax.annotate("", tuple(end.tolist()), xytext=tuple(start.tolist()), zorder=level, annotation_clip=clip, arrowprops=look)


# Pins on the frame: a triangle on hatched ground.

HEIGHT = 3.2
"""The triangle's height, in sizes."""


def ground(ax: Axes, pin: FloatArray, way: float, size: float, look: Look) -> None:
    """Draw the frame under a pin, on the side of a direction [rad]: a triangle, its base line and hatches. It never moves."""
    hatches = [((HEIGHT, aside + HATCH), (HEIGHT + HATCH, aside)) for aside in np.linspace(-1.4 * BASE, 1.4 * BASE - HATCH, 6)]
    axes = size * np.array([polar(way), left_of(polar(way))])
    lines = pin + np.array([((HEIGHT, -1.4 * BASE), (HEIGHT, 1.4 * BASE)), *hatches]) @ axes
    corners = pin + np.array([(0.0, 0.0), (HEIGHT, BASE), (HEIGHT, -BASE)]) @ axes
    ink, fill, level = look.colour(style.INK), look.colour(style.ROD), look.level - 0.5
    ax.add_patch(Polygon(corners, facecolor=fill, edgecolor=ink, linewidth=style.OUTLINE, joinstyle="round", zorder=level))
    ax.add_collection(LineCollection(list(lines), colors=ink, linewidths=style.THIN, zorder=level), autolim=False)


# Sliding: slots on moving bodies, and fixed rails with their hatching.


def rails(ax: Axes, scene: Scene, look: Look) -> None:
    """Draw the fixed rails. They never move."""
    colour = look.colour(style.INK)
    for lines in hatched(scene):
        widths = [1.6 * style.OUTLINE, *[style.THIN] * (len(lines) - 1)]
        ax.add_collection(LineCollection(list(lines), colors=colour, linewidths=widths, zorder=look.level - 0.6), autolim=False)


# Points' names.


class LabelPart(MovingPart):
    """A point's name at an offset [points], joined to the point by a thin line where it stands away from it."""

    def __init__(
        self, ax: Axes, name: str, offset: FloatArray, gap: float, look: Look, minor: bool = False, font: float = style.LABEL,
        text: str = "",
    ) -> None:  # fmt: skip
        self.points, text = (name,), text or name
        font = font * (MINOR if minor else 1.0)
        leader = {"arrowstyle": "-", "color": look.colour(style.MUTED), "linewidth": 0.8, "shrinkA": 0.0, "shrinkB": 0.6 * gap}
        self.is_led = bool(distance_to_box(offset, half_of(text, font)) > LED * gap)
        colour = look.colour(style.MUTED if minor else style.INK)
        more: Keywords = {"ha": "center", "fontstyle": "italic", "zorder": look.level + 1.0}
        more["bbox"] = {"boxstyle": "square,pad=0.05", "facecolor": "none", "edgecolor": "none"}
        more["arrowprops"] = leader if self.is_led else None
        self.text = haloed_beside(ax, text, np.zeros(2), offset, font, colour, **more)
        self.artists = (self.text,)

    def move(self, at: Places) -> None:
        x, y = at[self.points[0]]
        self.text.xy = (float(x), float(y))
