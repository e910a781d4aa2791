"""The hitch's lifting capacity: (28) and (29), at the centre of gravity, at the hitch points, and behind them; its least, and why.

Figure 2, the zones of capacity and tilt over the admissible settings, and the upper link for a vertical mast. Pressures are gauge.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from hydraulics import LiftCircuit
from hydraulics.cylinders import found_in
from linkage import Column, Force, ForceElement, Mechanism, Motion, angle, least, most
from linkage.errors import ensure, unwarned
from linkage.frozen import record
from linkage.language import noted, said, translated
from linkage.loads.element import Formulas
from linkage.mechanism import require_mechanism
from linkage.motion import MotionFunction, judge_along, require_motion
from linkage.motion.grid import recalled
from linkage.plan import Plan
from linkage.program import FloatArray
from linkage.quantities import Distance
from linkage.reports import closely
from linkage.statics import AnyMotion, LawRequest
from linkage.study import Settings, Zone, settings_for, zone
from linkage.units import deg, g0, mm, require_number, show, shown_number, unit_sign

from ..paper import own_loads

BEHIND = 610 * mm
"""Distance from the hitch points to the centre of the load at which tractors are tested (OECD Code 2)."""

SHARE = 0.9
"""Share of the relief valve's pressure that a tractor's test results are given for (OECD Code 2)."""

NOT_OWN = ("load", "lift", "circuit")


def circuit_of(motion: Motion) -> LiftCircuit:
    """Return the motion's lift circuit."""
    require_motion(motion)
    return lifting_circuit(motion.plan)


def capacity(motion: Motion, point: str = "G", share: float = 1.0) -> FloatArray:
    """Return the lifting capacity G_g = F_cyl eta / I (28), with F_cyl = p_max area (29) and I = dy/dS of the point.

    Parameters
    ----------
    motion : Motion
        The poses.
    point : str, optional
        The point that the load is at.
    share : float, optional
        The share of the pump's pressure, 1 by default.

    Returns
    -------
    array (...)
        The capacity [N]; NaN where I is not above zero: not limited by this cylinder.
    """
    return circuit_of(motion).lifted(motion, point, own_loads(motion, *NOT_OWN), share=share)


def lifted(point: str = "G", share: float = 1.0) -> LawRequest:
    """Return the request for the lifting capacity (28) [N] at a point and a share of the pump's pressure."""

    def formula(motion: AnyMotion) -> FloatArray:
        return lifting_circuit(motion.plan).lifted(motion, point, own_loads(motion, *NOT_OWN), share=share)

    known = "lifted", point, share
    return LawRequest(formula=formula, text="the lifting capacity", known=known, measures="force", examine=lifting_circuit)


def lifting_circuit(plan: Plan) -> LiftCircuit:
    """Return the circuit of a hitch that lifts; DefinitionError where there is none."""
    circuits = plan.of_kind(LiftCircuit)
    ensure("circuit" in circuits, f"{plan.title} has no lift circuit of the name circuit; give the motion of a three-point hitch.")
    return circuits["circuit"]


def write_capacity(written: Formulas) -> None:
    """Write F_cyl (29) and G_g (28), as `capacity` has it: loads other than the implement reduce the cylinders' force."""
    lift, thrust = found_in(written.plan.members, "lift", written.plan.title), written.thrust("lift")
    if thrust is None:
        return
    area, _ = lift.sides_written(written, thrust)
    force = written.line("F_cyl", written.inputs["circuit.pressure"] * area, "kN")
    most, lever = force * written.inputs["circuit.mechanical_efficiency"], written.ratio("G")[1] / written.ratio(Distance("A", "B"))
    others = [name for name in written.plan.of_kind(ForceElement) if name not in NOT_OWN]
    spare = most - (thrust - written.weight("load") * lever) if others else most
    written.line("G_g", spare / lever, "kN")


def at_hitch_points(motion: Motion, share: float = SHARE) -> FloatArray:
    """Return the capacity with the load at the hitch points F [N], shape (...).

    Parameters
    ----------
    motion : Motion
        The poses.
    share : float, optional
        The share of the pump's pressure, 0.9 by default.

    Returns
    -------
    array (...)
        The capacity.
    """
    return capacity(motion, "F", share)


