"""`hydrolinkage animate NAME -o FILE`: a machine over its stroke, with the live curve of a result."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace

from .command import Command, counted, machine_arguments, path_argument
from .machines import find
from .output import picture
from .progress import progress_bar
from .settings import design, run_of_first, traced

SUFFIXES = (".gif", ".mp4", ".html")


class Animate(Command):
    """Writes an animation into a file."""

    name = "animate"
    help = "an animation of the stroke with a live curve, as .gif, .mp4 or an .html page"

    def add(self, parser: ArgumentParser) -> None:
        machine_arguments(parser)
        parser.add_argument("-o", "--output", metavar="FILE", required=True, help=f"{', '.join(SUFFIXES)}")
        parser.add_argument("--column", metavar="I", help="the column of `table` whose curve runs along (default: the last)")
        path_argument(parser)
        parser.add_argument("--count", metavar="N", type=counted, default=60, help="poses over the stroke (default 60)")

    def run(self, options: Namespace) -> int:
        found = find(options.machine)
        path = picture(options.output, found, options.machine, SUFFIXES)
        machine = design(found, options.settings)
        run_of_first(machine, options.count)
        from ..animate import animate

        with progress_bar(f"drawing {path.name}") as progress:
            animate(machine, path, count=options.count, column=options.column, trace=traced(machine, options.path), progress=progress)
        print(path)
        return 0
