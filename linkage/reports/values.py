"""Design variables and strokes with their values, in the units an engineer reads them in."""

from __future__ import annotations

import inspect
import re
from collections.abc import Iterator
from dataclasses import is_dataclass

import numpy as np

from ..errors import is_listed
from ..language import said
from ..loads import ForceElement, TwoPoint
from ..mechanism import Mechanism, require_mechanism
from ..motion import stroke_display_unit
from ..plan import Plan, plan_measure
from ..quantities import Member, is_number
from ..units import display_unit, show, shown_number, unit_sign

STEPS = ("length", "angle")  # kinds of variables that a step's label makes


def dimension_unit(machine: Mechanism, name: str) -> str:
    """Return the unit that a design variable is given in, else the display unit of its kind."""
    return machine.plan.table.entries[name].unit or display_unit(plan_measure(machine.plan, name), "mm")


def design_rows(machine: Mechanism) -> Iterator[tuple[str, str, str]]:
    """Yield, for each design variable, its name, its value with unit, and the step that has it, or that it is not given."""
    require_mechanism(machine)
    for name, value in machine.dimensions.items():
        entry = machine.plan.table.entries[name]
        unit = dimension_unit(machine, name)
        low, high = show(float(np.min(value)), unit), show(float(np.max(value)), unit)
        note = entry.where if entry.kind in STEPS else said("not given") if is_left_out(machine, name) else ""
        yield name, low if low == high else said("{low} to {high}", low=low, high=high), note


def stroke_rows(machine: Mechanism) -> Iterator[tuple[str, str]]:
    """Yield, for each stroke, its name and its range with unit."""
    require_mechanism(machine)
    for name, stroke in machine.strokes.items():
        unit = stroke_display_unit(machine.plan, name, "mm")
        yield name, said("{low} to {high}", low=shown_number(stroke.start, unit), high=show(stroke.end, unit))


DIGITS = 7
"""The digits of a number as it is declared."""
LONG = re.compile(r"\d+\.\d{7,}(?:e[-+]?\d+)?")
"""A number with more of them."""
PLACE = re.compile(r"(?<=, )at=\((-?[\d.e-]+), (-?[\d.e-]+)\)")
"""A place on a link [m]."""
PARAMETER = re.compile(r"(, |(?<![\w.]))(\w+)=(-?\d+(?:\.\d*)?(?:e[-+]?\d+)?)(?=[,)])")
"""A number by itself; one in an expression keeps its SI, as the names beside it have no unit there."""


def with_units(plan: Plan, name: str, text: str) -> str:
    """Return how a member is declared, the numbers of an element in the units that they are shown in, `pressure=180 bar`.

    None is left as it is. Strokes at which a line is filled have the strokes' units, cylinders' lengths a length's.
    """
    element = plan.members[name]
    if not isinstance(element, ForceElement):
        return in_digits(text)
    strokes = {each: stroke_display_unit(plan, each, "mm") for each in plan.strokes}
    alone = {"at": next(iter(strokes.values()))} if len(strokes) == 1 else {}
    own = {name: unit for name, unit in number_units(element).items() if unit}
    units = dict.fromkeys(plan.of_kind(TwoPoint), "mm") | strokes | alone | own
    defaults = {each: parameter.default for each, parameter in inspect.signature(type(element)).parameters.items()}

    def shown(found: re.Match[str]) -> str:
        comma, name, value = found[1], found[2], float(found[3])
        if comma and name in element.numbers and is_number(defaults.get(name)) and value == float(defaults[name]):
            return ""
        return f"{comma}{name}={show(value, units[name])}" if units.get(name) else f"{comma}{name}={value:.{DIGITS}g}"

    def placed(found: re.Match[str]) -> str:  # along and across a link
        return f"at=({', '.join(shown_number(float(each), 'mm') for each in found.groups())}) {unit_sign('mm')}"

    return in_digits(PLACE.sub(placed, PARAMETER.sub(shown, text)))


def number_units(element: object) -> dict[str, str]:
    """Return the display units of an element's numbers, and of its parts', such as a tank on a line."""
    found: dict[str, str] = {}
    for value in vars(element).values():
        for each in value if is_listed(value) else (value,):
            if is_dataclass(each) and not isinstance(each, type) and not (isinstance(each, Member) and each.name):
                found |= number_units(each)
    return found | dict(getattr(element, "numbers", getattr(element, "parameters", {})))


def in_digits(text: str) -> str:
    """Return a declaration whose numbers have DIGITS digits at the most."""
    return LONG.sub(lambda found: f"{float(found[0]):.{DIGITS}g}", text)


def is_left_out(machine: Mechanism, name: str) -> bool:
    """Return whether a number of an element is zero since the element is declared without it, as a pump's flow may be."""
    owner, _, own = name.rpartition(".")
    kind = type(machine.plan.members.get(owner))
    return issubclass(kind, ForceElement) and getattr(kind, own, None) == 0.0 and not np.any(machine.dimensions[name])
