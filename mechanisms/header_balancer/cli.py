"""`hydrolinkage balance header_balancer --header 2`: reactions, verdicts, settings and figures of a balanced header."""

from __future__ import annotations

from argparse import Namespace

from linkage.cli.command import CSV, Command, count_option, figure_path, machine_options, option, picture_option
from linkage.cli.settings import CHECK, OVER, overs_of, parsed_settings, print_verdicts, si_value
from linkage.cli.table import write_table
from linkage.errors import ensure
from linkage.units import kgf, show

from ..paper import machine_like
from . import FIGURES, figure
from .criteria import HEADERS, charge_for
from .following import kgf_cm2_text, over_following, reaction_columns
from .machine import HeaderBalancer, setting_table, with_header
from .measured import deviations, read_measured

REACTION = {1: "2", 2: "4", 3: "5"}
"""The figure that shows the reaction of each header; without one it is drawn like header 2's."""
ABOUT_TABLE = """\
Charge pressures at the horizon, gauge, for each header and each wanted reaction of all shoes; the least reaction that is left
moving down over the following range; safe: 1 where the shoe never lifts off. A dash: the header or its line cannot give it.
"""
WANTED = tuple(step * 100.0 * kgf for step in range(9))
UNITS = "40kgf_cm2, 39bar or 300kgf"
"""Units of what a charge is chosen by: a bare number would be Pa or N."""


Balance = Command(
    "balance",
    "a header on gas accumulators: shoe reactions, charge pressures, the five criteria, figures",
    *machine_options(),
    option("--header", type=int, choices=sorted(HEADERS), help="one of the published headers with its setting"),
    option("--pressure", metavar="40kgf_cm2", help="charge pressure of the line at the horizon, gauge"),
    option("--reaction", metavar="300kgf", help="charge for this reaction of all shoes at the horizon instead"),
    option("--table", action="store_true", help="charge pressures for each header and wanted reaction instead"),
    count_option(13, "poses over the following range"),
    CSV,
    option("--measured", metavar="FILE", help='compare with measured values: columns "R_y, mm", "F_R up, kgf"'),
    picture_option("the figure"),
    option("--figure", choices=FIGURES, help="which figure of the paper, such as 2a, or 2 for both its halves"),
    OVER,
    CHECK,
)


@Balance
def print_balance(options: Namespace) -> int:
    """Print the reactions of a header over the following range and judge its balancing."""
    machine = header_of(options)
    path, over, code = figure_path(options, machine, "balance"), overs_of(machine, options.over), 0
    motion = machine.at(h=machine.strokes["h"].start)
    compared = deviations(motion, read_measured(options.measured)) if options.measured else []
    if options.table:
        columns = setting_table(WANTED, parsed_settings(machine, options.settings))
        print(ABOUT_TABLE)
        write_table(columns, options.csv)
    if not options.table or options.header or options.pressure or options.reaction or compared:
        following = over_following(motion, options.count)
        horizon = show(float(following["h_horizon"][0]), "mm", 4)
        alone = f"\nHeader {options.header} alone. " if options.header else "\nThe header that is set alone. "
        charged = f"Charged to {kgf_cm2_text(float(motion.inputs['charge']))} at the horizon, h = {horizon}. Pressures are gauge."
        print(f"{alone if options.table else ''}{charged}")
        if not options.table:
            print()
            columns = reaction_columns(following)
            write_table(columns, options.csv)
        code = print_verdicts([*machine.verdicts(over=over), *(each.verdict for each in compared)], options)
    if path is not None:  # figure 6 of the machine as it is shipped shows the improved one
        number = options.figure or ("7" if compared else REACTION.get(options.header, "4"))
        as_shipped = type(machine) is HeaderBalancer and machine.dimensions in (HeaderBalancer().dimensions, with_header(1).dimensions)
        figure(number, None if number[0] == "6" and as_shipped else machine, compared).savefig(path)
        print(path)
    return code


def header_of(options: Namespace) -> HeaderBalancer:
    """Return the machine that the options mean."""
    machine = machine_like(options, HeaderBalancer, "balanced header")
    changed = parsed_settings(machine, options.settings)
    is_fit = not options.table or (options.machine == "header_balancer" and not options.own)
    ensure(is_fit, f"--table goes with header_balancer and its headers; {options.machine} has dimensions of its own.")
    ensure(not (options.pressure and options.reaction), "--pressure and --reaction both choose the charge; give one of them.")
    found, given = type(machine), dict(machine.replaced(**{**HEADERS.get(options.header, {}), **changed}).dimensions)
    if options.pressure:
        given["charge"] = si_value(options.pressure, "pressure", "--pressure", UNITS)
    if options.reaction:
        reaction = si_value(options.reaction, "force", "--reaction", UNITS)
        given["charge"] = charge_for(found(**given).at(h=found.plan.strokes["h"].start), reaction)
    return found(**given)
