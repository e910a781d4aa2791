"""Results as tables for a terminal."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from ..motion import Column
from .table import blocks, cells, checked_width, flat

if TYPE_CHECKING:
    from rich.table import Table

PADDING = 3  # characters that rich puts between the texts of two columns


def rich_tables(columns: Sequence[Column], width: int | None = None) -> Iterator[Table]:
    """Yield tables for rich's console; more than one where all columns do not fit `width` [characters]."""
    from rich.box import SIMPLE_HEAD
    from rich.table import Table

    texts = [cells(column, values) for column, values in zip(columns, flat(columns), strict=True)]
    room = checked_width(width)
    for block in blocks(columns, texts, None if room is None else room + 1, PADDING):
        table = Table(box=SIMPLE_HEAD, header_style="bold", show_edge=False)
        for index in block:
            table.add_column(columns[index].heading, justify="right", no_wrap=True)
        for row in zip(*(texts[index] for index in block), strict=True):
            table.add_row(*row)
        yield table
