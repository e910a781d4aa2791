"""The value of this room: the pins' places, the links that join them, fixed pins, slides and drives."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import field, is_dataclass, replace
from itertools import permutations
from math import atan2, degrees, dist, floor, isfinite, log10, pi, radians, remainder
from typing import Any

from ..errors import DefinitionError, FileError, cited, ensure, is_listed, is_number, quoted
from ..files import from_dict, to_toml
from ..files.design import in_unit
from ..frozen import record
from ..mechanism import Mechanism
from ..quantities import joined_names
from ..quantities.quantity import plain
from ..units import show

Place = tuple[float, float]


@record
class SketchSlide:
    """A point that slides on a straight line.

    Parameters
    ----------
    point : str
        The point that slides.
    along : tuple of str, or float
        Two other points of a body, on whose line it slides; or the angle [rad] of a line of the frame through its drawn place.
    """

    point: str
    along: tuple[str, str] | float


@record
class SketchDrive:
    """A drive of a sketch, a crank or a cylinder, by a stroke of its own.

    Parameters
    ----------
    kind : str
        "crank" or "cylinder".
    ends : tuple of str
        The fixed pivot of a crank and a point of the link that it turns; the two ends of a cylinder.
    start, end : float
        The ends of the stroke [m or rad].
    drawn : float
        The stroke at which the sketch is drawn [m or rad].
    bore, rod : float, optional
        Of a cylinder that carries load [m]: both, or neither.
    """

    kind: str
    ends: tuple[str, str]
    start: float
    end: float
    drawn: float = 0.0
    bore: float | None = None
    rod: float | None = None


@record
class SketchWeight:
    """The weight of a mass at a point.

    Parameters
    ----------
    point : str
        The point.
    mass : float
        The mass [kg].
    """

    point: str
    mass: float


@record
class SketchForce:
    """A force at a point, its direction fixed to the frame.

    Parameters
    ----------
    point : str
        The point.
    vector : tuple of float
        Its parts (x, y) [N].
    """

    point: str
    vector: tuple[float, float]


@record
class MachineSketch:
    """Pins by coordinates, named links, fixed pins, slides and drives: a machine as one draws it.

    Parameters
    ----------
    name : str
        The name of the class it becomes.
    points : mapping of str to (float, float)
        Where each point is drawn [m].
    fixed : collection of str
        The points that are fixed to the frame.
    links : mapping of str to tuple of str
        The points of each rigid body.
    slides : mapping of str to SketchSlide
        What slides, by the name that the slide gets.
    drives : mapping of str to SketchDrive
        What drives, by the name of its stroke.
    lengths : mapping of str to float
        Lengths that are given instead of measured [m], by their labels, such as those of `rounded`.
    weights : mapping of str to SketchWeight
        Masses at points, by the names of their loads.
    notes : tuple of str
        What reading it changed or left out, in sentences.
    forces : mapping of str to SketchForce
        Forces at points, by their names; the drawing board has none.
    angles : mapping of str to float
        Angles of links that are given instead of measured [rad], by their labels, such as those of `rounded`.
    outlines : mapping of str to tuple
        Outlines that are only drawn, by their names: the two points of a link that carry one, none for the frame, and its corners [m] in
        the axes from the first to the second.

    Raises
    ------
    DefinitionError
        A place is not finite, a name is not among the points, or nothing is drawn.
    """

    name: str
    points: Mapping[str, Place]
    fixed: tuple[str, ...] = ()
    links: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    slides: Mapping[str, SketchSlide] = field(default_factory=dict)
    drives: Mapping[str, SketchDrive] = field(default_factory=dict)
    lengths: Mapping[str, float] = field(default_factory=dict)
    weights: Mapping[str, SketchWeight] = field(default_factory=dict)
    notes: tuple[str, ...] = ()
    forces: Mapping[str, SketchForce] = field(default_factory=dict)
    angles: Mapping[str, float] = field(default_factory=dict)
    outlines: Mapping[str, tuple[tuple[str, ...], tuple[Place, ...]]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        ensure(self.points, f"{self.name}: no point is drawn; a sketch begins with points and links.")
        for name, place in self.points.items():
            ensure(all(map(is_number, place)), f"{self.name}: {name} stands at {place}; give finite coordinates.")
        told: dict[str, object] = {"what is fixed": self.fixed}
        for part in ("links", "slides", "drives", "lengths", "angles", "weights", "forces"):
            told |= {f"the {part[:-1]} {name}": each for name, each in getattr(self, part).items()}
        for what, each in told.items():
            values = [*values_told(each)]
            names = [value for value in values if isinstance(value, str)]
            numbers = [value for value in values if not isinstance(value, str)]
            ensure(all(map(is_number, numbers)), f"{self.name}: {what} has {', '.join(map(cited, numbers))}; give finite numbers.")
            missing = [name for name in names if name not in self.points]
            ensure(not missing, f"{self.name}: {what} names {', '.join(missing)}, which is not among the points.")
            ensure(len({*names}) == len(names), f"{self.name}: {what} names a point twice.")

    @property
    def size(self) -> float:
        """The longer side of the box around all points [m]."""
        return longer_side(self.points.values())

    def length(self, P: str, Q: str) -> float:
        """Return the drawn distance of two points [m]."""
        return dist(self.points[P], self.points[Q])

    # -- what it becomes -----------------------------------------------------------------------------------

    def tables(self) -> dict[str, Any]:
        """Return the sketch as the tables of a machine's file, as `from_dict` takes them [SI].

        Returns
        -------
        dict
            Sections by name; their entries are plain numbers, texts, lists and tables.

        Raises
        ------
        DefinitionError
            Nothing drives it.
        """
        self.check_driven()
        cranks = {drive.ends[1]: (name, drive) for name, drive in self.drives.items() if drive.kind == "crank"}
        turned = {frozenset(drive.ends) for _, drive in cranks.values()}
        found: dict[str, Any] = {"name": self.name, "doc": " ".join(self.notes)} if self.notes else {"name": self.name}
        ends = {name: in_unit(drive.end, "deg") if drive.kind == "crank" else drive.end for name, drive in self.drives.items()}
        found["strokes"] = {name: [drive.start, ends[name]] for name, drive in self.drives.items()}
        found["drawn"] = {"sketch": {name: drive.drawn for name, drive in self.drives.items()}}
        found["ground"] = {name: [*self.points[name]] for name in self.fixed}
        found["points"] = {
            name: {"Crank": drive.ends[0], "at": [*self.points[name]], **self.labels((drive.ends[0], name)), "angle": stroke}
            for name, (stroke, drive) in cranks.items()
        }
        found["pins"] = {name: {"at": [*place]} for name, place in self.points.items() if name not in {*self.fixed, *cranks}}
        found["links"] = {
            name: {"points": " ".join(points), **self.labels(points)}
            for name, points in self.links.items()
            if not {*points} <= {*self.fixed} and frozenset(points) not in turned
        }
        for name, drive in self.drives.items():
            if drive.kind != "cylinder":
                continue
            P, Q = drive.ends
            label = joined_names(P, Q)
            closed = float(self.lengths.get(label, noiseless(self.length(P, Q) - drive.drawn)))
            is_measured = label not in self.lengths and min(drive.start, drive.end) <= 0.0
            found["links"][f"rod_{name}"] = {"points": f"{P} {Q}", label: name if is_measured else f"{closed!r} + {name}"}
        found["guides"] = {
            f"line_{name}": {"from": [*self.points[each.point]], "angle": in_unit(each.along, "deg")}
            if isinstance(each.along, (int, float))
            else {"from": each.along[0], "to": each.along[1]}
            for name, each in self.slides.items()
        }
        found["slides"] = {name: {"point": each.point, "guide": f"line_{name}"} for name, each in self.slides.items()}
        rams = {f"cylinder_{name}": drive for name, drive in self.drives.items() if drive.bore is not None}
        found["hydraulics"] = {name: {"Cylinder": [*drive.ends], "bore": drive.bore, "rod": drive.rod} for name, drive in rams.items()}
        found["loads"] = {name: {"Weight": weight.point, "mass": weight.mass} for name, weight in self.weights.items()}
        found["loads"] |= {name: {"Force": force.point, "vector": [*force.vector]} for name, force in self.forces.items()}
        found["surroundings"] = {
            name: {"points": corners, **({"on": " ".join(on)} if on else {})} for name, (on, corners) in self.outlines.items()
        }
        return {name: plain_entry(table) for name, table in found.items() if table}

    def check_driven(self) -> None:
        """Raise DefinitionError where nothing stands still, and where nothing drives the sketch, naming possible drives."""
        stands = self.fixed or any(isinstance(each.along, (int, float)) for each in self.slides.values())
        remedy = "In a drawing hatch a pin, or put its circle on the layer ground; in a table write `fixed` beside it"
        ensure(stands, f"{self.name}: no pin is fixed, so that nothing says where the frame is. {remedy}.")
        if self.drives:
            return
        arms = [(P, Q) for points in self.links.values() for P in points for Q in points if P in self.fixed and Q not in self.fixed]
        P, Q = arms[0] if arms else ("O", "A")
        others = f" Links on fixed pins: {', '.join(f'{P} {Q}' for P, Q in arms[:6])}." if arms else ""
        others = " ".join([others, *(note for note in self.notes if note.startswith("Left out"))]).rstrip()
        text = f"{self.name}: nothing says what drives it. Say it when you import it. A crank is a fixed pin and a pin of its link"
        raise DefinitionError(f"{text}, --drive {P} {Q}; a cylinder is its two ends, --cylinder P Q.{others}")

    def labels(self, points: Sequence[str]) -> dict[str, float | str]:
        """Return the given lengths and angles among some points [m, rad], by their labels."""
        given = {**self.lengths, **{label: in_unit(angle, "deg") for label, angle in self.angles.items()}}
        labels = (joined_names(*each) for count in (2, 3) for each in permutations(points, count))
        return {label: given[label] for label in labels if label in given}

    def to_class(self) -> type[Mechanism]:
        """Return the class of mechanism in the parts-list form; lengths not given are measured from the coordinates.

        Returns
        -------
        type of Mechanism
            The class.

        Raises
        ------
        DefinitionError, FileError
            Nothing drives it, or it cannot be a machine: the message says where and why.
        AssemblyError
            It cannot be assembled where it is drawn.
        """
        try:
            return from_dict(self.tables())
        except FileError as error:  # it names tables, which no file that was drawn has
            text = re.sub(r"^the tables: (?:\w+\.\w+: )?", "", str(error))
            raise FileError(text if text.startswith(f"{self.name}: ") else f"{self.name}: {text}") from error

    def to_toml(self) -> str:
        """Return the machine as TOML text, which `load` reads into the same class. Errors are those of `to_class`."""
        return to_toml(self.to_class())

    def to_python(self) -> str:
        """Return the machine as a Python file, a class of the parts-list form with the same numbers. Errors are those of `to_class`."""
        tables = self.tables()
        lines = [f"class {self.name}(Mechanism):", f'    """{self.name}, as it is drawn."""', *(f"    # {note}" for note in self.notes), ""]
        lines += [f"    {name} = Stroke({python_number(low)}, {python_number(high)})" for name, (low, high) in tables["strokes"].items()]
        lines += [f"    sketch = drawn({', '.join(f'{name}={value!r}' for name, value in tables['drawn']['sketch'].items())})", ""]
        lines += [f"    {name} = Ground({x!r}, {y!r})" for name, (x, y) in tables.get("ground", {}).items()]
        for section in ("points", "pins", "links", "guides", "slides", "hydraulics", "loads", "surroundings"):
            lines += [f"    {name} = {python_member(section, table)}" for name, table in tables.get(section, {}).items()]
        imports = ["from hydraulics import Cylinder"] * ("hydraulics" in tables) + ["from linkage import *"]
        return "\n".join([*imports, "", "", *lines]) + "\n"

    # -- round numbers -------------------------------------------------------------------------------------

    def rounded(self, step: float) -> MachineSketch:
        """Return the sketch with round lengths, angles and fixed pins, its other points where these put them.

        Parameters
        ----------
        step : float
            What lengths and fixed coordinates are whole multiples of [m]. Angles are whole multiples of 1, 0.1, 0.01 ... degrees, the
            first that is finer than a step at the end of their arm.

        Returns
        -------
        MachineSketch
            The lengths and angles given; a note says which point moves most, and by how much.

        Raises
        ------
        DefinitionError
            The step is not above zero, or a length would round to nothing.
        AssemblyError
            With round lengths it does not close where it is drawn.
        """
        ensure(isfinite(step) and step > 0.0, f"{self.name}: lengths are rounded to {step!r}; give a length above zero, such as 1mm.")
        bodies = *self.links.values(), *(each.ends for each in self.drives.values())
        pairs = [(points[0], each) for points in bodies for each in points[1:]]  # from the first point: so a flat body does not bend
        free = [pair for pair in pairs if not {*pair} <= {*self.fixed}]
        lengths = {joined_names(P, Q): in_steps(self.length(P, Q), step) for P, Q in free}
        for drive in self.drives.values():
            if drive.kind == "cylinder":
                lengths[joined_names(*drive.ends)] = in_steps(self.length(*drive.ends) - drive.drawn, step)
        for label, value in lengths.items():
            ensure(value > 0.0, f"{self.name}: {label} rounds to nothing in steps of {show(step, 'mm')}; take a finer step.")
        places = dict(self.points)
        corners = [(points[0], points[1], each) for points in self.links.values() for each in points[2:] if not {*points} <= {*self.fixed}]
        angles = dict[str, float]()
        for O, P, Q in corners:
            turn = remainder(line_angle(places[O], places[Q]) - line_angle(places[O], places[P]), 2.0 * pi)
            angles[joined_names(P, O, Q)] = round_angle(turn, step / self.length(O, Q))
        slides, rounds = dict(self.slides), [*self.fixed]
        for name, each in self.slides.items():
            if not isinstance(each.along, tuple):
                slides[name] = replace(each, along=round_angle(each.along, step / self.size))
                rounds.append(each.point)
        for name in rounds:
            x, y = (in_steps(each, step) for each in places[name])
            places[name] = x, y
        put = replace(self, points=places, lengths=lengths, angles=angles, slides=slides)
        strokes: dict[str, Any] = {name: drive.drawn for name, drive in self.drives.items()}
        motion = put.to_class()().at(**strokes)
        settled = {name: (float(motion.x(name)), float(motion.y(name))) for name in self.points}
        settled |= {name: places[name] for name in self.fixed}
        moved = {name: dist(place, self.points[name]) for name, place in settled.items()}
        most = max(moved, key=lambda each: moved[each])
        note = f"Lengths are rounded to {show(step, 'mm')}; {most} moves most, by {show(moved[most], 'mm', 3)}."
        return replace(put, points=settled, notes=(*self.notes, note))


def values_told(entry: object) -> Iterator[object]:
    """Yield the points' names and the numbers of an entry of a sketch, one by one; a size that is not given is none of them."""
    own = {name: each for name, each in vars(entry).items() if name != "kind" and each is not None} if is_dataclass(entry) else {"": entry}
    for each in own.values():
        yield from each if is_listed(each) else (each,)


