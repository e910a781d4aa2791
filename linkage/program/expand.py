"""Linear systems written out, for languages that know only scalars: elimination with row pivots, by choices instead of jumps."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .lower import ancestors, plain
from .node import Node
from .solve import entries


def expanded(outputs: Sequence[Node]) -> list[Node]:
    """Return nodes of the same values as some outputs, without systems behind them."""
    wanted = list(map(plain, outputs))
    better: dict[Node, Node] = {}
    found: dict[Node, list[Node]] = {}
    for node in ancestors(wanted):
        args = tuple(better[plain(arg)] for arg in node.args)
        if node.op == "solve":
            found[node] = eliminated(node.graph.made("solve", args))
            better[node] = node
        elif node.op == "component":
            better[node] = found[plain(node.args[0])][int(node.args[1].value)]
        else:
            better[node] = node if args == node.args else node.graph.made(node.op, args)
    return [better[each] for each in wanted]


def eliminated(system: Node) -> list[Node]:
    """Return the unknowns of a system; NaN or infinity where it is singular."""
    graph = system.graph
    matrix, right = entries(system)
    rows = [[*row, b] for row, b in zip(matrix, right, strict=True)]
    n = len(rows)
    for k in range(n):
        for other in range(k + 1, n):  # the row with the largest entry comes up, by exchange with each below
            a, b = np.abs(rows[other][k]), np.abs(rows[k][k])
            pairs = list(zip(rows[k], rows[other], strict=True))
            rows[k] = [graph.pick(a, b, x, y) for x, y in pairs]
            rows[other] = [graph.pick(a, b, y, x) for x, y in pairs]
        inverse = 1.0 / rows[k][k]
        for other in range(k + 1, n):
            factor = rows[other][k] * inverse
            rows[other] = [*rows[other][: k + 1], *(x - factor * y for x, y in zip(rows[other][k + 1 :], rows[k][k + 1 :], strict=True))]
    unknowns: list[Node] = [right[0]] * n
    for k in reversed(range(n)):
        rest = sum((rows[k][j] * unknowns[j] for j in range(k + 1, n)), graph.constant(0.0))
        unknowns[k] = (rows[k][n] - rest) / rows[k][k]
    return unknowns
