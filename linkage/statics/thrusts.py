"""What one straight two-point member carries: a cylinder that holds, a cylinder on a charged line, a spring."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from ..errors import DefinitionError
from ..loads import TwoPoint
from ..motion import Motion
from ..motion.singular import condition
from ..program import FloatArray
from ..quantities import Distance, Quantity
from .bodies import member_title
from .forces import locked_words
from .holding import Line, holding_of, same, stroke_followed
from .loaded import Case, Loaded, Loads, chosen, gathered
from .movement import Movement, movement_of, path_tangent, sense_of
from .poses import Poses
from .quotients import refused_where
from .solved import solve
from .system import areas
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
    poses = Poses(motion, f"The thrust of {member.name or member}", None if loaded.frictions else names)
    if loaded.frictions:
        solved = solve(poses, loaded)
        locked_words(solved, direction)
        title = member_title(member)
        strut = next(each for each in solved.system.structure.struts if each.line is not None and each.name == title)
        return poses.full(solved.value(solved.system.thrust(strut)))
    return poses.full(by_lines(poses, loaded, holding.lines, member))


def standing_for(motion: Motion, member: TwoPoint) -> TwoPoint:
    """Return the machine's own holding element in whose place another one is tried, between the same points; else the same."""
    own = motion.plan.of_kind(TwoPoint).values()
    if any(same(member, each) for each in own):
        return member
    return next((each for each in own if each.holds and set(each.ends) == set(member.ends)), member)


def own_movement(motion: Motion, member: TwoPoint, direction: str, rates: Mapping[str, Any] | None, line: Line | None) -> Movement:
    """Return how strokes move while a member grows or shrinks: along the path, else by the stroke it holds or follows most."""
    sense = sense_of(direction)
    if rates is not None or not sense:
        return movement_of(motion, direction, rates, None if line is None else line.stroke)
    tangent: Mapping[str, Any] = path_tangent(motion) or {line.stroke if line is not None else stroke_followed(motion.plan, member): 1.0}
    P, Q = member.ends
    growth = sum(motion.ratio(length_of(motion, P, Q), wrt=name) * rate for name, rate in tangent.items())
    way = sense * np.sign(np.nan_to_num(growth))
    return Movement(direction, {name: way * rate for name, rate in tangent.items()}, True)


def length_of(motion: Motion, P: str, Q: str) -> Quantity:
    """Return the distance of two points as a quantity: the declared length where there is one."""
    known = motion.plan.table.lengths.get(frozenset((P, Q)))
    return known if known is not None else Distance(P, Q)


def by_lines(poses: Poses, loaded: Loaded, lines: Sequence[Line], member: TwoPoint) -> FloatArray:
    """Return a holding cylinder's thrust by virtual work on the strokes taken over, shape (n,), frictionless."""
    need = np.stack([by_work(poses, loaded, line.stroke) for line in lines], axis=-1)
    found = shared(poses, lines, member, need, 1)
    if not any(len(line.cylinders) > 1 and any(each.works_both for each in line.cylinders) for line in lines):
        return found[0]
    other = shared(poses, lines, member, need, -1)
    return np.where(found[1] < 0.0, other[0], found[0])


def shared(poses: Poses, lines: Sequence[Line], member: TwoPoint, need: FloatArray, way: int) -> tuple[FloatArray, FloatArray]:
    """Return a cylinder's thrust and that of its line's first (n,), where first cylinders push (`way` 1) or pull (-1)."""
    n, count = poses.count, len(lines)
    levers, sizes, mine = np.zeros((n, count, count)), np.zeros((n, count, count)), (0, np.ones(n))
    for i, line in enumerate(lines):
        weights = areas(line, poses, way)
        for cylinder, weight in zip(line.cylinders, weights, strict=True):
            part = weight / weights[0]
            if same(cylinder, member):
                mine = (i, part)
            for j, other in enumerate(lines):
                lever, size = lever_of(poses, cylinder, other.stroke)
                levers[:, i, j] += part * lever
                sizes[:, i, j] += np.abs(part) * size
    cond = conditions(levers, sizes)
    what = f"The thrust of {member.name or member}"
    whose = "its length stands" if count == 1 else "the lengths of the cylinders stand"
    stands = f"{whose} still against the drive there"
    refused = refused_where(poses, np.zeros(n), cond, f"{what} is refused", stands)
    safe = np.where(np.isnan(refused)[:, None, None], np.eye(count), levers)
    first = need[:, 0] / safe[:, 0, 0] if count == 1 else np.linalg.solve(np.swapaxes(safe, 1, 2), need[:, :, None])[:, mine[0], 0]
    return first * mine[1] + refused, first + refused


def lever_of(poses: Poses, cylinder: TwoPoint, stroke: str) -> tuple[FloatArray, FloatArray]:
    """Return how a cylinder's length grows with a stroke, and how fast its ends part at the most, both (n,)."""
    P, Q = cylinder.ends
    known = poses.plan.table.lengths.get(frozenset((P, Q)))
    if known is not None:
        lever = np.broadcast_to(poses.ratio(known, stroke), (poses.count,))
        return lever, np.full(poses.count, float(np.max(np.abs(lever), initial=0.0)))
    return poses.growth(P, Q, stroke), np.hypot(*(poses.rate(Q, stroke) - poses.rate(P, stroke)))


def conditions(levers: FloatArray, sizes: FloatArray) -> FloatArray:
    """Return how near each matrix of levers (n, k, k) is to a singular one, relative to their sizes; infinite where it is one."""
    columns = sizes.max(axis=1, keepdims=True)
    columns = np.where(columns > 0.0, columns, 1.0)
    rows = (sizes / columns).max(axis=2, keepdims=True)
    scaled = levers / columns / np.where(rows > 0.0, rows, 1.0)
    if levers.shape[1] == 1:
        return condition(scaled[:, 0, 0])
    least = np.linalg.svd(scaled, compute_uv=False)[:, -1]
    with np.errstate(divide="ignore"):
        return np.asarray(1.0 / least)
