"""Rows of wanted values: as they stand in a file, or in a CSV file beside it with its units in its headings.

    x [mm], y [mm], phi [deg]
    30.0, 60.0, 12
    15.5, 70.2, 45
"""

from __future__ import annotations

import csv
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from io import StringIO
from math import isfinite
from pathlib import Path
from typing import final

import numpy as np

from ..errors import DefinitionError, ensure, known_name, unknown
from ..program import FloatArray
from ..quantities import is_number
from ..units import UNITS, factor, units_of
from .names import shortened
from .study_file import amount_said

MOST_BYTES = 10_000_000
DELIMITERS = (";", "\t", ",")
_HEADING = re.compile(r"(?P<name>[^\[(,/]*?)\s*(?:[\[(,/]\s*(?P<unit>[^\])]*?)\s*[\])]?)?\Z")


@final
@dataclass(frozen=True)
class PointColumn:
    """A column of wanted values: its names, the first of which messages use, what it measures, and whether it may be missing."""

    names: tuple[str, ...]
    measures: str
    optional: bool = False

    @property
    def name(self) -> str:
        """What it is called."""
        return self.names[0]


def units_said(given: object) -> dict[str, float]:
    """Return factors of units by what they measure: of `"mm"`, or of a list `["mm", "deg"]`; DefinitionError for anything but a unit."""
    names = [known_name("Unit", each, UNITS) for each in (given if isinstance(given, list) else [given])]
    return {UNITS[name][1]: factor(name) for name in names}


def points_said(given: object, columns: Sequence[PointColumn], units: Mapping[str, float], base: Path) -> dict[str, FloatArray]:
    """Return wanted values by the names of columns [SI]; DefinitionError for anything else.

    `given` are rows, or a text, the CSV file with them, from the folder `base`. `units` are factors of plain numbers by what they measure.
    """
    if isinstance(given, str):
        return points_of_file(base / given, columns, units)
    words = ", ".join(each.name for each in columns if not each.optional)
    if not isinstance(given, list) or not given:
        raise DefinitionError(f'{shortened(given)}: rows of {words} are expected, [[30, 60], [15, 70]], or a CSV file, "points.csv".')
    sizes = {len(columns), len([each for each in columns if not each.optional])}
    for number, row in enumerate(given, 1):
        if not isinstance(row, list) or len(row) not in sizes or len(row) != len(given[0]):
            raise DefinitionError(f"row {number}, {shortened(row)}: a list with {words} is expected, all rows of one length.")
    found = {}
    for place, column in enumerate(columns[: len(given[0])]):
        by = units.get(column.measures, 1.0)
        values = [amount_said(row[place], column.measures) * (by if is_number(row[place]) else 1.0) for row in given]
        found[column.name] = np.array(values)
    return found


def points_of_file(path: Path, columns: Sequence[PointColumn], units: Mapping[str, float]) -> dict[str, FloatArray]:
    """Return the columns of a CSV file [SI]; DefinitionError with the file and the line of what is wrong."""
    rows = [*csv_rows(path)]
    ensure(rows, f"{path.name} holds no row; write a heading such as x [mm], y [mm], and a row for each point.")
    line, first = rows[0]
    if all(is_numeral(cell) for cell in first):
        needed = [each for each in columns if not each.optional]
        chosen = columns if len(first) == len(columns) else needed
        if len(first) != len(chosen):
            words = ", ".join(each.name for each in needed)
            raise DefinitionError(f"{path.name}, line {line}: {len(first)} numbers where {words} are expected; or begin with headings.")
        places = {each.name: (place, units.get(each.measures, 1.0)) for place, each in enumerate(chosen)}
    else:
        places, rows = headings_read(path, first, columns, units), rows[1:]
    found: dict[str, list[float]] = {name: [] for name in places}
    for line, row in rows:
        if len(row) != len(first):
            raise DefinitionError(f"{path.name}, line {line}: {len(row)} fields where the first line has {len(first)}.")
        for name, (place, by) in places.items():
            if not is_numeral(row[place]):
                raise DefinitionError(f"{path.name}, line {line}, {name}: {shortened(row[place])} is no finite number.")
            found[name].append(float(row[place]) * by)
    ensure(rows, f"{path.name} has headings and no row; write a row for each point.")
    return {name: np.array(values) for name, values in found.items()}


def headings_read(
    path: Path, cells: Sequence[str], columns: Sequence[PointColumn], units: Mapping[str, float]
) -> dict[str, tuple[int, float]]:
    """Return where each column stands, and the factor of its unit; DefinitionError where one is missing."""
    found: dict[str, tuple[int, float]] = {}
    heads = [match for cell in cells if (match := _HEADING.match(cell.strip()))]
    for column in columns:
        for place, head in enumerate(heads):
            if head["name"] in column.names and column.name not in found:
                by, unit = units.get(column.measures, 1.0), head["unit"]  # without one that which is said for what the column measures
                if unit:
                    by = factor(known_unit(f"{path.name}, line 1, {head['name']}", unit, column.measures))
                found[column.name] = place, by
        if column.name not in found and not column.optional:
            named = " or ".join(column.names)
            raise DefinitionError(f"{path.name}, line 1: there is no column {named}; its headings are {', '.join(cells)}.")
    return found


def known_unit(what: str, unit: str, measures: str) -> str:
    """Return a unit of what should be measured; DefinitionError for another one."""
    if unit not in UNITS:
        raise DefinitionError(f"{what}: {unknown('Unit', unit, UNITS)}")
    if measures and UNITS[unit][1] != measures:
        raise DefinitionError(f"{what}: {unit} measures {UNITS[unit][1]}; use one of {', '.join(units_of(measures))}.")
    return unit


def csv_rows(path: Path) -> Iterator[tuple[int, list[str]]]:
    """Yield the rows of a CSV file with their lines, without empty ones and those that begin with #; decimal commas as points."""
    try:
        if path.stat().st_size > MOST_BYTES:
            raise DefinitionError(f"{path.name} is larger than {MOST_BYTES // 1_000_000} MB; give fewer points.")
        text = path.read_text(encoding="utf-8-sig")
    except OSError as error:
        raise DefinitionError(f"{path.name} cannot be read: {error.strerror}; paths start from the file's own folder.") from None
    except UnicodeDecodeError:
        raise DefinitionError(f"{path.name} is no text in UTF-8; save it as CSV UTF-8.") from None
    first = next((line for line in text.splitlines() if line.strip() and not line.startswith("#")), "")
    delimiter = next((each for each in DELIMITERS if each in first), ",")
    reader = csv.reader(StringIO(text), delimiter=delimiter, skipinitialspace=True)
    for row in reader:
        cells = [cell.strip() for cell in row]
        if not any(cells) or cells[0].startswith("#"):
            continue
        yield reader.line_num, [re.sub(r"^([-+]?\d*),(\d+)$", r"\1.\2", cell) for cell in cells] if delimiter != "," else cells


def is_numeral(cell: str) -> bool:
    """Return whether a text is a finite number."""
    try:
        return isfinite(float(cell))
    except ValueError:
        return False
