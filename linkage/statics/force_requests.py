"""Forces as requests: in `evaluate` and `function` at a kernel's speed, in `gradient` with exact derivatives."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Self, cast, final
from weakref import ref

import numpy as np

from ..errors import DefinitionError, UntracedError, cited, known_name
from ..loads import AT_REST, DIRECTIONS, FRICTIONLESS, Acting, Case, ForceElement, LoadCase, Loads, situation_of
from ..motion import Motion, require_motion, stroke_unit
from ..motion.requests import stroke_of
from ..plan import Plan
from ..program import FloatArray
from ..vectors import Scalar
from .agreement import assumed_joints
from .joint_forces import JointForce, PinForces, joint_forces, joint_on, joints_of
from .joints import Contact, Structure
from .law_requests import LawInPlan, LawRequest, TracedLaw
from .poses import AnyMotion, FlatPoses
from .solution import Solution
from .traced_loads import TracedMotion, eliminated_forces, traced_apart, traced_loads
from .work import by_work, stroke_force


def situation_identity(acting: Acting) -> Hashable:
    """Return what tells loads in a load case from others, which it does not keep alive; None where one of them may change.

    The direction and the drive are not in it. Members that were declared do not change, nor do frozen dataclasses. What their laws
    compute with is taken not to change either.
    """
    loads = acting.loads
    listed = () if loads is None else loads if isinstance(loads, (list, tuple)) else (loads,)
    given = (acting.case, *listed)
    parts = [each if each is None or isinstance(each, str) else ref(each) if is_unchanging(each) else ... for each in given]
    return None if acting.rates is not None or ... in parts else (loads is None, *parts)


def case_words(case: Case) -> list[str]:
    """Return a load case as an argument in words; nothing of none."""
    return [] if case is None else [f"case={case if isinstance(case, str) else case.name or case.label}"]


def is_unchanging(thing: object) -> bool:
    """Return whether loads or a load case cannot change: members of a class, and frozen dataclasses."""
    if not isinstance(thing, (ForceElement, LoadCase)):
        return False
    settings = vars(type(thing)).get("__dataclass_params__")
    return bool(thing._class) or (settings is not None and settings.frozen)


@dataclass(frozen=True, eq=False)
class ForceRequest(LawRequest):
    """The base of requests of forces: under which loads, in which load case and movement."""

    acting: Acting

    def under(self, acting: Acting, *, keep: bool = False) -> Self:
        found = self.acting.within(acting, "" if keep else str(self))
        return self if found == self.acting else replace(self, acting=found)

    @property
    def of_strokes(self) -> bool:
        return True

    def movements(self, plan: Plan, rubs: bool) -> tuple[str, ...]:
        return DIRECTIONS if rubs else DIRECTIONS[:1]

    def identified(self, *what: Hashable) -> Hashable:
        """Return what tells it from others: what it is of, and in which situation; None where that may change."""
        loads = situation_identity(self.acting)
        return None if loads is None else (*what, loads, self.acting.movement, self.acting.drive)

    @property
    def acting_words(self) -> list[str]:
        """The situation as arguments in words."""
        direction = [] if self.acting.direction is None else [f"direction={self.acting.direction}"]
        return [*case_words(self.acting.case), *direction, *([f"drive={self.acting.drive}"] if self.acting.drive else [])]

    def bound(self, plan: Plan) -> Self:
        return super().bound(plan) if self.acting.loads is None else self._bound(plan)

    def examine(self, plan: Plan) -> None:
        """Raise UntracedError while it moves, for friction follows from the forces that it changes."""
        if self.acting.movement != FRICTIONLESS or self.acting.rates is not None:
            raise UntracedError(f"{plan.title}: {self}: while it moves it has values, and no program that gives derivatives. Ask at rest.")

    def traced(self, motion: TracedMotion) -> TracedLaw:
        return TracedLaw(motion, motion.node(self.law(motion)))

    @property
    def sentence(self) -> str:
        return str(self) if self._in_plan is None else self._in_plan.words


@final
@dataclass(frozen=True, eq=False)
class DriveForce(ForceRequest):
    """The force of a drive, as something to ask for."""

    drive: str | None = None

    def identity(self, plan: Plan) -> Hashable:
        return self.identified("drive force", self.drive)

    def measured(self, plan: Plan) -> str:
        return "force" if stroke_unit(plan, stroke_of(plan, self.drive, "drive")) == "m" else "moment"

    def law(self, motion: AnyMotion) -> FloatArray:
        if not isinstance(motion, TracedMotion):
            return stroke_force(require_motion(motion), self.acting, self.drive)
        drive = stroke_of(motion.plan, self.drive, "drive")
        (force,) = by_work(FlatPoses(motion, ""), traced_loads(motion, self.acting, AT_REST), drive)
        return cast(FloatArray, force)

    def looked_up(self, motion: TracedMotion) -> LawInPlan:
        found = super().looked_up(motion)
        return replace(found, words=f"the driving force of {stroke_of(motion.plan, self.drive, 'drive')}")

    def __str__(self) -> str:
        return f"drive_force({', '.join([*([self.drive] if self.drive else []), *self.acting_words])})"


def drive_force(drive: str | None = None, loads: Loads = None, case: Case = None, *, acting: Acting | None = None) -> DriveForce:
    """Return the request for the generalised force of a stroke, in `evaluate`, `function` and `gradient`: [N], a crank's torque [Nm].

    It is `driving_force(motion, loads, drive, case=case)`, frictionless: `motion.gradient(drive_force(), wrt=["OB", "load.mass"])`.
    `acting` says loads and case in one, with a direction or rates too; then it has values and no derivatives.
    A load's law must be plain arithmetic of numbers at one pose; DefinitionError, with the load's name, where it is not.
    """
    return DriveForce(situation_of("drive_force", acting, loads=loads, case=case), drive)


COMPONENTS: Mapping[str, Callable[[Scalar, Scalar], Scalar]] = MappingProxyType(
    {"x": lambda x, y: x, "y": lambda x, y: y, "size": np.hypot}
)
"""What can be asked of a force, from its parts."""


@final
@dataclass(frozen=True, eq=False)
class PinForce(ForceRequest):
    """A component of a joint force, as something to ask for."""

    point: str = ""
    on: str = ""
    component: str = "size"
    by: str = ""
    measures = "force"

    def identity(self, plan: Plan) -> Hashable:
        return self.identified("pin force", self.point, self.on, self.component, self.by)

    def law(self, motion: AnyMotion) -> FloatArray:
        known_name("Component", self.component, COMPONENTS, where=f"{motion.plan.title}: the force at {self.point}")
        force = pin_forces_under(require_motion(motion), self.acting).force(self.point, self.on, self.by)
        return np.asarray(COMPONENTS[self.component](force[0], force[1]))

    def __str__(self) -> str:
        component = [] if self.component == "size" else [f"component={self.component}"]
        bodies = [*([self.on] if self.on else []), *([f"by={self.by}"] if self.by else [])]
        return f"pin_force({', '.join([self.point, *bodies, *component, *self.acting_words])})"

    # -- bound to a plan ---------------------------------------------------------------------------------

    def _bound(self, plan: Plan) -> PinForce:
        self.examine(plan)
        known_name("Component", self.component, COMPONENTS, where=f"{plan.title}: the force at {self.point}")
        return traced_apart(plan, self.at_its_joint)

    def at_its_joint(self, motion: TracedMotion) -> PinForce:
        """Return the same by the full names of its bodies, with what it is in the plan of a traced motion."""
        applied, plan = traced_loads(motion, self.acting, AT_REST), motion.plan
        structure = Structure(plan, applied.elements, applied.thrusts)
        found = replace(self, on=structure.full_name(self.on), by=structure.full_name(self.by))
        _, joint, _ = contact_of(structure, found)
        loads = ((each.load.point, each.load.on, *(motion.node(part).number for part in each.force)) for each in applied.loads)
        thrusts = ((each.name, each.ends, motion.node(each.thrust).number) for each in applied.thrusts)
        struts = ((strut.name, strut.P, strut.Q) for strut in structure.struts)
        acts = motion._reading.graph, *loads, *thrusts, *motion.notes.assumed, None, *motion.notes.switches, *struts
        key = "pin force", found.point, found.on, found.by, found.component, acts
        what = "the size" if self.component == "size" else f"the {self.component} component"
        every = frozenset(plan.members)
        return found.told(LawInPlan(key, every, every, ("pin forces", acts), f"{what} of the force at {joint}"))

    def _traced(self, plan: Plan) -> TracedLaw:
        """Return the force on a plan's program, on which all joint forces are traced once for all that are asked for."""
        kept = plan.trace.kept
        if self.traced_with not in kept:
            kept[self.traced_with] = traced_equilibrium(TracedMotion(plan, plan.trace), self.acting)
        motion, solution = cast(tuple[TracedMotion, Solution], kept[self.traced_with])
        contact, _, sign = contact_of(solution.system.structure, self)
        force, _ = solution.transmitted(contact)
        return TracedLaw(motion, motion.node(COMPONENTS[self.component](*(sign * force[:, 0]))))


