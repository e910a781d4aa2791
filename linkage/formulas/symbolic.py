"""Scalars of the symbolic reading: SymPy expressions with units that obey NumPy's functions."""

from __future__ import annotations

import operator
from collections.abc import Callable
from fractions import Fraction
from functools import lru_cache, partial, partialmethod
from math import isnan
from typing import ClassVar, NamedTuple, Protocol

import numpy as np
import sympy
from sympy.logic.boolalg import Boolean
from sympy.matrices.expressions.matadd import MatAdd
from sympy.matrices.expressions.matmul import MatMul

from ..errors import DefinitionError
from ..motion import stroke_measure
from ..plan import Plan
from ..program.traced import elementwise
from ..quantities import Tabulated
from ..units import SI, UNITS, deg, unit_or_none
from ..vectors import Operators, Scalar, Vec
from .names import Cross, Deg, Dot, Norm, TurnV

# What an expression measures: lengths, angles, and products of them.


class Unit(NamedTuple):
    """Powers of metre and radian; not `known` where a formula mixes units that it cannot follow."""

    length: Fraction = Fraction(0)
    angle: Fraction = Fraction(0)
    known: bool = True
    named: str = ""

    def times(self, other: Unit) -> Unit:
        """Return the unit of a product."""
        return Unit(self.length + other.length, self.angle + other.angle, self.plain and other.plain)

    def to_the(self, power: Fraction | int) -> Unit:
        """Return the unit of a power."""
        return Unit(self.length * power, self.angle * power, self.plain)

    @property
    def plain(self) -> bool:
        """Whether it is made of metres and radians."""
        return self.known and not self.named

    @property
    def shown_factor(self) -> float:
        """The unit it is shown in, in SI: degrees for an angle."""
        if self == ANGLE:
            return deg
        return UNITS[self.named][0] if self.named else 1.0

    @property
    def text(self) -> str:
        """The unit it is shown in: `m`, `deg`, `rad/m`, or nothing."""
        if self.named or not self.known:
            return self.named
        if self == ANGLE:
            return "deg"
        powers = [("rad", self.angle), ("m", self.length)]
        over, under = (
            "*".join(name if sign * power == 1 else f"{name}{sign * power}" for name, power in powers if sign * power > 0)
            for sign in (1, -1)
        )
        return f"{over or '1'}/{under}" if under else over

    @property
    def si(self) -> str:
        """Its text in SI; an angle stays in degrees."""
        return self.text if not self.named or self.text == "deg" else SI[UNITS[self.named][1]]

    @property
    def si_factor(self) -> float:
        """The unit that numbers in an equation are in, in SI: 1 but for an angle in degrees."""
        return deg if self.text == "deg" else 1.0


NUMBER = Unit()
LENGTH = Unit(Fraction(1))
ANGLE = Unit(angle=Fraction(1))


def unit_named(name: str) -> Unit:
    """Return a unit by its name; a plain number for none. DefinitionError for one that there is not."""
    return Unit(named=unit_or_none(name, "the unit of an equation")) if name else NUMBER


KINDS = {"length": LENGTH, "coordinate": LENGTH, "angle": ANGLE}


def input_units(plan: Plan) -> dict[str, Unit]:
    """Return the unit of each stroke and design variable; a `Dimension` by the place where it is used."""
    units = {name: KINDS.get(stroke_measure(plan, name), NUMBER) for name in plan.strokes}
    for name, entry in plan.table.entries.items():
        used = ANGLE if name in plan.turning else LENGTH if name in plan.spanning else NUMBER
        factor, kind = UNITS[entry.unit] if entry.unit else (1.0, "")
        own = entry.unit and kind != "angle" and (factor != 1.0 or kind != "length")
        units[name] = Unit(named=entry.unit) if own else ANGLE if kind == "angle" else KINDS.get(entry.kind, used)
    return units


DIGITS = 40
"""Numbers are taken as the decimals they are written as."""


def exact_number(value: float) -> sympy.Number:
    """Return a float as an exact integer or as the decimal it is written as."""
    return sympy.Integer(int(value)) if value == int(value) and abs(value) < 1e15 else sympy.Float(repr(value), DIGITS)


def degrees(value: float) -> sympy.Expr:
    """Return an angle [rad] as it is shown, in degrees; 0 stays 0."""
    shown = float(f"{value / deg:.13g}")
    return Deg(exact_number(shown)) if value else sympy.S.Zero


