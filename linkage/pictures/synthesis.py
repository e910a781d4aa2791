"""Results of a synthesis: the best machines side by side, each beside its task, with its misses."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from ..errors import StudyError, require_whole
from ..language import said, said_of
from ..motion import Column, stroke_display_unit
from ..motion.measures import measure_of, words_of
from ..program import FloatArray
from ..synthesis import FunctionTask, PathTask, PoseTask, Synthesis, SynthesisedMachine
from ..synthesis.synthesis import CLOSEST_CHANGE_POINT, EXACT, miss_unit
from ..units import display_unit, factor, show, shown_in
from . import style
from .curves import axis_range, stroke_panel
from .drawing import body_part, draw_scene
from .labels import offsets
from .layout import cloud, grown
from .poses import trace
from .scene import Bounds, Scene
from .shapes import polar
from .sheet import LEFT, figure_of, haloed_beside, points_a_metre, sheets_beside, write_title
from .shown_values import typeset
from .strokes import StrokeAxis, stroke_words
from .style import FAINT

MOST_ANSWERS = 12
"""The answers in one picture."""
SEEN = 0.07
"""Of a sheet's larger side: the largest miss that is drawn is about so long."""
STRETCHES = tuple(step * 10**power for power in range(7) for step in (1, 2, 5))
NOTHING_MISSED = 1e-9
"""Of a sheet: a miss that is smaller is none."""
MOST_NUMBERED = 12
"""Points that are all numbered; of more it is every fifth."""


class ShownAnswer:
    """An answer as it is drawn: its place, the task in the names of its class, the stroke that moves, and the point that is to come there.

    `swept` is the machine over its whole stroke, `reached` where it comes to the points of the task, in `scene` with room for all. `wanted`
    are the places that the task wants, none for a function, and `met` where the point comes to, shape (n, 2) [m].
    """

    def __init__(self, found: Synthesis, answer: SynthesisedMachine, place: int, count: int) -> None:
        self.answer, self.place, self.fit = answer, place, found.fit_of(answer)
        self.task, timing = found.own(answer).task, self.fit.timing
        self.stroke, self.point = str(timing.stroke), str(self.task.of).split()[0]
        ways = timing.start + timing.span * np.linspace(0.0, 1.0, count), answer.strokes
        motions = (answer.machine.at(unreachable="nan", **{**self.fit.held, timing.stroke: way}) for way in ways)
        self.swept, self.reached = motions
        self.scene = Scene(self.reached, self.swept)
        match self.task:
            case PathTask(points=points):
                self.wanted = points
            case PoseTask(x=x, y=y):
                self.wanted = np.stack([x, y], axis=1)
            case FunctionTask():
                self.wanted = np.empty((0, 2))

    @property
    def met(self) -> FloatArray:
        """Where its point comes to, shape (n, 2) [m]."""
        return np.asarray(self.reached[self.point].T)

    def box(self) -> Bounds:
        """Return the box around the machine and its task [m]."""
        return grown(Scene(self.swept).box(), self.wanted, 2.0 * self.scene.size)


def draw_synthesis(found: Synthesis, answers: int = 3, count: int = 101) -> Figure:
    """Return the best answers of a synthesis side by side, each with its task and its misses; see `draw`.

    Raises StudyError where there is none, with the nearest miss.
    """
    require_whole("answers", answers, f"a whole number from 1 to {MOST_ANSWERS} is expected", least=1, most=MOST_ANSWERS)
    require_whole("count", count, "a whole number of poses is expected, at least 2", least=2)
    if not found.solutions:
        raise StudyError(str(found))
    shown = [ShownAnswer(found, each, place, count) for place, each in enumerate(found.solutions[:answers], 1)]
    figure, sheets, curves = sheets_beside([each.box() for each in shown], has_curve=isinstance(found.task, FunctionTask))
    sides = [float(np.ptp(ax.get_xlim())) for ax in sheets]  # the largest miss is so many times as long that it can be seen on its sheet
    with_points = [(each, side) for each, side in zip(shown, sides, strict=True) if len(each.wanted)]
    most = max((float(np.linalg.norm(each.met - each.wanted, axis=1).max()) / side for each, side in with_points), default=0.0)
    stretch = float(max((step for step in STRETCHES if step * most <= SEEN), default=1.0)) if most >= NOTHING_MISSED else 0.0
    alone = len({one.answer.machine.plan.title for one in shown}) == 1
    for each, ax, top in zip(shown, sheets, curves or sheets, strict=True):
        match each.task:
            case PathTask():
                path = each.swept[each.point].reshape(2, -1)
                trace(ax, path)
                keep_clear = [draw_wanted(ax, each, stretch), path.T[np.isfinite(path.T).all(axis=1)]]
                draw_scene(ax, each.scene, 0, keep_clear, all_points=False)
            case PoseTask() as task:
                draw_pose_task(ax, each, task, stretch)
            case FunctionTask() as task:
                draw_function_task(ax, top, each, task)
        write_answer(top, each, alone=alone)
    heading = said_of(len(found.classes), "{n} class", "{n} classes") if found.classes else found.start.plan.heading
    write_title(figure, heading, task_words(found))
    keys, texts = legend_of(found, stretch)
    width, height = (float(each) for each in figure.get_size_inches())
    figure.legend(
        keys, texts, loc="upper left", bbox_to_anchor=(LEFT / width, 1.0 - 0.34 / height), ncols=len(texts), frameon=False,
        borderaxespad=0.0, borderpad=0.1, fontsize=style.TEXT, labelcolor=style.INK, handlelength=1.6, columnspacing=1.8,
        handletextpad=0.6,
    )  # fmt: skip
    return figure


