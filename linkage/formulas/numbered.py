"""The numbered equations of a mechanism, as text, LaTeX, SymPy and numbers."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from textwrap import wrap
from types import MappingProxyType
from typing import Any, NamedTuple, TypeAlias, overload

import mpmath
import numpy as np
import sympy

from ..errors import DefinitionError, FormerName, ensure, is_class_of, known_name, require, require_type, require_whole
from ..frozen import immutable
from ..language import translated
from ..loads import Case
from ..mechanism import Mechanism, declared, require_mechanism
from ..motion.requests import stroke_of
from ..plan import Part
from ..shown import Shown
from ..statics.applied import case_of
from ..units import SI, UNITS, factor, shown_in
from ..vectors import Numbers
from .arithmetic import ValuesOf
from .forces import WORDS, ForceLines, LineDerivatives, lines_needed, symbols_behind
from .listing import LENGTH, X_AXIS, GivenNumber, Listing, ListingLine, Unit
from .names import Cross, Deg, Direction, Dot, Tcos, TurnV, TurnVL, escaped_latex, explicit, plain_symbols
from .printing import Latex, Text, number_latex, plain_number


def equations(
    machine: Mechanism | type[Mechanism],
    *,
    start: int = 1,
    numbers: bool = False,
    at: Mapping[str, float] | None = None,
    ratio: str | Sequence[str] = (),
    wrt: str | None = None,
    forces: bool = False,
    case: Case = None,
) -> Equations:
    """Return a mechanism's equations, numbered from `start`, in the vector method's primitives: text, LaTeX, SymPy and numbers.

    `print(equations(hitch))` lists them. `numbers` fills the numbers in at the pose `at` (default: the start of each stroke). `ratio`
    names points and outputs whose derivatives by the stroke `wrt` are added; `forces` adds those of the loads, the driving forces by
    virtual work, and what cylinders and circuits have, all without friction. `case` is their load case, else the machine's own
    loads act. Source of notation and order: Dyuzhev, Kotov, Chuprynin, "Universality of the hitch of the power vehicle UES-2-250A"
    (Minsk, 2008), equations (4) to (27).

    Parameters
    ----------
    machine : Mechanism or type
        The design, or its class.
    start : int
        The number of the first equation.
    numbers : bool
        Whether numbers are filled in.
    at : mapping, optional
        The pose of the numbers, strokes by name [m or rad].
    ratio : str or sequence of str
        Points and outputs whose derivatives are added.
    wrt : str, optional
        The stroke of the derivatives.
    forces : bool
        Whether the equations of forces are added.
    case : LoadCase or str, optional
        The load case of the forces; by default the machine's own loads act.

    Returns
    -------
    Equations
        The equations, printable.
    """
    design = require_mechanism(machine() if is_class_of(machine, Mechanism) else machine)
    require_whole("start", start, "the first equation's number is expected, a whole number from 1 on", least=1)
    check_pose(design, at)
    targets = [ratio] if isinstance(ratio, str) else ratio
    require_type("ratio", targets, (list, tuple), 'the name of a point or an output is expected, ratio="G", or a list of them', of=str)
    for flag, value in (("numbers", numbers), ("forces", forces)):
        require(not np.ndim(value), flag, value, "True or False is expected")
    if wrt is not None:
        known_name("Stroke", wrt, design.plan.strokes, design.plan.title)
    listing = Listing(design.plan)
    listing.write_members(declared(type(design)))
    lines = by_parts(listing.lines, listing)
    for target in targets:
        added = differentiated(design, listing, target, wrt)
        lines += by_parts([line for line in added if line.lhs not in {each.lhs for each in lines}], listing)
    require(case is None or forces, "case", case, "a load case is of the equations of forces; give forces=True too")
    written = ForceLines(design, listing, case) if forces else None
    if written is not None:
        count = len(listing.lines)
        written.write_forces()
        more = [line for line in (*listing.lines[count:], *written.lines) if line.lhs not in {each.lhs for each in lines}]
        lines += by_parts(more, listing)
    return Equations(design, lines, listing, start, {} if numbers and at is None else at if numbers or at else None, written)


def by_parts(lines: Sequence[ListingLine], listing: Listing) -> list[ListingLine]:
    """Return lines with those of one part behind each other as far as their dependencies allow; unchanged without parts.

    A part whose lines can all be written comes first, the machine's own lines last.
    """
    if not listing.plan.of_kind(Part):
        return list(lines)
    made = [{line.lhs} if hasattr(line.lhs, "name") else set() for line in lines]
    every = set[sympy.Basic]().union(*made)
    needs = [(line.rhs.free_symbols | line.lhs.free_symbols) & every - own for line, own in zip(lines, made, strict=True)]
    owners = [part_of_line(line, listing) for line in lines]
    left, found, known = list(range(len(lines))), list[int](), set[sympy.Basic]()

    def ready(ours: Sequence[int]) -> list[int]:
        """Return those of a part's lines that can be written now, one behind the other."""
        have, taken = set(known), list[int]()
        for place in ours:
            if needs[place] <= have:
                taken.append(place)
                have |= made[place]
        return taken

    while left:
        owned: dict[str, list[int]] = {}
        for place in left:
            owned.setdefault(owners[place], []).append(place)
        groups = [places for _, places in sorted(owned.items(), key=lambda each: not each[0])]
        choices = [ready(places) for places in groups]
        whole = (taken for taken, places in zip(choices, groups, strict=True) if len(taken) == len(places))
        taken = next(whole, None) or next(filter(None, choices), left[:1])
        known.update(*(made[place] for place in taken))
        found += taken
        left = [place for place in left if place not in taken]
    return [lines[place] for place in found]


