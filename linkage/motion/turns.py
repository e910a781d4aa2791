"""How many turns a crank makes until the pins of a group stand where they began.

A dyad returns with its parents, because its side holds. A group of class III has up to six poses for one pose of its
drive, and a full turn may lead from one to another. Source: T. R. Chase, J. A. Mirth, Circuits and branches of
single-degree-of-freedom planar linkages, J. Mech. Design 115 (1993) 223-230.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from .limits import Interval, Open

if TYPE_CHECKING:
    from .motion import Motion

TURN = 2.0 * np.pi
MOST = 6
CLOSED = 1e-6
"""Pins that are so near to where they began, compared with the linkage, have returned."""


def open_turn(motion: Motion, name: str, held: Mapping[str, float], found: Sequence[Interval]) -> Open | None:
    """Return the pins that do not return after one turn of a stroke [rad], and how many turns they take; None where all do."""
    pins = [pin for group in motion.plan.groups.values() for pin in group.pins if name in motion.plan.reaches(pin)]
    whole = next((each for each in found if each.high - each.low > TURN * (1.0 - 1e-9)), None)
    if not pins or whole is None:
        return None
    turned = motion.moved({**held, name: whole.low + TURN * np.arange(MOST + 1)})
    every = np.array([turned[point][:, 0] for point in motion.plan.points])
    gaps = {pin: np.hypot(*(turned[pin] - turned[pin][:, :1])) / np.ptp(every, axis=0).max() for pin in pins}
    away = tuple(pin for pin, gap in gaps.items() if gap[1] > CLOSED)
    back = np.all([gaps[pin] <= CLOSED for pin in pins], axis=0)
    return Open(away, int(np.argmax(back[1:])) + 1 if back[1:].any() else 0) if away else None
