"""The solution of a plan's groups for designs and strokes: from the sketch, along the stroke, on one branch, one group after the other."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt

from ..errors import SingularError
from ..plan import Plan
from ..program import FloatArray
from ..vectors import Numbers
from .group_continuation import GroupPath, InputRoute, Lanes
from .newton import Newton, at_sketch, lost_at_sketch

SAMPLED = 1024
NEARBY = 0.05
STEPS = 32
"""The steps of a way over a stroke are at most so many parts of it, and of an angle a tenth of a radian."""
ANGLE = 0.1
KEPT = 64
"""The designs of a plan whose tracks are kept."""
LINE = 1.0 / 8
"""The largest step of a straight way from the sketch to a pose of several strokes, or from the class's design to another."""


class GroupSolution(NamedTuple):
    """The inputs that groups' solutions supply, shape (designs, poses), and the group whose branches cross on the way, counted from 1."""

    inputs: Mapping[str, FloatArray]
    crossed: npt.NDArray[np.int_]
    stops: tuple[float, ...] = ()
    """Where the ways of a single design ended before the last value asked for, along its one stroke."""


def solve_groups(plan: Plan, designs: Mapping[str, Numbers], strokes: Mapping[str, FloatArray]) -> GroupSolution:
    """Return the pins of all groups for designs (float or (m,)) and strokes (n,); NaN where they cannot be reached.

    SingularError where they are drawn in a dead point. Where the sketch cannot be assembled no pose is reached.
    """
    lost = lost_at_sketch(plan)
    if isinstance(lost, SingularError):
        raise lost.with_traceback(None)
    if lost is not None:
        shape = (max(map(np.size, designs.values()), default=1), max(map(np.size, strokes.values()), default=1))
        return GroupSolution(dict.fromkeys(plan.grouped, np.full(shape, np.nan)), np.zeros(shape, int))
    newtons = [Newton(plan, group) for group in plan.groups.values()]
    designs = singled(designs)
    start, tracks = known_tracks(plan, newtons, designs)
    n = max((np.size(value) for value in strokes.values()), default=1)
    shape = (start[0].shape[1], n)
    if len(strokes) == 1:
        ((name, values),) = strokes.items()
        pins, crossed, stops = along_one(plan, newtons, (start, tracks), designs, name, values)
    else:
        ways = {name: (plan.sketch_strokes[name], np.asarray(value) - plan.sketch_strokes[name]) for name, value in strokes.items()}
        count = shape[0] * n
        found = group_paths(
            newtons, InputRoute(designs, ways, n), [np.repeat(each, n, axis=1) for each in start], np.ones(count), LINE, exact=True
        )
        pins, crossed = [np.where(np.isinf(track.ended), track.u[:, track.last], np.nan) for track in found], np.zeros(count, int)
        for number, track in enumerate(found, 1):
            crossed = np.where((crossed == 0) & track.crossed, number, crossed)
        stops = ()
    inputs: dict[str, FloatArray] = {}
    for newton, u in zip(newtons, pins, strict=True):
        places = u.reshape(len(newton.names), *shape)
        sine = sines(newton, {**designs, **strokes, **inputs}, strokes, places)
        inputs |= dict(zip(newton.names, places, strict=True))
        inputs[newton.group.inputs[-1]] = sine
    return GroupSolution(inputs, np.broadcast_to(crossed.reshape(shape), shape), stops)


def singled(designs: Mapping[str, Numbers]) -> dict[str, Numbers]:
    """Return dimensions as floats, and as arrays (m,) where they differ from design to design."""
    flat = {name: np.ravel(np.asarray(value, float)) for name, value in designs.items()}
    return {name: float(value[0]) if value.size == 1 else value for name, value in flat.items()}


Known: TypeAlias = tuple[list[FloatArray], dict[tuple[str, float], list[GroupPath]]]
"""What is known of some designs: their groups' pins at the sketch, and the tracks along a stroke, by its name and sense."""


def known_tracks(plan: Plan, newtons: Sequence[Newton], designs: Mapping[str, Numbers]) -> Known:
    """Return the tracks known of some designs; the last single designs of a plan are cached."""
    if any(map(np.ndim, designs.values())):
        return designed(plan, newtons, designs), {}
    every: dict[tuple[float, ...], Known] = plan.made("tracks", lambda _: {})
    key = tuple(float(designs[name]) for name in plan.defaults)
    found = every.get(key)
    if found is None:
        found = every[key] = designed(plan, newtons, designs), {}
        for old in list(every)[:-KEPT]:
            every.pop(old, None)
    return found


# -- where the ways begin -------------------------------------------------------------------------------------


