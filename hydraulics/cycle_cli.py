"""`hydrolinkage cycle NAME`: a working cycle on one pump, of a programme in a file or of the machine's own paths in time."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Sequence
from pathlib import Path

from linkage.cli.command import CSV, PICTURES, Command, lined_up, machine_options, option, picture
from linkage.cli.settings import CHECK, OVER, judged_code, judged_over, machine_of
from linkage.cli.table import write_table
from linkage.errors import DefinitionError, ensure
from linkage.language import said
from linkage.loads import Acting
from linkage.mechanism import Mechanism
from linkage.motion import Motion

from .cycle import PumpCycle, judged_cycles
from .cycle_chart import cycle_columns, energy_rows, line_heads, line_rows, plot_cycle
from .programme import programme_read, pump_of

FILMS, PAGE = (".gif", ".mp4"), ".html"

CycleCommand = Command(
    "cycle",
    "a working cycle on one pump: who waits, how long it takes, how many litres and kWh",
    *machine_options(),
    option("--program", metavar="FILE", help="what cylinders are asked for, .toml or .csv; without it the machine's own paths in time"),
    option("--pump", metavar="SUPPLY", help="the pump, where several stand on lines"),
    CSV,
    option("-o", "--output", metavar="FILE", help=f"a chart, an animation, the live page: {', '.join((*PICTURES, *FILMS, PAGE))}"),
    OVER,
    CHECK,
)


@CycleCommand
def print_cycle(options: Namespace) -> int:
    """Print what a pump gives over a cycle, and draw it."""
    machine = machine_of(options)
    path = None if options.output is None else picture(options, machine, (*PICTURES, *FILMS, PAGE))
    found = driven(machine, options) if options.program else given(machine, options)
    if options.csv != "-":
        for place, (words, cycle, _) in enumerate(found):
            print(*([""] if place else []), *cycle_lines(words, cycle), sep="\n")
    if options.csv is not None:
        write(options.csv, found)
    if path is not None:
        ensure(len(found) == 1, f"-o {path}: there are {len(found)} cycles; choose one, --over NAME.")
        draw(path, *found[0])
        print(path)
    return judged_code([cycle.verdict for _, cycle, _ in found], options)


def driven(machine: Mechanism, options: Namespace) -> list[tuple[str, PumpCycle, Motion]]:
    """Return the cycle of a programme that a file says, with its motion."""
    ensure(not options.over, "--over is a path of the machine, --program asks cylinders to move; give one of them.")
    programme = programme_read(machine, options.program)
    pump = pump_of(machine, options.pump) if options.pump else programme.pump
    acting = Acting(case=programme.case)
    motion = pump.run(machine, demands=programme.demands, start=programme.start, until=programme.until, acting=acting)
    return [("", motion.cycle, motion)]


def given(machine: Mechanism, options: Namespace) -> list[tuple[str, PumpCycle, Motion]]:
    """Return the cycles of the paths in time that a machine runs, with their motions."""
    pump, title = pump_of(machine, options.pump), machine.plan.title
    found = judged_cycles(pump, machine.judge(judged_over(machine, options), Acting()))
    if not found:
        remedy = "give --program FILE, or declare a path in time, Over.path(lift=ramp(0.1, 0.3, speed=0.15)), with flow= of the pump"
        raise DefinitionError(f"{title}: no path in time that {pump.name} serves on several lines; {remedy}.")
    named = ["; ".join(filter(None, (place.over.title, cycle.case))) for place, cycle in found]
    return [(words, cycle, place.motion) for words, (place, cycle) in zip(named, found, strict=True)]


def cycle_lines(words: str, cycle: PumpCycle) -> Sequence[str]:
    """Return a cycle in lines of text: the verdict, lines and energy in tables, the events."""
    head = [f"{words}:", ""] if words else []
    events = ["", *(str(event) for event in cycle.events)] if cycle.events else []
    lines = [*lined_up([line_heads(), *line_rows(cycle)]), "", *lined_up(energy_rows(cycle))]
    return [*head, said("{pump} {sentence}", pump=cycle.pump, sentence=cycle.verdict.sentence), "", *lines, *events]


def write(file: str, found: Sequence[tuple[str, PumpCycle, Motion]]) -> None:
    """Write a cycle as CSV; DefinitionError for several of them."""
    ensure(len(found) == 1, f"--csv {file}: there are {len(found)} cycles; choose one, --over NAME.")
    write_table(cycle_columns(found[0][1]), len(found[0][1].time), file)


def draw(path: Path, words: str, cycle: PumpCycle, motion: Motion) -> None:
    """Draw a cycle's chart, its animation or its live page."""
    if path.suffix.lower() in PICTURES:
        plot_cycle(cycle).savefig(path)
        return
    from linkage.pictures import animate, page

    (page if path.suffix.lower() == PAGE else animate)(motion, path)
