"""Will the rod buckle? The cylinder, drawn out, is taken as a bar of the rod's diameter from end to end.

That leaves out the stiffness of the tube (the safe side) and the cylinder's own weight. Thrust is that of one cylinder.
Slender bars by Euler, shorter ones by J. B. Johnson's parabola: the yield strength at length 0, Euler's curve met with
equal slope at half of it. Against Tetmajer's 335 - 0.62 lambda [MPa] it is at most 2.3 % above and 18 % below.

    >>> from linkage.units import kN, m, mm
    >>> rod = Buckling(rod=40 * mm)
    >>> print(f"{rod.critical(1 * m) / kN:.1f} kN, slenderness {rod.slenderness(1 * m):.0f}, Euler from {rod.transition:.0f}")
    255.1 kN, slenderness 100, Euler from 108
    >>> print(rod.check(1 * m, 60 * kN))
    ok   buckling: 60 kN on a 40 mm rod 1000 mm long (pin-pin), buckling at 255.1 kN: safety 4.25, at least 3.5.
"""

from __future__ import annotations

from dataclasses import replace
from math import pi, sqrt
from types import MappingProxyType

import numpy as np
from numpy.typing import ArrayLike

from linkage.errors import DefinitionError, known_name
from linkage.frozen import record
from linkage.language import noted, said, translated
from linkage.program import is_traced
from linkage.units import MPa, show, shown_number
from linkage.verdict import Verdict

from .inputs import LONGEST, Array, in_metres, one_number, pose_values, positive
from .standard_sizes import chosen_series

MOUNTINGS = MappingProxyType({noted("pin-pin"): 1.0, noted("fixed-pin"): 0.699156, noted("fixed-fixed"): 0.5, noted("fixed-free"): 2.0})
"""Buckling length over length, by how the two ends are held (Euler's four cases; 0.699156 is pi over the root of tan x = x)."""


