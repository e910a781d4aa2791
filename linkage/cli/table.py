"""`hydrolinkage table NAME`: a machine's results over the stroke, as text or CSV."""

from __future__ import annotations

import io
import sys
from argparse import ArgumentParser, Namespace
from collections.abc import Sequence
from shutil import get_terminal_size
from typing import TextIO, final

from ..disk import replacing_text
from ..motion import Column
from ..reports import rich_tables, text_table, write_csv
from .command import Command, machine_arguments, motion_arguments, progress_bar
from .machines import find
from .settings import columns_picked, design, motion_at

RICH_ROWS = 500  # a longer table is printed plain, which takes no time


@final
class TableCommand(Command):
    """Prints or writes the table of results."""

    name = "table"
    help = "a machine's results over the stroke, as text or CSV"

    def add(self, parser: ArgumentParser) -> None:
        machine_arguments(parser)
        parser.add_argument("columns", metavar="COLUMN", nargs="*", default=[], help="only these columns (default: all)")
        csv_argument(parser)
        motion_arguments(parser, 11)

    def run(self, options: Namespace) -> int:
        machine = design(find(options.machine), options.settings)
        poses = motion_at(machine, options.strokes, options.count)
        columns = columns_picked(machine, poses, options.columns, list(poses.strokes))
        write_table(columns, poses.reached.size, options.csv)
        return 0


def csv_argument(parser: ArgumentParser) -> None:
    """Declare the argument that has a table written as CSV."""
    parser.add_argument("--csv", metavar="FILE", help="write the table as CSV in full precision instead; - for stdout")


def write_table(columns: Sequence[Column], rows: int, csv: str | None) -> None:
    """Print a table, or write it as CSV where a file is named, "-" being stdout."""
    if csv is None:
        print_table(columns, rows)
    elif csv == "-":
        keep_line_ends(sys.stdout)
        write_with_progress(columns, sys.stdout)
    else:
        with replacing_text(csv) as stream:
            write_with_progress(columns, stream)
        print(f"{csv}: {rows} rows")


def write_with_progress(columns: Sequence[Column], stream: TextIO) -> None:
    """Write CSV, with a progress bar."""
    with progress_bar("writing CSV") as progress:
        write_csv(columns, stream, progress)


def keep_line_ends(stream: TextIO) -> None:
    """Let CR LF be CR LF where the system would turn LF into that itself."""
    if isinstance(stream, io.TextIOWrapper):
        stream.reconfigure(newline="")


def print_table(columns: Sequence[Column], rows: int) -> None:
    """Print a table: in blocks as wide as a terminal there, else whole and plain."""
    width = get_terminal_size().columns if sys.stdout.isatty() else None
    if width is None or rows > RICH_ROWS:
        for line in text_table(columns, width):
            print(line)
        return
    from rich.console import Console

    console = Console(width=width)
    for table in rich_tables(columns, width):
        console.print(table)
