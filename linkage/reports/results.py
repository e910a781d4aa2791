"""A machine's table of results: its columns, the forces of its drives, and its members' columns."""

from __future__ import annotations

from collections import Counter
from collections.abc import Container, Iterator, Sequence
from dataclasses import replace
from typing import cast

import numpy as np

from ..errors import DefinitionError, LinkageError, cited, is_listed, known_name, unwarned
from ..files.expression import REQUESTS, request_function
from ..language import noted, said
from ..loads import PLAIN, PLAIN_CASE, Acting, Case, ForceElement
from ..mechanism import Mechanism, played_along, require_mechanism
from ..motion import Answer, Column, Motion, Over, Tabled, columns_of, drive_kind, least, most, require_motion, speakers, stroke_unit
from ..motion.judge import Domain, rubs
from ..motion.measures import MeasuredQuantity
from ..motion.requests import AnyRequest, may_be_unlimited, situated
from ..program import FloatArray
from ..statics import drive_force, driving_force, held_fault


def results(machine: Mechanism, motion: Motion, case: Case = None) -> list[Column]:
    """Return the columns of a machine; where it has no table of its own but loads, forces too, NaN at dead points.

    They are the generalised forces of its strokes, and what its members show: of a cylinder thrust, pressure and reserve. To a table of its
    own are added those of members that a variant of the machine declares. Of a machine that is not held there are places alone.

    Parameters
    ----------
    machine : Mechanism
        The machine.
    motion : Motion
        The poses.
    case : LoadCase or str, optional
        The load case of all columns but those of the machine's own table that do not say what asks for them. By default the one that the
        motion is shown in; "plain" are the machine's own loads.

    Returns
    -------
    list of Column
        The columns.
    """
    require_mechanism(machine)
    require_motion(motion)
    case = case_along(motion) if case is None else None if case == PLAIN_CASE else case
    is_held = not held_fault(motion)
    columns = columns_by(machine, motion) if is_held else columns_of(motion)
    if not is_held or not is_loaded(motion):
        return columns
    whole = motion._with_gaps()
    if case is not None:
        for place, column in enumerate(columns):
            own = request_in_case(column.request, case)
            if own is not None and own is not column.request:
                columns[place] = replace(column, values=whole[own])
    taken = {column.name for column in columns}
    owner = type(machine)._owner("columns")
    is_own = owner is not Mechanism
    further = member_columns(whole, case, beside=owner.plan.members if is_own else ())
    return columns + [column for column in [*([] if is_own else drive_columns(whole, case)), *further] if column.name not in taken]


def case_along(motion: Motion) -> Case:
    """Return the load case that a motion is shown in: None, the machine's own loads, where these occur; else the worst case there.

    The `Over` that a motion was swept over names the cases; of any other motion the `Over`s of its machine do.
    """
    declared = [motion.over] if motion.is_swept else [*motion.plan.of_kind(Over).values()]
    cases = [PLAIN_CASE if each.cases is None else each.cases for each in declared] or [PLAIN_CASE]
    if any(PLAIN_CASE in each for each in cases):
        return None
    if len(cases[0]) == 1 or motion._design_shape:
        return cases[0][0]
    machine, _ = played_along(motion, None)
    return case_shown(machine, machine.judge(declared[0]).places[0])


def case_shown(machine: Mechanism, place: Domain, acting: Acting = PLAIN) -> Case:
    """Return the load case that an `Over` is shown in: the one asked for, else the machine's own loads, else the worst of those there."""
    cases = place.cases(PLAIN)
    case = (None if PLAIN_CASE in cases else cases[0]) if acting.case is None else acting.case
    if case is not None and acting.case is None and len(cases) > 1:
        _, answer = worst_answer(machine, machine.at(unreachable="nan", **place.motion.strokes), place, acting)
        case = case if answer is None else answer.case or case
    return None if case == PLAIN_CASE else case


def worst_answer(machine: Mechanism, motion: Motion, place: Domain, acting: Acting) -> tuple[str, Answer | None]:
    """Return the column that a machine is about, as it changes over a motion, and where it is worst over an `Over`; "" and None for none.

    Its worst side is that of its limit; of what may be without a limit, such as a reserve, the least; else the greater in size: a cylinder
    pulls as hard as it pushes.
    """
    with unwarned():
        try:
            column = column_among(machine, results(machine, motion, PLAIN_CASE), None)
            if column.request is None:
                return "", None
            limit = tuple(machine.featured().limits.get(column.name, ()))
            sides = (least,) if may_be_unlimited(column.request) else (most, least)
            if limit:
                sides = (least,) if limit[2:] == ("below",) else (most,)
            asked = [side(cast(MeasuredQuantity, column.request)) for side in sides]
            answers = machine.judge(place.over, acting).lost_allowed().answers(asked)
            return column.name, max(answers, key=lambda answer: np.nan_to_num(abs(answer.value), nan=-1.0))
        except LinkageError:
            return "", None


def request_in_case(request: AnyRequest, case: Case) -> AnyRequest:
    """Return a request in a load case."""
    return situated(request, Acting(case=case))


