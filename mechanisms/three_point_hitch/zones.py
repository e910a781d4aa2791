"""Figure 2: the zones of capacity and tilt over the admissible settings."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from linkage import Column, Mechanism
from linkage.study import Zone, zone

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
        Column("capacity_min", capacity.low, "kN", 2),
        Column("capacity_max", capacity.high, "kN", 2),
        Column("tilt_min", tilt.low, "deg", 3),
        Column("tilt_max", tilt.high, "deg", 3),
        Column("assembled", tilt.reached, "", 3),
    ]
