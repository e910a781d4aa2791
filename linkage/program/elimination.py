"""Linear systems inside a program: Cramer's rule up to two unknowns, elimination beyond.

A larger system is one node whose value is all unknowns; `component` nodes take them out.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from heapq import heapify, heappop, heappush
from itertools import count

import numpy as np

from .node import Graph, Node
from .operations import unknowns
from .schedule import rewritten


def solution(graph: Graph, matrix: Sequence[Sequence[Node]], right: Sequence[Node], determinant: Node | None = None) -> list[Node]:
    """Return the unknowns of `matrix @ u = right` as nodes; `determinant` is the matrix's, where it is known by another way."""
    if len(right) == 1:
        return [right[0] / matrix[0][0]]
    if len(right) == 2:
        (a, b), (c, d) = matrix
        meaning = a * d - b * c
        inverse = 1.0 / meaning if determinant is None else _inverse(graph, determinant, meaning)
        r, s = (each * inverse for each in right)
        return [r * d - s * b, s * a - r * c]
    if all(each.op == "constant" and each.value == 0.0 for each in right):
        return [graph.constant(0.0)] * len(right)
    system = graph.apply("solve", *(entry for row in matrix for entry in row), *right)
    return [graph.apply("component", system, float(place)) for place in range(len(right))]


def _inverse(graph: Graph, determinant: Node, meaning: Node) -> Node:
    """Return 1 / determinant, its sign in front."""
    if determinant.op == "negative":
        return -_inverse(graph, determinant.args[0], -meaning)
    return 1.0 / graph.alias(determinant, meaning)


def entries(system: Node) -> tuple[list[list[Node]], list[Node]]:
    """Return the matrix and the right side of a system node."""
    n = unknowns(len(system.args))
    return [list(system.args[k * n : k * n + n]) for k in range(n)], list(system.args[n * n :])


# Linear systems written out, for languages that know only scalars: elimination with row pivots, by choices instead of jumps.

def expanded(outputs: Sequence[Node]) -> list[Node]:
    """Return nodes of the same values as some outputs, without systems behind them."""
    found: dict[Node, list[Node]] = {}

    def written_out(node: Node, args: tuple[Node, ...]) -> Node | None:
        if node.op == "solve":
            found[node] = eliminated(*entries(node.graph.as_written("solve", args)))
            return node
        return found[node.args[0].origin][int(node.args[1].value)] if node.op == "component" else None

    return rewritten(outputs, written_out)


def eliminated(matrix: Sequence[Sequence[Node]], right: Sequence[Node]) -> list[Node]:
    """Return the unknowns of `matrix @ u = right` as plain operations; NaN or infinity where it is singular."""
    return SparseSystem([{place: each for place, each in enumerate(row) if not is_zero(each)} for row in matrix], right).unknowns()


class SparseSystem:
    """A linear system as plain operations; entries that are zero by its structure are neither compared nor subtracted.

    `rows` are the entries of each equation by the unknown's place, as many as there are unknowns, `right` their right sides. The unknown
    that stands in the fewest equations goes next; the largest of its entries, by choices, divides. Where the system is `scaled`, its
    entries about 1 at the most, a constant of size 1 is as good and is not compared. `pivots` are what is divided by.
    """

    def __init__(self, rows: Sequence[Mapping[int, Node]], right: Sequence[Node], scaled: bool = False) -> None:
        self.last, self.scaled = len(right), scaled
        self.rows = {number: {**row, self.last: each} for number, (row, each) in enumerate(zip(rows, right, strict=True))}
        self.places: list[set[int]] = [set() for _ in range(self.last + 1)]
        for number, row in self.rows.items():
            for column in row:
                self.places[column].add(number)
        self.numbers = count(self.last)
        self.done: dict[int, dict[int, Node]] = {}
        waiting = [(len(self.places[column]), column) for column in range(self.last)]
        heapify(waiting)
        while waiting:
            size, column = heappop(waiting)
            if column not in self.done and size == len(self.places[column]):
                for each in self._cleared(column):
                    heappush(waiting, (len(self.places[each]), each))

    @property
    def pivots(self) -> list[Node]:
        """The divisors of the elimination; a system is singular where one of them is zero."""
        return [row[column] for column, row in self.done.items()]

    def unknowns(self) -> list[Node]:
        """Return the unknowns, from the last equation back."""
        found: dict[int, Node] = {}
        order: dict[int, int] = {}
        for column, row in reversed(self.done.items()):
            rest = [row[known] * found[known] for known in sorted(row.keys() & order.keys(), key=order.__getitem__)]
            found[column] = (row[self.last] - sum(rest[1:], rest[0]) if rest else row[self.last]) / row[column]
            order[column] = len(order)
        return [found[column] for column in range(self.last)]

    def _cleared(self, column: int) -> list[int]:
        """Clear a column: one of its equations is kept, the others go on without it. Return the unknowns whose counts have changed."""
        used = [self._taken(number) for number in sorted(self.places[column])]
        if not used:  # no unknown is there: the division by zero tells
            used = [self._taken(min(self.rows))]
            used[0][column] = used[0][self.last].graph.constant(0.0)
        pivot, others = self._pivot(column, used)
        self.done[column] = pivot
        inverse = 1.0 / pivot[column]
        for row in others:
            factor = row.pop(column) * inverse
            for place, value in pivot.items():
                if place != column:
                    row[place] = row[place] - factor * value if place in row else -(factor * value)
            number = next(self.numbers)
            self.rows[number] = {place: each for place, each in row.items() if place == self.last or not is_zero(each)}
            for place in self.rows[number]:
                self.places[place].add(number)
        return [place for place in dict.fromkeys(place for row in (pivot, *others) for place in row) if place not in (column, self.last)]

    def _taken(self, number: int) -> dict[int, Node]:
        """Take an equation out."""
        row = self.rows.pop(number)
        for place in row:
            self.places[place].discard(number)
        return row

    def _pivot(self, column: int, used: list[dict[int, Node]]) -> tuple[dict[int, Node], list[dict[int, Node]]]:
        """Return the equation with the largest entry in a column, and the others."""
        sure = [row for row in used if self.scaled and row[column].op == "constant" and abs(row[column].value) >= SURE]
        if sure:
            pivot = min(sure, key=len)
            return pivot, [row for row in used if row is not pivot]
        (pivot, *rest), others = used, []
        for row in rest:  # the largest comes up, by exchange with each below
            graph, a, b = row[column].graph, np.abs(row[column]), np.abs(pivot[column])
            zero = graph.constant(0.0)
            pairs = {place: (pivot.get(place, zero), row.get(place, zero)) for place in (pivot | row)}
            pivot = {place: graph.pick(a, b, x, y) for place, (x, y) in pairs.items()}
            others.append({place: graph.pick(a, b, y, x) for place, (x, y) in pairs.items()})
        return pivot, others


SURE = 0.5
"""A constant of this size divides without being compared."""


def is_zero(node: Node) -> bool:
    """Return whether a node is zero by the structure of its system."""
    return node.op == "constant" and node.value == 0.0
