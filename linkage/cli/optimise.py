"""`hydrolinkage optimise FILE`: the search that a study file asks for, and its results as text, tables and pictures."""

from __future__ import annotations

import sys
from argparse import ArgumentParser, Namespace
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import final

import numpy as np

from ..errors import DefinitionError, StudyError, unknown
from ..files import save
from ..files.read import load
from ..files.search_file import SearchFile, read_search
from ..files.study_file import FindMachine, Settings
from ..mechanism import Mechanism
from ..motion import Column
from ..study import Front
from ..study.checks import unit_of
from ..study.result_tables import tried_names
from ..study.space import Space
from ..study.survey import Progress as ProgressLike
from .command import Command, link_argument, progress_bar, repeatable
from .listing import OWN, registered
from .machines import find, machine, split
from .settings import parsed_setting
from .table import write_columns

NOT_FEASIBLE = 1
"""The exit code where the study came to its end and found no design."""


def study_arguments(parser: ArgumentParser) -> None:
    """Declare the arguments that every command on a study file has."""
    parser.add_argument("file", metavar="FILE", help="a study file, .toml or .json")
    repeatable(parser, "--set", "OB=180mm", "change a design variable, above the file's own `set`; repeatable", "settings")
    link_argument(parser)
    what = "a package, or a .py file, that the study file may name as its machine and that is run for it; repeatable"
    repeatable(parser, "--trust", "PACKAGE", what)
    parser.add_argument("--folder", metavar="DIR", help="keep what is done there, and go on from it (default: the file's own `folder`)")
    parser.add_argument("--progress", action="store_true", help="say how far it is where stderr is no terminal, too")


def finder(trust: list[str]) -> FindMachine:
    """Return what finds a study file's machine: an installed one, a file beside it, or a class of what is trusted."""

    def find_machine(text: str, base: Path) -> type[Mechanism]:
        place, name = split(text)
        if text in registered():
            return find(text)
        if text.endswith((".toml", ".json")):
            return machine(load(base / text, trust), text)
        is_file = place.endswith(".py")
        if not is_file and not name:
            raise DefinitionError(f"{unknown('Machine', text, registered())} {OWN}")
        if place not in trust and (is_file or not any(place.startswith(f"{each}.") for each in trust)):
            word = place if is_file else place.partition(".")[0]
            raise DefinitionError(f"{place} is code, and a file runs none unasked; say --trust {word} if you trust it.")
        return find(f"{base / text}" if is_file else text)

    return find_machine


def settings_of(texts: list[str]) -> Settings:
    """Return what reads settings such as `OB=180mm` for a machine."""
    return lambda found: dict(parsed_setting(found.plan, text) for text in texts)


@contextmanager
def study_progress(title: str, *, asked: bool) -> Iterator[ProgressLike | bool]:
    """Yield the function that reports how far a study is: a bar on a terminal, where it is asked for lines elsewhere."""
    with progress_bar(title) as bar:
        yield bar or (say_progress if asked else False)


def say_progress(done: int, total: int) -> None:
    """Say on stderr how far a study is."""
    print(f"{done} of {total}", file=sys.stderr, flush=True)


@final
class OptimiseCommand(Command):
    """Searches the best design."""

    name = "optimise"
    help = "the best dimensions: the search that a file asks for"

    def add(self, parser: ArgumentParser) -> None:
        study_arguments(parser)

    def run(self, options: Namespace) -> int:
        search = read_search(options.file, finder(options.trust), settings_of(options.settings))
        try:
            with study_progress(f"searching {Path(options.file).stem}", asked=options.progress) as progress:
                found = search.run(options.folder, progress)
        except StudyError as error:
            print(f"hydrolinkage: {' '.join(str(error).split())}", file=sys.stderr)
            return NOT_FEASIBLE
        print(found)
        if isinstance(found, Front):
            write_results(search.outputs, {"designs": partial(write_columns, front_columns(search, found))})
            return 0
        rounded = None if search.rounding is None else found.rounded(**search.rounding)
        if rounded is not None:
            print(f"Rounded: {rounded}")
        best = rounded.machine if rounded is not None and rounded.feasible else found.machine
        from ..pictures import draw, plot

        writers: dict[str, Callable[[Path], object]] = {
            "table": lambda path: found.csv(path, rounded),
            "designs": lambda path: found.designs_csv(path) if path.suffix.lower() == ".csv" else found.designs_jsonl(path),
            "drawing": lambda path: draw(found).savefig(path),
            "curves": lambda path: plot(found).savefig(path),
            "machine": lambda path: save(best, path),
        }
        write_results(search.outputs, writers)
        return 0


def write_results(outputs: Mapping[str, Sequence[Path]], writers: Mapping[str, Callable[[Path], object]]) -> None:
    """Write the files of a search, each by what it holds, and say their names."""
    for name, paths in outputs.items():
        for path in paths:
            writers[name](path)
            print(path)


def front_columns(search: SearchFile, found: Front) -> list[Column]:
    """Return the designs of a front: their objectives and what varied."""
    plan = search.machine.plan
    objectives = zip(map(str, found.objectives), found.units, zip(*(each.values for each in found.points), strict=True), strict=True)
    columns = [Column(name, np.array(values, float), unit) for name, unit, values in objectives]
    for name in tried_names(Space.of(search.machine, search.arguments["vary"])):
        owner, sign = plan.table.spellings[name]
        columns.append(Column(name, np.array([sign * float(each.machine.dimensions[owner]) for each in found.points]), unit_of(plan, name)))
    return columns
