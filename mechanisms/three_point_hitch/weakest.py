"""The weakest point of the capacity curve, and what limits it there."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hydraulics import Verdict
from linkage import Motion, angle
from linkage.errors import unwarned
from linkage.motion import greatest, lowest
from linkage.reports import closely
from linkage.units import deg, g0, kN, mm

from .capacity import capacity, circuit_of, stroke_per_newton
from .tractor import largest_mass, tipping_mass

CHANGE = 10 * mm
STILL = 1e-12  # a factor this small moves nothing
DIMENSIONS = ("OB", "OC", "ED", "CD", "EF", "MK", "A.x", "A.y", "O.x", "O.y", "E.x", "E.y", "M.x", "M.y")
"""Dimensions of the tractor's side that a designer may change."""

CHANGES = {"": ("longer", "shorter"), "x": ("farther back", "farther forward"), "y": ("higher", "lower")}


@dataclass(frozen=True)
class Weakest:
    """The weakest point of the capacity curve of one design: stroke and height of F [m], capacity [N] and ratio I there.

    `stage` is what its ratio owes most to, against the best point; `remedy` the change of one dimension that helps most.
    """

    stroke: float
    height: float
    capacity: float
    ratio: float
    stage: str
    remedy: str

    @property
    def sentence(self) -> str:
        """The weakest point and what limits it."""
        return (
            f"least at S = {self.stroke:.4f} m, F {self.height / mm:.0f} mm high: {self.capacity / kN:.2f} kN "
            f"({self.capacity / g0:.0f} kg). There the pressure limits it: G rises {self.ratio:.3f} mm for 1 mm of the cylinder, "
            f"{self.stage}. {self.remedy}"
        )


def weakest(motion: Motion) -> Weakest | None:
    """Return the weakest point over a motion of one design; None where the cylinder limits nothing."""
    burden = stroke_per_newton(closely(motion))
    if not np.any(burden > 0.0):
        return None
    S = greatest(motion, stroke_per_newton).strokes["S"]
    there = closely(motion, np.array([S]))
    best = closely(motion, np.array([lowest(motion, lambda each: np.abs(stroke_per_newton(each))).strokes["S"]]))
    with unwarned():  # at the end of the reach it stands next to a dead point: the sentence keeps few digits
        ratio, force = float(there.ratio("G")[1][0]), float(capacity(there)[0])
        return Weakest(S, float(there.y("F")[0]), force, ratio, stage(there, best), remedy(motion))


def stages(motion: Motion) -> dict[str, tuple[float, str]]:
    """Return the factors of I at one pose, each with its words: arm turned by the cylinder, F lifted by the arm, G by F."""
    turn, rise, ratio = (float(each) for each in (motion.ratio(angle("O", "B"))[0], motion.ratio("F")[1, 0], motion.ratio("G")[1, 0]))
    return {
        "the cylinder's lever": (turn, f"its lever about O {1.0 / abs(turn) / mm:.0f} mm"),
        "lift arm, lift rod and lower link": (rise / turn, f"F rises {rise / turn * deg / mm:.2f} mm for 1 deg of the lift arm"),
        "the upper link, which turns the implement": (ratio / rise, f"G rises {ratio / rise:.3f} times as fast as F"),
    }


def stage(there: Motion, best: Motion) -> str:
    """Return which factor of the ratio has grown most from the best point to the weakest, in words."""
    now, then = stages(there), stages(best)
    name = max(now, key=lambda each: abs(now[each][0]) / max(abs(then[each][0]), STILL))
    if now[name][0] == then[name][0]:
        return "the same at all poses of this motion"
    (S,) = best.strokes.values()
    return f"mostly by {name}: {now[name][1]}, at the best point, S = {S[0]:.4f} m, {then[name][1].removeprefix('its lever about O ')}"


def remedy(motion: Motion) -> str:
    """Return the change by 10 mm of one dimension that raises the least capacity most, in words."""
    names = [name for name in DIMENSIONS if name in motion.designs for _ in (1, -1)]
    steps = np.tile([CHANGE, -CHANGE], len(names) // 2)
    if not names:
        return ""
    designs = {name: motion.designs[name] + np.where([each == name for each in names], steps, 0.0) for name in dict.fromkeys(names)}
    fine = closely(motion)
    changed = Motion(motion.plan, motion.designs | designs, fine.strokes, "nan")
    burden = np.max(np.where(changed.reached, stroke_per_newton(changed), np.inf), axis=1)
    place = int(np.argmin(np.where(np.isfinite(burden), burden, np.inf)))
    gain = float(np.nanmax(stroke_per_newton(fine))) / burden[place] - 1.0
    if not 0.0 < gain < np.inf:
        return "No single dimension of the tractor's side, changed by 10 mm, helps."
    name, _, axis = names[place].partition(".")
    change = CHANGES[axis][int(steps[place] < 0.0)]
    return f"Of the tractor's dimensions {name} {CHANGE / mm:.0f} mm {change} helps most: {100.0 * gain:+.1f} %."


def weakest_verdict(motion: Motion) -> Verdict:
    """Return the weakest point with what limits it, against the implement's weight."""
    found = weakest(motion)
    if found is None:
        return Verdict("capacity", True, "the ratio is not above zero anywhere: the load is not limited by this cylinder.")
    weight = float(motion.inputs["load.mass"]) * g0
    return Verdict("capacity", found.capacity >= weight, found.sentence)


def limit_verdict(motion: Motion) -> Verdict:
    """Return which limit comes first over the motion: pressure, the front axle's share, or tipping."""
    fine = closely(motion)
    steer, tip = largest_mass(fine), tipping_mass(fine)
    limits = {"the pressure": capacity(fine) / g0, "the front axle's least load": steer, "tipping": tip}
    least_of = {name: float(np.nanmin(values)) for name, values in limits.items() if np.isfinite(values).any()}
    if not least_of:
        return Verdict("largest implement", True, "nothing limits it over this motion.")
    first = min(least_of, key=lambda name: least_of[name])
    mass = float(motion.inputs["load.mass"])
    says = "; ".join(f"{name} {value:.0f} kg" for name, value in least_of.items())
    text = f"{first} comes first; over this motion: {says}; the implement has {mass:.0f} kg."
    return Verdict("largest implement", mass <= least_of[first], text)


def pressure_words(motion: Motion) -> str:
    """Return the pump's pressure and the cylinders in words."""
    circuit = circuit_of(motion)
    return f"{circuit.rams(motion)[0].sized(motion)} at {float(circuit.supply(motion)) / 1e6:.4g} MPa"
