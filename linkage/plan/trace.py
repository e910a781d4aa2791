"""The plan traced into a program: the same rules, read on nodes."""

from __future__ import annotations

from collections.abc import Container, Hashable, Mapping, Sequence
from dataclasses import fields
from functools import cached_property, partial, reduce
from math import prod
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np

from ..errors import DefinitionError
from ..program import Graph, Level, Node, Tangent, ancestors
from ..quantities import Member, Quantity, Stroke, Tabulated, Turning, of_kind
from ..steps import Arrow, Point
from ..vectors import Line, Scalar, Vec
from .reading import ArrayReading, Reading

#: The sine of a loop, and the distance of two points over the machine's size, below which they count as near a singular pose.
REGULAR = 0.3
#: The product of all such parts below which a pose is looked at closely: that of a single loop whose condition is about 500.
NEAR = 0.01
#: Fixed points so many times farther away than the machine is large leave so few digits that every pose is looked at closely.
AWAY = 1e4


def rate_name(stroke: str, order: int = 1) -> str:
    """Return the name of the input that is a stroke's rate, of `order` 2 its acceleration."""
    return f"{stroke}.{'rate' if order == 1 else 'acceleration'}"


class Guard(NamedTuple):
    """A node that is above zero where a member can be worked out; a member of "" is all of them."""

    member: str
    node: Node


class Nearness(NamedTuple):
    """How far a member is from a singular pose: the square of a loop's sine, or of a distance over the machine's size, over REGULAR's."""

    member: str
    node: Node
    exact: Node
    """What `node` is a lower bound of, where that costs less."""
    above: tuple[Node, Node]
    """Two nodes, the second above zero: `node` exceeds a number where the first exceeds so many times the second."""

    @property
    def base(self) -> Node:
        """What is behind all that is built on it: the radicand, the sine or the distance, or its square."""
        first = self.above[0].origin
        return first.args[0].origin if first.op == "multiply" and first.args[0] is first.args[-1] else first


class Loop(NamedTuple):
    """A loop that places a step: links that must meet, guides that must cross, a length that must be positive, a direction.

    `links`: the radicand, the scale of its root and the size of the terms whose difference it is; `guides`: the sine; `length`: [m];
    `meeting`: the distance of the points between which the direction is taken [m].
    """

    step: str
    kind: str
    terms: tuple[Node, ...]


