"""Scalar nodes of a traced program: arithmetic on them is recorded, shared and folded.

A graph holds every distinct expression once (hash-consing). Constants are folded, divisions become products with a shared reciprocal,
and each node knows whether it depends on nothing, on the design only, or on the stroke.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from copy import copy
from enum import IntEnum
from threading import Lock
from types import MappingProxyType
from typing import Any, NoReturn, TypeAlias

import numpy as np

from ..errors import DefinitionError
from ..vectors import Operators, Scalar
from .operations import OPERATIONS

Operand: TypeAlias = "Node | float"


class Level(IntEnum):
    """The inputs a node depends on."""

    CONSTANT = 0
    DESIGN = 1
    POSE = 2


class Node(Operators["Operand", "Node"]):
    """One scalar of the program: a constant, an input, or an operation on nodes.

    `origin` is the node that holds its value: a root or an alias is its value under another name.
    """

    __slots__ = ("args", "closure", "graph", "level", "number", "op", "origin", "value")

    def __init__(self, graph: Graph, op: str, args: tuple[Node, ...], value: float | str | None, level: Level, number: int) -> None:
        self.value: Any = value  # of an input its name, of a constant the number
        self.graph, self.op, self.args, self.level, self.number = graph, op, args, level, number
        self.origin: Node = args[0].origin if op in ("root", "alias") else self
        self.closure: Closure | None = None

    def applied(self, function: str, *operands: Operand) -> Node:
        """Return the node of NumPy's function of that name; of those that no operation is, from others."""
        rule = COMPOSED.get(function)
        return self.graph.apply(function, *operands) if rule is None else rule(self.graph, *operands)

    def _compared(self, other: object) -> NoReturn:
        """Raise DefinitionError: a rule is read once for all poses."""
        raise DefinitionError(
            "a rule is worked out for all poses at once, so that its numbers cannot be compared, in an `if` or in np.where; "
            "np.minimum, np.maximum and abs choose without asking for values."
        )

    __lt__ = __le__ = __gt__ = __ge__ = _compared

    def __array_ufunc__(self, ufunc: np.ufunc, method: str, *inputs: Operand, **options: object) -> Any:
        name = ufunc.__name__
        if method != "__call__" or options:
            return NotImplemented
        if name not in OPERATIONS and name not in COMPOSED:
            raise DefinitionError(f"{ufunc.__name__} cannot be traced; use one of: {', '.join(OPERATIONS)}.")
        return self.applied(name, *inputs)

    def __repr__(self) -> str:
        if self.op in ("constant", "input"):
            return str(self.value)
        return f"{self.op}({', '.join(f'n{each.number}' for each in self.args)})"


class Closure:
    """Unknowns that close a loop, and the residuals that vanish there.

    The values select the root; everything else (tangents, adjoints) follows from the residuals. `sources` are the nodes before the loop
    that the residuals are built from; `jacobian`, their derivatives by the unknowns, is filled in by the first who asks for it.
    """

    def __init__(self, roots: tuple[Node, ...], residuals: tuple[Node, ...], determinant: Node | None = None) -> None:
        self.roots, self.residuals, self.determinant = roots, residuals, determinant
        self.jacobian: Sequence[Sequence[Node]] | None = None
        found: dict[Node, None] = {}
        seen: set[Node] = set()
        stack = list(residuals)
        while stack:
            each = stack.pop()
            if each not in seen:
                seen.add(each)
                if each.number < roots[0].number:
                    found[each] = None
                elif each.op != "root":
                    stack.extend(each.args)
        self.sources = tuple(found)


