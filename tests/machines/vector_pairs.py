"""Machines in both spellings: in vectors, corners, turns and offsets alone, without a link, and in composite steps.

The papers' machines first, then machines of all kinds that vectors can write. `PAIRS` has them by name: (vectors, composite).
"""

from linkage import (
    LEFT,
    RIGHT,
    CosineAngle,
    Crank,
    Dimension,
    Dyad,
    Ground,
    Link,
    Mechanism,
    Moment,
    Offset,
    OnLink,
    Spring,
    Stroke,
    Turn,
    Vector,
    Weight,
    angle,
    deg,
    distance,
    ref,
)
from linkage.quantities import Member
from mechanisms.crane.machine import Crane
from mechanisms.grapple.machine import Grapple
from mechanisms.header_balancer import HeaderBalancer
from mechanisms.mower_lift import MowerLift
from mechanisms.three_point_hitch import ThreePointHitch

PAIRS = {}


def without_links(cls, **members):
    """Return a class with the members of another one but its links, and some more or others."""
    own = {name: member.renewed() for base in reversed(cls.__mro__) for name, member in vars(base).items() if isinstance(member, Member)}
    kept = {name: member for name, member in (own | members).items() if not isinstance(member, Link)}
    return type(f"{cls.__name__}InVectors", (Mechanism,), kept)


def pair(cls):
    """Enter the two spellings that a class holds, `Vectors` and `Steps`."""
    PAIRS[cls.__doc__] = cls.Vectors, cls.Steps
    return cls


# -- the papers' machines ------------------------------------------------------------------------------------


def hitch():
    """Return the hitch by (4) to (26), with the loads of the shipped one."""
    L0, S = ref("L0"), ref("S")
    AB, MF, ED, FK = Vector("A", "O"), Vector("M", "F"), Turn("EC", -ref("CED"), length=0.48), Vector("F", "K")
    return without_links(
        ThreePointHitch,
        B=Offset("A", Turn(AB, -ref("OAB"), length=L0 + S)), OAB=CosineAngle(abs(Vector("A", "O")), L0 + S, 0.30),
        C=Offset("O", Turn("OB", CosineAngle(0.30, 0.36, 0.16), length=0.36)), OB=Vector("O", "B"),
        D=Offset("E", "ED"), EC=Vector("E", "C"), ED=ED, CED=CosineAngle(abs(Vector("E", "C")), 0.48, 0.62),
        F=Offset("E", Turn("ED", 0, length=0.95)),
        K=Offset("M", Turn(MF, CosineAngle(abs(MF), 0.88, 0.685), length=0.88)),
        G=Offset("F", Turn(FK, -75 * deg, length=0.90)),
    )  # fmt: skip


def balancer():
    """Return the balancer by (4) to (16)."""
    OA = Vector("O", "A")
    turned = {name: Turn("OB", angle, length=length) for name, angle, length in (
        ("R", ref("BOR"), ref("L_OR")), ("G1", 5.491118 * deg, 0.488774), ("G2", 18.840343 * deg, 1.436851),
    )}  # fmt: skip
    return without_links(
        HeaderBalancer,
        B=Offset("O", "OB"), OB=Turn(OA, CosineAngle(abs(OA), ref("L_OB"), ref("L_min") + ref("h")), length=ref("L_OB")),
        **{name: Offset("O", vector) for name, vector in turned.items()},
    )  # fmt: skip


def mower_lift():
    """Return the worksheet's lever: FIS at O, between OA and OB; AO is turned by half a turn and by it."""
    AO, OB = Vector("A", "O"), Vector("O", "B")
    FIS = CosineAngle(distance("A", "O"), 0.175, ref("S"))
    given = {"OG": MowerLift.plan.defaults["OG"], "BOG": MowerLift.plan.defaults["BOG"]}
    return without_links(
        MowerLift,
        B=Offset("O", Turn(AO, 180 * deg + FIS, length=0.175)),
        G=Offset("O", Turn(OB, given["BOG"], length=given["OG"])),
    )  # fmt: skip


