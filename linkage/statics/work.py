"""The drive's force by virtual work, through the exact transfer ratios."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np

from ..program import FloatArray
from .acting import Loaded
from .friction import Rub
from .poses import Poses


def by_work(poses: Poses, loaded: Loaded, drive: str) -> FloatArray:
    """Return the force of a drive that balances the loads [N or Nm], shape (n,): minus their work on a unit of its stroke."""
    return np.asarray(0.0 - sum(works(poses, loaded, drive), np.zeros(poses.count)))


def works(poses: Poses, loaded: Loaded, drive: str) -> Iterator[FloatArray]:
    """Yield the work of each load on a unit of a drive's stroke [N or Nm], shape (n,)."""
    for each in loaded.acting:
        if each.load.point in poses.plan.moving:
            yield (poses.flat(each.force) * poses.rate(each.load.point, drive)).sum(axis=0)
    for push in loaded.pushing:
        P, Q = push.ends
        if {P, Q} & set(poses.plan.moving):
            yield poses.flat(push.thrust) * poses.growth(P, Q, drive)


def rubbed(rubbing: list[Rub], q: FloatArray) -> FloatArray:
    """Return the work that friction takes on a unit of the stroke [N or Nm], shape (n,), never negative."""
    return np.asarray(sum((each * rub.rate for each, rub in zip(q, rubbing, strict=True)), np.zeros(q.shape[1])))


def gap(poses: Poses, loaded: Loaded, drives: Mapping[str, FloatArray]) -> float:
    """Return the largest difference between the drives' forces by equilibrium and by work, over the loads' powers; NaN with friction.

    A load's power counts as force times way, whatever the angle between them: where loads balance each other, as counterweights do, or
    do no work, the drive's own force is nearly nothing.
    """
    if loaded.frictions:
        return float("nan")
    worst = 0.0
    for name, force in drives.items():
        missed = float(np.nanmax(np.abs(poses.flat(force) - by_work(poses, loaded, name)), initial=0.0))
        power = float(np.max(sum(powers(poses, loaded, name), np.zeros(poses.count)), initial=0.0))
        worst = max(worst, missed / power if power > 0.0 else missed)
    return worst


def powers(poses: Poses, loaded: Loaded, drive: str) -> Iterator[FloatArray]:
    """Yield the size of each load's force times the way of its point on a unit of a drive's stroke [N or Nm], shape (n,)."""
    acting = [(each.load.point, np.hypot(*poses.flat(each.force))) for each in loaded.acting]
    acting += [(end, np.abs(poses.flat(push.thrust))) for push in loaded.pushing for end in push.ends]
    for point, size in acting:
        yield size * np.hypot(*poses.rate(point, drive))
