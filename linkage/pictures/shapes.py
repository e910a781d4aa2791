"""Outlines of bodies: the convex hull of their points, and a line around it at a distance."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import final

import numpy as np

from ..program import FloatArray
from ..steps import Contour

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


# How straight two-point elements look: springs, dampers and plain struts as lines that stretch with their length.

#: half the width of each kind, in sizes
HALF = {"cylinder": 1.5, "spring": 1.15, "damper": 1.15, "strut": 0.4}
APART = 3.6
"""How far apart two elements on the same points stand, in sizes."""
YOKE = 0.38
"""Half the thickness of the piece that holds an element beside its pin, in sizes."""


@final
@dataclass(frozen=True, eq=False)
class Outline:
    """One line of an element: rows of a share of its length, a way along it [m] and one across, to the left [m].

    `fill` is a colour of the style by its name, or none.
    A place stands share * length + way from the first point, so that it moves as the element grows.
    """

    rows: FloatArray
    fill: str = ""
    closed: bool = False
    bold: bool = False

    def at(self, length: float) -> FloatArray:
        """Return the line at a length, along and across, shape (n, 2) [m]."""
        share, along, across = self.rows.T
        return np.column_stack([share * length + along, across])

    def moved(self, aside: float) -> Outline:
        """Return it moved to the left [m]."""
        return Outline(self.rows + np.array([0.0, 0.0, aside]), self.fill, self.closed, self.bold)


def outline(*rows: tuple[float, float, float], fill: str = "", closed: bool = False, bold: bool = False) -> Outline:
    """Return a line through some rows."""
    return Outline(np.array(rows), fill, closed, bold)


def turning_with(contour: Contour) -> Outline:
    """Return a step's contour as a line that moves with its two points."""
    along, across = contour.corners
    return Outline(np.column_stack([np.zeros_like(along), along, across]), fill="ROD", closed=True)


def spring(short: float, long: float, size: float) -> tuple[Outline, ...]:
    """Return a zigzag with straight ends."""
    end, half = min(1.8 * size, 0.15 * short), HALF["spring"] * size
    turns = int(np.clip(short / (2.2 * size), 4, 9))
    share = (np.arange(2 * turns) + 0.5) / (2 * turns)
    sides = np.where(np.arange(2 * turns) % 2, -half, half)
    coils = np.column_stack([share, end * (1.0 - 2.0 * share), sides])
    ends = [[[0.0, 0.0, 0.0], [0.0, end, 0.0]], [[1.0, -end, 0.0], [1.0, 0.0, 0.0]]]
    return (Outline(np.concatenate([ends[0], coils, ends[1]]), bold=True),)


def damper(short: float, long: float, size: float) -> tuple[Outline, ...]:
    """Return a pot that is open towards the second point, and the plate in it; its travel is drawn shorter where the pot is."""
    half, bottom, mouth = HALF["damper"] * size, min(2.2 * size, 0.2 * short), 0.66 * short
    pad = min(0.9 * size, 0.15 * (mouth - bottom))
    share = min(1.0, (mouth - bottom - 2.0 * pad) / (long - short)) if long > short else 0.0
    plate = bottom + pad - share * short
    pot = outline((0.0, mouth, half), (0.0, bottom, half), (0.0, bottom, -half), (0.0, mouth, -half), fill="BARREL")
    disc = outline((share, plate, 0.82 * half), (share, plate, -0.82 * half), bold=True)
    rods = outline((0.0, 0.0, 0.0), (0.0, bottom, 0.0)), outline((share, plate, 0.0), (1.0, 0.0, 0.0), bold=True)
    return (pot, *rods, disc)


def strut(short: float, long: float, size: float) -> tuple[Outline, ...]:
    """Return a thin bar."""
    half = HALF["strut"] * size
    return (outline((0.0, 0.0, half), (1.0, 0.0, half), (1.0, 0.0, -half), (0.0, 0.0, -half), fill="ROD", closed=True),)


def yokes(aside: float, size: float) -> tuple[Outline, ...]:
    """Return the pieces by which an element that stands aside [m] of its points hangs on their pins."""
    half, out = YOKE * size, aside + np.sign(aside) * YOKE * size
    corners = ((-half, 0.0), (half, 0.0), (half, out), (-half, out))
    return tuple(outline(*((end, along, across) for along, across in corners), fill="PISTON", closed=True) for end in (0.0, 1.0))


OUTLINES: Mapping[str, Callable[[float, float, float], tuple[Outline, ...]]] = MappingProxyType(
    {"spring": spring, "damper": damper, "strut": strut}
)
"""What an element is drawn as -> its lines, from its least and greatest length [m] and the drawing's size [m]."""
