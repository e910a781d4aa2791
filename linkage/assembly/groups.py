"""The solution of a plan's groups for designs and strokes: from the sketch, along the stroke, on one branch, one group after the other."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from ..errors import AssemblyError
from ..plan import Plan, strokes_text
from ..program import FloatArray
from ..steps import Pin
from ..units import mm
from .newton import Newton
from .path import Index, Lanes, Route, Track

SAMPLED = 1024
NEARBY = 0.05
STEPS = 32
"""The steps of a way over a stroke are at most so many parts of it, and of an angle a tenth of a radian."""
ANGLE = 0.1
KEPT = 64
"""The designs of a plan whose tracks are kept."""
LINE = 1.0 / 8
"""The largest step of a straight way from the sketch to a pose of several strokes, or from the class's design to another."""


@dataclass(frozen=True)
class Solved:
    """The inputs that groups' solutions supply, shape (designs, poses), and the group whose branches cross on the way, counted from 1."""

    inputs: Mapping[str, FloatArray]
    crossed: npt.NDArray[Any]
    stops: tuple[float, ...] = ()
    """Where the ways of a single design ended before the last value asked for, along its one stroke."""


def solve_groups(plan: Plan, designs: Mapping[str, Any], strokes: Mapping[str, FloatArray]) -> Solved:
    """Return the pins of all groups for designs (float or (m,)) and strokes (n,); NaN where they cannot be reached."""
    newtons = [Newton(plan, group) for group in plan.groups.values()]
    if all(np.size(value) == 1 for value in designs.values()):
        designs = {name: float(np.ravel(value)[0]) if np.ndim(value) else value for name, value in designs.items()}
    kept = known(plan, newtons, designs)
    n = max((np.size(value) for value in strokes.values()), default=1)
    shape = (kept.start[0].shape[1], n)
    if len(strokes) == 1:
        ((name, values),) = strokes.items()
        solved = along_one(plan, newtons, kept, designs, name, values)
    else:
        solved = along_many(newtons, kept.start, LineRoute(plan, designs, strokes, n), shape[0] * n)
    found, crossed, stops = solved
    inputs: dict[str, FloatArray] = {}
    for newton, u in zip(newtons, found, strict=True):
        sine = sines(newton, {**designs, **strokes, **inputs}, strokes, u.reshape(-1, *shape))
        inputs |= dict(zip(newton.names, u.reshape(-1, *shape), strict=True))
        inputs[newton.group.inputs[-1]] = sine
    return Solved(inputs, np.broadcast_to(crossed.reshape(shape), shape), stops)


@dataclass
class Known:
    """What is known of some designs: their groups' pins at the sketch, and the tracks along a stroke, by its name and sense."""

    start: list[FloatArray]
    tracks: dict[tuple[str, float], list[Track]]


def known(plan: Plan, newtons: Sequence[Newton], designs: Mapping[str, Any]) -> Known:
    """Return what is known of some designs; of a single one it is kept, the last ones of a plan."""
    if any(map(np.ndim, designs.values())):
        return Known(designed(plan, newtons, designs), {})
    every: dict[tuple[float, ...], Known] = plan.made("tracks", lambda _: {})
    key = tuple(float(designs[name]) for name in plan.defaults)
    found = every.get(key)
    if found is None:
        found = every[key] = Known(designed(plan, newtons, designs), {})
        for old in list(every)[:-KEPT]:
            every.pop(old, None)
    return found


# -- where the ways begin -------------------------------------------------------------------------------------


def at_sketch(plan: Plan) -> dict[str, FloatArray]:
    """Return the pins of every group at the sketch, default dimensions, shape (coordinates, 1); AssemblyError where it is out of reach."""
    inputs: dict[str, Any] = plan.defaults | plan.sketch_strokes
    found: dict[str, FloatArray] = {}
    for name, group in plan.groups.items():
        pins = [plan.of_kind(Pin)[pin] for pin in group.pins]
        newton = Newton(plan, group)
        rough = np.array([part for pin in pins for part in pin.sketched]).reshape(-1, 1)
        found[name], done, missing = newton.start(inputs, rough)
        if not done:
            names = " ".join(pin.name for pin in pins)
            strokes = strokes_text(plan, plan.sketch_strokes)
            gap = f"{missing / mm:.3g} mm are missing" if np.isfinite(missing) else "their equations have no value"
            raise AssemblyError(
                f"{plan.title}: the pins {names} cannot be assembled from their sketch at {strokes}: {gap} in "
                "the nearest pose. Move their near=(x, y) closer to the real pose, or change a length.",
                point=pins[0].name, mask=np.ones((), bool), shortfall=missing,
            )  # fmt: skip
        inputs |= dict(zip(newton.names, found[name], strict=True))
    return found


