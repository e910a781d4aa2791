"""Factors to SI, and quantities read and written with their unit.

A value times its unit is the value in SI: `80 * mm` is 0.08 (m), `-75 * deg` is -1.309 (rad).

What is shown keeps the unit that is written beside it, until a system is chosen: then everything is shown in the units of that system,
in sentences as in tables, with about as many digits as before.

    >>> show(0.18, "mm")
    '180 mm'
    >>> with unit_system("us"):
    ...     show(0.18, "mm", ".1f")
    '7.087 in'
"""

from __future__ import annotations

import math
import re
from collections.abc import Collection, Iterable, Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from types import MappingProxyType
from typing import Any, Self

from .errors import DefinitionError, article, cited, ensure, is_number, known_name, unfit, unknown
from .language import translated
from .star import declare_public


class Amount(float):
    """A number in SI with a kind: `80 * mm` is 0.08, a "length". It calculates as any float.

    With its sign changed, and added to its like, it goes on knowing, and so in a list of such. Anything else makes a plain number of it,
    which is taken as SI: a product may measure anything, `0.5 + 3 * deg` is 0.552, an array holds numbers alone.
    """

    __slots__ = ("measures",)

    measures: str

    def __new__(cls, value: float, measures: str) -> Self:
        found = super().__new__(cls, value)
        found.measures = measures
        return found

    def __getnewargs__(self) -> tuple[float, str]:  # type: ignore[override]
        return float(self), self.measures

    def __add__(self, other: float) -> float:
        return self._sum(float.__add__(self, other), other)

    def __sub__(self, other: float) -> float:
        return self._sum(float.__sub__(self, other), other)

    def __neg__(self) -> float:
        return Amount(float.__neg__(self), self.measures)

    def _sum(self, found: float, other: object) -> float:
        """Return a sum, as an amount where both are alike; NotImplemented, of arrays and quantities, as it is."""
        return Amount(found, self.measures) if getattr(other, "measures", None) == self.measures and isinstance(found, float) else found


class UnitFactor(Amount):
    """A unit's factor, which makes a number an amount: `mm` in `80 * mm`."""

    __slots__ = ()

    def __mul__(self, other: float) -> float:
        found = float.__mul__(self, other)
        return Amount(found, self.measures) if type(other) in (int, float) else found

    __rmul__ = __mul__


m = UnitFactor(1.0, "length")
mm = UnitFactor(1e-3, "length")
cm = UnitFactor(1e-2, "length")
inch = UnitFactor(0.0254, "length")
ft = UnitFactor(12 * inch, "length")
rad = UnitFactor(1.0, "angle")
deg = UnitFactor(math.pi / 180.0, "angle")
s = 1.0
minute = 60.0
kg = 1.0
lb = 0.45359237  # avoirdupois pound (international yard and pound agreement, 1959)
g0 = 9.80665  # standard gravity, m/s2 (ISO 80000-4)
N = UnitFactor(1.0, "force")
kN = UnitFactor(1e3, "force")
kgf = UnitFactor(g0, "force")
lbf = UnitFactor(lb * g0, "force")
Pa = UnitFactor(1.0, "pressure")
kPa = UnitFactor(1e3, "pressure")
MPa = UnitFactor(1e6, "pressure")
bar = UnitFactor(1e5, "pressure")
kgf_cm2 = UnitFactor(kgf / cm**2, "pressure")
psi = UnitFactor(lbf / inch**2, "pressure")
litre = UnitFactor(1e-3, "volume")
gal = UnitFactor(231 * inch**3, "volume")  # the US liquid gallon
cm3 = UnitFactor(1e-6, "volume")
cm2 = 1e-4

