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
from .scene import Places, Scene, SlideTrack
from .shapes import BLOCK, left_of, polar
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

HEIGHT, BASE = 3.2, 1.9
"""The triangle's height and half its base, in sizes."""
HATCH = 0.9
"""The depth of the hatching of ground and rails, in sizes."""


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


def hatched(scene: Scene) -> list[FloatArray]:
    """Return for each piece of a fixed rail its line and then its hatches, shape (n, 2, 2) [m]; it leaves room for pins on its way."""
    if not scene.reached:
        return []
    at = scene.at(scene.reached[0])
    pins = [at[name] for name in scene.grounds]
    found = []
    for track in scene.tracks:
        if track.fixed:
            start, end = at[track.ends[0]], at[track.ends[1]]
            found += rail(start, end, side_of_rail(scene, track, end - start), pins, scene.size)
    return found


def side_of_rail(scene: Scene, track: SlideTrack, along: FloatArray) -> FloatArray:
    """Return the direction from a track to its rail: below, or to the right; on the other side where all that rides hangs down there."""
    below = np.array([along[1], -along[0]]) / (np.hypot(*along) or 1.0)
    below = -below if below[1] > 1e-6 or (abs(below[1]) <= 1e-6 and below[0] < 0.0) else below
    carried = [(rider, name) for rider in track.riders for points in scene.bodies if rider in points for name in points if name != rider]
    hanging = [float((at[name] - at[rider]) @ below) > BLOCK * scene.size for at in scene.some(5) for rider, name in carried]
    return -below if hanging and all(hanging) else below


def rail(start: FloatArray, end: FloatArray, below: FloatArray, pins: list[FloatArray], size: float) -> list[FloatArray]:
    """Return the pieces of a rail on a side of its track, each a line and its hatches; none where a pin's support stands in its way."""
    long = float(np.hypot(*(end - start)))
    along = (end - start) / (long or 1.0)
    base, hatch, room = start + BLOCK * size * below, HATCH * size, 1.6 * BASE * size
    stops = sorted(float((pin - start) @ along) for pin in pins if -size < (pin - start) @ below < 4.0 * size)
    stops = [stop for stop in stops if -room < stop < long + room]
    starts = [0.0, *(stop + room for stop in stops)]
    ends = [*(stop - room for stop in stops), long]
    found = []
    for first, last in zip(starts, ends, strict=True):
        if last - first > 2.0 * hatch:
            places = np.arange(first, last - hatch, 1.1 * hatch)
            line = (base + first * along, base + last * along)
            found.append(np.array([line, *((base + (s + hatch) * along, base + s * along + hatch * below) for s in places)]))
    return found
