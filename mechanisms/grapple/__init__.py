"""The grapple of a harvester head: two levers that press a stem against the head's housing, each turned by a cylinder.

Source: Syunyov, Seliverstov, Gerasimov, Sokolov, "Lesosechnye mashiny v fokuse bioenergetiki", chapter 2, (2.67) to (2.95). M_1, the
moment that a stem needs (fig. 2.24), is not in the copy at hand: an assumed law stands for it, to be replaced by one's own.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from linkage.star import declare_public

from .design import Combination as Combination
from .design import design as design
from .design import feasible as feasible
from .duty import Duty as Duty
from .duty import assumed_moment as assumed_moment
from .duty import grapple_for as grapple_for
from .machine import CrossheadGrapple as CrossheadGrapple
from .machine import Grapple as Grapple
from .machine import InnerGrapple as InnerGrapple
from .report import GrappleState as GrappleState
from .report import gripping as gripping
from .report import moment_ratio as moment_ratio
from .report import travelling as travelling

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FIGURES = ("stems", "moments")


def figure(name: str, grapple: Grapple | None = None) -> Figure:
    """Return a figure of a grapple, by default the shipped one, as a matplotlib figure; DefinitionError for an unknown name, a batch.

    "stems" is the grapple open, at the largest and at the smallest stem, with the rosette of stems that rest on T. "moments" is what
    its lever gives and what the stems need, over their diameter.
    """
    from .figures import figure

    return figure(name, grapple)


declare_public(globals())
