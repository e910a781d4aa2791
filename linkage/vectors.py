"""The algebra of the plane, on anything that adds and multiplies: floats, arrays, traced nodes."""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import dataclass
from enum import IntEnum
from typing import Any, Generic, Self, TypeAlias, TypeVar

import numpy as np
import numpy.typing as npt

FloatArray: TypeAlias = npt.NDArray[np.float64]
Mask: TypeAlias = npt.NDArray[np.bool_]
Index: TypeAlias = npt.NDArray[np.intp]
Numbers: TypeAlias = float | FloatArray
"""One number, or one for each design or pose."""
Scalar: TypeAlias = Any
"""A number, an array or a traced node: whatever the reading at hand works on."""


Given = TypeVar("Given")
Result = TypeVar("Result")


class Operators(Generic[Given, Result]):
    """The base of values with arithmetic: each of Python's operators is `applied`, by the name of NumPy's function, to its operands."""

    __slots__ = ()

    @abstractmethod
    def applied(self, function: str, *operands: Any) -> Result:
        """Apply NumPy's function of that name to operands, this one among them; NotImplemented to leave it to another one."""

    def __add__(self, other: Given) -> Result:
        return self.applied("add", self, other)

    def __radd__(self, other: Given) -> Result:
        return self.applied("add", other, self)

    def __sub__(self, other: Given) -> Result:
        return self.applied("subtract", self, other)

    def __rsub__(self, other: Given) -> Result:
        return self.applied("subtract", other, self)

    def __mul__(self, other: Given) -> Result:
        return self.applied("multiply", self, other)

    def __rmul__(self, other: Given) -> Result:
        return self.applied("multiply", other, self)

    def __truediv__(self, other: Given) -> Result:
        return self.applied("divide", self, other)

    def __rtruediv__(self, other: Given) -> Result:
        return self.applied("divide", other, self)

    def __pow__(self, other: Given) -> Result:
        return self.applied("power", self, other)

    def __rpow__(self, other: Given) -> Result:
        return self.applied("power", other, self)

    def __neg__(self) -> Result:
        return self.applied("negative", self)

    def __pos__(self) -> Self:
        return self

    def __abs__(self) -> Result:
        return self.applied("absolute", self)


def pick(a: Scalar, b: Scalar, x: Scalar, y: Scalar) -> Scalar:
    """Return x where a <= b, else y, of numbers and arrays."""
    return np.where(a <= b, x, y)


class Side(IntEnum):
    """The assembly mode of a point: LEFT or RIGHT of its first parent -> second parent."""

    LEFT = 1
    RIGHT = -1

    def __str__(self) -> str:
        return self.name

    @classmethod
    def parse(cls, word: object) -> Side | None:
        """Return the side that a word says, in small letters or capitals; a side is itself; None for anything else."""
        if isinstance(word, cls):
            return word
        return cls.__members__.get(word.upper()) if isinstance(word, str) else None


LEFT = Side.LEFT
RIGHT = Side.RIGHT


@dataclass(frozen=True, slots=True, eq=False)
class Vec:
    """A vector or a position in the plane [m]; the components are scalars of one reading."""

    x: Scalar
    y: Scalar

    def __add__(self, other: Vec) -> Vec:
        return Vec(self.x + other.x, self.y + other.y)

    def __sub__(self, other: Vec) -> Vec:
        return Vec(self.x - other.x, self.y - other.y)

    def __neg__(self) -> Vec:
        return Vec(-self.x, -self.y)

    def __mul__(self, factor: Scalar) -> Vec:
        return Vec(self.x * factor, self.y * factor)

    def dot(self, other: Vec) -> Scalar:
        """Return the scalar product [m2]."""
        return self.x * other.x + self.y * other.y

    def cross(self, other: Vec) -> Scalar:
        """Return the z component of the vector product [m2], positive when `other` lies to the left."""
        return self.x * other.y - self.y * other.x

    def left(self) -> Vec:
        """Return this vector turned by +90 degrees."""
        return Vec(-self.y, self.x)

    def turned(self, cos: Scalar, sin: Scalar) -> Vec:
        """Return this vector turned by the angle with that cosine and sine."""
        return Vec(self.x * cos - self.y * sin, self.x * sin + self.y * cos)

    def square(self) -> Scalar:
        """Return the squared length [m2]."""
        return self.x * self.x + self.y * self.y

    def length(self) -> Scalar:
        """Return the length [m]."""
        return np.sqrt(self.square())


@dataclass(frozen=True, slots=True, eq=False)
class Line:
    """A straight line: an origin [m] and a direction of length one."""

    origin: Vec
    direction: Vec

    def at(self, along: Scalar) -> Vec:
        """Return the point at a distance along the line [m]."""
        place: Vec = self.origin + self.direction * along
        return place
