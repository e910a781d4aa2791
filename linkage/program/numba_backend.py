"""Many poses in one compiled loop, by Numba (extra `fast`); compiled once, kept on disk."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache, cached_property
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np

from ..errors import LinkageError
from ..vectors import FloatArray, Numbers
from .cache import CompiledFile, compiled_in_file, is_cached
from .numpy_backend import NumpyBlocks, as_floats, columns_part, is_table, rows_part
from .schedule import Schedule
from .text import numba_text

#: NaN stays NaN: a pose out of reach is told by it.
FLAGS = {"contract", "arcp", "nsz", "reassoc"}
PART, WIDE = 8192, 1 << 18
SHORT = 16
"""With fewer poses than this the designs run along the inner loop."""
COMPILE, LOAD = 2e10, 2e9
"""The operations from which compiling a loop pays, and from which loading one from disk does."""


@cache
def is_there() -> bool:
    """Return whether Numba is installed."""
    return find_spec("numba") is not None


def pays_compiled(work: float, ready: bool, is_on_disk: Callable[[], bool]) -> bool:
    """Return whether so many operations are worth a compiled loop: it is there, on disk, or worth making."""
    return ready or (work >= LOAD and is_there() and (work >= COMPILE or is_on_disk()))


def compiled_loop(text: str, name: str, arguments: Callable[[Any], Sequence[Any]]) -> Callable[..., Any]:
    """Return a function of a text compiled for arguments, which are given as types of Numba; kept on disk."""
    try:
        from numba import njit, types
    except ImportError:
        raise LinkageError('backend="numba" needs Numba: pip install "hydrolinkage[fast]".') from None

    def make(function: Callable[..., None], file: CompiledFile | None) -> Callable[..., None]:
        def lazy(cache: bool) -> Any:
            return njit(fastmath=FLAGS, error_model="numpy", nogil=True, cache=cache)(function)

        done = lazy(file is not None)
        if file is not None and not file.take(Path(done.stats.cache_path)):
            done, file = lazy(False), None
        done.compile(tuple(arguments(types)))
        done.disable_compile()
        if file is not None:
            file.note()
        loop: Callable[..., None] = done
        return loop

    return compiled_in_file(text, name, make)


class NumbaLoop:
    """A program as a compiled loop; the design part is left to NumPy."""

    def __init__(self, plan: Schedule, arrays: NumpyBlocks) -> None:
        self.plan, self.arrays = plan, arrays
        self._last: tuple[tuple[float, ...], FloatArray] = (), np.empty((0, 1))
        self._ready: dict[bool, Callable[..., None]] = {}

    @cached_property
    def _texts(self) -> dict[bool, str]:
        return {turned: numba_text(self.plan, turned) for turned in (False, True)}

    @cached_property
    def _on_disk(self) -> dict[bool, bool]:
        """Whether each text was compiled before: looked up once, as a look takes as long as a thousand poses."""
        return {turned: is_cached(text) for turned, text in self._texts.items()}

    def is_worth(self, m: int, n: int, spent: int) -> bool:
        """Return whether so many designs and poses, and those before them, pay for compiling."""
        turned = self.turns(m, n)
        return pays_compiled(float(spent + m * n) * max(len(self.plan.pose), 1), turned in self._ready, lambda: self._on_disk[turned])

    def turns(self, m: int, n: int) -> bool:
        """Return whether designs, not poses, are best contiguous in the result."""
        return n < SHORT < m

    def run(self, design: Sequence[Numbers], poses: Sequence[Numbers], values: FloatArray, guards: FloatArray) -> None:
        """Fill values, shape (outputs, designs, poses); a guard that is not above zero at some pose becomes -1."""
        m, n = values.shape[1:]
        turned = self.turns(m, n) and not any(map(is_table, poses))
        loop = self._ready.get(turned) or self._loop(turned)
        target = values.transpose(0, 2, 1) if turned else values
        for left in range(0, m, PART):
            part = slice(left, min(left + PART, m))
            constants = self._constants(design, part)
            if turned:
                constants = np.array(np.broadcast_to(constants, (len(constants), part.stop - left)))
            for first in range(0, n, WIDE):
                here = slice(first, min(first + WIDE, n))
                seen = poses if m <= PART and n <= WIDE else [columns_part(rows_part(value, part), here) for value in poses]
                rows, count = max([len(value) for value in seen if is_table(value)], default=1), here.stop - first
                if len(seen) == 1 and np.size(seen[0]) == rows * count:
                    inputs = np.ascontiguousarray(seen[0], float).reshape(1, rows, count)
                else:
                    inputs = stacked(seen, rows, count)
                if turned:
                    inputs = np.array(inputs.transpose(0, 2, 1))
                block = target[:, here, part] if turned else target[:, part, here]
                inside = block if block.strides[2] == block.itemsize else np.empty(block.shape)
                layer, line, _ = inside.strides
                loop(constants, inputs, memory(inside), guards, layer // inside.itemsize, line // inside.itemsize, *inside.shape[1:])
                if inside is not block:
                    block[...] = inside

    def _loop(self, turned: bool) -> Callable[..., None]:
        """Return the compiled loop of an order, kept."""

        def arguments(types: Any) -> Sequence[Any]:  # what a motion holds cannot be written
            read = [types.Array(types.float64, axes, "C", readonly=True) for axes in (2, 3)]
            return *read, *[types.float64[::1]] * 2, *[types.int64] * 4

        self._ready[turned] = loop = compiled_loop(self._texts[turned], "poses", arguments)
        return loop

    def _constants(self, design: Sequence[Numbers], part: slice) -> FloatArray:
        """Return the design part as one array, shape (count, designs or 1); that of the last single design is kept."""
        key = as_floats(design)
        if key is None:
            return constant_table(self.arrays.passed([columns_part(value, part) for value in design]), part)
        last, found = self._last
        if last != key or not found.size:
            found = constant_table(self.arrays.passed(key), part)
            self._last = key, found
        return found


def memory(block: FloatArray) -> FloatArray:
    """Return the memory that a block lies in, from its first element to its last; rows of the block are contiguous."""
    if block.flags.c_contiguous:
        return block.reshape(-1)
    last = sum((size - 1) * stride for size, stride in zip(block.shape, block.strides, strict=True))
    return np.lib.stride_tricks.as_strided(block, (last // block.itemsize + 1,), (block.itemsize,))


def constant_table(passed: Sequence[Numbers], part: slice) -> FloatArray:
    """Return the design part as one array, shape (count, designs or 1)."""
    return stacked(passed, 1 if all(np.ndim(value) == 0 for value in passed) else part.stop - part.start)


def stacked(values: Sequence[Numbers], *shape: int) -> FloatArray:
    """Return values as the layers of one array, each of a shape."""
    found = np.empty((len(values), *shape))
    for layer, value in zip(found, values, strict=True):
        layer[...] = value
    return found
