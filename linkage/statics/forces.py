"""Joint forces by equilibrium of every body."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import Any

import numpy as np

from ..errors import SingularError
from ..motion import Motion
from ..motion.limits import where_words
from ..motion.requests import stroke_of
from ..program import FloatArray
from .acting import Case, Loaded, Loads, gathered, movement_of
from .force_program import by_program
from .holding import holding_of
from .joints import direction as line_direction
from .levers import with_levers
from .poses import Poses, left
from .result import PinForces
from .solution import Equilibrium, Rubbed, by_equations
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
        stroke_of(motion.plan, drive, "drive")
    loaded = gathered(motion, loads, case, movement)
    found = equilibrium(held_poses(motion, loaded, "The joint forces"), loaded, loads, case, split)
    poses, structure = found.poses, found.structure
    remarks = [*locked_words(found, direction), *lifted_words(found), *held_words(poses, loaded, found.drives), *rest_words(loaded)]
    on = tuple((structure.name(structure.bearer(each.load)), each) for each in loaded.acting)
    locked = poses.full(found.locked.astype(float)) == 1.0
    again = partial(pin_forces, loads=loads, case=case, direction=direction, drive=drive, rates=rates, split=split)
    return PinForces(
        motion, found.joints, found.drives, found.thrusts, loaded.case, direction, locked, tuple(remarks), poses, loaded, on, structure,
        again,
    )  # fmt: skip


def equilibrium(poses: Poses, loaded: Loaded, loads: Loads, case: Case, split: str = "refuse") -> Equilibrium:
    """Return all forces at some poses: by the program where there are many, else by the equations on arrays."""
    found = by_program(poses, loaded, loads, case) if split == "refuse" else None
    return by_equations(poses, loaded, split) if found is None else found


def held_poses(motion: Motion, loaded: Loaded, what: str) -> Poses:
    """Return the poses at which a motion's forces can be worked out: not singular, and held by the cylinders that hold."""
    poses = Poses(motion, what)
    lines = holding_of(motion.plan, loaded.elements).lines
    return poses if not lines else with_levers(poses, lines, what)[0]


def locked_words(found: Rubbed, direction: str) -> list[str]:
    """Return the words for poses that friction locks; raise them where NaN was not asked for."""
    if not found.locked.any():
        return []
    poses = found.poses
    motion, mask = poses.motion, poses.full(found.locked.astype(float)) == 1.0
    points = ", ".join(dict.fromkeys(rub.column.contact.point for rub in found.rubbing))
    text = (
        f"{motion.plan.title} locks itself while {direction} {where_words(motion.plan, mask, motion.strokes)}: "
        f"with the friction at {points} no bounded drive force moves it. Lower the friction, or make the transmission angles larger."
    )
    if motion.unreachable == "raise":
        raise SingularError(text, mask=mask, motion=motion)
    return [text]


def lifted_words(found: Equilibrium) -> list[str]:
    """Return the words for contacts that would have to pull to hold their bodies together: there these come apart."""
    poses, structure, words = found.poses, found.structure, []
    for contact, (force, _) in zip(structure.contacts, found.forces, strict=True):
        if contact.joint is None or not contact.joint.pushes:
            continue
        push = (poses.flat(force) * left(line_direction(contact, poses))).sum(axis=0)
        mask = poses.full(np.where(push < 0.0, 1.0, 0.0)) == 1.0
        if mask.any():
            bodies = f"{structure.name(contact.on)} from {structure.name(contact.by)}"
            words.append(
                f"{contact.owner} lifts off ({contact.kind}, {bodies}) {where_words(poses.plan, mask, poses.motion.strokes)}: there the "
                f"contact would have to pull, with up to {-float(np.nanmin(push)):.6g} N. Press it on with a spring or a weight."
            )
    return words


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
    """Return the words for what gives nothing: no loads at all, dampers without rates."""
    if not loaded.acting and not loaded.pushing:
        return ["no load acts, so that all forces are zero; declare one in the class, such as load = Weight(G, mass=1200)."]
    if not loaded.at_rest:
        return []
    return [f"{', '.join(loaded.at_rest)}: at rest a damper gives nothing; give the speeds, rates=dict(S=0.05)."]


