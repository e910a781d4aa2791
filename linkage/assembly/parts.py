"""A parts list turned into steps: pins, links and slides become dyads by pattern, and groups where none fits."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import combinations, permutations, starmap
from typing import Any, final

import numpy as np

from ..errors import DefinitionError
from ..loads import ForceElement
from ..quantities import Member, Number, Quantity, joined_names, name_of, quantity
from ..steps import Dyad, Guide, GuideCross, Link, OnLink, Pin, PinSlotDyad, Slide, SliderDyad, Step, YokeDyad
from .sketch import ONE_PLACE, Sketch

# The shape of a link: the distances and angles of its points, from its labels or a drawing.

@final
class Shape:
    """What is known of a link's shape, from its own labels and those of links of the same body. Lengths in m, angles in rad."""

    def __init__(
        self, link: Link, links: Iterable[Link], pins: Mapping[str, Pin], placed: set[str], sketch: Callable[[], Sketch]
    ) -> None:
        self.points = link.point_names
        self.pins, self.placed, self.sketch = pins, placed, sketch
        bodied = [link, *(each for each in links if len({*each.point_names} & {*self.points}) > 1)]
        self.labels = {name: quantity(value) for each in reversed(bodied) for name, value in each.labels.items()}

    def given(self, *points: str) -> tuple[str, Quantity] | None:
        """Return the label of a distance (two points) or an angle (three points) as it is spelled, if it is given."""
        spelling = next((each for each in (joined_names(*points), joined_names(*reversed(points))) if each in self.labels), "")
        if not spelling:
            return None
        found, drawn = self.labels[spelling], None if self.labels[spelling].is_constant else self.measured(*points)
        return spelling, found if len(points) > 2 or drawn is None else quantity(self.sketch().extended(found, drawn.number))

    def distance(self, P: str, Q: str) -> Quantity | None:
        """Return the distance of two points: given, by the cosine rule from two sides and their angle, or measured [m]."""
        found = self.given(P, Q)
        if found is not None:
            return found[1]
        for R in self.points:
            first, second, angle = self.given(R, P), self.given(R, Q), self.given(P, R, Q)
            if first is not None and second is not None and angle is not None:
                p, q = first[1], second[1]
                derived: Quantity = np.sqrt(p * p + q * q - 2.0 * p * q * np.cos(angle[1]))
                return derived
        return self.measured(P, Q)

    def settled_link(self, link: Link) -> Link:
        """Return the link with its labels as they are given, the drawn lengths of cylinders among them."""
        pairs = combinations(self.points, 2) if any(not each.is_constant for each in self.labels.values()) else ()
        found = {spelling: value for spelling, value in filter(None, starmap(self.given, pairs)) if spelling in link.labels}
        changed = {spelling: value for spelling, value in found.items() if value is not self.labels[spelling]}
        return link.renewed(labels={**link.labels, **changed}) if changed else link

    def is_straight(self, P: str, Q: str, R: str) -> bool:
        """Return whether three distances put three points in one line: such a link has no sides."""
        sides = [self.distance(*pair) for pair in ((P, Q), (P, R), (Q, R))]
        if not all(isinstance(side, Number) for side in sides):
            return False
        longest = max(lengths := [side.number for side in sides if isinstance(side, Number)])
        return abs(2.0 * longest - sum(lengths)) <= 1e-9 * longest

    def coincide(self, P: str, Q: str) -> bool:
        """Return whether two points of the body stand at one place, measured by its longest distance and by where they are."""
        known = [found.number for found in starmap(self.distance, combinations(self.points, 2)) if isinstance(found, Number)]
        if self.measured(P, Q) is not None:
            known += [abs(each) for point in (P, Q) for each in self.drawn(point) or ()]
        between = self.distance(P, Q)
        return isinstance(between, Number) and between.number <= ONE_PLACE * max(known)

    def measured(self, P: str, Q: str, *_: str) -> Number | None:
        """Return the distance of two points in the drawing [m]; None unless one of them is drawn."""
        if not any(point in self.pins and self.pins[point].drawn_at for point in (P, Q)):
            return None
        first, second = self.drawn(P), self.drawn(Q)
        return None if first is None or second is None else Number(float(np.hypot(first[0] - second[0], first[1] - second[1])))

    def drawn(self, point: str) -> tuple[float, float] | None:
        """Return a point's place in the drawing, or where it is placed [m]; None for what is neither drawn nor placed."""
        if point in self.pins and (self.pins[point].drawn_at or point not in self.placed):
            return self.pins[point].drawn_at
        return self.sketch().at(point) if point in self.placed else None

    def attachment(self, firm: Sequence[str], pin: str) -> Step | None:
        """Return the step that places a point of this body from two placed ones, if the labels allow it."""
        near = self.pins[pin].near
        pairs = [(P, Q) for P, Q in permutations(firm, 2) if not self.coincide(P, Q)]
        for P, Q in pairs:
            length = self.given(P, pin)
            angle = self.given(Q, P, pin)
            if length is None:
                continue
            if angle is not None:
                return OnLink(P, Q, **labelled(length, angle))
            other = self.given(Q, pin)
            if other is not None:
                return OnLink(P, Q, near=self.pins[pin].sketched, **labelled(length, other))
        if near is None and pairs:
            apart = [(P, Q) for P, Q in pairs if not self.coincide(P, pin)] or pairs
            said = [(P, Q) for P, Q in apart if self.given(P, pin)] or [(P, Q) for P, Q in apart if self.given(Q, P, pin)]
            P, Q = (said or apart)[0]
            own = filter(None, (self.given(P, pin), self.given(Q, P, pin)))
            return OnLink(P, Q, at=self.pins[pin].drawn_at, **labelled(*own))
        for P, Q in pairs:
            p, q = self.distance(P, pin), self.distance(Q, pin)
            if p is not None and q is not None:
                return OnLink(P, Q, near=near, **labelled((P + pin, p), (Q + pin, q)))
        return None

