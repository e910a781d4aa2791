"""The grapple of a harvester head: two levers that press a stem against the head's housing, each turned by a cylinder.

Source: Syunyov, Seliverstov, Gerasimov, Sokolov, "Lesosechnye mashiny v fokuse bioenergetiki", chapter 2, (2.67) to (2.95). M_1, the
moment that a stem needs (fig. 2.24), is not in the copy at hand: an assumed law stands for it, to be replaced by one's own.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from linkage.star import declare_public

from .. import paper
from .design import Combination, Duty, assumed_moment, design, feasible, grapple_for
from .machine import CrossheadGrapple, Grapple, InnerGrapple
from .report import GrappleState, gripping, moment_ratio, travelling

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FIGURES = ("stems", "moments")


def figure(name: str, grapple: Grapple | None = None) -> Figure:
    """Return a figure of a grapple as a matplotlib figure.

    Parameters
    ----------
    name : {"stems", "moments"}
        "stems" is the grapple open, at the largest and at the smallest stem, with the rosette of stems that rest on T. "moments" is what
        its lever gives and what the stems need, over their diameter.
    grapple : Grapple, optional
        The grapple, by default the shipped one.

    Returns
    -------
    Figure
        The figure.

    Raises
    ------
    DefinitionError
        The name is not known, or it is a batch of designs.
    """
    from .figures import DRAWN

    return paper.named_figure(DRAWN, name, grapple if grapple is not None else Grapple())


declare_public(globals())
