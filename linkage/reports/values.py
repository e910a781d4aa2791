"""Design variables and strokes with their values, in the units an engineer reads them in."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ..language import said
from ..mechanism import Mechanism, require_mechanism
from ..motion import stroke_display_unit
from ..plan import plan_measure
from ..units import display_unit, show, shown_number

STEPS = ("length", "angle")  # kinds of variables that a step's label makes


def dimension_unit(machine: Mechanism, name: str) -> str:
    """Return the unit that a design variable is given in, else the display unit of its kind."""
    return machine.plan.table.entries[name].unit or display_unit(plan_measure(machine.plan, name), "mm")


def design_rows(machine: Mechanism) -> Iterator[tuple[str, str, str]]:
    """Yield, for each design variable, its name, its value with unit, and the step that has it; a batch shows its range."""
    require_mechanism(machine)
    for name, value in machine.dimensions.items():
        entry = machine.plan.table.entries[name]
        unit = dimension_unit(machine, name)
        low, high = show(float(np.min(value)), unit), show(float(np.max(value)), unit)
        yield name, low if low == high else said("{low} to {high}", low=low, high=high), entry.where if entry.kind in STEPS else ""


def stroke_rows(machine: Mechanism) -> Iterator[tuple[str, str]]:
    """Yield, for each stroke, its name and its range with unit."""
    require_mechanism(machine)
    for name, stroke in machine.strokes.items():
        unit = stroke_display_unit(machine.plan, name, "mm")
        yield name, said("{low} to {high}", low=shown_number(stroke.start, unit), high=show(stroke.end, unit))
