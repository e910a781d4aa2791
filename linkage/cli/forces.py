"""`hydrolinkage forces NAME` and `limits NAME`: what drives and pins carry, and how far a machine goes."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from collections.abc import Iterator
from typing import final

import numpy as np

from ..errors import DefinitionError, ensure
from ..motion import Column, Over, columns_of, geometry_verdicts, limits_over
from ..reports import force_columns, is_loaded
from ..statics import PinForces
from . import settings
from .command import Command, every_argument, machine_arguments, motion_arguments, repeatable
from .table import csv_argument, pins_of, worst_pins, write_table


@final
class ForcesCommand(Command):
    """Prints what a machine's drives, cylinders and pins carry."""

    name = "forces"
    help = "what drives, cylinders and pins carry over the stroke, and the worst of every pin over all load cases and directions"

    def add(self, parser: ArgumentParser) -> None:
        machine_arguments(parser)
        csv_argument(parser)
        motion_arguments(parser, 11)
        every_argument(parser)
        settings.force_arguments(parser)
        settings.over_argument(parser)
        parser.add_argument("--poses", action="store_true", help="the force of every pin at every pose too")
        parser.add_argument("--on", metavar="BODY", help="all forces on this body at every pose, which balance, instead: for FEM")
        settings.check_argument(parser)

    def run(self, options: Namespace) -> int:
        machine = settings.machine_of(options)
        acting, motion = settings.acting_of(machine, options), settings.motion_at(machine, options)
        over, plain = settings.judged_over(machine, options), settings.plain_value(acting)
        if not is_loaded(motion):
            what = f"{machine.plan.title} declares no load, so that there is no force; declare one, load = Weight(G, mass=100)"
            raise DefinitionError(f'{what}, or in a file: load = {{ Weight = "G", mass = 100 }}.')
        pins = pins_of(motion, plain)
        columns = [column for column in columns_of(motion) if column.name in motion.strokes]
        if options.on is None:
            columns += force_columns(motion, plain.case, plain.direction)
            columns += joint_columns(pins) if options.poses else []
        else:
            forces = pins.on_body(options.on).items()
            columns += [Column(f"{point}_{axis}", part, "kN", 3) for point, force in forces for axis, part in zip("xy", force, strict=True)]
        if options.csv != "-":
            signs = "Drive forces are positive the way the stroke grows, thrusts in a push."
            print(f"{machine.plan.title}, {pins.case}, {pins.direction}. {signs}\n")
        write_table(columns, motion.reached.size, options.csv)
        if options.csv == "-":
            return 0
        print(f"\n{worst_pins(machine, over, acting)}\n")
        print(f"residual of equilibrium {pins.residual:.0e}", *pins.remarks, sep="\n")
        return settings.print_verdicts(machine.verdicts(over=over), options) if options.check else 0


def joint_columns(pins: PinForces) -> Iterator[Column]:
    """Yield the force, or the couple, of every joint."""
    points = [joint.point for joint in pins.joints]
    for joint in pins.joints:
        name = joint.point if points.count(joint.point) == 1 else f"{joint.point} on {joint.on} from {joint.by}"
        yield Column(name, joint.size, "kN", 3) if joint.has_force else Column(f"{name} couple", np.asarray(joint.couple), "Nm", 3)


@final
class LimitsCommand(Command):
    """Prints how far a machine goes."""

    name = "limits"
    help = "how far each stroke goes, what stops it, dead points, transmission angles, freedom"

    def add(self, parser: ArgumentParser) -> None:
        machine_arguments(parser)
        repeatable(parser, "--at", "S=0.6", "where other strokes are held; repeatable", "strokes")
        settings.over_argument(parser)
        settings.check_argument(parser)

    def run(self, options: Namespace) -> int:
        machine = settings.machine_of(options)
        ensure(machine.strokes, f"{machine.plan.title} has no stroke, so there is nothing that goes; declare one, S = Stroke(0, 0.25).")
        motion = machine.at(unreachable="nan", **settings.poses_at(machine, options, settings.POSES))
        over = settings.judged_over(machine, options)
        print(limits_over(motion, settings.overs_of(machine, options.over) or [Over()]))
        print(f"mobility {machine.mobility}; Gruebler count {machine.gruebler}", *machine.four_bars, sep="\n")
        return settings.print_verdicts(geometry_verdicts(machine.judge(over)), options) if options.check else 0
