"""Between which values nodes lie while their inputs lie between two values each: interval arithmetic, rounded outwards.

What it cannot bound it bounds by nothing, so that what it says always holds; it may be wider than need be.
Source: R. E. Moore, R. B. Kearfott, M. J. Cloud, "Introduction to Interval Analysis", SIAM 2009.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from math import inf, isnan, log
from types import MappingProxyType

import numpy as np

from ..frozen import record
from ..vectors import Operators
from .node import Node
from .schedule import ancestors

OUTWARDS = 1e-14
"""By what part of its size an end is moved outwards, for rounding."""


@record
class Enclosure(Operators["Enclosure | float", "Enclosure"]):
    """An interval: all values between two bounds, these included."""

    low: float
    high: float

    @classmethod
    def from_number(cls, given: Enclosure | float) -> Enclosure:
        """Return a number as an interval of one value."""
        return given if isinstance(given, Enclosure) else cls(float(given), float(given))

    @classmethod
    def around(cls, ends: Sequence[float]) -> Enclosure:
        """Return the interval of some values, widened by rounding; unbounded where one has no value."""
        if any(isnan(each) for each in ends):
            return ANYTHING
        low, high = min(ends), max(ends)
        return cls(low - OUTWARDS * abs(low), high + OUTWARDS * abs(high))

    def applied(self, function: str, *operands: Enclosure | float) -> Enclosure:
        """Apply a function of RULES to intervals and numbers."""
        return RULES[function](*map(Enclosure.from_number, operands))


ANYTHING = Enclosure(-inf, inf)


def enclosed_product(a: Enclosure, b: Enclosure) -> Enclosure:
    """Return the interval of a product."""
    return Enclosure.around([(0.0 if x == 0.0 or y == 0.0 else x * y) for x in (a.low, a.high) for y in (b.low, b.high)])


def enclosed_quotient(a: Enclosure, b: Enclosure) -> Enclosure:
    """Return the interval of a quotient; unbounded where the divisor may be zero."""
    return ANYTHING if b.low <= 0.0 <= b.high else enclosed_product(a, Enclosure.around([1.0 / b.low, 1.0 / b.high]))


def enclosed_power(a: Enclosure, exponent: Enclosure) -> Enclosure:
    """Return the interval of a power."""
    if exponent.low != exponent.high:
        powers = [x**y for x in (a.low, a.high) for y in (exponent.low, exponent.high)] if a.low > 0.0 else []
        return Enclosure.around(powers) if powers else ANYTHING
    power = exponent.low
    if a.low > 0.0 or (a.low >= 0.0 and power > 0.0):
        return Enclosure.around([a.low**power, a.high**power])
    if power == int(power) and power > 0.0:
        ends = [a.low**power, a.high**power]
        return Enclosure.around([*ends, 0.0] if a.low < 0.0 < a.high and power % 2.0 == 0.0 else ends)
    return ANYTHING


def root_of(a: Enclosure) -> Enclosure:
    """Return the interval of a square root; a negative part has no root and is left out."""
    return Enclosure.around([max(a.low, 0.0) ** 0.5, max(a.high, 0.0) ** 0.5])


def without_sign(a: Enclosure) -> Enclosure:
    """Return the interval of an absolute value."""
    return Enclosure(0.0 if a.low <= 0.0 <= a.high else min(abs(a.low), abs(a.high)), max(abs(a.low), abs(a.high)))


def logarithm(a: Enclosure) -> Enclosure:
    """Return the interval of a logarithm."""
    return ANYTHING if a.low <= 0.0 else Enclosure.around([log(a.low), log(a.high) if a.high < inf else inf])


RULES: Mapping[str, Callable[..., Enclosure]] = MappingProxyType(
    {
        "add": lambda a, b: Enclosure.around([a.low + b.low, a.high + b.high]),
        "subtract": lambda a, b: Enclosure.around([a.low - b.high, a.high - b.low]),
        "multiply": enclosed_product,
        "negative": lambda a: Enclosure(-a.high, -a.low),
        "divide": enclosed_quotient,
        "reciprocal": lambda a: enclosed_quotient(Enclosure(1.0, 1.0), a),
        "square": lambda a: enclosed_power(a, Enclosure(2.0, 2.0)),
        "sqrt": root_of,
        "sin": lambda a: Enclosure(-1.0, 1.0),
        "cos": lambda a: Enclosure(-1.0, 1.0),
        "exp": lambda a: Enclosure.around([float(np.exp(min(a.low, 700.0))), inf if a.high > 700.0 else float(np.exp(a.high))]),
        "log": logarithm,
        "power": enclosed_power,
        "absolute": without_sign,
        "sign": lambda a: Enclosure(-1.0, 1.0),
        "minimum": lambda a, b: Enclosure(min(a.low, b.low), min(a.high, b.high)),
        "maximum": lambda a, b: Enclosure(max(a.low, b.low), max(a.high, b.high)),
        "pick": lambda a, b, x, y: Enclosure(min(x.low, y.low), max(x.high, y.high)),
    }
)


def enclosures(outputs: Sequence[Node], inputs: Mapping[str, Enclosure]) -> list[Enclosure]:
    """Return between which values some nodes lie while their inputs do; an input that is not named may be anything."""
    values: dict[Node, Enclosure] = {}
    for node in ancestors(outputs):
        if node.op == "constant":
            values[node] = Enclosure.from_number(node.value)
        elif node.op == "input":
            values[node] = inputs.get(str(node.value), ANYTHING)
        elif node.op in RULES:
            values[node] = RULES[node.op](*(values[arg.origin] for arg in node.args))
        else:
            values[node] = ANYTHING
    return [values[node.origin] for node in outputs]
