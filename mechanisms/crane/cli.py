"""`hydrolinkage crane`: from a duty to a crane in one flow, or a crane that is there: masses, moments, load map, pin forces, pictures."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from collections.abc import Callable, Mapping
from dataclasses import fields
from functools import partial
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np

from linkage import Column, DefinitionError
from linkage.checks import refuse
from linkage.cli.chart import print_chart
from linkage.cli.command import Command, progress_bar
from linkage.cli.machines import find
from linkage.cli.settings import check_argument, design, over_argument, overs_of, pair, print_verdicts, si_value
from linkage.cli.table import csv_argument, write_table
from linkage.disk import check_place, in_words
from linkage.errors import known_name

from . import DRIVE_FIGURES, FIGURES, crane_figure, drive_figure
from .arm_drive import DrivenArm
from .boom_drive import BoomDrive
from .cylinders import arm_moment, boom_moment
from .drive_design import SCHEMES
from .duty import Duty
from .flow import arm_drive_of, boom_drive_of, design_crane, design_skeleton
from .load_map import envelope, load_map
from .machine import Crane
from .moments import arm_bound, boom_bound
from .skeleton import CraneSkeleton
from .strength import strength_text

KINDS = {"M": "moment", "payload": "mass", "psi_0": "angle", "k_d": "", "rho_w": ""}
"""What the numbers of a duty measure; those not named here are lengths."""

COUNT = 9


class DesignedCrane(Command):
    """Designs a crane for a duty, or judges the one that is named."""

    name = "crane"
    help = "a forestry crane: skeleton, masses, bound of moments, drives, load map, pin forces, pictures"

    def add(self, parser: ArgumentParser) -> None:
        parser.add_argument(
            "machine",
            metavar="NAME",
            nargs="?",
            help="judge this crane, or one of its drives, such as crane, boom_drive or arm_drive, instead of designing one",
        )
        parser.add_argument(
            "--set", dest="settings", metavar="L=8.5m", action="append", default=[],
            help="change a number of the duty, with its unit; of a crane that is named a design variable; repeatable",
        )  # fmt: skip
        parser.add_argument(
            "--reading", choices=(">=", "<="), default=">=", help="how (2.13) is read: the tip clears the guard, or comes as near"
        )
        parser.add_argument("--cab", metavar="6.9m", help="column's axis to cab: a back-broken skeleton, and no further stage")
        parser.add_argument("--scheme", choices=SCHEMES, help="the arm's drive of the crane to design, as in fig. 2.13 (default a)")
        parser.add_argument("--skeleton", action="store_true", help="the skeleton and its masses alone, without drives and load map")
        parser.add_argument("--pins", action="store_true", help="the largest force of every pin in the load cases for strength too")
        csv_argument(parser)
        parser.add_argument(
            "--pictures", metavar="FOLDER", help=f"write the pictures there: {', '.join(FIGURES)}; of each drive {', '.join(DRIVE_FIGURES)}"
        )
        over_argument(parser)
        check_argument(parser)

    def run(self, options: Namespace) -> int:
        if options.skeleton or options.cab:
            for name in ("pictures", "pins", "csv", "scheme"):
                refuse(getattr(options, name), f"--{name} is of a whole crane; leave --skeleton and --cab out.")
            skeleton = bare_skeleton(options)
            print_skeleton(skeleton)
            return print_verdicts(skeleton.verdicts(over=overs_of(skeleton, options.over)), options)
        folder = Path(options.pictures) if options.pictures else None
        if folder is not None:
            with in_words(folder):
                folder.mkdir(parents=True, exist_ok=True)
            check_place(folder / "map.png")
        machine = named_machine(options) if options.machine else designed_crane(options)
        over = overs_of(machine, options.over)
        if isinstance(machine, Crane):
            print_skeleton(machine)
            print_moments(machine)
            print_map(machine, options)
            if options.pins:
                print(f"\n{strength_text(machine)}")
        else:
            motion = machine.working(2 * COUNT - 1)
            write_table(machine.columns(motion), motion.reached.size, options.csv)
        code = print_verdicts(machine.verdicts(over=over), options)
        draw_all(folder, crane_pictures(machine) if isinstance(machine, Crane) else drive_pictures(machine))
        return code


Pictures: TypeAlias = Mapping[str, Callable[[], Any]]
"""What draws each picture, by the name of its file."""


def crane_pictures(crane: Crane) -> Pictures:
    """Return the pictures of a crane, those of its drives among them."""
    drives: dict[str, BoomDrive | DrivenArm] = {"boom": boom_drive_of(crane), "arm": arm_drive_of(crane)}
    whole: dict[str, Callable[[], Any]] = {name: partial(crane_figure, name, crane) for name in FIGURES}
    return whole | {f"{side}_{name}": each for side, drive in drives.items() for name, each in drive_pictures(drive).items()}


def drive_pictures(drive: BoomDrive | DrivenArm) -> Pictures:
    """Return the pictures of a drive on its own."""
    return {name: partial(drive_figure, name, drive) for name in DRIVE_FIGURES}


def draw_all(folder: Path | None, pictures: Pictures) -> None:
    """Write pictures into a folder, and say where; nothing without one."""
    for name, drawn in pictures.items() if folder is not None else ():
        path = Path(folder or "") / f"{name}.png"
        drawn().savefig(path)
        print(path)


def duty_of_options(options: Namespace) -> Duty:
    """Return the duty that the options mean."""
    names, given = [each.name for each in fields(Duty)], {}
    for text in options.settings:
        name, value = pair(text, "--set", "L=8.5m")
        known_name("Number of the duty", name, names)
        given[name] = si_value(value, KINDS.get(name, "length"), f"--set {name}")
    return Duty(**given)


def bare_skeleton(options: Namespace) -> CraneSkeleton:
    """Return the skeleton of the options, and report its search."""
    refuse(options.machine, f"{options.machine} has its skeleton already; leave its name out to search one.")
    cab = si_value(options.cab, "length", "--cab") if options.cab else None
    with progress_bar("skeleton") as progress:
        found = design_skeleton(duty_of_options(options), reading=options.reading, cab=cab, progress=progress or False)
    print(f"{found}\n")
    assert isinstance(found.machine, CraneSkeleton)
    return found.machine


def named_machine(options: Namespace) -> Crane | BoomDrive | DrivenArm:
    """Return the crane that is named, or the drive on its own; DefinitionError for another machine, or what goes with another."""
    refuse(options.scheme, f"--scheme {options.scheme} is of a crane to design; {options.machine} has its arm's drive.")
    machine = design(find(options.machine), options.settings)
    if not isinstance(machine, (Crane, BoomDrive, DrivenArm)):
        raise DefinitionError(f"{options.machine} is no crane with its cylinders; take crane, or a subclass of mechanisms.crane.Crane.")
    if options.pins and not isinstance(machine, Crane):
        raise DefinitionError(f"--pins are those of a whole crane; `forces {options.machine}` has what the pins of a drive carry.")
    return machine


def designed_crane(options: Namespace) -> Crane:
    """Return the crane designed for the duty, each stage told."""
    with progress_bar("crane") as progress:
        duty, scheme = duty_of_options(options), options.scheme or "a"
        found = design_crane(duty, scheme=scheme, reading=options.reading, progress=progress or False)
    print(*(f"{each}\n" for each in (found.skeleton, found.boom, found.arm)), sep="\n")
    return found.crane


def print_skeleton(crane: CraneSkeleton) -> None:
    """Print heights and masses of a skeleton's members, and the conditions that it keeps."""
    members = {
        "column": ("h_0", "b_0", "W_0"),
        "boom": ("l_c", "b_c", "W_c"),
        "arm": ("l_p", "b_p", "W_p"),
        "telescope": ("l_t", "b_t", "W_t"),
    }
    for words, (length, height, mass) in members.items():
        numbers = float(crane[length]), crane.output(height) * 1e3, crane.output(mass)
        print("{:10} {:7.3f} m long, {:6.1f} mm high, {:7.1f} kg".format(words, *numbers))
    print(f"{'crane':10} {crane.output('W'):.1f} kg with its drives; W_m = {crane.output('W_m'):.6f} m2")


