"""The text of a program: one assignment a node, in the words of a language."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import final

from .node import Node
from .operations import OPERATIONS


@final
@dataclass(frozen=True)
class Dialect:
    """How a language writes operations, numbers and assignments."""

    templates: Mapping[str, str]
    number: Callable[[float], str] = repr
    assignment: str = "{} = {}"


TEMPLATES: Mapping[str, str] = {name: each.text for name, each in OPERATIONS.items()}

#: Plain Python, which raises where a division or a root has no value.
PYTHON = Dialect(TEMPLATES)
#: Python that calls a function for every division, which may answer with infinity.
GUARDED = Dialect({**TEMPLATES, "divide": "divide({}, {})", "reciprocal": "reciprocal({})"})


@final
class NodeNames:
    """What the nodes are called in a text: by their place in it, so that equal programs have equal texts."""

    def __init__(self, dialect: Dialect, given: Mapping[Node, str] | None = None) -> None:
        self.dialect = dialect
        self.names: dict[Node, str] = dict(given or {})

    def read(self, node: Node) -> str:
        """Return an operand: a name, or a number; a negative one in brackets."""
        node = node.origin
        if node.op != "constant":
            return self.names[node]
        text = self.dialect.number(node.value)
        return f"({text})" if text.startswith("-") else text

    def expression(self, node: Node) -> str:
        """Return a node's operation on its arguments' names."""
        operands = list(map(self.read, node.args))
        return f"solve({', '.join(operands)})" if node.op == "solve" else self.dialect.templates[node.op].format(*operands)

    def assign(self, nodes: Iterable[Node], letter: str = "n") -> list[str]:
        """Return one line a node: `n7 = n3 * n5`."""
        lines = []
        for node in nodes:
            text = self.expression(node)
            self.names[node] = f"{letter}{len(self.names)}"
            lines.append(self.dialect.assignment.format(self.names[node], text))
        return lines


def function_text(title: str, arguments: Sequence[Node], nodes: Iterable[Node], results: Sequence[Node], dialect: Dialect) -> str:
    """Return the text of a Python function that computes some nodes from others."""
    names = NodeNames(dialect, {node: f"a{place}" for place, node in enumerate(arguments)})
    head = f"def {title}({', '.join(names.names.values())}):"
    lines = [head, *names.assign(nodes), f"return ({''.join(names.read(each) + ', ' for each in results)})"]
    return "\n    ".join(lines) + "\n"