# The paper: what stands on it beside the sheets.


def task_words(found: Synthesis) -> str:
    """Return a task in words."""
    task, n = found.task, found.fits[0].rows.count
    match task:
        case PathTask():
            return said_of(n, "path of {point} through {n} point", "path of {point} through {n} points", point=task.of, n=n)
        case PoseTask():
            return said_of(n, "{n} pose of the body of {points}", "{n} poses of the body of {points}", points=task.of, n=n)
        case FunctionTask():
            return said_of(n, "{quantity} at {n} stroke", "{quantity} at {n} strokes", quantity=words_of(task.of), n=n)


def legend_of(found: Synthesis, stretch: float) -> tuple[list[Line2D], list[str]]:
    """Return the legend of the lines."""
    wanted = Line2D([], [], color=style.CURVE, marker="o", markersize=5, markerfacecolor=style.PAPER, linestyle="none", markeredgewidth=1.6)
    missed = Line2D([], [], color=style.INK, linewidth=1.4)
    if isinstance(found.task, FunctionTask):
        curve = Line2D([], [], color=style.CURVE, linewidth=style.BOLD)
        return [wanted, curve, missed], [said("wanted"), said("reached"), said("missed")]
    path = Line2D([], [], color=style.ACCENT, linewidth=1.6, linestyle=(0, (0.1, 1.9)), dash_capstyle="round")
    if isinstance(found.task, PoseTask):
        wanted = Line2D([], [], color=style.CURVE, linewidth=2.0, marker="o", markersize=5, markerfacecolor=style.PAPER)
    point = found.task.of.split()[0]
    keys, texts = [wanted, path], [said("wanted"), said_of(1, "path of {points}", "paths of {points}", points=point)]
    if stretch:
        keys.append(missed)
        texts.append(said("missed") if stretch == 1.0 else said("missed, {times} times as long", times=f"{stretch:.0f}"))
    return keys, texts


def write_answer(ax: Axes, shown: ShownAnswer, *, alone: bool) -> None:
    """Write above an answer its place, its misses, and its least transmission angle; its class unless all are of one."""
    answer, unit = shown.answer, miss_unit(shown.fit)
    figure = figure_of(ax)
    place, height = ax.get_position(original=True), float(figure.get_figheight())
    rms, most = show(answer.rms, unit, 4), show(answer.most, unit, 4)
    misses = said("rms {rms}, at most {most} at point {worst}", rms=rms, most=most, worst=answer.worst)
    is_exact = answer.most <= EXACT * shown.fit.rows.size
    misses = said("exact") if is_exact else misses
    angle = 0.0 if answer.transmission < CLOSEST_CHANGE_POINT else answer.transmission
    least = said("least transmission angle {angle}", angle=show(angle, "deg", 3)) if np.isfinite(angle) else ""
    first, second = (misses, least) if alone else (answer.machine.plan.heading, misses)
    first, high = f"{shown.place}.  {first}", place.y1 + 0.31 / height
    if not alone:
        figure.text(place.x1, high, least, fontsize=style.SMALL, color=style.MUTED, va="center", ha="right")
    figure.text(place.x0, high, first, fontsize=style.TEXT, fontweight="bold", color=style.INK, va="center")
    figure.text(place.x0, place.y1 + 0.12 / height, second, fontsize=style.SMALL, color=style.MUTED, va="center")


# An answer beside its task.


