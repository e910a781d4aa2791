"""Members' own conditions, those of their verdicts, as limits of a load: a rope that would push, a closed line that runs empty."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import cast, final

import numpy as np

from ..errors import unwarned
from ..loads import Acting, Case, Force
from ..motion import HasVerdicts, Judge, Motion, Over
from ..motion.measures import Least, Measure, Most
from ..motion.requests import RequestLike
from ..motion.table import speakers
from ..plan import Plan
from ..program import FloatArray
from ..quantities import Quantity
from .law_requests import LawRequest
from .poses import AnyMotion

IDLE = 1e-12
"""A force for each newton of the load that is this small is none."""
PROBE, MOST = 1e4, 1e9
"""The load by which it is seen how a condition follows it, and one that nothing carries [N]."""
KEPT, STRAIGHT = 1e-6, 1e-9
"""A condition that is missed by no more is kept [SI]; the share of what it spares alone by which it is met, where it is affine."""
NARROWED, SAME = 60, 1e-13
"""How often a bracket of a load is narrowed at the most, and the share of itself to which it is."""


@final
@dataclass(frozen=True, eq=False)
class MemberLimit:
    """A member's own condition, pose by pose, in one situation that occurs: a value stays at or above a number, or at or below it."""

    name: str
    request: LawRequest | Quantity
    right: Measure
    is_least: bool

    def value(self, motion: AnyMotion, acting: Acting) -> FloatArray:
        """Return what is compared, shape (...)."""
        request = self.request
        return request.under(acting, keep=True).law(motion) if isinstance(request, LawRequest) else motion.value(request)

    def bounds(self, motion: Motion) -> tuple[FloatArray, FloatArray]:
        """Return between which two values it is kept, to rounding."""
        right: FloatArray = np.asarray(self.right.of(lambda leaf: motion[cast(RequestLike, leaf.quantity)]), np.float64)
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
        """Return the greatest load that keeps it [N], shape (...), where `beside(load)` is what acts with one; see `greatest_load`."""

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
        pose, load = [Over(**cast(dict[str, float], plan.sketch_strokes))], Force(plan.moving[-1], (0.0, -1.0))
        judge, loaded = (Judge(plan, plan.defaults, pose, Acting(loads, case)) for loads in (None, [load]))
        found = []
        for name, member in speakers(plan, HasVerdicts).items():
            for rule, condition in (member.load_remarks(loaded) if are_remarks else member.load_limits(loaded)).items():
                for each in condition.constraints(None):
                    is_least = isinstance(each.left, Least)
                    if isinstance(each.left, (Least, Most)) and each.symbol == (">=" if is_least else "<="):
                        for row in judge.sought(each.left, judge.places[0]):
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
    for _ in range(NARROWED):
        value = spare(guess)
        is_kept, is_met = value >= 0.0, np.abs(value) <= 1e-2 * STRAIGHT * np.abs(alone)
        at_low, at_high = np.where(is_kept, value, 0.5 * at_low), np.where(is_kept, 0.5 * at_high, value)
        low, high = np.where(is_kept | is_met, guess, low), np.where(is_kept & ~is_met, high, guess)
        if np.all((high - low <= SAME * high) | (held != 1.0) | np.isnan(alone)):
            break
        with np.errstate(divide="ignore", invalid="ignore"):
            guess = np.clip((low * at_high - high * at_low) / (at_high - at_low), low, high)
    found = np.where(held == 1.0, low, held)
    return np.where(np.isnan(alone), np.nan, found)


def greatest_load(own: FloatArray, share: FloatArray, low: FloatArray, high: FloatArray) -> FloatArray:
    """Return the greatest load for which own + share load stays within low..high; 0 where that does not hold without it."""
    with np.errstate(divide="ignore", invalid="ignore"):
        load = np.where(share > IDLE, (high - own) / share, np.where(share < -IDLE, (low - own) / share, np.inf))
        found = np.where((own > high) | (own < low), 0.0, np.maximum(load, 0.0))
    return np.where(np.isnan(own) | np.isnan(share), np.nan, found)
