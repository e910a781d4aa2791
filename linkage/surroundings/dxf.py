"""The lines of a DXF drawing, read with ezdxf (extra `cad`)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import islice
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from ..errors import DefinitionError, FileError

MOST = 20_000
"""Corners that are drawn of a drawing, and lines that are looked at; more do not fit into a picture."""
LARGEST, SMALLEST = 1e12, 1e-9
"""The largest coordinate of a drawing [its units], and the least size of it beside its largest coordinate, that can be drawn."""
DEEP = 16
"""How deep blocks may stand in blocks."""


def dxf_lines(path: str, layers: Sequence[str] = ()) -> list[npt.NDArray[np.float64]]:
    """Return the lines of a drawing's model space, shape (n, 2) each, in the drawing's units, curves by short chords.

    FileError where the file cannot be read; DefinitionError without ezdxf, or where no line is on the layers named.
    """
    try:
        from ezdxf import filemanagement, lldxf
        from ezdxf import path as curves
    except ImportError:
        raise DefinitionError(f"{path}: drawings are read with ezdxf; install it by pip install hydrolinkage[cad].") from None
    if not Path(path).is_file():
        raise FileError(f"{path}: there is no such file; give the path from where the program runs, or a whole one.")
    try:
        space = filemanagement.readfile(path).modelspace()
    except (OSError, lldxf.const.DXFError) as error:
        raise FileError(f"{path} is no DXF drawing that can be read: {error}") from error
    every = list(islice(unblocked(space, path), MOST + 1))
    if len(every) > MOST:
        raise DefinitionError(f"{path}: its blocks, inserted, are more than {MOST} lines, which no picture shows; take some of them out.")
    every = [each for each in every if each.dxftype() != "INSERT"]
    entities = [each for each in every if not layers or each.dxf.layer in layers]
    paths = list(drawable(entities, curves, path))
    distance = 1e-3 * span_of(paths, path)  # no farther from curves; up to one corner more than can be drawn
    corners = ([(each.x, each.y) for each in islice(one.flattening(distance), MOST + 1)] for one in paths)
    found = [np.array(each, float) for each in corners if len(each) > 1]
    if not found:
        on = f" on {', '.join(layers)}; its layers: {', '.join(sorted({each.dxf.layer for each in every}))}" if layers else ""
        raise DefinitionError(f"{path}: there is no line{on}.")
    if sum(map(len, found)) > MOST:
        raise DefinitionError(f"{path}: {sum(map(len, found))} corners are more than a picture shows, {MOST}; name the layers to take.")
    return found


def unblocked(space: Any, path: str, around: tuple[str, ...] = ()) -> Iterator[Any]:
    """Yield the entities of a space, inserted blocks and what is in them; FileError for one that stands in itself, or too deep in others.

    `around` names the blocks that the space stands in, from the outermost one.
    """
    for each in space:
        yield each
        if each.dxftype() != "INSERT":
            continue
        name = str(each.dxf.name)
        if name in around:
            raise FileError(f"{path}: the block {name} inserts itself ({' > '.join([*around, name])}); mend the drawing.")
        if len(around) == DEEP:
            raise FileError(f"{path}: blocks stand in blocks more than {DEEP} deep, {' > '.join(around[:3])} > ...; explode some of them.")
        yield from unblocked(each.virtual_entities(), path, (*around, name))


def drawable(entities: Sequence[Any], curves: Any, path: str) -> Iterator[Any]:
    """Yield the paths of the entities that are lines or curves; DefinitionError for one whose sizes cannot be drawn."""
    for each in entities:
        try:
            with np.errstate(all="ignore"):
                yield curves.make_path(each)
        except TypeError:
            continue
        except (ArithmeticError, ValueError) as error:
            remedy = f"its sizes cannot be drawn, up to {LARGEST:.0e} are; take it out, or draw in a larger unit"
            raise DefinitionError(f"{path}: {each.dxftype()}: {str(error).rstrip('.')}: {remedy}.") from error


def span_of(paths: Sequence[Any], path: str) -> float:
    """Return the larger side of the box around some paths; 1 where there is none. DefinitionError for one that cannot be drawn."""
    places = np.array([(each.x, each.y) for one in paths for each in one.control_vertices()] or [(0.0, 0.0), (1.0, 0.0)])
    largest = float(np.max(np.abs(places)))
    if not largest <= LARGEST:
        size = f"{largest:.3g}" if np.isfinite(largest) else "no finite number"
        what = f"{path}: a coordinate of it is {size}, and up to {LARGEST:.0e} are drawn"
        raise DefinitionError(f"{what}; take that line out, or draw in a larger unit.")
    span = float(np.ptp(places, axis=0).max()) or 1.0
    if span < SMALLEST * largest:
        what = f"{path}: it is {span:.3g} wide and stands {largest:.3g} away from its origin, which leaves no digits"
        raise DefinitionError(f"{what}; move the drawing to its origin.")
    return span
