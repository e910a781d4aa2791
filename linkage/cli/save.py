"""`hydrolinkage save NAME FILE`: a machine as a mechanism file, and what such a file does not hold."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace

from .command import Command, machine_arguments
from .machines import find
from .settings import design


class Save(Command):
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
