"""The load map: the greatest load at the tip at every radius and height, what limits it, and where the telescope carries it.

A load at the tip is carried as far as no cylinder needs more than its pump gives, on the side that works there; the machine's own
weights count. At every place the telescope stands where that is most. All poses go through the machine's own statics, in few calls.
It stays beside `working_field`: the drives end where the design and the cylinders' lengths say, not at the ends of declared strokes.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hydraulics import Cylinder
from hydraulics.inputs import all_finite, one_number, positive
from linkage import Column, DefinitionError, LoadCase, distance, drive_force, ratio
from linkage.errors import known_name
from linkage.language import noted
from linkage.loads.point import on_slope
from linkage.program import FloatArray
from linkage.statics.carried import largest

from .cylinders import PLAY, sides
from .machine import DRIVEN, Crane
from .moments import LIFTING
from .reach import Flags, Reach

OUT_OF_REACH = "out of reach"
LIMITERS = ("boom cylinder", "arm cylinder", "telescope cylinder", "stability", "rated load", OUT_OF_REACH)
"""What may limit a load."""

FIRST, ROUNDS, NEAR = 17, 6, 4
"""Positions of the telescope in the first look, rounds of looking closer, positions on either side of the best one in each."""


@final
@dataclass(frozen=True, eq=False)
class LoadMap:
    """The greatest load [N] at the tip, shape (heights, radii), NaN out of reach; `limiter` names what limits it, of LIMITERS.

    phi, psi [rad] and t [m] are the pose that carries it; `at_stop` tells where the telescope stands at an end of its stroke.
    """

    heights: FloatArray
    radii: FloatArray
    load: FloatArray
    limiter: NDArray[np.str_]
    phi: FloatArray
    psi: FloatArray
    t: FloatArray
    at_stop: Flags

    def columns(self) -> list[Column]:
        """Return the map as a table, a row each radius: the load [kN] at each height."""
        loads = [Column(f"y {height:.4g}", self.load[k], "kN", 2) for k, height in enumerate(self.heights)]
        return [Column(noted("radius"), self.radii, "m", 2), *loads]


def load_map(
    crane: Crane,
    heights: ArrayLike,
    radii: ArrayLike,
    *,
    stability: float | None = None,
    rated: float | None = None,
    case: str = LIFTING,
) -> LoadMap:
    """Return the load map over heights and radii [m] of the tip, from the ground and from the column's axis; of one design.

    `stability` is the moment about the column's axis that the vehicle stands [N m], the crane's own weights included; `rated` a load
    [N] that is not exceeded. DefinitionError for a batch, and for places that are no numbers.
    """
    places = [np.atleast_1d(all_finite(each, what)) for each, what in ((heights, "heights"), (radii, "radii"))]
    if any(each.ndim > 1 for each in places):
        raise DefinitionError("A load map goes over heights and radii: give each as numbers in a row [m], such as np.linspace(-1, 8, 14).")
    if any(np.ndim(value) for value in crane.dimensions.values()):
        raise DefinitionError(f"{crane.plan.title}: a load map is of one design, this is a batch; choose one of them.")
    y, x = (each.ravel() for each in np.meshgrid(*places, indexing="ij"))
    known_name("Load case", case, crane.plan.of_kind(LoadCase))
    carrying = Carrying(crane, Limits(stability, rated), case)
    return best_of(carrying, x, y, places)


@final
@dataclass(frozen=True)
class Limits:
    """What limits a load beside the cylinders: the vehicle's moment [N m], a rated load [N]; None for no such limit."""

    stability: float | None = None
    rated: float | None = None

    def __post_init__(self) -> None:
        for value, what in ((self.stability, "stability"), (self.rated, "rated")):
            if value is not None:
                positive(one_number(value, what), what)


