"""Forces by virtual work, through the exact transfer ratios: a stroke's generalised force, and one straight member's thrust."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Iterator, Mapping
from dataclasses import replace
from functools import partial, reduce
from typing import TypeVar, Unpack
from weakref import ref

import numpy as np

from ..errors import DefinitionError, UntracedError, ensure, heard, warn
from ..loads import Acting, ActingKeywords, Loads, TwoPoint, situation_of, takes_situation
from ..loads.element import AS_IT_RUNS, AT_REST, SENSES, ForceElement, Rate, Rates
from ..motion import Motion, require_motion
from ..motion.requests import stroke_of
from ..plan import Mask
from ..program import FloatArray, is_traced
from ..quantities import needs
from ..units import require_number
from .applied import AppliedLoads, applied_elements, applied_loads, member_title, path_tangent, rates_in
from .force_program import forces_at
from .holding import Holders, Levers, PressureLine, alone, holders_of, is_among, same, settled, stroke_followed, with_levers
from .law_requests import TracedMotion, is_unchanging, once_in
from .poses import AnyMotion, FlatPoses, motion_of_whole, plan_of
from .solution import AGREES, LEAST, PoseForces, disagreeing, held_in_case, locked_words

Made = TypeVar("Made")


@takes_situation
def driving_force(
    motion: Motion, loads: Loads = None, drive: str | None = None, *, efficiency: float = 1.0, **situation: Unpack[ActingKeywords]
) -> FloatArray:
    """Return the generalised force of a stroke by virtual work, shape (...): [N], for a crank's angle the torque [Nm].

    It is positive the way the stroke grows, and not a cylinder's thrust. With `AB=L0 - S` a positive one pulls, with `AB=L0 + 2 * S`
    it is twice the thrust, which `pin_forces(...).thrusts` and a cylinder's own `thrust(motion)` tell.
    `loads` are the machine's own unless others are given; `case` a LoadCase or its name. While "extending" (the stroke grows) or
    "retracting" friction adds its work; along a path of several strokes its senses are those of the path. `rates`, such as
    `dict(S=0.05)` [1/s], are what dampers ask for; `acting` says all of these in one. Given as an `efficiency` k, the force is F / k
    where the load resists and F k where it drives. Raises SingularError at a dead point and where friction locks the mechanism.

    Parameters
    ----------
    motion : Motion
        The poses; designs first, strokes last.
    loads : sequence of ForceElement or str, optional
        The loads; by default the machine's own.
    drive : str, optional
        The stroke, where there are several.
    efficiency : float
        The efficiency, 0 to 1.
    case, direction, rates, accelerations, inertia, acting : optional
        The situation, as in `Acting`; `acting` gives all in one.

    Returns
    -------
    ndarray
        The force [N], of a crank the torque [N m], shape (...).

    Raises
    ------
    SingularError
        A dead point, or friction locks the mechanism.
    """
    acting = situation_of("driving_force", loads=loads, **situation)
    return stroke_force(motion, acting, acting.drive if drive is None else drive, efficiency)


def stroke_force(motion: Motion, acting: Acting, drive: str | None, efficiency: float = 1.0) -> FloatArray:
    """Return the generalised force of a stroke in a situation, shape (...): of `drive`, the only one where that is None."""
    stroke = stroke_of(require_motion(motion).plan, drive, "drive")
    held = motion_of_whole(motion, motion.plan.members[stroke])
    if held is not None:
        whole, own = held
        return stroke_force(whole, replace(acting, drive=own.name), own.name, efficiency)
    motion = held_in_case(motion, acting)
    rates = rates_in(motion, acting, stroke)
    applied = applied_loads(motion, acting, rates)
    names = {name for point in applied.points for name in motion.plan.reaches(point)}
    poses = FlatPoses(motion, f"The driving force of {stroke}", None if applied.frictions else names)
    force = by_work(poses, without_held(applied, holders_of(motion.plan, applied.elements)), stroke)
    if applied.frictions:
        found = forces_at(poses, applied)
        locked_words(found, rates.direction)
        if tuple(rates) == (stroke,) and not rates.is_timed:
            lost = (each * joint.rate for each, joint in zip(found.q, found.frictions, strict=True))  # never negative
            force = force + rates.sense * sum(lost, np.zeros(poses.count))
        else:
            force = poses.flattened(found.drives[stroke])
    require_number("efficiency", efficiency, "a number above 0 and up to 1 is expected", above=0.0, most=1.0)
    ensure(efficiency == 1.0 or rates.sense, 'An efficiency works against the motion: say direction="extending" or "retracting".')
    return poses.full(np.where(force * rates.sense > 0.0, force / efficiency, force * efficiency))


# The work of the loads.


def by_work(poses: FlatPoses, applied: AppliedLoads, drive: str) -> FloatArray:
    """Return the force of a drive that balances the loads [N or Nm], shape (n,): minus their work on a unit of its stroke."""
    moving, work = poses.plan.moving, np.zeros(poses.count)
    for load in applied.loads:
        if load.point in moving:
            work = work + (poses.flattened(load.force) * poses.rate(load.point, drive)).sum(axis=0)
    for push in applied.thrusts:
        P, Q = push.member.ends
        if {P, Q} & set(moving):
            work = work + poses.flattened(push.thrust) * poses.growth(P, Q, drive)
    return np.asarray(0.0 - work)


def work_gap(poses: FlatPoses, applied: AppliedLoads, drives: Mapping[str, FloatArray]) -> float:
    """Return the largest difference between the drives' forces by equilibrium and by work, over the loads' powers; NaN with friction."""
    if applied.frictions:
        return float("nan")
    worst = 0.0
    for _, missed, power in work_misses(poses, applied, drives):
        most = float(np.nanmax(missed, initial=0.0))
        worst = max(worst, most / power if power > 0.0 else most)
    return worst


def without_held(applied: AppliedLoads, holders: Holders) -> AppliedLoads:
    """Return the loads without the laws' thrusts in holding members; these carry the sum that their strokes need."""
    held = holders.every_cylinder
    return replace(applied, thrusts=tuple(each for each in applied.thrusts if not is_among(each.member, held)))


