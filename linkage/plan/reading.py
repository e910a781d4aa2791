"""A reading of the plan: every rule evaluated once, in one kind of arithmetic.

On arrays this is the eager evaluation; on a graph's nodes it is the trace of the program.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ..errors import DefinitionError, unknown
from ..quantities import Member, Quantity, Reference, Turning, name_of
from ..steps import Point
from ..vectors import Line, Scalar, Vec


class Reading:
    """The values of a plan's members for given inputs, each worked out when first asked for."""

    def __init__(self, members: Mapping[str, Member], lengths: Mapping[frozenset[str], Quantity], inputs: Mapping[str, Scalar]) -> None:
        self.members, self.lengths, self.inputs = members, lengths, inputs
        self.positions: dict[str, Vec] = {}
        self._values: dict[Any, Any] = {}
        self.placing: list[str] = []

    def at(self, point: Reference) -> Vec:
        """Return a point's position [m]."""
        name = name_of(point)
        if name not in self.positions:
            step = self.members.get(name)
            if not isinstance(step, Point):
                raise unknown("Point", name, (each for each, member in self.members.items() if isinstance(member, Point)))
            self.placing.append(name)
            try:
                self.positions[name] = step.place(self)
            except ArithmeticError as error:
                text = f"{name} = {step}: a value overflows or is divided by zero ({error}); look for extreme numbers and lengths of zero."
                raise DefinitionError(text) from error
            self.positions[name] = self.closed(step, self.positions[name])
            self.placing.pop()
        return self.positions[name]

    @property
    def owner(self) -> str:
        """The named member that is being worked out."""
        return self.placing[-1]

    def closed(self, step: Point, X: Vec) -> Vec:
        """Return the position of a point that closes a loop; here it is known by its value."""
        return X

    def _once(self, kind: str, reference: Reference, rule: str) -> Any:
        named = reference if isinstance(reference, str) else reference.name
        member: Any = self.members[named] if named else reference
        key = (kind, member.name or id(member))
        if key not in self._values:
            if member.name:
                self.placing.append(member.name)
            self._values[key] = (getattr(member, rule)(self), member)
            if member.name:
                self.placing.pop()
        return self._values[key][0]

    def vector(self, vector: Reference) -> Vec:
        """Return a vector member [m]."""
        found: Vec = self._once("vector", vector, "vector")
        return found

    def vector_length(self, vector: Reference) -> Scalar:
        """Return the length of a vector member [m]."""
        return self._once("length", vector, "length")

    def value(self, quantity: Reference) -> Scalar:
        """Return a quantity's value, SI."""
        return self._once("value", quantity, "rule")

    def turn(self, angle: Reference) -> Turning:
        """Return the cosine and sine of an angle."""
        found: Turning = self._once("turn", angle, "turning")
        return found

    def input(self, name: str) -> Scalar:
        """Return a stroke, a dimension or a coordinate of a ground point."""
        return self.inputs[name]

    def root(self, radicand: Scalar, scale: Scalar, size: Scalar) -> Scalar:
        """Return the square root that closes a loop."""
        return np.sqrt(radicand)

    def margin(self, sine: Scalar) -> Scalar:
        """Return the sine of the angle between a loop's two members."""
        return sine

    def line(self, guide: Reference) -> Line:
        """Return a guide's line."""
        found: Line = self._once("line", guide, "line")
        return found

    def angle_of(self, vector: Vec) -> Scalar:
        """Return a vector's direction [rad]."""
        return np.arctan2(vector.y, vector.x)

    def link_length(self, P: str, Q: str) -> Scalar:
        """Return the distance of two points [m]: the link's own length where a label gives it."""
        known = self.lengths.get(frozenset((P, Q)))
        return (self.at(Q) - self.at(P)).length() if known is None else self.value(known)

    def close_angle(self, cos: Scalar, sin: Scalar) -> Turning:
        """Return an angle that closes a loop, as its cosine and sine."""
        return cos, sin


class ArrayReading(Reading):
    """The eager evaluation on NumPy arrays: a dead point is reached to rounding, and every loop tells how near it is.

    `sines` holds, for each step that closes a loop, the sine of the angle between its links (NaN where it fails);
    `rounding` how much larger the numbers are whose difference closes the loop than its own links.
    """

    ROUNDING = 8 * np.finfo(float).eps

    def __init__(self, members: Mapping[str, Member], lengths: Mapping[frozenset[str], Quantity], inputs: Mapping[str, Scalar]) -> None:
        super().__init__(members, lengths, inputs)
        self.sines: dict[str, Any] = {}
        self.rounding: dict[str, Any] = {}

    def root(self, radicand: Scalar, scale: Scalar, size: Scalar) -> Scalar:
        inside = np.where((radicand < 0.0) & (radicand >= -self.ROUNDING * size), 0.0, radicand)
        height = np.sqrt(inside)
        self.margin(height / scale)
        self.rounding[self.owner] = size / scale**2
        return height

    def margin(self, sine: Scalar) -> Scalar:
        """Return a sine, noted for the member that is being placed."""
        self.sines[self.owner] = sine
        return sine
