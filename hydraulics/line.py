"""What lifts by cylinders of one line, as whoever judges it needs it: who is meant, what is to be done, what the line can give.

Pressures are gauge [Pa]. Forces count in the working direction: the side that works pushes, or pulls, with positive force.
"""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import dataclass, replace
from typing import Any, ClassVar, Unpack, final

import numpy as np

from linkage.frozen import refuses_changes
from linkage.language import said
from linkage.loads import Acting, ActingKeywords, Case, Declared, ForceElement, Loads, Poses
from linkage.motion import Answer, HasVerdicts
from linkage.plan import Mask
from linkage.quantities import Reference
from linkage.statics import AnyMotion, held_in_case
from linkage.units import show

from .cylinder import RamSize
from .inputs import Array
from .member import Circuit, Ram, by_other_lines, line_thrust


class Choice(ActingKeywords, total=False):
    """Which cylinder of a line is meant, in which situation; its direction is the cylinder's own."""

    cylinder: Reference | None


@final
@refuses_changes
@dataclass(frozen=True, eq=False)
class Work:
    """A cylinder's thrust [N] while it grows (`sense` 1) or shrinks (-1), its size, and the mechanical efficiency.

    `drained` is the thrust of tanks on its other side [N], which the pump works against as well.
    """

    thrust: Array
    sense: Array
    size: RamSize
    k_m: Array
    drained: Array | float = 0.0

    @property
    def pulls(self) -> Mask:
        """Where the rod side works: of both sides where the thrust pulls."""
        if self.size.works == "both":
            return np.asarray(self.thrust < 0.0)[()]
        return np.full(np.shape(self.thrust), self.size.works == "rod")

    @property
    def area(self) -> Array:
        """The area of the side that works [m2]."""
        return np.asarray(np.where(self.pulls, self.size.pull_area, self.size.outward_area))[()]

    @property
    def other_area(self) -> Array:
        """The area of the other side [m2]."""
        return np.asarray(np.where(self.pulls, self.size.push_area, self.size.inward_area))[()]

    @property
    def along(self) -> Array:
        """The thrust in the direction in which the working side pushes or pulls [N]."""
        return np.where(self.pulls, -self.thrust, self.thrust)

    @property
    def against(self) -> Array:
        """What tanks on the other side push against it [N]."""
        return np.where(self.pulls, 1.0, -1.0) * self.drained

    @property
    def supplied(self) -> Mask:
        """Where the working side is filled by the pump: it moves the way it pushes or pulls."""
        return np.asarray(self.sense * np.where(self.pulls, -1.0, 1.0) >= 0.0)[()]

    @property
    def force(self) -> Array:
        """The rod force in the working direction [N]: over k_m where the load resists the motion, times k_m where it drives."""
        resists = self.along * np.where(self.supplied, 1.0, -1.0) > 0.0
        return np.where(resists, self.along / self.k_m, self.along * self.k_m)


@final
@refuses_changes
@dataclass(frozen=True, eq=False)
class Holding:
    """Gauge pressures [Pa] that hold a load: on the working side, and on the other one where the load drives on."""

    working: Array
    other: Array


@final
@refuses_changes
@dataclass(frozen=True, eq=False)
class Lowering:
    """Going back against a load, gauge pressures [Pa].

    `working` is what the load alone makes in the working side, `push` what the other side must give where that does not do,
    `by_itself` whether it sinks without it (a mask).
    """

    working: Array
    push: Array
    by_itself: Array


