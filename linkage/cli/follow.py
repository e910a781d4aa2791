"""`hydrolinkage follow NAME` and `chart NAME`: the strokes along a path of places; the load at every place of a field."""

from __future__ import annotations

import re
from argparse import Namespace
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..errors import DefinitionError, FileError, ensure
from ..files.expression import quantity_said
from ..files.source import csv_rows, heading_read
from ..mechanism import Mechanism
from ..motion import Column, Motion, RequestLike, Target, stroke_measure
from ..motion.measures import measure_of
from ..program import FloatArray
from ..quantities import x, y
from ..shown import text_columns
from ..units import UNITS, parse, parse_span, units_of
from .command import COLUMNS, CSV, PICTURES, Command, machine_options, option, picture, progress_bar, repeatable
from .settings import FORCES, acting_of, columns_picked, machine_of, pair, parsed_over, plain_value, si_value
from .table import write_table

if TYPE_CHECKING:
    from ..study import WorkingField

FILMS = (".gif", ".mp4")
PAGE = ".html"
ALONG = (*PICTURES, *FILMS, PAGE)
"""What may show a path."""
MOST_PLACES = 100_000
STAYS = 1e-9
"""Of its range: a stroke that changes by no more along a path is held."""


@Command(
    "follow",
    "the strokes along a path of places that a CSV file gives, on one branch",
    *machine_options(),
    option("columns", metavar="COLUMN", nargs="*", default=[], help=f"{COLUMNS}; without it the strokes and the path"),
    option(
        "--path",
        metavar="FILE.csv",
        required=True,
        help="the places, a row each; the first line names what is wanted, with its unit: 'x(M) [mm]', M_y, 'tilt [deg]'",
    ),
    repeatable("--hold", "S=1.1m", "hold a stroke there; repeatable, or several with commas"),
    repeatable("--start", "S=1.1m,T=0.2m", "begin on the branch near these strokes (default: the first one that goes all the way)"),
    option("--gaps", action="store_true", help="leave places empty that are not reached, instead of saying why"),
    CSV,
    option("-o", "--output", metavar="FILE", help=f"a picture, an animation along the path, its live page: {', '.join(ALONG)}"),
    *FORCES,
)
def follow_command(options: Namespace) -> int:
    """Print the strokes along a path of places, and draw them."""
    machine = machine_of(options)
    path = None if options.output is None else picture(options, machine, ALONG)
    acting = acting_of(machine, options)
    targets = path_targets(machine, options.path)
    held, begun = (strokes_said(machine, option, texts) for option, texts in (("--hold", options.hold), ("--start", options.start)))
    motion = machine.follow(list(targets.values()), hold=held, start=begun, unreachable="nan" if options.gaps else "raise")
    if options.columns:
        columns = columns_picked(machine, motion, options.columns, list(motion.strokes), plain_value(acting))
    else:
        columns = columns_picked(machine, motion, list(motion.strokes), [])
        asked = {name: each for name, each in targets.items() if name not in motion.strokes}
        columns += [Column.of(motion, each.quantity, each.shown_in(motion.plan) or None, name) for name, each in asked.items()]
    write_table(columns, options.csv)
    if path is not None:
        draw_along(machine, motion, path, options.language)
        print(path)
    return 0


def path_targets(machine: Mechanism, file: str) -> dict[str, Target]:
    """Return the targets of a CSV file, by their names; FileError with the line for one that cannot be read."""
    try:
        (_, headings), *places = [*csv_rows(Path(file))] or [(0, list[str]())]
    except DefinitionError as error:
        raise FileError(str(error)) from None
    if not places:
        raise FileError(f"{file}: a first line such as M_x [mm];M_y [mm] and a row for each place are expected.")
    if len(places) > MOST_PLACES:
        raise FileError(f"{file}: {len(places)} places are too many; up to {MOST_PLACES} are followed.")
    asked = [heading_quantity(machine, file, heading) for heading in headings]
    kinds = [measure_of(machine.plan, quantity) for _, quantity, _ in asked]
    values = np.empty((len(headings), len(places)))
    for number, (line, row) in enumerate(places):
        if len(row) != len(headings):
            what = f"{len(row)} values for {len(headings)} headings; a heading with a comma has quotes"
            raise FileError(f"{file}, line {line}: {what}.")
        for column, cell in enumerate(row):
            try:
                values[column, number] = parse(f"{cell} {asked[column][2]}".strip(), kinds[column])
            except DefinitionError as error:
                raise FileError(f"{file}, line {line}, {headings[column]}: {error}") from None
    return {name: Target(quantity, value, unit=unit) for (name, quantity, unit), value in zip(asked, values, strict=True)}