def behind(motion: Motion, distance: float = BEHIND, share: float = SHARE) -> FloatArray:
    """Return the capacity with the load's centre a distance behind the hitch points, square to the upright.

    Parameters
    ----------
    motion : Motion
        The poses.
    distance : float, optional
        The distance [m], 0.61 by default.
    share : float, optional
        The share of the pump's pressure, 0.9 by default.

    Returns
    -------
    array (...)
        The capacity [N].
    """
    require_motion(motion)
    require_number("distance", distance, "one number in m is expected, such as 0.61", kind="length")
    tested = {"FG": distance, "KFG": 90 * deg}
    moved = Motion(motion.plan, motion.designs | tested, motion.strokes, motion.unreachable)
    return moved._requested(lifted("G", share))


def stroke_per_newton(motion: Motion) -> FloatArray:
    """Return one over the capacity at G [1/N], shape (...); not above zero where the cylinder does not limit.

    Unlike the capacity it has no gap where the ratio goes through zero, so that extremes are sought in it.
    """

    def found() -> FloatArray:
        circuit = circuit_of(motion)
        (lift,) = circuit.rams(motion)
        most = circuit.largest(motion, own_loads(motion, *NOT_OWN)) * circuit.efficiency(motion, "mechanical")
        spare = most - lift.thrust(motion, own_loads(motion, *NOT_OWN), direction="extending")
        with np.errstate(divide="ignore"):
            return np.asarray(lift.thrust(motion, [Force("G", (0.0, -1.0))]) / np.maximum(spare, 0.0))

    return require_motion(motion)._once("stroke per newton", found)


# The weakest point of the capacity curve, and what limits it there.

CHANGE = 10 * mm
STILL = 1e-12  # a factor this small moves nothing
DIMENSIONS = ("OB", "OC", "ED", "CD", "EF", "MK", "A.x", "A.y", "O.x", "O.y", "E.x", "E.y", "M.x", "M.y")
"""Dimensions of the tractor's side that a designer may change."""

CHANGES = {
    "": (noted("longer"), noted("shorter")), "x": (noted("farther back"), noted("farther forward")),
    "y": (noted("higher"), noted("lower")),
}  # fmt: skip


@record
class Weakest:
    """The weakest point of the capacity curve of one design.

    Attributes
    ----------
    stroke, height : float
        The stroke and the height of F there [m].
    capacity : float
        The capacity there [N].
    ratio : float
        The ratio I there.
    stage : str
        What its ratio owes most to, against the best point.
    remedy : str
        The change of one dimension that helps most.
    """

    stroke: float
    height: float
    capacity: float
    ratio: float
    stage: str
    remedy: str

    @property
    def sentence(self) -> str:
        """The weakest point and its limit."""
        text = said(
            "least at S = {stroke}, F {height} high: {capacity} ({mass}). There the pressure limits it: G rises {ratio:.3f} {unit} "
            "for 1 {unit} of the cylinder, {stage}.",
            stroke=show(self.stroke, "mm", ".1f"), height=show(self.height, "mm", ".0f"), capacity=show(self.capacity, "kN", ".2f"),
            mass=show(self.capacity / g0, "kg", ".0f"), ratio=self.ratio, unit=unit_sign("mm"), stage=self.stage,
        )  # fmt: skip
        return f"{text} {self.remedy}"


def weakest(motion: Motion) -> Weakest | None:
    """Return the weakest point over a motion of one design; None where the cylinder limits nothing.

    Parameters
    ----------
    motion : Motion
        The poses.

    Returns
    -------
    Weakest, optional
        The weakest point.
    """
    judge = judge_along(motion)
    share = MotionFunction(stroke_per_newton)
    worst, easiest = judge.answers([most(share), least(abs(share))])
    if not worst.value > 0.0:
        return None

    def found() -> tuple[Motion, Motion, float]:
        there, best = (closely(motion, np.array([each.strokes["S"]])) for each in (worst, easiest))
        return there, best, float(capacity(there)[0])

    with unwarned():  # at the end of the reach it stands next to a dead point: the sentence keeps few digits
        there, best, force = judge._once("weakest", found)
        ratio, height = float(there.ratio("G")[1][0]), float(there.y("F")[0])
        return Weakest(float(worst.strokes["S"]), height, force, ratio, stage(there, best), remedy(motion))


