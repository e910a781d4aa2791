"""Which nodes a kernel computes and in which order: only the ancestors of what is asked for."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from .node import Level, Node


def plain(node: Node) -> Node:
    """Return the node that holds a root's value: a root is its value under another name."""
    while node.op == "root":
        node = node.args[0]
    return node


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


def schedule(outputs: Sequence[Node], guards: Sequence[Node] = ()) -> Schedule:
    """Return the order of evaluation for some outputs, and guards whose least value is wanted."""
    out, watched = tuple(map(plain, outputs)), tuple(map(plain, guards))
    nodes = ancestors((*out, *watched))
    pose = tuple(node for node in nodes if node.level is Level.POSE and node.op not in ("input", "constant"))
    read = {arg for node in pose for arg in map(plain, node.args)} | set(out) | set(watched)
    return Schedule(
        outputs=out,
        guards=watched,
        design=tuple(node for node in nodes if node.level is Level.DESIGN and node.op != "input"),
        pose=pose,
        inputs=tuple(node for node in nodes if node.op == "input"),
        passed=tuple(node for node in nodes if node.level is Level.DESIGN and node in read),
    )


def ancestors(nodes: Iterable[Node]) -> list[Node]:
    """Return the nodes and all they are computed from, in order of dependence, without roots' aliases."""
    found: set[Node] = set()
    stack = list(nodes)
    while stack:
        node = plain(stack.pop())
        if node not in found:
            found.add(node)
            stack.extend(node.args)
    return sorted(found, key=lambda node: node.number)
