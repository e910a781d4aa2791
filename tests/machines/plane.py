"""Plane geometry, virtual work, friction, gas and buckling by hand, for the machines of this folder. Nothing of the package.

A place is an array of two numbers, real or complex: every rule is analytic, so that a derivative is the imaginary part of
one evaluation (complex step), exact to rounding.
"""

import numpy as np

G = 9.80665
LEFT, RIGHT = 1.0, -1.0


def point(x, y):
    """Return a place."""
    return np.array([x, y])


def length(P, Q):
    """Return the distance of two places."""
    return np.sqrt((Q[0] - P[0]) ** 2 + (Q[1] - P[1]) ** 2)


def turned(v, angle):
    """Return a vector turned counter-clockwise."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([c * v[0] - s * v[1], s * v[0] + c * v[1]])


def left(v):
    """Return a vector turned by a right angle to its left."""
    return np.array([-v[1], v[0]])


def toward(P, Q):
    """Return the direction P -> Q, of length one."""
    return (Q - P) / length(P, Q)


def on(P, Q, along, across=0.0):
    """Return the place at `along` from P towards Q and `across` to the left of it."""
    e = toward(P, Q)
    return P + along * e + across * left(e)


def meet(P, p, Q, q, side):
    """Return the place p from P and q from Q, on a side of P -> Q: the cosine rule for the angle at P."""
    d = length(P, Q)
    cos = (p**2 + d**2 - q**2) / (2 * p * d)
    return on(P, Q, p * cos, side * p * np.sqrt(1 - cos**2))


def rate(places, q, k=0):
    """Return the derivative of every entry of `places(q)` by its k-th coordinate."""
    step = np.zeros(len(q), complex)
    step[k] = 1e-30j
    return {name: np.imag(value) / 1e-30 for name, value in places(np.asarray(q) + step).items()}


def stretch(places, q, P, Q, k=0):
    """Return d|PQ| over the k-th coordinate."""
    at, moved = places(np.asarray(q, float)), rate(places, q, k)
    return float(toward(at[P], at[Q]) @ (moved[Q] - moved[P]))


def work(places, q, loads, k=0):
    """Return the work of loads for a unit of the k-th coordinate: (place, force) pairs, or (angle, moment)."""
    moved = rate(places, q, k)
    return float(sum(np.sum(np.asarray(force) * moved[name]) for name, force in loads))


def balance(places, q, loads, cylinders):
    """Return the thrusts of as many cylinders (P, Q) as there are coordinates, by virtual work."""
    at, moved = places(np.asarray(q, float)), [rate(places, q, k) for k in range(len(q))]
    levers = [[toward(at[P], at[Q]) @ (each[Q] - each[P]) for P, Q in cylinders] for each in moved]
    return np.linalg.solve(levers, [-sum(np.dot(force, each[name]) for name, force in loads) for each in moved])


def rubbed(cut, pins, guides=()):
    """Return the joint forces of free bodies with dry friction, by repetition until nothing changes.

    `cut(force)` solves the free bodies, the friction being that of the forces `force(name)` of the round before; `pins` and
    `guides` are their names.
    """
    sizes = dict.fromkeys((*pins, *guides), 0.0)
    for _ in range(200):
        found = cut(sizes.__getitem__)
        now = {name: np.hypot(found[name + "x"], found[name + "y"]) for name in pins} | {name: found[name] for name in guides}
        if all(abs(now[name] - sizes[name]) <= 1e-15 * max(map(abs, now.values())) for name in sizes):
            return found
        sizes = now
    raise AssertionError("the friction does not settle")


def critical(rod, long):
    """Return the force at which a steel rod buckles, pinned at both ends: Euler, or Johnson's parabola where it is stout."""
    area, slender = np.pi / 4 * rod**2, 4 * long / rod
    stress = np.pi**2 * 210e9 / slender**2
    return area * (stress if stress <= 355e6 / 2 else 355e6 * (1 - 355e6 / (4 * stress)))


def annulus(bore, rod):
    """Return the area on the rod side."""
    return np.pi / 4 * (bore**2 - rod**2)


def disc(bore):
    """Return the area on the piston side."""
    return np.pi / 4 * bore**2


def isothermal_pressure(vessels, gas, atmosphere=101325.0):
    """Return the gauge pressure at which vessels (volume, gauge charge) hold together a volume of gas, by bisection."""
    low, high = min(charge for _, charge in vessels) + atmosphere, 1e10
    for _ in range(200):
        mid = np.sqrt(low * high)
        held = sum(volume * min(1.0, (charge + atmosphere) / mid) for volume, charge in vessels)
        low, high = (mid, high) if held > gas else (low, mid)
    return mid - atmosphere


def gas_of(vessels, pressure, atmosphere=101325.0):
    """Return the gas volume of vessels (volume, gauge charge) at a gauge pressure."""
    return sum(volume * min(1.0, (charge + atmosphere) / (pressure + atmosphere)) for volume, charge in vessels)


def peak(function, low, high, count=60):
    """Return the greatest value of a function of one number and where it is: a scan, then the golden section."""
    at = np.linspace(low, high, count + 1)
    values = [function(x) for x in at]
    k = int(np.argmax(values))
    a, b, golden = at[max(k - 1, 0)], at[min(k + 1, count)], (np.sqrt(5) - 1) / 2
    for _ in range(40):
        c, d = b - golden * (b - a), a + golden * (b - a)
        a, b = (a, d) if function(c) > function(d) else (c, b)
    best = max([(values[k], at[k]), (function((a + b) / 2), (a + b) / 2)])
    return best
