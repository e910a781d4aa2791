"""The stage of an animation: the mechanism and its live curve, drawn once and then moved."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt
from matplotlib.artist import Artist
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from ..draw import Drawing, strokes, style
from ..draw.limits import Limit
from ..draw.panel import panel, typeset
from ..draw.scene import Scene
from ..draw.sheet import sheet
from ..draw.traces import trace
from ..program import FloatArray
from .course import Course

WIDTH, HEIGHT = 9.6, 4.8
TITLE = 0.953
SHEET = (0.065, 0.115, 0.535, 0.775)
CURVE = (0.685, 0.115, 0.285, 0.775)
"""The figure [inch]; the height of the titles and the places of its two axes as shares of it."""

MOST = 9
"""Decimals that a value is shown with, at most."""


def untyped(canvas: Any) -> Any:
    """Return a canvas without its type: matplotlib declares none for these methods."""
    return canvas


class Stage:
    """A figure with a mechanism on the left and a live curve on the right; `frame` gives it at a pose."""

    def __init__(self, course: Course, paths: Sequence[str], bound: Sequence[Any] | Limit | None, dpi: int) -> None:
        self.course, self.scene = course, Scene(course.motion)
        self.figure = Figure(figsize=(WIDTH, HEIGHT), dpi=dpi, facecolor=style.PAPER)
        self.canvas = untyped(FigureCanvasAgg(self.figure))
        self.drawing = self._mechanism(paths)
        self.live = self._curve(bound)
        self.stroke = self.figure.text(SHEET[0] + SHEET[2], TITLE, "", fontsize=style.TITLE, color=style.INK, ha="right", va="center")
        self._remarks()
        for artist in self._moving:
            artist.set_animated(True)
        self.canvas.draw()
        self.still: Any = self.canvas.copy_from_bbox(self.figure.bbox)

    def _mechanism(self, paths: Sequence[str]) -> Drawing:
        """Return the mechanism on its sheet, with paths of points and names that keep their place beside their points."""
        ax = self.figure.add_axes(SHEET)
        sheet(ax, self.scene.box())
        for name in paths:
            trace(ax, self.scene.places[name])
        drawing = Drawing(ax, self.scene)
        drawing.ground()
        drawing.label(self.scene.some(9))
        self._title(SHEET[0], self.scene.motion.plan.heading)
        return drawing

    def _curve(self, bound: Sequence[Any] | None) -> tuple[Artist, ...]:
        """Return what is drawn anew on the curve, from the lowest layer up: the piece run through, the limit, a marker."""
        ax = self.figure.add_axes(CURVE)
        panel(ax, self.course.motion, self.course.column, bound, colour=style.RULE)
        ax.set_title("", loc="left")
        (self.run,) = ax.plot([], [], color=style.CURVE, linewidth=style.BOLD + 0.4, zorder=5.05, solid_capstyle="round")
        (self.marker,) = ax.plot([], [], "o", color=style.CURVE, markersize=9, markeredgecolor=style.PAPER, zorder=7.0, clip_on=False)
        self._title(CURVE[0], typeset(self.course.column.heading))
        self.value = self.figure.text(CURVE[0] + CURVE[2], TITLE, "", fontsize=style.TITLE, color=style.CURVE, ha="right", va="center")
        return tuple(sorted([*ax.lines, *ax.texts], key=lambda artist: artist.get_zorder()))

    def _remarks(self) -> None:
        """Write under the title the strokes that are held, and what is not reached."""
        motion = self.course.motion
        moving = strokes.driven(motion)
        held = strokes.held(motion.plan, motion.strokes, moving)
        texts = (
            (SHEET[0], f"at {held}" if held else "", style.MUTED, "left"),
            (SHEET[0] + SHEET[2], strokes.unreached(motion, moving), style.ACCENT, "right"),
        )
        for x, text, colour, side in texts:
            if text:
                self.figure.text(x, 0.91, text, fontsize=style.SMALL, color=colour, va="center", ha=side)

    def _title(self, left: float, text: str) -> None:
        self.figure.text(left, TITLE, text, fontsize=style.TITLE, fontweight="bold", color=style.INK, va="center")

    @property
    def _moving(self) -> list[Artist]:
        return [*self.drawing.artists, *self.live, self.stroke, self.value]

    def frame(self, pose: int) -> npt.NDArray[np.uint8]:
        """Return the picture at a pose, shape (height, width, 3)."""
        self.update(pose)
        self.canvas.restore_region(self.still)
        renderer = self.canvas.get_renderer()
        for artist in self._moving:
            artist.draw(renderer)
        return np.array(self.canvas.buffer_rgba())[..., :3]

    def update(self, pose: int) -> None:
        """Move everything to a pose."""
        motion, column = self.course.motion, self.course.column
        moving = strokes.driven(motion)
        along, shown = strokes.shown(motion.plan, moving, motion.strokes[moving]), column.drawn
        self.drawing.update(pose)
        self.run.set_data(along[: pose + 1], shown[: pose + 1])
        self.marker.set_data(along[pose : pose + 1], shown[pose : pose + 1])
        self.stroke.set_text(strokes.words(motion.plan, moving, float(motion.strokes[moving][pose]), fixed=True))
        self.value.set_text(spoken(shown, pose))


def spoken(values: FloatArray, pose: int) -> str:
    """Return one of a column's values as text, all with so many decimals that the greatest has four digits; empty where it has none."""
    if not np.isfinite(values[pose]):
        return ""
    greatest = float(np.nanmax(np.abs(values)))
    decimals = int(np.clip(3 - np.floor(np.log10(greatest)), 0, MOST)) if greatest > 0.0 else 0
    return f"{values[pose]:z.{decimals}f}".replace("-", "\N{MINUS SIGN}")
