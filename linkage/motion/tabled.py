"""Members that have columns of their own in a machine's table of results."""

from __future__ import annotations

from abc import abstractmethod

from ..quantities import Member
from .column import Column
from .motion import Motion


class Tabled(Member):
    """A member that the table of results shows, such as a cylinder: its base beside that of its kind."""

    @abstractmethod
    def columns(self, motion: Motion) -> list[Column]:
        """Return its columns under the machine's own loads; the table adds its name to theirs where several members have them.

        The motion was asked for with `unreachable="nan"`: values are NaN where there is none.
        """
