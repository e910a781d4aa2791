"""What stands in front of the equations: the words' definitions, the sign convention, and what is given."""

from __future__ import annotations

from textwrap import wrap
from typing import Any

from .listing import Listing
from .rules import X_AXIS
from .units import LENGTH, Unit
from .words import Cross, Direction, Dot, Tcos, TurnV, TurnVL

WIDTH = 110
TOGETHER = "\N{NO-BREAK SPACE}"
CONVENTION = (
    "x to the right, y up; angles counter-clockwise positive; lengths in m.",
    "One letter is the position of a point, two are the vector between two points: AB = B - A.",
)
DEFINITIONS: tuple[tuple[tuple[Any, ...], str], ...] = (
    ((TurnV, TurnVL), "TurnV(V, a): the vector V turned by the angle a, counter-clockwise for a > 0"),
    ((TurnVL,), "TurnVL(V, a, L) = TurnV(V, a)*L/|V|"),
    ((Tcos,), "Tcos(L1, L2, L3) = acos((L1**2 + L2**2 - L3**2)/(2*L1*L2)): the angle between the sides L1 and L2"),
    ((Direction,), "angle(V): the direction of V, counter-clockwise from the x axis"),
    ((Dot,), "dot(U, V) = U_x*V_x + U_y*V_y"),
    ((Cross,), "cross(U, V) = U_x*V_y - U_y*V_x"),
)
LATEX: tuple[tuple[tuple[Any, ...], str], ...] = (
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
)


def uses(equations: Any, words: tuple[Any, ...]) -> bool:
    """Return whether the equations use one of some words."""
    return any(each.rhs.has(*words) for each in equations)


def legend(equations: Any, listing: Listing, values: dict[str, str]) -> list[str]:
    """Return the lines in front: conventions, definitions, and what is given, with `values` where there are any."""
    lines = [*CONVENTION, *(text for words, text in DEFINITIONS if uses(equations, words))]
    if uses(equations, (X_AXIS,)):
        lines.append("i: the unit vector of the x axis")
    if listing.unknowns:
        lines.append(f"{', '.join(listing.unknowns)}: found together, so that the equations in which they stand hold.")
    return [*lines, *given(equations, listing, values)]


def given(equations: Any, listing: Listing, values: dict[str, str]) -> list[str]:
    """Return what the equations start from: strokes, points, dimensions; `Given: S; A, O; L0, L_OB`."""
    plan, names = listing.plan, listing.names
    made = {each.lhs for each in equations}
    used = set().union(*(each.symbols for each in equations)) - made if len(equations) else set()
    strokes = [names.quantity(name) for name in plan.strokes]
    points = [names.vector(name) for name in listing.given_points if name not in listing.unknowns]
    dimensions = [names.quantity(name) for name in plan.table.entries]
    units = {names.quantity(name).name: unit for name, unit in listing.units.items()}
    groups = [[worded(symbol, values, units) for symbol in group if symbol in used] for group in (strokes, points, dimensions)]
    listed = "; ".join(", ".join(group) for group in groups if group)
    lines = wrap(f"Given: {listed}.", width=WIDTH, subsequent_indent="  ", break_long_words=False) if listed else []
    return [line.replace(TOGETHER, " ") for line in lines]


def worded(symbol: Any, values: dict[str, str], units: dict[str, Unit]) -> str:
    """Return a given symbol, with its value and unit where that is known."""
    if symbol.name not in values:
        return str(symbol.name)
    value, unit = values[symbol.name], LENGTH if symbol.is_Matrix else units[symbol.name]
    text = f"{symbol.name} = {value}" if value.endswith(" deg") else f"{symbol.name} = {value} {unit.text}".rstrip()
    return text.replace(" ", TOGETHER)


def latex_legend(equations: Any) -> list[str]:
    """Return the definitions as an unnumbered `align*` environment; nothing where none is used."""
    rows = [text for words, text in LATEX if uses(equations, words)]
    return [r"\begin{align*}", " \\\\\n".join(f"  {row}" for row in rows), r"\end{align*}"] if rows else []
