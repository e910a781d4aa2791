"""The bound of moments: the worst that boom and arm may have to balance, (2.20)-(2.21), (2.39)-(2.43).

Everything comes from the machine's own statics, driving forces over all positions of the other drives; the source's closed formulas
are only in the tests. The boom's moment is positive where it lowers the boom, the arm's where the drive has to unfold the arm.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from linkage import drive_force
from linkage.program import FloatArray

from .skeleton import CraneSkeleton

LIFTING = "lifting"

Curve: TypeAlias = Callable[[FloatArray], FloatArray]

FIRST, ROUNDS, NEAR = 65, 8, 4
"""Samples of the first look, rounds of looking closer, samples on either side of the best one in each."""


def worst_over(of: Curve, start: float, end: float, count: int) -> FloatArray:
    """Return the greatest value over start..end of `count` functions at once: `of` takes and gives shape (samples, count).

    It looks at a grid, and ever closer about the best sample of each: a peak broader than 1/64 of the range is met to rounding.
    """
    x = np.linspace(start, end, FIRST)[:, None] + np.zeros(count)
    step, best = abs(end - start) / (FIRST - 1), np.full(count, -np.inf)
    low, high = min(start, end), max(start, end)
    for _ in range(ROUNDS):
        values = of(x)
        place = np.argmax(values, axis=0)
        best = np.maximum(best, np.take_along_axis(values, place[None], 0)[0])
        centre = np.take_along_axis(x, place[None], 0)[0]
        x = np.clip(centre + np.linspace(-step, step, 2 * NEAR + 1)[:, None], low, high)
        step /= NEAR
    return best


def moments(crane: CraneSkeleton, drive: str, phi: ArrayLike, psi: ArrayLike, t: float, case: str) -> FloatArray:
    """Return a drive's force at poses [N m], the shape of phi and psi together."""
    boom, arm = np.broadcast_arrays(np.asarray(phi, float), np.asarray(psi, float))
    (found,) = crane.evaluate([drive_force(drive, case=case)], phi=boom.ravel(), psi=arm.ravel(), t=t)
    return found.reshape(boom.shape)


def boom_bound(crane: CraneSkeleton, phi: ArrayLike, *, case: str = LIFTING) -> FloatArray:
    """Return M_l(phi) [N m], the shape of phi: the greatest moment that lowers the boom, over all positions of arm and telescope."""
    at, limits = np.ravel(np.asarray(phi, float)), crane.limits_of()
    found = np.full(at.size, -np.inf)
    for t in limits["t"]:
        lowering = partial(lambda psi, t: -moments(crane, "phi", at, psi, t, case), t=t)
        found = np.maximum(found, worst_over(lowering, *limits["psi"], at.size))
    return found.reshape(np.shape(phi))


def arm_bound(crane: CraneSkeleton, psi: ArrayLike, *, case: str = LIFTING) -> tuple[FloatArray, FloatArray]:
    """Return M_l1 and M_l2 (psi) [N m], over all positions of the boom: what unfolds the arm and what folds it.

    M_l1 is not above zero and holds with the telescope in, where the cylinder folds the arm; M_l2 is not below zero and holds with the
    telescope out. Both have the shape of psi.
    """
    at, limits = np.ravel(np.asarray(psi, float)), crane.limits_of()
    t_0, t_k = limits["t"]
    falls = worst_over(lambda phi: -moments(crane, "psi", phi, at, t_0, case), *limits["phi"], at.size)
    rises = worst_over(lambda phi: moments(crane, "psi", phi, at, t_k, case), *limits["phi"], at.size)
    shape = np.shape(psi)
    return np.minimum(-falls, 0.0).reshape(shape), np.maximum(rises, 0.0).reshape(shape)
