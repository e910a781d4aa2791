"""Who holds the strokes: the steps that drive them, or cylinders that are declared in their place; and the levers they hold with.

Every line of declared cylinders that no element feeds takes over one stroke; the drive it replaces carries nothing. Strokes that are left
over keep the drive of their step. Which line takes which stroke follows from how its length depends on them at some poses.

If a cylinder's length does not change with its drive, or those of several follow the strokes alike, no thrust balances the loads. Such
poses are refused like any other singular one. What decides is the condition of the levers beside the speed at which the cylinders' ends
part.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from functools import cached_property, partial, reduce
from itertools import permutations, product
from operator import methodcaller
from typing import Any, TypeVar, cast

import numpy as np

from ..errors import DefinitionError, SingularWarning, ensure, unwarned, warn
from ..frozen import record
from ..loads import ForceElement, Poses, Reeving, Tie, TwoPinned, TwoPoint
from ..motion import Motion
from ..motion.dead_points import REFUSE, WARN, condition_of_sine, is_or_are
from ..motion.limits import refuse_at, where_words
from ..motion.stroke_search import out_of_reach
from ..plan import Plan
from ..program import FloatArray, Traced, elementwise, eliminated, is_traced, node_of
from ..quantities import Member, joined_names
from ..vectors import Numbers
from .poses import AnyMotion, FlatPoses, plan_of

Kind = TypeVar("Kind", bound=TwoPinned)

POSES = 7
"""Poses over the strokes at which it is looked how lengths follow them."""
SLOWEST = 1e-9
"""A length that changes by less than this part of its end's way does not follow a stroke."""


@record
class PressureLine:
    """Cylinders that share one pressure, one or more, and the stroke that they take over."""

    cylinders: tuple[TwoPoint, ...]
    stroke: str
    tie: Tie | None = None
    """How its pressure acts on them; None where each acts as it works."""
    steady: float = 0.0
    """How a single cylinder's length follows its stroke, where it is driven in proportion to that and to no other; else 0."""
    changes_shares: bool = False
    """Whether its cylinders carry other shares while it pulls than while it pushes: several, one of which works with both sides."""


@record
class Holders:
    """The lines that hold, in the order declared, and those with a closed volume or length, each with the input that changes it."""

    lines: tuple[PressureLine, ...] = ()
    closed: tuple[PressureLine, ...] = ()

    @property
    def senses(self) -> tuple[tuple[int, ...], ...]:
        """Whether the first cylinders of lines push (1) or pull (-1), in all ways that change shares; the last line's changes fastest."""
        return tuple(product(*((1, -1) if line.changes_shares else (1,) for line in self.lines)))

    @property
    def changes_shares(self) -> bool:
        """Whether the shares of some line change with its sense, so that no thrust is affine in the loads."""
        return any(line.changes_shares for line in self.lines)

    @property
    def every_line(self) -> tuple[PressureLine, ...]:
        """The lines that hold, then the closed ones."""
        return (*self.lines, *self.closed)

    @property
    def every_cylinder(self) -> tuple[TwoPoint, ...]:
        """The cylinders on any of the lines, each once."""
        return each_once(cylinder for line in self.every_line for cylinder in line.cylinders)

    @property
    def strokes_taken(self) -> frozenset[str]:
        """The strokes whose own drives carry nothing."""
        return frozenset(line.stroke for line in self.every_line)

    @property
    def reeved(self) -> Mapping[str, Reeving]:
        """How the closed ties run that bend, each without straight members, by their names: ropes."""
        return {line.tie.name: line.tie.run for line in self.closed if line.tie is not None and line.tie.run is not None}

    @property
    def line_quantities(self) -> frozenset[str]:
        """The quantities that closed lines give."""
        return frozenset(line.tie.gives for line in self.closed if line.tie is not None)

    def line_of(self, cylinder: TwoPoint) -> PressureLine | None:
        """Return the line that a cylinder is on, one that holds where it can be; None where it does not hold."""
        return next((line for line in self.every_line if is_among(cylinder, line.cylinders)), None)


def holders_of(plan: Plan, elements: Iterable[ForceElement] = ()) -> Holders:
    """Return who holds, of a machine's own cylinders and of those among some elements.

    DefinitionError, by name, for a cylinder that holds nothing and for one too many.
    """
    own = tuple(plan.of_kind(ForceElement).values())
    extra = tuple(each for each in elements if not is_among(each, own))
    if not any(each.holds or each.joined(plan.members) or each.feeds(plan.members) or each.tie(plan.members) for each in extra):
        return plan.made(("holders",), lambda _: assigned(plan, own))
    return assigned(plan, (*own, *extra))


def same(a: TwoPinned | Member, b: TwoPinned | Member) -> bool:
    """Return whether two elements are one: the same, or of one name in the class."""
    return a is b or bool(a.name and a.name == b.name)


