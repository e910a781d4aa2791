"""The paper's figures 2 to 6, one call each: `figure(2)`. Matplotlib and the house's style are loaded when one is drawn.

Figures 2, 3, 4: the reaction of headers 1, 2, 3 over the following range, up, down and without friction.
Figure 5: the hysteresis with a rolling and a plain bearing at O. Figure 6: block pressure and required pressure.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from linkage import DefinitionError, Motion
from linkage.program import FloatArray
from linkage.units import kgf, kgf_cm2, mm

from .following import PLAIN, Balance, over_following
from .headers import HEADERS
from .machine import HeaderBalancer
from .measured import Deviation
from .settings import with_header

NUMBERS = (2, 3, 4, 5, 6)
SIZE = (7.6, 4.8)


def figure(number: int, machine: HeaderBalancer | None = None, measured: Sequence[Deviation] = ()) -> Any:
    """Return a figure of the paper (2 to 6) as a matplotlib figure.

    2, 3, 4 show headers 1, 2, 3; 5 and 6 header 1; or the `machine` given. `measured` curves are laid over the reactions.
    """
    if number not in NUMBERS:
        raise DefinitionError(f"Figure {number} is unknown; there are {', '.join(map(str, NUMBERS))}.")
    shown = machine if machine is not None else with_header(number - 1 if number <= 4 else 1)
    motion = over_following(shown.at(h=shown.strokes["h"].start))
    if number <= 4:
        return reactions(motion, _name(shown), measured)
    return bearings(motion, _name(shown)) if number == 5 else pressures(motion, _name(shown))


def reactions(motion: Motion, name: str, measured: Sequence[Deviation] = ()) -> Any:
    """Return the reaction of all shoes over their height: up, down, without friction; the paper's way dashed."""
    from linkage.draw import style

    sheet, ax = _sheet(f"Reaction of {name}", "reaction of all shoes, kgf")
    balance, paper = Balance(motion), Balance(_paper(motion))
    colours = {"moving up": style.CURVE, "without friction": style.MUTED, "moving down": style.ACCENT}
    curves = {"moving up": balance.up, "without friction": balance.free, "moving down": balance.down}
    printed = {"moving up": paper.up, "without friction": paper.free, "moving down": paper.down}
    for label, values in curves.items():
        _curve(ax, balance.height, values / kgf, colours[label], label)
    if motion.inputs["atmosphere"]:
        apart = max(float(np.max(np.abs(values - printed[label]))) for label, values in curves.items()) / kgf
        text = f"the paper's gas law, on gauge pressures: at most {apart:.1f} kgf apart"
        for values in printed.values():
            ax.plot(paper.height / mm, values / kgf, color=style.INK, linewidth=0.9, linestyle=(0, (5, 6)), zorder=6.0, label=text)
            text = "_"
    for each in measured:
        if each.curve in MEASURED:
            _dots(ax, each, MEASURED[each.curve], colours[MEASURED[each.curve]], style)
    _hanging(ax, style)
    return _finished(sheet, ax)


MEASURED: Mapping[str, str] = {"F_R up": "moving up", "F_R down": "moving down"}


def _dots(ax: Any, deviation: Deviation, way: str, colour: str, style: Any) -> None:
    """Draw measured values with their largest deviation."""
    text = f"measured {way}: up to {np.abs(deviation.percent).max():.1f} %"
    height, values = deviation.height / mm, deviation.measured / kgf
    ax.plot(height, values, "o", color=colour, markersize=5.5, markeredgecolor=style.PAPER, label=text, zorder=7.0)


def bearings(motion: Motion, name: str) -> Any:
    """Return the hysteresis over the shoes' height with a rolling and a plain bearing at O."""
    from linkage.draw import style

    sheet, ax = _sheet(f"Hysteresis of {name}", "hysteresis of the reaction, kgf")
    balance = Balance(motion)
    plain = balance.reaction("extending", PLAIN) - balance.reaction("retracting", PLAIN)
    radius = float(motion.inputs["pin_O.radius"])
    ax.fill_between(balance.height / mm, balance.of_seals / kgf, plain / kgf, color=style.ACCENT, alpha=0.10, linewidth=0)
    _curve(ax, balance.height, plain / kgf, style.ACCENT, f"plain bearing at O, r = {radius / mm:.0f} mm, mu = {PLAIN:g}")
    _curve(ax, balance.height, balance.of_seals / kgf, style.CURVE, "rolling bearing at O: the seals alone")
    ax.set_ylim(bottom=0.0, top=1.25 * float(plain.max()) / kgf)
    return _finished(sheet, ax)


