"""The three four-bars that draw one coupler curve.

Source: the theorem of Roberts (1875) and Chebyshev (1878), in complex numbers as in Norton, "Design of Machinery",
chapter 3. The dimensions are illustrative.
"""

from __future__ import annotations

from math import pi

import numpy as np

from linkage import LEFT, RIGHT, Crank, Dimension, Dyad, Featured, Ground, Mechanism, OnLink, Stroke, angle, deg


class RobertsCognates(Mechanism):
    """Three separate four-bars on the frame triangle UVW, with coupler points P, Q and R.

    The first has the coupler triangle ABP; the frame triangle and the other couplers are similar to it. Its cognates'
    links are the first one's, scaled by k = AP / AB or h = BP / AB. Each cognate is driven by a crank of its own, which
    turns with the first one's coupler or crank, and closed by a dyad of its own.

    Known for: P, Q and R are one point at every pose, whatever the dimensions.
    """

    phi = Stroke(90 * deg, 270 * deg)  # first crank, rad: beside OA's parallels to VB, where D is flat

    crank, coupler, rocker = Dimension(0.040), Dimension(0.120), Dimension(0.080)
    frame = Dimension(0.100)
    k = Dimension(0.60)  # AP / AB
    delta = Dimension(40 * deg)  # BAP
    h = np.sqrt(1.0 + k * k - 2.0 * k * np.cos(delta))  # BP / AB
    epsilon = np.arctan2(k * np.sin(delta), 1.0 - k * np.cos(delta))

    U = Ground(0.0, 0.0)
    V = Ground(frame, 0.0)
    W = Ground(k * frame * np.cos(delta), k * frame * np.sin(delta))

    A = Crank(U, UA=crank, angle=phi)  # first: on U and V
    B = Dyad(A, V, AB=coupler, VB=rocker, side=LEFT)
    P = OnLink(A, B, AP=k * coupler, BAP=delta)

    C = Crank(U, UC=k * coupler, angle=angle(A, B) + delta)  # second: on U and W
    D = Dyad(C, W, CD=k * crank, WD=k * rocker, side=RIGHT)
    Q = OnLink(C, D, CQ=crank, DCQ=-delta)

    E = Crank(W, WE=h * crank, angle=phi - epsilon)  # third: on W and V
    F = Dyad(E, V, EF=h * rocker, VF=h * coupler, side=RIGHT)
    R = OnLink(E, F, ER=k * rocker, FER=delta + epsilon - pi)

    about = Featured("P_y", ["P"])
