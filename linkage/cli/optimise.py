"""`hydrolinkage optimise FILE`, `synthesise FILE`, `study FILE`: the results of a study file as text, tables, pictures, a live page."""

from __future__ import annotations

import sys
from argparse import Namespace
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from ..disk import check_place, new_folder
from ..errors import DefinitionError, StudyError, ensure, unknown
from ..files import load, save
from ..files.study_tasks import TaskResult, read_study
from ..files.synthesis_file import read_search, read_synthesis
from ..mechanism import Mechanism
from ..motion import Column
from ..study import Front, Tornado, Zone
from ..study.optimum import tried_names
from ..study.space import Space, unit_of
from ..units import deg, mm
from .command import LINK, Command, option, progress_bar, repeatable, whole_number
from .listing import OWN, registered
from .machines import find, machine, split
from .settings import parsed_settings
from .table import write_columns

NOT_FEASIBLE = 1
"""The exit code where the study came to its end and found no design."""
STUDY = (
    option("file", metavar="FILE", help="a study file, .toml or .json"),
    repeatable("--set", "OB=180mm", "change a design variable, above the file's own `set`; repeatable", "settings"),
    LINK,
    repeatable(
        "--trust", "PACKAGE", "a package, or a .py file, that the study file may name as its machine and that is run for it; repeatable"
    ),
    option("--folder", metavar="DIR", help="keep what is done there, and go on from it (default: the file's own `folder`)"),
    option("--progress", action="store_true", help="say how far it is where stderr is no terminal, too"),
)
"""What every command on a study file takes."""


def machine_of_study(trust: list[str], text: str, base: Path) -> type[Mechanism]:
    """Return a study file's machine: an installed one, a file beside it, or a class of a trusted file."""
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


@Command("optimise", "the best dimensions: the search that a file asks for", *STUDY)
def optimise_command(options: Namespace) -> int:
    """Search the best design."""
    search = read_search(options.file, partial(machine_of_study, options.trust), partial(parsed_settings, texts=options.settings))
    try:
        with progress_bar(f"searching {Path(options.file).stem}", in_lines=options.progress) as progress:
            found = search.run(options.folder, progress or False)
    except StudyError as error:
        print(f"hydrolinkage: {' '.join(str(error).split())}", file=sys.stderr)
        return NOT_FEASIBLE
    print(found)
    if isinstance(found, Front):
        plan = search.machine.plan
        objectives = zip(map(str, found.objectives), found.units, zip(*(each.values for each in found.points), strict=True), strict=True)
        columns = [Column(name, np.array(values, float), unit) for name, unit, values in objectives]
        for name in tried_names(Space.of(search.machine, search.arguments["vary"])):
            owner, sign = plan.table.spellings[name]
            values = np.array([sign * float(each.machine.dimensions[owner]) for each in found.points])
            columns.append(Column(name, values, unit_of(plan, name)))
        write_results(search.outputs, {"designs": partial(write_columns, columns)})
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
    """Write the files of a search, each by its contents, and print their names."""
    for name, paths in outputs.items():
        for path in paths:
            writers[name](path)
            print(path)


# A synthesis.

ANSWERS = 3
"""The answers of a picture."""
STEP, TURN = 1.0 * mm, 0.1 * deg
"""The steps of a drawing where the file says one of them."""


@Command(
    "synthesise",
    "the machines whose point goes along a path, whose output follows a function, or whose body takes poses",
    *STUDY,
    option("--csv", metavar="FILE", help="write a row for each machine found"),
    option("--pictures", metavar="FOLDER", help="write a picture of the best machines beside the task there"),
    option("--page", metavar="FILE.html", help="write the live page of the best machine"),
    option("--answers", metavar="N", type=whole_number, default=ANSWERS, help=f"machines drawn (default {ANSWERS})"),
)
def synthesise_command(options: Namespace) -> int:
    """Search machines for a path, a function or poses."""
    asked = read_synthesis(options.file, partial(machine_of_study, options.trust), partial(parsed_settings, texts=options.settings))
    outputs = {name: [*paths] for name, paths in asked.outputs.items()}
    for name, path in outputs_asked(options).items():
        outputs.setdefault(name, []).append(path)
    with progress_bar(f"searching {Path(options.file).stem}", in_lines=options.progress) as progress:
        found = asked.run(options.folder, progress or False)
    print(found)
    if not found.solutions:
        return NOT_FEASIBLE
    rounded = None if asked.rounding is None else found.rounded(asked.rounding.get("to", STEP), asked.rounding.get("angle", TURN))
    if rounded is not None:
        print(f"Rounded: {rounded}")
    best = found.machine if rounded is None else rounded.machine
    from ..pictures import draw, page

    writers: dict[str, Callable[[Path], object]] = {
        "table": found.csv,
        "drawing": lambda path: draw(found, answers=options.answers).savefig(path),
        "page": lambda path: page(found, path),
        "machine": lambda path: save(best, path),
    }
    write_results(outputs, writers)
    return 0


def outputs_asked(options: Namespace) -> dict[str, Path]:
    """Return the files that the arguments ask for, by their contents, checked before the work is done."""
    found: dict[str, Path] = {}
    if options.csv is not None:
        found["table"] = Path(options.csv)
    if options.page is not None:
        found["page"] = Path(options.page)
        ensure(found["page"].suffix.lower() == ".html", f"--page {options.page}: the file's name ends in .html.")
    if options.pictures is not None:
        found["drawing"] = new_folder(options.pictures) / f"{Path(options.file).stem}.png"
    for path in found.values():
        check_place(path)
    return found


# Surveys, zones, tolerances.


@Command("study", "a survey, a zone, tolerances, a tornado or settings that a file asks for", *STUDY)
def study_command(options: Namespace) -> int:
    """Run the studies of a file."""
    study = read_study(options.file, partial(machine_of_study, options.trust), partial(parsed_settings, texts=options.settings))
    folder = Path(options.folder) if options.folder else None
    solved = True
    for section in study.tasks:
        with progress_bar(section, in_lines=options.progress) as progress:
            found = study.run(section, folder, progress or False)
        print(found.text)
        for path in study.outputs.get(section, ()):
            if path.suffix.lower() in (".csv", ".jsonl"):
                write_columns(found.columns, path, found.labels)
            else:
                bands_of(study.machine, found).savefig(path)
            print(path)
        solved &= found.solved
    return 0 if solved else NOT_FEASIBLE


def bands_of(machine: Mechanism, found: TaskResult) -> Any:
    """Return the picture of a study's result."""
    from ..pictures import plot_bands, plot_tornado, plot_zone

    match found.found:
        case Zone():
            return plot_zone(machine, found.found, found.unit)
        case Tornado():
            return plot_tornado(found.found)
    return plot_bands(found.found)
