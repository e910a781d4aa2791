"""`hydrolinkage export NAME -o FILE`: a machine as a workbook, a table or a drawing for another program."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from pathlib import Path
from typing import final

import numpy as np

from .. import plugins
from ..disk import check_place
from .command import Command, default_name, machine_arguments, repeatable, whole_number
from .settings import machine_of, strokes_given, tell_gaps

OWN_FORMATS = ("xlsx", "csv", "dxf", "svg")


@final
class ExportCommand(Command):
    """Writes a file for another program."""

    name = "export"
    help = "a workbook with live formulas (.xlsx), a table (.csv), or a true-size drawing (.dxf, .svg)"

    def add(self, parser: ArgumentParser) -> None:
        machine_arguments(parser)
        parser.add_argument("-o", "--output", metavar="FILE", help=f"{', '.join(f'.{name}' for name in OWN_FORMATS)} (default: NAME.xlsx)")
        formats = ", ".join([*OWN_FORMATS, *plugins.entry_points(plugins.EXPORTERS)])
        parser.add_argument("--format", metavar="NAME", help=f"{formats}: one of them, whatever the file's name ends in")
        parser.add_argument("--count", metavar="N", type=whole_number, default=101, help="poses over the stroke (default 101)")
        what = (
            "hold a stroke at a value; in a workbook the one with two values runs between them: S=0.1,650mm; in a drawing each value "
            "is a pose on layers of its own; repeatable"
        )
        repeatable(parser, "--at", "S=0.6", what, "strokes")
        parser.add_argument("--poses", metavar="N", type=whole_number, help="a drawing of so many poses over the first stroke")
        repeatable(parser, "--path", "G", "draw this point's path; repeatable")

    def run(self, options: Namespace) -> int:
        machine = machine_of(options)
        from ..exports import ExportJob, export, exporter_of

        exporter = exporter_of(Path(options.output or "x.xlsx"), options.format)
        path = Path(default_name(options, machine) + exporter.suffix if options.output is None else options.output)
        check_place(path)
        at = strokes_given(machine, options)
        if options.poses is not None:
            first = next((name for name in machine.strokes if name not in at), None)
            if first is not None:
                at[first] = np.linspace(machine.strokes[first].start, machine.strokes[first].end, options.poses)
        tell_gaps(exporter.poses(ExportJob(machine, path.name, at, options.count, options.path, ())))
        print(export(machine, path, format=options.format, at=at, count=options.count, trace=options.path))
        return 0
