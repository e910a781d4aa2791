"""A vehicle on its supports: the frame as a body with weights, which several supports under it push, and the ground holds by friction.

All that acts on the machine from outside acts on the frame at last: forces between its own bodies cancel, whatever its joints are. So the
loads of axles follow from the sum of the loads and their moment. Directions are counted from the first support: across the ground is
its own, along the ground is a quarter turn to the right of it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import partial
from typing import Unpack

import numpy as np
from numpy.typing import ArrayLike

from ..errors import DefinitionError, ensure, fits_shape, known_name, require
from ..frozen import immutable
from ..language import noted, said, translated
from ..loads import FRICTIONLESS, PLAIN, Acting, ActingKeywords, Case, ForceElement, Load, LoadCase, Loads, situation_of, takes_situation
from ..loads.acting import PLAIN_CASE
from ..loads.point import LinkMass, Support, Weight
from ..motion import Answer, Column, Condition, HasVerdicts, Judge, Motion, PageWords, Tabled, at, least, most, require_motion
from ..motion.dead_points import condition_of_sine
from ..motion.limits import where_said
from ..motion.requests import stroke_of
from ..plan import Plan
from ..program import FloatArray
from ..quantities import name_of, numbers_in
from ..units import show, shown_number
from ..verdict import Verdict
from .applied import applied_loads, elements_of, rates_in
from .holding import refused_where, where_negative
from .joints import Wrench, frame_points
from .law_requests import LawRequest, TracedMotion, once_in, request_text
from .poses import AnyMotion, FlatPoses, cross, motion_of_whole
from .solution import Equilibrium, check_joints, held_in_case, locked_words, system_with_friction
from .work import by_work

SAME_PLACE = 1e-9
"""m: supports that are nearer to each other stand at one place."""
SMALLEST = 1e-30
"""Nm: supports that resist turning no more than this stand at one place."""
AT_REST_ALONE = (FRICTIONLESS,)
"""A vehicle is judged at rest: friction inside it puts nothing on its supports."""
BEYOND = 1e-9
"""A resultant that lies beyond a support by less than this part of their distance lies above it."""


@immutable
class Standing:
    """How a vehicle stands on its supports; forces in N, shape (...), by the supports' names.

    `reactions` are the axle loads along the supports' directions: a support that lifts off among three or more has none, a negative one is
    what would have to hold it down, so that the vehicle tips over. `outermost` are those of the two outermost supports, were they alone:
    negative at one where the resultant lies beyond the other. `along` is what the ground puts on the frame along itself at the first
    support, `friction` how much it can by friction, None where no support says one. `forces` are the reactions as vectors, shape (2, ...),
    `brakes` what acts along the ground.
    """

    reactions: Mapping[str, FloatArray]
    outermost: Mapping[str, FloatArray]
    along: FloatArray
    friction: FloatArray | None
    forces: Mapping[str, FloatArray]
    brakes: FloatArray


@takes_situation
def standing(motion: Motion, loads: Loads = None, **situation: Unpack[ActingKeywords]) -> Standing:
    """Return how a vehicle stands on the supports under its frame, under the machine's own loads unless others are given.

    The supports are those of the class, and those among the loads, whose points do not move; with three or more all say a `stiffness`.

    Parameters
    ----------
    motion : Motion
        The poses; designs first, strokes last.
    loads : sequence of ForceElement or str, optional
        The loads; by default the machine's own.
    case, direction, rates, accelerations, inertia, acting : optional
        The situation, as in `Acting`; `acting` gives all in one.

    Returns
    -------
    Standing
        The loads of the supports, the margins, and the slip.
    """
    motion, acting = require_motion(motion)._machine_motion, situation_of("standing", loads=loads, **situation)
    return standing_of(motion, acting, vehicle_of(motion.plan, acting))


def standing_under(motion: AnyMotion, acting: Acting) -> Standing:
    """Return how a vehicle stands in a situation, worked out once for all that ask for one of its supports."""
    made = partial(standing_of, motion, acting, vehicle_of(motion.plan, acting))
    return made() if isinstance(motion, TracedMotion) else once_in(motion, acting, "standing", made)


def standing_of(motion: AnyMotion, acting: Acting, supports: Mapping[str, Support]) -> Standing:
    """Return how a vehicle stands on some supports over a motion's poses, as numbers of a program where it is traced."""
    motion = held_in_case(motion, acting)
    poses = FlatPoses(motion, "The axle loads", set())
    applied = applied_loads(motion, acting, rates_in(motion, acting))
    first, right = next(iter(supports)), to_the_right(poses, supports)
    start, force, moment = poses.at(name_of(supports[first].point)), poses.zeros(2).T, poses.zeros()
    for load in applied.loads:
        if load.element not in supports:
            own = poses.flattened(load.force)
            force, moment = force + own, moment + cross(poses.at(name_of(load.point)) - start, own)
    ways = {name: push_of(poses, each) for name, each in supports.items()}
    across = {name: part_along(way, ways[first]) for name, way in ways.items()}
    for name, part in across.items():
        if part.dtype != object and not np.all(part > 0.0):
            what = f"{poses.plan.title}: {name} pushes {supports[name].direction}, not to the side of {first}, {supports[first].direction}"
            raise DefinitionError(f"{what}; supports of a vehicle push to one side, such as (0, 1).", member=name)
    levers = [cross(poses.at(name_of(each.point)) - start, ways[name]) for name, each in supports.items()]
    balance = Balance(part_along(ways[first], force), np.asarray(moment), [*across.values()], levers)
    ends: list[FloatArray | None]
    if len(supports) == 2:
        ends = [*balance.by_two(0, 1)]
        found = np.stack([each for each in ends if each is not None])
    else:
        found, ends = by_stiffness(poses, supports, balance)
    carried = dict(zip(supports, found, strict=True))
    slants = [part_along(way, right) * carried[name] for name, way in ways.items()]
    along = 0.0 - part_along(right, force) - sum(slants, poses.zeros())
    rough = [
        poses.flattened(each.number(motion, "friction")) * carried[name] for name, each in supports.items() if each.friction is not None
    ]
    return Standing(
        {name: poses.full(force) for name, force in carried.items()},
        {name: poses.full(force) for name, force in zip(supports, ends, strict=True) if force is not None},
        poses.full(np.asarray(along)), poses.full(np.asarray(sum(rough, poses.zeros()))) if rough else None,
        {name: poses.full(way * carried[name]) for name, way in ways.items()}, poses.full(right * along),
    )  # fmt: skip


