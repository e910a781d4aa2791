"""The greatest and the lowest value over a motion, looked for between its poses, whatever their number.

What is looked at is the range that the poses cover: of a single stroke from its least to its greatest value; of several strokes in arrays
of one axis the path through the poses in their order; of a grid the box from the least to the greatest value of each. See `peaks` for
how and how closely it is looked at along a way, and `box` for boxes of several strokes.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, final

import numpy as np

from ..errors import DefinitionError
from ..language import said
from ..plan import Mask
from ..program import FloatArray
from .between import Function, OnLegs, require_function
from .box import InBox, highest_in, moving
from .limits import place_text, stroke_unit
from .motion import Motion
from .peaks import CLOSE, Index, bisected, highest, missing_lowest, peaks, zoomed


@final
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
        return said("at {place}", place=places_text(self.strokes, self.units))

    def __str__(self) -> str:
        if np.ndim(self.value):
            ends = said("{low} to {high}", low=f"{np.nanmin(self.value):.6g}", high=f"{np.nanmax(self.value):.6g}")
            return f"{ends} {self.where}"
        if np.isnan(self.value):
            return said("no value at any pose")
        return f"{said('without bounds') if self.unbounded else f'{self.value:.6g}'} {self.where}"


def places_text(strokes: Mapping[str, Any], units: Mapping[str, str]) -> str:
    """Return values of strokes as a place is read: `S1 = 0.1000 m, phi = 25.00 deg`; of several, the ranges."""
    return ", ".join(f"{name} = {place_text(value, units[name])}" for name, value in strokes.items())


def greatest(motion: Motion, f: Function) -> Extremum:
    """Return the greatest value of f over all that a motion covers, and where: one a design, and of each of several quantities.

    `f(motion)` is asked again, of motions with the same designs at strokes in between: shape (...) as the motion's, or (k, ...) for k
    quantities at once, NaN where it has no value. It may have kinks, jumps and gaps. The value is right to 1e-6 of its range, the place
    to 1e-4 of the stroke, for every bump from 1/2000 of the range wide, and the same from however many poses. Where it jumps the larger
    side counts; where it grows beyond bounds up to a pose that is refused or out of reach it is infinite, and told as `unbounded`.
    Poses out of reach are passed over, whatever the motion was asked for with.

    Over a box of several strokes the highest part is found if what is higher than all else holds a box of 1/128 of each of two strokes,
    1/32 of three, 1/12 of four, 1/7 of five, 1/5 of six; the value is right to 1e-9 of its range where f is smooth, to 1e-6 on borders
    of what is reached, to 1e-3 on kinks.
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
    return searched(motion, f, sense)


def searched(motion: Motion, f: Function, sense: float, *, everywhere: bool = False) -> Extremum:
    """Return the same of poses that are reached only, or `everywhere`."""
    units = {name: stroke_unit(motion.plan, name) for name in motion.strokes}
    if len(motion._stroke_shape) > 1 and len(moving(motion)) > 1:
        box = InBox(motion, f, sense, everywhere=everywhere)
        top, shape = highest_in(box), (*box.front, *motion._design_shape)
        strokes = {name: in_shape(value, shape) for name, value in box.strokes(top.unit).items()}
        return Extremum(in_shape(sense * top.value, shape), strokes, in_shape(top.unbounded, shape), units)
    between = OnLegs(motion, f, sense, everywhere=everywhere)
    found, shape = highest(between.look, between.route.counts), (*between.front, *motion._design_shape)
    strokes = {name: in_shape(value, shape) for name, value in between.route.strokes(found.leg, found.t).items()}
    return Extremum(in_shape(sense * found.value, shape), strokes, in_shape(found.unbounded, shape), units)


def in_shape(values: Any, shape: tuple[int, ...]) -> Any:
    """Return values (K, D) in the shape asked for; a single one as a plain number."""
    return values.reshape(shape) if shape else values.item()


# Where on the way of a motion something is below zero, looked for between its poses, whatever their number.


