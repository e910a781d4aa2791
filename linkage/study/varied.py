"""A dimension that a search varies."""

from __future__ import annotations

from dataclasses import dataclass
from typing import final

import numpy as np

from ..units import show


@final
@dataclass(frozen=True)
class Varied:
    """A dimension that varies between two values [SI], in steps where `step` is given; `sign` that of its spelling."""

    name: str
    owner: str
    sign: float
    low: float
    high: float
    step: float | None
    unit: str

    @property
    def span(self) -> float:
        """High less low."""
        return self.high - self.low

    @property
    def steps(self) -> int:
        """How many steps the range has; one of a range without."""
        return 1 if self.step is None else int(np.floor(self.span / self.step + 1e-9)) + 1

    def stepped(self, value: float) -> tuple[float, ...]:
        """Return the one or two steps about a value."""
        if self.step is None:
            return (value,)
        place = (value - self.low) / self.step
        last = self.steps - 1
        near = {int(np.clip(part, 0, last)) for part in (np.floor(place + 1e-9), np.ceil(place - 1e-9))}
        return tuple(self.low + self.step * each for each in sorted(near))

    def show(self, value: float) -> str:
        """Return a value with its unit."""
        return show(value, self.unit)
