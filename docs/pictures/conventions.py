"""Draw the pictures of docs/conventions.md and of oil lines: `python docs/pictures/conventions.py`, into docs/images.

One unit of every sheet is an inch, so that a sheet is as wide as it is shown: 7 inches, some 700 pixels.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import cos, hypot, pi, radians, sin
from pathlib import Path
from typing import Literal

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patches import Circle, FancyArrowPatch, FancyBboxPatch, Polygon
from matplotlib.patheffects import withStroke

from linkage.pictures import style
from linkage.pictures.drawing import MarkPart, body_part, dot, ground, pin
from linkage.pictures.scene import DrawnCylinder, DrawnMark, Plate
from linkage.pictures.shapes import BLOCK, LONG, tube
from linkage.pictures.style import STRONG

Place = tuple[float, float]

IMAGES = Path(__file__).parents[1] / "images"
WIDE = 7.0
SIZE = 0.085
"""Radius of a bar's round end, the measure of every symbol."""

BLUE, _, GREEN, SAND, VIOLET, _, _, MAUVE, GREY, _ = style.BODIES
DOWN, UP, LEFT, RIGHT = -pi / 2, pi / 2, pi, 0.0


# -- what the sheets are made of ---------------------------------------------------------------------------


def sheet(height: float, titles: Sequence[tuple[float, str]] = ()) -> tuple[Figure, Axes]:
    """Return an empty sheet with a title over each of its parts, which begin at given x."""
    figure = Figure(figsize=(WIDE, height), dpi=style.DPI, facecolor=style.PAPER)
    FigureCanvasAgg(figure)
    ax = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    ax.set(xlim=(0.0, WIDE), ylim=(0.0, height), aspect="equal")
    ax.axis("off")
    for x, title in titles:
        ax.text(x, height - 0.24, title, fontsize=style.LABEL, fontweight="bold", color=style.INK, va="center")
    return figure, ax


def shifted(at: Place, way: float, by: float) -> Place:
    """Return a place some way off in a direction [rad]."""
    return at[0] + by * cos(way), at[1] + by * sin(way)


def direction(start: Place, end: Place) -> float:
    """Return the direction of one place from another [rad]."""
    return float(np.arctan2(end[1] - start[1], end[0] - start[0]))


def word(
    ax: Axes, at: Place, text: str, colour: str = style.INK, *, size: float = style.TEXT, name: bool = False, code: bool = False,
    ha: Literal["left", "center", "right"] = "center",
) -> None:  # fmt: skip
    """Write a word: plain, a point's name, or code."""
    ax.text(
        *at, text, fontsize=style.LABEL if name else size, color=colour, ha=ha, va="center" if "\n" in text else "center_baseline",
        fontstyle="italic" if name else "normal", family="DejaVu Sans Mono" if code else "DejaVu Sans", zorder=30.0, linespacing=1.35,
        path_effects=[withStroke(linewidth=2.5, foreground=style.PAPER)],
    )  # fmt: skip


def arrow(ax: Axes, start: Place, end: Place, colour: str = style.ACCENT, width: float = 2.0, both: bool = False) -> None:
    """Draw an arrow, thick for a force, thin for a measure."""
    head = "<|-|>" if both else "-|>"
    form = FancyArrowPatch(
        start, end, arrowstyle=head, mutation_scale=7.0 + 3.0 * width, color=colour, linewidth=width, shrinkA=0, shrinkB=0
    )
    form.set(joinstyle="miter", zorder=25.0)
    ax.add_patch(form)


def turn(ax: Axes, centre: Place, radius: float, start: float, end: float, colour: str = style.ACCENT, width: float = 1.6) -> None:
    """Draw an arrow round a centre from one direction to another [rad]."""
    ways = np.linspace(start, end, 60)
    x, y = centre[0] + radius * np.cos(ways), centre[1] + radius * np.sin(ways)
    ax.plot(x[:-6], y[:-6], color=colour, linewidth=width, zorder=25.0, solid_capstyle="butt")
    arrow(ax, (float(x[-9]), float(y[-9])), (float(x[-1]), float(y[-1])), colour, width)