def is_among(element: TwoPinned | Member, others: Iterable[TwoPinned | Member]) -> bool:
    """Return whether an element is one of some: the same as it, or of its name in the class."""
    return any(same(element, each) for each in others)


def each_once(elements: Iterable[Kind]) -> tuple[Kind, ...]:
    """Return elements in their order, each once."""
    found: list[Kind] = []
    for each in elements:
        found += [] if is_among(each, found) else [each]
    return tuple(found)


def assigned(plan: Plan, elements: Sequence[ForceElement]) -> Holders:
    """Return the lines with the strokes they take."""
    ties = [tie for tie in (each.tie(plan.members) for each in elements) if tie is not None]
    closed = tuple(PressureLine(on_tie(tie), tie.cut, tie) for tie in ties if not tie.held and tie.gives)
    cuts = {line.stroke for line in closed}
    if not ties and not joined_lines(plan, elements, ties):
        return Holders()
    motion, strokes = sampled(plan), list(plan.strokes)
    free, held = joined_lines(plan, elements, ties), independent(motion, [tie for tie in ties if tie.held])
    lines, tied = [*free, *map(on_tie, held)], [*(None for _ in free), *held]
    follows = line_shares(motion, lines, closed)
    follows[:, [name in cuts for name in strokes]] = 0.0  # the oil that is put in is driven by the closed line itself
    for line, row in zip(lines, follows, strict=True):
        if not row.any():
            if not motion.reached.any():
                raise out_of_reach(motion)
            what = f"{line_names(line)} holds nothing here: no stroke changes the distance {joined_names(*line[0].ends)}"
            raise DefinitionError(f"{plan.title}: {what}. Put it between two points that move against each other, or take it out.")
    best = matched(follows)
    if best is None:
        names = ", ".join(map(line_names, lines))
        many = f"{len(strokes)} stroke{'s' if len(strokes) != 1 else ''} ({', '.join(strokes) or 'none'})"
        what = f"{names} are more cylinders than there are strokes to hold, {many}: how they share the load is not settled"
        remedy = f"Put those of one pressure on one line, LiftCircuit([{names}], pressure=...), give each a stroke, or one its own"
        raise DefinitionError(f"{plan.title}: {what}. {remedy} force by a FloatCircuit or an Actuator.")
    pairs = [(line, strokes[place]) for line, place in zip(lines, best, strict=True)]
    taken = {stroke for _, stroke in pairs}
    for (line, stroke), own in zip(pairs, tied, strict=True):
        ways = {name: [followed_way(motion, each, name, closed) for each in line] for name in strokes}
        is_shared = own is not None and {name for name, way in ways.items() if any(way)} <= taken
        apart = [] if is_shared else [each for each, way in zip(line, ways[stroke], strict=True) if not way > 0.0]
        if apart:
            what = f"{line_names(line)} are on one line, but {line_names(apart)} does not move with {stroke}"
            remedy = f"Give each a circuit of its own, LiftCircuit({line_names(apart[:1])}, pressure=...)"
            raise DefinitionError(f"{plan.title}: {what}: one pressure cannot hold several strokes. {remedy}.")
    steady = [steady_rate(plan, line, stroke, tie is not None) for (line, stroke), tie in zip(pairs, tied, strict=True)]
    turns = [tie is None and len(line) > 1 and line[0].turns(plan.members) for line, tie in zip(lines, tied, strict=True)]
    taking = ((line, stroke, tie, rate, each) for (line, stroke), tie, rate, each in zip(pairs, tied, steady, turns, strict=True))
    return Holders(tuple(PressureLine(*each) for each in taking), closed)


def on_tie(tie: Tie) -> tuple[TwoPoint, ...]:
    """Return the members of a tie, each once."""
    return each_once(share.member for share in tie.shares)


def independent(motion: Motion, ties: Sequence[Tie]) -> list[Tie]:
    """Return the ties whose sums follow the strokes each in a way of its own: both sides of one cylinder take over one stroke."""
    if len(ties) < 2:
        return [*ties]
    rows = []
    with unwarned():
        for stroke in motion.plan.strokes:
            ways = [sum(np.asarray(one.of(motion)) * one.member.growth(motion, {stroke: 1.0}) for one in each.shares) for each in ties]
            rows.append(np.stack([np.nan_to_num(np.broadcast_to(way, motion.shape)) for way in ways], axis=-1))
    kept = sorted(column for _, column in pivots_of(np.concatenate(rows)))
    return [tie for place, tie in enumerate(ties) if place in kept]


KEPT = 1e-6
"""A sum that changes by less than this part of its terms' ways is kept."""


def closed_ties(plan: Plan) -> tuple[Tie, ...]:
    """Return the closed ties of a machine."""
    ties = (each.tie(plan.members) for each in plan.of_kind(ForceElement).values())
    return plan.made(("closed ties",), lambda _: tuple(tie for tie in ties if tie is not None and not tie.held))


