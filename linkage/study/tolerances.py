"""Tolerances of dimensions: how far each may lie from its value, the designs that follow, and the standard deviation that they give."""

from __future__ import annotations

from collections.abc import Hashable, Iterator, Mapping
from math import exp, inf, pi, sqrt
from types import SimpleNamespace
from typing import Any, TypeAlias

import numpy as np

from ..errors import DefinitionError, ensure, one_word, require, require_type, require_whole, unknown, unwarned
from ..frozen import FrozenDict, immutable, record
from ..mechanism import Mechanism
from ..motion import NodeRequest, Request, RequestLike, require_motion
from ..motion.grid import MotionLike
from ..motion.measures import measure_of, words_of
from ..motion.requests import Trait, dimensions_of, identity_of
from ..plan import Plan, plan_measure
from ..program import FloatArray, Node, RunOptions, gradient
from ..quantities import is_number, is_whole
from ..units import SI, display_unit, require_measure, show, unit_or_none
from .measured import Measured, StudyPoses, measured_title, number_bound, traced_number
from .space import is_pair, unit_of, unit_points

LAWS = ("normal", "uniform", "truncated")
SIGMAS = 3.0
"""Sigmas from the middle of a tolerance to either of its limits, of a normal law: 99.73 % lie between."""
WITHIN = 0.9973002039367398
"""The share of a normal law within three sigmas."""


@record
class Tolerance:
    """How far a dimension may lie from its value: `Tolerance(0.1 * mm)`.

    Parameters
    ----------
    limits : float or tuple of float
        The limits [SI]: one number to either side, or a pair, `(-0.1 * mm, 0.2 * mm)`.
    law : {"normal", "truncated", "uniform"}, optional
        "normal", the default: the limits are three sigmas from the middle, and 0.27 % lie beyond them. "truncated": the same without these.
        "uniform": every value between the limits is as likely as another.
    """

    limits: float | tuple[float, float]
    law: str = "normal"

    def __post_init__(self) -> None:
        one_word("law", self.law, LAWS)
        given: object = self.limits
        said = "how far it may lie to either side [SI], such as 0.1 * mm, or the limits (-0.1 * mm, 0.2 * mm)"
        fits = given >= 0.0 if is_number(given) else is_pair(given) and given[0] <= given[1]
        require(fits, "", given, f"is no tolerance; give {said}")

    @property
    def low(self) -> float:
        """The least deviation [SI]; of a normal law three sigmas below the middle."""
        return float(self.limits[0]) if isinstance(self.limits, (tuple, list)) else -float(self.limits)

    @property
    def high(self) -> float:
        """The greatest deviation [SI]; of a normal law three sigmas above the middle."""
        return float(self.limits[1] if isinstance(self.limits, (tuple, list)) else self.limits)

    @property
    def sigma(self) -> float:
        """The standard deviation [SI]."""
        half = 0.5 * (self.high - self.low)
        if self.law == "uniform":
            return half / sqrt(3.0)
        cut = 2.0 * SIGMAS * exp(-0.5 * SIGMAS**2) / sqrt(2.0 * pi) / WITHIN  # what is missing of the variance of a law cut off
        return half / SIGMAS * (sqrt(1.0 - cut) if self.law == "truncated" else 1.0)

    def deviations(self, unit: FloatArray) -> FloatArray:
        """Return deviations [SI] that are spread by the law where `unit` is spread evenly over 0 to 1.

        Parameters
        ----------
        unit : array
            Numbers between 0 and 1.

        Returns
        -------
        array
            The deviations [SI].
        """
        middle, half = 0.5 * (self.low + self.high), 0.5 * (self.high - self.low)
        if self.law == "uniform":
            return np.asarray(middle + half * (2.0 * unit - 1.0))
        from scipy.special import ndtri

        unit = np.clip(unit, 2.0**-54, 1.0 - 2.0**-53)
        share = unit if self.law == "normal" else 0.5 + WITHIN * (unit - 0.5)
        return np.asarray(middle + half / SIGMAS * ndtri(share))


ToleranceLike: TypeAlias = float | tuple[float, float] | Tolerance


