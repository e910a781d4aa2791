"""One gas accumulator: a vessel and its charge."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, final

from linkage.loads.element import written

from .inputs import finite, positive
from .settings import follows


@final
@dataclass(frozen=True, eq=False)
class Accumulator:
    """A vessel of `volume` [m3] charged with gas to `charge` [Pa gauge], the fluid out, at the gas's temperature.

    Either may be an array: one design per element. In a class either may follow dimensions: `Accumulator(V_I, charge=P_I)`.
    DefinitionError for a volume not above zero.
    """

    volume: Any
    charge: Any

    def __post_init__(self) -> None:
        if not follows(self.volume):
            positive(self.volume, "Accumulator volume")
        if not follows(self.charge):
            finite(self.charge, "Accumulator charge")

    def __str__(self) -> str:
        return f"Accumulator(volume={written(self.volume)}, charge={written(self.charge)})"
