"""A drawing of a mechanism in true size, millimetres: its lines, circles and words by layers, as SVG and as DXF (R2010).

Centre lines run from pin to pin. A body's outline goes around its outermost pins at a distance, its corners true arcs.
"""

from __future__ import annotations

import io
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import combinations
from math import copysign, hypot
from types import MappingProxyType
from typing import Any
from xml.sax.saxutils import escape, quoteattr

import numpy as np

from ..errors import known_name
from ..frozen import immutable
from ..loads import PinFriction
from ..motion import Motion
from ..pictures.layout import half_of, label_free, offsets, props
from ..pictures.scene import DrawnMark, Places, Scene
from ..pictures.shapes import left_of, polar, segment
from ..program import FloatArray
from ..quantities import body_name, joined_names
from ..units import mm
from .extras import library

LAYERS: Mapping[str, tuple[int, str]] = MappingProxyType(
    {
        "frame": (8, "#6B7785"),
        "bodies": (5, "#1F5FA8"),
        "centre_lines": (1, "#C0392B"),
        "cylinders": (3, "#2E7D4F"),
        "elements": (30, "#B8660B"),
        "pins": (7, "#1F2933"),
        "paths": (6, "#8E44AD"),
        "text": (7, "#1F2933"),
        "dimensions": (4, "#0E7C86"),
    }
)
"""The layers, each with its colour by the index of CAD programs, and as a page shows it."""
ROUND = 0.9
"""The distance of an outline from its pins, in sizes of the picture."""
STAND_OFF, HEIGHT = 3.2, 1.3
"""How far a dimension's line stands from what it measures, and the height of its letters, in sizes."""
PIN = 0.5
"""The radius of a pin whose bearing is not declared, in sizes."""


@immutable
class Polyline:
    """A line through vertices, shape (n, 2) [mm]; `arcs` are the tangents of a quarter of the arcs that follow each, 0 straight."""

    layer: str
    name: str
    vertices: FloatArray
    arcs: tuple[float, ...] = ()
    closed: bool = False

    @property
    def bulges(self) -> tuple[float, ...]:
        """The tangent of a quarter of the arc that follows each vertex."""
        return self.arcs or (0.0,) * len(self.vertices)


@immutable
class Circle:
    """A circle [mm]."""

    layer: str
    name: str
    centre: FloatArray
    radius: float


@immutable
class Lettering:
    """A text whose lower left corner stands at a place, with its height [mm]."""

    layer: str
    name: str
    place: FloatArray
    text: str
    height: float


@immutable
class Measured:
    """The distance of two places [mm] with the name of the dimension, its line so far to the left, its letters so high [mm]."""

    layer: str
    name: str
    start: FloatArray
    end: FloatArray
    aside: float
    height: float


Part = Polyline | Circle | Lettering | Measured
DrawnPose = tuple[str, Sequence[Part]]
"""A pose in words, and the parts of the mechanism there."""


