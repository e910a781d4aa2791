"""Measures: one number of a design, taken over its stroke, and the conditions that compare them.

>>> from linkage import *
>>> print(least(ref("tilt")) >= 2 * deg)
least(tilt) >= 0.0349066
>>> print(most(abs(ref("tilt"))) / 2 - at("tilt", S=0.1))
most(abs(tilt)) / 2 - at(tilt, S=0.1)
"""

from __future__ import annotations

import re
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import partial, reduce
from typing import Any, ClassVar, NoReturn, TypeAlias, TypeGuard, TypeVar

import numpy as np

from ..errors import DefinitionError, FormerName, LawError, UntracedError, article, cited, ensure, require, require_type
from ..frozen import record
from ..loads import Acting, Case, LoadCase
from ..plan import Plan, plan_measure, require_kind
from ..program import FloatArray
from ..quantities import Arithmetic, PoseCondition, Quantity, is_number, name_of, x, y
from ..quantities.quantity import OPERATORS, UFUNCS, Function, Negative, Number, Operation, Sum, stands_for
from ..steps import Point
from ..units import Amount, display_unit, require_measure, require_number, show
from .limits import stroke_measure
from .motion import Motion
from .requests import Combined, NodeRequest, Request, Value, bound, measured_in, stroke_of

MeasuredQuantity: TypeAlias = "str | Quantity | Request | Worst | Callable[[Motion], FloatArray]"
"""What has a value at every pose: a named output, a quantity, a request, or a function of a motion."""

BINDS = {"+": 1, "-": 1, "*": 2, "/": 2, "**": 3}
Spectrum: TypeAlias = Mapping[str, float]
"""A duty: load cases by name, each with its hours or its share."""


class Measure(Arithmetic):
    """One number of a design. Measures add and multiply; compared with one another or a number they make a condition."""

    __hash__ = object.__hash__
    of = FormerName("from_leaves")
    sense: ClassVar[float] = 0.0

    @property
    @abstractmethod
    def leaves(self) -> tuple[Leaf, ...]:
        """The leaves over the stroke in this measure, each once."""

    @abstractmethod
    def from_leaves(self, value: Callable[[Leaf], Any]) -> Any:
        """Return the number that the values of its leaves make; of anything that adds and multiplies."""

    def tree(self, of_leaf: Callable[[Leaf], object]) -> object:
        """Return it as plain data: of a leaf what `of_leaf` says, a number, or an operator with its two sides."""
        found: object = self.from_leaves(of_leaf)
        return found

    @property
    def numbers(self) -> tuple[float, ...]:
        """The numbers in it, in order."""
        return ()

    @property
    def binds(self) -> int:
        """How strongly it binds as text."""
        return 9

    def applied(self, function: str, *operands: Any) -> Measure:
        """Apply an operation to measures and numbers; DefinitionError for any other of NumPy's functions."""
        if function == "negative":
            return CombinedMeasure("*", FixedNumber(-1.0), self)
        if function not in UFUNCS:
            raise DefinitionError(f"{self}: measures take + - * / **; take np.{function} of the quantity in it.")
        left, right = map(as_measure, operands)
        return CombinedMeasure(UFUNCS[function], left, right)

    def __ge__(self, other: Operand) -> Constraint:
        return Constraint(self, ">=", as_measure(other))

    def __le__(self, other: Operand) -> Constraint:
        return Constraint(self, "<=", as_measure(other))

    def __eq__(self, other: object) -> Constraint:  # type: ignore[override]
        return Constraint(self, "==", as_measure(other))

    def __gt__(self, other: object) -> NoReturn:
        raise DefinitionError(f"{self} > {cited(other)}: a search meets its conditions exactly; write >= or <=.")

    __lt__ = __gt__

    def __ne__(self, other: object) -> NoReturn:
        raise DefinitionError(f"{self} != {cited(other)}: a condition is written with >=, <= or ==.")

    def __repr__(self) -> str:
        return str(self)

    def __bool__(self) -> NoReturn:
        raise DefinitionError(f"{self}: a measure has no value before a machine is looked at; ask machine.answers([...]).")


Operand: TypeAlias = "Measure | float"


