"""The locked mechanism as bodies and joints, for the equations of equilibrium.

Everything about a joint comes from what its member says of it in `joints()`; no kind of step is known here.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from dataclasses import replace
from functools import cached_property
from itertools import chain, product
from typing import TypeAlias

import numpy as np

from ..errors import DefinitionError, ensure, known_name, unknown
from ..frozen import immutable, record
from ..loads import ForceElement, Halves, Load, PinFriction, Push, TwoPoint
from ..plan import Plan, arm_joint, arm_points, carrying_pairs, holds_an_arm, member_sides
from ..program import FloatArray
from ..quantities import (
    Angle,
    Coordinate,
    Distance,
    Driven,
    Joint,
    JointSide,
    Quantity,
    Where,
    body_name,
    joined_names,
    name_of,
    pinned,
    signed_terms,
)
from ..steps import Link, Point
from ..vectors import Line
from .applied import member_title
from .holding import Holders, PressureLine, holders_of, is_among, same, sampled
from .poses import FlatPoses, quarter_turned


class NotHeldError(DefinitionError):
    """A body of a machine is held by nothing, so that it has no forces."""


FRAME = -1
FRAME_NAME = "frame"


@record
class FreeBody:
    """One body that is held in equilibrium. `axis`: two points that turn with it; `slides`: a lone point guided without turning."""

    name: str
    points: tuple[str, ...]
    axis: tuple[str, str] | None = None
    slides: bool = False
    label: str = ""


@immutable
class SlidingPair:
    """A straight member of two bodies, the second of which slides in the first; see `Halves`."""

    member: TwoPoint
    halves: Halves
    bodies: tuple[FreeBody, FreeBody]

    @property
    def points(self) -> set[str]:
        """The points of both bodies."""
        return {point for body in self.bodies for point in body.points}

    def line(self, point: str) -> Callable[[Where], Line]:
        """Return the line through a point on the axis, from A towards B."""
        A, B = self.member.ends
        return lambda where: Line(where.at(point), (where.at(B) - where.at(A)) * (1.0 / where.link_length(A, B)))


@immutable
class Strut:
    """A straight two-point member P -> Q: a driven length, a cylinder that holds, or a member whose thrust a law gives.

    `quantity` is the driven length [m], None if the points alone give it. `far` are the points on Q's side. `host` is the body that it
    forms with the points measured along it, if any. `pair` are its two bodies, if it has two. `line` is what it holds with. `known` is its
    thrust if a law gives it, so that it drives nothing.
    """

    name: str
    P: str
    Q: str
    quantity: Quantity | None = None
    far: frozenset[str] = frozenset()
    host: str = ""
    line: PressureLine | None = None
    known: Push | None = None
    pair: SlidingPair | None = None

    @property
    def ends(self) -> tuple[str, str]:
        """The points at its ends."""
        return self.P, self.Q

    @property
    def is_cylinder(self) -> bool:
        """Whether it is a member that holds, or that would where nothing fed it."""
        member = None if self.known is None else self.known.member
        return self.line is not None or (isinstance(member, TwoPoint) and member.holds)


Bodies: TypeAlias = tuple[tuple[FreeBody, ...], tuple[Strut, ...], tuple[SlidingPair, ...]]
"""The bodies, the two-point members, and the pairs of bodies that some of them are."""


def free_bodies(plan: Plan, holders: Holders, thrusts: Sequence[Push], geared: Collection[frozenset[str]] = ()) -> Bodies:
    """Return the bodies and the two-point members: sliders first, then links, then those members that are bodies of their own."""
    fixed = frame_points(plan)
    sides = [side for _, joint in plan.joints for side in (joint.on, joint.by) if side.role == "slider"]
    sliders = [slider(point) for point in dict.fromkeys(side.points[0] for side in sides) if point not in fixed]
    arms = [telescope(plan, name) for name in plan.telescopes]
    inner = {frozenset(arm.points) for arm in arms}
    links = []
    for body in plan.links[1:]:
        if frozenset(body.points) not in inner and not holds_an_arm(plan, body.points):
            links.append(FreeBody(body.name, body.points, (body.points[0], body.points[1]), label=plan.link_names.get(body.name, "")))
    pairs = sliding_pairs(plan, links)
    links = [link for link in links if not any(set(link.points) == pair.points for pair in pairs)]
    struts, hosts = two_point_members(plan, holders, thrusts, links, geared)
    struts = tuple(replace(each, pair=next((pair for pair in pairs if pair.member.name == each.name), None)) for each in struts)
    renamed = [each for each in struts if each.host == each.name]
    links = [link for link in links if link not in [hosts[each.name] for each in renamed]]
    carrying = [replace(hosts[each.name], name=each.name, axis=each.ends) for each in renamed]
    alone = [each for each in struts if not each.host and each.pair is None]
    own = [FreeBody(each.name, each.ends, each.ends, label=joined_names(*each.ends)) for each in alone]
    return (*sliders, *arms, *links, *carrying, *own, *(body for pair in pairs for body in pair.bodies)), struts, pairs


def frame_points(plan: Plan) -> frozenset[str]:
    """Return the points that do not move."""
    return frozenset(plan.links[0].points if plan.links else ()) | set(plan.ground)


def slider(point: str) -> FreeBody:
    """Return the body of its own that slides at a point without turning."""
    return FreeBody(f"{point} (slider)", (point,), slides=True)


# Straight members: driven lengths, cylinders that hold, members with a law of their own.


def two_point_members(
    plan: Plan, holders: Holders, thrusts: Sequence[Push], links: Sequence[FreeBody], geared: Collection[frozenset[str]] = ()
) -> tuple[tuple[Strut, ...], dict[str, FreeBody]]:
    """Return the two-point members, and by their names the declared bodies that they are together with the points along them."""
    cylinders = [Strut(member_title(each), *each.ends, line=holders.line_of(each)) for each in holders.every_cylinder]
    given = [each for each in thrusts if not is_among(each.member, holders.every_cylinder)]
    found = []
    for bar in plan.cylinders:
        behind = plan.reaches(bar.length.name or bar.length)
        if (holders.strokes_taken.isdisjoint(behind) or {*plan.strokes} & behind in geared) and not holders.line_quantities & behind:
            found.append(Strut(joined_names(bar.P, bar.Q), bar.P, bar.Q, bar.length))
    struts = [*found, *cylinders, *known_struts(given)]
    twice = next((name for name, count in Counter(strut.name for strut in struts).items() if count > 1), None)
    ensure(not twice, f"{plan.title}: two elements are called {twice}; give each a name of its own in the class.")
    # The declared bodies that are members with the points measured along them. One member a body: of several between the same points
    # the cylinder, then the driven length, then the first of the others. A body that a stroke drives keeps its own name.
    inside = [(strut, link) for strut in struts for link in links if {strut.P, strut.Q} <= set(link.points)]
    carrying, hosts = carrying_pairs(plan, (each.ends for each, _ in inside)) if inside else set(), dict[str, FreeBody]()
    for strut, link in sorted(inside, key=lambda each: (not each[0].is_cylinder, each[0].quantity is None)):
        if link not in hosts.values() and (strut.quantity is not None or frozenset(strut.ends) in carrying):
            hosts.setdefault(strut.name, link)
    for place, strut in enumerate(struts):
        host = hosts.get(strut.name)
        if host is None:
            struts[place] = replace(strut, far=frozenset({strut.Q}))
        else:
            name = strut.name if strut.quantity is None else host.name
            struts[place] = replace(strut, far=far_points(plan, strut, host), host=name)
    return tuple(struts), hosts


def far_points(plan: Plan, strut: Strut, host: FreeBody) -> frozenset[str]:
    """Return the points that go with a member's end Q, of a cylinder those on its rod: measured from Q, or linked to such points.

    DefinitionError for a point that keeps its place on neither side, as on a triangle whose third side is the member.
    """

    def moves(_: Plan) -> dict[tuple[str, str], float]:
        """Return how far points move along and across it beside one of its ends, over the strokes and relative to their distance."""
        motion, found = sampled(plan), {}
        along = motion[strut.Q] - motion[strut.P]
        along = along / np.hypot(along[0], along[1])
        for point, end in product(host.points, strut.ends):
            arm = motion[point] - motion[end]
            parts = np.stack([arm[0] * along[0] + arm[1] * along[1], along[0] * arm[1] - along[1] * arm[0]])[:, motion.reached]
            size = float(np.max(np.hypot(parts[0], parts[1]), initial=0.0)) or 1.0
            found[point, end] = float(np.max(np.ptp(parts, axis=1), initial=0.0)) / size if parts.size else 0.0
        return found

    near, far = member_sides(plan, strut.ends, host.points)
    moved = plan.made(("places", strut.P, strut.Q, host.points), moves)
    for point in host.points:
        kept = [end for end, side in ((strut.P, near), (strut.Q, far)) if point in side]
        if len(kept) != 1 or not moved[point, kept[0]] <= RIGID:
            P, Q = strut.ends
            what = f"{point} = {plan.points[point]} is measured along {strut.name}, whose length {P}{Q} changes, and keeps its place"
            remedy = f"Measure it from one of them, {point} = OnLink({P}, {Q}, {P}{point}=...), with an angle where it lies aside; or let"
            what += f" neither at {P} nor at {Q}, so that it is not held"
            raise NotHeldError(f"{plan.title}: {what}. {remedy} two links meet there, Dyad({P}, {Q}, ...).")
    return frozenset(far)


def sliding_pairs(plan: Plan, links: Sequence[FreeBody]) -> tuple[SlidingPair, ...]:
    """Return the members of the class that are two bodies each; DefinitionError for several between the same two points."""
    found: list[SlidingPair] = []
    for member in plan.of_kind(TwoPoint).values():
        halves = member.halves(plan.members)
        if halves is None:
            continue
        host = next(link for link in links if {*member.ends, *halves.points} <= set(link.points))
        other = next((pair.member for pair in found if pair.points & {*halves.points}), None)
        if other is not None:
            what = f"{other.name} and {member.name} are two bodies each, and both are between {' and '.join(member.ends)}"
            raise DefinitionError(f"{plan.title}: {what}: which of them carries a point is not told. Declare one with count=2.")
        far = far_points(plan, Strut(member.name, *member.ends), host)
        parts = tuple(point for point in host.points if point not in far), tuple(point for point in host.points if point in far)
        axes = zip(member.ends, halves.points, strict=True)
        bodies = [FreeBody(*each) for each in zip(halves.names, parts, axes, (False, False), halves.labels, strict=True)]
        found.append(SlidingPair(member, halves, (bodies[0], bodies[1])))
    return tuple(found)


RIGID = 1e-7
"""A point that moves by less than this part of its distance keeps its place."""


def known_struts(thrusts: Sequence[Push]) -> list[Strut]:
    """Return the members whose thrust is known, each once; several laws on one add up, those without names are counted."""
    found: list[Push] = []
    for each in thrusts:
        place = next((k for k, other in enumerate(found) if each.member.name and same(each.member, other.member)), None)
        if place is None:
            found.append(each)
        else:
            found[place] = replace(found[place], thrust=found[place].thrust + each.thrust)
    unnamed = Counter(each.name for each in found if not each.name.isidentifier())
    counts = Counter[str]()
    struts = []
    for each in found:
        counts[each.name] += 1
        name = f"{each.name} {counts[each.name]}" if unnamed[each.name] > 1 else each.name
        struts.append(Strut(name, *each.member.ends, known=each))
    return struts


# Telescopes: an arm that a driven joint moves along or about its body.


def telescope(plan: Plan, name: str) -> FreeBody:
    """Return the arm that a driven joint moves: its point and all that is rigid with it."""
    joint = arm_joint(plan, name)
    refuse_driven(plan, joint.still)
    points = arm_points(plan, name)
    return FreeBody(body_name(points), points, (joint.point, name))


def refuse_driven(plan: Plan, still: Iterable[tuple[Quantity, str]]) -> None:
    """Raise DefinitionError for a quantity that follows a stroke where its force is not provided."""
    for quantity, what in still:
        provided = "forces are provided for driven lengths, cranks, OnGuide and OnLink"
        ensure(not plan.moves(quantity), f"{plan.title}: {what} follows a stroke; {provided}.")


# The joints between bodies.


@immutable
class Contact:
    """A joint between two bodies: its force acts on the body `on` from the body `by` (indices, -1 the frame), at a point.

    `holds` are the letters of what it transmits: x, y, n across its line, t along it, c a couple. `owner` is the member that
    declares it, `joint` what that says; `track` the points or the guide of the line it slides on.
    """

    kind: str
    point: str
    on: int
    by: int
    holds: str
    joint: Joint
    owner: str = ""
    track: tuple[str, ...] = ()

    @property
    def presses(self) -> int:
        """How many of its unknowns make its friction: both components of a pin, the normal one of a guide."""
        return 2 if self.kind == "pin" else 1

    @property
    def has_force(self) -> bool:
        """Whether it transmits a force; a crank's drive has only a couple."""
        return self.holds != "c"

    @property
    def is_at_point(self) -> bool:
        """Whether its force acts at its point, which runs on the line where it has one; else at the line's origin."""
        joint = self.joint
        return joint.line is None or bool(joint.track) or "runner" in (joint.on.role, joint.by.role)

    @property
    def is_curve(self) -> bool:
        """Whether its point is driven along a line of the frame that is no guide's: its way follows from the point itself.

        An arm's joint stands where its length is counted from, and that point stays.
        """
        return self.by == FRAME and not self.track and not self.joint.arm


