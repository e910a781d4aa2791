"""The text of a program: one assignment a node, in the words of a language; fused into one loop over poses, as a compiler wants it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import NamedTuple

from .node import Node
from .operations import OPERATIONS
from .schedule import Schedule, ancestors


class Dialect(NamedTuple):
    """How a language writes operations, numbers and assignments."""

    templates: Mapping[str, str]
    number: Callable[[float], str] = repr
    assignment: str = "{} = {}"


TEMPLATES: Mapping[str, str] = {name: each.text for name, each in OPERATIONS.items()}

#: Plain Python, which raises where a division or a root has no value.
PYTHON = Dialect(TEMPLATES)
#: Python that calls a function for every division, which may answer with infinity.
GUARDED = Dialect({**TEMPLATES, "divide": "divide({}, {})", "reciprocal": "reciprocal({})"})


class NodeNames:
    """The names of nodes in a text, by their place in it, so that equal programs have equal texts."""

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


# What stands above every compiled loop: functions that a compiler can work out for many poses at once.

HEAD = '''"""Made by linkage; safe to delete."""

from math import atan2, exp, floor, inf, log, nan, sqrt, tan
from typing import NamedTuple

import numpy as np
from numba import njit


@njit(inline="always")
def minimum(a, b):
    return a if a <= b or a != a else b


@njit(inline="always")
def maximum(a, b):
    return a if a >= b or a != a else b


@njit()  # not inlined where Numba sees branches, which a program of many choices has too many of
def pick(a, b, x, y):
    return x if a <= b else y


@njit(inline="always")
def sign(a):
    return a if a != a or a == 0.0 else (1.0 if a > 0.0 else -1.0)


# Sine and cosine, exact to a unit in the last place: the angle less quarter turns, in three parts (Cody and Waite, 1980), then
# the polynomials of fdlibm (Sun Microsystems, 1993). Nothing may be reordered here.

@njit(fastmath={"contract"})
def turned_back(a):
    k = floor(a * 0.6366197723675814 + 0.5)
    return k, ((a - k * 1.5707963267341256) - k * 6.077100506303966e-11) - k * 2.0222662487959506e-21


@njit(fastmath={"contract"})
def small_sine(r):
    z = r * r
    p = -2.50507602534068634195e-08 + z * 1.58969099521155010221e-10
    p = -1.98412698298579493134e-04 + z * (2.75573137070700676789e-06 + z * p)
    return r + r * z * (-1.66666666666666324348e-01 + z * (8.33333333332248946124e-03 + z * p))


@njit(fastmath={"contract"})
def small_cosine(r):
    z = r * r
    p = 2.08757232129817482790e-09 + z * -1.13596475577881948265e-11
    p = 2.48015872894767294178e-05 + z * (-2.75573143513906633035e-07 + z * p)
    return 1.0 - 0.5 * z + z * z * (4.16666666666666019037e-02 + z * (-1.38888888888741095749e-03 + z * p))


@njit(fastmath={"contract"})
def sine(a):
    k, r = turned_back(a)
    half = floor(k * 0.5)
    size = small_sine(r) if k - 2.0 * half == 0.0 else small_cosine(r)
    return size if half - 2.0 * floor(half * 0.5) == 0.0 else -size


@njit(fastmath={"contract"})
def cosine(a):
    k, r = turned_back(a)
    half = floor(k * 0.5)
    size = small_cosine(r) if k - 2.0 * half == 0.0 else -small_sine(r)
    return size if half - 2.0 * floor(half * 0.5) == 0.0 else -size


'''


#: Python as Numba compiles it: divisions and roots have a value everywhere.
NUMBA = Dialect(
    {
        **TEMPLATES,
        "sin": "sine({})",
        "cos": "cosine({})",
        "arctan2": "atan2({}, {})",
        "absolute": "abs({})",
        "power": "{} ** {}",
    }
)


def loop_text(plan: Schedule, dialect: Dialect) -> tuple[list[str], list[str], list[str]]:
    """Return the pose part in a language, a line an operation, and the names of outputs and guards.

    Constants are called c0, c1, ..., inputs i0, i1, ...
    """
    names = NodeNames(dialect, lettered("c", plan.passed) | lettered("i", plan.pose_inputs))
    lines = names.assign(plan.economical, "v")
    return lines, list(map(names.read, plan.outputs)), list(map(names.read, plan.guards))


def lettered(letter: str, nodes: Sequence[Node]) -> dict[Node, str]:
    """Return names for nodes: a letter and a number."""
    return {node: f"{letter}{place}" for place, node in enumerate(nodes)}


OPEN = 16
"""Up to so many outputs a compiler proves by itself that they do not overlap."""


def numba_text(plan: Schedule, turned: bool) -> str:
    """Return a module with `poses(c, i, o, guards, layer, line, rows, columns)`: a loop over the poses.

    Constants `c` have the shape (count, rows), inputs `i` (count, rows or 1, columns). `o` is the memory of the results, `layer` and
    `line` say how far apart outputs and rows are in it.
    `turned`: rows are poses and columns designs, so that the constants vary along the columns and the inputs do not. Many
    arrays go through a short one of their own, `s`, where the compiler sees that they do not overlap. `guards` becomes -1
    where a guard is not above zero at some pose.
    """
    inside = along_designs if turned else along_poses if len(plan.outputs) <= OPEN else along_poses_in_parts
    return HEAD + "\n".join(["def poses(c, i, o, guards, layer, line, rows, columns):", *inside(plan)]) + "\n"


def pose_loop(plan: Schedule, depth: int, count: str, given: Sequence[str], targets: Sequence[str]) -> list[str]:
    """Return the loop over so many poses: the inputs, the operations, the outputs into their targets; missed guards become -1."""
    lines, outputs, guards = loop_text(plan, NUMBA)
    results = [f"{target} = {name}" for target, name in zip(targets, outputs, strict=True)]
    missed = [f"missed{k} += 0 if {name} > 0.0 else 1" for k, name in enumerate(guards)]
    return [
        *indented(depth, *(f"missed{k} = 0" for k in range(len(guards))), f"for b in range({count}):"),
        *indented(depth + 1, *given, *lines, *results, *missed),
        *indented(depth, *(f"guards[{k}] = -1.0 if missed{k} > 0 else guards[{k}]" for k in range(len(guards)))),
    ]


def along_poses(plan: Schedule) -> list[str]:
    """Return the function's inside for few outputs: one loop a design."""
    inputs, outputs = range(len(plan.pose_inputs)), range(len(plan.outputs))
    return [
        *indented(1, "for row in range(rows):"),
        *indented(2, *row_inputs(plan), *(f"x{k} = i[{k}, across]" for k in inputs)),
        *indented(2, *(f"o{k} = o[{k} * layer + row * line:{k} * layer + row * line + columns]" for k in outputs)),
        *pose_loop(plan, 2, "columns", [f"i{k} = x{k}[b]" for k in inputs], [f"o{k}[b]" for k in outputs]),
    ]


