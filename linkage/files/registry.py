"""Which classes of members a file may hold, and in which section. A package adds its own by entry points of `hydrolinkage.files`.

A class that nobody has registered is named by its import path, `kind = "mypackage.cams:CamFollower"`. A file is data: such a class is
looked up among what is imported already; only a package that the reader trusts by name is imported for it.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Callable, Collection, Mapping
from functools import cached_property, lru_cache
from importlib import import_module
from math import isfinite
from pathlib import Path
from types import ModuleType
from typing import Any, TypeAlias

from .. import loads, plugins, steps, surroundings
from ..errors import DefinitionError, cited, ensure, is_class_of, known_name, require, require_type, unknown
from ..frozen import record
from ..motion import OPTIONS, Over, Planes, stroke_unit
from ..plan import Part
from ..quantities import Course, Curve, Dimension, Member, PoseCondition, Quantity, Stroke, is_number, quantity, ramp, ref
from ..quantities.quantity import plain
from ..statics import Rope
from ..units import UNITS, Amount, parse, units_of
from .design import Design, degrees_text, in_unit
from .entry import (
    PATH,
    FileEntry,
    amount_of,
    arrow_of,
    coordinates_of,
    number_of,
    points_of,
    quantity_of,
    stroke_ends,
    strokes_of,
    word_list_of,
    worded,
)
from .expression import expression, one_unit
from .parts_file import part_read, part_written
from .source import FileTable, Keywords, Names, by_whole_names, listed, measured_columns

STEPS: Mapping[str, Collection[str]] = {
    "ramp": ("speed", "acceleration", "jerk"),
    "hold": (),
    "phases": ("times", "end"),
    "times": ("values", "kind", "period"),
}
"""What a step of a course is known by, and what else stands in its table."""
MEASURES: Mapping[str, Collection[str]] = {
    "hold": ("time",), "times": ("time",), "period": ("time",), "speed": ("speed", "angular speed"),
    "acceleration": ("acceleration", "angular acceleration"), "jerk": ("jerk", "angular jerk"),
    "ramp": ("length", "angle"), "values": ("length", "angle"), "end": ("length", "angle"),
}  # fmt: skip
"""What the numbers of a step measure."""


def is_course(given: object) -> bool:
    """Return whether a stroke is given a course: a table, or a list of such."""
    return isinstance(given, Mapping) or (isinstance(given, list) and any(isinstance(each, Mapping) for each in given))


def course_read(given: object, names: Names) -> Course | Curve:
    """Return the course that a table says, or several one after the other; DefinitionError, with the key, for anything else."""
    tables = given if isinstance(given, list) else [given]
    found: Course | None = None
    for table in tables:
        step = step_read(table, names)
        if isinstance(step, Curve):
            ensure(len(tables) <= 1, "a curve with a period stands alone: it goes on over the whole path.")
            return step
        if isinstance(step, float):
            if found is None:
                raise DefinitionError("hold goes on from what stands before it; begin with a ramp or with times and values.")
            found = found.hold(step)
        else:
            found = step if found is None else found.then(step)
    if found is None:
        raise DefinitionError("it is empty; write a ramp, or times and values.")
    return found


def step_read(table: object, names: Names) -> Course | Curve | float:
    """Return one step of a course; the seconds of a hold."""
    table = require_type("", table, Mapping, 'is no step of a course; write { ramp = ["100 mm", "300 mm"], speed = "150 mm/s" }')
    kind = next((each for each in STEPS if each in table), None)
    if kind is None:
        raise unknown("Step", next(iter(table), ""), STEPS)
    for key in table:
        known_name("Key", key, (kind, *STEPS[kind]))
    numbers = {key: value if key == "kind" else numbers_read(key, value, names) for key, value in table.items()}
    if kind == "hold":
        require(is_number(numbers["hold"]), "", table["hold"], "is not a number of seconds")
        return float(numbers["hold"])
    if kind == "ramp":
        ends = numbers.pop("ramp")
        if not isinstance(ends, list) or len(ends) != 2 or "speed" not in numbers:
            raise DefinitionError('a ramp has two ends and a speed, { ramp = ["100 mm", "300 mm"], speed = "150 mm/s" }.')
        return ramp(*ends, **numbers)
    wanted = "phases" if kind == "phases" else "values"
    ensure({"times", wanted} <= numbers.keys(), f"times and {wanted} stand beside each other, as many of each.")
    if kind == "phases":
        return Course.of_phases(numbers["times"], numbers["phases"], numbers.get("end"))
    if "period" in numbers:
        return Curve(numbers["times"], numbers["values"], period=numbers["period"])
    return Course(numbers["times"], numbers["values"], numbers.get("kind", "smooth"))


def numbers_read(key: str, given: object, names: Names) -> Any:
    """Return a number of a step [SI], or a list of such; DefinitionError for a unit that measures something else.

    One with a unit knows whether it is of a length or of an angle, so that a course knows what it moves.
    """
    if isinstance(given, list):
        return [numbers_read(key, each, names) for each in given]
    unit, measures = one_unit(given) if isinstance(given, str) else "", MEASURES.get(key, ())
    if unit and UNITS[unit][1] not in measures:
        fits = units_of(*measures)
        raise DefinitionError(f"{key} = {cited(given)}: use one of {', '.join(fits)}." if fits else f"{key} has no units.")
    found = amount_of(given, names, "")
    ensure(is_number(found), f"{key} = {cited(given)}: a number is expected; a course follows no dimension.")
    if not unit or "time" in measures:
        return float(found)
    return Amount(found, "angle" if UNITS[unit][1].startswith("ang") else "length")


def course_written(course: Course | Curve, is_angle: bool) -> Keywords | list[Keywords]:
    """Return a course as a table, or as a list of such; each number reads back as the same."""

    def value(number: Any) -> Any:
        return [value(each) for each in number] if isinstance(number, tuple) else degrees_text(number) if is_angle else number

    if isinstance(course, Curve):
        found: Keywords = {"times": course.xs.tolist(), "values": value(tuple(course.ys.tolist()))}
        return found | ({} if course.period is None else {"period": course.period})
    tables = [
        {key: value(each) if key in ("ramp", "values", "end") else listed_all(each) for key, each in step.items()} for step in course.steps
    ]
    return tables[0] if len(tables) == 1 else tables


def listed_all(value: object) -> object:
    """Return tuples as lists, through all depths."""
    return [listed_all(each) for each in value] if isinstance(value, tuple) else value


def rows_read(name: object, folder: Path | None, strokes: Collection[str]) -> FileTable:
    """Return the time and the strokes of a table of rows, as `export` writes a motion in time: the first line says names and units.

    What is neither is passed over. DefinitionError for a file that cannot be read, or that says no time or no stroke.
    """
    if folder is None or not isinstance(name, str) or Path(name).name != name:
        raise DefinitionError(f"csv = {cited(name)}: a table stands in the folder of the file that names it; give its name alone.")
    measures = {stroke: MEASURES["values"] for stroke in strokes} | {"time": MEASURES["times"]}
    found = measured_columns(folder / name, f"csv = {name}", lambda column: measures.get(column, ()))
    if "time" not in found or len(found) < 2:
        raise DefinitionError(f'csv = {name}: columns "time, s" and of a stroke are expected, such as "{next(iter(strokes), "S")}, m".')
    return found


# -- where a machine is looked at: `[over.loading]` with strokes, `path`, `poses`, `time`, `csv`, `only`, `cases`, `lost` --------

SHAPES = ("path", "poses")
"""What says that strokes are places in an order, or poses with nothing between, where it is true."""
_COMPARED = re.compile(r"([^<>=!]+)(<=|>=)([^<>=!]+)")


def over_read(given: object, names: Names) -> Over:
    """Return the `Over` of a table; DefinitionError, with the key, for a wrong one."""
    given = require_type("", given, Mapping, 'is not a table of strokes, such as { phi = ["15 deg", "80 deg"], t = 0.0 }')
    given, known = dict(by_whole_names(given, tuple(STEPS))), names.strokes
    if "csv" in given:
        given = {**rows_read(given.pop("csv"), names.folder, known), **given}
    shapes = [word for word in SHAPES if isinstance(given.get(word), bool)]
    for key in given:
        if key not in (*known, *OPTIONS, *shapes):
            what = f"{key} is true or false; leave it out for a box." if key in SHAPES else str(unknown("Stroke", key, known))
            raise DefinitionError(f"{what} Beside strokes there are {', '.join((*SHAPES, *OPTIONS, 'csv'))}.")
    chosen = [word for word in shapes if given[word]]
    ensure(len(chosen) <= 1, "it is a path and poses at once; a path goes on between its places, poses have nothing between them.")
    is_timed = "time" in given or any(map(is_course, given.values()))
    make = {"path": Over.path, "poses": Over.poses}.get(chosen[0] if chosen else "path" if is_timed else "", Over)
    options: Keywords = {key: given[key] for key in ("cases", "lost") if key in given}
    if "time" in given:
        options["time"] = numbers_read("times", given["time"], names)
    if "only" in given:
        options["only"] = [condition_of(text, names) for text in listed(given["only"])]
    for key, value in given.items():  # of a stroke one value or several: numbers [SI], texts with a unit, quantities of the design
        if key in known and is_course(value):
            options[key] = course_read(value, names)
        elif key in known:
            options[key] = tuple(amount_of(each, names, "") for each in value) if isinstance(value, list) else amount_of(value, names, "")
    made: Over = make(**options)
    return made


def condition_of(text: object, names: Names) -> PoseCondition:
    """Return the condition on poses that a text says, `x(T) <= 4`; DefinitionError for any other."""
    found = _COMPARED.fullmatch(text) if isinstance(text, str) else None
    if found is None:
        raise DefinitionError(f'{cited(text)} is no condition on poses; write a comparison in quotes, "x(T) <= 4", with <= or >=.')
    left, right = (expression(found.group(side).strip(), names) for side in (1, 3))
    require(not (left.is_constant and right.is_constant), "", text, "compares two numbers; one side is a quantity such as x(T)")
    if left.constant is not None:
        return PoseCondition(right, {"<=": ">=", ">=": "<="}[found.group(2)], left.constant)
    return PoseCondition(left, found.group(2), right if right.constant is None else right.constant)


def over_written(member: Over, design: Design) -> Keywords:
    """Return where is looked as a table; DefinitionError for a condition that a file cannot hold."""
    found: Keywords = {} if member.shape == "box" else {member.shape: True}
    if member.time is not None:
        found["time"] = [*member.time]
    for name, value in member.strokes.items():
        if isinstance(value, (Course, Curve)):
            found[name] = course_written(value, stroke_unit(design.plan, name) == "rad")
            continue
        parts: list[float | str] = []
        for each in listed(value):
            parts.append(stroke_value(float(each), name, design) if is_number(each) else design.scalar(quantity(each)))
        found[name] = parts if isinstance(value, tuple) else parts[0]
    only = []
    for condition in member.only:
        for side in (condition.left, condition.right):
            what = f"only=[{condition}]: a file holds conditions of quantities such as x(T) or a named output, and {side} is a request"
            ensure(is_number(side) or isinstance(side, (str, Quantity)), f"{what}; take the condition out, or keep the class in Python.")
        left, right = (design.scalar(quantity(side)) for side in (condition.left, condition.right))
        only.append(f"{left} {condition.symbol} {right}")
    options = {"only": only, "cases": list(member.cases or ()), "lost": member.lost}
    return found | {key: value for key, value in options.items() if value}


# -- sections and examples ---------------------------------------------------------------------------------

SHIPPED = {"hydraulics": "hydrolinkage"}
"""Sections that packages beside this one bring, each with what to install for it."""

EXAMPLES = {
    "points": '`B = { Dyad = ["A", "O"], AB = "L0 + S", OB = 0.30, side = "RIGHT" }`',
    "loads": '`load = { Weight = "G", mass = 1200 }`',
}
LINK_POINTS = 26
LONGER = 4  # characters that a dimension may be longer in its unit than in SI


# -- entries that are no tables ----------------------------------------------------------------------------


@record
class Bare:
    """How the members of a class stand in a file without keys, such as `A = [0.2, 0.55]`; the only class of its section."""

    describes: type[Any]
    section: str
    read: Callable[[Any, Names], Member]
    write: Callable[[Any, Design], Any]
    family: bool = False
    word: str = ""
    example: str = ""


def stroke_written(member: Stroke, design: Design) -> list[float | str]:
    """Return a stroke's ends."""
    return [stroke_value(end, member.name, design) for end in (member.start, member.end)]


