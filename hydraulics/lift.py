"""A pump that lifts by a cylinder: capacity, pressure, oil, time, holding and lowering. Every pressure in this file is gauge [Pa].

Friction as an efficiency: with the frictionless rod force P I (virtual work), the rod carries P I / k_m where the load
resists and P I k_m where it drives, k_m the mechanical efficiency. The hydraulic efficiency k_h enters only the supply
pressure: p = rod force / (area k_h). Where the ratio is zero or negative a capacity is "not limited by this
cylinder": NaN in an array, words in a verdict. Forces count in the cylinder's working direction: the side that
`works` pushes (or, rod side, pulls) with positive force. Source: worksheet of the mower lift; Dyuzhev, Kotov, Chuprynin (2008), (28), (29).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, ClassVar, final

import numpy as np
from numpy.typing import ArrayLike

from linkage.errors import DefinitionError
from linkage.loads import ForceElement, Load, Poses
from linkage.motion import Motion
from linkage.plan import Plan
from linkage.quantities import Distance, Reference, label, name_of

from .cylinder import CylinderSize
from .inputs import Array, finite, over_poses, positive
from .member import Cylinder, found_in, is_named, the_cylinder


@final
@dataclass(frozen=True, eq=False)
class LiftCircuit(ForceElement):
    """A pump on a cylinder: `circuit = LiftCircuit(lift, pressure=180 * bar, flow=60 * litre / minute, mechanical_efficiency=0.9)`.

    `pressure` is the pump's highest, gauge [Pa]; `flow` in m3/s; `back_pressure` that of the returning oil on the other
    side [Pa gauge]. In a class the numbers are design variables such as `circuit.pressure`.
    """

    cylinder: Reference
    pressure: Any
    flow: Any = 0.0
    mechanical_efficiency: Any = 1.0
    hydraulic_efficiency: Any = 1.0
    back_pressure: Any = 0.0
    places: ClassVar[tuple[str, ...]] = ()
    parameters: ClassVar[Mapping[str, str]] = MappingProxyType(
        {"pressure": "bar", "flow": "", "mechanical_efficiency": "", "hydraulic_efficiency": "", "back_pressure": "bar"}
    )
    not_negative: ClassVar[frozenset[str]] = frozenset({"flow", "back_pressure"})

    def parts(self) -> tuple[Reference, ...]:
        return (*([self.cylinder] if is_named(self.cylinder) else []), *super().parts())

    def examine(self, members: Mapping[str, Any], title: str) -> None:
        if is_named(self.cylinder):
            found_in(members, self.cylinder, f"{title}.{self.name}")

    def loads(self, motion: Poses) -> list[Load]:
        return []

    def __str__(self) -> str:
        return f"LiftCircuit({', '.join([label(self.cylinder), *self.words()])})"

    # -- what it is made of --------------------------------------------------------------------------------

    def ram(self, motion: Poses) -> Cylinder:
        """Return its cylinder, as the motion's class has it."""
        return the_cylinder(motion, self.cylinder)

    def size(self, motion: Poses) -> CylinderSize:
        """Return the size of its cylinder; bore and rod broadcast against the motion."""
        return self.ram(motion).sized(motion)

    def supply(self, motion: Poses) -> Array:
        """Return the pump's highest pressure [Pa]; DefinitionError unless it is above zero."""
        return positive(self.number(motion, "pressure"), f"{self.name or 'LiftCircuit'}.pressure")

    def efficiency(self, motion: Poses, kind: str) -> Array:
        """Return the "mechanical" or "hydraulic" efficiency; DefinitionError unless it is above 0 and not above 1."""
        what = f"{self.name or 'LiftCircuit'}.{kind}_efficiency"
        value = positive(self.number(motion, f"{kind}_efficiency"), what, "an efficiency lies between 0 and 1")
        if np.any(value > 1.0):
            raise DefinitionError(f"{what} = {np.max(value):.6g} is above 1; an efficiency lies between 0 and 1.")
        return value

    def back(self, motion: Poses) -> Array:
        """Return the pressure of the returning oil [Pa]; DefinitionError where it is negative."""
        value = finite(self.number(motion, "back_pressure"), "Back pressure")
        if np.any(value < 0.0):
            raise DefinitionError(f"Back pressure = {np.min(value):.6g} Pa is below zero; give zero or more.")
        return value

    # -- lifting -------------------------------------------------------------------------------------------

    def largest(self, motion: Poses) -> Array:
        """Return the greatest rod force in the working direction [N]: k_h p area, less the back pressure's share."""
        size = self.size(motion)
        force = self.efficiency(motion, "hydraulic") * self.supply(motion) * size.area - self.back(motion) * size.back_area
        if np.any(force <= 0.0):
            raise DefinitionError(f"{self}: the back pressure eats up the pump's; lower it or raise the pressure.")
        return np.asarray(force)

    def rod_force(self, motion: Poses, thrust: ArrayLike) -> Array:
        """Return the rod force while it moves in its working direction [N], same shape: T / k_m against a load, T k_m under a driving one.

        `thrust` is the frictionless one [N], of virtual work, positive where it pushes the ends apart.
        """
        needed = self.ram(motion).sized(motion).sense * over_poses(thrust, "Thrust")
        k_m = self.efficiency(motion, "mechanical")
        return np.asarray(np.where(needed > 0.0, needed / k_m, needed * k_m))

    def pressure_for(self, motion: Poses, thrust: ArrayLike) -> Array:
        """Return the pump pressure that lifts against a frictionless thrust [N], same shape; 0 where the load drives."""
        size = self.size(motion)
        force = self.rod_force(motion, thrust) + self.back(motion) * size.back_area
        return np.asarray(np.maximum(force, 0.0) / (size.area * self.efficiency(motion, "hydraulic")))

    def reserve(self, motion: Poses, thrust: ArrayLike) -> Array:
        """Return the greatest rod force over the needed one, same shape; NaN where it is not limited by this cylinder."""
        needed = self.rod_force(motion, thrust)
        return np.asarray(self.largest(motion) / np.where(needed > 0.0, needed, np.nan))

    def ratio(self, motion: Motion, point: str, direction: tuple[float, float] = (0.0, 1.0)) -> Array:
        """Return how far a point goes along a direction for each metre of the cylinder's working travel, shape (...)."""
        along = np.asarray(direction, float)
        size = np.hypot(*along)
        if not (np.isfinite(size) and size > 0.0):
            raise DefinitionError(f"direction={direction!r} has no length; write one such as (0, 1).")
        ram = self.ram(motion)
        stroke = drive(motion, ram)
        travel = motion.ratio(Distance(ram.A, ram.B), wrt=stroke)
        still = travel == 0.0
        if np.any(still):
            raise DefinitionError(f"{ram}: its length stands still at {int(still.sum())} poses of this motion; leave them out.")
        rate = motion.ratio(point, wrt=stroke)
        return np.asarray((along[0] * rate[0] + along[1] * rate[1]) / size / travel * self.size(motion).sense)

    def capacity(
        self, motion: Motion, point: str, own: ArrayLike = 0.0, direction: tuple[float, float] = (0.0, 1.0), share: float = 1.0
    ) -> Array:
        """Return the largest load [N] at a point that the pump lifts, shape (...), at a `share` of the pump's pressure.

        The load pulls against `direction`. `own` is the frictionless thrust [N] that the machine needs without the load
        (its links' masses). NaN where the load drives or does nothing: not limited by this cylinder; 0 where the machine
        alone is too heavy. Source: Dyuzhev, Kotov, Chuprynin (2008), (28).
        """
        if not 0.0 < share <= 1.0:
            raise DefinitionError(f"share = {share:.6g} of the pressure is not in 0 to 1; 0.9 is how tractors are tested.")
        size, ratio = self.size(motion), self.ratio(motion, point, direction)
        force = share * self.efficiency(motion, "hydraulic") * self.supply(motion) * size.area - self.back(motion) * size.back_area
        spare = force * self.efficiency(motion, "mechanical") - size.sense * over_poses(own, "Own thrust")
        lifts = ratio > IDLE
        return np.asarray(np.where(lifts, np.maximum(spare, 0.0) / np.where(lifts, ratio, 1.0), np.nan))

    # -- oil and time --------------------------------------------------------------------------------------

    def oil(self, motion: Motion) -> Array:
        """Return the oil [m3] that the working side takes over the motion's range of poses, one value a design."""
        return np.asarray(for_designs(motion, self.size(motion).area) * travel_of(motion, self.ram(motion)))[()]

    def time(self, motion: Motion) -> Array:
        """Return the time [s] that the pump's flow takes for it, one value a design; DefinitionError without a flow."""
        flow = positive(self.number(motion, "flow"), "Flow of the pump", "give it in m3/s, such as flow=60 * litre / minute")
        return np.asarray(self.oil(motion) / for_designs(motion, flow))[()]

    # -- holding and lowering ------------------------------------------------------------------------------

    def holding(self, motion: Poses, thrust: ArrayLike) -> Holding:
        """Return the pressures that hold a frictionless thrust [N] with the pump off; friction is not counted on."""
        size = self.size(motion)
        force = size.sense * over_poses(thrust, "Thrust")
        return Holding(np.maximum(force, 0.0) / size.area, np.maximum(-force, 0.0) / size.back_area)

    def lowering(self, motion: Poses, thrust: ArrayLike, resistance: ArrayLike = 0.0) -> Lowering:
        """Return how it goes back against its working direction, the oil flowing out against a `resistance` [Pa].

        Friction acts against the lowering: the load brings T k_m where it drives and takes T / k_m where it resists.
        """
        size, k_m = self.size(motion), self.efficiency(motion, "mechanical")
        force = size.sense * over_poses(thrust, "Thrust")
        brings = np.where(force > 0.0, force * k_m, force / k_m)
        against = positive(np.asarray(resistance) + 1.0, "Return resistance + 1 Pa") - 1.0
        push = np.maximum(against * size.area - brings, 0.0) / size.back_area
        return Lowering(np.maximum(brings, 0.0) / size.area, push, np.asarray(brings > against * size.area))


