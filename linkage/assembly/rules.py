"""The rules by which a group is followed from place to place: on floats, on arrays, and on the nodes of a program.

A step is taken on three conditions; else it is made smaller. Newton's method converges so near to the place predicted from the last two
that no other solution lies between. It stays on the same side of every singular pose. The distance from these has not shrunk to less than
half. Two branches are apart, relative to the group's size, by about the clearance of the pose from a singular one. So steps become small in
proportion where branches cross or end, and a way ends there to 1e-6 of that clearance.

`choose(a, b, x, y)` is x where a <= b, else y; a truth is 1 or 0. NaN is never less than anything.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from ..program import pick
from ..vectors import Scalar

TOUCH = 1e-6
"""The clearance at which a way ends: below it two branches are not told from each other."""
NEAR = 0.1
"""How far from the predicted place a solution may lie, of the clearance times the group's size."""
ROUNDING = 1e-13
SHRINK = 0.5
GROW = 2.0
FIRST = 0.125
"""The first step, of the largest."""
LEAST = 1e-12
"""The least step, of the largest; a group that Newton's method does not carry so far ends there."""
QUADRATIC = 1e-7
"""A step of Newton's method so small, against the group's size, leaves an error of its square: 1e-14 and less."""
TINY = 1e-300

Choose = Callable[[Scalar, Scalar, Scalar, Scalar], Scalar]


def newton_ended(change: Scalar, last: Scalar, size: Scalar, choose: Choose = pick) -> tuple[Scalar, Scalar]:
    """Return whether steps of Newton's method have ended, and whether at a solution, from their last two changes and the size [m].

    The errors follow each other's squares, next to a singular pose by a large factor; of the first step nothing is known.
    """
    near = choose(change, QUADRATIC * size, 1.0, 0.0)
    ratio = change / last
    ahead = choose(last, 1e300, change * ratio * ratio, 1e4 * change)
    return choose(ahead, QUADRATIC**2 * size, near, choose(change, np.inf, 0.0, 1.0)), near


def predicted(
    step: Scalar, limit: Scalar, places: Sequence[Scalar], pins: Sequence[Sequence[Scalar]], choose: Choose = pick
) -> tuple[Scalar, list[Scalar], list[Scalar]]:
    """Return the next place, not beyond a limit, the pins expected there and where Newton's method begins.

    Expected on the line through the last two places; the parabola through the last three is mostly nearer. `places` are these three, the
    last one first, `pins` their coordinates.
    """
    t, before, earlier = places
    h, back, farther = np.minimum(step, limit - t), t - before, before - earlier
    share = choose(back, 0.0, 0.0, h / back)
    bend = choose(farther, 0.0, 0.0, h * (h + back) / (back + farther))
    first, second = choose(farther, 0.0, 0.0, bend / back), choose(farther, 0.0, 0.0, bend / farther)
    line = [u + (u - w) * share for u, w, _ in zip(*pins, strict=True)]
    start = [each + (u - w) * first - (w - x) * second for each, u, w, x in zip(line, *pins, strict=True)]
    return choose(step, limit - t, t + step, limit), line, start


def step_judged(
    h: Scalar, was: Scalar, largest: Scalar, near: Scalar, miss: Scalar, sense: Scalar, size: Scalar, choose: Choose = pick
) -> tuple[Scalar, Scalar]:
    """Return whether the solution a step `h` ahead is on the same branch, and the next step.

    `near`: whether Newton's method came to a solution; `miss`: how far from where it was expected [m]; `sense` and `was`: the clearance
    with its sign there and here.
    """
    old, now = np.abs(was), np.abs(sense)
    excess = np.sqrt((NEAR * np.minimum(old, now) + ROUNDING) * size / np.maximum(miss, TINY))
    same = choose(TINY, sense * was, near, 0.0)
    good = choose(SHRINK * old, now, choose(1.0, excess, same, 0.0), 0.0)
    falls = np.maximum(old - now, 0.0) / h
    onward = np.minimum(h * np.minimum(np.maximum(0.7 * excess, SHRINK), GROW), choose(falls, 0.0, np.inf, 0.45 * now / falls))
    again = h * choose(0.5, same, np.minimum(np.maximum(0.7 * excess, 0.1), SHRINK), 0.3)
    return good, choose(0.5, good, np.minimum(largest, onward), again)


def goes_on(t: Scalar, sense: Scalar, step: Scalar, largest: Scalar, choose: Choose = pick) -> Scalar:
    """Return whether a way goes on: clear of singular poses, by steps that lead somewhere."""
    on = choose(TOUCH, np.abs(sense), 1.0, 0.0)
    return choose(step, LEAST * largest, 0.0, choose(t + step, t, 0.0, on))


def interpolated(
    place: Scalar,
    places: Sequence[Scalar],
    pins: Sequence[Sequence[Scalar]],
    clear: Sequence[Scalar],
    sizes: Sequence[Scalar],
    choose: Choose = pick,
) -> tuple[list[Scalar], Scalar]:
    """Return the pins expected between two places and how far a solution may lie from there [m]; each of clear and sizes a pair.

    `places` and `pins` are of the place before, the one on the left and the one on the right, so that what comes later changes nothing.
    """
    before, left, right = places
    h, back = right - left, left - before
    share = choose(h, 0.0, 0.0, (place - left) / h)
    bend = choose(back, 0.0, 0.0, share * (share - 1.0) * h * h / (h + back))
    farther = choose(h, 0.0, 0.0, share + bend / h)
    earlier = choose(back, 0.0, 0.0, bend / back)
    own = 1.0 - farther - earlier
    found = [w * earlier + u * own + y * farther for w, u, y in zip(*pins, strict=True)]
    return found, (NEAR * np.minimum(*clear) + ROUNDING) * np.minimum(*sizes)