def stroke_value(value: float, stroke: str, design: Design) -> float | str:
    """Return a value of a stroke, that of an angle in degrees, of oil in litres."""
    unit = stroke_unit(design.plan, stroke)
    return degrees_text(value) if unit == "rad" else in_unit(value, "litre") if unit == "m3" else value


def dimension_of(given: object, names: Names) -> Dimension:
    """Return a dimension with the unit it is shown in: a number [SI], `500 mm`, or { value = 0.5, unit = "mm" }."""
    match given:
        case {"value": value, **others} if not others.keys() - {"unit"} and isinstance(others.get("unit", ""), str):
            return Dimension(number_of(value, names), str(others.get("unit", "")))
        case Mapping():
            raise DefinitionError(f'{cited(dict(given))}: a dimension is a number, "500 mm", or {{ value = 0.5, unit = "mm" }}.')
    return Dimension(number_of(given, names), one_unit(given) if isinstance(given, str) else "")


def dimension_written(member: Dimension, design: Design) -> Any:
    """Return a dimension in its unit where that is exact and short."""
    value = design.set.get(member.name, member.default)
    design.written.add(member.name)
    if not member.unit:
        return value
    shown = value / UNITS[member.unit][0]
    texts = [f"{shown:.12g}", *([repr(shown)] if len(repr(shown)) <= len(repr(value)) + LONGER else [])]
    found = (f"{text} {member.unit}" for text in texts if isfinite(shown) and parse(f"{text} {member.unit}") == value)
    return next(found, {"value": value, "unit": member.unit})