def longer_side(places: Iterable[Place]) -> float:
    """Return the longer side of the box around some places, 0 around none, in their units."""
    return max((max(part) - min(part) for part in zip(*places, strict=True)), default=0.0)


def line_angle(P: Place, Q: Place) -> float:
    """Return the angle of the line from one place to another [rad]."""
    return atan2(Q[1] - P[1], Q[0] - P[0])


def round_angle(angle: float, least: float) -> float:
    """Return an angle in whole degrees, or tenths, hundredths ... of one, the first that are finer than a least angle [rad]."""
    step = 10.0 ** min(0, floor(log10(degrees(least))))
    return radians(in_steps(degrees(angle), step))


def in_steps(value: float, step: float) -> float:
    """Return the multiple of a step that is nearest to a value, without the last digits that one of a decimal step brings."""
    return float(f"{round(value / step) * step:.12g}")


def written(value: float) -> str:
    """Return a number in 15 digits where these say it within 1e-15 of itself, without the noise of a unit's factor; else in all."""
    text = f"{value:.15g}"
    return text if abs(float(text) - value) <= 1e-15 * abs(value) else repr(float(value))


def noiseless(value: float) -> float:
    """Return a number as it is written; zero without a sign."""
    return float(written(value)) + 0.0


def plain_entry(entry: object) -> Any:
    """Return an entry of a table with lists for tuples, and Python's own numbers for NumPy's."""
    if isinstance(entry, dict):
        return {name: plain_entry(each) for name, each in entry.items()}
    return [*map(plain_entry, entry)] if is_listed(entry) else plain(entry)


