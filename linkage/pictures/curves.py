"""Columns of results as curves over the stroke, one panel each, on one page."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from math import ceil, sqrt
from textwrap import wrap
from typing import Any, TypeAlias

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from ..errors import DefinitionError, ensure, is_listed, known_name, require_type
from ..language import said, translated
from ..loads import PLAIN_CASE
from ..mechanism import Mechanism
from ..motion import Column, Motion, Request, RequestLike, columns_of
from ..program import FloatArray
from ..quantities import Quantity
from ..reports import At, case_along, columns_about, in_case_words, motion_over, request_in_case, results, run_of, run_words, runs_of
from . import style
from .sheet import Keywords, panels, quiet
from .shown_values import Limit, as_curve, check_poses, limit_of, typeset
from .strokes import StrokeAxis, frame_count

PANEL = (4.6, 3.0)
"""The size of a panel with its share of the margins [inch]."""
TIED = "\N{NO-BREAK SPACE}"
WIDEST = 36
"""Letters of a panel's heading on one line, where there are longer ones."""
LETTERS_AN_INCH = 8.0
"""How many letters of a heading an inch has room for."""


Curve: TypeAlias = tuple[Motion, Column, str]
"""A column over the stroke that a motion runs along, and what its panel says of where that is."""


def plot_motion(motion: Motion, columns: Sequence[Column | RequestLike], limits: Mapping[str, Sequence[object]] | None) -> Figure:
    """Return a figure of columns over the stroke, a panel each; see `plot`."""
    along, case = StrokeAxis.of(motion), case_along(motion)
    is_list = is_listed(columns)
    found = columns_named(motion, [request_in_case(each, case) for each in columns] if is_list else columns)
    return plot_curves(motion, [(motion, column, "") for column in found], limits, along.held, in_case_words(motion.plan, case))


def plot_machine(
    machine: Mechanism, columns: Sequence[Column | RequestLike], limits: Mapping[str, Sequence[object]] | None, at: At, count: int
) -> Figure:
    """Return a figure of a machine's results over its runs (`runs_of`), those it is about unless others are named."""
    featured, title, poses = machine.featured(), machine.plan.title, frame_count(count)
    runs = [run for run in runs_of(machine, at) if run.is_curve] or [run_of(machine, at)]
    curves, held = list[Curve](), ""
    for run in runs:
        motion = motion_over(machine, run, np.linspace(0.0, 1.0, poses))
        table = results(machine, motion, run.case or PLAIN_CASE)
        shown = columns or columns_about(machine, table)
        if is_listed(shown):
            known = {column.name: column for column in (*columns_of(motion), *table)}  # a table of its own may leave out points and outputs
            shown = [known[known_name("Column", each, known, where=title)] if isinstance(each, str) else each for each in shown]
            if len(runs) > 1 and any(isinstance(each, Column) for each in columns):
                raise DefinitionError(f"{title}: a Column has values of one motion, and it runs {len(runs)} ways; name it.")
            shown = [request_in_case(each, run.case) for each in shown]
        held = StrokeAxis.of(motion).held
        curves += [(motion, column, run_words(machine, run) if len(runs) > 1 else "") for column in columns_named(motion, shown)]
    names = {column.name for _, column, _ in curves}
    own_limits = {name: limit for name, limit in featured.limits.items() if name in names}
    case = in_case_words(machine.plan, runs[0].case) if len(runs) == 1 else ""
    return plot_curves(motion, curves, own_limits | dict(limits or {}), held if len(runs) == 1 else "", case)


