"""`--set` and `--at`: design variables and strokes as text, checked against what they measure."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from ..errors import DefinitionError, unknown
from ..mechanism import Mechanism
from ..motion import Column, Motion, stroke_unit
from ..plan import Plan, plan_measure
from ..reports import NOTHING, At, results, run_of
from ..units import parse


def design(machine: type[Mechanism], texts: Sequence[str]) -> Mechanism:
    """Return a design of a machine under settings such as `OB=180mm`; DefinitionError for what is unknown or unfit."""
    return machine(**dict(parsed_setting(machine.plan, text) for text in texts))


def parsed_setting(plan: Plan, text: str) -> tuple[str, Any]:
    """Return a setting as a name and its SI value; a point's value is a pair."""
    name, value = pair(text, "--set", "OB=180mm")
    if name in plan.table.spellings:
        return name, si_value(value, plan_measure(plan, plan.table.spellings[name][0]), f"--set {name}")
    if f"{name}.x" in plan.table.spellings or f"{name}.y" in plan.table.spellings:
        return name, point_setting(name, value)
    if name in plan.strokes:
        raise DefinitionError(f"--set {text}: {name} is a stroke of {plan.title}, not a dimension; `table` takes --at {text}.")
    plan.table.settings({name: 0.0})
    raise unknown("Dimension", name, plan.table.names(), where=plan.title)


def point_setting(name: str, text: str) -> tuple[float, ...]:
    """Return a point's two coordinates [m]."""
    parts = text.split(",")
    if len(parts) != 2:
        example = f"{name}=0.22,950mm; decimals are written with a point"
        raise DefinitionError(f"--set {name}={text}: a point takes two coordinates, such as {example}.")
    return tuple(si_value(part, "length", f"--set {name}") for part in parts)


def pair(text: str, option: str, example: str) -> tuple[str, str]:
    """Return both sides of `name=value`."""
    name, equals, value = (part.strip() for part in text.partition("="))
    if not (equals and name and value):
        raise DefinitionError(f"{option} {text}: write a name and a value, such as {option} {example}.")
    return name, value


def si_value(text: str, kind: str, what: str) -> float:
    """Return the SI value of a text that measures `kind`."""
    try:
        return parse(text, kind)
    except DefinitionError as error:
        raise DefinitionError(f"{what}: {error}") from None


def motion_at(machine: Mechanism, texts: Sequence[str], count: int) -> Motion:
    """Return the motion at strokes such as `S=0.6,650mm`; those not given go over their range at `count` poses.

    Several that take more than one value make a grid.
    """
    given = dict(stroke_values(machine.plan, text) for text in texts)
    axes = {name: given.get(name, np.linspace(stroke.start, stroke.end, count)) for name, stroke in machine.strokes.items()}
    many = {name: axis for name, axis in axes.items() if len(axis) > 1 or name not in given}
    grids = dict(zip(many, np.meshgrid(*many.values(), indexing="ij"), strict=True)) if many else {}
    return machine.at(**{name: grids.get(name, axis[0]) for name, axis in axes.items()})


def motion_along(machine: Mechanism, count: int, at: At = NOTHING) -> Motion:
    """Return the motion along one stroke or several together, the others held as `at` says, else in their middle.

    Raises AssemblyError where it cannot be assembled; a picture would leave those poses out.
    """
    return machine.at(**run_of(machine, at).over(np.linspace(0.0, 1.0, count)))


def stroke_values(plan: Plan, text: str) -> tuple[str, Any]:
    """Return a stroke's name and its values, shape (n,) [m or rad]."""
    name, values = pair(text, "--at", "S=0.6,650mm")
    if name not in plan.strokes:
        raise unknown("Stroke", name, plan.strokes, where=plan.title)
    kind = "angle" if stroke_unit(plan, name) == "rad" else "length"
    return name, np.array([si_value(value, kind, f"--at {name}") for value in values.split(",")])


def columns_picked(machine: Mechanism, motion: Motion, names: Sequence[str], strokes: Sequence[str]) -> list[Column]:
    """Return the columns of some names, in their order, after the strokes'; all where none is named."""
    plan, columns = machine.plan, results(machine, motion)
    known = {column.name: column for column in columns}
    if not known:
        raise DefinitionError(f"{plan.title} has no results: it declares no stroke, no point that moves and no output.")
    if not names:
        return columns
    for name in names:
        if name not in known:
            is_point = f" {name} is a point; `plot --path {name}` draws its path." if name in plan.points else ""
            raise DefinitionError(f"{unknown('Column', name, known, where=f'the table of {plan.title}')}{is_point}")
    return [known[name] for name in dict.fromkeys([*(name for name in strokes if name in known), *names])]


def traced_points(machine: Mechanism, names: Sequence[str] | None) -> tuple[str, ...]:
    """Return the points whose paths are drawn: those named, else those the machine is about, else the last one built."""
    return tuple(machine.featured().path) or machine.plan.moving[-1:] if names is None else tuple(names)
