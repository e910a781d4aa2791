"""The equations of a mechanism, numbered, in the papers' notation: text, LaTeX, SymPy and numbers. SymPy lives here and nowhere else."""

from ..star import declare_public
from .numbered import Equation, Equations, equations
from .words import Tcos, TurnV, TurnVL, explicit

declare_public(globals())
