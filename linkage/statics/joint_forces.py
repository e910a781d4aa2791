"""Joint forces by equilibrium of every body: on which body, from which body, how large, and how well they balance."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cached_property
from typing import Unpack

import numpy as np

from ..errors import DefinitionError, ensure, known_name, unknown
from ..frozen import immutable
from ..language import said, translated
from ..loads import AS_IT_RUNS, PLAIN_CASE, Acting, ActingKeywords, LinkMass, Load, Loads, situation_of, takes_situation
from ..motion import Motion, drive_kind, require_motion
from ..motion.limits import refuse_at, where_said
from ..motion.requests import stroke_of
from ..plan import Mask
from ..program import FloatArray
from ..quantities import Reference, name_of
from ..shown import Shown
from ..units import UNITS, kN, show
from .applied import applied_loads, rates_in
from .force_program import forces_at
from .joints import FRAME, FRAME_NAME, Structure, acting_place, force_direction
from .poses import FlatPoses, cross
from .solution import PoseForces, check_joints, held_in_case, locked_words
from .vehicle import ground_loads, standing_if_any, tipping_words
from .work import by_work, poses_held, without_held, without_work, work_gap


@takes_situation
def pin_forces(
    motion: Motion, loads: Loads = None, *, drive: str | None = None, split: str = "refuse", **situation: Unpack[ActingKeywords]
) -> PinForces:
    """Return every joint force at every pose, by equilibrium of every body, in one solve over designs and strokes.

    `loads` are the machine's own unless others are given; `case` a LoadCase or its name. `direction` is "extending" (the stroke
    grows), "retracting" or "frictionless". With friction and several strokes `drive` says which one moves, along a path of several
    they move as it goes. `rates`, such as `dict(S=0.05)` [1/s], are what dampers ask for; `acting` says all of these in one. Raises
    DefinitionError where a body hangs loose or a link is redundant (unless `split="least squares"`), SingularError at a singular pose
    and where friction leaves no bounded forces (unless the motion has `unreachable="nan"`).

    Parameters
    ----------
    motion : Motion
        The poses; designs first, strokes last.
    loads : sequence of ForceElement or str, optional
        The loads; by default the machine's own.
    drive : str, optional
        The stroke that moves, where friction acts.
    split : str
        "refuse", or "least squares" for redundant links.
    case, direction, rates, accelerations, inertia, acting : optional
        The situation, as in `Acting`; `acting` gives all in one.

    Returns
    -------
    PinForces
        The forces of all joints [N], and the checks of both methods.

    Raises
    ------
    DefinitionError
        A body hangs loose, or a link is redundant.
    SingularError
        A singular pose, or friction leaves no bounded forces.
    """
    return joint_forces(motion, situation_of("pin_forces", loads=loads, drive=drive, **situation), split)


def joint_forces(motion: Motion, acting: Acting, split: str = "refuse") -> PinForces:
    """Return every joint force at every pose in a situation: `split` as `pin_forces` has it."""
    motion = held_in_case(require_motion(motion)._machine_motion, acting)
    rates = rates_in(motion, acting)
    if acting.drive is not None:
        stroke_of(motion.plan, acting.drive, "drive")
    applied = applied_loads(motion, acting, rates)
    found = agreeing(forces_at(poses_held(motion, applied, "The joint forces"), applied, split), split)
    return PinForces(
        motion, joints_of(found.structure, found.contacts, found.poses), found.drives, found.thrusts, applied.case, rates.direction,
        found.poses.mask(found.locked), tuple(remarks_on(found)), found, split,
    )  # fmt: skip


def agreeing(found: PoseForces, split: str) -> PoseForces:
    """Return forces where they agree with virtual work; SingularError for other poses unless NaN was asked for."""
    lost, words = without_work(found)
    if not lost.any():
        return found
    check_joints(found.structure, found.poses)
    poses, motion = found.poses, found.poses.motion
    remedy = "Leave these poses out; if all are lost, look at what joints() of a step of one's own holds, and where"
    refuse_at(motion, poses.mask(lost), f"{motion.plan.title}: the joint forces are refused", f": {words}. {remedy}.")
    return forces_at(poses.without(lost), found.applied, split)


@immutable
class PinForces(Shown):
    """All joint forces of a motion in one load case and one direction of motion.

    Attributes
    ----------
    motion : Motion
        The poses.
    joints : tuple of JointForce
        The force of each joint, shape (2, ...).
    drives : mapping of str to array
        The generalised forces of the strokes [N or N m].
    thrusts : mapping of str to array
        What each driven length and each two-point element carries [N], positive where it pushes its ends apart.
    case, direction : str
        The load case and the direction of motion.
    locked : array of bool
        Where friction locks the mechanism; there the forces are NaN.
    remarks : tuple of str
        Sentences on where friction locks it, and which dampers do not move.
    """

    motion: Motion
    joints: tuple[JointForce, ...]
    drives: Mapping[str, FloatArray]
    thrusts: Mapping[str, FloatArray]
    case: str
    direction: str
    locked: Mask
    remarks: tuple[str, ...]
    _found: PoseForces
    _split: str

    def __repr__(self) -> str:
        joints = [each for each in self.joints if each.has_force and not np.isnan(each.size).all()]
        greatest = max(joints, key=lambda each: float(np.nanmax(each.size)), default=None)
        worst = "" if greatest is None else f", greatest {greatest}: {float(np.nanmax(greatest.size)) / kN:.4g} kN"
        return f"<PinForces of {self._heading}: {len(self.joints)} joints at {self.motion.reached.size} poses{worst}; print it for all>"

    @property
    def _heading(self) -> str:
        """Of which machine, in which situation."""
        return f"{self.motion.plan.title}, {self.case}, {self.direction}"

    def again(self, motion: Motion) -> PinForces:
        """Return the same of another motion of the machine: the same loads, case, direction and rates; NaN where they are refused.

        Parameters
        ----------
        motion : Motion
            The poses; designs first, strokes last.

        Returns
        -------
        PinForces
            The forces of that motion.
        """
        return joint_forces(require_motion(motion), self._found.applied.acting, self._split)

    @property
    def _structure(self) -> Structure:
        """The bodies and joints of the machine."""
        return self._found.structure

    @property
    def tensions(self) -> Mapping[str, FloatArray]:
        """The tensions of ropes with a held length by their names, shape (...) [N]; below zero they would have to push."""
        return self._found.tensions

    @cached_property
    def members(self) -> Mapping[str, str]:
        """The two-point members by the names of the bodies that they are: their own, of one of two bodies those of both."""
        pairs = {body.name: pair.member.name for pair in self._structure.pairs for body in pair.bodies}
        return {name: name for name in self.thrusts} | pairs

    @property
    def axle_loads(self) -> Mapping[str, FloatArray]:
        """The reactions of the supports under the frame by their names, shape (...) [N]; none for a machine that does not stand on any."""
        found = standing_if_any(self.motion, self._found.applied.acting)
        return {} if found is None else found.reactions

    @cached_property
    def _ground(self) -> tuple[Load, ...]:
        """The ground's forces on a vehicle's frame; none for a machine without supports."""
        return ground_loads(self.motion, self._found.applied.acting)

    @cached_property
    def _loads(self) -> tuple[tuple[str, Load], ...]:
        """The loads with the names of the bodies that they act on, the reactions of a vehicle's supports among them."""
        axles = {each.element for each in self._ground}
        loads = [each for each in self._found.applied.loads if each.element not in axles]
        return tuple((self._body_under(each), each) for each in (*loads, *self._found.run_loads(), *self._ground))

    def _body_under(self, load: Load) -> str:
        """Return the name of the body that a load acts on."""
        return self._structure.name(self._structure.bearer(load))

    def at(self, point: str) -> tuple[JointForce, ...]:
        """Return the joints at a point.

        Parameters
        ----------
        point : str or Point
            The point, or its name.

        Returns
        -------
        tuple of JointForce
            The joints.
        """
        return joints_at(self.joints, point, self.motion.plan.title)

    def force(self, point: str, on: str = "", by: str = "") -> FloatArray:
        """Return the force at a point on a body from the other one, shape (2, ...) [N].

        Where several joints meet, `on` says on which body it acts: by its points, its link's or its element's name; `by` from which
        one. DefinitionError where that leaves a choice.

        Parameters
        ----------
        point : str or Point
            The point, or its name.
        on : str
            The body on which the force acts.
        by : str
            The body from which it comes.

        Returns
        -------
        ndarray
            The force [N], shape (2, ...).

        Raises
        ------
        DefinitionError
            Several joints fit.
        """
        pressed = [each for each in self.joints if each.has_force]
        joint, sign = joint_on(pressed, point, self.body_named(on), self.motion.plan.title, self.body_named(by))
        return sign * joint.force

    def gland(self, member: Reference) -> GlandForce:
        """Return the forces that guide a cylinder's rod in its barrel, where it is two bodies; DefinitionError for any other member.

        Parameters
        ----------
        member : str or Cylinder
            The cylinder, or its name.

        Returns
        -------
        GlandForce
            The forces at the gland.

        Raises
        ------
        DefinitionError
            The member is no cylinder of two bodies.
        """
        name, pairs = name_of(member), {each.member.name: each for each in self._structure.pairs}
        what = f"{self.motion.plan.title}: {name} is no member of two bodies"
        of_two = f"those are {', '.join(pairs)}" if pairs else "give a cylinder barrel_mass=, rod_mass=, or points OnBarrel or OnRod"
        ensure(name in pairs, f"{what}; {of_two}.")
        P, Q = pairs[name].member.ends
        contact = self._structure.sliding_joint(pairs[name], "n")
        joint = self.joints[self._structure.contacts.index(contact)]
        arm = self.motion[Q] - self.motion[P]
        across = cross(arm, joint.force) / np.hypot(arm[0], arm[1])
        return GlandForce(contact.point, across, joint.couple, self.motion[contact.point])

    def on_body(self, name: str) -> Mapping[str, FloatArray]:
        """Return all forces on a body by the point they act at, joints and loads, shape (2, ...) [N]: they balance (for FEM).

        Those on the frame balance where it stands on supports; elsewhere their sum is what the ground has to hold. One that acts
        elsewhere than at a point, such as at the mesh of two gears, goes by its joint, `A (mesh)`; `place` of that joint tells where.
        What a load gives is added to the pin's force at its point. The mass of a body with a centre of its own counts at the body's first
        two points, by forces of the same sum and moment. The force of a pin alone is among `joints`.

        Parameters
        ----------
        name : str
            The body's name.

        Returns
        -------
        mapping of str to ndarray
            The forces [N] by their points, shape (2, ...).
        """
        found = self.body_named(name)
        if found not in self.on_bodies:
            raise unknown("Body", name, self.on_bodies, where=self.motion.plan.title)
        return self.on_bodies[found]

    def body_named(self, name: str) -> str:
        """Return a body's name for one of its aliases; else the name as given.

        Parameters
        ----------
        name : str
            A name of the body.

        Returns
        -------
        str
            Its full name.
        """
        return self._structure.full_name(name)

    @cached_property
    def on_bodies(self) -> Mapping[str, Mapping[str, FloatArray]]:
        """All forces by the body and the point they act at, or the joint where that is no point."""
        structure = self._structure
        found: dict[str, dict[str, FloatArray]] = {structure.name(body): {} for body in range(FRAME, len(structure.bodies))}
        names = [each.point if each.place is None else f"{each.point} ({each.kind})" for each in self.joints]
        pairs = list(zip(names, self.joints, strict=True))
        sides = [side for name, each in pairs for side in ((each.on, name, each.force), (each.by, name, -each.force))]
        for body, point, force in (*sides, *((body, each.point, each.force) for body, each in self._loads)):
            there = found.setdefault(body, {})
            there[point] = there[point] + force if point in there else force
        return found

    @cached_property
    def residual(self) -> float:
        """The largest imbalance of any body over the largest force there is, at the worst pose; moments over the machine's size.

        The frame is one of the bodies where it stands on supports.
        """
        places, sums, largest = {point: self.motion[point] for point in self.motion.plan.points}, dict[str, FloatArray](), np.zeros(())
        extent = max((float(np.nanmax(each, initial=0.0) - np.nanmin(each, initial=0.0)) for each in places.values()), default=1.0) or 1.0
        acts = [(each, places[each.point] if each.place is None else each.place) for each in self.joints]
        forces = [(each.on, place, each.force, each.couple) for each, place in acts]
        forces += [(each.by, place, -each.force, -each.couple) for each, place in acts]
        forces += [(body, places[load.point], load.force, np.zeros(())) for body, load in self._loads]
        for body, place, force, couple in forces:
            row = np.stack(np.broadcast_arrays(*force, (cross(place, force) + couple) / extent))
            sums[body] = sums[body] + row if body in sums else row
            largest = np.maximum(largest, np.hypot(force[0], force[1]))
        held = {body: rows for body, rows in sums.items() if body != FRAME_NAME or self._ground}
        bodies = [np.abs(rows[: 2 if body.startswith("pin ") else 3]).max(axis=0) for body, rows in held.items()]
        worst = np.max(bodies, axis=0, initial=0.0) if bodies else np.zeros(())
        return float(np.nanmax(worst / np.where(largest > 0.0, largest, 1.0), initial=0.0))

    @cached_property
    def gap(self) -> float:
        """The largest difference of the drives' forces to those by virtual work, over the works of the loads; NaN with friction."""
        return work_gap(self._found.poses, without_held(self._found.applied, self._structure.holders), self.drives)

    def __str__(self) -> str:
        units = {name: drive_kind(self.motion.plan, name)[1].replace("kN", "N") for name in self.drives}
        lines = [f"  {name}: {range_text(values, units[name])}" for name, values in self.drives.items()]
        lines += [f"  thrust of {name}: {range_text(values, 'kN')}" for name, values in self.thrusts.items()]
        lines += [f"  tension of {name}: {range_text(values, 'kN')}" for name, values in self.tensions.items()]
        lines += [f"  {each}: {range_text(each.size, 'kN') if each.has_force else range_text(each.couple, 'Nm')}" for each in self.joints]
        lines += [f"  axle load {name}: {range_text(force, 'kN')}" for name, force in self.axle_loads.items()]
        against = "" if np.isnan(self.gap) else f"; against virtual work {self.gap:.0e}"
        lines += [f"  residual of equilibrium {self.residual:.0e}{against}", *(f"  {each}" for each in self.remarks)]
        return "\n".join([self._heading, *lines])


