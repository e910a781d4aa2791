"""The load cases that the crane's parts are designed for, each with the forces of all its pins. Source: end of 2.1.3."""

from __future__ import annotations

import numpy as np

from linkage import Force, ForceElement, Motion, PinForces, pin_forces, working_field
from linkage.program import FloatArray

from .cylinders import drive_limits
from .load_map import LOAD, TIP
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

    The pull is what all cylinders hold, of a load that resists outwards. The telescope stands at its closed end, or where the boom is at
    its lowest, or where the arm is straight.
    """
    ends, x = drive_limits(crane), np.linspace(float(crane["L"]), 0.0, 8 * COUNT)
    stands = {"t": ends["t"][0], "phi": ends["phi"][1], "psi": min(ends["psi"][1], np.pi)}
    fields = [
        working_field(crane, TIP, x, [float(crane["H_w"])], along=(-1.0, 0.0), over=ends, hold={name: value}, case=LIFTING, without=[LOAD])
        for name, value in stands.items()
    ]
    found = {name: np.array([each.strokes[name][0] for each in fields]) for name in ends}
    least = np.argmin(np.where(np.isnan(found["t"]), np.inf, found["t"]), axis=0)
    strokes = {name: values[least, np.arange(x.size)] for name, values in found.items()}
    pull = np.array([each.load[0] for each in fields])[least, np.arange(x.size)]
    there = np.flatnonzero(np.isfinite(pull))
    chosen = there[np.linspace(0, there.size - 1, COUNT).astype(int)]
    return crane.replaced(Q=0.0).at(**{name: values[chosen] for name, values in strokes.items()}), pull[chosen]
