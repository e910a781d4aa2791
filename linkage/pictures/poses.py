"""A mechanism at its end positions, one bold and the others faint, with the paths of points."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from ..errors import DefinitionError, cited, known_name, unknown
from ..mechanism import Mechanism, require_mechanism
from ..motion import Motion
from ..program import FloatArray
from ..quantities import is_whole, real
from ..reports import Run, first_stroke, stroke_middles
from . import style
from .drawing import Drawing, mechanism
from .free_space import cloud
from .scene import Bounds, Scene
from .sheet import Picture, sheet
from .strokes import is_turn, others_in_words, stroke_words, unreached_words
from .style import FAINT, STRONG

WIDTH = 9.0
LEAST, MOST = 4.2, 10.0
LEFT, RIGHT, BOTTOM, TOP = 0.75, 0.2, 0.6, 0.7
"""The figure's width, the range of its height, and the room around the sheet [inch]."""

MANY = 1_000_000
"""Poses of a path: more do not fit into a picture."""


def draw(
    machine: Mechanism | Motion,
    at: Any = None,
    path: Sequence[str] = (),
    count: int = 101,
    *,
    ax: Axes | None = None,
    pose: int | tuple[int, ...] = 0,
    faint: bool = False,
) -> Figure | Drawing:
    """Return a mechanism's figure at chosen strokes, or a motion at one of its poses, on axes if they are given; see `linkage.draw`."""
    if isinstance(machine, Motion):
        if at is not None or path or count != 101:
            raise DefinitionError(
                f"{machine.plan.title}: a motion is drawn at one of its poses, pose=; at=, path= and count= go with a machine."
            )
        return draw_pose(machine, pose, ax=ax, faint=faint)
    require_mechanism(machine)
    if ax is not None:
        raise DefinitionError(f"{machine.plan.title}: ax= takes a motion, which has poses; write draw(machine.at(...), ax=ax).")
    return draw_strokes(machine, at, path, count)


def draw_pose(motion: Motion, pose: int | tuple[int, ...] = 0, *, ax: Axes | None = None, faint: bool = False) -> Figure | Drawing:
    """Return a motion drawn at a pose: as a figure of its own, or as what can be updated on the axes `ax`."""
    if ax is not None:
        return mechanism(ax, motion, pose, faint=faint)
    scene = Scene(motion)
    figure, own = empty_page(scene.box())
    mechanism(own, motion, pose, faint=faint)
    index = scene.index(pose)
    where = [stroke_words(motion.plan, name, float(values.ravel()[index])) for name, values in motion.strokes.items()]
    title(figure, motion.plan.heading, ", ".join(where))
    return figure


def draw_strokes(machine: Mechanism, at: Any, path: Sequence[str], count: int) -> Figure:
    """Return a figure of a mechanism at chosen strokes: the last one bold, the others faint."""
    path = named_points(machine, path, "path")
    if not is_whole(count) or not 2 <= count <= MANY:
        raise DefinitionError(f"count={cited(count)}: a path is drawn through 2 poses or more; give a whole number such as 101.")
    moving, shown, swept = motions(machine, at, count)
    whole = Scene(swept)
    figure, ax = empty_page(whole.box())
    for name in path:
        trace(ax, whole.places[name], f"path{'s' if len(path) > 1 else ''} of {', '.join(path)}" if name == path[0] else "")
    draw_poses(ax, shown, swept, [whole.places[name].T for name in path])
    heading(figure, ax, shown, moving)
    remark(figure, ax, unreached_words(swept, moving))
    return figure


def motions(machine: Mechanism, at: Any, count: int) -> tuple[str, Motion, Motion]:
    """Return the stroke that moves, the motion at the chosen values, and the one over the whole stroke."""
    given: dict[str, Any] = dict(at) if isinstance(at, Mapping) else {first_stroke(machine): at}
    moving = max(given, key=lambda name: np.size(given[name])) if given else first_stroke(machine)
    if moving not in machine.strokes:
        raise unknown("Stroke", moving, machine.strokes, where=machine.plan.title)
    start, end = machine.strokes[moving].start, machine.strokes[moving].end
    usual = (0.5 * (start + end), start) if is_turn(machine, Run({moving: (start, end)}, {})) else (start, end)
    given_values = {name: np.atleast_1d(chosen_values(machine, name, usual if value is None else value)) for name, value in given.items()}
    at_values: dict[str, Any] = stroke_middles(machine) | given_values
    shown = machine.at(unreachable="nan", **at_values)
    if not shown.reached.any():
        machine.at(**at_values)
    reach = np.array([start, end, *np.ravel(at_values[moving])])
    still = {name: float(np.ravel(value)[-1]) for name, value in at_values.items()}
    swept = machine.at(unreachable="nan", **still | {moving: np.linspace(reach.min(), reach.max(), count)})
    return moving, shown, swept


