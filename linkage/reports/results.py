"""A machine's table of results: its columns, what its drives must do, and what its members show."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import replace

from ..errors import DefinitionError, cited
from ..files.callables import REQUESTS, brought, request_function
from ..loads import ForceElement
from ..mechanism import Mechanism, require_mechanism
from ..motion import Column, Motion, Tabled, require_motion, stroke_unit
from ..statics import drive_force, driving_force


def results(machine: Mechanism, motion: Motion) -> list[Column]:
    """Return the columns of a machine; where it has no table of its own but loads, forces too, NaN at dead points.

    They are the generalised forces of its strokes, and what its members show: of a cylinder its thrust and its pressure.
    """
    require_mechanism(machine)
    require_motion(motion)
    columns = columns_by(machine, motion)
    if type(machine).columns is not Mechanism.columns:
        return columns
    if not any(element.loads(motion) for element in motion.plan.of_kind(ForceElement).values()):
        return columns
    whole = motion.moved(motion.strokes)
    taken = {column.name for column in columns}
    return columns + [column for column in (*drive_columns(whole), *member_columns(whole)) if column.name not in taken]


def columns_by(machine: Mechanism, motion: Motion) -> list[Column]:
    """Return the columns that a machine makes; DefinitionError where its own `columns` gives something else."""
    found = machine.columns(motion)
    if not isinstance(found, (list, tuple)) or not all(isinstance(each, Column) for each in found):
        said = f"columns(motion) gives {cited(found)}; a list of Column(name, values, unit) is expected"
        raise DefinitionError(f"{machine.plan.title}: {said}.")
    return list(found)


def drive_columns(motion: Motion) -> Iterator[Column]:
    """Yield the generalised force of each stroke under the machine's own loads, without friction: of a length [N], of an angle [Nm]."""
    for name in motion.strokes:
        what, unit = ("torque", "Nm") if stroke_unit(motion.plan, name) == "rad" else ("drive force", "kN")
        yield Column(
            what if len(motion.strokes) == 1 else f"{what} {name}", driving_force(motion, drive=name), unit, request=drive_force(name)
        )


def member_columns(motion: Motion) -> Iterator[Column]:
    """Yield the columns of the members that have some, with their names where several members have the same."""
    members = motion.plan.of_kind(Tabled).items()
    found = [(name, asked_by_name(name, column)) for name, member in members for column in member.columns(motion)]
    count = Counter(column.name for _, column in found)
    for name, column in found:
        yield column if count[column.name] == 1 else replace(column, name=f"{column.name} {name}")


def asked_by_name(member: str, column: Column) -> Column:
    """Return a member's column with what it is asked for by: the request of the column's name, of the member, where there is one."""
    if column.request is not None or not (column.name in REQUESTS or column.name in brought()):
        return column
    return replace(column, request=request_function(column.name)(member))
