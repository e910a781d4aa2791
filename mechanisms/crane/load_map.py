"""The load map and all that the tip reaches: its working field, the drives as far as design and cylinders' lengths let them."""

from __future__ import annotations

from typing import Any

from numpy.typing import ArrayLike

from hydraulics.inputs import one_number, positive
from linkage import LoadCase, WorkingField, drive_force, working_field
from linkage.errors import known_name
from linkage.loads.point import on_slope
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
