"""The members of a mechanism, bound and in order, and which bodies move together: the same for every design."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from graphlib import CycleError, TopologicalSorter
from math import pi
from types import MappingProxyType
from typing import Any, TypeVar

from ..errors import DefinitionError, about, unknown
from ..frozen import FrozenDict, record
from ..language import translated
from ..loads.element import ForceElement
from ..quantities import Dimension, Distance, Joint, Jointed, JointSide, Length, Stroke, Variable, body_name, joined_names
from ..quantities.member import Member, is_member_or_name, kinds_said, name_of, needed_behind, needs, of_kind, unnamed
from ..quantities.quantity import Function, Negative, Number, Operation, Quantity, Sum, in_degrees, quantity, signed_terms, stands_for
from ..steps import Arrow, Bar, Drawn, Group, Guide, Link, Point, strokes_drawn, with_bodies
from ..units import Amount, display_unit, require_measure, show
from .table import Table

FRAME = "frame"


@record
class Body:
    """Points that move as one. The frame holds all fixed points."""

    points: tuple[str, ...]
    fixed: bool = False

    @cached_property
    def name(self) -> str:
        """The points' names joined, or `frame`."""
        return FRAME if self.fixed else body_name(self.points)

    def __contains__(self, point: object) -> bool:
        return point in self.points

    def __str__(self) -> str:
        return f"frame {' '.join(self.points)}" if self.fixed else " ".join(self.points)


def merged(groups: Iterable[Sequence[str]], ground: Sequence[str]) -> tuple[Body, ...]:
    """Return the bodies: groups that share two points are one. The frame comes first."""
    bodies: list[list[str]] = [list(ground)]
    for group in groups:
        body = list(dict.fromkeys(group))
        while (other := next((each for each in bodies if len(set(each) & set(body)) > 1), None)) is not None:
            bodies.remove(other)
            body = list(dict.fromkeys([*other, *body]))
        bodies.append(body)
    frame = max(bodies, key=lambda body: len(set(body) & set(ground)) if ground else 0) if ground else []
    others = [body for body in bodies if body is not frame and body]
    return (Body(tuple(frame), fixed=True), *(Body(tuple(body)) for body in others))


Kind = TypeVar("Kind", bound=Member)


class Named(FrozenDict[str, Any]):
    """Members by name, those of parts by each of their names: a point that is fused with another one is that one."""

    def __init__(self, members: Mapping[str, object], aliases: Mapping[str, str]) -> None:
        super().__init__(members)
        self.aliases: Mapping[str, str] = FrozenDict({alias: name for alias, name in aliases.items() if name in members})

    def __reduce__(self) -> tuple[type, tuple[Any, ...]]:
        return type(self), (dict(self), dict(self.aliases))

    def __missing__(self, name: str) -> Member:
        if name not in self.aliases:
            raise KeyError(name)
        found: Member = self[self.aliases[name]]
        return found

    def __contains__(self, name: object) -> bool:
        return super().__contains__(name) or name in self.aliases

    def get(self, name: str, default: object = None) -> Any:
        known = self.aliases.get(name, name)
        return super().get(known, default)


def aliases_among(members: Mapping[str, Member]) -> dict[str, str]:
    """Return the names that members of parts have beside their own, each with the name it stands for in the end."""
    aliases: dict[str, str] = {}
    for part in members.values():
        aliases |= getattr(part, "aliases", {}) if part.kind == "part" else {}
    while any(name in aliases for name in aliases.values()):
        aliases = {alias: aliases.get(name, name) for alias, name in aliases.items()}
    return aliases


def named_by(members: Mapping[str, Kind], aliases: Mapping[str, str]) -> Mapping[str, Kind]:
    """Return members by each of their names, as a plain table where each has one."""
    return Named(members, aliases) if aliases else FrozenDict(members)


TURNS = 8
"""A crank's stroke of more turns was given in degrees."""


