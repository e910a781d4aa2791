"""The charge pressure of the line, and the paper's five criteria, the relief valve and its conclusions, as verdicts of one design.

The line is charged as published, for a reaction, and at the most; all over the following range. Pressures gauge [Pa].
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from types import MappingProxyType

import numpy as np

from hydraulics import CylinderSize, Gas, adiabatic, isothermal, standard_bores
from linkage import DefinitionError, Motion, Verdict, least
from linkage.errors import ensure
from linkage.frozen import record
from linkage.language import noted, said, translated, with_and
from linkage.motion import Judge, MotionFunction, below_zero, last_holding, require_motion
from linkage.motion.grid import recalled
from linkage.plan import Mask
from linkage.program import FloatArray
from linkage.units import deg, kgf_cm2, mm, require_number, show, shown_number, unit_sign

from .following import PLAIN, HeaderState, at_horizon, height_at, kgf_cm2_text, over_following, relief

HEADERS: Mapping[int, Mapping[str, float]] = MappingProxyType({
    number: MappingProxyType({"m2": mass, "charge": charge * kgf_cm2, "L_OR": L_OR, "BOR": BOR * deg, "OG2": OG2, "BOG2": BOG2 * deg})
    for number, (mass, charge, L_OR, BOR, OG2, BOG2) in {
        1: (2000.0, 94.0, 2.665521, 13.055247, 2.137161, 28.184398),  # both gas charges at work
        2: (1000.0, 34.0, 2.040833, 5.290081, 1.436851, 18.840343),   # the 50 kgf/cm2 pair is off: a softer system
        3: (1500.0, 50.0, 1.998124, 4.552408, 1.421442, 19.909792),   # a kink where the second pair joins
    }.items()
})  # fmt: skip
"""Mass and charge pressure as published; the geometry is illustrative, such that criterion 2 gives these pressures."""


@record
class Way:
    """How hang-up is looked at.

    Parameters
    ----------
    title : str
        How it is called.
    gas : Gas, optional
        The gas law while the line is charged, isothermal by default.
    exponent : float, optional
        The exponent of a fast movement after it; by default the same law.
    atmosphere : float, optional
        The air's pressure [Pa]; by default the machine's.
    """

    title: str
    gas: Gas = isothermal
    exponent: float | None = None
    atmosphere: float | None = None

    def charge_limits(self, motion: Motion) -> FloatArray:
        """Return the charge pressure [Pa] at which the shoe just carries nothing at each pose, moving down, shape (n,).

        Parameters
        ----------
        motion : Motion
            The poses.

        Returns
        -------
        array (n,)
            The charge pressure.
        """
        balance = HeaderState(motion)
        block, left = balance.circuit.accumulators(motion), balance.circuit.withdrawn(motion)
        block = replace(block, gas=self.gas, atmosphere=block.atmosphere if self.atmosphere is None else self.atmosphere)
        allowed = balance.required_while("retracting")
        lowest = float(np.min(block.lowest_charge))
        light = (allowed < lowest) & (left <= 0.0)
        if np.any(light):  # the accumulators hold more than the weights need: the shoe hangs at every charge
            where = int(np.argmax(light))
            raise DefinitionError(
                f"The header is too light for these accumulators: at h = {motion.strokes['h'][where] / mm:.1f} mm the shoe lifts off from "
                f"{allowed[where] / kgf_cm2:.2f} kgf/cm2 on, and the lowest gas charge is {lowest / kgf_cm2:.2f} kgf/cm2. "
                "Lower the gas charge."
            )
        held = np.maximum(allowed, lowest)
        slow = np.where(allowed < lowest, block.pressure_holding(np.maximum(left, 0.0)), block.pressure(held, -left))
        if self.exponent is None:
            return np.asarray(slow)

        def falls_short(charges: FloatArray) -> Mask:
            return np.asarray((block.fast_pressure(charges.T, left, self.exponent) <= allowed).T)

        last, beyond = last_holding(falls_short, np.full_like(slow, lowest), 4.0 * slow, close=1e-6)
        return 0.5 * (last + beyond)


SLOW = Way(noted("slow"))
FAST = Way(noted("fast from the settled charge, n = 1.4"), exponent=1.4)
PAPER = Way(noted("slow, gas law on gauge pressures (the paper's way)"), atmosphere=0.0)
NORMAL = Way(noted("slow, gas law on gauge + 101325 Pa"), atmosphere=101325.0)
CHARGED_FAST = Way(noted("adiabatic from the gas charge on, n = 1.4"), adiabatic)
WAYS = (SLOW, FAST, PAPER, CHARGED_FAST)
"""The ways a limit is looked at. The paper's is slow without the atmosphere; adiabatic from the gas charge on is a bound of it."""


