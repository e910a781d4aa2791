"""Where everything is over the stroke: positions, ratios, angles, distances."""

<<<<<<< HEAD
from .asked import rates_of as rates_of
=======
>>>>>>> extremes
from .below import Span as Span
from .below import below_zero as below_zero
from .below import reached as reached
from .bulk import evaluate as evaluate
from .column import Column as Column
from .extremes import Extremum as Extremum
from .extremes import greatest as greatest
from .extremes import lowest as lowest
from .function import PoseFunction as PoseFunction
from .function import function_of as function_of
from .grid import Grid as Grid
from .motion import Motion as Motion
from .motion import Target as Target
from .paired import Paired as Paired
from .reach import stroke_unit as stroke_unit
from .request import Ratio as Ratio
from .request import Request as Request
from .request import Value as Value
from .request import ratio as ratio
from .source import source_of as source_of
from .strokes import as_given as as_given
from .strokes import at_values as at_values
from .strokes import sweep_values as sweep_values
from .table import columns_of as columns_of
from .wanted import Asked as Asked
from .wanted import Wanted as Wanted
