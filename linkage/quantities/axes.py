"""The axes of a part of a machine: their place in the whole machine, and the body that carries them."""

from __future__ import annotations

from collections.abc import Hashable
from dataclasses import field
from functools import cached_property

import numpy as np

from ..frozen import immutable
from ..vectors import Vec
from .member import Reference, Where, name_of
from .quantity import Number, Quantity, source_text

NOTHING = Number(0.0)


def is_nothing(given: Quantity) -> bool:
    """Return whether a quantity is the number zero."""
    return given.constant == 0.0


@immutable
class Axes:
    """Axes that stand `at` a place, turned by an `angle` [rad], in the frame or in the axes of the body of two points P and Q.

    Those of a body have their origin in P, and x goes to Q. A part that is `mirrored` is mirrored at its own y axis first, then turned,
    then placed.
    """

    P: Reference | None = None
    Q: Reference | None = None
    at: tuple[Quantity, Quantity] = (NOTHING, NOTHING)
    angle: Quantity = field(default_factory=lambda: Number(0.0))  # a default would take the name of the field
    mirrored: bool = False

    @property
    def carrier(self) -> tuple[str, ...]:
        """The names of the two points of the body that carries them; none in the frame."""
        return () if self.P is None or self.Q is None else (name_of(self.P), name_of(self.Q))

    @property
    def are_upright(self) -> bool:
        """Whether they have the directions of the frame."""
        return not self.carrier and not self.mirrored and self.is_level

    @cached_property
    def is_frame(self) -> bool:
        """Whether they are those of the frame itself."""
        return self.are_upright and all(map(is_nothing, self.at))

    @property
    def is_level(self) -> bool:
        """Whether they are parallel to the axes of their carrier."""
        return is_nothing(self.angle)

    @property
    def sign(self) -> float:
        """The sense in which a turn of the part goes in the whole: 1, or -1 where it is mirrored."""
        return -1.0 if self.mirrored else 1.0

    @property
    def identity(self) -> tuple[Hashable, ...]:
        """A hashable key: equal for equal axes."""
        return (self.carrier, *(each.identity for each in (*self.at, self.angle)), self.mirrored)

    def parts(self) -> tuple[Reference, ...]:
        """Return the references they are built from: the carrier's points, the origin and the angle."""
        return (*self.carrier, *(each for each in (*self.at, self.angle) if not each.is_constant))

    def composed(self, inner: Axes | None) -> Axes:
        """Return axes that stand in these, as they stand in the whole."""
        if inner is None:
            return self
        mirrored = self.mirrored != inner.mirrored
        if inner.carrier:  # carried along by their body, which is mirrored with its points
            if not self.mirrored:
                return inner
            x, y = inner.at
            return Axes(inner.P, inner.Q, (x, y.opposite()), plus(Number(np.pi), inner.angle.opposite()), not inner.mirrored)
        turn = inner.angle.opposite() if self.mirrored else inner.angle
        return Axes(self.P, self.Q, self.corner(*inner.at), plus(self.angle, turn), mirrored)

    def corner(self, x: Quantity, y: Quantity) -> tuple[Quantity, Quantity]:
        """Return the coordinates of a place of the part in the axes of its carrier."""
        x = x.opposite() if self.mirrored else x
        if not is_nothing(self.angle):
            angle = self.angle if self.angle.constant is None or self.angle.name else self.angle.constant
            cos, sin = np.cos(angle), np.sin(angle)
            x, y = plus(multiplied(x, cos), multiplied(y, sin).opposite()), plus(multiplied(x, sin), multiplied(y, cos))
        return plus(self.at[0], x), plus(self.at[1], y)

    # -- in a reading ------------------------------------------------------------------------------------------

    def _turned(self, where: Where, vector: Vec) -> Vec:
        """Return a vector of the part in the axes of its carrier."""
        found = Vec(-vector.x, vector.y) if self.mirrored else vector
        return found if is_nothing(self.angle) else found.turned(*where.turn(self.angle))

    def _base(self, where: Where) -> tuple[Vec, Vec]:
        """Return the origin [m] and the direction of the carrier."""
        P, Q = self.carrier
        start = where.at(P)
        return start, (where.at(Q) - start) * (1.0 / where.link_length(P, Q))

    def vector(self, where: Where, given: Vec) -> Vec:
        """Return a vector of the part in the axes of the frame."""
        found = self._turned(where, given)
        if not self.carrier:
            return found
        _, along = self._base(where)
        turned: Vec = along * found.x + along.left() * found.y
        return turned

    def place(self, where: Where, given: Vec) -> Vec:
        """Return where a place of the part is in the frame [m]."""
        if self.is_frame:
            return given
        found = self._turned(where, given)
        x, y = [part if is_nothing(way) else where.value(way) + part for way, part in zip(self.at, (found.x, found.y), strict=True)]
        if not self.carrier:
            return Vec(x, y)
        start, along = self._base(where)
        carried: Vec = start + (along * x + along.left() * y)
        return carried

    def read_vector(self, where: Where, given: Vec) -> Vec:
        """Return a vector of the frame as the part reads it."""
        if self.carrier:
            _, along = self._base(where)
            given = Vec(along.dot(given), along.cross(given))
        return self._straight(where, given)

    def read_place(self, where: Where, given: Vec) -> Vec:
        """Return a place in the frame as the part reads it [m]."""
        if self.carrier:
            start, along = self._base(where)
            way = given - start
            given = Vec(along.dot(way), along.cross(way))
        x, y = (part if is_nothing(way) else part - where.value(way) for way, part in zip(self.at, (given.x, given.y), strict=True))
        return self._straight(where, Vec(x, y))

    def _straight(self, where: Where, given: Vec) -> Vec:
        """Return a vector of the carrier's axes in the axes of the part."""
        if not is_nothing(self.angle):
            cos, sin = where.turn(self.angle)
            given = given.turned(cos, -sin)
        return Vec(-given.x, given.y) if self.mirrored else given

    def __str__(self) -> str:
        words = [f"on=({', '.join(self.carrier)})"] if self.carrier else []
        words += [] if all(map(is_nothing, self.at)) else [f"at=({source_text(self.at[0])}, {source_text(self.at[1])})"]
        words += [] if is_nothing(self.angle) else [f"angle={source_text(self.angle, 0, 'angle')}"]
        return ", ".join([*words, *(["mirrored=True"] if self.mirrored else [])])


FRAME_AXES = Axes()


def multiplied(a: Quantity, factor: Quantity | float) -> Quantity:
    """Return a product; of numbers as a number."""
    if a.constant is not None and (not a.constant or not (a.name or isinstance(factor, Quantity))):
        return a if not a.constant else Number(a.constant * float(factor))
    return a * factor


def plus(a: Quantity, b: Quantity) -> Quantity:
    """Return the sum of two quantities; of numbers as a number, nothing left out."""
    if is_nothing(a) or is_nothing(b):
        return b if is_nothing(a) else a
    if a.constant is not None and b.constant is not None and not a.name and not b.name:
        return Number(a.constant + b.constant)
    return a + b