def labelled(*labels: tuple[str, Quantity]) -> dict[str, Any]:
    """Return labels as a step's keywords."""
    return dict(labels)


@final
@dataclass
class Parts:
    """What is placed so far, and the pins, links and slides that are still to be used."""

    placed: set[str]
    pins: dict[str, Pin]
    links: dict[str, Link]
    slides: dict[str, Slide]
    guides: dict[str, Guide]
    sketch: Callable[[], Sketch]
    idle: tuple[str, ...] = ()
    """The strokes that nothing follows."""
    elements: Mapping[str, Member] = field(default_factory=dict)
    """All members, among which elements such as ropes give lengths."""
    shapes: dict[str, Shape] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.shapes = {name: Shape(link, self.links.values(), self.pins, self.placed, self.sketch) for name, link in self.links.items()}

    def loose(self, link: Link) -> list[str]:
        """Return a link's points that are not placed."""
        return [point for point in link.point_names if point not in self.placed]

    def firm(self, link: Link) -> list[str]:
        """Return a link's points that are placed."""
        return [point for point in link.point_names if point in self.placed]

    def sketched(self, point: str) -> tuple[float, float]:
        """Return where a point is in the sketch [m]: where it is placed, or a loose pin's own position."""
        return self.sketch().at(point) if point in self.placed else self.pins[point].sketched

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
        giving = [each for each in self.elements.values() if isinstance(each, ForceElement)]
        found = next(filter(None, (each.link_written(pin, self.elements) for each in giving for pin in pins)), "")
        return f" Let a link follow the length that is given to it: {found}." if found else ""

    def guides_of(self, pin: str) -> list[str]:
        """Return the placed guides a pin slides on."""
        found = [name_of(slide.guide) for slide in self.slides.values() if name_of(slide.point) == pin]
        return [guide for guide in found if set(self.guides[guide].points) <= self.placed]

    def arms(self, pin: str) -> Iterator[tuple[str, Quantity]]:
        """Yield the points and the lengths of the links by which a pin hangs on one placed point."""
        for name, link in self.links.items():
            firm = self.firm(link)
            if pin in link.point_names and len(firm) == 1:
                length = self.shapes[name].distance(firm[0], pin)
                if length is not None and not self.shapes[name].coincide(firm[0], pin):
                    yield firm[0], length


def next_step(parts: Parts) -> tuple[str, Step] | None:
    """Return a pin that can be placed now and the step that places it; None where no pattern fits."""
    for pin in parts.pins:
        if pin not in parts.placed and (step := next(placements(parts, pin), None)) is not None:
            return pin, step
    return None


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
            if set(guide.points) == {P, pin} and held in parts.placed:
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
            if pin in slot.points and set(slot.points) <= set(link.point_names) and held in parts.placed and partners:
                angle = parts.shapes[name].given(partners[0], pin, ends[0])
                if angle is not None:
                    yield YokeDyad(held, guide, angle=angle[1] if angle[0].startswith(partners[0]) else -angle[1])


def check_held(parts: Parts, title: str) -> None:
    """Raise DefinitionError for a pin that too little holds: fewer than two links or guides."""
    for pin in parts.pins:
        holds = [name for name, link in parts.links.items() if pin in link.point_names]
        holds += [name for name, slide in parts.slides.items() if name_of(slide.point) == pin]
        if not holds:
            raise DefinitionError(f"{title}: nothing holds the pin {pin}; say Link(...) or Slide(...) with it.", member=pin)
