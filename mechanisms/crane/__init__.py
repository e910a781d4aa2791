"""A forestry crane: skeleton, masses, bound of moments, drives, load map, reach.

Source: Syunyov, Seliverstov, Gerasimov, Sokolov, "Lesosechnye mashiny v fokuse bioenergetiki", chapter 2.
"""

from .cylinders import arm_moment as arm_moment
from .cylinders import boom_moment as boom_moment
from .cylinders import drive_limits as drive_limits
from .duty import Duty as Duty
from .load_map import LoadMap as LoadMap
from .load_map import load_map as load_map
from .machine import BellCrankCrane as BellCrankCrane
from .machine import ChainCrane as ChainCrane
from .machine import Crane as Crane
from .moments import arm_bound as arm_bound
from .moments import boom_bound as boom_bound
from .skeleton import BackBrokenSkeleton as BackBrokenSkeleton
from .skeleton import CraneSkeleton as CraneSkeleton
