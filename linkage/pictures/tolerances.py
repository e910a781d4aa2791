"""Studies as pictures: bands of quantities over the stroke, of tolerances or of settings, and the bars of a tornado."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial
from textwrap import fill

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from ..errors import ensure, known_name, require_type
from ..language import heading_of, said, translated
from ..mechanism import Mechanism
from ..motion import Column, Leaf
from ..program import FloatArray
from ..study import Zone
from ..study.measured import number_bound
from ..study.monte_carlo import Band, MonteCarlo, share_words
from ..study.tolerances import Tornado, tolerance_words
from ..units import factor, show, shown_in, unit_or_none, unit_sign
from . import style
from .curves import WIDEST, axis_range, panel_grid, small_text, stroke_panel
from .sheet import panels
from .shown_values import Limit, limit_on, typeset
from .strokes import StrokeAxis

LETTERS = 13
"""Letters of a small line of words on an inch."""
NARROW = 0.12
"""Of the nominal curve's range: a worst case that is narrower is drawn as the deviation from the nominal curve."""


def plot_bands(found: MonteCarlo, names: Sequence[str] = (), *, units: Mapping[str, str] | None = None) -> Figure:
    """Return a figure of the bands of a Monte Carlo over the stroke, a panel each: median, percentiles, worst case, limits.

    `names` choose some of its quantities, `units` say in which each is shown. A band too narrow to be seen on its curve is drawn as
    the deviation from the nominal machine. Raises DefinitionError for an unknown name, strokes that are no row, and where there is no
    curve.
    """
    require_type("", found, MonteCarlo, "has no bands; give the result of monte_carlo(...)")
    for name in (*names, *(units or {})):
        known_name("Quantity", name, found.bands, where="the study")
    along = StrokeAxis.of(found.machine.at(unreachable="nan", **found.strokes))
    shown = [found.bands[name] for name in names or found.bands if found.bands[name].nominal.shape == along.values.shape]
    ensure(shown, f"{found.machine.plan.title}: there is no curve to draw over {along.name}; give quantities of each pose.")
    figure, cells = panel_grid(len(shown), found.machine.plan.heading, along.held)
    words = ", ".join(tolerance_words(found.machine.plan, name, each) for name, each in found.tolerances.items())
    for ax, band in zip(cells, shown, strict=True):
        unit = unit_or_none((units or {}).get(band.quantity, band.unit), where="units")
        limits = [limit_on(each, partial(is_same, found, band)) for each in found.conditions]
        band_panel(ax, along, band, unit, [each for each in limits if each is not None])
    text = said("{count} machines with {tolerances}", count=found.count, tolerances=words)
    if found.conditions:
        text = said("{machines}; {share} are good", machines=text, share=share_words(found.yield_rate))
    text = fill(text, int(LETTERS * figure.get_figwidth()))
    legend = figure.legend(
        handles=cells[0].get_legend_handles_labels()[0], title=text, loc="outside lower left", ncols=4, alignment="left",
        fontsize=style.SMALL, title_fontsize=style.SMALL, frameon=False, labelcolor=style.INK,
    )  # fmt: skip
    legend.get_title().set_color(style.MUTED)
    return figure


def is_same(found: MonteCarlo, band: Band, leaf: Leaf) -> bool:
    """Return whether a leaf's quantity is that of a band."""
    one, other = (number_bound(found.machine.plan, each) for each in (leaf.quantity, found.of[band.quantity]))
    return leaf.quantity is found.of[band.quantity] if one is None or other is None else one.key == other.key


