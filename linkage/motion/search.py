"""The greatest and the lowest value over a motion, looked for between its poses, whatever their number.

The search covers the range of the poses. Of a single stroke that is from its least to its greatest value. Of several strokes in arrays of
one axis it is the path through the poses in their order. Of a grid it is the box from the least to the greatest value of each. See
`numeric.line` for how and how closely it is looked at along a way, and `numeric.box` for boxes of several strokes.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from itertools import pairwise, product
from typing import Any, Protocol, TypeAlias, runtime_checkable

import numpy as np
import numpy.typing as npt

from ..errors import AssemblyError, DefinitionError, can_be_called, cited, ensure, errors_of, fits_shape, unwarned
from ..frozen import record
from ..language import said
from ..numeric.box import highest_in, values_a_stroke, weights_of
from ..numeric.line import CLOSE, SAMPLES, Index, bisected, highest, missing_lowest, peaks, samples, stretches, zoomed
from ..plan import Mask
from ..program import FloatArray
from ..units import show, shown_number
from .answer import OF_VALUE, UNBOUNDED, Answer, PerDesign
from .grid import Grid, JoinedTo, joined_in_order, recalled
from .instants import Instants
from .limits import LoopMargin, place_text, places_text, stroke_unit
from .motion import Motion, require_motion
from .requests import Request, identity_of
from .stroke_search import ON_ARRAYS, ROUNDING, Clearances, out_of_reach
from .strokes import check_any


def greatest(motion: Motion, f: Function) -> Answer:
    """Return the greatest value of f over all that a motion covers, and where: one a design, and of each of several quantities.

    The `value` is NaN where there is none at any pose, and infinite where it is `unbounded`: where it grows beyond bounds up to a pose at
    which it is refused. `strokes` say where [m or rad, which `units` say].

    `f(motion)` is asked again, of motions with the same designs at strokes in between. Its shape is (...) as the motion's, or (k, ...) for
    k quantities at once, NaN where it has no value. It may have kinks, jumps and gaps. The value is right to 1e-6 of its range, the place
    to 1e-4 of the stroke, for every bump from 1/2000 of the range wide, and the same from however many poses. Where it jumps the larger
    side counts. Where it grows beyond bounds up to a pose that is refused or out of reach it is infinite, and reported as `unbounded`.
    Poses out of reach are passed over, whatever the motion was asked for with.

    Over a box of several strokes what is higher than all else is found if it holds a box of a share of each stroke: 1/128 of two, 1/32 of
    three, 1/12 of four, 1/7 of five, 1/5 of six. The value is right to 1e-9 of its range where f is smooth, to 1e-6 on borders of what is
    reached, to 1e-3 on kinks.
    """
    return extremum_reached(motion, f, 1.0)


def lowest(motion: Motion, f: Function) -> Answer:
    """Return the lowest value of f over all that a motion covers, and where; as `greatest`."""
    return extremum_reached(motion, f, -1.0)


def extremum_reached(motion: Motion, f: Function, sense: float, *, everywhere: bool = False) -> Answer:
    """Return the greatest (sense 1.0) or the lowest (-1.0) value of f over all poses that a motion covers and reaches, or `everywhere`."""
    require_function(motion, f)
    ensure(motion.strokes, f"{motion.plan.title} has no stroke, so there is nothing between its poses.")
    if len(motion._stroke_shape) > 1 and len(strokes_moved(motion)) > 1:
        box = InBox(motion, f, sense, everywhere=everywhere)
        (value, unit, unbounded), front = highest_in(box), box.front
        strokes, time, leg = box.strokes(unit), None, None
    else:
        between = OnLegs(motion, f, sense, everywhere=everywhere)
        found, front = highest(between.look, between.counts), between.front
        value, unbounded, strokes = found.value, found.unbounded, between.strokes(found.leg, found.t)
        time, leg = between.time(found.leg, found.t), found.leg
    shape, units = (*front, *motion._design_shape), {name: stroke_unit(motion.plan, name) for name in motion.strokes}

    def shaped(values: npt.NDArray[Any]) -> PerDesign:
        return values.reshape(shape) if shape else values.item()  # (K, D); a single one as a plain number

    status = shaped(np.where(unbounded, UNBOUNDED, OF_VALUE))
    at, on = np.nan if time is None else shaped(time), -1 if leg is None else shaped(leg)
    places = {name: shaped(each) for name, each in strokes.items()}
    return Answer(f, shaped(sense * value), None, status, places, units=units, time=at, leg=on)


def strokes_moved(motion: Motion) -> tuple[str, ...]:
    """Return the strokes that a motion moves."""
    return tuple(name for name, value in motion.strokes.items() if np.ptp(value) > 0.0)


# Where on the way of a motion something is below zero, looked for between its poses, whatever their number.


@record
class Span:
    """A part of a motion's way, from the strokes `start` to the strokes `end` [m or rad, which `units` say], in the order of the way.

    Over a path in time it is from one of its `times` to the other [s].
    """

    start: Mapping[str, float]
    end: Mapping[str, float]
    units: Mapping[str, str]
    times: tuple[float, float] | None = None

    def __str__(self) -> str:
        """Return it in words: `from S = 550.0 to 566.0 mm`, `from S1 = 100.0 mm, S2 = 200.0 mm to S1 = 150.0 mm, S2 = 200.0 mm`."""
        if self.times is not None:
            low, high = (shown_number(round(each, 6), "s", 4) for each in self.times)
            at = said("at {place}", place=show(round(self.times[0], 6), "s", 4))
            return at if low == high else said("from {low} to {high} s", low=low, high=high)
        moving = [name for name in self.start if self.start[name] != self.end[name]]
        if len(moving) == 1:
            (name,) = moving
            others = places_text({each: value for each, value in self.start.items() if each != name}, self.units)
            way = said("from {name} = {range}", name=name, range=place_text((self.start[name], self.end[name]), self.units[name]))
            return f"{way} ({others})" if others else way
        start, end = (places_text(at, self.units) for at in (self.start, self.end))
        return said("from {start} to {end}", start=start, end=end) if moving else said("at {place}", place=start)


def below_zero(motion: Motion, f: Function | Request) -> tuple[Span, ...]:
    """Return the parts of a motion's way on which f is below zero, of one design along strokes or a path.

    f is a request, or a function that gives a number for each pose.

    The ends are right to 1e-12 of the way: roots, jumps, the last poses with a value. A part of 1/2000 of the range is found, and one that
    dips below zero between two of 4097 samples like an extreme is, see `peaks`.
    """
    if isinstance(f, Request):
        identity = identity_of(motion.plan, f)
        if identity is None:
            return below_zero(motion, f.of)
        return recalled(motion, ("below zero", identity), lambda: below_zero(motion, f.of))
    require_function(motion, f)
    if motion._design_shape or len(motion._stroke_shape) > 1:
        raise DefinitionError(f"{motion.plan.title}: ranges are told for one design along one stroke or one path; this is {motion.shape}.")
    between = OnLegs(motion, f)
    ensure(not between.front, f"{motion.plan.title}: ranges are told for one number a pose; there are {between.front}.")
    leg, t, value = between.leg, between.t, between.seen.ravel()
    found = [each for sense in (1.0, -1.0) for each in dips(between, sense, np.asarray(sense * value >= 0.0))]
    leg, t, value = (np.concatenate([known, *(each[row] for each in found)]) for row, known in enumerate((leg, t, value)))
    order = np.lexsort((t, leg))
    leg, t, value = leg[order], t[order], value[order]
    firsts, lasts = np.array(stretches(value < 0.0), int).reshape(-1, 2).T
    low, high = (part_ends(between, leg, t, inside, by) for inside, by in ((firsts, -1), (lasts, 1)))
    units = {name: stroke_unit(motion.plan, name) for name in motion.strokes}
    strokes = [between.strokes(leg[inside], at) for inside, at in ((firsts, low), (lasts, high))]
    starts, stops = ([{name: float(value[row]) for name, value in at.items()} for row in range(len(firsts))] for at in strokes)
    spans = tuple(Span(start, end, units) for start, end in zip(starts, stops, strict=True))
    instants = [between.instants_at(leg[inside], at) for inside, at in ((firsts, low), (lasts, high))]
    times = zip(*(each.time.tolist() for each in instants if each is not None), strict=True)
    return spans if None in instants else tuple(replace(span, times=each) for span, each in zip(spans, times, strict=True))


def reached_spans(motion: Motion) -> tuple[Span, ...]:
    """Return the parts of a motion's way that are reached, one design along strokes or a path."""
    return recalled(motion, "reached", lambda: below_zero(motion, lambda each: -np.ones(each.shape)))