def work_misses(poses: FlatPoses, applied: AppliedLoads, drives: Mapping[str, FloatArray]) -> Iterator[tuple[str, FloatArray, float]]:
    """Yield each drive with the difference of its forces by equilibrium and by work (n,), and the largest power of the loads.

    A load's power counts as force times way, whatever the angle between them. Where loads balance each other, as counterweights do, or
    do no work, the drive's own force is nearly nothing.
    """
    sizes = [(each.point, np.hypot(*poses.flattened(each.force))) for each in applied.loads]
    sizes += [(end, np.abs(poses.flattened(push.thrust))) for push in applied.thrusts for end in push.member.ends]
    for name, force in drives.items():
        powers = sum((size * np.hypot(*poses.rate(point, name)) for point, size in sizes), np.zeros(poses.count))
        yield name, np.abs(poses.flattened(force) - by_work(poses, applied, name)), float(np.max(powers, initial=0.0))


def without_work(found: PoseForces) -> tuple[Mask, str]:
    """Return the poses (n,) at which a drive's force by equilibrium differs from that by virtual work, and which in words.

    Poses near singular ones lose as much as they are said to. With friction it says nothing.
    """
    poses, applied, lost, words = found.poses, found.applied, np.zeros(found.poses.count, bool), ""
    if applied.frictions:
        return lost, words
    for name, missed, power in work_misses(poses, without_held(applied, found.structure.holders), found.drives):
        size = power or max((float(np.max(np.abs(each.force), initial=0.0)) for each in applied.loads), default=0.0)
        bad = disagreeing(poses, missed, AGREES * size + LEAST, size)
        if bad.any() and not words:
            worst = int(np.argmax(np.where(bad, missed, -1.0)))
            ours, theirs = poses.flattened(found.drives[name])[worst], by_work(poses, applied, name)[worst]
            words = f"the force of {name} is {ours:.6g} by the equilibrium of the joints and {theirs:.6g} by virtual work"
        lost |= bad
    return lost, words


# What one straight two-point member carries: a cylinder that holds, a cylinder on a charged line, a spring.


def member_thrust(motion: AnyMotion, member: TwoPoint, acting: Acting) -> FloatArray:
    """Return the thrust of a two-point member, shape (...) [N], positive where it pushes its ends apart.

    Of one that holds, by virtual work on the strokes that the cylinders have taken over; with friction by equilibrium. Of one with a
    law of its own, that. One that is not of the class replaces the class's cylinder between the same points.
    The direction is the member's own: "extending" while it grows, whatever that makes of the strokes. Raises DefinitionError for one
    that neither holds nor has a law here, SingularError where its length stands still against its drive.
    """
    held = motion_of_whole(motion, member)
    if held is not None:
        return member_thrust(*held, acting)
    made = partial(member_thrust_on, motion, member, acting)
    if not is_unchanging(member):
        return made()
    found, near = once_in(motion, acting, ("thrust", plan_of(motion), ref(member)), partial(heard, made))
    for each in near:  # whoever asks is warned
        warn(each)
    return found if is_traced(found) else found.copy()


