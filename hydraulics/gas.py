"""A closed amount of gas: its volume and its pressure. Every pressure in this file is absolute [Pa].

>>> from linkage.units import bar, litre
>>> print(isothermal, "|", adiabatic, "|", polytropic(1.25))
isothermal gas (p V = const) | polytropic gas (p V^1.4 = const) | polytropic gas (p V^1.25 = const)
>>> print(f"{isothermal.volume(100 * bar, p0=50 * bar, V0=4 * litre) / litre:.3f}")
2.000
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike

from linkage.errors import DefinitionError, FormerName, ensure
from linkage.frozen import immutable
from linkage.program import is_traced
from linkage.quantities.quantity import plain
from linkage.units import bar

from .inputs import Array, all_finite, kelvin, positive, without

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

    spelled = FormerName("source_text")

    @property
    def source_text(self) -> str:
        """The law as it is written in a class."""
        return repr(self)

    @abstractmethod
    def specific(self, pressure: Array) -> Array:
        """Return the specific volume at an absolute pressure [Pa], same shape; it falls as the pressure grows.

        Parameters
        ----------
        pressure : array_like
            The pressure [Pa].

        Returns
        -------
        ndarray
            The specific volume.
        """

    @abstractmethod
    def pressure_of(self, specific: Array) -> Array:
        """Return the absolute pressure [Pa] at a specific volume, same shape: the inverse of `specific`.

        Parameters
        ----------
        specific : array_like
            The specific volume.

        Returns
        -------
        ndarray
            The pressure [Pa].
        """

    @abstractmethod
    def slope(self, pressure: Array) -> Array:
        """Return d(specific)/dp at an absolute pressure [Pa], same shape; negative.

        Parameters
        ----------
        pressure : array_like
            The pressure [Pa].

        Returns
        -------
        ndarray
            The derivative.
        """

    @abstractmethod
    def charge_at(self, charge: ArrayLike, temperature: ArrayLike) -> Array:
        """Return the absolute pressure [Pa] at a temperature [K] of the gas that has `charge` [Pa] at `self.temperature`.

        The volume stays. The two broadcast. DefinitionError for a temperature that is not in kelvin.

        Parameters
        ----------
        charge : array_like
            The absolute pressure at `self.temperature` [Pa].
        temperature : array_like
            The temperature [K].

        Returns
        -------
        ndarray
            The absolute pressure [Pa].

        Raises
        ------
        DefinitionError
            A temperature that is not in kelvin.
        """

    @abstractmethod
    def at(self, temperature: float) -> Gas:
        """Return the same law at another temperature [K].

        Parameters
        ----------
        temperature : float
            The temperature of the gas [K].

        Returns
        -------
        Gas
            The law.
        """

    @abstractmethod
    def fast_exponent(self, pressure: ArrayLike) -> Array:
        """Return n of p V^n = const for a change too fast for heat, about an absolute pressure [Pa], same shape.

        Parameters
        ----------
        pressure : array_like
            The pressure [Pa].

        Returns
        -------
        ndarray
            The exponent.
        """

    def volume(self, pressure: ArrayLike, p0: ArrayLike, V0: ArrayLike) -> Array:
        """Return the volume [m3] at an absolute pressure of the gas that fills V0 [m3] at p0 [Pa]; the three broadcast.

        DefinitionError for a pressure or a volume that is not above zero.

        Parameters
        ----------
        pressure : array_like
            The pressure [Pa].
        p0 : array_like
            The absolute pressure of the filling [Pa].
        V0 : array_like
            The volume of the filling [m3].

        Returns
        -------
        ndarray
            The volume [m3].

        Raises
        ------
        DefinitionError
            A pressure or a volume not above zero.
        """
        ratio = self.specific(positive(pressure, "Gas pressure")) / self.specific(positive(p0, "Charge pressure"))
        return positive(V0, "Charge volume") * ratio

    def pressure(self, volume: ArrayLike, p0: ArrayLike, V0: ArrayLike) -> Array:
        """Return the absolute pressure [Pa] in a volume [m3] of the gas that fills V0 [m3] at p0 [Pa]: inverts `volume`.

        DefinitionError for a pressure or a volume that is not above zero.

        Parameters
        ----------
        volume : array_like
            The volume [m3].
        p0 : array_like
            The absolute pressure of the filling [Pa].
        V0 : array_like
            The volume of the filling [m3].

        Returns
        -------
        ndarray
            The absolute pressure [Pa].

        Raises
        ------
        DefinitionError
            A pressure or a volume not above zero.
        """
        ratio = positive(volume, "Gas volume") / positive(V0, "Charge volume")
        return self.pressure_of(self.specific(positive(p0, "Charge pressure")) * ratio)


@immutable
class Polytropic(Gas):
    """Ideal gas with p V^n = const: n = 1 is isothermal (slow), n = 1.4 adiabatic (fast). `n` may be an array over states."""

    n: float | Array = 1.0
    temperature: float = ROOM

    def __post_init__(self) -> None:
        n = all_finite(self.n, "Polytropic exponent", "number")
        without(n, (n < 1.0) | (n > 10.0), "Polytropic exponent n", "{} is outside 1..10; 1 is isothermal, 1.4 adiabatic")
        kelvin(self.temperature, "Gas temperature")

    def __str__(self) -> str:
        if np.ndim(self.n):
            return f"polytropic gas (p V^n = const, n = {np.min(self.n):.4g}..{np.max(self.n):.4g})"
        return "isothermal gas (p V = const)" if self.n == 1.0 else f"polytropic gas (p V^{self.n:.4g} = const)"

    @property
    def source_text(self) -> str:
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
    """Return the ideal gas with p V^n = const, its charges stated at a temperature [K]; DefinitionError for n outside 1..10.

    Parameters
    ----------
    n : float
        The exponent, 1 to 10.
    temperature : float
        The temperature of the gas [K].

    Returns
    -------
    Polytropic
        The gas.

    Raises
    ------
    DefinitionError
        An exponent outside 1 to 10.
    """
    return Polytropic(n, temperature)


isothermal = polytropic(1.0)
"""p V = const: the gas keeps the temperature of its surroundings, the change is slow."""

adiabatic = polytropic(DIATOMIC)
"""p V^1.4 = const from the charge on: no heat passes, the change is fast."""


# Nitrogen as it is: a short real-gas equation of state.
#
#     p = rho R T Z,   Z = 1 + sum of c x^i tau^j,   x = rho / (10 mol/l),   tau = 300 K / T
#
# Twelve terms, fitted to the reference equation of Span, Lemmon, Jacobsen, Wagner and Yokozeki (J. Phys. Chem. Ref.
# Data 29 (2000) 1361), whose own uncertainty in density is 2e-4. Range 245 to 340 K, up to 500 bar. Largest deviation
# there: 4e-5 of the pressure at a density and of the volume at a pressure, 5e-5 of a charge brought to another
# temperature, 0.5 % of the isentropic exponent.

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


@immutable
class RealNitrogen(Gas):
    """Real nitrogen kept at one temperature (a slow change); see above for source, range and error."""

    temperature: float = ROOM

    def __post_init__(self) -> None:
        kelvin(self.temperature, "Temperature of real_nitrogen", COLDEST, HOTTEST)

    def __str__(self) -> str:
        return f"real nitrogen at {self.temperature:.2f} K"

    @property
    def source_text(self) -> str:
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
    """Return nitrogen as a real gas at a temperature [K]; DefinitionError outside 245..340 K.

    Parameters
    ----------
    temperature : float
        The temperature of the gas [K].

    Returns
    -------
    RealNitrogen
        The gas.

    Raises
    ------
    DefinitionError
        A temperature outside 245 to 340 K.
    """
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
    ensure(not is_traced(pressure), "real_nitrogen finds its density by iteration; isothermal and polytropic gases have exact derivatives.")
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
