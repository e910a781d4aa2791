"""The hitch's tables, and what an engineer should know of it, in sentences."""

from __future__ import annotations

import numpy as np

from hydraulics import lift_verdicts
from linkage import Column, ForceElement, Mechanism, Motion, pin_forces
from linkage.motion import out_of_reach
from linkage.program import FloatArray
from linkage.reports import closely, ranges_below_zero, spans_in_words
from linkage.statics.acting import Case
from linkage.units import deg, g0, kN
from linkage.verdict import Verdict

from .capacity import SHARE, at_hitch_points, behind, capacity, circuit_of, weakest
from .tractor import balance_verdict, front_axle, largest_mass, tipping_mass, tipping_slope
from .zones import mast_words


def capacity_columns(motion: Motion) -> list[Column]:
    """Return stroke and lift height, ratio, capacities, tilt, upper link (tension positive), and the tractor's balance."""
    return [
        Column("S", motion.strokes["S"], "mm", 1),
        Column("F_y", motion.y("F"), "mm", 1),
        Column("I", motion.ratio("G")[1], "", 4),
        Column("capacity", capacity(motion), "kN", 2),
        Column("F 90%", at_hitch_points(motion), "kN", 2),
        Column("610 90%", behind(motion), "kN", 2),
        Column("tilt", motion["tilt"], "deg", 3),
        Column("MK", upper_link_force(motion), "kN", 2),
        Column("front", front_axle(motion), "kN", 2),
        Column("max", largest_mass(motion), "kg", 0),
        Column("tips", tipping_mass(motion), "kg", 0),
        Column("uphill", tipping_slope(motion), "deg", 1),
    ]


def verdicts(hitch: Mechanism, motion: Motion) -> list[str]:
    """Return the sentences on a motion; of a batch, how many designs fall short."""
    if not motion.reached.any():
        return ["No pose of this motion can be assembled; there is nothing to lift."]
    if motion._design_shape:
        return [batch_verdict(motion)]
    circuit = circuit_of(motion)
    found = [
        weakest_verdict(motion), limit_verdict(motion), *lift_verdicts(circuit, motion, unit="MPa"), *circuit.ram(motion).checks(motion),
        test_verdict(motion), upper_link_verdict(motion), balance_verdict(motion), mast_verdict(hitch, motion),
    ]  # fmt: skip
    apart = [] if motion.reached.all() else [Verdict("reach", False, f"poses out of reach are left out of this. {out_of_reach(motion)}")]
    return [*found, *apart]


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


def test_verdict(motion: Motion) -> Verdict:
    """Return what can be lifted through the whole range at 90 % of the pressure, the way tractors are tested."""
    fine = closely(motion)
    parts = []
    for where, lifted in (("at the hitch points", at_hitch_points(fine)), ("610 mm behind them", behind(fine))):
        least = f"{np.nanmin(lifted) / kN:.2f} kN" if np.isfinite(lifted).any() else "not limited by the cylinders"
        parts.append(f"{where} {least}")
    return Verdict("test", True, f"through the whole range at {100 * SHARE:.0f} % of the pressure (as OECD Code 2): {', '.join(parts)}.")


def upper_link_verdict(motion: Motion) -> Verdict:
    """Return how large the force is over a motion of one design, and where it is tension or compression."""
    force = upper_link_force(closely(motion))
    low, high = float(np.nanmin(force)), float(np.nanmax(force))
    if low >= 0.0 or high <= 0.0:
        kind, small, large = ("tension", low, high) if low >= 0.0 else ("compression", -high, -low)
        return Verdict("upper link", True, f"in {kind} over this motion, {small / kN:.2f} to {large / kN:.2f} kN.")
    pressed = spans_in_words(ranges_below_zero(motion, upper_link_force), "S")
    says = f"up to {high / kN:.2f} kN of tension and {-low / kN:.2f} kN of compression, which acts {pressed}"
    return Verdict("upper link", True, f"{says}: the force changes its sense, so that play is felt.")


def mast_verdict(hitch: Mechanism, motion: Motion) -> Verdict:
    """Return the tilt over the motion, and the upper link that makes the mast vertical at its start."""
    fine = closely(motion)
    tilt, start = fine["tilt"], float(np.min(motion.strokes["S"][motion.reached]))
    says = f"tilt {np.nanmin(tilt) / deg:.2f} to {np.nanmax(tilt) / deg:.2f} deg over this motion"
    return Verdict("mast", True, f"{says}. At S = {start:.4f} m {mast_words(hitch, start)}")


def batch_verdict(motion: Motion) -> str:
    """Return how many designs of a batch cannot lift their implement or lose the front axle, and the extremes."""
    poses = tuple(range(len(motion._design_shape), len(motion.shape)))
    lifted = np.min(np.where(np.isnan(capacity(motion)), np.inf, capacity(motion)), axis=poses)
    weight = np.broadcast_to(motion.inputs["load.mass"] * g0, motion.shape).min(axis=poses)
    front = front_axle(motion) / (motion.inputs["vehicle_mass"] * g0) - motion.inputs["least_front"]
    light = np.min(np.where(np.isnan(front), np.inf, front), axis=poses) < 0.0
    whole = motion.reached.all(axis=poses)
    return (
        f"{int((lifted < weight).sum())} of {lifted.size} designs are too weak for their implement, {int(light.sum())} leave too little "
        f"on the front axle, {int((~whole).sum())} do not reach all poses; the least capacity is {lifted.min() / kN:.2f} kN in the worst "
        f"design and {lifted.max() / kN:.2f} kN in the best. Take one design for its sentences."
    )


def pressure_words(motion: Motion) -> str:
    """Return the pump's pressure and the cylinders in words."""
    circuit = circuit_of(motion)
    return f"{circuit.rams(motion)[0].sized(motion)} at {float(circuit.supply(motion)) / 1e6:.4g} MPa"


# The force in the upper link, from the equilibrium of every body.


def upper_link_force(motion: Motion, case: Case = None) -> FloatArray:
    """Return the force in the upper link MK [N], shape (...): positive in tension, negative in compression."""
    elements = motion.plan.of_kind(ForceElement)  # a spring at M, say, has a joint of its own there
    (joint,) = (each for each in pin_forces(motion, case=case).at("M") if not {each.on, each.by} & set(elements))
    on_link = joint.force if joint.by == "frame" else -joint.force
    along = motion["M"] - motion["K"]
    return np.asarray((on_link * along).sum(axis=0) / np.hypot(along[0], along[1]))
