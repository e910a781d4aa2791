"""A group continued from the sketch to the poses asked for, without jumps, each way by its own steps, by the rules of `rules`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import final

import numpy as np
import numpy.typing as npt

from ..program import BACKEND, FloatArray
from ..vectors import Numbers
from .batched_continuation import STUCK, Program, place_rows, state_rows
from .newton import Newton, at_poses
from .rules import FIRST, TOUCH, goes_on, interpolated, predicted, step_judged

Index = npt.NDArray[np.intp]
CROSSING = 0.75
BLOCK = 16384
ROOM = 64
"""The places of a lane that memory is first made for."""
FEW = 4
"""So many lanes are followed one by one in plain floats: an array operation on a few numbers costs more than a step."""


STEPS_KEPT = 1024
"""The places of steps of later groups of which the pins are kept."""


@final
class InputRoute:
    """Ways of the program's inputs, straight lines over places of lanes: a lane for every design and each of n ways.

    `designs` hold what does not change on a way, floats or arrays (m,), `ways` what does: a value at place 0, and its change over a unit
    of place, the same for all or one a way.
    """

    def __init__(self, designs: Mapping[str, Numbers], ways: Mapping[str, tuple[float, Numbers]], n: int = 1) -> None:
        flat = {name: np.ravel(value) for name, value in designs.items()}
        self.shared = {name: (value.item(), 0.0) for name, value in flat.items() if value.size == 1}
        self.own = {name: value for name, value in flat.items() if value.size > 1}
        self.ways, self.n = {name: (start, np.ravel(change)) for name, (start, change) in ways.items()}, n

    def lines(self, lane: Index) -> dict[str, tuple[Numbers, Numbers]]:
        """Return every input at place 0 and its change over a unit of place, floats or arrays like the lanes."""
        own = {name: (value[lane // self.n], 0.0) for name, value in self.own.items()}
        changes = self.ways.items()
        moved = {name: (start, float(way[0]) if way.size == 1 else way[lane % self.n]) for name, (start, way) in changes}
        return {**self.shared, **own, **moved}

    def inputs(self, lane: Index, place: FloatArray) -> dict[str, Numbers]:
        """Return the inputs at places of lanes, arrays (n,) or floats."""
        lines = self.lines(lane).items()
        return {name: start if np.ndim(slope) == 0 and slope == 0.0 else start + place * slope for name, (start, slope) in lines}


@final
@dataclass(frozen=True)
class Lanes:
    """Where ways begin and how far they are to go, arrays (lanes,): u (coordinates, lanes) [m]."""

    lane: Index
    place: FloatArray
    u: FloatArray
    goal: FloatArray
    largest: FloatArray
    """The largest step."""
    exact: bool
    """Whether a way ends at its goal, or at the first of its own steps behind it, so that these are the same for every goal."""

    @property
    def ends(self) -> FloatArray:
        """Each lane's goal, the place that no step leads beyond, and the largest step, shape (3, lanes)."""
        return np.array([self.goal, self.goal if self.exact else np.full(len(self.goal), np.inf), self.largest])


