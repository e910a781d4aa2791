"""A mechanism's animation, written in the form that the file's name asks for."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from shutil import copyfileobj
from tempfile import TemporaryDirectory, gettempdir
from typing import Any, TypeAlias, cast

import numpy as np
import numpy.typing as npt
from matplotlib.artist import Artist
from matplotlib.backends.backend_agg import FigureCanvasAgg, RendererAgg
from matplotlib.figure import Figure
from matplotlib.text import Annotation, Text
from PIL import Image

from ..disk import check_place, replacing, spoken
from ..errors import DefinitionError, FileError, LinkageError, can_be_called, require, require_type
from ..language import said, translated
from ..mechanism import Mechanism, played_along, require_mechanism
from ..motion import Motion
from ..program import FloatArray
from ..reports import NOTHING, At
from . import style
from .browser import COUNT, page
from .curves import panel
from .drawing import Drawing
from .poses import trace
from .scene import Scene
from .sheet import sheet
from .shown_values import Limit, as_curve, limit_of, named_points, typeset
from .strokes import Playback, StrokeAxis, frame_count, playback, stroke_words, unreached_words

GIF_DPI = 100
MP4_DPI = 150

Progress: TypeAlias = Callable[[int, int], None]
"""What is called as the poses of an animation are done: with their number, and that of all."""


def animate(
    machine: Mechanism | Motion,
    path: str | Path,
    *,
    count: int = 60,
    column: str | None = None,
    trace: Sequence[str] | None = None,
    limit: Sequence[object] | None = None,
    at: At | Motion = NOTHING,
    progress: Progress | None = None,
) -> Path:
    """Return the path of the animation it wrote: a .gif, an .mp4 (extra `video`) or an .html page that works offline.

    The mechanism runs over the first `Over` that it declares, else over its first stroke, there and back (a full turn goes round), at
    `count` poses; beside it the live
    curve of a column of its results. `at=dict(tilt=0.1)` holds another stroke, `at=dict(S=(0.1, 0.2))` says where one runs [m or rad],
    and `at=dict(lift=(0.0, 0.6, 0.6), tilt=(0.1, 0.1, 0.0))` how several run together, from value to value; strokes not named are at
    mid-stroke. A motion along one path, `machine.sweep(101, over="digging")`, is played along that path, in a load case that occurs there.
    `trace` names points whose paths are drawn; `limit` is the column's limit, `(value [SI], text, "above" or "below")`.
    What is not given is what the machine is about (`Mechanism.featured`), else the last column that changes, no path and no limit.
    A path in time plays in real time. `progress(done, total)` is called as it goes. An existing
    file is replaced whole, or left as it was. Raises DefinitionError for another kind of file, a batch of designs or an unknown
    name, FileError for a path that cannot be written.

    Parameters
    ----------
    machine : Mechanism or Motion
        The design, or a motion of one.
    path : str or Path
        The file: .gif, .mp4 or .html.
    count : int
        The number of poses.
    column : str, optional
        The column of the curve.
    trace : sequence of str, optional
        The points whose paths are drawn.
    limit : sequence, optional
        Its limit, `(value [SI], text, "above" or "below")`.
    at : mapping
        Strokes to hold, or to run between values, by name [m or rad].
    progress : callable or bool, optional
        Called with (done, total); True shows a bar.

    Returns
    -------
    Path
        The file written.

    Raises
    ------
    DefinitionError
        Another kind of file, a batch of designs, an unknown name.
    FileError
        The path cannot be written.
    """
    if isinstance(machine, Motion):
        machine, at = played_along(machine, at)
    require_mechanism(machine)
    require_type("", path, (str, os.PathLike), "is no path of a file; give one that ends in .gif, .mp4 or .html")
    is_function = progress is None or can_be_called(progress)
    require(is_function, "progress", progress, "is no function; give one of (done, total)")
    target, poses = Path(path), frame_count(count)
    kind = target.suffix.lower()
    if kind not in (".gif", ".mp4", ".html"):
        raise DefinitionError(f"{target.name}: an animation is written as .gif, .mp4 or .html; give a name with one of these endings.")
    trace = named_points(machine, machine.featured().path if trace is None else trace, "trace")
    if limit is not None:
        limit_of(limit)
    check_place(target)
    report = progress or (lambda done, total: None)
    if kind == ".html":
        report(1, 2)
        shown: dict[str, Any] = {"column": column, "trace": trace, "limit": limit, "count": max(poses, COUNT)}
        page(at, target, **shown) if isinstance(at, Motion) else page(machine, target, at=at, **shown)
        report(2, 2)
        return target
    played = playback(machine, poses, column, at=at)
    if limit is None:
        limit = machine.featured().limits.get(played.column.name)
    curve, limit = as_curve(played.column, limit)
    stage = Stage(replace(played, column=curve), trace, limit, GIF_DPI if kind == ".gif" else MP4_DPI)
    if kind == ".gif":  # a pose that comes twice is drawn once
        sample = np.concatenate([stage.frame(pose) for pose in (played.order[0], played.order[len(played.order) // 2])])
        write_gif(target, drawn_frames(stage, list(dict.fromkeys(played.order)), report), played.order, sample, played.seconds)
    else:
        write_mp4(target, drawn_frames(stage, played.order, report), stage.canvas.get_width_height(), 1.0 / played.seconds)
    return target


def drawn_frames(stage: Stage, poses: Sequence[int], progress: Progress) -> Iterator[npt.NDArray[np.uint8]]:
    """Yield the picture at each pose, and report it when it has been taken."""
    progress(0, len(poses))
    for done, pose in enumerate(poses, 1):
        yield stage.frame(pose)
        progress(done, len(poses))


# The stage of an animation: the mechanism and its live curve, drawn once and then moved.

WIDTH, HEIGHT = 9.6, 4.8
TITLE = 0.953
SHEET = (0.065, 0.115, 0.535, 0.775)
CURVE = (0.685, 0.115, 0.285, 0.775)
"""The figure [inch]; the height of the titles and the places of its two axes as shares of it."""

MOST = 9
"""Decimals that a value is shown with, at most."""
TITLE_GAP = 12.0
"""Between a title and what stands beside it [pixels], at the least."""


class Stage:
    """A figure with a mechanism on the left and a live curve on the right; `frame` gives it at a pose."""

    def __init__(self, playback: Playback, paths: Sequence[str], bound: Sequence[object] | Limit | None, dpi: int) -> None:
        self.playback, self.scene, self.along = playback, Scene(playback.motion), StrokeAxis.of(playback.motion)
        self.figure = Figure(figsize=(WIDTH, HEIGHT), dpi=dpi, facecolor=style.PAPER)
        self.canvas = cast(Any, FigureCanvasAgg(self.figure))  # matplotlib declares no types for its methods
        self.moving = [name for name, values in playback.motion.strokes.items() if np.ptp(values) > 0.0] or list(playback.motion.strokes)
        ax = self.figure.add_axes(SHEET)
        sheet(ax, self.scene.box())
        for name in paths:
            trace(ax, self.scene.places[name])
        self.drawing = Drawing(ax, self.scene)
        self.drawing.ground()
        self.drawing.label_points(self.scene.some(9))
        self.title = self._title(SHEET[0], self.scene.motion.plan.heading)

        ax = self.figure.add_axes(CURVE)
        panel(ax, playback.motion, playback.column, bound, colour=style.RULE)
        ax.set_title("", loc="left")
        (self.run,) = ax.plot([], [], color=style.CURVE, linewidth=style.BOLD + 0.4, zorder=5.05, solid_capstyle="round")
        (self.marker,) = ax.plot([], [], "o", color=style.CURVE, markersize=9, markeredgecolor=style.PAPER, zorder=7.0, clip_on=False)
        self._title(CURVE[0], typeset(playback.column.heading))
        self.value = self.figure.text(CURVE[0] + CURVE[2], TITLE, "", fontsize=style.TITLE, color=style.CURVE, ha="right", va="center")
        self.live = sorted([*ax.lines, *ax.texts], key=lambda artist: artist.get_zorder())
        self.stroke = self.figure.text(SHEET[0] + SHEET[2], TITLE, "", fontsize=style.TITLE, color=style.INK, ha="right", va="center")
        held, lost = self.along.held, unreached_words(playback.motion, self.along.name)
        beside = ", ".join(filter(None, (said("at {place}", place=held) if held else "", playback.case)))
        at_left = SHEET[0], beside, style.MUTED, "left"
        at_right = SHEET[0] + SHEET[2], lost, style.ACCENT, "right"
        for x, text, colour, side in (at_left, at_right):
            if text:
                self.figure.text(x, 0.91, text, fontsize=style.SMALL, color=colour, va="center", ha=side)
        for artist in self._moving:
            artist.set_animated(True)
        self.canvas.draw()
        # Leave out the last strokes of a place that would run into the title; the axes say where they go.
        renderer = self.canvas.get_renderer()
        end = self.title.get_window_extent(renderer).x1 + TITLE_GAP
        has_time = self.playback.motion.time is not None
        for shown in range(len(self.moving), -has_time, -1):
            self.moving = self.moving[:shown]
            self.stroke.set_text(max((self._place(pose) for pose in range(len(self.playback.column.drawn))), key=len))
            if self.stroke.get_window_extent(renderer).x0 > end:
                break
        self.still: object = self.canvas.copy_from_bbox(self.figure.bbox)
        names = [artist for artist in self.drawing.artists if isinstance(artist, Annotation)]
        self.stamps: dict[Artist, Stamp] = {name: Stamp(name, self.canvas) for name in names}

    def _title(self, left: float, text: str) -> Text:
        return self.figure.text(left, TITLE, text, fontsize=style.TITLE, fontweight="bold", color=style.INK, va="center")

    @property
    def _moving(self) -> list[Artist]:
        return [*self.drawing.artists, *self.live, self.stroke, self.value]

    def _place(self, pose: int) -> str:
        """Return where a pose is in words: its instant, and the strokes that move."""
        motion = self.playback.motion
        strokes = (stroke_words(motion.plan, name, float(motion.strokes[name][pose]), fixed=True) for name in self.moving)
        time = [] if motion.time is None else [f"{motion.time[pose]:.2f} {translated('s')}"]
        return ", ".join([*time, *strokes])

    def frame(self, pose: int) -> npt.NDArray[np.uint8]:
        """Return the picture at a pose, shape (height, width, 4): red, green, blue, and a fourth that says nothing."""
        along, values = self.along, self.playback.column.drawn
        self.drawing.update(pose)
        self.run.set_data(along.values[: pose + 1], values[: pose + 1])
        self.marker.set_data(along.values[pose : pose + 1], values[pose : pose + 1])
        self.stroke.set_text(self._place(pose))
        self.value.set_text(column_text(values, pose))
        self.canvas.restore_region(self.still)
        renderer = self.canvas.get_renderer()
        for artist in self._moving:
            (self.stamps.get(artist) or artist).draw(renderer)
        return np.array(self.canvas.buffer_rgba())


class Stamp:
    """A name drawn once and then put down beside its point, to whole pixels: to set it anew in each frame takes most of the time."""

    def __init__(self, text: Annotation, canvas: FigureCanvasAgg) -> None:
        self.text = text
        across, up = canvas.get_width_height()
        alone = cast(Any, RendererAgg)(across, up, canvas.figure.dpi)  # matplotlib declares no types for its methods
        text.draw(alone)
        drawn = np.asarray(alone.buffer_rgba())
        rows, columns = np.nonzero(drawn[..., 3])
        self.is_empty = not rows.size
        if self.is_empty:
            return
        last, first = rows.max() + 1, columns.min()
        self.picture = np.ascontiguousarray(drawn[rows.min() : last, first : columns.max() + 1][::-1])
        self.away = np.array([first, up - last]) - self._pin()

    def _pin(self) -> npt.NDArray[np.float64]:
        """Return the place of its point, to whole pixels from the lower left."""
        shown: Any = self.text.axes
        return np.round(np.asarray(shown.transData.transform(self.text.xy), float))

    def draw(self, renderer: Any) -> None:
        """Put it down beside its point."""
        x, y = self._pin() + self.away if not self.is_empty else (np.nan, np.nan)
        if np.isfinite(x + y) and self.text.get_visible():
            renderer.draw_image(renderer.new_gc(), int(x), int(y), self.picture)


def column_text(values: FloatArray, pose: int) -> str:
    """Return one of a column's values as text, all with so many decimals that the greatest has four digits; empty where it has none."""
    if not np.isfinite(values[pose]):
        return ""
    greatest = float(np.nanmax(np.abs(values)))
    decimals = int(np.clip(3 - np.floor(np.log10(greatest)), 0, MOST)) if greatest > 0.0 else 0
    return f"{values[pose]:z.{decimals}f}".replace("-", "\N{MINUS SIGN}")