def designed(plan: Plan, newtons: Sequence[Newton], designs: Mapping[str, Any]) -> list[FloatArray]:
    """Return the pins of every group at the sketch for all designs, continued from the class's, shape (coordinates, m)."""
    base = plan.made("sketch", at_sketch)
    changed = {name: np.asarray(value, float) for name, value in designs.items() if np.ndim(value) or value != plan.defaults[name]}
    m = max((value.size for value in changed.values() if value.ndim), default=1)
    start = [np.repeat(base[newton.group.name], m, axis=1) for newton in newtons]
    if not changed:
        return start
    found = tracks(newtons, DesignRoute(plan, changed), start, np.ones(m), LINE, exact=True)
    return [np.where(np.isinf(track.ended), track.u[:, track.last], np.nan) for track in found]


def tracks(
    newtons: Sequence[Newton],
    route: Route,
    start: Sequence[FloatArray],
    goal: FloatArray,
    largest: float,
    *,
    exact: bool,
    begun: Sequence[Track] = (),
) -> list[Track]:
    """Return the ways of all groups, each followed with the ones before it known; tracks that were begun go on."""
    found: list[Track] = []
    for place, (newton, u) in enumerate(zip(newtons, start, strict=True)):
        # the next one's steps may go beyond the goal by one
        far = goal if exact else goal + (len(newtons) - 1 - place) * largest
        if begun:
            found.append(begun[place].onward(list(found), far))
        else:
            lanes = Lanes(np.arange(len(goal)), np.zeros(len(goal)), u.copy(), far, largest, exact)
            found.append(Track(newton, route, list(found), lanes))
    return found


# -- the ways -------------------------------------------------------------------------------------------------


class DesignRoute:
    """From the class's design at place 0 to others at place 1, at the sketch."""

    def __init__(self, plan: Plan, changed: Mapping[str, FloatArray]) -> None:
        self.fixed: dict[str, Any] = plan.defaults | plan.sketch_strokes
        self.moved = {name: (plan.defaults[name], value.ravel() - plan.defaults[name]) for name, value in changed.items()}

    def inputs(self, lane: Index, place: FloatArray) -> dict[str, Any]:
        """Return the inputs at places of lanes, one a design."""
        moved = {name: old + place * (change if change.size == 1 else change[lane]) for name, (old, change) in self.moved.items()}
        return self.fixed | moved


class StrokeRoute:
    """Along one stroke, a lane for every design: upwards from the sketch, or downwards."""

    def __init__(self, plan: Plan, designs: Mapping[str, Any], name: str, sense: float) -> None:
        self.plan, self.designs, self.name, self.sense = plan, designs, name, sense
        self.sketch = plan.sketch_strokes[name]

    @property
    def largest(self) -> float:
        """The largest step."""
        stroke = self.plan.strokes[self.name]
        step = abs(stroke.end - stroke.start) / STEPS or 1.0
        return min(step, ANGLE) if self.name in self.plan.turning else step

    def value(self, place: Any) -> Any:
        """Return the stroke at places."""
        return self.sketch + self.sense * place

    def inputs(self, lane: Index, place: FloatArray) -> dict[str, Any]:
        """Return the inputs at places of lanes."""
        return of_designs(self.designs, lane) | {self.name: self.value(place)}