@final
@dataclass(frozen=True, eq=False)
class Holding:
    """Gauge pressures [Pa] that hold a load: on the working side, and on the other one where the load drives on."""

    working: Array
    other: Array


@final
@dataclass(frozen=True, eq=False)
class Lowering:
    """Going back: the gauge pressure [Pa] that the load alone makes in the working side, the one the other side must

    push with where that does not do, and whether it sinks `by_itself` (a mask).
    """

    working: Array
    push: Array
    by_itself: Array


IDLE = 1e-12  # a ratio this small lifts nothing


def travel_of(motion: Motion, ram: Cylinder) -> Array:
    """Return greatest less least length of a cylinder over the motion's poses [m], one value a design."""
    length = motion.distance(ram.A, ram.B)
    poses = tuple(range(len(motion.design_shape), length.ndim))
    if not np.all(np.any(np.isfinite(length), axis=poses)):
        raise DefinitionError(f"{ram}: no pose of this motion can be assembled.")
    return np.asarray(np.nanmax(length, axis=poses) - np.nanmin(length, axis=poses))


def for_designs(motion: Motion, value: ArrayLike) -> Array:
    """Return a value that broadcasts against the motion and is the same at all poses, as one of each design."""
    array, tail = np.asarray(value), (1,) * len(motion.stroke_shape)
    return np.asarray(array.reshape(array.shape[: array.ndim - len(tail)]) if array.ndim else array)


def drive(motion: Poses, ram: Cylinder) -> str:
    """Return the stroke that a cylinder's length follows: the only one, else the one named in its bar's length."""
    plan: Plan = motion.plan
    if len(plan.strokes) == 1:
        return next(iter(plan.strokes))
    ends = {name_of(ram.A), name_of(ram.B)}
    bars = [bar for bar in plan.cylinders if {bar.P, bar.Q} == ends]
    found = [name for bar in bars for name in plan.strokes if name in plan.reaches(bar.length)]
    if len(found) != 1:
        raise DefinitionError(f"{ram}: its length follows {len(found)} strokes of {', '.join(plan.strokes)}; one is expected.")
    return found[0]
