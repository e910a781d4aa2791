"""Several gas charges on one line: the exact piecewise law. Every pressure in this file is absolute [Pa].

A vessel of volume 0 is absent: it adds nothing to any sum, and its charge is not looked at.

A gas of charge p_i fills its vessel V_i up to that pressure; above it, it holds V_i v(p)/v(p_i), v being the specific
volume of the gas law. Between two charges the sum is (amount) v(p) + (idle volume), so its inverse is closed form
for any gas law. Source: Rekhlitski, Chuprynin (2013), (17)-(33), for any number of charges.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import reduce
from typing import final

import numpy as np

from .gas import Gas
from .inputs import Array, is_traced


@final
@dataclass(frozen=True, eq=False)
class GasBank:
    """Gas charges [Pa absolute] in vessels [m3], one of each per gas; a charge or volume may be an array over designs."""

    gas: Gas
    charges: tuple[Array, ...]
    vessels: tuple[Array, ...]

    @property
    def total(self) -> Array:
        """The gas volume with no fluid in, m3: the vessels."""
        total: Array = reduce(np.add, self.vessels)
        return total

    @property
    def lowest(self) -> Array:
        """The lowest charge of the vessels that are there, Pa: below it the bank holds no fluid."""
        highest = reduce(np.maximum, self.charges)
        lowest: Array = reduce(np.minimum, (np.where(vessel > 0.0, charge, highest) for charge, vessel in self))
        return lowest

    def __iter__(self) -> Iterator[tuple[Array, Array]]:
        """Yield the charge [Pa] and the vessel [m3] of each gas."""
        return zip(self.charges, self.vessels, strict=True)

    def shares(self, pressure: Array) -> list[Array]:
        """Return the share of its vessel that each gas has at a pressure [Pa]; each of its shape."""
        return [self.gas.specific(np.maximum(pressure, charge)) / self.gas.specific(charge) for charge in self.charges]

    def volume(self, pressure: Array) -> Array:
        """Return the gas volume of the bank [m3] at a pressure [Pa], same shape."""
        # in the order of `total`: equal to it, not nearly, with no fluid in
        volume: Array = reduce(np.add, (vessel * share for vessel, share in zip(self.vessels, self.shares(pressure), strict=True)))
        return volume

    def pressure(self, volume: Array) -> Array:
        """Return the pressure [Pa] at a gas volume [m3] above zero and not above `total`, same shape; the inverse of `volume`."""
        amount, idle = self._pieces(volume)
        return self.gas.pressure_of((volume - idle) / amount)

    def stiffness(self, volume: Array) -> Array:
        """Return -dp/dV [Pa/m3] at a gas volume [m3], same shape; where a gas joins, with it."""
        amount, idle = self._pieces(volume)
        return -1.0 / (amount * self.gas.slope(self.gas.pressure_of((volume - idle) / amount)))

    def _pieces(self, volume: Array) -> tuple[Array, Array]:
        """Return the amount of gas at work and the volume of the idle vessels [m3] at a gas volume of the bank [m3]."""
        amount = idle = np.zeros_like(volume)
        for charge, vessel in self:
            works = volume <= self.volume(charge)
            amount = amount + np.where(works, vessel / self.gas.specific(charge), 0.0)
            idle = idle + np.where(works, 0.0, vessel)
        return amount, idle


def effective(charges: Sequence[Array], vessels: Sequence[Array]) -> tuple[Array, ...]:
    """Return the charges [Pa], that of an absent vessel exchanged for one of the others: whatever it is, no gas has it.

    A number that is traced keeps its own charge where there can be a gas of it: what a vessel would add has that slope.
    """
    other = reduce(np.maximum, (np.where(vessel > 0.0, charge, 0.0) for charge, vessel in zip(charges, vessels, strict=True)))
    found = []
    for charge, vessel in zip(charges, vessels, strict=True):
        absent = vessel <= 0.0
        if is_traced(vessel):
            absent = absent & (charge <= 0.0)
        found.append(np.where(absent, other, charge) if is_traced(vessel) or np.any(absent) else charge)
    return tuple(found)
