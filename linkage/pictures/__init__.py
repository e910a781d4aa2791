"""Pictures: a mechanism at a pose, at its end positions, and curves of results over the stroke."""

from .browser import page
from .curves import Limit, curves
from .drawing import Drawing, mechanism
from .film import animate
from .poses import poses




# Animations: the mechanism over its stroke and a live curve, as .gif, .mp4 or .html.



# The browser page: a mechanism that moves, in one file that needs no network.
