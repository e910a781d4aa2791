"""Points' names, placed where they cover neither the mechanism nor each other."""

from __future__ import annotations

from collections.abc import Sequence
from typing import final

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patheffects import withStroke

from ..program import FloatArray
from . import style
from .scene import Places
from .style import Look
from .symbols import MovingPart

REACH = (1.0, 1.4, 2.0, 2.8, 4.0)
WAYS = np.radians(np.arange(60.0, 420.0, 22.5))
"""The places a label tries: distances, as multiples of the nearest, and directions [rad], the preferred one first."""


@final
class LabelPart(MovingPart):
    """A point's name at an offset [points]."""

    def __init__(self, ax: Axes, name: str, offset: FloatArray, look: Look) -> None:
        self.points = (name,)
        self.text = ax.annotate(
            name, (0, 0), xytext=(float(offset[0]), float(offset[1])), textcoords="offset points", ha="center", va="center_baseline",
            fontsize=style.LABEL, fontstyle="italic", color=look.colour(style.INK), zorder=look.level + 1.0, annotation_clip=False,
            path_effects=[withStroke(linewidth=2.5, foreground=style.PAPER)],
        )  # fmt: skip
        self.artists = (self.text,)

    def move(self, at: Places) -> None:
        x, y = at[self.points[0]]
        self.text.xy = (float(x), float(y))


def offsets(
    names: Sequence[str], poses: Sequence[Places], clouds: Sequence[FloatArray], scale: float, gap: float, font: float = style.LABEL
) -> dict[str, FloatArray]:
    """Return where each name stands, from its point, shape (2,) each, in the unit of `font`.

    One offset serves all `poses`; where there are several it stays short, so that each name keeps to its pin.
    `clouds` are the points to keep clear at each [m]; `scale` is that unit per
    metre and `gap` the distance from the point's centre at which a label may begin. Greedy, crowded points first.
    """
    taken = [cloud * scale for cloud in clouds]
    if len(poses) > 1:
        pins = [np.array([at[name] for name in names]).reshape(-1, 2) * scale for at in poses]
        taken = [np.concatenate([points, np.repeat(each, 4, axis=0)]) for points, each in zip(taken, pins, strict=True)]
    far = max(gap, 0.9 * font) if len(poses) > 1 else np.inf
    spots_of: dict[str, FloatArray] = {}
    around = np.array([3 * font, 3 * font])
    crowds = {name: sum(_count(points, at[name] * scale, around) for at, points in zip(poses, taken, strict=True)) for name in names}
    for name in sorted(names, key=lambda each: -crowds[each]):
        half = 0.5 * font * np.array([0.68 * len(name) + 0.15, 0.95])
        anchors = [at[name] * scale for at in poses]
        spots = candidates(half, gap, far)
        costs = [_cost(spot, rank, half, anchors, taken) for rank, spot in enumerate(spots)]
        spots_of[name] = spots[int(np.argmin(costs))]
        taken = [np.concatenate([points, _covered(anchor + spots_of[name], half)]) for points, anchor in zip(taken, anchors, strict=True)]
    return spots_of


def candidates(half: FloatArray, gap: float, far: float = np.inf) -> list[FloatArray]:
    """Return the offsets a label of half that width and height tries, the preferred first, none beginning beyond `far`."""
    ways = [np.array([np.cos(way), np.sin(way)]) for way in WAYS]
    return [reach * gap * way + half * np.clip(np.sqrt(2.0) * way, -1.0, 1.0) for reach in REACH if reach * gap <= far for way in ways]


def _cost(spot: FloatArray, rank: int, half: FloatArray, anchors: Sequence[FloatArray], taken: Sequence[FloatArray]) -> float:
    """Return how many taken points a label would cover, a pose, and a little for each place further down the list."""
    covered = [_count(points, anchor + spot, half + 1.0) for points, anchor in zip(taken, anchors, strict=True)]
    return sum(covered) / max(len(anchors), 1) + 0.02 * rank


def _count(points: FloatArray, centre: FloatArray, half: FloatArray) -> int:
    """Return how many points lie in a box."""
    return int(np.count_nonzero((np.abs(points - centre) < half).all(axis=1)))


def _covered(centre: FloatArray, half: FloatArray) -> FloatArray:
    """Return points that cover a label, weighted to keep others off, shape (n, 2)."""
    steps = np.linspace(-1.0, 1.0, 5)
    return np.array([centre + half * (u, v) for u in steps for v in steps for _ in range(3)])
