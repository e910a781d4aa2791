"""Assembly: from a class's declarations to steps in an order that can be built; sketches settled, parts lists resolved."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from copy import copy
from itertools import combinations, permutations, starmap
from math import atan2, hypot
from typing import Any, NamedTuple

import numpy as np

from ..errors import DefinitionError, about, unknown
from ..loads import ForceElement
from ..plan import needed_names, with_inner
from ..quantities import Member, Number, Quantity, Reference, Stroke, Variable, joined_names, name_of, needs, of_kind, quantity
from ..steps import Crank, Dyad, Ground, Group, Guide, GuideCross, Link, OnLink, Pin, PinSlotDyad, Point, Slide, SliderDyad, Step, YokeDyad
from ..vectors import Side
from .sketch import ONE_PLACE, Sketch, all_behind, missing_labels, sided, with_begun_pins, with_measured_labels

# The shape of a link: the distances and angles of its points, from its labels or a drawing.


class Shape:
    """A link's shape as known from its own labels and those of links of the same body. Lengths in m, angles in rad."""

    def __init__(self, link: Link, parts: Parts) -> None:
        self.points, self.parts, self.pins = link.point_names, parts, parts.pins
        bodied = [link, *(each for each in parts.links.values() if len({*each.point_names} & {*self.points}) > 1)]
        self.labels = {name: quantity(value) for each in reversed(bodied) for name, value in each.labels.items()}
        self._longest = -1, 0.0
        """With so many pins placed the longest distance of its points [m]."""

    def labelled_side(self, *points: str) -> tuple[str, Quantity] | None:
        """Return the label of a distance (two points) or an angle (three points) as it is spelled, if it is given."""
        spelling = next((each for each in (joined_names(*points), joined_names(*reversed(points))) if each in self.labels), "")
        if not spelling:
            return None
        found, drawn = self.labels[spelling], None if self.labels[spelling].is_constant else self.measured(*points)
        return spelling, found if len(points) > 2 or drawn is None else quantity(self.parts.sketch().extended(found, drawn.number))

    def distance(self, P: str, Q: str) -> Quantity | None:
        """Return the distance of two points: given, by the cosine rule from two sides and their angle, or measured [m]."""
        found = self.labelled_side(P, Q)
        if found is not None:
            return found[1]
        for R in self.points:
            first, second, angle = self.labelled_side(R, P), self.labelled_side(R, Q), self.labelled_side(P, R, Q)
            if first is not None and second is not None and angle is not None:
                p, q = first[1], second[1]
                derived: Quantity = np.sqrt(p * p + q * q - 2.0 * p * q * np.cos(angle[1]))
                return derived
        return self.measured(P, Q)

    def coincide(self, P: str, Q: str) -> bool:
        """Return whether two points of the body stand at one place, measured by its longest distance and by where they are."""
        between = self.distance(P, Q)
        if not isinstance(between, Number):
            return False
        drawn = (P, Q) if self.measured(P, Q) is not None else ()
        size = max([self.longest(), *(abs(each) for point in drawn for each in self.drawn(point) or ())])
        return between.number <= ONE_PLACE * size

    def longest(self) -> float:
        """Return the longest known distance of two points of the body [m], looked for again when more pins are placed."""
        placed = len(self.parts.settled)
        if self._longest[0] != placed:
            pairs = combinations(self.points, 2)
            known = (found.number for found in starmap(self.distance, pairs) if isinstance(found, Number))
            self._longest = placed, max(known, default=0.0)
        return self._longest[1]

    def measured(self, P: str, Q: str, *_: str) -> Number | None:
        """Return the distance of two points in the drawing [m]; None unless one of them is drawn."""
        if not any(point in self.pins and self.pins[point].drawn_at for point in (P, Q)):
            return None
        first, second = self.drawn(P), self.drawn(Q)
        return None if first is None or second is None else Number(float(np.hypot(first[0] - second[0], first[1] - second[1])))

    def drawn(self, point: str) -> tuple[float, float] | None:
        """Return a point's place in the drawing, else its settled place [m]; None for a point that has neither."""
        is_placed = point in self.parts.settled
        if point in self.pins and (self.pins[point].drawn_at or not is_placed):
            return self.pins[point].drawn_at
        return self.parts.sketch().at(point) if is_placed else None

    def attachment(self, firm: Sequence[str], pin: str) -> Step | None:
        """Return the step that places a point of this body from two placed ones, if the labels allow it."""
        near = self.pins[pin].near
        pairs = [(P, Q) for P, Q in permutations(firm, 2) if not self.coincide(P, Q)]
        for P, Q in pairs:
            length = self.labelled_side(P, pin)
            angle = self.labelled_side(Q, P, pin)
            if length is None:
                continue
            if angle is not None:
                return OnLink(P, Q, **labelled(length, angle))
            other = self.labelled_side(Q, pin)
            if other is not None:
                return OnLink(P, Q, near=self.pins[pin].sketched, **labelled(length, other))
        if near is None and pairs:
            apart = [(P, Q) for P, Q in pairs if not self.coincide(P, pin)] or pairs
            said = [(P, Q) for P, Q in apart if self.labelled_side(P, pin)] or [(P, Q) for P, Q in apart if self.labelled_side(Q, P, pin)]
            P, Q = (said or apart)[0]
            own = filter(None, (self.labelled_side(P, pin), self.labelled_side(Q, P, pin)))
            return OnLink(P, Q, at=self.pins[pin].drawn_at, **labelled(*own))
        for P, Q in pairs:
            p, q = self.distance(P, pin), self.distance(Q, pin)
            if p is not None and q is not None:
                return OnLink(P, Q, near=near, **labelled((P + pin, p), (Q + pin, q)))
        return None


