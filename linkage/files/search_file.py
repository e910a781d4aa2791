"""A search as a file: what is least or greatest, what may vary, and what must be kept.

machine = "three_point_hitch"
maximise = "least(capacity(lift, G))"
subject_to = ["most(abs(tilt)) <= 18 deg", "reachable", "least(transmission(K)) >= 35 deg"]

[vary]
OB = "270 to 330 mm"
M = "within 60 mm"
"""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, final

from ..errors import DefinitionError
from ..mechanism import Mechanism
from ..motion.regions import outside
from ..quantities import is_number
from ..study import Optimum
from ..study.optimise import METHODS as SEARCH_METHODS
from ..study.optimise import SOLVERS, optimise
from ..study.optimum import COARSEST
from ..study.pareto import Front
from ..study.regions import point_regions
from ..study.space import size_of_machine
from ..study.survey import Progress
from ..surroundings import Outline
from .criterion import condition_said, measure_said
from .names import shortened
from .study_file import (
    PICTURE_SUFFIXES,
    FindMachine,
    StudyHead,
    amount_said,
    case_said,
    count_said,
    outputs_said,
    over_said,
    tolerances_said,
    vary_said,
    word_said,
)

SEARCH_KEYS = (
    "minimise", "maximise", "vary", "subject_to", "regions", "case", "over", "robust", "sigmas", "method", "solver", "starts", "seed",
    "limit", "folder", "round", "outputs",
)  # fmt: skip
SEARCH_OUTPUTS: Mapping[str, tuple[str, ...]] = {
    "table": (".csv",),
    "designs": (".csv", ".jsonl"),
    "drawing": PICTURE_SUFFIXES,
    "curves": PICTURE_SUFFIXES,
    "machine": (".toml", ".json"),
}
ROUND_KEYS = {"to": "length", "angle": "angle"}
REGION_WORDS = (
    'corners [["0 mm", "0 mm"], ["90 mm", "0 mm"], ["90 mm", "60 mm"]], an outline "plate", "outside(wheel)", '
    '{ at = ["10 mm", "0 mm"], radius = "50 mm" }, { outside = ... }, or a list of these'
)
_NUMBER = re.compile(r"\s*[-+.\d]")
_OUTSIDE = re.compile(r"\s*outside\s*\(\s*(?P<outline>[^()]+?)\s*\)\s*\Z")


@final
@dataclass(frozen=True, eq=False)
class SearchFile:
    """A search that a file asks for: the machine, what `optimise` takes beside it, the steps of `round`, and the files of its results."""

    machine: Mechanism
    arguments: Mapping[str, Any]
    rounding: Mapping[str, float] | None
    outputs: Mapping[str, tuple[Path, ...]]

    def run(self, folder: str | os.PathLike[str] | None = None, progress: bool | Progress = False) -> Optimum | Front:
        """Return the best design, of several objectives the front; `folder` stands above the file's own."""
        own = self.arguments.get("folder")
        found: Optimum | Front = optimise(self.machine, **{**self.arguments, "folder": folder or own}, progress=progress)
        return found


def read_search(
    path: str | os.PathLike[str], find: FindMachine, settings: Callable[[type[Mechanism]], Mapping[str, Any]] = lambda machine: {}
) -> SearchFile:
    """Return the search that a TOML or JSON file asks for; FileError with every mistake, its line and its key.

    `find` returns a class by the machine's text; `settings` are dimensions that stand above those of the file.
    """
    head = StudyHead.of(path, SEARCH_KEYS, find, settings)
    data, faults = head.data, head.faults
    arguments: dict[str, Any] = {}
    over = over_said(head, data["over"]) if "over" in data else None
    if over is not None:
        arguments["over"] = over
    objectives = objectives_listed(head, over)
    arguments |= objectives
    several = sum(len(each) for each in objectives.values()) > 1
    arguments["subject_to"] = conditions_listed(head, data.get("subject_to", []), over)
    arguments["vary"] = vary_said(head, data.get("vary", {}))
    arguments["regions"] = regions_said(head, data.get("regions", {}))
    readers: Mapping[str, Callable[[Any], Any]] = {
        "case": lambda given: case_said(head, given),
        "method": word_said(SEARCH_METHODS),
        "solver": word_said(SOLVERS),
        "sigmas": lambda given: amount_said(given, ""),
        "robust": lambda given: tolerances_said(head, given, "robust"),
        "starts": lambda given: count_said(given, 1),
        "seed": lambda given: count_said(given, 0),
        "limit": lambda given: count_said(given, 1),
        "folder": head.path_of,
    }
    for key, read in readers.items():
        if key in data:
            with faults.at(key):
                arguments[key] = read(data[key])
    rounding = rounding_said(head, data.get("round"))
    outputs = outputs_said(head, SEARCH_OUTPUTS)
    for name in outputs:
        if several and name != "designs":
            faults.add(("outputs", name), "of several objectives there is no single best design; write its front by designs = ...")
    if several and "folder" in arguments:
        faults.add(("folder",), "the search of several objectives is not kept in a folder; leave it out.")
    faults.check()
    return SearchFile(head.machine, arguments, rounding, outputs)


