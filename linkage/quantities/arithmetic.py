"""The operators and functions that quantities know: what they compute, and how they are written."""

from __future__ import annotations

import operator
from collections.abc import Callable
from typing import Any

import numpy as np

FUNCTIONS: dict[str, Callable[..., Any]] = {
    name: getattr(np, name) for name in ("sqrt", "sin", "cos", "tan", "arctan2", "exp", "log", "absolute", "minimum", "maximum")
}
OPERATORS: dict[str, Callable[[Any, Any], Any]] = {"*": operator.mul, "/": operator.truediv, "**": operator.pow}
UFUNCS = {"add": "+", "subtract": "-", "multiply": "*", "true_divide": "/", "divide": "/", "power": "**"}
BINDS = {"*": (2, 2, 3), "/": (2, 2, 3), "**": (3, 4, 4)}
"""How strongly an operator binds, and how strongly its left and its right side must, to stand without brackets."""
