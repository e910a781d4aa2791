"""The names of the room, each with the file it comes from: what type checkers read, and `__init__.py` too."""

from .browser import page as page
from .browser import page_html as page_html
from .by_kind import draw as draw
from .by_kind import plot as plot
from .drawing import Drawing as Drawing
from .drawing import mechanism as mechanism
from .film import animate as animate
from .shown_values import Limit as Limit
from .tolerances import plot_bands as plot_bands
from .tolerances import plot_tornado as plot_tornado
from .tolerances import plot_zone as plot_zone
