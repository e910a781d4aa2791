"""Exact derivatives of a program, as nodes of the same program.

A loop's tangent comes from its constraint, not from differentiating the root that placed it:
residuals r(u, v) = 0 give r_u du = -r_v dv. Applied twice it gives second derivatives.
"""

from __future__ import annotations

import heapq
from collections.abc import Iterator, Mapping, Sequence

from .elimination import entries, solution
from .node import Closure, Graph, Node
from .operations import OPERATIONS


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

    def derivative(self, node: Node) -> Node:
        """Return the derivative of a node."""
        found: set[Node] = set()  # the ancestors that may have a derivative and do not know it yet
        stack, floor = [node], max(self._first, self.limit)
        while stack:
            each = stack.pop()
            if each.number >= floor and each not in found and each not in self._known:
                found.add(each)
                stack.extend(built_from(each))
        for each in sorted(found, key=lambda each: each.number):
            if each not in self._known:
                self._settle(each)
        return self._lookup(node)

    def _lookup(self, node: Node) -> Node:
        if node in self._known:
            return self._known[node]
        return self.beyond._lookup(node) if self.beyond is not None and node.number < self.limit else self.zero

    def _settle(self, node: Node) -> None:
        if node.closure is not None:
            loop, graph = node.closure, self.graph  # r_u du = -r_v dv
            held = Tangent(graph, dict.fromkeys(loop.roots, 0.0), beyond=self, limit=loop.roots[0].number)
            drive = [-held.derivative(residual) for residual in loop.residuals]
            self._known.update(zip(loop.roots, solution(graph, jacobian(graph, loop), drive, loop.determinant), strict=True))
            return
        if node.op == "alias":
            self._known[node] = self._lookup(node.args[1])
            return
        if node.op == "solve":
            self._known[node] = self.zero
            return
        if node.op == "component":
            system = node.args[0]
            if system not in self._systems:  # of A u = b: the solution of A du = db - dA u
                matrix, right = entries(system)
                found = [self.graph.apply("component", system, float(place)) for place in range(len(right))]
                drive = [
                    sum((-(self._lookup(entry) * u) for entry, u in zip(row, found, strict=True)), self._lookup(b))
                    for row, b in zip(matrix, right, strict=True)
                ]
                self._systems[system] = solution(self.graph, matrix, drive)
            self._known[node] = self._systems[system][int(node.args[1].value)]
            return
        moving = [(index, change) for index, arg in enumerate(node.args) if (change := self._lookup(arg)) is not self.zero]
        total = self.zero
        if moving:
            partials = OPERATIONS[node.op].partials(node, *node.args)
            for index, change in moving:
                part = change if partials[index] == 1.0 else change * partials[index]
                total = part if total is self.zero else total + part
        self._known[node] = total


def jacobian(graph: Graph, closure: Closure) -> Sequence[Sequence[Node]]:
    """Return the derivatives of a loop's residuals (rows) by its unknowns (columns), worked out once."""
    if closure.jacobian is None:
        columns = [Tangent(graph, {each: float(each is root) for each in closure.roots}) for root in closure.roots]
        closure.jacobian = [[column.derivative(residual) for column in columns] for residual in closure.residuals]
    return closure.jacobian


def gradient(output: Node, by: Sequence[Node]) -> list[Node]:
    """Return the derivatives of a node by some inputs, as nodes: reverse mode, which costs a few times the node, however many they are."""
    shares = Shares(output.graph, by)
    found = shares.spread({output: output.graph.constant(1.0)})
    return [found.get(each, shares.zero) for each in by]


class Shares:
    """How much each node adds to a result, worked out backwards; only where inputs in question lie behind it.

    A loop passes its share on through its constraint: with residuals r(u, v) = 0 and the shares U of its unknowns, r_u^T L = -U gives the
    shares L^T r_v of what it is built from. A system A x = b passes on A^-T X to b and -(A^-T X) x^T to A.
    Source: Griewank and Walther, "Evaluating Derivatives", 2008, 15.
    """

    def __init__(self, graph: Graph, by: Sequence[Node]) -> None:
        self.graph, self.zero = graph, graph.constant(0.0)
        self._active: dict[Node, bool] = dict.fromkeys(by, True)

    def spread(self, seeds: Mapping[Node, Node], floor: int = 0, held: Sequence[Node] = ()) -> dict[Node, Node]:
        """Return the shares of all nodes behind some; nodes made before `floor` and held ones keep theirs to themselves."""
        found = {node: share for node, share in seeds.items() if self.is_active(node)}
        queue = [-node.number for node in found]
        heapq.heapify(queue)
        settled: set[int] = set()
        while queue:
            number = -heapq.heappop(queue)
            node = self.graph.nodes[number]
            if number in settled or number < floor or node in held:
                continue
            settled.update((number,) if node.closure is None else (root.number for root in node.closure.roots))
            for arg, share in self._passed_on(node, found):
                if not self.is_active(arg):
                    continue
                if arg not in found:
                    heapq.heappush(queue, -arg.number)
                found[arg] = found[arg] + share if arg in found else share
        return found

    def is_active(self, node: Node) -> bool:
        """Return whether a node is built from one of the inputs in question."""
        stack = [node]
        while stack:
            each = stack[-1]
            behind = built_from(each)
            unknown = [arg for arg in behind if arg not in self._active]
            if each in self._active or not unknown:
                self._active.setdefault(each, any(self._active[arg] for arg in behind))
                stack.pop()
            else:
                stack += unknown
        return self._active[node]

    def _passed_on(self, node: Node, found: Mapping[Node, Node]) -> Iterator[tuple[Node, Node]]:
        """Yield the shares that a node passes on to the nodes that it is built from."""
        if node.closure is not None:
            closure, weights = node.closure, dict[Node, Node]()
            turned = [list(column) for column in zip(*jacobian(self.graph, closure), strict=True)]
            wanted = [-found.get(root, self.zero) for root in closure.roots]
            for residual, share in zip(closure.residuals, solution(self.graph, turned, wanted, closure.determinant), strict=True):
                weights[residual] = weights[residual] + share if residual in weights else share
            first = closure.roots[0].number
            spread = self.spread(weights, floor=first, held=closure.roots)
            yield from ((each, share) for each, share in spread.items() if each.number < first)
        elif node.op == "alias":
            yield node.args[1], found[node]
        elif node.op == "component":
            system, place = node.args[0], int(node.args[1].value)
            matrix, right = entries(system)
            turned = [list(column) for column in zip(*matrix, strict=True)]
            wanted = [found[node] if row == place else self.zero for row in range(len(right))]
            unknowns = [self.graph.apply("component", system, float(row)) for row in range(len(right))]
            for row, weight in enumerate(solution(self.graph, turned, wanted)):
                yield right[row], weight
                yield from ((matrix[row][column], -(weight * unknown)) for column, unknown in enumerate(unknowns))
        else:
            partials = OPERATIONS[node.op].partials(node, *node.args) if node.args else ()
            yield from ((arg, found[node] * partial) for arg, partial in zip(node.args, partials, strict=True))


def built_from(node: Node) -> Sequence[Node]:
    """Return the nodes that a node is built from, where its derivatives are concerned."""
    if node.closure is not None:
        return node.closure.sources
    return node.args[1:] if node.op == "alias" else node.args