def charge_for(motion: Motion, wanted: float) -> float:
    """Return the charge pressure at the horizon for a reaction of all shoes, without friction (35).

    Parameters
    ----------
    motion : Motion
        The poses.
    wanted : float
        The reaction [N].

    Returns
    -------
    float
        The pressure [Pa].

    Raises
    ------
    DefinitionError
        The pressure is below zero: so much reaction the weights do not give.
    """
    require_number("wanted", wanted, "one reaction of all shoes is expected, in N", kind="force")
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

    Parameters
    ----------
    motion : Motion
        The poses.
    way : Way, optional
        How hang-up is looked at, slowly by default.

    Returns
    -------
    float
        The pressure [Pa].

    Raises
    ------
    DefinitionError
        None will do: the header is lighter than the accumulators hold at their own gas charge.
    """
    require_motion(motion)
    judge = Judge(motion.plan, motion.designs, [over_following(motion, 2)])
    return float(judge.answer(least(MotionFunction(way.charge_limits))).value)


# -- the criteria ----------------------------------------------------------------------------------------------

ON_LIMIT = 0.02 * kgf_cm2
"""A setting this near to its limit is on it: the published ones are."""

PIN_SHARE = 0.1
"""Share of the pin at O in the hysteresis from which on a rolling bearing is worth its price."""

LEAST_RESERVE = 0.1
"""Least reserve of the pump's pressure over the required one."""


def criteria(motion: Motion) -> list[Verdict]:
    """Return the verdicts on the five criteria and on the relief valve, and the paper's conclusions; the motion says which design.

    Parameters
    ----------
    motion : Motion
        The poses.

    Returns
    -------
    list of Verdict
        The verdicts.
    """
    balance = recalled(motion, ("following", motion.unreachable), lambda: HeaderState(over_following(motion)))
    ways = SLOW, FAST, PAPER if motion.inputs["atmosphere"] else NORMAL  # slow with the gas law the other way, too
    following = [rises(balance), *(hang_up(balance.motion, way) for way in ways)]
    judged = [*following, hysteresis(balance), matching(balance), reserve(balance), valve(motion)]
    return [*judged, vessels(balance), exchange(motion)]


def rises(balance: HeaderState) -> Verdict:
    """Return criterion 1: the reaction rises when moving up and falls when moving down, over the whole range."""
    up, down = balance.up, balance.down
    says = said(
        "moving up the reaction goes from {up_first} to {up_last}, moving down from {down_first} to {down_last}",
        up_first=_kgf(up[0]), up_last=_kgf(up[-1]), down_first=_kgf(down[-1]), down_last=show(float(down[0]), "kgf", "z.0f"),
    )  # fmt: skip
    wrong = [(way, curve) for way, curve in ((said("up"), up), (said("down"), down)) if np.any(np.diff(curve) <= 0.0)]
    if not wrong:
        return Verdict("1 reaction follows", True, said("{says}, without a turn.", says=says))
    at = float(balance.height[int(np.argmax(np.diff(wrong[0][1]) <= 0.0))])
    text = said(
        "{says}, but turns at R_y = {at} moving {ways}: smaller accumulators stiffen the line.",
        says=says, at=show(at, "mm", "+.0f"), ways=with_and(way for way, _ in wrong),
    )  # fmt: skip
    return Verdict("1 reaction follows", False, text)


def hang_up(motion: Motion, way: Way) -> Verdict:
    """Return whether the shoe, moving down, carries something over the whole range in one way of looking at it."""
    rule, charge = f"2 no hang-up, {way.title}", float(motion.inputs["charge"])
    named = said("2 no hang-up, {way}", way=translated(way.title))
    try:
        limit = largest_charge(motion, way)
    except DefinitionError as error:
        return Verdict(rule, False, str(error), named)
    says = said("charged to {charge}, at most {limit}", charge=kgf_cm2_text(charge), limit=kgf_cm2_text(limit))
    if abs(charge - limit) <= ON_LIMIT:
        return Verdict(rule, True, said("{says}: on the limit.", says=says), named)
    apart = kgf_cm2_text(abs(limit - charge))
    if charge < limit:
        return Verdict(rule, True, said("{says}: {apart} below it.", says=says, apart=apart), named)
    text = said("{says}: the shoe lifts off moving down; lower the charge by {apart}.", says=says, apart=apart)
    return Verdict(rule, False, text, named)


