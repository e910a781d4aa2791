"""The paper's five criteria, the relief valve, and its conclusions, as verdicts over the following range of one design."""

from __future__ import annotations

import numpy as np

from hydraulics import CylinderSize, standard_bores
from hydraulics.member import one_size
from linkage import DefinitionError, Motion
from linkage.motion import below_zero
from linkage.program import FloatArray
from linkage.units import kgf, kgf_cm2, litre, mm
from linkage.verdict import Verdict

from .charge import FAST, HEADERS, NORMAL, PAPER, SLOW, Way, largest_charge
from .following import PLAIN, HeaderState, kgf_cm2_text, over_following, relief

ON_LIMIT = 0.02 * kgf_cm2
"""A setting this near to its limit is on it: the published ones are."""

PIN_SHARE = 0.1
"""Share of the pin at O in the hysteresis from which on a rolling bearing is worth its price."""

LEAST_RESERVE = 0.1
"""Least reserve of the pump's pressure over the required one."""


def criteria(motion: Motion) -> list[Verdict]:
    """Return the verdicts on the five criteria and on the relief valve, and the paper's conclusions; the motion says which design."""
    fine = over_following(motion)
    balance = HeaderState(fine)
    judged = [rises(balance), *hangs_up(fine), hysteresis(balance), matching(balance), reserve(balance), valve(motion)]
    return [*judged, vessels(balance), exchange(motion)]


def rises(balance: HeaderState) -> Verdict:
    """Return criterion 1: the reaction rises when moving up and falls when moving down, over the whole range."""
    up, down = balance.up, balance.down
    says = f"moving up the reaction goes from {_kgf(up[0])} to {_kgf(up[-1])}, moving down from {_kgf(down[-1])} to {_kgf(down[0])} kgf"
    wrong = [way for way, curve in (("up", up), ("down", down)) if np.any(np.diff(curve) <= 0.0)]
    if not wrong:
        return Verdict("1 reaction follows", True, f"{says}, without a turn.")
    curve = up if wrong[0] == "up" else down
    at = balance.height[int(np.argmax(np.diff(curve) <= 0.0))]
    turns = f"but turns at R_y = {at / mm:+.0f} mm moving {' and '.join(wrong)}: smaller accumulators stiffen the line"
    return Verdict("1 reaction follows", False, f"{says}, {turns}.")


def hangs_up(motion: Motion) -> list[Verdict]:
    """Return criterion 2: no hang-up, slow and fast, and slow with the gas law the other way: without or with the atmosphere."""
    other = PAPER if motion.inputs["atmosphere"] else NORMAL
    return [hang_up(motion, way) for way in (SLOW, FAST, other)]


def hang_up(motion: Motion, way: Way) -> Verdict:
    """Return whether the shoe, moving down, carries something over the whole range in one way of looking at it."""
    rule, charge = f"2 no hang-up, {way.title}", float(motion.inputs["charge"])
    try:
        limit = largest_charge(motion, way)
    except DefinitionError as error:
        return Verdict(rule, False, str(error))
    says = f"charged to {kgf_cm2_text(charge)}, at most {kgf_cm2_text(limit)}"
    if abs(charge - limit) <= ON_LIMIT:
        return Verdict(rule, True, f"{says}: on the limit.")
    if charge < limit:
        return Verdict(rule, True, f"{says}: {kgf_cm2_text(limit - charge)} below it.")
    return Verdict(rule, False, f"{says}: the shoe lifts off moving down; lower the charge by {kgf_cm2_text(charge - limit)}.")


