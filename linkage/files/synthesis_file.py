"""A synthesis as a file: the task, the variables, the conditions, and the outputs.

machine = "four_bar"

[synthesis]
path = { of = "P", points = "points.csv" }
subject_to = ["least(transmission(B)) >= 40 deg"]

[synthesis.vary]
OA = "20 to 60 mm"
C = "within 60 mm"
"""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Annotated, Any, TypeAlias

import numpy as np

from ..errors import DefinitionError, cited, ensure, known_name, require, require_type
from ..frozen import immutable, record
from ..motion import outside, stroke_measure
from ..motion.measures import Condition, Measure, measure_of, words_of
from ..program import FloatArray
from ..quantities import is_number
from ..study.optimise import METHODS as SEARCH_METHODS
from ..study.optimise import optimise
from ..study.optimum import COARSEST
from ..study.problem import is_still, ranges_of
from ..study.space import point_regions, size_of_machine
from ..study.survey import Progress
from ..surroundings import Outline
from ..synthesis import FunctionTask, PathTask, PoseTask, synthesise
from ..units import UNITS, factor
from . import study_file
from .expression import condition_said, measure_said, quantity_said
from .source import Keywords, Mistakes, csv_rows, each_of, heading_read, is_numeral, unit_factor
from .study_file import FindMachine, Read, Settings, StudyHead, amount_said

# A search as a file: what is least or greatest, what may vary, and what must be kept.
#
# machine = "three_point_hitch"
# maximise = "least(capacity(lift, G))"
# subject_to = ["most(abs(tilt)) <= 18 deg", "reachable", "least(transmission(K)) >= 35 deg"]
#
# [vary]
# OB = "270 to 330 mm"
# M = "within 60 mm"

SEARCH_OUTPUTS: Mapping[str, tuple[str, ...]] = {
    "table": (".csv",),
    "designs": (".csv", ".jsonl"),
    "drawing": study_file.PICTURE_SUFFIXES,
    "curves": study_file.PICTURE_SUFFIXES,
    "machine": (".toml", ".json"),
}
ROUND_KEYS = {"to": "length", "angle": "angle"}
REGION_WORDS = (
    'corners [["0 mm", "0 mm"], ["90 mm", "0 mm"], ["90 mm", "60 mm"]], an outline "plate", "outside(wheel)", '
    '{ at = ["10 mm", "0 mm"], radius = "50 mm" }, { outside = ... }, or a list of these'
)
_NUMBER = re.compile(r"\s*[-+.\d]")
_OUTSIDE = re.compile(r"\s*outside\s*\(\s*(?P<outline>[^()]+?)\s*\)\s*\Z")


@immutable
class SearchFile:
    """A search that a file asks for: its function, the machine or several, the keywords, the steps of `round`, and the files of results."""

    search: Callable[..., Any]
    machine: Any
    arguments: Keywords
    rounding: Mapping[str, float] | None
    outputs: Mapping[str, tuple[Path, ...]]

    def run(self, folder: str | os.PathLike[str] | None = None, progress: bool | Progress = False) -> Any:
        """Return the result of the search; `folder` replaces the file's own."""
        return self.search(self.machine, **{**self.arguments, "folder": folder or self.arguments.get("folder")}, progress=progress)


def read_search(path: str | os.PathLike[str], find: FindMachine, settings: Settings = lambda machine: {}) -> SearchFile:
    """Return the search that a TOML or JSON file asks for; FileError with every mistake, its line and its key.

    `find` returns a class by the machine's text; `settings` are dimensions that stand above those of the file.
    """
    head = StudyHead.of(path, (*SEARCH, "outputs"), find, settings)
    data, faults = head.data, head.faults
    arguments: Keywords = {}
    with faults.at_key():
        arguments = study_file.keywords_read(head, optimise, {key: data[key] for key in data if key in SEARCH}, SEARCH)
    count = sum(len(each) if isinstance(each, list) else 1 for each in (data.get("minimise"), data.get("maximise")) if each)
    if not count:
        faults.add((), 'say minimise or maximise, one measure such as maximise = "least(...)", or a list of several.')
    outputs = study_file.outputs_said(head, SEARCH_OUTPUTS)
    if count > 1:
        for name in outputs.keys() - {"designs"}:
            faults.add(("outputs", name), "of several objectives there is no single best design; write its front by designs = ...")
        if "folder" in data:
            faults.add(("folder",), "the search of several objectives is not kept in a folder; leave it out.")
    faults.check()
    rounding = arguments.pop("round", None)
    return SearchFile(optimise, head.machine, arguments, rounding, outputs)