@record
class Buckling:
    """The buckling of a rod that is pressed: `Buckling(60 * mm, mounting="pin-pin")`.

    Parameters
    ----------
    rod : float
        The rod's diameter [m].
    mounting : str, optional
        How its ends are held, "pin-pin" by default.
    safety : float, optional
        The factor asked for, 3.5 by default.
    modulus, yield_strength : float, optional
        Young's modulus and the yield strength [Pa], those of steel by default.

    Raises
    ------
    DefinitionError
        A value is not above zero, the safety is below 1, or the mounting is not known.
    """

    rod: float
    mounting: str = "pin-pin"
    safety: float = 3.5
    modulus: float = 210e3 * MPa
    yield_strength: float = 355 * MPa

    def __post_init__(self) -> None:
        positive(one_number(self.rod, "Rod", "length"), "Rod")
        for value, what in ((self.modulus, "Modulus"), (self.yield_strength, "Yield strength")):
            positive(one_number(value, what, "pressure"), what)
        in_metres(self.rod, "Rod")
        if positive(one_number(self.safety, "Buckling safety", "number"), "Buckling safety") < 1.0:
            raise DefinitionError(f"Buckling safety = {self.safety:g} is below 1; 3.5 is usual for hydraulic cylinders.")
        known_name("Mounting", self.mounting, MOUNTINGS)

    @property
    def area(self) -> float:
        """Section of the rod, m2."""
        return pi / 4.0 * self.rod**2

    @property
    def transition(self) -> float:
        """The slenderness from which on Euler holds."""
        return pi * sqrt(2.0 * self.modulus / self.yield_strength)

    def slenderness(self, length: ArrayLike) -> Array:
        """Return buckling length over radius of inertia (a quarter of the diameter) at a length between the ends [m], same shape.

        Parameters
        ----------
        length : array_like
            The length between the ends [m].

        Returns
        -------
        ndarray
            The slenderness.
        """
        return (MOUNTINGS[self.mounting] * _length(length) / (self.rod / 4.0))[()]

    def critical(self, length: ArrayLike) -> Array:
        """Return the thrust [N] at which the rod buckles, at a length between the ends [m], same shape.

        NaN in an array stays NaN. DefinitionError for a length not above zero.

        Parameters
        ----------
        length : array_like
            The length between the ends [m].

        Returns
        -------
        ndarray
            The thrust [N].

        Raises
        ------
        DefinitionError
            A length not above zero.
        """
        return self.critical_of(self.rod, length)

    def critical_of(self, rod: float | Array, length: ArrayLike) -> Array:
        """Return the same of another rod [m], or of the rods of many designs; the two broadcast.

        Parameters
        ----------
        rod : float or ndarray
            The rod's diameter [m].
        length : array_like
            The length between the ends [m].

        Returns
        -------
        ndarray
            The thrust [N].
        """
        slender = MOUNTINGS[self.mounting] * _length(length) / (rod / 4.0)
        euler = pi**2 * self.modulus / slender**2
        johnson = self.yield_strength * (1.0 - self.yield_strength * slender**2 / (4.0 * pi**2 * self.modulus))
        return (pi / 4.0 * rod**2 * np.where(slender >= self.transition, euler, johnson))[()]

    def allowed(self, length: ArrayLike) -> Array:
        """Return the thrust [N] with the safety asked for, at a length between the ends [m], same shape.

        Parameters
        ----------
        length : array_like
            The length between the ends [m].

        Returns
        -------
        ndarray
            The thrust [N].
        """
        return self.critical(length) / self.safety

    def check(self, length: ArrayLike, thrust: ArrayLike) -> Verdict:
        """Return the verdict at the worst of the lengths between the ends [m] and thrusts [N] of one cylinder; they broadcast.

        A thrust that pulls (negative) does not buckle. A failing verdict names the standard rod that would hold.

        Parameters
        ----------
        length : array_like
            The length between the ends [m].
        thrust : array_like
            The thrust [N].

        Returns
        -------
        Verdict
            The verdict.
        """
        push, long = np.broadcast_arrays(pose_values(thrust, "Thrust", ""), _length(length))
        use = push / self.critical(long)
        if not np.any(use > 0.0):
            return self.judged(1.0, 0.0)
        worst = int(np.nanargmax(use))
        remedy = self.remedy_words(next(iter(self.thicker(long, push)), None))
        return self.judged(float(long.flat[worst]), float(push.flat[worst]), remedy=remedy)

    def judged(
        self, length: float, thrust: float, where: str = "", unbounded: bool = False, *, stage: int = 0, remedy: str = ""
    ) -> Verdict:
        """Return the verdict at one length [m] and thrust of one cylinder [N], at a place in words; `unbounded`: it grows from there.

        `stage` is the number of the telescope's stage that is the rod, `remedy` what stands behind a failing verdict.

        Parameters
        ----------
        length : float
            The length between the ends [m].
        thrust : float
            The thrust [N].
        where : str
            The place in words.
        unbounded : bool
            Whether the thrust grows without bound there.
        stage : int
            The number of the telescope's stage, 0 for a rod.
        remedy : str
            The remedy of a failing verdict.

        Returns
        -------
        Verdict
            The verdict.
        """
        if unbounded:
            text = said("the thrust grows without bounds {where}: no rod holds there; keep away from that pose.", where=where)
            return Verdict("buckling", False, text)
        if not one_number(thrust, "Thrust") > 0.0:
            return never_pushed()
        one_number(length, "Length between the ends", "length")
        limit, ok = float(self.critical(length)), thrust <= float(self.allowed(length))
        given = {
            "thrust": show(thrust, "kN", 4), "rod": show(self.rod, "mm", 4), "length": show(length, "mm", 4),
            "mounting": translated(self.mounting), "where": f" {where}" if where else "", "limit": show(limit, "kN", 4),
            "safety": shown_number(limit / thrust, "", 3, None if ok else self.safety), "least": self.safety,
        }  # fmt: skip
        says = said(
            "{thrust} on a {rod} rod {length} long ({mounting}){where}, buckling at {limit}: safety {safety}, at least {least:g}",
            **given,
        )
        if stage:
            says = said(
                "{thrust} on stage {stage} of {rod}, the slenderest that is out, {length} long ({mounting}){where}, "
                "buckling at {limit}: safety {safety}, at least {least:g}", stage=stage, **given,
            )  # fmt: skip
        return Verdict("buckling", ok, f"{says}{'' if ok else remedy}.")

    def thicker(self, length: ArrayLike, thrust: ArrayLike) -> list[float]:
        """Return the standard rods [m] above this one that hold at lengths [m] and thrusts [N] of one cylinder; they broadcast.

        Parameters
        ----------
        length : array_like
            The length between the ends [m].
        thrust : array_like
            The thrust [N].

        Returns
        -------
        list of float
            The diameters [m].
        """
        rods = (rod for rod in chosen_series().rods if rod > self.rod * (1.0 + 1e-9))
        return [rod for rod in rods if not np.any(np.asarray(thrust) > replace(self, rod=rod).allowed(length))]

    def remedy_words(self, rod: float | None, *, is_bore_small: bool = False, is_stage: bool = False) -> str:
        """Return the remedy in words: a rod or stage that holds [m], or None; `is_bore_small` where thicker rods do not suit the bore.

        Parameters
        ----------
        rod : float or None
            The rod or stage that holds [m].
        is_bore_small : bool
            Whether thicker rods do not suit the bore.
        is_stage : bool
            Whether the rod is a telescope's stage.

        Returns
        -------
        str
            The remedy.
        """
        if rod is not None and is_stage:
            return said("; a stage of {rod} holds", rod=show(rod, "mm", 4))
        if rod is not None:
            return said("; a rod of {rod} holds", rod=show(rod, "mm", 4))
        if is_stage:
            return said("; no standard stage holds that slides in the one before: shorten the telescope or use more of them")
        if is_bore_small:
            return said("; no rod that suits the bore holds: take a larger bore, shorten the cylinder or use more of them")
        return said("; no standard rod holds: shorten the cylinder or use more of them")


def never_pushed() -> Verdict:
    """Return the verdict on a rod that nothing pushes."""
    return Verdict("buckling", True, said("the rod is never pushed."))


def _length(length: ArrayLike) -> Array:
    long = pose_values(length, "Length between the ends", "length")
    if is_traced(long):
        return positive(in_metres(long, "Length between the ends", 2.0 * LONGEST), "Length between the ends")
    in_metres(long[~np.isnan(long)] if np.any(~np.isnan(long)) else 1.0, "Length between the ends", 2.0 * LONGEST)
    if not np.all(np.isnan(long)) or not long.size:
        positive(long[~np.isnan(long)], "Length between the ends")
    return long
