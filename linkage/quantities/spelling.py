"""How quantities are written, so that the text gives the same value when it is pasted back."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..units import deg

if TYPE_CHECKING:
    from .quantity import Quantity

DIGITS = 17  # tell any float from its neighbours
MORE = 2  # characters that degrees may be longer than radians


def spelled(part: Quantity, binding: int = 0, measures: str = "") -> str:
    """Return a part as text, in brackets where it binds more loosely than its surroundings.

    `measures` says what it stands for, where its place tells: the numbers of an `angle` are written in degrees.
    """
    text = part.name or part.text(measures)
    return f"({text})" if not part.name and getattr(part, "binds", 9) < binding else text


def in_degrees(value: float) -> str:
    """Return an angle [rad] as `75 * deg` where that is the same to the last digit; else, or where it is much shorter, in radians."""
    plain = repr(value)
    if not 0.0 < abs(value) < float("inf"):
        return plain
    for digits in range(1, DIGITS + 1):
        degrees = float(f"{value / deg:.{digits}g}")
        if degrees * deg == value:
            text = repr(degrees).removesuffix(".0")
            return f"{text} * deg" if len(text) <= len(plain) + MORE else plain
    return plain
