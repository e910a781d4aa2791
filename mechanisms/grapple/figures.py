"""The grapple's figures, one call each: `figure("stems")`. They load matplotlib, and are loaded when one is drawn.

"stems" is the grapple open, at the largest and at the smallest stem, with the rosette of stems that rest on T. "moments" is what
its lever gives and what the stems need, over their diameter.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle, Polygon

from hydraulics import Cylinder
from linkage import Motion, deg, mm, ref
from linkage.pictures import style
from linkage.program import FloatArray

from ..sheets import CURVES, axis_words, beside, curve, headed, marked_place, titled
from .machine import Grapple
from .report import GrappleState, gripping, moment_ratio, require_placed, travelling

STEMS = 5
"""Stems of the rosette, the largest and the smallest among them."""
WOOD = ("#e9dcc3", "#b59a6a")
"""A stem's face and its bark."""
THICK = 0.055
"""How thick the lever is drawn at its hinge, in shares of D_0."""


# -- three positions with the rosette of stems -------------------------------------------------------------


def stems(grapple: Grapple) -> Figure:
    """Return the grapple open, at D_0 and at d_0, both levers, with the rosette of stems resting on T."""
    way = travelling(require_placed(grapple.at(theta=0.0)), 41)
    start, end = (float(way.strokes["theta"][place]) for place in (0, -1))
    half = float(way.inputs["D_0"]) / 2.0  # a box that has room for both levers over their whole way [m]
    pad = 0.16 * half
    right = max(float(np.abs(way.x(point)).max()) for point in "ACEO") + 2.0 * pad
    low = min(-half, *(float(way.y(point).min()) for point in "AC")) - 1.8 * pad
    high = max(half, *(float(way.y(point).max()) for point in ("C", "E", rod_end(way)))) + 2.2 * pad
    left = -right
    named, drawn_in = (("bore", "bore"), ("rod", "rod"), ("stroke", "S")), grapple.at(theta=0.0)
    size = ", ".join(f"{word} {float(drawn_in.value(ref(name))) / mm:.0f}" for word, name in named)
    stems_held = f"{float(grapple['d_0']) / mm:.0f} to {float(grapple['D_0']) / mm:.0f} mm"
    title = f"The grapple and its stems, {stems_held}; cylinder, mm: {size}"
    shape = 14.4, 1.2 + 4.6 * (high - low) / (right - left)
    page, axes = titled(title, shape, 3, rect=(0.005, 0.0, 0.99, 0.985), w_pad=0.06, h_pad=0.06)
    for ax, theta, title in zip(axes, (start, 0.0, end), ("open", "largest stem", "smallest stem"), strict=True):
        motion = grapple.at(theta=theta)
        ax.set(xlim=(left, right), ylim=(low, high))
        ax.set_aspect("equal")
        axis_words(ax, "x, m", "y, m")
        _rosette(ax, motion, theta)
        _frame(ax, motion)
        for sense in (-1.0, 1.0):
            _cylinder(ax, motion, sense)
            _lever(ax, motion, sense)
        _names(ax, motion)
        held = "" if theta > 0.0 else f", D = {float(motion['D']) / mm:.0f} mm"
        text = f"{title}{held}: theta = {theta / deg:.1f} deg".replace("-", "\N{MINUS SIGN}")
        headed(ax, text, fontsize=style.TITLE, pad=8)
    return page


def rod_end(motion: Motion) -> str:
    """Return the pin that the cylinder's rod ends at: C, or the crosshead that the links of both levers hang on."""
    return motion.plan.of_kind(Cylinder)["lift"].ends[1]


def _rosette(ax: Axes, motion: Motion, theta: float) -> None:
    """Draw the stems, all resting on T, the one that is held filled."""
    large, small = (float(motion.inputs[name]) for name in ("D_0", "d_0"))
    held = min(float(motion["D"]), large)
    for D in np.linspace(large, small, STEMS):
        is_held = theta <= 0.0 and abs(D - held) < 1e-9
        face = WOOD[0] if is_held else "none"
        line = {"edgecolor": WOOD[1], "linewidth": 1.6 if is_held else 0.8, "linestyle": "-" if is_held else (0, (5, 3))}
        ax.add_patch(Circle((0.0, large / 2.0 - D / 2.0), D / 2.0, facecolor=face, zorder=2.0 + (0.5 if is_held else 1.0), **line))


