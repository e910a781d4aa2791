"""Small linear systems inside a program: by Cramer's rule up to two unknowns."""

from __future__ import annotations

from collections.abc import Sequence

from ..errors import LinkageError
from .node import Graph, Node


def solution(graph: Graph, matrix: Sequence[Sequence[Node]], right: Sequence[Node]) -> list[Node]:
    """Return the unknowns of `matrix @ u = right` as nodes."""
    if len(right) == 1:
        return [right[0] / matrix[0][0]]
    if len(right) == 2:
        (a, b), (c, d) = matrix
        inverse = 1.0 / (a * d - b * c)
        return [(right[0] * d - right[1] * b) * inverse, (right[1] * a - right[0] * c) * inverse]
    raise LinkageError(f"A loop of {len(right)} unknowns has no closed solution.")
