"""The derivative of each line by a stroke: the chain of differentiated primitives.

With AB = TurnVL(AO, a, L) and AO turning at the rate w (cross(AO, AO') / |AO|^2), AB' = (w + a') TurnV(AB, 90 deg) + L'/L AB.
The cosine rule L3^2 = L1^2 + L2^2 - 2 L1 L2 cos(a) gives a'. Source: any text on velocity analogues, such as Artobolevsky.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import final

import sympy
from sympy.matrices.expressions.matadd import MatAdd
from sympy.matrices.expressions.matexpr import MatrixElement, MatrixSymbol
from sympy.matrices.expressions.matmul import MatMul

from .listing import ListingLine
from .names import Cross, Deg, Direction, Dot, Norm, SymbolNames, Tcos, TurnV
from .symbolic import LENGTH, Unit

STILL = sympy.ZeroMatrix(2, 1)


@final
class LineDerivatives:
    """Derivatives by one stroke of the lines read so far."""

    def __init__(self, stroke: sympy.Symbol, unit: Unit, names: SymbolNames) -> None:
        self.stroke, self.unit, self.names = stroke, unit, names
        self.known: dict[sympy.Basic, sympy.Basic] = {stroke: sympy.S.One}
        self._line: ListingLine | None = None
        self._found: list[ListingLine] = []

    def lines(self, written: Sequence[ListingLine]) -> list[ListingLine]:
        """Return the derivative of each line that follows the stroke."""
        for line in written:
            self._line = line
            rate = self.of(line.rhs) if line.rhs.is_Matrix else self.number(line.rhs, line.lhs)
            if rate in (sympy.S.Zero, STILL) or getattr(rate, "is_zero_matrix", False):
                continue
            self.known[line.lhs] = self.names.derivative(line.lhs, self.stroke)
            self._found.append(ListingLine(self.known[line.lhs], rate, line.unit.times(self.unit.to_the(-1))))
        return self._found

    # -- scalars ---------------------------------------------------------------------------------------

    def number(self, expr: sympy.Expr, angle: sympy.Symbol | None = None) -> sympy.Expr:
        """Return the derivative of a scalar; `angle` is its own symbol, where it has one."""
        if isinstance(expr, Tcos):
            return self._cosine_rule(expr, expr if angle is None else angle)
        words = sorted(expr.atoms(Norm, Direction, Cross, Dot, MatrixElement, Tcos), key=str)
        stands = {word: sympy.Dummy(real=True) for word in words}
        plain = expr.xreplace(stands)
        rates = [(symbol, self._word(word)) for word, symbol in stands.items()]
        rates += [(symbol, self.known[symbol]) for symbol in sorted(plain.free_symbols, key=str) if symbol in self.known]
        total = sympy.Add(*(plain.diff(symbol) * rate for symbol, rate in rates if rate != 0))
        return total.xreplace({symbol: word for word, symbol in stands.items()})

    def _cosine_rule(self, expr: Tcos, angle: sympy.Expr) -> sympy.Expr:
        a, b, c = expr.args
        da, db, dc = map(self.number, expr.args)
        turned = c * dc - a * da - b * db + sympy.cos(angle) * (a * db + b * da)
        return turned / (a * b * sympy.sin(angle))

    def _word(self, word: sympy.Expr) -> sympy.Expr:
        """Return the derivative of a number read off vectors."""
        match word:
            case Tcos():
                return self._cosine_rule(word, word)
            case MatrixElement():
                rate = self.of(word.parent)
                return sympy.S.Zero if rate == STILL else rate[word.i, 0]
            case Norm():
                return self._stretching(word.args[0])
            case Direction():
                return self._turning(word.args[0])
        a, b = word.args  # the factors of a scalar or vector product
        da, db = self.of(a), self.of(b)
        return sympy.Add(*(type(word)(*pair) for pair, rate in (((da, b), da), ((a, db), db)) if rate != STILL))

    def _turning(self, vector: sympy.MatrixExpr) -> sympy.Expr:
        """Return the rate at which a vector turns."""
        rate = self.of(vector)
        return sympy.S.Zero if rate == STILL else Cross(vector, rate) / Norm(vector) ** 2

    def _stretching(self, vector: sympy.MatrixExpr) -> sympy.Expr:
        """Return the rate of a vector's length, that of a named one with a line of its own: d|EC|/dS."""
        if isinstance(vector, TurnV):  # written where it is used
            base, _, *length = vector.args
            return self.number(length[0]) if length else self._stretching(base)
        rate = self.of(vector)
        if rate == STILL:
            return sympy.S.Zero
        if not isinstance(vector, MatrixSymbol):
            return Dot(vector, rate) / Norm(vector)
        if Norm(vector) not in self.known:
            symbol = self.known[Norm(vector)] = self.names.stretching(vector, self.stroke)
            self._found.append(ListingLine(symbol, Dot(vector, rate) / Norm(vector), LENGTH.times(self.unit.to_the(-1))))
        return self.known[Norm(vector)]

    # -- vectors ---------------------------------------------------------------------------------------

    def of(self, vector: sympy.MatrixExpr) -> sympy.MatrixExpr:
        """Return the derivative of a vector; STILL where it does not follow the stroke."""
        match vector:
            case MatrixSymbol():
                return self.known.get(vector, STILL)
            case MatAdd():
                return summed([rate for rate in map(self.of, vector.args) if rate != STILL])
            case MatMul():
                factor, (rest,) = vector.as_coeff_matrices()
                rate, scaled = self.of(rest), self.number(factor)
                turned = [] if rate == STILL else [MatMul(factor, rate)]
                return summed(turned + ([] if scaled == 0 else [MatMul(scaled, rest)]))
            case TurnV():
                base, angle, *length = vector.args
                turns = self.number(angle) + self._turning(base)
                longer = self.number(length[0]) / length[0] if length else self._stretching(base) / Norm(base)
                here = self._line.lhs if self._line is not None and vector == self._line.rhs else vector
                return summed([MatMul(factor, part) for factor, part in ((turns, TurnV(here, Deg(90))), (longer, here)) if factor != 0])
        return sympy.ImmutableMatrix([self.number(each) for each in vector])


def summed(vectors: Sequence[sympy.MatrixExpr]) -> sympy.MatrixExpr:
    """Return the sum of vectors, kept as written; STILL for none."""
    return (MatAdd(*vectors) if len(vectors) > 1 else vectors[0]) if vectors else STILL


def lines_needed(lines: Sequence[ListingLine], targets: Iterable[sympy.Basic]) -> list[ListingLine]:
    """Return the lines that some expressions are built from, in order."""
    wanted, found = set[sympy.Basic]().union(*(each.free_symbols for each in targets)), []
    for line in reversed(lines):
        if line.lhs in wanted:
            wanted |= line.rhs.free_symbols
            found.append(line)
    return found[::-1]


def symbols_behind(lines: Sequence[ListingLine], expr: sympy.Basic) -> set[sympy.Basic]:
    """Return the symbols that an expression is built from, those of the lines behind it too."""
    return set(expr.free_symbols).union(*(line.rhs.free_symbols for line in lines_needed(lines, [expr])))
