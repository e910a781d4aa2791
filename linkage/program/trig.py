"""Cosine and sine from the tangent of half the angle: NumPy takes that on vectors, eight times as fast as each of the two.

With t = tan(a / 2) and w = 2 / (1 + t^2): cos a = w - 1, sin a = t w. An error e of t comes to e sin^2 a and e sin a cos a:
nothing is magnified, not at 180 degrees either.
"""

from __future__ import annotations

from collections.abc import Sequence

from .lower import ancestors, plain
from .node import Level, Node


def halved(outputs: Sequence[Node]) -> list[Node]:
    """Return nodes of the same values as some outputs, without cosines and sines of what moves."""
    wanted = list(map(plain, outputs))
    better: dict[Node, Node] = {}
    for node in ancestors(wanted):
        args = tuple(better[plain(arg)] for arg in node.args)
        if node.op in ("cos", "sin") and node.level is Level.POSE:
            t = node.graph.apply("tan", 0.5 * args[0])
            w = 2.0 / (1.0 + t * t)
            better[node] = w - 1.0 if node.op == "cos" else t * w
        else:
            better[node] = node if args == node.args else node.graph.made(node.op, args)
    return [better[each] for each in wanted]