@immutable
class Gear:
    """The couple on a body that a joint is geared to: against its own couple, or a rack's force, `sign` and factors times it."""

    contact: Contact
    joint: Contact
    letter: str
    sign: float
    factors: tuple[tuple[int, Quantity], ...]


LETTERS = frozenset("xyntc")
"""What a joint may hold."""
ORDER = {kind: place for place, kind in enumerate(("guide", "slider", "slot", "driven", "crank", "telescope", "upright"))}
"""The order in which joints are listed, after the pins; other kinds come last."""


class Structure:
    """Bodies, lone pins and contacts of a plan. An index -1 is the frame; lone pins come after the bodies."""

    def __init__(
        self, plan: Plan, elements: Iterable[ForceElement] = (), thrusts: Sequence[Push] = (), is_geared: bool = False
    ) -> None:
        self.plan, self.thrusts, elements = plan, tuple(thrusts), tuple(elements)
        self.gears: list[Gear] = []
        self.fixed = frame_points(plan)
        self.holders: Holders = holders_of(plan, elements)
        self.geared = self.shared_strokes(is_geared)
        bodies, self.struts, self.pairs = free_bodies(plan, self.holders, thrusts, self.geared)
        sliding = dict.fromkeys((joint.point, plan.track(joint)) for _, joint in plan.joints if joint.kind == "guide")
        guides, joined = Counter(point for point, _ in sliding), Counter(point for body in bodies for point in body.points)
        # The sliding blocks that friction asks for: of pins with friction that run on one guide or slot and join one link only.
        pins = dict.fromkeys(name_of(each.point) for each in elements if isinstance(each, PinFriction))
        alone = [point for point in pins if joined[point] == 1 and guides[point] == 1 and point not in self.fixed]
        self.blocks = tuple(map(slider, alone))
        self.bodies = (*self.blocks, *bodies)
        runners = [joint.point for _, joint in plan.joints if joint.on.role == "runner"]
        self.lone = tuple(dict.fromkeys(point for point in runners if not self.owners(point)))
        self.contacts = (*self.pins(), *self.step_joints(), *self.sliding_joints())

    # -- contacts ------------------------------------------------------------------------------------------

    def pins(self) -> Iterator[Contact]:
        """Yield the pins: of k bodies at a point, k - 1 turn on the first."""
        for point in self.plan.points:
            first, *others = self.owners(point) or [FRAME]
            yield from (Contact("pin", point, other, first, "xy", pinned(point)) for other in others)

    def step_joints(self) -> Iterator[Contact]:
        """Yield the joints of steps, guides and slides: equal slides once, and of drives that a cylinder replaces the other directions."""
        seen: set[tuple[str, tuple[str, ...]]] = set()
        for name, joint in sorted(self.plan.joints, key=lambda each: ORDER.get(each[1].kind, len(ORDER))):
            self.check(name, joint)
            track, runs = self.plan.track(joint), joint.on.role == "runner"
            holds, kind = self.left(name, joint), joint.kind
            stands = joint.on.role == "slider" and joint.on.points[0] in self.fixed
            if stands or (track and runs and (joint.point, track) in seen):
                continue
            seen |= {(joint.point, track)} if track and runs else set()
            if not holds:
                continue
            refuse_driven(self.plan, joint.still)
            on, by = self.side(joint.on, joint, name), self.side(joint.by, joint, name)
            if runs and "t" in joint.holds and "t" not in holds:
                kind = "guide"
            if kind == "guide" and 0 <= on < len(self.blocks):
                kind, holds = "slider", holds + "c"
            geared = [each for each in geared_to(self.plan, joint, name) if each[0] in holds]
            if len(geared) == 1 and geared[0][0] == "c" and geared[0][2:] == (1.0, ()):
                by = self.carrier(*angle_ends(geared.pop()[1]), name)
            found = Contact(kind, joint.point, on, by, holds, joint, name, track)
            yield found
            for letter, angle, sign, factors in geared:
                ends, carrier = angle_ends(angle), angle.axes.carrier
                turned, against = self.carrier(*ends, name), self.carrier(carrier[0], carrier[1], name) if carrier else FRAME
                gear = Joint("gear", ends[0], JointSide(ends), JointSide(carrier), "c")
                self.gears.append(Gear(Contact("gear", ends[0], turned, against, "c", gear, name), found, letter, sign, factors))
                yield self.gears[-1].contact

    def sliding_joints(self) -> Iterator[Contact]:
        """Yield the joints between the two bodies of a member: across and against turning, and along where such a member acts."""
        acting = {each.pair for each in self.struts}
        for pair in self.pairs:
            by, on = (self.bodies.index(body) for body in pair.bodies)
            barrel, rod = (JointSide((end,)) for end in pair.member.ends)
            for kind, point, holds in zip(pair.halves.kinds, pair.halves.points, ("nc", "t"), strict=True):
                if holds == "nc" or pair in acting:
                    yield Contact(kind, point, on, by, holds, Joint(kind, point, rod, barrel, holds, pair.line(point)))

    def sliding_joint(self, pair: SlidingPair, letter: str) -> Contact:
        """Return the joint of a member of two bodies that holds n, c or t between them."""
        points = pair.halves.points
        return next(each for each in self.contacts if letter in each.holds and each.point in points and not each.owner)

    def check(self, owner: str, joint: Joint) -> None:
        """Raise DefinitionError for a joint, of a step of one's own, that does not say enough to write its forces."""
        opening = f"{self.plan.title}: {owner}.joints(): the joint {joint.kind!r} at {joint.point}"
        letters, drives = set(joint.holds), {drive.along for drive in joint.drives if drive.along}
        wrong = ""
        if not letters <= LETTERS or len(letters) < len(joint.holds):
            wrong = f"holds {joint.holds!r}; letters of x, y, n, t, c are expected, each once"
        elif letters & {"n", "t"} and joint.line is None:
            wrong = f"holds {joint.holds!r}, across (n) or along (t) a line, but says none; give line="
        elif drives - letters:
            wrong = f"drives {', '.join(sorted(drives - letters))}, which it does not hold ({joint.holds!r})"
        ensure(not wrong, f"{opening} {wrong}.")
        known_name("Point", joint.point, self.plan.points, where=opening)

    def left(self, owner: str, joint: Joint) -> str:
        """Return the directions a joint still holds when cylinders have taken over strokes."""
        strokes, given = self.followed(joint)
        over = self.holders.strokes_taken
        gone = {letter: names & over for letter, names in strokes.items() if letter not in given and names not in self.geared}
        gone = {letter: names for letter, names in gone.items() if names}
        taken = sorted(set().union(*gone.values()))
        if len(gone) > len(taken):
            what = f"{owner}.joints(): {' and '.join(gone)} are driven by {', '.join(taken)}, which a cylinder takes over"
            raise DefinitionError(f"{self.plan.title}: {what}; let one letter follow it, such as t along a line=, so that the other holds.")
        return "".join(letter for letter in joint.holds if letter not in gone and letter not in given)

    def followed(self, joint: Joint) -> tuple[dict[str, set[str]], set[str]]:
        """Return the strokes that each direction of a joint follows, but for what turns with moving bodies, and those that lines give."""
        carrier = joint.by.points if joint.kind == "crank" else ()  # a part's own angle does not follow what moves the body it is on
        strokes, given = {letter: set[str]() for letter in joint.holds}, set[str]()
        for drive in joint.drives:
            for _, term in own_terms(self.plan, drive):
                follows = self.plan.reaches(term.name or term, within=carrier)
                given |= {drive.along} if self.holders.line_quantities & follows else set()
                if drive.along in strokes:
                    strokes[drive.along] |= follows & set(self.plan.strokes)
        return strokes, given

    def shared_strokes(self, is_geared: bool) -> set[frozenset[str]]:
        """Return the sets of strokes which more joints and lengths follow than cylinders take over of them.

        These keep their drives, as geared cranks do: what they give together does no work on a stroke that is taken over. Cranks of one
        stroke, or a rack beside a body, only where `is_geared`. What lines of oil give is none of them.
        """
        plan, taken, groups = self.plan, self.holders.strokes_taken, list[list[frozenset[str]]]()
        if not taken:
            return set()
        found = [(each, *self.followed(each[1])) for each in plan.joints]
        joints = [(each, frozenset(names)) for each, strokes, given in found for letter, names in strokes.items() if letter not in given]
        reaches = [plan.reaches(bar.length.name or bar.length) for bar in plan.cylinders]
        lengths = [frozenset({*plan.strokes} & each) for each in reaches if not self.holders.line_quantities & each]
        for names in [names for names in (*(names for _, names in joints), *lengths) if names & taken]:
            near = [group for group in groups if names & taken & frozenset().union(*group)]
            groups = [*(group for group in groups if group not in near), [names, *chain(*near)]]
        sizes = [(group, frozenset[str]().union(*group)) for group in groups]
        more = [group for group, strokes in sizes if len(group) > len(strokes & taken) and (is_geared or strokes - taken)]
        shared = set(chain(*more))
        if is_geared:
            shared |= {names for (name, joint), names in joints if names & taken and any(geared_to(plan, joint, name))}
            driven = [bar.length for bar in plan.cylinders] + [drive.quantity for _, joint in plan.joints for drive in joint.drives]
            for given in driven:  # what follows another length that is driven
                if any(is_driven(plan, each) for _, term in signed_terms(given, plan.members) for _, each in plan.factors(term)):
                    shared.add(frozenset({*plan.strokes} & plan.reaches(given)))
        return {names for names in shared if names & taken}

    def turned_by_gears(self) -> tuple[str, ...]:
        """Return where gears give couples or forces: pivots of cranks and racks geared to a body or to each other, lengths beside racks."""
        turned = [each for each in self.contacts if "c" in each.joint.holds]
        coupled = [each for each in turned if frozenset(self.followed(each.joint)[0]["c"]) in self.geared]
        followed = {each.name: self.plan.reaches(each.quantity.name or each.quantity) for each in self.struts if each.quantity is not None}
        lengths = [name for name, behind in followed.items() if frozenset({*self.plan.strokes} & behind) in self.geared]
        return tuple(dict.fromkeys((*(each.point for each in (*coupled, *(gear.joint for gear in self.gears))), *lengths)))

    def drives(self, contact: Contact) -> Iterator[tuple[Quantity, str, float]]:
        """Yield the drives of a contact: the quantity, the letter of the force that is conjugate to it, and its sign."""
        for drive in contact.joint.drives:
            if drive.along in contact.holds and drive.along:
                yield from ((term, drive.along, drive.sign * sign) for sign, term in own_terms(self.plan, drive))

    # -- who owns what -------------------------------------------------------------------------------------

    def owners(self, point: str) -> list[int]:
        """Return the bodies of a point, the frame first."""
        frame = [FRAME] if point in self.fixed else []
        return frame + [index for index, body in enumerate(self.bodies) if point in body.points]

    def holder(self, point: str) -> int:
        """Return the body that carries the pin at a point; DefinitionError where nothing holds it."""
        found = self.owners(point)
        if found:
            return found[0]
        if point in self.lone:
            return len(self.bodies) + self.lone.index(point)
        raise DefinitionError(f"{self.plan.title}: {point} belongs to no body; for forces declare its link, such as Link({point}, ...).")

    def carrier(self, P: str, Q: str, what: str) -> int:
        """Return the body that holds two points."""
        common = [index for index in self.owners(P) if index in self.owners(Q)] or self.halves_with(P, Q)
        length = self.plan.table.lengths.get(frozenset((P, Q)))
        follows = length is not None and self.plan.moves(length)
        remedy = f"{P}{Q} = {length}; name two points that keep their distance" if follows else f"for forces declare Link({P}, {Q})"
        ensure(common, f"{self.plan.title}: {what}: {P} and {Q} do not belong to one body; {remedy}.")
        return common[0]

    def bearer(self, load: Load) -> int:
        """Return the body that a load acts on."""
        known_name("Point", load.point, self.plan.points, where=self.plan.title)
        if len(load.on) == 1:
            pair = next((each for each in self.pairs if each.member.name == load.on[0] and load.point in each.points), None)
            return self.index(load.on[0]) if pair is None else self.halves_with(load.point, *pair.member.ends)[0]
        if load.on and not set(self.owners(load.on[0])) & set(self.owners(load.on[1])):  # of a bar that stretches each end bears its own
            ends = self.owners(load.point)[-1:] if load.point in load.on else []
            return (self.halves_with(load.point, *load.on) or ends or [self.carrier(load.on[0], load.on[1], "a load")])[0]
        return self.carrier(load.on[0], load.on[1], "a load") if load.on else self.holder(load.point)

    def halves_with(self, point: str, *others: str) -> list[int]:
        """Return the body with a point, of a member of two bodies to which other points belong as well; none where there is none."""
        pairs = (pair for pair in self.pairs if {point, *others} <= pair.points)
        return [self.bodies.index(body) for pair in pairs for body in pair.bodies if point in body.points]

    def body_of(self, strut: Strut) -> int:
        """Return the body that a two-point member is, or is part of."""
        name = strut.host or strut.name
        return next(index for index, body in enumerate(self.bodies) if body.name == name and {strut.P, strut.Q} <= set(body.points))

    def seat(self, contact: Contact, body: int) -> str:
        """Return the point of a body that a contact goes with: its own where it is one, else that from which its line is measured."""
        if contact.point in self.bodies[body].points:
            return contact.point
        side = contact.joint.on if contact.on == body else contact.joint.by
        guide = self.plan.guide_of(side)
        return next(iter(side.points if guide is None else guide.points), contact.point)

    def side(self, side: JointSide, joint: Joint, owner: str) -> int:
        """Return the body that one side of a joint names."""
        guide = self.plan.guide_of(side)
        if guide is not None:
            if guide.angle is not None:
                refuse_driven(self.plan, ((guide.angle, f"{guide.name} = {guide}: its angle"),))
            if len(guide.points) == 2:
                return self.carrier(guide.points[0], guide.points[1], f"{guide.name} = {guide}")
            return next((self.sliding_at(point) for point in guide.points if point not in self.fixed), FRAME)
        if side.role == "slider":
            return self.sliding_at(side.points[0])
        if side.role == "runner":  # a body that runs on the line with two points, else the carrier of the pin
            point, line = side.points[0], self.plan.track(joint)
            others, owners = {other for other, its in self.running if its == line} - {point}, self.owners(point)
            both = [index for index in owners if index != FRAME and others & set(self.bodies[index].points)]
            return both[0] if both and FRAME not in owners else self.holder(point)
        if not side.points:
            return FRAME
        if joint.arm and side is joint.on:
            return next(index for index, body in enumerate(self.bodies) if owner in body.points)
        return self.holder(side.points[0]) if len(side.points) == 1 else self.carrier(side.points[0], side.points[1], owner)

    def sliding_at(self, point: str) -> int:
        """Return the body of its own that slides at a point without turning."""
        return next(index for index, body in enumerate(self.bodies) if body.slides and body.points == (point,))

    @cached_property
    def running(self) -> set[tuple[str, tuple[str, ...]]]:
        """The points that run on guides and slots, the driven ones too, each with its line."""
        return {(joint.point, self.plan.track(joint)) for _, joint in self.plan.joints if joint.track and joint.on.role == "runner"}

    # -- names ---------------------------------------------------------------------------------------------

    @cached_property
    def own_names(self) -> tuple[str, ...]:
        """The names of the bodies and the lone pins, and of the frame, which comes last as its index is -1."""
        return (*(body.name for body in self.bodies), *(f"pin {point}" for point in self.lone), FRAME_NAME)

    def name(self, index: int) -> str:
        """Return a body's name."""
        return self.own_names[index]

    @cached_property
    def names(self) -> dict[str, str]:
        """The names of all bodies by their aliases: their own, their link's, their points; without ambiguous ones."""
        labels = [(body.label, body.name) for body in self.bodies if body.label]
        for each in self.struts:  # a cylinder with points along it goes by its ends and by all its points, too
            if each.host == each.name:
                labels += [(name, each.name) for name in (joined_names(each.P, each.Q), body_name(self.bodies[self.body_of(each)].points))]
        for link, member in self.plan.of_kind(Link).items():  # a driven length goes by its link's name as well
            driven = [each for each in self.struts if each.quantity is not None and {each.P, each.Q} == set(member.point_names)]
            labels += [(link, each.name) for each in driven]
        known = [label for label, _ in labels]
        found = {label: name for label, name in labels if known.count(label) == 1}
        return found | {name: name for name in (FRAME_NAME, *self.own_names)}

    def full_name(self, name: str) -> str:
        """Return a body's name for an alias: its own, its link's, its points, or two or more of them (`O B`); else as given."""
        if not isinstance(name, str):
            raise unknown("Body", name, self.names, where=self.plan.title)
        if name in self.names:
            return self.names[name]
        points = set(name.split())
        found = [body.name for body in self.bodies if len(points) > 1 and points <= set(body.points)]
        return found[0] if len(found) == 1 else name

    def index(self, name: str) -> int:
        """Return a body by its name, its link's or its points; DefinitionError for any other."""
        place = self.own_names.index(self.names[known_name("Body", name, self.names, where=self.plan.title)])
        return place if place < len(self.own_names) - 1 else FRAME


