"""What a design variable measures, by its unit, its label, or what it is added to."""

from __future__ import annotations

from ..units import UNITS
from .plan import Plan

VARIABLE_MEASURES = {"length": "length", "coordinate": "length", "angle": "angle"}


def plan_measure(plan: Plan, variable: str) -> str:
    """Return what a design variable measures ("length", "angle", "pressure", ...); "" where nothing says so.

    A dimension without a unit of its own measures what it is added to: `L0` in `AB=L0 + S` is a length.
    """
    entry = plan.table.entries[variable]
    if entry.unit:
        return UNITS[entry.unit][1]
    if entry.kind in VARIABLE_MEASURES:
        return VARIABLE_MEASURES[entry.kind]
    if any(variable in plan.terms(length) for length in plan.table.lengths.values()):
        return "length"
    return "angle" if variable in plan.turning else ""
