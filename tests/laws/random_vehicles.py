"""Random vehicles: the frame of a random machine with weights of its own, on two to four supports at random places."""

from functools import cache

import numpy as np

from linkage import Ground, LoadCase
from linkage.loads import Force, LinkMass, Support, Weight
from tests.laws.random_machines import random_machine


@cache
def random_vehicle(seed):
    """Return the class of a random machine on supports, with friction inside as the machine has it, and the names of the supports.

    Every third one stands on two supports, the others on three and four that give way. Its load cases `up` and `down` are slopes.
    """
    draft, random = random_machine(seed), np.random.default_rng([22, seed])
    count = 2 + seed % 3
    left = random.uniform(-6.0, -3.0)
    xs = left + np.array([0.0, *random.uniform(1.5, 5.0, count - 2), random.uniform(6.0, 9.0)])
    members = {}
    names = []
    for number in random.permutation(count):
        name, point = f"axle{number}", f"X{number}x"
        members[point] = Ground(float(xs[number]), float(random.uniform(-1.0, 0.5)))
        rough = {"friction": float(random.uniform(0.2, 0.9))} if random.random() < 0.6 else {}
        stiff = {"stiffness": float(random.uniform(0.2, 4.0) * 1e6)} if count > 2 else {}
        members[name] = Support(point, (float(random.uniform(-0.3, 0.3)), float(random.uniform(0.5, 2.0))), **rough, **stiff)
        names.append(name)
    members |= {"Vx": Ground(float(random.uniform(-1.0, 1.0)), 1.0), "Wx": Ground(left, float(random.uniform(0.0, 2.0)))}
    members |= {"hull": Weight("Vx", mass=float(random.uniform(500, 9000))), "plate": LinkMass("Vx Wx", mass=300.0, at=(0.4, 0.2))}
    members |= {"gust": Force("Wx", (float(random.uniform(-900, 900)), 100.0)), "upon": Weight("Wx", mass=80.0)}
    members |= {"up": LoadCase(slope=float(random.uniform(0.05, 0.3))), "down": LoadCase(slope=-0.2, gravity=(0.3, -9.0))}
    return type(f"Vehicle{seed}", (draft.drawn,), members), tuple(names)
