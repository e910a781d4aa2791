"""A group continued from the sketch to the poses asked for, without jumps, each way by its own steps, by the rules of `rules`."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from ..plan import Plan
from ..program import BACKEND, FLOATS, GUARDED, Dialect, FloatArray, Level, Node, ancestors, compiled, expanded, lowered, replaced
from ..program.cache import is_cached
from ..program.numba_backend import compiled_loop, pays_compiled
from ..program.text import HEAD, NUMBA, lane_loop
from ..steps import Group
from ..vectors import Index, Numbers
from .newton import ITERATIONS, Newton, Programs, at_poses, largest_of, size_of
from .rules import FIRST, TINY, TOUCH, goes_on, interpolated, newton_ended, predicted, step_judged

WIDTH = 16
"""How many lanes go side by side where they are compiled: some vectors of them."""
FIRST_PLACES = 64
FloatNode = Node | float

STUCK = 2.0
"""In the row `going`: 1 where a lane is on its way, 0 where it has ended."""


def state_rows(count: int) -> list[str]:
    """Return the rows of a lane's memory for so many coordinates; the first rows are stored for every place."""
    return [*place_rows(count), "good", "before", "earlier", "step", "going", *row_names("w", count), *row_names("x", count)]


def place_rows(count: int) -> list[str]:
    """Return the rows stored for a place: its position, the clearance with its sign, the size and the pins [m]."""
    return ["t", "sense", "size", *row_names("u", count)]


def row_names(letter: str, count: int) -> list[str]:
    """Return names of a letter and a number."""
    return [f"{letter}{k}" for k in range(count)]


