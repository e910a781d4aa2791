"""The vector method's words as SymPy expressions: TurnV, TurnVL, Tcos, lengths and directions of vectors.

Vectors are SymPy matrix symbols of shape (2, 1). `doit()` writes a word out in components and elementary functions.
Source: Dyuzhev, Kotov, Chuprynin, "Universality of the hitch of the power vehicle UES-2-250A" (Minsk, 2008).
"""

from __future__ import annotations

from typing import Self, final

import sympy
from sympy.matrices.expressions.matexpr import MatrixElement, MatrixExpr


def vector_symbol(name: str) -> sympy.MatrixSymbol:
    """Return the symbol of a vector or a position."""
    return sympy.MatrixSymbol(name, 2, 1)


@final
class PointSymbol(sympy.MatrixSymbol):  # type: ignore[misc]
    """The symbol of a position: it comes first in a sum."""


def point_symbol(name: str) -> PointSymbol:
    """Return the symbol of a position."""
    return PointSymbol(name, 2, 1)


def components_of(vector: MatrixExpr) -> tuple[sympy.Expr, sympy.Expr]:
    """Return both components of a vector, written out."""
    return vector[0, 0].doit(), vector[1, 0].doit()


class TurnV(MatrixExpr):  # type: ignore[misc]
    """The vector V turned by the angle a [rad], counter-clockwise positive."""

    def __new__(cls, vector: MatrixExpr, angle: sympy.Expr) -> MatrixExpr:
        return super().__new__(cls, vector, sympy.sympify(angle))

    @property
    def shape(self) -> tuple[int, int]:
        return (2, 1)

    @property
    def scale(self) -> sympy.Expr:
        """The factor to the length."""
        return sympy.S.One

    def _entry(self, i: sympy.Integer, j: sympy.Integer, **options: object) -> sympy.Expr:
        (x, y), angle = components_of(self.args[0]), self.args[1].doit()
        cos, sin = sympy.cos(angle), sympy.sin(angle)
        return self.scale * (x * cos - y * sin if i == 0 else x * sin + y * cos)

    def doit(self, **options: object) -> Self:
        return self


@final
class TurnVL(TurnV):
    """The vector V turned by the angle a [rad] and scaled to the length L [m]: TurnV(V, a) L/|V|."""

    def __new__(cls, vector: MatrixExpr, angle: sympy.Expr, length: sympy.Expr) -> MatrixExpr:
        return MatrixExpr.__new__(cls, vector, sympy.sympify(angle), sympy.sympify(length))

    @property
    def scale(self) -> sympy.Expr:
        return self.args[2].doit() / Norm(self.args[0]).doit()


@final
class Tcos(sympy.Function):  # type: ignore[misc]
    """The angle between the sides L1 and L2 of a triangle, opposite L3 [rad], 0 to pi: the cosine rule."""

    nargs = 3
    is_real = True

    def doit(self, **options: object) -> sympy.Expr:
        a, b, c = (side.doit() for side in self.args)
        return sympy.acos((a**2 + b**2 - c**2) / (2 * a * b))


class VectorNumber(sympy.Expr):  # type: ignore[misc]
    """A real number read off vectors, kept as a word until `doit`."""

    is_real = True
    is_commutative = True

    def __new__(cls, *args: sympy.Basic) -> sympy.Expr:
        return super().__new__(cls, *map(sympy.sympify, args))


@final
class Norm(VectorNumber):
    """The length |V| [m]."""

    is_nonnegative = True

    def doit(self, **options: object) -> sympy.Expr:
        x, y = components_of(self.args[0])
        return sympy.sqrt(x**2 + y**2)


@final
class Direction(VectorNumber):
    """The direction of V [rad], counter-clockwise from the x axis."""

    def doit(self, **options: object) -> sympy.Expr:
        x, y = components_of(self.args[0])
        return sympy.atan2(y, x)


@final
class Dot(VectorNumber):
    """The scalar product of two vectors [m2]."""

    def doit(self, **options: object) -> sympy.Expr:
        (a, b), (c, d) = map(components_of, self.args)
        return a * c + b * d


@final
class Cross(VectorNumber):
    """The z component of the vector product of two vectors [m2]."""

    def doit(self, **options: object) -> sympy.Expr:
        (a, b), (c, d) = map(components_of, self.args)
        return a * d - b * c


@final
class Deg(VectorNumber):
    """An angle written in degrees."""

    is_number = True

    def doit(self, **options: object) -> sympy.Expr:
        return self.args[0] * sympy.pi / 180

    def _eval_evalf(self, prec: int) -> sympy.Expr:
        return self.doit()._eval_evalf(prec)


def explicit(expr: sympy.Basic) -> tuple[sympy.Expr, ...]:
    """Return an expression in scalars and elementary functions: one for a number, two for a vector.

    A vector's components are the symbols `AB.x` and `AB.y`.
    """
    entries = components_of(expr) if getattr(expr, "shape", None) == (2, 1) else (expr.doit(),)
    parts = set().union(*(each.atoms(MatrixElement) for each in entries))
    plain = {part: sympy.Symbol(f"{part.parent.name}.{'xy'[int(part.i)]}", real=True) for part in parts}
    return tuple(each.xreplace(plain) for each in entries)