@np.errstate(all="ignore")
def dips(between: OnLegs, sense: float, among: Mask) -> list[tuple[Index, FloatArray, FloatArray]]:
    """Return leg, t and value of places between the samples where sense * f is below zero though it is not at the samples about them."""

    def look(leg: Index, t: FloatArray) -> tuple[FloatArray, Mask]:
        seen, reached = between.look(leg, t)
        return -sense * seen, reached

    values = -sense * between.seen.reshape(1, 1, -1)
    tops = peaks(missing_lowest(values), between.leg, between.t, between.counts, among)
    found = []
    while tops.value.size:
        crossed = tops.value > 0.0
        found.append((tops.leg[crossed], tops.t[crossed], -sense * tops.value[crossed]))
        tops = tops.subset(~crossed & (tops.bound > 0.0) & (tops.half > CLOSE))
        tops = zoomed(look, tops) if tops.value.size else tops
    return found


def part_ends(between: OnLegs, leg: Index, t: FloatArray, inside: Index, by: int) -> FloatArray:
    """Return how far (c,) the parts go from places that are below zero towards the next ones, which are not."""

    def look(leg: Index, t: FloatArray) -> tuple[FloatArray, Mask]:
        seen, reached = between.look(leg, t)
        return np.where(seen < 0.0, seen, np.nan), reached

    outside = np.clip(inside + by, 0, len(leg) - 1)
    outside = np.where(leg[outside] == leg[inside], outside, inside)
    return bisected(look, leg[inside][None, None], t[inside][None, None], t[outside][None, None])[0, 0] if inside.size else t[inside]