class Program:
    """The loops of a group's continuation: the rows of the lanes' memory that they read and write, and each row's new value."""

    def __init__(self, plan: Plan, group: Group) -> None:
        programs, self.graph = Programs.for_group(plan, group), plan.trace.graph
        pins, known = [self.graph.input(name, Level.POSE) for name in group.inputs[:-1]], programs.known
        given = [node for node in ancestors(known) if node.op == "input"]
        self.inputs, self.count = tuple(node.value for node in given), len(pins)
        self.work, self.spent = RUNS * len(programs.step.plan.pose), 0.0  # about how many operations a step is, and those done
        rows = [*state_rows(len(pins)), "goal", "limit", "largest", "ahead", "active", "last", "near", "settled", "stuck", "now", "extent"]
        rows += [name for letter in "gvy" for name in row_names(letter, len(pins))]
        rows += [name for letter, nodes in (("a", given), ("b", given), ("k", known)) for name in row_names(letter, len(nodes))]
        self.places = {name: k for k, name in enumerate([*rows, "right", "sense1", "size1", "bound"])}
        on = replaced(programs.nodes, {pin: self.row(f"v{k}") for k, pin in enumerate(pins)})
        lines = {node: self.row(f"a{k}") + self.row("ahead") * self.row(f"b{k}") for k, node in enumerate(given)}
        self.loops = self._rules(on)
        self.loops["hold"] = {f"k{k}": node for k, node in enumerate(replaced(known, lines))}

    def row(self, name: str) -> Node:
        """Return the node of a row."""
        return self.graph.input(f"@{name}", Level.POSE)

    def _loop(self, results: Mapping[str, FloatNode], width: int, dialect: Dialect) -> str:
        """Return the loop that writes rows from others."""
        nodes = lowered(expanded(list(map(self.graph.node, results.values()))))
        rows = {self.row(name): place for name, place in self.places.items()}
        written = [(self.places[name], node) for name, node in zip(results, nodes, strict=True)]
        return "\n    ".join(lane_loop(rows, written, width, dialect))

    def _rules(self, outputs: Sequence[Node]) -> dict[str, Mapping[str, FloatNode]]:
        """Return the rules as new values of rows; `outputs` are the nodes of a group's programs on its rows."""
        pick, count, row = self.graph.pick, self.count, self.row
        u, w, x, g, v, y = ([row(name) for name in row_names(letter, count)] for letter in "uwxgvy")
        on, (change, pivot, clear, size) = outputs[:count], outputs[count:]
        ahead, line, start = predicted(row("step"), row("limit"), [row("t"), row("before"), row("earlier")], [u, w, x], pick)
        moves = pick(row("going"), 0.5, 0.0, pick(row("going"), 1.5, 1.0, 0.0))
        place = {"ahead": ahead, "active": pick(row("goal"), row("t"), 0.0, moves)}
        place |= dict(zip(row_names("g", count), line, strict=True)) | dict(zip(row_names("v", count), start, strict=True))

        begin: dict[str, FloatNode] = {"settled": 1.0 - row("active"), "last": np.inf, "near": 0.0, "stuck": 0.0}

        finite = pick(largest_of([size_of(each) for each in v]), 1.0 / TINY, 1.0, 0.0)
        weak = pick(TINY, pivot, 0.0, finite)
        ended, near = newton_ended(change, row("last"), row("size"), pick)
        found = {"last": change, "near": near, "stuck": weak, "settled": pick(ended, weak, weak, ended)}
        found |= dict(zip(row_names("v", count), on, strict=True))
        iterate = {name: pick(row("settled"), 0.5, node, row(name)) for name, node in found.items()}

        clearance = {"now": clear, "extent": size, "stuck": row("active") * largest_of([row("stuck"), weak])}

        miss = largest_of([size_of(a - b) for a, b in zip(v, g, strict=True)])
        good, step = step_judged(row("ahead") - row("t"), row("sense"), row("largest"), row("near"), miss, row("now"), row("extent"), pick)
        acts = pick(row("stuck"), 0.5, row("active"), 0.0)
        good = pick(acts, 0.5, 0.0, good)
        news = {"t": row("ahead"), "sense": row("now"), "size": row("extent"), "before": row("t"), "earlier": row("before")}
        news |= dict(zip(row_names("u", count), v, strict=True)) | dict(zip(row_names("w", count), u, strict=True))
        news |= dict(zip(row_names("x", count), w, strict=True))
        land: dict[str, FloatNode] = {name: pick(good, 0.5, row(name), node) for name, node in news.items()}
        step = pick(acts, 0.5, row("step"), step)
        going = pick(acts, 0.5, row("going"), goes_on(land["t"], land["sense"], step, row("largest"), pick))
        land |= {"good": good, "step": step, "going": pick(row("stuck"), 0.5, going, STUCK)}

        ends = [row("sense"), row("sense1")], [row("size"), row("size1")]
        expected, bound = interpolated(row("ahead"), [row("before"), row("t"), row("right")], [w, u, y], *ends, pick)
        halfway = {f"{letter}{k}": node for letter in "gv" for k, node in enumerate(expected)} | {"bound": bound}
        close = {"good": pick(row("near"), 0.5, 0.0, pick(row("stuck"), 0.5, pick(miss, row("bound"), 1.0, 0.0), 0.0))}
        rules: dict[str, Mapping[str, FloatNode]] = {"place": place, "begin": begin, "iterate": iterate, "clearance": clearance}
        return rules | {"land": land, "between": halfway, "close": close}

    def text(self, width: int, dialect: Dialect, mark: str = "") -> str:
        """Return the functions `solve(s)` and `advance(s)`: Newton's method from a guess, and a step of all lanes that are on their way."""
        loop, row = {name: self._loop(results, width, dialect) for name, results in self.loops.items()}, self.places
        inner = {name: text.replace("\n", "\n    ") for name, text in loop.items()}
        return f"""
{mark}def solve(s):
    {loop["hold"]}
    {loop["begin"]}
    for iteration in range({ITERATIONS}):
        left = 0.0
        {inner["iterate"]}
            left += 1.0 - s[{row["settled"] * width} + b]
        if left == 0.0:
            break


{mark}def advance(s):
    active = 0.0
    {loop["place"]}
        active += s[{row["active"] * width} + b]
    if active == 0.0:
        return False
    solve(s)
    {loop["clearance"]}
    {loop["land"]}
    return True


{mark}def between(s):
    {loop["between"]}
    solve(s)
    {loop["close"]}
"""

    @cached_property
    def floats(self) -> Callable[[list[float]], bool]:
        """A step of one lane, in plain floats."""
        found: Callable[[list[float]], bool] = compiled(self.text(1, GUARDED), FLOATS)["advance"]
        return found

    @cached_property
    def compiled_text(self) -> str:
        """The module for Numba: `follow` and `fill`."""
        row, count = self.places, self.count
        names = {"W": WIDTH, "STATE": len(state_rows(count)), "PLACE": len(place_rows(count)), "GIVEN": len(self.inputs), "ROWS": len(row),
                 "PINS": count, "FIRST_PLACES": FIRST_PLACES, **{name.upper(): place for name, place in row.items()}}  # fmt: skip
        constants = "".join(f"{name} = {value}\n" for name, value in names.items())
        mark = '@njit(fastmath={"contract", "arcp", "nsz", "reassoc"}, error_model="numpy")\n'
        return f"{HEAD}{constants}{self.text(WIDTH, NUMBA, mark)}\n{DRIVERS}"

    @cached_property
    def follow(self) -> Callable[..., tuple[int, int]]:
        """The compiled continuation of lanes."""
        return compiled_loop(self.compiled_text, "follow", lambda t: (*(t.float64[:, ::1],) * 5, t.int64[::1], t.int64, t.boolean))

    @cached_property
    def fill(self) -> Callable[..., None]:
        """The compiled solution of poses between the places of lanes."""

        def arguments(t: Any) -> tuple[Any, ...]:
            whole, row, rows = t.int64[::1], t.float64[::1], t.float64[:, ::1]
            return whole, row, rows, rows, whole, rows, row, rows, row

        return compiled_loop(self.compiled_text, "fill", arguments)


