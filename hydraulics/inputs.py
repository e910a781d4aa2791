"""The user's numbers, looked at where they come in.

A setting (a bore, a charge) is finite. A value over poses may be NaN inside an array, where it marks a pose that
was not reached. A lone NaN is a mistake and refused like any other. A setting may follow the design: a dimension, an
expression of dimensions or its name may replace a number.
"""

from __future__ import annotations

from collections.abc import Container, Iterable
from types import MappingProxyType
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from linkage.errors import DefinitionError, cited
from linkage.frozen import unmasked
from linkage.loads import ForceElement, Poses
from linkage.loads.element import value_text
from linkage.motion.measures import FAINTEST
from linkage.plan import ArrayReading
from linkage.plan.table import efficiency_words
from linkage.program import Comparison, is_traced
from linkage.quantities import Member, NamedMembers, Quantity, Reference, name_of, needs, quantity
from linkage.quantities.member import is_reference
from linkage.steps import Link
from linkage.units import require_measure

Array: TypeAlias = NDArray[np.float64]

WIDEST = 3.0
"""m; a larger bore or rod was given in millimetres."""
LONGEST = 30.0
"""m; a longer stroke was given in millimetres."""
SLENDER = 300.0
"""A stroke of more bores than this was given in millimetres."""
PUMPED = MappingProxyType({"pressure": "bar", "flow": "l/min", "mechanical_efficiency": "", "hydraulic_efficiency": ""})
"""The numbers of a pump with their units."""
EFFICIENCIES = MappingProxyType({"mechanical_efficiency": "efficiency", "hydraulic_efficiency": "efficiency"})
STRONGEST = 1.0
"""m3/s; a larger flow was given in litres a minute."""


def all_finite(value: ArrayLike, what: str, kind: str = "") -> Array:
    """Return the value as floats, its shape kept; DefinitionError if it is text, NaN or infinite."""
    if type(value) in (float, np.float64, int) and -np.inf < value < np.inf:  # type: ignore[operator]
        return np.asarray(value, np.float64)
    array = _floats(value, what, kind)
    if not is_traced(array) and not array.size:
        raise DefinitionError(f"{what} = {cited(value)} holds no number; give one at least, in SI units.")
    if not is_traced(array) and not np.all(np.isfinite(array)):
        raise DefinitionError(f"{what} = {array[~np.isfinite(array)][0]} is not finite; give a number in SI units.")
    return array


def one_number(value: ArrayLike, what: str, kind: str = "") -> float:
    """Return one finite number; DefinitionError for several, and for anything else."""
    array = all_finite(value, what, kind)
    if array.ndim:
        raise DefinitionError(f"{what} = {cited(value)}: one number is expected, in SI units.")
    return float(array)


def one_design(value: ArrayLike) -> float:
    """Return a number of a motion of one design, whatever its shape."""
    return float(np.ravel(value)[0])


def without(array: Array, bad: Any, what: str, fault: str) -> Array:
    """Return an array; DefinitionError where some of it is `bad`, with the largest of that put into the words of the fault."""
    if bad if isinstance(bad, np.bool_) else np.any(bad):
        raise DefinitionError(f"{what} = {fault.format(f'{max(array[bad], key=abs):.6g}')}.")
    return array


def positive(value: float | ArrayLike, what: str, remedy: str = "give a positive number in SI units") -> Array:
    """Return the value as floats, its shape kept; DefinitionError unless every one is finite and above zero."""
    if isinstance(value, float) and 0.0 < value < np.inf:
        return np.asarray(value)
    array = all_finite(value, what)
    return without(array, array <= 0.0, what, f"{{}} is not above zero; {remedy}")


def not_negative(value: ArrayLike, what: str, remedy: str = "give zero or more") -> Array:
    """Return the value as floats, its shape kept; DefinitionError unless every one is finite and not below zero."""
    array = all_finite(value, what)
    return without(array, array < 0.0, what, f"{{}} is below zero; {remedy}")


def in_metres(value: ArrayLike, what: str, most: float = WIDEST) -> Array:
    """Return a length [m], its shape kept; DefinitionError where it is above `most`, so that millimetres were meant."""
    array = all_finite(value, what, "length")
    return without(array, array > most, what, "{0} m is more than any cylinder has; write {0} * mm if these are millimetres")


def stroke_in_metres(value: ArrayLike, what: str, bore: ArrayLike | None = None) -> Array:
    """Return a stroke or a closed length [m]; DefinitionError if it is too long at all or for a bore [m] beside it, or not above zero."""
    return positive(in_metres(value, what, LONGEST if bore is None else min(LONGEST, SLENDER * float(np.max(bore)))), what)


def in_pascals(value: ArrayLike, what: str) -> Array:
    """Return a pressure [Pa], its shape kept; DefinitionError where it is next to nothing and not none, so that bar were meant."""
    array = all_finite(value, what, "pressure")
    size, words = np.abs(array), "{0} Pa is next to nothing; write {0} * bar if these are bar, or {0} * kgf_cm2"
    return without(array, (size > 0.0) & (size < FAINTEST), what, words)


def in_cubic_metres(value: ArrayLike, what: str) -> Array:
    """Return a flow [m3/s], its shape kept; DefinitionError where no pump gives so much, so that litres a minute were meant."""
    array = all_finite(value, what, "flow")
    return without(array, array > STRONGEST, what, "{0} m3/s is more than any pump gives; write {0} * litre / minute if it is in l/min")


