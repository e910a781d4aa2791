"""A reading of a mechanism, as its rules see it: where the points are and what the quantities amount to."""

from __future__ import annotations

from typing import Protocol, TypeAlias

from ..vectors import Line, Scalar, Vec
from .member import Reference

Turning: TypeAlias = tuple[Scalar, Scalar]
"""The cosine and the sine of an angle: how angles are carried between steps."""


class Where(Protocol):
    """A reading of the mechanism: it knows where the points are and what the quantities amount to."""

    def at(self, point: Reference) -> Vec:
        """Return a point's position [m]."""

    def vector(self, vector: Reference) -> Vec:
        """Return a vector member [m]."""

    def value(self, quantity: Reference) -> Scalar:
        """Return a quantity's value, SI."""

    def turn(self, angle: Reference) -> Turning:
        """Return the cosine and sine of an angle."""

    def input(self, name: str) -> Scalar:
        """Return a stroke, a dimension or a coordinate of a ground point."""

    def root(self, radicand: Scalar, scale: Scalar, size: Scalar, most: Scalar | None = None) -> Scalar:
        """Return the square root that closes a loop: `scale` times the sine of the angle between its links.

        NaN where the radicand is negative by more than rounding, which is measured against `size`; `most` is what that is never above,
        where the links alone say it.
        """

    def margin(self, sine: Scalar) -> Scalar:
        """Return the sine of the angle between a loop's two members, noted as its distance from a singular pose."""

    def line(self, guide: Reference) -> Line:
        """Return a guide's line."""

    def angle_of(self, vector: Vec) -> Scalar:
        """Return a vector's direction [rad]."""

    def followed(self, angle: str, vector: Vec) -> Scalar | None:
        """Return the direction of a vector [rad] where that angle is followed from the sketch; None where it is not."""

    def apart(self, square: Scalar) -> Scalar:
        """Return the square of a vector whose direction is taken [m2], noted as its distance from a pose where that is lost."""

    def direction(self, P: str, Q: str) -> Vec:
        """Return the vector from one point to another [m], noted as one whose direction is taken."""

    def link_length(self, P: str, Q: str) -> Scalar:
        """Return the distance of two points [m]; the link's own length where one body holds both."""

    def vector_length(self, vector: Reference) -> Scalar:
        """Return the length of a vector member [m]."""

    def close_angle(self, cos: Scalar, sin: Scalar) -> Turning:
        """Return an angle that closes a loop, as its cosine and sine."""