# What a turned joint's angle is measured from: the frame, other bodies' directions, or gears on them.


def own_terms(plan: Plan, drive: Driven) -> list[tuple[float, Quantity]]:
    """Return the terms of a driven quantity with their signs, without those that turn with moving bodies."""
    terms = [*signed_terms(drive.quantity, plan.members)]
    own = [(sign, term) for sign, term in terms if not follows_bodies(plan, drive, term)]
    return [(1.0, drive.quantity)] if drive.along != "c" and len(own) == len(terms) else own


def follows_bodies(plan: Plan, drive: Driven, term: Quantity) -> bool:
    """Return whether a term of what is driven turns with moving bodies, or stands at their places; a length may also be a line's."""
    if drive.along == "c":
        return follows_points(plan, term)
    return any(isinstance(each, (Angle, Coordinate)) and follows_points(plan, each) for _, each in plan.factors(term))


def geared_to(plan: Plan, joint: Joint, owner: str) -> Iterator[tuple[str, Angle, float, tuple[tuple[int, Quantity], ...]]]:
    """Yield the directions of moving bodies that a joint follows: what is driven, the angle, a sign, factors with their powers.

    Raises DefinitionError for one that depends on moving points in another way: its force has no body to act against.
    """
    for drive in joint.drives:
        for sign, term in signed_terms(drive.quantity, plan.members):
            if not drive.along or not follows_bodies(plan, drive, term):
                continue
            factors = list(plan.factors(term))
            angles = [each for power, each in factors if power == 1 and isinstance(each, Angle)]
            others = tuple((power, each) for power, each in factors if each not in angles)
            if len(angles) != 1 or any(follows_points(plan, each) for _, each in others):
                what = "for forces its angle is counted from the frame, from bodies or geared to them, such as angle(A, B) + phi"
                remedy = "or 180 * deg - angle(A, B) / 2"
                if drive.along != "c":
                    what, remedy = "for forces its place follows strokes, or is geared to bodies,", "such as at=0.3 + 0.1 * angle(A, B)"
                raise DefinitionError(f"{plan.title}: {owner} = {plan.members[owner]}: {what} {remedy}; {drive.quantity} is neither.")
            (angle,) = angles
            yield drive.along, angle, sign * drive.sign * angle.axes.sign, others