def along_poses_in_parts(plan: Schedule) -> list[str]:
    """Return the function's inside for many outputs: a design's poses some hundred at a time, their results copied out."""
    inputs, outputs, width = range(len(plan.pose_inputs)), range(len(plan.outputs)), part_of(len(plan.outputs))
    return [
        *indented(1, f"s = np.empty({len(outputs) * width})", "for row in range(rows):"),
        *indented(2, *row_inputs(plan), f"for start in range(0, columns, {width}):"),
        *indented(3, f"count = min({width}, columns - start)", *(f"x{k} = i[{k}, across, start:start + count]" for k in inputs)),
        *pose_loop(plan, 3, "count", [f"i{k} = x{k}[b]" for k in inputs], [f"s[{k * width} + b]" for k in outputs]),
        *(line for k in outputs for line in copied_out(k, k * width)),
    ]


def along_designs(plan: Schedule) -> list[str]:
    """Return the function's inside for many designs of few poses: designs some hundred at a time, constants copied in."""
    count, outputs = len(plan.passed), range(len(plan.outputs))
    width = part_of(count + len(outputs))
    constants = [f"c{k} = s[{k * width} + b]" for k in range(count)]
    return [
        *indented(1, f"s = np.empty({(count + len(outputs)) * width})", f"for start in range(0, columns, {width}):"),
        *indented(2, f"count = min({width}, columns - start)"),
        *indented(2, *(f"s[{k * width}:{k * width} + count] = c[{k}, start:start + count]" for k in range(count))),
        *indented(2, "for row in range(rows):", *(f"    i{k} = i[{k}, row, 0]" for k in range(len(plan.pose_inputs)))),
        *pose_loop(plan, 3, "count", constants, [f"s[{(count + k) * width} + b]" for k in outputs]),
        *(line for k in outputs for line in copied_out(k, (count + k) * width)),
    ]


def part_of(arrays: int) -> int:
    """Return how many poses of so many arrays fit into a first-level cache of 32 KiB, a multiple of a vector's length."""
    return max(64, 4096 // max(arrays, 1) // 8 * 8)


def row_inputs(plan: Schedule) -> list[str]:
    """Return the lines that read a row's constants, and its row of the inputs."""
    constants = [f"c{k} = c[{k}, at]" for k in range(len(plan.passed))]
    return ["at = row if c.shape[1] > 1 else 0", *constants, "across = row if i.shape[1] > 1 else 0"]


def copied_out(output: int, place: int) -> list[str]:
    """Return the loop that copies results to where they belong."""
    head = f"first = {output} * layer + row * line + start", f"t{output} = o[first:first + count]"
    return indented(3, *head, "for b in range(count):", f"    t{output}[b] = s[{place} + b]")


def indented(depth: int, *lines: str) -> list[str]:
    """Return lines under some levels of blocks."""
    return ["    " * depth + line for line in lines]


# A program over lanes that lie beside each other in rows of one memory `s`: lane b of row k is s[k * width + b].


def lane_loop(rows: Mapping[Node, int], results: Sequence[tuple[int, Node]], width: int, dialect: Dialect) -> list[str]:
    """Return the loop that reads nodes from rows, works out others, which depend on these alone, and writes results into rows."""
    own = [node for node in ancestors([node for _, node in results], rows) if node not in rows and node.op not in ("constant", "input")]
    read = {arg.origin for node in own for arg in node.args} | {node.origin for _, node in results}
    given = {node: f"x{row}" for node, row in rows.items() if node in read}
    names = NodeNames(dialect, given)
    lines = [f"x{row} = s[{row * width} + b]" for node, row in rows.items() if node in read]
    lines += names.assign(own, "v")
    lines += [f"s[{row * width} + b] = {names.read(node)}" for row, node in results]
    return [f"for b in range({width}):", *indented(1, *lines)]
