"""Where a synthesis starts: a population that runs, each laid onto the task by the best shift, turn and size, at the best strokes.

Shift, turn and size of a plane figure on another one in closed form. Source: I. L. Dryden, K. V. Mardia, Statistical Shape Analysis
(1998), 4.1: with both as complex numbers, the best factor is the quotient of their products.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from itertools import combinations

import numpy as np

from ..frozen import immutable
from ..plan import plan_measure
from ..study.designs import DesignValues
from ..vectors import FloatArray, Index
from .closed_curves import ClosedCurves, ComplexArray, drawn_curve, laid_onto
from .fit import TURN, Fit

POPULATION = 1 << 12
"""Designs that are looked at first, of every combination of choices; fewer where there are many."""
SHARES = (1.0, 0.8, 0.6, 0.4, 0.25, 0.12)
"""Parts of a stroke over which the points may lie."""
PLACES = 24
"""Places along the stroke at which the first point may lie."""
WHOLE_ENOUGH = 16
"""Designs that run over the whole stroke: where there are fewer, those that only reach the points are taken too."""
CHUNK = 1 << 21
"""Numbers that are laid onto the task at a time."""
KEPT_SHAPE = 1e-8
"""Of a path's size: what a shift, a turn or another size of the dimensions may change of its form."""
MOST_ANGLES = 4
"""Angles of which is tried whether they turn with the whole machine, at the most."""
APART = 0.05
"""Starts are not nearer to one another than this part of the box's diagonal, while there are others."""


