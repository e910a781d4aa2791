"""A mechanism on axes: all its parts, made once and moved from pose to pose; ground symbols and rails, which never move."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.image import AxesImage, imread
from matplotlib.lines import Line2D
from matplotlib.patches import Circle, PathPatch, Polygon
from matplotlib.path import Path as Outline
from matplotlib.transforms import Affine2D
from PIL import Image

from ..errors import FileError, require_type
from ..motion import Motion
from ..program import FloatArray
from . import style
from .layout import BASE, HATCH, LED, MINOR, distance_to_box, half_of, hatched, label_free, offsets, props
from .scene import DrawnMark, Places, Plate, Pose, Scene
from .shapes import SLOT, left_of, polar, rounded_outline
from .sheet import MOST_PIXELS, Keywords, haloed_beside, pixels_text, points_a_metre, sheet
from .style import FAINT, STRONG, Look


def mechanism(ax: Axes, motion: Motion, pose: Pose = 0, *, faint: bool = False) -> Drawing:
    """Return the mechanism drawn on axes at a pose of a motion; `update` moves it to another.

    The pose is an index into the strokes, an int for the flat one. Empty axes become a sheet with equal scales that
    has room for the whole motion. A faint mechanism has no names. At a pose out of reach only the frame is drawn.
    Raises DefinitionError for a batch of designs or a pose that is not there.
    """
    scene = Scene(motion)
    require_type("draw(ax", ax, Axes, "axes of matplotlib are expected, Figure().add_subplot()")
    index = scene.index(pose)
    if not ax.has_data():
        sheet(ax, scene.box())
    return draw_scene(ax, scene, index, None if faint else (), FAINT if faint else STRONG)


def draw_scene(ax: Axes, scene: Scene, pose: int, keep_clear: Sequence[FloatArray] | None, look: Look = STRONG, **names: Any) -> Drawing:
    """Return a mechanism drawn at a pose, a flat index, with its ground and the names of its points.

    These keep clear of points, shape (n, 2) each [m], and `names` says more of them, as `label_points` takes it; without points to keep
    clear of, None, there are no names.
    """
    drawing = Drawing(ax, scene, look)
    drawing.ground()
    if keep_clear is not None:
        drawing.label_points([scene.at(pose)] if pose in scene.reached else [], keep_clear, **names)
    drawing.update(pose)
    return drawing


UNDER = 2.5
"""The layer of what is written on the sheet under a mechanism."""


class Drawing:
    """The parts of a mechanism on some axes; `update` moves them to another pose."""

    def __init__(self, ax: Axes, scene: Scene, look: Look = STRONG) -> None:
        self.ax, self.scene, self.look = ax, scene, look
        plates = zip(scene.plates, (style.PALETTE[place] for place in scene.colours), strict=True)
        slot: Keywords = {"edgecolor": look.colour(style.INK), "linewidth": style.OUTLINE}  # open from end to end
        self.parts: list[MovingPart] = [
            *(MarkPart(ax, mark, look) for mark in scene.marks if mark.on),
            *(body_part(ax, plate, scene.size, colour, look) for plate, colour in plates),
            *(
                BodyPart(Plate(track.ends, np.eye(2)), SLOT * scene.size, polygon(ax, look.level + 0.3, facecolor=style.PAPER, **slot))
                for track in scene.tracks
                if not track.fixed
            ),
            *(StayPart(ax, ends, look) for ends in scene.stays),
            *(pin(ax, name, scene.size, look) for name in scene.pins),
            *(dot(ax, name, scene.size * (0.7 if name in scene.minor else 1.0), look) for name in scene.dots),
        ]

    def ground(self) -> None:
        """Draw the parts that never move: the frame under its pins."""
        rails(self.ax, self.scene, self.look)
        at = self.scene.at(0)
        for mark in self.scene.marks:
            if not mark.on:
                MarkPart(self.ax, mark, self.look).update(at)
        for name, way in props(self.scene).items():
            ground(self.ax, at[name], way, self.scene.size, self.look)

    def label_points(
        self, poses: Sequence[Places], keep_clear: Sequence[FloatArray] = (), *, all_points: bool = True, font: float = style.LABEL
    ) -> None:
        """Name the points, or those alone that are no construction; names keep clear of the mechanism at all `poses` and of points [m]."""
        size, scale = self.scene.size, points_a_metre(self.ax)
        clouds = [np.concatenate([points, *keep_clear]) for points in label_free(self.scene, poses)]
        gap = 1.15 * size * scale + 1.5
        minor = self.scene.minor
        names = [name for name in self.scene.places if name not in self.scene.inner and (all_points or name not in minor)]
        letters = self.scene.letters
        sheet = (*self.ax.get_xlim(), *self.ax.get_ylim())
        spots = offsets(names, poses, clouds, scale, gap, font, minor=minor, letters=letters, sheet=sheet)
        for name, spot in spots.items():
            self.parts.append(LabelPart(self.ax, name, spot, gap, self.look, name in minor, font, letters.get(name, name)))
        if letters:
            text = "   ".join(self.scene.letter_legend)
            place: Keywords = {"transform": self.ax.transAxes, "fontsize": style.SMALL, "color": style.MUTED, "zorder": UNDER}
            self.ax.text(0.008, 0.02, text, **place, ha="left", va="bottom")

    def update(self, pose: int) -> None:
        """Move to a pose, a flat index."""
        at = self.scene.at(pose)
        for part in self.parts:
            part.update(at)

    @property
    def artists(self) -> list[Artist]:
        """All that moves, from the lowest layer up."""
        return sorted((artist for part in self.parts for artist in part.artists), key=lambda artist: artist.get_zorder())


# Parts that move, and arrows.


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
    ax.add_artist(patch)  # add_patch would first look how far it reaches on the sheet, which is as large as the motion
    return patch


def path_of(lines: FloatArray) -> Outline:
    """Return straight lines, shape (n, 2, 2) [m], as one path."""
    return Outline(lines.reshape(-1, 2), [Outline.MOVETO, Outline.LINETO] * len(lines))


def many_lines(ax: Axes, lines: FloatArray, colour: str, width: float, level: float) -> PathPatch:
    """Draw straight lines, shape (n, 2, 2) [m], as one artist: a file then has one element for all."""
    patch = PathPatch(path_of(lines), fill=False, edgecolor=colour, linewidth=width, zorder=level)
    ax.add_artist(patch)
    return patch


def arrow_between(
    ax: Axes, start: FloatArray, end: FloatArray, colour: str, head: float, level: float, *, width: float = 1.4, clip: bool | None = None
) -> None:
    """Draw an arrow from a place to another [m], with a head of a size and a line of a width [points]."""
    look = {"arrowstyle": "-|>", "color": colour, "linewidth": width, "mutation_scale": head, "shrinkA": 0, "shrinkB": 0}
    ax.annotate("", tuple(end.tolist()), xytext=tuple(start.tolist()), zorder=level, annotation_clip=clip, arrowprops=look)


# Rigid bodies: bars with round ends, plates with round corners.


class BodyPart(MovingPart):
    """The line around the outermost points of a body or a slot, at a radius [m]."""

    artists: tuple[Polygon, ...]

    def __init__(self, form: Plate, radius: float, *artists: Polygon) -> None:
        self.form, self.points, self.radius, self.artists = form, form.points, radius, artists
        self.face = artists[0]

    def move(self, at: Places) -> None:
        outline = rounded_outline(self.form.at(at), self.radius)
        for artist in self.artists:
            artist.set_xy(outline)


def body_part(ax: Axes, form: Plate, radius: float, colour: str, look: Look) -> BodyPart:
    """Return a body, filled."""
    plate = len(form.shares) > 2
    fill, edge = look.colour(colour), look.colour(style.mixed(colour, style.INK, 0.65))
    level = look.level + (0.0 if plate else 0.2)
    face = polygon(ax, level, facecolor=fill, edgecolor="none", alpha=0.72 if plate else 1.0)
    return BodyPart(form, radius, face, polygon(ax, level + 0.1, fill=False, edgecolor=edge, linewidth=style.OUTLINE))


# What points carry, or nothing does: cylinders, springs, blocks, signs of loads, surroundings.

FIXED = 1.6
"""The layer of what stands still around a mechanism, below all of it."""


class MarkPart(MovingPart):
    """A mark: its lines, its hatches, and a picture under them."""

    def __init__(self, ax: Axes, mark: DrawnMark, look: Look) -> None:
        self.ax, self.mark, self.points = ax, mark, mark.on
        level, ink = look.level + mark.level if mark.on else FIXED, look.colour(getattr(style, mark.ink))
        self.lines = tuple(
            polygon(
                ax, level + 0.001 * layer, closed=each.closed, fill=bool(each.fill), edgecolor=ink, joinstyle="round", capstyle="round",
                facecolor=look.colour(getattr(style, each.fill or "PAPER")), linewidth=style.OUTLINE * (1.5 if each.bold else mark.width),
            )
            for layer, each in enumerate(mark.lines)
        )  # fmt: skip
        self.hatches = [many_lines(ax, mark.hatched, ink, 0.7 * style.THIN, level + 0.005)] if len(mark.hatched) else []
        self.under: list[tuple[AxesImage, FloatArray]] = []
        if mark.under is not None:  # a picture from a file, as wide as given, of its own height
            path, corners, opacity = mark.under
            pixels = read_picture(path)
            shown: Keywords = {"alpha": opacity * (1.0 - look.fade), "zorder": level - 0.1, "interpolation": "bilinear"}
            image = AxesImage(ax, extent=(0.0, 1.0, 0.0, 1.0), **shown)
            image.set_data(pixels)
            image.set_clip_path(ax.patch)
            ax.add_artist(image)
            up = corners[0] + (corners[3] - corners[0]) * len(pixels) / pixels.shape[1]
            self.under.append((image, np.array([corners[0], corners[1], up])))
        self.artists = (*self.lines, *self.hatches, *(image for image, _ in self.under))

    def move(self, at: Places) -> None:
        for line, artist in zip(self.mark.drawn(at), self.lines, strict=True):
            artist.set_xy(line)
        for hatches in self.hatches:
            hatches.set_path(path_of(self.mark.placed(self.mark.hatched, at)))
        for image, corners in self.under:  # three of its corners are those of a unit square
            start, right, up = self.mark.placed(corners, at)
            columns = np.column_stack([right - start, up - start, start])
            image.set_transform(Affine2D(np.vstack([columns, [0.0, 0.0, 1.0]])) + self.ax.transData)


FINE = 4000
"""The pixels of the longer side of a picture under a machine that are drawn at the most; of a finer one several are one."""


def read_picture(path: str) -> FloatArray:
    """Return a picture's pixels, shape (rows, columns, ...); FileError where it cannot be read."""
    if not Path(path).is_file():
        raise FileError(f"{path}: there is no such picture; give the path from where the program runs, or a whole one.")
    try:
        with Image.open(path) as file:
            wide, high = file.size
            if wide * high > MOST_PIXELS:
                raise FileError(f"{path}: {pixels_text(wide, high)}; make it smaller, {MOST_PIXELS / 1e6:.0f} million pixels at most.")
            if max(wide, high) > FINE:  # finer than any sheet; matplotlib would take 50 bytes a pixel
                plain = file if file.mode in ("L", "RGB", "RGBA") else file.convert("RGBA")
                return np.asarray(plain.reduce(-(-max(wide, high) // FINE)).convert("RGBA"))
        return np.asarray(imread(path))
    except Image.DecompressionBombError as error:
        raise FileError(f"{path}: more pixels than can be drawn; make it smaller, {MOST_PIXELS / 1e6:.0f} million at most.") from error
    except (OSError, ValueError, SyntaxError) as error:
        raise FileError(f"{path} is no picture that can be read: {error}") from error


# Points: pins as circles, others as small dots, and the thin lines of a bare construction.


class CirclePart(MovingPart):
    """A point as a circle."""

    def __init__(self, ax: Axes, name: str, radius: float, fill: str, edge: str, width: float, level: float) -> None:
        self.points = (name,)
        self.circle = Circle((0, 0), radius, facecolor=fill, edgecolor=edge, linewidth=width, zorder=level)
        ax.add_artist(self.circle)
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


class StayPart(MovingPart):
    """Two points that a construction joins: a thin broken line."""

    def __init__(self, ax: Axes, ends: tuple[str, str], look: Look) -> None:
        self.points = ends
        self.line = ax.add_line(Line2D([], [], color=look.colour(style.MUTED), linewidth=style.OUTLINE, dashes=(5, 3), zorder=look.level))
        self.artists = (self.line,)

    def move(self, at: Places) -> None:
        self.line.set_data(*np.array([at[name] for name in self.points]).T)


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
    many_lines(ax, lines, ink, style.THIN, level)


# Sliding: slots on moving bodies, and fixed rails with their hatching.


def rails(ax: Axes, scene: Scene, look: Look) -> None:
    """Draw the fixed rails. They never move."""
    colour = look.colour(style.INK)
    for lines in hatched(scene):
        for some, width in ((lines[:1], 1.6 * style.OUTLINE), (lines[1:], style.THIN)):
            many_lines(ax, some, colour, width, look.level - 0.6)