@final
@dataclass(frozen=True)
class Span:
    """A part of a motion's way, from the strokes `start` to the strokes `end` [m or rad, which `units` say], in the order of the way."""

    start: Mapping[str, float]
    end: Mapping[str, float]
    units: Mapping[str, str]

    def __str__(self) -> str:
        """Return it in words: `from S = 0.5500 to 0.5660 m`, `from S1 = 0.1000 m, S2 = 0.2000 m to S1 = 0.1500 m, S2 = 0.2000 m`."""
        moving = [name for name in self.start if self.start[name] != self.end[name]]
        if len(moving) == 1:
            (name,) = moving
            others = places_text({each: value for each, value in self.start.items() if each != name}, self.units)
            way = said("from {name} = {range}", name=name, range=place_text((self.start[name], self.end[name]), self.units[name]))
            return f"{way} ({others})" if others else way
        start, end = (places_text(at, self.units) for at in (self.start, self.end))
        return said("from {start} to {end}", start=start, end=end) if moving else said("at {place}", place=start)


def below_zero(motion: Motion, f: Function) -> tuple[Span, ...]:
    """Return the parts of a motion's way on which f, a number for each pose, is below zero; of one design along strokes or a path.

    The ends are right to 1e-12 of the way: roots, jumps, the last poses with a value. A part of 1/2000 of the range is found, and one that
    dips below zero between two of 4097 samples like an extreme is, see `peaks`.
    """
    require_function(motion, f)
    if motion._design_shape or len(motion._stroke_shape) > 1:
        raise DefinitionError(f"{motion.plan.title}: ranges are told for one design along one stroke or one path; this is {motion.shape}.")
    between = OnLegs(motion, f)
    if between.front:
        raise DefinitionError(f"{motion.plan.title}: ranges are told for one number a pose; there are {between.front}.")
    leg, t, value = with_dips(between)
    below = np.concatenate([[False], value < 0.0, [False]])
    firsts, lasts = np.flatnonzero(below[1:] & ~below[:-1]), np.flatnonzero(below[:-1] & ~below[1:]) - 1
    low, high = (ends(between, leg, t, inside, by) for inside, by in ((firsts, -1), (lasts, 1)))
    units = {name: stroke_unit(motion.plan, name) for name in motion.strokes}
    strokes = [between.route.strokes(leg[inside], at) for inside, at in ((firsts, low), (lasts, high))]
    starts, stops = ([{name: float(value[row]) for name, value in at.items()} for row in range(len(firsts))] for at in strokes)
    return tuple(Span(start, end, units) for start, end in zip(starts, stops, strict=True))


def reached(motion: Motion) -> tuple[Span, ...]:
    """Return the parts of a motion's way that are reached, one design along strokes or a path."""
    return below_zero(motion, lambda each: -np.ones(each.shape))


def with_dips(between: OnLegs) -> tuple[Index, FloatArray, FloatArray]:
    """Return leg, t and value of the samples, and of places between them where the value is on the other side of zero."""
    leg, t, value = between.leg, between.t, between.seen.ravel()
    found = [each for sense in (1.0, -1.0) for each in dips(between, sense, np.asarray(sense * value >= 0.0))]
    leg, t, value = (np.concatenate([known, *(each[row] for each in found)]) for row, known in enumerate((leg, t, value)))
    order = np.lexsort((t, leg))
    return leg[order], t[order], value[order]


@np.errstate(all="ignore")
def dips(between: OnLegs, sense: float, among: Mask) -> list[tuple[Index, FloatArray, FloatArray]]:
    """Return leg, t and value of places between the samples where sense * f is below zero though it is not at the samples about them."""

    def look(leg: Index, t: FloatArray) -> tuple[FloatArray, Mask]:
        seen, reached = between.look(leg, t)
        return -sense * seen, reached

    values = -sense * between.seen.reshape(1, 1, -1)
    tops = peaks(missing_lowest(values), between.leg, between.t, between.route.counts, among)
    found = []
    while tops.value.size:
        crossed = tops.value > 0.0
        found.append((tops.leg[crossed], tops.t[crossed], -sense * tops.value[crossed]))
        going = ~crossed & (tops.bound > 0.0) & (tops.half > CLOSE)
        tops = tops.where(going)
        tops = zoomed(look, tops) if tops.value.size else tops
    return found


def ends(between: OnLegs, leg: Index, t: FloatArray, inside: Index, by: int) -> FloatArray:
    """Return how far (c,) the parts go from places that are below zero towards the next ones, which are not."""

    def look(leg: Index, t: FloatArray) -> tuple[FloatArray, Mask]:
        seen, reached = between.look(leg, t)
        return np.where(seen < 0.0, seen, np.nan), reached

    outside = np.clip(inside + by, 0, len(leg) - 1)
    outside = np.where(leg[outside] == leg[inside], outside, inside)
    return bisected(look, leg[inside][None, None], t[inside][None, None], t[outside][None, None])[0, 0] if inside.size else t[inside]
