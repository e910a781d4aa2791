"""The numbered equations of a mechanism, as text, LaTeX, SymPy and numbers."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from ..errors import DefinitionError, cited, unknown
from ..mechanism import Mechanism, declared, require_mechanism
from ..quantities import Stroke, is_whole
from .equation import Equation, shown
from .legend import latex_legend, legend
from .listing import Listing
from .rates import needed, ratio_lines
from .units import LENGTH
from .values import evaluated
from .words import explicit
from .written import Written


class Equations(Sequence[Equation]):
    """The equations of one design, in the vector method's order; `print` shows them numbered.

    Index by place or by name: `equations(hitch)["OAB"].rhs`.
    """

    def __init__(self, machine: Mechanism, lines: Sequence[Written], listing: Listing, start: int, poses: Mapping[str, Any] | None) -> None:
        self.machine, self._listing, self._lines, self._poses = machine, listing, tuple(lines), poses
        strokes = [listing.names.quantity(name) for name in machine.plan.strokes]
        numbered = enumerate(lines, start)
        self._items = tuple(Equation(number, line.lhs, line.rhs, line.unit, follows(line, strokes)) for number, line in numbered)

    def __len__(self) -> int:
        return len(self._items)

    def __iter__(self) -> Iterator[Equation]:
        return iter(self._items)

    def __getitem__(self, place: Any) -> Any:
        """Return an equation by its place or its name, or a list of them by a slice."""
        if not isinstance(place, str):
            return self._items[place]
        found = {each.name: each for each in self._items}
        if place not in found:
            raise unknown("Equation", place, found, where=self.machine.plan.title)
        return found[place]

    @property
    def symbols(self) -> dict[str, Any]:
        """Every SymPy symbol by its text: what is given, then the left sides."""
        given = {symbol.name: symbol for each in self._items for symbol in each.symbols}
        return given | {each.name: each.lhs for each in self._items if each.lhs.is_Symbol or each.lhs.is_Matrix}

    # -- numbers ---------------------------------------------------------------------------------------

    def values(self, at: Mapping[str, Any] | None = None, digits: int | None = None) -> dict[str, Any]:
        """Return every left side's value [SI] by name: a number, a pair for a vector.

        `at` are strokes, numbers or arrays; those not named are at their start. With `digits` the values are
        SymPy numbers of so many digits, from the dimensions as decimals. Raises AssemblyError where the pose cannot be assembled.
        """
        found = evaluated(self._lines, self._inputs(at), digits)
        return {line.name: found[line.lhs] for line in self._lines}

    def _pose(self, at: Mapping[str, Any] | None) -> dict[str, Any]:
        strokes = self.machine.plan.strokes
        for name in at or {}:
            if name not in strokes:
                raise unknown("Stroke", name, strokes, where=self.machine.plan.title)
        return {name: stroke.start for name, stroke in strokes.items()} | dict(at or {})

    def _inputs(self, at: Mapping[str, Any] | None) -> dict[Any, Any]:
        """Return the plain symbols of everything given, with their values [SI]."""
        pose, names = self._pose(at), self._listing.names
        motion = self.machine.at(**pose)
        if motion.design_shape:
            raise DefinitionError(f"{self.machine.plan.title}: its equations take one design, each dimension a single number.")
        given = {names.quantity(name): value for name, value in {**self.machine.dimensions, **pose}.items()}
        for point in (*self.machine.plan.ground, *self._listing.unknowns):
            given |= dict(zip(explicit(names.vector(point)), motion[point], strict=True))
        for guide in self._listing.fixed_guides:
            given |= dict(zip(explicit(names.vector(guide)), (self.machine[f"{guide}.x"], self.machine[f"{guide}.y"]), strict=True))
        return given

    # -- closed forms ----------------------------------------------------------------------------------

    def closed(self, name: str, limit: int = 20_000) -> Any:
        """Return a left side in elementary functions of strokes and dimensions alone: SymPy, one or a tuple of two.

        For short chains: a closed form grows by a factor at each step. Raises DefinitionError above `limit` operations.
        """
        target = self[name]
        known: dict[Any, Any] = {}
        for each in self._items[: self._items.index(target) + 1]:
            written = tuple(part.xreplace(known) for part in explicit(each.rhs))
            if each is target:
                return written[0] if len(written) == 1 else written
            if sum(part.count_ops() for part in written) > limit:
                raise DefinitionError(f"{name} has more than {limit} operations in closed form; use the equations one after the other.")
            known |= dict(zip(explicit(each.lhs), written, strict=True))
        raise AssertionError(name)

    # -- text ------------------------------------------------------------------------------------------

    def text(self, numbers: bool | None = None, at: Mapping[str, Any] | None = None) -> str:
        """Return the legend and the numbered equations; with `numbers` each followed by its evaluation at a pose."""
        filled = numbers if numbers is not None else self._poses is not None or at is not None
        values = self._shown(at or self._poses) if filled else {}
        width = len(f"({self._items[-1].number})") if self._items else 0
        lines = [f"{f'({each.number})':<{width}} {each.filled(values) if filled else each}" for each in self._items]
        return "\n".join([*legend(self, self._listing, values), "", *lines])

    def _shown(self, at: Mapping[str, Any] | None) -> dict[str, str]:
        pose, names, units = self._pose(at), self._listing.names, self._listing.units
        if any(np.ndim(value) for value in pose.values()):
            raise DefinitionError(f"{self.machine.plan.title}: numbers are filled in at one pose; give one value for each stroke.")
        inputs = self._inputs(at)
        texts = {"i": "(1, 0)"} if "i" not in self.machine.plan.members else {}
        for name in (*self.machine.dimensions, *self.machine.plan.strokes):
            symbol = names.quantity(name)
            texts[symbol.name] = shown(inputs[symbol], units[name])
        for point in self._listing.given_points:
            symbol = names.vector(point)
            texts[symbol.name] = shown([inputs[part] for part in explicit(symbol)], LENGTH)
        values = evaluated(self._lines, inputs)
        return texts | {line.name: shown(values[line.lhs], line.unit) for line in self._lines}

    def __str__(self) -> str:
        return self.text()

    __repr__ = __str__

    def latex(self, definitions: bool = True) -> str:
        r"""Return the equations as a LaTeX `align` environment, numbered by `\tag`; in front the definitions of its words."""
        words = self._listing.names.latex
        rows = [rf"  {each.latex(words)} \tag{{{each.number}}}" for each in self._items]
        head = latex_legend(self) if definitions else []
        return "\n".join([*head, r"\begin{align}", " \\\\\n".join(rows), r"\end{align}"])

    def _repr_latex_(self) -> str:
        return self.latex()


def follows(line: Written, strokes: Sequence[Any]) -> tuple[Any, ...]:
    """Return the strokes that a scalar's own formula names: L_AB(S)."""
    if not line.lhs.is_Symbol or "/" in line.lhs.name:
        return ()
    return tuple(stroke for stroke in strokes if stroke in line.rhs.free_symbols)


