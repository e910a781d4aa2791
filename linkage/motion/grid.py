"""Designs and strokes as a grid of poses, and the inputs of the program on it."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from math import prod
from typing import Any

import numpy as np

from ..assembly import Solved, solve_groups
from ..errors import DefinitionError
from ..frozen import FrozenDict, read_only
from ..plan import ArrayReading, Plan
from ..program import FloatArray, Kernel
from .reach import Mask
from .unwrap import unwrapped


class Grid:
    """Designs times strokes: shapes and inputs. Arrays are component-first, designs before strokes."""

    def __init__(self, plan: Plan, designs: Mapping[str, Any], strokes: Mapping[str, FloatArray], unreachable: str = "raise") -> None:
        if unreachable not in ("raise", "nan"):
            raise DefinitionError(f'unreachable={unreachable!r}: say "raise" or "nan".')
        self.plan, self.unreachable = plan, unreachable
        self.designs: FrozenDict[str, Any] = FrozenDict(designs)
        self.strokes: FrozenDict[str, FloatArray] = FrozenDict({name: read_only(value) for name, value in strokes.items()})
        arrays = [np.shape(value) for value in self.designs.values() if varies(value)]
        try:
            self.design_shape = np.broadcast_shapes(*arrays)
        except ValueError:
            shapes = ", ".join(map(str, arrays))
            raise DefinitionError(f"{plan.title}: the shapes of the design arrays do not fit each other: {shapes}.") from None
        self.stroke_shape = self._stroke_shape()
        self.shape = (*self.design_shape, *self.stroke_shape)

    def _stroke_shape(self) -> tuple[int, ...]:
        """Return the shape of the poses of each design."""
        return next((value.shape for value in self.strokes.values()), ())

    @cached_property
    def size(self) -> tuple[int, int]:
        """The number of designs and of poses of each."""
        return prod(self.design_shape), prod(self.stroke_shape)

    @cached_property
    def flat(self) -> dict[str, Any]:
        """The inputs as a kernel takes them: designs (m,), poses (n,)."""
        flat: dict[str, Any] = {}
        for name, value in self.designs.items():
            flat[name] = np.broadcast_to(value, self.design_shape).ravel() if varies(value) else float(value)
        flat |= {name: value.ravel() for name, value in self.strokes.items()}
        return flat | dict(self.solved.inputs)

    @cached_property
    def solved(self) -> Solved:
        """The pins of groups, shape (m, n)."""
        if not self.plan.groups:
            return Solved({}, np.zeros((1, 1), bool))
        shape = self.design_shape
        designs = {name: np.broadcast_to(value, shape).ravel() if varies(value) else value for name, value in self.designs.items()}
        return solve_groups(self.plan, designs, {name: value.ravel() for name, value in self.strokes.items()})

    @cached_property
    def inputs(self) -> dict[str, Any]:
        """The inputs shaped to broadcast against results: designs first, strokes last."""
        tail = (1,) * len(self.stroke_shape)
        shaped = {name: np.reshape(value, np.shape(value) + tail) if varies(value) else value for name, value in self.designs.items()}
        solved = {name: self.full(value[None])[0] for name, value in self.solved.inputs.items()}
        shaped = {name: np.float64(value) if np.ndim(value) == 0 else value for name, value in shaped.items()}
        found = {**shaped, **self.strokes, **solved}
        return FrozenDict({name: read_only(value) if isinstance(value, np.ndarray) else value for name, value in found.items()})

    def array(self, values: Any) -> FloatArray:
        """Return numbers as arrays of floats."""
        return np.asarray(values, float)

    def joined(self, angles: FloatArray, kernel: Kernel) -> FloatArray:
        """Return the angles that a kernel gives [rad], shape (angles, ...), without jumps along the stroke."""
        return np.array([unwrapped(angle, [value for value in self.strokes.values() if value.ndim]) for angle in angles])

    def full(self, values: FloatArray) -> FloatArray:
        """Return a kernel's values in the grid's shape."""
        if values.shape[1:] != self.size:
            values = np.broadcast_to(values, (len(values), *self.size))
        return values.reshape(len(values), *self.shape)

    def read_at(self, mask: Mask) -> ArrayReading:
        """Return the eager reading of some poses."""
        with np.errstate(all="ignore"):
            return self.plan.read({name: np.broadcast_to(value, self.shape)[mask] for name, value in self.inputs.items()})


def varies(value: Any) -> bool:
    """Return whether a dimension differs from design to design."""
    return type(value) is not float and np.ndim(value) > 0
