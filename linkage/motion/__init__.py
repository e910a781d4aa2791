"""Where everything is over the stroke: positions, ratios, angles, distances."""

from .column import Column as Column
from .motion import Motion as Motion
from .motion import Target as Target
from .paired import Paired as Paired
from .reach import stroke_unit as stroke_unit
from .strokes import at_values as at_values
from .strokes import sweep_values as sweep_values
