"""Scalars of a mechanism: strokes, dimensions, outputs, and arithmetic of them."""

from .inputs import Dimension as Dimension
from .inputs import Stroke as Stroke
from .member import Member as Member
from .member import Reference as Reference
from .member import name_of as name_of
from .member import needs as needs
from .outputs import Angle as Angle
from .outputs import Coordinate as Coordinate
from .outputs import Distance as Distance
from .outputs import Length as Length
from .outputs import angle as angle
from .outputs import distance as distance
from .outputs import label as label
from .outputs import x as x
from .outputs import y as y
from .quantity import Negative as Negative
from .quantity import Number as Number
from .quantity import Quantity as Quantity
from .quantity import Ref as Ref
from .quantity import Sum as Sum
from .quantity import Turning as Turning
from .quantity import Variable as Variable
from .quantity import Where as Where
from .quantity import quantity as quantity
from .quantity import ref as ref
from .quantity import spelled as spelled
