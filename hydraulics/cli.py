"""`hydrolinkage capacity NAME`, the largest load that a pump lifts, and `cycle NAME`, a working cycle on one pump."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np

from linkage import Acting, ForceElement, Mechanism, Verdict
from linkage.cli.command import CSV, EVERY, PICTURES, Command, machine_options, option, picture, pose_options
from linkage.cli.follow import ALONG, PAGE
from linkage.cli.settings import CHECK, OVER, judged_code, judged_over, machine_of, motions_at, overs_of, print_verdicts, si_value
from linkage.cli.table import Table, heading_words, write_table, write_tables
from linkage.errors import DefinitionError, cited, ensure, known_name, require
from linkage.files.source import FileTable, Source, by_whole_names, measured_columns, source
from linkage.frozen import immutable
from linkage.language import noted, said
from linkage.motion import Column, Judge, Motion, case_named, columns_of, least, stroke_measure
from linkage.motion.limits import stroke_unit, timed_texts
from linkage.quantities import Course, Reference, is_number
from linkage.shown import text_columns
from linkage.statics import LawRequest, elements_of, is_among, pull_direction
from linkage.units import g0, parse, show

from .consumers import lines_on
from .cycle import PumpCycle, judged_cycles
from .cycle_chart import cycle_columns, energy_rows, line_heads, line_rows, plot_cycle
from .cylinders import Ram, found_in
from .inputs import one_design, proper_share
from .lift import LiftCircuit, PumpLine, line_verdicts
from .pump import Pump
from .requests import capacity_request, circuit_with
from .working import Demand

# A working cycle as a file: demands of cylinders on one pump, in TOML, or a table of speeds over time.

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
        case = None if case is None else case_named(machine.plan, case)
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
    if str(given).removeprefix("-") in ("max", "inf"):
        return -np.inf if str(given).startswith("-") else np.inf
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


FURTHER = noted("further load")
"""What is lifted beside the machine's own loads: not what a machine calls its lifting capacity, in which these count."""


CapacityCommand = Command(
    "capacity",
    "the largest load that the pump lifts at a point of a machine, beside its own, and what limits it",
    *machine_options(),
    option("--at-point", metavar="G", help="where the load hangs (default: where the machine's own load does)"),
    option("--along", metavar="0,1", default="0,1", help="the direction it is lifted in, x and y (default 0,1, upwards)"),
    option("--cylinder", metavar="LIFT", help="the cylinder that lifts, where there are several"),
    option("--circuit", metavar="CIRCUIT", help="the circuit that feeds it, where several do"),
    option("--pressure", metavar="180bar", help="this pressure without losses instead of a circuit's, gauge"),
    option("--share", metavar="0.9", type=float, default=1.0, help="share of the pressure (default 1)"),
    option("--case", metavar="CASE", help="the machine's own load in this load case"),
    CSV,
    *pose_options(11),
    EVERY,
    OVER,
    CHECK,
)


@CapacityCommand
def print_capacity(options: Namespace) -> int:
    """Print the load that a machine lifts at a point, and its limit."""
    machine = machine_of(options)
    ram = cylinder_of(machine, options.cylinder)
    circuit, point = circuit_of(machine, ram, options), point_of(machine, options.at_point)
    share = options.share
    proper_share(share)
    try:
        x, y = (float(each) for each in options.along.split(","))
    except ValueError:
        raise DefinitionError(f"--along {options.along}: two numbers are expected, x and y, such as 0,1 for upwards.") from None
    along = x, y
    unit = pull_direction(along, "--")
    case = None if options.case is None else case_named(machine.plan, options.case)
    motions, tables = motions_at(machine, options), list[Table]()
    for run, over in motions:
        whole = over._with_gaps()
        further = circuit.lifted(whole, point, along=along, share=share, cylinder=ram, case=case)
        places = (*over.strokes, f"{point}_x", f"{point}_y")
        shown = [each for each in columns_of(over) if each.name in places]
        columns = [*shown, *ram.columns_in(whole, case), Column(FURTHER, further, "kN", 3)]
        tables.append((heading_words(machine, None if run is None else replace(run, case=None), over), columns, ()))
    if options.csv != "-":
        supply = show(one_design(circuit.supply(motions[0][1])), "bar", 4)
        way = f"along ({x:g}, {y:g}) at {f'{share:g} of ' if share != 1.0 else ''}{supply}"
        print(f"{machine.plan.title}: {ram.name} lifts at {point} {way}, beside the machine's own loads. Pressures are gauge.\n")
    write_tables(tables, options.csv)
    if options.csv == "-" and not options.check:
        return 0
    judge = machine.judge(judged_over(machine, options), Acting(case=case))
    asked = capacity_request(ram, Acting(), circuit, point, unit, share)
    return print_verdicts([capacity_verdict(judge, asked, point), *line_verdicts(circuit, judge), *ram.verdicts(judge)], options)