def as_measure(given: object) -> Measure:
    """Return a measure, also of a number; DefinitionError for a value per pose, without a single one for a design."""
    if isinstance(given, Measure):
        return given
    if is_number(given):
        return FixedNumber(float(given), getattr(given, "measures", ""))
    if is_quantity(given) or isinstance(given, Worst):
        raise DefinitionError(f"{words_of(given)} has a value at every pose: say which is meant, least(...), most(...), at(..., S=...).")
    raise DefinitionError(f"{cited(given)} is no measure and no number; write one such as least(...) or 35 * kN.")


@dataclass(frozen=True, eq=False, repr=False)
class FixedNumber(Measure):
    """A number [SI]; `measures` is its kind, "length", where it was written with a unit."""

    value: float
    measures: str = ""

    leaves = ()

    @property
    def numbers(self) -> tuple[float, ...]:
        return (self.value,)

    def from_leaves(self, value: Callable[[Leaf], Any]) -> Any:
        return self.value

    def __str__(self) -> str:
        return show(self.value, display_unit(self.measures), 6) if self.measures in ("force", "pressure") else f"{self.value:.6g}"


@dataclass(frozen=True, eq=False, repr=False)
class CombinedMeasure(Measure):
    """Two measures joined by an operator."""

    symbol: str
    left: Measure
    right: Measure

    @property
    def leaves(self) -> tuple[Leaf, ...]:
        return tuple(dict.fromkeys((*self.left.leaves, *self.right.leaves)))

    @property
    def numbers(self) -> tuple[float, ...]:
        return (*self.left.numbers, *self.right.numbers)

    def from_leaves(self, value: Callable[[Leaf], Any]) -> Any:
        left, right = self.left.from_leaves(value), self.right.from_leaves(value)
        if isinstance(left, float) and isinstance(right, float):  # by NumPy's rules, where nothing is raised
            with np.errstate(all="ignore"):
                return float(OPERATORS[self.symbol](np.float64(left), np.float64(right)))
        return OPERATORS[self.symbol](left, right)

    def tree(self, of_leaf: Callable[[Leaf], object]) -> tuple[object, ...]:
        return self.symbol, self.left.tree(of_leaf), self.right.tree(of_leaf)

    @property
    def binds(self) -> int:
        return BINDS[self.symbol]

    def __str__(self) -> str:
        left = f"({self.left})" if self.left.binds < self.binds else str(self.left)
        right = f"({self.right})" if self.right.binds <= self.binds else str(self.right)
        return f"{left} {self.symbol} {right}"


@dataclass(frozen=True, eq=False, repr=False)
class Leaf(Measure):
    """A measure of one quantity over the stroke; `sense` is 1.0 of the greatest value, -1.0 of the least, else 0.0."""

    quantity: MeasuredQuantity
    word: ClassVar[str] = ""

    @property
    def bare_quantity(self) -> str | Quantity | Request | Callable[[Motion], FloatArray]:
        """The quantity, that of `worst(...)` at each pose of its stroke too."""
        return self.quantity.quantity if isinstance(self.quantity, Worst) else self.quantity

    @property
    def worst_over(self) -> str:
        """The further stroke over which a worst of another sense is taken first; "" for none, and where all strokes are looked at alike."""
        worst = self.quantity
        return worst.over if isinstance(worst, Worst) and worst.sense != self.sense else ""

    @property
    def sought(self) -> MeasuredQuantity:
        """What is looked for over all strokes that run: the quantity, or the worst of another sense."""
        return self.quantity if self.worst_over else self.bare_quantity

    @property
    def leaves(self) -> tuple[Leaf, ...]:
        return (self,)

    def from_leaves(self, value: Callable[[Leaf], Any]) -> Any:
        return value(self)

    def __str__(self) -> str:
        return f"{self.word}({words_of(self.quantity)})"


@dataclass(frozen=True, eq=False, repr=False)
class Least(Leaf):
    """The least value over the stroke."""

    word: ClassVar[str] = "least"
    sense: ClassVar[float] = -1.0


@dataclass(frozen=True, eq=False, repr=False)
class Most(Leaf):
    """The greatest value over the stroke."""

    word: ClassVar[str] = "most"
    sense: ClassVar[float] = 1.0


@dataclass(frozen=True, eq=False, repr=False)
class Integral(Leaf):
    """The integral over a stroke."""

    by: str | None = None
    word: ClassVar[str] = "integral"


