"""Linear systems inside a program: Cramer's rule up to two unknowns, elimination beyond.

A larger system is one node whose value is all unknowns; `component` nodes take them out.
"""

from __future__ import annotations

from collections.abc import Sequence

from .node import Graph, Node


def solution(graph: Graph, matrix: Sequence[Sequence[Node]], right: Sequence[Node]) -> list[Node]:
    """Return the unknowns of `matrix @ u = right` as nodes."""
    if len(right) == 1:
        return [right[0] / matrix[0][0]]
    if len(right) == 2:
        (a, b), (c, d) = matrix
        inverse = 1.0 / (a * d - b * c)
        return [(right[0] * d - right[1] * b) * inverse, (right[1] * a - right[0] * c) * inverse]
    if all(each.op == "constant" and each.value == 0.0 for each in right):
        return [graph.constant(0.0)] * len(right)
    system = graph.apply("solve", *(entry for row in matrix for entry in row), *right)
    return [graph.apply("component", system, float(place)) for place in range(len(right))]