def line(ax: Axes, *places: Place, colour: str = style.MUTED, width: float = style.OUTLINE, broken: bool = False) -> None:
    """Draw a thin line, broken where it is only thought."""
    x, y = zip(*places, strict=True)
    ax.plot(x, y, color=colour, linewidth=width, linestyle=(0, (5, 3)) if broken else "-", zorder=5.0)


def body(ax: Axes, colour: str, *places: Place) -> None:
    """Draw a rigid body: a bar, or a plate with its corners counter-clockwise."""
    named = {str(i): np.array(each) for i, each in enumerate(places)}
    body_part(ax, Plate(tuple(named), np.eye(len(named))), SIZE, colour, STRONG).update(named)


def pins(ax: Axes, *places: Place) -> None:
    """Draw joints."""
    for each in places:
        pin(ax, "P", SIZE, STRONG).update({"P": np.array(each)})


def dots(ax: Axes, *places: Place) -> None:
    """Draw points that are no joints."""
    for each in places:
        dot(ax, "P", SIZE, STRONG).update({"P": np.array(each)})


def frame(ax: Axes, at: Place, way: float = DOWN) -> None:
    """Draw the frame under a pin."""
    ground(ax, np.array(at), way, 0.8 * SIZE, STRONG)


def cylinder(ax: Axes, A: Place, B: Place, out: float = 0.5) -> None:
    """Draw a cylinder from A to B, its piston at a share of the barrel."""
    length = hypot(B[0] - A[0], B[1] - A[1])
    mouth = 0.62 * length
    piston = 2.4 * SIZE + out * (mouth - 3.6 * SIZE)
    drawn = DrawnCylinder("A", "B", 0.0, 1.4 * SIZE, mouth, length - piston, 2.0 * SIZE, mouth - 0.9 * SIZE)
    MarkPart(ax, drawn.mark(SIZE), STRONG).update({"A": np.array(A), "B": np.array(B)})


def along(A: Place, B: Place, steps: Sequence[tuple[float, float]]) -> list[Place]:
    """Return places given along and across a line, in shares of it and in inches."""
    way = direction(A, B)
    return [shifted(shifted(A, way, share * hypot(B[0] - A[0], B[1] - A[1])), way + pi / 2, aside) for share, aside in steps]


def spring(ax: Axes, A: Place, B: Place) -> None:
    """Draw a spring from A to B."""
    teeth = [(0.2 + 0.6 * (i + 0.5) / 10, 0.09 * (-1) ** i) for i in range(10)]
    line(ax, *along(A, B, [(0.0, 0.0), (0.2, 0.0), *teeth, (0.8, 0.0), (1.0, 0.0)]), colour=style.PISTON, width=1.6)


def damper(ax: Axes, A: Place, B: Place) -> None:
    """Draw a damper from A to B."""
    rods, piston = ([(0.0, 0.0), (0.32, 0.0)], [(0.52, 0.0), (1.0, 0.0)]), [(0.52, 0.1), (0.52, -0.1)]
    for steps in (*rods, piston, [(0.66, 0.12), (0.32, 0.12), (0.32, -0.12), (0.66, -0.12)]):
        line(ax, *along(A, B, steps), colour=style.PISTON, width=1.6)


def rail(ax: Axes, start: Place, end: Place) -> None:
    """Draw a level guide: its line under the blocks, hatched."""
    y = start[1] - 1.25 * SIZE
    line(ax, (start[0], y), (end[0], y), colour=style.INK, width=1.6)
    for x in np.arange(start[0] + SIZE, end[0], 0.1):
        line(ax, (float(x), y), (float(x) - SIZE, y - SIZE), colour=style.INK, width=style.THIN)


def slider(ax: Axes, at: Place, way: float = RIGHT) -> None:
    """Draw a block that slides in a direction [rad]."""
    box = tube(0.0, -LONG * SIZE, 0.0, LONG * SIZE, BLOCK * SIZE, "RULE")
    MarkPart(ax, DrawnMark("P", ("P", "Q"), (box,), 0.17, 1.0), STRONG).update({"P": np.array(at), "Q": np.array(shifted(at, way, 1.0))})


