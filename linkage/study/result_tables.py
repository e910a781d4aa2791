"""A search's results as tables: the designs that it looked at, and what varied, was sought and is kept, before and after."""

from __future__ import annotations

import csv
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TextIO, final

import numpy as np

from ..plan import Plan
from ..program import FloatArray
from ..units import factor, shown_in
from .checks import unit_of
from .space import Space


@final
@dataclass(frozen=True, eq=False)
class EvaluatedDesigns:
    """Designs of one combination of choices: unit coordinates (m, n), the objective (m,) [SI], and the part missing of a condition (m,).

    `stage` says how closely they were looked at: "looked at" at few poses, or "searched", the end of a local search. NaN stands where a
    design cannot be assembled over the whole stroke.
    """

    stage: str
    combination: tuple[int, ...]
    unit: FloatArray
    value: FloatArray
    missing: FloatArray


def tried_names(space: Space) -> list[str]:
    """Return the names of what varies: the variables, then what the choices set."""
    return [*(each.name for each in space.variables), *(name for names in space.names for name in names)]


def tried_header(space: Space, plan: Plan, objective: str, unit: str) -> list[str]:
    """Return the headings of the columns, with units."""
    units = [(name, unit_of(plan, name)) for name in tried_names(space)]
    return ["stage", *map(heading_with_unit, (*units, (objective, unit))), "missing"]


def heading_with_unit(named: tuple[str, str]) -> str:
    """Return a heading: `OB, mm`."""
    name, unit = named
    return f"{name}, {shown_in(unit)}" if unit else name


def tried_rows(space: Space, plan: Plan | None, unit: str, tried: Sequence[EvaluatedDesigns]) -> Iterator[list[str | float]]:
    """Yield a row for each design: its stage, its dimensions and its objective in their units, and the part missing of a condition.

    Without a plan the dimensions are in SI.
    """
    factors = [1.0 if plan is None else factor(shown_in(unit_of(plan, name))) for name in tried_names(space)]
    for part in tried:
        chosen = [value for (_, rows), row in zip(space.choices, part.combination, strict=True) for value in rows[row]]
        values = space.values(part.unit).tolist()
        for own, value, missing in zip(values, part.value.tolist(), part.missing.tolist(), strict=True):
            settings = [each / size for each, size in zip((*own, *chosen), factors, strict=True)]
            yield [part.stage, *settings, value / factor(shown_in(unit)), missing]


# What varied, what was sought and what must be kept, before and after.

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
