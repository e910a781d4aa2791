"""The paper's figures by its numbers, one call each: `figure("2a")`, both halves side by side `figure(2)`. Reactions are of one shoe.

| figure | header | shows |
|---|---|---|
| 1 | 1 | the scheme: header, tank, pump, relief valve, valve, gauge, accumulators |
| 2 a, 2 b | 1 | the reaction with the cylinders' seals only; what plain bearings at O add, as a force at the shoe |
| 3 a, 3 b | 1 | pressure in the accumulators while following; pressure needed to lift, over the whole stroke |
| 4 a, 4 b | 2 | reaction; given and needed pressure, below the charge of one pair |
| 5 a, 5 b | 3 | reaction; given and needed pressure, with the kink where the second pair joins |
| 6 a, 6 b | 1 | the improved mechanism: reaction, given and needed pressure |
| 7 | 1 | reaction calculated and measured |

They load matplotlib, and are loaded when one is drawn.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from types import MappingProxyType
from typing import TypeAlias

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from linkage import Motion, kgf, kgf_cm2, litre, mm, reaction
from linkage.errors import ensure
from linkage.motion import below_zero
from linkage.pictures import style
from linkage.pictures.sheet import panels
from linkage.program import FloatArray

from ..paper import own_loads
from ..sheets import WORDS, beside, curve, dot, headed
from .criteria import HEADERS
from .following import BEARING, PLAIN, SHOE, HeaderState, dry_frictions, height_at, over_following
from .machine import HeaderBalancer, ImprovedBalancer, with_header
from .measured import ALLOWED, Deviation
from .scheme import scheme

SIZE, PAIR = (7.6, 5.0), (14.6, 5.2)
COLOURS: Mapping[str, str] = MappingProxyType({"moving up": style.CURVE, "without friction": style.MUTED, "moving down": style.ACCENT})
WAYS: Mapping[str, str] = MappingProxyType({"moving up": "extending", "without friction": "frictionless", "moving down": "retracting"})
CURVES: Mapping[str, str] = MappingProxyType({"F_R up": "moving up", "F_R down": "moving down"})
IMPROVED = ", improved mechanism"
Drawing: TypeAlias = Callable[[Axes, Motion], None]
"""What draws half a figure."""


def figure(number: int | str, machine: HeaderBalancer | None = None, measured: Sequence[Deviation] = ()) -> Figure:
    """Return a figure of the paper as a matplotlib figure: a half of it, "2a", or both side by side, 2.

    It shows the header of the paper's figure, or the `machine` given. `measured` curves are laid over the reactions.
    """
    key = str(number).replace(" ", "").lower()
    parts = {name: part for name, part in PARTS.items() if key and name.startswith(key)}
    numbers = dict.fromkeys(["1", *(each for name in PARTS for each in (name[0], name))])
    ensure(parts or key == "1", f"Figure {number} is unknown; there are {', '.join(numbers)}.")
    shown = machine if machine is not None else ImprovedBalancer() if key[0] == "6" else with_header({"4": 2, "5": 3}.get(key[0], 1))
    if key == "1":
        return scheme(shown, f"1   Scheme of the balanced header: {_name(shown)}")
    motion = over_following(shown.at(h=shown.strokes["h"].start))
    improved = "" if isinstance(shown, ImprovedBalancer) else IMPROVED
    sheet, cells = _sheet({name: title.removesuffix(improved) for name, (title, _) in parts.items()}, _name(shown))
    for (name, (_, draw)), ax in zip(parts.items(), cells, strict=True):
        draw(ax, motion)
        is_reaction = draw in (seals_alone, reactions, against_measured)
        if is_reaction:
            _measured(ax, motion, measured)
        if draw is against_measured and not measured:
            beside(ax, "no measured values given", (0.98, 0.10), (0, 0), xycoords="axes fraction", ha="right")
        if key[0] == "6" and machine is None:
            _as_it_stands(ax, name)
        if is_reaction:  # it may fall below zero
            low, high = ax.get_ylim()
            low = min(low, -0.05 * high)
            ax.axhspan(low, 0.0, color=style.ACCENT, alpha=0.10, linewidth=0, zorder=1.0)
            ax.set_ylim(low, high)
            ax.axhline(0.0, color=style.ACCENT, linewidth=1.0, zorder=2.0)
            look = {"ha": "right", "va": "top", "color": style.ACCENT}
            beside(ax, "the shoe hangs", (1.0, 0.0), (-4, -3), xycoords=("axes fraction", "data"), **look)
        along = np.concatenate([x for x in (np.asarray(line.get_xdata(), float) for line in ax.get_lines()) if len(x) > 2])
        ax.set_xlim(float(along.min()), float(along.max()))
        ax.legend(loc="best", fontsize=style.SMALL, facecolor=style.PAPER, edgecolor="none", framealpha=0.85, labelcolor=style.INK)
    return sheet


# -- reactions ---------------------------------------------------------------------------------------------


def seals_alone(ax: Axes, motion: Motion) -> None:
    """Draw figure 2 a: the reaction with no friction in any pin."""
    reactions(ax, motion, dry_frictions(motion))


def reactions(ax: Axes, motion: Motion, without: Sequence[str] = ()) -> None:
    """Draw the reaction of a shoe over its height: up, down, without friction; the paper's gas law thin beside."""
    paper = Motion(motion.plan, {**motion.designs, "atmosphere": 0.0}, motion.strokes, motion.unreachable)
    curves, printed, height = _reactions(motion, without), _reactions(paper, without), HeaderState(motion).height
    _ways(ax, height, curves)
    if motion.inputs["atmosphere"]:
        apart = max(float(np.max(np.abs(values - printed[label]))) for label, values in curves.items())
        text = f"the paper's gas law, on gauge pressures: at most {apart:.1f} kgf apart"
        for values in printed.values():
            ax.plot(height / mm, values, color=style.INK, linewidth=0.9, linestyle=(0, (5, 6)), zorder=6.0, label=text)
            text = "_"


