"""`hydrolinkage synthesise FILE`: the machines that do the task of a file, as text, a table, pictures and a live page."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from collections.abc import Callable
from pathlib import Path
from typing import final

from ..disk import check_place, in_words
from ..errors import ensure
from ..files import save
from ..files.synthesis_file import read_synthesis
from ..units import deg, mm
from .command import Command, whole_number
from .optimise import NOT_FEASIBLE, finder, settings_of, study_arguments, study_progress, write_results

ANSWERS = 3
"""The answers of a picture."""
STEP, TURN = 1.0 * mm, 0.1 * deg
"""The steps of a drawing where the file says one of them."""


@final
class SynthesiseCommand(Command):
    """Searches machines for a path, a function or poses."""

    name = "synthesise"
    help = "the machines whose point goes along a path, whose output follows a function, or whose body takes poses"

    def add(self, parser: ArgumentParser) -> None:
        study_arguments(parser)
        parser.add_argument("--csv", metavar="FILE", help="write a row for each machine found")
        parser.add_argument("--pictures", metavar="FOLDER", help="write a picture of the best machines beside the task there")
        parser.add_argument("--page", metavar="FILE.html", help="write the live page of the best machine")
        parser.add_argument("--answers", metavar="N", type=whole_number, default=ANSWERS, help=f"machines drawn (default {ANSWERS})")

    def run(self, options: Namespace) -> int:
        asked = read_synthesis(options.file, finder(options.trust), settings_of(options.settings))
        outputs = {name: [*paths] for name, paths in asked.outputs.items()}
        for name, path in outputs_asked(options).items():
            outputs.setdefault(name, []).append(path)
        with study_progress(f"searching {Path(options.file).stem}", asked=options.progress) as progress:
            found = asked.run(options.folder, progress)
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
    """Return the files that the arguments ask for, by what they hold, checked before the work is done."""
    found: dict[str, Path] = {}
    if options.csv is not None:
        found["table"] = Path(options.csv)
    if options.page is not None:
        found["page"] = Path(options.page)
        ensure(found["page"].suffix.lower() == ".html", f"--page {options.page}: the file's name ends in .html.")
    if options.pictures is not None:
        folder = Path(options.pictures)
        with in_words(folder):
            folder.mkdir(parents=True, exist_ok=True)
        found["drawing"] = folder / f"{Path(options.file).stem}.png"
    for path in found.values():
        check_place(path)
    return found
