"""Scalar nodes of a traced program: arithmetic on them is recorded, shared and folded.

A graph holds every distinct expression once (hash-consing). Constants are folded, divisions become
products with a shared reciprocal, and each node knows whether it depends on nothing, on the design
only, or on the stroke.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from enum import IntEnum
from typing import Any

import numpy as np

from ..errors import DefinitionError
from .operations import OPERATIONS


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

    def __init__(self, roots: tuple[Node, ...], residuals: tuple[Node, ...]) -> None:
        self.roots, self.residuals = roots, residuals
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


class Graph:
    """All nodes of a program, each once."""

    def __init__(self) -> None:
        self.nodes: list[Node] = []
        self._known: dict[tuple[Any, ...], Node] = {}

    def _make(self, op: str, args: tuple[Node, ...], value: Any, level: Level, *, unique: bool = False) -> Node:
        key = (op, value, *(each.number for each in args))
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
        simpler = SIMPLIFY[op](self, *args) if op in SIMPLIFY else None
        if simpler is not None:
            return simpler
        if op in ("add", "multiply", "minimum", "maximum") and args[0].number > args[1].number:
            args = args[::-1]
        return self._make(op, args, None, max(each.level for each in args))

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

    def close(self, values: Sequence[Any], residuals: Callable[[tuple[Node, ...]], Sequence[Any]]) -> tuple[Node, ...]:
        """Return the unknowns of a loop as roots, given their selected values and the residuals that vanish there."""
        nodes = [self.node(value) for value in values]
        if all(each.level < Level.POSE for each in nodes) and all(each.op == "constant" for each in nodes):
            return tuple(nodes)
        roots = tuple(self._make("root", (each,), None, each.level, unique=True) for each in nodes)
        closure = Closure(roots, tuple(self.node(each) for each in residuals(roots)))
        for root in roots:
            root.closure = closure
        return roots


def _split(node: Node) -> tuple[float, Node]:
    """Return a node as factor and rest: 2 * a is (2, a), -a is (-1, a)."""
    if node.op == "negative":
        factor, rest = _split(node.args[0])
        return -factor, rest
    if node.op == "multiply" and node.args[0].op == "constant":
        return node.args[0].value, node.args[1]
    if node.op == "multiply" and node.args[1].op == "constant":
        return node.args[1].value, node.args[0]
    return 1.0, node


def _scaled(graph: Graph, factor: float, node: Node) -> Node:
    if factor == 1.0:
        return node
    if factor == -1.0:
        return graph._make("negative", (node,), None, node.level)
    pair = sorted((graph.constant(factor), node), key=lambda each: each.number)
    return graph._make("multiply", tuple(pair), None, node.level)


def _is(node: Node, value: float) -> bool:
    return node.op == "constant" and node.value == value


def _combined(graph: Graph, sign: float, a: Node, b: Node) -> Node | None:
    """Return a + sign * b where it is simpler than written: zeros, signs and common factors."""
    if _is(a, 0.0):
        return b if sign > 0 else graph.apply("negative", b)
    if _is(b, 0.0):
        return a
    if a.op == "constant" or b.op == "constant":
        return None
    (p, x), (q, y) = _split(a), _split(b)
    q *= sign
    if x is y:
        return graph.constant(0.0) if p + q == 0.0 else _scaled(graph, p + q, x)
    if p == q != 1.0:
        return graph.apply("multiply", p, graph.apply("add", x, y))
    if p == -q and (p, sign) != (1.0, -1.0):
        first, second = (x, y) if p > 0 else (y, x)
        return graph.apply("multiply", abs(p), graph.apply("subtract", first, second))
    if q < 0.0 and sign > 0:
        return graph.apply("subtract", a, _scaled(graph, -q, y))
    if q > 0.0 and sign < 0 and b.op == "negative":
        return graph.apply("add", a, _scaled(graph, q, y))
    return None


def _product(graph: Graph, a: Node, b: Node) -> Node | None:
    """Return a * b where it is simpler than written: ones, zeros, and constants gathered in front."""
    (p, x), (q, y) = _split(a), _split(b)
    if a.op == "constant":
        return graph.constant(0.0) if a.value == 0.0 else _scaled(graph, a.value * q, y) if (q != 1.0 or a.value in (1.0, -1.0)) else None
    if b.op == "constant":
        return graph.apply("multiply", b, a)
    if p != 1.0 or q != 1.0:
        return _scaled(graph, p * q, graph.apply("multiply", x, y))
    return None


def _negated(graph: Graph, a: Node) -> Node | None:
    factor, rest = _split(a)
    if factor != 1.0:
        return _scaled(graph, -factor, rest)
    return graph.apply("subtract", a.args[1], a.args[0]) if a.op == "subtract" else None


SIMPLIFY: dict[str, Callable[..., Node | None]] = {
    "add": lambda graph, a, b: _combined(graph, 1.0, a, b),
    "subtract": lambda graph, a, b: _combined(graph, -1.0, a, b),
    "multiply": _product,
    "negative": _negated,
    "reciprocal": lambda graph, a: a.args[0] if a.op == "reciprocal" else None,
    "pick": lambda graph, a, b, x, y: x if x is y else None,
}
