"""Forces of bounded elements under the machine's own loads and a load at a point: affine in the load, so that two solves give all.

An element is bounded where it says so, `ForceElement.bounds`: a cylinder by its circuit, a support by being able to push alone. Beside
these forces stand the members' own conditions, those of their verdicts, pose by pose: a rope that would push, a line that runs empty.
With friction the load is found by secants on the same bounds, on lines whose cylinders share otherwise while they pull in a bracket.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import cached_property, partial
from typing import Any, TypeAlias, cast

import numpy as np

from ..errors import DefinitionError, SingularError, ensure, require, unwarned
from ..frozen import immutable
from ..language import noted
from ..loads import Acting, Case, Force, ForceElement, Support, TwoPoint
from ..motion import HasVerdicts, Judge, Motion, Over, RequestLike, speakers
from ..motion.grid import not_joined
from ..motion.judge import Domain
from ..motion.measures import Leaf, Measure, words_of
from ..motion.places import way_of
from ..plan import Mask, Plan
from ..program import FloatArray, Kernel
from ..quantities import Quantity, name_of, quantity, real
from ..vectors import Numbers
from .applied import case_of
from .holding import holders_of, is_among
from .law_requests import LawRequest, TracedMotion
from .poses import AnyMotion
from .vehicle import bare_loads, frame_supports, standing_of, vehicle_of
from .work import pump_thrust

TIPPING, SLIPPING = noted("tipping"), noted("slipping")
"""What a vehicle's supports limit a load by."""
ROUNDS = 16
"""How often a load is put right where forces are not affine in it."""
TRIED = 9
"""At how many poses it is seen whether conditions are affine in the load."""