def labelled(*labels: tuple[str, Quantity]) -> dict[str, Any]:
    """Return labels as a step's keywords."""
    return dict(labels)


def placements(parts: Parts, pin: str) -> Iterator[Step]:
    """Yield the steps that can place a pin now: on a body two of whose points are placed, then the dyads by their patterns."""
    near = parts.pins[pin].sketched
    for name, link in parts.links.items():
        firm = parts.firm(link)
        if pin in link.point_names and len(firm) >= 2 and (step := parts.shapes[name].attachment(firm, pin)) is not None:
            yield step
    arms = list(parts.arms(pin))
    for (P, p), (Q, q) in combinations(arms, 2):  # RRR
        if P != Q:
            yield Dyad(P, Q, near=near, **labelled((P + pin, p), (Q + pin, q)))
    guides = parts.guides_of(pin)
    for P, length in arms if guides else ():  # RRP
        yield SliderDyad(P, guides[0], near=near, **labelled((P + pin, length)))
    if len(guides) > 1:  # PRP
        yield GuideCross(guides[0], guides[1])
    for P, length in arms:  # RPR: the slot goes through P and this pin
        for slide in parts.slides.values():
            guide, held = parts.guides[name_of(slide.guide)], name_of(slide.point)
            if set(guide.points) == {P, pin} and held in parts.settled:
                yield PinSlotDyad(P, held, near=near, **labelled((P + pin, length)))
    for guide_name in guides:  # RPP
        yield from yoke_dyads(parts, pin, guide_name)


def yoke_dyads(parts: Parts, pin: str, guide: str) -> Iterator[YokeDyad]:
    """Yield the RPP dyads of a body that slides on a placed guide with two points while its slot holds a placed pin."""
    for name, link in parts.links.items():
        partners = [each for each in parts.loose(link) if each != pin and guide in parts.guides_of(each)]
        for slide in parts.slides.values():
            slot, held = parts.guides[name_of(slide.guide)], name_of(slide.point)
            ends = [each for each in slot.points if each != pin]
            if pin in slot.points and set(slot.points) <= set(link.point_names) and held in parts.settled and partners:
                angle = parts.shapes[name].labelled_side(partners[0], pin, ends[0])
                if angle is not None:
                    yield YokeDyad(held, guide, angle=angle[1] if angle[0].startswith(partners[0]) else -angle[1])


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


class PinEquation(NamedTuple):
    """An equation of the parts list: its loose pins, and its words."""

    pins: tuple[str, ...]
    length: tuple[str, str, Quantity] | None = None
    attached: tuple[str, OnLink] | None = None
    slide: Slide | None = None
    half: int = 0
    fault: str = ""
    """Why it cannot be written down, should its turn come."""
    link: str = ""
    """The link that it comes from, if one."""


