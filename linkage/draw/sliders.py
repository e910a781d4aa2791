"""Sliding: rails with their hatching, slots on moving bodies, and the blocks that slide along them."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.patches import Polygon

from ..program import FloatArray
from . import style
from .part import Part, added
from .scene import Places, Scene
from .shapes import rounded
from .style import Look

LONG, HALF, SLOT, HATCH = 2.1, 1.25, 0.7, 0.9
"""Half a block's length and width, half a slot's width, and the depth of the hatching, in sizes."""


class SlotPart(Part):
    """A slot on a moving body, open from end to end."""

    def __init__(self, ax: Axes, ends: tuple[str, str], size: float, look: Look) -> None:
        self.points, self.size = ends, size
        edge = look.colour(style.INK)
        self.face = added(
            ax, Polygon(np.zeros((1, 2)), facecolor=style.PAPER, edgecolor=edge, linewidth=style.OUTLINE, zorder=look.level + 0.3)
        )  # fmt: skip
        self.artists = (self.face,)

    def move(self, at: Places) -> None:
        self.face.set_xy(rounded(np.array([at[name] for name in self.points]), SLOT * self.size))


class BlockPart(Part):
    """A slider block: a box along its track."""

    def __init__(self, ax: Axes, rider: str, ends: tuple[str, str], half: float, size: float, look: Look) -> None:
        self.points, self.half, self.size = (rider, *ends), half, size
        fill, edge = look.colour(style.RULE), look.colour(style.INK)
        shape = Polygon(np.zeros((1, 2)), facecolor=fill, edgecolor=edge, linewidth=style.OUTLINE, joinstyle="round")
        shape.set_zorder(look.level + (0.17 if half == HALF else 0.32))
        self.face = added(ax, shape)
        self.artists = (self.face,)

    def move(self, at: Places) -> None:
        rider, start, end = (at[name] for name in self.points)
        self.face.set_xy(block(rider, start, end, self.half * self.size, self.size))


def block(rider: FloatArray, start: FloatArray, end: FloatArray, half: float, size: float) -> FloatArray:
    """Return a block's corners, shape (4, 2) [m]; `half` is half its width [m]."""
    u = (end - start) / np.hypot(*(end - start))
    along, across = LONG * size * u, half * np.array([-u[1], u[0]])
    return np.array([rider - along - across, rider + along - across, rider + along + across, rider - along + across])


def sliders(ax: Axes, scene: Scene, look: Look) -> list[Part]:
    """Return the slots and the blocks."""
    slots = [SlotPart(ax, track.ends, scene.size, look) for track in scene.tracks if not track.fixed]
    blocks = [BlockPart(ax, rider, track.ends, width(track.fixed), scene.size, look) for track in scene.tracks for rider in track.riders]
    return [*slots, *blocks]


def width(fixed: bool) -> float:
    """Return half a block's width, in sizes: in a slot it fits the slot."""
    return HALF if fixed else SLOT


def rails(ax: Axes, scene: Scene, look: Look) -> None:
    """Draw the fixed rails. They never move."""
    colour = look.colour(style.INK)
    for lines in hatched(scene):
        widths = [1.6 * style.OUTLINE, *[style.THIN] * (len(lines) - 1)]
        ax.add_collection(LineCollection(list(lines), colors=colour, linewidths=widths, zorder=look.level - 0.6), autolim=False)


def hatched(scene: Scene) -> list[FloatArray]:
    """Return for each fixed rail its line and then its hatches, shape (n, 2, 2) [m]."""
    if not scene.reached:
        return []
    at = scene.at(scene.reached[0])
    pins = [at[name] for name in scene.grounds]
    return [rail(at[track.ends[0]], at[track.ends[1]], pins, scene.size) for track in scene.tracks if track.fixed]


def rail(start: FloatArray, end: FloatArray, pins: list[FloatArray], size: float) -> FloatArray:
    """Return a rail's line under its blocks and its hatches: below the track, above where a pin stands on the track."""
    long = float(np.hypot(*(end - start)))
    along = (end - start) / long
    below = np.array([along[1], -along[0]])
    below = -below if below[1] > 1e-6 or (abs(below[1]) <= 1e-6 and below[0] < 0.0) else below
    held = [pin - start for pin in pins]
    if any(-2 * size < pin @ along < long + 2 * size and -size < pin @ below < 4 * size for pin in held):
        below = -below
    shift = HALF * size * below
    places = np.arange(0.0, long - HATCH * size, 1.1 * HATCH * size)
    lines = [(start + shift, end + shift)]
    lines += [(start + shift + (s + HATCH * size) * along, start + shift + s * along + HATCH * size * below) for s in places]
    return np.array(lines)
