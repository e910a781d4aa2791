"""The mobility: the rank of the constraints, redundant and locking links, the chain as a graph."""

from ..star import declare_public
from .count import ChainTables, Mobility, chain_graph, check, mobility
from .enumeration import MOST_LINKS, Form, canonical, chain_forms, joint_pairs
from .grashof import FourBar, four_bars, grashof

declare_public(globals())
