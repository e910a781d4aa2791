"""What a design variable or a stroke measures, by its unit, its label, or what it is added to."""

from __future__ import annotations

from collections.abc import Mapping

from ..units import Amount, amounts_in, require_measure
from .plan import Plan


def plan_measure(plan: Plan, variable: str) -> str:
    """Return what a design variable measures ("length", "angle", "pressure", ...); "" where nothing says so.

    A dimension without a unit of its own measures what it is added to: `L0` in `AB=L0 + S` is a length.
    """
    found = plan.table.entries[variable].measures
    if found:
        return found
    if any(variable in plan.terms(length) for length in plan.table.lengths.values()):
        return "length"
    return "angle" if variable in plan.turning else ""


def require_kinds(plan: Plan, given: Mapping[str, object]) -> None:
    """Refuse amounts of another kind than the strokes and dimensions measure that they are given for, by name; see `require_kind`."""
    for name, value in given.items():
        if isinstance(value, (Amount, list, tuple)):  # arrays and plain numbers know nothing
            require_kind(plan, name, value, f"{plan.title}: {name}")


def require_kind(plan: Plan, name: str, value: object, what: str) -> None:
    """Refuse an amount of another kind than a dimension, a fixed point or a stroke of a machine measures.

    Parameters
    ----------
    plan : Plan
        What the machine is made of.
    name : str
        The name of a dimension, of a fixed point, whose coordinates are lengths, or of a stroke; any other one passes.
    value : object
        What was given for it, or several values in a list or a tuple.
    what : str
        What it was given for, for the message: `Arm: S`.

    Raises
    ------
    DefinitionError
        An amount measures something else. A plain number is SI, whatever was meant.
    """
    if next(amounts_in(value), None) is None:
        return
    if name in plan.strokes:
        kind = plan.known_stroke_kind(name)
    else:
        spelling = name if name in plan.table.spellings else f"{name}.x"
        kind = plan_measure(plan, plan.table.spellings[spelling][0]) if spelling in plan.table.spellings else ""
    if kind:
        require_measure(value, kind, what)
