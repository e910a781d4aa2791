"""Free room on a sheet: what a mechanism covers, the side on which a ground symbol stands freely, and where fixed rails lie."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..program import FloatArray
from .scene import Bounds, Places, Scene
from .shapes import BLOCK, left_of, polar, segment

DOWN, LEFT, RIGHT, UP = -np.pi / 2, np.pi, 0.0, np.pi / 2
WORTH = {DOWN: 0.0, LEFT: 3.0, RIGHT: 3.0, UP: 6.0}
"""The directions a ground symbol may take [rad], and how many crowding points it costs to leave the first."""

ACROSS = (-2.7, -2.1, -1.5, -0.9, -0.3, 0.3, 0.9, 1.5, 2.1, 2.7)
SYMBOL = [(u, v) for u in (1.2, 1.8, 2.4, 3.0, 3.6, 4.2) for v in ACROSS if u > 3.0 or abs(v) < 0.7 * u]
"""Points that cover a ground symbol, along its direction and across, in sizes."""

BASE = 1.9
"""Half the base of a ground symbol's triangle, in sizes."""
HATCH = 0.9
"""The depth of the hatching of ground and rails, in sizes."""


def joined_box(boxes: Sequence[Bounds]) -> Bounds:
    """Return the box around several [m]."""
    left, right, bottom, top = np.array(boxes).T
    return float(left.min()), float(right.max()), float(bottom.min()), float(top.max())


def grown(box: Bounds, points: FloatArray, margin: float) -> Bounds:
    """Return a box that has room for points, shape (n, 2) [m], with a margin around them."""
    if not points.size:
        return box
    (x0, y0), (x1, y1) = points.min(axis=0) - margin, points.max(axis=0) + margin
    return joined_box([box, (x0, x1, y0, y1)])


def cloud(scene: Scene, at: Places) -> FloatArray:
    """Return points that cover the drawing at a pose, shape (m, 2) [m]: no label should be there."""
    pairs = [*((each.P, each.Q, each.half) for each in scene.two_force), *((P, X, 0.0) for P, X in scene.stays)]
    pairs += [(*track.ends, 1.2) for track in scene.tracks]
    corners = [plate.at(at) for plate in scene.plates]
    edges = [(P, Q) for each in corners if np.isfinite(each).all() for P, Q in zip(each, np.roll(each, -1, axis=0), strict=True)]
    lines = [(segment(P, Q, 0.8 * scene.size), 1.0) for P, Q in edges]
    lines += [(segment(at[P], at[Q], 0.8 * scene.size), half) for P, Q, half in pairs if np.isfinite([at[P], at[Q]]).all()]
    wide = []
    for line, half in lines:
        along = line[-1] - line[0]
        normal = left_of(along) / (np.hypot(*along) or 1.0)
        wide += [line + offset * half * scene.size * normal for offset in (-1.0, 0.0, 1.0)]
    there = [each for each in (*scene.accumulators, *scene.load_marks) if np.isfinite([at[name] for name in each.on]).all()]
    beside = [each.placed(each.corners, at) for each in there]
    points = [place[None] for place in at.values() if np.isfinite(place).all()]
    return np.concatenate([np.empty((0, 2)), *wide, *beside, *points])


def surrounding_points(scene: Scene, at: Places) -> FloatArray:
    """Return points along the lines of the surroundings at a pose, shape (n, 2) [m]."""
    found = [np.empty((0, 2))]
    for piece in scene.surroundings:
        if np.isfinite([at[name] for name in piece.on]).all():
            for line in piece.lines:
                corners = piece.placed(line.rows[:, 1:], at)
                ends = [*corners[1:], *corners[: int(line.closed)]]
                found += [segment(P, Q, 1.5 * scene.size) for P, Q in zip(corners, ends, strict=False) if not np.array_equal(P, Q)]
    return np.concatenate(found)


