"""What a part of a machine has in a motion of the whole: its design and its strokes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Protocol, final

import numpy as np

from ..errors import DefinitionError, unknown
from ..plan import Part, Plan
from ..program import FloatArray
from ..quantities import FRAME_AXES, Axes, Coordinate, Number, Quantity, quantity
from ..vectors import Numbers

SAME = 1e-9
"""A dimension of a part changes over the poses where it does by more than this, over its size or 1."""


class WholeMotion(Protocol):
    """The motion of a machine, as far as its parts ask it."""

    plan: Plan
    shape: tuple[int, ...]
    _design_shape: tuple[int, ...]

    @property
    def designs(self) -> dict[str, Any]:
        """The design variables by name [SI]."""

    @property
    def inputs(self) -> dict[str, Any]:
        """Design variables and strokes by name, shaped to broadcast against results."""

    def value(self, quantity: Quantity) -> FloatArray:
        """Return a quantity [SI]."""


@final
@dataclass(frozen=True, eq=False)
class PartOfMotion:
    """What a part has at the poses of a motion: its design [SI], one value or one a design, and its strokes, of the motion's shape."""

    part: Part
    designs: dict[str, Numbers]
    strokes: dict[str, FloatArray]

    @classmethod
    def of(cls, whole: WholeMotion, name: str) -> PartOfMotion:
        """Return what a part has; DefinitionError for anything but a part, and for a dimension that changes over the poses."""
        part = whole.plan.members.get(name)
        if not isinstance(part, Part):
            raise unknown("Part", name, whole.plan.of_kind(Part), where=whole.plan.title)
        axes = part.axes(whole.plan.members)
        strokes = {each: np.array(np.broadcast_to(stroke_in(whole, f"{name}.{each}"), whole.shape)) for each in part.plan.strokes}
        return cls(part, {each: steady_dimension(whole, part, each, axes) for each in part.plan.table.entries}, strokes)


def stroke_in(whole: WholeMotion, name: str) -> FloatArray:
    """Return a part's stroke at the poses of the whole [m or rad]."""
    member = whole.plan.members[name]
    assert isinstance(member, Quantity)
    return np.asarray(whole.value(member))


def dimension_in(whole: WholeMotion, part: Part, name: str, axes: Axes | None) -> Numbers:
    """Return a design variable of a part as the whole has it [SI]: a number, or its values over designs and poses."""
    dotted, table = f"{part.name}.{name}", whole.plan.table
    point, _, axis = name.rpartition(".")
    fused = whole.plan.aliases.get(f"{part.name}.{point}", "")
    if dotted not in table.spellings and fused and axis in ("x", "y"):
        return whole.value(Coordinate(fused, axis, axes or FRAME_AXES))
    if dotted in table.spellings:
        owner, sign = table.spellings[dotted]
        return np.asarray(sign * whole.inputs[owner])
    given = part.given.get(name, Number(part.plan.defaults[name]))
    return part.plan.defaults[name] if given is None else whole.value(quantity(given))


def steady_dimension(whole: WholeMotion, part: Part, name: str, axes: Axes | None) -> Numbers:
    """Return a dimension that is the same at all poses, one value a design; DefinitionError for one that changes."""
    array = np.asarray(dimension_in(whole, part, name, axes), float)
    if array.size == 1:
        return float(array.reshape(()))
    rows = np.broadcast_to(array, whole.shape).reshape(*whole._design_shape, -1)
    first = rows[..., 0]
    if np.any(np.abs(rows - first[..., None]) > SAME * np.maximum(1.0, np.abs(first[..., None]))):
        what = f"{whole.plan.title}.{part.name}: {name} changes over the poses, so that the part alone has no such design"
        raise DefinitionError(f'{what}; ask the whole for its points, such as motion["{part.name}.{next(iter(part.plan.moving), "")}"].')
    return first if whole._design_shape else float(first)
