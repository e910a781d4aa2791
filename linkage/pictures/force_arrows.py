"""The forces of a machine at one pose as arrows: at pins and of loads, all of those on one body, or about a pin, with lever arms."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from itertools import groupby
from typing import Any, TypeAlias

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from ..errors import AssemblyError, DefinitionError, SingularError, ensure, require_type, unknown, unwarned
from ..frozen import immutable, record
from ..language import noted, said, translated
from ..loads import PLAIN, Acting, Case, LoadCase, Loads
from ..motion import Motion
from ..plan.members import FRAME
from ..program import FloatArray
from ..reports import case_along, in_case_words
from ..statics import JointForce, PinForces
from ..statics.joint_forces import joint_forces
from ..units import current_system, factor, shown_in
from . import style
from .arrows import NOTHING_THERE, ArrowLayer, TurningArrow, VectorArrow, Wording, significant
from .dimensioned import LETTERS, LengthLine
from .scene import Bounds
from .shapes import left_of
from .sheet import LEFT, RIGHT, WIDTH
from .shown_values import bodies_shown, centre_of_mass, drawn_together, on_its_line, resultant, short_name
from .strokes import pose_words

PIN, LOAD, MEMBER, GROUND = "#0072b2", "#d55e00", "#007f5c", "#000000"
"""The colours of pin forces, loads, the ends of cylinders and springs, and of the ground under supports: Okabe and Ito's, one darker."""

Rates: TypeAlias = Mapping[str, Any] | None

SENSE = noted("A pin force is drawn as it acts on the body named; where none is named, from the frame on what it holds.")


@record
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


@immutable
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


# The loads that turn about a pin with their lever arms, and the forces from outside that hold them.

BESIDE, STEP = 2.5, 1.7
"""How far outside what turns the lever arms of parallel forces begin, in sizes, and how far apart they stand, in heights of letters."""
LONG = 4.5
"""On a lever arm that is longer, in heights of letters, its length is written; beside it else."""
LEAST = 0.5
"""A lever arm shorter than so many sizes is none: the force goes through the pin."""
SAME = 1e-6
"""Forces whose directions differ by less [rad] are parallel; speeds are equal that differ by a thousandth of it times the largest."""


@immutable
class LeverArm:
    """A lever arm: the dimension from a pin to a force's line of action, and where that force begins, (2,) [m].

    `words` are written beside a short one.
    """

    line: LengthLine
    start: FloatArray
    words: str = ""

    def draw(self, ax: Axes) -> list[Wording]:
        """Draw it on axes, with the line of action as a broken line, and return the texts beside it."""
        action, ends = np.array([self.start, self.line.ends[1]]), self.line.ends
        ax.add_line(Line2D(*action.T, color=style.MUTED, linewidth=0.7, linestyle=(0, (5, 3)), zorder=15.0))
        self.line.draw(ax)
        return [Wording(self.words, 0.5 * (ends[0] + ends[1]), left_of(ends[1] - ends[0]), style.INK, "lever arm")] if self.words else []


def turning_about(at: Motion, pin: str) -> frozenset[str]:
    """Return the points that turn about a pin while one stroke runs. DefinitionError where none do."""
    plan = at.plan
    for stroke in plan.strokes:
        speeds = {name: at.velocity(name, dict.fromkeys(plan.strokes, 0.0) | {stroke: 1.0}) for name in plan.points}
        slack = 1e-3 * SAME * max(float(np.hypot(*each)) for each in speeds.values())
        arms = {name: at[name] - at[pin] for name in plan.points}
        others = (name for body in plan.bodies if pin in body.points for name in body.points if np.hypot(*arms[name]) > 0.0)
        spins = {float(left_of(arms[name]) @ speeds[name]) / float(arms[name] @ arms[name]) for name in others}
        turns = [each for each in spins if abs(each) > slack]
        found = {name for name in arms for spin in turns if np.hypot(*(speeds[name] - spin * left_of(arms[name]))) <= slack}
        if turns and pin in found:
            return frozenset(found)
    what = f"{plan.title}: forces={pin!r}: no body turns about {pin} while one stroke runs"
    raise DefinitionError(f"{what}; name a pin about which one does.")


