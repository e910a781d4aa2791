"""A group's continuation written out as loops over lanes side by side: in plain floats for a few, compiled by Numba for many.

Every rule is traced from the function of `rules` that is used on arrays, so that all say the same. What is known of a lane lies in rows
of one memory: its state, what it is to do, and what is worked out on the way. A lane whose pivots become too small is *stuck*: it is left
as it was before the step, for pivots of its own.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, final

import numpy as np

from ..plan import Plan
from ..program import FLOATS, GUARDED, Dialect, ancestors, compiled, compiled_loop, expanded, lowered, pays_compiled, replaced
from ..program.loop import HEAD, NUMBA, lane_loop
from ..program.node import Graph, Level, Node
from ..steps import Group
from .newton import ITERATIONS, Programs, largest_of, size_of
from .rules import TINY, goes_on, interpolated, newton_ended, predicted, step_judged

WIDTH = 16
"""How many lanes go side by side where they are compiled: some vectors of them."""
FIRST_PLACES = 64
FloatNode = Node | float

STUCK = 2.0
"""In the row `going`: 1 where a lane is on its way, 0 where it has ended."""


def state_rows(count: int) -> list[str]:
    """Return what is remembered of a lane with so many coordinates, row by row; the first rows are kept of every place."""
    return [*place_rows(count), "good", "before", "earlier", "step", "going", *row_names("w", count), *row_names("x", count)]


def place_rows(count: int) -> list[str]:
    """Return what is kept of a place: where it is, the clearance with its sign, the size and the pins [m]."""
    return ["t", "sense", "size", *row_names("u", count)]


def row_names(letter: str, count: int) -> list[str]:
    """Return names of a letter and a number."""
    return [f"{letter}{k}" for k in range(count)]


@final
@dataclass(frozen=True, eq=False)
class Memory:
    """The rows of the lanes' memory by name, and a node for each."""

    graph: Graph
    places: dict[str, int]

    def __getitem__(self, name: str) -> Node:
        return self.graph.input(f"@{name}", Level.POSE)

    def loop(self, results: Mapping[str, FloatNode], width: int, dialect: Dialect) -> list[str]:
        """Return the loop that writes rows from others."""
        nodes = lowered(expanded(list(map(self.graph.node, results.values()))))
        rows = {self[name]: place for name, place in self.places.items()}
        return lane_loop(rows, [(self.places[name], node) for name, node in zip(results, nodes, strict=True)], width, dialect)


@final
@dataclass(frozen=True, eq=False)
class Program:
    """The loops of a group's continuation: the rows they read and write, and what each row becomes."""

    inputs: tuple[str, ...]
    count: int
    memory: Memory
    loops: Mapping[str, Mapping[str, FloatNode]]
    work: int
    """About how many operations a step is."""
    spent: list[float] = field(default_factory=lambda: [0.0])

    @classmethod
    def of(cls, plan: Plan, group: Group) -> Program:
        """Return the program of a group of a plan."""
        programs, graph = Programs.of(plan, group), plan.trace.graph
        pins = [graph.input(name, Level.POSE) for name in group.inputs[:-1]]
        known = programs.known
        given = [node for node in ancestors(known) if node.op == "input"]
        rows = [*state_rows(len(pins)), "goal", "limit", "largest", "ahead", "active", "last", "near", "settled", "stuck", "now", "extent"]
        rows += [name for letter in "gvy" for name in row_names(letter, len(pins))]
        rows += [name for letter, nodes in (("a", given), ("b", given), ("k", known)) for name in row_names(letter, len(nodes))]
        memory = Memory(graph, {name: k for k, name in enumerate([*rows, "right", "sense1", "size1", "bound"])})
        on = replaced(programs.nodes, {pin: memory[f"v{k}"] for k, pin in enumerate(pins)})
        lines = {node: memory[f"a{k}"] + memory["ahead"] * memory[f"b{k}"] for k, node in enumerate(given)}
        loops = rules_of(memory, len(pins), on)
        loops["hold"] = {f"k{k}": node for k, node in enumerate(replaced(known, lines))}
        return cls(tuple(node.value for node in given), len(pins), memory, loops, 3 * len(programs.step.plan.pose))

    def text(self, width: int, dialect: Dialect, mark: str = "") -> str:
        """Return the functions `solve(s)` and `advance(s)`: Newton's method from a guess, and a step of all lanes that are on their way."""
        loop = {name: "\n    ".join(self.memory.loop(results, width, dialect)) for name, results in self.loops.items()}
        inner = {name: text.replace("\n", "\n    ") for name, text in loop.items()}
        row = self.memory.places
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
        row, count = self.memory.places, self.count
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

    def is_compiled(self, lanes: float) -> bool:
        """Return whether so many steps, and those before them, are done by compiled loops."""
        done = self.spent[0]
        self.spent[0] += lanes * self.work
        return pays_compiled(done + lanes * self.work, "follow" in vars(self), lambda: self.compiled_text)


