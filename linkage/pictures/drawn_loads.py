"""Which loads are one arrow, and where it is drawn, for pictures and pages alike."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from functools import reduce
from operator import add

import numpy as np

from ..loads import ForceElement, Load
from ..plan import Plan
from ..program import FloatArray
from ..statics import PinForces
from .shapes import left_of


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
