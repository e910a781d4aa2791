"""A program in C: a function over the poses of one design."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from types import MappingProxyType

from .elimination import expanded
from .loop import lettered, loop_text
from .node import Node
from .schedule import Schedule, schedule
from .text import TEMPLATES, Dialect, NodeNames

NOTHING: Mapping[str, float] = MappingProxyType({})


def number_text(value: float, infinite: str, nothing: str) -> str:
    """Return a number as a language writes it."""
    if math.isnan(value):
        return nothing
    return repr(value) if math.isfinite(value) else infinite if value > 0.0 else f"-{infinite}"


C = Dialect(
    {
        **TEMPLATES,
        "sign": "({0} > 0.0 ? 1.0 : {0} < 0.0 ? -1.0 : {0})",
        "minimum": "({0} <= {1} || {0} != {0} ? {0} : {1})",
        "maximum": "({0} >= {1} || {0} != {0} ? {0} : {1})",
        "pick": "({0} <= {1} ? {2} : {3})",
        "arctan2": "atan2({}, {})",
        "absolute": "fabs({})",
        "power": "pow({}, {})",
    },
    lambda value: number_text(value, "INFINITY", "NAN"),
    "const double {} = {};",
)


def c_text(outputs: Sequence[Node], name: str = "poses", design: Mapping[str, float] = NOTHING) -> str:
    """Return C99 text of `void poses(long n, const double *d, const double *const *p, double *const *o)`.

    `d` holds the dimensions, `p` the strokes and solved coordinates, each n long, `o` the outputs, each n long; a comment
    names them, with the values of a design. For its full speed compile it with `-O3 -march=native -fno-math-errno -fno-trapping-math`.
    """
    plan = schedule(expanded(outputs))
    inside = loop_text(plan, C)
    lines = [
        "#include <math.h>",
        comment(plan, design),
        f"void {name}(long n, const double *d, const double *const *p, double *const *o) {{",
        *(f"    {line}" for line in design_lines(plan)),
        *(f"    const double *restrict x{k} = p[{k}];" for k in range(len(plan.pose_inputs))),
        *(f"    double *restrict o{k} = o[{k}];" for k in range(len(plan.outputs))),
        "    for (long b = 0; b < n; b++) {",
        *(f"        const double i{k} = x{k}[b];" for k in range(len(plan.pose_inputs))),
        *(f"        {line}" for line in inside.lines),
        *(f"        o{k}[b] = {result};" for k, result in enumerate(inside.outputs)),
        "    }",
        "}",
    ]
    return "\n".join(lines) + "\n"


def design_lines(plan: Schedule) -> list[str]:
    """Return the design part, its results called as the loop calls them."""
    names = NodeNames(C, {node: f"d[{k}]" for k, node in enumerate(plan.design_inputs)})
    lines = names.assign(plan.design, "w")
    return lines + [C.assignment.format(name, names.read(node)) for node, name in lettered("c", plan.passed).items()]


def comment(plan: Schedule, design: Mapping[str, float]) -> str:
    """Return which inputs are which, and what those of a design are."""
    names = [node.value for node in plan.design_inputs]
    given = ", ".join(f"{name} = {design[name]!r}" if name in design else name for name in names)
    moved = ", ".join(node.value for node in plan.pose_inputs)
    return f"/* d: {given or 'none'}; p: {moved or 'none'}; {len(plan.outputs)} outputs */"
