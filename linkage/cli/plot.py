"""`hydrolinkage plot NAME`: a machine at its end positions, or curves of its results."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from typing import Any, final

from ..mechanism import Mechanism
from .command import Command, machine_arguments, motion_arguments, path_argument, picture, picture_argument, pose_count, progress_bar
from .machines import find
from .settings import columns_picked, design, motion_along, motion_at, stroke_values, traced_points


@final
class PlotCommand(Command):
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
    given = dict(stroke_values(machine.plan, text) for text in options.strokes)
    many = [name for name, values in given.items() if len(values) > 1]
    over = motion_at(machine, options.strokes, options.count) if many else motion_along(machine, options.count, given)
    columns = columns_picked(machine, over, options.columns, [])
    limits = {column.name: machine.featured().limits.get(column.name) for column in columns}
    from ..pictures import plot

    return plot(over, columns, limits={name: limit for name, limit in limits.items() if limit is not None})


def poses(machine: Mechanism, options: Namespace) -> Any:
    """Return the figure of the machine at the strokes chosen, else at its ends."""
    at = dict(stroke_values(machine.plan, text) for text in options.strokes)
    if at:
        machine.at(**{name: 0.5 * (stroke.start + stroke.end) for name, stroke in machine.strokes.items()} | at)
    else:
        motion_along(machine, options.count)
    from ..pictures import draw

    return draw(machine, at or None, traced_points(machine, options.path), options.count)


# `hydrolinkage animate NAME -o FILE`: a machine over its stroke, with the live curve of a result.

SUFFIXES = (".gif", ".mp4", ".html")


@final
class AnimateCommand(Command):
    """Writes an animation into a file."""

    name = "animate"
    help = "an animation of a stroke with a live curve, as .gif, .mp4 or an .html page"

    def add(self, parser: ArgumentParser) -> None:
        machine_arguments(parser)
        parser.add_argument("-o", "--output", metavar="FILE", required=True, help=f"{', '.join(SUFFIXES)}")
        parser.add_argument("--column", metavar="I", help="the column of `table` whose curve runs along (default: what it is about)")
        path_argument(parser)
        parser.add_argument("--count", metavar="N", type=pose_count, default=60, help="poses over the stroke (default 60)")
        parser.add_argument(
            "--at", dest="strokes", metavar="S=0.6", action="append", default=[],
            help="hold a stroke at a value, or run between two: S=0.1,650mm; without it the first runs, others stand in their middle",
        )  # fmt: skip

    def run(self, options: Namespace) -> int:
        found = find(options.machine)
        path = picture(options.output, found, options.machine, SUFFIXES)
        machine = design(found, options.settings)
        at, trace = dict(stroke_values(machine.plan, text) for text in options.strokes), traced_points(machine, options.path)
        motion_along(machine, options.count, at)
        from ..pictures import animate

        with progress_bar(f"drawing {path.name}") as progress:
            animate(machine, path, count=options.count, column=options.column, trace=trace, at=at, progress=progress)
        print(path)
        return 0
