"""Pictures: a mechanism at a pose, at its end positions, in motion, and curves of results over the stroke."""

from ..star import declare_public
from .browser import page, page_html
from .curves import Limit
from .draw import draw, plot
from .drawing import Drawing, mechanism
from .film import animate
from .tolerances import plot_bands, plot_tornado, plot_zone

declare_public(globals())
