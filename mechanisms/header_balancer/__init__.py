"""Header balancing of a forage harvester with gas accumulators: the machine, its headers, its criteria, its figures.

Source: Rekhlitski, Chuprynin, "Mathematical description of the balancing system of the adapters of a mobile forage
harvester with a hydropneumatic accumulator" (2013). The paper prints no geometry: the dimensions are illustrative.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from linkage.star import declare_public

from .criteria import HEADERS, WAYS, Way, charge_for, criteria, largest_charge
from .following import over_following, relief
from .machine import HeaderBalancer, ImprovedBalancer, setting_table, with_header
from .measured import Deviation, deviations, read_measured
from .side_by_side import ThreeHeaders

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FIGURES = ("2", "2a", "2b", "3", "3a", "3b", "4", "4a", "4b", "5", "5a", "5b", "6", "6a", "6b", "7")


def figure(number: int | str, machine: HeaderBalancer | None = None, measured: Sequence[Deviation] = ()) -> Figure:
    """Return a figure of the paper as a matplotlib figure.

    Parameters
    ----------
    number : int or str
        A half of a figure, "2a", or both side by side, 2.
    machine : HeaderBalancer, optional
        The machine, by default with the header of the paper's figure.
    measured : sequence of Deviation, optional
        Measured curves, laid over the reactions.

    Returns
    -------
    Figure
        The figure.
    """
    from .figures import figure

    return figure(number, machine, measured)


declare_public(globals())
