"""Draw the bands and the bars of docs/studies.md: `python docs/pictures/tolerances.py`, into docs/images."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from matplotlib.figure import Figure

from linkage import drive_force, kN, mm, most
from linkage.pictures import plot_bands, plot_tornado
from linkage.study import Tolerance, monte_carlo, tornado
from mechanisms.three_point_hitch import ThreePointHitch

IMAGES = Path(__file__).parents[1] / "images"
TOLERANCES = {"OB": 0.5 * mm, "CD": 1 * mm, "MK": (-0.5 * mm, 1 * mm), "M": Tolerance(1 * mm, "uniform")}


def bands() -> Figure:
    """Return the bands of the tilt and of the drive's force."""
    force = drive_force()
    found = monte_carlo(ThreePointHitch(), ["tilt", force], TOLERANCES | {"load.mass": 20.0}, subject_to=[most(force) <= 71.5 * kN])
    return plot_bands(found, units={found[force].quantity: "kN"})


def bars() -> Figure:
    """Return what each tolerance does to the tilt."""
    return plot_tornado(tornado(ThreePointHitch(), "tilt", TOLERANCES, S=0.1))


PICTURES: dict[str, Callable[[], Figure]] = {"tolerance_bands": bands, "tolerance_tornado": bars}

if __name__ == "__main__":
    for name, picture in PICTURES.items():
        picture().savefig(IMAGES / f"{name}.png", metadata={"Software": None})
