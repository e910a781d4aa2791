"""Linear systems inside a program: Cramer's rule up to two unknowns, elimination beyond.

A larger system is one node whose value is all unknowns; `component` nodes take them out.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .linear import unknowns
from .node import Graph, Node
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
            found[node] = eliminated(*entries(node.graph.made("solve", args)))
            return node
        return found[node.args[0].origin][int(node.args[1].value)] if node.op == "component" else None

    return rewritten(outputs, written_out)


def eliminated(matrix: Sequence[Sequence[Node]], right: Sequence[Node]) -> list[Node]:
    """Return the unknowns of `matrix @ u = right` as plain operations; NaN or infinity where it is singular.

    The unknown that stands in the fewest rows goes next; what is zero by its structure is neither compared nor subtracted.
    """
    rows = [[*row, b] for row, b in zip(matrix, right, strict=True)]
    left = list(range(len(right)))
    done: list[tuple[int, list[Node]]] = []
    while left:
        column = min(left, key=lambda each: sum(not is_zero(row[each]) for row in rows))
        left.remove(column)
        pivot, rows = cleared(rows, column)
        done.append((column, pivot))
    found: dict[int, Node] = {}
    for column, pivot in reversed(done):
        rest = [pivot[known] * value for known, value in found.items() if not is_zero(pivot[known])]
        found[column] = (pivot[-1] - sum(rest[1:], rest[0]) if rest else pivot[-1]) / pivot[column]
    return [found[column] for column in range(len(right))]


def cleared(rows: Sequence[list[Node]], column: int) -> tuple[list[Node], list[list[Node]]]:
    """Return the row with the largest entry in a column, and the others without that column."""
    (pivot, *used), others = parted(rows, column)
    below: list[list[Node]] = []
    for row in used:  # the largest comes up, by exchange with each below
        graph, a, b = row[column].graph, np.abs(row[column]), np.abs(pivot[column])
        pairs = list(zip(pivot, row, strict=True))
        pivot = [graph.pick(a, b, x, y) for x, y in pairs]
        below.append([graph.pick(a, b, y, x) for x, y in pairs])
    inverse = 1.0 / pivot[column]
    for row in below:
        factor = row[column] * inverse
        row[column] = inverse.graph.constant(0.0)
        others.append([x if is_zero(y) or each == column else x - factor * y for each, (x, y) in enumerate(zip(row, pivot, strict=True))])
    return pivot, others


def parted(rows: Sequence[list[Node]], column: int) -> tuple[list[list[Node]], list[list[Node]]]:
    """Return the rows with an entry in a column, at least one, and the others."""
    used = [row for row in rows if not is_zero(row[column])]
    if not used:  # no unknown is there: the division by zero tells
        return [rows[0]], list(rows[1:])
    return used, [row for row in rows if is_zero(row[column])]


def is_zero(node: Node) -> bool:
    """Return whether a node is zero by the structure of its system."""
    return node.op == "constant" and node.value == 0.0
