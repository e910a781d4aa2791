"""Forces as requests: in `evaluate` and `function` at a kernel's speed, in `gradient` with exact derivatives."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Self, TypeVar, cast, final
from weakref import ref

import numpy as np

from ..errors import DefinitionError, UntracedError, cited, known_name
from ..loads import DIRECTIONS, FRICTIONLESS, Acting, Case, ForceElement, LoadCase, Loads, situation_of
from ..motion import BoundRequest, Motion, Request, require_motion
from ..motion.grid import MotionLike
from ..motion.requests import identity_of, stroke_of
from ..plan import Plan
from ..program import FloatArray, Node, Notes
from ..vectors import Scalar
from .agreement import assumed_joints
from .joint_forces import JointForce, PinForces, joint_forces, joint_on, joints_of
from .joints import Contact, Structure
from .solution import Solution
from .traced_loads import TracedLoads, eliminated_forces
from .work import by_work, stroke_force

Bound = TypeVar("Bound", bound=BoundRequest)


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


def bound_once(plan: Plan, request: Request, bound: Callable[[Plan], Bound]) -> Bound:
    """Return a request of the machine's own loads as `bound` binds it, kept with the plan."""
    identity = identity_of(plan, request)
    return bound(plan) if identity is None else plan.made(("bound", identity), lambda _: bound(plan))


def is_unchanging(thing: object) -> bool:
    """Return whether loads or a load case cannot change: members of a class, and frozen dataclasses."""
    if not isinstance(thing, (ForceElement, LoadCase)):
        return False
    settings = vars(type(thing)).get("__dataclass_params__")
    return bool(thing._class) or (settings is not None and settings.frozen)


@dataclass(frozen=True, eq=False)
class ForceRequest(Request):
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

    def bound_to(self, plan: Plan, bound: Callable[[Plan], Bound]) -> Bound:
        """Return it as `bound` binds it; UntracedError while it moves, for friction follows from the forces that it changes."""
        if self.acting.movement != FRICTIONLESS or self.acting.rates is not None:
            raise UntracedError(f"{plan.title}: {self}: while it moves it has values, and no program that gives derivatives. Ask at rest.")
        return bound_once(plan, self, bound) if self.acting.loads is None else bound(plan)


@final
@dataclass(frozen=True, eq=False)
class DriveForce(ForceRequest):
    """The force of a drive, as something to ask for."""

    drive: str | None = None

    def identity(self, plan: Plan) -> Hashable:
        return self.identified("drive force", self.drive)

    def of(self, motion: MotionLike) -> FloatArray:
        return stroke_force(require_motion(motion), self.acting, self.drive)

    def __str__(self) -> str:
        return f"drive_force({', '.join([*([self.drive] if self.drive else []), *self.acting_words])})"

    def bound(self, plan: Plan) -> DriveForceOf:
        return self.bound_to(plan, self._bound)

    def _bound(self, plan: Plan) -> DriveForceOf:
        drive = stroke_of(plan, self.drive, "drive")
        traced = TracedLoads.apart(plan, self.acting)
        return DriveForceOf(self.acting, drive, traced.key, frozenset(traced.names), frozenset(traced.carriers))


def drive_force(drive: str | None = None, loads: Loads = None, case: Case = None, *, acting: Acting | None = None) -> DriveForce:
    """Return the request for the generalised force of a stroke, in `evaluate`, `function` and `gradient`: [N], a crank's torque [Nm].

    It is `driving_force(motion, loads, drive, case=case)`, frictionless: `motion.gradient(drive_force(), wrt=["OB", "load.mass"])`.
    `acting` says loads and case in one, with a direction or rates too; then it has values and no derivatives.
    A load's law must be plain arithmetic of numbers at one pose; DefinitionError, with the load's name, where it is not.
    """
    return DriveForce(situation_of("drive_force", acting, loads=loads, case=case), drive)


@dataclass(frozen=True, eq=False)
class ForceOf(BoundRequest):
    """A force bound to a plan: it goes through ratios and angles, and is true while the loads keep to the laws that were traced."""

    acting: Acting

    @property
    def order(self) -> int:
        return 1

    @property
    def may_fail(self) -> bool:
        return True

    @property
    def follows_angles(self) -> bool:
        return True

    def notes(self, plan: Plan) -> Notes:
        return self.traced(plan).notes

    def traced(self, plan: Plan) -> TracedLoads:
        """Return the loads traced on a plan's program."""
        return TracedLoads.on(plan, self.acting)