def against_measured(ax: Axes, motion: Motion) -> None:
    """Draw figure 7: calculated solid, with the band of the paper's 7 %."""
    height, curves, text = HeaderState(motion).height, _reactions(motion), f"{ALLOWED:g} % about the calculated ones"
    moving = {label: curves[label] for label in CURVES.values()}
    for label, values in moving.items():
        share = ALLOWED / 100.0 * np.abs(values)
        ax.fill_between(height / mm, values - share, values + share, color=COLOURS[label], alpha=0.14, linewidth=0, label=text)
        text = "_"
    _ways(ax, height, moving)


def _ways(ax: Axes, height: FloatArray, curves: Mapping[str, FloatArray]) -> None:
    """Draw curves by the way of moving [kgf]."""
    for label, values in curves.items():
        curve(ax, height / mm, values, COLOURS[label], label)
    ax.set_ylabel("reaction of a shoe, kgf")


def _measured(ax: Axes, motion: Motion, measured: Sequence[Deviation]) -> None:
    """Lay measured reactions over the calculated ones, with their largest deviation."""
    for each in measured:
        if each.curve in CURVES:
            text = f"measured {CURVES[each.curve]}: up to {np.abs(each.percent).max():.1f} % apart"
            height, values = each.height / mm, each.measured / kgf / float(motion.inputs["shoes"])
            colour = COLOURS[CURVES[each.curve]]
            ax.plot(height, values, "--o", label=text, zorder=7.0, color=colour, markersize=5.5, markeredgecolor=style.PAPER)


