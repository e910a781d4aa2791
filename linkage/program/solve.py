"""Linear systems inside a program: Cramer's rule up to two unknowns, elimination beyond.

A larger system is one node whose value is all unknowns; `component` nodes take them out.
"""

from __future__ import annotations

from collections.abc import Sequence

from .linear import unknowns
from .node import Graph, Node


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
