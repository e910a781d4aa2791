"""The class II dyads with sliding pairs: RRP, RPR, PRP and RPP."""

from __future__ import annotations

from ..quantities import Joint, JointSide, Operand, Quantity, Reference, Where, guided, quantity
from ..vectors import Line, Scalar, Side, Vec
from .step import UNBOUND, Position, Step, angle_given


class SliderDyad(Step):
    """A pin on a guide at a distance from P (RRP dyad): `C = SliderDyad(A, rail, AC=0.4, side=RIGHT)`.

    Parameters
    ----------
    P : Point or str
        The other end of its link.
    guide : Guide or str
        The guide.
    side : Side or str, optional
        RIGHT is the solution farther along the guide's direction, LEFT the other one.
    near : tuple of float, optional
        Instead of the side, its place (x, y) in a sketch [m].
    **lengths : float or quantity
        The distance from P by its label [m], such as `AC=0.4`.
    """

    P: str
    guide: str
    PX: Quantity = UNBOUND
    parent_letters = ("P", "guide")
    closes = True
    arms = ("P",)
    chooses = "a circle meets a line in two points"
    orientation = -1.0
    expects = (("P", "point"), ("guide", "guide"))

    def __init__(
        self, P: Reference, guide: Reference, *, side: Side | str | None = None, near: Position | None = None, **lengths: Operand
    ) -> None:
        super().__init__(P, guide, labels=lengths, side=side, near=near)

    def place(self, where: Where) -> Vec:
        line, p = where.line(self.guide), where.value(self.PX)
        away = where.at(self.P) - line.origin
        offset = line.direction.cross(away)
        reach = where.root(p * p - offset * offset, scale=p, size=p * p)
        return line.at(line.direction.dot(away) - float(self.settled_side) * reach)

    def constraints(self, where: Where) -> tuple[Scalar, ...]:
        X, line, p = where.at(self.X), where.line(self.guide), where.value(self.PX)
        return ((X - where.at(self.P)).square() - p * p) * 0.5, line.direction.cross(X - line.origin)

    def meeting(self, where: Where) -> tuple[Vec, ...]:
        return where.at(self.P) - where.at(self.X), where.line(self.guide).direction.left()

    def shortage(self, where: Where) -> tuple[str, Scalar]:
        line = where.line(self.guide)
        gap = abs(line.direction.cross(where.at(self.P) - line.origin)) - where.value(self.PX)
        return f"{self.P}{self.X} does not reach from {self.P} to {self.guide}", gap

    def joints(self) -> tuple[Joint, ...]:
        return (guided(self.X, self.guide),)


class PinSlotDyad(Step):
    """A point X of a body that turns about P while its slot glides over the pin Q (RPR dyad): `R = PinSlotDyad(O, A, OR=0.5)`.

    Parameters
    ----------
    P : Point or str
        The pivot of the body.
    Q : Point or str
        The pin in its slot.
    offset : float or quantity, optional
        The distance [m] of the slot, which is parallel to P -> X, to the left; 0, through P, by default.
    side : Side or str, optional
        RIGHT, the default: Q lies ahead of P along P -> X; LEFT: behind it.
    near : tuple of float, optional
        Instead of the side, the place (x, y) of X in a sketch [m].
    **lengths : float or quantity
        The distance of X from P by its label [m], such as `OR=0.5`.
    """

    P: str
    Q: str
    PX: Quantity = UNBOUND
    closes = True
    arms = ("P",)
    further = handed = ("offset",)
    chooses = "its pin may lie ahead of P or behind it"
    orientation = 1.0
    expects = (("P", "point"), ("Q", "point"))

    def __init__(
        self, P: Reference, Q: Reference, *, offset: Operand = 0.0, side: Side | str | None = None,
        near: Position | None = None, **lengths: Operand,
    ) -> None:
        super().__init__(P, Q, labels=lengths, side=Side.RIGHT if side is None and near is None else side, near=near)
        self.offset = quantity(offset)

    def place(self, where: Where) -> Vec:
        P, to_pin, e = where.at(self.P), where.direction(self.P, self.Q), where.value(self.offset)
        d2 = to_pin.square()
        along = where.root(d2 - e * e, scale=d2**0.5, size=d2) * -float(self.settled_side)
        scale = where.value(self.PX) / d2
        return P + to_pin.turned(along * scale, -e * scale)

    def constraints(self, where: Where) -> tuple[Scalar, ...]:
        to_X, to_pin = where.at(self.X) - where.at(self.P), where.at(self.Q) - where.at(self.P)
        p, e = where.value(self.PX), where.value(self.offset)
        return (to_X.square() - p * p) * 0.5, to_X.cross(to_pin) / p - e

    def meeting(self, where: Where) -> tuple[Vec, ...]:
        P = where.at(self.P)
        return where.at(self.Q) - P, (where.at(self.X) - P).left()

    def shortage(self, where: Where) -> tuple[str, Scalar]:
        gap = abs(where.value(self.offset)) - (where.at(self.Q) - where.at(self.P)).length()
        return f"the slot's offset is larger than the distance {self.P}{self.Q}", gap

    def joints(self) -> tuple[Joint, ...]:
        on, by, still = JointSide((self.Q,), "runner"), JointSide((self.P, self.X)), ((self.offset, f"{self.sentence()}: its offset"),)
        return (Joint("guide", self.Q, on, by, "n", self.slot, tuple(sorted((self.P, self.X))), still=still),)

    def slot(self, where: Where) -> Line:
        """Return the line the pin slides on: parallel to P -> X, at the offset to its left.

        Parameters
        ----------
        where : Where
            The reading: places of points and values of quantities.

        Returns
        -------
        Line
            The line.
        """
        arm = where.at(self.X) - where.at(self.P)
        along = arm * (1.0 / arm.length())
        return Line(where.at(self.P) + along.left() * where.value(self.offset), along)


