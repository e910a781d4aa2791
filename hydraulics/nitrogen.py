"""Nitrogen as it is: a short real-gas equation of state. Every pressure in this file is absolute [Pa].

    p = rho R T Z,   Z = 1 + sum of c x^i tau^j,   x = rho / (10 mol/l),   tau = 300 K / T

Twelve terms, fitted to the reference equation of Span, Lemmon, Jacobsen, Wagner and Yokozeki (J. Phys. Chem. Ref.
Data 29 (2000) 1361), whose own uncertainty in density is 2e-4. Range 245 to 340 K, up to 500 bar. Largest deviation
there: 4e-5 of the pressure at a density and of the volume at a pressure, 5e-5 of a charge brought to another
temperature, 0.5 % of the isentropic exponent.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import final

import numpy as np
from numpy.typing import ArrayLike

from linkage.errors import DefinitionError
from linkage.frozen import refuses_changes
from linkage.program import is_traced
from linkage.quantities.quantity import plain
from linkage.units import bar

from .gas import ROOM, Gas
from .inputs import Array, kelvin, positive

R = 8.314462618  # J/(mol K)
HIGHEST = 500 * bar
COLDEST, HOTTEST = 245.0, 340.0  # K
DENSITY = 1e4  # mol/m3: the unit of x
DENSEST = 2.0  # of x: beyond HIGHEST at every temperature of the range, and p still grows there

TERMS = (  # i, j, c
    (1, 0, 0.399282), (1, 1, -0.288547), (1, 2, -0.185229), (1, 3, 0.028968),
    (2, 0, 0.110722), (2, 2, 0.027218),
    (3, 0, 0.030022), (3, 2, -0.041957), (3, 3, 0.030482),
    (4, 1, 0.030632), (4, 3, -0.023175),
    (5, 3, 0.005712),
)  # fmt: skip


@final
@refuses_changes
@dataclass(frozen=True, eq=False)
class RealNitrogen(Gas):
    """Real nitrogen kept at one temperature (a slow change); see the file's head for source, range and error."""

    temperature: float = ROOM

    def __post_init__(self) -> None:
        kelvin(self.temperature, "Temperature of real_nitrogen", COLDEST, HOTTEST)

    def __str__(self) -> str:
        return f"real nitrogen at {self.temperature:.2f} K"

    @property
    def spelled(self) -> str:
        return f"real_nitrogen({'' if self.temperature == ROOM else repr(plain(self.temperature))})"

    def specific(self, pressure: Array) -> Array:
        """Return the molar volume [m3/mol] at an absolute pressure [Pa], same shape; DefinitionError above 500 bar."""
        return 1.0 / (DENSITY * _density(_in_range(pressure), self.temperature))

    def pressure_of(self, specific: Array) -> Array:
        """Return the absolute pressure [Pa] at a molar volume [m3/mol], same shape; DefinitionError above 500 bar."""
        return _pressure(1.0 / (DENSITY * specific), self.temperature)

    def slope(self, pressure: Array) -> Array:
        x = _density(_in_range(pressure), self.temperature)
        return -1.0 / ((DENSITY * x) ** 2 * _stiffness(x, self.temperature))

    def charge_at(self, charge: ArrayLike, temperature: ArrayLike) -> Array:
        x = _density(_in_range(positive(charge, "Charge pressure")), self.temperature)
        return _pressure(x, kelvin(temperature, "Temperature of real_nitrogen", COLDEST, HOTTEST))

    def at(self, temperature: float) -> RealNitrogen:
        return RealNitrogen(temperature)

    def fast_exponent(self, pressure: ArrayLike) -> Array:
        """Return the isentropic exponent (rho/p) (dp/drho)_s at an absolute pressure [Pa], same shape: 1.4 at 1 bar, 1.9 at 200 bar."""
        p, T = _in_range(positive(pressure, "Gas pressure")), self.temperature
        x = _density(p, T)
        heating = 1.0 + _sum(x, T, lambda i, j: 1.0 - j)  # (dp/dT) / (rho R)
        capacity = 2.5 - _sum(x, T, lambda i, j: j * (j - 1.0) / i)  # cv / R
        return DENSITY * x / p * (_stiffness(x, T) + R * T * heating**2 / capacity)


def real_nitrogen(temperature: float = ROOM) -> RealNitrogen:
    """Return nitrogen as a real gas at a temperature [K]; DefinitionError outside 245..340 K."""
    return RealNitrogen(temperature)


def _sum(x: Array, T: float | Array, weight: Callable[[int, int], float]) -> Array:
    """Return the sum of weight(i, j) c x^i tau^j over the terms."""
    virial: list[float | Array] = [0.0] * 6
    for i, j, c in TERMS:
        virial[i] = virial[i] + weight(i, j) * c * (300.0 / T) ** j
    total = np.zeros_like(x)
    for coefficient in reversed(virial):
        total = total * x + coefficient
    return total


def _pressure(x: Array, T: float | Array) -> Array:
    """Return the absolute pressure [Pa] at a density; DefinitionError above the range."""
    x = np.minimum(x, DENSEST)
    return _in_range(DENSITY * x * R * T * (1.0 + _sum(x, T, lambda i, j: 1.0)))


def _stiffness(x: Array, T: float) -> Array:
    """Return (dp/drho)_T [Pa m3/mol]."""
    return R * T * (1.0 + _sum(x, T, lambda i, j: 1.0 + i))


def _density(pressure: Array, T: float) -> Array:
    """Return the density x at a pressure, by Newton's method kept inside a bracket, to the last digits."""
    if is_traced(pressure):
        raise DefinitionError("real_nitrogen finds its density by iteration; isothermal and polytropic gases have exact derivatives.")
    target = pressure / (DENSITY * R * T)
    low = 0.0 * target  # NaN where the target is: an unreached pose stays one
    high = low + DENSEST
    x = np.minimum(target, DENSEST)
    for _ in range(60):
        excess = x * (1.0 + _sum(x, T, lambda i, j: 1.0)) - target
        low, high = np.where(excess <= 0.0, x, low), np.where(excess > 0.0, x, high)
        step = x - excess * R * T / _stiffness(x, T)
        step = np.where((step >= low) & (step <= high), step, 0.5 * (low + high))
        moved, x = np.any(np.abs(step - x) > 1e-15 * x), step
        if not moved:
            break
    return x


def _in_range(pressure: Array) -> Array:
    """Return the absolute pressure [Pa]; DefinitionError above the range of the equation."""
    if np.any(pressure > HIGHEST * (1.0 + 1e-9)):  # a last digit lost on the way back from a volume is not an error
        raise DefinitionError(
            f"real_nitrogen holds up to {HIGHEST / bar:g} bar absolute, and more was asked; "
            "lower the pressure or the volume pushed in, or take isothermal."
        )
    return pressure
