"""The mechanism read symbolically: one line for each primitive, in the vector method's order."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Any, NamedTuple, cast

import numpy as np
import sympy

from ..motion import Motion
from ..plan import Plan
from ..quantities import FRAME_AXES, AtPose, Axes, Quantity, Variable, source_text
from ..quantities.member import Member, Reference, Tabulated, Turning, Where, joined_names, name_of
from ..steps import Arrow, Assignment, Axis, CosineAngle, Group, Guide, Offset, Point, Turn, Vector
from ..vectors import FloatArray, Line, Numbers, Vec
from .names import Direction, Norm, SymbolNames, Tcos, TurnV, TurnVL, explicit, vector_symbol
from .printing import Text
from .symbolic import ANGLE, FUNCTIONS, LENGTH, NUMBER, Place, Term, Unit, curve_function, input_units, term, vector_expr

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
            return self._lengths.get(source_text(member)) or symbolic_value(member, self)
        if key not in self._terms:
            found: Term = symbolic_value(member, self)
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
