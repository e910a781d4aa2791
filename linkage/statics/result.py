"""The joint forces of a motion: on which body, from which body, how large, and how well they balance."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ..errors import DefinitionError, unknown
from ..motion import Motion, stroke_unit
from ..motion.reach import Mask
from ..program import FloatArray
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
    `gap` the largest difference to the drive's force by virtual work over the largest such force (NaN with friction).
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
        found = tuple(each for each in self.joints if each.point == point)
        if not found:
            raise unknown("Joint", point, dict.fromkeys(each.point for each in self.joints), where=self.motion.plan.title)
        return found

    def force(self, point: str, on: str = "") -> FloatArray:
        """Return the force at a point on a body from the other one, shape (2, ...) [N].

        Where several joints meet, `on` says on which body it acts; DefinitionError where that leaves a choice.
        """
        found = self.at(point)
        names = dict.fromkeys(name for each in found for name in (each.on, each.by))
        if not on and len(found) == 1:
            return found[0].force
        taken = [each.force for each in found if each.on == on] + [-each.force for each in found if each.by == on]
        if on and on not in names:
            raise unknown("Body", on, names, where=f"the joint {point} of {self.motion.plan.title}")
        if len(taken) != 1:
            where = ", ".join(f"on {each.on} from {each.by}" for each in found)
            raise DefinitionError(f"{self.motion.plan.title}: several joints meet at {point} ({where}); say on= which body.")
        return taken[0]

    def on_body(self, name: str) -> Mapping[str, FloatArray]:
        """Return all forces on a body by the point they act at, joints and loads, shape (2, ...) [N]: they balance (for FEM)."""
        if name not in self.on_bodies:
            raise unknown("Body", name, self.on_bodies, where=self.motion.plan.title)
        return self.on_bodies[name]

    def __str__(self) -> str:
        head = f"{self.motion.plan.title}, {self.case}, {self.direction}"
        units = {name: "Nm" if stroke_unit(self.motion.plan, name) == "rad" else "N" for name in self.drives}
        lines = [f"  {name}: {spoken(values, units[name])}" for name, values in self.drives.items()]
        lines += [f"  {each}: {spoken(each.size, 'kN') if each.has_force else spoken(each.couple, 'Nm')}" for each in self.joints]
        gap = "" if np.isnan(self.gap) else f"; against virtual work {self.gap:.0e}"
        return "\n".join([head, *lines, f"  residual of equilibrium {self.residual:.0e}{gap}", *(f"  {each}" for each in self.remarks)])


def spoken(values: FloatArray, unit: str) -> str:
    """Return a range of values [N or Nm] in words, in the unit given."""
    factor = kN if unit == "kN" else 1.0
    finite = np.asarray(values)[np.isfinite(values)] / factor
    if not finite.size:
        return "no value"
    low, high = float(finite.min()), float(finite.max())
    return f"{low:.6g} {unit}" if low == high else f"{low:.6g} to {high:.6g} {unit}"
