"""A machine or a motion as a file for another program: the door of this room."""

from __future__ import annotations

import io
from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from .. import plugins
from ..disk import Place, check_name, check_place, replacing
from ..errors import DefinitionError, ensure, instance_of, known_name, require, require_one_design, require_type
from ..frozen import immutable
from ..loads import PLAIN_CASE
from ..mechanism import Mechanism, played_along, require_mechanism
from ..motion import Column, Motion, Over, columns_of
from ..pictures.strokes import pose_words
from ..plugins import Plugins
from ..quantities import as_mapping, numbers_in
from ..reports import (
    NOTHING,
    At,
    Run,
    first_stroke,
    joined_tables,
    motion_over,
    one_run,
    rate_columns,
    reached_motion,
    results,
    run_words,
    runs_of,
    stroke_middles,
    write_csv,
)
from ..reports.runs import stroke_grid
from ..sketch import sketch_of, sketch_text
from ..study import WorkingField
from .calculation import Calculation
from .drawing import DrawnPose, Part, dxf, path_parts, pose_parts, svg
from .workbook import chart_content, check_count, workbook

MOST_ROWS, ROW = 500_000, 2000
"""The rows of a table that is written, and about how many bytes one takes on its way."""
MOST_POSES = 50
"""More poses in one drawing are no drawing any more."""


@immutable
class ExportJob:
    """The work of an export: a machine or a motion, the file's name, and the other arguments of `export`."""

    what: Mechanism | Motion
    name: str
    at: Mapping[str, Any]
    count: int
    trace: Sequence[str]
    columns: Sequence[Column]

    @property
    def motion(self) -> Motion:
        """The poses: of a motion its own; of a machine those at the values that `at` gives, else at the start of the first stroke.

        Strokes that are not named are at mid-stroke. NaN where a pose cannot be assembled; AssemblyError where none can.
        """
        if isinstance(self.what, Motion):
            return self.what
        return reached_motion(self.what, drawn_strokes(self.what, self.at))

    @property
    def machine(self) -> Mechanism:
        """The machine, where no motion can be written."""
        assert isinstance(self.what, Mechanism)
        return self.what


class Exporter(ABC):
    """A kind of file. A package adds its own by an entry point of `hydrolinkage.exporters`, whose name is the format's.

    `suffix` is how the names of its files end, `help` its line in lists. `takes` says which of `trace` and `columns` go with it; `batches`
    that a machine may be a batch of designs; `of_machines` is why a motion cannot be written, in words, "" where it can.
    """

    suffix: str
    help: str
    takes: frozenset[str] = frozenset()
    batches: bool = False
    of_machines: str = ""

    @abstractmethod
    def content(self, job: ExportJob) -> bytes:
        """Return the file's bytes."""

    def poses(self, job: ExportJob) -> Motion:
        """Return the poses that the file holds, NaN where one cannot be assembled: of them it is told which these are."""
        return job.motion


def sheet_run(job: ExportJob) -> Run:
    """Return the run of a workbook: the machine's first that goes from one value to another; else one stroke's, in its first load case."""
    runs = runs_of(job.machine, job.at)
    straight = (run for run in runs if run.is_curve and run.instants is None and {*map(len, run.ways.values())} == {2})
    return next(straight, None) or replace(one_run(job.machine, job.at), case=runs[0].case)


class Workbook(Exporter):
    """Live formulas, worked out anew by whatever opens them."""

    suffix = ".xlsx"
    help = "a workbook with live formulas"
    of_machines = "a workbook follows its dimensions"

    def content(self, job: ExportJob) -> bytes:
        return workbook(Calculation(job.machine, sheet_run(job), job.count), job.name)

    def poses(self, job: ExportJob) -> Motion:
        return job.machine.at(unreachable="nan", **sheet_run(job).over(np.linspace(0.0, 1.0, job.count)))


