"""The eager reading of a program: node by node over whole arrays. Slow and plain, the kernels' oracle."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from functools import cache
from math import frexp
from operator import attrgetter
from typing import NamedTuple

import numpy as np

from ..vectors import FloatArray, Numbers, Scalar
from .derivatives import jacobian
from .elimination import solution
from .node import Closure, Level, Node
from .operations import OPERATIONS, solve_arrays
from .schedule import ancestors, rewritten


def interpret(
    outputs: Sequence[Node], inputs: Mapping[str, Numbers], known: Mapping[Node, Numbers] | None = None, *, clipped: bool = False
) -> list[Numbers]:
    """Return the values of some nodes; every input is a float or an array, broadcast by NumPy. `known` holds values to start from.

    With `clipped` the root of what is negative by no more than rounding is zero: for poses that stand at a dead point to rounding. The root
    of a number that is plainly negative has no value there either.
    """
    values: dict[Node, Numbers] = dict(known or {})
    terms: dict[Node, Numbers] = {}
    with np.errstate(all="ignore"):
        for node in ancestors(outputs, known or {}):
            if node.op in ("constant", "input") and node not in values:
                values[node] = inputs[node.value] if node.op == "input" else float(node.value)
            elif node not in values:
                args = [*map(values.__getitem__, map(ORIGIN, node.args))]
                if clipped and node.op == "sqrt":
                    radicand = node.args[0].origin
                    negligible = args[0] >= -TO_ROUNDING * terms[radicand] if radicand in terms else True
                    args = [np.where(negligible, np.maximum(args[0], 0.0), np.nan)]  # a dead point is reached to rounding; NaN stays
                values[node] = OPERATIONS[node.op].array(*args)
            if clipped:
                terms[node] = size_of_terms(node, values, terms)
    return [values[node.origin] for node in outputs]


ORIGIN = attrgetter("origin")
"""The node that holds the value of a node."""
TO_ROUNDING = 1e-12
"""Of the size of the terms of a sum: what rounding may leave of it where it vanishes."""


def size_of_terms(node: Node, values: Mapping[Node, Numbers], terms: Mapping[Node, Numbers]) -> Numbers:
    """Return how large the terms are that a value is made of: those of a difference may be far larger than it."""
    sizes = [terms.get(arg.origin, 0.0) for arg in node.args]
    if node.op in ("add", "subtract"):
        return sizes[0] + sizes[1]
    if node.op == "multiply":
        return sizes[0] * sizes[1]
    if node.op == "square":
        return sizes[0] * sizes[0]
    if node.op in ("negative", "absolute"):
        return sizes[0]
    if node.op == "divide":
        return sizes[0] / np.abs(values[node.args[1].origin])
    if node.op in ("minimum", "maximum"):
        return np.maximum(sizes[0], sizes[1])
    return np.abs(values[node])


# What rounding leaves of a program's results: the same program run again with its last digits shaken.
#
# Every operation is rounded, and what a result loses by that is carried to it by all it is built from, amplified by each direction, loop
# and system on the way. To shake each operation by a last digit or two, a few times over, and to look how far the results scatter, measures
# all of it at once, products of near-singular loops and square roots at their ends included; a bound by first derivatives misses these.
# Source: N. J. Higham, "Accuracy and Stability of Numerical Algorithms", 2nd ed. 2002, 26 (stochastic arithmetic, after Vignes' CESTAC).

RUNS = 12
"""How often a program is run with other last digits."""
SHAKEN = 0.75 * float(np.finfo(float).eps)
"""The largest change of a result of one operation, relative: less than two last digits."""
SETTLED = 4.0
"""The last digits that iteration leaves of a group's pins."""
PERIOD = 1999
BLOCK = 256
"""So many poses at a time: all values of a program are alive at once."""
EXACT = frozenset(("constant", "input", "negative", "absolute", "sign", "minimum", "maximum", "pick", "solve", "component"))
"""Operations that do not round, or whose arguments are shaken already."""


class Iterated(NamedTuple):
    """Unknowns that come into a program as inputs, found by iteration from the residuals that vanish there."""

    inputs: tuple[Node, ...]
    residuals: tuple[Node, ...]
    rows: tuple[Node, ...]

    @classmethod
    def from_closure(cls, closure: Closure) -> Iterated:
        """Return the unknowns of a loop whose selected values are inputs."""
        graph = closure.roots[0].graph
        rows = tuple(entry for row in jacobian(graph, closure) for entry in row)
        return cls(tuple([each.origin for each in closure.roots]), closure.residuals, rows)


class Scatter:
    """The values of some nodes at poses, and how far rounding scatters them; its steps are written down once.

    `iterated` says which inputs are solutions, in the order of construction; the others are taken as exact.
    """

    def __init__(self, outputs: Sequence[Node], iterated: Sequence[Iterated]) -> None:
        self._outputs = ShakenSteps(outputs)
        self._iterated = [(each.inputs, ShakenSteps((*each.rows, *each.residuals))) for each in iterated]

    def at(self, inputs: Mapping[str, Numbers]) -> tuple[FloatArray, FloatArray]:
        """Return values and errors, both of the shape (outputs, n), for inputs as floats or (n,); NaN where there is no value."""
        every = {name: np.asarray(value, float) for name, value in inputs.items()}
        found = list[FloatArray]()
        count = max([each.size for each in every.values()], default=1)
        for first in range(0, count, BLOCK):
            given: dict[str, Numbers] = {name: each[first : first + BLOCK] if each.size > 1 else each for name, each in every.items()}
            n = min(BLOCK, count - first)
            for unknowns, steps in self._iterated:
                entries = [np.broadcast_to(each, (RUNS + 1, n)) for each in steps.values(given)]
                with np.errstate(all="ignore"):
                    change = np.array(solve_arrays(*entries))
                    at = np.stack([np.broadcast_to(given[node.value], change.shape[1:]) for node in unknowns])
                    change -= change[:, :1]
                    rest = SETTLED * np.abs(at).max(axis=0) * np.stack([noise()[node.number % PERIOD] for node in unknowns])
                given |= {node.value: at[k] - change[k] + rest[k] for k, node in enumerate(unknowns)}
            found.append(np.stack([np.broadcast_to(each, (RUNS + 1, n)) for each in self._outputs.values(given)]))
        runs = np.concatenate(found, axis=-1)
        with np.errstate(all="ignore"):
            return runs[:, 0], np.abs(runs[:, 1:] - runs[:, :1]).max(axis=1)


