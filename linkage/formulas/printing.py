"""Text and LaTeX: SymPy's printers, and the papers' notation for vectors on top of them."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from math import hypot

import sympy
from sympy.matrices.expressions.matexpr import MatrixElement
from sympy.printing.latex import LatexPrinter
from sympy.printing.precedence import PRECEDENCE
from sympy.printing.str import StrPrinter

from ..language import said
from .names import Cross, Deg, Direction, Dot, Norm, PointSymbol, Tcos, TurnV, TurnVL


def plain_number(value: float, digits: int = 6) -> str:
    """Return a number as text, zero without a sign."""
    text = f"{value:.{digits}g}"
    return "0" if float(text) == 0.0 else text


def number_latex(text: str, *, inside: bool = False) -> str:
    r"""Return a value of an equation's text as LaTeX: `28.7^{\circ}` for `28.7 deg`, `1.8 \cdot 10^{7}` for `1.8e+07`, a pair as it is.

    A number that stands `inside` an expression is in parentheses where it is negative.
    """
    if text.startswith("(") and ", " in text:
        return rf"\left({', '.join(number_latex(part) for part in text.strip('()').split(', '))}\right)"
    number, _, unit = text.partition(" ")
    digits, _, power = number.replace("inf", r"\infty").partition("e")
    shown = rf"{digits} \cdot 10^{{{int(power)}}}" if power else digits
    shown += r"^{\circ}" if unit == "deg" else ""
    return rf"\left({shown}\right)" if inside and text.startswith("-") else shown


def reading_order(terms: Sequence[sympy.Basic]) -> list[sympy.Basic]:
    """Return the terms of a sum as they are read: positive ones first, points before vectors, numbers last."""
    return sorted(terms, key=lambda each: (not each.free_symbols, is_negative(each), not isinstance(each, PointSymbol)))


def is_negative(expr: sympy.Basic) -> bool:
    """Return whether a term of a sum is printed with a minus."""
    factor = expr.as_coeff_matrices()[0] if expr.is_Matrix and expr.is_MatMul else expr
    return bool(not expr.is_Add and (factor.is_number or factor.is_Mul) and factor.could_extract_minus_sign())


def factors(expr: sympy.MatMul) -> tuple[sympy.Expr, sympy.Expr, sympy.MatrixExpr]:
    """Return a scaled vector as numerator, denominator and vector."""
    factor, (vector,) = expr.as_coeff_matrices()
    return (*sympy.fraction(factor), vector)


def signed_sum(terms: Sequence[str]) -> str:
    """Return a sum of printed terms."""
    text = terms[0]
    for each in terms[1:]:
        text += f" - {each[1:].lstrip()}" if each.startswith("-") else f" + {each}"
    return text


class Text(StrPrinter):  # type: ignore[misc]
    """Plain text: `AB = TurnVL(AO, -OAB, L_AB)`. With `values` numbers replace the symbols."""

    def __init__(self, values: Mapping[str, str] | None = None) -> None:
        super().__init__()
        self.values = values or {}

    def _print_Symbol(self, expr: sympy.Symbol | sympy.MatrixSymbol) -> str:
        found = self.values.get(expr.name, expr.name)
        return f"({found})" if found.startswith("-") else found

    _print_MatrixSymbol = _print_Symbol

    def _print_MatrixElement(self, expr: MatrixElement) -> str:
        if expr.parent.name not in self.values:
            head, slash, tail = expr.parent.name.partition("/")
            return f"{head}_{'xy'[int(expr.i)]}{slash}{tail}"
        part = self.values[expr.parent.name].strip("()").split(", ")[int(expr.i)]
        return f"({part})" if part.startswith("-") else part

    def _print_Float(self, expr: sympy.Float) -> str:
        return plain_number(float(expr), 12)

    def _print_Add(self, expr: sympy.Add | sympy.MatAdd, order: str | None = None) -> str:
        return signed_sum([self._print(each) for each in reading_order(expr.args)])

    _print_MatAdd = _print_Add

    def _print_MatMul(self, expr: sympy.MatMul) -> str:
        over, under, vector = factors(expr)
        if is_negative(expr):
            return f"-{self.parenthesize(-expr, PRECEDENCE['Mul'], strict=True)}"
        text = self.parenthesize(vector, PRECEDENCE["Mul"], strict=True)
        text = text if over == 1 else f"{self.parenthesize(over, PRECEDENCE['Mul'])}*{text}"
        return text if under == 1 else f"{text}/{self.parenthesize(under, PRECEDENCE['Pow'])}"

    def _print_call(self, expr: sympy.Basic) -> str:
        """Return a word of the method, or a function of SymPy's in small letters, with its arguments."""
        name = type(expr).__name__
        return f"{name if name in ('TurnV', 'TurnVL', 'Tcos') else name.lower()}({', '.join(map(self._print, expr.args))})"

    _print_TurnV = _print_TurnVL = _print_Tcos = _print_Dot = _print_Cross = _print_Min = _print_Max = _print_call

    def _print_Norm(self, expr: Norm) -> str:
        text = self._print(expr.args[0])
        pair = re.fullmatch(r"\(([-+.\de]+), ([-+.\de]+)\)", text) if self.values else None
        if pair is not None:
            return plain_number(hypot(float(pair[1]), float(pair[2])))
        return f"|{text}|"

    def _print_Direction(self, expr: Direction) -> str:
        text = self._print(expr.args[0])
        return f"angle{text}" if text.startswith("(") else f"angle({text})"

    def _print_Deg(self, expr: Deg) -> str:
        return f"{self._print(expr.args[0])} deg"

    def _print_ImmutableDenseMatrix(self, expr: sympy.ImmutableMatrix) -> str:
        return f"({', '.join(map(self._print, expr))})"

    def _print_Abs(self, expr: sympy.Abs) -> str:
        return f"|{self._print(expr.args[0])}|"


