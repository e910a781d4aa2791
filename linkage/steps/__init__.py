"""Construction steps: each places one thing from things already placed."""

from .crank import Crank as Crank
from .dyad import Dyad as Dyad
from .dyad import triangle as triangle
from .ground import Ground as Ground
from .labels import Claims as Claims
from .labels import Slot as Slot
from .labels import match as match
from .link import Link as Link
from .onlink import OnLink as OnLink
from .primitives import Arrow as Arrow
from .primitives import CosineAngle as CosineAngle
from .primitives import Offset as Offset
from .primitives import Turn as Turn
from .primitives import Vector as Vector
from .step import UNBOUND as UNBOUND
from .step import Bar as Bar
from .step import Point as Point
from .step import Step as Step
