"""The drive's force by virtual work, through the exact transfer ratios."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np

from ..program import FloatArray
from .loaded import Loaded
from .poses import Poses
from .rub import Rub


def by_work(poses: Poses, loaded: Loaded, drive: str) -> FloatArray:
    """Return the force of a drive that balances the loads [N or Nm], shape (n,): minus their work on a unit of its stroke."""
    return np.asarray(0.0 - sum(works(poses, loaded, drive), np.zeros(poses.count)))


def works(poses: Poses, loaded: Loaded, drive: str) -> Iterator[FloatArray]:
    """Yield the work of each load on a unit of a drive's stroke [N or Nm], shape (n,)."""
    for each in loaded.acting:
        if each.load.point in poses.plan.moving:
            yield (poses.flat(each.force) * poses.rate(each.load.point, drive)).sum(axis=0)


def rubbed(rubbing: list[Rub], q: FloatArray) -> FloatArray:
    """Return the work that friction takes on a unit of the stroke [N or Nm], shape (n,), never negative."""
    return np.asarray(sum((q[:, k] * rub.rate for k, rub in enumerate(rubbing)), np.zeros(len(q))))


def gap(poses: Poses, loaded: Loaded, drives: Mapping[str, FloatArray], rubbing: list[Rub]) -> float:
    """Return the largest difference between the drives' forces by equilibrium and by work, over the loads' works; NaN with friction.

    The works are added by their size: where the loads balance each other, as counterweights do, the drive's own force is nearly nothing.
    """
    if rubbing:
        return float("nan")
    worst = 0.0
    for name, force in drives.items():
        work = by_work(poses, loaded, name)
        size = max(float(np.max(sum(map(np.abs, works(poses, loaded, name)), np.zeros(poses.count)), initial=0.0)), np.finfo(float).tiny)
        worst = max(worst, float(np.max(np.abs(poses.flat(force) - work), initial=0.0)) / size)
    return worst
