"""`hydrolinkage study FILE`: the studies that a file asks for, and their results as text, tables and pictures."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from pathlib import Path
from typing import final

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
                write_task(study.machine, found, path)
                print(path)
            solved &= found.solved
        return 0 if solved else NOT_FEASIBLE


def write_task(machine: Mechanism, found: TaskResult, path: Path) -> None:
    """Write a study's result into a file: a table, JSON lines in SI, or a picture of its bands."""
    if path.suffix.lower() in (".csv", ".jsonl"):
        write_columns(found.columns, path, found.labels)
    else:
        from ..pictures import plot_bands, plot_tornado, plot_zone

        if isinstance(found.found, Zone):
            plot_zone(machine, found.found, found.unit).savefig(path)
        else:
            (plot_tornado if isinstance(found.found, Tornado) else plot_bands)(found.found).savefig(path)
