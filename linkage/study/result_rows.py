"""A search's result as rows: what varied, what was sought and what must be kept, before and after, and what limits it."""

from __future__ import annotations

import csv
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TextIO, final

import numpy as np

from ..units import factor, shown_in

RESULT_HEADINGS = ("what", "name", "unit", "before", "after", "rounded", "limit", "to spare", "gain, %", "for")

ROUNDED_TO_NOTHING = 1e-9
"""Of a condition's size: less to spare than this is nothing."""


@final
@dataclass(frozen=True)
class ResultRow:
    """A number before and after a search [SI], and what more of it would give: `gain` is a part of the objective, `by` for how much less.

    NaN stands where there is no such number. `unit` is that in which the numbers are shown.
    """

    what: str
    name: str
    unit: str
    before: float
    after: float
    rounded: float = float("nan")
    limit: float = float("nan")
    spare: float = float("nan")
    gain: float = 0.0
    by: str = ""

    @property
    def numbers(self) -> tuple[float, ...]:
        """The numbers in the unit that the row is shown in."""
        is_met = abs(self.spare) <= ROUNDED_TO_NOTHING * max(abs(self.after), abs(self.limit))
        spare = 0.0 if is_met else self.spare
        return tuple(each / factor(shown_in(self.unit)) for each in (self.before, self.after, self.rounded, self.limit, spare))


def result_text(rows: Sequence[ResultRow]) -> str:
    """Return rows as aligned text; columns that hold nothing are left out."""
    cells = [list(RESULT_HEADINGS)]
    for row in rows:
        numbers = ["" if np.isnan(value) else f"{value:.6g}" for value in row.numbers]
        gain = [f"{100.0 * row.gain:.2g}", row.by] if row.gain else ["", ""]
        cells.append([row.what, row.name, shown_in(row.unit), *numbers, *gain])
    kept = [place for place in range(len(RESULT_HEADINGS)) if any(line[place] for line in cells[1:])]
    sizes = {place: max(len(line[place]) for line in cells) for place in kept}
    words = {0, 1, 2, 9}
    lines = (
        "  ".join(line[place].ljust(sizes[place]) if place in words else line[place].rjust(sizes[place]) for place in kept)
        for line in cells
    )
    return "\n".join(line.rstrip() for line in lines)


def write_result(rows: Sequence[ResultRow], stream: TextIO) -> None:
    """Write rows as CSV in full precision, an empty field where there is no number."""
    writer = csv.writer(stream)
    writer.writerow(RESULT_HEADINGS)
    for row in rows:
        numbers = ["" if np.isnan(value) else repr(float(value)) for value in row.numbers]
        gain = [repr(100.0 * float(row.gain)), row.by] if row.gain else ["", ""]
        writer.writerow([row.what, row.name, shown_in(row.unit), *numbers, *gain])
