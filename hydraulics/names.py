"""What members of a class are built from, by their names."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from linkage.quantities import Member, Reference, name_of, needs
from linkage.steps import Link


def named_in(reference: Reference) -> Iterable[str]:
    """Return the name of what is referred to, or the names that it is made of where it has none."""
    return needs(reference) if isinstance(reference, Member) and not reference.name else [name_of(reference)]


def names_behind(starts: Iterable[Reference], members: Mapping[str, Member]) -> set[str]:
    """Return the names that members of a class are built from, as far as they are there."""
    stack, found = [name for each in starts for name in named_in(each)], set[str]()
    while stack:
        name = stack.pop()
        if name not in found:
            found.add(name)
            stack += needs(members[name]) if name in members else ()
            stack += needed_by_links(name, members)
    return found


def needed_by_links(pin: str, members: Mapping[str, Member]) -> list[str]:
    """Return the names that the links of a parts list need which hold a pin that no step places yet, the links' other points too."""
    held = members.get(pin)
    if held is None or getattr(held, "is_fixed", True) or any(True for _ in needs(held)):
        return []
    links = [each for each in members.values() if isinstance(each, Link) and pin in each.point_names]
    return [name for each in links for name in (*needs(each), *each.point_names)]