#: name -> (factor to SI, what it measures); `add_unit` adds to it
UNITS: dict[str, tuple[float, str]] = {
    "m": (m, "length"), "mm": (mm, "length"), "cm": (cm, "length"), "inch": (inch, "length"),
    "in": (inch, "length"), "ft": (ft, "length"),
    "rad": (rad, "angle"), "deg": (deg, "angle"), "°": (deg, "angle"),
    "s": (s, "time"), "min": (minute, "time"),
    "kg": (kg, "mass"), "t": (1e3, "mass"), "lb": (lb, "mass"),
    "N": (N, "force"), "kN": (kN, "force"), "kgf": (kgf, "force"), "lbf": (lbf, "force"),
    "Nm": (N, "moment"), "kNm": (kN, "moment"), "kgf m": (kgf, "moment"), "lbf ft": (lbf * ft, "moment"),
    "Pa": (Pa, "pressure"), "kPa": (kPa, "pressure"), "MPa": (MPa, "pressure"), "bar": (bar, "pressure"),
    "kgf_cm2": (kgf_cm2, "pressure"), "kgf/cm2": (kgf_cm2, "pressure"),
    "psi": (psi, "pressure"),
    "l": (litre, "volume"), "litre": (litre, "volume"), "cm3": (cm3, "volume"), "m3": (1.0, "volume"),
    "gal": (gal, "volume"), "in3": (inch**3, "volume"),
    "mm2": (mm**2, "area"), "cm2": (cm2, "area"), "m2": (1.0, "area"), "in2": (inch**2, "area"),
    "l/min": (litre / minute, "flow"), "gal/min": (gal / minute, "flow"), "m3/s": (1.0, "flow"),
    "N/m": (N, "stiffness"), "N/mm": (N / mm, "stiffness"), "kN/m": (kN, "stiffness"), "kgf/mm": (kgf / mm, "stiffness"),
    "lbf/in": (lbf / inch, "stiffness"), "N s/m": (N, "damping"),
    "J": (1.0, "energy"), "kJ": (1e3, "energy"), "kWh": (3.6e6, "energy"),
    "kW": (1e3, "power"), "hp": (550 * lbf * ft, "power"),
    "m/s": (1.0, "speed"), "mm/s": (mm, "speed"), "in/s": (inch, "speed"),
    "m/s2": (1.0, "acceleration"), "mm/s2": (mm, "acceleration"), "m/s3": (1.0, "jerk"), "mm/s3": (mm, "jerk"),
    "rad/s": (rad, "angular speed"), "deg/s": (deg, "angular speed"),
    "rad/s2": (rad, "angular acceleration"), "deg/s2": (deg, "angular acceleration"),
    "rad/s3": (rad, "angular jerk"), "deg/s3": (deg, "angular jerk"),
    "rad/m": (1.0, "angle per length"), "kg m2": (1.0, "inertia"),
}  # fmt: skip


SI: dict[str, str] = {
    "length": "m", "angle": "rad", "time": "s", "mass": "kg", "force": "N", "moment": "Nm", "pressure": "Pa", "volume": "m3", "area": "m2",
    "flow": "m3/s", "stiffness": "N/m", "damping": "N s/m", "power": "W", "energy": "J", "speed": "m/s", "acceleration": "m/s2",
    "jerk": "m/s3", "angular speed": "rad/s", "angular acceleration": "rad/s2", "angular jerk": "rad/s3", "angle per length": "rad/m",
    "inertia": "kg m2",
}  # fmt: skip
"""What each measure has in SI."""
MEASURED = tuple(SI)
"""What the units of the framework's own table measure."""


def add_unit(name: str, factor: float, measures: str, systems: Iterable[str] = ()) -> UnitFactor:
    """Add a unit to the table, from then on known to classes, files and commands alike: `Ns_m = add_unit("N s/m", 1.0, "damping")`.

    `factor` is its value in SI, `measures` what it measures, in words of one's own too; the first unit of such a measure is that of SI,
    with the factor 1. In `systems` ("us") all values of that measure are shown in it. What comes back is its factor, `250 * Ns_m`.
    Adding the same again changes nothing. DefinitionError for a name that means something else, or that cannot be read behind a number.
    """
    where = f"add_unit({cited(name)}, {cited(factor)}, {cited(measures)})"
    is_word = isinstance(name, str) and name.isprintable() and not {*name}.intersection(",;()\"'")
    match = _QUANTITY.fullmatch(f"1 {name}") if is_word else None
    fault = ""
    if match is None or match[2] != name:
        fault = "a unit is one or two words without digits in front and without commas, such as 'N s/m'"
    elif not isinstance(measures, str) or not measures.strip() or not measures.isprintable():
        fault = "what it measures is expected in a word, such as 'damping'"
    elif not isinstance(factor, (int, float)) or isinstance(factor, bool) or not 0.0 < factor < math.inf:
        fault = "its value in SI is expected, a number above zero"
    elif UNITS.get(name, (factor, measures)) != (factor, measures):
        fault = f"{name} is known already, as {UNITS[name][0]:.9g} of SI for {UNITS[name][1]}; choose another name"
    elif measures not in SI and factor != 1.0:
        fault = f"the first unit of {measures} is that of SI, with the factor 1; add it before"
    ensure(not fault, f"{where}: {fault}.")
    chosen = [known_name("System of units", each, SYSTEMS, where=where) for each in systems]
    SI.setdefault(measures, name)
    UNITS[name] = UnitFactor(factor, measures), measures
    for each in chosen:
        SYSTEMS[each][measures] = name
    return UnitFactor(factor, measures)


