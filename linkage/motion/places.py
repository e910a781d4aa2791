"""Where all points are, over designs and strokes: one pass of the kernel, and what could not be reached."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping
from functools import cached_property
from typing import Any, Self

import numpy as np

from ..assembly import Solved, solve_groups
from ..errors import AssemblyError, DefinitionError
from ..plan import ArrayReading, Plan
from ..program import FloatArray
from . import reach, singular
from .reach import Mask


class Places:
    """All positions of a mechanism over designs and strokes, and which poses are reached.

    Arrays are component-first, designs before strokes: a position has the shape (2, *designs, *strokes).
    """

    def __init__(self, plan: Plan, designs: Mapping[str, Any], strokes: Mapping[str, FloatArray], unreachable: str = "raise") -> None:
        if unreachable not in ("raise", "nan"):
            raise DefinitionError(f'unreachable={unreachable!r}: say "raise" or "nan".')
        self.plan, self.designs, self.strokes, self.unreachable = plan, dict(designs), dict(strokes), unreachable
        arrays = [np.shape(value) for value in self.designs.values() if np.ndim(value)]
        try:
            self.design_shape = np.broadcast_shapes(*arrays)
        except ValueError:
            shapes = ", ".join(map(str, arrays))
            raise DefinitionError(f"{plan.title}: the shapes of the design arrays do not fit each other: {shapes}.") from None
        self.stroke_shape = next((value.shape for value in self.strokes.values()), ())
        self.shape = (*self.design_shape, *self.stroke_shape)
        self.reached: Mask = np.ones(self.shape, bool)
        result = plan.kernel(plan.moving, guarded=True)(self._flat)
        self._places = self._full(result.values)
        self.is_near_singular = not np.all(result.guards > 0.0)
        if self.is_near_singular or plan.may_overflow:
            self._settle_unreached()
        self._places.flags.writeable = False

    # -- inputs ----------------------------------------------------------------------------------------

    @cached_property
    def _flat(self) -> dict[str, Any]:
        """The inputs as a kernel takes them: designs (m,), poses (n,)."""
        flat: dict[str, Any] = {}
        for name, value in self.designs.items():
            flat[name] = np.broadcast_to(value, self.design_shape).ravel() if np.ndim(value) else float(value)
        flat |= {name: value.ravel() for name, value in self.strokes.items()}
        return flat | dict(self._solved.inputs)

    @cached_property
    def _solved(self) -> Solved:
        """The pins of groups, shape (m, n)."""
        if not self.plan.groups:
            return Solved({}, np.zeros((1, 1), bool))
        shape = self.design_shape
        designs = {name: np.broadcast_to(value, shape).ravel() if np.ndim(value) else value for name, value in self.designs.items()}
        return solve_groups(self.plan, designs, {name: value.ravel() for name, value in self.strokes.items()})

    @cached_property
    def inputs(self) -> dict[str, Any]:
        """The inputs shaped to broadcast against results: designs first, strokes last."""
        tail = (1,) * len(self.stroke_shape)
        shaped = {name: np.reshape(value, np.shape(value) + tail) if np.ndim(value) else value for name, value in self.designs.items()}
        solved = {name: self._full(value[None])[0] for name, value in self._solved.inputs.items()}
        shaped = {name: np.float64(value) if np.ndim(value) == 0 else value for name, value in shaped.items()}
        return shaped | dict(self.strokes) | solved

    def _full(self, values: FloatArray) -> FloatArray:
        """Return a kernel's values in the motion's shape."""
        m, n = int(np.prod(self.design_shape, dtype=int)), int(np.prod(self.stroke_shape, dtype=int))
        if values.shape[1:] != (m, n):
            values = np.broadcast_to(values, (len(values), m, n))
        return values.reshape(len(values), *self.shape)

    @abstractmethod
    def refusal(self) -> AssemblyError:
        """Return the error for the poses that are not reached."""

    # -- reach -----------------------------------------------------------------------------------------

    def _settle_unreached(self) -> None:
        """Place the poses at a dead point, to rounding; refuse or mask those out of reach."""
        failed: Mask = np.asarray(~np.isfinite(self._places).all(axis=0)) if len(self._places) else np.ones(self.shape, bool)
        with np.errstate(all="ignore"):
            failed |= reach.negative(self.plan, ArrayReading(self.plan.members, self.plan.table.lengths, self.inputs), self.shape)
        if not failed.any():
            return
        reading = self.read_at(failed)
        lost = np.zeros(int(failed.sum()), bool)
        for _, mask in reach.failures(self.plan, reading, lost.shape):
            lost |= mask
        self._places = np.array(self._places)
        for index, name in enumerate(self.plan.moving):
            place = reading.at(name)
            for axis, part in enumerate((place.x, place.y)):
                self._places[2 * index + axis, ...][failed] = np.where(lost, np.nan, part)
        self.reached[failed] = ~lost
        if self.unreachable == "raise" and lost.any():
            raise self.refusal()

    def read_at(self, mask: Mask) -> ArrayReading:
        """Return the eager reading of some poses."""
        with np.errstate(all="ignore"):
            return self.plan.read({name: np.broadcast_to(value, self.shape)[mask] for name, value in self.inputs.items()})

    # -- looked at again ---------------------------------------------------------------------------------

    @property
    def group_stops(self) -> tuple[float, ...]:
        """The strokes at which a group's pins could not be followed farther from the sketch."""
        return self._solved.stops

    @property
    def crossed(self) -> Mask:
        """The poses that a group's pins reach only through a change point."""
        return np.asarray(np.broadcast_to(self._full(self._solved.crossed[None].astype(float))[0] > 0.0, self.shape))

    @cached_property
    def reading(self) -> ArrayReading:
        """The eager reading of all poses."""
        with np.errstate(all="ignore"):
            return self.plan.read(self.inputs)

    @cached_property
    def loop_sines(self) -> dict[str, Any]:
        """The sine of the angle between the two links of every moving loop; zero at a dead point."""
        return singular.loops(self.plan, self.reading)

    def moved(self, strokes: Mapping[str, Any]) -> Self:
        """Return the same design at other strokes [SI], unreachable poses as NaN."""
        arrays = np.broadcast_arrays(*(np.asarray(strokes[name], float) for name in self.strokes))
        return type(self)(self.plan, self.designs, dict(zip(self.strokes, arrays, strict=True)), "nan")