def cylinder_of(machine: Mechanism, name: str | None) -> Ram:
    """Return the cylinder that lifts: the one named, else the only one that no gas feeds; DefinitionError where that leaves a choice."""
    plan = machine.plan
    if name is not None:
        return found_in(plan.members, name, plan.title)
    fed = [ram for each in plan.of_kind(ForceElement).values() for ram in each.feeds(plan.members)]
    lifting = {key: each for key, each in plan.of_kind(Ram).items() if not is_among(each, fed)}
    if len(lifting) == 1:
        return next(iter(lifting.values()))
    ensure(not lifting, f"{plan.title} has the cylinders {', '.join(lifting)}; say --cylinder one of them.")
    remedy = "declare one, lift = Cylinder(A, B, bore=0.08, rod=0.045)"
    raise DefinitionError(f"{plan.title} has no cylinder {'but those that gas feeds' if fed else 'that could lift'}; {remedy}.")


def circuit_of(machine: Mechanism, ram: Ram, options: Namespace) -> PumpLine:
    """Return the circuit that feeds a cylinder: a given pressure, the circuit named, else its only one with a pump."""
    plan = machine.plan
    if options.pressure is not None:
        ensure(options.circuit is None, "--pressure and --circuit both say what feeds the cylinder; give one of them.")
        pressure = si_value(options.pressure, "pressure", "--pressure")
        ensure(not pressure < 0.0, f"--pressure {options.pressure}: it is negative; give zero or more.")
        return LiftCircuit(ram.name, pressure=pressure)
    return plan.of_kind(PumpLine)[circuit_with(plan, ram, options.circuit or "", "capacity").name]


def point_of(machine: Mechanism, name: str | None) -> str:
    """Return where the load hangs: the point named, else where all loads of the machine act; DefinitionError where these are several."""
    plan = machine.plan
    if name is not None:
        return known_name("Point", name, plan.points, plan.title)
    pose = machine.at(unreachable="nan", **plan.sketch_strokes)
    points = dict.fromkeys(load.point for _, each in elements_of(plan, None) for load in each.loads(pose) if load.point in plan.moving)
    if len(points) == 1:
        return next(iter(points))
    said = f"its loads act at {', '.join(points)}" if points else "it declares no load"
    raise DefinitionError(f"{plan.title}: {said}; say where the load hangs, --at-point {next(iter(points), plan.moving[-1])}.")


def capacity_verdict(judge: Judge, asked: LawRequest, point: str) -> Verdict:
    """Return the least capacity at a point over all that a judge looks at, and where."""
    found = judge.answer(least(asked))
    if np.isnan(found.value):
        text = said(
            "the load at {point} drives, or does nothing: it is not limited by this cylinder. Is --along the wrong way round?", point=point
        )
        return Verdict(FURTHER, None, text, answer=found)
    if found.value <= 0.0:
        text = said("nothing more is lifted at {point} {where}: the machine alone is too heavy there.", point=point, where=found.place)
        return Verdict(FURTHER, False, text, answer=found)
    text = said(
        "{force} ({mass}) are lifted at {point} everywhere beside the machine's own loads, the least {where}.",
        force=show(found.value, "kN", 4), mass=show(found.value / g0, "kg", 4), point=point, where=found.place,
    )  # fmt: skip
    return Verdict(FURTHER, True, text)


