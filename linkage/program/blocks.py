"""The NumPy text of a program: calls that write into a pool of registers, allocated by liveness.

Results go in by position and numbers as arrays without dimensions: a keyword costs a call 40 ns, a float 170 ns.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from .lower import plain
from .node import Node
from .schedule import Schedule

#: Operations that have no place for a result: they make a new array.
MAKERS = ("pick", "component", "solve")
#: Operations that NumPy wants the result's place named for.
NAMED = ("minimum", "maximum")


@dataclass(frozen=True)
class BlockCode:
    """A function `pose(c, i, r, o, g)` as text, how many registers it needs, and the numbers in it."""

    text: str
    registers: int
    numbers: Mapping[str, Any]


class Registers:
    """Names for the operands: constants `c`, inputs `i`, outputs `o`, and a reused pool `r`."""

    def __init__(self, plan: Schedule) -> None:
        self.names: dict[Node, str] = {node: f"c{place}" for place, node in enumerate(plan.passed)}
        self.names |= {node: f"i{place}" for place, node in enumerate(plan.pose_inputs)}
        self.outputs: Mapping[Node, str] = {node: f"o{place}" for place, node in reversed(list(enumerate(plan.outputs)))}
        self.numbers: dict[float, str] = {}
        self.free: list[str] = []
        self.count = 0

    def read(self, node: Node) -> str:
        """Return an operand's name."""
        return self.number(node.value) if node.op == "constant" else self.names[node]

    def number(self, value: float) -> str:
        """Return the name of a number."""
        return self.numbers.setdefault(value, f"k{len(self.numbers)}")

    def release(self, nodes: Iterable[Node]) -> None:
        """Give the registers of nodes that nobody reads again back to the pool."""
        for node in nodes:
            if self.names.get(node, "").startswith("r"):
                self.free.append(self.names[node])

    def take(self, node: Node) -> str:
        """Return where a node is written: its output, or a register."""
        if node.op == "solve":
            self.names[node] = f"v{node.number}"
        elif node in self.outputs:
            self.names[node] = self.outputs[node]
        elif self.free:
            self.names[node] = self.free.pop()
        else:
            self.names[node] = f"r{self.count}"
            self.count += 1
        return self.names[node]


def block_code(plan: Schedule) -> BlockCode:
    """Return the pose part as NumPy calls without temporaries."""
    registers, watched = Registers(plan), set(plan.guards)
    last = {arg: place for place, node in enumerate(plan.pose) for arg in map(plain, node.args)}
    lines: list[str] = []
    for place, node in enumerate(plan.pose):
        args = list(map(plain, node.args))
        operands = list(map(registers.read, args)) if node.op != "component" else [registers.read(args[0]), repr(int(args[1].value))]
        registers.release(arg for arg in dict.fromkeys(args) if last[arg] == place)
        target = registers.take(node)
        if node.op == "reciprocal":
            operands.insert(0, registers.number(1.0))
        lines.append(statement(node.op, ", ".join(operands), target))
        if node in watched:
            lines += guard_lines(plan, node, target)
        if node not in last:
            registers.release((node,))
    for guard in dict.fromkeys(plan.guards):
        if guard not in plan.pose:
            lines += guard_lines(plan, guard, registers.read(guard))
    copied = [(place, node) for place, node in enumerate(plan.outputs) if registers.names.get(node) != f"o{place}"]
    lines += [f"o{place}[...] = {registers.read(node)}" for place, node in copied]
    sizes = (("c", len(plan.passed)), ("i", len(plan.pose_inputs)), ("r", registers.count), ("o", len(plan.outputs)))
    unpacked = [f"{', '.join(f'{kind}{k}' for k in range(count))}, = {kind}" for kind, count in sizes if count]
    body = "\n    ".join([*unpacked, *lines]) or "pass"
    numbers = {name: np.array(value) for value, name in registers.numbers.items()}
    return BlockCode(f"def pose(c, i, r, o, g):\n    {body}\n", registers.count, numbers)


def statement(op: str, operands: str, target: str) -> str:
    """Return one operation as a line."""
    if op == "solve":
        return f"{target} = solve({operands})"
    op = "divide" if op == "reciprocal" else op
    if op in MAKERS:
        return f"{target}[...] = {op}({operands})"
    return f"{op}({operands}, {'out=' if op in NAMED else ''}{target})"


def guard_lines(plan: Schedule, node: Node, operand: str) -> list[str]:
    """Return the lines that keep the least value of a guard."""
    return [f"g[{place}] = least({operand}, None)" for place, guard in enumerate(plan.guards) if guard is node]
