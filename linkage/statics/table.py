"""The largest force of every joint over poses, load cases and directions of motion, as input for an FEM model."""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Iterator, Mapping, Sequence
from dataclasses import field, replace
from math import pi
from typing import Any, Protocol, TypeAlias, cast, overload, runtime_checkable

import numpy as np

from ..errors import DefinitionError, cited, ensure, require_type, unwarned
from ..frozen import record
from ..language import noted, said, translated
from ..loads import Acting
from ..motion import Answer, Judge, Motion, Over, greatest, most, stroke_unit
from ..motion.limits import places_text, timed_texts
from ..quantities import body_name
from ..shown import text_columns
from ..units import show, shown_number, unit_sign
from .force_requests import pin_force
from .joint_forces import JointForce, PinForces, joint_forces

Place: TypeAlias = tuple[np.intp | int, ...]
"""A pose among those of a motion, or a design among its designs, by its indices."""


@record
class PinLoad:
    """The largest force of one joint: its size [N], its direction in the body's own axes [rad], and where it occurs.

    Of a joint without one, such as a crank's drive or a gear, it is the largest couple [Nm], the angle is 0, and not `has_force`.

    The body's x axis goes from the first of its `axis` points to the second; for the frame it is the frame's own. `drive` is the stroke
    that moves, `over` the `Over` in which it occurs, "" where there is one only; `answer` is what the judge says of it.
    """

    point: str
    on: str
    by: str
    kind: str
    force: float
    angle: float
    axis: str
    strokes: Mapping[str, float]
    design: tuple[int, ...]
    case: str
    direction: str
    units: Mapping[str, str] = field(default_factory=dict)
    """The units of its strokes, "m" or "rad"."""
    drive: str = ""
    over: str = ""
    answer: Answer | None = None
    has_force: bool = True

    @property
    def place(self) -> str:
        """Where it occurs, in words: `phi = 15.00 deg, t = 0.0 mm`, in time `2 s (t = 0.0 mm)`; over which of several `Over`s."""
        at = places_text(self.strokes, self.units)
        if self.answer is not None and np.isfinite(self.answer.time):
            time, there = timed_texts(self.strokes, self.units, float(self.answer.time))
            at = f"{time} ({there})"
        return ", ".join(each for each in (at, self.over and said("over {over}", over=self.over)) if each)

    @property
    def movement(self) -> str:
        """The direction of motion in words, with the stroke that moves where there are several: `extending phi`."""
        word = translated(WORDS.get(self.direction, self.direction))
        return said("{direction} {drive}", direction=word, drive=self.drive) if self.drive else word

    @property
    def cells(self) -> tuple[str, ...]:
        """The row as text, in the units and the language that are chosen."""
        force, angle = show(self.force, "Nm"), ""
        if self.has_force:
            force = shown_number(self.force, "kN", 3 if SMALL < self.force < 100.0 else ".3f")
            angle = shown_number(self.angle, "deg", "z.1f")
        kind = translated(WORDS.get(self.kind, self.kind))
        return self.point, kind, self.on, self.by, force, angle, self.axis, self.place, self.case, self.movement


SMALL = 1e-3
"""A force [N] up to which it may be rounding; below 0.1 kN a larger one has three figures, as those of models and tools have."""
WORDS = {
    "pin": noted("pin"), "guide": noted("guide"), "slot": noted("slot"), "driven": noted("driven point"), "crank": noted("crank"),
    "slider": noted("slider"), "telescope": noted("telescope"), "upright": noted("upright"), "gear": noted("gear"),
    "frictionless": noted("frictionless"), "extending": noted("extending"), "retracting": noted("retracting"),
}  # fmt: skip
"""Kinds of joints and directions of motion, as the table's cells say them."""


def max_headings() -> tuple[str, ...]:
    """Return the headings of the rows' cells, with units."""
    who = said("pin"), said("kind"), said("on"), said("from")
    force, angle = f"{said('force')}, {unit_sign('kN')}", f"{said('angle')}, {unit_sign('deg')}"
    return (*who, force, angle, said("from axis"), said("at"), said("load case"), said("motion"))


OverLike: TypeAlias = Over | Mapping[str, Any] | Sequence[Over | Motion] | None


@runtime_checkable
class Judged(Protocol):
    """A machine, which lives on the floor above, as far as it is judged."""

    def judge(self, over: object = None, acting: Acting | None = None) -> Judge: ...


Results: TypeAlias = Judged | PinForces | Iterable[PinForces]


@overload
def max_table(results: Judged, over: OverLike = ..., acting: Acting | None = ...) -> tuple[PinLoad, ...]: ...
@overload
def max_table(results: PinForces | Iterable[PinForces]) -> tuple[PinLoad, ...]: ...
def max_table(results: Results, over: OverLike = None, acting: Acting | None = None) -> tuple[PinLoad, ...]:
    """Return, for every joint, its largest force with case, direction and place, in the order of the joints.

    Of a machine over all that it runs, its `overs` or those given, in all load cases and directions of motion that occur, unless
    `acting` says which. Of results of `pin_forces`, one or several, over all that these cover. It is looked for between the poses,
    whatever the number of these, and up to the poses that are refused. A force that grows without bounds towards one of them is
    infinite. Loads that are given as arrays over the poses are known at these alone, and take results.

    Parameters
    ----------
    results : Mechanism, PinForces or sequence of PinForces
        The design, or forces of motions.
    over : Over, str or mapping, optional
        The domain, or the name of a declared one; by default all that the machine runs.
    acting : Acting, optional
        Loads, load case, direction and rates in one.

    Returns
    -------
    tuple of PinLoad
        One row a joint.
    """
    if isinstance(results, Judged):
        return judged_table(results.judge(over, acting))
    ensure(over is None and acting is None, "max_table: over= and acting= are for a machine; results of pin_forces say both themselves.")
    found: list[object] = list(results) if isinstance(results, (list, tuple, Iterator)) else [results]
    best: dict[tuple[str, str, str, str], PinLoad] = {}
    wrong = [each for each in found if not isinstance(each, PinForces)]
    if wrong:
        raise DefinitionError(f"max_table: {cited(wrong[0])} is no result of pin_forces; give pin_forces(motion), or a list of such.")
    for one in cast("list[PinForces]", found):
        with unwarned():  # what comes of a dead point is said by the row
            rows = largest_loads(one)
        for row in rows:
            key = joint_key(row)
            if key not in best or row.force > best[key].force:
                best[key] = row
    ensure(best, "There are no joint forces to tabulate: no pose is reached.")
    return tuple(best.values())


