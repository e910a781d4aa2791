"""From what a class declares to steps in an order that can be built: sketches settled, parts lists resolved."""

from __future__ import annotations

from collections.abc import Mapping
from copy import copy

from ..quantities import Member, needs
from ..steps import Group, Guide, Link, Pin, Slide, Step
from .decompose import next_group
from .names import check_names
from .parts import Parts, check_held, next_step
from .sketch import Place, Sketch, measured, sided


def assembled(members: Mapping[str, Member], title: str) -> dict[str, Member]:
    """Return the members with every pin placed by a step or a group and every sketch position turned into a side.

    Members that need nothing of this come back as they are. Raises DefinitionError for parts that hold a pin
    too little, AssemblyError for a sketch that cannot be assembled.
    """
    if not any(isinstance(member, Pin) or sketched(member) for member in members.values()):
        return dict(members)
    check_names(members, title)
    return Assembler(members, title).run()


def sketched(member: Member) -> bool:
    """Return whether a member waits for the sketch to settle it."""
    return isinstance(member, Step) and (member.near is not None or member.drawn_at is not None)


class Assembler:
    """Settles one member after another, numerically at the sketch where positions choose."""

    def __init__(self, members: Mapping[str, Member], title: str) -> None:
        self.title = title
        self.settled: dict[str, Member] = {}
        self.pending = {name: member for name, member in members.items() if not isinstance(member, (Pin, Group))}
        self.parts = Parts(
            placed=set(),
            pins={name: member for name, member in members.items() if isinstance(member, Pin)},
            links={name: member for name, member in members.items() if isinstance(member, Link)},
            slides={name: member for name, member in members.items() if isinstance(member, Slide)},
            guides={name: member for name, member in members.items() if isinstance(member, Guide)},
            place=self.place,
        )

    def run(self) -> dict[str, Member]:
        """Return all members, settled."""
        check_held(self.parts, self.title)
        while True:
            self.settle_ready()
            loose = [pin for pin in self.parts.pins if pin not in self.settled]
            if not loose:
                return self.settled | self.pending
            found = next_step(self.parts)
            if found is not None:
                self.settle(*found)
            elif self.waits_for_steps():
                return self.settled | self.pending | self.parts.pins
            else:
                self.add_group(next_group(self.parts, self.title))

    def settle_ready(self) -> None:
        """Settle every member all of whose parts are settled."""
        progress = True
        while progress:
            ready = [name for name, member in self.pending.items() if set(needs(member)) <= set(self.settled)]
            for name in ready:
                self.settle(name, self.pending.pop(name))
            progress = bool(ready)

    def settle(self, name: str, member: Member) -> None:
        """Settle a member: measure what it lacks, choose its side."""
        if isinstance(member, Step):
            named = copy(member)
            object.__setattr__(named, "_name", name)
            member = sided(name, measured(name, named, self.settled, self.title), self.settled, self.title)
        self.settled[name] = member
        self.parts.placed.add(name)

    def waits_for_steps(self) -> bool:
        """Return whether the loose pins hang on a step that can never come: a cycle or an unknown name."""
        points = {point for link in self.parts.links.values() for point in link.point_names}
        return any(name in points and name not in self.parts.pins for name in self.pending)

    def add_group(self, group: Group) -> None:
        """Settle the pins of a group together."""
        name = next(f"group{k}" for k in range(1, len(self.parts.pins) + 2) if f"group{k}" not in self.settled)
        object.__setattr__(group, "_name", name)
        self.settled[name] = group
        for pin in group.pins:
            member = copy(self.parts.pins[pin])
            member.group = group
            self.settled[pin] = member
            self.parts.placed.add(pin)

    def place(self, point: str) -> Place:
        """Return where a settled point is in the sketch [m]."""
        return Sketch(self.settled, self.title).at(point)
