"""Laws traced on the nodes of a program: numbers calculate as usual, and refuse operations that need their value.

A law written for arrays runs once on these. What it tests by np.any and np.all, to refuse input that has no answer, is taken
to be in order and noted. np.where chooses by a comparison; a number that it compares for equality is noted too.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

import numpy as np
from numpy.lib.mixins import NDArrayOperatorsMixin

from ..errors import DefinitionError, is_listed
from ..vectors import Operators, Scalar
from .node import Node
from .operations import OPERATIONS

MOST = 1000
"""Tests that one law may make."""
LARGEST = float(np.finfo(float).max)
REMEDY = "np.where, np.minimum, np.maximum and abs choose between numbers without asking for their values"


def valueless(what: str) -> DefinitionError:
    """Return the error for something that needs the value of a traced number."""
    return DefinitionError(f"{what} needs a number's value, which a traced law does not have; {REMEDY}.")


def method(ufunc: np.ufunc) -> Callable[..., Scalar]:
    """Return the method by which NumPy applies a function to each number of an array."""
    return lambda self, *others: ufunc(self, *others)


@dataclass(eq=False)
class Notes:
    """Conditions of traced laws: nodes `assumed` above zero, and `switches` above zero where another law holds.

    `gaps` are nodes that are above zero where a law has a value. All are kept with the name of the law that is being traced, `owner`;
    `tests` counts what it asked for. `claims` are, by the columns of one table, the gaps that were noted while each was made.
    """

    owner: str = ""
    tests: int = 0
    assumed: dict[Node, str] = field(default_factory=dict)
    switches: dict[Node, str] = field(default_factory=dict)
    gaps: dict[Node, str] = field(default_factory=dict)
    claims: dict[str, tuple[Node, ...]] = field(default_factory=dict)

    def counted(self) -> None:
        """Count a test; DefinitionError where a law does not come to an end of them."""
        self.tests += 1
        if self.tests > MOST:
            raise valueless("A loop that goes on until its numbers allow it to stop")

    def claimed(self, name: str) -> None:
        """Give to a name the gaps that were noted since the last one claimed some."""
        taken = {node for nodes in self.claims.values() for node in nodes}
        self.claims[name] = self.claims.get(name, ()) + tuple(node for node in self.gaps if node not in taken)


class Traced(Operators[Scalar, Scalar], NDArrayOperatorsMixin):
    """One number of a law at any pose: a node, and the notes of the law. Vectors are arrays of two of them."""

    __slots__ = ("node", "notes")

    def __init__(self, node: Node, notes: Notes) -> None:
        self.node, self.notes = node, notes

    def applied(self, function: str, *operands: Scalar) -> Scalar:
        """Return NumPy's function of that name of operands: of numbers by their nodes at once, of all else as NumPy takes it."""
        kinds = set(map(type, operands))
        if kinds <= NUMBERS:
            return Traced(self.node.applied(function, *map(node_of, operands)), self.notes)
        return NotImplemented if Comparison in kinds else getattr(np, function)(*operands)

    def __array_ufunc__(self, ufunc: np.ufunc, kind: str, *inputs: object, **options: Scalar) -> Scalar:
        out = options.pop("out", None)
        if kind != "__call__" or options:
            raise valueless(f"np.{ufunc.__name__}.{kind} with {', '.join(options) or 'a number'}")
        found = elementwise(lambda *numbers: self._applied(ufunc, numbers), inputs)
        if out is None:
            return found
        out[0][...] = found
        return out[0]

    def _applied(self, ufunc: np.ufunc, numbers: tuple[Scalar, ...]) -> Scalar:
        name, nodes = ufunc.__name__, [node_of(each) for each in numbers]
        if all(node is number for node, number in zip(nodes, numbers, strict=True)):
            return ufunc(*numbers)
        if name in RULES:
            return RULES[name](*numbers)
        if name in TRUTHS:
            return Comparison(TRUTHS[name](self.node.graph, *nodes), self.notes, name == "equal", name == "not_equal")
        if name not in DIRECT:
            raise DefinitionError(f"np.{name} is not among what can be traced: {', '.join(sorted(DIRECT | RULES.keys()))}.")
        return Traced(ufunc(*nodes), self.notes)

    def __array_function__(self, function: Callable[..., Scalar], types: object, args: Scalar, options: Mapping[str, Scalar]) -> Scalar:
        if function in FUNCTIONS:
            return FUNCTIONS[function](*args, **options)
        if function not in SHAPING:
            raise valueless(f"np.{function.__name__}")
        return function(*map(arrayed, args), **options)

    def __getitem__(self, place: tuple[()]) -> Traced:
        if place != ():
            raise TypeError("a traced number is one number: it has no parts")
        return self

    def __bool__(self) -> bool:
        raise valueless("A test of whether a number is zero")

    sqrt, exp, log, sin, cos, tan, arctan, arcsin, arccos, tanh, hypot, arctan2, conjugate = map(
        method,
        (np.sqrt, np.exp, np.log, np.sin, np.cos, np.tan, np.arctan, np.arcsin, np.arccos, np.tanh, np.hypot, np.arctan2, np.positive),
    )


