"""The operations of a traced program: one row each, with its NumPy function and its derivative.

Every reading of a program (NumPy blocks, floats, tangents, adjoints) is driven by this table.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import final

import numpy as np

from ..vectors import Numbers, Scalar, pick
from .linear import solve_arrays, solve_floats


def component(values: Sequence[Numbers], place: float) -> Numbers:
    """Return one unknown of a solved system."""
    return values[int(place)]


def choice_partials(result: Scalar, a: Scalar, b: Scalar) -> tuple[Scalar, Scalar]:
    """Return (1, 0) where a <= b, else (0, 1): which of two arguments a minimum or a choice follows."""
    return result.graph.pick(a, b, 1.0, 0.0), result.graph.pick(a, b, 0.0, 1.0)


@final
@dataclass(frozen=True)
class OperationRule:
    """One operation: how arrays evaluate it, how it is written, and its partial derivatives.

    `partials(result, *arguments)` returns the derivative of the result by each argument, as nodes.
    """

    array: Callable[..., Numbers]
    text: str
    partials: Callable[..., tuple[Scalar, ...]]


OPERATIONS: dict[str, OperationRule] = {
    "add": OperationRule(np.add, "{} + {}", lambda r, a, b: (1.0, 1.0)),
    "subtract": OperationRule(np.subtract, "{} - {}", lambda r, a, b: (1.0, -1.0)),
    "multiply": OperationRule(np.multiply, "{} * {}", lambda r, a, b: (b, a)),
    "negative": OperationRule(np.negative, "-{}", lambda r, a: (-1.0,)),
    "divide": OperationRule(np.divide, "{} / {}", lambda r, a, b: (1.0 / b, -(r / b))),
    "reciprocal": OperationRule(np.reciprocal, "1.0 / {}", lambda r, a: (-(r * r),)),
    "square": OperationRule(np.square, "{0} * {0}", lambda r, a: (2.0 * a,)),
    "sqrt": OperationRule(np.sqrt, "sqrt({})", lambda r, a: (0.5 / r,)),
    "sin": OperationRule(np.sin, "sin({})", lambda r, a: (np.cos(a),)),
    "cos": OperationRule(np.cos, "cos({})", lambda r, a: (-np.sin(a),)),
    "tan": OperationRule(np.tan, "tan({})", lambda r, a: (1.0 + r * r,)),
    "arctan2": OperationRule(np.arctan2, "arctan2({}, {})", lambda r, y, x: (x / (x * x + y * y), -y / (x * x + y * y))),
    "exp": OperationRule(np.exp, "exp({})", lambda r, a: (r,)),
    "log": OperationRule(np.log, "log({})", lambda r, a: (1.0 / a,)),
    "power": OperationRule(np.power, "power({}, {})", lambda r, a, b: (b * a ** (b - 1.0), r * np.log(a))),
    "absolute": OperationRule(np.absolute, "absolute({})", lambda r, a: (np.sign(a),)),
    "sign": OperationRule(np.sign, "sign({})", lambda r, a: (0.0,)),
    "minimum": OperationRule(np.minimum, "minimum({}, {})", lambda r, a, b: choice_partials(r, a, b)),
    "maximum": OperationRule(np.maximum, "maximum({}, {})", lambda r, a, b: choice_partials(r, b, a)),
    "solve": OperationRule(solve_arrays, "solve({})", lambda r, *entries: ()),
    "component": OperationRule(component, "component({}, {})", lambda r, *entries: ()),
    "pick": OperationRule(pick, "pick({}, {}, {}, {})", lambda r, a, b, x, y: (0.0, 0.0, *choice_partials(r, a, b))),
}


def _reciprocal(a: float) -> float:
    return 1.0 / a if a else math.copysign(math.inf, a)


def _divide(a: float, b: float) -> float:
    return a / b if b else a * math.copysign(math.inf, b)


def _sqrt(a: float) -> float:
    return math.sqrt(a) if a >= 0.0 else math.nan


def _log(a: float) -> float:
    return math.log(a) if a > 0.0 else (-math.inf if a == 0.0 else math.nan)


def _quiet(name: str) -> Callable[..., float]:
    """Return a function of math that answers as NumPy does where math would raise."""
    function = getattr(math, name)

    def guarded(argument: float) -> float:
        try:
            return float(function(argument))
        except (OverflowError, ValueError):
            return math.inf if name == "exp" else math.nan

    return guarded


def _power(a: float, b: float) -> float:
    with np.errstate(all="ignore"):
        return float(np.power(np.float64(a), b))


#: The names a program's text uses, on plain floats: math raises where NumPy returns NaN, so roots and divisions are guarded.
FLOATS: Mapping[str, Callable[..., object]] = {
    "reciprocal": _reciprocal,
    "divide": _divide,
    "sqrt": _sqrt,
    "sin": _quiet("sin"),
    "cos": _quiet("cos"),
    "tan": _quiet("tan"),
    "arctan2": math.atan2,
    "exp": _quiet("exp"),
    "log": _log,
    "power": _power,
    "absolute": abs,
    "sign": lambda a: math.nan if a != a else float((a > 0) - (a < 0)),
    "minimum": lambda a, b: a if a <= b or a != a else b,
    "maximum": lambda a, b: a if a >= b or a != a else b,
    "pick": lambda a, b, x, y: x if a <= b else y,
    "solve": solve_floats,
    "component": component,
}

#: The same names for text that may raise where a division, a root or a function has no value.
QUICK: Mapping[str, Callable[..., object]] = {
    **FLOATS,
    **{name: getattr(math, name) for name in ("sqrt", "sin", "cos", "tan", "exp", "log")},
}
#: What they raise.
NO_VALUE = (ZeroDivisionError, ValueError, OverflowError)

#: The same names on arrays.
ARRAYS: Mapping[str, Callable[..., object]] = {name: each.array for name, each in OPERATIONS.items()} | {"least": np.minimum.reduce}
