"""A mechanism at its end positions, one bold and the others faint, with the paths of points."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..errors import DefinitionError, cited, ensure, is_listed, known_name, require, require_whole
from ..language import said, said_of
from ..mechanism import Mechanism, require_mechanism
from ..motion import Motion, least
from ..plan import require_kinds
from ..program import FloatArray
from ..quantities import is_number, is_whole, numbers_in
from ..reports import Run, first_stroke, reached_motion, stroke_middles
from ..units import require_measure
from . import style
from .drawing import Drawing, arrow_between, draw_scene, mechanism
from .free_body import draw_free_body
from .gap_marks import gap_asked
from .layout import cloud, grown, label_free, surrounding_points
from .overlays import Overlay, Overlays
from .pose_choice import telling_angles
from .scene import Pose, Scene
from .sheet import empty_page, footnote, legend_row, look_keys, remark, sheet, write_title
from .shown_values import named_points
from .strokes import is_turn, pose_words, unreached_words
from .style import FAINT, STRONG

MANY = 1_000_000
"""Poses of a path: more do not fit into a picture."""

ON_PATH = 6
"""So many covered points a place of a path counts for, where the values of forces and velocities are placed."""
FILLED = 1.0 / 3.0
"""The sheet holds the whole travel where what is drawn fills so much of its width and height; else it holds what is drawn."""


def draw_machine(
    machine: Mechanism | Motion, at: object, path: Sequence[str], count: int, overlays: Overlays, ax: Axes | None, pose: Pose,
    time: float | None, faint: bool,
) -> Figure | Drawing:
    """Return a mechanism's figure at chosen strokes, or a motion at one of its poses, on axes if they are given; see `draw`."""
    ensure(ax is None or not overlays, "draw(ax=...): forces, velocities, poles and gaps have a figure of their own; leave out ax=.")
    if isinstance(machine, Motion):
        is_plain = at is None and is_listed(path) and not path and is_whole(count) and count == 101
        title = machine.plan.title
        what = "a motion is drawn at one of its poses, pose=, over a path in time at an instant, time="
        ensure(is_plain, f"{title}: {what}; at=, path= and count= go with a machine.")
        machine, pose = (machine, pose) if time is None else with_instant(machine, time, pose)
        return mechanism(ax, machine, pose, faint=faint) if ax is not None else draw_pose(machine, pose, overlays, faint)
    require_mechanism(machine)
    what = f"{machine.plan.title}: time={cited(time)} is an instant of a motion"
    ensure(time is None, f'{what}; write draw(machine.sweep(101, over="..."), time={cited(time)}).')
    ensure(ax is None, f"{machine.plan.title}: ax= takes a motion, which has poses; write draw(machine.at(...), ax=ax).")
    return draw_strokes(machine, at, path, count, overlays)


def with_instant(motion: Motion, time: float, pose: Pose) -> tuple[Motion, int]:
    """Return a motion over a path in time that has an instant [s] among its poses, and its place; DefinitionError where it has none."""
    title, known, instants = motion.plan.title, motion.time, motion._instants
    if known is None or instants is None or not instants.courses:
        raise DefinitionError(f"{title}: time={cited(time)}: this motion has no courses over time; give pose=, a place among its poses.")
    begin, end = instants.breaks[[0, -1]].tolist()
    is_instant = is_number(time) and begin <= time <= end
    require(is_instant, f"{title}: time", time, f"an instant from {begin:.6g} to {end:.6g} s is expected")
    require(pose == 0, f"{title}: pose", pose, "time= says which pose is drawn; leave one of them out")
    require_measure(time, "time", f"{title}: time")
    place = int(np.searchsorted(known, time))
    if known[place : place + 1].tolist() == [time]:
        return motion, place
    shown = instants.at_times(np.insert(known, place, time))
    return Motion(motion.plan, motion.designs, shown.strokes, motion.unreachable, over=motion.over, instants=shown), place


