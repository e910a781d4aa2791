"""Scalars of the symbolic reading: SymPy expressions that know what they measure and obey NumPy's functions."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import Any

import sympy

from ..errors import DefinitionError
from ..units import deg
from .units import ANGLE, NUMBER, Unit
from .words import Deg

DIGITS = 40
"""Numbers are taken as the decimals they are written as."""


def number(value: float) -> Any:
    """Return a float as an exact integer or as the decimal it is written as."""
    return sympy.Integer(int(value)) if value == int(value) and abs(value) < 1e15 else sympy.Float(repr(value), DIGITS)


def degrees(value: float) -> Any:
    """Return an angle [rad] as it is shown, in degrees; 0 stays 0."""
    shown = float(f"{value / deg:.13g}")
    return Deg(number(shown)) if value else sympy.S.Zero


class Term:
    """An expression and its unit; adds, multiplies and takes NumPy's functions, as the rules of quantities ask."""

    def __init__(self, expr: Any, unit: Unit = NUMBER) -> None:
        self.expr, self.unit = expr, unit

    def as_angle(self) -> Term:
        """Return a plain number as an angle in degrees."""
        if self.unit == NUMBER and (self.expr.is_Float or self.expr.is_Integer):
            return Term(degrees(float(self.expr)), ANGLE)
        return self

    def _plus(self, other: Any, sign: int) -> Term:
        a, b = self, term(other)
        if ANGLE in (a.unit, b.unit):
            a, b = a.as_angle(), b.as_angle()
        return Term(a.expr + sign * b.expr, b.unit if a.unit == NUMBER else a.unit)

    def __add__(self, other: Any) -> Term:
        return self._plus(other, 1)

    def __radd__(self, other: Any) -> Term:
        return term(other)._plus(self, 1)

    def __sub__(self, other: Any) -> Term:
        return self._plus(other, -1)

    def __rsub__(self, other: Any) -> Term:
        return term(other)._plus(self, -1)

    def __mul__(self, other: Any) -> Term:
        b = term(other)
        return Term(self.expr * b.expr, self.unit * b.unit)

    def __rmul__(self, other: Any) -> Term:
        return term(other) * self

    def __truediv__(self, other: Any) -> Term:
        b = term(other)
        return Term(self.expr / b.expr, self.unit * b.unit**-1)

    def __rtruediv__(self, other: Any) -> Term:
        return term(other) / self

    def __pow__(self, other: Any) -> Term:
        b = term(other)
        power = Fraction(str(b.expr)) if b.expr.is_Integer or b.expr.is_Float else Fraction(0)
        exact = sympy.Rational(1, 2) if b.expr == sympy.Float(0.5) else b.expr
        return Term(self.expr**exact, self.unit**power)

    def __rpow__(self, other: Any) -> Term:
        return term(other) ** self

    def __neg__(self) -> Term:
        return Term(-self.expr, self.unit)

    def __pos__(self) -> Term:
        return self

    def __abs__(self) -> Term:
        return Term(sympy.Abs(self.expr), self.unit)

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **options: Any) -> Term:
        if method != "__call__" or options or ufunc.__name__ not in FUNCTIONS:
            raise DefinitionError(f"{ufunc.__name__} has no symbolic form; use one of: {', '.join(FUNCTIONS)}.")
        return FUNCTIONS[ufunc.__name__](*map(term, inputs))

    def __repr__(self) -> str:
        return f"{self.expr} {self.unit.text}".strip()


def term(value: Any) -> Term:
    """Return a number as a term."""
    return value if isinstance(value, Term) else Term(number(float(value)))


def plain(function: Any) -> Callable[..., Term]:
    """Return a function of numbers and angles whose value is a plain number."""
    return lambda *terms: Term(function(*(each.expr for each in terms)))


def keeping(function: Any) -> Callable[..., Term]:
    """Return a function whose value measures what its arguments measure."""
    return lambda *terms: Term(function(*(each.expr for each in terms)), max(terms, key=lambda each: each.unit != NUMBER).unit)


FUNCTIONS: dict[str, Callable[..., Term]] = {
    "add": lambda a, b: a + b,
    "subtract": lambda a, b: a - b,
    "multiply": lambda a, b: a * b,
    "divide": lambda a, b: a / b,
    "true_divide": lambda a, b: a / b,
    "power": lambda a, b: a**b,
    "negative": lambda a: -a,
    "sqrt": lambda a: Term(sympy.sqrt(a.expr), a.unit ** Fraction(1, 2)),
    "sin": plain(sympy.sin),
    "cos": plain(sympy.cos),
    "tan": plain(sympy.tan),
    "exp": plain(sympy.exp),
    "log": plain(sympy.log),
    "sign": plain(sympy.sign),
    "arctan2": lambda y, x: Term(sympy.atan2(y.expr, x.expr), ANGLE),
    "absolute": keeping(sympy.Abs),
    "minimum": keeping(sympy.Min),
    "maximum": keeping(sympy.Max),
}