class GuideCross(Step):
    """The pin of two sliders, each on its guide (PRP dyad), where the guides cross: `C = GuideCross(rail, post)`.

    Parameters
    ----------
    guide, other : Guide or str
        The guides.
    """

    guide: str
    other: str
    closes = True
    orientation = 1.0
    parent_letters = ("guide", "other")
    expects = (("guide", "guide"), ("other", "guide"))

    def __init__(self, guide: Reference, other: Reference) -> None:
        super().__init__(guide, other, labels={})

    def place(self, where: Where) -> Vec:
        first, second = where.line(self.guide), where.line(self.other)
        sine = where.margin(first.direction.cross(second.direction))
        return first.at((second.origin - first.origin).cross(second.direction) / sine)

    def constraints(self, where: Where) -> tuple[Scalar, ...]:
        X = where.at(self.X)
        lines = where.line(self.guide), where.line(self.other)
        return tuple(line.direction.cross(X - line.origin) for line in lines)

    def meeting(self, where: Where) -> tuple[Vec, ...]:
        return where.line(self.guide).direction, where.line(self.other).direction

    def joints(self) -> tuple[Joint, ...]:
        return guided(self.X, self.guide), guided(self.X, self.other)


class YokeDyad(Step):
    """The point X of a body that slides along a guide while its slot glides over a pin (RPP dyad, Scotch yoke): `X = YokeDyad(A, rail)`.

    X is where the slot meets the guide.

    Parameters
    ----------
    P : Point or str
        The pin in its slot.
    guide : Guide or str
        The guide.
    angle : float or quantity, optional
        The angle of the slot to the guide [rad], a right angle by default.
    """

    P: str
    guide: str
    closes = True
    orientation = 1.0
    parent_letters = ("P", "guide")
    further = radians = handed = ("angle",)
    expects = (("P", "point"), ("guide", "guide"))

    def __init__(self, P: Reference, guide: Reference, *, angle: Operand = 1.5707963267948966) -> None:
        super().__init__(P, guide, labels={})
        self.angle = angle_given(angle, "YokeDyad")

    def place(self, where: Where) -> Vec:
        line, (cos, sin) = where.line(self.guide), where.turn(self.angle)
        away = where.at(self.P) - line.origin
        tangent = cos / where.margin(sin)
        return line.at(line.direction.dot(away) - line.direction.cross(away) * tangent)

    def constraints(self, where: Where) -> tuple[Scalar, ...]:
        X, line, (cos, sin) = where.at(self.X), where.line(self.guide), where.turn(self.angle)
        slot = line.direction.turned(cos, sin)
        return line.direction.cross(X - line.origin), slot.cross(X - where.at(self.P))

    def meeting(self, where: Where) -> tuple[Vec, ...]:
        direction = where.line(self.guide).direction
        return direction, direction.turned(*where.turn(self.angle))

    def joints(self) -> tuple[Joint, ...]:
        own, still = JointSide((self.X,), "slider"), ((self.angle, f"{self.sentence()}: its angle"),)
        by, guide = JointSide((self.guide,), "guide"), self.guide
        return (
            Joint("slider", self.X, own, by, "nc", lambda where: where.line(guide), (guide,)),
            Joint("slot", self.P, own, JointSide((self.P,)), "n", self.slot, (f"{self.X}|slot",), still=still),
        )

    def slot(self, where: Where) -> Line:
        """Return the line of the cross slot.

        Parameters
        ----------
        where : Where
            The reading: places of points and values of quantities.

        Returns
        -------
        Line
            The line.
        """
        return Line(where.at(self.X), where.line(self.guide).direction.turned(*where.turn(self.angle)))
