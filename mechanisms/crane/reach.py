"""Where the crane reaches: boom and arm for a place of the tip, how far the telescope may be out there, and the area of it all.

The reach is what the tip, T, covers in the crane's plane; what stands in the way, the vehicle and the ground, is not looked at.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import TypeAlias, final

import numpy as np
from numpy.typing import NDArray

from linkage.program import FloatArray

from .cylinders import drive_limits
from .machine import Crane

Cells: TypeAlias = NDArray[np.int64]
Flags: TypeAlias = NDArray[np.bool_]

EXACT = 1e-9
"""rad and m: how far a drive may be beyond its end by rounding."""
EDGE = 1e-7
"""The same where the tip stands on the very edge of the reach, at which angles go as square roots."""


@final
@dataclass(frozen=True, eq=False)
class Windows:
    """Parts of the telescope's stroke in which boom and arm can stand: of which place, with which elbow, from `low` to `high` [m].

    The elbow is 1 where the joint lies above the line from O to the tip, -1 where it lies below (a back-broken crane's).
    """

    place: Cells
    elbow: FloatArray
    low: FloatArray
    high: FloatArray


@final
class Reach:
    """The positions of one crane, by its tip: `phi`, `psi` and `t` keep to the ends of their drives and of their cylinders."""

    def __init__(self, crane: Crane) -> None:
        self.limits = drive_limits(crane)
        self.l_c, self.l_p = float(crane["l_c"]), float(crane["l_p"])
        self.height = float(crane["H_p"]) + float(crane["h_0"])

    def angles(self, x: FloatArray, y: FloatArray, t: FloatArray, elbow: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return phi and psi [rad] of a tip at (x, y) [m], t and elbow given; all of one shape."""
        reach, across = self.l_p + t, np.maximum(np.hypot(x, y - self.height), EXACT)
        at_O = (self.l_c**2 + across**2 - reach**2) / (2.0 * self.l_c * across)
        at_J = (self.l_c**2 + reach**2 - across**2) / (2.0 * self.l_c * reach)
        phi = np.arctan2(x, y - self.height) - elbow * np.arccos(np.clip(at_O, -1.0, 1.0))
        psi = np.arccos(np.clip(at_J, -1.0, 1.0))
        middle = 0.5 * sum(self.limits["phi"])
        phi = middle + np.mod(phi - middle + np.pi, 2.0 * np.pi) - np.pi
        return phi, np.where(elbow > 0.0, psi, 2.0 * np.pi - psi)

    def stands(self, x: FloatArray, y: FloatArray, t: FloatArray, elbow: FloatArray, play: float = EXACT) -> Flags:
        """Return whether boom and arm can stand so."""
        phi, psi = self.angles(x, y, t, elbow)
        reach, across = self.l_p + t, np.hypot(x, y - self.height)
        closes = (across <= self.l_c + reach + play) & (across >= np.abs(self.l_c - reach) - play)
        (low, high), (least, most) = self.limits["phi"], self.limits["psi"]
        return np.asarray(closes & (phi >= low - play) & (phi <= high + play) & (psi >= least - play) & (psi <= most + play))

    def marks(self, x: FloatArray, y: FloatArray) -> FloatArray:
        """Return how far the telescope is out where something comes to its end, ascending, shape (marks, n) [m]."""
        across = np.hypot(x, y - self.height)
        found = [np.full(x.shape, end) + self.l_p for end in self.limits["t"]]
        for phi in self.limits["phi"]:
            found.append(np.hypot(x - self.l_c * np.sin(phi), y - self.height - self.l_c * np.cos(phi)))
        for psi in self.limits["psi"]:
            root = np.sqrt(np.maximum(across**2 - (self.l_c * np.sin(psi)) ** 2, 0.0))
            found += [self.l_c * np.cos(psi) + root, self.l_c * np.cos(psi) - root]
        found += [across - self.l_c, self.l_c - across, across + self.l_c]
        return np.sort(np.clip(np.array(found) - self.l_p, *self.limits["t"]), axis=0)

    def windows(self, x: FloatArray, y: FloatArray) -> Windows:
        """Return every part of the telescope's stroke in which the tip can be at places (x, y), shapes (n,) [m]."""
        marks = self.marks(x, y)
        elbows = np.array([1.0, -1.0] if self.limits["psi"][1] > np.pi + EXACT else [1.0])
        low, high, elbow = np.broadcast_arrays(marks[:-1], marks[1:], elbows[:, None, None])
        fits = (high - low > EXACT) & self.stands(x, y, 0.5 * (low + high), elbow)
        chosen = np.nonzero(fits)
        lone = np.nonzero(~fits.any(axis=(0, 1)))[0]  # on the very edge of the reach there is a single length
        at, turned = np.broadcast_arrays(marks[:, lone], elbows[:, None, None])
        edge = np.nonzero(self.stands(x[lone], y[lone], at, turned, EDGE))
        return Windows(
            np.concatenate([chosen[2], lone[edge[2]]]),
            np.concatenate([elbow[chosen], turned[edge]]),
            np.concatenate([low[chosen], at[edge]]),
            np.concatenate([high[chosen], at[edge]]),
        )

    def on_rays(self, angle: FloatArray, radius: FloatArray) -> Flags:
        """Return whether the tip can be on rays from O, by their direction [rad] and the distance on them [m]; they broadcast."""
        return self.reaches(radius * np.cos(angle), self.height + radius * np.sin(angle))

    def reaches(self, x: FloatArray, y: FloatArray) -> Flags:
        """Return whether the tip can be at places (x, y) [m], their shape."""
        flat_x, flat_y = (np.ravel(each) for each in np.broadcast_arrays(np.asarray(x, float), np.asarray(y, float)))
        found = np.zeros(flat_x.size, bool)
        found[self.windows(flat_x, flat_y).place] = True
        return found.reshape(np.broadcast_shapes(np.shape(x), np.shape(y)))


RAYS, SAMPLES, HALVINGS = 361, 401, 40
"""Rays from O over the full circle, places on each, and how often an edge between two of them is halved."""


@final
@dataclass(frozen=True, eq=False)
class Envelope:
    """All that a crane's tip reaches, with its border and its area.

    `spans` are the parts of every ray that lie within, (ray, nearest, farthest) with the rays' directions in `angles` [rad], from `centre`.
    """

    centre: tuple[float, float]
    angles: FloatArray
    spans: tuple[tuple[int, float, float], ...]

    @property
    def area(self) -> float:
        """The area within reach [m2]."""
        first, last = 0, self.angles.size - 1  # the same ray
        swept = sum(0.5 * (far**2 - near**2) for ray, near, far in self.spans if first < ray <= last)
        return float(swept * (self.angles[1] - self.angles[0]))

    @property
    def border(self) -> FloatArray:
        """The border in straight pieces, shape (n, 2, 2) [m]: pieces, their two ends, x and y.

        Of two neighbouring rays the parts that only one of them has within are pairs of ends in order of distance: a piece each.
        """
        ends: list[list[tuple[float, int]]] = [[] for _ in self.angles]
        for ray, near, far in self.spans:
            ends[ray] += [(near, ray), (far, ray)]
        joined = [sorted(one + other) for one, other in pairwise(ends)]
        pieces = [pair for row in joined for pair in zip(row[::2], row[1::2], strict=True)]
        radius = np.array([[end[0] for end in piece] for piece in pieces])
        angle = self.angles[[[end[1] for end in piece] for piece in pieces]]
        return np.stack([self.centre[0] + radius * np.cos(angle), self.centre[1] + radius * np.sin(angle)], axis=-1)


def envelope(crane: Crane) -> Envelope:
    """Return all that the tip of one crane reaches, its edges to a micrometre along the rays."""
    reach = Reach(crane)
    most = reach.l_c + reach.l_p + reach.limits["t"][1]
    angles, radii = np.linspace(-np.pi, np.pi, RAYS), np.linspace(0.0, 1.001 * most, SAMPLES)
    inside = reach.on_rays(angles[:, None], radii[None, :])
    ray, place = np.nonzero(inside[:, 1:] != inside[:, :-1])
    low, high, grows = radii[place], radii[place + 1], inside[ray, place + 1]
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        beyond = reach.on_rays(angles[ray], middle) == grows
        low, high = np.where(beyond, low, middle), np.where(beyond, middle, high)
    ends: list[list[float]] = [[0.0] if first else [] for first in inside[:, 0]]
    for each, at in zip(ray, 0.5 * (low + high), strict=True):
        ends[each].append(float(at))
    spans = tuple((k, near, far) for k, row in enumerate(ends) for near, far in zip(row[::2], row[1::2], strict=True))
    return Envelope((0.0, reach.height), angles, spans)