DRIVERS = '''
def follow(a, b, state, ends, out, count, start, begins):
    """Follow lanes from `start` on to their ends; return the first lane that finds no room in `out`, and how many places are there.

    With `begins` the places where they stand are written too.
    """
    lanes, used = state.shape[1], 0
    s = np.zeros(ROWS * W)
    record = np.empty((FIRST_PLACES, (PLACE + 1) * W))
    for first in range(start, lanes, W):
        here = min(W, lanes - first)
        for c in range(W):
            lane = first + min(c, here - 1)
            for k in range(STATE):
                s[k * W + c] = state[k, lane]
            for k in range(GIVEN):
                s[(A0 + k) * W + c] = a[k, lane]
                s[(B0 + k) * W + c] = b[k, lane]
            s[GOAL * W + c], s[LIMIT * W + c], s[LARGEST * W + c] = ends[0, lane], ends[1, lane], ends[2, lane]
            if c >= here:
                s[GOING * W + c] = 0.0
        steps, total = 0, 0
        if begins:
            for c in range(W):
                s[GOOD * W + c] = 1.0
            record[0] = s[: (PLACE + 1) * W]
            steps, total = 1, here
        while advance(s):
            if steps == len(record):
                more = np.empty((2 * steps, (PLACE + 1) * W))
                more[:steps] = record
                record = more
            for k in range((PLACE + 1) * W):
                record[steps, k] = s[k]
            for c in range(here):
                total += 1 if s[GOOD * W + c] > 0.5 else 0
            steps += 1
        if used + total > out.shape[1]:
            return first, used
        for c in range(here):
            before = used
            for step in range(steps):
                if record[step, GOOD * W + c] > 0.5:
                    for k in range(PLACE):
                        out[k, used] = record[step, k * W + c]
                    used += 1
            count[first + c] = used - before
            for k in range(STATE):
                state[k, first + c] = s[k * W + c]
    return lanes, used


def fill(lane, place, a, b, first, places, ended, found, close):
    """Solve poses between the places of lanes; `close` is 1 where one is found that is near enough, -1 beyond a lane's end."""
    s = np.zeros(ROWS * W)
    total = len(place)
    for start in range(0, total, W):
        here = min(W, total - start)
        for c in range(W):
            pose = start + min(c, here - 1)
            line, at = lane[pose], place[pose]
            low, high = first[line], first[line + 1] - 1
            last = high
            while high - low > 1:
                middle = (low + high) // 2
                if places[0, middle] <= at:
                    low = middle
                else:
                    high = middle
            left, right, before = low, min(low + 1, last), max(low - 1, first[line])
            s[AHEAD * W + c] = at
            s[BEFORE * W + c], s[T * W + c], s[RIGHT * W + c] = places[0, before], places[0, left], places[0, right]
            s[SENSE * W + c], s[SENSE1 * W + c] = abs(places[1, left]), abs(places[1, right])
            s[SIZE * W + c], s[SIZE1 * W + c] = places[2, left], places[2, right]
            for k in range(PINS):
                s[(W0 + k) * W + c], s[(U0 + k) * W + c] = places[3 + k, before], places[3 + k, left]
                s[(Y0 + k) * W + c] = places[3 + k, right]
            for k in range(GIVEN):
                s[(A0 + k) * W + c] = a[k, line]
                s[(B0 + k) * W + c] = b[k, line]
            s[ACTIVE * W + c] = 1.0 if at <= ended[line] else 0.0
        between(s)
        for c in range(here):
            pose = start + c
            close[pose] = s[GOOD * W + c] if s[ACTIVE * W + c] > 0.5 else -1.0
            for k in range(PINS):
                found[k, pose] = s[(V0 + k) * W + c]
'''


