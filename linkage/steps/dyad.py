"""The joint of two links that hang from two points."""

from __future__ import annotations

from typing import Self

from ..quantities import Axes, Where, distance
from ..vectors import Scalar, Side, Vec
from .primitives import CosineAngle, triangle, turned_from_base
from .step import Assignment, FromTwo


class Dyad(FromTwo):
    """The joint of two links that hang from P and Q (RRR dyad): `B = Dyad(A, O, AB=0.5, OB=0.3, side=RIGHT)`.

    Parameters
    ----------
    P, Q : Point or str
        The points that the links hang from.
    side : Side or str, optional
        The side of P -> Q on which it lies: the assembly mode.
    near : tuple of float, optional
        Instead of the side, its place (x, y) in a sketch [m].
    at : tuple of float, optional
        Its place (x, y) in a drawing [m], from which lengths are measured that are not given.
    **labels : float or quantity
        The distances from P and from Q by their labels [m], such as `AB=0.5`. A length that follows a stroke is a cylinder.

    Notes
    -----
    Source: Artobolevsky, class II group of the first kind.
    """

    from_drawing = "distances"
    arms = ("P", "Q")
    closes = True
    chooses = "two circles meet in two points"
    orientation = 1.0
    expects = (("P", "point"), ("Q", "point"), ("PX", "quantity"), ("QX", "quantity"))

    def in_axes(self, axes: Axes) -> Self:
        return self.renewed(side=Side(-self.side)) if axes.mirrored and self.side is not None else self

    def place(self, where: Where) -> Vec:
        P, base = where.at(self.P), where.at(self.Q) - where.at(self.P)
        along, height = triangle(where, base.square(), where.value(self.PX), where.value(self.QX))
        inverse = 1.0 / base.square()
        X: Vec = P + (base * (along * inverse) + base.left() * (float(self.settled_side) * (height * inverse)))
        return X

    def sides(self, where: Where) -> tuple[tuple[str, Scalar], ...]:
        return self.triangle_sides(where, (where.at(self.Q) - where.at(self.P)).length())

    def constraints(self, where: Where) -> tuple[Scalar, ...]:
        X, p, q = where.at(self.X), where.value(self.PX), where.value(self.QX)
        return ((X - where.at(self.P)).square() - p * p) * 0.5, ((X - where.at(self.Q)).square() - q * q) * 0.5

    def meeting(self, where: Where) -> tuple[Vec, ...]:
        X = where.at(self.X)
        return where.at(self.P) - X, where.at(self.Q) - X

    def expansion(self) -> tuple[Assignment, ...]:
        angle = CosineAngle(distance(self.P, self.Q), self.PX, self.QX)
        return turned_from_base(self, "PQ", "QPX", angle, self.settled_side is Side.LEFT)
