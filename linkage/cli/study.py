"""`hydrolinkage study FILE`: the studies that a file asks for, and their results as text, tables and pictures."""

from __future__ import annotations

import csv
import json
from argparse import ArgumentParser, Namespace
from pathlib import Path
from typing import final

import numpy as np

from ..disk import replacing_text
from ..files.study_tasks import TaskResult, read_study
from ..mechanism import Mechanism
from ..study import Tornado, Zone
from .command import Command
from .optimise import NOT_FEASIBLE, finder, settings_of, study_arguments, study_progress


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
    if path.suffix.lower() == ".csv":
        write_rows(found, path)
    elif path.suffix.lower() == ".jsonl":
        write_lines(found, path)
    else:
        from ..pictures import plot_bands, plot_tornado, plot_zone

        if isinstance(found.found, Zone):
            plot_zone(machine, found.found, found.unit).savefig(path)
        else:
            (plot_tornado if isinstance(found.found, Tornado) else plot_bands)(found.found).savefig(path)


def write_rows(found: TaskResult, path: Path) -> None:
    """Write a table as CSV, in full precision and with units; an empty field where there is no value."""
    with replacing_text(path) as stream:
        writer = csv.writer(stream)
        writer.writerow([*(["name"] if found.labels else []), *(column.heading for column in found.columns)])
        for number, row in enumerate(zip(*(column.shown.tolist() for column in found.columns), strict=True)):
            writer.writerow([*found.labels[number : number + 1], *("" if value != value else repr(value) for value in row)])


def write_lines(found: TaskResult, path: Path) -> None:
    """Write a table as JSON lines, in SI; null where there is no value."""
    names = [column.name for column in found.columns]
    with replacing_text(path) as stream:
        for number, row in enumerate(zip(*(np.asarray(column.values, float).tolist() for column in found.columns), strict=True)):
            label = {"name": found.labels[number]} if found.labels else {}
            values = (value if np.isfinite(value) else None for value in row)
            stream.write(json.dumps({**label, **dict(zip(names, values, strict=True))}) + "\n")
