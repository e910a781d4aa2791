"""Stroke values as they are given for: counts, values, grids."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from math import isfinite, pi
from typing import Any

import numpy as np

from ..errors import DefinitionError, cited, ensure, fits_shape, known_name, of_one_shape, require, require_whole
from ..frozen import read_only
from ..plan import Plan, rate_name, require_kinds
from ..program import FloatArray
from ..quantities import Member, Stroke, as_mapping, is_whole, keywords, numbers_in, real
from .grid import MotionLike
from .limits import stroke_unit

TURN = 2.0 * pi
FEW, MANY = 2, 8
"""Turns beyond a crank's declared range: of degrees if the number is round, as 45 is and no part of pi; of degrees in any case."""
FAR = 40.0
"""A stroke of a metre or more that is so many times the declared one was given in millimetres."""


def known_strokes(given: Mapping[str, object], strokes: Mapping[str, Stroke], title: str) -> None:
    """Raise DefinitionError for a stroke that is not there or not given."""
    if given.keys() == strokes.keys():
        return
    refuse_time(given, strokes, title)
    for name in given:
        known_name("Stroke", name, strokes, where=title)
    missing = [name for name in strokes if name not in given]
    ensure(not missing, f"{title}: the stroke {', '.join(missing)} is not given; say {', '.join(f'{name}=...' for name in missing)}.")


def refuse_time(given: Mapping[str, object], strokes: Collection[str], title: str) -> None:
    """Raise DefinitionError where time is given for a stroke, which none is called."""
    if "time" in given:
        path = f"Over.path({keywords(dict.fromkeys(('time', *strokes), '[...]'))})"
        raise DefinitionError(f"{title}: time={cited(given['time'])}: time is no stroke, it is that of a path; write sweep(over={path}).")


def at_values(given: Mapping[str, object], plan: Plan, take: Callable[[object], FloatArray] = real) -> dict[str, FloatArray]:
    """Return chosen stroke values, broadcast against each other; `take` makes arrays of them."""
    strokes, title = plan.strokes, plan.title
    known_strokes(given, strokes, title)
    require_kinds(plan, given)
    try:
        arrays = {name: take(given[name]) for name in strokes}
    except ValueError:
        raise DefinitionError(f"{title}: strokes are numbers or arrays of numbers (SI); given {dict(given)!r}.") from None
    for name, array in arrays.items():
        if array.size:
            low, high = array.item(array.argmin()), array.item(array.argmax())
            if not (isfinite(low) and isfinite(high)):
                raise DefinitionError(f"{title}: the stroke {name} holds a value that is not finite.")
            check_magnitude(name, (low, high), plan)
    if len(arrays) == 1:
        return arrays
    return dict(zip(strokes, of_one_shape(f"{title}: the strokes' shapes", arrays, [*arrays.values()]), strict=True))


def check_any(values: Mapping[str, FloatArray], plan: Plan) -> None:
    """Raise DefinitionError where the strokes hold no value, so that there is no pose."""
    empty = [name for name, value in values.items() if not value.size]
    if empty:
        raise DefinitionError(f"{plan.title}: {empty[0]} holds no value, so that there is no pose; give one at least, {empty[0]}=[0.0].")


def check_magnitude(name: str, values: tuple[float, ...], plan: Plan) -> None:
    """Raise DefinitionError for a stroke's value so far beyond its declared range that degrees or millimetres were meant."""
    stroke = plan.strokes[name]
    low, high = min(stroke.start, stroke.end), max(stroke.start, stroke.end)
    for value in values:
        if low <= value <= high:
            continue
        if stroke_unit(plan, name) == "rad":
            if is_in_degrees(value, max(low - value, value - high)):
                said = f"{name} = {value:.6g} is an angle in radians, {value / TURN:.3g} turns"
                remedy = f"write {value:.6g} * deg if these are degrees, or declare the stroke as long as that"
                raise DefinitionError(f"{plan.title}: {said}, and the stroke is {low:.6g} to {high:.6g} rad; {remedy}.")
        elif stroke_unit(plan, name) == "m" and abs(value) >= 1.0 and abs(value) > FAR * max(abs(low), abs(high)):
            remedy = f"write {value:.6g} * mm if these are millimetres, or declare the stroke as long as that"
            raise DefinitionError(f"{plan.title}: {name} = {value:.6g} m, and the stroke is {low:.6g} to {high:.6g} m; {remedy}.")


def is_in_degrees(value: float, beyond: float) -> bool:
    """Return whether an angle lies so far [rad] beyond where it may be that degrees were meant."""
    is_round = abs(10.0 * value - round(10.0 * value)) < 1e-9 * abs(value)  # it has one decimal at the most
    return beyond / TURN > (FEW if is_round else MANY)


def float_array(value: object) -> FloatArray:
    """Return an array of floats as it is, not copied; anything else as `real` does."""
    return value if type(value) is np.ndarray and value.dtype == np.float64 else real(value)