def output_of(given: object, names: Names) -> Quantity:
    """Return the quantity that an expression says; of a name alone one that follows it."""
    found = quantity_of(given, names)
    return ref(found.name) if found.name else found


def vector_of(given: object, names: Names) -> steps.Arrow:
    """Return the vector that a text says; DefinitionError for the name of one."""
    found = arrow_of(given, names)
    if isinstance(found, str):
        raise DefinitionError(f"{found} is a vector already; use that name.")
    return found


def drawn_written(member: steps.Drawn, design: Design) -> Keywords:
    """Return the strokes at which a sketch holds, angles in degrees."""
    return {name: stroke_value(plain(value), name, design) for name, value in member.strokes.items()}


def ground_written(member: steps.Ground, design: Design) -> list[float | str]:
    """Return the coordinates of a fixed point."""
    return [design.variable(name, value) for name, value in member.coordinates()]


def group_written(member: steps.Group, design: Design) -> str:
    """Return the names of a group's pins in one text."""
    return " ".join(member.pins)


def link_of(*points: str, **labels: Any) -> steps.Link:
    """Return a link; DefinitionError for one of one point, or of more than any has."""
    ensure(len(points) <= LINK_POINTS, f"a link of {len(points)} points; up to {LINK_POINTS} are read.")
    ensure(len(points) >= 2, f"a link joins at least two points, not {' '.join(points)} alone.")
    return steps.Link(*points, **labels)


