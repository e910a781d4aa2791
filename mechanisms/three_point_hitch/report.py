"""The hitch's tables and the tractor's balance, and the verdicts on both, in sentences.

The balance is the front axle's load, and the implement's mass and the slope at which the tractor tips. Moments are about the driving
wheels' contact with the ground, the origin; tyres are rigid, inertia is left out. Heavy is the implement `load` at G, the tractor at
(vehicle_x, vehicle_y), and every other load that the hitch declares, a user's additions too; a slope turns gravity to (-sin, -cos).
"""

from __future__ import annotations

import numpy as np

from linkage import Column, ForceElement, Mechanism, Motion, Verdict, least, most, pin_forces
from linkage.language import noted, said, with_and
from linkage.loads import Case
from linkage.motion import Judge, MotionFunction, below_zero, judge_along
from linkage.program import FloatArray
from linkage.units import g0, show, shown_number

from ..paper import own_loads
from .capacity import BEHIND, NOT_OWN, SHARE, at_hitch_points, behind, capacity, circuit_of, lifted, mast_words, weakest


def added(motion: Motion) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return the moment of all other loads about the wheels' contact [Nm] as (a, b, c), shape (...): a cos + b sin + c of the slope.

    Positive where it lifts the front axle. Masses turn with the slope, other forces stay. What acts between two points of the machine
    has none.
    """
    elements, totals = motion.plan.of_kind(ForceElement), []
    for slope in (0.0, np.pi / 2.0, np.pi):
        total = np.zeros(motion.shape)
        for name in own_loads(motion, *NOT_OWN):
            for load in elements[name].in_gravity(None, slope).loads(motion):
                r, force = motion[load.point], load.force
                total = total - (r[0] * force[1] - r[1] * force[0])
        totals.append(total)
    level, wall, upside = totals
    constant = 0.5 * (level + upside)
    return level - constant, wall - constant, constant


def lifting(motion: Motion) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return the levers of tractor and implement about the driving wheels' contact [m] and the moment of all other loads [Nm], (...) each.

    Positive where they lift the front axle, on the slope as it is set.
    """
    given, (a, b, c) = motion.inputs, added(motion)
    cos, sin = np.cos(given["slope"]), np.sin(given["slope"])
    return given["vehicle_x"] * cos - given["vehicle_y"] * sin, motion.x("G") * cos - motion.y("G") * sin, a * cos + b * sin + c


def front_axle(motion: Motion) -> FloatArray:
    """Return the front axle's load square to the ground [N], shape (...); below zero the tractor tips over backwards.

    Parameters
    ----------
    motion : Motion
        The poses.

    Returns
    -------
    array (...)
        The load.
    """
    given, (vehicle, implement, others) = motion.inputs, lifting(motion)
    moment = given["vehicle_mass"] * vehicle + given["load.mass"] * implement
    return np.asarray(-(g0 * moment + others) / given["wheelbase"])


def mass_leaving(motion: Motion, share: FloatArray | float) -> FloatArray:
    """Return the implement's mass [kg], shape (...), that leaves a share of the tractor's weight on the front axle.

    0 where not even the bare tractor has it; NaN where the implement's weight does not lift the front axle: no limit.
    """
    given, (vehicle, implement, others) = motion.inputs, lifting(motion)
    spare = -given["vehicle_mass"] * (vehicle + share * given["wheelbase"]) - others / g0
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(implement > 0.0, np.maximum(spare / implement, 0.0), np.nan)


def tipping_mass(motion: Motion) -> FloatArray:
    """Return the implement's mass at which the tractor tips [kg], shape (...); NaN where none does.

    Parameters
    ----------
    motion : Motion
        The poses.

    Returns
    -------
    array (...)
        The mass.
    """
    return mass_leaving(motion, 0.0)


def largest_mass(motion: Motion) -> FloatArray:
    """Return the largest implement's mass that leaves the front axle its least share [kg], shape (...); NaN where there is no limit.

    Parameters
    ----------
    motion : Motion
        The poses.

    Returns
    -------
    array (...)
        The mass.
    """
    return mass_leaving(motion, motion.inputs["least_front"])


def tipping_slope(motion: Motion) -> FloatArray:
    """Return how steep it may go uphill until the tractor tips over backwards [rad], shape (...); 0 where it tips on level ground.

    Parameters
    ----------
    motion : Motion
        The poses.

    Returns
    -------
    array (...)
        The slope.
    """
    given, (a, b, c) = motion.inputs, added(motion)
    along = g0 * (given["vehicle_mass"] * given["vehicle_x"] + given["load.mass"] * motion.x("G")) + a
    up = g0 * (given["vehicle_mass"] * given["vehicle_y"] + given["load.mass"] * motion.y("G")) - b
    with np.errstate(divide="ignore", invalid="ignore"):
        held = np.arcsin(np.clip(-c / np.hypot(along, up), -1.0, 1.0))  # along cos + up sin + c = 0 of the angle uphill
    return np.asarray(np.maximum(held + np.arctan2(-along, up), 0.0))


