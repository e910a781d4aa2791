"""SymPy expressions as the formulas of a spreadsheet, and the names of its cells.

Three things differ from other languages: a sign binds closer than a power (-a^2 is (-a)^2), ATAN2 takes x before y, and LN is the natural
logarithm. Names and decimals are those of the file format, whatever language the spreadsheet speaks.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping

import sympy
from sympy.printing.precedence import PRECEDENCE
from sympy.printing.str import StrPrinter

from ..formulas.printing import reading_order

LONGEST_FORMULA = 8000
"""Characters; a spreadsheet takes 8192."""
FUNCTION_NAMES: Mapping[str, str] = {
    "sin": "SIN", "cos": "COS", "tan": "TAN", "acos": "ACOS", "asin": "ASIN", "atan": "ATAN", "Abs": "ABS", "exp": "EXP", "log": "LN",
    "sign": "SIGN", "Min": "MIN", "Max": "MAX", "And": "AND", "Or": "OR", "Not": "NOT",
}  # fmt: skip


def formula(expr: sympy.Expr, read: Callable[[sympy.Symbol], str]) -> str | None:
    """Return an expression as a formula, `=...`; None where it is longer than a spreadsheet takes. `read` gives a symbol's place."""
    text = f"={FormulaText(read).doprint(expr)}"
    return text if len(text) <= LONGEST_FORMULA else None


class FormulaText(StrPrinter):  # type: ignore[misc]
    """A formula's text; `read` gives the place of a symbol."""

    def __init__(self, read: Callable[[sympy.Symbol], str]) -> None:
        super().__init__()
        self.read = read

    def _print_Symbol(self, expr: sympy.Symbol) -> str:
        return self.read(expr)

    _print_Dummy = _print_Symbol

    def _print_Float(self, expr: sympy.Float) -> str:
        return repr(float(expr)).removesuffix(".0")

    def _print_Rational(self, expr: sympy.Rational) -> str:
        return f"{expr.p}/{expr.q}"

    def _print_Pi(self, expr: object) -> str:
        return "PI()"

    def _print_NaN(self, expr: object) -> str:
        return "NA()"

    def _print_Add(self, expr: sympy.Add, order: str | None = None) -> str:
        text = ""
        for each in reading_order(expr.args):
            negative = each.could_extract_minus_sign()
            part = self.parenthesize(-each if negative else each, PRECEDENCE["Mul"], strict=True)
            text += f"-{part}" if negative and text else f"+{part}" if text else self._print(each)
        return text

    def _print_Mul(self, expr: sympy.Mul) -> str:
        if expr.could_extract_minus_sign():
            rest = self.parenthesize(-expr, PRECEDENCE["Mul"], strict=True)
            return f"-1*{rest}" if "^" in rest else f"-{rest}"
        over, under = sympy.fraction(expr, exact=True)
        if under == 1:
            return "*".join(self.parenthesize(each, PRECEDENCE["Mul"], strict=True) for each in sympy.Mul.make_args(expr))
        return f"{self.parenthesize(over, PRECEDENCE['Mul'])}/{self.parenthesize(under, PRECEDENCE['Pow'])}"

    def _print_Pow(self, expr: sympy.Pow, rational: bool = False) -> str:
        base, power = expr.args
        if power == sympy.Rational(1, 2):
            return f"SQRT({self._print(base)})"
        if power.is_number and power.is_negative:
            return f"1/{self.parenthesize(sympy.Pow(base, -power), PRECEDENCE['Pow'])}"
        return f"{self._alone(base)}^{self._alone(power)}"

    def _alone(self, expr: sympy.Expr) -> str:
        """Return an expression as one piece: a cell, a function, a number without a sign, or in brackets."""
        text = str(self._print(expr))
        is_one = expr.is_Symbol or expr.is_Function or (expr.is_number and text.replace(".", "").isdigit())
        return text if is_one else f"({text})"

    def _print_atan2(self, expr: sympy.atan2) -> str:
        y, x = map(self._print, expr.args)
        return f"ATAN2({x},{y})"

    def _print_Function(self, expr: sympy.Function) -> str:
        return f"{FUNCTION_NAMES[type(expr).__name__]}({','.join(map(self._print, expr.args))})"

    _print_Abs = _print_Min = _print_Max = _print_And = _print_Or = _print_Not = _print_Function

    def _print_Piecewise(self, expr: sympy.Piecewise) -> str:
        (value, condition), *others = expr.args
        if condition is sympy.true or condition == True:  # noqa: E712 - SymPy's truth
            return str(self._print(value))
        other = self._print(sympy.Piecewise(*others, evaluate=False)) if others else "NA()"
        return f"IF({self._print(condition)},{self._print(value)},{other})"

    def _print_Relational(self, expr: sympy.Rel) -> str:
        sign = {"==": "=", "!=": "<>"}.get(expr.rel_op, expr.rel_op)
        return f"{self.parenthesize(expr.lhs, PRECEDENCE['Add'])}{sign}{self.parenthesize(expr.rhs, PRECEDENCE['Add'])}"

    def _print_BooleanTrue(self, expr: object) -> str:
        return "TRUE"

    def _print_BooleanFalse(self, expr: object) -> str:
        return "FALSE"


# The names of cells: what a spreadsheet takes as one, each once.

LIKE_A_CELL = re.compile(r"[a-z]{1,3}\d+|[rc]\d*|r\d*c\d*|true|false", re.IGNORECASE)
"""A1, XFD7, R, C, R1C1: what a spreadsheet reads as a place, and its two words for truth."""
LONGEST_NAME = 200


def cell_names(texts: Iterable[str]) -> dict[str, str]:
    """Return the name of a cell for each text: `L_OB` for itself, `A_x` for `A.x`, `_L0` for `L0`, which is a place in a sheet.

    Names that differ in small and capital letters alone are one to a spreadsheet: the second gets a number.
    """
    names: dict[str, str] = {}
    taken: set[str] = set()
    for text in texts:
        plain = re.sub(r"\W", "_", text)[:LONGEST_NAME] or "_"
        name = wanted = f"_{plain}" if plain[0].isdigit() or LIKE_A_CELL.fullmatch(plain) else plain
        count = 1
        while name.lower() in taken:
            count += 1
            name = f"{wanted}_{count}"
        taken.add(name.lower())
        names[text] = name
    return names
