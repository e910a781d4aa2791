"""The duty of a forestry crane, the required moments of its drives, and the cylinders they are chosen from.

Source: Syunyov, Seliverstov, Gerasimov, Sokolov, "Lesosechnye mashiny v fokuse bioenergetiki", chapter 2: the inputs of the skeleton's
synthesis (2.5) to (2.18), and (2.19) to (2.27), (2.36), (2.39) to (2.43).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from math import pi

import numpy as np
from numpy.typing import ArrayLike

from hydraulics import CylinderSize
from hydraulics.inputs import efficient, in_pascals, not_negative
from linkage import DefinitionError, Mechanism, MPa, deg, drive_force, kN, mm
from linkage.errors import ensure
from linkage.frozen import record
from linkage.numeric.line import Index, highest
from linkage.plan import Mask
from linkage.program import FloatArray
from linkage.quantities import Function, Operand, Quantity, quantity

from ..paper import hold_numbers
from .skeleton import AT_ARM, AT_BOOM, AT_DRIVE, GRAVITY, JOINT, OF_DRIVE, CraneSkeleton

LEAST_MOMENT, GREATEST_MOMENT = 23.5 * kN, 185.0 * kN
"""Rated lifting moments for which the regressions (2.5)-(2.9) hold [N m]."""

LOOSEST, DENSEST = 0.5, 0.8
"""Shares of a stack of logs that is wood, k_d of (2.12)."""

METRES = ("L", "H_p", "H_w", "H_k", "H_max", "A", "B", "c")
LONGEST_REACH = 40.0
"""m; a longer one was given in millimetres."""


@record
class Duty:
    """The duty of a forwarder's crane; by default the source's example.

    Parameters
    ----------
    L : float, optional
        The reach [m].
    M : float, optional
        The rated moment [N m].
    H_p, H_w, H_k, H_max : float, optional
        The heights from the ground of the platform, the tool and the cab, and the legal one [m].
    payload : float, optional
        The load of the vehicle [kg].
    A, B : float, optional
        The sides of the stack's ground plan [m].
    k_d : float, optional
        The share of the stack that is wood.
    rho_w : float, optional
        The density of wood [kg/m3].
    c : float, optional
        The distance of the column's axis from the guard [m].
    psi_0 : float, optional
        The least angle between boom and arm [rad].
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
        hold_numbers(self, ("L", "M", "H_k", "H_max", "A", "B", "rho_w"), ("H_p", "H_w", "payload", "c", "psi_0"))
        check_metres({name: getattr(self, name) for name in METRES})
        least = f"psi_0 = {self.psi_0 / deg:.4g} deg is 180 deg or more, and the arm would never fold"
        ensure(self.psi_0 < 180.0 * deg, f"{least}; write psi_0={self.psi_0:.4g} * deg if these are degrees.")
        if not LEAST_MOMENT <= self.M <= GREATEST_MOMENT:
            said = f"M = {self.M / kN:.4g} kN m lies outside the {LEAST_MOMENT / kN:.4g} to {GREATEST_MOMENT / kN:.4g} kN m"
            raise DefinitionError(f"{said} of the cranes that the regressions (2.5)-(2.9) are made of; give a moment among them, in N m.")
        ensure(LOOSEST <= self.k_d <= DENSEST, f"k_d = {self.k_d:.4g}: the share of a stack that is wood is {LOOSEST} to {DENSEST}.")
        legal = f"the legal height, {self.H_max / mm:.0f} mm"
        ensure(not self.H_k > self.H_max, f"The cab, H_k = {self.H_k / mm:.0f} mm, is higher than {legal}; lower the cab or raise H_max.")
        remedy = "carry less, or widen the stack: larger A, B or k_d"
        ensure(self.h_s <= self.H_max, f"The stacked load alone, h_s = {self.h_s / mm:.0f} mm (2.12), is higher than {legal}; {remedy}.")

    @property
    def h_s(self) -> float:
        """How high the stakes reach from the ground [m]. (2.12)"""
        return self.payload / (self.A * self.B * self.k_d * self.rho_w) + self.H_p

    @property
    def Q(self) -> float:
        """The weight of load and tool at the whole reach [N]: M / L."""
        return self.M / self.L

    def dimensions(self) -> Mapping[str, float]:
        """Return the dimensions of a crane's class: `CraneSkeleton(**duty.dimensions())`.

        Returns
        -------
        mapping of str to float
            The dimensions [SI].
        """
        names = ("L", "M", "H_p", "H_w", "H_k", "H_max", "h_s", "c", "psi_0", "Q")
        return {name: getattr(self, name) for name in names}


