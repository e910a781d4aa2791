"""A drawing as DXF (R2010): millimetres, a layer for each kind of part, and with several poses for each of them its own."""

from __future__ import annotations

import io
from collections.abc import Sequence
from typing import Any

from .extras import missing_extra
from .geometry import LAYERS, Circle, DrawnPose, Lettering, Measured, Part, Polyline

MILLIMETRES = 4
"""What $INSUNITS says."""


def dxf(poses: Sequence[DrawnPose], paths: Sequence[Part], title: str) -> bytes:
    """Return the bytes of a .dxf file; DefinitionError where ezdxf is not installed.

    Of several poses the first has the plain layers, the others `pose2_bodies` and so on. The format has no place for a title.
    """
    try:
        import ezdxf
    except ImportError:
        raise missing_extra("cad", "a .dxf", "ezdxf") from None
    document = ezdxf.new("R2010", setup=["linetypes", "styles", "dimstyles"])  # type: ignore[attr-defined]
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
