"""`hydrolinkage page NAME -o FILE`: a machine as a live page, one file that works offline."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from typing import final

from ..errors import ensure
from ..plan import plan_measure
from .command import Command, machine_arguments, picture, repeatable, run_arguments
from .settings import machine_of, motion_along, over_argument, overs_of, si_value, strokes_given, with_overs


@final
class PageCommand(Command):
    """Writes a live page into a file."""

    name = "page"
    help = "a live page, .html: the machine moved and its dimensions changed in a browser, offline"

    def add(self, parser: ArgumentParser) -> None:
        machine_arguments(parser)
        parser.add_argument("-o", "--output", metavar="FILE", help="the page, .html (default: NAME.html)")
        what = "a dimension with a slider, and its range if it is given; a point has two; repeatable (default: the first lengths)"
        repeatable(parser, "--vary", "OB=280mm,340mm", what)
        parser.add_argument("--column", metavar="I", help="the column of `table` that is shown first")
        parser.add_argument("--path", metavar="G", action="append", help="draw this point's path; repeatable")
        over_argument(parser)
        run_arguments(parser, 101, "poses of the curve")

    def run(self, options: Namespace) -> int:
        machine = machine_of(options)
        path = picture(options, machine, (".html",))
        machine = with_overs(machine, overs_of(machine, options.over))
        at = strokes_given(machine, options)
        motion_along(machine, options.count, at)
        vary: dict[str, tuple[float, float] | None] = {}
        for text in options.vary:  # `OB`, or `OB=280mm,340mm`
            name, equals, ends = (part.strip() for part in text.partition("="))
            owner = machine.plan.table.spellings.get(name, ("", 1))[0]
            measures = plan_measure(machine.plan, owner) if owner else ""
            values = [si_value(each, measures, f"--vary {name}") for each in ends.split(",")] if equals else []
            fits = not equals or len(values) == 2
            ensure(fits, f"--vary {text}: the least and the greatest value are expected, --vary {name or 'OB'}=280mm,340mm.")
            vary[name] = (values[0], values[1]) if equals else None
        from ..pictures import page

        page(
            machine, path, vary=vary or None, column=options.column, trace=options.path, at=at, count=options.count,
            language=options.language,
        )  # fmt: skip
        print(path)
        return 0
