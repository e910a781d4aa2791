"""Factors to SI, and quantities read and written with their unit.

A value times its unit is the value in SI: `80 * mm` is 0.08 (m), `-75 * deg` is -1.309 (rad).
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable
from typing import Any

from .errors import DefinitionError, cited, known_name, unknown

m = 1.0
mm = 1e-3
cm = 1e-2
inch = 0.0254
rad = 1.0
deg = math.pi / 180.0
s = 1.0
minute = 60.0
kg = 1.0
g0 = 9.80665  # standard gravity, m/s2 (ISO 80000-4)
N = 1.0
kN = 1e3
kgf = g0
Pa = 1.0
kPa = 1e3
MPa = 1e6
bar = 1e5
kgf_cm2 = kgf / cm**2
litre = 1e-3
cm3 = 1e-6
cm2 = 1e-4

#: name -> (factor to SI, what it measures)
UNITS: dict[str, tuple[float, str]] = {
    "m": (m, "length"), "mm": (mm, "length"), "cm": (cm, "length"), "inch": (inch, "length"),
    "rad": (rad, "angle"), "deg": (deg, "angle"), "°": (deg, "angle"),
    "s": (s, "time"), "min": (minute, "time"),
    "kg": (kg, "mass"), "t": (1e3, "mass"),
    "N": (N, "force"), "kN": (kN, "force"), "kgf": (kgf, "force"),
    "Nm": (N, "moment"), "kNm": (kN, "moment"),
    "Pa": (Pa, "pressure"), "kPa": (kPa, "pressure"), "MPa": (MPa, "pressure"), "bar": (bar, "pressure"),
    "kgf_cm2": (kgf_cm2, "pressure"), "kgf/cm2": (kgf_cm2, "pressure"),
    "l": (litre, "volume"), "litre": (litre, "volume"), "cm3": (cm3, "volume"), "m3": (1.0, "volume"),
    "cm2": (cm2, "area"), "m2": (1.0, "area"), "rad/m": (1.0, "angle per length"),
}  # fmt: skip


def factor(unit: str) -> float:
    """Return how much of SI a unit is; 1.0 for "", a plain number."""
    return UNITS[unit][0] if unit else 1.0


def display_unit(measure: str, length: str = "m") -> str:
    """Return the unit that an "angle", a "length", a "force" or a "pressure" is shown in, a length in that which is said; else ""."""
    return {"angle": "deg", "length": length, "force": "kN", "pressure": "bar"}.get(measure, "")


_QUANTITY = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*([^\s\d]\S*)?\s*\Z")
_COMMA = re.compile(r"\s*[-+]?\d*,\d+\s*[^\s\d,]*\s*\Z")


def parse(text: str, kind: str = "") -> float:
    """Return the SI value of a text such as `180mm`, `-75 deg` or `0.18`.

    A bare number is SI. With `kind` ("length", "angle", ...) a unit of another kind is refused.
    Raises DefinitionError naming the text and the valid units.
    """
    if not isinstance(text, str) or not isinstance(kind, str):
        raise DefinitionError(f"{cited(text if isinstance(kind, str) else kind)} is no text; write a number and a unit in quotes, '180mm'.")
    match = _QUANTITY.match(text)
    if _COMMA.match(text):
        raise DefinitionError(f"{text!r}: decimals are written with a point, {text.replace(',', '.')!r}.")
    if match is None:
        raise DefinitionError(f"{text!r} is not a value; write a number and a unit, such as 180mm or -75deg.")
    number, unit = match.groups()
    if unit is None:
        return finite_value(float(number), text)
    if unit not in UNITS:
        raise unknown("Unit", unit, UNITS, where=repr(text))
    factor, measured = UNITS[unit]
    if kind and measured != kind:
        valid = ", ".join(name for name, (_, what) in UNITS.items() if what == kind)
        article = "an" if measured[0] in "aeiou" else "a"
        raise DefinitionError(f"{text!r} is {article} {measured} where a value of kind {kind} is wanted; use one of: {valid}.")
    return finite_value(float(number) * factor, text)


def finite_value(value: float, text: str) -> float:
    """Return the value; raise DefinitionError if it overflowed or is not a number."""
    if not math.isfinite(value):
        raise DefinitionError(f"{text!r} is not a finite number.")
    return value


def unit_or_none(unit: object, where: str, among: Iterable[str] = UNITS) -> str:
    """Return a unit, or "" for none; DefinitionError, with the units there are, for anything else."""
    return "" if isinstance(unit, str) and not unit else known_name("Unit", unit, among, where=where)


def show(value: float, unit: str, digits: int = 6) -> str:
    """Return an SI value as text in a unit: `show(0.18, "mm")` is `180 mm`; as it is where the unit is ""."""
    unit_or_none(unit, where="")
    given: Any = value
    is_one = isinstance(given, (float, int)) or getattr(given, "shape", None) == ()
    if not is_one or isinstance(given, bool) or not isinstance(digits, int) or isinstance(digits, bool) or not 0 < digits < 20:
        raise DefinitionError(f"show({cited(value)}, {unit!r}, {cited(digits)}): a number and its digits are expected.")
    return f"{value / UNITS[unit][0]:.{digits}g} {unit}" if unit else f"{value:.{digits}g}"
