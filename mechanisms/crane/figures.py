"""The figures of a crane and of its drives, by name. They load matplotlib, and are loaded when one is drawn."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from linkage import Acting, Answer, Motion, deg, draw, kN, plot
from linkage.pictures import style
from linkage.pictures.force_arrows import ForceQuestion
from linkage.pictures.overlays import Overlays
from linkage.pictures.poses import draw_over
from linkage.pictures.sheet import sheet

from ..sheets import CURVES, axis_words, beside, curve, dot, headed, titled
from .drive_report import Movement, WorstMovement, angle_of, worst_movements
from .drives import BoomDrive, DrivenArm
from .flow import arm_drive_of, boom_drive_of
from .lifted_map import envelope, load_map
from .machine import Crane
from .skeleton import POSITIONS, CraneSkeleton

COUNT = 361
REACHED = "#dbe8f4"


# -- positions ---------------------------------------------------------------------------------------------


def positions(crane: CraneSkeleton) -> Figure:
    """Return the crane in the positions that its skeleton is laid out by, with the heights that it has to keep."""
    bare = CraneSkeleton(**{name: crane[name] for name in CraneSkeleton.plan.defaults})
    lengths = ", ".join(f"{words} {float(crane[name]):.3f} m" for name, words in LENGTHS.items())
    title = f"Crane {float(crane['L']):.4g} m, {float(crane['M']) / kN:.4g} kNm: {lengths}"
    page, axes = titled(title, (13.4, 9.6), 2, 2, rect=(0.005, 0.01, 0.99, 0.96), w_pad=0.06, h_pad=0.06)
    most = float(crane["L"])
    top = float(crane["H_p"] + crane["h_0"] + crane["l_c"])
    for ax, (number, words) in zip(axes, POSITIONS.items(), strict=True):
        sheet(ax, (-0.24 * most, 1.06 * most, -0.3, top + 0.5))
        surroundings(ax, crane)
        motion = bare.position(number)
        (start, end) = motion["K"], motion["T"]
        ax.plot(*zip(start, end, strict=True), color=style.BODIES[2], linewidth=5.0, solid_capstyle="round", zorder=8.0)
        draw(motion, ax=ax)
        headed(ax, f"{number}: {words}")
    return page


LENGTHS: Mapping[str, str] = MappingProxyType({"l_c": "boom", "l_p": "arm", "l_t": "telescope", "h_0": "column"})
HEIGHTS: Mapping[str, str] = MappingProxyType({"H_p": "platform", "h_s": "stakes", "H_k": "cab", "H_max": "legal height"})


def surroundings(ax: Axes, crane: CraneSkeleton) -> None:
    """Draw the ground, the column, the guard and the heights that the crane has to keep."""
    left, _ = ax.get_xlim()
    ax.axhspan(ax.get_ylim()[0], 0.0, color=style.GRID, zorder=1.0)
    ax.axhline(0.0, color=style.PISTON, linewidth=1.2, zorder=2.0)
    for name, words in HEIGHTS.items():
        height = float(crane[name])
        ax.axhline(height, color=style.ACCENT if name == "H_max" else style.MUTED, linewidth=0.8, linestyle=(0, (5, 4)), zorder=2.0)
        below = name == "h_s"  # stakes and cab are often nearly as high
        beside(ax, words, (left, height), (4, -2 if below else 2), va="top" if below else "bottom", zorder=12.0)
    platform, top = float(crane["H_p"]), float(crane["H_p"] + crane["h_0"])
    ax.add_patch(Rectangle((-0.12, platform), 0.24, top - platform, facecolor=style.BARREL, edgecolor=style.INK, linewidth=0.9, zorder=3.0))
    guard, stakes = float(crane["c"]), float(crane["h_s"])
    ax.plot([guard, guard], [platform, stakes], color=style.PISTON, linewidth=2.2, solid_capstyle="butt", zorder=3.0)
    beside(ax, "guard", (guard, 0.5 * (platform + stakes)), (4, 0), va="center", zorder=12.0)


# -- moments -----------------------------------------------------------------------------------------------


def crane_moments(crane: Crane) -> Figure:
    """Return the moments of boom and arm, from the cylinders and required at worst, over their angles."""
    title = "Moments of boom and arm: given by the cylinder, asked for at worst"
    return moments_sheet(title, boom_drive_of(crane), arm_drive_of(crane))


def movements(crane: Crane) -> Figure:
    """Return the four movements of the arm at their bounds, figure 2.15 a to d. Loads have their lever arms about J."""
    limits = {name: (float(np.min(ends)), float(np.max(ends))) for name, ends in crane.limits_of().items()}
    (boom_up, boom_down), (folded, open_), (t_in, t_out) = (limits[name] for name in ("phi", "psi", "t"))
    level = 90 * deg
    asked = {
        "a: folding, the arm level inwards (2.39)": (folded, min(open_, boom_down - level), None, level, t_in),
        "b: folding, the boom as low as it goes (2.41)": (max(folded, boom_down - level), min(open_, boom_down), boom_down, 0.0, t_in),
        "c: opening, the arm level outwards (2.42)": (max(folded, boom_up + level), open_, None, -level, t_out),
        "d: opening, the boom as high as it goes (2.43)": (max(folded, boom_up), min(open_, boom_up + level), boom_up, 0.0, t_out),
    }
    there = {words: each for words, each in asked.items() if each[0] < each[1]}
    down = -(-len(there) // 2)
    title = "Arm: loads about the joint of boom and arm, lever arms in m"
    page, axes = titled(title, (15.0, 5.0 * down + 0.6), 2, down, rect=(0.02, 0.02, 0.97, 0.96))
    for ax in axes:
        headed(ax, " \n ", pad=8)
        axis_words(ax, "x, m", "y, m")
    page.draw_without_rendering()  # so that texts are placed where the sheets stay
    page.set_layout_engine("none")
    for ax, (words, (low, high, phi, aside, t)) in zip(axes, there.items(), strict=False):
        psi = 0.5 * (low + high)
        motion = crane.at(phi=psi + aside if phi is None else phi, psi=psi, t=t)
        sense = draw_over(ax, motion, 0, Overlays(ForceQuestion("J", Acting(case="lifting")))).partition(". ")[2]
        place = f"$\\varphi$ = {float(motion.strokes['phi']) / deg:.0f}°, $\\psi$ = {psi / deg:.0f}°"
        headed(ax, f"{words}: {place}\n{sense}", pad=8, fontsize=style.SMALL + 0.5)
    return page


# -- the load map ------------------------------------------------------------------------------------------

CELLS = 14, 15


def shipped_map(crane: Crane) -> Figure:
    """Return the load map over all that the tip reaches above -0.2 of the reach, 14 radii by 15 heights."""
    far, top = envelope(crane).border.max(axis=(0, 1))
    across, down = CELLS
    return plot(load_map(crane, np.linspace(-0.2 * far, top - 0.3, down), np.linspace(0.05 * far, far - 0.02, across)))


# -- the reach ---------------------------------------------------------------------------------------------


def reach_figure(crane: Crane) -> Figure:
    """Return all that the tip reaches, the crane at its longest and folded in it."""
    found = envelope(crane)
    edges = found.border.reshape(-1, 2)
    page, (ax,) = titled(f"Reach of the tip: {found.area:.1f} m²", (10.4, 9.6), 1, rect=(0.005, 0.01, 0.985, 0.96))
    (left, low), (right, high) = edges.min(axis=0), edges.max(axis=0)
    sheet(ax, (left - 0.4, right + 0.4, low - 0.4, high + 0.4))
    middle = 0.5 * (found.heights[1:] + found.heights[:-1])
    below, above = np.append(found.heights[0], middle), np.append(middle, found.heights[-1])
    strips = [[(a, below[k]), (b, below[k]), (b, above[k]), (a, above[k])] for k, a, b in found.spans]
    ax.add_collection(PolyCollection(strips, facecolors=REACHED, edgecolors=REACHED, linewidths=0.8, zorder=1.5), autolim=False)
    border = LineCollection(list(found.border), colors=style.INK, linewidths=1.4, capstyle="round", zorder=5.5)
    ax.add_collection(border, autolim=False)
    surroundings(ax, crane)
    draw(crane.position(3), ax=ax, faint=True)
    draw(crane.position(1), ax=ax)
    return page


DRAWN: Mapping[str, Callable[[Crane], Figure]] = MappingProxyType(
    {"positions": positions, "moments": crane_moments, "movements": movements, "map": shipped_map, "reach": reach_figure}
)


# -- a drive's moments ---------------------------------------------------------------------------------------


def drive_moments(drive: BoomDrive | DrivenArm) -> Figure:
    """Return the moment given and the moment asked for over the angle, the band between them, and where it is narrowest and widest."""
    return moments_sheet(title_of(drive), drive)


def moments_sheet(title: str, *drives: BoomDrive | DrivenArm) -> Figure:
    """Return the moments of all movements of some drives, a panel each."""
    worst = [(motion, each) for motion in (drive.working(COUNT) for drive in drives) for each in worst_movements(motion)]
    shape = 5.6 * len(worst) + 0.6, 5.2
    page, cells = titled(title, shape, len(worst), rect=(0.005, 0.01, 0.98, 0.98), w_pad=0.12, h_pad=0.08)
    for ax, (motion, each) in zip(cells, worst, strict=True):
        one_movement(ax, motion, each)
    return page


def title_of(drive: BoomDrive | DrivenArm) -> str:
    """Return the title of a drive, with its cylinder."""
    what = "Boom drive" if isinstance(drive, BoomDrive) else "Arm drive"
    return f"{what}, cylinder {drive['D'] * 1e3:.0f}/{drive['d'] * 1e3:.0f} mm, stroke {drive['S'] * 1e3:.0f} mm"


def one_movement(ax: Axes, motion: Motion, worst: WorstMovement) -> None:
    """Draw one movement's moments over the angle."""
    name, movement = angle_of(motion), worst.movement
    angle, given, asked = motion.strokes[name] / deg, motion[movement.given] / kN, motion.value(movement.asked) / kN
    ax.fill_between(angle, asked, given, where=given >= asked, color=style.CURVE, alpha=0.16, linewidth=0, zorder=3.0, label="over")
    if worst.short:
        ax.fill_between(angle, asked, given, where=given < asked, color=style.ACCENT, alpha=0.35, linewidth=0, zorder=3.0, label="missing")
    index = {"lifting": "", "folding": "1", "opening": "2"}[movement.name]
    curve(ax, angle, given, style.CURVE, f"given, $M_{{g{index}}}$")
    curve(ax, angle, asked, style.INK, f"asked, $M_{{l{index}}}$")
    ax.set(xlim=(angle.min(), angle.max()), ylim=(min(0.0, float(given.min())), 1.18 * float(max(given.max(), asked.max()))))
    marked(ax, motion, movement, worst.least, "least")
    if worst.most.value > 0.0:
        marked(ax, motion, movement, worst.most, "most")
    headed(ax, movement.name.capitalize(), fontsize=style.TITLE, fontweight="bold", pad=9)
    axis = "boom from the upward vertical, $\\varphi$" if name == "phi" else "between boom and arm, $\\psi$"
    axis_words(ax, f"{axis}, deg", "moment, kNm")
    ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.13), ncols=4, **CURVES)


