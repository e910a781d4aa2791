"""Figure 2: the zones of capacity and tilt over the admissible settings."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from linkage import Column, Mechanism
from linkage.language import noted, said
from linkage.mechanism import require_mechanism
from linkage.study import Settings, Zone, settings_for, zone
from linkage.units import show, shown_number

from .capacity import from_stroke_per_newton, stroke_per_newton


def admissible(hitch: Mechanism) -> Mapping[str, Any]:
    """Return the settings that its class admits."""
    found: Mapping[str, Any] = type(hitch).__dict__.get("admissible") or getattr(hitch, "admissible", {})
    return found


def tilt_zone(hitch: Mechanism, over: Mapping[str, Any] | None = None, **strokes: Any) -> Zone:
    """Return the least and the greatest tilt [rad] over the admissible settings at every stroke, or over others."""
    return zone(hitch, "tilt", admissible(hitch) if over is None else over, **strokes)


def capacity_zone(hitch: Mechanism, over: Mapping[str, Any] | None = None, **strokes: Any) -> Zone:
    """Return the least and the greatest capacity [N] over the admissible settings at every stroke, or over others.

    `low` is NaN where no setting is limited by the cylinder; `high` where some setting is not, which is then a remark.
    """
    found = zone(hitch, stroke_per_newton, admissible(hitch) if over is None else over, **strokes)
    low, high = from_stroke_per_newton(found.high), from_stroke_per_newton(found.low)
    free = int(np.sum(found.low <= 0.0))
    more = (f"At {free} of {found.low.size} strokes some settings are not limited by this cylinder: the zone has no upper end there.",)
    return replace(
        found, quantity="capacity", low=low, high=high, low_at=found.high_at, high_at=found.low_at,
        remarks=found.remarks + (more if free else ()),
    )  # fmt: skip


def zone_columns(capacity: Zone, tilt: Zone) -> list[Column]:
    """Return both zones as a table over the stroke."""
    return [
        Column("S", capacity.strokes["S"], "mm", 1),
        Column(noted("capacity_min"), capacity.low, "kN", 2),
        Column(noted("capacity_max"), capacity.high, "kN", 2),
        Column(noted("tilt_min"), tilt.low, "deg", 3),
        Column(noted("tilt_max"), tilt.high, "deg", 3),
        Column(noted("assembled"), tilt.reached, "", 3),
    ]


# The setting of the upper link that makes the mast stand upright.

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
    if not apart:
        return found.sentence
    admitted = said("That is outside the admissible {low} to {high}.", low=shown_number(low, "mm", ".0f"), high=show(high, "mm", ".0f"))
    return f"{found.sentence} {admitted}"
