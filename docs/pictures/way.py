"""Draw the data's way of docs/design.md: `python docs/pictures/way.py`, into docs/images."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patches import FancyArrowPatch, FancyBboxPatch

from linkage.pictures import style

IMAGES = Path(__file__).parents[1] / "images"
WIDE, HIGH = 9.6, 6.4  # inch, which are the sheet's units
BOX = 1.6, 0.74
CLASS, DESIGN, POSE, SIDE = "#dbe7f3", "#e4efdc", "#f6e7d2", "#eceef0"

BOXES = {  # its middle, what it is, the file, its colour
    "request": (3.5, 5.75, "Request", "motion/requests.py", CLASS),
    "class": (1.1, 4.3, "class", "steps/, loads/", CLASS),
    "plan": (3.5, 4.3, "Plan", "plan/plan.py", CLASS),
    "program": (6.0, 4.3, "Program", "plan/trace.py", CLASS),
    "code": (8.5, 4.3, "code", "program/*_backend.py", CLASS),
    "instance": (1.1, 2.75, "instance", "mechanism.py", DESIGN),
    "grid": (4.75, 2.75, "Grid", "motion/grid.py", POSE),
    "kernel": (8.5, 2.75, "Kernel", "program/kernel.py", CLASS),
    "reading": (4.75, 1.2, "eager reading", "plan/reading.py", SIDE),
    "motion": (8.5, 1.2, "Motion", "motion/motion.py", POSE),
}
ARROWS = (  # from, to, what happens, where its words stand
    ("request", "plan", "bound: nodes, refusals, shape, error", (1.22, 0.0)),
    ("class", "plan", "bound once", (0.0, 0.16)),
    ("plan", "program", "traced once", (0.0, 0.16)),
    ("program", "code", "written", (0.0, 0.16)),
    ("code", "kernel", "loaded", (0.33, 0.0)),
    ("class", "instance", "dimensions", (0.45, 0.0)),
    ("instance", "grid", "designs × strokes", (0.0, 0.16)),
    ("grid", "kernel", "inputs", (0.0, 0.16)),
    ("kernel", "motion", "values, guards", (0.56, 0.0)),
    ("grid", "reading", "flagged poses", (0.55, 0.0)),
    ("reading", "motion", "words, repairs", (0.0, 0.16)),
)


def box(ax: Axes, name: str) -> None:
    """Draw one station of the way."""
    x, y, text, file, colour = BOXES[name]
    wide, high = BOX
    shape = "round,pad=0,rounding_size=0.1"
    ax.add_patch(FancyBboxPatch((x - wide / 2, y - high / 2), wide, high, boxstyle=shape, fc=colour, ec=style.INK, lw=1.1))
    ax.text(x, y + 0.13, text, ha="center", va="center", fontsize=12, fontweight="bold", color=style.INK)
    ax.text(x, y - 0.17, file, ha="center", va="center", fontsize=8.5, color=style.INK)


def arrow(ax: Axes, start: str, end: str, text: str, beside: tuple[float, float]) -> None:
    """Draw one step of the way, with what happens there beside its middle."""
    (x, y), (u, v) = BOXES[start][:2], BOXES[end][:2]
    edge = BOX[0] * 36 if abs(v - y) < 0.1 else BOX[1] * 36
    line = FancyArrowPatch((x, y), (u, v), arrowstyle="-|>", mutation_scale=13, lw=1.3, color=style.INK, shrinkA=edge, shrinkB=edge)
    ax.add_patch(line)
    ax.text((x + u) / 2 + beside[0], (y + v) / 2 + beside[1], text, ha="center", va="center", fontsize=8.5, color=style.MUTED)


def way() -> Figure:
    """Return the picture."""
    figure = Figure(figsize=(WIDE, HIGH), dpi=120, facecolor=style.PAPER)
    FigureCanvasAgg(figure)
    ax = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    ax.set(xlim=(0.0, WIDE), ylim=(0.0, HIGH), aspect="equal")
    ax.axis("off")
    legend = ("once a class", 0.3, CLASS), ("once a design", 1.75, DESIGN), ("once a pose", 3.32, POSE), ("at few poses", 4.72, SIDE)
    for text, x, colour in legend:
        ax.text(x, 0.35, text, fontsize=10, color=style.INK, bbox={"fc": colour, "ec": "none", "boxstyle": "round,pad=0.25"})
    for each in ARROWS:
        arrow(ax, *each)
    for name in BOXES:
        box(ax, name)
    return figure


PICTURES: dict[str, Callable[[], Figure]] = {"way": way}

if __name__ == "__main__":
    way().savefig(IMAGES / "way.png", metadata={"Software": None})