def marked(ax: Axes, motion: Motion, movement: Movement, found: Answer, word: str) -> None:
    """Mark where most or least is over, as a line between the two curves with its size: above them, or below them."""
    name, above = angle_of(motion), word == "most"
    there = motion.moved(found.strokes)
    at, asked, given = (float(each) for each in (found.strokes[name] / deg, there.value(movement.asked) / kN, there[movement.given] / kN))
    colour = style.CURVE if above else style.ACCENT
    ax.plot([at, at], [asked, given], color=colour, linewidth=1.2, zorder=7.0)
    dot(ax, [at, at], [asked, given], colour, 5.0)
    (low, high), (bottom, top) = ax.get_xlim(), ax.get_ylim()
    place = (at - low) / (high - low)
    side = "left" if place < AT_EDGE else "right" if place > 1.0 - AT_EDGE else "center"
    moment = motion[movement.given if above else movement.asked] / kN
    angle = motion.strokes[name] / deg
    rise = np.abs(moment - np.interp(at, angle, moment))[np.abs(angle - at) < AT_EDGE * (high - low)]
    off = 8.0 + PANEL * float(rise.max(initial=0.0)) / (top - bottom)
    aside = {"left": 4.0, "right": -4.0}.get(side, 0.0)
    text, end = f"{word} {float(found.value) / kN:z.1f} kNm\nat {at:.1f}°", max(asked, given) if above else min(asked, given)
    va, off = ("bottom", off) if above else ("top", -off)
    beside(ax, text, (at, end), (aside, off), ha=side, va=va, color=colour, zorder=8.0)


AT_EDGE = 0.07
"""Of the axis: half of what a mark's words take."""
PANEL = 260.0
"""How high a panel is, printer's points."""


# -- a drive's positions -------------------------------------------------------------------------------------


def drive_positions(drive: BoomDrive | DrivenArm) -> Figure:
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
    title, size = f"{title_of(drive)}{'; the arm is drawn short' if short else ''}", (4.6 * len(poses), 3.7 if short else 5.4)
    page, cells = titled(title, size, len(poses), rect=(0.005, 0.01, 0.99, 0.98), w_pad=0.05, h_pad=0.05)
    for pose, (ax, (at, text)) in enumerate(zip(cells, poses, strict=True)):
        draw(shown, ax=ax, pose=pose)
        symbol = "\\varphi" if name == "phi" else "\\psi"
        headed(ax, f"${symbol}$ = {at / deg:.1f}°: {text}")
    return page


SHORT_ARM = 0.9
"""m: how long an arm is drawn, whose drive is meant."""


SAME = 0.2 * deg
"""Poses nearer to each other than this are one picture."""


DRIVES: Mapping[str, Callable[[BoomDrive | DrivenArm], Figure]] = MappingProxyType({"moments": drive_moments, "positions": drive_positions})
