"""The three headers on one linkage, side by side: all are evaluated at once, over the same heights of the shoe."""

from __future__ import annotations

from typing import Any

import numpy as np

from hydraulics import Accumulator, AccumulatorBlock, Cylinder, FloatCircuit, isothermal
from linkage import Crank, Dimension, Featured, Ground, LoadCase, Mechanism, OnLink, Stroke, Weight, distance, y
from linkage.quantities import Quantity
from linkage.units import deg, kg, kgf_cm2, litre, mm

from .criteria import HEADERS


def towards_shoe(height: Any, O_y: Any, L_OR: float) -> Quantity:
    """Return the direction O -> R [rad] in which the shoe stands at a height [m], R to the right of O. (4)-(16)"""
    drop = height - O_y
    found: Quantity = np.arctan2(drop, np.sqrt(L_OR * L_OR - drop * drop))
    return found


def block() -> AccumulatorBlock:
    """Return the block of one header: each line has its own."""
    return AccumulatorBlock([Accumulator(4 * litre, 50 * kgf_cm2), Accumulator(4 * litre, 25 * kgf_cm2)], isothermal, 101325.0)


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

    R1 = Crank(O, OR1=HEADERS[1]["L_OR"], angle=towards_shoe(height, y(O), HEADERS[1]["L_OR"]))
    B1 = OnLink(O, R1, OB1=L_OB, R1OB1=shift - HEADERS[1]["BOR"])
    F1 = OnLink(O, R1, OF1=0.488774, R1OF1=5.491118 * deg - HEADERS[1]["BOR"])  # the feeder's centre of gravity
    H1 = OnLink(O, R1, OH1=HEADERS[1]["OG2"], R1OH1=HEADERS[1]["BOG2"] - HEADERS[1]["BOR"])  # the header's
    feeder1, header1 = Weight(F1, mass=1500 * kg), Weight(H1, mass=HEADERS[1]["m2"])
    lift1 = Cylinder(A, B1, bore=bore, rod=rod, count=2)
    line1 = FloatCircuit(lift1, block(), charge_pressure=charge1, at=0.0, seal_friction=seals)
    first = LoadCase(only=["feeder1", "header1", "line1"])
    length1 = distance(A, B1)

    R2 = Crank(O, OR2=HEADERS[2]["L_OR"], angle=towards_shoe(height, y(O), HEADERS[2]["L_OR"]))
    B2 = OnLink(O, R2, OB2=L_OB, R2OB2=shift - HEADERS[2]["BOR"])
    F2 = OnLink(O, R2, OF2=0.488774, R2OF2=5.491118 * deg - HEADERS[2]["BOR"])
    H2 = OnLink(O, R2, OH2=HEADERS[2]["OG2"], R2OH2=HEADERS[2]["BOG2"] - HEADERS[2]["BOR"])
    feeder2, header2 = Weight(F2, mass=1500 * kg), Weight(H2, mass=HEADERS[2]["m2"])
    lift2 = Cylinder(A, B2, bore=bore, rod=rod, count=2)
    line2 = FloatCircuit(lift2, block(), charge_pressure=charge2, at=0.0, seal_friction=seals)
    second = LoadCase(only=["feeder2", "header2", "line2"])
    length2 = distance(A, B2)

    R3 = Crank(O, OR3=HEADERS[3]["L_OR"], angle=towards_shoe(height, y(O), HEADERS[3]["L_OR"]))
    B3 = OnLink(O, R3, OB3=L_OB, R3OB3=shift - HEADERS[3]["BOR"])
    F3 = OnLink(O, R3, OF3=0.488774, R3OF3=5.491118 * deg - HEADERS[3]["BOR"])
    H3 = OnLink(O, R3, OH3=HEADERS[3]["OG2"], R3OH3=HEADERS[3]["BOG2"] - HEADERS[3]["BOR"])
    feeder3, header3 = Weight(F3, mass=1500 * kg), Weight(H3, mass=HEADERS[3]["m2"])
    lift3 = Cylinder(A, B3, bore=bore, rod=rod, count=2)
    line3 = FloatCircuit(lift3, block(), charge_pressure=charge3, at=0.0, seal_friction=seals)
    third = LoadCase(only=["feeder3", "header3", "line3"])
    length3 = distance(A, B3)

    about = Featured("drive force", ["R1", "R2", "R3"])