def hysteresis(balance: HeaderState) -> Verdict:
    """Return criterion 3: what the hysteresis is and who makes it; a plain bearing at O beside the machine's own."""
    whole, seals, pin = balance.hysteresis, balance.of_seals, balance.of_pin
    plain, rolling = balance.of_bearing(PLAIN), balance.of_bearing(0.0)
    share = float(np.max(pin / whole))
    ok = share <= PIN_SHARE
    added = f", {' and '.join(balance.others)} {_span(balance.of_others)}" if balance.others else ""
    says = (
        f"{_span(whole)} kgf, of it seals {_span(seals)}, pin O {_span(pin)}{added} kgf; a plain bearing at O (mu = {PLAIN:g}) "
        f"gives {_span(plain)} kgf, x{np.min(plain / rolling):.2f} to x{np.max(plain / rolling):.2f} of a rolling one's"
    )
    remedy = f"; the pin makes up to {100 * share:.0f} % of it: take a rolling bearing at O"
    return Verdict("3 hysteresis", ok, f"{says}{'' if ok else remedy}.")


def matching(balance: HeaderState) -> Verdict:
    """Return criterion 4: from the lowest place to the highest the required pressure falls with the accumulators' (the arm H grows).

    What would match them: the arm with which this line keeps the reaction as it is at the horizon.
    """
    arm, needed, line, free = balance.arm, balance.required, balance.pressure, balance.free
    ok = bool(needed[-1] < needed[0])
    says = (
        f"moving up the block's pressure goes from {line[0] / kgf_cm2:.1f} to {line[-1] / kgf_cm2:.1f}, the required one from "
        f"{needed[0] / kgf_cm2:.1f} to {needed[-1] / kgf_cm2:.1f} kgf/cm2, the arm H from {arm[0] / mm:.0f} to {arm[-1] / mm:.0f} mm; "
        f"without friction the reaction goes from {_kgf(free[0])} to {_kgf(free[-1])} kgf"
    )
    constant = float(np.interp(0.0, balance.height, free))
    with np.errstate(divide="ignore", invalid="ignore"):
        wanted = arm * balance.thrust_without_line(pressed=constant) / balance.cylinder.sized(balance.motion).thrust(line)
    if not np.all(np.isfinite(wanted)):
        return Verdict("4 matching", ok, f"{says}; the line is empty at some heights, no arm matches it there: charge it higher.")
    if ok:
        even = f"with this line an arm from {wanted[0] / mm:.0f} to {wanted[-1] / mm:.0f} mm would keep it at {_kgf(constant)} kgf"
        return Verdict("4 matching", True, f"{says}: matched; {even}.")
    return Verdict(
        "4 matching", False,
        f"{says}: not matched, they part. An arm from {wanted[0] / mm:.0f} to {wanted[-1] / mm:.0f} mm would keep it at "
        f"{_kgf(constant)} kgf: place A and B so that the arm grows while the header rises; larger accumulators help less, "
        "their pressure still falls.",
    )  # fmt: skip


def reserve(balance: HeaderState) -> Verdict:
    """Return criterion 5: the required pressure as high as the pump permits with the least reserve."""
    motion = balance.motion
    worst, pump = relief(motion).pressure, float(motion.inputs["pump"])
    spare, ok = pump / worst - 1.0, pump >= (1.0 + LEAST_RESERVE) * worst
    seals = float(motion.inputs["seals"] / np.mean(balance.required))
    says = (
        f"lifting takes up to {kgf_cm2_text(worst, 1)}, the pump gives {kgf_cm2_text(pump, 1)}: reserve {100 * spare:.0f} %, at least "
        f"{100 * LEAST_RESERVE:.0f} %; the seals take {100 * seals:.1f} % of the required pressure"
    )
    return Verdict("5 pressure level", ok, f"{says}{_smaller(balance, worst, pump) if ok else '; take a larger bore or a stronger pump'}.")


def _smaller(balance: HeaderState, worst: float, pump: float) -> str:
    """Return what a smaller standard bore would do for the seals' share, where the pump permits it."""
    size = balance.cylinder.sized(balance.motion)
    now = one_size(size)
    smaller = [CylinderSize(bore, now.rod, size.count, size.works) for bore in standard_bores() if now.rod < bore < now.bore]
    fits = [float(each.bore) for each in smaller if (1.0 + LEAST_RESERVE) * worst * size.area / each.area <= pump]
    if not fits:
        return "; no smaller standard bore keeps the reserve, so it is as high as permitted"
    share = 100.0 * min(fits) ** 2 / now.bore**2
    return f"; for this header alone a bore of {min(fits) / mm:.0f} mm would do, with {share:.0f} % of the seals' hysteresis"


