"""Changes of a search: the machine before and after at the stroke's ends, and its measures over the stroke, before and after."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from textwrap import fill
from typing import TypeAlias

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from ..errors import ensure, require_whole
from ..language import said
from ..motion import Column, Motion, stroke_display_unit
from ..motion.measures import At, Leaf, Measure, words_of
from ..program import FloatArray
from ..study import Optimum
from ..study.optimum import unit_of_leaf
from ..study.problem import Problem
from ..units import factor, mm, shown_in
from . import style
from .curves import WIDEST, axis_range, mark_limit, panel_grid, stroke_panel
from .drawing import arrow_between, draw_scene
from .layout import joined_box, label_free, offsets
from .scene import Places, Scene
from .sheet import haloed_beside, legend_row, look_keys, points_a_metre, sheets_beside, write_title
from .shown_values import leaf_bound, limit_on, typeset
from .strokes import StrokeAxis, stroke_words
from .style import FAINT, STRONG

AIR = 8.0
"""The margin around the machine, in sizes of its pins."""
POSES = 101
Course: TypeAlias = tuple[str, FloatArray, FloatArray]
"""The stroke that a quantity is drawn over, its values and those of the quantity [SI]."""
LEAST_MOVE = 0.05 * mm
"""A pin that moved by less did not move."""


# The machine, before and after.


def draw_optimum(optimum: Optimum, count: int = POSES) -> Figure:
    """Return the machine before, faint, and after, bold, at both ends of its stroke, with how far each pin moved [mm].

    Of several strokes it is the first, the others in the middle of their ranges. Where the machine before cannot be assembled its frame
    alone is drawn.
    """
    require_whole("count", count, "a whole number of poses is expected, at least 2", least=2)
    name = next(iter(optimum.machine.strokes))
    before, after = (optimum.problem.along(each, name, count) for each in (optimum.start, optimum.machine))
    figure, axes, _ = sheets_beside([joined_box([Scene(each).box(AIR) for each in (before, after)])] * 2, head=0.13)
    for ax, pose in zip(axes, (0, count - 1), strict=True):
        overlaid(ax, before, after, pose)
        ax.set_title(stroke_words(after.plan, name, float(after.strokes[name][pose])), fontsize=style.TEXT, color=style.MUTED, loc="right")
    held = StrokeAxis.of(after).held
    write_title(figure, after.plan.heading, said("at {place}", place=held) if held else "")
    keys = [*look_keys([FAINT, STRONG]), Line2D([], [], color=style.ACCENT, linewidth=1.4)]
    legend_row(axes[0], keys, [said("before"), said("after"), said("moved, mm")])
    return figure


def overlaid(ax: Axes, before: Motion, after: Motion, pose: int) -> None:
    """Draw a machine before and after at a pose, and how far its pins moved."""
    old, new = Scene(before), Scene(after)
    for scene, look in ((old, FAINT), (new, STRONG)):
        draw_scene(ax, scene, pose, None, look)
    here, there = old.at(pose), new.at(pose)
    if not np.isfinite(list(there.values())).all():
        return
    moves = {name: float(np.hypot(*(there[name] - here[name]))) for name in new.places}
    moves = {name: far for name, far in moves.items() if far > LEAST_MOVE}
    ways = [np.linspace(here[name], there[name], 9) for name in moves if np.isfinite(here[name]).all()]
    (left, right), heights = ax.get_xlim(), np.linspace(*ax.get_ylim(), 60)
    margin = 0.01 * (right - left) * np.arange(1, 6)  # beside both ends of the sheet, where no name should stand
    edges = np.stack(np.meshgrid(np.concatenate([left - margin, right + margin]), heights), axis=-1).reshape(-1, 2)
    clouds = [*label_free(new, [there]), *ways, edges]
    name_points(ax, new, there, moves, np.concatenate([each[np.isfinite(each).all(axis=1)] for each in clouds]))
    for name in moves:
        arrow_between(ax, here[name], there[name], style.ACCENT, 9, STRONG.level + 0.9)


def name_points(ax: Axes, scene: Scene, at: Places, moves: Mapping[str, float], taken: FloatArray) -> None:
    """Name the points at a pose, those that moved with how far [mm], where they cover nothing of some points (n, 2) [m]."""
    moved = {name: f"{name} {far / mm:.{0 if far >= 9.95 * mm else 1}f}" for name, far in moves.items()}
    names = {name: moved.get(name, name) for name in scene.places}
    scale, font = points_a_metre(ax), style.LABEL
    places = {text: at[name] for name, text in names.items()}
    spots = offsets(list(places), [places], [taken], scale, 1.15 * scene.size * scale + 1.5)
    for name, text in names.items():
        middle, height = spots[text].tolist()
        split = middle - 0.5 * CHARACTER * font * len(text) + CHARACTER * font * (len(name) + 0.6)
        side, level = "right" if name in moves else "center", STRONG.level + 1.0
        here = np.array([split, height])
        haloed_beside(ax, name, at[name], here, font, style.INK, ha=side, fontstyle="italic", zorder=level)
        if name in moves:
            far, beside = text.removeprefix(name).strip(), np.array([split + 0.25 * font, height])
            haloed_beside(ax, far, at[name], beside, style.SMALL, style.ACCENT, ha="left", zorder=level)


CHARACTER = 0.6
"""The width of a character, in sizes of its font."""


# What counted, before and after.


def plot_optimum(optimum: Optimum) -> Figure:
    """Return the objective's quantity and each condition's over the stroke, before and after, the failing side of each limit shaded.

    Of several strokes it is the first that a quantity depends on; of the others that value counts which is the worst.
    """
    problem, groups = optimum.problem, dict[str, list[Leaf]]()
    measures: list[Measure] = [*problem.objectives, *(each.margin for each in problem.constraints)]
    for leaf in dict.fromkeys(leaf for each in measures for leaf in each.leaves):
        groups.setdefault(words_of(leaf.quantity), []).append(leaf)
    courses = []
    for leaves in groups.values():
        before, after = (problem.over_stroke(leaves[0], machine.dimensions, POSES) for machine in (optimum.start, optimum.machine))
        if before is not None and after is not None:
            courses.append((leaves, before, after))
    ensure(courses, f"{problem.plan.title}: neither the objective nor a condition is of something that changes over a stroke.")
    figure, cells = panel_grid(len(courses), problem.plan.heading)
    for ax, course in zip(cells, courses, strict=True):
        course_panel(ax, problem, *course)
    lines = [Line2D([], [], color=colour, linewidth=width) for colour, width in (BEFORE, AFTER)]
    texts = [said("before"), said("after")]
    figure.legend(lines, texts, loc="upper right", ncols=2, frameon=False, fontsize=style.TEXT, labelcolor=style.INK)
    return figure


MARKS = {"==": "x", ">=": "^", "<=": "v"}
"""How a value prescribed at one pose is marked; a triangle points to the side that is allowed."""
BEFORE, AFTER = (style.MUTED, 1.4), (style.CURVE, style.BOLD)


def course_panel(ax: Axes, problem: Problem, leaves: Sequence[Leaf], before: Course, after: Course) -> None:
    """Draw one quantity over its stroke before and after, with its limits and the values that are prescribed at one pose."""
    stroke, *old = before
    _, *new = after

    def is_shown(leaf: Leaf) -> bool:
        return any(leaf is each for each in leaves)  # itself: that two are equal would be a condition

    limits = [limit for each in problem.constraints if (limit := limit_on(each, is_shown)) is not None]
    unit, name = shown_in(stroke_display_unit(problem.plan, stroke, "mm")), typeset(words_of(leaves[0].quantity))
    both, column, shadow = (
        Column(name, values, unit_of_leaf(problem.plan, leaves[0])) for values in (np.concatenate([old[1], new[1]]), new[1], old[1])
    )
    along = StrokeAxis(stroke, unit, new[0] / factor(unit), "")
    ax.plot(old[0] / factor(unit), shadow.drawn, color=BEFORE[0], linewidth=BEFORE[1], zorder=4.5)
    ax.plot(along.values, column.drawn, color=AFTER[0], linewidth=AFTER[1], zorder=5.0)
    both_ways = replace(along, values=np.concatenate([old[0] / factor(unit), along.values]))
    stroke_panel(ax, both_ways, fill(column.heading, WIDEST), axis_range(both, limits))
    for limit in limits:
        mark_limit(ax, along, column, limit)
    for leaf, value, sign in (side for each in problem.constraints if (side := leaf_bound(each, is_shown)) is not None):
        if isinstance(leaf, At) and stroke in leaf.strokes:
            spot = [float(leaf.strokes[stroke]) / factor(unit)], [value / factor(column.shown_unit)]
            ax.plot(*spot, MARKS[sign], clip_on=False, color=style.ACCENT, markersize=6, markeredgewidth=1.5, zorder=6.0)