@final
@refuses_changes
@dataclass(frozen=True, eq=False)
class WayBack:
    """A cylinder on its way back against a resistance of the returning oil [Pa].

    Friction acts against it: the load brings T k_m where it drives and takes T / k_m where it resists. `working` is the pressure that the
    load alone makes in the side that empties [Pa]. `push` is what the other side must give beyond the pressure of its `tank`, below zero
    where the load does it by itself [Pa].
    """

    working: Array
    push: Array
    tank: Array

    @classmethod
    def of(
        cls, ram: Ram, line: Circuit, motion: AnyMotion, acting: Acting, way: str, against: Array | float, k_m: Array
    ) -> WayBack:  # fmt: skip
        """Return how a cylinder goes back at a motion's poses: `way` is "extending" or "retracting", its own direction."""
        acting, sense = replace(acting, direction=way, rates=None), -1.0 if way == "retracting" else 1.0
        size, drives = ram.sized(motion, way), -sense * line_thrust(ram, line, motion, acting, with_tanks=False) + 0.0
        empties, other = (size.outward_area, size.pull_area) if way == "retracting" else (size.pull_area, size.outward_area)
        other = empties if ram.is_single_acting else other  # nothing pushes it back: what is missing where it empties
        drained = by_other_lines(ram, line, held_in_case(motion, acting), None, True)
        helps = np.zeros(()) if drained is None else sense * drained
        brings = np.where(drives > 0.0, drives * k_m, drives / k_m)
        push = (against * empties - brings - helps) / other
        return cls(np.asarray(np.maximum(brings + helps, 0.0) / empties)[()], np.asarray(push)[()], np.asarray(helps / other)[()])


class LineValve(ForceElement, HasVerdicts):
    """The base of valves that hold what is in a line; the load then goes down over them."""

    places: ClassVar[tuple[str, ...]] = ()
    file_section: ClassVar[str] = "hydraulics"

    @abstractmethod
    def holds_line(self, line: Circuit) -> bool:
        """Return whether it holds a line."""

    @abstractmethod
    def pressure_lowering(self, line: Circuit, cylinder: Ram, motion: AnyMotion, acting: Acting) -> Array | None:
        """Return the pressure of a line while a cylinder goes down over it [Pa gauge]; None where it does not go down over it."""


class LiftLine(Circuit):
    """The base of what lifts by cylinders of one line: pressures [Pa gauge], forces [N] in the working direction, oil [m3], time [s]."""

    @abstractmethod
    def relieves(self, plan: Declared) -> bool:
        """Return whether a relief valve of its own is on it."""

    @abstractmethod
    def supply(self, motion: Poses) -> Array:
        """Return the highest pressure that lifts."""

    @abstractmethod
    def held(self, motion: Poses) -> Array:
        """Return the pressure up to which it holds."""

    @abstractmethod
    def work(self, motion: AnyMotion, loads: Loads = None, **choice: Unpack[Choice]) -> Work:
        """Return what a cylinder has to do while it moves in its working direction, or in the one named."""

    @abstractmethod
    def most(self, motion: AnyMotion, work: Work, share: float = 1.0) -> Array:
        """Return the greatest rod force with the areas of a work, at a share of the pressure."""

    @abstractmethod
    def efficiency(self, motion: Poses, kind: str) -> Array:
        """Return the "mechanical" or "hydraulic" efficiency."""

    @abstractmethod
    def reserve(self, motion: AnyMotion, loads: Loads = None, **choice: Unpack[Choice]) -> Array:
        """Return the greatest rod force over the needed one, shape (...); NaN where it is not limited by this cylinder."""

    @abstractmethod
    def lifted(
        self, motion: AnyMotion, point: str, loads: Loads = None, *, along: tuple[Any, Any] = (0.0, 1.0), share: float = 1.0,
        cylinder: Reference | None = None, case: Case = None, acting: Acting | None = None, limit: int | None = None,
    ) -> Array:  # fmt: skip
        """Return the same, NaN where nothing limits it; by one `limit` alone: the number of a member's condition, else the pump's."""


def pressure_range(low: Answer, high: Answer, unit: str) -> str:
    """Return from where to where a line's pressure goes, in words; a unit of pressure."""
    return said(
        "its pressure goes from {low} {low_where} to {high} {high_where}",
        low=show(low.value + 0.0, unit, 4), low_where=low.where, high=show(high.value + 0.0, unit, 4), high_where=high.where,
    )  # fmt: skip