def designed(plan: Plan, newtons: Sequence[Newton], designs: Mapping[str, Numbers]) -> list[FloatArray]:
    """Return the pins of every group at the sketch for all designs, continued from the class's, shape (coordinates, m)."""
    base = at_sketch(plan)
    changed = {name: np.asarray(value, float) for name, value in designs.items() if np.ndim(value) or value != plan.defaults[name]}
    m = max((value.size for value in changed.values() if value.ndim), default=1)
    start = [np.repeat(base[newton.group.name], m, axis=1) for newton in newtons]
    if not changed:
        return start
    ways = {name: (plan.defaults[name], value - plan.defaults[name]) for name, value in changed.items()}
    route = InputRoute({**plan.defaults, **plan.sketch_strokes}, ways, m)
    found = group_paths(newtons, route, start, np.ones(m), LINE, exact=True)
    return [np.where(np.isinf(track.ended), track.u[:, track.last], np.nan) for track in found]


def group_paths(
    newtons: Sequence[Newton],
    route: InputRoute,
    start: Sequence[FloatArray],
    goal: FloatArray,
    largest: float,
    *,
    exact: bool,
    begun: Sequence[GroupPath] = (),
) -> list[GroupPath]:
    """Return the ways of all groups, each followed with the ones before it known; tracks that were begun go on."""
    found: list[GroupPath] = []
    for place, (newton, u) in enumerate(zip(newtons, start, strict=True)):
        # the next one's steps may go beyond the goal by one
        far = goal if exact else goal + (len(newtons) - 1 - place) * largest
        if begun:
            found.append(begun[place].onward(list(found), far))
        else:
            lanes = Lanes(np.arange(len(goal)), np.zeros(len(goal)), u.copy(), far, np.full(len(goal), largest), exact)
            found.append(GroupPath(newton, route, list(found), lanes))
    return found


# -- the ways -------------------------------------------------------------------------------------------------


def largest_step(plan: Plan, name: str) -> float:
    """Return the largest step along a stroke."""
    stroke = plan.strokes[name]
    step = abs(stroke.end - stroke.start) / STEPS or 1.0
    return min(step, ANGLE) if name in plan.turning else step


Found = tuple[list[FloatArray], npt.NDArray[np.int_], tuple[float, ...]]


def along_one(
    plan: Plan, newtons: Sequence[Newton], known: Known, designs: Mapping[str, Numbers], name: str, values: FloatArray
) -> Found:
    """Return the pins of every group over one stroke, shape (coordinates, m * n), the crossed groups, and a single design's ends."""
    (start, tracks), values = known, np.ravel(values)
    m = start[0].shape[1]
    u = [np.empty((len(each), m, len(values))) for each in start]
    crossed = np.zeros((m, len(values)), int)
    stops: list[float] = []
    up = values >= plan.sketch_strokes[name]
    for sense, poses in ((1.0, np.flatnonzero(up)), (-1.0, np.flatnonzero(~up))):
        if not poses.size:
            continue
        side = slice(poses[0], poses[-1] + 1) if poses[-1] - poses[0] + 1 == poses.size else poses
        sketch, largest = plan.sketch_strokes[name], largest_step(plan, name)
        route, place = InputRoute(designs, {name: (sketch, sense)}), np.abs(values[side] - sketch)
        begun = tracks.get((name, sense), ())
        found = group_paths(newtons, route, start, np.full(m, float(place.max())), largest, exact=False, begun=begun)
        tracks[name, sense] = found
        lane, at = np.repeat(np.arange(m), len(place)), np.tile(place, m)
        for number, track in enumerate(found):
            u[number][:, :, side] = track.pins_at(lane, at).reshape(-1, m, len(place))
            if track.crossed.any():
                beyond = (track.crossed & np.isfinite(track.ended))[:, None] & (place[None, :] > track.ended[:, None])
                crossed[:, side] = np.where((crossed[:, side] == 0) & beyond, number + 1, crossed[:, side])
        ended = min(float(track.ended[0]) for track in found)
        if m == 1 and 0.0 <= ended < place.max():
            stops.append(sketch + sense * ended)
    return [each.reshape(len(each), -1) for each in u], crossed, tuple(stops)


def sines(newton: Newton, inputs: Mapping[str, Numbers], strokes: Mapping[str, FloatArray], u: FloatArray) -> FloatArray:
    """Return how near every pose is to a singular one, shape (designs, poses).

    Of many poses along one stroke a sample is worked out and the rest read between its values, except near a singular pose.
    """
    n = u.shape[2]
    if n <= SAMPLED or len(strokes) != 1:
        return newton.sine(inputs, u)

    def at(places: npt.NDArray[np.intp]) -> FloatArray:
        along = {name: np.asarray(value) for name, value in inputs.items() if name not in newton.plan.defaults and np.size(value) > 1}
        moving = {name: value[..., places] for name, value in along.items()}
        return newton.sine({**inputs, **moving}, u[:, :, places])

    ((_, values),) = strokes.items()
    order = np.argsort(values, kind="stable")
    sample = order[np.unique(np.linspace(0, n - 1, SAMPLED).astype(int))]
    found = np.array([np.interp(values, values[sample], row) for row in at(sample)])
    close = np.flatnonzero(~(found > NEARBY).all(axis=0))
    if close.size:
        found[:, close] = at(close)
    return np.where(np.isfinite(u).all(axis=0), found, np.nan)
