"""A program made ready to run: floats for a handful of poses, NumPy blocks for more."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from .arrays import LARGEST, Arrays, FloatArray, is_table
from .floats import Floats
from .node import Node
from .schedule import schedule

FEW = 20
BLOCK = LARGEST


@dataclass(frozen=True)
class Result:
    """What a kernel returns: values, shape (outputs, designs, poses), and the least value of each guard."""

    values: FloatArray
    guards: FloatArray


class Kernel:
    """Some nodes of a program as a function of designs and poses.

    `kernel(inputs)` takes a float or an array (designs,) for every dimension and a float or an array (poses,)
    or (designs, poses) for every stroke and solved coordinate, and returns values of shape (outputs, designs, poses);
    NaN where a pose cannot be assembled.
    A guard is a node whose least value over all poses is wanted: NaN tells that some pose is unreachable.
    """

    def __init__(self, outputs: Sequence[Node], guards: Sequence[Node] = ()) -> None:
        self.plan = schedule(outputs, guards)

    def __call__(self, inputs: Mapping[str, Any], out: FloatArray | None = None) -> Result:
        design = [inputs[node.value] for node in self.plan.design_inputs]
        poses = [inputs[node.value] for node in self.plan.pose_inputs]
        m = max((np.shape(value)[0] for value in (*design, *filter(is_table, poses)) if np.ndim(value)), default=1)
        n = max((np.shape(value)[-1] for value in poses if np.ndim(value)), default=1)
        guards = np.full(len(self.plan.guards), math.inf)
        values = self._allocate(m, n) if out is None else out
        if m * n:
            backend = self.floats if m == 1 and n <= FEW else self.arrays
            with np.errstate(all="ignore"):
                backend.run(design, poses, values, guards)
        return Result(values, guards)

    def _allocate(self, m: int, n: int) -> FloatArray:
        """Return the result array; the longer of designs and poses is contiguous."""
        if m > n:
            return np.empty((len(self.plan.outputs), n, m)).transpose(0, 2, 1)
        return np.empty((len(self.plan.outputs), m, n))

    @cached_property
    def floats(self) -> Floats:
        """The program in plain floats."""
        return Floats(self.plan)

    @cached_property
    def arrays(self) -> Arrays:
        """The program in NumPy blocks."""
        return Arrays(self.plan)
