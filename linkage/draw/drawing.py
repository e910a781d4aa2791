"""A mechanism on axes: all its parts, made once, moved from pose to pose."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import cycle

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes

from ..motion import Motion
from ..program import FloatArray
from . import room, style
from .bodies import BodyPart
from .cylinders import CylinderPart
from .elements import StraightPart
from .grounds import ground
from .labels import labels, offsets
from .part import Part
from .pins import StayPart, dot, pin
from .scene import Places, Scene
from .sheet import points_a_metre, sheet
from .sliders import rails, sliders
from .style import FAINT, STRONG, Look


class Drawing:
    """The parts of a mechanism on some axes; `update` moves them to another pose."""

    def __init__(self, ax: Axes, scene: Scene, look: Look = STRONG) -> None:
        self.ax, self.scene, self.look = ax, scene, look
        made = bodies, sliders, cylinders, points
        self.parts: list[Part] = [part for kind in made for part in kind(ax, scene, look)]

    def ground(self) -> None:
        """Draw what never moves: the frame under its pins."""
        rails(self.ax, self.scene, self.look)
        at = self.scene.at(0)
        for name, way in room.props(self.scene).items():
            ground(self.ax, at[name], way, self.scene.size, self.look)

    def label(self, poses: Sequence[Places], keep_clear: Sequence[FloatArray] = ()) -> None:
        """Name the points; the names keep clear of the mechanism at all `poses` and of further points [m]."""
        size, scale = self.scene.size, points_a_metre(self.ax)
        clouds = [np.concatenate([points, *keep_clear]) for points in room.taken(self.scene, poses)]
        self.parts += labels(self.ax, offsets(list(self.scene.places), poses, clouds, scale, 1.15 * size * scale + 1.5), self.look)

    def update(self, pose: int) -> None:
        """Move to a pose, a flat index."""
        at = self.scene.at(pose)
        for part in self.parts:
            part.update(at)

    @property
    def artists(self) -> list[Artist]:
        """All that moves, from the lowest layer up."""
        return sorted((artist for part in self.parts for artist in part.artists), key=lambda artist: artist.get_zorder())


def bodies(ax: Axes, scene: Scene, look: Look) -> list[Part]:
    """Return the moving bodies."""
    return [BodyPart(ax, points, scene.size, colour, look) for points, colour in zip(scene.hulls, cycle(style.BODIES), strict=False)]


def cylinders(ax: Axes, scene: Scene, look: Look) -> list[Part]:
    """Return the cylinders, and the straight elements in front of them."""
    rams = [CylinderPart(ax, ram, scene.size, look) for ram in scene.rams]
    return [*rams, *(StraightPart(ax, each, look) for each in scene.straights)]


def points(ax: Axes, scene: Scene, look: Look) -> list[Part]:
    """Return the pins, the dots and the lines of a bare construction."""
    pins = [pin(ax, name, scene.size, look) for name in scene.pins]
    dots = [dot(ax, name, scene.size, look) for name in scene.dots]
    return [*(StayPart(ax, ends, look) for ends in scene.stays), *pins, *dots]


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
