"""Points' names, placed where they cover neither the mechanism nor each other."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from types import MappingProxyType

import numpy as np

from ..plan import Mask
from ..program import FloatArray
from . import style
from .scene import Bounds, Places
from .shapes import lines_cross, polar

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
        near = points[is_inside(points - own, np.abs(spots).max() + half.max() + 2.0)] - own
        costs = costs + np.count_nonzero(is_inside(near - spots[:, None], half + 1.0), axis=1) / poses
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
