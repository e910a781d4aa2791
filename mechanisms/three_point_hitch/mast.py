"""The setting of the upper link that makes the mast stand upright."""

from __future__ import annotations

from linkage import Mechanism
from linkage.mechanism import require_mechanism
from linkage.study import Settings, settings_for
from linkage.units import mm

from .zones import admissible

WIDE = (0.3, 3.0)
"""How far is looked, as multiples of the upper link's length."""


def vertical_mast(hitch: Mechanism, S: float, between: tuple[float, float] | None = None) -> Settings:
    """Return every length of the upper link MK [m] that makes the mast vertical at a stroke [m], or why there is none.

    Without a range it looks from 0.3 to 3 times MK.
    """
    require_mechanism(hitch)
    wide = between if between is not None else (WIDE[0] * hitch["MK"], WIDE[1] * hitch["MK"])
    return settings_for(hitch, "MK", "tilt", 0.0, between=wide, unit="deg", S=S)


def mast_words(hitch: Mechanism, S: float) -> str:
    """Return the upper link for a vertical mast at a stroke [m] in words, and whether its admissible range holds it."""
    found, (low, high) = vertical_mast(hitch, S), admissible(hitch).get("MK", (0.0, float("inf")))
    apart = [value for value in found.values if not low <= value <= high]
    range_words = f" That is outside the admissible {low / mm:.0f} to {high / mm:.0f} mm."
    return found.sentence + (range_words if apart else "")
