"""A mechanism's animation, written in the form that the file's name asks for."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from ..disk import check_place, replacing_text
from ..draw.limits import limit as limit_of
from ..draw.poses import named_points
from ..errors import DefinitionError, cited
from ..mechanism import Mechanism, require_mechanism
from ..page import page
from ..report import NOTHING, At
from .course import Course, course, whole
from .gif import write_gif
from .mp4 import write_mp4
from .stage import Stage

GIF_DPI = 100
MP4_DPI = 150
PAGE_FINENESS = 3

Progress = Callable[[int, int], None]


def animate(
    machine: Mechanism,
    path: str | Path,
    *,
    count: int = 60,
    column: str | None = None,
    trace: Sequence[str] = (),
    limit: Sequence[Any] | None = None,
    at: At = NOTHING,
    progress: Progress | None = None,
) -> Path:
    """Return the path of the animation it wrote: a .gif, an .mp4 (extra `video`) or an .html page that works offline.

    The mechanism runs over its first stroke, there and back (a full turn goes round), at `count` poses; beside it
    the live curve of a column of its results, the last unless named. `at=dict(tilt=0.1)` holds another stroke, `at=dict(S=(0.1, 0.2))`
    says where one runs [m or rad]; strokes not named stand in their middle. `trace` names points whose paths are
    drawn; `limit` is the column's limit, `(value [SI], text, "above" or "below")`. `progress(done, total)` is called
    as it goes. What stood at the path is replaced whole, or
    left as it was. Raises DefinitionError for another kind of file, a batch of designs or an unknown name, FileError for a path that
    cannot be written.
    """
    require_mechanism(machine)
    if not isinstance(path, (str, os.PathLike)):
        raise DefinitionError(f"{cited(path)} is no path of a file; give one that ends in .gif, .mp4 or .html.")
    if progress is not None and (not callable(progress) or isinstance(progress, type)):
        raise DefinitionError(f"progress={cited(progress)} is no function; give one of (done, total).")
    target, poses = Path(path), whole(count)
    kind = target.suffix.lower()
    if kind not in KINDS:
        raise DefinitionError(f"{target.name}: an animation is written as .gif, .mp4 or .html; give a name with one of these endings.")
    trace = named_points(machine, trace, "trace")
    if limit is not None:
        limit_of(limit)
    check_place(target)
    write, fineness = KINDS[kind]
    run = course(machine, fineness * (poses - 1) + 1, column, at=at, eased=fineness == 1)
    write(run, target, trace, limit, progress or silent)
    return target


def silent(done: int, total: int) -> None:
    """Say nothing."""


def gif(run: Course, target: Path, trace: Sequence[str], limit: Any, progress: Progress) -> None:
    """Write a GIF; a pose that comes twice is drawn once."""
    stage = Stage(run, trace, limit, GIF_DPI)
    sample = np.concatenate([stage.frame(pose) for pose in (run.order[0], run.order[len(run.order) // 2])])
    poses = list(dict.fromkeys(run.order))
    write_gif(target, counted(frames(stage, poses), len(poses), progress), run.order, sample)


def mp4(run: Course, target: Path, trace: Sequence[str], limit: Any, progress: Progress) -> None:
    """Write an MP4."""
    stage = Stage(run, trace, limit, MP4_DPI)
    width, height = stage.canvas.get_width_height()
    write_mp4(target, counted(frames(stage, run.order), len(run.order), progress), (width, height))


def html(run: Course, target: Path, trace: Sequence[str], limit: Any, progress: Progress) -> None:
    """Write a page."""
    text = page(run.motion, run.column, trace, limit, is_turn=run.is_turn)
    progress(1, 2)
    with replacing_text(target) as stream:
        stream.write(text)
    progress(2, 2)


KINDS = {".gif": (gif, 1), ".mp4": (mp4, 1), ".html": (html, PAGE_FINENESS)}
"""An ending -> what writes it, and between how many times as many poses it moves: a page runs at its own pace."""


def frames(stage: Stage, poses: Iterable[int]) -> Iterator[npt.NDArray[np.uint8]]:
    """Yield the picture at each pose."""
    return (stage.frame(pose) for pose in poses)


def counted(each: Iterator[npt.NDArray[np.uint8]], total: int, progress: Progress) -> Iterator[npt.NDArray[np.uint8]]:
    """Yield the same pictures, and report each when it has been taken."""
    progress(0, total)
    for done, picture in enumerate(each, 1):
        yield picture
        progress(done, total)
