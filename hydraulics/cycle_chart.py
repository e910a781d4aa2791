"""A working cycle as pictures and tables: flow, pressure, power, who waits; events are numbered lines."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from itertools import cycle as around

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from linkage.documents.content import Block, Illustration, Section, TableBlock
from linkage.language import noted, said, translated
from linkage.motion import Column
from linkage.pictures import style
from linkage.pictures.sheet import Keywords, panels, quiet
from linkage.units import show, unit_sign

from .cycle import PumpCycle
from .inputs import Array

COLOURS = style.CURVE, "#009e73", "#cc79a7", "#e69f00", "#56b4e9"
"""Of the lines, in their order; Okabe and Ito's, as all of this palette."""
PARTS = {noted("useful"): style.CURVE, noted("throttled"): style.ACCENT, noted("margin"): style.MUTED}
WIDE, HIGH, STRIP, LINE = 8.0, 2.1, 0.32, 0.19
"""Sizes of a chart [inch]: its width, a panel, a cylinder that waits, a line of words."""
ROOM = (0.62, 0.16, 0.5, 0.34)
"""The room beside the axes of a picture in a report [inch: left, right, bottom, top]."""
NOTHING = 1e-12
"""Of the energy that comes in: what is no more is nothing, to rounding."""
HEADROOM = 1.25
"""Of a limit: so high a panel goes at the least, so that the numbers of events stand above it."""
MOST_EVENTS = 24
"""So many are told below a chart."""


def cycle_columns(cycle: PumpCycle) -> list[Column]:
    """Return a cycle as a table: instants, and flow, pressure and power of the pump and of each line; both sides of a border."""
    kinds: list[tuple[str, Mapping[str, Array], str]] = [
        (noted("flow"), cycle.flow, "l/min"), (noted("pressure"), cycle.pressure, "bar"), (noted("power"), cycle.power, "kW"),
    ]  # fmt: skip
    columns = [Column(f"{word} {name}", values, unit, 3) for word, by_name, unit in kinds for name, values in by_name.items()]
    return [Column("time", cycle.time, "s", 4), *columns, *(Column(f"share {name}", share, "", 4) for name, share in cycle.share.items())]


def waiting(cycle: PumpCycle) -> dict[str, Array]:
    """Return the cylinders that get less than they ask for at times, and their shortage, 0 to 1."""
    missing = {name: np.clip(1.0 - share, 0.0, 1.0) for name, share in cycle.share.items()}
    return {name: part for name, part in missing.items() if np.any(part > 1e-9)}


def plot_cycle(cycle: PumpCycle) -> Figure:
    """Return a figure of a cycle over time: flow, pressure and power with the pump's limits, who waits, and the events below."""
    late = waiting(cycle)
    told = [f"{number}  {event}" for number, event in enumerate(cycle.events[:MOST_EVENTS], 1)]
    if len(cycle.events) > MOST_EVENTS:
        told.append(said("and {n} more", n=len(cycle.events) - MOST_EVENTS))
    heights = [HIGH] * 3 + [STRIP * len(late) + 0.35] * bool(late)
    foot = 0.1 + LINE * len(told)
    high = sum(heights) + foot + 0.5
    figure, axes = panels((WIDE, high), 1, len(heights), rect=(0.0, foot / high, 0.985, 1.0 - foot / high))
    grid = axes[0].get_gridspec()
    assert grid is not None
    grid.set_height_ratios(heights)
    for ax, paint in zip(axes, (flow_panel, pressure_panel, power_panel, waiting_panel), strict=False):
        paint(ax, cycle)
        ax.set_xlabel("")
    axes[-1].set_xlabel(time_heading(), fontsize=style.TEXT, color=style.MUTED)
    title = said("One pump, {name}: {words}", name=cycle.pump, words=cycle.verdict.sentence.rstrip("."))
    figure.suptitle(title, fontsize=style.TEXT, fontweight="bold", color=style.INK, x=0.012, ha="left", wrap=True)
    for place, line in enumerate(told):
        figure.text(0.02, (foot - LINE * (place + 1)) / high, line, fontsize=style.SMALL, color=style.INK, va="bottom")
    return figure


