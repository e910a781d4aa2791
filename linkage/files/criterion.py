"""Measures and conditions as text: `least(capacity(lift, G))`, `most(abs(tilt)) <= 8 deg`, `fits(lift)`, `reachable`.

A criterion is an expression of a file, or two of them with <=, >= or == between. An argument of a function may be a word, a text in
quotes, or two numbers in brackets, and may stand by its name, `S=100 mm`.

A name is an output, a dimension or a stroke of the machine. Nothing is run but the functions that are known by name.
"""

from __future__ import annotations

import ast
import operator
from collections.abc import Callable, Mapping, Sequence
from inspect import signature
from types import MappingProxyType
from typing import Any, ClassVar

import numpy as np

from .. import plugins
from ..errors import DefinitionError, ensure, unknown
from ..mechanism import Mechanism
from ..motion import Condition, Measure, Request, at, condition, gap, integral, least, measures, most, ratio, reachable, transmission, worst
from ..motion.measures import KINDS, Constraint, FixedNumber, MeasureKind, Worst, strokes_behind, words_of
from ..motion.requests import Combined
from ..plugins import Plugins
from ..quantities import Number, Quantity, angle, distance, is_number, x, y
from ..quantities.quantity import OPERATORS
from ..statics import acceleration, axle_load, drive_force, dynamic_factor, pin_force, slipping, speed
from ..steps import Point
from ..units import UNITS, Amount
from .expression import NUMERIC, Grammar, Token, constant, finite
from .source import Keywords

# What a study file may ask for: the requests and conditions of this package, and those that others bring.
#
# A package adds its own by entry points of the group `hydrolinkage.requests`, each a function that returns a request or a condition:
# `thrust = "hydraulics:thrust"` is `thrust(lift)` in a file.

REQUESTS = Plugins[Callable[..., Any]](
    plugins.REQUESTS,
    "the request",
    lambda found: found if callable(found) else None,
    "no function",
    {
        "ratio": ratio, "drive_force": drive_force, "pin_force": pin_force, "axle_load": axle_load, "slipping": slipping,
        "transmission": transmission, "gap": gap, "condition": condition, "speed": speed, "acceleration": acceleration,
        "dynamic_factor": dynamic_factor,
    },
)  # fmt: skip
"""The requests there are, by name."""


def request_function(name: str, beside: tuple[str, ...] = ()) -> Callable[..., Any]:
    """Return the function of a request by name; DefinitionError for one that is unknown, or that cannot be loaded.

    `beside` are the names of functions that are known in its place too.
    """
    if name not in REQUESTS:
        raise unknown("Function", name, [*beside, *REQUESTS])
    return REQUESTS[name]


CRITERION_GRAMMAR = (
    "a criterion is made of least(...), most(...), integral(...), at(..., S=...), names, numbers with units, + - * / **, and <= >= =="
)
_CRITERION = (
    r"(?P<name>[^\W\d]\w*(?:\.[^\W\d]\w*)*)|(?P<text>'[^'\n]*'|\"[^\"\n]*\")"
    r"|(?P<sign>\*\*|<=|>=|==|!=|[-+*/(),=<>])"
)
COMPARING: Mapping[type[ast.cmpop], Callable[[Any, Any], Any]] = {ast.LtE: operator.le, ast.GtE: operator.ge, ast.Eq: operator.eq}

MEASURES: Mapping[str, Callable[..., Any]] = MappingProxyType(
    {"least": least, "most": most, "integral": integral, "at": at, "worst": worst}
)
"""What makes measures of quantities, and `worst`, which makes a quantity."""
PLACED: Mapping[str, Callable[..., Quantity]] = MappingProxyType({"angle": angle, "distance": distance, "x": x, "y": y})
"""What makes quantities of points."""
CONDITIONS: Mapping[str, Condition] = MappingProxyType({"reachable": reachable})
AXES = {"_x": x, "_y": y, ".x": x, ".y": y}


def measure_said(text: object, machine: Mechanism, over: Mapping[str, object] | None = None) -> Measure:
    """Return the measure of this machine that a text says; DefinitionError for anything else.

    What depends on no stroke is one too: `mass`.
    """
    found = criterion_of(text, machine)
    ensure(not isinstance(found, Condition), f"{text!r} is a condition; a measure is expected, such as least(...), with no <=, >= or ==.")
    if is_number(found) or isinstance(found, FixedNumber):
        raise DefinitionError(f"{text!r} is the same for every design; write a measure of the machine, such as least(...), or an output.")
    measure = measure_or_constant(found, machine)
    refuse_unknown(machine, [measure], over=over)
    return measure