class Trace(Reading):
    """A reading whose scalars are the nodes of one graph; `cache` caches results of others, by their keys."""

    def __init__(self, members: Mapping[str, Member], lengths: Mapping[frozenset[str], Quantity], levels: Mapping[str, Level]) -> None:
        self.graph = Graph()
        inputs = {name: self.graph.input(name, level) for name, level in levels.items()}
        super().__init__(members, lengths, inputs)
        self.guards: list[Guard] = []
        self.measures: dict[Nearness, None] = {}
        self.loops: list[Loop] = []
        self.noted: dict[str, Node] = {}
        self.angles: list[Node] = []
        self.cache: dict[object, object] = {}
        self.is_sizing = False
        self._tangents: dict[Hashable, Tangent] = {}
        self._least: dict[tuple[Nearness, ...], Node] = {}

    def components(self, vector: Vec) -> tuple[Node, Node]:
        """Return the nodes of both components of a vector or a place."""
        return self.graph.node(vector.x), self.graph.node(vector.y)

    def tangent(self, name: str) -> Tangent:
        """Return the derivatives by an input, shared by all who ask: those of a loop are worked out once."""
        if name not in self._tangents:
            self._tangents[name] = Tangent(self.graph, {self.inputs[name]: 1.0})
        return self._tangents[name]

    def rate_input(self, stroke: str, order: int = 1) -> Node:
        """Return the input that is the rate of a stroke [1/s], of `order` 2 its acceleration [1/s2]."""
        return self.graph.input(rate_name(stroke, order), Level.POSE)

    def by_time(self, rates: Mapping[str, Node], accelerations: Mapping[str, Node] = MappingProxyType({})) -> Tangent:
        """Return the derivatives by time at rates of strokes; twice they are accelerations, where the rates are inputs.

        What a rate that is a number changes by is not in it.
        """
        seeds = {self.inputs[name]: rate for name, rate in rates.items()}
        seeds |= {rates[name]: change for name, change in accelerations.items() if name in rates and rates[name].op == "input"}
        key = tuple((node.number, seed.number) for node, seed in seeds.items())
        if key not in self._tangents:
            self._tangents[key] = Tangent(self.graph, seeds)
        return self._tangents[key]

    def fork(self) -> Trace:
        """Return this trace on a forked graph: new nodes do not change this one, and its own are known there."""
        fork = self.view()
        fork.graph = self.graph.fork()
        fork.cache, fork._tangents, fork._least = {}, {}, {}
        for name in ("guards", "measures", "loops", "angles", "positions", "noted", "directions", "inputs", "_values", "extent"):
            if name in vars(self):
                vars(fork)[name] = in_fork(vars(self)[name], fork.graph.nodes)
        return fork

    def view(self) -> Trace:
        """Return a view of this trace for more readings; they add nothing here but nodes."""
        view = self.copied()
        view.cache, view._tangents, view.placing = self.cache, self._tangents, []
        return view

    def alone(self, member: Member | None) -> Trace:
        """Return this trace without unnamed readings and with a quantity or a vector read, so that all its measures are that one's."""
        view = self.view()
        view.measures = dict.fromkeys(measure for measure in view.measures if measure.member)
        view._values = {key: known for key, known in view._values.items() if isinstance(key[1], str)}
        if isinstance(member, Quantity):
            view.value(member)
        elif isinstance(member, Arrow):
            view.vector(member)
        return view

    def root(self, radicand: Scalar, scale: Scalar, size: Scalar, most: Scalar | None = None) -> Scalar:
        radicand = self.graph.node(radicand)
        if radicand.level is not Level.POSE:  # a triangle of the design may be flat: rounding must not open it
            radicand = self.graph.pick(np.abs(radicand), size * ArrayReading.ROUNDING, 0.0, radicand)
        else:
            self.loops.append(Loop(self.owner, "links", tuple(map(self.graph.node, (radicand, scale, size)))))
        node: Node = self.graph.apply("sqrt", radicand)
        self.noted[self.owner] = node
        if node.level is Level.POSE:
            bound = size if most is None or self.graph.node(most).level is Level.POSE else most  # links that keep their lengths cost less
            inside = np.maximum(radicand, 0.0)
            less, exact = ((scale * scale + each) * REGULAR**2 for each in (bound, size))
            self._measure(inside / less, (radicand, less), inside / exact)
        else:
            self.guards.append(Guard(self.owner, node))
        return node

    def margin(self, sine: Scalar) -> Scalar:
        if isinstance(sine, Node):
            self._measure(sine * sine * REGULAR**-2, (sine * sine, REGULAR**2))
            if sine.level is Level.POSE:
                self.loops.append(Loop(self.owner, "guides", (sine,)))
            self.noted[self.owner] = sine
        elif sine == 0.0:
            text = f"{self.owner} = {self.members[self.owner]}: the lines that meet in it are parallel at every pose; change an angle."
            raise DefinitionError(text, member=self.owner)
        return sine

    def sizing(self) -> Trace:
        view = self.view()
        view.is_sizing = True
        return view

    def apart(self, square: Scalar) -> Scalar:
        node = self.graph.node(square)
        if node.level is Level.POSE:
            if not self.is_sizing:  # which would ask for the size again
                size = self.extent * REGULAR**2
                self._measure(node / size, (node, size))
        else:
            self.guards.append(Guard(self.owner, node))
        return square

    def link_length(self, P: str, Q: str) -> Scalar:
        length = self.graph.node(super().link_length(P, Q))
        if length.level is Level.POSE:
            self.loops.append(Loop(self.owner, "meeting", (length,)))
        return length

    def curve(self, curve: Tabulated, x: Scalar, order: int = 0) -> Scalar:
        at = self.graph.node(x)
        point = next((name for name in reversed(self.placing) if isinstance(self.members[name], Point)), "")
        if point and curve.ends is not None:  # of an output it is enough that it has no value there
            low, high = curve.ends
            inside = self.graph.apply("minimum", at - low, high - at)
            if Guard(point, inside) not in self.guards:
                self.guards.append(Guard(point, inside))
                self.loops += [Loop(point, "length", (inside,))] if inside.level is Level.POSE else []
        return curve.value(at, order, self.graph.pick)

    def _measure(self, node: Scalar, above: tuple[Scalar, Scalar], exact: Scalar | None = None) -> None:
        node, first, second = map(self.graph.node, (node, *above))
        self.measures.setdefault(Nearness(self.owner, node, node if exact is None else self.graph.node(exact), (first, second)))

    def stays(self, value: Scalar) -> bool:
        return self.graph.node(value).level is not Level.POSE

    @cached_property
    def away(self) -> Node:
        """A node above zero where the fixed points are near enough to the origin."""
        return self.graph.node(self.extent * AWAY**2 - self.farthest)

    @cached_property
    def farthest(self) -> Scalar:
        """The greatest square of a coordinate of fixed points [m2]."""
        places = [self.at(name) for name, point in of_kind(self.members, Point).items() if point.is_fixed]
        return reduce(np.maximum, (part * part for place in places for part in (place.x, place.y)), 0.0)

    @cached_property
    def far(self) -> Node:
        """How many times the machine's size its fixed points are away from the origin, 1 at least."""
        return self.graph.node(np.sqrt(np.maximum(self.farthest / self.extent, 1.0)))

    def nearness(self, names: Container[str], *, exact: bool = False) -> Node:
        """Return the product of the distances of some members from singular poses, each at most 1."""
        parts = (measure.exact if exact else measure.node for measure in self._measures_of(names))
        return prod((self.graph.apply("minimum", part, 1.0) for part in parts), start=self.graph.constant(1.0))

    def least_nearness(self, names: Container[str]) -> Node:
        """Return the least product of such distances that build on one another, over how many times the size the machine is away.

        Of parts that do not build on one another errors add and do not multiply. What is built on places that are found by iteration
        counts as built on all before it.
        """
        measures, lesser = tuple(self._measures_of(names)), partial(self.graph.apply, "minimum")
        if measures not in self._least:
            behind, products = list[set[int]](), list[Node]()
            for measure in measures:
                made_of = set(ancestors([measure.node]))
                poses = {node.value for node in made_of if node.op == "input" and node.level is Level.POSE}
                all_before = not poses <= of_kind(self.members, Stroke).keys()
                before = [k for k, each in enumerate(measures[: len(behind)]) if all_before or each.base in made_of]
                last = [products[k] for k in before if not any(k in behind[each] for each in before)]
                products.append(lesser(measure.node, 1.0) * reduce(lesser, last, self.graph.one))
                behind.append({*before}.union(*(behind[k] for k in before)))
            ends = [product for k, product in enumerate(products) if not any(k in each for each in behind)]
            found = reduce(lesser, ends, self.graph.one)
            self._least[measures] = found if found.op == "constant" else found / self.far
        return self._least[measures]

    def least_part(self, names: Container[str]) -> Node:
        """Return the least of the distances of some members from singular poses, at most 1."""
        parts = [measure.exact for measure in self._measures_of(names)]
        return reduce(partial(self.graph.apply, "minimum"), parts, self.graph.one)

    def _measures_of(self, names: Container[str]) -> list[Nearness]:
        return [measure for measure in self.measures if measure.member in names or not measure.member]

    def watched(self, names: Container[str], near: float = NEAR**2) -> list[Node]:
        """Return the nodes that are above zero where some members can be worked out, far from every singular pose."""
        parts = [measure.above for measure in self._measures_of(names)]
        is_single = len(parts) == 1 and near > 0.0  # the bounds of 0 and 1 tell nothing of it
        first, second = parts[0] if is_single else (self.least_nearness(names), self.graph.one)
        least = near * self.far if is_single else near
        return [*self.placeable(names), *([] if first.op == "constant" else [first - least * second])]

    def placeable(self, names: Container[str]) -> list[Node]:
        """Return the nodes that are above zero where some members can be worked out, with fixed points near enough to the origin."""
        guards = [guard.node for guard in self.guards if guard.member in names or not guard.member]
        return guards if self.nearness(names).op == "constant" else [*guards, self.away]

    def angle_of(self, vector: Vec) -> Scalar:
        square = self.graph.node(vector.square())
        is_none = square.op == "constant" and square.value == 0.0  # a point has no direction to itself
        angle = self.graph.constant(np.nan) if is_none else self.graph.node(super().angle_of(vector))
        self.angles.append(angle)
        return angle

    def watch_length(self, step: str, length: Quantity) -> None:
        """Keep a guard that is NaN where a length is negative."""
        self.guards.append(Guard(step, self.graph.apply("sqrt", self.value(length))))
        self.loops.append(Loop(step, "length", (self.graph.node(self.value(length)),)))

    def closed(self, step: Point, X: Vec) -> Vec:
        if not step.closes:
            return X

        names = step.companions or (step.name,)
        placed = [X if name == step.name else of_kind(self.members, Point)[name].place(self) for name in names]
        values = [node for place in placed for node in self.components(place)]

        def residuals(roots: tuple[Node, ...]) -> tuple[Scalar, ...]:
            for name, x, y in zip(names, roots[::2], roots[1::2], strict=True):
                self.positions[name] = Vec(x, y)
            return step.constraints(self)

        known = step.sense * self.noted[step.name] if step.sense and step.name in self.noted else None
        roots = self.graph.close(values, residuals, known)
        for name, x, y in zip(names, roots[::2], roots[1::2], strict=True):
            self.positions[name] = Vec(x, y)
        return self.positions[step.name]

    def close_angle(self, cos: Scalar, sin: Scalar) -> Turning:
        (root,) = self.graph.close((sin,), lambda roots: ((cos * cos + roots[0] * roots[0]) * 0.5,))
        return cos, root


def in_fork(value: object, nodes: Sequence[Node]) -> Any:
    """Return a value with its nodes replaced by those of the same numbers in a fork of their graph."""
    match value:
        case Node():
            return nodes[value.number]
        case Guard() | Nearness() | Loop():
            return type(value)._make(in_fork(each, nodes) for each in value)
        case tuple() | list():
            return type(value)([in_fork(each, nodes) for each in value])
        case dict():
            return {in_fork(key, nodes) if isinstance(key, Nearness) else key: in_fork(each, nodes) for key, each in value.items()}
        case Vec() | Line():
            return type(value)(*[in_fork(getattr(value, part.name), nodes) for part in fields(value)])
    return value
