"""The bodies of a mechanism whose drives are locked: links, sliders, telescope arms, and straight two-point members."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from ..errors import DefinitionError
from ..loads import ForceElement, PinFriction
from ..plan import Plan
from ..quantities import Quantity, name_of
from ..steps import Link
from .acting import Pushing, member_title
from .holding import Holding, Line

FRAME = -1
FRAME_NAME = "frame"


@dataclass(frozen=True)
class Part:
    """One body that is held in equilibrium. `axis`: two points that turn with it; `slides`: a lone point guided without turning."""

    name: str
    points: tuple[str, ...]
    axis: tuple[str, str] | None = None
    slides: bool = False
    label: str = ""


@dataclass(frozen=True, eq=False)
class Strut:
    """A straight two-point member P -> Q: a driven length, a cylinder that holds, or a member whose thrust a law gives.

    `quantity` is the driven length [m], None where the points alone tell it; `far` are the points on Q's side; `host` the declared
    link that it is part of, if any; `line` what it holds with; `pushing` the thrust that is known.
    """

    name: str
    P: str
    Q: str
    quantity: Quantity | None = None
    far: frozenset[str] = frozenset()
    host: str = ""
    line: Line | None = None
    pushing: Pushing | None = None

    @property
    def label(self) -> str:
        """Its points joined."""
        return self.P + self.Q

    @property
    def drives(self) -> bool:
        """Whether its thrust is what its stroke needs, not what a law gives."""
        return self.pushing is None


def frame_points(plan: Plan) -> frozenset[str]:
    """Return the points that do not move."""
    return frozenset(plan.links[0].points if plan.links else ()) | set(plan.ground)


def parts(plan: Plan, holding: Holding, pushing: Sequence[Pushing]) -> tuple[tuple[Part, ...], tuple[Strut, ...]]:
    """Return the bodies and the two-point members: sliders first, then links, then those members that are bodies of their own."""
    arms = [telescope(plan, name) for name in plan.telescopes]
    inner = {frozenset(arm.points) for arm in arms}
    sliders = [Part(f"{name} (slider)", (name,), slides=True) for name in lone_sliders(plan)]
    links = [
        Part(body.name, body.points, (body.points[0], body.points[1]), label=titled(plan, body.points))
        for body in plan.links[1:]
        if frozenset(body.points) not in inner and not swallowed(plan, body.points)
    ]
    struts = [hosted(plan, strut, links) for strut in (*driven_lengths(plan, holding), *holders(holding), *pushed(pushing))]
    names = Counter(strut.name for strut in struts)
    twice = next((name for name, count in names.items() if count > 1), None)
    if twice:
        raise DefinitionError(f"{plan.title}: two elements are called {twice}; give each a name of its own in the class.")
    own = [Part(strut.name, (strut.P, strut.Q), (strut.P, strut.Q), label=strut.label) for strut in struts if not strut.host]
    return (*sliders, *arms, *links, *own), tuple(struts)


def lone_sliders(plan: Plan) -> tuple[str, ...]:
    """Return the moving points that have a body of their own there, which moves without turning."""
    fixed = frame_points(plan)
    sides = [side for _, joint in plan.joints for side in (joint.on, joint.by) if side.role == "slider"]
    return tuple(dict.fromkeys(side.points[0] for side in sides if side.points[0] not in fixed))


def blocks(plan: Plan, elements: Iterable[ForceElement], bars: Iterable[Part], sliding: Iterable[str]) -> tuple[Part, ...]:
    """Return the sliding blocks that friction asks for: of pins that rub, run on one guide or slot, and join one link only."""
    rubbing = dict.fromkeys(name_of(each.point) for each in elements if isinstance(each, PinFriction))
    joined, guides = Counter(point for bar in bars for point in bar.points), Counter(sliding)
    fixed = frame_points(plan)
    asked = (point for point in rubbing if joined[point] == 1 and guides[point] == 1 and point not in fixed)
    return tuple(Part(f"{point} (slider)", (point,), slides=True) for point in asked)


def titled(plan: Plan, points: tuple[str, ...]) -> str:
    """Return the name of the link that declares a body; empty where none does."""
    return next((name for name, link in plan.of_kind(Link).items() if set(link.point_names) <= set(points)), "")


def driven_lengths(plan: Plan, holding: Holding) -> list[Strut]:
    """Return the lengths that a step drives, where no cylinder has taken over all their strokes."""
    found = []
    for bar in plan.cylinders:
        strokes = {name for name in plan.strokes if name == bar.length.name or name in plan.reaches(bar.length)}
        if strokes - holding.taken:
            found.append(Strut(bar.P + bar.Q, bar.P, bar.Q, bar.length))
    return found


def holders(holding: Holding) -> list[Strut]:
    """Return the cylinders that hold."""
    return [Strut(member_title(each), *each.ends, line=line) for line in holding.lines for each in line.cylinders]


def pushed(pushing: Sequence[Pushing]) -> list[Strut]:
    """Return the members whose thrust is known."""
    unnamed = Counter(each.name for each in pushing if not each.name.isidentifier())
    counts: Counter[str] = Counter()
    found = []
    for each in pushing:
        name = each.name
        if unnamed[name] > 1:
            counts[name] += 1
            name = f"{name} {counts[name]}"
        found.append(Strut(name, *each.ends, pushing=each))
    return found


def hosted(plan: Plan, strut: Strut, links: Sequence[Part]) -> Strut:
    """Return a strut with the link that it is part of, where it is a driven length between two points of one."""
    host = next((link for link in links if {strut.P, strut.Q} <= set(link.points)), None) if strut.quantity is not None else None
    far = far_side(plan, strut.Q, host.points if host else (strut.Q,))
    return Strut(strut.name, strut.P, strut.Q, strut.quantity, far, host.name if host else "", strut.line, strut.pushing)


def far_side(plan: Plan, Q: str, points: Iterable[str]) -> frozenset[str]:
    """Return the points of a body that move with Q's end of a cylinder in it."""
    side = {Q}
    for point in points:
        if side & {name for body in plan.points[point].bodies() for name in body[:1] if point not in body[:2]}:
            side.add(point)
    return frozenset(side)


def telescope(plan: Plan, name: str) -> Part:
    """Return the arm that a driven joint moves: its point and all that is rigid with it."""
    joint = next(joint for owner, joint in plan.joints if owner == name and joint.arm)
    refuse_driven(plan, joint.still)
    base = set(joint.by.points)
    own = [body.points for body in plan.links[1:] if name in body.points and base & set(body.points)]
    candidates = (point for body in ((name,), *own) for point in body)
    points = tuple(dict.fromkeys(point for point in candidates if point not in base))
    return Part("".join(points), points, (joint.point, name))


def swallowed(plan: Plan, points: tuple[str, ...]) -> bool:
    """Return whether a body is the arm of a telescope, which stands for itself."""
    arms = [(name, joint) for name, joint in plan.joints if joint.arm]
    return any(name in points and set(joint.by.points) & set(points) for name, joint in arms)


def refuse_driven(plan: Plan, still: Iterable[tuple[Quantity, str]]) -> None:
    """Raise DefinitionError for a quantity that follows a stroke where its force is not provided."""
    for quantity, what in still:
        if plan.moves(quantity):
            provided = "forces are provided for driven lengths, cranks, OnGuide and OnLink"
            raise DefinitionError(f"{plan.title}: {what} follows a stroke; {provided}.")
