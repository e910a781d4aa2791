"""Forces as requests: in `evaluate` and `function` at a kernel's speed, in `gradient` with exact derivatives."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Sequence
from dataclasses import replace
from functools import partial
from typing import cast

import numpy as np

from ..errors import DefinitionError, UntracedError, cited, known_name
from ..frozen import FrozenDict, record
from ..language import said
from ..loads import AS_IT_RUNS, FRICTIONLESS, PLAIN, Acting, Case, Loads, TwoPoint, case_in_words, case_title, case_titles, situation_of
from ..motion import Judge, Motion, drive_kind, most, require_motion
from ..motion.requests import stroke_of
from ..plan import Plan
from ..program import FloatArray, Node
from ..units import show
from ..verdict import Remark, Verdict
from .applied import applied_elements, applied_loads, plan_in_case, rates_in
from .holding import closed_ties, holders_of, levers_of, nearness_of, where_held
from .joint_forces import JointForce, PinForces, joint_forces, joint_on, joints_of
from .joints import Contact, Structure
from .law_requests import LawInPlan, LawRequest, TracedMotion, eliminated_forces, law_in_plan, once_in, request_text, situation_identity
from .poses import AnyMotion, FlatPoses
from .solution import Solution, assumed_joints, held_fault, held_in_case, structure_of
from .work import by_work, member_thrust, stroke_force, without_held


def force_request(
    word: str, arguments: Sequence[str], known: Hashable, acting: Acting, formula: Callable[..., FloatArray],
    look_up: Callable[[LawRequest, TracedMotion], LawInPlan],
) -> LawRequest:  # fmt: skip
    """Return a request of a force in a situation, as it is written: a function of that name with these arguments."""
    text = partial(request_text, word, tuple(arguments), moves=True)
    return LawRequest(formula=formula, text=text, known=(word, known), acting=acting, measures="force", look_up=look_up)


def require_rest(request: LawRequest, motion: TracedMotion) -> None:
    """Raise UntracedError where there is friction: it follows from the forces that it changes."""
    acting = request.situation
    as_it_runs = acting.movement == AS_IT_RUNS
    if acting.is_moving or (as_it_runs and any(each.element.frictions(motion) for each in applied_elements(motion.plan, acting))):
        what = f"{motion.plan.title}: {request}: friction gives it values in a direction, and no program that gives derivatives"
        raise UntracedError(f'{what}. Ask with direction="frictionless".')


# The force of a drive.


def drive_force(drive: str | None = None, loads: Loads = None, case: Case = None, *, acting: Acting | None = None) -> LawRequest:
    """Return the request for the generalised force of a stroke, in `evaluate`, `function` and `gradient`: [N], a crank's torque [Nm].

    It is `driving_force(motion, loads, drive, case=case)`, frictionless: `motion.gradient(drive_force(), wrt=["OB", "load.mass"])`.
    `acting` says loads, case and rates in one. With a direction too it has values and no derivatives.
    A load's law must be plain arithmetic of numbers at one pose; DefinitionError, with the load's name, where it is not.

    Parameters
    ----------
    drive : str, optional
        The stroke, where there are several.
    loads : sequence of ForceElement or str, optional
        The loads; by default the machine's own.
    case : LoadCase or str, optional
        A load case, or its name.
    acting : Acting, optional
        Loads, load case, direction and rates in one.

    Returns
    -------
    Request
        The force [N], of a crank the torque [N m].

    Raises
    ------
    DefinitionError
        A load's law cannot be traced.
    """
    given = situation_of("drive_force", acting, loads=loads, case=case)

    def formula(motion: AnyMotion, acting: Acting) -> FloatArray:
        """Return it over a motion's poses; of a traced one as a number of the program."""
        if not isinstance(motion, TracedMotion):
            return stroke_force(require_motion(motion), acting, drive)
        applied = applied_loads(motion, acting, rates_in(motion, acting))
        applied = without_held(applied, holders_of(motion.plan, applied.elements))
        (force,) = by_work(FlatPoses(motion, ""), applied, stroke_of(motion.plan, drive, "drive"))
        return cast(FloatArray, force)

    def look_up(request: LawRequest, motion: TracedMotion) -> LawInPlan:
        require_rest(request, motion)

        def trace(traced: TracedMotion) -> tuple[TracedMotion, Node]:
            return traced, traced.node(request.law(traced))

        return law_in_plan(motion, trace, f"the driving force of {stroke_of(motion.plan, drive, 'drive')}")

    def measured(plan: Plan) -> str:
        return drive_kind(plan, stroke_of(plan, drive, "drive"))[0]

    return replace(force_request("drive_force", [drive] if drive else [], drive, given, formula, look_up), measured_in=measured)


