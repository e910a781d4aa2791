"""Points and vectors of the symbolic reading: SymPy vectors that obey the plane's algebra, as the rules of steps ask."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from sympy.matrices.expressions.matadd import MatAdd
from sympy.matrices.expressions.matmul import MatMul

from .term import Term, term
from .units import LENGTH, Unit
from .words import Cross, Deg, Dot, Norm, TurnV


class Place:
    """A point, a vector or a direction. Its expression is asked for when it is first needed, so that nothing idle is written."""

    def __init__(self, written: Callable[[], Any], reading: Any, points: tuple[str, ...] = (), unit: Unit = LENGTH) -> None:
        self._written, self._reading, self._points, self.unit = written, reading, points, unit

    @property
    def expr(self) -> Any:
        """The SymPy vector."""
        return self._written()

    @property
    def x(self) -> Term:
        """The x component."""
        return Term(self.expr[0, 0], self.unit)

    @property
    def y(self) -> Term:
        """The y component."""
        return Term(self.expr[1, 0], self.unit)

    def _like(self, written: Callable[[], Any], unit: Unit | None = None) -> Place:
        return Place(written, self._reading, unit=unit or self.unit)

    def __add__(self, other: Place) -> Place:
        return self._like(lambda: MatAdd(self.expr, other.expr))

    def __sub__(self, other: Place) -> Place:
        if len(self._points) == len(other._points) == 1:
            P, Q = other._points[0], self._points[0]
            return Place(lambda: self._reading.between(P, Q), self._reading, (P, Q))
        return self._like(lambda: MatAdd(self.expr, MatMul(-1, other.expr)))

    def __neg__(self) -> Place:
        return self._like(lambda: MatMul(-1, self.expr))

    def __mul__(self, factor: Any) -> Place:
        scale = term(factor)
        return self._like(lambda: self.expr if scale.expr == 1 else MatMul(scale.expr, self.expr), self.unit * scale.unit)

    def dot(self, other: Place) -> Term:
        """Return the scalar product."""
        return Term(Dot(self.expr, other.expr), self.unit * other.unit)

    def cross(self, other: Place) -> Term:
        """Return the z component of the vector product."""
        return Term(Cross(self.expr, other.expr), self.unit * other.unit)

    def left(self) -> Place:
        """Return this vector turned by +90 degrees."""
        return self._like(lambda: TurnV(self.expr, Deg(90)))

    def turned(self, cos: Any, sin: Any) -> Place:
        """Return this vector turned by the angle with that cosine and sine."""
        found: Place = self * cos + self.left() * sin
        return found

    def length(self) -> Term:
        """Return the length: the link's own where a label gives it."""
        known = self._reading.link(*self._points) if len(self._points) == 2 else None
        return Term(Norm(self.expr), self.unit) if known is None else known

    def square(self) -> Term:
        """Return the squared length."""
        return Term(Norm(self.expr), self.unit) ** 2