def chosen_values(machine: Mechanism, name: str, value: Any) -> FloatArray:
    """Return a stroke's values; DefinitionError for anything but finite numbers, one at least."""
    try:
        values = real(value)
    except ValueError:
        values = np.empty(0)
    if not values.size or not np.isfinite(values).all():
        raise DefinitionError(f"{machine.plan.title}: at={cited(value)}: values of {name} are expected, such as at=[0.0, 0.1].")
    return values


def named_points(machine: Mechanism, names: Any, what: str) -> tuple[str, ...]:
    """Return the names of points whose paths are drawn; DefinitionError for anything but a list of such names."""
    if not isinstance(names, (list, tuple)):
        raise DefinitionError(f'{machine.plan.title}: {what}={cited(names)}: a list of points is expected, such as {what}=["G"].')
    return tuple(known_name("Point", name, machine.plan.points, where=machine.plan.title) for name in names)


def empty_page(box: Bounds) -> tuple[Figure, Axes]:
    """Return a figure with a sheet that fits a box [m]."""
    left, right, bottom, top = box
    wide = WIDTH - LEFT - RIGHT
    high = float(np.clip(wide * (top - bottom) / (right - left), LEAST - BOTTOM - TOP, MOST - BOTTOM - TOP))
    height = high + BOTTOM + TOP
    figure = Picture(figsize=(WIDTH, height), dpi=style.DPI, facecolor=style.PAPER)
    FigureCanvasAgg(figure)
    ax = figure.add_axes((LEFT / WIDTH, BOTTOM / height, wide / WIDTH, high / height))
    sheet(ax, box)
    return figure, ax


def draw_poses(ax: Axes, shown: Motion, swept: Motion, keep_clear: Sequence[FloatArray]) -> None:
    """Draw the poses of a motion, the last one in reach bold."""
    scene = Scene(shown, swept)
    *others, last = scene.reached
    for pose in others:
        Drawing(ax, scene, FAINT).update(pose)
        keep_clear = [*keep_clear, cloud(scene, scene.at(pose))[::3]]
    bold = Drawing(ax, scene, STRONG)
    bold.ground()
    bold.label([scene.at(last)], [points[np.isfinite(points).all(axis=1)] for points in keep_clear])
    bold.update(last)


def title(figure: Figure, text: str, beside: str = "") -> None:
    """Write the title, and at its right end what stands beside it."""
    top = 1.0 - 0.24 / float(figure.get_figheight())
    figure.text(LEFT / WIDTH, top, text, fontsize=style.TITLE, fontweight="bold", color=style.INK, va="center")
    if beside:
        figure.text(1.0 - RIGHT / WIDTH, top, beside, fontsize=style.TEXT, color=style.MUTED, va="center", ha="right")


def remark(figure: Figure, ax: Axes, text: str) -> None:
    """Write in a warning colour, above the sheet's right end, what the picture does not show."""
    if text:
        level = ax.get_position(original=True).y1 + 0.13 / float(figure.get_figheight())
        figure.text(1.0 - RIGHT / WIDTH, level, text, fontsize=style.TEXT, color=style.ACCENT, va="center", ha="right")


def heading(figure: Figure, ax: Axes, shown: Motion, moving: str) -> None:
    """Write the title, and which pose is which."""
    scene = Scene(shown)
    held = others_in_words(shown, moving)
    title(figure, shown.plan.heading, f"at {held}" if held else "")
    values = [float(shown.strokes[moving].ravel()[pose]) for pose in scene.reached]
    looks = [FAINT] * (len(values) - 1) + [STRONG]
    keys = [Line2D([], [], color=look.colour(style.INK), linewidth=4.0, solid_capstyle="round") for look in looks]
    texts = [stroke_words(shown.plan, moving, value) for value in values]
    lines, names = ax.get_legend_handles_labels()
    ax.legend(
        [*keys, *lines], [*texts, *names], loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=6, frameon=False,
        borderaxespad=0.0, borderpad=0.25, fontsize=style.TEXT, labelcolor=style.INK,
        handlelength=1.6, columnspacing=1.8, handletextpad=0.6,
    )  # fmt: skip


# Paths of points: a dotted curve, an arrow for the direction.

CLOSED = 1e-6
"""A path whose ends are so near to each other, compared with its length, is closed."""


def trace(ax: Axes, path: FloatArray, label: str = "") -> None:
    """Draw the path of a point, shape (2, n) [m], from its first pose to its last; gaps where it is not reached."""
    ax.plot(*path, color=style.ACCENT, linewidth=1.6, linestyle=(0, (0.1, 1.9)), dash_capstyle="round", zorder=7.0, label=label or None)
    arrow = on_its_way(path)
    if arrow is not None:
        tail, head = arrow
        ax.annotate(
            "", tuple(head), xytext=tuple(tail), zorder=7.2,
            arrowprops={"arrowstyle": "-|>", "color": style.ACCENT, "linewidth": 0, "mutation_scale": 16, "shrinkA": 0, "shrinkB": 0},
        )  # fmt: skip


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
