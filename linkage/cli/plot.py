"""`hydrolinkage plot NAME`: a machine at its end positions, or curves of its results."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from typing import Any

from ..mechanism import Mechanism
from .command import Command, machine_arguments, motion_arguments, path_argument
from .machines import find
from .output import picture
from .settings import chosen, design, motion, picked, run_of_first, traced

SUFFIXES = (".png", ".svg", ".pdf")


class Plot(Command):
    """Draws a picture into a file."""

    name = "plot"
    help = "a picture: the machine at its end positions, or curves of the columns named"

    def add(self, parser: ArgumentParser) -> None:
        machine_arguments(parser)
        parser.add_argument("columns", metavar="COLUMN", nargs="*", default=[], help="curves of these columns of `table` instead")
        parser.add_argument("-o", "--output", metavar="FILE", help=f"{', '.join(SUFFIXES)} (default: NAME.png)")
        path_argument(parser)
        motion_arguments(parser, 101)

    def run(self, options: Namespace) -> int:
        found = find(options.machine)
        path = picture(options.output, found, options.machine, SUFFIXES)
        machine = design(found, options.settings)
        figure = curves(machine, options) if options.columns else poses(machine, options)
        figure.savefig(path)
        print(path)
        return 0


def curves(machine: Mechanism, options: Namespace) -> Any:
    """Return the figure of the columns named."""
    over = motion(machine, options.strokes, options.count)
    columns = picked(machine.columns(over), options.columns, [], machine.plan.title)
    from ..draw import curves as drawn

    return drawn(over, columns)


def poses(machine: Mechanism, options: Namespace) -> Any:
    """Return the figure of the machine at the strokes chosen, else at its ends."""
    at = dict(chosen(machine.plan, text) for text in options.strokes)
    if at:
        machine.at(**{name: 0.5 * (stroke.start + stroke.end) for name, stroke in machine.strokes.items()} | at)
    else:
        run_of_first(machine, options.count)
    from ..draw import poses as drawn

    return drawn(machine, at or None, traced(machine, options.path), options.count)