@immutable
class LoadAt:
    """A load at a point that pulls against a direction of length one, beside the machine's own loads of a load case.

    `without` are elements that are left out; `share` is that of the pump's pressure, `lifts` the elements that lift, all for None.
    """

    plan: Plan
    designs: Mapping[str, Numbers]
    point: str
    along: Direction
    case: Case = None
    without: tuple[str, ...] = ()
    lifts: frozenset[str] | None = None
    share: float = 1.0

    # -- what acts -----------------------------------------------------------------------------------------

    @cached_property
    def own(self) -> Acting:
        """The machine's own loads."""
        if not self.without:
            return Acting(case=self.case)
        loads = [name for name in self.plan.of_kind(ForceElement) if name not in self.without]
        case = case_of(self.plan, self.case)
        if case.only is None and not any(name in self.without for name in case.scale):
            return Acting(loads, self.case)
        kept = None if case.only is None else [name_of(each) for each in case.only if name_of(each) not in self.without]
        scale = {name: value for name, value in case.scale.items() if name not in self.without}
        return Acting(loads, replace(case, only=kept, scale=scale))  # a case may name what is left out

    @cached_property
    def limits(self) -> tuple[MemberLimit, ...]:
        """The members' own conditions."""
        return member_limits(self.plan, self.case) if self.bounded or self.supports else ()

    @cached_property
    def bent(self) -> list[MemberLimit]:
        """Those that are not affine in the load."""
        motion = Domain(self.plan, self.designs, Over()).motion
        ends, rows = {name: (np.min(each), np.max(each)) for name, each in motion.strokes.items()}, np.random.default_rng(1)
        some = self.motion_over({name: rows.uniform(low, high, TRIED) for name, (low, high) in ends.items()})
        return [each for each in self.limits if each.is_bent(some, partial(self.with_load, motion=some))]

    def failing(self, motion: Motion, load: FloatArray) -> dict[str, Mask]:
        """Return at which poses conditions that limit no load fail under one [N], each by its name."""
        found: dict[str, Mask] = {}
        for each in member_limits(self.plan, self.case, are_remarks=True):
            found[each.name] = found.get(each.name, False) | (each.spare(motion, self.with_load(load, motion)) < 0.0)
        return found

    def with_load(self, load: FloatArray | float, motion: AnyMotion) -> Acting:
        """Return the machine's own loads with a load [N] at the poses of a motion, or shaped as these."""
        own = [*self.plan.of_kind(ForceElement)] if self.own.loads is None else [*self.own.loads]  # type: ignore[misc]
        return replace(self.own, loads=[*own, pulling(self.point, self.along, load, motion)])

    # -- what bounds ---------------------------------------------------------------------------------------

    @cached_property
    def some(self) -> Motion:
        """Three poses, which show the values that are the same at all of them."""
        return self.motion_over({name: np.repeat(value, 3) for name, value in self.plan.sketch_strokes.items()})

    @cached_property
    def bounded(self) -> Mapping[str, TwoPoint]:
        """The cylinders that hold and say bounds, by name."""
        found, held = {}, holders_of(self.plan).lines
        for name, element in self.plan.of_kind(TwoPoint).items():
            if element.holds and any(is_among(element, line.cylinders) for line in held):
                low, high = element.bounds(self.some, self.lifting(name), share=self.share)
                if np.any(np.isfinite(low) | np.isfinite(high)) and not np.array_equal(low, high):
                    found[name] = element
        return found

    @cached_property
    def supports(self) -> Mapping[str, Support]:
        """The supports that the machine stands on as a vehicle; none for one without; DefinitionError where it cannot stand on them."""
        if not frame_supports(self.plan):
            return {}
        found = vehicle_of(self.plan)
        bare_loads(self.some, found)
        return found

    @cached_property
    def outermost(self) -> Mapping[str, Support]:
        """The two supports between which the resultant has to lie: beyond one of them it tips."""
        if len(self.supports) < 3:
            return self.supports
        return {name: self.supports[name] for name in standing_of(self.some, self.own, self.supports).outermost}

    @cached_property
    def kinds(self) -> tuple[str, ...]:
        """The limit of each bounded force, in their order: the name of a cylinder, "tipping", "slipping", a member's condition."""
        slips = (SLIPPING, SLIPPING) if any(each.friction is not None for each in self.supports.values()) else ()
        return (*self.bounded, *(TIPPING for _ in self.outermost), *slips, *(each.name for each in self.limits))

    def carried(self, motion: AnyMotion, acting: Acting) -> list[FloatArray]:
        """Return the bounded forces in a situation: thrusts, axle loads, the unused ground friction either way [N]."""
        found = [pump_thrust(motion, each, acting) for each in self.bounded.values()]
        if self.supports:
            ends = standing_of(motion, acting, self.outermost)
            found += [ends.reactions[name] for name in self.outermost]
            ground = ends if len(self.supports) == 2 or SLIPPING not in self.kinds else standing_of(motion, acting, self.supports)
            if SLIPPING in self.kinds and ground.friction is not None:
                found += [ground.friction - ground.along, ground.friction + ground.along]
        return found

    def own_and_share(self, motion: AnyMotion) -> tuple[list[FloatArray], list[FloatArray]]:
        """Return each bounded force and condition under the own loads, and its growth with the load."""
        forces, loaded = self.carried(motion, self.own), self.with_load(PROBE, motion)
        if any(each.closed_thrust(motion, self.own) is not None for each in self.bounded.values()):
            share = [(b - a) / PROBE for a, b in zip(forces, self.carried(motion, loaded), strict=True)]
        else:
            share = self.carried(motion, Acting([pulling(self.point, self.along, 1.0, motion)]))
        own, beside = ([each.value(motion, acting) for each in self.limits] for acting in (self.own, loaded))
        return [*forces, *own], [*share, *((b - a) / PROBE for a, b in zip(own, beside, strict=True))]

    def bounds(self, motion: Motion) -> list[tuple[FloatArray, FloatArray]]:
        """Return between which two values each bounded force [N] and each condition stands."""
        found = [each.bounds(motion, self.lifting(name), share=self.share) for name, each in self.bounded.items()]
        found += [each.bounds(motion, False) for each in self.outermost.values()]
        slips = ((np.zeros(()), np.asarray(np.inf)) for kind in self.kinds if kind == SLIPPING)
        return [*found, *slips, *(each.bounds(motion) for each in self.limits)]

    def lifting(self, name: str) -> bool:
        """Return whether an element lifts."""
        return self.lifts is None or name in self.lifts

    def motion_over(self, strokes: Mapping[str, FloatArray]) -> Motion:
        """Return the motion of some poses that have nothing to do with each other."""
        with unwarned():
            return Motion(self.plan, self.designs, strokes, "nan", joining=not_joined)

    @cached_property
    def is_affine(self) -> bool:
        """Whether forces are affine in the load."""
        elements = [element for name, element in self.plan.of_kind(ForceElement).items() if name not in self.without]
        return not any(each.frictions(self.some) for each in elements) and not holders_of(self.plan).changes_shares

    # -- the forces ----------------------------------------------------------------------------------------

    @cached_property
    def program(self) -> Kernel | None:
        """The kernel of each bounded element's force from the own loads, then from one newton of the load; None where there is none."""
        case = self.case if self.case is None or isinstance(self.case, str) else id(self.case)
        way = tuple(each if isinstance(each, float) else each.identity for each in self.along)
        key = ("carried", self.point, way, case, self.without, self.kinds)

        def made(fork: Plan) -> Kernel:
            motion = TracedMotion(fork, fork.trace)
            found = [each for one in self.own_and_share(motion) for each in one]
            return Kernel([motion.node(np.asarray(each, object).item()) for each in found], [*motion.notes.assumed])

        try:
            return self.plan.made(key, made)
        except DefinitionError:
            return None

    @cached_property
    def fixed(self) -> tuple[FloatArray, FloatArray] | None:
        """The lowest and highest force of each bounded element where they are the same at all poses (elements, 1), else None."""
        found = self.bounds(self.some)
        if any(np.size(end) != 1 for each in found for end in each):
            return None
        low, high = (np.array([[float(np.squeeze(each[at]))] for each in found]).reshape(-1, 1) for at in (0, 1))
        return low, high

    def at(self, strokes: Mapping[str, FloatArray]) -> FloatArray:
        """Return the greatest load that leaves each bounded force within its bounds [N], shape (forces, n), at strokes (n,).

        They are those of `kinds`. Infinite where the load does nothing to one; 0 where the machine alone is too heavy for it; NaN where
        what it hangs on is not reached.
        """
        count = len(next(iter(strokes.values())))
        if self.is_affine and not self.bent and self.program is not None and self.fixed is not None and not self.plan.solved:
            values = self._run(self.program, {**self.designs, **strokes}, count)
            if values is not None:
                return greatest_load(values[0], values[1], *self.fixed)
        return self.greatest_loads(self.motion_over(strokes))

    def _run(self, kernel: Kernel, inputs: Mapping[str, Numbers], count: int) -> FloatArray | None:
        """Return the forces of the own loads and of one newton (2, elements, n); None where an assumption fails."""
        found = kernel(inputs, way=way_of(count), size=(1, count))
        return found.values[:, 0].reshape(2, -1, count) if found.is_clear else None

    def greatest_loads(self, motion: Motion) -> FloatArray:
        """Return the same at the poses of a motion, shape (elements, n)."""
        if not self.kinds:
            return np.empty((0, *motion.shape))
        bounds, forces = self.bounds(motion), None
        low, high = (np.stack([np.broadcast_to(each[at], motion.shape) for each in bounds]) for at in (0, 1))
        if self.is_affine and self.program is not None:
            forces = self._run(self.program, motion._grid.flat, motion.shape[0])
        if forces is None:
            with unwarned():
                each = [np.broadcast_to(one, motion.shape) for part in self.own_and_share(motion) for one in part]
            forces = np.array(each, float).reshape(2, len(self.kinds), motion.shape[0])
        own, share = forces
        found = greatest_load(own, share, low, high)
        for at, name in enumerate(self.bounded if not self.is_affine else ()):
            found[at] = self._found(motion, name, share[at], low[at], high[at])
        first = len(self.kinds) - len(self.limits)
        for at, limit in enumerate(self.limits, first):
            if limit in self.bent:
                found[at] = limit.greatest_load(motion, partial(self.with_load, motion=motion))
        return found

    def _found(self, motion: Motion, name: str, share: FloatArray, low: FloatArray, high: FloatArray) -> FloatArray:
        """Return the greatest load for one element whose force is not affine in it, by secants or a bracket.

        It moves as the load is lifted.
        """
        element, ways = self.bounded[name], {1.0: "extending", -1.0: "retracting"}

        def force(load: FloatArray) -> FloatArray:
            with unwarned():
                if not self.lifting(name):
                    return pump_thrust(motion, element, self.with_load(load, motion))
                out, back = (pump_thrust(motion, element, replace(self.with_load(load, motion), direction=way)) for way in ways.values())
            return np.where(share > 0.0, out, back)

        alone = force(np.zeros(motion.shape))
        found = greatest_load(alone, share, low, high)
        if holders_of(self.plan).changes_shares:  # a line through two loads may meet neither its push nor its pull

            def spare(load: FloatArray) -> FloatArray:
                carried = force(load)
                return np.minimum(carried - low, high - carried) + KEPT

            return greatest_kept(spare, spare(np.zeros(motion.shape)), found)
        for _ in range(ROUNDS):
            known = np.isfinite(found) & (found > 0.0)
            guess = np.where(known, found, 1.0)
            slope = (force(guess) - alone) / guess
            before, found = found, np.where(known, greatest_load(alone, slope, low, high), found)
            if np.all(np.abs(found - before)[known] <= SAME * np.abs(found)[known]):
                break
        return found


