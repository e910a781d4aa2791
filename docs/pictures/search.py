"""Draw the searches of docs/studies.md and docs/files.md: `python docs/pictures/search.py`, into docs/images."""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import partial
from pathlib import Path

from matplotlib.figure import Figure

from hydraulics import capacity
from linkage import around, at, deg, draw, least, mm, most, optimise, plot, ref, transmission, y
from linkage.cli.optimise import machine_of_study
from linkage.files.synthesis_file import read_search
from linkage.study import Optimum
from mechanisms.three_point_hitch import ThreePointHitch

DOCS = Path(__file__).parents[1]
IMAGES = DOCS / "images"


def hitch() -> Figure:
    """Return the hitch before and after the search of docs/studies.md."""
    rise = at(y("G"), S=0.25) - at(y("G"), S=0.0)
    found = optimise(
        ThreePointHitch(), maximise=least(capacity("lift", "G")), vary={"A": around(60 * mm), "OB": (0.27, 0.33)},
        subject_to=[most(abs(ref("tilt"))) <= 18 * deg, least(transmission("K")) >= 35 * deg, rise >= 800 * mm], starts=2,
    )  # fmt: skip
    assert isinstance(found, Optimum)
    return draw(found)


def mower() -> Figure:
    """Return the curves of the mower's lift before and after the search of docs/files.md."""
    text = re.search(r'write_text\("""\n(.*?)\.\.\. """\)', (DOCS / "files.md").read_text(encoding="utf-8"), re.DOTALL)
    assert text is not None
    lines = [line.removeprefix("...").removeprefix(" ") for line in text[1].splitlines()]
    found = read_search("\n".join(lines[: lines.index("[outputs]")]), partial(machine_of_study, [])).run()
    assert isinstance(found, Optimum)
    return plot(found)


PICTURES: dict[str, Callable[[], Figure]] = {"search_hitch": hitch, "search_mower": mower}

if __name__ == "__main__":
    for name, picture in PICTURES.items():
        picture().savefig(IMAGES / f"{name}.png")
