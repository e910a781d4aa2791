"""A link turned by a drive."""

from __future__ import annotations

from typing import Self

from ..errors import DefinitionError
from ..quantities import FRAME_SIDE, Axes, Driven, Joint, JointSide, Operand, Quantity, Reference, Where, quantity, spelled
from ..vectors import Vec
from .primitives import Axis, Offset, Turn
from .step import UNBOUND, Assignment, Position, Step


class Crank(Step):
    """A point X at distance PX from P, in the direction `angle` [rad] counter-clockwise from the x axis.

    `A = Crank(O, OA=0.1, angle=phi)` with `phi = Stroke(0, 2 * pi)`. `Crank(O, at=(x, y), angle=phi)` is drawn: its length is measured
    if it is not given, and the angle turns it from where it is drawn.
    """

    P: str
    PX: Quantity = UNBOUND
    parent_letters = arms = ("P",)
    from_drawing = "turn"
    expects = (("P", "point"), ("angle", "quantity"))
    axes: Axes | None = None
    """The axes that its angle is counted in; None for the frame's."""

    def __init__(self, P: Reference, *, angle: Operand, at: Position | None = None, **lengths: Operand) -> None:
        super().__init__(P, labels=lengths, at=at)
        self.angle = quantity(angle)

    def parts(self) -> tuple[Reference, ...]:
        own = (*super().parts(), self.angle)
        return own if self.axes is None else (*own, *self.axes.parts())

    def in_radians(self) -> tuple[Quantity, ...]:
        return (self.angle,)

    def check(self) -> None:
        super().check()
        if self.angle.is_constant:
            raise DefinitionError(f"{self.sentence()}: a crank needs a driven angle; a fixed point is a Ground, one on a body OnLink.")

    def in_axes(self, axes: Axes) -> Self:
        return self if axes.are_upright else self.renewed(axes=axes.within(self.axes))

    def place(self, where: Where) -> Vec:
        turned = where.turn(self.angle)
        cos, sin = turned if self.axes is None else self.axes.turn(where, turned)
        arm = Vec(cos, sin) * where.value(self.PX)
        X: Vec = where.at(self.P) + arm
        return X

    def joints(self) -> tuple[Joint, ...]:
        axes = self.axes or Axes()
        by = JointSide(axes.carrier) if axes.carrier else FRAME_SIDE
        return (Joint("crank", self.P, JointSide((self.P, self.X)), by, "c", drives=(Driven(self.angle, "c", axes.sign),)),)

    def expansion(self) -> tuple[Assignment, ...]:
        axes = self.axes or Axes()
        arm = Turn(Axis(self.axes), -self.angle if axes.mirrored else self.angle, length=self.PX)
        name = self.word(self.P, self.X)
        return Assignment(name, self.PX), Assignment(name, arm), Assignment(self.X, Offset(self.P, arm))

    def arguments(self) -> list[str]:
        return [*super().arguments(), f"angle={spelled(self.angle, 0, 'angle')}"]