@final
@dataclass(frozen=True, eq=False)
class DriveForceOf(ForceOf):
    """A drive's force bound to a plan: its drive, the key of its loads, the members it reads, and those it is differentiated through."""

    drive: str
    loads_key: tuple[Hashable, ...]
    read: frozenset[str]
    carriers: frozenset[str]

    @property
    def key(self) -> Hashable:
        return "drive force", self.drive, self.loads_key

    def nodes(self, plan: Plan) -> tuple[Node, ...]:
        traced = self.traced(plan)
        (force,) = by_work(traced.poses, traced.applied, self.drive)
        return (traced.motion.node(force),)

    def names(self, plan: Plan) -> set[str]:
        return set(self.read)

    def differentiated(self, plan: Plan) -> set[str]:
        return set(self.carriers)

    def refuse(self, motion: MotionLike) -> None:
        stroke_force(require_motion(motion), self.acting, self.drive)

    def __str__(self) -> str:
        return f"the driving force of {self.drive}"


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

    def of(self, motion: MotionLike) -> FloatArray:
        known_name("Component", self.component, COMPONENTS, where=f"{motion.plan.title}: the force at {self.point}")
        force = pin_forces_under(require_motion(motion), self.acting).force(self.point, self.on, self.by)
        return np.asarray(COMPONENTS[self.component](force[0], force[1]))

    def __str__(self) -> str:
        component = [] if self.component == "size" else [f"component={self.component}"]
        bodies = [*([self.on] if self.on else []), *([f"by={self.by}"] if self.by else [])]
        return f"pin_force({', '.join([self.point, *bodies, *component, *self.acting_words])})"

    def bound(self, plan: Plan) -> PinForceOf:
        return self.bound_to(plan, self._bound)

    def _bound(self, plan: Plan) -> PinForceOf:
        known_name("Component", self.component, COMPONENTS, where=f"{plan.title}: the force at {self.point}")
        traced = TracedLoads.apart(plan, self.acting)
        structure = Structure(plan, traced.applied.elements, traced.applied.thrusts)
        request = replace(self, on=structure.full_name(self.on), by=structure.full_name(self.by))
        _, joint, _ = contact_of(structure, request)
        spans = tuple((strut.name, strut.P, strut.Q) for strut in structure.struts)
        return PinForceOf(self.acting, request, (*traced.key, spans), str(joint))


@final
@dataclass(frozen=True, eq=False)
class MemberThrust(ForceRequest):
    """What a driven length or a two-point element carries, as something to ask for: of `pin_forces(motion).thrusts`, by its name."""

    member: str = ""
    measures = "force"

    def identity(self, plan: Plan) -> Hashable:
        return self.identified("member thrust", self.member)

    def of(self, motion: MotionLike) -> FloatArray:
        return np.asarray(pin_forces_under(require_motion(motion), self.acting).thrusts[self.member])

    def __str__(self) -> str:
        return f"thrust({', '.join([self.member, *self.acting_words])})"

    def bound(self, plan: Plan) -> BoundRequest:
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


@final
@dataclass(frozen=True, eq=False)
class PinForceOf(ForceOf):
    """A pin force bound to a plan: the request, the key of its loads, and the joint in words."""

    request: PinForce
    loads_key: tuple[Hashable, ...]
    joint: str

    @property
    def key(self) -> Hashable:
        return "pin force", self.request.point, self.request.on, self.request.by, self.request.component, self.loads_key

    @property
    def traced_with(self) -> Hashable:
        return "pin forces", self.loads_key

    def traced(self, plan: Plan) -> TracedLoads:
        return self.equilibrium(plan)[0]

    def equilibrium(self, plan: Plan) -> tuple[TracedLoads, Solution]:
        """Return the loads and all joint forces on a plan's program, traced there once for all joints that are asked for."""
        kept = plan.trace.kept
        if self.traced_with not in kept:
            traced = super().traced(plan)
            system, u = eliminated_forces(traced.structure, traced.motion, traced.applied)
            kept[self.traced_with] = traced, Solution(system, u, np.zeros((1, 0)), np.zeros(1, bool), [])
        return cast(tuple[TracedLoads, Solution], kept[self.traced_with])

    def nodes(self, plan: Plan) -> tuple[Node, ...]:
        traced, solution = self.equilibrium(plan)
        contact, _, sign = contact_of(solution.system.structure, self.request)
        force, _ = solution.transmitted(contact)
        return (traced.motion.node(COMPONENTS[self.request.component](*(sign * force[:, 0]))),)

    def notes(self, plan: Plan) -> Notes:
        traced = self.traced(plan)
        for each in assumed_joints(traced.structure, traced.poses):
            traced.notes.assumed.setdefault(traced.motion.node(each[0]), "its joints")
        return traced.notes

    def names(self, plan: Plan) -> set[str]:
        return set(plan.members)

    def refuse(self, motion: MotionLike) -> None:
        pin_forces_under(require_motion(motion), self.acting)

    def __str__(self) -> str:
        what = "the size" if self.request.component == "size" else f"the {self.request.component} component"
        return f"{what} of the force at {self.joint}"


def contact_of(structure: Structure, request: PinForce) -> tuple[Contact, JointForce, float]:
    """Return the contact that is meant, its joint without a value, and the sign of its force on the body."""
    joints = joints_of(structure, [(np.zeros(2), np.zeros(()))] * len(structure.contacts))
    joint, sign = joint_on(joints, request.point, request.on, structure.plan.title, request.by)
    return structure.contacts[joints.index(joint)], joint, sign
