"""Where the pins of a part's groups are to begin in the whole: as they stand in the part's own sketch, moved with the part."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np

from ..plan import Part
from ..quantities import Member, needs
from ..steps import Group, Pin
from .sketch import Place, Sketch, places_at


def with_begun_pins(members: Mapping[str, Member], title: str) -> dict[str, Member]:
    """Return the members of a class, the pins of its parts' groups near the places that they have in the parts' own sketches."""
    found = dict(members)
    for name, part in members.items():
        if not isinstance(part, Part) or "." in name:
            continue  # what stands in a part was begun with its class
        if part.plan.groups and not part.stands_as_alone:
            begin(name, part, found, title)
    return found


def begin(name: str, part: Part, members: dict[str, Member], title: str) -> None:
    """Let the pins of a part begin where its own sketch has them, turned and moved as the points are that its groups hang on."""
    own, _ = places_at(part.plan, part.plan.sketch_strokes)
    for group in part.plan.groups.values():
        bound = members.get(f"{name}.{group.name}")
        if not isinstance(bound, Group):
            continue
        outside = [(each, f"{name}.{each}") for each in part.plan.points if each not in group.pins]
        outside = [(each, part.aliases.get(dotted, dotted)) for each, dotted in outside]
        held = {each for each in needs(bound) if each in members}
        pairs = [(each, dotted) for each, dotted in outside if dotted in held]
        sketch = Sketch(all_behind(members, [dotted for _, dotted in pairs]), title)
        places = laid_on([own[each] for each, _ in pairs], [sketch.at(dotted) for _, dotted in pairs], part.mirrored, own, group.pins)
        for pin, place in places.items():
            member = members[f"{name}.{pin}"]
            if isinstance(member, Pin):
                members[f"{name}.{pin}"] = member.renewed(near=place, drawn_at=None)


def laid_on(
    own: list[Place], whole: list[Place], mirrored: bool, places: Mapping[str, Place], pins: Iterable[str]
) -> dict[str, Place]:
    """Return where pins come to lie when their part's points are laid on those of the whole, as near as can be."""

    def complexes(given: Iterable[Place]) -> np.ndarray:
        found = np.array([complex(*place) for place in given])
        return found

    def side(given: np.ndarray) -> np.ndarray:
        return -given.conj() if mirrored else given

    start, goal = side(complexes(own)), complexes(whole)
    turn = np.sum((goal - goal.mean()) * (start - start.mean()).conj())
    turn = turn / abs(turn) if abs(turn) > 0.0 else 1.0
    moved = {pin: goal.mean() + turn * (side(np.array([complex(*places[pin])]))[0] - start.mean()) for pin in pins}
    return {pin: (float(place.real), float(place.imag)) for pin, place in moved.items()}


def all_behind(members: Mapping[str, Member], names: Iterable[str]) -> dict[str, Member]:
    """Return some members with all that they are built from."""
    stack, found = list(names), dict[str, Member]()
    while stack:
        name = stack.pop()
        if name in members and name not in found:
            found[name] = members[name]
            stack += needs(members[name])
            member = members[name]
            stack += member.companions if isinstance(member, Pin) else ()
    return {name: member for name, member in members.items() if name in found}
