"""What each primitive is written as; any other step by its own rule, in components."""

from __future__ import annotations

from functools import singledispatch
from typing import Any

import sympy

from ..quantities import Member, Quantity
from ..steps import CosineAngle, Ground, Guide, Offset, Point, Turn
from ..steps.expansion import Axis
from .term import Term, term
from .units import ANGLE
from .words import Tcos, TurnV, TurnVL, vector_symbol

X_AXIS = vector_symbol("i")
"""The unit vector of the x axis."""


@singledispatch
def written(member: Member, reading: Any) -> Any:
    """Return what a member equals: a SymPy vector, or a term for a quantity."""
    raise NotImplementedError(f"{type(member).__name__} has no symbolic form")


@written.register
def _(member: Quantity, reading: Any) -> Term:
    return term(member.rule(reading))


@written.register
def _(member: CosineAngle, reading: Any) -> Term:
    return Term(Tcos(*(reading.value(side).expr for side in member.triangle)), ANGLE)


@written.register
def _(member: Axis, reading: Any) -> Any:
    return X_AXIS


@written.register
def _(member: Turn, reading: Any) -> Any:
    length = None if member.scaled_to is None else reading.scaled(member, member.scaled_to)
    base, angle = reading.arrow(member.base), reading.value(member.angle).as_angle()
    return TurnV(base, angle.expr) if length is None else TurnVL(base, angle.expr, length.expr)


@written.register
def _(member: Ground, reading: Any) -> Any:
    """Return the coordinates where one of them is a formula; None for plain numbers, which are given."""
    place = member.place(reading)
    formula = any(not value.is_constant for _, value in member.coordinates())
    return sympy.ImmutableMatrix([term(place.x).expr, term(place.y).expr]) if formula else None


@written.register
def _(member: Guide, reading: Any) -> Any:
    """Return the guide's direction, of length one."""
    if member.Q is not None:
        P, Q = member.points
        return TurnVL(reading.between(P, Q), sympy.S.Zero, sympy.S.One)
    fixed = member.angle is None or member.angle.is_constant
    angle = reading.input(f"{member.name}.angle") if fixed else reading.value(member.angle).as_angle()
    return TurnV(X_AXIS, angle.expr)


@written.register
def _(member: Offset, reading: Any) -> Any:
    return reading.at(member.P).expr + reading.arrow(member.by)


@written.register
def _(member: Point, reading: Any) -> Any:
    place: Any = member.place(reading)
    return place.expr