# The force at a joint.


COMPONENTS = "x", "y", "couple", "size"
"""What can be asked of a joint: the parts of its force, its couple, the size of its force."""


@record
class JointPart:
    """Which part of which joint's force is meant: at a point, on a body from another one, its size or its part along x or y."""

    point: str
    on: str
    by: str
    component: str

    def force_over(self, motion: AnyMotion, acting: Acting) -> FloatArray:
        """Return it over a motion's poses [N], shape (...)."""
        known_name("Component", self.component, COMPONENTS, where=f"{motion.plan.title}: the force at {self.point}")
        asked = require_motion(motion)
        asked._refuse_part(f"the force at {self.point}")
        found = pin_forces_under(asked, acting)
        structure = found._structure
        full = replace(self, on=structure.full_name(self.on), by=structure.full_name(self.by))
        contact, joint, sign = full.contact(structure)
        joint = found.joints[structure.contacts.index(contact)]
        return np.asarray(self.of(sign * joint.force, sign * joint.couple))

    def of(self, force: FloatArray, couple: FloatArray) -> FloatArray:
        """Return it of a joint's force (2, ...) and couple (...)."""
        return cast(FloatArray, np.hypot(*force) if self.component == "size" else (*force, couple)[COMPONENTS.index(self.component)])

    def contact(self, structure: Structure) -> tuple[Contact, JointForce, float]:
        """Return the contact that is meant, its joint without a value, and the sign of its force on the body."""
        joints = joints_of(structure, [(np.zeros(2), np.zeros(()))] * len(structure.contacts))
        turns = self.component == "couple"
        meant = [joint for each, joint in zip(structure.contacts, joints, strict=True) if ("c" in each.holds if turns else each.has_force)]
        joint, sign = joint_on(meant, self.point, self.on, structure.plan.title, self.by)
        return structure.contacts[joints.index(joint)], joint, sign

    def in_plan(self, request: LawRequest, motion: TracedMotion) -> LawInPlan:
        """Return its law in the plan of a traced motion, where its bodies have their full names."""
        require_rest(request, motion)
        known_name("Component", self.component, COMPONENTS, where=f"{motion.plan.title}: the force at {self.point}")
        structure, acts = structure_in_plan(motion, request.situation)
        full = replace(self, on=structure.full_name(self.on), by=structure.full_name(self.by))
        _, joint, _ = full.contact(structure)
        what = {"size": "the size of the force", "couple": "the couple"}.get(self.component, f"the {self.component} component of the force")
        every, shared = frozenset(motion.plan.members), ("pin forces", acts)
        trace = partial(full.traced_part, request.situation, shared)
        return LawInPlan(("pin force", full, acts), every, FrozenDict(dict.fromkeys(every, 2)), trace, shared, f"{what} at {joint}")

    def traced_part(self, acting: Acting, shared: Hashable, motion: TracedMotion) -> tuple[TracedMotion, Node]:
        """Return it on a program, on which all joint forces are traced once for all that are asked for: they are kept as `shared`."""
        kept = motion.plan.trace.cache
        if shared not in kept:  # the notes say that the joints hold what they are said to
            motion = held_in_case(motion, acting)
            applied = applied_loads(motion, acting, rates_in(motion, acting))
            system, u = eliminated_forces(structure_of(motion.plan, applied.elements, applied.thrusts), motion, applied)
            holders = system.structure.holders
            if holders.lines and not holders.changes_shares:  # without a value where the cylinders do not hold, as their thrusts
                u = where_held(nearness_of(holders, [levers_of(system.poses, holders, holders.senses[0])]), u)
            for each in assumed_joints(system.structure, system.poses):
                motion.notes.assumed.setdefault(motion.node(each[0]), "its joints")
            kept[shared] = motion, Solution(system, u, np.zeros((1, 0)), np.zeros(1, bool))
        motion, solution = cast(tuple[TracedMotion, Solution], kept[shared])
        contact, _, sign = self.contact(solution.system.structure)
        force, couple = solution.transmitted(contact)
        return motion, motion.node(self.of(sign * force[:, 0], sign * couple[0]))


