"""Schedules: the operations of a kernel in their order, only the ancestors of its outputs."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Container, Iterable, Mapping, Sequence
from functools import cached_property
from heapq import heapify, heappop, heappush
from operator import attrgetter
from typing import Any

from ..frozen import record
from .node import Level, Node


def ancestors(nodes: Iterable[Node], known: Container[Node] = ()) -> list[Node]:
    """Return the nodes and all they are computed from, in order of dependence, each value once; nothing behind known ones."""
    found: set[Node] = set()
    stack = list(nodes)
    while stack:
        node = stack.pop().origin
        if node not in found:
            found.add(node)
            stack.extend(node.args if node not in known else ())
    return sorted(found, key=attrgetter("number"))


@record
class Schedule:
    """The nodes of a kernel in an order of dependence: computed once per design, then once per pose."""

    outputs: tuple[Node, ...]
    guards: tuple[Node, ...]
    design: tuple[Node, ...]
    pose: tuple[Node, ...]
    inputs: tuple[Node, ...]
    passed: tuple[Node, ...]
    """Design nodes the pose part reads, or that are outputs."""

    @cached_property
    def design_inputs(self) -> tuple[Node, ...]:
        """The dimensions."""
        return tuple(node for node in self.inputs if node.level is Level.DESIGN)

    @cached_property
    def pose_inputs(self) -> tuple[Node, ...]:
        """The strokes and the coordinates of groups."""
        return tuple(node for node in self.inputs if node.level is Level.POSE)

    @cached_property
    def input_names(self) -> tuple[list[str], list[str]]:
        """The names of the dimensions, and of the strokes and coordinates."""
        return [node.value for node in self.design_inputs], [node.value for node in self.pose_inputs]

    @cached_property
    def economical(self) -> tuple[Node, ...]:
        """The nodes of a pose in an order in which few values are alive at a time: fewer arrays, which stay in the cache."""
        return tuple(few_alive(self.pose, frozenset(self.outputs)))


def values_by_node(nodes: Iterable[Node], known: Mapping[Node, object], functions: Mapping[str, Callable[..., object]]) -> dict[Node, Any]:
    """Return known values and those of nodes, worked out one by one: a program that runs a few times is not worth its text."""
    values = dict(known)
    for node in nodes:
        values[node] = functions[node.op](*[values.get(arg.origin, arg.origin.value) for arg in node.args])
    return values


def schedule(outputs: Sequence[Node], guards: Sequence[Node] = ()) -> Schedule:
    """Return the order of evaluation for some outputs, and guards whose least value is wanted."""
    results = lowered((*outputs, *guards))
    nodes = ancestors(results)
    pose = [node for node in nodes if node.level is Level.POSE and node.op not in ("input", "constant")]
    read = {arg.origin for node in pose for arg in node.args}.union(results)
    return Schedule(
        outputs=tuple(results[: len(outputs)]),
        guards=tuple(results[len(outputs) :]),
        design=tuple(node for node in nodes if node.level is Level.DESIGN and node.op != "input"),
        pose=tuple(pose),
        inputs=tuple(node for node in nodes if node.op == "input"),
        passed=tuple(node for node in nodes if node.level is Level.DESIGN and node in read),
    )


def lowered(outputs: Sequence[Node]) -> list[Node]:
    """Return nodes of the same values as some outputs, as a machine works them out best: divisions, squares, fewer operations."""
    uses = Counter([arg.origin for node in ancestors(outputs) for arg in node.args] + [each.origin for each in outputs])

    def cheaper(node: Node, args: tuple[Node, ...]) -> Node | None:
        if node.op == "multiply":
            if args[0] is args[1]:
                return node.graph.as_written("square", args[:1])
            for place in (0, 1):  # what is used elsewhere too is not taken apart
                if args[place].op == "reciprocal" and uses[node.args[place].origin] == 1:
                    return node.graph.as_written("divide", (args[1 - place], args[place].args[0]))
        if node.op == "negative" and args[0].op == "subtract" and uses[node.args[0].origin] == 1:
            return node.graph.as_written("subtract", args[0].args[::-1])
        return None

    return rewritten(outputs, cheaper)


def rewritten(
    outputs: Sequence[Node], rule: Callable[[Node, tuple[Node, ...]], Node | None], known: Mapping[Node, Node] | None = None
) -> list[Node]:
    """Return nodes of the same values as some outputs: `rule(node, arguments)` gives another node for an operation, or None.

    `known` holds those that are settled already.
    """
    better = dict(known or {})
    for node in ancestors(outputs, better):
        if node not in better:
            args = tuple([better[arg.origin] for arg in node.args])
            better[node] = rule(node, args) or (node if args == node.args else node.graph.as_written(node.op, args))
    return [better[each.origin] for each in outputs]


def replaced(outputs: Sequence[Node], by: Mapping[Node, Node]) -> list[Node]:
    """Return nodes like some outputs, with others in the place of some they are computed from."""
    return rewritten(outputs, lambda node, args: None, by)


def few_alive(nodes: Sequence[Node], outputs: Container[Node]) -> list[Node]:
    """Return nodes in another order of dependence, next always the one that ends the most lives; outputs have a place of their own.

    Of equals the one with the youngest operands comes first, then the one with the longest way to a result. A queue holds what is ready;
    a node whose worth grows, as it is the last to read something, goes in again.
    """
    members = set(nodes)
    needs = {node: [arg for arg in dict.fromkeys([arg.origin for arg in node.args]) if arg in members] for node in nodes}
    users: dict[Node, list[Node]] = {node: [] for node in nodes}
    for node in nodes:
        for arg in needs[node]:
            users[arg].append(node)
    way = dict.fromkeys(nodes, 0)
    for node in reversed(nodes):
        way[node] = max([way[user] + 1 for user in users[node]], default=0)
    readers, waits = {node: len(users[node]) for node in nodes}, {node: len(needs[node]) for node in nodes}
    done: dict[Node, int] = {}
    turn: dict[Node, int] = {}

    def entry(node: Node) -> tuple[int, int, int, int, Node]:
        ended = sum([readers[arg] == 1 and arg not in outputs for arg in needs[node]])
        youngest = max([done[arg] for arg in needs[node]], default=-1)
        return (node not in outputs) - ended, -youngest, -way[node], turn.setdefault(node, len(turn)), node

    queue = [entry(node) for node in nodes if not waits[node]]
    heapify(queue)
    while queue:
        node = heappop(queue)[-1]
        if node in done:
            continue
        done[node] = len(done)
        for arg in needs[node]:
            readers[arg] -= 1
            if readers[arg] == 1:
                last = next(user for user in users[arg] if user not in done)
                if not waits[last]:
                    heappush(queue, entry(last))
        for user in users[node]:
            waits[user] -= 1
            if not waits[user]:
                heappush(queue, entry(user))
    return list(done)
