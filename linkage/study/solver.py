"""One local search: a problem's rows handed to SciPy's SLSQP, from one start, with one combination of choices.

A least or greatest value over the stroke becomes a variable of its own, held below or above every row, where the condition or the objective
gains from its being so. Elsewhere the row that stands worst counts by itself. A step onto designs that cannot be assembled sees how much
the links are short there, and for all else the last good design's straight lines. If that does not say why, it sees a loss that grows with
the way, so that the solver turns back.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from ..errors import StudyError, ensure
from ..frozen import immutable
from ..motion.measures import CombinedMeasure, Constraint, FixedNumber, Integral, Leaf, Measure
from ..program import FloatArray
from .measured import no_value
from .problem import Evaluated, LeafNumbers, LimitReachedError, Problem, Rows, missed, scale_among

FAR = 10.0
"""The loss for the whole of a box's side towards designs that cannot be assembled, in scaled numbers."""
ROUNDS = 12
"""How often poses between the samples are added at the most."""
MET = 1e-7
"""A condition is met when nothing more than this part of its size is missing."""
SPARE = 2e-7
"""Of a condition's size: what least squares keep of it to spare, so that the judge, who is stricter, finds it kept between the samples."""
TIGHT = 1e-13
MISSING, NO_GAIN, PATIENCE = 100.0, 1e-9, 30
"""What a missed line counts beside the objective; a gain by no more is none, and after so many looks without one there is none to come."""
SMALL = 1e-6
"""An objective of less than this part of what the box makes of it is next to nothing."""
CLEAR = 1e-9
"""The least squared sine of a loop that counts as assembled."""
APPROACH = (1e-2, 1e-3, 1e-4, 1e-5, CLEAR)
"""The same by which least squares come near the edge of what can be assembled, where their misses go like roots."""
OTHER_SIZE = 4.0
"""Leaves' numbers so many times larger or smaller than at the start are scaled anew."""
SAME = 1e-6
"""Objectives that differ by less than this part of their size are the same."""
HALVINGS = 40
STEEP = 1e3
"""What an infinite derivative counts, of scaled numbers by unit coordinates."""
DAMPED, MOST_DAMPED = 1e-3, 1e10
"""The damping of the first step of least squares, and that at which no step leads on."""
NEARLY_KEPT = 1e-5
"""Designs that let conditions give way by no more are searched from again."""


class Graded(NamedTuple):
    """A number with its derivatives (p,), or (1,) where it has none."""

    value: float
    slope: FloatArray


def graded(measure: Measure, of_leaf: Callable[[Leaf], Graded]) -> Graded:
    """Return a measure of its leaves' numbers, with its derivatives by the chain rule."""
    if isinstance(measure, Leaf):
        return of_leaf(measure)
    if not isinstance(measure, CombinedMeasure):
        return Graded(float(measure.from_leaves(of_leaf)), np.zeros(1))
    (a, by_a), (b, by_b) = graded(measure.left, of_leaf), graded(measure.right, of_leaf)
    with np.errstate(all="ignore"):
        match measure.symbol:
            case "+":
                return Graded(a + b, by_a + by_b)
            case "-":
                return Graded(a - b, by_a - by_b)
            case "*":
                return Graded(a * b, by_a * b + by_b * a)
            case "/":
                value = float(np.divide(a, b))
                return Graded(value, (by_a - value * by_b) / b)
            case _:
                value = float(np.power(a, b))
                slope = b * float(np.power(a, b - 1.0)) * by_a
                return Graded(value, slope + value * float(np.log(a)) * by_b if by_b.any() else slope)


@immutable
class Row:
    """One line of the solver's problem: its constraint, None for one that every design keeps, and its scaled numbers.

    Those of `is_reach` are of the loops, which can be assembled.
    """

    constraint: Constraint | None
    values: FloatArray
    slopes: FloatArray
    equation: bool = False
    is_reach: bool = False


@immutable
class SearchEnd:
    """The result of a local search: its combination of choices, unit coordinates, the objective, the largest miss.

    `is_assembled` says whether it is assembled throughout.
    """

    combination: tuple[int, ...]
    unit: FloatArray
    value: float
    missing: float
    is_assembled: bool

    @property
    def feasible(self) -> bool:
        """Whether all conditions are met."""
        return self.is_assembled and self.missing <= MET and bool(np.isfinite(self.value))


