"""A design's equations as columns over a stroke: their names, formulas and numbers, and their parts in the results."""

from __future__ import annotations

import warnings
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from functools import cached_property
from typing import Any

import numpy as np
import sympy

from ..errors import DefinitionError, LinkageError, SingularWarning
from ..formulas import Equation, Equations, equations, explicit
from ..formulas.arithmetic import ValuesOf
from ..formulas.listing import X_AXIS
from ..formulas.names import Direction
from ..formulas.numbered import members_with_lines
from ..formulas.printing import Text
from ..frozen import immutable
from ..loads import PLAIN_CASE
from ..mechanism import Mechanism
from ..motion import Column
from ..quantities import Dimension, Quantity, Stroke
from ..reports import Run, reached_motion, results
from ..units import factor
from ..vectors import FloatArray, Numbers

AGREE = 1e-9
"""Relative: a formula that is further from the engine is not used."""
ITERATED = "found by iteration: a number, not a formula"
UNKNOWN: FloatArray = np.empty(0)
"""The values of a column that is not worked out yet."""
BY_ENGINE = "told by the engine: a number, not a formula"


@immutable
class CalculatedColumn:
    """One quantity over the poses: the number of its equation, its name, its words and its SI unit; `expr` is None for plain numbers.

    `turns` is not None for the direction of a vector, which goes on over the poses without a jump: whole turns added at the first one.
    `checks` marks a difference that is zero where pins found together fit.
    """

    number: str
    name: str
    meaning: str
    unit: str
    symbol: sympy.Symbol
    expr: Any
    values: FloatArray
    turns: int | None = None
    checks: bool = False


