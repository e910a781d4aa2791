"""The joint forces of a motion: on which body, from which body, how large, and how well they balance."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Protocol, TypeVar

import numpy as np

from ..errors import DefinitionError, known_name, unknown
from ..motion import Motion, require_motion, stroke_unit
from ..motion.limits import Mask
from ..program import FloatArray
from ..units import kN
from .acting import Acting, Loaded
from .bodies import FRAME_NAME
from .joints import JointForce, Structure
from .poses import Poses
from .work import gap


@dataclass(frozen=True, eq=False)
class PinForces:
    """All joint forces of a motion in one load case and one direction of motion; shapes (2, ...) and (...).

    `drives` are the generalised forces of the strokes [N or Nm], `thrusts` what each driven length and each two-point element carries
    [N], positive where it pushes its ends apart. `remarks` say in words where friction locks the mechanism (there the forces are NaN,
    and `locked` is true) and which dampers stand still.
    """

    motion: Motion
    joints: tuple[JointForce, ...]
    drives: Mapping[str, FloatArray]
    thrusts: Mapping[str, FloatArray]
    case: str
    direction: str
    locked: Mask
    remarks: tuple[str, ...]
    _poses: Poses
    _loaded: Loaded
    _loads: tuple[tuple[str, Acting], ...]
    _structure: Structure
    _again: Callable[[Motion], PinForces]

    def again(self, motion: Motion) -> PinForces:
        """Return the same of another motion of the machine: the same loads, case, direction and rates; NaN where they are refused."""
        require_motion(motion)
        return self._again(motion)

    def at(self, point: str) -> tuple[JointForce, ...]:
        """Return the joints at a point."""
        return joints_at(self.joints, point, self.motion.plan.title)

    def force(self, point: str, on: str = "") -> FloatArray:
        """Return the force at a point on a body from the other one, shape (2, ...) [N].

        Where several joints meet, `on` says on which body it acts: by its points, its link's or its element's name; DefinitionError
        where that leaves a choice.
        """
        joint, sign = met(self.joints, point, self.body_named(on), self.motion.plan.title)
        return sign * joint.force

    def on_body(self, name: str) -> Mapping[str, FloatArray]:
        """Return all forces on a body by the point they act at, joints and loads, shape (2, ...) [N]: they balance (for FEM)."""
        found = self.body_named(name)
        if found not in self.on_bodies:
            raise unknown("Body", name, self.on_bodies, where=self.motion.plan.title)
        return self.on_bodies[found]

    def body_named(self, name: str) -> str:
        """Return a body's name for what it goes by; else the name as given."""
        return self._structure.called(name)

    @cached_property
    def on_bodies(self) -> Mapping[str, Mapping[str, FloatArray]]:
        """All forces by the body and the point they act at."""
        found: dict[str, dict[str, FloatArray]] = {name: {} for name in self._structure.bodies}

        def add(body: str, point: str, force: FloatArray) -> None:
            there = found.setdefault(body, {})
            there[point] = there[point] + force if point in there else force

        for joint in self.joints:
            add(joint.on, joint.point, joint.force)
            add(joint.by, joint.point, -joint.force)
        for body, load in self._loads:
            add(body, load.load.point, load.force)
        return found

    @cached_property
    def residual(self) -> float:
        """The largest imbalance of forces or moments of any body over the largest force, at the worst pose."""
        return residual(self)

    @cached_property
    def gap(self) -> float:
        """The largest difference of the drives' forces to those by virtual work, over the works of the loads; NaN with friction."""
        return gap(self._poses, self._loaded, self.drives)

    def __str__(self) -> str:
        head = f"{self.motion.plan.title}, {self.case}, {self.direction}"
        units = {name: "Nm" if stroke_unit(self.motion.plan, name) == "rad" else "N" for name in self.drives}
        lines = [f"  {name}: {spoken(values, units[name])}" for name, values in self.drives.items()]
        lines += [f"  thrust of {name}: {spoken(values, 'kN')}" for name, values in self.thrusts.items()]
        lines += [f"  {each}: {spoken(each.size, 'kN') if each.has_force else spoken(each.couple, 'Nm')}" for each in self.joints]
        against = "" if np.isnan(self.gap) else f"; against virtual work {self.gap:.0e}"
        return "\n".join([head, *lines, f"  residual of equilibrium {self.residual:.0e}{against}", *(f"  {each}" for each in self.remarks)])


def residual(found: PinForces) -> float:
    """Return the largest imbalance of any body over the largest force there is, at the worst pose; moments over the machine's size."""
    motion, shape = found.motion, found.motion.shape
    places = {point: motion[point] for point in motion.plan.points}
    extent = max((float(np.nanmax(place, initial=0.0) - np.nanmin(place, initial=0.0)) for place in places.values()), default=1.0) or 1.0
    sums: dict[str, FloatArray] = {}
    largest = np.zeros(shape)
    acting = [(each.on, each.point, each.force, each.couple) for each in found.joints]
    acting += [(each.by, each.point, -each.force, -each.couple) for each in found.joints]
    acting += [(body, load.load.point, load.force, np.zeros(())) for body, load in found._loads]
    for body, point, force, couple in acting:
        moment = (places[point][0] * force[1] - places[point][1] * force[0] + couple) / extent
        row = np.stack(np.broadcast_arrays(*force, moment))
        sums[body] = sums[body] + row if body in sums else row
        largest = np.maximum(largest, np.hypot(force[0], force[1]))
    bodies = [np.abs(rows[: 2 if body.startswith("pin ") else 3]).max(axis=0) for body, rows in sums.items() if body != FRAME_NAME]
    worst = np.max(bodies, axis=0, initial=0.0) if bodies else np.zeros(shape)
    return float(np.nanmax(worst / np.where(largest > 0.0, largest, 1.0), initial=0.0))


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
    name = known_name("Joint", point, dict.fromkeys(each.point for each in joints), where=title)
    return tuple(each for each in joints if each.point == name)


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