def angle_ends(angle: Angle) -> tuple[str, str]:
    """Return the names of the two points of an angle."""
    return name_of(angle.P), name_of(angle.Q)


def follows_points(plan: Plan, quantity: Quantity) -> bool:
    """Return whether a quantity depends on moving points, and not on strokes, dimensions and driven lengths alone."""
    factors = [each for _, term in signed_terms(quantity, plan.members) for _, each in plan.factors(term)]
    names = plan.reaches(*(each for each in factors if not is_driven(plan, each)))
    return any(isinstance(plan.members[name], Point) and name in plan.moving for name in names)


def is_driven(plan: Plan, quantity: Quantity) -> bool:
    """Return whether a quantity is the distance of two points whose length a step drives."""
    length = plan.table.lengths.get(frozenset(map(name_of, quantity.parts()))) if isinstance(quantity, Distance) else None
    return length is not None and plan.moves(length)


# What a joint transmits at the poses: the columns of the equations of equilibrium.


@record
class Wrench:
    """A force [N] at a place [m] with a couple [Nm]: shapes (2, n), (2, n), (n,)."""

    at: FloatArray
    force: FloatArray
    couple: FloatArray


@record
class UnitWrench:
    """A unit wrench that acts on one body from another: a column of the equations."""

    contact: Contact
    wrench: Wrench


