"""Mechanisms that the tests write into files: every step, a parts list, a drawing."""

import numpy as np

from linkage import (
    LEFT,
    RIGHT,
    CosineAngle,
    Crank,
    Dimension,
    Dyad,
    Ground,
    Group,
    Guide,
    GuideCross,
    Link,
    Mechanism,
    Offset,
    OnGuide,
    OnLink,
    Pin,
    PinSlotDyad,
    Slide,
    SliderDyad,
    Stroke,
    Turn,
    Vector,
    YokeDyad,
    angle,
    deg,
    distance,
    drawn,
    kgf,
    kN,
    mm,
    ref,
    x,
    y,
)
from linkage.files import to_dict
from linkage.loads import Actuator, Damper, Force, GuideFriction, LinkMass, LoadCase, Moment, PinFriction, Spring, Support, Weight


class Hitch(Mechanism):
    """Cylinder AB turns the lift arm OBC; rod CD lifts the lower link EDF."""

    S = Stroke(0.00, 0.25)
    L0 = Dimension(0.50)
    A = Ground(0.20, 0.55)
    O = Ground(0.30, 1.15)
    E = Ground(0.25, 0.60)
    M = Ground(0.22, 1.05)
    B = Dyad(A, O, AB=L0 + S, OB=0.30, side=RIGHT)
    C = OnLink(O, B, OC=0.36, BC=0.16, side=LEFT)
    D = Dyad(E, C, ED=0.48, CD=0.62, side=RIGHT)
    F = OnLink(E, D, EF=0.95)
    K = Dyad(M, F, MK=0.88, FK=0.685, side=LEFT)
    G = OnLink(F, K, FG=0.90, KFG=75 * deg, side=RIGHT)
    tilt = angle(F, K) - 90 * deg


class EveryStep(Mechanism):
    """Every step once.

    Its docstring has "quotes", a \\ and a triple \"\"\" as well.
    """

    phi = Stroke(0.2, 40 * deg)
    S = Stroke(0, 0.2)
    sketch = drawn(S=0.1, phi=0.3)
    L0 = Dimension(0.5)
    whole = Dimension(2)
    mass = Dimension(900 * kgf, unit="kgf")
    odd = Dimension(1 / 3 * kgf, unit="kgf")

    A = Ground(0.0, 0.0)
    O = Ground(0.6, 0.0)
    H = Ground(2 * L0, -0.1 - L0 / 3)

    B = Dyad(A, O, AB=L0 + S, OB=0.30, side=RIGHT)
    C = OnLink(O, B, OC=0.36, BC=0.16, side=LEFT)
    D = OnLink(O, B, OD=0.40, BOD=33 * deg)
    E = OnLink(O, B, at=(0.7, 0.3))
    F = Dyad(A, O, at=(0.3, 0.4))
    G = Dyad(C, A, CG=0.7, GA=0.75, near=(0.1, 1.0))

    AO = Vector(A, O)
    OAB = CosineAngle(abs(AO), L0 + S, 0.3)
    AT = Turn(AO, -OAB, length=L0 + S)
    T = Offset(A, AT)
    V = Offset("A", Turn(Vector("A", "O"), -(2 * OAB) / 3))

    R = Crank(O, OR=0.1, angle=phi)
    rail = Guide((0.0, -0.3), angle=0.0)
    post = Guide(H, angle=100 * deg)
    bar = Guide(O, R)
    I = SliderDyad(R, rail, RI=0.5, side=RIGHT)
    J = PinSlotDyad(A, R, AJ=0.7, offset=0.02, side=RIGHT)
    K = PinSlotDyad(A, R, AK=0.7, near=(0.7, 0.0))
    M = YokeDyad(R, rail, angle=80 * deg)
    N = YokeDyad(R, rail)
    P = OnGuide(bar, at=S + 0.1)
    Q = GuideCross(rail, post)
    arm = Link(O, B, C)

    tilt = angle(B, C) - 90 * deg
    length = -(distance(A, C) * ref("later")) ** 2
    later = np.sqrt(x(C) ** 2 + y(C) ** 2) - (1 - (S - (L0 - S))) * (-(S**2)) ** 3
    turned = np.arctan2(y(C), x(C)) + np.minimum(S, L0) - np.maximum(1, S) * abs(S - L0) + abs(AO) + (-2) ** S + S * -2
    level = ref("tilt")


