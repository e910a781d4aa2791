"""How strokes move at the poses: which way friction acts, and at what rates dampers work."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any

import numpy as np

from ..errors import DefinitionError, known_name
from ..loads import Rates
from ..motion import Motion, rates_of, require_motion
from ..plan import Plan
from ..program import FloatArray

SENSES: Mapping[str, int] = MappingProxyType({"frictionless": 0, "extending": 1, "retracting": -1})
"""Where it goes: the stroke grows, or the path is followed forwards; the other way."""


@dataclass(frozen=True)
class Movement:
    """How fast strokes move [1/s], each a number or an array that fits the poses; empty at rest.

    `rubs`: whether friction acts, against these rates. `is_timed`: whether they are speeds that were given; else only their sense
    counts. `direction` is the word for it.
    """

    direction: str = "frictionless"
    rates: Mapping[str, Any] = field(default_factory=dict)
    rubs: bool = False
    is_timed: bool = False

    @property
    def sense(self) -> int:
        """1 or -1 for a direction of motion, 0 where none is named."""
        return SENSES[self.direction]

    @property
    def known(self) -> Rates:
        """The rates as force elements ask for them."""
        return Rates(self.rates, self.is_timed, self.rubs)


AT_REST = Movement()


def sense_of(direction: str) -> int:
    """Return 1, -1 or 0 for a direction of motion."""
    return SENSES[known_name("Direction", direction, SENSES)]


def drive_of(plan: Plan, drive: str | None) -> str:
    """Return the stroke that is meant: the only one, where none is named."""
    if drive is None and len(plan.strokes) == 1:
        return next(iter(plan.strokes))
    if drive is None:
        raise DefinitionError(f"{plan.title} has {len(plan.strokes)} strokes: say drive= one of {', '.join(plan.strokes)}.")
    return known_name("Stroke", drive, plan.strokes, where=plan.title)


def movement_of(motion: Motion, direction: str, rates: Mapping[str, Any] | None, drive: str | None) -> Movement:
    """Return how the strokes move in a direction or at given rates; `drive` names the one that moves where several could.

    Along a path of several strokes they move as the path's tangent goes. DefinitionError where nobody says which one moves, and for
    rates that go against the direction.
    """
    require_motion(motion)
    sense = sense_of(direction)
    if rates is not None:
        given = rates_of("rates", rates, motion.strokes, motion.shape, motion.plan.title)
        if sense and drive is not None and np.any(sense * np.asarray(given.get(drive, 0.0)) < 0.0):
            raise DefinitionError(f"{motion.plan.title}: direction={direction!r} and the rate of {drive} contradict each other; drop one.")
        return Movement(direction, given, bool(sense), True)
    if not sense:
        return AT_REST
    tangent = path_tangent(motion)
    if tangent:
        return Movement(direction, {name: sense * rate for name, rate in tangent.items()}, True)
    return Movement(direction, {drive_of(motion.plan, drive): float(sense)}, True)


def path_tangent(motion: Motion) -> dict[str, FloatArray]:
    """Return how strokes change along a path on which several of them move, shaped as the poses; empty where it is none."""
    moving = {name: rate for name, rate in (motion.tangent or {}).items() if np.any(rate != 0.0)}
    return moving if len(moving) > 1 else {}
