"""Arithmetic of what is no quantity itself and calculates with quantities: what is asked of a motion at its poses, or of a whole stroke."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Any, NoReturn

import numpy as np

from ..errors import DefinitionError

TAKEN = (
    "add", "subtract", "multiply", "divide", "power", "negative", "absolute", "minimum", "maximum", "hypot", "sqrt", "sin", "cos", "tan",
    "arctan2", "exp", "log",
)  # fmt: skip
"""NumPy's functions that are taken of it, by name."""


class Arithmetic(ABC):
    """The base of what is added, multiplied and given to NumPy's functions beside numbers and quantities. A subclass says `applied`."""

    @abstractmethod
    def applied(self, function: str, *operands: Any) -> Any:
        """Return what NumPy's function of that name makes of operands, this one among them; NotImplemented to leave it to another one."""

    def __add__(self, other: Any) -> Any:
        return self.applied("add", self, other)

    def __radd__(self, other: Any) -> Any:
        return self.applied("add", other, self)

    def __sub__(self, other: Any) -> Any:
        return self.applied("subtract", self, other)

    def __rsub__(self, other: Any) -> Any:
        return self.applied("subtract", other, self)

    def __mul__(self, other: Any) -> Any:
        return self.applied("multiply", self, other)

    def __rmul__(self, other: Any) -> Any:
        return self.applied("multiply", other, self)

    def __truediv__(self, other: Any) -> Any:
        return self.applied("divide", self, other)

    def __rtruediv__(self, other: Any) -> Any:
        return self.applied("divide", other, self)

    def __pow__(self, other: Any) -> Any:
        return self.applied("power", self, other)

    def __rpow__(self, other: Any) -> Any:
        return self.applied("power", other, self)

    def __neg__(self) -> Any:
        return self.applied("negative", self)

    def __pos__(self) -> Any:
        return self

    def __abs__(self) -> Any:
        return self.applied("absolute", self)

    def __array_ufunc__(self, ufunc: np.ufunc, method: str, *inputs: Any, **options: object) -> Any:
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
