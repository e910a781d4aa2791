"""The greatest and the lowest value over a motion, looked for between its poses, whatever their number.

What is looked at is the range that the poses cover: of a single stroke from its least to its greatest value; of several strokes in arrays
of one axis the path through the poses in their order; of a grid the box from the least to the greatest value of each. See `peaks` for
how and how closely it is looked at, and `boxes` for grids.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..errors import DefinitionError
from .between import Between, Function, require_function
from .boxes import Box, highest_in, moving
from .motion import Motion
from .peaks import highest
from .reach import place_read, stroke_unit


@dataclass(frozen=True, eq=False)
class Extremum:
    """The greatest or the lowest value of a quantity, and where: floats, or arrays over what was asked for and the designs.

    `value` is NaN where there is none at any pose, and infinite where it is `unbounded`: where it grows beyond bounds up to a pose at
    which it is refused. `strokes` say where [m or rad, which `units` say].
    """

    value: Any
    strokes: Mapping[str, Any]
    unbounded: Any
    units: Mapping[str, str]

    @property
    def where(self) -> str:
        """Where it stands, in words: `at S = 0.1234 m`, `at S1 = 0.1000 m, phi = 25.00 deg`; of several, the ranges."""
        return "at " + ", ".join(f"{name} = {place_read(value, self.units[name])}" for name, value in self.strokes.items())

    def __str__(self) -> str:
        if np.ndim(self.value):
            return f"{np.nanmin(self.value):.6g} to {np.nanmax(self.value):.6g} {self.where}"
        if np.isnan(self.value):
            return "no value at any pose"
        return f"{'without bounds' if self.unbounded else f'{self.value:.6g}'} {self.where}"


def greatest(motion: Motion, f: Function) -> Extremum:
    """Return the greatest value of f over all that a motion covers, and where: one a design, and of each of several quantities.

    `f(motion)` is asked again, of motions with the same designs at strokes in between: shape (...) as the motion's, or (k, ...) for k
    quantities at once, NaN where it has no value. It may have kinks, jumps and gaps. The value is right to 1e-6 of its range, the place
    to 1e-4 of the stroke, for every bump from 1/2000 of the range wide, and the same from however many poses. Where it jumps the larger
    side counts; where it grows beyond bounds up to a pose that is refused or out of reach it is infinite, and told as `unbounded`.
    Poses out of reach are passed over, whatever the motion was asked for with.
    """
    return extremum(motion, f, 1.0)


def lowest(motion: Motion, f: Function) -> Extremum:
    """Return the lowest value of f over all that a motion covers, and where; as `greatest`."""
    return extremum(motion, f, -1.0)


def extremum(motion: Motion, f: Function, sense: float) -> Extremum:
    """Return the greatest (sense 1.0) or the lowest (-1.0) value of f over all that a motion covers."""
    require_function(motion, f)
    if not motion.strokes:
        raise DefinitionError(f"{motion.plan.title} has no stroke, so there is nothing between its poses.")
    units = {name: stroke_unit(motion.plan, name) for name in motion.strokes}
    if len(motion.stroke_shape) > 1 and len(moving(motion)) > 1:
        box = Box(motion, f, sense)
        top, shape = highest_in(box), (*box.front, *motion.design_shape)
        strokes = {name: given(value, shape) for name, value in box.strokes(top.unit).items()}
        return Extremum(given(sense * top.value, shape), strokes, given(top.unbounded, shape), units)
    between = Between(motion, f, sense)
    found, shape = highest(between.look, between.route.counts), (*between.front, *motion.design_shape)
    strokes = {name: given(value, shape) for name, value in between.route.strokes(found.leg, found.t).items()}
    return Extremum(given(sense * found.value, shape), strokes, given(found.unbounded, shape), units)


def given(values: Any, shape: tuple[int, ...]) -> Any:
    """Return values (K, D) in the shape asked for; a single one as a plain number."""
    return values.reshape(shape) if shape else values.item()