class CraneOnColumn(Crane):
    """The shipped crane with a point above the column's top, from which the boom's angle is counted.

    The weight at the joint of boom and arm hangs on the boom, at V: at a pin either body may carry it.
    """

    above = Ground(0.0, Crane.H_p + Crane.h_0 + 1.0)
    joint = Weight("V", mass=300 / 9.81)


def crane():
    """Return the crane by its boom's, its arm's and its drives' vectors."""
    JO, JK, VE = Vector("J", "O"), Vector("J", "K"), Vector("V", "E")
    moved = {
        "J": ("O", Vector("O", "above"), -ref("phi"), ref("l_c")),
        "K": ("J", JO, ref("psi"), ref("l_p")),
        "T": ("J", JK, 0, ref("l_p") + ref("t")),
        "OC": ("O", Vector("O", "J"), 0, 0.4 * ref("l_c")),
        "OG": ("O", Vector("O", "J"), 0, 0.7 * ref("l_c")),
        "H": ("O", Vector("O", "J"), 0, ref("boom_r3")),
        "B": ("H", Vector("H", "O"), 90 * deg, ref("boom_r4")),
        "V": ("J", JO, 0, ref("arm_r4")),
        "U": ("V", Vector("V", "J"), 180 * deg + ref("bend"), ref("arm_r5")),
        "C": ("U", Vector("U", "V"), 90 * deg, ref("arm_r6")),
        "E": ("J", JK, ref("lug"), ref("arm_r3")),
        "N": ("V", VE, CosineAngle(abs(VE), ref("arm_r1"), ref("arm_r2")), ref("arm_r1")),
        "R": ("J", JK, 0, ref("root_pin")),
    }
    return without_links(CraneOnColumn, **{X: Offset(P, Turn(base, by, length=r)) for X, (P, base, by, r) in moved.items()})


def grapple():
    """Return the lever by its direction, counted from the housing's middle."""
    OT, OA = Vector("O", "T"), Vector("O", "A")
    return without_links(
        Grapple,
        A=Offset("O", Turn(OT, ref("to_A") + ref("theta") - angle("O", "T"), length=ref("OA"))),
        C=Offset("O", Turn(OA, ref("bend"), length=ref("rho"))),
    )  # fmt: skip


PAPERS = {
    "hitch": (hitch(), ThreePointHitch),
    "header balancer": (balancer(), HeaderBalancer),
    "mower lift": (mower_lift(), MowerLift),
    "forestry crane": (crane(), CraneOnColumn),
    "grapple": (grapple(), Grapple),
}


# -- machines of all kinds -----------------------------------------------------------------------------------


@pair
class Lever:
    """a lever, placed from the cylinder's pin"""

    class Vectors(Mechanism):
        S = Stroke(0.0, 0.2)
        L0, r = Dimension(0.55), Dimension(0.175)
        A, O = Ground(0.0, 0.242), Ground(0.652, 0.330)
        L = S + L0                                          # the same sum, in another order and under a name
        AO = Vector(A, O)
        B = Offset(A, Turn(AO, -CosineAngle(abs(AO), L0 + S, r), length=L))
        load = Weight(B, mass=100.0)

    class Steps(Mechanism):
        S = Stroke(0.0, 0.2)
        A, O = Ground(0.0, 0.242), Ground(0.652, 0.330)
        B = Dyad(A, O, AB=0.55 + S, OB=0.175, side=RIGHT)
        load = Weight(B, mass=100.0)


