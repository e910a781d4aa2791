"""`hydrolinkage table NAME`, `forces NAME`, `limits NAME`: results over the stroke, the forces behind them, the limits of motion."""

from __future__ import annotations

import io
import json
import re
import sys
from argparse import Namespace
from collections.abc import Sequence
from contextlib import nullcontext
from dataclasses import replace
from pathlib import Path
from shutil import get_terminal_size
from typing import TypeAlias

import numpy as np

from ..disk import replacing_text
from ..errors import cited, ensure
from ..language import heading_of, said
from ..loads import PLAIN_CASE, Acting
from ..mechanism import Mechanism
from ..motion import Column, Motion, Over, columns_of, geometry_verdicts, judged_poses, limits_over
from ..reports import (
    Run,
    dagger_words,
    force_columns,
    friction_of_columns,
    in_case_words,
    is_loaded,
    joined_tables,
    run_words,
    text_table,
    write_csv,
)
from ..statics import PinForces, max_table, pin_forces, table_text
from . import settings
from .command import COLUMNS, CSV, EVERY, Command, machine_options, option, pose_options, progress_bar, repeatable
from .settings import CHECK, FORCES, OVER


@Command(
    "table",
    "a machine's results over the stroke, as text or CSV",
    *machine_options(),
    option("columns", metavar="COLUMN", nargs="*", default=[], help=COLUMNS),
    repeatable("--columns", "I,kz", "the same, separated by commas", "listed"),
    CSV,
    *pose_options(11),
    EVERY,
    repeatable("--ratio", "G", "the derivatives of a point or an output; repeatable"),
    option("--wrt", metavar="S", help="the stroke of these derivatives (default: each)"),
    *FORCES,
    OVER,
    option("--pins", action="store_true", help="the largest force of every pin too, its load case, direction and pose"),
    option("--limits", action="store_true", help="how far each stroke goes too, dead points, transmission angles"),
    CHECK,
)
def table_command(options: Namespace) -> int:
    """Print or write the table of results."""
    fits = options.csv != "-" or not (options.pins or options.limits)
    ensure(fits, "--pins and --limits do not go into CSV; leave them out, or write it into a file, --csv table.csv.")
    machine = settings.machine_of(options)
    acting, motions = settings.acting_of(machine, options), settings.motions_at(machine, options)
    over, strokes, names = settings.judged_over(machine, options), list(machine.strokes), list(options.columns)
    for text in options.listed:  # a comma between parentheses belongs to its name, `reserve(lift, share=0.9)`
        listed = [name.strip() for name in re.split(r",(?![^()]*\))", text) if name.strip()]
        ensure(listed, f"--columns {cited(text)}: name at least one column, such as --columns thrust,pressure.")
        names += listed
    if options.ratio and not names:
        names = strokes  # ratios alone stand beside their strokes
    tables, judge = list[Table](), machine.judge(settings.overs_of(machine, options.over))
    for run, poses in motions:
        columns = settings.columns_picked(machine, poses, names, strokes, settings.plain_value(acting), None if run is None else run.case)
        columns += settings.ratio_columns(machine, poses, options.ratio, options.wrt)
        case = (settings.plain_value(acting).case or PLAIN_CASE) if run is None else run.case or PLAIN_CASE
        outside = np.ravel(poses.reached & ~judged_poses(judge, poses, case)).tolist()
        friction = friction_of_columns(poses, columns, settings.plain_value(acting).direction)
        tables.append((f"{heading_words(machine, run, poses)}\n{friction}".strip(), columns, outside))
    pins = worst_pins(machine, over, acting) if options.pins else ""
    write_tables(tables, options.csv)
    if pins:
        print(f"\n{pins}")
    if options.limits:
        print(f"\n{motions[0][1].limits()}")
    return settings.print_verdicts(machine.verdicts(over=over), options) if options.check else 0


def worst_pins(machine: Mechanism, over: Sequence[Over | Motion] | None, acting: Acting) -> str:
    """Return the table of the largest force of every joint over the given places, else over all that the machine runs.

    In all load cases and directions that `acting` leaves open; DefinitionError where nothing acts.
    """
    what = f"{machine.plan.title} declares no load, so that no pin carries anything"
    ensure(is_loaded(machine.judge(over, acting).motion), f"{what}; declare one, Weight(G, mass=100).")
    return table_text(max_table(machine, over, acting))


Table: TypeAlias = tuple[str, Sequence[Column], Sequence[bool]]
"""What stands over a table, "" for nothing, its columns, and which of its rows are outside what is judged."""


def heading_words(machine: Mechanism, run: Run | None, motion: Motion) -> str:
    """Return which run of several or of a load case a table is along, in words: `over reaching, in the case far: extend = 0 to 3000 mm`."""
    words = run_words(machine, run) if run is not None else ""
    if run is None or not words:
        return words
    where = motion.over.words(motion)
    others = "" if not run.worst else said("; {names} where {column} is worst", names=", ".join(run.held), column=heading_of(run.worst))
    return f"{words}{others}" if where in words else f"{words}: {where}{others}"


def write_tables(tables: Sequence[Table], file: str | None) -> None:
    """Print tables below each other, or write them as one CSV whose first column says which each row is of."""
    if file is None:
        for place, (heading, columns, outside) in enumerate(tables):
            if place:
                print()
            if heading:
                print(f"{heading}\n")
            write_table(columns, None, outside=outside)
        if any(any(outside) for _, _, outside in tables):
            print(f"\n{dagger_words()}")
        return
    if file != "-":  # what a file of numbers does not say
        print(*(f"{heading}\n\n" for heading, _, _ in tables if heading), sep="", end="")
    columns, labels = joined_tables([(heading.partition(":")[0], columns) for heading, columns, _ in tables])
    write_table(columns, file, labels)


