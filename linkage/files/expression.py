"""The arithmetic of a file: text to quantities, measures and conditions, by Python's own syntax and no other words than these.

A number may have a unit, `500 mm`. Beside numbers there are names, + - * / **, brackets and a few functions. Python's parser says how the
parts hang together; it sees none of them: each word stands in its tree by its place in the text.
"""

from __future__ import annotations

import ast
import math
import operator
import re
from abc import ABC, abstractmethod
from bisect import bisect_right
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache, partial
from inspect import signature
from itertools import accumulate
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
from ..quantities import Function, Length, Member, Number, Quantity, angle, distance, is_number, x, y
from ..quantities.quantity import FUNCTIONS, OPERATORS
from ..statics import acceleration, axle_load, drive_force, dynamic_factor, pin_force, slipping, speed
from ..steps import Arrow, CosineAngle, Point, Turn, Vector
from ..units import DIGITS, UNITS, Amount, parse
from .source import Keywords, Names

EXPRESSION_LENGTH = 1_000
OPERATIONS = 100
NESTING = 40
GRAMMAR = "an expression is made of numbers with units, names, + - * / **, brackets and functions such as angle(P, Q)"

# -- words -------------------------------------------------------------------------------------------------

OWN_WORDS = r"(?P<name>[^\W\d]\w*(?:\.[^\W\d]\w*)*)|(?P<sign>\*\*|[-+*/(),=])"


@lru_cache(maxsize=16)
def words_with_numbers(others: str, units: tuple[str, ...]) -> re.Pattern[str]:
    """Return the pattern of one word: a number with a unit, the further words of a grammar, or the end."""
    unit = "|".join(re.escape(name) for name in sorted(units, key=len, reverse=True))
    number = rf"(?P<number>{DIGITS}(?:[ \t]*(?P<unit>{unit})(?!\w))?)"
    return re.compile(rf"\s*(?:{number}|{others}|(?P<end>\Z))")


@dataclass(frozen=True, slots=True)
class Token:
    """A word of an expression: its kind (`number`, `name`, `sign`, `end`), its text, and a number's value [SI] and unit."""

    kind: str
    text: str
    value: float = 0.0
    unit: str = ""


def tokens(text: str, others: str = OWN_WORDS, grammar: str = GRAMMAR) -> list[Token]:
    """Return an expression's words, the last one of kind `end`; DefinitionError for anything else."""
    if len(text) > EXPRESSION_LENGTH:
        raise DefinitionError(f"the expression has {len(text)} characters; up to {EXPRESSION_LENGTH} are read. Give a part of it a name.")
    found: list[Token] = []
    pattern, place = words_with_numbers(others, tuple(UNITS)), 0
    while not found or found[-1].kind != "end":
        match = pattern.match(text, place)
        if match is None:
            raise DefinitionError(f"{text!r} cannot be read from {text[place:].strip()[:12]!r} on; {grammar}.")
        kind = str(match.lastgroup)
        word = match.group(kind)
        found.append(Token(kind, word, parse(word), match.group("unit") or "") if kind == "number" else Token(kind, word))
        place = match.end()
    if len(found) > 6 * OPERATIONS:
        raise DefinitionError(f"the expression has {len(found)} words; up to {6 * OPERATIONS} are read. Give a part of it a name.")
    return found


def one_unit(text: str) -> str:
    """Return the unit of a text that is one number with a unit, its sign apart; "" for any other. DefinitionError if it cannot be read."""
    values = [word for word in tokens(text) if word.kind in ("number", "name")]
    return values[0].unit if len(values) == 1 else ""


# -- what an expression may call, and nothing else ----------------------------------------------------------


def applied(function: str, *arguments: Quantity) -> Quantity:
    """Return NumPy's function of quantities; of numbers alone it is a number, as it is in a class."""
    values = [each.number for each in arguments if isinstance(each, Number)]
    if len(values) < len(arguments):
        return Function(function, *arguments)
    with np.errstate(all="ignore"):
        return Number(finite(float(FUNCTIONS[function](*values)), f"{function}({', '.join(map(repr, values))})"))


def finite(value: object, text: str) -> float:
    """Return a number; DefinitionError where a calculation has no finite one."""
    if not isinstance(value, (int, float)) or not math.isfinite(value):
        raise DefinitionError(f"{text} has no finite value.")
    return value


def length_or_size(argument: Arrow | str | Quantity) -> Quantity:
    """Return the length of a vector or of the one with that name, the absolute value of a quantity."""
    return applied("absolute", argument) if isinstance(argument, Quantity) else Length(argument)


