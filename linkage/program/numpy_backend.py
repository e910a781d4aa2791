"""Many poses, in NumPy blocks that stay in the cache."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import cache, cached_property
from pathlib import Path
from threading import local
from typing import TypeAlias, TypeGuard, cast

import numpy as np

from ..vectors import FloatArray, Numbers
from .cache import compiled
from .node import Level, Node
from .operations import ARRAYS, FLOATS
from .schedule import Schedule, rewritten
from .text import GUARDED, function_text

#: Operations that have no place for a result: they make a new array.
MAKERS = ("pick", "component", "solve")
#: Operations that NumPy wants the result's place named for.
NAMED = ("minimum", "maximum")
SMALLEST, LARGEST = 8192, 16384
"""The poses of a block."""


class NumpyBlocks:
    """A program over a pool of registers, block by block: the longer of designs and poses along the rows."""

    def __init__(self, plan: Schedule) -> None:
        self.plan = plan
        self._last: tuple[tuple[float, ...], list[FloatArray]] = (), []

    @cached_property
    def _code(self) -> tuple[str, int, Mapping[str, FloatArray]]:
        return block_code(self.plan)

    @cached_property
    def _pose(self) -> Callable[..., None]:
        text, _, numbers = self._code
        pose: Callable[..., None] = compiled(text, {**ARRAYS, **numbers})["pose"]
        return pose

    @cached_property
    def block(self) -> int:
        """The poses of a block: registers, inputs and outputs, of which half are in use at a time, fill the second-level cache."""
        rows = self._code[1] + len(self.plan.outputs) + len(self.plan.pose_inputs)
        fits: int = 2 * cache_size() // (8 * max(rows, 1))
        return min(max(1 << (fits.bit_length() - 1), SMALLEST), LARGEST)

    @cached_property
    def _design(self) -> tuple[Callable[..., Sequence[float]], Callable[..., Sequence[Numbers]]]:
        plan = self.plan
        text = function_text("design", plan.design_inputs, plan.design, plan.passed, GUARDED)
        return compiled(text, FLOATS)["design"], compiled(text, ARRAYS)["design"]

    def passed(self, design: Sequence[Numbers]) -> list[Numbers]:
        """Return the design part: floats where nothing varies, else floats or arrays over the designs."""
        floats, arrays = self._design
        single = as_floats(design)
        if single is not None:
            return list(floats(*single))
        return list(arrays(*[np.asarray(value, float) for value in design]))

    def _constants(self, design: Sequence[Numbers]) -> list[FloatArray]:
        """Return the design part as a block holds it; that of the last single design is kept."""
        key = as_floats(design)
        if key is None:
            return [in_block(value, 0) for value in self.passed(design)]
        last, found = self._last
        if last != key or not found:
            found = [np.array(value, float) for value in self.passed(key)]
            self._last = key, found
        return found

    def turns(self, m: int, n: int) -> bool:
        """Return whether designs, not poses, are best contiguous in the result."""
        return m > n

    def run(self, design: Sequence[Numbers], poses: Sequence[Numbers], values: FloatArray, guards: FloatArray) -> None:
        """Fill values, shape (outputs, designs, poses), and the least value of each guard."""
        m, n = values.shape[1:]
        if min(m, n) == 1 and m * n <= self.block:  # one row
            constants = self._constants(design) if m == 1 else list(map(in_block, self.passed(design)))
            row = values[:, 0] if m == 1 else values[:, :, 0]
            self._pose(constants, list(map(in_block, poses)), registers_of(self._code[1], m * n), list(row), guards)
            return
        turned = self.turns(m, n)
        target = values.transpose(0, 2, 1) if turned else values
        inputs = [in_block(value.T if turned and is_table(value) else value, 0 if turned else 1) for value in poses]
        rows, length = target.shape[1:]
        columns = min(length, self.block)
        height = max(1, min(rows, self.block // columns))
        pool = registers_of(self._code[1], height * columns)
        constants = [] if turned else self._constants(design)
        for left in range(0, length, columns):
            part = slice(left, min(left + columns, length))
            if turned:
                seen = design if length <= columns else [columns_part(value, part) for value in design]
                constants = [in_block(value, 1) for value in self.passed(seen)]
            for top in range(0, rows, height):
                band = slice(top, min(top + height, rows))
                here = slice(0, part.stop - part.start) if turned else part
                self._block(target[:, band, part], (constants, band, here), (inputs, band, part), pool, guards)

    def _block(self, block: FloatArray, constants: Windowed, inputs: Windowed, pool: list[FloatArray], guards: FloatArray) -> None:
        """Fill one block, shape (outputs, rows, columns); constants and inputs with the parts of them that it sees."""
        if block.shape[1] == 1:
            block = block[:, 0]
        shape = block.shape[1:]
        places = (constants, inputs)
        seen = [[window(value, band, part, shape) if value.ndim else value for value in values] for values, band, part in places]
        size = math.prod(shape)
        if pool and pool[0].size != size:
            pool = [register[:size] for register in pool]
        if len(shape) > 1:
            pool = [register.reshape(shape) for register in pool]
        least = np.full(len(guards), math.inf) if len(guards) else guards
        self._pose(*seen, pool, list(block), least)
        if len(guards):
            np.minimum(guards, least, out=guards)


Windowed: TypeAlias = tuple[Sequence[FloatArray], slice, slice]
"""Values as they stand in a block, and the rows and columns of them that it sees."""


def has_many(value: Numbers) -> TypeGuard[FloatArray]:
    """Return whether an input is more than one number."""
    return value.size != 1 if type(value) is np.ndarray else type(value) is not float and np.size(value) != 1


def is_array(value: Numbers) -> TypeGuard[FloatArray]:
    """Return whether an input has a value of its own for each design or pose, of which there may be one."""
    return type(value) is not float and np.ndim(value) > 0


def is_table(value: Numbers) -> TypeGuard[FloatArray]:
    """Return whether an input varies over designs and poses."""
    return type(value) is not float and np.ndim(value) == 2


def rows_part(value: Numbers, here: slice) -> Numbers:
    """Return the rows of an input of the poses for some designs, where it has rows of its own for them."""
    return value[here] if is_table(value) and len(value) > 1 else value


def columns_part(value: Numbers, here: slice) -> Numbers:
    """Return the columns of an input for some designs or poses, which are the last axis, where it has several."""
    return value if not is_array(value) or value.shape[-1] == 1 else value[..., here]


def as_floats(values: Sequence[Numbers]) -> tuple[float, ...] | None:
    """Return inputs that are one number each; None where one of them is not."""
    if {float}.issuperset(map(type, values)):
        return tuple(cast(Sequence[float], values))
    return None if any(map(has_many, values)) else tuple(float(np.ravel(value)[0]) for value in values)


def in_block(value: Numbers, axis: int | None = None) -> FloatArray:
    """Return a value as a block holds it: a number without dimensions, or an array that varies along one axis or both; None: of one row."""
    if type(value) is float:
        return np.array(value)
    array = np.ascontiguousarray(value, float)
    if array.size == 1:
        return array.reshape(())
    return array.reshape(-1) if axis is None else array if array.ndim == 2 else array[None, :] if axis == 1 else array[:, None]


def window(value: FloatArray, band: slice, part: slice, shape: tuple[int, ...]) -> FloatArray:
    """Return the part of a value that a block sees."""
    seen: FloatArray = value[band if value.shape[0] > 1 else slice(None), part if value.shape[1] > 1 else slice(None)]
    return seen if len(shape) == 2 else seen[0] if seen.shape[1] > 1 or shape[0] == 1 else seen[0, 0, ...]


# The text of a program as NumPy calls: results go in by position and numbers as arrays without dimensions, for a keyword costs a call
# 40 ns and a float 170 ns.


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


def block_code(plan: Schedule) -> tuple[str, int, Mapping[str, FloatArray]]:
    """Return the pose part as NumPy calls without temporaries: the text of a function `pose(c, i, r, o, g)`, its registers, its numbers."""
    registers = Registers(plan)
    watched: dict[Node, list[int]] = {}
    for place, guard in enumerate(plan.guards):
        watched.setdefault(guard, []).append(place)
    last = {arg.origin: place for place, node in enumerate(plan.economical) for arg in node.args}
    lines: list[str] = []
    for place, node in enumerate(plan.economical):
        args = [each.origin for each in node.args]
        operands = list(map(registers.read, args)) if node.op != "component" else [registers.read(args[0]), repr(int(args[1].value))]
        registers.release(arg for arg in dict.fromkeys(args) if last[arg] == place)
        target = registers.take(node)
        if node.op == "reciprocal":
            operands.insert(0, registers.number(1.0))
        op, given = ("divide" if node.op == "reciprocal" else node.op), ", ".join(operands)
        if op in MAKERS:
            lines.append(f"{target}{'' if op == 'solve' else '[...]'} = {op}({given})")
        else:
            lines.append(f"{op}({given}, {'out=' if op in NAMED else ''}{target})")
        lines += [f"g[{guard}] = least({target})" for guard in watched.pop(node, ())]
        if node not in last:
            registers.release((node,))
    lines += [f"g[{guard}] = least({registers.read(node)})" for node, places in watched.items() for guard in places]
    copied = [(place, node) for place, node in enumerate(plan.outputs) if registers.names.get(node) != f"o{place}"]
    lines += [f"o{place}[...] = {registers.read(node)}" for place, node in copied]
    sizes = (("c", len(plan.passed)), ("i", len(plan.pose_inputs)), ("r", registers.count), ("o", len(plan.outputs)))
    unpacked = [f"{', '.join(f'{kind}{k}' for k in range(count))}, = {kind}" for kind, count in sizes if count]
    body = "\n    ".join([*unpacked, *lines]) or "pass"
    numbers = {name: np.array(value) for value, name in registers.numbers.items()}
    return f"def pose(c, i, r, o, g):\n    {body}\n", registers.count, numbers


POOL = local()
"""The registers that a thread worked in last: the next block mostly wants no more of the same size."""


def registers_of(count: int, size: int) -> list[FloatArray]:
    """Return registers whose contents may be anything."""
    known, rows = getattr(POOL, "last", (0, []))
    if known != size or len(rows) < count:
        rows = aligned(count, size)
        POOL.last = size, rows
    return rows[:count]


@cache
def cache_size() -> int:
    """Return the size of the second-level cache of this machine [bytes], 1 MiB where the system does not tell."""
    try:
        text = Path("/sys/devices/system/cpu/cpu0/cache/index2/size").read_text(encoding="ascii").strip()
        return int(text.rstrip("KM")) * {"K": 1 << 10, "M": 1 << 20}.get(text[-1], 1)
    except (OSError, ValueError):
        return 1 << 20


def aligned(count: int, size: int) -> list[FloatArray]:
    """Return arrays, one a register, each at a multiple of 64 bytes, from one pool of memory.

    They lie an odd number of cache lines apart: at a power of two they would fall on the same lines of the cache.
    """
    stride = 8 * (-(-size // 8) | 1)
    memory = np.empty(count * stride + 8)
    address: int = memory.__array_interface__["data"][0]
    start = -(address // 8) % 8
    return list(memory[start : start + count * stride].reshape(count, stride)[:, :size])


def with_half_angles(outputs: Sequence[Node]) -> list[Node]:
    """Return nodes of the same values as some outputs, whose moving cosines and sines come from the tangent of half the angle.

    NumPy takes that on vectors, eight times as fast as each of the two. With t = tan(a / 2) and w = 2 / (1 + t^2): cos a = w - 1,
    sin a = t w. An error e of t comes to e sin^2 a and e sin a cos a: nothing is magnified, not at 180 degrees either.
    """

    def by_tangent(node: Node, args: tuple[Node, ...]) -> Node | None:
        if node.op not in ("cos", "sin") or node.level is not Level.POSE:
            return None
        t = node.graph.apply("tan", 0.5 * args[0])
        w = 2.0 / (1.0 + t * t)
        return w - 1.0 if node.op == "cos" else t * w

    return rewritten(outputs, by_tangent)
