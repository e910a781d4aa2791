"""Findings of a file's reader, piece by piece, and their way to a sketch: names made legal, units, slides on their lines, drives."""

from __future__ import annotations

import re
from base64 import urlsafe_b64decode
from binascii import Error
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import combinations, permutations
from math import cos, dist, hypot, inf, isfinite, pi, remainder, sin
from typing import Any, TypeAlias
from unicodedata import normalize

from ..errors import FileError, cited, did_you_mean
from ..mechanism import Mechanism
from ..quantities import is_name, joined_names
from ..units import parse, show
from .machine_sketch import MachineSketch, Place, SketchDrive, SketchForce, SketchSlide, longer_side, noiseless

OFF_LINE = 1e-3
"""A point farther from its slide than so much of the size of the drawing is not on it."""
CALLED = "Mechanism", "Stroke", "drawn", "Ground", "Crank", "Pin", "Link", "Guide", "Slide", "Cylinder", "Weight", "Force", "deg", "sketch"
WORDS = {*CALLED, "Outline", *vars(Mechanism)}
"""What a member may not be called, because the file of the class says it already."""
TURN = 2.0 * pi
HALF = 0.5
"""The stroke of a cylinder of which the file says nothing, in drawn lengths."""
SMALL, LARGE = 5e-3, 100.0
"""A machine that is drawn smaller or larger than this [m] is likely to have another unit."""
SHOWN_ITEMS = 8

JsonTable: TypeAlias = Mapping[str, Any]
"""An object of a JSON file."""


@dataclass
class FoundPoint:
    """A point of a file in its units, by its own name there."""

    name: str
    place: Place
    fixed: bool = False


@dataclass
class FoundDrive:
    """A drive: a crank about its first key or a cylinder between two; the stroke [units of the file, rad] where the file gives it.

    A text is a length with a unit of its own, which no scale of the drawing changes.
    """

    kind: str
    ends: tuple[str, str]
    reach: float | str | None = None
    name: str = ""
    start: float | str = 0.0
    """Where it begins, as `reach` is where it ends; both seen from the drawn pose, unless `drawn` says where that is."""
    drawn: float | str = 0.0


