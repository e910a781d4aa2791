"""Motions looked at along one stroke: the limits of a design, and change points between the poses of a sweep."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from ..errors import DefinitionError, SingularError
from ..program import FloatArray
from ..steps import Pin, Point
from ..units import deg
from .limits import TOUCH as TOUCH
from .limits import Held, Scanned, StrokeLimits, deepest, intervals, search
from .limits import Limits as Limits
from .reach import called, failures, stroke_unit, where_words
from .still import dead_points
from .strokes import check_any
from .transmission import transmission
from .turns import open_turn

if TYPE_CHECKING:
    from .motion import Motion

WATCHED = 20_000

Moved = Callable[[Mapping[str, Any]], "Motion"]
"""The motion at other strokes, unreachable poses as NaN."""


def limits(motion: Motion) -> Limits:
    """Return the limits along every stroke of one design; other strokes are held at the motion's first values."""
    if motion.design_shape:
        title, shape = motion.plan.title, motion.design_shape
        raise DefinitionError(f"{title}: limits are worked out for one design at a time; this motion has {shape}.")
    check_any(motion.strokes, motion.plan)
    held = {name: float(np.ravel(value)[0]) for name, value in motion.strokes.items()}
    return Limits({name: stroke_limits(motion, name, held) for name in motion.strokes})


def stroke_limits(motion: Motion, name: str, held: Mapping[str, float]) -> StrokeLimits:
    """Return the limits along one stroke, looked for one span beyond its declared range, a crank over a full turn."""
    stroke = motion.plan.strokes[name]
    unit = stroke_unit(motion.plan, name)
    start, end = min(stroke.start, stroke.end), max(stroke.start, stroke.end)
    span = end - start
    turn = max(0.0, np.pi - 0.5 * span)
    low, high = (start - span, end + span) if unit == "m" else (start - turn, end + turn)
    found, touches = search(scanner(motion.moved, name, held), low, high)
    crossings = tuple((value, called(motion.plan, step)) for value, step in touches)
    others = tuple(Held(each, value, stroke_unit(motion.plan, each)) for each, value in held.items() if each != name)
    least = transmission(motion, name, held, found)
    turns = open_turn(motion, name, held, found) if unit == "rad" else None
    still = dead_points(motion, name, held, [(each.low, each.high) for each in found])
    return StrokeLimits(name, unit, stroke.start, stroke.end, tuple(found), crossings, least, others, turns, tuple(still))


def scanner(moved: Moved, name: str, held: Mapping[str, float]) -> Callable[[FloatArray], Scanned]:
    """Return a look at values of one stroke."""

    def scan(at: FloatArray) -> Scanned:
        motion = moved({**held, name: at})
        loops = {each: np.broadcast_to(np.where(motion.reached, sine, np.nan), at.shape) for each, sine in motion.loop_sines.items()}
        return Scanned(motion.reached, loops, lambda place: failing(moved({**held, name: at[place : place + 1]})), motion.group_stops)

    return scan


def failing(motion: Motion) -> str:
    """Return what cannot be placed first at a motion's pose, by its name."""
    return next((called(motion.plan, name) for name, mask in failures(motion.plan, motion.reading, motion.shape) if mask.any()), "")


def is_watched(motion: Motion) -> bool:
    """Return whether change points between the poses are looked for: one design along one stroke.

    A sweep of many thousand poses stands so close to every change point that its guards tell.
    """
    poses = next((value for value in motion.strokes.values()), np.zeros(0))
    single = len(motion.strokes) == 1 and not motion.design_shape and poses.ndim == 1
    return single and poses.size > 2 and (poses.size <= WATCHED or motion.is_near_singular)


def group_crossing(motion: Motion, crossed: Any) -> SingularError:
    """Return the error for poses that a group's pins reach only through a change point."""
    groups = ", ".join(f"{name} = {group}" for name, group in motion.plan.groups.items())
    where = where_words(motion.plan, crossed, motion.strokes)
    return SingularError(
        f"{motion.plan.title} passes a change point before the poses {where}: the branches of {groups} cross on the way from the sketch. "
        'Stop before it, start from a sketch on the other side, or ask with unreachable="nan".',
        point=next(iter(motion.plan.groups)), mask=crossed, motion=motion,
    )  # fmt: skip


def stop_words(motion: Motion) -> str:
    """Return how far a sweep of one design goes, in words: `It goes from S = 0 to 0.408276 m.`"""
    if len(motion.strokes) != 1 or motion.design_shape or not motion.reached.any() or motion.reached.ndim != 1:
        return ""
    ((name, values),) = motion.strokes.items()
    order = np.argsort(values, kind="stable")
    found = intervals(scanner(motion.moved, name, {}), values[order], motion.reached[order])
    unit = stroke_unit(motion.plan, name)
    spans = [f"from {name} = {each.low:.6g} to {each.high:.6g} {unit}" for each in found]
    return f" It goes {', and '.join(spans)}."


def refuse_crossing(motion: Motion) -> None:
    """Raise SingularError where a sweep passes a change point: between its poses two branches of a loop cross.

    A loop that a declared side keeps on one branch would turn back there, which no machine does.
    """
    ((name, values),) = motion.strokes.items()
    order = np.argsort(values, kind="stable")
    at = values[order]
    scan = scanner(motion.moved, name, {})
    # a group is followed step by step from the sketch and tells of its own crossings
    alone = {loop: sine for loop, sine in motion.loop_sines.items() if loop not in motion.plan.of_kind(Pin)}
    for loop, sine in alone.items():
        ordered = np.broadcast_to(np.abs(sine), values.shape)[order]
        for place in suspects(ordered):
            value, least = deepest(scan, loop, at[max(place - 1, 0)], at[min(place + 1, len(at) - 1)])
            if least < TOUCH and at[0] < value < at[-1]:
                raise crossing(motion, loop, name, value)


def suspects(sine: FloatArray) -> list[int]:
    """Return the inner places near which a sine may touch zero: minima that lie low beside their surroundings."""
    before, here, after = sine[:-2], sine[1:-1], sine[2:]
    with np.errstate(invalid="ignore"):
        low = (here <= before) & (here <= after) & (here < 0.5) & (here <= 1.05 * np.abs(after - before) + 0.6 * np.maximum(before, after))
    return [int(place) + 1 for place in np.flatnonzero(low)]


def crossing(motion: Motion, loop: str, name: str, value: float) -> SingularError:
    """Return the error that names a change point."""
    unit = stroke_unit(motion.plan, name)
    where = f"{name} = {value:.6g} {unit}" + (f" ({value / deg:.4g} deg)" if unit == "rad" else "")
    member = motion.plan.members[loop]
    opening = f"{loop} = {member}" if isinstance(member, Point) else loop
    return SingularError(
        f"{motion.plan.title} passes a change point at {where}: {opening} has its links in line there and its two branches cross, "
        "so which way the mechanism goes on is not settled by its geometry. Stop the sweep before it, take the poses on each side "
        'in sweeps of their own, or ask with unreachable="nan".',
        point=loop, mask=np.asarray(motion.strokes[name] >= value), motion=motion,
    )  # fmt: skip
