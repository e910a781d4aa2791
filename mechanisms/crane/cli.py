"""`hydrolinkage crane`: from a duty to a crane in one flow, or a crane that is there: masses, moments, load map, pin forces, pictures."""

from __future__ import annotations

from argparse import Namespace
from functools import partial

import numpy as np

from linkage import Column, DefinitionError, max_table
from linkage.cli.command import CSV, Command, option, progress_bar, repeatable
from linkage.cli.follow import print_chart
from linkage.cli.machines import find
from linkage.cli.settings import CHECK, OVER, design_from, overs_of, print_verdicts, si_value
from linkage.cli.table import write_table
from linkage.disk import check_place, new_folder
from linkage.errors import ensure
from linkage.statics import table_text

from ..paper import duty_set
from . import DRIVE_FIGURES, FIGURES, crane_figure, drive_figure
from .drive_design import SCHEMES
from .drives import BoomDrive, DrivenArm
from .duty import Duty, arm_bound, boom_bound
from .flow import arm_drive_of, boom_drive_of, design_crane, design_skeleton
from .lifted_map import arm_moment, boom_moment, envelope, load_map, strength
from .machine import Crane
from .skeleton import CraneSkeleton

KINDS = {"M": "moment", "payload": "mass", "psi_0": "angle", "k_d": "", "rho_w": ""}
"""What the numbers of a duty measure; those not named here are lengths."""

COUNT = 9


DesignedCrane = Command(
    "crane",
    "a forestry crane: skeleton, masses, bound of moments, drives, load map, pin forces, pictures",
    option(
        "machine",
        metavar="NAME",
        nargs="?",
        help="judge this crane, or one of its drives, such as crane, boom_drive or arm_drive, instead of designing one",
    ),
    repeatable(
        "--set", "L=8.5m", "change a number of the duty, with its unit; of a crane that is named a design variable; repeatable", "settings"
    ),
    option("--reading", choices=(">=", "<="), default=">=", help="how (2.13) is read: the tip clears the guard, or comes as near"),
    option("--cab", metavar="6.9m", help="column's axis to cab: a back-broken skeleton, and no further stage"),
    option("--scheme", choices=SCHEMES, help="the arm's drive of the crane to design, as in fig. 2.13 (default a)"),
    option("--skeleton", action="store_true", help="the skeleton and its masses alone, without drives and load map"),
    option("--pins", action="store_true", help="the largest force of every pin in the load cases for strength too"),
    CSV,
    option(
        "--pictures",
        metavar="FOLDER",
        help=f"write the pictures there: {', '.join(FIGURES)}; of each drive {', '.join(DRIVE_FIGURES)}",
    ),
    OVER,
    CHECK,
)


@DesignedCrane
def print_design(options: Namespace) -> int:
    """Design a crane for a duty, or judge the one that is named."""
    if options.skeleton or options.cab:
        for name in ("pictures", "pins", "csv", "scheme"):
            ensure(not getattr(options, name), f"--{name} is of a whole crane; leave --skeleton and --cab out.")
        ensure(not options.machine, f"{options.machine} has its skeleton already; leave its name out to search one.")
        cab = si_value(options.cab, "length", "--cab") if options.cab else None
        with progress_bar("skeleton") as progress:
            duty = duty_set(Duty, options, "L=8.5m", KINDS)
            found = design_skeleton(duty, reading=options.reading, cab=cab, progress=progress or False)
        print(f"{found}\n")
        skeleton = found.machine
        assert isinstance(skeleton, CraneSkeleton)
        print_skeleton(skeleton)
        return print_verdicts(skeleton.verdicts(over=overs_of(skeleton, options.over)), options)
    folder = new_folder(options.pictures) if options.pictures else None
    if folder is not None:
        check_place(folder / "map.png")
    machine = crane_or_drive(options)
    over = overs_of(machine, options.over)
    if isinstance(machine, Crane):
        print_skeleton(machine)
        print_crane(machine, options)
    else:
        motion = machine.working(2 * COUNT - 1)
        write_table(machine.columns(motion), options.csv)
    code = print_verdicts(machine.verdicts(over=over), options)
    if folder is not None:
        if isinstance(machine, Crane):
            pictures = {name: partial(crane_figure, name, machine) for name in FIGURES}
            drives: dict[str, BoomDrive | DrivenArm] = {"boom_": boom_drive_of(machine), "arm_": arm_drive_of(machine)}
        else:
            pictures, drives = {}, {"": machine}
        pictures |= {f"{side}{name}": partial(drive_figure, name, drive) for side, drive in drives.items() for name in DRIVE_FIGURES}
        for name, drawing in pictures.items():
            path = folder / f"{name}.png"
            drawing().savefig(path)
            print(path)
    return code