@immutable
class Likeness:
    """The dimensions that move, turn and scale a whole mechanism and keep the form of its paths.

    `points` are the variables (x, y) of fixed points, `lengths` those of lengths, `angles` those of directions in the frame, by their
    place. A turn adds to the stroke what it turns by, where `with_stroke`.
    """

    points: tuple[tuple[int, int], ...]
    lengths: tuple[int, ...]
    angles: tuple[int, ...] = ()
    shift: bool = False
    scale: bool = False
    turn: bool = False
    with_stroke: bool = False

    @classmethod
    def of(cls, fit: Fit, sample: FloatArray, *, timed: bool) -> Likeness:
        """Return the likeness of a task's path, tried on some designs (m, n) that are assembled over the whole stroke."""
        variables = fit.space.variables
        places = {each.owner: place for place, each in enumerate(variables) if each.step is None}
        pairs = [(name, f"{name[:-2]}.y") for name in places if name.endswith(".x")]
        given = [each.coordinates() for each in fit.plan.points.values()]
        pairs += [(each[0][1].name, each[1][1].name) for each in given if each]
        points = tuple(dict.fromkeys((places[x], places[y]) for x, y in pairs if x != y and x in places and y in places))
        paired = {place for pair in points for place in pair}
        entries = fit.plan.table.entries
        measures = {name: plan_measure(fit.plan, name) for name in places if entries[name].kind != "coordinate"}
        lengths = tuple(places[name] for name, what in measures.items() if what == "length" and places[name] not in paired)
        turning = [places[name] for name, what in measures.items() if what == "angle"][:MOST_ANGLES]
        nothing = cls(points, lengths)
        if not fit.rows.is_path or not len(sample):
            return nothing
        size = fit.rows.size
        shift = bool(points) and nothing._keeps(fit, sample, 1.0, complex(0.3, -0.2) * size, 0.0)
        scale = nothing._keeps(fit, sample, 1.2, 0.0, 0.0)
        found = replace(nothing, shift=shift, scale=scale)
        crank = not timed and fit.timing.turn > 0.0
        for count in range(len(turning) + 1):
            for angles in combinations(turning, count):
                turned = replace(found, angles=angles, turn=True)
                if turned._keeps(fit, sample, np.exp(0.4j), 0.0, 0.0):
                    return turned
                if crank and turned._keeps(fit, sample, np.exp(0.4j), 0.0, 0.4):
                    return replace(turned, with_stroke=True)
        return found

    def _keeps(self, fit: Fit, sample: FloatArray, factor: complex, by: complex, ahead: float) -> bool:
        """Return whether paths of dimensions that are changed are the paths, changed."""
        count = len(sample)
        strokes = fit.timing.start + fit.timing.span * np.linspace(0.05, 0.9, 7)
        values = fit.space.values(sample)
        before, _ = fit.values(by_owner(fit, values), strokes, count)
        changed = self.applied(fit, values, np.full(count, factor), np.full(count, by))
        after, _ = fit.values(by_owner(fit, changed), strokes + ahead, count)
        wanted, found = factor * as_complex(before) + by, as_complex(after)
        size = np.abs(wanted).max() + abs(by)
        return bool(np.isfinite(found).all() and np.abs(found - wanted).max() <= KEPT_SHAPE * size)

    def applied(self, fit: Fit, values: FloatArray, factor: ComplexArray, by: ComplexArray) -> FloatArray:
        """Return the variables (m, n) of mechanisms that are scaled and turned by complex factors, then shifted, (m,) each."""
        found = np.array(values, float)
        for x, y in self.points:
            moved = factor * (values[:, x] + 1j * values[:, y]) + by
            found[:, x], found[:, y] = moved.real, moved.imag
        for place in self.lengths:
            found[:, place] *= np.abs(factor)
        for place in self.angles:
            each = fit.space.variables[place]
            turned, middle = values[:, place] + each.sign * np.angle(factor), 0.5 * (each.low + each.high)
            found[:, place] = turned - TURN * np.round((turned - middle) / TURN)
        return found

    def sizes(self, fit: Fit, unit: FloatArray) -> FloatArray:
        """Return between which factors the lengths of designs (m, n) stay within their ranges, or nearest to them, shape (2, m)."""
        values, variables = fit.space.values(unit), [fit.space.variables[place] for place in self.lengths]
        low, high = np.full(len(unit), 1e-9), np.full(len(unit), 1e9)
        with np.errstate(all="ignore"):
            for place, each in zip(self.lengths, variables, strict=True):
                ends = np.sort([each.low / values[:, place], each.high / values[:, place]], axis=0)
                low, high = np.fmax(low, ends[0]), np.fmin(high, ends[1])
            middle = np.sqrt(low * high)
        return np.array([np.where(low <= high, low, middle), np.where(low <= high, high, middle)])

    def laid(self, path: ComplexArray, onto: ComplexArray, sizes: FloatArray) -> tuple[ComplexArray, ComplexArray, FloatArray]:
        """Return by which factor and shift (m,) paths (m, n), complex, lie best on one (n,), and the errors (m,).

        The factors stay between `sizes` (2, m).
        """
        factor: ComplexArray = np.ones(len(path), complex)
        middle = path.mean(axis=1, keepdims=True) if self.shift else np.zeros((len(path), 1))
        aim = onto.mean() if self.shift else 0.0
        own, other = path - middle, onto - aim
        product, size = (other * np.conj(own)).sum(axis=1), np.sum(np.abs(own) ** 2, axis=1)
        with np.errstate(all="ignore"):
            if self.scale and self.turn:
                factor = product / size
            elif self.scale:
                factor = np.maximum(product.real, 1e-3 * np.abs(product)) / size + 0.0j
            elif self.turn:
                factor = product / np.abs(product)
            if self.scale:
                factor = factor * (np.clip(np.abs(factor), *sizes) / np.abs(factor))
        factor = np.where(np.isfinite(factor) & (np.abs(factor) > 0.0), factor, 1.0)  # a single point has no size
        by = np.asarray(aim - factor * middle[:, 0])
        error = np.sum(np.abs(factor[:, None] * own - other) ** 2, axis=1)
        return factor, by, np.where(np.isfinite(error), error, np.inf)


def as_complex(values: FloatArray) -> ComplexArray:
    """Return coordinates (m, 2, n) as complex numbers (m, n)."""
    return values[:, 0] + 1j * values[:, 1]


