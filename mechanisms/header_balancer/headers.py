"""The three headers: mass and charge pressure as published, an illustrative geometry."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from linkage.units import deg, kgf_cm2


def _header(mass: float, charge: float, L_OR: float, BOR: float, OG2: float, BOG2: float) -> Mapping[str, float]:
    return MappingProxyType(
        {"m2": mass, "charge": charge * kgf_cm2, "L_OR": L_OR, "BOR": BOR * deg, "OG2": OG2, "BOG2": BOG2 * deg}
    )  # fmt: skip


HEADERS: Mapping[int, Mapping[str, float]] = MappingProxyType(
    {
        1: _header(2000.0, 94.0, 2.665521, 13.055247, 2.137161, 28.184398),  # both gas charges at work
        2: _header(1000.0, 34.0, 2.040833, 5.290081, 1.436851, 18.840343),   # the 50 kgf/cm2 pair is off: a softer system
        3: _header(1500.0, 50.0, 1.998124, 4.552408, 1.421442, 19.909792),   # a kink where the second pair joins
    }
)  # fmt: skip
"""Mass and charge pressure as published; the geometry is illustrative, such that criterion 2 gives these pressures."""