def balance_verdict(judge: Judge) -> Verdict:
    """Return whether the front axle keeps its least share of the tractor's weight, with the tipping limits."""
    given = judge.motion.inputs
    weight, needed = float(given["vehicle_mass"]) * g0, float(given["least_front"])
    asked = map(least, map(MotionFunction, (tipping_mass, largest_mass, tipping_slope)))
    worst, tips, largest, slope = judge.answers([least(MotionFunction(front_axle, "force")) >= needed * weight, *asked])
    load, share = float(worst.value), float(worst.value) / weight
    height = show(float(judge.there(worst).y("F")), "mm", ".0f")
    where = said("at S = {stroke}, F {height} high", stroke=show(float(worst.strokes["S"]), "mm", ".1f"), height=height)
    tipping = show(float(tips.value), "kg", ".0f")
    mass = said("It tips with {mass}", mass=tipping) if np.isfinite(tips.value) else said("No implement tips it")
    if load <= 0.0:
        text = said(
            "the tractor tips over backwards {where}. {mass}: take a lighter implement or ballast in front.", where=where, mass=mass
        )  # fmt: skip
        return Verdict("front axle", False, text, answer=worst)
    says = said(
        "least load {load}, {share:.0f} % of the tractor's weight, {where}; steering needs {least:.0f} %",
        load=show(load, "kN", ".2f"), share=100 * share, where=where, least=100 * needed,
    )  # fmt: skip
    uphill = said("{mass}, and with this one uphill at {slope}.", mass=mass, slope=show(float(slope.value), "deg", ".1f"))
    if share >= needed:
        return Verdict("front axle", True, f"{says}. {uphill}", answer=worst)
    ballast = (needed - share) * float(given["vehicle_mass"]) / np.cos(float(given["slope"]))
    remedy = said(
        "At most {most}, or {ballast} of ballast over the front axle.",
        most=show(float(largest.value), "kg", ".0f"), ballast=show(ballast, "kg", ".0f"),
    )  # fmt: skip
    return Verdict("front axle", False, f"{says}. {remedy} {uphill}", answer=worst)


# -- tables and verdicts ----------------------------------------------------------------------------------------

def capacity_columns(motion: Motion) -> list[Column]:
    """Return stroke and lift height, ratio, capacities, tilt, upper link (tension positive), and the tractor's balance.

    Parameters
    ----------
    motion : Motion
        The poses.

    Returns
    -------
    list of Column
        The columns.
    """
    return [
        Column("S", motion.strokes["S"], "mm", 1),
        Column("F_y", motion.y("F"), "mm", 1),
        Column("I", motion.ratio("G")[1], "", 4),
        Column(noted("capacity"), capacity(motion), "kN", 2),
        Column("F 90%", at_hitch_points(motion), "kN", 2),
        Column("610 90%", behind(motion), "kN", 2),
        Column(noted("tilt"), motion["tilt"], "deg", 3),
        Column("MK", upper_link_force(motion), "kN", 2),
        Column(noted("front"), front_axle(motion), "kN", 2),
        Column(noted("max"), largest_mass(motion), "kg", 0),
        Column(noted("tips"), tipping_mass(motion), "kg", 0),
        Column(noted("uphill"), tipping_slope(motion), "deg", 1),
    ]


def rules(hitch: Mechanism, motion: Motion) -> list[Verdict]:
    """Return the hitch's own rules over a motion; of a batch, how many designs fall short."""
    if not motion.reached.any():
        return []
    if motion._design_shape:
        return [batch_verdict(motion)]
    judge, worst = judge_along(motion), weakest(motion)
    says = said("the ratio is not above zero anywhere: the load is not limited by this cylinder.") if worst is None else worst.sentence
    found = Verdict("capacity", worst is None or worst.capacity >= float(motion.inputs["load.mass"]) * g0, says)
    low, high = (float(each.value) for each in judge.answers([least("tilt"), most("tilt")]))
    start = float(np.min(motion.strokes["S"][motion.reached]))
    text = said(
        "tilt {low} to {high} over this motion. At S = {start} {words}",
        low=shown_number(low, "deg", ".2f"), high=show(high, "deg", ".2f"),
        start=show(start, "mm", ".1f"), words=mast_words(hitch, start),
    )  # fmt: skip
    return [
        found, limit_verdict(judge), test_verdict(judge), upper_link_verdict(judge, motion), balance_verdict(judge),
        Verdict("mast", True, text),
    ]  # fmt: skip