class Term(Operators["Term | float", "Term"]):
    """An expression and its unit; adds, multiplies and takes NumPy's functions, as the rules of quantities ask."""

    def __init__(self, expr: sympy.Expr, unit: Unit = NUMBER) -> None:
        self.expr, self.unit = expr, unit

    def as_angle(self) -> Term:
        """Return a plain number as an angle in degrees."""
        if self.unit == NUMBER and (self.expr.is_Float or self.expr.is_Integer):
            return Term(degrees(float(self.expr)), ANGLE)
        return self

    def applied(self, function: str, *operands: Term | float) -> Term:
        """Apply NumPy's function of that name to terms and numbers."""
        return FUNCTIONS[function](*map(term, operands))

    def __array_ufunc__(self, ufunc: np.ufunc, method: str, *inputs: Term | float, **options: object) -> Term:
        if method != "__call__" or options or ufunc.__name__ not in FUNCTIONS:
            raise DefinitionError(f"{ufunc.__name__} has no symbolic form; use one of: {', '.join(FUNCTIONS)}.")
        found: Term = elementwise(lambda *numbers: self.applied(ufunc.__name__, *numbers), inputs)
        return found

    def _compared(self, sign: Callable[[sympy.Expr, sympy.Expr], Boolean], other: Term | float) -> Relation:
        return Relation(sign(self.expr, term(other).expr))

    __lt__, __le__ = partialmethod(_compared, operator.lt), partialmethod(_compared, operator.le)
    __gt__, __ge__ = partialmethod(_compared, operator.gt), partialmethod(_compared, operator.ge)

    def __repr__(self) -> str:
        return f"{self.expr} {self.unit.text}".strip()


def term(value: Scalar) -> Term:
    """Return a number as a term."""
    return value if isinstance(value, Term) else Term(exact_number(float(value)))


class Relation:
    """A comparison of terms: np.where chooses by it. A test by np.any is of input that is refused, and taken to be in order."""

    __array_ufunc__ = None

    def __init__(self, truth: Boolean) -> None:
        self.truth = truth

    def __and__(self, other: Relation | bool) -> Relation:
        return Relation(sympy.And(self.truth, other.truth if isinstance(other, Relation) else bool(other)))

    def __or__(self, other: Relation | bool) -> Relation:
        return Relation(sympy.Or(self.truth, other.truth if isinstance(other, Relation) else bool(other)))

    __rand__, __ror__ = __and__, __or__

    def __invert__(self) -> Relation:
        return Relation(sympy.Not(self.truth))

    def __array_function__(self, function: Callable[..., object], types: object, args: tuple[Scalar, ...], options: object) -> Scalar:
        if function in (np.any, np.all):
            return function is np.all
        if function is not np.where or options or len(args) != 3 or not isinstance(args[0], Relation):
            raise DefinitionError(f"np.{function.__name__} of a comparison has no symbolic form; np.where chooses by one.")
        return elementwise(lambda a, b: Term(sympy.Piecewise((term(a).expr, self.truth), (term(b).expr, True))), args[1:])

    def __bool__(self) -> bool:
        raise DefinitionError("A comparison in an `if` has no symbolic form; np.where chooses by one.")


def as_number(function: Callable[..., sympy.Expr]) -> Callable[..., Term]:
    """Return a function of numbers and angles whose value is a plain number."""
    return lambda *terms: Term(function(*(each.expr for each in terms)))


def keeping_unit(function: Callable[..., sympy.Expr]) -> Callable[..., Term]:
    """Return a function whose value has the unit of its arguments."""
    return lambda *terms: Term(function(*(each.expr for each in terms)), max(terms, key=lambda each: each.unit != NUMBER).unit)


def sum_of(a: Term, b: Term, sign: int = 1) -> Term:
    """Return a sum, or a difference by the sign -1; a plain number beside an angle is one in degrees."""
    if ANGLE in (a.unit, b.unit):
        a, b = a.as_angle(), b.as_angle()
    return Term(a.expr + sign * b.expr, b.unit if a.unit == NUMBER else a.unit)


def power_of(a: Term, b: Term) -> Term:
    """Return a power; of an exponent that is no number the unit is not known."""
    power = Fraction(str(b.expr)) if b.expr.is_Integer or b.expr.is_Float else Fraction(0)
    exact = sympy.Rational(1, 2) if b.expr == sympy.Float(0.5) else b.expr
    return Term(a.expr**exact, a.unit.to_the(power))


def quotient_of(a: Term, b: Term) -> Term:
    """Return a quotient."""
    return Term(a.expr / b.expr, a.unit.times(b.unit.to_the(-1)))


FUNCTIONS: dict[str, Callable[..., Term]] = {
    "add": sum_of,
    "subtract": partial(sum_of, sign=-1),
    "multiply": lambda a, b: Term(a.expr * b.expr, a.unit.times(b.unit)),
    "divide": quotient_of,
    "true_divide": quotient_of,
    "power": power_of,
    "negative": lambda a: Term(-a.expr, a.unit),
    "sqrt": lambda a: Term(sympy.sqrt(a.expr), a.unit.to_the(Fraction(1, 2))),
    "square": lambda a: a**2,
    "hypot": lambda a, b: (a**2 + b**2) ** 0.5,
    "sin": as_number(sympy.sin),
    "cos": as_number(sympy.cos),
    "tan": as_number(sympy.tan),
    "exp": as_number(sympy.exp),
    "log": as_number(sympy.log),
    "sign": as_number(sympy.sign),
    "arctan2": lambda y, x: Term(sympy.atan2(y.expr, x.expr), ANGLE),
    "absolute": keeping_unit(sympy.Abs),
    "minimum": keeping_unit(sympy.Min),
    "maximum": keeping_unit(sympy.Max),
}