@pair
class FourBar:
    """a crank and rocker with a coupler point"""

    class Vectors(Mechanism):
        phi = Stroke(0.3, 2.8)
        O, C = Ground(0.0, 0.0), Ground(1.0, 0.0)
        A = Offset(O, Turn(Vector(O, C), phi, length=0.3))
        AC = Vector(A, C)
        CAB = CosineAngle(0.9, distance(A, C), 0.7)         # the sides in the other order
        AB = Turn(AC, CAB, length=0.9)
        B = Offset(A, AB)
        P = Offset(A, Turn(AB, 20 * deg, length=0.5))
        load = Weight(P, mass=10.0)

    class Steps(Mechanism):
        phi = Stroke(0.3, 2.8)
        O, C = Ground(0.0, 0.0), Ground(1.0, 0.0)
        A = Crank(O, OA=0.3, angle=phi)
        B = Dyad(A, C, AB=0.9, CB=0.7, side=LEFT)
        P = OnLink(A, B, AP=0.5, BAP=20 * deg)
        load = Weight(P, mass=10.0)


@pair
class KeptLength:
    """a crank as long as the vector that is turned"""

    class Vectors(Mechanism):
        phi = Stroke(0.3, 2.8)
        O, X, C = Ground(0.0, 0.0), Ground(0.3, 0.0), Ground(1.0, 0.0)
        OA = Turn(Vector(O, X), phi)
        A = Offset(O, OA)
        AC = Vector(A, C)
        B = Offset(A, Turn(AC, -CosineAngle(abs(AC), 0.9, 0.7), length=0.9))
        torque = Moment("C B", M=20.0)

    class Steps(Mechanism):
        phi = Stroke(0.3, 2.8)
        O, X, C = Ground(0.0, 0.0), Ground(0.3, 0.0), Ground(1.0, 0.0)
        A = Crank(O, OA=0.3, angle=phi)
        B = Dyad(A, C, AB=0.9, CB=0.7, side=RIGHT)
        torque = Moment("C B", M=20.0)


@pair
class Watt:
    """a Watt six-bar: a second dyad on the coupled rocker"""

    class Vectors(Mechanism):
        phi = Stroke(0.6, 2.2)
        O, C, E = Ground(0.0, 0.0), Ground(1.0, 0.0), Ground(2.0, 0.1)
        A = Offset(O, Turn(Vector(O, C), phi, length=0.3))
        AC = Vector(A, C)
        B = Offset(A, Turn(AC, CosineAngle(abs(AC), 0.9, 0.7), length=0.9))
        CB = Vector(C, B)
        D = Offset(C, Turn(CB, -CosineAngle(abs(CB), 0.6, 0.4), length=0.6))
        DE = Vector(D, E)
        F = Offset(D, Turn(DE, CosineAngle(abs(DE), 0.8, 0.7), length=0.8))
        load = Weight(F, mass=5.0)

    class Steps(Mechanism):
        phi = Stroke(0.6, 2.2)
        O, C, E = Ground(0.0, 0.0), Ground(1.0, 0.0), Ground(2.0, 0.1)
        A = Crank(O, OA=0.3, angle=phi)
        B = Dyad(A, C, AB=0.9, CB=0.7, side=LEFT)
        D = OnLink(C, B, CD=0.6, BD=0.4, side=RIGHT)
        F = Dyad(D, E, DF=0.8, EF=0.7, side=LEFT)
        load = Weight(F, mass=5.0)


@pair
class Stephenson:
    """a Stephenson six-bar: a dyad on the coupler"""

    class Vectors(Mechanism):
        phi = Stroke(0.5, 2.0)
        O, C, E = Ground(0.0, 0.0), Ground(1.0, 0.0), Ground(0.9, 1.3)
        A = Offset(O, Turn(Vector(O, C), phi, length=0.25))
        AC = Vector(A, C)
        AB = Turn(AC, CosineAngle(abs(AC), 0.9, 0.7), length=0.9)
        B = Offset(A, AB)
        P = Offset(A, Turn(AB, 30 * deg, length=0.6))
        PE = Vector(P, E)
        Q = Offset(E, Turn(Vector(E, P), CosineAngle(abs(PE), 0.5, 0.55), length=0.5))
        load = Weight(Q, mass=5.0)

    class Steps(Mechanism):
        phi = Stroke(0.5, 2.0)
        O, C, E = Ground(0.0, 0.0), Ground(1.0, 0.0), Ground(0.9, 1.3)
        A = Crank(O, OA=0.25, angle=phi)
        B = Dyad(A, C, AB=0.9, CB=0.7, side=LEFT)
        P = OnLink(A, B, AP=0.6, BAP=30 * deg)
        Q = Dyad(E, P, EQ=0.5, PQ=0.55, side=LEFT)
        load = Weight(Q, mass=5.0)


