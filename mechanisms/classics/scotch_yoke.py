"""The Scotch yoke. The dimension is illustrative."""

from __future__ import annotations

from math import pi

from linkage import Crank, Featured, Ground, Guide, Mechanism, Stroke, YokeDyad, x


class ScotchYoke(Mechanism):
    """Crank pin A glides in the cross slot of a yoke that slides along a rail; X is where slot and rail meet.

    Known for: harmonic motion without any error, x = OA cos(phi).
    """

    phi = Stroke(0.0, 2 * pi)  # crank angle, rad

    O = Ground(0.0, 0.0)
    rail = Guide((0.0, 0.0), angle=0.0)

    A = Crank(O, OA=0.050, angle=phi)
    X = YokeDyad(A, rail)
    travel = x(X)  # m

    about = Featured("travel", ["A"])
