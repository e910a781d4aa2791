"""Groups continued from the sketch to the poses asked for, along straight lines in stroke space, without jumps."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..program import FloatArray
from .newton import Mask, Newton

FIRST = 1.0 / 64
LEAST = 1e-10
LARGEST = 1.0 / 8
BEYOND = 1e-4


@dataclass(frozen=True)
class Path:
    """The solutions along paths from 0 to 1: where they stand, the unknowns there, and what stopped which."""

    places: FloatArray
    solutions: FloatArray
    """Shape (places, coordinates, designs, poses); NaN after a path has ended."""
    ended: FloatArray
    """The place where each path ended, shape (designs, poses); 1 where it did not."""
    crossed: Mask
    """Whether it ended where branches cross, and not at a dead point."""


def follow(newton: Newton, inputs: Callable[[float], Mapping[str, Any]], start: FloatArray) -> Path:
    """Return the solutions along all paths; a path that cannot go on ends at its last place.

    A step is taken when Newton converges next to the place predicted from the last two, on the same side of
    every singular pose; else it is halved.
    """
    alive: Mask = np.asarray(np.isfinite(start).all(axis=0))
    ended, crossed = np.where(alive, 1.0, 0.0), np.zeros(alive.shape, bool)
    sense = newton.sense(inputs(0.0), start)
    places, solutions, step = [0.0], [start], FIRST
    while places[-1] < 1.0 and alive.any():
        step = min(step, 1.0 - places[-1])
        guess = predicted(places, solutions, step)
        found, done = newton.correct(inputs(places[-1] + step), guess)
        turned = newton.sense(inputs(places[-1] + step), found) * sense <= 0.0
        good = done & ~turned & near(found, guess, solutions[-1], first=len(places) == 1)
        if (good | ~alive).all():
            ahead = places[-1] + step if step < 1.0 - places[-1] else 1.0
            places.append(ahead)
            solutions.append(np.where(alive, found, np.nan))
            step = min(1.5 * step, LARGEST)
        elif step > LEAST:
            step *= 0.5
        else:
            stopped = alive & ~good
            ended, crossed = np.where(stopped, places[-1], ended), crossed | (stopped & goes_on(newton, inputs, places, solutions))
            alive = alive & good
            step = FIRST
    return Path(np.array(places), np.array(solutions), ended, crossed)


def goes_on(newton: Newton, inputs: Callable[[float], Mapping[str, Any]], places: list[float], solutions: list[FloatArray]) -> Mask:
    """Return which paths have a solution beyond their end: branches cross there, where at a dead point they turn back."""
    beyond = min(BEYOND, 1.0 - places[-1])
    guess = predicted(places, solutions, beyond)
    found, done = newton.correct(inputs(places[-1] + beyond), guess)
    return np.asarray(done & (np.abs(found - guess).max(axis=0) <= 1e-2 * np.ptp(found, axis=0)))


def predicted(places: list[float], solutions: list[FloatArray], step: float) -> FloatArray:
    """Return where the unknowns are expected after a step: the line through the last two places."""
    if len(places) == 1:
        return solutions[-1]
    return solutions[-1] + (solutions[-1] - solutions[-2]) * (step / (places[-1] - places[-2]))


def near(found: FloatArray, guess: FloatArray, last: FloatArray, *, first: bool) -> Mask:
    """Return where a solution is a plausible continuation: close to its prediction, compared with the step itself."""
    miss, stride = np.abs(found - guess).max(axis=0), np.abs(found - last).max(axis=0)
    size = np.ptp(found, axis=0)
    limit = 0.05 * size if first else 0.2 * stride + 1e-6 * size
    return np.asarray(miss <= limit)


def interpolated(path: Path, at: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return guesses between the places of a path with one pose, shape (coordinates, designs, len(at)), and their uncertainty [m].

    A cubic in each interval, its slopes from the neighbouring places.
    """
    nodes, u = path.places, path.solutions[..., 0]
    slopes = np.gradient(u, nodes, axis=0) if len(nodes) > 2 else np.zeros_like(u)
    if len(nodes) == 1:
        return np.repeat(u[0][..., None], len(at), axis=-1), np.zeros((u.shape[2], len(at)))
    left = np.clip(np.searchsorted(nodes, at) - 1, 0, len(nodes) - 2)
    width = nodes[left + 1] - nodes[left]
    t = (at - nodes[left]) / width
    first, second = np.moveaxis(u[left], 0, -1), np.moveaxis(u[left + 1], 0, -1)
    h00, h10, h01, h11 = 2 * t**3 - 3 * t**2 + 1, t**3 - 2 * t**2 + t, -2 * t**3 + 3 * t**2, t**3 - t**2
    rise, fall = np.moveaxis(slopes[left], 0, -1) * width, np.moveaxis(slopes[left + 1], 0, -1) * width
    return h00 * first + h10 * rise + h01 * second + h11 * fall, np.abs(second - first).max(axis=0)