def props(scene: Scene) -> dict[str, float]:
    """Return the direction in which each ground symbol stands away from its pin [rad]: down where there is room."""
    shown = scene.some(7) or [scene.at(0)]
    covered = np.concatenate([cloud(scene, at) for at in shown])
    pins = {name: shown[0][name] for name in scene.grounds}
    ways: dict[str, float] = {}
    for name, pin in pins.items():
        others = [symbol(place, ways.get(other, DOWN), scene.size) for other, place in pins.items() if other != name]
        crowd = (np.concatenate([covered, *(np.tile(other, (len(shown), 1)) for other in others)]) - pin) / scene.size
        costs = {}
        for way, worth in WORTH.items():  # how many points lie where the symbol would stand
            along, across = crowd @ polar(way), crowd @ left_of(polar(way))
            inside = (along > 1.2) & (along < 4.6) & (np.abs(across) < 0.6 + 0.65 * along)
            costs[way] = float(np.count_nonzero(inside)) / len(shown) + worth
        ways[name] = min(costs, key=costs.__getitem__)
    return ways


def symbol(pin: FloatArray, way: float, size: float) -> FloatArray:
    """Return points that cover a ground symbol, shape (m, 2) [m]."""
    along, across = polar(way), left_of(polar(way))
    return np.array([pin + size * (u * along + v * across) for u, v in SYMBOL])


def label_free(scene: Scene, poses: Sequence[Places]) -> list[FloatArray]:
    """Return points that no label should cover at each pose, shape (m, 2) [m]; ground symbols count double, rails with their hatches."""
    symbols = [np.tile(symbol(scene.at(0)[name], way, scene.size), (2, 1)) for name, way in props(scene).items()]
    rails = [segment(start, end, 0.5 * scene.size) for lines in hatched(scene) for start, end in lines]
    return [np.concatenate([cloud(scene, at), *symbols, *rails]) for at in poses]


# Fixed rails, with their hatching.


def hatched(scene: Scene) -> list[FloatArray]:
    """Return for each piece of a fixed rail its line and then its hatches, shape (n, 2, 2) [m]; it leaves room for pins on its way."""
    if not scene.reached:
        return []
    at = scene.at(scene.reached[0])
    pins = [at[name] for name in scene.grounds]
    found = []
    for track in scene.tracks:
        if track.fixed:
            start, end = at[track.ends[0]], at[track.ends[1]]
            along = end - start  # the rail is below, or to the right; on the other side where all that rides hangs down there
            below = np.array([along[1], -along[0]]) / (np.hypot(*along) or 1.0)
            below = -below if below[1] > 1e-6 or (abs(below[1]) <= 1e-6 and below[0] < 0.0) else below
            carried = [(rider, name) for rider in track.riders for body in scene.bodies if rider in body for name in body if name != rider]
            hangs = [float((there[name] - there[rider]) @ below) > BLOCK * scene.size for there in scene.some(5) for rider, name in carried]
            found += rail(start, end, -below if hangs and all(hangs) else below, pins, scene.size)
    return found


def rail(start: FloatArray, end: FloatArray, below: FloatArray, pins: list[FloatArray], size: float) -> list[FloatArray]:
    """Return the pieces of a rail on a side of its track, each a line and its hatches; none where a pin's support stands in its way."""
    long = float(np.hypot(*(end - start)))
    along = (end - start) / (long or 1.0)
    base, hatch, room = start + BLOCK * size * below, HATCH * size, 1.6 * BASE * size
    stops = sorted(float((pin - start) @ along) for pin in pins if -size < (pin - start) @ below < 4.0 * size)
    stops = [stop for stop in stops if -room < stop < long + room]
    starts = [0.0, *(stop + room for stop in stops)]
    ends = [*(stop - room for stop in stops), long]
    found = []
    for first, last in zip(starts, ends, strict=True):
        if last - first > 2.0 * hatch:
            places = np.arange(first, last - hatch, 1.1 * hatch)
            line = (base + first * along, base + last * along)
            found.append(np.array([line, *((base + (s + hatch) * along, base + s * along + hatch * below) for s in places)]))
    return found
