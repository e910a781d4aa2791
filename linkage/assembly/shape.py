"""The shape of a link: the distances and angles of its points, from its labels or a drawing."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from itertools import permutations
from typing import Any

import numpy as np

from ..quantities import Number, Quantity, quantity
from ..steps import Link, OnLink, Pin, Step


class Shape:
    """What is known of a link's shape. Lengths in m, angles in rad."""

    def __init__(self, link: Link, pins: Mapping[str, Pin], placed: set[str], place: Callable[[str], tuple[float, float]]) -> None:
        self.points = link.point_names
        self.pins, self.placed, self.place = pins, placed, place
        self.labels = {name: quantity(value) for name, value in link.labels.items()}

    def given(self, *points: str) -> tuple[str, Quantity] | None:
        """Return the label of a distance (two points) or an angle (three points) as it is spelled, if it is given."""
        spellings = ("".join(points), "".join(reversed(points)))
        return next(((spelling, self.labels[spelling]) for spelling in spellings if spelling in self.labels), None)

    def distance(self, P: str, Q: str) -> Quantity | None:
        """Return the distance of two points: given, by the cosine rule from two sides and their angle, or measured [m]."""
        found = self.given(P, Q)
        if found is not None:
            return found[1]
        for R in self.points:
            sides, angle = (self.given(R, P), self.given(R, Q)), self.given(P, R, Q)
            if angle is not None and sides[0] is not None and sides[1] is not None:
                p, q = sides[0][1], sides[1][1]
                derived: Quantity = np.sqrt(p * p + q * q - 2.0 * p * q * np.cos(angle[1]))
                return derived
        return self.measured(P, Q)

    def is_straight(self, P: str, Q: str, R: str) -> bool:
        """Return whether three distances put three points in one line: such a link has no sides."""
        sides = [self.distance(*pair) for pair in ((P, Q), (P, R), (Q, R))]
        if not all(isinstance(side, Number) for side in sides):
            return False
        longest = max(lengths := [side.number for side in sides if isinstance(side, Number)])
        return abs(2.0 * longest - sum(lengths)) <= 1e-9 * longest

    def measured(self, P: str, Q: str) -> Quantity | None:
        """Return the distance of two points in the drawing [m]."""
        if not any(point in self.pins and self.pins[point].drawn_at for point in (P, Q)):
            return None
        first, second = self.drawn(P), self.drawn(Q)
        return None if first is None or second is None else Number(float(np.hypot(first[0] - second[0], first[1] - second[1])))

    def drawn(self, point: str) -> tuple[float, float] | None:
        """Return a point's place in the drawing, or where it is placed [m]; None for a pin with only a rough place."""
        if point in self.pins and (self.pins[point].drawn_at or point not in self.placed):
            return self.pins[point].drawn_at
        return self.place(point)

    def attachment(self, firm: Sequence[str], pin: str) -> Step | None:
        """Return the step that places a point of this body from two placed ones, if the labels allow it."""
        near = self.pins[pin].near
        for P, Q in permutations(firm, 2):
            length = self.given(P, pin)
            angle = self.given(Q, P, pin)
            if length is None:
                continue
            if angle is not None:
                return OnLink(P, Q, **labelled(length, angle))
            other = self.given(Q, pin)
            if other is not None:
                return OnLink(P, Q, near=self.pins[pin].sketched, **labelled(length, other))
        if near is None:
            return OnLink(firm[0], firm[1], at=self.pins[pin].drawn_at, **self.own(firm, pin))
        for P, Q in permutations(firm, 2):
            p, q = self.distance(P, pin), self.distance(Q, pin)
            if p is not None and q is not None:
                return OnLink(P, Q, near=near, **labelled((P + pin, p), (Q + pin, q)))
        return None

    def own(self, firm: Sequence[str], pin: str) -> dict[str, Any]:
        """Return the given labels that fit a step from the first two placed points."""
        found = [self.given(firm[0], pin), self.given(firm[1], firm[0], pin)]
        return labelled(*(each for each in found if each is not None))


def labelled(*labels: tuple[str, Quantity]) -> dict[str, Any]:
    """Return labels as a step's keywords."""
    return dict(labels)
