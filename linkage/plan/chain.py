"""The kinematic chain of a mechanism: its bodies and the pairs between them, each of one freedom.

A cylinder is two bodies, barrel and rod, that slide in each other. A pin that runs on a guide or in a slot is a sliding block with a pin.
An arm that is turned and pushed out by strokes has a carriage at its root. So every pair is a pin or a slide, and 3 (n - 1) - 2 j counts
all of them.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

from ..frozen import immutable
from ..quantities import Joint, JointSide, Member, Quantity, Stroke, body_name, needed_behind, needs, of_kind
from ..steps import Point
from .members import FRAME, Body, Members, carrying_pairs, member_sides, spanning_name


class ChainBody(NamedTuple):
    """A body of the chain: the `frame`, a `body`, a `barrel` or a `rod`, an `arm` or its `carriage`, a sliding `block`."""

    name: str
    kind: str
    points: tuple[str, ...]


@immutable
class Pair:
    """A `pin` at a point or a `slide`, between two bodies by their names; `length` is the length a slide drives, by these `strokes`."""

    kind: str
    name: str
    a: str
    b: str
    strokes: tuple[str, ...] = ()
    length: Quantity | None = None


class KinematicChain:
    """Bodies and pairs. Bodies that share a point are pinned there to the first of them, n bodies by n - 1 pins."""

    def __init__(self, bodies: Sequence[Body]) -> None:
        self.bodies = [ChainBody(body.name, FRAME if body.fixed else "body", body.points) for body in bodies]
        self.slides: list[Pair] = []
        self.turns: dict[tuple[str, str], tuple[str, ...]] = {}

    def add_body(self, name: str, kind: str, points: tuple[str, ...]) -> str:
        """Enter a body and return its name, with a number where there is one of that name."""
        taken = {body.name for body in self.bodies}
        found = next(each for each in (name, *(f"{name} {k}" for k in range(2, len(taken) + 3))) if each not in taken)
        self.bodies.append(ChainBody(found, kind, points))
        return found

    def add_cylinder(self, name: str, P: str, Q: str) -> None:
        """Enter a cylinder: a barrel on P, a rod on Q, and their slide."""
        self.slides.append(Pair("slide", name, self.add_body(f"{name} barrel", "barrel", (P,)), self.add_body(f"{name} rod", "rod", (Q,))))

    def bodies_at(self, point: str) -> list[ChainBody]:
        """Return the bodies of a point, the frame first."""
        return [body for body in self.bodies if point in body.points]

    def block(self, points: Sequence[str]) -> str:
        """Return the sliding block of some points; "" where there is none yet."""
        return next((body.name for body in self.bodies if body.kind == "block" and body.points == points), "")

    def body_of(self, points: Sequence[str]) -> str:
        """Return the body of some points, or of the first of them; the frame where none has it."""
        both = [body for body in self.bodies if points and set(points) <= set(body.points)]
        return next((body.name for body in (*both, *(self.bodies_at(points[0]) if points else ()))), FRAME)

    @property
    def pins(self) -> Iterator[Pair]:
        """The pins, by point."""
        for point in dict.fromkeys(point for body in self.bodies for point in body.points):
            first, *others = (body.name for body in self.bodies_at(point))
            for other in others:
                yield Pair("pin", point, first, other, self.turns.get((point, other), self.turns.get((point, first), ())))

    @property
    def pairs(self) -> tuple[Pair, ...]:
        """All pairs, pins first."""
        return (*self.pins, *self.slides)

    @property
    def gruebler_count(self) -> int:
        """The Gruebler count 3 (n - 1) - 2 j."""
        return 3 * (len(self.bodies) - 1) - 2 * len(self.pairs)


def chain_of(plan: Members) -> KinematicChain:
    """Return the chain of a mechanism."""
    arms = {name: arm_points(plan, name) for name in plan.telescopes}
    carrying = carrying_pairs(plan)
    apart = [body for body in plan.links if holds_an_arm(plan, body.points) or any(pair <= set(body.points) for pair in carrying)]
    chain = KinematicChain([body for body in plan.links if body.fixed or body not in apart])
    driven = {frozenset((bar.P, bar.Q)): bar for bar in plan.cylinders}
    others = [[point for point in plan.points if point in pair] for pair in carrying if pair not in driven]
    for P, Q in (*((bar.P, bar.Q) for bar in plan.cylinders), *others):
        part, ends = KinematicChain(()), (P, Q)
        part.add_cylinder(spanning_name(plan, P, Q), P, Q)
        on_it = next((body.points for body in plan.links[1:] if frozenset(ends) in carrying and set(ends) <= set(body.points)), ends)
        near, far = member_sides(plan, ends, on_it)
        chain.bodies += [
            body._replace(points=(end, *(point for point in on_it if point in side and point != end)))
            for body, end, side in zip(part.bodies, ends, (near, far), strict=True)
        ]
        bar = driven.get(frozenset(ends))
        chain.slides += part.slides if bar is None else [
            replace(each, strokes=driven_by(plan, bar.length), length=bar.length) for each in part.slides
        ]
    for name, points in arms.items():
        enter_arm(chain, plan, name, points)
    found = [(name, joint) for name, point in plan.points.items() if name not in plan.resting for joint in point.joints()]
    found += [(slide.name, joint) for group in plan.groups.values() for slide in group.slides for joint in slide.joints()]
    halves = [(name, joint) for name, joint in found if joint.is_half]
    for _, joint in halves:
        for side in (joint.on, joint.by):
            if side.role == "slider" and not chain.block(side.points):
                chain.add_body(f"{side.points[0]} (slider)", "block", side.points)
    blocks = [(name, joint, moved_side(chain, joint)) for name, joint in halves]
    for name, joint, block in blocks:
        has_slot = joint.on.role == "slider" and joint.point not in joint.on.points
        line = guided_by(chain, plan, joint.on if has_slot else joint.by)
        strokes = tuple(each for drive in joint.drives for each in driven_by(plan, drive.quantity))
        along = joint.track[0] if len(joint.track) == 1 and joint.track[0] in plan.members else name
        chain.slides.append(Pair("slide", along, line, block, strokes, joint.drives[0].quantity if joint.drives else None))
    for _, joint in plan.joints:
        if joint.kind == "crank":
            turned = chain.body_of(joint.on.points)
            chain.turns[joint.point, turned] = tuple(each for drive in joint.drives for each in driven_by(plan, drive.quantity))
    return chain


def driven_by(plan: Members, quantity: Quantity) -> tuple[str, ...]:
    """Return the strokes that a driven quantity follows by itself, not through points."""
    found = strokes_alone(quantity, plan.members)
    return tuple(name for name in plan.strokes if name in found)


def strokes_alone(quantity: Quantity, members: Mapping[str, Member]) -> tuple[str, ...]:
    """Return the strokes among the members of a class that a quantity follows by itself, not through points."""
    found = needed_behind([quantity.name] if quantity.name else needs(quantity), members, barred=Point)
    return tuple(name for name in of_kind(members, Stroke) if name in found)


def moved_side(chain: KinematicChain, joint: Joint) -> str:
    """Return the body that slides: the one that moves without turning where the joint names it, else a block at its point."""
    if joint.on.role == "slider" and joint.point in joint.on.points:
        return chain.block(joint.on.points)
    return chain.add_body(f"{joint.point} (block)", "block", (joint.point,))


def guided_by(chain: KinematicChain, plan: Members, side: JointSide) -> str:
    """Return the body that a line belongs to."""
    guide = plan.guide_of(side)
    if side.role == "slider":
        return chain.block(side.points)
    return chain.body_of(side.points if guide is None else guide.points)


# Arms: what a driven joint moves along or about its body.


def arm_points(plan: Members, name: str) -> tuple[str, ...]:
    """Return the points of an arm: the one that a stroke moves, and all that are rigid with it."""
    base = set(arm_joint(plan, name).by.points)
    own = [body.points for body in plan.links[1:] if name in body.points and base & set(body.points)]
    return tuple(dict.fromkeys(point for body in ((name,), *own) for point in body if point not in base))


def arm_joint(plan: Members, name: str) -> Joint:
    """Return the joint of an arm on its body."""
    return next(joint for owner, joint in plan.joints if owner == name and joint.arm)


def holds_an_arm(plan: Members, points: tuple[str, ...]) -> bool:
    """Return whether a body only consists of an arm and points of its carrier; the arm then is a body itself."""
    return any(joint.arm and name in points and set(joint.by.points) & set(points) for name, joint in plan.joints)


def enter_arm(chain: KinematicChain, plan: Members, name: str, points: tuple[str, ...]) -> None:
    """Enter an arm: a slide on its body, a pin, or both with a carriage between them, according to its driving strokes."""
    joint = arm_joint(plan, name)
    pushed = plan.pushing(joint)
    turned = tuple(each for drive in joint.drives if drive.along != "t" for each in driven_by(plan, drive.quantity))
    title = body_name(points)
    if pushed is None:
        chain.turns[joint.point, chain.add_body(title, "arm", (joint.point, *points))] = turned
        return
    on = chain.body_of(joint.by.points)
    if any(drive.along != "t" and plan.moves(drive.quantity) for drive in joint.drives):
        on = chain.add_body(f"{joint.point} (carriage)", "carriage", (joint.point,))
        chain.turns[joint.point, on] = turned
    arm = chain.add_body(title, "arm", points)
    chain.slides.append(Pair("slide", name, on, arm, driven_by(plan, pushed), pushed))
