"""A handful of poses, in plain Python floats: a NumPy call on a few numbers costs more than a pose."""

from __future__ import annotations

import math
from array import array
from collections.abc import Callable, Mapping, Sequence
from functools import cached_property
from typing import final

import numpy as np

from ..frozen import FrozenDict
from ..vectors import FloatArray, Numbers
from .cache import compiled
from .operations import FLOATS, NO_VALUE, QUICK
from .schedule import Schedule
from .text import GUARDED, PYTHON, Dialect, function_text


@final
class PlainFloats:
    """A program as two functions of floats: the design part and the pose part."""

    def __init__(self, plan: Schedule) -> None:
        self.plan = plan
        self._latest: tuple[bytes, tuple[float, ...]] = b"none", ()
        self._latest_of: tuple[Mapping[str, float], tuple[float, ...]] = {}, ()
        self._strokes = tuple(node.value for node in plan.pose_inputs)

    @cached_property
    def quick(self) -> Mapping[str, Callable[..., tuple[float, ...]]]:
        """The functions that raise where a division or a root has no value."""
        return compiled(self._text(PYTHON), QUICK)

    @cached_property
    def careful(self) -> Mapping[str, Callable[..., tuple[float, ...]]]:
        """The functions that return NaN and infinity there, as NumPy does."""
        return compiled(self._text(GUARDED), FLOATS)

    def _text(self, dialect: Dialect) -> str:
        plan = self.plan
        text = function_text("design", plan.design_inputs, plan.design, plan.passed, dialect)
        return text + function_text("pose", [*plan.passed, *plan.pose_inputs], plan.pose, (*plan.outputs, *plan.guards), dialect)

    def design(self, values: Sequence[float]) -> tuple[float, ...]:
        """Return what the pose part needs of a design; that of the latest is kept."""
        key, (known, passed) = array("d", values).tobytes(), self._latest  # bytes tell 0.0 from -0.0
        if key == known:
            return passed
        try:
            passed = self.quick["design"](*values)
        except NO_VALUE:
            passed = self.careful["design"](*values)
        self._latest = key, passed
        return passed

    def pose(self, design: FrozenDict[str, float], strokes: Mapping[str, FloatArray]) -> tuple[float, ...]:
        """Return outputs and guards of one design, floats by name, at one pose, arrays of one number by name.

        What the pose part needs of the latest design is kept by the dictionary itself, which does not change.
        """
        known, passed = self._latest_of
        if known is not design:
            passed = self.design([design[node.value] for node in self.plan.design_inputs])
            self._latest_of = design, passed
        row = [strokes[name].item() for name in self._strokes]
        try:
            return self.quick["pose"](*passed, *row)
        except NO_VALUE:
            return self.careful["pose"](*passed, *row)

    def poses(self, passed: Sequence[float], columns: Sequence[Sequence[float]], n: int) -> list[tuple[float, ...]]:
        """Return outputs and guards pose by pose."""
        quick = self.quick["pose"]
        found = []
        for row in zip(*columns, strict=True) if columns else [()] * n:
            try:
                found.append(quick(*passed, *row))
            except NO_VALUE:
                found.append(self.careful["pose"](*passed, *row))
        return found

    def turns(self, m: int, n: int) -> bool:
        """Return whether designs, not poses, are best contiguous in the result."""
        return False

    def run(self, design: Sequence[Numbers], poses: Sequence[Numbers], values: FloatArray, guards: FloatArray) -> None:
        """Fill values, shape (outputs, designs, poses), and the least value of each guard."""
        count, m, n = values.shape
        if m == n == 1:
            (row,) = self.poses(self.design(list(map(one_float, design))), [(one_float(value),) for value in poses], 1)
            values[:, 0, 0] = row[:count]
            guards[:] = row[count:]  # of one pose each is its own least
            return
        designs = [float_list(value, m) for value in design]
        for place in range(m):
            here = [value[place % len(value)] if isinstance(value, np.ndarray) and value.ndim == 2 else value for value in poses]
            rows = self.poses(self.design([each[place] for each in designs]), [float_list(value, n) for value in here], n)
            values[:, place] = np.array([row[:count] for row in rows], float).T.reshape(count, n)
            for k in range(len(guards)):
                seen = [guards[k], *(row[count + k] for row in rows)]
                guards[k] = math.nan if any(map(math.isnan, seen)) else min(seen)  # no comparison sees NaN


def one_float(value: Numbers) -> float:
    """Return a number, or an array of one, as a float."""
    return value if type(value) is float else value.item() if isinstance(value, np.ndarray) else float(value)


def float_list(value: Numbers, count: int) -> list[float]:
    """Return a number or an array as so many floats."""
    if type(value) is float:
        return [value] * count
    floats: list[float] = np.asarray(value, float).ravel().tolist()
    return floats * count if len(floats) == 1 else floats
