"""A grapple's available and required moments over the angle; its table and its verdicts. Pressures are gauge [Pa]."""

from __future__ import annotations

from functools import cached_property

import numpy as np

from hydraulics import LiftCircuit
from linkage import Column, DefinitionError, Force, Motion, Verdict, least, most, pin_force, ratio, ref
from linkage.errors import ensure, require_whole
from linkage.frozen import record
from linkage.language import said
from linkage.motion import Answer, MotionFunction, require_motion
from linkage.program import FloatArray
from linkage.units import show, shown_number

from ..paper import answers_over

ADVISED = (1.2, 1.4)
"""Opening angle over the release angle (2.81)."""
MET = 1e-9
"""A ratio, a length or an angle that is missed by less is met."""


def require_grapple(motion: Motion) -> Motion:
    """Return a motion of a grapple; DefinitionError for anything else."""
    require_motion(motion)
    if "closing_angle" not in motion.plan.members or "theta" not in motion.strokes:
        raise DefinitionError(f"{motion.plan.title} is no grapple; give a motion of a Grapple.")
    return motion


def gripping(motion: Motion, count: int = 101) -> Motion:
    """Return the same designs over the angles at which they hold stems, from D_0 to d_0, each its own.

    Parameters
    ----------
    motion : Motion
        The poses.
    count : int, optional
        The number of poses.

    Returns
    -------
    Motion
        The motion.
    """
    closing = require_grapple(motion).sketched(ref("closing_angle"))
    return _over(motion, np.zeros_like(closing), -closing, count)


def travelling(motion: Motion, count: int = 101) -> Motion:
    """Return the same designs over the lever's whole way, from open to d_0, each its own.

    Parameters
    ----------
    motion : Motion
        The poses.
    count : int, optional
        The number of poses.

    Returns
    -------
    Motion
        The motion.
    """
    start, closing = (require_grapple(motion).sketched(ref(name)) for name in ("opening_angle", "closing_angle"))
    return _over(motion, start, -closing, count)


def _over(motion: Motion, start: FloatArray, end: FloatArray, count: int) -> Motion:
    require_whole("count", count, "a whole number of poses is expected, at least 2", least=2)
    shape = motion._design_shape
    first, last = (each.reshape(shape)[..., None] for each in (start, end))
    theta = first + (last - first) * np.linspace(0.0, 1.0, count)
    return Motion(motion.plan, motion.designs, {"theta": theta}, motion.unreachable, per_design=bool(shape))


def unplaced_words(motion: Motion) -> str:
    """Return why the pin E has no place in a design of a motion, and the remedy; empty where all have."""
    x, y = motion["E"]
    if np.all(np.isfinite(x)) and np.all(np.isfinite(y)):
        return ""
    lost = ~(np.isfinite(x) & np.isfinite(y))
    opened, shut, rho, swing = (
        float(np.broadcast_to(each, motion.shape)[lost][0])
        for each in (motion["open_length"], motion["shut_length"], motion.inputs["rho"], motion["closing_angle"] + motion["opening_angle"])
    )
    chord, stroke = 2.0 * rho * np.sin(0.5 * swing), abs(shut - opened)
    lengths = said(
        "E has no place: its lengths are {opened} at the open lever and {shut} at the closed one, the pin C has its ends {chord} apart",
        opened=show(opened, "mm", 4), shut=show(shut, "mm", 4), chord=show(chord, "mm", 4),
    )  # fmt: skip
    if chord < stroke:
        least = show(rho * stroke / chord, "mm", ".1f")
        return said("{says}, less than the stroke; OC = rho from {least} on has one.", says=lengths, least=least)
    return said("{says}; OC = rho up to {most} has one.", says=lengths, most=show(rho * (opened + shut) / chord, "mm", ".1f"))


def require_placed(motion: Motion) -> Motion:
    """Return a motion of grapples whose cylinders have a place for the pin E; DefinitionError, with the remedy, for others."""
    words = unplaced_words(require_grapple(motion))
    ensure(not words, f"{motion.plan.title}: {words}")
    return motion


