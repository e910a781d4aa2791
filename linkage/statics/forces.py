"""Joint forces by equilibrium of every body."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from ..errors import SingularError
from ..motion import Motion
from ..motion.reach import where_words
from ..program import FloatArray
from .drives import cut, drive_of
from .loaded import Case, Loaded, Loads, gathered
from .poses import Poses
from .result import PinForces
from .solved import Solved, joint_forces, on_bodies, residual, solve
from .work import by_work, gap


def pin_forces(
    motion: Motion,
    loads: Loads = None,
    *,
    case: Case = None,
    direction: str = "frictionless",
    drive: str | None = None,
    split: str = "refuse",
) -> PinForces:
    """Return every joint force at every pose, by equilibrium of every body, in one solve over designs and strokes.

    `loads` are the machine's own unless others are given; `case` a LoadCase or its name. `direction` is "extending",
    "retracting" or "frictionless"; with friction and several strokes `drive` says which one moves. Raises DefinitionError
    where a body hangs loose or a link is redundant (unless `split="least squares"`), SingularError at a singular pose and
    where friction leaves no bounded forces (unless the motion has `unreachable="nan"`).
    """
    loaded = gathered(motion, loads, case, direction)
    poses = Poses(motion, "The joint forces")
    moved = drive_of(motion.plan, drive) if loaded.frictions or drive is not None else ""
    solved = solve(poses, loaded, moved, split)
    remarks = locked_words(solved, direction)
    drives = {name: poses.full(solved.value(cut(solved.system, name))) for name in motion.strokes}
    remarks += held_words(poses, loaded, drives, moved, direction)
    return PinForces(
        motion, joint_forces(solved), drives, on_bodies(solved), loaded.case, direction, residual(solved),
        gap(poses, loaded, drives, solved.rubbing), poses.full(solved.locked.astype(float)) == 1.0, tuple(remarks),
    )  # fmt: skip


def locked_words(solved: Solved, direction: str) -> list[str]:
    """Return the words for poses that friction locks; raise them where NaN was not asked for."""
    if not solved.locked.any():
        return []
    poses = solved.system.poses
    motion, mask = poses.motion, poses.full(solved.locked.astype(float)) == 1.0
    points = ", ".join(dict.fromkeys(rub.column.contact.point for rub in solved.rubbing))
    text = (
        f"{motion.plan.title} locks itself while {direction} {where_words(motion.plan, mask, motion.strokes)}: "
        f"with the friction at {points} no bounded drive force moves it. Lower the friction, or make the transmission angles larger."
    )
    if motion.unreachable == "raise":
        raise SingularError(text, mask=mask, motion=motion)
    return [text]


def held_words(poses: Poses, loaded: Loaded, drives: Mapping[str, FloatArray], moved: str, direction: str) -> list[str]:
    """Return the words for poses where friction alone holds the load: it drives, and must still be pushed."""
    if not loaded.frictions or not moved:
        return []
    motion = poses.motion
    free = poses.full(by_work(poses, loaded, moved))
    with np.errstate(invalid="ignore"):
        mask = (free * loaded.sense < 0.0) & (drives[moved] * loaded.sense > 0.0)
    if not mask.any():
        return []
    where = where_words(motion.plan, mask, motion.strokes)
    return [f"Self-locking while {direction} {where}: friction holds the load, which would move {moved} without it; the drive must help."]