# -- the pictures ------------------------------------------------------------------------------------------


def axes_and_gravity() -> Figure:
    """Return the plane's directions, and what a slope does to gravity."""
    figure, ax = sheet(2.7, [(0.25, "Axes and angles"), (3.75, "slope = 10 deg")])
    O = 0.55, 0.55
    for end, name in (((2.95, 0.55), "x"), ((0.55, 2.15), "y")):
        arrow(ax, O, end, style.INK, 1.2)
        word(ax, (end[0] + 0.12, end[1]), name, name=True)
    P, way = (1.15, 1.0), radians(35)
    Q = shifted(P, way, 1.5)
    line(ax, P, (2.6, 1.0), broken=True)
    arrow(ax, P, Q, style.CURVE)
    dots(ax, P, Q)
    word(ax, (P[0] - 0.16, P[1]), "P", name=True)
    word(ax, (Q[0] + 0.16, Q[1] + 0.06), "Q", name=True)
    turn(ax, P, 0.8, 0.0, way)
    word(ax, (2.52, 1.26), "angle(P, Q) > 0", style.ACCENT, code=True, size=9.0)
    arrow(ax, (3.2, 1.9), (3.2, 1.25), style.PISTON)
    word(ax, (3.36, 1.58), "g", style.PISTON, name=True)

    foot, rise = (3.95, 0.5), radians(10)
    top = shifted(foot, rise, 2.6)
    line(ax, foot, (top[0], foot[1]), broken=True)
    line(ax, foot, top, colour=style.INK, width=1.6)
    for share in np.arange(0.06, 1.0, 0.045):
        at = shifted(foot, rise, 2.6 * float(share))
        line(ax, at, shifted(at, rise - radians(135), 0.12), colour=style.INK, width=style.THIN)
    turn(ax, foot, 1.55, 0.0, rise, width=1.2)
    word(ax, (5.75, 0.64), "slope", style.ACCENT, code=True, size=9.0)
    origin = shifted(foot, rise, 0.55)
    for turned, long, name in ((0.0, 2.25, "x"), (pi / 2, 1.3, "y")):
        end = shifted(origin, rise + turned, long)
        arrow(ax, origin, end, style.INK, 1.2)
        word(ax, shifted(end, rise + turned, 0.13), name, name=True)
    G = shifted(shifted(origin, rise, 1.15), rise + pi / 2, 0.95)
    arrow(ax, G, (G[0], G[1] - 0.72), style.PISTON)
    arrow(ax, G, shifted(G, rise + pi, 0.42), style.ACCENT)
    dots(ax, G)
    word(ax, (G[0] + 0.17, G[1] + 0.08), "G", name=True)
    word(ax, (G[0] + 0.3, G[1] - 0.5), "m g", style.PISTON)
    word(ax, (G[0] - 0.42, G[1] + 0.2), "also towards −x", style.ACCENT, size=9.0)
    return figure


def thrust() -> Figure:
    """Return what a positive and a negative thrust are, for every two-point element."""
    figure, ax = sheet(3.35, [(0.25, "thrust > 0: pushes its ends apart"), (3.75, "thrust < 0: pulls its ends together")])
    rows = (
        (0.0, 2.45, cylinder, 1, 'Cylinder, works="piston"'),
        (0.0, 1.2, spring, 1, "Spring, shorter than free_length"),
        (3.5, 2.45, cylinder, -1, 'Cylinder, works="rod"'),
        (3.5, 1.2, damper, -1, "Damper, while AB grows"),
    )
    for left, y, element, sense, text in rows:
        A, B = (left + 1.0, y), (left + 2.5, y)
        element(ax, A, B)
        for at, side, name in ((A, -1, "A"), (B, 1, "B")):
            body(ax, GREY, (at[0], y + 0.02), (at[0], y - 0.42))
            near, far = ((at[0] + side * away, y) for away in (0.12, 0.64))
            arrow(ax, *((near, far) if sense > 0 else (far, near)))
            word(ax, (at[0], y + 0.24), name, name=True)
        pins(ax, A, B)
        word(ax, (left + 1.75, y - 0.66), text, style.MUTED, size=9.0)
    word(ax, (3.5, 0.2), "arrows: the forces on the two bodies, at A and at B", style.ACCENT, size=9.0)
    return figure


