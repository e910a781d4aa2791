"""A forestry crane: skeleton, masses, bound of moments, drives, load map, reach.

Source: Syunyov, Seliverstov, Gerasimov, Sokolov, "Lesosechnye mashiny v fokuse bioenergetiki", chapter 2.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from linkage.star import declare_public

from .arm_drive import AngledBellCrankArmDrive as AngledBellCrankArmDrive
from .arm_drive import ArmDrive as ArmDrive
from .arm_drive import ArmDriveByCylinder as ArmDriveByCylinder
from .arm_drive import BellCrankArmDrive as BellCrankArmDrive
from .arm_drive import BellCrankArmDriveByCylinder as BellCrankArmDriveByCylinder
from .arm_drive import DirectArmDrive as DirectArmDrive
from .arm_drive import DirectArmDriveAbove as DirectArmDriveAbove
from .arm_drive import DrivenArm as DrivenArm
from .boom_drive import BoomDrive as BoomDrive
from .cylinders import arm_moment as arm_moment
from .cylinders import boom_moment as boom_moment
from .cylinders import drive_limits as drive_limits
from .drive_design import ArmRules as ArmRules
from .drive_design import DriveDesign as DriveDesign
from .drive_design import arm_drive_front as arm_drive_front
from .drive_design import design_arm_drive as design_arm_drive
from .drive_design import design_boom_drive as design_boom_drive
from .drive_duty import DriveCylinders as DriveCylinders
from .drive_duty import DriveDuty as DriveDuty
from .drive_duty import duty_of as duty_of
from .duty import Duty as Duty
from .flow import CraneDesign as CraneDesign
from .flow import arm_drive_of as arm_drive_of
from .flow import boom_drive_of as boom_drive_of
from .flow import design_crane as design_crane
from .flow import design_skeleton as design_skeleton
from .flow import with_drives as with_drives
from .load_map import envelope as envelope
from .load_map import load_map as load_map
from .machine import BellCrankCrane as BellCrankCrane
from .machine import ChainCrane as ChainCrane
from .machine import Crane as Crane
from .machine import DirectCrane as DirectCrane
from .machine import DirectCraneAbove as DirectCraneAbove
from .moments import arm_bound as arm_bound
from .moments import boom_bound as boom_bound
from .skeleton import BackBrokenSkeleton as BackBrokenSkeleton
from .skeleton import CraneSkeleton as CraneSkeleton
from .strength import strength as strength

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FIGURES = ("positions", "moments", "map", "reach")
DRIVE_FIGURES = ("moments", "positions")


def drive_figure(name: str, drive: BoomDrive | DrivenArm) -> Figure:
    """Return a figure of a drive as a matplotlib figure; DefinitionError for an unknown name, a batch.

    "moments" is what it gives and what is asked of it over its angle, "positions" the drive at its ends and where it has least to spare.
    """
    from .figures import drive_figure

    return drive_figure(name, drive)


def crane_figure(name: str, crane: Crane | None = None) -> Figure:
    """Return a figure of a crane, by default the shipped one, as a matplotlib figure; DefinitionError for an unknown name, a batch.

    "positions" are those that its skeleton is laid out by, "moments" what boom and arm are given and asked for, "map" the load map,
    "reach" all that the tip reaches.
    """
    from .figures import crane_figure

    return crane_figure(name, crane)


declare_public(globals())