# A working cycle.

CycleCommand = Command(
    "cycle",
    "a working cycle on one pump: who waits, how long it takes, how many litres and kWh",
    *machine_options(),
    option("--program", metavar="FILE", help="what cylinders are asked for, .toml or .csv; without it the machine's own paths in time"),
    option("--pump", metavar="SUPPLY", help="the pump, where several stand on lines"),
    CSV,
    option("-o", "--output", metavar="FILE", help=f"a chart, an animation, the live page: {', '.join(ALONG)}"),
    OVER,
    CHECK,
)


@CycleCommand
def print_cycle(options: Namespace) -> int:
    """Print the flow and pressure of a pump over a cycle, and draw them."""
    machine = machine_of(options)
    path = None if options.output is None else picture(options, machine, ALONG)
    if options.program:
        found = cycle_of_programme(machine, options)
    else:
        pump = pump_of(machine, options.pump)
        judged = judged_cycles(pump, machine.judge(overs_of(machine, options.over), Acting()))
        remedy = "give --program FILE, or declare a path in time, Over.path(lift=ramp(0.1, 0.3, speed=0.15)), with flow= of the pump"
        ensure(judged, f"{machine.plan.title}: no path in time that {pump.name} serves; {remedy}.")
        found = [("; ".join(filter(None, (place.over.name, cycle.case))), cycle, place.motion) for place, cycle in judged]
    if options.csv != "-":
        for place, (words, cycle, _) in enumerate(found):
            head = [*([""] if place else []), *([f"{words}:", ""] if words else [])]
            says = said("{pump} {sentence}", pump=cycle.pump, sentence=cycle.verdict.sentence)
            events = ["", *(str(event) for event in cycle.events)] if cycle.events else []
            print(*head, says, "", text_columns([line_heads(), *line_rows(cycle)]), "", text_columns(energy_rows(cycle)), *events, sep="\n")
    if options.csv is not None:
        ensure(len(found) == 1, f"--csv {options.csv}: there are {len(found)} cycles; choose one, --over NAME.")
        write_table(cycle_columns(found[0][1]), options.csv)
    if path is not None:
        ensure(len(found) == 1, f"-o {path}: there are {len(found)} cycles; choose one, --over NAME.")
        _, cycle, motion = found[0]
        if path.suffix.lower() in PICTURES:
            plot_cycle(cycle).savefig(path)
        else:
            from linkage.pictures import animate, page

            (page if path.suffix.lower() == PAGE else animate)(motion, path)
        print(path)
    return judged_code([cycle.verdict for _, cycle, _ in found], options)


def cycle_of_programme(machine: Mechanism, options: Namespace) -> list[tuple[str, PumpCycle, Motion]]:
    """Return the cycle of a programme that a file says, with its motion."""
    ensure(not options.over, "--over is a path of the machine, --program asks cylinders to move; give one of them.")
    ensure(not options.check, "--check judges the machine's own paths in time; cylinders may wait in a programme: leave it out.")
    programme = programme_read(machine, options.program)
    pump = pump_of(machine, options.pump) if options.pump else programme.pump
    acting = Acting(case=programme.case)
    motion = pump.run(machine, demands=programme.demands, start=programme.start, until=programme.until, acting=acting)
    if options.csv != "-":
        loads = said("its own loads") if programme.case is None else said("the case {case}", case=programme.case)
        units = {name: stroke_unit(machine.plan, name) for name in motion.strokes}
        _, strokes = timed_texts({name: each[0] for name, each in motion.strokes.items()}, units, 0.0)
        print(said("It begins at {strokes}, under {loads}.", strokes=strokes, loads=loads))
    return [("", motion.cycle, motion)]
