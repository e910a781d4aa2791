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


def parts(graph: Graph, node: Node) -> tuple[float, Node, Node]:
    """Return a node as number, fixed factor (of something that moves) and rest: -(2 * d) * x is (-2, d, x)."""
    if node.op == "negative":
        number, factor, rest = parts(graph, node.args[0])
        return -number, factor, rest
    if node.op == "multiply":
        for factor, rest in (node.args, node.args[::-1]):
            if factor.op == "constant":
                number, inner, rest = parts(graph, rest)
                return factor.value * number, inner, rest
            if is_fixed(factor) and not is_fixed(rest):
                number, _, factor = parts(graph, factor)
                return number, factor, rest
    return 1.0, graph.constant(1.0), node


def built(graph: Graph, number: float, factor: Node, rest: Node) -> Node:
    """Return number * factor * rest; a number goes into the fixed factor, a sign in front."""
    if number == 0.0:
        return graph.constant(0.0)
    if number < 0.0 and (number == -1.0 or not is_number(factor, 1.0)):
        return graph.made("negative", (built(graph, -number, factor, rest),))
    factor = graph.constant(number) if is_number(factor, 1.0) else graph.apply("multiply", number, factor)
    return scaled(graph, factor, rest)


def scaled(graph: Graph, factor: Node, node: Node) -> Node:
    """Return factor * node, into that half of a product which is known scaled already."""
    if is_number(factor, 1.0):
        return node
    if node.op == "multiply" and not any(map(is_fixed, node.args)):
        for half, other in (node.args, node.args[::-1]):
            known = graph.known("multiply", (factor, half))
            if known is not None:
                return graph.apply("multiply", known, other)
    return graph.made("multiply", (factor, node))


def product(graph: Graph, a: Node, b: Node) -> Node | None:
    """Return a * b where it is simpler than written: ones, zeros, gathered factors, the sign in front."""
    (p, c, x), (q, d, y) = parts(graph, a), parts(graph, b)
    if a.op == "constant":
        return built(graph, a.value * q, d, y)
    if is_fixed(a) and not is_fixed(b):
        return built(graph, p * q, graph.apply("multiply", a if p == 1.0 else built(graph, 1.0, c, x), d), y)
    if b.op == "constant" or (is_fixed(b) and not is_fixed(a)):
        return graph.apply("multiply", b, a)
    if p * q == 1.0 and p != 1.0 and is_number(c, 1.0) and is_number(d, 1.0):
        return graph.apply("multiply", x, y)
    if p < 0.0 or q < 0.0:
        core = graph.apply("multiply", built(graph, abs(p), c, x), built(graph, abs(q), d, y))
        return core if p * q > 0.0 else graph.apply("negative", core)
    return None


def negated(graph: Graph, a: Node) -> Node | None:
    """Return -a where it is simpler than written."""
    number, factor, rest = parts(graph, a)
    return None if number > 0.0 and (number == 1.0 or not is_number(factor, 1.0)) else built(graph, -number, factor, rest)


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
    if sign < 0 and (reverse := graph.known("subtract", (b, a))) is not None:
        return graph.apply("negative", reverse)
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
    number, factor, rest = parts(graph, b)
    return None if number > 0.0 else graph.apply("subtract" if sign > 0 else "add", a, built(graph, -number, factor, rest))


def cancelled(graph: Graph, sign: float, a: Node, b: Node) -> Node | None:
    """Return a + sign * b of two that move, where their fixed parts cancel or a part of the sum is known."""
    (x, c), (y, d) = offset(graph, a), offset(graph, b)
    if is_number(c, 0.0) or is_number(d, 0.0):
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
    (p, c, x), (q, d, y) = parts(graph, a), parts(graph, b)
    q = q * sign
    if x is y and c is d:
        return built(graph, p + q, c, x)
    if x is y:
        return scaled(graph, graph.apply("add", graph.apply("multiply", p, c), graph.apply("multiply", q, d)), x)
    if c is d and abs(p) == abs(q) and not (abs(p) == 1.0 and is_number(c, 1.0)):
        inner = graph.apply("add" if p == q else "subtract", x, y)
        return graph.apply("multiply", graph.apply("multiply", p, c), inner)
    shared = common(x, y)
    if shared is not None:
        w, u, v = shared
        u, v = built(graph, abs(p), c, u), built(graph, abs(q), d, v)
        inner = graph.apply("add" if p * q > 0 else "subtract", u, v)
        return graph.apply("multiply", w, inner if p > 0 else graph.apply("negative", inner))
    if p < 0.0 or (q < 0.0) == (sign > 0):
        u, v = built(graph, abs(p), c, x), built(graph, abs(q), d, y)
        if p > 0.0:
            return graph.apply("add" if q > 0.0 else "subtract", u, v)
        return graph.apply("negative", graph.apply("add", u, v)) if q < 0.0 else graph.apply("subtract", v, u)
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