def standing_supports(motion: Motion, acting: Acting = PLAIN) -> dict[str, Support]:
    """Return the supports that a vehicle stands on in a situation; none for a machine that does not stand on any."""
    return {} if standing_if_any(motion, acting) is None else vehicle_of(motion.plan)


def standing_if_any(motion: AnyMotion, acting: Acting) -> Standing | None:
    """Return how a vehicle stands in a situation; None for a machine without supports under its frame, or that cannot stand on them."""
    try:
        return standing_under(motion, acting) if frame_supports(motion.plan, acting) else None
    except DefinitionError:
        return None


def ground_loads(motion: AnyMotion, acting: Acting) -> tuple[Load, ...]:
    """Return the ground's forces on a vehicle, by its supports: the axle loads, and at the first one the force along the ground."""
    found = standing_if_any(motion, acting)
    if found is None:
        return ()
    points = {name: name_of(each.point) for name, each in vehicle_of(motion.plan, acting).items()}
    first = next(iter(points))
    axles = [Load(points[name], force, element=name) for name, force in found.forces.items()]
    return (*axles, Load(points[first], found.brakes, element=said("{support} along the ground", support=first)))


def tipping_words(motion: Motion, acting: Acting) -> list[str]:
    """Return the words for supports that would have to hold a vehicle down: there it tips over."""
    found, words = standing_if_any(motion, acting), []
    for name, force in found.reactions.items() if found is not None else ():
        down = np.asarray(force < 0.0)
        if down.any():
            where, size = where_said(motion.plan, down, motion.strokes), show(-float(np.nanmin(force)), "kN", 4)
            words.append(said("tipping {where}: {support} would have to be held down with {force}.", where=where, support=name, force=size))
    return words


