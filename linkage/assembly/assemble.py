"""From what a class declares to steps in an order that can be built: sketches settled, parts lists resolved."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from copy import copy
from dataclasses import dataclass
from itertools import combinations
from typing import Any, final

import numpy as np

from ..errors import DefinitionError, about, unknown
from ..plan import needed_names, with_inner
from ..quantities import Member, Number, Quantity, Reference, Stroke, Variable, name_of, needs, of_kind
from ..steps import Group, Guide, Link, OnLink, Pin, Point, Slide, Step
from ..vectors import Side
from .part_sketch import all_behind, with_begun_pins
from .parts import Parts, Shape, check_held, next_step
from .sketch import Sketch, missing_labels, sided, with_measured_labels

# What a parts list refers to, looked at before its pins are placed: names, kinds, labels.

def check_names(members: Mapping[str, Member], title: str) -> None:
    """Raise DefinitionError for a name that nobody declares, one of another kind, and a label that does not fit its link's points."""
    for name, member in members.items():
        for each in needed_names(name, member, title):
            if each not in members:
                raise unknown("Name", each, members, where=f"{title}.{name}", member=name)
    for name, member in members.items():
        joined: list[tuple[Reference, str]] = [(member.point, "point"), (member.guide, "guide")] if isinstance(member, Slide) else []
        for reference, kind in [(point, "point") for point in member.points] if isinstance(member, Link) else joined:
            if members[name_of(reference)].kind != kind:
                raise DefinitionError(f"{title}: {name} = {member}: {name_of(reference)} is not a {kind}.", member=name)
        if isinstance(member, Link):
            with about(name):
                member.fitted()


# What no dyad pattern places: the smallest sets of pins whose equations determine them together.

@final
@dataclass(frozen=True)
class PinEquation:
    """An equation of the parts list: the loose pins it holds, and what it stands for."""

    pins: tuple[str, ...]
    length: tuple[str, str, Quantity] | None = None
    attached: tuple[str, OnLink] | None = None
    slide: Slide | None = None
    half: int = 0
    fault: str = ""
    """Why it cannot be written down, should its turn come."""
    link: str = ""
    """The link that it comes from, if one."""


def link_equations(parts: Parts, name: str, title: str) -> list[PinEquation]:
    """Return a link's equations: one length, and two for every further point that is rigid with two points before it."""
    link, shape = parts.links[name], parts.shapes[name]
    points = [*parts.firm(link), *parts.loose(link)]
    known = (pair for pair in combinations(points, 2) if shape.distance(*pair) is not None and not shape.coincide(*pair))
    first, second = points[:2] if len(parts.firm(link)) > 1 else next(known, tuple(points[:2]))
    points = [first, second, *(point for point in points if point not in (first, second))]
    length = shape.distance(first, second)
    fault = "" if length is not None else f"the length {first}{second} of {name} = {link} is missing; give it, or draw both pins at=(x, y)."

    def loose(*pins: str) -> tuple[str, ...]:
        return tuple(pin for pin in pins if pin not in parts.placed)

    measured = None if length is None else (first, second, length)
    rows = [PinEquation(loose(first, second), length=measured, fault=fault, link=name)] if loose(first, second) else []
    for pin, step in attachments(points, shape, f"{title}: the shape of {name} = {link}", parts.one_place):
        rough = [name_of(parent) for parent in step.parents if step.drawn_at and shape.drawn(name_of(parent)) is None]
        if rough:
            fault = f"{pin} of {name} = {link} cannot be measured from {' '.join(rough)}; draw them at=(x, y) too, or give the lengths."
        else:
            fault, step = "", as_sketched(parts, pin, step, f"{title}: {name} = {link}", shape)
        held = (*map(name_of, step.parents), pin)
        rows += [PinEquation(loose(*held), attached=(pin, step), half=half, fault=fault, link=name) for half in (0, 1)]
    return rows


def attachments(points: list[str], shape: Shape, what: str, one_place: Callable[[], str]) -> Iterator[tuple[str, OnLink]]:
    """Yield each further point of a link with the step that makes it rigid with two points before it, in an order that works."""
    known, left = points[:2], points[2:]
    while left:
        steps = {pin: shape.attachment(known, pin) for pin in left}
        pin, step = next(((pin, step) for pin, step in steps.items() if isinstance(step, OnLink)), (left[0], None))
        if step is None:
            raise DefinitionError(f"{what} is not settled at {pin}; give two distances or a distance and an angle.{one_place()}")
        yield pin, step
        known.append(pin)
        left.remove(pin)


