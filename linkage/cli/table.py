"""`hydrolinkage table NAME`: a machine's results over the stroke, as text or CSV."""

from __future__ import annotations

import csv
import io
import json
import re
import sys
from argparse import ArgumentParser, Namespace
from collections.abc import Sequence
from contextlib import nullcontext
from pathlib import Path
from shutil import get_terminal_size
from typing import final

import numpy as np

from ..disk import replacing_text
from ..errors import DefinitionError, cited, ensure
from ..loads import Acting
from ..mechanism import Mechanism
from ..motion import Column, Motion, Over
from ..reports import is_loaded, rich_tables, text_table, write_csv
from ..statics import PinForces, max_table, pin_forces, table_text
from . import settings
from .command import Command, every_argument, machine_arguments, motion_arguments, progress_bar, repeatable

COLUMNS = "only these columns (default: all), or what is asked for in words: 'pressure(lift)', 'ratio(G.y)'"
RICH_ROWS = 500  # a longer table is printed plain, which takes no time


@final
class TableCommand(Command):
    """Prints or writes the table of results."""

    name = "table"
    help = "a machine's results over the stroke, as text or CSV"

    def add(self, parser: ArgumentParser) -> None:
        machine_arguments(parser)
        parser.add_argument("columns", metavar="COLUMN", nargs="*", default=[], help=COLUMNS)
        repeatable(parser, "--columns", "I,kz", "the same, separated by commas", "listed")
        csv_argument(parser)
        motion_arguments(parser, 11)
        every_argument(parser)
        repeatable(parser, "--ratio", "G", "the derivatives of a point or an output; repeatable")
        parser.add_argument("--wrt", metavar="S", help="the stroke of these derivatives (default: each)")
        settings.force_arguments(parser)
        settings.over_argument(parser)
        parser.add_argument("--pins", action="store_true", help="the largest force of every pin too, its load case, direction and pose")
        parser.add_argument("--limits", action="store_true", help="how far each stroke goes too, dead points, transmission angles")
        settings.check_argument(parser)

    def run(self, options: Namespace) -> int:
        if options.csv == "-" and (options.pins or options.limits):
            raise DefinitionError("--pins and --limits do not go into CSV; leave them out, or write it into a file, --csv table.csv.")
        machine = settings.machine_of(options)
        acting, poses = settings.acting_of(machine, options), settings.motion_at(machine, options)
        over, strokes, names = settings.judged_over(machine, options), list(poses.strokes), list(options.columns)
        for text in options.listed:  # a comma between parentheses belongs to its name, `reserve(lift, share=0.9)`
            listed = [name.strip() for name in re.split(r",(?![^()]*\))", text) if name.strip()]
            ensure(listed, f"--columns {cited(text)}: name at least one column, such as --columns thrust,pressure.")
            names += listed
        if options.ratio and not names:
            names = strokes  # ratios alone stand beside their strokes
        columns = settings.columns_picked(machine, poses, names, strokes, settings.plain_value(acting))
        columns += settings.ratio_columns(machine, poses, options.ratio, options.wrt)
        pins = worst_pins(machine, over, acting) if options.pins else ""
        write_table(columns, poses.reached.size, options.csv)
        if pins:
            print(f"\n{pins}")
        if options.limits:
            print(f"\n{poses.limits()}")
        return settings.print_verdicts(machine.verdicts(over=over), options) if options.check else 0


def worst_pins(machine: Mechanism, over: Sequence[Over | Motion] | None, acting: Acting) -> str:
    """Return the table of the largest force of every joint over what is given, else over all that the machine runs.

    In all load cases and directions that `acting` leaves open; DefinitionError where nothing acts.
    """
    judge = machine.judge(over, acting)
    if not is_loaded(judge.motion):
        raise DefinitionError(f"{machine.plan.title} declares no load, so that no pin carries anything; declare one, Weight(G, mass=100).")
    return table_text(max_table(machine, over, acting))


def pins_of(motion: Motion, acting: Acting) -> PinForces:
    """Return the joint forces of a motion in a load case and a direction."""
    return pin_forces(motion, case=acting.case, direction=acting.movement, drive=acting.drive)


def csv_argument(parser: ArgumentParser) -> None:
    """Declare the argument that has a table written as CSV."""
    parser.add_argument("--csv", metavar="FILE", help="write the table as CSV in full precision instead; - for stdout")


def write_table(columns: Sequence[Column], rows: int, file: str | None) -> None:
    """Print a table, or write it as CSV where a file is named, "-" being stdout."""
    if file is None:
        print_table(columns, rows)
        return
    if isinstance(sys.stdout, io.TextIOWrapper) and file == "-":
        sys.stdout.reconfigure(newline="")  # CR LF stays CR LF where the system would turn LF into that itself
    with nullcontext(sys.stdout) if file == "-" else replacing_text(file) as stream, progress_bar("writing CSV") as progress:
        write_csv(columns, stream, progress)
    if file != "-":
        print(f"{file}: {rows} rows")


def print_table(columns: Sequence[Column], rows: int) -> None:
    """Print a table: in blocks as wide as a terminal there, else whole and plain."""
    width = get_terminal_size().columns if sys.stdout.isatty() else None
    if width is None or rows > RICH_ROWS:
        print(*text_table(columns, width), sep="\n")
        return
    from rich.console import Console

    console = Console(width=width)
    for table in rich_tables(columns, width):
        console.print(table)


def write_columns(columns: Sequence[Column], path: Path, labels: Sequence[str] = ()) -> None:
    """Write columns into a file: CSV in full precision with units, or JSON lines in SI; an empty field, or null, where there is no value.

    `labels` are the first field of each row, its name.
    """
    is_json = path.suffix.lower() == ".jsonl"
    names = ["name"][: len(labels)] + [column.name if is_json else column.heading for column in columns]
    values = [(np.asarray(column.values, float) if is_json else column.shown).tolist() for column in columns]
    with replacing_text(path) as stream:
        rows = csv.writer(stream)
        if not is_json:
            rows.writerow(names)
        for number, row in enumerate(zip(*values, strict=True)):
            label = labels[number : number + 1]
            if is_json:
                known = (value if np.isfinite(value) else None for value in row)
                stream.write(json.dumps(dict(zip(names, [*label, *known], strict=True))) + "\n")
            else:
                rows.writerow([*label, *("" if value != value else repr(value) for value in row)])
