"""Forces of drives, members and pins: over all that the machine runs, in each load case, and blocked at the relief valve's pressure."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import product
from math import cos, sin

import numpy as np
from numpy.typing import NDArray

from ..errors import LinkageError, ensure, unwarned
from ..frozen import record
from ..language import noted, said, translated
from ..loads import PLAIN_CASE, Acting, Force, TwoPoint
from ..motion import Column, Motion, Request, drive_kind, least, most, places_text, stroke_unit
from ..plan import Plan
from ..plan.members import FRAME
from ..program import FloatArray
from ..statics import JointForce, PinForces, PinLoad, drive_force, held_in_case, holders_of, judged_table, pin_forces, thrust_from_forces
from ..units import factor, show, shown_in, shown_number, unit_sign
from .calculation import has_loads
from .content import Block, Section, TableBlock
from .outcome import amount_text, figures
from .run import ReportSubject, largest

KINDS = (noted("pin"), noted("guide"), noted("slot"), noted("driven point"), noted("crank's drive"), noted("slider"), noted("telescope"))
DIRECTIONS = (noted("frictionless"), noted("extending"), noted("retracting"), noted("as it runs"), noted("own loads"))
"""The words of joints, of directions and of the plain load case, as results have them."""


def forces_section(subject: ReportSubject) -> Section | None:
    """Return the section of driving forces and of the largest force of every joint, over cases and directions; None without loads."""
    title, plan = said("Forces in drives and pins"), subject.machine.plan
    if not has_loads(subject.machine):
        return None
    try:
        found = subject.forces
        with unwarned():
            cases = rows_of_cases(subject)
            rows = worst_rows(subject, cases) or judged_table(subject.judge)
            ranges = tuple(drive_rows(subject))
    except LinkageError as error:
        return Section(title, (said("The joint forces are not calculated: {why}", why=str(error)),))
    looks = said(
        "The largest force of each joint over all that the machine runs, between the poses of the tables too, over load cases and "
        "directions of motion. Fx and Fy act on the body, in its own axes: x from the first of the named points to the second, y to "
        "its left. On the frame they are in the axes of the drawing."
    )
    unit = unit_sign("kN")
    parts = said("Fx, {unit}", unit=unit), said("Fy, {unit}", unit=unit), said("F, {unit}", unit=unit)
    heads = (*joint_heads(), *parts, said("x axis"), said("situation and place"))
    cells = [
        (*joint_cells(plan, row), *(force_cell(row, way) for way in (cos, sin)), force_cell(row), row.axis,
         f"{translated(row.case)}, {row.movement}, {row.place}")
        for row in rows
    ]  # fmt: skip
    table = TableBlock(said("Largest pin forces, for FEM"), heads, tuple(cells), "llllrrrlm")
    ends = said("least"), said("situation and place"), said("greatest"), said("situation and place")
    drives = (said("drive or component"), said("unit"), *ends)
    forces = [TableBlock(said("Driving forces and thrusts, over all that the machine runs"), drives, ranges, "llrmrm")] if ranges else []
    blocks: list[Block] = [*forces, looks, table]
    for case, own in cases.items():
        words = subject.case_words(case)
        if isinstance(own, LinkageError):
            blocks.append(said("Load case {case}: {why}", case=words, why=str(own)))
            continue
        in_case = tuple((*joint_cells(plan, row), force_cell(row), row.place, row.movement) for row in own)
        heads = (*joint_heads(), parts[-1], said("strokes"), said("motion"))
        blocks.append(TableBlock(said("Largest pin forces, load case {case}", case=words), heads, in_case, "llllrml"))
    return Section(title, (*blocks, *blocked_blocks(subject), *dict.fromkeys(remark for one in found for remark in one.remarks)))


def joint_heads() -> tuple[str, ...]:
    """Return the headings of `joint_cells`."""
    return said("pin"), said("joint"), said("on body"), said("from body")


def joint_cells(plan: Plan, row: PinLoad | JointForce) -> tuple[str, ...]:
    """Return which joint a row is of, as cells."""
    return row.point, translated(row.kind), body_words(plan, row.on), body_words(plan, row.by)


def force_cell(row: PinLoad, way: Callable[[float], float] | None = None) -> str:
    """Return the size of a force as a cell, or its part by the cosine or sine of its direction; a couple alone has a size and its unit."""
    if not row.has_force:
        return "" if way else show(row.force, "Nm")
    return figures(row.force * (way(row.angle) if way else 1.0) / factor(shown_in("kN"))) if np.isfinite(row.force) else "∞"


def body_words(plan: Plan, name: str) -> str:
    """Return a body's name, that of the link that it is, the frame's in the language that is spoken."""
    return said("frame") if name.partition(" ")[0] == FRAME else plan.link_names.get(name, name)


def drive_rows(subject: ReportSubject) -> Iterator[tuple[str, ...]]:
    """Yield the least and the greatest force of every drive and thrust of every member, in which situation and where.

    Thrusts that members show of themselves stand with these, and so do drives that are held by one of them.
    """
    shown, asked = thrusts_shown(subject), drives_asked(subject)
    requests = [*shown.values(), *(request for _, request, _ in asked)]
    answers = subject.judge.answers([end(each) for each in requests for end in (least, most)])
    ends = [(float(low.value), float(high.value)) for low, high in zip(answers[::2], answers[1::2], strict=True)]
    drives = slice(len(shown), len(shown) + len(subject.forces[0].drives))
    for k, (name, _, unit) in enumerate(asked, len(shown)):
        low, high = answers[2 * k : 2 * k + 2]
        others = ends[: len(shown)] if k < drives.stop else ends[drives]
        if np.isnan(low.value) or any(np.allclose(ends[k], each, rtol=SAME, atol=0.0) for each in others):
            continue
        column = Column("force", np.zeros(1), unit, 3)  # no column of a table, as the name of its stroke may be
        yield name, unit_sign(unit), amount_text(subject, low, column), low.place, amount_text(subject, high, column), high.place


def thrusts_shown(subject: ReportSubject) -> dict[str, Request]:
    """Return the thrusts that members show of themselves, by their names."""
    thrusts = {name: column.request for name, column in subject.member_columns if column.name == "thrust"}
    return {name: request for name, request in thrusts.items() if isinstance(request, Request)}


def drives_asked(subject: ReportSubject) -> list[tuple[str, Request, str]]:
    """Return the forces of the drives, then the thrusts that no member shows of itself, each with its name and unit."""
    one, plan, members = subject.forces[0], subject.machine.plan, thrusts_shown(subject)
    drives = [(name, drive_force(name), drive_kind(plan, name)[1]) for name in one.drives]
    others = [(said("thrust of {name}", name=name), thrust_from_forces(name), "kN") for name in one.thrusts if name not in members]
    return [*drives, *others]


SAME = 1e-9
"""Of a force: a drive whose ends are those of a thrust to this share is that thrust."""


# The pins in each load case by itself, where there are several.


def rows_of_cases(subject: ReportSubject) -> dict[str, Sequence[PinLoad] | LinkageError]:
    """Return the largest force of each joint in each load case by itself, or why there is none; nothing where there is one case only."""
    cases, found = subject.judge.cases, dict[str, Sequence[PinLoad] | LinkageError]()
    for case in cases if len(cases) > 1 else ():
        places = [place.over for place in subject.judge.places if case in place.cases(subject.judge.acting)]
        try:
            with unwarned():
                found[case] = judged_table(subject.machine.judge(places, replace(subject.judge.acting, case=case)).lost_allowed())
        except LinkageError as error:
            found[case] = error
    return found


def worst_rows(subject: ReportSubject, cases: Mapping[str, Sequence[PinLoad] | LinkageError]) -> list[PinLoad]:
    """Return the largest force of each joint over all load cases, of a tie that of the first `Over`; nothing where a case has none."""
    titles = [place.over.name for place in subject.judge.places]
    worst: dict[tuple[str, str, str, str], PinLoad] = {}
    for rows in cases.values():
        if isinstance(rows, LinkageError):
            return []
        for row in rows:
            over = row.answer.over if row.answer is not None else ""
            mine = replace(row, over=over if len(titles) > 1 else "")
            key = (row.point, row.on, row.by, row.kind)
            best = worst.setdefault(key, mine)
            is_tie = abs(best.force - mine.force) <= SAME * best.force
            if (mine.force > best.force and not is_tie) or (is_tie and titles.index(over) < titles.index(best.over or titles[0])):
                worst[key] = mine
    return [*worst.values()]


# Blocked: a point held fast against a stop, a cylinder pushes or pulls with what its relief valve lets through.


@record
class Blocked:
    """The largest force of a joint while the machine is blocked.

    One cylinder presses. The relief valve of one opens.
    """

    cells: tuple[str, ...]
    force: float
    cylinder: str
    pushes: bool
    opens: str
    case: str
    strokes: Mapping[str, float]


STILL = 1e-4
"""Of the greatest thrust that a stop answers to: where it answers to less, the point stands still and stops nothing."""


NEAR = 1e-9
"""Of the greatest force: of the places that have it to this share the first one counts."""


def blocked_blocks(subject: ReportSubject) -> Iterator[Block]:
    """Yield the pins' forces where the machine runs against a stop and a cylinder has the relief valve's pressure; empty without one."""
    held = blocked_cylinders(subject)
    if not held:
        if any("bore" in each.numbers for each in subject.machine.plan.of_kind(TwoPoint).values()):
            yield said("No cylinder has a pump or a relief valve: there are no pin forces at the relief pressure.")
        return
    plan = subject.machine.plan  # a stop holds the last point that the machine is about, else its tip
    point = next((name for name in reversed(subject.machine.featured().path) if name in plan.moving), plan.tip[-1])
    try:
        with unwarned():
            rows = worst_blocked(subject, point, held)
    except LinkageError as error:
        yield said("Pin forces at the relief pressure are not calculated: {why}", why=str(error))
        return
    if not rows:
        return
    count = sum(int(place.sampled.reached.sum()) for place in subject.judge.places)
    pressures = ", ".join(f"{name} {' … '.join(shown_number(end, 'kN', '.1f') for end in ends if end)}" for name, ends in held.items())
    yield said(
        "At the relief pressure: a stop holds {point} in either direction. One cylinder after the other presses and the others hold, "
        "until the first relief valve opens. Where no relief valve is declared, the pump's pressure is the highest. The machine's own "
        "loads act too; where they alone open one, nothing is held, and the place is left out. Greatest thrusts, {unit}: {thrusts}. "
        "This table looks at {count} poses over all that the machine runs.",
        point=point, unit=unit_sign("kN"), thrusts=pressures, count=count,
    )  # fmt: skip
    plain_units = {name: stroke_unit(subject.machine.plan, name) for name in subject.machine.strokes}
    cells = []
    for row in rows:
        moves = said("{member} pushes", member=row.cylinder) if row.pushes else said("{member} pulls", member=row.cylinder)
        case = f"{subject.case_words(row.case)}, " if len(subject.judge.cases) > 1 else ""
        size = figures(row.force / factor(shown_in("kN"))) if np.isfinite(row.force) else "∞"
        cells.append((*row.cells, size, moves, row.opens, f"{case}{places_text(row.strokes, plain_units)}"))
    force = said("F, {unit}", unit=unit_sign("kN"))
    heads = (*joint_heads(), force, said("cylinder"), said("first valve"), said("situation and place"))
    yield TableBlock(said("Largest pin forces at the relief pressure, against a stop"), heads, tuple(cells), "llllrllm")


def blocked_cylinders(subject: ReportSubject) -> dict[str, tuple[float, float]]:
    """Return the members whose thrust a relief valve bounds, with the least and the greatest thrust [N]; 0 of a side that does not work."""
    found = {}
    for name, element in subject.machine.plan.of_kind(TwoPoint).items():
        try:
            low, high, pull, push = (np.ravel(each) for works in (False, True) for each in element.bounds(subject.curve, works))
        except LinkageError:
            continue
        ends = float(np.nanmin(low)) if np.nanmin(pull) < 0.0 else 0.0, float(np.nanmax(high)) if np.nanmax(push) > 0.0 else 0.0
        if np.isfinite(ends).all() and ends[0] < ends[1]:
            found[name] = ends
    return found


def worst_blocked(subject: ReportSubject, point: str, held: Mapping[str, tuple[float, float]]) -> list[Blocked]:
    """Return the largest force of each joint over some poses, cylinders and the ways in which they press.

    A stop pushes with a force along the way on which the cylinder would move the point, until the first relief valve opens: the
    cylinder's own, or that of another one that holds. Forces are affine in it, so that the machine's own loads and two unit forces tell it.
    """
    worst: dict[tuple[str, ...], Blocked] = {}
    for place in subject.judge.places:
        poses, stop = place.sampled.moved(place.sampled.strokes), None
        for case in place.cases(subject.judge.acting):
            acting = Acting(case=subject.judge.acting.case or (None if case == PLAIN_CASE else case))
            stop = Stop.of(poses, point, held, acting) if stop is None else replace(stop, own=pin_forces(poses, acting=acting))
            for cylinder, pushes in ((name, way) for name, way in product(stop.bounds, (True, False)) if held[name][way]):
                force, way, opens = stop.until_open(cylinder, pushes)
                for key, cells, size in stop.joint_sizes(force, way):
                    if np.isnan(size).all():
                        continue
                    at = np.unravel_index(int(np.argmax(size >= (1.0 - NEAR) * np.nanmax(size))), size.shape)
                    if key not in worst or size[at] * (1.0 - NEAR) > worst[key].force:
                        strokes = {name: float(np.broadcast_to(value, size.shape)[at]) for name, value in poses.strokes.items()}
                        worst[key] = Blocked(cells, float(size[at]), cylinder, pushes, str(opens[at]), case, strokes)
    return list(worst.values())


@record
class Stop:
    """A point against a stop over some poses: the forces of joints and cylinders from the machine's own loads and two unit forces there."""

    motion: Motion
    own: PinForces
    units: tuple[PinForces, PinForces]
    bounds: Mapping[str, tuple[FloatArray, FloatArray]]

    @classmethod
    def of(cls, poses: Motion, point: str, held: Iterable[str], acting: Acting) -> Stop:
        """Return it at poses; raises LinkageError where there are no joint forces."""
        bends = holders_of(held_in_case(poses, acting).plan).changes_shares
        ensure(not bends, "cylinders of a line share otherwise while it pulls than while it pushes, and no unit force tells which")
        own = pin_forces(poses, acting=acting)
        across, up = (pin_forces(poses, acting=Acting(loads=[Force(point, way)])) for way in ((1.0, 0.0), (0.0, 1.0)))
        elements = poses.plan.of_kind(TwoPoint)
        # gas that presses by itself holds no load, and is in no unit's thrusts
        known = [name for name in held if all(name in each.thrusts for each in (own, across, up))]
        ends = {name: elements[name].bounds(poses, False) for name in known}
        return cls(poses, own, (across, up), {name: (np.asarray(low), np.asarray(high)) for name, (low, high) in ends.items()})

    def until_open(self, cylinder: str, pushes: bool) -> tuple[FloatArray, FloatArray, NDArray[np.str_]]:
        """Return the stop's force [N], its way (2, ...), and whose relief valve opens first; NaN where none does."""
        parts = np.array([each.thrusts[cylinder] for each in self.units])
        answers = np.hypot(*parts)  # the thrust that a unit force along the point's way asks for
        way = (1.0 if pushes else -1.0) * parts / np.where(answers > STILL * largest(answers), answers, np.nan)
        least, opens = np.full(answers.shape, np.inf), np.full(answers.shape, cylinder, dtype=object)
        for name, (low, high) in self.bounds.items():
            grows = sum(along * each.thrusts[name] for along, each in zip(way, self.units, strict=True))
            limit = np.where(grows > 0.0, high, low)
            force = np.where(grows != 0.0, (limit - self.own.thrusts[name]) / np.where(grows == 0.0, 1.0, grows), np.inf)
            opens = np.where(force < least, name, opens)
            own, room = self.own.thrusts[name], NEAR * (high - low)  # beyond both ends its own loads open the valve already
            least = np.where((own < low - room) | (own > high + room), np.nan, np.minimum(least, np.maximum(force, 0.0)))
        return np.where(np.isfinite(least), least, np.nan), way, opens

    def joint_sizes(self, force: FloatArray, way: FloatArray) -> Iterator[tuple[tuple[str, ...], tuple[str, ...], FloatArray]]:
        """Yield, of each joint that transmits a force, its key, its cells, and the size of its force [N]."""
        across, up = ({(each.point, each.on, each.by, each.kind): each.force for each in unit.joints} for unit in self.units)
        for joint in self.own.joints:
            if joint.has_force:
                key = (joint.point, joint.on, joint.by, joint.kind)  # the pins of what presses by itself answer to no stop
                total = joint.force + force * (way[0] * across.get(key, 0.0) + way[1] * up.get(key, 0.0))
                yield key, joint_cells(self.motion.plan, joint), np.hypot(*total)