def hysteresis(balance: HeaderState) -> Verdict:
    """Return criterion 3: the hysteresis and its parts; a plain bearing at O beside the machine's own."""
    whole, seals, pin = balance.hysteresis, balance.of_seals, balance.of_pin
    plain, rolling = balance.of_bearings
    share = float(np.max(pin / whole))
    ok = share <= PIN_SHARE
    sign = unit_sign("kgf")
    added = f", {with_and(balance.others)} {_span(balance.of_others)}" if balance.others else ""
    says = said(
        "{whole}, of it seals {seals}, pin O {pin}{others}; a plain bearing at O (mu = {mu:g}) gives {plain}, x{least:.2f} to x{most:.2f} "
        "of a rolling one's",
        whole=f"{_span(whole)} {sign}", seals=_span(seals), pin=_span(pin), others=f"{added} {sign}", mu=PLAIN,
        plain=f"{_span(plain)} {sign}", least=np.min(plain / rolling), most=np.max(plain / rolling),
    )  # fmt: skip
    remedy = said("; the pin makes up to {share:.0f} % of it: take a rolling bearing at O", share=100 * share)
    return Verdict("3 hysteresis", ok, f"{says}{'' if ok else remedy}.")


def matching(balance: HeaderState) -> Verdict:
    """Return criterion 4: from the lowest place to the highest the required pressure falls with the accumulators' (the arm H grows).

    What would match them: the arm with which this line keeps the reaction as it is at the horizon.
    """
    arm, needed, line, free = balance.arm, balance.required, balance.pressure, balance.free
    ok = bool(needed[-1] < needed[0])
    says = said(
        "moving up the block's pressure goes from {line[0]} to {line[1]}, the required one from {needed[0]} to {needed[1]} {pressure}, "
        "the arm H from {arm[0]} to {arm[1]} {length}; without friction the reaction goes from {free[0]} to {free[1]} {force}",
        line=_ends(line, "kgf/cm2", ".1f"), needed=_ends(needed, "kgf/cm2", ".1f"), pressure=unit_sign("kgf/cm2"),
        arm=_ends(arm, "mm", ".0f"), length=unit_sign("mm"), free=_ends(free, "kgf", "z.0f"), force=unit_sign("kgf"),
    )  # fmt: skip
    constant = float(np.interp(0.0, balance.height, free))
    with np.errstate(divide="ignore", invalid="ignore"):
        wanted = arm * balance.thrust_without_line(pressed=constant) / balance.cylinder.sized(balance.motion).thrust(line)
    if not np.all(np.isfinite(wanted)):
        empty = said("; the line is empty at some heights, no arm matches it there: charge it higher.")
        return Verdict("4 matching", ok, f"{says}{empty}")
    low, high = _ends(wanted, "mm", ".0f")
    even = {"low": low, "high": f"{high} {unit_sign('mm')}", "force": show(constant, "kgf", "z.0f")}
    if ok:
        text = said("{says}: matched; with this line an arm from {low} to {high} would keep it at {force}.", says=says, **even)
        return Verdict("4 matching", True, text)
    text = said(
        "{says}: not matched, they part. An arm from {low} to {high} would keep it at {force}: place A and B so that the arm grows "
        "while the header rises; larger accumulators help less, their pressure still falls.",
        says=says, **even,
    )  # fmt: skip
    return Verdict("4 matching", False, text)


def reserve(balance: HeaderState) -> Verdict:
    """Return criterion 5: the required pressure as high as the pump permits with the least reserve."""
    motion = balance.motion
    worst, pump = float(relief(motion).value), float(motion.inputs["pump"])
    spare, ok = pump / worst - 1.0, pump >= (1.0 + LEAST_RESERVE) * worst
    seals = float(motion.inputs["seals"] / np.mean(balance.required))
    says = said(
        "lifting takes up to {worst}, the pump gives {pump}: reserve {spare:.0f} %, at least {least:.0f} %; the seals take {seals:.1f} % "
        "of the required pressure",
        worst=kgf_cm2_text(worst, 1), pump=kgf_cm2_text(pump, 1), spare=100 * spare, least=100 * LEAST_RESERVE, seals=100 * seals,
    )  # fmt: skip
    size, beside = balance.cylinder.sized(motion), said("; take a larger bore or a stronger pump")
    own, rod = size.single
    smaller = [CylinderSize(bore, rod, size.count, size.works) for bore in standard_bores() if rod < bore < own]
    fits = [float(each.bore) for each in smaller if (1.0 + LEAST_RESERVE) * worst * size.area / each.area <= pump]
    if ok and fits:
        beside = said(
            "; for this header alone a bore of {bore} would do, with {share:.0f} % of the seals' hysteresis",
            bore=show(min(fits), "mm", 4), share=100.0 * min(fits) ** 2 / own**2,
        )  # fmt: skip
    elif ok:
        beside = said("; no smaller standard bore keeps the reserve, so it is as high as permitted")
    return Verdict("5 pressure level", ok, f"{says}{beside}.")


