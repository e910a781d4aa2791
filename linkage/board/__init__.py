"""The drawing board: a page on which a machine is drawn, moves, and is written as a class."""

from ..star import declare_public
from .page import drawing_board

declare_public(globals())