def judged_table(judge: Judge) -> tuple[PinLoad, ...]:
    """Return, for every joint, its largest force over all that a judge looks at, in all that acts there."""
    require_type("judged_table", judge, Judge, "a judge is expected; of a machine it is max_table(machine)")
    with unwarned():
        pose = judge.sample_pose
        if pose is None:
            raise DefinitionError("There are no joint forces to tabulate: no pose is reached.")
        there = joint_forces(pose, Acting(judge.acting.loads, judge.acting.case))
        joints = {joint_key(each): each.has_force for each in there.joints}
        ends = [(key[:2], key[2], has_force) for key, has_force in joints.items()]
        sizes = (pin_force(*on, by=by) if has_force else abs(pin_force(*on, "couple", by=by)) for on, by, has_force in ends)
        answers = judge.answers([*map(most, sizes)])
        known = dict[Hashable, PinForces]()
        rows = [judged_row(judge, key, answer, known) for key, answer in zip(joints, answers, strict=True)]
    return tuple(row for row in rows if row is not None)


def judged_row(judge: Judge, key: tuple[str, str, str, str], answer: Answer, known: dict[Hashable, PinForces]) -> PinLoad | None:
    """Return a joint's row for the judge's answer, of a batch that of the design with the largest force; None without a value.

    `known` are the forces of places and situations that other joints have their largest forces at.
    """
    value = np.asarray(answer.value)
    if np.isnan(value).all():
        return None
    number = int(np.argmax(np.where(np.isnan(value), -np.inf, value)))
    of_design, one = (judge.for_design(number), answer.of_design(number)) if value.ndim else (judge, answer)
    acting, where = of_design.situation(one), (number, *one.strokes.items(), str(one.time), one.case, one.direction, one.drive)
    if where not in known:
        known[where] = joint_forces(of_design.there(one), replace(acting, drive=acting.drive if acting.is_moving else None))
    there = known[where]
    joint = next(each for each in there.joints if joint_key(each) == key)
    row = pin_load(there, joint, float(one.value), (), np.unravel_index(number, value.shape), dict(one.strokes))
    drive, over = (getattr(one, name) if name in one.named else "" for name in ("drive", "over"))
    return replace(row, drive=drive, over=over, answer=one)


def joint_key(joint: JointForce | PinLoad) -> tuple[str, str, str, str]:
    """Return a key of a joint."""
    return joint.point, joint.on, joint.by, joint.kind


def largest_loads(result: PinForces) -> list[PinLoad]:
    """Return the largest force of each joint of a result."""
    joints = result.joints
    if not joints:
        return []
    try:
        found = greatest(result.motion, lambda at: np.stack([joint.size for joint in result.again(at).joints]))
    except DefinitionError:  # arrays over the poses, at which alone they are known
        rows, designs = [], len(result.motion._design_shape)
        for joint in joints:
            if np.isfinite(joint.size).any():
                where = np.unravel_index(int(np.nanargmax(joint.size)), joint.size.shape)
                strokes = {name: float(value[where[designs:]]) for name, value in result.motion.strokes.items()}
                rows.append(pin_load(result, joint, float(joint.size[where]), where, where[:designs], strokes))
        return rows
    rows = []
    for place, joint in enumerate(joints):
        value = np.asarray(found.value)[place]
        if not np.isnan(value).all():
            design = np.unravel_index(int(np.nanargmax(value)), value.shape)
            strokes = {name: float(np.asarray(each)[place][design]) for name, each in found.strokes.items()}
            there = result.again(result.motion._there(strokes, np.broadcast_to(found.time, np.shape(found.value))[place][design]))
            same = next(each for each in there.joints if joint_key(each) == joint_key(joint))
            rows.append(pin_load(there, same, float(value[design]), design, design, strokes))
    return rows


def pin_load(result: PinForces, joint: JointForce, force: float, place: Place, design: Place, strokes: Mapping[str, float]) -> PinLoad:
    """Return a joint's row for its largest force, at a place among the poses of a result; its direction in the body's own axes."""
    angle = float(np.arctan2(joint.force[1][place], joint.force[0][place]))
    if joint.axis is not None and joint.has_force:
        (px, py), (qx, qy) = (result.motion[point] for point in joint.axis)
        angle -= float(np.arctan2((qy - py)[place], (qx - px)[place]))
    within = (angle + pi) % (2.0 * pi) - pi
    angle = within + 2.0 * pi if within < -pi + 1e-9 else within  # half a turn to within rounding is pi
    axis, units = body_name(joint.axis or ("x",)), {name: stroke_unit(result.motion.plan, name) for name in strokes}
    where = tuple(map(int, design))
    return PinLoad(*joint_key(joint), force, angle, axis, strokes, where, result.case, result.direction, units, has_force=joint.has_force)


def table_text(rows: Iterable[PinLoad]) -> str:
    """Return the table as aligned text."""
    cells = [max_headings(), *(row.cells for row in rows)]
    return text_columns(cells)