@immutable
class GlandForce:
    """The guiding forces of a cylinder's rod in its barrel: from the barrel on the rod, at the gland, the barrel's end.

    `lateral` is the force across, shape (...) [N], positive to the left of A -> B; `moment` that about the gland, shape (...) [Nm],
    positive counter-clockwise; `place` where that is, shape (2, ...) [m], and `point` its name.
    """

    point: str
    lateral: FloatArray
    moment: FloatArray
    place: FloatArray

    def __str__(self) -> str:
        return f"{self.point}: lateral {range_text(self.lateral, 'kN')}, moment {range_text(self.moment, 'Nm')}"


@immutable
class JointForce:
    """The force of one joint: on the body `on` from the body `by`, shape (2, ...) [N], with a couple (...) [Nm].

    `kind` is a pin, a guide, a slot, a driven point, a crank's drive, a slider or a telescope. `axis` are the two points that give
    the body's own x axis; for the frame it is None. `has_force`: whether it transmits a force; a crank's drive has only a couple.
    `place` is where the force acts, shape (2, ...) [m], where that is not the point, such as the mesh of two gears; else None.
    """

    point: str
    on: str
    by: str
    kind: str
    force: FloatArray
    couple: FloatArray
    axis: tuple[str, str] | None = None
    has_force: bool = True
    place: FloatArray | None = None

    @property
    def size(self) -> FloatArray:
        """The size of the force, shape (...) [N]; of a joint that transmits none, that of its couple [Nm]."""
        return np.asarray(np.hypot(self.force[0], self.force[1]) if self.has_force else np.abs(self.couple))

    def __str__(self) -> str:
        return f"{self.point} ({self.kind}) on {self.on} from {self.by}"


