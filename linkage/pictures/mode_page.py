"""All assembly modes of a mechanism as small pictures, each with the line of code that chooses it."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from ..assembly import Assembly
from ..errors import DefinitionError, ensure
from ..language import said, said_of
from ..motion import Motion
from . import style
from .drawing import draw_scene
from .scene import Scene
from .sheet import Keywords, empty_figure, fitted_to, footnote, write_title
from .strokes import pose_words

MOST_MODES = 24
"""The modes on a page; of more, these first ones."""
ACROSS, PANEL, GAP, HEAD_ROOM, LINE = 4, 3.1, 0.18, 0.72, 0.135
"""Panels in a row, a panel's width, the gap between two, the room for the title, and the height of a line of code [inch]."""
CODE, NAMES = 6.6, 8.0
"""The sizes of the letters of code and of points' names [points]."""


def draw_modes(modes: Sequence[Assembly]) -> Figure:
    """Return a figure of the assembly modes that `machine.assemblies()` lists, the declared one marked, each with its code."""
    shown = list(modes)[:MOST_MODES]
    motions = []
    for mode in shown:
        if mode.plan is None:
            raise DefinitionError("An assembly mode is drawn with its mechanism; take it from machine.assemblies().")
        designs = {name: mode.inputs[name] for name in mode.plan.table.entries}
        strokes = {name: np.asarray(np.ravel(mode.inputs[name])[0], float) for name in mode.plan.strokes}
        motions.append(Motion(mode.plan, designs, strokes, "nan"))  # NaN at a change point
    scenes = [Scene(motion) for motion in motions]
    boxes = np.array([scene.box(7.0) for scene in scenes if scene.reached])
    ensure(boxes.size, "All modes stand at a change point here; list them at another stroke, assemblies(S=...).")
    extent = float(np.max(boxes[:, 1] - boxes[:, 0])), float(np.max(boxes[:, 3] - boxes[:, 2]))  # what any of them takes [m]
    across = min(ACROSS, len(shown))
    rows = -(-len(shown) // across)
    wide, texts = int(PANEL * 72.0 / (0.602 * CODE)), []
    for mode in shown:  # its code, wrapped; of the declared one that it is that
        code = [line for each in mode.code.splitlines() for line in textwrap.wrap(each, wide, subsequent_indent="    ")]
        texts.append([said("as declared"), *([f"# {mode}"] if str(mode) else [])] if mode.is_declared else code)
    high = PANEL * float(np.clip(extent[1] / extent[0], 0.5, 1.3))
    code_room = LINE * max(map(len, texts)) + 0.12
    width, height = max(2, across) * (PANEL + GAP) + GAP, HEAD_ROOM + rows * (high + code_room + GAP) + 0.3
    figure = empty_figure(width, height)
    for place, (mode, scene, text) in enumerate(zip(shown, scenes, texts, strict=True)):
        row, column = divmod(place, across)
        left, top = GAP + column * (PANEL + GAP), height - HEAD_ROOM - row * (high + code_room + GAP)
        ax = figure.add_axes((left / width, (top - high) / height, PANEL / width, high / height))
        draw_mode(ax, mode, scene, extent)
        colour = style.CURVE if mode.is_declared else style.INK
        look: Keywords = {"family": "monospace", "color": colour, "va": "top", "linespacing": 1.25, "gid": f"code {place}"}
        figure.text(left / width, (top - high - 0.06) / height, "\n".join(text), fontsize=CODE, **look)
    plan, motion = motions[0].plan, motions[0]
    count = said_of(len(modes), "{n} assembly mode", "{n} assembly modes")
    if len(modes) > len(shown):
        count = said("{modes}, the first {number} of them", modes=count, number=len(shown))
    write_title(figure, f"{plan.heading}: {count}", pose_words(motion, 0))
    notes = [said("Each line replaces the one that is in the class.")]
    notes += [said("Modes of pins found together are looked for from places at random, one may be missing.")] if plan.groups else []
    footnote(figure, " ".join(notes))
    return figure


def draw_mode(ax: Axes, mode: Assembly, scene: Scene, extent: tuple[float, float]) -> None:
    """Draw a mode on small axes that show so much, amid them; the declared one has a coloured frame."""
    x0, x1, y0, y1 = scene.box() if scene.reached else (0.0, 1.0, 0.0, 1.0)
    x, y, wide, high = 0.5 * (x0 + x1), 0.5 * (y0 + y1), *extent
    left, right, bottom, top = fitted_to(ax, (x - 0.5 * wide, x + 0.5 * wide, y - 0.5 * high, y + 0.5 * high))
    ax.set(xlim=(left, right), ylim=(bottom, top), xticks=[], yticks=[])
    ax.set_aspect("equal", adjustable="box")
    for spine in ax.spines.values():
        spine.set(color=style.CURVE if mode.is_declared else style.RULE, linewidth=2.4 if mode.is_declared else style.THIN)
    if mode.is_declared:
        ax.add_patch(Rectangle((0, 0), 1, 1, transform=ax.transAxes, facecolor=style.CURVE, alpha=0.06, zorder=-10))
    if not scene.reached:
        ax.text(
            0.5, 0.5, said("stands at a change point here"), transform=ax.transAxes, ha="center", color=style.ACCENT, fontsize=style.SMALL
        )
        return
    draw_scene(ax, scene, scene.reached[0], (), all_points=False, font=NAMES)
