"""Pressures of lines whose oil stays: closed ones, and those that a load case shuts. Gauge pressures [Pa].

What lines share cylinders hold them together: their pressures follow from the thrusts that the loads ask for, and where that leaves some
open, as of a cylinder with both sides shut, they are the least that balance.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial, reduce
from typing import Any, cast, final

import numpy as np

from linkage.errors import DefinitionError
from linkage.language import said
from linkage.loads import Acting, LoadCase, Tie
from linkage.motion import Judge, least, most
from linkage.plan import Plan
from linkage.quantities import Member
from linkage.statics import AnyMotion, LawRequest, held_in_case, member_thrust, plan_in_case, same, stroke_followed, tied_forces
from linkage.units import show
from linkage.verdict import Verdict

from .inputs import Array
from .line import LiftLine, pressure_range
from .member import Chamber, Circuit, Ram, by_other_lines, chamber_area, changes_in_motion, circuits_among, line_thrust

EMPTY = 1e-9
"""A pressure that is lower by less than this part of the greatest is that to rounding."""


def is_blocked(ram: Ram, members: Mapping[str, Member]) -> bool:
    """Return whether a shut line keeps a cylinder where it is."""
    shut = [each for each in circuits_among(members) if each._is_shut and each.kind_open(members) != "closed"]
    return any(same(ram, each) for line in shut for each, _ in line.filling(members))


def connected(line: Circuit, members: Mapping[str, Member]) -> list[Circuit]:
    """Return the lines, held and closed ones, that share cylinders with one, through any of them; itself first."""
    others = [each for each in circuits_among(members) if each.kind_in(members) != "given"]
    found = [next(each for each in others if same(each, line))]
    for each in found:
        rams = [ram for ram, _ in each.filling(members)]
        found += [
            other for other in others
            if not any(same(other, one) for one in found) and any(same(ram, own) for ram, _ in other.filling(members) for own in rams)
        ]  # fmt: skip
    return found


def standing_pressure(line: Circuit, motion: AnyMotion, acting: Acting) -> Array:
    """Return the pressure of a line by the thrusts of its cylinders, shape (...) [Pa gauge], below zero where the load empties it.

    Where other lines leave it open it is the least that balances.
    """
    motion = held_in_case(motion, acting)
    members = motion.plan.members
    own = line.members(members)
    if not line.chambers and any(ram.works_both for ram in own):
        each = [ram.sized(motion).pressure_for(line_thrust(ram, line, motion, acting)) for ram in own]
        return np.asarray(reduce(np.maximum, each))
    lines = connected(line, members)
    ties = [Tie(each.name, each.shares(members), held=False) for each in lines]
    found = tied_forces(motion, ties, lambda ram: tied_thrust(own[0], ram, motion, acting), [each.least(motion) for each in lines])
    return np.asarray(found[0] + np.zeros(motion.shape))[()] if motion.shape else found[0]


def tied_thrust(first: Ram, ram: Ram, motion: AnyMotion, acting: Acting) -> Array:
    """Return what a cylinder carries without what lines of a given pressure put on it; a direction is that of the first cylinder."""
    if acting.direction is None or same(ram, first) or not changes_in_motion(motion, acting.loads):
        thrust = member_thrust(motion, ram, acting)
    else:
        ahead, back = (member_thrust(motion, ram, opposed(acting, way)) for way in (False, True))
        stroke = next(iter(motion.strokes))
        thrust = np.where(ram.growth(motion, {stroke: 1.0}) * first.growth(motion, {stroke: 1.0}) < 0.0, back, ahead)
    others = by_other_lines(ram, None, motion, None)
    return thrust if others is None else thrust - others


def opposed(acting: Acting, is_against: bool) -> Acting:
    """Return a situation in which a cylinder moves the other way, or the same."""
    turned = {"extending": "retracting", "retracting": "extending"}
    return replace(acting, direction=turned[acting.movement]) if is_against and acting.movement in turned else acting


# A pump against a shut line.


def pumps_against(line: Circuit, members: Mapping[str, Member]) -> LiftLine | None:
    """Return the line of a pump that fills the other side of one of a line's cylinders; None for none."""
    rams = line.members(members)
    return next((
        each for each in members.values()
        if isinstance(each, LiftLine) and not same(each, line) and not each._is_shut and each.kind_open(members) == "held"
        and any(same(ram, own) for ram, _ in each.filling(members) for own in rams)
    ), None)  # fmt: skip


def intensified(line: Circuit, motion: AnyMotion, acting: Acting) -> Array:
    """Return the pressure in a shut line, shape (...) [Pa gauge], while the pump pushes on the other sides with all that it gives.

    Pistons push with their area, annuli take it up with a smaller one, so that it may be far above the pump's. DefinitionError where no
    pump is on the other side.
    """
    motion = held_in_case(motion, acting)
    members = motion.plan.members
    pump = pumps_against(line, members)
    if pump is None:
        remedy = "ask for its pressure(motion), or put a Pump on the line of the other side"
        raise DefinitionError(f"{motion.plan.title}: no pump is on the other side of the cylinders of {line.name}; {remedy}.")
    works = CommonStroke(motion, line.members(members))
    asks = works.total([(ram, member_thrust(motion, ram, acting)) for ram in works.rams])
    pushed, taken = works.areas(pump.filling(members)), works.areas(line.filling(members))
    return np.asarray((asks - pump.supply(motion) * pushed) / taken)[()]