def plot_curves(first: Motion, curves: Sequence[Curve], limits: Mapping[str, Sequence[object]] | None, held: str, case: str) -> Figure:
    """Return a figure of curves, a panel each, with their limits; `held` are the strokes that are held along all of them.

    `first` is a motion that they are of, `case` the load case of all in words.
    """
    if limits is not None:
        require_type("limits", limits, Mapping, "a limit for each column by its name is expected, dict(tilt=(0.1, 'max'))")
    given = dict(limits or {})
    for name in given:
        known_name("Column", name, [*dict.fromkeys(column.name for _, column, _ in curves)], where="limits")
    abscissas = [(StrokeAxis.of(motion).name, *(motion.strokes if motion.time is None else ())) for motion, _, _ in curves]
    shown = [each for each, along in zip(curves, abscissas, strict=True) if each[1].name not in along]
    ensure(shown, f"{first.plan.title}: there is no column to draw over {StrokeAxis.of(first).name}; name a result, not a stroke.")
    figure, cells = panel_grid(len(shown), ", ".join(filter(None, (first.plan.heading, case))), held)
    for ax, (motion, result, where) in zip(cells, shown, strict=True):
        column, bound = as_curve(result, given.get(result.name))
        panel(ax, motion, column, bound)
        if where:  # each of several runs has strokes of its own that are held
            axis = StrokeAxis.of(motion)
            heading = in_lines(typeset(f"{column.heading}, {where}"), PANEL[0])
            ax.set_title(heading, loc="left", fontsize=style.TITLE, fontweight="bold", color=style.INK, pad=9)
            below = in_lines("; ".join(each for each in (axis.heading, axis.held) if each), 1.2 * PANEL[0])  # of smaller letters
            ax.set_xlabel(below, fontsize=style.TEXT, color=style.MUTED)
    return figure


def columns_named(motion: Motion, columns: Sequence[Column | RequestLike]) -> list[Column]:
    """Return columns, those given by name from the motion's own table, and requests; DefinitionError for an unknown name."""
    what, expected = f"{motion.plan.title}: columns", 'a list of columns or their names is expected, such as ["tilt"]'
    require_type(what, columns, (list, tuple), expected, (str, Column, Quantity, Request))
    names = [each for each in columns if isinstance(each, str)]
    own = {column.name: column for column in columns_of(motion)} if names else {}
    for name in names:
        known_name("Column", name, own, where=motion.plan.title)
    found = [own[each] if isinstance(each, str) else each if isinstance(each, Column) else Column.of(motion, each) for each in columns]
    for column in found:
        check_poses(column, motion)
    return found


def in_lines(text: str, width: float) -> str:
    """Return a text in lines that go into a width [inches] and break between strokes, not in a stroke's value."""
    tied = re.sub(r" (?==)|(?<==) |(?<=\d) ", TIED, text)
    return "\n".join(wrap(tied, int(LETTERS_AN_INCH * width))).replace(TIED, " ")


def panel_grid(count: int, title: str, held: str = "") -> tuple[Figure, list[Axes]]:
    """Return a figure and the axes of so many panels, as near to a square as they go, under a title with the held strokes."""
    across = min(ceil(sqrt(count)), 4)
    down = ceil(count / across)
    figure, cells = panels((max(PANEL[0] * across, 6.0), PANEL[1] * down + 0.6), across, down, count, w_pad=0.12, h_pad=0.12)
    title = in_lines(f"{title} {said('at {place}', place=held)}" if held else title, float(figure.get_figwidth()))
    figure.suptitle(title, fontsize=style.TITLE + 2, fontweight="bold", color=style.INK, x=0.012, ha="left")
    return figure, cells


def stroke_panel(ax: Axes, along: StrokeAxis, heading: str, ends: tuple[float, float]) -> None:
    """Set up axes for curves over a stroke: heading, stroke, ticks at round values, and where the values begin and end."""
    quiet(ax)
    ax.set_title(typeset(heading), loc="left", fontsize=style.TITLE, fontweight="bold", color=style.INK, pad=9)
    ax.set_xlabel(along.heading, fontsize=style.TEXT, color=style.MUTED)
    if np.ptp(along.values) > 0.0:
        ax.set_xlim(float(along.values.min()), float(along.values.max()))
    ax.xaxis.set_major_locator(locator(along.is_turning))
    ax.yaxis.set_major_locator(locator())
    ax.set_ylim(*ends)


def limit_crossings(along: FloatArray, values: FloatArray, at: float) -> list[float]:
    """Return where values cross a limit, by straight lines between the poses."""
    off = values - at
    places = np.flatnonzero(np.signbit(off[1:]) != np.signbit(off[:-1]))
    places = places[np.isfinite(off[places]) & np.isfinite(off[places + 1])]
    return [float(along[i] - off[i] * (along[i + 1] - along[i]) / (off[i + 1] - off[i])) for i in places]


# One curve over a stroke: its line, its limit with the failing side shaded, its axes.


