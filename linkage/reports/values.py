"""Design variables and strokes with their values, in the units an engineer reads them in."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ..mechanism import Mechanism, require_mechanism
from ..motion import stroke_display_unit
from ..plan import Plan
from ..units import UNITS, display_unit, factor, show

MEASURES = {"length": "length", "coordinate": "length", "angle": "angle"}

STEPS = ("length", "angle")  # kinds of variables that a step's label makes


def measure(plan: Plan, variable: str) -> str:
    """Return what a design variable measures ("length", "angle", "pressure", ...); "" where nothing says so.

    A dimension without a unit of its own measures what it is added to: `L0` in `AB=L0 + S` is a length.
    """
    entry = plan.table.entries[variable]
    if entry.unit:
        return UNITS[entry.unit][1]
    if entry.kind in MEASURES:
        return MEASURES[entry.kind]
    if any(variable in plan.terms(length) for length in plan.table.lengths.values()):
        return "length"
    return "angle" if variable in plan.turning else ""


def design_rows(machine: Mechanism) -> Iterator[tuple[str, str, str]]:
    """Yield, for each design variable, its name, its value with unit, and the step that has it; a batch shows its range."""
    require_mechanism(machine)
    for name, value in machine.dimensions.items():
        entry = machine.plan.table.entries[name]
        unit = entry.unit or display_unit(measure(machine.plan, name), "mm")
        low, high = show(float(np.min(value)), unit), show(float(np.max(value)), unit)
        yield name, low if low == high else f"{low} to {high}", entry.where if entry.kind in STEPS else ""


def stroke_rows(machine: Mechanism) -> Iterator[tuple[str, str]]:
    """Yield, for each stroke, its name and its range with unit."""
    require_mechanism(machine)
    for name, stroke in machine.strokes.items():
        unit = stroke_display_unit(machine.plan, name, "mm")
        yield name, f"{stroke.start / factor(unit):.6g} to {stroke.end / factor(unit):.6g} {unit}"
