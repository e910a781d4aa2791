"""Columns, their limits, points, headings and forces as pictures and pages show them."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Sequence
from functools import reduce
from operator import add
from typing import NamedTuple

import numpy as np

from ..errors import ensure, fits_shape, is_listed, known_name, require, require_type
from ..language import noted, said
from ..loads import ForceElement, Load
from ..mechanism import Mechanism
from ..motion import Column, Motion
from ..motion.measures import Constraint, FixedNumber, Leaf, Least, Most
from ..motion.requests import may_be_unlimited
from ..plan import Plan
from ..plan.members import FRAME
from ..program import FloatArray
from ..quantities import is_number, joined_names
from ..statics import JointForce, LawRequest, PinForces
from ..units import factor, require_measure
from .shapes import left_of
from .style import part_of_points


def named_points(machine: Mechanism, names: object, what: str) -> tuple[str, ...]:
    """Return the names of points whose paths are drawn; DefinitionError for anything but a list of such names."""
    listed = require_type(f"{machine.plan.title}: {what}", names, (list, tuple), f'a list of points is expected, such as {what}=["G"]')
    return tuple(known_name("Point", name, machine.plan.points, where=machine.plan.title) for name in listed)


def check_poses(column: Column, motion: Motion) -> None:
    """Raise DefinitionError for a column that has not one value a pose of a motion."""
    said = f"{motion.plan.title}: the column {column.name} has values of shape {np.shape(column.values)}"
    fits = fits_shape(column.values, motion.shape)
    ensure(fits, f"{said}, and the motion poses of shape {motion.shape}; give one value for each pose.")


# Limit lines: a value that a result may not pass, and on which side it fails.


class Limit(NamedTuple):
    """A value [SI] that a column may not pass, its words, and the side that fails: "above" or "below"."""

    value: float
    text: str = ""
    fails: str = "above"

    def drawn(self, column: Column) -> float:
        """Return the value in the unit of a column."""
        return self.value / factor(column.shown_unit)

    def failing(self, values: FloatArray) -> FloatArray:
        """Return the mask of the values [SI] that fail."""
        return np.asarray(values > self.value if self.fails == "above" else values < self.value)


def limit_of(given: Sequence[object], unit: str = "") -> Limit:
    """Return a limit from a tuple of its parts; DefinitionError for a side that is neither above nor below, and for another `unit`."""
    parts = tuple(given) if is_listed(given) else ()
    is_limit = 1 <= len(parts) <= 3 and is_number(parts[0]) and all(isinstance(each, str) for each in parts[1:])
    require(is_limit, "", given, 'is no limit; write (value [SI], text) or (value, text, "below")')
    found = Limit(*parts)
    if unit:
        require_measure(found.value, unit, f"the limit {found.text}".rstrip())
    ensure(found.fails in ("above", "below"), f'the limit {found.text or found.value!r} fails {found.fails!r}: say "above" or "below".')
    return found


def limit_on(constraint: Constraint, is_shown: Callable[[Leaf], bool]) -> Limit | None:
    """Return the limit that a condition sets a quantity at every pose; None where it sets none. `is_shown` tells the quantity's leaves."""
    leaf, number, sign = leaf_bound(constraint, is_shown) or (None, 0.0, "")
    if isinstance(leaf, Most) and sign == "<=":
        return Limit(number, "", "above")
    return Limit(number, "", "below") if isinstance(leaf, Least) and sign == ">=" else None


def leaf_bound(constraint: Constraint, is_shown: Callable[[Leaf], bool]) -> tuple[Leaf, float, str] | None:
    """Return the leaf, the number [SI] and the sign of a condition that holds a quantity against a number; None for any other."""
    left, right, turned = constraint.left, constraint.right, {"<=": ">=", ">=": "<=", "==": "=="}[constraint.symbol]
    for one, other, sign in ((left, right, constraint.symbol), (right, left, turned)):
        if isinstance(one, Leaf) and isinstance(other, FixedNumber) and is_shown(one):
            return one, other.value, sign
    return None


# A reserve has no bound where little is carried: its curve is the load in % of what the pump can carry.

RESERVE, PUMP_LOAD, WHOLE = "reserve", noted("1/reserve"), 100.0


def as_curve(column: Column, bound: Sequence[object] | None = None) -> tuple[Column, Sequence[object] | None]:
    """Return a column and its limit as curves show them. Of a cylinder's reserve, no output of the machine's own, that is 100 % over it."""
    is_law = column.request is None or (isinstance(column.request, LawRequest) and may_be_unlimited(column.request))
    if column.unit or not is_law or not re.match(rf"{RESERVE}\b", column.name):
        return column, bound
    with np.errstate(divide="ignore"):
        share = Column(f"{column.name.replace(RESERVE, PUMP_LOAD, 1)}, %", WHOLE / np.asarray(column.values, float), "", 1)
    if bound is None:
        return share, Limit(WHOLE, said("all that the pump can carry"))
    value, text, fails = limit_of(bound)
    return share, Limit(WHOLE / value, text, "below" if fails == "above" else "above")


