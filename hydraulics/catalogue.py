"""A catalogue of single-stage cylinders, row by row, for a search to choose from. Lengths in m.

    >>> from linkage.units import mm
    >>> rows = catalogue(bores=[80 * mm], rods=[45 * mm, 50 * mm], strokes=[250 * mm], dead=(120 * mm, 1.5))
    >>> rows[0]
    CatalogueRow(bore=0.08, rod=0.045, stroke=0.25, closed=0.49)
    >>> print(*rows, sep="; ")
    cylinder 80/45 x 250 mm, 490 mm closed; cylinder 80/50 x 250 mm, 490 mm closed

What is standard here: the bores, the rods and the ratio of their areas (ISO 3320), and the strokes (ISO 4393). No standard says how long a
cylinder is closed: that follows from its head, its piston, its guide and its eyes, and is the maker's; give it as a dead length.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product
from typing import NamedTuple

from linkage.errors import DefinitionError, cited, ensure
from linkage.units import inch, mm, shown_in, shown_number

from .cylinder import INCH, chosen_series, series_of
from .inputs import all_finite, in_metres, not_negative, positive, stroke_in_metres

# Basic series of piston strokes, mm.
#
# Source: ISO 4393, as makers' catalogues reproduce it, to 500 mm. Above it makers go on with the preferred numbers R10 (ISO 3); mobile
# cylinders are made in any stroke, so that a list of one's own is often the better one.

STROKES = tuple(each * mm for each in (25, 40, 50, 80, 100, 125, 160, 200, 250, 320, 400, 500))
LONGER = tuple(each * mm for each in (630, 800, 1000, 1250, 1600, 2000))
# Whole inches, as makers of inch cylinders stock them; no standard says them.
INCH_STROKES = tuple(each * inch for each in (1, 2, 3, 4, 5, 6, 8, 10, 12, 14, 16, 18, 20))
INCH_LONGER = tuple(each * inch for each in (24, 30, 36, 48, 60, 72))

MOST_ROWS = 1_000_000


class CatalogueRow(NamedTuple):
    """A cylinder of a catalogue: bore, rod, stroke and the closed distance of its pins [m]."""

    bore: float
    rod: float
    stroke: float
    closed: float

    def __str__(self) -> str:
        bore, rod, stroke, closed = (shown_number(each, "mm", 4) for each in self)
        return f"cylinder {bore}/{rod} x {stroke} {shown_in('mm')}, {closed} {shown_in('mm')} closed"


def standard_strokes(longer: bool = False) -> tuple[float, ...]:
    """Return the basic strokes of ISO 4393 [m], ascending; `longer` goes on with the preferred numbers R10 to 2 m.

    Where the system of units has inches they are whole ones.
    """
    basic, more = (INCH_STROKES, INCH_LONGER) if chosen_series() is INCH else (STROKES, LONGER)
    return (*basic, *more) if longer else basic


def catalogue(
    bores: Sequence[float] | None = None,
    rods: Sequence[float] | None = None,
    strokes: Sequence[float] | None = None,
    *,
    dead: float | tuple[float, float],
) -> list[CatalogueRow]:
    """Return the cylinders of all pairs of bore and rod, in all strokes, by bore, rod and stroke: rows that `optimise` varies.

    Without `bores` and `rods` those of ISO 3320, without `strokes` those of ISO 4393 [m]; of the pairs the ones whose areas are in the
    ratios of that standard. Where the system of units has inches they are those of NFPA T3.6.7, with strokes of whole inches. `dead` is
    what a cylinder is longer between its pins, drawn in, than its stroke: a length [m], or (length, factor) for length + factor x bore.
    DefinitionError if no row is left, for numbers that are not above zero, or that were given in millimetres.
    """
    parts, rows = all_finite(dead, "Dead length"), []
    if parts.shape not in ((), (2,)):
        raise DefinitionError(f"Dead length = {cited(dead)}: give a length [m], or (length, factor of the bore) such as (0.12, 1.5).")
    constant, factor = (float(parts), 0.0) if parts.ndim == 0 else map(float, parts)
    in_metres(not_negative(constant, "Dead length"), "Dead length")
    in_metres(not_negative(factor, "Factor of the bore"), "Factor of the bore", 100.0)
    positive(constant + factor, "Dead length")
    standard = chosen_series()
    asked = ((bores, standard.bores, "Bore"), (rods, standard.rods, "Rod"), (strokes, standard_strokes(), "Stroke"))
    sizes = [series_values(*each) for each in asked]
    if len(sizes[0]) * len(sizes[1]) * len(sizes[2]) > MOST_ROWS:
        raise DefinitionError(f"The catalogue would have more than {MOST_ROWS} rows; give fewer bores, rods or strokes.")
    for bore, rod, stroke in product(*sizes):
        if series_of(bore, rod).is_pair(bore, rod):
            stroke_in_metres(stroke, "Stroke", bore)
            rows.append(CatalogueRow(bore, rod, stroke, round(stroke + constant + factor * bore, 9)))
    if not rows:
        what = f"The catalogue has no row: no rod suits a bore by the ratios of {standard.name}"
        raise DefinitionError(f"{what}; give others, or leave rods= out.")
    return rows


def series_values(given: Sequence[float] | None, standard: Sequence[float], what: str) -> list[float]:
    """Return sizes [m], ascending, each once: those given, else those of a standard."""
    if given is None:
        return [*standard]
    sizes = positive(given, what)
    ensure(sizes.ndim == 1, f"{what} = {cited(given)}: a list is expected, such as [{standard[-4] / mm:.6g} * mm].")
    in_metres(sizes, what) if what != "Stroke" else stroke_in_metres(sizes, what)
    return sorted({float(each) for each in sizes})
