"""A group continued from the sketch to the poses asked for, without jumps, each way by its own steps.

A step is taken where Newton's method converges so near to the place predicted from the last two that no other solution lies
between, on the same side of every singular pose, and the distance from these has not shrunk to less than half; else it is made
smaller. Two branches lie apart, against the group's size, by about as much as the pose stands clear of a singular one, so that steps
become small in proportion where branches cross or end, and a way comes to an end there to 1e-6 of that clearance.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, NamedTuple, Protocol, TypeAlias

import numpy as np
import numpy.typing as npt

from ..program import FloatArray
from .newton import Mask, Newton

Index = npt.NDArray[np.intp]
Places: TypeAlias = tuple[Index, FloatArray, FloatArray, FloatArray, FloatArray]
"""Which lanes took a step, where to, the pins there, their clearance and the group's size."""

TOUCH = 1e-6
"""The clearance at which a way ends: below it two branches are not told from each other."""
NEAR = 0.1
"""How far from the predicted place a solution may lie, of the clearance times the group's size."""
ROUNDING = 1e-13
SHRINK = 0.5
GROW = 2.0
FIRST = 1e-2
"""The first step, of the largest."""
LEAST = 1e-12
"""The least step, of the largest; a group that Newton's method does not carry so far ends there."""
CROSSING = 0.75
BLOCK = 4096


class Route(Protocol):
    """Ways from the sketch: the inputs of the program at places of lanes, arrays (n,) or floats. A place is 0 at the sketch."""

    def inputs(self, lane: Index, place: FloatArray) -> dict[str, Any]:
        """Return the inputs."""


@dataclass(frozen=True)
class Lanes:
    """Where ways begin and how far they are to go, arrays (lanes,): u (coordinates, lanes) [m]."""

    lane: Index
    place: FloatArray
    u: FloatArray
    goal: FloatArray
    largest: float | FloatArray
    """The largest step."""
    exact: bool
    """Whether a way ends at its goal, or at the first of its own steps behind it, so that these are the same for every goal."""


class Landed(NamedTuple):
    """What Newton's method found a step ahead, and whether it did; how far from where it was expected, the clearance, the size [m]."""

    u: FloatArray
    done: Mask
    miss: FloatArray
    sense: FloatArray
    size: FloatArray


@dataclass
class Ways:
    """Where the lanes of a track stand: their place, the pins, the clearance with its sign, the place and pins before, the next step."""

    t: FloatArray
    u: FloatArray
    s: FloatArray
    before: FloatArray
    u_before: FloatArray
    step: FloatArray
    largest: FloatArray
    going: Mask
    record: list[Places]

    @classmethod
    def of(cls, newton: Newton, inputs: Mapping[str, Any], lanes: Lanes) -> Ways:
        """Return the lanes at their beginning."""
        largest = np.broadcast_to(np.asarray(lanes.largest, float), lanes.place.shape)
        s, size = newton.sense(inputs, lanes.u)
        record = [(np.arange(len(s)), lanes.place.copy(), lanes.u.copy(), s.copy(), size)]
        t, u = lanes.place.copy(), lanes.u.copy()
        return cls(t, u, s, t.copy(), u.copy(), FIRST * largest, largest, np.asarray(np.abs(s) >= TOUCH), record)

    def copied(self) -> Ways:
        """Return a copy that can be followed farther."""
        return replace(
            self, t=self.t.copy(), u=self.u.copy(), s=self.s.copy(), before=self.before.copy(), u_before=self.u_before.copy(),
            step=self.step.copy(), going=self.going.copy(), record=list(self.record),
        )  # fmt: skip

    def guess(self, k: Index, h: FloatArray) -> FloatArray:
        """Return where the pins of some lanes are expected after a step: on the line through the last two places."""
        back = self.t[k] - self.before[k]
        share = np.where(back > 0.0, h / np.where(back > 0.0, back, 1.0), 0.0)
        return np.asarray(self.u[:, k] + (self.u[:, k] - self.u_before[:, k]) * share)

    def taken(self, k: Index, ahead: FloatArray, landed: Landed) -> None:
        """Go to what was found a step ahead where it is the same branch; settle the next step."""
        h, sense, size = ahead - self.t[k], landed.sense, landed.size
        with np.errstate(all="ignore"):
            was, now = np.abs(self.s[k]), np.abs(sense)
            excess = np.sqrt((NEAR * np.minimum(was, now) + ROUNDING) * size / np.maximum(landed.miss, 1e-300))
            same = landed.done & (sense * self.s[k] > 0.0)
            good = same & (now >= SHRINK * was) & (excess >= 1.0)
            falls = np.maximum(was - now, 0.0) / h
            onward = np.minimum(h * np.clip(0.7 * excess, SHRINK, GROW), np.where(falls > 0.0, 0.45 * now / falls, np.inf))
            again = h * np.where(same, np.clip(0.7 * excess, 0.1, SHRINK), 0.3)
        self.step[k] = np.where(good, np.minimum(self.largest[k], onward), again)
        a = k[good]
        self.before[a], self.u_before[:, a] = self.t[a], self.u[:, a]
        self.t[a], self.u[:, a], self.s[a] = ahead[good], landed.u[:, good], sense[good]
        self.record.append((a, self.t[a], self.u[:, a], self.s[a], size[good]))
        self.going[k] = (np.abs(self.s[k]) >= TOUCH) & (self.step[k] > LEAST * self.largest[k]) & (self.t[k] + self.step[k] > self.t[k])


