"""A working field as dealers print it: heights down, radii across, in each cell the load and a letter for its limit."""

from __future__ import annotations

from collections.abc import Mapping
from string import ascii_uppercase
from textwrap import TextWrapper

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from ..language import heading_of, said, translated
from ..motion.measures import words_of
from ..quantities import is_number
from ..statics import is_steady
from ..study import WorkingField
from ..study.load_rule import FACTORS, PLAIN_RULE
from ..study.working_field import NOT_LIMITED, OUT_OF_REACH
from ..units import decimals, factor, g0, shown_in, unit_sign
from . import style
from .sheet import Keywords, panels

CELL = 0.62, 0.30
"""The size of a cell [inch]."""
LINE = 0.2
"""The height of a line of the legend [inch]."""
LEFT, TOP = 0.85, 0.95


class ChartText:
    """A field's words in the chosen units and language: loads, radii, heights, letters, lines of the legend.

    A load that hangs is shown as a mass, as `is_weight` says. `load_size` is the load that is printed as 1 [N]. Each limiter that occurs
    has one of `letters`; `counts` says in how many cells it limits. `axes` stand across and down the chart, whose columns are `across` in
    the field and its rows `down`.
    """

    def __init__(self, field: WorkingField) -> None:
        self.field = field
        self.across, self.down = np.argsort(field.x, kind="stable"), np.argsort(-field.y, kind="stable")
        self.is_weight = is_steady(field.along) and field.along == (0.0, 1.0)
        self.unit = "t" if self.is_weight else "kN"
        self.load_size = (g0 if self.is_weight else 1.0) * factor(shown_in(self.unit))
        self.load_digits, self.length_digits = decimals(2, self.unit), 2 if shown_in("m") == "m" else 0
        named = [each for each in field.limiters if each not in (OUT_OF_REACH, NOT_LIMITED)]
        signs = [*ascii_uppercase, *(a + b for a in ascii_uppercase for b in ascii_uppercase)]
        self.letters = dict(zip(named, signs, strict=False))
        self.counts = {name: int(np.sum(field.limiter == name)) for name in self.letters}
        what = said("lift capacity at {point}", point=field.point)
        if not self.is_weight:
            x, y = (f"{each:.3g}" if is_number(each) else words_of(each) for each in field.along)
            what = said("force at {point} against ({x}, {y})", point=field.point, x=x, y=y)
        self.title = f"{field.machine.plan.heading}: {what}, {unit_sign(self.unit)}"
        unit = unit_sign("m")
        self.axes = said("radius from the frame's origin, {unit}", unit=unit), said("height, {unit}", unit=unit)

    def load_text(self, value: float) -> str:
        """Return a load [N] as it is printed."""
        if np.isnan(value):
            return ""
        return "\N{INFINITY}" if np.isinf(value) else f"{value / self.load_size:.{self.load_digits}f}"

    def length_text(self, value: float) -> str:
        """Return a radius or a height [m] as it is printed."""
        return f"{value / factor(shown_in('m')):.{self.length_digits}f}".replace("-", "\N{MINUS SIGN}")

    def legend(self) -> list[str]:
        """Return the lines under the chart."""
        words = [f"{letter}  {heading_of(name)} ({self.counts[name]})" for name, letter in self.letters.items()]
        return [*([said("limited by: {letters}", letters="    ".join(words))] if words else []), *self.terms()]

    def terms(self) -> list[str]:
        """Return the lines with the conditions of the chart: the rule, pressures, the case, other loads."""
        lines: list[str] = []
        field, rule = self.field, self.field.rule
        if rule is not PLAIN_RULE:
            shares = ", ".join(translated(FACTORS[name]).format(share=f"{100.0 * value:.4g} %") for name, value in rule.shares.items())
            words = [said("rule: {title}", title=translated(rule.title)) + (f": {shares}" if shares else "")]
            lines.append("; ".join([*words, *([translated(rule.remark)] if rule.remark else [])]))
        pressures = field.pressures()
        if pressures:
            lines.append(said("pressures: {words}", words=", ".join(pressures)))
        case = [said("load case {case}", case=field.case)] if field.case else []
        return [*lines, "; ".join([said("over front, in the plane of the machine"), *case, *field.remarks])]


def plot_field(field: WorkingField) -> Figure:
    """Return a working field as a chart: rows are heights, columns radii, the letter beside a load names its limit."""
    text = ChartText(field)
    across, down = text.across.tolist(), text.down.tolist()
    wide, tall = len(across) * CELL[0], len(down) * CELL[1]
    width = max(LEFT + wide + 0.2, 7.0)
    fold = TextWrapper(int((width - 0.3) * 13.5), subsequent_indent="    ", break_long_words=False, break_on_hyphens=False)
    lines = [part for line in text.legend() for part in fold.wrap(line)]
    height = TOP + tall + 0.25 + LINE * len(lines) + 0.15
    figure, (ax,) = panels((width, height), 1)
    figure.set_layout_engine("none")
    ax.set_position((0.0, 0.0, 1.0, 1.0))
    ax.set(xlim=(0.0, width), ylim=(height, 0.0))
    ax.axis("off")
    ax.text(0.12, 0.28, text.title, fontsize=style.TITLE, fontweight="bold", color=style.INK, va="center")
    radius, rise = text.axes
    ax.text(LEFT + 0.5 * wide, 0.56, radius, fontsize=style.SMALL, color=style.MUTED, ha="center", va="center")
    ax.text(LEFT - 0.1, 0.56, rise, fontsize=style.SMALL, color=style.MUTED, ha="right", va="center")
    colours = {name: style.mixed(style.BODIES[place % len(style.BODIES)], style.PAPER, 0.45) for place, name in enumerate(text.letters)}
    bold: Keywords = {"fontsize": style.SMALL, "fontweight": "bold", "color": style.INK, "va": "center"}
    for column, n in enumerate(across):
        at = LEFT + (column + 0.5) * CELL[0]
        ax.text(at, TOP - 0.14, text.length_text(float(field.x[n])), ha="center", **bold)
    for row, k in enumerate(down):
        level = TOP + (row + 0.5) * CELL[1]
        ax.text(LEFT - 0.1, level, text.length_text(float(field.y[k])), ha="right", **bold)
        for column, n in enumerate(across):
            draw_cell(ax, text, colours, (LEFT + column * CELL[0], TOP + row * CELL[1]), float(field.load[k, n]), str(field.limiter[k, n]))
    for row, line in enumerate(lines):
        ax.text(0.12, TOP + tall + 0.3 + LINE * row, line, fontsize=style.SMALL, color=style.INK, va="center")
    return figure


def draw_cell(ax: Axes, text: ChartText, colours: Mapping[str, str], corner: tuple[float, float], load: float, limiter: str) -> None:
    """Draw one cell: the load, and the letter of its limit."""
    colour = style.GRID if np.isnan(load) else colours.get(limiter, style.PAPER)
    ax.add_patch(Rectangle(corner, *CELL, facecolor=colour, edgecolor=style.PAPER, linewidth=1.2, zorder=2.0))
    x, y = corner[0], corner[1] + 0.5 * CELL[1]
    letter = text.letters.get(limiter, "")
    ink: Keywords = {"color": style.INK, "va": "center", "zorder": 6.0}
    ax.text(x + (0.40 if letter else 0.5) * CELL[0], y, text.load_text(load), fontsize=style.SMALL, ha="center", **ink)
    ax.text(x + 0.93 * CELL[0], y - 0.02, letter, fontsize=style.SMALL - 1.5, ha="right", **ink)
