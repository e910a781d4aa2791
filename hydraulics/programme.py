"""A working cycle as a file: demands of cylinders on one pump, in TOML, or a table of speeds over time."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from linkage import LoadCase, Mechanism
from linkage.errors import DefinitionError, cited, ensure, known_name, require
from linkage.files.source import FileTable, Source, by_whole_names, measured_columns, source
from linkage.frozen import immutable
from linkage.motion import stroke_measure
from linkage.quantities import Course, Reference, is_number
from linkage.units import parse

from .consumers import lines_on
from .cylinders import Ram
from .pump import Pump
from .working import Demand

KEYS = ("pump", "until", "case", "start", "demands")
EXAMPLE = '[demands] with "boom.ram" = "0.15 m/s", or rows of instants and speeds, [["0 s", "0.15 m/s"], ["2 s", "0 m/s"]]'


@immutable
class Programme:
    """Demands on a pump: `demands` by cylinders, `start` by strokes, the end `until` [s], the load case."""

    pump: Pump
    demands: Mapping[Reference, Demand]
    until: float
    start: Mapping[str, float]
    case: str | None = None


def programme_read(machine: Mechanism, file: str) -> Programme:
    """Return the programme that a file says, .toml or .csv.

    Raises
    ------
    FileError
        The file cannot be read, or says something else; with the line.
    DefinitionError
        The machine has no pump on its lines, or several and the file names none.
    """
    path, until, start, demands = Path(file), 1.0, dict[str, float](), dict[Reference, Demand]()
    if path.suffix.lower() == ".csv":
        columns = measured_columns(path, path.name, lambda name: ("time" if name == "time" else "speed",))
        time = columns.pop("time", [])
        if len(time) < 2 or not columns:
            raise DefinitionError(
                f'{path.name}: two rows and the columns "time, s" and of a cylinder are expected, such as "boom.ram, m/s".'
            )
        demands |= {name: Course(time, [*map(float, values)], "straight") for name, values in columns.items()}
        return Programme(pump_of(machine, None), demands, float(time[-1]), {})
    faults = source(path)
    data = faults.data
    for key in data:
        with faults.at_key(key):
            known_name("Key", key, KEYS)
    with faults.at_key("until"):
        ensure("until" in data, 'it is missing; say when the programme ends, until = "4 s".')
        until = si_number(data["until"], "time")
        require(until > 0.0, "until", data["until"], 'an instant behind 0 s is expected, until = "4 s"')
    for name, given in table_under("start", data, faults).items():
        with faults.at_key("start", *name.split(".")):
            known_name("Stroke", name, machine.strokes)
            start[name] = si_number(given, stroke_measure(machine.plan, name))
    for name, given in table_under("demands", data, faults).items():
        with faults.at_key("demands", *name.split(".")):
            demands[known_name("Cylinder", name, machine.plan.of_kind(Ram))] = demand_read(given, until)
    with faults.at_key("case"):
        case = data.get("case")
        case = None if case is None else known_name("Load case", case, machine.plan.of_kind(LoadCase))
    faults.check()
    ensure(demands, f"{path.name}: nothing is asked for; write {EXAMPLE}.")
    return Programme(pump_of(machine, data.get("pump")), demands, until, start, case)


def table_under(key: str, data: FileTable, faults: Source) -> FileTable:
    """Return a table of a file, an empty one where there is none; parts within it, `[demands.boom] ram`, by their whole names."""
    given = data.get(key, {})
    if isinstance(given, Mapping):
        return dict(by_whole_names(given))
    faults.add((key,), f"{cited(given)} stands where a table is expected, such as {EXAMPLE}.")
    return {}


def si_number(given: object, kind: str) -> float:
    """Return a number of a file [SI], with its unit or without."""
    return float(given) if is_number(given) else parse(given, kind)  # type: ignore[arg-type]


def demand_read(given: object, until: float) -> Demand:
    """Return a cylinder's demand: one speed, "max", or rows of instants, each with the speed that holds from there on."""
    if given in ("max", "inf", np.inf):
        return np.inf
    if given in ("-max", "-inf", -np.inf):
        return -np.inf
    if not isinstance(given, list):
        return si_number(given, "speed")
    fits = all(isinstance(row, list) and len(row) == 2 for row in given)
    require(fits and given, "", given, 'is no list of rows, each an instant and a speed, such as ["2 s", "0.1 m/s"]')
    times, speeds = [si_number(row[0], "time") for row in given], [si_number(row[1], "speed") for row in given]
    ensure(times[-1] < until, f"the last row begins at {times[-1]:g} s, and the programme ends at {until:g} s; give a later `until`.")
    if times[0] > 0.0:
        times, speeds = [0.0, *times], [0.0, *speeds]
    return Course.of_phases([*times, until], [speeds])


def pump_of(machine: Mechanism, name: object) -> Pump:
    """Return the pump of a machine that has a name; without one its only pump that is on lines."""
    plan = machine.plan
    pumps = {key: each for key, each in plan.of_kind(Pump).items() if lines_on(each, plan.members)}
    if name is not None:
        return pumps[known_name("Pump", name, pumps, where=plan.title)]
    ensure(pumps, f"{plan.title} has no pump on its lines; declare one, supply = Pump(200 * bar, flow=60 * litre / minute).")
    which = f'pump = "{next(iter(pumps))}" or --pump'
    ensure(len(pumps) == 1, f"{plan.title} has the pumps {', '.join(pumps)}; say which one, {which}.")
    return next(iter(pumps.values()))