def link_equations(parts: Parts, name: str, rigid: set[str]) -> list[PinEquation]:
    """Return a link's equations: one length, and two for every further point that is rigid with two points before it.

    Those of its points that are `rigid` by links before it are so without.
    """
    link, shape = parts.links[name], parts.shapes[name]
    firm = parts.firm(link)
    points = sorted([*firm, *parts.loose(link)], key=(firm if len(firm) > 1 else [*rigid]).__contains__, reverse=True)
    known = (pair for pair in combinations(points, 2) if shape.distance(*pair) is not None and not shape.coincide(*pair))
    first, second = points[:2] if len(firm) > 1 or rigid else next(known, tuple(points[:2]))
    points = [first, second, *(point for point in points if point not in (first, second))]
    length = shape.distance(first, second)
    fault = "" if length is not None else f"the length {first}{second} of {name} = {link} is missing; give it, or draw both pins at=(x, y)."

    def loose(*pins: str) -> tuple[str, ...]:
        return tuple(pin for pin in pins if pin not in parts.settled)

    measured = None if length is None else (first, second, length)
    rows = [PinEquation(loose(first, second), length=measured, fault=fault, link=name)] if loose(first, second) and not rigid else []
    for pin, step in attachments(points, shape, f"{parts.title}: the shape of {name} = {link}", parts.one_place):
        rough = [name_of(parent) for parent in step.parents if step.drawn_at and shape.drawn(name_of(parent)) is None]
        if rough:
            fault = f"{pin} of {name} = {link} cannot be measured from {' '.join(rough)}; draw them at=(x, y) too, or give the lengths."
        else:
            fault, step = "", as_sketched(parts, pin, step, f"{parts.title}: {name} = {link}", shape)
        held = (*map(name_of, step.parents), pin)
        halves = () if pin in rigid else (0, 1)
        rows += [PinEquation(loose(*held), attached=(pin, step), half=half, fault=fault, link=name) for half in halves]
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
    """Return a group's rigid point with its link's side in the sketch, and unknown labels measured there."""
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
        sides = [shape.distance(*pair) for pair in combinations((*parents, pin), 2)] if cross == 0.0 else []
        lengths = [side.number for side in sides if isinstance(side, Number)]  # a link that three distances put in one line has no sides
        if cross == 0.0 and (len(lengths) < 3 or abs(2.0 * max(lengths) - sum(lengths)) > 1e-9 * max(lengths)):
            raise DefinitionError(f"{what}: its pins are in one line in the sketch, so that {pin} has no side; move a near=(x, y).")
        found.side = Side.LEFT if cross >= 0.0 else Side.RIGHT
    found.near = found.drawn_at = None
    return found


def next_group(parts: Parts) -> Group:
    """Return the first set of loose pins that its own equations determine: an Assur group.

    Raises DefinitionError where the equations leave a pin free.
    """
    import networkx as nx

    rows: list[PinEquation] = []
    bodies: list[set[str]] = []
    for name, link in parts.links.items():
        points = {*link.point_names}
        body = next((each for each in bodies if len(each & points) > 1), None)  # links that share two points are one body
        if body is None:
            bodies.append(body := set[str]())
        if parts.loose(link):
            with about(name):
                rows += link_equations(parts, name, body & points)
        body |= points
    for slide in parts.slides.values():
        guide = parts.guides[name_of(slide.guide)]
        held = (name_of(slide.point), *guide.points)
        loose = tuple(point for point in held if point in parts.pins and point not in parts.settled)
        if loose:
            rows.append(PinEquation(loose, slide=slide.renewed(guide=guide)))  # it may be named by a text, as a file has it
    matched = matching(rows, parts)
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
            raise DefinitionError(f"{parts.title}: {faulty.fault}", member=faulty.link)
        return grouped([pin for pin in parts.pins if pin in pins], [rows[row] for row in own], parts.title)
    raise DefinitionError(f"{parts.title}: no pin is left to place.")


def matching(rows: list[PinEquation], parts: Parts) -> dict[tuple[str, int], int]:
    """Return which equation determines which coordinate; DefinitionError for a pin that is left free."""
    import networkx as nx

    loose = [pin for pin in parts.pins if pin not in parts.settled]
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
            f"{parts.title}: the parts leave {' '.join(free)} free: {len(rows)} conditions for {2 * len(loose)} coordinates of the pins "
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
    among, _ = with_inner(members, title)
    defaults = {variable: default for member in among.values() for variable, default, *_ in member.variables()}
    inner = {name: drawn_in(member, defaults) for name, member in among.items() if name not in members}
    check_names({**members, **inner}, title)
    held = frozenset(name for name, each in inner.items() if not isinstance(each, Quantity))
    return {name: member for name, member in Parts({**members, **inner}, title, held).settle_all().items() if name not in inner}


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


