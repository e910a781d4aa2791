"""Own evaluators: how far bars are from one another, as segments in complex numbers, and where the points of the machines stand."""

import numpy as np


def meet(P, p, Q, q, sense):
    """Return where circles about P and Q of the radii p and q meet, on the left of P -> Q for sense 1."""
    way = Q - P
    far = abs(way)
    part = (p**2 - q**2 + far**2) / (2.0 * far)
    with np.errstate(invalid="ignore"):
        high = np.sqrt(p**2 - part**2)
    return P + way / far * (part + 1j * sense * high)


def from_segment(P, A, B):
    """Return how far points P are from the segments AB, (n,)."""
    along = B - A
    share = np.clip(((P - A) * np.conj(along)).real / np.abs(along) ** 2, 0.0, 1.0)
    return np.abs(P - A - share * along)


def cross(a, b):
    return (np.conj(a) * b).imag


def apart(A, B, C, D):
    """Return how far the segments AB and CD are apart, (n,); zero where they cross."""
    ends = np.min([from_segment(A, C, D), from_segment(B, C, D), from_segment(C, A, B), from_segment(D, A, B)], axis=0)
    crossing = (cross(B - A, C - A) * cross(B - A, D - A) < 0.0) & (cross(D - C, A - C) * cross(D - C, B - C) < 0.0)
    return np.where(crossing, 0.0, ends)


def fixed(machine, name):
    """Return a fixed point as a complex number."""
    return complex(machine[f"{name}.x"], machine[f"{name}.y"])


def four_bar(machine, phi):
    """Return the points of a crank and rocker, B on the left of A -> C, complex (n,)."""
    O, C = fixed(machine, "O"), fixed(machine, "C")
    A = O + machine["OA"] * np.exp(1j * np.asarray(phi))
    B = meet(A, machine["AB"], C, machine["CB"], 1.0)
    return {"O": O + 0.0 * A, "C": C + 0.0 * A, "A": A, "B": B}


def pairs_apart(at, pairs):
    """Return the least distance of pairs of bars, "OA CB", at poses (n,)."""
    return np.min([apart(*(at[point] for bar in pair.split() for point in bar)) for pair in pairs], axis=0)
