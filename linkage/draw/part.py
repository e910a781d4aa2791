"""A part of the picture: artists made once and moved from pose to pose."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import TypeVar

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.patches import Patch

from .scene import Places

Kind = TypeVar("Kind", bound=Patch)


def added(ax: Axes, patch: Kind) -> Kind:
    """Return a patch that is now on the axes."""
    ax.add_patch(patch)
    return patch


class Part(ABC):
    """Artists that follow some points. They hide where one of these is not reached."""

    points: tuple[str, ...]
    artists: Sequence[Artist]

    def update(self, at: Places) -> None:
        """Move to a pose."""
        there = all(np.isfinite(at[name]).all() for name in self.points)
        for artist in self.artists:
            artist.set_visible(there)
        if there:
            self.move(at)

    @abstractmethod
    def move(self, at: Places) -> None:
        """Move to a pose at which all points are reached."""