def valve(motion: Motion) -> Verdict:
    """Return whether the relief valve stays shut up to transport height."""
    found = relief(motion)
    says = f"lifting to transport height takes up to {kgf_cm2_text(found.pressure, 1)}, at h = {found.at / mm:.0f} mm; the valve opens at"
    ok = found.margin > 0.0
    apart = kgf_cm2_text(abs(found.margin), 1)
    margin = f"margin {apart}" if ok else f"{apart} too low; set it higher or take a larger bore"
    return Verdict("relief valve", ok, f"{says} {kgf_cm2_text(float(motion.inputs['valve']), 1)}: {margin}.")


def vessels(balance: HeaderState) -> Verdict:
    """Return which accumulators are at work over which heights, which are off, and where a pair joins, in a slow movement."""
    motion = balance.motion
    block, charge = balance.circuit.accumulators(motion), float(np.max(balance.circuit.number(motion, "charge_pressure")))

    def slow(at: Motion) -> FloatArray:
        return np.asarray(block.pressure(charge, balance.circuit.withdrawn(at)))

    line, height = slow(motion), balance.height
    says, slope = [], abs(float((line[-1] - line[0]) / (height[-1] - height[0])))
    softer = f"{slope * 10 * mm / kgf_cm2:.2f} kgf/cm2 for 10 mm of the shoe"
    for each in block.accumulators:
        gas, volume = float(np.max(each.charge)), float(np.max(each.volume))
        if volume <= 0.0:
            continue
        name = f"the {gas / kgf_cm2:.4g} kgf/cm2 pair ({volume / litre:.4g} l)"
        works = below_zero(motion, lambda at, gas=gas: gas - slow(at))  # type: ignore[misc]
        if not works:
            says.append(f"{name} is off over the whole range, which makes the line softer, {softer}")
        elif works[0].start["h"] <= motion.strokes["h"][0] and works[-1].end["h"] >= motion.strokes["h"][-1]:
            says.append(f"{name} is at work over the whole range")
        else:
            at = motion.moved({"h": np.array([works[-1].end["h"]])}).y("R")[0] / mm
            says.append(f"{name} is at work below R_y = {at:+z.0f} mm and off above: where it joins the curves have a kink")
    return Verdict("accumulators", True, f"at {kgf_cm2_text(charge)} {'; '.join(says)}.")


def exchange(motion: Motion) -> Verdict:
    """Return to what the line is charged at the most for each published header on this linkage: it is changed by the pressure alone."""
    says, ok = [], True
    for number, header in HEADERS.items():
        own = Motion(motion.plan, {**motion.designs, **header}, motion.strokes, motion.unreachable)
        try:
            charge = largest_charge(own)
        except DefinitionError:
            ok = False
            says.append(f"header {number} ({header['m2']:.0f} kg) none")
        else:
            ok = ok and charge <= float(motion.inputs["pump"])
            says.append(f"header {number} ({header['m2']:.0f} kg) {kgf_cm2_text(charge)}")
    alone = "a header is changed by the pressure alone, without touching the linkage"
    rest = alone if ok else "not every header can be balanced on this line"
    return Verdict("change of header", ok, f"at the most, slow: {', '.join(says)}; {rest}.")


def _kgf(force: float) -> str:
    return f"{force / kgf:z.0f}"


def _span(force: FloatArray) -> str:
    low, high = float(np.min(force)), float(np.max(force))
    return _kgf(low) if _kgf(low) == _kgf(high) else f"{_kgf(low)} to {_kgf(high)}"