@record
class GrappleState:
    """The grip at the poses of a motion: arrays of its shape D [m], H [m], M_g and M_1 [N m] of one lever.

    Parameters
    ----------
    motion : Motion
        The motion of a grapple.
    """

    motion: Motion

    @cached_property
    def D(self) -> FloatArray:
        """Diameter of the stem that the lever holds there [m]; beyond D_0 of one that large."""
        return self.motion["D"]

    @cached_property
    def H(self) -> FloatArray:
        """The cylinder's arm about the hinge [m]: how its length follows the lever's angle, |dEC/dtheta| (2.90)."""
        return np.abs(self.motion.ratio("EC"))

    @cached_property
    def given(self) -> FloatArray:
        """M_g [N m], the moment of the full pressure about the hinge of each of the levers whose stem the cylinder presses."""
        circuit: LiftCircuit = self.motion.plan.of_kind(LiftCircuit)["circuit"]
        levers = len(self.motion.plan.of_kind(Force))
        return circuit.largest(self.motion) * circuit.efficiency(self.motion, "mechanical") * self.H / levers

    @cached_property
    def needed(self) -> FloatArray:
        """M_1 [N m], the moment that the stem needs about the hinge."""
        return self.motion["M_1"]


def moment_ratio(motion: Motion) -> FloatArray:
    """Return M_g / M_1 of a motion, shape (...).

    Parameters
    ----------
    motion : Motion
        The poses.

    Returns
    -------
    array (...)
        The ratio.
    """
    state = GrappleState(motion)
    return np.asarray(state.given / state.needed)


def grapple_columns(motion: Motion) -> list[Column]:
    """Return the table of a motion; where no stem of the range is held D, M_1 and the ratio are NaN."""
    state = GrappleState(require_placed(motion))
    held = motion.strokes["theta"] <= MET
    of_stems = [np.where(held, each, np.nan) for each in (state.D, state.needed, state.given / state.needed)]
    return [
        Column("theta", motion["theta"], "deg", 2, "theta"), Column("D", of_stems[0], "mm", 1), Column("EC", motion["EC"], "mm", 1, "EC"),
        Column("H", state.H, "mm", 2), Column("M_g", state.given, "Nm", 1), Column("M_1", of_stems[1], "Nm", 1),
        Column("M_g/M_1", of_stems[2], "", 4),
    ]  # fmt: skip


def grapple_verdicts(motion: Motion) -> list[Verdict]:
    """Return the verdicts on one design, over its own way whatever poses the motion has."""
    if require_grapple(motion)._design_shape:
        return [Verdict("grapple", True, said("the verdicts are for one design at a time; this motion has a batch of them."))]
    words = unplaced_words(motion)
    if words:
        return [Verdict("cylinder", False, words)]
    return [moment_verdict(motion), *way_verdicts(motion), opening_verdict(motion), stroke_verdict(motion), hinge_verdict(motion)]


def crosshead_verdicts(motion: Motion) -> list[Verdict]:
    """Return the same of one cylinder on both levers, which stands over the housing and passes neither hinge nor stem."""
    if require_grapple(motion)._design_shape:
        return grapple_verdicts(motion)
    room, needed = float(np.ravel(motion["room"])[0]), float(motion.inputs["bore"] / 2.0)
    remedy = "" if room >= needed else said(": it stands in the housing; take longer links, a shorter OC or a smaller bore")
    text = said(
        "the cylinder's pin E stands {room} over the housing; half its bore is {needed}", room=show(room, "mm", ".1f"),
        needed=show(needed, "mm", ".1f"),
    )  # fmt: skip
    standing = Verdict("room", room >= needed, f"{text}{remedy}.")
    return [moment_verdict(motion), standing, opening_verdict(motion), stroke_verdict(motion), hinge_verdict(motion)]


def stem_at(motion: Motion, answer: Answer) -> str:
    """Return the diameter of the stem that is held at the place of an answer, in words."""
    return show(float(motion.moved({"theta": np.array([answer.strokes["theta"]])})["D"][0]), "mm", ".0f")