# What reads a key of a search.


def objective_said(head: StudyHead, given: object) -> Measure:
    """Return the measure of a text, to minimise or maximise."""
    return measure_said(given, head.machine, head.found["over"])


def objectives_said(head: StudyHead, given: object) -> list[Measure]:
    """Return the measures to minimise or maximise: that of a text, or those of a list, mistakes under their numbers."""
    return study_file.texts_said(given, partial(objective_said, head)) if isinstance(given, list) else [objective_said(head, given)]


def conditions_said(head: StudyHead, given: object) -> list[Condition]:
    """Return the conditions of a list of texts; SeveralError with all mistakes, each under its number."""
    given = require_type("", given, (str, list), 'a list of conditions is expected, such as ["most(tilt) <= 8 deg"]')
    return study_file.texts_said(given, lambda text: condition_said(text, head.machine, head.found["over"]))


def regions_said(head: StudyHead, given: object) -> Keywords:
    """Return the regions of points as `optimise` takes them; SeveralError with all mistakes, each under its point."""
    given = require_type("", given, Mapping, 'a region for each point is expected, such as regions = { C = "plate" }')

    def region_said(point: str, shapes: object) -> tuple[str, object]:
        region = shape_said(shapes)
        point_regions(head.machine, {point: region}, {}, ())
        return point, region

    return dict(each_of(given.items(), region_said))


def shape_said(given: Any) -> Any:
    """Return a shape, or the shapes of a list: corners, an outline's name, a circle, `outside(...)` of an outline, or outside of any."""
    match given:
        case str():
            forbidden = _OUTSIDE.match(given)
            return given if forbidden is None else outside(forbidden.group("outline"))
        case {"outside": shapes, **others} if not others:
            return outside(shape_said(shapes))
        case {"at": [x, y], "radius": radius, **others} if not others and is_corner([x, y]):
            return Outline.circle((amount_said(x, "length"), amount_said(y, "length")), amount_said(radius, "length"))
        case [_, *_] if all(map(is_corner, given)):
            return [tuple(amount_said(each, "length") for each in corner) for corner in given]
        case [_, *_]:
            return [shape_said(each) for each in given]
    raise DefinitionError(f"{cited(given)} is no region; write {REGION_WORDS}.")


def is_corner(given: object) -> bool:
    """Return whether this is a pair of coordinates, as numbers or with their units."""
    return isinstance(given, list) and len(given) == 2 and all(is_number(each) or _NUMBER.match(str(each)) for each in given)


def rounding_said(head: StudyHead, given: object) -> dict[str, float] | None:
    """Return the steps that a design is rounded to [m or rad]; None for none."""
    if given is None:
        return None
    found: dict[str, float] = {}
    for step, value in (given if isinstance(given, Mapping) else {"to": given}).items():
        ensure(step in ROUND_KEYS, f'{step} is no step; write round = {{ to = "1 mm", angle = "0.1 deg" }}.')
        found[step] = amount_said(value, ROUND_KEYS[step])
        require(found[step] > 0.0, "", value, "a step above zero is expected")
        if step == "to" and found[step] > COARSEST * size_of_machine(head.machine):
            raise DefinitionError(f'{cited(value)} is as coarse as the machine; write it with its unit, "1 mm".')
    return found


