"""Which column of a calculation gives which column of a machine's table of results.

A machine makes its table by functions of its own, which no formula can be read from. So a column is live where an equation gives its
numbers to the last digits: of this design at every pose, and at some poses of others whose dimensions all differ a little. Where that
holds only as long as some dimensions are 0 or 1 (a friction, an efficiency that no equation has), the formula says so.
"""

from __future__ import annotations

import warnings
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from itertools import permutations
from typing import Any, final

import numpy as np
import sympy

from ..errors import LinkageError, SingularWarning
from ..motion import Column
from ..program import FloatArray
from ..reports import results
from ..units import factor
from .calculation import Calculation

EQUAL = 1e-10
"""Relative to the greatest value: two ways to one number differ by less, other numbers by more."""
NEGLIGIBLE = 1e-3
"""A column whose greatest value is smaller is compared as if it were this great [SI]: a zero is rounding."""
LOOKED_AT = 7
SCALES = (1e-3, 1e-5, 1e-7)
"""By how much the other designs differ; a smaller step where a mechanism with such links does not go together."""
LITTLE = 0.1
"""What a dimension that is zero becomes, in its unit; a hundredth of that where it has none."""


@final
@dataclass(frozen=True, eq=False)
class LiveResult:
    """A column of results; what gives it, in the calculation's symbols, or None, and the dimensions that must stay 0 or 1 for that."""

    column: Column
    expr: Any = None
    kept: tuple[str, ...] = ()


def live_results(calculation: Calculation) -> list[LiveResult]:
    """Return the machine's table over the calculation's poses, each column with what gives it."""
    table = results(calculation.design, calculation.motion)
    return FormulaSearch(calculation, table).found()


Trial = tuple[list[FloatArray], dict[sympy.Symbol, Any]]
"""A design's table of results, and what the formulas give there."""