def heading_quantity(machine: Mechanism, file: str, heading: str) -> tuple[str, RequestLike, str]:
    """Return a heading's name, its quantity, and its unit, "" of SI: `x(M) [mm]`, `M_x, mm`, `tilt`; FileError for anything else."""
    name, unit = heading_read(heading)
    if unit and unit not in UNITS:
        known = units_of("length") + units_of("angle")
        raise FileError(f"{file}: {heading}: the unit {unit} is unknown; known are {', '.join(known)} and others.")
    point = re.fullmatch(r"(.+)[._]([xy])", name)
    if name not in machine.plan.members and point and point[1] in machine.plan.points:
        return name, (x if point[2] == "x" else y)(point[1]), unit
    if name in machine.strokes:
        return name, name, unit
    try:
        quantity: RequestLike = quantity_said(name, machine)
    except DefinitionError as error:
        raise FileError(f"{file}: {heading}: {error}") from None
    return name, quantity, unit


def strokes_said(machine: Mechanism, option: str, texts: list[str]) -> Mapping[str, float] | None:
    """Return the strokes that `--hold` or `--start` says, None where it is not given."""
    found = {}
    for text in (part for each in texts for part in each.split(",")):
        name, value = pair(text, option, "S=1.1m")
        kind = stroke_measure(machine.plan, name) if name in machine.strokes else ""  # an unknown one is told where it is looked up
        found[name] = si_value(value, kind, f"{option} {name}")
    return found or None


def draw_along(machine: Mechanism, motion: Motion, path: Path, language: str) -> None:
    """Write a picture of a path's ends, its live page, or an animation along the part of it that is reached."""
    from ..pictures import animate, draw, page

    if path.suffix.lower() == PAGE:
        page(motion, path, language=language)
        return
    if path.suffix.lower() not in FILMS:
        draw(motion).savefig(path)
        return
    places = int(motion.reached.sum())
    ensure(places > 1, f"{machine.plan.title}: nothing moves along this path; it has {places} places in reach.")
    reached: dict[str, Any] = {}
    for name, values in motion.strokes.items():
        known, stroke = values[motion.reached], machine.strokes[name]
        stays = np.ptp(known) <= STAYS * abs(stroke.end - stroke.start)
        reached[name] = float(known[0]) if stays else known
    with progress_bar(f"drawing {path.name}") as progress:
        animate(machine, path, count=places, at=reached, progress=progress)


# The load chart.

CHARTS = (*PICTURES, ".csv", ".xlsx", PAGE)
COUNT = 11
"""Places of an axis whose step is not said."""
AXIS = "0:6m:0.5m from, to and step, without a step 11 places; or each, 1m,1.5m,2m; lengths without a unit are in m"


