"""The bodies of a mechanism whose drives are locked: links, cylinders, sliders, telescope arms."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass

from ..errors import DefinitionError
from ..loads import ForceElement, PinFriction
from ..plan import Plan
from ..quantities import Quantity, name_of
from ..steps import Guide, Link, OnLink, YokeDyad
from .coordinates import fed

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


@dataclass(frozen=True)
class Ram:
    """A driven length P -> Q [m]; `far` are the points on Q's side. `quantity` is None where the points alone tell it."""

    P: str
    Q: str
    quantity: Quantity | None
    far: frozenset[str]

    @property
    def name(self) -> str:
        """The cylinder's name."""
        return self.P + self.Q


def frame_points(plan: Plan) -> frozenset[str]:
    """Return the points that do not move."""
    return frozenset(plan.links[0].points if plan.links else ()) | set(plan.ground)


def parts(plan: Plan, elements: tuple[ForceElement, ...]) -> tuple[tuple[Part, ...], tuple[Ram, ...]]:
    """Return the bodies and the driven lengths: sliders first, then links, then cylinders."""
    arms = [telescope(plan, name) for name in plan.telescopes]
    inner = {frozenset(arm.points) for arm in arms}
    lone = dict.fromkeys([*plan.of_kind(YokeDyad), *upright(plan, frame_points(plan))])
    sliders = [Part(f"{name} (slider)", (name,), slides=True) for name in lone]
    links = [
        Part(body.name, body.points, (body.points[0], body.points[1]), label=titled(plan, body.points))
        for body in plan.links[1:]
        if frozenset(body.points) not in inner and not swallowed(plan, body.points)
    ]
    rams, cylinders = [], []
    for P, Q, length in driven_pairs(plan, elements):
        host = next((link for link in links if {P, Q} <= set(link.points)), None)
        rams.append(Ram(P, Q, length, far_side(plan, Q, host.points if host else (Q,))))
        if host is None:
            cylinders.append(Part(P + Q, (P, Q), (P, Q)))
    return (*sliders, *arms, *links, *cylinders), tuple(rams)


def blocks(plan: Plan, elements: Iterable[ForceElement], bars: Iterable[Part], sliding: Iterable[str]) -> tuple[Part, ...]:
    """Return the sliding blocks that friction asks for: of pins that rub, run on one guide or slot, and join one link only."""
    rubbing = dict.fromkeys(name_of(each.point) for each in elements if isinstance(each, PinFriction))
    joined, guides = Counter(point for bar in bars for point in bar.points), Counter(sliding)
    fixed = frame_points(plan)
    asked = (point for point in rubbing if joined[point] == 1 and guides[point] == 1 and point not in fixed)
    return tuple(Part(f"{point} (slider)", (point,), slides=True) for point in asked)


def upright(plan: Plan, fixed: frozenset[str]) -> list[str]:
    """Return the moving points through which guides of a given direction go: a slider there carries the guide."""
    guides = [guide for guide in plan.of_kind(Guide).values() if guide.Q is None]
    return list(dict.fromkeys(point for guide in guides for point in guide.points if point not in fixed))


def titled(plan: Plan, points: tuple[str, ...]) -> str:
    """Return the name of the link that declares a body; empty where none does."""
    return next((name for name, link in plan.of_kind(Link).items() if set(link.point_names) <= set(points)), "")


def driven_pairs(plan: Plan, elements: tuple[ForceElement, ...]) -> list[tuple[str, str, Quantity | None]]:
    """Return the ends and the length of every cylinder that holds: declared by a step, or by a force element."""
    found: dict[frozenset[str], tuple[str, str, Quantity | None]] = {}
    for bar in plan.cylinders:
        found.setdefault(frozenset((bar.P, bar.Q)), (bar.P, bar.Q, bar.length))
    loads = fed(plan, elements)
    for element in elements:
        for P, Q in element.cylinders():
            if frozenset((P, Q)) not in loads:
                found.setdefault(frozenset((P, Q)), (P, Q, None))
    return list(found.values())


def far_side(plan: Plan, Q: str, points: Iterable[str]) -> frozenset[str]:
    """Return the points of a body that move with Q's end of a cylinder in it."""
    side = {Q}
    for point in points:
        step = plan.members[point]
        if isinstance(step, OnLink) and step.P in side:
            side.add(point)
    return frozenset(side)


def telescope(plan: Plan, name: str) -> Part:
    """Return the arm that a driven OnLink moves: its point and all that is rigid with it."""
    step = plan.members[name]
    assert isinstance(step, OnLink)
    if plan.moves(step.QX):
        raise DefinitionError(f"{step.sentence()}: its third side follows a stroke; for forces declare a Dyad({step.P}, {step.Q}, ...).")
    own = [body.points for body in plan.links[1:] if name in body.points and {step.P, step.Q} & set(body.points)]
    candidates = (point for body in ((name,), *own) for point in body)
    points = tuple(dict.fromkeys(point for point in candidates if point not in (step.P, step.Q)))
    return Part("".join(points), points, (step.P, name))


def swallowed(plan: Plan, points: tuple[str, ...]) -> bool:
    """Return whether a body is the arm of a telescope, which stands for itself."""
    steps = [step for name in plan.telescopes if isinstance(step := plan.members[name], OnLink)]
    return any(step.X in points and {step.P, step.Q} & set(points) for step in steps)
