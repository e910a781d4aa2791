"""A force at a point: what every force element comes down to."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Load:
    """A force [N], shape (2, ...), that acts at a point; the rest of its shape broadcasts against the motion's.

    At a pin that several bodies share it acts on the body that carries the pin (the frame, else the one declared
    first), unless `on` names two points of the body that is meant, or a two-point element by its name.
    """

    point: str
    force: Array
    on: tuple[str, ...] = ()


@dataclass(frozen=True, eq=False)
class Push:
    """The thrust [N] of a straight two-point member, positive where it pushes its ends apart; it broadcasts against the motion."""

    member: Any
    thrust: Array


def couple(P: str, Q: str, arm: Array, moment: Array) -> list[Load]:
    """Return a moment [Nm], counter-clockwise, on the body of P and Q as a pair of forces; `arm` is Q - P, shape (2, ...) [m]."""
    across = np.stack([-arm[1], arm[0]]) * (moment / (arm[0] ** 2 + arm[1] ** 2))
    return [Load(Q, across, (P, Q)), Load(P, -across, (P, Q))]