# The way that the poses of a motion cover, as legs: straight lines in stroke space.

STRAIGHT = 1e-9  # of the range of each stroke: poses as near as this to a straight line stand on it
LONGEST = 16  # times the samples of one leg: of any way, however often it turns back


def corners(values: FloatArray) -> Sequence[int]:
    """Return the poses (n,) at which a way through scaled strokes (k, n) begins, ends, turns or turns back."""
    n = values.shape[1]
    if n == 1:
        return [0, 0]
    moves = np.diff(values, axis=1)
    going = np.flatnonzero(np.abs(moves).max(axis=0) > 0.0)  # poses that are given twice say nothing
    back = going[1:][(moves[:, going[1:]] * moves[:, going[:-1]]).sum(axis=0) <= 0.0]
    ends = [0, *back.tolist(), n - 1]
    found = [0]
    parts = [(first, last) for first, last in pairwise(ends) if last > first][::-1]
    while parts:
        first, last = parts.pop()
        way, steps = values[:, last] - values[:, first], values[:, first : last + 1] - values[:, [first]]
        along = np.clip(way @ steps / max(float(way @ way), 1e-300), 0.0, 1.0)
        off = np.abs(steps - way[:, None] * along).max(axis=0)
        place = first + int(np.argmax(off))
        if off.max() <= STRAIGHT or not first < place < last:
            found.append(last)
        else:
            parts += [(place, last), (first, place)]
    return found