class Csv(Exporter):
    """A table of results: of a machine its own, along its `Over`s or over its strokes; of a motion its own columns, or `columns`."""

    suffix = ".csv"
    help = "a table in full precision"
    takes = frozenset({"columns"})
    batches = True

    def content(self, job: ExportJob) -> bytes:
        along = [(run_words(job.machine, run), results(job.machine, each, run.case or PLAIN_CASE)) for run, each in declared_motions(job)]
        columns, labels = joined_tables(along or [("", job.columns or self.columns(job))])
        stream = io.StringIO(newline="")
        write_csv(columns, stream, labels=labels)
        return stream.getvalue().encode("utf-8")

    def columns(self, job: ExportJob) -> list[Column]:
        """Return the columns of a machine over its strokes; of a motion in time the rates too, of one over an `Over` its results."""
        motion = self.poses(job)
        if isinstance(job.what, Mechanism):
            return results(job.what, motion)
        table, along = columns_of(motion), len(motion.strokes) + (motion.time is not None)
        table[along:along] = rate_columns(motion)
        if motion.is_swept and not motion._design_shape:
            with suppress(DefinitionError):  # a class that is not there any more has no table of its own
                table += results(played_along(motion, None)[0], motion)
        return [*{each.name: each for each in table}.values()]

    def poses(self, job: ExportJob) -> Motion:
        runs = [motion for _, motion in declared_motions(job)]
        if runs:
            return next((motion for motion in runs if not motion.reached.all()), runs[0])
        return job.what if isinstance(job.what, Motion) else over_strokes(job.what, job.at, job.count)


def declared_motions(job: ExportJob) -> list[tuple[Run, Motion]]:
    """Return the runs along the `Over`s of a design, each with its poses. Motions, strokes that are given and batches have no such runs."""
    machine, shares = job.what, np.linspace(0.0, 1.0, job.count)
    if not isinstance(machine, Mechanism) or job.at or job.columns or not machine.plan.of_kind(Over):
        return []
    if any(map(np.ndim, machine.dimensions.values())):
        return []
    found = list[tuple[Run, Motion]]()
    for run in runs_of(machine):
        motion: At | Motion = (
            motion_over(machine, run, shares) if run.instants is not None else run.divided(job.count) if run.is_curve else run.poses
        )
        found.append((run, reached_motion(machine, motion)))
    return [(replace(run, title=run.title or motion.over.words(motion)), motion) for run, motion in found] if len(found) > 1 else found


class TrueSize(Exporter):
    """A drawing in millimetres, true size, by layers; `write` makes the file's bytes of its poses, its paths and its title."""

    takes = frozenset({"trace"})

    def __init__(self, suffix: str, program: str, write: Callable[[Sequence[DrawnPose], Sequence[Part], str], bytes]) -> None:
        self.suffix, self.help, self.write = suffix, f"a true-size drawing for {program}", write

    def content(self, job: ExportJob) -> bytes:
        return self.write(*drawing_of(job))


class SketchFile(Exporter):
    """A machine of pins, links, slides, cranks and cylinders at one pose, for a program that draws such."""

    of_machines = "a sketch is of a machine, at the strokes that at= gives"

    def __init__(self, suffix: str, help: str) -> None:
        self.suffix, self.help = suffix, help

    def content(self, job: ExportJob) -> bytes:
        many = [name for name, value in job.at.items() if np.size(value) != 1]
        ensure(not many, f"{job.machine.plan.title}: a sketch is of one pose; give one value of {', '.join(many)}.")
        at = {name: float(np.ravel(value)[0]) for name, value in job.at.items()}
        return sketch_text(sketch_of(job.machine, at), self.suffix).encode("utf-8")


EXPORTERS = Plugins[Exporter](
    plugins.EXPORTERS,
    "The exporter",
    partial(instance_of, kind=Exporter),
    "no subclass of linkage.exports.Exporter",
    {
        "xlsx": Workbook(),
        "csv": Csv(),
        "dxf": TrueSize(".dxf", "CAD", dxf),
        "svg": TrueSize(".svg", "browsers", svg),
        "points": SketchFile(".csv", "a table of points and links"),
        "linkage2": SketchFile(".linkage2", "a file of Linkage"),
        "pmks": SketchFile(".txt", "text of PMKS"),
    },
)
"""The kinds of files there are, by the names of their formats."""


