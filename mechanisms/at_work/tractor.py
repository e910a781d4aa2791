"""A tractor on two axles with a spreader on the shipped three-point hitch, or with a plough in the spreader's place.

Sources: those of `mechanisms.three_point_hitch`, whose tractor stands here on its axles; the mast is category 3's of ISO 730, 685 mm.
Both tools, what they weigh, the draught and the grip of the ground are illustrative.
"""

from __future__ import annotations

from linkage import Featured, Force, Ground, Link, LinkMass, LoadCase, Mechanism, Outline, Over, Part, Stroke, Support, Weight, deg, kN, mm

from ..three_point_hitch import ThreePointHitch


class Spreader(Mechanism):
    """A mounted spreader; in axes at the lower hitch points F, x away from the tractor, y up along the mast FK."""

    F = Ground(0.0, 0.0)
    K = Ground(0.0, 685 * mm)
    P = Ground(0.65, 0.45)  # the middle of what is spread

    steel = LinkMass((F, K), mass=380.0, at=(0.30, -0.55))  # kg, along FK and to its left
    load = Weight(P, mass=1500.0)
    hopper = Outline([(0.35, 0.05), (0.95, 0.05), (1.30, 0.85), (0.05, 0.85)])
    frame = Outline([(-0.05, -0.05), (0.06, -0.05), (0.30, -0.18), (0.95, -0.18), (0.95, -0.10), (0.06, 0.10), (0.06, 0.72), (-0.05, 0.72)])


class Plough(Mechanism):
    """A mounted plough of four furrows; in the same axes. The draught acts along it, and draws it into the ground."""

    F = Ground(0.0, 0.0)
    K = Ground(0.0, 685 * mm)
    P = Ground(1.50, -0.48)  # where the draught of its bodies acts

    steel = LinkMass((F, K), mass=1150.0, at=(0.15, -1.20))
    load = Force(P, (24 * kN, -3 * kN))
    beam = Outline([(-0.05, -0.05), (0.06, -0.05), (0.30, 0.05), (2.60, 0.05), (2.60, 0.17), (0.06, 0.72), (-0.05, 0.72)])
    fore = Outline([(0.50, 0.05), (0.62, 0.05), (0.66, -0.35), (0.52, -0.62), (0.24, -0.62), (0.46, -0.42)])
    aft = Outline([(2.30, 0.05), (2.42, 0.05), (2.46, -0.35), (2.32, -0.62), (2.04, -0.62), (2.26, -0.42)])


class SpreaderTractor(Mechanism):
    """The hitch lifts the spreader, hitch.lift, and the tractor carries both on its axles; all four wheels drive.

    `lifting` raises it full, on level ground and where that falls away behind the tractor; `working` holds it while it empties.
    """

    S = Stroke(0.0, 0.250)  # of the hitch's cylinders, m

    hitch = Part(ThreePointHitch, S=S, MK=0.93, load=None)  # its own implement left out
    tool = Part(Spreader, on=(hitch.F, hitch.K), angle=-90 * deg, F=hitch.F, K=hitch.K)
    implement = Link(hitch.F, hitch.K)

    rear_axle = Ground(0.0, 0.0)  # on the ground
    front_axle = Ground(-hitch.wheelbase, 0.0)
    C = Ground(hitch.vehicle_x, hitch.vehicle_y)
    body = Weight(C, mass=hitch.vehicle_mass)
    front = Support(front_axle, (0, 1), friction=0.6)
    rear = Support(rear_axle, (0, 1), friction=0.6)

    uphill = LoadCase("uphill", slope=-12 * deg)  # the ground falls away behind the tractor
    bare = LoadCase("bare", scale={"tool.load": 0.0})  # the spreader empty, the plough out of the ground
    lifting = Over.path(S=[0.05, 0.25], cases=["plain", "uphill"])
    working = Over.path(S=0.15, cases=["plain", "bare"])

    front_wheel = Outline.circle(at=(-2.75, 0.60), radius=0.60)
    hood = Outline([(-3.35, 0.75), (-0.95, 0.75), (-0.95, 1.75), (-3.15, 1.60), (-3.40, 1.40)])
    cab = Outline([(-0.95, 0.95), (0.10, 1.30), (0.15, 1.60), (-0.05, 2.75), (-1.15, 2.75), (-0.95, 1.60)])

    about = Featured("hitch.F_y", ["hitch.F", "tool.P"])


class PloughTractor(SpreaderTractor):
    """The spreader's tractor with a plough in place of the spreader: one part is exchanged.

    `working` holds it in the ground, against the draught, `lifting` takes it out at the headland.
    """

    tool = Part(Plough, on=("hitch.F", "hitch.K"), angle=-90 * deg, F="hitch.F", K="hitch.K")

    lifting = Over.path(S=[0.05, 0.25], cases=["bare"])
    working = Over.path(S=[0.04, 0.06], cases=["plain"])