def member_thrust_on(motion: AnyMotion, member: TwoPoint, acting: Acting) -> FloatArray:
    """Return the same of a motion's own plan, worked out anew."""
    plan_of(motion)
    motion = held_in_case(motion, acting)
    plan, own = motion.plan, motion.plan.of_kind(TwoPoint).values()
    if not is_among(member, own):  # it is tried in the place of the machine's own one between the same points
        member = next((each for each in own if each.holds and set(each.ends) == set(member.ends)), member)
    holders = holders_of(plan, [*(each.element for each in applied_elements(plan, replace(acting, case=None))), member])
    line = holders.line_of(member)
    rates = member_rates(motion, member, acting, line if line in holders.lines else None)
    if rates.has_friction and not rates.is_timed:
        elements = applied_elements(plan, acting)
        if not any(each.in_case.heeds_direction(motion) or each.element.frictions(motion) for each in elements):
            return member_thrust(motion, member, replace(acting, direction=None, drive=None))  # as at rest, which is shared
    applied = shared_by_cylinders(motion, acting, rates, "applied", lambda: applied_on(motion, acting, rates))
    laws = [each.thrust for each in applied.thrusts if same(each.member, member)]
    if line is None:
        if not laws:
            why = "it does not hold, and no element among these loads gives its force"
            raise DefinitionError(f"{plan.title}: {member.name or member} carries nothing here: {why}.")
        return np.where(motion.reached, sum(laws, np.zeros(motion.shape)), np.nan)
    what = f"The thrust of {member.name or member}"
    found = with_friction(motion, applied, what)
    if found is not None:
        return found.thrusts[member_title(member)]
    ends = (end for each in (holders.every_cylinder if holders.closed else line.cylinders) for end in each.ends)
    poses, levers, (need, cuts) = frictionless(motion, applied, acting, rates, holders, ends, what)
    thrusts = [each.thrust(holders, member, need, cuts) for each in levers]
    units = [np.moveaxis(each.thrusts(need), 1, 0) for each in levers] if len(levers) > 1 else []
    return poses.full(sum(map(poses.flattened, laws), settled(holders, units, thrusts)))[()]


def pump_thrust(motion: AnyMotion, element: TwoPoint, acting: Acting) -> FloatArray:
    """Return the thrust of a cylinder [N] less that of its closed lines, which its bounds leave out."""
    thrust, closed = member_thrust(motion, element, acting), element.closed_thrust(motion, acting)
    return thrust if closed is None else thrust - closed


def closed_force(motion: AnyMotion, element: ForceElement, acting: Acting) -> FloatArray | None:
    """Return the force of a closed tie by the work on its input, shape (...); None where the element has a free length or volume.

    A direction is that of the strokes. SingularError where friction locks the mechanism.
    """
    plan_of(motion)
    motion = held_in_case(motion, acting)
    holders = holders_of(motion.plan, [*(each.element for each in applied_elements(motion.plan, replace(acting, case=None))), element])
    line = next((each for each in holders.closed if each.tie is not None and each.tie.name == element.name), None)
    if line is None:
        return None
    rates = rates_in(motion, acting)
    applied = shared_by_cylinders(motion, acting, rates, "applied", lambda: applied_on(motion, acting, rates))
    what = f"The force of {element.name}"
    found = with_friction(motion, applied, what)
    if found is not None:
        return found.runs[element.name]
    points = (*(end for each in holders.every_cylinder for end in each.ends), *needs(element))
    poses, levers, (need, cuts) = frictionless(motion, applied, acting, rates, holders, points, what)
    units = [np.moveaxis(each.thrusts(need) if holders.lines else need, 1, 0) for each in levers]
    forces = [each.kept_force(holders.closed.index(line), list(unit), cuts) for each, unit in zip(levers, units, strict=True)]
    return poses.full(settled(holders, units, forces))[()]


def with_friction(motion: AnyMotion, applied: AppliedLoads, what: str) -> PoseForces | None:
    """Return all forces where friction has a part in them; None where it has none. UntracedError for a program."""
    if not applied.frictions:
        return None
    if isinstance(motion, TracedMotion):
        rubbing = [each.name or str(each) for each in applied.elements if each.frictions(motion)]
        what = f"{motion.plan.title}: the friction of {', '.join(rubbing)} follows from the forces that it changes and has no program"
        remedy = f'Ask while nothing rubs, direction="frictionless", or leave {rubbing[0]} out by a LoadCase'
        raise UntracedError(f"{what}: there are values, and no derivatives. {remedy}.")
    found = forces_at(poses_held(require_motion(motion), applied, what), applied)
    locked_words(found, applied.rates.direction)
    return found