def planes_read(given: object, names: Names) -> Planes:
    """Return the planes that an entry says: `{ planes = ["OBC AB", "CD EDF"], width = "60 mm" }`."""
    expected = 'write { planes = ["OBC AB", "CD EDF"], width = "60 mm" }'
    given = require_type("", given, Mapping, expected)
    require("planes" in given and given.keys() <= {"planes", "width"}, "", given, expected)
    return Planes(*word_list_of(given["planes"], names), width=quantity_of(given.get("width", 0.0), names))


def planes_written(member: Planes, design: Design) -> Keywords:
    """Return the planes of bodies, and the width of two bars where it is not nothing."""
    width = design.amount(member.width, "mm", f"{member.name}.width")
    return {"planes": list(member.planes)} | ({"width": width} if width else {})


AnEntry: TypeAlias = FileEntry | Bare

POINTS = (
    steps.Dyad, steps.OnLink, steps.Crank, steps.Offset, steps.SliderDyad, steps.PinSlotDyad, steps.GuideCross, steps.YokeDyad,
    steps.OnGuide, steps.Carried,
)  # fmt: skip
LOADS = (
    loads.Weight, loads.Force, loads.Moment, loads.LinkMass, loads.Spring, loads.Damper, loads.Actuator, loads.Support,
    loads.PinFriction, loads.GuideFriction, loads.Pulley,
)  # fmt: skip
OUTLINES = (
    (surroundings.Outline, "points"), (surroundings.CircleOutline, "circle"), (surroundings.LineOutline, "line"),
    (surroundings.DxfOutline, "dxf"), (surroundings.ImageOutline, "image"),
)  # fmt: skip
OWN: tuple[AnEntry, ...] = (
    Bare(Stroke, "strokes", lambda given, names: Stroke(*stroke_ends(given, names)), stroke_written),
    Bare(Dimension, "dimensions", dimension_of, dimension_written),
    Bare(steps.Drawn, "drawn", lambda given, names: steps.Drawn(strokes_of(given, names)), drawn_written),
    Bare(steps.Ground, "ground", lambda given, names: steps.Ground(*coordinates_of(given, names)), ground_written),
    Bare(Part, "parts", part_read, part_written),
    FileEntry(steps.Guide, "guides", keys={"P": "from", "Q": "to"}),
    *(FileEntry(step, "points", step.__name__) for step in POINTS),
    Bare(steps.Arrow, "vectors", vector_of, lambda member, design: design.own(member), family=True),
    FileEntry(steps.Link, "links", make=link_of),
    FileEntry(steps.Pin, "pins"),
    FileEntry(steps.Slide, "slides"),
    Bare(steps.Group, "groups", lambda given, names: steps.Group(" ".join(points_of(given, names))), group_written),
    Bare(Quantity, "outputs", output_of, lambda member, design: member.number if member.is_constant else design.own(member), family=True),
    *(FileEntry(load, "loads", load.__name__) for load in LOADS),
    FileEntry(Rope, "loads", "Rope"),
    FileEntry(loads.LoadCase, "cases"),
    Bare(Over, "over", over_read, over_written),
    Bare(Planes, "planes", planes_read, planes_written),
    *(FileEntry(outline, "surroundings", word) for outline, word in OUTLINES),
)


