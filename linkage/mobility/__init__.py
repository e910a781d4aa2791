"""The mobility: the rank of the constraints, redundant and locking links."""

from .count import Mobility, check, mobility
from .grashof import FourBar, four_bars, grashof
