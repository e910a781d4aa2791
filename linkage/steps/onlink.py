"""A further point of a rigid body."""

from __future__ import annotations

from typing import Self

from ..errors import DefinitionError, ensure
from ..quantities import Axes, Driven, Joint, JointSide, Number, Quantity, Turning, Where, distance
from ..vectors import Line, Scalar, Side, Vec
from .labels import Slot
from .primitives import CosineAngle, Vector, triangle, turned_from_base
from .step import UNBOUND, Assignment, FromTwo


class OnLink(FromTwo):
    """A point X rigidly on the body of P and Q: `C = OnLink(O, B, OC=0.36, BOC=0.4)`.

    Parameters
    ----------
    P, Q : Point or str
        Two points of the body.
    side : Side or str, optional
        The side of P -> Q on which X lies; the angle is then positive. Without it the angle is counter-clockwise from PQ. X on the line
        PQ has none.
    near : tuple of float, optional
        With the third side QX, instead of the side: the place (x, y) of X in a sketch [m].
    at : tuple of float, optional
        The place (x, y) of X in a drawing [m], from which lengths and angles are measured that are not given.
    **labels : float or quantity
        The distance PX [m], and the angle QPX [rad] or the third side QX [m]. Without angle and third side X lies on the line PQ, beyond P
        towards Q.
    """

    QPX: Quantity = UNBOUND
    is_mirrored: bool = False
    """Whether it stands in a part that is mirrored, so that its side and the sense of its angle are the other ones."""
    from_drawing = "angle"
    expects = (("P", "point"), ("Q", "point"))

    def slots(self) -> tuple[Slot, ...]:
        return Slot("PX", (self.P, self.X)), Slot("QX", (self.Q, self.X)), Slot("QPX", (self.Q, self.P, self.X))

    def check(self) -> None:
        if self.PX is UNBOUND and self.drawn_at is None:
            raise self.missing(self.slots()[0])
        ensure(UNBOUND in (self.PX, self.QX, self.QPX), f"{self.sentence()}: give the third side or the angle, not both.")
        if self.QX is not UNBOUND and self.side is None and self.near is None and self.drawn_at is None:
            raise self.needs_side("a triangle of three sides lies on either side")
        if self.QX is not UNBOUND or self.drawn_at is not None:
            return
        # a side or a place chooses nothing, since the point lies in one way alone
        third, angle = (next(iter(slot.spellings)) for slot in self.slots()[1:])
        if self.QPX is UNBOUND and (self.side is not None or self.near is not None):
            word = "near" if self.side is None else "side"
            why = f"it lies on the line {self.P}{self.Q} without an angle or a third side, and {word}= chooses nothing"
            raise DefinitionError(f"{self.sentence()}: {why}; give {angle} or {third}, or leave {word} out.")
        if self.near is not None:
            why = f"{angle} says where it lies, and near= chooses nothing"
            raise DefinitionError(f"{self.sentence()}: {why}; say side=LEFT or side=RIGHT, or leave near out.")

    def in_radians(self) -> tuple[Quantity, ...]:
        return () if self.QPX is UNBOUND else (self.QPX,)

    def modes(self) -> tuple[Side, ...]:
        return (Side.LEFT, Side.RIGHT) if self.QX is not UNBOUND else ()

    def in_axes(self, axes: Axes) -> Self:
        return self.renewed(is_mirrored=not self.is_mirrored) if axes.mirrored else self

    @property
    def sense_of_turn(self) -> float:
        """The sense in which its angle is counted: 1 counter-clockwise, -1 clockwise."""
        sense = 1.0 if self.side is None else float(self.side)
        return -sense if self.is_mirrored else sense

    def corner(self, where: Where, base: Scalar) -> Turning:
        """Return the cosine and sine of the angle QPX; `base` is the length of PQ [m].

        Parameters
        ----------
        where : Where
            The reading: places of points and values of quantities.
        base : scalar
            The length of PQ [m].

        Returns
        -------
        tuple of scalar
            Cosine and sine.
        """
        sense = self.sense_of_turn
        if self.QX is not UNBOUND:
            p = where.value(self.PX)
            along, height = triangle(where, base * base, p, where.value(self.QX))
            scale = 1.0 / (base * p)
            return along * scale, height * scale * sense
        cos, sin = where.turn(Number(0.0) if self.QPX is UNBOUND else self.QPX)
        return cos, sin * sense

    def place(self, where: Where) -> Vec:
        P, Q = where.at(self.P), where.at(self.Q)
        base = where.link_length(self.P, self.Q)
        cos, sin = self.corner(where, base)
        scale = where.value(self.PX) / base
        return P + (Q - P).turned(cos * scale, sin * scale)

    def sides(self, where: Where) -> tuple[tuple[str, Scalar], ...]:
        return () if self.QX is UNBOUND else self.triangle_sides(where, where.link_length(self.P, self.Q))

    def joints(self) -> tuple[Joint, ...]:
        """Return the joint of an arm that a driven label moves: it holds along the arm, across it and against turning.

        Returns
        -------
        tuple of Joint
            The joints.
        """
        P, Q = self.P, self.Q

        def line(where: Where) -> Line:
            base = where.link_length(P, Q)
            return Line(where.at(P), (where.at(Q) - where.at(P)).turned(*self.corner(where, base)) * (1.0 / base))

        drives = [Driven(self.PX, "t")]
        if self.QPX is not UNBOUND:
            drives.append(Driven(self.QPX, "c", self.sense_of_turn))
        if self.QX is not UNBOUND:
            drives.append(Driven(self.QX, ""))
        on, by = JointSide((self.X,)), JointSide((P, Q))
        still = () if self.QX is UNBOUND else ((self.QX, f"{self.sentence()}: its third side"),)
        return (Joint("telescope", P, on, by, "ntc", line, drives=tuple(drives), arm=True, still=still),)

    def bodies(self) -> tuple[tuple[str, ...], ...]:
        return ((self.P, self.Q, self.X),)

    def expansion(self) -> tuple[Assignment, ...]:
        is_left = self.sense_of_turn > 0.0
        if self.QX is UNBOUND:
            return turned_from_base(self, "P", "QPX", Number(0.0) if self.QPX is UNBOUND else self.QPX, is_left)
        found = turned_from_base(self, "PQ", "XPQ", CosineAngle(distance(self.P, self.Q), self.PX, self.QX), is_left)
        return *found, Assignment(self.word(self.Q, self.X), Vector(self.Q, self.X))
