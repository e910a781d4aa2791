"""Several machines in one picture: designs over one another, with their differences, and assembly modes side by side, with their code."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from matplotlib.patches import Polygon, Rectangle

from ..assembly import Assembly
from ..errors import DefinitionError, ensure
from ..language import said, said_of
from ..mechanism import Mechanism, require_mechanism
from ..motion import Motion
from ..reports import Run, dimension_unit, first_stroke, stroke_middles
from ..units import show
from . import style
from .drawing import Drawing, draw_scene
from .layout import cloud, joined_box
from .overlays import sheet_note
from .pose_choice import telling_angles
from .poses import motions, trace
from .scene import Scene
from .sheet import Keywords, empty_figure, empty_page, fitted_to, footnote, legend_row, look_keys, write_title
from .shown_values import named_points
from .strokes import is_turn, pose_words, stroke_words
from .style import FAINT, STRONG, Look

MOST_DESIGNS = 12
MOST_NAMED = 3
"""The designs in one picture, and the dimensions that its legend names."""

TEXT_WIDTH, LETTER = 8.0, 0.082
"""The room for the legend, and about the width of a letter [inch]."""

TINTS = ("#0072b2", "#d55e00", "#007f5c", "#9a3a86", "#8a5a00", "#4a5a6a")
"""The colours of designs: Okabe and Ito's, some darker; a seventh one and those after it are lighter."""


def draw_designs(machines: Sequence[Mechanism], at: object, path: Sequence[str], count: int) -> Figure:
    """Return a figure of several designs at the same strokes: of two the first one faint, of more each in its own colour.

    `at` and `path` are as for one design; without `at` every stroke is at mid-stroke.
    """
    designs = separated(machines)
    first = designs[0]
    if at is None:  # one that goes round where the first is open
        middles, moving = stroke_middles(first), first_stroke(first)
        ends = first.strokes[moving].start, first.strokes[moving].end
        turns = is_turn(first, Run({moving: ends}, {}))
        at = middles | ({moving: float(telling_angles(first, moving, middles)[-1])} if turns else {})
    path = named_points(first, path, "path")
    _, shown, swept = zip(*(motions(machine, at, count) for machine in designs), strict=True)
    scenes = [Scene(motion, over) for motion, over in zip(shown, swept, strict=True)]
    box = joined_box([(Scene(over) if path else scene).box() for over, scene in zip(swept, scenes, strict=True)])
    texts = what_differs(designs)
    columns = max(1, min(len(texts), int(TEXT_WIDTH / (0.56 + LETTER * max(map(len, texts))))))
    figure, ax = empty_page(box, -(-len(texts) // columns))
    looks, covered = looks_of(len(designs)), [np.empty((0, 2))]
    for design, (scene, over, look) in enumerate(zip(scenes, swept, looks, strict=True)):
        for name in path:
            trace(ax, over[name].reshape(2, -1), colour=look.colour(style.ACCENT))
        for pose in scene.reached:
            drawing = Drawing(ax, scene, look)
            if design == len(looks) - 1 and pose == scene.reached[-1]:
                drawing.label_points([scene.at(pose)], [each[np.isfinite(each).all(axis=1)] for each in covered])
            drawing.update(pose)
            if look.tint:
                # Let a drawing's faces be seen through, so that others under it show.
                for artist in drawing.artists:
                    if isinstance(artist, Polygon) and artist.get_fill():
                        artist.set_alpha(None)
                        artist.set_facecolor((*to_rgb(artist.get_facecolor()), 0.12))
            if pose == scene.reached[-1] and (design == len(looks) - 1 or grounds_of(scene) != grounds_of(scenes[-1])):
                drawing.look = FAINT if look is FAINT else STRONG
                drawing.ground()
            covered.append(cloud(scene, scene.at(pose))[::2])
    legend_row(ax, look_keys(looks), texts, columns)
    words = []
    for name, value in shown[0].strokes.items():
        values = np.unique(np.ravel(value))
        one = values.size == 1
        words.append(stroke_words(first.plan, name, float(values[0])) if one else said("{name}: {n} values", name=name, n=values.size))
    write_title(figure, first.plan.heading, ", ".join(words))
    lost = [text for text, scene in zip(texts, scenes, strict=True) if not scene.reached]
    sheet_note(ax, [said("Cannot be assembled here: {designs}.", designs="; ".join(lost))] if lost else [])
    return figure


def grounds_of(scene: Scene) -> list[list[float]]:
    """Return where the pins of the frame are [m]."""
    return [scene.at(0)[name].tolist() for name in scene.grounds]


def separated(machines: Sequence[Mechanism]) -> list[Mechanism]:
    """Return designs one by one, a batch as its designs; DefinitionError for none, too many, and for those of other strokes."""
    found: list[Mechanism] = []
    for machine in machines:
        require_mechanism(machine)
        shape = np.broadcast_shapes(*(np.shape(value) for value in machine.dimensions.values()))
        number = int(np.prod(shape, dtype=int))
        crowd = f"{machine.plan.title}: {number} designs do not fit into one picture, {MOST_DESIGNS} do"
        ensure(number <= MOST_DESIGNS, f"{crowd}; choose some of them, draw([machine.replaced(...), ...]).")
        changed = {name: np.broadcast_to(value, shape).ravel() for name, value in machine.dimensions.items() if np.ndim(value)}
        one = [machine.replaced(**{name: float(values[index]) for name, values in changed.items()}) for index in range(number)]
        found += one if changed else [machine]
    ensure(0 < len(found) <= MOST_DESIGNS, f"draw([...]): {len(found)} designs do not make one picture; give 1 to {MOST_DESIGNS} of them.")
    (title, strokes), *others = ((each.plan.title, ", ".join(each.strokes)) for each in found)
    for other, names in others:
        ensure(names == strokes, f"draw([...]): {other} has the strokes {names} and {title} {strokes}; draw them apart.")
    return found


def looks_of(count: int) -> list[Look]:
    """Return how each design is drawn: of two the first one faint, of more each in a colour, the last one on top."""
    if count == 1:
        return [STRONG]
    if count == 2:
        return [FAINT, STRONG]
    tints = [style.mixed(TINTS[i % len(TINTS)], style.PAPER, 0.45 * (i // len(TINTS))) for i in range(count)]
    return [Look(level=3.0 + 10.0 * i / count, tint=tint) for i, tint in enumerate(tints)]


def what_differs(designs: Sequence[Mechanism]) -> list[str]:
    """Return each design's differences from the others: its class where these differ, and the dimensions that do."""
    titles = {machine.plan.title for machine in designs}
    common = [name for name in designs[0].dimensions if all(name in machine.dimensions for machine in designs)]
    names = [name for name in common if any(a.dimensions[name] != b.dimensions[name] for a, b in pairwise(designs))]
    found = []
    for machine in designs:
        words = [machine.plan.title] if len(titles) > 1 else []
        words += [f"{name} = {show(float(machine[name]), dimension_unit(machine, name), 5)}" for name in names[:MOST_NAMED]]
        words += [said("and {n} more", n=len(names) - MOST_NAMED)] if len(names) > MOST_NAMED else []
        found.append(", ".join(words) or said("the same design"))
    return found


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
