"""Results of a synthesis: the best machines side by side, each beside its task, with its misses; and the curves of Burmester's theory."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from ..errors import StudyError, require_whole
from ..language import said, said_of
from ..motion import Column, stroke_display_unit
from ..motion.measures import measure_of, words_of
from ..motion.regions import Disc
from ..program import FloatArray
from ..synthesis import FunctionTask, PathTask, PoseTask, Synthesis, SynthesisedMachine
from ..synthesis.exact_poses import Burmester, GuidingLink
from ..synthesis.synthesis import CLOSEST_CHANGE_POINT, EXACT, miss_unit
from ..units import display_unit, factor, show, shown_in
from . import style
from .curves import axis_range, stroke_panel
from .drawing import body_part, draw_scene
from .layout import cloud, grown, offsets
from .poses import trace
from .scene import Bounds, Scene
from .shapes import left_of, polar
from .sheet import LEFT, Keywords, empty_page, figure_of, haloed_beside, legend_row, points_a_metre, sheets_beside, write_title
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


ROOM = 1.6
"""Of the extent of poses and region: how much of the plane is shown, where the curves go on."""
ARM = 0.09
"""Of the picture's side: the arms of a pose."""


def draw_burmester(found: Burmester) -> Figure:
    """Return a figure of the two curves and the links in the first pose, those of the best machine bold with its coupler."""
    chosen = np.zeros((0, 2))  # the circle points of the best machine in the first pose [m]
    if found.solutions:
        best = found.solutions[0]
        motion = best.machine.at(phi=best.strokes[:1])
        chosen = np.stack([motion["A"][:, 0], motion["B"][:, 0]])
    box = shown_box(found, chosen)
    figure, ax = empty_page(box)
    side = max(box[1] - box[0], box[3] - box[2])
    keys: list[Line2D] = []
    texts: list[str] = []
    if found.region is not None:
        for level, shapes, colour in ((0.5, found.region.within, style.GRID), (0.6, found.region.without, style.PAPER)):
            for shape in shapes:
                if isinstance(shape, Disc):
                    border = np.array([shape.x, shape.y]) + shape.radius * polar(np.linspace(0.0, 2.0 * np.pi, 181))
                else:
                    border = np.array(shape.corners)
                ax.fill(*border.T, facecolor=colour, edgecolor=style.RULE, zorder=level)
        keys.append(Line2D([], [], color=style.GRID, linewidth=8.0))
        texts.append(said("region of the fixed pivots"))
    points, centres = said("circle points"), said("centre points")
    curves = ((found.circle_curve, style.CURVE, points, "o"), (found.centre_curve, style.ACCENT, centres, "^"))
    for branches, colour, text, marker in curves:
        for branch in branches:
            closed = np.concatenate([branch, branch[:, :1]], axis=1)
            is_near = np.append(np.hypot(*np.diff(closed, axis=1)) < 4.0 * side, True)  # else it goes through infinity
            ax.plot(*np.where(is_near, closed, np.nan), color=colour, linewidth=1.6, zorder=3.0)
        keys.append(Line2D([], [], color=colour, linewidth=1.6 if branches else 0.0, marker=marker, markeredgecolor=style.INK))
        texts.append(text)
    if len(chosen):
        ax.fill(*np.concatenate([chosen, found.poses[:1, :2]]).T, facecolor=style.BODIES[0], edgecolor=style.INK, alpha=0.35, zorder=1.5)
    for link in found.links:
        draw_link(ax, link, side, bold=any(np.allclose(link.point, pin) for pin in chosen))
    draw_corners(ax, found.poses, ARM * side)
    ax.set(xlim=box[:2], ylim=box[2:])
    legend_row(ax, keys, texts)
    running, count = len(found.solutions), len(found.synthesis.all)
    beside = said("{running} of {count} machines run", running=running, count=count)
    write_title(figure, said("Burmester: {count} poses", count=len(found.poses)), beside)
    return figure


def shown_box(found: Burmester, pins: FloatArray) -> Bounds:
    """Return the box that is shown [m]: about poses, region, and the best machine's pins (2, 2) [m]."""
    shapes = found.region.within if found.region is not None else ()
    parts = [found.poses[:, :2], *(shape.bounding_box for shape in shapes)]
    places = [link.places for link in found.links if any(np.allclose(link.point, pin) for pin in pins) or len(found.poses) == 5]
    centres = [link.centre[None] for link in found.links if len(found.poses) == 5 and not link.slides]
    cloud = np.concatenate([*parts, *places, *centres, pins])
    cloud = cloud[np.isfinite(cloud).all(axis=1)]
    near = np.abs(cloud - np.median(cloud, axis=0)).max(axis=1) <= 12.0 * max(float(np.ptp(parts[0], axis=0).max()), 1e-9)
    low, high = cloud[near].min(axis=0), cloud[near].max(axis=0)
    middle, half = 0.5 * (low + high), 0.5 * ROOM * np.maximum(high - low, 0.4 * float((high - low).max()) or 1.0)
    return float(middle[0] - half[0]), float(middle[0] + half[0]), float(middle[1] - half[1]), float(middle[1] + half[1])


def draw_link(ax: Axes, link: GuidingLink, side: float, *, bold: bool) -> None:
    """Draw a link in the first pose: its circle point and, of one that turns, its centre point; of a slider its line."""
    colour = style.INK if bold else style.MUTED
    width, size, level = (2.4, 7.0, 6.0) if bold else (0.7, 3.5, 4.0)
    x, y = link.point
    if link.slides:
        way = 0.5 * side * polar(link.direction)
        ax.plot([x - way[0], x + way[0]], [y - way[1], y + way[1]], color=colour, linewidth=width, linestyle=(0, (6, 3)), zorder=level)
    else:
        ax.plot([x, link.centre[0]], [y, link.centre[1]], color=colour, linewidth=width, zorder=level, alpha=1.0 if bold else 0.55)
        ax.plot(*link.centre, "^", color=style.ACCENT, markersize=size + 1.0, markeredgecolor=style.INK, zorder=level + 1.0)
    ax.plot(x, y, "o", color=style.CURVE, markersize=size, markeredgecolor=style.INK, zorder=level + 1.0)


def draw_corners(ax: Axes, poses: FloatArray, arm: float) -> None:
    """Draw each pose as a corner whose long arm is the body's own x axis, with its number, and a line from one to the next."""
    for one, other in pairwise(poses):
        ax.plot([one[0], other[0]], [one[1], other[1]], color=style.RULE, linewidth=0.9, linestyle=":", zorder=2.0)
    for number, (x, y, angle) in enumerate(poses, 1):
        along, across = polar(angle), left_of(polar(angle))
        corner = np.array([[x, y] + arm * along, [x, y], [x, y] + 0.5 * arm * across])
        ax.plot(*corner.T, color=style.INK, linewidth=2.2, solid_joinstyle="round", zorder=7.0)
        beside = np.array([x, y]) - 0.2 * arm * (along + across)
        look: Keywords = {"fontsize": style.LABEL, "color": style.INK, "ha": "center", "va": "center"}
        ax.text(float(beside[0]), float(beside[1]), str(number), zorder=8.0, **look)
