"""The force of a drive: thrust [N] of a cylinder, torque [Nm] of a crank."""

from __future__ import annotations

import numpy as np

from ..errors import DefinitionError
from ..motion import Motion
from ..program import FloatArray
from ..quantities import is_number
from .drives import drive_of
from .forces import locked_words
from .loaded import Case, Loads, gathered
from .poses import Poses
from .solved import solve
from .work import by_work, rubbed


def driving_force(
    motion: Motion,
    loads: Loads = None,
    drive: str | None = None,
    *,
    case: Case = None,
    direction: str = "frictionless",
    efficiency: float = 1.0,
) -> FloatArray:
    """Return the force of a drive by virtual work, shape (...): thrust [N], positive where it pushes the ends apart; a crank's torque [Nm].

    It is the force of the stroke: a positive one pulls where the length falls with it (`AB=L0 - S`), with `AB=L0 + 2 * S` it is
    twice the thrust.
    `loads` are the machine's own unless others are given; `case` a LoadCase or its name. While "extending" or "retracting" friction adds
    its work; given as an `efficiency` k, the force is F / k where the load resists and F k where it drives. The other drives of several
    stand still. Raises SingularError at a dead point and where friction locks the mechanism.
    """
    stroke, loaded = drive_of(motion.plan, drive), gathered(motion, loads, case, direction)
    names = {name for point in loaded.points for name in motion.plan.reaches(point)}
    poses = Poses(motion, f"The driving force of {stroke}", None if loaded.frictions else names)
    force = by_work(poses, loaded, stroke)
    if loaded.frictions:
        solved = solve(poses, loaded, stroke)
        locked_words(solved, direction)
        force = force + loaded.sense * rubbed(solved.rubbing, solved.q)
    return poses.full(with_losses(force, efficiency, loaded.sense))


def with_losses(force: FloatArray, efficiency: float, sense: int) -> FloatArray:
    """Return F / k where the load resists the motion, F k where it drives it."""
    if not (is_number(efficiency) and 0.0 < efficiency <= 1.0):
        raise DefinitionError(f"efficiency={efficiency!r}: a number above 0 and up to 1 is expected.")
    if efficiency != 1.0 and not sense:
        raise DefinitionError('An efficiency works against the motion: say direction="extending" or "retracting".')
    return np.where(force * sense > 0.0, force / efficiency, force * efficiency)
