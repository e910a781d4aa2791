"""The lift of a mower-conditioner's left section: one cylinder, one turning lever.

Source: worksheet "Mathematical modelling of the lift of the left section of the rotary mower-conditioner KPR-6"
(closed vector loop method). Symbols and data are the worksheet's.
"""

from __future__ import annotations

from math import atan2, hypot, pi
from typing import Any

import numpy as np

from hydraulics.inputs import positive
from hydraulics.sizes import standard_bores
from linkage import (
    RIGHT,
    Column,
    CosineAngle,
    DefinitionError,
    Dimension,
    Dyad,
    Ground,
    Mechanism,
    Motion,
    OnLink,
    Stroke,
    Weight,
    angle,
    distance,
    driving_force,
)  # fmt: skip
from linkage.program import FloatArray
from linkage.report import below_zero, closely, reached_span, spans_in_words
from linkage.units import cm, deg, g0, kgf, kgf_cm2, litre, mm

G_FROM_O = (1.07, -0.37)                    # centre of gravity from O at S = 0.55 m, as the input says, m
BELOW = atan2(G_FROM_O[1], G_FROM_O[0])     # its direction from O, rad
DELFI = 129.5 * deg                         # lever and x axis at S = 0.55 m: what the printed tables are computed with
DELFI_OF_INPUT = 126.665 * deg              # the same angle as the input data give it


class MowerLift(Mechanism):
    """Cylinder AB turns the lever OB; the section, with its centre of gravity G, is rigid with the lever.

    S is the distance of the cylinder's pins. Results are the worksheet's: FIS = angle AOB, FI = angle OAB, FI3 the
    direction of OB, FIS1 that of AB below the x axis, I = dG_y/dS the transfer ratio. The rod carries P I without
    friction and P I / k_m while it lifts (k_m: mechanical efficiency). The worksheet's F = P I / (k_m k_g) is a
    *reduced* load: it gives the supply pressure pd = F / area, the rod never carries it. The largest rod force,
    F_max = k_g p_max area, compares with P I / k_m, never with F: that would count the hydraulic efficiency k_g twice.

    The source contradicts itself about G at S = 0.55 m: the input says (1.07, -0.37) m from O; a remark says that the
    x axis passes through G (G_y = 0); the printed table says G = (1.739, 0.013) m, which is (1.087, -0.317) m from O.
    The input agrees with a lever angle DELFI = 126.665 deg, the tables are computed with 129.5 deg. Here are the
    tables: BOG = 129.5 deg + atan(-0.37 / 1.07). The other reading is MowerLift(BOG=DELFI_OF_INPUT + BELOW). The verdict
    stands either way: kz = 0.963 at S = 0.55 m, short up to S = 0.5660 m, as printed; 0.978, short up to 0.5604 m, else.
    """

    S = Stroke(0.55, 0.80)                                      # distance of the cylinder's pins, m

    A = Ground(0.0, 0.242)
    O = Ground(0.652, 0.330)

    B = Dyad(A, O, AB=S, OB=0.175, side=RIGHT)                  # cylinder and turning lever
    G = OnLink(O, B, OG=hypot(*G_FROM_O), BOG=DELFI + BELOW)    # centre of gravity; BOG is the worksheet's FIS3

    FI0 = angle(A, O)
    FIS = CosineAngle(distance(A, O), distance(O, B), S)
    FI3 = pi + FI0 + FIS
    FI = CosineAngle(distance(A, O), S, distance(O, B))
    FIS1 = FI - FI0

    weight = Dimension(900 * kgf, unit="kgf")                   # P
    p_max = Dimension(155 * kgf_cm2, unit="kgf/cm2")            # gauge
    bore = Dimension(8 * cm, unit="mm")                         # D
    k_m = Dimension(0.85)                                       # mechanical efficiency
    k_g = Dimension(0.95)                                       # hydraulic efficiency

    load = Weight(G, mass=weight / g0)

    def __init__(self, **dimensions: Any) -> None:
        """Set the design [SI]; DefinitionError also for a load, pressure or bore not above zero, an efficiency not in (0, 1]."""
        super().__init__(**dimensions)
        for name in ("weight", "p_max", "bore", "k_m", "k_g"):
            positive(self[name], name)
        for name in ("k_m", "k_g"):
            if np.any(np.asarray(self[name]) > 1.0):
                raise DefinitionError(f"{name} = {np.max(self[name]):.6g} is above 1; an efficiency lies between 0 and 1.")

    def columns(self, motion: Motion) -> list[Column]:
        """Return the worksheet's table, and the rod's forces."""
        return [
            Column("S", motion.strokes["S"], "m"),
            *(Column(name, motion[name], "deg", 3) for name in ("FIS", "FI3", "FI", "FIS1")),
            *(Column(f"{point}_{axis}", getattr(motion, axis)(point), "m", 3) for point in "BG" for axis in "xy"),
            Column("DFI3", motion.ratio("FI3"), "rad/m", 3),
            Column("I", transfer_ratio(motion), "", 3),
            Column("PI", rod_force(motion), "kgf", 0),
            Column("PI/k_m", lifting_force(motion), "kgf", 0),
            Column("F", reduced_force(motion), "kgf", 0),
            Column("pd", pressure(motion), "kgf/cm2", 3),
            Column("kz", reserve(motion), "", 3),
        ]

    def verdicts(self, motion: Motion) -> list[str]:
        """Return whether the section can be lifted, where not, the remedy, and the oil it takes."""
        if motion.design_shape:
            return [batch_verdict(motion)]
        if not motion.reached.any():
            return ["No pose of this motion can be assembled; there is nothing to lift."]
        apart = [] if motion.reached.all() else ["The poses out of reach are left out of this."]
        return [*lift_verdict(motion), *driven_verdict(motion), *oil_verdict(motion), *apart]


