"""A forwarder's crane with a grapple on its tip: the forestry crane and both levers of the grapple, as they are shipped, joined.

Sources: those of `mechanisms.crane` and `mechanisms.grapple`; how the head hangs on the tip is illustrative.
"""

from __future__ import annotations

from linkage import Crank, Featured, Force, Link, LoadCase, Mechanism, Over, Part, Stroke, deg, ramp

from ..crane import Crane
from ..grapple import Grapple

HANGS = 0.95
"""From the crane's tip down to the centre of the largest stem, m."""


class Forwarder(Mechanism):
    """A crane, and hanging from its tip a head with the two levers of a grapple, `right` and its mirror image `left`.

    The levers press the stem against the head in right.T, which carries both pushes, `press`. Load and tool are the crane's crane.load.
    `loading` is the crane's own way with a stem held, `opening` the levers' whole way without one, the crane over the stakes.
    """

    phi = Stroke(15 * deg, 99.9262455066517 * deg)  # the crane's own strokes
    psi = Stroke(0 * deg, 180 * deg)
    t = Stroke(0.0, 2.532)
    swing = Stroke(-30 * deg, 30 * deg)  # of the head about the tip, from plumb
    theta = Stroke(23.913519201828226 * deg, -72.5116859213048 * deg)  # the grapple's, of its right and of its left lever
    twin = Stroke(23.913519201828226 * deg, -72.5116859213048 * deg)

    crane = Part(Crane, phi=phi, psi=psi, t=t, stems=None)
    R = Crank(crane.T, crane_TR=HANGS, angle=swing - 90 * deg)  # the centre of the largest stem
    head = Link(crane.T, R)
    right = Part(Grapple, theta=theta, on=(crane.T, R), at=(HANGS, 0.0), angle=90 * deg)
    left = Part(Grapple, theta=twin, on=(crane.T, R), at=(HANGS, 0.0), angle=90 * deg, mirrored=True)

    press = Force(right.T, (0.0, 2.0 * right.push * right.y_in))

    empty = LoadCase("empty", scale={"right.stem": 0.0, "left.stem": 0.0, "press": 0.0})
    loading = Over.path(
        phi=["crane.phi_k", 15 * deg, 15 * deg, 15 * deg], psi=[180 * deg, 180 * deg, 15 * deg, 15 * deg], t=[2.5, 2.5, 2.5, 0.0],
        swing=0.0, theta=-40 * deg, twin=-40 * deg, cases=["plain"],
    )  # fmt: skip
    opening = Over.path(
        phi=15 * deg, psi=15 * deg, t=0.0, swing=0.0, theta=[23.9 * deg, -72.5 * deg], twin=[23.9 * deg, -72.5 * deg], cases=["empty"],
    )  # fmt: skip

    about = Featured("crane.T_y", ["crane.T", "right.A"])


class LoadingForwarder(Forwarder):
    """The forwarder draws a stem in from afar, in seconds."""

    loading, opening = None, None  # type: ignore[assignment]
    cycle = Over.path(
        phi=ramp(60 * deg, 15 * deg, speed=12 * deg, acceleration=15 * deg),
        psi=ramp(150 * deg, 15 * deg, speed=20 * deg, acceleration=25 * deg), t=ramp(2.5, 0.0, speed=0.5, acceleration=0.5),
        swing=0.0, theta=-40 * deg, twin=-40 * deg, cases=["plain"],
    )  # fmt: skip