HEADS = {TurnV: r"\operatorname{TurnV}", TurnVL: r"\operatorname{TurnV}_{L}", Tcos: r"\operatorname{Tcos}", Direction: r"\arg"}


class Latex(LatexPrinter):  # type: ignore[misc]
    r"""LaTeX: `\overrightarrow{AB} = \operatorname{TurnV}_{L}\left(...\right)`. `words` holds the symbols' LaTeX.

    With `values`, as `Text` takes them, numbers replace the symbols, and products have their dots.
    """

    def __init__(self, words: Mapping[str, str], values: Mapping[str, str] | None = None) -> None:
        super().__init__({"mul_symbol": "dot"} if values else None)
        self.words, self.values = words, values or {}
        self.times = r" \cdot " if values else " "

    def _print_Symbol(self, expr: sympy.Symbol | sympy.MatrixSymbol, style: str = "plain") -> str:
        if expr.name in self.values:
            return number_latex(self.values[expr.name], inside=True)
        if expr.is_Matrix:
            return r"\vec{\imath}" if expr.name == "i" else self.words.get(expr.name, expr.name)
        return self.words.get(expr.name) or str(super()._print_Symbol(expr))

    _print_MatrixSymbol = _print_Symbol

    def _print_MatrixElement(self, expr: MatrixElement) -> str:
        axis = "xy"[int(expr.i)]
        if expr.parent.name in self.values:
            return number_latex(self.values[expr.parent.name].strip("()").split(", ")[int(expr.i)], inside=True)
        return self.words.get(f"{expr.parent.name}.{axis}") or rf"{self._print(expr.parent)}_{{{axis}}}"

    def _print_Float(self, expr: sympy.Float) -> str:
        return number_latex(plain_number(float(expr), 7))

    _print_Add = _print_MatAdd = Text._print_Add

    def _print_MatMul(self, expr: sympy.MatMul) -> str:
        over, under, vector = factors(expr)
        if is_negative(expr):
            return f"- {self._factor(-expr)}"
        if under != 1:
            return rf"\frac{{{self._print(over)}}}{{{self._print(under)}}}{self.times}{self._factor(vector)}"
        return self._factor(vector) if over == 1 else f"{self.parenthesize(over, PRECEDENCE['Mul'])}{self.times}{self._factor(vector)}"

    def _print_TurnV(self, expr: TurnV | Tcos | Direction, exp: str | None = None) -> str:
        call = rf"{HEADS[type(expr)]}\left({', '.join(map(self._print, expr.args))}\right)"
        return call if exp is None else f"{call}^{{{exp}}}"

    _print_TurnVL = _print_Tcos = _print_Direction = _print_TurnV

    def _print_Norm(self, expr: Norm) -> str:
        if self.values:
            found = Text(self.values).doprint(expr)
            if not found.startswith("|"):
                return number_latex(found)
        return rf"\left|{self._print(expr.args[0])}\right|"

    def _print_Dot(self, expr: Dot) -> str:
        return r" \cdot ".join(map(self._factor, expr.args))

    def _print_Cross(self, expr: Cross) -> str:
        left, right = map(self._factor, expr.args)
        return rf"\left({left} \times {right}\right)_{{z}}"

    def _factor(self, vector: sympy.Basic) -> str:
        text = self._print(vector)
        return rf"\left({text}\right)" if vector.is_MatAdd else str(text)

    def _print_Piecewise(self, expr: sympy.Piecewise) -> str:
        text = str(super()._print_Piecewise(expr))
        for word, own in {"for": said("for"), "otherwise": said("otherwise")}.items():
            text = text.replace(rf"\text{{{word}}}", rf"\text{{{own}}}")
        return text

    def _print_Deg(self, expr: Deg) -> str:
        return rf"{self._print(expr.args[0])}^{{\circ}}"

    def _print_ImmutableDenseMatrix(self, expr: sympy.ImmutableMatrix) -> str:
        rows = r" \\ ".join(map(self._print, expr))
        return rf"\begin{{pmatrix}} {rows} \end{{pmatrix}}"