# -- all that there are ------------------------------------------------------------------------------------


@record
class Registry:
    """The entries there are, by section and word for reading, by class for writing."""

    entries: tuple[AnEntry, ...]

    @cached_property
    def sections(self) -> Mapping[str, Mapping[str, AnEntry]]:
        """The sections in their usual order, each with its entries by word."""
        found: dict[str, dict[str, AnEntry]] = {}
        for entry in self.entries:
            words = found.setdefault(entry.section, {})
            if entry.word in words or (words and "" in {entry.word, *words}):
                raise DefinitionError(f"[{entry.section}] {entry.word}: {entry.describes.__name__} takes a word that is taken.")
            words[entry.word] = entry
        return found

    def kind(self, section: str) -> str:
        """Return the kind of a section's members: `point`, `quantity`, ..."""
        found: str = next(iter(self.sections[section].values())).describes.kind
        return found

    def reading(self, section: str, given: Any, trust: Collection[str] = ()) -> AnEntry:
        """Return how an entry of a section is read; DefinitionError where its word is missing, unknown or not the only one."""
        words = self.sections[section]
        if "" in words:
            return words[""]
        table: Mapping[Any, Any] = given if isinstance(given, Mapping) else {}
        found = [word for word in words if word in table]
        if PATH in table and (not found or ":" in str(table[PATH])):  # beside a word it may be a label
            found.append(PATH)
        ensure(len(found) <= 1, f"it is {' and '.join(found)} at once; say one of them.")
        if found == [PATH]:
            return FileEntry(class_of(given[PATH], section, trust), section, path=table[PATH])
        if found:
            return words[found[0]]
        example = EXAMPLES.get(section) or next(iter(words.values())).example
        key = next((key for key in table if isinstance(key, str)), "")
        what = unknown("Kind", key, words) if key else f"{cited(given)} is no entry of [{section}]."
        others = [(word, other) for other, known in self.sections.items() for word in known if word and word in table]
        elsewhere = f" {others[0][0]} stands in [{others[0][1]}]." if others else ""
        raise DefinitionError(f"{what} Write it like {example}.{elsewhere}{self.absent()}")

    def absent(self) -> str:
        """Return which packages of this distribution are not registered, in words; "" where all are."""
        return "".join(
            f" The kinds of [{section}] are not registered here: install {package}, which brings them (pip install {package})."
            for section, package in SHIPPED.items()
            if section not in self.sections
        )

    def writing(self, member: Member) -> AnEntry:
        """Return how a member is written; DefinitionError where a file cannot hold it."""
        cls = type(member)
        by_class = {entry.describes: entry for entry in self.entries}
        found = next((by_class[base] for base in cls.__mro__ if base in by_class), None)
        if found is not None and (found.family or found.describes is cls):
            return found
        path, why = f"{cls.__module__}:{cls.__qualname__}", ""
        if worded(cls) and cls.file_section in self.sections:
            if imported(path) is cls:
                return FileEntry(cls, cls.file_section, path=path)
            why = f" A file names such a class by its import path, but {path} leads to none: define it in a module, outside functions."
        raise DefinitionError(f"{member.name} = {member}: a file cannot hold a {cls.__name__}.{why}{self.absent()}")