def legs_of(strokes: Mapping[str, FloatArray]) -> tuple[dict[str, FloatArray], FloatArray]:
    """Return strokes [SI] at the corners (legs + 1,) of the way that they go, and how long each leg is, in parts of their ranges."""
    values = np.array([np.ravel(value) for value in strokes.values()])
    if len(values) == 1 or next(iter(strokes.values())).ndim > 1:
        values = np.stack([values.min(axis=1), values.max(axis=1)], axis=1)
    ranges = np.ptp(values, axis=1, keepdims=True)
    scaled = values / np.where(ranges > 0.0, ranges, 1.0)
    places = corners(scaled)
    lengths = np.abs(np.diff(scaled[:, places], axis=1)).max(axis=0)
    return {name: value[places] for name, value in zip(strokes, values, strict=True)}, lengths


Function: TypeAlias = Callable[[Motion], Any]
"""A function of a motion: a number for each pose, shape (...), or several, shape (k, ...); NaN where it has none."""


def require_function(motion: Any, f: Any) -> None:
    """Raise DefinitionError for anything but a motion and a function of one."""
    require_motion(motion)
    check_any(motion.strokes, motion.plan)
    if not can_be_called(f):  # a function may be long to show
        raise DefinitionError(f"{motion.plan.title}: {cited(f)} is no function of a motion; give one, such as lambda each: each.y('G').")


def values_of(f: Function, motion: Motion, *, everywhere: bool = False) -> FloatArray:
    """Return a function's values at every pose, shape (..., *motion.shape); NaN out of reach, unless `everywhere`.

    Nearness to a dead point is not reported.
    """
    with unwarned(), np.errstate(all="ignore"), errors_of(f"{motion.plan.title}: a function of a motion"):
        found = np.asarray(f(motion), float)
    axes = len(motion.shape)
    if found.ndim < axes or found.shape[found.ndim - axes :] != motion.shape:
        what = f"a function of a motion gives the shape {found.shape} where {motion.shape} or (k, *{motion.shape}) is expected"
        ensure(fits_shape(found, motion.shape), f"{motion.plan.title}: {what}; return a number for each pose.")
        found = np.broadcast_to(found, motion.shape)
    return found if everywhere else np.where(motion.reached, found, np.nan)