@final
class FormulaSearch:
    """Looks for the formulas of a table of results on designs that differ a little."""

    def __init__(self, calculation: Calculation, table: list[Column]) -> None:
        self.calculation, self.table = calculation, table
        self.neutral = [name for name, value in calculation.design.dimensions.items() if value in (0.0, 1.0)]
        picks = np.unique(np.linspace(0, calculation.motion.shape[0] - 1, LOOKED_AT).round().astype(int))
        self.poses = {name: value[picks] if np.ndim(value) else value for name, value in calculation.stroke_values.items()}

    def found(self) -> list[LiveResult]:
        """Return each column with the first formula that gives it everywhere."""
        self.here = self._trial({}, self.calculation.stroke_values)
        self.changed = self._first(self._changes(all_of=True))
        self.beside = self._first(self._changes(all_of=False))
        found = [self._live(place, self._named(place)) for place in range(len(self.table))]
        simple = dict.fromkeys(each.expr for each in found if each.expr is not None)
        return [
            each if each.expr is not None else self._live(place, self._combined(place, list(simple))) for place, each in enumerate(found)
        ]

    def _live(self, place: int, candidates: Iterator[sympy.Expr]) -> LiveResult:
        column, own = self.table[place], self._own(self.table[place])
        for expr in candidates:
            if self.here is None or not is_given(self.here, place, expr):
                continue
            if is_given(self.changed, place, expr) or (self.changed is None and expr in own):
                return LiveResult(column, expr)
            if is_given(self.beside, place, expr):
                return LiveResult(column, expr, tuple(name for name in self.neutral if not is_given(self._alone[name], place, expr)))
        return LiveResult(column)

    @cached_property
    def _alone(self) -> dict[str, Trial | None]:
        """The trial of each dimension that is 0 or 1, changed alone, one way or the other."""
        return {name: self._first({name: value} for value in self._others(name)) for name in self.neutral}

    def _others(self, name: str) -> tuple[float, ...]:
        """Return other values of a dimension that is 0 or 1."""
        unit = self.calculation.design.plan.table.entries[name].unit
        little = LITTLE * (factor(unit) if unit else 0.01)
        return (little, -little) if self.calculation.design.dimensions[name] == 0.0 else (1.0 - SCALES[0], 1.0 + SCALES[0])

    # -- what may give a column ------------------------------------------------------------------------

    def _named(self, place: int) -> Iterator[sympy.Expr]:
        """Yield the symbols that may give a column, those of its own name first."""
        own = self._own(self.table[place])
        yield from own
        yield from (name for name in self.calculation.stroke_symbols.values() if name not in own)
        yield from (each.symbol for each in reversed(self.calculation.columns) if each.expr is not None and each.symbol not in own)

    def _combined(self, place: int, simple: list[sympy.Expr]) -> Iterator[sympy.Expr]:
        """Yield a quantity that is divided by a dimension, or multiplied, and differences of what gives other columns."""
        if self.here is not None:
            table, known = self.here
            for each in self.calculation.columns:
                if each.expr is None:
                    continue
                with np.errstate(all="ignore"):
                    shares = table[place] / known[each.symbol]
                if not np.isfinite(shares).all() or np.ptp(shares) > EQUAL * abs(shares[0]):
                    continue
                for dimension, name in self.calculation.dimension_symbols.items():
                    value = self.calculation.design.dimensions[name]
                    if name not in self.neutral and abs(value - shares[0]) <= EQUAL * abs(value):
                        yield each.symbol * dimension
                    elif name not in self.neutral and abs(value * shares[0] - 1.0) <= EQUAL:
                        yield each.symbol / dimension
        yield from (a - b for a, b in permutations(simple, 2))

    def _own(self, column: Column) -> list[sympy.Expr]:
        """Return the symbols of a column's own name."""
        strokes = [symbol for name, symbol in self.calculation.stroke_symbols.items() if name == column.name]
        return strokes + [each.symbol for each in self.calculation.columns if each.name == column.name and not each.checks]

    # -- other designs ---------------------------------------------------------------------------------

    def _changes(self, all_of: bool) -> Iterator[Mapping[str, float]]:
        """Yield changes of all dimensions at once, smaller and smaller; those that are 0 or 1 stay so unless it is of all."""
        random, own = np.random.default_rng(0), self.calculation.design.dimensions
        for scale in SCALES:
            change = {name: value * (1.0 - scale * random.uniform(0.3, 1.0)) for name, value in own.items() if name not in self.neutral}
            yield change | ({name: self._others(name)[0] for name in self.neutral} if all_of else {})

    def _first(self, changes: Iterable[Mapping[str, float]]) -> Trial | None:
        """Return the trial of the first change that goes together."""
        trials = (self._trial(change, self.poses) for change in changes)
        return next((trial for trial in trials if trial is not None), None)

    def _trial(self, change: Mapping[str, float], poses: Mapping[str, object]) -> Trial | None:
        """Return the trial of a changed design at some poses; None where it does not go together."""
        try:
            design = self.calculation.design.replaced(**change)
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", SingularWarning)
                motion, known = self.calculation.at_design(design, poses)
                table = results(design, motion)
        except LinkageError:
            return None
        known |= {symbol: motion.strokes[name] for name, symbol in self.calculation.stroke_symbols.items()}
        return [np.array(np.broadcast_to(np.asarray(each.values, float), motion.shape)) for each in table], known


def is_given(trial: Trial | None, place: int, expr: sympy.Expr) -> bool:
    """Return whether a formula gives a column of a trial: a symbol, a quotient, a product or a difference."""
    if trial is None or place >= len(trial[0]):
        return False
    column, known = trial[0][place], trial[1]
    if not expr.free_symbols <= known.keys():
        return False
    size = float(np.nanmax(np.abs(column), initial=0.0))
    value = known[expr] if expr.is_Symbol else quick_value(expr, known)
    return bool(np.allclose(value, column, rtol=0.0, atol=EQUAL * max(size, NEGLIGIBLE), equal_nan=True))


def quick_value(expr: sympy.Expr, known: Mapping[sympy.Symbol, Any]) -> Any:
    """Return the value of a product of powers of symbols, or of a sum of such."""
    if expr.is_Symbol:
        return known[expr]
    if expr.is_Number:
        return float(expr)
    if expr.is_Pow:
        return quick_value(expr.base, known) ** int(expr.exp)
    parts = [quick_value(each, known) for each in expr.args]
    return sum(parts) if expr.is_Add else np.multiply.reduce(np.broadcast_arrays(*parts))
