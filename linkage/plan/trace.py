"""The plan traced into a program: the same rules, read on nodes."""

from __future__ import annotations

from collections.abc import Mapping
from copy import copy
from dataclasses import dataclass

import numpy as np

from ..errors import DefinitionError
from ..program import Graph, Level, Node
from ..quantities import Member, Quantity, Turning
from ..steps import Point
from ..vectors import Scalar, Vec
from .reading import ArrayReading, Reading

#: A loop whose links meet under a smaller sine has a condition above 1e4: its ratios lose digits.
NEAR = 2e-4


@dataclass(frozen=True)
class Guard:
    """A node that is NaN where a step cannot be assembled, negative near a singular pose, zero where a direction is lost."""

    step: str
    node: Node


class Trace(Reading):
    """A reading whose scalars are the nodes of one graph."""

    def __init__(self, members: Mapping[str, Member], lengths: Mapping[frozenset[str], Quantity], levels: Mapping[str, Level]) -> None:
        self.graph = Graph()
        inputs = {name: self.graph.input(name, level) for name, level in levels.items()}
        super().__init__(members, lengths, inputs)
        self.guards: list[Guard] = []
        self.noted: dict[str, Node] = {}
        self.angles: list[Node] = []

    def view(self) -> Trace:
        """Return this trace as it stands, for reading more: what is read there leaves nothing here but nodes."""
        view = copy(self)
        view.guards, view.angles, view.placing = list(self.guards), list(self.angles), []
        view.positions, view.noted, view._values = dict(self.positions), dict(self.noted), dict(self._values)
        return view

    def root(self, radicand: Scalar, scale: Scalar, size: Scalar) -> Scalar:
        radicand = self.graph.node(radicand)
        if radicand.level is not Level.POSE:  # a triangle of the design may be flat: rounding must not open it
            limit = size * -ArrayReading.ROUNDING
            radicand = self.graph.pick(limit, radicand, np.maximum(radicand, 0.0), radicand)
        node: Node = self.graph.apply("sqrt", radicand)
        watched = radicand - NEAR**2 * (scale * scale + size) if node.level is Level.POSE else node
        self.guards.append(Guard(self.owner, self.graph.node(watched)))
        self.noted[self.owner] = node
        return node

    def margin(self, sine: Scalar) -> Scalar:
        if isinstance(sine, Node):
            self.guards.append(Guard(self.owner, np.abs(sine) - NEAR))
            self.noted[self.owner] = sine
        elif sine == 0.0:
            step = self.members[self.owner]
            raise DefinitionError(f"{self.owner} = {step}: the lines that meet in it are parallel at every pose; change an angle.")
        return sine

    def angle_of(self, vector: Vec) -> Scalar:
        angle = self.graph.node(super().angle_of(vector))
        self.angles.append(angle)
        return angle

    def watch_length(self, step: str, length: Quantity) -> None:
        """Keep a guard that is NaN where a length is negative."""
        self.guards.append(Guard(step, self.graph.apply("sqrt", self.value(length))))

    def link_length(self, P: str, Q: str) -> Scalar:
        length = super().link_length(P, Q)
        if frozenset((P, Q)) not in self.lengths:
            self.guards.append(Guard(self.owner, self.graph.node(length)))
        return length

    def closed(self, step: Point, X: Vec) -> Vec:
        if not step.closes:
            return X

        names = step.companions or (step.name,)
        values = [self.graph.node(part) for name in names for part in self._raw(name, step, X)]

        def residuals(roots: tuple[Node, ...]) -> tuple[Scalar, ...]:
            for name, x, y in zip(names, roots[::2], roots[1::2], strict=True):
                self.positions[name] = Vec(x, y)
            return step.constraints(self)

        known = step.sense * self.noted[step.name] if step.sense and step.name in self.noted else None
        roots = self.graph.close(values, residuals, known)
        for name, x, y in zip(names, roots[::2], roots[1::2], strict=True):
            self.positions[name] = Vec(x, y)
        return self.positions[step.name]

    def _raw(self, name: str, step: Point, X: Vec) -> tuple[Scalar, Scalar]:
        """Return the selected position of a point of a loop."""
        if name == step.name:
            return X.x, X.y
        other = self.members[name]
        assert isinstance(other, Point)
        place = other.place(self)
        return place.x, place.y

    def close_angle(self, cos: Scalar, sin: Scalar) -> Turning:
        (root,) = self.graph.close((sin,), lambda roots: ((cos * cos + roots[0] * roots[0]) * 0.5,))
        return cos, root
