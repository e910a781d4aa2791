"""What one joint transmits, and between which bodies."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..program import FloatArray


@dataclass(frozen=True, eq=False)
class JointForce:
    """What one joint transmits: the force on the body `on` from the body `by`, shape (2, ...) [N], with a couple (...) [Nm].

    `kind` is a pin, a guide, a slot, a driven point, a crank's drive, a slider or a telescope. `axis` are the two points that give
    the body's own x axis; for the frame it is None.
    """

    point: str
    on: str
    by: str
    kind: str
    force: FloatArray
    couple: FloatArray
    axis: tuple[str, str] | None = None

    @property
    def size(self) -> FloatArray:
        """The size of the force, shape (...) [N]."""
        return np.asarray(np.hypot(self.force[0], self.force[1]))

    @property
    def has_force(self) -> bool:
        """Whether it transmits a force; a crank's drive has only a couple."""
        return self.kind not in ("crank", "upright")

    def __str__(self) -> str:
        return f"{self.point} ({self.kind}) on {self.on} from {self.by}"
