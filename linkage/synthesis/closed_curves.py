"""Closed curves by arc length: their Fourier descriptors, and how one lies best on another whatever its place, turn, size, start and sense.

With s from 0 to 1 along a closed curve z = x + i y, c_k is the mean of z exp(-2 pi i k s). A shift changes c_0 alone, a turn and another
size all of them by one factor, another start c_k by a factor exp(2 pi i k t). The other sense swaps c_k and c_-k. What stays are the |c_k|.
Sources: C. T. Zahn, R. Z. Roskies, Fourier descriptors for plane closed curves, IEEE Trans. Computers C-21 (1972) 269-281; for coupler
curves J. R. McGarva, G. Mullineux, Harmonic representation of closed curves, Appl. Math. Modelling 17 (1993) 213-218.
"""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
import numpy.typing as npt

from ..errors import ensure
from ..frozen import immutable
from ..vectors import FloatArray, Mask

ComplexArray: TypeAlias = npt.NDArray[np.complex128]

HARMONICS = 24
"""Descriptors to either sign by which curves are laid onto one another."""
PLACES = 128
"""Starts along a curve that are tried, before the best is made exact."""
NEWTON = 4
SAMPLES = 256
"""Points of a drawn curve, at the least, of which its descriptors are taken."""
SAME_POINT = 1e-9
"""Of a curve's size: points that are nearer to one another are one."""


class ClosedCurves:
    """Closed curves by arc length, from samples (m, n) at equal steps of a parameter that comes round after n, such as a crank's angle.

    They have a `middle` (m,) and `descriptors` (m, 2 h) of k = 1 ... h, -1 ... -h, complex numbers [m].

    `along` (m, n) is the part of the way, from 0 to 1, at which each sample lies; `size` (m,) the root mean square distance from the
    middle [m].
    """

    def __init__(self, samples: ComplexArray, harmonics: int = HARMONICS) -> None:
        weight, self.along = ways(samples)
        weight /= samples.shape[1]
        self.middle: ComplexArray = np.sum(samples * weight, axis=1)
        part = (samples - self.middle[:, None]) * weight
        self.size: FloatArray = np.sqrt(np.sum(np.abs(samples - self.middle[:, None]) ** 2 * weight, axis=1))
        wave = np.exp(-2j * np.pi * self.along)
        self.harmonics = harmonics
        """How many descriptors there are of each sign."""
        self.descriptors: ComplexArray = np.empty((len(samples), 2 * harmonics), complex)
        for first, factor in ((0, wave), (harmonics, np.conj(wave))):
            product = part * factor
            for k in range(harmonics):
                self.descriptors[:, first + k] = product.sum(axis=1)
                product *= factor

    @property
    def amplitudes(self) -> FloatArray:
        """The amplitudes |c_k| (m, 2 h), in parts of the size, which no shift, turn, size or start changes."""
        return np.asarray(np.abs(self.descriptors) / np.where(self.size > 0.0, self.size, 1.0)[:, None])

    def shares_of_turn(self, along: FloatArray) -> FloatArray:
        """Return which part of the round belongs to parts of the way (m, n); both may go beyond 0 and 1."""
        m, n = self.along.shape
        rows = 2.0 * np.arange(m)[:, None]
        known = np.concatenate([self.along, np.ones((m, 1))], axis=1) + rows
        part = np.tile(np.arange(n + 1) / n, (m, 1))
        whole = np.floor(along)
        found = np.interp((along - whole + rows).ravel(), known.ravel(), part.ravel())
        return np.asarray(found.reshape(along.shape) + whole)


