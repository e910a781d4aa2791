"""A drawing in true size, millimetres: as SVG, a group for each pose and layer; as DXF (R2010), a layer for each kind of part."""

from __future__ import annotations

import io
from collections.abc import Sequence
from math import copysign, hypot
from typing import Any
from xml.sax.saxutils import escape, quoteattr

import numpy as np

from ..program import FloatArray
from .extras import library
from .geometry import LAYERS, Circle, DrawnPose, Lettering, Measured, Part, Polyline

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
    groups = [pose_group(*each, faint=place > 0 and each[0] != "paths") for place, each in enumerate(drawn)]
    return "\n".join([*head, *groups, "</g>", "</svg>", ""]).encode()


def pose_group(key: str, title: str, parts: Sequence[Part], faint: bool) -> str:
    """Return the parts of one pose, a group a layer."""
    inside = []
    for layer, (_, colour) in LAYERS.items():
        own = [each for each in parts if each.layer == layer and layer != "dimensions"]
        if own:
            fill, share = FILLS.get(layer, "none"), 0.6 if layer in FILLS else 1.0
            inside.append(f'<g class={quoteattr(layer)} stroke="{colour}" fill="{fill}" style="fill-opacity: {share}">')
            inside += [svg_element(each, colour) for each in own]
            inside.append("</g>")
    look = ' opacity="0.45"' if faint else ""
    return "\n".join([f"<g id={quoteattr(key)}{look}>", f"<title>{escape(title)}</title>", *inside, "</g>"])


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
            open_line = "" if part.closed else ' fill="none"'
            return f'<path {name} d="{path_text(part)}"{open_line}/>'
        case Measured():
            return ""


def path_text(part: Polyline) -> str:
    """Return a line's commands, bulges as arcs."""
    text = "M" + xy(part.vertices[0])
    following = np.roll(part.vertices, -1, axis=0) if part.closed else part.vertices[1:]
    for start, end, bulge in zip(part.vertices, following, part.bulges, strict=False):
        if bulge == 0.0:
            text += f" L{xy(end)}"
        else:
            radius = hypot(*(end - start)) * (1.0 + bulge * bulge) / (4.0 * abs(bulge))
            text += f" A{svg_number(radius)} {svg_number(radius)} 0 {int(abs(bulge) > 1.0)} {int(copysign(1.0, bulge) < 0.0)} {xy(end)}"
    return text + (" Z" if part.closed else "")


def xy(point: FloatArray) -> str:
    """Return a place as text; y goes down on a page."""
    return f"{svg_number(point[0])} {svg_number(-point[1])}"


def svg_number(value: float) -> str:
    """Return a length [mm] as text, to a millionth of a millimetre, without a minus before zero."""
    return f"{value:z.6f}".rstrip("0").rstrip(".")


def reach(part: Part) -> FloatArray:
    """Return corners of what a part covers, shape (n, 2) [mm]."""
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