def structure_in_plan(motion: TracedMotion, acting: Acting) -> tuple[Structure, tuple[Hashable, ...]]:
    """Build bodies and joints for one situation of a traced motion; also return a key of the loads in it.

    Of the machine's own loads it is worked out once for all joints; given loads are not kept alive.
    """
    kept, key = motion._reading.cache, ("acts", situation_identity(acting))
    if key in kept:
        return cast("tuple[Structure, tuple[Hashable, ...]]", kept[key])
    motion = held_in_case(motion, acting)
    applied = applied_loads(motion, acting, rates_in(motion, acting))
    structure = structure_of(motion.plan, applied.elements, applied.thrusts)
    loads = ((each.point, each.on, *(motion.node(part).number for part in each.force)) for each in applied.loads)
    thrusts = ((each.name, each.member.ends, motion.node(each.thrust).number) for each in applied.thrusts)
    struts = ((strut.name, strut.P, strut.Q) for strut in structure.struts)
    found = structure, (motion._reading.graph, *loads, *thrusts, *motion.notes.assumed, None, *motion.notes.switches, *struts)
    if acting.loads is None and situation_identity(acting) is not None:
        kept[key] = found
    return found


def pin_force(
    point: str, on: str = "", component: str = "size", loads: Loads = None, case: Case = None, *, acting: Acting | None = None,
    by: str = "",
) -> LawRequest:  # fmt: skip
    """Return the request for a joint force [N], in `evaluate`, `function` and `gradient`: its "size", its part along "x" or "y".

    Of a slide, or of a crank's drive, also its "couple" [N m].

    It is that of `pin_forces(motion, loads, case=case).force(point, on)`, frictionless: on the body `on` from the other one, `by`
    where several meet there.
    `acting` says loads, case and rates in one. With a direction or a drive too it has values and no derivatives.
    A load's law must be plain arithmetic of numbers at one pose; DefinitionError, with the load's name, where it is not.

    Parameters
    ----------
    point : str or Point
        The point, or its name.
    on : str
        The body on which the force acts.
    component : str
        "size", "x", "y" or "couple".
    loads : sequence of ForceElement or str, optional
        The loads; by default the machine's own.
    case : LoadCase or str, optional
        A load case, or its name.
    acting : Acting, optional
        Loads, load case, direction and rates in one.
    by : str
        The body from which it comes.

    Returns
    -------
    Request
        The force [N], or the couple [N m].

    Raises
    ------
    DefinitionError
        A load's law cannot be traced.
    """
    names: tuple[object, ...] = point, on, by
    if not all(isinstance(each, str) for each in names):
        said = "the names of a point and of a body are expected"
        raise DefinitionError(f'pin_force({cited(point)}, {cited(on)}): {said}, such as pin_force("G", "arm").')
    given, joint = situation_of("pin_force", acting, loads=loads, case=case), JointPart(point, on, by, component)
    shown = [each for each in (on, by and f"by={by}", "" if component == "size" else f"component={component}") if each]
    found = force_request("pin_force", [point, *shown], joint, given, joint.force_over, joint.in_plan)
    return replace(found, measures="moment") if component == "couple" else found


def pin_forces_under(motion: Motion, acting: Acting) -> PinForces:
    """Return all joint forces of a motion in a situation, worked out once for all that ask for one of them."""
    return once_in(motion, acting, "pin forces", partial(joint_forces, motion, acting))