class LineRoute:
    """To poses of several strokes, each along its own straight line from the sketch: a lane for every design and pose."""

    def __init__(self, plan: Plan, designs: Mapping[str, Any], strokes: Mapping[str, FloatArray], n: int) -> None:
        self.designs, self.n = designs, n
        self.ways = {name: (plan.sketch_strokes[name], np.ravel(value) - plan.sketch_strokes[name]) for name, value in strokes.items()}

    def inputs(self, lane: Index, place: FloatArray) -> dict[str, Any]:
        """Return the inputs at places of lanes."""
        found = of_designs(self.designs, lane // self.n)
        return found | {name: start + place * (way if way.size == 1 else way[lane % self.n]) for name, (start, way) in self.ways.items()}


def of_designs(designs: Mapping[str, Any], row: Index) -> dict[str, Any]:
    """Return the dimensions of some designs: floats, or arrays like the rows."""
    return {name: value if np.ndim(value) == 0 else np.ravel(value)[row if np.size(value) > 1 else 0] for name, value in designs.items()}


Found = tuple[list[FloatArray], npt.NDArray[Any], tuple[float, ...]]


def along_one(
    plan: Plan, newtons: Sequence[Newton], known: Known, designs: Mapping[str, Any], name: str, values: FloatArray
) -> Found:
    """Return the pins of every group over one stroke, shape (coordinates, m * n), what crossed, and where a single design's ways end."""
    start, m, values = known.start, known.start[0].shape[1], np.ravel(values)
    u = [np.full((len(each), m, len(values)), np.nan) for each in start]
    crossed = np.zeros((m, len(values)), int)
    stops: list[float] = []
    up = values >= plan.sketch_strokes[name]
    for sense, side in ((1.0, up), (-1.0, ~up)):
        if not side.any():
            continue
        route = StrokeRoute(plan, designs, name, sense)
        place = np.abs(values[side] - route.sketch)
        begun = known.tracks.get((name, sense), ())
        found = tracks(newtons, route, start, np.full(m, float(place.max())), route.largest, exact=False, begun=begun)
        known.tracks[name, sense] = found
        lane, at = np.repeat(np.arange(m), len(place)), np.tile(place, m)
        for number, track in enumerate(found):
            u[number][:, :, side] = track.at(lane, at).reshape(-1, m, len(place))
            beyond = (track.crossed & np.isfinite(track.ended))[:, None] & (place[None, :] > track.ended[:, None])
            crossed[:, side] = np.where((crossed[:, side] == 0) & beyond, number + 1, crossed[:, side])
        ended = min(float(track.ended[0]) for track in found)
        if m == 1 and 0.0 <= ended < place.max():
            stops.append(float(route.value(ended)))
    return [each.reshape(len(each), -1) for each in u], crossed, tuple(stops)


def along_many(newtons: Sequence[Newton], start: Sequence[FloatArray], route: LineRoute, count: int) -> Found:
    """Return the pins of every group at poses of several strokes, shape (coordinates, m * n), and what crossed."""
    crossed = np.zeros(count, int)
    found = tracks(newtons, route, [np.repeat(each, route.n, axis=1) for each in start], np.ones(count), LINE, exact=True)
    u = []
    for number, track in enumerate(found):
        arrived = np.isinf(track.ended)
        u.append(np.where(arrived, track.u[:, track.last], np.nan))
        crossed = np.where((crossed == 0) & track.crossed, number + 1, crossed)
    return u, crossed, ()


def sines(newton: Newton, inputs: Mapping[str, Any], strokes: Mapping[str, FloatArray], u: FloatArray) -> FloatArray:
    """Return how near every pose is to a singular one, shape (designs, poses).

    Of many poses along one stroke a sample is worked out and the rest read between its values, except near a singular pose.
    """
    _, m, n = u.shape

    def at(places: Any) -> FloatArray:
        chosen = {}
        for name, value in inputs.items():
            if np.ndim(value) == 2:
                chosen[name] = np.broadcast_to(value, (m, n))[:, places].ravel()
            elif name in strokes:
                chosen[name] = np.tile(np.broadcast_to(np.ravel(value), (n,))[places], m)
            else:
                size = len(np.arange(n)[places])
                chosen[name] = value if np.ndim(value) == 0 else np.repeat(np.broadcast_to(np.ravel(value), (m,)), size)
        return newton.sine(chosen, u[:, :, places].reshape(len(u), -1)).reshape(m, -1)

    if n <= SAMPLED or len(strokes) != 1:
        return at(slice(None))
    ((_, values),) = strokes.items()
    order = np.argsort(values, kind="stable")
    sample = order[np.unique(np.linspace(0, n - 1, SAMPLED).astype(int))]
    found = np.array([np.interp(values, values[sample], row) for row in at(sample)])
    close = np.flatnonzero(~(found > NEARBY).all(axis=0))
    if close.size:
        found[:, close] = at(close)
    return np.where(np.isfinite(u).all(axis=0), found, np.nan)
