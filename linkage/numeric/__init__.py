"""Functions of numbers: highest values, zeros, all solutions, convex pieces. They know no machine."""

from ..star import declare_public
from .convex import Corners, convex_pieces, crosses_itself, signed_area
from .line import highest, last_holding

declare_public(globals())