EXAMPLES = {"length": "80 * mm", "angle": "15 * deg", "force": "5 * kN", "pressure": "180 * bar", "mass": "250 * kg",
            "volume": "4 * litre", "flow": "60 * litre / minute"}


def require_measure(value: object, unit: str, what: str) -> None:
    """Refuse an amount of another kind than a unit measures, such as `12 * kN` for a mass. A plain number is SI, whatever was meant.

    Parameters
    ----------
    value : object
        What was given, or several of such in a list or a tuple. Only an `Amount` knows what it measures; anything else passes.
    unit : str
        A unit of what is expected, such as "mm", or what that measures, "length"; "number" for a plain one, "" for any.
    what : str
        What it was given for, `Weight: mass`, for the message.

    Raises
    ------
    DefinitionError
        The amount measures something else. Moments, stiffnesses, dampings, what a unit of one's own measures and numbers of an open kind
        take forces, since `5 * kN` may stand for 5 kN m; numbers of an open kind take volumes as well.
    """
    wanted = unit if unit in SI or unit == "number" else UNITS[unit][1] if unit in UNITS else ""
    for each in amounts_in(value):
        may_stand = {"force": wanted in ("moment", "stiffness", "damping") or wanted not in (*MEASURED, "number"), "volume": not wanted}
        if each.measures != wanted and not may_stand.get(each.measures, False):
            expected = f"value of {wanted}, such as {EXAMPLES[wanted]}" if wanted in EXAMPLES else "number in SI, without a unit"
            given = f"{article(each.measures)} {each.measures}"
            raise DefinitionError(f"{what}={float(each):.6g} was given as {given}; expected is a {expected}.")


def require_number(
    what: str, value: object, expected: str, *, above: float = -math.inf, least: float = -math.inf,
    most: float = math.inf, below: float = math.inf, kind: str | None = "number",
) -> float:  # fmt: skip
    """Return one finite number within its limits; refuse anything else.

    Parameters
    ----------
    what : str
        What it is given for, as it is written: "efficiency", "gap(width".
    value : object
        What was given.
    expected : str
        What is expected, for the message, without the full stop: "a number is expected, zero or more".
    above, least, most, below : float
        The number is more than `above`, at least `least`, at most `most`, less than `below`.
    kind : str, optional
        What it measures, such as "length": an amount of another kind is refused; None where that is open.

    Raises
    ------
    DefinitionError
        It is no such number.
    """
    if not (is_number(value) and above < value < below and least <= value <= most):
        raise unfit(what, value, expected)
    if kind is not None:
        require_measure(value, kind, what if ")" in what else what.replace("(", ": "))
    return value


def amounts_in(value: object) -> Iterator[Amount]:
    """Yield the amounts that a value is, or that stand in it where it is a list or a tuple."""
    if isinstance(value, Amount):
        yield value
    elif isinstance(value, (list, tuple)) and not {*map(type, value)} <= {float, int}:
        for each in value:
            yield from amounts_in(each)


def amount_or_float(value: float) -> float:
    """Return a number as a float, an amount as it is."""
    return value if isinstance(value, Amount) else float(value)


def units_of(*measures: str) -> list[str]:
    """Return the units of a kind, "pressure", or of several."""
    return [name for name, (_, what) in UNITS.items() if what in measures]


def factor(unit: str) -> float:
    """Return how much of SI a unit is; 1.0 for "", a plain number."""
    return UNITS[unit][0] if unit else 1.0


SHOWN = {
    "angle": "deg", "force": "kN", "moment": "Nm", "pressure": "bar", "time": "s", "volume": "l", "area": "cm2", "stiffness": "N/mm",
    "angle per length": "rad/m", "speed": "mm/s", "acceleration": "m/s2", "power": "kW", "flow": "l/min",
}  # fmt: skip
"""The unit that each kind but a length is shown in."""


