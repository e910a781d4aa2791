"""Numbers for the equations: each line evaluated from those before it, on arrays or to any number of digits."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import mpmath
import numpy as np
import sympy

from .rules import X_AXIS
from .words import explicit
from .written import Written


def evaluated(lines: Sequence[Written], inputs: Mapping[Any, Any], digits: int | None = None) -> dict[Any, Any]:
    """Return every line's value [SI]: a scalar or a pair, by its symbol.

    `inputs` are the plain symbols' values. With `digits` mpmath works at that many digits and the values
    are SymPy's; else both are NumPy's.
    """
    if digits is None:
        with np.errstate(all="ignore"):
            return _chain(lines, dict(inputs), "numpy")
    with mpmath.workdps(digits + 10):
        exact = {symbol: mpmath.mpf(repr(float(value))) for symbol, value in inputs.items()}
        found = _chain(lines, exact, "mpmath")
    return {symbol: _rounded(value, digits) for symbol, value in found.items()}


def _rounded(value: Any, digits: int) -> Any:
    """Return mpmath numbers as SymPy's, which keep their digits wherever they are shown."""
    return tuple(_rounded(part, digits) for part in value) if isinstance(value, tuple) else sympy.Float(value, digits)


def _chain(lines: Sequence[Written], known: dict[Any, Any], arithmetic: str) -> dict[Any, Any]:
    known |= dict(zip(explicit(X_AXIS), (1.0, 0.0), strict=True))
    found: dict[Any, Any] = {}
    for line in lines:
        expressions = explicit(line.rhs)
        needed = sorted(set().union(*(each.free_symbols for each in expressions)), key=str)
        function = sympy.lambdify(needed, expressions, arithmetic, dummify=True)
        values = function(*(known[symbol] for symbol in needed))
        known |= dict(zip(explicit(line.lhs), values, strict=True))
        found[line.lhs] = values[0] if len(values) == 1 else tuple(values)
    return found