# Members' own conditions, those of their verdicts, as limits of a load: a rope that would push, a closed line that runs empty.


IDLE = 1e-12
"""A force for each newton of the load that is this small is none."""
PROBE, MOST = 1e4, 1e9
"""The load by which it is seen how a condition follows it, and one that nothing carries [N]."""
KEPT, STRAIGHT = 1e-6, 1e-9
"""A condition that is missed by no more is kept [SI]; the share of what it spares alone by which it is met, where it is affine."""
NARROWED, SAME = 60, 1e-13
"""How often a bracket of a load is narrowed at the most, and the share of itself to which it is."""


@immutable
class MemberLimit:
    """A member's own condition, pose by pose, in one situation that occurs: a value stays at or above a number, or at or below it."""

    name: str
    request: LawRequest | Quantity
    right: Measure
    is_least: bool

    def value(self, motion: AnyMotion, acting: Acting) -> FloatArray:
        """Return the compared value, shape (...); over a path in time as it runs."""
        request = self.request
        if not isinstance(request, LawRequest):
            return motion.value(request)
        if isinstance(motion, Motion) and motion.time is not None and request.situation.is_moving:
            request = replace(request, acting=replace(request.situation, direction=None))
        return request.under(acting, keep=True).law(motion)

    def bounds(self, motion: Motion) -> tuple[FloatArray, FloatArray]:
        """Return between which two values it is kept, to rounding."""
        right: FloatArray = np.asarray(self.right.from_leaves(lambda leaf: motion[cast(RequestLike, leaf.quantity)]), np.float64)
        return (right - KEPT, np.asarray(np.inf)) if self.is_least else (np.asarray(-np.inf), right + KEPT)

    def spare(self, motion: Motion, acting: Acting) -> FloatArray:
        """Return how far its value is from where it fails, below zero where it does, shape (...)."""
        low, high = self.bounds(motion)
        with unwarned(), np.errstate(all="ignore"):
            value = self.value(motion, acting) + np.zeros(motion.shape)
            return np.minimum(value - low, high - value)

    def is_bent(self, motion: Motion, beside: Callable[[float], Acting]) -> bool:
        """Return whether it is not affine in a load, as seen at some poses, up to one that nothing carries."""
        back, own, out = (self.spare(motion, beside(load)) for load in (-MOST, 0.0, MOST))
        return bool(np.any(np.abs(back + out - 2.0 * own) > 1e2 * STRAIGHT * (np.abs(back) + np.abs(out))))

    def greatest_load(self, motion: Motion, beside: Callable[[FloatArray | float], Acting]) -> FloatArray:
        """Return the greatest load that keeps it [N], shape (...); `beside(load)` is the situation with it; see `greatest_load`."""

        def spare(load: FloatArray) -> FloatArray:
            return self.spare(motion, beside(load))

        nothing = np.zeros(motion.shape)
        alone = spare(nothing)
        found = greatest_load(alone, (spare(nothing + PROBE) - alone) / PROBE, nothing, np.asarray(np.inf))
        left = spare(np.where(np.isfinite(found), found, MOST))
        is_bent = np.where(np.isfinite(found), np.abs(left) > STRAIGHT * (np.abs(alone) + KEPT), left < 0.0) & (found != 0.0)
        return greatest_kept(spare, alone, found) if np.any(is_bent) else found


