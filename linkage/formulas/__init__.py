"""The equations of a mechanism, numbered, in the papers' notation: text, LaTeX, SymPy and numbers.

`from linkage.formulas import equations`, then `print(equations(machine))`; calling the module does the same, so that
`from linkage import equations` works before and after this room is loaded. SymPy lives here and nowhere else.
"""

from __future__ import annotations

import sys
from types import ModuleType
from typing import Any

from .numbered import Equation, Equations, equations
from .words import Tcos, TurnV, TurnVL, explicit


class _Room(ModuleType):
    """This module, callable."""

    def __call__(self, machine: Any, **options: Any) -> Equations:
        return equations(machine, **options)


sys.modules[__name__].__class__ = _Room