def check_kept(motion: AnyMotion) -> bool:
    """Return True; DefinitionError where closed ties that give nothing lock a machine: strokes change their sums at a motion's poses."""
    plan, ties = motion.plan, closed_ties(motion.plan)
    for tie, stroke in product((tie for tie in ties if not tie.gives), plan.strokes):
        with unwarned():
            if tie.run is not None:
                check_run(motion, tie, tie.run, stroke)
                continue
            shares = [np.asarray(each.of(motion)) for each in tie.shares]
            parts = [share * each.member.growth(motion, {stroke: 1.0}) for share, each in zip(shares, tie.shares, strict=True)]
            added = motion.ratio(tie.added, wrt=stroke) if tie.added is not None else np.zeros(())
            ways = [sum(np.hypot(*motion.ratio(end, wrt=stroke)) for end in each.member.ends) for each in tie.shares]
            sizes = [np.abs(share) * way for share, way in zip(shares, ways, strict=True)]
        whole, size = np.abs(sum(parts) - added), sum(map(np.abs, parts))
        if np.any((whole > KEPT * size) & (size > SLOWEST * sum(sizes))):
            takes = [np.ravel(part)[int(np.nanargmax(whole))] for part in np.broadcast_arrays(*parts)]
            words = " and ".join(f"{each.member.name} {way:+.4g}" for each, way in zip(tie.shares, takes, strict=True))
            what = f"{tie.name} locks the machine: it is closed, and a unit of {stroke} would change what is in it by {words} [SI]"
            members = on_tie(tie)
            other = next((one for one in ties if one is not tie and {on.name for on in on_tie(one)} == {on.name for on in members}), None)
            if other is not None and len(members) == 2:
                pair = " to ".join(each.name for each in members)
                own, its = (np.ravel(np.divide(*(share_in(one, each, motion) for each in members)))[0] for one in (tie, other))
                what += f"; {pair} is {its:.4g} on {other.name} and {own:.4g} on {tie.name}"
            remedy = f"Let a step follow it, such as Dyad(U, P, UW={tie.shares[-1].member.name}.length), make the ratios of its areas those"
            raise DefinitionError(f"{plan.title}: {what}. {remedy} of the other line, or open it by a Tank.")
    return True


def check_run(motion: AnyMotion, tie: Tie, run: Reeving, stroke: str) -> None:
    """Raise DefinitionError for a rope whose path a stroke changes, though it gives nothing that could follow."""
    parts = [np.sum(load.force * motion.ratio(load.point, wrt=stroke), axis=0) for load in run.loads(motion)]
    sizes = [np.hypot(*load.force) * np.hypot(*motion.ratio(load.point, wrt=stroke)) for load in run.loads(motion)]
    way = np.abs(sum(parts))
    if np.any(way > KEPT * sum(sizes)):
        most = float(np.max(np.nan_to_num(way)))
        what = f"{tie.name} locks the machine: its length is held, and a unit of {stroke} would change its path by up to {most:.4g} m"
        remedy = f"Let a step follow it, such as Dyad(U, P, UW={tie.name}.last), or give its force, force=12 * kN"
        raise DefinitionError(f"{motion.plan.title}: {what}. {remedy}.")


def joined_lines(plan: Plan, elements: Sequence[ForceElement], ties: Sequence[Tie]) -> list[tuple[TwoPoint, ...]]:
    """Return the cylinders that hold, those of one pressure line together; without those whose thrust a tie tells.

    The first of a line works with both sides where one of them does, as its sign tells which side has the pressure.
    """
    fed = [member for each in elements for member in each.feeds(plan.members)]
    fed += [share.member for tie in ties for share in tie.shares]
    free = [each for each in elements if each.holds and isinstance(each, TwoPoint) and not is_among(each, fed)]
    lines: list[tuple[TwoPoint, ...]] = [(each,) for each in free]
    for circuit in elements:
        members = circuit.joined(plan.members)
        on_it = [line for line in lines if any(is_among(each, members) for each in line)]
        if len(on_it) > 1:
            lines = [line for line in lines if line not in on_it]
            joined = (each for line in on_it for each in line)
            lines.append(tuple(sorted(joined, key=methodcaller("turns", plan.members), reverse=True)))
    return lines


def line_names(line: Sequence[TwoPoint]) -> str:
    """Return a line's cylinders by their names, or their words where they have none."""
    return " and ".join(each.name or str(each) for each in line)