class Graph:
    """All nodes of a program, each once.

    What is known is known by the numbers of nodes, which are the same in a fork.
    """

    def __init__(self) -> None:
        self.nodes: list[Node] = []
        self._known: dict[tuple[object, ...], int] = {}
        self._lock = Lock()
        self.zero, self.one = self.constant(0.0), self.constant(1.0)

    def fork(self) -> Graph:
        """Return a graph of the same nodes under the same numbers, free to grow on its own."""
        found = Graph()
        nodes: list[Node] = []
        found.nodes = nodes
        closures: dict[Closure, None] = {}
        for old in self.nodes:
            nodes.append(Node(found, old.op, tuple([nodes[arg.number] for arg in old.args]), old.value, old.level, old.number))
            if old.closure is not None:
                closures[old.closure] = None
        for closure in closures:
            entered = copy(closure)
            entered.roots, entered.residuals, entered.sources = (
                tuple(nodes[each.number] for each in part) for part in (closure.roots, closure.residuals, closure.sources)
            )
            entered.determinant = closure.determinant and nodes[closure.determinant.number]
            entered.jacobian = closure.jacobian and [[nodes[each.number] for each in row] for row in closure.jacobian]
            for root in entered.roots:
                root.closure = entered
        found._known = self._known.copy()
        found.zero, found.one = nodes[self.zero.number], nodes[self.one.number]
        return found

    def _new(self, op: str, args: tuple[Node, ...], value: float | str | None, level: Level) -> Node:
        node = Node(self, op, args, value, level, len(self.nodes))
        self.nodes.append(node)
        return node

    def _interned(self, key: tuple[object, ...], args: tuple[Node, ...], value: float | str | None, level: Level) -> Node:
        """Return the node that a key, which begins with its operation, is known by; made where there is none."""
        number = self._known.get(key)
        if number is None:
            with self._lock:  # two threads must not give one number to two nodes
                number = self._known.get(key)
                if number is None:
                    number = self._known[key] = self._new(str(key[0]), args, value, level).number
        return self.nodes[number]

    def constant(self, value: float) -> Node:
        """Return the node of a number."""
        return self._interned(("constant", value), (), value, Level.CONSTANT)

    def input(self, name: str, level: Level) -> Node:
        """Return the node of an input: a dimension (DESIGN) or a stroke (POSE)."""
        return self._interned(("input", name), (), name, level)

    def node(self, value: Scalar) -> Node:
        """Return a value as a node of this graph."""
        if isinstance(value, Node):
            return value
        if isinstance(value, np.ndarray) and value.size != 1:
            raise DefinitionError("An array cannot be traced into a program; make it a Dimension and give the array to the instance.")
        return self.constant(float(value))

    def apply(self, op: str, *operands: Operand) -> Node:
        """Return the node of an operation, simplified."""
        args = tuple([each if type(each) is Node else self.node(each) for each in operands])
        for each in args:
            if each.op != "constant":
                break
        else:
            if op not in ("solve", "component"):
                with np.errstate(all="ignore"):
                    return self.constant(float(OPERATIONS[op].array(*(each.value for each in args))))
        rule = SIMPLIFY.get(op)
        return (rule(self, *args) if rule is not None else None) or self.as_written(op, args)

    def as_written(self, op: str, args: tuple[Node, ...]) -> Node:
        """Return the node of an operation as it stands."""
        key = operation_key(op, args)
        number = self._known.get(key)
        if number is not None:
            return self.nodes[number]
        ordered = args if len(args) != 2 or args[0].number == key[1] else args[::-1]
        return self._interned(key, ordered, None, max([each.level for each in args]))

    def known(self, op: str, args: tuple[Node, ...]) -> Node | None:
        """Return the node of an operation where there is one already."""
        number = self._known.get(operation_key(op, args))
        return None if number is None else self.nodes[number]

    def alias(self, value: Node, meaning: Node) -> Node:
        """Return a value that is known by another way: it reads the first node and is differentiated as the second."""
        if value is meaning:
            return value
        return self._interned(("alias", value.number, meaning.number), (value, meaning), None, value.level)

    def power(self, base: Node, exponent: Operand) -> Node:
        """Return base ** exponent; whole and half exponents become products and roots."""
        if not isinstance(exponent, Node) and abs(float(exponent)) <= 8 and float(exponent).is_integer():
            count = int(float(exponent))
            result = self.one
            for _ in range(abs(count)):
                result = result * base
            return result if count >= 0 else 1.0 / result
        if not isinstance(exponent, Node) and float(exponent) == 0.5:
            return self.apply("sqrt", base)
        return self.apply("power", base, exponent)

    def pick(self, a: Operand, b: Operand, x: Operand, y: Operand) -> Node:
        """Return x where a <= b, else y."""
        return self.apply("pick", a, b, x, y)

    def close(
        self, values: Sequence[Operand], residuals: Callable[[tuple[Node, ...]], Sequence[Operand]], determinant: Node | None = None
    ) -> tuple[Node, ...]:
        """Return the unknowns of a loop as roots, given their selected values and the residuals that vanish there.

        `determinant` is that of the residuals' derivatives by the unknowns, where placing them has worked it out already.
        """
        nodes = [self.node(value) for value in values]
        if all(each.op == "constant" for each in nodes):
            return tuple(nodes)
        split = [split_sum(self, each) for each in nodes]
        with self._lock:
            roots = tuple(self._new("root", (moving,), None, moving.level) for moving, _ in split)
        unknowns = tuple(root + fixed for root, (_, fixed) in zip(roots, split, strict=True))
        closure = Closure(roots, tuple(self.node(each) for each in residuals(unknowns)), determinant)
        for root in roots:
            root.closure = closure
        return unknowns