NUMBERS = frozenset((Traced, float, int))
"""What an operator takes without asking NumPy."""


class Comparison:
    """A comparison of traced numbers: a node that is 1 where it is true, else -1.

    `thin`: it is true only where numbers are equal; `slit`: it is false only there.
    """

    __slots__ = ("notes", "slit", "thin", "truth")
    __array_ufunc__ = None

    def __init__(self, truth: Node, notes: Notes, thin: bool = False, slit: bool = False) -> None:
        self.truth, self.notes, self.thin, self.slit = truth, notes, thin, slit

    def __and__(self, other: object) -> Comparison:
        graph = self.truth.graph
        if not isinstance(other, Comparison):  # never true is so at most where numbers are equal, always true is false at most there
            other = Comparison(graph.constant(1.0 if other else -1.0), self.notes, not other, bool(other))
        return Comparison(graph.apply("minimum", self.truth, other.truth), self.notes, self.thin or other.thin, self.slit and other.slit)

    def __or__(self, other: object) -> Comparison:
        return ~(~self & (~other if isinstance(other, Comparison) else not other))

    __rand__, __ror__ = __and__, __or__

    def __invert__(self) -> Comparison:
        return Comparison(-self.truth, self.notes, self.slit, self.thin)

    def any(self) -> bool:
        """Return whether it is true anywhere: no, which is noted."""
        return not (~self).all()

    def all(self) -> bool:
        """Return whether it is true everywhere: yes, which is noted."""
        if self.truth.op == "constant":
            return bool(self.truth.value > 0.0)
        self.notes.counted()
        self.notes.assumed[self.truth] = self.notes.owner
        if self.thin:
            self.notes.switches[self.truth] = self.notes.owner
        return True

    def needed(self) -> None:
        """Note that the law has no value where it is false, and that this is no error."""
        if self.truth.op != "constant" or not self.truth.value > 0.0:
            self.notes.gaps[self.truth] = self.notes.owner

    def choose(self, x: object, y: object) -> Scalar:
        """Return x where it is true, else y."""
        for truth in [self.truth] * self.thin + [-self.truth] * self.slit:
            self.notes.switches[truth] = self.notes.owner
        graph = self.truth.graph
        return elementwise(lambda a, b: Traced(graph.pick(0.0, self.truth, node_of(a), node_of(b)), self.notes), (x, y))

    def __array_function__(self, function: Callable[..., Scalar], types: object, args: Scalar, options: Mapping[str, Scalar]) -> Scalar:
        known: dict[Scalar, Callable[..., Scalar]] = {np.any: Comparison.any, np.all: Comparison.all, np.where: Comparison.choose}
        if function not in known or options or not isinstance(args[0], Comparison):
            raise valueless(f"np.{function.__name__} of a comparison")
        return known[function](*args)

    def __bool__(self) -> bool:
        raise valueless("A comparison in an `if`, a loop, or Python's min and max")


def claim(value: Scalar, name: str) -> None:
    """Give to a name the gaps that were noted while a traced number was made; nothing for any other number."""
    found = np.asarray(value, object).flat[0] if np.size(value) == 1 else None
    if isinstance(found, Traced):
        found.notes.claimed(name)


