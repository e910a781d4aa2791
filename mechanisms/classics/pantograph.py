"""The pantograph.

Source: Scheiner (1603); the dimensions are illustrative.
"""

from __future__ import annotations

from linkage import LEFT, Dimension, Dyad, Featured, Ground, Guide, Mechanism, OnGuide, OnLink, Stroke, deg


class Pantograph(Mechanism):
    """The parallelogram ACDQ on the fixed point O: the tracer Q is led by hand, the pen R draws.

    Known for: R is Q enlarged from O by the scale k, exactly, wherever Q goes. Two strokes, Q's coordinates.
    """

    X = Stroke(0.100, 0.300)  # tracer, m
    Y = Stroke(-0.100, 0.100)  # tracer, m

    k = Dimension(2.5)  # scale
    arm = Dimension(0.240)  # OA
    bar = Dimension(0.200)  # AQ

    O = Ground(0.0, 0.0)
    table = Guide((0.0, 0.0), angle=0.0)
    foot = OnGuide(table, at=X)
    column = Guide(foot, angle=90 * deg)

    Q = OnGuide(column, at=Y)  # tracer
    A = Dyad(O, Q, OA=arm, AQ=bar, side=LEFT)
    C = OnLink(O, A, OC=k * arm)
    D = Dyad(C, Q, CD=bar, QD=(k - 1.0) * arm, side=LEFT)
    R = OnLink(C, D, CR=k * bar)  # pen

    about = Featured("R_x", ["Q", "R"])
