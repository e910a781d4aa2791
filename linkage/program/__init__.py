"""The traced straight-line program, its derivatives and its kernels."""

from ..star import declare_public
from ..vectors import FloatArray, pick
from .cache import compiled
from .derivatives import Tangent, gradient, jacobian
from .elimination import SparseSystem, eliminated, expanded, is_zero
from .interpret import LAST, Iterated, Scatter, disturbed, interpret
from .intervals import Enclosure, enclosures
from .kernel import BACKEND, QUICKEST, Backend, BackendName, Kernel, Result, RunOptions, fixed_backend
from .languages import LANGUAGES, Inputs, Language, ProgramText, arrow_function, function_body, number, short_names
from .node import Graph, Level, Node
from .operations import ARRAYS, FLOATS, NO_VALUE, solve_arrays
from .schedule import Schedule, ancestors, lowered, replaced
from .text import GUARDED, TEMPLATES, Dialect
from .traced import Comparison, Notes, Traced, claim, elementwise, is_traced, node_of

declare_public(globals())
