"""The force of a support when the drive's force is known."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..errors import DefinitionError, SingularError, unknown
from ..loads import Support
from ..motion import Motion
from ..motion.reach import where_words
from ..program import FloatArray
from ..quantities import name_of, real
from .balance import Equations
from .contacts import Wrench
from .drives import cut, drive_of
from .forces import locked_words
from .loaded import Case, Loaded, Loads, gathered
from .poses import Poses
from .solved import consistent, prepared
from .work import by_work

LOST = 1e-12  # a support that moves less than this part of what its point moves does not feel the drive


def reaction(
    motion: Motion,
    loads: Loads = None,
    support: Support | str | None = None,
    *,
    thrust: Any = 0.0,
    drive: str | None = None,
    case: Case = None,
    direction: str = "frictionless",
) -> FloatArray:
    """Return the force of a support along its direction, shape (...) [N], when the drive's force is known.

    `thrust` [N or Nm] is the drive's own force, a number or an array over the motion; leave it 0 where a load along the
    cylinder stands for it. The machine's only Support is meant unless one is given; its own `force` does not count. With
    several strokes `drive` names the one that the support balances; the others stand still. Raises SingularError where
    the support's point does not move along its direction with the drive.
    """
    name, held = support_of(motion, support)
    stroke, loaded = drive_of(motion.plan, drive), gathered(motion, loads, case, direction, without=name)
    poses = Poses(motion, f"The reaction of {name}")
    known = poses.flat(thrust_over(motion, thrust))
    lever = felt(poses, held, stroke, name)
    if not loaded.frictions:
        return poses.full((by_work(poses, loaded, stroke) - known) / lever)
    return poses.full(rubbing_reaction(poses, loaded, held, stroke, known, direction))


def support_of(motion: Motion, support: Support | str | None) -> tuple[str, Support]:
    """Return the support that is meant, with its name."""
    own = motion.plan.of_kind(Support)
    if isinstance(support, Support):
        return support.name or str(support), support
    if support is None and len(own) == 1:
        return next(iter(own.items()))
    if support is None:
        raise DefinitionError(f"{motion.plan.title} has {len(own)} supports: say which one, such as Support('R', (0, 1)).")
    if support not in own:
        raise unknown("Support", support, own, where=motion.plan.title)
    return support, own[support]


def thrust_over(motion: Motion, thrust: Any) -> FloatArray:
    """Return a known thrust in the motion's shape; DefinitionError where it does not fit."""
    try:
        return np.asarray(np.broadcast_to(real(thrust), motion.shape))
    except ValueError:
        raise DefinitionError(f"thrust={thrust!r}: a number or an array that fits the poses {motion.shape} is expected.") from None


def felt(poses: Poses, support: Support, drive: str, name: str) -> FloatArray:
    """Return how far the support's point moves along its direction on a unit of the stroke, shape (n,); SingularError where it does not."""
    rate = poses.rate(name_of(support.point), drive)
    along = (rate * support.unit[:, None]).sum(axis=0)
    blind = np.abs(along) <= LOST * np.hypot(rate[0], rate[1])
    if blind.any():
        motion, mask = poses.motion, poses.full(blind.astype(float)) == 1.0
        where = where_words(motion.plan, mask, motion.strokes)
        what = f"{name}: its point {name_of(support.point)} does not move along its direction with {drive}"
        text = f"{what} {where}: no reaction balances the thrust there."
        if motion.unreachable == "raise":
            raise SingularError(text, mask=mask, motion=motion)
    return np.where(blind, np.nan, along)


def rubbing_reaction(poses: Poses, loaded: Loaded, support: Support, drive: str, known: FloatArray, direction: str) -> FloatArray:
    """Return the reaction at which friction, joint forces and the known drive force agree, shape (n,)."""
    system, rubbing = prepared(poses, loaded, drive)
    column = np.zeros((poses.count, system.height, 1))
    point = name_of(support.point)
    push = Wrench(poses.at(point), np.zeros((2, poses.count)) + support.unit[:, None], np.zeros(poses.count))
    system.put(column[:, :, 0], system.structure.holder(point), push)
    solved = consistent(Equations(system, rubbing, bound=((cut(system, drive), known),), supports=column))
    locked_words(solved, direction)
    return solved.u[:, -1]
