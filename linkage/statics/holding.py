"""Who holds the strokes: the steps that drive them, or cylinders that are declared in their place.

Every line of declared cylinders that no element feeds takes over one stroke; the drive it replaces carries nothing. Strokes that
are left over keep the drive of their step. Which line takes which stroke is told by how its length follows them at some poses.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import permutations

import numpy as np

from ..errors import DefinitionError, unwarned
from ..loads import ForceElement, TwoPoint
from ..motion import Motion
from ..plan import Plan
from ..program import FloatArray

SAMPLE = 7
"""Poses over the strokes at which it is looked how lengths follow them."""
STILL = 1e-9
"""A length that changes by less than this part of its end's way does not follow a stroke."""


@dataclass(frozen=True)
class Line:
    """Cylinders that share one pressure, one or more, and the stroke that they take over."""

    cylinders: tuple[TwoPoint, ...]
    stroke: str
    steady: float = 0.0
    """How a single cylinder's length follows its stroke, where it is driven in proportion to that and to no other; else 0."""

    @property
    def is_steady(self) -> bool:
        """Whether its length follows its own stroke alone, in proportion."""
        return self.steady != 0.0

    @property
    def changes_shares(self) -> bool:
        """Whether its cylinders carry other shares while it pulls than while it pushes: several, one of which works with both sides."""
        return len(self.cylinders) > 1 and any(each.works_both for each in self.cylinders)


@dataclass(frozen=True)
class Holding:
    """The lines that hold, in the order declared."""

    lines: tuple[Line, ...] = ()

    @property
    def taken(self) -> frozenset[str]:
        """The strokes whose own drives carry nothing."""
        return frozenset(line.stroke for line in self.lines)

    def line_of(self, cylinder: TwoPoint) -> Line | None:
        """Return the line that a cylinder is on; None where it does not hold."""
        return next((line for line in self.lines if any(same(cylinder, each) for each in line.cylinders)), None)


def holding_of(plan: Plan, elements: Iterable[ForceElement] = ()) -> Holding:
    """Return who holds, of a machine's own cylinders and of those among some elements.

    DefinitionError, by name, for a cylinder that holds nothing and for one too many.
    """
    own = tuple(plan.of_kind(ForceElement).values())
    extra = tuple(each for each in elements if not any(same(each, mine) for mine in own))
    if not any(each.holds for each in (*own, *extra)):
        return Holding()
    if not any(each.holds or each.joined(plan.members) or each.feeds(plan.members) for each in extra):
        found: Holding = plan.made(("holding",), lambda _: assigned(plan, own))
        return found
    return assigned(plan, (*own, *extra))


def same(a: ForceElement, b: ForceElement) -> bool:
    """Return whether two elements are one: the same, or of one name in the class."""
    return a is b or bool(a.name and a.name == b.name)


def assigned(plan: Plan, elements: Sequence[ForceElement]) -> Holding:
    """Return the lines with the strokes they take."""
    lines = joined_lines(plan, elements)
    if not lines:
        return Holding()
    follows = followed(plan, lines)
    for line, row in zip(lines, follows, strict=True):
        if not row.any():
            raise DefinitionError(
                f"{plan.title}: {titled(line)} holds nothing here: no stroke changes the distance {''.join(line[0].ends)}. "
                "Put it between two points that move against each other, or take it out."
            )
    best = matched(follows)
    if best is None:
        raise DefinitionError(too_many(plan, lines))
    names = list(plan.strokes)
    pairs = [(line, names[place]) for line, place in zip(lines, best, strict=True)]
    motion = sampled(plan)
    for line, stroke in pairs:
        apart = [each for each in line if not share(motion, each, stroke) > 0.0]
        if apart:
            raise DefinitionError(
                f"{plan.title}: {titled(line)} are on one line, but {titled(apart)} does not move with {stroke}: one pressure cannot hold "
                f"several strokes. Give each a circuit of its own, LiftCircuit({titled(apart[:1])}, pressure=...)."
            )
    return Holding(tuple(Line(line, stroke, steady_rate(plan, line, stroke)) for line, stroke in pairs))


def steady_rate(plan: Plan, line: Sequence[TwoPoint], stroke: str) -> float:
    """Return how the declared length of a single cylinder follows its stroke: a number, of all designs and poses; else 0."""
    length = plan.table.lengths.get(frozenset(line[0].ends)) if len(line) == 1 else None
    if length is None or {name for name in plan.strokes if name == length.name or name in plan.reaches(length)} != {stroke}:
        return 0.0
    (slope,) = plan.made(("slope", *line[0].ends, stroke), lambda twin: twin.derived(twin.nodes(length), (stroke,)))
    return float(slope.value) if slope.op == "constant" else 0.0


