"""Straight guides, fixed or on a moving body, and the points that slide on them."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Self

from ..errors import DefinitionError, ensure
from ..quantities import FRAME_AXES, Axes, Member, Operand, Quantity, Reference, Variable, Where, label, name_of, quantity, source_text
from ..quantities.joint import Driven, Joint, Jointed, JointSide, guided
from ..vectors import Line, Scalar, Vec
from .step import Point, position


class Guide(Jointed):
    """A straight line to slide on: `Guide((0.0, -0.2), angle=0)` in the frame, `Guide(P, Q)` the line of two points.

    Numbers are design variables: `rail.x`, `rail.y`, `rail.angle`.

    Parameters
    ----------
    P : Point, str or tuple of float
        The guide's origin, a point or a place (x, y) [m].
    Q : Point or str, optional
        A second point, which gives the direction.
    angle : float or quantity, optional
        Instead of a second point, the direction [rad].
    """

    kind = "guide"
    expects = (("P", "point"), ("Q", "point"))
    argument_kinds = MappingProxyType({"P": "origin", "angle": "direction"})
    radians = ("angle",)
    axes = FRAME_AXES
    """The axes that its numbers are counted in."""

    def __init__(self, P: Reference | tuple[float, float], Q: Reference | None = None, *, angle: Operand | None = None) -> None:
        is_whole = P is not None and (Q is None) != (angle is None)
        ensure(is_whole, "Guide: give its origin, and its direction by angle= or by a second point.")
        if Q is not None and (P is Q or (isinstance(P, str) and P == Q)):
            raise DefinitionError(f"Guide({label(Q)}, {label(Q)}): its two points must be different.")
        self.fixed_at = None if isinstance(P, (str, Member)) else position(P, "Guide")
        self.P = P if isinstance(P, (str, Member)) else None
        self.Q = Q
        self.angle = None if angle is None else quantity(angle)

    def parts(self) -> tuple[Reference, ...]:
        angle = () if self.angle is None or self.angle.is_constant else (self.angle,)
        return (*(point for point in super().parts() if point is not None), *angle, *self.axes.parts())

    def in_axes(self, axes: Axes) -> Self:
        return self if self.Q is not None and self.P is not None else self.renewed(axes=axes.composed(self.axes))

    @property
    def points(self) -> tuple[str, ...]:
        """The names of the points the guide goes through."""
        own = tuple(name_of(point) for point in (self.P, self.Q) if point is not None)
        return self.axes.carrier if self.P is None and not self.axes.is_frame else own

    def variables(self) -> tuple[tuple[str, float, str, str], ...]:
        place = () if self.fixed_at is None else tuple(zip(("x", "y"), self.fixed_at, ("coordinate",) * 2, strict=True))
        turn = (("angle", self.angle.constant, "angle"),) if self.angle is not None and self.angle.constant is not None else ()
        return tuple((f"{self.name}.{part}", value, kind, "") for part, value, kind in (*place, *turn))

    def having(self, values: Mapping[str, float]) -> Guide:
        place = self.fixed_at and tuple(values.get(f"{self.name}.{axis}", part) for axis, part in zip("xy", self.fixed_at, strict=True))
        return self.renewed(fixed_at=place, angle=None if self.angle is None else quantity(values.get(f"{self.name}.angle", self.angle)))

    def line(self, where: Where) -> Line:
        """Return the origin [m] and the direction's cosine and sine.

        Parameters
        ----------
        where : Where
            The reading: places of points and values of quantities.

        Returns
        -------
        Line
            The line.
        """
        if self.P is not None:
            origin = where.at(self.P)
        else:
            origin = self.axes.place(where, Vec(where.input(f"{self.name}.x"), where.input(f"{self.name}.y")))
        if self.Q is not None:
            along = where.at(self.Q) - origin
            scale = 1.0 / (where.link_length(name_of(self.P), name_of(self.Q)) if self.P is not None else along.length())
            return Line(origin, along * scale)
        assert self.angle is not None
        angle: Quantity = Variable(f"{self.name}.angle") if self.angle.is_constant else self.angle
        return Line(origin, self.axes.vector(where, Vec(*where.turn(angle))))

    def joints(self) -> tuple[Joint, ...]:
        """Return the joint that keeps the carrier of a guide in a given direction through a moving point from turning.

        Returns
        -------
        tuple of Joint
            The joints.
        """
        if self.P is None or self.angle is None:
            return ()
        P = name_of(self.P)
        return (Joint("upright", P, JointSide((P,), "slider"), JointSide(self.axes.carrier), "c"),)

    def __str__(self) -> str:
        start = label(self.P) if self.P is not None else str(self.fixed_at)
        angle = quantity(0.0 if self.angle is None else self.angle)
        end = label(self.Q) if self.Q is not None else f"angle={source_text(angle, 0, 'angle')}"
        return f"Guide({start}, {end})"


class Slide(Jointed):
    """A point that slides on a guide: `shoe = Slide("C", rail)`.

    Parameters
    ----------
    point : Point or str
        The point.
    guide : Guide or str
        The guide.
    """

    expects = (("point", "point"), ("guide", "guide"))

    def __init__(self, point: Reference, guide: Reference) -> None:
        self.point, self.guide = point, guide

    def constraints(self, where: Where) -> tuple[Scalar, ...]:
        """Return the point's distance from the guide [m], positive on its left.

        Parameters
        ----------
        where : Where
            The reading: places of points and values of quantities.

        Returns
        -------
        tuple of scalar
            The residual [m].
        """
        line = where.line(self.guide)
        return (line.direction.cross(where.at(self.point) - line.origin),)

    def joints(self) -> tuple[Joint, ...]:
        return (guided(name_of(self.point), name_of(self.guide)),)

    def __str__(self) -> str:
        return f"Slide({label(self.point)}, {label(self.guide)})"


class OnGuide(Point):
    """A point at a distance along a guide from its origin, driven or given: `C = OnGuide(rail, at=S)`.

    Parameters
    ----------
    guide : Guide or str
        The guide.
    at : float or quantity
        The distance from its origin [m], in the guide's direction.
    """

    expects = (("guide", "guide"),)
    metres = ("along",)

    def __init__(self, guide: Reference, *, at: Operand) -> None:
        self.guide, self.along = guide, quantity(at)

    def parts(self) -> tuple[Reference, ...]:
        return self.guide, self.along

    def place(self, where: Where) -> Vec:
        return where.line(self.guide).at(where.value(self.along))

    def joints(self) -> tuple[Joint, ...]:
        guide, drives = name_of(self.guide), (Driven(self.along, "t"),)
        on, by = JointSide((self.name,), "runner"), JointSide((guide,), "guide")
        return (Joint("driven", self.name, on, by, "nt", lambda where: where.line(guide), (guide,), drives),)

    def __str__(self) -> str:
        return f"OnGuide({label(self.guide)}, at={source_text(self.along)})"
