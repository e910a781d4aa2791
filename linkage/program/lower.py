"""A program's operations as a machine does them best: one division instead of a reciprocal and a product, squares."""

from __future__ import annotations

from collections import Counter
from collections.abc import Container, Iterable, Sequence

from .node import Node


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