class Parts(Mechanism):
    """A triad between a crank, a rocker and a slide; the declared group is found again."""

    phi = Stroke(0.0, 40 * deg)
    O = Ground(0.0, 0.0)
    E = Ground(0.200, 0.0)
    A = Crank(O, OA=0.050, angle=60 * deg + phi)
    D = OnLink(O, A, OD=0.040, AOD=70 * deg)
    triad = Group("B F G")
    near_rod = Link("A B", AB=0.100)
    far_rod = Link("D F", DF=0.120)
    floating = Link("B F G", BF=0.060, BG=0.100, FG=0.130)
    rocker = Link("E G", EG=0.110)
    B = Pin(near=(0.124, 0.053))
    F = Pin(near=(0.078, 0.091))
    G = Pin(near=(0.207, 0.110))
    rail = Guide((0.0, -0.2), angle=0.0)
    rod = Link("A Z", AZ=0.300)
    shoe = Slide("Z", rail)
    Z = Pin(near=(0.22, -0.2))


class Drawn(Mechanism):
    """A four-bar and a triad of which only the drawing is known."""

    phi = Stroke(0.0, 0.5)
    O = Ground(0.0, 0.0)
    E = Ground(0.200, 0.0)
    A = Crank(O, OA=0.050, angle=60 * deg + phi)
    D = OnLink(O, A, OD=0.040, AOD=70 * deg)
    near_rod = Link("A B")
    far_rod = Link("D F")
    floating = Link("B F G")
    rocker = Link("E G")
    B = Pin(at=(0.124, 0.053))
    F = Pin(at=(0.078, 0.091))
    G = Pin(at=(0.207, 0.110))


class Loaded(Hitch):
    """The hitch with every kind of load and load case."""

    rail = Guide((1.4, 0.0), angle=0.0)
    P = SliderDyad("F", rail, FP=1.1, side=RIGHT)
    arm = Link("O", "B", "C")
    m1 = Dimension(300.0, unit="kg")

    load = Weight("G", mass=2000)
    half = Weight("F", mass=ref("m1") / 2)
    moon = Weight("K", mass="m1", gravity=(0.0, -1.62))
    pull = Force("F", (-5 * kN, 0))
    push = Force(P, (ref("m1") * 2, 1.25))
    drag = Moment("O B", M=-250)
    turn = Moment(arm, M=0.5)
    own = LinkMass("E D F", mass=30, at=(0.45, 0))
    bar = LinkMass(arm, mass=12.5)
    relief = Spring("A", "C", stiffness=20e3, free_length=400 * mm)
    taut = Spring("A", "B", stiffness=5e3, preload=800)
    strut = Damper("E", "C", coefficient=2000)
    ram = Actuator("E", "D", force=-1500)
    shoe = Support("F", (0, 2), force=-100.0)
    pin_E = PinFriction("E", radius=20 * mm, coefficient=0.15)
    slide = GuideFriction(P, coefficient=0.1, guide=rail)

    transport = LoadCase("on the road", scale={"load": 2.0, "pull": 0}, slope=10 * deg)
    bare = LoadCase(only=["load", own, "pin_E"], gravity=(0, -1.62))
    as_declared = LoadCase()


def changed(*path, to=None, drop=False):
    """Return the hitch's tables with one thing changed or taken out."""
    tables = to_dict(Hitch)
    node = tables
    for part in path[:-1]:
        node = node.setdefault(part, {})
    if drop:
        del node[path[-1]]
    else:
        node[path[-1]] = to
    return tables