def by_owner(fit: Fit, values: FloatArray) -> DesignValues:
    """Return the dimensions of variables (m, n) [SI], beyond their ranges too."""
    own = {each.owner: each.sign * values[:, place] for place, each in enumerate(fit.space.variables)}
    return dict(fit.problem.machine.dimensions) | dict(fit.space.chosen(fit.combination)) | own


@immutable
class Starts:
    """Where local searches of a fit start: unit coordinates with the points' own unknowns (m, n + w), and the strokes' base (m, n).

    `running` is how many designs of the population run over the whole stroke, `keeping` the starts that keep the conditions.
    """

    fit: Fit
    at: FloatArray
    base: FloatArray
    running: int = 0
    keeping: Starts | None = None

    @property
    def part(self) -> tuple[tuple[int, ...], Mapping[str, FloatArray]]:
        """The combination of choices, and the data of its designs for a worker."""
        return self.fit.combination, {"at": self.at, "base": self.base}


def laid_designs(fit: Fit, likeness: Likeness, unit: FloatArray, timed: object, *, runs: bool) -> tuple[FloatArray, FloatArray]:
    """Return designs (m, n) laid onto the task by the best shift, turn and size, with their points' own unknowns, and the strokes' base.

    `runs` says that all of them run over the whole stroke.
    """
    if timed is True:
        base = np.broadcast_to(fit.known, (len(unit), fit.rows.count))
        exact, _ = fit.values(fit.dimensions_of(unit), fit.known, len(unit))
        _, factor, by = best_patterns(likeness, fit, unit, exact, np.arange(fit.rows.count)[None])
        own = np.zeros((len(unit), 0))
    elif timed is False and fit.rows.is_closed and runs and fit.timing.turn:
        values, _ = fit.swept(unit, poses_of(fit, timed))
        onto, places = drawn_curve(fit.rows.wanted[:2].T)  # point lies on point at the same part of the way
        curves = ClosedCurves(as_complex(values))
        free = {"shift": likeness.shift, "turn": likeness.turn, "scale": likeness.scale}
        laid_on = laid_onto(curves, onto, likeness.sizes(fit, unit), **free)
        strokes = fit.timing.start + fit.timing.span * curves.shares_of_turn(laid_on.along(places))
        factor, by, own = laid_on.factor, laid_on.by, fit.timing.unknowns_at(strokes)
        base = np.zeros((len(unit), fit.rows.count))
    else:
        values, _ = fit.swept(unit, poses_of(fit, timed))
        picks, base_of, own_of = patterns(fit, timed, values.shape[2])
        pattern, factor, by = best_patterns(likeness, fit, unit, values, picks)
        base, own = base_of[pattern], own_of[pattern]
    laid = likeness.applied(fit, fit.space.values(unit), factor, by)
    if likeness.with_stroke:
        own = own + np.angle(factor)[:, None] / fit.timing.unknowns_range[1]
    return np.concatenate([fit.space.within(laid), np.clip(fit.timing.centred(own), 0.0, 1.0)], axis=1), np.array(base)


def standing_apart(unit: FloatArray, error: FloatArray, many: int) -> Index:
    """Return the numbers of the best designs (m, n) that stand apart, then of others, while their errors are finite."""
    order = [int(each) for each in np.argsort(error, kind="stable") if np.isfinite(error[each])]
    chosen: list[int] = []
    far = APART * np.sqrt(max(unit.shape[1], 1))
    for place in order:
        if not chosen or np.linalg.norm(unit[chosen] - unit[place], axis=1).min() > far:
            chosen.append(place)
        if len(chosen) == many:
            break
    taken = set(chosen)
    return np.array([*chosen, *(place for place in order if place not in taken)][:many], int)


def poses_of(fit: Fit, timed: object) -> int:
    """Return at how many poses of the stroke a population is looked at: of equal steps so many for each."""
    if timed == "steps" and fit.timing.turn:
        return fit.rows.steps_round * max(1, round(96 / fit.rows.steps_round))
    return 97 if not fit.timing.turn else 96