@final
@dataclass(frozen=True, eq=False)
class CommonStroke:
    """Cylinders that one stroke moves over a motion's poses; of several each counts by how its length follows that stroke."""

    motion: AnyMotion
    rams: tuple[Ram, ...]

    @cached_property
    def stroke(self) -> str:
        """The stroke; "" for one cylinder alone, which counts as it is."""
        return stroke_followed(self.motion.plan, self.rams[0]) if len(self.rams) > 1 else ""

    def total(self, values: Sequence[tuple[Ram, Array]]) -> Array:
        """Return the sum of forces or areas of cylinders."""
        ways = [value * ram.growth(self.motion, {self.stroke: 1.0}) if self.stroke else value for ram, value in values]
        return np.asarray(reduce(np.add, ways))[()]

    def areas(self, filling: Sequence[tuple[Ram, Chamber]]) -> Array:
        """Return the sum of the signed areas of those chambers that are of these cylinders [m2]."""
        own = [(ram, each) for ram, each in filling if any(same(ram, one) for one in self.rams)]
        return self.total([(ram, chamber_area(each, ram, self.motion)) for ram, each in own])


# The verdict on a line that load cases shut.


def members_in(plan: Plan, case: str) -> Mapping[str, Member]:
    """Return the members of a plan as they are in a load case, by its name."""
    return plan_in_case(plan, Acting(case=case) if case in plan.of_kind(LoadCase) else None).members


def shuts(line: str, is_pushed: bool, plan: Plan, case: str) -> bool:
    """Return whether a load case of a plan shuts a line, and where that is asked leaves a pump on the other side."""
    found = plan.of_kind(LoadCase).get(case)
    if found is None or line not in found.shut_names:
        return False
    members = members_in(plan, case)
    return not is_pushed or pumps_against(cast(Circuit, members[line]), members) is not None


def moves_in(cylinder: Any, plan: Plan, case: str) -> bool:
    """Return whether a load case of a plan leaves a cylinder its oil: no line of it is shut there."""
    members = members_in(plan, case)
    ram = members.get(cylinder) if isinstance(cylinder, str) else cylinder
    return not (isinstance(ram, Ram) and is_blocked(ram, members))


def shut_request(line: Circuit, is_pushed: bool) -> LawRequest:
    """Return the request for the pressure of a line in the load cases that shut it, with or without the pump on the other side."""
    word = "intensified" if is_pushed else "shut_pressure"
    first = line.references[0] if line.references else ""
    return LawRequest(
        formula=partial(intensified if is_pushed else standing_pressure, line), text=f"{line.name}.{word}", known=(word, line.name),
        acting=Acting(), measures="pressure", mover=getattr(first, "name", None) or str(first), directions=no_direction,
        cases_in=partial(shuts, line.name, is_pushed),
    )  # fmt: skip


def no_direction(plan: Plan) -> tuple[str, ...]:
    """Return that a request is judged at rest."""
    return ()


def shut_verdicts(line: Circuit, judge: Judge, unit: str = "bar") -> list[Verdict]:
    """Return whether a line that a load case shuts keeps its oil there, and bears what a pump on the other side makes of it."""
    plan = judge.plan
    cases = [name for name in plan.of_kind(LoadCase) if shuts(line.name, False, plan, name)]
    pushing = [name for name in cases if shuts(line.name, True, plan, name)]
    pump = pumps_against(line, plan.members) if pushing else None
    if not cases or (line.kind_open(plan.members) != "given" and pump is None):
        return []  # what it holds, or keeps, is told by its other verdicts
    try:
        low, high = judge.answers([least(shut_request(line, False)), most(shut_request(line, False))])
        pushed = None if pump is None else judge.answer(most(shut_request(line, True)))
    except DefinitionError as error:
        return [Verdict("shut", False, " ".join(str(error).split()))]
    says = pressure_range(low, high, unit) if high.value > 0.0 or low.value < 0.0 else said("it holds no pressure")
    if low.value < -EMPTY * max(abs(float(high.value)), 1e5):
        text = said("{says}: below zero it runs empty there and does not hold; shut the other side as well.", says=says)
        return [Verdict("shut", False, text, answer=low)]
    worst = high if pushed is None else pushed
    if pump is not None and pushed is not None:
        given = show(float(np.ravel(pump.supply(judge.motion))[0]), unit, 4)
        says += said(
            "; against the pump's {given} on the other side it is up to {pressure}, {where}",
            given=given, pressure=show(pushed.value, unit, 4), where=pushed.place,
        )  # fmt: skip
    own = isinstance(line, LiftLine) and line.relieves(plan)
    bears = line if own else pump
    if not isinstance(bears, LiftLine):
        return [Verdict("shut", True, f"{says}.", answer=worst)]
    limit = float(np.ravel(bears.held(judge.motion))[0])
    by, bears_it = {"says": says, "limit": show(limit, unit, 4), "line": line.name}, float(worst.value) <= limit * (1.0 + EMPTY)
    if bears_it:
        text = said("{says}, below {limit}.", **by)
    elif own:
        text = said("{says}: its relief valve opens at {limit}, and it does not stay shut.", **by)
    else:
        text = said("{says}, above the {limit} on the pump's side: put a Relief on {line}, or switch the pump off while it is shut.", **by)
    return [Verdict("shut", bears_it, text, answer=worst)]
