"""A tipper whose body is lifted at its front by a telescope of four stages. Figures: illustrative."""

from __future__ import annotations

from math import hypot

from hydraulics import LiftCircuit, Telescope
from linkage import RIGHT, Dyad, Featured, Ground, Link, LoadCase, Mechanism, OnLink, Outline, Over, Stroke, Weight, angle
from linkage.units import bar, deg, litre, minute, mm

HEAD = (5.70, 1.15)
"""Where the hoist's upper pin stands on the body that lies flat, from its hinge [m]."""


class HoistTipper(Mechanism):
    """The telescope AB stands between the frame and the headboard of the body OB, which turns about its rear hinge O.

    `tipping` raises the loaded body, also where the ground falls away by 3 deg to the rear.
    """

    S = Stroke(0.0, 4.20)  # m

    O = Ground(0.0, 0.0)
    A = Ground(5.60, -0.35)
    B = Dyad(A, O, AB=1.50 + S, OB=hypot(*HEAD), side=RIGHT)
    G = OnLink(O, B, OG=3.10, BOG=9.4 * deg)
    body = Link(O, B, G)
    tip = angle(O, B)

    load = Weight(G, mass=19e3)
    hoist = Telescope(A, B, bores=[149 * mm, 129 * mm, 110 * mm, 91 * mm], strokes=[1.06, 1.06, 1.06, 1.06], closed=1.48)
    line = LiftCircuit(hoist, pressure=160 * bar, relief=180 * bar, flow=70 * litre / minute, mechanical_efficiency=0.9)

    downhill = LoadCase("downhill", slope=3 * deg)
    tipping = Over(cases=["plain", "downhill"])

    ground = Outline.line((-2.5, -1.20), (9.0, -1.20))
    rear = Outline.circle(at=(0.95, -0.72), radius=0.48)
    front = Outline.circle(at=(2.10, -0.72), radius=0.48)
    frame = Outline([(-0.25, -0.10), (5.9, -0.10), (5.9, -0.42), (-0.25, -0.42)])
    skip = Outline([(-0.43, 0.14), (5.45, -1.05), (5.71, 0.23), (-0.17, 1.41)], on=(O, B))

    about = Featured("tip", ["G", "B"])
