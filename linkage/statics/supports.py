"""The force of a support when the drive's force is known."""

from __future__ import annotations

from dataclasses import replace
from typing import Unpack

import numpy as np
from numpy.typing import ArrayLike

from ..checks import require
from ..errors import DefinitionError, known_name
from ..loads import Acting, ActingKeywords, Loads, Support, situation_of, takes_situation
from ..motion import Motion, require_motion
from ..motion.conditions import condition_of_sine
from ..motion.requests import stroke_of
from ..program import FloatArray
from ..quantities import name_of, real
from .agreement import check_joints
from .applied import applied_loads, rates_in
from .held import held_in_case
from .holding import refused_where
from .joints import Wrench
from .poses import FlatPoses
from .solution import Equilibrium, locked_words, system_with_friction
from .vehicle import is_under_frame, push_of, reaction_under_frame
from .work import by_work


@takes_situation
def reaction(
    motion: Motion,
    loads: Loads = None,
    support: Support | str | None = None,
    *,
    drive_force: ArrayLike = 0.0,
    drive: str | None = None,
    **situation: Unpack[ActingKeywords],
) -> FloatArray:
    """Return the force of a support along its direction, shape (...) [N], when the drive's force is known.

    `drive_force` [N or Nm] is the drive's own, as `driving_force` counts it, a number or an array over the motion; leave it 0 where
    an element such as a charged line stands for it. The machine's only Support is meant unless one is given; its own `force` does
    not count. With several strokes `drive` names the one that the support balances; the others stand still. Raises SingularError
    where the support's point does not move along its direction with the drive.

    Of a support under the frame it is its axle load: what the drive's force is does not matter there. DefinitionError where the frame
    weighs nothing or stands on nothing; see `standing` for all that is known of a vehicle on its supports.
    """
    acting = situation_of("reaction", loads=loads, **situation)
    motion = held_in_case(require_motion(motion), acting)
    name, element = support_of(motion, support)
    if is_under_frame(motion.plan, element):
        held = motion._of_the_whole(element) if element.name else None
        if held is not None:
            return reaction(held[0], support=held[1], drive_force=drive_force, drive=drive, acting=acting)
        return axle_load_of(motion, name, element, acting if drive is None else replace(acting, drive=drive), drive_force)
    beside = [word for word in ("stiffness", "friction") if getattr(element, word) is not None]
    if beside:
        what = f"{motion.plan.title}: {name} says {beside[0]}=, but stands under {name_of(element.point)}, which moves"
        raise DefinitionError(f"{what}; that counts under the frame alone. Leave it out; friction of joints is PinFriction, GuideFriction.")
    stroke = stroke_of(motion.plan, drive, "drive")
    applied = applied_loads(motion, acting, rates_in(motion, acting, stroke), without=name)
    poses = FlatPoses(motion, f"The reaction of {name}")
    known = poses.flattened(known_force(motion, drive_force))
    lever = way_along(poses, element, stroke, name)
    if not applied.frictions:
        return poses.full((by_work(poses, applied, stroke) - known) / lever)
    # with friction: the reaction at which it, the joint forces and the known drive force agree
    system, frictions = system_with_friction(poses, applied)
    column, point = np.zeros((poses.count, system.starts[-1], 1)), name_of(element.point)
    push = Wrench(poses.at(point), push_of(poses, element), np.zeros(poses.count))
    for row, value in system.parts(system.structure.holder(point), push):
        column[:, row, 0] += value
    found = Equilibrium(system, frictions, given=((system.drive(stroke), known),), supports=column).solution()
    check_joints(system.structure, poses)
    locked_words(found, acting.movement)
    return poses.full(found.u[:, -1])


def axle_load_of(motion: Motion, name: str, support: Support, acting: Acting, drive_force: ArrayLike) -> FloatArray:
    """Return the reaction of a support under the frame, shape (...) [N]; DefinitionError for a drive's force."""
    if np.any(known_force(motion, drive_force)):
        what = f"{motion.plan.title}: {name} bears the frame, and a drive's force acts between the frame and what it drives"
        raise DefinitionError(f"{what}: an axle load does not hang on it; leave drive_force= out.")
    return reaction_under_frame(motion, name, support, acting)


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


def known_force(motion: Motion, drive_force: ArrayLike) -> FloatArray:
    """Return a known force of a drive in the motion's shape; DefinitionError where it does not fit or is not finite."""
    try:
        known = np.asarray(np.broadcast_to(real(drive_force), motion.shape))
    except ValueError:
        what = f"a number or an array that fits the poses {motion.shape} is expected"
        raise DefinitionError(f"drive_force={drive_force!r}: {what}.") from None
    require(np.all(np.isfinite(known[motion.reached])), "drive_force", drive_force, "is not finite at every pose; give numbers in N or Nm")
    return known


def way_along(poses: FlatPoses, support: Support, drive: str, name: str) -> FloatArray:
    """Return how far the support's point moves along its direction on a unit of the stroke, shape (n,); SingularError where it does not."""
    point = name_of(support.point)
    along = (poses.rate(point, drive) * push_of(poses, support)).sum(axis=0)
    carrying = [each for each in poses.plan.moving if each in poses.plan.reaches(point)]
    size = np.max([np.hypot(*poses.rate(each, drive)) for each in carrying], axis=0, initial=0.0)  # of the fastest point on the way to it
    with np.errstate(divide="ignore", invalid="ignore"):
        cond = condition_of_sine(np.where(size > 0.0, along / np.where(size > 0.0, size, 1.0), 0.0))
    why = f"its point {point} does not move along its direction with {drive}, so that no reaction balances the drive"
    return refused_where(poses, along, cond, f"The reaction of {name}", why)
