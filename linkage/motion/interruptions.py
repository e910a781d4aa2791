"""The way between poses along one stroke: where a loop comes to its dead point there, and where it cannot be assembled.

Every loop tells how far it is from its dead point: the squared sine of the angle between its links, which is negative where they do not
reach, or the sine of the angle between its guides. It is a function of the stroke, on a grid of its own that does not depend on the poses.
An interval is dismissed if the lower of its ends is above twice what the function bends there. Else it is divided by eight, down to 1e-9 of
the way.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, final

import numpy as np

from ..numeric.line import last_holding
from ..plan import Loop, Mask, Plan
from ..program import FloatArray, Kernel, Level, RunOptions
from ..vectors import Numbers
from .grid import Grid
from .limits import stroke_number, stroke_text, stroke_unit

GRID = 128
"""Intervals of the grid; an angle has so many for each turn of it."""
PARTS = 8
DEPTH = 1e-9
"""The width, of the way, down to which it is divided."""
BENDS = 2.0
TOUCH = 1e-6
"""A sine of links that comes so low has come to zero: a clearance of 1e-12 of their lengths is not told from none."""
END = 1e-7
"""A dead point so near to an end of the way, compared with the way, is its end and not passed."""
ROUNDING = 8 * np.finfo(float).eps
MOST = 4096

ON_ARRAYS = RunOptions("numpy")
INNER = np.arange(1, PARTS) / PARTS


@final
@dataclass(frozen=True)
class Interruption:
    """What interrupts the way along a stroke: from `low` to `high` [m or rad] a step cannot be assembled; equal at a change point."""

    stroke: str
    unit: str
    step: str
    low: float
    high: float
    deepest: float
    """Where it is farthest from being assembled, or in line."""
    kind: str = "links"

    @property
    def is_gap(self) -> bool:
        """Whether a stretch of the way is out of reach; else two branches meet in a point of it, or guides are parallel."""
        return self.high > self.low

    def __str__(self) -> str:
        if self.is_gap:
            span = f"{stroke_number(self.low, self.unit)} to {stroke_text(self.high, self.unit)}"
            return f"{self.step} out of reach from {self.stroke} = {span}"
        what = {"guides": "parallel guides", "meeting": "no direction"}.get(self.kind, "a change point")
        return f"{what} of {self.step} at {self.stroke} = {stroke_text(self.low, self.unit)}"


@final
@dataclass(frozen=True)
class Clearances:
    """The loops of a plan that move, and the kernels of how clear of their dead points they are, and of the size of rounding there."""

    loops: tuple[Loop, ...]
    kernel: Kernel
    rounding: Kernel

    @property
    def is_signed(self) -> Mask:
        """Of which loops, shape (loops, 1), the sign says on which side they are assembled: of guides, and of points that meet."""
        return np.array([loop.kind in ("guides", "meeting") for loop in self.loops])[:, None]

    @classmethod
    def of(cls, plan: Plan) -> Clearances:
        """Return those of a plan; pins of groups are followed on their own."""
        trace = plan.trace
        moving = dict.fromkeys(loop for loop in trace.loops if loop.terms[0].level is Level.POSE)
        grouped = {pin for group in plan.groups.values() for pin in group.pins}
        own = [loop for loop in moving if loop.step not in grouped]
        # a root's scale that is a root itself is the distance of two points, along which a slot's line is taken; it may vanish
        sides = [Loop(loop.step, "meeting", loop.terms[1:2]) for loop in own if loop.kind == "links" and loop.terms[1].op == "sqrt"]
        own += [loop for loop in sides if loop.terms[0].level is Level.POSE]
        clear = [loop.terms[0] / (loop.terms[1] * loop.terms[1]) if loop.kind == "links" else loop.terms[0] for loop in own]
        size = [loop.terms[2] / (loop.terms[1] * loop.terms[1]) if loop.kind == "links" else trace.graph.constant(1.0) for loop in own]
        return cls(tuple(own), Kernel(clear), Kernel(size))


@final
class StrokeClearance:
    """One design along one stroke, the others held: `seen(x)` are the clearances at values of the stroke, shape (loops, n)."""

    def __init__(self, plan: Plan, designs: Mapping[str, Numbers], name: str, held: Mapping[str, float]) -> None:
        self.plan, self.designs, self.name, self.held = plan, designs, name, held
        self.clearances = plan.made("clearances", Clearances.of)
        self.loops, self.unit = self.clearances.loops, stroke_unit(plan, name)

    def inputs(self, x: FloatArray) -> dict[str, Any]:
        """Return the inputs of the program at values of the stroke."""
        if not self.plan.solved:
            return {**self.designs, **self.held, self.name: x}
        strokes = {name: x if name == self.name else np.full(x.shape, self.held[name]) for name in self.plan.strokes}
        return Grid(self.plan, {name: self.designs[name] for name in self.plan.defaults}, strokes).flat

    def seen(self, x: FloatArray) -> FloatArray:
        """Return the clearance of every loop, shape (loops, n): squared sines of links, sines of guides without a sign, lengths [m]."""
        found = self.clearances.kernel(self.inputs(x), way=ON_ARRAYS, size=(1, x.size)).values[:, 0]
        return np.where(self.clearances.is_signed, np.abs(found), found)

    def rounding(self, x: FloatArray) -> FloatArray:
        """Return by how much rounding moves every loop's clearance at the most along the values, shape (loops, 1)."""
        sizes = self.clearances.rounding(self.inputs(x), way=ON_ARRAYS, size=(1, x.size)).values[:, 0]
        return np.asarray(ROUNDING * np.fmax.reduce(np.abs(sizes), axis=1, initial=1.0)[:, None])

    # -- the search --------------------------------------------------------------------------------------

    def grid(self, low: float, high: float) -> FloatArray:
        """Return the values at which a way is looked at first."""
        turns = (high - low) / (2.0 * np.pi) if self.name in self.plan.turning else 1.0
        return np.asarray(low + (high - low) * np.linspace(0.0, 1.0, GRID * max(1, int(np.ceil(turns))) + 1))

    def interruptions(self, low: float, high: float) -> tuple[Interruption, ...]:
        """Return what interrupts the way between two values of the stroke, in their order."""
        if not (self.loops and high > low):
            return ()
        x = self.grid(low, high)
        seen = self.seen(x)
        with np.errstate(invalid="ignore"):
            bends = np.abs(seen[:, 2:] - 2.0 * seen[:, 1:-1] + seen[:, :-2])
        if seen.min() > BENDS * bends.max() + TOUCH or np.all(seen.min(axis=1) > BENDS * bends.max(axis=1) + TOUCH):
            return ()
        return self._narrowed(x, seen, bends)

    def _narrowed(self, x: FloatArray, seen: FloatArray, bends: FloatArray) -> tuple[Interruption, ...]:
        """Return what interrupts the way, from the grid on."""
        noise = self.rounding(x)
        tops = np.fmax.reduce(seen, axis=1)
        tells = np.array([loop.kind != "length" for loop in self.loops])
        level = np.where([[loop.kind == "links"] for loop in self.loops], TOUCH**2, 2.0 * DEPTH * tops[:, None])
        level = np.where(tells[:, None], np.maximum(level, noise), 0.0)
        still = tops <= 4.0 * level[:, 0]
        if still.any():  # in line all the way, as a rod that is straight; or the way is so short
            stroke = self.plan.strokes[self.name]
            wide = self.seen(self.grid(min(stroke.start, stroke.end), max(stroke.start, stroke.end)))
            still &= ~(np.fmax.reduce(wide, axis=1) > 4.0 * level[:, 0])
        places, values = divided(self.seen, x, seen, bends, noise, ~still)
        found: list[Interruption] = []
        for row in np.flatnonzero(~still).tolist():
            found += self._of_loop(row, places, values[row], float(level[row, 0]), float(noise[row, 0]))
        return tuple(sorted(found, key=lambda each: each.low))

    def _of_loop(self, row: int, x: FloatArray, seen: FloatArray, level: float, noise: float) -> list[Interruption]:
        """Return where one loop interrupts the way: runs of values that have come to zero."""
        found, loop = [], self.loops[row]
        low_end, high_end, known = x[0], x[-1], np.isfinite(seen)  # the ends of the way: where the loop has values it may begin within
        x, seen = x[known], seen[known]
        edges = np.flatnonzero(np.diff(np.concatenate([[False], seen <= level, [False]]).astype(int)))
        for first, last in zip(edges[::2], edges[1::2] - 1, strict=True):
            run = slice(first, last + 1)
            deepest = float(x[run][seen[run] <= seen[run].min() + noise].mean())
            if seen[run].min() < -noise:
                under = first + np.flatnonzero(seen[run] < -noise)
                low = self._border(row, x, int(under[0]), -1, noise)
                high = self._border(row, x, int(under[-1]), 1, noise)
                found.append(Interruption(self.name, self.unit, loop.step, low, high, deepest, loop.kind))
            elif loop.kind != "length" and min(deepest - low_end, high_end - deepest) > END * (high_end - low_end):
                found.append(Interruption(self.name, self.unit, loop.step, deepest, deepest, deepest, loop.kind))
        return found

    def _border(self, row: int, x: FloatArray, place: int, side: int, noise: float) -> float:
        """Return the end of a stretch that is out of reach, on one side of a value in it."""
        def is_under(at: FloatArray) -> Mask:
            return np.asarray(self.seen(at)[row] < -noise)

        return float(last_holding(is_under, x[place], x[min(max(place + side, 0), len(x) - 1)])[1])


