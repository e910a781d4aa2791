"""The joint forces of a motion: on which body, from which body, how large, and how well they balance."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Protocol, TypeVar

import numpy as np

from ..errors import DefinitionError, unknown
from ..motion import Motion, stroke_unit
from ..motion.reach import Mask
from ..plan import Plan
from ..program import FloatArray
from ..steps import Link
from ..units import kN


@dataclass(frozen=True, eq=False)
class JointForce:
    """What one joint transmits: the force on the body `on` from the body `by`, shape (2, ...) [N], with a couple (...) [Nm].

    `kind` is a pin, a guide, a slot, a driven point, a crank's drive, a slider or a telescope. `axis` are the two points that give
    the body's own x axis; for the frame it is None.
    """

    point: str
    on: str
    by: str
    kind: str
    force: FloatArray
    couple: FloatArray
    axis: tuple[str, str] | None = None

    @property
    def size(self) -> FloatArray:
        """The size of the force, shape (...) [N]."""
        return np.asarray(np.hypot(self.force[0], self.force[1]))

    @property
    def has_force(self) -> bool:
        """Whether it transmits a force; a crank's drive has only a couple."""
        return self.kind not in ("crank", "upright")

    def __str__(self) -> str:
        return f"{self.point} ({self.kind}) on {self.on} from {self.by}"


@dataclass(frozen=True, eq=False)
class PinForces:
    """All joint forces of a motion in one load case and one direction of motion; shapes (2, ...) and (...).

    `drives` are the thrusts [N] and torques [Nm] by stroke, `residual` the largest imbalance of any body over the largest force,
    `gap` the largest difference to the drive's force by virtual work over the works of the loads (NaN with friction).
    `remarks` say in words where friction locks the mechanism; there the forces are NaN, and `locked` is true.
    """

    motion: Motion
    joints: tuple[JointForce, ...]
    drives: Mapping[str, FloatArray]
    on_bodies: Mapping[str, Mapping[str, FloatArray]]
    case: str
    direction: str
    residual: float
    gap: float
    locked: Mask
    remarks: tuple[str, ...]

    def at(self, point: str) -> tuple[JointForce, ...]:
        """Return the joints at a point."""
        return joints_at(self.joints, point, self.motion.plan.title)

    def force(self, point: str, on: str = "") -> FloatArray:
        """Return the force at a point on a body from the other one, shape (2, ...) [N].

        Where several joints meet, `on` says on which body it acts, by its points or its link's name; DefinitionError where that
        leaves a choice.
        """
        joint, sign = met(self.joints, point, body_named(self.motion.plan, on), self.motion.plan.title)
        return sign * joint.force

    def on_body(self, name: str) -> Mapping[str, FloatArray]:
        """Return all forces on a body by the point they act at, joints and loads, shape (2, ...) [N]: they balance (for FEM)."""
        found = body_named(self.motion.plan, name)
        if found not in self.on_bodies:
            raise unknown("Body", name, self.on_bodies, where=self.motion.plan.title)
        return self.on_bodies[found]

    def __str__(self) -> str:
        head = f"{self.motion.plan.title}, {self.case}, {self.direction}"
        units = {name: "Nm" if stroke_unit(self.motion.plan, name) == "rad" else "N" for name in self.drives}
        lines = [f"  {name}: {spoken(values, units[name])}" for name, values in self.drives.items()]
        lines += [f"  {each}: {spoken(each.size, 'kN') if each.has_force else spoken(each.couple, 'Nm')}" for each in self.joints]
        gap = "" if np.isnan(self.gap) else f"; against virtual work {self.gap:.0e}"
        return "\n".join([head, *lines, f"  residual of equilibrium {self.residual:.0e}{gap}", *(f"  {each}" for each in self.remarks)])


def body_named(plan: Plan, name: str) -> str:
    """Return a body's name as the forces have it, for its link's name (`arm`) or some of its points (`O B`); else the name as given."""
    bodies = {each.name: set(each.points) for each in plan.links} | {bar.P + bar.Q: {bar.P, bar.Q} for bar in plan.cylinders}
    link = plan.of_kind(Link).get(name)
    points = set(link.point_names if link else name.split())
    found = [each for each, its in bodies.items() if len(points) > 1 and points <= its]
    return found[0] if name not in bodies and len(found) == 1 else name


class Joint(Protocol):
    """What a joint is known by."""

    @property
    def point(self) -> str: ...

    @property
    def on(self) -> str: ...

    @property
    def by(self) -> str: ...

    @property
    def has_force(self) -> bool: ...


J = TypeVar("J", bound=Joint)


def joints_at(joints: Sequence[J], point: str, title: str) -> tuple[J, ...]:
    """Return the joints at a point; DefinitionError where there is none."""
    found = tuple(each for each in joints if each.point == point)
    if not found:
        raise unknown("Joint", point, dict.fromkeys(each.point for each in joints), where=title)
    return found


def met(joints: Sequence[J], point: str, on: str, title: str) -> tuple[J, float]:
    """Return the joint at a point that transmits a force to a body, and -1 where it is seen from the other body, else 1."""
    found = [each for each in joints_at(joints, point, title) if each.has_force]
    names = dict.fromkeys(name for each in found for name in (each.on, each.by))
    if not on and len(found) == 1:
        return found[0], 1.0
    if on and on not in names:
        raise unknown("Body", on, names, where=f"the joint {point} of {title}")
    taken = [(each, 1.0) for each in found if each.on == on] + [(each, -1.0) for each in found if each.by == on]
    if len(taken) != 1:
        where = ", ".join(f"on {each.on} from {each.by}" for each in found)
        remedy = f"say on= the other body, on which it is the opposite, or take them from at({point!r})" if on else "say on= which body"
        raise DefinitionError(f"{title}: several joints meet at {point} ({where}); {remedy}.")
    return taken[0]


def spoken(values: FloatArray, unit: str) -> str:
    """Return a range of values [N or Nm] in words, in the unit given."""
    factor = kN if unit == "kN" else 1.0
    finite = np.asarray(values)[np.isfinite(values)] / factor
    if not finite.size:
        return "no value"
    low, high = float(finite.min()), float(finite.max())
    ends = dict.fromkeys(f"{value:.6g}" for value in (low, high))
    return f"{' to '.join(ends)} {unit}"
