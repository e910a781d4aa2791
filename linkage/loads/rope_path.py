"""The path of a rope, a chain or a belt over points and pulleys: its length, and which way it pulls at each point.

    a pulley has a signed radius r, above zero where the rope turns left around it, and stands to the left of the rope
    between P and Q, d = Q - P, the rope is straight, t long and in the direction u:   t u = d - (r_Q - r_P) left(u)
    on a pulley it lies over the angle by which it turns there, |r| theta long

A tension T pulls at a point with T (u_out - u_in): at a pulley that is the sum of both tangent pulls, whose moments about its pin cancel.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise
from math import pi
from types import MappingProxyType
from typing import Any, ClassVar

import numpy as np

from ..errors import DefinitionError, cited, is_number
from ..frozen import immutable
from ..quantities import Axes, Member, Number, Quantity, Reference, Where, label, name_of
from ..vectors import Scalar, Side, Vec
from .element import Array, Glyph, LawElement, Load, Parameter, Poses

WIDEST = 10.0
"""m; the radius of a larger pulley was given in millimetres."""


@immutable
class Pulley(LawElement):
    """A pulley that turns freely about a point, for a Rope: `sheave = Pulley(B, radius=80 * mm, side=LEFT)`.

    Parameters
    ----------
    point : Point or str
        The point about which it turns. Several ropes may run over it.
    radius : float or quantity
        The radius at which the rope lies [m], a design variable, `sheave.radius`.
    side : Side or str
        On LEFT the rope that comes along turns left around it, so that the pulley is to its left; on RIGHT it turns right.
    """

    point: Reference
    radius: Parameter
    side: Side | str
    places: ClassVar[tuple[str, ...]] = ("point",)
    parameters: ClassVar[Mapping[str, str]] = MappingProxyType({"radius": "mm"})
    not_negative: ClassVar[frozenset[str]] = frozenset({"radius"})
    argument_kinds: ClassVar[Mapping[str, object]] = MappingProxyType({"side": "side"})
    needs_name: ClassVar[bool] = True

    def __post_init__(self) -> None:
        super().__post_init__()
        side = Side.parse(self.side)
        if side is None:
            raise DefinitionError(f"Pulley: side={cited(self.side)}; say side=LEFT where the rope turns left around it, else side=RIGHT.")
        object.__setattr__(self, "side", side)
        if is_number(self.radius) and self.radius > WIDEST:
            large = f"{self.radius:.6g}"
            raise DefinitionError(f"Pulley: radius={large} m is more than any pulley has; write {large} * mm if these are millimetres.")

    @property
    def sense(self) -> float:
        """1 where the rope turns left around it, else -1."""
        return float(self.side)

    @property
    def scales(self) -> bool:
        return False

    def glyphs(self, members: Mapping[str, Member]) -> tuple[Glyph, ...]:
        return (Glyph("pulley", (name_of(self.point),), radii=lambda motion: [self.number(motion, "radius")]),)

    def in_axes(self, axes: Axes) -> Pulley:
        return self.renewed(side=Side(-int(self.side))) if axes.mirrored else self

    def words(self) -> list[str]:
        return [*super().words(), f"side={self.side}"]


@immutable
class Station:
    """A point that a rope runs over, with the pulley there, if it runs over one."""

    point: str
    pulley: Pulley | None = None

    def radius(self, motion: Poses) -> Array | None:
        """Return the signed radius at the poses [m]; None at a pin."""
        return None if self.pulley is None else self.pulley.sense * self.pulley.number(motion, "radius")

    @property
    def radius_written(self) -> Quantity:
        """The radius as a quantity of its class [m]."""
        return Number(0.0) if self.pulley is None else self.pulley.written("radius")

    @property
    def sense(self) -> float:
        """1 where the rope turns left there, -1 where it turns right, 0 at a pin."""
        return 0.0 if self.pulley is None else self.pulley.sense


@immutable
class RopePath(Quantity):
    """The length of a rope's path over points [m], of pulleys of some radii and senses, each straight part so often as its weight says."""

    points: tuple[Reference, ...]
    radii: tuple[Quantity, ...]
    senses: tuple[float, ...]
    weights: tuple[float, ...]

    @property
    def measures(self) -> str:
        return "length"

    def parts(self) -> tuple[Reference, ...]:
        return (*self.points, *(each for each in self.radii if not each.is_constant))

    def in_axes(self, axes: Axes) -> RopePath:
        return self.renewed(senses=tuple(0.0 - each for each in self.senses)) if axes.mirrored else self

    def rule(self, where: Where) -> Scalar:
        names = [name_of(each) for each in self.points]
        radii = [sense * where.value(each) if sense else None for each, sense in zip(self.radii, self.senses, strict=True)]
        length: Scalar = 0.0
        before: Vec | None = None
        for k, weight in enumerate(self.weights):
            span, along = tangent_part(where.direction(names[k], names[k + 1]), radii[k], radii[k + 1])
            length = length + weight * span
            radius = radii[k]
            if before is not None and radius is not None:
                length = length + weight * self.senses[k] * radius * turn_angle(before, along, self.senses[k])
            before = along
        return length

    def __str__(self) -> str:
        return f"rope({', '.join(map(label, self.points))})"


def tangent_part(d: Vec, start: Scalar | None, end: Scalar | None) -> tuple[Scalar, Vec]:
    """Return the length [m] and the direction of the straight part between two points, d apart, of some signed radii, None at a pin."""
    if start is None and end is None:
        length = d.length()
        return length, d * (1.0 / length)
    step = (0.0 if end is None else end) - (0.0 if start is None else start)
    square = d.square()
    length = np.sqrt(square - step * step)
    return length, (d * length - d.left() * step) * (1.0 / square)


def turn_angle(before: Vec, after: Vec, sense: float) -> Scalar:
    """Return by which angle a rope turns from one direction to another, in a sense [rad]; from -90 to 270 degrees."""
    return 0.5 * pi + np.arctan2(-before.dot(after), before.cross(after) * sense)


# At the poses of a motion.


def straight_parts(stations: Sequence[Station], motion: Poses) -> list[tuple[Array, Vec]]:
    """Return the length [m] and the direction of every straight part at the poses."""
    radii, found = [each.radius(motion) for each in stations], []
    for k, (one, other) in enumerate(pairwise(stations)):
        arm: Any = motion[other.point] - motion[one.point]
        found.append(tangent_part(Vec(arm[0], arm[1]), radii[k], radii[k + 1]))
    return found


def pulls(stations: Sequence[Station], weights: Sequence[float], motion: Poses) -> list[Load]:
    """Return the pulls [N] of a rope's tension of one newton on every point that it runs over."""
    ways = [np.stack([along.x, along.y]) * weight for (_, along), weight in zip(straight_parts(stations, motion), weights, strict=True)]
    first, last = Load(stations[0].point, ways[0]), Load(stations[-1].point, -1.0 * ways[-1])
    between = [Load(each.point, after - before) for each, before, after in zip(stations[1:-1], ways[:-1], ways[1:], strict=True)]
    return [first, *between, last]
