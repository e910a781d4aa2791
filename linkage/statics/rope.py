"""Ropes, chains and belts: a length that is held, or a pull that is given; they pull, and never push."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial, reduce
from itertools import pairwise
from types import MappingProxyType
from typing import ClassVar, Unpack, cast, final

import numpy as np

from ..errors import DefinitionError, cited, known_name, unknown
from ..language import noted, said
from ..loads import (
    Acting,
    ActingKeywords,
    Case,
    Declared,
    ForceElement,
    Glyph,
    Load,
    Loads,
    Parameter,
    Poses,
    Pulley,
    RopePath,
    Tie,
    situation_of,
    takes_situation,
)
from ..loads.element import Formulas, Reeving, value_text
from ..loads.rope import Station, pulls, stations_of, wraps
from ..motion import Column, Condition, HasVerdicts, Judge, Motion, Question, Tabled, least, require_motion
from ..plan import Plan, strokes_alone
from ..program import FloatArray
from ..quantities import (
    InnerQuantity,
    Member,
    Number,
    Quantity,
    Reference,
    Variable,
    is_number,
    label,
    name_of,
    quantity,
)
from ..steps import Point
from ..units import show
from ..verdict import Verdict
from .law_requests import LawRequest, case_words
from .poses import AnyMotion, plan_of
from .work import closed_force

SLACK = 1e-9
"""A push that is less than this part of the greatest pull is none."""


@final
class Rope(ForceElement, Tabled, HasVerdicts):
    """A rope, chain or belt over points: `chain = Rope(A, B, C, "D", length=2.4)`; at B and C it runs over the pin, or over a Pulley.

    Its `length` [m] is held: it gives the distance of its last two points, `CD=chain.last`, or of its first two, `chain.first`, to the step
    that asks for it. A number is the design variable `chain.length`; a Stroke, or what follows one, is a winch. With a `force` [N] in its
    place that is what it pulls with, as a winch of constant pull does. `weights` say of each straight part how many falls it stands for.

    It only pulls: where its tension would be negative it goes slack, and what it holds is not kept there. Parts between points of one body
    stay as long as they are. Ends lie at points: a rope that winds up on a drum is a winch.
    """

    places: ClassVar[tuple[str, ...]] = ("run",)
    inside: ClassVar[Mapping[str, str]] = MappingProxyType({"first": "quantity", "last": "quantity"})
    parameters: ClassVar[Mapping[str, str]] = MappingProxyType({"length": "mm", "force": "N", "stretch": "mm"})
    not_negative: ClassVar[frozenset[str]] = frozenset({"length", "force"})
    optional: ClassVar[frozenset[str]] = frozenset({"length", "force"})
    argument_kinds: ClassVar[Mapping[str, object]] = MappingProxyType({"run": "run", "weights": "numbers", "against": "load"})
    section: ClassVar[str] = noted("Ropes")
    caption: ClassVar[str] = noted("Ropes and chains, over all that the machine runs")

    def __init__(
        self, *run: Reference, length: Parameter | None = None, weights: Sequence[float] | None = None, force: Parameter | None = None,
        stretch: Parameter = 0.0, against: Reference | None = None,
    ) -> None:  # fmt: skip
        self.run, self.length, self.force, self.stretch, self.against = tuple(run), length, force, stretch, against
        self.weights = None if weights is None else tuple(weights)
        self._check()

    def _check(self) -> None:
        for each in self.run:
            if not isinstance(each, (str, Point, Pulley)):
                raise DefinitionError(f'Rope({cited(each)}): neither a point nor a Pulley; write Rope(A, sheave, "D", length=2.4).')
        if len(self.run) < 2:
            raise DefinitionError(f"Rope: {len(self.run)} point{'s' * (not self.run)}; it runs from one to another one at least.")
        if self.length is not None and self.force is not None:
            raise DefinitionError(f"{self}: its length is held or its force is given; leave one out.")
        if self.weights is not None:
            count = len(self.run) - 1
            if len(self.weights) != count or not all(is_number(each) and each > 0.0 for each in self.weights):
                raise DefinitionError(f"{self}: weights={cited(self.weights)}: {count} numbers above zero are expected, one a part.")
            self.weights = tuple(map(float, self.weights))
        if self.against is not None and (self.length is not None or self.force is not None):
            what = f"{self}: it draws back against {label(self.against)}, which gives it its length"
            raise DefinitionError(f"{what}; leave length= and force= out.")
        self._check_numbers()

    @property
    def numbers(self) -> Mapping[str, str]:
        stretches = self.force is None and not (is_number(self.stretch) and self.stretch == 0.0 and is_number(self.length))
        return {name: unit for name, unit in super().numbers.items() if name != "stretch" or (stretches and self.length is not None)}

    def parts(self) -> tuple[Reference, ...]:
        numbers = (quantity(self.given(name)) for name in self.numbers)
        against = () if self.against is None else (self.against,)
        return (*self.run, *against, *(each for each in numbers if not each.is_constant))

    def __str__(self) -> str:
        more = [] if self.weights is None else [f"weights={list(self.weights)}"]
        shown = {name: value_text(self.given(name)) for name in self.numbers}
        given = [f"{name}={text}" for name, text in shown.items() if name != "stretch" or text != "0.0"]
        more += [] if self.against is None else [f"against={label(self.against)}"]
        return f"Rope({', '.join([*map(label, self.run), *given, *more])})"

    @property
    def falls(self) -> tuple[float, ...]:
        """How many falls each straight part stands for."""
        return (1.0,) * (len(self.run) - 1) if self.weights is None else self.weights

    def stations(self, members: Mapping[str, Member]) -> tuple[Station, ...]:
        """Return the points it runs over, with the pulleys there; the class's members by name."""
        return stations_of(self.run, members)

    def examine(self, members: Mapping[str, Member], title: str) -> None:
        opening = f"{title}: {self.name} = {self}"
        for each in self.run:
            if not isinstance(members.get(name_of(each)), (Point, Pulley)):
                known = [name for name, member in members.items() if isinstance(member, (Point, Pulley))]
                raise unknown("Point or pulley", name_of(each), known, where=f"{title}.{self.name}")
        if self.against is not None:
            found = members.get(name_of(self.against))
            if not isinstance(found, Rope) or found.against is not None:
                what = f"{opening}: {label(self.against)} is no Rope that gives a length"
                raise DefinitionError(f"{what}; name the one that it draws back against.")
        stations, falls = self.stations(members), self.falls
        for one, other in pairwise(stations):
            if one.point == other.point:
                raise DefinitionError(f"{opening}: it runs from {one.point} to {one.point}; name two different points.")
        for end in (stations[0], stations[-1]):
            if end.pulley is not None:
                what = f"{opening}: it ends on the pulley {end.pulley.name}, on which it would wind up as on a drum"
                raise DefinitionError(f"{what}; end it at a point, and let its length follow a Stroke, length=L0 + W.")
        uneven = next((k for k in range(1, len(falls)) if stations[k].pulley is not None and falls[k] != falls[k - 1]), None)
        if uneven is not None:
            pulley = cast(Pulley, stations[uneven].pulley).name
            what = f"{opening}: {falls[uneven - 1]:g} falls come to the pulley {pulley} and {falls[uneven]:g} leave it"
            raise DefinitionError(f"{what}; give both straight parts one weight, or let it run over the pin.")

    # -- the length that it gives ----------------------------------------------------------------------------

    @property
    def first(self) -> Quantity:
        """The distance of its first two points [m], as it gives it."""
        return InnerQuantity(self, "first")

    @property
    def last(self) -> Quantity:
        """The distance of its last two points [m], as it gives it."""
        return InnerQuantity(self, "last")

    def link_written(self, pin: str, members: Mapping[str, Member]) -> str:
        names = list(map(name_of, self.run))
        for end, (P, Q) in {"last": names[-2:], "first": names[:2]}.items() if self.force is None else ():
            if pin in (P, Q) and not any(isinstance(members.get(one), Pulley) for one in (P, Q)):
                return f'Link("{P} {Q}", {P}{Q}=ref("{self.name}.{end}"))'
        return ""

    def gives(self, members: Mapping[str, Member]) -> str:
        """Return the name of the length that it gives; "" where nothing asks for one."""
        return next((f"{self.name}.{end}" for end in self.inside if f"{self.name}.{end}" in members), "")

    def inner(self, name: str, members: Mapping[str, Member]) -> Member | None:
        if name not in self.inside:
            return None
        opening = f"{self.name} = {self}"
        if self.force is not None:
            raise DefinitionError(f"{opening}: its force is given, so that it gives no length; say its length= instead.")
        if self.length is None:
            raise DefinitionError(f"{opening}: {self.name}.{name} is asked for, and nothing says how long it is; add length=... in m.")
        if self.gives(members):
            what = f"{opening}: one rope gives one length, and {self.gives(members)} and {self.name}.{name} are asked for"
            raise DefinitionError(f"{what}; declare another rope.")
        stations, falls = self.stations(members), self.falls
        beside, rest = (1, slice(1, None)) if name == "first" else (-2, slice(None, -1))
        pulley = stations[beside].pulley if len(stations) > 2 else None
        if pulley is not None:
            what = f"{opening}: how far it lies on {pulley.name} hangs on where {self.name}.{name} ends"
            raise DefinitionError(f"{what}; let it run over the pin {stations[beside].point} there, or give the other end's length.")
        left = self.written("length")
        left = left + self.written("stretch") if "stretch" in self.numbers else left
        kept = stations[rest]
        if len(kept) > 1:
            radii, senses = tuple(each.radius_written for each in kept), tuple(each.sense for each in kept)
            left = left - RopePath(tuple(each.point for each in kept), radii, senses, falls[rest])
        own = falls[0 if name == "first" else -1]
        return left if own == 1.0 and not isinstance(left, Variable) else left / own

    @property
    def length_given(self) -> Quantity:
        """Its length as it is given [m]."""
        return quantity(cast("float | Quantity | str", self.length))

    def written(self, name: str) -> Quantity:
        """Return a number of it as a quantity of its class."""
        given = quantity(self.given(name))
        return Variable(f"{self.name}.{name}") if isinstance(given, Number) else given

    @property
    def cut(self) -> str:
        """The input by which its length changes: itself, or how much longer it is than what it follows."""
        return f"{self.name}.{'length' if isinstance(self.length_given, Number) else 'stretch'}"

    def winding(self, members: Mapping[str, Member]) -> tuple[str, ...]:
        """Return the strokes that its length follows by itself, not through points: those of winches."""
        return strokes_alone(self.length_given, members)

    def cuts(self, members: Mapping[str, Member]) -> tuple[str, ...]:
        return (self.cut,) if self.length is not None and self.gives(members) else ()

    # -- in statics ------------------------------------------------------------------------------------------

    def loads(self, motion: Poses) -> list[Load]:
        if self.force is None:
            return []
        tension = self.number(motion, "force")
        return [Load(each.point, each.force * tension) for each in self.pulls(motion)]

    def pulls(self, motion: Poses) -> list[Load]:
        """Return what a tension of one newton pulls with, at every point that it runs over [N]."""
        return pulls(self.stations(motion.plan.members), self.falls, motion)

    @property
    def scales(self) -> bool:
        return self.force is not None

    def tie(self, members: Mapping[str, Member]) -> Tie | None:
        if self.force is not None:
            return None
        gives = self.gives(members)
        if not gives:
            return Tie(self.name, (), held=False, run=Reeving(self._pushes))
        back, strokes = self.drawn_back_by(members), self.winding(members)
        run = Reeving(self._pushes, strokes, self._rate)
        if back is not None:
            run = replace(run, back=back.name, back_loads=back.back_pushes, back_share=back.share_against)
        return Tie(self.name, (), held=False, cut=self.cut, gives=gives, run=run)

    def drawn_back_by(self, members: Mapping[str, Member]) -> Rope | None:
        """Return the rope that pulls where this one would have to push; None where there is none."""
        ropes = [each for each in members.values() if isinstance(each, Rope) and each.against is not None]
        return next((each for each in ropes if name_of(cast(Reference, each.against)) == self.name), None)

    def share_against(self, motion: Poses) -> FloatArray:
        """Return its pull for each newton that the rope it draws back against would have to push with."""
        partner = cast(Rope, motion.plan.members[name_of(cast(Reference, self.against))])
        ways = [(load.force * motion.ratio(load.point, wrt=partner.cut)).sum(axis=0) for load in self.pulls(motion)]
        return np.asarray(1.0 / reduce(np.add, ways))[()]

    def back_pushes(self, motion: Poses) -> list[Load]:
        """Return what it puts on points for each newton that the rope it draws back against would have to push with."""
        share = self.share_against(motion)
        return [Load(each.point, each.force * share) for each in self.pulls(motion)]

    def _pushes(self, motion: Poses) -> list[Load]:
        return [Load(each.point, -1.0 * each.force) for each in self.pulls(motion)]

    def _rate(self, motion: Poses, stroke: str) -> FloatArray:
        """Return how its length follows a stroke."""
        return np.asarray(motion.ratio(self.length_given, wrt=stroke))

    @takes_situation
    def tension(self, motion: AnyMotion, loads: Loads = None, **situation: Unpack[ActingKeywords]) -> FloatArray:
        """Return what it pulls with, shape (...) [N]: of a part of several falls each of them; below zero it would have to push.

        `loads` are the machine's own unless others are given. A direction is that of the strokes.
        """
        return self.tension_in(motion, situation_of("tension", loads=loads, **situation))

    def tension_in(self, motion: AnyMotion, acting: Acting) -> FloatArray:
        """Return its tension in a situation, shape (...) [N]."""
        held = motion._of_the_whole(self) if isinstance(motion, Motion) else None
        if held is not None:
            whole, own = held
            return own.tension_in(whole, acting)
        if self.force is not None:
            return self.number(motion, "force") + np.zeros(motion.shape)
        if self.against is not None:
            partner = rope_in(name_of(self.against), motion.plan)
            return np.asarray(np.maximum(-1.0 * partner.pull_in(motion, acting), 0.0) * self.share_against(motion))[()]
        found = self.pull_in(motion, acting)
        return found if self.drawn_back_by(motion.plan.members) is None else np.maximum(found, 0.0)

    def pull_in(self, motion: AnyMotion, acting: Acting) -> FloatArray:
        """Return what it would pull with alone, shape (...) [N]: below zero it would have to push."""
        found = closed_force(motion, self, acting)
        if found is None:
            what = f"{self.name} holds nothing: no step follows it"
            raise DefinitionError(f"{plan_of(motion).title}: {what}; let one, CD={self.name}.last, or give its force, force=12 * kN.")
        return np.asarray(-1.0 * found)[()]

    def path(self, motion: Poses) -> FloatArray:
        """Return the length of its path over a motion [m], shape (...), each straight part so often as its weight says."""
        stations = self.stations(motion.plan.members)
        radii, senses = tuple(each.radius_written for each in stations), tuple(each.sense for each in stations)
        return motion.value(RopePath(tuple(each.point for each in stations), radii, senses, self.falls))

    def formulas(self, written: Formulas) -> None:
        if self.force is None and self.gives(written.plan.members):
            written.given(f"T_{self.name}", lambda motion: self.tension_in(require_motion(motion), Acting()), "kN")

    def glyphs(self, members: Mapping[str, Member]) -> tuple[Glyph, ...]:
        stations = self.stations(members)

        def radii(motion: Poses) -> list[FloatArray]:
            found = [each.radius(motion) for each in stations]
            return [np.zeros(()) if each is None else each for each in found]

        return (Glyph("rope", tuple(each.point for each in stations), radii=radii),)

    # -- what it shows and says ------------------------------------------------------------------------------

    def columns(self, motion: Motion) -> list[Column]:
        request = tension(self.name)
        return [Column(noted("tension"), request.of(motion), "kN", 3, request)]

    @property
    def is_held(self) -> bool:
        """Whether its length is held, so that its tension follows."""
        return self.force is None

    def questions(self, judge: Judge) -> list[Question]:
        return list(self.conditions(judge).values())

    def conditions(self, judge: Judge) -> Mapping[str, Condition]:
        found: dict[str, Condition] = {}
        if self.is_held and self.gives(judge.plan.members) and self.drawn_back_by(judge.plan.members) is None:
            found["tension"] = least(tension(self.name)) >= 0.0
        pulleys = [each.pulley for each in self.stations(judge.plan.members) if each.pulley is not None]
        return found | {f"wrap {each.name}": least(self.wrap_request(each.name)) >= 0.0 for each in pulleys}

    def wrap_request(self, pulley: str) -> LawRequest:
        """Return the request for the angle over which it lies on a pulley [rad]; below zero it is off it."""
        return LawRequest(
            formula=partial(self._wrap, pulley), text=f"{self.name} on {pulley}", known=("wrap", self.name, pulley), measures="angle"
        )

    def _wrap(self, pulley: str, motion: AnyMotion) -> FloatArray:
        stations = self.stations(motion.plan.members)
        place = next(k for k, each in enumerate(stations) if each.pulley is not None and each.pulley.name == pulley)
        return np.asarray(wraps(stations, motion)[place] + np.zeros(motion.shape))[()]

    def verdicts(self, judge: Judge) -> list[Verdict]:
        """Return whether it stays taut, and on its pulleys."""
        try:
            return list(self._verdicts(judge))
        except DefinitionError as error:
            return [Verdict("tension", False, " ".join(str(error).split()))]

    def _verdicts(self, judge: Judge) -> Iterator[Verdict]:
        conditions = self.conditions(judge)
        for rule, answer in zip(conditions, judge.answers(list(conditions.values())), strict=True):
            if np.isnan(answer.value):
                yield Verdict(rule, answer.ok, f"{answer}.", answer=answer)
            elif rule == "tension":
                yield Verdict(rule, float(answer.value) >= 0.0, slack_sentence(float(answer.value), answer.place), answer=answer)
            else:
                yield Verdict(rule, float(answer.value) >= 0.0, wrap_sentence(float(answer.value), answer.place), answer=answer)


