"""`hydrolinkage grapple`: what a grapple's lever gives and what its stems need over its angle, its verdicts and figures."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from dataclasses import fields
from typing import Any

from linkage import Motion
from linkage.checks import refuse
from linkage.cli.command import Command, figure_path, machine_arguments, motion_arguments, picture_argument
from linkage.cli.machines import find_like
from linkage.cli.settings import check_argument, design, judged_over, motion_at, over_argument, pair, print_verdicts, si_value
from linkage.cli.table import csv_argument, write_table
from linkage.errors import known_name
from linkage.language import said
from linkage.units import show, shown_number, unit_sign

from . import FIGURES, figure
from .design import OBJECTIVES
from .design import design as design_for
from .duty import Duty
from .machine import Grapple

LEGEND = """theta lever's angle, 0 at the largest stem; D stem it holds; EC cylinder's length; H = |dEC/dtheta|; M_g moment that the full
pressure gives about the hinge; M_1 moment that the stem needs (an assumed law: the source's own is not at hand). All of one lever;
pressures are gauge."""


class Gripping(Command):
    """Prints what a grapple's lever gives and what its stems need."""

    name = "grapple"
    help = "a harvester head's grapple: hinge, moments over the stems, verdicts, figures"

    def add(self, parser: ArgumentParser) -> None:
        machine_arguments(parser, default="grapple")
        parser.add_argument(
            "--design", choices=OBJECTIVES, nargs="?", const=OBJECTIVES[0],
            help="design one for a duty first: even, the least greatest M_g / M_1, or arm, the greatest arm at the largest stem; --set "
            "then changes a number of the duty, D_0=600mm",
        )  # fmt: skip
        csv_argument(parser)
        picture_argument(parser, "the figure")
        parser.add_argument("--figure", choices=FIGURES, help="which figure (default: stems)")
        motion_arguments(parser, 11)
        over_argument(parser)
        check_argument(parser)

    def run(self, options: Namespace) -> int:
        machine = named_grapple(options) if options.design is None else designed_grapple(options)
        path = figure_path(options, machine, self.name)
        motion, over = motion_at(machine, options), judged_over(machine, options)
        columns = machine.columns(motion)
        print(f"{layout_words(motion)}\n{LEGEND}\n")
        write_table(columns, motion.reached.size, options.csv)
        code = print_verdicts(machine.verdicts(over=over), options)
        if path is not None:
            figure(options.figure or "stems", machine).savefig(path)
            print(path)
        return code


def named_grapple(options: Namespace) -> Grapple:
    """Return the grapple that is named."""
    machine = design(find_like(options.machine, Grapple, "grapple"), options.settings)
    assert isinstance(machine, Grapple)
    return machine


def designed_grapple(options: Namespace) -> Grapple:
    """Return the grapple designed for the duty of the options, and report its search."""
    refuse(options.machine != "grapple", f"{options.machine} is designed already; leave --design out, or the name.")
    names, given = tuple(each.name for each in fields(Duty) if isinstance(each.default, float)), dict[str, Any]()
    for text in options.settings:
        name, value = pair(text, "--set", "D_0=600mm")
        known_name("Number of the duty", name, names)
        given[name] = si_value(value, KINDS.get(name, "length"), f"--set {name}")
    found = design_for(Duty(**given), options.design)
    print(f"{found}\n")
    assert isinstance(found.machine, Grapple)
    return found.machine


KINDS = {"alpha": "angle", "beta": "angle", "opening": "", "dead_bores": "", "pressure": "pressure", "efficiency": ""}
"""What the numbers of a duty measure; those not named here are lengths."""


def layout_words(motion: Motion) -> str:
    """Return where the pins are and how far the lever goes."""
    places = {name: ", ".join(shown_number(float(part.ravel()[0]), "mm", ".2f") for part in motion[name]) for name in "OE"}
    opened, closing = (show(float(motion[name].ravel()[0]), "deg", ".3f") for name in ("opening_angle", "closing_angle"))
    arms = f"OA {show(float(motion['OA'].ravel()[0]), 'mm', '.2f')}, OC {show(float(motion.inputs['rho']), 'mm', '.2f')}"
    pins = ", ".join(f"{name} ({place}) {unit_sign('mm')}" for name, place in places.items())
    return said("{pins}, {arms}; opens by {opened}, closes by {closing}.", pins=pins, arms=arms, opened=opened, closing=closing)
