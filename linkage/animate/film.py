"""A mechanism's animation, written in the form that the file's name asks for."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from ..errors import DefinitionError, FileError, unknown
from ..mechanism import Mechanism
from ..page import page
from .course import course
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
    progress: Progress | None = None,
) -> Path:
    """Return the path of the animation it wrote: a .gif, an .mp4 (extra `video`) or an .html page that works offline.

    The mechanism runs over its first stroke, there and back (a full turn goes round), at `count` poses; beside it
    the live curve of a column of `machine.columns`, the last unless named. `trace` names points whose paths are
    drawn; `limit` is the column's limit, `(value [SI], text, "above" or "below")`. `progress(done, total)` is called
    as it goes. Raises DefinitionError for another kind of file, a batch of designs or an unknown name.
    """
    target = Path(path)
    kinds = {".gif": gif, ".mp4": mp4, ".html": html}
    if target.suffix.lower() not in kinds:
        raise DefinitionError(f"{target.name}: an animation is written as .gif, .mp4 or .html; give a name with one of these endings.")
    for name in trace:
        if name not in machine.plan.points:
            raise unknown("Point", name, machine.plan.points, where=machine.plan.title)
    if not target.parent.is_dir():
        raise FileError(f"{target}: the folder {target.parent} is not there; make it first or choose another.")
    kinds[target.suffix.lower()](machine, target, count, column, trace, limit, progress or silent)
    return target


def silent(done: int, total: int) -> None:
    """Say nothing."""


def gif(machine: Mechanism, target: Path, count: int, column: str | None, trace: Sequence[str], limit: Any, progress: Progress) -> None:
    """Write a GIF; a pose that comes twice is drawn once."""
    run = course(machine, count, column)
    stage = Stage(run, trace, limit, GIF_DPI)
    sample = np.concatenate([stage.frame(pose) for pose in (run.order[0], run.order[len(run.order) // 2])])
    poses = list(dict.fromkeys(run.order))
    write_gif(target, counted(frames(stage, poses), len(poses), progress), run.order, sample)


def mp4(machine: Mechanism, target: Path, count: int, column: str | None, trace: Sequence[str], limit: Any, progress: Progress) -> None:
    """Write an MP4."""
    run = course(machine, count, column)
    stage = Stage(run, trace, limit, MP4_DPI)
    width, height = stage.canvas.get_width_height()
    write_mp4(target, counted(frames(stage, run.order), len(run.order), progress), (width, height))


def html(machine: Mechanism, target: Path, count: int, column: str | None, trace: Sequence[str], limit: Any, progress: Progress) -> None:
    """Write a page; it moves between more poses than a GIF shows."""
    run = course(machine, count, column)
    fine = course(machine, PAGE_FINENESS * (count - 1) + 1, run.column.name, eased=False)
    text = page(fine.motion, fine.column, trace, limit, is_turn=fine.is_turn)
    progress(1, 2)
    target.write_text(text, encoding="utf-8")
    progress(2, 2)


def frames(stage: Stage, poses: Iterable[int]) -> Iterator[npt.NDArray[np.uint8]]:
    """Yield the picture at each pose."""
    return (stage.frame(pose) for pose in poses)


def counted(each: Iterator[npt.NDArray[np.uint8]], total: int, progress: Progress) -> Iterator[npt.NDArray[np.uint8]]:
    """Yield the same pictures, and report each when it has been taken."""
    progress(0, total)
    for done, picture in enumerate(each, 1):
        yield picture
        progress(done, total)