def sides() -> Figure:
    """Return the two sides of a dyad and of a slider."""
    figure, ax = sheet(2.85, [(0.25, "B = Dyad(P, Q, ..., side=)"), (3.75, "B = SliderDyad(P, guide, ..., side=)")])
    P, Q = (0.7, 1.25), (2.6, 1.35)
    up, low = (1.45, 2.2), (1.55, 0.38)
    for B in (up, low):
        body(ax, BLUE, P, B)
        body(ax, SAND, Q, B)
    arrow(ax, shifted(P, direction(P, Q), 0.12), shifted(Q, direction(Q, P), 0.16), style.INK, 1.2)
    pins(ax, P, Q, up, low)
    for at, name in (
        ((P[0] - 0.2, P[1]), "P"),
        ((Q[0] + 0.2, Q[1]), "Q"),
        ((up[0] - 0.2, up[1] + 0.05), "B"),
        ((low[0] - 0.22, low[1]), "B"),
    ):
        word(ax, at, name, name=True)
    word(ax, (1.72, 1.58), "LEFT", style.ACCENT, code=True)
    word(ax, (1.72, 0.98), "RIGHT", style.ACCENT, code=True)
    word(ax, (2.62, 2.0), "as seen walking\nfrom P to Q", style.MUTED, size=9.0)

    P, y = (5.15, 1.85), 0.85
    rail(ax, (3.85, y), (6.75, y))
    ends = (4.25, y), (6.05, y)
    for B, name in zip(ends, ("LEFT", "RIGHT"), strict=True):
        slider(ax, B)
        body(ax, BLUE, P, B)
        word(ax, (B[0], y - 0.42), name, style.ACCENT, code=True)
        word(ax, (B[0] + (0.24 if name == "RIGHT" else -0.24), y + 0.24), "B", name=True)
    pins(ax, P, *ends)
    word(ax, (P[0], P[1] + 0.22), "P", name=True)
    arrow(ax, (4.72, y), (5.58, y), style.INK, 1.2)
    word(ax, (5.15, y + 0.17), "guide's direction", style.MUTED, size=9.0)
    return figure


def labels() -> Figure:
    """Return one angle by its two names."""
    figure, ax = sheet(2.45, [(0.25, "BOG = 40 deg"), (3.75, "GOB = −40 deg")])
    for left, start, end, text in (
        (0.0, 10, 50, "from OB to OG:\ncounter-clockwise, positive"),
        (3.5, 50, 10, "from OG to OB:\nclockwise, negative"),
    ):
        O = left + 0.75, 0.75
        B, G = shifted(O, radians(10), 1.45), shifted(O, radians(50), 1.35)
        body(ax, BLUE, O, B, G)
        frame(ax, O)
        turn(ax, O, 0.72, radians(start), radians(end))
        pins(ax, O, B)
        dots(ax, G)
        for at, name in ((shifted(O, radians(150), 0.24), "O"), (shifted(B, 0.0, 0.22), "B"), (shifted(G, radians(60), 0.24), "G")):
            word(ax, at, name, name=True)
        word(ax, (left + 1.35, 0.35), text, style.ACCENT, size=9.0, ha="left")
    return figure


