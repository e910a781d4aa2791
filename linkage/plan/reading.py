"""A reading of the plan: every rule evaluated once, in one kind of arithmetic.

On arrays this is the eager evaluation; on a graph's nodes it is the trace of the program.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from copy import copy
from functools import cached_property, reduce
from typing import Self

import numpy as np

from ..errors import DefinitionError, unknown
from ..quantities import Member, Quantity, Reference, Stroke, Tabulated, Turning, Where, name_of, needed_behind, needs, of_kind
from ..steps import Group, Point, strokes_drawn
from ..vectors import Line, Scalar, Vec


class Reading(Where):
    """The values of a plan's members for given inputs, each worked out when first asked for."""

    def __init__(self, members: Mapping[str, Member], lengths: Mapping[frozenset[str], Quantity], inputs: Mapping[str, Scalar]) -> None:
        self.members, self.lengths, self.inputs = members, lengths, inputs
        self.positions: dict[str, Vec] = {}
        self._values: dict[tuple[str, str | int], tuple[Scalar, Member]] = {}
        self.placing: list[str] = []
        self.directions: dict[str, Vec] = {}

    def at(self, point: Reference) -> Vec:
        """Return a point's position [m]."""
        name = point if type(point) is str else name_of(point)
        if name not in self.positions:
            step = self.members.get(name)
            if not isinstance(step, Point):
                raise unknown("Point", name, of_kind(self.members, Point))
            self.placing.append(name)
            try:
                self.positions[name] = step.place(self)
            except ArithmeticError as error:
                text = f"{name} = {step}: a value overflows or is divided by zero ({error}); look for extreme numbers and lengths of zero."
                raise DefinitionError(text, member=name) from error
            self.positions[name] = self.closed(step, self.positions[name])
            self.placing.pop()
        return self.positions[name]

    def copied(self) -> Self:
        """Return a copy of the reading to go on from; its own results and notes do not change."""
        found = copy(self)
        vars(found).update({name: value.copy() for name, value in vars(self).items() if type(value) in (dict, list)})
        return found

    @property
    def owner(self) -> str:
        """The named member that is being worked out; "" where it has no name."""
        return self.placing[-1] if self.placing else ""

    def closed(self, step: Point, X: Vec) -> Vec:
        """Return the position of a point that closes a loop; here it is known by its value."""
        return X

    def _evaluated(self, kind: str, reference: Reference, rule: str) -> Scalar:
        """Evaluate a member's rule when it is first asked for."""
        named = reference if isinstance(reference, str) else reference.name
        if named and named not in self.members:
            raise unknown("Name", named, self.members)
        member = reference if not named and isinstance(reference, Member) else self.members[named]
        name = member.name
        key = (kind, name or id(member))
        if key not in self._values:
            if not hasattr(member, rule):
                raise DefinitionError(f"{named} = {member} stands where a {kind} is expected.")
            if name:
                self.placing.append(name)
            self._values[key] = (getattr(member, rule)(self), member)
            if name:
                self.placing.pop()
        return self._values[key][0]

    def vector(self, vector: Reference) -> Vec:
        """Return a vector member [m]."""
        found: Vec = self._evaluated("vector", vector, "vector")
        return found

    def vector_length(self, vector: Reference) -> Scalar:
        """Return the length of a vector member [m]."""
        return self._evaluated("length", vector, "length")

    def value(self, quantity: Reference) -> Scalar:
        """Return a quantity's value, SI."""
        return self._evaluated("value", quantity, "rule")

    def turn(self, angle: Reference) -> Turning:
        """Return the cosine and sine of an angle."""
        found: Turning = self._evaluated("turn", angle, "turning")
        return found

    def input(self, name: str) -> Scalar:
        """Return a stroke, a dimension or a coordinate of a ground point."""
        return self.inputs[name]

    def at_pose(self, quantity: Reference, strokes: Mapping[str, float]) -> Scalar:
        """Return the value of a quantity at one pose of the strokes; DefinitionError where a group would have to be solved."""
        behind = self.behind(quantity)
        groups = [name for name in of_kind(self.members, Group) if name in behind]
        if groups:
            what = f"{quantity} at one pose hangs on {groups[0]}, whose pins are found together and have no closed form"
            raise DefinitionError(f"{what}; give the length itself, filled=dict(...).")
        inputs = {name: value for name, value in self.inputs.items() if "(" not in name}  # no references of angles, which are of this pose
        with np.errstate(all="ignore"):
            return Reading(self.members, self.lengths, {**inputs, **strokes_drawn(self.members), **strokes}).value(quantity)

    def behind(self, quantity: Reference) -> set[str]:
        """Return the names of all that a quantity is built from."""
        return needed_behind([quantity] if isinstance(quantity, str) else needs(quantity), self.members)

    def line(self, guide: Reference) -> Line:
        """Return a guide's line."""
        found: Line = self._evaluated("line", guide, "line")
        return found

    def followed(self, angle: str, vector: Vec) -> Scalar | None:
        """Return the direction of a vector [rad] counted from the reference that the angle's input gives; None without such an input.

        The reference [rad] lies within a radian of the direction, so that the arc tangent is far from where it jumps.
        """
        self.directions[angle] = vector
        if angle not in self.inputs:
            return None
        reference = self.inputs[angle]
        cos, sin = np.cos(reference), np.sin(reference)
        return reference + np.arctan2(vector.y * cos - vector.x * sin, vector.x * cos + vector.y * sin)

    def direction(self, P: str, Q: str) -> Vec:
        """Return the vector from one point to another [m], noted as one whose direction is taken."""
        found = self.at(Q) - self.at(P)
        if frozenset((P, Q)) in self.lengths:
            self.link_length(P, Q)
        else:
            self.apart(found.square())
        return found

    def link_length(self, P: str, Q: str) -> Scalar:
        """Return the distance of two points [m]: the link's own length where a label gives it."""
        known = self.lengths.get(frozenset((P, Q)))
        if known is None:
            return np.sqrt(self.apart((self.at(Q) - self.at(P)).square()))
        length = self.value(known)
        if not known.is_constant:
            self.apart(length * length)
        return length

    @cached_property
    def extent(self) -> Scalar:
        """The square of the machine's size [m2]: the longest length that follows no stroke, or the distance of two fixed points."""
        lengths = []
        for length in self.lengths.values():
            behind = (self.members[name] for name in self.behind(length))
            if not any(isinstance(member, Point) and not member.is_fixed for member in behind):
                lengths.append(length)
        return self.sizing().longest(lengths)

    def longest(self, lengths: Iterable[Quantity]) -> Scalar:
        """Return the square of the longest of some lengths that follow no stroke, or of the distance of two fixed points [m2]."""
        fixed = [self.at(name) for name, point in of_kind(self.members, Point).items() if point.is_fixed]
        squares = [(place - fixed[0]).square() for place in fixed[1:]]
        squares += [value * value for length in lengths if self.stays(value := self.value(length))]
        ranges = [max(abs(stroke.start), abs(stroke.end)) for stroke in of_kind(self.members, Stroke).values()]
        return reduce(np.maximum, squares) if squares else max(ranges, default=1.0) ** 2 or 1.0

    def sizing(self) -> Reading:
        """Return the reading that tells the machine's size, whose own directions do not ask for it."""
        return self

    def stays(self, value: Scalar) -> bool:
        """Return whether a value is known to follow no stroke."""
        return True


