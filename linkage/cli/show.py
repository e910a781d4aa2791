"""`hydrolinkage show NAME`: what a machine is, its dimensions, its construction, and what to know of it."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from collections.abc import Iterable, Iterator
from inspect import cleandoc
from typing import Any, final

from ..errors import DefinitionError, cited
from ..mechanism import Mechanism
from ..plan import printed
from ..quantities import Dimension
from ..reports import design_rows, stroke_rows
from .command import Command, lined_up, machine_arguments
from .machines import find
from .settings import design, motion_at

POSES = {0: 1, 1: 101, 2: 21}
MANY = 7  # poses of each of three or more strokes


@final
class ShowCommand(Command):
    """Prints a machine in sections."""

    name = "show"
    help = "a machine's dimensions, strokes, bodies, construction steps and verdicts"

    def add(self, parser: ArgumentParser) -> None:
        machine_arguments(parser)
        parser.add_argument("--equations", action="store_true", help="the vector equations too, numbered")

    def run(self, options: Namespace) -> int:
        machine = design(find(options.machine), options.settings)
        for title, lines in sections(machine):
            print_section(title, lines)
        if options.equations:
            from ..formulas import equations

            print_section("Equations", str(equations(machine)).splitlines())
        poses = POSES.get(len(machine.strokes), MANY)
        print_section("Verdict", verdict_lines(machine, machine.verdicts(motion_at(machine, [], poses))))
        return 0


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


def verdict_lines(machine: Mechanism, verdicts: Any) -> list[str]:
    """Return a machine's verdicts; DefinitionError where its own `verdicts` gives something else than sentences."""
    if not isinstance(verdicts, (list, tuple)) or not all(isinstance(each, str) for each in verdicts):
        raise DefinitionError(f"{machine.plan.title}: verdicts(motion) gives {cited(verdicts)}; a list of sentences is expected.")
    return list(verdicts)


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