def patterns(fit: Fit, timed: object, count: int) -> tuple[Index, FloatArray, FloatArray]:
    """Return how the points may lie on the poses of a sweep: their poses (k, n), with bases (k, n) and unknowns (k, w)."""
    timing, n = fit.timing, fit.rows.count
    if timed == "steps" and timing.turn:
        around = fit.rows.steps_round
        step, way = count // around, np.arange(n)
        first = np.tile(np.arange(count), 2)
        sense = np.repeat([1, -1], count)
        picks = np.mod(first[:, None] + sense[:, None] * step * way, count)
        base = sense[:, None] * way * timing.span / around
        return picks, base, timing.unknowns_at(timing.start + timing.span * first[:, None] / count)
    shares = lengths_along(fit)
    rows = []
    for along, is_closed in shares:
        for part in SHARES:
            if is_closed and part != 1.0:
                continue
            for place in np.linspace(0.0, 1.0, PLACES, endpoint=not timing.turn):
                rows += [place + part * along, place - part * along]
    parts = np.array(rows)
    if not timing.turn:
        parts = parts[((parts >= -1e-9) & (parts <= 1.0 + 1e-9)).all(axis=1)]
    last = count if timing.turn else count - 1
    poses = np.round(parts * last).astype(int)
    picks = np.mod(poses, count) if timing.turn else np.clip(poses, 0, last)
    strokes = timing.start + timing.span * parts
    own = timing.unknowns_at(strokes if timed is False else strokes[:, [0, -1]])
    return picks, np.zeros((len(parts), n)), own


def lengths_along(fit: Fit) -> list[tuple[FloatArray, bool]]:
    """Return where the points of a task lie along it, from 0 to 1: by the way between them, as one that is open, and one that is closed."""
    wanted = fit.rows.wanted * fit.rows.weights[:, None]
    if wanted.shape[1] < 2:
        return [(np.zeros(wanted.shape[1]), False)]
    ways = np.linalg.norm(np.diff(wanted, axis=1), axis=0)
    along = np.concatenate([[0.0], np.cumsum(ways)])
    back = float(np.linalg.norm(wanted[:, -1] - wanted[:, 0]))
    total = float(along[-1]) or 1.0
    even = np.arange(wanted.shape[1]) / (wanted.shape[1] - 1)
    found = [(along / total, False), (even, False)]
    if fit.timing.turn:
        found += [(along / (total + back), True), (np.arange(wanted.shape[1]) / wanted.shape[1], True)]
    return found


def best_patterns(
    likeness: Likeness, fit: Fit, unit: FloatArray, values: FloatArray, picks: Index
) -> tuple[Index, ComplexArray, ComplexArray]:
    """Return of every design (m, n) the best of patterns (k, n) of its values (m, r, poses), and by which factor and shift it lies best.

    The factors and shifts are complex numbers (m,).
    """
    size = max(CHUNK // max(picks.size, 1), 1)
    parts = []
    for first in range(0, len(values), size):
        few, own = values[first : first + size], unit[first : first + size]
        m, (k, n) = len(few), picks.shape
        factor, by = np.ones(m * k, complex), np.zeros(m * k, complex)
        if fit.rows.is_path:
            path, onto = as_complex(few)[:, picks].reshape(m * k, n), fit.rows.wanted[0] + 1j * fit.rows.wanted[1]
            factor, by, error = likeness.laid(path, onto, np.repeat(likeness.sizes(fit, own), k, axis=1))
        else:
            off = fit.rows.off(np.moveaxis(few[:, :, picks], 2, 1).reshape(m * k, few.shape[1], n))
            error = np.sum(off**2, axis=(1, 2))
        pattern = np.argmin(np.where(np.isfinite(error), error, np.inf).reshape(m, k), axis=1)
        chosen = np.arange(m) * k + pattern
        parts.append((pattern, factor[chosen], by[chosen]))
    pattern, factor, by = (np.concatenate(each) for each in zip(*parts, strict=True))
    return pattern, factor, by