def draw_pose(motion: Motion, pose: Pose, overlays: Overlays, faint: bool) -> Figure:
    """Return a figure of a motion at a pose, with its overlays."""
    scene = Scene(motion)
    index = scene.index(pose)
    if overlays.forces is not None and overlays.is_free_body(scene):
        return draw_free_body(motion, index, overlays.forces)
    laid = overlays.laid_over(motion, index, scene.box()) if overlays else None
    figure, ax = empty_page(laid.box(scene.size) if laid else scene.box())
    if laid is None:
        draw_scene(ax, scene, index, None if faint else (), FAINT if faint else STRONG)
    else:
        draw_laid(ax, scene, index, overlays, laid)
        footnote(figure, laid.sense)
        legend_row(ax, *ax.get_legend_handles_labels())
    heading = overlays.forces.pose_heading if overlays.forces else pose_words
    write_title(figure, motion.plan.heading, heading(motion, index))
    return figure


def draw_over(ax: Axes, motion: Motion, pose: Pose, overlays: Overlays) -> str:
    """Draw a motion at a pose, with its overlays, on empty axes; return how to read them."""
    scene = Scene(motion)
    laid = overlays.laid_over(motion, scene.index(pose), scene.box())
    sheet(ax, laid.box(scene.size))
    draw_laid(ax, scene, scene.index(pose), overlays, laid)
    return laid.sense


def draw_laid(ax: Axes, scene: Scene, index: int, overlays: Overlays, laid: Overlay) -> None:
    """Draw a pose, a flat index, on a sheet with its overlays."""
    if laid.worst is not None:
        Drawing(ax, scene, FAINT).update(laid.worst)
    draw_scene(ax, scene, index, [laid.points_covered(scene.size)])
    overlays.centrodes(ax, scene.motion)
    at = scene.at(index)
    laid.draw(ax, scene.size, np.concatenate([*label_free(scene, [at]), surrounding_points(scene, at)]))


def draw_strokes(machine: Mechanism, at: object, path: Sequence[str], count: int, overlays: Overlays) -> Figure:
    """Return a figure of a mechanism at chosen strokes: the last one bold with its overlays, the others faint."""
    path = named_points(machine, path, "path")
    if overlays.has_gap and at is None:
        pairs, _ = overlays.pairs(machine.at(unreachable="nan", **stroke_middles(machine)))
        (answer,) = machine.answers([least(gap_asked(overlays.clearance, machine.plan, pairs))])
        at = {name: float(value) for name, value in answer.strokes.items()}  # no others: what it runs may be less than its strokes
    require_whole("count", count, "a path is drawn through 2 poses or more; give a whole number such as 101", least=2, most=MANY)
    moving, shown, swept = motions(machine, at, count)
    whole, last = Scene(swept), Scene(shown).reached[-1]
    if overlays.forces is not None and overlays.is_free_body(whole):
        return draw_free_body(shown, last, overlays.forces)
    paths = np.concatenate([np.empty((0, 2)), *(whole.places[name].T for name in path)])
    paths = paths[np.isfinite(paths).all(axis=1)]
    drawn = grown(Scene(shown, swept).box(), paths, 3.0 * whole.size)
    (left, right, bottom, top), (x0, x1, y0, y1) = drawn, whole.box()
    is_filled = min((right - left) / (x1 - x0), (top - bottom) / (y1 - y0)) >= FILLED
    box = whole.box() if is_filled else drawn
    laid = overlays.laid_over(shown, last, box) if overlays else None
    figure, ax = empty_page(laid.box(whole.size) if laid else box)
    words = said_of(len(path), "path of {points}", "paths of {points}", points=", ".join(path))
    for name in path:
        trace(ax, whole.places[name], words if name == path[0] else "")
    clear = [whole.places[name].T for name in path] + ([laid.points_covered(whole.size)] if laid else [])
    draw_poses(ax, shown, swept, clear)
    if laid:
        overlays.centrodes(ax, swept)
        poses = Scene(shown)
        faint = [cloud(whole, poses.at(pose))[::3] for pose in poses.reached[:-1]]
        at = poses.at(last)
        laid.draw(ax, whole.size, np.concatenate([*label_free(whole, [at]), surrounding_points(whole, at), *faint, *[paths] * ON_PATH]))
        footnote(figure, laid.sense)
    # Write the title, and which pose is which.
    scene = Scene(shown)
    held = [name for name in shown.strokes if name not in moving]
    write_title(figure, shown.plan.heading, said("at {place}", place=pose_words(shown, 0, held)) if held else "")
    keys = look_keys([FAINT] * (len(scene.reached) - 1) + [STRONG])
    texts = [pose_words(shown, pose, moving) for pose in scene.reached]
    lines, names = ax.get_legend_handles_labels()
    legend_row(ax, [*keys, *lines], [*texts, *names])
    lost = int(np.count_nonzero(~swept.reached))
    if len(moving) == 1:
        remark(figure, ax, unreached_words(swept, moving[0]))
    elif lost:
        remark(figure, ax, said("not reached at {lost} of {all} poses on the way", lost=lost, all=swept.reached.size))
    return figure