# Which supports a vehicle stands on.


def vehicle_of(plan: Plan, acting: Acting = PLAIN, given: Support | None = None) -> dict[str, Support]:
    """Return the supports under a machine's frame, in a situation; DefinitionError where it cannot stand on them.

    One that is `given` beside them takes the place of that under the same point.
    """
    found = frame_supports(plan, acting)
    if given is not None and given not in found.values():
        point = name_of(given.point)
        found = {name: each for name, each in found.items() if name_of(each.point) != point} | {given.name or str(given): given}
    ensure(found, f"{plan.title} has no support under a point of its frame; declare two, such as front = Support(A, (0, 1)).")
    first = next(iter(found))
    if not any(is_on_frame(plan, each) for each in plan.of_kind(ForceElement).values()):
        what = f"{plan.title} stands on {', '.join(found)}, but its frame weighs nothing"
        remedy = f"declare the vehicle, body = Weight(P, mass=...) with a fixed point P at its centre of gravity, or take {first} out"
        raise DefinitionError(f"{what}: {remedy}.", member=first)
    if len(found) == 1:
        what = f"{plan.title} stands on {first} alone and would turn over about it"
        raise DefinitionError(f"{what}; declare a second support under the frame, such as rear = Support(B, (0, 1)).", member=first)
    for name, each in found.items():
        if len(found) > 2 and each.stiffness is None:
            what = f"{plan.title} stands on {len(found)} supports, {', '.join(found)}: how they share its weight hangs on how they give way"
            raise DefinitionError(f"{what}; say stiffness= of {name}, in N/m, or take all but two out.", member=name)
    return found


def frame_supports(plan: Plan, acting: Acting = PLAIN) -> dict[str, Support]:
    """Return the supports under points that do not move: those of the class, and those among given loads in place of one at a point."""
    own = {name: each for name, each in plan.of_kind(Support).items() if is_under_frame(plan, each)}
    given = () if acting.loads is None else elements_of(plan, acting.loads)
    others = {name: each for name, each in given if isinstance(each, Support) and is_under_frame(plan, each) and each not in own.values()}
    taken = {name_of(each.point) for each in others.values()}
    return {name: each for name, each in own.items() if name_of(each.point) not in taken} | others


def is_under_frame(plan: Plan, support: Support) -> bool:
    """Return whether a support stands under a point of the frame."""
    return name_of(support.point) in frame_points(plan)


def is_on_frame(plan: Plan, element: ForceElement) -> bool:
    """Return whether an element is a weight of the frame."""
    if isinstance(element, LinkMass):
        return set(element.points(plan.members, plan.title)) <= frame_points(plan)
    return isinstance(element, Weight) and name_of(element.point) in frame_points(plan)


# The balance of the frame.


@immutable
class Balance:
    """The outer loads of a vehicle without its supports, at the first of them: across the ground [N], about it [Nm], (n,) each.

    `across` is what each support's newton gives across the ground, `levers` its lever about the first support, (n,) each [m].
    """

    force: FloatArray
    moment: FloatArray
    across: list[FloatArray]
    levers: list[FloatArray]

    def by_two(self, i: int, j: int) -> tuple[FloatArray, FloatArray]:
        """Return the reactions of two supports that carry alone, (n,) each."""
        across, levers = self.across, self.levers
        span = across[i] * levers[j] - across[j] * levers[i]
        if span.dtype != object and np.any(np.abs(span) <= SAME_PLACE):
            raise DefinitionError("Two supports of a vehicle stand at one place and do not hold it upright; set them apart.")
        return (
            np.asarray((across[j] * self.moment - levers[j] * self.force) / span),
            np.asarray((levers[i] * self.force - across[i] * self.moment) / span),
        )

    def outer(self, order: FloatArray) -> list[FloatArray | None]:
        """Return the loads of the two outermost supports alone, at their places among all, None at others; NaN where they are others."""
        found: list[FloatArray | None] = [None] * len(self.across)
        for i, j in {(int(i), int(j)) for i, j in zip(order[0], order[-1], strict=True)}:
            here = (order[0] == i) & (order[-1] == j)
            for place, force in zip((i, j), self.by_two(i, j), strict=True):
                before = found[place]
                found[place] = np.where(here, force, np.nan if before is None else before)
        return found


