"""The highest values of functions along lines, looked for between samples; many functions and many designs at once.

A line is made of legs, a place on it is a leg and a share t of it, 0 to 1. Nothing is taken to be smooth:

* Samples stand 1/4096 of the range apart. A bump with a base of 1/2000, a triangle or a parabola, has a sample within a quarter of its
  base from its top, which sees at least half of its height (of a parabola three quarters). That sample is higher than its neighbours
  unless the ground beside the bump rises half as fast as the bump itself.
* About every such sample a bracket is looked at in 33 places (in 9 where there are more than 64 brackets). What may still come out
  highest, by what it rises above the places next to it, is narrowed 16-fold (4-fold) a round until the bracket is 1e-13 of the leg, or
  flat to rounding. A kink is found like a smooth top, and so is a jump from its larger side.
* Every border of the places that have a value is bisected to 1e-13 of the leg, and looked at in steps that halve towards it.
* A value that grows with a power of the distance up to a border, or as far as numbers go, is unbounded there; see `is_pole`.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt

from ..vectors import FloatArray, Index, Mask

Look: TypeAlias = Callable[[Index, FloatArray], tuple[FloatArray, Mask]]
"""`look(leg, t)` at places (n,) of all D designs, or (D, n) of each its own: the values of K functions (K, D, n), NaN where there is none,
and whether each pose (D, n) is reached."""

Curve: TypeAlias = Callable[[FloatArray], FloatArray]
"""A function of places (n,), NaN where it has no value."""

SAMPLES = 4096  # over the range
MANY, FEW, FINE, COARSE = 1024, 64, 33, 9  # brackets at most; places in a bracket, up to how many brackets and beyond
PATIENCE, LAST = 8, 8  # for so many rounds all brackets go on that may win, then the best
CLOSE = 1e-13  # of a leg, or of a box: how narrow a bracket gets, and how near a border is found
BORDERS = 32  # of each function and design, at most
NOISE, ROUNDED = 1e-10, 1e-12  # of the range of the values, and of their size: a sample that rises less above its neighbours hides nothing
EPS, LOWEST = float(np.finfo(float).eps), float(np.finfo(float).min)
HALVINGS, CUTS, LEVEL = 48, 512, 2  # steps towards a border; parts about a few borders; more samples as high as the highest are level
SEEN, REFUSED = 1e-9, 1e-5  # of a leg: how near a value must keep growing, to a border and to a refused pose
PLATEAU = 2.0**-12  # of the distance at which a value stopped growing: where it is level from there on numbers went no nearer


class Highest(NamedTuple):
    """The highest value of K functions of D designs, arrays (K, D): value, NaN where there is none; leg and t; whether it is unbounded."""

    value: FloatArray
    leg: Index
    t: FloatArray
    unbounded: Mask


class Tops(NamedTuple):
    """Places that may be highest, arrays (K, D, c): their values, half the brackets about them, and the most that may hide in these."""

    leg: Index
    t: FloatArray
    value: FloatArray
    half: FloatArray
    bound: FloatArray

    def best(self, most: int) -> Tops:
        """Return the highest and those that may still be higher, in every row as many as the fullest row needs, at most so many."""
        highest = self.value.max(axis=-1, keepdims=True)
        rank = np.where(self.bound > highest + 16.0 * EPS * np.abs(highest), self.bound, -np.inf)
        np.put_along_axis(rank, np.argmax(self.value, axis=-1)[..., None], np.inf, axis=-1)
        count = int((rank > -np.inf).sum(axis=-1).max())
        order = np.argsort(-rank, axis=-1, kind="stable")[..., : min(most, count)]
        return Tops._make(np.take_along_axis(each, order, axis=-1) for each in self)

    def subset(self, mask: Mask) -> Tops:
        """Return some of them as one row."""
        return Tops._make(each[mask][None, None] for each in self)

    def concatenated(self, other: Tops) -> Tops:
        """Return the places of both."""
        return Tops._make(np.concatenate(pair, axis=-1) for pair in zip(self, other, strict=True))


def samples(counts: Sequence[int]) -> tuple[Index, FloatArray]:
    """Return places (n,) that cut every leg into so many intervals; each leg has both its ends."""
    leg = np.repeat(np.arange(len(counts)), np.asarray(counts) + 1)
    return leg, np.concatenate([np.linspace(0.0, 1.0, count + 1) for count in counts])


@np.errstate(all="ignore")
def highest(look: Look, counts: Sequence[int]) -> Highest:
    """Return the highest values along legs, cut into so many intervals at first."""
    leg, t = samples(counts)
    seen, _ = look(leg, t)
    values = missing_lowest(seen)
    tops = narrowed(look, peaks(values, leg, t, counts))
    edges = borders(look, np.isnan(seen), values, leg, t)
    tops = tops if edges is None else tops.concatenated(steps_to_borders(look, edges))
    rounds = 1
    while tops.half.max() > CLOSE:
        tops = narrowed(look, tops.best(MANY if rounds < PATIENCE else LAST))
        rounds += 1
    ends = tops if edges is None else tops.concatenated(edges)
    # looked at from 2^-1 to 2^-48 of the leg before and behind a place
    far, (K, D, c) = np.ldexp(1.0, -np.arange(1, HALVINGS + 1)), ends.t.shape
    beside = ends.t[..., None, None] + np.array([-1.0, 1.0])[:, None] * far
    on = (beside >= 0.0) & (beside <= 1.0)
    near, reached = at_own_legs(look, ends.leg, np.clip(beside, 0.0, 1.0).reshape(K, D, c, -1))
    near, reached = np.where(on, near.reshape(on.shape), np.nan), reached.reshape(on.shape) & on
    unbounded = np.asarray(np.isposinf(ends.value) | is_pole(ends.value, near, reached, far).any(axis=-1))
    any_unbounded = np.asarray(unbounded.any(axis=-1))
    score = np.where(any_unbounded[..., None] & ~unbounded, -np.inf, ends.value)
    place = np.argmax(score, axis=-1)[..., None]
    value, own_leg, own_t = (np.take_along_axis(each, place, axis=-1)[..., 0] for each in (ends.value, ends.leg, ends.t))
    level = values >= (value - ROUNDED * np.abs(value))[..., None]  # of a level stretch the first sample is told
    is_level, first = (level.sum(axis=-1) > LEVEL) & ~any_unbounded, np.argmax(level, axis=-1)
    leg, t = np.where(is_level, leg[first], own_leg), np.where(is_level, t[first], own_t)
    value = np.where(any_unbounded, np.inf, np.where(value <= LOWEST, -np.inf, value))
    return Highest(np.where(np.isnan(seen).all(axis=-1), np.nan, value), leg, t, any_unbounded)


def missing_lowest(values: FloatArray) -> FloatArray:
    """Return the values with NaN replaced by -inf, so that a maximum ignores them."""
    return np.where(np.isnan(values), -np.inf, np.maximum(values, LOWEST))


def at_own_legs(look: Look, leg: Index, t: FloatArray) -> tuple[FloatArray, Mask]:
    """Return the values of K functions at places of their own (K, D, c, n), and whether these are reached, same shape.

    A place that several functions ask for, as at a border that they share, is looked at once.
    """
    K, D = t.shape[:2]
    legs = np.broadcast_to(leg[..., None], t.shape).swapaxes(0, 1).reshape(D, -1)
    places = t.swapaxes(0, 1).reshape(D, -1)
    if K == 1:  # nothing is shared
        values, reached = look(legs, places)
        return values.reshape(t.shape), reached.reshape(t.shape)
    columns = np.ascontiguousarray(np.concatenate([legs, places]).T)
    as_bytes = columns.view(np.dtype((np.void, columns.strides[0])))[:, 0]  # whole columns are told apart, several times as fast as by axis
    _, first, back = np.unique(as_bytes, return_index=True, return_inverse=True)
    values, reached = look(legs[:, first], places[:, first])
    own = back.reshape(K, -1)  # of each function its columns among those looked at
    values_of_each = values.reshape(K, D, -1)[np.arange(K)[:, None, None], np.arange(D)[:, None], own[:, None]]
    return values_of_each.reshape(t.shape), reached.reshape(D, -1)[:, own].swapaxes(0, 1).reshape(t.shape)


# -- the samples ---------------------------------------------------------------------------------------------


def shifted(values: FloatArray, by: int, missing: float = np.nan, axis: int = -1) -> FloatArray:
    """Return the values so many places on along an axis, `missing` beyond the ends."""
    found = np.full(values.shape, missing)
    into, out = (slice(None, -by), slice(by, None)) if by > 0 else (slice(-by, None), slice(None, by))
    found.swapaxes(axis, -1)[..., into] = values.swapaxes(axis, -1)[..., out]
    return found


def peaks(values: FloatArray, leg: Index, t: FloatArray, counts: Sequence[int], among: Mask | None = None) -> Tops:
    """Return the samples (K, D, n) that rise above their neighbours by more than noise: some of a mask (n,), else also the highest."""
    finite = np.where(values > LOWEST, values, np.nan)
    rise = np.zeros(values.shape)
    for by in (-2, -1, 1, 2):
        rise = np.fmax(rise, finite - shifted(finite, by))
    size = np.nanmax(np.abs(finite), axis=-1, initial=0.0, keepdims=True)
    span = np.nanmax(finite, axis=-1, initial=-np.inf, keepdims=True) - np.nanmin(finite, axis=-1, initial=np.inf, keepdims=True)
    # Those as high as their neighbours, the first one of a level part; a corner stands twice among them.
    starts, ends = np.diff(leg, prepend=-1) > 0, np.diff(leg, append=leg[-1] + 1) > 0
    before, after = (shifted(values, by, -np.inf) for by in (-1, 1))
    before = np.where(starts, np.maximum(before, shifted(values, -2, -np.inf)), before)
    after = np.where(ends, np.maximum(after, shifted(values, 2, -np.inf)), after)
    hopeful = ((values > before) | (starts & (values == before))) & (values >= after) & (rise > NOISE * span + ROUNDED * size)
    rank = np.where(hopeful, values + rise, -np.inf)
    if among is None:
        np.put_along_axis(rank, np.argmax(values, axis=-1)[..., None], np.inf, axis=-1)
    else:
        rank = np.where(among, rank, -np.inf)
    count = int((rank > -np.inf).sum(axis=-1).max())
    place = np.argsort(-rank, axis=-1, kind="stable")[..., : min(count, MANY)]
    value = np.take_along_axis(values, place, axis=-1)
    is_filled = np.isneginf(np.take_along_axis(rank, place, axis=-1))  # of a row that has fewer of them than the fullest one
    half = np.where(is_filled, 0.0, 1.0 / np.asarray(counts)[leg[place]])
    return Tops(leg[place], t[place], value, half, value + np.take_along_axis(rise, place, axis=-1))


def zoomed(look: Look, tops: Tops) -> Tops:
    """Return the best places in the brackets, with brackets of two intervals about them; of no width where they are flat to rounding."""
    places = FINE if tops.t.shape[-1] <= FEW else COARSE
    low, high = np.maximum(tops.t - tops.half, 0.0)[..., None], np.minimum(tops.t + tops.half, 1.0)[..., None]
    t = low + (high - low) * np.linspace(0.0, 1.0, places)
    seen, _ = at_own_legs(look, tops.leg, t)
    return best_seen(tops, t, seen, np.broadcast_to(tops.half[..., None] * 2.0 / (places - 1), t.shape))


def narrowed(look: Look, tops: Tops) -> Tops:
    """Return tops in narrower brackets: those at the ends of legs at once, by the places that halve the bracket again and again.

    Whatever rises from an end is higher than the end at one of them, by more than rounding; where none is, the end itself is the top.
    """
    at_end = ((tops.t == 0.0) | (tops.t == 1.0)) & (tops.half > CLOSE)
    if at_end.any():
        inwards = np.where(at_end, np.where(tops.t == 0.0, tops.half, -tops.half), 0.0)
        found = steps_to_borders(look, tops._replace(half=inwards))
        with np.errstate(invalid="ignore"):
            is_top = at_end & (found.value - tops.value <= ROUNDED * np.abs(tops.value))
        settled, rises = tops._replace(half=np.where(is_top, 0.0, tops.half)), at_end & ~is_top
        tops = Tops._make(np.where(rises, *pair) for pair in zip(found, settled, strict=True))
    at_end = (tops.t == 0.0) | (tops.t == 1.0)
    return tops if (at_end & (tops.half <= CLOSE)).all() else zoomed(look, tops)


def best_seen(tops: Tops, t: FloatArray, seen: FloatArray, half: FloatArray) -> Tops:
    """Return the best of the places (K, D, c, n) seen, or the known best where that is better.

    What may hide next to it is twice its rise above the places beside it; anything where it has risen more than was thought possible,
    as values do that grow beyond bounds.
    """
    values = missing_lowest(seen)
    place = np.argmax(values, axis=-1)[..., None]
    value = np.take_along_axis(values, place, axis=-1)[..., 0]
    better = value > tops.value
    new = np.where(better, value, tops.value)
    finite = np.where(seen > LOWEST, seen, np.nan)
    steps = [np.take_along_axis(finite, np.clip(place + by, 0, t.shape[-1] - 1), axis=-1)[..., 0] for by in (-1, 1)]
    rise = np.fmax(np.fmax(new - steps[0], new - steps[1]), 0.0)
    flat = ~np.isnan(seen).any(axis=-1) & (values.max(axis=-1) - values.min(axis=-1) <= 8.0 * EPS * np.abs(new))
    narrowed = np.where(flat, 0.0, np.take_along_axis(half, place, axis=-1)[..., 0])
    bound = np.where(new > tops.bound + 16.0 * EPS * np.abs(new), np.inf, new + 2.0 * np.nan_to_num(rise))
    return Tops(tops.leg, np.where(better, np.take_along_axis(t, place, axis=-1)[..., 0], tops.t), new, narrowed, bound)


# -- borders -------------------------------------------------------------------------------------------------


def borders(look: Look, missing: Mask, values: FloatArray, leg: Index, t: FloatArray) -> Tops | None:
    """Return the last places with a value before those without, their brackets as wide as the samples stand apart; None where all have one.

    Rows with fewer borders than others are filled with the first place.
    """
    change = (missing[..., 1:] != missing[..., :-1]) & (leg[1:] == leg[:-1])
    if not change.any():
        return None
    first = np.where(change, -np.maximum(values[..., 1:], values[..., :-1]), np.inf)
    place = np.argsort(first, axis=-1, kind="stable")[..., : min(int(change.sum(axis=-1).max()), BORDERS)]
    is_border = np.take_along_axis(change, place, axis=-1)
    ahead = np.take_along_axis(missing[..., :-1], place, axis=-1)  # the value stands after the border
    inside, outside = (np.where(is_border, place + (ahead if side else ~ahead), 0) for side in (True, False))
    found = bisected(look, leg[inside], t[inside], t[outside])
    value = missing_lowest(at_own_legs(look, leg[inside], found[..., None])[0][..., 0])
    return Tops(leg[inside], found, value, t[inside] - found, np.full(value.shape, np.inf))


def bisected(look: Look, leg: Index, inside: FloatArray, outside: FloatArray) -> FloatArray:
    """Return the last places (K, D, c) with a value between those that have one and those that have none."""
    return last_holding(lambda t: ~np.isnan(at_own_legs(look, leg, t)[0]), inside, outside, CLOSE)[0]


def stretches(mask: Mask) -> list[tuple[int, int]]:
    """Return the first and the last place of every stretch of a mask (n,) that is true, in their order."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], mask, [False]]).astype(int)))
    return [*zip(edges[::2].tolist(), (edges[1::2] - 1).tolist(), strict=True)]


