"""Ropes, chains and belts: a length that is held, or a pull that is given; they pull, and never push."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial, reduce
from itertools import pairwise
from types import MappingProxyType
from typing import ClassVar, Unpack, cast

import numpy as np

from ..errors import DefinitionError, cited, ensure, known_name
from ..language import noted, said
from ..loads import Acting, ActingKeywords, Case, Loads, situation_of, takes_situation
from ..loads.element import Declared, ForceElement, Formulas, Glyph, Load, Parameter, Poses, Reeving, Tie, value_text
from ..loads.rope_path import Pulley, RopePath, Station, pulls, straight_parts, turn_angle
from ..motion import Column, Condition, HasVerdicts, Judge, Motion, Tabled, least, require_motion
from ..plan import Plan, strokes_alone
from ..program import FloatArray
from ..quantities import InnerQuantity, Member, NamedMembers, Number, Quantity, Reference, Variable, is_number, label, name_of, quantity
from ..quantities.member import in_class
from ..steps import Point
from ..units import require_number, show
from ..verdict import Verdict
from .law_requests import LawRequest, request_text
from .poses import AnyMotion, motion_of_whole, plan_of
from .work import closed_force


class Rope(ForceElement, Tabled, HasVerdicts):
    """A rope, chain or belt over points: `chain = Rope(A, B, C, "D", length=2.4)`.

    It only pulls: where its tension would be negative it goes slack, and what it holds is not kept there. Parts between points of one body
    stay as long as they are. Ends lie at points: a rope that winds up on a drum is a winch.

    Parameters
    ----------
    *run : Point, Pulley or str
        What it runs over, from one end to the other: pins or pulleys.
    length : float or quantity, optional
        The length that is held [m]. It gives the distance of its last two points, `CD=chain.last`, or of its first two, `chain.first`, to
        the step that asks for it. A number is the design variable `chain.length`; a Stroke, or what follows one, is a winch.
    weights : sequence of float, optional
        How many falls each straight part has, 1 by default.
    force : float or quantity, optional
        Instead of a length, the force [N] with which it pulls, as a winch of constant pull does.
    stretch : float or quantity, optional
        How much longer it is than the quantity that its length follows [m], 0 by default; a design variable.
    against : Rope or str, optional
        The rope that it works against on one drum.
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
        if weights is not None and not np.iterable(weights):
            raise DefinitionError(f"Rope(weights={cited(weights)}): numbers are expected, one a part, such as weights=[1, 2].")
        self.weights = None if weights is None else tuple(weights)
        wrong = next(self._misgiven(), "")
        ensure(not wrong, f"{wrong}.")
        self.weights = None if self.weights is None else tuple(map(float, self.weights))
        self._check_numbers()

    def _misgiven(self) -> Iterator[str]:
        """Yield its wrong arguments, with the remedy."""
        for each in self.run:
            if not isinstance(each, (str, Point, Pulley)):
                yield f'Rope({cited(each)}): neither a point nor a Pulley; write Rope(A, sheave, "D", length=2.4)'
        count, takes = len(self.run) - 1, self.length is not None or self.force is not None
        if count < 1:
            yield f"Rope: {count + 1} point{'s' * (count < 0)}; it runs from one to another one at least"
        if self.length is not None and self.force is not None:
            yield f"{self}: its length is held or its force is given; leave one out"
        expected = f"{count} numbers above zero are expected, one a part"
        for weight in self.weights or ():
            require_number(f"{self}: weights", weight, expected, above=0.0)
        if self.weights is not None and len(self.weights) != count:
            yield f"{self}: weights={cited(self.weights)}: {expected}"
        if self.against is not None and takes:
            yield f"{self}: it draws back against {label(self.against)}, which gives it its length; leave length= and force= out"

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

    def stations(self, members: NamedMembers) -> tuple[Station, ...]:
        """Return the points it runs over, with the pulleys there; the class's members by name.

        Parameters
        ----------
        members : mapping of str to Member
            The members of the class by name.

        Returns
        -------
        tuple of Station
            The points with their pulleys.
        """
        found = []
        for each in self.run:
            member = in_class(members, each)
            found.append(Station(name_of(member.point), member) if isinstance(member, Pulley) else Station(name_of(each)))
        return tuple(found)

    def examine(self, members: NamedMembers, title: str) -> None:
        known = [name for name, member in members.items() if isinstance(member, (Point, Pulley))]
        for each in self.run:
            known_name("Point or pulley", name_of(each), known, where=f"{title}.{self.name}")
        Member.examine(self, members, title)

    def faults(self, members: NamedMembers) -> Iterator[str]:
        stations, falls = self.stations(members), self.falls
        other = None if self.against is None else members.get(name_of(self.against))
        if self.against is not None and not (isinstance(other, Rope) and other.against is None):
            yield f"{label(self.against)} is no Rope that gives a length; name the one that it draws back against"
        for one, following in pairwise(stations):
            if one.point == following.point:
                yield f"it runs from {one.point} to {one.point}; name two different points"
        for end in (stations[0], stations[-1]):
            if end.pulley is not None:
                remedy = "end it at a point, and let its length follow a Stroke, length=L0 + W"
                yield f"it ends on the pulley {end.pulley.name}, on which it would wind up as on a drum; {remedy}"
        for before, after, place in zip(falls[:-1], falls[1:], stations[1:-1], strict=True):
            if place.pulley is not None and before != after:
                what = f"{before:g} falls come to the pulley {place.pulley.name} and {after:g} leave it"
                yield f"{what}; give both straight parts one weight, or let it run over the pin"

    # -- the length that it gives ----------------------------------------------------------------------------

    @property
    def first(self) -> Quantity:
        """The distance of its first two points [m], as it gives it."""
        return InnerQuantity(self, "first")

    @property
    def last(self) -> Quantity:
        """The distance of its last two points [m], as it gives it."""
        return InnerQuantity(self, "last")

    def link_written(self, pin: str, members: NamedMembers) -> str:
        names = list(map(name_of, self.run))
        for end, (P, Q) in {"last": names[-2:], "first": names[:2]}.items() if self.force is None else ():
            if pin in (P, Q) and not any(isinstance(members.get(one), Pulley) for one in (P, Q)):
                return f'Link("{P} {Q}", {P}{Q}=ref("{self.name}.{end}"))'
        return ""

    def gives(self, members: NamedMembers) -> str:
        """Return the name of the length that it gives; "" where nothing asks for one.

        Parameters
        ----------
        members : mapping of str to Member
            The members of the class by name.

        Returns
        -------
        str
            The name of the length; "" for none.
        """
        return next((f"{self.name}.{end}" for end in self.inside if f"{self.name}.{end}" in members), "")

    def inner(self, name: str, members: NamedMembers) -> Member | None:
        if name not in self.inside:
            return None
        wanted, stations, falls, wrong = f"{self.name}.{name}", self.stations(members), self.falls, ""
        beside, rest = (1, slice(1, None)) if name == "first" else (-2, slice(None, -1))
        pulley = stations[beside].pulley if len(stations) > 2 else None
        if self.force is not None:
            wrong = "its force is given, so that it gives no length; say its length= instead"
        elif self.length is None:
            wrong = f"{wanted} is asked for, and nothing says how long it is; add length=... in m"
        elif self.gives(members):
            wrong = f"one rope gives one length, and {self.gives(members)} and {wanted} are asked for; declare another rope"
        elif pulley is not None:
            remedy = f"let it run over the pin {stations[beside].point} there, or give the other end's length"
            wrong = f"how far it lies on {pulley.name} hangs on where {wanted} ends; {remedy}"
        ensure(not wrong, f"{self.name} = {self}: {wrong}.")
        left = self.written("length")
        left = left + self.written("stretch") if "stretch" in self.numbers else left
        kept = stations[rest]
        if len(kept) > 1:
            radii, senses = tuple(each.radius_written for each in kept), tuple(each.sense for each in kept)
            left = left - RopePath(tuple(each.point for each in kept), radii, senses, falls[rest])
        own = falls[0 if name == "first" else -1]
        return left if own == 1.0 and not isinstance(left, Variable) else left / own

    @property
    def cut(self) -> str:
        """The input that changes its length: itself, or its stretch beyond the quantity it follows."""
        return f"{self.name}.{'length' if isinstance(quantity(self.given('length')), Number) else 'stretch'}"

    def cuts(self, members: NamedMembers) -> tuple[str, ...]:
        return (self.cut,) if self.length is not None and self.gives(members) else ()

    # -- in statics ------------------------------------------------------------------------------------------

    def loads(self, motion: Poses) -> list[Load]:
        return [] if self.force is None else self.pulls(motion, self.number(motion, "force"))

    def pulls(self, motion: Poses, tension: FloatArray | float = 1.0) -> list[Load]:
        """Return the pulls of a tension on every point that it runs over [N].

        Parameters
        ----------
        motion : Motion
            The poses; designs first, strokes last.
        tension : float or ndarray
            The tension [N].

        Returns
        -------
        list of Load
            The pulls [N].
        """
        return [Load(each.point, each.force * tension) for each in pulls(self.stations(motion.plan.members), self.falls, motion)]

    @property
    def scales(self) -> bool:
        return self.force is not None

    def tie(self, members: NamedMembers) -> Tie | None:
        if self.force is not None:
            return None
        gives, pushes = self.gives(members), partial(self.pulls, tension=-1.0)
        if not gives:
            return Tie(self.name, (), held=False, run=Reeving(pushes))
        back, length = self.drawn_back_by(members), quantity(self.given("length"))

        def rate(motion: Poses, stroke: str) -> FloatArray:
            return np.asarray(motion.ratio(length, wrt=stroke))

        run = Reeving(pushes, strokes_alone(length, members), rate)  # strokes that it follows by itself are those of winches
        if back is not None:
            run = replace(run, back=back.name, back_loads=back.back_pushes, back_share=back.share_against)
        return Tie(self.name, (), held=False, cut=self.cut, gives=gives, run=run)

    def drawn_back_by(self, members: NamedMembers) -> Rope | None:
        """Return the rope that pulls where this one would have to push; None where there is none.

        Parameters
        ----------
        members : mapping of str to Member
            The members of the class by name.

        Returns
        -------
        Rope or None
            The other rope.
        """
        ropes = [each for each in members.values() if isinstance(each, Rope) and each.against is not None]
        return next((each for each in ropes if name_of(cast(Reference, each.against)) == self.name), None)

    def share_against(self, motion: Poses) -> FloatArray:
        """Return its pull for each newton that the rope it draws back against would have to push with.

        Parameters
        ----------
        motion : Motion
            The poses; designs first, strokes last.

        Returns
        -------
        ndarray
            The share, shape (...).
        """
        partner = cast(Rope, motion.plan.members[name_of(cast(Reference, self.against))])
        ways = [(load.force * motion.ratio(load.point, wrt=partner.cut)).sum(axis=0) for load in self.pulls(motion)]
        return np.asarray(1.0 / reduce(np.add, ways))[()]

    def back_pushes(self, motion: Poses) -> list[Load]:
        """Return its forces on points for each newton that the rope it draws back against would have to push with.

        Parameters
        ----------
        motion : Motion
            The poses; designs first, strokes last.

        Returns
        -------
        list of Load
            The forces [N].
        """
        return self.pulls(motion, self.share_against(motion))

    @takes_situation
    def tension(self, motion: AnyMotion, loads: Loads = None, **situation: Unpack[ActingKeywords]) -> FloatArray:
        """Return its tension, shape (...) [N]: for a part of several falls that of each; below zero it would have to push.

        `loads` are the machine's own unless others are given. A direction is that of the strokes.

        Parameters
        ----------
        motion : Motion
            The poses; designs first, strokes last.
        loads : sequence of ForceElement or str, optional
            The loads; by default the machine's own.
        case, direction, rates, accelerations, inertia, acting : optional
            The situation, as in `Acting`; `acting` gives all in one.

        Returns
        -------
        ndarray
            The tension [N], shape (...).
        """
        return self.tension_in(motion, situation_of("tension", loads=loads, **situation))

    def tension_in(self, motion: AnyMotion, acting: Acting) -> FloatArray:
        """Return its tension in a situation, shape (...) [N].

        Parameters
        ----------
        motion : Motion
            The poses; designs first, strokes last.
        acting : Acting
            Loads, load case, direction and rates in one.

        Returns
        -------
        ndarray
            The tension [N], shape (...).
        """
        held = motion_of_whole(motion, self)
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
        """Return the tension it would have alone, shape (...) [N]: below zero it would have to push.

        Parameters
        ----------
        motion : Motion
            The poses; designs first, strokes last.
        acting : Acting
            Loads, load case, direction and rates in one.

        Returns
        -------
        ndarray
            The tension [N], shape (...).
        """
        found = closed_force(motion, self, acting)
        if found is None:
            what = f"{self.name} holds nothing: no step follows it"
            raise DefinitionError(f"{plan_of(motion).title}: {what}; let one, CD={self.name}.last, or give its force, force=12 * kN.")
        return np.asarray(-1.0 * found)[()]

    def path(self, motion: Poses) -> FloatArray:
        """Return the length of its path over a motion [m], shape (...), each straight part so often as its weight says.

        Parameters
        ----------
        motion : Motion
            The poses; designs first, strokes last.

        Returns
        -------
        ndarray
            The length [m], shape (...).
        """
        stations = self.stations(motion.plan.members)
        radii, senses = tuple(each.radius_written for each in stations), tuple(each.sense for each in stations)
        return motion.value(RopePath(tuple(each.point for each in stations), radii, senses, self.falls))

    def formulas(self, written: Formulas) -> None:
        if self.force is None and self.gives(written.plan.members):
            written.given(f"T_{self.name}", lambda motion: self.tension_in(require_motion(motion), Acting()), "kN")

    def glyphs(self, members: NamedMembers) -> tuple[Glyph, ...]:
        stations = self.stations(members)

        def radii(motion: Poses) -> list[FloatArray]:
            found = [each.radius(motion) for each in stations]
            return [np.zeros(()) if each is None else each for each in found]

        return (Glyph("rope", tuple(each.point for each in stations), radii=radii),)

    # -- what it shows and says ------------------------------------------------------------------------------

    def columns(self, motion: Motion) -> list[Column]:
        request = tension(self.name)
        return [Column(noted("tension"), request.of(motion), "kN", 3, request)]

    def conditions(self, judge: Judge) -> Mapping[str, Condition]:
        """Return that it stays taut, and on each of its pulleys: that the angle over which it lies there is not below zero.

        Parameters
        ----------
        judge : Judge
            The judge of the machine over its domains.

        Returns
        -------
        mapping of str to Condition
            The conditions by their rules.
        """
        found, stations = dict[str, Condition](), self.stations(judge.plan.members)
        if self.force is None and self.gives(judge.plan.members) and self.drawn_back_by(judge.plan.members) is None:
            found["tension"] = least(tension(self.name)) >= 0.0
        for place, each in enumerate(stations):
            if each.pulley is not None:
                text, known = f"{self.name} on {each.pulley.name}", ("wrap", self.name, each.pulley.name)
                angle = LawRequest(formula=partial(self._wrap, place), text=text, known=known, measures="angle")
                found.setdefault(f"wrap {each.pulley.name}", least(angle) >= 0.0)
        return found

    def _wrap(self, place: int, motion: AnyMotion) -> FloatArray:
        stations = self.stations(motion.plan.members)
        (_, before), (_, after) = straight_parts(stations, motion)[place - 1 : place + 1]
        return np.asarray(turn_angle(before, after, stations[place].sense) + np.zeros(motion.shape))[()]

    def verdicts(self, judge: Judge) -> list[Verdict]:
        """Return whether it stays taut, and on its pulleys.

        Parameters
        ----------
        judge : Judge
            The judge of the machine over its domains.

        Returns
        -------
        list of Verdict
            The verdicts.
        """
        try:
            conditions, found = self.conditions(judge), []
            for rule, answer in zip(conditions, judge.answers(list(conditions.values())), strict=True):
                value, is_lost = float(answer.value), bool(np.isnan(answer.value))
                words = f"{answer}." if is_lost else rope_sentence(rule, value, answer.place)
                found.append(Verdict(rule, answer.ok if is_lost else value >= 0.0, words, answer=answer))
            return found
        except DefinitionError as error:
            return [Verdict.refused("tension", error)]


