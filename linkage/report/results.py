"""A machine's table of results: its columns, what its drives must do, and what its members show."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import replace

from ..loads import ForceElement
from ..mechanism import Mechanism
from ..motion import Column, Motion, Tabled, stroke_unit
from ..statics import driving_force


def results(machine: Mechanism, motion: Motion) -> list[Column]:
    """Return the columns of a machine; where it has no table of its own but loads, forces too, NaN at dead points.

    They are the generalised forces of its strokes, and what its members show: of a cylinder its thrust and its pressure.
    """
    columns = machine.columns(motion)
    if type(machine).columns is not Mechanism.columns:
        return columns
    if not any(element.loads(motion) for element in motion.plan.of_kind(ForceElement).values()):
        return columns
    whole = motion.moved(motion.strokes)
    taken = {column.name for column in columns}
    return columns + [column for column in (*drives(whole), *shown(whole)) if column.name not in taken]


def drives(motion: Motion) -> Iterator[Column]:
    """Yield the generalised force of each stroke under the machine's own loads, without friction: of a length [N], of an angle [Nm]."""
    for name in motion.strokes:
        what, unit = ("torque", "Nm") if stroke_unit(motion.plan, name) == "rad" else ("drive force", "kN")
        yield Column(what if len(motion.strokes) == 1 else f"{what} {name}", driving_force(motion, drive=name), unit)


def shown(motion: Motion) -> Iterator[Column]:
    """Yield the columns of the members that have some, with their names where several members have the same."""
    found = [(name, column) for name, member in motion.plan.of_kind(Tabled).items() for column in member.columns(motion)]
    count = Counter(column.name for _, column in found)
    for name, column in found:
        yield column if count[column.name] == 1 else replace(column, name=f"{column.name} {name}")
