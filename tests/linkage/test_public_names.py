"""What a design and a motion show of themselves is what the page of reference explains, no more and no less."""

import re
from pathlib import Path

import pytest

from linkage import Mechanism
from mechanisms.classics.four_bar import FourBar

PAGE = Path(__file__).parents[2] / "docs" / "reference.md"


def explained(heading):
    """Return the names in the first column of the table under a heading of the page."""
    (part,) = (each for each in PAGE.read_text(encoding="utf-8").split("\n## ") if each.startswith(heading))
    rows = [line.split("|")[1] for line in part.splitlines() if line.startswith("| `")]
    return sorted(name for row in rows for name in re.findall(r"`(\w+)`", row))


def shown(thing):
    """Return the public names of an object."""
    return sorted(name for name in dir(thing) if not name.startswith("_"))


@pytest.mark.parametrize("motion", [FourBar().sweep(5), FourBar(OA=[0.03, 0.04]).at(phi=0.2)])
def test_a_motion_shows_what_is_explained(motion):
    assert shown(motion) == explained("A motion")


def test_a_design_shows_what_is_explained():
    assert shown(Mechanism) == explained("A design")
    assert set(shown(FourBar())) - FourBar.plan.members.keys() == set(explained("A design"))
