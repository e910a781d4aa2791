"""How the lengths of the cylinders that hold follow the strokes they have taken over, and where that holds nothing.

Where a cylinder's length stands still against its drive, or those of several follow the strokes alike, no thrust balances the loads:
such poses are refused like any other singular one, by the condition of the levers beside the speed at which the cylinders' ends part.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..errors import SingularError, SingularWarning, warn
from ..loads import TwoPoint
from ..motion.conditions import REFUSE, WARN, condition, is_or_are
from ..motion.limits import where_words
from ..program import FloatArray
from .equilibrium import areas
from .holding import Line, same
from .poses import Poses

# Quotients of forces and ratios: refused where the divisor vanishes, by the same conditions as ratios at a dead point.

def quotient(poses: Poses, divisor: FloatArray, size: FloatArray, what: str, reason: str) -> FloatArray:
    """Return a divisor (n,), NaN where it is lost beside the `size` (n,) of what it is the part of.

    SingularError where the condition, size over divisor, is above that at which ratios are refused, unless the motion was asked for
    with `unreachable="nan"`; a warning with the error to expect near it. `what` opens the sentence, `reason` ends it.
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        cond = condition(np.where(size > 0.0, divisor / np.where(size > 0.0, size, 1.0), 0.0))
    return refused_where(poses, divisor, cond, what, reason)


def refused_where(poses: Poses, values: FloatArray, cond: FloatArray, what: str, reason: str) -> FloatArray:
    """Return values (..., n) with NaN where a condition (n,) is refused; raise or warn as for ratios."""
    lost = ~(cond <= REFUSE)
    motion = poses.motion
    if lost.any():
        mask = poses.full(lost.astype(float)) == 1.0
        if motion.unreachable == "raise":
            where = where_words(motion.plan, mask, motion.strokes)
            worst = float(np.max(np.nan_to_num(cond[lost], nan=np.inf)))
            size = "infinite" if np.isinf(worst) else f"{worst:.1e}"
            text = f"{what} {is_or_are(what)} refused {where}: {reason} (condition {size}, refused above {REFUSE:.0e})."
            raise SingularError(text, mask=mask, motion=motion)
    near = (cond > WARN) & ~lost
    if near.any():
        worst = float(cond[near].max())
        where = where_words(motion.plan, poses.full(near.astype(float)) == 1.0, motion.strokes)
        # one division by a difference that is lost: the error goes with the condition, not its square
        error = f"expect a relative error of about {np.finfo(float).eps * worst:.0e}"
        text = f"{what} {is_or_are(what)} nearly refused {where}, for close by {reason} (condition {worst:.1e}); {error}."
        warn(SingularWarning(text))
    return np.where(lost, np.nan, values)


@dataclass(frozen=True)
class Levers:
    """The work of each line's first cylinder, with what the others of its line add, on a unit of each stroke taken: (n, lines, strokes).

    `shares` are the thrusts of each line's cylinders over that of its first, (n,) each.
    """

    matrix: FloatArray
    sizes: FloatArray
    shares: tuple[tuple[FloatArray, ...], ...]

    def share(self, line: Line, member: TwoPoint, place: int) -> FloatArray:
        """Return the thrust of a cylinder of a line over that of its first."""
        return next(part for each, part in zip(line.cylinders, self.shares[place], strict=True) if same(each, member))

    def solved(self, need: FloatArray) -> FloatArray:
        """Return the thrusts of the lines' first cylinders (n, lines) that give the strokes what they need (n, strokes)."""
        if self.matrix.shape[1] == 1:
            return need / self.matrix[:, 0]
        return np.asarray(np.linalg.solve(np.swapaxes(self.matrix, 1, 2), need[:, :, None])[:, :, 0])

    @property
    def condition(self) -> FloatArray:
        """How near the levers are to a singular pose, relative to their sizes (n,); infinite where they are at one."""
        columns = self.sizes.max(axis=1, keepdims=True)
        columns = np.where(columns > 0.0, columns, 1.0)
        rows = (self.sizes / columns).max(axis=2, keepdims=True)
        scaled = self.matrix / columns / np.where(rows > 0.0, rows, 1.0)
        if self.matrix.shape[1] == 1:
            return condition(scaled[:, 0, 0])
        return inverse_size(scaled)


