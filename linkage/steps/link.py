"""A rigid body, declared by the points that move with it."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import combinations
from types import MappingProxyType
from typing import Self

from ..errors import DefinitionError
from ..quantities import Axes, Member, Operand, Reference, name_of, quantity
from .labels import DimensionTable, Slot, Spoken, match, relabelled, written_labels


class Link(Member):
    """Points that move as one body: `Link(O, B, C)`, or `Link("O B C", OB=0.30, OC=0.36, BC=0.16)`.

    Parameters
    ----------
    *points : Point or str
        The points, or their names in one text.
    **labels : float or quantity
        Distances [m] and angles [rad] of its points by their labels.
    """

    kind = "link"
    is_mirrored: bool = False
    """Whether it stands in a part that is mirrored, so that its angles go the other way."""
    spoken: Spoken | None = None
    """How its labels are spoken, where it is of a part."""
    argument_kinds = MappingProxyType({"points": "points"})

    def __init__(self, *points: Reference, **labels: Operand) -> None:
        if len(points) == 1 and isinstance(points[0], str):
            points = tuple(points[0].replace(",", " ").split())
        self.points, self.labels = points, labels
        if len(points) < 2:
            words = " ".join(map(str, points))
            raise DefinitionError(f'Link("{words}"): a link joins at least two points; write them apart, Link("O B").')

    def in_axes(self, axes: Axes) -> Self:
        return self.renewed(is_mirrored=not self.is_mirrored) if axes.mirrored else self

    def parts(self) -> tuple[Reference, ...]:
        return (*self.points, *(part for part in map(quantity, self.labels.values()) if not part.is_constant))

    def enter(self, table: DimensionTable) -> None:
        """Enter the labels: distances and angles of its own points.

        Parameters
        ----------
        table : Table
            The table of dimensions.
        """
        for slot, spelling, value in self.fitted():
            table.dimension(slot, spelling, value, f"{self.name} = {self}")

    def fitted(self) -> list[tuple[Slot, str, Operand]]:
        """Return the slot, spelling and value of each label; DefinitionError for one that does not fit the points.

        Returns
        -------
        list of tuple
            The slot, the spelling and the value of each label.

        Raises
        ------
        DefinitionError
            A label that does not fit the points.
        """
        found = [(match({spelling: value}, self.slots(), f"{self.name} = {self}"), value) for spelling, value in self.labels.items()]
        return [(slot, spelling, value) for each, value in found for slot, spelling, _, _ in each.values()]

    def having(self, values: Mapping[str, float]) -> Link:
        return self.renewed(labels=relabelled(self.labels, values))

    def slots(self) -> list[Slot]:
        """Return the labels that fit: the distances of its points, and the angles between three of them.

        Returns
        -------
        list of Slot
            The slots.
        """
        names = self.point_names
        corners = [(P, vertex, Q) for vertex in names for P, Q in combinations(names, 2) if vertex not in (P, Q)]
        return [Slot("", each, self.spoken) for each in (*combinations(names, 2), *corners)]

    @property
    def point_names(self) -> tuple[str, ...]:
        """The names of its points; DefinitionError where one stands twice."""
        names = tuple(name_of(point) for point in self.points)
        if len(set(names)) < len(names):
            raise DefinitionError(f"{self.name} = {self}: a point stands in it twice.")
        return names

    def __str__(self) -> str:
        names = [name_of(point) for point in self.points]
        slots = self.slots() if len(set(names)) == len(names) else ()
        points, labels = " ".join(names), "".join(f", {each}" for each in written_labels(self.labels, slots))
        return f'Link("{points}"{labels})'
