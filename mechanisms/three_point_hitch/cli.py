"""`hydrolinkage hitch`: a hitch's capacity over its stroke, its zones, its verdicts and figures."""

from __future__ import annotations

from argparse import Namespace

from linkage import max_table, pin_forces
from linkage.cli.command import Command, figure_path, machine_options, option
from linkage.cli.settings import design_from, judged_over, motions_at, print_verdicts
from linkage.cli.table import Table, heading_words, write_tables
from linkage.errors import ensure
from linkage.statics import table_text
from linkage.units import show

from ..paper import figure_options, machine_like
from . import FIGURES, figure
from .capacity import capacity_zone, mast_words, tilt_zone, zone_columns
from .machine import CATEGORIES, ThreePointHitch
from .report import capacity_columns, pressure_words

LEGEND = """S stroke; F_y height of the hitch points; I = dG_y/dS; capacity at G at the full pressure;
F 90%, 610 90%: at the hitch points and 610 mm behind them at 90 % of the pressure; MK force in the upper link, tension positive;
front: front axle's load; max: largest implement that leaves the front axle its least share; tips: the one that tips the tractor;
uphill: the slope that does."""


Hitch = Command(
    "hitch",
    "a three-point hitch: lifting capacity, zones, upper link, front axle, figures",
    *machine_options("three_point_hitch"),
    option("--category", type=int, choices=sorted(CATEGORIES), help="a hitch of these proportions (ISO 730) instead"),
    option("--zones", action="store_true", help="the zones over all admissible settings instead (figure 2)"),
    option("--vertical", action="store_true", help="the upper link's length for a vertical mast at every stroke too"),
    option("--pins", action="store_true", help="the largest force of every pin too, its direction and pose"),
    *figure_options(FIGURES, "capacity, with --zones zones"),
)


@Hitch
def print_hitch(options: Namespace) -> int:
    """Print a hitch's capacity and its limits."""
    machine = machine_like(options, ThreePointHitch, "three-point hitch")
    if options.category:
        is_shipped = options.machine == "three_point_hitch" and not options.own
        ensure(is_shipped, f"--category {options.category} goes with three_point_hitch; {options.machine} has dimensions of its own.")
        machine = design_from(CATEGORIES[options.category].machine, options.settings)
    path = figure_path(options, machine, "hitch")
    motions, tables = motions_at(machine, options), list[Table]()
    if options.category:
        print(f"{CATEGORIES[options.category]}.\n")
    for run, motion in motions:
        if options.zones:
            capacity, tilt = capacity_zone(machine, S=motion.strokes["S"]), tilt_zone(machine, S=motion.strokes["S"])
            print(*(f"{remark}\n\n" for remark in dict.fromkeys((*capacity.remarks, *tilt.remarks))), sep="", end="")
        columns = zone_columns(capacity, tilt) if options.zones else capacity_columns(motion)
        tables.append((heading_words(machine, run, motion), columns, ()))
    if not options.zones:
        motion = motions[0][1]
        eta = float(motion.inputs["circuit.mechanical_efficiency"])
        print(f"{pressure_words(motion)}, eta {eta:.4g}. Pressures are gauge.\n{LEGEND}\n")
    write_tables(tables, options.csv)
    if options.pins:
        print(f"\n{table_text(max_table([pin_forces(motion) for _, motion in motions]))}")
    if options.vertical:
        strokes = dict.fromkeys(float(S) for _, motion in motions for S in motion.strokes["S"].ravel())
        print("", *(f"S = {show(S, 'mm', '.1f')}: {mast_words(machine, S)}" for S in strokes), sep="\n")
    code = print_verdicts(machine.verdicts(over=judged_over(machine, options)), options)
    if path is not None:
        figure(options.figure or ("zones" if options.zones else "capacity"), machine).savefig(path)
        print(path)
    return code
