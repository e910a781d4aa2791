"""Construction steps: each places one thing from things already placed."""

from ..star import declare_public
from .crank import Crank
from .dyad import Dyad
from .ground import Carried, Ground
from .guide import Guide, OnGuide, Slide
from .keeping import with_bodies
from .labels import DimensionTable, Slot, match
from .link import Link
from .onlink import OnLink
from .pin import Drawn, Group, Pin, drawn, strokes_drawn
from .primitives import Arrow, Axis, CosineAngle, Offset, Turn, Vector, triangle
from .sliders import GuideCross, PinSlotDyad, SliderDyad, YokeDyad
from .step import UNBOUND, Assignment, Bar, Contour, Point, Step

declare_public(globals())
