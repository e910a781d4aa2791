"""The equations of a mechanism, numbered, in the papers' notation: text, LaTeX, SymPy and numbers. SymPy lives here and nowhere else."""

from ..star import declare_public
from .names import Tcos, TurnV, TurnVL, explicit
from .numbered import Equation, Equations, equations

declare_public(globals())
