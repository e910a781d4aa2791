"""What a closed amount of gas does: its volume and its pressure. Every pressure in this file is absolute [Pa].

>>> from linkage.units import bar, litre
>>> print(isothermal, "|", adiabatic, "|", polytropic(1.25))
isothermal gas (p V = const) | polytropic gas (p V^1.4 = const) | polytropic gas (p V^1.25 = const)
>>> print(f"{isothermal.volume(100 * bar, p0=50 * bar, V0=4 * litre) / litre:.3f}")
2.000
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import final

import numpy as np
from numpy.typing import ArrayLike

from linkage.errors import DefinitionError
from linkage.frozen import refuses_changes
from linkage.quantities.quantity import plain

from .inputs import Array, all_finite, kelvin, positive

ROOM = 293.15
"""The temperature at which charges are stated unless a gas says otherwise, K."""

DIATOMIC = 1.4
"""The ratio of heat capacities of an ideal diatomic gas: air, nitrogen."""


class Gas(ABC):
    """A gas law. A subclass gives the specific volume, its inverse and its slope; everything else follows.

    The unit of the specific volume is the law's own: only ratios of it are used.
    """

    temperature: float
    """K; the charges of accumulators are stated at it."""

    @property
    def spelled(self) -> str:
        """The law as it is written in a class."""
        return repr(self)

    @abstractmethod
    def specific(self, pressure: Array) -> Array:
        """Return the specific volume at an absolute pressure [Pa], same shape; it falls as the pressure grows."""

    @abstractmethod
    def pressure_of(self, specific: Array) -> Array:
        """Return the absolute pressure [Pa] at a specific volume, same shape: the inverse of `specific`."""

    @abstractmethod
    def slope(self, pressure: Array) -> Array:
        """Return d(specific)/dp at an absolute pressure [Pa], same shape; negative."""

    @abstractmethod
    def charge_at(self, charge: ArrayLike, temperature: ArrayLike) -> Array:
        """Return the absolute pressure [Pa] at a temperature [K] of the gas that has `charge` [Pa] at `self.temperature`.

        The volume stays. The two broadcast. DefinitionError for a temperature that is not in kelvin.
        """

    @abstractmethod
    def at(self, temperature: float) -> Gas:
        """Return the same law at another temperature [K]."""

    @abstractmethod
    def fast_exponent(self, pressure: ArrayLike) -> Array:
        """Return n of p V^n = const for a change too fast for heat, about an absolute pressure [Pa], same shape."""

    def volume(self, pressure: ArrayLike, p0: ArrayLike, V0: ArrayLike) -> Array:
        """Return the volume [m3] at an absolute pressure of the gas that fills V0 [m3] at p0 [Pa]; the three broadcast.

        DefinitionError for a pressure or a volume that is not above zero.
        """
        ratio = self.specific(positive(pressure, "Gas pressure")) / self.specific(positive(p0, "Charge pressure"))
        return positive(V0, "Charge volume") * ratio

    def pressure(self, volume: ArrayLike, p0: ArrayLike, V0: ArrayLike) -> Array:
        """Return the absolute pressure [Pa] in a volume [m3] of the gas that fills V0 [m3] at p0 [Pa]: inverts `volume`.

        DefinitionError for a pressure or a volume that is not above zero.
        """
        ratio = positive(volume, "Gas volume") / positive(V0, "Charge volume")
        return self.pressure_of(self.specific(positive(p0, "Charge pressure")) * ratio)


@final
@refuses_changes
@dataclass(frozen=True, eq=False)
class Polytropic(Gas):
    """Ideal gas with p V^n = const: n = 1 is isothermal (slow), n = 1.4 adiabatic (fast). `n` may be an array over states."""

    n: float | Array = 1.0
    temperature: float = ROOM

    def __post_init__(self) -> None:
        n = all_finite(self.n, "Polytropic exponent")
        outside = (n < 1.0) | (n > 10.0)
        if np.any(outside):
            raise DefinitionError(f"Polytropic exponent n = {n[outside][0]:.6g} is outside 1..10; 1 is isothermal, 1.4 adiabatic.")
        kelvin(self.temperature, "Gas temperature")

    def __str__(self) -> str:
        if np.ndim(self.n):
            return f"polytropic gas (p V^n = const, n = {np.min(self.n):.4g}..{np.max(self.n):.4g})"
        return "isothermal gas (p V = const)" if self.n == 1.0 else f"polytropic gas (p V^{self.n:.4g} = const)"

    @property
    def spelled(self) -> str:
        if self.temperature != ROOM:
            return f"polytropic({plain(self.n)!r}, temperature={plain(self.temperature)!r})"
        known = {1.0: "isothermal", DIATOMIC: "adiabatic"}
        name = "" if np.ndim(self.n) else known.get(float(self.n), "")
        return name or f"polytropic({plain(self.n)!r})"

    def specific(self, pressure: Array) -> Array:
        return pressure ** (-1.0 / self.n)

    def pressure_of(self, specific: Array) -> Array:
        return specific**-self.n

    def slope(self, pressure: Array) -> Array:
        return -self.specific(pressure) / (self.n * pressure)

    def charge_at(self, charge: ArrayLike, temperature: ArrayLike) -> Array:
        return positive(charge, "Charge pressure") * kelvin(temperature, "Gas temperature") / self.temperature

    def at(self, temperature: float) -> Polytropic:
        return Polytropic(self.n, temperature)

    def fast_exponent(self, pressure: ArrayLike) -> Array:
        return np.full_like(positive(pressure, "Gas pressure"), DIATOMIC)


def polytropic(n: float, temperature: float = ROOM) -> Polytropic:
    """Return the ideal gas with p V^n = const, its charges stated at a temperature [K]; DefinitionError for n outside 1..10."""
    return Polytropic(n, temperature)


isothermal = polytropic(1.0)
"""p V = const: the gas keeps the temperature of its surroundings, the change is slow."""

adiabatic = polytropic(DIATOMIC)
"""p V^1.4 = const from the charge on: no heat passes, the change is fast."""
