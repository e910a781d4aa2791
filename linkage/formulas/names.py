"""How things are written in the papers: L_OB for the length of OB, one letter for a point, two for a vector."""

from __future__ import annotations

import re
from functools import lru_cache
from typing import Self

import sympy
from sympy.matrices.expressions.matexpr import MatrixElement, MatrixExpr

from ..plan import Part, Plan
from ..quantities import Quantity
from ..steps import Arrow, Guide

# The vector method's words as SymPy expressions: TurnV, TurnVL, Tcos, lengths and directions of vectors.
#
# Vectors are SymPy matrix symbols of shape (2, 1). `doit()` writes a word out in components and elementary functions.
# Source: Dyuzhev, Kotov, Chuprynin, "Universality of the hitch of the power vehicle UES-2-250A" (Minsk, 2008).


def vector_symbol(name: str) -> sympy.MatrixSymbol:
    """Return the symbol of a vector or a position."""
    return sympy.MatrixSymbol(name, 2, 1)


class PointSymbol(sympy.MatrixSymbol):  # type: ignore[misc]
    """The symbol of a position: it comes first in a sum."""


def components_of(vector: MatrixExpr) -> tuple[sympy.Expr, sympy.Expr]:
    """Return both components of a vector, written out."""
    return vector[0, 0].doit(), vector[1, 0].doit()


class TurnV(MatrixExpr):  # type: ignore[misc]
    """The vector V turned by the angle a [rad], counter-clockwise positive."""

    def __new__(cls, vector: MatrixExpr, angle: sympy.Expr) -> MatrixExpr:
        return super().__new__(cls, vector, sympy.sympify(angle))

    @property
    def shape(self) -> tuple[int, int]:
        return (2, 1)

    @property
    def scale(self) -> sympy.Expr:
        """The factor to the length."""
        return sympy.S.One

    def _entry(self, i: sympy.Integer, j: sympy.Integer, **options: object) -> sympy.Expr:
        (x, y), angle = components_of(self.args[0]), self.args[1].doit()
        cos, sin = sympy.cos(angle), sympy.sin(angle)
        return self.scale * (x * cos - y * sin if i == 0 else x * sin + y * cos)

    def doit(self, **options: object) -> Self:
        return self


class TurnVL(TurnV):
    """The vector V turned by the angle a [rad] and scaled to the length L [m]: TurnV(V, a) L/|V|."""

    def __new__(cls, vector: MatrixExpr, angle: sympy.Expr, length: sympy.Expr) -> MatrixExpr:
        return MatrixExpr.__new__(cls, vector, sympy.sympify(angle), sympy.sympify(length))

    @property
    def scale(self) -> sympy.Expr:
        return self.args[2].doit() / Norm(self.args[0]).doit()


class Tcos(sympy.Function):  # type: ignore[misc]
    """The angle between the sides L1 and L2 of a triangle, opposite L3 [rad], 0 to pi: the cosine rule."""

    nargs = 3
    is_real = True

    def doit(self, **options: object) -> sympy.Expr:
        a, b, c = (side.doit() for side in self.args)
        return sympy.acos((a**2 + b**2 - c**2) / (2 * a * b))


class VectorNumber(sympy.Expr):  # type: ignore[misc]
    """A real number read off vectors, kept as a word until `doit`."""

    is_real = True
    is_commutative = True

    def __new__(cls, *args: sympy.Basic) -> sympy.Expr:
        return super().__new__(cls, *map(sympy.sympify, args))


class Norm(VectorNumber):
    """The length |V| [m]."""

    is_nonnegative = True

    def doit(self, **options: object) -> sympy.Expr:
        x, y = components_of(self.args[0])
        return sympy.sqrt(x**2 + y**2)


class Direction(VectorNumber):
    """The direction of V [rad], counter-clockwise from the x axis."""

    def doit(self, **options: object) -> sympy.Expr:
        x, y = components_of(self.args[0])
        return sympy.atan2(y, x)


