"""Motions looked at along one stroke: the limits of a design, and change points between the poses of a sweep."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ..errors import AssemblyError, DefinitionError, SingularError
from ..program import FloatArray
from ..steps import Point
from ..units import deg
from .course import Course
from .course import Interruption as Interruption
from .limits import Held, Scanned, StrokeLimits, intervals, search
from .limits import Limits as Limits
from .reach import called, failures, missing_words, opening, stroke_unit, where_words
from .still import dead_points
from .strokes import check_any
from .transmission import transmission
from .turns import open_turn

if TYPE_CHECKING:
    from .motion import Motion

KEPT = 64
"""The designs of a plan whose clear stretches are kept."""

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
    between = Course(motion.plan, motion.grid.flat, name, held).interruptions(low, high)
    found = search(scanner(motion.moved, name, held), low, high, [each.deepest for each in between if each.is_gap])
    crossings = tuple((each.deepest, called(motion.plan, each.step)) for each in between if not each.is_gap)
    others = tuple(Held(each, value, stroke_unit(motion.plan, each)) for each, value in held.items() if each != name)
    least = transmission(motion, name, held, found)
    turns = open_turn(motion, name, held, found) if unit == "rad" else None
    still = dead_points(motion, name, held, [(each.low, each.high) for each in found])
    return StrokeLimits(name, unit, stroke.start, stroke.end, tuple(found), crossings, least, others, turns, tuple(still))


def scanner(moved: Moved, name: str, held: Mapping[str, float]) -> Callable[[FloatArray], Scanned]:
    """Return a look at values of one stroke."""

    def scan(at: FloatArray) -> Scanned:
        motion = moved({**held, name: at})
        return Scanned(motion.reached, lambda place: failing(moved({**held, name: at[place : place + 1]})), motion.group_stops)

    return scan


def failing(motion: Motion) -> str:
    """Return what cannot be placed first at a motion's pose, by its name."""
    return next((called(motion.plan, name) for name, mask in failures(motion.plan, motion.reading, motion.shape) if mask.any()), "")


def is_watched(motion: Motion) -> bool:
    """Return whether it is looked at between the poses: of one design along one stroke, from two poses on."""
    return len(motion.strokes) == 1 and not motion.design_shape and motion.shape != () and motion.reached.size > 1


def interruptions(motion: Motion) -> tuple[Interruption, ...]:
    """Return what interrupts the way of one design along its one stroke, between the least and the greatest of its poses.

    A stretch where nothing does is kept, of the last designs that were asked for, so that poses in it are not looked at again.
    """
    ((name, values),) = motion.strokes.items()
    low, high = float(values.min()), float(values.max())
    clear: dict[Any, tuple[float, float]] = motion.plan.made("clear", lambda _: {})
    key = tuple(map(float, motion.designs.values()))
    known = clear.get(key)
    if known is not None and known[0] <= low and high <= known[1]:
        return ()
    found = Course(motion.plan, motion.grid.flat, name, {}).interruptions(low, high)
    if not found and (known is None or (low <= known[0] and known[1] <= high)):
        clear[key] = low, high
        for old in list(clear)[:-KEPT]:
            clear.pop(old, None)
    return found


def between_words(motion: Motion) -> str:
    """Return what is known of the way between the poses, in words: nothing where it is clear."""
    found = motion.interruptions
    if found is None:
        return ", not looked at between the poses"
    return "".join(f", interrupted: {each}" for each in found)


def group_crossing(motion: Motion, crossed: Any) -> SingularError:
    """Return the error for poses that a group's pins reach only through a change point."""
    numbers = np.unique(motion.grid.full(motion.grid.solved.crossed[None].astype(float))[0][crossed])
    named = list(motion.plan.groups.items())
    groups = ", ".join(f"{name} = {group}" for name, group in (named[int(number) - 1] for number in numbers))
    where = where_words(motion.plan, crossed, motion.strokes)
    return SingularError(
        f"{motion.plan.title} passes a change point before the poses {where}: the branches of {groups} cross on the way from the sketch. "
        'Stop before it, start from a sketch on the other side, or ask with unreachable="nan".',
        point=named[int(numbers[0]) - 1][0], mask=crossed, motion=motion,
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
    """Raise the error of what interrupts a sweep between its poses: a stretch out of reach, or a change point.

    A loop that a declared side keeps on one branch would turn back at a change point, which no machine does.
    """
    found = interruptions(motion)
    if not found:
        return
    (values,) = motion.strokes.values()
    start = float(np.ravel(values)[0])
    first = min(found, key=lambda each: min(abs(each.low - start), abs(each.high - start)))
    raise gap(motion, first, found) if first.is_gap else crossing(motion, first)


def gap(motion: Motion, first: Interruption, found: Sequence[Interruption]) -> AssemblyError:
    """Return the error for a stretch between the poses of a sweep that cannot be assembled."""
    ((name, values),) = motion.strokes.items()
    plan, unit = motion.plan, stroke_unit(motion.plan, name)
    there = motion.moved({name: np.array([first.deepest])})
    step = next((each for each, mask in failures(plan, there.reading, (1,)) if mask.any()), first.step)
    words, shortfall = missing_words(plan, step, there.reading, np.ones(1, bool))
    far = np.asarray(values > first.low if np.ravel(values)[0] <= first.low else values < first.high)
    edges = [float(values.min()), *(edge for each in found if each.is_gap for edge in (each.low, each.high)), float(values.max())]
    spans = [f"from {name} = {low:.6g} to {high:.6g} {unit}" for low, high in zip(edges[::2], edges[1::2], strict=True)]
    return AssemblyError(
        f"{opening(plan, step)} cannot be assembled between two poses, from {name} = {first.low:.9g} to {first.high:.9g} {unit}:\n"
        f"{words} It goes {', and '.join(spans)}.",
        point=step, mask=far, shortfall=shortfall,
    )  # fmt: skip


def crossing(motion: Motion, found: Interruption) -> SingularError:
    """Return the error that names a change point, or where guides are parallel."""
    loop, name, value = found.step, found.stroke, found.deepest
    unit = stroke_unit(motion.plan, name)
    where = f"{name} = {value:.6g} {unit}" + (f" ({value / deg:.4g} deg)" if unit == "rad" else "")
    member = motion.plan.members[loop]
    named = f"{loop} = {member}" if isinstance(member, Point) else loop
    if found.kind == "guides":
        what, why = f"parallel guides at {where}", f"{named} runs to infinity there and comes back from the other side"
    elif found.kind == "meeting":
        what = f"a pose without a direction at {where}"
        why = f"{named} takes a direction between two points that come together there"
    else:
        what = f"a change point at {where}"
        line = f"{named} has its links in line there and its two branches cross"
        why = f"{line}, so which way the mechanism goes on is not settled by its geometry"
    return SingularError(
        f"{motion.plan.title} passes {what}: {why}. Stop the sweep before it, take the poses on each side "
        'in sweeps of their own, or ask with unreachable="nan".',
        point=loop, mask=np.asarray(motion.strokes[name] >= value), motion=motion,
    )  # fmt: skip
