"""The tractor's balance: front-axle load, and the implement's mass and the slope at which it tips.

Moments about the driving wheels' contact with the ground, the origin; tyres are rigid, inertia is left out. Heavy is the
implement `load` at G, the tractor at (vehicle_x, vehicle_y), and every other load that the hitch declares, a user's additions too;
a slope turns gravity to (-sin, -cos).
"""

from __future__ import annotations

import numpy as np

from linkage import ForceElement, Motion, least
from linkage.language import said
from linkage.motion import Judge, MotionFunction
from linkage.program import FloatArray
from linkage.units import g0, show
from linkage.verdict import Verdict

from .capacity import own_loads


def lever(motion: Motion, x: FloatArray, y: FloatArray) -> FloatArray:
    """Return the lever of a weight at (x, y) about the driving wheels' contact [m], positive where it lifts the front axle."""
    slope = motion.inputs["slope"]
    return np.asarray(x * np.cos(slope) - y * np.sin(slope))


def vehicle_lever(motion: Motion) -> FloatArray:
    """Return the lever of the tractor's own weight [m]; negative where it loads the front axle."""
    return lever(motion, motion.inputs["vehicle_x"], motion.inputs["vehicle_y"])


def implement_lever(motion: Motion) -> FloatArray:
    """Return the lever of the implement's weight [m], shape (...)."""
    return lever(motion, motion.x("G"), motion.y("G"))


def added(motion: Motion) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return the moment of all other loads about the wheels' contact [Nm] as (a, b, c), shape (...): a cos + b sin + c of the slope.

    Positive where it lifts the front axle. Masses turn with the slope, other forces stay. What acts between two points of the machine
    has none.
    """
    elements, totals = motion.plan.of_kind(ForceElement), []
    for slope in (0.0, np.pi / 2.0, np.pi):
        total = np.zeros(motion.shape)
        for name in own_loads(motion):
            for load in elements[name].in_gravity(None, slope).loads(motion):
                r, force = motion[load.point], load.force
                total = total - (r[0] * force[1] - r[1] * force[0])
        totals.append(total)
    level, wall, upside = totals
    constant = 0.5 * (level + upside)
    return level - constant, wall - constant, constant


def added_moment(motion: Motion) -> FloatArray:
    """Return the moment of all other loads on the slope as it is set [Nm], shape (...), positive where it lifts the front axle."""
    a, b, c = added(motion)
    slope = motion.inputs["slope"]
    return np.asarray(a * np.cos(slope) + b * np.sin(slope) + c)


def front_axle(motion: Motion) -> FloatArray:
    """Return the front axle's load square to the ground [N], shape (...); below zero the tractor tips over backwards."""
    given = motion.inputs
    moment = given["vehicle_mass"] * vehicle_lever(motion) + given["load.mass"] * implement_lever(motion)
    return np.asarray(-(g0 * moment + added_moment(motion)) / given["wheelbase"])


def mass_leaving(motion: Motion, share: FloatArray | float) -> FloatArray:
    """Return the implement's mass [kg], shape (...), that leaves a share of the tractor's weight on the front axle.

    0 where not even the bare tractor has it; NaN where the implement's weight does not lift the front axle: no limit.
    """
    given, arm = motion.inputs, implement_lever(motion)
    spare = -given["vehicle_mass"] * (vehicle_lever(motion) + share * given["wheelbase"]) - added_moment(motion) / g0
    with np.errstate(divide="ignore", invalid="ignore"):
        mass = spare / arm
    return np.where(arm > 0.0, np.maximum(mass, 0.0), np.nan)


def tipping_mass(motion: Motion) -> FloatArray:
    """Return the implement's mass at which the tractor tips [kg], shape (...); NaN where none does."""
    return mass_leaving(motion, 0.0)


def largest_mass(motion: Motion) -> FloatArray:
    """Return the largest implement's mass that leaves the front axle its least share [kg], shape (...); NaN where there is no limit."""
    return mass_leaving(motion, motion.inputs["least_front"])


def tipping_slope(motion: Motion) -> FloatArray:
    """Return how steep it may go uphill until the tractor tips over backwards [rad], shape (...); 0 where it tips on level ground."""
    given, (a, b, c) = motion.inputs, added(motion)
    along = g0 * (given["vehicle_mass"] * given["vehicle_x"] + given["load.mass"] * motion.x("G")) + a
    up = g0 * (given["vehicle_mass"] * given["vehicle_y"] + given["load.mass"] * motion.y("G")) - b
    with np.errstate(divide="ignore", invalid="ignore"):
        held = np.arcsin(np.clip(-c / np.hypot(along, up), -1.0, 1.0))  # along cos + up sin + c = 0 of the angle uphill
    return np.asarray(np.maximum(held + np.arctan2(-along, up), 0.0))


def balance_verdict(judge: Judge) -> Verdict:
    """Return whether the front axle keeps its least share of the tractor's weight, with the tipping limits."""
    asked = [MotionFunction(front_axle, "force"), *map(MotionFunction, (tipping_mass, largest_mass, tipping_slope))]
    worst, tips, largest, slope = judge.answers([*map(least, asked)])
    load, given = float(worst.value), judge.motion.inputs
    share, needed = load / (float(given["vehicle_mass"]) * g0), float(given["least_front"])
    height = show(float(judge.there(worst).y("F")), "mm", ".0f")
    where = said("at S = {stroke}, F {height} high", stroke=show(float(worst.strokes["S"]), "m", ".4f"), height=height)
    mass = said("No implement tips it")
    if np.isfinite(tips.value):
        mass = said("It tips with {mass}", mass=show(float(tips.value), "kg", ".0f"))
    if load <= 0.0:
        text = said(
            "the tractor tips over backwards {where}. {mass}: take a lighter implement or ballast in front.", where=where, mass=mass
        )  # fmt: skip
        return Verdict("front axle", False, text, answer=worst)
    says = said(
        "least load {load}, {share:.0f} % of the tractor's weight, {where}; steering needs {least:.0f} %",
        load=show(load, "kN", ".2f"), share=100 * share, where=where, least=100 * needed,
    )  # fmt: skip
    steep = show(float(slope.value), "deg", ".1f")
    uphill = said("{mass}, and with this one uphill at {slope}.", mass=mass, slope=steep)
    if share >= needed:
        return Verdict("front axle", True, f"{says}. {uphill}", answer=worst)
    ballast = (needed - share) * float(given["vehicle_mass"]) / np.cos(float(given["slope"]))
    remedy = said(
        "At most {most}, or {ballast} of ballast over the front axle.",
        most=show(float(largest.value), "kg", ".0f"), ballast=show(ballast, "kg", ".0f"),
    )  # fmt: skip
    return Verdict("front axle", False, f"{says}. {remedy} {uphill}", answer=worst)
