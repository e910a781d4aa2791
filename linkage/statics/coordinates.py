"""Who holds the strokes: the steps that drive them, or cylinders that are declared beside the steps."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from ..loads import ForceElement
from ..plan import Plan
from ..quantities import Quantity
from ..steps import Crank, OnGuide, OnLink
from .turns import drives_of


def turned(plan: Plan) -> Iterator[tuple[str, Quantity]]:
    """Yield the cranks and driven points with what drives them."""
    for name, crank in plan.of_kind(Crank).items():
        yield from ((name, term) for _, term in drives_of(plan, crank) if plan.moves(term))
    for name, point in plan.of_kind(OnGuide).items():
        if plan.moves(point.along):
            yield name, point.along


def followed(plan: Plan, quantities: Iterable[Quantity]) -> list[str]:
    """Return the strokes that quantities follow, as often as they do."""
    return [name for each in quantities for name in plan.strokes if name in {each.name, *plan.reaches(each)}]


def fed(plan: Plan, elements: tuple[ForceElement, ...]) -> set[frozenset[str]]:
    """Return the ends of cylinders whose force an element gives: they hold nothing where steps drive all strokes."""
    arms = [step for name in plan.telescopes if isinstance(step := plan.members[name], OnLink)]
    lengths = [bar.length for bar in plan.cylinders] + [part for arm in arms for part in (arm.PX, arm.QPX)]
    if set(followed(plan, [*lengths, *(quantity for _, quantity in turned(plan))])) < set(plan.strokes):
        return set()
    return {frozenset(pair) for element in elements for pair in element.feeds(plan.members)}


def replaced(plan: Plan, declared: int) -> frozenset[str]:
    """Return the cranks and driven points that are only coordinates: as many declared cylinders hold in their place.

    A boom given by its angle, `B = Crank(O, OB=2, angle=phi)`, with its `lift = Cylinder(K, B, ...)` is held by the cylinder.
    """
    drives = list(turned(plan))
    strokes = followed(plan, (quantity for _, quantity in drives))
    others = followed(plan, (bar.length for bar in plan.cylinders))
    alone = len(set(strokes)) == len(strokes) == len(drives) and not set(strokes) & set(others)
    return frozenset(name for name, _ in drives) if alone and declared == len(drives) else frozenset()