def pose_parts(motion: Motion, pose: int) -> Iterator[Part]:
    """Yield the parts of a mechanism at a pose of a motion, by its flat index. DefinitionError for a batch of designs."""
    scene = Scene(motion)
    there = scene.at(pose)
    at, size = {name: place / mm for name, place in there.items()}, scene.size / mm
    for name, way in props(scene).items():  # a triangle on the side of each pin on the frame where pictures have it, then the tracks
        along, across = polar(way), left_of(polar(way))
        feet = (at[name] + size * (3.2 * along + aside * across) for aside in (-1.9, 1.9))
        yield Polyline("frame", name, np.array([at[name], *feet]), closed=True)
    for track in scene.tracks:
        yield Polyline("frame" if track.fixed else "bodies", track.name, np.array([at[name] for name in track.ends]))
    yield from mark_parts("bodies", scene.blocks, there)
    bodies = sorted(zip(scene.hulls, scene.bodies, strict=True), key=lambda each: len(each[0]) < 3)  # bars lie on plates
    for corners, points in bodies:  # an outline, and centre lines from pin to pin
        name, places = body_name(points), np.array([at[point] for point in corners])
        yield outline_around(name, places, ROUND * size)
        if len(corners) > 1:
            yield Polyline("centre_lines", name, places, closed=len(corners) > 2)
    for P, X in scene.stays:
        yield Polyline("centre_lines", joined_names(P, X), np.array([at[P], at[X]]))
    for cylinder in scene.cylinders:
        mark = cylinder.mark(scene.size)
        yield from mark_parts("cylinders", [mark], there)
        ends = mark.placed(np.array([[0.0, cylinder.aside], [mark.axes(there)[2], cylinder.aside]]), there)
        yield Polyline("centre_lines", mark.name, ends / mm)
    yield from mark_parts("elements", scene.straights, there)
    bearings = {str(getattr(each.point, "name", each.point)): each for each in motion.plan.of_kind(PinFriction).values()}
    for name in motion.plan.points:  # pins of their bearing's radius where friction declares one; other points are small
        declared = float(np.ravel(bearings[name].number(motion, "radius"))[0]) / mm if name in bearings else 0.0
        yield Circle("pins", name, at[name], declared or (PIN if name in scene.pins else 0.5 * PIN) * size)
    crowd = label_free(scene, [there])[0]
    font = 1.6 * size
    spots = offsets([*motion.plan.points], [there] * 2, [crowd] * 2, 1.0 / mm, 1.2 * size, font)  # as of two poses: near
    for name, spot in spots.items():
        half = half_of(name, font)
        crowd = np.concatenate([crowd, mm * (at[name] + spot + half * [[-1.0, 0.0], [-0.5, 0.0], [0.0, 0.0], [0.5, 0.0], [1.0, 0.0]])])
        yield Lettering("text", name, at[name] + spot - half * [1.0, 0.75], name, font)
    yield from dimension_parts(scene, at, size, crowd / mm)


def path_parts(motion: Motion, points: Sequence[str]) -> tuple[Part, ...]:
    """Return the paths of points over a motion, where they are reached. DefinitionError for an unknown name."""
    found = []
    for name in points:
        known_name("Point", name, motion.plan.points, where=motion.plan.title)
        path = motion[name].reshape(2, -1).T / mm
        found.append(Polyline("paths", name, path[np.isfinite(path).all(axis=1)]))
    return tuple(found)


def outline_around(name: str, corners: FloatArray, distance: float) -> Polyline:
    """Return the line around a convex polygon at a distance [mm], its corners arcs; `corners`, shape (k, 2), counter-clockwise."""
    along = np.roll(corners, -1, axis=0) - corners
    along = along / np.hypot(*along.T)[:, None]
    out = distance * np.column_stack([along[:, 1], -along[:, 0]])
    before = np.roll(out, 1, axis=0)
    swing = np.arctan2(before[:, 0] * out[:, 1] - before[:, 1] * out[:, 0], (before * out).sum(axis=1)) % (2.0 * np.pi)
    vertices = np.stack([corners + before, corners + out], axis=1).reshape(-1, 2)
    bulges = np.column_stack([np.tan(swing / 4.0), np.zeros(len(corners))]).ravel()
    return Polyline("bodies", name, vertices, tuple(bulges.tolist()), closed=True)


def mark_parts(layer: str, marks: Iterable[DrawnMark], at: Places) -> Iterator[Part]:
    """Yield the lines of marks at the places of their points [m]."""
    for mark in marks:
        for line, drawn in zip(mark.lines, mark.drawn(at), strict=True):
            yield Polyline(layer, mark.name, drawn / mm, closed=line.closed)