def _frame(ax: Axes, motion: Motion) -> None:
    """Draw the housing: from hinge to hinge over the point T that the stems rest on."""
    x_O, y_O = motion["O"].ravel()
    y_T, (x_E, y_E) = float(motion.y("T")), motion["E"].ravel()
    top = max(1.1 * y_T, y_E + 0.1 * y_T)
    near, shoulder = max(abs(x_E), 0.25 * x_O) + 0.1 * x_O, 0.12 * x_O
    right = [(0.0, y_T), (0.5 * x_O, y_T), (x_O - 0.3 * shoulder, y_O - shoulder), (x_O + shoulder, y_O), (near, top), (0.0, top)]
    outline = [*right, *((-x, y) for x, y in reversed(right))]
    ax.add_patch(Polygon(outline, facecolor="#eef1f4", edgecolor=style.RULE, linewidth=1.2, joinstyle="round", zorder=1.0))


def _mirrored(points: FloatArray, sense: float) -> FloatArray:
    """Return points, shape (n, 2), of the right-hand side (1) or mirrored to the left (-1)."""
    return np.asarray(points * np.array([sense, 1.0]))


def _lever(ax: Axes, motion: Motion, sense: float) -> None:
    """Draw the lever: a jaw around the stem from A to the hinge, and the arm from there to C, turned with it."""
    O, A, C = (motion[name].ravel() for name in "OAC")
    theta, D_0 = float(motion.strokes["theta"].ravel()[0]), float(motion.inputs["D_0"])
    back = _turned(A - O, -theta) + O  # A where the lever holds D_0, whose stem is about the origin
    first, last = np.arctan2(back[1], back[0]), np.arctan2(O[1], O[0])
    share = np.linspace(0.0, 1.0, 41)
    turn = first + (last - first) * share
    half = 0.5 * THICK * D_0 * (0.25 + 0.75 * np.sqrt(share))
    inner = D_0 / 2.0 + (np.hypot(*O) - half[-1] - D_0 / 2.0) * share**1.5
    rays = np.column_stack([np.cos(turn), np.sin(turn)])
    jaw = np.concatenate([rays * inner[:, None], (rays * (inner + 2.0 * half)[:, None])[::-1]])
    arm = _bar(O, C, 0.5 * THICK * D_0)
    colour = style.BODIES[0] if sense > 0.0 else style.mixed(style.BODIES[0], style.PAPER, 0.45)
    for outline in (_turned(jaw - O, theta) + O, arm):
        edge = style.mixed(colour, style.INK, 0.5)
        ax.add_patch(Polygon(_mirrored(outline, sense), facecolor=colour, edgecolor=edge, linewidth=1.0, joinstyle="round", zorder=6.0))
    for point in (O, C):
        ax.add_patch(Circle((sense * point[0], point[1]), 0.018 * D_0, facecolor=style.PAPER, edgecolor=style.INK, zorder=8.0))


def _turned(vectors: FloatArray, angle: float) -> FloatArray:
    """Return vectors, shape (..., 2), turned by an angle [rad]."""
    cos, sin = np.cos(angle), np.sin(angle)
    return np.asarray(vectors @ np.array([[cos, sin], [-sin, cos]]))


def _bar(P: FloatArray, Q: FloatArray, half: float) -> FloatArray:
    """Return the outline of a bar with round ends, shape (n, 2)."""
    along = np.arctan2(Q[1] - P[1], Q[0] - P[0])
    around = np.linspace(-np.pi / 2.0, np.pi / 2.0, 17)
    ends = [(point, along + around + (0.0 if point is Q else np.pi)) for point in (Q, P)]
    return np.concatenate([point + half * np.column_stack([np.cos(angle), np.sin(angle)]) for point, angle in ends])