class Calculation:
    """The equations of one design over a run, forces and transfer ratios included, as columns in their order.

    Raises AssemblyError where no pose can be assembled, DefinitionError for a batch of designs. `left_out` says, in sentences, what has
    no equation.
    """

    def __init__(self, design: Mechanism, run: Run, count: int) -> None:
        self.design, self.run = design, run
        self.left_out: list[str] = []
        if any(len(way) != 2 for way in run.ways.values()):
            raise DefinitionError(f"{design.plan.title}: a workbook's strokes run from one value to another; give {run.stroke} two.")
        over = run.over(np.linspace(0.0, 1.0, count))
        self.stroke_values: dict[str, Any] = {name: np.asarray(value, float) for name, value in over.items()}
        self.motion = reached_motion(design, self.stroke_values)
        self.equations = self._equations()
        self.columns: list[CalculatedColumn] = []
        self.headings: dict[int, str] = {}
        """What stands over the columns that begin a part of the machine, by their places; none without parts."""
        self._known = self.equations._inputs(self.stroke_values, "nan")
        listing = self.equations._listing  # what no equation gives: pins found together, and what elements tell
        vectors = [(pin, explicit(listing.names.vector(pin))) for pin in listing.unknowns]
        pins = [(f"{pin}_{axis}", each) for pin, vector in vectors for axis, each in zip("xy", vector, strict=True)]
        told = [(column_name(symbol.name), symbol) for given in self.equations._givens for symbol in explicit(given.symbol)]
        for meaning, numbers in ((ITERATED, pins), (BY_ENGINE, told)):
            for name, symbol in numbers:
                self._add(CalculatedColumn("", name, meaning, "", symbol, None, self._spread(self._known[symbol])))
        for each in self.equations:
            if each.number in self.equations.headings:
                self.headings[len(self.columns)] = self.equations.headings[each.number]
            self._write(each)

    # -- what there is to write ------------------------------------------------------------------------

    def _equations(self) -> Equations:
        """Return the equations with as much as has some of the forces and of the ratios of outputs and of the last point that is built."""
        plan = self.design.plan
        written = members_with_lines(equations(self.design)._listing)
        outputs = [name for name, each in plan.of_kind(Quantity).items() if not isinstance(each, (Stroke, Dimension))]
        moving = [name for name in (*outputs, *plan.moving[-1:]) if self.run.stroke in plan.reaches(name)]
        targets = [name for name in moving if name in written]

        def lines_with(**options: Any) -> Equations | None:
            try:
                return equations(self.design, **options)
            except DefinitionError as error:
                self.left_out.append(str(error))
                return None

        whole = lines_with(ratio=targets, wrt=self.run.stroke, forces=True, case=self.run.case)
        if whole is not None:
            return whole
        self.left_out.clear()
        found = [each for each in targets if lines_with(ratio=each, wrt=self.run.stroke) is not None]
        forces = lines_with(forces=True, case=self.run.case) is not None
        return equations(self.design, ratio=found, wrt=self.run.stroke, forces=forces, case=self.run.case if forces else None)

    # -- columns ---------------------------------------------------------------------------------------

    def _write(self, each: Equation) -> None:
        """Add the columns of an equation: one of a number, two of a vector; before them the directions that it takes."""
        rhs = each.rhs
        for place, word in enumerate(sorted(rhs.atoms(Direction), key=str)):
            symbol, text = sympy.Symbol(str(word), real=True), str(each).partition(" = ")[0]
            if symbol not in self._known:
                meaning = f"the direction that {text} takes, without jumps"
                numbered = f"({each.number}{'abcdefgh'[place % 8]})"
                heading, expr = str(Text().doprint(word)), explicit(word)[0]
                self._work_out(CalculatedColumn(numbered, heading, meaning, "rad", symbol, expr, UNKNOWN, turns=0))
            rhs = rhs.xreplace({word: symbol})
        number, unit = f"({each.number})", "rad" if each.unit.si == "deg" else each.unit.si
        if not (each.lhs.is_Symbol or (each.lhs.is_Matrix and hasattr(each.lhs, "name"))):
            (left,), (right,) = explicit(each.lhs), explicit(rhs)
            name = f"{each.name} - ({right})" if right != 0 else each.name
            meaning, symbol = f"{each}: zero where it holds", sympy.Dummy(real=True)
            self._work_out(CalculatedColumn(number, name, meaning, unit, symbol, left - right, UNKNOWN, checks=True))
            return
        for symbol, expr in zip(explicit(each.lhs), explicit(rhs), strict=True):
            self._work_out(CalculatedColumn(number, column_name(symbol.name), str(each), unit, symbol, expr, UNKNOWN))
        self._compare(each)

    def _work_out(self, column: CalculatedColumn) -> None:
        """Add a column with its values, from those of the columns before it."""
        i = dict(zip(explicit(X_AXIS), (sympy.S.One, sympy.S.Zero), strict=True))
        exact = column.expr.xreplace({symbol: value for symbol, value in i.items() if symbol not in self._known})
        values = self._spread(worked_out(exact, self._known))
        self._add(replace(column, expr=exact, values=values if column.turns is None else np.unwrap(values)))

    def _add(self, column: CalculatedColumn) -> None:
        self.columns.append(column)
        self._known[column.symbol] = column.values

    def _spread(self, values: object) -> FloatArray:
        """Return values over the poses, shape (poses,)."""
        return np.array(np.broadcast_to(np.asarray(values, float), self.motion.shape))

    def _compare(self, each: Equation) -> None:
        """Hold an output's column against the engine: put a direction's whole turns right, or keep the engine's numbers."""
        member = self.design.plan.members.get(each.name)
        if not isinstance(member, Quantity) or isinstance(member, (Stroke, Dimension)):
            return
        engine, column = self._spread(self.motion[each.name]), self.columns[-1]
        if is_close(column.values, engine):
            return
        turned = [place for place, other in enumerate(self.columns) if other.turns is not None and column.expr.has(other.symbol)]
        for place in turned:
            other = self.columns[place]
            turns = round(float(engine[0] - column.values[0]) / float(column.expr.diff(other.symbol)) / (2.0 * np.pi))
            self.columns[place] = replace(other, values=other.values + 2.0 * np.pi * turns, turns=turns)
            again = self._known | {other.symbol: self.columns[place].values}
            values = self._spread(worked_out(column.expr, again))
            if is_close(values, engine):
                self._known = again | {column.symbol: values}
                self.columns[-1] = replace(column, values=values)
                return
            self.columns[place] = other
        self.columns.pop()
        self._add(replace(column, expr=None, values=engine, meaning=f"{column.meaning}; {BY_ENGINE}"))

    @property
    def stroke_symbols(self) -> dict[str, sympy.Symbol]:
        """The symbols of the strokes, by name."""
        return {name: self.equations._listing.names.quantity(name) for name in self.design.strokes}

    # -- dimensions ------------------------------------------------------------------------------------

    @cached_property
    def dimension_symbols(self) -> dict[sympy.Symbol, str]:
        """The dimension behind each plain symbol of the formulas, a fixed point's coordinates by both of their symbols."""
        names, spellings = self.equations._listing.names, self.design.plan.table.spellings
        found = {names.quantity(name): name for name in self.design.dimensions}
        for point in (*self.design.plan.ground, *self.equations._listing.fixed_guides):
            for axis, symbol in zip("xy", explicit(names.vector(point)), strict=True):
                if f"{point}.{axis}" in spellings:
                    found[symbol] = spellings[f"{point}.{axis}"][0]
        return found

    @cached_property
    def used(self) -> set[str]:
        """The dimensions that some formula reads."""
        free = set[sympy.Symbol]().union(*(each.expr.free_symbols for each in self.columns if each.expr is not None))
        return {self.dimension_symbols[symbol] for symbol in free if symbol in self.dimension_symbols}

    def owner(self, name: str) -> str:
        """Return the part that a dimension is of, "" for the machine itself."""
        return self.equations._listing.names.owned(name)[0]


def column_name(symbol: str) -> str:
    """Return a plain symbol's name as a heading: AB.x is AB_x, dAB/dS.x is dAB_x/dS."""
    head, dot, axis = symbol.rpartition(".")
    if not dot or axis not in ("x", "y"):
        return symbol
    over, slash, under = head.partition("/")
    return f"{over}_{axis}{slash}{under}"


def worked_out(expr: sympy.Expr, known: Mapping[sympy.Symbol, Numbers]) -> Numbers:
    """Return an expression's value from those of its symbols."""
    with np.errstate(all="ignore"):
        value: Numbers = ValuesOf(known)[expr]
    return value


