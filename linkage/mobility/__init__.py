"""The mobility: the rank of the constraints, redundant and locking links."""

from .count import Mobility as Mobility
from .count import check as check
from .count import mobility as mobility
from .grashof import FourBar as FourBar
from .grashof import four_bars as four_bars
from .grashof import grashof as grashof
