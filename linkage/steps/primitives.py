"""The vector method's own primitives: vectors of points, cosine-rule angles, rotate-and-scale, offset."""

from __future__ import annotations

from abc import abstractmethod
from types import MappingProxyType

import numpy as np

from ..errors import DefinitionError
from ..frozen import immutable
from ..quantities import FRAME_AXES, Axes, Driven, Joint, JointSide, Length, Operand, Quantity, label, quantity, source_text
from ..quantities.member import Member, Reference, Turning, Where, joined_names, name_of
from ..vectors import Line, Scalar, Vec
from .step import Assignment, Bar, Point, Step, angle_given


class Arrow(Member):
    """A vector of the mechanism; `abs(arrow)` is its length, a quantity."""

    kind = "vector"

    @abstractmethod
    def vector(self, where: Where) -> Vec:
        """Return the vector [m] in a reading.

        Parameters
        ----------
        where : Where
            The reading: places of points and values of quantities.

        Returns
        -------
        Vec
            The vector [m].
        """

    def length(self, where: Where) -> Scalar:
        """Return its length [m]; the link's where it is known.

        Parameters
        ----------
        where : Where
            The reading: places of points and values of quantities.

        Returns
        -------
        float or array
            The length [m].
        """
        return np.sqrt(where.apart(where.vector(self).square()))

    def __abs__(self) -> Quantity:
        return Length(self)


class Vector(Arrow):
    """The vector PQ = Q - P between two points [m].

    Parameters
    ----------
    P, Q : Point or str
        Its start and its end.
    """

    expects = (("P", "point"), ("Q", "point"))

    def __init__(self, P: Reference, Q: Reference) -> None:
        self.P, self.Q = P, Q

    def vector(self, where: Where) -> Vec:
        return where.at(self.Q) - where.at(self.P)

    def length(self, where: Where) -> Scalar:
        return where.link_length(name_of(self.P), name_of(self.Q))

    def __str__(self) -> str:
        return f"Vector({label(self.P)}, {label(self.Q)})"


class Axis(Arrow):
    """The unit vector of the x axis, from which a crank's arm is turned."""

    is_directed = True

    def __init__(self, axes: Axes = FRAME_AXES) -> None:
        self.axes = axes

    def parts(self) -> tuple[Reference, ...]:
        return self.axes.parts()

    def vector(self, where: Where) -> Vec:
        return self.axes.vector(where, Vec(1.0, 0.0))

    def length(self, where: Where) -> Scalar:
        return 1.0

    def __str__(self) -> str:
        return "Axis()"


class Turn(Arrow):
    """A vector turned by an angle, then scaled to a length.

    Parameters
    ----------
    vector : Vector or str
        The vector.
    angle : float or quantity
        The angle [rad], counter-clockwise.
    length : float or quantity, optional
        The new length [m]; it is kept where none is given.
    """

    expects = (("base", "vector"), ("angle", "quantity"))
    radians = handed = ("angle",)

    def __init__(self, vector: Reference, angle: Operand, length: Operand | None = None) -> None:
        self.base, self.angle = vector, angle_given(angle, "Turn")
        self.scaled_to = None if length is None else quantity(length)

    def parts(self) -> tuple[Reference, ...]:
        return (*super().parts(), *self.lengths())

    def lengths(self) -> tuple[Quantity, ...]:
        return () if self.scaled_to is None else (self.scaled_to,)

    def vector(self, where: Where) -> Vec:
        cos, sin = where.turn(self.angle)
        if self.scaled_to is not None:
            scale = where.value(self.scaled_to) / where.vector_length(self.base)
            cos, sin = cos * scale, sin * scale
        return where.vector(self.base).turned(cos, sin)

    def length(self, where: Where) -> Scalar:
        return where.vector_length(self.base) if self.scaled_to is None else where.value(self.scaled_to)

    def __str__(self) -> str:
        end = "" if self.scaled_to is None else f", length={source_text(self.scaled_to)}"
        return f"Turn({label(self.base)}, {source_text(self.angle, 0, 'angle')}{end})"


def triangle(where: Where, base2: Scalar, p: Scalar, q: Scalar) -> tuple[Scalar, Scalar]:
    """Return base times the apex's distance along the base, and twice the area [m2].

    `base2` is the squared base [m2], `p` and `q` the sides from its first and second end [m]. By Heron,
    twice the area is base times height; it is NaN where the sides do not meet.
    """
    along = (base2 + p * p - q * q) * 0.5
    largest = np.maximum(base2, np.maximum(p * p, q * q))
    return along, where.root(p * p * base2 - along * along, scale=p * q, size=np.abs(along) * largest, most=p * (p + q) ** 3)


class CosineAngle(Quantity):
    """The angle between the first two sides of a triangle, opposite the third [rad], 0 to pi.

    It closes a loop: NaN where the three sides do not make a triangle.

    Parameters
    ----------
    a, b : float or quantity
        The sides [m] that the angle lies between.
    c : float or quantity
        The side opposite [m].
    """

    measures = "angle"

    def __init__(self, a: Operand, b: Operand, c: Operand) -> None:
        self.triangle = (quantity(a), quantity(b), quantity(c))

    def parts(self) -> tuple[Reference, ...]:
        return self.triangle

    def lengths(self) -> tuple[Quantity, ...]:
        return self.triangle

    def rule(self, where: Where) -> Scalar:
        cos, sin = where.turn(self)
        return np.arctan2(sin, cos)

    def turning(self, where: Where) -> Turning:
        a, b, c = (where.value(side) for side in self.triangle)
        along, height = triangle(where, a * a, b, c)
        scale = 1.0 / (a * b)
        return where.close_angle(along * scale, height * scale)

    def sides(self, where: Where) -> tuple[tuple[str, Scalar], ...]:
        return tuple((source_text(side), where.value(side)) for side in self.triangle)

    def __str__(self) -> str:
        return f"CosineAngle({', '.join(map(source_text, self.triangle))})"