def equations(
    machine: Mechanism | type[Mechanism],
    *,
    start: int = 1,
    numbers: bool = False,
    at: Mapping[str, float] | None = None,
    ratio: str | Sequence[str] = (),
    wrt: str | None = None,
) -> Equations:
    """Return a mechanism's equations, numbered from `start`, in the vector method's primitives.

    `numbers` fills the numbers in at the pose `at` (default: the start of each stroke). `ratio` names points and
    outputs whose derivatives by the stroke `wrt` are added. Source of notation and order: Dyuzhev, Kotov, Chuprynin,
    "Universality of the hitch of the power vehicle UES-2-250A" (Minsk, 2008), equations (4) to (27).
    """
    design = machine() if isinstance(machine, type) and issubclass(machine, Mechanism) else machine
    check_asked(design, start, at)
    listing = Listing(design.plan)
    listing.write(declared(type(design)))
    lines = list(listing.lines)
    for target in [ratio] if isinstance(ratio, str) else ratio:
        added = differentiated(design, listing, target, wrt)
        lines += [line for line in added if line.lhs not in {each.lhs for each in lines}]
    return Equations(design, lines, listing, start, {} if numbers and at is None else at if numbers or at else None)


def check_asked(design: Any, start: Any, at: Any) -> None:
    """Raise DefinitionError for what is no mechanism, no number to begin with, or no pose."""
    require_mechanism(design)
    if not is_whole(start):
        raise DefinitionError(f"start={cited(start)}: the first equation's number is expected, such as 1.")
    if at is not None and not isinstance(at, Mapping):
        raise DefinitionError(f"{design.plan.title}: at={cited(at)}: values of strokes by name are expected, such as at=dict(S=0.1).")


def differentiated(design: Mechanism, listing: Listing, target: str, wrt: str | None) -> list[Written]:
    """Return the lines that lead to a target's transfer ratio; DefinitionError for a name without one."""
    plan = design.plan
    known = named(listing)
    if target not in known:
        raise unknown("Point or output", target, known, where=plan.title)
    stroke = stroke_of(plan.strokes, wrt, plan.title)
    together = {listing.names.vector(pin) for pin in listing.unknowns}
    if together & {known[target], *(symbol for line in needed(listing.lines, known[target]) for symbol in line.rhs.free_symbols)}:
        pins = " ".join(listing.unknowns)
        raise DefinitionError(f"{plan.title}: {target} hangs on pins found together ({pins}): no chain of derivatives; take motion.ratio.")
    return ratio_lines(listing.lines, known[target], listing.names.quantity(stroke), listing.units[stroke], listing.names)


def named(listing: Listing) -> dict[str, Any]:
    """Return the members that have a line, by their names in the class."""
    lines = {line.lhs for line in listing.lines}
    symbols = {name: listing.symbol_of(name) for name in listing.plan.named()}
    return {name: symbol for name, symbol in symbols.items() if symbol in lines or name in listing.unknowns}


def stroke_of(strokes: Mapping[str, Stroke], wrt: str | None, title: str) -> str:
    """Return the stroke to differentiate by; DefinitionError where it has to be said."""
    if wrt is None and len(strokes) != 1:
        raise DefinitionError(f"{title} has {len(strokes)} strokes: say wrt= one of {', '.join(strokes)}.")
    name = next(iter(strokes)) if wrt is None else wrt
    if name not in strokes:
        raise unknown("Stroke", name, strokes, where=title)
    return name