def push_of(poses: FlatPoses, support: Support) -> FloatArray:
    """Return the direction of a support, of length one, shape (2, n)."""
    way = support.pushes_along(poses.motion)
    return poses.flattened(way.reshape((2, *(1,) * (len(poses.motion.shape) + 1 - way.ndim), *way.shape[1:])))


def to_the_right(poses: FlatPoses, supports: Mapping[str, Support]) -> FloatArray:
    """Return the direction along the ground at the first support, shape (2, n)."""
    x, y = push_of(poses, next(iter(supports.values())))
    return np.stack([y, 0.0 - x])


def part_along(a: FloatArray, b: FloatArray) -> FloatArray:
    """Return the product of two vectors (2, n), shape (n,)."""
    return np.asarray(a[0] * b[0] + a[1] * b[1])


def by_stiffness(poses: FlatPoses, supports: Mapping[str, Support], balance: Balance) -> tuple[FloatArray, list[FloatArray | None]]:
    """Return the reactions of three or more supports that give way, (supports, n), and those of the two outermost, were they alone.

    A rigid frame sinks and turns; one by one the last support of the side that rises lifts off, and the others are asked again.
    """
    many = len(supports)
    stiffnesses = [poses.flattened(each.number(poses.motion, "stiffness")) for each in supports.values()]
    a, b, k, order = by_place(balance.across, balance.levers, stiffnesses, [poses.zeros() + number for number in range(many)])

    def carried(low: int, high: int) -> FloatArray:
        """Return the reactions where the supports from low to before high carry, (supports, n)."""
        own = np.zeros((many, 1))
        own[low:high] = 1.0
        w = k * own
        stiff = (w * a * a).sum(axis=0)
        centre = (w * a * b).sum(axis=0) / stiff  # about it the frame turns without sinking
        arms = b - a * centre
        resists = (w * arms * arms).sum(axis=0)
        resists = where_negative(SMALLEST - resists, resists, 0.0 * resists + 1.0)  # those at one place, which do not carry alone
        sinks, turns = balance.force / stiff, (balance.moment - centre * balance.force) / resists
        return np.asarray(0.0 - w * (a * sinks + arms * turns))

    def lifted(found: FloatArray, left: bool) -> FloatArray:
        """Return the reactions where supports of one side lift off, one after the other, down to two that stand apart."""
        places = b / a
        for gone in range(1, many - 1):
            last, (low, high) = (gone - 1, (gone, many)) if left else (many - gone, (0, many - gone))
            fewer = where_negative(SAME_PLACE - (places[high - 1] - places[low]), carried(low, high), found)
            found = where_negative(found[last], fewer, found)
        return found

    whole = carried(0, many)
    found = where_negative(whole[-1], lifted(whole, False), where_negative(whole[0], lifted(whole, True), whole))
    own = [where_negative((order - number) ** 2 - 0.25, found, 0.0 * found).sum(axis=0) for number in range(many)]
    return np.stack(own), balance.outer(order) if order.dtype != object else [None] * many