@lru_cache(maxsize=1)
def registry() -> Registry:
    """Return the entries of this package and of those that are installed beside it; DefinitionError for one that cannot be loaded."""
    points = plugins.entry_points(plugins.MEMBERS).items()
    brought = [plugins.guarded(point.load, f"the entry {name} ({point.value}) of a file") for name, point in points]
    return Registry((*OWN, *(FileEntry(cls, cls.file_section, cls.__name__ if worded(cls) else "") for cls in brought)))


# -- classes that are named by their import path -----------------------------------------------------------


def class_of(path: Any, section: str, trust: Collection[str]) -> type[Member]:
    """Return the class that an import path names; DefinitionError unless it is imported already or its package is trusted."""
    module, colon, name = path.partition(":") if isinstance(path, str) else ("", "", "")
    if not colon or not all(part.isidentifier() for part in (*module.split("."), *name.split("."))):
        raise DefinitionError(f'{cited(path)} is no import path of a class; write "package.module:Class".')
    if module not in sys.modules and any(module == each or module.startswith(f"{each}.") for each in trust):
        try:
            import_module(module)
        except Exception as error:
            raise DefinitionError(f"{module} cannot be imported: {type(error).__name__}: {error}.") from error
    if module not in sys.modules:
        package = module.partition(".")[0]
        words = f"{path} is not imported, and a file runs no code unasked; import {module} first"
        raise DefinitionError(f'{words}, or say load(..., trust=["{package}"]) if you trust that package.')
    found = imported(path)
    if not is_class_of(found, Member) or not worded(found) or found.file_section != section:
        raise DefinitionError(f"{path} is no class of members that stand in [{section}].")
    if any(getattr(getattr(found, name), "__isabstractmethod__", False) for name in dir(found)):
        raise DefinitionError(f"{path} is abstract; name a class that can be made.")
    return found


def imported(path: str) -> Any:
    """Return the object of an import path among the modules imported already, without running any code; None where there is none."""
    module, _, name = path.partition(":")
    found: Any = sys.modules.get(module)
    for part in name.split("."):
        found = vars(found).get(part) if isinstance(found, (ModuleType, type)) else None
    return found