@dataclass(frozen=True, eq=False, repr=False)
class At(Leaf):
    """The value at one pose."""

    strokes: Mapping[str, float] = field(default_factory=dict)
    word: ClassVar[str] = "at"

    @property
    def numbers(self) -> tuple[float, ...]:
        return tuple(self.strokes.values())

    def __str__(self) -> str:
        return f"at({', '.join([words_of(self.quantity), *(f'{name}={value:.6g}' for name, value in self.strokes.items())])})"


@dataclass(frozen=True, eq=False, repr=False)
class Worst:
    """The greatest (`sense` 1.0) or the least (-1.0) value of a quantity over another stroke: again a quantity, of the others."""

    quantity: str | Quantity | Request | Callable[[Motion], FloatArray]
    over: str
    sense: float = 1.0

    def __str__(self) -> str:
        return f"worst({words_of(self.quantity)}, over={self.over}{'' if self.sense > 0.0 else ', by=least'})"

    __repr__ = __str__


def least(quantity: MeasuredQuantity, *, case: Case | Spectrum = None) -> Measure:
    """Return the least value of a quantity over the stroke, between the poses too: `least(capacity("lift", "G")) >= 35 * kN`.

    `case` is a load case that its forces are of. Load cases with their hours, `case={"empty": 700, "full": 300}`, stand for the mean of
    what it is in each; hours and shares are the same, as they are divided by their sum.

    Parameters
    ----------
    quantity : Quantity, Request or str
        The quantity, or its name.
    case : LoadCase, str or mapping, optional
        A load case, or load cases with their hours.

    Returns
    -------
    Measure
        The measure.
    """
    return in_duty(Least(require_quantity(quantity, "least")), case)


def most(quantity: MeasuredQuantity, *, case: Case | Spectrum = None) -> Measure:
    """Return the greatest value of a quantity over the stroke, between the poses too: `most(abs(ref("tilt"))) <= 8 * deg`.

    `case` as in `least`.

    Parameters
    ----------
    quantity : Quantity, Request or str
        The quantity, or its name.
    case : LoadCase, str or mapping, optional
        A load case, or load cases with their hours.

    Returns
    -------
    Measure
        The measure.
    """
    return in_duty(Most(require_quantity(quantity, "most")), case)


def integral(quantity: MeasuredQuantity, by: str | None = None, *, case: Case | Spectrum = None) -> Measure:
    """Return the integral of a quantity over the stroke, of several the one named: `integral(drive_force())` is a work [J].

    `case` as in `least`: `integral(drive_force(), case={"empty": 0.7, "full": 0.3})` is the mean work of a duty.

    Parameters
    ----------
    quantity : Quantity, Request or str
        The quantity, or its name.
    by : str, optional
        The stroke to integrate over, where several run.
    case : LoadCase, str or mapping, optional
        A load case, or load cases with their hours.

    Returns
    -------
    Measure
        The measure.
    """
    return in_duty(Integral(require_quantity(quantity, "integral"), by if by is None else name_of(by)), case)


def at(quantity: MeasuredQuantity, *, case: Case | Spectrum = None, **strokes: float) -> Measure:
    """Return the value of a quantity at one pose: `at("tilt", S=0.1)`; `at("mass")` of one that depends on no stroke.

    `case` as in `least`.

    Parameters
    ----------
    quantity : Quantity, Request or str
        The quantity, or its name.
    case : LoadCase, str or mapping, optional
        A load case, or load cases with their hours.
    **strokes : float
        Values of the strokes by name [m or rad].

    Returns
    -------
    Measure
        The measure.
    """
    for name, value in strokes.items():
        require_number(f"at(..., {name}", value, "one number is expected for a stroke, in SI", kind=None)
    return in_duty(At(require_quantity(quantity, "at"), dict(strokes)), case)


def worst(quantity: MeasuredQuantity, over: str, by: Callable[..., Any] = most) -> Worst:
    """Return the greatest value of a quantity over another stroke, as a quantity of the others; with `by=least` its least.

    `least(available - worst(drive_force("phi"), over="psi"))` is written with it, an upper bound of moments.

    Parameters
    ----------
    quantity : Quantity, Request or str
        The quantity, or its name.
    over : str
        The other stroke.
    by : callable
        `most` or `least`.

    Returns
    -------
    Worst
        The quantity of the remaining strokes.
    """
    require(by in (least, most), "worst(..., by", by, "least or most is expected, the functions of linkage")
    inner = require_quantity(quantity, "worst")
    if isinstance(inner, Worst):
        raise DefinitionError(f"{inner} is the worst over one stroke already; name the stroke of both in one function of a motion.")
    return Worst(inner, over, 1.0 if by is most else -1.0)