@immutable
class OffsetLinks:
    """The constraints that an offset point keeps by construction; empty for a mere construction.

    `groups` are points that move as one, `sides` its distances from other points, `rods` those of them that strokes and dimensions
    give; `apex` is the far end of the base where it is the apex of a triangle. `by` are two points of the body that a drive acts from,
    none for the frame; `angle` turns it, `length` pushes it out. Where its place is `settled` by what it hangs on, `beside` are another
    point of its body, the vector there and that one's sign.
    """

    groups: tuple[tuple[str, ...], ...] = ()
    sides: tuple[Bar, ...] = ()
    rods: tuple[Bar, ...] = ()
    apex: str = ""
    by: tuple[str, ...] = ()
    angle: Quantity | None = None
    length: Quantity | None = None
    settled: bool = False
    beside: tuple[str, Reference, float] | None = None


class Offset(Point):
    """The point P + vector [m].

    The class finds the constraints `keeps` from the construction of its vectors.

    Parameters
    ----------
    P : Point or str
        The point.
    vector : Vector or str
        What is added to it [m].
    """

    keeps = OffsetLinks()
    expects = (("P", "point"), ("by", "vector"))
    argument_kinds = MappingProxyType({"vector": "vector"})

    def __init__(self, P: Reference, vector: Reference) -> None:
        self.P, self.by = P, vector
        if not isinstance(vector, (str, Arrow)):
            raise DefinitionError(f"Offset({label(P)}, {vector!r}): the second argument is a vector, such as Turn(AO, -OAB, length=L).")

    def place(self, where: Where) -> Vec:
        return where.at(self.P) + where.vector(self.by)

    def bars(self) -> tuple[Bar, ...]:
        return self.keeps.rods

    def bodies(self) -> tuple[tuple[str, ...], ...]:
        return self.keeps.groups

    def sides(self, where: Where) -> tuple[tuple[str, Scalar], ...]:
        """Return the triangle that places it, where it is the apex of one that closes in its own line.

        Parameters
        ----------
        where : Where
            The reading: places of points and values of quantities.

        Returns
        -------
        tuple of tuple
            Each side's name and length [m].
        """
        if len(self.keeps.sides) < 2:
            return ()
        P, Q = name_of(self.P), self.keeps.apex
        base = (where.at(Q) - where.at(P)).length()
        return (joined_names(P, Q), base), *((joined_names(side.P, self.name), where.value(side.length)) for side in self.keeps.sides)

    def meeting(self, where: Where) -> tuple[Vec, ...]:
        X, ends = where.at(self.name), (self.P, self.keeps.apex)
        return tuple(where.at(end) - X for end in ends) if self.keeps.apex else ()

    def constraints(self, where: Where) -> tuple[Scalar, ...]:
        """Return the equations of its constraints: it lies on its body, a drive gives its place, two-point members have their lengths.

        Parameters
        ----------
        where : Where
            The reading: places of points and values of quantities.

        Returns
        -------
        tuple of scalar
            The residuals.
        """
        P, X = where.at(self.P), where.at(self.name)
        if self.keeps.settled:
            arm = where.vector(self.by)
            if self.keeps.beside is not None:  # as the body is turned, which is not always as the vector is: two may move parallel
                Y, other, sign = self.keeps.beside
                along, base = where.vector(other) * sign, where.at(Y) - P
                scale = 1.0 / along.square()
                arm = base.turned(along.dot(arm) * scale, along.cross(arm) * scale)
            miss = X - P - arm
            return miss.x, miss.y
        lengths = [(X - where.at(side.P), where.value(side.length)) for side in self.keeps.sides]
        return tuple((way.square() - length * length) * 0.5 for way, length in lengths)

    def joints(self) -> tuple[Joint, ...]:
        """Return the joint of a drive that turns its vector or pushes it out.

        Returns
        -------
        tuple of Joint
            The joints.
        """
        name, start, keeps = self.name, name_of(self.P), self.keeps
        turned = () if keeps.angle is None else (Driven(keeps.angle, "c"),)
        by = JointSide(keeps.by)
        if keeps.length is not None:

            def line(where: Where) -> Line:
                return Line(where.at(self.P), where.vector(self.by) * (1.0 / where.vector_length(self.by)))

            drives = (Driven(keeps.length, "t"), *turned)
            return (Joint("telescope", start, JointSide((name,)), by, "ntc", line, drives=drives, arm=True),)
        return (Joint("crank", start, JointSide((start, name)), by, "c", drives=turned),) if turned else ()

    @property
    def hangs_from(self) -> str:
        return "" if self.keeps.settled or len(self.keeps.sides) > 1 else name_of(self.P)

    def __str__(self) -> str:
        return f"Offset({label(self.P)}, {label(self.by)})"


def turned_from_base(step: Step, sides: str, corner: str, angle: Quantity, is_left: bool) -> tuple[Assignment, ...]:
    """Return the point X of a step, turned by an angle from its base P -> Q; of the sides and the angle by the letters of their points."""
    lengths: dict[str, Quantity] = {f"{letter}X": getattr(step, f"{letter}X") for letter in sides}
    base = Vector(*(getattr(step, letter) for letter in "PQ"))
    arm = Turn(base, angle if is_left else -angle, length=lengths["PX"])
    named = (*lengths.items(), ("PQ", base), (corner, angle), ("PX", arm))
    found = [Assignment(step.word(*(getattr(step, letter) for letter in letters)), value) for letters, value in named]
    return *found, Assignment(step.X, Offset(base.P, arm))
