"""A forestry crane: skeleton, masses, bound of moments, drives, load map, reach.

Source: Syunyov, Seliverstov, Gerasimov, Sokolov, "Lesosechnye mashiny v fokuse bioenergetiki", chapter 2.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from linkage.star import declare_public

from .. import paper
from .drive_design import ArmRules, DriveDesign, arm_drive_front, design_arm_drive, design_boom_drive
from .drives import (
    AngledBellCrankArmDrive,
    ArmDrive,
    ArmDriveByCylinder,
    BellCrankArmDrive,
    BellCrankArmDriveByCylinder,
    BoomDrive,
    DirectArmDrive,
    DirectArmDriveAbove,
    DrivenArm,
)
from .duty import DriveCylinders, DriveDuty, Duty, arm_bound, boom_bound, duty_of
from .flow import CraneDesign, arm_drive_of, boom_drive_of, design_crane, design_skeleton, with_drives
from .load_map import arm_moment, boom_moment, drive_limits, envelope, load_map, strength
from .machine import BellCrankCrane, ChainCrane, Crane, DirectCrane, DirectCraneAbove
from .skeleton import BackBrokenSkeleton, CraneSkeleton

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FIGURES = ("positions", "moments", "map", "reach")
DRIVE_FIGURES = ("moments", "positions")


def drive_figure(name: str, drive: BoomDrive | DrivenArm) -> Figure:
    """Return a figure of a drive as a matplotlib figure.

    Parameters
    ----------
    name : {"moments", "positions"}
        "moments" is what it gives and what is asked of it over its angle, "positions" the drive at its ends and where it has least to
        spare.
    drive : BoomDrive or DrivenArm
        The drive.

    Returns
    -------
    Figure
        The figure.

    Raises
    ------
    DefinitionError
        The name is not known, or it is a batch of designs.
    """
    from .figures import DRIVES

    return paper.named_figure(DRIVES, name, drive)


def crane_figure(name: str, crane: Crane | None = None) -> Figure:
    """Return a figure of a crane as a matplotlib figure.

    Parameters
    ----------
    name : {"positions", "moments", "map", "reach"}
        "positions" are those that its skeleton is laid out by, "moments" what boom and arm are given and asked for, "map" the load map,
        "reach" all that the tip reaches.
    crane : Crane, optional
        The crane, by default the shipped one.

    Returns
    -------
    Figure
        The figure.

    Raises
    ------
    DefinitionError
        The name is not known, or it is a batch of designs.
    """
    from .figures import DRAWN

    return paper.named_figure(DRAWN, name, crane if crane is not None else Crane())


declare_public(globals())