PAIR = ("point", "point")
NUMERIC: Mapping[str, str] = MappingProxyType(
    {each: each for each in ("absolute", "sqrt", "sin", "cos", "tan", "exp", "log", "arctan2", "minimum", "maximum")}
    | {"abs": "absolute", "atan2": "arctan2", "min": "minimum", "max": "maximum"}
)
"""NumPy's functions by the names that a file may give them."""
CALLS: Mapping[str, tuple[tuple[str, ...], Callable[..., Member]]] = MappingProxyType({
    "angle": (PAIR, angle), "distance": (PAIR, distance), "x": (("point",), x), "y": (("point",), y),
    "CosineAngle": (("quantity",) * 3, CosineAngle), "abs": (("any",), length_or_size), "absolute": (("any",), length_or_size),
    "Vector": (PAIR, Vector), "Turn": (("vector", "quantity"), Turn),
    **{name: (("quantity",) * getattr(np, own).nin, partial(applied, own)) for name, own in NUMERIC.items() if own != "absolute"},
})  # fmt: skip
"""The functions by name: the kinds of their arguments, and what each makes of them."""
VECTORS: Mapping[str, tuple[str, ...]] = MappingProxyType({"Vector": (), "Turn": ("length",)})
"""Those that make a vector, with the arguments that they take by name; the others make a quantity."""

# -- reading -----------------------------------------------------------------------------------------------


def constant(name: str) -> float | None:
    """Return the value of a constant by its name: "pi", or a unit, `2 * mm`; None for any other name."""
    return math.pi if name == "pi" else UNITS[name][0] if name in UNITS else None


def expression(text: str, names: Names) -> Quantity:
    """Return the quantity that a text says; DefinitionError where it says none.

    What holds no name is calculated at once, as Python does it in a class: `"2 * 0.3"` is the number 0.6.
    """
    parser = Parser(text, names)
    found: Quantity = parser.meaning(parser.tree)
    return found


def arrow_in(text: str, names: Names) -> Arrow | str:
    """Return the vector that a text says, or the name of one; DefinitionError where it says none."""
    parser = Parser(text, names)
    found: Arrow | str = parser.argument(parser.tree, "vector")
    return found


