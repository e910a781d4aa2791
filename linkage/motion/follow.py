"""A path of places followed on one branch: the strokes of each place, from those of the place before, and why it ends where it ends.

From place to place steps of Newton begin where the last places lead to. The way between two places is divided if they do not settle
quickly, or if a pose where the slopes lose a rank lies between.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import cached_property
from math import isfinite
from typing import Any, TypeAlias

import numpy as np

from ..errors import AssemblyError, DefinitionError, SingularError, cited, ensure, one_word, unwarned
from ..frozen import immutable
from ..language import said
from ..numeric.linear import solve_linear
from ..plan import Mask, Plan, opening
from ..program import NO_VALUE, FloatArray
from ..units import show
from .motion import Motion
from .places import BranchSearch, Places, stroke_numbers, unmet_words
from .stroke_search import ON_ARRAYS, Clearances
from .strokes import TURN

TOLERANCE = 1e-12
"""Of the size of what it measures: a target that is missed by no more is met."""
LEAST = 1e-7
"""Of the way between two places: steps that are shorter end the path."""
SETTLES, TURNS = 0.3, 0.5
"""A correction over the one before, or over the step itself, and the length of one over that of the last places: more is not trusted."""
ITERATIONS = 8
STILL, NOISE = 1e-12, 100.0
"""A correction, of the ranges, where places are told no better: misses so many times larger are rounding there."""
IN_LINE = 1e-4
"""A loop's clearance, a squared sine or a share, below which it is that loop's dead point where a path ends."""
BEYOND = 1e-9
"""Of its range: a stroke that is so far past its end is past it."""

Pose: TypeAlias = Callable[[Sequence[float]], "tuple[list[float], list[list[float]]] | None"]
"""The values of the targets at some strokes, and their slopes, a row each; None where there is no pose."""


def follow_path(plan: Plan, designs: Mapping[str, object], targets: object, hold: object, start: object, unreachable: str) -> Motion:
    """Return the motion along a path of places; see Mechanism.follow."""
    one_word("unreachable", unreachable, ("raise", "nan"))
    places = Places.for_targets(plan, designs, targets, hold, where="follow")
    lengths = {len(each.value) for each in places.targets if isinstance(each.value, np.ndarray)} or {1}
    given = ", ".join(f"{each.quantity} {np.size(each.value)}" for each in places.targets)
    what = f"the targets have values of different lengths, {given}; give each one value a place"
    ensure(len(lengths) <= 1, f"{plan.title}: follow: {what}.")
    route = Route(places, np.stack([np.broadcast_to(each.value, tuple(lengths)) for each in places.targets], axis=1))
    first, starts = 0, [] if start is None else [start_of(places, start)]
    with unwarned():
        if start is None:
            begun = (np.array([plan.sketch_strokes[name] for name in places.free]) - places.low) / places.span
            for place in range(len(route.goals) if unreachable == "nan" else 1):
                found = BranchSearch(places, route.goals[place]).branches().unit
                order = np.argsort(np.abs(found - begun).max(axis=1), kind="stable")  # the nearest to the declared first pose first
                starts = [*(places.low + found[order] * places.span)]
                if starts:
                    first = place
                    break
        if not starts and unreachable == "raise":
            why = unmet_words(places, route.goals[0], BranchSearch(places, route.goals[0]).nearest())
            text = said("place {n} of {count} is not reached: {why}", n=1, count=len(route.goals), why=why)
            raise AssemblyError(f"{plan.title}: follow: {text}", mask=np.ones(len(route.goals), bool))
        best = None
        for each in starts:
            track = route.tracked(each, first)
            best = track if best is None or track.reached_first > best.reached_first else best
            if track.is_whole:
                break
    if best is None:
        return route.motion_at(np.full((len(route.goals), len(places.free)), np.nan), unreachable)
    if unreachable == "raise" and not best.is_whole:
        raise best.reach_error()
    return route.motion_at(np.where(best.inside[:, None], best.strokes, np.nan), unreachable)


def start_of(places: Places, start: Any) -> FloatArray:
    """Return where the path begins, values of the free strokes (k,); DefinitionError for anything else."""
    title = f"{places.plan.title}: follow"
    if hasattr(start, "keys"):  # a row of `Positions.strokes` too
        start = dict(start)
    if not isinstance(start, Mapping):
        example = ", ".join(f'"{name}": ...' for name in places.free)
        raise DefinitionError(f"{title}: start={cited(start)}: the strokes it begins near are expected, start={{{example}}}.")
    known = stroke_numbers(places.plan, start, f"{title}: start")
    missing = [name for name in places.free if name not in known]
    ensure(not missing, f"{title}: start= does not say {', '.join(missing)}; give a value for each stroke that is not held.")
    return np.array([known[name] for name in places.free])


@immutable
class Route:
    """The places of a path, with the targets' values at each (n, t)."""

    places: Places
    goals: FloatArray

    @cached_property
    def pose_at(self) -> Pose:
        """The targets and their slopes in floats, next to dead points too, where they are rough."""
        places, t, k = self.places, len(self.places.targets), len(self.places.free)
        kernel = places.program.values_and_slopes
        quick = kernel.floats.quick["pose"]
        inputs = [places.designs[name] for name in kernel.plan.input_names[0]]
        passed = [] if places.plan.solved else kernel.floats.design_values(inputs)
        names = kernel.plan.input_names[1]

        def at(strokes: Sequence[float]) -> tuple[list[float], list[list[float]]] | None:
            if places.plan.solved:
                found = kernel(places.kernel_inputs(np.array(strokes)[:, None]), size=(1, 1)).values[:, 0, 0].tolist()
            else:
                here = {**places.held, **dict(zip(places.free, strokes, strict=True))}
                try:
                    found = quick(*passed, *[here[name] for name in names])
                except NO_VALUE:
                    return None
            if not isfinite(sum(found)):
                return None
            return list(found[:t]), [list(found[t + k * row : t + k * (row + 1)]) for row in range(t)]

        return at

    @cached_property
    def tolerance(self) -> list[float]:
        """By how much each target may be missed [SI]."""
        return [float(each) for each in TOLERANCE * self.places.sizes]

    @cached_property
    def angles(self) -> list[bool]:
        """Which targets count modulo a turn."""
        return [bool(each) for each in self.places.angles]

    def off(self, values: Sequence[float], goal: Sequence[float]) -> list[float]:
        """Return the difference to a goal [SI], angles the shorter way round."""
        return [
            (b - a) - TURN * round((b - a) / TURN) if is_angle else b - a for a, b, is_angle in zip(values, goal, self.angles, strict=True)
        ]

    def tracked(self, start: FloatArray, first: int) -> Track:
        """Return the strokes of each place from the first one on, from some strokes near those of it; NaN from where it ends."""
        goals: list[list[float]] = self.goals.tolist()
        strokes = np.full((len(goals), len(self.places.free)), np.nan)
        begun = self.pose_at(start.tolist())
        if begun is None:
            return Track(self, strokes, first, first, TrackedPose(start.tolist(), [np.nan] * len(goals[0]), [], 0.0))
        step = solve_linear(begun[1], begun[0])
        here = TrackedPose(start.tolist(), *begun, step[1] if step is not None else 0.0)
        ahead: list[TrackedPose] = []
        for place, goal in enumerate(goals[first:], first):
            found = None
            if len(ahead) == 4:  # where the last four places lead to, a cubic through them
                last = zip(*(each.strokes for each in ahead), strict=True)
                found = self._corrected(here, [4.0 * z - 6.0 * y + 4.0 * x - w for w, x, y, z in last], goal, TURNS)
                ahead = ahead if found is not None else []
            here = self._divided(here, goal) if found is None else found
            if not self.is_met(self.off(here.values, goal), NOISE):
                return Track(self, strokes, first, place, here)
            ahead = [*ahead[-3:], here]
            strokes[place] = here.strokes
        return Track(self, strokes, first, len(goals), here)

    def _divided(self, here: TrackedPose, goal: Sequence[float]) -> TrackedPose:
        """Return the pose at a goal, in as many steps as are needed; the last one that is reached where none leads there."""
        way = self.off(here.values, goal)
        begun, done, step = here.values, 0.0, 1.0
        while done < 1.0:
            step = min(step, 1.0 - done)
            until = [a + (done + step) * b for a, b in zip(begun, way, strict=True)] if done + step < 1.0 else goal
            ahead = solve_linear(here.slopes, self.off(here.values, until))
            found = None
            if ahead is not None:
                guess = [a + b for a, b in zip(here.strokes, ahead[0], strict=True)]
                found = self._corrected(here, guess, until, SETTLES)
            if found is None:
                step *= 0.25
                if step < LEAST:
                    return here
            else:
                here, done, step = found, done + step, 2.0 * step
        return here

    def _corrected(self, here: TrackedPose, guess: list[float], goal: Sequence[float], share: float) -> TrackedPose | None:
        """Return the pose at a goal by steps of Newton from a guess; None where they do not settle quickly, or on the same branch.

        The first correction is at most a share of the step from here to the guess. On another branch the determinant of the slopes
        has the other sign.
        """
        spans = self.places.span.tolist()
        most = share * max(abs(b - a) / span for a, b, span in zip(here.strokes, guess, spans, strict=True)) + 1e-9
        near, determinant = 0.1 * most, 0.0
        for _ in range(ITERATIONS):
            found = self.pose_at(guess)
            if found is None:
                return None
            missing = self.off(found[0], goal)
            if determinant and most <= SETTLES * near and self.is_met(missing):  # so near that the slopes are the same
                return TrackedPose(guess, *found, determinant)
            step = solve_linear(found[1], missing)
            if step is None or step[1] * here.determinant <= 0.0:
                return None
            determinant = step[1]
            if self.is_met(missing):
                return TrackedPose(guess, *found, determinant)
            size = max(abs(each) / span for each, span in zip(step[0], spans, strict=True))
            if size <= STILL and self.is_met(missing, NOISE):
                return TrackedPose(guess, *found, determinant)
            if not size <= most:
                return None
            guess = [a + b for a, b in zip(guess, step[0], strict=True)]
            most = max(SETTLES * size, 1e-14)
        return None

    def is_met(self, missing: Sequence[float], noise: float = 1.0) -> bool:
        """Return whether the difference to a goal is only rounding; `noise` is how many times the usual rounding is allowed."""
        return all(-noise * least <= each <= noise * least for each, least in zip(missing, self.tolerance, strict=True))

    def past(self, strokes: FloatArray) -> FloatArray:
        """Return how far strokes (n, k) are past their ends [m or rad]; a crank that turns all the way round has none."""
        places = self.places
        whole = places.turning & (places.span >= TURN * (1.0 - 1e-9))
        far = np.maximum(places.low - strokes, strokes - (places.low + places.span))
        return np.where(whole | ~(far > BEYOND * places.span), 0.0, far)

    def motion_at(self, strokes: FloatArray, unreachable: str) -> Motion:
        """Return the motion at strokes (n, k)."""
        return Motion(self.places.plan, self.places.designs, self.places.every(strokes.T), unreachable)