def exporter_of(file: Path, format: str | Exporter | None = None) -> Exporter:
    """Return the exporter of a file: the format that is named or given, else that of the file's ending.

    DefinitionError where there is none, naming those that are installed.
    """
    if format is not None:
        return EXPORTERS.for_object(format) or EXPORTERS[known_name("Format", format, EXPORTERS, where="export(...)")]
    own = [each for each in EXPORTERS.own.values() if each.suffix == file.suffix.lower()]
    if own:
        return own[0]
    found, faults = EXPORTERS.loaded()
    for each in found.values():
        if each.suffix == file.suffix.lower():
            return each
    what = f"{file}: the file's name ends in one of {', '.join(suffixes())}, which chooses what is written."
    raise DefinitionError(" ".join([what, *faults]))


def suffixes(option: str = "") -> list[str]:
    """Return the endings of the kinds of files, of those that an option goes with where one is named."""
    found, _ = EXPORTERS.loaded()
    return [*dict.fromkeys(each.suffix for each in found.values() if not option or option in each.takes)]


def export(
    what: Mechanism | Motion | WorkingField,
    path: Place,
    *,
    format: str | Exporter | None = None,
    at: Mapping[str, object] = NOTHING,
    count: int = 101,
    trace: Sequence[str] = (),
    columns: Sequence[Column] = (),
) -> Path:
    """Return the path of the file it wrote for another program: `export(hitch, "hitch.xlsx")`. The ending of the name says which.

    * .xlsx (extra `xlsx`) is a workbook of live formulas, the numbered equations one after the other at `count` poses of a stroke. A
      dimension typed over changes all of it. `at=dict(tilt=0.1)` holds a stroke, `at=dict(S=(0.1, 0.2))` says where one runs. What no
      formula gives (pins found by iteration) is a number there, marked so.
    * .csv is the table of results in full precision. Of a machine it goes along its `Over`s; where it declares none, or `at` is given, over
      its strokes, `count` poses each of those that `at` does not give. Of a motion it has its poses, with its points and outputs or the
      `columns` given; over an `Over` the results too, in a load case that occurs there, over time also the rates and the accelerations of
      the strokes.
    * .dxf (extra `cad`) and .svg are a drawing in millimetres, true size, by layers. Of a machine it has a pose each of the strokes that
      `at` gives (default: the start of the first stroke), of a motion all its poses. `trace` names points whose paths are drawn.
    * .linkage2 and .txt are the machine as a drawing in Linkage and PMKS, `format="points"` a table of points and links (.csv).
    * Of a working field .csv has a row each cell, .xlsx the chart as it is printed, too.

    Other kinds of files come with packages that are installed; `format="mjcf"` says by its name which kind is meant, whatever the ending.
    An `Exporter` of your own may be given as it is, `format=Gcode()`.

    An existing file is replaced whole, or left as it was. Raises DefinitionError for another kind of file, for what does not go with
    it, for a batch of designs, and where the extra is not installed. AssemblyError stands for poses out of reach, FileError for a path
    that cannot be written.

    Parameters
    ----------
    what : Mechanism, Motion or WorkingField
        The object to write.
    path : str or Path
        The file to write.
    format : str or Exporter, optional
        The kind of file; by default that of the ending.
    at : mapping
        Strokes to hold, or to run between values, by name [m or rad].
    count : int
        The number of poses of each stroke.
    trace : sequence of str, optional
        The points whose paths are drawn.
    columns : sequence of Column
        The columns of a motion's table.

    Returns
    -------
    Path
        The file written.

    Raises
    ------
    DefinitionError
        Another kind of file, or arguments that do not go with it.
    AssemblyError
        Poses out of reach.
    FileError
        The path cannot be written.
    """
    check_name(path)
    file = Path(path)
    if isinstance(what, WorkingField):
        check_place(path)
        content = chart_content(what, file.suffix.lower(), file.name)
    else:
        exporter = exporter_of(file, format)
        check_exportable(what, exporter, at, trace, columns)
        check_place(path)
        content = exporter.content(ExportJob(what, file.name, at, check_count(count), trace, columns))
    with replacing(path) as stream:
        stream.write(content)
    return file