def member_limits(plan: Plan, case: Case, *, are_remarks: bool = False) -> tuple[MemberLimit, ...]:
    """Return the conditions of a plan's members that limit a load, or are remarks, in each situation that occurs in a load case.

    They are those of the verdicts, as far as they compare what has a value at every pose with what is the same at all.
    """

    def made(plan: Plan) -> tuple[MemberLimit, ...]:
        pose, load = [Over(**cast(Any, plan.sketch_strokes))], Force(plan.moving[-1], (0.0, -1.0))
        judge, loaded = (Judge(plan, plan.defaults, pose, Acting(loads, case)) for loads in (None, [load]))
        found = []
        for name, member in speakers(plan, HasVerdicts).items():
            for rule, condition in (member.load_remarks(loaded) if are_remarks else member.load_limits(loaded)).items():
                for each in condition.constraints(None):
                    is_least = each.left.sense < 0.0
                    if isinstance(each.left, Leaf) and each.left.sense and each.symbol == (">=" if is_least else "<="):
                        for row in judge.search_rows(each.left, judge.places[0]):
                            request = row.piece.below if row.stays_at_zero else row.piece.request
                            if isinstance(request, (LawRequest, Quantity)):
                                found.append(MemberLimit(f"{rule} {name}", request, each.right, is_least))
        return tuple(found)

    return plan.made(("load limits", case, are_remarks), made) if case is None or isinstance(case, str) else made(plan)


