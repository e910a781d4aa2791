"""How the designs of a study are dealt out: which are left, how many in a batch, how many batches at a time."""

from __future__ import annotations

from collections import deque
from math import ceil

AIM, LEAST = 0.4, 0.2
"""The time that a batch is to take, and the least of it, where enough designs are left [s]."""
LATE = 0.5
"""A batch that waited for less than this part of its own time found an idle worker."""
MOST = 1 << 20
"""The numbers that the inputs of a batch are at most: 8 MB."""


class Left:
    """The designs that are still to be given out: ranges from start to before stop, on the borders of pieces."""

    def __init__(self, count: int, piece: int) -> None:
        self.piece = piece
        self.ranges = [(0, count)]

    @property
    def pieces(self) -> int:
        """How many pieces are left."""
        return sum(-(-(stop - start) // self.piece) for start, stop in self.ranges)

    def take(self, pieces: int) -> tuple[int, int]:
        """Return the next range of at most so many pieces."""
        start, end = self.ranges[0]
        stop = min(start + pieces * self.piece, end)
        self.ranges[:1] = [(stop, end)] if stop < end else []
        return start, stop

    def give_back(self, start: int, stop: int) -> None:
        """Put a range back, to be the next."""
        self.ranges.insert(0, (start, stop))

    def remove(self, start: int, stop: int) -> bool:
        """Take a range out; return whether it was there, whole."""
        for place, (first, last) in enumerate(self.ranges):
            if first <= start < stop <= last:
                self.ranges[place : place + 1] = [(a, b) for a, b in ((first, start), (stop, last)) if a < b]
                return True
        return False


class Pace:
    """What is known of the executor: how long a piece takes it, and how many batches keep all of its workers busy."""

    def __init__(self, most: int) -> None:
        self.most = most
        self.ahead = 1
        self._each: deque[float] = deque(maxlen=8)

    def pieces(self, left: int) -> int:
        """Return how many pieces the next batch has when so many are left: one to begin with, then equal parts of what is left.

        Towards the end they are smaller than usual, so that all workers finish together.
        """
        if not self._each:
            return 1
        each = min(self._each)
        wanted = min(ceil(AIM / each), max(ceil(LEAST / each), left // self.ahead), self.most)
        return ceil(left / max(left // wanted, ceil(left / self.most)))

    def heard(self, pieces: int, seconds: float, waited: float) -> None:
        """Learn from a batch: how long it was at work and how long under way besides [s]; a worker was idle that took it at once."""
        self._each.append(max(seconds, 1e-9) / pieces)
        if waited < LATE * seconds or self.ahead < 2:
            self.ahead += 1