def lever_arms(forces: ForcesAt, at: Motion, pin: str, box: Bounds, size: float) -> tuple[list[ArrowLayer], list[LeverArm]]:
    """Return two layers, the loads about a pin and the forces that hold them, and all their lever arms, on a sheet's box [m].

    Each layer has its own scale. The pin's force has no lever arm. DefinitionError where no load turns about the pin.
    """
    turning, centre = turning_about(at, pin), at[pin]
    inside = {body.name: set(body.points) <= turning for body in forces.found._structure.bodies} | {FRAME: False}
    loads, load_turns = list[VectorArrow](), list[TurningArrow]()
    for element, bearer, place, force, moment, colour in load_groups(forces):
        if inside.get(bearer, False):
            loads.append(VectorArrow(f"load {element} on {bearer}", place, force, colour, element))
            load_turns.append(TurningArrow(f"moment {element} on {bearer}", place, moment, colour, element))
    ensure(loads, f"{at.plan.title}: forces={pin!r}: no load turns about {pin}; name a pin about which a loaded body turns.")
    held, held_turns = list[VectorArrow](), list[TurningArrow]()
    for number, joint in enumerate(forces.found.joints):
        own, other = inside.get(joint.on, False), inside.get(joint.by, False)
        if own == other:
            continue
        on, by, sign = (joint.on, joint.by, 1.0) if own else (joint.by, joint.on, -1.0)
        text, colour = said("from {body}", body=short_name(forces.found, by)), MEMBER if by in forces.found.members else PIN
        if joint.point != pin and joint.has_force:
            force = sign * forces.one(joint.force)
            held.append(VectorArrow(f"force {joint.point} {number} on {on}", forces.spot(joint), force, colour, text))
        couple = sign * float(forces.one(joint.couple))
        held_turns.append(TurningArrow(f"couple {joint.point} {number} on {on}", forces.spot(joint), couple, colour, text))
    sense = said(
        "Lever arms in {unit}. Moments about {pin}, counter-clockwise: {loads} of the loads, {held} of what holds them.",
        unit=translated(shown_in("m")), pin=pin,
        loads=moment_text(moment_about(centre, loads, load_turns)), held=moment_text(moment_about(centre, held, held_turns)),
    )  # fmt: skip
    own_words = {LOAD: said("load"), GROUND: said("from the ground")}
    words = {MEMBER: said("from a cylinder or spring"), PIN: said("from a body or the frame")}
    layers = [layer_of(loads, load_turns, own_words, sense), layer_of(held, held_turns, words, "")]
    places = [at[name] for name in turning] + list(layers[0].tips(layers[0].scale(box)))
    letter = LETTERS / 72.0 * (box[1] - box[0]) / (WIDTH - LEFT - RIGHT)
    outside = arm_lines(layers[0], centre, np.array([each for each in places if np.isfinite(each).all()]), size, letter)
    return layers, [*outside, *arm_lines(layers[1], centre, None, size, letter)]


def moment_about(centre: FloatArray, arrows: list[VectorArrow], turns: list[TurningArrow]) -> float:
    """Return the moment of forces and couples about a place [Nm], counter-clockwise above zero."""
    return sum(float(left_of(each.at - centre) @ each.vector) for each in arrows) + sum(each.moment for each in turns)


def moment_text(value: float) -> str:
    """Return a moment [Nm] with its sign and unit."""
    unit = shown_in("kNm") if current_system() or abs(value) >= 1000.0 else "Nm"
    return f"{significant(value / factor(unit))} {translated(unit)}".replace("-", "\N{MINUS SIGN}")


def arm_lines(layer: ArrowLayer, centre: FloatArray, places: FloatArray | None, size: float, letter: float) -> list[LeverArm]:
    """Return the lever arms of a layer's forces. Parallel ones stand side by side outside `places`, shape (n, 2) [m], if there are any.

    `size` is that of a pin, `letter` the height of letters [m].
    """
    shown = [each for each in layer.arrows if abs(left_of(each.vector) @ (each.at - centre)) > LEAST * size * each.length]
    found, unit = list[LeverArm](), factor(shown_in("m"))
    for _, group in groupby(sorted(shown, key=line_direction), line_direction):
        parallel = list(group)
        way = parallel[0].vector / parallel[0].length
        arms = [(each.at - centre - way * float((each.at - centre) @ way), each) for each in parallel]
        reach = (np.zeros((1, 2)) if places is None else places - centre) @ way
        side, level = 1.0 if reach.max() < -reach.min() else -1.0, 0
        had = list[FloatArray]()
        for arm, each in sorted(arms, key=lambda pair: float(np.hypot(*pair[0]))):
            if any(np.allclose(arm, other, atol=0.5 * size) for other in had):  # of two forces on one line
                continue
            out = 0.0 if places is None else side * (float(np.max(side * reach)) + BESIDE * size + STEP * level * letter)
            length, level = float(np.hypot(*arm)), level + 1
            text, is_long = significant(length / unit), places is not None and length > LONG * letter
            line = LengthLine(text if is_long else "", centre, centre + arm, out * way, letter)
            found.append(LeverArm(line, each.at, "" if is_long else text))
            had.append(arm)
    return found


def line_direction(arrow: VectorArrow) -> float:
    """Return the direction of a line of action [rad], from 0 to pi, rounded."""
    return round(float(np.arctan2(arrow.vector[1], arrow.vector[0]) % np.pi) / SAME) * SAME % np.pi