# -- forces and pressures, over designs and poses; weight resists where I > 0 ------------------------------


def transfer_ratio(motion: Motion) -> FloatArray:
    """Return I = dG_y/dS, shape (...), dimensionless."""
    return np.asarray(motion.ratio("G")[1])


def rod_force(motion: Motion) -> FloatArray:
    """Return the thrust without friction, P I [N]: the statics' driving force under the section's weight."""
    return driving_force(motion, "load")


def lifting_force(motion: Motion) -> FloatArray:
    """Return the rod's thrust while it extends [N]: P I / k_m where the weight resists, P I k_m where it drives."""
    force, k_m = rod_force(motion), motion.inputs["k_m"]
    return np.asarray(np.where(force > 0.0, force / k_m, force * k_m))


def piston_area(motion: Motion) -> FloatArray:
    """Return SS = pi D^2 / 4 [m2], one value for each design."""
    return np.asarray(pi / 4.0 * motion.inputs["bore"] ** 2)


def largest_force(motion: Motion) -> FloatArray:
    """Return F_max = k_g p_max SS [N], what the rod gets at the pressure limit; compares with `lifting_force`."""
    return np.asarray(motion.inputs["k_g"] * motion.inputs["p_max"] * piston_area(motion))


def reduced_force(motion: Motion) -> FloatArray:
    """Return F = P I / (k_m k_g) [N], pressure times area on the pump's side; zero where the weight drives."""
    return np.asarray(np.maximum(lifting_force(motion), 0.0) / motion.inputs["k_g"])


def pressure(motion: Motion) -> FloatArray:
    """Return the supply pressure pd = F / SS [Pa gauge]."""
    return reduced_force(motion) / piston_area(motion)


def reserve(motion: Motion) -> FloatArray:
    """Return the reserve factor kz = p_max / pd; NaN where the weight drives and this cylinder does not limit."""
    needed = pressure(motion)
    return np.asarray(motion.inputs["p_max"] / np.where(needed > 0.0, needed, np.nan))


def oil(motion: Motion) -> float:
    """Return the oil [m3] that the cylinder takes in over the reached part of the motion, one design."""
    low, high = reached_span(motion)
    return float(piston_area(motion).flat[0]) * (high - low)