def columns_about(machine: Mechanism, found: Sequence[Column]) -> list[str]:
    """Return the names of those columns of results that a machine is about: its own one, and those with limits."""
    names = {column.name for column in found}
    return [name for name in dict.fromkeys([column_among(machine, found, None).name, *machine.featured().limits]) if name in names]


def column_among(machine: Mechanism, found: Sequence[Column], name: str | None) -> Column:
    """Return a column of results by name; without one, the featured column if it changes, else the last that does."""
    columns = {column.name: column for column in found if column.name not in machine.strokes}
    if name is None and columns:
        moving = [each for each, column in columns.items() if is_changing(column.drawn)]
        about = machine.featured().column
        return columns[about if about in moving else (moving or list(columns))[-1]]
    return columns[known_name("Column", name, columns, where=machine.plan.title)]


CONSTANT = 1e-6
"""Of the greatest value: values that differ by no more stay as they are."""


def is_changing(values: FloatArray) -> bool:
    """Return whether values differ by more than rounding."""
    finite = values[np.isfinite(values)]
    return finite.size > 0 and bool(np.ptp(finite) > CONSTANT * np.abs(finite).max())


def columns_by(machine: Mechanism, motion: Motion) -> list[Column]:
    """Return the columns that a machine makes; DefinitionError where its own `columns` gives something else."""
    found = machine.columns(motion)
    if not is_listed(found) or not all(isinstance(each, Column) for each in found):
        said = f"columns(motion) gives {cited(found)}; a list of Column(name, values, unit) is expected"
        raise DefinitionError(f"{machine.plan.title}: {said}.")
    return list(found)


def force_columns(motion: Motion, case: Case = None, direction: str | None = None) -> list[Column]:
    """Return the generalised forces of a motion's strokes and its members' columns, in a load case, while it moves in a direction.

    Nothing where nothing acts; NaN at dead points. The direction is of the stroke in its forces, of each cylinder in what is its own.
    """
    if not is_loaded(require_motion(motion)):
        return []
    whole = motion._with_gaps()
    return [*drive_columns(whole, case, direction), *member_columns(whole, case, direction)]


def friction_of_columns(motion: Motion, columns: Sequence[Column], direction: str | None = None) -> str:
    """Return in words which columns count friction where no direction is asked for; "" without friction, and of a motion in time."""
    judged = any(column.name.partition(" ")[0] in ("pressure", "reserve", "capacity") for column in columns)
    if direction is not None or motion.time is not None or not judged or not rubs(motion.plan, motion, PLAIN):
        return ""
    return said("Forces and thrusts are without friction; the pressure and the reserve of a cylinder are with it, while it extends.")


def rate_columns(motion: Motion) -> list[Column]:
    """Return how fast the strokes of a motion in time go, and how that changes; nothing of any other motion."""
    units = {name: {"m": "m/s", "rad": "rad/s"}.get(stroke_unit(motion.plan, name), "") for name in motion.strokes}
    rates = [Column(f"{noted('rate')} {name}", value, units[name]) for name, value in motion.rates.items()]
    second = {name: unit and f"{unit}2" for name, unit in units.items()}
    return rates + [Column(f"{noted('acceleration')} {name}", value, second[name]) for name, value in motion.accelerations.items()]


def is_loaded(motion: Motion) -> bool:
    """Return whether anything acts on a machine."""
    return any(element.loads(motion) for element in motion.plan.of_kind(ForceElement).values())


def drive_columns(motion: Motion, case: Case = None, direction: str | None = None) -> Iterator[Column]:
    """Yield the generalised force of each stroke under the machine's own loads: of a length [N], of an angle [Nm], of oil [Pa]."""
    for name in motion.strokes:
        what = noted("torque") if stroke_unit(motion.plan, name) == "rad" else noted("drive force")
        unit = drive_kind(motion.plan, name)[1]
        force = driving_force(motion, drive=name, case=case, direction=direction)
        title, digits = what if len(motion.strokes) == 1 else f"{what} {name}", 2 if unit == "Nm" else 4
        yield Column(title, force, unit, digits, request=drive_force(name, case=case) if direction is None else None)


def member_columns(motion: Motion, case: Case = None, direction: str | None = None, *, beside: Container[str] = ()) -> Iterator[Column]:
    """Yield the columns of the members that have some, with their names where several members have the same; not of those `beside`."""
    members = {name: member for name, member in speakers(motion.plan, Tabled).items() if name not in beside}
    found = [(name, column) for name, member in members.items() for column in member.columns_in(motion, case, direction)]
    if case is None and direction is None:
        found = [(name, asked_by_name(name, column)) for name, column in found]
    count, kinds = Counter(column.name for _, column in found), Counter(map(type, members.values()))
    for name, column in found:
        alone = count[column.name] == kinds[type(members[name])] == 1
        yield column if alone else replace(column, name=f"{column.name} {name}")


def asked_by_name(member: str, column: Column) -> Column:
    """Return a member's column with its request: that of the column's name, of the member, where there is one."""
    if column.request is not None or column.name not in REQUESTS:
        return column
    return replace(column, request=request_function(column.name)(member))
