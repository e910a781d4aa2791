"""A tractor's three-point hitch.

Source: Dyuzhev, Kotov, Chuprynin, "Universality of the hitch of the power vehicle UES-2-250A" (Minsk, 2008), the
vector method's equations (4) to (27). The paper prints no data; the dimensions are illustrative.
"""

from __future__ import annotations

from linkage import LEFT, RIGHT, Column, Dimension, Dyad, Ground, Mechanism, Motion, OnLink, Stroke, angle, deg


class ThreePointHitch(Mechanism):
    """Cylinder AB turns the lift arm OBC; rod CD lifts the lower link EDF.

    MK is the adjustable upper link, KF the implement's upright, G its centre of gravity; the implement FKG is rigid.
    The origin is the driving wheels' axis projected on the ground, x away from the tractor, y up. tilt is the
    upright's angle from the vertical, positive when its top leans towards the tractor.

    The dimensions are illustrative, of the proportions of category 3; they are not the UES-2-250A's own.
    """

    S = Stroke(0.00, 0.25)                                # cylinder stroke, m
    L0 = Dimension(0.50)                                  # pin-to-pin length at S = 0, m

    A = Ground(0.20, 0.55)
    O = Ground(0.30, 1.15)
    E = Ground(0.25, 0.60)
    M = Ground(0.22, 1.05)

    B = Dyad(A, O, AB=L0 + S, OB=0.30, side=RIGHT)        # cylinder and lift arm
    C = OnLink(O, B, OC=0.36, BC=0.16, side=LEFT)         # the arm's other end
    D = Dyad(E, C, ED=0.48, CD=0.62, side=RIGHT)          # lower link and lift rod
    F = OnLink(E, D, EF=0.95)                             # EDF is straight
    K = Dyad(M, F, MK=0.88, FK=0.685, side=LEFT)          # upper link and upright
    G = OnLink(F, K, FG=0.90, KFG=75 * deg, side=RIGHT)   # centre of gravity
    tilt = angle(F, K) - 90 * deg                         # a named output

    def columns(self, motion: Motion) -> list[Column]:
        """Return the stroke, the moving points, the transfer ratio I = dG_y/dS (27) and the upright's tilt."""
        *points, _ = super().columns(motion)
        return [*points, Column("I", motion.ratio("G")[1], "", 4), Column("tilt", motion["tilt"], "deg", 3)]