def dimension_parts(scene: Scene, at: Places, size: float, crowd: FloatArray) -> Iterator[Part]:
    """Yield the lengths that a label gives, each once, read from the left, its line and its text where least of a crowd [mm] stands."""
    labelled = scene.motion.plan.table.lengths
    pairs = [each for each in combinations(scene.motion.plan.points, 2) if frozenset(each) in labelled]
    ways = [side * (1.0 + 0.75 * step) * STAND_OFF * size for step in range(6) for side in (1.0, -1.0)]
    for P, Q in sorted(pairs, key=lambda pair: float(np.hypot(*(at[pair[1]] - at[pair[0]])))):
        name, (start, end) = getattr(labelled[frozenset((P, Q))], "variable", body_name((P, Q))), sorted((at[P], at[Q]), key=tuple)
        if not np.hypot(*(end - start)) > 0.0:
            continue
        along, high = (end - start) / np.hypot(*(end - start)), HEIGHT * size
        half, middle = 0.35 * high * len(f"{name} = 1234.5") * along, 0.5 * (start + end) + 1.1 * high * left_of(along)
        row = [segment(start, end, size), segment(middle - half, middle + half, 0.5 * size)]
        tried = [[points + way * left_of(along) for points in row] for way in ways]
        near = [[np.mean((np.hypot(*(each[:, None] - crowd).T) < high).any(axis=0)) for each in rows] for rows in tried]
        place = int(np.argmin(np.array(near) @ [1.0, 3.0] + 0.03 * np.arange(len(ways))))
        crowd = np.concatenate([crowd, *tried[place]])
        yield Measured("dimensions", name, start, end, ways[place], high)


# SVG: words as words, a group for each pose and layer, parts by their members' names.

PAGE_MARGIN = 0.05
"""Room around the drawing, as a share of its greater side."""
STROKE = 0.0022
"""The width of a line, as a share of the drawing's greater side."""
FILLS = {"bodies": "#DCE8F5", "cylinders": "#DDEFE4", "frame": "#EEF1F4", "pins": "#FFFFFF"}


def svg(poses: Sequence[DrawnPose], paths: Sequence[Part], title: str) -> bytes:
    """Return the bytes of an .svg file of poses, each in words and its parts, and of paths."""
    drawn = [(f"pose{number}", *pose) for number, pose in enumerate(poses, 1)] + [("paths", "paths", paths)]
    corners = np.concatenate([reach(part) for _, _, parts in drawn for part in parts])
    (left, bottom), (right, top) = corners.min(axis=0), corners.max(axis=0)
    greater = max(right - left, top - bottom)
    pad, line = PAGE_MARGIN * greater, STROKE * greater
    wide, high = right - left + 2.0 * pad, top - bottom + 2.0 * pad
    dashes = " ".join(f"{share * line:.3f}" for share in (5.0, 1.5, 1.0, 1.5))
    head = [
        '<?xml version="1.0" encoding="UTF-8"?>',
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{wide:.3f}mm" height="{high:.3f}mm" '
        f'viewBox="{left - pad:.3f} {-top - pad:.3f} {wide:.3f} {high:.3f}" role="img">',
        f"<title>{escape(title)}</title>",
        f"<style>.centre_lines {{ stroke-dasharray: {dashes} }} .text {{ stroke: none }}</style>",
        f'<g fill="none" stroke-width="{line:.3f}" stroke-linejoin="round" font-family="sans-serif">',
    ]
    groups = []
    for place, (key, words, parts) in enumerate(drawn):
        look = ' opacity="0.45"' if place and key != "paths" else ""
        groups += [f"<g id={quoteattr(key)}{look}>", f"<title>{escape(words)}</title>"]
        for layer, (_, colour) in LAYERS.items():
            own = [svg_element(each, colour) for each in parts if each.layer == layer and layer != "dimensions"]
            if own:
                fill, share = FILLS.get(layer, "none"), 0.6 if layer in FILLS else 1.0
                groups += [f'<g class={quoteattr(layer)} stroke="{colour}" fill="{fill}" style="fill-opacity: {share}">', *own, "</g>"]
        groups.append("</g>")
    return "\n".join([*head, *groups, "</g>", "</svg>", ""]).encode()