def bearings(ax: Axes, motion: Motion) -> None:
    """Draw figure 2 b: the part of plain bearings at O in the reaction, up and down, as a force at a shoe."""
    balance, shoes = HeaderState(motion), float(motion.inputs["shoes"])
    radius = float(motion.inputs[f"{BEARING}.radius"])
    for label in ("moving up", "moving down"):
        added = (balance.reaction(WAYS[label], PLAIN) - balance.reaction(WAYS[label], 0.0)) / kgf / shoes
        curve(ax, balance.height / mm, added, COLOURS[label], label)
    ratio = np.divide(*balance.of_bearings)
    ax.axhline(0.0, color=style.MUTED, linewidth=0.8, zorder=2.0)
    says = f"r = {radius / mm:.0f} mm, mu = {PLAIN:g}: hysteresis x{ratio.min():.2f} to x{ratio.max():.2f} of rolling bearings'"
    beside(ax, says, (0.5, 0.5), (0, 8), xycoords="axes fraction", ha="center")
    ax.set_ylabel("added at a shoe, kgf")


# -- pressures ---------------------------------------------------------------------------------------------


def given_pressure(ax: Axes, motion: Motion) -> None:
    """Draw the pressure in the accumulators over the shoe's height, and the charges of the pairs about there."""
    balance = HeaderState(motion)
    curve(ax, balance.height / mm, balance.pressure / kgf_cm2, style.CURVE, "in the accumulators")
    ax.set_ylabel("pressure, kgf/cm²")
    _charges(ax, balance)


def needed_pressure(ax: Axes, motion: Motion) -> None:
    """Draw figure 3 b: the pressure at which the shoes carry nothing, up and down, from the shoe's lowest place to the stroke's end."""
    lowest, end = motion.strokes["h"][0], motion.plan.strokes["h"].end
    balance = HeaderState(motion.moved({"h": np.linspace(lowest, end, 101)}))
    for label in ("moving up", "moving down"):
        curve(ax, balance.height / mm, balance.required_while(WAYS[label]) / kgf_cm2, COLOURS[label], label)
    follows = float(motion.inputs["follows"]) / mm
    ax.axvspan(-follows, follows, color=style.CURVE, alpha=0.08, linewidth=0, label="following range")
    for name, pressure in (("pump", motion.inputs["pump"]), ("relief valve", motion.inputs["valve"])):
        _level(ax, float(pressure) / kgf_cm2, f"{name}, {float(pressure) / kgf_cm2:.4g}")
    ax.set_ylabel("pressure, kgf/cm²")


def both_pressures(ax: Axes, motion: Motion) -> None:
    """Draw given and needed pressure over the shoe's height, the latter with friction as a band."""
    balance = HeaderState(motion)
    up, down = (balance.required_while(way) / kgf_cm2 for way in ("extending", "retracting"))
    text = "with friction: up at the upper edge, down at the lower"
    ax.fill_between(balance.height / mm, down, up, color=style.ACCENT, alpha=0.12, linewidth=0, label=text)
    curve(ax, balance.height / mm, balance.required / kgf_cm2, style.ACCENT, "needed: the shoes carry nothing")
    given_pressure(ax, motion)
    ax.margins(y=0.14)  # room for the legend


PARTS: Mapping[str, tuple[str, Drawing]] = MappingProxyType(
    {
        "2a": ("Reaction of a shoe, hysteresis from the cylinders' seals only", seals_alone),
        "2b": ("What plain bearings at O add, as a force at a shoe", bearings),
        "3a": ("Pressure in the accumulators while following", given_pressure),
        "3b": ("Pressure needed to lift, over the whole stroke", needed_pressure),
        "4a": ("Reaction of a shoe", reactions),
        "4b": ("Given and needed pressure", both_pressures),
        "5a": ("Reaction of a shoe", reactions),
        "5b": ("Given and needed pressure", both_pressures),
        "6a": (f"Reaction of a shoe{IMPROVED}", reactions),
        "6b": (f"Given and needed pressure{IMPROVED}", both_pressures),
        "7": ("Reaction of a shoe, calculated and measured", against_measured),
    }
)


