"""The locked mechanism as bodies and joints: what the equations of equilibrium are written for."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..errors import DefinitionError, known_name, unknown
from ..loads import ForceElement, Load
from ..plan import Plan
from ..program import FloatArray
from ..quantities import Angle, Joint, JointSide, Negative, Quantity, Ref, Sum, name_of
from ..steps import Guide, Link, Point
from .acting import Pushing
from .bodies import FRAME, FRAME_NAME, Strut, blocks, frame_points, parts, refuse_driven
from .holding import Holding, holding_of
from .poses import Poses, left

# Where bodies touch, and what each joint can transmit: the columns of the equations of equilibrium.

@dataclass(frozen=True, eq=False)
class Contact:
    """A joint between two bodies: its force acts on the body `on` from the body `by` (indices, -1 the frame), at a point.

    `holds` are the letters of what it transmits: x, y, n across its line, t along it, c a couple. `owner` is the member that
    declares it, `joint` what that says; `track` the points or the guide of the line it slides on.
    """

    kind: str
    point: str
    on: int
    by: int
    holds: str = "xy"
    owner: str = ""
    joint: Joint | None = None
    track: tuple[str, ...] = ()

    @property
    def columns(self) -> int:
        """How many unknowns it brings."""
        return len(self.holds)

    @property
    def presses(self) -> int:
        """How many of its unknowns make its friction: both components of a pin, the normal one of a guide."""
        return 2 if self.kind == "pin" else 1

    @property
    def has_force(self) -> bool:
        """Whether it transmits a force; a crank's drive has only a couple."""
        return self.holds != "c"

    @property
    def slides(self) -> bool:
        """Whether its point slides along its line."""
        return bool(self.track)

    def goes_by(self, name: str) -> bool:
        """Return whether it is meant by the name of a guide, a step or a point of its line."""
        given = self.joint.track if self.joint is not None else ()
        return name in (self.owner, *self.track, *given)


@dataclass(frozen=True)
class Wrench:
    """A force [N] at a place [m] with a couple [Nm]: shapes (2, n), (2, n), (n,)."""

    at: FloatArray
    force: FloatArray
    couple: FloatArray


def wrenches(contact: Contact, poses: Poses, scale: float) -> list[Wrench]:
    """Return the unit wrenches of a contact's unknowns; all unknowns are in N, a couple is `scale` [m] times its own."""
    right, none = rightwards(poses), np.zeros((2, poses.count))
    forces = {"x": right, "y": left(right), "c": none}
    if set("nt") & set(contact.holds):
        t = direction(contact, poses)
        forces |= {"t": t, "n": left(t)}
    place = poses.at(contact.point)
    return [Wrench(place, forces[each], none[0] + (scale if each == "c" else 0.0)) for each in contact.holds]


def rightwards(poses: Poses) -> FloatArray:
    """Return the direction of the x axis, shape (2, n)."""
    return np.stack([np.ones(poses.count), np.zeros(poses.count)])


def direction(contact: Contact, poses: Poses) -> FloatArray:
    """Return the direction of a contact's line, of length one, shape (2, n)."""
    if contact.joint is None or contact.joint.line is None:
        return rightwards(poses)
    with np.errstate(all="ignore"):
        along = contact.joint.line(poses.reading).direction
    vector = poses.pair(along.x, along.y)
    return np.asarray(vector / np.hypot(vector[0], vector[1]))


# What a crank's angle is measured from: the frame, or another body's direction.

def terms(plan: Plan, quantity: Quantity, sign: float = 1.0) -> Iterator[tuple[float, Quantity]]:
    """Yield the terms of a sum with their signs, names resolved."""
    if isinstance(quantity, Ref):
        member = plan.members[quantity.target]
        assert isinstance(member, Quantity)
        yield from terms(plan, member, sign)
    elif isinstance(quantity, Sum):
        yield from terms(plan, quantity.a, sign)
        yield from terms(plan, quantity.b, sign)
    elif isinstance(quantity, Negative):
        yield from terms(plan, quantity.a, -sign)
    else:
        yield sign, quantity


