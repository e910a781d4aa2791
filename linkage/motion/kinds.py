"""What measures are measured in: powers of length and force, and angles, so that what adds is of one kind and sentences have units.

>>> from linkage import *
>>> from mechanisms.three_point_hitch import ThreePointHitch
>>> measure_unit(ThreePointHitch().plan, integral(drive_force()))
'kNm'
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import reduce
from typing import Any, TypeAlias, final

from ..errors import DefinitionError, article
from ..plan import Plan, plan_measure, require_kind
from ..quantities import PoseCondition, Quantity, Ref
from ..quantities.quantity import Function, Negative, Number, Operation, Sum
from ..steps import Point
from ..units import Amount, require_measure
from .limits import stroke_unit
from .measures import At, CombinedMeasure, Constraint, Given, Integral, Leaf, Measure, Worst, words_of
from .requests import Combined, Request, Value, stroke_of

KINDS = {
    "length": (1.0, 0.0, 0.0), "force": (0.0, 1.0, 0.0), "angle": (0.0, 0.0, 1.0), "pressure": (-2.0, 1.0, 0.0),
    "moment": (1.0, 1.0, 0.0), "stiffness": (-1.0, 1.0, 0.0), "area": (2.0, 0.0, 0.0), "volume": (3.0, 0.0, 0.0),
    "angle per length": (-1.0, 0.0, 1.0),
}  # fmt: skip
"""The powers of length, of force and of angle in what is measured."""
SHOWN = {
    "length": "mm", "force": "kN", "angle": "deg", "pressure": "bar", "moment": "kNm", "stiffness": "N/mm", "area": "cm2", "volume": "l",
    "angle per length": "rad/m",
}  # fmt: skip
APART = ("length", "angle", "force", "pressure")
"""Kinds of which no two add or compare. Work and moments are written in many ways, an angle in them often left out."""


@final
@dataclass(frozen=True)
class MeasureKind:
    """The powers of length, force and angle; `is_sure` where no number without a unit stands in a product, which may have had one."""

    powers: tuple[float, float, float]
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
        """What it is called, "length"; an angle beside others counts as a number, as in a work. "" for what has no name."""
        length, force, turned = self.powers
        among = [(length, force, turned)] + ([(length, force, 0.0)] if (length, force) != (0.0, 0.0) else [])
        return next((name for each in among for name, powers in KINDS.items() if powers == each), "")


# What a quantity measures, by its parts.


def measure_of(plan: Plan, quantity: object) -> str:
    """Return what a quantity measures: "length", "angle", "force", "pressure", or "" where that is not known."""
    if isinstance(quantity, Leaf) and not isinstance(quantity, Integral):
        return measure_of(plan, quantity.quantity)
    known = plan.members.get(quantity) if isinstance(quantity, str) else quantity
    if isinstance(known, Ref):
        return measure_of(plan, known.target)
    found = known.measured(plan) if isinstance(known, Request) else known.measures if isinstance(known, Quantity) else ""
    if found:
        return "" if found == "moment" else str(found)
    sign, every = operation(known)
    parts = [each for each in every if constant_part(each) is None]
    scaled = isinstance(known, Combined) and len(parts) == 1 and (sign == "multiply" or (sign == "divide" and parts[0] is every[0]))
    kinds = {measure_of(plan, part) for part in parts} if scaled or sign in ("add", "subtract", "negative", *CHOOSING) else set()
    return kinds.pop() if len(kinds) == 1 else ""


CHOOSING = ("absolute", "minimum", "maximum")


def kind_of_measure(plan: Plan, measure: Measure) -> MeasureKind | None:
    """Return the kind of a measure; None where it is not known, and of a number. DefinitionError where parts are added that differ."""
    if isinstance(measure, Given):
        return kind_called(measure.measures)
    if isinstance(measure, Integral):
        by = measure.by or (next(iter(plan.strokes)) if len(plan.strokes) == 1 else "")
        inner = kind_of_quantity(plan, measure.quantity)
        return None if inner is None or by not in plan.strokes else inner.times(kind_of_stroke(plan, by))
    if isinstance(measure, Leaf):
        for name, value in measure.strokes.items() if isinstance(measure, At) else ():
            require_kind(plan, name, value, f"{plan.title}: {measure}: {name}")
        return kind_of_quantity(plan, measure.quantity)
    assert isinstance(measure, CombinedMeasure)
    left, right = (kind_of_measure(plan, each) for each in (measure.left, measure.right))
    if measure.symbol in ("+", "-"):
        return common_kind(plan, str(measure), left, right)
    if measure.symbol == "**":
        power = measure.right.value if isinstance(measure.right, Given) else None
        return None if left is None or power is None else left.to_the(power)
    return product_of(measure.symbol == "/", (left, unitless_number(measure.left)), (right, unitless_number(measure.right)))


def kind_of_quantity(plan: Plan, quantity: object) -> MeasureKind | None:
    """Return the kind of a quantity or request; None where it is not known, and of a number. DefinitionError as for a measure."""
    known = plan.members.get(quantity) if isinstance(quantity, str) else quantity
    if isinstance(known, Worst):
        return kind_of_quantity(plan, known.quantity)
    if isinstance(known, Ref):
        return kind_of_quantity(plan, known.target)
    if known is None and isinstance(quantity, str):
        owner = plan.table.spellings.get(quantity)
        return kind_called(plan_measure(plan, owner[0]) if owner else "")
    sign, parts = operation(known)
    if not sign and isinstance(known, Value) and known.along:
        target = plan.members.get(known.target) if isinstance(known.target, str) else known.target
        inner = kind_called("length") if isinstance(target, Point) else kind_of_quantity(plan, known.target)
        by = kind_of_stroke(plan, stroke_of(plan, known.along[0]))
        return None if inner is None else inner.times(by.to_the(float(known.order)), -1.0)
    if not sign:  # of a moment it is told here, which is shown as a plain number
        return kind_called((known.measured(plan) if isinstance(known, Request) else "") or measure_of(plan, known))
    kinds = [kind_of_quantity(plan, each) for each in parts if constant_part(each) is None]
    if sign in ("add", "subtract", *CHOOSING, "hypot", "negative"):
        return reduce(lambda one, other: common_kind(plan, words_of(known), one, other), kinds, None)
    if sign in ("multiply", "divide"):
        a, b = ((kind_of_quantity(plan, each), constant_part(each)) for each in parts)
        return product_of(sign == "divide", a, b)
    if sign in ("power", "sqrt") and kinds and kinds[0] is not None:
        power = 0.5 if sign == "sqrt" else constant_part(parts[1])
        return None if power is None else kinds[0].to_the(power)
    return kind_called("angle") if sign == "arctan2" else None


def kind_called(name: str) -> MeasureKind | None:
    """Return the kind by what it is called, "length"; None for any other name."""
    return MeasureKind(KINDS[name]) if name in KINDS else None


def kind_of_stroke(plan: Plan, name: str) -> MeasureKind:
    """Return the kind of a stroke."""
    return MeasureKind(KINDS["length" if stroke_unit(plan, name) == "m" else "angle"])


def unitless_number(measure: Measure) -> float | None:
    """Return a number without a unit; None for any other measure."""
    return measure.value if isinstance(measure, Given) and not measure.measures else None


def constant_part(part: object) -> float | None:
    """Return a number that stands in a quantity; None for anything else."""
    return part.number if isinstance(part, Number) else part if isinstance(part, float) else None


def operation(quantity: Any) -> tuple[str, tuple[Any, ...]]:
    """Return by which of NumPy's functions a quantity is made, and of what; "" for one that is no such thing."""
    if isinstance(quantity, Combined):
        return quantity.function, quantity.parts
    if isinstance(quantity, Operation):
        return {"*": "multiply", "/": "divide", "**": "power"}[quantity.symbol], quantity.parts()
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


