"""The grapple: the lever's hinge from the stems it has to hold, its cylinder between two circles, the moment it needs: (2.67) to (2.94)."""

from __future__ import annotations

from typing import Any

import numpy as np

from hydraulics import Cylinder, LiftCircuit
from hydraulics.inputs import positive
from linkage import RIGHT, Column, Crank, Dyad, Featured, Ground, Guide, Mechanism, Motion, MPa, OnLink, Outline, Over, SliderDyad, deg, mm
from linkage.errors import DefinitionError
from linkage.language import said
from linkage.loads import Force, LoadCase
from linkage.quantities import Dimension, Quantity, Stroke, distance, ref, x, y
from linkage.verdict import Verdict

from .report import crosshead_verdicts, grapple_columns, grapple_verdicts


class Grapple(Mechanism):
    """Cylinder EC turns the lever AOC, whose end A presses the stem against the housing at T; the right-hand lever of the two.

    The section across the stem; the origin is the centre of the largest stem D_0, y up to the housing, where all stems rest on T. The
    lever's angle theta counts from where it holds D_0: opening_angle when open, 0 at D_0, -closing_angle at the smallest stem d_0. O lies
    at equal distances from both places of A and by hinge_gap off the largest stem. C lies on AO produced. E lies where the closed cylinder
    reaches the open lever and the extended one the closed lever. Of the two such places it is the one on `side_E` of the way of C (1 left,
    -1 right). The efficiency is the source's n; pressures are gauge; everything is of one lever.

    `gripping` is where it holds stems, D_0 and smaller; on the rest of its way, `travelling`, there is no stem, the case `empty`.

    The range of theta is that of the shipped stems and hinge; for others `grapple_for` makes a class with the range that they need.
    The moment M_1 that a stem needs is not in the source at hand: the force N_0 + N_2 D**2 of the lever on the stem, through its arm
    about O, is assumed. A subclass replaces M_1 by its own: any quantity of D, arm and theta.
    """

    theta = Stroke(23.913519201828226 * deg, -72.5116859213048 * deg)

    D_0 = Dimension(550 * mm, unit="mm")                        # the largest stem
    d_0 = Dimension(100 * mm, unit="mm")                        # the smallest one
    alpha = Dimension(55 * deg, unit="deg")                     # wrap angle at D_0
    beta = Dimension(5 * deg, unit="deg")                       # at d_0; above 0 the lever ends pass each other, on two levels
    hinge_gap = Dimension(85 * mm, unit="mm")                   # a_k: gap, lug, and the pin's or bush's radius
    opening = Dimension(1.3)                                    # opening angle over the one that lets the stem go
    bush = Dimension(25 * mm, unit="mm")                        # radius of the hinge's bush, which the cylinder passes

    bore = Dimension(50 * mm, unit="mm")
    rod = Dimension(28 * mm, unit="mm")
    S: Quantity = Dimension(250 * mm, unit="mm")                # the cylinder's stroke
    dead = Dimension(120 * mm, unit="mm")                       # its closed length beyond the stroke: dead + dead_bores bore
    dead_bores = Dimension(1.6)
    rho = Dimension(192.613145857 * mm, unit="mm")               # OC
    side_E = Dimension(-1.0)
    bend = Dimension(180 * deg, unit="deg")                     # the angle AOC

    T = Ground(0.0, D_0 / 2)
    x_0 = D_0 / 2 * np.cos(alpha)                               # A at D_0 (2.72), (2.73)
    y_0 = -D_0 / 2 * np.sin(alpha)
    x_1 = -d_0 / 2 * np.sin(beta)                               # A at d_0 (2.74), (2.75)
    y_1 = D_0 / 2 - d_0 / 2 * (1.0 + np.cos(beta))
    chord = np.sqrt((x_1 - x_0)**2 + (y_1 - y_0)**2)
    x_n = (y_1 - y_0) / chord                                   # across the chord, away from the stem
    y_n = (x_0 - x_1) / chord
    ahead = ((x_0 + x_1) * x_n + (y_0 + y_1) * y_n) / 2         # the chord's middle, seen from the origin along n and across it
    aside = ((x_0 + x_1) * y_n - (y_0 + y_1) * x_n) / 2
    off = np.sqrt((D_0 / 2 + hinge_gap)**2 - aside**2) - ahead  # of the two the hinge farther out
    O = Ground((x_0 + x_1) / 2 + off * x_n, (y_0 + y_1) / 2 + off * y_n)

    OA = np.sqrt((x_0 - x(O))**2 + (y_0 - y(O))**2)
    to_A = np.arctan2(y_0 - y(O), x_0 - x(O))                   # the direction O -> A at D_0
    closing_angle = 2.0 * np.arctan2(chord, 2.0 * off)          # 2 lambda (2.80)
    about_release = D_0 * (1.0 - np.cos(alpha)) / (2.0 * OA)    # (2.71), (2.82)
    outside = (D_0 / 2 - x(O)) / OA
    release_angle = -np.arctan2(np.sqrt(1.0 - outside**2), outside) - to_A  # where A stands beside the stem, exactly
    opening_angle = opening * about_release                     # beta_K (2.81)

    A = Crank(O, OA=OA, angle=to_A + theta)
    C = OnLink(O, A, OC=rho, AOC=bend)

    closed = S + dead + dead_bores * bore
    open_length = closed                                        # EC at the open lever (2.91)
    shut_length = closed + S                                    # EC at d_0 (2.92)
    x_open = x(O) + rho * np.cos(to_A + bend + opening_angle)   # C there
    y_open = y(O) + rho * np.sin(to_A + bend + opening_angle)
    dx = x(O) + rho * np.cos(to_A + bend - closing_angle) - x_open
    dy = y(O) + rho * np.sin(to_A + bend - closing_angle) - y_open
    way = dx**2 + dy**2
    u = (ref("open_length")**2 - ref("shut_length")**2 + way) / (2.0 * way)
    v = side_E * np.sqrt(ref("open_length")**2 / way - u**2)
    E = Ground(x_open + u * dx - v * dy, y_open + u * dy + v * dx)
    EC = distance(E, C)

    below = D_0 / 2 - y(A)                                      # A below the housing
    D = (x(A)**2 + below**2) / below                            # the stem that it holds there
    x_in = -2.0 * x(A) / D                                      # from A to the stem's centre, of length one
    y_in = 2.0 * below / D - 1.0
    x_E, y_E, y_D = x(E), y(E), (D_0 - D) / 2                   # the stem's centre stands at (0, y_D)
    room = abs(x_E * (y(C) - y_E) - (y_E - y_D) * (x(C) - x_E)) / EC - D / 2  # of the cylinder's axis beside the stem
    arm = (x(O) - x(A)) * y_in - (y(O) - y(A)) * x_in           # of the stem's push on the lever about O
    N_0 = Dimension(6000.0, unit="N")
    N_2 = Dimension(40000.0)                                    # N/m2
    M_1 = (N_0 + N_2 * D**2) * arm
    push = ref("M_1") / arm

    stem = Force(A, (-push * x_in, -push * y_in))
    lift = Cylinder(E, C, bore=bore, rod=rod, closed=closed, stroke=S)
    circuit = LiftCircuit(lift, pressure=20 * MPa, mechanical_efficiency=0.95)

    empty = LoadCase("empty", scale={"stem": 0.0})
    gripping = Over(only=[theta <= 0.0], cases=["plain"])
    travelling = Over(cases=["empty"])

    largest = Outline.circle(at=(0.0, 0.0), radius=D_0 / 2)     # the stems it holds and the housing above them, drawn only
    smallest = Outline.circle(at=(0.0, D_0 / 2 - d_0 / 2), radius=d_0 / 2)
    housing = Outline([(-0.05, D_0 / 2), (0.40, D_0 / 2), (0.40, D_0 / 2 + 0.03), (-0.05, D_0 / 2 + 0.03)])
    claw = Outline([(0, 0.03), (-0.02, -0.035), (0.08, -0.07), (0.24, -0.075), (0.35, -0.03), (0.35, 0.03), (0.08, -0.02)], on=(A, O))

    def __init__(self, **dimensions: Any) -> None:
        """Set the design [SI]; DefinitionError also for impossible values: no stem, a wrap of no angle, an unknown side."""
        super().__init__(**dimensions)
        for name in ("D_0", "d_0", "hinge_gap", "opening", "bush", "bore", "rod", "S", "rho"):
            if name in self.dimensions:
                positive(self[name], name)
        if "side_E" in self.dimensions and np.any(np.abs(np.asarray(self["side_E"])) != 1.0):
            raise DefinitionError(f"side_E = {self['side_E']}: 1 for the left of the way of C, -1 for the right.")
        if np.any(np.asarray(self["d_0"]) >= np.asarray(self["D_0"])):
            small, large = np.max(self["d_0"]) / mm, np.min(self["D_0"]) / mm
            raise DefinitionError(f"The smallest stem d_0 = {small:.4g} mm is not below the largest one, {large:.4g} mm; exchange them.")

    def columns(self, motion: Motion) -> list[Column]:
        """Return theta, the stem's diameter, the cylinder's length, H, M_g, M_1 and their ratio; no stem beyond D_0: NaN."""
        return grapple_columns(motion)

    def featured(self) -> Featured:
        """Return the moment given over the one that the stem takes, which holds it from 1 on, and the path of the lever's end A."""
        return Featured("M_g/M_1", ["A"], {"M_g/M_1": (1.0, said("too weak for the stem"), "below")})

    def rules(self, motion: Motion) -> list[Verdict]:
        """Return the verdicts: moment over the stems, way past the hinge, opening, stroke, E, the cylinder's size."""
        return grapple_verdicts(motion)


