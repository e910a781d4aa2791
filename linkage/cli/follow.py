"""`hydrolinkage follow NAME --path FILE.csv`: the strokes along a path of places, as a table, a picture or an animation."""

from __future__ import annotations

import csv
import io
import re
from argparse import ArgumentParser, Namespace
from collections.abc import Mapping
from pathlib import Path
from typing import Any, final

import numpy as np

from ..disk import read
from ..errors import DefinitionError, FileError
from ..files.criterion import quantity_said
from ..mechanism import Mechanism
from ..motion import Column, Motion, RequestLike, Target, stroke_measure
from ..motion.kinds import measure_of
from ..quantities import x, y
from ..units import UNITS, parse, units_of
from .command import Command, machine_arguments, picture, progress_bar, repeatable
from .settings import acting_of, columns_picked, force_arguments, machine_of, pair, plain_value, si_value
from .table import COLUMNS, csv_argument, write_table

FILMS = (".gif", ".mp4")
PAGE = ".html"
PICTURES = (".png", ".svg", ".pdf", *FILMS, PAGE)
MOST_PLACES = 100_000
SIZE = 1 << 26
"""Bytes of a path's file."""
STAYS = 1e-9
"""Of its range: a stroke that changes by no more along a path is held."""
HEADING = re.compile(r"\s*(?P<name>.*?)\s*(?:,\s*(?P<unit>[^,\[\]()]+?)|\[\s*(?P<bracketed>[^\]]*?)\s*\])?\s*")
"""A heading as tables have it, `M_x, mm`, or with its unit in square brackets."""


@final
class FollowCommand(Command):
    """Follows a path of places."""

    name = "follow"
    help = "the strokes along a path of places that a CSV file gives, on one branch"

    def add(self, parser: ArgumentParser) -> None:
        machine_arguments(parser)
        parser.add_argument("columns", metavar="COLUMN", nargs="*", default=[], help=f"{COLUMNS}; without it the strokes and the path")
        parser.add_argument(
            "--path", metavar="FILE.csv", required=True,
            help="the places, a row each; the first line names what is wanted, with its unit: 'x(M) [mm]', M_y, 'tilt [deg]'",
        )  # fmt: skip
        held = "hold a stroke there; repeatable, or several with commas"
        repeatable(parser, "--hold", "S=1.1m", held)
        begun = "begin on the branch near these strokes (default: the first one that goes all the way)"
        repeatable(parser, "--start", "S=1.1m,T=0.2m", begun)
        parser.add_argument("--gaps", action="store_true", help="leave places empty that are not reached, instead of saying why")
        csv_argument(parser)
        shown = f"a picture, an animation along the path, its live page: {', '.join(PICTURES)}"
        parser.add_argument("-o", "--output", metavar="FILE", help=shown)
        force_arguments(parser)

    def run(self, options: Namespace) -> int:
        machine = machine_of(options)
        path = None if options.output is None else picture(options, machine, PICTURES)
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
        write_table(columns, motion.reached.size, options.csv)
        if path is not None:
            draw_along(machine, motion, path, options.language)
            print(path)
        return 0


def path_targets(machine: Mechanism, file: str) -> dict[str, Target]:
    """Return the targets that a CSV file gives, by their names; FileError with the line for what cannot be read."""
    text = read(file, SIZE).decode("utf-8-sig", "replace")
    first = text.partition("\n")[0]
    delimiter = max(";\t,", key=first.count)
    rows = [row for row in csv.reader(io.StringIO(text), delimiter=delimiter) if any(cell.strip() for cell in row)]
    headings, *places = rows or [[]]
    if not places:
        raise FileError(f"{file}: a first line such as M_x [mm];M_y [mm] and a row for each place are expected.")
    if len(places) > MOST_PLACES:
        raise FileError(f"{file}: {len(places)} places are too many; up to {MOST_PLACES} are followed.")
    asked = [heading_quantity(machine, file, heading) for heading in headings]
    kinds = [measure_of(machine.plan, quantity) for _, quantity, _ in asked]
    values = np.empty((len(headings), len(places)))
    for number, row in enumerate(places):
        if len(row) != len(headings):
            what = f"{len(row)} values for {len(headings)} headings; a heading with a comma has quotes"
            raise FileError(f"{file}, place {number + 1}: {what}.")
        for column, cell in enumerate(row):
            try:
                values[column, number] = parse(f"{cell.strip()} {asked[column][2]}".strip(), kinds[column])
            except DefinitionError as error:
                raise FileError(f"{file}, place {number + 1}, {headings[column].strip()}: {error}") from None
    return {name: Target(quantity, value, unit=unit) for (name, quantity, unit), value in zip(asked, values, strict=True)}


def heading_quantity(machine: Mechanism, file: str, heading: str) -> tuple[str, RequestLike, str]:
    """Return a heading's name, what it means, and its unit, "" of SI: `x(M) [mm]`, `M_x, mm`, `tilt`; FileError for anything else."""
    match = HEADING.fullmatch(heading.lstrip("'"))
    name, unit = (match["name"], match["unit"] or match["bracketed"] or "") if match else (heading.strip(), "")
    sign = {"°": "deg"}.get(unit, unit)
    if sign and sign not in UNITS:
        known = units_of("length") + units_of("angle")
        raise FileError(f"{file}: {heading.strip()}: the unit {sign} is unknown; known are {', '.join(known)} and others.")
    point = re.fullmatch(r"(.+)[._]([xy])", name)
    if name not in machine.plan.members and point and point[1] in machine.plan.points:
        return name, (x if point[2] == "x" else y)(point[1]), sign
    if name in machine.strokes:
        return name, name, sign
    try:
        quantity: RequestLike = quantity_said(name, machine)
    except DefinitionError as error:
        raise FileError(f"{file}: {heading.strip()}: {error}") from None
    return name, quantity, sign


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
    reached: dict[str, Any] = {}
    for name, values in motion.strokes.items():
        known, stroke = values[motion.reached], machine.strokes[name]
        stays = np.ptp(known) <= STAYS * abs(stroke.end - stroke.start)
        reached[name] = float(known[0]) if stays else known
    with progress_bar(f"drawing {path.name}") as progress:
        animate(machine, path, count=int(motion.reached.sum()), at=reached, progress=progress)
