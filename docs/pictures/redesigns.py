"""Draw the pictures of docs/redesigns.md: `python docs/pictures/redesigns.py`, into docs/images."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from hydraulics import reserve
from linkage import Mechanism, draw, kgf, kN, mm
from linkage.pictures import style
from linkage.pictures.sheet import quiet
from mechanisms.header_balancer import HeaderBalancer, over_following, with_header
from mechanisms.header_balancer.following import HeaderState
from mechanisms.mower_lift import MowerLift
from mechanisms.redesigns import FLAT_HITCH, STRONG_LIFT, steady_balancer
from mechanisms.three_point_hitch import ThreePointHitch
from mechanisms.three_point_hitch.capacity import capacity

IMAGES = Path(__file__).parents[1] / "images"
BEFORE, AFTER = style.ACCENT, style.CURVE


def sheet(*, wide: float = 12.0, high: float = 3.6, panels: int = 3) -> tuple[Figure, Sequence[Axes]]:
    """Return a sheet with panels side by side."""
    figure = Figure(figsize=(wide, high), dpi=style.DPI, facecolor=style.PAPER, layout="constrained")
    FigureCanvasAgg(figure)
    return figure, figure.subplots(1, panels, width_ratios=[1.0, 1.0, 1.25])


def machines(axes: Sequence[Axes], pair: Sequence[Mechanism], stroke: str) -> None:
    """Draw the machine before and after at both ends of its stroke, on sheets of one scale."""
    for ax, machine, title in zip(axes, pair, ("before", "after"), strict=False):
        one = machine.plan.strokes[stroke]
        motion = machine.at(**{stroke: [one.start, one.end]})
        draw(motion, ax=ax, pose=1, faint=True)
        draw(motion, ax=ax, pose=0)
        ax.set_title(title, fontsize=style.LABEL, color=style.INK)
    sides = [(ax.get_xlim(), ax.get_ylim()) for ax in axes[:2]]
    for ax in axes[:2]:
        ax.set(
            xlim=(min(x[0] for x, _ in sides), max(x[1] for x, _ in sides)), ylim=(min(y[0] for _, y in sides), max(y[1] for _, y in sides))
        )


def curves(ax: Axes, across: str, up: str) -> None:
    """Dress a panel of curves."""
    quiet(ax)
    ax.set_xlabel(across, fontsize=style.LABEL, color=style.INK)
    ax.set_title(up, fontsize=style.LABEL, color=style.INK)
    ax.legend(fontsize=style.SMALL, frameon=False)


def mower_lift() -> Figure:
    """Return the mower's lift and its reserve."""
    figure, axes = sheet()
    pair = MowerLift(), MowerLift(**STRONG_LIFT)
    machines(axes, pair, "S")
    for machine, colour, name in zip(pair, (BEFORE, AFTER), ("before", "after"), strict=True):
        motion = machine.sweep(201)
        axes[2].plot(motion.strokes["S"] / mm, motion[reserve("lift")], color=colour, label=name)
    axes[2].axhline(1.0, color=style.INK, linewidth=0.8, linestyle=(0, (5, 4)))
    axes[2].axhline(1.2, color=style.INK, linewidth=0.8, linestyle=(0, (1, 3)))
    curves(axes[2], "S, mm", "reserve kz at 155 kgf/cm$^2$")
    return figure


def hitch() -> Figure:
    """Return the hitch and its capacity."""
    figure, axes = sheet(high=3.2)
    pair = ThreePointHitch(), ThreePointHitch(**FLAT_HITCH)
    machines(axes, pair, "S")
    for machine, colour, name in zip(pair, (BEFORE, AFTER), ("before", "after"), strict=True):
        motion = machine.sweep(201)
        axes[2].plot(motion.strokes["S"] / mm, capacity(motion) / kN, color=colour, label=name)
    curves(axes[2], "S, mm", "lifted at G, kN")
    return figure


def balancer() -> Figure:
    """Return the balancer with header 1, and the reactions of all headers."""
    figure, axes = sheet(high=3.6)
    pair: tuple[HeaderBalancer, HeaderBalancer] = with_header(1), steady_balancer(1)
    machines(axes, pair, "h")
    for number, dashes in zip((1, 2, 3), ((1, 0), (5, 2), (1, 1)), strict=True):
        for machine, colour, name in ((with_header(number), BEFORE, "before"), (steady_balancer(number), AFTER, "after")):
            state = HeaderState(over_following(machine.at(h=0.0), 201))
            axes[2].plot(state.height / mm, state.free / kgf, color=colour, linestyle=(0, dashes), label=f"header {number} {name}")
    axes[2].set_ylim(bottom=0.0)
    curves(axes[2], "height of the shoe, mm", "reaction of the shoes without friction, kgf")
    return figure


PICTURES: dict[str, Callable[[], Figure]] = {"redesigns_mower_lift": mower_lift, "redesigns_hitch": hitch, "redesigns_balancer": balancer}

if __name__ == "__main__":
    for name, make in PICTURES.items():
        make().savefig(IMAGES / f"{name}.png", metadata={"Software": None})
