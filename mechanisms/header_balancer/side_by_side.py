"""The three headers on one linkage, side by side: all are evaluated at once, over the same heights of the shoe."""

from __future__ import annotations

from typing import Any

import numpy as np

from hydraulics import Accumulator, AccumulatorBlock, Cylinder, FloatCircuit, isothermal
from linkage import Crank, Dimension, Featured, Ground, LoadCase, Mechanism, OnLink, Stroke, Weight, distance, ref, y
from linkage.quantities import Member
from linkage.units import deg, kg, kgf_cm2, litre, mm

from .criteria import HEADERS


def header_members(number: int, case: str) -> dict[str, Member]:
    """Return the members of one header, with its number behind their names, and the load case in which it alone is there."""
    own, gas = HEADERS[number], [Accumulator(4 * litre, 50 * kgf_cm2), Accumulator(4 * litre, 25 * kgf_cm2)]
    R, B, F, H, lift = (f"{name}{number}" for name in ("R", "B", "F", "H", "lift"))
    drop: Any = ref("height") - y("O")
    arm: dict[str, Any] = {f"O{R}": own["L_OR"]}
    towards_shoe = np.arctan2(drop, np.sqrt(own["L_OR"] * own["L_OR"] - drop * drop))  # O -> R, R to the right of O; (4)-(16)
    on_link: dict[str, tuple[Any, Any]] = {  # the pin, and the centres of gravity of feeder and header: from O, and turned from OR
        B: ("L_OB", ref("shift") - own["BOR"]),
        F: (0.488774, 5.491118 * deg - own["BOR"]),
        H: (own["OG2"], own["BOG2"] - own["BOR"]),
    }
    return {
        R: Crank("O", angle=towards_shoe, **arm),
        **{name: OnLink("O", R, **{f"O{name}": far, f"{R}O{name}": turned}) for name, (far, turned) in on_link.items()},
        f"feeder{number}": Weight(F, mass=1500 * kg),
        f"header{number}": Weight(H, mass=own["m2"]),
        lift: Cylinder("A", B, bore="bore", rod="rod", count=2),
        f"line{number}": FloatCircuit(
            lift, AccumulatorBlock(gas, isothermal, 101325.0), charge_pressure=f"charge{number}", at=0.0, seal_friction="seals"
        ),
        case: LoadCase(only=[f"feeder{number}", f"header{number}", f"line{number}"]),
        f"length{number}": distance("A", B),
    }


class ThreeHeaders(Mechanism):
    """Feeder housing and header as in HeaderBalancer, three of them on the same pins, driven by the height of the shoes above the horizon.

    The drive's force of `height` is the shoes' reaction, without friction: `drive_force(case="first")` that with header 1 [N], all shoes.
    `shift` turns the pin B about O, on the feeder housing: HeaderBalancer's angles at B, such as BOR, are less by it. Each line is charged
    with its shoe on the horizon.
    """

    height = Stroke(-150 * mm, 150 * mm)  # of the shoes

    O = Ground(0.0, 1.05)
    A = Ground(-0.05, 0.30)
    L_OB = Dimension(0.930054, unit="mm")
    shift = Dimension(0.0, unit="deg")
    seals = Dimension(3 * kgf_cm2, unit="kgf/cm2")
    charge1 = Dimension(HEADERS[1]["charge"], unit="kgf/cm2")
    charge2 = Dimension(HEADERS[2]["charge"], unit="kgf/cm2")
    charge3 = Dimension(HEADERS[3]["charge"], unit="kgf/cm2")
    bore, rod = Dimension(63 * mm, unit="mm"), Dimension(40 * mm, unit="mm")

    locals().update(header_members(1, "first") | header_members(2, "second") | header_members(3, "third"))

    about = Featured("drive force", ["R1", "R2", "R3"])
