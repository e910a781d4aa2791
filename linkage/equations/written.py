"""A line of the listing: what stands for what."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from .printing import Text
from .units import Unit


@dataclass(frozen=True, eq=False)
class Written:
    """One line: a symbol, what it equals, and what it measures."""

    lhs: Any
    rhs: Any
    unit: Unit

    @property
    def name(self) -> str:
        """The text of the left side."""
        return str(Text().doprint(self.lhs))
