"""A closed outline cut into convex pieces: its corners by their numbers, as they stand in one design."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
import numpy.typing as npt

Corners = npt.NDArray[np.float64]
FLAT = 1e-12
"""A turn whose sine is smaller is no turn."""


def corner_turn(corners: Corners, a: int, b: int, c: int) -> float:
    """Return twice the area of three corners, above zero where they go round counter-clockwise [m2]."""
    (ax, ay), (bx, by), (cx, cy) = corners[a], corners[b], corners[c]
    return float((bx - ax) * (cy - ay) - (by - ay) * (cx - ax))


def signed_area(corners: Corners) -> float:
    """Return the area of a closed line, above zero where it goes round counter-clockwise [m2]."""
    x, y = corners.T
    return float(0.5 * np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y))


def convex_pieces(corners: Corners) -> tuple[tuple[int, ...], ...]:
    """Return convex pieces that make up a closed line, the numbers of their corners counter-clockwise; none for one that crosses itself.

    Ears are cut off until a triangle is left, that with the shortest cut first; then neighbours are joined again while they stay convex,
    across the longest cut first. So the pieces do not hang on which corner is counted first, on the sense, nor on where the line stands.
    Source: J. O'Rourke, Computational geometry in C (1998), 1.4; S. Hertel, K. Mehlhorn, FCT 1983, LNCS 158, 207-218.
    """
    order = list(range(len(corners)))
    if signed_area(corners) < 0.0:
        order.reverse()
    triangles: list[tuple[int, ...]] = []
    while len(order) > 3:
        ears = [place for place in range(len(order)) if is_ear(corners, order, place)]
        if not ears:
            return ()
        ear = min(ears, key=lambda place: squared_length(corners, order[place - 1], order[(place + 1) % len(order)]))
        a, b, c = (order[(ear + step) % len(order)] for step in (-1, 0, 1))
        if corner_turn(corners, a, b, c) > FLAT * squared_extent(corners):
            triangles.append((a, b, c))
        del order[ear]
    if len(order) == 3 and corner_turn(corners, *order) > FLAT * squared_extent(corners):
        triangles.append((order[0], order[1], order[2]))
    found = list(triangles)
    while True:  # neighbours are joined across an edge where both together are convex
        shared = [(i, j, *across_edge(found[i], found[j])) for j in range(len(found)) for i in range(j)]
        pairs = [(squared_length(corners, *edge), i, j, both) for i, j, both, edge in shared if both and is_convex(corners, both)]
        if not pairs:
            return tuple(found)
        _, i, j, both = max(pairs, key=lambda each: each[0])
        del found[j], found[i]
        found.append(both)


def squared_length(corners: Corners, a: int, b: int) -> float:
    """Return the square of the distance of two corners [m2]."""
    return float(np.square(corners[b] - corners[a]).sum())


def squared_extent(corners: Corners) -> float:
    """Return the square of the extent of some corners [m2]."""
    return float(np.square(np.ptp(corners, axis=0)).sum())


def is_ear(corners: Corners, order: Sequence[int], place: int) -> bool:
    """Return whether a corner can be cut off: nothing else of the line lies in its triangle."""
    a, b, c = (order[(place + step) % len(order)] for step in (-1, 0, 1))
    if corner_turn(corners, a, b, c) < -FLAT * squared_extent(corners):
        return False
    for each in order:  # none of the others lies in the triangle or on its edges, but on its corners
        is_corner = any(np.array_equal(corners[each], corners[known]) for known in (a, b, c))
        if not is_corner and all(corner_turn(corners, start, end, each) >= 0.0 for start, end in ((a, b), (b, c), (c, a))):
            return False
    return True


def across_edge(one: tuple[int, ...], other: tuple[int, ...]) -> tuple[tuple[int, ...], tuple[int, int]]:
    """Return two pieces as one, without the edge that they share, and that edge; an empty one where they share none."""
    for k, edge in enumerate(pairwise((*one, one[0]))):
        for m, back in enumerate(pairwise((*other, other[0]))):
            if edge == (back[1], back[0]):
                first = one[k + 1 :] + one[: k + 1]
                second = other[m + 1 :] + other[: m + 1]
                return first + second[1:-1], edge
    return (), (0, 0)


def is_convex(corners: Corners, piece: tuple[int, ...]) -> bool:
    """Return whether a piece turns to the left at all its corners, or goes straight on."""
    count = len(piece)
    least = -FLAT * squared_extent(corners)
    return all(corner_turn(corners, piece[k - 2], piece[k - 1], piece[k]) >= least for k in range(count)) and count == len(set(piece))


def crosses_itself(corners: Corners) -> bool:
    """Return whether two edges of a closed line cross that share no corner."""
    edges = list(pairwise([*range(len(corners)), 0]))
    for k, (a, b) in enumerate(edges):
        for c, d in edges[k + 1 :]:
            if {a, b} & {c, d}:
                continue
            is_between = corner_turn(corners, a, b, c) * corner_turn(corners, a, b, d) < 0.0
            if is_between and corner_turn(corners, c, d, a) * corner_turn(corners, c, d, b) < 0.0:
                return True
    return False
