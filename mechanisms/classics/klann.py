"""Joseph Klann's leg.

Source: US patent 6,260,862 (2001), its coordinates of an example leg with the crank at 180 degrees. The patent's unit
is taken as 1 m; its numbers of the joints stand beside them.
"""

from __future__ import annotations

from math import pi

from linkage import Crank, Featured, Ground, Link, Mechanism, Pin, Stroke, drawn


class Klann(Mechanism):
    """Crank OA moves the connecting rod ABK, held by the lower rocker MB; the leg KHF hangs from the upper rocker NH.

    Known for: the foot F stands on a nearly straight line during half a turn of the crank and steps high in the other.
    The lengths are measured from the patent's drawing.
    """

    phi = Stroke(0.0, 2 * pi)  # crank angle, rad
    sketch = drawn(phi=pi)

    O = Ground(1.599, 0.750)  # 15, crank shaft
    M = Ground(1.009, 0.574)  # 11, second rocker arm's axle
    N = Ground(1.366, 1.366)  # 9, first rocker arm's axle

    A = Crank(O, OA=0.268, angle=phi)  # 29
    B = Pin(at=(0.741, 0.750))  # 27, elbow
    K = Pin(at=(0.232, 0.866))  # 35, knee
    H = Pin(at=(0.866, 1.500))  # 37, hip
    F = Pin(at=(0.000, 0.000))  # 33, foot
    rod = Link("A B K")
    lower = Link("M B")
    upper = Link("N H")
    leg = Link("K H F")

    about = Featured("F_y", ["F"])