def last_holding(
    holds: Callable[[FloatArray], Mask], inside: npt.ArrayLike, outside: npt.ArrayLike, close: float = 0.0, parts: int = 0
) -> tuple[FloatArray, FloatArray]:
    """Return the last places (...) at which something holds, and the next ones, at which it does not, at most `close` apart.

    It holds `inside` and not `outside`; `holds` is asked of the places (..., n) that cut what lies between into so many parts, again and
    again. By itself it goes to the last digit, and a few borders are cut into more parts: a question costs more than its places.
    """
    inside, outside = np.array(inside, float), np.array(outside, float)
    parts = parts or (FINE - 1 if close else min(max(2 * CUTS // max(inside.size, 1), FINE - 1), CUTS))
    while np.any((np.abs(outside - inside) > close) & (np.nextafter(inside, outside) != outside)):
        t = inside[..., None] + (outside - inside)[..., None] * np.linspace(0.0, 1.0, parts + 1)
        fails = ~holds(t)
        fails[..., -1] = True
        first = np.maximum(np.argmax(fails, axis=-1)[..., None], 1)
        inside, outside = (np.asarray(np.take_along_axis(t, first - back, axis=-1)[..., 0]) for back in (1, 0))
    return inside, outside


def sign_changes(f: Curve, low: FloatArray, high: FloatArray, close: float = 0.0) -> tuple[FloatArray, FloatArray]:
    """Return the last places (c,) from `low` to `high` where f has the sign that it has at `low`, and the next ones, where it has not."""
    sign = np.sign(f(low))[:, None]
    return last_holding(lambda at: np.sign(f(at.ravel())).reshape(at.shape) == sign, low, high, close) if low.size else (low, high)


def highest_between(f: Curve, low: FloatArray, high: FloatArray) -> FloatArray:
    """Return where f is highest between places `low` and `high` (c,), all looked for together."""

    def look(_: Index, t: FloatArray) -> tuple[FloatArray, Mask]:
        at = low[:, None] + (high - low)[:, None] * t
        seen = f(at.ravel()).reshape(at.shape)
        return seen[None], np.isfinite(seen)

    return low + (high - low) * highest(look, [FINE - 1]).t[0] if low.size else low


def steps_to_borders(look: Look, edges: Tops) -> Tops:
    """Return the best of the places that halve the way towards each border, from `half` away on either side, with the bracket about it."""
    shares = np.append(0.5 ** np.arange(36), 0.0)
    t = edges.t[..., None] + edges.half[..., None] * shares
    half = np.abs(edges.half)[..., None] * np.append(shares[:-1], shares[-2])
    return best_seen(edges, t, at_own_legs(look, edges.leg, t)[0], half)


# -- without bounds ------------------------------------------------------------------------------------------


def is_pole(value: FloatArray, seen: FloatArray, reached: Mask, far: FloatArray, border: float = 1e-12, near: float = SEEN) -> Mask:
    """Return from which sides (..., 2) a value (...) grows without bound, from values (..., 2, n) at distances (n,) on either side.

    A value c / (x0 + d)^q gains most by halving d where d is about x0. At a pole its gains grew all the way there, over six halvings at
    least 2.5-fold. For q = 1/2 it is 4-fold; the gains of a finite value shrink. And x0 is as near as numbers go (`near`). Or it is below
    1e-5 and rounding is all that is left: the value scatters within `near`, or does not change from far away, as 1 / (q - c) does where
    q - c is some last digits. Or the poses beyond the place are refused, from `border` on, and x0 is as near as poses are refused for
    their condition: below 1e-5, or about half the width of what is refused.
    """
    gains = missing_lowest(np.diff(seen, axis=-1))
    first, last = gains[..., :-6], gains[..., 6:]
    found = (last > 2.5 * first) & (gains[..., 4:-2] > first)
    for by in range(6):
        before = gains[..., by : by + last.shape[-1]]
        found &= (before > 0.0) & (before <= last)
    most = last.shape[-1] - 1 - np.argmax(found[..., ::-1], axis=-1)
    start = np.take_along_axis(seen, most[..., None], axis=-1)[..., 0]
    much = value[..., None] - start >= 0.01 * np.abs(value[..., None])
    x0 = far[most + 7]
    rough = ~(np.ptp(seen[..., far <= near], axis=(-2, -1)) <= 0.25 * np.abs(value)) & reached[..., far <= near].all(axis=(-2, -1))
    alike = np.logical_and.accumulate((seen == value[..., None, None])[..., ::-1], axis=-1).sum(axis=-1)
    noisy = rough[..., None] | (np.append(far, 0.0)[far.size - alike] >= PLATEAU * x0)
    least = int(np.searchsorted(-far, -border))
    gone = np.isnan(seen[..., ::-1, :])[..., least::-1]
    refused = gone[..., 0] & reached[..., ::-1, least]
    width = np.where(np.logical_and.accumulate(gone, axis=-1), far[least::-1], 0.0).max(axis=-1)
    bound = (refused & ((x0 <= REFUSED) | ((x0 <= 2.0 * width) & (x0 >= width / 8.0)))) | (noisy & (x0 <= REFUSED))
    return np.asarray(found.any(axis=-1) & much & ((x0 <= near) | bound))
