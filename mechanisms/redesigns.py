"""Three shipped machines with better pins: the arguments of `optimise` for each, and its results, on drawing dimensions."""

from __future__ import annotations

from collections.abc import Mapping
from math import pi
from types import MappingProxyType
from typing import Any

from hydraulics import capacity, reserve
from linkage import Acting, Ground, LoadCase, OnLink, around, at, deg, drive_force, gap, kgf_cm2, least, mm, most, ratio, ref, x, y
from linkage.loads import FRICTIONLESS
from linkage.motion.measures import Condition, Measure

from .header_balancer import HEADERS, HeaderBalancer, ThreeHeaders, with_header
from .mower_lift import BELOW, DELFI, MowerLift
from .three_point_hitch import ThreePointHitch

PINS = 60 * mm
"""How far a pin may move, and by how much a length may change."""
CLEAR = 20 * mm
"""How far apart bodies stay that would meet in one plane."""


# The mower's lift: more reserve at the same pressure.


class MarkedMowerLift(MowerLift):
    """The mower's lift with the places its pins A, O and B (this one on the section) have today, A0, O0 and B0."""

    A0, O0 = Ground(0.0, 0.242), Ground(0.652, 0.330)
    B0 = OnLink("O", "G", OB0=0.175, GOB0=-(DELFI + BELOW))


def strong_lift() -> dict[str, Any]:
    """Return the search for the greatest least reserve kz: pins A, O, B within 60 mm, ends of G kept to 30 mm, the section as it is."""
    lift = MarkedMowerLift()
    ends = {S: float(lift.at(S=S).y("G")) for S in (0.55, 0.80)}
    heights = [each for S, now in ends.items() for each in within(at(y("G"), S=S), now, 30 * mm)]
    moved = [at((x(pin) - x(f"{pin}0")) ** 2 + (y(pin) - y(f"{pin}0")) ** 2, S=0.55) <= PINS**2 for pin in "AOB"]
    vary = {"A": around(PINS), "O": around(PINS), "OB": around(PINS), "BOG": around(20 * deg)}
    return {"machine": lift, "maximise": least(reserve("lift")), "vary": vary, "subject_to": [*heights, *moved]}


def within(measure: Measure, now: float, by: float) -> list[Condition]:
    """Return the two conditions that keep a measure within a distance of its present value."""
    return [measure >= now - by, measure <= now + by]


# The hitch: the same load lifted at every height.


def flat_hitch() -> dict[str, Any]:
    """Return the search for the flattest capacity: pins and lengths within 60 mm, no less reserve, G's ends and travel kept to 50 mm.

    The implement leans at both ends as it does today, to 3 deg, and the cylinder AB stays 20 mm clear of the lift rod CD.
    """
    hitch = ThreePointHitch()
    lifted = capacity("lift", "G", case=LoadCase("alone", scale={"load": 0.0}))
    ends = hitch.at(S=[0.0, 0.25])
    conditions: list[Condition] = [least(reserve("lift")) >= float(hitch.sweep(101)[reserve("lift")].min())]
    low, high = (at(y("G"), S=S) for S in (0.0, 0.25))
    rise = float(ends.y("G")[1] - ends.y("G")[0])
    conditions += within(high - low, rise, 50 * mm)
    for S, height, tilt in zip((0.0, 0.25), ends.y("G"), ends["tilt"], strict=True):
        conditions += within(at(y("G"), S=S), float(height), 50 * mm) + within(at("tilt", S=S), float(tilt), 3 * deg)
    conditions.append(least(gap("AB", "CD")) >= CLEAR)
    vary = {name: around(PINS) for name in ("A", "O", "E", "M", "OB", "OC", "BC", "ED", "CD", "EF", "MK")}
    return {"machine": hitch, "minimise": most(lifted) / least(lifted), "vary": vary, "subject_to": conditions}


# The header's balancer: a steady reaction, with all three headers.

