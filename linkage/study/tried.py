"""The designs that a search looked at, as a table: what each is worth, and what it misses of the conditions."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import final

from ..plan import Plan
from ..program import FloatArray
from ..units import factor, shown_in
from .checks import unit_of
from .space import Space


@final
@dataclass(frozen=True, eq=False)
class Tried:
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


def tried_rows(space: Space, plan: Plan | None, unit: str, tried: Sequence[Tried]) -> Iterator[list[str | float]]:
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