def limit_verdict(judge: Judge) -> Verdict:
    """Return which limit comes first over the motion: pressure, the front axle's share, or tipping."""
    asked = [least(each) for each in (lifted(), MotionFunction(largest_mass), MotionFunction(tipping_mass))]
    force, steer, tip = (float(each.value) for each in judge.answers(asked))
    limits = {said("the pressure"): force / g0, said("the front axle's least load"): steer, said("tipping"): tip}
    least_of = {name: value for name, value in limits.items() if np.isfinite(value)}
    if not least_of:
        return Verdict("largest implement", True, said("nothing limits it over this motion."))
    first = min(least_of, key=lambda name: least_of[name])
    mass = float(judge.motion.inputs["load.mass"])
    text = said(
        "{first} comes first; over this motion: {limits}; the implement has {mass}.",
        first=first, limits="; ".join(f"{name} {show(value, 'kg', '.0f')}" for name, value in least_of.items()),
        mass=show(mass, "kg", ".0f"),
    )  # fmt: skip
    return Verdict("largest implement", mass <= least_of[first], text)


def test_verdict(judge: Judge) -> Verdict:
    """Return the load lifted through the whole range at 90 % of the pressure, the way tractors are tested."""
    parts, places = [], (said("at the hitch points"), said("{distance} behind them", distance=show(BEHIND, "mm", ".0f")))
    for where, found in zip(places, judge.answers([least(lifted("F", SHARE)), least(MotionFunction(behind))]), strict=True):
        is_limited = bool(np.isfinite(found.value))
        parts.append(f"{where} {show(float(found.value), 'kN', '.2f') if is_limited else said('not limited by the cylinders')}")
    text = said(
        "through the whole range at {share:.0f} % of the pressure (as OECD Code 2): {parts}.", share=100 * SHARE, parts=", ".join(parts)
    )  # fmt: skip
    return Verdict("test", True, text)


def upper_link_verdict(judge: Judge, motion: Motion) -> Verdict:
    """Return how large the force is over a motion of one design, and where it is tension or compression."""
    force = MotionFunction(upper_link_force)
    low, high = (float(each.value) for each in judge.answers([least(force), most(force)]))
    if low >= 0.0 or high <= 0.0:
        small, large = sorted((abs(low), abs(high)))
        ends = {"low": shown_number(small, "kN", ".2f"), "high": show(large, "kN", ".2f")}
        if low >= 0.0:
            return Verdict("upper link", True, said("in tension over this motion, {low} to {high}.", **ends))
        return Verdict("upper link", True, said("in compression over this motion, {low} to {high}.", **ends))
    text = said(
        "up to {tension} of tension and {compression} of compression, which acts {where}: the force changes its sense, "
        "so that play is felt.",
        tension=show(high, "kN", ".2f"), compression=show(-low, "kN", ".2f"),
        where=with_and([*map(str, below_zero(motion, force))]),
    )  # fmt: skip
    return Verdict("upper link", True, text)


def batch_verdict(motion: Motion) -> Verdict:
    """Return how many designs of a batch cannot lift their implement or lose the front axle at the motion's poses, and the extremes."""
    poses = tuple(range(len(motion._design_shape), len(motion.shape)))
    lifted = np.min(np.where(np.isnan(capacity(motion)), np.inf, capacity(motion)), axis=poses)
    weight = np.broadcast_to(motion.inputs["load.mass"] * g0, motion.shape).min(axis=poses)
    front = front_axle(motion) / (motion.inputs["vehicle_mass"] * g0) - motion.inputs["least_front"]
    light = np.min(np.where(np.isnan(front), np.inf, front), axis=poses) < 0.0
    whole = motion.reached.all(axis=poses)
    weak = lifted < weight
    text = said(
        "{weak} of {total} designs are too weak for their implement, {light} leave too little on the front axle, {short} do not reach "
        "all poses. The least capacity is {worst} in the worst design and {best} in the best. Take one design for its sentences.",
        weak=int(weak.sum()), total=lifted.size, light=int(light.sum()), short=int((~whole).sum()),
        worst=show(float(lifted.min()), "kN", ".2f"), best=show(float(lifted.max()), "kN", ".2f"),
    )  # fmt: skip
    return Verdict("designs", not (weak.any() or light.any() or (~whole).any()), text)


def pressure_words(motion: Motion) -> str:
    """Return the pump's pressure and the cylinders in words."""
    circuit = circuit_of(motion)
    pressure = show(float(circuit.supply(motion)), "MPa", 4)
    return said("{size} at {pressure}", size=circuit.rams(motion)[0].sized(motion), pressure=pressure)


# The force in the upper link, from the equilibrium of every body.


def upper_link_force(motion: Motion, case: Case = None) -> FloatArray:
    """Return the force in the upper link MK [N], shape (...): positive in tension, negative in compression.

    Parameters
    ----------
    motion : Motion
        The poses.
    case : LoadCase or str, optional
        The load case.

    Returns
    -------
    array (...)
        The force.
    """
    elements = motion.plan.of_kind(ForceElement)  # a spring at M, say, has a joint of its own there
    (joint,) = (each for each in pin_forces(motion, case=case).at("M") if not {each.on, each.by} & set(elements))
    on_link = joint.force if joint.by == "frame" else -joint.force
    along = motion["M"] - motion["K"]
    return np.asarray((on_link * along).sum(axis=0) / np.hypot(along[0], along[1]))