class OnLegs:
    """A function of the poses along a motion's way, of K quantities and D designs; a search calls `look`.

    The way is legs from corner to corner: the strokes [SI] at the `corners` (legs + 1,), and in how many intervals each leg is looked at,
    `counts`. A single stroke, and a grid in which a single one moves, goes from its least to its greatest value. Several strokes in arrays
    of one axis go from pose to pose, where poses on a straight line are no corners. Of a path in time legs are the stretches between the
    breaks of its courses, along which the strokes go as its `instants` say. From one sample to the next no stroke moves more than 1/4096 of
    its range, and no more than 1/4096 of the time passes.

    The samples are worked out once, at the same strokes for all designs; poses between them take their angles from these.
    """

    def __init__(self, motion: Motion, f: Function, sense: float = 1.0, *, everywhere: bool = False) -> None:
        self.motion, self.f, self.sense, self.everywhere = motion, f, sense, everywhere
        strokes, instants = motion.strokes, motion._instants
        self.instants = instants if instants is not None and instants.courses else None
        if self.instants is not None:
            breaks = self.instants.breaks
            looked = self.instants.at_share(np.arange(len(breaks) - 1)[:, None], np.linspace(0.0, 1.0, 17)[None, :])
            lasting = np.diff(breaks)
            lengths = lasting / lasting.sum()
            for name, rates in looked.rates.items():
                travel = float(np.ptp(looked.strokes[name]))
                lengths = np.maximum(lengths, np.abs(rates).max(axis=1) * lasting / (travel or np.inf))
            self.corners: Mapping[str, FloatArray] = self.instants.at_times(breaks).strokes
        else:
            self.corners, lengths = legs_of(strokes)
        share = SAMPLES * min(1.0, LONGEST / max(float(lengths.sum()), 1e-300))
        self.counts = tuple(int(count) for count in np.maximum(np.ceil(share * lengths - 1e-6), 2.0))
        self.leg, self.t = leg, t = samples(self.counts)
        self.first = Motion(
            motion.plan, motion.designs, self.strokes(leg, t), "nan", joining=joined_in_order, tangent=self.leg_tangent(leg),
            instants=self.instants_at(leg, t),
        )  # fmt: skip
        self.seen = sense * values_of(f, self.first, everywhere=everywhere)
        self.front = self.seen.shape[: self.seen.ndim - len(self.first.shape)]
        self._starts = np.cumsum([0, *(count + 1 for count in self.counts[:-1])])
        self._reached = self.first.reached.reshape(-1, leg.size)

    def instants_at(self, leg: Index, t: FloatArray) -> Instants | None:
        """Return the instants of places, each on its own side of a break; None where the way is none in time."""
        return None if self.instants is None else self.instants.at_share(leg, t)

    def time(self, leg: Index, t: FloatArray) -> FloatArray | None:
        """Return the instants of places [s], shape as these: a hair before a break where it is its end that counts; None without time."""
        if self.instants is None:
            return None
        at, last = self.instants.at_share(leg, t).time, len(self.instants.breaks) - 2
        return np.where((t == 1.0) & (leg < last), np.nextafter(at, -np.inf), at)

    def strokes(self, leg: Index, t: FloatArray) -> dict[str, FloatArray]:
        """Return the strokes [SI] at places, shape as these; exact at the corners."""
        if self.instants is not None:
            return self.instants.at_share(leg, t).strokes
        return {name: np.where(t == 1.0, at[leg + 1], at[leg] + (at[leg + 1] - at[leg]) * t) for name, at in self.corners.items()}

    def leg_tangent(self, leg: Index) -> dict[str, FloatArray] | None:
        """Return how the strokes go on in legs, shape as these; None where it is no path, and of one in time, whose rates say it."""
        has_tangent = self.motion.is_path and self.instants is None
        return {name: at[leg + 1] - at[leg] for name, at in self.corners.items()} if has_tangent else None

    @cached_property
    def _nearest(self) -> Index:
        """For every sample (D, n) the nearest that is reached; itself where none is."""
        n = self._reached.shape[-1]
        here = np.broadcast_to(np.arange(n), self._reached.shape)
        before = np.maximum.accumulate(np.where(self._reached, here, -1), axis=-1)
        after = np.minimum.accumulate(np.where(self._reached, here, 2 * n)[..., ::-1], axis=-1)[..., ::-1]
        first, last = np.where(before < 0, after, before), np.where(after >= n, before, after)
        found = np.where(here - first <= last - here, first, last)
        return np.where((found >= 0) & (found < n), found, here)

    def look(self, leg: Index, t: FloatArray) -> tuple[FloatArray, Mask]:
        """Return the values (K, D, n) at places (n,) of all designs or (D, n) of each its own, and which poses (D, n) are reached.

        Places (n,) are the samples.
        """
        motion, seen = (self.first, self.seen) if t.ndim == 1 else self._own(leg, t)
        D, n = self._reached.shape[0], t.shape[-1]
        return seen.reshape(-1, D, n), motion.reached.reshape(D, n)

    def _own(self, leg: Index, t: FloatArray) -> tuple[Motion, FloatArray]:
        """Return the poses at places (D, n), each design at its own, and the values there."""
        first, tangent = self.first, self.leg_tangent(leg)
        places = self._starts[leg] + np.rint(t * np.asarray(self.counts)[leg]).astype(int)
        near = np.take_along_axis(self._nearest, places, axis=-1)

        def shaped(values: Any) -> Any:
            return values.reshape(*first._design_shape, t.shape[-1])

        strokes, instants = {name: shaped(value) for name, value in self.strokes(leg, t).items()}, self.instants_at(leg, t)
        motion = Motion(
            first.plan, first.designs, strokes, "nan", per_design=True, joining=JoinedTo(first._grid, shaped(near)),
            tangent=tangent and {name: shaped(value) for name, value in tangent.items()}, instants=instants and instants.shaped(shaped),
        )  # fmt: skip
        return motion, self.sense * values_of(self.f, motion, everywhere=self.everywhere)


# The box of strokes that the poses of a motion cover.


