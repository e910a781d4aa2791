"""Design variables and strokes with their values, in the units an engineer reads them in; results as aligned text and as CSV."""

from __future__ import annotations

import csv
import inspect
import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import is_dataclass, replace
from math import floor, isfinite, log10
from typing import TextIO

import numpy as np

from ..errors import is_listed, of_one_shape, require
from ..language import said
from ..loads import ForceElement, TwoPoint
from ..mechanism import Mechanism, require_mechanism
from ..motion import Column, stroke_display_unit
from ..plan import Plan, plan_measure
from ..program import FloatArray
from ..quantities import Member, is_number, is_whole
from ..units import display_unit, show, shown_number, unit_sign

STEPS = ("length", "angle")  # kinds of variables that a step's label makes


def dimension_unit(machine: Mechanism, name: str) -> str:
    """Return the unit that a design variable is given in, else the display unit of its kind."""
    return machine.plan.table.entries[name].unit or display_unit(plan_measure(machine.plan, name), "mm")


def design_rows(machine: Mechanism) -> Iterator[tuple[str, str, str]]:
    """Yield, for each design variable, its name, its value with unit, and the step that has it, or that it is not given."""
    require_mechanism(machine)
    for name, value in machine.dimensions.items():
        entry = machine.plan.table.entries[name]
        unit = dimension_unit(machine, name)
        low, high = show(float(np.min(value)), unit), show(float(np.max(value)), unit)
        note = entry.where if entry.kind in STEPS else said("not given") if is_left_out(machine, name) else ""
        yield name, low if low == high else said("{low} to {high}", low=low, high=high), note


def stroke_rows(machine: Mechanism) -> Iterator[tuple[str, str]]:
    """Yield, for each stroke, its name and its range with unit."""
    require_mechanism(machine)
    for name, stroke in machine.strokes.items():
        unit = stroke_display_unit(machine.plan, name, "mm")
        yield name, said("{low} to {high}", low=shown_number(stroke.start, unit), high=show(stroke.end, unit))


DIGITS = 7
"""The digits of a number as it is declared."""
LONG = re.compile(r"\d+\.\d{7,}(?:e[-+]?\d+)?")
"""A number with more of them."""
PLACE = re.compile(r"(?<=, )at=\((-?[\d.e-]+), (-?[\d.e-]+)\)")
"""A place on a link [m]."""
PARAMETER = re.compile(r"(, |(?<![\w.]))(\w+)=(-?\d+(?:\.\d*)?(?:e[-+]?\d+)?)(?=[,)])")
"""A number by itself; one in an expression keeps its SI, as the names beside it have no unit there."""


def with_units(plan: Plan, name: str, text: str) -> str:
    """Return how a member is declared, the numbers of an element in the units that they are shown in, `pressure=180 bar`.

    None is left as it is. Strokes at which a line is filled have the strokes' units, cylinders' lengths a length's.
    """
    element = plan.members[name]
    if not isinstance(element, ForceElement):
        return in_digits(text)
    strokes = {each: stroke_display_unit(plan, each, "mm") for each in plan.strokes}
    alone = {"at": next(iter(strokes.values()))} if len(strokes) == 1 else {}
    own = {name: unit for name, unit in number_units(element).items() if unit}
    units = dict.fromkeys(plan.of_kind(TwoPoint), "mm") | strokes | alone | own
    defaults = {each: parameter.default for each, parameter in inspect.signature(type(element)).parameters.items()}

    def shown(found: re.Match[str]) -> str:
        comma, name, value = found[1], found[2], float(found[3])
        if comma and name in element.numbers and is_number(defaults.get(name)) and value == float(defaults[name]):
            return ""
        return f"{comma}{name}={show(value, units[name])}" if units.get(name) else f"{comma}{name}={value:.{DIGITS}g}"

    def placed(found: re.Match[str]) -> str:  # along and across a link
        return f"at=({', '.join(shown_number(float(each), 'mm') for each in found.groups())}) {unit_sign('mm')}"

    return in_digits(PLACE.sub(placed, PARAMETER.sub(shown, text)))


def number_units(element: object) -> dict[str, str]:
    """Return the display units of an element's numbers, and of its parts', such as a tank on a line."""
    found: dict[str, str] = {}
    for value in vars(element).values():
        for each in value if is_listed(value) else (value,):
            if is_dataclass(each) and not isinstance(each, type) and not (isinstance(each, Member) and each.name):
                found |= number_units(each)
    return found | dict(getattr(element, "numbers", getattr(element, "parameters", {})))


def in_digits(text: str) -> str:
    """Return a declaration whose numbers have DIGITS digits at the most."""
    return LONG.sub(lambda found: f"{float(found[0]):.{DIGITS}g}", text)


def is_left_out(machine: Mechanism, name: str) -> bool:
    """Return whether a number of an element changes nothing since it was not given, as a flow of 0, an efficiency of 1."""
    owner, _, own = name.rpartition(".")
    kind = type(machine.plan.members.get(owner))
    default = getattr(kind, own, None)
    return issubclass(kind, ForceElement) and default in (0.0, 1.0) and bool(np.all(np.asarray(machine.dimensions[name]) == default))


GAP = "  "
NO_VALUE = "-"  # stands for NaN: not reached, or not limited
FIGURES, ROUNDING = 3, 1e-9
"""The figures that the largest number of a column has at the least, and below which all are taken for rounding."""


