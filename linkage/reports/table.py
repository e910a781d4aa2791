"""Results as aligned plain text."""

from __future__ import annotations

import csv
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from math import floor, isfinite, log10
from typing import TextIO

import numpy as np

from ..errors import is_listed, of_one_shape, require
from ..language import said
from ..motion import Column
from ..program import FloatArray
from ..quantities import is_whole

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
