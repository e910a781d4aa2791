"""Results as aligned plain text."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from ..errors import DefinitionError, cited
from ..motion import Column
from ..program import FloatArray
from ..quantities import is_whole

GAP = "  "
NOTHING = "-"  # stands for NaN: not reached, or not limited


def flat(columns: Sequence[Column]) -> list[FloatArray]:
    """Return the columns' values in their units, one row a pose: broadcast to one shape, the designs outermost."""
    if not isinstance(columns, (list, tuple)) or not columns or not all(isinstance(each, Column) for each in columns):
        raise DefinitionError(f"{cited(columns)} is no table; give a list of columns, such as machine.columns(motion).")
    try:
        return [each.ravel() for each in np.broadcast_arrays(*(column.shown for column in columns))]
    except ValueError:
        shapes = ", ".join(f"{column.name} {np.shape(column.values)}" for column in columns)
        raise DefinitionError(f"The columns' shapes do not fit each other: {shapes}.") from None


def cells(column: Column, values: FloatArray) -> list[str]:
    """Return a column's numbers as text, with its number of decimals."""
    return [NOTHING if np.isnan(value) else f"{value:z.{column.digits}f}" for value in values.tolist()]


def checked_width(width: int | None) -> int | None:
    """Return a width; DefinitionError unless it is a number of characters, or none."""
    if width is not None and not (is_whole(width) and width > 0):
        raise DefinitionError(f"width={cited(width)}: a number of characters is expected, such as 80.")
    return width


def blocks(columns: Sequence[Column], texts: Sequence[Sequence[str]], width: int | None, edge: int) -> Iterator[list[int]]:
    """Yield the indices of the columns that stand beside each other in `width` characters; the first leads every block.

    `edge` is the space that a column takes beside its own text. Without a width all stand beside each other.
    """
    sizes = [edge + max(map(len, (column.heading, *text))) for column, text in zip(columns, texts, strict=True)]
    block = [0]
    for index in range(1, len(columns)):
        if width is not None and len(block) > 1 and sum(sizes[each] for each in (*block, index)) > width:
            yield block
            block = [0]
        block.append(index)
    yield block


def text_table(columns: Sequence[Column], width: int | None = None) -> Iterator[str]:
    """Yield the lines of a table: headings with units, numbers right-aligned under them.

    With a `width` [characters] a table that is too wide is cut into blocks, the first column repeated in each.
    """
    texts = [cells(column, values) for column, values in zip(columns, flat(columns), strict=True)]
    for number, block in enumerate(blocks(columns, texts, checked_width(width), len(GAP))):
        if number:
            yield ""
        yield from _lines([columns[index].heading for index in block], [texts[index] for index in block])


def _lines(headings: Sequence[str], texts: Sequence[Sequence[str]]) -> Iterator[str]:
    sizes = [max(map(len, (heading, *text))) for heading, text in zip(headings, texts, strict=True)]
    yield GAP.join(heading.rjust(size) for heading, size in zip(headings, sizes, strict=True))
    for row in zip(*texts, strict=True):
        yield GAP.join(cell.rjust(size) for cell, size in zip(row, sizes, strict=True))