def is_quantity(value: object) -> TypeGuard[str | Quantity | Request]:
    """Return whether a value is a named output, a quantity or a request."""
    return isinstance(value, (str, Quantity, Request))


def require_quantity(quantity: object, word: str) -> Any:
    """Return a quantity; DefinitionError for anything else."""
    if isinstance(quantity, Measure):
        raise DefinitionError(f"{word}({quantity}): {quantity} is one number of a design already.")
    if isinstance(quantity, type) or not (is_quantity(quantity) or isinstance(quantity, Worst) or callable(quantity)):
        said = 'a named output, a quantity such as y("G"), a request such as drive_force(), or a function of a motion is expected'
        raise DefinitionError(f"{word}({cited(quantity)}): {said}.")
    return quantity


def words_of(quantity: object) -> str:
    """Return a quantity in words, as one writes it: `abs(tilt)`, numbers with six digits."""
    if isinstance(quantity, (str, Worst, Request, Quantity, Measure)):  # without NumPy's own names and digits that nobody reads
        text = str(quantity.name or quantity) if isinstance(quantity, Quantity) else str(quantity)
        return _LONG.sub(lambda number: f"{float(number[0]):.6g}", text).replace("absolute(", "abs(")
    name = str(getattr(quantity, "__name__", ""))
    return name.replace("_", " ") if name.isidentifier() else "the quantity"


_LONG = re.compile(r"(?<![\w.])\d+\.\d{6,}(?:e[-+]?\d+)?")


# Conditions.


class Condition(ABC):
    """A condition on a design."""

    @abstractmethod
    def constraints(self, machine: Any) -> tuple[Constraint, ...]:
        """Return its constraints for a machine; none for a condition that every search keeps anyway."""

    def __repr__(self) -> str:
        return str(self)

    def __bool__(self) -> NoReturn:
        raise DefinitionError(f"{self}: a condition is neither true nor false before a machine is looked at; write two, not a <= q <= b.")

    def __le__(self, other: object) -> NoReturn:
        raise DefinitionError(f"{self} is a condition, kept or not, and is not compared with {cited(other)}; write it alone.")

    __ge__ = __lt__ = __gt__ = __le__


@dataclass(frozen=True, eq=False, repr=False)
class Constraint(Condition):
    """A measure compared with another: `least(q) >= 35 * kN`."""

    left: Measure
    symbol: str
    right: Measure

    @property
    def margin(self) -> Measure:
        """A measure that is zero or above where the condition is kept; zero where it is an equation."""
        swapped = self.symbol == "<="
        return CombinedMeasure("-", *((self.right, self.left) if swapped else (self.left, self.right)))

    @property
    def compared(self) -> tuple[Measure, Measure]:
        """Its two sides."""
        return self.left, self.right

    def tree(self, of_leaf: Callable[[Leaf], object]) -> tuple[object, ...]:
        """Return it as plain data: its sign with its two sides."""
        return self.symbol, self.left.tree(of_leaf), self.right.tree(of_leaf)

    def short(self, left: Any, right: Any) -> Any:
        """Return how much is missing of it by the numbers of its sides [SI]: zero or below where it is kept, an equation's either way."""
        return left - right if self.symbol == "<=" else right - left if self.symbol == ">=" else abs(left - right)

    def constraints(self, machine: Any) -> tuple[Constraint, ...]:
        return (self,)

    def __str__(self) -> str:
        return f"{self.left} {self.symbol} {self.right}"


class Reachable(Condition):
    """Every pose of the stroke is assembled: kept by every search, also where it is not written."""

    def constraints(self, machine: Any) -> tuple[Constraint, ...]:
        return ()

    def __str__(self) -> str:
        return "reachable"


reachable = Reachable()
"""Every pose of the stroke is assembled. A search keeps it also where it is not written."""


