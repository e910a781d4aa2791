"""Instants of a path in time: when its poses are passed, and at which rates and accelerations of the strokes."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import cached_property
from hashlib import blake2b
from typing import Any, Self

import numpy as np

from ..frozen import immutable
from ..numeric.line import Index
from ..program import FloatArray
from ..quantities import Course


@immutable
class Instants:
    """Instants of a path in time [s], shaped as the poses there. The rates and accelerations of the strokes go by name.

    `courses` are those of all strokes. At `breaks` one of them goes on otherwise; the path begins at the first and ends at the last.
    The motion of a part has rates alone: its strokes follow the whole.
    """

    courses: Mapping[str, Course]
    breaks: FloatArray
    time: FloatArray
    rates: Mapping[str, FloatArray]
    accelerations: Mapping[str, FloatArray]

    @classmethod
    def over(cls, courses: Mapping[str, Course], begin: float, end: float) -> Self:
        """Return the breaks of a path from one instant to another."""
        inner = np.concatenate([[begin, end], *(course.breaks for course in courses.values())])
        breaks = np.unique(inner[(inner >= begin) & (inner <= end)])
        apart = np.concatenate([[True], np.diff(breaks) > 1e-12 * (end - begin)])  # what two courses reckon as one instant is one
        breaks = breaks[apart]
        breaks[-1] = end
        return cls(courses, breaks, breaks, {}, {}).at_times(breaks)

    def at_times(self, time: FloatArray, phase: FloatArray | None = None) -> Self:
        """Return other instants; at a break the phase that begins there counts, or the one that an instant lies in."""
        leg = np.clip(np.searchsorted(self.breaks, time, side="right") - 1, 0, len(self.breaks) - 2)
        within = 0.5 * (self.breaks[leg] + self.breaks[leg + 1]) if phase is None else phase
        rates, accelerations = (
            {name: np.asarray(course(time, order, phase=within)) for name, course in self.courses.items()} for order in (1, 2)
        )
        return replace(self, time=time, rates=rates, accelerations=accelerations)

    def at_share(self, leg: Index, t: FloatArray) -> Self:
        """Return the instants at shares t, 0 to 1, of the time from one break to the next; both sides of a break are told apart."""
        begin, end = self.breaks[leg], self.breaks[leg + 1]
        return self.at_times(np.where(t == 1.0, end, begin + (end - begin) * t), 0.5 * (begin + end))

    def shaped(self, change: Callable[[Any], Any]) -> Self:
        """Return the same with another shape, or some of them."""
        each_of = ({name: change(value) for name, value in known.items()} for known in (self.rates, self.accelerations))
        return replace(self, **dict(zip(("time", "rates", "accelerations"), (change(self.time), *each_of), strict=True)))

    def shares(self, parts: FloatArray) -> Self:
        """Return the instants at shares of the whole time, 0 to 1."""
        begin, end = self.breaks[[0, -1]]
        return self.at_times(np.where(parts == 1.0, end, begin + (end - begin) * parts))

    @cached_property
    def strokes(self) -> dict[str, FloatArray]:
        """The strokes there by name [m or rad]."""
        return {name: np.asarray(course(self.time)) for name, course in self.courses.items()}

    @cached_property
    def rate_jump(self) -> tuple[float, str, float] | None:
        """The first jump of a rate between both ends: its instant [s], the stroke, its size [m/s or rad/s]; None where there is none."""
        begin, end = self.breaks[[0, -1]]
        inner = [(at, name) for name, course in self.courses.items() for at in course.jumps(1, ends=True) if begin < at < end]
        if not inner:
            return None
        time, name = min(inner)
        beside = 1e-6 * (end - begin)
        before, after = (float(self.courses[name](time, 1, phase=time + way)) for way in (-beside, beside))
        return time, name, abs(after - before)

    @cached_property
    def content_key(self) -> bytes:
        """A key in bytes: equal for equal strokes passed at equal rates and accelerations."""
        known = [self.time, *self.rates.values(), *self.accelerations.values()]
        courses = [each.content_key for each in self.courses.values()]
        parts = [self.breaks.tobytes(), *courses, *(np.asarray(each).tobytes() for each in known)]
        return blake2b(b"".join(parts), digest_size=16).digest()
