"""Scalar nodes of a traced program: arithmetic on them is recorded, shared and folded.

A graph holds every distinct expression once (hash-consing). Constants are folded, divisions become
products with a shared reciprocal, and each node knows whether it depends on nothing, on the design
only, or on the stroke.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from enum import IntEnum
from threading import Lock
from typing import Any

import numpy as np

from ..errors import DefinitionError
from .operations import OPERATIONS

# Rules by which an operation on nodes becomes simpler than written.
#
# Every rule is exact algebra and saves an operation or costs none: constants and design factors are gathered, since
# products of them are worked out once per design; a factor that two products share is taken out of their sum; and
# of two ways to write a sum the one whose half is known already is taken.

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


class Level(IntEnum):
    """What a node depends on."""

    CONSTANT = 0
    DESIGN = 1
    POSE = 2


class Node:
    """One scalar of the program: a constant, an input, or an operation on nodes."""

    __slots__ = ("args", "closure", "graph", "level", "number", "op", "value")

    def __init__(self, graph: Graph, op: str, args: tuple[Node, ...], value: Any, level: Level, number: int) -> None:
        self.graph, self.op, self.args, self.value, self.level, self.number = graph, op, args, value, level, number
        self.closure: Closure | None = None

    def __add__(self, other: Any) -> Node:
        return self.graph.apply("add", self, other)

    def __radd__(self, other: Any) -> Node:
        return self.graph.apply("add", other, self)

    def __sub__(self, other: Any) -> Node:
        return self.graph.apply("subtract", self, other)

    def __rsub__(self, other: Any) -> Node:
        return self.graph.apply("subtract", other, self)

    def __mul__(self, other: Any) -> Node:
        return self.graph.apply("multiply", self, other)

    def __rmul__(self, other: Any) -> Node:
        return self.graph.apply("multiply", other, self)

    def __truediv__(self, other: Any) -> Node:
        return self * self.graph.apply("reciprocal", other)

    def __rtruediv__(self, other: Any) -> Node:
        return self.graph.apply("multiply", other, self.graph.apply("reciprocal", self))

    def __pow__(self, other: Any) -> Node:
        return self.graph.power(self, other)

    def __rpow__(self, other: Any) -> Node:
        return self.graph.power(self.graph.node(other), self)

    def __neg__(self) -> Node:
        return self.graph.apply("negative", self)

    def __pos__(self) -> Node:
        return self

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **options: Any) -> Any:
        name = {"true_divide": "divide"}.get(ufunc.__name__, ufunc.__name__)
        if method != "__call__" or options:
            return NotImplemented
        if name == "divide":
            return self.graph.node(inputs[0]) / inputs[1]
        if name == "power":
            return self.graph.power(self.graph.node(inputs[0]), inputs[1])
        if name == "square":
            return inputs[0] * inputs[0]
        if name == "hypot":
            return np.sqrt(inputs[0] * inputs[0] + inputs[1] * inputs[1])
        if name not in OPERATIONS:
            raise DefinitionError(f"{ufunc.__name__} cannot be traced; use one of: {', '.join(OPERATIONS)}.")
        return self.graph.apply(name, *inputs)

    def __repr__(self) -> str:
        if self.op in ("constant", "input"):
            return str(self.value)
        return f"{self.op}({', '.join(f'n{each.number}' for each in self.args)})"


class Closure:
    """Unknowns that close a loop, and the residuals that vanish there.

    The values select the root; everything else (tangents, adjoints) follows from the residuals.
    """

    def __init__(self, roots: tuple[Node, ...], residuals: tuple[Node, ...], determinant: Node | None = None) -> None:
        self.roots, self.residuals, self.determinant = roots, residuals, determinant
        self.sources = sources(residuals, before=roots[0].number)


def sources(nodes: Sequence[Node], before: int) -> tuple[Node, ...]:
    """Return the nodes made before a number that the given ones are built from directly."""
    found: dict[Node, None] = {}
    seen: set[Node] = set()
    stack = list(nodes)
    while stack:
        each = stack.pop()
        if each in seen:
            continue
        seen.add(each)
        if each.number < before:
            found[each] = None
        else:
            stack.extend(each.args if each.op != "root" else ())
    return tuple(found)


def ordered(op: str, args: tuple[Node, ...]) -> tuple[Node, ...]:
    """Return the arguments of an operation in the order in which it is known."""
    return args[::-1] if op in ("add", "multiply", "minimum", "maximum") and args[0].number > args[1].number else args


class Graph:
    """All nodes of a program, each once."""

    def __init__(self) -> None:
        self.nodes: list[Node] = []
        self._known: dict[tuple[Any, ...], Node] = {}
        self._lock = Lock()

    def _make(self, op: str, args: tuple[Node, ...], value: Any, level: Level, *, unique: bool = False) -> Node:
        key = (op, value, *(each.number for each in args))
        with self._lock:  # two threads must not give one number to two nodes
            if not unique and key in self._known:
                return self._known[key]
            node = Node(self, op, args, value, level, len(self.nodes))
            self.nodes.append(node)
            if not unique:
                self._known[key] = node
            return node

    def constant(self, value: float) -> Node:
        """Return the node of a number."""
        return self._make("constant", (), float(value), Level.CONSTANT)

    def input(self, name: str, level: Level) -> Node:
        """Return the node of an input: a dimension (DESIGN) or a stroke (POSE)."""
        return self._make("input", (), name, level)

    def node(self, value: Any) -> Node:
        """Return a value as a node of this graph."""
        if isinstance(value, Node):
            return value
        if isinstance(value, np.ndarray) and value.size != 1:
            raise DefinitionError("An array cannot be traced into a program; make it a Dimension and give the array to the instance.")
        return self.constant(float(value))

    def apply(self, op: str, *arguments: Any) -> Node:
        """Return the node of an operation, simplified."""
        args = tuple(map(self.node, arguments))
        if op not in ("solve", "component") and all(each.op == "constant" for each in args):
            with np.errstate(all="ignore"):
                return self.constant(float(OPERATIONS[op].array(*(each.value for each in args))))
        found = simpler(self, op, args)
        return self.made(op, args) if found is None else found

    def made(self, op: str, args: tuple[Node, ...]) -> Node:
        """Return the node of an operation as it stands."""
        return self._make(op, ordered(op, args), None, max(each.level for each in args))

    def known(self, op: str, args: tuple[Node, ...]) -> Node | None:
        """Return the node of an operation where there is one already."""
        return self._known.get((op, None, *(each.number for each in ordered(op, args))))

    def alias(self, value: Node, meaning: Node) -> Node:
        """Return a value that is known by another way: it reads the first node and is differentiated as the second."""
        return value if value is meaning else self._make("alias", (value, meaning), None, value.level)

    def power(self, base: Node, exponent: Any) -> Node:
        """Return base ** exponent; whole and half exponents become products and roots."""
        if not isinstance(exponent, Node) and abs(float(exponent)) <= 8 and float(exponent).is_integer():
            count = int(float(exponent))
            result = self.constant(1.0)
            for _ in range(abs(count)):
                result = result * base
            return result if count >= 0 else 1.0 / result
        if not isinstance(exponent, Node) and float(exponent) == 0.5:
            return self.apply("sqrt", base)
        return self.apply("power", base, exponent)

    def pick(self, a: Any, b: Any, x: Any, y: Any) -> Node:
        """Return x where a <= b, else y."""
        return self.apply("pick", a, b, x, y)

    def close(
        self, values: Sequence[Any], residuals: Callable[[tuple[Node, ...]], Sequence[Any]], determinant: Node | None = None
    ) -> tuple[Node, ...]:
        """Return the unknowns of a loop as roots, given their selected values and the residuals that vanish there.

        `determinant` is that of the residuals' derivatives by the unknowns, where placing them has worked it out already.
        """
        nodes = [self.node(value) for value in values]
        if all(each.op == "constant" for each in nodes):
            return tuple(nodes)
        split = [offset(self, each) for each in nodes]
        roots = tuple(self._make("root", (moving,), None, moving.level, unique=True) for moving, _ in split)
        unknowns = tuple(root + fixed for root, (_, fixed) in zip(roots, split, strict=True))
        closure = Closure(roots, tuple(self.node(each) for each in residuals(unknowns)), determinant)
        for root in roots:
            root.closure = closure
        return unknowns