def joints_of(
    structure: Structure, forces: Iterable[tuple[FloatArray, FloatArray]], poses: FlatPoses | None = None
) -> tuple[JointForce, ...]:
    """Return every joint's force, from each contact's force (2, ...) and couple (...), with its place at some poses, if they are given."""
    found = []
    for contact, (force, couple) in zip(structure.contacts, forces, strict=True):
        axis = structure.bodies[contact.on].axis if 0 <= contact.on < len(structure.bodies) else None
        on, by = structure.name(contact.on), structure.name(contact.by)
        place = None
        if poses is not None and not contact.is_at_point:
            origin = acting_place(contact, poses)
            place = None if origin is poses.at(contact.point) else poses.full(origin)
        found.append(JointForce(contact.point, on, by, contact.kind, force, couple, axis, contact.has_force, place))
    return tuple(found)


def joints_at(joints: Sequence[JointForce], point: str, title: str) -> tuple[JointForce, ...]:
    """Return the joints at a point; DefinitionError where there is none."""
    name = known_name("Joint", point, dict.fromkeys(each.point for each in joints), where=title)
    return tuple(each for each in joints if each.point == name)


def joint_on(joints: Sequence[JointForce], point: str, on: str, title: str, by: str) -> tuple[JointForce, float]:
    """Return the one of joints at a point that acts on a body, and -1 where it is seen from the other body, else 1.

    `by` is the body that it comes from, where several press on the first one there.
    """
    found = joints_at(joints, point, title)
    names = dict.fromkeys(name for each in found for name in (each.on, each.by))
    for body in (on, by):
        if body:
            known_name("Body", body, names, where=f"the joint {point} of {title}")
    taken = [(each, 1.0) for each in found if on in ("", each.on) and by in ("", each.by)]
    taken += [(each, -1.0) for each in found if (on or by) and on in ("", each.by) and by in ("", each.on)]
    if len(taken) != 1:
        where = ", ".join(f"on {each.on} from {each.by}" for each in found)
        both = f"say on= the other body, on which it is the opposite, by= too, from which one, or take them from at({point!r})"
        remedy = both if on else "say on= which body"
        raise DefinitionError(f"{title}: several joints meet at {point} ({where}); {remedy}.")
    return taken[0]


