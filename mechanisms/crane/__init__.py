"""A forestry crane: skeleton, masses, bound of moments, drives, load map, reach.

Source: Syunyov, Seliverstov, Gerasimov, Sokolov, "Lesosechnye mashiny v fokuse bioenergetiki", chapter 2.
"""

from linkage.star import late_names

__getattr__, __dir__ = late_names(globals())