def moment_verdict(motion: Motion) -> Verdict:
    """Return whether the lever's moment is enough for every stem, and where it is scarcest."""
    share = MotionFunction(moment_ratio)
    found = answers_over(gripping(motion), [least(share), most(share)])
    thin, thick = (stem_at(motion, each) for each in found)
    low, high = (float(each.value) for each in found)
    text = said(
        "M_g / M_1 is {low:.4g} at the stem of {thin}, the least, and {high:.4g} at {thick}, the greatest",
        low=low, thin=thin, high=high, thick=thick,
    )  # fmt: skip
    remedy = "" if low >= 1.0 - MET else said(": too little; take a greater bore, or move C along the lever")
    return Verdict("moment", low >= 1.0 - MET, f"{text}{remedy}.", answer=found[0])


def way_verdicts(motion: Motion) -> list[Verdict]:
    """Return whether the cylinder passes the hinge's bush on its whole way (2.93), and keeps off every stem that is held."""
    (passing,) = answers_over(travelling(motion), [least(np.abs(ratio("EC")))])
    (beside,) = answers_over(gripping(motion), [least("room")])
    needed = {"passing": float(motion.inputs["bush"] + motion.inputs["rod"] / 2.0), "room": float(motion.inputs["bore"] / 2.0)}
    by = {
        name: {
            "room": show(float(found.value), "mm", ".1f"), "theta": show(float(found.strokes["theta"]), "deg", ".1f"),
            "needed": show(needed[name], "mm", ".1f"),
        } for name, found in (("passing", passing), ("room", beside))
    }  # fmt: skip
    text = said(
        "the cylinder's line passes the hinge at {room} at the least, at theta = {theta}; bush and rod need {needed}.", **by["passing"]
    )
    passes = Verdict("passing", float(passing.value) >= needed["passing"] - MET, text, answer=passing)
    is_free = float(beside.value) >= needed["room"]
    text = said("the cylinder's axis keeps {room} off the stems, at theta = {theta} the least; half its bore is {needed}", **by["room"])
    remedy = "" if is_free else said(": it runs into the stem; give a greater hinge_gap or another bend")
    return [passes, Verdict("room", is_free, f"{text}{remedy}.", answer=beside)]


def opening_verdict(motion: Motion) -> Verdict:
    """Return whether the open lever lets the largest stem go, and how (2.71) tells it."""
    opened, exact, about = (float(np.ravel(motion[name])[0]) for name in ("opening_angle", "release_angle", "about_release"))
    text = said(
        "opens by {opened}; the largest stem goes at {exact} ({about} by (2.71), which is too little)",
        opened=show(opened, "deg", ".2f"), exact=show(exact, "deg", ".2f"), about=show(about, "deg", ".2f"),
    )  # fmt: skip
    share, (low, high) = float(motion.inputs["opening"]), ADVISED
    told = "" if low <= share <= high else said("; opening = {share:.3g}, {low} to {high} is advised", share=share, low=low, high=high)
    return Verdict("opening", opened >= exact, f"{text}{told}.")


def stroke_verdict(motion: Motion) -> Verdict:
    """Return whether the class's range of theta is the lever's own way, and which way the cylinder has."""
    declared = motion.plan.strokes["theta"]
    opened, closing = (float(np.ravel(motion[name])[0]) for name in ("opening_angle", "closing_angle"))
    fits = abs(declared.start - opened) < 1e-6 and abs(declared.end + closing) < 1e-6
    lengths = travelling(motion, 2)["EC"]
    text = said(
        "the lever closes by {closing} from D_0 to d_0, EC goes from {low} to {high}",
        closing=show(closing, "deg", ".2f"), low=shown_number(float(lengths[0]), "mm", ".1f"), high=show(float(lengths[-1]), "mm", ".1f"),
    )  # fmt: skip
    if fits:
        return Verdict("stroke", True, f"{text}.")
    start, end = shown_number(declared.start, "deg", ".2f"), show(declared.end, "deg", ".2f")
    other = said("; the class's theta goes from {start} to {end}: make one by grapple_for", start=start, end=end)
    return Verdict("stroke", False, f"{text}{other}.")


def hinge_verdict(motion: Motion) -> Verdict:
    """Return the force in the hinge O, the greatest over the stems."""
    (found,) = answers_over(gripping(motion), [most(pin_force("O"))])
    text = said(
        "the pin O carries up to {force}, at the stem of {stem}.", force=show(float(found.value), "kN", ".1f"), stem=stem_at(motion, found)
    )
    return Verdict("hinge", True, text, answer=found)