def steady_rate(plan: Plan, line: Sequence[TwoPoint], stroke: str, is_tied: bool) -> float:
    """Return how the declared length of a single cylinder follows its stroke: a number, of all designs and poses; else 0."""
    length = plan.table.lengths.get(frozenset(line[0].ends)) if len(line) == 1 and not is_tied else None
    if length is None or {name for name in plan.strokes if name == length.name or name in plan.reaches(length)} != {stroke}:
        return 0.0
    (slope,) = plan.made(("slope", *line[0].ends, stroke), lambda twin: twin.derived(twin.nodes(length), (stroke,)))
    return float(slope.value) if slope.op == "constant" else 0.0


# How lengths follow strokes, at some poses.


def sampled(plan: Plan, designs: Mapping[str, Numbers] | None = None) -> Motion:
    """Return some poses over the strokes, no two of them alike in any stroke, of the plain design unless others are given."""
    along = (np.arange(POSES) + 0.37) / POSES
    shifts = {name: np.roll(along, 2 * k) for k, name in enumerate(plan.strokes)}
    values = {name: each.start + shifts[name] * (each.end - each.start) for name, each in plan.strokes.items()}
    strokes = {name: np.append(plan.sketch_strokes[name], value) for name, value in values.items()}
    return Motion(plan, plan.defaults if designs is None else designs, strokes, "nan")


def line_shares(motion: Motion, lines: Sequence[tuple[TwoPoint, ...]], closed: Sequence[PressureLine] = ()) -> FloatArray:
    """Return how much each line's length follows each stroke, shape (lines, strokes), the sum of a line's being 1; 0 for not at all."""
    ways = [[max(followed_way(motion, each, stroke, closed) for each in line) for stroke in motion.plan.strokes] for line in lines]
    found = np.reshape(np.array(ways, float), (len(lines), len(motion.plan.strokes)))
    total = found.sum(axis=1, keepdims=True)
    return np.asarray(found / np.where(total > 0.0, total, 1.0))


def alone(motion: AnyMotion, closed: Iterable[PressureLine], stroke: str) -> dict[str, FloatArray]:
    """Return the rates of inputs on a unit of a stroke while the oil in closed lines, and the length of ropes, stay as they are.

    What puts oil in or winds a rope up as the stroke goes on is a drive of its own: it takes its part from no cylinder.
    """
    rates = {stroke: np.ones(())}
    for tie in [line.tie for line in closed if line.tie is not None and line.tie.cut != stroke]:
        if tie.run is not None and stroke in tie.run.strokes:
            rates[tie.cut] = -np.asarray(tie.run.rate(motion, stroke))
        elif tie.added is not None and stroke in motion.plan.reaches(tie.added):
            rates[tie.cut] = -np.asarray(motion.ratio(tie.added, wrt=stroke))
    return rates


def followed_way(motion: Motion, cylinder: TwoPoint, stroke: str, closed: Sequence[PressureLine] = ()) -> float:
    """Return how much a cylinder's length follows a stroke alone over its range [m], at the most; 0 for not at all."""
    A, B = cylinder.ends
    plan, span = motion.plan, motion.plan.strokes[stroke]
    if stroke not in plan.reaches(A) | plan.reaches(B):
        return 0.0
    with unwarned():
        poses, rates = FlatPoses(motion, "", {*plan.reaches(A), *plan.reaches(B)}), alone(motion, closed, stroke)
        rate = np.abs(reduce(np.add, (poses.growth(A, B, name) * poses.flattened(each) for name, each in rates.items())))
        way = np.hypot(*poses.rate(A, stroke)) + np.hypot(*poses.rate(B, stroke))
    return float(np.nan_to_num(np.where(rate > SLOWEST * way, rate, 0.0)).max(initial=0.0)) * abs(span.end - span.start)


def matched(follows: FloatArray) -> tuple[int, ...] | None:
    """Return the stroke for each line, all different, whose shares multiply to the most; later strokes where equal. None if none does."""
    lines, strokes = follows.shape
    ways = permutations(reversed(range(strokes)), lines) if lines <= strokes else iter(())
    worth = {way: float(np.prod([follows[i, j] for i, j in enumerate(way)])) for way in ways}
    best = max(worth, key=lambda way: round(worth[way], 6), default=None)
    return best if best is not None and worth[best] > 0.0 else None


def stroke_followed(plan: Plan, member: TwoPoint) -> str:
    """Return the stroke that a member's length follows, of several the one it follows most; DefinitionError where it follows none."""
    if len(plan.strokes) == 1:
        return next(iter(plan.strokes))
    shares = plan.made(("shares", *member.ends), lambda _: line_shares(sampled(plan), [(member,)])[0])
    what = f"no stroke changes the length of {member.name or member}"
    ensure(shares.any(), f"{plan.title}: {what}; it neither grows nor shrinks.")
    return list(plan.strokes)[int(np.argmax(shares))]


# The levers: what a thrust does on a unit of each stroke that is taken over.


