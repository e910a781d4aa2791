"""`hydrolinkage grapple`: a grapple's available and required moments over its angle, its verdicts and figures."""

from __future__ import annotations

from argparse import Namespace

import numpy as np

from linkage.cli.command import Command, figure_path, machine_options, option
from linkage.cli.settings import judged_over, motions_at, print_verdicts
from linkage.cli.table import heading_words, write_tables
from linkage.errors import ensure
from linkage.language import said
from linkage.units import show, shown_number, unit_sign

from ..paper import duty_set, figure_options, machine_like
from . import FIGURES, figure
from .design import OBJECTIVES, Duty
from .design import design as design_for
from .machine import Grapple

LEGEND = """theta lever's angle, 0 at the largest stem; D stem it holds; EC cylinder's length; H = |dEC/dtheta|; M_g moment that the full
pressure gives about the hinge; M_1 moment that the stem needs (an assumed law: the source's own is not at hand). All of one lever;
pressures are gauge."""


Gripping = Command(
    "grapple",
    "a harvester head's grapple: hinge, moments over the stems, verdicts, figures",
    *machine_options("grapple"),
    option(
        "--design",
        choices=OBJECTIVES,
        nargs="?",
        const=OBJECTIVES[0],
        help="design one for a duty first: even, the least greatest M_g / M_1, or arm, the greatest arm at the largest stem; --set "
        "then changes a number of the duty, D_0=600mm",
    ),
    *figure_options(FIGURES, "stems"),
)


@Gripping
def print_grapple(options: Namespace) -> int:
    """Print a grapple's available and required moments."""
    machine = machine_like(options, Grapple, "grapple") if options.design is None else designed(options)
    path = figure_path(options, machine, "grapple")
    by_angle = {tuple(each.strokes["theta"].ravel()): (run, each) for run, each in reversed(motions_at(machine, options))}
    motions = [*reversed(by_angle.values())]  # its columns hang on the lever's angle alone, whatever the load case
    motion = motions[0][1]
    first = {name: np.ravel(motion[name])[0] for name in ("OA", "opening_angle", "closing_angle")}
    places = {name: ", ".join(shown_number(float(part.ravel()[0]), "mm", ".2f") for part in motion[name]) for name in "OE"}
    pins = ", ".join(f"{name} ({place}) {unit_sign('mm')}" for name, place in places.items())
    arms = f"OA {show(float(first['OA']), 'mm', '.2f')}, OC {show(float(motion.inputs['rho']), 'mm', '.2f')}"
    opened, closing = (show(float(first[name]), "deg", ".3f") for name in ("opening_angle", "closing_angle"))
    print(said("{pins}, {arms}; opens by {opened}, closes by {closing}.", pins=pins, arms=arms, opened=opened, closing=closing))
    print(f"{LEGEND}\n")
    write_tables([(heading_words(machine, run, each), machine.columns(each), ()) for run, each in motions], options.csv)
    code = print_verdicts(machine.verdicts(over=judged_over(machine, options)), options)
    if path is not None:
        figure(options.figure or "stems", machine).savefig(path)
        print(path)
    return code


def designed(options: Namespace) -> Grapple:
    """Return the grapple designed for the duty of the options, and report its search."""
    ensure(options.machine == "grapple", f"{options.machine} is designed already; leave --design out, or the name.")
    ensure(not options.own, f"--machine {options.own} is of a file that holds a design; leave it out, or --design.")
    found = design_for(duty_set(Duty, options, "D_0=600mm", KINDS), options.design)
    print(f"{found}\n")
    assert isinstance(found.machine, Grapple)
    return found.machine


KINDS = {"alpha": "angle", "beta": "angle", "opening": "", "dead_bores": "", "pressure": "pressure", "efficiency": ""}
"""What the numbers of a duty measure; those not named here are lengths."""