def quotient(graph: Graph, a: Operand, b: Operand) -> Node:
    """Return a / b: a product with a reciprocal, which others share."""
    return graph.apply("multiply", a, graph.apply("reciprocal", b))


COMPOSED: Mapping[str, Callable[..., Node]] = MappingProxyType(
    {
        "divide": quotient,
        "true_divide": quotient,
        "power": lambda graph, base, exponent: graph.power(graph.node(base), exponent),
        "square": lambda graph, a: graph.apply("multiply", a, a),
        "hypot": lambda graph, a, b: graph.apply("sqrt", graph.node(a) ** 2 + graph.node(b) ** 2),
    }
)
"""The functions that are written by other operations."""


def operation_key(op: str, args: tuple[Node, ...]) -> tuple[object, ...]:
    """Return the key of an operation: the same for both orders where these do not matter."""
    if len(args) == 2:
        a, b = args[0].number, args[1].number
        return (op, b, a) if a > b and op in COMMUTATIVE else (op, a, b)
    return op, *[each.number for each in args]


COMMUTATIVE = ("add", "multiply", "minimum", "maximum")


# Rules by which an operation on nodes becomes simpler than written.
#
# Every rule is exact algebra and saves an operation or costs none: constants and design factors are gathered, since
# products of them are worked out once per design; a factor that two products share is taken out of their sum; and
# of two ways to write a sum the one whose half is known already is taken.

def is_fixed(node: Node) -> bool:
    """Return whether a node is the same at all poses of a design."""
    return node.level < 2


def equals(node: Node, value: float) -> bool:
    """Return whether a node is that number."""
    return node.op == "constant" and node.value == value


def factored(graph: Graph, node: Node) -> tuple[float, Node, Node]:
    """Return a node as number, fixed factor (of something that moves) and rest: -(2 * d) * x is (-2, d, x)."""
    if node.op == "negative":
        number, factor, rest = factored(graph, node.args[0])
        return -number, factor, rest
    if node.op == "multiply":
        for factor, rest in (node.args, node.args[::-1]):
            if factor.op == "constant":
                number, inner, rest = factored(graph, rest)
                return factor.value * number, inner, rest
            if is_fixed(factor) and not is_fixed(rest):
                number, _, factor = factored(graph, factor)
                return number, factor, rest
    return 1.0, graph.one, node


def times(graph: Graph, number: float, factor: Node, rest: Node) -> Node:
    """Return number * factor * rest; a number goes into the fixed factor, a sign in front."""
    if number == 0.0:
        return graph.zero
    if number < 0.0 and (number == -1.0 or not equals(factor, 1.0)):
        return graph.as_written("negative", (times(graph, -number, factor, rest),))
    factor = graph.constant(number) if equals(factor, 1.0) else graph.apply("multiply", number, factor)
    return scaled(graph, factor, rest)


def scaled(graph: Graph, factor: Node, node: Node) -> Node:
    """Return factor * node, into that half of a product which is known scaled already."""
    if equals(factor, 1.0):
        return node
    if node.op == "multiply" and not any(map(is_fixed, node.args)):
        for half, other in (node.args, node.args[::-1]):
            known = graph.known("multiply", (factor, half))
            if known is not None:
                return graph.apply("multiply", known, other)
    return graph.as_written("multiply", (factor, node))


def simpler_product(graph: Graph, a: Node, b: Node) -> Node | None:
    """Return a * b where it is simpler than written: ones, zeros, gathered factors, the sign in front."""
    if equals(a, 1.0):
        return b
    (p, c, x), (q, d, y) = factored(graph, a), factored(graph, b)
    if a.op == "constant":
        return times(graph, a.value * q, d, y)
    if is_fixed(a) and not is_fixed(b):
        return times(graph, p * q, graph.apply("multiply", a if p == 1.0 else times(graph, 1.0, c, x), d), y)
    if b.op == "constant" or (is_fixed(b) and not is_fixed(a)):
        return graph.apply("multiply", b, a)
    if p * q == 1.0 and p != 1.0 and equals(c, 1.0) and equals(d, 1.0):
        return graph.apply("multiply", x, y)
    if p < 0.0 or q < 0.0:
        core = graph.apply("multiply", times(graph, abs(p), c, x), times(graph, abs(q), d, y))
        return core if p * q > 0.0 else graph.apply("negative", core)
    return None


def simpler_negative(graph: Graph, a: Node) -> Node | None:
    """Return -a where it is simpler than written."""
    number, factor, rest = factored(graph, a)
    return None if number > 0.0 and (number == 1.0 or not equals(factor, 1.0)) else times(graph, -number, factor, rest)