def print_moments(crane: Crane) -> None:
    """Print the bound of moments and what the cylinders give, over boom's and arm's angle."""
    limits = crane.limits_of()
    phi, psi = (np.linspace(*limits[name], COUNT) for name in ("phi", "psi"))
    falls, rises = arm_bound(crane, psi)
    folds, opens = arm_moment(crane, psi)
    print("\nBound of moments M_l and what the cylinders give M_g, kNm; phi from the upward vertical, psi from boom to arm, deg\n")
    columns = [
        Column("phi", phi, "deg", 2), Column("M_l", boom_bound(crane, phi), "kNm", 2), Column("M_g", boom_moment(crane, phi), "kNm", 2),
        Column("psi", psi, "deg", 2), Column("M_l1", falls, "kNm", 2), Column("M_g1", folds, "kNm", 2),
        Column("M_l2", rises, "kNm", 2), Column("M_g2", opens, "kNm", 2),
    ]  # fmt: skip
    write_table(columns, COUNT, None)


def print_map(crane: Crane, options: Namespace) -> None:
    """Print the load map with its limiters, or write it as CSV, and the reach's area."""
    found = envelope(crane)
    far = float(found.border[..., 0].max())
    over = load_map(crane, np.linspace(8.0, -1.0, 10), np.linspace(1.0, np.floor(far), 10))
    if options.csv:
        write_table(over.columns(), over.x.size, options.csv)
    else:
        print()
        print_chart(over)
    print(f"\nThe tip reaches {found.area:.1f} m2.")
