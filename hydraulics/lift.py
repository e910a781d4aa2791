"""A pump that lifts by cylinders: its numbers, and its verdicts. Every pressure in this file is gauge [Pa].

What is said is over all that a machine runs, in sentences: lifting, oil and time, holding, going back. One design at a time. Each cylinder
is judged with all drives locked, by its own thrust, in every load case and in each of its own movements, on both of its sides. The judge
looks between the poses, whatever their number.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from types import MappingProxyType
from typing import Any, ClassVar

import numpy as np

from linkage.errors import DefinitionError, ensure, known_name, unknown
from linkage.frozen import immutable
from linkage.language import noted, said, said_of, with_and
from linkage.loads import Acting, Case, ForceElement, Loads, Parameter, case_in_words, situation_of
from linkage.motion import Answer, Judge, Motion, PageWords, Question, Span, below_zero, over_time, reached_spans, require_motion
from linkage.motion.measures import Condition, at, least, most
from linkage.quantities import NamedMembers, Reference, distance, label, of_kind
from linkage.quantities.member import in_class
from linkage.statics import LawRequest, elements_of, is_among, same
from linkage.units import UNITS, litre, show, shown_number
from linkage.verdict import Remark, Verdict

from .cylinders import (
    PISTON,
    ROD,
    SIDES,
    TO_ROUNDING,
    AllOf,
    Feeds,
    OnLines,
    Ram,
    Side,
    at_rest,
    carries_loads,
    judge_of,
    least_and_most,
    line_beside,
    lines_of,
    number_request,
    other_side,
    thrust_request,
    works_by_lines,
)
from .files import pressure_kind
from .inputs import EFFICIENCIES, PUMPED, Array, check_pressures, follows, not_negative, one_design, one_number
from .lifting_line import LiftLine, pushed_back
from .pump import Pump
from .remedy import Sizes, can_be_set, show_enough, size_words, smallest
from .requests import flow, going_back_request, is_free, left_request, pressure_request, reserve_request
from .shut import shut_verdicts

ENDLESS = 1e-4
"""A reserve that is less says that the force grows without bounds."""


class PumpLine(LiftLine):
    """The base of lines that a pump holds, with their questions and verdicts."""

    def lifting_cylinders(self, judge: Judge, unit: str = "bar") -> list[LiftingCylinder]:
        """Return its cylinders over all that a judge looks at."""
        return [LiftingCylinder(judge, self, ram, unit) for ram in self.rams(judge.motion)]

    def questions(self, judge: Judge) -> list[Question]:
        """Return the questions of each of its cylinders: whether it carries anything, lifts, holds; none where no load acts.

        Parameters
        ----------
        judge : Judge
            The judge of the machine over its domains.

        Returns
        -------
        list of Question
            The questions.
        """
        return [question for each in self.lifting_cylinders(judge) for question in each.questions()] if carries_loads(judge) else []

    def conditions(self, judge: Judge) -> Mapping[str, Condition]:
        """Return that each of its cylinders lifts, holds and goes back; none where nothing is lifted.

        Parameters
        ----------
        judge : Judge
            The judge of the machine over its domains.

        Returns
        -------
        mapping of str to Condition
            The conditions by the rules' names.
        """
        cylinders = self.lifting_cylinders(judge) if carries_loads(judge) else []
        if not cylinders or idle(cylinders) is not None:
            return {}
        found = [(rule, each.ram.name, one) for each in cylinders for rule, one in each.conditions().items()]
        return {f"{rule} {name}" if len(cylinders) > 1 else rule: one for rule, name, one in found}

    def page_words(self, judge: Judge) -> Mapping[str, PageWords]:
        found, cylinders = dict[str, PageWords](), self.lifting_cylinders(judge)
        for each in cylinders:
            name, ways = f" {each.ram.name}" if len(cylinders) > 1 else "", each.ways_back
            lacks = noted("the least reserve is {value}, {place}: it needs a higher pressure or a larger size")
            found[f"lifting{name}"] = PageWords(noted("the least reserve is {value}, {place}"), fails={">=": lacks})
            holds = noted("with the pump off it holds up to {value}, {place}: above {limit}; take a larger size")
            found[f"holding{name}"] = PageWords(
                noted("with the pump off it holds up to {value}, {place}: not above {limit}"), fails={"<=": holds}
            )
            if each.ram.side == "both":  # which way the load drives it back hangs on the design
                found[f"lowering{name}"] = PageWords("", is_followed=False)
            elif len(ways) == 1 and judge.answer(most(each.back(ways[0])) <= 0.0).ok:
                alone = least(going_back_request(each.ram.name, Acting(), self.name, ways[0], tells="load"))
                found[f"lowering{name}"] = PageWords(noted("the load makes at least {value} in the working side, {place}"), alone)
            else:
                found[f"lowering{name}"] = PageWords("")
        return found

    def load_limits(self, judge: Judge) -> Mapping[str, Condition]:
        return {}

    def verdicts(self, judge: Judge) -> list[Verdict]:
        """Return the verdicts on lifting, oil, holding and lowering."""
        try:
            return [*line_verdicts(self, judge, unit=self.unit_in(judge)), *shut_verdicts(self, judge)]
        except DefinitionError as error:
            return [Verdict.refused("lifting", error)]


@immutable
class LiftCircuit(PumpLine):
    """A pump on a cylinder: `circuit = LiftCircuit(lift, pressure=180 * bar, flow=60 * litre / minute, mechanical_efficiency=0.9)`.

    In a class its numbers are design variables such as `circuit.pressure`.

    Parameters
    ----------
    cylinder : Cylinder, str or sequence of them
        The cylinders on the line. Several, `LiftCircuit([lift, aux], ...)`, share one pressure and carry thrust by area.
    pressure : float, quantity or Pump
        The pump's highest pressure [Pa gauge], against which is lifted. A `Pump` may feed other lines too: then it is on both sides of the
        cylinder and says all numbers but `relief` and `back_pressure`.
    flow : float or quantity, optional
        The pump's flow [m3/s], 0 where it does not matter.
    mechanical_efficiency, hydraulic_efficiency : float or quantity, optional
        The cylinder's and the line's efficiencies, 1 by default.
    back_pressure : float or quantity, optional
        The pressure of the returning oil on the other side [Pa gauge], 0 by default.
    relief : float or quantity, optional
        The relief valve's pressure [Pa gauge], against which is held; by default the pump's.
    """

    cylinder: Feeds
    pressure: Any
    flow: Parameter = 0.0
    mechanical_efficiency: Parameter = 1.0
    hydraulic_efficiency: Parameter = 1.0
    back_pressure: Parameter = 0.0
    relief: Parameter | None = None
    parameters: ClassVar[Mapping[str, str]] = MappingProxyType({**PUMPED, "back_pressure": "bar", "relief": "bar"})
    limited: ClassVar[Mapping[str, str]] = EFFICIENCIES
    not_negative: ClassVar[frozenset[str]] = frozenset({"pressure", "flow", "back_pressure", "relief"})
    optional: ClassVar[frozenset[str]] = frozenset({"relief"})
    argument_kinds: ClassVar[Mapping[str, object]] = MappingProxyType({"cylinder": "loads", "pressure": partial(pressure_kind, Pump)})

    def __post_init__(self) -> None:
        super().__post_init__()
        check_pressures(self, "circuit")

    def examine(self, members: NamedMembers, title: str) -> None:
        ensure(self.references, f"{title}.{self.name}: the circuit has no cylinder; name one, LiftCircuit(lift, pressure=...).")
        super().examine(members, title)
        own = self.members(members)
        for place, ram in enumerate(own):
            if is_among(ram, own[:place]):
                what = f"{self.name} has {ram.name or ram} twice, so that its oil would count double"
                raise DefinitionError(f"{title}: {what}; name it once, or write count=2 in the Cylinder where there are two.")
        for other in (each for each in of_kind(members, LiftCircuit).values() if each is not self):
            rams = other.members(members)
            shared = [ram for ram in own if is_among(ram, rams)]
            if shared and not len(shared) == len(own) == len(rams):
                both = with_and(ram.name or str(ram) for ram in shared)
                what = f"{self.name} and {other.name} both have {both}, but not the same cylinders"
                says = "what shares a chamber is one line with one pressure"
                raise DefinitionError(f"{title}: {what}; {says}. Name all of them in one LiftCircuit, or none in both.")

    @property
    def numbers(self) -> Mapping[str, str]:
        found = super().numbers
        return {name: found[name] for name in found if name not in Pump.parameters} if isinstance(self.pressure, Pump) else found

    def pump(self, members: NamedMembers) -> Pump | None:
        found = in_class(members, self.pressure) if isinstance(self.pressure, (str, Pump)) else None
        return found if isinstance(found, Pump) else None

    def has_both_sides(self, members: NamedMembers) -> bool:
        return self.pump(members) is not None

    def among(self, members: NamedMembers) -> LiftCircuit:
        """Return it with the pump that it is on, where a name says that; DefinitionError for numbers of its own beside one.

        Parameters
        ----------
        members : mapping of str to Member
            The members of the class by name.

        Returns
        -------
        LiftCircuit
            The circuit.

        Raises
        ------
        DefinitionError
            Numbers of its own beside a pump.
        """
        pump = self.pump(members)
        for name, usual in (("flow", 0.0), ("mechanical_efficiency", 1.0), ("hydraulic_efficiency", 1.0)):
            given = self.given(name)
            if pump is not None and (follows(given) or np.any(np.asarray(given) != usual)):
                raise DefinitionError(f"{self.name} = {self}: {pump.name or 'its pump'} says its {name}; leave {name}= out there.")
        return self if pump is None or pump is self.pressure else self.renewed(pressure=pump)

    def parts(self) -> tuple[Reference, ...]:
        return (*super().parts(), *((self.pressure,) if isinstance(self.pressure, Pump) else ()))

    def __str__(self) -> str:
        on = [label(self.pressure)] if isinstance(self.pressure, Pump) else []
        return f"LiftCircuit({', '.join([self.cylinder_names, *on, *self.words()])})"

    def says(self, name: str, members: NamedMembers) -> tuple[ForceElement, str] | None:
        pump = self.pump(members)
        if pump is not None and name in Pump.parameters:
            return pump, name
        return None if self.given(name) is None else (self, name)

    def oil(self, motion: Motion) -> Array:
        """Return how much oil goes through the line over a motion, one value for each design.

        Parameters
        ----------
        motion : Motion
            The poses.

        Returns
        -------
        array
            The volume [m3].
        """
        return self.taken(motion)


# What is said of a lift.


def lift_verdicts(
    circuit: PumpLine | str, motion: Motion, loads: Loads = None, *, case: Case = None, acting: Acting | None = None,
    resistance: float = 0.0, unit: str = "bar",
) -> list[Verdict]:  # fmt: skip
    """Return the verdicts on lifting (with the remedy), oil and time, holding, and going back against a `resistance` [Pa].

    `loads` are the machine's own unless others are given, in all load cases unless one is named; `unit` is that of the pressures in the
    sentences. Of several strokes, `at(S1=..., S2=...)` with arrays of one axis, it is judged along the path, of a grid over the box.

    Parameters
    ----------
    circuit : PumpLine or str
        The circuit, or its name.
    motion : Motion
        The poses; designs first, strokes last.
    loads : sequence of ForceElement or str, optional
        The loads; by default the machine's own.
    case : LoadCase or str, optional
        A load case, or its name.
    acting : Acting, optional
        Loads, load case, direction and rates in one.
    resistance : float
        The pressure of the returning oil [Pa].
    unit : str
        The unit of the pressures in the sentences.

    Returns
    -------
    list of Verdict
        The verdicts.
    """
    given = situation_of("lift_verdicts", acting, loads=loads, case=case)
    require_motion(motion)
    circuits = motion.plan.of_kind(PumpLine)
    line = circuits.get(circuit) if isinstance(circuit, str) else circuit
    if not isinstance(line, PumpLine):
        raise unknown("LiftCircuit", str(circuit), circuits, where=motion.plan.title)
    not_negative(one_number(resistance, "Return resistance", "pressure"), "Return resistance")
    known_name("Unit", unit, UNITS, where="lift_verdicts(unit=...)")
    unreached = f"{motion.plan.title}: no pose of this motion can be assembled, so that there is nothing to judge."
    return line_verdicts(line, judge_of(motion, "A lift", given, unreached=unreached), resistance, unit)


def line_verdicts(circuit: PumpLine, judge: Judge, resistance: float = 0.0, unit: str = "bar") -> list[Verdict]:
    """Return the verdicts on a circuit and each of its cylinders."""
    cylinders = circuit.lifting_cylinders(judge, unit)
    unplaced = [each.ram.unplaced for each in cylinders if not each.ram.is_placed(judge)]
    if unplaced:
        return [Verdict("lifting", False, " ".join(unplaced))]
    nothing = idle(cylinders)
    if nothing is not None:
        return [nothing, oil_verdict(circuit, judge)]
    several = len(cylinders) > 1
    return [
        *(with_name(each.lifting(), each.ram, several) for each in cylinders),
        oil_verdict(circuit, judge),
        *relief_remark(circuit, judge, unit),
        *(with_name(each.holding(), each.ram, several) for each in cylinders),
        *(with_name(each.going_back(resistance), each.ram, several) for each in cylinders if each.lowers_alone),
    ]


def relief_remark(circuit: PumpLine, judge: Judge, unit: str) -> list[Verdict]:
    """Return the remark that a relief valve opens before the pump gives its pressure, where that is so."""
    supply, pump = one_design(circuit.supply(judge.motion)), one_design(circuit.number(judge.motion, "pressure"))
    by = {"line": circuit.name, "relief": show(supply, unit, 4), "pump": show(pump, unit, 4)}
    text = said("The relief valve of {line} opens at {relief}, below the pump's {pump}: it lifts with no more than {relief}.", **by)
    return [Remark(text)] if supply < pump else []


def with_name(verdict: Verdict, ram: Ram, several: bool) -> Verdict:
    """Return a verdict that names its cylinder, where there are several."""
    return verdict.named(ram.name or str(ram)) if several else verdict


def idle(cylinders: Sequence[LiftingCylinder]) -> Verdict | None:
    """Return the verdict on a lift that has nothing to carry; None where it has."""
    first = cylinders[0]
    plan, members = first.judge.plan, first.judge.plan.members
    elements = elements_of(plan, first.judge.acting.loads)
    feeding = [(name, one.feeds(members)) for name, one in elements]
    fed = [(name, each.ram) for each in cylinders for name, rams in feeding if is_among(each.ram, rams)]
    if fed:
        (line, ram), *_ = fed
        text = said(
            "{ram} is fed by {line} and carries the gas's force, whatever the load: there is nothing that the pump lifts. "
            "Judge what the drive must do, driving_force(motion), or leave {line} out of the loads.",
            ram=ram.name or ram, line=line,
        )  # fmt: skip
        return Verdict("lifting", False, text)
    if any(answer.value != 0.0 for each in cylinders for answer in each.judge.answers(each.thrusts)):
        return None
    acting = [name for name, each in elements if not each.holds and not each.joined(members)]
    if not acting:
        return Verdict("lifting", None, said("there is nothing to lift: no load is declared, such as Weight(G, mass=...)."))
    text = said_of(
        len(acting),
        "there is nothing to lift: {loads} asks nothing of it; is a mass zero?",
        "there is nothing to lift: the loads {loads} ask nothing of it; is a mass zero?",
        loads=", ".join(acting),
    )
    return Verdict("lifting", None, text)


class LiftingCylinder:
    """One cylinder of a circuit over all that a judge looks at."""

    def __init__(self, judge: Judge, circuit: LiftLine, ram: Ram, unit: str = "bar") -> None:
        self.judge, self.circuit, self.ram, self.unit = judge, circuit, ram, unit

    @property
    def thrusts(self) -> list[Question]:
        """Its least and its greatest thrust, as questions."""
        return least_and_most(thrust_request(self.ram, Acting()))

    def back(self, way: str, resistance: float = 0.0, tells: str = "push") -> LawRequest:
        """Return the pressure from the other side while it goes back one way, or the pressure of the load alone."""
        return going_back_request(*self.request_arguments, way, resistance, tells)

    @property
    def request_arguments(self) -> tuple[Ram, Acting, LiftLine]:
        """The first arguments of its requests."""
        return self.ram, Acting(), self.circuit

    def questions(self) -> list[Question]:
        """Return the first questions of its verdicts."""
        ways = ("retracting", "extending") if self.ram.side == "both" else self.ram.ways_back(0.0, 0.0)
        going = [question for way in ways for question in (most(self.back(way)), least(self.back(way, tells="load")))]
        going += [most(self.back(way, tells="whole push")) for way in ways] if len(ways) > 1 else []
        return [*self.thrusts, least(reserve_request(*self.request_arguments)), *self.standing, *going]

    @property
    def standing(self) -> list[Question]:
        """The greatest pressures of its sides at rest, as questions."""
        return [most(pressure_request(self.ram, at_rest(self.judge), self.circuit, side)) for side in self.sides]

    @property
    def sides(self) -> Sequence[Side]:
        """The sides that hold a load in some load case, the one that works first: not one that another line keeps at its own pressure."""
        order = self.ram.own_sides if self.ram.side != "rod" else SIDES[::-1]
        plan, order = self.judge.plan, order[:1] if self.goes_back_by_another or self.ram.only_pushes else order
        return [side for side in order if any(is_free(self.ram, side, self.circuit, plan, case) for case in self.judge.cases)]

    def left(self, cylinder: str | Ram, circuit: str | LiftLine) -> Condition | None:
        """Return that the side that works holds the load where another line keeps the other one at its own pressure; None for none."""
        behind = other_side(self.ram)
        none = behind is None or all(is_free(self.ram, behind, self.circuit, self.judge.plan, case) for case in self.judge.cases)
        return None if none else least(left_request(cylinder, at_rest(self.judge), circuit, behind)) >= 0.0

    def conditions(self) -> dict[str, Condition]:
        """Return its conditions: it lifts, holds on both sides, and goes back."""
        asked, name = (self.ram.name, Acting(), self.circuit.name), self.circuit.name
        laws = self.circuit.relief_pressure, self.circuit.supply
        held, supply = (at(number_request(self.circuit, f" {each.__name__}", each)) for each in laws)
        back = [most(going_back_request(*asked, way)) for way in self.ways_back]
        sinks = AllOf(tuple(each <= supply if self.ram.side == "both" else each <= 0.0 for each in back))
        holding = most(pressure_request(self.ram.name, at_rest(self.judge), self.circuit.name)) <= held
        pressed = self.ram.pressed(self.ram.name, self.judge) if self.ram.only_pushes else self.left(self.ram.name, name)
        return {
            "lifting": least(reserve_request(*asked)) >= 1.0,
            "holding": holding if pressed is None else AllOf((holding, pressed)),
            **({"lowering": sinks.each[0] if len(back) == 1 else sinks} if self.lowers_alone else {}),
        }

    @property
    def goes_back_by_another(self) -> bool:
        """Whether another held line has the other side of one of its line's, so that its pump drives them back, as is judged there."""
        members = self.judge.plan.members
        beside = (line for ram in self.circuit.members(members) for line, _ in lines_of(ram, members, "held"))
        return any(not same(line, self.circuit) for line in beside)

    @property
    def lowers_alone(self) -> bool:
        """Whether it goes back by the load, on which there is a verdict here: by no valve, no other pump, no cylinder of both sides."""
        valved = any(each.holds_line(self.circuit) for each in self.judge.plan.of_kind(OnLines).values())
        pumped = self.ram.side == "both" and self.circuit.has_both_sides(self.judge.plan.members)
        pumped |= self.ram.side != "both" and self.circuit.goes_both_ways(self.ram, self.judge.plan)
        return not valved and not pumped and not self.goes_back_by_another

    def show(self, pressure: Array | float, missed: float | None = None) -> str:
        """Return a pressure in the unit of the sentences, with more digits where it would read as a limit that is `missed`."""
        return show(float(pressure), self.unit, 4, missed)

    # -- lifting -------------------------------------------------------------------------------------------

    def lifting(self) -> Verdict:
        """Return whether the pump lifts wherever it runs; where not, the pressure needed and the standard bore that would do."""
        question, pump = least(reserve_request(*self.request_arguments)) >= 1.0, self.show(self.circuit.supply(self.judge.motion))
        found = self.judge.answer(question)
        if np.isnan(found.value) and found.ok is None:
            text = said("the load drives all the way: it is not limited by this cylinder{remedy}.", remedy=self.remedy_both())
            return Verdict("lifting", None, text, answer=found)
        if np.isnan(found.value):
            text = said("the load drives, or else {lost}: keep away from these.", lost=found.lost.sentence)
            return Verdict("lifting", False, text, answer=found)
        if found.value < ENDLESS:
            text = said(
                "at {pump} the force needed grows without bounds {where}: no cylinder lifts there; keep away from that pose.",
                pump=pump, where=found.place,
            )  # fmt: skip
            return Verdict("lifting", False, text, answer=found)
        free, driven = "", list[object]()
        if found.unlimited and self.ram.side != "both":
            driven += self.parts(found, lambda reserve: np.where(np.isnan(reserve), -1.0, 1.0)) or [said("in places")]
        if self.ram.side != "both":
            words = (case_in_words(each, found.titles) for each in self.judge.unlimited_cases(question))
            driven += [said("all the way {case}", case=each) for each in words]
        if driven:
            by = {"where": with_and(driven), "remedy": self.remedy_both()}
            free = said("; the load drives {where}, there it is not limited by this cylinder{remedy}", **by)
        least_text = shown_number(float(found.value), "", ".3f", None if found.ok else 1.0)
        says = said("at {pump} the least reserve is {least}, {where}", pump=pump, least=least_text, where=found.place)
        if found.ok:
            return Verdict("lifting", True, f"{says}{free}.", answer=found)
        short = self.parts(found, lambda reserve: np.nan_to_num(reserve, nan=2.0) - 1.0)
        weak = said("; too weak {where}", where=with_and(short)) if short else ""
        return Verdict("lifting", False, f"{says}{weak}{free}. {self.remedy(found)}", answer=found)

    def parts(self, found: Answer, of_reserve: Callable[[Array], Array]) -> tuple[Span, ...]:
        """Return the parts of the one way, where there is one, on which a function of the reserve is below zero, in the worst situation."""
        way, acting = self.judge.along, self.judge.situation(found)
        if way is None:
            return ()
        reserve = reserve_request(self.ram, acting, self.circuit, is_judged=True)
        return below_zero(way, lambda at: of_reserve(reserve.of(at)))

    def remedy_both(self) -> str:
        """Return the remedy where the thrust changes its sign and one side alone is declared."""
        members, behind = self.judge.plan.members, other_side(self.ram)
        if behind is None or self.ram.is_single_acting or self.goes_back_by_another:
            return ""
        if works_by_lines(self.ram, members) is None:
            return said('; works="both" judges the other side as well')
        is_taken = line_beside(self.ram, behind, self.circuit, members) is not None
        return "" if is_taken else said("; an OilLine with a pump on {ram}.{side}_side judges it as well", ram=self.ram.name, side=behind)

    def remedy(self, worst: Answer) -> str:
        """Return the remedy for a reserve below 1: a pressure, or a standard bore with its reserve."""
        found = self.judge.answer(most(pressure_request(*self.request_arguments, is_needed=True)))
        if found.unbounded or not np.isfinite(found.value):
            return said("No pressure and no bore lifts there; keep away from that pose.")
        pressure = float(found.value)
        if not np.isnan(worst.time):  # its reserve counts as it begins to move, too, where the pressure is the one at rest
            place = self.judge.there(worst)
            work = self.circuit.work_of_all(self.ram, place, self.judge.situation(worst))
            pressure = float(np.squeeze(self.circuit.driving_pressure(work, place)))
        needed = show_enough(pressure, self.unit)
        if self.circuit.relieves(self.judge.plan) and pressure > float(self.circuit.relief_pressure(self.judge.motion)):
            needed = said("{pressure}, at its relief valve as well", pressure=needed)
        if len(self.circuit.rams(self.judge.motion)) > 1:
            return said("It needs {needed}, or larger bores on this line.", needed=needed)
        if self.ram.is_single_acting:
            return said("It needs {needed}, or larger stages.", needed=needed)
        counts = said("; both sides are on one line, so that the rod counts and not the bore") if self.ram.side == "regenerative" else ""
        larger = self.ram.larger(self.judge.motion)
        if larger and not can_be_set(self.judge, self.ram, larger[0]):
            return said("It needs {needed}, or a larger size{counts}.", needed=needed, counts=counts)
        found_with = self.mended(
            larger, float(worst.value), lambda ram: [least(reserve_request(ram, Acting(), self.circuit)) >= 1.0], worst
        )
        if found_with is None:
            rod = said("It needs {needed}; no standard rod is thick enough{counts}.", needed=needed, counts=counts)
            return rod if counts else said("It needs {needed}; no standard bore is large enough.", needed=needed)
        sizes, (gained,) = found_with
        return said(
            "It needs {needed}, or {size}, with a reserve of {gained:.2f}{counts}.",
            needed=needed, size=size_words(sizes), gained=gained.value, counts=counts,
        )  # fmt: skip

    def mended(
        self, larger: Sequence[Sizes], reserve: float, questions: Callable[[Ram], Sequence[Question]], worst: Answer
    ) -> tuple[Sizes, list[Answer]] | None:
        """Return the first of some larger sizes that keeps conditions, with the answers; the search begins at the missing area."""
        now = self.ram.sized(self.judge.motion)
        areas = [one_design(replace(now, **sizes).area) for sizes in larger]  # type: ignore[type-var]
        wanted = one_design(now.area) / reserve
        start = next((place for place, area in enumerate(areas) if area >= wanted * (1.0 - 1e-9)), len(areas))
        return smallest(self.judge, self.ram, larger, start, questions, worst)

    # -- holding and going back ----------------------------------------------------------------------------

    def holding(self) -> Verdict:
        """Return the pressures that the load makes with the pump off, and whether they stay below the relief valve's."""
        circuit, limit = self.circuit, float(self.circuit.relief_pressure(self.judge.motion))
        pulled = self.ram.pulled(self.judge)
        if pulled is not None:
            return pulled
        order, asked = self.sides, [each <= limit for each in self.standing]
        found = self.judge.answers(asked)
        left = self.left(self.ram, circuit)
        loose = None if left is None else self.ram.pressed_wrongly(self.judge, left)
        endless = next((each for each in (*found, loose) if each is not None and each.unbounded), None)
        if endless is not None:
            text = said("the pressure grows without bounds {where}: nothing holds there; keep away from that pose.", where=endless.place)
            return Verdict("holding", False, text, answer=endless)
        if loose is not None:
            acts, other = said("pulls at it"), said("let the load press on it")
            if self.ram.side == ROD:
                acts, other = said("presses on it"), said("let the load pull at it")
            by = {"force": show(-loose.value, "kN", 4), "where": loose.place, "acts": acts, "other": other}
            by["remedy"] = f"{other[:1].upper()}{other[1:]}."
            beside = line_beside(self.ram, other_side(self.ram), circuit, self.judge.plan.members)
            if beside is not None and beside.kind_in(self.judge.plan.members) != "closed":
                place, sizes = self.judge.there(loose), self.ram.sized(self.judge.motion)
                area = sizes.pull_area if other_side(self.ram) != PISTON else sizes.push_area
                stands = beside.line_pressure(place, self.judge.situation(loose)) - loose.value / area
                by["held"] = show_enough(float(np.squeeze(stands)), self.unit)
                by["remedy"] = said("Let a load case shut this line and that side's, which then has to bear {held}, or {other}.", **by)
            text = said("the load {acts} with up to {force} more than its other side gives, {where}: no oil holds it there. {remedy}", **by)
            return Verdict("holding", False, text, answer=loose)
        words = [said("piston side") if side == PISTON else said("rod side") for side in order]
        words[1:] = [f"{words[-1]}{'' if self.ram.side == 'both' else said(' where the load drives')}"] if words[1:] else []
        pressures = [self.show(each.value, None if each.ok else limit) for each in found]
        parts = [
            said("the {side} holds up to {pressure}, {where}", side=side, pressure=pressure, where=each.place)
            for each, side, pressure in zip(found, words, pressures, strict=True)
            if each.value > TO_ROUNDING * limit
        ]
        worst = max(found, key=lambda each: each.value)
        if not parts:
            none = said("the {side} holds no pressure", side=words[0]) if len(order) == 1 else said("neither side holds pressure")
            return Verdict("holding", True, said("with the pump off, {stands}.", stands=none), answer=worst)
        stands = ", ".join(parts)
        given, pump = self.show(limit), not circuit.relieves(self.judge.plan)
        valve = said("the relief valve's {limit}", limit=given)
        valve = said("the pump's {limit}, since no relief valve is on this line", limit=given) if pump else valve
        if all(each.ok for each in found):
            text = said("with the pump off, {stands}: not above {valve}.", stands=stands, valve=valve)
            return Verdict("holding", True, text, answer=worst)
        remedy = self.holds_with(asked, worst)
        text = said("with the pump off, {stands}: above {valve}; {remedy}.", stands=stands, valve=valve, remedy=remedy)
        return Verdict("holding", False, text, answer=worst)

    def holds_with(self, asked: Sequence[Condition], worst: Answer) -> str:
        """Return the remedy for holding, in words: a larger size, for a single cylinder on a line with the pressure that it then holds."""
        if self.ram.is_single_acting:
            return said("take larger stages")
        larger, limit = self.ram.larger(self.judge.motion), float(self.circuit.relief_pressure(self.judge.motion))
        alone = len(self.circuit.rams(self.judge.motion)) == 1
        found = self.mended(larger, limit / float(worst.value), lambda ram: asked, worst) if alone else None
        size = said("take a thicker rod") if self.ram.side == "regenerative" else said("take a larger bore")
        if found is None:
            return said("no standard size is large enough, keep away from that pose") if alone else size
        sizes, answers = found
        holds = max(answers, key=lambda each: float(each.value))
        return said("{remedy}: with {size} it is up to {pressure}", remedy=size, size=size_words(sizes), pressure=self.show(holds.value))

    def going_back(self, resistance: float = 0.0) -> Verdict:
        """Return whether it goes back by itself against the resistance of the returning oil; if not, the pressure on the other side.

        It goes back against its working direction. One that works with both sides goes the way the load drives it, and both ways where
        that changes its sense. The verdict is on the worse. Where the load then drives it on, as a lever past its top, the pump's pressure
        on the other side has to do it.
        """
        judge, against = self.judge, said("against {pressure} in the return line", pressure=self.show(resistance))
        each_way = [(way, judge.answers([most(self.back(way, resistance)) <= 0.0])[0]) for way in self.ways_back]
        way, push = max(each_way, key=lambda each: (each[1].unbounded, float(np.nan_to_num(each[1].value, nan=-np.inf))))
        alone, nothing = judge.answer(least(self.back(way, resistance, "load"))), TO_ROUNDING * float(self.circuit.supply(judge.motion))
        if push.ok is None or np.isnan(push.value):
            return Verdict("lowering", None, said("it goes back nowhere over what it runs."))
        if push.ok or push.value <= nothing:
            by = {"against": against, "where": alone.place, "pressure": self.show(alone.value)}
            text = said("it sinks by itself {against}: the load makes at least {pressure} in the working side, {where}.", **by)
            if alone.value <= nothing:
                text = said("nothing holds it back {against}; {where} the load presses on neither side and nothing drives it.", **by)
            return Verdict("lowering", True, text, answer=replace(push, ok=True))
        where, enough = self.stuck(self.back(way, resistance), judge.situation(push)), False
        is_pushed = bool(pushed_back(self.ram, self.circuit, judge.plan.members))
        if is_pushed and not push.unbounded:
            (push,) = judge.answers([most(self.back(way, resistance, "whole push")) <= 0.0])
        by = {"where": where, "against": against, "place": push.place, "pose": push.place}
        by["push"], by["much"] = show_enough(float(push.value), self.unit), self.show(push.value)
        if push.unbounded:
            text = said("it does not sink by itself {where} {against}, and no push moves it {pose}: keep away from that pose.", **by)
        elif self.ram.only_pushes:
            text = said("it does not sink by itself {where} {against}: it lacks up to {much}, {place}, and no oil pushes it in.", **by)
        elif not is_pushed:
            text = said("it does not sink by itself {where} {against}: it lacks up to {much}, {place}; no pump is on its other side.", **by)
        else:
            text = said("it does not sink by itself {where} {against}: the other side must push with up to {push}, {place}.", **by)
            supply = float(self.circuit.supply(judge.motion))
            enough = push.value <= supply * (1.0 + 1e-9)
            if self.ram.side == "both":
                by["direction"] = said("extending") if way == "extending" else said("retracting")
                text = said(
                    "{direction}, the load does not drive it back {where} {against}: the other side must push with up to {push}, {place}.",
                    **by,
                )
            by["pump"], is_both = self.show(supply), self.ram.side == "both"
            if works_by_lines(self.ram, judge.plan.members) is None and not (is_both and enough):
                remedy = said('The pump gives {pump}: works="both" lets it push.', **by)
                text = f"{text} {remedy if enough else said('The pump gives {pump} only.', **by)}"
            enough = enough and is_both
        return Verdict("lowering", enough, text, answer=push)

    @property
    def ways_back(self) -> tuple[str, ...]:
        """The directions in which it goes back: of one that works with both sides by the pressures that hold it over all that it runs."""
        held = [each.value for each in self.judge.answers(self.standing)] if self.ram.side == "both" else [0.0, 0.0]
        return self.ram.ways_back(-held[-1], held[0])

    def stuck(self, back: LawRequest, worst: Acting) -> str:
        """Return where it does not go back, in words: along one way in the worst situation, anywhere if in every one."""
        way, stuck = self.judge.along, list[Span]()
        if way is not None:
            whole, stuck = reached_spans(way), [*self.judge.parts_below(-replace(back, acting=replace(worst, direction=None)))]
            if [*map(str, stuck)] == [*map(str, whole)]:
                stuck = []
        if stuck:
            return with_and(stuck)
        return said("anywhere") if self.judge.answer(least(back)).value > 0.0 else said("in places")


