"""The inverted slider-crank as it drives a shaping machine: crank and slotted lever.

Source: the quick-return motion of every textbook, such as Norton, "Design of Machinery", chapter 3; the dimensions
are illustrative.
"""

from __future__ import annotations

from math import pi

from linkage import LEFT, Crank, Featured, Ground, Guide, Mechanism, OnLink, PinSlotDyad, SliderDyad, Stroke, angle, deg, x


class InvertedSliderCrank(Mechanism):
    """Crank pin A glides in the slot of lever CR, whose end moves the ram E through rod RE.

    Known for: quick return. The lever swings through 2 arcsin(OA / OC), and the crank turns through pi plus that
    swing for the cutting stroke, through pi less it for the return.
    """

    phi = Stroke(0.0, 2 * pi)  # crank angle, rad

    O = Ground(0.0, 0.0)
    C = Ground(0.0, -0.300)
    rail = Guide((0.0, 0.200), angle=0.0)

    A = Crank(O, OA=0.120, angle=phi)
    R = PinSlotDyad(C, A, CR=0.480)  # the slotted lever's end
    E = SliderDyad(R, rail, RE=0.180, side=LEFT)  # the ram
    P = OnLink(R, E, RP=0.090, ERP=30 * deg)  # a point of the rod
    psi = angle(C, R)  # lever
    ram = x(E)  # m

    about = Featured("ram", ["A", "R"], coupler="P")
