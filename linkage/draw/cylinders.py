"""Hydraulic cylinders: a barrel cut open, its piston, and the rod to the other end."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Polygon

from ..program import FloatArray
from . import style
from .part import Part, added
from .scene import Places, Ram
from .style import Look

#: part -> half its width, and half the thickness of the two that are discs, in sizes
WIDTH = {"eye": 0.62, "rod": 0.42, "barrel": 1.3, "piston": 1.12, "cap": 1.5}
THICK = {"piston": 0.45, "cap": 0.35}
FILL = {"eye": style.PISTON, "rod": style.ROD, "barrel": style.BARREL, "piston": style.PISTON, "cap": style.PISTON}


class CylinderPart(Part):
    """A cylinder from P to Q: the barrel is pinned at P, the rod at Q."""

    def __init__(self, ax: Axes, ram: Ram, size: float, look: Look) -> None:
        self.ram, self.size, self.points = ram, size, (ram.P, ram.Q)
        pieces = ("eye", "barrel", "rod", "piston", "cap")
        self.pieces = {name: added(ax, self._piece(name, look.level + 0.4 + 0.02 * layer, look)) for layer, name in enumerate(pieces)}
        self.artists = tuple(self.pieces.values())

    @staticmethod
    def _piece(name: str, level: float, look: Look) -> Polygon:
        return Polygon(
            np.zeros((1, 2)), facecolor=look.colour(FILL[name]), edgecolor=look.colour(style.INK),
            linewidth=0.8 * style.OUTLINE, joinstyle="round", zorder=level,
        )  # fmt: skip

    def move(self, at: Places) -> None:
        P, Q = at[self.ram.P], at[self.ram.Q]
        length = float(np.hypot(*(Q - P)))
        along = (Q - P) / (length or 1.0)
        P = P + self.ram.aside * np.array([-along[1], along[0]])
        for name, (start, end) in lengthwise(self.ram, length, self.size).items():
            self.pieces[name].set_xy(box(P, along, start, end, WIDTH[name] * self.size))


def lengthwise(ram: Ram, length: float, size: float) -> dict[str, tuple[float, float]]:
    """Return where each piece of a cylinder starts and ends, from P along to Q [m], at a length [m]."""
    piston = ram.piston(length)
    return {
        "eye": (0.0, ram.bottom),
        "barrel": (ram.bottom, ram.mouth),
        "rod": (piston, max(length, piston)),
        "piston": (piston - THICK["piston"] * size, piston + THICK["piston"] * size),
        "cap": (ram.mouth - THICK["cap"] * size, ram.mouth + THICK["cap"] * size),
    }


def box(P: FloatArray, along: FloatArray, start: float, end: float, half: float) -> FloatArray:
    """Return a box along a line from P, shape (4, 2) [m]."""
    across = half * np.array([-along[1], along[0]])
    near, far = P + start * along, P + end * along
    return np.array([near - across, far - across, far + across, near + across])
