"""Spare strokes moved to where most is carried: the greatest of the least of several smooth loads, within the ends of all strokes.

Around a pose every load, and how far every stroke is from its ends, is a parabola through three values of each spare stroke. What the
parabolas promise is looked for closely and then asked for; where the promise is kept it goes on from there, with less room around it.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import product
from typing import final

import numpy as np

from ..motion.many_places import EDGE, PlacePoses
from ..numeric.line import Index
from ..plan import Mask
from ..program import FloatArray

LEAST = 1e-6
"""Room, in shares of the spare strokes' ranges, below which nothing is looked for."""
CLOSE, SAME = 0.0005, 1e-11
"""With less room than this nothing more is looked for where no more than so much of a load is promised."""
LESS, LITTLE, MORE, ROOM = 0.1, 0.25, 2.0, 0.125
"""What is left of the room where a promise inside it is kept, where one is not, and where it is kept at its border; the most room."""
KEPT = 0.1
"""The share of what is promised that has to come true."""
COST = 100.0
"""What a stroke costs that is a whole range past its end, in loads."""
GRID, ZOOMS, CLOSER = np.linspace(-1.0, 1.0, 9), 5, 0.3
"""Where the parabolas are looked at, in shares of the room, how often, and how much closer each time."""


@final
@dataclass(frozen=True, eq=False)
class Climb:
    """Poses whose spare strokes go to where most is carried; the first `solved` strokes of each are solved for.

    `moved` gives poses (m, n, k) with the spare strokes at some values (m, n, s), and the load of each limiter there (limiters, m, n), NaN
    without one. `order` (n, k) is the order of the strokes of each. `base` are the best poses found and `load` theirs [N]. `centre` (n, k)
    is where each is now, maybe a little past an end, and `worth` what that counts. `room` (n,) is how far around it the search looks, in
    shares of the spare strokes' ranges.
    """

    moved: Callable[[PlacePoses, Index, FloatArray], tuple[FloatArray, FloatArray]]
    solved: int
    base: PlacePoses
    order: Index
    load: FloatArray
    centre: FloatArray
    worth: FloatArray
    room: FloatArray

    @property
    def going(self) -> Index:
        """The poses at which something is left to look for."""
        return np.flatnonzero((self.room > LEAST) & (self.load > 0.0) & np.isfinite(self.load))

    def step(self) -> Climb:
        """Return them after one look around."""
        rows, k = self.going, self.solved
        parts = {name: getattr(self, name)[rows] for name in ("order", "load", "centre", "worth", "room")}
        here = replace(self, base=self.base.where(rows), **parts)
        s = here.centre.shape[1] - k
        around = np.array([*product((-1.0, 0.0, 1.0), repeat=s)])
        room = here.room[:, None]
        middle = np.clip(here.centre[:, k:], np.minimum(room, 0.5), np.maximum(1.0 - room, 0.5))
        unit, of = self.moved(PlacePoses(here.base.place, here.centre), here.order, middle[None] + around[:, None] * room)
        best = here.better(unit, of)
        with np.errstate(invalid="ignore"):  # as shares, 0 for none and 1 without end, a half of the best: smooth everywhere
            shares = np.where(np.isinf(of), 1.0, of / (of + best.load))
        with_ends = np.concatenate([shares, 0.25 * COST * ends_of(unit[:, :, :k]).transpose(2, 0, 1)])
        at, share = best_of_parabolas(with_ends.transpose(0, 2, 1), len(of), s)
        each = parabolas(at)
        bases = each[:, 0]  # the weights of the values at -1, 0 and 1 of each spare stroke (n, 3**s)
        for other in each.swapaxes(0, 1)[1:]:
            bases = (bases[:, :, None] * other[:, None, :]).reshape(len(at), -1)
        guess = np.einsum("na,ank->nk", bases, unit)
        promised = np.where(share < 1.0, share / (1.0 - np.minimum(share, 0.999)), np.inf) * best.load
        begin = PlacePoses(here.base.place, np.where(np.isfinite(guess), guess, here.centre))
        unit, of = self.moved(begin, here.order, (middle + at * room)[None])
        best = best.better(unit, of)
        past = np.minimum(ends_of(unit[:, :, :k]).min(axis=2), 0.0)  # what a pose counts: the least load, less what that costs
        worth = np.nan_to_num((np.min(of, axis=0) + COST * best.load * past)[0], nan=-np.inf)
        kept = np.isfinite(share) & (worth - here.worth >= KEPT * np.maximum(promised - here.worth, 0.0))
        gone = np.abs(unit[0, :, k:] - here.centre[:, k:]).max(axis=1) / here.room
        left = np.where(kept, np.clip(2.0 * gone, LESS, MORE), LITTLE)
        centre, worth = np.where(kept[:, None], unit[0], here.centre), np.where(kept, worth, here.worth)
        there = best.load > worth
        centre, worth = np.where(there[:, None], best.base.unit, centre), np.where(there, best.load, worth)
        done = np.isfinite(share) & (here.room < CLOSE) & (promised - best.load <= SAME * best.load)
        some = {"load": best.load, "centre": centre, "worth": worth, "room": np.where(done, 0.0, np.minimum(here.room * left, ROOM))}
        every = {name: getattr(self, name).copy() for name in some}
        unit = self.base.unit.copy()
        unit[rows] = best.base.unit
        for name, values in some.items():
            every[name][rows] = values
        return replace(self, base=PlacePoses(self.base.place, unit), **every)

    def better(self, unit: FloatArray, of: FloatArray) -> Climb:
        """Return them with those of some poses (m, n, k) that carry more inside all ends."""
        inside = ends_of(unit).min(axis=2) >= -EDGE
        load = np.where(inside, np.nan_to_num(np.min(of, axis=0), nan=-1.0, posinf=np.inf), -1.0)
        top, each = np.argmax(load, axis=0), np.arange(load.shape[1])
        more = load[top, each] > self.load
        found = np.where(more[:, None], np.clip(unit[top, each], 0.0, 1.0), self.base.unit)
        return replace(self, base=PlacePoses(self.base.place, found), load=np.where(more, load[top, each], self.load))


