"""What can be asked of a pose itself: how well joints transmit, and how near it is to a singular one."""

from __future__ import annotations

import numpy as np

from ..plan import REGULAR, Plan
from ..program import FloatArray, Node
from ..quantities import Member, Quantity, Reference, label, name_of
from .grid import MotionLike
from .limits import no_joint
from .requests import NodeRequest, Value
from .strokes import checked_name


def transmission(point: Reference) -> NodeRequest:
    """Return the request for a joint's transmission angle [rad], folded to 0 ... pi/2: how far it is from the links in line.

    It is `motion.transmission_angle(point)`, and pi less it where that is above pi/2: `least(transmission("K")) >= 35 * deg`.
    """
    name = name_of(point)

    def names(plan: Plan) -> set[str]:
        checked_name("Point", name, plan.points, plan.title)
        joints = plan.made(("joints",), lambda twin: tuple(each for each, step in twin.points.items() if step.meeting(twin.trace)))
        if name not in joints:
            raise no_joint(plan, name, joints)
        return plan.reaches(name)

    def nodes(plan: Plan) -> tuple[Node, ...]:
        u, w = plan.points[name].meeting(plan.trace)
        return (plan.trace.graph.node(np.arctan2(np.abs(u.cross(w)), np.abs(u.dot(w)))),)

    def values(motion: MotionLike) -> FloatArray:
        angle = motion.transmission_angle(name)
        return np.minimum(angle, np.pi - angle)

    return NodeRequest(
        text=f"transmission({name})", sentence=f"transmission angle at {name}", key=("transmission", name), measures="angle",
        nodes_of=nodes, names_of=names, values_of=values, may_fail=True,
    )  # fmt: skip


WORST = 1e16
"""The largest condition over 2 / 0.3 that is told."""


def condition(target: str | Member | None = None) -> NodeRequest:
    """Return the request for the condition of a pose, in `evaluate`, `function` and `source`: a number, 2 / 0.3 at regular poses.

    Next to a singular pose it is 2 over the sine of the loop in line. It is the product of such where several follow one another, or where
    a direction is taken between points that come close. Above 1e4 a ratio is off by some 0.3 eps cond^2, above 1e6 it is refused.
    `condition("G")` is of what G is built from, `condition(angle("A", "P"))` of what the angle is built from and of its own direction,
    `condition()` of all points of the machine. What else is asked beside it makes no difference.
    """

    def value(plan: Plan) -> Value | None:
        return None if target is None else Value(target).bound(plan)

    def names(plan: Plan) -> set[str]:
        of = value(plan)
        return set[str]().union(*map(plan.reaches, plan.points)) if of is None else of.names(plan)

    def nodes(plan: Plan) -> tuple[Node, ...]:
        of = value(plan)
        near = plan.trace.alone(None if of is None else of.member).nearness(names(plan), exact=True)
        return ((2.0 / REGULAR) / np.sqrt(near.graph.apply("maximum", near, WORST**-2)),)

    what = target.identity if isinstance(target, Quantity) else None if target is None else name_of(target)
    return NodeRequest(
        text=f"condition({'' if target is None else label(target)})",
        sentence=f"the condition of {'its points' if target is None else label(target)}", key=("condition", what),
        nodes_of=nodes, names_of=names, parts=() if target is None else (target,), regular_above=-1.0,
    )  # fmt: skip