class LeastSquares(NamedTuple):
    """Misses the squares of which are to be least in the place of an objective, with unknowns of their own from 0 to 1, such as strokes.

    The unknowns begin at `own` (w,); zero or above of them are the `own_lines`, by factors (l, w), beside constants (l,). `misses` are the
    scaled ones (k,) at unit coordinates, then own unknowns (n + w,), NaN where they have no value; `slopes` their derivatives (k, n + w).
    """

    own: FloatArray
    own_lines: tuple[FloatArray, FloatArray]
    misses: Callable[[FloatArray], FloatArray]
    slopes: Callable[[FloatArray], FloatArray]


class Local:
    """A problem with one combination of choices, as a solver sees it.

    Its variables are the unit coordinates, then those of the leaves, then the worst of several objectives, and by how much each of the
    `elastic` constraints gives way. Where there are such, the sum of that is to be least. With `squares`, these are to be least instead,
    and `own` is where their own unknowns come to. What has come to a `known` end of another search is there, and looks no closer.
    """

    def __init__(
        self,
        problem: Problem,
        combination: Sequence[int],
        start: FloatArray,
        *,
        elastic: Sequence[Constraint] = (),
        squares: LeastSquares | None = None,
        known: Sequence[SearchEnd] = (),
    ) -> None:
        self.problem, self.combination, self.elastic = problem, tuple(combination), tuple(elastic)
        self.squares, self.own = squares, np.zeros(0) if squares is None else np.array(squares.own, float)
        self.known = known
        self.clear, self.spare = CLEAR, 0.0 if squares is None else SPARE
        self._stages: Sequence[float] = APPROACH
        self.n = len(problem.space.variables)
        self._looks: dict[bytes, tuple[Evaluated, bool]] = {}
        self._rows: dict[bytes, list[Row]] = {}
        self._good: tuple[FloatArray, Evaluated] | None = None
        equations = tuple(each.margin for each in problem.constraints if each.symbol == "==")
        self._divisors = divisors((*problem.objectives, *(each.margin for each in problem.constraints)))
        self._signs: tuple[float, ...] | None = None
        self._needed = {leaf for each in (*problem.objectives, *equations) for leaf in each.leaves}
        first = self.evaluated_at(start)
        ensure(bool(first.is_assembled[0]), "A local search starts from a design that can be assembled.")
        if not self._usable(first):
            lost = [leaf for leaf in self.problem.leaves if leaf in self._needed and first.rows[leaf].lost[0]]
            why = " and ".join(no_value(self.problem.plan, leaf) for leaf in lost) or "the objective has no value"
            raise StudyError(f"{problem.plan.title}: of a design that was found {why}. Ask for what has a value, or take vary= narrower.")
        self._signs = self._divisor_signs(first)
        self.start = self._fitted_to = np.asarray(start, float)
        self.leaf_scales, self.scales, self.size = self._scales(first)
        self.aux = self._auxiliaries(first)
        self.several = int(len(problem.objectives) > 1)
        self.slack = len(self.elastic)
        self.width = self.n + len(self.aux) + self.several + self.slack

    # -- scales and auxiliary variables ------------------------------------------------------------------

    def _scales(self, look: Evaluated) -> tuple[dict[Leaf, float], list[float], float]:
        """Return the scales of the leaves, the constraints and the objective.

        An objective by itself, where it is next to nothing by what the box makes of it.
        """
        sizes = []
        for objective in self.problem.objectives:
            value, slope = graded(objective, lambda leaf: graded_leaf(leaf, look))
            change = float(np.abs(slope[np.isfinite(slope)]).max(initial=0.0))
            sizes.append(max(abs(value) if np.isfinite(value) else 0.0, SMALL * change) or 1.0)
        return {leaf: size or 1.0 for leaf, size in look.leaf_sizes.items()}, scales_of(self.problem, look), max(sizes)

    def _auxiliaries(self, look: Evaluated) -> list[tuple[Constraint | Measure, Leaf]]:
        """Return the leaves that become variables, each with the constraint or objective in which it does."""
        found: list[tuple[Constraint | Measure, Leaf]] = []
        owners: list[tuple[Constraint | Measure, Measure, float]] = [(one, one, -self.problem.sense) for one in self.problem.objectives]
        held = (each for each in self.problem.constraints if each.symbol != "==" and single_extreme(each) is None)
        for owner, expression, sense in [*owners, *((each, each.margin, 1.0) for each in held)]:
            for leaf in expression.leaves:
                is_extreme = leaf.sense and look.rows[leaf].values.shape[1] > 1
                if is_extreme and grows(expression, leaf, look.of_one) * sense * leaf.sense < 0.0:
                    found.append((owner, leaf))
        return found

    # -- the solver's view -------------------------------------------------------------------------------

    def evaluated_at(self, unit: FloatArray) -> Evaluated:
        """Return the values at unit coordinates, cached."""
        return self._looked_at(unit)[0]

    def _looked_at(self, unit: FloatArray) -> tuple[Evaluated, bool]:
        """Return the values at unit coordinates, cached, and whether a search can work with them."""
        key = np.asarray(unit, float).tobytes()
        found = self._looks.get(key)
        if found is None:
            if len(self._looks) > 4:
                self._looks.pop(next(iter(self._looks)))
            look = self.problem.evaluated(self.problem.dimensions_at(np.clip(unit, 0.0, 1.0), self.combination), slopes=True)
            found = self._looks[key] = look, bool(look.is_assembled[0]) and self._usable(look)
        if found[1]:
            self._good = np.array(unit, float), found[0]
        return found

    def _divisor_signs(self, look: Evaluated) -> tuple[float, ...]:
        """Return the signs of the numbers of a design that another number of it is divided by."""
        with np.errstate(all="ignore"):
            return tuple(float(np.sign(each.from_leaves(lambda leaf: look.numbers[leaf][0]))) for each in self._divisors)

    def _usable(self, look: Evaluated) -> bool:
        """Return whether the objectives and equations have values; an inequality without one says nothing.

        Beyond a design at which a divisor is zero others begin: a search stays on its side.
        """
        if self._signs is not None and self._divisor_signs(look) != self._signs:
            return False
        return all(bool(np.isfinite(rows.values).any()) and not rows.lost[0] for leaf, rows in look.rows.items() if leaf in self._needed)

    def _safe(self, z: FloatArray) -> tuple[Evaluated, FloatArray, float]:
        """Return a look that can be worked with, the way from it to the point that is asked, and the loss there."""
        unit = z[: self.n]
        look, is_usable = self._looked_at(unit)
        if is_usable:
            return look, np.zeros(self.n), 0.0
        assert self._good is not None
        base, good = self._good
        way = unit - base
        told = bool((told_margins(look) < CLEAR).any())
        return good, way, 0.0 if told else FAR * float(np.abs(way).max(initial=0.0))

    def graded(self, owner: Constraint | Measure, look: Evaluated, z: FloatArray) -> Graded:
        """Return a constraint's margin or an objective with its derivatives by the solver's variables."""

        def value(leaf: Leaf) -> Graded:
            slope = np.zeros(self.width)
            for place, (whose, each) in enumerate(self.aux):
                if whose is owner and each is leaf:
                    slope[self.n + place] = self.leaf_scales[leaf]
                    return Graded(float(z[self.n + place]) * self.leaf_scales[leaf], slope)
            found = graded_leaf(leaf, look)
            slope[: self.n] = found.slope
            return Graded(found.value, slope)

        found = graded(owner.margin if isinstance(owner, Constraint) else owner, value)
        return Graded(found.value, np.broadcast_to(found.slope, (self.width,)))

    def objective(self, z: FloatArray) -> tuple[float, FloatArray]:
        """Return the scaled objective, to be least, and its derivatives."""
        look, way, loss = self._safe(z)
        if self.elastic or self.several:
            slope = np.zeros(self.width)
            columns = slice(self.width - self.slack, None) if self.elastic else slice(self.n + len(self.aux), self.n + len(self.aux) + 1)
            slope[columns] = 1.0
            return float(z[columns].sum()) + loss, slope
        found = self.graded(self.problem.objectives[0], look, z)
        factor = self.problem.sense / self.size
        slope = bounded(factor * found.slope)
        return factor * found.value + float(slope[: self.n] @ way) + loss, slope

    def solver_lines(self, z: FloatArray) -> list[Row]:
        """Return the lines of the problem: zero or above where they are kept, zero where they are equations."""
        key = z.tobytes()
        if key in self._rows:
            return self._rows[key]
        look, way, loss = self._safe(z)
        here = self.evaluated_at(z[: self.n])
        slopes = np.zeros((look.margins.shape[1], self.width))  # of the assembled links
        slopes[:, : self.n] = look.margin_slopes.T
        values, slopes = without_gaps(look.margins[0] - self.clear, slopes)
        values = values + slopes[:, : self.n] @ way - loss
        if here is not look and here.margins.shape == look.margins.shape:  # of a design that is refused nothing is known
            known = np.isfinite(told_margins(here))
            values = np.where(known, here.margins[0] - self.clear, values)
            slopes[known, : self.n] = here.margin_slopes.T[known]
        found = [Row(None, values, slopes, is_reach=True)]
        for each, scale in zip(self.problem.constraints, self.scales, strict=True):
            found.append(self._constraint(each, scale, look, way, loss, z))
        for place, (owner, leaf) in enumerate(self.aux):
            rows, scale, sign = look.rows[leaf], self.leaf_scales[leaf], -leaf.sense  # its variable is below or above each of its rows
            values, slopes = sign * (rows.values[0] / scale - z[self.n + place]), self._slopes_of(rows, sign, scale)
            slopes[:, self.n + place] = -sign
            values, slopes = without_gaps(values, slopes)
            found.append(Row(owner if isinstance(owner, Constraint) else None, values + slopes[:, : self.n] @ way - loss, slopes))
        for objective in self.problem.objectives if self.several else ():  # each below the worst of them
            (value, by), factor = self.graded(objective, look, z), self.problem.sense / self.size
            column = self.n + len(self.aux)
            slope = bounded(-factor * by)
            slope[column] = 1.0
            found.append(Row(None, np.array([z[column] - factor * value + slope[: self.n] @ way - loss]), slope[None]))
        found = [each for each in found if each.values.size]
        if here is look:  # elsewhere they hang on the last good design, too
            if len(self._rows) > 4:
                self._rows.pop(next(iter(self._rows)))
            self._rows[key] = found
        return found

    def _constraint(self, each: Constraint, scale: float, look: Evaluated, way: FloatArray, loss: float, z: FloatArray) -> Row:
        """Return the line or lines of a constraint: one a pose where a single extreme is held against a number."""
        equation, found = each.symbol == "==", single_extreme(each)
        if found is not None and not equation:
            leaf, sign, bound = found
            values, slopes = sign * (look.rows[leaf].values[0] - bound) / scale, self._slopes_of(look.rows[leaf], sign, scale)
            values, slopes = without_gaps(values, slopes)
        else:
            value, slope = self.graded(each, look, z)
            values, slopes = np.array([value / scale]), slope[None] / scale
            if not equation or not np.isfinite(values[0]):
                values, slopes = without_gaps(values, slopes)
            slopes = bounded(slopes)
        values = values + slopes[:, : self.n] @ way - loss - (0.0 if equation else self.spare)
        column = self._slack_column(each)
        if column is not None:
            slopes = np.array(slopes)
            slack = float(z[column])
            if equation:  # both sides give way
                both = np.concatenate([slopes, -slopes])
                both[:, column] = 1.0
                return Row(each, np.concatenate([values + slack, slack - values]), both)
            slopes[:, column] = 1.0
            values = values + slack
        return Row(each, values, slopes, equation)

    def _slopes_of(self, rows: Rows, sign: float, scale: float) -> FloatArray:
        """Return the derivatives of a leaf's rows (n, width) by the solver's variables."""
        slopes = np.zeros((rows.values.shape[1], self.width))
        slopes[:, : self.n] = sign * rows.slopes.T / scale
        return slopes

    def _slack_column(self, constraint: Constraint) -> int | None:
        """Return the variable by which a constraint gives way; None for one that does not."""
        return next((self.width - self.slack + place for place, each in enumerate(self.elastic) if each is constraint), None)

    def first(self, unit: FloatArray) -> FloatArray:
        """Return the solver's variables at unit coordinates."""
        values = self.evaluated_at(unit).of_one
        worst = [self.problem.sense * float(self.problem.value(values.__getitem__)) / self.size] * self.several
        z = np.concatenate([unit, [values[leaf] / self.leaf_scales[leaf] for _, leaf in self.aux], worst, np.zeros(self.slack)])
        if self.elastic:
            for row in self.solver_lines(z):
                column = None if row.constraint is None else self._slack_column(row.constraint)
                if column is not None:
                    z[column] = max(z[column], -float(row.values.min()))
        return z

    # -- one search --------------------------------------------------------------------------------------

    def solve(self, unit: FloatArray, most: int = 200) -> FloatArray:
        """Return the unit coordinates that the solver comes to from some."""
        from scipy.optimize import Bounds

        z = self.first(unit)
        low, high = np.full(self.width, -np.inf), np.full(self.width, np.inf)
        low[: self.n], high[: self.n] = 0.0, 1.0
        low[self.width - self.slack :] = 0.0
        if self.squares is None:
            return self._sequential(z, Bounds(low, high), most)
        for clear in self._stages:
            self.clear = clear
            self._rows.clear()
            z = self._fitted(self.squares, z, (low, high), most)
        self._stages = APPROACH[-1:]  # with further poses, from where it stands
        return z

    def _stacked(self, z: FloatArray, equations: bool) -> tuple[FloatArray, FloatArray]:
        rows = [row for row in self.solver_lines(z) if row.equation is equations]
        if not rows:
            return np.zeros(0), np.zeros((0, self.width))
        return np.concatenate([row.values for row in rows]), np.concatenate([row.slopes for row in rows])

    def _sequential(self, z: FloatArray, bounds: object, most: int) -> FloatArray:
        """Return the result of SLSQP, stopped where it gets no further for long, as at an edge of reach; the best on its way is noted."""
        from scipy.optimize import minimize

        best, since, least = np.array(z, float), 0, np.inf
        self._fitted_to = best[: self.n]

        def merits(at: FloatArray) -> tuple[float, float]:
            value, _ = self.objective(at)
            return value, value + MISSING * max(self.violation(at), 0.0)

        def watched(at: FloatArray) -> float:
            nonlocal best, since, least
            (value, merit), since = merits(at), since + 1
            if merit < least - NO_GAIN * (1.0 + abs(merit)):
                best, since, least = np.array(at, float), 0, merit
                self._fitted_to = best[: self.n]
            elif since > PATIENCE:
                raise NoProgressError
            return value

        parts = {"fun": lambda at, equations: self._stacked(at, equations)[0], "jac": lambda at, equations: self._stacked(at, equations)[1]}
        kinds = [(kind, equations) for kind, equations in (("ineq", False), ("eq", True)) if self._stacked(z, equations)[0].size]
        held = [{"type": kind, "args": (equations,), **parts} for kind, equations in kinds]
        try:
            result = minimize(
                watched, z, jac=lambda at: np.array(self.objective(at)[1]), bounds=bounds, constraints=held,
                method="SLSQP", options={"maxiter": most, "ftol": TIGHT},
            )  # fmt: skip
        except NoProgressError:
            return best
        except LimitReachedError:
            if self.elastic:
                return best
            raise
        return best if least < merits(result.x)[1] - NO_GAIN * (1.0 + abs(least)) else np.asarray(result.x, float)

    def _fitted(self, squares: LeastSquares, z: FloatArray, ends: tuple[FloatArray, FloatArray], most: int) -> FloatArray:
        """Return the result of Levenberg and Marquardt's steps that keep all lines; its own unknowns are stored."""
        w, price, damping = len(self.own), 1.0, DAMPED
        low, high = (np.concatenate([each, np.full(w, end)]) for each, end in zip(ends, (0.0, 1.0), strict=True))
        at = np.concatenate([z, self.own])
        error, missing = self._fit_merit(squares, at)
        lines, by = self._lines_of_squares(at)
        columns = [*range(self.n), *range(self.width, self.width + w)]
        for _ in range(most):
            misses, room = squares.misses(at[columns]), (low - at, high - at)
            slopes = np.zeros((len(misses), self.width + w))
            slopes[:, columns] = squares.slopes(at[columns])
            step = constrained_step(slopes, misses, by, lines, room, damping)
            found, short = self._fit_merit(squares, at + step)
            if not error + price * missing > found + price * short:  # again, by what the lines come to there
                there = self._lines_of_squares(at + step)[0]
                if there.shape == lines.shape:
                    step = constrained_step(slopes, misses, by, np.minimum(there - by @ step, lines), room, damping)
                    found, short = self._fit_merit(squares, at + step)
            new = at + step
            gain = error + price * missing - found - price * short
            if not gain > 0.0 and short < missing * (1.0 - 1e-3) and np.isfinite(found):  # what is missing counts more
                price = max(2.0 * (found - error) / (missing - short), 2.0 * price)
                gain = error + price * missing - found - price * short
            if gain > 0.0:
                at, error, missing, damping = new, found, short, max(0.1 * damping, 1e-12)
                self.own, self._fitted_to = at[self.width :], at[: self.n]
                lines, by = self._lines_of_squares(at)
            else:
                damping *= 5.0
            if damping > MOST_DAMPED or np.abs(step).max(initial=0.0) < 1e-13 or (0.0 < gain <= 1e-12 * error and missing <= 0.1 * MET):
                break
        self.own = at[self.width :]
        return at[: self.width]

    def _fit_merit(self, squares: LeastSquares, at: FloatArray) -> tuple[float, float]:
        """Return the sum of the squares, and by how much the worst line is missed; infinite where the design cannot be worked with."""
        if not self._looked_at(at[: self.n])[1]:
            return np.inf, np.inf
        error = float(np.sum(squares.misses(np.concatenate([at[: self.n], at[self.width :]])) ** 2))
        return (error, max(self.violation(at[: self.width]) - CLEAR, 0.0)) if np.isfinite(error) else (np.inf, np.inf)

    def _lines_of_squares(self, at: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return all lines, an equation as two, with their derivatives by the solver's variables and the own unknowns."""
        held, equal = (self._stacked(at[: self.width], equations) for equations in (False, True))
        assert self.squares is not None
        own, beside = self.squares.own_lines
        by = np.zeros((len(held[0]) + 2 * len(equal[0]) + len(own), len(at)))
        by[: len(by) - len(own), : self.width] = np.concatenate([held[1], equal[1], -equal[1]])
        by[len(by) - len(own) :, self.width :] = own
        return np.concatenate([held[0], equal[0], -equal[0], own @ at[self.width :] + beside]), by

    def violation(self, z: FloatArray) -> float:
        """Return by how much the worst line of the problem is missed, in scaled numbers."""
        missed = (np.abs(row.values) if row.equation else -row.values for row in self.solver_lines(z))
        return max((float(values.max(initial=0.0)) for values in missed), default=0.0)

    def judged(self, unit: FloatArray) -> SearchEnd:
        """Return the objective and the misses at unit coordinates, between the samples too."""
        return self._truth(unit)[0]

    def run(self, rounds: int = ROUNDS) -> SearchEnd:
        """Return the result of a search from the start, with poses between the samples added until none is worse than these.

        Where the limit of designs is reached it is the best so far; without variables and unknowns of its own it is the start.
        """
        if not self.n and self.squares is None:
            return self.judged(self.start)
        try:
            unit = self.start
            for _ in range(rounds):
                unit = self._nearest_good(np.clip(self.solve(unit)[: self.n], 0.0, 1.0))
                joined = self._joined(unit)
                if joined is not None:
                    return joined
                if self.refine(unit) or self._rescaled(unit):
                    continue
                found, missed = self._truth(unit)
                if not missed:
                    return found
            return self.judged(unit)
        except LimitReachedError:
            with self.problem.count.without_limit():
                return self.judged(self._nearest_good(np.clip(self._fitted_to, 0.0, 1.0)))

    def least(self) -> SearchEnd | None:
        """Return the result of an elastic search by its samples alone; None where that is no design."""
        unit = np.clip(self.solve(self.start)[: self.n], 0.0, 1.0)
        with self.problem.count.without_limit():
            look = self.evaluated_at(unit)
        if not bool(look.is_assembled[0]) or not self._usable(look):
            return None
        return self._end(unit, look.of_one)

    def _nearest_good(self, unit: FloatArray) -> FloatArray:
        """Return unit coordinates; where these cannot be worked with, the last ones on the way from the good ones to them that can."""
        if self._looked_at(unit)[1]:
            return unit
        assert self._good is not None
        good, low, high = np.clip(self._good[0], 0.0, 1.0), 0.0, 1.0
        for _ in range(HALVINGS):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if self._looked_at(good + middle * (unit - good))[1] else (low, middle)
        return np.asarray(good + low * (unit - good))

    def _joined(self, unit: FloatArray) -> SearchEnd | None:
        """Return the known end that unit coordinates are as good as; None where there is none, or where they are better.

        Poses that are added make a design only worse, so that they lead to nothing better either.
        """
        if not self.known or not (here := self._end(unit, self.evaluated_at(unit).of_one)).feasible:
            return None
        worse = ((each, self.problem.sense * (here.value - each.value) / max(abs(each.value), 1e-300)) for each in self.known)
        return next((each for each, by in worse if -0.1 * MET <= by <= SAME), None)

    def _rescaled(self, unit: FloatArray) -> bool:
        """Measure the numbers anew where they are much larger or smaller than at the start; return whether they are."""
        look = self.evaluated_at(unit)
        leaf_scales, scales, size = self._scales(look)
        before = np.array([*self.leaf_scales.values(), *self.scales, self.size])
        with np.errstate(all="ignore"):
            ratios = np.array([*leaf_scales.values(), *scales, size]) / before
        if bool(((ratios < OTHER_SIZE) & (ratios > 1.0 / OTHER_SIZE)).all()):
            return False
        self.leaf_scales, self.scales, self.size = leaf_scales, scales, size
        self._rows.clear()
        return True

    def refine(self, unit: FloatArray) -> bool:
        """Add the tops between the samples; return whether one of them is noticeably worse than these."""
        problem, before = self.problem, self.evaluated_at(unit).of_one
        if not problem.refine(problem.dimensions_at(unit, self.combination)):
            return False
        self._looks.clear()
        self._rows.clear()
        after = self.evaluated_at(unit).of_one
        return any(self._is_worse(leaf, after[leaf], before[leaf]) for leaf in problem.leaves)

    def _is_worse(self, leaf: Leaf, value: float, known: float) -> bool:
        """Return whether a leaf's value is noticeably worse than the known one."""
        if isinstance(leaf, Integral) or leaf.worst_over:
            return bool(abs(value - known) > 0.1 * MET * max(self.leaf_scales[leaf], abs(value)))
        worse = (value - known) * leaf.sense
        return bool(leaf.sense) and bool(worse > 0.1 * MET * max(self.leaf_scales[leaf], abs(value)))

    def _truth(self, unit: FloatArray) -> tuple[SearchEnd, bool]:
        """Return the result between the samples too, and whether it is worse than known; its poses become samples."""
        problem, design = self.problem, self.problem.dimensions_at(unit, self.combination)
        look = self.evaluated_at(unit)
        if not bool(look.is_assembled[0]):
            return SearchEnd(self.combination, unit, np.nan, np.inf, False), False
        known, truths, worse = look.of_one, problem.truths(design), False
        for leaf, parts in truths.parts.items():
            if self._is_worse(leaf, truths[leaf], known[leaf]) and problem.refined(leaf, parts):
                worse = True
        if worse:
            self._looks.clear()
            self._rows.clear()
        return self._end(unit, truths), worse

    def _end(self, unit: FloatArray, values: LeafNumbers) -> SearchEnd:
        """Return the end of a search at a design that is assembled throughout, from its leaves' numbers."""
        missing = missing_of(self.problem.constraints, self.scales, values)
        return SearchEnd(self.combination, unit, true_worth(self.problem, values), missing, True)


LEAST = 1e-12
"""Of the largest column: what a column without any effect is damped by."""
GIVING_WAY: Sequence[float] = (1.0, 0.5, 0.1, 0.0)
"""What part of what is missing of a line a step makes good: the first for which there is a step at all."""


def constrained_step(
    slopes: FloatArray, misses: FloatArray, line_slopes: FloatArray, lines: FloatArray, ends: tuple[FloatArray, FloatArray], damping: float
) -> FloatArray:
    """Return the step (n,) that makes |misses + slopes step|^2, damped, least, with lines + line_slopes step >= 0, between ends (n,) each.

    Where no step makes good all that is missing of the lines, it makes good a part of it. Source: C. L. Lawson, R. J. Hanson, Solving Least
    Squares Problems (1974), 23: a problem of least distance.
    """
    from scipy.optimize import nnls

    n = slopes.shape[1]
    sizes = np.sqrt(np.sum(slopes**2, axis=0))
    sizes = np.maximum(sizes, LEAST * (sizes.max(initial=0.0) or 1.0))
    sizes[sizes <= 2.0 * LEAST * sizes.max()] = 1.0
    orthogonal, triangle = np.linalg.qr(np.concatenate([slopes / sizes, np.sqrt(damping) * np.eye(n)]))
    inverse = np.linalg.inv(triangle) / sizes[:, None]
    free = orthogonal.T @ np.concatenate([-misses, np.zeros(n)])
    low, high = ends
    rows = np.concatenate([line_slopes, np.eye(n), -np.eye(n)])
    known = np.concatenate([lines, -low, high])
    kept = np.isfinite(known) & (rows != 0.0).any(axis=1)
    rows, known = rows[kept], known[kept]
    table = rows @ inverse
    size = np.linalg.norm(table, axis=1)
    size[size == 0.0] = 1.0
    for part in GIVING_WAY:
        short = -np.where(known < 0.0, part * known, known) - table @ free
        try:
            weights, _ = nnls(np.concatenate([(table / size[:, None]).T, (short / size)[None]]), np.append(np.zeros(n), 1.0))
        except RuntimeError:
            continue
        rest = np.append((table / size[:, None]).T @ weights, (short / size) @ weights - 1.0)
        if rest[-1] < -1e-12:
            return np.asarray(np.clip(inverse @ (free - rest[:-1] / rest[-1]), low, high))
    return np.zeros(n)


def divisors(expressions: Sequence[Measure]) -> list[Measure]:
    """Return the measures that others are divided by in some expressions."""
    found: list[Measure] = []
    for each in expressions:
        if isinstance(each, CombinedMeasure):
            found += divisors((each.left, each.right))
            if each.symbol == "/" and each.right.leaves:
                found.append(each.right)
            elif each.symbol == "**" and each.left.leaves and isinstance(each.right, FixedNumber) and each.right.value < 0.0:
                found.append(each.left)
    return found


def local_search(local: Local, nearly: float = np.inf) -> SearchEnd:
    """Return the result of a search; conditions missed by no more than `nearly` give way as little as possible, and it runs again."""
    problem, combination, found = local.problem, local.combination, local.run()
    if found.feasible or not (local.n and np.isfinite(found.value)) or found.missing > nearly or problem.count.is_spent:
        return found
    try:
        least = Local(problem, combination, found.unit, elastic=problem.constraints).run()
        again = Local(problem, combination, least.unit).run() if least.missing <= NEARLY_KEPT else least
    except LimitReachedError:
        return found
    return min((found, least, again), key=lambda each: worth_in_order(problem, each))


def worth_in_order(problem: Problem, found: SearchEnd) -> tuple[bool, float]:
    """Return the sort key of the ends of local searches, the best first: those that keep all, by the objective."""
    return not found.feasible, problem.sense * found.value if found.feasible else found.missing


class NoProgressError(Exception):
    """A solver gets no further."""


def graded_leaf(leaf: Leaf, look: Evaluated) -> Graded:
    """Return a leaf's number at the samples with its derivatives by the unit coordinates; NaN where it has no value."""
    rows = look.rows[leaf]
    place = 0
    if leaf.sense and bool(np.isfinite(rows.values[0]).any()):
        place = int((np.nanargmin if leaf.sense < 0.0 else np.nanargmax)(rows.values[0]))
    return Graded(float(rows.values[0, place]), rows.slopes[:, place])


def grows(expression: Measure, leaf: Leaf, values: Mapping[Leaf, float]) -> float:
    """Return how an expression changes with a leaf, from the leaves' numbers."""
    return float(graded(expression, lambda each: Graded(values[each], np.array([1.0 if each is leaf else 0.0]))).slope[0])


def told_margins(look: Evaluated) -> FloatArray:
    """Return the margins (r,) of a look at one design, NaN where they or their derivatives are not known."""
    return np.where(np.isfinite(look.margin_slopes).all(axis=0), look.margins[0], np.nan)


def bounded(slopes: FloatArray) -> FloatArray:
    """Return derivatives of scaled numbers that a solver can work with: those that are infinite, as at a dead point, very steep."""
    return slopes if np.isfinite(slopes).all() else np.nan_to_num(slopes, nan=0.0, posinf=STEEP, neginf=-STEEP)


def without_gaps(values: FloatArray, slopes: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return lines of which those without a value say nothing."""
    gap = ~(np.isfinite(values) & np.isfinite(slopes).all(axis=1))
    return (np.where(gap, 1.0, values), np.where(gap[:, None], 0.0, slopes)) if gap.any() else (values, slopes)


def single_extreme(constraint: Constraint) -> tuple[Leaf, float, float] | None:
    """Return a single extreme, its sign and the number it is held against, where a condition gains from its being so; else None."""
    left, right = constraint.left, constraint.right
    for one, other, sign in ((left, right, 1.0), (right, left, -1.0)):
        if isinstance(one, Leaf) and isinstance(other, FixedNumber):
            sign = sign if constraint.symbol == ">=" else -sign
            if sign * one.sense < 0.0:
                return one, sign, other.value
    return None


def scales_of(problem: Problem, look: Evaluated) -> list[float]:
    """Return the scales of each constraint's numbers: their size over the stroke, or their change over the box.

    `look` is that of one design with derivatives. The number that a constraint is compared with comes first; where that is zero,
    `least(q) >= 0`, it has a size too.
    """
    sizes, values, found = look.leaf_sizes, look.of_one, []
    for each in problem.constraints:
        slope = np.abs(graded(each.margin, lambda leaf: graded_leaf(leaf, look)).slope)
        found.append(scale_among(each, sizes, values, float(slope[np.isfinite(slope)].sum())))
    return found


def true_worth(problem: Problem, values: LeafNumbers) -> float:
    """Return the objective [SI] of the leaves' numbers; NaN where one of them is lost."""
    is_lost = any(leaf in values.lost for each in problem.objectives for leaf in each.leaves)
    with np.errstate(all="ignore"):
        return float("nan") if is_lost else float(problem.value(lambda leaf: np.float64(values[leaf])))


def missing_of(constraints: Sequence[Constraint], scales: Sequence[float], values: LeafNumbers) -> float:
    """Return by how much the worst of some constraints is missed, in parts of its size; infinite where one has no value."""
    if any(values.lost.intersection(each.margin.leaves) for each in constraints):
        return np.inf
    with np.errstate(all="ignore"):
        return max([0.0, *(float(missed(each, values, scale)) for each, scale in zip(constraints, scales, strict=True))])
