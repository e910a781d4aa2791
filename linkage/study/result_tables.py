"""A search's results as tables: the designs that it looked at, and what varied, was sought and is kept, before and after."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import final

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

    `stage` says how closely they were looked at: "looked at" at few poses, or "searched", by a local search; `space` is what varied.
    NaN stands where a design cannot be assembled over the whole stroke.
    """

    stage: str
    space: Space
    combination: tuple[int, ...]
    unit: FloatArray
    value: FloatArray
    missing: FloatArray


def tried_names(space: Space) -> list[str]:
    """Return the names of what varies: the variables, then what the choices set."""
    return [*(each.name for each in space.variables), *(name for names in space.names for name in names)]


def heading_with_unit(named: tuple[str, str]) -> str:
    """Return a heading: `OB, mm`."""
    name, unit = named
    return f"{name}, {shown_in(unit)}" if unit else name


def tried_rows(plan: Plan | None, unit: str, tried: Sequence[EvaluatedDesigns]) -> Iterator[list[str | float]]:
    """Yield a row for each design: its stage, its dimensions and its objective in their units, and the part missing of a condition.

    Without a plan the dimensions are in SI.
    """
    space = tried[0].space
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


def result_cells(rows: Sequence[ResultRow], digits: str = "", of_gain: str = "") -> list[list[str]]:
    """Return headings and rows, their numbers with so many digits, ".6g", in full precision without; a number that is none is empty."""
    cells = [list(RESULT_HEADINGS)]
    for row in rows:
        numbers = ["" if np.isnan(value) else f"{float(value):{digits}}" for value in row.numbers]
        gain = [f"{100.0 * float(row.gain):{of_gain}}", row.by] if row.gain else ["", ""]
        cells.append([row.what, row.name, shown_in(row.unit), *numbers, *gain])
    return cells


def result_text(rows: Sequence[ResultRow]) -> str:
    """Return rows as aligned text; columns that hold nothing are left out."""
    cells = result_cells(rows, ".6g", ".2g")
    kept = [place for place in range(len(RESULT_HEADINGS)) if any(line[place] for line in cells[1:])]
    sizes = {place: max(len(line[place]) for line in cells) for place in kept}
    words = {0, 1, 2, 9}
    lines = (
        "  ".join(line[place].ljust(sizes[place]) if place in words else line[place].rjust(sizes[place]) for place in kept)
        for line in cells
    )
    return "\n".join(line.rstrip() for line in lines)