SEARCH: Mapping[str, Read] = {
    "over": study_file.over_said,
    "minimise": objectives_said,
    "maximise": objectives_said,
    "vary": study_file.vary_said,
    "subject_to": conditions_said,
    "regions": regions_said,
    "case": study_file.case_said,
    "robust": partial(study_file.tolerances_said, "robust"),
    "sigmas": lambda head, given: amount_said(given, ""),
    "method": partial(study_file.word_said, SEARCH_METHODS),
    "starts": partial(study_file.count_at_least, 1),
    "seed": partial(study_file.count_at_least, 0),
    "limit": partial(study_file.count_at_least, 1),
    "folder": study_file.file_path,
    "round": rounding_said,
}
"""The keywords of `optimise` that a file may say, and the steps of `round`, each with what reads it."""


SECTION = "synthesis"
SYNTHESIS_OUTPUTS: Mapping[str, tuple[str, ...]] = {
    "table": (".csv",),
    "drawing": study_file.PICTURE_SUFFIXES,
    "page": (".html",),
    "machine": (".toml", ".json"),
}


def read_synthesis(path: str | os.PathLike[str], find: FindMachine, settings: Settings = lambda machine: {}) -> SearchFile:
    """Return the synthesis that a TOML or JSON file asks for; FileError with every mistake, its line and its key; as `read_search`."""
    head = replace(StudyHead.of(path, (SECTION, "outputs"), find, settings, several=True), section=SECTION)
    faults, given = head.faults, head.data.get(SECTION)
    arguments: Keywords = {}
    with faults.at_key(SECTION):
        if not isinstance(given, Mapping):
            raise DefinitionError('a table is expected, [synthesis] with path = { of = "P", points = "points.csv" } and vary = { ... }.')
        named = [name for name in SYNTHESIS_TASKS if name in given]
        if len(named) != 1:
            words = f"{' and '.join(named)} are several tasks" if named else "there is no task"
            faults.add((SECTION,), f'{words}; write one, path = {{ of = "P", points = "points.csv" }}, function = ... or motion = ...')
        arguments = study_file.keywords_read(head, synthesise, given if head.machines else {"vary": {}, **given}, SYNTHESIS)
        arguments = {key: value for key, value in arguments.items() if not head.machines or value != {}}
    outputs = study_file.outputs_said(head, SYNTHESIS_OUTPUTS)
    faults.check()
    rounding = arguments.pop("round", None)
    return SearchFile(synthesise, [*head.machines.values()] or head.machine, arguments, rounding, outputs)


# What reads a key of a synthesis.


def by_class(read: Read, head: StudyHead, given: Any, *, is_of_points: bool = False) -> Any:
    """Return one thing of a machine; of several machines by class, from a table by their names or from one thing for all.

    What is read by points is one thing where another name than a machine's stands in the table.
    """
    if not head.machines:
        return read(head, given)
    is_table = isinstance(given, Mapping) and not (is_of_points and not set(given) <= set(head.machines))
    found, mistakes = {}, Mistakes()
    for name, said in (given if is_table else dict.fromkeys(head.machines, given)).items():
        with mistakes.at_key():
            machine = head.machines[known_name("Machine", name, head.machines)]
            found[type(machine)] = read(replace(head, machine=machine), said)
    mistakes.check()
    return found


def timed_said(head: StudyHead, given: object) -> object:
    """Return how the points are timed: true, false or "steps"."""
    require(isinstance(given, bool) or given == "steps", "", given, 'true, false or "steps" is expected')
    return given


# The task.


def switch_said(key: str, head: StudyHead, given: object) -> bool:
    """Return true or false under a key."""
    return require_type(key, given, bool, "true or false is expected")


OF = {"path": 'of = "P"', "function": 'of = "psi"', "motion": 'of = "A B"'}
POINTS = 'points = [[30, 60], [15, 70]] with unit = "mm", or a CSV file, "points.csv"'


def subject_said(name: str, head: StudyHead, given: object) -> Any:
    """Return the task's subject: a point, a quantity, two points."""
    if not isinstance(given, str) or not given.strip():
        raise DefinitionError(f"of is missing; write {OF[name]}." if given is None else f"{cited(given)}: write {OF[name]}.")
    if name == "function":
        found = quantity_said(given, head.machine)
        return given.strip() if given.strip() in head.plan.members else found
    parts = given.split()
    for each in parts:
        known_name("Point", each, head.plan.moving, where=head.plan.title)
    if len(parts) != (1 if name == "path" else 2):
        raise DefinitionError(f"{given!r}: {'one point' if name == 'path' else 'two points of the body'} expected.")
    return given