class ArrayReading(Reading):
    """The eager evaluation on NumPy arrays: a dead point is reached to rounding, and every loop tells how near it is.

    For each step that closes a loop, `sines` holds the sine of the angle between its links, NaN where it fails. `rounding` holds how much
    larger the numbers are whose difference closes the loop than its own links. For each member that takes a direction between points,
    `closest` holds the least square of their distance [m2]. For each that leaves the range of a table, `outside` holds the words for it.
    """

    ROUNDING = 8 * np.finfo(float).eps

    def __init__(self, members: Mapping[str, Member], lengths: Mapping[frozenset[str], Quantity], inputs: Mapping[str, Scalar]) -> None:
        super().__init__(members, lengths, inputs)
        self.sines: dict[str, Scalar] = {}
        self.rounding: dict[str, Scalar] = {}
        self.closest: dict[str, Scalar] = {}
        self.outside: dict[str, str] = {}

    def curve(self, curve: Tabulated, x: Scalar, order: int = 0) -> Scalar:
        if curve.ends is not None:
            low, high = curve.ends
            worst = float(np.ravel(x)[np.argmax(np.maximum(low - x, x - high))])
            if not low <= worst <= high:
                ends = " to ".join(f"{round(end, 9) + 0.0:.6g}" for end in curve.ends)
                self.outside |= dict.fromkeys(self.placing, f"{curve.name} is asked for {worst:.6g}, and its table goes from {ends}")
        return super().curve(curve, x, order)

    def root(self, radicand: Scalar, scale: Scalar, size: Scalar, most: Scalar | None = None) -> Scalar:
        step, limit = self.members.get(self.owner), self.ROUNDING * size
        is_rigid = isinstance(step, Point) and not step.closes  # a triangle of the design may be flat: rounding must not open it
        inside = np.where((radicand < limit * is_rigid) & (radicand >= -limit), 0.0, radicand)
        height = np.sqrt(inside)
        self.margin(height / scale)
        self.rounding[self.owner] = size / scale**2
        return height

    def margin(self, sine: Scalar) -> Scalar:
        """Return a sine, noted for the member that is being placed."""
        self.sines[self.owner] = sine
        return sine

    def sizing(self) -> Reading:
        return Reading(self.members, self.lengths, self.inputs)

    def apart(self, square: Scalar) -> Scalar:
        self.closest[self.owner] = np.minimum(self.closest.get(self.owner, np.inf), square)
        return square
