"""`hydrolinkage report NAME` and `page NAME`, a report and a live page in one file; `draw`, `plot` and `animate`, its pictures."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Sequence
from pathlib import Path

from ..disk import check_place
from ..errors import DefinitionError, ensure
from ..mechanism import Mechanism
from ..motion import Motion
from ..plan import plan_measure
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
    whole_number,
    without_lists_of_properties,
)
from .settings import ALONG, FORCES, LIMIT, OVER, machine_of, motion_along, overs_of, pair, si_value, strokes_given, with_overs

KINDS = (".html", ".pdf", ".md")
TITLE = {
    "number": "R-104", "revision": "A", "date": "2026-05-01", "client": "NAME", "prepared": "NAME", "checked": "NAME", "approved": "NAME",
}  # fmt: skip
"""The fields of the title block, each with an example."""


@Command(
    "report",
    "a machine's calculation report: inputs, drawings, equations with numbers, forces, checks, verdicts",
    *machine_options(),
    option("columns", metavar="COLUMN", nargs="*", default=[], help="only these results (default: all)"),
    option("-o", "--output", metavar="FILE", help=f"{', '.join(KINDS)} (default: the machine's name with .html)"),
    *pose_options(11),
    PATH,
    OVER,
    option("--case", metavar="CASE", help="this load case alone, plain: the machine's own loads (default: all)"),
    option("--start", metavar="N", type=whole_number, default=1, help="the first equation's number (default 1)"),
    group(
        "title block",
        *(option(f"--{name}", metavar=example, default="") for name, example in TITLE.items()),
        repeatable("--row", "NAME=TEXT", "a row below the title block; repeatable", "rows"),
        about="what is left out is an empty line to write on",
    ),
)
def report_command(options: Namespace) -> int:
    """Write a report."""
    without_lists_of_properties()
    from ..documents import report

    machine = machine_of(options)
    path = Path(options.output or f"{type(machine).__name__}.html")
    ensure(path.suffix.lower() in KINDS, f"-o {path}: a report's name ends in one of {', '.join(KINDS)}, which chooses the format.")
    check_place(path)
    at = strokes_given(machine, options)
    rows = dict(pair(text, "--row", '"Order=4711"') for text in options.rows)
    with progress_bar(f"writing {path.name}"):
        written = report(
            machine, path, case=options.case, over=overs_of(machine, options.over), at=at, count=options.count,
            columns=options.columns or None, trace=options.path, title_block=rows, start=options.start,
            **{name: getattr(options, name) for name in TITLE},
        )  # fmt: skip
    print(written)
    return 0


@Command(
    "page",
    "a live page, .html: the machine moved and its dimensions changed in a browser, offline",
    *machine_options(),
    option("-o", "--output", metavar="FILE", help="the page, .html (default: NAME.html)"),
    repeatable(
        "--vary",
        "OB=280mm,340mm",
        "a dimension with a slider, and its range if it is given; a point has two; repeatable (default: the first lengths)",
    ),
    option("--column", metavar="I", help="the column of `table` that is shown first"),
    option("--path", metavar="G", action="append", help="draw this point's path; repeatable"),
    OVER,
    *run_options(101, "poses of the curve"),
)
def page_command(options: Namespace) -> int:
    """Write a live page into a file."""
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

    with progress_bar(f"writing {path.name}"):
        page(
            machine, path, vary=vary or None, column=options.column, trace=options.path, at=at, count=options.count,
            language=options.language,
        )  # fmt: skip
    print(path)
    return 0


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
    without_lists_of_properties()
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
    options.over = next(iter(settings.slow_overs(machine, options)), options.over)
    at = settings.strokes_or_motion(machine, options)
    without_lists_of_properties()
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
    """Return the points whose paths are drawn: those named, else those the machine is about, else its tip."""
    return tuple(machine.featured().path) or machine.plan.tip if names is None else tuple(names)


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
    without_lists_of_properties()
    from ..pictures import animate

    with progress_bar(f"drawing {path.name}") as progress:
        animate(machine, path, count=options.count, column=column, trace=trace, limit=limit, at=at, progress=progress)
    print(path)
    return 0
