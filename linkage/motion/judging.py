"""What can be said of any motion: whether it is assembled, where its dead points are, and what its members say of themselves."""

from __future__ import annotations

from abc import abstractmethod
from collections import Counter
from collections.abc import Collection, Container, Iterable, Iterator

import numpy as np

from ..errors import LinkageError
from ..language import said
from ..quantities import Member
from ..units import deg, show
from ..verdict import Verdict
from .limits import StrokeLimits, place_text, span_text, stroke_unit
from .motion import Motion, out_of_reach

POOR = 40.0 * deg
"""A transmission angle below which textbooks advise against a loop that carries load [rad]."""
JUDGED = 200
"""Designs of a batch whose members are judged, each by itself."""
MOST_STROKES = 2
"""Strokes over whose whole box members are judged; of more it is along each of them, the others in their middle."""
ALONG = 21


class Judging(Member):
    """A member that has something to say of a motion, such as a cylinder: its base beside that of its kind."""

    @abstractmethod
    def verdicts(self, motion: Motion) -> list[Verdict]:
        """Return what an engineer should know of it, under the machine's own loads, over a motion of one design with poses reached.

        Where several members follow the same rule the machine adds their names to it.
        """


def motion_verdicts(motion: Motion) -> list[str]:
    """Return what can be said of a motion of any machine; of a batch, how many designs fail."""
    if motion._design_shape:
        return batch_verdicts(motion)
    return [*geometry_verdicts(motion), *(member_verdicts(motion) if motion.reached.any() else [])]


def one_line(error: LinkageError) -> str:
    """Return what an error says, in one line."""
    return " ".join(str(error).split())


# -- geometry ----------------------------------------------------------------------------------------------


def geometry_verdicts(motion: Motion) -> list[str]:
    """Return whether one design is assembled over a motion, its dead points, and its least transmission angle where it is poor."""
    if not motion.strokes or not motion.plan.moving:
        return []
    if not motion.reached.any():
        return [assembly_verdict(motion)]
    limits = motion.limits().values()
    return [assembly_verdict(motion), *(each for one in limits for each in dead_point_verdicts(one)), *transmission_words(limits)]


def assembly_verdict(motion: Motion) -> Verdict:
    """Return whether every pose of a motion is assembled, and the way between them; where not, how much is missing and what to do."""
    if not motion.reached.all():
        return Verdict("assembly", False, one_line(out_of_reach(motion)))
    if motion.interruptions:
        text = said(
            "between the poses the way is interrupted: {between}; shorten the stroke or change a length.",
            between="; ".join(map(str, motion.interruptions)),
        )
        return Verdict("assembly", False, text)
    spans = [f"{name} = {span_text(values, stroke_unit(motion.plan, name))}" for name, values in motion.strokes.items()]
    return Verdict("assembly", True, said("it is assembled over {spans}.", spans=", ".join(spans)))


def dead_point_verdicts(limits: StrokeLimits) -> Iterator[Verdict]:
    """Yield what stops or turns a motion along one stroke: within its range a fault, beyond its ends how far away it is."""
    low, high = sorted((limits.start, limits.end))
    near = 1e-9 * (high - low)
    points = dict.fromkeys(limits.dead_points)
    inside = [place_of(limits, value, step) for value, step in points if low + near < value < high - near]
    if inside:
        text = said("{places}, within the stroke: no drive passes there. Shorten the stroke or change a length.", places="; ".join(inside))
        yield Verdict("dead points", False, text)
    elif points:
        before = max((each for each in points if each[0] <= low + near), default=None)
        behind = min((each for each in points if each[0] >= high - near), default=None)
        ends = [(each, max(low - each[0], each[0] - high)) for each in (before, behind) if each is not None]
        nearest = [f"{place_of(limits, value, step)}, {away_text(away, limits.unit, near)}" for (value, step), away in ends]
        yield Verdict("dead points", True, said("none within the stroke; the nearest: {places}.", places="; ".join(nearest)))
    crossing = [place_of(limits, value, step) for value, step in limits.change_points if low <= value <= high]
    if crossing:
        text = said(
            "branches cross: {places}; there the motion may go on either way. Change a length, or guide it.", places="; ".join(crossing)
        )
        yield Verdict("change points", False, text)
    still = [place_of(limits, value, name) for value, name in limits.cylinder_dead_points if low <= value <= high]
    if still:
        text = said("its length stands still: {places}; there its thrust moves nothing.", places="; ".join(still))
        yield Verdict("cylinder's dead point", False, text)


def place_of(limits: StrokeLimits, value: float, what: str) -> str:
    """Return what is at a place along a stroke [m or rad] in words: `B at S = 0.1234 m`."""
    return said("{what} at {stroke} = {value}", what=what, stroke=limits.stroke, value=place_text(value, limits.unit))


def away_text(value: float, unit: str, near: float) -> str:
    """Return how far beyond a stroke [m or rad] something is, in words: `13.2 mm beyond it`."""
    if value <= near:
        return said("where it ends")
    return said("{distance} beyond it", distance=show(value, "deg" if unit == "rad" else "mm", 3))