@record
class Levers:
    """The work of each line's first cylinder, plus the others of its line, on a unit of each stroke taken: (n, lines, strokes).

    `sizes` are those of its parts, `shares` the thrusts of each line's cylinders over that of its first, (n,) each. Of a tie they are the
    work and the thrusts at one unit of its force. `cuts` is the work of each line on a unit of what changes a closed one, `kept` the
    shares in the closed ones.
    """

    matrix: FloatArray
    sizes: FloatArray
    shares: tuple[tuple[FloatArray, ...], ...]
    cuts: tuple[tuple[FloatArray, ...], ...] = ()
    kept: tuple[tuple[FloatArray, ...], ...] = ()

    def thrust(self, holders: Holders, member: TwoPoint, need: FloatArray, cuts: Sequence[FloatArray]) -> FloatArray:
        """Return the thrust [N] of a cylinder, shape (n,), from the needs (n, lines) and the closed lines' forces (n,) of all its lines."""
        units = self.thrusts(need) if holders.lines else need
        firsts = [units[:, place] for place in range(len(holders.lines))]
        parts = [unit * each for unit, each in zip(firsts, share_of(member, holders.lines, self.shares), strict=True) if each is not None]
        for place, (line, shares) in enumerate(zip(holders.closed, self.kept, strict=True)):
            (share,) = share_of(member, [line], [shares])
            if share is not None:
                parts.append(self.kept_force(place, firsts, cuts) * share)
        return reduce(np.add, parts)

    def kept_force(self, place: int, units: Sequence[FloatArray], cuts: Sequence[FloatArray]) -> FloatArray:
        """Return the force of a closed line (n,), by its place, beside those of the lines that hold, (n,) each."""
        return reduce(np.subtract, (unit * work for unit, work in zip(units, self.cuts[place], strict=True)), cuts[place])

    def thrusts(self, need: FloatArray) -> FloatArray:
        """Return the thrusts of the lines' first cylinders (n, lines) that balance the strokes' needs (n, strokes)."""
        if self.matrix.shape[1] == 1:
            return need / self.matrix[:, 0]
        turned = np.swapaxes(self.matrix, 1, 2)
        if turned.dtype != object and need.dtype != object:
            return np.asarray(np.linalg.solve(turned, need[:, :, None])[:, :, 0])
        found = np.empty((1, len(need[0])), object)
        found[0] = traced_solution(turned[0], need[0])
        return cast(FloatArray, found)

    @cached_property
    def nearness(self) -> FloatArray:
        """How near the levers are to a singular pose, relative to their sizes (n,); infinite where they are at one."""
        matrix, sizes, count = numbers_of(self.matrix), numbers_of(self.sizes), range(self.matrix.shape[1])
        columns = [above_zero(reduce(np.maximum, [row[j] for row in sizes])) for j in count]
        rows = [above_zero(reduce(np.maximum, [row[j] / columns[j] for j in count])) for row in sizes]
        scaled = [[matrix[i][j] / columns[j] / rows[i] for j in count] for i in count]
        return condition_of_sine(scaled[0][0]) if len(scaled) == 1 else inverse_size(scaled)


def share_of(member: TwoPoint, lines: Sequence[PressureLine], shares: Sequence[Sequence[FloatArray]]) -> list[FloatArray | None]:
    """Return the share of a cylinder in each line; None where it is not on it."""
    pairs = [zip(line.cylinders, own, strict=True) for line, own in zip(lines, shares, strict=True)]
    return [next((part for each, part in pair if same(each, member)), None) for pair in pairs]


def with_levers(poses: FlatPoses, holders: Holders, what: str) -> tuple[FlatPoses, tuple[Levers, ...]]:
    """Return the poses at which the cylinders hold, and their levers there for each of the holders' `senses`.

    SingularError at the others unless NaN was asked for; `what` opens the sentence.
    """
    lines = holders.lines
    if not holders.closed and all(line.steady for line in lines):  # each length follows its own stroke alone, in proportion
        matrix, one = np.zeros((poses.count, len(lines), len(lines))), np.ones(poses.count)
        for i, line in enumerate(lines):
            matrix[:, i, i] = line.steady
        return poses, (Levers(matrix, np.abs(matrix), tuple((one,) for _ in lines)),)
    if not isinstance(poses.motion, Motion):
        return poses, poses.motion._once(("levers", holders.every_line), partial(traced_levers, poses, holders))
    shared = "levers", holders.every_line, poses.good.tobytes()  # once for the same poses of a motion, for all loads and cylinders
    found = tuple(poses.motion._once((*shared, way), partial(levers_of, poses, holders, way)) for way in holders.senses)
    if not lines:
        return poses, found
    names = [each.name or str(each) for line in lines for each in line.cylinders]
    whose = f"the length of {names[0]} stands" if len(names) == 1 else f"the lengths of {', '.join(names)} stand"
    cond = nearness_of(holders, found)
    lost = np.isnan(refused_where(poses, np.zeros(poses.count), cond, what, f"{whose} still against the drive there"))
    if not lost.any():
        return poses, found
    left = poses.without(lost)
    return left, tuple(levers_of(left, holders, way) for way in holders.senses)