class Dot(VectorNumber):
    """The scalar product of two vectors [m2]."""

    def doit(self, **options: object) -> sympy.Expr:
        (a, b), (c, d) = map(components_of, self.args)
        return a * c + b * d


class Cross(VectorNumber):
    """The z component of the vector product of two vectors [m2]."""

    def doit(self, **options: object) -> sympy.Expr:
        (a, b), (c, d) = map(components_of, self.args)
        return a * d - b * c


class Deg(VectorNumber):
    """An angle written in degrees."""

    is_number = True

    def doit(self, **options: object) -> sympy.Expr:
        return self.args[0] * sympy.pi / 180

    def _eval_evalf(self, prec: int) -> sympy.Expr:
        return self.doit()._eval_evalf(prec)


def explicit(expr: sympy.Basic) -> tuple[sympy.Expr, ...]:
    """Return an expression in scalars and elementary functions: one for a number, two for a vector.

    A vector's components are the symbols `AB.x` and `AB.y`.
    """
    entries = components_of(expr) if getattr(expr, "shape", None) == (2, 1) else (expr.doit(),)
    parts = set().union(*(each.atoms(MatrixElement) for each in entries))
    plain = {part: plain_symbols(part.parent.name)[int(part.i)] for part in parts}
    return tuple(each.xreplace(plain) for each in entries)


@lru_cache(maxsize=4096)
def plain_symbols(vector: str) -> tuple[sympy.Symbol, sympy.Symbol]:
    """Return the symbols of a vector's components: `AB.x` and `AB.y`."""
    return sympy.Symbol(f"{vector}.x", real=True), sympy.Symbol(f"{vector}.y", real=True)