HEADER_CASES = ("first", "second", "third")
TOPS = (1.2745, 0.9455, 0.9220)
"""How high the shoes come today when the cylinders are out, with each header [m]."""
RISE = 2000.0
"""By how much the reaction should rise with the shoe [N/m]: some 60 kgf over 300 mm."""
LEAST_RISE = 100.0
"""By how much it rises over the lowest 50 mm at the least [N/m]."""
SEALED = 3 * kgf_cm2 * 2 * pi / 4 * (63 * mm) ** 2
"""What the seals take of both cylinders' force [N]."""
MOST_PRESSURE = 160 * kgf_cm2 / 1.1 - 3 * kgf_cm2
"""What may be needed without the seals' part: the pump keeps a tenth."""


def steady_reaction() -> dict[str, Any]:
    """Return the search for a reaction that rises by a straight line, over all headers: pins A and B, and the charges.

    Without friction, the shoes never lift off, press no more at the horizon than today, and come as high as today with the same cylinders;
    the pin B stays 200 mm above the ground.
    """
    machine = ThreeHeaders()
    conditions: list[Condition] = []
    spreads = []
    for number, (case, top) in enumerate(zip(HEADER_CASES, TOPS, strict=True), 1):
        free, length = drive_force("height", acting=Acting(case=case, direction=FRICTIONLESS)), f"length{number}"
        held = LoadCase(f"alone {number}", only=[f"feeder{number}", f"header{number}"])
        alone = drive_force("height", acting=Acting(case=held, direction=FRICTIONLESS))
        swaying, rising = (free - slope * ref("height") for slope in (RISE, LEAST_RISE))
        spreads.append(most(swaying) - least(swaying))
        conditions += [
            least(free - SEALED * ratio(length)) >= 0.0,
            at(rising, height=-100 * mm) >= at(rising, height=-150 * mm),
            at(free, height=0.0) <= float(machine.at(height=0.0)[free]),
            at(y(f"B{number}"), height=-150 * mm) >= 200 * mm,
            at(length, height=-150 * mm) >= 700 * mm,
            at(length, height=top) <= 1150 * mm,
        ]
        if number == 1:
            conditions.append(most(alone / ratio(length)) <= MOST_PRESSURE * 2 * pi / 4 * (63 * mm) ** 2)
    charges = {f"charge{number}": (27 * kgf_cm2, 160 * kgf_cm2) for number in (1, 2, 3)}
    vary = {"A": around(400 * mm), "L_OB": (0.5, 1.5), "shift": around(40 * deg)} | charges
    return {"machine": machine, "minimise": spreads[0] + spreads[1] + spreads[2], "vary": vary, "subject_to": conditions}


# What was found, on whole millimetres and tenths of a degree.

STRONG_LIFT: Mapping[str, Any] = MappingProxyType({"A": (0.024, 0.295), "O": (0.652, 0.390), "OB": 0.204, "BOG": 96.8 * deg})
FLAT_HITCH: Mapping[str, Any] = MappingProxyType(
    {
        "A": (0.260, 0.522), "O": (0.286, 1.090), "E": (0.277, 0.540), "M": (0.160, 1.056),
        "OB": 0.309, "OC": 0.420, "BC": 0.219, "ED": 0.471, "CD": 0.679, "EF": 0.901, "MK": 0.940,
    }
)  # fmt: skip
STEADY_REACTION: Mapping[str, Any] = MappingProxyType(
    {
        "A": (0.342, 0.457), "L_OB": 1.332, "shift": 7.9 * deg,
        "charge1": 119 * kgf_cm2, "charge2": 42 * kgf_cm2, "charge3": 68 * kgf_cm2,
    }
)  # fmt: skip
"""The pins as they were found; the charges then set again header by header, on whole kgf/cm2, so that no fast movement lifts a shoe off."""


def steady_balancer(number: int) -> HeaderBalancer:
    """Return the balancer with header 1, 2 or 3 on the pins and at the charge that were found."""
    found = STEADY_REACTION
    turned = {"BOR": HEADERS[number]["BOR"], "BOG2": HEADERS[number]["BOG2"], "BOG1": float(HeaderBalancer()["BOG1"])}
    moved = {name: value - found["shift"] for name, value in turned.items()}
    return with_header(number, A=found["A"], L_OB=found["L_OB"], charge=found[f"charge{number}"], **moved)