def part_of_line(line: ListingLine, listing: Listing) -> str:
    """Return the part whose line it is; "" for the machine itself, whose are those of several parts, too."""
    owners = {listing.names.owners.get(each.name, "") for each in ([line.lhs] if hasattr(line.lhs, "name") else line.lhs.free_symbols)}
    return owners.pop() if len(owners) == 1 else ""


def check_pose(design: Mechanism, at: object) -> None:
    """Raise DefinitionError for anything but a pose: strokes by name, or None."""
    if at is not None:
        require_type(f"{design.plan.title}: at", at, Mapping, "values of strokes by name are expected, such as at=dict(S=0.1)")


def differentiated(design: Mechanism, listing: Listing, target: str, wrt: str | None) -> list[ListingLine]:
    """Return the lines that lead to a target's transfer ratio, of a point I_G = dG_y/dS; DefinitionError for a name without one."""
    plan, names, known = design.plan, listing.names, members_with_lines(listing)
    known_name("Point or output", target, known, where=plan.title)
    name, symbol = stroke_of(plan, wrt), known[target]
    if {names.vector(pin) for pin in listing.unknowns} & symbols_behind(listing.lines, symbol):
        pins = " ".join(listing.unknowns)
        raise DefinitionError(f"{plan.title}: {target} hangs on pins found together ({pins}): no chain of derivatives; take motion.ratio.")
    stroke = names.quantity(name)
    chain = LineDerivatives(stroke, listing.units[name], names).lines(lines_needed(listing.lines, [symbol]))
    if not chain or chain[-1].lhs != names.derivative(symbol, stroke) or not symbol.is_Matrix:
        return chain
    last = chain[-1]
    return [*chain, ListingLine(names.ratio(symbol.name), last.lhs[1, 0], last.unit)]


def members_with_lines(listing: Listing) -> dict[str, sympy.Basic]:
    """Return the members that have a line, by their names in the class."""
    lines = {line.lhs for line in listing.lines}
    symbols = {name: listing.symbol_of(name) for name in listing.plan.valued_members}
    return {name: symbol for name, symbol in symbols.items() if symbol in lines or name in listing.unknowns}