def check_metres(lengths: Mapping[str, float]) -> None:
    """Raise DefinitionError for a length by name [m] that was given in millimetres."""
    for name, given in lengths.items():
        ensure(not given > LONGEST_REACH, f"{name} = {given:.6g} m; no crane is so large, write {given:.6g} * mm if these are millimetres.")


# -- the bound of moments ---------------------------------------------------------------------------------------
#
# The worst that boom and arm may have to balance, (2.20)-(2.21), (2.39)-(2.43). Everything comes from the machine's own statics, driving
# forces over all positions of the other drives; the source's closed formulas are only in the tests. The boom's moment is positive where it
# lowers the boom, the arm's where the drive has to unfold the arm.

LIFTING = "lifting"

SAMPLES = 64
"""Parts of a range that are looked at first: a peak that is broader is met to rounding."""


def worst_over(of: Callable[[FloatArray], FloatArray], start: float, end: float, count: int) -> FloatArray:
    """Return the greatest value over start..end of `count` functions at once: `of` takes and gives shape (samples, count)."""

    def look(_: Index, t: FloatArray) -> tuple[FloatArray, Mask]:
        values = of(start + (end - start) * np.broadcast_to(t, (count, t.shape[-1])).T).T
        return values[None], np.isfinite(values)

    return np.asarray(highest(look, [SAMPLES]).value[0])


def moments(crane: CraneSkeleton, drive: str, phi: ArrayLike, psi: ArrayLike, t: float, case: str) -> FloatArray:
    """Return a drive's force at poses [N m], the shape of phi and psi together."""
    boom, arm = np.broadcast_arrays(np.asarray(phi, float), np.asarray(psi, float))
    (found,) = crane.evaluate([drive_force(drive, case=case)], phi=boom.ravel(), psi=arm.ravel(), t=t)
    return found.reshape(boom.shape)


def boom_bound(crane: CraneSkeleton, phi: ArrayLike, *, case: str = LIFTING) -> FloatArray:
    """Return the greatest moment M_l that lowers the boom, over all positions of arm and telescope.

    Parameters
    ----------
    crane : Crane
        The crane, one design.
    phi : array
        The boom's angles [rad].
    case : str, optional
        The load case.

    Returns
    -------
    array
        The moment [N m], of the shape of phi.
    """
    at, limits = np.ravel(np.asarray(phi, float)), crane.limits_of()
    found = np.full(at.size, -np.inf)
    for t in limits["t"]:
        lowering = partial(lambda psi, t: -moments(crane, "phi", at, psi, t, case), t=t)
        found = np.maximum(found, worst_over(lowering, *limits["psi"], at.size))
    return found.reshape(np.shape(phi))


def arm_bound(crane: CraneSkeleton, psi: ArrayLike, *, case: str = LIFTING) -> tuple[FloatArray, FloatArray]:
    """Return the moments M_l1 and M_l2 that unfold and fold the arm, over all positions of the boom.

    M_l1 is not above zero and holds with the telescope in, where the cylinder folds the arm; M_l2 is not below zero and holds with the
    telescope out.

    Parameters
    ----------
    crane : Crane
        The crane, one design.
    psi : array
        The arm's angles [rad].
    case : str, optional
        The load case.

    Returns
    -------
    tuple of array
        The moments [N m], of the shape of psi.
    """
    at, limits = np.ravel(np.asarray(psi, float)), crane.limits_of()
    t_0, t_k = limits["t"]
    falls = worst_over(lambda phi: -moments(crane, "psi", phi, at, t_0, case), *limits["phi"], at.size)
    rises = worst_over(lambda phi: moments(crane, "psi", phi, at, t_k, case), *limits["phi"], at.size)
    shape = np.shape(psi)
    return np.minimum(-falls, 0.0).reshape(shape), np.maximum(rises, 0.0).reshape(shape)


# -- what a crane asks of its drives ---------------------------------------------------------------------------

def clipped(value: Operand, low: Operand | None, high: Operand | None = None) -> Quantity:
    """Return a quantity kept from `low` up to `high`, as far as they are given."""
    found = quantity(value)
    found = found if high is None else Function("minimum", found, quantity(high))
    return found if low is None else Function("maximum", found, quantity(low))


