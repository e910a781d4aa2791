"""The generalised force of a stroke, by virtual work."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ..errors import DefinitionError, known_name
from ..loads import Support
from ..motion import Motion, require_motion
from ..motion.requests import stroke_of
from ..program import FloatArray
from ..quantities import is_number, name_of, real
from .acting import Case, Loaded, Loads, gathered, movement_of
from .forces import equilibrium, locked_words
from .joints import Wrench
from .levers import quotient
from .poses import Poses
from .solution import Equations, consistent, cut, prepared
from .work import by_work, rubbed


def driving_force(
    motion: Motion,
    loads: Loads = None,
    drive: str | None = None,
    *,
    case: Case = None,
    direction: str = "frictionless",
    rates: Mapping[str, Any] | None = None,
    efficiency: float = 1.0,
) -> FloatArray:
    """Return the generalised force of a stroke by virtual work, shape (...): [N], for a crank's angle the torque [Nm].

    It is positive the way the stroke grows, and not a cylinder's thrust: with `AB=L0 - S` a positive one pulls, with `AB=L0 + 2 * S`
    it is twice the thrust, which `pin_forces(...).thrusts` and a cylinder's own `thrust(motion)` tell.
    `loads` are the machine's own unless others are given; `case` a LoadCase or its name. While "extending" (the stroke grows) or
    "retracting" friction adds its work; along a path of several strokes its senses are those of the path. `rates`, such as
    `dict(S=0.05)` [1/s], are what dampers ask for. Given as an `efficiency` k, the force is F / k where the load resists and F k where
    it drives. Raises SingularError at a dead point and where friction locks the mechanism.
    """
    require_motion(motion)
    stroke = stroke_of(motion.plan, drive, "drive")
    movement = movement_of(motion, direction, rates, stroke)
    loaded = gathered(motion, loads, case, movement)
    names = {name for point in loaded.points for name in motion.plan.reaches(point)}
    poses = Poses(motion, f"The driving force of {stroke}", None if loaded.frictions else names)
    force = by_work(poses, loaded, stroke)
    if loaded.frictions:
        found = equilibrium(poses, loaded, loads, case)
        locked_words(found, direction)
        alone = tuple(movement.rates) == (stroke,) and not movement.is_timed
        force = force + movement.sense * rubbed(found.rubbing, found.q) if alone else poses.flat(found.drives[stroke])
    return poses.full(with_losses(force, efficiency, movement.sense))


def with_losses(force: FloatArray, efficiency: float, sense: int) -> FloatArray:
    """Return F / k where the load resists the motion, F k where it drives it."""
    if not (is_number(efficiency) and 0.0 < efficiency <= 1.0):
        raise DefinitionError(f"efficiency={efficiency!r}: a number above 0 and up to 1 is expected.")
    if efficiency != 1.0 and not sense:
        raise DefinitionError('An efficiency works against the motion: say direction="extending" or "retracting".')
    return np.where(force * sense > 0.0, force / efficiency, force * efficiency)


# The force of a support when the drive's force is known.

def reaction(
    motion: Motion,
    loads: Loads = None,
    support: Support | str | None = None,
    *,
    drive_force: Any = 0.0,
    drive: str | None = None,
    case: Case = None,
    direction: str = "frictionless",
    rates: Mapping[str, Any] | None = None,
) -> FloatArray:
    """Return the force of a support along its direction, shape (...) [N], when the drive's force is known.

    `drive_force` [N or Nm] is the drive's own, as `driving_force` counts it, a number or an array over the motion; leave it 0 where
    an element such as a charged line stands for it. The machine's only Support is meant unless one is given; its own `force` does
    not count. With several strokes `drive` names the one that the support balances; the others stand still. Raises SingularError
    where the support's point does not move along its direction with the drive.
    """
    require_motion(motion)
    name, held = support_of(motion, support)
    stroke = stroke_of(motion.plan, drive, "drive")
    loaded = gathered(motion, loads, case, movement_of(motion, direction, rates, stroke), without=name)
    poses = Poses(motion, f"The reaction of {name}")
    known = poses.flat(known_force(motion, drive_force))
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
    name = known_name("Support", support, own, where=motion.plan.title)
    return name, own[name]


def known_force(motion: Motion, drive_force: Any) -> FloatArray:
    """Return a known force of a drive in the motion's shape; DefinitionError where it does not fit or is not finite."""
    try:
        known = np.asarray(np.broadcast_to(real(drive_force), motion.shape))
    except ValueError:
        what = f"a number or an array that fits the poses {motion.shape} is expected"
        raise DefinitionError(f"drive_force={drive_force!r}: {what}.") from None
    if not np.all(np.isfinite(known[motion.reached])):
        raise DefinitionError(f"drive_force={drive_force!r} is not finite at every pose; give numbers in N or Nm.")
    return known


def felt(poses: Poses, support: Support, drive: str, name: str) -> FloatArray:
    """Return how far the support's point moves along its direction on a unit of the stroke, shape (n,); SingularError where it does not."""
    point = name_of(support.point)
    rate = poses.rate(point, drive)
    along = (rate * support.unit[:, None]).sum(axis=0)
    carrying = [each for each in poses.plan.moving if each in poses.plan.reaches(point)]
    size = np.max([np.hypot(*poses.rate(each, drive)) for each in carrying], axis=0, initial=0.0)  # of the fastest point on the way to it
    why = f"its point {point} does not move along its direction with {drive}, so that no reaction balances the drive"
    return quotient(poses, along, size, f"The reaction of {name}", why)


def rubbing_reaction(poses: Poses, loaded: Loaded, support: Support, drive: str, known: FloatArray, direction: str) -> FloatArray:
    """Return the reaction at which friction, joint forces and the known drive force agree, shape (n,)."""
    system, rubbing = prepared(poses, loaded)
    column = np.zeros((poses.count, system.height, 1))
    point = name_of(support.point)
    push = Wrench(poses.at(point), np.zeros((2, poses.count)) + support.unit[:, None], np.zeros(poses.count))
    system.put(column[:, :, 0], system.structure.holder(point), push)
    bound = (*system.known(), (cut(system, drive), known))
    solved = consistent(Equations(system, rubbing, bound=bound, supports=column))
    locked_words(solved, direction)
    return solved.u[:, -1]
