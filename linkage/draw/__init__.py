"""Pictures: a mechanism at a pose, at its end positions, and curves of results over the stroke."""

from .curves import curves as curves
from .drawing import Drawing as Drawing
from .drawing import mechanism as mechanism
from .limits import Limit as Limit
from .poses import poses as poses
