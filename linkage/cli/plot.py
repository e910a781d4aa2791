"""`hydrolinkage draw NAME`, `plot NAME`, `animate NAME`: a machine at some strokes, curves of its results, both as a film."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from collections.abc import Sequence
from typing import Any, final

from ..errors import DefinitionError
from ..mechanism import Mechanism
from ..motion import Column
from ..reports import results, stroke_middles
from .command import (
    Command,
    machine_arguments,
    motion_arguments,
    path_argument,
    picture,
    picture_argument,
    progress_bar,
    repeatable,
    run_arguments,
    whole_number,
)
from .machines import find
from .settings import (
    acting_of,
    columns_picked,
    design,
    force_arguments,
    limit_argument,
    motion_along,
    motion_at,
    parse_limit,
    plain_value,
    strokes_given,
    traced_points,
    with_gaps,
)


@final
class DrawCommand(Command):
    """Draws a machine into a file."""

    name = "draw"
    help = "a picture of the machine at its end positions or at some strokes, with paths, forces, poles, clearances"

    def add(self, parser: ArgumentParser) -> None:
        machine_arguments(parser)
        picture_argument(parser, "default: NAME.png")
        what = "at these values of a stroke, the last one bold (default: both ends of the first stroke); repeatable"
        repeatable(parser, "--at", "S=0.6,650mm", what, "strokes")
        path_argument(parser)
        parser.add_argument("--count", metavar="N", type=whole_number, default=101, help="poses along a path (default 101)")
        forces = parser.add_argument_group("over the machine, at one pose")
        forces.add_argument("--forces", action="store_true", help="the forces in all pins, and the loads")
        forces.add_argument("--on", metavar="BODY", help="all forces on this body, drawn alone, and their polygon")
        forces.add_argument("--poles", action="store_true", help="the instant centre of each body")
        forces.add_argument("--clearance", action="store_true", help="where what `Planes` keep apart comes nearest")
        force_arguments(parser)

    def run(self, options: Namespace) -> int:
        found = find(options.machine)
        path = picture(options.output, found, options.machine)
        machine = design(found, options.settings)
        if (options.case or options.direction) and not (options.forces or options.on):
            raise DefinitionError("--case and --direction are of forces; say --forces too, or --on BODY.")
        if options.forces and options.on:
            raise DefinitionError("--forces are those of all pins, --on those of one body; give one of them.")
        poses(machine, options).savefig(path)
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
        picture_argument(parser, "default: NAME.png")
        motion_arguments(parser, 101)
        force_arguments(parser)
        limit_argument(parser)

    def run(self, options: Namespace) -> int:
        found = find(options.machine)
        path = picture(options.output, found, options.machine)
        machine = design(found, options.settings)
        if not options.columns and (options.limits or options.case or options.direction):
            raise DefinitionError("--limit, --case and --direction go with curves; name their columns, such as plot NAME pressure.")
        curves(machine, options).savefig(path)
        print(path)
        return 0


def curves(machine: Mechanism, options: Namespace) -> Any:
    """Return the figure of the columns named, else of what the machine is about, along one stroke."""
    given = strokes_given(machine, options)
    if not options.columns:
        from ..pictures import plot

        motion_along(machine, options.count, given)
        return plot(machine, at=given, count=options.count)
    many = [name for name, values in given.items() if len(values) > 1]
    over = motion_at(machine, options) if many else motion_along(machine, options.count, given)
    columns = columns_picked(machine, over, options.columns, [], plain_value(acting_of(machine, options)))
    names = [column.name for column in columns]
    limits: dict[str, Sequence[Any]] = {name: limit for name, limit in machine.featured().limits.items() if name in names}
    limits |= dict(parse_limit(text, columns) for text in options.limits)
    from ..pictures import plot

    return plot(over, columns, limits=limits)


def poses(machine: Mechanism, options: Namespace) -> Any:
    """Return the figure of the machine at the strokes chosen, else at its ends."""
    at = strokes_given(machine, options)
    if at:
        with_gaps(machine, stroke_middles(machine) | at)
    else:
        motion_along(machine, options.count)
    from ..pictures import draw

    acting = acting_of(machine, options)
    return draw(
        machine, at or None, traced_points(machine, options.path), options.count, forces=options.on or options.forces,
        case=plain_value(acting).case, direction=options.direction or "frictionless", drive=options.drive, pole=options.poles,
        clearance=options.clearance,
    )  # fmt: skip


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
        limit_argument(parser)
        run_arguments(parser, 60, "poses over the stroke")

    def run(self, options: Namespace) -> int:
        found = find(options.machine)
        path = picture(options.output, found, options.machine, SUFFIXES)
        machine = design(found, options.settings)
        at, trace = strokes_given(machine, options), traced_points(machine, options.path)
        over = motion_along(machine, options.count, at)
        column, limit = curve_and_limit(results(machine, over), options)
        from ..pictures import animate

        with progress_bar(f"drawing {path.name}") as progress:
            animate(machine, path, count=options.count, column=column, trace=trace, limit=limit, at=at, progress=progress)
        print(path)
        return 0


def curve_and_limit(columns: Sequence[Column], options: Namespace) -> tuple[str | None, Sequence[Any] | None]:
    """Return the column whose curve runs along, that of a limit unless one is named, and its limit."""
    if not options.limits:
        return options.column, None
    if len(options.limits) > 1:
        raise DefinitionError("one curve runs along an animation, with one limit; give one --limit.")
    name, limit = parse_limit(options.limits[0], columns)
    if options.column not in (None, name):
        raise DefinitionError(f"--limit is of {name}, and the curve that runs along is of {options.column}; name the same column.")
    return name, limit