SIGNS: Mapping[type[ast.operator], str] = {ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/", ast.Pow: "**"}


class Grammar(ABC):
    """A parser of one text by Python's syntax tree. A subclass defines its words and functions."""

    grammar: ClassVar[str] = GRAMMAR
    pattern: ClassVar[str] = OWN_WORDS
    known: Collection[str] = ()
    """Names that may stand in the text: one behind a number is no unit that is written wrong."""

    def __init__(self, text: str) -> None:
        self.text, self.tokens = text, tokens(text, self.pattern, self.grammar)
        signs = [token.text for token in self.tokens if token.kind == "sign"]
        depths = accumulate({"(": 1, ")": -1}.get(sign, 0) for sign in signs)
        if max(depths, default=0) > NESTING or sum(sign not in (")", ",", "=") for sign in signs) > OPERATIONS:
            raise self.too_deep()
        parts = [token.text if token.kind == "sign" else "_" for token in self.tokens[:-1]]
        self.starts = [*accumulate((len(part) + 1 for part in parts), initial=0)]
        try:
            self.tree: ast.expr = ast.parse(" ".join(parts), mode="eval").body
        except SyntaxError as error:
            said = self.misfit(error)
            raise DefinitionError(f"{text!r}: {said}" if said.endswith(".") else f"{text!r}: {said}; {self.grammar}.") from None

    def misfit(self, error: SyntaxError) -> str:
        """Return the expected words at the place of a wrong one."""
        place = bisect_right(self.starts, error.offset - 1) - 1 if error.offset else len(self.tokens) - 1
        word, before = self.tokens[place].text, self.tokens[max(place - 1, 0)]
        if error.msg.endswith("was never closed"):
            return f"{repr(',') if before.kind == 'name' else repr(')')} is expected where its end stands"
        if error.msg not in ("invalid syntax", "unmatched ')'"):
            return error.msg
        if before.kind == "number" and not before.unit and self.tokens[place].kind == "name" and word not in self.known:
            return str(unknown("Unit", word, UNITS))
        is_complete = place > 0 and (before.kind != "sign" or before.text == ")")
        wanted = "an operator or the end" if is_complete else "a number, a name or a bracket"
        return f"{wanted} is expected where {repr(word) if word else 'its end'} stands"

    @abstractmethod
    def atom(self, token: Token) -> Any:
        """Return a number, or the value of a name."""

    @abstractmethod
    def called(self, node: ast.Call, depth: int) -> Any:
        """Return the value of a function's call."""

    @abstractmethod
    def operation(self, sign: str, a: Any, b: Any) -> Any:
        """Return two parts joined; of numbers alone it is a number."""

    def negative(self, part: Any) -> Any:
        """Return a part with the other sign."""
        return -part

    def word(self, node: ast.expr | ast.keyword) -> Token:
        """Return the word that a part begins with."""
        return self.tokens[bisect_right(self.starts, node.col_offset) - 1]

    def is_word(self, node: ast.expr, *kinds: str) -> bool:
        """Return whether a part is one word of some kinds."""
        return isinstance(node, ast.Name) and self.word(node).kind in kinds

    def fault(self, wanted: str, node: ast.expr | ast.keyword) -> DefinitionError:
        """Return the error for a part that does not fit."""
        return DefinitionError(f"{self.text!r}: {wanted} is expected where {self.word(node).text!r} stands; {self.grammar}.")

    def too_deep(self) -> DefinitionError:
        """Return the error for too many brackets or operations."""
        return DefinitionError(
            f"{self.text[:40]!r}... is more than {NESTING} brackets deep or longer than {OPERATIONS} operations; give a part a name."
        )

    def meaning(self, node: ast.expr, depth: int = 0) -> Any:
        """Return the value of a part; of numbers alone it is a number."""
        if depth > NESTING:
            raise self.too_deep()
        match node:
            case ast.BinOp(left, sign, right):
                first = self.meaning(left, depth)
                return self.operation(SIGNS[type(sign)], first, self.meaning(right, depth + 1))
            case ast.UnaryOp(ast.USub(), operand):
                return self.negative(self.meaning(operand, depth + 1))
            case ast.UnaryOp(_, operand):
                return self.meaning(operand, depth + 1)
            case ast.Call(function) if self.is_word(function, "name"):
                return self.called(node, depth + 1)
            case ast.Name():
                return self.atom(self.word(node))
        raise self.fault("a number, a name or a bracket", node)


class Parser(Grammar):
    """Reads one expression of a file."""

    def __init__(self, text: str, names: Names) -> None:
        self.names, self.known = names, names.kinds
        super().__init__(text)

    def negative(self, part: Quantity) -> Quantity:
        return Number(-part.number) if isinstance(part, Number) else -part

    def operation(self, sign: str, a: Quantity, b: Quantity) -> Quantity:
        if not (isinstance(a, Number) and isinstance(b, Number)):
            made: Quantity = OPERATORS[sign](a, b)
            return made
        text = f"{a.number!r} {sign} {b.number!r}"
        try:
            return Number(finite(OPERATORS[sign](a.number, b.number), text))
        except ArithmeticError:
            raise DefinitionError(f"{text} has no finite value.") from None

    def atom(self, token: Token) -> Quantity:
        if token.kind == "number":
            return Number(token.value)
        if token.text not in self.names.kinds and (value := constant(token.text)) is not None:
            return Number(value)
        return self.names.quantity(self.checked(token.text, "quantity"))

    def called(self, node: ast.Call, depth: int, kind: str = "quantity") -> Member:
        """Return the value of a function's call; it must be of a kind."""
        name = self.word(node.func).text
        if name not in CALLS:
            raise DefinitionError(f"{self.text!r}: {unknown('Function', name, CALLS)}")
        (kinds, make), by_name, said = CALLS[name], VECTORS.get(name, ()), f"{self.text!r}: {name}(...)"
        ensure((kind == "vector") is (name in VECTORS), f"{said} is not a {kind}.")
        ensure(len(node.args) == len(kinds), f"{said} takes {len(kinds)} arguments, not {len(node.args)}.")
        found = [self.argument(each, kind, depth) for each, kind in zip(node.args, kinds, strict=True)]
        keywords: Keywords = {}
        for each in node.keywords:
            key = self.word(each).text
            if key not in by_name or key in keywords:
                raise self.fault(" or ".join(f"{one}=" for one in by_name) or "no argument by name", each)
            keywords[key] = self.meaning(each.value, depth)
        return make(*found, **keywords)

    def argument(self, node: ast.expr, kind: str, depth: int = 0) -> Any:
        """Return one argument: a point's name, a vector or its name, or a quantity."""
        name, is_name = self.word(node).text, self.is_word(node, "name")
        call = node if isinstance(node, ast.Call) and self.is_word(node.func, "name") else None
        if kind == "any":
            is_vector = name in VECTORS if call is not None and name in CALLS else self.names.kinds.get(name) == "vector"
            kind = "vector" if is_vector and (call is not None or is_name) else "quantity"
        if kind == "quantity":
            return self.meaning(node, depth)
        if call is not None and kind == "vector":
            return self.called(call, depth + 1, kind)
        if not is_name:
            raise self.fault(f"the name of a {kind}", node)
        return self.checked(name, kind)

    def checked(self, name: str, kind: str) -> str:
        """Return a name of a kind; DefinitionError, with the expression, for any other."""
        try:
            return self.names.checked(name, kind)
        except DefinitionError as error:
            raise DefinitionError(f"{self.text!r}: {error}") from None


# -- measures and conditions: `least(capacity(lift, G))`, `most(abs(tilt)) <= 8 deg`, `fits(lift)`, `reachable` ----------------
#
# A criterion is an expression of a file, or two of them with <=, >= or == between. An argument of a function may be a word, a text in
# quotes, or two numbers in brackets, and may stand by its name, `S=100 mm`. A name is an output, a dimension or a stroke of the machine.
# Nothing is run but the functions that are known by name.
#
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
