"""The force in the upper link, from the equilibrium of every body."""

from __future__ import annotations

import numpy as np

from hydraulics import Verdict
from linkage import ForceElement, Motion, pin_forces
from linkage.program import FloatArray
from linkage.report import below_zero, closely, spans_in_words
from linkage.statics.loaded import Case
from linkage.units import kN


def upper_link_force(motion: Motion, case: Case = None) -> FloatArray:
    """Return the force in the upper link MK [N], shape (...): positive in tension, negative in compression."""
    elements = motion.plan.of_kind(ForceElement)  # a spring at M, say, has a joint of its own there
    (joint,) = (each for each in pin_forces(motion, case=case).at("M") if not {each.on, each.by} & set(elements))
    on_link = joint.force if joint.by == "frame" else -joint.force
    along = motion["M"] - motion["K"]
    return np.asarray((on_link * along).sum(axis=0) / np.hypot(along[0], along[1]))


def upper_link_verdict(motion: Motion) -> Verdict:
    """Return how large the force is over a motion of one design, and where it is tension or compression."""
    force = upper_link_force(closely(motion))
    low, high = float(np.nanmin(force)), float(np.nanmax(force))
    if low >= 0.0 or high <= 0.0:
        kind, small, large = ("tension", low, high) if low >= 0.0 else ("compression", -high, -low)
        return Verdict("upper link", True, f"in {kind} over this motion, {small / kN:.2f} to {large / kN:.2f} kN.")
    pressed = spans_in_words(below_zero(motion, upper_link_force), "S")
    says = f"up to {high / kN:.2f} kN of tension and {-low / kN:.2f} kN of compression, which acts {pressed}"
    return Verdict("upper link", True, f"{says}: the force changes its sense, so that play is felt.")