def pressures(motion: Motion, name: str) -> Any:
    """Return the block's pressure and the required one over the shoes' height, the latter with the seals' friction as a band."""
    from linkage.draw import style

    sheet, ax = _sheet(f"Pressures of {name}", "pressure, kgf/cm²")
    balance = Balance(motion)
    up, down = (balance.required_while(way) / kgf_cm2 for way in ("extending", "retracting"))
    text = "with friction: moving up at the upper edge, moving down at the lower"
    ax.fill_between(balance.height / mm, down, up, color=style.ACCENT, alpha=0.12, linewidth=0, label=text)
    _curve(ax, balance.height, balance.required / kgf_cm2, style.ACCENT, "required: the shoe carries nothing")
    _curve(ax, balance.height, balance.pressure / kgf_cm2, style.CURVE, "in the accumulator block")
    return _finished(sheet, ax)


def _paper(motion: Motion) -> Motion:
    """Return the motion with the gas law on gauge pressures."""
    return Motion(motion.plan, {**motion.designs, "atmosphere": 0.0}, motion.strokes, motion.unreachable)


def _name(machine: HeaderBalancer) -> str:
    """Return the header's number where it is one of the published ones, with the charge."""
    found = [number for number, values in HEADERS.items() if all(machine[key] == value for key, value in values.items() if key != "charge")]
    what = f"header {found[0]}" if found else "a header of its own"
    return f"{what}, {machine['m2']:.0f} kg, charged to {machine['charge'] / kgf_cm2:.4g} kgf/cm²"


def _sheet(name: str, quantity: str) -> tuple[Any, Any]:
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    from linkage.draw import style
    from linkage.draw.sheet import quiet

    sheet = Figure(figsize=SIZE, dpi=style.DPI, facecolor=style.PAPER, layout="constrained")
    FigureCanvasAgg(sheet)
    ax = sheet.add_subplot()
    quiet(ax)
    ax.set_title(name, loc="left", fontsize=style.TITLE, fontweight="bold", color=style.INK, pad=10)
    ax.set_xlabel("height of the shoe above the horizon, mm", fontsize=style.TEXT, color=style.MUTED)
    ax.set_ylabel(quantity, fontsize=style.TEXT, color=style.MUTED)
    return sheet, ax


def _curve(ax: Any, height: FloatArray, values: FloatArray, colour: str, label: str) -> None:
    ax.plot(height / mm, values, color=colour, linewidth=2.0, label=label, zorder=5.0)


def _hanging(ax: Any, style: Any) -> None:
    """Shade where the shoe hangs: a reaction below zero."""
    low, high = ax.get_ylim()
    low = min(low, -0.05 * high)
    ax.set_ylim(low, high)
    ax.axhspan(low, 0.0, color=style.ACCENT, alpha=0.10, linewidth=0, zorder=1.0)
    ax.axhline(0.0, color=style.ACCENT, linewidth=1.0, zorder=2.0)
    ax.annotate(
        "the shoe hangs", (1.0, 0.0), xycoords=("axes fraction", "data"), xytext=(-4, -3), textcoords="offset points",
        ha="right", va="top", fontsize=style.SMALL, color=style.ACCENT,
    )  # fmt: skip


def _finished(sheet: Any, ax: Any) -> Any:
    from linkage.draw import style

    lines = ax.get_lines()
    along = np.concatenate([np.asarray(line.get_xdata(), float) for line in lines if len(line.get_xdata()) > 2])
    ax.set_xlim(float(along.min()), float(along.max()))
    ax.legend(loc="best", fontsize=style.SMALL, frameon=False, labelcolor=style.INK)
    return sheet
