"""A synthesis as a file: the task, what may vary, what must be kept, and where the results go.

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
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, final

from ..errors import DefinitionError, known_name, unknown
from ..mechanism import Mechanism
from ..motion import stroke_measure
from ..motion.kinds import measure_of
from ..motion.measures import words_of
from ..study.problem import is_still, ranges_of
from ..study.survey import Progress
from ..synthesis import FunctionTask, PathTask, PoseTask, Synthesis
from ..synthesis.task_search import synthesise
from ..synthesis.tasks import Task
from .criterion import measure_said, quantity_said
from .names import shortened
from .points import PointColumn, points_said, units_said
from .search_file import conditions_listed, regions_said, rounding_said
from .study_file import PICTURE_SUFFIXES, FindMachine, StudyHead, amount_said, case_said, count_said, outputs_said, over_said, vary_said

SECTION = "synthesis"
TASK_KEYS: Mapping[str, tuple[str, ...]] = {
    "path": ("of", "points", "unit", "in_order", "closed"),
    "function": ("of", "points", "unit"),
    "motion": ("of", "points", "unit", "in_order", "length"),
}
SYNTHESIS_KEYS = (
    *TASK_KEYS, "vary", "subject_to", "regions", "timed", "rank", "case", "over", "starts", "seed", "limit", "folder", "round",
)  # fmt: skip
SYNTHESIS_OUTPUTS: Mapping[str, tuple[str, ...]] = {
    "table": (".csv",),
    "drawing": PICTURE_SUFFIXES,
    "page": (".html",),
    "machine": (".toml", ".json"),
}


@final
@dataclass(frozen=True, eq=False)
class SynthesisFile:
    """A synthesis that a file asks for: one machine or several, what `synthesise` takes, the steps of `round`, where results go."""

    machine: Mechanism | list[Mechanism]
    arguments: Mapping[str, Any]
    rounding: Mapping[str, float] | None
    outputs: Mapping[str, tuple[Path, ...]]

    def run(self, folder: str | os.PathLike[str] | None = None, progress: bool | Progress = False) -> Synthesis:
        """Return the machines that do the task; `folder` stands above the file's own."""
        own = self.arguments.get("folder")
        machine: Any = self.machine
        return synthesise(machine, **{**self.arguments, "folder": folder or own}, progress=progress)


def read_synthesis(
    path: str | os.PathLike[str], find: FindMachine, settings: Callable[[type[Mechanism]], Mapping[str, Any]] = lambda machine: {}
) -> SynthesisFile:
    """Return the synthesis that a TOML or JSON file asks for; FileError with every mistake, its line and its key.

    `find` returns a class by the machine's text; `settings` are dimensions that stand above those of the file.
    """
    head = StudyHead.of(path, (SECTION, "outputs"), find, settings, several=True)
    faults, given = head.faults, head.data.get(SECTION)
    if not isinstance(given, Mapping):
        faults.add((SECTION,), 'a table is expected, [synthesis] with path = { of = "P", points = "points.csv" } and vary = { ... }.')
        faults.check()
    assert isinstance(given, Mapping)
    for key in given:
        if key not in SYNTHESIS_KEYS:
            faults.add((SECTION, str(key)), str(unknown("Key", shortened(key, quote=False), SYNTHESIS_KEYS)))
    over = over_said(head, given["over"], SECTION) if "over" in given else None
    arguments: dict[str, Any] = {} if over is None else {"over": over}
    arguments |= varied_and_kept(head, given, over)
    readers: Mapping[str, Callable[[Any], Any]] = {
        "timed": timed_said,
        "case": lambda text: case_said(head, text),
        "starts": lambda given: given if given == "catalogue" else count_said(given, 1),
        "seed": lambda number: count_said(number, 0),
        "limit": lambda number: count_said(number, 1),
        "folder": head.path_of,
    }
    for key, read in readers.items():
        if key in given:
            with faults.at(SECTION, key):
                arguments[key] = read(given[key])
    arguments |= task_said(head, given, over)
    rounding = rounding_said(head, given.get("round"), SECTION)
    outputs = outputs_said(head, SYNTHESIS_OUTPUTS)
    faults.check()
    machine: Any = [*head.machines.values()] if head.machines else head.machine
    return SynthesisFile(machine, arguments, rounding, outputs)


def varied_and_kept(head: StudyHead, given: Mapping[str, object], over: Mapping[str, object] | None) -> dict[str, Any]:
    """Return what varies, what must be kept and what answers are ranked by; mistakes are noted.

    Of several machines these are tables by the machines' names, or one thing for all; what `vary` leaves out the search chooses.
    """
    if not head.machines:
        every = {key: read for key, read in BY_CLASS.items() if key != "rank"}
        found = {key: read(head, given.get(key, [] if key == "subject_to" else {}), over) for key, read in every.items()}
        return found | ({"rank": rank_said(head, given["rank"], over)} if "rank" in given else {})
    several: dict[str, dict[type[Mechanism], Any]] = {}
    for key, read in BY_CLASS.items():
        for name, said in by_machine(head, given.get(key, {}), is_of_points=key == "regions").items():
            with head.faults.at(SECTION, key):
                machine = head.machines[known_name("Machine", name, head.machines)]
                several.setdefault(key, {})[type(machine)] = read(replace(head, machine=machine), said, over)
    return dict(several)


def by_machine(head: StudyHead, given: object, *, is_of_points: bool = False) -> Mapping[Any, Any]:
    """Return what is said by the machines' names, the same of each where it is no table, or one by points with another name in it."""
    if not isinstance(given, Mapping) or (is_of_points and not set(given) <= set(head.machines)):
        return dict.fromkeys(head.machines, given)
    return given


