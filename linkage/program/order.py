"""The order of a program's operations that needs the fewest registers, out of a few good ones."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from .lower import plain
from .node import Node


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