def pose_values(value: ArrayLike, what: str, kind: str) -> Array:
    """Return a value over poses as floats: NaN stays where an array marks an unreached pose, else DefinitionError."""
    array = _floats(value, what, kind)
    if is_traced(array):
        return array
    if array.ndim == 0 or np.any(np.isinf(array)):
        return all_finite(value, what, kind)
    return array


def efficient(value: ArrayLike, what: str) -> Array:
    """Return an efficiency, its shape kept; DefinitionError unless every one is above 0 and not above 1."""
    array = positive(value, what, "an efficiency lies between 0 and 1")
    if np.any(array > 1.0):
        raise DefinitionError(f"{what} = {np.max(array):.6g} is above 1; {efficiency_words(float(np.max(array)))}.")
    return array


def above_vacuum(pressure: Array, atmosphere: float, what: str) -> Array:
    """Return an absolute pressure [Pa]; DefinitionError where it is below zero."""
    if np.any(pressure < 0.0):
        low = float(np.min(pressure)) - atmosphere
        raise DefinitionError(f"{what} = {low:.6g} Pa gauge is below zero absolute; the least is -{atmosphere:.6g} Pa, the atmosphere.")
    return pressure


def kelvin(value: ArrayLike, what: str, low: float = 200.0, high: float = 400.0) -> Array:
    """Return a gas temperature [K]; DefinitionError outside low..high, where degrees Celsius were meant or the law ends."""
    array = all_finite(value, what, "number")
    words = f"{{}} K is outside {low:g}..{high:g} K; give kelvin: 20 deg C is 293.15"
    return without(array, (array < low) | (array > high), what, words)


def _floats(value: ArrayLike, what: str, kind: str) -> Array:
    if kind:
        require_measure(value, kind, what)
    try:
        array = np.asarray(unmasked(value))
    except ValueError:
        raise DefinitionError(f"{what} = {cited(value)} is not a number; give a number in SI units.") from None
    if is_traced(array[()]):
        return array[()]
    if array.dtype.kind not in "iuf":
        raise DefinitionError(f"{what} = {cited(value)} is not a number; give a number in SI units.")
    return array.astype(np.float64)


def only_where(truth: Any, value: Array) -> Array:
    """Return a value where something holds, NaN elsewhere; of a program it is noted that there is none, which is no error."""
    if not isinstance(truth, Comparison):
        return np.where(truth, value, np.nan)
    truth.needed()
    return np.where(truth, value, 1.0)  # type: ignore[call-overload, no-any-return]


# -- settings that may follow the design --------------------------------------------------------------------


def follows(*values: object) -> bool:
    """Return whether one of the values is no number: a quantity, or the name of one."""
    return any(isinstance(value, Quantity) or is_reference(value) for value in values)


def following(*values: Any) -> tuple[Quantity, ...]:
    """Return those of the values that are no numbers, as quantities."""
    return tuple(quantity(value) for value in values if follows(value))


def setting_of_designs(motion: Poses, given: Any, what: str) -> Any:
    """Return a setting as a motion's designs have it [SI], shaped to broadcast against the motion.

    DefinitionError for one that follows a stroke.
    """
    if not follows(given):
        return given
    if motion.plan.moves(quantity(given)):
        raise DefinitionError(f"{what} = {value_text(given)} follows a stroke, but is set before it moves; let it follow dimensions only.")
    return ArrayReading(motion.plan.members, motion.plan.table.lengths, motion.inputs).value(quantity(given))


def check_pressures(element: ForceElement, whose: str, above_zero: Container[str] = ("pressure", "relief")) -> None:
    """Raise DefinitionError for pressures, efficiencies and a flow of a pump's circuit that are given as numbers and cannot be."""
    for name in (each for each in element.numbers if not follows(element.given(each))):
        given: Any = element.given(name)
        if name.endswith("_efficiency"):
            efficient(given, f"{type(element).__name__}: {name}")
        elif name == "flow":
            in_cubic_metres(given, "Flow of the pump")
        elif name == "power":
            positive(given, "Power of the pump", "give watts, such as power=5.75 * kW, or leave it out")
        else:
            what = f"{name.replace('_', ' ').capitalize()} of the {whose}"
            pressure = in_pascals(given, what)
            if name in above_zero:
                positive(pressure, what)


def number_set(element: ForceElement, motion: Poses, name: str) -> Array:
    """Return a parameter of a force element as a motion's designs have it [SI], shaped to broadcast against the motion."""
    given = element.given(name)
    if not follows(given):
        return ForceElement.number(element, motion, name)
    return all_finite(setting_of_designs(motion, given, name.capitalize()), name.capitalize())


def proper_share(share: float) -> None:
    """Raise DefinitionError for a share of the pressure that is not above 0 and up to 1."""
    if not 0.0 < one_number(share, "share", "number") <= 1.0:
        raise DefinitionError(f"share = {share:.6g} of the pressure is not in 0 to 1; 0.9 is how tractors are tested.")


def names_behind(starts: Iterable[Reference], members: NamedMembers) -> set[str]:
    """Return the names that members of a class are built from, as far as they are there.

    Behind a pin of a parts list that no step places yet stand the links that hold it, with their other points.
    """
    stack, found = list[str](), set[str]()
    for each in starts:
        stack += needs(each) if isinstance(each, Member) and not each.name else [name_of(each)]
    while stack:
        name = stack.pop()
        if name in found:
            continue
        found.add(name)
        held = members.get(name)
        needed = [] if held is None else [*needs(held)]
        if held is not None and not needed and not getattr(held, "is_fixed", True):
            links = [each for each in members.values() if isinstance(each, Link) and name in each.point_names]
            needed = [other for each in links for other in (*needs(each), *each.point_names)]
        stack += needed
    return found
