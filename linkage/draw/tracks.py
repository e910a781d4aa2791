"""What points slide along: fixed rails and slots on moving bodies, each as long as the travel asks."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ..motion import Motion
from ..program import FloatArray
from ..quantities import Joint
from ..steps import Guide, Slide

MARGIN = 3.2
"""How far a track goes on beyond the travel, in sizes."""


@dataclass(frozen=True, eq=False)
class Track:
    """A straight track: its origin [m] and its direction at every pose, shape (2, n), and the points that slide on it."""

    name: str
    origin: FloatArray
    along: FloatArray
    riders: tuple[str, ...]
    fixed: bool

    @property
    def ends(self) -> tuple[str, str]:
        """The names under which its two ends stand among a pose's places; no point can be called so."""
        return f"{self.name}|start", f"{self.name}|end"

    def travel(self, places: dict[str, FloatArray]) -> tuple[float, float]:
        """Return the least and greatest distance of a rider from the origin [m], along the track."""
        away = np.concatenate([((places[name] - self.origin) * self.along).sum(axis=0) for name in self.riders])
        return float(np.nanmin(away, initial=np.inf)), float(np.nanmax(away, initial=-np.inf))

    def placed(self, travel: tuple[float, float], size: float) -> dict[str, FloatArray]:
        """Return the two ends at every pose, shape (2, n) each [m], for a travel and a margin of so many sizes [m]."""
        low, high = travel if travel[0] <= travel[1] else (0.0, 0.0)
        start, end = self.ends
        pad = MARGIN * size
        return {start: self.origin + (low - pad) * self.along, end: self.origin + (high + pad) * self.along}


def tracks(motion: Motion) -> tuple[Track, ...]:
    """Return the tracks that something slides on."""
    return (*guides(motion), *slots(motion))


def guides(motion: Motion) -> Iterator[Track]:
    """Yield the guides that points slide on."""
    plan = motion.plan
    for name, guide in plan.of_kind(Guide).items():
        riders = tuple(dict.fromkeys(joint.point for joint in every(motion) if joint.track == (name,)))
        if riders:
            fixed = set(guide.points) <= set(plan.ground) and (guide.angle is None or not plan.moves(guide.angle))
            line = motion.reading.line(guide)
            yield Track(
                name, row(motion, line.origin.x, line.origin.y), row(motion, line.direction.x, line.direction.y), riders, fixed
            )  # fmt: skip


def slots(motion: Motion) -> Iterator[Track]:
    """Yield the slots of bodies: each of a step of its own, with the pin in it."""
    guides = motion.plan.of_kind(Guide)
    for name, step in motion.plan.points.items():
        for joint in step.joints():
            if joint.track and joint.line is not None and joint.track[0] not in guides:
                line = joint.line(motion.reading)
                along = row(motion, line.direction.x, line.direction.y)
                yield Track(f"{name}|slot", row(motion, line.origin.x, line.origin.y), along, (joint.point,), False)


def every(motion: Motion) -> Iterator[Joint]:
    """Yield all joints that points slide in, driven or not."""
    members = {**motion.plan.points, **motion.plan.of_kind(Slide)}
    return (joint for member in members.values() for joint in member.joints() if joint.track)


def row(motion: Motion, x: object, y: object) -> FloatArray:
    """Return two components over all poses, shape (2, n)."""
    return np.array([np.broadcast_to(np.asarray(each, float), motion.shape).ravel() for each in (x, y)])
