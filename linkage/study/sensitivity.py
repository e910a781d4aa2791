"""Which dimension matters: one at a time, from exact gradients and the real change, and by the shares of the variance."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any, final

import numpy as np

from ..checks import require, require_whole
from ..errors import DefinitionError, one_word, unwarned
from ..frozen import FrozenDict, immutable
from ..mechanism import Mechanism
from ..motion.measures import measure_of
from ..plan import Plan
from ..program import FloatArray, RunOptions
from ..quantities import is_whole
from ..units import display_unit, show, unit_or_none
from .measured import Measured, StudyPoses, measured_title, number_bound
from .tolerances import Tolerance, ToleranceLike, tolerance_words, tolerances_of, values_shifted

POSES = 21


@final
@dataclass(frozen=True)
class Effect:
    """What one dimension does to a quantity: its gradient, and the quantity's change [SI] at either limit of the tolerance.

    `low` and `high` are the real changes, `linear_low` and `linear_high` those that the gradient tells; `share` is the dimension's of the
    variance, to the first order. NaN where the machine cannot be assembled at a limit.
    """

    name: str
    tolerance: Tolerance
    gradient: float
    low: float
    high: float
    share: float

    @property
    def linear_low(self) -> float:
        """The change that the gradient tells at the lower limit [SI]."""
        return self.gradient * self.tolerance.low

    @property
    def linear_high(self) -> float:
        """The change that the gradient tells at the upper limit [SI]."""
        return self.gradient * self.tolerance.high

    @property
    def length(self) -> float:
        """The greatest change, real or by the gradient [SI]."""
        return float(np.fmax.reduce(np.abs([self.low, self.high, self.linear_low, self.linear_high])))


@final
@immutable
class Tornado:
    """The effect of every tolerance by itself on a quantity at one pose: bars, the longest first; `sigma` is that of all together."""

    plan: Plan
    quantity: str
    unit: str
    at: str
    nominal: float
    sigma: float
    bars: tuple[Effect, ...]

    def __iter__(self) -> Iterator[Effect]:
        """Return the bars one by one."""
        return iter(self.bars)

    def __getitem__(self, name: str) -> Effect:
        """Return the bar of a dimension."""
        found = {bar.name: bar for bar in self.bars}
        if name not in found:
            raise DefinitionError(f"{self.plan.title}: {name!r} has no bar; there are {', '.join(found)}.")
        return found[name]

    def __str__(self) -> str:
        head = f"{self.quantity} = {show(self.nominal, self.unit)} at {self.at}; sigma {show(self.sigma, self.unit, 3)} of all together"
        words = [tolerance_words(self.plan, bar.name, bar.tolerance) for bar in self.bars]
        lines = [f"{head}."]
        for bar, name in zip(self.bars, words, strict=True):
            ends = " to ".join(show(end, self.unit, 3) if np.isfinite(end) else "out of reach" for end in (bar.low, bar.high))
            lines.append(f"{name:<{max(map(len, words))}}  {ends}, {100.0 * bar.share:.0f} % of the variance")
        return "\n".join(lines)


def tornado(
    machine: Mechanism, quantity: Measured, tolerances: Mapping[str, ToleranceLike], *, unit: str = "", **strokes: object
) -> Tornado:
    """Return what every tolerance by itself does to a quantity at one pose, the dimension that does most first.

    `tornado(hitch, "tilt", {"OB": 0.1 * mm, "CD": 0.2 * mm}, unit="deg", S=0.1)`. Gradients are exact; those of a measure over the strokes
    looked at, `most("tilt")`, and of a function of a motion are central differences over a thousandth of the tolerance. `unit` is that
    of the words, by default the quantity's own. Raises AssemblyError where the machine as it is set cannot be assembled.
    """
    poses, plan = StudyPoses.of(machine, strokes, POSES), machine.plan
    unit_or_none(unit, where="tornado(unit=...)")
    named = tolerances_of(plan, tolerances)
    k = len(named)
    levels = np.concatenate([np.zeros((1, k)), -np.eye(k), np.eye(k)])
    values = values_shifted(machine, poses, quantity, named, levels)
    title, nominal = measured_title(plan, quantity), float(values[0, 0])
    if values.shape[1] != 1:
        remedy = "say one pose, or give a measure such as most(...)"
        raise DefinitionError(f"{plan.title}: {title} at {poses.pose_count} poses; {remedy}.")
    if not np.isfinite(nominal):
        raise DefinitionError(f"{plan.title}: {title} has no value at {poses.words()}; ask where it has one.")
    low, high = values[1 : 1 + k, 0] - nominal, values[1 + k :, 0] - nominal
    slopes = gradient_at(machine, poses, quantity, named)
    with np.errstate(all="ignore"):
        parts = (slopes * np.array([each.sigma for each in named.values()])) ** 2
        total = float(parts.sum())
        shares = parts / total if total else parts
    rows = np.stack([slopes, low, high, shares], axis=1).tolist()
    bars = [Effect(name, each, *row) for (name, each), row in zip(named.items(), rows, strict=True)]
    ordered = tuple(sorted(bars, key=lambda bar: -bar.length))
    shown = unit or display_unit(measure_of(plan, quantity), "mm")
    return Tornado(plan, title, shown, poses.words(), nominal, float(np.sqrt(total)), ordered)


STEP = 1e-3
"""Of a tolerance: the difference that the gradient of a function of a motion is taken over."""


def gradient_at(machine: Mechanism, poses: StudyPoses, quantity: Measured, tolerances: Mapping[str, Tolerance]) -> FloatArray:
    """Return the derivatives of a quantity at one pose by dimensions, shape (k,): exact, or of a function differences."""
    if number_bound(machine.plan, quantity) is not None:
        return poses.base.gradient(quantity, wrt=list(tolerances)).reshape(-1)  # type: ignore[arg-type]
    k = len(tolerances)
    steps = {name: Tolerance(STEP * max(each.high, -each.low)) for name, each in tolerances.items()}
    levels = np.concatenate([-np.eye(k), np.eye(k)])
    values = values_shifted(machine, poses, quantity, steps, levels)[:, 0]
    apart = np.array([2.0 * each.high for each in steps.values()])
    return np.asarray(np.divide(values[k:] - values[:k], apart, out=np.zeros(k), where=apart > 0.0))


# Shares of the variance.


@final
@immutable
class SobolIndices:
    """The shares of a quantity's variance by dimension: `first` order, by itself, and `total`, with all it acts together with.

    Both by name, shapes (...) of the strokes; `sigma`, shape (...), is the standard deviation that they divide.
    """

    quantity: str
    strokes: Mapping[str, FloatArray]
    first: Mapping[str, FloatArray]
    total: Mapping[str, FloatArray]
    sigma: FloatArray

    def __str__(self) -> str:
        """Return the greatest shares over the strokes, the greatest first."""
        order = sorted(self.total, key=lambda name: -float(np.max(self.total[name])))
        said = (f"{name} {float(np.max(self.first[name])):.2f} ({float(np.max(self.total[name])):.2f})" for name in order)
        return f"Variance of {self.quantity}, first order (total): {', '.join(said)}."


SAMPLES = 1 << 12


def sobol(
    machine: Mechanism,
    quantity: Measured,
    tolerances: Mapping[str, ToleranceLike],
    *,
    count: int = SAMPLES,
    seed: int = 0,
    backend: str = "numpy",
    threads: int = 1,
    **strokes: object,
) -> SobolIndices:
    """Return the Sobol indices of a quantity over tolerances, at every stroke looked at; by default 21 over a single one.

    `sobol(hitch, "tilt", {"OB": 5 * mm, "CD": 5 * mm}, S=0.1)`; a measure such as `most("tilt")` is one number over the strokes. The
    number of designs is `count`, a power of two, times two more than there are dimensions. Source: Saltelli and others, Computer Physics
    Communications 181 (2010), 259-270, by `scipy.stats.sobol_indices`.

    Raises DefinitionError where designs cannot be assembled, so that the variance is not known, or where nothing varies.
    """
    poses, plan = StudyPoses.of(machine, strokes, POSES), machine.plan
    named, title = tolerances_of(plan, tolerances), measured_title(plan, quantity)
    require(is_whole(count) and count >= 2 and (not count & count - 1), "count", count, f"a power of two is expected, such as {SAMPLES}")
    require_whole("seed", seed, "a whole number is expected, at least 0", least=0)
    way, sigmas = RunOptions(one_word("backend", backend, ("numpy", "numba")), threads), []

    def values(x: FloatArray) -> FloatArray:
        designs = {name: machine[name] + row for name, row in zip(named, x, strict=True)}
        found = poses.values(machine.replaced(**designs), quantity, way).T
        lost = int(np.isnan(found).any(axis=0).sum())
        if lost:
            what = f"{plan.title}: {lost} of {x.shape[1]} designs have no value of {title} at some stroke"
            raise DefinitionError(f"{what}, so that its variance is not known; make the tolerances smaller, or leave the stroke out.")
        sigmas.append(np.std(found, axis=1))
        return np.concatenate([found, found])  # SciPy 1.17 stops at a lone index, that of one dimension at one pose

    from scipy.stats import sobol_indices

    laws: Any = [SimpleNamespace(ppf=each.deviations) for each in named.values()]
    with unwarned(), np.errstate(all="ignore"):
        found = sobol_indices(func=values, n=int(count), dists=laws, rng=np.random.default_rng(int(seed)))
    if not np.all(sigmas[0] > 0.0):
        raise DefinitionError(f"{plan.title}: {title} does not vary with {', '.join(named)} at some of the strokes; leave these out.")
    shares = []
    for indices in (found.first_order, found.total_order):
        rows = np.reshape(indices, (2, -1, len(named)))[0].T  # twice the poses times the dimensions
        shares.append(FrozenDict({name: poses.shaped(row) for name, row in zip(named, rows, strict=True)}))
    first, total = shares
    return SobolIndices(title, FrozenDict(poses.base.strokes), first, total, poses.shaped(sigmas[0]))
