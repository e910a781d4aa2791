"""The bodies of a mechanism whose drives are locked: links, sliders, telescope arms, and straight two-point members."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import final

from ..errors import DefinitionError
from ..loads import ForceElement, PinFriction
from ..plan import Plan, arm_joint, arm_points, holds_an_arm
from ..quantities import Quantity, name_of
from ..steps import Link
from .acting import ActingThrust, member_title
from .holding import Holders, PressureLine

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
class Strut:
    """A straight two-point member P -> Q: a driven length, a cylinder that holds, or a member whose thrust a law gives.

    `quantity` is the driven length [m], None where the points alone tell it; `far` are the points on Q's side; `host` the declared
    link that it is part of, if any; `line` what it holds with; `known` its thrust where a law gives it, so that it drives nothing.
    """

    name: str
    P: str
    Q: str
    quantity: Quantity | None = None
    far: frozenset[str] = frozenset()
    host: str = ""
    line: PressureLine | None = None
    known: ActingThrust | None = None


def free_bodies(plan: Plan, holders: Holders, thrusts: Sequence[ActingThrust]) -> tuple[tuple[FreeBody, ...], tuple[Strut, ...]]:
    """Return the bodies and the two-point members: sliders first, then links, then those members that are bodies of their own."""
    fixed = frame_points(plan)
    sides = [side for _, joint in plan.joints for side in (joint.on, joint.by) if side.role == "slider"]
    sliders = [slider(point) for point in dict.fromkeys(side.points[0] for side in sides) if point not in fixed]
    arms = [telescope(plan, name) for name in plan.telescopes]
    inner = {frozenset(arm.points) for arm in arms}
    links = [
        FreeBody(body.name, body.points, (body.points[0], body.points[1]), label=link_name(plan, body.points))
        for body in plan.links[1:]
        if frozenset(body.points) not in inner and not holds_an_arm(plan, body.points)
    ]
    driven = [with_host(plan, strut, links) for strut in driven_lengths(plan, holders)]
    cylinders = [Strut(member_title(each), *each.ends, line=line) for line in holders.lines for each in line.cylinders]
    struts = [*driven, *(replace(strut, far=frozenset({strut.Q})) for strut in (*cylinders, *known_struts(thrusts)))]
    twice = next((name for name, count in Counter(strut.name for strut in struts).items() if count > 1), None)
    if twice:
        raise DefinitionError(f"{plan.title}: two elements are called {twice}; give each a name of its own in the class.")
    own = [FreeBody(strut.name, (strut.P, strut.Q), (strut.P, strut.Q), label=strut.P + strut.Q) for strut in struts if not strut.host]
    return (*sliders, *arms, *links, *own), tuple(struts)


def frame_points(plan: Plan) -> frozenset[str]:
    """Return the points that do not move."""
    return frozenset(plan.links[0].points if plan.links else ()) | set(plan.ground)


def slider(point: str) -> FreeBody:
    """Return the body of its own that slides at a point without turning."""
    return FreeBody(f"{point} (slider)", (point,), slides=True)


def sliding_blocks(
    plan: Plan, elements: Iterable[ForceElement], bodies: Iterable[FreeBody], sliding: Iterable[str]
) -> tuple[FreeBody, ...]:
    """Return the sliding blocks that friction asks for: of pins that rub, run on one guide or slot, and join one link only."""
    pins = dict.fromkeys(name_of(each.point) for each in elements if isinstance(each, PinFriction))
    joined, guides = Counter(point for body in bodies for point in body.points), Counter(sliding)
    fixed = frame_points(plan)
    return tuple(slider(point) for point in pins if joined[point] == 1 and guides[point] == 1 and point not in fixed)


def link_name(plan: Plan, points: tuple[str, ...]) -> str:
    """Return the name of the link that declares a body; empty where none does."""
    return next((name for name, link in plan.of_kind(Link).items() if set(link.point_names) <= set(points)), "")


# Straight members: driven lengths, cylinders that hold, members with a law of their own.


def driven_lengths(plan: Plan, holders: Holders) -> list[Strut]:
    """Return the lengths that a step drives, where no cylinder has taken over all their strokes."""
    found = []
    for bar in plan.cylinders:
        strokes = {name for name in plan.strokes if name == bar.length.name or name in plan.reaches(bar.length)}
        if strokes - holders.taken:
            found.append(Strut(bar.P + bar.Q, bar.P, bar.Q, bar.length))
    return found


def with_host(plan: Plan, strut: Strut, links: Sequence[FreeBody]) -> Strut:
    """Return a driven length with the link that it is part of, where both its points belong to one, and the points that go with Q."""
    host = next((link for link in links if {strut.P, strut.Q} <= set(link.points)), None)
    far = {strut.Q}
    for point in host.points if host else ():
        if far & {name for body in plan.points[point].bodies() for name in body[:1] if point not in body[:2]}:
            far.add(point)
    return replace(strut, far=frozenset(far), host=host.name if host else "")


def known_struts(thrusts: Sequence[ActingThrust]) -> list[Strut]:
    """Return the members whose thrust is known; those without names of their own are counted."""
    unnamed = Counter(each.name for each in thrusts if not each.name.isidentifier())
    counts: Counter[str] = Counter()
    found = []
    for each in thrusts:
        counts[each.name] += 1
        name = f"{each.name} {counts[each.name]}" if unnamed[each.name] > 1 else each.name
        found.append(Strut(name, *each.ends, known=each))
    return found


# Telescopes: an arm that a driven joint moves along or about its body.


def telescope(plan: Plan, name: str) -> FreeBody:
    """Return the arm that a driven joint moves: its point and all that is rigid with it."""
    joint = arm_joint(plan, name)
    refuse_driven(plan, joint.still)
    points = arm_points(plan, name)
    return FreeBody("".join(points), points, (joint.point, name))


def refuse_driven(plan: Plan, still: Iterable[tuple[Quantity, str]]) -> None:
    """Raise DefinitionError for a quantity that follows a stroke where its force is not provided."""
    for quantity, what in still:
        if plan.moves(quantity):
            provided = "forces are provided for driven lengths, cranks, OnGuide and OnLink"
            raise DefinitionError(f"{plan.title}: {what} follows a stroke; {provided}.")