def frictionless(
    motion: AnyMotion, applied: AppliedLoads, acting: Acting, rates: Rates, holders: Holders, points: Iterable[str], what: str
) -> tuple[FlatPoses, tuple[Levers, ...], tuple[FloatArray, list[FloatArray]]]:
    """Return the poses at which cylinders hold, their levers there, and their needs by virtual work.

    That is what the strokes that are taken over need, shape (n, lines), and what changes closed lines, (n,) each. `points` are those that
    forces hang on, besides those that carry loads.
    """
    names = {name for point in (*applied.points, *points) for name in motion.plan.reaches(point)}
    poses, levers = with_levers(FlatPoses(motion, what, names), holders, what)

    def needed() -> tuple[FloatArray, list[FloatArray]]:
        ways = [alone(poses.motion, holders.closed, line.stroke).items() for line in holders.lines]
        found = [reduce(np.add, (by_work(poses, applied, name) * poses.flattened(rate) for name, rate in way)) for way in ways]
        need = np.stack(found, axis=-1) if found else np.zeros((poses.count, 0))
        return need, [by_work(poses, applied, line.stroke) for line in holders.closed]

    return poses, levers, shared_by_cylinders(motion, acting, rates, ("needs", holders.every_line, poses.good.tobytes()), needed)


def shared_by_cylinders(motion: AnyMotion, acting: Acting, rates: Rates, what: Hashable, make: Callable[[], Made]) -> Made:
    """Return a shared result of all cylinders for the same loads on a motion, cached; made each time where its movement depends on one."""
    return once_in(motion, acting, ("held", what), make) if rates is AT_REST or rates.is_timed else make()


def applied_on(motion: AnyMotion, acting: Acting, rates: Rates) -> AppliedLoads:
    """Return the loads that act, at a motion's poses or as nodes; UntracedError where a program cannot follow them."""
    applied = applied_loads(motion, acting, rates)
    if isinstance(motion, TracedMotion) and rates and not rates.is_timed and len(motion.plan.strokes) > 1:
        numbers = []
        for some in (applied, applied_loads(motion, acting, AT_REST)):
            parts = [*(part for each in some.loads for part in each.force), *(each.thrust for each in some.thrusts)]
            numbers.append([motion.node(each) for each in parts])
        if numbers[0] != numbers[1]:
            what = f"{motion.plan.title}: what rubs acts along the path of several strokes, so that no program gives it pose by pose"
            raise UntracedError(f"{what}; ask a motion, or while nothing rubs.")
    return applied


def poses_held(motion: Motion, applied: AppliedLoads, what: str) -> FlatPoses:
    """Return the poses at which a motion's forces can be worked out: not singular, and held by the cylinders that hold."""
    poses = FlatPoses(motion, what)
    holders = holders_of(motion.plan, applied.elements)
    return with_levers(poses, holders, what)[0] if holders.lines else poses


def member_rates(motion: AnyMotion, member: TwoPoint, acting: Acting, line: PressureLine | None) -> Rates:
    """Return how strokes move while a member grows or shrinks: along the path, else by the stroke it holds or follows most."""
    direction, sense = acting.movement, SENSES[acting.movement]
    moves = rates_in(motion, replace(acting, direction=None if acting.is_moving else acting.direction, drive=None))
    if not acting.is_moving or moves.direction == AS_IT_RUNS:
        return moves  # over a path in time it goes as that runs, whichever direction is looked at
    if moves:
        growth = member.growth(motion, moves)
        if np.any(sense * (growth if is_traced(growth) else np.nan_to_num(growth)) < 0.0):
            what = f"{member.name or member}: direction={direction!r} is its own, and at these rates it goes the other way at some poses"
            raise DefinitionError(f"{motion.plan.title}: {what}; drop one of them.")
        return Rates(moves, True, direction, moves.accelerations)
    tangent: Mapping[str, Rate] = path_tangent(motion) or {line.stroke if line is not None else stroke_followed(motion.plan, member): 1.0}
    growth = member.growth(motion, tangent)
    way = sense * np.sign(growth if is_traced(growth) else np.nan_to_num(growth))
    return Rates({name: way * rate for name, rate in tangent.items()}, direction=direction)
