"""The mechanism read symbolically: one line for each primitive, in the vector method's order."""

from __future__ import annotations

import operator
from collections.abc import Callable, Iterable, Mapping
from fractions import Fraction
from functools import lru_cache, partial, partialmethod
from math import isnan
from typing import Any, ClassVar, NamedTuple, cast

import numpy as np
import sympy
from sympy.logic.boolalg import Boolean
from sympy.matrices.expressions.matadd import MatAdd
from sympy.matrices.expressions.matmul import MatMul

from ..errors import DefinitionError
from ..loads import ForceElement
from ..motion import Motion, stroke_measure
from ..plan import Plan
from ..program.traced import elementwise
from ..quantities import FRAME_AXES, AtPose, Axes, Quantity, Variable, source_text
from ..quantities.member import Member, Reference, Tabulated, Turning, Where, joined_names, name_of
from ..steps import Arrow, Assignment, Axis, CosineAngle, Group, Guide, Offset, Point, Turn, Vector
from ..units import SI, UNITS, deg, unit_or_none
from ..vectors import FloatArray, Line, Numbers, Operators, Scalar, Vec
from .names import Cross, Deg, Direction, Dot, Norm, SymbolNames, Tcos, TurnV, TurnVL, explicit, vector_symbol
from .printing import Text

# Scalars of the symbolic reading: SymPy expressions with units that obey NumPy's functions.

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

    def as_measure(self, unit: Unit) -> Term:
        """Return it as what no angle is, such as a length along a line: an angle times a lever is one, and so is a number beside it."""
        if self.unit != ANGLE:
            return self
        own = {each: exact_number(float(f"{float(each.args[0]) * deg:.12g}")) for each in self.expr.atoms(Deg)}
        parts = (each.as_coeff_Mul() for each in sympy.Add.make_args(self.expr))
        return Term(sympy.Add(*(sign * own.get(each, each) for sign, each in parts)), unit)

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