@immutable
class Equation:
    """`lhs = rhs`, both SymPy: a scalar symbol, or a matrix symbol of shape (2, 1) for a point or a vector.

    `rhs` uses the words of `linkage.formulas.names` (TurnV, TurnVL, Tcos, ...); `linkage.formulas.explicit(rhs)`
    writes it out in elementary functions. `follows` are the strokes that a length is a function of.
    """

    number: int
    lhs: sympy.Basic
    rhs: sympy.Basic
    unit: Unit
    follows: tuple[sympy.Symbol, ...] = ()
    part: str = ""
    """The part of the machine whose equation it is."""

    @property
    def name(self) -> str:
        """The text of the left side: `L_AB`, `OAB`, `B`."""
        return str(Text().doprint(self.lhs))

    @property
    def symbols(self) -> tuple[sympy.Basic, ...]:
        """The SymPy symbols of the right side, by name."""
        return tuple(sorted(self.rhs.free_symbols, key=str))

    def __str__(self) -> str:
        """Return the equation as text, without its number: `L_AB(S) = L0 + S`."""
        arguments = f"({', '.join(each.name for each in self.follows)})" if self.follows else ""
        return f"{self.name}{arguments} = {Text().doprint(self.rhs)}"

    def latex(self, words: Mapping[str, str]) -> str:
        """Return the equation as LaTeX, without its number; `words` is the LaTeX of the symbols."""
        latex = Latex(words)
        return f"{self._left(latex)} &= {latex.doprint(self.rhs)}"

    def _left(self, latex: Latex) -> str:
        arguments = rf"\left({', '.join(map(latex.doprint, self.follows))}\right)" if self.follows else ""
        return f"{latex.doprint(self.lhs)}{arguments}"

    def filled(self, values: Mapping[str, str], shown: Mapping[str, str] = MappingProxyType({})) -> str:
        """Return the equation with the numbers put in, and the result with its unit: SI, and as it is `shown` where that is another."""
        result = values[self.name]
        unit = "" if result.endswith(" deg") or not self.unit.si else f" {self.unit.si}"
        steps = [str(self), Text(values).doprint(self.rhs), result]
        kept = [step for place, step in enumerate(steps) if place == 0 or not f" = {steps[place - 1]}".endswith(f" = {step}")]
        own = shown.get(self.name, "") if self.unit.si_factor != self.unit.shown_factor else ""
        return " = ".join(kept) + unit + (f" = {own}" if own else "")

    def sheet(self, words: Mapping[str, str], values: Mapping[str, str], shown: Mapping[str, str]) -> SheetLine:
        """Return the equation as a calculation sheet has it, in LaTeX: symbol, formula, numbers, result; see `filled`."""
        unit, latex = self.unit, Latex(words)
        formula, numbers, result = latex.doprint(self.rhs), Latex(words, values).doprint(self.rhs), number_latex(values[self.name])
        own = shown.get(self.name, "") if unit.si_factor != unit.shown_factor else ""
        results = [f"{result}{'' if unit.text == 'deg' or not unit.si else f' {unit_latex(unit.si)}'}"]
        if own:
            value, _, own_unit = own.rpartition(" ") if not own.endswith(")") else (own, "", "")
            results.append(number_latex(own) if own_unit == "deg" else number_latex(value) + (unit_latex(own_unit) if own_unit else ""))
        numbers = "" if numbers in (formula, result) else numbers
        return SheetLine(self.number, self._left(latex), formula, numbers, tuple(results))

    def __repr__(self) -> str:
        return f"({self.number}) {self}"


class SheetLine(NamedTuple):
    """An equation with its numbers, in LaTeX: `symbol = formula = numbers = results`; `numbers` is empty where it says nothing new.

    The results have their units; the second, where there is one, is in the unit the quantity is shown in.
    """

    number: int
    symbol: str
    formula: str
    numbers: str
    results: tuple[str, ...]
    heading: str = ""
    """The part of the machine that begins with it."""

    @property
    def steps(self) -> tuple[str, ...]:
        """The terms between the signs of equality, without repetition."""
        first = self.results[0]
        kept = [self.symbol, self.formula, *([self.numbers] if self.numbers else []), *self.results]
        return tuple(step for place, step in enumerate(kept) if place != 1 or step != first)


