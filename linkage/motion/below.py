"""Where on the way of a motion something is below zero, looked for between its poses, whatever their number."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ..errors import DefinitionError
from ..program import FloatArray
from .between import Between, Function, require_function
from .motion import Motion
from .peaks import CLOSE, Index, Mask, bisected, level, peaks, zoomed
from .reach import place_read, stroke_unit


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
            others = ", ".join(f"{each} = {place_read(value, self.units[each])}" for each, value in self.start.items() if each != name)
            return f"from {name} = {place_read((self.start[name], self.end[name]), self.units[name])}{f' ({others})' if others else ''}"
        start, end = (
            ", ".join(f"{name} = {place_read(value, self.units[name])}" for name, value in at.items()) for at in (self.start, self.end)
        )
        return f"from {start} to {end}" if moving else f"at {start}"


def below_zero(motion: Motion, f: Function) -> tuple[Span, ...]:
    """Return the parts of a motion's way on which f, a number for each pose, is below zero; of one design along strokes or a path.

    The ends are right to 1e-12 of the way: roots, jumps, the last poses with a value. A part of 1/2000 of the range is found, and one that
    dips below zero between two of 4097 samples like an extreme is, see `peaks`.
    """
    require_function(motion, f)
    if motion.design_shape or len(motion.stroke_shape) > 1:
        raise DefinitionError(f"{motion.plan.title}: ranges are told for one design along one stroke or one path; this is {motion.shape}.")
    between = Between(motion, f)
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


def with_dips(between: Between) -> tuple[Index, FloatArray, FloatArray]:
    """Return leg, t and value of the samples, and of places between them where the value is on the other side of zero."""
    leg, t, value = between.leg, between.t, between.seen.ravel()
    found = [each for sense in (1.0, -1.0) for each in dips(between, sense, np.asarray(sense * value >= 0.0))]
    leg, t, value = (np.concatenate([known, *(each[row] for each in found)]) for row, known in enumerate((leg, t, value)))
    order = np.lexsort((t, leg))
    return leg[order], t[order], value[order]


@np.errstate(all="ignore")
def dips(between: Between, sense: float, among: Mask) -> list[tuple[Index, FloatArray, FloatArray]]:
    """Return leg, t and value of places between the samples where sense * f is below zero though it is not at the samples about them."""

    def look(leg: Index, t: FloatArray) -> tuple[FloatArray, Mask]:
        seen, reached = between.look(leg, t)
        return -sense * seen, reached

    values = -sense * between.seen.reshape(1, 1, -1)
    tops = peaks(level(values), between.leg, between.t, between.route.counts, among)
    found = []
    while tops.value.size:
        crossed = tops.value > 0.0
        found.append((tops.leg[crossed], tops.t[crossed], -sense * tops.value[crossed]))
        going = ~crossed & (tops.bound > 0.0) & (tops.half > CLOSE)
        tops = tops.where(going)
        tops = zoomed(look, tops) if tops.value.size else tops
    return found


def ends(between: Between, leg: Index, t: FloatArray, inside: Index, by: int) -> FloatArray:
    """Return how far (c,) the parts go from places that are below zero towards the next ones, which are not."""

    def look(leg: Index, t: FloatArray) -> tuple[FloatArray, Mask]:
        seen, reached = between.look(leg, t)
        return np.where(seen < 0.0, seen, np.nan), reached

    outside = np.clip(inside + by, 0, len(leg) - 1)
    outside = np.where(leg[outside] == leg[inside], outside, inside)
    return bisected(look, leg[inside][None, None], t[inside][None, None], t[outside][None, None])[0, 0] if inside.size else t[inside]
