"""The forces of a machine at one pose as arrows: at its pins and of its loads, or all of those on one body."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any, TypeAlias

import numpy as np

from ..errors import AssemblyError, SingularError, ensure, require_type, unknown, unwarned
from ..language import noted, said, translated
from ..loads import PLAIN, Acting, Case, LoadCase, Loads
from ..motion import Motion
from ..plan.members import FRAME
from ..program import FloatArray
from ..reports import case_along, in_case_words
from ..statics import JointForce, PinForces
from ..statics.joint_forces import joint_forces
from ..units import current_system, shown_in
from .arrows import NOTHING_THERE, ArrowLayer, TurningArrow, VectorArrow
from .shown_values import bodies_shown, centre_of_mass, drawn_together, on_its_line, resultant, short_name
from .strokes import pose_words

PIN, LOAD, MEMBER, GROUND = "#0072b2", "#d55e00", "#007f5c", "#000000"
"""The colours of pin forces, loads, the ends of cylinders and springs, and of the ground under supports: Okabe and Ito's, one darker."""

Rates: TypeAlias = Mapping[str, Any] | None

SENSE = noted("A pin force is drawn as it acts on the body named; where none is named, from the frame on what it holds.")


@dataclass(frozen=True)
class ForceQuestion:
    """Which forces are drawn: all, or those on one body; and in which situation."""

    body: str = ""
    acting: Acting = PLAIN

    def along(self, motion: Motion) -> ForceQuestion:
        """Return the same in the load case that a motion is shown in, where neither loads nor a case are said."""
        is_said = self.acting.case is not None or self.acting.loads is not None
        return self if is_said else replace(self, acting=replace(self.acting, case=case_along(motion)))

    def pose_heading(self, motion: Motion, pose: int) -> str:
        """Return the strokes at a pose and the load case, in words."""
        return ", ".join(filter(None, (pose_words(motion, pose), in_case_words(motion.plan, self.along(motion).acting.case))))


def force_question(
    forces: object, loads: Loads, case: Case, direction: str | None, drive: str | None, rates: Rates
) -> ForceQuestion | None:
    """Return the question of `draw(forces=...)`, None without one; DefinitionError for anything else."""
    if forces is False or forces is None:
        given = {"loads": loads, "case": case, "drive": drive, "direction": direction}
        named = next((name for name, value in given.items() if value is not None), "")
        ensure(not named, f"draw({named}=...) says of which forces; say forces=True, or the name of a body, too.")
        return None
    if forces is not True:
        require_type("draw(forces", forces, str, 'say forces=True, or the body whose forces are drawn, forces="OBC"')
    require_type("draw(velocities", rates or {}, Mapping, "a value for each stroke is expected, such as velocities=dict(S=0.05)")
    return ForceQuestion("" if forces is True else str(forces), Acting(loads, case, direction, rates, drive))


@dataclass(frozen=True, eq=False)
class ForcesAt:
    """The forces of a machine at one pose, a flat index; `refusal` says in words why there are none."""

    found: PinForces
    pose: int
    refusal: str = ""

    def one(self, values: FloatArray) -> FloatArray:
        """Return values (2, ...) or (...) at the pose."""
        array = np.asarray(values, float)
        shape, lead = self.found.motion.shape, array.ndim - len(self.found.motion.shape)
        return np.broadcast_to(array, (*array.shape[:lead], *shape)).reshape(*array.shape[:lead], -1)[..., self.pose]

    def place(self, point: str) -> FloatArray:
        """Return where a point is [m]."""
        return self.one(self.found.motion[point])

    def spot(self, joint: JointForce) -> FloatArray:
        """Return where a joint's force acts [m]."""
        return self.place(joint.point) if joint.place is None else self.one(joint.place)


def forces_at_pose(motion: Motion, pose: int, question: ForceQuestion) -> ForcesAt:
    """Return the forces at a pose; where they are refused at that pose, SingularError, or with `unreachable="nan"` the words why."""
    question = question.along(motion)
    with unwarned():
        try:
            found = ForcesAt(joint_forces(motion, question.acting), pose)
        except SingularError:
            found = ForcesAt(joint_forces(one_pose(motion, pose, "nan"), question.acting), 0)
    if all(np.isfinite(found.one(joint.force)).all() for joint in found.found.joints):
        return found
    words = why_no_forces(motion, pose, question) or next(iter(found.found.remarks), said("the forces are not known here"))
    if motion.unreachable != "nan":
        raise SingularError(words, motion=motion)
    return ForcesAt(found.found, found.pose, words)


def why_no_forces(motion: Motion, pose: int, question: ForceQuestion) -> str:
    """Return why a pose has no forces, in words; empty where nothing refuses them."""
    try:
        joint_forces(one_pose(motion, pose), question.acting)
    except AssemblyError as error:
        return str(error)
    return ""


