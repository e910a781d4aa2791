"""The operations of a traced program: one row each, with its NumPy function and its derivative.

Every reading of a program (NumPy blocks, floats, tangents, adjoints) is driven by this table.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from operator import add, mul, neg, sub
from typing import NamedTuple

import numpy as np

from ..numeric.linear import solve_linear
from ..vectors import FloatArray, Numbers, Scalar, pick

# Many small linear systems at once, and one in floats.

#: Up to so many systems LAPACK, called once, is cheaper than one elimination in array steps.
FEW = 64


def unknowns(count: int) -> int:
    """Return how many unknowns a system of n * n + n entries has."""
    return (math.isqrt(4 * count + 1) - 1) // 2


def solve_arrays(*entries: Numbers) -> FloatArray:
    """Return the unknowns of many systems at once, shape (n, ...): n * n matrix entries by rows, then n right sides.

    One elimination for all, each pivot the row that is large in every system; where no row is, LAPACK pivots each.
    """
    n = unknowns(len(entries))
    size = max(np.size(each) for each in entries)
    if size <= FEW:
        return _pivoted_each(n, entries)
    arrays = [np.array(each, float) for each in np.broadcast_arrays(*entries)]
    rows = [[*arrays[k * n : k * n + n], arrays[n * n + k]] for k in range(n)]
    found = _eliminated(rows)
    return _pivoted_each(n, entries) if found is None else np.stack(found)


def _eliminated(rows: list[list[FloatArray]]) -> list[FloatArray] | None:
    """Return the unknowns by one elimination over all systems; None where no row is a safe pivot for all."""
    n = len(rows)
    left = list(rows)
    order: list[list[FloatArray]] = []
    for k in range(n):
        sizes = [np.abs(row[k]) for row in left]
        worth = [float(np.min(size / np.max(sizes, axis=0), initial=np.inf)) for size in sizes]
        best = int(np.argmax(worth))
        if not worth[best] > 1e-2:
            return None
        pivot = left.pop(best)
        order.append(pivot)
        inverse = 1.0 / pivot[k]
        for row in left:
            factor = row[k] * inverse
            for j in range(k + 1, n + 1):
                row[j] = row[j] - factor * pivot[j]
    found: list[FloatArray] = list(order[0][:n])
    for k in reversed(range(n)):
        total = order[k][n]
        for j in range(k + 1, n):
            total = total - order[k][j] * found[j]
        found[k] = total / order[k][k]
    return found


def _pivoted_each(n: int, entries: tuple[Numbers, ...]) -> FloatArray:
    """Return the unknowns with pivots of their own for each system; NaN where a matrix is singular or not finite."""
    stacked = np.stack(np.broadcast_arrays(*entries), axis=-1).astype(float)
    matrix, right = stacked[..., : n * n].reshape(*stacked.shape[:-1], n, n), stacked[..., n * n :, None]
    with np.errstate(all="ignore"):
        if np.isfinite(stacked).all():
            try:
                return np.moveaxis(np.linalg.solve(matrix, right)[..., 0], -1, 0)
            except np.linalg.LinAlgError:
                pass
        regular = np.isfinite(stacked).all(axis=-1)
        safe = np.where(regular[..., None, None], matrix, np.eye(n))
        regular &= np.abs(np.linalg.det(safe)) > 0.0
        safe = np.where(regular[..., None, None], matrix, np.eye(n))
        found = np.where(regular[..., None], np.linalg.solve(safe, right)[..., 0], np.nan)
    return np.moveaxis(found, -1, 0)


def solve_floats(*entries: float) -> tuple[float, ...]:
    """Return the unknowns of one system by elimination with row pivots; NaN where it is singular."""
    n = unknowns(len(entries))
    found = solve_linear([entries[k * n : k * n + n] for k in range(n)], entries[n * n :])
    return (math.nan,) * n if found is None else tuple(found[0])


def component(values: Sequence[Numbers], place: float) -> Numbers:
    """Return one unknown of a solved system."""
    return values[int(place)]


def choice_partials(result: Scalar, a: Scalar, b: Scalar) -> tuple[Scalar, Scalar]:
    """Return (1, 0) where a <= b, else (0, 1): which of two arguments a minimum or a choice follows."""
    return result.graph.pick(a, b, 1.0, 0.0), result.graph.pick(a, b, 0.0, 1.0)


class OperationRule(NamedTuple):
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
    "minimum": OperationRule(np.minimum, "minimum({}, {})", choice_partials),
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


def _quiet(function: Callable[[float], float], argument: float) -> float:
    """Return a value of a function of math; where it would raise, that of NumPy."""
    try:
        return function(argument)
    except (OverflowError, ValueError):
        return math.inf if function is math.exp else math.nan


def _power(a: float, b: float) -> float:
    with np.errstate(all="ignore"):
        return float(np.power(np.float64(a), b))


#: The names a program's text uses, on plain floats: math raises where NumPy returns NaN, so roots and divisions are guarded.
FLOATS: Mapping[str, Callable[..., object]] = {
    "reciprocal": _reciprocal,
    "divide": _divide,
    "sqrt": _sqrt,
    "sin": partial(_quiet, math.sin),
    "cos": partial(_quiet, math.cos),
    "tan": partial(_quiet, math.tan),
    "arctan2": math.atan2,
    "exp": partial(_quiet, math.exp),
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

#: All operations on plain floats, those too that a text writes with signs.
ON_FLOATS: Mapping[str, Callable[..., object]] = {
    **FLOATS,
    **{"add": add, "subtract": sub, "multiply": mul, "negative": neg, "square": lambda a: a * a},
}

#: The same names for text that may raise where a division, a root or a function has no value.
QUICK: Mapping[str, Callable[..., object]] = {
    **FLOATS,
    **{name: getattr(math, name) for name in ("sqrt", "sin", "cos", "tan", "exp", "log")},
}
#: What they raise.
NO_VALUE = (ZeroDivisionError, ValueError, OverflowError)


def least_value(values: FloatArray) -> object:
    """Return the least of some numbers, NaN where one of them is; on a thousand numbers in half of the time of NumPy's reduction."""
    return values.item(values.argmin()) if values.ndim else values


#: The same names on arrays.
ARRAYS: Mapping[str, Callable[..., object]] = {name: each.array for name, each in OPERATIONS.items()} | {"least": least_value}