def pin_force() -> Figure:
    """Return one pin force, on either of the two bodies."""
    figure, ax = sheet(3.0, [(0.25, "Pin C joins two bodies"), (2.95, "force on the rod"), (5.05, "force on the arm")])
    force = radians(95)

    def arm(O: Place) -> Place:
        C, B = shifted(O, radians(20), 1.1), shifted(O, radians(-24), 0.95)
        body(ax, GREEN, O, B, C)
        return C

    def rod(C: Place) -> None:
        D = shifted(C, force + pi, 1.3)
        body(ax, BLUE, C, D)
        pins(ax, D)
        word(ax, (D[0] + 0.22, D[1]), "D", name=True)

    O = 0.5, 1.75
    C = arm(O)
    rod(C)
    frame(ax, O)
    pins(ax, O, C, shifted(O, radians(-24), 0.95))
    word(ax, (C[0], C[1] + 0.24), "C", name=True)
    word(ax, (O[0] - 0.05, O[1] + 0.24), "O", name=True)
    word(ax, (1.37, 1.12), "B", name=True)

    C = 3.5, 1.95
    rod(C)
    arrow(ax, C, shifted(C, force, 0.62))
    pins(ax, C)
    word(ax, (C[0] + 0.22, C[1]), "C", name=True)
    word(ax, (3.6, 0.24), '.force("C", on="CD")\n.by is "OBC"', style.ACCENT, code=True, size=9.0)

    O = 4.95, 1.95
    C = arm(O)
    arrow(ax, C, shifted(C, force + pi, 0.62))
    pins(ax, O, C, shifted(O, radians(-24), 0.95))
    word(ax, (C[0], C[1] + 0.24), "C", name=True)
    word(ax, (O[0] - 0.05, O[1] + 0.24), "O", name=True)
    word(ax, (5.82, 1.32), "B", name=True)
    word(ax, (5.85, 0.24), '.force("C", on="OBC")\n.by is "CD"', style.ACCENT, code=True, size=9.0)
    return figure


def cranks() -> Figure:
    """Return two cranks on one angle beside one bell crank."""
    figure, ax = sheet(2.6, [(0.25, "Two cranks on one angle: two bodies"), (3.75, "One bell crank: one body")])
    start = radians(25)
    for left in (0.0, 3.5):
        O = left + 1.35, 0.75
        A, B = shifted(O, start, 1.3), shifted(O, start + pi / 2, 1.0)
        if left:
            body(ax, GREEN, O, A, B)
        else:
            body(ax, BLUE, O, A)
            body(ax, SAND, O, B)
        frame(ax, O)
        line(ax, O, (O[0] + 1.5, O[1]), broken=True)
        turn(ax, O, 0.62, 0.0, start)
        if not left:
            turn(ax, O, 0.42, 0.0, start + pi / 2)
        pins(ax, O, A, B)
        for at, name in ((shifted(A, start, 0.22), "A"), (shifted(B, start + pi / 2, 0.24), "B"), (shifted(O, radians(200), 0.24), "O")):
            word(ax, at, name, name=True)
    word(ax, (2.22, 0.88), "phi", style.ACCENT, code=True, size=9.0)
    word(ax, (5.72, 0.88), "phi", style.ACCENT, code=True, size=9.0)
    word(ax, (1.5, 1.52), "phi + 90 deg", style.ACCENT, code=True, size=9.0, ha="left")
    word(ax, (1.35, 0.2), "a couple on OA and one on OB", style.MUTED, size=9.0)
    word(ax, (4.85, 0.2), "one couple on OAB", style.MUTED, size=9.0)
    return figure


def carriage() -> Figure:
    """Return a pin on a guide beside a rigid carriage."""
    figure, ax = sheet(2.55, [(0.25, "One point on the guide: its link turns"), (3.75, "Two points of one link: a carriage")])
    y = 0.85
    rail(ax, (0.35, y), (3.05, y))
    P, A = (1.2, y), (2.55, 1.75)
    slider(ax, P)
    body(ax, BLUE, P, A)
    turn(ax, P, 0.75, radians(8), radians(62))
    arrow(ax, (P[0], y - 0.62), (P[0], y - 0.1))
    pins(ax, P)
    dots(ax, A)
    word(ax, (P[0] - 0.22, y + 0.24), "P", name=True)
    word(ax, (A[0] + 0.18, A[1]), "A", name=True)
    word(ax, (2.1, 0.4), "a force across the\nguide, no moment", style.ACCENT, size=9.0)

    rail(ax, (3.85, y), (6.8, y))
    P, Q, G = (4.55, y), (5.95, y), (4.9, 1.8)
    slider(ax, P)
    slider(ax, Q)
    body(ax, SAND, P, Q, G)
    pins(ax, P, Q)
    dots(ax, G)
    arrow(ax, (P[0], y + 0.72), (P[0], y + 0.1))
    arrow(ax, (Q[0], y - 0.62), (Q[0], y - 0.1))
    arrow(ax, G, (G[0] + 0.75, G[1]), style.PISTON)
    word(ax, (P[0] - 0.24, y + 0.24), "P", name=True)
    word(ax, (Q[0] + 0.24, y + 0.24), "Q", name=True)
    word(ax, (G[0] - 0.05, G[1] + 0.2), "G", name=True)
    word(ax, (4.95, 0.4), "two forces: a moment", style.ACCENT, size=9.0)
    return figure