def tolerances_of(plan: Plan, given: object) -> dict[str, Tolerance]:
    """Return tolerances by the names of dimensions, a point's for each of its coordinates.

    Raises DefinitionError for a name that is no dimension, for two that stand for one, and for anything but a tolerance.
    """
    expected = 'tolerances by the names of dimensions are expected, {"OB": 0.1 * mm}'
    given = require_type(f"{plan.title}: tolerances", given, Mapping, expected)
    require(given, f"{plan.title}: tolerances", given, expected)
    found: dict[str, Tolerance] = {}
    seen: dict[str, str] = {}
    spellings, following, entries = plan.table.spellings, plan.table.following, plan.table.entries
    sizes = {each: abs(float(plan.defaults[each])) for each in plan.defaults if plan_measure(plan, each) == "length"}
    for name, value in given.items():
        parts = [f"{name}.x", f"{name}.y"] if isinstance(name, str) and f"{name}.x" in spellings else [name]
        if parts[0] not in spellings and name in following:
            raise DefinitionError(f"{plan.title}: {name} follows {following[name]}; give what it follows a tolerance.")
        if parts[0] not in spellings:
            raise unknown("Dimension", name, plan.table.names(), where=plan.title)
        for part in parts:
            owner = spellings[part][0]
            if owner in seen:
                raise DefinitionError(f"{plan.title}: {seen[owner]} and {part} are one dimension; give it one tolerance.")
            seen[owner] = part
            try:
                found[part] = value if isinstance(value, Tolerance) else Tolerance(tuple(value) if isinstance(value, list) else value)
            except DefinitionError as error:
                raise DefinitionError(f"{plan.title}: {part}: {error}") from None
            kind, limits = plan_measure(plan, owner), found[part].limits
            ends = limits if isinstance(limits, tuple) else (limits,)
            for limit in ends:
                require_measure(limit, entries[owner].unit or SI.get(kind, ""), f"{plan.title}: tolerance of {part}")
            longest = sizes.get(owner, 0.0) if entries[owner].kind == "length" else max(sizes.values(), default=inf)
            widest = max(map(abs, ends))
            if widest >= {"length": longest, "angle": pi}.get(kind, inf) > 0.0:
                said = f"a tolerance of {widest:.6g} {SI[kind]} is too large for it"
                raise DefinitionError(f"{plan.title}: {part}: {said}; write 0.1 * mm for millimetres, 0.1 * deg for degrees.")
    return found


def tolerance_words(plan: Plan, name: str, tolerance: Tolerance) -> str:
    """Return a tolerance as a drawing says it: `OB ±0.1 mm`, `OB +0.2/-0.1 mm`."""
    unit = unit_of(plan, name)
    if tolerance.low == -tolerance.high:
        return f"{name} ±{show(tolerance.high, unit)}"
    number = show(tolerance.low, unit).removesuffix(f" {unit}")
    return f"{name} {'+' if tolerance.high > 0 else ''}{show(tolerance.high, unit).removesuffix(f' {unit}')}/{number} {unit}".rstrip()


# Designs that follow from tolerances.

HALF_CELL = 2.0**-31
"""Half the distance of the numbers of a Sobol sequence, which begin with zero."""


def sampled_designs(machine: Mechanism, tolerances: Mapping[str, Tolerance], count: int, method: str, seed: int) -> dict[str, FloatArray]:
    """Return dimensions (count,) by name, every one spread by the law of its tolerance and independent of the others.

    By a scrambled Sobol sequence, "sobol", a Latin hypercube, "latin", or pseudo-random numbers, "random"; the same for the same seed.
    """
    unit = unit_points(count, len(tolerances), method, seed)
    shift = HALF_CELL if method == "sobol" else 0.0
    return {name: machine[name] + each.deviations(column + shift) for column, (name, each) in zip(unit.T, tolerances.items(), strict=True)}


def values_shifted(
    machine: Mechanism, poses: StudyPoses, quantity: Measured, tolerances: Mapping[str, Tolerance], levels: FloatArray
) -> FloatArray:
    """Return a quantity of m designs at poses, shape (m, n) or (m, 1).

    Their dimensions have their own values where `levels`, shape (m, k), is 0, and stand at their limits where it is -1 or 1.
    """
    found = {}
    for share, (name, tolerance) in zip(levels.T, tolerances.items(), strict=True):
        found[name] = machine[name] + np.where(share < 0.0, -share * tolerance.low, share * tolerance.high)
    return poses.values(machine.replaced(**found), quantity, RunOptions())


# The standard deviation that tolerances give a quantity, from its exact gradient: a request, so that a search can follow it.


