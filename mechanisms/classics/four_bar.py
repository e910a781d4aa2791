"""The four-bar linkage in all its Grashof kinds.

Source: Norton, "Design of Machinery", chapter 4 (example 4-1: the crank-rocker's lengths and its open pose at 40
degrees); the lengths of the other kinds are illustrative. The kinds are Grashof's (1883): with the shortest and the
longest link s and l and the others p and q, some link turns fully where s + l <= p + q.
"""

from __future__ import annotations

from math import pi

from linkage import LEFT, Crank, Dyad, Featured, Ground, Mechanism, OnLink, Stroke, angle, deg


class FourBar(Mechanism):
    """Crank OA turns fully and swings rocker CB through coupler AB: a crank-rocker, P a point of its coupler.

    Known for: Freudenstein's equation K1 cos(psi) - K2 cos(phi) + K3 = cos(phi - psi) between crank phi and rocker
    psi. There K1 = OC/OA, K2 = OC/CB, K3 = (OA^2 - AB^2 + CB^2 + OC^2) / (2 OA CB).
    """

    phi = Stroke(0.0, 2 * pi)  # crank angle, rad

    O = Ground(0.0, 0.0)
    C = Ground(0.100, 0.0)

    A = Crank(O, OA=0.040, angle=phi)
    B = Dyad(A, C, AB=0.120, CB=0.080, side=LEFT)  # coupler and rocker
    P = OnLink(A, B, AP=0.070, BAP=30 * deg)  # a point of the coupler
    psi = angle(C, B)  # rocker
    theta = angle(A, B)  # coupler

    about = Featured("psi", ["P"], coupler="P")


class DragLink(FourBar):
    """The frame is the shortest link: both OA and CB turn fully (double crank, drag link)."""

    C = Ground(0.040, 0.0)
    A = Crank("O", OA=0.080, angle=FourBar.phi)
    B = Dyad(A, C, AB=0.100, CB=0.090, side=LEFT)


class DoubleRocker(FourBar):
    """The coupler is the shortest link: it can turn fully, OA and CB only rock (Grashof's double rocker)."""

    phi = Stroke(32 * deg, 90 * deg)  # it stops at 29.7 and 91.8 degrees
    A = Crank("O", OA=0.080, angle=phi)
    B = Dyad(A, "C", AB=0.040, CB=0.090, side=LEFT)


class TripleRocker(FourBar):
    """The shortest and the longest link outweigh the others: nothing turns fully (not Grashof)."""

    phi = Stroke(-100 * deg, 100 * deg)  # it stops at 105.9 degrees either way
    A = Crank("O", OA=0.060, angle=phi)
    B = Dyad(A, "C", AB=0.060, CB=0.070, side=LEFT)


class Parallelogram(FourBar):
    """Opposite links are equal (change-point linkage): CB stays parallel to OA, the coupler parallel to the frame.

    At 0 and 180 degrees all links lie in one line and it could go on as an antiparallelogram; the stroke keeps away.
    """

    phi = Stroke(20 * deg, 160 * deg)
    A = Crank("O", OA=0.060, angle=phi)
    B = Dyad(A, "C", AB=0.100, CB=0.060, side=LEFT)