@final
class GroupPath:
    """One group's way along each lane of a route: the places it was solved at, and the solution at any place between."""

    def __init__(
        self, newton: Newton, route: InputRoute, before: Sequence[GroupPath], lanes: Lanes, begun: GroupPath | None = None
    ) -> None:
        self.newton, self.route, self.before, self.lanes = newton, route, before, lanes
        self._row = {name: k for k, name in enumerate(state_rows(len(lanes.u)))}
        self._kept = len(place_rows(len(lanes.u)))
        self._is_first = set(newton.programs.inputs) <= set(route.lines(lanes.lane[:1]))
        self._at_steps: dict[tuple[bytes, bytes], FloatArray] = {}
        count = len(lanes.u)
        self._pins, self._old, self._older = (slice(self._row[name], self._row[name] + count) for name in ("u0", "w0", "x0"))
        self._state: FloatArray = np.zeros((len(self._row), len(lanes.lane))) if begun is None else begun._state.copy()
        self._record: list[tuple[Index, FloatArray]] = [] if begun is None else list(begun._record)
        if begun is None:
            sense, size = newton.sense(self._held(lanes.lane, lanes.place), lanes.u)
            begin = dict.fromkeys(("t", "before", "earlier"), lanes.place) | {"sense": sense, "size": size, "step": FIRST * lanes.largest}
            for name, values in (begin | {"going": np.abs(sense) >= TOUCH}).items():
                self._state[self._row[name]] = values
            self._state[self._pins] = self._state[self._old] = self._state[self._older] = lanes.u
        self._follow()
        self._store()

    def onward(self, before: Sequence[GroupPath], goal: FloatArray) -> GroupPath:
        """Return this track followed farther, by the steps it would have taken at once; itself where it goes so far."""
        if np.all((goal <= self.lanes.goal) | (self.ended < np.inf)):
            return self
        return GroupPath(self.newton, self.route, before, replace(self.lanes, goal=np.maximum(goal, self.lanes.goal)), self)

    def _held(self, lane: Index, place: FloatArray) -> dict[str, Numbers]:
        """Return what this group's programs take at places of lanes, the pins of the groups before it included."""
        inputs = self.route.inputs(lane, place)
        for track in self.before:  # each is told the pins of those before itself, which would else be found 2^k times
            inputs |= dict(zip(track.newton.names, track._at_step(lane, place, inputs), strict=True))
        return self.newton.held(inputs)

    def _at_step(self, lane: Index, place: FloatArray, inputs: Mapping[str, Numbers]) -> FloatArray:
        """Return the pins at places of a later group, with the inputs there; of few lanes they are kept, as other groups step there too."""
        if len(lane) > FEW:
            return self.at(lane, place, inputs)
        key = lane.tobytes(), place.tobytes()
        if key not in self._at_steps:
            if len(self._at_steps) >= STEPS_KEPT:
                self._at_steps.clear()
            self._at_steps[key] = self.at(lane, place, inputs)
        return self._at_steps[key]

    # -- from place to place ---------------------------------------------------------------------------------

    def _follow(self) -> None:
        """Follow every lane to its goal, or to the end of its way."""
        state, row, lanes = self._state, self._row, self.lanes
        while True:
            going = np.flatnonzero((state[row["going"]] > 0.0) & (state[row["t"]] < lanes.goal))
            if not going.size:
                self._keep_start()
                return
            way = (lanes.goal[going] - state[row["t"], going]) / lanes.largest[going]
            if (program := self._compiled_program(float(np.sum(way)))) is not None:
                self._compiled(program, going)
            elif len(going) <= FEW and (program := self._program()) is not None:
                self._keep_start()
                self._in_floats(program, going)
            else:
                self._keep_start()
                self._step(going)
                continue
            stuck = np.flatnonzero(state[row["going"]] == STUCK)
            if stuck.size:
                state[row["going"], stuck] = 1.0
                self._step(stuck)

    def _keep_start(self) -> None:
        """Record where the lanes begin, once."""
        if not self._record:
            self._record.append((np.arange(len(self.lanes.lane)), self._state[: self._kept].copy()))

    def _program(self) -> Program | None:
        """Return the program of lanes; None where another group comes first."""
        plan, group = self.newton.plan, self.newton.group
        return plan.made(("lanes", group.name), lambda twin: Program.of(twin, group)) if self._is_first else None

    def _compiled_program(self, steps: float) -> Program | None:
        """Return the program where so many steps are done by compiled loops."""
        asked, program = BACKEND.get(), self._program()
        return program if program and (asked == "numba" or (asked is None and program.is_compiled(steps))) else None

    def _lines(self, program: Program, lanes: Index) -> tuple[FloatArray, FloatArray]:
        """Return the inputs of some lanes at place 0 and their changes, shape (inputs, lanes)."""
        lines = self.route.lines(self.lanes.lane[lanes])
        a, b = np.empty((2, len(program.inputs), len(lanes)))
        for k, name in enumerate(program.inputs):
            a[k], b[k] = lines[name]
        return a, b

    def _in_floats(self, program: Program, lanes: Index) -> None:
        """Follow some lanes one after the other."""
        a, b = self._lines(program, lanes)
        places, good, width = program.memory.places, self._row["good"], len(self._row)
        ends = self.lanes.ends
        for k, lane in enumerate(lanes):
            s = [0.0] * len(places)
            s[:width] = self._state[:, lane].tolist()
            s[places["a0"] : places["a0"] + len(a)], s[places["b0"] : places["b0"] + len(b)] = a[:, k].tolist(), b[:, k].tolist()
            s[places["goal"] : places["goal"] + 3] = ends[:, lane].tolist()
            found = []
            while program.floats(s):
                if s[good]:
                    found.append(s[: self._kept])
            self._state[:, lane] = s[:width]
            if found:
                self._record.append((np.full(len(found), lane), np.array(found).T))

    def _compiled(self, program: Program, lanes: Index) -> None:
        """Follow some lanes in a compiled loop."""
        a, b = self._lines(program, lanes)
        state, ends, count = np.take(self._state, lanes, axis=1), np.take(self.lanes.ends, lanes, axis=1), np.zeros(len(lanes), np.int64)
        start, room, begins = 0, ROOM * (len(lanes) + 1), not self._record and len(lanes) == len(self.lanes.lane)
        if not begins:
            self._keep_start()
        while start < len(lanes):
            out = np.empty((self._kept, room))
            next_lane, used = program.follow(a, b, state, ends, out, count, start, begins)
            self._record.append((np.repeat(lanes[start:next_lane], count[start:next_lane]), out[:, :used]))
            room = room if next_lane > start else 2 * room
            start = next_lane
        self._state[:, lanes] = state

    def _step(self, k: Index) -> None:
        """Take a step with some lanes, all at once."""
        whole, row, lanes = len(k) == len(self.lanes.lane), self._row, self.lanes
        state, (_, limit, largest) = (each if whole else np.take(each, k, axis=1) for each in (self._state, lanes.ends))
        places = [state[row[name]] for name in ("t", "before", "earlier")]
        pins = [state[each] for each in (self._pins, self._old, self._older)]
        with np.errstate(all="ignore"):
            ahead, (line,), (start,) = predicted(state[row["step"]], limit, places, [[each] for each in pins])
            held = self._held(lanes.lane[k], ahead)
            found, done = self.newton.correct(held, start, state[row["size"]])
            sense, size = self.newton.sense(held, found)
            miss = np.abs(found - line).max(axis=0)
            good, step = step_judged(ahead - places[0], state[row["sense"]], largest, done, miss, sense, size)
            taken = slice(None) if good.all() else np.flatnonzero(good)
            for old, new in ((2, 1), (1, 0)):
                places[old][taken], pins[old][:, taken] = places[new][taken], pins[new][:, taken]
            places[0][taken], pins[0][:, taken] = ahead[taken], found[:, taken]
            state[row["sense"], taken], state[row["size"], taken] = sense[taken], size[taken]
            state[row["step"]] = step
            state[row["going"]] = goes_on(state[row["t"]], state[row["sense"]], step, largest)
        if not whole:
            self._state[:, k] = state
        self._record.append((k[taken], np.array(state[: self._kept, taken])))

    def _store(self) -> None:
        """Keep the places of all lanes one after the other."""
        count = len(self.lanes.lane)
        lane, kept = self._record[0]
        if len(self._record) > 1:
            lane, kept = np.concatenate([each for each, _ in self._record]), np.concatenate([each for _, each in self._record], axis=1)
        kept = np.ascontiguousarray(kept)
        if np.any(lane[1:] < lane[:-1]):
            order = np.argsort(lane, kind="stable")
            lane, kept = lane[order], np.take(kept, order, axis=1)
        self._record = [(lane, kept)]
        self.kept, self.places, self.clear, self.size, self.u = kept, kept[0], np.abs(kept[1]), kept[2], kept[3:]
        self.first = np.searchsorted(lane, np.arange(count + 1))
        self.last = self.first[1:] - 1
        reached = self.places[self.last]
        lost = ~np.isfinite(self.clear[self.first[:-1]])
        self.ended = np.where(lost, -1.0, np.where(reached >= self.lanes.goal, np.inf, reached))
        self.crossed = np.zeros(count, bool)
        for k in np.flatnonzero((self.ended >= 0.0) & (self.ended < np.inf)):
            self.crossed[k] = self._crosses(int(k))

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

    def at(self, lane: Index, place: FloatArray, inputs: Mapping[str, Numbers] | None = None) -> FloatArray:
        """Return the pins at places of lanes, shape (coordinates, n) [m]; NaN behind the end of a way.

        `inputs` are those of the program at these places with the pins of the groups before this one, where they are known.
        """
        program = self._compiled_program(len(lane))
        if program is not None:
            return self._between(lane, place, self._filled(program, lane, place))
        parts = []
        for block in (slice(k, k + BLOCK) for k in range(0, len(lane), BLOCK)):
            held = self._held(lane[block], place[block]) if inputs is None else self.newton.held(at_poses(inputs, block))
            parts.append(self._between(lane[block], place[block], self._near(lane[block], place[block], held)))
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

    def _between(self, lane: Index, place: FloatArray, near: tuple[FloatArray, FloatArray]) -> FloatArray:
        """Return the pins at places, from what is found near them."""
        found, close = near
        again = np.flatnonzero(close == 0.0)
        if again.size:  # followed on their own from the place before
            left = self._left(lane[again], place[again])
            width = self.places[np.minimum(left + 1, self.last[lane[again]])] - self.places[left]
            again, left, width = again[width > 0.0], left[width > 0.0], width[width > 0.0]
            lanes = Lanes(lane[again], self.places[left], self.u[:, left], place[again], 0.25 * width, exact=True)
            there = GroupPath(self.newton, self.route, self.before, lanes)
            found[:, again] = np.where(np.isinf(there.ended), there.u[:, there.last], np.nan)
            close[again] = 1.0
        found[:, close <= 0.0] = np.nan
        return found

    def _near(self, lane: Index, place: FloatArray, held: Mapping[str, Numbers]) -> tuple[FloatArray, FloatArray]:
        """Return what Newton's method finds at places, 1 where that is near enough to what is expected, -1 beyond the end of a way."""
        left = self._left(lane, place)
        right, before = np.minimum(left + 1, self.last[lane]), np.maximum(left - 1, self.first[lane])
        places, pins = ([np.take(values, each, axis=-1) for each in (before, left, right)] for values in (self.places, self.u))
        clear, sizes = ([values[each] for each in (left, right)] for values in (self.clear, self.size))
        with np.errstate(all="ignore"):
            (guess,), bound = interpolated(place, places, [[each] for each in pins], clear, sizes)
            within = place <= self.ended[lane]
            found, done = self.newton.correct(held, np.where(within, guess, np.nan), sizes[0])
            close = done & (np.abs(found - guess).max(axis=0) <= bound)
        return found, np.where(within, close, -1.0)

    def _filled(self, program: Program, lane: Index, place: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the same in a compiled loop."""
        a, b = self._lines(program, np.arange(len(self.lanes.lane)))
        found, close = np.empty((len(self.u), len(lane))), np.empty(len(lane))
        program.fill(lane, np.ascontiguousarray(place), a, b, self.first, self.kept, self.ended, found, close)
        return found, close