def unit_latex(unit: str) -> str:
    r"""Return a unit as LaTeX, in the language that is spoken: `\,\mathrm{N}`, `\,\mathrm{m}^{2}`."""
    text = re.sub(r"([^\W\d_])(\d)", r"\1}^{\2}\\mathrm{", translated(unit.replace("kgf_cm2", "kgf/cm2")))
    return rf"\,\mathrm{{{text}}}".replace(r"\mathrm{}", "")


class Equations(Sequence[Equation], Shown):
    """The equations of one design, in the vector method's order; `print` shows them numbered.

    Index by place or by name: `equations(hitch)["OAB"].rhs`.
    """

    def __init__(
        self,
        machine: Mechanism,
        lines: Sequence[ListingLine],
        listing: Listing,
        start: int,
        poses: Mapping[str, float] | None,
        forces: ForceLines | None = None,
    ) -> None:
        self.machine, self._listing, self._lines, self._poses, self._forces = machine, listing, tuple(lines), poses, forces
        strokes = [listing.names.quantity(name) for name in machine.plan.strokes]
        items: list[Equation] = []
        for number, line in enumerate(lines, start):
            is_own = line.lhs.is_Symbol and "/" not in line.lhs.name  # a scalar's own formula, which may name strokes: L_AB(S)
            follows = tuple(stroke for stroke in strokes if is_own and stroke in line.rhs.free_symbols)
            items.append(Equation(number, line.lhs, line.rhs, line.unit, follows, part_of_line(line, listing)))
        self._items = tuple(items)

    def __len__(self) -> int:
        return len(self._items)

    def __iter__(self) -> Iterator[Equation]:
        return iter(self._items)

    @overload
    def __getitem__(self, place: int | str) -> Equation: ...
    @overload
    def __getitem__(self, place: slice) -> tuple[Equation, ...]: ...
    def __getitem__(self, place: int | str | slice) -> Equation | tuple[Equation, ...]:
        """Return an equation by its place or its name, or several of them by a slice."""
        if not isinstance(place, str):
            return self._items[place]
        found = {each.name: each for each in self._items}
        known_name("Equation", place, found, where=self.machine.plan.title)
        return found[place]

    @property
    def symbols(self) -> dict[str, sympy.Basic]:
        """Every SymPy symbol by its text: the given ones, then the left sides."""
        given = {symbol.name: symbol for each in self._items for symbol in each.symbols}
        return given | {each.name: each.lhs for each in self._items if each.lhs.is_Symbol or each.lhs.is_Matrix}

    @property
    def headings(self) -> dict[int, str]:
        """The headings over the equations that begin a part of the machine, by their numbers: `lower (Arm)`; none without parts."""
        titles = self.part_titles
        before = [None, *(each.part for each in self._items)]
        begun = [each for each, last in zip(self._items, before, strict=False) if each.part != last]
        return {each.number: titles[each.part] for each in begun} if titles else {}

    @property
    def part_titles(self) -> dict[str, str]:
        """The heading of each part, `lower (Arm)`, `arm` of one that is called as its class, the machine's by ""; none without parts."""
        parts = {name: part.plan.heading for name, part in self.machine.plan.of_kind(Part).items()}
        named = {name: name if kind.lower() == name.rpartition(".")[2].lower() else f"{name} ({kind})" for name, kind in parts.items()}
        return {"": self.machine.plan.heading} | named if parts else {}

    # -- numbers ---------------------------------------------------------------------------------------

    def values(self, at: Mapping[str, Numbers] | None = None, digits: int | None = None) -> dict[str, Any]:
        """Return every left side's value [SI] by name: a number, a pair for a vector.

        `at` are strokes, numbers or arrays; those not named are at their start. With `digits` the values are
        SymPy numbers of so many digits, from the dimensions as decimals. Raises AssemblyError where the pose cannot be assembled.
        """
        if digits is not None:
            require_whole("digits", digits, f"a whole number of digits is expected, 1 to {MOST_DIGITS}", least=1, most=MOST_DIGITS)
        found = evaluated(self._lines, self._inputs(at), digits)
        return {line.name: found[line.lhs] for line in self._lines}

    def _pose(self, at: Mapping[str, Numbers] | None) -> dict[str, Numbers]:
        strokes = self.machine.plan.strokes
        check_pose(self.machine, at)
        for name in at or {}:
            known_name("Stroke", name, strokes, self.machine.plan.title)
        return {name: stroke.start for name, stroke in strokes.items()} | dict(at or {})

    def _inputs(self, at: Mapping[str, Numbers] | None, unreachable: str = "raise") -> dict[sympy.Symbol, Any]:
        """Return the plain symbols of everything given, with their values [SI]."""
        pose, names = self._pose(at), self._listing.names
        motion = self.machine.at(unreachable=unreachable, **pose)
        ensure(not motion._design_shape, f"{self.machine.plan.title}: its equations take one design, each dimension a single number.")
        pose = {name: value if np.ndim(value) == 0 else np.asarray(value, float) for name, value in pose.items()}
        given = {names.quantity(name): value for name, value in {**self.machine.dimensions, **pose}.items()}
        for point in (*self.machine.plan.ground, *self._listing.unknowns):
            given |= dict(zip(explicit(names.vector(point)), motion[point], strict=True))
        for guide in self._listing.fixed_guides:
            given |= dict(zip(explicit(names.vector(guide)), (self.machine[f"{guide}.x"], self.machine[f"{guide}.y"]), strict=True))
        for each in self._givens:
            given |= each.parts(motion)
        return given

    @property
    def _givens(self) -> Sequence[GivenNumber]:
        """The numbers that no formula gives."""
        return [*self._listing.givens, *([] if self._forces is None else self._forces.givens)]

    # -- closed forms ----------------------------------------------------------------------------------

    def closed(self, name: str, limit: int = 20_000) -> sympy.Expr | tuple[sympy.Expr, ...]:
        """Return a left side in elementary functions of strokes and dimensions alone: SymPy, one or a tuple of two.

        For short chains: a closed form grows by a factor at each step. Raises DefinitionError above `limit` operations.
        """
        require_whole("limit", limit, "the number of operations is expected, such as 20000")
        target = self[known_name("Equation", name, [each.name for each in self._items], self.machine.plan.title)]
        known: dict[sympy.Symbol, sympy.Expr] = {}
        for each in self._items[: self._items.index(target)]:
            written = [part.xreplace(known) for part in explicit(each.rhs)]
            if sum(part.count_ops() for part in written) > limit:
                raise DefinitionError(f"{name} has more than {limit} operations in closed form; use the equations one after the other.")
            known |= dict(zip(explicit(each.lhs), written, strict=True))
        found = tuple(part.xreplace(known) for part in explicit(target.rhs))
        return found[0] if len(found) == 1 else found

    # -- text ------------------------------------------------------------------------------------------

    def text(self, numbers: bool | None = None, at: Mapping[str, Numbers] | None = None) -> str:
        """Return the legend and the numbered equations; with `numbers` each followed by its evaluation at a pose."""
        check_pose(self.machine, at)
        filled = numbers if numbers is not None else self._poses is not None or at is not None
        values, shown = self._filled(at or self._poses) if filled else ({}, {})
        width = len(f"({self._items[-1].number})") if self._items else 0
        lines, headings = list[str](), self.headings
        for each in self._items:
            if each.number in headings:
                lines += [*([""] if lines else []), headings[each.number]]
            lines.append(f"{f'({each.number})':<{width}} {each.filled(values, shown) if filled else each}")
        return "\n".join([*legend(self, self._listing, shown, self._forces), "", *lines])

    def _filled(self, at: Mapping[str, Numbers] | None, known: Mapping[str, object] | None = None) -> tuple[dict[str, str], dict[str, str]]:
        """Return every symbol's value as an equation has it, and as it is shown with its unit; `known` are the left sides' own."""
        pose, names, units = self._pose(at), self._listing.names, self._listing.units
        is_one = not any(map(np.ndim, pose.values()))
        ensure(is_one, f"{self.machine.plan.title}: numbers are filled in at one pose; give one value for each stroke.")
        inputs = self._inputs(at)
        found: list[tuple[str, Any, Unit]] = []
        for name in (*self.machine.dimensions, *self.machine.plan.strokes):
            symbol = names.quantity(name)
            found.append((symbol.name, inputs[symbol], units[name]))
        vectors = [(names.vector(point), LENGTH) for point in self._listing.given_points]
        for symbol, unit in [*vectors, *((each.symbol, each.unit) for each in self._givens)]:
            parts = [inputs[part] for part in explicit(symbol)]
            found.append((symbol.name, parts if symbol.is_Matrix else parts[0], unit))
        if known is None:
            values = evaluated(self._lines, inputs)
            known = {line.name: values[line.lhs] for line in self._lines}
        found += [(line.name, known[line.name], line.unit) for line in self._lines]
        texts, shown = {"i": "(1, 0)"} if "i" not in self.machine.plan.members else {}, dict[str, str]()
        for name, value, unit in found:
            own, size = unit.text, unit.shown_factor
            if np.ndim(value):
                texts[name], displayed = (
                    f"({', '.join(plain_number(float(part) / by) for part in value)})" for by in (unit.si_factor, size)
                )
                shown[name] = f"{displayed} {own}".rstrip()
                continue
            texts[name] = plain_number(float(value) / unit.si_factor) + (" deg" if own == "deg" else "")
            if own in UNITS and SI.get(UNITS[own][1]) != own and shown_in(own) != own:  # units other than SI follow the chosen system
                size, own = size * factor(shown_in(own)) / factor(own), shown_in(own)
            shown[name] = f"{plain_number(float(value) / size)} {own}".rstrip()
        return texts, shown

    def __str__(self) -> str:
        return self.text()

    __repr__ = __str__

    def sheet(self, at: Mapping[str, Numbers] | None = None, known: Mapping[str, object] | None = None) -> list[SheetLine]:
        """Return the equations with their numbers at a pose, in LaTeX, as a calculation sheet shows them.

        `known` are the left sides' values there by name [SI], where `values` gave them already.
        """
        values, shown = self._filled(self._poses if at is None else at, known)
        headings = self.headings
        sheet = [each.sheet(self._listing.names.latex, values, shown) for each in self._items]
        return [each._replace(heading=headings[each.number]) if each.number in headings else each for each in sheet]

    together = FormerName("iterated_pins")

    @property
    def iterated_pins(self) -> tuple[str, ...]:
        """The pins that are found together, by iteration: they have no closed form, and the equations are their constraints."""
        return tuple(self._listing.unknowns)

    @property
    def left_out(self) -> tuple[str, ...]:
        """The elements whose dry friction is not in the equations of forces."""
        return tuple(self._forces.friction) if self._forces is not None else ()

    @property
    def axles(self) -> tuple[str, tuple[str, ...]]:
        """The support of a vehicle that moments are written about, "" where there is none, and those whose loads are given numbers."""
        return ("", ()) if self._forces is None else (self._forces.about, self._forces.shared)

    def symbol_latex(self, name: str) -> str:
        """Return the LaTeX of a stroke or a design variable."""
        given = [*self.machine.plan.strokes, *self.machine.dimensions]
        symbol = self._listing.names.quantity(known_name("Stroke or dimension", name, given, self.machine.plan.title))
        return str(self._listing.names.latex.get(symbol.name, symbol.name))

    @property
    def definitions(self) -> list[str]:
        """The definitions of the words that the equations use, as LaTeX, a line each."""
        return [text.replace("&", "") for words, text in LATEX if uses(self, words)]

    def latex(self, definitions: bool = True) -> str:
        r"""Return the equations as a LaTeX `align` environment, numbered by `\tag`; in front the definitions of its words."""
        words = self._listing.names.latex
        rows, headings = list[str](), self.headings
        for each in self._items:
            if each.number in headings:
                rows.append(rf"  \textbf{{{escaped_latex(headings[each.number])}}} & \notag")
            rows.append(rf"  {each.latex(words)} \tag{{{each.number}}}")
        used = [f"  {text}" for meant, text in LATEX if definitions and uses(self, meant)]
        head = [r"\begin{align*}", " \\\\\n".join(used), r"\end{align*}"] if used else []
        return "\n".join([*head, r"\begin{align}", " \\\\\n".join(rows), r"\end{align}"])

    def _repr_latex_(self) -> str:
        return self.latex()