def ways(samples: ComplexArray) -> tuple[FloatArray, FloatArray]:
    """Return the speed in parts of its mean, and the part of the way passed, (m, n) each, of samples of closed curves."""
    n = samples.shape[1]
    turning = 2j * np.pi * np.fft.fftfreq(n, 1.0 / n)
    if n % 2 == 0:
        turning[n // 2] = 0.0
    speed = np.abs(np.fft.ifft(turning * np.fft.fft(samples, axis=1), axis=1))
    mean = speed.mean(axis=1, keepdims=True)
    speed = np.divide(speed, mean, out=np.ones_like(speed), where=mean > 0.0)
    waves = np.fft.rfft(speed, axis=1)
    grown = np.zeros_like(waves)
    last = (n + 1) // 2
    grown[:, 1:last] = waves[:, 1:last] / turning[1:last]
    uneven = np.fft.irfft(grown, n, axis=1)
    along = np.arange(n) / n + uneven - uneven[:, :1]
    return speed, np.clip(np.maximum.accumulate(along, axis=1), 0.0, 1.0)


@immutable
class Laying:
    """How curves (m,) lie best on another one: `factor` * z + `by`, complex [m], each begun at the part `start` of its way.

    `backward` are those that run the other way. `error` (m,) is the mean square distance of points at the same part of the way [m^2].
    """

    factor: ComplexArray
    by: ComplexArray
    start: FloatArray
    backward: Mask
    error: FloatArray

    def along(self, places: FloatArray) -> FloatArray:
        """Return which parts of their own ways (m, n) lie on parts (n,) of the way of the curve they are laid onto."""
        sense = np.where(self.backward, -1.0, 1.0)[:, None]
        return np.asarray(sense * (places + self.start[:, None]))


def laid_onto(
    curves: ClosedCurves, onto: ClosedCurves, sizes: FloatArray, *, shift: bool = True, turn: bool = True, scale: bool = True
) -> Laying:
    """Return how curves lie best on one curve, by a shift, a turn and a size, where these are free.

    The size's factor stays between `sizes` (2, m).
    """
    both = [laid_in_sense(curves, onto, sizes, (shift, turn, scale), backward=backward) for backward in (False, True)]
    back = both[1].error < both[0].error
    chosen = [np.where(back, getattr(both[1], name), getattr(both[0], name)) for name in ("factor", "by", "start", "backward", "error")]
    return Laying(*chosen)


def laid_in_sense(curves: ClosedCurves, onto: ClosedCurves, sizes: FloatArray, free: tuple[bool, bool, bool], *, backward: bool) -> Laying:
    """Return how curves lie best on one, all of them passed forward or backward."""
    shift, turn, scale = free
    h = min(curves.harmonics, onto.harmonics)
    order = np.concatenate([np.arange(1, h + 1), -np.arange(1, h + 1), [0]])
    own, aim = ([each.descriptors[:, :h], each.descriptors[:, each.harmonics :][:, :h], each.middle[:, None]] for each in (curves, onto))
    if backward:
        own[0], own[1] = own[1], own[0]
    if shift:
        own[2], aim[2] = np.zeros_like(own[2]), np.zeros_like(aim[2])
    a, b = np.concatenate(own, axis=1), np.concatenate(aim, axis=1)
    start, product = best_start(b * np.conj(a), order, turn=turn)
    a = a * np.exp(2j * np.pi * order * start[:, None])
    power = np.sum(np.abs(a) ** 2, axis=1)
    gain = np.abs(product) if turn else product.real
    with np.errstate(all="ignore"):
        way = product / np.abs(product) if turn else np.ones(len(a), complex)
        factor = way * (np.clip(gain / power, *sizes) if scale else 1.0)
    factor = np.where(np.isfinite(factor), factor, 1.0)
    by = onto.middle - factor * curves.middle if shift else np.zeros(len(a), complex)
    error = np.sum(np.abs(factor[:, None] * a - b) ** 2, axis=1)
    return Laying(factor, by, start, np.full(len(a), backward), np.where(np.isfinite(error), error, np.inf))


def best_start(products: ComplexArray, order: npt.NDArray[np.int_], *, turn: bool) -> tuple[FloatArray, ComplexArray]:
    """Return where curves (m,) begin so that their product with another, the sum of products exp(-2 pi i k start), is greatest, and it.

    Its size counts where a turn is free, else its real part.
    """
    table = np.zeros((len(products), PLACES), complex)
    table[:, order % PLACES] = products
    tried = np.fft.fft(table, axis=1)
    start = np.argmax(np.abs(tried) if turn else tried.real, axis=1) / PLACES
    turning = -2j * np.pi * order

    def product(at: FloatArray) -> tuple[ComplexArray, ComplexArray, ComplexArray]:
        waves = products * np.exp(turning * at[:, None])
        return waves.sum(axis=1), (waves * turning).sum(axis=1), (waves * turning**2).sum(axis=1)

    found, first, second = product(start)
    for _ in range(NEWTON):
        slope = (np.conj(found) * first).real if turn else first.real
        bend = np.abs(first) ** 2 + (np.conj(found) * second).real if turn else second.real
        step = np.divide(-slope, bend, out=np.zeros_like(slope), where=bend < 0.0)
        start = start + np.clip(step, -0.5 / PLACES, 0.5 / PLACES)
        found, first, second = product(start)
    return start, found


def drawn_curve(points: FloatArray) -> tuple[ClosedCurves, FloatArray]:
    """Return the smooth closed curve through points (n, 2) [m], and at which part of its way, from 0 to 1, each of them lies (n,).

    The last point may be the first again. DefinitionError where fewer than three points differ.
    """
    from scipy.interpolate import CubicSpline

    every = np.append(points @ [1.0, 1.0j], points[0] @ [1.0, 1.0j])
    chords = np.abs(np.diff(every))
    kept = chords > SAME_POINT * np.abs(every - every.mean()).max()
    ensure(kept.sum() >= 3, "A closed curve has at least three different points; give more of it.")
    passed = np.concatenate([[0.0], np.cumsum(np.where(kept, chords, 0.0))])
    passed /= passed[-1]
    knots = np.append(np.flatnonzero(kept), len(every) - 1)
    values = every[knots]
    values[-1] = values[0]
    count = max(SAMPLES, 4 * len(knots))
    spline = CubicSpline(passed[knots], np.stack([values.real, values.imag], axis=1), bc_type="periodic")
    curve = ClosedCurves((spline(np.arange(count) / count) @ [1.0, 1.0j])[None])
    along = np.interp(passed[:-1], np.linspace(0.0, 1.0, count + 1), np.append(curve.along[0], 1.0))
    return curve, along
