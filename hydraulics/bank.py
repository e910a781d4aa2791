"""Several gas charges on one line: the exact piecewise law. Every pressure in this file is absolute [Pa].

A gas of charge p_i fills its vessel V_i up to that pressure; above it, it holds V_i v(p)/v(p_i), v being the specific
volume of the gas law. Between two charges the sum is (amount) v(p) + (idle volume), so its inverse is closed form
for any gas law. Source: Rekhlitski, Chuprynin (2013), (17)-(33), for any number of charges.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import reduce
from typing import final

import numpy as np

from .gas import Gas
from .inputs import Array


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
        """The lowest charge, Pa: below it the bank holds no fluid."""
        lowest: Array = reduce(np.minimum, self.charges)
        return lowest

    def volumes(self, pressure: Array) -> list[Array]:
        """Return the volume of each gas [m3] at a pressure [Pa]; each of its shape."""
        gas = self.gas
        return [
            vessel * (gas.specific(np.maximum(pressure, charge)) / gas.specific(charge))
            for charge, vessel in zip(self.charges, self.vessels, strict=True)
        ]

    def volume(self, pressure: Array) -> Array:
        """Return the gas volume of the bank [m3] at a pressure [Pa], same shape."""
        volume: Array = reduce(np.add, self.volumes(pressure))  # in the order of `total`: equal to it, not nearly, with no fluid in
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
        for charge, vessel in zip(self.charges, self.vessels, strict=True):
            works = volume <= self.volume(charge)
            amount = amount + np.where(works, vessel / self.gas.specific(charge), 0.0)
            idle = idle + np.where(works, 0.0, vessel)
        return amount, idle