def nearness_of(holders: Holders, found: Sequence[Levers]) -> FloatArray:
    """Return how near any of the levers are to a singular pose, (n,); infinite where both sides of a line drive its stroke the same way."""
    cond = reduce(np.maximum, [each.nearness for each in found])
    for i, line in enumerate(holders.lines):
        if line.changes_shares:
            first, last = (numbers_of(each.matrix)[i][i] for each in (found[0], found[-1]))
            cond = np.where(first * last < 0.0, np.inf, cond)
    return cond


def traced_levers(poses: FlatPoses, holders: Holders) -> tuple[Levers, ...]:
    """Return the levers of lines as numbers of a program, without a value where the cylinders do not hold."""
    found = tuple(levers_of(poses, holders, way) for way in holders.senses)
    cond = nearness_of(holders, found) if holders.lines else np.zeros(())
    if not is_traced(cond):
        return found
    return tuple(replace(each, matrix=where_held(cond, each.matrix)) for each in found)


def where_held(cond: FloatArray, values: FloatArray) -> FloatArray:
    """Return traced values where the condition of the levers allows forces, else NaN."""
    return cast(FloatArray, elementwise(lambda each: np.where(cond <= REFUSE, each, np.nan), (values,)))


def levers_of(poses: FlatPoses, holders: Holders, senses: Sequence[int]) -> Levers:
    """Return the levers of lines whose first cylinders push (1) or pull (-1)."""
    lines = holders.lines
    count = len(lines)
    matrix, sizes, shares = poses.zeros(count, count), poses.zeros(count, count), []
    ways = [{name: poses.flattened(rate) for name, rate in alone(poses.motion, holders.closed, each.stroke).items()} for each in lines]
    for i, line in enumerate(lines):
        weights = areas(line, poses, senses[i])
        shares.append(tuple(weights) if line.tie is not None else tuple(weight / weights[0] for weight in weights))
        for cylinder, part in zip(line.cylinders, shares[-1], strict=True):
            for j, way in enumerate(ways):
                for name, rate in way.items():
                    lever, size = lever_of(poses, cylinder, name)
                    matrix[:, i, j] += part * lever * rate
                    sizes[:, i, j] += np.abs(part * rate) * size

    def work(line: PressureLine, own: Sequence[FloatArray], stroke: str) -> FloatArray:
        """Return the work of a line on a unit of a stroke, with its cylinders' own shares."""
        return reduce(np.add, (part * lever_of(poses, each, stroke)[0] for each, part in zip(line.cylinders, own, strict=True)))

    cuts = [tuple(work(other, own, each.stroke) for other, own in zip(lines, shares, strict=True)) for each in holders.closed]
    return Levers(matrix, sizes, tuple(shares), tuple(cuts), tuple(tuple(areas(line, poses, 1)) for line in holders.closed))


def areas(line: PressureLine, poses: FlatPoses, way: int) -> list[FloatArray]:
    """Return the thrust of each cylinder of a line at one unit of the line's pressure [m2], shape (n,).

    Along the stroke that the line holds, some cylinders grow with the first and some against it. Where the first one pushes
    (`way` 1), the others drive the stroke the same way, unless chambers that are joined say what they do. Of a tie it is what its shares
    say.
    """
    if line.tie is not None:
        return [poses.flattened(share_in(line.tie, each, poses.motion)) for each in line.cylinders]
    if len(line.cylinders) == 1:
        return [np.ones(poses.count)]
    if not line.changes_shares:
        return [poses.flattened(each.area_in(poses.motion, np.ones(()))) for each in line.cylinders]
    growth = [poses.growth(*each.ends, line.stroke) for each in line.cylinders]
    senses = [poses.full(elementwise(np.sign, (rate * growth[0],)) * way) for rate in growth]
    first, motion = line.cylinders[0], poses.motion
    return [poses.flattened(each.area_beside(motion, sense, first, way)) for each, sense in zip(line.cylinders, senses, strict=True)]


def settled(holders: Holders, units: Sequence[FloatArray], values: Sequence[FloatArray]) -> FloatArray:
    """Return, of values for each of the holders' `senses`, those with which the first cylinders do push and pull.

    `units` are the thrusts of these first cylinders (lines, n) with each.
    """
    for place in reversed([k for k, line in enumerate(holders.lines) if line.changes_shares]):
        pairs = [*zip(units[::2], units[1::2], strict=True)]
        values = [where_negative(a[place], y, x) for (a, _), x, y in zip(pairs, values[::2], values[1::2], strict=True)]
        units = [np.stack([where_negative(a[place], q, p) for p, q in zip(a, b, strict=True)]) for a, b in pairs]
    return values[0]


