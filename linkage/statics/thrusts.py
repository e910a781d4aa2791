"""What one straight two-point member carries: a cylinder that holds, a cylinder on a charged line, a spring."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from ..errors import DefinitionError
from ..loads import TwoPoint
from ..motion import Motion, require_motion
from ..program import FloatArray
from .acting import Case, Loaded, Loads, Movement, chosen, gathered, member_title, movement_of, path_tangent, sense_of
from .forces import equilibrium, held_poses, locked_words
from .holding import Line, holding_of, same, stroke_followed
from .levers import Levers, with_levers
from .poses import Poses
from .work import by_work


def member_thrust(
    motion: Motion,
    member: TwoPoint,
    loads: Loads = None,
    *,
    case: Case = None,
    direction: str = "frictionless",
    rates: Mapping[str, Any] | None = None,
) -> FloatArray:
    """Return what a two-point member carries, shape (...) [N], positive where it pushes its ends apart.

    Of one that holds, by virtual work on the strokes that the cylinders have taken over; with friction by equilibrium. Of one with a
    law of its own, that. One that is not of the class stands in the place of the class's cylinder between the same points.
    `direction` is the member's own: "extending" while it grows, whatever that makes of the strokes. Raises DefinitionError for one
    that neither holds nor has a law here, SingularError where its length stands still against its drive.
    """
    require_motion(motion)
    plan, member = motion.plan, standing_for(motion, member)
    elements = [each.element for each in chosen(plan, loads, None)]
    holding = holding_of(plan, [*elements, member])
    line = holding.line_of(member)
    movement = own_movement(motion, member, direction, rates, line)
    loaded = gathered(motion, loads, case, movement)
    pushing = [each.thrust for each in loaded.pushing if same(each.member, member)]
    if line is None and not pushing:
        what = member.name or str(member)
        why = "it does not hold, and no element among these loads gives its force"
        raise DefinitionError(f"{plan.title}: {what} carries nothing here: {why}.")
    if line is None:
        return np.where(motion.reached, sum(pushing, np.zeros(motion.shape)), np.nan)
    names = {name for point in (*loaded.points, *(end for each in line.cylinders for end in each.ends)) for name in plan.reaches(point)}
    what = f"The thrust of {member.name or member}"
    if loaded.frictions:
        found = equilibrium(held_poses(motion, loaded, what), loaded, loads, case)
        locked_words(found, direction)
        return found.thrusts[member_title(member)]
    poses, levers = with_levers(Poses(motion, what, names), holding.lines, what)
    return poses.full(by_lines(poses, loaded, holding.lines, levers, member))


def standing_for(motion: Motion, member: TwoPoint) -> TwoPoint:
    """Return the machine's own holding element in whose place another one is tried, between the same points; else the same."""
    own = motion.plan.of_kind(TwoPoint).values()
    if any(same(member, each) for each in own):
        return member
    return next((each for each in own if each.holds and set(each.ends) == set(member.ends)), member)


def own_movement(motion: Motion, member: TwoPoint, direction: str, rates: Mapping[str, Any] | None, line: Line | None) -> Movement:
    """Return how strokes move while a member grows or shrinks: along the path, else by the stroke it holds or follows most."""
    sense = sense_of(direction)
    if not sense:
        return movement_of(motion, direction, rates, None)
    if rates is not None:
        moves = movement_of(motion, "frictionless", rates, None).rates
        if np.any(sense * np.nan_to_num(member.growth(motion, moves)) < 0.0):
            what = f"{member.name or member}: direction={direction!r} is its own, and at these rates it goes the other way at some poses"
            raise DefinitionError(f"{motion.plan.title}: {what}; drop one of them.")
        return Movement(direction, moves, True, True)
    tangent: Mapping[str, Any] = path_tangent(motion) or {line.stroke if line is not None else stroke_followed(motion.plan, member): 1.0}
    way = sense * np.sign(np.nan_to_num(member.growth(motion, tangent)))
    return Movement(direction, {name: way * rate for name, rate in tangent.items()}, True)


def by_lines(poses: Poses, loaded: Loaded, lines: Sequence[Line], levers: Sequence[Levers], member: TwoPoint) -> FloatArray:
    """Return a holding cylinder's thrust by virtual work on the strokes taken over, shape (n,), frictionless."""
    need = np.stack([by_work(poses, loaded, line.stroke) for line in lines], axis=-1)
    place = next(k for k, line in enumerate(lines) if any(same(each, member) for each in line.cylinders))
    shares = [each.share(lines[place], member, place) for each in levers]
    firsts = [each.solved(need)[:, place] for each in levers]
    if len(levers) == 1:
        return firsts[0] * shares[0]
    return np.where(firsts[0] < 0.0, firsts[1] * shares[1], firsts[0] * shares[0])
