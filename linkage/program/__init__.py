"""The traced straight-line program, its derivatives and its kernels."""

from ..vectors import FloatArray
from .derivatives import Tangent, gradient, jacobian
from .elimination import eliminated
from .foreign import c_text, javascript_text
from .interpret import Iterated, interpret, scatter
from .kernel import QUICKEST, Kernel, Result, Way, fixed_backend
from .linear import solve_arrays
from .node import Closure, Graph, Level, Node
from .operations import NO_VALUE
from .schedule import ancestors
from .traced import Notes, Traced, node_of