def inverse_size(matrices: FloatArray) -> FloatArray:
    """Return the size of the inverse of each matrix (n, k, k): one over its least singular value, or up to the root of k more."""
    k = matrices.shape[1]
    if k > 3:
        least = np.linalg.svd(matrices, compute_uv=False)[:, -1]
        with np.errstate(divide="ignore"):
            return np.asarray(1.0 / least)
    rows = [matrices[:, i] for i in range(k)]
    if k == 2:
        minors, det = np.abs(matrices).reshape(-1, 4), rows[0][:, 0] * rows[1][:, 1] - rows[0][:, 1] * rows[1][:, 0]
    else:
        crosses = [np.cross(rows[1], rows[2]), np.cross(rows[2], rows[0]), np.cross(rows[0], rows[1])]
        minors, det = np.concatenate(crosses, axis=1), (rows[0] * crosses[0]).sum(axis=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        found = np.sqrt((minors * minors).sum(axis=1)) / np.abs(det)
    return np.where(det == 0.0, np.inf, found)


def with_levers(poses: Poses, lines: Sequence[Line], what: str) -> tuple[Poses, tuple[Levers, ...]]:
    """Return the poses at which the cylinders hold, and their levers there: a second time where first cylinders pull.

    SingularError at the others unless NaN was asked for; `what` opens the sentence.
    """
    if all(line.is_steady for line in lines):
        return poses, (steady_levers(poses, lines),)
    both = any(line.changes_shares for line in lines)
    found = [levers_of(poses, lines, way) for way in ((1, -1) if both else (1,))]
    names = [each.name or str(each) for line in lines for each in line.cylinders]
    whose = f"the length of {names[0]} stands" if len(names) == 1 else f"the lengths of {', '.join(names)} stand"
    cond = np.max([each.condition for each in found], axis=0)
    lost = np.isnan(refused_where(poses, np.zeros(poses.count), cond, what, f"{whose} still against the drive there"))
    if not lost.any():
        return poses, tuple(found)
    left = poses.without(lost)
    return left, tuple(levers_of(left, lines, way) for way in ((1, -1) if both else (1,)))


def steady_levers(poses: Poses, lines: Sequence[Line]) -> Levers:
    """Return the levers of cylinders whose lengths follow their own strokes in proportion: nothing stands still."""
    matrix = np.zeros((poses.count, len(lines), len(lines)))
    for i, line in enumerate(lines):
        matrix[:, i, i] = line.steady
    one = np.ones(poses.count)
    return Levers(matrix, np.abs(matrix), tuple((one,) for _ in lines))


def levers_of(poses: Poses, lines: Sequence[Line], way: int) -> Levers:
    """Return the levers of lines whose first cylinders push (`way` 1) or pull (-1)."""
    n, count = poses.count, len(lines)
    matrix, sizes, shares = np.zeros((n, count, count)), np.zeros((n, count, count)), []
    for i, line in enumerate(lines):
        weights = areas(line, poses, way)
        shares.append(tuple(weight / weights[0] for weight in weights))
        for cylinder, part in zip(line.cylinders, shares[-1], strict=True):
            for j, other in enumerate(lines):
                lever, size = lever_of(poses, cylinder, other.stroke)
                matrix[:, i, j] += part * lever
                sizes[:, i, j] += np.abs(part) * size
    return Levers(matrix, sizes, tuple(shares))


def lever_of(poses: Poses, cylinder: TwoPoint, stroke: str) -> tuple[FloatArray, FloatArray]:
    """Return how a cylinder's length grows with a stroke, and how fast its ends part at the most, both (n,)."""
    P, Q = cylinder.ends
    known = poses.plan.table.lengths.get(frozenset((P, Q)))
    if known is not None:
        lever = np.broadcast_to(poses.ratio(known, stroke), (poses.count,))
        return lever, np.full(poses.count, float(np.max(np.abs(lever), initial=0.0)))
    return poses.growth(P, Q, stroke), np.hypot(*(poses.rate(Q, stroke) - poses.rate(P, stroke)))