def by_place(*given: list[FloatArray]) -> tuple[FloatArray, ...]:
    """Return rows of numbers of the supports, (supports, n) each, in the order of their places: of the second row over the first one."""
    rows = [list(row) for row in given]
    a, b, *_ = rows
    for last in range(len(a) - 1, 0, -1):
        for left in range(last):
            step = b[left + 1] / a[left + 1] - b[left] / a[left]
            for row in rows:
                row[left], row[left + 1] = where_negative(step, row[left + 1], row[left]), where_negative(step, row[left], row[left + 1])
    return tuple(np.stack(row) for row in rows)


# Before any load: what the vehicle's own weight puts on its supports.


def bare_loads(motion: Motion, supports: Mapping[str, Support]) -> Mapping[str, float]:
    """Return the loads of each support from the weights of the frame alone [N], of one design; DefinitionError without a footing.

    It is the same at all poses; of a batch, and where no pose is reached, there are none.
    """
    plan = motion.plan
    if motion._design_shape or not motion.reached.any():
        return {}
    weights = [each for each in plan.of_kind(ForceElement).values() if is_on_frame(plan, each)]
    pose = motion.moved({name: value[motion.reached][:1] for name, value in motion.strokes.items()})
    found = standing_of(pose, Acting(loads=weights), supports)
    outermost = {name: float(np.ravel(each)[0]) for name, each in found.outermost.items()}
    low, high = sorted(outermost, key=lambda name: outermost[name])
    least_force, force = outermost[low], outermost[high]
    if not abs(least_force) + abs(force) > 0.0:
        raise DefinitionError(f"{plan.title} stands on nothing: its frame weighs nothing. Give its weight a mass above zero.")
    if least_force < -BEYOND * abs(force):
        poses = FlatPoses(pose, "The supports", set())
        apart = poses.at(name_of(supports[low].point)) - poses.at(name_of(supports[high].point))
        away = show(-least_force / abs(force + least_force) * abs(float(part_along(apart, to_the_right(poses, supports))[0])), "mm", 4)
        what = f"{plan.title} stands on nothing: the weight of its frame lies {away} beyond {high} before any load"
        names = ", ".join(each.name or str(each) for each in weights)
        remedy = f"move {names} between the supports, or a support under it"
        raise DefinitionError(f"{what}, so that {low} would have to hold it down; {remedy}.", member=high)
    return {name: float(np.ravel(each)[0]) for name, each in found.reactions.items()}


# What is asked of a vehicle.


def axle_load(support: str | Support, *, case: Case = None, acting: Acting | None = None) -> LawRequest:
    """Return the request for the load of an axle [N], in `evaluate`, `answers` and searches: `reaction(motion, support="rear", case=...)`.

    Below zero it is what would have to hold the support down: the vehicle tips over.

    Parameters
    ----------
    support : str or Support
        The support, or its name.
    case : LoadCase or str, optional
        A load case, or its name.
    acting : Acting, optional
        Loads, load case, direction and rates in one.

    Returns
    -------
    Request
        The load [N].
    """
    name = name_of(support)
    given = situation_of("axle_load", acting, case=case)
    return LawRequest(
        formula=partial(load_over, name), text=partial(request_text, "axle_load", (name,)), known=("axle load", name), acting=given,
        measures="force", directions=AT_REST_ALONE, examine=partial(support_in, name),
    )  # fmt: skip


def slipping(*, case: Case = None, acting: Acting | None = None) -> LawRequest:
    """Return the request for how much of its friction with the ground a vehicle uses along it; at 1 it slips.

    Parameters
    ----------
    case : LoadCase or str, optional
        A load case, or its name.
    acting : Acting, optional
        Loads, load case, direction and rates in one.

    Returns
    -------
    Request
        The used share of the friction.
    """
    given = situation_of("slipping", acting, case=case)
    text = partial(request_text, "slipping", ())
    return LawRequest(
        formula=used_over, text=text, known=("slipping",), acting=given, measures="number", directions=AT_REST_ALONE, examine=rough_in
    )


def support_in(name: str, plan: Plan) -> None:
    """Raise DefinitionError where a plan has no such support under its frame."""
    found = vehicle_of(plan)
    ensure(name in found, f"{plan.title}: {name} is no support under its frame; these are {', '.join(found)}.")