# Frames written as a GIF: one palette, and only what changes from frame to frame.

COLOURS, APART = 120, 9
"""How many colours the palette holds, and how far they stand apart, of 255."""


def write_gif(
    path: Path, frames: Iterable[npt.NDArray[np.uint8]], order: Sequence[int], sample: npt.NDArray[np.uint8], seconds: float
) -> None:
    """Write frames, one for each pose of `order` met first, in that order, each for so many seconds.

    `sample` is a picture with all colours.
    """
    palette = palette_of(sample)
    pictures: dict[int, Image.Image] = {}
    for pose, frame in zip(dict.fromkeys(order), frames, strict=True):
        picture = Image.frombuffer("RGBX", (frame.shape[1], frame.shape[0]), frame, "raw", "RGBX", 0, 1)
        pictures[pose] = picture.convert("RGB").quantize(palette=palette, dither=Image.Dither.NONE)
    first, *others = [pictures[pose] for pose in order]
    with replacing(path) as stream:
        options: dict[str, Any] = {"duration": round(1000.0 * seconds), "loop": 0, "disposal": 1, "optimize": True}
        first.save(stream, "GIF", save_all=True, append_images=others, **options)


def palette_of(sample: npt.NDArray[np.uint8]) -> Image.Image:
    """Return a picture whose palette holds the most frequent colours of a sample, the paper first, none like another.

    Pillow finds a pixel's colour in the palette to a few steps in 256, so two like colours would mix.
    """
    packed, counts = np.unique(sample[..., :3].astype(np.uint32) @ np.array([1 << 16, 1 << 8, 1], np.uint32), return_counts=True)
    ranked = packed[np.argsort(-counts, kind="stable")]
    colours = np.stack([ranked >> 16, ranked >> 8 & 255, ranked & 255], axis=1).astype(np.int64)
    kept: list[npt.NDArray[np.int64]] = []
    while len(colours) and len(kept) < COLOURS:
        kept.append(colours[0])
        colours = colours[np.abs(colours - colours[0]).max(axis=1) >= APART]
    palette = Image.new("P", (1, 1))
    palette.putpalette(np.concatenate(kept).tolist())
    return palette