class Members:
    """The members of a mechanism in an order in which each can be worked out.

    Raises DefinitionError for unknown names, cycles, and dimensions that are missing, double or impossible.
    """

    def __init__(self, members: Mapping[str, Member], title: str) -> None:
        self.title = title
        self.unbound: Mapping[str, Member] = FrozenDict(members)
        self._behind: dict[str, frozenset[str]] = {}
        members, wanted = with_inner(members, title)
        for name, needed in wanted.items():
            owner = members.get(name.rpartition(".")[0])
            needed += [owner.name] if owner is not None and owner.kind == "part" else []  # its part first, as it is pasted
        order = construction_order(wanted, title, members)
        self.table = Table(title)
        bound: dict[str, Member] = {}
        for name in order:
            member = members[name]
            with about(name):
                for variable, default, measured, unit in member.variables():
                    self.table.add_variable(variable, default, measured, f"{name} = {member}", unit)
                member.enter(self.table)
                bound[name] = member.bind(name, self.table)
        aliases = aliases_among(bound)
        self.members = named_by(bound, aliases)
        strokes = self.of_kind(Stroke)
        self.strokes: Mapping[str, Stroke] = FrozenDict({name: strokes[name] for name in members if name in strokes})
        for name, member in self.members.items():
            with about(name):
                self._check_kinds(name, member)
        for ends, length in self.table.lengths.items():
            self._check_terms(length, "length", f"{title}: {'-'.join(sorted(ends))} = {length}")
        self.members = named_by(with_bodies(self.members, self.table.lengths), aliases)

    @property
    def aliases(self) -> Mapping[str, str]:
        """The names that members of parts have beside their own, such as that of a fixed point that is fused with a point of the whole."""
        return self.members.aliases if isinstance(self.members, Named) else {}

    def of_kind(self, kind: type[Kind]) -> dict[str, Kind]:
        """Return the members of a kind by name, in order."""
        return of_kind(self.members, kind)

    @cached_property
    def points(self) -> Mapping[str, Point]:
        """The points by name, in order."""
        return named_by(self.of_kind(Point), self.aliases)

    @cached_property
    def ground(self) -> tuple[str, ...]:
        """The names of the fixed points."""
        return tuple(name for name, point in self.points.items() if point.is_fixed)

    def _check_kinds(self, name: str, member: Member) -> None:
        """Raise DefinitionError where a point, a vector, a quantity or an amount is given for another kind, as in `20 * mm + phi`."""
        if isinstance(member, Stroke) and any(isinstance(end, Amount) for end in (member.start, member.end)):
            require_measure((member.start, member.end), self.known_stroke_kind(name), f"{self.title}: {name}")
        for each, value in member.strokes.items() if isinstance(member, Drawn) else ():
            if each in self.strokes and isinstance(value, Amount):
                require_measure(value, self.known_stroke_kind(each), f"{self.title}: {name} = drawn(...): {each}")
        for length in (*(each for _, each in member.coordinates()), *(getattr(member, each) for each in member.metres)):
            self._check_terms(length, "length", f"{self.title}: {name} = {member}")
        parts = self.with_parts(name)
        for angle in (each for part in parts for each in part.in_radians()):
            self._check_terms(angle, "angle", f"{self.title}: {name} = {member}")
        member.examine(self.members, self.title)
        for part in parts:
            for length in part.lengths():
                if isinstance(length, Number) and not length.number > 0.0:
                    raise DefinitionError(f"{self.title}: {name} = {member}: the length {length.number:.6g} m is not positive.")
            for attribute, kind in part.expects:
                reference = getattr(part, attribute)
                found = self.members[reference] if isinstance(reference, str) else reference
                if reference is not None and found.kind != kind:
                    raise DefinitionError(f"{self.title}: {name} = {member}: {found.name or found} is not a {kind}.")
        if isinstance(member, Stroke) and name in self.turning and abs(member.end - member.start) > TURNS * 2.0 * pi:
            text = f"{self.title}: {name} = {member} is an angle in radians, {abs(member.end - member.start) / (2.0 * pi):.3g} turns"
            raise DefinitionError(f"{text}; write Stroke({member.start:.6g} * deg, {member.end:.6g} * deg).")
        if member.is_fixed and self.moves(member):
            remedy = "drive a point by OnGuide, Dyad or Crank"
            raise DefinitionError(f"{self.title}: {name} = {member} follows a stroke, but is fixed; {remedy}.")

    def _check_terms(self, given: Quantity, measures: str, what: str) -> None:
        """Raise DefinitionError where a term of a length or an angle measures something else, or is a stroke that stands for both."""
        for _, term in signed_terms(given, self.members):
            own = "angle" if isinstance(term, Stroke) and term.name in self.turning else getattr(term, "measures", "")
            if {own, measures} == {"length", "angle"}:
                parts = ((name, part) for name in self.members if isinstance(term, Stroke) for part in self.with_parts(name))
                turned = ((name, angle) for name, part in parts for angle in part.in_radians())
                users = (f" in {name} = {self.members[name]}" for name, angle in turned if term.name in self.terms(angle))
                found, wanted = ({"angle": "an angle", "length": "a length"}[each] for each in (own, measures))
                remedy = f"on a radius r write r * {term.name or term} for the length, {term.name or term} / r for the angle"
                raise DefinitionError(f"{what}: {term.name or term} is {found}{next(users, '')}, and {wanted} is expected; {remedy}.")
            amount = term.number if isinstance(term, Number) else term.default if isinstance(term, Dimension) else None
            if isinstance(amount, Amount):
                require_measure(amount, measures, f"{self.title}: {term.name}" if term.name else f"{what}: a term of the {measures}")

    # -- what moves with what --------------------------------------------------------------------------

    def reaches(self, *starts: Member | str, within: Collection[str] = ()) -> set[str]:
        """Return the names of all members that some members are built from, themselves included; `within` stops the search at these."""
        if not within and len(starts) == 1 and isinstance(starts[0], str) and starts[0] in self._behind:
            return set(self._behind[starts[0]])
        names = [name for each in starts for name in ([each] if isinstance(each, str) else needs(each))]
        for name in names:
            self.member(name)
        found = needed_behind(names, self.members, within)
        if not within and len(starts) == 1 and isinstance(starts[0], str):
            self._behind[starts[0]] = frozenset(found)
        return found

    def member(self, name: str) -> Member:
        """Return a member by its name; DefinitionError, with the names there are, where there is none."""
        if name not in self.members:
            raise unknown("Name", name, self.valued_members, where=self.title)
        return self.members[name]

    def moves(self, quantity: Member) -> bool:
        """Return whether a quantity follows a stroke."""
        member = self.members.get(quantity.name, quantity)  # a stroke of a part may be a number of the whole
        return isinstance(member, Stroke) or any(self.member(name).name in self._driven for name in needs(member))

    @cached_property
    def _driven(self) -> set[str]:
        """The names of the members that follow a stroke."""
        found = set(self.strokes)
        for name, member in self.members.items():  # in order: what a member needs stands before it
            if not found.isdisjoint(needs(member)):
                found.add(name)
        return found

    @cached_property
    def bars(self) -> tuple[Bar, ...]:
        """The links of two points that the steps bring."""
        steps = [bar for point in self.points.values() for bar in point.bars()]
        return (*steps, *(rod for group in self.groups.values() for rod in group.rods))

    @cached_property
    def rods(self) -> tuple[Bar, ...]:
        """The bars of a length that no stroke changes."""
        return tuple(bar for bar in self.bars if not self.moves(bar.length))

    @cached_property
    def cylinders(self) -> tuple[Bar, ...]:
        """The driven lengths: bars of steps, and links of two points, whose length follows a stroke; each pair of points once."""
        lengths = [(frozenset(link.point_names), link) for link in self.of_kind(Link).values() if len(link.point_names) == 2]
        known = [(link.point_names, self.table.lengths[pair]) for pair, link in lengths if pair in self.table.lengths]
        links = [Bar(P, Q, length) for (P, Q, *_), length in known]
        found: dict[frozenset[str], Bar] = {}
        for bar in (*self.bars, *links):
            if self.moves(bar.length):
                found.setdefault(frozenset((bar.P, bar.Q)), bar)
        return tuple(found.values())

    @cached_property
    def link_names(self) -> Mapping[str, str]:
        """The names of the links that bodies are, by the names of these bodies; the frame has none."""
        links = [(name, {*link.point_names}) for name, link in self.of_kind(Link).items()]
        moving = [body for body in self.bodies if not body.fixed]
        found = {body.name: next((name for name, points in links if points <= {*body.points}), "") for body in moving}
        return {body: name for body, name in found.items() if name}

    @cached_property
    def joints(self) -> tuple[tuple[str, Joint], ...]:
        """The joints of steps, guides and slides, each with its member's name; driven joints only where a stroke drives them."""
        return tuple((name, joint) for name, member in self.holding.items() for joint in member.joints() if self.is_there(joint))

    @cached_property
    def holding(self) -> dict[str, Jointed]:
        """The members that hold others without being a load: points first, then guides and slides."""
        others = {name: member for name, member in self.of_kind(Jointed).items() if member.kind != "load"}
        return FrozenDict({**self.points, **others})

    @cached_property
    def sliding(self) -> dict[str, Jointed]:
        """The members beside points that let a point slide on a line."""
        found = {name: member for name, member in self.holding.items() if any(joint.track for joint in member.joints())}
        return FrozenDict({name: member for name, member in found.items() if name not in self.points})

    def is_there(self, joint: Joint) -> bool:
        """Return whether a joint holds two bodies apart: one whose drives all stand still makes them one body."""
        return not joint.drives or any(self.moves(drive.quantity) for drive in joint.drives)

    def pushing(self, joint: Joint) -> Quantity | None:
        """Return the length along its body that a stroke drives; None where it is only turned."""
        return next((drive.quantity for drive in joint.drives if drive.along == "t" and self.moves(drive.quantity)), None)

    def track(self, joint: Joint) -> tuple[str, ...]:
        """Return the track of a joint's point: the two points of a moving line, sorted, or a guide's name; empty without a slide."""
        guide = self.of_kind(Guide).get(joint.track[0]) if len(joint.track) == 1 else None
        return joint.track if guide is None or guide.Q is None else tuple(sorted(guide.points))

    @cached_property
    def telescopes(self) -> tuple[str, ...]:
        """The points that move along their body because a label of theirs follows a stroke."""
        return tuple(name for name, joint in self.joints if joint.arm)

    def is_cylinder(self, link: Link) -> bool:
        """Return whether a link of two points follows a stroke."""
        length = self.table.lengths.get(frozenset(link.point_names))
        return length is not None and self.moves(length)

    @cached_property
    def links(self) -> tuple[Body, ...]:
        """The bodies as steps and links join points, the frame first: one pushed along its carrier has the points it is measured by."""
        return rigid_bodies(self)

    @cached_property
    def bodies(self) -> tuple[Body, ...]:
        """The rigid bodies, the frame first: `links` without what one that is pushed along its carrier is measured by."""
        pushed = [(name, {*joint.by.points}) for name, joint in self.joints if joint.arm and self.pushing(joint) is not None]
        found = []
        for body in self.links:
            barred = set[str]().union(*(points for name, points in pushed if not body.fixed and name in body.points))
            found.append(replace(body, points=tuple(point for point in body.points if point not in barred)))
        return tuple(body for body in found if body.fixed or body.points)

    def guide_of(self, side: JointSide) -> Guide | None:
        """Return the guide that a side of a joint names; None where it names points, or nothing; DefinitionError for anything else."""
        if side.role != "guide" or set(side.points) <= set(self.points):
            return None
        found = self.members.get(side.points[0])
        if not isinstance(found, Guide):
            text = f"{self.title}: a joint has the side {side}, and {side.points[0]} is no guide"
            raise DefinitionError(f"{text}; name a Guide of the class, or the points of the body that the line is on.")
        return found

    @cached_property
    def resting(self) -> Mapping[str, tuple[str, ...]]:
        """The points at a fixed place on a guide or in a slot, which are rigid with it, each with the points that this goes through."""
        found = [(joint.point, joint) for point in self.points.values() for joint in point.joints() if joint.drives and joint.track]
        guides = self.of_kind(Guide)
        lines = {name: guide.points for name, guide in guides.items()}
        return FrozenDict({point: lines.get(joint.track[0], joint.track) for point, joint in found if not self.is_there(joint)})

    def terms(self, given: Quantity) -> set[str]:
        """Return the names that a quantity is a sum of, through the members it goes by."""
        name = given.known_as
        member = self.members.get(name, given) if name else given
        parts = member.parts() if isinstance(member, (Sum, Negative)) else ()
        return ({name} if name else set()).union(*(self.terms(part) for part in parts if isinstance(part, Quantity)))

    @cached_property
    def given_angles(self) -> tuple[Quantity, ...]:
        """The quantities that stand for angles."""
        return tuple(angle for name in self.members for part in self.with_parts(name) for angle in part.in_radians())

    @cached_property
    def turning(self) -> frozenset[str]:
        """The names of the terms of angles: strokes and dimensions in rad."""
        return frozenset().union(*map(self.terms, self.given_angles))

    @cached_property
    def given_lengths(self) -> tuple[Quantity, ...]:
        """The quantities that stand for lengths, and what drives a point along a guide or a crank."""
        jointed = [each for each in self.members.values() if isinstance(each, Jointed) and each.kind != "load"]
        driven = [drive.quantity for each in jointed for joint in each.joints() for drive in joint.drives]
        parts = (part for name in self.members for part in self.with_parts(name))
        own = [length for part in parts for length in part.lengths() if isinstance(length, Quantity)]
        return (*self.table.lengths.values(), *driven, *own)

    @cached_property
    def spanning(self) -> frozenset[str]:
        """The names of the terms of lengths: strokes and dimensions in m."""
        return frozenset().union(*map(self.terms, self.given_lengths)) - self.turning

    def known_stroke_kind(self, name: str) -> str:
        """Return whether a stroke is an "angle" or a "length": by the sums it is in, else as it was given; "" where neither tells."""
        given = [getattr(end, "measures", "") for end in (self.strokes[name].start, self.strokes[name].end)]
        return "angle" if name in self.turning else "length" if name in self.spanning else next(filter(None, given), "")

    @cached_property
    def stroke_kinds(self) -> Mapping[str, str]:
        """What each stroke is shown as: by its sums, else as it was given, else by what it multiplies; "" where nothing tells.

        phi of `angle=phi / 2` is an "angle", k of `AB=L + k * S`, with a length S, a plain "number", V of `oil=V` a "volume".
        """
        asked = [*((each, "angle") for each in self.given_angles), *((each, "length") for each in self.given_lengths)]
        scaled = ((name, (self.scaled_kind(name, *each) for each in asked)) for name in self.strokes)
        numbers = [(each.given(name), unit) for each in self.of_kind(ForceElement).values() for name, unit in each.numbers.items()]
        volumes = set[str]().union(*(self.terms(quantity(each)) for each, unit in numbers if unit == "l"))  # such as a line's oil
        kinds = {name: self.known_stroke_kind(name) or next(filter(None, found), "") for name, found in scaled}
        return FrozenDict({name: kind or ("volume" if name in volumes else "") for name, kind in kinds.items()})

    def scaled_kind(self, name: str, given: Quantity, kind: str) -> str:
        """Return the kind of a stroke that a product among the terms of a "length" or an "angle" has as a factor; else ""."""
        for _, term in signed_terms(given, self.members):
            own, sizes = list[int](), Counter({kind: 1})
            for power, each in self.factors(term):
                if name in self.terms(each):
                    own.append(power)
                else:
                    sizes[plan_measure(self, each.known_as) or each.measures or getattr(each.constant, "measures", "")] -= power
            if own == [1]:
                return {0: "angle" if sizes["angle"] == 1 else "number", 1: "length"}.get(sizes["length"], "")
        return ""

    def factors(self, given: Quantity, power: int = 1) -> Iterator[tuple[int, Quantity]]:
        """Yield the factors of a product, each with its power, 1 or -1, names looked up among the members."""
        match found := stands_for(self.members, given):
            case Operation(symbol="*" | "/"):
                yield from self.factors(found.a, power)
                yield from self.factors(found.b, power if found.symbol == "*" else -power)
            case Negative():
                yield from ((power, Number(-1.0)), *self.factors(found.a, power))
            case _:
                yield power, found

    @cached_property
    def following(self) -> tuple[tuple[str, Quantity], ...]:
        """The lengths that follow other quantities, and so can become negative, each with the member that it places."""
        place = list(self.members).index
        found: list[tuple[str, Member]] = [(max(ends, key=place), length) for ends, length in self.table.lengths.items()]
        names = sorted(self.reaches(*self.points), key=place)
        found += [(name, length) for name in names for part in self.with_parts(name) for length in part.lengths()]
        called = {str(length) for _, length in found}
        for name in names:  # also the length of a part of a rope, or of a cylinder on a closed line
            owner, _, own = name.rpartition(".")
            if owner and name not in called and self.members[owner].inside.get(own) == "quantity":
                found.append((name, self.members[name]))
        never = (Variable, Number, Length, Distance)
        return tuple((name, length) for name, length in found if isinstance(length, Quantity) and not isinstance(length, never))

    def with_parts(self, name: str) -> tuple[Member, ...]:
        """Return a member and its parts that have no name of their own."""
        return (self.members[name], *unnamed(self.members[name]))

    @cached_property
    def may_overflow(self) -> bool:
        """Whether a place depends on arithmetic that has no value everywhere: quotients, powers, functions, rules of other packages."""
        parts = [part for name in self.reaches(*self.points) for part in self.with_parts(name)]
        foreign = any(type(part).__module__.split(".")[0] != "linkage" for part in parts)
        return foreign or any(isinstance(part, Function) or (isinstance(part, Operation) and part.symbol != "*") for part in parts)

    @cached_property
    def cuts(self) -> tuple[str, ...]:
        """The inputs beside the strokes by which members move the machine; the force that holds them is a derivative by these."""
        return tuple(name for member in self.members.values() for name in member.cuts(self.members))

    @cached_property
    def driven_cuts(self) -> tuple[str, ...]:
        """Those of them that strokes change as well."""
        return tuple(name for member in self.members.values() for name in member.driven_cuts(self.members))

    @cached_property
    def groups(self) -> dict[str, Group]:
        """The groups whose pins are found together, in order."""
        return self.of_kind(Group)

    @cached_property
    def defaults(self) -> dict[str, float]:
        """The design variables at their defaults [SI]."""
        return FrozenDict(self.table.defaults)

    @cached_property
    def sketch_strokes(self) -> dict[str, float]:
        """The strokes at which sketch positions hold: the start of each, unless the class says `drawn(...)`, or one of its parts."""
        found = strokes_drawn(self.members)
        return FrozenDict({name: found[name] for name in self.strokes})

    @cached_property
    def moving(self) -> tuple[str, ...]:
        """The points that are not fixed."""
        return tuple(name for name in self.points if name not in self.ground)

    @cached_property
    def tip(self) -> tuple[str, ...]:
        """The point a machine is about that names none: the last free end without a mass, as a centre of gravity has, else the last."""
        loads = [("mass" in each.numbers, {*needs(each)} & self.points.keys()) for each in self.of_kind(ForceElement).values()]
        masses = {name for is_mass, names in loads for name in names if is_mass and len(names) == 1}
        held = {name for is_mass, names in loads for name in names if not is_mass and len(names) > 1}
        held |= {name for bar in self.cylinders for name in (bar.P, bar.Q)}.union(*map(needs, self.points.values()))
        of_bodies = Counter(name for body in self.bodies for name in body.points)
        free = [name for name in self.moving if of_bodies[name] == 1 and name not in masses | held]
        return (free[-1],) if free else self.moving[-1:]

    @property
    def heading(self) -> str:
        """The title as words, for pictures, in the language that is spoken: `MowerLift` is `Mower lift`."""
        return translated(re.sub(r"(?<=[a-z0-9])(?=[A-Z])", " ", self.title).capitalize())

    @cached_property
    def valued_members(self) -> Mapping[str, Member]:
        """The points, vectors and quantities by name."""
        found = {name: member for name, member in self.members.items() if isinstance(member, (Point, Arrow, Quantity))}
        return named_by(found, self.aliases)

    def __str__(self) -> str:
        return "\n".join(f"{name} = {text}" for name, text in printed(self).items())

    __repr__ = __str__


