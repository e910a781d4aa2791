"""`hydrolinkage chart NAME --point X --x ... --y ...`: what is lifted at every place, as a table, a picture or a file."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from typing import Any, final

import numpy as np

from ..errors import DefinitionError
from ..files.criterion import quantity_said
from ..motion import Target
from ..motion.kinds import measure_of
from ..units import parse, parse_span
from .command import PICTURES, Command, lined_up, machine_arguments, picture, repeatable
from .follow import strokes_said
from .settings import machine_of, pair, parsed_over, si_value

PAGE = ".html"
SUFFIXES = (*PICTURES, ".csv", ".xlsx", PAGE)
COUNT = 11
"""Places of an axis whose step is not said."""


@final
class ChartCommand(Command):
    """Prints or writes a load chart."""

    name = "chart"
    help = "what a machine lifts at a point over radii and heights, and what limits it: a load chart"

    def add(self, parser: ArgumentParser) -> None:
        machine_arguments(parser)
        parser.add_argument("--point", metavar="G", required=True, help="the point that the load hangs on")
        axis = "0:6m:0.5m from, to and step, without a step 11 places; or each, 1m,1.5m,2m; lengths without a unit are in m"
        parser.add_argument("--x", metavar="FROM:TO:STEP", required=True, help=f"the radii: {axis}")
        parser.add_argument("--y", metavar="FROM:TO:STEP", required=True, help="the heights, in the same way")
        against = "the direction against which the load pulls (default 0,1: it hangs)"
        parser.add_argument("--along", metavar="X,Y", default="0,1", help=against)
        repeatable(parser, "--hold", "S=1.1m", "hold a stroke there; repeatable")
        runs = "how far strokes run, two ends of each, or a declared Over by its name (default: as far as declared)"
        parser.add_argument("--over", metavar='"t=0:2m"', help=runs)
        repeatable(parser, "--keep", "tilt=0deg", "a value kept at every place; repeatable")
        lifting = "this cylinder lifts, those not named hold; repeatable (default: all lift)"
        repeatable(parser, "--lift", "RAM", lifting)
        parser.add_argument("--rule", metavar="RULE", help="the rule whose factors count: ISO 10567, ISO 14397-1, OECD Code 2")
        parser.add_argument("--case", metavar="CASE", help="the load case of this name")
        repeatable(parser, "--without", "LOAD", "leave a declared load out; repeatable")
        most = "a load that is not exceeded; repeatable"
        repeatable(parser, "--limit", '"rated load=20kN"', most, "limits")
        parser.add_argument("-o", "--output", metavar="FILE", help=f"write it: {', '.join(SUFFIXES)}")

    def run(self, options: Namespace) -> int:
        from ..study import working_field

        machine = machine_of(options)
        path = None if options.output is None else picture(options, machine, SUFFIXES)
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


def axis_said(option: str, text: str) -> Any:
    """Return the places along an axis [m]; DefinitionError for what says none."""
    span = parse_span(text, "length")
    parts = [part.strip() for part in text.split(":")]
    if span is None and len(parts) == 1:
        return np.array([si_value(part, "length", option) for part in text.split(",") if part.strip()])
    if span is None and len(parts) > 3:
        raise DefinitionError(f"{option} {text}: from, to and step are expected, such as {option} 0:6m:0.5m.")
    first, last, *step = span if span is not None else [si_value(part, "length", option) for part in parts]
    if not step:
        return np.linspace(first, last, COUNT)
    if not step[0] * (last - first) > 0.0:
        raise DefinitionError(f"{option} {text}: no step of {step[0]:g} m leads from {first:g} to {last:g} m; give another step.")
    count = (last - first) / step[0]
    if count > 1e6:
        raise DefinitionError(f"{option} {text}: these are {count:.3g} places; give a longer step.")
    return first + step[0] * np.arange(int(count + 1e-9) + 1)


def print_chart(field: Any) -> None:
    """Print a chart as text: heights from above, radii across, a letter for each limiter."""
    from ..pictures.load_chart import ChartText

    text = ChartText(field)
    across, down = np.argsort(field.x, kind="stable"), np.argsort(-field.y, kind="stable")
    rows = [["", *(text.length_text(float(field.x[n])) for n in across)]]
    for k in down:
        cells = (f"{text.load_text(float(field.load[k, n]))} {text.letters.get(str(field.limiter[k, n]), '')}".strip() for n in across)
        rows.append([text.length_text(float(field.y[k])), *(cell or "-" for cell in cells)])
    print(text.title)
    print(*lined_up(rows), *text.legend(), sep="\n")
