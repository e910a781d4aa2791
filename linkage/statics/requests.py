"""Forces as requests: in `evaluate` and `function` at a kernel's speed, in `gradient` with exact derivatives."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Any, TypeVar, final
from weakref import ref

import numpy as np

from ..errors import DefinitionError, cited, known_name
from ..loads import ForceElement, LoadCase
from ..motion import BoundRequest, Request, require_motion
from ..motion.grid import MotionLike
from ..motion.requests import identity_of, stroke_of
from ..plan import Plan
from ..program import Node, Notes
from .acting import Case, Loads
from .driving import driving_force
from .equilibrium import System
from .forces import pin_forces
from .joints import Contact, Structure
from .result import met
from .solution import Solved
from .traced_loads import Law, eliminated_system, held
from .work import by_work

Bound = TypeVar("Bound", bound=BoundRequest)


def loads_identity(loads: Loads, case: Case) -> Hashable:
    """Return what tells loads in a load case from others, which it does not keep alive; None where one of them may change.

    Members that were declared do not, nor do frozen dataclasses. What their laws compute with is taken not to change either.
    """
    listed = () if loads is None else loads if isinstance(loads, (list, tuple)) else (loads,)
    parts = [each if each is None or isinstance(each, str) else ref(each) if is_fixed(each) else ... for each in (case, *listed)]
    return None if ... in parts else (loads is None, *parts)


def bound_once(plan: Plan, request: Request, bound: Callable[[Plan], Bound]) -> Bound:
    """Return a request of the machine's own loads as `bound` binds it, kept with the plan."""
    identity = identity_of(plan, request)
    return bound(plan) if identity is None else plan.made(("bound", identity), lambda _: bound(plan))


def is_fixed(thing: object) -> bool:
    """Return whether loads or a load case cannot change: members of a class, and frozen dataclasses."""
    if not isinstance(thing, (ForceElement, LoadCase)):
        return False
    settings = vars(type(thing)).get("__dataclass_params__")
    return bool(thing._class) or (settings is not None and settings.frozen)


@final
@dataclass(frozen=True, eq=False)
class DriveForce(Request):
    """The frictionless force of a drive, as something to ask for."""

    drive: str | None = None
    loads: Loads = None
    case: Case = None

    def identity(self, plan: Plan) -> Hashable:
        loads = loads_identity(self.loads, self.case)
        return None if loads is None else ("drive force", self.drive, loads)

    def bound(self, plan: Plan) -> DriveForceOf:
        return bound_once(plan, self, self._bound) if self.loads is None else self._bound(plan)

    def _bound(self, plan: Plan) -> DriveForceOf:
        drive = stroke_of(plan, self.drive, "drive")
        law = Law.of(plan, self.loads, self.case)
        return DriveForceOf(self.loads, self.case, drive, law.key, frozenset(law.names), frozenset(law.carriers))


def drive_force(drive: str | None = None, loads: Loads = None, case: Case = None) -> DriveForce:
    """Return the request for the generalised force of a stroke, in `evaluate`, `function` and `gradient`: [N], a crank's torque [Nm].

    It is the frictionless `driving_force(motion, loads, drive, case=case)`: `motion.gradient(drive_force(), wrt=["OB", "load.mass"])`.
    A load's law must be plain arithmetic of numbers at one pose; DefinitionError, with the load's name, where it is not.
    """
    return DriveForce(drive, loads, case)


@dataclass(frozen=True, eq=False)
class ForceOf(BoundRequest):
    """A force bound to a plan: it goes through ratios and angles, and is true while the loads keep to the laws that were traced."""

    loads: Loads
    case: Case

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
        return self.laws(plan).notes

    def laws(self, plan: Plan) -> Law:
        """Return the loads traced on a plan's program."""
        return Law.on(plan, self.loads, self.case)


@final
@dataclass(frozen=True, eq=False)
class DriveForceOf(ForceOf):
    """A drive's force bound to a plan: its drive, the key of its loads, the members it reads, and those it is differentiated through."""

    drive: str
    law: tuple[Any, ...]
    read: frozenset[str]
    carriers: frozenset[str]

    @property
    def key(self) -> Hashable:
        return "drive force", self.drive, self.law

    def nodes(self, plan: Plan) -> tuple[Node, ...]:
        law = self.laws(plan)
        (force,) = by_work(law.poses, law.loaded, self.drive)
        return (law.motion.node(force),)

    def names(self, plan: Plan) -> set[str]:
        return set(self.read)

    def differentiated(self, plan: Plan) -> set[str]:
        return set(self.carriers)

    def refuse(self, motion: MotionLike) -> None:
        driving_force(require_motion(motion), self.loads, self.drive, case=self.case)

    def __str__(self) -> str:
        return f"the driving force of {self.drive}"