class Place:
    """A point, a vector or a direction. Its expression is asked for when it is first needed, so that nothing idle is written."""

    def __init__(
        self, written: Callable[[], sympy.MatrixExpr], reading: Listing, points: tuple[str, ...] = (), unit: Unit = LENGTH
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
        scale = term(factor).as_measure(LENGTH) if self.unit == NUMBER else term(factor)
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


# What each primitive is written as; any other step by its own rule, in components.

X_AXIS = vector_symbol("i")
"""The unit vector of the x axis."""


def symbolic_value(member: Member, reading: Listing) -> Any:
    """Return a member as a formula: a SymPy vector, or a term for a quantity; None for a point of plain coordinates."""
    match member:
        case CosineAngle():
            return Term(Tcos(*(reading.value(side).expr for side in member.triangle)), ANGLE)
        case Quantity():
            return term(member.rule(reading))
        case Axis():
            return x_axis_of(member.axes, reading)
        case Turn():
            length = None if member.scaled_to is None else reading.scaled(member, member.scaled_to)
            base, angle = reading.arrow_line(member.base), reading.value(member.angle).as_angle()
            return TurnV(base, angle.expr) if length is None else TurnVL(base, angle.expr, length.expr)
        case Guide(Q=None):
            own = None if member.angle is None or member.angle.is_constant else member.angle
            angle = reading.input(f"{member.name}.angle") if own is None else reading.value(own).as_angle()
            return TurnV(x_axis_of(member.axes, reading), (-1 if member.axes.mirrored else 1) * angle.expr)
        case Guide():
            P, Q = member.points
            return TurnVL(reading.between(P, Q), sympy.S.Zero, sympy.S.One)
        case Offset():
            return reading.at(member.P).expr + reading.arrow_line(member.by)
        case Point():
            place, given = member.place(reading), member.coordinates()
            if not given or not getattr(member, "axes", FRAME_AXES).is_frame:
                return vector_expr(place)
            is_formula = any(not value.is_constant for _, value in given)
            return sympy.ImmutableMatrix([term(place.x).expr, term(place.y).expr]) if is_formula else None
    raise NotImplementedError(f"{type(member).__name__} has no symbolic form")


def x_axis_of(axes: Axes, reading: Listing) -> sympy.MatrixExpr:
    """Return the x axis; of a part its own one, along its carrier, mirrored and turned as the part is."""
    along = TurnVL(reading.between(*axes.carrier), sympy.S.Zero, sympy.S.One) if axes.carrier else X_AXIS
    own = -along if axes.mirrored else along
    return own if axes.is_level else TurnV(own, reading.value(axes.angle).as_angle().expr)


# A line of the listing: what stands for what.


class ListingLine(NamedTuple):
    """One line: a symbol, its formula, and its unit."""

    lhs: sympy.Basic
    rhs: sympy.Basic
    unit: Unit

    @property
    def name(self) -> str:
        """The text of the left side."""
        return str(Text().doprint(self.lhs))


class GivenNumber(NamedTuple):
    """A symbol that no line gives, its value at the poses of a motion [SI], and its unit."""

    symbol: sympy.Symbol | sympy.MatrixSymbol
    value: Callable[[Motion], Numbers]
    unit: Unit

    def parts(self, motion: Motion) -> dict[sympy.Symbol, FloatArray]:
        """Return the plain symbols with their values at the poses of a motion."""
        value = np.asarray(self.value(motion))
        return dict(zip(explicit(self.symbol), value if self.symbol.is_Matrix else (value,), strict=True))


class Listing(Where):
    """A reading (see `linkage.quantities.Where`) whose scalars are terms; asking for a member writes its lines first."""

    def __init__(self, plan: Plan) -> None:
        self.plan, self.names, self.units = plan, SymbolNames(plan), input_units(plan)
        self.lines: list[ListingLine] = []
        self.unknowns: list[str] = []
        self.givens: list[GivenNumber] = []
        self._vectors: dict[object, sympy.MatrixExpr] = {}
        self._terms: dict[str | int, Term] = {}
        self._labels: dict[int, Assignment] = {}
        given = (each.given(name) for each in plan.of_kind(ForceElement).values() for name in each.numbers)
        self._of_loads = {name_of(each, is_needed=False) or id(each) for each in given if isinstance(each, (str, Quantity))}
        self._kept: list[Assignment] = []
        self._lengths: dict[str, Term] = {}

    def write_members(self, order: Iterable[str]) -> None:
        """Write every member: points and outputs in the order given, vectors and angles where they are first needed."""
        left = [name for name in order if name in self.plan.members]  # of a list of parts the steps made of it come last
        left += [name for name in self.plan.members if name not in left]
        while left:
            name, *left = left
            member = self.plan.members[name]
            if isinstance(member, Point) or not any(name in self.plan.reaches(later) for later in left):
                if isinstance(member, Quantity):
                    self.value(name)
                elif isinstance(member, (Point, Arrow)):
                    self.symbol_of(name)

    # -- points and vectors ----------------------------------------------------------------------------

    def at(self, point: Reference) -> Place:  # type: ignore[override]
        """Return a point."""
        name = name_of(point)
        group = next((each for each in self.plan.groups.values() if name in each.pins), None)
        if name not in self._vectors and group is not None:
            self._group(group)
        elif name not in self._vectors:
            step = self.plan.points[name]
            assignments = step.expansion() or (Assignment(name, step),)
            self._kept.extend(assignments)
            for each in assignments:
                self.assign(each)
                if isinstance(each.value, Offset):
                    self._vectors.setdefault((name_of(each.value.P), name), self.arrow_line(each.value.by))
        return Place(lambda: self._vectors[name], self, (name,))

    def _group(self, group: Group) -> None:
        """Write the conditions of pins that are found together: the lengths of rods, the shapes of links, the slides."""
        self.unknowns += group.pins
        self._vectors |= {pin: self.names.vector(pin) for pin in group.pins}
        for rod in group.rods:
            length = self.value(rod.length)
            self.lines.append(ListingLine(Norm(self.between(rod.P, rod.Q)), length.expr, LENGTH))
        for step in group.rigid:
            for each in step.expansion():
                self._kept.append(each)
                self.assign(each)
        for slide in group.slides:
            (miss,) = slide.constraints(self)
            self.lines.append(ListingLine(miss.expr, sympy.S.Zero, LENGTH))

    def assign(self, each: Assignment) -> None:
        """Write one primitive of a step's expansion."""
        if isinstance(each.value, Quantity):
            if not each.value.name and not isinstance(each.value, Variable):
                self._labels.setdefault(id(each.value), each)
                self.value(each.value)
        elif isinstance(each.value, Vector):
            self.between(name_of(each.value.P), name_of(each.value.Q), each.name)
        else:
            key = each.name if isinstance(each.value, Point) else id(each.value)
            self.define(key, self.names.vector(each.name), symbolic_value(each.value, self), LENGTH)

    def define(self, key: object, symbol: sympy.MatrixExpr, rhs: sympy.Basic | None, unit: Unit) -> None:
        """Write a line; nothing is written for a fixed point of plain coordinates."""
        self._vectors[key] = symbol
        if rhs is not None:
            self.lines.append(ListingLine(symbol, rhs, unit))

    def between(self, P: str, Q: str, called: str = "") -> sympy.MatrixExpr:
        """Return the vector PQ, written as Q - P where it is not known yet, by the name that a step has for it if it has one."""
        if (P, Q) not in self._vectors:
            vectors = self.plan.of_kind(Vector).items()
            declared = next((name for name, each in vectors if (name_of(each.P), name_of(each.Q)) == (P, Q)), called or joined_names(P, Q))
            ends = self.at(Q).expr - self.at(P).expr
            self.define((P, Q), self.names.vector(declared), ends, LENGTH)
        return self._vectors[P, Q]

    def arrow_line(self, vector: Reference) -> sympy.MatrixExpr:
        """Return a vector member as its symbol; one without a name written out."""
        named = name_of(vector, is_needed=False)
        member = self.plan.members[named] if named else cast(Member, vector)
        if isinstance(member, Vector):
            return self.between(name_of(member.P), name_of(member.Q))
        key = named or id(member)
        if key not in self._vectors:
            if not named:
                return symbolic_value(member, self)
            self.define(key, self.names.vector(named), symbolic_value(member, self), LENGTH)
        return self._vectors[key]

    def vector(self, vector: Reference) -> Place:  # type: ignore[override]
        """Return a vector member."""
        return Place(lambda: self.arrow_line(vector), self)

    @property
    def fixed_guides(self) -> list[str]:
        """The guides whose origin is given."""
        return [name for name, guide in self.plan.of_kind(Guide).items() if guide.P is None and guide.axes.is_frame]

    @property
    def given_points(self) -> list[str]:
        """The points that the lines start from: fixed ones, guides' origins, and pins that are found together."""
        return [*self.plan.ground, *self.fixed_guides, *self.unknowns]

    def symbol_of(self, name: str) -> sympy.Basic:
        """Return the symbol of a named point, vector or quantity."""
        if isinstance(self.plan.members[name], Quantity):
            return self.names.quantity(name)
        return self.arrow_line(name) if isinstance(self.plan.members[name], Arrow) else self.at(name).expr

    # -- quantities ------------------------------------------------------------------------------------

    def value(self, quantity: Reference) -> Term:
        """Return a quantity: its symbol where it has a name or a label."""
        named = name_of(quantity, is_needed=False)
        member = cast(Quantity, self.plan.members[named] if named else quantity)
        if named in self.units:
            return self.input(named)
        key = named or id(member)
        if not named and key not in self._labels:
            return self._lengths.get(source_text(member)) or self.written(member, key)
        if key not in self._terms:
            found = self.written(member, key)
            if named or not found.expr.is_Atom:
                if named:
                    symbol = self.names.quantity(named)
                else:
                    label = self._labels[id(member)].name
                    symbol = self.names.scalar(label, "angle") if found.unit == ANGLE else self.names.length(label)
                self.lines.append(ListingLine(symbol, found.expr, found.unit))
                found = Term(symbol, found.unit)
            self._terms[key] = found
        return self._terms[key]

    def written(self, member: Quantity, key: str | int) -> Term:
        """Return a quantity written out; what a load is given, such as a moment that follows an angle, is no angle."""
        found: Term = symbolic_value(member, self)
        return found.as_measure(NUMBER) if key in self._of_loads else found

    def scaled(self, arrow: Member, length: Quantity) -> Term:
        """Return the length a vector is scaled to; an expression gets the vector's name: L_AB = L0 + S."""
        if arrow.name and not length.name and id(length) not in self._labels:
            self._labels[id(length)] = Assignment(arrow.name, length)
            self._lengths[source_text(length)] = self.value(length)
        return self.value(length)

    def turn(self, angle: Reference) -> Turning:
        """Return the cosine and sine of an angle."""
        found = self.value(angle).as_angle()
        return FUNCTIONS["cos"](found), FUNCTIONS["sin"](found)

    def input(self, name: str) -> Term:
        """Return the symbol of a stroke, a dimension or a coordinate."""
        return Term(self.names.quantity(name), self.units[name])

    def at_pose(self, quantity: Reference, strokes: Mapping[str, float]) -> Term:
        """Return the symbol of a quantity at one pose of the strokes: a given number."""
        found = AtPose(cast(Quantity, quantity), strokes)
        symbol = self.names.scalar(f"{joined_names(*map(name_of, found.of.parts()))}_0")
        self.givens.append(GivenNumber(symbol, lambda motion: motion.value(found), LENGTH))
        return Term(symbol, LENGTH)

    # -- what the rules of other steps ask -------------------------------------------------------------

    def line(self, guide: Reference) -> Line:
        """Return a guide's line."""
        name = name_of(guide)
        member = self.plan.members[name]
        assert isinstance(member, Guide)
        if ("line", name) not in self._vectors:
            self.define(("line", name), self.names.direction_symbol(name), symbolic_value(member, self), NUMBER)
        along = Place(lambda: self._vectors["line", name], self, unit=NUMBER)
        if member.P is None and not member.axes.is_frame and ("origin", name) not in self._vectors:
            place = member.axes.place(self, Vec(self.input(f"{name}.x"), self.input(f"{name}.y")))
            self.define(("origin", name), self.names.vector(name), sympy.ImmutableMatrix([term(place.x).expr, term(place.y).expr]), LENGTH)
        start = Place(lambda: self.names.vector(name), self) if member.P is None else self.at(member.P)
        return Line(start, along)  # type: ignore[arg-type]

    def curve(self, curve: Tabulated, x: Term, order: int = 0) -> Term:
        """Return the value of a table, by its name."""
        return Term(curve_function(curve, order)(term(x).expr))

    def angle_of(self, vector: Place | Vec) -> Term:
        """Return a vector's direction."""
        return Term(Direction(vector_expr(vector)), ANGLE)

    def followed(self, angle: str, vector: Place | Vec) -> None:
        """Return nothing: an angle is written the same, wherever it is counted from."""

    def link(self, P: str, Q: str) -> Term | None:
        """Return the given length of a link, or None where no label gives it."""
        known = self.plan.table.lengths.get(frozenset((P, Q)))
        return None if known is None else self.value(known)

    def link_length(self, P: str, Q: str) -> Term:
        """Return the distance of two points."""
        return self.link(P, Q) or Term(Norm(self.between(P, Q)), LENGTH)

    def direction(self, P: str, Q: str) -> Place:  # type: ignore[override]
        """Return the vector between two points."""
        return self.at(Q) - self.at(P)

    def vector_length(self, vector: Reference) -> Term:
        """Return the length of a vector member."""
        return Term(Norm(self.arrow_line(vector)), LENGTH)
