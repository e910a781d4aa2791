"""Pressures of lines whose oil stays: closed ones, and those that a load case shuts. Gauge pressures [Pa].

What lines share cylinders hold them together. Their pressures follow from the thrusts that the loads ask for, and where that leaves some
open, as of a cylinder with both sides shut, they are the least that balance.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial, reduce
from operator import add

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
        thrust = moving_with(own[0], ram, motion, acting, partial(member_thrust, motion, ram))
        return thrust - by_other_lines(ram, None, motion, None)

    ties = [Tie(each.name, each.pressure_shares(members), held=False) for each in lines]
    found = tied_forces(motion, ties, thrust_of, [each.least(motion) for each in lines])
    return np.asarray(found[0] + np.zeros(motion.shape))[()] if motion.shape else found[0]


def moving_with(first: Ram, ram: Ram, motion: AnyMotion, acting: Acting, law: Callable[[Acting], Array]) -> Array:
    """Return a law of a cylinder in a situation whose direction is that of another one, which the same stroke moves."""
    if not acting.is_moving or same(ram, first) or not changes_in_motion(motion, acting.loads):
        return law(acting)
    turned = replace(acting, direction="retracting" if acting.direction == "extending" else "extending")
    return np.where(growths(motion, (first, ram))[1] < 0.0, law(turned), law(acting))


def growths(motion: AnyMotion, rams: Sequence[Ram]) -> list[Array]:
    """Return how the lengths of cylinders that one stroke moves follow it, while that of the first of them grows; 1 of one alone."""
    if len(rams) == 1:
        return [np.ones(())]
    rates = {stroke_followed(motion.plan, rams[0]): 1.0}
    sense = np.sign(rams[0].growth(motion, rates))
    return [ram.growth(motion, rates) * sense for ram in rams]


def common_sum(motion: AnyMotion, rams: Sequence[Ram], values: Sequence[tuple[Ram, Array | float]]) -> Array:
    """Return the sum of forces or areas of cylinders that one stroke moves: of several each counts by how its length follows that.

    Signs are those of the first one's length.
    """
    rates = [*zip(rams, growths(motion, rams), strict=True)]
    parts = (value * next(rate for one, rate in rates if same(one, ram)) for ram, value in values)
    return np.asarray(reduce(add, parts))[()]


def common_area(motion: AnyMotion, rams: Sequence[Ram], filling: Sequence[tuple[Ram, Chamber]]) -> Array:
    """Return the same sum of the signed areas of those chambers that are of these cylinders [m2]."""
    return common_sum(motion, rams, [(ram, chamber_area(each, ram, motion)) for ram, each in filling if is_among(ram, rams)])


# What a load case shuts.


def members_in(plan: Plan, case: str) -> NamedMembers:
    """Return the members of a plan as they are in a load case, by its name."""
    return plan_in_case(plan, Acting(case=case) if case in plan.of_kind(LoadCase) else None).members


def moves_in(cylinder: str | Ram, plan: Plan, case: str) -> bool:
    """Return whether a load case of a plan leaves a cylinder its oil: no line of it is shut there."""
    members = members_in(plan, case)
    ram = in_class(members, cylinder)
    return not (isinstance(ram, Ram) and is_blocked(ram, members))