@record
class DriveDuty:
    """The lengths, angles and moments that boom drive and arm drive are made for; by default those of the source's examples 2 and 3.

    Parameters
    ----------
    l_c, l_p, l_t, h_0 : float, optional
        The lengths of boom, arm, telescope stroke and column [m].
    b_0, b_c : float, optional
        The heights of column and boom [m].
    phi_0, phi_k : float, optional
        The range of the boom's angle from the upward vertical [rad].
    psi_0, psi_k : float, optional
        The range of the angle between boom and arm [rad].
    K_B : float, optional
        The bound of the boom's moment, of sin(phi) [N m].
    K_A, K_A1 : float, optional
        The bounds of the arm's moment with its telescope out and in [N m].
    """

    l_c: float = 4.454601406907623
    l_p: float = 3.165204914008807
    l_t: float = 2.532163931207046
    h_0: float = 1.85
    b_0: float = 0.2736588
    b_c: float = 0.3826715957639661
    phi_0: float = 15.0 * deg
    phi_k: float = 99.9262455066517 * deg
    psi_0: float = 0.0
    psi_k: float = pi
    K_B: float = 85260.01232735414
    K_A: float = 71905.17119002105
    K_A1: float = 39947.317327789475

    def __post_init__(self) -> None:
        hold_numbers(self, ("l_c", "l_p", "h_0", "b_0", "b_c", "K_B", "K_A", "K_A1"), ("l_t",))
        check_metres({name: getattr(self, name) for name in ("l_c", "l_p", "l_t", "h_0", "b_0", "b_c")})
        for low, high, most in (("phi_0", "phi_k", pi), ("psi_0", "psi_k", 2.0 * pi)):
            first, last = getattr(self, low), getattr(self, high)
            if not 0.0 <= first < last <= most:
                given = f"{low} = {first / deg:.6g} deg, {high} = {last / deg:.6g} deg"
                raise DefinitionError(f"{given}: 0 <= {low} < {high} <= {most / deg:.0f} deg is expected; write 15 * deg for degrees.")
        if self.K_A1 > self.K_A:
            raise DefinitionError(
                f"K_A1 = {self.K_A1:.6g} N m with the telescope in is above K_A = {self.K_A:.6g} N m with it out; exchange them."
            )

    @classmethod
    def of_masses(
        cls, *, l_c: float, l_p: float, l_t: float, W: float, W_c: float, W_p: float, W_t: float, Q: float, **others: float
    ) -> DriveDuty:
        """Return the duty of a crane of so many kilograms.

        G_i = 9.81 W_i, the boom's centre at 0.4 l_c, its drive's, 2.5 % of the crane, at 0.7 l_c, the arm's at 0.45 of its length. (2.19),
        (2.22) to (2.27), (2.39) to (2.43)

        Parameters
        ----------
        l_c, l_p, l_t : float
            The lengths of boom, arm and telescope stroke [m].
        W, W_c, W_p, W_t : float
            The masses of the whole, boom, arm and telescope [kg].
        Q : float
            The load's weight [N].
        **others : float
            h_0, b_0, b_c [m] and the angles [rad].

        Returns
        -------
        DriveDuty
            The duty.
        """
        for name, value in {"W": W, "W_c": W_c, "W_p": W_p, "W_t": W_t, "Q": Q}.items():
            not_negative(value, name)
        arm = GRAVITY * (W_p + W_t)
        K_B = GRAVITY * (AT_BOOM * W_c + AT_DRIVE * OF_DRIVE * W) * l_c + (JOINT + arm + Q) * l_c
        K_A, K_A1 = ((Q + AT_ARM * arm) * reach for reach in (l_p + l_t, l_p))
        return cls(l_c=l_c, l_p=l_p, l_t=l_t, K_B=K_B, K_A=K_A, K_A1=K_A1, **others)

    def asked_of(self, drive: type[Mechanism]) -> dict[str, float]:
        """Return those of its numbers that a drive has as dimensions: `BoomDrive(**duty.asked_of(BoomDrive))`.

        Parameters
        ----------
        drive : type of Mechanism
            The drive's class.

        Returns
        -------
        dict of str to float
            The dimensions [SI].
        """
        return {name: value for name, value in vars(self).items() if name in drive.plan.defaults}


FAITHFUL = 1e-6
"""How closely, as a part of the greatest moment, a crane's own bound is met by the coefficients."""


