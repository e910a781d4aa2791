"""The NumPy text of a program: `out=` calls over a pool of registers, allocated by liveness."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from .node import Level, Node
from .schedule import Schedule, plain


@dataclass(frozen=True)
class BlockCode:
    """A function `pose(c, i, r, o, g)` as text, and how many registers it needs."""

    text: str
    registers: int


def last_uses(plan: Schedule) -> dict[Node, int]:
    """Return, for each node of the pose part, the place of the last operation that reads it."""
    uses: dict[Node, int] = {}
    for place, node in enumerate(plan.pose):
        for arg in map(plain, node.args):
            uses[arg] = place
    return uses


def guard_lines(plan: Schedule, node: Node, operand: str) -> list[str]:
    """Return the lines that keep the least value of a guard."""
    return [f"g[{place}] = least({operand})" for place, guard in enumerate(plan.guards) if guard is node]


class Registers:
    """Names for the operands: constants `c`, inputs `i`, outputs `o`, and a reused pool `r`."""

    def __init__(self, plan: Schedule) -> None:
        inputs = [node for node in plan.inputs if node.level is Level.POSE]
        self.names: dict[Node, str] = {node: f"c{place}" for place, node in enumerate(plan.passed)}
        self.names |= {node: f"i{place}" for place, node in enumerate(inputs)}
        self.outputs: Mapping[Node, str] = {node: f"o{place}" for place, node in reversed(list(enumerate(plan.outputs)))}
        self.free: list[str] = []
        self.count = 0

    def read(self, node: Node) -> str:
        """Return an operand's name."""
        return repr(node.value) if node.op == "constant" else self.names[node]

    def release(self, nodes: Iterable[Node]) -> None:
        """Give the registers of nodes that nobody reads again back to the pool."""
        for node in nodes:
            if self.names.get(node, "").startswith("r"):
                self.free.append(self.names[node])

    def take(self, node: Node) -> str:
        """Return where a node is written: its output, or a register."""
        if node in self.outputs:
            self.names[node] = self.outputs[node]
        elif self.free:
            self.names[node] = self.free.pop()
        else:
            self.names[node] = f"r{self.count}"
            self.count += 1
        return self.names[node]


def block_code(plan: Schedule) -> BlockCode:
    """Return the pose part as NumPy calls without temporaries."""
    registers, uses, watched = Registers(plan), last_uses(plan), set(plan.guards)
    lines: list[str] = []
    for place, node in enumerate(plan.pose):
        args = tuple(map(plain, node.args))
        operands = [registers.read(arg) for arg in args]
        if node.op == "solve":
            registers.names[node] = f"v{node.number}"
            lines.append(f"v{node.number} = solve({', '.join(operands)})")
            registers.release(arg for arg in dict.fromkeys(args) if uses[arg] == place and arg not in plan.outputs)
            continue
        registers.release(arg for arg in dict.fromkeys(args) if uses[arg] == place and arg not in plan.outputs)
        target = registers.take(node)
        listed = ", ".join(operands)
        lines.append(f"{target}[...] = {node.op}({listed})" if node.op in ("pick", "component") else f"{node.op}({listed}, out={target})")
        if node in watched:
            lines += guard_lines(plan, node, target)
        if node not in uses:
            registers.release((node,))
    for guard in watched - set(plan.pose):
        lines += guard_lines(plan, guard, registers.read(guard))
    copies = [(place, node) for place, node in enumerate(plan.outputs) if registers.names.get(node) != f"o{place}"]
    lines += [f"o{place}[...] = {registers.read(node)}" for place, node in copies]
    inputs = [node for node in plan.inputs if node.level is Level.POSE]
    unpack = [f"{', '.join(f'{kind}{k}' for k in range(count))}, = {kind}" for kind, count in
              (("c", len(plan.passed)), ("i", len(inputs)), ("r", registers.count), ("o", len(plan.outputs))) if count]  # fmt: skip
    body = "\n    ".join([*unpack, *lines]) or "pass"
    return BlockCode(f"def pose(c, i, r, o, g):\n    {body}\n", registers.count)
