"""A hydropneumatic axle, seen from behind: both struts on one block of gas, or crossed on two. All figures are illustrative."""

from __future__ import annotations

from hydraulics import Accumulator, AccumulatorBlock, Cylinder, OilLine
from linkage import LEFT, RIGHT, Dyad, Featured, Ground, LinkMass, Mechanism, OnLink, Outline, Over, Part, Stroke, Support
from linkage.units import bar, deg, litre, mm


class Suspension(Mechanism):
    """The right wheel on two wishbones, OW and PV; strut AB stands on the lower one, and S presses it in."""

    S = Stroke(-0.12, 0.12)  # m, from where the axle stands

    O, P = Ground(0.25, 0.55), Ground(0.32, 0.85)
    A = Ground(0.50, 1.15)
    B = Dyad(A, O, AB=0.62 - S, OB=0.40, side=LEFT)
    W = OnLink(O, B, OW=0.66)
    V = Dyad(W, P, WV=0.30, PV=0.57, side=RIGHT)
    T = OnLink(W, V, WT=0.572, VWT=-164 * deg)  # of the tyre, on the ground

    hub = LinkMass((W, V), mass=90.0)
    strut = Cylinder(A, B, bore=80 * mm, rod=63 * mm, closed=0.49, stroke=0.26)
    wheel = Support(T, (0, 1))
    tyre = Outline([(-0.55, -0.32), (0.55, -0.32), (0.55, 0.0), (-0.55, 0.0)], on=(W, V))


class Axle(Mechanism):
    """Both struts on one block: the axle springs as both go in, `bumping`, and swings as freely as a beam on a pin, `rolling`."""

    right_in = Stroke(-0.10, 0.10)  # m, of the struts
    left_in = Stroke(-0.10, 0.10)

    right = Part(Suspension, S=right_in)
    left = Part(Suspension, S=left_in, mirrored=True)

    line = OilLine(
        right.strut, left.strut, AccumulatorBlock([Accumulator(volume=4 * litre, charge=35 * bar)]),
        at=dict(right_in=0.0, left_in=0.0), charge_pressure=64 * bar,
    )  # fmt: skip

    bumping = Over.path(right_in=[-0.10, 0.10], left_in=[-0.10, 0.10])
    rolling = Over.path(right_in=[-0.05, 0.05], left_in=[0.05, -0.05])

    ground = Outline.line((-1.5, 0.0), (1.5, 0.0))
    frame = Outline([(-0.36, 0.45), (0.36, 0.45), (0.36, 0.90), (0.55, 1.10), (0.55, 1.22), (-0.55, 1.22), (-0.55, 1.10), (-0.36, 0.90)])

    about = Featured("right.T_y", ["right.T", "left.T"])


def crossed(side: str, other: str) -> OilLine:
    """Return the line of the piston side of one strut and the rod side of the other, on a block of its own."""
    block = AccumulatorBlock([Accumulator(volume=2 * litre, charge=60 * bar)])
    chambers, at = (f"{side}.strut.piston_side", f"{other}.strut.rod_side"), dict(right_in=0.0, left_in=0.0)
    return OilLine(*chambers, block, at=at, charge_pressure=103.2 * bar)


class CrossedAxle(Axle):
    """The piston side of each strut on one block with the rod side across: it stands as high, and resists `rolling`."""

    line = None  # type: ignore[assignment]
    to_right, to_left = crossed("right", "left"), crossed("left", "right")
