"""The greatest and the lowest value over a motion, looked for between its poses, whatever their number.

What is looked at is the range that the poses cover: of a single stroke from its least to its greatest value; of several strokes in arrays
of one axis the path through the poses in their order; of a grid the box from the least to the greatest value of each. See `peaks` for
how and how closely it is looked at; grids are looked at by `highest_in`, at the end of this file.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import product
from typing import Any, final

import numpy as np

from ..errors import DefinitionError
from ..language import said
from ..plan import Mask
from ..program import FloatArray
from .between import Function, OnLegs, require_function, values_of
from .grid import JoinedTo, joined_in_order
from .limits import place_text, stroke_unit
from .motion import Motion
from .peaks import CLOSE, Index, bisected, highest, is_pole, missing_lowest, peaks, zoomed


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
    if len(motion._stroke_shape) > 1 and len(moving(motion)) > 1:
        box = InBox(motion, f, sense)
        top, shape = highest_in(box), (*box.front, *motion._design_shape)
        strokes = {name: in_shape(value, shape) for name, value in box.strokes(top.unit).items()}
        return Extremum(in_shape(sense * top.value, shape), strokes, in_shape(top.unbounded, shape), units)
    between = OnLegs(motion, f, sense)
    found, shape = highest(between.look, between.route.counts), (*between.front, *motion._design_shape)
    strokes = {name: in_shape(value, shape) for name, value in between.route.strokes(found.leg, found.t).items()}
    return Extremum(in_shape(sense * found.value, shape), strokes, in_shape(found.unbounded, shape), units)


def in_shape(values: Any, shape: tuple[int, ...]) -> Any:
    """Return values (K, D) in the shape asked for; a single one as a plain number."""
    return values.reshape(shape) if shape else values.item()


def moving(motion: Motion) -> tuple[str, ...]:
    """Return the strokes that a motion moves."""
    return tuple(name for name, value in motion.strokes.items() if np.ptp(value) > 0.0)


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


# The highest values of functions over a box of several strokes; many functions and many designs at once.
#
# A grid of some thousand poses gives the starts: of the points that no neighbour betters, the best. From each a search goes on in a cube
# about the best place so far: a regular stencil, and points of a sequence that fills the cube evenly, others in every round, so that ridges
# and borders in any direction are followed; the last step is tried again, once and up to eight times over. Where nothing better is found
# the cube is halved, down to 1e-11 of the box.
#
# What that guarantees is less than along a line. The highest hill is found if it is broader than two steps of the grid: 1/32 of each stroke
# for two of them, 1/8 for three, a quarter for four; narrower ones may be missed. Its top is found to rounding where the function is smooth
# or its kinks run along the strokes. On a ridge or a border of what is reached that is oblique to them the value may fall short by some
# 1e-4 of its range, and the place by more. Where that is too little, look along a path.
# Search after C. Audet, J. E. Dennis, SIAM J. Optim. 17 (2006) 188-217; sequence after H. Weyl, Math. Ann. 77 (1916) 313-352.

SIDES = {2: 65, 3: 17, 4: 9, 5: 5, 6: 4}
STARTS, FILL = 8, 48  # of each function and design; points of the sequence a round
AGAIN = np.array([[1.0], [2.0], [4.0], [8.0]])  # the last step is tried again so many times over
NARROW, ROUNDS = 1e-11, 300
SEEN, BORDER = 1e-7, 1e-8  # how near a value must keep growing to be unbounded, and how near its border is known; of the box


@final
@dataclass(frozen=True, eq=False)
class HighestInBox:
    """The highest value of K functions of D designs, arrays (K, D), NaN where there is none; where (K, D, k); whether it is unbounded."""

    value: FloatArray
    unit: FloatArray
    unbounded: Mask


@final
class InBox:
    """A function of the poses in the box from the least to the greatest value of k strokes that a motion moves; others stand still."""

    def __init__(self, motion: Motion, f: Function, sense: float = 1.0) -> None:
        self.f, self.sense, self.names = f, sense, moving(motion)
        self.low = {name: float(np.min(value)) for name, value in motion.strokes.items()}
        self.span = {name: float(np.max(value)) - self.low[name] for name, value in motion.strokes.items()}
        self.k = len(self.names)
        self.side = SIDES.get(self.k, 3)
        grid = np.stack(np.meshgrid(*[np.linspace(0.0, 1.0, self.side)] * self.k, indexing="ij"), axis=-1)
        self.first = Motion(motion.plan, motion.designs, self.strokes(grid), "nan", joining=joined_in_order)
        self.seen = sense * values_of(f, self.first)
        self.front = self.seen.shape[: self.seen.ndim - len(self.first.shape)]
        self._reached = self.first.reached.reshape(-1, self.side**self.k)

    def strokes(self, unit: FloatArray) -> dict[str, FloatArray]:
        """Return the strokes [SI], shape (...), at places (..., k) of the unit box."""
        still = np.zeros(unit.shape[:-1])
        share = {name: unit[..., axis] for axis, name in enumerate(self.names)}
        return {name: low + self.span[name] * share.get(name, still) for name, low in self.low.items()}

    def look(self, unit: FloatArray) -> tuple[FloatArray, Mask]:
        """Return the values (K, D, c, n) at places (D, c, n, k), each design at its own, and which poses (D, c, n) are reached."""
        shape = (*self.first._design_shape, *unit.shape[1:-1])
        strokes = {name: value.reshape(shape) for name, value in self.strokes(unit).items()}
        near = self._near(unit).reshape(shape)
        motion = Motion(self.first.plan, self.first.designs, strokes, "nan", per_design=True, joining=JoinedTo(self.first._grid, near))
        seen = self.sense * values_of(self.f, motion)
        return seen.reshape(-1, *unit.shape[:-1]), motion.reached.reshape(unit.shape[:-1])

    def _near(self, unit: FloatArray) -> FloatArray:
        """Return the nearest reached of the grid points about places (D, c, n, k), by their number; the nearest where none is."""
        at = unit * (self.side - 1)
        low = np.clip(np.floor(at), 0, self.side - 2)
        weights = self.side ** np.arange(self.k - 1, -1, -1)
        best, near = np.full(unit.shape[:-1], np.inf), np.zeros(unit.shape[:-1], int)
        for corner in product((0.0, 1.0), repeat=self.k):
            place = ((low + corner) @ weights).astype(int)
            there = np.take_along_axis(self._reached, place.reshape(len(place), -1), axis=-1).reshape(place.shape)
            away = np.abs(at - low - corner).max(axis=-1) + np.where(there, 0.0, 10.0)
            best, near = np.minimum(best, away), np.where(away < best, place, near)
        return near


@np.errstate(all="ignore")
def highest_in(box: InBox) -> HighestInBox:
    """Return the highest values in a box."""
    D = box._reached.shape[0]
    seen = box.seen.reshape(-1, D, box.side**box.k)
    unit, value = starts(missing_lowest(seen), box)
    half, last, sequence = np.full(value.shape, 1.0 / (box.side - 1)), np.zeros(unit.shape), Sequence(box.k)
    for _ in range(ROUNDS):
        if half.max() <= NARROW:
            break
        steps = np.concatenate([half[..., None, None] * sequence.around(), last[..., None, :] * AGAIN], axis=-2)
        at = np.clip(unit[..., None, :] + steps, 0.0, 1.0)
        found, _ = at_own_places(box, at)
        place = np.argmax(missing_lowest(found), axis=-1)[..., None]
        top = np.take_along_axis(missing_lowest(found), place, axis=-1)[..., 0]
        better = top > value
        new = np.where(better[..., None], np.take_along_axis(at, place[..., None], axis=-2)[..., 0, :], unit)
        last = np.where(better[..., None], new - unit, 0.5 * last)
        unit, value, half = new, np.where(better, top, value), np.where(better, half, 0.5 * half)
    return best_of_starts(unit, value, grows_in_box(box, unit, value), np.asarray(np.isnan(seen).all(axis=-1)))


class Sequence:
    """Points about a place: a regular stencil, and those of a sequence that fills the cube evenly, going on from round to round."""

    def __init__(self, k: int) -> None:
        side = (-1.0, -0.5, 0.0, 0.5, 1.0) if k < 4 else (-1.0, 0.0, 1.0)
        every = np.array([*product(side, repeat=k)]) if k < 5 else np.concatenate([np.eye(k), -np.eye(k)])
        root = 2.0
        for _ in range(64):
            root = (1.0 + root) ** (1.0 / (k + 1))
        self._stencil, self._steps, self._next = every, root ** -np.arange(1.0, k + 1), 1

    def around(self) -> FloatArray:
        """Return the points of the next round, shape (n, k), from -1 to 1."""
        numbers = np.arange(self._next, self._next + FILL)
        self._next += FILL
        return np.concatenate([self._stencil, 2.0 * ((0.5 + numbers[:, None] * self._steps) % 1.0) - 1.0])


def starts(values: FloatArray, box: InBox) -> tuple[FloatArray, FloatArray]:
    """Return of each function and design the best grid points that no neighbour betters: unit (K, D, c, k) and value (K, D, c)."""
    K, D, _ = values.shape
    cube = values.reshape(K, D, *[box.side] * box.k)
    padded = np.pad(cube, [(0, 0), (0, 0), *[(1, 1)] * box.k], constant_values=-np.inf)
    highest = np.ones(cube.shape, bool)
    for offset in product((0, 1, 2), repeat=box.k):
        highest &= cube >= padded[(slice(None), slice(None), *(slice(each, each + box.side) for each in offset))]
    ranked = np.where(highest.reshape(values.shape), values, -np.inf)
    place = np.argsort(-ranked, axis=-1, kind="stable")[..., : min(STARTS, int(np.isfinite(ranked).sum(axis=-1).max()) or 1)]
    unit = np.stack(np.unravel_index(place, [box.side] * box.k), axis=-1) / (box.side - 1.0)
    return unit, np.take_along_axis(values, place, axis=-1)


def at_own_places(box: InBox, unit: FloatArray) -> tuple[FloatArray, Mask]:
    """Return the values of K functions at places of their own (K, D, c, n, k), and whether these are reached, shape (K, D, c, n)."""
    K, D, c, n, k = unit.shape
    values, reached = box.look(np.moveaxis(unit, 0, 1).reshape(D, K * c, n, k))
    values_of_each = values.reshape(K, D, K, c, n)[np.arange(K), :, np.arange(K)]
    return values_of_each, np.moveaxis(reached.reshape(D, K, c, n), 1, 0)


def grows_in_box(box: InBox, unit: FloatArray, value: FloatArray) -> Mask:
    """Return at which places (K, D, c, k) a value (K, D, c) grows beyond bounds along a stroke; see `peaks.grows_along_leg`."""
    far = np.ldexp(1.0, -np.arange(1, 41))
    ways = np.array([-1.0, 1.0])[:, None, None] * far[:, None] * np.eye(box.k)[:, None, None, :]  # (k, 2, n, k)
    at = unit[..., None, None, None, :] + ways
    on = ((at >= 0.0) & (at <= 1.0)).all(axis=-1)
    seen, reached = at_own_places(box, np.clip(at, 0.0, 1.0).reshape(*value.shape, -1, box.k))
    seen, reached = np.where(on, seen.reshape(on.shape), np.nan), reached.reshape(on.shape) & on
    poles = is_pole(np.broadcast_to(value[..., None], on.shape[:-2]), seen, reached, far, BORDER, SEEN)
    return np.asarray(np.isposinf(value) | poles.any(axis=(-2, -1)))


def best_of_starts(unit: FloatArray, value: FloatArray, unbounded: Mask, missing: Mask) -> HighestInBox:
    """Return the best place of every function and design; one without bounds goes first."""
    any_unbounded = np.asarray(unbounded.any(axis=-1))
    place = np.argmax(np.where(any_unbounded[..., None] & ~unbounded, -np.inf, value), axis=-1)[..., None]
    best = np.where(any_unbounded, np.inf, np.take_along_axis(value, place, axis=-1)[..., 0])
    where = np.take_along_axis(unit, place[..., None], axis=-2)[..., 0, :]
    return HighestInBox(np.where(missing, np.nan, best), where, any_unbounded)