def lever_of(poses: FlatPoses, cylinder: TwoPoint, stroke: str) -> tuple[FloatArray, FloatArray]:
    """Return how a cylinder's length grows with a stroke, and how fast its ends part at the most, both (n,)."""
    P, Q = cylinder.ends
    known = poses.plan.table.lengths.get(frozenset((P, Q)))
    if known is not None:
        lever = np.broadcast_to(poses.ratio(known, stroke), (poses.count,))
        return lever, np.abs(lever) if lever.dtype == object else np.full(poses.count, float(np.max(np.abs(lever), initial=0.0)))
    return poses.growth(P, Q, stroke), np.hypot(*(poses.rate(Q, stroke) - poses.rate(P, stroke)))


def refused_where(poses: FlatPoses, values: FloatArray, cond: FloatArray, what: str, reason: str) -> FloatArray:
    """Return values (..., n), NaN where a condition (n,) is above that at which ratios are refused.

    SingularError there unless the motion was asked for with `unreachable="nan"`; a warning with the error to expect near it. `what`
    opens the sentence, `reason` ends it.
    """
    lost = ~(cond <= REFUSE)
    near, motion = (cond > WARN) & ~lost, poses.motion
    if lost.any():
        worst = float(np.max(np.nan_to_num(cond[lost], nan=np.inf, posinf=np.inf)))
        size = "infinite" if np.isinf(worst) else f"{worst:.1e}"
        after = f": {reason} (condition {size}, refused above {REFUSE:.0e})."
        refuse_at(motion, poses.mask(lost), f"{what} {is_or_are(what)} refused", after)
    if near.any():
        worst = float(cond[near].max())
        where = where_words(motion.plan, poses.mask(near), motion.strokes)
        # one division by a difference that is lost: the error goes with the condition, not its square
        estimate = float(np.finfo(float).eps) * worst
        text = f"{what} {is_or_are(what)} nearly refused {where}, for close by {reason} (condition {worst:.1e})"
        warn(SingularWarning(f"{text}; expect a relative error of about {estimate:.0e}.", estimate=estimate))
    return np.where(lost, np.nan, values)


def inverse_size(rows: Sequence[Sequence[FloatArray]]) -> FloatArray:
    """Return the size of the inverse of matrices of k rows, each number (n,): the root of the sum of its squares."""
    k, numbers = len(rows), [each for row in rows for each in row]
    with np.errstate(divide="ignore", invalid="ignore"):
        if k > 3 and any(map(is_traced, numbers)):
            parts = [each for unit in np.eye(k).tolist() for each in traced_solution(rows, unit)]
            return cast(FloatArray, np.sqrt(scalar_product(parts, parts)))
        if k > 3:
            return np.asarray(np.sqrt(np.sum(np.linalg.svd(np.moveaxis(np.array(rows), -1, 0), compute_uv=False) ** -2, axis=-1)))
        if k == 2:
            minors, det = numbers, rows[0][0] * rows[1][1] - rows[0][1] * rows[1][0]
        else:
            crosses = [crossed(rows[1], rows[2]), crossed(rows[2], rows[0]), crossed(rows[0], rows[1])]
            minors, det = [each for row in crosses for each in row], scalar_product(rows[0], crosses[0])
        found = np.sqrt(scalar_product(minors, minors)) / np.abs(det)
    return found if is_traced(found) else np.where(det == 0.0, np.inf, found)


def traced_solution(rows: Sequence[Sequence[object]], right: Sequence[object]) -> list[FloatArray]:
    """Return the unknowns of a linear system of a law that is being traced; NaN or infinity where it is singular."""
    some = next(each for row in (*rows, right) for each in row if isinstance(each, Traced))
    *matrix, ends = [[some.node.graph.node(node_of(each)) for each in row] for row in (*rows, right)]
    return cast(list[FloatArray], [Traced(each, some.notes) for each in eliminated(matrix, ends)])


def crossed(a: Sequence[FloatArray], b: Sequence[FloatArray]) -> list[FloatArray]:
    """Return the vector product of two rows of three."""
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def scalar_product(a: Sequence[FloatArray], b: Sequence[FloatArray]) -> FloatArray:
    """Return the scalar product of two rows."""
    return reduce(np.add, [x * y for x, y in zip(a, b, strict=True)])


# Ties: members whose thrusts follow fewer forces.


def tie_pivots(plan: Plan, ties: Sequence[Tie], members: Sequence[TwoPoint]) -> list[tuple[int, int]]:
    """Return members and ties, by their places, such that the thrusts of these members tell the forces of these ties and all others."""
    motion = Motion(plan, plan.defaults, {name: np.asarray(value) for name, value in plan.sketch_strokes.items()}, "nan")
    return pivots_of(np.array([[float(np.ravel(share_in(tie, each, motion))[0]) for tie in ties] for each in members]))


