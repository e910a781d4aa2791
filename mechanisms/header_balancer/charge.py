"""To what pressure the line is charged: as published, for a reaction, and at the most. Pressures gauge [Pa], one design at a time."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import final

import numpy as np

from hydraulics import adiabatic, isothermal
from hydraulics.gas import Gas
from linkage import DefinitionError, Motion, least
from linkage.checks import require_number
from linkage.errors import ensure
from linkage.language import noted
from linkage.motion import Judge, last_holding, require_motion
from linkage.plan import Mask
from linkage.program import FloatArray
from linkage.units import deg, kgf_cm2, mm, show

from .following import HeaderState, at_horizon, over_following


def _header(mass: float, charge: float, L_OR: float, BOR: float, OG2: float, BOG2: float) -> Mapping[str, float]:
    return MappingProxyType(
        {"m2": mass, "charge": charge * kgf_cm2, "L_OR": L_OR, "BOR": BOR * deg, "OG2": OG2, "BOG2": BOG2 * deg}
    )  # fmt: skip


HEADERS: Mapping[int, Mapping[str, float]] = MappingProxyType(
    {
        1: _header(2000.0, 94.0, 2.665521, 13.055247, 2.137161, 28.184398),  # both gas charges at work
        2: _header(1000.0, 34.0, 2.040833, 5.290081, 1.436851, 18.840343),   # the 50 kgf/cm2 pair is off: a softer system
        3: _header(1500.0, 50.0, 1.998124, 4.552408, 1.421442, 19.909792),   # a kink where the second pair joins
    }
)  # fmt: skip
"""Mass and charge pressure as published; the geometry is illustrative, such that criterion 2 gives these pressures."""


@final
@dataclass(frozen=True)
class Way:
    """How hang-up is looked at: the gas law while the line is charged, the exponent of a fast movement after it

    (None: by the same law), and the atmosphere [Pa] (None: the machine's).
    """

    title: str
    gas: Gas = isothermal
    exponent: float | None = None
    atmosphere: float | None = None


SLOW = Way(noted("slow"))
FAST = Way(noted("fast from the settled charge, n = 1.4"), exponent=1.4)
PAPER = Way(noted("slow, gas law on gauge pressures (the paper's way)"), atmosphere=0.0)
NORMAL = Way(noted("slow, gas law on gauge + 101325 Pa"), atmosphere=101325.0)
CHARGED_FAST = Way(noted("adiabatic from the gas charge on, n = 1.4"), adiabatic)
WAYS = (SLOW, FAST, PAPER, CHARGED_FAST)
"""The ways a limit is looked at. The paper's is slow without the atmosphere; adiabatic from the gas charge on is a bound of it."""


def charge_for(motion: Motion, wanted: float) -> float:
    """Return the charge pressure at the horizon for a reaction of all shoes [N], without friction. (35)

    DefinitionError where it is below zero: so much reaction the weights do not give.
    """
    require_number("wanted", wanted, "one reaction of all shoes is expected, in N")
    ensure(not wanted < 0.0, f"A reaction of {show(wanted, 'kgf', 4)} would pull at the ground; ask for zero or more.")
    balance = HeaderState(at_horizon(motion))
    pressure = float(balance.cylinder.sized(balance.motion).pressure_for(balance.thrust_without_line(pressed=wanted))[0])
    if pressure < 0.0:
        alone, for_one = (float(balance.thrust_without_line(pressed=force)[0]) for force in (0.0, 1.0))
        most = alone / (alone - for_one)
        raise DefinitionError(f"A reaction of {show(wanted, 'kgf', 4)} is above the weights', {show(most, 'kgf', 4)}; ask for less.")
    return pressure


def largest_charge(motion: Motion, way: Way = SLOW) -> float:
    """Return the largest charge pressure at the horizon at which the shoe, moving down, never lifts off over the following range.

    DefinitionError where none will do: the header is lighter than the accumulators hold at their own gas charge.
    """
    require_motion(motion)
    judge = Judge(motion.plan, motion.designs, [over_following(motion, 2)])
    return float(judge.answer(least(lambda at: charge_limits(at, way))).value)


def charge_limits(motion: Motion, way: Way) -> FloatArray:
    """Return the charge pressure [Pa] at which the shoe just carries nothing at each pose, moving down, shape (n,)."""
    balance = HeaderState(motion)
    block, left = balance.circuit.accumulators(motion), balance.circuit.withdrawn(motion)
    block = replace(block, gas=way.gas, atmosphere=block.atmosphere if way.atmosphere is None else way.atmosphere)
    allowed = balance.required_while("retracting")
    lowest = float(np.min(block.lowest_charge))
    light = (allowed < lowest) & (left <= 0.0)
    if np.any(light):  # the accumulators hold more than the weights need: the shoe hangs at every charge
        where = int(np.argmax(light))
        raise DefinitionError(
            f"The header is too light for these accumulators: at h = {motion.strokes['h'][where] / mm:.1f} mm the shoe lifts off from "
            f"{allowed[where] / kgf_cm2:.2f} kgf/cm2 on, and the lowest gas charge is {lowest / kgf_cm2:.2f} kgf/cm2. Lower the gas charge."
        )
    held = np.maximum(allowed, lowest)
    slow = np.where(allowed < lowest, block.pressure_holding(np.maximum(left, 0.0)), block.pressure(held, -left))
    if way.exponent is None:
        return np.asarray(slow)

    def falls_short(charges: FloatArray) -> Mask:
        return np.asarray((block.fast_pressure(charges.T, left, way.exponent) <= allowed).T)

    last, beyond = last_holding(falls_short, np.full_like(slow, lowest), 4.0 * slow, close=1e-6)
    return 0.5 * (last + beyond)