def follows_points(plan: Plan, quantity: Quantity) -> bool:
    """Return whether a quantity depends on moving points, and not on strokes and dimensions alone."""
    return any(isinstance(plan.members[name], Point) and name in plan.moving for name in plan.reaches(quantity))


def measured_from(plan: Plan, joint: Joint, owner: str) -> tuple[str, str] | None:
    """Return the two points whose direction a turned joint's angle is counted from; None where that is the frame.

    Raises DefinitionError for an angle that depends on moving points in another way: its torque has no one body to act against.
    """
    for drive in joint.drives:
        moving = [(sign, term) for sign, term in terms(plan, drive.quantity) if follows_points(plan, term)]
        if not moving:
            continue
        (sign, term), *others = moving
        if others or sign < 0.0 or not isinstance(term, Angle):
            raise DefinitionError(
                f"{plan.title}: {owner} = {plan.members[owner]}: for forces its angle is counted from the frame or from one body, "
                f"such as angle(A, B) + phi; {drive.quantity} is neither."
            )
        return name_of(term.P), name_of(term.Q)
    return None


def drives_of(plan: Plan, angle: Quantity) -> list[tuple[float, Quantity]]:
    """Return the terms of an angle that are not another body's direction, with their signs."""
    return [(sign, term) for sign, term in terms(plan, angle) if not follows_points(plan, term)]


