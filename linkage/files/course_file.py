"""Paths in time as files say them: `lift = { ramp = ["100 mm", "300 mm"], speed = "150 mm/s" }`, and tables of rows."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from pathlib import Path
from typing import Any

from ..errors import DefinitionError, cited, ensure, known_name, require, require_type, unknown
from ..quantities import Course, Curve, is_number, ramp
from ..units import UNITS, Amount, units_of
from .design import degrees_text
from .expression import one_unit
from .source import FileTable, Keywords, Names, measured_columns
from .validators import amount_of

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