def traced_equilibrium(motion: TracedMotion, acting: Acting) -> tuple[TracedMotion, Solution]:
    """Return a traced motion with all joint forces at rest; its notes say that the joints hold what they are said to."""
    applied = traced_loads(motion, acting, AT_REST)
    system, u = eliminated_forces(Structure(motion.plan, applied.elements, applied.thrusts), motion, applied)
    for each in assumed_joints(system.structure, system.poses):
        motion.notes.assumed.setdefault(motion.node(each[0]), "its joints")
    return motion, Solution(system, u, np.zeros((1, 0)), np.zeros(1, bool), [])


@final
@dataclass(frozen=True, eq=False)
class MemberThrust(ForceRequest):
    """What a driven length or a two-point element carries, as something to ask for: of `pin_forces(motion).thrusts`, by its name."""

    member: str = ""
    measures = "force"

    def identity(self, plan: Plan) -> Hashable:
        return self.identified("member thrust", self.member)

    def law(self, motion: AnyMotion) -> FloatArray:
        return np.asarray(pin_forces_under(require_motion(motion), self.acting).thrusts[self.member])

    def __str__(self) -> str:
        return f"thrust({', '.join([self.member, *self.acting_words])})"

    def examine(self, plan: Plan) -> None:
        raise UntracedError(f"{plan.title}: {self}: it has values, and no program that gives derivatives.")


