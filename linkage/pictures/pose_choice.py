"""The angles at which a machine that turns round is drawn: where its picture is open, and at the ends of its featured column."""

from __future__ import annotations

from itertools import combinations, product

import numpy as np

from ..errors import LinkageError, unwarned
from ..mechanism import Mechanism
from ..motion import Motion
from ..program import FloatArray
from ..reports import At, column_among, is_changing, results
from .scene import Scene

STEP, FINE = 10, 10
"""Degrees between the angles that are tried, and steps into which each is divided to find where something turns back."""
CLEAR = 10.0
"""Degrees that the bold pose keeps from a dead point."""
ROOM = 6.0
"""Pins that stand so many sizes apart, or as far as the machine allows, have room for their names."""
SEPARATE = 30.0
"""Degrees that the poses stand apart from each other."""
FEW = 4
"""Of more moving bodies one faint pose is drawn, not two."""


def telling_angles(machine: Mechanism, stroke: str, values: At) -> FloatArray:
    """Return the angles of a stroke that goes round at which the machine is drawn, the bold pose last [rad].

    That one is the most open of those a step apart that keep clear of dead points. The others are where what the machine is about is
    least and greatest; where that does not change or stands too near, the opposite pose. `values` hold the other strokes [SI].
    """
    start, end = machine.strokes[stroke].start, machine.strokes[stroke].end
    steps = max(1, round(abs(end - start) / np.radians(STEP)))
    still = {name: float(np.ravel(value)[-1]) for name, value in values.items() if name != stroke}
    finely = machine.at(unreachable="nan", **still | {stroke: np.linspace(start, end, steps * FINE + 1)})
    if finely.reached.sum() < 2:
        return np.array([0.5 * (start + end), start])
    tried = machine.at(unreachable="nan", **still | {stroke: np.linspace(start, end, steps + 1)[:-1]})
    scene = Scene(tried, finely)
    dead: list[float] = []  # where pins turn back, as shares of the round: the dead points of links that rock or slide
    for name in finely.plan.points:
        path = finely[name].reshape(2, -1)
        going = np.diff(path, axis=1)
        going = np.concatenate([going, going[:, :1]], axis=1)
        is_back = (going[:, 1:] * going[:, :-1]).sum(axis=0) < 0.0
        if np.nanmax(np.ptp(path, axis=1), initial=0.0) > 0.0:
            dead += ((np.flatnonzero(is_back) + 1.0) / (steps * FINE)).tolist()
    bold = most_open(tried, scene, np.unique(dead))
    others = faint_poses(machine, tried, bold)
    shown = others if len(scene.bodies) <= FEW else others[-1:]
    return np.asarray(np.ravel(tried.strokes[stroke])[[*shown, bold]])


def faint_poses(machine: Mechanism, tried: Motion, bold: int) -> list[int]:
    """Return up to two poses beside the bold one: the ends of the featured column, the farther one last, else the opposite one."""
    steps, reached = tried.reached.size, tried.reached.ravel()
    found: list[int] = []
    try:
        with unwarned():
            values = column_among(machine, results(machine, tried), None).drawn
    except LinkageError:  # what the machine is about is not to be had
        values = np.zeros(1)
    ends = [int(np.nanargmin(values)), int(np.nanargmax(values))] if is_changing(values) else []
    for pose in sorted(ends, key=lambda pose: -int(way_round(pose, bold, steps))):
        if min(STEP * way_round(pose, other, steps) for other in [bold, *found]) >= SEPARATE:
            found.append(pose)
    opposite = (bold + steps // 2) % steps
    return found[::-1] or [opposite] * bool(reached[opposite])


def way_round(one: FloatArray | float, other: FloatArray | float, steps: float) -> FloatArray:
    """Return how many steps two poses of a round of so many are apart, the shorter way."""
    return np.asarray(np.minimum(np.abs(one - other), steps - np.abs(one - other)))


def most_open(tried: Motion, scene: Scene, dead: FloatArray) -> int:
    """Return the pose, among those that keep clear of dead points [shares of the round] and of crowded pins, that is most open."""
    poses = tried.reached.size
    shares = np.arange(poses) / poses
    degrees = STEP * poses * np.min([way_round(shares, each, 1.0) for each in dead] or [np.ones(poses)], axis=0)
    places = [scene.places[name] for name in (*scene.pins, *scene.dots)]
    apart = np.array([np.hypot(*(P - Q)) for P, Q in combinations(places, 2)])
    there = apart[:, tried.reached.ravel()]
    apart = apart[np.ptp(there, axis=1) > 1e-9 * np.max(there)]  # not what stays together
    nearest = np.min(apart, axis=0, initial=np.inf) if apart.size else np.full(poses, np.inf)
    best = float(np.nanmax(np.where(tried.reached.ravel(), nearest, np.nan)))
    is_roomy = nearest >= min(ROOM * scene.size, 0.8 * best) * (1.0 - 1e-9)
    is_clear = degrees > CLEAR
    for allowed in (is_roomy & is_clear, is_clear, is_roomy, np.ones(poses, bool)):
        allowed = allowed & tried.reached.ravel()
        if allowed.any():
            break
    # How open the angles at the joints are at every pose: the sine of the least open one that changes, and of all. An angle is between
    # two bodies at a pin that they share, or one of them and the frame or a track.
    at, sines = scene.places | scene.rims, []
    bodies = [*map(set, scene.bodies), *({each.P, each.Q} for each in scene.two_force), set(scene.grounds)]
    bodies += [{rider, track.ends[1]} for track in scene.tracks for rider in track.riders]
    pins = ((pin, one - {pin}, other - {pin}) for one, other in combinations(bodies, 2) for pin in one & other)
    for one, other in ((at[P] - at[pin], at[Q] - at[pin]) for pin, *ends in pins for P, Q in product(*ends)):
        long = np.hypot(*one) * np.hypot(*other)
        across = np.abs(one[0] * other[1] - one[1] * other[0]) / np.where(long > 0.0, long, np.inf)
        if np.ptp(across[np.isfinite(across)]) > 1e-6:
            sines.append(np.nan_to_num(across))
    open_by = np.min(sines, axis=0) + 0.3 * np.mean(sines, axis=0) if sines else np.zeros(scene.motion.reached.size)
    open_by = open_by * (np.minimum(nearest / best, 1.0) if 0.0 < best < np.inf else 1.0)
    return int(np.argmax(np.where(allowed, open_by, -np.inf)))