def greatest_kept(spare: Callable[[FloatArray], FloatArray], alone: FloatArray, guess: FloatArray) -> FloatArray:
    """Return the greatest load up to which something stays at zero or above, by the rule of false position; `alone` is without a load.

    It begins with a guess, and where that is none, with a load that nothing carries; infinite where even that is kept.
    """
    low, high = np.zeros(guess.shape), np.full(guess.shape, MOST)
    at_low, at_high = alone, spare(high)
    held = np.where(alone >= 0.0, np.where(at_high >= 0.0, np.inf, 1.0), 0.0)
    guess = np.where((guess > 0.0) & (guess < MOST), guess, 0.5 * MOST)
    for step in range(NARROWED):
        value = spare(guess)
        is_kept, is_met = value >= 0.0, np.abs(value) <= 1e-2 * STRAIGHT * np.abs(alone)
        at_low, at_high = np.where(is_kept, value, 0.5 * at_low), np.where(is_kept, 0.5 * at_high, value)
        low, high = np.where(is_kept | is_met, guess, low), np.where(is_kept & ~is_met, high, guess)
        if np.all((high - low <= SAME * high) | (held != 1.0) | np.isnan(alone)):
            break
        with np.errstate(divide="ignore", invalid="ignore"):
            found = (low * at_high - high * at_low) / (at_high - at_low)
        if step % 3 == 2:  # by magnitude, where a steep law draws every line to one end
            found = np.where(low > 0.0, np.sqrt(low * high), 1e-3 * high)
        guess = np.clip(np.where(np.isfinite(found), found, low), low, high)  # a pose without a value keeps a load
    return np.where(np.isnan(alone), np.nan, np.where(held == 1.0, low, held))


