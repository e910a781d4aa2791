"""`hydrolinkage show NAME`: what a machine is, its dimensions, its construction, and what to know of it."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from collections.abc import Iterable, Iterator
from inspect import cleandoc
from typing import TYPE_CHECKING, final

from ..errors import DefinitionError
from ..mechanism import Mechanism
from ..plan import printed
from ..quantities import Dimension
from ..reports import design_rows, stroke_rows
from .command import Command, lined_up, machine_arguments
from .machines import find
from .settings import check_argument, design, judged_code, motion_at, stroke_values, verdicts_of

if TYPE_CHECKING:
    from ..formulas import Equations

POSES = {0: 1, 1: 101, 2: 21}
MANY = 7  # poses of each of three or more strokes


@final
class ShowCommand(Command):
    """Prints a machine in sections."""

    name = "show"
    help = "a machine's dimensions, strokes, bodies, construction steps and verdicts"

    def add(self, parser: ArgumentParser) -> None:
        machine_arguments(parser)
        check_argument(parser)
        group = parser.add_argument_group("equations")
        group.add_argument("--equations", action="store_true", help="the vector equations too, numbered")
        group.add_argument("--start", metavar="N", type=int, help="the first equation's number (default 1)")
        group.add_argument("--ratio", metavar="G", action="append", help="the derivatives of a point or an output too; repeatable")
        group.add_argument("--wrt", metavar="S", help="the stroke of these derivatives, where there are several")
        group.add_argument("--forces", action="store_true", help="the loads, the driving forces, what cylinders and circuits have")
        group.add_argument("--numbers", action="store_true", help="with the numbers filled in, at the start of each stroke")
        group.add_argument("--at", dest="strokes", metavar="S=0.6", action="append", default=[], help="numbers at this stroke; repeatable")
        group.add_argument("--latex", action="store_true", help="as LaTeX, and nothing else")

    def run(self, options: Namespace) -> int:
        check_asked(options)
        machine = design(find(options.machine), options.settings)
        if options.latex:
            print(listed(machine, options).latex())
            return 0
        for title, lines in sections(machine):
            print_section(title, lines)
        if options.equations:
            print_section("Equations", str(listed(machine, options)).splitlines())
        poses = POSES.get(len(machine.strokes), MANY)
        verdicts = verdicts_of(machine, motion_at(machine, [], poses))
        print_section("Verdict", verdicts)
        return judged_code(verdicts, options)


def check_asked(options: Namespace) -> None:
    """Raise DefinitionError for options of equations without these, and for numbers in LaTeX."""
    given = {"--start": options.start, "--ratio": options.ratio, "--wrt": options.wrt, "--forces": options.forces}
    given |= {"--numbers": options.numbers, "--at": options.strokes, "--latex": options.latex}
    named = [name for name, value in given.items() if value not in (None, False, [])]
    if named and not options.equations:
        raise DefinitionError(f"{named[0]} says how equations are printed; say --equations too.")
    if options.latex and (options.numbers or options.strokes):
        raise DefinitionError("--latex prints symbols, not numbers; leave out --numbers and --at, or --latex.")


def listed(machine: Mechanism, options: Namespace) -> Equations:
    """Return the equations as they are asked for."""
    from ..formulas import equations

    at = dict(value_at(machine, text) for text in options.strokes)
    return equations(
        machine, start=1 if options.start is None else options.start, ratio=options.ratio or (), wrt=options.wrt, forces=options.forces,
        numbers=options.numbers, at=at or None,
    )  # fmt: skip


def value_at(machine: Mechanism, text: str) -> tuple[str, float]:
    """Return a stroke's name and its one value [m or rad]."""
    name, values = stroke_values(machine.plan, text)
    if len(values) != 1:
        raise DefinitionError(f"--at {text}: numbers are filled in at one pose; give one value.")
    return name, float(values[0])


def sections(machine: Mechanism) -> Iterator[tuple[str, Iterable[str]]]:
    """Yield the title and the lines of each section that describes a design."""
    yield type(machine).__name__, cleandoc(type(machine).__doc__ or "").splitlines()
    yield "Strokes", lined_up(list(stroke_rows(machine)))
    yield "Design variables", lined_up(list(design_rows(machine)))
    yield "Bodies", body_lines(machine)
    yield "Construction, in order", construction(machine)


def body_lines(machine: Mechanism) -> Iterator[str]:
    """Yield the rigid bodies, the cylinders, and the count of freedoms."""
    cylinders = machine.plan.cylinders
    yield from map(str, machine.links)
    yield from (f"cylinder {bar.P} {bar.Q}" for bar in cylinders)
    strokes = len(machine.strokes)
    yield f"Gruebler count {machine.gruebler} (a cylinder is two bodies on a slide), {strokes} stroke{'s' if strokes != 1 else ''}"


def construction(machine: Mechanism) -> Iterator[str]:
    """Yield the members in the order they are worked out, as this design has them, without the dimensions listed already."""
    dimensions, defaults = machine.plan.of_kind(Dimension), machine.plan.defaults
    changed = {name: value for name, value in machine.dimensions.items() if value != defaults[name]}
    yield from (f"{name} = {text}" for name, text in printed(machine.plan, changed).items() if name not in dimensions)


def print_section(title: str, lines: Iterable[str]) -> None:
    """Print a section; nothing where it has no lines."""
    text = [f"  {line}".rstrip() for line in lines]
    if text:
        print("\n".join([title, *text, ""]))


# `hydrolinkage save NAME FILE`: a machine as a mechanism file, and what such a file does not hold.


@final
class SaveCommand(Command):
    """Writes a machine into a file."""

    name = "save"
    help = "a machine, as it is set, as a file in TOML or JSON"

    def add(self, parser: ArgumentParser) -> None:
        machine_arguments(parser)
        parser.add_argument("file", metavar="FILE", help="the file, named .toml or .json")

    def run(self, options: Namespace) -> int:
        from ..files import left_out, save

        machine = design(find(options.machine), options.settings)
        save(machine, options.file)
        lost = ", ".join(left_out(machine))
        print(f"{options.file}: the linkage with {len(machine.plan.members)} members.")
        if lost:
            print(f"Not in it, since a file holds no functions of a class: {lost}.")
        return 0
