"""The offset slider-crank.

Source: Norton, "Design of Machinery", chapter 4 (example 4-2: the lengths and the pose at 60 degrees).
"""

from __future__ import annotations

from math import pi

from linkage import RIGHT, Crank, Featured, Ground, Guide, Mechanism, OnLink, SliderDyad, Stroke, deg, x


class SliderCrank(Mechanism):
    """Crank OA moves slider B through rod ABP; the slider's line passes 20 mm below the crank's centre.

    Known for: d = a cos(phi) + sqrt(b^2 - (a sin(phi) - c)^2) with crank a, rod b, offset c. Its travel is
    sqrt((b + a)^2 - c^2) - sqrt((b - a)^2 - c^2). One way takes longer than the other.
    """

    phi = Stroke(0.0, 2 * pi)  # crank angle, rad

    O = Ground(0.0, 0.0)
    rail = Guide((0.0, -0.020), angle=0.0)

    A = Crank(O, OA=0.040, angle=phi)
    B = SliderDyad(A, rail, AB=0.120, side=RIGHT)
    P = OnLink(A, B, AP=0.060, BAP=30 * deg)  # a point of the rod
    d = x(B)  # slider, m

    about = Featured("d", ["A"], coupler="P")
