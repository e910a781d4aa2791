"""Synthesis: machines for a path, a function or poses, by search and by algebra, from a catalogue and over chains."""

from ..star import declare_public
from .curve_catalogue import CurveCatalogue, CurveMatch
from .synthesis import Synthesis, SynthesisedMachine
from .task_search import synthesise
from .tasks import FunctionTask, PathTask, PoseTask, point_errors, task_error

declare_public(globals())
