"""One numbered equation."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from .printing import Latex, Text, plain_number
from .units import Unit


@dataclass(frozen=True, eq=False)
class Equation:
    """`lhs = rhs`, both SymPy: a scalar symbol, or a matrix symbol of shape (2, 1) for a point or a vector.

    `rhs` uses the words of `linkage.equations.words` (TurnV, TurnVL, Tcos, ...); `linkage.equations.explicit(rhs)`
    writes it out in elementary functions. `follows` are the strokes that a length is a function of.
    """

    number: int
    lhs: Any
    rhs: Any
    unit: Unit
    follows: tuple[Any, ...] = ()

    @property
    def name(self) -> str:
        """The text of the left side: `L_AB`, `OAB`, `B`."""
        return str(Text().doprint(self.lhs))

    @property
    def symbols(self) -> tuple[Any, ...]:
        """The SymPy symbols of the right side, by name."""
        return tuple(sorted(self.rhs.free_symbols, key=str))

    def __str__(self) -> str:
        """Return the equation as text, without its number: `L_AB(S) = L0 + S`."""
        text = Text()
        arguments = f"({', '.join(each.name for each in self.follows)})" if self.follows else ""
        return f"{self.name}{arguments} = {text.doprint(self.rhs)}"

    def latex(self, words: Mapping[str, str]) -> str:
        """Return the equation as LaTeX, without its number; `words` is the LaTeX of the symbols."""
        latex = Latex(words)
        arguments = rf"\left({', '.join(map(latex.doprint, self.follows))}\right)" if self.follows else ""
        return f"{latex.doprint(self.lhs)}{arguments} &= {latex.doprint(self.rhs)}"

    def filled(self, values: Mapping[str, str]) -> str:
        """Return the equation with the numbers put in, and the result with its unit."""
        result = values[self.name]
        unit = "" if result.endswith(" deg") or not self.unit.text else f" {self.unit.text}"
        steps = [str(self), Text(values).doprint(self.rhs), result]
        kept = [step for place, step in enumerate(steps) if place == 0 or not f" = {steps[place - 1]}".endswith(f" = {step}")]
        return " = ".join(kept) + unit

    def __repr__(self) -> str:
        return f"({self.number}) {self}"


def shown(value: Any, unit: Unit) -> str:
    """Return a value as it stands in an equation: a pair, an angle in degrees, a plain number [SI or its own unit]."""
    if np.ndim(value):
        return f"({', '.join(plain_number(float(part) / unit.factor) for part in value)})"
    return plain_number(float(value) / unit.factor) + (" deg" if unit.text == "deg" else "")