def sketched(member: Member) -> bool:
    """Return whether a member waits for the sketch to settle it."""
    return isinstance(member, Step) and (member.near is not None or member.drawn_at is not None)


class Parts:
    """The parts settled so far, and the pins, links and slides still to be used; settled at the sketch where positions choose."""

    def __init__(self, members: Mapping[str, Member], title: str, held: frozenset[str] = frozenset()) -> None:
        """Take all members; `held` are those that others hold by names of their own: a sketch brings them along with their owners."""
        self.members, self.title, self.held = members, title, held
        self.known: set[str] = set()
        self.settled: dict[str, Member] = {}
        self.drawing = Sketch({}, title)
        groups = of_kind(members, Group).items()
        written = {name for name, group in groups if not (group.given or group.attached or group.slides)}  # without equations yet
        self.pending = {name: member for name, member in members.items() if not (is_loose(member) or name in written)}
        used = all_behind(members, [name for name, member in members.items() if isinstance(member, (Point, Link, Guide))])
        self.idle = [name for name in of_kind(members, Stroke) if name not in used]
        self.pins = {name: pin for name, pin in of_kind(members, Pin).items() if is_loose(pin)}
        self.links = {name: link for name, link in of_kind(members, Link).items() if name not in held}
        self.slides, self.guides = of_kind(members, Slide), of_kind(members, Guide)
        self.shapes = {name: Shape(link, self) for name, link in self.links.items()}

    # -- what is still to be used ------------------------------------------------------------------------------

    def loose(self, link: Link) -> list[str]:
        """Return a link's points that are not placed."""
        return [point for point in link.point_names if point not in self.settled]

    def firm(self, link: Link) -> list[str]:
        """Return a link's points that are placed."""
        return [point for point in link.point_names if point in self.settled]

    def sketched(self, point: str) -> tuple[float, float]:
        """Return where a point is in the sketch [m]: where it is placed, or a loose pin's own position."""
        return self.sketch().at(point) if point in self.settled else self.pins[point].sketched

    def one_place(self) -> str:
        """Return which two points of a link that is not placed stand at one place, in words; "" where none do."""
        for name, link in self.links.items():
            for pair in combinations(link.point_names, 2) if self.loose(link) else ():
                if self.shapes[name].coincide(*pair):
                    return f" {' and '.join(pair)} of {name} = {link} stand at one place: use one pin for both."
        return ""

    def driveless(self) -> str:
        """Return which stroke moves nothing, and how a link follows it, in words; "" where each moves something."""
        if not self.idle:
            return ""
        stroke = self.idle[0]
        text = f" The stroke {stroke} moves nothing."
        for link in self.links.values():
            if len(self.firm(link)) == len(self.loose(link)) == 1:
                P, X = *self.firm(link), *self.loose(link)
                crank, ram = f"{X} = Crank({P}, at=(x, y), angle={stroke})", f'Link("{P} {X}", {P}{X}={stroke})'
                return f"{text} For a crank write {crank}, for a cylinder {ram}."
        return f"{text} Let a length or an angle follow it."

    def lengths_given(self, pins: Iterable[str]) -> str:
        """Return by which link one of some pins follows a rope or a closed line, in words; "" where none of these has it."""
        giving = of_kind(self.members, ForceElement).values()
        found = next(filter(None, (each.link_written(pin, self.members) for each in giving for pin in pins)), "")
        return f" Let a link follow the length that is given to it: {found}." if found else ""

    def guides_of(self, pin: str) -> list[str]:
        """Return the placed guides a pin slides on."""
        found = [name_of(slide.guide) for slide in self.slides.values() if name_of(slide.point) == pin]
        return [guide for guide in found if set(self.guides[guide].points) <= self.settled.keys()]

    def arms(self, pin: str) -> Iterator[tuple[str, Quantity]]:
        """Yield the points and the lengths of the links by which a pin hangs on one placed point."""
        for name, link in self.links.items():
            firm = self.firm(link)
            if pin in link.point_names and len(firm) == 1:
                length = self.shapes[name].distance(firm[0], pin)
                if length is not None and not self.shapes[name].coincide(firm[0], pin):
                    yield firm[0], length

    # -- one after another -------------------------------------------------------------------------------------

    def settle_all(self) -> dict[str, Member]:
        """Return all members, settled; DefinitionError for a pin that nothing holds."""
        points = {point for link in self.links.values() for point in link.point_names}
        for pin in self.pins:
            if pin not in points and pin not in [name_of(slide.point) for slide in self.slides.values()]:
                raise DefinitionError(f"{self.title}: nothing holds the pin {pin}; say Link(...) or Slide(...) with it.", member=pin)
        slid_on = {name_of(slide.guide) for slide in self.slides.values()}
        while True:
            while ready := [name for name, member in self.pending.items() if set(needs(member)) <= self.known and not self.waits(member)]:
                for name in sorted(ready, key=lambda each: each not in slid_on):  # a group that slides on it measures it
                    self.settle(name, self.pending.pop(name))
            loose = [pin for pin in self.pins if pin not in self.settled]
            if not loose:
                return self.settled | self.pending
            found = next(((pin, step) for pin in loose for step in placements(self, pin)), None)
            if found is not None:
                self.settle(*found)
            elif any(name in points and name not in self.pins for name in self.pending):
                return self.settled | self.pending | self.pins  # they hang on a step that never comes: a cycle or an unknown name
            else:  # the pins of a group are settled together
                group = next_group(self)
                name = next(f"group{k}" for k in range(1, len(self.pins) + 2) if f"group{k}" not in self.settled)
                object.__setattr__(group, "_name", name)
                self.settled[name] = group
                for pin in group.pins:
                    self.settled[pin] = self.pins[pin].renewed(group=group)
                self.known |= {name, *group.pins}

    def waits(self, member: Member) -> bool:
        """Return whether a load case that something runs in is not settled yet, for the loads of the case are not."""
        return any(each in self.pending for each in getattr(member, "cases", None) or ())

    def settle(self, name: str, member: Member) -> None:
        """Settle a member: measure its missing dimensions, choose its side."""
        self.known.add(name)
        if name in self.held:
            return
        if isinstance(member, Step):
            with about(name):
                member = sided(name, with_measured_labels(name, member.renewed(_name=name), self.sketch), self.settled, self.title)
            if name in self.pins:
                member.drawn_at = self.pins[name].drawn_at
        if isinstance(member, Link) and name in self.links:  # its labels as they are given, the drawn lengths of cylinders among them
            shape, labels = self.shapes[name], member.labels
            pairs = combinations(shape.points, 2) if any(not each.is_constant for each in shape.labels.values()) else ()
            found = {spelling: value for spelling, value in filter(None, starmap(shape.labelled_side, pairs)) if spelling in labels}
            changed = {spelling: value for spelling, value in found.items() if value is not shape.labels[spelling]}
            member = member.renewed(labels={**labels, **changed}) if changed else member
        self.settled[name] = member

    def sketch(self) -> Sketch:
        """Return the sketch of all that is settled."""
        if len(self.settled) != len(self.drawing.plan.unbound):
            self.drawing = Sketch(self.settled, self.title)
        return self.drawing