def rope_sentence(rule: str, value: float, place: str) -> str:
    """Return in words whether a rope stays taut, by its least tension [N], or on a pulley, by the least angle where it lies there [rad]."""
    if rule != "tension":
        if value >= 0.0:
            return said("the rope lies on it over at least {angle}, {place}.", angle=show(value, "deg", 4), place=place)
        return said("it leaves the pulley {place}; move the pulley, or let it turn the other way around it.", place=place)
    if value >= 0.0:
        return said("it stays taut, least {place}: {force}.", force=show(value, "kN", 4), place=place)
    return said(
        "goes slack {place}: it would have to push with {force}; there the constraint is not kept. Hang more weight on it, or take a rod.",
        place=place, force=show(-value, "kN", 4),
    )  # fmt: skip


# What is asked of a rope.


def tension(rope: Rope | str, *, case: Case = None, acting: Acting | None = None) -> LawRequest:
    """Return the request for the tension of a rope [N], in `evaluate`, `answers` and searches; below zero it would have to push.

    Parameters
    ----------
    rope : Rope or str
        The rope, or its name.
    case : LoadCase or str, optional
        A load case, or its name.
    acting : Acting, optional
        Loads, load case, direction and rates in one.

    Returns
    -------
    Request
        The tension [N].
    """
    name = name_of(rope)
    given, text = situation_of("tension", acting, case=case), partial(request_text, "tension", (name,))

    def formula(motion: AnyMotion, acting: Acting) -> FloatArray:
        return rope_in(name, motion.plan).tension_in(motion, acting)

    known, examine = ("tension", name), partial(rope_in, name)
    return LawRequest(formula=formula, text=text, known=known, acting=given, measures="force", examine=examine)


def rope_in(name: str, plan: Plan | Declared) -> Rope:
    """Return the rope of a name; DefinitionError where a plan has no such."""
    found = plan.of_kind(Rope)
    return found[known_name("Rope", name, found, where=plan.title)]