def conditions_of(given: object, machine: object) -> list[Constraint]:
    """Return the constraints of conditions; DefinitionError for anything else."""
    listed = [given] if isinstance(given, (Condition, Measure, PoseCondition, bool)) else given
    example = "a list of conditions is expected, such as [least(...) >= 35 * kN]"
    conditions = require_type("subject_to", listed, (list, tuple), example)
    for each in conditions:
        if isinstance(each, PoseCondition):
            bool(each)
        if not isinstance(each, Condition):
            what = f"{each} says no limit" if isinstance(each, Measure) else f"{cited(each)} is no condition"
            raise DefinitionError(f"subject_to: {what}; write one such as most(...) <= 8 * deg.")
    return [found for each in conditions for found in each.constraints(machine)]


# Load cases.


Sided = TypeVar("Sided", Measure, Constraint)
"""A measure, or a constraint with one on either side."""


def in_case(measure: Sided, case: Case) -> Sided:
    """Return a measure or a constraint with the forces of a load case, where it names none itself."""
    return measure if case is None else in_situation(measure, Acting(case=case))


def in_situation(measure: Sided, acting: Acting) -> Sided:
    """Return a measure or a constraint with the forces of a situation, where it names none itself; itself where it has none."""
    if isinstance(measure, (CombinedMeasure, Constraint)):
        left, right = in_situation(measure.left, acting), in_situation(measure.right, acting)
        return measure if left is measure.left and right is measure.right else replace(measure, left=left, right=right)
    if not (isinstance(measure, Leaf) and isinstance(measure.bare_quantity, Request)):
        return measure
    quantity, situated = measure.quantity, measure.bare_quantity.under(acting, keep=True)
    if situated is measure.bare_quantity:
        return measure
    return replace(measure, quantity=replace(quantity, quantity=situated) if isinstance(quantity, Worst) else situated)


def shares_of(spectrum: Spectrum, where: str = "case") -> dict[str, float]:
    """Return the load cases of a duty by name, each with its share; the shares sum to one. DefinitionError for anything but a duty."""
    shown = f"{where}={cited(dict(spectrum))}"
    if not spectrum or not all(isinstance(name, str) for name in spectrum):
        raise DefinitionError(f'{shown}: the names of load cases with their hours are expected, case={{"empty": 700, "full": 300}}.')
    for name, hours in spectrum.items():
        require_number(f"{shown}: {name}", hours, "hours or a share are expected, a number, zero or more", least=0.0)
    total = float(sum(spectrum.values()))
    ensure(0.0 < total < np.inf, f"{shown}: all hours are zero; give one case some.")
    return {name: float(hours) / total for name, hours in spectrum.items()}


def in_duty(leaf: Leaf, case: object) -> Measure:
    """Return a measure in a load case; its mean where load cases are given with their hours. DefinitionError for anything else."""
    if case is None:
        return leaf
    if not isinstance(case, (str, LoadCase, Mapping)):
        said = 'a load case, its name, or load cases with their hours are expected, case={"empty": 700, "full": 300}'
        raise DefinitionError(f"{leaf}: case={cited(case)}: {said}.")
    if not is_quantity(leaf.bare_quantity):
        raise DefinitionError(f"{leaf}: case={cited(case)}: a function of a motion says its load case itself; leave case= out.")
    return mean_in_cases(leaf, shares_of(case)) if isinstance(case, Mapping) else in_case(leaf, case)


def mean_in_cases(measure: Measure, shares: Spectrum) -> Measure:
    """Return the mean of a measure over load cases, by shares that sum to one; itself where no load case changes it."""
    parts = [CombinedMeasure("*", FixedNumber(share), in_case(measure, name)) for name, share in shares.items()]
    if len(parts) == 1 or all(part.right is measure for part in parts):
        return parts[0].right
    return reduce(partial(CombinedMeasure, "+"), parts)


# Quantities as requests of a plan.


def traced(plan: Plan, quantity: object) -> Request | None:
    """Return a quantity bound to a plan as nodes of its program; None where it has none; DefinitionError for anything but a number."""
    if not is_quantity(quantity):
        return None
    with suppress(UntracedError, LawError):
        request = bound_quantity(plan, quantity)
        if request.rows > 1:
            name = words_of(quantity)
            remedy = f'say which, x("{name}") or y("{name}")' if quantity in plan.points else "take x(P) or y(P) for a point P in it"
            if isinstance(quantity, Value) and name_of(quantity.target) in plan.points:  # ratio(x(G), order=2) of ratio(G, order=2)
                parts = [str(replace(quantity, target=part(name_of(quantity.target)))) for part in (x, y)]
                remedy = f"say which, {' or '.join(parts)}"
            raise DefinitionError(f"{plan.title}: {name} has two components; {remedy}.")
        if request.traced_with is not None:
            plan.made_beside(("traced", request.traced_with), lambda twin: len(request.nodes(twin)))
        return request
    return None