class Track:
    """One group's way along each lane of a route: the places it was solved at, and the solution at any place between."""

    def __init__(self, newton: Newton, route: Route, before: Sequence[Track], lanes: Lanes, begun: Track | None = None) -> None:
        self.newton, self.route, self.before, self.lanes = newton, route, before, lanes
        self._ways: Ways = Ways.of(newton, self.inputs(lanes.lane, lanes.place), lanes) if begun is None else begun._ways.copied()
        self._follow(self._ways)
        self._store(self._ways.record, len(lanes.lane))

    def onward(self, before: Sequence[Track], goal: FloatArray) -> Track:
        """Return this track followed farther, by the steps it would have taken at once; itself where it goes so far."""
        if np.all((goal <= self.lanes.goal) | (self.ended < np.inf)):
            return self
        return Track(self.newton, self.route, before, replace(self.lanes, goal=np.maximum(goal, self.lanes.goal)), self)

    def inputs(self, lane: Index, place: FloatArray) -> dict[str, Any]:
        """Return the inputs at places of lanes, the pins of the groups before this one included."""
        found = self.route.inputs(lane, place)
        for track in self.before:
            found |= dict(zip(track.newton.names, track.at(lane, place), strict=True))
        return found

    def _follow(self, ways: Ways) -> None:
        """Follow every lane to its goal, or to the end of its way."""
        lanes = self.lanes
        while True:
            k = np.flatnonzero(ways.going & (ways.t < lanes.goal))
            if not k.size:
                return
            h = np.minimum(ways.step[k], lanes.goal[k] - ways.t[k]) if lanes.exact else ways.step[k]
            ahead = np.where(h < ways.step[k], lanes.goal[k], ways.t[k] + h)
            guess = ways.guess(k, h)
            inputs = self.inputs(lanes.lane[k], ahead)
            found, done = self.newton.correct(inputs, guess)
            sense, size = self.newton.sense(inputs, found)
            with np.errstate(invalid="ignore"):
                miss = np.abs(found - guess).max(axis=0)
            ways.taken(k, ahead, Landed(found, done, miss, sense, size))

    def _store(self, record: Sequence[Places], count: int) -> None:
        """Keep the places of all lanes one after the other."""
        lane = np.concatenate([each[0] for each in record])
        order = np.argsort(lane, kind="stable")
        self.places = np.concatenate([each[1] for each in record])[order]
        self.u = np.concatenate([each[2] for each in record], axis=1)[:, order]
        self.clear = np.abs(np.concatenate([each[3] for each in record])[order])
        self.size = np.concatenate([each[4] for each in record])[order]
        self.first = np.searchsorted(lane[order], np.arange(count + 1))
        self.last = self.first[1:] - 1
        reached = self.places[self.last]
        lost = ~np.isfinite(self.clear[self.first[:-1]])
        self.ended = np.where(lost, -1.0, np.where(reached >= self.lanes.goal, np.inf, reached))
        self.crossed = np.array([0.0 <= self.ended[k] < np.inf and self._crosses(k) for k in range(count)], bool)

    def _crosses(self, k: int) -> bool:
        """Return whether two branches cross where a way ends: its clearance falls in proportion there, and as a root where it turns."""
        clear, t = self.clear[self.first[k] : self.first[k + 1]], self.places[self.first[k] : self.first[k + 1]]
        if clear[-1] > 100.0 * TOUCH:
            return False
        if len(clear) < 3:
            return True
        last = len(clear) - 1
        above = np.flatnonzero(clear >= 2.0 * clear[last])
        second = int(above[-1]) if above.size else last - 1
        above = np.flatnonzero(clear[:second] >= 2.0 * clear[second])
        third = int(above[-1]) if above.size else max(second - 1, 0)
        if third == second or t[last] == t[second]:
            return True
        farther = (clear[third] - clear[second]) / (t[second] - t[third])
        return bool(farther > CROSSING * (clear[second] - clear[last]) / (t[last] - t[second]))

    # -- between the places ----------------------------------------------------------------------------

    def at(self, lane: Index, place: FloatArray) -> FloatArray:
        """Return the pins at places of lanes, shape (coordinates, n) [m]; NaN behind the end of a way."""
        parts = [self._between(lane[k : k + BLOCK], place[k : k + BLOCK]) for k in range(0, len(lane), BLOCK)]
        return np.concatenate(parts, axis=1) if parts else np.empty((len(self.u), 0))

    def _left(self, lane: Index, place: FloatArray) -> Index:
        """Return the last of a lane's places that is not beyond each place asked for."""
        if len(self.first) == 2:
            found = np.searchsorted(self.places, place, side="right") - 1
        else:
            top = float(np.max(self.places, initial=0.0)) * 1.001 + 1e-300
            owner = np.repeat(np.arange(len(self.last)), np.diff(self.first))
            found = np.searchsorted(owner + self.places / top, lane + np.minimum(place / top, 0.9999), side="right") - 1
        return np.clip(found, self.first[lane], np.maximum(self.last[lane] - 1, self.first[lane]))

    def _bend(self, lane: Index, left: Index, right: Index) -> FloatArray:
        """Return the second divided difference of the pins at two places and the one before, so that what comes later changes nothing."""
        before = np.maximum(left - 1, self.first[lane])
        h, back = self.places[right] - self.places[left], self.places[left] - self.places[before]
        known = (h > 0.0) & (back > 0.0)
        h, back = np.where(known, h, 1.0), np.where(known, back, 1.0)
        chords = (self.u[:, right] - self.u[:, left]) / h - (self.u[:, left] - self.u[:, before]) / back
        return np.asarray(np.where(known, chords / (h + back), 0.0))

    def _between(self, lane: Index, place: FloatArray) -> FloatArray:
        left = self._left(lane, place)
        right = np.minimum(left + 1, self.last[lane])
        width = self.places[right] - self.places[left]
        t = np.where(width > 0.0, (place - self.places[left]) / np.where(width > 0.0, width, 1.0), 0.0)
        first = self.u[:, left]
        guess = first + (self.u[:, right] - first) * t + self._bend(lane, left, right) * (t * (t - 1.0) * width * width)
        within = place <= self.ended[lane]
        found, done = self.newton.correct(self.inputs(lane, place), np.where(within, guess, np.nan))
        limit = (NEAR * np.minimum(self.clear[left], self.clear[right]) + ROUNDING) * np.minimum(self.size[left], self.size[right])
        with np.errstate(invalid="ignore"):
            close = done & (np.abs(found - guess).max(axis=0) <= limit)
        again = np.flatnonzero(within & ~close & (width > 0.0))
        if again.size:  # followed on their own from the place before
            lanes = Lanes(lane[again], self.places[left[again]], first[:, again], place[again], 0.25 * width[again], exact=True)
            there = Track(self.newton, self.route, self.before, lanes)
            found[:, again] = np.where(np.isinf(there.ended), there.u[:, there.last], np.nan)
            close[again] = True
        return np.where(within & close, found, np.nan)
