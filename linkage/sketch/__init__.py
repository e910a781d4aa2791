"""A machine as a sketch: pins by coordinates, named links, slides and drives; read from drawings and other programs' files."""

from ..star import declare_public
from .foreign_files import is_foreign, read_sketch, sketch_text
from .machine_sketch import MachineSketch, SketchDrive, SketchForce, SketchSlide, SketchWeight
from .sketch_of import sketch_of

declare_public(globals())
