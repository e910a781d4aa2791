"""Figures of a crane's drives: moments over the angle, and the drive at its ends and in its worst movements. They load matplotlib."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from linkage import Motion, draw
from linkage.motion import Answer
from linkage.pictures import style
from linkage.pictures.sheet import panels
from linkage.units import deg, kN

from ..paper import named_figure
from .arm_drive import DrivenArm
from .boom_drive import BoomDrive
from .drive_report import Movement, WorstMovement, angle_of, worst_movements

COUNT = 361


def drive_figure(name: str, drive: BoomDrive | DrivenArm) -> Figure:
    """Return a figure of a drive, "moments" or "positions"; DefinitionError for an unknown name, a batch of designs."""
    return named_figure(DRAWN, name, drive)


# -- moments -----------------------------------------------------------------------------------------------


def moments(drive: BoomDrive | DrivenArm) -> Figure:
    """Return the moment given and the moment asked for over the angle, the band between them, and where it is narrowest and widest."""
    motion = drive.working(COUNT)
    worst = worst_movements(motion)
    sheet, cells = panels((5.6 * len(worst) + 0.6, 5.2), len(worst), rect=(0.005, 0.01, 0.98, 0.98), w_pad=0.12, h_pad=0.08)
    sheet.suptitle(title_of(drive), fontsize=style.TITLE + 2, fontweight="bold", color=style.INK, x=0.012, ha="left")
    for ax, each in zip(cells, worst, strict=True):
        one_movement(ax, motion, each)
    return sheet


def title_of(drive: BoomDrive | DrivenArm) -> str:
    """Return what is drawn, with its cylinder."""
    what = "Boom drive" if isinstance(drive, BoomDrive) else "Arm drive"
    return f"{what}, cylinder {drive['D'] * 1e3:.0f}/{drive['d'] * 1e3:.0f} mm, stroke {drive['S'] * 1e3:.0f} mm"


def one_movement(ax: Axes, motion: Motion, worst: WorstMovement) -> None:
    """Draw one movement's moments over the angle."""
    name, movement = angle_of(motion), worst.movement
    angle, given, asked = motion.strokes[name] / deg, movement.given(motion) / kN, movement.asked(motion) / kN
    ax.fill_between(angle, asked, given, where=given >= asked, color=style.CURVE, alpha=0.16, linewidth=0, zorder=3.0, label="over")
    if worst.short:
        ax.fill_between(angle, asked, given, where=given < asked, color=style.ACCENT, alpha=0.35, linewidth=0, zorder=3.0, label="missing")
    index = {"lifting": "", "folding": "1", "opening": "2"}[movement.name]
    ax.plot(angle, given, color=style.CURVE, linewidth=2.0, zorder=6.0, label=f"given, $M_{{g{index}}}$")
    ax.plot(angle, asked, color=style.INK, linewidth=2.0, zorder=6.0, label=f"asked, $M_{{l{index}}}$")
    ax.set(xlim=(angle.min(), angle.max()), ylim=(min(0.0, float(given.min())), 1.18 * float(max(given.max(), asked.max()))))
    marked(ax, motion, movement, worst.least, "least")
    if worst.most.value > 0.0:
        marked(ax, motion, movement, worst.most, "most")
    ax.set_title(movement.name.capitalize(), loc="left", fontsize=style.TITLE, fontweight="bold", color=style.INK, pad=9)
    axis = "boom from the upward vertical, $\\varphi$" if name == "phi" else "between boom and arm, $\\psi$"
    ax.set_xlabel(f"{axis}, deg", fontsize=style.TEXT, color=style.MUTED)
    ax.set_ylabel("moment, kNm", fontsize=style.TEXT, color=style.MUTED)
    ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.13), ncols=4, fontsize=style.SMALL, frameon=False, labelcolor=style.INK)