@immutable
class TrackedPose:
    """A pose on the way: its strokes, values and slopes, and their determinant, whose sign tells two branches apart."""

    strokes: list[float]
    values: list[float]
    slopes: list[list[float]]
    determinant: float


@immutable
class Track:
    """The strokes (n, k) of a path on one branch, from the first place that it reaches, NaN from where it ends, with the last pose."""

    route: Route
    strokes: FloatArray
    first: int
    end: int
    last: TrackedPose

    @cached_property
    def past(self) -> FloatArray:
        """How far each stroke is past its ends [m or rad], shape (n, k)."""
        return self.route.past(self.strokes)

    @cached_property
    def inside(self) -> Mask:
        """The places that are reached with all strokes between their ends, shape (n,)."""
        return np.asarray(np.isfinite(self.strokes).all(axis=1) & (self.past <= 0.0).all(axis=1))

    @property
    def is_whole(self) -> bool:
        """Whether all places are reached."""
        return bool(self.inside.all())

    @property
    def reached_first(self) -> int:
        """The first place that is not reached, of those from where it begins."""
        return self.first + int(np.argmin(np.append(self.inside[self.first :], False)))

    def reach_error(self) -> AssemblyError:
        """Return why it does not go all the way."""
        place, places = self.reached_first, self.route.places
        past = self.past[place]
        if (past > 0.0).any():
            text = said("{opening}: {words}.", opening=self._opening(place), words=places.past_words(self.strokes[place], past > 0.0))
            worst = int(np.argmax(np.max(self.past / places.span, axis=1)))
            if worst != place:
                most = places.past_words(self.strokes[worst], self.past[worst] > 0.0)
                text += " " + said("Farthest out is place {n}: {words}.", n=worst + 1, words=most)
            return AssemblyError(text, mask=~self.inside, shortfall=float(past.max()))
        strokes = np.array(self.last.strokes)
        past = self.route.past(strokes)
        if (past > 0.0).any():
            words = places.past_words(strokes, past > 0.0)
            text = said("{opening}: on the way there {words}.", opening=self._opening(place), words=words)
            return AssemblyError(text, mask=~self.inside, shortfall=float(past.max()))
        return self._dead_point(strokes)

    def _opening(self, place: int) -> str:
        """Return how a sentence about a place begins."""
        places, goals = self.route.places, self.route.goals
        at = said("place {n} of {count}, {wanted}", n=place + 1, count=len(goals), wanted=places.shown(goals[place]))
        return f"{places.plan.title}: follow: {at}"

    def _dead_point(self, strokes: FloatArray) -> SingularError:
        """Return the error for a path that ends at a dead point: of a loop where one is in line there, else of the drive."""
        places = self.route.places
        at = places.stroke_words(strokes)
        missing = self.route.off(self.last.values, self.route.goals[self.end].tolist())
        lacks = ", ".join(
            said("{amount} of {name}", amount=show(abs(each), target.shown_in(places.plan), 4), name=name)
            for each, target, name, least in zip(missing, places.targets, places.bound, self.route.tolerance, strict=True)
            if not abs(each) <= least
        )
        loop, clearances = "", places.plan.made("clearances", Clearances.for_plan)
        if clearances.loops:
            seen = np.abs(clearances.kernel(places.kernel_inputs(strokes[:, None]), way=ON_ARRAYS, size=(1, 1)).values[:, 0, 0])
            kinds = [each.kind for each in clearances.loops]
            share = [each / places.size if kind in ("length", "meeting") else each for each, kind in zip(seen, kinds, strict=True)]
            worst = int(np.nanargmin(share))
            loop = opening(places.plan, clearances.loops[worst].step) if share[worst] < IN_LINE else ""
        if not np.isfinite(self.last.values).all():
            what = said("at {strokes}, where it begins, there is no pose", strokes=at)
        elif loop:
            what = said("at {strokes} {step} stands at a dead point, {missing} short of it", strokes=at, step=loop, missing=lacks)
        else:
            what = said(
                "at {strokes} the strokes stand at a dead point of the drive, from which they move {names} no farther this way, "
                "{missing} short of it",
                strokes=at, names=", ".join(map(str, places.bound)), missing=lacks,
            )  # fmt: skip
        poses = self.route.motion_at(np.where(self.inside[:, None], self.strokes, np.nan), "nan")
        point = loop.partition(" = ")[0]
        return SingularError(f"{self._opening(self.end)}: {what}.", point=point, mask=~self.inside, motion=poses)