def bound_quantity(plan: Plan, quantity: str | Quantity | Request) -> Request:
    """Return a quantity bound to a plan; a dimension by its name too, `"lift.closed"`."""
    if isinstance(quantity, str) and quantity not in plan.members and quantity in plan.table.spellings:
        return dimension_value(*plan.table.spellings[quantity])
    return bound(plan, quantity)


def strokes_behind(plan: Plan, quantity: object) -> tuple[str, ...]:
    """Return the strokes that a quantity depends on; all of them for a function of a motion."""
    if is_quantity(quantity):
        with suppress(UntracedError, LawError):
            names = bound_quantity(plan, quantity).names(plan)
            behind = names | plan.reaches(*(each for each in names if each in plan.members))
            return tuple(name for name in plan.strokes if name in behind)
    return tuple(plan.strokes)


def dimension_value(owner: str, sign: int) -> NodeRequest:
    """Return a dimension itself as a request, by its owner and sign."""
    return NodeRequest(
        text=owner, key=("dimension", owner, sign), names_of=lambda plan: set(),
        nodes_of=lambda plan: (plan.trace.inputs[owner] * float(sign),),
    )  # fmt: skip


# What measures are measured in: powers of length, force and time, and angles, so that what adds is of one kind and sentences have units.

KINDS = {
    "length": (1.0, 0.0, 0.0, 0.0), "force": (0.0, 1.0, 0.0, 0.0), "angle": (0.0, 0.0, 1.0, 0.0), "pressure": (-2.0, 1.0, 0.0, 0.0),
    "moment": (1.0, 1.0, 0.0, 0.0), "stiffness": (-1.0, 1.0, 0.0, 0.0), "area": (2.0, 0.0, 0.0, 0.0), "volume": (3.0, 0.0, 0.0, 0.0),
    "damping": (-1.0, 1.0, 0.0, 1.0), "angle per length": (-1.0, 0.0, 1.0, 0.0), "speed": (1.0, 0.0, 0.0, -1.0),
    "acceleration": (1.0, 0.0, 0.0, -2.0), "power": (1.0, 1.0, 0.0, -1.0), "flow": (3.0, 0.0, 0.0, -1.0), "number": (0.0, 0.0, 0.0, 0.0),
}  # fmt: skip
"""The powers of length, of force, of angle and of time in what is measured."""
APART = ("length", "angle", "force", "pressure", "speed", "acceleration", "power", "flow")
"""Kinds of which no two add or compare. Work and moments are written in many ways, an angle in them often left out."""


@record
class MeasureKind:
    """The powers of length, force, angle and time; `is_sure` where no number without a unit stands in a product, which may have had one."""

    powers: tuple[float, float, float, float]
    is_sure: bool = True

    def times(self, other: MeasureKind, sign: float = 1.0) -> MeasureKind:
        """Return the kind of a product, with sign -1.0 of a quotient."""
        powers = tuple(a + sign * b for a, b in zip(self.powers, other.powers, strict=True))
        return MeasureKind(powers, self.is_sure and other.is_sure)  # type: ignore[arg-type]

    def to_the(self, power: float) -> MeasureKind:
        """Return the kind of a power."""
        return MeasureKind(tuple(power * each for each in self.powers), self.is_sure)  # type: ignore[arg-type]

    @property
    def name(self) -> str:
        """Its name, "length"; an angle beside others counts as a number, as in a work. "" for a kind without a name."""
        length, force, _, time = self.powers
        among = [self.powers] + ([(length, force, 0.0, time)] if (length, force) != (0.0, 0.0) else [])
        return next((name for each in among for name, powers in KINDS.items() if powers == each), "")


# What a quantity measures, by its parts.


