"""A page that shows a mechanism move: one file, no network, driven by hand or running."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from html import escape
from importlib.resources import files
from itertools import cycle
from typing import Any, final

import numpy as np

from ..errors import DefinitionError, cited, known_name
from ..motion import Column, Motion
from ..program import FloatArray
from . import style
from .curves import axis_range, limit_of, locator, typeset
from .free_space import label_free, props
from .labels import offsets
from .scene import Piece, Places, Scene
from .shapes import DrawnLine
from .strokes import StrokeAxis, others_in_words, unreached_words
from .symbols import LONG, SLOT, THICK, WIDTH, half_width, hatched, support

COLOURS = ("INK", "MUTED", "RULE", "GRID", "PAPER", "CURVE", "ACCENT", "BARREL", "ROD", "PISTON")


def page_html(
    motion: Motion, column: Column, paths: Sequence[str] = (), limit: Sequence[Any] | None = None, *, is_turn: bool = False
) -> str:
    """Return the HTML of a page: the mechanism over a row of poses, the live curve of a column, and its controls.

    `paths` names points whose paths are drawn; `limit` is `(value [SI], text, "above" or "below")`; a full turn goes
    round, anything else there and back.
    """
    scene = Scene(motion)
    if not isinstance(column, Column):
        raise DefinitionError(f"{cited(column)} is no column; give one of machine.columns(motion).")
    if not isinstance(paths, (list, tuple)):
        raise DefinitionError(f'paths={cited(paths)}: a list of points is expected, such as ["G"].')
    for name in paths:
        known_name("Point", name, motion.plan.points, where=motion.plan.title)
    if not isinstance(is_turn, (bool, np.bool_)):
        raise DefinitionError(f"is_turn={cited(is_turn)}: say True for a full turn, else False.")
    curve = chart(motion, column, limit)
    moving = curve["stroke"]["name"]
    data = {
        "title": motion.plan.heading,
        "turn": bool(is_turn),
        "held": others_in_words(motion, moving),
        "remark": unreached_words(motion, moving),
        "reached": scene.reached,
        "scene": scenery(scene, paths),
        "chart": curve,
    }
    parts = {
        "TITLE": escape(motion.plan.heading),
        "STROKE": escape(moving),
        "COLOURS": "".join(f"--{name.lower()}:{getattr(style, name)};" for name in COLOURS),
        "CSS": page_part("player.css"),
        "JS": page_part("player.js"),
        "DATA": embedded(data),
    }
    return filled(page_part("player.html"), parts)


def page_part(name: str) -> str:
    """Return a file of this room."""
    return files(__package__).joinpath(name).read_text(encoding="utf-8")


def embedded(data: Any) -> str:
    """Return data as JSON that may stand in a script element: nothing in it ends the element or starts a comment."""
    plain = json.dumps(data, ensure_ascii=True, separators=(",", ":"), allow_nan=False)
    return plain.replace("<", "\\u003c").replace(">", "\\u003e").replace("&", "\\u0026")


def filled(template: str, parts: dict[str, str]) -> str:
    """Return a template with each `{{NAME}}` replaced once; what is put in is not looked at again."""
    pieces = template.split("{{")
    done = [pieces[0]]
    for piece in pieces[1:]:
        name, _, rest = piece.partition("}}")
        done += [parts[name], rest]
    return "".join(done)


# A mechanism's motion as plain data for the browser: everything in pixels of the drawing, y down.

ACROSS = 760.0
LEAST, MOST = 380.0, 760.0
FONT = 15.0
RAM = ("aside", "bottom", "mouth", "rod", "least", "most")


@final
class Pixels:
    """The drawing's frame: a scale, and where the origin stands."""

    def __init__(self, scene: Scene) -> None:
        left, right, bottom, top = scene.box()
        self.height = float(np.clip(ACROSS * (top - bottom) / (right - left), LEAST, MOST))
        self.scale = min(ACROSS / (right - left), self.height / (top - bottom))
        self.x0 = 0.5 * ACROSS - 0.5 * (left + right) * self.scale
        self.y0 = 0.5 * self.height + 0.5 * (bottom + top) * self.scale

    @property
    def sides(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """The least and greatest x, and y, that are seen [m]."""
        x, y = -self.x0 / self.scale, (self.y0 - self.height) / self.scale
        return (x, x + ACROSS / self.scale), (y, y + self.height / self.scale)

    def of(self, points: FloatArray) -> list[Any]:
        """Return points, shape (n, 2) [m], as pairs of pixels; None for one that is not reached."""
        flat = np.round(np.column_stack([self.x0 + self.scale * points[:, 0], self.y0 - self.scale * points[:, 1]]), 1)
        return [pair if np.isfinite(pair).all() else None for pair in flat.tolist()]

    def length(self, metres: float) -> float:
        """Return a length in pixels."""
        return round(metres * self.scale, 2)


def scenery(scene: Scene, paths: Sequence[str]) -> dict[str, Any]:
    """Return what to draw: names as indices into `names`, places for every pose."""
    pixels, names = Pixels(scene), list(scene.places)
    placed = scene.places | scene.rims
    index = {name: number for number, name in enumerate(placed)}
    return {
        "width": ACROSS,
        "height": round(pixels.height, 1),
        "size": pixels.length(scene.size),
        "names": names,
        "poses": [pixels.of(np.array([place[:, pose] for place in placed.values()])) for pose in range(scene.motion.reached.size)],
        "bodies": [
            {
                "points": [index[name] for name in plate.points],
                "shares": np.round(plate.shares, 5).tolist(),
                "fill": fill,
                "edge": style.mixed(fill, style.INK, 0.65),
            }
            for plate, fill in zip(scene.plates, cycle(style.BODIES), strict=False)
        ],
        "rams": [{"P": index[ram.P], "Q": index[ram.Q]} | {name: pixels.length(getattr(ram, name)) for name in RAM} for ram in scene.rams],
        **{
            kind: [{"P": index[each.P], "Q": index[each.Q], "lines": [stretched(line, pixels) for line in each.lines]} for each in found]
            for kind, found in (("contours", (*scene.contours, *scene.sections)), ("straights", scene.straights))
        },
        "pieces": [piece_data(piece, pixels, index) for piece in scene.surroundings],
        "marks": [piece_data(piece, pixels, index) for piece in scene.marks],
        **sliding_data(scene, pixels, index),
        "widths": WIDTH,
        "thick": THICK,
        "stays": [[index[P], index[X]] for P, X in scene.stays],
        "pins": [index[name] for name in scene.pins],
        "dots": [index[name] for name in scene.dots],
        "grounds": ground_data(scene, pixels),
        "labels": label_offsets(scene, pixels),
        "paths": [pixels.of(scene.places[name].T) for name in paths],
    }


def stretched(line: DrawnLine, pixels: Pixels) -> dict[str, Any]:
    """Return a line of a straight element: its rows with the ways along and across in pixels, these to the right as y points down."""
    rows = [[round(share, 4), pixels.length(along), -pixels.length(across)] for share, along, across in line.rows.tolist()]
    return {"rows": rows, "fill": line.fill.lower(), "closed": line.closed, "bold": line.bold}


def piece_data(piece: Piece, pixels: Pixels, index: Mapping[str, int]) -> dict[str, Any]:
    """Return what some points carry, or nothing does: its lines and hatches in its own axes, x to the second point, y downwards.

    On one point the axes keep the frame's directions; on none they begin where the frame's origin is drawn.
    """

    def turned(points: FloatArray) -> list[Any]:
        flat = [[pixels.length(x), -pixels.length(y)] for x, y in points.reshape(-1, 2).tolist()]
        return flat if points.ndim == 2 else [flat[row : row + 2] for row in range(0, len(flat), 2)]

    lines = [
        {"rows": turned(line.rows[:, 1:]), "fill": line.fill.lower(), "closed": line.closed, "bold": line.bold} for line in piece.lines
    ]
    seen = piece.hatched
    if not piece.on and len(seen):  # a line of the ground may go on far beyond the sheet
        (x0, x1), (y0, y1) = pixels.sides
        seen = seen[np.any(np.all((seen >= (x0, y0)) & (seen <= (x1, y1)), axis=2), axis=1)]
    on = {"name": piece.name, "on": [index[name] for name in piece.on], "origin": [round(pixels.x0, 1), round(pixels.y0, 1)]}
    return on | {"lines": lines, "hatches": turned(seen)}


def sliding_data(scene: Scene, pixels: Pixels, index: Mapping[str, int]) -> dict[str, Any]:
    """Return the rails, the slots and the blocks."""
    pairs = [(track, [index[name] for name in track.ends]) for track in scene.tracks]
    return {
        "slide": {"long": LONG, "slot": SLOT},
        "rails": [[pixels.of(line) for line in lines] for lines in hatched(scene)],
        "slots": [ends for track, ends in pairs if not track.fixed],
        "blocks": [
            {"rider": index[rider], "ends": ends, "half": half_width(track.fixed), "inside": not track.fixed}
            for track, ends in pairs
            for rider in track.riders
        ],
    }  # fmt: skip


def ground_data(scene: Scene, pixels: Pixels) -> list[dict[str, Any]]:
    """Return the ground symbols: a triangle and its hatched line."""
    symbols = [support(scene.at(0)[name], way, scene.size) for name, way in props(scene).items()]
    return [{"triangle": pixels.of(corners), "lines": [pixels.of(line) for line in lines]} for corners, lines in symbols]


def label_offsets(scene: Scene, pixels: Pixels) -> list[Any]:
    """Return each name's offset from its point, in the order of the names."""
    poses: list[Places] = scene.some(9)
    spots = offsets(list(scene.places), poses, label_free(scene, poses), pixels.scale, 1.15 * pixels.length(scene.size) + 2.0, FONT)
    return [[round(float(spots[name][0]), 1), round(-float(spots[name][1]), 1)] for name in scene.places]


# A curve as plain data for the browser: values, range, ticks and limit.


def chart(motion: Motion, column: Column, bound: Sequence[Any] | None) -> dict[str, Any]:
    """Return a column over the stroke that a motion runs along; None where it has no value."""
    along, limit = StrokeAxis.of(motion), None if bound is None else limit_of(bound)
    low, high = axis_range(column, limit)
    return {
        "stroke": {
            "name": along.name,
            "unit": along.unit,
            "values": seven_digits(along.values),
            "ticks": ticks(float(along.values[0]), float(along.values[-1]), along.is_turning),
        },
        "column": {"heading": typeset(column.heading), "unit": typeset(column.unit), "values": seven_digits(column.drawn)},
        "range": [low, high],
        "ticks": ticks(low, high),
        "limit": None if limit is None else {"value": limit.drawn(column), "text": limit.text, "above": limit.fails == "above"},
    }


def seven_digits(values: FloatArray) -> list[float | None]:
    """Return values to seven digits; None for one that is not finite."""
    return [float(f"{value:.7g}") if np.isfinite(value) else None for value in values.tolist()]


def ticks(low: float, high: float, turning: bool = False) -> list[float]:
    """Return round values between two ends."""
    low, high = min(low, high), max(low, high)
    found = locator(turning).tick_values(low, high)
    return [float(f"{value:.10g}") for value in found if low <= value <= high]