def display_unit(measure: str, length: str = "m") -> str:
    """Return the unit that an "angle", a "length", a "force", a "volume" is shown in, a length in that which is said; else ""."""
    return length if measure == "length" else SHOWN.get(measure, "")


DIGITS = r"(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]+)?"
"""A number without its sign as it is written everywhere: in classes' texts, files, studies and commands."""
_QUANTITY = re.compile(rf"\s*([-+]?{DIGITS})\s*([^\s\d]\S*(?: [^\s\d]\S*)?)?\s*\Z")
_SPAN = re.compile(r"\s*(?P<low>.+?)\s+to\s+(?P<high>.+?)(?:\s+(?:in steps of|by)\s+(?P<step>.+?))?\s*\Z")
_COMMA = re.compile(r"\s*[-+]?\d*,\d+\s*[^\s\d,]*\s*\Z")


def parse(text: str, kind: str = "") -> float:
    """Return the SI value of a text such as `180mm`, `-75 deg` or `0.18`.

    A bare number is SI. With `kind` ("length", "angle", ...) a unit of another kind is refused.
    Raises DefinitionError naming the text and the valid units.
    """
    if not isinstance(text, str) or not isinstance(kind, str):
        raise DefinitionError(f"{cited(text if isinstance(kind, str) else kind)} is no text; write a number and a unit in quotes, '180mm'.")
    match = _QUANTITY.match(text)
    ensure(not _COMMA.match(text), f"{text!r}: decimals are written with a point, {text.replace(',', '.')!r}.")
    if match is None:
        raise DefinitionError(f"{text!r} is not a value; write a number and a unit, such as 180mm or -75deg.")
    number, unit = match.groups()
    if unit is not None and unit not in UNITS:
        raise unknown("Unit", unit, UNITS, where=repr(text))
    factor, measured = (1.0, kind) if unit is None else UNITS[unit]
    if kind and measured != kind:
        wanted = f"value of kind {kind} is wanted; use one of: {', '.join(units_of(kind))}" if units_of(kind) else "plain number is wanted"
        raise DefinitionError(f"{text!r} is {article(measured)} {measured} where a {wanted}.")
    whole = unit[:-4] if unit is not None and unit.endswith("/min") and unit[:-4] in UNITS else ""
    value = float(float(number) * UNITS[whole][0] / minute if whole else float(number) * factor)  # to the last bit as 40 * litre / minute
    ensure(math.isfinite(value), f"{text!r} is not a finite number.")
    return value


def parse_span(text: str, kind: str = "") -> tuple[float, ...] | None:
    """Return the ends in SI, and the step where there is one, of a text such as `270 to 330 mm by 5 mm`; None for any other text.

    What has no unit has that of the first part behind it that has one.
    """
    found = _SPAN.match(text)
    if found is None:
        return None
    parts = [part for part in found.group("low", "high", "step") if part]
    matches = [_QUANTITY.match(part) for part in parts]
    unit = next((match[2] for match in matches[1:] if match is not None and match[2]), "")
    return tuple(
        parse(f"{part} {unit}" if unit and match is not None and not match[2] else part, kind)
        for part, match in zip(parts, matches, strict=True)
    )


def unit_or_none(unit: object, where: str, among: Collection[str] | None = None) -> str:
    """Return a unit, or "" for none; DefinitionError, with the units there are, for anything else."""
    return "" if isinstance(unit, str) and not unit else known_name("Unit", unit, UNITS if among is None else among, where=where)


# -- one system of units for all that is shown -------------------------------------------------------------

METRIC = {
    "length": "mm", "angle": "deg", "mass": "kg", "force": "kN", "moment": "kNm", "pressure": "MPa", "volume": "l", "area": "cm2",
    "flow": "l/min", "stiffness": "N/mm", "power": "kW", "speed": "mm/s",
}  # fmt: skip
SYSTEMS: Mapping[str, dict[str, str]] = MappingProxyType({
    "si": {**METRIC},
    "bar-mm": {**METRIC, "pressure": "bar"},
    "kgf": {**METRIC, "force": "kgf", "moment": "kgf m", "pressure": "kgf/cm2", "stiffness": "kgf/mm"},
    "us": {
        "length": "in", "angle": "deg", "mass": "lb", "force": "lbf", "moment": "lbf ft", "pressure": "psi", "volume": "gal",
        "area": "in2", "flow": "gal/min", "stiffness": "lbf/in", "power": "hp", "speed": "in/s",
    },
})  # fmt: skip
"""The unit of every measure in each system; a measure that is not in it keeps its unit."""

