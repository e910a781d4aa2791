"""A mechanism's motion as plain data for the browser: everything in pixels of the drawing, y down."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import cycle
from typing import Any

import numpy as np

from ..draw import room, style
from ..draw.cylinders import THICK, WIDTH
from ..draw.grounds import support
from ..draw.labels import offsets
from ..draw.outlines import Outline
from ..draw.scene import Places, Scene
from ..draw.sliders import LONG, SLOT, hatched, width
from ..program import FloatArray

ACROSS = 760.0
LEAST, MOST = 380.0, 760.0
FONT = 15.0
RAM = ("aside", "bottom", "mouth", "rod", "least", "most")


class Pixels:
    """The drawing's frame: a scale, and where the origin stands."""

    def __init__(self, scene: Scene) -> None:
        left, right, bottom, top = scene.box()
        self.height = float(np.clip(ACROSS * (top - bottom) / (right - left), LEAST, MOST))
        self.scale = min(ACROSS / (right - left), self.height / (top - bottom))
        self.x0 = 0.5 * ACROSS - 0.5 * (left + right) * self.scale
        self.y0 = 0.5 * self.height + 0.5 * (bottom + top) * self.scale

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
            {"points": [index[name] for name in points], "fill": fill, "edge": style.mixed(fill, style.INK, 0.65)}
            for points, fill in zip(scene.hulls, cycle(style.BODIES), strict=False)
        ],
        "rams": [
            {"P": index[ram.P], "Q": index[ram.Q]} | {name: pixels.length(getattr(ram, name)) for name in RAM} for ram in scene.rams
        ],
        "straights": [
            {"P": index[each.P], "Q": index[each.Q], "lines": [stretched(line, pixels) for line in each.lines]} for each in scene.straights
        ],
        **sliding(scene, pixels, index),
        "widths": WIDTH,
        "thick": THICK,
        "stays": [[index[P], index[X]] for P, X in scene.stays],
        "pins": [index[name] for name in scene.pins],
        "dots": [index[name] for name in scene.dots],
        "grounds": grounds(scene, pixels),
        "labels": labels(scene, pixels),
        "paths": [pixels.of(scene.places[name].T) for name in paths],
    }


def stretched(line: Outline, pixels: Pixels) -> dict[str, Any]:
    """Return a line of a straight element: its rows with the ways along and across in pixels, these to the right as y points down."""
    rows = [[round(share, 4), pixels.length(along), -pixels.length(across)] for share, along, across in line.rows.tolist()]
    return {"rows": rows, "fill": line.fill.lower(), "closed": line.closed, "bold": line.bold}


def sliding(scene: Scene, pixels: Pixels, index: Mapping[str, int]) -> dict[str, Any]:
    """Return the rails, the slots and the blocks."""
    pairs = [(track, [index[name] for name in track.ends]) for track in scene.tracks]
    return {
        "slide": {"long": LONG, "slot": SLOT},
        "rails": [[pixels.of(line) for line in lines] for lines in hatched(scene)],
        "slots": [ends for track, ends in pairs if not track.fixed],
        "blocks": [
            {"rider": index[rider], "ends": ends, "half": width(track.fixed), "inside": not track.fixed}
            for track, ends in pairs
            for rider in track.riders
        ],
    }  # fmt: skip


def grounds(scene: Scene, pixels: Pixels) -> list[dict[str, Any]]:
    """Return the ground symbols: a triangle and its hatched line."""
    symbols = [support(scene.at(0)[name], way, scene.size) for name, way in room.props(scene).items()]
    return [{"triangle": pixels.of(corners), "lines": [pixels.of(line) for line in lines]} for corners, lines in symbols]


def labels(scene: Scene, pixels: Pixels) -> list[Any]:
    """Return each name's offset from its point, in the order of the names."""
    poses: list[Places] = scene.some(9)
    spots = offsets(list(scene.places), poses, room.taken(scene, poses), pixels.scale, 1.15 * pixels.length(scene.size) + 2.0, FONT)
    return [[round(float(spots[name][0]), 1), round(-float(spots[name][1]), 1)] for name in scene.places]
