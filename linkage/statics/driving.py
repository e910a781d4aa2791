"""The generalised force of a stroke, by virtual work."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ..errors import DefinitionError
from ..motion import Motion, require_motion
from ..program import FloatArray
from ..quantities import is_number
from .forces import equilibrium, locked_words
from .loaded import Case, Loads, gathered
from .movement import drive_of, movement_of
from .poses import Poses
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
    stroke = drive_of(motion.plan, drive)
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
