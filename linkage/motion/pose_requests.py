"""What can be asked of a pose itself: how well joints transmit, and how near it is to a singular one."""

from __future__ import annotations

from collections.abc import Hashable
from dataclasses import dataclass
from typing import final

import numpy as np

from ..plan import REGULAR, Plan
from ..program import FloatArray, Node
from ..quantities import Member, Reference, label, name_of
from .conditions import Left
from .grid import MotionLike
from .limits import no_joint
from .requests import BoundRequest, Ratio, Request, Value, identity_of
from .strokes import checked_name

# The transmission angle.

@final
@dataclass(frozen=True)
class TransmissionAngle(Request):
    """The transmission angle of a joint, folded to 0 ... pi/2, as something to ask for."""

    point: str

    def identity(self, plan: Plan) -> Hashable:
        return "transmission", self.point

    @property
    def measures(self) -> str:
        return "angle"

    def of(self, motion: MotionLike) -> FloatArray:
        angle = motion.transmission_angle(self.point)
        return np.minimum(angle, np.pi - angle)

    def bound(self, plan: Plan) -> TransmissionOf:
        name = checked_name("Point", self.point, plan.points, plan.title)
        joints = plan.made(("joints",), lambda twin: tuple(each for each, step in twin.points.items() if step.meeting(twin.trace)))
        if name not in joints:
            raise no_joint(plan, name, joints)
        return TransmissionOf(name)

    def __str__(self) -> str:
        return f"transmission({self.point})"


def transmission(point: Reference) -> TransmissionAngle:
    """Return the request for a joint's transmission angle [rad], folded to 0 ... pi/2: how far it is from the links in line.

    It is `motion.transmission_angle(point)`, and pi less it where that is above pi/2: `least(transmission("K")) >= 35 * deg`.
    """
    return TransmissionAngle(name_of(point))


@final
@dataclass(frozen=True)
class TransmissionOf(BoundRequest):
    """The folded transmission angle of a joint of a plan."""

    point: str

    @property
    def key(self) -> Hashable:
        return "transmission", self.point

    def nodes(self, plan: Plan) -> tuple[Node, ...]:
        u, w = plan.points[self.point].meeting(plan.trace)
        return (plan.trace.graph.node(np.arctan2(np.abs(u.cross(w)), np.abs(u.dot(w)))),)

    def names(self, plan: Plan) -> set[str]:
        return plan.reaches(self.point)

    @property
    def may_fail(self) -> bool:
        return True

    def scale(self, plan: Plan, left: Left) -> FloatArray:
        return np.ones(left.size.shape)

    def refuse(self, motion: MotionLike) -> None:
        motion._finite(motion.transmission_angle(self.point), np.zeros(motion.shape, bool), f"The {self}")

    def __str__(self) -> str:
        return f"transmission angle at {self.point}"


# Conditions: how near poses are to singular ones.

WORST = 1e16
"""The largest condition over 2 / 0.3 that is told."""


@final
@dataclass(frozen=True)
class ConditionRequest(Request):
    """How near a pose is to a singular one for what is built from a point or a quantity, as something to ask for."""

    target: str | Member | None = None

    def identity(self, plan: Plan) -> Hashable:
        target = None if self.target is None else identity_of(plan, self.target)
        return None if target is None and self.target is not None else ("condition", target)

    def __str__(self) -> str:
        return f"condition({'' if self.target is None else label(self.target)})"

    def bound(self, plan: Plan) -> ConditionOf:
        if self.target is None:
            return ConditionOf(None, frozenset(set[str]().union(*map(plan.reaches, plan.points))), plan.title)
        value = Ratio(self.target, order=0).bound(plan)
        return ConditionOf(value, frozenset(value.names(plan)), str(value))


def condition(target: str | Member | None = None) -> ConditionRequest:
    """Return the request for the condition of a pose, in `evaluate`, `function` and `source`: a number, 2 / 0.3 at regular poses.

    Next to a singular pose it is 2 over the sine of the loop in line, and the product of such where several follow one another or a
    direction is taken between points that come close: above 1e4 a ratio is off by some 0.3 eps cond^2, above 1e6 it is refused.
    `condition("G")` is of what G is built from, `condition(angle("A", "P"))` of what the angle is built from and of its own direction,
    `condition()` of all points of the machine. What else is asked beside it makes no difference.
    """
    return ConditionRequest(target)


@final
@dataclass(frozen=True)
class ConditionOf(BoundRequest):
    """The condition of a value, or of all points where it is None, bound to a plan with the members behind it; never refused."""

    value: Value | None
    members: frozenset[str]
    of: str

    @property
    def key(self) -> Hashable:
        return "condition", self.value and self.value.key

    @property
    def regular(self) -> float:
        return -1.0

    def nodes(self, plan: Plan) -> tuple[Node, ...]:
        near = plan.trace.alone(self.value and self.value.member).nearness(self.members, exact=True)
        return ((2.0 / REGULAR) / np.sqrt(near.graph.apply("maximum", near, WORST**-2)),)

    def names(self, plan: Plan) -> set[str]:
        return set(self.members)

    def __str__(self) -> str:
        return f"the condition of {self.of}"
