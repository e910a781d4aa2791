"""What a composite step stands for: the vector method's primitives, written out."""

from __future__ import annotations

from dataclasses import dataclass
from functools import singledispatch

from ..frozen import refuses_changes
from ..quantities import Member, Number, Where, distance
from ..vectors import Scalar, Side, Vec
from .crank import Crank
from .dyad import Dyad
from .onlink import OnLink
from .primitives import Arrow, CosineAngle, Offset, Turn, Vector
from .step import UNBOUND


@refuses_changes
@dataclass(frozen=True, eq=False)
class Assignment:
    """A name given to a primitive: `OAB = CosineAngle(...)`; to a quantity, it is the label of a length."""

    name: str
    value: Member


class Axis(Arrow):
    """The unit vector of the x axis: what a crank's arm is turned from."""

    def vector(self, where: Where) -> Vec:
        return Vec(1.0, 0.0)

    def length(self, where: Where) -> Scalar:
        return 1.0

    def __str__(self) -> str:
        return "Axis()"


@singledispatch
def expansion(step: Member) -> tuple[Assignment, ...]:
    """Return the primitives that a bound step stands for, in the vector method's order; empty where it has no such spelling."""
    return ()


@expansion.register
def _(step: Dyad) -> tuple[Assignment, ...]:
    base = Vector(step.P, step.Q)
    angle = CosineAngle(distance(step.P, step.Q), step.PX, step.QX)
    arm = Turn(base, angle if step.settled_side is Side.LEFT else -angle, length=step.PX)
    return (
        Assignment(step.P + step.X, step.PX),
        Assignment(step.Q + step.X, step.QX),
        Assignment(step.P + step.Q, base),
        Assignment(step.Q + step.P + step.X, angle),
        Assignment(step.P + step.X, arm),
        Assignment(step.X, Offset(step.P, arm)),
    )


@expansion.register
def _(step: OnLink) -> tuple[Assignment, ...]:
    base = Vector(step.P, step.Q)
    given = Number(0.0) if step.QPX is UNBOUND else step.QPX
    by_sides = step.QX is not UNBOUND
    angle = CosineAngle(distance(step.P, step.Q), step.PX, step.QX) if by_sides else given
    arm = Turn(base, -angle if step.side is Side.RIGHT else angle, length=step.PX)
    lengths = (Assignment(step.P + step.X, step.PX), Assignment(step.Q + step.X, step.QX))
    return (
        *lengths[: 2 if by_sides else 1],
        Assignment(step.P + step.Q, base),
        Assignment(step.X + step.P + step.Q if by_sides else step.Q + step.P + step.X, angle),
        Assignment(step.P + step.X, arm),
        Assignment(step.X, Offset(step.P, arm)),
        *([Assignment(step.Q + step.X, Vector(step.Q, step.X))] if by_sides else []),
    )


@expansion.register
def _(step: Crank) -> tuple[Assignment, ...]:
    arm = Turn(Axis(), step.angle, length=step.PX)
    return (
        Assignment(step.P + step.X, step.PX),
        Assignment(step.P + step.X, arm),
        Assignment(step.X, Offset(step.P, arm)),
    )
