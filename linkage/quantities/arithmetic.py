"""Arithmetic with quantities of what is not one itself: requests at a motion's poses, measures of a whole stroke."""

from __future__ import annotations

from abc import ABC
from typing import Any, NoReturn

import numpy as np

from ..errors import DefinitionError
from ..vectors import Operators

TAKEN = (
    "add", "subtract", "multiply", "divide", "power", "negative", "absolute", "minimum", "maximum", "hypot", "sqrt", "sin", "cos", "tan",
    "arctan2", "exp", "log",
)  # fmt: skip
"""NumPy's functions that are taken of it, by name."""


class Arithmetic(Operators[Any, Any], ABC):
    """The base of what is added, multiplied and given to NumPy's functions beside numbers and quantities. A subclass says `applied`."""

    def __array_ufunc__(self, ufunc: np.ufunc, method: str, *inputs: object, **options: object) -> Any:
        name = {"true_divide": "divide", "fabs": "absolute"}.get(ufunc.__name__, ufunc.__name__)
        if method != "__call__" or options or name not in TAKEN:
            raise DefinitionError(f"np.{ufunc.__name__} of {self} is not provided in this form; use one of: {', '.join(TAKEN)}.")
        return self.applied(name, *inputs)

    def _not_provided(self, *others: object) -> NoReturn:
        raise DefinitionError(f"{self}: what is asked for takes + - * / ** and NumPy's functions: {', '.join(TAKEN)}.")

    __mod__ = __rmod__ = __floordiv__ = __rfloordiv__ = __matmul__ = __rmatmul__ = __divmod__ = __rdivmod__ = __round__ = _not_provided

    def __bool__(self) -> NoReturn:
        raise DefinitionError(f"{self} has no value before it is asked of a motion, so that `if`, `and`, `or` cannot choose by it.")

    def __float__(self) -> NoReturn:
        raise DefinitionError(f"{self} has no value before it is asked of a motion; take NumPy's functions, np.sqrt(...), not math's.")
