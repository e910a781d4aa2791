"""`hydrolinkage draw NAME`, `plot NAME`, `animate NAME`: a machine at some strokes, curves of its results, both as a film."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Sequence

from ..errors import DefinitionError, ensure
from ..mechanism import Mechanism
from ..motion import Motion
from ..reports import columns_about, results, stroke_middles
from . import settings
from .command import (
    PATH,
    Command,
    count_option,
    group,
    machine_options,
    option,
    picture,
    picture_option,
    pose_options,
    progress_bar,
    repeatable,
    run_options,
)
from .settings import ALONG, FORCES, LIMIT


@Command(
    "draw",
    "a picture of the machine at its end positions or at some strokes, with paths, forces, poles, clearances",
    *machine_options(),
    picture_option("default: NAME.png"),
    repeatable(
        "--at",
        "S=0.6,650mm",
        "at these values of a stroke, the last one bold (default: both ends of the first stroke); repeatable",
        "strokes",
    ),
    PATH,
    count_option(101, "poses along a path"),
    group(
        "over the machine, at one pose",
        option("--forces", action="store_true", help="the forces in all pins, and the loads"),
        option("--on", metavar="BODY", help="all forces on this body, drawn alone, and their polygon"),
        option("--poles", action="store_true", help="the instant centre of each body"),
        option("--clearance", action="store_true", help="where what `Planes` keep apart comes nearest"),
    ),
    *FORCES,
)
def draw_command(options: Namespace) -> int:
    """Draw a machine into a file."""
    machine = settings.machine_of(options)
    path = picture(options, machine)
    fits = options.forces or options.on or not (options.case or options.direction)
    ensure(fits, "--case and --direction are of forces; say --forces too, or --on BODY.")
    ensure(not (options.forces and options.on), "--forces are those of all pins, --on those of one body; give one of them.")
    at, acting = settings.strokes_given(machine, options), settings.acting_of(machine, options)
    if at:
        settings.with_gaps(machine, stroke_middles(machine) | at)
    else:
        settings.motion_along(machine, options.count)
    from ..pictures import draw

    draw(
        machine, at or None, traced_points(machine, options.path), options.count, forces=options.on or options.forces,
        case=settings.plain_value(acting).case, direction=options.direction, drive=options.drive,
        pole=options.poles, clearance=options.clearance,
    ).savefig(path)  # fmt: skip
    print(path)
    return 0


@Command(
    "plot",
    "curves of the columns named over a stroke, else of what the machine is about",
    *machine_options(),
    option("columns", metavar="COLUMN", nargs="*", default=[], help="these columns of `table`"),
    picture_option("default: NAME.png"),
    *pose_options(101),
    ALONG,
    *FORCES,
    LIMIT,
)
def plot_command(options: Namespace) -> int:
    """Draw curves into a file."""
    machine = settings.machine_of(options)
    path = picture(options, machine)
    fits = options.columns or not (options.limits or options.case or options.direction)
    ensure(fits, "--limit, --case and --direction go with curves; name their columns, such as plot NAME pressure.")
    at = settings.strokes_or_motion(machine, options)
    from ..pictures import plot

    if options.columns or isinstance(at, Motion):
        many = not isinstance(at, Motion) and any(len(values) > 1 for values in at.values())
        over, case = (settings.motions_at(machine, options)[0][1], None) if many else settings.motion_along(machine, options.count, at)
        acting = settings.plain_value(settings.acting_of(machine, options))
        names = options.columns or columns_about(machine, results(machine, over, case))
        columns = settings.columns_picked(machine, over, names, [], acting, None if options.case else case)
        names = [column.name for column in columns]
        limits: dict[str, Sequence[object]] = {name: limit for name, limit in machine.featured().limits.items() if name in names}
        limits |= dict(settings.parse_limit(text, columns) for text in options.limits)
        figure = plot(over, columns, limits=limits)
    else:
        settings.motion_along(machine, options.count, at)
        figure = plot(machine, at=at, count=options.count)
    figure.savefig(path)
    print(path)
    return 0


def traced_points(machine: Mechanism, names: Sequence[str] | None) -> tuple[str, ...]:
    """Return the points whose paths are drawn: those named, else those the machine is about, else the last one built."""
    return tuple(machine.featured().path) or machine.plan.moving[-1:] if names is None else tuple(names)


FILMS = (".gif", ".mp4", ".html")


@Command(
    "animate",
    "an animation of a stroke with a live curve, as .gif, .mp4 or an .html page",
    *machine_options(),
    option("-o", "--output", metavar="FILE", required=True, help=f"{', '.join(FILMS)}"),
    option("--column", metavar="I", help="the column of `table` whose curve runs along (default: what it is about)"),
    PATH,
    LIMIT,
    *run_options(60, "poses over the stroke"),
    ALONG,
)
def animate_command(options: Namespace) -> int:
    """Write an animation into a file."""
    machine = settings.machine_of(options)
    path = picture(options, machine, FILMS)
    at, trace = settings.strokes_or_motion(machine, options), traced_points(machine, options.path)
    columns = results(machine, *settings.motion_along(machine, options.count, at))
    column: str | None = options.column
    limit: Sequence[object] | None = None
    ensure(len(options.limits) <= 1, "one curve runs along an animation, with one limit; give one --limit.")
    for text in options.limits:
        column, limit = settings.parse_limit(text, columns)
        if options.column not in (None, column):
            raise DefinitionError(f"--limit is of {column}, and the curve that runs along is of {options.column}; name the same column.")
    from ..pictures import animate

    with progress_bar(f"drawing {path.name}") as progress:
        animate(machine, path, count=options.count, column=column, trace=trace, limit=limit, at=at, progress=progress)
    print(path)
    return 0