#: What can be asked of a force, from its parts.
COMPONENTS: Mapping[str, Callable[[Any, Any], Any]] = MappingProxyType({"x": lambda x, y: x, "y": lambda x, y: y, "size": np.hypot})


@final
@dataclass(frozen=True, eq=False)
class PinForce(Request):
    """A component of a frictionless joint force, as something to ask for."""

    point: str
    on: str = ""
    component: str = "size"
    loads: Loads = None
    case: Case = None

    def identity(self, plan: Plan) -> Hashable:
        loads = loads_identity(self.loads, self.case)
        return None if loads is None else ("pin force", self.point, self.on, self.component, loads)

    def bound(self, plan: Plan) -> PinForceOf:
        return bound_once(plan, self, self._bound) if self.loads is None else self._bound(plan)

    def _bound(self, plan: Plan) -> PinForceOf:
        known_name("Component", self.component, COMPONENTS, where=f"{plan.title}: the force at {self.point}")
        law = Law.of(plan, self.loads, self.case)
        structure = Structure(plan, law.loaded.elements, law.loaded.pushing)
        asked = replace(self, on=structure.called(self.on))
        joint, _ = joint_of(structure, self.point, asked.on)
        spans = tuple((strut.name, strut.P, strut.Q) for strut in structure.struts)
        length = plan.made(("held", spans), lambda _: held(plan, law.loaded))
        return PinForceOf(self.loads, self.case, asked, (*law.key, spans), length, str(joint))


def pin_force(point: str, on: str = "", component: str = "size", loads: Loads = None, case: Case = None) -> PinForce:
    """Return the request for a joint force [N], in `evaluate`, `function` and `gradient`: its "size", or its part along "x" or "y".

    It is that of the frictionless `pin_forces(motion, loads, case=case).force(point, on)`: on the body `on` from the other one.
    A load's law must be plain arithmetic of numbers at one pose; DefinitionError, with the load's name, where it is not.
    """
    names: tuple[Any, ...] = point, on
    if not all(isinstance(each, str) for each in names):
        said = "the names of a point and of a body are expected"
        raise DefinitionError(f'pin_force({cited(point)}, {cited(on)}): {said}, such as pin_force("G", "arm").')
    return PinForce(point, on, component, loads, case)


@final
@dataclass(frozen=True, eq=False)
class PinForceOf(ForceOf):
    """A pin force bound to a plan: what was asked, the key of its loads, a length of the mechanism [m], and the joint in words."""

    asked: PinForce
    law: tuple[Any, ...]
    length: float
    joint: str

    @property
    def key(self) -> Hashable:
        return "pin force", self.asked.point, self.asked.on, self.asked.component, self.law

    def nodes(self, plan: Plan) -> tuple[Node, ...]:
        law = self.laws(plan)
        structure, motion = Structure(plan, law.loaded.elements, law.loaded.pushing), law.motion
        system = System(structure, law.poses, law.loaded.acting, length=self.length)
        u = eliminated_system(system, motion)
        none = np.zeros((1, 0))
        joint, sign = joint_of(structure, self.asked.point, self.asked.on)
        force, _ = Solved(system, u, none, np.zeros(1, bool), []).transmitted(joint.contact)
        return (motion.node(COMPONENTS[self.asked.component](*(sign * force[:, 0]))),)

    def names(self, plan: Plan) -> set[str]:
        return set(plan.members)

    def refuse(self, motion: MotionLike) -> None:
        pin_forces(require_motion(motion), self.loads, case=self.case)

    def __str__(self) -> str:
        what = "the size" if self.asked.component == "size" else f"the {self.asked.component} component"
        return f"{what} of the force at {self.joint}"


@dataclass(frozen=True)
class Met:
    """A joint by the names of its bodies."""

    contact: Contact
    on: str
    by: str

    @property
    def point(self) -> str:
        """The point it is at."""
        return self.contact.point

    @property
    def has_force(self) -> bool:
        """Whether it transmits a force."""
        return self.contact.has_force

    def __str__(self) -> str:
        return f"{self.point} ({self.contact.kind}) on {self.on} from {self.by}"


def joint_of(structure: Structure, point: str, on: str) -> tuple[Met, float]:
    """Return the joint that is meant, and the sign of its force on the body."""
    joints = [Met(each, structure.name(each.on), structure.name(each.by)) for each in structure.contacts]
    return met(joints, point, on, structure.plan.title)
