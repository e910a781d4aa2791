"""Several designs of a mechanism over one another, with their differences."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from matplotlib.patches import Polygon

from ..errors import ensure
from ..language import said
from ..mechanism import Mechanism, require_mechanism
from ..reports import Run, dimension_unit, first_stroke, stroke_middles
from ..units import show
from . import style
from .drawing import Drawing
from .layout import cloud, joined_box
from .overlays import sheet_note
from .pose_choice import telling_angles
from .poses import motions, trace
from .scene import Scene
from .sheet import empty_page, legend_row, look_keys, write_title
from .shown_values import named_points
from .strokes import is_turn, stroke_words
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
                let_through(drawing)
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


def let_through(drawing: Drawing) -> None:
    """Let a drawing's faces be seen through, so that others under it show."""
    for artist in drawing.artists:
        if isinstance(artist, Polygon) and artist.get_fill():
            artist.set_alpha(None)
            artist.set_facecolor((*to_rgb(artist.get_facecolor()), 0.12))


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
