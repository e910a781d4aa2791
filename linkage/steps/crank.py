"""A link turned by a drive."""

from __future__ import annotations

from ..errors import DefinitionError
from ..quantities import FRAME_SIDE, Driven, Joint, JointSide, Operand, Quantity, Reference, Where, quantity, spelled
from ..vectors import Vec
from .primitives import Axis, Offset, Turn
from .step import UNBOUND, Assignment, Step


class Crank(Step):
    """A point X at distance PX from P, in the direction `angle` [rad] counter-clockwise from the x axis.

    `A = Crank(O, OA=0.1, angle=phi)` with `phi = Stroke(0, 2 * pi)`.
    """

    P: str
    PX: Quantity = UNBOUND
    parent_letters = arms = ("P",)
    expects = (("P", "point"), ("angle", "quantity"))

    def __init__(self, P: Reference, *, angle: Operand, **lengths: Operand) -> None:
        super().__init__(P, labels=lengths)
        self.angle = quantity(angle)

    def parts(self) -> tuple[Reference, ...]:
        return (*super().parts(), self.angle)

    def in_radians(self) -> tuple[Quantity, ...]:
        return (self.angle,)

    def check(self) -> None:
        super().check()
        if self.angle.is_constant:
            raise DefinitionError(f"{self.sentence()}: a crank needs a driven angle; a fixed point is a Ground, one on a body OnLink.")

    def place(self, where: Where) -> Vec:
        cos, sin = where.turn(self.angle)
        arm = Vec(cos, sin) * where.value(self.PX)
        X: Vec = where.at(self.P) + arm
        return X

    def joints(self) -> tuple[Joint, ...]:
        return (Joint("crank", self.P, JointSide((self.P, self.X)), FRAME_SIDE, "c", drives=(Driven(self.angle, "c"),)),)

    def expansion(self) -> tuple[Assignment, ...]:
        arm = Turn(Axis(), self.angle, length=self.PX)
        return Assignment(self.P + self.X, self.PX), Assignment(self.P + self.X, arm), Assignment(self.X, Offset(self.P, arm))

    def arguments(self) -> list[str]:
        return [*super().arguments(), f"angle={spelled(self.angle, 0, 'angle')}"]