def tied_forces(
    motion: Poses, ties: Sequence[Tie], thrust: Callable[[Any], FloatArray], least: Sequence[FloatArray | float]
) -> list[FloatArray]:
    """Return the forces of ties that put some thrusts on their members, `thrust(member)`, each shape (...) or of a program.

    Where ties depend on each other, so that the thrusts leave some forces open, they are the `least` that balance. DefinitionError
    where the open ones have no least, as they may grow and fall against each other.
    """
    plan, members = plan_of(motion), each_once(share.member for tie in ties for share in tie.shares)
    pivots = tie_pivots(plan, ties, members)
    shares = [[share_in(tie, each, motion) for tie in ties] for each in members]
    rows = [[shares[row][column] for _, column in pivots] for row, _ in pivots]
    known = dict(zip([column for _, column in pivots], solution_of_few(rows, [thrust(members[row]) for row, _ in pivots]), strict=True))
    found = [known.get(place, np.zeros(())) for place in range(len(ties))]
    for free in (place for place in range(len(ties)) if place not in known):
        steps = solution_of_few(rows, [-1.0 * shares[row][free] for row, _ in pivots])
        ways = [(free, np.ones(())), *zip([column for _, column in pivots], steps, strict=True)]
        ways = [(place, way) for place, way in ways if np.any(np.abs(number_or_one(way)) > DEPENDENT)]
        if any(np.any(number_or_one(way) < 0.0) for _, way in ways):
            names = " and ".join(ties[place].name for place, _ in ways)
            raise DefinitionError(f"{plan.title}: the thrusts leave the pressures of {names} open against each other; open one by a Tank.")
        lacking = [(least[place] - found[place]) / way for place, way in ways]
        up = reduce(np.maximum, lacking)
        for (place, way), lack in zip(ways, lacking, strict=True):  # exactly the least where that is what binds
            found[place] = least[place] + (up - lack) * way
    return found


def share_in(tie: Tie, member: TwoPoint, motion: Poses) -> FloatArray:
    """Return the share of a member in a tie, all of its parts together; 0 where it has none."""
    parts = [each.of(motion) for each in tie.shares if same(each.member, member)]
    return reduce(np.add, parts) if parts else np.zeros(())


def number_or_one(value: object) -> FloatArray:
    """Return a number as it is; of a program 1, for which its sign is taken as that of the plain design."""
    return np.ones(()) if is_traced(value) else np.asarray(value, float)


def pivots_of(matrix: FloatArray) -> list[tuple[int, int]]:
    """Return the rows and columns by which a matrix is eliminated, the largest left first, as many as its rank."""
    left, found = np.array(matrix, float), list[tuple[int, int]]()
    size = np.max(np.abs(left), initial=0.0)
    while left.size and len(found) < min(left.shape):
        row, column = np.unravel_index(int(np.argmax(np.abs(left))), left.shape)
        if not np.abs(left[row, column]) > DEPENDENT * size:
            break
        found.append((int(row), int(column)))
        left = left - np.outer(left[:, column], left[row]) / left[row, column]
        left[row], left[:, column] = 0.0, 0.0
    return found


DEPENDENT = 1e-9
"""A pivot below this part of the largest entry says that a row depends on others."""


def solution_of_few(A: Sequence[Sequence[FloatArray]], b: Sequence[FloatArray]) -> list[FloatArray]:
    """Return the solution of a few equations in their order, each number (n,) or of a program; no pivot may be nothing."""
    rows = [[*row, right] for row, right in zip(A, b, strict=True)]
    for k, row in enumerate(rows):
        row[k:] = [each / row[k] for each in row[k:]]
        for other in rows:
            if other is not row:
                other[k:] = [each - other[k] * own for each, own in zip(other[k:], row[k:], strict=True)]
    return [row[-1] for row in rows]


# The same of a program: one pose stands for all.


def numbers_of(matrix: FloatArray) -> list[list[FloatArray]]:
    """Return a matrix (n, k, k) as rows of numbers (n,) each, of a program as its numbers."""
    parts = matrix[0] if matrix.dtype == object else np.moveaxis(matrix, 0, -1)
    return [list(row) for row in parts]


def above_zero(size: FloatArray) -> FloatArray:
    """Return a size to divide by: 1 in the place of none."""
    return cast(FloatArray, np.where(size > 0.0, size, 1.0))


def where_negative(values: FloatArray, x: FloatArray, y: FloatArray) -> FloatArray:
    """Return x where values (n,) are below zero, else y."""
    if values.dtype != object:
        return np.where(values < 0.0, x, y)
    return cast(FloatArray, elementwise(lambda each, a, b: np.where(each < 0.0, a, b), (values, x, y)))