def parabolas(x: FloatArray) -> FloatArray:
    """Return the parabolas that are 1 at -1, 0 or 1 and 0 at the others, at places (n, s), shape (n, s, 3)."""
    return np.stack([0.5 * x * (x - 1.0), 1.0 - x * x, 0.5 * x * (x + 1.0)], axis=2)


def ends_of(unit: FloatArray) -> FloatArray:
    """Return how far strokes (..., k) are inside the end that is nearer, in shares of their ranges."""
    return np.minimum(unit, 1.0 - unit)


def best_of_parabolas(values: FloatArray, loads: int, spare: int) -> tuple[FloatArray, FloatArray]:
    """Return where the least of the first `loads` parabolas is greatest, (n, s) from -1 to 1, and what it is there (n,).

    `values` (r, n, 3**s) are theirs at -1, 0 and 1 of each spare stroke; the others count where they are below zero. -inf where some
    value is missing. Of two strokes the best of the second is looked for at each value of the first, as limits meet at a slant.
    """
    known: Mask = np.asarray(np.isfinite(values).all(axis=(0, 2)))
    values = np.where(known[:, None], values, 0.0).reshape(len(values), values.shape[1], *[3] * spare)
    at, worth = peak_of(values, loads)
    return at, np.where(known, worth, -np.inf)


def peak_of(values: FloatArray, loads: int) -> tuple[FloatArray, FloatArray]:
    """Return the same of values (r, n, 3) or (r, n, 3, 3) that are all known."""
    n, spare = values.shape[1], values.ndim - 2
    at, worth, rest, half, each = np.zeros(n), np.zeros(n), np.zeros((n, 0)), 1.0, np.arange(n)
    for _ in range(ZOOMS):
        x = np.clip(at[:, None] + half * GRID, -1.0, 1.0)
        bases = parabolas(x)
        if spare == 1:
            found = np.einsum("rna,nga->rng", values, bases)
            total = found[:loads].min(axis=0) + np.minimum(found[loads:].min(axis=0), 0.0)
        else:
            left = np.einsum("rnab,nga->rngb", values, bases).reshape(len(values), -1, 3)
            own, total = (part.reshape(n, len(GRID), -1) for part in peak_of(left, loads))
            total = total[:, :, 0]
        top = np.argmax(total, axis=1)
        at, worth, half = x[each, top], total[each, top], CLOSER * half
        rest = own[each, top] if spare == 2 else rest
    return np.concatenate([at[:, None], rest], axis=1), worth