def rough_in(plan: Plan) -> None:
    """Raise DefinitionError where no support of a plan says how rough the ground is."""
    if not any(each.friction is not None for each in vehicle_of(plan).values()):
        raise DefinitionError(f"{plan.title}: no support says friction=, so that nothing tells when it slips; say it, friction=0.6.")


def load_over(name: str, motion: AnyMotion, acting: Acting) -> FloatArray:
    """Return the load of an axle over a motion's poses [N], shape (...); of one read in a part, its load in the whole."""
    held = motion_of_whole(motion, motion.plan.members[name])
    if held is not None:
        whole, support = held
        support_in(support.name, whole.plan)
        return load_over(support.name, whole, acting)
    return np.array(standing_under(motion, acting).reactions[name])[()]


def used_over(motion: AnyMotion, acting: Acting) -> FloatArray:
    """Return the use of the friction over a motion's poses, shape (...); infinite where nothing presses and something pushes."""
    motion = motion._machine_motion if isinstance(motion, Motion) else motion
    found = standing_under(motion, acting)
    if found.friction is None:
        rough_in(motion.plan)
    assert found.friction is not None
    if isinstance(motion, TracedMotion):
        return np.asarray(np.abs(found.along) / found.friction)[()]
    with np.errstate(divide="ignore", invalid="ignore"):
        used = np.abs(found.along) / np.maximum(found.friction, 0.0)
    return np.where((found.along == 0.0) & (found.friction <= 0.0), 0.0, used)


# What a support under the frame shows and says.


class AxleLoad(Tabled, HasVerdicts):
    """The table and verdicts of a support under the frame: its load, whether it lifts off, whether the vehicle slips."""

    def __init__(self, support: Support, plan: Plan) -> None:
        self.support = support
        self.is_first = next(iter(frame_supports(plan))) == support.name

    section = noted("Vehicle")
    caption = noted("Axle loads, over all that the machine runs")
    headed = noted("Axle {name}")

    @classmethod
    def of(cls, support: Support, plan: Plan) -> AxleLoad | None:
        """Return it for a support under the frame; None for one under a point that moves."""
        return cls(support, plan) if is_under_frame(plan, support) else None

    def columns(self, motion: Motion) -> list[Column]:
        return self.columns_in(motion)

    def columns_in(self, motion: Motion, case: LoadCase | str | None = None, direction: str | None = None) -> list[Column]:
        request, name = axle_load(self.support.name, case=case), noted("axle load")
        return [Column(name, request.of(motion), "kN", 3, request if direction is None else None)]

    def conditions(self, judge: Judge) -> Mapping[str, Condition]:
        """Return that on its load; of the first support that on slipping, too, where one says how rough the ground is."""
        try:
            supports = vehicle_of(judge.plan)
        except DefinitionError:
            return {}
        found: dict[str, Condition] = {"axle load": least(axle_load(self.support.name)) >= 0.0}
        return found | (
            {"slipping": most(slipping()) <= 1.0} if self.is_first and any(each.friction is not None for each in supports.values()) else {}
        )

    def page_words(self, judge: Judge) -> Mapping[str, PageWords]:
        name, weights = self.support.name, [each for each in judge.plan.of_kind(ForceElement).values() if is_on_frame(judge.plan, each)]
        kept = least(axle_load(name)) / at(axle_load(name, acting=Acting(loads=weights, case=PLAIN_CASE)), **judge.plan.sketch_strokes)  # type: ignore[arg-type]
        keeps = noted("least load {value} % of what the vehicle alone puts on it, {place}; at 0 % it lifts off")
        uses = noted("along the ground it uses at most {value} % of its friction, {place}; at 100 % it slips")
        return {
            "axle load": PageWords(keeps, 100.0 * kept, 1.0 - kept, {">=": TIPPING}),
            "slipping": PageWords(uses, 100.0 * most(slipping()), fails={"<=": SLIPPING}),
        }

    def load_limits(self, judge: Judge) -> Mapping[str, Condition]:
        return {}

    def verdicts(self, judge: Judge) -> list[Verdict]:
        """Return how much of its load the support keeps, and whether the vehicle slips."""
        try:
            bare_of = judge.motion._once("bare loads", lambda: bare_loads(judge.motion, vehicle_of(judge.plan)))
            bare, found = bare_of.get(self.support.name, 0.0), []
            for rule, condition in self.conditions(judge).items():
                answer = judge.answer(condition)
                words = load_sentence(answer, bare) if rule == "axle load" else slipping_sentence(answer)
                found.append(Verdict(rule, answer.ok, f"{answer}." if np.isnan(answer.value) else words, answer=answer))
            return found
        except DefinitionError as error:
            return [Verdict.refused("axle load", error)] if self.is_first else []


