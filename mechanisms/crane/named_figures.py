"""The figures of cranes and of their drives, by their names."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .. import paper
from .drives import BoomDrive, DrivenArm
from .machine import Crane

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FIGURES = ("positions", "moments", "map", "reach")
DRIVE_FIGURES = ("moments", "positions")


def drive_figure(name: str, drive: BoomDrive | DrivenArm) -> Figure:
    """Return a figure of a drive as a matplotlib figure.

    Parameters
    ----------
    name : {"moments", "positions"}
        "moments" is what it gives and what is asked of it over its angle, "positions" the drive at its ends and where it has least to
        spare.
    drive : BoomDrive or DrivenArm
        The drive.

    Returns
    -------
    Figure
        The figure.

    Raises
    ------
    DefinitionError
        The name is not known, or it is a batch of designs.
    """
    from .figures import DRIVES

    return paper.named_figure(DRIVES, name, drive)


def crane_figure(name: str, crane: Crane | None = None) -> Figure:
    """Return a figure of a crane as a matplotlib figure.

    Parameters
    ----------
    name : {"positions", "moments", "map", "reach"}
        "positions" are those that its skeleton is laid out by, "moments" what boom and arm are given and asked for, "map" the load map,
        "reach" all that the tip reaches.
    crane : Crane, optional
        The crane, by default the shipped one.

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

    return paper.named_figure(DRAWN, name, crane if crane is not None else Crane())
