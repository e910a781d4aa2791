"""Outputs of a mechanism: directions, distances and coordinates, as quantities like any other."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Hashable, Mapping
from dataclasses import field

import numpy as np

from ..errors import DefinitionError
from ..frozen import immutable
from ..language import said
from ..vectors import Scalar
from .axes import FRAME_AXES, Axes
from .member import Member, Reference, Turning, Where, as_mapping, name_of
from .quantity import Quantity


def label(reference: Reference) -> str:
    """Return a reference as it is written: its name, or its own text."""
    return (reference.name or str(reference)) if isinstance(reference, Member) else str(reference)


class Output(Quantity):
    """An output of points: a direction, a distance or a coordinate, in the axes of the frame or of a part."""

    measures = "length"
    axes = FRAME_AXES
    """The axes that it is read in."""

    @property
    @abstractmethod
    def function_name(self) -> str:
        """The name of the function that gives it."""

    @property
    def identity(self) -> Hashable:
        places = Member.parts(self)
        return self.name or (self.function_name, *map(name_of, places), *(() if self.axes.is_frame else self.axes.identity))

    def parts(self) -> tuple[Reference, ...]:
        return (*super().parts(), *self.axes.parts())

    def __str__(self) -> str:
        words = [*map(label, super().parts()), str(self.axes)]
        return f"{self.function_name}({', '.join(filter(None, words))})"


@immutable
class Angle(Output):
    """The direction of P -> Q [rad], counter-clockwise from the x axis."""

    P: Reference
    Q: Reference
    axes: Axes = field(default=FRAME_AXES, repr=False)
    expects = (("P", "point"), ("Q", "point"))
    measures = function_name = "angle"
    is_directed = True

    def __post_init__(self) -> None:
        if self.P is self.Q or (isinstance(self.P, str) and self.P == self.Q):
            raise DefinitionError(f"{self}: a direction leads from one point to another; name two points.")

    def rule(self, where: Where) -> Scalar:
        v = self.axes.read_vector(where, where.direction(name_of(self.P), name_of(self.Q)))
        found = where.followed(str(self), v)
        return where.angle_of(v) if found is None else found

    def turning(self, where: Where) -> Turning:
        v = self.axes.read_vector(where, where.at(self.Q) - where.at(self.P))
        scale = 1.0 / where.link_length(name_of(self.P), name_of(self.Q))
        return v.x * scale, v.y * scale


@immutable
class Distance(Output):
    """The distance of P and Q [m]."""

    P: Reference
    Q: Reference
    expects = (("P", "point"), ("Q", "point"))
    function_name = "distance"

    def rule(self, where: Where) -> Scalar:
        return where.direction(name_of(self.P), name_of(self.Q)).length()


@immutable
class Coordinate(Output):
    """A point's x or y [m]."""

    P: Reference
    axis: str
    axes: Axes = field(default=FRAME_AXES, repr=False)
    expects = (("P", "point"),)

    @property
    def function_name(self) -> str:
        return self.axis

    def in_axes(self, axes: Axes) -> Coordinate:
        return self.renewed(axes=axes.composed(self.axes))

    def rule(self, where: Where) -> Scalar:
        P = self.axes.read_place(where, where.at(self.P))
        return P.x if self.axis == "x" else P.y


@immutable
class Length(Quantity):
    """The length of a vector [m]: `abs(AO)`."""

    vector: Reference
    expects = (("vector", "vector"),)
    measures = "length"

    def rule(self, where: Where) -> Scalar:
        return np.sqrt(where.apart(where.vector(self.vector).square()))

    def __str__(self) -> str:
        return f"abs({label(self.vector)})"


def angle(P: Reference, Q: Reference) -> Quantity:
    """Return the direction of P -> Q [rad], counter-clockwise from the x axis.

    Parameters
    ----------
    P : str or Point
        The first point, or its name.
    Q : str or Point
        The second point, or its name.

    Returns
    -------
    Quantity
        The angle.
    """
    return Angle(P, Q)


def distance(P: Reference, Q: Reference) -> Quantity:
    """Return the distance of P and Q [m].

    Parameters
    ----------
    P : str or Point
        The first point, or its name.
    Q : str or Point
        The second point, or its name.

    Returns
    -------
    Quantity
        The distance.
    """
    return Distance(P, Q)


def x(P: Reference) -> Quantity:
    """Return the x coordinate of a point [m].

    Parameters
    ----------
    P : str or Point
        The point, or its name.

    Returns
    -------
    Quantity
        The coordinate.
    """
    return Coordinate(P, "x")


def y(P: Reference) -> Quantity:
    """Return the y coordinate of a point [m].

    Parameters
    ----------
    P : str or Point
        The point, or its name.

    Returns
    -------
    Quantity
        The coordinate.
    """
    return Coordinate(P, "y")


@immutable
class AtPose(Quantity):
    """The value of a quantity at one pose of the strokes, the same at all poses; strokes that are not named are at the sketch.

    Inputs that are `unmoved` are 0 there.
    """

    of: Quantity
    strokes: Mapping[str, float]
    unmoved: tuple[str, ...] = ()
    expects = (("of", "quantity"),)

    @property
    def measures(self) -> str:
        return self.of.measures

    def rule(self, where: Where) -> Scalar:
        return where.at_pose(self.of, {**dict.fromkeys(self.unmoved, 0.0), **self.strokes})

    def __str__(self) -> str:
        if not self.strokes:
            return said("{quantity} at the sketch", quantity=self.of)
        return said("{quantity} at {strokes}", quantity=self.of, strokes=as_mapping(self.strokes))


@immutable
class InnerQuantity(Quantity):
    """A quantity that a member holds by a name of its own, written by the class: `lift.length`."""

    owner: Reference
    own: str
    measures = "length"

    @property
    def called(self) -> str:
        """Its name in the class."""
        return f"{name_of(self.owner)}.{self.own}"

    @property
    def identity(self) -> Hashable:
        return self.name or self.called

    def parts(self) -> tuple[Reference, ...]:
        return (self.called,)

    def rule(self, where: Where) -> Scalar:
        return where.value(self.called)

    def __str__(self) -> str:
        return f"{label(self.owner)}.{self.own}"