def rules_of(memory: Memory, count: int, outputs: Sequence[Node]) -> dict[str, Mapping[str, FloatNode]]:
    """Return the rules as what rows become; `outputs` are the nodes of a group's programs on its rows."""
    pick, row = memory.graph.pick, memory
    u, w, x, g, v, y = ([memory[name] for name in row_names(letter, count)] for letter in "uwxgvy")
    on, (change, pivot, clear, size) = outputs[:count], outputs[count:]
    ahead, line, start = predicted(row["step"], row["limit"], [row["t"], row["before"], row["earlier"]], [u, w, x], pick)
    moves = pick(row["going"], 0.5, 0.0, pick(row["going"], 1.5, 1.0, 0.0))
    place = {"ahead": ahead, "active": pick(row["goal"], row["t"], 0.0, moves)}
    place |= dict(zip(row_names("g", count), line, strict=True)) | dict(zip(row_names("v", count), start, strict=True))

    begin: dict[str, FloatNode] = {"settled": 1.0 - row["active"], "last": np.inf, "near": 0.0, "stuck": 0.0}

    finite = pick(largest_of([size_of(each) for each in v]), 1.0 / TINY, 1.0, 0.0)
    weak = pick(TINY, pivot, 0.0, finite)
    ended, near = newton_ended(change, row["last"], row["size"], pick)
    found = {"last": change, "near": near, "stuck": weak, "settled": pick(ended, weak, weak, ended)}
    found |= dict(zip(row_names("v", count), on, strict=True))
    iterate = {name: pick(row["settled"], 0.5, node, row[name]) for name, node in found.items()}

    clearance = {"now": clear, "extent": size, "stuck": row["active"] * largest_of([row["stuck"], weak])}

    miss = largest_of([size_of(a - b) for a, b in zip(v, g, strict=True)])
    good, step = step_judged(row["ahead"] - row["t"], row["sense"], row["largest"], row["near"], miss, row["now"], row["extent"], pick)
    acts = pick(row["stuck"], 0.5, row["active"], 0.0)
    good = pick(acts, 0.5, 0.0, good)
    news = {"t": row["ahead"], "sense": row["now"], "size": row["extent"], "before": row["t"], "earlier": row["before"]}
    news |= dict(zip(row_names("u", count), v, strict=True)) | dict(zip(row_names("w", count), u, strict=True))
    news |= dict(zip(row_names("x", count), w, strict=True))
    land: dict[str, FloatNode] = {name: pick(good, 0.5, row[name], node) for name, node in news.items()}
    step = pick(acts, 0.5, row["step"], step)
    going = pick(acts, 0.5, row["going"], goes_on(land["t"], land["sense"], step, row["largest"], pick))
    land |= {"good": good, "step": step, "going": pick(row["stuck"], 0.5, going, STUCK)}

    ends = [row["sense"], row["sense1"]], [row["size"], row["size1"]]
    expected, bound = interpolated(row["ahead"], [row["before"], row["t"], row["right"]], [w, u, y], *ends, pick)
    halfway = {f"{letter}{k}": node for letter in "gv" for k, node in enumerate(expected)} | {"bound": bound}
    close = {"good": pick(row["near"], 0.5, 0.0, pick(row["stuck"], 0.5, pick(miss, row["bound"], 1.0, 0.0), 0.0))}
    return {"place": place, "begin": begin, "iterate": iterate, "clearance": clearance, "land": land, "between": halfway, "close": close}


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