def range_text(values: FloatArray, unit: str) -> str:
    """Return a range of values [SI] in words, in the unit given."""
    finite = np.asarray(values)[np.isfinite(values)] / UNITS[unit][0]
    if not finite.size:
        return "no value"
    ends = dict.fromkeys(f"{float(value):.6g}" for value in (finite.min(), finite.max()))
    return f"{' to '.join(ends)} {unit}"


def remarks_on(found: PoseForces) -> Iterator[str]:
    """Yield in words where forces are not as the machine is meant to work: it locks, comes apart, goes slack, tips over."""
    poses, applied = found.poses, found.applied
    yield from locked_words(found, applied.rates.direction)
    yield from lift_off_words(found)
    yield from self_locking_words(found)
    if not applied.loads and not applied.thrusts:
        if applied.acting.case in (None, PLAIN_CASE):
            yield said("no load acts, so that all forces are zero; declare one in the class, such as load = Weight(G, mass=1200).")
        else:
            yield said("No load acts in the load case {case}: all forces there are zero.", case=applied.case)
    motion, rates = require_motion(poses.motion), applied.rates
    if rates.accelerations is not None:
        points = [each.name for each in applied.elements if isinstance(each, LinkMass) and each.at is not None and each.inertia is None]
        if points:
            yield said("{names}: without inertia= a mass counts as a point at its centre.", names=", ".join(points))
    elif (jump := motion._rate_jump) is not None and applied.acting.inertia is None and not isinstance(applied.acting.rates, Mapping):
        yield said("{jump}, so that inertia is left out: give its ramp an acceleration, or take a smooth course.", jump=jump[1])
    if applied.at_rest:
        names = ", ".join(applied.at_rest)
        yield said("{names}: at rest a damper gives nothing; give the speeds, rates=dict(S=0.05).", names=names)
    for name, tension in found.tensions.items():
        slack = tension < 0.0
        if slack.any():
            where, push = where_said(poses.plan, slack, motion.strokes), show(-float(np.nanmin(tension)), "N", 6)
            yield said(
                "{name} goes slack {where}: there it would have to push, with up to {push}, and the constraint is not kept. Hang more "
                "weight on it, or take a rod.",
                name=name, where=where, push=push,
            )  # fmt: skip
    yield from geared_words(found.structure)
    yield from tipping_words(motion, applied.acting)


