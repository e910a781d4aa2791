"""The door to files of other programs: which one wrote a file, and its sketch; and a sketch as the text of such a file."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from math import dist, isfinite
from pathlib import Path
from types import MappingProxyType

from ..disk import Place, read
from ..errors import FileError, cited, ensure, is_number, unknown
from ..files.source import FILE_BYTES, decoded, text_of
from ..quantities import joined_names
from ..units import show
from .board_json import ADDRESS, board_json, read_board
from .dxf_layers import read_dxf
from .found import WORDS, FoundDrive, FoundMachine, JsonTable, printable
from .linkage_xml import linkage_xml, read_linkage_xml
from .machine_sketch import MachineSketch
from .pmks_plus import (
    ENVELOPE,
    SHORT,
    address_text,
    json_in_address,
    read_old_address,
    read_plus_bodies,
    read_plus_json,
    read_short_address,
)
from .pmks_text import pmks_text, read_pmks_text
from .points_csv import points_csv, read_points_csv
from .pylinkage_json import read_pylinkage

SUFFIXES = ".csv", ".linkage2", ".txt", ".pmks", ".json", ".dxf"
DRAWING_BYTES = 20_000_000
WEB = re.compile(r"\s*(?:https?:|[\w.]*pmksplus\.com\b)", re.IGNORECASE)
"""How an address in the web begins, whether or not it is whole."""


def read_sketch(
    file: Place,
    *,
    scale: float | None = None,
    drives: Sequence[Sequence[str | float]] = (),
    cylinders: Sequence[Sequence[str | float]] = (),
    layers: Mapping[str, Sequence[str]] = MappingProxyType({}),
) -> MachineSketch:
    """Return the sketch that a file of another program holds, or a share address.

    Parameters
    ----------
    file : str or path
        A table of points (.csv), a file of Linkage (.linkage2), PMKS (.txt), the board, PMKS+ or pylinkage (.json), a drawing (.dxf);
        or the text of a share address of PMKS or PMKS+.
    scale : float, optional
        What 1 of the file is [m]. By default as the file says.
    drives, cylinders : sequence of (str, str), optional
        What drives in place of what the file says: the fixed pin and a pin of each crank, the two ends of each cylinder. Behind them how
        far it goes from the drawn pose [rad or m], ("A", "B", 0.3), or back and forwards, ("A", "B", -0.02, 0.3); of a cylinder also its
        lengths from pin to pin, ("A", "B", 0.9, 1.4).
    layers : mapping of str to sequence of str, optional
        Of a drawing the layers of its pins, links, ground, slides, crank and cylinder.

    Returns
    -------
    MachineSketch
        The sketch; its notes say what was named anew, moved or left out. It may lack a drive, which `to_class` refuses.

    Raises
    ------
    FileError
        The file cannot be read, is damaged, has no unit, or holds what cannot be: where, and the remedy.
    DefinitionError
        A point that is named is not there, or how far it goes does not fit the drawing.
    """
    found, title = content_of(file, layers)
    is_drawing = str(file).lower().endswith(".dxf")
    ensure(is_drawing or not layers, f"{found.file}: --layer {', '.join(layers)}: only a drawing, .dxf, has layers; leave it out.")
    if scale is not None:
        ensure(found.board_sketch is None, f"{found.file}: a drawing of the board is in metres; leave out the scale.")
        ensure(isfinite(scale) and scale > 0.0, f"{found.file}: the scale is {scale!r}; say what 1 of the file is, such as 1mm.")
        found.unit = scale
    asked = [*(("crank", ends) for ends in drives), *(("cylinder", ends) for ends in cylinders)]
    if asked:
        found.drives = []
        for kind, ends in asked:
            add_drive(found, kind, ends)
    drawn = found.board_sketch
    if drawn is None or not asked:
        return drawn or found.sketch(title)
    links = {name: tuple(points) for name, points in found.links}
    taken = {*WORDS, *drawn.points, *links, *drawn.slides, *drawn.weights}
    named = dict(found.named_drives({name: name for name in drawn.points}, drawn.points, taken))
    closed = {joined_names(*ends) for each in named.values() if each.kind == "cylinder" for ends in (each.ends, each.ends[::-1])}
    lengths = {label: length for label, length in drawn.lengths.items() if label not in closed}  # cylinders are as long as drawn
    return replace(drawn, links=links, drives=named, lengths=lengths, notes=(*drawn.notes, *map(printable, found.notes)))


def is_foreign(text: str) -> bool:
    """Return whether a text names a file of another program, or is a share address; a file in JSON is looked into."""
    if is_address(text):
        return True
    path = Path(text)
    if path.suffix.lower() != ".json":
        return path.suffix.lower() in SUFFIXES
    data = decoded(path.name, read(path, FILE_BYTES + 1), True).data
    return isinstance(data, dict) and json_reader(data) is not None


def is_address(text: str) -> bool:
    """Return whether a text is a share address, or the part behind its ?."""
    query = address_text(text)
    begins = WEB.match(text), SHORT.match(query), re.match(r"j=[^&]*&l=", query)
    return text.startswith(ENVELOPE) or text.rpartition("#")[2].startswith(ADDRESS) or any(begins)


def content_of(file: Place, layers: Mapping[str, Sequence[str]]) -> tuple[FoundMachine, str]:
    """Return the machine in a file or a share address, and a name for it."""
    text = str(file)
    if is_address(text):
        found = FoundMachine("the address")
        read_address(found, text)
        return found, found.board_sketch.name if found.board_sketch else "Shared"
    path = Path(file)
    suffix = path.suffix.lower()
    if suffix not in SUFFIXES:
        raise FileError(f"{cited(text, quote=False)}: the name of a file to import ends in one of {', '.join(SUFFIXES)}.")
    found, title = FoundMachine(path.name), "".join(word[:1].upper() + word[1:] for word in re.findall(r"[^\W_]+", path.stem))
    if suffix == ".dxf":
        read(path, most=0)  # a file that is not there is named in words
        is_small = path.stat().st_size <= DRAWING_BYTES
        found.ensure(is_small, f"the drawing is larger than {DRAWING_BYTES / 1e6:g} MB; save the machine by itself.")
        read_dxf(found, str(path), layers)
        return found, title
    raw = read(path, FILE_BYTES + 1)
    if suffix == ".json":
        read_json(found, decoded(path.name, raw, True).data)
        return found, found.board_sketch.name if found.board_sketch else title
    found.ensure(len(raw) <= FILE_BYTES, f"the file is larger than {FILE_BYTES / 1e6:g} MB; a machine is a few kB.")
    content = text_of(raw)
    found.ensure(content.strip(), "the file is empty.")
    found.ensure("\0" not in content, "the file is no text.")
    readers: dict[str, Callable[[FoundMachine, str], None]] = {".csv": read_points_csv, ".linkage2": read_linkage_xml}
    reader = read_address if is_address(content.strip()) else readers.get(suffix, read_pmks_text)
    reader(found, content.strip())
    return found, title


def read_address(found: FoundMachine, text: str) -> None:
    """Read a share address."""
    found.ensure(len(text) <= FILE_BYTES, f"it is longer than {FILE_BYTES} characters.")
    query = address_text(text.strip())
    if ADDRESS in text:
        read_json(found, address_data(found, found.unpacked(text.rpartition(ADDRESS)[2].strip())))
    elif text.startswith(ENVELOPE):
        read_json(found, address_data(found, json_in_address(found, text)))
    elif re.match(r"j=", query):
        read_old_address(found, query)
    elif "mech=" in query:
        read_pmks_text(found, query.partition("mech=")[2].partition("&")[0])
    else:
        holds = query if WEB.match(query) is None else ""
        found.ensure(holds, "there is no machine behind the address; copy it whole, with what stands behind its ?.")
        found.ensure(SHORT.match(query), f"the address is damaged behind its ?, {cited(query)}; copy it whole.")
        read_short_address(found, query)


def address_data(found: FoundMachine, raw: bytes) -> object:
    """Return the data in the JSON of an address; FileError where it is cut short or otherwise none."""
    try:
        return decoded(found.file, raw, True).data
    except FileError as error:
        raise FileError(f"{found.file}: the address is damaged; copy it whole.") from error


def json_reader(data: JsonTable) -> Callable[[FoundMachine, JsonTable], None] | None:
    """Return the reader of a JSON file by its keys; None where no known program writes these."""
    if "board" in data and "points" in data:
        return read_board
    if data.get("version") == 2 and "bodies" in data and "attachments" in data:
        return read_plus_bodies
    if "j" in data and "l" in data:
        return read_plus_json
    return read_pylinkage if isinstance(data.get("joints"), list) else None


def read_json(found: FoundMachine, data: object) -> None:
    """Read a JSON file of the program whose keys it has."""
    reader = json_reader(data) if isinstance(data, dict) else None
    if reader is None:
        raise FileError(
            f'{found.file}: it is no drawing of the board ("board" and "points"), no machine of PMKS+ ("j" and "l", or version 2 with '
            '"bodies") and none of pylinkage ("joints").'
        )
    reader(found, data)  # type: ignore[arg-type]


def add_drive(found: FoundMachine, kind: str, named: Sequence[str | float]) -> None:
    """Enter a drive that is asked for, how far it goes behind its ends.

    DefinitionError for a crank whose pivot is not fixed, or that no link joins to its pin, and for amounts that do not fit.
    """
    ends, amounts = [each for each in named if isinstance(each, str)], [each for each in named if not isinstance(each, str)]
    keys = {name: key for key, point in reversed(found.points.items()) for name in (point.name, key)}
    for name in ends:
        if name not in keys:
            raise unknown("Point", name, [point.name for point in found.points.values()], where=found.file)
    P, Q = (keys[name] for name in ends)
    names = found.points[P].name, found.points[Q].name
    if kind == "crank":
        what, fixed = f"{found.file}: --drive {' '.join(names)}", ", ".join(point.name for point in found.points.values() if point.fixed)
        ensure(found.points[P].fixed, f"{what}: {names[0]} is not fixed; a crank turns about a fixed pin: {fixed}.")
        is_joined = any({P, Q} <= {*points} for _, points in found.links)
        ensure(is_joined, f"{what}: no link joins {names[0]} and {names[1]}; name a pin of the link that turns.")
    what = f"{found.file}: the {kind} {' '.join(names)}"
    ensure(len(amounts) < 3 and all(map(is_number, amounts)), f"{what} goes {amounts}; give how far, or back and forwards.")
    start, *end = amounts if len(amounts) > 1 else (0.0, *amounts)
    drawn = 0.0
    if kind == "cylinder" and start > 0.0 and found.unit is not None:  # from pin to pin
        drawn = dist(found.points[P].place, found.points[Q].place) * found.unit - start
        lengths = f"{show(drawn + start, 'mm')} long as it is drawn, which is not from {show(start, 'mm')} to {show(end[0], 'mm')}"
        ensure(start <= drawn + start <= end[0], f"{what} is {lengths}.")
        start, end = 0.0, [end[0] - start]
    ensure(not end or start != end[0], f"{what} goes from {start!r} to {end}; it needs a stroke.")
    limits: list[float | str] = [f"{each!r}m" if kind == "cylinder" else each for each in (start, drawn, *end)]
    found.drives.append(FoundDrive(kind, (P, Q), limits[2] if end else None, start=limits[0], drawn=limits[1]))
    found.links = [each for each in found.links if kind != "cylinder" or {*each[1]} != {P, Q}]  # a rod that is drawn becomes the cylinder


WRITERS: dict[str, Callable[[MachineSketch], str]] = {
    ".toml": MachineSketch.to_toml,
    ".py": MachineSketch.to_python,
    ".json": board_json,
    ".csv": points_csv,
    ".linkage2": linkage_xml,
    ".txt": pmks_text,
}
"""What writes a sketch, by the end of the file's name."""


def sketch_text(sketch: MachineSketch, suffix: str) -> str:
    """Return a sketch as the text of a file.

    Parameters
    ----------
    sketch : MachineSketch
        The sketch.
    suffix : str
        .toml or .py for a machine, .json for the board, .csv for a table of points and links, .linkage2 for Linkage, .txt for PMKS.

    Returns
    -------
    str
        The text.

    Raises
    ------
    DefinitionError
        The ending is none of these, or the program has no word for what the sketch holds.
    """
    ensure(suffix in WRITERS, f"{suffix or 'no ending'} says no kind of file; a sketch is written as {', '.join(WRITERS)}.")
    return WRITERS[suffix](sketch)
