"""The rules an accumulator is chosen by, each with a verdict.

Source: makers' sizing rules for bladder accumulators (HYDAC, Olaer): charge at most 0.9 of the lowest working
pressure, so that the bladder does not strike the valve; highest working pressure at most 4 times the charge,
so that it is not overstretched. Both compare absolute pressures; what is to be set is said as gauge pressure.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import final

from linkage.errors import DefinitionError
from linkage.units import cm3, show

from .verdict import Verdict

CHARGE_SHARE = 0.9
COMPRESSION = 4.0


@final
@dataclass(frozen=True)
class WorkingRange:
    """A line that works from `p_min` to `p_max` and may reach `allowed`, all gauge [Pa]; `unit` is for the sentences.

    DefinitionError for `p_min` above `p_max`.
    """

    p_min: float
    p_max: float
    allowed: float
    atmosphere: float
    unit: str

    def __post_init__(self) -> None:
        if self.p_min > self.p_max:
            raise DefinitionError(f"p_min = {self._text(self.p_min)} is above p_max = {self._text(self.p_max)}; exchange them.")

    def charge(self, number: int, charge: float) -> Verdict:
        """Return whether a charge [Pa absolute] stays below the lowest pressure by the margin."""
        low = self.p_min + self.atmosphere
        ok = charge <= CHARGE_SHARE * low
        says = f"{self._text(charge)} against {self._text(CHARGE_SHARE * low)}, {CHARGE_SHARE:g} of the lowest pressure (absolute)"
        idle = "; it is idle there, full of gas" if charge >= low else ""
        wanted, possible = self._gauge(CHARGE_SHARE * low), self._gauge(charge / CHARGE_SHARE)
        remedy = f"{idle}; lower the charge to {wanted}, or raise the lowest pressure to {possible}"
        return Verdict(f"charge of accumulator {number}", ok, f"{says}{'' if ok else remedy}.")

    def compression(self, number: int, charge: float) -> Verdict:
        """Return whether the gas of a charge [Pa absolute] is not compressed too far."""
        high = self.p_max + self.atmosphere
        ok = high <= COMPRESSION * charge
        says = f"{self._text(high)} at most is {high / charge:.4g} times the charge, limit {COMPRESSION:g} (absolute)"
        wanted, possible = self._gauge(high / COMPRESSION), self._gauge(COMPRESSION * charge)
        remedy = f"; raise the charge to {wanted}, or lower the highest pressure to {possible}"
        return Verdict(f"compression of accumulator {number}", ok, f"{says}{'' if ok else remedy}.")

    def exhausted(self, held: float) -> Verdict:
        """Return whether the line still holds fluid [m3] at its lowest pressure."""
        says = f"{held / cm3:.4g} cm3 of fluid left at the lowest pressure, {self._text(self.p_min)} gauge"
        return Verdict("exhausted", held > 0.0, f"{says}{'' if held > 0.0 else '; lower a charge, or charge the line higher'}.")

    def permitted(self) -> Verdict:
        """Return whether the highest pressure is allowed."""
        ok = self.p_max <= self.allowed
        says = f"highest pressure {self._text(self.p_max)}, allowed {self._text(self.allowed)} (gauge)"
        remedy = "; set the relief valve lower or take a stronger accumulator"
        return Verdict("allowed pressure", ok, f"{says}{'' if ok else remedy}.")

    def _text(self, pressure: float) -> str:
        return show(pressure, self.unit, 4)

    def _gauge(self, absolute: float) -> str:
        return f"{self._text(absolute - self.atmosphere)} gauge"