class SymbolNames:
    """The symbols of a mechanism, each thing one, and their text and LaTeX. No two things share a text."""

    def __init__(self, plan: Plan) -> None:
        self.points = sorted(plan.points, key=len, reverse=True)
        self._parts = plan.of_kind(Part)
        self._letters = {name: sorted(part.plan.points, key=len, reverse=True) for name, part in self._parts.items()}
        self._fixed = {name for name in plan.ground if "." not in name}
        self.owners: dict[str, str] = {}
        """The parts that symbols are of, by their texts; "" for those of the machine itself."""
        self.latex: dict[str, str] = {}
        self._texts: dict[object, str] = {}
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

    def vector(self, name: str) -> sympy.MatrixSymbol:
        """Return the symbol of a point or a vector member, or of a vector named by its two points."""
        text = self._vector_text(name if name in self._placed else ("vector", name), name)
        return PointSymbol(text, 2, 1) if name in self.points or name in self._guides else vector_symbol(text)

    def quantity(self, name: str) -> sympy.Symbol:
        """Return the symbol of a named quantity or a stroke, or of a design variable: the label OB is the length L_OB."""
        if name in self._lengths:
            shown = self._length_latex(name)
            return sympy.Symbol(self._text(("variable", name), f"L_{name}", shown), positive=True)
        point, _, axis = name.rpartition(".")
        if point in self._placed and point not in self._fixed and axis in ("x", "y") and ("." in point or point in self.points):
            # not a component of the point, which is where it stands in the whole
            own = self._own_latex(*self.owned(point))
            return sympy.Symbol(self._text(("variable", name), f"{axis}_{point}", f"{axis}_{{{own}}}{self._raised(point)}"), real=True)
        owner, inner = self.owned(name)
        wanted = f"{owner}.{inner.replace('.', '_')}" if owner else name.replace(".", "_")
        text = self._text(name if name in self._members and name not in self._placed else ("variable", name), wanted)
        shown = f"L_{{{self.indexed(text[2:])}}}" if text.startswith("L_") and text != name else self._scalar_latex(name)
        self.latex.setdefault(text, shown)
        return sympy.Symbol(text, real=True)

    def direction_symbol(self, guide: str) -> sympy.MatrixSymbol:
        """Return the symbol of a guide's direction: u_rail."""
        shown = rf"\vec{{u}}_{{{self._scalar_latex(guide)}}}"
        return vector_symbol(self._text(("direction", guide), f"u_{guide}", shown))

    def length(self, vector: str) -> sympy.Symbol:
        """Return the symbol of a vector's given length: L_AB."""
        return sympy.Symbol(self._text(("length", vector), f"L_{vector}", self._length_latex(vector)), real=True)

    def derivative(self, symbol: sympy.Symbol | sympy.MatrixSymbol, stroke: sympy.Symbol) -> sympy.Symbol | sympy.MatrixSymbol:
        """Return the symbol of a derivative by a stroke: dOAB/dS."""
        text = self._text(("derivative", symbol, stroke), f"d{symbol.name}/d{stroke.name}")
        for part in ("", ".x", ".y"):
            shown = self.latex.get(symbol.name + part, symbol.name)
            self.latex[text + part] = rf"\frac{{d{shown}}}{{d{self.latex.get(stroke.name, stroke.name)}}}"
        return type(symbol)(text, 2, 1) if symbol.is_Matrix else sympy.Symbol(text, real=True)

    def stretching(self, vector: sympy.MatrixSymbol, stroke: sympy.Symbol) -> sympy.Symbol:
        """Return the symbol of the derivative of a vector's length: d|EC|/dS."""
        shown, by = (self.latex.get(each.name, each.name) for each in (vector, stroke))
        text = self._text(("stretching", vector, stroke), f"d|{vector.name}|/d{stroke.name}")
        self.latex[text] = rf"\frac{{d\left|{shown}\right|}}{{d{by}}}"
        return sympy.Symbol(text, real=True)

    def ratio(self, point: str) -> sympy.Symbol:
        """Return the symbol of a transfer ratio: I_G for dG_y/dS."""
        return sympy.Symbol(self._text(("ratio", point), f"I_{point}", f"I_{{{self._scalar_latex(point)}}}"), real=True)

    def scalar(self, name: str, kind: str = "force") -> sympy.Symbol:
        """Return the symbol of a scalar that the equations of forces bring: P_load, Q_S, T_lift; or of an "angle" of a step: OAB."""
        return sympy.Symbol(self._text((kind, name), name, self._scalar_latex(name)), real=True)

    def force_vector(self, name: str) -> sympy.MatrixSymbol:
        """Return the symbol of a force as a vector: F_pull."""
        return vector_symbol(self._vector_text(("force vector", name), name))

    def _vector_text(self, key: object, name: str) -> str:
        """Return the text of a vector, whose LaTeX and that of its components are kept."""
        owner, own = self.owned(name)
        head, _, tail = _letters_and_index(own)
        raised, is_pair = self._raised(name), len(self.pair(own, owner)) == 2 and name not in self.points
        if is_pair:
            shown = rf"\overrightarrow{{{self.indexed(name)}}}{raised}"
        else:
            arrow = rf"\vec{{{head}}}" if len(head) == 1 else rf"\vec{{\mathit{{{head}}}}}"
            shown = (f"{arrow}_{{{tail}}}" if tail else arrow) + raised
        text = self._text(key, name, shown)
        for axis in "xy":
            part = f"{shown}_{{{axis}}}" if is_pair else f"{head}_{{{f'{tail},' if tail else ''}{axis}}}{raised}"
            self.latex.setdefault(f"{text}.{axis}", part)
        return text

    def _text(self, key: object, wanted: str, latex: str = "") -> str:
        """Return the text of a thing; a stroke is added where another thing has it already."""
        if key not in self._texts:
            while wanted in self._texts.values():
                wanted, latex = f"{wanted}'", f"{{{latex}}}'" if "^" in latex else f"{latex}'"
            self._texts[key] = wanted
            name = key[1] if isinstance(key, tuple) else key  # a symbol's own part is known by its text
            self.owners[wanted] = self.owned(name)[0] if isinstance(name, str) else self.owners.get(getattr(name, "name", ""), "")
        text = self._texts[key]
        if latex:
            self.latex.setdefault(text, latex)
        return text

    # -- parts -----------------------------------------------------------------------------------------

    def owned(self, name: str) -> tuple[str, str]:
        """Return the part that a name is of, "" for the machine itself, and its name there: `upper.AB` is AB, `T_upper.ram` T_ram."""
        for sign, rest in (("", name), name.partition("_")[::2]):
            owner = rest
            while "." in owner:
                owner = owner.rpartition(".")[0]
                if owner in self._parts:
                    return owner, f"{sign}_{rest[len(owner) + 1 :]}" if sign else rest[len(owner) + 1 :]
        return "", name

    def _raised(self, name: str) -> str:
        """Return the part that a name is of as an exponent in LaTeX."""
        owner, _ = self.owned(name)
        return rf"^{{\mathrm{{{escaped_latex(owner)}}}}}" if owner else ""

    # -- LaTeX -----------------------------------------------------------------------------------------

    def pair(self, text: str, owner: str = "") -> tuple[str, ...]:
        """Return the points whose names make up a text, two or three of them, those of a part by its own; none where it is not one."""
        return next((found for count in (2, 3) if (found := self._split(text, count, owner))), ())

    def _split(self, text: str, count: int, owner: str) -> tuple[str, ...]:
        if count == 0:
            return ()
        for point in self._letters[owner] if owner else self.points:
            word = point.replace(".", "_")
            if text.startswith(word):
                rest = self._split(text[len(word) :], count - 1, owner)
                if len(rest) == count - 1 and (rest or text == word):
                    return (point, *rest)
        return ()

    def indexed(self, name: str) -> str:
        """Return a joined name in LaTeX: OG1 is O G_1; of a part without the part's name."""
        owner, text = self.owned(name)
        pair = self.pair(text, owner) if any(each.isdigit() or each == "_" for each in text) else ()
        letter = self._own_scalar if owner else self._scalar_latex
        return " ".join(map(letter, pair)) if pair else escaped_latex(text)

    def _length_latex(self, name: str) -> str:
        return f"L_{{{self.indexed(name)}}}{self._raised(name)}"

    def _scalar_latex(self, name: str) -> str:
        return self._own_latex(*self.owned(name)) + self._raised(name)

    def _own_latex(self, owner: str, own: str) -> str:
        """Return a scalar in LaTeX by the name that it has in its part."""
        if len(self.pair(own, owner)) == 3 and (owner or own not in self.points):
            return rf"\angle {self.indexed(f'{owner}.{own}' if owner else own)}"
        return self._own_scalar(own)

    @staticmethod
    def _own_scalar(own: str) -> str:
        head, greek, tail = _letters_and_index(own)
        shown = greek or (head if len(head) == 1 else rf"\mathit{{{head}}}")
        return f"{shown}_{{{tail}}}" if tail else shown


def _letters_and_index(name: str) -> tuple[str, str, str]:
    """Return a name's letters, the same as a Greek letter where they spell one, and its index: L0, k_m, rail.x; M_ has the index _.

    Words that underscores join stay one: `lift_line.back_pressure`.
    """
    match = re.fullmatch(r"([a-z]{2,}(?:_[a-z]{2,})+(?=\.)|[^\W\d_]+)(?:[_.](?=.*[^_]))?([\w.]*?)(_*)", name)
    head, tail, last = match.groups() if match else (name, "", "")
    greek = sympy.latex(sympy.Symbol(head))
    parts = re.split(r"\.|(?<![a-z]{2})_|_(?![a-z]{2})", tail)
    index = ",".join(rf"\mathit{{{escaped_latex(each)}}}" if "_" in each else each for each in parts) + escaped_latex(last)
    return escaped_latex(head), greek if re.fullmatch(r"\\[A-Za-z]+", greek) else "", index


def escaped_latex(text: str) -> str:
    """Return a name whose underscores mean nothing in LaTeX."""
    return text.replace("_", r"\_")
