"""The eager reading of a program: node by node over whole arrays. Slow and plain, the kernels' oracle."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from .lower import ancestors, plain
from .node import Node
from .operations import OPERATIONS


def interpret(
    outputs: Sequence[Node], inputs: Mapping[str, Any], known: Mapping[Node, Any] | None = None, *, clipped: bool = False
) -> list[Any]:
    """Return the values of some nodes; every input is a float or an array, broadcast by NumPy. `known` holds values to start from.

    With `clipped` the root of a negative number is zero: for poses that are known to stand at a dead point to rounding.
    """
    values: dict[Node, Any] = dict(known or {})
    with np.errstate(all="ignore"):
        for node in ancestors(outputs, known or {}):
            if node in values:
                continue
            if node.op == "constant":
                values[node] = node.value
            elif node.op == "input":
                values[node] = inputs[node.value]
            else:
                args = [values[plain(arg)] for arg in node.args]
                if clipped and node.op == "sqrt":
                    args = [np.maximum(args[0], 0.0)]
                values[node] = OPERATIONS[node.op].array(*args)
    return [values[plain(node)] for node in outputs]
