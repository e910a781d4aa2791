"""The table of a motion's results: strokes, moving points, named outputs."""

from __future__ import annotations

from ..quantities import Dimension, Quantity, Stroke
from .column import Column
from .motion import Motion, require_motion
from .reach import stroke_unit

SHOWN = {"angle": "deg", "length": "m", "": ""}


def columns_of(motion: Motion) -> list[Column]:
    """Return the strokes, the coordinates of the points that move, and the named outputs of a motion, a column each."""
    require_motion(motion)
    plan = motion.plan
    table = [Column(name, value, "deg" if stroke_unit(plan, name) == "rad" else "m") for name, value in motion.strokes.items()]
    table += [Column(f"{point}_{axis}", getattr(motion, axis)(point), "m") for point in plan.moving for axis in "xy"]
    outputs = {name: member for name, member in plan.of_kind(Quantity).items() if not isinstance(member, (Stroke, Dimension))}
    return table + [Column(name, motion[name], SHOWN[member.measures]) for name, member in outputs.items()]
