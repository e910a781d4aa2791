"""A column of results: a name, values over the poses, and the unit to show them in."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..frozen import refuses_changes
from ..program import FloatArray
from ..units import UNITS

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