def flat(columns: Sequence[Column]) -> list[FloatArray]:
    """Return the columns' values in their units, one row a pose: broadcast to one shape, the designs outermost."""
    is_table = is_listed(columns) and columns and all(isinstance(each, Column) for each in columns)
    require(is_table, "", columns, "is no table; give a list of columns, such as machine.columns(motion)")
    names, shown = [column.name for column in columns], [np.asarray(column.shown) for column in columns]
    return [each.ravel() for each in of_one_shape("The columns' shapes", names, shown)]


def column_texts(column: Column, values: FloatArray) -> list[str]:
    """Return a column's numbers as text, with its number of decimals; more where the largest in a unit has fewer than FIGURES."""
    most = max((abs(value) for value in values.tolist() if isfinite(value)), default=0.0)
    digits = max(column.shown_digits, FIGURES - 1 - floor(log10(most)) if column.unit and most > ROUNDING else 0)
    return [NO_VALUE if np.isnan(value) else f"{value:z.{digits}f}" for value in values.tolist()]


def column_blocks(headings: Sequence[int], texts: Sequence[Sequence[str]], width: int | None) -> Iterator[list[int]]:
    """Yield the indices of the columns that stand beside each other in `width` characters; the first leads every block.

    `headings` are how many characters a heading is wide. Without a width all stand beside each other.
    """
    sizes = [len(GAP) + max(heading, *map(len, text)) for heading, text in zip(headings, texts, strict=True)]
    block = [0]
    for index in range(1, len(sizes)):
        if width is not None and len(block) > 1 and sum(sizes[each] for each in (*block, index)) > width:
            yield block
            block = [0]
        block.append(index)
    yield block


def text_table(columns: Sequence[Column], width: int | None = None, outside: Sequence[bool] = ()) -> Iterator[str]:
    """Yield the lines of a table: headings with units, numbers right-aligned under them.

    Parameters
    ----------
    columns : sequence of Column
        The columns.
    width : int, optional
        The width [characters]; a table that is too wide is cut into blocks, the first column repeated in each.
    outside : sequence of bool, optional
        Which rows are outside of what is judged; they end with a dagger.

    Yields
    ------
    str
        A line.
    """
    ends = ["", *dagger_ends(outside)]
    texts = [column_texts(column, values) for column, values in zip(columns, flat(columns), strict=True)]
    require(width is None or (is_whole(width) and width > 0), "width", width, "a number of characters is expected, such as 80")
    room = None if width is None else width - len(DAGGER) * any(outside)
    for number, block in enumerate(column_blocks([len(each.heading) for each in columns], texts, room)):
        if number:
            yield ""
        listed = [(columns[index].heading, *texts[index]) for index in block]
        sizes = [max(map(len, each)) for each in listed]
        for place, row in enumerate(zip(*listed, strict=True)):
            line = GAP.join(cell.rjust(size) for cell, size in zip(row, sizes, strict=True))
            yield line + ends[place] if place < len(ends) else line


DAGGER = " †"
"""What a row of a pose ends with that is not among those that are judged."""


def dagger_ends(outside: Sequence[bool]) -> list[str]:
    """Return the end of each row of a table, by whether it is outside the judged places."""
    return [DAGGER if each else "" for each in outside]


def dagger_words() -> str:
    """Return the explanation of a table's daggers, below it."""
    return said("† This pose is not among those that are judged.")


# Results as CSV (RFC 4180).

CHUNK = 10_000


FORMULA_STARTS = ("=", "+", "-", "@", "\t", "\r")
"""What a spreadsheet's formula begins with: an apostrophe goes before a heading that begins so."""


def joined_tables(tables: Sequence[tuple[str, Sequence[Column]]]) -> tuple[Sequence[Column], list[str]]:
    """Return tables of the same columns, each below a heading, as one, and the heading of each row; of one table no headings."""
    first = tables[0][1]
    if len(tables) == 1:
        return first, []
    joined = [replace(each, values=np.concatenate([np.ravel(one[k].values) for _, one in tables])) for k, each in enumerate(first)]
    return joined, [heading for heading, columns in tables for _ in range(max(np.size(each.values) for each in columns))]


def write_csv(
    columns: Sequence[Column], stream: TextIO, progress: Callable[[int, int], None] | None = None, labels: Sequence[str] = (),
    labelled: str = "run",
) -> None:  # fmt: skip
    """Write columns as CSV: a header with units, one row a pose, full precision, an empty field for NaN.

    Parameters
    ----------
    columns : sequence of Column
        The columns.
    stream : text file
        What is written to. Lines end with CR LF, so a file is to be opened with newline="".
    progress : callable, optional
        `progress(done, total)` hears of the rows written.
    labels : sequence of str, optional
        The first field of each row.
    labelled : str, optional
        The heading of these, "run" by default.
    """
    values = flat(columns)
    is_open = callable(getattr(stream, "write", None)) and not isinstance(stream, type)
    require(is_open, "", stream, 'is no open file; write into open("table.csv", "w", newline="")')
    total = len(values[0])
    writer = csv.writer(stream)
    headings = [*([labelled] if labels else []), *(column.heading for column in columns)]
    writer.writerow(f"'{each}" if each.startswith(FORMULA_STARTS) else each for each in headings)
    for start in range(0, total, CHUNK):
        rows = zip(*(each[start : start + CHUNK].tolist() for each in values), strict=True)
        led = [[label] for label in labels[start : start + CHUNK]] or [[]] * CHUNK
        texts = (["" if value != value else repr(value) for value in row] for row in rows)
        writer.writerows([*label, *row] for label, row in zip(led, texts, strict=False))
        if progress is not None:
            progress(min(start + CHUNK, total), total)