def strokes() -> Figure:
    """Return how a stroke's growing and a cylinder's go together, or not."""
    parts = [(0.25, "AB = L0 + S"), (2.65, "AB = L0 − S"), (4.95, "crank, angle = phi")]
    figure, ax = sheet(2.55, parts)
    for left, sense in ((0.0, 1), (2.4, -1)):
        A, B = (left + 0.45, 1.35), (left + 1.75, 1.35)
        cylinder(ax, A, B, 0.55)
        frame(ax, A, DOWN)
        pins(ax, A, B)
        arrow(ax, (B[0] - sense * 0.3, B[1] + 0.35), (B[0] + sense * 0.25, B[1] + 0.35), style.CURVE, 1.6)
        word(ax, (B[0] - 0.02, B[1] + 0.55), "S grows", style.CURVE, size=9.0)
        word(ax, (A[0] - 0.02, A[1] + 0.26), "A", name=True)
        word(ax, (B[0] + 0.22, B[1]), "B", name=True)
        says = "it comes out" if sense > 0 else "it draws in"
        word(ax, (left + 1.1, 0.42), f"S extending:\n{says}", style.MUTED, size=9.0)
    A, O = (5.25, 1.0), (5.25, 1.9)
    B = shifted(O, radians(-35), 1.05)
    cylinder(ax, A, B, 0.5)
    body(ax, BLUE, O, B)
    for at in (A, O):
        frame(ax, at, LEFT)
    turn(ax, O, 0.62, radians(-70), radians(-4), style.CURVE)
    pins(ax, A, B, O)
    for at, name in (((A[0] + 0.06, A[1] - 0.26), "A"), ((O[0] + 0.02, O[1] + 0.24), "O"), ((B[0] + 0.2, B[1] - 0.06), "B")):
        word(ax, at, name, name=True)
    word(ax, (6.4, 1.85), "phi grows", style.CURVE, size=9.0)
    word(ax, (6.05, 0.42), "phi extending:\nit comes out, here", style.MUTED, size=9.0)
    return figure


def gauge_and_absolute() -> Figure:
    """Return a pressure on its two scales."""
    figure, ax = sheet(2.25, [(0.25, "One pressure, two scales")])
    y, zero, air, line_at = 1.0, 0.75, 1.75, 6.05
    arrow(ax, (zero - 0.15, y), (6.75, y), style.INK, 1.2)
    for x, above, below in ((zero, "vacuum", "0"), (air, "atmosphere", "1.013 bar"), (line_at, "in the line", "101.013 bar")):
        line(ax, (x, y - 0.08), (x, y + 0.08), colour=style.INK, width=1.6)
        word(ax, (x, y + 0.62), above, style.MUTED, size=9.0)
        word(ax, (x, y - 0.24), below, size=9.0)
    arrow(ax, (air, y + 0.3), (line_at, y + 0.3), style.CURVE, 1.2, both=True)
    word(ax, (0.5 * (air + line_at), y + 0.47), "gauge: 100 bar, as circuits, cylinders and verdicts say it", style.CURVE, size=9.0)
    arrow(ax, (zero, y - 0.5), (line_at, y - 0.5), style.ACCENT, 1.2, both=True)
    word(ax, (0.5 * (zero + line_at), y - 0.7), "absolute: 101.013 bar, what the gas law works on", style.ACCENT, size=9.0)
    return figure