def python_number(value: float | str) -> str:
    """Return a number as Python has it, `360 * deg` for the text `360 deg`."""
    return value.replace(" ", " * ") if isinstance(value, str) else repr(float(value))


def python_member(section: str, table: Mapping[str, Any]) -> str:
    """Return the call that makes a member of a section."""
    given = {name: value for name, value in table.items() if name not in ("points", "from", "to", "point", "guide", "at", "Crank")}
    words = [f"{name}={value.replace(' deg', ' * deg') if isinstance(value, str) else repr(value)}" for name, value in given.items()]
    at = [f"at=({', '.join(map(repr, table['at']))})"] if "at" in table else []
    match section:
        case "points":
            return f"Crank({', '.join([table['Crank'], *at, *words])})"
        case "pins":
            return f"Pin({at[0]})"
        case "links":
            return f"Link({', '.join([quoted(table['points']), *words])})"
        case "surroundings":
            carried = f", on={quoted(table['on'])}" if "on" in table else ""
            return f"Outline({table['points']!r}{carried})"
        case "guides":
            given_ends = (table[name] for name in ("from", "to") if name in table)
            ends = [quoted(end) if isinstance(end, str) else repr((*end,)) for end in given_ends]
            return f"Guide({', '.join([*ends, *words])})"
        case "hydraulics":
            return f"Cylinder({', '.join(table['Cylinder'])}, bore={table['bore']!r}, rod={table['rod']!r})"
        case "loads" if "Force" in table:
            return f"Force({table['Force']}, {(*table['vector'],)})"
        case "loads":
            return f"Weight({table['Weight']}, mass={table['mass']!r})"
    return f"Slide({quoted(table['point'])}, {table['guide']})"
