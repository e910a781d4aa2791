"""Outlines of bodies: the convex hull of their points, and a line around it at a distance."""

from __future__ import annotations

import numpy as np

from ..program import FloatArray

ARC = np.radians(11.3)  # no part of a right angle, so that rounding does not change how many steps a corner takes


def hull(points: FloatArray) -> list[int]:
    """Return the indices of the convex hull, counter-clockwise; two where all points lie on a line.

    `points` has the shape (n, 2). Source: A. M. Andrew, monotone chain, 1979.
    """
    order = sorted(range(len(points)), key=lambda index: (points[index][0], points[index][1]))
    slack = 1e-9 * float(np.ptp(points, axis=0).max()) ** 2
    lower, upper = _chain(points, order, slack), _chain(points, order[::-1], slack)
    return lower[:-1] + upper[:-1] or order[:1]


def _chain(points: FloatArray, order: list[int], slack: float) -> list[int]:
    """Return one side of the hull."""
    chain: list[int] = []
    for index in order:
        while len(chain) > 1 and _turn(points[chain[-2]], points[chain[-1]], points[index]) <= slack:
            chain.pop()
        chain.append(index)
    return chain


def _turn(a: FloatArray, b: FloatArray, c: FloatArray) -> float:
    return float((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))


def rounded(corners: FloatArray, radius: float) -> FloatArray:
    """Return the line around a convex polygon at a distance, shape (m, 2).

    `corners` has the shape (k, 2), counter-clockwise: one gives a circle, two a bar with round ends.
    """
    if len(corners) == 1:
        around = np.linspace(0.0, 2 * np.pi, 33)
        return np.asarray(corners[0] + radius * np.column_stack([np.cos(around), np.sin(around)]))
    along = np.roll(corners, -1, axis=0) - corners
    normal = np.arctan2(-along[:, 0], along[:, 1])
    pieces = [corners[i] + radius * _arc(normal[i - 1], normal[i]) for i in range(len(corners))]
    return np.concatenate([*pieces, pieces[0][:1]])


def _arc(start: float, end: float) -> FloatArray:
    """Return the directions from one angle to the next, counter-clockwise, shape (m, 2)."""
    swing = (end - start) % (2 * np.pi)
    angles = start + np.linspace(0.0, swing, 2 + int(swing / ARC))
    return np.column_stack([np.cos(angles), np.sin(angles)])


def segment(start: FloatArray, end: FloatArray, step: float) -> FloatArray:
    """Return points along a straight line, no further apart than a step, shape (m, 2)."""
    count = 2 + int(np.hypot(*(end - start)) / step)
    return np.asarray(start + np.linspace(0.0, 1.0, count)[:, None] * (end - start))