class Structure:
    """Bodies, lone pins and contacts of a plan. An index -1 is the frame; lone pins come after the bodies."""

    def __init__(self, plan: Plan, elements: Iterable[ForceElement] = (), pushing: Sequence[Pushing] = ()) -> None:
        self.plan = plan
        self.fixed = frame_points(plan)
        elements = tuple(elements)
        self.holding: Holding = holding_of(plan, elements)
        bodies, self.struts = parts(plan, self.holding, pushing)
        sliding = dict.fromkeys((joint.point, plan.track(joint)) for _, joint in plan.joints if joint.kind == "guide")
        self.blocks = blocks(plan, elements, bodies, (point for point, _ in sliding))
        self.parts = (*self.blocks, *bodies)
        tracked = [joint.point for _, joint in plan.joints if joint.track and joint.on.role == "runner"]
        self.lone = tuple(dict.fromkeys(point for point in tracked if not self.owners(point)))
        self.contacts = (*self.pins(), *self.joints())

    # -- who owns what -------------------------------------------------------------------------------------

    def owners(self, point: str) -> list[int]:
        """Return the bodies of a point, the frame first."""
        frame = [FRAME] if point in self.fixed else []
        return frame + [index for index, part in enumerate(self.parts) if point in part.points]

    def holder(self, point: str) -> int:
        """Return the body that carries the pin at a point; DefinitionError where nothing holds it."""
        found = self.owners(point)
        if found:
            return found[0]
        if point in self.lone:
            return len(self.parts) + self.lone.index(point)
        raise DefinitionError(f"{self.plan.title}: {point} belongs to no body; for forces declare its link, such as Link({point}, ...).")

    def carrier(self, P: str, Q: str, what: str) -> int:
        """Return the body that holds two points."""
        common = [index for index in self.owners(P) if index in self.owners(Q)]
        if not common:
            raise DefinitionError(f"{self.plan.title}: {what}: {P} and {Q} do not belong to one body; for forces declare Link({P}, {Q}).")
        return common[0]

    def bearer(self, load: Load) -> int:
        """Return the body that a load acts on."""
        if load.point not in self.plan.points:
            raise unknown("Point", load.point, self.plan.points, where=self.plan.title)
        if len(load.on) == 1:
            return self.index(load.on[0])
        return self.carrier(load.on[0], load.on[1], "a load") if load.on else self.holder(load.point)

    def body_of(self, strut: Strut) -> int:
        """Return the body that a two-point member is, or is part of."""
        name = strut.host or strut.name
        return next(index for index, part in enumerate(self.parts) if part.name == name and {strut.P, strut.Q} <= set(part.points))

    def name(self, index: int) -> str:
        """Return a body's name."""
        if index == FRAME:
            return FRAME_NAME
        return self.parts[index].name if index < len(self.parts) else f"pin {self.lone[index - len(self.parts)]}"

    @cached_property
    def names(self) -> dict[str, str]:
        """The names of all bodies by what they go by: their own, their link's, their points; not what several go by."""
        found: dict[str, str] = {}
        labels = [(part.label, part.name) for part in self.parts if part.label]
        for link, member in self.plan.of_kind(Link).items():  # a driven length goes by its link's name as well
            driven = [each for each in self.struts if each.quantity is not None and {each.P, each.Q} == set(member.point_names)]
            labels += [(link, each.name) for each in driven]
        for label, name in labels:
            if [each for each, _ in labels].count(label) == 1:
                found[label] = name
        return found | {self.name(index): self.name(index) for index in range(FRAME, len(self.parts) + len(self.lone))}

    @property
    def bodies(self) -> tuple[str, ...]:
        """The names of the frame and of all bodies."""
        return tuple(self.name(body) for body in range(FRAME, len(self.parts)))

    def called(self, name: str) -> str:
        """Return a body's name for what it goes by: its own, its link's, its points, or two or more of them (`O B`); else as given."""
        if not isinstance(name, str):
            raise unknown("Body", name, self.names, where=self.plan.title)
        if name in self.names:
            return self.names[name]
        points = set(name.split())
        found = [part.name for part in self.parts if len(points) > 1 and points <= set(part.points)]
        return found[0] if len(found) == 1 else name

    def index(self, name: str) -> int:
        """Return a body by its name, its link's or its points; DefinitionError for any other."""
        known_name("Body", name, self.names, where=self.plan.title)
        indices = {self.name(index): index for index in range(FRAME, len(self.parts) + len(self.lone))}
        return indices[self.names[name]]

    # -- contacts ------------------------------------------------------------------------------------------

    def pins(self) -> Iterator[Contact]:
        """Yield the pins: of k bodies at a point, k - 1 turn on the first."""
        for point in self.plan.points:
            first, *others = self.owners(point) or [FRAME]
            yield from (Contact("pin", point, other, first) for other in others)

    def joints(self) -> Iterator[Contact]:
        """Yield what the steps, guides and slides hold: equal slides once, of drives that a cylinder replaces what is left."""
        seen: set[tuple[str, tuple[str, ...]]] = set()
        for name, joint in sorted(self.plan.joints, key=lambda each: ORDER.get(each[1].kind, len(ORDER))):
            track = self.plan.track(joint)
            holds, kind = self.left(joint), joint.kind
            if joint.on.role == "slider" and joint.on.points[0] in self.fixed:
                continue
            if track and kind in ("guide", "driven"):
                if (joint.point, track) in seen:
                    continue
                seen.add((joint.point, track))
            if not holds:
                continue
            refuse_driven(self.plan, joint.still)
            on, by = self.side(joint.on, joint, name), self.side(joint.by, joint, name)
            if kind == "driven" and "t" not in holds:
                kind = "guide"
            if kind == "guide" and 0 <= on < len(self.blocks):
                kind, holds = "slider", holds + "c"
            if kind == "crank" and (base := measured_from(self.plan, joint, name)) is not None:
                by = self.carrier(*base, name)
            yield Contact(kind, joint.point, on, by, holds, name, joint, track)

    def left(self, joint: Joint) -> str:
        """Return what a joint still holds when cylinders have taken over strokes."""
        gone = [letter for letter in joint.holds if (strokes := self.strokes_of(joint, letter)) and strokes <= self.holding.taken]
        return "".join(letter for letter in joint.holds if letter not in gone)

    def strokes_of(self, joint: Joint, letter: str) -> set[str]:
        """Return the strokes that drive a joint along one of its letters."""
        reached = [self.plan.reaches(drive.quantity.name or drive.quantity) for drive in joint.drives if drive.along == letter]
        return set[str]().union(*reached) & set(self.plan.strokes)

    def side(self, side: JointSide, joint: Joint, owner: str) -> int:
        """Return the body that one side of a joint names."""
        if side.role == "guide":
            return self.guide_carrier(self.plan.of_kind(Guide)[side.points[0]])
        if side.role == "slider":
            return self.slider(side.points[0])
        if side.role == "runner":
            return self.runner(side.points[0], self.plan.track(joint))
        if not side.points:
            return FRAME
        if joint.arm and side is joint.on:
            return next(index for index, part in enumerate(self.parts) if owner in part.points)
        return self.holder(side.points[0]) if len(side.points) == 1 else self.carrier(side.points[0], side.points[1], owner)

    @cached_property
    def running(self) -> set[tuple[str, tuple[str, ...]]]:
        """The points that run on guides and slots, the driven ones too, each with its line."""
        return {(joint.point, self.plan.track(joint)) for _, joint in self.plan.joints if joint.track and joint.on.role == "runner"}

    def runner(self, point: str, line: tuple[str, ...]) -> int:
        """Return the body that a guide or slot holds at a point: one that runs on it with two points, else the carrier of the pin."""
        others = {other for other, its in self.running if its == line} - {point}
        owners = self.owners(point)
        both = [index for index in owners if index != FRAME and others & set(self.parts[index].points)]
        return both[0] if both and FRAME not in owners else self.holder(point)

    def guide_carrier(self, guide: Guide) -> int:
        """Return the body that a guide belongs to."""
        if guide.angle is not None:
            refuse_driven(self.plan, ((guide.angle, f"{guide.name} = {guide}: its angle"),))
        if len(guide.points) == 2:
            return self.carrier(guide.points[0], guide.points[1], f"{guide.name} = {guide}")
        moving = [point for point in guide.points if point not in self.fixed]
        return self.slider(moving[0]) if moving else FRAME

    def slider(self, point: str) -> int:
        """Return the body at a point that moves without turning."""
        return next(index for index, part in enumerate(self.parts) if part.points == (point,) and part.slides)

    # -- drives --------------------------------------------------------------------------------------------

    def driven(self, contact: Contact) -> Iterator[tuple[Quantity, str, float]]:
        """Yield what a contact drives: the quantity, the letter of the force that is conjugate to it, and its sign."""
        joint = contact.joint
        for drive in joint.drives if joint is not None else ():
            if drive.along in contact.holds and drive.along:
                terms = drives_of(self.plan, drive.quantity) if drive.along == "c" and contact.kind == "crank" else [(1.0, drive.quantity)]
                yield from ((term, drive.along, drive.sign * sign) for sign, term in terms)


#: The order in which joints are listed, after the pins.
ORDER = {kind: place for place, kind in enumerate(("guide", "slider", "slot", "driven", "crank", "telescope", "upright"))}


# What one joint transmits, and between which bodies.

@dataclass(frozen=True, eq=False)
class JointForce:
    """What one joint transmits: the force on the body `on` from the body `by`, shape (2, ...) [N], with a couple (...) [Nm].

    `kind` is a pin, a guide, a slot, a driven point, a crank's drive, a slider or a telescope. `axis` are the two points that give
    the body's own x axis; for the frame it is None.
    """

    point: str
    on: str
    by: str
    kind: str
    force: FloatArray
    couple: FloatArray
    axis: tuple[str, str] | None = None

    @property
    def size(self) -> FloatArray:
        """The size of the force, shape (...) [N]."""
        return np.asarray(np.hypot(self.force[0], self.force[1]))

    @property
    def has_force(self) -> bool:
        """Whether it transmits a force; a crank's drive has only a couple."""
        return self.kind not in ("crank", "upright")

    def __str__(self) -> str:
        return f"{self.point} ({self.kind}) on {self.on} from {self.by}"
