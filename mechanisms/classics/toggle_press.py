"""A toggle press. The dimensions are illustrative."""

from __future__ import annotations

from hydraulics import Cylinder, LiftCircuit
from linkage import Dimension, Featured, Force, Ground, Guide, Link, Mechanism, Pin, Slide, Stroke, bar, deg, kN, litre, minute, mm, y


class TogglePress(Mechanism):
    """Cylinder CA straightens the toggle OAB, whose lower end B presses down along the guide.

    Known for: mechanical advantage without bound. With equal arms under alpha to the press's axis the sideways force at
    A is magnified by 1 / (2 tan(alpha)).
    """

    S = Stroke(0.0, 0.145)  # cylinder stroke, m: the toggle would be straight at 0.15
    L0 = Dimension(0.450)  # pin-to-pin length at S = 0, m

    O = Ground(0.0, 0.800)
    C = Ground(-0.600, 0.500)
    axis = Guide((0.0, 0.0), angle=90 * deg)

    cylinder = Link("C A", CA=L0 + S)
    upper = Link("O A", OA=0.300)
    lower = Link("A B", AB=0.300)
    ram = Slide("B", axis)
    A = Pin(near=(-0.12, 0.52))
    B = Pin(near=(0.0, 0.25))
    travel = 0.200 - y(B)  # m below the straight toggle's end, negative above

    load = Force("B", (0.0, 25 * kN))  # what resists is illustrative, and so are the cylinder and its circuit
    push = Cylinder("C", "A", bore=63 * mm, rod=36 * mm, closed=0.450, stroke=0.150)
    line = LiftCircuit(push, pressure=160 * bar, flow=12 * litre / minute)

    about = Featured("travel", ["A"])
