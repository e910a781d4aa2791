"""A link turned by a drive."""

from __future__ import annotations

from ..errors import DefinitionError
from ..quantities import FRAME_AXES, Driven, Joint, JointSide, Operand, Quantity, Reference, Where, quantity
from ..vectors import Vec
from .primitives import Axis, Offset, Turn
from .step import UNBOUND, Assignment, Position, Step


class Crank(Step):
    """A point X at a distance from P in a given direction: `A = Crank(O, OA=0.1, angle=phi)`.

    Parameters
    ----------
    P : Point or str
        The pivot.
    angle : float or quantity
        The direction PX [rad], counter-clockwise from the x axis; with `at` what turns it from where it is drawn.
    at : tuple of float, optional
        The place (x, y) of X in a drawing [m], from which the length is measured if it is not given.
    **lengths : float or quantity
        The distance PX by its label [m], such as `OA=0.1`.
    """

    P: str
    PX: Quantity = UNBOUND
    parent_letters = arms = ("P",)
    further = radians = ("angle",)
    from_drawing = "turn"
    expects = (("P", "point"), ("angle", "quantity"))
    is_directed = True
    axes = FRAME_AXES
    """The axes that its angle is counted in."""

    def __init__(self, P: Reference, *, angle: Operand, at: Position | None = None, **lengths: Operand) -> None:
        super().__init__(P, labels=lengths, at=at)
        self.angle = quantity(angle)

    def parts(self) -> tuple[Reference, ...]:
        return (*super().parts(), *self.axes.parts())

    def check(self) -> None:
        super().check()
        if self.angle.is_constant:
            raise DefinitionError(f"{self.sentence()}: a crank needs a driven angle; a fixed point is a Ground, one on a body OnLink.")

    def place(self, where: Where) -> Vec:
        arm: Vec = self.axes.vector(where, Vec(*where.turn(self.angle))) * where.value(self.PX)
        return where.at(self.P) + arm

    def joints(self) -> tuple[Joint, ...]:
        drives = (Driven(self.angle, "c", self.axes.sign),)
        return (Joint("crank", self.P, JointSide((self.P, self.X)), JointSide(self.axes.carrier), "c", drives=drives),)

    def expansion(self) -> tuple[Assignment, ...]:
        arm = Turn(Axis(self.axes), -self.angle if self.axes.mirrored else self.angle, length=self.PX)
        name = self.word(self.P, self.X)
        return Assignment(name, self.PX), Assignment(name, arm), Assignment(self.X, Offset(self.P, arm))