def crane_or_drive(options: Namespace) -> Crane | BoomDrive | DrivenArm:
    """Return the crane designed for the duty, each stage told; or the crane that is named, or a drive on its own.

    DefinitionError for another machine, or for what goes with another.
    """
    if not options.machine:
        with progress_bar("crane") as progress:
            duty, scheme = duty_set(Duty, options, "L=8.5m", KINDS), options.scheme or "a"
            found = design_crane(duty, scheme=scheme, reading=options.reading, progress=progress or False)
        print(*(f"{each}\n" for each in (found.skeleton, found.boom, found.arm)), sep="\n")
        return found.crane
    ensure(not options.scheme, f"--scheme {options.scheme} is of a crane to design; {options.machine} has its arm's drive.")
    machine = design_from(find(options.machine), options.settings)
    if not isinstance(machine, (Crane, BoomDrive, DrivenArm)):
        raise DefinitionError(f"{options.machine} is no crane with its cylinders; take crane, or a subclass of mechanisms.crane.Crane.")
    is_drive, forces = not isinstance(machine, Crane), f"`forces {options.machine}` has what the pins of a drive carry"
    ensure(not (options.pins and is_drive), f"--pins are those of a whole crane; {forces}.")
    return machine


def print_skeleton(crane: CraneSkeleton) -> None:
    """Print heights and masses of a skeleton's members, and the conditions that it keeps."""
    for words, part in (("column", "0"), ("boom", "c"), ("arm", "p"), ("telescope", "t")):
        length = float(crane["h_0" if part == "0" else f"l_{part}"])
        height, mass = crane.output(f"b_{part}") * 1e3, crane.output(f"W_{part}")
        print(f"{words:10} {length:7.3f} m long, {height:6.1f} mm high, {mass:7.1f} kg")
    print(f"{'crane':10} {crane.output('W'):.1f} kg with its drives; W_m = {crane.output('W_m'):.6f} m2")


def print_crane(crane: Crane, options: Namespace) -> None:
    """Print the bound of moments and the cylinders' moments over boom's and arm's angle, the load map with its limiters, the reach."""
    limits = crane.limits_of()
    phi, psi = (np.linspace(*limits[name], COUNT) for name in ("phi", "psi"))
    falls, rises = arm_bound(crane, psi)
    folds, opens = arm_moment(crane, psi)
    print("\nBound of moments M_l and what the cylinders give M_g, kNm; phi from the upward vertical, psi from boom to arm, deg\n")
    named = {"M_l": boom_bound(crane, phi), "M_g": boom_moment(crane, phi)}
    arm = {"M_l1": falls, "M_g1": folds, "M_l2": rises, "M_g2": opens}
    columns = [Column("phi", phi, "deg", 2), *(Column(name, values, "kNm", 2) for name, values in named.items())]
    columns += [Column("psi", psi, "deg", 2), *(Column(name, values, "kNm", 2) for name, values in arm.items())]
    write_table(columns, None)
    found = envelope(crane)
    over = load_map(crane, np.linspace(8.0, -1.0, 10), np.linspace(1.0, np.floor(float(found.border[..., 0].max())), 10))
    if options.csv:
        write_table(over.columns(), options.csv)
    else:
        print()
        print_chart(over)
    print(f"\nThe tip reaches {found.area:.1f} m2.")
    if options.pins:
        tables = [f"{title[0].upper()}{title[1:]}\n{table_text(max_table(pins))}" for title, pins in strength(crane).items()]
        print("\n" + "\n\n".join(tables))
