"""What a forestry crane is to do, and whether that can be: the inputs of the skeleton's synthesis, (2.5)-(2.18).

Source: Syunyov, Seliverstov, Gerasimov, Sokolov, "Lesosechnye mashiny v fokuse bioenergetiki", chapter 2.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import final

from hydraulics.inputs import not_negative, one_number, positive
from linkage import DefinitionError
from linkage.errors import ensure
from linkage.units import deg, kN, mm

LEAST_MOMENT, GREATEST_MOMENT = 23.5 * kN, 185.0 * kN
"""Rated lifting moments for which the regressions (2.5)-(2.9) hold [N m]."""

LOOSEST, DENSEST = 0.5, 0.8
"""Shares of a stack of logs that is wood, k_d of (2.12)."""

METRES = ("L", "H_p", "H_w", "H_k", "H_max", "A", "B", "c")
LONGEST_REACH = 40.0
"""m; a longer one was given in millimetres."""


@final
@dataclass(frozen=True)
class Duty:
    """What a forwarder's crane is to do: reach L, rated moment M, the vehicle and its load; by default those of the source's example.

    Lengths in m, M in N m, `payload` in kg, `rho_w` in kg/m3, psi_0 in rad. Heights from the ground: H_p of the platform, H_w of the tool,
    H_k of the cab, H_max the legal one. A x B is the stack's ground plan, k_d the share of it that is wood. c is how far the column's axis
    is from the guard, psi_0 the least angle between boom and arm.
    """

    L: float = 10.0
    M: float = 100.0 * kN
    H_p: float = 1.1
    H_w: float = 1.2
    H_k: float = 2.95
    H_max: float = 4.0
    payload: float = 12000.0
    A: float = 4.5
    B: float = 2.7
    k_d: float = 0.65
    rho_w: float = 850.0
    c: float = 0.5
    psi_0: float = 0.0

    def __post_init__(self) -> None:
        for each in fields(self):
            object.__setattr__(self, each.name, one_number(getattr(self, each.name), each.name))
        for name in ("L", "M", "H_k", "H_max", "A", "B", "rho_w"):
            positive(getattr(self, name), name)
        for name in ("H_p", "H_w", "payload", "c", "psi_0"):
            not_negative(getattr(self, name), name)
        check_metres({name: getattr(self, name) for name in METRES})
        if self.psi_0 >= 180.0 * deg:
            least = f"psi_0 = {self.psi_0 / deg:.4g} deg is 180 deg or more, and the arm would never fold"
            raise DefinitionError(f"{least}; write psi_0={self.psi_0:.4g} * deg if these are degrees.")
        if not LEAST_MOMENT <= self.M <= GREATEST_MOMENT:
            said = f"M = {self.M / kN:.4g} kN m lies outside the {LEAST_MOMENT / kN:.4g} to {GREATEST_MOMENT / kN:.4g} kN m"
            raise DefinitionError(f"{said} of the cranes that the regressions (2.5)-(2.9) are made of; give a moment among them, in N m.")
        ensure(LOOSEST <= self.k_d <= DENSEST, f"k_d = {self.k_d:.4g}: the share of a stack that is wood is {LOOSEST} to {DENSEST}.")
        legal = f"the legal height, {self.H_max / mm:.0f} mm"
        ensure(not self.H_k > self.H_max, f"The cab, H_k = {self.H_k / mm:.0f} mm, is higher than {legal}; lower the cab or raise H_max.")
        if self.h_s > self.H_max:
            remedy = "carry less, or widen the stack: larger A, B or k_d"
            raise DefinitionError(f"The stacked load alone, h_s = {self.h_s / mm:.0f} mm (2.12), is higher than {legal}; {remedy}.")

    @property
    def h_s(self) -> float:
        """How high the stakes reach from the ground [m]. (2.12)"""
        return self.payload / (self.A * self.B * self.k_d * self.rho_w) + self.H_p

    @property
    def Q(self) -> float:
        """The weight of load and tool at the whole reach [N]: M / L."""
        return self.M / self.L

    def dimensions(self) -> Mapping[str, float]:
        """Return what a crane's class takes of it: `CraneSkeleton(**duty.dimensions())`."""
        names = ("L", "M", "H_p", "H_w", "H_k", "H_max", "h_s", "c", "psi_0", "Q")
        return {name: getattr(self, name) for name in names}


def check_metres(lengths: Mapping[str, float]) -> None:
    """Raise DefinitionError for a length by name [m] that was given in millimetres."""
    for name, given in lengths.items():
        ensure(not given > LONGEST_REACH, f"{name} = {given:.6g} m; no crane is so large, write {given:.6g} * mm if these are millimetres.")
