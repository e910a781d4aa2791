"""A program made ready to run: floats for a handful of poses, NumPy blocks for more."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

from .blocks import block_code
from .node import Level, Node
from .operations import ARRAYS, FLOATS
from .schedule import schedule
from .text import function

FloatArray: TypeAlias = npt.NDArray[np.float64]
BLOCK = 8192
FEW = 20


@dataclass(frozen=True)
class Result:
    """What a kernel returns: values, shape (outputs, designs, poses), and the least value of each guard."""

    values: FloatArray
    guards: FloatArray


class Kernel:
    """Some nodes of a program as a function of designs and poses.

    `kernel(inputs)` takes a float or an array (designs,) for every dimension and a float or an array (poses,)
    or (designs, poses) for every stroke and solved coordinate, and returns values of shape (outputs, designs, poses); NaN where a pose cannot be assembled.
    A guard is a node whose least value over all poses is wanted: NaN tells that some pose is unreachable.
    """

    def __init__(self, outputs: Sequence[Node], guards: Sequence[Node] = ()) -> None:
        self.plan = schedule(outputs, guards)
        self.design_inputs = [node for node in self.plan.inputs if node.level is Level.DESIGN]
        self.pose_inputs = [node for node in self.plan.inputs if node.level is Level.POSE]

    def __call__(self, inputs: Mapping[str, Any], out: FloatArray | None = None) -> Result:
        design = [inputs[node.value] for node in self.design_inputs]
        poses = [inputs[node.value] for node in self.pose_inputs]
        m = max((np.shape(value)[0] for value in (*design, *filter(is_table, poses)) if np.ndim(value)), default=1)
        n = max((np.shape(value)[-1] for value in poses if np.ndim(value)), default=1)
        guards = np.full(len(self.plan.guards), math.inf)
        if m * n == 0:
            return Result(np.empty((len(self.plan.outputs), m, n)), guards)
        if m == 1 and n <= FEW:
            values = self._few([float(np.ravel(value)[0]) for value in design], poses, n, guards)
            if out is None:
                return Result(values, guards)
            out[...] = values
            return Result(out, guards)
        values = self._allocate(m, n) if out is None else out
        with np.errstate(all="ignore"):
            self._fill(self._passed(design, m), poses, values, guards)
        return Result(values, guards)

    def _allocate(self, m: int, n: int) -> FloatArray:
        """Return the result array; the longer of designs and poses is contiguous."""
        if m > n:
            return np.empty((len(self.plan.outputs), n, m)).transpose(0, 2, 1)
        return np.empty((len(self.plan.outputs), m, n))

    # -- a handful of poses, in floats ---------------------------------------------------------------

    @cached_property
    def _few_code(self) -> Any:
        plan = self.plan
        results = (*plan.outputs, *plan.guards)
        text = function("design", self.design_inputs, plan.design, plan.passed)
        text += function("pose", [*plan.passed, *self.pose_inputs], plan.pose, results)
        return compiled(text, FLOATS)

    def _few(self, design: Sequence[float], poses: Sequence[Any], n: int, guards: FloatArray) -> FloatArray:
        code, count = self._few_code, len(self.plan.outputs)
        passed = code["design"](*design)
        columns = [np.broadcast_to(np.ravel(np.asarray(value, float)), (n,)).tolist() for value in poses]
        rows = [code["pose"](*passed, *pose) for pose in zip(*columns, strict=True)] if columns else [code["pose"](*passed)] * n
        table = np.array(rows, float).reshape(n, -1).T
        if len(guards):
            guards[:] = table[count:].min(axis=1)
        return np.ascontiguousarray(table[:count, None, :])

    # -- many poses, in blocks -----------------------------------------------------------------------

    @cached_property
    def _block_code(self) -> tuple[Any, int]:
        code = block_code(self.plan)
        return compiled(code.text, ARRAYS)["pose"], code.registers

    @cached_property
    def _design_code(self) -> tuple[Any, Any]:
        text = function("design", self.design_inputs, self.plan.design, self.plan.passed)
        return compiled(text, FLOATS)["design"], compiled(text, ARRAYS)["design"]

    def _passed(self, design: Sequence[Any], m: int) -> list[Any]:
        """Return the design part: floats for one design, floats or arrays (m,) for many."""
        floats, arrays = self._design_code
        if m == 1:
            return list(floats(*(float(np.ravel(value)[0]) for value in design)))
        return list(arrays(*(np.asarray(value, float) for value in design)))

    def _fill(self, passed: Sequence[Any], poses: Sequence[Any], values: FloatArray, guards: FloatArray) -> None:
        """Evaluate block by block: the longer of designs and poses along the rows."""
        pose, registers = self._block_code
        _, m, n = values.shape
        turned = m > n
        target = values.transpose(0, 2, 1) if turned else values
        rows, length = target.shape[1:]
        columns = min(length, BLOCK)
        height = max(1, min(rows, BLOCK // columns))
        constants = [along(value, 1 if turned else 0) for value in passed]
        inputs = [along(np.transpose(value) if turned and is_table(value) else value, 0 if turned else 1) for value in poses]
        pool = registers_for(registers, height * columns)
        least = np.empty(len(guards))
        for top in range(0, rows, height):
            band = slice(top, min(top + height, rows))
            for left in range(0, length, columns):
                part = slice(left, min(left + columns, length))
                block = target[:, band, part]
                shape = block.shape[1:]
                size = shape[0] * shape[1]
                if shape[0] == 1:
                    block, shape = block[:, 0], shape[1:]
                least.fill(math.inf)
                pose(
                    [window(value, band, part, shape) for value in constants],
                    [window(value, band, part, shape) for value in inputs],
                    [register[:size].reshape(shape) for register in pool],
                    list(block),
                    least,
                )
                np.minimum(guards, least, out=guards)


def compiled(text: str, names: Mapping[str, Any]) -> dict[str, Any]:
    """Return the functions of a program's text."""
    space: dict[str, Any] = dict(names) | {"nan": math.nan, "inf": math.inf}
    exec(compile(text, "<linkage program>", "exec"), space)
    return space


def is_table(value: Any) -> bool:
    """Return whether an input varies over designs and poses."""
    return np.ndim(value) == 2


def along(value: Any, axis: int) -> Any:
    """Return a value as it stands in a block: a float, or an array that varies along one axis or both."""
    if np.size(value) == 1:
        return float(np.ravel(value)[0])
    if is_table(value):
        return np.ascontiguousarray(value, float)
    array = np.ascontiguousarray(value, float)
    return array[None, :] if axis == 1 else array[:, None]


def window(value: Any, band: slice, part: slice, shape: tuple[int, ...]) -> Any:
    """Return the part of a value that a block sees."""
    if isinstance(value, float):
        return value
    seen = value[band if value.shape[0] > 1 else slice(None), part if value.shape[1] > 1 else slice(None)]
    return seen if len(shape) == 2 else seen[0] if seen.shape[1] > 1 or shape[0] == 1 else float(seen[0, 0])


def registers_for(count: int, size: int) -> list[FloatArray]:
    """Return aligned arrays, one a register, from one pool of memory."""
    stride = -(-size // 8) * 8
    memory = np.empty(count * stride + 8)
    start = -(memory.ctypes.data // 8) % 8
    return [memory[start + k * stride : start + k * stride + size] for k in range(count)]
