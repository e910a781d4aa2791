"""The plan traced into a program: the same rules, read on nodes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ..program import Graph, Level, Node
from ..quantities import Member, Quantity, Turning
from ..steps import Point
from ..vectors import Scalar, Vec
from .reading import Reading

#: A loop whose links meet under a smaller sine has a condition above 1e4: its ratios lose digits.
NEAR = 2e-4


@dataclass(frozen=True)
class Guard:
    """A node that is NaN where a step cannot be assembled and negative where it is near a singular pose."""

    step: str
    node: Node


class Trace(Reading):
    """A reading whose scalars are the nodes of one graph."""

    def __init__(self, members: Mapping[str, Member], lengths: Mapping[frozenset[str], Quantity], levels: Mapping[str, Level]) -> None:
        self.graph = Graph()
        inputs = {name: self.graph.input(name, level) for name, level in levels.items()}
        super().__init__(members, lengths, inputs)
        self.guards: list[Guard] = []

    def root(self, radicand: Scalar, scale: Scalar, size: Scalar) -> Scalar:
        node: Node = self.graph.apply("sqrt", radicand)
        watched = node - NEAR * scale if node.level is Level.POSE else node
        self.guards.append(Guard(self.placing[-1], self.graph.node(watched)))
        return node

    def closed(self, step: Point, X: Vec) -> Vec:
        if not step.closes:
            return X

        def residuals(roots: tuple[Node, ...]) -> tuple[Scalar, ...]:
            self.positions[step.name] = Vec(*roots)
            return step.constraints(self)

        return Vec(*self.graph.close((X.x, X.y), residuals))

    def close_angle(self, cos: Scalar, sin: Scalar) -> Turning:
        (root,) = self.graph.close((sin,), lambda roots: ((cos * cos + roots[0] * roots[0]) * 0.5,))
        return cos, root
