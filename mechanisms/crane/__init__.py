"""A forestry crane: skeleton, masses, bound of moments, drives, load map, reach.

Source: Syunyov, Seliverstov, Gerasimov, Sokolov, "Lesosechnye mashiny v fokuse bioenergetiki", chapter 2.
"""

from .duty import Duty as Duty
from .skeleton import BackBrokenSkeleton as BackBrokenSkeleton
from .skeleton import CraneSkeleton as CraneSkeleton
