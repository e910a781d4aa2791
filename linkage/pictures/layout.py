"""Free room on a sheet: what a mechanism covers, sides for ground symbols, where rails lie; and points' names that cover none of it."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from types import MappingProxyType

import numpy as np

from ..plan import Mask
from ..program import FloatArray
from . import style
from .scene import Bounds, Places, Scene
from .shapes import BLOCK, left_of, lines_cross, polar, segment

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


REACH = (1.0, 1.4, 2.0, 2.8, 4.0, 5.5, 7.5)
WAYS = polar(np.radians(np.arange(60.0, 420.0, 15.0)))
"""The places a label tries: distances, as multiples of the nearest, and directions, the preferred one first."""

LED = 1.9
"""A label that begins farther from its point than so many times the nearest distance is joined to it by a thin line."""
TOGETHER = 0.7
"""Points nearer to each other than so many times the nearest distance of a label stand on one pin."""
OVERLAP, STRAY, CROSSED = 400.0, 150.0, 60.0
"""What it costs to cover another label, to stand nearer to another point than to the own one, and to cross the line that joins another
label to its point, in covered points."""
NO_EDGE: Bounds = (-np.inf, np.inf, -np.inf, np.inf)
"""A sheet without edges."""
ROUNDS = 4
MINOR = 0.75
"""The size of the letters of a point of a construction, as a share of the others'."""


def offsets(
    names: Sequence[str],
    poses: Sequence[Places],
    clouds: Sequence[FloatArray],
    scale: float,
    gap: float,
    font: float = style.LABEL,
    minor: Collection[str] = (),
    letters: Mapping[str, str] = MappingProxyType({}),
    sheet: Bounds = NO_EDGE,
) -> dict[str, FloatArray]:
    """Return where each name stands, from its point, shape (2,) each, in the unit of `font`.

    One offset serves all `poses`; with several it stays short, so that each name keeps to its pin. `clouds` are the points to keep clear at
    each [m]. `scale` is that unit per metre. `gap` is the distance from the point's centre at which a label may begin. The names in `minor`
    are smaller, those in `letters` are written so. None hangs over the edge of the `sheet` [m] where another place is free. Crowded points
    choose first. Then each chooses again, some rounds long, as the others stand.
    """
    far = max(gap, 0.9 * font) if len(poses) > 1 else np.inf
    taken = [cloud * scale for cloud in clouds]
    anchors = {name: np.array([at[name] for at in poses]).reshape(-1, 2) * scale for name in names}
    halves = {name: half_of(letters.get(name, name), font * (MINOR if name in minor else 1.0)) for name in names}
    tried = {name: candidates(halves[name], gap, far) for name in names}
    if not poses:  # nothing stands anywhere
        return {name: places[0] for name, places in tried.items()}
    edges = np.array(sheet) * scale
    alone = {name: own_costs(name, tried[name], halves[name], anchors, taken, gap, edges) for name in names}
    spots: dict[str, FloatArray] = {}
    order = sorted(names, key=lambda each: -float(np.median(alone[each])))
    for _ in range(ROUNDS):
        before = dict(spots)
        for name in order:
            others = [other for other in spots if other != name]
            costs = alone[name]
            for other in others:  # at which share of the poses each place covers another label
                between = (anchors[name] - anchors[other])[:, None] + tried[name] - spots[other]
                costs = costs + OVERLAP * is_inside(between, halves[name] + halves[other] + 0.5).mean(axis=0)
                if distance_to_box(spots[other], halves[other]) > LED * gap:
                    led = distance_to_box(tried[name], halves[name]) > LED * gap
                    lines = (leaders(anchors[each], spot, halves[each]) for each, spot in ((name, tried[name]), (other, spots[other])))
                    costs = costs + CROSSED * (led & lines_cross(*lines)).mean(axis=0)
            spots[name] = tried[name][int(np.argmin(costs))]
        if before and all(np.array_equal(before[name], spots[name]) for name in names):
            break
    return spots


def half_of(name: str, font: float) -> FloatArray:
    """Return half the width and height of a label, in the unit of its font."""
    return 0.5 * font * np.array([0.68 * len(name) + 0.15, 0.95])


def candidates(half: FloatArray, gap: float, far: float = np.inf) -> FloatArray:
    """Return the offsets a label of half that width and height tries, shape (c, 2), the preferred first, none beginning beyond `far`."""
    reaches = np.array([reach * gap for reach in REACH if reach * gap <= far])
    return np.asarray(reaches[:, None, None] * WAYS + half * np.clip(np.sqrt(2.0) * WAYS, -1.0, 1.0)).reshape(-1, 2)


def own_costs(
    name: str,
    spots: FloatArray,
    half: FloatArray,
    anchors: Mapping[str, FloatArray],
    taken: Sequence[FloatArray],
    gap: float,
    edges: FloatArray,
) -> FloatArray:
    """Return the own costs of a label's places, shape (c,).

    That is what it covers, a pose, the other pins that it is nearer to, and that it hangs over the edges of the sheet.
    """
    poses, away = max(len(taken), 1), distance_to_box(spots, half)
    costs = 0.02 * np.arange(len(spots)) + 1.2 * np.maximum(away / gap - LED, 0.0)
    for pose, points in enumerate(taken):
        own = anchors[name][pose]
        if not np.isfinite(own).all():
            continue
        near = (points[is_inside(points - own, np.abs(spots).max() + half.max() + 2.0)] - own).T
        across, above = (np.abs(places - spots[:, [axis]]) < half[axis] + 1.0 for axis, places in enumerate(near))
        costs = costs + np.count_nonzero(across & above, axis=1) / poses
        for other, places in anchors.items():
            place = places[pose] - own
            if other != name and np.isfinite(place).all() and np.hypot(*place) > TOGETHER * gap:
                beside = distance_to_box(place - spots, half)
                costs = costs + STRAY / poses * (beside < 1.05 * away) + 4.0 / poses * (beside < 0.8 * gap)
    places = anchors[name][:, None] + spots
    with np.errstate(invalid="ignore"):
        out = ((places - half < edges[[0, 2]]) | (places + half > edges[[1, 3]])).any(axis=2)
    return np.asarray(costs + OVERLAP * out.mean(axis=0))


def leaders(anchors: FloatArray, spots: FloatArray, half: FloatArray) -> FloatArray:
    """Return the lines from labels at some spots (..., 2) to their point at each pose (p, 2), shape (p, ..., 2, 2); (p, 1, 2, 2) of one."""
    nearest = np.clip(0.0, spots - half, spots + half).reshape(-1, 2)
    return np.asarray(anchors[:, None, None] + np.stack([nearest, np.zeros_like(nearest)], axis=1))


def distance_to_box(away: FloatArray, half: FloatArray) -> FloatArray:
    """Return how far boxes, whose centres stand at some ways from a point, shape (..., 2), lie from it."""
    return np.asarray(np.hypot(np.maximum(np.abs(away[..., 0]) - half[0], 0.0), np.maximum(np.abs(away[..., 1]) - half[1], 0.0)))


def is_inside(away: FloatArray, half: FloatArray) -> Mask:
    """Return which ways, shape (..., 2), end within a box about their start; `half` its width and height."""
    wide, high = np.broadcast_to(half, 2)
    return np.asarray((np.abs(away[..., 0]) < wide) & (np.abs(away[..., 1]) < high))