TIPPING = noted("tipping {place}: it would have to be held down with {force}. Add weight on its side, or set the supports wider.")
SLIPPING = noted("slipping {place}: along the ground it needs {share} % of its friction. Take a gentler slope, or chock it.")


def load_sentence(found: Answer, bare: float) -> str:
    """Return the change of an axle's load, in words; `bare` is that of the vehicle alone [N]."""
    load, place = float(found.value), found.place
    force = show(abs(load), "kN", 4)
    if load < 0.0:
        return translated(TIPPING).format(place=place, force=force)
    if load == 0.0:
        return said("it lifts off, such as {place}; the others carry.", place=place)
    if not bare > 0.0:
        return said("it carries at least {force} {place}, without a load nothing; at 0 it lifts off.", force=force, place=place)
    text = noted("least load {force} {place}: {share} % of the {bare} that the vehicle alone puts on it; at 0 it lifts off.")
    share, own = shown_number(100.0 * load / bare, "", 3), show(bare, "kN", 4)
    return translated(text).format(force=force, place=place, share=share, bare=own)


def slipping_sentence(worst: Answer) -> str:
    """Return how much of its friction with the ground a vehicle uses, in words."""
    if np.isinf(worst.value):
        return said("slipping {place}: nothing presses it to the ground there.", place=worst.place)
    if worst.value == 0.0:
        return said("along the ground it uses none of its friction.")
    text = noted("along the ground it uses at most {share} % of its friction, {place}; at 100 % it slips.") if worst.ok else SLIPPING
    return translated(text).format(share=shown_number(100.0 * float(worst.value), "", 3, None if worst.ok else 100.0), place=worst.place)


# The force of a support when the drive's force is known.