def needed_names(name: str, member: Member, title: str) -> list[str]:
    """Return the names that a member needs; DefinitionError, with the place, where a part of it cannot be one."""
    try:
        return list(needs(member))
    except DefinitionError as error:
        raise DefinitionError(f"{title}.{name}: {error}", member=name) from None


def with_inner(given: Mapping[str, Member], title: str) -> tuple[dict[str, Member], dict[str, list[str]]]:
    """Return the members of a class, inner ones such as `lift.length` where another needs them, and the names that each needs."""
    members = {name: member.among(given) for name, member in given.items()}
    wanted = {name: needed_names(name, member, title) for name, member in members.items()}
    lost = [name for needed in wanted.values() for name in needed if name not in wanted]
    while lost:
        name = lost.pop()
        owner, _, own = name.rpartition(".")
        if name in wanted or owner not in members:
            continue
        with about(name):
            found = members[owner].inner(own, members)
        if found is not None:
            members[name] = found.renewed(_name=name)
            wanted[name] = needed_names(name, members[name], title)
            lost += [each for each in wanted[name] if each not in wanted]
    return members, wanted


def fitting(name: str, asked: str, members: Mapping[str, Member]) -> list[str]:
    """Return the members that may stand where a member asks for a name, points where it asks for one; none where no door says which."""
    parts = [members[name], *unnamed(members[name])] if name in members else []
    doors = [(getattr(part, attribute, None), kind) for part in parts for attribute, kind in kinds_said(type(part)).items()]
    doors += [(given, "point") for part in parts for given in getattr(part, "parents", ())]
    kinds = [kind for given, kind in doors if is_member_or_name(given) and name_of(given, is_needed=False) == asked]
    return [each for each, member in members.items() if member.kind in kinds and each != name]


