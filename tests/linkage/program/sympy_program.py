"""The traced program read by SymPy: an independent source of exact derivatives, for short chains. Slow.

It is not the engine: one closed form of a three-point hitch has millions of operations.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import sympy

from linkage import DefinitionError
from linkage.plan import Plan
from linkage.program import Node

READINGS: dict[str, Callable[..., Any]] = {
    "add": lambda a, b: a + b,
    "subtract": lambda a, b: a - b,
    "multiply": lambda a, b: a * b,
    "negative": lambda a: -a,
    "reciprocal": lambda a: 1 / a,
    "sqrt": sympy.sqrt,
    "sin": sympy.sin,
    "cos": sympy.cos,
    "tan": sympy.tan,
    "arctan2": sympy.atan2,
    "exp": sympy.exp,
    "log": sympy.log,
    "power": lambda a, b: a**b,
    "absolute": sympy.Abs,
    "sign": sympy.sign,
    "minimum": sympy.Min,
    "maximum": sympy.Max,
    "pick": lambda a, b, x, y: sympy.Piecewise((x, a <= b), (y, True)),
    "root": lambda value: value,
}
"""What each operation of a program means; a root is read as the value that selects it."""


def program_expressions(plan: Plan, target: str) -> tuple[Any, ...]:
    """Return a point (two) or an output (one) as closed SymPy expressions of the plan's strokes and dimensions.

    Their symbols are `sympy.Symbol(name, real=True)`. Raises DefinitionError for what has no closed form.
    """
    found: dict[Node, Any] = {}
    return tuple(_expression(node, found) for node in plan.nodes(target))


def _expression(node: Node, found: dict[Node, Any]) -> Any:
    if node not in found:  # numbers are exactly the floats they are
        if node.op == "constant":
            found[node] = sympy.Rational(node.value)
        elif node.op == "input":
            found[node] = sympy.Symbol(node.value, real=True)
        elif node.op not in READINGS:
            raise DefinitionError(f"The program's operation {node.op!r} has no closed form.")
        else:
            found[node] = READINGS[node.op](*(_expression(each, found) for each in node.args))
    return found[node]
