"""Which operations a kernel does and in which order: only the ancestors of what is asked for."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Container, Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property

from .node import Level, Node

# A program's operations as a machine does them best: one division instead of a reciprocal and a product, squares.

def plain(node: Node) -> Node:
    """Return the node that holds a value: a root or an alias is its value under another name."""
    while node.op in ("root", "alias"):
        node = node.args[0]
    return node


def ancestors(nodes: Iterable[Node], known: Container[Node] = ()) -> list[Node]:
    """Return the nodes and all they are computed from, in order of dependence, each value once; nothing behind known ones."""
    found: set[Node] = set()
    stack = list(nodes)
    while stack:
        node = plain(stack.pop())
        if node not in found:
            found.add(node)
            stack.extend(node.args if node not in known else ())
    return sorted(found, key=lambda node: node.number)


def lowered(outputs: Sequence[Node]) -> list[Node]:
    """Return nodes of the same values as some outputs, with fewer operations behind them."""
    wanted = list(map(plain, outputs))
    nodes = ancestors(wanted)
    uses = Counter(arg for node in nodes for arg in map(plain, node.args)) + Counter(wanted)
    better: dict[Node, Node] = {}
    for node in nodes:
        args = tuple(better[arg] for arg in map(plain, node.args))
        better[node] = _better(node, args, uses) or (node if args == node.args else node.graph.made(node.op, args))
    return [better[each] for each in wanted]


def _better(node: Node, args: tuple[Node, ...], uses: Counter[Node]) -> Node | None:
    """Return the cheaper operation; None where there is none. What is used elsewhere too is not taken apart."""
    made, old = node.graph.made, tuple(map(plain, node.args))
    if node.op == "multiply":
        if args[0] is args[1]:
            return made("square", args[:1])
        for place in (0, 1):
            if args[place].op == "reciprocal" and uses[old[place]] == 1:
                return made("divide", (args[1 - place], args[place].args[0]))
    if node.op == "negative" and uses[old[0]] == 1 and args[0].op == "subtract":
        return made("subtract", args[0].args[::-1])
    return None


# The order of a program's operations that needs the fewest registers, out of a few good ones.

def shortest(nodes: Sequence[Node], outputs: Collection[Node]) -> tuple[Node, ...]:
    """Return the nodes in an order of dependence in which few values are alive at a time; outputs have a place of their own."""
    orders = [list(nodes), deep(nodes, outputs), eager(nodes, outputs)]
    best: list[Node] = min(orders, key=lambda order: alive(order, outputs))
    return tuple(best)


def operands(node: Node, among: Collection[Node]) -> list[Node]:
    """Return the different operands of a node that belong to some nodes."""
    return [arg for arg in dict.fromkeys(map(plain, node.args)) if arg in among]


def alive(order: Sequence[Node], outputs: Collection[Node]) -> int:
    """Return how many values besides the outputs are alive at once."""
    members = set(order)
    last = {arg: place for place, node in enumerate(order) for arg in operands(node, members)}
    count = peak = 0
    for place, node in enumerate(order):
        count += (node not in outputs) - sum(last[arg] == place and arg not in outputs for arg in operands(node, members))
        peak = max(peak, count)
    return peak


def deep(nodes: Sequence[Node], outputs: Collection[Node]) -> list[Node]:
    """Return the nodes output by output, each after its operands, the more demanding operand first (Sethi and Ullman, 1970)."""
    members, need = set(nodes), dict[Node, int]()
    for node in nodes:
        ranks = sorted((need[arg] for arg in operands(node, members)), reverse=True)
        need[node] = max([1, *(rank + place for place, rank in enumerate(ranks))])
    order: dict[Node, None] = {}
    stack = [(node, False) for node in reversed(nodes) if node in outputs]
    while stack:
        node, ready = stack.pop()
        if node in order:
            continue
        if ready:
            order[node] = None
        else:
            stack.append((node, True))
            stack += [(arg, False) for arg in sorted(operands(node, members), key=lambda arg: need[arg])]
    return [*order, *(node for node in nodes if node not in order)]


def eager(nodes: Sequence[Node], outputs: Collection[Node]) -> list[Node]:
    """Return the nodes, next always one that ends the most lives; of equals the one with the youngest operands, then the farthest."""
    members = set(nodes)
    needs = {node: operands(node, members) for node in nodes}
    users: dict[Node, list[Node]] = {node: [] for node in nodes}
    far = dict.fromkeys(nodes, 0)
    for node in nodes:
        for arg in needs[node]:
            users[arg].append(node)
    for node in reversed(nodes):
        far[node] = max((far[user] + 1 for user in users[node]), default=0)
    left, waits = {node: len(users[node]) for node in nodes}, {node: len(needs[node]) for node in nodes}
    ready = [node for node in nodes if not waits[node]]
    born: dict[Node, int] = {}

    def worth(node: Node) -> tuple[int, int, int]:
        ended = sum(left[arg] == 1 and arg not in outputs for arg in needs[node])
        return ended - (node not in outputs), max((born[arg] for arg in needs[node]), default=-1), far[node]

    while ready:
        node = max(ready, key=worth)
        ready.remove(node)
        born[node] = len(born)
        for arg in needs[node]:
            left[arg] -= 1
        for user in users[node]:
            waits[user] -= 1
            if not waits[user]:
                ready.append(user)
    return list(born)


@dataclass(frozen=True)
class Schedule:
    """The nodes of a kernel in order: computed once per design, then once per pose."""

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


def schedule(outputs: Sequence[Node], guards: Sequence[Node] = ()) -> Schedule:
    """Return the order of evaluation for some outputs, and guards whose least value is wanted."""
    wanted = lowered((*outputs, *guards))
    out, watched = tuple(wanted[: len(outputs)]), tuple(wanted[len(outputs) :])
    nodes = ancestors(wanted)
    pose = [node for node in nodes if node.level is Level.POSE and node.op not in ("input", "constant")]
    read = {arg for node in pose for arg in map(plain, node.args)} | set(wanted)
    return Schedule(
        outputs=out,
        guards=watched,
        design=tuple(node for node in nodes if node.level is Level.DESIGN and node.op != "input"),
        pose=shortest(pose, set(out)),
        inputs=tuple(node for node in nodes if node.op == "input"),
        passed=tuple(node for node in nodes if node.level is Level.DESIGN and node in read),
    )
