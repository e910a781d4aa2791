"""The locked mechanism as bodies and joints: what the equations of equilibrium are written for."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import cached_property

from ..errors import DefinitionError, unknown
from ..loads import ForceElement, Load
from ..plan import Plan
from ..quantities import Quantity, name_of
from ..steps import Crank, Guide, OnGuide, OnLink, PinSlotDyad, Slide, YokeDyad
from .bodies import FRAME, FRAME_NAME, blocks, frame_points, parts, upright
from .contacts import Contact
from .coordinates import replaced
from .turns import measured_from


class Structure:
    """Bodies, lone pins and contacts of a plan. An index -1 is the frame; lone pins come after the bodies."""

    def __init__(self, plan: Plan, elements: Iterable[ForceElement] = ()) -> None:
        self.plan = plan
        self.fixed = frame_points(plan)
        elements = tuple(elements)
        bodies, self.rams = parts(plan, elements)
        self.blocks = blocks(plan, elements, bodies, (point for point, _ in self.slides()))
        self.parts = (*self.blocks, *bodies)
        self.coordinates = replaced(plan, sum(ram.quantity is None for ram in self.rams))
        slid = [point for point, _ in self.slides()] + list(plan.of_kind(OnGuide))
        self.lone = tuple(dict.fromkeys(point for point in slid if not self.owners(point)))
        self.contacts = (*self.pins(), *self.guides(), *self.yokes(), *self.driven(), *self.cranks(), *self.telescopes(), *self.uprights())

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
        return self.carrier(load.on[0], load.on[1], "a load") if len(load.on) > 1 else self.holder(load.point)

    def name(self, index: int) -> str:
        """Return a body's name."""
        if index == FRAME:
            return FRAME_NAME
        return self.parts[index].name if index < len(self.parts) else f"pin {self.lone[index - len(self.parts)]}"

    def index(self, name: str) -> int:
        """Return a body by its name or its link's; DefinitionError for any other."""
        names = {part.label: index for index, part in enumerate(self.parts) if part.label}
        names |= {self.name(index): index for index in range(FRAME, len(self.parts) + len(self.lone))}
        if name not in names:
            raise unknown("Body", name, names, where=self.plan.title)
        return names[name]

    # -- contacts ------------------------------------------------------------------------------------------

    def pins(self) -> Iterator[Contact]:
        """Yield the pins: of k bodies at a point, k - 1 turn on the first."""
        for point in self.plan.points:
            first, *others = self.owners(point) or [FRAME]
            yield from (Contact("pin", point, other, first) for other in others)

    def slides(self) -> dict[tuple[str, tuple[str, ...]], str]:
        """Return the points that run on guides and slots: (point, the line's points or the guide's name) with what declares it."""
        found: dict[tuple[str, tuple[str, ...]], str] = {}
        pairs = [pair for name, step in self.plan.points.items() if name not in self.apart for pair in step.slides()]
        pairs += [(name_of(slide.point), name_of(slide.guide)) for slide in self.plan.of_kind(Slide).values()]
        for point, name in pairs:
            found.setdefault((point, self.line_of(name)), name)
        for name, step in self.plan.of_kind(PinSlotDyad).items():
            self.refuse_driven(step.offset, f"{step.sentence()}: its offset")
            for pin, P, X in step.pin_slots():
                found.setdefault((pin, tuple(sorted((P, X)))), name)
        return found

    @cached_property
    def running(self) -> set[tuple[str, tuple[str, ...]]]:
        """The points that run on guides and slots, the driven ones too, each with its line."""
        driven = {(name, self.line_of(name_of(step.guide))) for name, step in self.plan.of_kind(OnGuide).items()}
        return driven | set(self.slides())

    def line_of(self, name: str) -> tuple[str, ...]:
        """Return a guide's two points, or its name."""
        guide = self.plan.members[name]
        assert isinstance(guide, Guide)
        return tuple(sorted(guide.points)) if guide.Q is not None else (name,)

    @cached_property
    def apart(self) -> set[str]:
        """The points whose guides are not plain slides."""
        return {*self.plan.of_kind(OnGuide), *self.plan.of_kind(YokeDyad)}

    def guides(self) -> Iterator[Contact]:
        """Yield the plain slides: a normal force on the point from the body that carries the guide; on a block also a couple."""
        for (point, line), name in self.slides().items():
            guide, on = self.plan.members[name], self.runner(point, line)
            kind = "slider" if 0 <= on < len(self.blocks) else "guide"
            if isinstance(guide, PinSlotDyad):
                yield Contact(kind, point, on, self.carrier(guide.P, guide.X, name), (guide.P, guide.X), name)
            elif isinstance(guide, Guide):
                yield Contact(kind, point, on, self.guide_carrier(guide), guide.points if len(line) == 2 else line, name)

    def runner(self, point: str, line: tuple[str, ...]) -> int:
        """Return the body that a guide or slot holds at a point: one that runs on it with two points, else the carrier of the pin."""
        others = {other for other, its in self.running if its == line} - {point}
        owners = self.owners(point)
        both = [index for index in owners if index != FRAME and others & set(self.parts[index].points)]
        return both[0] if both and FRAME not in owners else self.holder(point)

    def guide_carrier(self, guide: Guide) -> int:
        """Return the body that a guide belongs to."""
        if guide.angle is not None:
            self.refuse_driven(guide.angle, f"{guide.name} = {guide}: its angle")
        if len(guide.points) == 2:
            return self.carrier(guide.points[0], guide.points[1], f"{guide.name} = {guide}")
        moving = [point for point in guide.points if point not in self.fixed]
        return self.slider(moving[0]) if moving else FRAME

    def slider(self, point: str) -> int:
        """Return the body at a point that moves without turning."""
        return next(index for index, part in enumerate(self.parts) if part.points == (point,) and part.slides)

    def yokes(self) -> Iterator[Contact]:
        """Yield the joints of sliders with a cross slot: guided without turning, and the pin in the slot."""
        for name, step in self.plan.of_kind(YokeDyad).items():
            self.refuse_driven(step.angle, f"{step.sentence()}: its angle")
            slider = self.slider(name)
            guide = self.plan.members[step.guide]
            assert isinstance(guide, Guide)
            yield Contact("slider", name, slider, self.guide_carrier(guide), (step.guide,), name)
            yield Contact("slot", step.P, slider, self.holder(step.P), (), name)

    def driven(self) -> Iterator[Contact]:
        """Yield the points that are driven along a guide."""
        for name, step in self.plan.of_kind(OnGuide).items():
            guide = self.plan.members[name_of(step.guide)]
            assert isinstance(guide, Guide)
            on = self.runner(name, self.line_of(guide.name))
            yield Contact("guide" if name in self.coordinates else "driven", name, on, self.guide_carrier(guide), (guide.name,), name)

    def cranks(self) -> Iterator[Contact]:
        """Yield the drives that turn a link against the frame."""
        for name, step in self.plan.of_kind(Crank).items():
            if name in self.coordinates:
                continue
            base = measured_from(self.plan, step)
            by = self.carrier(*base, step.sentence()) if base else FRAME
            yield Contact("crank", step.P, self.carrier(step.P, name, step.sentence()), by, (), name)

    def uprights(self) -> Iterator[Contact]:
        """Yield what keeps the carriers of guides through moving points from turning."""
        for point in upright(self.plan, self.fixed):
            yield Contact("upright", point, self.slider(point), FRAME)

    def telescopes(self) -> Iterator[Contact]:
        """Yield the driven arms of bodies: they hold each other along, across and against turning."""
        for name in self.plan.telescopes:
            step = self.plan.members[name]
            assert isinstance(step, OnLink)
            arm = next(index for index, part in enumerate(self.parts) if name in part.points)
            yield Contact("telescope", step.P, arm, self.carrier(step.P, step.Q, step.sentence()), (), name)

    def refuse_driven(self, quantity: Quantity, what: str) -> None:
        """Raise DefinitionError for a drive whose force is not provided."""
        if self.plan.moves(quantity):
            provided = "forces are provided for driven lengths, cranks, OnGuide and OnLink"
            raise DefinitionError(f"{self.plan.title}: {what} follows a stroke; {provided}.")
