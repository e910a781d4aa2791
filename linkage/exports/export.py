"""A machine or a motion as a file for another program: the door of this room."""

from __future__ import annotations

import io
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ..disk import Place, check_name, check_place, replacing
from ..errors import DefinitionError, cited
from ..mechanism import Mechanism, require_mechanism
from ..motion import Column, Motion, columns_of
from ..pictures.strokes import stroke_words
from ..reports import NOTHING, first_stroke, results, run_of, stroke_middles, write_csv
from .calculation import Calculation, reached_somewhere
from .drawing_dxf import dxf
from .drawing_svg import svg
from .geometry import PoseDrawing, path_parts, pose_parts
from .workbook import check_count, workbook

ENDINGS = (".xlsx", ".csv", ".dxf", ".svg")
MOST_ROWS, ROW = 500_000, 2000
"""The rows of a table that is written, and about how many bytes one takes on its way."""
MOST_POSES = 50
"""More poses in one drawing are no drawing any more."""


def export(
    what: Mechanism | Motion,
    path: Place,
    *,
    at: Mapping[str, Any] = NOTHING,
    count: int = 101,
    trace: Sequence[str] = (),
    columns: Sequence[Column] = (),
) -> Path:
    """Return the path of the file it wrote; see `linkage.export`."""
    check_name(path)
    file = Path(path)
    kind = file.suffix.lower()
    if kind not in ENDINGS:
        raise DefinitionError(f"{file}: the file's name ends in one of {', '.join(ENDINGS)}, which chooses what is written.")
    check_exportable(what, kind, at, trace, columns)
    check_place(path)
    content = content_of(what, kind, file.name, at, check_count(count), trace, columns)
    with replacing(path) as stream:
        stream.write(content)
    return file


def check_exportable(what: Any, kind: str, at: Any, trace: Any, columns: Any) -> None:
    """Raise DefinitionError for what is neither a machine nor a motion, and for what does not go with a kind of file."""
    if not isinstance(what, Motion):
        require_mechanism(what)
    title = what.plan.title
    if isinstance(what, Mechanism) and kind != ".csv" and any(np.ndim(value) for value in what.dimensions.values()):
        raise DefinitionError(f"{title}: a file holds one design, and this machine is a batch of them; choose one of its designs.")
    if isinstance(what, Motion) and kind == ".xlsx":
        raise DefinitionError(f"{title}: a workbook follows its dimensions, so it is made of a machine: export(machine, ...).")
    if not isinstance(at, Mapping) or not all(isinstance(name, str) for name in at):
        raise DefinitionError(f"{title}: at={cited(at)}: values of strokes by name are expected, such as at=dict(S=0.1).")
    if isinstance(what, Motion) and at:
        raise DefinitionError(f"{title}: a motion has its poses; at= goes with a machine.")
    if not isinstance(trace, (list, tuple)):
        raise DefinitionError(f'{title}: trace={cited(trace)}: a list of points is expected, such as trace=["G"].')
    if not isinstance(columns, (list, tuple)) or not all(isinstance(each, Column) for each in columns):
        raise DefinitionError(f"{title}: columns={cited(columns)}: a list of columns is expected, such as results(machine, motion).")
    if trace and kind not in (".dxf", ".svg"):
        raise DefinitionError(f"{title}: trace= draws the paths of points, in .dxf and .svg.")
    if columns and kind != ".csv":
        raise DefinitionError(f"{title}: columns= chooses what a .csv holds.")


def content_of(
    what: Mechanism | Motion, kind: str, name: str, at: Mapping[str, Any], count: int, trace: Sequence[str], columns: Sequence[Column]
) -> bytes:
    """Return a file's bytes."""
    if kind == ".csv":
        return csv(what, at, count, columns)
    if kind == ".xlsx":
        assert isinstance(what, Mechanism)
        return workbook(Calculation(what, run_of(what, at), count), name)
    poses, paths, title = drawing_of(what, at, count, trace)
    return dxf(poses, paths) if kind == ".dxf" else svg(poses, paths, title)


def csv(what: Mechanism | Motion, at: Mapping[str, Any], count: int, columns: Sequence[Column]) -> bytes:
    """Return a table of results as CSV: of a machine its own, over its strokes; of a motion its points and outputs, or `columns`."""
    if isinstance(what, Motion):
        table = list(columns) or columns_of(what)
    else:
        motion = over_strokes(what, at, count)
        table = list(columns) or results(what, motion)
    stream = io.StringIO(newline="")
    write_csv(table, stream)
    return stream.getvalue().encode("utf-8")


