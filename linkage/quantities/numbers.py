"""What counts as a number from outside: finite, real, not a truth value."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import numpy.typing as npt

from ..frozen import unmasked

EXACT = 2**53
"""Up to this every whole number is a float."""


def is_number(value: Any) -> bool:
    """Return whether a value is one finite real number."""
    if isinstance(value, bool) or not isinstance(value, (int, float, np.integer, np.floating)):
        return False
    try:
        return math.isfinite(value)
    except OverflowError:
        return False


def is_whole(value: Any) -> bool:
    """Return whether a value is one whole number, Python's or NumPy's."""
    return isinstance(value, (int, np.integer)) and not isinstance(value, bool)


def plain(value: Any) -> Any:
    """Return NumPy's number as Python's own, which prints as it is written in a class; a whole one that no float holds as a float."""
    if isinstance(value, int) and abs(value) > EXACT and is_number(value):
        return float(value)
    return value.item() if isinstance(value, np.generic) else value


def real(value: Any) -> npt.NDArray[np.float64]:
    """Return a value as a new array of floats, NaN where it is masked; raise ValueError for anything but real numbers."""
    array = np.asarray(float(value) if is_whole(value) and is_number(value) else unmasked(value))
    if array.dtype.kind not in "fiu":
        raise ValueError(f"{value!r} is not a real number")
    return np.array(array, float)
