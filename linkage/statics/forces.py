"""Joint forces by equilibrium of every body."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ..errors import SingularError
from ..motion import Motion
from ..motion.reach import where_words
from ..program import FloatArray
from .drives import cut
from .loaded import Case, Loaded, Loads, gathered
from .movement import drive_of, movement_of
from .poses import Poses
from .result import PinForces
from .solved import Solved, joint_forces, solve
from .work import by_work


def pin_forces(
    motion: Motion,
    loads: Loads = None,
    *,
    case: Case = None,
    direction: str = "frictionless",
    drive: str | None = None,
    rates: Mapping[str, Any] | None = None,
    split: str = "refuse",
) -> PinForces:
    """Return every joint force at every pose, by equilibrium of every body, in one solve over designs and strokes.

    `loads` are the machine's own unless others are given; `case` a LoadCase or its name. `direction` is "extending" (the stroke
    grows), "retracting" or "frictionless"; with friction and several strokes `drive` says which one moves, along a path of several
    they move as it goes. `rates`, such as `dict(S=0.05)` [1/s], are what dampers ask for. Raises DefinitionError where a body hangs
    loose or a link is redundant (unless `split="least squares"`), SingularError at a singular pose and where friction leaves no
    bounded forces (unless the motion has `unreachable="nan"`).
    """
    movement = movement_of(motion, direction, rates, drive)
    if drive is not None:
        drive_of(motion.plan, drive)
    loaded = gathered(motion, loads, case, movement)
    poses = Poses(motion, "The joint forces")
    solved = solve(poses, loaded, split)
    remarks = locked_words(solved, direction)
    drives = {name: poses.full(solved.value(cut(solved.system, name))) for name in motion.strokes}
    thrusts = {each.name: poses.full(solved.value(solved.system.thrust(each))) for each in solved.system.structure.struts}
    remarks += [*held_words(poses, loaded, drives), *rest_words(loaded)]
    structure = solved.system.structure
    on = tuple((structure.name(body), each) for body, each, _ in solved.system.loads)
    locked = poses.full(solved.locked.astype(float)) == 1.0
    return PinForces(
        motion, joint_forces(solved), drives, thrusts, loaded.case, direction, locked, tuple(remarks), poses, loaded, on, structure
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


def held_words(poses: Poses, loaded: Loaded, drives: Mapping[str, FloatArray]) -> list[str]:
    """Return the words for poses where friction alone holds the load: it drives, and must still be pushed."""
    movement = loaded.movement
    if not loaded.frictions or len(movement.rates) != 1:
        return []
    ((moved, rate),) = movement.rates.items()
    motion = poses.motion
    free = poses.full(by_work(poses, loaded, moved))
    with np.errstate(invalid="ignore"):
        mask = (free * rate < 0.0) & (drives[moved] * rate > 0.0)
    if not mask.any():
        return []
    where = where_words(motion.plan, mask, motion.strokes)
    held = f"friction holds the load, which would move {moved} without it; the drive must help"
    return [f"Self-locking while {movement.direction} {where}: {held}."]


def rest_words(loaded: Loaded) -> list[str]:
    """Return the words for dampers that give nothing, because no rates are given."""
    if not loaded.at_rest:
        return []
    return [f"{', '.join(loaded.at_rest)}: at rest a damper gives nothing; give the speeds, rates=dict(S=0.05)."]