def measure_of(plan: Plan, quantity: object) -> str:
    """Return the kind of a quantity: "length", "angle", "force", "pressure", or "" where that is not known."""
    if isinstance(quantity, Leaf) and not isinstance(quantity, Integral):
        return measure_of(plan, quantity.quantity)
    known = stands_for(plan.members, quantity)
    found = measured_in(plan, known)
    if found:
        return "" if found in ("moment", "number") else str(found)
    sign, every = operation(known)
    parts = [each for each in every if constant_part(each) is None]
    scaled = isinstance(known, Combined) and len(parts) == 1 and (sign == "multiply" or (sign == "divide" and parts[0] is every[0]))
    kinds = {measure_of(plan, part) for part in parts} if scaled or sign in ("add", "subtract", "negative", *CHOOSING) else set()
    return kinds.pop() if len(kinds) == 1 else ""


CHOOSING = ("absolute", "minimum", "maximum")
NAMED = {symbol: function for function, symbol in UFUNCS.items()}
"""NumPy's functions by the operators that are written for them."""


def kind_of_quantity(plan: Plan, quantity: object) -> MeasureKind | None:
    """Return the kind of a quantity, a request or a measure; None where it is not known, and of a number.

    DefinitionError where parts are added that differ.
    """
    known = stands_for(plan.members, quantity)
    if isinstance(known, FixedNumber):
        return kind_called(known.measures)
    if isinstance(known, Integral):
        inner = kind_of_quantity(plan, known.quantity)
        by = [each for each in plan.strokes if known.by in (None, each)]
        of_strokes = {kind.name: kind for kind in (inner.times(kind_of_stroke(plan, each)) for each in by)} if inner is not None else {}
        return next(iter(of_strokes.values())) if len(of_strokes) == 1 else None  # of several kinds it depends on which stroke runs
    for name, value in known.strokes.items() if isinstance(known, At) else ():
        require_kind(plan, name, value, f"{plan.title}: {known}: {name}")
    if isinstance(known, (Leaf, Worst)):
        return kind_of_quantity(plan, known.quantity)
    if isinstance(known, str):
        owner = plan.table.spellings.get(known)
        return kind_called(plan_measure(plan, owner[0]) if owner else "")
    sign, parts = operation(known)
    if not sign and isinstance(known, Value) and known.along:
        inner = kind_called("length") if isinstance(stands_for(plan.members, known.target), Point) else kind_of_quantity(plan, known.target)
        by_stroke = kind_of_stroke(plan, stroke_of(plan, known.along[0]))
        return None if inner is None else inner.times(by_stroke.to_the(float(known.order)), -1.0)
    if not sign:  # of a moment it is told here, which is shown as a plain number
        return kind_called(measured_in(plan, known) or measure_of(plan, known))
    if sign in ("multiply", "divide"):
        a, b = ((kind_of_quantity(plan, each), constant_part(each)) for each in parts)
        return product_of(sign == "divide", a, b)
    kinds = [kind_of_quantity(plan, each) for each in parts if constant_part(each) is None]
    if sign in ("add", "subtract", *CHOOSING, "hypot", "negative"):
        return reduce(lambda one, other: common_kind(plan, words_of(known), one, other), kinds, None)
    if sign in ("power", "sqrt") and kinds and kinds[0] is not None:
        power = 0.5 if sign == "sqrt" else constant_part(parts[1])
        return None if power is None else kinds[0].to_the(power)
    return kind_called("angle") if sign == "arctan2" else None


def kind_called(name: str) -> MeasureKind | None:
    """Return the kind of that name, "length"; None for any other name."""
    return MeasureKind(KINDS[name]) if name in KINDS else None


def kind_of_stroke(plan: Plan, name: str) -> MeasureKind:
    """Return the kind of a stroke."""
    return MeasureKind(KINDS[stroke_measure(plan, name)])


def constant_part(part: object) -> float | None:
    """Return a number that stands in a quantity or a measure without a unit; None for anything else."""
    if isinstance(part, FixedNumber):
        return None if part.measures else part.value
    return part.number if isinstance(part, Number) else part if isinstance(part, float) else None


def operation(quantity: Any) -> tuple[str, tuple[Any, ...]]:
    """Return by which of NumPy's functions a quantity or a measure is made, and of what; "" for one that is no such thing."""
    if isinstance(quantity, CombinedMeasure):
        return NAMED[quantity.symbol], (quantity.left, quantity.right)
    if isinstance(quantity, Combined):
        return quantity.function, quantity.parts
    if isinstance(quantity, Operation):
        return NAMED[quantity.symbol], quantity.parts()
    if isinstance(quantity, Function):
        return quantity.symbol, quantity.parts()
    named = {Sum: "add", Negative: "negative"}.get(type(quantity), "")
    return named, quantity.parts() if named else ()