def pipe(ax: Axes, *places: Place) -> None:
    """Draw an oil line through some places."""
    x, y = zip(*places, strict=True)
    ax.plot(x, y, color=style.CURVE, linewidth=2.2, zorder=2.0, solid_joinstyle="round")


def pump(ax: Axes, at: Place) -> None:
    """Draw a pump: a circle with a triangle towards its line."""
    ax.add_patch(Circle(at, 0.17, facecolor=style.PAPER, edgecolor=style.INK, linewidth=1.4, zorder=6.0))
    corners = [shifted(at, UP, 0.17), shifted(at, 0.9, 0.08), shifted(at, pi - 0.9, 0.08)]
    ax.add_patch(Polygon(corners, facecolor=style.INK, zorder=7.0))


def tank(ax: Axes, at: Place) -> None:
    """Draw a tank: an open vessel under the end of its line."""
    x, y = at
    ax.plot([x - 0.2, x - 0.2, x + 0.2, x + 0.2], [y + 0.1, y - 0.15, y - 0.15, y + 0.1], color=style.INK, linewidth=1.4, zorder=6.0)


def gas(ax: Axes, at: Place) -> None:
    """Draw an accumulator: a vessel with its gas over the oil."""
    x, y = at
    vessel = FancyBboxPatch((x - 0.05, y - 0.14), 0.10, 0.28, boxstyle="round,pad=0.06", facecolor=style.PAPER, edgecolor=style.INK)
    vessel.set(linewidth=1.4, zorder=6.0)
    ax.add_patch(vessel)
    ax.plot([x - 0.11, x + 0.11], [y, y], color=style.INK, linewidth=1.0, zorder=7.0)
    corners = [(x - 0.05, y + 0.12), (x + 0.05, y + 0.12), (x, y + 0.04)]
    ax.add_patch(Polygon(corners, facecolor=style.PAPER, edgecolor=style.INK, zorder=7.0))


def oil() -> Figure:
    """Return two cylinders on a line of each kind: what lies on it, what is given and what answers."""
    kinds = (
        ("held", pump, "V, by the pose", "p"),
        ("closed", None, "V = oil", "p, and a length"),
        ("given", tank, "p of the tank", "V"),
        ("given, by gas", gas, "p, by the V taken", "V, and so p"),
    )
    figure, ax = sheet(3.5)
    for place, (kind, symbol, given, answer) in enumerate(kinds):
        x = 0.2 + 1.75 * place
        word(ax, (x + 0.62, 3.2), kind, size=style.LABEL)
        for at, out in ((x + 0.25, 0.62), (x + 1.0, 0.28)):
            cylinder(ax, (at, 1.62), (at, 2.5 + 0.5 * out), out)
            pipe(ax, (at, 1.62), (at, 1.25))
        pipe(ax, (x + 0.25, 1.25), (x + 1.0, 1.25))
        if symbol is not None:
            pipe(ax, (x + 0.625, 1.25), (x + 0.625, 0.95))
            symbol(ax, (x + 0.625, 0.86))
        word(ax, (x + 0.62, 0.42), f"given: {given}", style.CURVE, size=style.SMALL)
        word(ax, (x + 0.62, 0.18), f"answers: {answer}", style.ACCENT, size=style.SMALL)
    return figure


PICTURES: dict[str, Callable[[], Figure]] = {
    "conventions_axes": axes_and_gravity,
    "conventions_thrust": thrust,
    "conventions_sides": sides,
    "conventions_labels": labels,
    "conventions_pins": pin_force,
    "conventions_cranks": cranks,
    "conventions_carriage": carriage,
    "conventions_strokes": strokes,
    "conventions_pressure": gauge_and_absolute,
    "conventions_oil": oil,
}

if __name__ == "__main__":
    for name, draw in PICTURES.items():
        draw().savefig(IMAGES / f"{name}.png", metadata={"Software": None})