def refuse_unknown(machine: Mechanism, asked: Sequence[Measure], limits: Sequence[Constraint] = (), over: Any = None) -> None:
    """Raise DefinitionError for what a machine has not, such as an unknown point or stroke."""
    from ..study.problem import NOWHERE, Problem  # tables of results read the names above and need no study

    Problem(machine, asked, limits, NOWHERE, over=over)


def measure_or_constant(found: Any, machine: Mechanism) -> Measure:
    """Return a measure, also of a quantity with one value for a design; DefinitionError for one with a value at every pose."""
    is_quantity = isinstance(found, (str, Quantity, Request))
    return at(found) if is_quantity and not strokes_behind(machine.plan, found) else measures.as_measure(found)


def condition_said(text: object, machine: Mechanism, over: Mapping[str, object] | None = None) -> Condition:
    """Return the condition on this machine that a text says; DefinitionError for anything else."""
    found: Condition = criterion_of(text, machine)
    ensure(isinstance(found, Condition), f"{text!r}: {CriterionParser.words(found)} says no limit; write one such as most(...) <= 8 deg.")
    refuse_unknown(machine, [], [*found.constraints(machine)], over)
    return found


def quantity_said(text: object, machine: Mechanism) -> Any:
    """Return the quantity over poses that a text says: an output's name, a quantity or a request; DefinitionError for anything else."""
    found = criterion_of(text, machine)
    if is_number(found) or isinstance(found, (Measure, Condition, Worst)):
        raise DefinitionError(f"{text!r} has no value at every pose; write an output such as tilt, or a request such as drive_force().")
    refuse_unknown(machine, [most(found)])
    measures.traced(machine.plan, found)  # which refuses what has two components
    return found


def criterion_of(text: object, machine: Mechanism) -> Any:
    """Return the number, quantity, measure or condition of a machine that a text says; DefinitionError for anything else."""
    if not isinstance(text, str) or not text.strip():
        raise DefinitionError(f'{text!r:.60} is no text in quotes, such as "least(tilt)".')
    parser = CriterionParser(text, machine)
    try:
        return parser.compared(parser.tree) if isinstance(parser.tree, ast.Compare) else parser.meaning(parser.tree)
    except DefinitionError as error:
        said = str(error)
        raise DefinitionError(said if said.startswith(repr(text)) else f"{text!r}: {said}") from None


