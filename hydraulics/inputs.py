"""The user's numbers, looked at where they come in.

A setting (a bore, a charge) is finite. A value over poses may be NaN inside an array, where it marks a pose that
was not reached; a lone NaN is a mistake and refused like any other.
"""

from __future__ import annotations

from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from linkage.errors import DefinitionError
from linkage.program import Traced

Array: TypeAlias = NDArray[np.float64]


def finite(value: ArrayLike, what: str) -> Array:
    """Return the value as floats, its shape kept; DefinitionError if it is text, NaN or infinite."""
    array = _floats(value, what)
    if not is_traced(array) and not np.all(np.isfinite(array)):
        raise DefinitionError(f"{what} = {array[~np.isfinite(array)][0]} is not finite; give a number in SI units.")
    return array


def positive(value: ArrayLike, what: str, remedy: str = "give a positive number in SI units") -> Array:
    """Return the value as floats, its shape kept; DefinitionError unless every one is finite and above zero."""
    array = finite(value, what)
    if np.any(array <= 0.0):
        raise DefinitionError(f"{what} = {np.min(array):.6g} is not above zero; {remedy}.")
    return array


def not_negative(value: ArrayLike, what: str, remedy: str = "give zero or more") -> Array:
    """Return the value as floats, its shape kept; DefinitionError unless every one is finite and not below zero."""
    array = finite(value, what)
    if np.any(array < 0.0):
        raise DefinitionError(f"{what} = {np.min(array):.6g} is below zero; {remedy}.")
    return array


def over_poses(value: ArrayLike, what: str) -> Array:
    """Return a value over poses as floats: NaN stays where an array marks an unreached pose, else DefinitionError."""
    array = _floats(value, what)
    if is_traced(array):
        return array
    if array.ndim == 0 or np.any(np.isinf(array)):
        return finite(value, what)
    return array


def absolute(gauge: ArrayLike, atmosphere: float, what: str) -> Array:
    """Return gauge + atmosphere [Pa]; DefinitionError where that would be below zero."""
    return above_vacuum(finite(gauge, what) + atmosphere, atmosphere, what)


def above_vacuum(pressure: Array, atmosphere: float, what: str) -> Array:
    """Return an absolute pressure [Pa]; DefinitionError where it is below zero."""
    if np.any(pressure < 0.0):
        low = float(np.min(pressure)) - atmosphere
        raise DefinitionError(f"{what} = {low:.6g} Pa gauge is below zero absolute; the least is -{atmosphere:.6g} Pa, the atmosphere.")
    return pressure


def kelvin(value: ArrayLike, what: str, low: float = 200.0, high: float = 400.0) -> Array:
    """Return a gas temperature [K]; DefinitionError outside low..high, where degrees Celsius were meant or the law ends."""
    array = finite(value, what)
    outside = (array < low) | (array > high)
    if np.any(outside):
        raise DefinitionError(f"{what} = {array[outside][0]:.6g} K is outside {low:g}..{high:g} K; give kelvin: 20 deg C is 293.15.")
    return array


def is_traced(value: Any) -> bool:
    """Return whether a value is a number of a law that is being traced: it has no value yet; what has none later is told then."""
    return isinstance(value, Traced)


def _floats(value: ArrayLike, what: str) -> Array:
    array = np.asarray(value)
    if is_traced(array[()]):
        return array[()]
    if array.dtype.kind not in "iuf":
        raise DefinitionError(f"{what} = {value!r} is not a number; give a number in SI units.")
    return array.astype(np.float64)