def check_exportable(what: Mechanism | Motion, exporter: Exporter, at: object, trace: object, columns: object) -> None:
    """Raise DefinitionError for anything but a machine or a motion, and for arguments that a kind of file does not take."""
    if not isinstance(what, Motion):
        require_mechanism(what)
    title = what.plan.title
    if isinstance(what, Mechanism) and not exporter.batches:
        require_one_design(what.dimensions, f"{title}: a file holds one design")
    if isinstance(what, Motion) and exporter.of_machines:
        raise DefinitionError(f"{title}: {exporter.of_machines}, so it is made of a machine: export(machine, ...).")
    given = require_type(f"{title}: at", at, Mapping, "values of strokes by name are expected, such as at=dict(S=0.1)", of=str)
    for name, value in given.items():
        require(numbers_in(value).size, f"{title}: at: {name}", value, "a number or several are expected, in SI")
    ensure(not (isinstance(what, Motion) and at), f"{title}: a motion has its poses; at= goes with a machine.")
    require_type(f"{title}: trace", trace, (list, tuple), 'a list of points is expected, such as trace=["G"]')
    require_type(f"{title}: columns", columns, (list, tuple), "a list of columns is expected, such as results(machine, motion)", of=Column)
    ensure(not trace or "trace" in exporter.takes, f"{title}: trace= draws the paths of points, in {' and '.join(suffixes('trace'))}.")
    ensure(not columns or "columns" in exporter.takes, f"{title}: columns= chooses what a {' or a '.join(suffixes('columns'))} holds.")


def over_strokes(machine: Mechanism, at: Mapping[str, Any], count: int) -> Motion:
    """Return a motion over the strokes that `at` does not name, at `count` poses each: a grid where there are several; with gaps."""
    first_stroke(machine)
    free = {name: np.linspace(each.start, each.end, count) for name, each in machine.strokes.items()}
    axes = {name: np.atleast_1d(at.get(name, values)) for name, values in free.items()}
    many = [name for name, axis in axes.items() if len(axis) > 1 or name not in at]
    rows = int(np.prod([float(len(axes[name])) for name in many]))
    if rows > MOST_ROWS:
        each = " x ".join(str(len(axes[name])) for name in many)
        most = int(MOST_ROWS ** (1.0 / len(many)))
        hold = as_mapping(dict.fromkeys(many[1:] or many, "..."))
        said = f"{machine.plan.title}: {each} poses are {rows:,} rows, some {rows * ROW / 1e9:.1f} GB"
        raise DefinitionError(f"{said}; give count={most} at most, or hold strokes, at={hold}.")
    return reached_motion(machine, {**at, **stroke_grid(machine, axes, many)})


def drawing_of(job: ExportJob) -> tuple[list[DrawnPose], tuple[Part, ...], str]:
    """Return the poses, each in words and its parts, the paths and the title of a drawing.

    Paths go through the poses of a motion, of a machine over its first stroke.
    """
    motion = path = job.motion
    if isinstance(job.what, Mechanism) and job.trace:
        first = first_stroke(job.what)
        moving = max(job.at, key=lambda name: np.size(job.at[name])) if job.at else first
        held = {name: float(np.ravel(value)[0]) for name, value in drawn_strokes(job.what, job.at).items()}
        end = job.what.strokes.get(moving, job.what.strokes[first])
        path = job.what.at(unreachable="nan", **{**held, moving: np.linspace(end.start, end.end, job.count)})
    indices = [int(each) for each in np.flatnonzero(np.broadcast_to(motion.reached, motion.shape).ravel())] if motion.shape else [0]
    ensure(len(indices) <= MOST_POSES, f"{motion.plan.title}: {len(indices)} poses do not go into one drawing; choose up to {MOST_POSES}.")
    poses: list[DrawnPose] = [(pose_words(motion, index), tuple(pose_parts(motion, index))) for index in indices]
    return poses, path_parts(path, job.trace), motion.plan.heading


def drawn_strokes(machine: Mechanism, at: Mapping[str, Any]) -> dict[str, Any]:
    """Return the strokes of the poses of a drawing: those given, else the start of the first one, the others in their middle."""
    first = first_stroke(machine)
    values = stroke_middles(machine) | {first: machine.strokes[first].start} | dict(at)
    return {name: np.atleast_1d(value) for name, value in values.items()}
