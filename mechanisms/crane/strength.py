"""The load cases that the crane's parts are designed for, each with the forces of all its pins. Source: end of 2.1.3."""

from __future__ import annotations

import numpy as np

from linkage import Force, ForceElement, Motion, PinForces, max_table, pin_forces
from linkage.program import FloatArray
from linkage.statics import table_text

from .load_map import Carrying, Limits
from .machine import Crane
from .moments import LIFTING

COUNT = 25
SLOPE = "side_slope"


def strength(crane: Crane) -> dict[str, PinForces]:
    """Return the pin forces of one crane in the source's load cases: lifting at full reach, dragging by the arm, on a side slope.

    Lifting: the load Q on the straight crane, all positions of the boom; on the slope the same, as the load case `side_slope` tilts it.
    Dragging: the tip drawn in along the ground by the greatest pull that the cylinders hold, nothing hanging from it.
    """
    straight = stretched(crane)
    path, pull = dragging(crane)
    own = [name for name in crane.plan.of_kind(ForceElement) if name != "load"]
    return {
        "lifting at full reach": pin_forces(straight, case=LIFTING),
        "dragging by the arm": pin_forces(path, [*own, Force("T", (pull, 0.0))], case=LIFTING),
        "on a side slope": pin_forces(straight, case=SLOPE),
    }


def stretched(crane: Crane) -> Motion:
    """Return the crane straight and at its longest, over all positions of the boom."""
    limits = crane.limits_of()
    return crane.at(phi=np.linspace(*limits["phi"], COUNT), psi=limits["psi"][1], t=limits["t"][1])


def dragging(crane: Crane) -> tuple[Motion, FloatArray]:
    """Return the tip drawn in along the ground, the telescope as far in as it can be, and the greatest pull at every pose [N].

    The pull is what all cylinders hold, of a load that resists outwards.
    """
    carrying = Carrying(crane, Limits(), LIFTING, pull=(1.0, 0.0))
    x = np.linspace(float(crane["L"]), 0.0, 8 * COUNT)
    y = np.full(x.size, float(crane["H_w"]))
    found = carrying.reach.windows(x, y)
    first = np.unique(found.place, return_index=True)[1]
    chosen = first[np.linspace(0, first.size - 1, COUNT).astype(int)]
    place, t = found.place[chosen], found.low[chosen]
    phi, psi = carrying.reach.angles(x[place], y[place], t, found.elbow[chosen])
    pull = carrying(phi, psi, t).min(axis=0)
    return carrying.crane.at(phi=phi, psi=psi, t=t), pull


def strength_text(crane: Crane) -> str:
    """Return the largest force of every pin in each load case as text."""
    return "\n\n".join(f"{title[0].upper()}{title[1:]}\n{table_text(max_table(found))}" for title, found in strength(crane).items())
