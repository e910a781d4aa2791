"""A six-bar of the Stephenson II kind, driven from either of its two links on the frame. The dimensions are illustrative."""

from __future__ import annotations

from linkage import Crank, Featured, Ground, Link, Mechanism, OnLink, Pin, Stroke, angle, deg, drawn


class StephensonTwo(Mechanism):
    """Crank AOD drives the floating ternary link BFG through the rods AB and DF; rocker EG holds it to the frame.

    Known for: no dyad can be taken from it; the pins B, F and G are one group of class III (a triad).
    """

    phi = Stroke(20 * deg, 200 * deg)  # crank, rad: it stops at -2.3 and 293.9 degrees
    sketch = drawn(phi=60 * deg)

    O = Ground(0.0, 0.0)
    E = Ground(0.200, 0.0)

    A = Crank(O, OA=0.050, angle=phi)
    D = OnLink(O, A, OD=0.040, AOD=70 * deg)
    near_rod = Link("A B", AB=0.100)
    far_rod = Link("D F", DF=0.120)
    floating = Link("B F G", BF=0.060, BG=0.100, FG=0.130)
    rocker = Link("E G", EG=0.110)
    B = Pin(near=(0.124, 0.053))
    F = Pin(near=(0.078, 0.091))
    G = Pin(near=(0.207, 0.110))
    psi = angle(E, G)

    about = Featured("psi", ["B", "F"], coupler="F")


class StephensonTwoFar(Mechanism):
    """The same chain driven by EG: two ternary links AOD and BFG with two rods between them.

    Known for: its pins A, D, B and F form one group of class IV (a closed contour of four links).
    """

    psi = Stroke(80 * deg, 160 * deg)  # rocker EG, rad: it turns back at 76.3 degrees
    sketch = drawn(psi=86.5 * deg)

    O = Ground(0.0, 0.0)
    E = Ground(0.200, 0.0)

    G = Crank(E, EG=0.110, angle=psi)
    crank = Link("O A D", OA=0.050, OD=0.040, AOD=70 * deg)
    near_rod = Link("A B", AB=0.100)
    far_rod = Link("D F", DF=0.120)
    floating = Link("G B F", BF=0.060, BG=0.100, FG=0.130)
    A = Pin(near=(0.025, 0.043))
    D = Pin(near=(-0.026, 0.031))
    B = Pin(near=(0.124, 0.053))
    F = Pin(near=(0.078, 0.091))
    phi = angle(O, A)

    about = Featured("phi", ["B", "F"], coupler="F")