# What stands in front of the equations: the words' definitions, the sign convention, and what is given.

WIDTH = 110
MOST_DIGITS = 1000
TOGETHER = "\N{NO-BREAK SPACE}"
CONVENTION = (
    "x to the right, y up; angles counter-clockwise positive; lengths in m.",
    "One letter is the position of a point, two are the vector between two points: AB = B - A.",
)
Word: TypeAlias = "type[sympy.Basic] | sympy.Basic"
DEFINITIONS: tuple[tuple[tuple[Word, ...], str], ...] = (
    ((TurnV, TurnVL), "TurnV(V, a): the vector V turned by the angle a, counter-clockwise for a > 0"),
    ((TurnVL,), "TurnVL(V, a, L) = TurnV(V, a)*L/|V|"),
    ((Tcos,), "Tcos(L1, L2, L3) = acos((L1**2 + L2**2 - L3**2)/(2*L1*L2)): the angle between the sides L1 and L2"),
    ((Direction,), "angle(V): the direction of V, counter-clockwise from the x axis"),
    ((Dot,), "dot(U, V) = U_x*V_x + U_y*V_y"),
    ((Cross,), "cross(U, V) = U_x*V_y - U_y*V_x"),
)
LATEX: tuple[tuple[tuple[Word, ...], str], ...] = (
    (
        (TurnV, TurnVL),
        r"\operatorname{TurnV}\left(\vec{V}, a\right) &= "
        r"\begin{pmatrix} V_x \cos a - V_y \sin a \\ V_x \sin a + V_y \cos a \end{pmatrix}",
    ),
    (
        (TurnVL,),
        r"\operatorname{TurnV}_{L}\left(\vec{V}, a, L\right) &= "
        r"\operatorname{TurnV}\left(\vec{V}, a\right) \frac{L}{\left|\vec{V}\right|}",
    ),
    ((Tcos,), r"\operatorname{Tcos}\left(L_1, L_2, L_3\right) &= \arccos \frac{L_1^2 + L_2^2 - L_3^2}{2 L_1 L_2}"),
    ((Cross,), r"\left(\vec{U} \times \vec{V}\right)_{z} &= U_x V_y - U_y V_x"),
)