def joined_lines(plan: Plan, elements: Sequence[ForceElement]) -> list[tuple[TwoPoint, ...]]:
    """Return the cylinders that hold, those of one pressure line together."""
    fed = [member for each in elements for member in each.feeds(plan.members)]
    free = [each for each in elements if each.holds and isinstance(each, TwoPoint) and not any(same(each, other) for other in fed)]
    lines: list[tuple[TwoPoint, ...]] = [(each,) for each in free]
    for circuit in elements:
        members = circuit.joined(plan.members)
        on_it = [line for line in lines if any(same(each, other) for each in line for other in members)]
        if len(on_it) > 1:
            lines = [line for line in lines if line not in on_it]
            lines.append(tuple(each for line in on_it for each in line))
    return lines


def followed(plan: Plan, lines: Sequence[tuple[TwoPoint, ...]]) -> FloatArray:
    """Return how much each line's length follows each stroke, shape (lines, strokes), the sum of a line's being 1; 0 for not at all."""
    motion = sampled(plan)
    found = np.zeros((len(lines), len(plan.strokes)))
    for i, line in enumerate(lines):
        for j, stroke in enumerate(plan.strokes):
            found[i, j] = max(share(motion, cylinder, stroke) for cylinder in line)
    total = found.sum(axis=1, keepdims=True)
    return np.asarray(found / np.where(total > 0.0, total, 1.0))


def stroke_followed(plan: Plan, member: TwoPoint) -> str:
    """Return the stroke that a member's length follows, of several the one it follows most; DefinitionError where it follows none."""
    if len(plan.strokes) == 1:
        return next(iter(plan.strokes))
    shares: FloatArray = plan.made(("followed", *member.ends), lambda _: followed(plan, [(member,)])[0])
    if not shares.any():
        what = f"no stroke changes the length of {member.name or member}"
        raise DefinitionError(f"{plan.title}: {what}; it neither grows nor shrinks.")
    return list(plan.strokes)[int(np.argmax(shares))]


def sampled(plan: Plan) -> Motion:
    """Return some poses over the strokes, no two of them alike in any stroke."""
    along = (np.arange(SAMPLE) + 0.37) / SAMPLE
    shifts = {name: np.roll(along, 2 * k) for k, name in enumerate(plan.strokes)}
    values = {name: each.start + shifts[name] * (each.end - each.start) for name, each in plan.strokes.items()}
    strokes = {name: np.append(plan.sketch_strokes[name], value) for name, value in values.items()}
    return Motion(plan, plan.defaults, strokes, "nan")


def share(motion: Motion, cylinder: TwoPoint, stroke: str) -> float:
    """Return how much a cylinder's length follows a stroke over its range [m], at the most; 0 for not at all."""
    A, B = cylinder.ends
    plan, span = motion.plan, motion.plan.strokes[stroke]
    if stroke not in plan.reaches(A) | plan.reaches(B):
        return 0.0
    with unwarned():
        rate = np.abs(cylinder.growth(motion, {stroke: 1.0}))
        way = np.hypot(*motion.ratio(A, wrt=stroke)) + np.hypot(*motion.ratio(B, wrt=stroke))
    moved = np.nan_to_num(np.where(rate > STILL * way, rate, 0.0))
    return float(moved.max(initial=0.0)) * abs(span.end - span.start)


def matched(follows: FloatArray) -> tuple[int, ...] | None:
    """Return the stroke for each line, all different, whose shares multiply to the most; later strokes where equal. None for no way."""
    lines, strokes = follows.shape
    ways = permutations(reversed(range(strokes)), lines) if lines <= strokes else iter(())
    worth = {way: float(np.prod([follows[i, j] for i, j in enumerate(way)])) for way in ways}
    best = max(worth, key=lambda way: round(worth[way], 6), default=None)
    return best if best is not None and worth[best] > 0.0 else None


def titled(line: Sequence[TwoPoint]) -> str:
    """Return a line's cylinders by their names, or their words where they have none."""
    return " and ".join(each.name or str(each) for each in line)


def too_many(plan: Plan, lines: Sequence[tuple[TwoPoint, ...]]) -> str:
    """Return the words for more lines of cylinders than strokes that they could hold."""
    names = [titled(line) for line in lines]
    strokes = f"{len(plan.strokes)} stroke{'s' if len(plan.strokes) != 1 else ''} ({', '.join(plan.strokes) or 'none'})"
    return (
        f"{plan.title}: {', '.join(names)} are more cylinders than there are strokes to hold, {strokes}: how they share the load is not "
        f"settled. Put those of one pressure on one line, LiftCircuit([{', '.join(names)}], pressure=...), or give one its own force by a "
        "FloatCircuit or an Actuator."
    )
