"""The values of equations' expressions: on NumPy's arrays, or by mpmath to any number of digits."""

from __future__ import annotations

import operator
from collections.abc import Mapping, Sequence
from functools import reduce
from types import ModuleType
from typing import Any

import mpmath
import numpy as np
import sympy
from sympy.core.relational import Relational
from sympy.logic.boolalg import BooleanAtom
from sympy.matrices.expressions.matexpr import MatrixElement

from .listing import CurveFunction
from .names import Cross, Deg, Direction, Dot, Norm, Tcos, TurnV, plain_symbols

COMPARED = {"<": operator.lt, "<=": operator.le, ">": operator.gt, ">=": operator.ge, "==": operator.eq, "!=": operator.ne}
NAMES = {mpmath: {"Abs": "fabs"}, np: {"Abs": "fabs", "acos": "arccos", "asin": "arcsin", "atan": "arctan", "atan2": "arctan2"}}
"""What functions are called that SymPy calls otherwise."""


class ValuesOf(dict[sympy.Basic, Any]):
    """The values of expressions from those of plain symbols, `values[expr]`, each worked out once: a number, for a vector a pair.

    KeyError for a symbol that is not known, ZeroDivisionError by mpmath.
    """

    def __init__(self, known: Mapping[sympy.Basic, Any], library: ModuleType = np) -> None:
        super().__init__(known)
        self.library = library

    def __missing__(self, expr: sympy.Basic) -> Any:
        found: Any
        match expr:
            case sympy.Symbol():
                raise KeyError(expr)
            case sympy.MatrixSymbol():
                found = tuple(map(self.__getitem__, plain_symbols(expr.name)))
            case MatrixElement():
                found = self[expr.parent][int(expr.i)]
            case sympy.Number() | sympy.NumberSymbol():
                is_plain = self.library is np or not expr.is_finite
                found = float(expr) if is_plain else mpmath.mpmathify(expr if expr.is_Number else expr.evalf(mpmath.mp.dps))
            case BooleanAtom():
                found = bool(expr)
            case CurveFunction():
                found = self[expr.doit()]
            case sympy.ImmutableMatrix():
                found = tuple(map(self.__getitem__, expr))
            case sympy.Piecewise() if self.library is np:
                found = np.select([self[truth] for _, truth in expr.args], [self[value] for value, _ in expr.args], np.nan)[()]
            case sympy.Piecewise():
                found = next((self[value] for value, truth in expr.args if self[truth]), mpmath.nan)
            case _:
                found = self._combined(expr, [self[each] for each in expr.args])
        self[expr] = found
        return found

    def _combined(self, expr: sympy.Basic, args: Sequence[Any]) -> Any:
        """Return the value of an expression from those of its arguments."""
        match expr, args:
            case sympy.MatAdd(), _:
                return tuple(map(sum, zip(*args, strict=True)))
            case sympy.MatMul(), (*factors, (x, y)):
                scale = reduce(operator.mul, factors)
                return scale * x, scale * y
            case sympy.Add(), _:
                return sum(args)
            case sympy.Mul(), _:
                return reduce(operator.mul, args)
            case sympy.Pow(), (base, exponent):
                return base**exponent
            case TurnV(), ((x, y), _, *length):
                cos, sin = self[sympy.cos(expr.args[1])], self[sympy.sin(expr.args[1])]  # of a quarter turn more without rounding
                scale = length[0] / self._called("sqrt", x * x + y * y) if length else 1.0
                return scale * (x * cos - y * sin), scale * (x * sin + y * cos)
            case Norm(), ((x, y),):
                return self._called("sqrt", x * x + y * y)
            case Direction(), ((x, y),):
                return self._called("atan2", y, x)
            case Dot(), ((a, b), (c, d)):
                return a * c + b * d
            case Cross(), ((a, b), (c, d)):
                return a * d - b * c
            case Deg(), (angle,):
                return angle * self[sympy.pi] / 180
            case Tcos(), (a, b, c):
                return self._called("acos", (a * a + b * b - c * c) / (2 * a * b))
            case Relational(), _:
                return COMPARED[expr.rel_op](*args)
            case sympy.Min() | sympy.Max() | sympy.And() | sympy.Or(), _:
                return reduce(REDUCED[type(expr)], args)
        return self._called(type(expr).__name__, *args)

    def _called(self, name: str, *args: Any) -> Any:
        """Return the value of a function by its name in SymPy."""
        return getattr(self.library, NAMES[self.library].get(name, name))(*args)


REDUCED = {sympy.Min: np.minimum, sympy.Max: np.maximum, sympy.And: np.logical_and, sympy.Or: np.logical_or}
