"""`hydrolinkage report NAME -o FILE`: the report of a machine's calculation, as HTML, PDF or Markdown."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from pathlib import Path
from typing import final

from ..disk import check_place
from ..errors import ensure
from .command import Command, machine_arguments, motion_arguments, path_argument, repeatable, whole_number
from .settings import machine_of, over_argument, overs_of, pair, strokes_given

KINDS = (".html", ".pdf", ".md")
TITLE = {
    "number": "R-104", "revision": "A", "date": "2026-05-01", "client": "NAME", "prepared": "NAME", "checked": "NAME", "approved": "NAME",
}  # fmt: skip
"""The fields of the title block, each with an example."""


@final
class ReportCommand(Command):
    """Writes a report."""

    name = "report"
    help = "a machine's calculation report: inputs, drawings, equations with numbers, forces, checks, verdicts"

    def add(self, parser: ArgumentParser) -> None:
        machine_arguments(parser)
        parser.add_argument("columns", metavar="COLUMN", nargs="*", default=[], help="only these results (default: all)")
        parser.add_argument("-o", "--output", metavar="FILE", help=f"{', '.join(KINDS)} (default: the machine's name with .html)")
        motion_arguments(parser, 11)
        path_argument(parser)
        over_argument(parser)
        parser.add_argument("--case", metavar="CASE", help="this load case alone, plain: the machine's own loads (default: all)")
        parser.add_argument("--start", metavar="N", type=whole_number, default=1, help="the first equation's number (default 1)")
        block = parser.add_argument_group("title block", "what is left out is an empty line to write on")
        for name, example in TITLE.items():
            block.add_argument(f"--{name}", metavar=example, default="")
        repeatable(block, "--row", "NAME=TEXT", "a row below the title block; repeatable", "rows")

    def run(self, options: Namespace) -> int:
        from ..documents import report

        machine = machine_of(options)
        path = Path(options.output or f"{type(machine).__name__}.html")
        ensure(path.suffix.lower() in KINDS, f"-o {path}: a report's name ends in one of {', '.join(KINDS)}, which chooses the format.")
        check_place(path)
        at = strokes_given(machine, options)
        rows = dict(pair(text, "--row", '"Order=4711"') for text in options.rows)
        print(report(
            machine, path, case=options.case, over=overs_of(machine, options.over), at=at, count=options.count,
            columns=options.columns or None, trace=options.path, title_block=rows, start=options.start,
            **{name: getattr(options, name) for name in TITLE},
        ))  # fmt: skip
        return 0
