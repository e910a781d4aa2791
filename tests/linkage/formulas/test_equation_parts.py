"""Equations of parts that stand turned, mirrored or on moving bodies: their numbers are the engine's."""

import numpy as np
from numpy.testing import assert_allclose

from linkage import LEFT, RIGHT, Crank, Dyad, Ground, Guide, Mechanism, OnLink, Part, SliderDyad, Stroke, angle, deg, equations
from tests.for_all import for_all


class Press(Mechanism):
    """A crank on a fixed pin drives a slider along a fixed guide, and another along a guide through the pin."""

    phi = Stroke(20 * deg, 70 * deg)
    O = Ground(0.1, 0.2)
    way, other = Guide((0.0, 0.1), angle=8 * deg), Guide(O, angle=-15 * deg)
    A = Crank(O, OA=0.2, angle=phi)
    C = SliderDyad(A, way, AC=0.5, side=RIGHT)
    D = SliderDyad(A, other, AD=0.6, side=RIGHT)
    psi = angle(C, A)


class Carrier(Mechanism):
    """A four-bar on whose coupler something stands."""

    phi = Stroke(20 * deg, 70 * deg)
    O, Q = Ground(0, 0), Ground(1.0, 0.1)
    P = Crank(O, OP=0.4, angle=phi)
    X = Dyad(P, Q, PX=0.9, QX=0.6, side=LEFT)
    T = OnLink(P, X, PT=0.5, XPT=30 * deg)


@for_all("seed", (0, 3), slow=(1, 2, 4, 5))
def test_equations_of_a_part_give_where_it_stands(seed):
    random = np.random.default_rng(seed)
    x, y, turn = random.uniform(-1.0, 1.0, 3).tolist()
    carried = {"on": ("base.P", "base.X"), "mirrored": seed % 3 == 0, "angle": turn if seed > 2 else 0.0}
    options = [{"at": (x, y), "angle": turn, "mirrored": bool(seed % 2)}, carried]
    members = {f"part_{k}": Part(Press, phi="base.phi", **each) for k, each in enumerate(options)}
    machine = type("Whole", (Mechanism,), {"base": Part(Carrier), **members})()
    at = {"base.phi": float(random.uniform(25, 65)) * deg}
    values, motion = equations(machine).values(at=at), machine.at(**at)
    for name in members:
        for point in "ACD":
            assert_allclose(values[f"{name}.{point}"], motion[f"{name}.{point}"], rtol=0, atol=1e-13)
        assert_allclose(np.sin(0.5 * (values[f"{name}.psi"] - motion[f"{name}.psi"])), 0.0, atol=1e-13)