def pin_forces_under(motion: Motion, acting: Acting) -> PinForces:
    """Return all joint forces of a motion in a situation, worked out once for all that ask for one of them."""

    identity = situation_identity(acting)
    if identity is None:
        return joint_forces(motion, acting)
    return motion._once(("pin forces", identity, acting.movement, acting.drive), lambda: joint_forces(motion, acting))


def pin_force(
    point: str, on: str = "", component: str = "size", loads: Loads = None, case: Case = None, *, acting: Acting | None = None,
    by: str = "",
) -> PinForce:  # fmt: skip
    """Return the request for a joint force [N], in `evaluate`, `function` and `gradient`: its "size", or its part along "x" or "y".

    It is that of `pin_forces(motion, loads, case=case).force(point, on)`, frictionless: on the body `on` from the other one, `by`
    where several meet there.
    `acting` says loads and case in one, with a direction, a drive or rates too; then it has values and no derivatives.
    A load's law must be plain arithmetic of numbers at one pose; DefinitionError, with the load's name, where it is not.
    """
    names: tuple[object, ...] = point, on, by
    if not all(isinstance(each, str) for each in names):
        said = "the names of a point and of a body are expected"
        raise DefinitionError(f'pin_force({cited(point)}, {cited(on)}): {said}, such as pin_force("G", "arm").')
    return PinForce(situation_of("pin_force", acting, loads=loads, case=case), point, on, component, by)


def contact_of(structure: Structure, request: PinForce) -> tuple[Contact, JointForce, float]:
    """Return the contact that is meant, its joint without a value, and the sign of its force on the body."""
    joints = joints_of(structure, [(np.zeros(2), np.zeros(()))] * len(structure.contacts))
    joint, sign = joint_on(joints, request.point, request.on, structure.plan.title, request.by)
    return structure.contacts[joints.index(joint)], joint, sign
