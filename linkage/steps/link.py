"""A rigid body, declared by the points that move with it."""

from __future__ import annotations

from itertools import combinations
from typing import Any

from ..errors import DefinitionError
from ..quantities import Member, Reference, name_of, quantity, spelled
from .labels import Claims, Slot, match


class Link(Member):
    """Points that move as one body: `Link(O, B, C)`, or `Link("O B C", OB=0.30, OC=0.36, BC=0.16)`."""

    def __init__(self, *points: Reference, **labels: Any) -> None:
        if len(points) == 1 and isinstance(points[0], str):
            points = tuple(points[0].split())
        self.points, self.labels = points, labels
        if len(points) < 2:
            raise DefinitionError(f"Link({', '.join(map(str, points))}): a link joins at least two points.")

    def parts(self) -> tuple[Reference, ...]:
        return (*self.points, *(part for part in map(quantity, self.labels.values()) if not part.is_constant))

    def enter(self, claims: Claims) -> None:
        """Enter the labels: distances and angles of its own points."""
        slots = [Slot("", pair) for pair in combinations(self.point_names, 2)]
        corners = [(P, vertex, Q) for vertex in self.point_names for P, Q in combinations(self.point_names, 2)]
        slots += [Slot("", corner) for corner in corners if corner[1] not in (corner[0], corner[2])]
        for spelling, value in self.labels.items():
            (found,) = match({spelling: value}, slots, f"{self.name} = {self}").values()
            claims.claim(found[0], spelling, value, f"{self.name} = {self}")

    @property
    def point_names(self) -> tuple[str, ...]:
        """The names of its points; DefinitionError where one stands twice."""
        names = tuple(name_of(point) for point in self.points)
        if len(set(names)) < len(names):
            raise DefinitionError(f"{self.name} = {self}: a point stands in it twice.")
        return names

    def __str__(self) -> str:
        points = " ".join(name_of(point) for point in self.points)
        labels = "".join(f", {key}={spelled(quantity(value))}" for key, value in self.labels.items())
        return f'Link("{points}"{labels})'
