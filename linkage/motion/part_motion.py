"""What a part of a machine has in a motion of the whole: its design and its strokes."""

from __future__ import annotations

import numpy as np

from ..errors import DefinitionError, unknown
from ..plan import Part
from ..program import FloatArray
from ..quantities import FRAME_AXES, Axes, Coordinate, Number, quantity
from ..vectors import Numbers
from .grid import MotionLike

SAME = 1e-9
"""A dimension of a part changes over the poses where it does by more than this, over its size or 1."""


def part_at_poses(whole: MotionLike, name: str) -> tuple[Part, dict[str, Numbers], dict[str, FloatArray]]:
    """Return a part, its design at the poses of a motion [SI], one value or one a design, and its strokes, of the motion's shape.

    DefinitionError for anything but a part, and for a dimension that changes over the poses.
    """
    part = whole.plan.members.get(name)
    if not isinstance(part, Part):
        raise unknown("Part", name, whole.plan.of_kind(Part), where=whole.plan.title)
    axes = part.axes(whole.plan.members)
    strokes = {each: np.array(np.broadcast_to(whole[f"{name}.{each}"], whole.shape)) for each in part.plan.strokes}
    return part, {each: steady_dimension(whole, part, each, axes) for each in part.plan.table.entries}, strokes


def steady_dimension(whole: MotionLike, part: Part, name: str, axes: Axes | None) -> Numbers:
    """Return a design variable of a part as the whole has it [SI], one value a design; DefinitionError for one that changes."""
    dotted, table = f"{part.name}.{name}", whole.plan.table
    point, _, axis = name.rpartition(".")
    fused, given = whole.plan.aliases.get(f"{part.name}.{point}", ""), part.given.get(name, Number(part.plan.defaults[name]))
    if dotted in table.spellings:
        owner, sign = table.spellings[dotted]
        array = np.asarray(sign * whole.inputs[owner], float)
    elif fused and axis in ("x", "y"):
        array = whole.value(Coordinate(fused, axis, axes or FRAME_AXES))
    else:
        array = np.asarray(part.plan.defaults[name] if given is None else whole.value(quantity(given)), float)
    if array.size == 1:
        return float(array.reshape(()))
    rows = np.broadcast_to(array, whole.shape).reshape(*whole._design_shape, -1)
    first = rows[..., 0]
    if np.any(np.abs(rows - first[..., None]) > SAME * np.maximum(1.0, np.abs(first[..., None]))):
        what = f"{whole.plan.title}.{part.name}: {name} changes over the poses, so that the part alone has no such design"
        raise DefinitionError(f'{what}; ask the whole for its points, such as motion["{part.name}.{next(iter(part.plan.moving), "")}"].')
    return first if whole._design_shape else float(first)