def flow_panel(ax: Axes, cycle: PumpCycle) -> None:
    """Draw the flows of the lines and of the pump, with its limit."""
    curves(ax, cycle, cycle.flow, said("flow"), "l/min", cycle.limits.flow)


def pressure_panel(ax: Axes, cycle: PumpCycle) -> None:
    """Draw the pressures of the lines and of the pump, with its cut-off."""
    curves(ax, cycle, cycle.pressure, said("pressure"), "bar", cycle.limits.cut_off)


def power_panel(ax: Axes, cycle: PumpCycle) -> None:
    """Draw where the pump's power goes, on top of each other, with its limit."""
    below = np.zeros(len(cycle.time))
    for name, colour in PARTS.items():
        part = Column(name, cycle.parts[name], "kW").drawn
        if np.any(part > 1e-9):
            ax.fill_between(cycle.time, below, below + part, color=colour, alpha=0.35, linewidth=0, zorder=2.0, label=translated(name))
        below = below + part
    curves(ax, cycle, {cycle.pump: cycle.power[cycle.pump]}, said("power"), "kW", cycle.limits.power)


def waiting_panel(ax: Axes, cycle: PumpCycle) -> None:
    """Draw a row for each cylinder that waits, shaded as high as the part of its speed that it does not get."""
    late = waiting(cycle)
    for place, part in enumerate(late.values()):
        base = len(late) - 1 - place
        ax.fill_between(cycle.time, base, base + 0.85 * part, color=style.ACCENT, alpha=0.55, linewidth=0, zorder=3.0)
        ax.axhline(base, color=style.RULE, linewidth=style.THIN, zorder=2.0)
    ax.set_yticks([len(late) - 0.6 - place for place in range(len(late))], list(late), fontsize=style.SMALL)
    time_axes(ax, cycle, said("waits: the part of its speed that it does not get"), is_numbered=False)
    ax.set_ylim(-0.05, max(len(late), 1))
    whole = [base + part for base in range(len(late)) for part in (0.0, 0.85)]
    scale = ax.secondary_yaxis("right")
    scale.set_yticks(whole, ["", "100\N{THIN SPACE}%"] * len(late), fontsize=style.SMALL - 1.0)
    scale.tick_params(colors=style.MUTED, length=2.0)
    scale.spines["right"].set_visible(False)


def curves(ax: Axes, cycle: PumpCycle, values: Mapping[str, Array], word: str, unit: str, limit: float) -> None:
    """Draw curves of the lines, the pump's bold on top, and its limit."""
    colours = around(COLOURS)
    for name, each in values.items():
        is_pump = name == cycle.pump
        colour, width = (style.mixed(style.INK, style.PAPER, 0.55), 2.2 * style.BOLD) if is_pump else (next(colours), style.BOLD)
        ax.plot(cycle.time, Column(name, each, unit).drawn, label=name, zorder=4.0 if is_pump else 5.0, color=colour, linewidth=width)
    time_axes(ax, cycle, f"{word}, {unit_sign(unit)}")
    if np.isfinite(limit):
        most = float(Column(word, np.array([limit]), unit).drawn[0])
        ax.axhline(most, color=style.ACCENT, linewidth=1.3, linestyle=(0, (5, 2.5)), zorder=4.5, label=said("limit"))
        ax.set_ylim(top=max(ax.get_ylim()[1], HEADROOM * most))
    handles, labels = ax.get_legend_handles_labels()
    look: Keywords = {"ncols": 7, "fontsize": style.SMALL, "frameon": False, "borderpad": 0.0, "handlelength": 1.3, "columnspacing": 1.0}
    ax.legend(handles, labels, loc="upper right", bbox_to_anchor=(1.0, 1.2), **look)


