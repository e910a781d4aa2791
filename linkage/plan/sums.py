"""What sums of quantities are made of, and so which strokes and dimensions are angles."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from ..quantities import Member, Negative, Quantity, Ref, Sum, quantity
from ..steps import Group


def terms(members: Mapping[str, Member], given: Quantity) -> set[str]:
    """Return the names that a quantity is a sum of, through the members it goes by."""
    name = given.name or (given.target if isinstance(given, Ref) else "")
    member = members.get(name, given) if name else given
    parts = [part for part in member.parts() if isinstance(part, (str, Quantity))] if isinstance(member, (Sum, Negative)) else []
    return ({name} if name else set()).union(*(terms(members, quantity(part)) for part in parts))


def turning(members: Mapping[str, Member]) -> frozenset[str]:
    """Return the names of what angles are sums of: of cranks, guides, turned vectors, and labels that are angles."""
    return frozenset().union(*(terms(members, angle) for angle in angles(members)))


def angles(members: Mapping[str, Member]) -> Iterator[Quantity]:
    """Yield the quantities that stand for angles."""
    rigid = [step for member in members.values() if isinstance(member, Group) for step in member.rigid]
    for member in (*members.values(), *rigid):
        found = [getattr(member, "angle", None), getattr(member, "QPX", None)]
        yield from (angle for angle in found if isinstance(angle, Quantity))
