"""A machine as a sketch: pins by coordinates, named links, slides and drives; read from drawings and other programs' files."""

from ..star import declare_public
from .machine_sketch import MachineSketch, SketchDrive, SketchForce, SketchSlide, SketchWeight
from .read import is_foreign, read_sketch
from .sketch_of import sketch_of
from .write import sketch_text

declare_public(globals())