def short_ranges(motion: Motion) -> list[tuple[float, float]]:
    """Return the stroke ranges [m] where kz < 1, one design; their ends are roots, exact to 1e-12 m."""
    return below_zero(motion, lambda each: largest_force(each) - lifting_force(each))


# -- verdicts ----------------------------------------------------------------------------------------------


def lift_verdict(motion: Motion) -> list[str]:
    """Return whether one design lifts; where not, from where to where, and the remedy."""
    fine = closely(motion)
    kz, limit = reserve(fine), f"{float(motion.inputs['p_max']) / kgf_cm2:.4g} kgf/cm2"
    if np.isnan(kz).all():
        return []
    worst = int(np.nanargmin(kz))
    least, where = float(kz[worst]), f"S = {fine.strokes['S'][worst]:.4f} m"
    short = short_ranges(motion)
    if not short:
        return [f"The section can be lifted {all_of(motion)} at {limit}: the least reserve kz is {least:.3f}, at {where}."]
    return [
        f"The section cannot be lifted {out_of(motion, short)} at {limit}: the least reserve kz is {least:.3f}, at {where}, "
        f"and kz is below 1 {spans_in_words(short, 'S')}.",
        remedy(motion, least),
    ]


def all_of(motion: Motion) -> str:
    """Return the motion's range in words."""
    low, high = reached_span(motion)
    stroke = motion.plan.strokes["S"]
    return "over the whole stroke" if (low, high) == (stroke.start, stroke.end) else spans_in_words([(low, high)], "S")


def out_of(motion: Motion, short: list[tuple[float, float]]) -> str:
    """Return which positions the section does not leave, in words."""
    (low, high), (first, last) = reached_span(motion), short[0]
    if (first, last) == (low, high):
        return "anywhere on this stroke" if low < high else "here"
    if first > low:
        return f"beyond S = {first:.4f} m"
    lowest = motion.plan.strokes["S"].start
    return "from its lowest position" if low == lowest else f"from S = {low:.4f} m"


def remedy(motion: Motion, least: float) -> str:
    """Return what makes up for a least reserve below 1: a pressure, or the smallest standard bore (ISO 3320)."""
    bore, p_max = float(motion.inputs["bore"]), float(motion.inputs["p_max"])
    larger = [each for each in standard_bores() if each > bore * (1.0 + 1e-9)]
    enough = [each for each in larger if least * (each / bore) ** 2 >= 1.0]
    needs = f"It needs {p_max / least / kgf_cm2:.1f} kgf/cm2"
    if not enough:
        return f"{needs}; no standard bore is large enough."
    which = "the next standard bore" if enough[0] == larger[0] else "a larger standard bore"
    return f"{needs}, or {which}: {enough[0] / mm:.0f} mm gives kz = {least * (enough[0] / bore) ** 2:.2f}."


def driven_verdict(motion: Motion) -> list[str]:
    """Return where the weight drives the lift, if it does."""
    driven = below_zero(motion, transfer_ratio)
    return [f"The weight drives the lift {spans_in_words(driven, 'S')}: there it is not limited by this cylinder."] if driven else []


def oil_verdict(motion: Motion) -> list[str]:
    """Return how much oil the motion takes, if it moves."""
    low, high = reached_span(motion)
    if low == high:
        return []
    return [f"Lifting from S = {low:.4f} to {high:.4f} m takes {oil(motion) / litre:.2f} l of oil; time and flow follow from the pump."]


def batch_verdict(motion: Motion) -> str:
    """Return how many designs of a batch fall short, and the extremes."""
    kz = reserve(motion)
    poses = tuple(range(len(motion.design_shape), kz.ndim))
    least = np.where(np.isnan(kz), np.inf, kz).min(axis=poses)
    count = int((least < 1.0).sum())
    return (
        f"{count} of {least.size} designs fall short of kz = 1 at these poses; the least reserve is {least.min():.3f} in the worst "
        f"design and {least.max():.3f} in the best. Take one design for its stroke range and the remedy."
    )
