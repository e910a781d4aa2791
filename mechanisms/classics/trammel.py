"""The trammel of Archimedes (double slider). The dimensions are illustrative."""

from __future__ import annotations

from linkage import RIGHT, Featured, Guide, Mechanism, OnGuide, OnLink, SliderDyad, Stroke, deg


class Trammel(Mechanism):
    """Bar XY slides with its ends on two rails at right angles; P is a point of the bar beyond Y.

    Known for: P draws an exact ellipse of half axes PY (along X's rail) and PX (along Y's rail).
    """

    S = Stroke(-0.080, 0.080)  # X along its rail, m

    rail = Guide((0.0, 0.0), angle=0.0)
    post = Guide((0.0, 0.0), angle=90 * deg)

    X = OnGuide(rail, at=S)
    Y = SliderDyad(X, post, XY=0.100, side=RIGHT)  # above the rail
    P = OnLink(X, Y, XP=0.160)

    about = Featured("P_y", ["P"])
