"""The bodies of a mechanism whose drives are locked: links, sliders, telescope arms, and straight two-point members."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from itertools import product
from typing import TypeAlias, final

import numpy as np

from ..errors import DefinitionError
from ..loads import ForceElement, Halves, PinFriction, Push, TwoPoint
from ..plan import Plan, arm_joint, arm_points, carrying_pairs, holds_an_arm, member_sides
from ..quantities import Quantity, Where, body_name, joined_names, name_of
from ..steps import Link
from ..vectors import Line
from .applied import member_title
from .holding import Holders, PressureLine, same, sampled


class NotHeldError(DefinitionError):
    """A body of a machine is held by nothing, so that it has no forces."""


FRAME = -1
FRAME_NAME = "frame"


@final
@dataclass(frozen=True)
class FreeBody:
    """One body that is held in equilibrium. `axis`: two points that turn with it; `slides`: a lone point guided without turning."""

    name: str
    points: tuple[str, ...]
    axis: tuple[str, str] | None = None
    slides: bool = False
    label: str = ""


@final
@dataclass(frozen=True, eq=False)
class SlidingPair:
    """A straight member of two bodies, the second of which slides in the first; see `Halves`."""

    member: TwoPoint
    halves: Halves
    bodies: tuple[FreeBody, FreeBody]

    @property
    def points(self) -> set[str]:
        """The points of both bodies."""
        return {point for body in self.bodies for point in body.points}

    def line(self, point: str) -> Callable[[Where], Line]:
        """Return the line through a point on the axis, from A towards B."""
        A, B = self.member.ends
        return lambda where: Line(where.at(point), (where.at(B) - where.at(A)) * (1.0 / where.link_length(A, B)))


@final
@dataclass(frozen=True, eq=False)
class Strut:
    """A straight two-point member P -> Q: a driven length, a cylinder that holds, or a member whose thrust a law gives.

    `quantity` is the driven length [m], None if the points alone give it. `far` are the points on Q's side. `host` is the body that it
    forms with the points measured along it, if any. `pair` are its two bodies, if it has two. `line` is what it holds with. `known` is its
    thrust if a law gives it, so that it drives nothing.
    """

    name: str
    P: str
    Q: str
    quantity: Quantity | None = None
    far: frozenset[str] = frozenset()
    host: str = ""
    line: PressureLine | None = None
    known: Push | None = None
    pair: SlidingPair | None = None

    @property
    def ends(self) -> tuple[str, str]:
        """The points at its ends."""
        return self.P, self.Q

    @property
    def is_cylinder(self) -> bool:
        """Whether it is a member that holds, or that would where nothing fed it."""
        member = None if self.known is None else self.known.member
        return self.line is not None or (isinstance(member, TwoPoint) and member.holds)


Bodies: TypeAlias = tuple[tuple[FreeBody, ...], tuple[Strut, ...], tuple[SlidingPair, ...]]
"""The bodies, the two-point members, and the pairs of bodies that some of them are."""


def free_bodies(plan: Plan, holders: Holders, thrusts: Sequence[Push]) -> Bodies:
    """Return the bodies and the two-point members: sliders first, then links, then those members that are bodies of their own."""
    fixed = frame_points(plan)
    sides = [side for _, joint in plan.joints for side in (joint.on, joint.by) if side.role == "slider"]
    sliders = [slider(point) for point in dict.fromkeys(side.points[0] for side in sides) if point not in fixed]
    arms = [telescope(plan, name) for name in plan.telescopes]
    inner = {frozenset(arm.points) for arm in arms}
    links, declared = [], [(name, set(link.point_names)) for name, link in plan.of_kind(Link).items()]
    for body in plan.links[1:]:
        if frozenset(body.points) not in inner and not holds_an_arm(plan, body.points):
            label = next((name for name, points in declared if points <= set(body.points)), "")
            links.append(FreeBody(body.name, body.points, (body.points[0], body.points[1]), label=label))
    pairs = sliding_pairs(plan, links)
    links = [link for link in links if not any(set(link.points) == pair.points for pair in pairs)]
    struts, hosts = two_point_members(plan, holders, thrusts, links)
    struts = tuple(replace(each, pair=next((pair for pair in pairs if pair.member.name == each.name), None)) for each in struts)
    renamed = [each for each in struts if each.host == each.name]
    links = [link for link in links if link not in [hosts[each.name] for each in renamed]]
    carrying = [replace(hosts[each.name], name=each.name, axis=each.ends) for each in renamed]
    alone = [each for each in struts if not each.host and each.pair is None]
    own = [FreeBody(each.name, each.ends, each.ends, label=joined_names(*each.ends)) for each in alone]
    return (*sliders, *arms, *links, *carrying, *own, *(body for pair in pairs for body in pair.bodies)), struts, pairs


def frame_points(plan: Plan) -> frozenset[str]:
    """Return the points that do not move."""
    return frozenset(plan.links[0].points if plan.links else ()) | set(plan.ground)


def slider(point: str) -> FreeBody:
    """Return the body of its own that slides at a point without turning."""
    return FreeBody(f"{point} (slider)", (point,), slides=True)


def sliding_blocks(
    plan: Plan, elements: Iterable[ForceElement], bodies: Iterable[FreeBody], sliding: Iterable[str]
) -> tuple[FreeBody, ...]:
    """Return the sliding blocks that friction asks for: of pins with friction that run on one guide or slot and join one link only."""
    pins = dict.fromkeys(name_of(each.point) for each in elements if isinstance(each, PinFriction))
    joined, guides = Counter(point for body in bodies for point in body.points), Counter(sliding)
    fixed = frame_points(plan)
    return tuple(slider(point) for point in pins if joined[point] == 1 and guides[point] == 1 and point not in fixed)


# Straight members: driven lengths, cylinders that hold, members with a law of their own.


def two_point_members(
    plan: Plan, holders: Holders, thrusts: Sequence[Push], links: Sequence[FreeBody]
) -> tuple[tuple[Strut, ...], dict[str, FreeBody]]:
    """Return the two-point members, and by their names the declared bodies that they are together with the points along them."""
    cylinders = [Strut(member_title(each), *each.ends, line=holders.line_of(each)) for each in holders.cylinders]
    given = [each for each in thrusts if not any(same(one, each.member) for one in holders.cylinders)]
    found = []
    for bar in plan.cylinders:
        strokes = {name for name in plan.strokes if name == bar.length.name or name in plan.reaches(bar.length)}
        if strokes - holders.taken and not holders.given & plan.reaches(bar.length):
            found.append(Strut(joined_names(bar.P, bar.Q), bar.P, bar.Q, bar.length))
    struts = [*found, *cylinders, *known_struts(given)]
    twice = next((name for name, count in Counter(strut.name for strut in struts).items() if count > 1), None)
    if twice:
        raise DefinitionError(f"{plan.title}: two elements are called {twice}; give each a name of its own in the class.")
    # The declared bodies that are members with the points measured along them. One member a body: of several between the same points
    # the cylinder, then the driven length, then the first of the others. A body that a stroke drives keeps its own name.
    inside = [(strut, link) for strut in struts for link in links if {strut.P, strut.Q} <= set(link.points)]
    carrying, hosts = carrying_pairs(plan, (each.ends for each, _ in inside)) if inside else set(), dict[str, FreeBody]()
    for strut, link in sorted(inside, key=lambda each: (not each[0].is_cylinder, each[0].quantity is None)):
        if link not in hosts.values() and (strut.quantity is not None or frozenset(strut.ends) in carrying):
            hosts.setdefault(strut.name, link)
    for place, strut in enumerate(struts):
        host = hosts.get(strut.name)
        name = "" if host is None else strut.name if strut.quantity is None else host.name
        struts[place] = replace(strut, far=frozenset({strut.Q}) if host is None else far_points(plan, strut, host), host=name)
    return tuple(struts), hosts


def far_points(plan: Plan, strut: Strut, host: FreeBody) -> frozenset[str]:
    """Return the points that go with a member's end Q, of a cylinder those on its rod: measured from Q, or linked to such points.

    DefinitionError for a point that keeps its place on neither side, as on a triangle whose third side is the member.
    """

    def moves(_: Plan) -> dict[tuple[str, str], float]:
        """Return how far points move along and across it beside one of its ends, over the strokes and relative to their distance."""
        motion, found = sampled(plan), {}
        along = motion[strut.Q] - motion[strut.P]
        along = along / np.hypot(along[0], along[1])
        for point, end in product(host.points, strut.ends):
            arm = motion[point] - motion[end]
            parts = np.stack([arm[0] * along[0] + arm[1] * along[1], along[0] * arm[1] - along[1] * arm[0]])[:, motion.reached]
            size = float(np.max(np.hypot(parts[0], parts[1]), initial=0.0)) or 1.0
            found[point, end] = float(np.max(np.ptp(parts, axis=1), initial=0.0)) / size if parts.size else 0.0
        return found

    near, far = member_sides(plan, strut.ends, host.points)
    moved = plan.made(("places", strut.P, strut.Q, host.points), moves)
    for point in host.points:
        kept = [end for end, side in ((strut.P, near), (strut.Q, far)) if point in side]
        if len(kept) != 1 or not moved[point, kept[0]] <= RIGID:
            given = plan.points[point]
            raise NotHeldError(
                f"{plan.title}: {point} = {given} is measured along {strut.name}, whose length {strut.P}{strut.Q} changes, and keeps its "
                f"place neither at {strut.P} nor at {strut.Q}, so that it is not held. Measure it from one of them, {point} = "
                f"OnLink({strut.P}, {strut.Q}, {strut.P}{point}=...), with an angle where it lies aside; or let two links meet there, "
                f"Dyad({strut.P}, {strut.Q}, ...)."
            )
    return frozenset(far)


def sliding_pairs(plan: Plan, links: Sequence[FreeBody]) -> tuple[SlidingPair, ...]:
    """Return the members of the class that are two bodies each; DefinitionError for several between the same two points."""
    found: list[SlidingPair] = []
    for member in plan.of_kind(TwoPoint).values():
        halves = member.halves(plan.members)
        if halves is None:
            continue
        host = next(link for link in links if {*member.ends, *halves.points} <= set(link.points))
        other = next((pair.member for pair in found if pair.points & {*halves.points}), None)
        if other is not None:
            what = f"{other.name} and {member.name} are two bodies each, and both are between {' and '.join(member.ends)}"
            raise DefinitionError(f"{plan.title}: {what}: which of them carries a point is not told. Declare one with count=2.")
        far = far_points(plan, Strut(member.name, *member.ends), host)
        parts = tuple(point for point in host.points if point not in far), tuple(point for point in host.points if point in far)
        axes = zip(member.ends, halves.points, strict=True)
        bodies = [FreeBody(*each) for each in zip(halves.names, parts, axes, (False, False), halves.labels, strict=True)]
        found.append(SlidingPair(member, halves, (bodies[0], bodies[1])))
    return tuple(found)


RIGID = 1e-7
"""A point that moves by less than this part of its distance keeps its place."""


def known_struts(thrusts: Sequence[Push]) -> list[Strut]:
    """Return the members whose thrust is known, each once: what several laws put on one adds up; those without names are counted."""
    found: list[Push] = []
    for each in thrusts:
        place = next((k for k, other in enumerate(found) if each.member.name and same(each.member, other.member)), len(found))
        found[place : place + 1] = [replace(one, thrust=one.thrust + each.thrust) for one in found[place : place + 1]] or [each]
    unnamed = Counter(each.name for each in found if not each.name.isidentifier())
    counts = Counter[str]()
    struts = []
    for each in found:
        counts[each.name] += 1
        name = f"{each.name} {counts[each.name]}" if unnamed[each.name] > 1 else each.name
        struts.append(Strut(name, *each.member.ends, known=each))
    return struts


# Telescopes: an arm that a driven joint moves along or about its body.


def telescope(plan: Plan, name: str) -> FreeBody:
    """Return the arm that a driven joint moves: its point and all that is rigid with it."""
    joint = arm_joint(plan, name)
    refuse_driven(plan, joint.still)
    points = arm_points(plan, name)
    return FreeBody(body_name(points), points, (joint.point, name))


def refuse_driven(plan: Plan, still: Iterable[tuple[Quantity, str]]) -> None:
    """Raise DefinitionError for a quantity that follows a stroke where its force is not provided."""
    for quantity, what in still:
        if plan.moves(quantity):
            provided = "forces are provided for driven lengths, cranks, OnGuide and OnLink"
            raise DefinitionError(f"{plan.title}: {what} follows a stroke; {provided}.")