def stages(motion: Motion) -> dict[str, tuple[float, str, str]]:
    """Return the factors of I at one pose: arm turned by the cylinder, F lifted by the arm, G by F.

    Each by its name, with what it amounts to in words, in whole and as it stands beside another.
    """
    turn, rise, ratio = (float(each) for each in (motion.ratio(angle("O", "B"))[0], motion.ratio("F")[1, 0], motion.ratio("G")[1, 0]))
    lever = show(1.0 / abs(turn), "mm", ".0f")
    by_arm = said("F rises {height} for {angle} of the lift arm", height=show(rise / turn * deg, "mm", ".2f"), angle=show(deg, "deg"))
    by_link = said("G rises {ratio:.3f} times as fast as F", ratio=ratio / rise)
    return {
        said("the cylinder's lever"): (turn, said("its lever about O {lever}", lever=lever), lever),
        said("lift arm, lift rod and lower link"): (rise / turn, by_arm, by_arm),
        said("the upper link, which turns the implement"): (ratio / rise, by_link, by_link),
    }


def stage(there: Motion, best: Motion) -> str:
    """Return which factor of the ratio has grown most from the best point to the weakest, in words."""
    now, then = stages(there), stages(best)
    name = max(now, key=lambda each: abs(now[each][0]) / max(abs(then[each][0]), STILL))
    if now[name][0] == then[name][0]:
        return said("the same at all poses of this motion")
    (S,) = best.strokes.values()
    return said(
        "mostly by {name}: {now}, at the best point, S = {stroke}, {then}",
        name=name, now=now[name][1], stroke=show(float(S[0]), "mm", ".1f"), then=then[name][2],
    )  # fmt: skip