def sigma(quantity: RequestLike, tolerances: Mapping[str, ToleranceLike]) -> NodeRequest:
    """Return the request for the standard deviation of a quantity, sqrt(sum (g_i sigma_i)^2) with its exact gradient g.

    `sigma("tilt", {"OB": 0.1 * mm, "M": 0.5 * mm})` is in the quantity's unit, in `evaluate`, `function`, `gradient` and searches.
    Dimensions are independent of each other. Source: the law of propagation of uncertainty, ISO/IEC Guide 98-3 (GUM), 5.1.2.

    Parameters
    ----------
    quantity : str, quantity or request
        The quantity.
    tolerances : mapping of str to Tolerance or float
        By dimension [SI].

    Returns
    -------
    NodeRequest
        The request.
    """

    def identity(plan: Plan) -> Hashable:
        of = identity_of(plan, quantity)
        return None if of is None else ("sigma", of, deviations_of(plan, tolerances))

    def bound_in(plan: Plan) -> NodeRequest:
        return sigma_of(traced_number(plan, quantity), quantity, deviations_of(plan, tolerances))

    return NodeRequest(text=f"sigma({words_of(quantity)})", bound_by=bound_in, identity_by=identity)


def deviations_of(plan: Plan, tolerances: object) -> tuple[tuple[str, float], ...]:
    """Return dimensions by name with their standard deviations [SI]."""
    return tuple((name, each.sigma) for name, each in tolerances_of(plan, tolerances).items())


def sigma_of(what: Request, quantity: RequestLike, deviations: tuple[tuple[str, float], ...]) -> NodeRequest:
    """Return the standard deviation of a quantity that is bound to a plan, from dimensions with their standard deviations [SI]."""

    def nodes(plan: Plan) -> tuple[Node, ...]:
        (node,) = what.nodes(plan)
        owners = [owner for owner, _ in dimensions_of(plan, [name for name, _ in deviations])]
        graph, total = node.graph, node.graph.constant(0.0)
        for share, (_, each) in zip(gradient(node, [plan.trace.inputs[owner] for owner in owners]), deviations, strict=True):
            total = total + (each * share) * (each * share)
        return (graph.apply("sqrt", total),)

    def refuse(motion: MotionLike) -> None:
        what.refuse(motion)
        require_motion(motion).gradient(quantity, wrt=[name for name, _ in deviations])

    return NodeRequest(
        text=f"sigma({words_of(quantity)})", sentence=f"the sigma of {what.sentence}", key=("sigma", what.key, deviations),
        order=1 + what.order, nodes_of=nodes, names_of=what.names, notes_of=what.notes, refused_by=refuse,
        traits=Trait.MAY_FAIL | what.traits & Trait.FOLLOWS_ANGLES,
    )  # fmt: skip


# Which dimension matters: one at a time, from exact gradients and the real change, and by the shares of the variance.

POSES = 21
STEP = 1e-3
"""Of a tolerance: the difference that the gradient of a function of a motion is taken over."""