@takes_situation
def reaction(
    motion: Motion,
    loads: Loads = None,
    support: Support | str | None = None,
    *,
    drive_force: ArrayLike = 0.0,
    drive: str | None = None,
    **situation: Unpack[ActingKeywords],
) -> FloatArray:
    """Return the force of a support along its direction, shape (...) [N], when the drive's force is known.

    `drive_force` [N or Nm] is the drive's own, as `driving_force` counts it, a number or an array over the motion. Leave it 0 where
    an element such as a charged line stands for it. The machine's only Support is meant unless one is given; its own `force` does
    not count. With several strokes `drive` names the one that the support balances; the others stand still. Raises SingularError
    where the support's point does not move along its direction with the drive.

    Of a support under the frame it is its axle load: what the drive's force is does not matter there. DefinitionError where the frame
    weighs nothing or stands on nothing; see `standing` for all that is known of a vehicle on its supports.

    Parameters
    ----------
    motion : Motion
        The poses; designs first, strokes last.
    loads : sequence of ForceElement or str, optional
        The loads; by default the machine's own.
    support : Support or str, optional
        The support, where there are several.
    drive_force : float or array_like
        The drive's own force [N or N m].
    drive : str, optional
        The stroke that the support balances.
    case, direction, rates, accelerations, inertia, acting : optional
        The situation, as in `Acting`; `acting` gives all in one.

    Returns
    -------
    ndarray
        The force [N], shape (...).

    Raises
    ------
    SingularError
        The support's point does not move along its direction.
    DefinitionError
        The frame weighs nothing, or has no supports.
    """
    acting = situation_of("reaction", loads=loads, **situation)
    motion = held_in_case(require_motion(motion), acting)
    own, title = motion.plan.of_kind(Support), motion.plan.title
    ensure(support is not None or len(own) == 1, f"{title} has {len(own)} supports: say which one, such as Support('R', (0, 1)).")
    if isinstance(support, Support):
        name, element = support.name or str(support), support
    else:
        name = known_name("Support", next(iter(own)) if support is None else support, own, where=title)
        element = own[name]
    known = numbers_in(drive_force)
    expected = f"a number or an array that fits the poses {motion.shape} is expected"
    require(fits_shape(known, motion.shape), "drive_force", drive_force, expected)
    known = np.asarray(np.broadcast_to(known, motion.shape))
    require(np.all(np.isfinite(known[motion.reached])), "drive_force", drive_force, "is not finite at every pose; give numbers in N or Nm")
    if not is_under_frame(motion.plan, element):
        motion._refuse_part(f"the reaction of {name}")
        return balancing_reaction(motion, acting, name, element, stroke_of(motion.plan, drive, "drive"), known)
    held = motion._of_the_whole(element) if element.name else None
    if held is not None:
        return reaction(held[0], support=held[1], drive_force=drive_force, drive=drive, acting=acting)
    what = f"{title}: {name} bears the frame, and a drive's force acts between the frame and what it drives"
    ensure(not np.any(known), f"{what}: an axle load does not hang on it; leave drive_force= out.")
    acting = acting if drive is None else replace(acting, drive=drive)
    supports = vehicle_of(motion.plan, acting, element)
    bare_loads(motion, supports)
    return standing_of(motion, acting, supports).reactions[name]


def balancing_reaction(motion: Motion, acting: Acting, name: str, support: Support, stroke: str, known: FloatArray) -> FloatArray:
    """Return the force, shape (...) [N], of a support under a point that moves, which balances the loads beside a known drive force."""
    point, plan = name_of(support.point), motion.plan
    beside = [word for word in ("stiffness", "friction") if getattr(support, word) is not None]
    if beside:
        what = f"{plan.title}: {name} says {beside[0]}=, but stands under {point}, which moves"
        raise DefinitionError(f"{what}; that counts under the frame alone. Leave it out; friction of joints is PinFriction, GuideFriction.")
    applied = applied_loads(motion, acting, rates_in(motion, acting, stroke), without=name)
    poses = FlatPoses(motion, f"The reaction of {name}")
    known, push = poses.flattened(known), push_of(poses, support)
    along = (poses.rate(point, stroke) * push).sum(axis=0)
    carrying = [each for each in plan.moving if each in plan.reaches(point)]
    size = np.max([np.hypot(*poses.rate(each, stroke)) for each in carrying], axis=0, initial=0.0)  # of the fastest point on the way to it
    with np.errstate(divide="ignore", invalid="ignore"):
        cond = condition_of_sine(np.where(size > 0.0, along / np.where(size > 0.0, size, 1.0), 0.0))
    why = f"its point {point} does not move along its direction with {stroke}, so that no reaction balances the drive"
    lever = refused_where(poses, along, cond, f"The reaction of {name}", why)
    if not applied.frictions:
        return poses.full((by_work(poses, applied, stroke) - known) / lever)
    # with friction: the reaction at which it, the joint forces and the known drive force agree
    system = system_with_friction(poses, applied)
    column = np.zeros((poses.count, system.starts[-1], 1))
    for row, value in system.parts(system.structure.holder(point), Wrench(poses.at(point), push, np.zeros(poses.count))):
        column[:, row, 0] += value
    found = Equilibrium(system, given=((system.drive(stroke), known),), supports=column).solution()
    check_joints(system.structure, poses)
    locked_words(found, applied.rates.direction)
    return poses.full(found.u[:, -1])
