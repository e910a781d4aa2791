"""The whole crane: the skeleton with the cylinders of its boom, its arm and its telescope.

The boom's cylinder stands on the column, figure of (2.30); the arm's one turns a lever that a coupler joins to the arm, figure 2.14 a.
The default drives are the best of the source's examples for the first reading of (2.13): boom 125/70, arm 140/80 mm, at 22 MPa.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import ClassVar, Literal

from hydraulics import Cylinder, LiftCircuit
from linkage import LEFT, Dimension, Dyad, Ground, MPa, OnLink, Over, Stroke, deg, mm, ref

from .skeleton import CraneSkeleton

DRIVEN: Mapping[str, str] = MappingProxyType({"phi": "lift", "psi": "fold", "t": "extend"})
"""Which cylinder moves with which stroke."""


class Crane(CraneSkeleton):
    """Cylinder AB lifts the boom OJ; cylinder CN folds the arm JK by the lever VN and the coupler NE; cylinder RT pushes the telescope.

    Boom drive: A lies boom_r1 before and boom_r2 below O, B boom_r3 along the boom and boom_r4 under it. Arm drive: V lies
    arm_r4 before J on the boom, C arm_r5 before V and arm_r6 above it, the lever VN is arm_r1, the coupler NE arm_r2, the arm's lug
    JE arm_r3 long and `lug` off the arm. `bend` is the boom's bend at V. Every cylinder works with both sides.

    It runs from position to position of those that its skeleton is laid out by. `loading`: from the whole reach (2.10) the straight boom is
    lifted, the arm comes over the stakes (2.11), the telescope goes in, the arm folds down to the guard (2.13). `transport`: the
    boom goes level over the folded arm (2.14), (2.15). The telescope is in while the arm folds under load, as the source has it for the
    arm's drive (2.39): with it out and the arm folded, all that the strokes reach, the crane never carries its load. The load hangs
    everywhere here, level and on a side slope; `verdicts(over=Over())` asks the whole box.
    """

    reading: ClassVar[Literal[">=", "<="]] = "<="
    phi = Stroke(15 * deg, 99.9262455066517 * deg)        # phi_0 to phi_k
    t = Stroke(0.0, 2.532)
    l_c, l_p = Dimension(4.454601406907623, unit="m"), Dimension(3.165204914008807, unit="m")
    l_t = Dimension(2.532163931207046, unit="m")
    phi_0 = Dimension(15 * deg, unit="deg")

    boom_r1, boom_r2 = Dimension(0.2618294, unit="m"), Dimension(1.6706883884436237, unit="m")
    boom_r3, boom_r4 = Dimension(0.5925163333637224, unit="m"), Dimension(0.31633579788198307, unit="m")
    A = Ground(boom_r1, ref("H_p") + ref("h_0") - boom_r2)
    H = OnLink("O", "J", OH=boom_r3)
    B = OnLink(H, "O", HB=boom_r4, OHB=90 * deg)

    arm_r1, arm_r2 = Dimension(0.5634824610356947, unit="m"), Dimension(0.5056991910045654, unit="m")
    arm_r3, arm_r4 = Dimension(0.20803265972531704, unit="m"), Dimension(0.13215746111972135, unit="m")
    arm_r5, arm_r6 = Dimension(1.7535661783335663, unit="m"), Dimension(0.15, unit="m")
    lug = Dimension(113.26925656551386 * deg, unit="deg")
    bend = Dimension(0 * deg, unit="deg")
    V = OnLink("J", "O", JV=arm_r4)
    U = OnLink(V, "J", VU=arm_r5, JVU=180 * deg + bend)
    C = OnLink(U, V, UC=arm_r6, VUC=90 * deg)
    E = OnLink("J", "K", JE=arm_r3, KJE=lug)
    N = Dyad(V, E, VN=arm_r1, NE=arm_r2, side=LEFT)

    root_pin = Dimension(0.25, unit="m")                  # the telescope cylinder's pin on the arm, from J
    R = OnLink("J", "K", JR=root_pin)

    lift = Cylinder(A, B, bore=125 * mm, rod=70 * mm, works="both", closed=1.28505459, stroke=0.88505460)
    fold = Cylinder(C, N, bore=140 * mm, rod=80 * mm, works="both", closed=1.35074426, stroke=0.92674428)
    extend = Cylinder(R, "T", bore=63 * mm, rod=40 * mm, works="both", closed=2.915, stroke=2.533)
    lift_line = LiftCircuit(lift, pressure=22 * MPa, mechanical_efficiency=0.95)
    fold_line = LiftCircuit(fold, pressure=22 * MPa, mechanical_efficiency=0.95)
    extend_line = LiftCircuit(extend, pressure=22 * MPa, mechanical_efficiency=0.95)

    loading = Over.path(                                  # positions 1, 2 and 3 of POSITIONS, and between 1 and 2 one step after the other
        phi=["phi_k", phi_0, phi_0, phi_0, phi_0], psi=["psi_k", "psi_k", phi_0, phi_0, "psi_0"], t=[l_t, l_t, l_t, 0.0, 0.0],
        cases=["lifting", "side_slope"],
    )  # fmt: skip
    transport = Over.path(phi=[phi_0, 90 * deg], psi="psi_0", t=0.0, cases=["lifting", "side_slope"])  # positions 3 and 4