def wanted_points(name: str, head: StudyHead, given: object) -> Keywords:
    """Return the points of a task; the column of the stroke goes by its own name or `at`."""
    if "of" not in head.found:
        return {}  # which is told
    of = head.found["of"]
    moving = [each for each, one in ranges_of(head.machine, head.found["over"]).items() if not is_still(one)]
    stroke = (moving or [*head.plan.strokes])[0]
    at = PointColumn(("at", stroke), stroke_measure(head.plan, stroke), optional=name != "function")
    columns = [PointColumn(("x",), "length"), PointColumn(("y",), "length"), at]
    if name == "motion":
        columns.insert(2, PointColumn(("angle",), "angle"))
    if name == "function":
        first = next(iter(of.values())) if head.machines else of
        columns = [at, PointColumn(("value", words_of(first)), measure_of(head.plan, first))]
    return points_said(given, columns, head.found["unit"] or {}, head.base)


def units_said(head: StudyHead, given: object) -> dict[str, float]:
    """Return factors of units by their kinds: of `"mm"`, or of a list `["mm", "deg"]`; DefinitionError for anything but a unit."""
    names = [known_name("Unit", each, UNITS) for each in (given if isinstance(given, list) else [given])]
    return {UNITS[name][1]: factor(name) for name in names}


Units: TypeAlias = Annotated[dict[str, float] | None, units_said]
"""Factors of the units of points that have none, by what they measure."""


def path_task(
    *,
    of: Annotated[Any, partial(by_class, partial(subject_said, "path")), OF["path"]],
    unit: Units = None,
    points: Annotated[Keywords, partial(wanted_points, "path"), POINTS],
    in_order: Annotated[bool, partial(switch_said, "in_order")] = True,
    closed: Annotated[bool | None, partial(switch_said, "closed")] = None,
) -> PathTask:
    """Return the task of a path."""
    return PathTask([*zip(points["x"], points["y"], strict=True)], of or None, points.get("at"), in_order=in_order, closed=closed)


def function_task(
    *,
    of: Annotated[Any, partial(by_class, partial(subject_said, "function")), OF["function"]],
    unit: Units = None,
    points: Annotated[Keywords, partial(wanted_points, "function"), POINTS],
) -> FunctionTask:
    """Return the task of a function of the stroke."""
    return FunctionTask(points["at"], points["value"], of)


def motion_task(
    *,
    of: Annotated[Any, partial(by_class, partial(subject_said, "motion")), OF["motion"]],
    unit: Units = None,
    points: Annotated[Keywords, partial(wanted_points, "motion"), POINTS],
    in_order: Annotated[bool, partial(switch_said, "in_order")] = True,
    length: Annotated[float | None, lambda head, given: amount_said(given, "length")] = None,
) -> PoseTask:
    """Return the task of the poses of a body."""
    return PoseTask(points["x"], points["y"], points["angle"], of, points.get("at"), length=length, in_order=in_order)


SYNTHESIS_TASKS: Mapping[str, Callable[..., Any]] = {"path": path_task, "function": function_task, "motion": motion_task}


def task_said(name: str, head: StudyHead, given: object) -> Any:
    """Return the task of a table. The path of several machines may be left to their couplers' points."""
    given = require_type("", given, Mapping, f'a table is expected, {name} = {{ of = "P", points = "points.csv" }}')
    if name == "path" and head.machines and given.get("of") is None:
        given = {**given, "of": {}}
    return SYNTHESIS_TASKS[name](**study_file.keywords_read(head, SYNTHESIS_TASKS[name], given))


SYNTHESIS: Mapping[str, Read] = {
    "over": study_file.over_said,
    "vary": partial(by_class, study_file.vary_said),
    "subject_to": partial(by_class, conditions_said),
    "regions": partial(by_class, regions_said, is_of_points=True),
    "timed": timed_said,
    "rank": partial(by_class, objective_said),
    "case": study_file.case_said,
    "starts": lambda head, given: given if given == "catalogue" else study_file.count_at_least(1, head, given),
    "seed": partial(study_file.count_at_least, 0),
    "limit": partial(study_file.count_at_least, 1),
    "folder": study_file.file_path,
    "round": rounding_said,
    **{name: partial(task_said, name) for name in SYNTHESIS_TASKS},
}
"""The keywords of `synthesise` that a file may say, and the steps of `round`, each with what reads it."""


