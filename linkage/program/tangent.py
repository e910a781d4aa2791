"""Exact derivatives of a program, as nodes of the same program.

A loop's tangent comes from its constraint, not from differentiating the root that placed it:
residuals r(u, v) = 0 give r_u du = -r_v dv. Applied twice it gives second derivatives.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from .node import Closure, Graph, Node
from .operations import OPERATIONS
from .solve import entries, solution


class Tangent:
    """The derivative of nodes along a direction in the inputs.

    `beyond` continues another direction for nodes made before `limit`: that is how a loop's unknowns
    are held still while everything before them moves.
    """

    def __init__(self, graph: Graph, seeds: Mapping[Node, float | Node], beyond: Tangent | None = None, limit: int = 0) -> None:
        self.graph, self.beyond, self.limit = graph, beyond, limit
        self.zero = graph.constant(0.0)
        self._known: dict[Node, Node] = {node: graph.node(seed) for node, seed in seeds.items()}
        self._systems: dict[Node, list[Node]] = {}
        self._first = min((node.number for node in seeds), default=0)

    def of(self, node: Node) -> Node:
        """Return the derivative of a node."""
        for each in self._unsettled(node):
            if each not in self._known:
                self._settle(each)
        return self._lookup(node)

    def _lookup(self, node: Node) -> Node:
        if node in self._known:
            return self._known[node]
        return self.beyond._lookup(node) if self.beyond is not None and node.number < self.limit else self.zero

    def _unsettled(self, node: Node) -> list[Node]:
        """Return the ancestors that may have a derivative and do not know it yet, in order of dependence."""
        found: set[Node] = set()
        stack = [node]
        floor = max(self._first, self.limit)
        while stack:
            each = stack.pop()
            if each.number < floor or each in found or each in self._known:
                continue
            found.add(each)
            stack.extend(each.closure.sources if each.closure else each.args[1:] if each.op == "alias" else each.args)
        return sorted(found, key=lambda each: each.number)

    def _solved(self, node: Node) -> Node:
        """Return the derivative of one unknown of A u = b: the solution of A du = db - dA u."""
        system = node.args[0]
        if system not in self._systems:
            matrix, right = entries(system)
            found = [self.graph.apply("component", system, float(place)) for place in range(len(right))]
            drive = [
                sum((-(self._lookup(entry) * u) for entry, u in zip(row, found, strict=True)), self._lookup(b))
                for row, b in zip(matrix, right, strict=True)
            ]
            self._systems[system] = solution(self.graph, matrix, drive)
        return self._systems[system][int(node.args[1].value)]

    def _settle(self, node: Node) -> None:
        if node.closure is not None:
            self._known.update(zip(node.closure.roots, rates(self.graph, node.closure, self), strict=True))
            return
        if node.op == "alias":
            self._known[node] = self._lookup(node.args[1])
            return
        if node.op in ("solve", "component"):
            self._known[node] = self._solved(node) if node.op == "component" else self.zero
            return
        moving = [(index, change) for index, arg in enumerate(node.args) if (change := self._lookup(arg)) is not self.zero]
        total = self.zero
        if moving:
            partials = OPERATIONS[node.op].partials(node, *node.args)
            for index, change in moving:
                total = total + change * partials[index]
        self._known[node] = total


def rates(graph: Graph, closure: Closure, along: Tangent) -> Sequence[Node]:
    """Return the derivatives of a loop's unknowns along a direction: the solution of r_u du = -r_v dv."""
    held = Tangent(graph, dict.fromkeys(closure.roots, 0.0), beyond=along, limit=closure.roots[0].number)
    drive = [-held.of(residual) for residual in closure.residuals]
    return solution(graph, jacobian(graph, closure), drive, closure.determinant)


def jacobian(graph: Graph, closure: Closure) -> list[list[Node]]:
    """Return the derivatives of a loop's residuals (rows) by its unknowns (columns)."""
    columns = [Tangent(graph, {each: float(each is root) for each in closure.roots}) for root in closure.roots]
    return [[column.of(residual) for column in columns] for residual in closure.residuals]