def is_traced(value: object) -> bool:
    """Return whether a value is a number of a law that is being traced, which has no value yet."""
    return isinstance(value, Traced)


def elementwise(rule: Callable[..., Scalar], inputs: tuple[object, ...]) -> Scalar:
    """Return a rule's result for numbers, or number by number for arrays."""
    if not any(isinstance(each, np.ndarray) for each in inputs):
        return rule(*inputs)
    arrays = np.broadcast_arrays(*(arrayed(each) for each in inputs))
    found = np.empty(arrays[0].shape, object)
    for place in np.ndindex(found.shape):
        found[place] = rule(*(array[place] for array in arrays))
    return found[()]


def arrayed(value: object) -> Scalar:
    """Return a value, and each of a list of them, as an array of numbers that may be traced."""
    return [arrayed(each) for each in value] if is_listed(value) else np.asarray(value, object)


def node_of(number: object) -> Scalar:
    """Return a traced number's node; any other number as it is."""
    return number.node if type(number) is Traced else number


def hyperbolic_tangent(a: Scalar) -> Scalar:
    """Return tanh; beyond 300 it is 1 to the last digit, and the exponential keeps its value."""
    e = np.exp(-2.0 * np.minimum(np.maximum(a, -300.0), 300.0))
    return (1.0 - e) / (1.0 + e)


#: NumPy's functions that a program has.
DIRECT = frozenset(OPERATIONS.keys() - {"solve", "component", "pick"} | {"true_divide", "power", "square", "hypot"})
#: NumPy's comparisons as nodes that are 1 where they are true, else -1.
TRUTHS: Mapping[str, Callable[..., Node]] = MappingProxyType(
    {
        "less_equal": lambda graph, a, b: graph.pick(a, b, 1.0, -1.0),
        "greater_equal": lambda graph, a, b: graph.pick(b, a, 1.0, -1.0),
        "less": lambda graph, a, b: graph.pick(a, b, graph.pick(b, a, -1.0, 1.0), -1.0),  # not where one of them is NaN
        "greater": lambda graph, a, b: graph.pick(b, a, graph.pick(a, b, -1.0, 1.0), -1.0),
        "equal": lambda graph, a, b: graph.pick(np.abs(a - b), 0.0, 1.0, -1.0),
        "not_equal": lambda graph, a, b: graph.pick(np.abs(a - b), 0.0, -1.0, 1.0),
        "isfinite": lambda graph, a: graph.pick(np.abs(a), LARGEST, 1.0, -1.0),
        "isnan": lambda graph, a: graph.pick(a, np.inf, -1.0, 1.0),
    }
)
#: Functions made of those that a program has.
RULES: Mapping[str, Callable[..., Scalar]] = MappingProxyType(
    {
        "positive": lambda a: a,
        "arctan": lambda a: np.arctan2(a, 1.0),
        "arcsin": lambda a: np.arctan2(a, np.sqrt(1.0 - a * a)),
        "arccos": lambda a: np.arctan2(np.sqrt(1.0 - a * a), a),
        "tanh": hyperbolic_tangent,
        "deg2rad": lambda a: a * (np.pi / 180.0),
        "rad2deg": lambda a: a * (180.0 / np.pi),
    }
)
#: Functions of NumPy that are more than one operation on each number.
FUNCTIONS: Mapping[Callable[..., Scalar], Callable[..., Scalar]] = MappingProxyType(
    {
        np.where: lambda chosen, x, y: elementwise(lambda each, a, b: a if each else b, (chosen, x, y)),
        np.clip: lambda a, low, high: np.minimum(np.maximum(a, low), high),
        np.zeros_like: lambda a: 0.0,
        np.ones_like: lambda a: 1.0,
        np.full_like: lambda a, value: value,
    }
)
#: Functions of NumPy that put numbers side by side and work along no pose.
SHAPING = frozenset({np.stack, np.hstack, np.concatenate, np.broadcast_arrays, np.shape, np.ndim, np.size})