def as_sketched(parts: Parts, pin: str, step: OnLink, what: str, shape: Shape) -> OnLink:
    """Return a group's rigid point with the side its link's pins have in the sketch, and what is not given measured there."""
    parents = [name_of(parent) for parent in step.parents]
    if step.near is None and step.drawn_at is None:
        return step
    found = copy(step)
    (px, py), (qx, qy), X = (parts.sketched(point) for point in (*parents, pin))
    found.labels = dict(step.labels)
    if step.drawn_at is not None:
        found.labels |= missing_labels(pin, step, parents, np.array(X), parts.sketched)
    if {parents[1] + pin, pin + parents[1]} & set(found.labels):
        cross = (qx - px) * (X[1] - py) - (qy - py) * (X[0] - px)
        if cross == 0.0 and not shape.is_straight(parents[0], parents[1], pin):
            raise DefinitionError(f"{what}: its pins are in one line in the sketch, so that {pin} has no side; move a near=(x, y).")
        found.side = Side.LEFT if cross >= 0.0 else Side.RIGHT
    found.near = found.drawn_at = None
    return found


def next_group(parts: Parts, title: str) -> Group:
    """Return the first set of loose pins that its own equations determine: an Assur group.

    Raises DefinitionError where the equations leave a pin free.
    """
    import networkx as nx

    rows: list[PinEquation] = []
    for name, link in parts.links.items():
        if parts.loose(link):
            with about(name):
                rows += link_equations(parts, name, title)
    for slide in parts.slides.values():
        held = (name_of(slide.point), *parts.guides[name_of(slide.guide)].points)
        loose = tuple(point for point in held if point in parts.pins and point not in parts.placed)
        if loose:
            rows.append(PinEquation(loose, slide=slide))
    matched = matching(rows, parts, title)
    graph = nx.DiGraph()
    graph.add_nodes_from(dict.fromkeys(pin for pin, _ in matched))  # a set would be in another order in every run
    for (pin, _), row in matched.items():
        graph.add_edges_from((other, pin) for other in rows[row].pins if other != pin)
    blocks = nx.condensation(graph)
    for block in nx.lexicographical_topological_sort(blocks):
        pins = blocks.nodes[block]["members"]
        own = sorted(row for (pin, _), row in matched.items() if pin in pins)
        faulty = next((rows[row] for row in own if rows[row].fault), None)
        if faulty is not None:
            raise DefinitionError(f"{title}: {faulty.fault}", member=faulty.link)
        return grouped([pin for pin in parts.pins if pin in pins], [rows[row] for row in own], title)
    raise DefinitionError(f"{title}: no pin is left to place.")


def matching(rows: list[PinEquation], parts: Parts, title: str) -> dict[tuple[str, int], int]:
    """Return which equation determines which coordinate; DefinitionError for a pin that is left free."""
    import networkx as nx

    loose = [pin for pin in parts.pins if pin not in parts.placed]
    graph = nx.Graph()
    coordinates = [(pin, axis) for pin in loose for axis in (0, 1)]
    # whole numbers as nodes: names would be matched in an order that changes from run to run
    first = len(coordinates)
    graph.add_nodes_from(range(first))
    for place, row in enumerate(rows):
        graph.add_edges_from((coordinates.index((pin, axis)), first + place) for pin in row.pins for axis in (0, 1))
    found = nx.bipartite.hopcroft_karp_matching(graph, range(first))
    free = list(dict.fromkeys(pin for place, (pin, _) in enumerate(coordinates) if place not in found))
    if free:
        remedy = parts.one_place() or parts.lengths_given(free) or parts.driveless()
        raise DefinitionError(
            f"{title}: the parts leave {' '.join(free)} free: {len(rows)} conditions for {2 * len(loose)} coordinates of the pins "
            f"{' '.join(loose)}.{remedy or ' Add a link, a slide or a length that follows a stroke.'}",
            member=free[0],
        )
    return {each: found[place] - first for place, each in enumerate(coordinates)}


def grouped(pins: list[str], rows: list[PinEquation], title: str) -> Group:
    """Return the group of some pins with its equations; DefinitionError for one that is held twice in the same way."""
    group = Group(" ".join(pins))
    group.given = tuple(dict.fromkeys(row.length for row in rows if row.length))
    attached: dict[str, tuple[str, OnLink]] = {}
    for row in rows:
        if row.attached:
            attached.setdefault(f"{row.attached[0]} {row.attached[1]}", row.attached)
    group.attached = tuple(attached.values())
    group.slides = tuple(row.slide for row in rows if row.slide)
    held, needed = len(group.given) + 2 * len(group.attached) + len(group.slides), 2 * len(pins)
    if held != needed:
        what = f"the pins {' '.join(pins)} are held by {held} different conditions, {needed} are needed"
        remedy = "take out a link that joins the same pins as another one, and add one that holds them"
        raise DefinitionError(f"{title}: {what}; {remedy}.", member=pins[0])
    return group


def assembled(members: Mapping[str, Member], title: str) -> dict[str, Member]:
    """Return the members with every pin placed by a step or a group and every sketch position turned into a side.

    Members that need nothing of this come back as they are. Raises DefinitionError for parts that hold a pin
    too little, AssemblyError for a sketch that cannot be assembled.
    """
    members = with_begun_pins(members, title)
    if not any(is_loose(member) or sketched(member) for member in members.values()):
        return dict(members)
    among = {name: member.among(members) for name, member in members.items()}
    wanted = {name: needed_names(name, member, title) for name, member in among.items()}
    with_inner(among, wanted, title)
    defaults = {variable: default for member in among.values() for variable, default, *_ in member.variables()}
    inner = {name: drawn_in(member, defaults) for name, member in among.items() if name not in members}
    check_names({**members, **inner}, title)
    held = frozenset(name for name, each in inner.items() if not isinstance(each, Quantity))
    return {name: member for name, member in Assembler({**members, **inner}, title, held).run().items() if name not in inner}