# What a member carries.


def thrust_from_forces(member: str) -> LawRequest:
    """Return the request for the thrust of a driven length or a two-point element, `pin_forces(motion).thrusts`, by its name."""

    def formula(motion: AnyMotion, acting: Acting) -> FloatArray:
        return np.asarray(pin_forces_under(require_motion(motion), acting).thrusts[member])

    def look_up(request: LawRequest, motion: TracedMotion) -> LawInPlan:
        raise UntracedError(f"{motion.plan.title}: {request}: it has values, and no program that gives derivatives.")

    return force_request("thrust", [member], member, PLAIN, formula, look_up)


# What is said of any machine's forces: that it is not held, and what the drives of strokes give that no cylinder holds.


def held_verdict(judge: Judge) -> Verdict | None:
    """Return the verdict that a machine is not held, of all load cases that a judge looks at; None where it is held in all."""
    for case in dict.fromkeys(case for place in judge.places for case in place.cases(judge.acting)):
        fault = held_fault(judge.motion, case)
        if fault:
            is_own = plan_in_case(judge.plan, Acting(case=case)) is judge.plan
            title = case_title(case, case_titles(judge.plan))
            return Verdict("held", False, fault if is_own else said("in load case {case}, {sentence}", case=title, sentence=fault))
    return None


LEAST = 1e-3
"""N or Nm: less than this is no force of a drive."""


def own_drive_force(plan: Plan, drive: str, case: Case) -> LawRequest:
    """Return the request for what is left to the drive of a stroke that no cylinder holds, beside the cylinders that push on it.

    With friction it is that at rest.
    """
    asked, in_case = drive_force(drive, case=case), plan_in_case(plan, Acting(case=case))
    if not any(drive in plan.reaches(*each.ends) for each in holders_of(in_case).every_cylinder):
        return asked

    def formula(motion: AnyMotion, acting: Acting) -> FloatArray:
        found = asked.formula(motion, acting)
        for each in holders_of(motion.plan).every_cylinder:
            if drive in motion.plan.reaches(*each.ends):
                found = found - member_thrust(motion, each, acting) * each.growth(motion, {drive: 1.0})
        return found

    return replace(asked, formula=formula, known=("own drive", asked.known), directions=(FRICTIONLESS,))


def drive_remarks(judge: Judge) -> list[Remark]:
    """Return the forces of drives of strokes that no cylinder holds, of one design of a machine with cylinders.

    Strokes that put oil into closed lines or wind ropes are held by these; in a load case that shuts a line, others may be.
    """
    plan = judge.plan
    if not any(each.holds for each in plan.of_kind(TwoPoint).values()) or any(map(np.ndim, judge.designs.values())):
        return []
    held = {}
    for case in judge.cases:
        in_case = plan_in_case(plan, Acting(case=case))
        held[case] = set(holders_of(in_case).strokes_taken)
        for tie in closed_ties(in_case):
            held[case].update(tie.run.strokes if tie.run is not None else (), in_case.reaches(tie.added) if tie.added is not None else ())
    loose = {name: [case for case, strokes in held.items() if name not in strokes] for name in plan.strokes}
    asked = [(name, case) for name, cases in loose.items() for case in (cases if len(cases) < len(held) else [""])]
    answers = judge.lost_allowed().answers([most(abs(own_drive_force(plan, name, case or None))) for name, case in asked]) if asked else []
    found: dict[str, tuple[float, Remark]] = {}
    for (name, case), answer in zip(asked, answers, strict=True):
        size = float(answer.value)
        if size > max(LEAST, found[name][0] if name in found else 0.0):
            shown = show(size, drive_kind(plan, name)[1], 4)
            force = said("a force that grows without bounds") if np.isinf(size) else said("up to {force}", force=shown)
            what = said("{stroke} is held by no cylinder: its drive gives {force}", stroke=name, force=force)
            found[name] = size, Remark(f"{what}, {case_in_words(case, answer.titles) + ', ' if case else ''}{answer.place}.")
    return [remark for _, remark in found.values()]