Place = tuple[float, float]


def chain_parts(
    stroke: tuple[str, Stroke],
    fixed: Mapping[str, Place],
    crank: Mapping[str, Place],
    links: Mapping[str, Sequence[str]],
    free: Mapping[str, Place],
    point: tuple[str, tuple[str, str], float, float],
) -> dict[str, Member]:
    """Return the members of a chain: a `crank` about the first `fixed` joint, `links` by their joints, and a `point` on one of them.

    Places [m] are those of a drawing at the stroke's start, where the crank lies along the x axis. Of the point its name, the two joints
    that it is rigid with, its distance from the first [m] and the angle there [rad].
    """
    phi, (O, *_), (first, *others) = stroke[1], fixed, crank
    found: dict[str, Member] = {stroke[0]: phi, **{name: Ground(*place) for name, place in fixed.items()}}
    lengths = {name: hypot(place[0] - fixed[O][0], place[1] - fixed[O][1]) for name, place in crank.items()}
    arm: dict[str, Any] = {f"{O}{first}": lengths[first]}
    found[first] = Crank(O, angle=phi, **arm)
    for name in others:
        angle = atan2(crank[name][1] - fixed[O][1], crank[name][0] - fixed[O][0])
        labels: dict[str, Any] = {f"{O}{name}": lengths[name], f"{first}{O}{name}": angle}
        found[name] = OnLink(O, first, **labels)
    found |= {name: Link(" ".join(joints)) for name, joints in links.items()}
    found |= {name: Pin(at=place) for name, place in free.items()}
    name, (P, Q), far, angle = point
    labels = {f"{P}{name}": far, f"{Q}{P}{name}": angle}
    found[name] = OnLink(P, Q, **labels)
    return found
