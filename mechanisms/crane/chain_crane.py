"""The crane whose second telescope section is drawn by chains, figure 2.2."""

from __future__ import annotations

from hydraulics import Cylinder, LiftCircuit
from linkage import Dimension, Link, MPa, OnLink, Rope, mm, ref

from .machine import Crane


class ChainCrane(Crane):
    """The telescope's cylinder pushes its first section, chains draw the second, which runs twice the cylinder's way (figure 2.2).

    Cylinder RD moves the first section DZ. `chain` runs from X on the arm over a sheave at D to the end Y of the second section and draws
    it out. `back` runs from K over a sheave at Z to Y and draws it in. The sheaves stand as pins along the arm; where is illustrative.
    """

    chain_bore, chain_rod = Dimension(90 * mm, unit="mm"), Dimension(56 * mm, unit="mm")
    chain_anchor, chain_tail = Dimension(1.2, unit="m"), Dimension(0.6, unit="m")  # X and Y from J, the telescope in
    first = 0.5 * ref("t")                                # how far the cylinder has pushed the first section, m
    D = OnLink("J", "K", JD=ref("l_p") + first)
    Z = OnLink(D, "J", DZ=ref("l_p") - 0.75 * chain_tail)
    X = OnLink("J", "K", JX=chain_anchor)
    chain = Rope(X, D, "Y", length=2.0 * ref("l_p") - chain_anchor - chain_tail)
    Y = OnLink("J", "K", JY=ref("l_p") + first - chain.last)
    T = OnLink(Y, "K", YT=ref("l_p") - chain_tail)
    back = Rope("K", Z, Y, against=chain)
    inner, outer = Link(D, Z), Link(Y, T)
    extend = Cylinder("R", D, bore=chain_bore, rod=chain_rod, works="both", closed=2.915, stroke=1.267)
    extend_line = LiftCircuit(extend, pressure=22 * MPa, mechanical_efficiency=0.95)
