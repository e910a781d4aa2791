"""Results as CSV (RFC 4180)."""

from __future__ import annotations

import csv
from collections.abc import Callable, Sequence
from typing import TextIO

from ..errors import DefinitionError, cited
from ..motion import Column
from .table import flat

CHUNK = 10_000


def write_csv(columns: Sequence[Column], stream: TextIO, progress: Callable[[int, int], None] | None = None) -> None:
    """Write columns as CSV: a header with units, one row a pose, full precision, an empty field for NaN.

    Lines end with CR LF, so a file is to be opened with newline="". `progress(done, total)` hears of the rows written.
    """
    values = flat(columns)
    if not callable(getattr(stream, "write", None)) or isinstance(stream, type):
        raise DefinitionError(f'{cited(stream)} is no open file; write into open("table.csv", "w", newline="").')
    total = len(values[0])
    writer = csv.writer(stream)
    writer.writerow(column.heading for column in columns)
    for start in range(0, total, CHUNK):
        rows = zip(*(each[start : start + CHUNK].tolist() for each in values), strict=True)
        writer.writerows([["" if value != value else repr(value) for value in row] for row in rows])
        if progress is not None:
            progress(min(start + CHUNK, total), total)
