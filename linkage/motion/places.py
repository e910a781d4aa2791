"""Where all points are, over designs and strokes: one pass of the kernel, and what could not be reached."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping
from functools import cached_property
from typing import Any, Self

import numpy as np

from ..errors import AssemblyError
from ..plan import ArrayReading, Plan
from ..program import FloatArray
from . import reach, singular
from .grid import Grid
from .reach import Mask


class Places(Grid):
    """All positions of a mechanism over designs and strokes, and which poses are reached.

    Arrays are component-first, designs before strokes: a position has the shape (2, *designs, *strokes).
    """

    def __init__(self, plan: Plan, designs: Mapping[str, Any], strokes: Mapping[str, FloatArray], unreachable: str = "raise") -> None:
        super().__init__(plan, designs, strokes, unreachable)
        self.reached: Mask = np.ones(self.shape, bool)
        result = plan.kernel(plan.moving, guarded=True)(self.flat)
        self._places = self.full(result.values)
        self.is_near_singular = not np.all(result.guards > 0.0)
        if self.is_near_singular or plan.may_overflow:
            self._settle_unreached()
        self._places.flags.writeable = False
        self.reached.flags.writeable = False

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

    # -- looked at again ---------------------------------------------------------------------------------

    @property
    def group_stops(self) -> tuple[float, ...]:
        """The strokes at which a group's pins could not be followed farther from the sketch."""
        return self.solved.stops

    @property
    def crossed(self) -> Mask:
        """The poses that a group's pins reach only through a change point."""
        return np.asarray(np.broadcast_to(self.full(self.solved.crossed[None].astype(float))[0] > 0.0, self.shape))

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
        arrays = np.broadcast_arrays(*(np.array(strokes[name], float) for name in self.strokes))
        return type(self)(self.plan, self.designs, dict(zip(self.strokes, arrays, strict=True)), "nan")
