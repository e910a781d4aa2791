"""`hydrolinkage catalogue NAME`: the closed curves of a point, made once and kept in the user's cache."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from typing import final

from ..synthesis.curve_catalogue import curve_catalogue
from .command import Command, machine_arguments, whole_number
from .machines import find
from .optimise import study_progress
from .settings import design

COUNT = 1_000_000


@final
class CatalogueCommand(Command):
    """Makes a catalogue of closed curves."""

    name = "catalogue"
    help = "the closed curves of a point, made once: a synthesis of a closed path begins with the nearest"

    def add(self, parser: ArgumentParser) -> None:
        machine_arguments(parser)
        parser.add_argument("--of", metavar="P", help="the point (default: the first whose path pictures show)")
        parser.add_argument("--hold", metavar="BAP", action="append", default=[], help="an angle that stays as it is; repeatable")
        parser.add_argument("--count", metavar="N", type=whole_number, default=COUNT, help=f"curves (default {COUNT})")
        parser.add_argument("--seed", metavar="N", type=int, default=0, help="of the sequence of designs (default 0)")
        parser.add_argument("--progress", action="store_true", help="say how far it is where stderr is no terminal, too")

    def run(self, options: Namespace) -> int:
        machine = design(find(options.machine), options.settings)
        of = options.of or next(iter([*machine.featured().path, *machine.plan.moving]), "")
        with study_progress(f"curves of {of}", asked=options.progress) as progress:
            print(curve_catalogue(machine, of, hold=options.hold, count=options.count, seed=options.seed, progress=progress))
        return 0