def _as_it_stands(ax: Axes, part: str) -> None:
    """Lay header 1 on the machine as it stands beside the improved one, thin."""
    motion = over_following(with_header(1).at(h=0.0))
    balance = HeaderState(motion)
    if part == "6a":
        found = _reactions(motion)
        for label in ("moving up", "moving down"):
            text = f"as it stands, {label}"
            ax.plot(balance.height / mm, found[label], color=COLOURS[label], linewidth=1.1, linestyle=":", label=text, zorder=4.0)
        low, high = ax.get_ylim()
        ax.set_ylim(low, high + 0.25 * (high - low))  # room for the legend
    else:
        for values, colour, text in (
            (balance.required, style.ACCENT, "needed, as it stands"),
            (balance.pressure, style.CURVE, "in the accumulators, as it stands"),
        ):
            ax.plot(balance.height / mm, values / kgf_cm2, color=colour, linewidth=1.1, linestyle=":", label=text, zorder=4.0)


def _charges(ax: Axes, balance: HeaderState) -> None:
    """Mark the gas charges near the curves: below its own a pair is off; where it joins there is a kink."""
    motion = balance.motion
    shown = np.concatenate([np.asarray(line.get_ydata(), float) for line in ax.get_lines()])
    low, high = float(shown.min()), float(shown.max())
    for gas, volume in balance.vessels:
        if not low - 0.2 * (high - low) <= gas / kgf_cm2 <= high + 0.2 * (high - low):
            continue
        _level(ax, gas / kgf_cm2, f"gas charge of a pair ({volume / litre:.4g} l), {gas / kgf_cm2:.4g}: off below")
        works = below_zero(motion, lambda at, gas=gas: gas - HeaderState(at).pressure)  # type: ignore[misc]
        if works and works[-1].end["h"] < motion.strokes["h"][-1]:
            height = height_at(motion, works[-1].end["h"]) / mm
            dot(ax, height, gas / kgf_cm2, style.CURVE)
            line = {"arrowstyle": "-", "color": style.CURVE, "linewidth": 0.8}
            text, at = "the pair joins: a kink", (height, gas / kgf_cm2)
            beside(ax, text, at, (-10, -22), ha="right", color=style.CURVE, arrowprops=line)


# -- the sheet ---------------------------------------------------------------------------------------------


def _reactions(motion: Motion, without: Sequence[str] = ()) -> dict[str, FloatArray]:
    """Return the reaction of one shoe [kgf] in each way, without some loads."""
    loads, shoes = own_loads(motion, *without), motion.inputs["shoes"]
    return {label: reaction(motion, loads, SHOE, direction=way) / kgf / shoes for label, way in WAYS.items()}


def _name(machine: HeaderBalancer) -> str:
    """Return the header's number where it is one of the published ones, with the charge."""
    own = ("m2", "L_OR", "BOR", "OG2", "BOG2")
    found = [number for number, values in HEADERS.items() if all(machine[key] == values[key] for key in own)]
    what = f"header {found[0]}" if found else "a header of its own"
    return f"{what}, {machine['m2']:.0f} kg, charged to {machine['charge'] / kgf_cm2:.4g} kgf/cm²"


def _sheet(titles: Mapping[str, str], name: str) -> tuple[Figure, list[Axes]]:
    """Return an empty figure with a titled part for each key, `2a` or `7`, that also names the header."""
    sheet, cells = panels(SIZE if len(titles) == 1 else PAIR, len(titles))
    for (part, title), ax in zip(titles.items(), cells, strict=True):
        number = f"{part[0]} {part[1:]}".strip()
        headed(ax, f"{number}   {title}", fontsize=style.TITLE, fontweight="bold", pad=26)
        beside(ax, name, (0.0, 1.0), (0, 8), xycoords="axes fraction", fontsize=style.TEXT)
        ax.set_xlabel("height of the shoe above the horizon, mm", **WORDS)
        ax.yaxis.label.set(**WORDS)
    return sheet, cells


def _level(ax: Axes, value: float, text: str) -> None:
    """Draw a pressure that matters as a line across, with its name."""
    ax.axhline(value, color=style.MUTED, linewidth=1.0, linestyle=(0, (4, 3)), zorder=2.0)
    beside(ax, text, (1.0, value), (-4, 3), xycoords=("axes fraction", "data"), ha="right", va="bottom")
