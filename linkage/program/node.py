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
from .simplify import offset, simpler


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