def one_pose(motion: Motion, pose: int, unreachable: str = "raise") -> Motion:
    """Return a motion at one of its poses alone, a flat index, in time at its instant; errors or NaN where it cannot be had."""
    strokes, instants = {name: np.array(values.ravel()[pose]) for name, values in motion.strokes.items()}, motion._instants
    instants = None if instants is None else instants.shaped(lambda each: np.array(np.ravel(each)[pose]))
    with unwarned():
        return Motion(motion.plan, motion.designs, strokes, unreachable, instants=instants)


def force_layer(forces: ForcesAt, body: str = "") -> ArrowLayer:
    """Return the pin forces and the loads of a machine as arrows, or all forces on one body, each with its origin.

    A force between the frame and a moving body is shown as it acts on that body; between a body and a cylinder or a spring as it acts on
    the body; else on the body that the text names.
    """
    found, arrows, turning = forces.found, [], []
    for place, joint in enumerate(found.joints):
        on, by = (body, joint.on) if joint.by == body else bodies_shown(found, joint) if not body else (joint.on, joint.by)
        if body not in ("", on):
            continue
        sign = 1.0 if on == joint.on else -1.0
        members = [found.members[each] for each in ((by,) if body else (on, by)) if each in found.members]
        colour, ends = MEMBER if members else PIN, f"from {by}" if body else f"on {on} from {by}"
        other = said("from the frame") if by == FRAME else said("from {body}", body=short_name(found, by))
        named = members[:1] if by == FRAME or on not in found.members else []  # one that it acts on is named once
        text = other if body else " ".join([*named, *([] if by == FRAME else [said("on {body}", body=short_name(found, on))])])
        force, couple = sign * forces.one(joint.force), sign * float(forces.one(joint.couple))
        if joint.has_force:
            arrows.append(VectorArrow(f"force {joint.point} {place} {ends}", forces.spot(joint), force, colour, text))
        turning.append(TurningArrow(f"couple {joint.point} {place} {ends}", forces.spot(joint), couple, colour, text))
    for element, bearer, at, force, moment, colour in load_groups(forces):
        if body in ("", bearer):
            arrows.append(VectorArrow(f"load {element} on {bearer}", at, force, colour, element))
            turning.append(TurningArrow(f"moment {element} on {bearer}", at, moment, colour, element))
    case = f": {translated(found.case)}" if found.motion.plan.of_kind(LoadCase) else ""
    words = {LOAD: f"{said('load')}{case}", PIN: said("pin force"), MEMBER: said("of a cylinder or spring")}
    if body:
        words |= {PIN: said("from a body or the frame"), MEMBER: said("from a cylinder or spring")}
    return layer_of(arrows, turning, words | {GROUND: said("from the ground")}, "" if body else translated(SENSE))


def layer_of(arrows: list[VectorArrow], turning: list[TurningArrow], words: Mapping[str, str], sense: str) -> ArrowLayer:
    """Return forces and moments as a layer, with the words of the colours that are there; forces and moments of zero are left out.

    It is in kN, or in N where the largest is less than 1 kN, or in the unit of a chosen system.
    """
    largest = max((each.length for each in arrows), default=0.0)
    shown = tuple(each for each in arrows if each.length > NOTHING_THERE * largest)
    most = max((abs(each.moment) for each in turning), default=0.0)
    turns: list[TurningArrow] = []
    for each in turning:
        if abs(each.moment) > NOTHING_THERE * most:
            here = sum(1 for other in turns if np.allclose(other.at, each.at))
            turns.append(replace(each, radius=each.radius + 1.4 * here))
    unit = "kN" if current_system() or largest >= 1000.0 or most >= 1000.0 else "N"
    used = {each.colour for each in shown} | {each.colour for each in turns}
    keys = tuple((colour, text) for colour, text in words.items() if colour in used)
    return ArrowLayer(shown, shown_in(unit), keys, tuple(turns), sense=sense if used else "")


def load_groups(forces: ForcesAt) -> Iterator[tuple[str, str, FloatArray, FloatArray, float, str]]:
    """Yield each element's load on each body: element, body, place (2,) [m], force (2,) [N] and moment there [Nm], colour.

    What the ground puts on a vehicle goes by the name of its support. Several forces of an element on a body go as their resultant, on
    its line of action, those of a rope each at its point; a couple as a moment amid its points.
    """
    plan = forces.found.motion.plan
    ground = {each.element for each in forces.found._ground}
    for (element, body, _), loads in drawn_together(forces.found, [load for _, load in forces.found._loads]).items():
        colour = GROUND if element in ground else LOAD
        acting = [(forces.place(each.point), forces.one(each.force)) for each in loads]
        force, moment, place = resultant(acting)
        if float(force @ force) <= 1e-18 * sum(float(each @ each) for _, each in acting):
            yield element, body, place, np.zeros(2), float(moment), colour
        else:
            yield element, body, on_its_line(force, moment, place, centre_of_mass(forces.place, plan, element)), force, 0.0, colour


def drawn_body(found: PinForces, name: str) -> str:
    """Return the full name of a body whose forces are drawn; DefinitionError, with the bodies there are, for any other."""
    body = found.body_named(name)
    if body not in found.on_bodies:
        raise unknown("Body", name, found.on_bodies, where=found.motion.plan.title)
    return body
