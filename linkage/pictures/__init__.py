"""Pictures: a mechanism at a pose, at its end positions, in motion, and curves of results over the stroke."""

from .browser import page, page_html
from .chain import draw_chain
from .curves import Limit, plot, plot_machine
from .designs import draw_designs
from .drawing import Drawing, mechanism
from .film import animate
from .mode_page import draw_modes
from .optimum import draw_optimum, plot_optimum
from .poses import draw
from .tolerances import plot_bands, plot_tornado
from .zone import plot_zone