def construction_order(needs: Mapping[str, Iterable[str]], title: str, members: Mapping[str, Member] = MappingProxyType({})) -> list[str]:
    """Return the names so that each comes after all it needs, in the order written where that is free.

    Raises DefinitionError for a name nobody declares and for a cycle, which it prints.
    """
    graph = {name: list(dict.fromkeys(wanted)) for name, wanted in needs.items()}
    for name, wanted in graph.items():
        for each in wanted:
            if each not in graph:
                raise unknown("Name", each, fitting(name, each, members) or graph, where=f"{title}.{name}", member=name)
    try:
        return list(TopologicalSorter(graph).static_order())
    except CycleError as error:
        cycle = list(reversed(error.args[1]))
        text = f"{title}: {' needs '.join(cycle)}. Nothing in this cycle can come first; take one of them from another point."
        raise DefinitionError(text, member=cycle[0]) from None


def rigid_bodies(plan: Members, apart: Collection[frozenset[str]] = ()) -> tuple[Body, ...]:
    """Return the rigid bodies, the frame first; without the points that are measured along the pairs of points `apart`."""
    groups: list[tuple[str, ...]] = [(bar.P, bar.Q) for bar in plan.rods]
    placed = [body for name, point in plan.points.items() if name not in plan.telescopes for body in point.bodies()]
    groups += [body for body in placed if frozenset(body[:2]) not in apart]
    groups += [link.point_names for link in plan.of_kind(Link).values() if len(link.point_names) > 2 or not plan.is_cylinder(link)]
    standing = standing_points(plan)
    groups += [(*line, name) for name, line in standing.items() if line]
    return merged(groups, [name for name, line in standing.items() if not line])