def panel(ax: Axes, motion: Motion, column: Column, bound: Sequence[object] | None = None, colour: str = style.CURVE) -> None:
    """Draw a column over the stroke that a motion runs along, with its limit `(value [SI], text, fails)`."""
    along = StrokeAxis.of(motion)
    ax.plot(along.values, column.drawn, color=colour, linewidth=style.BOLD, zorder=5.0, marker="o" if len(along.values) == 1 else None)
    limits = [] if bound is None else [limit_of(bound, column.unit)]
    stroke_panel(ax, along, column.heading, axis_range(column, limits))
    for limit in limits:
        mark_limit(ax, along, column, limit)


def locator(is_turning: bool = False) -> MaxNLocator:
    """Return the locator of an axis's ticks: round values, or thirds of a right angle in degrees."""
    return MaxNLocator(6, steps=[1, 3, 4.5, 6, 9, 10] if is_turning else [1, 2, 2.5, 5, 10])


def axis_range(column: Column, limits: Sequence[Limit] = ()) -> tuple[float, float]:
    """Return the range of an axis for a column's values, in its unit, with air at both ends and room for its limits."""
    finite = column.drawn[np.isfinite(column.drawn)]
    low, high = (float(finite.min()), float(finite.max())) if finite.size else (0.0, 1.0)
    air = 0.09 * (high - low)
    if air <= 1e-9 * max(abs(low), abs(high)):
        air = 0.1 * max(abs(low), abs(high)) or 1.0
    low, high = low - air, high + air
    values = [limit.drawn(column) for limit in limits]
    beyond = 0.1 * (max([high, *values]) - min([low, *values]))
    return min([low, *(value - beyond for value in values)]), max([high, *(value + beyond for value in values)])


def mark_limit(ax: Axes, along: StrokeAxis, column: Column, limit: Limit) -> None:
    """Draw a limit, shade the side that fails, and mark where the curve crosses it."""
    value = limit.drawn(column)
    low, high = ax.get_ylim()
    bottom, top = (value, high) if limit.fails == "above" else (low, value)
    ax.axhspan(bottom, top, color=style.ACCENT, alpha=0.10, linewidth=0, zorder=1.0)
    ax.axhline(value, color=style.ACCENT, linewidth=1.3, linestyle=(0, (5, 2.5)), zorder=4.0)
    crossings = sorted(limit_crossings(along.values, column.drawn, value))
    order, fails = np.argsort(np.append(along.values, crossings)), np.append(limit.failing(column.values), np.ones(len(crossings), bool))
    line = np.append(along.values, crossings), np.where(fails, np.append(column.drawn, np.full(len(crossings), value)), np.nan)
    ax.plot(*(each[order] for each in line), color=style.ACCENT, linewidth=style.BOLD + 0.6, zorder=5.1)
    between = [along.values.min(), *crossings, along.values.max()]
    for before, place, after in zip(between[:-2], crossings, between[2:], strict=True):
        ax.plot([place], [value], marker="o", markersize=6, color=style.ACCENT, markeredgecolor=style.PAPER, zorder=6.0)
        spot = 7 if after - place > place - before else -7, -4 if limit.fails == "below" else 4  # on the failing side, where there is room
        small_text(ax, f"{place:.4g} {translated(along.unit)}", (place, value), spot)
    gaps = np.abs(np.nan_to_num(column.drawn, nan=value) - value)
    ends = between[-1] - between[-2], between[1] - between[0]  # its words stand at the end that is further from crossings or from the curve
    right = ends[0] >= ends[1] if crossings else gaps[np.argmax(along.values)] >= gaps[np.argmin(along.values)]
    spot = (-5 if right else 5, 3 if (limit.fails == "above") != bool(crossings) else -3)  # on the other side than crossings
    small_text(ax, typeset(limit.text), (1.0 if right else 0.0, value), spot, coords=("axes fraction", "data"))


def small_text(
    ax: Axes, text: str, at: tuple[float, float], offset: tuple[float, float], colour: str = style.ACCENT, coords: Any = "data"
) -> None:
    """Write a small text at an offset [points] from a place, on the side to which that leads."""
    across, up = ("left" if offset[0] > 0.0 else "right"), ("bottom" if offset[1] > 0.0 else "top" if offset[1] < 0.0 else "center")
    look: Keywords = {"fontsize": style.SMALL, "color": colour, "zorder": 6.0}
    ax.annotate(text, at, xytext=offset, xycoords=coords, textcoords="offset points", ha=across, va=up, **look)