def geared_words(structure: Structure) -> Iterator[str]:
    """Yield the words for pivots and racks that gears move, the forces between whose teeth are left out."""
    if geared := structure.turned_by_gears():
        yield said("{names}: moved by gears, the forces between whose teeth are left out of the pin forces.", names=", ".join(geared))


def lift_off_words(found: PoseForces) -> Iterator[str]:
    """Yield the words for contacts that would have to pull to hold their bodies together: there these come apart."""
    poses, structure = found.poses, found.structure
    for contact, (force, _) in zip(structure.contacts, found.contacts, strict=True):
        if not contact.joint.pushes:
            continue
        push = (poses.flattened(force) * force_direction(contact, "n", poses)).sum(axis=0)
        mask = poses.mask(push < 0.0)
        if mask.any():
            yield said(
                "{owner} lifts off ({kind}, {body} from {other}) {where}: there the contact would have to pull, with up to {pull}. Press "
                "it on with a spring or a weight.",
                owner=contact.owner, kind=translated(contact.kind), body=structure.name(contact.on), other=structure.name(contact.by),
                where=where_said(poses.plan, mask, poses.motion.strokes), pull=show(-float(np.nanmin(push)), "N", 6),
            )  # fmt: skip


def self_locking_words(found: PoseForces) -> list[str]:
    """Return the words for poses where friction alone holds the load: it drives, and must still be pushed."""
    applied, motion = found.applied, found.poses.motion
    if not applied.frictions or len(applied.rates) != 1:
        return []
    ((stroke, rate),) = applied.rates.items()
    free = found.poses.full(by_work(found.poses, applied, stroke))
    with np.errstate(invalid="ignore"):
        mask = (free * rate < 0.0) & (found.drives[stroke] * rate > 0.0)
    if not mask.any():
        return []
    direction = said("it runs") if applied.rates.direction == AS_IT_RUNS else translated(applied.rates.direction)
    return [
        said(
            "Self-locking while {direction} {where}: friction holds the load, which would move {stroke} without it; the drive must help.",
            direction=direction, where=where_said(motion.plan, mask, motion.strokes), stroke=stroke,
        )
    ]  # fmt: skip