def standing_points(plan: Members) -> dict[str, tuple[str, ...]]:
    """Return the points that stand still on a body, with two points of it, none of the frame.

    These are fixed points, those at a fixed place on a guide, and ends of cranks that nothing turns, on a pin of the same body.
    """
    found: dict[str, tuple[str, ...]] = {name: () for name in plan.ground}
    guides = plan.of_kind(Guide)
    for name, point in plan.points.items():
        line, joints = plan.resting.get(name, ("", "")), point.joints()
        pins = [(joint.point, joint.by.points) for joint in joints if joint.kind == "crank" and not plan.is_there(joint)]
        if len(line) == 1:
            pins += [(line[0], guides[joint.track[0]].axes.carrier) for joint in joints if joint.track]
        elif name in plan.resting:
            found[name] = line
        for pin, carrier in pins:
            is_carried = bool(carrier) and any({*carrier, pin} <= {*body} for body in plan.points[pin].bodies())
            if is_carried or found.get(pin) == carrier:
                found[name] = carrier
    return found


def carrying_pairs(plan: Members, members: Iterable[Iterable[str]] = ()) -> frozenset[frozenset[str]]:
    """Return the ends of the straight two-point members that carry points measured along them, such as K = OnLink(A, B) on a cylinder.

    They are driven lengths, the elements of the class and `members` more, by their ends. A member between two points that are
    rigid with each other without it, as a spring across a link is, carries nothing: the link does.
    """
    measured = {frozenset(body[:2]) for name, point in plan.points.items() if name not in plan.telescopes for body in point.bodies()}
    driven = {frozenset((bar.P, bar.Q)) for bar in plan.cylinders}
    elements = [{joint.point for joint in each.joints()} for each in plan.of_kind(Jointed).values() if each.kind == "load"]
    found = measured & {*driven, *map(frozenset, (*elements, *members))}
    while rigid := {pair for pair in found - driven if any(pair <= set(body.points) for body in rigid_bodies(plan, found))}:
        found -= rigid
    return frozenset(found)