_SYSTEM: ContextVar[str] = ContextVar("unit_system", default="")
_ASKED: ContextVar[set[str] | None] = ContextVar("units_asked", default=None)

_CLOSE = 0.15
"""A resolution that is coarser by less than this power of ten is still as fine."""

_FORMAT = re.compile(r"([+z]*)\.(\d+)([fg])")


@contextmanager
def unit_system(name: str | None) -> Iterator[None]:
    """Show everything inside `with` in one system, "si", "bar-mm", "kgf" or "us"; None: each number in the unit it is given."""
    token = _SYSTEM.set("" if name is None else known_name("System of units", name, SYSTEMS, where="unit_system(...)"))
    try:
        yield
    finally:
        _SYSTEM.reset(token)


def current_system() -> str:
    """Return the system of units that things are shown in; "" for none."""
    return _SYSTEM.get()


@contextmanager
def units_shown() -> Iterator[set[str]]:
    """Collect the units that are shown inside `with`; a system that keeps all of them changes no text."""
    found = set[str]()
    token = _ASKED.set(found)
    try:
        yield found
    finally:
        _ASKED.reset(token)


def shown_in(unit: str) -> str:
    """Return the unit that values of a unit are shown in: that of the system for the same measure, without a system itself."""
    if (asked := _ASKED.get()) is not None:
        asked.add(unit)
    system = SYSTEMS.get(_SYSTEM.get(), {})
    return system.get(UNITS[unit][1], unit) if unit else ""


def unit_sign(unit: str) -> str:
    """Return how a unit is written in the language that is spoken, in the system that is chosen: "kgf/cm2" is "psi" in "us"."""
    return translated(shown_in(unit))


def decimals(digits: int, unit: str) -> int:
    """Return the decimals that a value of a unit with so many decimals has where it is shown: as fine, never below none."""
    coarser = factor(shown_in(unit)) / factor(unit)
    return max(0, math.ceil(digits + math.log10(coarser) - _CLOSE)) if coarser != 1.0 else digits


def shown_number(value: float, unit: str, digits: int | str = 6, missed: float | None = None) -> str:
    """Return an SI value as a number alone, without its unit, in the unit that it is shown in, rounded to the nearest.

    `digits`: how many count, or a format, ".1f", "+.0f", "z.0f", ".4g", whose decimals hold for `unit` itself. There are as many more as
    tell it from a limit that is `missed`: "170.02" where the limit is 170.
    """
    if unit not in UNITS:
        unit_or_none(unit, where="")
    given: Any = value
    is_one = isinstance(given, (float, int)) or getattr(given, "shape", None) == ()
    form = _FORMAT.fullmatch(f".{digits}g" if isinstance(digits, int) and not isinstance(digits, bool) else str(digits))
    if not is_one or isinstance(given, bool) or form is None or not (0 if form[3] == "f" else 1) <= int(form[2]) < 20:
        raise DefinitionError(f"show({cited(value)}, {unit!r}, {cited(digits)}): a number and its digits are expected.")
    flags, count, kind = form[1], int(form[2]), form[3]
    shown = value / factor(shown_in(unit))
    limit, least = "" if missed in (None, value) else shown_number(missed, unit, digits), decimals(count, unit) if kind == "f" else count
    found = (f"{shown:{flags}.{more}{kind}}" for more in range(least, least + 20))
    text = next(each for each in found if not limit or float(each) != float(limit))
    return f"{shown:{flags}.0f}" if "e+" in text and abs(shown) < 1e9 else text


def show(value: float, unit: str, digits: int | str = 6, missed: float | None = None) -> str:
    """Return an SI value as text in a unit: `show(0.18, "mm")` is `180 mm`; as it is where the unit is "".

    `digits`: how many count, or a format such as ".1f"; in a chosen system it is in the unit of that, as fine as here. A value has more of
    them where it would read as a limit that it has `missed`.
    """
    text = shown_number(value, unit, digits, missed)
    return f"{text} {unit_sign(unit)}" if unit else text


declare_public(globals())
