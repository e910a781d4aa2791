"""The locked mechanism as bodies and joints: what the equations of equilibrium are written for."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from functools import cached_property

from ..errors import DefinitionError, known_name, unknown
from ..loads import ForceElement, Load
from ..plan import Plan
from ..quantities import Joint, JointSide, Quantity
from ..steps import Guide, Link
from .bodies import FRAME, FRAME_NAME, Strut, blocks, frame_points, parts, refuse_driven
from .contacts import Contact
from .holding import Holding, holding_of
from .loaded import Pushing
from .turns import drives_of, measured_from


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