@dataclass
class FoundMachine:
    """Points, links, slides, drives, forces [N] by the keys of a file, and notes. `unit` is 1 of the file [m]; None where it has none."""

    file: str
    unit: float | None = None
    points: dict[str, FoundPoint] = field(default_factory=dict)
    links: list[tuple[str, list[str]]] = field(default_factory=list)
    slides: list[tuple[str, tuple[str, str] | float]] = field(default_factory=list)
    drives: list[FoundDrive] = field(default_factory=list)
    forces: list[tuple[str, str, Place]] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    outlines: list[tuple[list[str], list[Place]]] = field(default_factory=list)
    """The points of the link that carries each outline, none for the frame, and its corners in the file's units."""
    left_out: list[str] = field(default_factory=list)
    part: str = ""
    """The line or the joint that is read, where the file has such."""
    board_sketch: MachineSketch | None = None
    """The sketch, where the file holds it as it is: points and links above are its own."""

    @property
    def here(self) -> str:
        """The file, and the part that is read."""
        return f"{self.file}, {self.part}" if self.part else self.file

    # -- what readers say --------------------------------------------------------------------------------

    def add_point(self, key: str, name: object, x: object, y: object, fixed: bool = False) -> None:
        """Enter a point; FileError for one that is there, and for coordinates that are no finite numbers."""
        self.ensure(key not in self.points, f"the point {cited(key)} stands twice; each point has a name of its own.")
        place = self.number(x, f"x of {cited(key)}"), self.number(y, f"y of {cited(key)}")
        self.points[key] = FoundPoint(str(name) or key, place, fixed)

    def ensure(self, holds: object, message: str) -> None:
        """Raise FileError with the place that is read and a message, unless something holds."""
        if not holds:
            raise FileError(f"{self.here}: {message}")

    def number(self, given: object, where: str) -> float:
        """Return a finite number of the file; FileError for anything else."""
        try:
            value = float(given) if isinstance(given, (int, float, str)) and not isinstance(given, bool) else inf
        except (ValueError, OverflowError):
            value = inf
        if not abs(value) < 1e12:
            what = "is too large" if isfinite(value) else "is no finite number"
            raise FileError(f"{self.here}, {where}: {cited(given)} {what}; correct it in the file.")
        return value

    def table(self, given: object, what: str) -> JsonTable:
        """Return a table of a JSON file; FileError for anything else."""
        self.ensure(isinstance(given, dict), f"{what} is no table {{...}}.")
        return given  # type: ignore[return-value]

    def list_of(self, given: object, what: str) -> list[Any]:
        """Return a list of a JSON file; FileError for anything else, and for one that is too long for a drawing."""
        self.ensure(isinstance(given, list) and len(given) <= 1000, f"{what} is no list [...] of up to 1000 entries.")
        return given  # type: ignore[return-value]

    def unpacked(self, letters: str) -> bytes:
        """Return the text in the letters of an address, base 64; FileError where they are damaged."""
        try:
            return urlsafe_b64decode(letters + "=" * (-len(letters) % 4))
        except (Error, ValueError):
            raise FileError(f"{self.file}: the address is damaged; copy it whole.") from None

    def known(self, key: object, what: str) -> str:
        """Return the key of a point; FileError for any other."""
        is_there = isinstance(key, str) and key in self.points
        if not is_there:
            hint = did_you_mean(str(key), [point.name for point in self.points.values()])
            raise FileError(f"{self.here}: {what} names the point {cited(key)}, which is not there.{cited(hint, quote=False)}")
        return str(key)

    def add_link(self, name: str, keys: Sequence[object], what: str = "") -> None:
        """Enter a link, each of its points once; one of fewer than two points is left out."""
        points = [*dict.fromkeys(self.known(key, what or f"the link {cited(name)}") for key in keys)]
        if len(points) < 2:
            self.left_out.append(f"the link {cited(name, quote=False)} of one point")
        elif points:
            self.links.append((name, points))

    def helper(self, key: str, along: Place, link: list[str] | None) -> str:
        """Return the key of a new point at a place from another one, on a link or fixed."""
        name = next(each for number in range(1, 99) if (each := f"{key}_{number}") not in self.points)
        (x, y), (dx, dy) = self.points[key].place, along
        self.points[name] = FoundPoint(f"{self.points[key].name}_{name.rpartition('_')[2]}", (x + dx, y + dy), link is None)
        if link is not None:
            link.append(name)
        return name

    def slot(self, key: str, angle: float, carrier: list[str] | None) -> tuple[str, str] | float:
        """Return the line through a point at an angle [rad]: two points of its carrier, new ones if need be; of the frame the angle."""
        if carrier is None:
            return angle
        (x, y), (c, t) = self.points[key].place, (cos(angle), sin(angle))
        away = {each: (self.points[each].place[0] - x, self.points[each].place[1] - y) for each in carrier}
        near = [each for each, (u, v) in away.items() if abs(c * v - t * u) <= 1e-9 * self.size and hypot(u, v) > 1e-3 * self.size]
        for sign in (-0.25, 0.25)[: max(0, 2 - len(near))]:
            near.append(self.helper(key, (sign * self.size * c, sign * self.size * t), carrier))
        return near[0], near[1]

    def add_slide(self, key: str, angle: float, along: tuple[str, str] | float, rigid: list[str] | None = None) -> None:
        """Let a point slide on a line at an angle [rad]; a rigid link does not turn there, as a second point of it slides farther along."""
        self.slides.append((key, along))
        if rigid is not None:
            reach = 0.25 * self.size
            self.slides.append((self.helper(key, (reach * cos(angle), reach * sin(angle)), rigid), along))

    def push(self, key: str, angle: float, along: tuple[str, str] | float) -> None:
        """Let a cylinder drive a point on its slide: from a point of the line behind it."""
        if isinstance(along, tuple):
            foot = max(along, key=lambda end: dist(self.points[end].place, self.points[key].place))
        else:
            foot = self.helper(key, (-self.size * cos(angle), -self.size * sin(angle)), None)
        self.drives.append(FoundDrive("cylinder", (foot, key)))

    def turn(self, pivot: str, backwards: bool = False) -> None:
        """Let the link on a fixed pivot be the crank, one turn; left out where there is not exactly one."""
        arms = [points for _, points in self.links if pivot in points and not all(self.points[each].fixed for each in points)]
        if len(arms) == 1 and self.points[pivot].fixed:
            other = next(each for each in arms[0] if each != pivot and not self.points[each].fixed)
            self.drives.append(FoundDrive("crank", (pivot, other), -TURN if backwards else TURN))
        else:
            why = f"{len(arms)} links" if self.points[pivot].fixed else "no fixed pin"
            self.left_out.append(f"the drive at {self.points[pivot].name}, which turns {why}")

    def enter_force(self, name: str, keys: Sequence[str], start: Place, end: Place, size: float, *, turns: bool) -> None:
        """Enter a force [N] at a place of the link of some points, a new point if need be, or leave it out with the reason.

        It points towards `end`, away from it where its size is below zero.
        """
        link, along = next((points for _, points in self.links if {*points} == {*keys}), None), dist(start, end)
        if turns or link is None or not along:
            why = "which turns with its link" if turns else "which is on no link" if link is None else "which has no direction"
            self.left_out.append(f"the force {cited(name, quote=False)} of {show(abs(size), 'N')}, {why}")
            return
        away = {key: (start[0] - self.points[key].place[0], start[1] - self.points[key].place[1]) for key in link}
        key = min(link, key=lambda each: hypot(*away[each]))
        key = key if hypot(*away[key]) <= 1e-9 * self.size else self.helper(link[0], away[link[0]], link)
        self.forces.append((name, key, (size * (end[0] - start[0]) / along, size * (end[1] - start[1]) / along)))

    @property
    def size(self) -> float:
        """The longer side of the box around all points, in the file's units; 1 where they stand at one place."""
        return longer_side(point.place for point in self.points.values()) or 1.0

    # -- the sketch --------------------------------------------------------------------------------------

    def sketch(self, title: str) -> MachineSketch:
        """Return the sketch; FileError where there is nothing, or no unit."""
        self.ensure(self.unit is not None, "the file has no unit of length; say what 1 of it is when you import it, --scale 1mm.")
        assert self.unit is not None
        self.straighten()
        used = {key for _, points in self.links for key in points} | {key for key, _ in self.slides}
        used |= {key for _, along in self.slides if isinstance(along, tuple) for key in along}
        used |= {each for drive in self.drives for each in drive.ends}
        loose = [key for key, point in self.points.items() if key not in used and not point.fixed]
        self.left_out += [f"the point {cited(self.points.pop(key).name, quote=False)}, which is on no link" for key in loose]
        self.ensure(self.points, "it holds no points that a link joins.")
        taken = set(WORDS)
        names, labels = self.point_names(taken)
        size, unit = longer_side(point.place for point in self.points.values()) * self.unit, self.unit
        self.ensure(isfinite(size) and size > 1e-9, f"all points stand at one place ({show(size, 'mm')}); look at --scale.")
        if not SMALL <= size <= LARGE:
            self.notes.append(f"The machine is {show(size, 'mm')} wide; if that is not meant, say what 1 of the file is, --scale 1mm.")
        places = {names[key]: (noiseless(point.place[0] * unit), noiseless(point.place[1] * unit)) for key, point in self.points.items()}
        links = {}
        for name, points in self.links:
            own = name if name and name not in labels else f"link_{name}"
            links[legal_name(own, taken)] = tuple(names[key] for key in points)
        slides = {}
        for key, along in self.slides:
            line = remainder(along, TURN) if isinstance(along, float) else (names[along[0]], names[along[1]])
            slides[legal_name(f"slide_{names[key]}", taken)] = SketchSlide(names[key], line)
        outlines = {
            legal_name("plate", taken): (tuple(names[key] for key in keys[:2]), tuple(self.carried(keys[:2], corners)))
            for keys, corners in self.outlines
        }
        drives = dict(self.named_drives(names, places, taken))
        forces = {legal_name(name, taken): SketchForce(names[key], (noiseless(x), noiseless(y))) for name, key, (x, y) in self.forces}
        if self.left_out:
            self.notes.append(f"Left out: {few(self.left_out, '; ')}.")
        fixed = tuple(names[key] for key, point in self.points.items() if point.fixed)
        title, notes = legal_name(title, {"Mechanism"}), tuple(map(printable, self.notes))
        return MachineSketch(title, places, fixed, links, slides, drives, forces=forces, notes=notes, outlines=outlines)

    def carried(self, keys: Sequence[str], corners: Sequence[Place]) -> Iterator[Place]:
        """Yield the corners of an outline [m] in the axes from one point that carries it to the other; without these as they are drawn."""
        start, end = (complex(*self.points[key].place) for key in keys) if keys else (0j, 1 + 0j)
        for x, y in corners[:-1]:  # the last is the first
            place = (complex(x, y) - start) * (end - start).conjugate() / abs(end - start) * (self.unit or 1.0)
            yield round(place.real, 6) + 0.0, round(place.imag, 6) + 0.0

    def named_drives(self, names: Mapping[str, str], places: Mapping[str, Place], taken: set[str]) -> Iterator[tuple[str, SketchDrive]]:
        """Yield the drives [SI] by their names; a note on a cylinder of which the file says no stroke."""
        for drive in self.drives:
            P, Q = (names[key] for key in drive.ends)
            if drive.kind == "crank":
                name, start, end, drawn = "phi", float(drive.start), float(TURN if drive.reach is None else drive.reach), 0.0
            else:
                reach = f"{HALF * dist(places[P], places[Q])!r}m" if drive.reach is None else drive.reach
                given, unit = (drive.start, reach, drive.drawn), self.unit or 1.0
                lengths = (parse(each, "length") if isinstance(each, str) else each * unit for each in given)
                name, (start, end, drawn) = "S", map(noiseless, lengths)
                if drive.reach is None:
                    self.notes.append(f"The file does not say the stroke of the cylinder {P} {Q}: it goes out by half its drawn length.")
            yield legal_name(drive.name or name, taken), SketchDrive(drive.kind, (P, Q), start, end, drawn)

    def straighten(self) -> None:
        """Put each point that slides between two others onto their line; FileError for one that is not near it."""
        for key, along in self.slides:
            if isinstance(along, float):
                continue
            (ax, ay), (bx, by), (x, y) = (self.points[each].place for each in (*along, key))
            base = hypot(bx - ax, by - ay)
            self.ensure(base > 0.0, f"the slide of {self.points[key].name} has both ends at one place.")
            off = ((bx - ax) * (y - ay) - (by - ay) * (x - ax)) / base
            if abs(off) <= 1e-12 * self.size:
                continue
            self.ensure(
                abs(off) <= OFF_LINE * self.size,
                f"{self.points[key].name} is {abs(off):.4g} away from the line of its slide; move it there in the drawing.",
            )
            self.points[key].place = x + off * (by - ay) / base, y - off * (bx - ax) / base
            self.notes.append(f"{self.points[key].name} is moved by {abs(off):.2g} of the file onto its slide.")

    def point_names(self, taken: set[str]) -> tuple[dict[str, str], set[str]]:
        """Return legal names of the points by their keys, and the labels they make; numbers where joined names would be one for two."""
        names = {key: legal_name(point.name, taken) for key, point in self.points.items()}
        labels = labels_of(self.links, names)
        if len({*labels}) < len(labels) or not taken.isdisjoint(labels):
            names = {key: legal_name(f"P{number}", taken) for number, key in enumerate(self.points, 1)}
            labels = labels_of(self.links, names)
        changed = [f"{point.name} is {names[key]}" for key, point in self.points.items() if point.name != names[key]]
        if changed:
            self.notes.append(f"Named anew: {few(changed, ', ')}.")
        return names, {*labels}


