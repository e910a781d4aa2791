"""The text of a program: one assignment a node, in plain arithmetic that floats and arrays can run."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from .node import Node
from .operations import OPERATIONS
from .schedule import plain


def name(node: Node) -> str:
    """Return a node's name in a program's text, or its number."""
    return repr(node.value) if node.op == "constant" else f"n{node.number}"


def assignments(nodes: Iterable[Node]) -> list[str]:
    """Return one line a node: `n7 = n3 * n5`."""
    return [f"n{node.number} = {expression(node)}" for node in nodes]


def expression(node: Node) -> str:
    """Return a node's operation on its arguments' names."""
    operands = [bracketed(plain(arg)) for arg in node.args]
    return f"solve({', '.join(operands)})" if node.op == "solve" else OPERATIONS[node.op].text.format(*operands)


def bracketed(node: Node) -> str:
    """Return an operand; a negative number in brackets."""
    text = name(node)
    return f"({text})" if text.startswith("-") else text


def function(title: str, arguments: Sequence[Node], nodes: Iterable[Node], results: Sequence[Node]) -> str:
    """Return the text of a Python function that computes some nodes from others."""
    listed = "".join(name(each) + ", " for each in results)
    lines = [f"def {title}({', '.join(map(name, arguments))}):", *assignments(nodes), f"return ({listed})"]
    return "\n    ".join(lines) + "\n"
