"""A holding valve on a line: the pressures that open it while the load goes down. Gauge pressures [Pa].

The valve opens by the pressure of the line that it holds and, `ratio` times as much, by that of the other side:
p + ratio p_pilot = setting. Lowering solves that together with the thrust, T = sum of a p over the chambers of a cylinder.
Source: P. Chapple, Principles of Hydraulic Systems Design, on counterbalance valves; makers set them 1.3 times above the load's pressure.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from functools import partial
from types import MappingProxyType
from typing import ClassVar, Unpack, cast

import numpy as np

from linkage.errors import DefinitionError, known_name, require_type
from linkage.frozen import immutable
from linkage.language import said
from linkage.loads import Acting, ActingKeywords, Case, Loads, Parameter, Poses, situation_of, takes_situation
from linkage.motion import Condition, HasVerdicts, Judge, Question, at, most
from linkage.plan import Plan
from linkage.quantities import Member, NamedMembers, Reference, label, name_of, of_kind
from linkage.quantities.member import in_class
from linkage.statics import AnyMotion, LawRequest, held_in_case, member_thrust, request_text, same
from linkage.units import show
from linkage.verdict import Verdict

from .cylinders import PISTON, Circuit, OnLines, Ram, carries_loads, circuits_among, number_request
from .inputs import Array, follows, in_pascals, number_set, one_design, positive
from .lifting_line import LiftLine
from .remedy import show_enough
from .standing import common_area, common_sum, moves_in

USUAL_SETTING = 1.3
"""The setting over the greatest pressure that the load makes, at the least, as makers advise."""
ROUNDED = 5e-4
"""Of a setting: what it may be below the usual one, as that is told in four digits."""


@immutable
class HoldingValve(OnLines, HasVerdicts):
    """A counterbalance valve: `valve = HoldingValve(lifting, pilot=other, setting=210 * bar, ratio=4)`.

    It holds the oil of the loaded side and puts no force on the machine. It opens where p + ratio p_pilot = setting. While the load is
    lowered the pump pushes through the pilot line, whatever that is on while it lifts.

    Parameters
    ----------
    line : OilLine or str
        The line of the loaded side, in which it holds the oil.
    pilot : OilLine or str
        The line of the other side.
    setting : float or quantity
        The pressure that opens it without a pilot [Pa gauge], a design variable, `valve.setting`.
    ratio : float or quantity
        The pilot's area in parts of the valve's, a design variable, `valve.ratio`.
    """

    line: Reference
    pilot: Reference
    setting: Parameter
    ratio: Parameter
    parameters: ClassVar[Mapping[str, str]] = MappingProxyType({"setting": "bar", "ratio": ""})
    not_negative: ClassVar[frozenset[str]] = frozenset({"setting"})
    limited: ClassVar[Mapping[str, str]] = MappingProxyType({"ratio": "ratio"})
    argument_kinds: ClassVar[Mapping[str, object]] = MappingProxyType({"line": "load", "pilot": "load"})

    def __post_init__(self) -> None:
        for name, what in WORDS.items():
            given = getattr(self, name)
            if not follows(given):
                value = positive(given, what, REMEDIES[name])
                if name == "setting":
                    in_pascals(value, what)
        for each in (self.line, self.pilot):
            require_type("HoldingValve: line", each, (str, Circuit), "is no line; name one, HoldingValve(line, pilot=other, ...)")
        super().__post_init__()

    def __str__(self) -> str:
        return f"HoldingValve({', '.join([label(self.line), f'pilot={label(self.pilot)}', *self.words()])})"

    def options(self) -> dict[str, object]:
        return {}

    def parts(self) -> tuple[Reference, ...]:
        return (self.line, self.pilot, *super().parts())

    def lines(self, members: NamedMembers) -> tuple[Circuit, Circuit]:
        """Return the line that it holds and that of its pilot, as a class has them.

        Parameters
        ----------
        members : mapping of str to Member
            The members of the class by name.

        Returns
        -------
        tuple of Circuit
            Both lines.
        """
        line, pilot = (in_class(members, each) for each in (self.line, self.pilot))
        return cast(Circuit, line), cast(Circuit, pilot)

    def examine(self, members: NamedMembers, title: str) -> None:
        known = [each.name for each in circuits_among(members)]
        for each in (self.line, self.pilot):
            known_name("Line", name_of(each), known, where=f"{title}.{self.name}")
        Member.examine(self, members, title)

    def faults(self, members: NamedMembers) -> Iterator[str]:
        line, pilot = self.lines(members)
        if same(line, pilot):
            yield f"{line.name} cannot be its own pilot; name the line of the other side, pilot=other"
        for ram, chamber in line.filling(members):
            others = [each.side for one, each in pilot.filling(members) if same(one, ram)]
            if not others or chamber.side in others:
                what = f"{pilot.name} has not the other side of {ram.name}, whose {chamber.side} side {line.name} has"
                other = "rod" if chamber.side == PISTON else "piston"
                yield f"{what}; name the line that does, such as OilLine({ram.name}.{other}_side, Tank())"
        if self.pumped(members) is None:
            what = f"no pump is on {line.name} or {pilot.name}, so that their cylinders carry what is given and lower nothing"
            yield f"{what}; put a Pump on {line.name}"
        for name, each in of_kind(members, HoldingValve).items():
            if not same(each, self) and each.holds_line(line):
                yield f"{name} holds {line.name} as well; a line has one holding valve, take one out"

    def holds_line(self, line: Circuit) -> bool:
        return name_of(self.line) == line.name

    def at_designs(self, motion: Poses, name: str) -> Array:
        """Return its setting or its ratio as a motion's designs have it [SI]; DefinitionError unless it is above zero.

        Parameters
        ----------
        motion : Motion
            The poses; designs first, strokes last.
        name : str
            "setting" or "ratio".

        Returns
        -------
        ndarray
            The value [SI].

        Raises
        ------
        DefinitionError
            A value not above zero.
        """
        return positive(number_set(self, motion, name), f"{self.name}: {WORDS[name].lower()}", REMEDIES[name])

    # -- while the load goes down --------------------------------------------------------------------------

    @takes_situation
    def pilot_pressure(self, motion: AnyMotion, loads: Loads = None, **situation: Unpack[ActingKeywords]) -> Array:
        """Return the pressure in the pilot line that lowers the load, shape (...) [Pa gauge]; 0 where the load opens the valve by itself.

        Lowering counts the declared friction of that direction, and the mechanical efficiency of the line's pump.

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
            The pressure [Pa gauge], shape (...).
        """
        return self.lowered(motion, situation_of("pilot_pressure", loads=loads, **situation))[1]

    @takes_situation
    def line_pressure(self, motion: AnyMotion, loads: Loads = None, **situation: Unpack[ActingKeywords]) -> Array:
        """Return the pressure in the line that it holds while the load is lowered, shape (...) [Pa gauge].

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
            The pressure [Pa gauge], shape (...).
        """
        return self.lowered(motion, situation_of("line_pressure", loads=loads, **situation))[0]

    @takes_situation
    def load_pressure(self, motion: AnyMotion, loads: Loads = None, **situation: Unpack[ActingKeywords]) -> Array:
        """Return the pressure that acts on the valve at rest, shape (...) [Pa gauge]: the line's, and `ratio` times a tank's in the pilot.

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
            The pressure [Pa gauge], shape (...).
        """
        acting = situation_of("load_pressure", loads=loads, **situation)
        motion = held_in_case(motion, acting)
        thrust, own, other = self.works(motion, acting.towards(None), False)
        piloted = self.pilot_at_rest(motion)
        return np.asarray(np.maximum((thrust - other * piloted) / own, 0.0) + self.at_designs(motion, "ratio") * piloted)[()]

    def pilot_at_rest(self, motion: AnyMotion) -> Array | float:
        """Return the pressure that a tank or gas gives the pilot line; 0 where that is on a pump.

        Parameters
        ----------
        motion : Motion
            The poses.

        Returns
        -------
        array or float
            The pressure [Pa gauge].
        """
        members = motion.plan.members
        _, pilot = self.lines(members)
        return pilot.line_pressure(motion, None) if pilot.kind_in(members) == "given" else 0.0

    def lowered(self, motion: AnyMotion, acting: Acting) -> tuple[Array, Array]:
        """Return the pressures of the line and of its pilot while the load is lowered [Pa gauge].

        p + ratio q = setting and a p + b q = T for the areas a of the line and b of the pilot. Where the pilot opens the valve wholly
        nothing stands in the line.

        Parameters
        ----------
        motion : Motion
            The poses; designs first, strokes last.
        acting : Acting
            Loads, load case, direction and rates in one.

        Returns
        -------
        tuple of ndarray
            Both pressures [Pa gauge].
        """
        motion = held_in_case(motion, acting)
        line, _ = self.lines(motion.plan.members)
        thrust, own, other = self.works(motion, acting.towards(acting.direction), acting.direction is None)
        if isinstance(line, LiftLine) and line.kind_open(motion.plan.members) == "held":
            k_m = line.efficiency(motion, "mechanical")
            thrust = np.where(thrust * np.sign(own) > 0.0, thrust * k_m, thrust / k_m)
        setting, ratio = self.at_designs(motion, "setting"), self.at_designs(motion, "ratio")
        pilot = (own * setting - thrust) / (own * ratio - other)
        pilot = np.maximum(np.where(setting - ratio * pilot < 0.0, thrust / other, pilot), 0.0)
        return np.asarray((thrust - other * pilot) / own)[()], np.asarray(pilot)[()]

    def pressure_lowering(self, line: Circuit, cylinder: Ram, motion: AnyMotion, acting: Acting) -> Array | None:
        members = motion.plan.members
        held, pilot = self.lines(members)
        sides = [each.side for ram, each in held.filling(members) if same(ram, cylinder)]
        if not sides or acting.direction != EMPTIES[sides[0]] or not (same(line, held) or same(line, pilot)):
            return None
        found = self.lowered(motion, replace(acting, direction=None))[0 if same(line, held) else 1]
        return np.asarray(found + np.zeros(motion.shape))[()]

    def works(self, motion: AnyMotion, acting: Acting, is_lowered: bool) -> tuple[Array, Array, Array]:
        """Return the thrusts and the areas of line and pilot, of several cylinders each times how its length follows their stroke.

        While the load `is_lowered` each cylinder moves in the direction in which its chamber of the line empties.

        Parameters
        ----------
        motion : Motion
            The poses; designs first, strokes last.
        acting : Acting
            Loads, load case, direction and rates in one.
        is_lowered : bool
            Whether the load is lowered.

        Returns
        -------
        tuple of ndarray
            The thrusts [N] and the areas of line and pilot [m2].
        """
        members = motion.plan.members
        line, pilot = self.lines(members)
        own = line.filling(members)
        rams = tuple(ram for ram, _ in own)
        emptied = [(ram, replace(acting, direction=EMPTIES[each.side]) if is_lowered else acting) for ram, each in own]
        thrust = common_sum(motion, rams, [(ram, member_thrust(motion, ram, given)) for ram, given in emptied])
        return thrust, common_area(motion, rams, own), common_area(motion, rams, pilot.filling(members))

    # -- asked for, and judged -----------------------------------------------------------------------------

    def pumped(self, members: NamedMembers) -> LiftLine | None:
        """Return the line whose pump pushes in the pilot line: itself, or that of the line that it holds; None where neither has one.

        Parameters
        ----------
        members : mapping of str to Member
            The members of the class by name.

        Returns
        -------
        LiftLine or None
            The line.
        """
        held = (each for each in self.lines(members)[::-1] if isinstance(each, LiftLine) and each.kind_open(members) == "held")
        return next(held, None)

    def questions(self, judge: Judge) -> list[Question]:
        return [most(valve_request("load_pressure", self.name, Acting())), most(valve_request("pilot_pressure", self.name, Acting()))]

    def conditions(self, judge: Judge) -> Mapping[str, Condition]:
        pump = self.pumped(judge.plan.members)
        setting = at(number_request(self, ".setting", partial(self.at_designs, name="setting")))
        found: dict[str, Condition] = {"setting": most(valve_request("load_pressure", self.name, Acting())) <= setting}
        if pump is not None:
            supply = at(number_request(pump, " supply", pump.supply))
            found["pilot"] = most(valve_request("pilot_pressure", self.name, Acting())) <= supply
        return found

    def verdicts(self, judge: Judge) -> list[Verdict]:
        """Return whether the load stays below the setting, and whether the pump opens the valve, wherever the machine runs.

        Parameters
        ----------
        judge : Judge
            The judge of the machine over its domains.

        Returns
        -------
        list of Verdict
            The verdicts.
        """
        if not carries_loads(judge):
            return []
        try:
            return [self.setting_verdict(judge), self.pilot_verdict(judge)]
        except DefinitionError as error:
            return [Verdict.refused("setting", error)]

    def setting_verdict(self, judge: Judge) -> Verdict:
        """Return whether the load opens the valve by itself, and the setting that makers advise.

        Parameters
        ----------
        judge : Judge
            The judge of the machine over its domains.

        Returns
        -------
        Verdict
            The verdict.
        """
        setting = one_design(self.at_designs(judge.motion, "setting"))
        found = judge.answer(most(valve_request("load_pressure", self.name, Acting())))
        line, pilot = self.lines(judge.plan.members)
        if not found.value > 0.0:
            text = said("the load presses nowhere on the side of {line}: the valve holds nothing.", line=line.name)
            return Verdict("setting", True, text, answer=found)
        pressure, share = show(found.value, "bar", 4, None if found.value < setting else setting), setting / float(found.value)
        by: dict[str, object] = {"setting": show(setting, "bar", 4), "share": share}
        says: dict[str, object] = {"pressure": pressure, "line": line.name, "pilot": pilot.name, "where": found.place}
        if np.any(self.pilot_at_rest(judge.motion)):
            by["says"] = said("load and the pressure in {pilot} act on the valve as up to {pressure} in {line}, {where}", **says)
        else:
            by["says"] = said("the load makes up to {pressure} in {line}, {where}", **says)
        by["advised"] = show_enough(USUAL_SETTING * float(found.value), "bar")
        text = said("{says}; the setting of {setting} is {share:.2f} times that.", **by)
        if found.value >= setting:
            text = said(
                "{says}: the valve, set to {setting}, opens by itself there. Set it to {advised}, 1.3 times that, or take a larger bore.",
                **by,
            )
        elif share < USUAL_SETTING * (1.0 - ROUNDED):
            text = said("{says}; the setting of {setting} is {share:.2f} times that, where 1.3 times is usual: {advised}.", **by)
        return Verdict("setting", bool(found.value < setting), text, answer=found)

    def pilot_verdict(self, judge: Judge) -> Verdict:
        """Return whether the pump's pressure is enough to lower the load.

        Parameters
        ----------
        judge : Judge
            The judge of the machine over its domains.

        Returns
        -------
        Verdict
            The verdict.
        """
        members = judge.plan.members
        _, pilot = self.lines(members)
        found, pump = judge.answer(most(valve_request("pilot_pressure", self.name, Acting()))), self.pumped(members)
        line = float(np.squeeze(self.line_pressure(judge.there(found), acting=judge.situation(found))))
        assert pump is not None
        supply = one_design(pump.supply(judge.motion))
        is_enough = bool(found.value <= supply * (1.0 + 1e-9))
        takes = show(found.value, "bar", 4, None if is_enough else supply)
        says = said(
            "lowering takes up to {pilot_pressure} in {pilot}, {where}, with {line_pressure} in the side that empties there",
            pilot_pressure=takes, pilot=pilot.name, where=found.place, line_pressure=show(line, "bar", 4),
        )  # fmt: skip
        if is_enough:
            return Verdict("pilot", True, said("{says}, of the pump's {supply}.", says=says, supply=show(supply, "bar", 4)), answer=found)
        text = said(
            "{says}: more than the pump's {supply}. Take a valve of a larger ratio, or set it lower if the load allows it.",
            says=says, supply=show(supply, "bar", 4),
        )  # fmt: skip
        return Verdict("pilot", False, text, answer=found)


EMPTIES: Mapping[str, str] = MappingProxyType({"piston": "retracting", "rod": "extending"})
"""The direction of a cylinder in which a side of it empties."""
WORDS: Mapping[str, str] = MappingProxyType({"setting": "Setting of the valve", "ratio": "Pilot ratio of the valve"})
REMEDIES: Mapping[str, str] = MappingProxyType({
    "setting": "give the pressure at which it opens without a pilot, such as 210 * bar",
    "ratio": "give the area of the pilot over that of the valve, such as 4",
})  # fmt: skip


def pilot_pressure(valve: Reference, *, case: Case = None, acting: Acting | None = None) -> LawRequest:
    """Return the request for the pilot pressure that lowers the load over a HoldingValve [Pa gauge]: `valve.pilot_pressure(motion)`.

    Parameters
    ----------
    valve : str or HoldingValve
        The valve, or its name.
    case : LoadCase or str, optional
        A load case, or its name.
    acting : Acting, optional
        Loads, load case, direction and rates in one.

    Returns
    -------
    Request
        The pressure [Pa gauge].
    """
    return valve_request("pilot_pressure", name_of(valve), situation_of("pilot_pressure", acting, case=case))


def load_pressure(valve: Reference, *, case: Case = None, acting: Acting | None = None) -> LawRequest:
    """Return the request for the pressure that acts on a HoldingValve at rest [Pa gauge]: `valve.load_pressure(motion)`.

    Parameters
    ----------
    valve : str or HoldingValve
        The valve, or its name.
    case : LoadCase or str, optional
        A load case, or its name.
    acting : Acting, optional
        Loads, load case, direction and rates in one.

    Returns
    -------
    Request
        The pressure [Pa gauge].
    """
    return valve_request("load_pressure", name_of(valve), situation_of("load_pressure", acting, case=case))


def valve_request(word: str, valve: str, acting: Acting) -> LawRequest:
    """Return the request for a method of a holding valve by its name; while lowering, where no line of a cylinder is shut."""

    def formula(motion: AnyMotion, acting: Acting) -> Array:
        found: Array = getattr(valve_in(valve, motion.plan), word)(motion, acting=acting)
        return found + np.zeros(motion.shape)

    def lowers(plan: Plan, case: str) -> bool:
        line, _ = valve_in(valve, plan).lines(plan.members)
        return all(moves_in(ram.name, plan, case) for ram in line.members(plan.members))

    return LawRequest(
        formula=formula, text=partial(request_text, word, (valve,)), known=(word, valve), acting=acting, measures="pressure", mover=valve,
        directions=(), examine=partial(valve_in, valve), cases_in=None if word == "load_pressure" else lowers,
    )  # fmt: skip


def valve_in(valve: str, plan: Plan) -> HoldingValve:
    """Return the holding valve of a name; DefinitionError where there is none."""
    valves = plan.of_kind(HoldingValve)
    return valves[known_name("HoldingValve", valve, valves, where=plan.title)]