def drawn_in(value: object, defaults: Mapping[str, float]) -> Any:
    """Return a quantity with the numbers of the design that is drawn in the place of design variables."""
    match value:
        case Variable() if value.variable in defaults:
            return Number(defaults[value.variable])
        case Quantity():
            own = {name: each for name, each in vars(value).items() if not getattr(each, "name", "")}  # what belongs to it alone
            return value.renewed(**{name: drawn_in(each, defaults) for name, each in own.items() if isinstance(each, (tuple, Quantity))})
        case tuple():
            return tuple(drawn_in(each, defaults) for each in value)
    return value


def is_loose(member: Member) -> bool:
    """Return whether a member is a pin that nothing places yet; those of a part belong to its groups."""
    return isinstance(member, Pin) and member.group is None


def is_open(member: Member) -> bool:
    """Return whether a member is a group as it is written, without its equations."""
    return isinstance(member, Group) and not (member.given or member.attached or member.slides)


def sketched(member: Member) -> bool:
    """Return whether a member waits for the sketch to settle it."""
    return isinstance(member, Step) and (member.near is not None or member.drawn_at is not None)


@final
class Assembler:
    """Settles one member after another, numerically at the sketch where positions choose."""

    def __init__(self, members: Mapping[str, Member], title: str, held: frozenset[str] = frozenset()) -> None:
        """Take all members; `held` are those that others hold by names of their own: a sketch brings them along with their owners."""
        self.title, self.held = title, held
        self.known: set[str] = set()
        self.settled: dict[str, Member] = {}
        self.drawing = Sketch({}, title)
        self.pending = {name: member for name, member in members.items() if not (is_loose(member) or is_open(member))}
        used = all_behind(members, [name for name, member in members.items() if isinstance(member, (Point, Link, Guide))])
        self.parts = Parts(
            placed=set(),
            pins={name: pin for name, pin in of_kind(members, Pin).items() if is_loose(pin)},
            links={name: link for name, link in of_kind(members, Link).items() if name not in held},
            slides=of_kind(members, Slide),
            guides=of_kind(members, Guide),
            sketch=self.sketch,
            idle=tuple(name for name in of_kind(members, Stroke) if name not in used),
            elements=members,
        )

    def run(self) -> dict[str, Member]:
        """Return all members, settled."""
        check_held(self.parts, self.title)
        points = {point for link in self.parts.links.values() for point in link.point_names}
        while True:
            progress = True
            while progress:
                ready = [name for name, member in self.pending.items() if set(needs(member)) <= self.known and not self.waits(member)]
                for name in ready:
                    self.settle(name, self.pending.pop(name))
                progress = bool(ready)
            loose = [pin for pin in self.parts.pins if pin not in self.settled]
            if not loose:
                return self.settled | self.pending
            found = next_step(self.parts)
            if found is not None:
                self.settle(*found)
            elif any(name in points and name not in self.parts.pins for name in self.pending):
                return self.settled | self.pending | self.parts.pins  # they hang on a step that never comes: a cycle or an unknown name
            else:
                self.add_group(next_group(self.parts, self.title))

    def waits(self, member: Member) -> bool:
        """Return whether a load case that something runs in is not settled yet, for the loads of the case are not."""
        return any(each in self.pending for each in getattr(member, "cases", None) or ())

    def settle(self, name: str, member: Member) -> None:
        """Settle a member: measure what it lacks, choose its side."""
        self.known.add(name)
        if name in self.held:
            return
        if isinstance(member, Step):
            named = copy(member)
            object.__setattr__(named, "_name", name)
            with about(name):
                member = sided(name, with_measured_labels(name, named, self.sketch), self.settled, self.title)
            if name in self.parts.pins:
                member.drawn_at = self.parts.pins[name].drawn_at
        if isinstance(member, Link) and name in self.parts.links:
            member = self.parts.shapes[name].settled_link(member)
        self.settled[name] = member
        self.parts.placed.add(name)

    def add_group(self, group: Group) -> None:
        """Settle the pins of a group together."""
        name = next(f"group{k}" for k in range(1, len(self.parts.pins) + 2) if f"group{k}" not in self.settled)
        object.__setattr__(group, "_name", name)
        self.settled[name] = group
        self.known.add(name)
        for pin in group.pins:
            member = copy(self.parts.pins[pin])
            member.group = group
            self.settled[pin] = member
            self.known.add(pin)
            self.parts.placed.add(pin)

    def sketch(self) -> Sketch:
        """Return the sketch of all that is settled."""
        if len(self.settled) != len(self.drawing.plan.unbound):
            self.drawing = Sketch(self.settled, self.title)
        return self.drawing