def time_axes(ax: Axes, cycle: PumpCycle, heading: str, *, is_numbered: bool = True) -> None:
    """Set up axes over time, with a line at each event and its number."""
    quiet(ax)
    ax.set_title(heading, loc="left", fontsize=style.TEXT, fontweight="bold", color=style.INK, pad=6)
    ax.set_xlim(float(cycle.time[0]), float(cycle.time[-1]))
    ax.set_xlabel(time_heading(), fontsize=style.TEXT, color=style.MUTED)
    low, high = ax.get_ylim()
    ax.set_ylim(min(low, 0.0), high)
    last, level = -np.inf, 0
    for number, event in enumerate(cycle.events[:MOST_EVENTS], 1):
        ax.axvline(event.time, color=style.MUTED, linewidth=style.THIN, linestyle=(0, (1, 2)), zorder=1.5)
        level = level + 1 if event.time - last < 0.02 * cycle.duration else 0
        last = event.time
        if not is_numbered:
            continue
        ax.annotate(
            str(number), (event.time, 1.0), xytext=(2, -2 - 9 * (level % 4)), xycoords=("data", "axes fraction"),
            textcoords="offset points", ha="left", va="top", fontsize=style.SMALL - 1.0, color=style.MUTED, zorder=6.0,
        )  # fmt: skip


def time_heading() -> str:
    """Return the heading of the axis of time."""
    return said("time, {unit}", unit=unit_sign("s"))


# In words.


FINE = 360.0
"""An energy [J] below which its kWh would have an exponent."""


def energy_rows(cycle: PumpCycle) -> list[tuple[str, str, str]]:
    """Return where the energy of a cycle goes, in rows of words."""
    words = {
        "pump": said("the pump gives"), "useful": said("moves cylinders"), "throttled": said("is throttled away"),
        "margin": said("is the pump's margin"), "braked": said("loads give, braked"),
    }  # fmt: skip
    least = NOTHING * max(cycle.energy.pump, cycle.energy.braked)
    found = {text: energy if abs(energy := getattr(cycle.energy, name)) > least else 0.0 for name, text in words.items()}
    return [(text, show(energy, "kJ", 4), show(energy, "kWh", 3 if abs(energy) >= FINE else "z.6f")) for text, energy in found.items()]


def line_rows(cycle: PumpCycle) -> list[tuple[str, ...]]:
    """Return the pump and each line in a row: litres, the highest flow, pressure and power, each with its instant."""
    rows = []
    for name in cycle.flow:
        cells = [name, show(1e-3 * cycle.litres[name], "l", 4)]
        for values, unit in ((cycle.flow, "l/min"), (cycle.pressure, "bar"), (cycle.power, "kW")):
            most, time = cycle.peak(values.get(name, np.zeros(len(cycle.time))))
            cells.append(said("{value} at {time}", value=show(most, unit, 4), time=show(time, "s", 4)))
        rows.append(tuple(cells))
    return rows


def line_heads() -> tuple[str, ...]:
    """Return the headings of `line_rows`."""
    return said("line"), said("oil"), said("greatest flow"), said("greatest pressure"), said("greatest power")


def cycle_section(cycles: Sequence[tuple[str, PumpCycle]]) -> Section:
    """Return the section of a report on one pump over paths in time, each with its words."""
    found = tuple(block for words, each in cycles for block in cycle_blocks(words, each))
    return Section(said("One pump, {name}", name=cycles[0][1].pump), found)


def cycle_blocks(words: str, cycle: PumpCycle) -> Iterator[Block]:
    """Yield the words, tables and pictures of one cycle."""
    beside = f", {words}" if words else ""
    yield said("{pump} {sentence}", pump=f"{words}: {cycle.pump}" if words else cycle.pump, sentence=cycle.verdict.sentence)
    yield said("How a pump is shared does not follow inertia: needs are those of slow motion, with friction and dampers at their rates.")
    yield TableBlock(said("Oil, flow, pressure and power") + beside, line_heads(), tuple(line_rows(cycle)), "lrrrr")
    yield TableBlock(said("Energy") + beside, (said("where it goes"), said("energy"), ""), tuple(energy_rows(cycle)), "lrr")
    for word, paint in ((said("Flow"), flow_panel), (said("Pressure"), pressure_panel), (said("Power"), power_panel)):
        name = f"{cycle.pump}_{paint.__name__}_{words}".replace(" ", "_")
        yield Illustration(name, said("{what} over time{beside}.", what=word, beside=beside), (6.6, 2.5), ROOM, partial(paint, cycle=cycle))
    if cycle.events:
        rows = tuple((show(each.time, "s", 7), each.sentence) for each in cycle.events)
        yield TableBlock(said("Events") + beside, (said("time"), said("event")), rows, "rm")
