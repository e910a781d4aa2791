"""`hydrolinkage animate NAME -o FILE`: a machine over its stroke, with the live curve of a result."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace

from .command import Command, counted, machine_arguments, path_argument
from .machines import find
from .output import picture
from .progress import progress_bar
from .settings import along, chosen, design, traced

SUFFIXES = (".gif", ".mp4", ".html")


class Animate(Command):
    """Writes an animation into a file."""

    name = "animate"
    help = "an animation of a stroke with a live curve, as .gif, .mp4 or an .html page"

    def add(self, parser: ArgumentParser) -> None:
        machine_arguments(parser)
        parser.add_argument("-o", "--output", metavar="FILE", required=True, help=f"{', '.join(SUFFIXES)}")
        parser.add_argument("--column", metavar="I", help="the column of `table` whose curve runs along (default: the last)")
        path_argument(parser)
        parser.add_argument("--count", metavar="N", type=counted, default=60, help="poses over the stroke (default 60)")
        parser.add_argument(
            "--at", dest="strokes", metavar="S=0.6", action="append", default=[],
            help="hold a stroke at a value, or run between two: S=0.1,650mm; without it the first runs, others stand in their middle",
        )  # fmt: skip

    def run(self, options: Namespace) -> int:
        found = find(options.machine)
        path = picture(options.output, found, options.machine, SUFFIXES)
        machine = design(found, options.settings)
        at, trace = dict(chosen(machine.plan, text) for text in options.strokes), traced(machine, options.path)
        along(machine, options.count, at)
        from ..animate import animate

        with progress_bar(f"drawing {path.name}") as progress:
            animate(machine, path, count=options.count, column=options.column, trace=trace, at=at, progress=progress)
        print(path)
        return 0
