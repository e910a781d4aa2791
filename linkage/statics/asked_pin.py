"""A pin force as something to ask for: the equilibrium as a system of the program, so that its derivatives are exact too."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Any, final

import numpy as np

from ..errors import DefinitionError, SingularWarning, unknown
from ..motion import Asked, Motion
from ..plan import Plan
from ..program import FloatArray, Node, eliminated
from .asked import ForceOf
from .balance import Equations
from .contacts import Contact
from .forces import pin_forces
from .law import Law
from .loaded import Case, Loaded, Loads
from .poses import Poses
from .result import met
from .solved import Solved
from .structure import Structure
from .system import System
from .traced import TracedMotion

#: What can be asked of a force, from its parts.
COMPONENTS: Mapping[str, Callable[[Any, Any], Any]] = MappingProxyType({"x": lambda x, y: x, "y": lambda x, y: y, "size": np.hypot})
SAMPLE = 5
"""Poses over the strokes at which it is tried whether the joints can be solved for."""


@final
@dataclass(frozen=True, eq=False)
class PinForce(Asked):
    """A component of a frictionless joint force, as something to ask for."""

    point: str
    on: str = ""
    component: str = "size"
    loads: Loads = None
    case: Case = None

    def settled(self, plan: Plan) -> PinForceOf:
        if self.component not in COMPONENTS:
            raise unknown("Component", self.component, COMPONENTS, where=f"{plan.title}: the force at {self.point}")
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
    return PinForce(point, on, component, loads, case)


@final
@dataclass(frozen=True, eq=False)
class PinForceOf(ForceOf):
    """A pin force settled: what was asked, the key of its loads, a length of the mechanism [m], and the joint in words."""

    asked: PinForce
    law: tuple[Any, ...]
    length: float
    joint: str

    @property
    def key(self) -> Any:
        return "pin force", self.asked.point, self.asked.on, self.asked.component, self.law

    def nodes(self, plan: Plan) -> tuple[Node, ...]:
        law = self.laws(plan)
        structure, motion = Structure(plan, law.loaded.elements, law.loaded.pushing), law.motion
        system = System(structure, law.poses, law.loaded.acting, length=self.length)
        u = unknowns(system, motion)
        none = np.zeros((1, 0))
        joint, sign = joint_of(structure, self.asked.point, self.asked.on)
        force, _ = Solved(system, u, none, np.zeros(1, bool), []).transmitted(joint.contact)
        return (motion.node(COMPONENTS[self.asked.component](*(sign * force[:, 0]))),)

    def names(self, plan: Plan) -> set[str]:
        return set(plan.members)

    def refuse(self, motion: Motion) -> None:
        pin_forces(motion, self.loads, case=self.case)

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


def unknowns(system: System, motion: TracedMotion) -> FloatArray:
    """Return the joint forces of a traced system, eliminated symbolically, shape (1, columns)."""
    equations = Equations(system, bound=tuple(system.known()))
    A, right = equations.A[0], equations.right[0, :, 0]
    return motion.array([eliminated([[motion.node(each) for each in row] for row in A], [motion.node(each) for each in right])])


def held(plan: Plan, loaded: Loaded) -> float:
    """Return a length of the mechanism [m]; DefinitionError where a body hangs loose or a link is redundant."""
    along = np.linspace(0.0, 1.0, SAMPLE)
    ranges = {name: each.start + along * (each.end - each.start) for name, each in plan.strokes.items()}
    strokes = {name: np.append(plan.sketch_strokes[name], values) for name, values in ranges.items()}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SingularWarning)
        poses = Poses(Motion(plan, plan.defaults, strokes, "nan"), "The joint forces")
    still = tuple(replace(each, thrust=np.zeros(poses.motion.shape)) for each in loaded.pushing)
    system = System(Structure(plan, loaded.elements, still), poses, ())
    if not poses.count:
        raise DefinitionError(f"{plan.title}: the declared design cannot be assembled at any of {SAMPLE} poses; declare one that can.")
    equations = Equations(system, bound=tuple(system.known()))
    equations.check(*equations.A.shape[1:])
    return system.scale