def write_table(columns: Sequence[Column], file: str | None, labels: Sequence[str] = (), outside: Sequence[bool] = ()) -> None:
    """Print a table, or write it as CSV where a file is named, "-" being stdout; `labels` are the first field of each row there.

    It is printed in blocks as wide as a terminal there, else whole; `outside` says which rows are outside what is judged.
    """
    if file is None:
        width = get_terminal_size().columns if sys.stdout.isatty() else None
        print(*text_table(columns, width, outside), sep="\n")
        return
    if isinstance(sys.stdout, io.TextIOWrapper) and file == "-":
        sys.stdout.reconfigure(newline="")  # CR LF stays CR LF where the system would turn LF into that itself
    with nullcontext(sys.stdout) if file == "-" else replacing_text(file) as stream, progress_bar("writing CSV") as progress:
        write_csv(columns, stream, progress, labels)
    if file != "-":
        print(f"{file}: {max(np.size(each.values) for each in columns)} rows")


def write_columns(columns: Sequence[Column], path: Path, labels: Sequence[str] = ()) -> None:
    """Write columns into a file: CSV in full precision with units, or JSON lines in SI; an empty field, or null, where there is no value.

    `labels` are the first field of each row, its name.
    """
    with replacing_text(path) as stream:
        if path.suffix.lower() != ".jsonl":
            write_csv(columns, stream, labels=labels, labelled="name")
            return
        names = [*["name"][: len(labels)], *(column.name for column in columns)]
        for number, row in enumerate(zip(*(np.asarray(column.values, float).tolist() for column in columns), strict=True)):
            known = (value if np.isfinite(value) else None for value in row)
            stream.write(json.dumps(dict(zip(names, [*labels[number : number + 1], *known], strict=True))) + "\n")


# What drives, cylinders and pins carry.


@Command(
    "forces",
    "what drives, cylinders and pins carry over the stroke, and the worst of every pin over all load cases and directions",
    *machine_options(),
    CSV,
    *pose_options(11),
    EVERY,
    *FORCES,
    OVER,
    option("--poses", action="store_true", help="the force of every pin at every pose too"),
    option("--on", metavar="BODY", help="all forces on this body at every pose, which balance, instead: for FEM"),
    CHECK,
)
def forces_command(options: Namespace) -> int:
    """Print the forces of a machine's drives, cylinders and pins."""
    machine = settings.machine_of(options)
    acting, motions = settings.acting_of(machine, options), settings.motions_at(machine, options)
    over, plain = settings.judged_over(machine, options), settings.plain_value(acting)
    what = f"{machine.plan.title} declares no load, so that there is no force; declare one, load = Weight(G, mass=100)"
    ensure(is_loaded(motions[0][1]), f'{what}, or in a file: load = {{ Weight = "G", mass = 100 }}.')
    tables, found, signs = list[Table](), list[PinForces](), "Drive forces are positive the way the stroke grows, thrusts in a push."
    for run, motion in motions:
        there = plain if run is None or options.case is not None else replace(plain, case=run.case)
        pins = pin_forces(motion, case=there.case, direction=there.direction, drive=there.drive)
        columns = [column for column in columns_of(motion) if column.name in ("time", *motion.strokes)]
        columns += force_columns(motion, there.case, there.direction) if options.on is None else []
        for point, force in pins.on_body(options.on).items() if options.on is not None else ():
            columns += [Column(f"{point}_{axis}", part, "kN", 3) for axis, part in zip("xy", force, strict=True)]
        points = [joint.point for joint in pins.joints]
        for joint in pins.joints if options.poses and options.on is None else ():
            name = joint.point if points.count(joint.point) == 1 else f"{joint.point} on {joint.on} from {joint.by}"
            if joint.has_force:
                columns.append(Column(name, joint.size, "kN", 3))
            else:
                columns.append(Column(f"{name} couple", np.asarray(joint.couple), "Nm", 3))
        words = f"{run_words(machine, run)}: " if run is not None and len(motions) > 1 else ""
        case = "" if run is not None and words and in_case_words(machine.plan, run.case) else f", {pins.case}"  # once
        friction = friction_of_columns(motion, columns, there.direction)
        tables.append((f"{words}{machine.plan.title}{case}, {pins.direction}. {signs}\n{friction}".strip(), columns, ()))
        found.append(pins)
    write_tables(tables, options.csv)
    if options.csv == "-":
        return 0
    print(f"\n{worst_pins(machine, over, acting)}\n")
    remarks = dict.fromkeys(remark for pins in found for remark in pins.remarks)
    print(f"residual of equilibrium {max(pins.residual for pins in found):.0e}", *remarks, sep="\n")
    return settings.print_verdicts(machine.verdicts(over=over), options) if options.check else 0


# How far it goes.


@Command(
    "limits",
    "how far each stroke goes, what stops it, dead points, transmission angles, freedom",
    *machine_options(),
    repeatable("--at", "S=0.6", "where other strokes are held; repeatable", "strokes"),
    OVER,
    CHECK,
)
def limits_command(options: Namespace) -> int:
    """Print how far a machine goes."""
    machine = settings.machine_of(options)
    ensure(machine.strokes, f"{machine.plan.title} has no stroke, so there is nothing that goes; declare one, S = Stroke(0, 0.25).")
    motion = machine.at(unreachable="nan", **settings.poses_at(machine, options))
    over = settings.judged_over(machine, options)
    print(limits_over(motion, settings.overs_of(machine, options.over) or machine.overs))
    print(f"mobility {machine.mobility}; Gruebler count {machine.gruebler}", *machine.four_bars, sep="\n")
    return settings.print_verdicts(geometry_verdicts(machine.judge(over)), options) if options.check else 0