def spanning_name(plan: Members, P: str, Q: str) -> str:
    """Return the name of the cylinder or spring between two points. Where there is none it is theirs, `AB`."""
    elements = plan.of_kind(Jointed).items()
    own = (name for name, each in elements if each.kind == "load" and [joint.point for joint in each.joints()] in ([P, Q], [Q, P]))
    return next(own, joined_names(P, Q))


def member_sides(plan: Members, ends: tuple[str, str], points: Iterable[str]) -> tuple[set[str], set[str]]:
    """Return which points of a body go with the one and with the other end of the two-point member that it is.

    Those that are measured from that end, of a cylinder from A on its barrel and from B on its rod, and what is linked to such points.
    """
    among = set(points)
    groups = [{body[0], point} for point in among for body in plan.points[point].bodies() if point not in body[:2]]
    groups += [{bar.P, bar.Q} for bar in plan.rods]
    groups += [set(link.point_names) for link in plan.of_kind(Link).values() if not set(ends) <= set(link.point_names)]
    near, far = {ends[0]}, {ends[1]}
    for side in (near, far):
        while more := set().union(*(group for group in groups if group & side)) & among - side:
            side |= more
    return near, far


def printed(plan: Members, values: Mapping[str, float] = MappingProxyType({})) -> dict[str, str]:
    """Return every member as a line that can be pasted into a class, by name; the design variables among `values` [SI] have those.

    A part is one line, which says what it was given and which of its dimensions have other values.
    """
    spelled = respelled(plan, values)
    members, own = {name: member for name, member in plan.members.items() if "." not in name}, dict[str, Member]()
    for name, member in members.items():  # those of which others ask something before these, what they name in quotes until it is written
        for owner in dict.fromkeys(each.rpartition(".")[0] for each in needs(member)):
            if owner in members and owner not in own and members[owner].kind != "part":
                given = {place: getattr(members[owner], place) for place in getattr(members[owner], "places", ())}
                own[owner] = members[owner].renewed(**{place: in_quotes(each, own) for place, each in given.items()})
        own.setdefault(name, member)
    set_in = {name: value for name, value in spelled.items() if "." in name and name in plan.defaults and value != plan.defaults[name]}
    parts = {name: member.having(set_in) for name, member in own.items() if member.kind == "part"}
    return {name: as_written(parts[name] if name in parts else member.having(spelled), plan.turning) for name, member in own.items()}