def split_sum(graph: Graph, node: Node) -> tuple[Node, Node]:
    """Return something that moves as moving part and fixed part."""
    if node.op in ("add", "subtract"):
        a, b = node.args
        if is_fixed(b):
            return a, b if node.op == "add" else graph.apply("negative", b)
        if is_fixed(a):
            return b if node.op == "add" else graph.apply("negative", b), a
    return node, graph.zero


def simpler_sum(graph: Graph, sign: float, a: Node, b: Node) -> Node | None:
    """Return a + sign * b where it is simpler than written."""
    if equals(b, 0.0):
        return a
    if equals(a, 0.0):
        return b if sign > 0 else graph.apply("negative", b)
    if sign < 0 and (reverse := graph.known("subtract", (b, a))) is not None:
        return graph.apply("negative", reverse)
    if is_fixed(a) != is_fixed(b):
        op = "add" if sign > 0 else "subtract"
        if is_fixed(b):
            x, fixed = split_sum(graph, a)
            return None if equals(fixed, 0.0) else graph.apply("add", x, graph.apply(op, fixed, b))
        x, fixed = split_sum(graph, b)
        if not equals(fixed, 0.0):
            return graph.apply(op, graph.apply(op, a, fixed), x)
        number, factor, rest = factored(graph, b)
        return None if number > 0.0 else graph.apply("subtract" if sign > 0 else "add", a, times(graph, -number, factor, rest))
    if not is_fixed(a):
        found = sum_of_shifted(graph, sign, a, b)
        if found is not None:
            return found
    return sum_of_products(graph, sign, a, b)


def sum_of_shifted(graph: Graph, sign: float, a: Node, b: Node) -> Node | None:
    """Return a + sign * b of two that move, where their fixed parts cancel or a part of the sum is known."""
    (x, c), (y, d) = split_sum(graph, a), split_sum(graph, b)
    if equals(c, 0.0) or equals(d, 0.0):
        return None
    op = "add" if sign > 0 else "subtract"
    both = graph.apply(op, c, d)
    if equals(both, 0.0):
        return graph.apply(op, x, y)
    if (first := graph.known("add", (x, both))) is not None:
        return graph.apply(op, first, y)
    if sign < 0 and (second := graph.known("add", (y, graph.apply("negative", both)))) is not None:
        return graph.apply(op, x, second)
    return None


def sum_of_products(graph: Graph, sign: float, a: Node, b: Node) -> Node | None:
    """Return a + sign * b with signs in front and common factors taken out."""
    if a.op == "constant" or b.op == "constant":
        return None
    (p, c, x), (q, d, y) = factored(graph, a), factored(graph, b)
    q = q * sign
    if x is y and c is d:
        return times(graph, p + q, c, x)
    if x is y:
        return scaled(graph, graph.apply("add", graph.apply("multiply", p, c), graph.apply("multiply", q, d)), x)
    if c is d and abs(p) == abs(q) and not (abs(p) == 1.0 and equals(c, 1.0)):
        inner = graph.apply("add" if p == q else "subtract", x, y)
        return graph.apply("multiply", graph.apply("multiply", p, c), inner)
    sides = ((w, u, other, v) for w, u in (x.args, x.args[::-1]) for other, v in (y.args, y.args[::-1]))
    shared = next((each for each in sides if each[0] is each[2]), None) if x.op == y.op == "multiply" else None
    if shared is not None:
        w, u, _, v = shared
        u, v = times(graph, abs(p), c, u), times(graph, abs(q), d, v)
        inner = graph.apply("add" if p * q > 0 else "subtract", u, v)
        return graph.apply("multiply", w, inner if p > 0 else graph.apply("negative", inner))
    if p < 0.0 or (q < 0.0) == (sign > 0):
        u, v = times(graph, abs(p), c, x), times(graph, abs(q), d, y)
        if p > 0.0:
            return graph.apply("add" if q > 0.0 else "subtract", u, v)
        return graph.apply("negative", graph.apply("add", u, v)) if q < 0.0 else graph.apply("subtract", v, u)
    return None


def simpler_reciprocal(graph: Graph, a: Node) -> Node | None:
    """Return 1 / a where it is simpler than written: a sign goes in front."""
    if a.op == "reciprocal":
        return a.args[0]
    return graph.apply("negative", graph.apply("reciprocal", a.args[0])) if a.op == "negative" else None


SIMPLIFY: dict[str, Callable[..., Node | None]] = {
    "add": lambda graph, a, b: simpler_sum(graph, 1.0, a, b),
    "subtract": lambda graph, a, b: simpler_sum(graph, -1.0, a, b),
    "multiply": simpler_product,
    "negative": simpler_negative,
    "reciprocal": simpler_reciprocal,
    "pick": lambda graph, a, b, x, y: x if x is y else None,
}
