"""A tail-lift with a corner that it does not reach: while it stands low the tilt cylinder is drawn in farther than the links let it."""

from hydraulics import Cylinder, LiftCircuit
from linkage import LEFT, RIGHT, Dyad, Ground, LoadCase, Mechanism, Motion, OnLink, Over, Stroke, Verdict, Weight
from linkage.units import bar, deg, mm


class TailLift(Mechanism):
    """Lift cylinder EF under the arm AB, tilt cylinder DC, the platform BCZ. All figures are illustrative."""

    S1 = Stroke(0.0, 0.225)
    S2 = Stroke(0.0, 0.340)

    A = Ground(0.0, 0.55)
    D = Ground(0.02, 0.85)
    E = Ground(-0.35, 0.0)
    F = Dyad(E, A, EF=0.620 + 2 * S1, AF=0.45, side=RIGHT)
    B = OnLink(A, F, AB=0.80, FAB=6 * deg)
    C = Dyad(D, B, DC=0.920 - S2, BC=0.30, side=LEFT)
    Z = OnLink(B, C, BZ=1.60, CBZ=-95 * deg)
    G = OnLink(B, C, BG=0.72, CBG=-95 * deg)

    load = Weight(G, mass=1500)
    lift = Cylinder(E, F, bore=80 * mm, rod=45 * mm, count=2, closed=0.615, stroke=0.460)
    tilt = Cylinder(D, C, bore=63 * mm, rod=36 * mm, count=2, works="rod", closed=0.560, stroke=0.400)
    lift_line = LiftCircuit(lift, pressure=170 * bar, relief=185 * bar)
    tilt_line = LiftCircuit(tilt, pressure=185 * bar, relief=200 * bar)
    full = LoadCase("full", scale=dict(load=1.2))


class Declared(TailLift):
    """The same with what it runs: level, and the whole box with its lost corner as part of the machine."""

    level = Over(S2=(0.0, 0.1), cases=("plain",))
    whole = Over(lost="allowed")


class Silent(TailLift):
    """The same where it is level, with rules of its own that have nothing to judge."""

    level = Over(S2=(0.0, 0.05), cases=("plain",))

    def rules(self, motion: Motion) -> list[str]:
        """Return two rules without a figure, and one that is kept."""
        return [Verdict("noise", None, "nobody measured it."), Verdict("paint", None, "none is chosen."), Verdict("colour", True, "red.")]