def is_close(values: FloatArray, engine: FloatArray) -> bool:
    """Return whether values are the engine's, NaN at the same poses."""
    size = float(np.nanmax(np.abs(engine), initial=1.0))
    return bool(np.allclose(values, engine, rtol=AGREE, atol=AGREE * size, equal_nan=True))


# Which column of a calculation gives which column of a machine's table of results.
#
# A machine makes its table by functions of its own, which no formula can be read from. So a column is live where an equation gives its
# numbers to the last digits: of this design at every pose, and at some poses of others whose dimensions all differ a little. Where that
# holds only as long as some dimensions are 0 or 1 (a friction, an efficiency that no equation has), the formula says so.

EQUAL = 1e-10
"""Relative to the greatest value: two ways to one number differ by less, other numbers by more."""
NEGLIGIBLE = 1e-3
"""A column whose greatest value is smaller is compared as if it were this great [SI]: a zero is rounding."""
LOOKED_AT = 7
SCALES = (1e-3, 1e-5, 1e-7)
"""By how much the other designs differ; a smaller step where a mechanism with such links does not go together."""
LITTLE = 0.1
"""What a dimension that is zero becomes, in its unit; a hundredth of that where it has none."""


@immutable
class LiveResult:
    """A column of results; its formula in the calculation's symbols, or None, and the dimensions that must stay 0 or 1 for it."""

    column: Column
    expr: Any = None
    unchanged: tuple[str, ...] = ()


def live_results(calculation: Calculation) -> list[LiveResult]:
    """Return the machine's table over the calculation's poses, each column with its formula."""
    table = results(calculation.design, calculation.motion, calculation.run.case or PLAIN_CASE)
    return FormulaSearch(calculation, table).result()


Trial = tuple[list[FloatArray], dict[sympy.Symbol, Any]]
"""A design's table of results, and what the formulas give there."""


class FormulaSearch:
    """Looks for the formulas of a table of results on designs that differ a little."""

    def __init__(self, calculation: Calculation, table: list[Column]) -> None:
        self.calculation, self.table = calculation, table
        self.neutral = [name for name, value in calculation.design.dimensions.items() if value in (0.0, 1.0)]
        picks = np.unique(np.linspace(0, calculation.motion.shape[0] - 1, LOOKED_AT).round().astype(int))
        self.poses = {name: value[picks] if np.ndim(value) else value for name, value in calculation.stroke_values.items()}

    def result(self) -> list[LiveResult]:
        """Return each column with the first formula that gives it everywhere."""
        self.here = self._trial({}, self.calculation.stroke_values)
        self.changed = self._first(self._changes(all_of=True))
        self.beside = self._first(self._changes(all_of=False))
        found = [self._live(place, self._named(place)) for place in range(len(self.table))]
        simple = {} if self.here is None else {each.expr: worked_out(each.expr, self.here[1]) for each in found if each.expr is not None}
        return [each if each.expr is not None else self._live(place, self._combined(place, simple)) for place, each in enumerate(found)]

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

    def _combined(self, place: int, simple: Mapping[sympy.Expr, Numbers]) -> Iterator[sympy.Expr]:
        """Yield a quantity divided by a dimension, or multiplied, and differences of formulas of other columns."""
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
        yield from self._differences(place, simple)

    def _differences(self, place: int, simple: Mapping[sympy.Expr, Numbers]) -> Iterator[sympy.Expr]:
        """Yield the differences of two formulas, with their values, that come near a column at every pose here."""
        if self.here is None or not simple:
            return
        column = self.here[0][place]
        values = np.array([np.broadcast_to(each, column.shape) for each in simple.values()], float)
        near = 2.0 * EQUAL * max(float(np.nanmax(np.abs(column), initial=0.0)), NEGLIGIBLE)
        for a, own in zip(simple, values, strict=True):
            apart = own - values
            fits = (np.abs(apart - column) <= near) | (np.isnan(apart) & np.isnan(column))
            yield from (a - b for b, fit in zip(simple, fits.all(axis=1), strict=True) if fit and b is not a)

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

    def _trial(self, change: Mapping[str, float], poses: Mapping[str, Any]) -> Trial | None:
        """Return the trial of a changed design at some poses; None where it does not go together."""
        try:
            design = self.calculation.design.replaced(**change)
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", SingularWarning)
                own = self.calculation.equations
                known = Equations(design, own._lines, own._listing, 1, None, own._forces)._inputs(poses, "nan")
                motion = design.at(**poses)
                for column in self.calculation.columns:  # plain numbers are the engine's
                    if column.expr is not None:
                        values = np.broadcast_to(np.asarray(worked_out(column.expr, known), float), motion.shape)
                        known[column.symbol] = values if column.turns is None else np.unwrap(values) + 2.0 * np.pi * column.turns
                table = results(design, motion, self.calculation.run.case or PLAIN_CASE)
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
    return bool(np.allclose(worked_out(expr, known), column, rtol=0.0, atol=EQUAL * max(size, NEGLIGIBLE), equal_nan=True))
