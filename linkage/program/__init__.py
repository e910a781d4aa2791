"""The traced straight-line program, its derivatives and its kernels."""

from .adjoint import gradient as gradient
from .arrays import FloatArray as FloatArray
from .expand import eliminated as eliminated
from .foreign import c_text as c_text
from .foreign import javascript_text as javascript_text
from .interpret import interpret as interpret
from .kernel import QUICKEST as QUICKEST
from .kernel import Kernel as Kernel
from .kernel import Result as Result
from .kernel import Way as Way
from .linear import solve_arrays as solve_arrays
from .lower import ancestors as ancestors
from .node import Closure as Closure
from .node import Graph as Graph
from .node import Level as Level
from .node import Node as Node
from .operations import NO_VALUE as NO_VALUE
from .pin import pinned as pinned
from .rounding import Iterated as Iterated
from .rounding import scatter as scatter
from .tangent import Tangent as Tangent
from .tangent import jacobian as jacobian
from .traced import Notes as Notes
from .traced import Traced as Traced
from .traced import node_of as node_of