def labels_of(links: Sequence[tuple[str, list[str]]], names: Mapping[str, str]) -> list[str]:
    """Return the labels of lengths and angles of links in both spellings, by their points' names; two that are equal are not told apart."""
    bodies = [[names[key] for key in points] for _, points in links]
    pairs = {frozenset(pair): pair for points in bodies for pair in combinations(points, 2)}
    corners = {(P, frozenset((Q, R))): (Q, P, R) for points in bodies for Q, P, R in permutations(points, 3)}
    return [label for each in (*pairs.values(), *corners.values()) for label in {joined_names(*each), joined_names(*reversed(each))}]


def legal_name(given: str, taken: set[str]) -> str:
    """Return a name that a member may have and none has yet, as near to a given one as may be; it is taken from then on."""
    text = re.sub(r"\W+", "_", normalize("NFKC", given)).strip("_")[:40]
    text = text if text[:1].isalpha() else f"P{text}"
    found = next(each for each in (text, *(f"{text}_{number}" for number in range(2, 10_000))) if is_name(each) and each not in taken)
    taken.add(found)
    return found


def few(items: Sequence[str], between: str) -> str:
    """Return the first few items, and how many more there are."""
    rest = len(items) - SHOWN_ITEMS
    return between.join([*items[:SHOWN_ITEMS], *([f"and {rest} more"] if rest > 0 else [])])


def printable(text: str) -> str:
    """Return a text in one line of printable characters, not too long."""
    return "".join(each if each.isprintable() else " " for each in text)[:1000]
