"""A crane's cylinder moments, its load map, the reach of its tip, and the load cases for strength with the forces of all pins.

The map is the tip's working field, the drives as far as design and cylinders' lengths let them. Sources: (2.29), (2.44); end of 2.1.3.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from hydraulics import Cylinder
from hydraulics.inputs import one_number, positive
from linkage import Force, ForceElement, LoadCase, PinForces, WorkingField, distance, drive_force, mm, pin_forces, ratio, working_field
from linkage.errors import DefinitionError, ensure, known_name
from linkage.loads.point import on_slope
from linkage.motion import Motion, below_zero
from linkage.program import FloatArray
from linkage.study.reach import Reach
from linkage.study.space import check_one_design

from .duty import LIFTING
from .machine import DRIVEN, Crane

PLAY = 1e-6
"""m: a length that a cylinder misses by no more is within its stroke."""


def sides(motion: Motion, stroke: str) -> tuple[float, float]:
    """Return the push and the pull of a stroke's cylinder at the pump's pressure [N], both positive, of one design.

    It is p n times the area, less the back pressure's share. The side that a cylinder does not work with gives nothing.
    DefinitionError for a cylinder without a line.
    """
    name = DRIVEN[stroke]
    low, high = motion.plan.of_kind(Cylinder)[name].bounds(motion, lifting=True)
    is_bounded = np.isfinite([low, high]).all()
    ensure(is_bounded, f"{motion.plan.title}: nothing bounds the thrust of {name}; declare its line, LiftCircuit({name}, ...).")
    return max(float(high), 0.0), max(-float(low), 0.0)


def lever(crane: Crane, stroke: str, at: ArrayLike) -> FloatArray:
    """Return the rate of a cylinder's length by its stroke, the shape of `at`: its lever about the joint [m], positive where it grows."""
    ends = crane.plan.of_kind(Cylinder)[DRIVEN[stroke]].ends
    (found,) = crane.evaluate([ratio(distance(*ends), wrt=stroke)], **along_stroke(crane, stroke, at))
    return found.reshape(np.shape(at))


def along_stroke(crane: Crane, stroke: str, at: ArrayLike) -> dict[str, Any]:
    """Return strokes with one of them as said, in a row, and the others at their starts: a cylinder's length follows its own alone."""
    others: dict[str, Any] = {name: start for name, (start, _) in crane.limits_of().items()}
    return others | {stroke: np.ravel(np.asarray(at, float))}


def boom_moment(crane: Crane, phi: ArrayLike) -> FloatArray:
    """Return the lifting moment M_g of the boom's cylinder at the pump's pressure (2.29).

    Parameters
    ----------
    crane : Crane
        The crane, one design.
    phi : array
        The boom's angles [rad].

    Returns
    -------
    array
        The moment [N m], of the shape of phi.
    """
    push, _ = sides(crane.position(1), "phi")
    return -push * lever(crane, "phi", phi)


def arm_moment(crane: Crane, psi: ArrayLike) -> tuple[FloatArray, FloatArray]:
    """Return the moments M_g1 and M_g2 of the arm's cylinder with its two sides (2.44).

    M_g1 folds the arm and is negative, M_g2 unfolds it; a cylinder that opens the arm while it grows folds it by its rod side.

    Parameters
    ----------
    crane : Crane
        The crane, one design.
    psi : array
        The arm's angles [rad].

    Returns
    -------
    tuple of array
        The moments [N m], of the shape of psi.
    """
    (push, pull), arm = sides(crane.position(1), "psi"), lever(crane, "psi", psi)
    pushes, pulls = push * arm, -pull * arm
    return np.minimum(pushes, pulls), np.maximum(pushes, pulls)


def drive_limits(crane: Crane) -> dict[str, tuple[float, float]]:
    """Return how far each drive goes in this design, as far as its cylinder's closed and open length let it.

    Parameters
    ----------
    crane : Crane
        The crane, one design.

    Returns
    -------
    dict of str to tuple of float
        The ends of phi, psi [rad] and t [m].

    Raises
    ------
    DefinitionError
        It is a batch, or a cylinder's length fits none of its drive's positions.
    """
    check_one_design(crane)
    return {stroke: within(crane, stroke, *span) for stroke, span in crane.limits_of().items()}


def within(crane: Crane, stroke: str, start: float, end: float) -> tuple[float, float]:
    """Return the part of start..end of a stroke in which its cylinder's length lies between closed and open."""
    cylinder = crane.plan.of_kind(Cylinder)[DRIVEN[stroke]]
    closed, way = cylinder.closed_and_stroke(crane.position(1))
    if closed is None or end <= start:
        return start, end
    least, most = float(closed) - PLAY, float(closed) + PLAY + (np.inf if way is None else float(way))

    poses = crane.at(**along_stroke(crane, stroke, np.linspace(start, end, 65)))
    lengths = poses.distance(*cylinder.ends)
    if not np.any((lengths >= least) & (lengths <= most)):
        goes = f"{np.min(lengths) / mm:.1f} to {np.max(lengths) / mm:.1f} mm"
        raise DefinitionError(f"{cylinder.name} is never as long as {stroke} needs, {goes}; take another closed length or other pins.")

    def slack(motion: Motion) -> FloatArray:
        """Return by how much the length lies within the cylinder's own [m]."""
        length = motion.distance(*cylinder.ends)
        return np.minimum(length - least, most - length)

    outside = [(each.start[stroke], each.end[stroke]) for each in below_zero(poses, slack)]
    low = outside[0][1] if outside and outside[0][0] <= start else start
    return low, outside[-1][0] if outside and outside[-1][1] >= end else end


# -- the load map -----------------------------------------------------------------------------------------------

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
    """Return the greatest load at the tip over heights and radii.

    The telescope is where it carries most; the load pulls down the slope of the load case.

    Parameters
    ----------
    crane : Crane
        The crane, one design.
    heights, radii : array
        The places [m], from the ground and from the column's axis.
    stability : float, optional
        The moment about the column's axis that the vehicle bears [N m], the crane's own weights included.
    rated : float, optional
        A load that is not exceeded [N].
    case : str, optional
        The load case.

    Returns
    -------
    WorkingField
        The loads.
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
    """Return the reach of one crane's tip, its border and area; obstacles such as vehicle and ground are left out.

    Parameters
    ----------
    crane : Crane
        The crane, one design.

    Returns
    -------
    Reach
        The reach.
    """
    return load_map(crane, [0.0], [0.0]).search.reach


# -- strength --------------------------------------------------------------------------------------------------

COUNT = 25
SLOPE = "side_slope"


def strength(crane: Crane) -> dict[str, PinForces]:
    """Return the pin forces of one crane in the source's load cases: lifting at full reach, dragging by the arm, on a side slope.

    Lifting: the load Q on the straight crane, all positions of the boom; on the slope the same, as the load case `side_slope` tilts it.
    Dragging: the tip drawn in along the ground by the greatest pull that the cylinders hold, without a load on it.

    Parameters
    ----------
    crane : Crane
        The crane, one design.

    Returns
    -------
    dict of str to PinForces
        By load case.
    """
    limits = crane.limits_of()
    straight = crane.at(phi=np.linspace(*limits["phi"], COUNT), psi=limits["psi"][1], t=limits["t"][1])
    path, pull = dragging(crane)
    own = [name for name in crane.plan.of_kind(ForceElement) if name != "load"]
    return {
        "lifting at full reach": pin_forces(straight, case=LIFTING),
        "dragging by the arm": pin_forces(path, [*own, Force("T", (pull, 0.0))], case=LIFTING),
        "on a side slope": pin_forces(straight, case=SLOPE),
    }


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
