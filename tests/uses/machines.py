"""The machines, the motions and the helpers that the wrong uses are made with."""

import pickle  # noqa: F401
from dataclasses import dataclass

import numpy as np

from hydraulics import *  # noqa: F403
from hydraulics import Accumulator, AccumulatorBlock, Buckling, Cylinder, CylinderSize, FloatCircuit, LiftCircuit
from linkage import *  # noqa: F403
from linkage import (  # noqa: F401
    LEFT,
    RIGHT,
    Column,
    Crank,
    Dimension,
    Dyad,
    ForceElement,
    Ground,
    Guide,
    Link,
    Load,
    LoadCase,
    Mechanism,
    Motion,
    OnGuide,
    OnLink,
    Pin,
    Spring,
    Stroke,
    Support,
    Vector,
    Weight,
    angle,
    deg,
    files,
    mm,
    pictures,
    pin_forces,
    ref,
    reports,
    study,
)
from linkage.motion import below_zero, greatest, lowest  # noqa: F401
from linkage.pictures import page_html  # noqa: F401
from linkage.units import bar, litre, parse, show  # noqa: F401
from mechanisms.header_balancer import HeaderBalancer
from mechanisms.header_balancer.criteria import charge_for, largest_charge  # noqa: F401
from mechanisms.header_balancer.following import over_following, stroke_of  # noqa: F401
from mechanisms.header_balancer.machine import setting_table, with_header  # noqa: F401
from mechanisms.header_balancer.measured import deviations, read_measured  # noqa: F401
from mechanisms.mower_lift import MowerLift  # noqa: F401
from mechanisms.three_point_hitch import ThreePointHitch
from mechanisms.three_point_hitch.capacity import (  # noqa: F401
    behind,
    capacity,
    stroke_per_newton,
    vertical_mast,
)


class Lift(Mechanism):
    """A cylinder turns an arm with a weight, a spring and a support."""

    S = Stroke(0.0, 0.25)
    L0 = Dimension(0.6)
    A, O = Ground(0.0, 0.0), Ground(0.7, 0.0)
    B = Dyad(A, O, AB=L0 + S, OB=0.3, side=LEFT)
    G = OnLink(O, B, OG=0.5, BG=0.25, side=RIGHT)
    tilt = angle(O, B)
    arm = Vector(O, B)
    load = Weight(G, mass=200.0)
    spring = Spring(A, G, stiffness=500.0, free_length=0.5)
    lift = Cylinder(A, B, bore=80 * mm, rod=45 * mm)
    circuit = LiftCircuit(lift, pressure=160 * bar)
    shoe = Support(G, (0, 1))
    transport = LoadCase("transport", scale={"load": 2.0})


class FourBar(Mechanism):
    """A crank rocker."""

    phi = Stroke(0, 2 * np.pi)
    O, C = Ground(0, 0), Ground(3, 0)
    A = Crank(O, OA=1, angle=phi)
    B = Dyad(A, C, AB=3, CB=2.5, side=LEFT)
    turn = angle(C, B)


class Two(Mechanism):
    """A machine of two strokes, which do not meet."""

    S, T = Stroke(0.0, 0.2), Stroke(0.0, 0.3)
    A, O = Ground(0.0, 0.0), Ground(0.7, 0.0)
    B = Dyad(A, O, AB=0.6 + S, OB=0.3, side=LEFT)
    rail = Guide((0, 0), angle=90 * deg)
    C = OnGuide(rail, at=0.2 + T)
    load = Weight(B, mass=10.0)


class Floating(Mechanism):
    """A weight on a charged line."""

    h = Stroke(0.0, 0.2)
    O, A = Ground(0, 0), Ground(0.2, 0.5)
    rail = Guide((0.6, 0), angle=90 * deg)
    R = OnGuide(rail, at=0.1 + h)
    lift = Cylinder(A, R, bore=63 * mm, rod=40 * mm)
    load = Weight(R, mass=200)
    line = FloatCircuit(lift, AccumulatorBlock([Accumulator(volume=4e-3, charge=20 * bar)]), charge_pressure=40 * bar, at=0.1)


nan, inf, huge, masked = float("nan"), float("inf"), 10**400, np.ma.masked_array([0.1, 0.2], mask=[True, False])
lifting, bar4, two, floating = Lift(), FourBar(), Two(), Floating()
batch = Lift(OB=[0.3, 0.31])
motion, turning, both, many, charged = lifting.sweep(5), bar4.sweep(9), two.sweep(S=3, T=0.1), batch.sweep(3), floating.sweep(3)
forces = pin_forces(motion)
quick, slow = bar4.function(["B"]), two.function(["B"])
hitch, header = ThreePointHitch(), HeaderBalancer()
hitched, at_rest = hitch.sweep(3), header.at(h=header.strokes["h"].start)
size, block, rod = CylinderSize(0.08, 0.045), AccumulatorBlock([Accumulator(4e-3, 2e6)]), Buckling(0.045)
lift, circuit, line = Lift.lift, Lift.circuit, Floating.line
surveyed = study.survey(lifting, {"OB": np.array([0.3, 0.31])}, lambda machine: {"t": machine["OB"]})
column = lifting.columns(motion)[-1]
read_only = np.zeros((1, 2))
read_only.flags.writeable = False


def made(**members):
    """Return the class Lift with members replaced or added."""
    base = {
        "S": Stroke(0.0, 0.25), "L0": Dimension(0.6), "A": Ground(0.0, 0.0), "O": Ground(0.7, 0.0),
        "B": Dyad("A", "O", AB=ref("L0") + ref("S"), OB=0.3, side=LEFT),
    }  # fmt: skip
    return type("Made", (Mechanism,), base | members)


def parts(**members):
    """Return a class of pins and links with members replaced or added."""
    base = {
        "S": Stroke(0.0, 0.2), "A": Ground(0, 0), "O": Ground(0.7, 0), "B": Pin(near=(0.5, 0.3)),
        "a": Link("A B", AB=0.6 + ref("S")), "b": Link("O B", OB=0.3),
    }  # fmt: skip
    return type("Parts", (Mechanism,), base | members)


def raising(*given):
    """Raise what comes of a slip in a function of one's own."""
    return {}["slip"]


class OwnStart(FourBar):
    """A machine whose own __init__ forgets the framework's."""

    def __init__(self):
        pass


class OwnTable(FourBar):
    """A machine whose table is no table."""

    def columns(self, motion):
        return 3


class OwnSlip(FourBar):
    """A machine whose table raises."""

    def columns(self, motion):
        return raising()


@dataclass(frozen=True, eq=False)
class Own(ForceElement):
    """An element of one's own that gives what it is told to."""

    given: object
    places = ()

    def loads(self, motion):
        return self.given() if callable(self.given) else self.given

    def __str__(self):
        return "Own()"


def gives(point="G", force=(0.0, 1.0), on=()):
    """Return an element of one's own with one load."""
    return Own([Load(point, force, on)])


NAMES = {name: value for name, value in globals().items() if not name.startswith("__")}