@runtime_checkable
class Bounded(Protocol):
    """Functions of a motion that are asked for at some of the poses only, and each by itself."""

    def asks_for(self, motion: Motion) -> Mask:
        """Return the mask of these poses."""

    def row(self, function: int) -> Function:
        """Return one of them, by its number."""


class InBox:
    """A function of the poses in the box from the least to the greatest value of k strokes that a motion moves; others stand still."""

    def __init__(self, motion: Motion, f: Function, sense: float = 1.0, *, everywhere: bool = False) -> None:
        self.f, self.sense, self.names, self.everywhere = f, sense, strokes_moved(motion), everywhere
        self.low = {name: float(np.min(value)) for name, value in motion.strokes.items()}
        self.high = {name: float(np.max(value)) for name, value in motion.strokes.items()}
        self.k = len(self.names)
        self.side = values_a_stroke(self.k, motion._grid.size[0])
        grid = np.stack(np.meshgrid(*[np.linspace(0.0, 1.0, self.side)] * self.k, indexing="ij"), axis=-1)
        self.first = Motion(motion.plan, motion.designs, self.strokes(grid), "nan", joining=joined_in_order)
        seen = sense * values_of(f, self.first, everywhere=everywhere)
        self.front = seen.shape[: seen.ndim - len(self.first.shape)]
        self.seen = seen.reshape(-1, self.first._grid.size[0], self.side**self.k)
        self._reached = self.first.reached.reshape(-1, self.side**self.k)
        self._all_reached = bool(self._reached.all())
        self.kept = self._kept(self.first).reshape(self._reached.shape)
        self.count = self._reached.size

    def strokes(self, unit: FloatArray) -> dict[str, FloatArray]:
        """Return the strokes [SI], shape (...), at places (..., k) of the unit box; exact on its borders."""
        still = np.zeros(unit.shape[:-1])
        share = {name: unit[..., axis] for axis, name in enumerate(self.names)}
        found = {name: low + (self.high[name] - low) * share.get(name, still) for name, low in self.low.items()}
        return {name: np.where(share.get(name, still) == 1.0, self.high[name], value) for name, value in found.items()}

    def at(self, design: Index, places: FloatArray, f: Function | None = None) -> tuple[FloatArray, Mask]:
        """Return the values (K, u, n) at places (u, n, k) of a design each (u,), or those of `f`, and which poses (u, n) are reached."""
        motion, slot, shape = self._poses(design, places)
        seen = self.sense * values_of(f or self.f, motion, everywhere=self.everywhere)
        self.count += motion.reached.size
        return seen.reshape(-1, *shape)[:, design, slot], motion.reached.reshape(shape)[design, slot]

    def one_function(self, function: int, design: Index, places: FloatArray) -> FloatArray:
        """Return the values (u, n) of one function at places (u, n, k) of a design each (u,)."""
        alone, row = (self.f.row(function), 0) if isinstance(self.f, Bounded) else (None, function)
        return np.asarray(self.at(design, places, alone)[0][row])

    def is_kept(self, design: Index, places: FloatArray) -> Mask:
        """Return which places (u, n, k) of a design each (u,) are asked for and reached."""
        motion, slot, shape = self._poses(design, places)
        return self._kept(motion).reshape(shape)[design, slot]

    def _kept(self, motion: Motion) -> Mask:
        """Return which poses a function is asked for: those reached, and of a judge's those of its domain."""
        with unwarned(), np.errstate(all="ignore"):
            return motion.reached & self.f.asks_for(motion) if isinstance(self.f, Bounded) else motion.reached

    def _poses(self, design: Index, places: FloatArray) -> tuple[Motion, Index, tuple[int, ...]]:
        """Return the poses (D, c, n) at places (u, n, k) of a design each (u,), which of the c (u,) each is, and this shape."""
        D, count = len(self._reached), np.bincount(design, minlength=len(self._reached))
        slot = np.empty(len(design), int)
        slot[np.argsort(design, kind="stable")] = np.arange(len(design)) - np.repeat(np.cumsum(count) - count, count)
        unit = np.zeros((D, int(count.max(initial=1)), *places.shape[1:]))
        unit[design, slot] = places
        shape = (*self.first._design_shape, *unit.shape[1:-1])
        strokes = {name: value.reshape(shape) for name, value in self.strokes(unit).items()}
        joining = JoinedTo(self.first._grid, self._near(unit).reshape(shape))
        return Motion(self.first.plan, self.first.designs, strokes, "nan", per_design=True, joining=joining), slot, unit.shape[:-1]

    def _near(self, unit: FloatArray) -> Index:
        """Return the nearest reached of the grid points about places (D, c, n, k), by their number; the nearest where none is."""
        at = unit * (self.side - 1)
        weights = weights_of(self.k, self.side)
        if self._all_reached:
            return np.asarray(np.rint(at).astype(int) @ weights)
        low = np.clip(np.floor(at), 0, self.side - 2)
        best, near = np.full(unit.shape[:-1], np.inf), np.zeros(unit.shape[:-1], int)
        for corner in product((0.0, 1.0), repeat=self.k):
            place = ((low + corner) @ weights).astype(int)
            there = np.take_along_axis(self._reached, place.reshape(len(place), -1), axis=-1).reshape(place.shape)
            away = np.abs(at - low - corner).max(axis=-1) + np.where(there, 0.0, 10.0)
            best, near = np.minimum(best, away), np.where(away < best, place, near)
        return near


