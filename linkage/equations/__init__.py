"""The equations of a mechanism, numbered, in the papers' notation: text, LaTeX, SymPy and numbers.

`from linkage.equations import equations`, then `print(equations(machine))`; calling the module does the same, so that
`from linkage import equations` works before and after this room is loaded. SymPy lives here and nowhere else.
"""

from __future__ import annotations

import sys
from types import ModuleType
from typing import Any

from .equation import Equation as Equation
from .numbered import Equations as Equations
from .numbered import equations as equations
from .words import Tcos as Tcos
from .words import TurnV as TurnV
from .words import TurnVL as TurnVL
from .words import explicit as explicit


class _Room(ModuleType):
    """This module, callable."""

    def __call__(self, machine: Any, **options: Any) -> Equations:
        return equations(machine, **options)


sys.modules[__name__].__class__ = _Room
