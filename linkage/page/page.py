"""A page that shows a mechanism move: one file, no network, driven by hand or running."""

from __future__ import annotations

import json
from collections.abc import Sequence
from html import escape
from importlib.resources import files
from typing import Any

import numpy as np

from ..draw import strokes, style
from ..draw.scene import Scene
from ..errors import DefinitionError, cited, known_name
from ..motion import Column, Motion
from .chart import chart
from .scenery import scenery

COLOURS = ("INK", "MUTED", "RULE", "GRID", "PAPER", "CURVE", "ACCENT", "BARREL", "ROD", "PISTON")


def page(motion: Motion, column: Column, paths: Sequence[str] = (), limit: Sequence[Any] | None = None, *, is_turn: bool = False) -> str:
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
        "held": strokes.held(motion.plan, motion.strokes, moving),
        "remark": strokes.unreached(motion, moving),
        "reached": scene.reached,
        "scene": scenery(scene, paths),
        "chart": curve,
    }
    parts = {
        "TITLE": escape(motion.plan.heading),
        "STROKE": escape(moving),
        "COLOURS": "".join(f"--{name.lower()}:{getattr(style, name)};" for name in COLOURS),
        "CSS": text("player.css"),
        "JS": text("player.js"),
        "DATA": embedded(data),
    }
    return filled(text("player.html"), parts)


def text(name: str) -> str:
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
