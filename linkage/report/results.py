"""A machine's table of results: its columns, and what its drives must do."""

from __future__ import annotations

from collections.abc import Iterator

from ..loads import ForceElement
from ..mechanism import Mechanism
from ..motion import Column, Motion, stroke_unit
from ..statics import driving_force


def results(machine: Mechanism, motion: Motion) -> list[Column]:
    """Return the columns of a machine; where it has no table of its own but loads, the forces of its drives too, NaN at dead points."""
    columns = machine.columns(motion)
    if type(machine).columns is not Mechanism.columns:
        return columns
    taken = {column.name for column in columns}
    return columns + [column for column in drives(motion) if column.name not in taken]


def drives(motion: Motion) -> Iterator[Column]:
    """Yield the thrust of each cylinder stroke [N] and the torque of each crank [Nm] under the machine's own loads, without friction."""
    if not any(element.loads(motion) for element in motion.plan.of_kind(ForceElement).values()):
        return
    whole = motion.moved(motion.strokes)
    for name in motion.strokes:
        what, unit = ("torque", "Nm") if stroke_unit(motion.plan, name) == "rad" else ("thrust", "kN")
        yield Column(what if len(motion.strokes) == 1 else f"{what}_{name}", driving_force(whole, drive=name), unit)