CROSSING = 0.75
BLOCK = 16384
ROOM = 64
"""The places of a lane that memory is first made for."""
FEW = 4
"""So many lanes are followed one by one in plain floats: an array operation on a few numbers costs more than a step."""
RUNS, LEAST_LANES = 8, 1500
"""A step runs the group's program about so often; on arrays it costs as much as one of so many lanes, and what these cost."""


STEPS_KEPT = 1024
"""The places of steps of later groups of which the pins are kept."""


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

    def inputs_at(self, lane: Index, place: FloatArray) -> dict[str, Numbers]:
        """Return the inputs at places of lanes, arrays (n,) or floats."""
        lines = self.lines(lane).items()
        return {name: start if np.ndim(slope) == 0 and slope == 0.0 else start + place * slope for name, (start, slope) in lines}


class Lanes(NamedTuple):
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
    def goal_rows(self) -> FloatArray:
        """Each lane's goal, the place that no step leads beyond, and the largest step, shape (3, lanes)."""
        return np.array([self.goal, self.goal if self.exact else np.full(len(self.goal), np.inf), self.largest])


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
        return GroupPath(self.newton, self.route, before, self.lanes._replace(goal=np.maximum(goal, self.lanes.goal)), self)

    def _held(self, lane: Index, place: FloatArray) -> dict[str, Numbers]:
        """Return the inputs of this group's programs at places of lanes, the pins of the groups before it included."""
        inputs = self.route.inputs_at(lane, place)
        for track in self.before:  # each is told the pins of those before itself, which would else be found 2^k times
            known, key = track._at_steps, (lane.tobytes(), place.tobytes())
            pins = known[key] if key in known else track.pins_at(lane, place, inputs)
            if len(lane) <= FEW and key not in known:  # of few lanes they are kept, as other groups step there too
                if len(known) >= STEPS_KEPT:
                    known.clear()
                known[key] = pins
            inputs |= dict(zip(track.newton.names, pins, strict=True))
        return self.newton.fixed_inputs(inputs)

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
        return plan.made(("lanes", group.name), lambda twin: Program(twin, group)) if self._is_first else None

    def _compiled_program(self, steps: float) -> Program | None:
        """Return the program where so many steps are done by compiled loops."""
        asked, program = BACKEND.get(), self._program()
        if program is None or asked not in ("numba", None):
            return None
        ahead = program.spent + steps * program.work
        pays = asked == "numba" or pays_compiled(ahead, "follow" in vars(program), lambda: is_cached(program.compiled_text))
        return program if pays else None

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
        places, good, width = program.places, self._row["good"], len(self._row)
        ends = self.lanes.goal_rows
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
        state, ends = (np.take(each, lanes, axis=1) for each in (self._state, self.lanes.goal_rows))
        count = np.zeros(len(lanes), np.int64)
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
        state, (_, limit, largest) = (each if whole else np.take(each, k, axis=1) for each in (self._state, lanes.goal_rows))
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
        if (program := self._program()) is not None:  # a step that was done by operations on arrays
            program.spent += (len(k) + LEAST_LANES) * program.work

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

    def pins_at(self, lane: Index, place: FloatArray, inputs: Mapping[str, Numbers] | None = None) -> FloatArray:
        """Return the pins at places of lanes, shape (coordinates, n) [m]; NaN behind the end of a way.

        `inputs` are those of the program at these places with the pins of the groups before this one, where they are known.
        """
        program = self._compiled_program(len(lane))
        if program is not None:
            a, b = self._lines(program, np.arange(len(self.lanes.lane)))
            found, close = np.empty((len(self.u), len(lane))), np.empty(len(lane))
            program.fill(lane, np.ascontiguousarray(place), a, b, self.first, self.kept, self.ended, found, close)
            return self._between(lane, place, (found, close))
        if (made := self._program()) is not None:
            made.spent += (len(lane) + LEAST_LANES) * made.work
        parts = []
        for block in (slice(k, k + BLOCK) for k in range(0, len(lane), BLOCK)):
            held = self._held(lane[block], place[block]) if inputs is None else self.newton.fixed_inputs(at_poses(inputs, block))
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
        """Return the pins at places, from solutions near them."""
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
        """Return Newton's solutions at places, and 1 where one is as near as expected, -1 beyond the end of a way."""
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
