"""The loads that turn about a pin with their lever arms, and the forces from outside that hold them."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import groupby

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from ..errors import DefinitionError, ensure
from ..language import said, translated
from ..motion import Motion
from ..plan.members import FRAME
from ..program import FloatArray
from ..units import current_system, factor, shown_in
from . import style
from .arrows import ArrowLayer, TurningArrow, VectorArrow, Wording, significant
from .dimensioned import LETTERS, LengthLine
from .force_arrows import GROUND, LOAD, MEMBER, PIN, ForcesAt, layer_of, load_groups
from .scene import Bounds
from .shapes import left_of
from .sheet import LEFT, RIGHT, WIDTH
from .shown_values import short_name

BESIDE, STEP = 2.5, 1.7
"""How far outside what turns the lever arms of parallel forces begin, in sizes, and how far apart they stand, in heights of letters."""
LONG = 4.5
"""On a lever arm that is longer, in heights of letters, its length is written; beside it else."""
LEAST = 0.5
"""A lever arm shorter than so many sizes is none: the force goes through the pin."""
SAME = 1e-6
"""Forces whose directions differ by less [rad] are parallel; speeds are equal that differ by a thousandth of it times the largest."""


@dataclass(frozen=True, eq=False)
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
