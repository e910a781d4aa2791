"""`hydrolinkage study FILE`: the studies that a file asks for, and their results as text, tables and pictures."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from pathlib import Path
from typing import Any, final

from ..files.study_tasks import TaskResult, read_study
from ..mechanism import Mechanism
from ..study import Tornado, Zone
from .command import Command
from .optimise import NOT_FEASIBLE, finder, settings_of, study_arguments, study_progress
from .table import write_columns


@final
class StudyCommand(Command):
    """Runs the studies of a file."""

    name = "study"
    help = "a survey, a zone, tolerances, a tornado or settings that a file asks for"

    def add(self, parser: ArgumentParser) -> None:
        study_arguments(parser)

    def run(self, options: Namespace) -> int:
        study = read_study(options.file, finder(options.trust), settings_of(options.settings))
        folder = Path(options.folder) if options.folder else None
        solved = True
        for section in study.tasks:
            with study_progress(section, asked=options.progress) as progress:
                found = study.run(section, folder, progress)
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