@pair
class TwoCylinders:
    """a boom and an arm, each on its cylinder"""

    class Vectors(Mechanism):
        S, T = Stroke(0.0, 0.4), Stroke(0.0, 0.3)
        O, P = Ground(0.0, 1.0), Ground(0.3, 0.2)
        PO = Vector(P, O)
        B = Offset(P, Turn(PO, -CosineAngle(abs(PO), 0.8 + S, 0.7), length=0.8 + S))
        OB = Vector(O, B)
        C = Offset(O, Turn(OB, 0, length=2.0))
        Q = Offset(O, Turn(OB, 0.2, length=1.2))
        QC = Vector(Q, C)
        D = Offset(C, Turn(Vector(C, Q), -CosineAngle(abs(QC), 0.4, 0.75 + T), length=0.4))
        G = Offset(C, Turn(Vector(C, D), 2.6, length=1.5))
        load = Weight(G, mass=300.0)

    class Steps(Mechanism):
        S, T = Stroke(0.0, 0.4), Stroke(0.0, 0.3)
        O, P = Ground(0.0, 1.0), Ground(0.3, 0.2)
        B = Dyad(P, O, PB=0.8 + S, OB=0.7, side=RIGHT)
        C = OnLink(O, B, OC=2.0)
        Q = OnLink(O, B, OQ=1.2, BOQ=0.2)
        D = Dyad(C, Q, CD=0.4, QD=0.75 + T, side=RIGHT)
        G = OnLink(C, D, CG=1.5, DCG=2.6)
        load = Weight(G, mass=300.0)


@pair
class Telescope:
    """a boom on a cylinder with a telescope in it"""

    class Vectors(Mechanism):
        S, T = Stroke(0.0, 0.4), Stroke(0.0, 0.5)
        O, P = Ground(0.0, 1.0), Ground(0.3, 0.2)
        PO = Vector(P, O)
        B = Offset(P, Turn(PO, -CosineAngle(abs(PO), 0.8 + S, 0.7), length=0.8 + S))
        OB = Vector(O, B)
        C = Offset(O, Turn(OB, 0.3, length=2.0))
        E = Offset(O, Turn(OB, 0.3, length=2.0 + T))
        load = Weight(E, mass=300.0)

    class Steps(Mechanism):
        S, T = Stroke(0.0, 0.4), Stroke(0.0, 0.5)
        O, P = Ground(0.0, 1.0), Ground(0.3, 0.2)
        B = Dyad(P, O, PB=0.8 + S, OB=0.7, side=RIGHT)
        C = OnLink(O, B, OC=2.0, BOC=0.3)
        E = OnLink(O, B, OE=2.0 + T, BOE=0.3)
        load = Weight(E, mass=300.0)


@pair
class LugOnTelescope:
    """a telescope whose arm carries a lug and a rod"""

    class Vectors(Mechanism):
        S, T = Stroke(0.0, 0.4), Stroke(0.0, 0.5)
        O, P = Ground(0.0, 1.0), Ground(0.3, 0.2)
        PO = Vector(P, O)
        B = Offset(P, Turn(PO, -CosineAngle(abs(PO), 0.8 + S, 0.7), length=0.8 + S))
        OB = Vector(O, B)
        OE = Turn(OB, 0, length=2.0 + T)
        E = Offset(O, OE)
        F = Offset(E, Turn(OE, -90 * deg, length=0.3))
        load = Weight(F, mass=300.0)

    class Steps(Mechanism):
        S, T = Stroke(0.0, 0.4), Stroke(0.0, 0.5)
        O, P = Ground(0.0, 1.0), Ground(0.3, 0.2)
        B = Dyad(P, O, PB=0.8 + S, OB=0.7, side=RIGHT)
        E = OnLink(O, B, OE=2.0 + T)
        F = OnLink(E, O, EF=0.3, OEF=90 * deg)
        load = Weight(F, mass=300.0)


