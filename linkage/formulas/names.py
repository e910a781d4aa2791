"""How things are written in the papers: L_OB for the length of OB, one letter for a point, two for a vector."""

from __future__ import annotations

import re
from typing import Any, final

import sympy

from ..plan import Plan
from ..quantities import Quantity
from ..steps import Arrow, Guide
from .words import point_symbol, vector_symbol


@final
class SymbolNames:
    """The symbols of a mechanism, each thing one, and their text and LaTeX. No two things share a text."""

    def __init__(self, plan: Plan) -> None:
        self.points = sorted(plan.points, key=len, reverse=True)
        self.latex: dict[str, str] = {}
        self._texts: dict[Any, str] = {}
        self._guides = plan.of_kind(Guide)
        self._members = plan.members
        self._placed = {*plan.points, *plan.of_kind(Arrow), *self._guides}
        self._lengths = {name for name, entry in plan.table.entries.items() if entry.kind == "length"}
        quantities = plan.of_kind(Quantity)
        for name in plan.members:
            pair = self.pair(name[1:].removeprefix("_")) if name in quantities and name.startswith("L") else ()
            wanted = f"L_{''.join(pair)}" if len(pair) == 2 else name
            self._text(name, name if wanted in plan.members else wanted)

    # -- symbols ---------------------------------------------------------------------------------------

    def vector(self, name: str) -> Any:
        """Return the symbol of a point or a vector member, or of a vector named by its two points."""
        text = self._text(name if name in self._placed else ("vector", name), name, self._vector_latex(name))
        for axis in "xy":
            self.latex.setdefault(f"{text}.{axis}", self._component_latex(name, axis))
        return point_symbol(text) if name in self.points or name in self._guides else vector_symbol(text)

    def quantity(self, name: str) -> Any:
        """Return the symbol of a named quantity or a stroke, or of a design variable: the label OB is the length L_OB."""
        if name in self._lengths:
            shown = f"L_{{{self.indexed(name)}}}"
            return sympy.Symbol(self._text(("variable", name), f"L_{name}", shown), positive=True)
        text = self._text(name if name in self._members and name not in self._placed else ("variable", name), name.replace(".", "_"))
        shown = f"L_{{{self.indexed(text[2:])}}}" if text.startswith("L_") and text != name else self._scalar_latex(name)
        self.latex.setdefault(text, shown)
        return sympy.Symbol(text, real=True)

    def direction(self, guide: str) -> Any:
        """Return the symbol of a guide's direction: u_rail."""
        shown = rf"\vec{{u}}_{{{self._scalar_latex(guide)}}}"
        return vector_symbol(self._text(("direction", guide), f"u_{guide}", shown))

    def length(self, vector: str) -> Any:
        """Return the symbol of a vector's given length: L_AB."""
        return sympy.Symbol(self._text(("length", vector), f"L_{vector}", f"L_{{{self.indexed(vector)}}}"), real=True)

    def angle(self, name: str) -> Any:
        """Return the symbol of an angle that a step brings: OAB."""
        return sympy.Symbol(self._text(("angle", name), name, self._scalar_latex(name)), real=True)

    def derivative(self, symbol: Any, stroke: Any) -> Any:
        """Return the symbol of a derivative by a stroke: dOAB/dS."""
        text = self._text(("derivative", symbol, stroke), f"d{symbol.name}/d{stroke.name}")
        for part in ("", ".x", ".y"):
            shown = self.latex.get(symbol.name + part, symbol.name)
            self.latex[text + part] = rf"\frac{{d{shown}}}{{d{self.latex.get(stroke.name, stroke.name)}}}"
        return type(symbol)(text, 2, 1) if symbol.is_Matrix else sympy.Symbol(text, real=True)

    def stretching(self, vector: Any, stroke: Any) -> Any:
        """Return the symbol of the derivative of a vector's length: d|EC|/dS."""
        shown, by = (self.latex.get(each.name, each.name) for each in (vector, stroke))
        text = self._text(("stretching", vector, stroke), f"d|{vector.name}|/d{stroke.name}")
        self.latex[text] = rf"\frac{{d\left|{shown}\right|}}{{d{by}}}"
        return sympy.Symbol(text, real=True)

    def ratio(self, point: str) -> Any:
        """Return the symbol of a transfer ratio: I_G for dG_y/dS."""
        return sympy.Symbol(self._text(("ratio", point), f"I_{point}", f"I_{{{self._scalar_latex(point)}}}"), real=True)

    def force(self, name: str) -> Any:
        """Return the symbol of a scalar that the equations of forces bring: P_load, Q_S, T_lift."""
        return sympy.Symbol(self._text(("force", name), name, self._scalar_latex(name)), real=True)

    def force_vector(self, name: str) -> Any:
        """Return the symbol of a force as a vector: F_pull."""
        text = self._text(("force vector", name), name, self._vector_latex(name))
        for axis in "xy":
            self.latex.setdefault(f"{text}.{axis}", self._component_latex(name, axis))
        return vector_symbol(text)

    def _text(self, key: Any, wanted: str, latex: str = "") -> str:
        """Return the text of a thing; a stroke is added where another thing has it already."""
        if key not in self._texts:
            while wanted in self._texts.values():
                wanted, latex = f"{wanted}'", f"{latex}'"
            self._texts[key] = wanted
        text = self._texts[key]
        if latex:
            self.latex.setdefault(text, latex)
        return text

    # -- LaTeX -----------------------------------------------------------------------------------------

    def pair(self, text: str) -> tuple[str, ...]:
        """Return the points whose names make up a text, two or three of them; none where it is not one."""
        return next((found for count in (2, 3) if (found := self._split(text, count))), ())

    def _split(self, text: str, count: int) -> tuple[str, ...]:
        if count == 0:
            return ()
        for point in self.points:
            if text.startswith(point):
                rest = self._split(text[len(point) :], count - 1)
                if len(rest) == count - 1 and (rest or text == point):
                    return (point, *rest)
        return ()

    def indexed(self, text: str) -> str:
        """Return a joined name in LaTeX: OG1 is O G_1."""
        pair = self.pair(text) if any(each.isdigit() or each == "_" for each in text) else ()
        return " ".join(map(self._scalar_latex, pair)) if pair else escaped_latex(text)

    def _vector_latex(self, name: str) -> str:
        if len(self.pair(name)) == 2 and name not in self.points:
            return rf"\overrightarrow{{{self.indexed(name)}}}"
        head, _, tail = _letters_and_index(name)
        arrow = rf"\vec{{{head}}}" if len(head) == 1 else rf"\vec{{\mathit{{{head}}}}}"
        return f"{arrow}_{{{tail}}}" if tail else arrow

    def _component_latex(self, name: str, axis: str) -> str:
        if len(self.pair(name)) == 2 and name not in self.points:
            return f"{self._vector_latex(name)}_{{{axis}}}"
        head, _, tail = _letters_and_index(name)
        return f"{head}_{{{tail},{axis}}}" if tail else f"{head}_{{{axis}}}"

    def _scalar_latex(self, name: str) -> str:
        if len(self.pair(name)) == 3 and name not in self.points:
            return rf"\angle {self.indexed(name)}"
        head, greek, tail = _letters_and_index(name)
        shown = greek or (head if len(head) == 1 else rf"\mathit{{{head}}}")
        return f"{shown}_{{{tail}}}" if tail else shown


def _letters_and_index(name: str) -> tuple[str, str, str]:
    """Return a name's letters, the same as a Greek letter where they spell one, and its index: L0, k_m, rail.x; M_ has the index _."""
    match = re.fullmatch(r"([^\W\d_]+)(?:[_.](?=.*[^_]))?(\w*?)(_*)", name)
    head, tail, last = match.groups() if match else (name, "", "")
    greek = sympy.latex(sympy.Symbol(head))
    index = tail.replace("_", ",") + escaped_latex(last)
    return escaped_latex(head), greek if re.fullmatch(r"\\[A-Za-z]+", greek) else "", index


def escaped_latex(text: str) -> str:
    """Return a name whose underscores mean nothing in LaTeX."""
    return text.replace("_", r"\_")
