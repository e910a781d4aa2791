"""The picture of Burmester's theory: the curves of circle and centre points, the poses, the region of the pivots, and the links."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from ..language import said
from ..motion.regions import Disc
from ..program import FloatArray
from ..synthesis.exact_poses import Burmester, GuidingLink
from . import style
from .scene import Bounds
from .shapes import left_of, polar
from .sheet import Keywords, empty_page, legend_row, write_title

ROOM = 1.6
"""Of the extent of poses and region: how much of the plane is shown, where the curves go on."""
ARM = 0.09
"""Of the picture's side: the arms of a pose."""


def draw_burmester(found: Burmester) -> Figure:
    """Return a figure of the two curves and the links in the first pose, those of the best machine bold with its coupler."""
    chosen = np.zeros((0, 2))  # the circle points of the best machine in the first pose [m]
    if found.solutions:
        best = found.solutions[0]
        motion = best.machine.at(phi=best.strokes[:1])
        chosen = np.stack([motion["A"][:, 0], motion["B"][:, 0]])
    box = shown_box(found, chosen)
    figure, ax = empty_page(box)
    side = max(box[1] - box[0], box[3] - box[2])
    keys: list[Line2D] = []
    texts: list[str] = []
    if found.region is not None:
        for level, shapes, colour in ((0.5, found.region.within, style.GRID), (0.6, found.region.without, style.PAPER)):
            for shape in shapes:
                if isinstance(shape, Disc):
                    border = np.array([shape.x, shape.y]) + shape.radius * polar(np.linspace(0.0, 2.0 * np.pi, 181))
                else:
                    border = np.array(shape.corners)
                ax.fill(*border.T, facecolor=colour, edgecolor=style.RULE, zorder=level)
        keys.append(Line2D([], [], color=style.GRID, linewidth=8.0))
        texts.append(said("region of the fixed pivots"))
    points, centres = said("circle points"), said("centre points")
    curves = ((found.circle_curve, style.CURVE, points, "o"), (found.centre_curve, style.ACCENT, centres, "^"))
    for branches, colour, text, marker in curves:
        for branch in branches:
            closed = np.concatenate([branch, branch[:, :1]], axis=1)
            is_near = np.append(np.hypot(*np.diff(closed, axis=1)) < 4.0 * side, True)  # else it goes through infinity
            ax.plot(*np.where(is_near, closed, np.nan), color=colour, linewidth=1.6, zorder=3.0)
        keys.append(Line2D([], [], color=colour, linewidth=1.6 if branches else 0.0, marker=marker, markeredgecolor=style.INK))
        texts.append(text)
    if len(chosen):
        ax.fill(*np.concatenate([chosen, found.poses[:1, :2]]).T, facecolor=style.BODIES[0], edgecolor=style.INK, alpha=0.35, zorder=1.5)
    for link in found.links:
        draw_link(ax, link, side, bold=any(np.allclose(link.point, pin) for pin in chosen))
    draw_corners(ax, found.poses, ARM * side)
    ax.set(xlim=box[:2], ylim=box[2:])
    legend_row(ax, keys, texts)
    running, count = len(found.solutions), len(found.synthesis.all)
    beside = said("{running} of {count} machines run", running=running, count=count)
    write_title(figure, said("Burmester: {count} poses", count=len(found.poses)), beside)
    return figure


def shown_box(found: Burmester, pins: FloatArray) -> Bounds:
    """Return the box that is shown [m]: about poses, region, and the best machine's pins (2, 2) [m]."""
    shapes = found.region.within if found.region is not None else ()
    parts = [found.poses[:, :2], *(shape.bounding_box for shape in shapes)]
    places = [link.places for link in found.links if any(np.allclose(link.point, pin) for pin in pins) or len(found.poses) == 5]
    centres = [link.centre[None] for link in found.links if len(found.poses) == 5 and not link.slides]
    cloud = np.concatenate([*parts, *places, *centres, pins])
    cloud = cloud[np.isfinite(cloud).all(axis=1)]
    near = np.abs(cloud - np.median(cloud, axis=0)).max(axis=1) <= 12.0 * max(float(np.ptp(parts[0], axis=0).max()), 1e-9)
    low, high = cloud[near].min(axis=0), cloud[near].max(axis=0)
    middle, half = 0.5 * (low + high), 0.5 * ROOM * np.maximum(high - low, 0.4 * float((high - low).max()) or 1.0)
    return float(middle[0] - half[0]), float(middle[0] + half[0]), float(middle[1] - half[1]), float(middle[1] + half[1])


def draw_link(ax: Axes, link: GuidingLink, side: float, *, bold: bool) -> None:
    """Draw a link in the first pose: its circle point and, of one that turns, its centre point; of a slider its line."""
    colour = style.INK if bold else style.MUTED
    width, size, level = (2.4, 7.0, 6.0) if bold else (0.7, 3.5, 4.0)
    x, y = link.point
    if link.slides:
        way = 0.5 * side * polar(link.direction)
        ax.plot([x - way[0], x + way[0]], [y - way[1], y + way[1]], color=colour, linewidth=width, linestyle=(0, (6, 3)), zorder=level)
    else:
        ax.plot([x, link.centre[0]], [y, link.centre[1]], color=colour, linewidth=width, zorder=level, alpha=1.0 if bold else 0.55)
        ax.plot(*link.centre, "^", color=style.ACCENT, markersize=size + 1.0, markeredgecolor=style.INK, zorder=level + 1.0)
    ax.plot(x, y, "o", color=style.CURVE, markersize=size, markeredgecolor=style.INK, zorder=level + 1.0)


def draw_corners(ax: Axes, poses: FloatArray, arm: float) -> None:
    """Draw each pose as a corner whose long arm is the body's own x axis, with its number, and a line from one to the next."""
    for one, other in pairwise(poses):
        ax.plot([one[0], other[0]], [one[1], other[1]], color=style.RULE, linewidth=0.9, linestyle=":", zorder=2.0)
    for number, (x, y, angle) in enumerate(poses, 1):
        along, across = polar(angle), left_of(polar(angle))
        corner = np.array([[x, y] + arm * along, [x, y], [x, y] + 0.5 * arm * across])
        ax.plot(*corner.T, color=style.INK, linewidth=2.2, solid_joinstyle="round", zorder=7.0)
        beside = np.array([x, y]) - 0.2 * arm * (along + across)
        look: Keywords = {"fontsize": style.LABEL, "color": style.INK, "ha": "center", "va": "center"}
        ax.text(float(beside[0]), float(beside[1]), str(number), zorder=8.0, **look)