# Rows of wanted values: as they stand in the file, or in a CSV file beside it with its units in its headings.
#
#     x [mm], y [mm], phi [deg]
#     30.0, 60.0, 12


@record
class PointColumn:
    """A column of a task's points: its names, the first of which messages use, its kind, and whether it may be missing."""

    names: tuple[str, ...]
    measures: str
    optional: bool = False

    @property
    def name(self) -> str:
        """Its first name."""
        return self.names[0]


def points_said(given: object, columns: Sequence[PointColumn], units: Mapping[str, float], base: Path) -> dict[str, FloatArray]:
    """Return wanted values by the names of columns [SI]; DefinitionError for anything else.

    `given` are rows, or a text, the CSV file with them, from the folder `base`. `units` are factors of plain numbers by what they measure.
    """
    if isinstance(given, str):
        return points_of_file(base / given, columns, units)
    words = ", ".join(each.name for each in columns if not each.optional)
    expected = f'rows of {words} are expected, [[30, 60], [15, 70]], or a CSV file, "points.csv"'
    given = require_type("", given, list, expected)
    require(given, "", given, expected)
    sizes = {len(columns), len([each for each in columns if not each.optional])}
    for number, row in enumerate(given, 1):
        if not isinstance(row, list) or len(row) not in sizes or len(row) != len(given[0]):
            raise DefinitionError(f"row {number}, {cited(row)}: a list with {words} is expected, all rows of one length.")
    found = {}
    for place, column in enumerate(columns[: len(given[0])]):
        by = units.get(column.measures, 1.0)
        values = [amount_said(row[place], column.measures) * (by if is_number(row[place]) else 1.0) for row in given]
        found[column.name] = np.array(values)
    return found


def points_of_file(path: Path, columns: Sequence[PointColumn], units: Mapping[str, float]) -> dict[str, FloatArray]:
    """Return the columns of a CSV file [SI]; DefinitionError with the file and the line of a mistake."""
    rows = [*csv_rows(path)]
    ensure(rows, f"{path.name} holds no row; write a heading such as x [mm], y [mm], and a row for each point.")
    line, first = rows[0]
    if all(is_numeral(cell) for cell in first):
        needed = [each for each in columns if not each.optional]
        chosen = columns if len(first) == len(columns) else needed
        if len(first) != len(chosen):
            words = ", ".join(each.name for each in needed)
            raise DefinitionError(f"{path.name}, line {line}: {len(first)} numbers where {words} are expected; or begin with headings.")
        places = {each.name: (place, units.get(each.measures, 1.0)) for place, each in enumerate(chosen)}
    else:
        places, rows, heads = {}, rows[1:], [*map(heading_read, first)]
        for column in columns:
            for place, (name, unit) in enumerate(heads):
                if name in column.names and column.name not in places:
                    by = units.get(column.measures, 1.0)  # without a unit that which is said for what the column measures
                    if unit:
                        by = unit_factor(unit, (column.measures,), f"{path.name}, line 1, {name}")
                    places[column.name] = place, by
            if column.name not in places and not column.optional:
                named = " or ".join(column.names)
                raise DefinitionError(f"{path.name}, line 1: there is no column {named}; its headings are {', '.join(first)}.")
    found: dict[str, list[float]] = {name: [] for name in places}
    for line, row in rows:
        ensure(len(row) == len(first), f"{path.name}, line {line}: {len(row)} fields where the first line has {len(first)}.")
        for name, (place, by) in places.items():
            ensure(is_numeral(row[place]), f"{path.name}, line {line}, {name}: {cited(row[place])} is no finite number.")
            found[name].append(float(row[place]) * by)
    ensure(rows, f"{path.name} has headings and no row; write a row for each point.")
    return {name: np.array(values) for name, values in found.items()}
