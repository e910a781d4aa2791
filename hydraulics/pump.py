"""Pumps, relief valves and tanks on oil lines, beside chambers. Every pressure is gauge [Pa].

A pump may be on several lines. Then it is shared, and what they ask of it over a path in time is checked, `supply.check(motion)`, or
followed as it is, `supply.run(machine, demands=...)`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Any, ClassVar, Literal, cast

import numpy as np

from linkage import Mechanism, Remark, Verdict
from linkage.errors import DefinitionError, ensure, known_name, one_word, require_type
from linkage.frozen import immutable
from linkage.language import noted, said
from linkage.loads import Acting, Parameter
from linkage.motion import HasVerdicts, Judge, Motion, from_above, require_motion
from linkage.quantities import NamedMembers, Reference, is_member_or_name, name_of, needs, of_kind

from .consumers import in_plan, lines_on
from .cycle import SLOW, PumpCycle, cycles_over, is_shared, judged_cycles, pump_verdicts
from .cylinders import OnLines, Ram, circuits_among
from .inputs import EFFICIENCIES, PUMPED, check_pressures, follows
from .sharing import SHARINGS
from .working import Demand, PumpMotion, worked


class Supply(OnLines, HasVerdicts):
    """The base of supplies on an oil line: a pressure, gauge [Pa], and further numbers of a pump."""

    parameters: ClassVar[Mapping[str, str]] = MappingProxyType({"pressure": "bar"})
    not_negative: ClassVar[frozenset[str]] = frozenset({"pressure"})
    called: ClassVar[str]
    """What it is called in words."""

    def __post_init__(self) -> None:
        super().__post_init__()
        check_pressures(self, self.called, () if isinstance(self, Tank) else ("pressure",))

    def verdicts(self, judge: Judge) -> list[Verdict]:
        """Return the remark that no line has it, where that is so.

        Parameters
        ----------
        judge : Judge
            The judge of the machine over its domains.

        Returns
        -------
        list of Verdict
            The verdicts.
        """
        members = judge.plan.members
        if any(self.name in needs(line) for line in circuits_among(members)):
            return []
        says = {"name": self.name, "ram": next(iter(of_kind(members, Ram)), "lift")}
        return [Remark(said("{name} is on no line and does nothing; put it on one: OilLine({ram}.piston_side, {name}).", **says))]


@immutable
class Pump(Supply):
    """A pump: `supply = Pump(180 * bar, flow=60 * litre / minute)`; it holds a line, whose pressure follows the pose.

    It may be on several lines, `OilLine(ram.piston_side, supply)`, `LiftCircuit(ram, supply)`, which then share it. It gives the highest
    pressure that one of them needs. In a class its numbers are design variables such as `supply.pressure`.

    Parameters
    ----------
    pressure : float or quantity
        Its highest pressure [Pa gauge].
    flow : float or quantity, optional
        Its flow [m3/s], 0 where it does not matter.
    mechanical_efficiency, hydraulic_efficiency : float or quantity, optional
        The cylinders' and the lines' efficiencies, 1 by default.
    power : float or quantity, optional
        The most power that it has [W]; unlimited by default.
    margin : float or quantity, optional
        How much more pressure it gives than is needed [Pa], 0 by default.
    sharing : {"by demand", "least pressure first"}, optional
        Who gets oil where the flow is not enough. "by demand", the default, gives each the same part of what it asks for; else those that
        need least get all first.
    first : Member, str or sequence of them, optional
        Lines, circuits or cylinders that are served before the others.

    Raises
    ------
    DefinitionError
        A number is negative, a word is not known, or what is `first` is not on this pump.
    """

    pressure: Parameter
    flow: Parameter = 0.0
    mechanical_efficiency: Parameter = 1.0
    hydraulic_efficiency: Parameter = 1.0
    power: Parameter | None = None
    margin: Parameter = 0.0
    sharing: Literal["by demand", "least pressure first"] = "by demand"
    first: Reference | Sequence[Reference] = ()
    parameters: ClassVar[Mapping[str, str]] = MappingProxyType({**PUMPED, "power": "kW", "margin": "bar"})
    limited: ClassVar[Mapping[str, str]] = EFFICIENCIES
    not_negative: ClassVar[frozenset[str]] = frozenset({"pressure", "flow", "power", "margin"})
    optional: ClassVar[frozenset[str]] = frozenset({"power"})
    argument_kinds: ClassVar[Mapping[str, object]] = MappingProxyType({"first": "loads"})
    called: ClassVar[str] = "pump"
    headed: ClassVar[str] = noted("Pump {name}")

    def __post_init__(self) -> None:
        if is_member_or_name(self.first):
            object.__setattr__(self, "first", (self.first,))
        require_type("Pump: first", self.first, (list, tuple), 'names of lines or cylinders are expected, first=["lift"]')
        super().__post_init__()
        one_word("sharing", self.sharing, SHARINGS)

    @property
    def numbers(self) -> Mapping[str, str]:
        plain = not follows(self.margin) and not np.any(np.asarray(self.margin))
        return {name: unit for name, unit in super().numbers.items() if not (name == "margin" and plain)}

    def examine(self, members: NamedMembers, title: str) -> None:
        lines = lines_on(self, members)
        known = [*(each.name for each in lines), *(ram.name for line in lines for ram in line.members(members))]
        for each in map(name_of, cast(Sequence[Reference], self.first)):
            known_name("Line or cylinder on this pump", each, known, where=f"{title}.{self.name}, first")
        super().examine(members, title)

    def verdicts(self, judge: Judge) -> list[Verdict]:
        """Return whether it meets the demands of its lines over the paths in time, where it has several lines; and that it has none.

        Parameters
        ----------
        judge : Judge
            The judge of the machine over its domains.

        Returns
        -------
        list of Verdict
            The verdicts.
        """
        return [*super().verdicts(judge), *pump_verdicts(self, judge)]

    def sections(self, judge: Judge) -> list[Any]:
        """Return the section of a report on the demands of its lines over the paths in time, and on its energy.

        Parameters
        ----------
        judge : Judge
            The judge of the machine over its domains.

        Returns
        -------
        list of Section
            The sections.
        """
        try:
            found = judged_cycles(self, judge) if is_shared(self, judge) else []
        except DefinitionError:  # the verdict says why
            return []
        named = [("; ".join(filter(None, (place.over.name, each.case))) if len(found) > 1 else "", each) for place, each in found]
        return [from_above("hydraulics.cycle_chart:cycle_section")(named)] if found else []

    # -- in time -------------------------------------------------------------------------------------------

    def check(self, motion: Motion, *, acting: Acting | None = None) -> PumpCycle:
        """Return the demands of a motion in time on this pump, and whether it meets them.

        Parameters
        ----------
        motion : Motion
            A motion over a path in time, of one design, `machine.sweep(over="cycle")`.
        acting : Acting, optional
            Loads and load case. Without a case all that occur over the path are looked at, and the worst one counts.

        Returns
        -------
        PumpCycle
            Flow, pressure and power over time, litres, energy, and the verdict.

        Raises
        ------
        DefinitionError
            The motion has no time, no line is on the pump, or it says no flow.
        """
        motion = require_motion(motion)
        if motion._instants is None or not motion._instants.courses:
            what = f"{motion.plan.title}: {self.name or 'a pump'}.check(motion): this motion has no time of its own"
            raise DefinitionError(f"{what}; sweep the machine over a path in time, Over.path(time=[...], ...).")
        judge, own = Judge(motion.plan, motion.designs, [motion], acting), in_plan(self, motion.plan)
        ensure(not judge.acting.inertia, f"{motion.plan.title}: {self.name or 'a pump'}.check: {SLOW}")
        return max((each for place in judge.places for each in cycles_over(own, place, judge.acting)), key=lambda each: each.stretch)

    def run(
        self, machine: Mechanism, *, demands: Mapping[Reference, Demand], until: float, start: Mapping[str, float] | Motion | None = None,
        acting: Acting | None = None,
    ) -> PumpMotion:  # fmt: skip
        """Return the motion of a machine under demands on its cylinders, while one pump serves them within its limits.

        Parameters
        ----------
        machine : Mechanism
            One design.
        demands : mapping
            How fast cylinders on this pump's lines shall move, by their names: a speed [m/s], below zero to retract, or a `Course` of
            speeds over time. `inf` is as fast as the pump can. What is not named stands.
        until : float
            When it ends [s].
        start : mapping or Motion, optional
            The strokes at 0 s [m or rad], those of the sketch where they are not named; or a motion in time, from whose end it goes on.
        acting : Acting, optional
            Loads and load case.

        Returns
        -------
        PumpMotion
            A motion in time, with its `events` and its `cycle`.

        Raises
        ------
        DefinitionError
            A demand for what is on no line of this pump, for a cylinder that holds nothing, or without a bound where the load drives; a
            pump without flow; everything at its end and no relief valve.
        AssemblyError
            A stroke comes to where the machine cannot be assembled.
        """
        return worked(self, machine, demands, until, start, acting)


@immutable
class Relief(Supply):
    """A relief valve: `valve = Relief(200 * bar)`; it may lie on any line.

    Parameters
    ----------
    pressure : float or quantity
        The pressure at which it opens [Pa gauge].
    """

    pressure: Parameter
    called: ClassVar[str] = "relief valve"


@immutable
class Tank(Supply):
    """A tank, which gives its line a pressure: `back = Tank(5 * bar)`.

    Parameters
    ----------
    pressure : float or quantity, optional
        The pressure [Pa gauge], 0, of an open tank, by default.
    """

    pressure: Parameter = 0.0
    called: ClassVar[str] = "tank"
