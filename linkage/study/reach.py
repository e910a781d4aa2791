"""All that a point reaches, as parts of level lines that stand closer where their ends bend: its border and its area."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import TypeAlias

import numpy as np

from ..frozen import frozen
from ..motion.many_places import ManyPlaces, PlacePoses
from ..vectors import FloatArray, Index, Mask

Turn: TypeAlias = tuple[ManyPlaces, Index]
"""Poses with some strokes standing at values: what solves for the others, and the order of all strokes in it."""
Poses: TypeAlias = Callable[[FloatArray, FloatArray, Mask | None], tuple[PlacePoses, Index]]
"""The poses that are found for places x by y, or some of these, and the number of the turn that gave each."""
ACROSS, PANELS, LEVELS = 121, 24, 7
"""Places of a line that are looked at, panels of lines at first, and how often one is halved."""
CLOSE = 5e-6
"""The share of the area that a panel may be wrong by."""
ROUNDS, PARTS, NARROWED, AT_END = 4, 8, 6, 1e-5
"""How often a line is followed on with other strokes at their ends, how often the part of its way with its end is divided into so many, and
what counts as an end."""


Spans: TypeAlias = list[tuple[float, float]]


def simpson(panel: tuple[float, float, float], known: dict[float, Spans]) -> tuple[float, float]:
    """Return the area of a panel of three lines, and about how wrong it may be [m2]."""
    low, mid, high = (sum(right - left for left, right in known[height]) for height in panel)
    tall = panel[2] - panel[0]
    return tall * (low + 4.0 * mid + high) / 6.0, tall * abs(low - 2.0 * mid + high) / 6.0


class Reach:
    """The reach of a point: heights of level lines, ascending, and the parts of each that are reached, (line, left, right) [m]."""

    def __init__(self, turns: Sequence[Turn], rest: FloatArray, poses: Poses) -> None:
        self.turns, self.rest, self.poses = turns, rest, poses
        self.many = turns[0][0]
        seen = self.many.looked_at().values[:2]
        seen = seen[:, np.isfinite(seen).all(axis=0)]
        (left, low), (right, high) = seen.min(axis=1), seen.max(axis=1)
        aside, above = 0.02 * max(right - left, 1e-6), 0.02 * max(high - low, 1e-6)
        self.across = np.linspace(left - aside, right + aside, ACROSS)
        self.is_single, area = not self.many.spare, 0.0
        heights: FloatArray = np.linspace(low - above, high + above, 2 * PANELS + 1)
        known = dict(zip(heights.tolist(), self.reached(heights), strict=True))
        panels = [(heights[k], heights[k + 1], heights[k + 2]) for k in range(0, 2 * PANELS, 2)]
        for level in range(LEVELS + 1):
            size = max(area + sum(simpson(panel, known)[0] for panel in panels), 1e-12)
            rough = [panel for panel in panels if level < LEVELS and simpson(panel, known)[1] > CLOSE * size]
            area += sum(simpson(panel, known)[0] for panel in panels if panel not in rough)
            halves = [half for low, mid, high in rough for half in ((low, 0.5 * (low + mid), mid), (mid, 0.5 * (mid + high), high))]
            new = np.array([mid for _, mid, _ in halves])
            if len(new):
                known |= zip(new.tolist(), self.reached(new), strict=True)
            panels = halves
        self.heights, self.area = frozen(sorted(known)), float(area)
        self.spans = tuple((k, left, right) for k, height in enumerate(sorted(known)) for left, right in known[height])

    @property
    def border(self) -> FloatArray:
        """The border in straight pieces, shape (n, 2, 2) [m]: of two neighbouring lines the parts that only one of them has within."""
        ends: list[list[tuple[float, int]]] = [[] for _ in self.heights]
        for line, left, right in self.spans:
            ends[line] += [(left, line), (right, line)]
        joined = [sorted(one + other) for one, other in pairwise(ends)]
        pieces = [pair for row in joined for pair in zip(row[::2], row[1::2], strict=True)]
        found = [[(across, self.heights[line]) for across, line in pair] for pair in pieces]
        return frozen(found).reshape(-1, 2, 2)

    def reached(self, heights: FloatArray) -> list[Spans]:
        """Return the parts of lines at some heights that are reached (left, right) [m]."""
        up, count = np.sort(heights), self.across.size
        inside = np.zeros(count * up.size, bool)
        if self.many.spare:  # places that are reached from three of their starts
            start = self.many.looked_at().starts(self.across, up, self.rest)
            order, many = np.argsort(start.place, kind="stable"), np.bincount(start.place, minlength=inside.size)
            first, known = np.cumsum(many) - many, many > 0
            start = start.select(np.unique([order[(first + many * part // 4)[known]] for part in (1, 2, 3)]))
            at = np.arange(inside.size)
            goals = np.column_stack([self.across[at % count], up[at // count], np.tile(self.rest, (len(at), 1))])
            near, met = self.many.settled(start, goals, np.zeros(start.unit.shape[1]), damped=False)
            near = near.select(met)
            inside = np.isin(at, near.place[self.many.places.is_assembled(near.unit)])
        out = np.pad(~inside.reshape(up.size, count), ((0, 0), (1, 1)))
        poses, turn = self.poses(self.across, up, (out[:, :-2] | out[:, 1:-1] | out[:, 2:]).ravel())  # of what may be at a border
        whole = self.many.places.is_assembled(poses.unit) if len(poses.place) else np.zeros(0, bool)
        poses, turn = poses.select(whole), turn[whole]
        inside[poses.place] = True
        if self.is_single:
            each = np.unique(np.round(np.column_stack([poses.place, poses.unit]), 6), axis=0)
            self.is_single = len(np.unique(each[:, 0])) == len(each)
        grid = inside.reshape(up.size, count)
        line, place = np.nonzero(grid[:, 1:] != grid[:, :-1])
        grows = grid[line, place + 1]
        good, bad = self.across[place + grows], self.across[place + ~grows]
        edge, row = [], []
        for way in (True, False):  # a place may be the last one at either end of a part
            at = np.full(inside.size, -1)
            at[(line * count + place + grows)[grows == way]] = np.flatnonzero(grows == way)
            row.append(np.flatnonzero(at[poses.place] >= 0))
            edge.append(at[poses.place[row[-1]]])
        rows = np.concatenate(row)
        good = self.ends(up[line], good, bad, PlacePoses(np.concatenate(edge), poses.unit[rows]), turn[rows])
        found: list[list[float]] = [[] for _ in up]
        for k, end in zip(line.tolist(), good.tolist(), strict=True):
            found[k].append(end)
        spans = [list(zip(row[::2], row[1::2], strict=False)) for row in found]
        return [spans[k] for k in np.searchsorted(up, heights)]

    def ends(self, height: FloatArray, good: FloatArray, bad: FloatArray, start: PlacePoses, turn: Index) -> FloatArray:
        """Return how far lines are reached from `good` towards `bad` (m,) [m]; it begins at poses of the good places.

        At the border of all that is reached, strokes are at their ends. From where a way ends it goes on with those strokes instead of the
        spare ones. It begins with such poses if there are some.
        """
        reached = good
        fits = self.standing(start.unit)[turn, np.arange(len(turn))]
        chosen = fits | ~np.isin(start.place, start.place[fits])
        start, turn = start.select(chosen), turn[chosen]
        for _ in range(ROUNDS):
            if not len(start.place):
                break
            far, unit = self.followed(height, reached, bad, start, turn)
            gone = np.abs(far - good[start.place])
            order = np.lexsort((gone, start.place))
            best = order[np.append(np.diff(start.place[order]) > 0, True)]
            edge = start.place[best]
            on = np.abs(far[best] - reached[edge]) > 1e-9 * np.abs(bad - good)[edge]
            reached = reached.copy()
            reached[edge] = far[best]
            edge, base = edge[on], unit[best][on]
            turn, row = np.nonzero(self.standing(base) & (self.many.spare > 0))
            start = PlacePoses(edge[row], base[row])
        return reached

    def standing(self, unit: FloatArray) -> Mask:
        """Return whether the spare strokes of each turn stand at their ends in poses (r, k), shape (turns, r)."""
        at_end = np.minimum(unit, 1.0 - unit) < AT_END
        return np.array([at_end[:, order[many.solved :]].all(axis=1) for many, order in self.turns])

    def followed(
        self, height: FloatArray, good: FloatArray, bad: FloatArray, start: PlacePoses, turn: Index
    ) -> tuple[FloatArray, FloatArray]:
        """Return how far each pose gets on its line with the spare strokes of its turn standing (r,) [m], and the poses there (r, k)."""
        near, far, outs = good[start.place], bad[start.place], np.zeros(start.unit.shape[1])
        order = np.array([each for _, each in self.turns])[turn]
        base, unit = np.take_along_axis(start.unit, order, axis=1), np.empty_like(start.unit)
        rows, parts = np.arange(len(near)), np.arange(1, PARTS)[:, None] / PARTS
        orders = np.tile(order, (PARTS - 1, 1)) if len(self.turns) > 1 else None
        for _ in range(NARROWED):
            places = np.concatenate([near[None], near + parts * (far - near), far[None]])
            middle = places[1:-1].ravel()
            goals = np.column_stack([middle, np.tile(height[start.place], PARTS - 1), np.tile(self.rest, (len(middle), 1))])
            at = PlacePoses(np.arange(len(middle)), np.tile(base, (PARTS - 1, 1)))
            found, met = self.many.settled(at, goals, outs, damped=False, order=orders)
            met = np.logical_and.accumulate(met.reshape(PARTS - 1, len(near)))
            got = met.sum(axis=0)
            base = np.concatenate([base[None], found.unit.reshape(PARTS - 1, *base.shape)])[got, rows]
            near, far = places[got, rows], places[got + 1, rows]
        np.put_along_axis(unit, order, base, axis=1)
        return near, unit
