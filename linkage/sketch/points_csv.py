"""The table of points and links, `kind,name,x [mm],y [mm],what`: read and written."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Callable
from functools import partial
from math import degrees

from ..errors import DefinitionError, FileError, cited
from ..files.source import delimiter_of, text_rows
from ..units import DIGITS, parse, units_of
from .found import FoundDrive, FoundMachine
from .machine_sketch import MachineSketch, written

HEADER = re.compile(r"(\w+)\s*(?:\[\s*([^\]]*?)\s*\]|\(\s*([^)]*?)\s*\))?\s*")
COLUMNS = ("kind", "name", "x", "y", "what")
PLAIN = re.compile(rf"[-+]?{DIGITS}")


def read_points_csv(found: FoundMachine, text: str) -> None:
    """Read a table: rows point (fixed, pin), link (its points), slide (a point, two points or an angle), crank and cylinder."""
    if delimiter_of(text) != ",":  # the tables of countries that write 1,5, also among other words
        text = re.sub(r"(?<=\d),(?=\d)", ".", text)
    try:
        rows = [*text_rows(found.file, text)]
    except DefinitionError as error:
        raise FileError(str(error)) from None
    found.ensure(rows, "the table has no rows.")
    found.part = f"line {rows[0][0]}"
    heads = [HEADER.fullmatch(cell.lower()) for cell in rows[0][1]]
    names = [head[1] if head else "" for head in heads]
    found.ensure(names == [*COLUMNS], "a table of points begins with kind,name,x [mm],y [mm],what.")
    units = {head[2] or head[3] for head in heads[2:4] if head} - {None}
    if units:
        lengths, others = units_of("length"), ", ".join(sorted(units - {*units_of("length")}))
        found.ensure(not others, f"{cited(others)} is no unit of length; known are {', '.join(lengths)}.")
        found.ensure(len(units) == 1, "x and y have one unit of length, such as [mm].")
        found.unit = parse(f"1 {units.pop()}", "length")
    later: list[tuple[str, str, list[str], str]] = []
    for number, row in rows[1:]:
        found.part = f"line {number}"
        kind, name, x, y, what = [*row, *[""] * (len(COLUMNS) - len(row))]
        if kind.lower() == "point":
            found.ensure(name, "the point has no name.")
            is_said = what.lower() in ("", "fixed", "pin")
            found.ensure(is_said, f"{cited(what)} says nothing of a point; it is fixed or a pin.")
            found.add_point(name, name, x, y, what.lower() == "fixed")
        else:
            found.ensure(kind.lower() in ROWS, f"{kind or 'nothing'} is none of point, {', '.join(ROWS)}.")
            later.append((kind.lower(), name, re.split(r"[\s,;]+", what.strip(" ,;")), found.part))
    for kind, name, words, found.part in later:  # points first, in whatever order the rows are
        ROWS[kind](found, name, words)
    found.part = ""


def read_link(found: FoundMachine, name: str, words: list[str]) -> None:
    """Read the row of a link."""
    found.add_link(name, words, f"the link {name}".rstrip())


def read_slide(found: FoundMachine, name: str, words: list[str]) -> None:
    """Read the row of a slide: a point, then two points of its line or the angle of a line of the frame."""
    words = [word for word in words if word.lower() not in ("on", "along", "at")]
    found.ensure(len(words) in (2, 3), "a slide names its point and two points of the line, `C P Q`, or an angle, `C 30deg`.")
    keys = [found.known(word, "a slide") for word in (words if len(words) == 3 else words[:1])]
    found.slides.append((keys[0], (keys[1], keys[2]) if len(words) == 3 else value_in(found, words[1], "angle")))


def read_drive(kind: str, found: FoundMachine, name: str, words: list[str]) -> None:
    """Read the row of a crank or a cylinder: its ends, then how far it goes from the drawn pose, forwards, or back and forwards."""
    measures, example = ("angle", "O A 360deg") if kind == "crank" else ("length", "A B 250mm")
    amounts = re.split(r"\s+(?=[-+.\d])", " ".join(words[2:])) if words[2:] else []  # "300 mm" is one
    found.ensure(len(words) > 1 and len(amounts) < 3, f"a {kind} names its two ends and how far it goes, such as `{example}`.")
    P, Q = (found.known(word, f"a {kind}") for word in words[:2])
    found.ensure(P != Q and not {*words[2:]} & found.points.keys(), f"a {kind} has two ends, such as `{example}`.")
    limits: list[float | str] = []
    for word in ["0", *amounts] if len(amounts) < 2 else amounts:
        value = value_in(found, word, measures)  # a length with a unit stays a text, one without has that of the table
        limits.append(value if measures == "angle" or PLAIN.fullmatch(word) else word)
    back, *reach = limits
    found.drives.append(FoundDrive(kind, (P, Q), reach[0] if reach else None, name, back))


ROWS: dict[str, Callable[[FoundMachine, str, list[str]], None]] = {
    "link": read_link,
    "slide": read_slide,
    "crank": partial(read_drive, "crank"),
    "cylinder": partial(read_drive, "cylinder"),
}


def value_in(found: FoundMachine, text: str, kind: str) -> float:
    """Return a value [SI]; FileError for anything else, and for an angle without a unit, which one would mean in degrees."""
    try:
        value = parse(text, kind)
    except DefinitionError as error:
        raise FileError(f"{found.here}: {error}") from None
    is_said = kind != "angle" or value == 0.0 or not PLAIN.fullmatch(text)
    found.ensure(is_said, f"the angle {text!r} has no unit; write '{text}deg' or '{text}rad'.")
    return value


def points_csv(sketch: MachineSketch) -> str:
    """Return a sketch as a table of points and links; lengths in mm."""
    stream = io.StringIO(newline="")
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(["kind", "name", "x [mm]", "y [mm]", "what"])
    for name, (x, y) in sketch.points.items():
        writer.writerow(["point", name, written(1e3 * x), written(1e3 * y), "fixed" if name in sketch.fixed else "pin"])
    for name, points in sketch.links.items():
        writer.writerow(["link", name, "", "", " ".join(points)])
    for name, slide in sketch.slides.items():
        along = f"{written(degrees(slide.along))}deg" if isinstance(slide.along, (int, float)) else " ".join(slide.along)
        writer.writerow(["slide", name, "", "", f"{slide.point} {along}"])
    for name, drive in sketch.drives.items():
        ends = [each - drive.drawn for each in (drive.start, drive.end) if each != drive.drawn]
        reach = [f"{written(degrees(each))}deg" if drive.kind == "crank" else f"{written(1e3 * each)}mm" for each in ends]
        writer.writerow([drive.kind, name, "", "", " ".join([*drive.ends, *reach])])
    return stream.getvalue()