@record
class Effect:
    """The effect of one dimension on a quantity. `linear_low` and `linear_high` are the changes that the gradient tells.

    Attributes
    ----------
    name : str
        The dimension.
    tolerance : Tolerance
        Its tolerance.
    gradient : float
        The quantity's derivative by it [SI].
    low, high : float
        The quantity's real changes at either limit [SI], NaN where the machine cannot be assembled there.
    share : float
        The dimension's share of the variance, to the first order.
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


@immutable
class Tornado:
    """The effect of every tolerance by itself on a quantity at one pose.

    Attributes
    ----------
    plan : Plan
        The machine's plan.
    quantity, unit, at : str
        The quantity, the unit in which it is shown, and the pose in words.
    nominal, sigma : float
        Its value, and the standard deviation of all together [SI].
    bars : tuple of Effect
        The effects, the longest first.
    """

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
        ensure(name in found, f"{self.plan.title}: {name!r} has no bar; there are {', '.join(found)}.")
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
    """Return the effect of every single tolerance on a quantity at one pose, the largest first.

    `tornado(hitch, "tilt", {"OB": 0.1 * mm, "CD": 0.2 * mm}, unit="deg", S=0.1)`. Gradients are exact; those of a measure over the strokes
    looked at, `most("tilt")`, and of a function of a motion are central differences over a thousandth of the tolerance.

    Parameters
    ----------
    machine : Mechanism
        The machine, one design.
    quantity : str, quantity, request, measure or callable
        The quantity.
    tolerances : mapping of str to Tolerance or float
        By dimension [SI].
    unit : str, optional
        The unit of the words, by default the quantity's own.
    **strokes : float or array
        As in `machine.at`.

    Returns
    -------
    Tornado
        The effects.

    Raises
    ------
    AssemblyError
        The machine as it is set cannot be assembled.
    """
    poses, plan = StudyPoses.of(machine, strokes, POSES), machine.plan
    unit_or_none(unit, where="tornado(unit=...)")
    named = tolerances_of(plan, tolerances)
    k = len(named)
    levels = np.concatenate([np.zeros((1, k)), -np.eye(k), np.eye(k)])
    values = values_shifted(machine, poses, quantity, named, levels)
    title, nominal = measured_title(plan, quantity), float(values[0, 0])
    remedy = "say one pose, or give a measure such as most(...)"
    ensure(values.shape[1] == 1, f"{plan.title}: {title} at {poses.pose_count} poses; {remedy}.")
    ensure(np.isfinite(nominal), f"{plan.title}: {title} has no value at {poses.words()}; ask where it has one.")
    low, high = values[1 : 1 + k, 0] - nominal, values[1 + k :, 0] - nominal
    if number_bound(plan, quantity) is not None:
        slopes = poses.base.gradient(quantity, wrt=list(named)).reshape(-1)  # type: ignore[arg-type]
    else:  # of a function of a motion differences
        steps = {name: Tolerance(STEP * max(each.high, -each.low)) for name, each in named.items()}
        ends = values_shifted(machine, poses, quantity, steps, levels[1:])[:, 0]
        apart = np.array([2.0 * each.high for each in steps.values()])
        slopes = np.divide(ends[k:] - ends[:k], apart, out=np.zeros(k), where=apart > 0.0)
    with np.errstate(all="ignore"):
        parts = (slopes * np.array([each.sigma for each in named.values()])) ** 2
        total = float(parts.sum())
        shares = parts / total if total else parts
    rows = np.stack([slopes, low, high, shares], axis=1).tolist()
    bars = [Effect(name, each, *row) for (name, each), row in zip(named.items(), rows, strict=True)]
    ordered = tuple(sorted(bars, key=lambda bar: -bar.length))
    shown = unit or display_unit(measure_of(plan, quantity), "mm")
    return Tornado(plan, title, shown, poses.words(), nominal, float(np.sqrt(total)), ordered)


# Shares of the variance.


@immutable
class SobolIndices:
    """The shares of a quantity's variance by dimension; arrays have the shape (...) of the strokes.

    Attributes
    ----------
    quantity : str
        The quantity.
    strokes : mapping of str to array
        The poses [m or rad].
    first : mapping of str to array
        The share of each dimension by itself.
    total : mapping of str to array
        Its share together with all it acts together with.
    sigma : array
        The standard deviation that they divide [SI].
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
    """Return the Sobol indices of a quantity over tolerances, at every stroke looked at.

    `sobol(hitch, "tilt", {"OB": 5 * mm, "CD": 5 * mm}, S=0.1)`. Source: Saltelli and others, Computer Physics Communications 181 (2010),
    259-270, by `scipy.stats.sobol_indices`.

    Parameters
    ----------
    machine : Mechanism
        The machine, one design.
    quantity : str, quantity, request, measure or callable
        The quantity; a measure such as `most("tilt")` is one number over the strokes.
    tolerances : mapping of str to Tolerance or float
        By dimension [SI].
    count : int, optional
        A power of two: so many designs, times two more than there are dimensions.
    seed : int, optional
        The seed, 0 by default.
    backend : {"numpy", "numba"}, optional
        Which back end works it out.
    threads : int, optional
        How many threads.
    **strokes : float or array
        As in `machine.at`, by default 21 over a single stroke.

    Returns
    -------
    SobolIndices
        The shares of the variance.

    Raises
    ------
    DefinitionError
        Designs cannot be assembled, so that the variance is not known, or nothing varies.
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
        what = f"{plan.title}: {lost} of {x.shape[1]} designs have no value of {title} at some stroke"
        ensure(not lost, f"{what}, so that its variance is not known; make the tolerances smaller, or leave the stroke out.")
        sigmas.append(np.std(found, axis=1))
        return np.concatenate([found, found])  # SciPy 1.17 stops at a lone index, that of one dimension at one pose

    from scipy.stats import sobol_indices

    laws: Any = [SimpleNamespace(ppf=each.deviations) for each in named.values()]
    with unwarned(), np.errstate(all="ignore"):
        found = sobol_indices(func=values, n=int(count), dists=laws, rng=np.random.default_rng(int(seed)))
    ensure(np.all(sigmas[0] > 0.0), f"{plan.title}: {title} does not vary with {', '.join(named)} at some of the strokes; leave these out.")
    shares = []
    for indices in (found.first_order, found.total_order):
        rows = np.reshape(indices, (2, -1, len(named)))[0].T  # twice the poses times the dimensions
        shares.append(FrozenDict({name: poses.shaped(row) for name, row in zip(named, rows, strict=True)}))
    first, total = shares
    return SobolIndices(title, FrozenDict(poses.base.strokes), first, total, poses.shaped(sigmas[0]))
