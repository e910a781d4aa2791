"""The file of the drawing board: a sketch as JSON, in m, rad and kg, read and written."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict

from ..errors import DefinitionError, FileError, cited
from ..quantities import is_name
from .found import WORDS, FoundMachine, printable
from .machine_sketch import MachineSketch, Place, SketchDrive, SketchSlide, SketchWeight, plain_entry

BOARD = 1
"""What "board" says in a file that is written so."""
ADDRESS = f"board:{BOARD}."
"""How the address of a drawing begins, behind the # of the board's page or by itself."""


def board_notes(sketch: MachineSketch) -> tuple[str, ...]:
    """Return the notes of a sketch on the board, which has no forces: the last one names them."""
    left = [f"Left out: {', '.join(sketch.forces)}, as the board has no forces."] if sketch.forces else []
    return (*sketch.notes, *left)


def board_tables(sketch: MachineSketch) -> dict[str, object]:
    """Return a sketch as the tables of the board's file."""
    tables = asdict(sketch) | {"notes": board_notes(sketch)}
    del tables["forces"]
    return {"board": BOARD, **plain_entry(tables)}


def board_json(sketch: MachineSketch) -> str:
    """Return a sketch as the text of the board's file."""
    return json.dumps(board_tables(sketch), ensure_ascii=False, allow_nan=False, indent=1) + "\n"


def read_board(found: FoundMachine, data: Mapping[str, object]) -> None:
    """Read a file of the board: its sketch as it is, and its points and links for drives that are asked for."""
    found.ensure(data["board"] == BOARD, f"it is of another board, {cited(data['board'])}; bring hydrolinkage up to date.")
    try:
        found.board_sketch = drawn_sketch(found, data)
    except DefinitionError as error:
        raise FileError(f"{found.file}: {error}") from None
    found.unit = 1.0
    for name, (x, y) in found.board_sketch.points.items():
        found.add_point(name, name, x, y, name in found.board_sketch.fixed)
    found.links = [(name, [*points]) for name, points in found.board_sketch.links.items()]


def drawn_sketch(found: FoundMachine, data: Mapping[str, object]) -> MachineSketch:
    """Return the sketch of a file of the board; FileError for a file of another kind."""
    parts = "slides", "drives", "weights"
    tables = {part: {name: found.table(each, name) for name, each in named_entries(found, data, part).items()} for part in parts}
    title, points = legal(found, data.get("name")), dict[str, Place]()
    for name, given in named_entries(found, data, "points").items():
        place = [found.number(each, name) for each in found.list_of(given, name)]
        found.ensure(len(place) == 2, f"the point {name} has no two coordinates [x, y].")
        points[name] = place[0], place[1]
    fixed = texts(found, data.get("fixed", []), "what is fixed")
    links = {name: texts(found, each, f"the link {name}", 2) for name, each in named_entries(found, data, "links").items()}
    slides, drives, weights = dict[str, SketchSlide](), dict[str, SketchDrive](), dict[str, SketchWeight]()
    for name, table in tables["slides"].items():
        along = table.get("along")
        if isinstance(along, list):
            ends = texts(found, along, f"what {name} slides along", 2)
            found.ensure(len(ends) == 2, f"{name} slides along two points or at an angle.")
            slides[name] = SketchSlide(str(table.get("point")), (ends[0], ends[1]))
        else:
            slides[name] = SketchSlide(str(table.get("point")), found.number(along, f"along of {name}"))
    for name, table in tables["drives"].items():
        kind, ends = str(table.get("kind")), texts(found, table.get("ends"), f"the ends of {name}", 2)
        is_known = kind in ("crank", "cylinder") and len(ends) == 2
        found.ensure(is_known, f"{name} is no crank and no cylinder with two ends.")
        start, end, drawn = (found.number(table.get(key), f"{key} of {name}") for key in ("start", "end", "drawn"))
        sizes = [found.number(table[key], f"{key} of {name}") for key in ("bore", "rod") if table.get(key) is not None]
        is_sound = not sizes or (kind == "cylinder" and len(sizes) == 2 and 0.0 < sizes[1] < sizes[0])
        found.ensure(is_sound, f"the rod of {name} is not thinner than its bore; give both in metres.")
        drives[name] = SketchDrive(kind, (ends[0], ends[1]), start, end, drawn, *sizes)
    lengths = {name: found.number(each, name) for name, each in named_entries(found, data, "lengths").items()}
    for name, table in tables["weights"].items():
        mass = found.number(table.get("mass"), f"mass of {name}")
        found.ensure(mass >= 0.0, f"the mass of {name} is {mass:g} kg; give 0 or more.")
        weights[name] = SketchWeight(str(table.get("point")), mass)
    notes = tuple(map(printable, texts(found, data.get("notes", []), "notes")))
    return MachineSketch(title, points, fixed, links, slides, drives, lengths, weights, notes)


def named_entries(found: FoundMachine, data: Mapping[str, object], part: str) -> dict[str, object]:
    """Return a table of members, whose names are legal."""
    table = found.table(data.get(part, {}), part)
    found.ensure(len(table) <= 1000, f"{part} has {len(table)} entries, more than a drawing has.")
    return {legal(found, name): each for name, each in table.items()}


def legal(found: FoundMachine, given: object) -> str:
    """Return a name that a member may have."""
    is_legal = is_name(given) and given not in WORDS and not str(given).startswith("_")
    found.ensure(is_legal, f"{cited(given)} is no name for a part of a machine; take letters, digits and _.")
    return str(given)


def texts(found: FoundMachine, given: object, what: str, least: int = 0) -> tuple[str, ...]:
    """Return a list of texts, at least so many."""
    items = found.list_of(given, what)
    is_text = all(isinstance(each, str) for each in items) and len(items) >= least
    found.ensure(is_text, f"{what} is no list of {f'{least} names or more' if least else 'texts'}.")
    return tuple(items)