@pair
class RelativeCrank:
    """an arm turned by a drive on a boom that is turned by a drive"""

    class Vectors(Mechanism):
        phi, psi = Stroke(0.2, 1.0), Stroke(1.5, 2.6)
        O, X = Ground(0.0, 0.0), Ground(1.0, 0.0)
        J = Offset(O, Turn(Vector(O, X), phi, length=2.0))
        K = Offset(J, Turn(Vector(J, O), psi, length=1.4))
        load = Weight(K, mass=50.0)

    class Steps(Mechanism):
        phi, psi = Stroke(0.2, 1.0), Stroke(1.5, 2.6)
        O, X = Ground(0.0, 0.0), Ground(1.0, 0.0)
        J = Crank(O, OJ=2.0, angle=phi)
        K = Crank(J, JK=1.4, angle=angle(J, O) + psi)
        load = Weight(K, mass=50.0)


@pair
class TurnedTelescope:
    """an arm that a drive turns on a boom and a stroke pushes out"""

    class Vectors(Mechanism):
        phi, psi, T = Stroke(0.2, 1.0), Stroke(1.5, 2.6), Stroke(0.0, 0.4)
        O, X = Ground(0.0, 0.0), Ground(1.0, 0.0)
        J = Offset(O, Turn(Vector(O, X), phi, length=2.0))
        K = Offset(J, Turn(Vector(J, O), psi, length=1.4 + T))
        load = Weight(K, mass=50.0)

    class Steps(Mechanism):
        phi, psi, T = Stroke(0.2, 1.0), Stroke(1.5, 2.6), Stroke(0.0, 0.4)
        O, X = Ground(0.0, 0.0), Ground(1.0, 0.0)
        J = Crank(O, OJ=2.0, angle=phi)
        K = OnLink(J, O, JK=1.4 + T, OJK=psi)
        load = Weight(K, mass=50.0)


@pair
class Pushed:
    """a crosshead that a stroke pushes along a line of the frame, and a rocker on it"""

    class Vectors(Mechanism):
        S = Stroke(0.0, 0.3)
        O, X, C = Ground(0.0, 0.0), Ground(1.0, 0.0), Ground(1.2, 0.3)
        A = Offset(O, Turn(Vector(O, X), 0, length=0.3 + S))
        AC = Vector(A, C)
        B = Offset(A, Turn(AC, CosineAngle(abs(AC), 0.8, 0.5), length=0.8))
        load = Weight(B, mass=40.0)

    class Steps(Mechanism):
        S = Stroke(0.0, 0.3)
        O, X, C = Ground(0.0, 0.0), Ground(1.0, 0.0), Ground(1.2, 0.3)
        A = OnLink(O, X, OA=0.3 + S)
        B = Dyad(A, C, AB=0.8, CB=0.5, side=LEFT)
        load = Weight(B, mass=40.0)


@pair
class ManyTurns:
    """a plate whose points are turned from turned vectors, and from the far end back"""

    class Vectors(Mechanism):
        S = Stroke(0.0, 0.2)
        L0, r = Dimension(0.55), Dimension(0.175)
        A, O = Ground(0.0, 0.242), Ground(0.652, 0.330)
        OA = Vector(O, A)
        OB = Turn(OA, CosineAngle(r, abs(OA), L0 + S), length=r)
        B = Offset(O, OB)
        first = Turn(Turn(OB, 0.3), 0.2, length=0.4)
        C = Offset(O, first)
        D = Offset(C, Turn(first, 100 * deg, length=0.25))
        E = Offset(D, Turn(Vector(B, O), -40 * deg, length=0.3))
        load = Weight(E, mass=80.0)

    class Steps(Mechanism):
        S = Stroke(0.0, 0.2)
        A, O = Ground(0.0, 0.242), Ground(0.652, 0.330)
        B = Dyad(O, A, OB=0.175, AB=0.55 + S, side=LEFT)
        C = OnLink(O, B, OC=0.4, BOC=0.5)
        D = OnLink(C, O, CD=0.25, OCD=-80 * deg)
        E = OnLink(D, C, DE=0.3, CDE=220 * deg - 0.5)
        load = Weight(E, mass=80.0)