class ShakenSteps:
    """Some nodes as a list of steps, each run with other last digits; what is read no more is let go, so that memory stays in the cache."""

    def __init__(self, outputs: Sequence[Node]) -> None:
        nodes = ancestors(outputs)
        places = {node: place for place, node in enumerate(nodes)}
        self._outputs = [places[node.origin] for node in outputs]
        last = {places[arg.origin]: place for place, node in enumerate(nodes) for arg in node.args}
        ended: dict[int, list[int]] = {place: [] for place in range(len(nodes))}
        for arg in last.keys() - self._outputs:
            ended[last[arg]].append(arg)
        self._steps: list[tuple[Node, list[int], FloatArray | None, list[int]]] = []
        for place, node in enumerate(nodes):
            # a product with a power of two rounds nothing
            doubles = node.op == "multiply" and any([arg.op == "constant" and abs(frexp(arg.value)[0]) == 0.5 for arg in node.args])
            changes = None if node.op in EXACT or doubles else noise()[node.number % PERIOD]
            self._steps.append((node, [places[arg.origin] for arg in node.args], changes, ended[place]))

    def values(self, given: Mapping[str, Numbers]) -> list[Numbers]:
        """Return the values of the nodes, shape (runs, n) or fewer axes where nothing is rounded."""
        values: list[Scalar] = []
        with np.errstate(all="ignore"):
            for node, places, changes, ended in self._steps:
                args = [*map(values.__getitem__, places)]
                if node.op == "sqrt":
                    args = [np.maximum(args[0], 0.0)]  # a dead point is reached to rounding
                found = (OPERATIONS[node.op].array(*args) if args else given[node.value]) if node.op != "constant" else node.value
                if node.op == "arctan2":
                    found = np.where((np.asarray(args[0]) == 0.0) & (np.asarray(args[1]) == 0.0), np.nan, found)  # no direction to itself
                    if found.ndim > 1:  # within half a turn of the first run
                        found = found - 2.0 * np.pi * np.round((found - found[:1]) / (2.0 * np.pi))
                if changes is not None:
                    exact, found = found, found * changes
                    found += exact
                values.append(found)
                for place in ended:
                    values[place] = None
        return [values[place] for place in self._outputs]


@cache
def noise() -> FloatArray:
    """Return relative changes, shape (nodes, runs, 1): none in the first run. A node's are those at its number, over and over."""
    found = np.random.default_rng(2).uniform(-SHAKEN, SHAKEN, (PERIOD, RUNS + 1, 1))
    found[:, 0] = 0.0
    return found


# The same seen by a program of its own, compiled: run once with digits shaken that are far from the last ones.

COARSE = 2.0**-30
"""About how much a result of an operation is changed, relative: by between half of it and all of it."""
LAST = 2.0 * float(np.finfo(float).eps) / COARSE
"""What rounding does to a result, of what such changes do to it."""
SPREADING = frozenset(("add", "subtract", "sqrt"))
"""Operations whose results are changed, besides all that poses are worked out from: those that lose digits."""


def disturbed(outputs: Sequence[Node], iterated: Iterable[Iterated]) -> list[Node]:
    """Return nodes like some outputs, worked out from inputs and by sums and roots whose digits are changed by about COARSE.

    Unknowns that were found by iteration follow by a step of Newton's method, and are changed besides by what iteration leaves.
    """

    def changed(node: Node, by: float = COARSE) -> Node:
        return node.graph.as_written("multiply", (node, node.graph.constant(1.0 + by * coarse_noise()[node.number % PERIOD])))

    def spread(node: Node, args: tuple[Node, ...]) -> Node | None:
        return changed(node.graph.as_written(node.op, args)) if node.op in SPREADING else None

    unknowns = list(iterated)
    behind = ancestors([*outputs, *(node for each in unknowns for node in each.residuals)])
    read = {arg.origin for node in behind if node.level is Level.POSE for arg in node.args}
    solved = {node for each in unknowns for node in each.inputs}
    leaves = {node: changed(node) for node in behind if node in read - solved and (node.op == "input" or node.level is Level.DESIGN)}
    for each in unknowns:
        size = len(each.inputs)
        matrix = [each.rows[k : k + size] for k in range(0, size * size, size)]
        steps = solution(each.inputs[0].graph, matrix, rewritten(each.residuals, spread, leaves))
        reach = sum((abs(node) for node in each.inputs[1:]), abs(each.inputs[0]))
        rest = [reach * (SETTLED * COARSE * coarse_noise()[node.number % PERIOD]) for node in each.inputs]
        leaves |= {node: node - step + left for node, step, left in zip(each.inputs, steps, rest, strict=True)}
    return rewritten(outputs, spread, leaves)


@cache
def coarse_noise() -> tuple[float, ...]:
    """Return the changes of nodes by their numbers, over and over: between a half and one, of either sign."""
    random = np.random.default_rng(3)
    return tuple((random.uniform(0.5, 1.0, PERIOD) * random.choice([-1.0, 1.0], PERIOD)).tolist())
