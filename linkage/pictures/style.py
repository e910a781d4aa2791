"""The look of every picture: colours, line widths, font sizes. One palette, safe for colour-blind readers."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence

from ..frozen import record

INK = "#24313f"
MUTED = "#67737f"
RULE = "#c3cbd3"
GRID = "#e9edf0"
PAPER = "#ffffff"
AROUND = "#98a2ac"
"""The lines of what stands around a mechanism; they do not outshine it."""
CURVE = "#0072b2"  # Okabe and Ito's blue
ACCENT = "#d55e00"  # Okabe and Ito's vermilion: paths, limits, what falls short
BODIES = (
    "#96c0fc", "#e47e60", "#9cb490", "#ead8b4", "#9090ea", "#c6d272", "#66a2b4", "#eab4c0", "#a29696", "#c6d8f0",
)  # fmt: skip
"""The colours of bodies. Any two differ by 10.4 or more in CIEDE2000, for normal sight and for protan, deutan and tritan sight (Machado,
Oliveira and Fernandes 2009, severity 1); ink upon them has a contrast of 4.5 or more.
"""
BARREL = "#d5dce3"
ROD = "#f4f6f8"
PISTON = "#4a5a6a"

TITLE = 12.0
TEXT = 10.0
SMALL = 8.5
LABEL = 11.0

OUTLINE = 1.1
BOLD = 2.0
THIN = 0.8

DPI = 150


@record
class Look:
    """How strongly a mechanism is drawn: `fade` mixes every colour with the paper, 0 to 1; `level` is its layer; `tint` colours it all."""

    fade: float = 0.0
    level: float = 10.0
    tint: str = ""

    def colour(self, colour: str) -> str:
        """Return a colour faded towards the paper."""
        return mixed(mixed(colour, self.tint, 0.75) if self.tint else colour, PAPER, self.fade)


STRONG = Look()
FAINT = Look(fade=0.6, level=3.0)


def mixed(colour: str, other: str, share: float) -> str:
    """Return a colour with a share of another one in it; both written `#rrggbb`."""
    parts = ((int(colour[i : i + 2], 16), int(other[i : i + 2], 16)) for i in (1, 3, 5))
    return "#" + "".join(f"{round(a + (b - a) * share):02x}" for a, b in parts)


FAMILIES = (1, 4, 5, 6, 8)
"""The colours of bodies that have a lighter tint, for machines of parts whose parts have several bodies: a family each. Of a family's two
and all others any two differ by 6.1 or more in CIEDE2000 for every sight, by 10.9 for normal sight.
"""
PALETTE = (*BODIES, *(mixed(BODIES[place], PAPER, 0.5) for place in FAMILIES))
"""The colours of bodies, and the lighter tints of families."""


def part_of_points(points: Iterable[str]) -> str:
    """Return the part of a machine that most of some points are of; "" for the machine itself."""
    owners = Counter(name.partition(".")[0] if "." in name else "" for name in points)
    return owners.most_common(1)[0][0] if owners else ""


def body_colours(owners: Sequence[str]) -> list[int]:
    """Return the places in `PALETTE` of the colours of bodies by the parts they are of: a colour each, or a family of tints a part."""
    parts = list(dict.fromkeys(owners))
    if len(parts) in (1, len(owners)):
        return [place % len(BODIES) for place in range(len(owners))]
    found, had = list[int](), Counter[str]()
    for owner in owners:
        family, tint = parts.index(owner) % len(FAMILIES), had[owner] % 2
        found.append(len(BODIES) + family if tint else FAMILIES[family])
        had[owner] += 1
    return found
