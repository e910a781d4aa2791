"""`hydrolinkage plot NAME`: a machine at its end positions, or curves of its results."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from typing import Any

from ..mechanism import Mechanism
from .command import Command, machine_arguments, motion_arguments, path_argument
from .machines import find
from .output import picture, picture_argument
from .settings import along, chosen, design, motion, picked, traced


class Plot(Command):
    """Draws a picture into a file."""

    name = "plot"
    help = "a picture: the machine at its end positions, or curves of the columns named"

    def add(self, parser: ArgumentParser) -> None:
        machine_arguments(parser)
        parser.add_argument("columns", metavar="COLUMN", nargs="*", default=[], help="curves of these columns of `table` over a stroke")
        picture_argument(parser, "default: NAME.png")
        path_argument(parser)
        motion_arguments(parser, 101)

    def run(self, options: Namespace) -> int:
        found = find(options.machine)
        path = picture(options.output, found, options.machine)
        machine = design(found, options.settings)
        figure = curves(machine, options) if options.columns else poses(machine, options)
        figure.savefig(path)
        print(path)
        return 0


def curves(machine: Mechanism, options: Namespace) -> Any:
    """Return the figure of the columns named, along one stroke."""
    given = dict(chosen(machine.plan, text) for text in options.strokes)
    many = [name for name, values in given.items() if len(values) > 1]
    over = motion(machine, options.strokes, options.count) if many else along(machine, options.count, given)
    columns = picked(machine, over, options.columns, [])
    from ..draw import curves as drawn

    return drawn(over, columns)


def poses(machine: Mechanism, options: Namespace) -> Any:
    """Return the figure of the machine at the strokes chosen, else at its ends."""
    at = dict(chosen(machine.plan, text) for text in options.strokes)
    if at:
        machine.at(**{name: 0.5 * (stroke.start + stroke.end) for name, stroke in machine.strokes.items()} | at)
    else:
        along(machine, options.count)
    from ..draw import poses as drawn

    return drawn(machine, at or None, traced(machine, options.path), options.count)
