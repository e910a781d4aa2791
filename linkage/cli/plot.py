"""`hydrolinkage draw NAME`, `plot NAME`, `animate NAME`: a machine at some strokes, curves of its results, both as a film."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from collections.abc import Sequence
from typing import Any, final

from ..errors import DefinitionError, ensure
from ..mechanism import Mechanism
from ..reports import results, stroke_middles
from . import command, settings
from .command import Command, machine_arguments, picture, progress_bar, repeatable, whole_number


@final
class DrawCommand(Command):
    """Draws a machine into a file."""

    name = "draw"
    help = "a picture of the machine at its end positions or at some strokes, with paths, forces, poles, clearances"

    def add(self, parser: ArgumentParser) -> None:
        machine_arguments(parser)
        command.picture_argument(parser, "default: NAME.png")
        what = "at these values of a stroke, the last one bold (default: both ends of the first stroke); repeatable"
        repeatable(parser, "--at", "S=0.6,650mm", what, "strokes")
        command.path_argument(parser)
        parser.add_argument("--count", metavar="N", type=whole_number, default=101, help="poses along a path (default 101)")
        forces = parser.add_argument_group("over the machine, at one pose")
        forces.add_argument("--forces", action="store_true", help="the forces in all pins, and the loads")
        forces.add_argument("--on", metavar="BODY", help="all forces on this body, drawn alone, and their polygon")
        forces.add_argument("--poles", action="store_true", help="the instant centre of each body")
        forces.add_argument("--clearance", action="store_true", help="where what `Planes` keep apart comes nearest")
        settings.force_arguments(parser)

    def run(self, options: Namespace) -> int:
        machine = settings.machine_of(options)
        path = picture(options, machine)
        if (options.case or options.direction) and not (options.forces or options.on):
            raise DefinitionError("--case and --direction are of forces; say --forces too, or --on BODY.")
        if options.forces and options.on:
            raise DefinitionError("--forces are those of all pins, --on those of one body; give one of them.")
        at, acting = settings.strokes_given(machine, options), settings.acting_of(machine, options)
        if at:
            settings.with_gaps(machine, stroke_middles(machine) | at)
        else:
            settings.motion_along(machine, options.count)
        from ..pictures import draw

        draw(
            machine, at or None, traced_points(machine, options.path), options.count, forces=options.on or options.forces,
            case=settings.plain_value(acting).case, direction=options.direction or "frictionless", drive=options.drive,
            pole=options.poles, clearance=options.clearance,
        ).savefig(path)  # fmt: skip
        print(path)
        return 0


@final
class PlotCommand(Command):
    """Draws curves into a file."""

    name = "plot"
    help = "curves of the columns named over a stroke, else of what the machine is about"

    def add(self, parser: ArgumentParser) -> None:
        machine_arguments(parser)
        parser.add_argument("columns", metavar="COLUMN", nargs="*", default=[], help="these columns of `table`")
        command.picture_argument(parser, "default: NAME.png")
        command.motion_arguments(parser, 101)
        settings.force_arguments(parser)
        settings.limit_argument(parser)

    def run(self, options: Namespace) -> int:
        machine = settings.machine_of(options)
        path = picture(options, machine)
        if not options.columns and (options.limits or options.case or options.direction):
            raise DefinitionError("--limit, --case and --direction go with curves; name their columns, such as plot NAME pressure.")
        at = settings.strokes_given(machine, options)
        from ..pictures import plot

        if not options.columns:
            settings.motion_along(machine, options.count, at)
            figure = plot(machine, at=at, count=options.count)
        else:
            many = any(len(values) > 1 for values in at.values())
            over = settings.motion_at(machine, options) if many else settings.motion_along(machine, options.count, at)
            acting = settings.plain_value(settings.acting_of(machine, options))
            columns = settings.columns_picked(machine, over, options.columns, [], acting)
            names = [column.name for column in columns]
            limits: dict[str, Sequence[Any]] = {name: limit for name, limit in machine.featured().limits.items() if name in names}
            limits |= dict(settings.parse_limit(text, columns) for text in options.limits)
            figure = plot(over, columns, limits=limits)
        figure.savefig(path)
        print(path)
        return 0


def traced_points(machine: Mechanism, names: Sequence[str] | None) -> tuple[str, ...]:
    """Return the points whose paths are drawn: those named, else those the machine is about, else the last one built."""
    return tuple(machine.featured().path) or machine.plan.moving[-1:] if names is None else tuple(names)


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
        command.path_argument(parser)
        settings.limit_argument(parser)
        command.run_arguments(parser, 60, "poses over the stroke")

    def run(self, options: Namespace) -> int:
        machine = settings.machine_of(options)
        path = picture(options, machine, SUFFIXES)
        at, trace = settings.strokes_given(machine, options), traced_points(machine, options.path)
        columns = results(machine, settings.motion_along(machine, options.count, at))
        column: str | None = options.column
        limit: Sequence[Any] | None = None
        ensure(len(options.limits) <= 1, "one curve runs along an animation, with one limit; give one --limit.")
        for text in options.limits:
            column, limit = settings.parse_limit(text, columns)
            if options.column not in (None, column):
                raise DefinitionError(
                    f"--limit is of {column}, and the curve that runs along is of {options.column}; name the same column."
                )
        from ..pictures import animate

        with progress_bar(f"drawing {path.name}") as progress:
            animate(machine, path, count=options.count, column=column, trace=trace, limit=limit, at=at, progress=progress)
        print(path)
        return 0