def band_panel(ax: Axes, along: StrokeAxis, band: Band, unit: str, limits: Sequence[Limit]) -> None:
    """Draw a band over the stroke: its worst case, the percentiles in pairs from outside, the median, the nominal curve, its limits.

    A narrow band is drawn less the nominal curve.
    """
    at, narrow = along.values, bool(np.nanmax(band.high - band.low) < NARROW * np.ptp(band.nominal))

    def drawn(values: FloatArray | float) -> FloatArray:
        return np.asarray((values - band.nominal * narrow) / factor(shown_in(unit)))

    low, high = drawn(band.low), drawn(band.high)
    ax.fill_between(at, low, high, color=style.CURVE, alpha=0.12, linewidth=0, zorder=2.0, label=said("worst case"))
    for edge in (low, high):
        ax.plot(at, edge, color=style.CURVE, linewidth=style.THIN, alpha=0.6, zorder=2.5)
    outside = sorted(band.percentiles)
    for least, most in zip(outside[: len(outside) // 2], outside[::-1], strict=False):
        lower, upper = drawn(band.percentiles[least]), drawn(band.percentiles[most])
        share = said("{low} to {high} %", low=f"{least:g}", high=f"{most:g}")
        ax.fill_between(at, lower, upper, color=style.CURVE, alpha=0.30, linewidth=0, zorder=3.0, label=share)
    middle, word = (band.percentiles[50.0], said("median")) if 50.0 in band.percentiles else (band.mean, said("mean"))
    ax.plot(at, drawn(middle), color=style.CURVE, linewidth=style.BOLD, zorder=5.0, label=word)
    ax.plot(at, drawn(band.nominal), color=style.INK, linewidth=1.0, linestyle=(0, (4, 3)), zorder=5.5, label=said("nominal"))
    air = 0.12 * float(np.nanmax(high) - np.nanmin(low)) or 1.0
    text = heading_of(band.quantity)
    text = said("{quantity}, deviation from nominal", quantity=text) if narrow else text
    heading = fill(typeset(f"{text}, {translated(unit_sign(unit))}" if unit else text), WIDEST)
    stroke_panel(ax, along, heading, (float(np.nanmin(low)) - air, float(np.nanmax(high)) + air))
    for limit in limits:  # the panel keeps its range, widened by as much again at most
        line = np.broadcast_to(drawn(limit.value), at.shape)
        bottom, top = ax.get_ylim()
        if not narrow and 2.0 * bottom - top < line[0] < 2.0 * top - bottom:
            bottom, top = ax.set_ylim(min(bottom, line[0] - 0.5 * air), max(top, line[0] + 0.5 * air))
        if np.any((line > bottom) & (line < top)):
            beyond, where = (top, line < top) if limit.fails == "above" else (bottom, line > bottom)
            ax.fill_between(at, line, beyond, where=where, color=style.ACCENT, alpha=0.10, linewidth=0, zorder=1.0, interpolate=True)
            ax.plot(at, line, color=style.ACCENT, linewidth=1.3, linestyle=(0, (5, 2.5)), zorder=4.0)


# A zone: between which values a quantity lies over the stroke, over a box of settings.


def plot_zone(machine: Mechanism, found: Zone, unit: str = "") -> Figure:
    """Return a figure of a zone of a machine over the stroke, with the curve of the machine as it is set in it where it is an output.

    `unit` is the one that the quantity is shown in. Raises DefinitionError for strokes that are no row.
    """
    require_type("", found, Zone, "is no zone; give the result of zone(...)")
    motion = machine.at(unreachable="nan", **found.strokes)
    along = StrokeAxis.of(motion)
    figure, (ax,) = panel_grid(1, machine.plan.heading, along.held)
    low, high = (Column(found.quantity, each, unit) for each in (found.low, found.high))
    ax.fill_between(along.values, low.drawn, high.drawn, color=style.CURVE, alpha=0.22, linewidth=0, zorder=3.0)
    for each in (low, high):
        ax.plot(along.values, each.drawn, color=style.CURVE, linewidth=style.BOLD, zorder=5.0)
    if found.quantity in machine.plan.members:
        now = Column(found.quantity, motion[found.quantity], unit)
        ax.plot(along.values, now.drawn, color=style.INK, linewidth=1.0, linestyle=(0, (4, 3)), zorder=5.5, label=said("as it is set"))
        ax.legend(loc="best", frameon=False, fontsize=style.SMALL, labelcolor=style.INK)
    stroke_panel(ax, along, low.heading, axis_range(Column(found.quantity, np.concatenate([found.low, found.high]), unit)))
    return figure


# A tornado: a bar for each dimension, the longest at the top.

ROW = 0.36
"""The height of a bar with its share of the margins [inch]."""
MOST = 20
"""Bars of one picture; what does less is left out."""


def plot_tornado(found: Tornado) -> Figure:
    """Return a figure of a tornado's bars, the longest at the top: real changes at both limits, and marks where the gradient tells them."""
    require_type("", found, Tornado, "has no bars; give the result of tornado(...)")
    bars = [bar for bar in found.bars if bar.length > 0.0][:MOST] or list(found.bars[:1])
    figure, (ax,) = panels((7.6, ROW * len(bars) + 1.9), 1, w_pad=0.12, h_pad=0.12)
    scale, unit = factor(shown_in(found.unit)), f", {translated(unit_sign(found.unit))}" if found.unit else ""
    for place, bar in enumerate(bars):
        for change, linear, colour in ((bar.low, bar.linear_low, style.CURVE), (bar.high, bar.linear_high, style.ACCENT)):
            if np.isfinite(change):
                ax.barh(place, change / scale, height=0.62, color=colour, alpha=0.85, linewidth=0, zorder=4.0)
            ax.plot([linear / scale], [place], "|", color=style.INK, markersize=11, markeredgewidth=1.6, zorder=5.0)
        small_text(ax, f"{100.0 * bar.share:.0f} %", (1.0, place), (-4, 0), style.MUTED, ("axes fraction", "data"))
    ax.axvline(0.0, color=style.INK, linewidth=1.0, zorder=6.0)
    ax.set_yticks(range(len(bars)), [tolerance_words(found.plan, bar.name, bar.tolerance) for bar in bars])
    ax.tick_params(axis="y", labelsize=style.TEXT, labelcolor=style.INK)
    ax.set_ylim(len(bars) - 0.4, -0.6)
    reach = 1.18 * max(bar.length for bar in bars) / scale or 1.0
    ax.set_xlim(-reach, reach)
    ax.grid(False, axis="y")
    ax.xaxis.set_major_locator(MaxNLocator(7, steps=[1, 2, 2.5, 5, 10]))
    ax.set_xlabel(typeset(said("change of {quantity}", quantity=heading_of(found.quantity)) + unit), fontsize=style.TEXT, color=style.MUTED)
    value = f"{heading_of(found.quantity)} = {show(found.nominal, found.unit, 5)}"
    at = said("{quantity} at {place}", quantity=value, place=found.at)
    ax.set_title(typeset(at), loc="left", fontsize=style.TITLE, fontweight="bold", color=style.INK, pad=22)
    sigma = said("sigma of all together {sigma}; at the right each one's share of the variance", sigma=show(found.sigma, found.unit, 3))
    ax.annotate(typeset(sigma), (0.0, 1.0), (0, 7), "axes fraction", textcoords="offset points", fontsize=style.SMALL, color=style.MUTED)
    names = {said("at the lower limit"): style.CURVE, said("at the upper limit"): style.ACCENT}
    handles: list[object] = [ax.barh([np.nan], [0.0], color=colour, label=text) for text, colour in names.items()]
    handles.append(ax.plot([], [], "|", color=style.INK, markersize=9, markeredgewidth=1.6, label=said("as the gradient tells"))[0])
    figure.legend(handles=handles, loc="outside lower right", ncols=3, fontsize=style.SMALL, frameon=False, labelcolor=style.INK)
    return figure