@pair
class BetweenBodies:
    """a cylinder between two bodies that both move"""

    class Vectors(Mechanism):
        phi, S = Stroke(0.3, 1.2), Stroke(0.0, 0.2)
        O, X = Ground(0.0, 0.0), Ground(1.0, 0.0)
        OJ = Turn(Vector(O, X), phi, length=1.5)
        J = Offset(O, OJ)
        H = Offset(O, Turn(OJ, 10 * deg, length=0.9))
        JH = Vector(J, H)
        K = Offset(J, Turn(JH, CosineAngle(distance(J, H), 0.4, 0.55 + S), length=0.4))
        T = Offset(J, Turn(Vector(J, K), 150 * deg, length=1.1))
        load = Weight(T, mass=60.0)

    class Steps(Mechanism):
        phi, S = Stroke(0.3, 1.2), Stroke(0.0, 0.2)
        O, X = Ground(0.0, 0.0), Ground(1.0, 0.0)
        J = Crank(O, OJ=1.5, angle=phi)
        H = OnLink(O, J, OH=0.9, JOH=10 * deg)
        K = Dyad(J, H, JK=0.4, HK=0.55 + S, side=LEFT)
        T = OnLink(J, K, JT=1.1, KJT=150 * deg)
        load = Weight(T, mass=60.0)


@pair
class FramePoint:
    """a pivot that is itself offset in the frame"""

    class Vectors(Mechanism):
        S = Stroke(0.0, 0.2)
        A, X = Ground(0.0, 0.2), Ground(1.0, 0.2)
        O = Offset(A, Turn(Vector(A, X), 15 * deg, length=0.66))
        AO = Vector(A, O)
        B = Offset(A, Turn(AO, -CosineAngle(0.66, 0.55 + S, 0.2), length=0.55 + S))
        load = Weight(B, mass=100.0)

    class Steps(Mechanism):
        S = Stroke(0.0, 0.2)
        A, X = Ground(0.0, 0.2), Ground(1.0, 0.2)
        O = OnLink(A, X, AO=0.66, XAO=15 * deg)
        B = Dyad(A, O, AB=0.55 + S, OB=0.2, side=RIGHT)
        load = Weight(B, mass=100.0)


@pair
class SprungLever:
    """a lever with a spring on it"""

    class Vectors(Mechanism):
        phi = Stroke(0.2, 1.0)
        O, C = Ground(0.0, 0.0), Ground(0.0, 0.8)
        OA = Turn(Vector(O, C), -phi, length=0.6)
        A = Offset(O, OA)
        spring = Spring(A, C, stiffness=5e3, free_length=0.3)
        load = Weight(A, mass=30.0)

    class Steps(Mechanism):
        phi = Stroke(0.2, 1.0)
        O, C = Ground(0.0, 0.0), Ground(0.0, 0.8)
        A = Crank(O, OA=0.6, angle=90 * deg - phi)
        spring = Spring(A, C, stiffness=5e3, free_length=0.3)
        load = Weight(A, mass=30.0)