def sweep_values(count: int | None, given: Mapping[str, object], plan: Plan) -> dict[str, FloatArray]:
    """Return strokes over their ranges: an int is a count, a float a value; two counts give a grid."""
    strokes, title = plan.strokes, plan.title
    refuse_time(given, strokes, title)
    if count is not None:
        ensure(strokes, f"{title} has no stroke, so there is nothing to sweep; declare one, S = Stroke(0, 0.25), or ask at().")
        if len(strokes) != 1 or given:
            each = keywords(dict.fromkeys(strokes, "..."))
            some = f"{len(strokes)} stroke{'' if len(strokes) == 1 else 's'}"
            raise DefinitionError(f"{title} has {some}: say sweep({each}), an int for a count and a float for a value.")
        remedy = f"for a value write at({keywords({next(iter(strokes)): repr(count)})})"
        ensure(is_whole(count), f"{title}: sweep({count!r}): a whole number of poses is expected; {remedy}.")
        given = {next(iter(strokes)): count}
    known_strokes(given, strokes, title)
    axes = {name: _axis(name, given[name], plan) for name in strokes}
    counted = {name: axis for name, axis in axes.items() if axis.ndim}
    return dict(zip(strokes, np.broadcast_arrays(*(axes | strokes_over_axes(counted)).values()), strict=True))


def strokes_over_axes(axes: Mapping[str, FloatArray]) -> dict[str, FloatArray]:
    """Return the values of strokes over the grid of some axes (n,), by name, an axis for each of them."""
    return dict(zip(axes, np.meshgrid(*axes.values(), indexing="ij"), strict=True))


def _axis(name: str, given: object, plan: Plan) -> FloatArray:
    stroke, title = plan.strokes[name], plan.title
    if is_whole(given):
        if given < 1:  # a whole number may be too large for a float, which only the message asks for
            raise DefinitionError(f"{title}: sweep({name}={given}): a count of at least 1 is expected; for a value write {float(given)}.")
        try:
            return np.linspace(stroke.start, stroke.end, int(given))
        except (MemoryError, OverflowError, ValueError):
            raise DefinitionError(f"{title}: sweep({name}={given}): so many poses do not fit into memory; ask for fewer.") from None
    if isinstance(given, (float, np.floating)) and np.isfinite(given):
        require_kinds(plan, {name: given})
        check_magnitude(name, (float(given),), plan)
        return np.asarray(given, float)
    remedy = f"for chosen values use at({keywords({name: '...'})})"
    raise DefinitionError(f"{title}: sweep({name}={given!r}): an int is a count, a float a value; {remedy}.")


# What a motion is given for, checked: names, rates, orders and steps.


def checked_name(kind: str, target: object, known: Collection[str], title: str) -> str:
    """Return the name of a member or the name as given; raise DefinitionError where it is not a known one."""
    return known_name(kind, target.name if isinstance(target, Member) else target, known, where=title)


def rates_of(what: str, given: object, motion: MotionLike, *, gaps: bool = False) -> dict[str, FloatArray]:
    """Return the stroke rates by name, a float or an array over the poses, NaN where there may be `gaps`; DefinitionError for others."""
    title = motion.plan.title
    known = strokes_named(what, given, motion.plan)
    return {name: checked_rate(f"{what}: {name}", value, motion.shape, title, gaps=gaps) for name, value in known.items()}


def strokes_named(what: str, given: object, plan: Plan) -> dict[str, Any]:
    """Return values of strokes by name. Raise DefinitionError for another type, an unknown stroke, and an amount of another kind.

    An amount in the unit of the stroke stands for so much a second: `12 * deg` is 12 deg/s.
    """
    if not isinstance(given, Mapping):
        example = f"{what}={as_mapping({next(iter(plan.strokes), 'S'): 0.05})}"
        raise DefinitionError(f"{plan.title}: {what}={given!r}: a value for each stroke is expected, such as {example}.")
    found = {checked_name("Stroke", name, plan.strokes, plan.title): value for name, value in given.items()}
    require_kinds(plan, found, f"{plan.title}: {what}")
    return found


def rate_values(plan: Plan, rates: object, accelerations: object) -> dict[str, Any]:
    """Return rates and accelerations of all strokes by the names of their inputs. Zero stands where none is given.

    Raise DefinitionError for accelerations alone, and for a value that is not finite.
    """
    what = f"{plan.title}: accelerations= say how rates change, and no rates= are given"
    ensure(rates is not None, f"{what}; give both, such as rates={as_mapping(dict.fromkeys(plan.strokes, 0.0))}.")
    found: dict[str, Any] = {}
    for order, (what, given) in enumerate((("rates", rates), ("accelerations", accelerations)), 1):
        known = {} if given is None else strokes_named(what, given, plan)
        for name, value in known.items():
            if type(value) is not float:
                checked_rate(f"{what}: {name}", value, np.shape(value), plan.title)
        names = plan.strokes if given is not None else ()
        found |= {rate_name(name, order): known.get(name, 0.0) for name in names}
    return found


def checked_rate(what: str, value: object, shape: tuple[int, ...], title: str, *, gaps: bool = False) -> FloatArray:
    """Return one rate, read-only; DefinitionError unless it is finite, or NaN where there may be `gaps`, and fits the poses."""
    rate = numbers_in(value)
    is_sound = fits_shape(rate, shape) and np.all(np.isfinite(rate) | (gaps & np.isnan(rate)))
    require(is_sound, f"{title}: {what}", value, f"a finite number or an array that fits the poses {shape} is expected")
    return read_only(rate)


def order_of(order: object) -> int:
    """Return the order of a derivative; DefinitionError unless it is 1 or 2."""
    return require_whole("order", order, "derivatives of order 1 and 2 are provided", least=1, most=2)
