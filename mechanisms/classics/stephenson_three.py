"""A six-bar of the Stephenson III kind: a dwell mechanism, and the same chain driven from its far end.

Source of the method: Norton, "Design of Machinery", chapter 3 (single-dwell linkages: the output's rod is as long as
the radius of a circular arc of a coupler curve). The dimensions are illustrative, found by fitting such an arc.
"""

from __future__ import annotations

from math import pi

from linkage import LEFT, Crank, Dyad, Featured, Ground, Link, Mechanism, OnLink, Pin, Stroke, angle, deg, drawn


class StephensonThree(Mechanism):
    """Four-bar OABC with coupler point D moves rocker EF through rod DF.

    Known for: dwell. From phi = 120 to 240 degrees D runs on an arc about F, and the rocker rests.
    """

    phi = Stroke(0.0, 2 * pi)  # crank angle, rad
    sketch = drawn(phi=pi)

    O = Ground(0.0, 0.0)
    C = Ground(0.110, 0.0)
    E = Ground(-0.038, -0.150)

    A = Crank(O, OA=0.050, angle=phi)
    B = Dyad(A, C, AB=0.200, CB=0.152, side=LEFT)
    D = OnLink(A, B, AD=0.090, BAD=121.3 * deg)
    F = Dyad(D, E, DF=0.1006, EF=0.160, near=(-0.038, 0.010))
    P = OnLink(D, F, DP=0.050, FDP=30 * deg)  # a point of the rod
    psi = angle(E, F)

    about = Featured("psi", ["D"], coupler="P")


class StephensonThreeFar(Mechanism):
    """The same chain driven by the far link EF; the coupler ABD hangs on three links.

    Known for: A, B and D are one group of class III (the triad), which no dyads place.
    """

    psi = Stroke(60 * deg, 85 * deg)  # link EF, rad
    sketch = drawn(psi=75 * deg)

    O = Ground(0.0, 0.0)
    C = Ground(0.110, 0.0)
    E = Ground(-0.038, -0.150)

    F = Crank(E, EF=0.160, angle=psi)
    crank = Link("O A", OA=0.050)
    rocker = Link("C B", CB=0.152)
    coupler = Link("A B D", AB=0.200, AD=0.090, BAD=121.3 * deg)
    rod = Link("D F", DF=0.1006)
    A = Pin(near=(0.032, 0.038))
    B = Pin(near=(0.221, 0.103))
    D = Pin(near=(-0.038, 0.096))
    phi = angle(O, A)

    about = Featured("phi", ["D"], coupler="D")
