"""A mechanism on axes: all its parts, made once, moved from pose to pose."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import cycle
from typing import final

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Circle, Polygon

from ..motion import Motion
from ..program import FloatArray
from . import style
from .free_space import label_free, props
from .labels import LabelPart, offsets
from .scene import Places, Scene, Straight
from .shapes import rounded
from .sheet import points_a_metre, sheet
from .style import FAINT, STRONG, Look
from .symbols import CylinderPart, MovingPart, added, distance_and_direction, ground, polygon, rails, sliders


def mechanism(ax: Axes, motion: Motion, pose: int | tuple[int, ...] = 0, *, faint: bool = False) -> Drawing:
    """Return the mechanism drawn on axes at a pose of a motion; `update` moves it to another.

    The pose is an index into the strokes, an int for the flat one. Empty axes become a sheet with equal scales that
    has room for the whole motion. A faint mechanism has no names. At a pose out of reach only the frame is drawn.
    Raises DefinitionError for a batch of designs or a pose that is not there.
    """
    scene = Scene(motion)
    index = scene.index(pose)
    if not ax.has_data():
        sheet(ax, scene.box())
    drawing = Drawing(ax, scene, FAINT if faint else STRONG)
    drawing.ground()
    if not faint:
        drawing.label([scene.at(index)] if index in scene.reached else [])
    drawing.update(index)
    return drawing


@final
class Drawing:
    """The parts of a mechanism on some axes; `update` moves them to another pose."""

    def __init__(self, ax: Axes, scene: Scene, look: Look = STRONG) -> None:
        self.ax, self.scene, self.look = ax, scene, look
        hulls = zip(scene.hulls, cycle(style.BODIES), strict=False)
        self.parts: list[MovingPart] = [
            *(StraightPart(ax, each, look, -0.1) for each in scene.contours),
            *(BodyPart(ax, points, scene.size, colour, look) for points, colour in hulls),
            *sliders(ax, scene, look),
            *(CylinderPart(ax, ram, scene.size, look) for ram in scene.rams),
            *(StraightPart(ax, each, look) for each in scene.straights),
            *(StayPart(ax, ends, look) for ends in scene.stays),
            *(pin(ax, name, scene.size, look) for name in scene.pins),
            *(dot(ax, name, scene.size, look) for name in scene.dots),
        ]

    def ground(self) -> None:
        """Draw what never moves: the frame under its pins."""
        rails(self.ax, self.scene, self.look)
        at = self.scene.at(0)
        for name, way in props(self.scene).items():
            ground(self.ax, at[name], way, self.scene.size, self.look)

    def label(self, poses: Sequence[Places], keep_clear: Sequence[FloatArray] = ()) -> None:
        """Name the points; the names keep clear of the mechanism at all `poses` and of further points [m]."""
        size, scale = self.scene.size, points_a_metre(self.ax)
        clouds = [np.concatenate([points, *keep_clear]) for points in label_free(self.scene, poses)]
        spots = offsets(list(self.scene.places), poses, clouds, scale, 1.15 * size * scale + 1.5)
        self.parts += [LabelPart(self.ax, name, spot, self.look) for name, spot in spots.items()]

    def update(self, pose: int) -> None:
        """Move to a pose, a flat index."""
        at = self.scene.at(pose)
        for part in self.parts:
            part.update(at)

    @property
    def artists(self) -> list[Artist]:
        """All that moves, from the lowest layer up."""
        return sorted((artist for part in self.parts for artist in part.artists), key=lambda artist: artist.get_zorder())


# Rigid bodies: bars with round ends, plates with round corners.

@final
class BodyPart(MovingPart):
    """A body as the line around its outermost points, filled."""

    artists: tuple[Polygon, ...]

    def __init__(self, ax: Axes, points: tuple[str, ...], radius: float, colour: str, look: Look) -> None:
        plate = len(points) > 2
        self.points, self.radius = points, radius
        fill, edge = look.colour(colour), look.colour(style.mixed(colour, style.INK, 0.65))
        level = look.level + (0.0 if plate else 0.2)
        self.face = polygon(ax, level, facecolor=fill, edgecolor="none", alpha=0.55 if plate else 1.0)
        self.edge = polygon(ax, level + 0.1, fill=False, edgecolor=edge, linewidth=style.OUTLINE)
        self.artists = (self.face, self.edge)

    def move(self, at: Places) -> None:
        outline = rounded(np.array([at[name] for name in self.points]), self.radius)
        for artist in self.artists:
            artist.set_xy(outline)


# Springs, dampers and struts between two points, and the yokes of what stands beside its pins.

@final
class StraightPart(MovingPart):
    """A straight element from P to Q, or what a step draws of itself, as some lines."""

    artists: tuple[Polygon, ...]

    def __init__(self, ax: Axes, straight: Straight, look: Look, above: float = 0.5) -> None:
        self.straight, self.points = straight, (straight.P, straight.Q)
        line = {"edgecolor": look.colour(style.INK), "joinstyle": "round", "capstyle": "round"}
        self.artists = tuple(
            polygon(
                ax, look.level + above + 0.01 * layer, closed=each.closed, fill=bool(each.fill),
                facecolor=look.colour(getattr(style, each.fill or "PAPER")), linewidth=style.OUTLINE * (1.5 if each.bold else 0.8), **line,
            )
            for layer, each in enumerate(straight.lines)
        )  # fmt: skip

    def move(self, at: Places) -> None:
        P, Q = at[self.straight.P], at[self.straight.Q]
        length, along = distance_and_direction(P, Q)
        turned = np.array([along, [-along[1], along[0]]])
        for line, artist in zip(self.straight.lines, self.artists, strict=True):
            artist.set_xy(P + line.at(length) @ turned)


# Points: pins as circles, others as small dots, and the thin lines of a bare construction.

@final
class CirclePart(MovingPart):
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


@final
class StayPart(MovingPart):
    """Two points that a construction joins: a thin broken line."""

    def __init__(self, ax: Axes, ends: tuple[str, str], look: Look) -> None:
        self.points = ends
        self.line = ax.add_line(Line2D([], [], color=look.colour(style.MUTED), linewidth=style.OUTLINE, dashes=(5, 3), zorder=look.level))
        self.artists = (self.line,)

    def move(self, at: Places) -> None:
        self.line.set_data(*np.array([at[name] for name in self.points]).T)
