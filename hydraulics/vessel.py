"""One gas accumulator: a vessel and its charge."""

from __future__ import annotations

from copy import copy
from dataclasses import dataclass
from typing import Any, final

import numpy as np

from linkage.errors import DefinitionError
from linkage.frozen import keep_own, refuses_changes
from linkage.loads.element import value_text

from .inputs import finite, in_pascals, not_negative
from .settings import follows

VOLUME = ("Accumulator volume", "give 0 for a vessel that is absent")
LARGEST = 10.0
"""m3; the volume of a larger accumulator was given in litres."""
CHARGE = "Accumulator charge"


@final
@refuses_changes
@dataclass(frozen=True, eq=False)
class Accumulator:
    """A vessel of `volume` [m3] charged with gas to `charge` [Pa gauge], the fluid out, at the gas's temperature.

    Either may be an array: one design per element. In a class either may follow dimensions: `Accumulator(V_I, charge=P_I)`.
    A volume of 0 is an absent vessel: the block is that of the others. DefinitionError for a negative volume.
    """

    volume: Any
    charge: Any

    def __post_init__(self) -> None:
        keep_own(self)
        volume = np.ones(()) if follows(self.volume) else not_negative(self.volume, *VOLUME)
        if np.any(volume > LARGEST):
            large = f"{np.max(volume):.6g}"
            raise DefinitionError(f"{VOLUME[0]} = {large} m3 is more than any has; write {large} * litre if these are litres.")
        if not follows(self.charge):
            in_pascals(np.where(volume > 0.0, finite(self.charge, CHARGE), 0.0), CHARGE)

    def recharged(self, charge: Any) -> Accumulator:
        """Return the same vessel with another charge [Pa gauge], one that a gas law gives."""
        changed = copy(self)
        object.__setattr__(changed, "charge", charge)
        return changed

    def __str__(self) -> str:
        return f"Accumulator(volume={value_text(self.volume)}, charge={value_text(self.charge)})"