@Command(
    "chart",
    "what a machine lifts at a point over radii and heights, and what limits it: a load chart",
    *machine_options(),
    option("--point", metavar="G", required=True, help="the point that the load hangs on"),
    option("--x", metavar="FROM:TO:STEP", required=True, help=f"the radii: {AXIS}"),
    option("--y", metavar="FROM:TO:STEP", required=True, help="the heights, in the same way"),
    option("--along", metavar="X,Y", default="0,1", help="the direction against which the load pulls (default 0,1: it hangs)"),
    repeatable("--hold", "S=1.1m", "hold a stroke there; repeatable"),
    option(
        "--over",
        metavar='"t=0:2m"',
        help="how far strokes run, two ends of each, or a declared Over by its name (default: as far as declared)",
    ),
    repeatable("--keep", "tilt=0deg", "a value kept at every place; repeatable"),
    repeatable("--lift", "RAM", "this cylinder lifts, those not named hold; repeatable (default: all lift)"),
    option("--rule", metavar="RULE", help="the rule whose factors count: ISO 10567, ISO 14397-1, OECD Code 2"),
    option("--case", metavar="CASE", help="the load case of this name"),
    repeatable("--without", "LOAD", "leave a declared load out; repeatable"),
    repeatable("--limit", '"rated load=20kN"', "a load that is not exceeded; repeatable", "limits"),
    option("-o", "--output", metavar="FILE", help=f"write it: {', '.join(CHARTS)}"),
)
def chart_command(options: Namespace) -> int:
    """Print or write a load chart."""
    from ..study import working_field

    machine = machine_of(options)
    path = None if options.output is None else picture(options, machine, CHARTS)
    along: Any = tuple(si_value(part, "", "--along") for part in options.along.split(","))
    limits = {}
    for text in options.limits:
        name, value = pair(text, "--limit", '"rated load=20kN"')
        limits[name] = si_value(value, "force", f"--limit {name}")
    keep = []
    for text in options.keep:
        name, value = pair(text, "--keep", "tilt=0deg")
        asked = quantity_said(name, machine)
        keep.append(Target(asked, parse(value, measure_of(machine.plan, asked))))
    field = working_field(
        machine, options.point, axis_said("--x", options.x), axis_said("--y", options.y), along=along,
        hold=strokes_said(machine, "--hold", options.hold), over=parsed_over(machine, options.over) if options.over else None,
        keep=keep, lifts=options.lift or None, rule=options.rule, case=options.case, without=options.without, limits=limits,
    )  # fmt: skip
    if path is None:
        print_chart(field)
        return 0
    if path.suffix.lower() == PAGE:
        from ..pictures import page

        page(field, path, language=options.language)  # in the language that it begins with
    elif path.suffix.lower() in PICTURES:
        from ..pictures import plot

        plot(field).savefig(path)
    else:
        from ..exports.export import export

        export(field, path)
    print(path)
    return 0


def axis_said(option: str, text: str) -> FloatArray:
    """Return the places along an axis [m]; DefinitionError for a text without places."""
    span = parse_span(text, "length")
    parts = [part.strip() for part in text.split(":")]
    if span is None and len(parts) == 1:
        return np.array([si_value(part, "length", option) for part in text.split(",") if part.strip()])
    ensure(span is not None or len(parts) <= 3, f"{option} {text}: from, to and step are expected, such as {option} 0:6m:0.5m.")
    first, last, *step = span if span is not None else [si_value(part, "length", option) for part in parts]
    if not step:
        return np.linspace(first, last, COUNT)
    if not step[0] * (last - first) > 0.0:
        raise DefinitionError(f"{option} {text}: no step of {step[0]:g} m leads from {first:g} to {last:g} m; give another step.")
    count = (last - first) / step[0]
    ensure(not count > 1e6, f"{option} {text}: these are {count:.3g} places; give a longer step.")
    return np.asarray(first + step[0] * np.arange(int(count + 1e-9) + 1))


def print_chart(field: WorkingField) -> None:
    """Print a chart as text: heights from above, radii across, a letter for each limiter."""
    from ..pictures.chart_text import ChartText

    text = ChartText(field)
    rows = [["", *(text.length_text(float(field.x[n])) for n in text.across)]]
    for k in text.down:
        cells = (f"{text.load_text(float(field.load[k, n]))} {text.letters.get(str(field.limiter[k, n]), '')}".strip() for n in text.across)
        rows.append([text.length_text(float(field.y[k])), *(cell or "-" for cell in cells)])
    print(text.title)
    print(text_columns(rows), *text.legend(), sep="\n")
