"""The rigid bodies that the steps and links of a plan make, and the Gruebler count of their joints."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..graph import Body, gruebler, merged
from ..steps import Guide, Link, Point

if TYPE_CHECKING:
    from .members import Members


def rigid_bodies(plan: Members) -> tuple[Body, ...]:
    """Return the rigid bodies, the frame first."""
    groups: list[tuple[str, ...]] = [(bar.P, bar.Q) for bar in plan.rods]
    groups += [body for name, point in plan.points.items() if name not in plan.telescopes for body in point.bodies()]
    groups += [link.point_names for link in plan.of_kind(Link).values() if len(link.point_names) > 2 or not plan.is_cylinder(link)]
    rest = resting(plan)
    still = [name for name, guide in rest.items() if not guide.points]
    groups += [(*guide.points, name) for name, guide in rest.items() if len(guide.points) == 2]
    return merged(groups, (*plan.ground, *still))


def resting(plan: Members) -> dict[str, Guide]:
    """Return the points at a fixed place on a guide, which are rigid with it."""
    found = [(joint.point, joint) for point in plan.points.values() for joint in point.joints() if joint.drives and joint.track]
    guides = plan.of_kind(Guide)
    return {point: guides[joint.track[0]] for point, joint in found if not plan.is_there(joint)}


def gruebler_count(plan: Members) -> int:
    """Return 3 (n - 1) - 2 j1 - j2; a point that only guides hold counts as a pin of its own."""
    rest = resting(plan)
    free = {name: point for name, point in plan.points.items() if name not in rest}
    halves = sum(map(half_joints, free.values())) + sum(len(group.slides) for group in plan.groups.values())
    bodies = {name for body in plan.links for name in body.points} | {end for bar in plan.cylinders for end in (bar.P, bar.Q)}
    lone = sum(1 for name, point in free.items() if name not in bodies and (half_joints(point) or name in plan.telescopes))
    return gruebler(plan.links, [(bar.P, bar.Q) for bar in plan.cylinders]) - halves - len(plan.telescopes) + 2 * lone


def half_joints(point: Point) -> int:
    """Return how many guides and slots take one freedom each at a step."""
    return sum(1 for joint in point.joints() if joint.track)