def draw_wanted(ax: Axes, shown: ShownAnswer, stretch: float) -> FloatArray:
    """Mark the wanted places with their numbers, and each miss, so many times as long as it is.

    Of many points every fifth has a number. These cover neither the machine, its path nor the misses' ends. Returns points (m, 2) [m]
    that marks, misses and numbers cover.
    """
    wanted, off = shown.wanted, shown.met - shown.wanted
    side = float(np.ptp(ax.get_xlim()))
    for place, miss in zip(wanted, off, strict=True):
        if stretch and float(np.hypot(*miss)) * stretch > 0.002 * side:
            end = place + stretch * miss
            ax.plot(*np.stack([place, end], axis=1), color=style.INK, linewidth=1.4, zorder=12.2, solid_capstyle="butt")
    wide = 5.0 if len(wanted) <= MOST_NUMBERED else 3.4
    ax.plot(*wanted.T, "o", color=style.CURVE, markerfacecolor=style.PAPER, markersize=wide, markeredgewidth=1.6, zorder=12.5)
    ends, scale = wanted + stretch * off, points_a_metre(ax)
    numbers = [n for n in range(1, len(wanted) + 1) if len(wanted) <= MOST_NUMBERED or n == 1 or n % 5 == 0]
    at = {str(n): wanted[n - 1] for n in numbers}
    path = shown.swept[shown.point].reshape(2, -1).T
    misses = np.linspace(wanted, ends, 9).reshape(-1, 2)
    taken = np.concatenate([cloud(shown.scene, shown.scene.at(0))[::2], path[np.isfinite(path).all(axis=1)], misses])
    covered = []
    for number, spot in offsets([*at], [at], [taken], scale, 5.0, style.SMALL).items():
        haloed_beside(ax, number, at[number], spot, style.SMALL, style.CURVE, 2.2, ha="center", fontweight="bold", zorder=12.6)
        covered += [at[number] + (spot + 0.3 * style.SMALL * np.array(corner)) / scale for corner in CORNERS]
    return np.concatenate([wanted, ends, np.array(covered)])


CORNERS = ((-1, -1), (-1, 1), (0, 0), (1, -1), (1, 1))


def draw_pose_task(ax: Axes, shown: ShownAnswer, task: PoseTask, stretch: float) -> None:
    """Draw the machine at the first pose, its body faint at the others, and the wanted poses as lines along the body."""
    scene = shown.scene
    first, second = task.of.split()
    trace(ax, shown.swept[first].reshape(2, -1))
    bodies = [(plate, style.PALETTE[place]) for plate, place in zip(scene.plates, scene.colours, strict=True)]
    for pose in scene.reached[1:]:
        for plate, colour in bodies:
            if {first, second} <= set(plate.points):
                body_part(ax, plate, scene.size, colour, FAINT).update(scene.at(pose))
    long = float(np.nanmax(np.hypot(*(shown.reached[second] - shown.reached[first]))))
    ends = shown.wanted + long * polar(task.angle)
    for start, end in zip(shown.wanted, ends, strict=True):
        ax.plot(*np.stack([start, end], axis=1), color=style.CURVE, linewidth=2.0, zorder=12.0, solid_capstyle="round")
    draw_scene(ax, scene, 0, [draw_wanted(ax, shown, stretch), ends], all_points=False)


def draw_function_task(sheet: Axes, ax: Axes, shown: ShownAnswer, task: FunctionTask) -> None:
    """Draw the machine at the first of the task's strokes, its quantity over the stroke, the wanted values and the misses."""
    plan = shown.answer.machine.plan
    draw_scene(sheet, shown.scene, 0, [], all_points=False)
    words = stroke_words(plan, shown.stroke, float(shown.answer.strokes[0]))
    sheet.set_title(words, fontsize=style.SMALL, color=style.MUTED, loc="right", pad=3)
    unit = shown_in(stroke_display_unit(plan, shown.stroke, "mm"))
    measure = measure_of(plan, task.of)
    name, by = typeset(words_of(task.of)), factor(unit)
    along, values = np.asarray(shown.swept.strokes[shown.stroke]), np.asarray(shown.swept[task.of])
    wanted, reached = np.array(task.values), shown.answer.reached[0]
    if measure == "angle":  # all on one turn
        order = np.argsort(along)
        near = np.interp(shown.answer.strokes, along[order], values[order])
        wanted, reached = (each + 2.0 * np.pi * np.round((near - each) / (2.0 * np.pi)) for each in (wanted, reached))
    column = Column(name, np.concatenate([values, wanted]), display_unit(measure, "mm"))
    drawn, scale = column.drawn, factor(column.shown_unit)
    ax.plot(along / by, drawn[: len(along)], color=style.CURVE, linewidth=style.BOLD, zorder=5.0)
    for at, one, other in zip(shown.answer.strokes / by, wanted / scale, reached / scale, strict=True):
        ax.plot([at, at], [one, other], color=style.INK, linewidth=1.4, zorder=5.5, solid_capstyle="butt")
    ax.plot(
        shown.answer.strokes / by, wanted / scale, "o", color=style.CURVE, markerfacecolor=style.PAPER, markersize=5, markeredgewidth=1.6,
        zorder=6.0, clip_on=False,
    )  # fmt: skip
    stroke_panel(ax, StrokeAxis(shown.stroke, unit, along / by, ""), "", axis_range(column))
    ax.set_ylabel(column.heading, fontsize=style.TEXT, color=style.MUTED)