def valve(motion: Motion) -> Verdict:
    """Return whether the relief valve stays shut up to transport height."""
    found, opens = relief(motion), float(motion.inputs["valve"])
    says = said(
        "lifting to transport height takes up to {pressure}, at h = {at}; the valve opens at {valve}",
        pressure=kgf_cm2_text(found.value, 1), at=show(found.strokes["h"], "mm", ".0f"), valve=kgf_cm2_text(opens, 1),
    )  # fmt: skip
    margin = opens - float(found.value)
    apart = kgf_cm2_text(abs(margin), 1)
    if margin > 0.0:
        return Verdict("relief valve", True, said("{says}: margin {apart}.", says=says, apart=apart))
    return Verdict("relief valve", False, said("{says}: {apart} too low; set it higher or take a larger bore.", says=says, apart=apart))


def vessels(balance: HeaderState) -> Verdict:
    """Return which accumulators are at work over which heights, which are off, and where a pair joins, in a slow movement."""
    motion = balance.motion
    block, charge = balance.circuit.accumulators(motion), float(np.max(balance.circuit.number(motion, "charge_pressure")))

    def slow(at: Motion) -> FloatArray:
        return np.asarray(block.pressure(charge, balance.circuit.withdrawn(at)))

    line, height = slow(motion), balance.height
    says, slope = [], abs(float((line[-1] - line[0]) / (height[-1] - height[0])))
    softer = said("{pressure} for {way} of the shoe", pressure=show(slope * 10 * mm, "kgf/cm2", ".2f"), way=show(10 * mm, "mm", ".0f"))
    for gas, volume in balance.vessels:
        name = said("the {charge} pair ({volume})", charge=show(gas, "kgf/cm2", 4), volume=show(volume, "l", 4))
        works = below_zero(motion, lambda at, gas=gas: gas - slow(at))  # type: ignore[misc]
        if not works:
            says.append(said("{name} is off over the whole range, which makes the line softer, {softer}", name=name, softer=softer))
        elif works[0].start["h"] <= motion.strokes["h"][0] and works[-1].end["h"] >= motion.strokes["h"][-1]:
            says.append(said("{name} is at work over the whole range", name=name))
        else:
            at = show(height_at(motion, works[-1].end["h"]), "mm", "+z.0f")
            says.append(said("{name} is at work below R_y = {at} and off above: where it joins the curves have a kink", name=name, at=at))
    return Verdict("accumulators", True, said("at {charge} {words}.", charge=kgf_cm2_text(charge), words="; ".join(says)))


def exchange(motion: Motion) -> Verdict:
    """Return the greatest charge of the line for each published header on this linkage: the pressure alone is changed."""
    says, ok = [], True
    for number, header in HEADERS.items():
        own = Motion(motion.plan, {**motion.designs, **header}, motion.strokes, motion.unreachable)
        try:
            charge = largest_charge(own)
        except DefinitionError:
            ok = False
            says.append(said("header {number} ({mass}) none", number=number, mass=show(header["m2"], "kg", ".0f")))
        else:
            ok = ok and charge <= float(motion.inputs["pump"])
            mass, limit = show(header["m2"], "kg", ".0f"), kgf_cm2_text(charge)
            says.append(said("header {number} ({mass}) {charge}", number=number, mass=mass, charge=limit))
    rest = said("not every header can be balanced on this line")
    if ok:
        rest = said("a header is changed by the pressure alone, without touching the linkage")
    return Verdict("change of header", ok, said("at the most, slow: {charges}; {rest}.", charges=", ".join(says), rest=rest))


def _kgf(force: float) -> str:
    return shown_number(float(force), "kgf", "z.0f")


def _ends(values: FloatArray, unit: str, digits: str) -> tuple[str, str]:
    """Return the first and the last of some values as numbers without their unit."""
    return shown_number(float(values[0]), unit, digits), shown_number(float(values[-1]), unit, digits)


def _span(force: FloatArray) -> str:
    low, high = float(np.min(force)), float(np.max(force))
    return _kgf(low) if _kgf(low) == _kgf(high) else said("{low} to {high}", low=_kgf(low), high=_kgf(high))