def greatest_load(own: FloatArray, share: FloatArray, low: FloatArray, high: FloatArray) -> FloatArray:
    """Return the greatest load for which own + share load stays within low..high; 0 where that does not hold without it."""
    with np.errstate(divide="ignore", invalid="ignore"):
        load = np.where(share > IDLE, (high - own) / share, np.where(share < -IDLE, (low - own) / share, np.inf))
        found = np.where((own > high) | (own < low), 0.0, np.maximum(load, 0.0))
    return np.where(np.isnan(own) | np.isnan(share), np.nan, found)


# The direction against which a load pulls: two numbers, quantities that follow the pose, or arrays over the poses of a motion.


Direction: TypeAlias = "tuple[Any, Any]"
"""The parts of a direction of length one: numbers, quantities, or arrays."""


def pull_direction(along: object, title: str = "") -> Direction:
    """Return a direction of length one as numbers, quantities or arrays; DefinitionError for anything else."""
    parts = list(along) if isinstance(along, (list, tuple, np.ndarray)) else []
    try:
        if len(parts) == 2 and any(isinstance(each, (Quantity, str)) for each in parts):
            x, y = map(quantity, parts)
            length = np.sqrt(x**2 + y**2)
            return x / length, y / length
        given = np.stack(np.broadcast_arrays(*map(real, parts))) if len(parts) == 2 else np.zeros(2)
    except (DefinitionError, TypeError, ValueError, OverflowError):
        given = np.zeros(2)
    size = np.hypot(*given)
    expected = "is no direction, it has no length; write (x, y), such as (0, 1) for a load that hangs"
    require(size.size and np.all(np.isfinite(size) & (size > 0.0)), f"{title}along", along, expected)
    x, y = given / size
    return (float(x), float(y)) if given.ndim == 1 else (x, y)


def is_steady(along: Direction) -> bool:
    """Return whether a direction is the same at all poses."""
    return all(isinstance(each, float) for each in along)


def direction_words(along: Direction) -> str:
    """Return a direction in words."""
    remedy = "ask a circuit for them, circuit.capacity(motion, ...), or give quantities"
    ensure(not any(isinstance(each, np.ndarray) for each in along), f"along= is an array, which is of the poses of one motion; {remedy}.")
    return f"({', '.join(f'{each:g}' if isinstance(each, float) else words_of(each) for each in along)})"


def direction_at(along: Direction, motion: AnyMotion) -> tuple[FloatArray, FloatArray]:
    """Return both parts of a direction over a motion's poses; DefinitionError where it does not fit them, or has no length."""
    lost = np.zeros((), bool)
    try:
        found = [motion.value(each) if isinstance(each, Quantity) else np.asarray(each) for each in along]
    except SingularError as error:
        lost = np.asarray(error.mask)
    if isinstance(motion, Motion) and not lost.any():
        try:
            lost = np.isnan(np.broadcast_to(found[0] + found[1], motion.shape)) & motion.reached
        except ValueError:
            what = f"along= has the shape {np.shape(found[0])}, which does not fit the poses {motion.shape}"
            raise DefinitionError(f"{motion.plan.title}: {what}; give one direction, or one for each pose.") from None
    if lost.any():
        words = direction_words(along) if not any(isinstance(each, np.ndarray) for each in along) else "an array"
        raise DefinitionError(f"{motion.plan.title}: along={words} has no length at {np.sum(lost)} poses.")
    return found[0], found[1]


def pulling(point: str, along: Direction, load: FloatArray | float, motion: AnyMotion) -> Force:
    """Return the force of a load [N] that pulls at a point against a direction, at a motion's poses or shaped as these."""
    if isinstance(load, np.ndarray) and not is_steady(along):
        along = direction_at(along, motion)
    return Force(point, (-1.0 * along[0] * load, -1.0 * along[1] * load))
