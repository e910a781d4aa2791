"""A wheel loader with Z-bar linkage, a parts list with the places of its drawing. All figures are illustrative, of a 10 t machine."""

from __future__ import annotations

from math import dist

from hydraulics import Cylinder, LiftCircuit
from linkage import Featured, Ground, Link, LinkMass, LoadCase, Mechanism, Outline, Over, Pin, Planes, Stroke, Support, Weight, angle, drawn
from linkage.units import bar, litre, minute, mm


class WheelLoader(Mechanism):
    """Two cylinders CD lift the arm ADPN, cylinder TU turns the lever UPV, and the rod VW with it the bucket NWZ.

    `filling` curls the bucket in the heap; `loading` lifts it full, and tilts it out on the way, for this linkage curls as it lifts.
    """

    lift = Stroke(0.0, 0.900)  # m
    tilt = Stroke(0.0, 0.400)
    sketch = drawn(lift=0.0, tilt=0.200)

    A, C, T = Ground(0.000, 2.050), Ground(-0.350, 1.000), Ground(0.200, 2.300)
    D, P, N = Pin(at=(1.091, 0.880)), Pin(at=(1.600, 1.210)), Pin(at=(2.192, 0.150))
    U, V = Pin(at=(1.450, 1.950)), Pin(at=(1.780, 0.520))
    W, Z, Q = Pin(at=(2.230, 0.550)), Pin(at=(3.350, 0.050)), Pin(at=(2.750, 0.550))  # rod, edge, load
    arm = Link("A D P N")
    lever = Link("U P V")
    rod = Link("V W")
    bucket = Link("N W Z Q")
    lifting = Link("C D", CD=dist((-0.350, 1.000), (1.091, 0.880)) + lift)
    tilting = Link("T U", TU=dist((0.200, 2.300), (1.450, 1.950)) - 0.200 + tilt)
    attitude = angle(N, Z)

    arm_mass = LinkMass((A, N), mass=900.0, at=(1.44, 0.17))
    bucket_mass = LinkMass((N, Z), mass=700.0, at=(0.44, 0.24))
    load = Weight(Q, mass=3000.0)
    lift_rams = Cylinder(C, D, bore=100 * mm, rod=63 * mm, count=2, closed=1.440, stroke=0.910)
    tilt_ram = Cylinder(T, U, bore=125 * mm, rod=70 * mm, works="both", closed=1.090, stroke=0.420)
    lift_line = LiftCircuit(lift_rams, pressure=210 * bar, relief=230 * bar, flow=120 * litre / minute, mechanical_efficiency=0.95)
    tilt_line = LiftCircuit(tilt_ram, pressure=210 * bar, relief=250 * bar)

    empty = LoadCase("empty", scale={"load": 0.0})
    filling = Over.path(lift=0.05, tilt=[0.20, 0.36], cases=["plain"])
    loading = Over.path(lift=[0.05, 0.30, 0.55, 0.80], tilt=[0.36, 0.25, 0.15, 0.05], cases=["plain"])
    returning = Over.path(lift=[0.80, 0.05], tilt=[0.0, 0.20], cases=["empty"])

    front_axle, rear_axle, M = Ground(0.35, 0.0), Ground(-2.55, 0.0), Ground(-1.55, 1.05)  # M of all behind the arm
    body = Weight(M, mass=8400.0)
    front = Support(front_axle, (0, 1))
    rear = Support(rear_axle, (0, 1))

    planes = Planes("PUV VW tilt_ram NWZQ", "ADPN lift_rams NWZQ", "front_wheel NWZQ", width=90 * mm)  # the bucket in all three

    ground = Outline.line((-3.6, 0.0), (4.2, 0.0))
    front_wheel = Outline.circle(at=(0.35, 0.72), radius=0.72)
    rear_wheel = Outline.circle(at=(-2.55, 0.72), radius=0.72)
    chassis = Outline([(-3.35, 0.62), (0.35, 0.62), (0.3, 2.3), (-0.1, 2.4), (-0.55, 1.25), (-0.95, 1.25), (-0.95, 1.75), (-3.30, 1.60)])
    cab = Outline([(-0.95, 1.75), (-0.62, 1.30), (-0.62, 2.55), (-0.85, 3.05), (-1.85, 3.05), (-1.95, 1.68)])
    shell = Outline([(-0.05, -0.06), (1.16, 0.0), (0.78, 0.40), (0.40, 0.85), (0.0, 0.80), (-0.12, 0.30)], on=(N, Z))

    about = Featured("N_y", ["N", "Z"])