def motions(machine: Mechanism, at: object, count: int) -> tuple[tuple[str, ...], Motion, Motion]:
    """Return the strokes that move, the motion at the chosen values, and the one over the whole stroke, or along several at once."""
    given: dict[str, Any] = dict(at) if isinstance(at, Mapping) else {first_stroke(machine): at}
    for name in given:
        known_name("Stroke", name, machine.strokes, where=machine.plan.title)
    several = tuple(name for name, values in given.items() if np.size(values) > 1)
    is_joint = len(several) > 1
    moving = several if is_joint else (max(given, key=lambda name: np.size(given[name])) if given else first_stroke(machine),)
    chosen: dict[str, FloatArray] = {}
    for name, each in given.items():
        if each is not None or is_joint:
            require_kinds(machine.plan, {name: each})
            numbers = numbers_in(each)
            is_given = numbers.size and np.isfinite(numbers).all()
            require(is_given, f"{machine.plan.title}: at", each, f"values of {name} are expected, such as at=[0.0, 0.1]")
            chosen[name] = numbers.ravel()
    values: dict[str, Any] = stroke_middles(machine) | chosen
    first = moving[0]
    ends = machine.strokes[first].start, machine.strokes[first].end
    if first not in chosen:
        values[first] = telling_angles(machine, first, values) if is_turn(machine, Run({first: ends}, {})) else np.array(ends)
    shown = reached_motion(machine, values)
    if is_joint:  # from each of their values on to the next
        ways = {name: tuple(chosen[name].tolist()) for name in moving}
        still = {name: float(np.ravel(value)[0]) for name, value in values.items() if name not in moving}
        return moving, shown, machine.at(unreachable="nan", **Run(ways, still).divided(count))
    reach = np.array([*ends, *np.ravel(values[first])])
    still = {name: float(np.ravel(value)[-1]) for name, value in values.items()}
    return moving, shown, machine.at(unreachable="nan", **still | {first: np.linspace(reach.min(), reach.max(), count)})


def draw_poses(ax: Axes, shown: Motion, swept: Motion, keep_clear: Sequence[FloatArray]) -> None:
    """Draw the poses of a motion, the last one in reach bold."""
    scene = Scene(shown, swept)
    *others, last = scene.reached
    for pose in others:
        Drawing(ax, scene, FAINT).update(pose)
        keep_clear = [*keep_clear, cloud(scene, scene.at(pose))[::3]]
    draw_scene(ax, scene, last, [points[np.isfinite(points).all(axis=1)] for points in keep_clear])


# Paths of points: a dotted curve, an arrow for the direction.

CLOSED = 1e-6
"""A path whose ends are so near to each other, compared with its length, is closed."""


def trace(ax: Axes, path: FloatArray, label: str = "", colour: str = style.ACCENT) -> None:
    """Draw the path of a point, shape (2, n) [m], from its first pose to its last; gaps where it is not reached."""
    ax.plot(*path, color=colour, linewidth=1.6, linestyle=(0, (0.1, 1.9)), dash_capstyle="round", zorder=7.0, label=label or None)
    arrow = on_its_way(path)
    if arrow is not None:
        arrow_between(ax, *arrow, colour, 16, 7.2, width=0)


def on_its_way(path: FloatArray) -> tuple[FloatArray, FloatArray] | None:
    """Return two neighbouring points in the middle of a path's length, or None where it has none.

    Of a closed path they stand before it: there the middle pose is drawn, and a slider turns back.
    """
    steps = np.hypot(*np.diff(path))
    steps = np.where(np.isfinite(steps), steps, 0.0)
    if not steps.sum() > 0.0:
        return None
    is_closed = bool(np.hypot(*(path[:, -1] - path[:, 0])) < CLOSED * steps.sum())
    middle = int(np.searchsorted(np.cumsum(steps), (0.3 if is_closed else 0.5) * steps.sum()))
    while not steps[middle] > 0.0:
        middle += 1
    return path[:, middle], path[:, middle + 1]
