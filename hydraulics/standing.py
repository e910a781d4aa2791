"""Pressures of lines whose oil stays: closed ones, and those that a load case shuts. Gauge pressures [Pa].

What lines share cylinders hold them together. Their pressures follow from the thrusts that the loads ask for, and where that leaves some
open, as of a cylinder with both sides shut, they are the least that balance.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import reduce

import numpy as np

from linkage.loads import Acting, LoadCase, Tie
from linkage.plan import Plan
from linkage.quantities import NamedMembers
from linkage.quantities.member import in_class
from linkage.statics import AnyMotion, held_in_case, is_among, member_thrust, plan_in_case, same, stroke_followed, tied_forces

from .cylinders import Chamber, Circuit, Ram, by_other_lines, chamber_area, changes_in_motion, circuits_among, line_thrust
from .inputs import Array


def is_blocked(ram: Ram, members: NamedMembers) -> bool:
    """Return whether a shut line keeps a cylinder where it is."""
    shut = [each for each in circuits_among(members) if each._is_shut and each.kind_open(members) != "closed"]
    return any(is_among(ram, line.members(members)) for line in shut)


def standing_pressure(line: Circuit, motion: AnyMotion, acting: Acting) -> Array:
    """Return the pressure of a line by the thrusts of its cylinders, shape (...) [Pa gauge], below zero where the load empties it.

    Where other lines leave it open it is the least that balances. A direction is that of its first cylinder.
    """
    motion = held_in_case(motion, acting)
    members = motion.plan.members
    own = line.members(members)
    if not line.chambers and any(ram.works_both for ram in own):
        each = [ram.sized(motion).pressure_for(line_thrust(ram, line, motion, acting)) for ram in own]
        return np.asarray(reduce(np.maximum, each))
    others = [each for each in circuits_among(members) if each.kind_in(members) != "given"]
    lines = [next(each for each in others if same(each, line))]  # and all that share cylinders with it, through any of them
    for one in lines:
        rams = one.members(members)
        joined = [each for each in others if any(is_among(ram, rams) for ram in each.members(members))]
        lines += [each for each in joined if not is_among(each, lines)]

    def thrust_of(ram: Ram) -> Array:
        """Return a cylinder's thrust less the parts of lines with a given pressure."""
        if acting.direction is None or same(ram, own[0]) or not changes_in_motion(motion, acting.loads):
            thrust = member_thrust(motion, ram, acting)
        else:
            turned = {"extending": "retracting", "retracting": "extending"}.get(acting.movement, acting.movement)
            ahead, back = (member_thrust(motion, ram, each) for each in (acting, replace(acting, direction=turned)))
            rates = {next(iter(motion.strokes)): 1.0}
            thrust = np.where(ram.growth(motion, rates) * own[0].growth(motion, rates) < 0.0, back, ahead)
        return thrust - by_other_lines(ram, None, motion, None)

    ties = [Tie(each.name, each.pressure_shares(members), held=False) for each in lines]
    found = tied_forces(motion, ties, thrust_of, [each.least(motion) for each in lines])
    return np.asarray(found[0] + np.zeros(motion.shape))[()] if motion.shape else found[0]


def common_sum(motion: AnyMotion, rams: Sequence[Ram], values: Sequence[tuple[Ram, Array]]) -> Array:
    """Return the sum of forces or areas of cylinders that one stroke moves: of several each counts by how its length follows that."""
    rates = {stroke_followed(motion.plan, rams[0]): 1.0} if len(rams) > 1 else {}
    return np.asarray(reduce(np.add, [value * ram.growth(motion, rates) if rates else value for ram, value in values]))[()]


def common_area(motion: AnyMotion, rams: Sequence[Ram], filling: Sequence[tuple[Ram, Chamber]]) -> Array:
    """Return the same sum of the signed areas of those chambers that are of these cylinders [m2]."""
    own = [(ram, chamber_area(each, ram, motion)) for ram, each in filling if is_among(ram, rams)]
    return common_sum(motion, rams, own)


# What a load case shuts.


def members_in(plan: Plan, case: str) -> NamedMembers:
    """Return the members of a plan as they are in a load case, by its name."""
    return plan_in_case(plan, Acting(case=case) if case in plan.of_kind(LoadCase) else None).members


def moves_in(cylinder: str | Ram, plan: Plan, case: str) -> bool:
    """Return whether a load case of a plan leaves a cylinder its oil: no line of it is shut there."""
    members = members_in(plan, case)
    ram = in_class(members, cylinder)
    return not (isinstance(ram, Ram) and is_blocked(ram, members))