def over_strokes(machine: Mechanism, at: Mapping[str, Any], count: int) -> Motion:
    """Return a motion over the strokes that `at` does not name, at `count` poses each: a grid where there are several; with gaps."""
    first_stroke(machine)
    free = {name: np.linspace(each.start, each.end, count) for name, each in machine.strokes.items()}
    axes = {name: np.atleast_1d(at.get(name, values)) for name, values in free.items()}
    many = {name: axis for name, axis in axes.items() if len(axis) > 1 or name not in at}
    rows = int(np.prod([float(len(axis)) for axis in many.values()]))
    if rows > MOST_ROWS:
        each = " x ".join(str(len(axis)) for axis in many.values())
        most = int(MOST_ROWS ** (1.0 / len(many)))
        hold = ", ".join(f"{name}=..." for name in list(many)[1:]) or f"{next(iter(many))}=..."
        said = f"{machine.plan.title}: {each} poses are {rows:,} rows, some {rows * ROW / 1e9:.1f} GB"
        raise DefinitionError(f"{said}; give count={most} at most, or hold strokes, at=dict({hold}).")
    grids = dict(zip(many, np.meshgrid(*many.values(), indexing="ij"), strict=True)) if many else {}
    unknown_names = {name: at[name] for name in at if name not in axes}
    strokes = {name: grids.get(name, axis[0]) for name, axis in axes.items()}
    return reached_somewhere(machine.at(unreachable="nan", **strokes, **unknown_names))


def drawing_of(
    what: Mechanism | Motion, at: Mapping[str, Any], count: int, trace: Sequence[str]
) -> tuple[list[PoseDrawing], tuple[Any, ...], str]:
    """Return the poses, the paths and the title of a drawing.

    Of a motion all its poses, and the paths through them; of a machine those at the values that `at` gives, else at the start of the
    first stroke, and paths over that stroke. Strokes that are not named stand in their middle.
    """
    if isinstance(what, Motion):
        motion = swept = what
    else:
        first = first_stroke(what)
        moving = max(at, key=lambda name: np.size(at[name])) if at else first
        values = drawn_strokes(what, at)
        motion = reached_somewhere(what.at(unreachable="nan", **values))
        held = {name: float(np.ravel(value)[0]) for name, value in values.items()}
        end = what.strokes.get(moving, what.strokes[first])
        swept = what.at(unreachable="nan", **{**held, moving: np.linspace(end.start, end.end, count)}) if trace else motion
    indices = [int(each) for each in np.flatnonzero(np.broadcast_to(motion.reached, motion.shape).ravel())] if motion.shape else [0]
    if len(indices) > MOST_POSES:
        raise DefinitionError(f"{motion.plan.title}: {len(indices)} poses do not go into one drawing; choose up to {MOST_POSES}.")
    poses = [PoseDrawing(pose_words(motion, index), pose_parts(motion, index)) for index in indices]
    return poses, path_parts(swept, trace), motion.plan.heading


def drawn_strokes(machine: Mechanism, at: Mapping[str, Any]) -> dict[str, Any]:
    """Return the strokes of the poses of a drawing: those given, else the start of the first one, the others in their middle."""
    first = first_stroke(machine)
    values = stroke_middles(machine) | {first: machine.strokes[first].start} | dict(at)
    return {name: np.atleast_1d(value) for name, value in values.items()}


def exported_motion(machine: Mechanism, path: Place, at: Mapping[str, Any], count: int) -> Motion:
    """Return the poses that a file of a machine holds; NaN where it cannot be assembled."""
    kind = Path(path).suffix.lower()
    if kind == ".csv":
        return over_strokes(machine, at, count)
    run = run_of(machine, at).over(np.linspace(0.0, 1.0, count)) if kind == ".xlsx" else drawn_strokes(machine, at)
    return machine.at(unreachable="nan", **run)


def pose_words(motion: Motion, index: int) -> str:
    """Return a pose's strokes in words."""
    flat = {name: np.broadcast_to(values, motion.shape).ravel() for name, values in motion.strokes.items()}
    return ", ".join(stroke_words(motion.plan, name, float(values[index])) for name, values in flat.items())
