"""The load map and all that the tip reaches, and the load cases for strength, end of 2.1.3, each with the forces of all pins.

The map is the tip's working field, the drives as far as design and cylinders' lengths let them.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from hydraulics.inputs import one_number, positive
from linkage import Force, ForceElement, LoadCase, Motion, PinForces, WorkingField, drive_force, pin_forces, working_field
from linkage.errors import known_name
from linkage.loads.point import on_slope
from linkage.program import FloatArray
from linkage.study.reach import Reach

from .cylinders import drive_limits
from .machine import Crane
from .moments import LIFTING

TIP, LOAD = "T", "load"


def load_map(
    crane: Crane,
    heights: ArrayLike,
    radii: ArrayLike,
    *,
    stability: float | None = None,
    rated: float | None = None,
    case: str = LIFTING,
) -> WorkingField:
    """Return the greatest load at the tip over heights and radii [m], from the ground and from the column's axis; of one design.

    The telescope stands where it carries most; the load pulls down the slope of the load case. `stability` is the moment about the
    column's axis that the vehicle stands [N m], the crane's own weights included; `rated` a load [N] that is not exceeded.
    """
    cases = crane.plan.of_kind(LoadCase)
    x, y = on_slope((0.0, -1.0), cases[known_name("Load case", case, cases)].slope)
    limits: dict[str, Any] = {}
    if stability is not None:
        limits["stability"] = drive_force("phi") >= -float(positive(one_number(stability, "stability"), "stability"))
    if rated is not None:
        limits["rated load"] = float(positive(one_number(rated, "rated"), "rated"))
    return working_field(
        crane, TIP, radii, heights, along=(-x, -y), over=drive_limits(crane), case=case, without=[LOAD], limits=limits
    )


def envelope(crane: Crane) -> Reach:
    """Return all that the tip of one crane reaches, its border and area; what stands in the way, vehicle and ground, is not looked at."""
    return load_map(crane, [0.0], [0.0]).search.reach


# -- strength --------------------------------------------------------------------------------------------------

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