def uses(equations: Equations, words: tuple[Word, ...]) -> bool:
    """Return whether the equations use one of some words."""
    return any(each.rhs.has(*words) for each in equations)


def legend(equations: Equations, listing: Listing, values: dict[str, str], forces: ForceLines | None = None) -> list[str]:
    """Return the lines in front: conventions, definitions, and the given symbols, with `values` where there are any."""
    lines = [*CONVENTION, *(text for words, text in DEFINITIONS if uses(equations, words))]
    if uses(equations, (X_AXIS,)):
        lines.append("i: the unit vector of the x axis")
    if listing.unknowns:
        lines.append(f"{', '.join(listing.unknowns)}: found together, so that the equations in which they stand hold.")
    if forces is not None:
        own = [] if forces.case is None else [f"The loads are those of the load case {case_of(listing.plan, forces.case).label}."]
        lines += [*own, *WORDS, *([f"Left out: the friction of {', '.join(forces.friction)}."] if forces.friction else [])]
        lines += [f"R: what a support carries, by the moments about {forces.about} and the sum across the ground."] if forces.about else []
        given = ", ".join(f"R_{name}" for name in forces.shared)
        lines += [f"{given}: they hang on how the supports give way, and are given numbers."] if given else []
    others = [each.symbol for each in (*listing.givens, *([] if forces is None else forces.givens))]
    plan, names = listing.plan, listing.names
    made = {each.lhs for each in equations}
    used = set().union(*(each.symbols for each in equations)) - made if len(equations) else set()
    strokes = [names.quantity(name) for name in plan.strokes]
    points = [names.vector(name) for name in listing.given_points if name not in listing.unknowns]
    dimensions = [names.quantity(name) for name in plan.table.entries]
    words = {name: f"{name} = {value}".replace(" ", TOGETHER) for name, value in values.items()}
    groups = [[words.get(each.name, each.name) for each in group if each in used] for group in (strokes, points, dimensions, others)]
    listed = "; ".join(", ".join(group) for group in groups if group)
    inputs = wrap(f"Given: {listed}.", width=WIDTH, subsequent_indent="  ", break_long_words=False) if listed else []
    return [*lines, *(line.replace(TOGETHER, " ") for line in inputs)]


