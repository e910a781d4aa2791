"""A line that a load case shuts: whether it keeps its oil, and bears the pressure from a pump on the other side. Gauge pressures [Pa]."""

from __future__ import annotations

from functools import partial
from typing import cast

import numpy as np

from linkage import Acting, DefinitionError, LoadCase, Verdict
from linkage.language import said
from linkage.motion import Judge, most
from linkage.plan import Plan
from linkage.quantities import NamedMembers, of_kind
from linkage.statics import AnyMotion, LawRequest, held_in_case, is_among, member_thrust, same
from linkage.units import show

from .cylinders import Circuit, least_and_most
from .inputs import Array, one_design
from .lifting_line import LiftLine, pressure_range
from .standing import common_area, common_sum, members_in, standing_pressure

EMPTY = 1e-9
"""A pressure that is lower by less than this part of the greatest is that to rounding."""


def pumps_against(line: Circuit, members: NamedMembers) -> LiftLine | None:
    """Return the line of a pump that fills the other side of one of a line's cylinders; None for none."""
    rams = line.members(members)
    return next((
        each for each in of_kind(members, LiftLine).values()
        if not same(each, line) and not each._is_shut and each.kind_open(members) == "held"
        and any(is_among(ram, rams) for ram in each.members(members))
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
    rams = line.members(members)
    asks = common_sum(motion, rams, [(ram, member_thrust(motion, ram, acting)) for ram in rams])
    pushed, taken = (common_area(motion, rams, each.filling(members)) for each in (pump, line))
    return np.asarray((asks - pump.supply(motion) * pushed) / taken)[()]


def shuts(line: str, is_pushed: bool, plan: Plan, case: str) -> bool:
    """Return whether a load case of a plan shuts a line, and where that is asked leaves a pump on the other side."""
    found = plan.of_kind(LoadCase).get(case)
    if found is None or line not in found.shut_names:
        return False
    members = members_in(plan, case)
    return not is_pushed or pumps_against(cast(Circuit, members[line]), members) is not None


def shut_request(line: Circuit, is_pushed: bool) -> LawRequest:
    """Return the request for the pressure of a line in the load cases that shut it, with or without the pump on the other side."""
    word = "intensified" if is_pushed else "shut_pressure"
    first = line.references[0] if line.references else ""
    return LawRequest(
        formula=partial(intensified if is_pushed else standing_pressure, line), text=f"{line.name}.{word}", known=(word, line.name),
        acting=Acting(), measures="pressure", mover=getattr(first, "name", None) or str(first), directions=(),
        cases_in=partial(shuts, line.name, is_pushed),
    )  # fmt: skip


def shut_verdicts(line: Circuit, judge: Judge) -> list[Verdict]:
    """Return whether a line that a load case shuts keeps its oil, and bears the pressure from a pump on the other side."""
    plan = judge.plan
    cases = [name for name in plan.of_kind(LoadCase) if shuts(line.name, False, plan, name)]
    pushing = [name for name in cases if shuts(line.name, True, plan, name)]
    pump = pumps_against(line, plan.members) if pushing else None
    if not cases or (line.kind_open(plan.members) != "given" and pump is None):
        return []  # what it holds, or keeps, is told by its other verdicts
    found, lines = shut_verdict(line, judge, pump), {each for case in cases for each in plan.of_kind(LoadCase)[case].shut_names}
    return [found.named(line.name) if len(lines) > 1 else found]


def shut_verdict(line: Circuit, judge: Judge, pump: LiftLine | None) -> Verdict:
    """Return the verdict on a line that is shut; `pump` is the line that pushes from the other side."""
    plan = judge.plan
    try:
        low, high = judge.answers(least_and_most(shut_request(line, False)))
        pushed = None if pump is None else judge.answer(most(shut_request(line, True)))
    except DefinitionError as error:
        return Verdict.refused("shut", error)
    says = pressure_range(low, high, "bar") if high.value > 0.0 or low.value < 0.0 else said("it holds no pressure")
    if low.value < -EMPTY * max(abs(float(high.value)), 1e5):
        text = said("{says}: below zero it runs empty there and does not hold; shut the other side as well.", says=says)
        return Verdict("shut", False, text, answer=low)
    worst = high if pushed is None else pushed
    if pump is not None and pushed is not None:
        given = show(one_design(pump.supply(judge.motion)), "bar", 4)
        says += said(
            "; against the pump's {given} on the other side it is up to {pressure}, {where}",
            given=given, pressure=show(pushed.value, "bar", 4), where=pushed.place,
        )  # fmt: skip
    own = isinstance(line, LiftLine) and line.relieves(plan)
    bears = line if own else pump
    if not isinstance(bears, LiftLine):
        return Verdict("shut", True, f"{says}.", answer=worst)
    limit = one_design(bears.relief_pressure(judge.motion))
    by, bears_it = {"says": says, "limit": show(limit, "bar", 4), "line": line.name}, float(worst.value) <= limit * (1.0 + EMPTY)
    if bears_it:
        text = said("{says}, below {limit}.", **by)
    elif own:
        text = said("{says}: its relief valve opens at {limit}, and it does not stay shut.", **by)
    else:
        text = said("{says}, above the {limit} on the pump's side: put a Relief on {line}, or switch the pump off while it is shut.", **by)
    return Verdict("shut", bears_it, text, answer=worst)
