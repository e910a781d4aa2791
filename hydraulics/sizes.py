"""Standard cylinder bores and piston rods.

Source: ISO 3320 (metric series of bores and rods, and the ratios of the two areas), as makers' catalogues reproduce it.
"""

from __future__ import annotations

from linkage.errors import DefinitionError
from linkage.units import mm

from .inputs import in_metres, one_number, positive

BORES_MM = (
    8, 10, 12, 16, 20, 25, 32, 40, 50, 63, 80, 90, 100, 110, 125, 140, 160, 180, 200, 220, 250, 280, 320, 360, 400, 450, 500,
)  # fmt: skip
RODS_MM = (
    4, 5, 6, 8, 10, 12, 14, 16, 18, 20, 22, 25, 28, 32, 36, 40, 45, 50, 56, 63, 70, 80, 90, 100, 110, 125, 140, 160, 180, 200,
    220, 250, 280, 320, 360,
)  # fmt: skip
RATIOS = (1.06, 5.0)
"""The least and the largest ratio of piston area to annulus in the standard's series."""

SAME = 1.0 + 1e-9


def standard_bores() -> tuple[float, ...]:
    """Return the bores of ISO 3320 [m], ascending."""
    return tuple(bore * mm for bore in BORES_MM)


def standard_rods(bore: float) -> tuple[float, ...]:
    """Return the rods of ISO 3320 [m], ascending, that suit a bore [m]: piston area 1.06 to 5 times the annulus.

    DefinitionError for a bore not above zero.
    """
    in_metres(positive(one_number(bore, "Bore"), "Bore"), "Bore")
    return tuple(rod * mm for rod in RODS_MM if rod * mm < bore and RATIOS[0] <= bore**2 / (bore**2 - (rod * mm) ** 2) <= RATIOS[1])


def next_bore(bore: float) -> float:
    """Return the smallest standard bore [m] above a bore [m]; DefinitionError where there is none."""
    return _next(bore, standard_bores(), "bore")


def next_rod(rod: float) -> float:
    """Return the smallest standard rod [m] above a rod [m]; DefinitionError where there is none."""
    return _next(rod, tuple(rod * mm for rod in RODS_MM), "rod")


def _next(size: float, series: tuple[float, ...], what: str) -> float:
    positive(one_number(size, what.capitalize()), what.capitalize())
    larger = [standard for standard in series if standard > size * SAME]
    if not larger:
        raise DefinitionError(
            f"No standard {what} of ISO 3320 is above {size / mm:.6g} mm, the largest is {series[-1] / mm:.0f} mm; "
            "use more cylinders or a higher pressure."
        )
    return larger[0]
