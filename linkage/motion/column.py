"""A column of results: a name, values over the poses, and the unit to show them in."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ..errors import DefinitionError, cited
from ..frozen import refuses_changes
from ..program import FloatArray
from ..units import UNITS, unit_or_none

NOISE = 1e-12
LEAST = 1e-9
"""A value that is smaller, compared with the greatest of its column or in the column's unit, is rounding noise."""


@refuses_changes
@dataclass(frozen=True, eq=False)
class Column:
    """Values in SI, shape (...), and the unit they are read in; a unit of "" is a plain number."""

    name: str
    values: FloatArray
    unit: str = ""
    digits: int = 4

    def __post_init__(self) -> None:
        if not isinstance(self.name, str) or not self.name:
            raise DefinitionError(f'Column({cited(self.name)}): its name is expected first, Column("pressure", values, "bar").')
        if not are_numbers(self.values):
            what = f"Column {self.name}: {cited(self.values)} holds no numbers"
            raise DefinitionError(f"{what}; give one for each pose, NaN where it has none.")
        unit_or_none(self.unit, where=f"the column {self.name}")

    @property
    def shown(self) -> FloatArray:
        """The values in the column's unit."""
        return np.asarray(self.values) / (UNITS[self.unit][0] if self.unit else 1.0)

    @property
    def drawn(self) -> FloatArray:
        """The values in the column's unit, rounding noise as zero: for pictures."""
        size = float(np.nanmax(np.abs(self.shown), initial=0.0))
        noise = max(NOISE * size, LEAST if self.unit else 0.0)
        return np.where(np.abs(self.shown) < noise, 0.0, self.shown)

    @property
    def heading(self) -> str:
        """The name with its unit: `pd, kgf/cm2`."""
        return f"{self.name}, {self.unit}" if self.unit else self.name


def are_numbers(values: Any) -> bool:
    """Return whether values are real numbers or truth values, all of them known."""
    try:
        return np.asarray(values).dtype.kind in "fiub" and not np.ma.is_masked(values)
    except ValueError:
        return False