def objectives_listed(head: StudyHead, over: Mapping[str, object] | None) -> dict[str, list[Any]]:
    """Return what is to be least and what greatest; mistakes are noted."""
    found: dict[str, list[Any]] = {}
    for key in ("minimise", "maximise"):
        given = head.data.get(key, [])
        for number, text in enumerate(given if isinstance(given, list) else [given], 1):
            with head.faults.at(key, *([str(number)] if isinstance(given, list) else [])):
                found.setdefault(key, []).append(measure_said(text, head.machine, over))
    if not any(head.data.get(key) for key in ("minimise", "maximise")):
        head.faults.add((), 'say minimise or maximise, one measure such as maximise = "least(...)", or a list of several.')
    return found


def conditions_listed(head: StudyHead, given: object, over: Mapping[str, object] | None, *key: str) -> list[Any]:
    """Return the conditions of a list of texts; mistakes are noted behind a key, each with its number."""
    found: list[Any] = []
    if isinstance(given, str):
        given = [given]
    if not isinstance(given, list):
        head.faults.add((*key, "subject_to"), f'{shortened(given)}: a list of conditions is expected, such as ["most(tilt) <= 8 deg"].')
        return found
    for number, text in enumerate(given, 1):
        with head.faults.at(*key, "subject_to", str(number)):
            found.append(condition_said(text, head.machine, over))
    return found


def regions_said(head: StudyHead, given: object, *key: str) -> dict[str, Any]:
    """Return the regions of points as `optimise` takes them; mistakes are noted behind a key, each under its point."""
    found: dict[str, Any] = {}
    with head.faults.at(*key, "regions"):
        if not isinstance(given, Mapping):
            raise DefinitionError(f'{shortened(given)}: a region for each point is expected, such as regions = {{ C = "plate" }}.')
        for point, shapes in given.items():
            with head.faults.at(*key, "regions", point):
                region = shape_said(shapes)
                point_regions(head.machine, {point: region}, {}, ())
                found[point] = region
    return found


def shape_said(given: object) -> Any:
    """Return a shape, or the shapes of a list: corners, an outline's name, a circle, `outside(...)` of an outline, or outside of any."""
    if isinstance(given, str):
        forbidden = _OUTSIDE.match(given)
        return given if forbidden is None else outside(forbidden.group("outline"))
    if isinstance(given, Mapping) and set(given) == {"outside"}:
        return outside(shape_said(given["outside"]))
    if isinstance(given, Mapping) and set(given) == {"at", "radius"} and is_corner(given["at"]):
        x, y = (amount_said(each, "length") for each in given["at"])
        return Outline.circle((x, y), amount_said(given["radius"], "length"))
    if isinstance(given, list) and given and all(map(is_corner, given)):
        return [tuple(amount_said(each, "length") for each in corner) for corner in given]
    if isinstance(given, list) and given:
        return [shape_said(each) for each in given]
    raise DefinitionError(f"{shortened(given)} is no region; write {REGION_WORDS}.")


def is_corner(given: object) -> bool:
    """Return whether this is a pair of coordinates, as numbers or with their units."""
    return isinstance(given, list) and len(given) == 2 and all(is_number(each) or _NUMBER.match(str(each)) for each in given)


def rounding_said(head: StudyHead, given: object, *key: str) -> dict[str, float] | None:
    """Return the steps that a design is rounded to; None where the file says none. Mistakes are noted behind a key."""
    found: dict[str, float] = {}
    with head.faults.at(*key, "round"):
        table = given if isinstance(given, Mapping) else {} if given is None else {"to": given}
        for step, value in table.items():
            if step not in ROUND_KEYS:
                raise DefinitionError(f'{step} is no step; write round = {{ to = "1 mm", angle = "0.1 deg" }}.')
            found[step] = amount_said(value, ROUND_KEYS[step])
            if found[step] <= 0.0:
                raise DefinitionError(f"{shortened(value)}: a step above zero is expected.")
            if step == "to" and found[step] > COARSEST * size_of_machine(head.machine):
                raise DefinitionError(f'{shortened(value)} is as coarse as the machine; write it with its unit, "1 mm".')
    return None if given is None else found