@pair
class Excavator:
    """boom, arm and bucket, three cylinders, a bell crank"""

    class Vectors(Mechanism):
        S1, S2, S3 = Stroke(0.0, 0.4), Stroke(0.0, 0.3), Stroke(0.0, 0.2)
        A, O = Ground(0.35, 0.2), Ground(0.0, 1.2)
        AO = Vector(A, O)
        B = Offset(A, Turn(AO, -CosineAngle(abs(AO), 1.0 + S1, 0.9), length=1.0 + S1))
        OB = Vector(O, B)
        J = Offset(O, Turn(OB, 8 * deg, length=3.0))
        H = Offset(O, Turn(OB, 20 * deg, length=2.2))
        HJ = Vector(H, J)
        K = Offset(H, Turn(HJ, CosineAngle(abs(HJ), 0.9 + S2, 0.45), length=0.9 + S2))
        JK = Vector(J, K)
        T = Offset(J, Turn(JK, 160 * deg, length=1.6))
        M = Offset(J, Turn(JK, 150 * deg, length=1.1))
        U = Offset(J, Turn(JK, 120 * deg, length=0.4))
        UM = Vector(U, M)
        V = Offset(M, Turn(Vector(M, U), CosineAngle(abs(UM), 0.35, 0.65 + S3), length=0.35))
        VT = Vector(V, T)
        W = Offset(T, Turn(Vector(T, V), -CosineAngle(abs(VT), 0.5, 0.6), length=0.5))
        G = Offset(T, Turn(Vector(T, W), 100 * deg, length=0.6))
        load = Weight(G, mass=500.0)

    class Steps(Mechanism):
        S1, S2, S3 = Stroke(0.0, 0.4), Stroke(0.0, 0.3), Stroke(0.0, 0.2)
        A, O = Ground(0.35, 0.2), Ground(0.0, 1.2)
        B = Dyad(A, O, AB=1.0 + S1, OB=0.9, side=RIGHT)
        J = OnLink(O, B, OJ=3.0, BOJ=8 * deg)
        H = OnLink(O, B, OH=2.2, BOH=20 * deg)
        K = Dyad(H, J, HK=0.9 + S2, JK=0.45, side=LEFT)
        T = OnLink(J, K, JT=1.6, KJT=160 * deg)
        M = OnLink(J, K, JM=1.1, KJM=150 * deg)
        U = OnLink(J, K, JU=0.4, KJU=120 * deg)
        V = Dyad(M, U, MV=0.35, UV=0.65 + S3, side=LEFT)
        W = Dyad(T, V, TW=0.5, VW=0.6, side=RIGHT)
        G = OnLink(T, W, TG=0.6, WTG=100 * deg)
        load = Weight(G, mass=500.0)


@pair
class Parallelogram:
    """a parallelogram lift, both rockers by their lengths"""

    class Vectors(Mechanism):
        phi = Stroke(0.4, 1.2)
        O, C = Ground(0.0, 0.0), Ground(0.0, 0.4)
        A = Offset(O, Turn(Vector(O, C), -phi, length=1.2))
        AC = Vector(A, C)
        B = Offset(A, Turn(AC, -CosineAngle(abs(AC), 0.4, 1.2), length=0.4))
        G = Offset(A, Turn(Vector(A, B), -70 * deg, length=0.7))
        load = Weight(G, mass=90.0)

    class Steps(Mechanism):
        phi = Stroke(0.4, 1.2)
        O, C = Ground(0.0, 0.0), Ground(0.0, 0.4)
        A = Crank(O, OA=1.2, angle=90 * deg - phi)
        B = Dyad(A, C, AB=0.4, CB=1.2, side=RIGHT)
        G = OnLink(A, B, AG=0.7, BAG=-70 * deg)
        load = Weight(G, mass=90.0)


