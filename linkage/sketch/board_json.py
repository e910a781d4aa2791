"""The file of the drawing board: a sketch as JSON, in m, rad and kg, read and written."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict
from typing import Any

from ..errors import DefinitionError, FileError
from ..files.names import shortened
from ..quantities import is_name
from .found import WORDS, FoundMachine, printable
from .machine_sketch import MachineSketch, Place, SketchDrive, SketchSlide, SketchWeight, plain_entry

BOARD = 1
"""What "board" says in a file that is written so."""
ADDRESS = f"board:{BOARD}."
"""How the address of a drawing begins, behind the # of the board's page or by itself."""


def board_tables(sketch: MachineSketch) -> dict[str, Any]:
    """Return a sketch as the tables of the board's file."""
    return {"board": BOARD, **plain_entry(asdict(sketch))}


def board_json(sketch: MachineSketch) -> str:
    """Return a sketch as the text of the board's file."""
    return json.dumps(board_tables(sketch), ensure_ascii=False, allow_nan=False, indent=1) + "\n"


def read_board(found: FoundMachine, data: Mapping[str, Any]) -> None:
    """Read a file of the board: its sketch as it is, and its points and links for drives that are asked for."""
    found.ensure(data["board"] == BOARD, f"it is of another board, {shortened(data['board'])}; bring hydrolinkage up to date.")
    try:
        found.board_sketch = BoardReader(found, data).sketch()
    except DefinitionError as error:
        raise FileError(f"{found.file}: {error}") from None
    found.unit = 1.0
    for name, (x, y) in found.board_sketch.points.items():
        found.add_point(name, name, x, y, name in found.board_sketch.fixed)
    found.links = [(name, [*points]) for name, points in found.board_sketch.links.items()]


class BoardReader:
    """A file of the board on its way into a sketch; FileError for a file of another kind."""

    def __init__(self, found: FoundMachine, data: Mapping[str, Any]) -> None:
        self.found, self.data = found, data

    def sketch(self) -> MachineSketch:
        """Return the sketch."""
        tables = {part: self.tables(part) for part in ("slides", "drives", "weights")}
        return MachineSketch(
            name=self.name(self.data.get("name")),
            points={name: self.place(name, each) for name, each in self.entries("points").items()},
            fixed=self.texts(self.data.get("fixed", []), "what is fixed"),
            links={name: self.texts(each, f"the link {name}", 2) for name, each in self.entries("links").items()},
            slides={name: self.slide(name, each) for name, each in tables["slides"].items()},
            drives={name: self.drive(name, each) for name, each in tables["drives"].items()},
            lengths={name: self.found.number(each, name) for name, each in self.entries("lengths").items()},
            weights={name: self.weight(name, each) for name, each in tables["weights"].items()},
            notes=tuple(map(printable, self.texts(self.data.get("notes", []), "notes"))),
        )

    def entries(self, part: str) -> dict[str, Any]:
        """Return a table of members, whose names are legal."""
        table = self.found.table(self.data.get(part, {}), part)
        self.found.ensure(len(table) <= 1000, f"{part} has {len(table)} entries, more than a drawing has.")
        return {self.name(name): each for name, each in table.items()}

    def tables(self, part: str) -> dict[str, Mapping[str, Any]]:
        """Return a table of tables."""
        return {name: self.found.table(each, name) for name, each in self.entries(part).items()}

    def name(self, given: object) -> str:
        """Return a name that a member may have."""
        is_legal = is_name(given) and given not in WORDS and not str(given).startswith("_")
        self.found.ensure(is_legal, f"{shortened(given)} is no name for a part of a machine; take letters, digits and _.")
        return str(given)

    def texts(self, given: object, what: str, least: int = 0) -> tuple[str, ...]:
        """Return a list of texts, at least so many."""
        items = self.found.list_of(given, what)
        is_text = all(isinstance(each, str) for each in items) and len(items) >= least
        self.found.ensure(is_text, f"{what} is no list of {f'{least} names or more' if least else 'texts'}.")
        return tuple(items)

    def place(self, name: str, given: object) -> Place:
        """Return the two coordinates of a point."""
        numbers = [self.found.number(each, name) for each in self.found.list_of(given, name)]
        self.found.ensure(len(numbers) == 2, f"the point {name} has no two coordinates [x, y].")
        return numbers[0], numbers[1]

    def number(self, name: str, table: Mapping[str, Any], key: str) -> float:
        """Return a finite number of a member."""
        return self.found.number(table.get(key), f"{key} of {name}")

    def slide(self, name: str, table: Mapping[str, Any]) -> SketchSlide:
        """Return the sketch of a slide."""
        along = table.get("along")
        if not isinstance(along, list):
            return SketchSlide(str(table.get("point")), self.number(name, table, "along"))
        ends = self.texts(along, f"what {name} slides along", 2)
        self.found.ensure(len(ends) == 2, f"{name} slides along two points or at an angle.")
        return SketchSlide(str(table.get("point")), (ends[0], ends[1]))

    def weight(self, name: str, table: Mapping[str, Any]) -> SketchWeight:
        """Return a weight."""
        mass = self.number(name, table, "mass")
        self.found.ensure(mass >= 0.0, f"the mass of {name} is {mass:g} kg; give 0 or more.")
        return SketchWeight(str(table.get("point")), mass)

    def drive(self, name: str, table: Mapping[str, Any]) -> SketchDrive:
        """Return the sketch of a drive."""
        kind, ends = str(table.get("kind")), self.texts(table.get("ends"), f"the ends of {name}", 2)
        is_known = kind in ("crank", "cylinder") and len(ends) == 2
        self.found.ensure(is_known, f"{name} is no crank and no cylinder with two ends.")
        start, end, drawn = (self.number(name, table, key) for key in ("start", "end", "drawn"))
        sizes = [self.number(name, table, key) for key in ("bore", "rod") if table.get(key) is not None]
        is_whole = not sizes or (kind == "cylinder" and len(sizes) == 2 and 0.0 < sizes[1] < sizes[0])
        self.found.ensure(is_whole, f"the rod of {name} is not thinner than its bore; give both in metres.")
        return SketchDrive(kind, (ends[0], ends[1]), start, end, drawn, *sizes)
