"""Pen and ruler for machines that are not shipped: circles that meet, turned vectors, exact slopes, virtual work. Nothing of the package.

A machine's own kinematics is a function of its strokes that returns every point's place, shape (2,) [m]. It is written with operations
that hold for complex numbers, so that a step along the imaginary axis gives its slopes to the last digit.
"""

import numpy as np

G = 9.80665
STEP = 1e-30


def turned(v, angle):
    """Return a vector turned counter-clockwise by an angle [rad]."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([c * v[0] - s * v[1], s * v[0] + c * v[1]])


def polar(length, angle):
    """Return the vector of a length [m] in a direction [rad]."""
    return np.array([length * np.cos(angle), length * np.sin(angle)])


def size(v):
    """Return a vector's length; it holds for complex parts, as hypot does not."""
    return np.sqrt(v[0] * v[0] + v[1] * v[1])


def unit(P, Q):
    """Return the direction P -> Q."""
    return (Q - P) / size(Q - P)


def cross(a, b):
    """Return a_x b_y - a_y b_x."""
    return a[0] * b[1] - a[1] * b[0]


def meet(P, p, Q, q, left):
    """Return the point p from P and q from Q, to the left of P -> Q or to the right: by the cosine rule and a right angle."""
    d = size(Q - P)
    along = (p * p - q * q + d * d) / (2.0 * d)
    up = np.sqrt(p * p - along * along) * (1.0 if left else -1.0)
    e = (Q - P) / d
    return P + along * e + up * np.array([-e[1], e[0]])


def beside(P, Q, length, angle):
    """Return the point at a length [m] from P, under an angle [rad] counter-clockwise from P -> Q."""
    return P + length * turned(unit(P, Q), angle)


def slopes(place, by, /, **strokes):
    """Return every point's slope over one stroke: a complex step, exact to rounding."""
    moved = place(**{**strokes, by: strokes[by] + 1j * STEP})
    return {name: np.imag(at) / STEP for name, at in moved.items()}


def stretch(at, slope, A, B):
    """Return the slope of a distance AB."""
    return unit(at[A], at[B]) @ (slope[B] - slope[A])


def power(slope, forces):
    """Return the work of forces [N] by point along the slopes of their points [N, N m]."""
    return sum(np.asarray(force) @ slope[point] for point, force in forces)


def weight(mass):
    """Return a weight [N], shape (2,)."""
    return np.array([0.0, -mass * G])


def over(poses, truth):
    """Return a truth of single poses as arrays over them, poses last, by name."""
    found = [truth(**{name: float(values[k]) for name, values in poses.items()}) for k in range(len(next(iter(poses.values()))))]
    return {name: np.stack([each[name] for each in found], axis=-1) for name in found[0]}


def critical(length, rod):
    """Return the thrust [N] at which a steel bar of a diameter [m] buckles between two pins: Euler's, below the transition Johnson's."""
    slender = length / (rod / 4.0)
    johnson = 355e6 * (1.0 - 355e6 * slender**2 / (4.0 * np.pi**2 * 210e9))
    return np.pi / 4.0 * rod**2 * np.where(slender >= np.pi * np.sqrt(2.0 * 210e9 / 355e6), np.pi**2 * 210e9 / slender**2, johnson)


def on_pin(forces, pin, body):
    """Return the sum of the listed joint forces at a pin that act on one body, whichever of several bodies carries the pin [N]."""
    found = [each.force if each.on == body else -each.force for each in forces.at(pin) if body in (each.on, each.by)]
    assert found, f"{body} is not listed at {pin}: {[(each.on, each.by) for each in forces.at(pin)]}"
    return sum(found)


def between(forces, pin, on, by):
    """Return the force at a pin on one body from another, where several joints meet [N]."""
    (found,) = [each for each in forces.at(pin) if {each.on, each.by} == {on, by} and each.has_force]
    return found.force if found.on == on else -found.force


def said_of(verdicts, rule):
    """Return the verdict on a rule."""
    (found,) = [each for each in verdicts if each.rule == rule]
    return found
