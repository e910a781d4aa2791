"""The ordered steps, their dimensions, and their program."""

from .bodies import Body, merged
from .chain import KinematicChain, Pair, arm_joint, arm_points, chain_of, gruebler, holds_an_arm
from .measure import plan_measure
from .members import as_written, construction_order, needed_names, printed, strokes_text
from .missing import Mask, called, failures, missing_words, negative, opening
from .plan import Plan
from .reading import ArrayReading, Reading
from .table import DesignVariable, Table
from .trace import NEAR, REGULAR, Guard, Loop, Nearness, Trace
