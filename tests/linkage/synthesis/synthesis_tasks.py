"""Published tasks of path synthesis, the four-bar on which they are read, and an evaluator of its own, written in complex numbers."""

from math import pi

import numpy as np

from linkage import LEFT, RIGHT, Dyad, Ground, Mechanism, OnLink, Stroke, deg, mm


class Bar(Mechanism):
    """A four-bar whose crank is measured from its frame OC, as the papers do."""

    phi = Stroke(0.0, 2 * pi)

    O = Ground(0.0, 0.0)
    C = Ground(0.030, 0.0)

    A = OnLink(O, C, OA=0.010, COA=phi)
    B = Dyad(A, C, AB=0.030, CB=0.025, side=LEFT)
    P = OnLink(A, B, AP=0.020, BAP=30 * deg)


class OtherBar(Bar):
    """The same on its other branch."""

    B = Dyad("A", "C", AB=0.030, CB=0.025, side=RIGHT)


def box(most, least=0.01 * mm, *, held=False):
    """Return the papers' box: lengths to `most` [m], fixed points so far about the origin, or `held` with C on the axis."""
    lengths = {name: (least, most) for name in ("OA", "AB", "CB")} | {"AP": (1e-3 * mm, 1.5 * most), "BAP": (-pi, pi)}
    pivots = {f"{point}.{axis}": (-most, most) for point in "OC" for axis in "xy"}
    return lengths | ({"C.x": (least, most)} if held else pivots)


def places(machine, phi):
    """Return where P of a bar stands at crank angles, shape (2, n) [m], by the loop's circles; NaN where they miss."""
    O, C = (complex(machine[f"{point}.x"], machine[f"{point}.y"]) for point in "OC")
    along = (C - O) / abs(C - O)
    A = O + machine["OA"] * along * np.exp(1j * np.asarray(phi))
    way, b, c = C - A, machine["AB"], machine["CB"]
    far = abs(way)
    part = (b**2 - c**2 + far**2) / (2.0 * far)
    with np.errstate(invalid="ignore"):
        high = np.sqrt(b**2 - part**2)
    side = -1.0 if isinstance(machine, OtherBar) else 1.0
    B = A + way / far * (part + 1j * side * high)
    P = A + (B - A) / b * machine["AP"] * np.exp(1j * machine["BAP"])
    return np.array([P.real, P.imag])


LINE = [(20, 20), (20, 25), (20, 30), (20, 35), (20, 40), (20, 45)]
FIVE = [(3, 3), (2.759, 3.363), (2.372, 3.663), (1.89, 3.862), (1.355, 3.943)]
FIVE_AT = np.array([30, 45, 60, 75, 90]) * deg
EIGHTEEN = [
    (0.5, 1.1), (0.4, 1.1), (0.3, 1.1), (0.2, 1.0), (0.1, 0.9), (0.05, 0.75), (0.02, 0.6), (0, 0.5), (0, 0.4), (0.03, 0.3), (0.1, 0.25),
    (0.15, 0.2), (0.2, 0.3), (0.3, 0.4), (0.4, 0.5), (0.5, 0.7), (0.6, 0.9), (0.6, 1.0),
]  # fmt: skip
ARC = [(0, 0), (1.9098, 5.8779), (6.9098, 9.5106), (13.09, 9.5106), (18.09, 5.8779), (20, 0)]
ARC_AT = np.arange(30, 181, 30) * deg
ELLIPSE = [
    (20, 10), (17.66, 15.142), (11.736, 17.878), (5, 16.928), (0.60307, 12.736), (0.60307, 7.2638), (5, 3.0718), (11.736, 2.1215),
    (17.66, 4.8577), (20, 10),
]  # fmt: skip
TWELVE = [
    (4.15, 2.21), (4.5, 2.18), (4.53, 1.83), (4.13, 1.68), (3.67, 1.58), (2.96, 1.33), (2.67, 1.06), (2.63, 0.82), (2.92, 0.81),
    (3.23, 1.07), (3.49, 1.45), (3.76, 1.87),
]  # fmt: skip
TWENTY_FIVE = [
    (7.03, 5.99), (6.95, 5.45), (6.77, 5.03), (6.4, 4.6), (5.91, 4.03), (5.43, 3.56), (4.93, 2.94), (4.67, 2.6), (4.38, 2.2), (4.04, 1.67),
    (3.76, 1.22), (3.76, 1.97), (3.76, 2.78), (3.76, 3.56), (3.76, 4.34), (3.76, 4.91), (3.76, 5.47), (3.8, 5.98), (4.07, 6.4),
    (4.53, 6.75), (5.07, 6.85), (5.05, 6.84), (5.89, 6.83), (6.41, 6.8), (6.92, 6.58),
]  # fmt: skip
"""Points in mm. Sources: H. Nguyen-Van, N. D. K. Gwak, Symmetry 14 (2022) 381; R. Bulatovic, G. Miodragovic, M. Boskovic, Mech. Mach.
Theory 95 (2016) 1-21."""