def check_kinds(plan: Plan, measures: Iterable[Measure], constraints: Iterable[Constraint]) -> None:
    """Raise DefinitionError where measures or conditions add or compare what differs in kind."""
    for each in measures:
        kind_of_measure(plan, each)
    for constraint in constraints:
        common_kind(plan, str(constraint), *(kind_of_measure(plan, side) for side in (constraint.left, constraint.right)))


def check_condition(plan: Plan, condition: PoseCondition) -> None:
    """Raise DefinitionError where a condition on poses compares a quantity with an amount of another kind: `y("G") <= 20 * deg`."""
    for side, other in ((condition.left, condition.right), (condition.right, condition.left)):
        kind = kind_of_quantity(plan, side) if isinstance(other, Amount) else None
        if kind is not None and kind.is_sure and kind.name:
            require_measure(other, kind.name, f"{plan.title}: {condition}: {words_of(side)}")


def measure_unit(plan: Plan, measure: Measure | Constraint) -> str:
    """Return the unit that a measure, or both sides of a condition, are shown in; "" for a plain number and what is not known."""
    sides = (measure.left, measure.right) if isinstance(measure, Constraint) else (measure,)
    found = {SHOWN.get(kind.name, "") for each in sides if (kind := kind_of_measure(plan, each)) is not None}
    return found.pop() if len(found) == 1 else ""