def divided(
    look: Callable[[FloatArray], FloatArray], x: FloatArray, seen: FloatArray, bends: FloatArray, noise: FloatArray, rows: Mask
) -> tuple[FloatArray, FloatArray]:
    """Return all values looked at, in order, and what was seen there, shape (loops, n): intervals divided where a loop may reach zero."""
    wide = np.pad(np.where(np.isfinite(bends), bends, 0.0), ((0, 0), (2, 2)), mode="edge")
    bend = np.maximum.reduce([wide[:, k : k + x.size - 1] for k in range(4)])
    left, right, first, last = x[:-1], x[1:], seen[:, :-1], seen[:, 1:]
    places, values = [x], [seen]
    least = DEPTH * float(x[-1] - x[0])
    while left.size:
        lower = np.minimum(first, last)
        low = (lower <= BENDS * bend + noise) & (np.maximum(first, last) >= -noise) & rows[:, None]
        pick = np.flatnonzero(low.any(axis=0) & (right - left > least))[:MOST]
        if not pick.size:
            break
        left, right, first, last = left[pick], right[pick], first[:, pick], last[:, pick]
        inner = left[:, None] + (right - left)[:, None] * INNER
        found = look(inner.ravel()).reshape(len(seen), *inner.shape)
        places.append(inner.ravel())
        values.append(found.reshape(len(seen), -1))
        f = np.concatenate([first[..., None], found, last[..., None]], axis=2)
        at = np.concatenate([left[:, None], inner, right[:, None]], axis=1)
        with np.errstate(invalid="ignore"):
            curved = np.abs(f[..., 2:] - 2.0 * f[..., 1:-1] + f[..., :-2])
        bend = np.repeat(np.fmax.reduce(curved, axis=2, initial=0.0), PARTS, axis=1)
        left, right = at[:, :-1].ravel(), at[:, 1:].ravel()
        first, last = f[..., :-1].reshape(len(seen), -1), f[..., 1:].reshape(len(seen), -1)
    at = np.concatenate(places)
    order = np.argsort(at, kind="stable")
    return at[order], np.concatenate(values, axis=1)[:, order]
