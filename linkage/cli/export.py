"""`hydrolinkage export NAME -o FILE`: a machine as a workbook, a table or a drawing for another program."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from typing import Any, final

import numpy as np

from .command import Command, machine_arguments, picture, pose_count
from .machines import find
from .settings import design, stroke_values, tell_gaps

ENDINGS_OF_FILES = (".xlsx", ".csv", ".dxf", ".svg")


@final
class ExportCommand(Command):
    """Writes a file for another program."""

    name = "export"
    help = "a workbook with live formulas (.xlsx), a table (.csv), or a true-size drawing (.dxf, .svg)"

    def add(self, parser: ArgumentParser) -> None:
        machine_arguments(parser)
        parser.add_argument("-o", "--output", metavar="FILE", help=f"{', '.join(ENDINGS_OF_FILES)} (default: NAME.xlsx)")
        parser.add_argument("--count", metavar="N", type=pose_count, default=101, help="poses over the stroke (default 101)")
        parser.add_argument(
            "--at", dest="strokes", metavar="S=0.6", action="append", default=[],
            help="hold a stroke at a value; in a workbook the one with two values runs between them: S=0.1,650mm; in a drawing each value "
            "is a pose on layers of its own; repeatable",
        )  # fmt: skip
        parser.add_argument("--poses", metavar="N", type=pose_count, help="a drawing of so many poses over the first stroke")
        parser.add_argument("--path", metavar="G", action="append", default=[], help="draw this point's path; repeatable")

    def run(self, options: Namespace) -> int:
        found = find(options.machine)
        path = picture(options.output, found, options.machine, ENDINGS_OF_FILES)
        machine = design(found, options.settings)
        at: dict[str, Any] = dict(stroke_values(machine.plan, text) for text in options.strokes)
        if options.poses is not None:
            first = next((name for name in machine.strokes if name not in at), None)
            if first is not None:
                at[first] = np.linspace(machine.strokes[first].start, machine.strokes[first].end, options.poses)
        from ..exports import export, exported_motion

        tell_gaps(exported_motion(machine, path, at, options.count))
        print(export(machine, path, at=at, count=options.count, trace=options.path))
        return 0
