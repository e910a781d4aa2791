"""An outline whose corners follow dimensions, cut into convex pieces in the program: as its class is where that holds, else anew.

Which corners make up a piece hangs on the design. Where the pieces of the class's own design stay convex and still make up the whole, they
count; elsewhere the triangles do that ears leave which are cut off one after the other, that with the shortest cut first.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import reduce
from itertools import pairwise
from typing import TypeAlias

import numpy as np

from ..vectors import Scalar, Vec

Pick: TypeAlias = Callable[[Scalar, Scalar, Scalar, Scalar], Scalar]
"""What gives its third number where the first is at most the second, else the fourth."""
Triangle: TypeAlias = tuple[Vec, Vec, Vec]

ROUNDED = 1e-9
"""The part of an outline's area that rounding may take or give."""
FAR = 1e12
"""m2: more than any cut is long."""


def doubled_turn(a: Vec, b: Vec, c: Vec) -> Scalar:
    """Return twice the area of three corners, above zero where they go round counter-clockwise [m2]."""
    return (b - a).cross(c - a)


def doubled_area(corners: Sequence[Vec]) -> Scalar:
    """Return twice the area of a closed line, above zero where it goes round counter-clockwise [m2]."""
    start = corners[0]
    return sum(((b - start).cross(c - start) for b, c in pairwise(corners[1:])), 0.0 * start.x)


def how_sound(corners: Sequence[Vec], pieces: Sequence[Sequence[int]], class_sense: float, pick: Pick) -> Scalar:
    """Return a number that is zero or more where pieces, by the numbers of their corners, are convex and make up the whole of a line."""
    whole = doubled_area(corners)
    sense = pick(0.0, whole, class_sense, -class_sense)
    size = np.abs(whole)
    turns, areas = [], []
    for piece in pieces:
        places = [corners[each] for each in piece]
        around = [*places, *places[:2]]
        turns += [doubled_turn(a, b, c) for a, b, c in zip(around, around[1:], around[2:], strict=False)]
        turns += [doubled_turn(places[0], b, c) for b, c in pairwise(places[1:])]
        areas.append(doubled_area(places))
    least_turn = reduce(np.minimum, [each * sense for each in turns])
    missed = np.abs(sum(areas[1:], areas[0]) * sense - size)
    return np.minimum(least_turn + ROUNDED * size, ROUNDED * size - missed)


def triangles(corners: Sequence[Vec], pick: Pick) -> tuple[list[Triangle], Scalar]:
    """Return the triangles that a closed line is cut into, and a number above zero where it can be cut: where it does not cross itself."""
    order, found = list(corners), list[Triangle]()
    whole = doubled_area(corners)
    sense, sound = pick(0.0, whole, 1.0, -1.0), np.abs(whole)
    least_room = ROUNDED * sound
    while len(order) > 3:
        count = len(order)
        around = [(order[place - 1], order[place], order[(place + 1) % count]) for place in range(count)]
        rooms = [ear_room(order, place, sense) for place in range(count)]
        costs = [pick(room, least_room, FAR, (c - a).square()) for room, (a, _, c) in zip(rooms, around, strict=True)]
        best, which, ear = costs[0], 0.0 * costs[0], around[0]
        for place in range(1, count):
            which = pick(best, costs[place], which, float(place))
            ear = tuple(chosen(best, costs[place], one, other, pick) for one, other in zip(ear, around[place], strict=True))  # type: ignore[assignment]
            best = np.minimum(best, costs[place])
        found.append(ear)
        sound = np.minimum(sound, 0.5 * FAR - best)
        order = [chosen(which, float(place), order[place + 1], order[place], pick) for place in range(count - 1)]
    last = (order[0], order[1], order[2])
    return [*found, last], np.minimum(sound, doubled_turn(*last) * sense + least_room)


def chosen(a: Scalar, b: Scalar, one: Vec, other: Vec, pick: Pick) -> Vec:
    """Return one place where a is at most b, else the other."""
    return Vec(pick(a, b, one.x, other.x), pick(a, b, one.y, other.y))


def ear_room(order: Sequence[Vec], place: int, sense: Scalar) -> Scalar:
    """Return a number above zero where a corner can be cut off: it turns to the inside, and nothing else lies in its triangle."""
    count = len(order)
    a, b, c = order[place - 1], order[place], order[(place + 1) % count]
    room = doubled_turn(a, b, c) * sense
    for step in range(2, count - 1):
        P = order[(place + step) % count]
        inside = reduce(np.minimum, [doubled_turn(start, end, P) * sense for start, end in ((a, b), (b, c), (c, a))])
        room = np.minimum(room, 0.0 - inside)
    return room
