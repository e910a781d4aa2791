"""Draw the bands and the bars of docs/studies.md: `python docs/pictures/tolerances.py`, into docs/images."""

from __future__ import annotations

from pathlib import Path

from linkage import drive_force, kN, mm
from linkage.pictures import plot_bands, plot_tornado
from linkage.study import Tolerance, monte_carlo, most, tornado
from mechanisms.three_point_hitch import ThreePointHitch

IMAGES = Path(__file__).parents[1] / "images"
TOLERANCES = {"OB": 0.5 * mm, "CD": 1 * mm, "MK": (-0.5 * mm, 1 * mm), "M": Tolerance(1 * mm, "uniform")}


def main() -> None:
    """Draw both."""
    hitch, force = ThreePointHitch(), drive_force()
    found = monte_carlo(hitch, ["tilt", force], TOLERANCES | {"load.mass": 20.0}, subject_to=[most(force) <= 71.5 * kN])
    plot_bands(found, units={found[force].quantity: "kN"}).savefig(IMAGES / "tolerance_bands.png")
    plot_tornado(tornado(hitch, "tilt", TOLERANCES, S=0.1)).savefig(IMAGES / "tolerance_tornado.png")


if __name__ == "__main__":
    main()