def oil_verdict(circuit: LiftLine, judge: Judge) -> Verdict:
    """Return how much oil the machine takes over all that it runs, and how long the pump's flow needs for it."""
    rams = circuit.rams(judge.motion)
    answers = [judge.answers(least_and_most(distance(ram.A, ram.B))) for ram in rams]
    ends = [[np.asarray(each.value) for each in pair] for pair in answers]
    if np.isnan(ends).any():
        return Verdict("oil", None, said("nothing is left to judge: every place is unlimited, left out or lost"))
    oil = sum(one_design(ram.taken(judge.motion, *own)) for ram, own in zip(rams, ends, strict=True))
    gas = circuit.has_gas(judge.plan.members)
    if circuit.fills_others(judge.motion):
        low, high = judge.answers(least_and_most(number_request(circuit, " volume", circuit.volume, measures="volume")))
        oil = float(high.value - low.value)
    both = [(ram, high - low) for ram, (low, high) in zip(rams, ends, strict=True) if ram.side == "both"]
    back = sum(float(way) * one_design(ram.sized(judge.motion).pull_area) for ram, way in both)
    out, inwards = (show(each, "l", ".2f" if each > 0.1 * litre else 3) for each in (oil, back))
    says = said("{oil} from end to end outwards, {back} inwards", oil=out, back=inwards) if back else said("{oil} from end to end", oil=out)
    if overs := dict.fromkeys(str(each.over) for pair in answers for each in pair if each.over):
        says = f"{says} {said('over {over}', over=with_and(overs))}"
    rate = one_design(circuit.number(judge.motion, "flow"))
    if not rate > 0.0:
        return Verdict("oil", True, said("{says}; time follows from the pump's flow, which is not given.", says=says))
    time, given = show(oil / rate, "s", ".1f"), show(rate, "l/min", 4)
    asked = over_time(judge, most(flow(circuit.name)) <= rate) if judge.plan.members.get(circuit.name) is circuit and not gas else None
    if asked is None or asked.ok is not False:
        return Verdict("oil", True, said("{says}, {time} at {flow}.", says=says, time=time, flow=given))
    text = said(
        "the cylinders take {asked}, {where}; the pump gives {flow}. Run slower there, or take a larger pump.",
        asked=show(asked.value, "l/min", 4, rate), where=asked.place, flow=given,
    )  # fmt: skip
    return Verdict("oil", False, text, answer=asked)
