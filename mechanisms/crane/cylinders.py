"""What the crane's cylinders can do: the forces of their two sides, the moments they give, and how far they let their drives go."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from hydraulics import Cylinder, LiftCircuit
from linkage import DefinitionError, Motion, distance, ratio
from linkage.program import FloatArray
from linkage.study.checks import check_one_design
from linkage.units import mm

from .machine import DRIVEN, Crane

PLAY = 1e-6
"""m: a length that a cylinder misses by no more is within its stroke."""


def sides(motion: Motion, stroke: str) -> tuple[float, float]:
    """Return what the cylinder of a stroke pushes and pulls with at the pump's pressure [N], both positive, of one design.

    It is p n times the area, less the back pressure's share.

    The side that a cylinder does not work with gives nothing.
    """
    ram, line = DRIVEN[stroke]
    cylinder, circuit = motion.plan.of_kind(Cylinder)[ram], motion.plan.of_kind(LiftCircuit)[line]
    size, back = cylinder.sized(motion), float(circuit.back(motion))
    k_m, k_h = (float(circuit.efficiency(motion, kind)) for kind in ("mechanical", "hydraulic"))
    pressure = k_h * float(circuit.supply(motion))
    out = k_m * (pressure * float(size.push_area) - back * float(size.pull_area))
    inwards = k_m * (pressure * float(size.pull_area) - back * float(size.push_area))
    return (max(out, 0.0) if size.works != "rod" else 0.0, max(inwards, 0.0) if size.works != "piston" else 0.0)


def lever(crane: Crane, stroke: str, at: ArrayLike) -> FloatArray:
    """Return the rate of a cylinder's length by its stroke, the shape of `at`: its lever about the joint [m], positive where it grows."""
    ends = crane.plan.of_kind(Cylinder)[DRIVEN[stroke][0]].ends
    (found,) = crane.evaluate([ratio(distance(*ends), wrt=stroke)], **along_stroke(crane, stroke, at))
    return found.reshape(np.shape(at))


def along_stroke(crane: Crane, stroke: str, at: ArrayLike) -> dict[str, Any]:
    """Return strokes with one of them as said, in a row, and the others at their starts: a cylinder's length follows its own alone."""
    others: dict[str, Any] = {name: start for name, (start, _) in crane.limits_of().items()}
    return others | {stroke: np.ravel(np.asarray(at, float))}


def boom_moment(crane: Crane, phi: ArrayLike) -> FloatArray:
    """Return M_g(phi) [N m], the shape of phi: what the boom's cylinder lifts with, its piston side at the pump's pressure. (2.29)"""
    push, _ = sides(crane.position(1), "phi")
    return -push * lever(crane, "phi", phi)


def arm_moment(crane: Crane, psi: ArrayLike) -> tuple[FloatArray, FloatArray]:
    """Return M_g1 and M_g2 (psi) [N m], the shape of psi: what the arm's cylinder gives with its two sides. (2.44)

    M_g1 folds the arm and is negative, M_g2 unfolds it; a cylinder that opens the arm while it grows folds it by its rod side.
    """
    (push, pull), arm = sides(crane.position(1), "psi"), lever(crane, "psi", psi)
    pushes, pulls = push * arm, -pull * arm
    return np.minimum(pushes, pulls), np.maximum(pushes, pulls)


def drive_limits(crane: Crane) -> dict[str, tuple[float, float]]:
    """Return how far each drive goes in this design, phi, psi [rad], t [m], as far as its cylinder's closed and open length let it.

    DefinitionError for a batch, and where a cylinder's length fits none of its drive's positions.
    """
    check_one_design(crane)
    return {stroke: within(crane, stroke, *span) for stroke, span in crane.limits_of().items()}


def within(crane: Crane, stroke: str, start: float, end: float) -> tuple[float, float]:
    """Return the part of start..end of a stroke in which its cylinder's length lies between closed and open."""
    cylinder = crane.plan.of_kind(Cylinder)[DRIVEN[stroke][0]]
    closed, way = cylinder.closed_and_stroke(crane.position(1))
    if closed is None or end <= start:
        return start, end
    least, most = float(closed) - PLAY, float(closed) + PLAY + (np.inf if way is None else float(way))

    def slack(at: FloatArray) -> FloatArray:
        """Return by how much its length lies within its own [m], of strokes."""
        (length,) = crane.evaluate([distance(*cylinder.ends)], **along_stroke(crane, stroke, at))
        return np.minimum(length - least, most - length)

    grid = np.linspace(start, end, 65)
    inside = slack(grid) >= 0.0
    if not inside.any():
        length = crane.at(**along_stroke(crane, stroke, grid)).distance(*cylinder.ends)
        goes = f"{np.min(length) / mm:.1f} to {np.max(length) / mm:.1f} mm"
        raise DefinitionError(f"{cylinder.name} is never as long as {stroke} needs, {goes}; take another closed length or other pins.")
    if inside.all():
        return start, end
    first, last = int(np.argmax(inside)), inside.size - 1 - int(np.argmax(inside[::-1]))
    ends = [(grid[max(first - 1, 0)], grid[first]), (grid[min(last + 1, grid.size - 1)], grid[last])]
    outside, good = np.array(ends).T
    for _ in range(50):
        middle = 0.5 * (outside + good)
        fits = slack(middle) >= 0.0
        good, outside = np.where(fits, middle, good), np.where(fits, outside, middle)
    return float(good[0]) if first else start, float(good[1]) if last < grid.size - 1 else end
