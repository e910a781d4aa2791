"""Planar linkages moved by cylinders, described the way an engineer says them."""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from .errors import AssemblyError as AssemblyError
from .errors import DefinitionError as DefinitionError
from .errors import FileError as FileError
from .errors import LinkageError as LinkageError
from .errors import SingularError as SingularError
from .errors import SingularWarning as SingularWarning
from .errors import StudyError as StudyError
from .loads import Actuator as Actuator
from .loads import Between as Between
from .loads import Damper as Damper
from .loads import Force as Force
from .loads import ForceElement as ForceElement
from .loads import GuideFriction as GuideFriction
from .loads import LinkMass as LinkMass
from .loads import Load as Load
from .loads import LoadCase as LoadCase
from .loads import Moment as Moment
from .loads import PinFriction as PinFriction
from .loads import Spring as Spring
from .loads import Support as Support
from .loads import Weight as Weight
from .mechanism import Mechanism as Mechanism
from .mobility import grashof as grashof
from .motion import Column as Column
from .motion import Motion as Motion
from .motion import condition as condition
from .motion import ratio as ratio
from .quantities import Dimension as Dimension
from .quantities import Stroke as Stroke
from .quantities import angle as angle
from .quantities import distance as distance
from .quantities import ref as ref
from .quantities import x as x
from .quantities import y as y
from .statics import PinForces as PinForces
from .statics import drive_force as drive_force
from .statics import driving_force as driving_force
from .statics import max_table as max_table
from .statics import pin_force as pin_force
from .statics import pin_forces as pin_forces
from .statics import reaction as reaction
from .steps import CosineAngle as CosineAngle
from .steps import Crank as Crank
from .steps import Dyad as Dyad
from .steps import Ground as Ground
from .steps import Group as Group
from .steps import Guide as Guide
from .steps import GuideCross as GuideCross
from .steps import Link as Link
from .steps import Offset as Offset
from .steps import OnGuide as OnGuide
from .steps import OnLink as OnLink
from .steps import Pin as Pin
from .steps import PinSlotDyad as PinSlotDyad
from .steps import Slide as Slide
from .steps import SliderDyad as SliderDyad
from .steps import Turn as Turn
from .steps import Vector as Vector
from .steps import YokeDyad as YokeDyad
from .steps import drawn as drawn
from .units import MPa as MPa
from .units import bar as bar
from .units import cm as cm
from .units import deg as deg
from .units import kg as kg
from .units import kgf as kgf
from .units import kgf_cm2 as kgf_cm2
from .units import kN as kN
from .units import litre as litre
from .units import mm as mm
from .vectors import LEFT as LEFT
from .vectors import RIGHT as RIGHT

if TYPE_CHECKING:
    from .formulas import equations as equations


def __getattr__(name: str) -> Any:
    """Return `equations`, loaded where it is first used: it brings SymPy."""
    if name == "equations":
        return import_module(".equations", __name__)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