def _cylinder(ax: Axes, motion: Motion, sense: float) -> None:
    """Draw the cylinder from E to its rod's end: barrel, and the rod out of it; and the link from a crosshead to C."""
    E, C = motion["E"].ravel(), motion[rod_end(motion)].ravel()
    if rod_end(motion) != "C":
        link = _mirrored(_bar(C, motion["C"].ravel(), 0.25 * THICK * float(motion.inputs["D_0"])), sense)
        ax.add_patch(Polygon(link, facecolor=style.BODIES[2], edgecolor=style.INK, linewidth=0.9, zorder=4.8))
    bore, closed = float(motion.inputs["bore"]), float(motion["closed"])
    along = (C - E) / np.hypot(*(C - E))
    mouth = E + along * min(0.86 * closed, 0.95 * float(np.hypot(*(C - E))))
    parts = [(E + 0.6 * bore * along, mouth, 0.62 * bore, style.BARREL, 5.2), (mouth, C, 0.5 * float(motion.inputs["rod"]), style.ROD, 5.0)]
    parts.append((E, E + 0.7 * bore * along, 0.25 * bore, style.PISTON, 5.1))
    for P, Q, half, colour, level in parts:
        across = half * np.array([-along[1], along[0]])
        outline = np.array([P + across, Q + across, Q - across, P - across])
        shade = colour if sense > 0.0 else style.mixed(colour, style.PAPER, 0.35)
        edge = style.INK if sense > 0.0 else style.MUTED
        ax.add_patch(Polygon(_mirrored(outline, sense), facecolor=shade, edgecolor=edge, linewidth=0.9, zorder=level + 0.3 * (sense > 0.0)))
    ax.add_patch(Circle((sense * E[0], E[1]), 0.4 * bore, facecolor=style.PAPER, edgecolor=style.INK, zorder=8.0))


def _names(ax: Axes, motion: Motion) -> None:
    """Name the pins and the ends of the right-hand lever."""
    T, O, C = (motion[name].ravel() for name in "TOC")
    x_out, y_out = 12.0 * (C - O) / np.hypot(*(C - O))
    aside = {"T": (0.0, 8.0), "O": (-x_out, -y_out - 3.0), "A": (0.0, -14.0), "C": (x_out, y_out), "E": (0.0, 15.0)}
    ax.plot(*T, "v", color=style.INK, markersize=6, zorder=9.0)
    if rod_end(motion) != "C":
        aside |= {rod_end(motion): (14.0, 6.0), "E": (20.0, 0.0)}  # the cylinder stands upright over E
    for name, offset in aside.items():
        look = {"fontsize": style.LABEL, "fontstyle": "italic", "color": style.INK}
        beside(ax, name, (float(motion.x(name)), float(motion.y(name))), offset, ha="center", va="center", zorder=10.0, **look)


# -- moments over the diameter -----------------------------------------------------------------------------


def moments(grapple: Grapple) -> Figure:
    """Return M_g and M_1 over the stem's diameter, and below them their ratio."""
    over = gripping(require_placed(grapple.at(theta=0.0)), 201)
    state, ratio = GrappleState(over), moment_ratio(over)
    stems_held = f"stems of {float(grapple['d_0']) / mm:.0f} to {float(grapple['D_0']) / mm:.0f} mm"
    title = f"Moments of one lever over {stems_held}"
    page, (above, below) = titled(title, (8.4, 7.2), 1, 2, rect=(0.005, 0.005, 0.985, 0.985), h_pad=0.08)
    D = state.D / mm
    above.fill_between(D, state.needed / 1e3, state.given / 1e3, color=style.CURVE, alpha=0.12, linewidth=0)
    curve(above, D, state.given / 1e3, style.CURVE, "M_g, what the lever gives")
    curve(above, D, state.needed / 1e3, style.ACCENT, "M_1, what the stem needs")
    above.set_ylim(0.0, None)
    above.legend(loc="upper left", **CURVES)
    for ax in (above, below):
        ax.set_xlim(float(D.min()), float(D.max()))
    curve(below, D, ratio, style.INK)
    below.axhline(1.0, color=style.ACCENT, linewidth=1.2, linestyle="--")
    below.set_ylim(min(0.9, 0.95 * float(ratio.min())), None)
    for place, word in ((int(np.argmin(ratio)), "least"), (int(np.argmax(ratio)), "greatest")):
        marked_place(below, float(D[place]), float(ratio[place]), f"{word} {ratio[place]:.3f} at {D[place]:.0f} mm")
    axis_words(above, "", "moment about the hinge, kNm")
    axis_words(below, "diameter of the stem, mm", "M_g / M_1")
    return page


DRAWN: Mapping[str, Callable[[Grapple], Figure]] = MappingProxyType({"stems": stems, "moments": moments})