def svg_element(part: Part, colour: str) -> str:
    """Return one part; y goes down on a page."""
    name = f"data-name={quoteattr(part.name)}"
    match part:
        case Circle():
            x, y = part.centre
            return f'<circle {name} cx="{svg_number(x)}" cy="{svg_number(-y)}" r="{svg_number(part.radius)}"/>'
        case Lettering():
            x, y = map(svg_number, part.place * np.array([1.0, -1.0]))
            size = svg_number(part.height)
            return f'<text {name} x="{x}" y="{y}" font-size="{size}" fill="{colour}">{escape(part.text)}</text>'
        case Polyline():
            text = "M" + xy(part.vertices[0])
            following = np.roll(part.vertices, -1, axis=0) if part.closed else part.vertices[1:]
            for start, end, bulge in zip(part.vertices, following, part.bulges, strict=False):
                if bulge == 0.0:
                    text += f" L{xy(end)}"
                else:
                    radius = svg_number(hypot(*(end - start)) * (1.0 + bulge * bulge) / (4.0 * abs(bulge)))
                    text += f" A{radius} {radius} 0 {int(abs(bulge) > 1.0)} {int(copysign(1.0, bulge) < 0.0)} {xy(end)}"
            text += " Z" if part.closed else ""
            open_line = "" if part.closed else ' fill="none"'
            return f'<path {name} d="{text}"{open_line}/>'
        case Measured():
            return ""


def xy(point: FloatArray) -> str:
    """Return a place as text; y goes down on a page."""
    return f"{svg_number(point[0])} {svg_number(-point[1])}"


def svg_number(value: float) -> str:
    """Return a length [mm] as text, to a millionth of a millimetre, without a minus before zero."""
    return f"{value:z.6f}".rstrip("0").rstrip(".")


def reach(part: Part) -> FloatArray:
    """Return corners of the area that a part covers, shape (n, 2) [mm]."""
    match part:
        case Polyline():
            return part.vertices
        case Circle():
            return np.array([part.centre - part.radius, part.centre + part.radius])
        case Lettering():
            return np.array([part.place, part.place + part.height * np.array([0.7 * len(part.text), 1.0])])
        case Measured():
            return np.array([part.start, part.end])


# DXF: with several poses each of them has layers of its own.

MILLIMETRES = 4
"""What $INSUNITS says."""


def dxf(poses: Sequence[DrawnPose], paths: Sequence[Part], title: str) -> bytes:
    """Return the bytes of a .dxf file; DefinitionError where ezdxf is not installed.

    Of several poses the first has the plain layers, the others `pose2_bodies` and so on. The format has no place for a title.
    """
    document = library("ezdxf", "cad", "a .dxf").new("R2010", setup=["linetypes", "styles", "dimstyles"])
    document.header["$INSUNITS"] = MILLIMETRES
    document.header["$MEASUREMENT"] = 1
    document.header["$LUNITS"] = 2
    space = document.modelspace()
    for number, parts in enumerate([*(parts for _, parts in poses), paths], 1):
        prefix = f"pose{number}_" if 1 < number <= len(poses) else ""
        for part in parts:
            draw_part(document, space, part, f"{prefix}{part.layer}")
    stream = io.StringIO()
    document.write(stream)
    return stream.getvalue().encode("utf-8")


def draw_part(document: Any, space: Any, part: Part, layer: str) -> None:
    """Put one part into a layer, which is made where it is new."""
    if layer not in document.layers:
        made = document.layers.add(layer, color=LAYERS[part.layer][0])
        if part.layer == "centre_lines":
            made.dxf.linetype = "CENTER"
    look = {"layer": layer}
    match part:
        case Polyline():
            rows = [(float(x), float(y), bulge) for (x, y), bulge in zip(part.vertices, part.bulges, strict=True)]
            space.add_lwpolyline(rows, format="xyb", close=part.closed, dxfattribs=look)
        case Circle():
            space.add_circle(tuple(map(float, part.centre)), part.radius, dxfattribs=look)
        case Lettering():
            place = tuple(map(float, part.place))
            space.add_text(part.text, height=part.height, dxfattribs={**look, "insert": place, "style": "OpenSans"})
        case Measured():
            high = part.height
            style = {"dimtxt": high, "dimasz": high, "dimexe": 0.5 * high, "dimexo": 0.5 * high, "dimgap": 0.4 * high}
            style |= {"dimtad": 1, "dimdec": 1, "dimlfac": 1.0, "dimclrd": 256, "dimclre": 256, "dimclrt": 256}
            ends = tuple(map(float, part.start)), tuple(map(float, part.end))
            space.add_aligned_dim(*ends, distance=part.aside, override=style, dxfattribs=look, text=f"{part.name} = <>").render()
