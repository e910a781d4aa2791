"""What the hitch lifts: (28) and (29), at the centre of gravity, at the hitch points, and behind them. Pressures are gauge."""

from __future__ import annotations

import numpy as np

from hydraulics import LiftCircuit
from linkage import DefinitionError, Force, ForceElement, Motion
from linkage.errors import cited
from linkage.motion import require_motion
from linkage.program import FloatArray
from linkage.quantities import is_number
from linkage.units import deg, mm

BEHIND = 610 * mm
"""Distance from the hitch points to the centre of the load at which tractors are tested (OECD Code 2)."""

SHARE = 0.9
"""Share of the relief valve's pressure that a tractor's test results are given for (OECD Code 2)."""

NOT_OWN = ("load", "lift", "circuit")


def circuit_of(motion: Motion) -> LiftCircuit:
    """Return the motion's lift circuit."""
    require_motion(motion)
    found = motion.plan.members.get("circuit")
    if not isinstance(found, LiftCircuit):
        raise DefinitionError(f"{motion.plan.title} has no lift circuit of the name circuit; give the motion of a three-point hitch.")
    return found


def own_loads(motion: Motion) -> list[str]:
    """Return the loads of the hitch without its implement, by name: masses, friction and what else is added to it."""
    return [name for name in motion.plan.of_kind(ForceElement) if name not in NOT_OWN]


def capacity(motion: Motion, point: str = "G", share: float = 1.0) -> FloatArray:
    """Return G_g = F_cyl eta / I (28) [N], shape (...), at a point and a `share` of the pump's pressure.

    F_cyl = p_max area (29), I = dy/dS of the point. NaN where I is not above zero: not limited by this cylinder.
    """
    return circuit_of(motion).capacity(motion, point, own_loads(motion), share=share)


def at_hitch_points(motion: Motion, share: float = SHARE) -> FloatArray:
    """Return the capacity with the load at the hitch points F [N], shape (...)."""
    return capacity(motion, "F", share)


def behind(motion: Motion, distance: float = BEHIND, share: float = SHARE) -> FloatArray:
    """Return the capacity with the load's centre a distance [m] behind the hitch points, square to the upright [N], shape (...)."""
    require_motion(motion)
    if not is_number(distance):
        raise DefinitionError(f"distance={cited(distance)}: one number in m is expected, such as 0.61.")
    tested = {"FG": distance, "KFG": 90 * deg}
    moved = Motion(motion.plan, motion.designs | tested, motion.strokes, motion.unreachable)
    return circuit_of(moved).capacity(moved, "G", own_loads(motion), share=share)


def stroke_per_newton(motion: Motion) -> FloatArray:
    """Return one over the capacity at G [1/N], shape (...); not above zero where the cylinder does not limit.

    Unlike the capacity it has no gap where the ratio goes through zero, so that extremes are sought in it.
    """
    circuit = circuit_of(motion)
    (lift,) = circuit.rams(motion)
    most = circuit.largest(motion, own_loads(motion)) * circuit.efficiency(motion, "mechanical")
    spare = most - lift.thrust(motion, own_loads(motion), direction="extending")
    with np.errstate(divide="ignore"):
        return np.asarray(lift.thrust(motion, [Force("G", (0.0, -1.0))]) / np.maximum(spare, 0.0))


def from_stroke_per_newton(value: FloatArray) -> FloatArray:
    """Return the capacity [N] that `stroke_per_newton` stands for; NaN where the cylinder does not limit."""
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray(np.where(value > 0.0, 1.0 / value, np.nan))