# Frames written as an MP4 (H.264) through ffmpeg.


def write_mp4(path: Path, frames: Iterable[npt.NDArray[np.uint8]], size: tuple[int, int], rate: float) -> None:
    """Write frames, so many a second, of a size, width and height in pixels.

    LinkageError where ffmpeg is not installed, FileError where it fails.
    """
    try:
        import imageio_ffmpeg
    except ImportError:
        raise LinkageError(
            f"{path.name}: an .mp4 needs ffmpeg, which the extra `video` brings: pip install 'hydrolinkage[video]' "
            "(from a checkout: pip install -e '.[video]'). A .gif or .html needs nothing more."
        ) from None
    with replacing(path) as stream, TemporaryDirectory() as folder:
        film, written = Path(folder) / "film.mp4", 0
        options: dict[str, Any] = {"quality": 8, "macro_block_size": 16, "output_params": ["-preset", "veryfast"]}
        writer = imageio_ffmpeg.write_frames(str(film), size, pix_fmt_in="rgb0", fps=rate, **options)
        writer.send(None)
        try:
            for written, frame in enumerate(frames, 1):  # noqa: B007 - counted to the end
                writer.send(frame)
        finally:
            writer.close()
        try:
            found, _ = imageio_ffmpeg.count_frames_and_secs(str(film))
        except RuntimeError:  # ffmpeg cannot read what it wrote
            found = 0
        if found != written:
            room = f"make room in {gettempdir()}, where it works"
            raise FileError(f"{spoken(path)}: ffmpeg wrote {found} of {written} frames; {room}, or choose .gif or .html.")
        with film.open("rb") as whole:
            copyfileobj(whole, stream)