def transmission_words(limits: Collection[StrokeLimits]) -> list[str]:
    """Return the least transmission angle, where it is poor; it is no fault as such, a toggle lives of it."""
    within = [
        (each.angle, each, one)
        for one in limits
        for each in one.transmission
        if each.angle < POOR and min(one.start, one.end) <= each.stroke <= max(one.start, one.end)
    ]
    if not within:
        return []
    angle, least, along = min(within, key=lambda each: each[0])
    return [
        said(
            "The least transmission angle is {angle}, at {place}: below {poor} pin forces and play grow.",
            angle=show(angle, "deg", 3),
            place=place_of(along, least.stroke, least.joint),
            poor=show(POOR, "deg", 3),
        )
    ]


# -- members -----------------------------------------------------------------------------------------------


def member_verdicts(motion: Motion, names: Iterable[str] | None = None) -> list[Verdict]:
    """Return what the members that judge themselves say, all or those named; with their names where several follow the same rule."""
    moving = [name for name, value in motion.strokes.items() if np.ptp(value) > 0.0]
    if len(motion._stroke_shape) > MOST_STROKES and len(moving) > MOST_STROKES:
        return [verdict for name in moving for verdict in along_stroke(motion, name, names)]
    members = motion.plan.of_kind(Judging)
    chosen = [name for name in members if names is None or name in set(names)]
    found = [(name, verdict) for name in chosen for verdict in members[name].verdicts(motion)]
    count = Counter(rule for _, rule in {(name, verdict.rule) for name, verdict in found})
    return [
        verdict if count[verdict.rule] == 1 else Verdict(f"{verdict.rule} {name}", verdict.ok, verdict.sentence) for name, verdict in found
    ]


def along_stroke(motion: Motion, stroke: str, names: Iterable[str] | None) -> Iterator[Verdict]:
    """Yield what members say along one stroke of a grid, the others in the middle of theirs."""
    middle = {name: float(np.min(value) + np.max(value)) / 2.0 for name, value in motion.strokes.items()}
    values = np.linspace(np.min(motion.strokes[stroke]), np.max(motion.strokes[stroke]), ALONG)
    over = motion.moved({name: values if name == stroke else np.full(ALONG, value) for name, value in middle.items()})
    if not over.reached.any():
        return
    for verdict in member_verdicts(over, names):
        heading = said("{rule}, along {stroke}", rule=verdict.heading, stroke=stroke)
        yield Verdict(f"{verdict.rule}, along {stroke}", verdict.ok, verdict.sentence, heading)


def added_verdicts(motion: Motion, own: Container[str]) -> list[str]:
    """Return what the members say that are not among a class's own: those of a variant, beside the class's own verdicts."""
    names = [name for name in motion.plan.of_kind(Judging) if name not in own]
    if not names or not motion.reached.any():
        return []
    return batch_verdicts(motion, names, with_assembly=False) if motion._design_shape else [*member_verdicts(motion, names)]


def batch_verdicts(motion: Motion, names: Iterable[str] | None = None, *, with_assembly: bool = True) -> list[str]:
    """Return, rule by rule, how many designs of a batch fail, with what is said of the first of these."""
    reached = motion.reached.reshape(-1, int(np.prod(motion._stroke_shape)))
    whole, total = reached.all(axis=1), len(reached)
    found: list[str] = []
    if with_assembly:
        lost = np.flatnonzero(~whole)
        text = said("{n} of {total} designs cannot be assembled over the whole motion", n=lost.size, total=total)
        text += said("; the first is design {number}.", number=lost[0] + 1) if lost.size else "."
        found.append(Verdict("assembly", not lost.size, text))
    if not (motion.plan.of_kind(Judging) if names is None else [*names]):
        return found
    if total > JUDGED:
        text = said(
            "Members are judged for up to {most} designs, this batch has {total}: take a part of it, or survey.",
            most=JUDGED,
            total=total,
        )
        return [*found, text]
    failed: dict[str, list[tuple[int, str]]] = {}
    for number in np.flatnonzero(reached.any(axis=1)).tolist():
        for verdict in member_verdicts(one_of(motion, number), names):
            failed.setdefault(verdict.rule, [])
            if not verdict.ok:
                failed[verdict.rule].append((number + 1, verdict.sentence))
    for rule, each_of in failed.items():
        text = said("{n} of {total} designs fail", n=len(each_of), total=total)
        text += said("; the first is design {number}: {sentence}", number=each_of[0][0], sentence=each_of[0][1]) if each_of else "."
        found.append(Verdict(rule, not each_of, text))
    return found


def one_of(motion: Motion, number: int) -> Motion:
    """Return the motion of one design of a batch, by its number among them."""
    shape = motion._design_shape
    designs = {name: float(np.broadcast_to(value, shape).ravel()[number]) for name, value in motion.designs.items()}
    own = {
        name: value.reshape(-1, *motion._stroke_shape)[number] if motion._grid.per_design else value
        for name, value in motion.strokes.items()
    }
    return Motion(motion.plan, designs, own, "nan")