def rank_said(head: StudyHead, given: object, over: Mapping[str, object] | None) -> Any:
    """Return the measure that answers are ranked by; None, noted, for anything else."""
    found = None
    with head.faults.at(SECTION, "rank"):
        found = measure_said(given, head.machine, over)
    return found


BY_CLASS: Mapping[str, Callable[[StudyHead, Any, Any], Any]] = {
    "vary": lambda head, given, over: vary_said(head, given, SECTION),
    "subject_to": lambda head, given, over: conditions_listed(head, given, over, SECTION),
    "regions": lambda head, given, over: regions_said(head, given, SECTION),
    "rank": rank_said,
}
"""What may be said class by class, and what reads it."""


def timed_said(given: object) -> Any:
    """Return how the points are timed: true, false or "steps"."""
    if given is not True and given is not False and given != "steps":
        raise DefinitionError(f'{shortened(given)}: true, false or "steps" is expected.')
    return given


# The task.


def task_said(head: StudyHead, section: Mapping[str, object], over: Mapping[str, object] | None) -> dict[str, Task]:
    """Return the task of a section by its keyword; mistakes are noted."""
    named = [name for name in TASK_KEYS if name in section]
    found: dict[str, Task] = {}
    if len(named) != 1:
        words = f"{' and '.join(named)} are several tasks" if named else "there is no task"
        head.faults.add((SECTION,), f'{words}; write one, path = {{ of = "P", points = "points.csv" }}, function = ... or motion = ...')
        return found
    (name,) = named
    given = section[name]
    with head.faults.at(SECTION, name):
        table = table_said(name, given)
        of: Any = None
        with head.faults.at(SECTION, name, "of"):
            of = of_said(head, name, table.get("of")) if not head.machines else of_machines(head, name, table.get("of"))
        units: dict[str, float] = {}
        with head.faults.at(SECTION, name, "unit"):
            units = units_said(table["unit"]) if "unit" in table else {}
        with head.faults.at(SECTION, name, "points"):
            if of is not None:
                values = points_said(table["points"], task_columns(head, name, of, over), units, head.base)
                found[name] = task_of_values(name, table, of or None, values)
    return found


def of_machines(head: StudyHead, name: str, given: object) -> dict[type[Mechanism], Any]:
    """Return whose path, values or poses are wanted of each class; none for a path if the machines name their coupler's point."""
    if given is None and name == "path":
        return {}
    found = {}
    for machine, text in by_machine(head, given).items():
        own = head.machines[known_name("Machine", machine, head.machines)]
        found[type(own)] = of_said(replace(head, machine=own), name, text)
    return found


def table_said(name: str, given: object) -> Mapping[str, Any]:
    """Return the table of a task with its points; DefinitionError for anything else."""
    if not isinstance(given, Mapping):
        raise DefinitionError(f'{shortened(given)}: a table is expected, {name} = {{ of = "P", points = "points.csv" }}.')
    for key in given:
        if key not in TASK_KEYS[name]:
            raise unknown("Key", shortened(key, quote=False), TASK_KEYS[name])
    if "points" not in given:
        raise DefinitionError('points is missing; write points = [[30, 60], [15, 70]] with unit = "mm", or a CSV file, "points.csv".')
    return given


def of_said(head: StudyHead, name: str, given: object) -> Any:
    """Return whose path, values or poses are wanted: a point, a quantity, two points."""
    if not isinstance(given, str) or not given.strip():
        example = {"path": 'of = "P"', "function": 'of = "psi"', "motion": 'of = "A B"'}[name]
        raise DefinitionError(f"of is missing; write {example}." if given is None else f"{shortened(given)}: write {example}.")
    if name == "function":
        found = quantity_said(given, head.machine)
        return given.strip() if given.strip() in head.plan.members else found
    parts = given.split()
    for each in parts:
        if each not in head.plan.moving:
            raise unknown("Point", each, head.plan.moving, where=head.plan.title)
    if len(parts) != (1 if name == "path" else 2):
        raise DefinitionError(f"{given!r}: {'one point' if name == 'path' else 'two points of the body'} expected.")
    return given


def task_columns(head: StudyHead, name: str, of: Any, over: Mapping[str, Any] | None) -> list[PointColumn]:
    """Return the columns that a task's points have; the stroke's goes by its own name or `at`."""
    moving = [each for each, one in ranges_of(head.machine, over).items() if not is_still(one)]
    stroke = (moving or [*head.plan.strokes])[0]
    at = PointColumn(("at", stroke), stroke_measure(head.plan, stroke), optional=name != "function")
    lengths = [PointColumn(("x",), "length"), PointColumn(("y",), "length")]
    if name == "path":
        return [*lengths, at]
    if name == "motion":
        return [*lengths, PointColumn(("angle",), "angle"), at]
    first = next(iter(of.values())) if head.machines else of
    return [at, PointColumn(("value", words_of(first)), measure_of(head.plan, first))]


def task_of_values(name: str, given: Mapping[str, Any], of: Any, values: Mapping[str, Any]) -> Task:
    """Return a task of its values [SI]."""
    at = values.get("at")
    for key in ("in_order", "closed"):
        if not isinstance(given.get(key, True), bool):
            raise DefinitionError(f"{key} = {shortened(given[key])}: true or false is expected.")
    order = given.get("in_order", True)
    if name == "path":
        return PathTask([*zip(values["x"], values["y"], strict=True)], of, at, in_order=order, closed=given.get("closed"))
    if name == "motion":
        length = amount_said(given["length"], "length") if "length" in given else None
        return PoseTask(values["x"], values["y"], values["angle"], of, at, length=length, in_order=order)
    return FunctionTask(at, values["value"], of)