class InnerGrapple(Grapple):
    """The hinges exchanged: the cylinder at the inner one, on the stem's side of O; it closes by drawing in, with its rod side.

    The hinge O stands farther off the stem, and the lever is bent, so that the cylinder passes beside the stem. The dimensions are for the
    shipped stems and the assumed M_1.
    """

    theta = Stroke(19.579188239550977 * deg, -57.92040145485795 * deg)

    hinge_gap = Dimension(180 * mm, unit="mm")
    bore = Dimension(80 * mm, unit="mm")
    rod = Dimension(45 * mm, unit="mm")
    S = Dimension(160 * mm, unit="mm")
    rho = Dimension(130 * mm, unit="mm")
    side_E = Dimension(1.0)
    bend = Dimension(-20 * deg, unit="deg")
    open_length = ref("closed") + ref("S")
    shut_length = ref("closed") + 0.0
    lift = Cylinder("E", "C", bore="bore", rod="rod", closed="closed", stroke="S", works="rod")


class CrossheadGrapple(Grapple):
    """One cylinder on both levers: EK stands on the housing, its crosshead K slides along the axis, the links KC draw both pins C.

    It closes by drawing in, with its rod side. The stroke follows the levers' way, and E where the closed cylinder closes them. M_g is the
    share of one lever, a half of what the cylinder gives. The dimensions are for the shipped stems and the assumed M_1: of a grid of bends,
    OC, links of up to 0.9 m and standard bores those of the least bore with which the cylinder stands over the housing. Shorter links
    leave it no room there, so the head is about 1 m tall; the links run in front of the housing.
    """

    bore = Dimension(100 * mm, unit="mm")
    rod = Dimension(45 * mm, unit="mm")
    rho = Dimension(100 * mm, unit="mm")
    bend = Dimension(155 * deg, unit="deg")
    link = Dimension(900 * mm, unit="mm")                       # CK
    side_E = dx = dy = way = u = v = x_E = y_E = None           # type: ignore[assignment]

    x_shut = x("O") + ref("rho") * np.cos(ref("to_A") + ref("bend") - ref("closing_angle"))
    y_shut = y("O") + ref("rho") * np.sin(ref("to_A") + ref("bend") - ref("closing_angle"))
    K_open = ref("y_open") + np.sqrt(link**2 - ref("x_open")**2)
    K_shut = y_shut + np.sqrt(link**2 - x_shut**2)
    S: Quantity = K_open - K_shut
    open_length = ref("closed") + S
    shut_length = ref("closed") + 0.0
    E = Ground(0.0, K_shut - ref("closed"))
    axis = Guide(E, angle=90 * deg)
    K = SliderDyad("C", axis, CK=link, side=RIGHT)
    EC = distance(E, K)
    room = y(E) - (ref("D_0") / 2 + 0.03)                       # over the housing

    P = Ground(-x("O"), y("O"))                                 # the left-hand lever: P, B, G for O, A, C
    G = Dyad(K, P, KG=link, PG="rho", side=RIGHT)
    B = OnLink(P, G, PB="OA", GPB="bend")
    stem_left = Force(B, (ref("push") * ref("x_in"), -ref("push") * ref("y_in")))
    empty = LoadCase("empty", scale={"stem": 0.0, "stem_left": 0.0})

    lift = Cylinder(E, K, bore="bore", rod="rod", closed="closed", stroke=S, works="rod")

    def rules(self, motion: Motion) -> list[Verdict]:
        """Return the verdicts: moment over the stems, place over the housing, opening, stroke, hinge."""
        return crosshead_verdicts(motion)
