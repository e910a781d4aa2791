"""How cylinders move while a machine runs: their rates, the power that they give and the oil that they take."""

from __future__ import annotations

from functools import reduce

import numpy as np

from linkage.errors import DefinitionError
from linkage.loads import Acting, Case, situation_of
from linkage.plan import Plan
from linkage.quantities import Reference, name_of
from linkage.statics import AnyMotion, LawRequest, member_thrust, own_rates

from .cylinders import PISTON, Circuit, Ram, chamber_area, cylinder_request, rate_request
from .inputs import Array


def rate(cylinder: Reference) -> LawRequest:
    """Return the request for how fast a cylinder extends while a machine runs.

    Parameters
    ----------
    cylinder : Reference
        A cylinder, or its name.

    Returns
    -------
    LawRequest
        The rate of its length [m/s], below zero while it retracts.
    """
    return rate_request(name_of(cylinder))


def power(cylinder: Reference, *, case: Case = None, acting: Acting | None = None) -> LawRequest:
    """Return the request for the power that a cylinder gives while a machine runs.

    Parameters
    ----------
    cylinder : Reference
        A cylinder, or its name.
    case : LoadCase or str, optional
        The load case.
    acting : Acting, optional
        Loads, case and what else acts, in one.

    Returns
    -------
    LawRequest
        Its thrust times its rate [W], below zero where the load drives it.
    """

    def over(motion: AnyMotion, ram: Ram, acting: Acting) -> Array:
        return member_thrust(motion, ram, acting) * ram.growth(motion, own_rates(motion, f"power({ram.name})", acting))

    return cylinder_request("power", name_of(cylinder), situation_of("power", acting, case=case), over, measures="power")


def flow(line: Reference) -> LawRequest:
    """Return the request for the oil that a line gives to its cylinders while a machine runs.

    Parameters
    ----------
    line : Reference
        A LiftCircuit, an OilLine or another line, or its name.

    Returns
    -------
    LawRequest
        The flow [m3/s], below zero where oil comes back. A circuit whose cylinder works with both sides gives oil either way.
    """
    name = name_of(line)

    def found(plan: Plan) -> Circuit:
        known = plan.members.get(name)
        if not isinstance(known, Circuit):
            lines = ", ".join(plan.of_kind(Circuit)) or "none is declared"
            raise DefinitionError(f"{plan.title}: flow({name}): the name of a line is expected: {lines}.")
        return known

    def taken(motion: AnyMotion, filled: tuple[Ram, list[Array]]) -> Array:
        ram, areas = filled
        grows = ram.growth(motion, own_rates(motion, f"flow({name})"))
        if len(areas) > 1 and ram.works_both:  # the pump is on the side that works
            return np.where(grows > 0.0, areas[0] * grows, areas[1] * grows)
        return reduce(np.add, areas) * grows

    def over(motion: AnyMotion) -> Array:
        rams: dict[str, tuple[Ram, list[Array]]] = {}
        for ram, chamber in sorted(found(motion.plan).filling(motion.plan.members), key=lambda each: each[1].side != PISTON):
            rams.setdefault(ram.name, (ram, []))[1].append(chamber_area(chamber, ram, motion))
        return reduce(np.add, [taken(motion, each) for each in rams.values()])

    return LawRequest(formula=over, text=f"flow({name})", known=("flow", name), measures="flow", examine=found)
