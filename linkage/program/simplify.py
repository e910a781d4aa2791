"""Rules by which an operation on nodes becomes simpler than written.

Every rule is exact algebra and saves an operation or costs none: constants and design factors are gathered, since
products of them are worked out once per design; a factor that two products share is taken out of their sum; and
of two ways to write a sum the one whose half is known already is taken.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .node import Graph, Node


def simpler(graph: Graph, op: str, args: tuple[Node, ...]) -> Node | None:
    """Return the simpler node of an operation; None where it is simple already."""
    return SIMPLIFY[op](graph, *args) if op in SIMPLIFY else None


def is_fixed(node: Node) -> bool:
    """Return whether a node is the same at all poses of a design."""
    return node.level < 2


def is_number(node: Node, value: float) -> bool:
    """Return whether a node is that number."""
    return node.op == "constant" and node.value == value


def parts(graph: Graph, node: Node) -> tuple[Node, Node]:
    """Return a node as factor and rest, the factor a number or, of something that moves, fixed by the design."""
    if node.op == "negative":
        factor, rest = parts(graph, node.args[0])
        return graph.apply("negative", factor), rest
    if node.op == "multiply":
        for factor, rest in (node.args, node.args[::-1]):
            if factor.op == "constant" or (is_fixed(factor) and not is_fixed(rest)):
                return factor, rest
    return graph.constant(1.0), node


def scaled(graph: Graph, factor: Node, node: Node) -> Node:
    """Return factor * node, into that half of a product which is known scaled already."""
    if is_number(factor, 0.0) or is_number(factor, 1.0):
        return node if factor.value else factor
    if is_number(factor, -1.0):
        return graph.made("negative", (node,))
    if node.op == "multiply" and not any(map(is_fixed, node.args)):
        for half, other in (node.args, node.args[::-1]):
            known = graph.known("multiply", (factor, half))
            if known is not None:
                return graph.apply("multiply", known, other)
    return graph.made("multiply", (factor, node))


def product(graph: Graph, a: Node, b: Node) -> Node | None:
    """Return a * b where it is simpler than written: ones, zeros, gathered factors."""
    (p, x), (q, y) = parts(graph, a), parts(graph, b)
    if a.op == "constant" or (is_fixed(a) and not is_fixed(b)):
        return scaled(graph, graph.apply("multiply", a, q), y)
    if b.op == "constant" or (is_fixed(b) and not is_fixed(a)):
        return product(graph, b, a)
    if p.op == q.op == "constant" and not is_number(p, 1.0) and not is_number(q, 1.0):
        return scaled(graph, graph.constant(p.value * q.value), graph.apply("multiply", x, y))
    for factor, rest, other in ((p, x, b), (q, y, a)):
        if is_number(factor, -1.0):
            return graph.apply("negative", graph.apply("multiply", rest, other))
    return None


def negated(graph: Graph, a: Node) -> Node | None:
    """Return -a where it is simpler than written."""
    if a.op == "subtract":
        return graph.apply("subtract", a.args[1], a.args[0])
    factor, rest = parts(graph, a)
    if is_number(factor, 1.0):
        return None
    return scaled(graph, graph.constant(-factor.value) if factor.op == "constant" else graph.apply("negative", factor), rest)


def offset(graph: Graph, node: Node) -> tuple[Node, Node]:
    """Return something that moves as moving part and fixed part."""
    if node.op in ("add", "subtract"):
        a, b = node.args
        if is_fixed(b):
            return a, b if node.op == "add" else graph.apply("negative", b)
        if is_fixed(a):
            return b if node.op == "add" else graph.apply("negative", b), a
    return node, graph.constant(0.0)


def total(graph: Graph, sign: float, a: Node, b: Node) -> Node | None:
    """Return a + sign * b where it is simpler than written."""
    if is_number(b, 0.0):
        return a
    if is_number(a, 0.0):
        return b if sign > 0 else graph.apply("negative", b)
    if is_fixed(a) != is_fixed(b):
        return shifted(graph, sign, a, b)
    if not is_fixed(a):
        found = cancelled(graph, sign, a, b)
        if found is not None:
            return found
    return gathered(graph, sign, a, b)


def shifted(graph: Graph, sign: float, a: Node, b: Node) -> Node | None:
    """Return a + sign * b of which one is fixed, the fixed parts added up once per design."""
    op = "add" if sign > 0 else "subtract"
    if is_fixed(b):
        x, fixed = offset(graph, a)
        return None if is_number(fixed, 0.0) else graph.apply("add", x, graph.apply(op, fixed, b))
    x, fixed = offset(graph, b)
    if not is_number(fixed, 0.0):
        return graph.apply(op, graph.apply(op, a, fixed), x)
    factor, rest = parts(graph, b)
    return None if not is_number(factor, -1.0) else graph.apply("subtract" if sign > 0 else "add", a, rest)


def cancelled(graph: Graph, sign: float, a: Node, b: Node) -> Node | None:
    """Return a + sign * b of two that move, where their fixed parts cancel or a part of the sum is known."""
    (x, c), (y, d) = offset(graph, a), offset(graph, b)
    if is_number(c, 0.0) and is_number(d, 0.0):
        return None
    op = "add" if sign > 0 else "subtract"
    both = graph.apply(op, c, d)
    if is_number(both, 0.0):
        return graph.apply(op, x, y)
    if (first := graph.known("add", (x, both))) is not None:
        return graph.apply(op, first, y)
    if sign < 0 and (second := graph.known("add", (y, graph.apply("negative", both)))) is not None:
        return graph.apply(op, x, second)
    return None


def gathered(graph: Graph, sign: float, a: Node, b: Node) -> Node | None:
    """Return a + sign * b with signs in front and common factors taken out."""
    if a.op == "constant" or b.op == "constant":
        return None
    (p, x), (q, y) = parts(graph, a), parts(graph, b)
    q = q if sign > 0 else graph.apply("negative", q)
    if x is y:
        return scaled(graph, graph.apply("add", p, q), x)
    if p is q and not is_number(p, 1.0):
        return scaled(graph, p, graph.apply("add", x, y))
    if p is graph.apply("negative", q) and p.op == "constant" and abs(p.value) != 1.0:
        return scaled(graph, p, graph.apply("subtract", x, y))
    shared = common(x, y)
    if shared is not None:
        w, u, v = shared
        return graph.apply("multiply", w, graph.apply("add", graph.apply("multiply", p, u), graph.apply("multiply", q, v)))
    if is_number(p, -1.0):
        return graph.apply("subtract", scaled(graph, q, y), x)
    if sign > 0 and q.op == "constant" and q.value < 0.0:
        return graph.apply("subtract", a, scaled(graph, graph.constant(-q.value), y))
    if sign < 0 and q.op == "constant" and q.value > 0.0:
        return graph.apply("add", a, scaled(graph, q, y))
    return None


def common(x: Node, y: Node) -> tuple[Node, Node, Node] | None:
    """Return the factor two products share, and what is left of each; None where they share none."""
    if x.op == y.op == "multiply":
        for w, u in (x.args, x.args[::-1]):
            for other, v in (y.args, y.args[::-1]):
                if w is other:
                    return w, u, v
    return None


def inverse(graph: Graph, a: Node) -> Node | None:
    """Return 1 / a where it is simpler than written: a sign goes in front."""
    if a.op == "reciprocal":
        return a.args[0]
    return graph.apply("negative", graph.apply("reciprocal", a.args[0])) if a.op == "negative" else None


SIMPLIFY: dict[str, Callable[..., Node | None]] = {
    "add": lambda graph, a, b: total(graph, 1.0, a, b),
    "subtract": lambda graph, a, b: total(graph, -1.0, a, b),
    "multiply": product,
    "negative": negated,
    "reciprocal": inverse,
    "pick": lambda graph, a, b, x, y: x if x is y else None,
}