def marked(ax: Axes, motion: Motion, movement: Movement, found: Answer, word: str) -> None:
    """Mark where most or least is over, as a line between the two curves with its size: above them, or below them."""
    name, above = angle_of(motion), word == "most"
    there = motion.moved(found.strokes)
    at, asked, given = (float(each) for each in (found.strokes[name] / deg, movement.asked(there) / kN, movement.given(there) / kN))
    colour = style.CURVE if above else style.ACCENT
    ax.plot([at, at], [asked, given], color=colour, linewidth=1.2, zorder=7.0)
    ax.plot([at, at], [asked, given], "o", color=colour, markersize=5, markeredgecolor=style.PAPER, zorder=8.0, clip_on=False)
    (low, high), (bottom, top) = ax.get_xlim(), ax.get_ylim()
    place = (at - low) / (high - low)
    side = "left" if place < BESIDE else "right" if place > 1.0 - BESIDE else "center"
    curve = (movement.given if above else movement.asked)(motion) / kN
    rise = np.abs(curve - np.interp(at, motion.strokes[name] / deg, curve))[np.abs(motion.strokes[name] / deg - at) < BESIDE * (high - low)]
    off = 8.0 + PANEL * float(rise.max(initial=0.0)) / (top - bottom)
    aside = {"left": 4.0, "right": -4.0}.get(side, 0.0)
    ax.annotate(
        f"{word} {float(found.value) / kN:z.1f} kNm\nat {at:.1f}°", (at, max(asked, given) if above else min(asked, given)),
        xytext=(aside, off if above else -off), textcoords="offset points", ha=side, va="bottom" if above else "top",
        fontsize=style.SMALL, color=colour, zorder=8.0,
    )  # fmt: skip


BESIDE = 0.07
"""Of the axis: half of what a mark's words take."""
PANEL = 260.0
"""How high a panel is, printer's points."""


# -- positions ---------------------------------------------------------------------------------------------


def positions(drive: BoomDrive | DrivenArm) -> Figure:
    """Return the drive at both ends and where each movement has least over, a panel each, in one scale."""
    motion = drive.working(COUNT)
    name, worst = angle_of(motion), worst_movements(motion)
    ends = [(float(motion.strokes[name][place]), text) for place, text in ((0, "start"), (-1, "end"))]
    poses: list[tuple[float, str]] = []  # those that are the same as one, with all its words
    for at, text in sorted([*ends, *((float(each.least.strokes[name]), f"{each.movement.name}: least over") for each in worst)]):
        if poses and at - poses[-1][0] < SAME:
            poses[-1] = poses[-1][0], ", ".join(sorted({poses[-1][1], text}, key=lambda each: each not in ("start", "end")))
        else:
            poses.append((at, text))
    strokes: dict[str, Any] = {name: [at for at, _ in poses]}
    short = isinstance(drive, DrivenArm)  # an arm drawn as long as it is would dwarf its drive
    shown = (drive.replaced(l_p=min(SHORT_ARM, float(drive["l_p"]))) if short else drive).at(**strokes)
    sheet, cells = panels((4.6 * len(poses), 3.7 if short else 5.4), len(poses), rect=(0.005, 0.01, 0.99, 0.98), w_pad=0.05, h_pad=0.05)
    title = f"{title_of(drive)}{'; the arm is drawn short' if short else ''}"
    sheet.suptitle(title, fontsize=style.TITLE + 2, fontweight="bold", color=style.INK, x=0.012, ha="left")
    for pose, (ax, (at, text)) in enumerate(zip(cells, poses, strict=True)):
        draw(shown, ax=ax, pose=pose)
        symbol = "\\varphi" if name == "phi" else "\\psi"
        ax.set_title(f"${symbol}$ = {at / deg:.1f}°: {text}", loc="left", fontsize=style.TEXT, color=style.INK, pad=6)
    return sheet


SHORT_ARM = 0.9
"""m: how long an arm is drawn, whose drive is meant."""


SAME = 0.2 * deg
"""Poses nearer to each other than this are one picture."""


DRAWN: Mapping[str, Callable[[BoomDrive | DrivenArm], Figure]] = MappingProxyType({"moments": moments, "positions": positions})
