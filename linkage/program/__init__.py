"""The traced straight-line program, its derivatives and its kernels."""

from .cache import compiled
from .derivatives import Tangent, gradient, jacobian
from .elimination import eliminated, expanded, is_zero
from .foreign import c_text, javascript_text
from .interpret import Iterated, interpret, scatter
from .kernel import PINNED, QUICKEST, Kernel, Result, Way, pinned
from .linear import solve_arrays
from .loop import HEAD, NUMBA, lane_loop
from .node import Closure, Graph, Level, Node
from .numba_backend import compiled_loop, pays_compiled
from .numpy_backend import FloatArray
from .operations import ARRAYS, FLOATS, NO_VALUE, pick
from .schedule import ancestors, lowered, plain
from .text import GUARDED, Dialect, function
from .traced import Notes, Traced, node_of
