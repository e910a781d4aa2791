"""A mechanism with its dimensions: lengths between arrows, angles as arcs, each where there is room."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from functools import cached_property

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Arc

from ..frozen import immutable
from ..motion import Motion
from ..program import FloatArray
from ..quantities import Quantity, Stroke, source_text
from ..units import shown_number
from . import style
from .drawing import draw_scene
from .layout import cloud, is_inside
from .scene import Bounds, Places, Scene
from .shapes import left_of, polar, segment
from .sheet import Keywords, haloed, points_a_metre, sheet

AWAY = (1.7, 2.7, 3.8, 5.0, 6.4, 8.0)
"""The distances from the link that a dimension line tries, in heights of its letters."""
LETTERS = 8.0
"""Their size [points]."""
NUMBER: Keywords = {"rotation_mode": "anchor", "ha": "center", "va": "center", "zorder": 21.0}
"""How a dimension stands over its line."""
RADII = (3.4, 4.6, 6.0, 7.6)
"""The radii that an arc tries, in heights of letters."""
SHORT = 1.6
"""What is shorter, in heights of letters, has no room for arrows."""
MOST = 14.0
"""A dimension that would cover so much is left to the table."""


def dimensioned(ax: Axes, motion: Motion) -> None:
    """Draw a mechanism on empty axes at the first pose of a motion, with the lengths and angles that its links are given.

    Lengths are in millimetres, or in the length of the chosen system of units; what follows a stroke stands as its formula, and what
    finds no room is left out.
    Raises DefinitionError for a batch of designs.
    """
    scene = Scene(motion)
    left, right, bottom, top = scene.box()
    air = 0.09 * max(right - left, top - bottom)
    sheet(ax, (left - air, right + air, bottom - air, top + air))
    (left, right), (bottom, top) = ax.get_xlim(), ax.get_ylim()
    index = scene.index(0)
    at = scene.at(index)
    placed = list(placed_dimensions(scene, at, index, points_a_metre(ax), (left, right, bottom, top)))
    draw_scene(ax, scene, index, [np.repeat(each.covered, KEPT, axis=0) for each in placed])
    for each in placed:
        each.draw(ax)


KEPT = 5
"""How many points of the mechanism a point of a dimension counts as, for the names that keep clear of it."""


@immutable
class LengthLine:
    """A dimension line from P to Q, moved aside: its text, its two ends and those of the lines that lead to it, shape (2,) [m]."""

    text: str
    P: FloatArray
    Q: FloatArray
    aside: FloatArray
    letter: float

    @property
    def ends(self) -> tuple[FloatArray, FloatArray]:
        """The ends of the line itself."""
        return self.P + self.aside, self.Q + self.aside

    @cached_property
    def covered(self) -> FloatArray:
        """Points that it covers, shape (m, 2) [m]: its text counts double."""
        start, end = self.ends
        middle, along = 0.5 * (start + end), (end - start) / (np.hypot(*(end - start)) or 1.0)
        half = 0.32 * self.letter * len(self.text)
        text = segment(middle - half * along, middle + half * along, 0.3 * self.letter)
        return np.concatenate([segment(start, end, 0.8 * self.letter), text, text])

    def draw(self, ax: Axes) -> None:
        """Draw it on axes."""
        start, end = self.ends
        for pin, tip in ((self.P, start), (self.Q, end)):
            away = float(np.hypot(*(tip - pin))) or 1.0  # it begins next to its pin, so that one sees from which it comes
            line = np.array([pin + min(0.35, self.letter / away) * (tip - pin), tip + 0.35 * self.letter * (tip - pin) / away])
            ax.add_line(Line2D(*line.T, color=style.MUTED, linewidth=0.5, zorder=20.0))
        arrow = {"arrowstyle": "<|-|>,head_length=0.35,head_width=0.11", "color": style.INK, "linewidth": 0.6, "shrinkA": 0, "shrinkB": 0}
        ax.annotate("", tuple(end), tuple(start), arrowprops=arrow, zorder=20.5, annotation_clip=False)
        way = (float(np.degrees(np.arctan2(*(end - start)[::-1]))) + 90.0) % 180.0 - 90.0
        haloed(ax, self.text, 0.5 * (start + end), LETTERS, style.INK, 3.0, rotation=way, **NUMBER)


@immutable
class AngleArc:
    """An arc about a corner from one direction to another [rad], counter-clockwise, with its text."""

    text: str
    corner: FloatArray
    start: float
    end: float
    radius: float
    letter: float

    @property
    def middle(self) -> FloatArray:
        """Where its text stands."""
        return np.asarray(self.corner + self.radius * polar(0.5 * (self.start + self.end)))

    @cached_property
    def covered(self) -> FloatArray:
        """Points that it covers, shape (m, 2) [m]."""
        ways = np.linspace(self.start, self.end, 15)
        arc = self.corner + self.radius * polar(ways)
        half = np.array([0.32 * self.letter * len(self.text), 0.0])
        text = segment(self.middle - half, self.middle + half, 0.3 * self.letter)
        return np.concatenate([arc, text, text])

    def draw(self, ax: Axes) -> None:
        """Draw it on axes."""
        x, y = self.corner
        size, ends = 2.0 * self.radius, np.degrees([self.start, self.end])
        ax.add_patch(Arc((x, y), size, size, theta1=ends[0], theta2=ends[1], color=style.INK, linewidth=0.7, zorder=20.0))
        haloed(ax, self.text, self.middle, LETTERS, style.INK, 3.0, rotation=0.0, **NUMBER)


# Which dimensions there are, and where each stands.


def placed_dimensions(scene: Scene, at: Places, pose: int, scale: float, box: Bounds) -> Iterator[LengthLine | AngleArc]:
    """Yield the dimensions of a pose within a box [m], each clear of the mechanism and of those before it as far as there is room.

    `scale` are printer's points a metre.
    """
    letter, low, high = LETTERS / scale, np.array(box[::2]), np.array(box[1::2])
    taken = [cloud(scene, at)]
    for places in dimension_choices(scene.motion, at, pose, letter):
        choices = [each for each in places if np.all((each.covered > low) & (each.covered < high))]
        points = np.concatenate(taken)
        costs = []
        for rank, each in enumerate(choices):  # how many of the points that it would cover lie within a letter of one that is taken
            about = points[is_inside(points - each.covered[0], np.ptp(each.covered, axis=0) + letter)]
            near = is_inside(each.covered[:, None] - about, np.full(2, 0.7 * letter))
            costs.append(float(np.count_nonzero(np.any(near, axis=1))) + 1.2 * (rank // 2))
        if costs and min(costs) < MOST:
            best = choices[int(np.argmin(costs))]
            taken.append(best.covered)
            yield best


def dimension_choices(motion: Motion, at: Places, pose: int, letter: float) -> Iterator[Sequence[LengthLine | AngleArc]]:
    """Yield the places that each given dimension tries, short lengths first and angles last.

    A length tries both sides of its link, the nearer places first; an angle arcs of several radii on its smaller side.
    """
    plan = motion.plan
    lengths = []
    for pair, quantity in plan.table.lengths.items():
        P, Q = (at[name] for name in sorted(pair))
        apart = float(np.hypot(*(Q - P)))
        if len(pair) == 2 and apart > 0.0:
            lengths.append((apart, P, Q, dimension_text(motion, quantity, "mm", pose)))
    for apart, P, Q, text in sorted(lengths, key=lambda each: each[0]):
        if apart >= SHORT * letter:
            across = left_of((Q - P) / apart)
            yield [LengthLine(text, P, Q, away * letter * side, letter) for away in AWAY for side in (across, -across)]
    for (pin, names), quantity in plan.table.angles.items():
        corner, sides = at[pin], [at[name] for name in sorted(names)]
        if np.isfinite([corner, *sides]).all():
            text = dimension_text(motion, quantity, "deg", pose)
            start, end = (float(np.arctan2(*(each - corner)[::-1])) for each in sides)
            start, end = (end, start) if (end - start) % (2.0 * np.pi) > np.pi else (start, end)
            sweep = (end - start) % (2.0 * np.pi)
            room = min(float(np.hypot(*(each - corner))) for each in sides)
            radii = [radius * letter for radius in RADII if sweep > 1e-6 and room > 0.7 * radius * letter]
            yield [AngleArc(text, corner, start, start + sweep, radius, letter) for radius in radii]


ADDED = re.compile(r"^-?\d+(?:\.\d*)?(?= [-+] )|(?<= [-+] )\d+(?:\.\d*)?$")
"""A number that a formula adds: it is shown in the unit of the drawing, as all lengths are."""


def dimension_text(motion: Motion, quantity: Quantity, unit: str, pose: int) -> str:
    """Return a dimension as a drawing has it: its number without the unit of lengths, or the formula that follows a stroke."""
    strokes, sign = motion.plan.of_kind(Stroke), "°" if unit == "deg" else ""
    if motion.plan.terms(quantity) & strokes.keys():
        return ADDED.sub(lambda found: shown_number(float(found[0]), unit, 5) + sign, source_text(quantity))
    value = float(np.broadcast_to(motion.value(quantity), motion.shape).ravel()[pose])
    return shown_number(abs(value) if sign else value, unit, 5) + sign