def typeset(text: str) -> str:
    """Return a heading with the squares and cubes of its units raised: kgf/cm² for kgf/cm2; a name such as boom2 or m2 stays."""
    return POWER.sub(lambda unit: unit[1] + "²³"[int(unit[2]) - 2], text.replace("kgf_cm2", "kgf/cm2"))


def unit_typeset(unit: str) -> str:
    """Return a unit as it is printed; what may be a name, such as m2, is not taken for one."""
    return typeset(f"/{unit}")[1:]


POWER = re.compile(r"(?:(?<=[/\d])|(?<=\d )|(?<=kg )|(?<=, )(?=[cm]?m[23]$))([cm]?m|s)([23])\b")
"""A square or cube of a length or a second: behind a slash, a number, a kilogram, or the last comma of a heading."""


# Joint forces: the body on which one is shown, and how bodies are called.


def bodies_shown(found: PinForces, joint: JointForce) -> tuple[str, str]:
    """Return the body on which a joint's force is shown, and the body or the frame that it comes from."""
    on, by = joint.on, joint.by
    is_borne = on == FRAME or (on in found.members and by not in found.members and by != FRAME)
    return (by, on) if is_borne else (on, by)


MOST_LETTERS = 6
"""A body that no link names goes by all its points where these have so many letters at the most; else by its first two."""


def short_name(found: PinForces, body: str) -> str:
    """Return a body's name as it is written at an arrow: its member's, its link's, or its points; of many its part's first two."""
    known = next((each for each in found._structure.bodies if each.name == body), None)
    if known is None or body in found.members or len(known.points) < 3:
        return body
    owner = part_of_points(known.points)
    own = [each for each in known.points if part_of_points([each]) == owner]
    if known.label or (len(own) == len(known.points) and len("".join(each.rpartition(".")[2] for each in own)) <= MOST_LETTERS):
        return known.label or body
    return f"{joined_names(*(own if len(own) > 1 else known.points)[:2])}\N{HORIZONTAL ELLIPSIS}"


def resultant(acting: Sequence[tuple[FloatArray, FloatArray]]) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return the sum of forces that act at places (2, ...) [N], their moment about the middle of these [N m], and that middle [m]."""
    force: FloatArray = reduce(add, [each for _, each in acting])
    middle: FloatArray = reduce(add, [place for place, _ in acting]) / len(acting)
    moment: FloatArray = reduce(add, [(place - middle)[0] * each[1] - (place - middle)[1] * each[0] for place, each in acting])
    return force, moment, middle


def on_its_line(force: FloatArray, moment: FloatArray, place: FloatArray, centre: FloatArray | None) -> FloatArray:
    """Return where a force with a moment about a place is drawn (2, ...) [m]: on its line of action, next to the centre of a mass."""
    square = force[0] ** 2 + force[1] ** 2
    found: FloatArray = place - left_of(force) * (moment / square)
    return found if centre is None else np.asarray(found + force * (((centre - found) * force).sum(axis=0) / square))


def centre_of_mass(place: Callable[[str], FloatArray], plan: Plan, element: str) -> FloatArray | None:
    """Return the centre of a body's own mass that is declared beside its points (2, ...) [m], None of all else."""
    beside = centre_beside(plan, element)
    if beside is None:
        return None
    P, Q, (along, left) = place(beside[0]), place(beside[1]), beside[2]
    way = (Q - P) / np.hypot(Q[0] - P[0], Q[1] - P[1])
    return np.asarray(P + along * way + left * left_of(way))


def drawn_together(found: PinForces, loads: Iterable[Load]) -> dict[tuple[str, str, str], list[Load]]:
    """Return loads by element, body and, of a rope, point: those of a group are one arrow."""
    plan, groups = found.motion.plan, dict[tuple[str, str, str], list[Load]]()
    elements = plan.of_kind(ForceElement).items()
    ropes = {name for name, each in elements if any(glyph.drawn_as == "rope" for glyph in each.glyphs(plan.members))}
    for load in loads:
        element = load.element.partition("(")[0]
        groups.setdefault((element, found._body_under(load), load.point if load.element in ropes else ""), []).append(load)
    return groups


def centre_beside(plan: Plan, element: str) -> tuple[str, str, tuple[float, float]] | None:
    """Return where the centre of a body's own mass lies beside its points: from the first of two towards the second, and to the left."""
    found = plan.of_kind(ForceElement).get(element)
    glyphs = found.glyphs(plan.members) if found is not None else ()
    return next(((glyph.points[0], glyph.points[1], glyph.away) for glyph in glyphs if glyph.away is not None), None)
