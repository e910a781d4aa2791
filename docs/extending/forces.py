"""Force elements of one's own: a straight one by its law of length, and a general one by its loads."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from linkage import Dimension, ForceElement, Load
from linkage.loads import TwoPoint
from linkage.quantities import Reference, name_of


@dataclass(frozen=True, eq=False)
class GasStrut(TwoPoint):
    """A gas strut from A to B: `strut = GasStrut(A, B, force=800, extended=0.5, column=0.4)`, stiffer the further it is pushed in.

    `force` is its thrust at the length `extended` [m]; the gas stands in a column [m] that shortens with it, by p V^1.2.
    """

    A: Reference
    B: Reference
    force: float | Dimension
    extended: float | Dimension
    column: float | Dimension
    parameters: ClassVar[Mapping[str, str]] = {"force": "N", "extended": "mm", "column": "mm"}
    drawn_as: ClassVar[str] = "damper"

    def push(self, motion, length, rate):
        force, extended, column = (self.number(motion, name) for name in self.parameters)
        return force * (column / (column - (extended - length))) ** 1.2


@dataclass(frozen=True, eq=False)
class Soil(ForceElement):
    """Elastic soil under a point: `soil = Soil(R, height=0.05, stiffness=2e4)`.

    It pushes up in proportion to how far the point is below a height [m], by a stiffness [N/m], and never pulls.
    """

    point: Reference
    height: float | Dimension
    stiffness: float | Dimension
    parameters: ClassVar[Mapping[str, str]] = {"height": "mm", "stiffness": ""}

    def loads(self, motion):
        point = name_of(self.point)
        below = np.maximum(self.number(motion, "height") - motion[point][1], 0.0)
        return [Load(point, np.stack([0.0 * below, self.number(motion, "stiffness") * below]))]