def in_quotes(given: Any, known: Collection[str]) -> object:
    """Return a reference, or several, in quotes where it is not among the names that are known."""
    if isinstance(given, tuple):
        return tuple(in_quotes(each, known) for each in given)
    return given if name_of(given) in known else repr(name_of(given))


def respelled(plan: Members, values: Mapping[str, float]) -> dict[str, float]:
    """Return design variables [SI] under all names that labels give them."""
    return {each: sign * values[owner] for each, (owner, sign) in plan.table.spellings.items() if owner in values}


def written_out(plan: Members, values: Mapping[str, float] = MappingProxyType({})) -> dict[str, str]:
    """Return every member as it is written, those of parts each by itself; the design variables among `values` [SI] have those."""
    spelled = respelled(plan, values)
    return {name: as_written(member.having(spelled), plan.turning) for name, member in plan.members.items()}


def as_written(member: Member, turning: frozenset[str]) -> str:
    """Return a member as it would be written; `turning` names the quantities that are angles, whose numbers are in degrees."""
    match member:
        case Quantity():
            return member.text("angle" if member.name in turning else "")
        case Drawn():
            words = (f"{name}={in_degrees(value) if name in turning else repr(value)}" for name, value in member.strokes.items())
            return f"drawn({', '.join(words)})"
    return str(member)


def plan_measure(plan: Members, variable: str) -> str:
    """Return the kind of a design variable ("length", "angle", "pressure", ...); "" where nothing tells it.

    A dimension without a unit of its own measures what it is added to: `L0` in `AB=L0 + S` is a length. A value of a stroke measures what
    the strokes do, where all are alike.
    """
    entry = plan.table.entries.get(variable)
    strokes = {*plan.stroke_kinds.values()} if entry is not None and entry.kind == "stroke" else set()
    found = strokes.pop() if len(strokes) == 1 else entry.measures if entry is not None else ""
    return found or ("length" if variable in plan.spanning else "angle" if variable in plan.turning else "")


def strokes_text(plan: Members, values: Mapping[str, float]) -> str:
    """Return stroke values [SI] as they are read: `S = 100 mm, phi = 60 deg`."""
    words = (f"{name} = {show(value, display_unit(plan.stroke_kinds[name] or 'length', 'mm'), 4)}" for name, value in values.items())
    return ", ".join(words) or "no stroke"