Part: TypeAlias = "tuple[MeasureKind | None, float | None]"
"""A part of a product: its kind, and the number that it is, if it is one."""


def product_of(divided: bool, left: Part, right: Part) -> MeasureKind | None:
    """Return the kind of a product or a quotient of two parts, each a kind and the number that it is, if it is one."""
    (a, number), (b, other) = left, right
    if number is not None and b is not None:
        found = b.to_the(-1.0) if divided else b
        return MeasureKind(found.powers, found.is_sure and number in (1.0, -1.0))
    if other is not None and a is not None:
        return MeasureKind(a.powers, a.is_sure and other in (1.0, -1.0))
    return None if a is None or b is None else a.times(b, -1.0 if divided else 1.0)


def common_kind(plan: Plan, what: str, left: MeasureKind | None, right: MeasureKind | None) -> MeasureKind | None:
    """Return the kind of a sum, or of two sides that are compared; DefinitionError where they cannot be added."""
    if left is None or right is None:
        return left or right
    kinds = left.name, right.name
    if left.is_sure and right.is_sure and kinds[0] != kinds[1] and all(each in APART for each in kinds):
        both = " and ".join(f"{article(each)} {each}" for each in kinds)
        raise DefinitionError(f"{plan.title}: {what}: {both} neither add nor compare; write both sides in one kind.")
    return left if left.is_sure else right


FAINTEST = 1000.0
"""Pa; less, and not none, was given in bar or another unit."""


def check_kinds(plan: Plan, measures: Iterable[Measure], constraints: Iterable[Constraint]) -> None:
    """Raise DefinitionError where measures or conditions add or compare different kinds."""
    for each in measures:
        kind_of_quantity(plan, each)
    for constraint in constraints:
        kinds = [kind_of_quantity(plan, side) for side in (constraint.left, constraint.right)]
        common_kind(plan, str(constraint), *kinds)
        for side, kind in zip((constraint.right, constraint.left), kinds, strict=True):
            if isinstance(side, FixedNumber) and side.measures not in ("", "angle") and kind == kind_called("number"):
                what = f"a plain number does not compare with {article(side.measures)} {side.measures}"
                raise DefinitionError(f"{plan.title}: {constraint}: {what}; write the limit without a unit.")
            if isinstance(side, FixedNumber) and not side.measures and is_faint(side.value) and kind == kind_called("pressure"):
                raise DefinitionError(f"{plan.title}: {constraint}: {bar_hint(side)}")


def is_faint(limit: object) -> bool:
    """Return whether a plain number would be next to nothing as a pressure [Pa]."""
    return is_number(limit) and not isinstance(limit, Amount) and 0.0 < abs(limit) < FAINTEST


def bar_hint(limit: object) -> str:
    """Return the words for a pressure limit that is next to nothing: bar were meant."""
    return f"{limit} Pa is next to nothing; write {limit} * bar if these are bar."


def check_condition(plan: Plan, condition: PoseCondition) -> None:
    """Raise DefinitionError where a condition on poses compares with an amount of another kind, `y("G") <= 20 * deg`, or no pressure."""
    for side, other in ((condition.left, condition.right), (condition.right, condition.left)):
        kind = kind_of_quantity(plan, side) if isinstance(other, Amount) else None
        if kind is not None and kind.is_sure and kind.name and (kind.name, getattr(other, "measures", "")) != ("number", "angle"):
            require_measure(other, kind.name, f"{plan.title}: {condition}: {words_of(side)}")
        if is_faint(other) and kind_of_quantity(plan, side) == kind_called("pressure"):
            raise DefinitionError(f"{plan.title}: {condition}: {bar_hint(other)}")


def measure_unit(plan: Plan, measure: Measure | Constraint) -> str:
    """Return the display unit of a measure, or of both sides of a condition; "" for a plain number and an unknown kind.

    >>> from linkage import *
    >>> from mechanisms.three_point_hitch import ThreePointHitch
    >>> measure_unit(ThreePointHitch().plan, integral(drive_force()))
    'Nm'
    """
    sides = (measure.left, measure.right) if isinstance(measure, Constraint) else (measure,)
    found = {display_unit(kind.name, "mm") for each in sides if (kind := kind_of_quantity(plan, each)) is not None}
    return found.pop() if len(found) == 1 else ""