def remedy(motion: Motion) -> str:
    """Return the change by 10 mm of one dimension that raises the least capacity most, in words."""
    names = [name for name in DIMENSIONS if name in motion.designs for _ in (1, -1)]
    steps = np.tile([CHANGE, -CHANGE], len(names) // 2)
    if not names:
        return ""
    place, gain = recalled(motion, ("remedy", *names), lambda: best_change(motion, names, steps))
    if not 0.0 < gain < np.inf:
        return said("No single dimension of the tractor's side, changed by {change}, helps.", change=show(CHANGE, "mm", ".0f"))
    name, _, axis = names[place].partition(".")
    return said(
        "Of the tractor's dimensions {name} {change} {way} helps most: {gain:+.1f} %.",
        name=name, change=show(CHANGE, "mm", ".0f"), way=translated(CHANGES[axis][int(steps[place] < 0.0)]), gain=100.0 * gain,
    )  # fmt: skip


def best_change(motion: Motion, names: Sequence[str], steps: FloatArray) -> tuple[int, float]:
    """Return which of some dimensions, each changed by its step [m], raises the least capacity most, and by which share of it."""
    tried, changes = [*names, ""], np.append(steps, 0.0)  # the last is the design as it is
    designs = {name: motion.designs[name] + np.where([each == name for each in tried], changes, 0.0) for name in dict.fromkeys(names)}
    fine = Motion(motion.plan, motion.designs | designs, closely(motion).strokes, "nan")
    found = stroke_per_newton(fine)
    worst = np.where(np.isnan(found), -np.inf, found).max(axis=1)
    burden = np.where(fine.reached.all(axis=1) & np.isfinite(worst), worst, np.inf)[:-1]
    place = int(np.argmin(burden))
    return place, float(worst[-1] / burden[place]) - 1.0


# -- figure 2: the zones ---------------------------------------------------------------------------------------

def admissible(hitch: Mechanism) -> Mapping[str, Any]:
    """Return the settings that its class admits."""
    return type(hitch).__dict__.get("admissible") or getattr(hitch, "admissible", {})


def tilt_zone(hitch: Mechanism, over: Mapping[str, Any] | None = None, **strokes: Any) -> Zone:
    """Return the least and the greatest tilt [rad] over the admissible settings at every stroke.

    Parameters
    ----------
    hitch : ThreePointHitch
        The hitch, one design.
    over : mapping of str to object, optional
        Other settings, as in `Box.of`.
    **strokes : float or array
        As in `machine.at`.

    Returns
    -------
    Zone
        The zone.
    """
    return zone(hitch, "tilt", admissible(hitch) if over is None else over, **strokes)


def capacity_zone(hitch: Mechanism, over: Mapping[str, Any] | None = None, **strokes: Any) -> Zone:
    """Return the least and the greatest capacity [N] over the admissible settings at every stroke.

    Parameters
    ----------
    hitch : ThreePointHitch
        The hitch, one design.
    over : mapping of str to object, optional
        Other settings, as in `Box.of`.
    **strokes : float or array
        As in `machine.at`.

    Returns
    -------
    Zone
        The zone. `low` is NaN where no setting is limited by the cylinder; `high` where some setting is not, which is then a remark.
    """
    found = zone(hitch, stroke_per_newton, admissible(hitch) if over is None else over, **strokes)
    with np.errstate(divide="ignore", invalid="ignore"):
        low, high = (np.asarray(np.where(value > 0.0, 1.0 / value, np.nan)) for value in (found.high, found.low))
    free = int(np.sum(found.low <= 0.0))
    more = (f"At {free} of {found.low.size} strokes some settings are not limited by this cylinder: the zone has no upper end there.",)
    return replace(
        found, quantity="capacity", low=low, high=high, low_at=found.high_at, high_at=found.low_at,
        remarks=found.remarks + (more if free else ()),
    )  # fmt: skip


def zone_columns(capacity: Zone, tilt: Zone) -> list[Column]:
    """Return both zones as a table over the stroke.

    Parameters
    ----------
    capacity, tilt : Zone
        The zones.

    Returns
    -------
    list of Column
        The columns.
    """
    return [
        Column("S", capacity.strokes["S"], "mm", 1),
        Column(noted("capacity_min"), capacity.low, "kN", 2),
        Column(noted("capacity_max"), capacity.high, "kN", 2),
        Column(noted("tilt_min"), tilt.low, "deg", 3),
        Column(noted("tilt_max"), tilt.high, "deg", 3),
        Column(noted("assembled"), tilt.reached, "", 3),
    ]


# The setting of the upper link that makes the mast stand upright.

WIDE = (0.3, 3.0)
"""How far is looked, as multiples of the upper link's length."""


def vertical_mast(hitch: Mechanism, S: float, between: tuple[float, float] | None = None) -> Settings:
    """Return every length of the upper link MK [m] that makes the mast vertical at a stroke, or why there is none.

    Parameters
    ----------
    hitch : ThreePointHitch
        The hitch, one design.
    S : float
        The stroke [m].
    between : tuple of float, optional
        The range of lengths [m], by default from 0.3 to 3 times MK.

    Returns
    -------
    Settings
        The lengths.
    """
    require_mechanism(hitch)
    wide = between if between is not None else (WIDE[0] * hitch["MK"], WIDE[1] * hitch["MK"])
    return settings_for(hitch, "MK", "tilt", 0.0, between=wide, unit="deg", S=S)


def mast_words(hitch: Mechanism, S: float) -> str:
    """Return the upper link for a vertical mast at a stroke [m] in words, and whether its admissible range holds it."""
    found, (low, high) = vertical_mast(hitch, S), admissible(hitch).get("MK", (0.0, float("inf")))
    apart = [value for value in found.values if not low <= value <= high]
    if not apart:
        return found.sentence
    admitted = said("That is outside the admissible {low} to {high}.", low=shown_number(low, "mm", ".0f"), high=show(high, "mm", ".0f"))
    return f"{found.sentence} {admitted}"