def slack_sentence(value: float, place: str) -> str:
    """Return whether a rope stays taut, in words, by its least tension [N]."""
    if value >= 0.0:
        return said("it stays taut, least {place}: {force}.", force=show(value, "kN", 4), place=place)
    return said(
        "goes slack {place}: it would have to push with {force}; there the constraint is not kept. Hang more weight on it, or take a rod.",
        place=place, force=show(-value, "kN", 4),
    )  # fmt: skip


def wrap_sentence(value: float, place: str) -> str:
    """Return whether a rope stays on a pulley, in words, by the least angle over which it lies there [rad]."""
    if value >= 0.0:
        return said("the rope lies on it over at least {angle}, {place}.", angle=show(value, "deg", 4), place=place)
    return said("it leaves the pulley {place}; move the pulley, or let it turn the other way around it.", place=place)


# What is asked of a rope.


def tension(rope: Rope | str, *, case: Case = None, acting: Acting | None = None) -> LawRequest:
    """Return the request for the tension of a rope [N], in `evaluate`, `answers` and searches; below zero it would have to push."""
    name = name_of(rope)
    given = situation_of("tension", acting, case=case)
    return LawRequest(
        formula=partial(tension_over, name), text=partial(tension_text, name), known=("tension", name), acting=given, measures="force",
        examine=partial(rope_in, name),
    )  # fmt: skip


def tension_text(name: str, acting: Acting) -> str:
    """Return how the request of a tension is written in a situation."""
    return f"tension({', '.join([name, *case_words(acting.case)])})"


def rope_in(name: str, plan: Plan | Declared) -> Rope:
    """Return the rope of a name; DefinitionError where a plan has no such."""
    found = plan.of_kind(Rope)
    known_name("Rope", name, found, where=plan.title)
    return found[name]


def tension_over(name: str, motion: AnyMotion, acting: Acting) -> FloatArray:
    """Return the tension of a rope over a motion's poses [N], shape (...)."""
    return rope_in(name, motion.plan).tension_in(motion, acting)