@pair
class Toggle:
    """a toggle press: a cylinder on the knee of two links"""

    class Vectors(Mechanism):
        S = Stroke(0.0, 0.12)
        A, O, C = Ground(-0.6, 0.5), Ground(0.0, 1.0), Ground(0.8, 0.1)
        AO = Vector(A, O)
        K = Offset(A, Turn(AO, -CosineAngle(abs(AO), 0.45 + S, 0.5), length=0.45 + S))
        KC = Vector(K, C)
        L = Offset(K, Turn(KC, -CosineAngle(abs(KC), 0.5, 0.75), length=0.5))
        load = Weight(L, mass=200.0)

    class Steps(Mechanism):
        S = Stroke(0.0, 0.12)
        A, O, C = Ground(-0.6, 0.5), Ground(0.0, 1.0), Ground(0.8, 0.1)
        K = Dyad(A, O, AK=0.45 + S, OK=0.5, side=RIGHT)
        L = Dyad(K, C, KL=0.5, CL=0.75, side=RIGHT)
        load = Weight(L, mass=200.0)


@pair
class Chain:
    """a triangle turned by the sum of two corners: the second one's base is known by the first"""

    class Vectors(Mechanism):
        S = Stroke(0.0, 0.15)
        O, A = Ground(0.0, 0.0), Ground(1.0, 0.0)
        OA = Vector(O, A)
        AOB = CosineAngle(abs(OA), 0.5, 0.6 + S)
        BOC = CosineAngle(0.5, 0.7, 0.4)
        B = Offset(O, Turn(OA, AOB, length=0.5))
        C = Offset(O, Turn(OA, AOB + BOC, length=0.7))
        load = Weight(C, mass=25.0)

    class Steps(Mechanism):
        S = Stroke(0.0, 0.15)
        O, A = Ground(0.0, 0.0), Ground(1.0, 0.0)
        B = Dyad(O, A, OB=0.5, AB=0.6 + S, side=LEFT)
        C = OnLink(O, B, OC=0.7, BC=0.4, side=LEFT)
        load = Weight(C, mass=25.0)


@pair
class BuiltTriangle:
    """a dyad whose base is a turned vector, and no vector between points"""

    class Vectors(Mechanism):
        phi, S = Stroke(0.5, 1.5), Stroke(0.0, 0.2)
        O, X = Ground(0.0, 0.0), Ground(1.0, 0.0)
        OA = Turn(Vector(O, X), phi, length=0.8)
        A = Offset(O, OA)
        B = Offset(O, Turn(OA, CosineAngle(0.8, 0.5 + S, 0.6), length=0.5 + S))
        C = Offset(A, Turn(Vector(A, B), 0.4, length=0.9))
        load = Weight(C, mass=15.0)

    class Steps(Mechanism):
        phi, S = Stroke(0.5, 1.5), Stroke(0.0, 0.2)
        O, X = Ground(0.0, 0.0), Ground(1.0, 0.0)
        A = Crank(O, OA=0.8, angle=phi)
        B = Dyad(O, A, OB=0.5 + S, AB=0.6, side=LEFT)
        C = OnLink(A, B, AC=0.9, BAC=0.4)
        load = Weight(C, mass=15.0)


@pair
class DrawingIn:
    """a cylinder that shortens as its stroke grows, over a bell crank"""

    class Vectors(Mechanism):
        S = Stroke(0.0, 0.2)
        A, O, E = Ground(-0.7, 0.3), Ground(0.0, 0.0), Ground(0.9, 0.5)
        L = 0.9 - S
        AO = Vector(A, O)
        B = Offset(A, Turn(AO, CosineAngle(abs(AO), L, 0.35), length=L))
        C = Offset(O, Turn(Vector(O, B), -95 * deg, length=0.4))
        CE = Vector(C, E)
        D = Offset(C, Turn(CE, CosineAngle(abs(CE), 0.7, 0.5), length=0.7))
        load = Weight(D, mass=35.0)

    class Steps(Mechanism):
        S = Stroke(0.0, 0.2)
        A, O, E = Ground(-0.7, 0.3), Ground(0.0, 0.0), Ground(0.9, 0.5)
        B = Dyad(A, O, AB=0.9 - S, OB=0.35, side=LEFT)
        C = OnLink(O, B, OC=0.4, BOC=-95 * deg)
        D = Dyad(C, E, CD=0.7, ED=0.5, side=LEFT)
        load = Weight(D, mass=35.0)