# How clear each loop stays of its dead point over all that a motion covers: below zero it cannot be assembled there.
#
# A loop's margin is a smooth function of the strokes, whether it is assembled or not. So the search for extremes finds its least value,
# and with it a part of the strokes out of reach that is far narrower than any grid.


def least_margins(motion: Motion, kept: Callable[[Motion], Mask] | None = None) -> list[LoopMargin]:
    """Return the least margin of every loop that moves, over the range, the path or the box that a motion covers.

    `kept` says which poses are asked for, all where it is None.

    A hole down to 1e-5 of the strokes is found. Groups, whose pins are looked for by iteration, have no such margin, and laws that give no
    value somewhere have none either.
    """
    known = motion.plan.made("clearances", Clearances.for_plan)
    if not (known.loops and motion.strokes):
        return []

    def asked(each: Motion) -> FloatArray:
        grid = each._grid
        margins = grid.kernel_values(known.kernel, ON_ARRAYS)
        is_signed = known.is_signed.reshape(-1, *(1,) * len(grid.shape))  # sines of guides are squared, so that all are smooth
        margins = np.where(is_signed, margins * margins, margins)
        return margins if kept is None else np.where(kept(each), margins, np.nan)

    def found() -> list[LoopMargin]:
        least, each_of = extremum_reached(motion, asked, -1.0, everywhere=True), list[LoopMargin]()
        for row, loop in enumerate(known.loops):
            place = {name: value[row] for name, value in least.strokes.items()}
            there = {name: np.reshape(value, (*motion._design_shape, 1)) for name, value in place.items()}
            grid = Grid(motion.plan, motion.designs, there, per_design=True)
            sizes = grid.kernel_values(known.rounding, ON_ARRAYS)[row, ..., 0]
            rounding = np.reshape(ROUNDING * np.fmax(np.abs(sizes), 1.0), motion._design_shape)
            hole = np.asarray(least.value[row] < -rounding)[()]
            time = np.broadcast_to(least.time, np.shape(least.value))[row]
            each_of.append(LoopMargin(loop.step, loop.kind, least.value[row], hole, place, least.units, time))
        return each_of

    return recalled(motion, "margins", found, of_places=True) if kept is None else found()


def assembly_error_at(motion: Motion, strokes: Mapping[str, float], time: float = np.nan) -> AssemblyError | None:
    """Return why a motion's one design cannot be assembled at strokes [m or rad], as that pose says it; None where it can.

    Its text names the step, what is missing there and the remedy, over a path in time the instant [s]; `point` is the step, `shortfall`
    what is missing [m].
    """
    there = motion._there({name: np.reshape(value, (1,)) for name, value in strokes.items()}, np.reshape(time, (1,)))
    return None if there.reached.all() else out_of_reach(there)