def wrenches(contact: Contact, poses: FlatPoses, scale: float) -> list[Wrench]:
    """Return the unit wrenches of a contact's unknowns; all unknowns are in N, a couple is `scale` [m] times its own."""
    none = np.zeros((2, poses.count))
    place = acting_place(contact, poses)
    forces = {letter: none if letter == "c" else force_direction(contact, letter, poses) for letter in contact.holds}
    return [Wrench(place, force, none[0] + (scale if letter == "c" else 0.0)) for letter, force in forces.items()]


SAME = 1e-9
"""Places that differ by less than this part of their coordinates are one."""


def acting_place(contact: Contact, poses: FlatPoses) -> FloatArray:
    """Return where a contact's force acts, shape (2, n) [m]; an origin that is the point to rounding is the point, as the motion has it."""
    joint, point = contact.joint, poses.at(contact.point)
    if joint.line is None or contact.is_at_point:
        return point
    with np.errstate(all="ignore"):
        origin = joint.line(poses.motion._placed).origin
    place = poses.stacked(origin.x, origin.y)
    if place.dtype == object:
        return place
    return point if np.all(np.abs(place - point) <= SAME * np.max(np.abs(point), initial=0.0)) else place


def force_direction(contact: Contact, letter: str, poses: FlatPoses) -> FloatArray:
    """Return the direction of one of a contact's forces, x, y, n or t, of length one, shape (2, n)."""
    along = np.stack([np.ones(poses.count), np.zeros(poses.count)])
    if letter not in "xy" and contact.joint.line is not None:
        with np.errstate(all="ignore"):
            way = contact.joint.line(poses.motion._placed).direction
        vector = poses.stacked(way.x, way.y)
        along = np.asarray(vector / np.hypot(vector[0], vector[1]))
    return quarter_turned(along) if letter in "yn" else along
