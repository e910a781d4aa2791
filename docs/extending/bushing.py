"""A nonlinear bushing, with units of its own for what it is declared by."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from linkage import Dimension
from linkage.loads import TwoPoint
from linkage.quantities import Reference
from linkage.units import add_unit, inch, lbf

Ns_m = add_unit("N s/m", 1.0, "damping")
add_unit("lbf s/in", lbf / inch, "damping", systems=["us"])


@dataclass(frozen=True, eq=False)
class Bushing(TwoPoint):
    """A bushing from A to B: `bushing = Bushing(A, B, damping=250 * Ns_m, stiffening=40)`.

    Its force is in proportion to the rate of its length, by `damping` [N s/m], and stiffens by a share of it per m/s.
    """

    A: Reference
    B: Reference
    damping: float | Dimension
    stiffening: float | Dimension
    parameters: ClassVar[Mapping[str, str]] = {"damping": "N s/m", "stiffening": ""}
    drawn_as: ClassVar[str] = "damper"

    def push(self, motion, length, rate):
        damping, stiffening = (self.number(motion, name) for name in self.parameters)
        return -damping * (1.0 + stiffening * np.abs(rate)) * rate