# Numbers for the equations: each line evaluated from those before it, on arrays or to any number of digits.


def evaluated(lines: Sequence[ListingLine], inputs: Mapping[sympy.Symbol, Any], digits: int | None = None) -> dict[sympy.Basic, object]:
    """Return every line's value [SI]: a scalar or a pair, by its symbol.

    `inputs` are the plain symbols' values. With `digits` mpmath works at that many digits and the values
    are SymPy's; else both are NumPy's. A value that is no real number goes on as NaN.
    """
    known = dict(inputs) | dict(zip(plain_symbols(X_AXIS.name), (1.0, 0.0), strict=True))
    if digits is None:
        with np.errstate(all="ignore"):
            return line_values(lines, ValuesOf({symbol: np.asarray(value, float)[()] for symbol, value in known.items()}))
    with mpmath.workdps(digits + 10):
        found = line_values(lines, ValuesOf({symbol: mpmath.mpf(repr(float(value))) for symbol, value in known.items()}, mpmath))
    return {  # SymPy's numbers keep their digits wherever they are shown
        symbol: tuple(sympy.Float(part, digits) for part in value) if isinstance(value, tuple) else sympy.Float(value, digits)
        for symbol, value in found.items()
    }


def line_values(lines: Sequence[ListingLine], values: ValuesOf) -> dict[sympy.Basic, Any]:
    """Return the lines' values, each from those before it."""
    found: dict[sympy.Basic, Any] = {}
    for line in lines:
        try:
            value = values[line.rhs.xreplace({each: each.doit() for each in line.rhs.atoms(Deg)})]
        except ZeroDivisionError:  # mpmath's; NumPy has no value there either and says so by NaN or infinity
            value = (mpmath.nan, mpmath.nan) if line.lhs.is_Matrix else mpmath.nan
        found[line.lhs] = values[line.lhs] = tuple(map(in_reals, value)) if line.lhs.is_Matrix else in_reals(value)
    return found


def in_reals(value: Any) -> object:
    """Return a value; NaN for anything but a real number, such as a power of a negative one."""
    if isinstance(value, mpmath.mpc):
        return value.real if value.imag == 0 else mpmath.nan
    return np.where(np.imag(value) == 0.0, np.real(value), np.nan)[()] if np.iscomplexobj(value) else value