@final
class Carrying:
    """What one crane carries at its tip against a `pull` of one newton, by default a load's down the slope of the load case."""

    def __init__(self, crane: Crane, limits: Limits, case: str, pull: tuple[float, float] | None = None) -> None:
        self.crane, self.limits, self.reach = crane.replaced(Q=0.0), limits, Reach(crane)
        pose = crane.position(1)
        self.sides = {stroke: sides(pose, stroke) for stroke in DRIVEN}
        down = on_slope((0.0, -1.0), crane.plan.of_kind(LoadCase)[case].slope)
        self.pull = np.array(down if pull is None else pull)
        rams = crane.plan.of_kind(Cylinder)
        self.requests = [
            each
            for stroke, (ram, _) in DRIVEN.items()
            for each in (drive_force(stroke, case=case), ratio("T", wrt=stroke), ratio(distance(*rams[ram].ends), wrt=stroke))
        ]

    def __call__(self, phi: FloatArray, psi: FloatArray, t: FloatArray) -> FloatArray:
        """Return the greatest load that each limit leaves, shape (limits, ...) [N], in the order of LIMITERS; infinite for none."""
        most = np.full((5, *t.shape), np.inf)
        if not t.size:
            return most
        flat = self.crane.evaluate(self.requests, phi=phi.ravel(), psi=psi.ravel(), t=t.ravel())
        found = [each.reshape(*each.shape[:-1], *t.shape) for each in flat]
        for k, stroke in enumerate(DRIVEN):
            force, way, grows = found[3 * k : 3 * k + 3]
            with np.errstate(divide="ignore", invalid="ignore"):  # a cylinder at its dead point holds nothing
                own, share = force / grows, -along(self.pull, way) / grows
            most[k] = np.where(grows == 0.0, 0.0, largest(own, share, *self.sides[stroke].bounds))
        if self.limits.stability is not None:
            share = along(self.pull, found[1])  # all turns about O, on the axis, with phi
            most[3] = largest(-found[0], share, np.asarray(-np.inf), np.asarray(self.limits.stability))
        if self.limits.rated is not None:
            most[4] = self.limits.rated
        return most


def along(direction: FloatArray, way: FloatArray) -> FloatArray:
    """Return how far a way, shape (2, ...), goes along a direction of length one."""
    return np.asarray(direction[0] * way[0] + direction[1] * way[1])


def best_of(carrying: Carrying, x: FloatArray, y: FloatArray, places: Sequence[FloatArray]) -> LoadMap:
    """Return the map over places, each with the telescope where it carries most, of all windows in which the tip can be there."""
    found = carrying.reach.windows(x, y)
    t, step = np.linspace(found.low, found.high, FIRST), (found.high - found.low) / (FIRST - 1)
    for look in range(ROUNDS + 1):
        phi, psi = carrying.reach.angles(x[found.place], y[found.place], t, found.elbow)
        most = carrying(phi, psi, t)
        best = np.argmax(most.min(axis=0), axis=0)[None]
        at = np.take_along_axis(t, best, 0)[0]
        if look < ROUNDS:
            t = np.clip(at + np.linspace(-step, step, 2 * NEAR + 1), found.low, found.high)
            step = step / NEAR
    pose = [np.take_along_axis(each, best, 0)[0] for each in (phi, psi, t)]
    limits = np.take_along_axis(most, best[None], 1)[:, 0]
    return gathered(found.place, limits, pose, carrying.reach.limits["t"], places)


def gathered(
    place: NDArray[np.int64], limits: FloatArray, pose: Sequence[FloatArray], stops: tuple[float, float], places: Sequence[FloatArray]
) -> LoadMap:
    """Return the best window of every place as a map; `limits` has shape (limits, windows)."""
    heights, radii = places
    shape, count = (heights.size, radii.size), heights.size * radii.size
    load = limits.min(axis=0)
    order = np.argsort(load, kind="stable")  # of several windows of a place the last one counts
    chosen = np.full(count, -1)
    chosen[place[order]] = order
    there = chosen >= 0

    def full(values: FloatArray) -> FloatArray:
        spread = np.full(count, np.nan)
        spread[there] = values[chosen[there]]
        return spread.reshape(shape)

    limiter = np.full(count, OUT_OF_REACH, dtype="<U18")
    limiter[there] = np.array(LIMITERS)[np.argmin(limits, axis=0)[chosen[there]]]
    phi, psi, t = (full(each) for each in pose)
    at_stop = (t <= stops[0] + PLAY) | (t >= stops[1] - PLAY)
    return LoadMap(heights, radii, full(load), limiter.reshape(shape), phi, psi, t, at_stop)
