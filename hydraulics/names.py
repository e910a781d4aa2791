"""What members of a class are built from, by their names."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from linkage.quantities import Member, Reference, name_of, needs
from linkage.steps import Link


def names_behind(starts: Iterable[Reference], members: Mapping[str, Member]) -> set[str]:
    """Return the names that members of a class are built from, as far as they are there.

    Behind a pin of a parts list that no step places yet stand the links that hold it, with their other points.
    """
    stack, found = list[str](), set[str]()
    for each in starts:
        stack += needs(each) if isinstance(each, Member) and not each.name else [name_of(each)]
    while stack:
        name = stack.pop()
        if name in found:
            continue
        found.add(name)
        held = members.get(name)
        needed = [] if held is None else [*needs(held)]
        if held is not None and not needed and not getattr(held, "is_fixed", True):
            links = [each for each in members.values() if isinstance(each, Link) and name in each.point_names]
            needed = [other for each in links for other in (*needs(each), *each.point_names)]
        stack += needed
    return found