class CriterionParser(Grammar):
    """Reads one measure, quantity or condition of a machine."""

    grammar: ClassVar[str] = CRITERION_GRAMMAR
    pattern: ClassVar[str] = _CRITERION

    def __init__(self, text: str, machine: Mechanism) -> None:
        super().__init__(text)
        self.machine, self.plan = machine, machine.plan

    def compared(self, node: ast.Compare) -> Condition:
        """Return the condition that two sums make."""
        sign = COMPARING.get(type(node.ops[0]))
        if sign is None:
            wrong = next(token.text for token in self.tokens if token.text in ("<", ">", "!="))
            raise DefinitionError(f"a search meets its conditions exactly; write >=, <= or == for {wrong}.")
        ensure(len(node.ops) <= 1, "one comparison makes a condition; write two conditions for a value between two limits.")
        left, right = self.meaning(node.left), self.meaning(node.comparators[0])
        ensure(not (is_number(left) and is_number(right)), "two numbers are compared; one side is a measure such as least(...).")
        one, other = (measure_or_constant(each, self.machine) for each in (left, right))
        found: Condition = sign(one, other)
        return found

    # -- parts -----------------------------------------------------------------------------------------

    def operation(self, sign: str, a: object, b: object) -> Any:
        if sign in ("*", "/") and isinstance(a, Request) and isinstance(b, Amount):
            return Combined("multiply" if sign == "*" else "divide", (a, Number(float(b))))  # measures something else
        said = f"{self.words(a)} {sign} {self.words(b)}"
        if sign in ("+", "-"):
            measures.common_kind(self.plan, said, self.kind_of(a), self.kind_of(b))
        try:
            found = OPERATORS[sign](a, b)
        except ArithmeticError:
            raise DefinitionError(f"{a!r} {sign} {b!r} has no finite value.") from None
        except TypeError:
            raise DefinitionError(f"{said} cannot be calculated.") from None
        if not (is_number(a) and is_number(b)):
            return found
        number = finite(found, f"{a!r} {sign} {b!r}")
        units = [each.measures for each in (a, b) if isinstance(each, Amount)]
        is_multiple = len(units) == 1 and (sign == "*" or (sign == "/" and isinstance(a, Amount)))
        return Amount(number, units[0]) if is_multiple else number

    def kind_of(self, part: object) -> MeasureKind | None:
        """Return the kind of a term in a sum; None for a number, which may be added to anything."""
        if isinstance(part, Amount):
            return MeasureKind(KINDS[part.measures]) if part.measures in KINDS else None
        return measures.kind_of_quantity(self.plan, part) if isinstance(part, (Quantity, Request)) else None

    def negative(self, part: Any) -> Any:
        ensure(not isinstance(part, str), f"-{part} cannot be calculated; a dimension stands by itself, at({part}).")
        return -part

    @staticmethod
    def words(part: object) -> str:
        """Return a part in words."""
        return words_of(part) if isinstance(part, (Quantity, Request, Worst, str)) else str(part)

    def atom(self, token: Token) -> Any:
        if token.kind == "number":
            return Amount(token.value, UNITS[token.unit][1]) if token.unit else token.value
        plan, name = self.plan, token.text.strip("'\"")
        member = plan.members.get(name)
        if isinstance(member, Quantity):
            return member
        remedy = f"x({name}) or y({name})" if isinstance(member, Point) else f"a request of it, such as thrust({name})"
        ensure(member is None, f"{name} = {member} is no number; write {remedy}.")
        if name in CONDITIONS:
            return CONDITIONS[name]
        if name in plan.table.spellings:
            return name
        if (coordinate := self.coordinate(name)) is not None:
            return coordinate
        if (value := constant(name)) is not None:
            return value
        quantities = [each for each, one in plan.members.items() if isinstance(one, Quantity)]
        raise unknown("Quantity", name, list(dict.fromkeys([*quantities, *plan.table.names()])), where=plan.title)

    def coordinate(self, name: str) -> Quantity | None:
        """Return the coordinate of a point that a name means, `G_y` or `G.y`; None for any other."""
        return AXES[name[-2:]](name[:-2]) if name[:-2] in self.plan.points and name[-2:] in AXES else None

    # -- functions -------------------------------------------------------------------------------------

    def called(self, node: ast.Call, depth: int) -> Any:
        name = self.word(node.func).text
        make, of_quantities = self.function(name), name in MEASURES or name in NUMERIC
        positional = [self.argument(each, of_quantities, depth) for each in node.args]
        named: Keywords = {}
        for each in node.keywords:
            key = self.word(each).text
            ensure(key not in named, f"{key}= stands twice.")
            named[key] = self.argument(each.value, False, depth)
        parameters = signature(make).parameters
        try:
            given = signature(make).bind(*positional, **named)
        except TypeError as error:
            raise DefinitionError(f"{name}(...): {error}; write {name}({', '.join(parameters)}).") from None
        for key, value in given.arguments.items():  # a whole number in the place of one, such as the order of a derivative
            if type(value) is float and value.is_integer() and parameters[key].annotation in (int, "int"):
                given.arguments[key] = int(value)
        try:
            return make(*given.args, **given.kwargs)
        except TypeError:
            said = ", ".join(map(self.words, positional))
            raise DefinitionError(f"{name}({said}) cannot be calculated; it takes quantities and numbers.") from None

    def function(self, name: str) -> Callable[..., Any]:
        """Return a function by its name."""
        if name in MEASURES or name in PLACED:
            return {**MEASURES, **PLACED}[name]
        if name not in NUMERIC:
            return request_function(name, (*MEASURES, *PLACED, *NUMERIC))
        function = getattr(np, NUMERIC[name])

        def made(*parts: object) -> Any:
            """Return NumPy's function of numbers, quantities and requests; a number of numbers."""
            wrong = [self.words(each) for each in parts if isinstance(each, (Measure, str, Worst))]
            if wrong:
                what = f"{NUMERIC[name]}({wrong[0]}) cannot be calculated"
                raise DefinitionError(f"{what}; it takes quantities over poses, as least(abs(q)).")
            ensure(len(parts) == function.nin, f"{NUMERIC[name]}(...) takes {function.nin} arguments, not {len(parts)}.")
            with np.errstate(all="ignore"):
                found = function(*parts)
            return finite(float(found), f"{NUMERIC[name]}({', '.join(map(repr, parts))})") if all(map(is_number, parts)) else found

        return made

    def argument(self, node: ast.expr, of_quantities: bool, depth: int) -> Any:
        """Return one argument: a name or a text as it stands, two numbers in brackets, or a sum."""
        if not of_quantities and self.is_word(node, "name", "text"):
            word = self.word(node).text.strip("'\"")
            if word not in self.plan.members and (coordinate := self.coordinate(word)) is not None:
                return coordinate
            return {"true": True, "false": False, "least": least, "most": most}.get(word, word)
        if not of_quantities and isinstance(node, ast.Tuple) and len(node.elts) == 2:
            return tuple(self.meaning(each, depth) for each in node.elts)
        return self.meaning(node, depth)