def duty_of(crane: CraneSkeleton) -> DriveDuty:
    """Return the required moments of a crane's drives: its lengths and angles, and the moments of its weights and load.

    K_A, K_A1 and K_B are its drives' forces with the arm level, telescope out or in, and the boom level.

    Parameters
    ----------
    crane : Crane
        The crane, one design.

    Returns
    -------
    DriveDuty
        The duty.

    Raises
    ------
    DefinitionError
        The bound of moments is not of that form, as with loads of another kind.
    """
    limits = crane.limits_of()
    (phi_0, phi_k), (psi_0, psi_k), (_, t_k) = limits["phi"], limits["psi"], limits["t"]
    level, straight = np.array([90 * deg]), np.array([180 * deg])
    K_A, K_A1 = (float(moments(crane, "psi", level, straight, t, LIFTING)[0]) for t in (t_k, 0.0))
    K_B = -float(moments(crane, "phi", level, straight, t_k, LIFTING)[0]) - K_A
    lengths = {name: float(crane[name]) for name in ("l_c", "l_p", "l_t", "h_0")}
    sections = {name: crane.output(name) for name in ("b_0", "b_c")}
    duty = DriveDuty(**lengths, **sections, phi_0=phi_0, phi_k=phi_k, psi_0=psi_0, psi_k=psi_k, K_B=K_B, K_A=K_A, K_A1=K_A1)
    phi = np.linspace(phi_0, phi_k, 5)
    asked = K_B * np.sin(phi) + K_A * np.sin(psi_k - np.maximum(phi, psi_k - 90 * deg))
    off = float(np.abs(boom_bound(crane, phi) - asked).max())
    what = f"{crane.plan.title}: its bound of moments is {off / kN:.3g} kN m off K_B sin(phi) + K_A"
    ensure(not off > FAITHFUL * (K_A + K_B), f"{what}; give the moments of its loads yourself, DriveDuty(K_B=..., K_A=..., K_A1=...).")
    return duty


SIZES_MM = ((63, 36), (70, 40), (80, 45), (90, 50), (100, 56), (110, 63), (125, 70), (140, 80))
"""Bores and rods of the source's examples."""


@record
class DriveCylinders:
    """The cylinders that a drive is chosen from.

    Parameters
    ----------
    sizes : sequence of tuple of float, optional
        Bores and rods [m] in ascending order.
    pressure : float, optional
        The pressure [Pa gauge].
    efficiency : float, optional
        The cylinder's efficiency.
    f_0, f_1 : float, optional
        The dead length of a cylinder of bore D is f_0 + f_1 D [m] (2.36).
    longest : float, optional
        The longest stroke in bores.
    """

    sizes: Sequence[tuple[float, float]] = tuple((bore * mm, rod * mm) for bore, rod in SIZES_MM)
    pressure: float = 22.0 * MPa
    efficiency: float = 0.95
    f_0: float = 200.0 * mm
    f_1: float = 1.6
    longest: float = 10.0

    def __post_init__(self) -> None:
        ensure(self.sizes, "DriveCylinders: sizes= names no cylinder; give pairs of bore and rod, [(125 * mm, 70 * mm)].")
        for bore, rod in self.sizes:
            CylinderSize(bore, rod)
        object.__setattr__(self, "sizes", tuple((float(bore), float(rod)) for bore, rod in self.sizes))
        hold_numbers(self, ("pressure", "longest"), ("f_0", "f_1"))
        in_pascals(self.pressure, "pressure")
        efficient(self.efficiency, "efficiency")

    def dimensions(self, bore: float, rod: float) -> Mapping[str, float]:
        """Return the dimensions of a drive's class for one of them.

        Parameters
        ----------
        bore, rod : float
            The cylinder [m].

        Returns
        -------
        mapping of str to float
            The dimensions [SI].
        """
        return {"D": bore, "d": rod, "p": self.pressure, "n": self.efficiency, "f_0": self.f_0, "f_1": self.f_1}

    def swallowed(self, bore: float, rod: float = 0.0) -> float:
        """Return the greatest work [J] of a bore over its longest stroke: its piston's, or with a rod its annulus's.

        Parameters
        ----------
        bore : float
            The bore [m].
        rod : float, optional
            The rod [m].

        Returns
        -------
        float
            The work.
        """
        area = pi / 4.0 * (bore**2 - rod**2)
        return self.pressure * self.efficiency * area * self.longest * bore