# Tabulated functions: a name in the equations, polynomials of its pieces when they are written out.


class CurveFunction(sympy.Function):  # type: ignore[misc]
    """A tabulated function, or a derivative of it, by its name."""

    nargs = 1
    is_real = True
    curve: ClassVar[Tabulated]
    order: ClassVar[int]

    def fdiff(self, argindex: int = 1) -> sympy.Expr:
        return curve_function(self.curve, self.order + 1)(self.args[0])

    def doit(self, **options: object) -> sympy.Expr:
        return self.curve.value(Term(self.args[0].doit()), self.order, either, within_half_a_turn).expr


@lru_cache(maxsize=256)
def curve_function(curve: Tabulated, order: int) -> type[CurveFunction]:
    """Return the function that a table, or its derivative of an order, is in SymPy: `lift`, `lift'`."""
    return type(curve.name + "'" * order, (CurveFunction,), {"curve": curve, "order": order})


def either(a: Term | float, b: Term | float, x: Term | float, y: Term | float) -> Term:
    """Return x where a <= b, else y."""
    value, other = (sympy.nan if isinstance(each, float) and isnan(each) else term(each).expr for each in (x, y))
    return Term(sympy.Piecewise((value, term(a).expr <= term(b).expr), (other, True), evaluate=False))


def within_half_a_turn(angle: Term) -> Term:
    """Return an angle [rad] within half a turn, as a plain number."""
    return Term(sympy.atan2(sympy.sin(angle.expr), sympy.cos(angle.expr)))


# Points and vectors of the symbolic reading: SymPy vectors that obey the plane's algebra, as the rules of steps ask.


class VectorReading(Protocol):
    """The vectors of a place: the listing implements it."""

    def between(self, P: str, Q: str) -> sympy.MatrixExpr:
        """Return the vector PQ."""

    def link(self, P: str, Q: str) -> Term | None:
        """Return the length of the link PQ; None without a link."""


class Place:
    """A point, a vector or a direction. Its expression is asked for when it is first needed, so that nothing idle is written."""

    def __init__(
        self, written: Callable[[], sympy.MatrixExpr], reading: VectorReading, points: tuple[str, ...] = (), unit: Unit = LENGTH
    ) -> None:
        self._written, self._reading, self._points, self.unit = written, reading, points, unit

    @property
    def expr(self) -> sympy.MatrixExpr:
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

    def _like(self, written: Callable[[], sympy.MatrixExpr], unit: Unit | None = None) -> Place:
        return Place(written, self._reading, unit=unit or self.unit)

    def __add__(self, other: Place | Vec) -> Place:
        return self._like(lambda: MatAdd(self.expr, vector_expr(other)))

    def __sub__(self, other: Place | Vec) -> Place:
        if isinstance(other, Place) and len(self._points) == len(other._points) == 1:
            P, Q = other._points[0], self._points[0]
            return Place(lambda: self._reading.between(P, Q), self._reading, (P, Q))
        return self._like(lambda: MatAdd(self.expr, MatMul(-1, vector_expr(other))))

    def __neg__(self) -> Place:
        return self._like(lambda: MatMul(-1, self.expr))

    def __mul__(self, factor: Term | float) -> Place:
        scale = term(factor)
        return self._like(lambda: self.expr if scale.expr == 1 else MatMul(scale.expr, self.expr), self.unit.times(scale.unit))

    def dot(self, other: Place | Vec) -> Term:
        """Return the scalar product."""
        return Term(Dot(self.expr, vector_expr(other)), self.unit.times(vector_unit(other)))

    def cross(self, other: Place | Vec) -> Term:
        """Return the z component of the vector product."""
        return Term(Cross(self.expr, vector_expr(other)), self.unit.times(vector_unit(other)))

    def left(self) -> Place:
        """Return this vector turned by +90 degrees."""
        return self._like(lambda: TurnV(self.expr, Deg(90)))

    def turned(self, cos: Term | float, sin: Term | float) -> Place:
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


def vector_expr(given: Place | Vec) -> sympy.MatrixExpr:
    """Return a vector as SymPy's: that of a place, or of two components that a step's rule has put together."""
    return given.expr if isinstance(given, Place) else sympy.ImmutableMatrix([term(given.x).expr, term(given.y).expr])


def vector_unit(given: Place | Vec) -> Unit:
    """Return the unit of a vector; of two plain numbers a number."""
    return given.unit if isinstance(given, Place) else term(given.x).unit
