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
from functools import partial
from pathlib import Path
from typing import Any, final

from ..errors import DefinitionError, ensure
from ..frozen import immutable
from ..motion.measures import Condition, Measure
from ..motion.regions import outside
from ..quantities import is_number
from ..study.optimise import METHODS as SEARCH_METHODS
from ..study.optimise import SOLVERS, optimise
from ..study.optimum import COARSEST
from ..study.space import point_regions, size_of_machine
from ..study.survey import Progress
from ..surroundings import Outline
from . import study_file
from .criterion import condition_said, measure_said
from .names import Keywords, entry_as, require_entry, shortened
from .source import each_of
from .study_file import FindMachine, Read, Settings, StudyHead, amount_said

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


@final
@immutable
class SearchFile:
    """A search that a file asks for: its function, the machine or several, the keywords, the steps of `round`, and the files of results."""

    search: Callable[..., Any]
    machine: Any
    arguments: Keywords
    rounding: Mapping[str, float] | None
    outputs: Mapping[str, tuple[Path, ...]]

    def run(self, folder: str | os.PathLike[str] | None = None, progress: bool | Progress = False) -> Any:
        """Return what the search finds; `folder` stands above the file's own."""
        return self.search(self.machine, **{**self.arguments, "folder": folder or self.arguments.get("folder")}, progress=progress)


def read_search(path: str | os.PathLike[str], find: FindMachine, settings: Settings = lambda machine: {}) -> SearchFile:
    """Return the search that a TOML or JSON file asks for; FileError with every mistake, its line and its key.

    `find` returns a class by the machine's text; `settings` are dimensions that stand above those of the file.
    """
    head = StudyHead.of(path, (*SEARCH, "outputs"), find, settings)
    data, faults = head.data, head.faults
    arguments: Keywords = {}
    with faults.at():
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
    """Return what a text says is to be least or greatest."""
    return measure_said(given, head.machine, head.found["over"])


def objectives_said(head: StudyHead, given: object) -> list[Measure]:
    """Return what is to be least or greatest: the measure of a text, or those of a list, mistakes under their numbers."""
    return study_file.texts_said(given, partial(objective_said, head)) if isinstance(given, list) else [objective_said(head, given)]


def conditions_said(head: StudyHead, given: object) -> list[Condition]:
    """Return the conditions of a list of texts; SeveralError with all mistakes, each under its number."""
    given = entry_as(given, (str, list), 'a list of conditions is expected, such as ["most(tilt) <= 8 deg"]')
    return study_file.texts_said(given, lambda text: condition_said(text, head.machine, head.found["over"]))


def regions_said(head: StudyHead, given: object) -> Keywords:
    """Return the regions of points as `optimise` takes them; SeveralError with all mistakes, each under its point."""
    given = entry_as(given, Mapping, 'a region for each point is expected, such as regions = { C = "plate" }')

    def region_said(point: str, shapes: object) -> tuple[str, Any]:
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
    raise DefinitionError(f"{shortened(given)} is no region; write {REGION_WORDS}.")


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
        require_entry(found[step] > 0.0, value, "a step above zero is expected")
        if step == "to" and found[step] > COARSEST * size_of_machine(head.machine):
            raise DefinitionError(f'{shortened(value)} is as coarse as the machine; write it with its unit, "1 mm".')
    return found


SEARCH: Mapping[str, Read] = {
    "over": study_file.over_said,
    "minimise": objectives_said,
    "maximise": objectives_said,
    "vary": study_file.vary_said,
    "subject_to": conditions_said,
    "regions": regions_said,
    "case": study_file.case_said,
    "robust": study_file.tolerances_said("robust"),
    "sigmas": lambda head, given: amount_said(given, ""),
    "method": study_file.one_of(SEARCH_METHODS),
    "solver": study_file.one_of(SOLVERS),
    "starts": study_file.count_from(1),
    "seed": study_file.count_from(0),
    "limit": study_file.count_from(1),
    "folder": study_file.file_path,
    "round": rounding_said,
}
"""The keywords of `optimise` that a file may say, and the steps of `round`, each with what reads it."""
