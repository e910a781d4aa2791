"""Draw the pictures of the machines' own pages and of the read-me: `python docs/pictures/machines.py`, into docs/images."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from linkage import ISO_10567, LoadRule, Target, animate, deg, draw, plot, working_field
from mechanisms import grapple, header_balancer
from mechanisms import three_point_hitch as hitch
from mechanisms.at_work.excavator import HookExcavator
from mechanisms.at_work.telehandler import Telehandler
from mechanisms.crane import ArmDrive, BoomDrive, Crane, crane_figure, drive_figure
from mechanisms.grapple import CrossheadGrapple
from mechanisms.mower_lift import MowerLift

IMAGES = Path(__file__).parents[1] / "images"


def lift_film(path: Path) -> None:
    """Write the mower's lift in motion."""
    animate(MowerLift(), path, column="kz", trace=["G"], limit=(1.0, "kz = 1", "below"))


def excavator_chart() -> Figure:
    """Return the load chart of the excavator with a hook."""
    radii, heights = np.arange(1.0, 3.01, 0.25), np.arange(-1.5, 2.01, 0.5)
    field = working_field(
        HookExcavator(), "arm.L", x=radii, y=heights, rule=ISO_10567, lifts=["boom.ram"], without=["tool.load"]
    )  # fmt: skip
    return plot(field)


def telehandler_chart() -> Figure:
    """Return the load chart of the telehandler with level forks."""
    rule, level = LoadRule("works rule", tipping=0.75), [Target("level", 0.0)]
    radii, heights = np.arange(1.0, 5.3, 0.3), np.arange(0.0, 7.6, 0.5)
    return plot(working_field(Telehandler(), "forks.G", x=radii, y=heights, keep=level, rule=rule, without=["forks.load"]))


def crane_loads(pin: str) -> Figure:
    """Return the crane's loads with their lever arms about a pin, the arm level outwards."""
    crane = Crane()
    return draw(crane.at(phi=60 * deg, psi=150 * deg, t=crane["l_t"]), forces=pin, case="lifting")


PICTURES: dict[str, Callable[[], Figure]] = {
    **{f"crane_{name}": partial(crane_figure, name) for name in ("positions", "map", "reach", "movements")},
    "crane_boom_loads": partial(crane_loads, "O"),
    "crane_arm_loads": partial(crane_loads, "J"),
    "header_balancer_scheme": partial(header_balancer.figure, 1),
    **{f"crane_boom_{name}": partial(drive_figure, name, BoomDrive()) for name in ("moments", "positions")},
    **{f"crane_arm_{name}": partial(drive_figure, name, ArmDrive()) for name in ("moments", "positions")},
    "at_work_excavator_chart": excavator_chart,
    "at_work_telehandler_chart": telehandler_chart,
    **{f"grapple_{name}": partial(grapple.figure, name) for name in ("moments", "stems")},
    "grapple_crosshead": partial(grapple.figure, "stems", CrossheadGrapple()),
    **{f"three_point_hitch_{name}": partial(hitch.figure, name) for name in ("capacity", "lift", "zones")},
}
FILMS: dict[str, Callable[[Path], None]] = {"mower_lift.gif": lift_film}

if __name__ == "__main__":
    for name, picture in PICTURES.items():
        picture().savefig(IMAGES / f"{name}.png", metadata={"Software": None})
    for name, film in FILMS.items():
        film(IMAGES / name)
